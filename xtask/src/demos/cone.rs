//! The cone from a vertex and a sphere (Algorithm 1), and the piece of it that is the dorsal fin of the paper's seahorse.
//!
//! What one sees in the picture: a pale see-through cone runs from a small dark ball, its vertex, past two glazed balls
//! that touch it from inside, a blue one of radius 2 and a larger orange one of radius 3; the band of the cone between
//! their circles of contact is solid and green, and thin dark rings on it are its characteristic circles, found by
//! halving the Bézier curve. In the figure the left half is the same in the plane of symmetry: two straight lines from
//! the vertex touch the circles of all spheres. The right half is the plane of the curve in the Lorentz space, drawn in
//! its own metric: the cone is one branch of a hyperbola about Omega with the directions of the vertex and of infinity as
//! asymptotes, the other branch is the other nappe, and the fin is the short thick arc.

use std::f64::consts::TAU;

use anyhow::{Context as _, Result, ensure};
use glam::{DVec2, DVec3, dvec2, dvec3};
use lorentz::construct::{ConePatch, cone_between_radii};
use lorentz::{Sphere, TubeGrid};

use crate::color::{BLUE, Color, GREEN, GREY, INK, ORANGE};
use crate::demo::{BadInput, Context, Demo, OrBadInput as _};
use crate::figure::{Figure, Marker, Plot, Side};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Cone {
    /// Radius of the sphere at the outer end of the piece
    #[arg(long, default_value_t = 3.0)]
    end_radius: f64,
}

/// The paper's data (Section 4.2): the vertex, the sphere.
const VERTEX: DVec3 = dvec3(-25.0 / 3.0, 0.0, 43.0 / 3.0);
const CENTRE: DVec3 = dvec3(2.0, 0.0, 16.0);
const RADIUS: f64 = 2.0;
/// What the paper prints, and half a unit of its last digit.
const PRINTED_T: [f64; 2] = [0.879, 0.916];
const PRINTED_WEIGHT: f64 = 1.021;
const PRINTED_MIDDLE: [f64; 5] = [0.4, 1.8333, 0.0, 6.5667, 55.5333];
const PAPER_RADIUS: f64 = 3.0;
/// A larger piece would take more facets than a picture has pixels.
const MOST_RADIUS: f64 = 100.0;

impl Demo for Cone {
    const NAME: &'static str = "cone";
    const PAPER: &'static str = "mass-points-and-spheres, Figs 5 and 8";
    const ABOUT: &'static str =
        "A cone from a vertex and a sphere, and the piece between two of its spheres";

    fn run(&self, context: &mut Context) -> Result<()> {
        let sphere = Sphere::new(CENTRE, RADIUS)?;
        ensure!(
            self.end_radius <= MOST_RADIUS,
            BadInput(format!(
                "--end-radius {} is above {MOST_RADIUS}",
                self.end_radius
            ))
        );
        let patch = cone_between_radii(VERTEX, sphere, [RADIUS, self.end_radius])
            .or_bad_input("--end-radius")?;
        let printed = self.end_radius == PAPER_RADIUS;
        let target = |target: Target| if printed { target } else { Target::Free };
        context.number(
            "t_d",
            patch.parameters[0],
            target(Target::within(PRINTED_T[0], 5e-4)),
        );
        context.number(
            "t_e",
            patch.parameters[1],
            target(Target::within(PRINTED_T[1], 5e-4)),
        );
        context.number(
            "omega_e",
            patch.weight,
            target(Target::within(PRINTED_WEIGHT, 5e-4)),
        );
        context.number(
            "pe",
            patch.middle.to_null().to_vec(),
            target(Target::near(&PRINTED_MIDDLE, 5e-5)),
        );
        context.number("on_cone_max_error", off_cone(&patch)?, Target::AtMost(1e-9));
        draw_plane(context, &patch, self.end_radius)?;
        draw_space(context, &patch, self.end_radius)
    }
}

/// Largest distance of the piece's points from the cone of elementary geometry (lines from the vertex that touch the
/// sphere), relative to their distance from the vertex.
fn off_cone(patch: &ConePatch) -> Result<f64> {
    let axis = CENTRE - VERTEX;
    let sine = RADIUS / axis.length();
    let half_angle = sine.asin();
    let tube = patch.curve.tessellate(&TubeGrid::new(64, 64))?;
    let angle = |p: &DVec3| {
        let line = *p - VERTEX;
        axis.cross(line).length().atan2(axis.dot(line))
    };
    Ok(tube
        .positions()
        .iter()
        .map(|p| (angle(p) - half_angle).abs())
        .fold(0.0, f64::max))
}

fn centre(radius: f64) -> DVec3 {
    VERTEX + (CENTRE - VERTEX) * (radius / RADIUS)
}

/// The plane of symmetry, and the plane of the curve in the space of spheres.
fn draw_plane(context: &mut Context, patch: &ConePatch, end_radius: f64) -> Result<()> {
    let flat = |p: DVec3| dvec2(p.x, p.z);
    let mut space = Plot::geometry("the plane y = 0");
    let far = 1.25 * end_radius.max(RADIUS);
    for t in [0.25, 0.5, 0.75, 1.0] {
        space.circle(flat(centre(t * far)), t * far, GREY.line().width(0.6));
    }
    let tube = patch.cone.curve.tessellate(
        &TubeGrid::new(2, 4)
            .with_interval(0.0, cone_parameter_of(patch, far))
            .with_reference(DVec3::Y),
    )?;
    let ends = tube.ring(2).context("a ring")?;
    for side in [1, 3] {
        space.segment(flat(VERTEX), flat(ends[side]), INK.line().width(1.2));
    }
    let fin = patch
        .curve
        .tessellate(&TubeGrid::new(1, 4).with_reference(DVec3::Y))?;
    let (first, last) = (
        fin.ring(0).context("a ring")?,
        fin.ring(1).context("a ring")?,
    );
    for side in [1, 3] {
        let style = GREEN.line().width(3.6);
        let style = if side == 1 {
            style.label("the fin")
        } else {
            style
        };
        space.segment(flat(first[side]), flat(last[side]), style);
    }
    for (radius, name, color) in [(RADIUS, "S_d", BLUE), (end_radius, "S_e", ORANGE)] {
        let label = format!("{name}, radius {radius}");
        space.circle(
            flat(centre(radius)),
            radius,
            color.line().width(1.8).label(label),
        );
        space.points(&[flat(centre(radius))], Marker::Disc, color.fill());
    }
    space.points(&[flat(VERTEX)], Marker::Disc, INK.fill());
    space.text(flat(VERTEX) + dvec2(1.4, -0.4), "vertex S", Side::Below);
    context.figure(
        "figure",
        &Figure::grid(2, vec![space, hyperbola(patch)]).aspect(0.95),
        "The cone in the plane of symmetry, and as one branch of a hyperbola on the space of spheres (Fig. 5).",
        "Left: circles in an angle of two lines, two of them coloured; right: a hyperbola with a thick green arc.",
    )
}

fn cone_parameter_of(patch: &ConePatch, radius: f64) -> f64 {
    radius / (2.0 * patch.cone.weight + radius)
}

/// The affine plane of the curve: a sphere is `Omega + x m + y e_inf`, with the coordinates scaled to make the
/// hyperbola of the two light-like directions equilateral.
fn hyperbola(patch: &ConePatch) -> Plot {
    let w = 2.0 * patch.cone.weight;
    // The sphere of radius r is Omega + m/r + r/w^2 e_inf; x = w/r and y = r/w turn it into x y = 1.
    let place = |radius: f64| dvec2(radius / w, w / radius);
    let mut plot = Plot::geometry("the plane of the curve");
    // Rotated so that the branch of positive radius opens upward: the two directions are the diagonals.
    let turn = |p: DVec2| dvec2(p.x - p.y, p.x + p.y) * std::f64::consts::FRAC_1_SQRT_2;
    let [r_d, r_e] = patch
        .parameters
        .map(|t| 2.0 * patch.cone.weight * t / (1.0 - t));
    let unit = (r_d / w).ln();
    let branch = move |s: f64, sign: f64| turn(sign * place(w.abs() * (s * unit).exp()));
    plot.segment(
        turn(dvec2(-12.0, 0.0)),
        turn(dvec2(12.0, 0.0)),
        GREY.line().width(0.9).dashed(),
    );
    plot.segment(
        turn(dvec2(0.0, -12.0)),
        turn(dvec2(0.0, 12.0)),
        GREY.line().width(0.9).dashed(),
    );
    let reach = 12.0_f64.ln() / unit.abs();
    plot.trace(
        |s| branch(s, 1.0),
        -reach,
        reach,
        BLUE.line().width(1.8).label("the cone, w₁ > 0"),
    );
    plot.trace(
        |s| branch(s, -1.0),
        -reach,
        reach,
        INK.line()
            .width(1.2)
            .dashed()
            .label("the other nappe, w₁ < 0"),
    );
    let arc = |r: f64| turn(place(r));
    let shown = |r: f64| arc(r).abs().max_element() < 12.0;
    plot.trace(
        |s| arc(r_d * (r_e / r_d).powf(s)),
        0.0,
        1.0,
        GREEN.line().width(4.0).label("the fin"),
    );
    for (r, name) in [(r_d, "σ_d"), (r_e, "σ_e")] {
        if shown(r) {
            plot.point(arc(r), name, Side::Right, INK.fill());
        }
    }
    plot.point(DVec2::ZERO, "Ω", Side::Below, INK.fill());
    plot.arrow(DVec2::ZERO, turn(dvec2(0.0, 4.0)), INK.line().width(1.4));
    plot.arrow(DVec2::ZERO, turn(dvec2(4.0, 0.0)), INK.line().width(1.4));
    plot.text(turn(dvec2(0.0, 4.0)), "m_S", Side::Left);
    plot.text(turn(dvec2(4.0, 0.0)), "e_∞", Side::Right);
    plot
}

fn draw_space(context: &mut Context, patch: &ConePatch, end_radius: f64) -> Result<()> {
    let far = 1.3 * end_radius.max(RADIUS);
    let scene = |tolerance: f64| -> Result<Scene> {
        let mut scene = Scene::new();
        let whole = Mesh::canal(
            &patch.cone.curve,
            [0.0, cone_parameter_of(patch, far)],
            tolerance,
        )?;
        scene.add(whole, Material::glass(Color::hex(0xbcc9d6)))?;
        let fin = Mesh::canal(&patch.curve, [0.0, 1.0], tolerance)?;
        scene.add(lifted(fin, 2.0 * tolerance), Material::glossy(GREEN))?;
        for (radius, color) in [(RADIUS, BLUE), (end_radius, ORANGE)] {
            scene.add(
                Mesh::sphere(centre(radius), 0.995 * radius, tolerance),
                Material::glossy(color),
            )?;
        }
        scene.add(Mesh::sphere(VERTEX, 0.14, tolerance), Material::glossy(INK))?;
        scene.add(rings(patch)?, Material::matte(INK))?;
        scene.ground_below();
        Ok(scene)
    };
    let towards_eye = dvec3(-0.35, -1.0, 0.30);
    let camera = scene(0.05)?.camera(towards_eye, context.aspect());
    let tolerance = 0.25 * camera.tolerance(CENTRE, context.height());
    context.render(
        "render",
        &scene(tolerance)?,
        &camera,
        "The whole cone, the two spheres that bound the fin, and the fin with circles found by subdivision.",
        "A pale transparent cone around a blue and an orange ball, with a green band between their circles of contact.",
    )
}

/// A mesh a little outside of itself, not to coincide with another one of the same surface.
fn lifted(mut mesh: Mesh, height: f64) -> Mesh {
    for (position, normal) in mesh.positions.iter_mut().zip(&mesh.normals) {
        *position += height * *normal;
    }
    mesh
}

/// The characteristic circles at the dyadic parameters of the piece.
fn rings(patch: &ConePatch) -> Result<Mesh> {
    let mut rings = Mesh::default();
    for circle in patch
        .curve
        .circles_by_subdivision(3)?
        .into_iter()
        .filter_map(|circle| circle.circle())
    {
        let points = (0..180).map(|i| circle.point(TAU * f64::from(i) / 180.0, DVec3::Y));
        rings.append(Mesh::tube(
            &points.collect::<Result<Vec<_>, _>>()?,
            0.03,
            true,
        ));
    }
    Ok(rings)
}
