//! A striped tube swept along a space curve, with the Frenet frame and with the rotation-minimising one.
//!
//! One sees the same curve twice. The stripes of the left tube follow the Frenet frame and wring themselves around it where
//! the curve is nearly straight; those of the right tube follow the rational rotation-minimising frame and run along it
//! calmly. Both tubes are the same surface: the exact rational tube of bidegree (13, 2).

use anyhow::Result;
use bezier_mass::BezierPatch;
use glam::{DVec3, dvec3};
use ph_curves::{
    Frame, Quaternion, RationalFrameQuintic, SpatialPh, rotation_minimising_frames,
    rotation_minimising_tube,
};

use crate::color::{BLUE, ColorMap, GREY, ORANGE};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::export::Part;
use crate::figure::{Figure, Plot};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct RrmfTube {
    /// Radius of the tube; the curve is about 1.2 long
    #[arg(long, default_value_t = 0.045)]
    radius: f64,
}

/// The preimage's ends; the middle coefficient makes the quintic one with a rational frame.
const FIRST: Quaternion = Quaternion::new(1.0, 0.2, -0.3, 0.1);
const LAST: Quaternion = Quaternion::new(0.7, 0.5, 0.4, -0.2);
const ANGLE: f64 = 0.3;

impl Demo for RrmfTube {
    const NAME: &'static str = "rrmf-tube";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Section 1.5";
    const ABOUT: &'static str =
        "A tube with the Frenet frame and with the rational rotation-minimising one";

    fn run(&self, context: &mut Context) -> Result<()> {
        let quintic = RationalFrameQuintic::from_ends(DVec3::ZERO, FIRST, LAST, ANGLE)?;
        let curve = quintic.curve();
        let patches = rotation_minimising_tube(&quintic, self.radius).or_bad_input("--radius")?;
        let steps = context.pick(600, 60);

        let apart = dvec3(-0.08, 0.22, 0.0);
        let frenet = |t: f64| curve.frenet_frame(t);
        let minimal = |t: f64| quintic.frame(t);
        let mut scene = Scene::new();
        let stripes = |map| Material::scalar(map, -1.0, 1.0);
        scene.add(
            striped(&patches, curve, steps, frenet, -apart)?,
            stripes(ColorMap::Diverging),
        )?;
        scene.add(
            striped(&patches, curve, steps, minimal, apart)?,
            stripes(ColorMap::Diverging),
        )?;
        scene.ground_below();
        let camera = scene.camera(dvec3(1.0, 0.35, 0.6), context.aspect());
        context.render(
            "render",
            &scene,
            &camera,
            "The same tube twice: stripes along the Frenet frame (left) and along the rotation-minimising frame (right).",
            "Two bent tubes with stripes along them; those of the left one wind around it.",
        )?;
        context.figure(
            "figure",
            &turning_figure(&quintic),
            "The angle by which each frame has turned about the tangent.",
            "Two curves: one grows, the other stays at zero.",
        )?;
        let whole = Mesh::merged(patches.iter().map(|patch| tessellated(patch, steps)));
        context.meshes("tube", &[Part::new("tube", &whole, BLUE)])?;
        report(context, &quintic)
    }
}

/// How steeply the colour changes between stripes: over less than two cells of the mesh, so that their edges are smooth.
const STEEPNESS: f64 = 5.0;

/// The tube with a scalar that changes sign around it, in eight stripes that follow a frame.
fn striped(
    patches: &[BezierPatch<DVec3>; 4],
    curve: &SpatialPh,
    steps: usize,
    frame: impl Fn(f64) -> Result<Frame, ph_curves::Error>,
    shift: DVec3,
) -> Result<Mesh> {
    let mut parts = Vec::new();
    for patch in patches {
        let around = 48;
        let mut stripes = Vec::with_capacity((steps + 1) * (around + 1));
        let frames = (0..=steps)
            .map(|i| frame(i as f64 / steps as f64))
            .collect::<Result<Vec<_>, _>>()?;
        for j in 0..=around {
            for (i, frame) in frames.iter().enumerate() {
                let u = i as f64 / steps as f64;
                let centre = curve.point(u);
                let spoke = patch.point(u, j as f64 / around as f64)? - centre;
                let angle = spoke.dot(frame.third).atan2(spoke.dot(frame.second));
                stripes.push((STEEPNESS * (4.0 * angle).sin()).clamp(-1.0, 1.0));
            }
        }
        let surface = |u: f64, v: f64| {
            let jet = patch.jet(u, v);
            (
                jet.position().unwrap_or(DVec3::NAN) + shift,
                jet.normal().unwrap_or(DVec3::NAN),
            )
        };
        parts.push(Mesh::grid(steps, around, surface).with_scalar(stripes));
    }
    Ok(Mesh::merged(parts))
}

fn tessellated(patch: &BezierPatch<DVec3>, steps: usize) -> Mesh {
    Mesh::grid(steps / 4, 12, |u, v| {
        let jet = patch.jet(u, v);
        (
            jet.position().unwrap_or(DVec3::NAN),
            jet.normal().unwrap_or(DVec3::NAN),
        )
    })
}

/// The total turning of a frame about the tangent: against frames carried by double reflection, step by step.
fn spin(
    curve: &SpatialPh,
    frame: impl Fn(f64) -> Result<Frame, ph_curves::Error>,
    steps: u32,
) -> Result<Vec<f64>> {
    let parameter = |i: u32| f64::from(i) / f64::from(steps);
    let samples: Vec<_> = (0..=steps)
        .map(|i| curve.point_and_tangent(parameter(i)))
        .collect::<Result<_, _>>()?;
    let carried = rotation_minimising_frames(frame(0.0)?, samples)?;
    let (mut turned, mut before) = (0.0, 0.0);
    let mut turning = Vec::new();
    for (i, reference) in (0..).zip(&carried) {
        let angle = reference.angle_to(&frame(parameter(i))?);
        let step = (angle - before + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        (turned, before) = (turned + step, angle);
        turning.push(turned);
    }
    Ok(turning)
}

fn turning_figure(quintic: &RationalFrameQuintic) -> Figure {
    let curve = quintic.curve();
    let mut plot = Plot::chart("turning about the tangent", "parameter", "angle (rad)");
    for (name, color, turning) in [
        (
            "Frenet",
            ORANGE,
            spin(curve, |t| curve.frenet_frame(t), 400),
        ),
        (
            "Euler-Rodrigues",
            GREY,
            spin(curve, |t| curve.euler_rodrigues_frame(t), 400),
        ),
        (
            "rotation-minimising",
            BLUE,
            spin(curve, |t| quintic.frame(t), 400),
        ),
    ] {
        let points = turning.unwrap_or_default();
        let points: Vec<_> = (0..)
            .zip(points)
            .map(|(i, angle)| glam::dvec2(f64::from(i) / 400.0, angle))
            .collect();
        plot.polyline(&points, color.line().width(2.0).label(name));
    }
    Figure::new(plot).aspect(1.8)
}

fn report(context: &mut Context, quintic: &RationalFrameQuintic) -> Result<()> {
    let curve = quintic.curve();
    let largest = |turning: Vec<f64>| {
        turning
            .into_iter()
            .fold(0.0, |most: f64, angle| most.max(angle.abs()))
    };
    // Double reflection has order 4; at 4000 steps its own error is below 1e-12.
    let steps = 4000;
    let rational = largest(spin(curve, |t| quintic.frame(t), steps)?);
    context.number(
        "rational_rmf_vs_double_reflection_rad",
        rational,
        Target::AtMost(1e-9),
    );
    context.number(
        "frenet_spin_rad",
        largest(spin(curve, |t| curve.frenet_frame(t), steps)?),
        Target::AtLeast(0.5),
    );

    // The spin of the rational frame by its own derivative: f2' . f3, integrated.
    let step = 1e-5;
    let rate = |t: f64| -> Result<f64> {
        let (before, here, after) = (
            quintic.frame(t - step)?,
            quintic.frame(t)?,
            quintic.frame(t + step)?,
        );
        Ok((after.second - before.second).dot(here.third) / (2.0 * step))
    };
    let rates = (1..100)
        .map(|i| rate(f64::from(i) / 100.0))
        .collect::<Result<Vec<_>>>()?;
    let most = rates
        .into_iter()
        .fold(0.0, |most: f64, rate| most.max(rate.abs()));
    // Central differences lose half the digits: 1e-16 / 1e-5, and 1e-10 from the step.
    context.number("rmf_max_spin_rad", most, Target::AtMost(1e-8));

    // The exact arc length against the polygon, extrapolated twice (Richardson).
    let polygon = |steps: u32| -> f64 {
        let point = |i: u32| curve.point(f64::from(i) / f64::from(steps));
        (0..steps).map(|i| point(i).distance(point(i + 1))).sum()
    };
    let (coarse, middle, fine) = (polygon(500), polygon(1000), polygon(2000));
    let (one, two) = ((4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0);
    let length = (16.0 * two - one) / 15.0;
    context.number(
        "arc_length_error",
        (curve.arc_length().total() - length).abs(),
        Target::AtMost(1e-12),
    );
    Ok(())
}
