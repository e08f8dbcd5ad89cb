//! The seahorse of the mass-point paper (Section 4.2), built and measured from a page of design data.
//!
//! The body is a chain of nine curves on the space of spheres, each a conic that is found from the end circle of the
//! previous one and the next given sphere; its envelope is a chain of Dupin cyclide pieces with common tangent planes
//! at the joints. The tail runs out into a point (Algorithm 2), the dorsal fin is a piece of a cone (Algorithm 1 and
//! Lemma 2), eyes and coronet are spheres and an ellipsoid. The design data are given ones: the paper does not print
//! them. The second seahorse is the image of the first under a reflection of the Lorentz space.
//!
//! What one sees: two glazed seahorses, one coral and one sea green, face each other on a light ground, each with a
//! tail curled to a spiral that ends in a sharp tip, a round belly, a bowed neck, a snout that flares at its end, a fin
//! like a short trumpet on the back, and the bar of the coronet pointing at the viewer above a wide-open eye. In the
//! second picture both wear zebra stripes of reflected light: the stripes bend at the joints, because the curvature
//! jumps there, and none of them breaks. The close-up puts thin red rings on the two joints of the belly: every stripe
//! arrives at a ring where it leaves on the other side. The figure shows the plane of symmetry: the dashed given
//! circles, the outline that touches each of them at the two ends of a black chord, and the nine arcs of the centres.
//! The same surfaces are there as meshes and, but for the last hundredths of the tail, as exact patches in STEP.

mod measure;
mod model;

use std::f64::consts::TAU;
use std::path::PathBuf;

use anyhow::Result;
use bezier_mass::BezierPatch;
use glam::{DVec2, DVec3, dvec3};
use lorentz::{CanalCurve, ContactPatch, Plane};

use crate::color::{BLUE, Color, GREY, INK, VERMILION};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::export::{Part, Step};
use crate::figure::{Figure, Marker, Plot, Side};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Paint, Scene};
use crate::report::Target;
use model::{Design, Seahorse as Model};

/// The design data, as JSON.
const DESIGN: &str = include_str!("data.json");

#[derive(clap::Args, Debug)]
pub(super) struct Seahorse {
    /// Another design of the same form as the embedded one (xtask/src/demos/seahorse/data.json)
    #[arg(long, value_name = "FILE")]
    design: Option<PathBuf>,
}

/// What the parts of a seahorse look like.
#[derive(Clone, Copy)]
struct Look {
    skin: Material,
    fin: Material,
    coronet: Material,
    mouth: Material,
}

const CORAL: Look = Look {
    skin: Material::glossy(Color::hex(0xe2793b)),
    fin: Material::glossy(Color::hex(0xf2b45a)),
    coronet: Material::glossy(Color::hex(0xc4452b)),
    mouth: Material::matte(Color::hex(0x8f3417)),
};
const SEA: Look = Look {
    skin: Material::glossy(Color::hex(0x2b8795)),
    fin: Material::glossy(Color::hex(0x9fd0c4)),
    coronet: Material::glossy(Color::hex(0x1d4f73)),
    mouth: Material::matte(Color::hex(0x12454f)),
};
const STRIPED: Look = Look {
    skin: Material::zebra(),
    fin: Material::zebra(),
    ..CORAL
};
const EYE: Material = Material::glossy(Color::hex(0xf4f1e6));
const PUPIL: Material = Material::glossy(Color::hex(0x15181c));

/// The part of half a pixel that facets may stand off the surface: outlines on a plain ground show more than that.
const FINENESS: f64 = 0.25;

impl Demo for Seahorse {
    const NAME: &'static str = "seahorse";
    const PAPER: &'static str = "mass-points-and-spheres, Figs 6 to 10";
    const ABOUT: &'static str =
        "A seahorse of nine cyclide pieces with G1 joints, a cone, spheres and an ellipsoid";

    fn run(&self, context: &mut Context) -> Result<()> {
        let text = match &self.design {
            Some(path) => std::fs::read_to_string(path).or_bad_input("--design")?,
            None => DESIGN.to_owned(),
        };
        let design: Design = serde_json::from_str(&text).or_bad_input("--design")?;
        let model = Model::new(&design).or_bad_input("--design")?;
        measure(context, &model)?;
        draw_design(context, &model)?;
        let partner = model.mirrored(mirror(&model)?)?;
        draw_pair(context, &model, &partner)?;
        draw_joints(context, &model)?;
        export(context, &model)
    }
}

/// The plane in which the second seahorse is the mirror image of the first: a little before the tip of the snout.
fn mirror(model: &Model) -> Result<Plane> {
    let [low, high] = model
        .body_mesh(0.1)?
        .bounds()
        .unwrap_or([DVec3::NEG_ONE, DVec3::ONE]);
    let snout = low.x - 0.03 * (high.z - low.z);
    Ok(Plane::new(DVec3::X, dvec3(snout, 0.0, 0.0))?)
}

/// The seahorse and its mirror image, glazed and striped.
fn draw_pair(context: &mut Context, model: &Model, partner: &Model) -> Result<()> {
    let pair = |tolerance: f64, looks: [Look; 2]| -> Result<Scene> {
        let mut scene = Scene::new();
        add(&mut scene, model, tolerance, looks[0])?;
        add(&mut scene, partner, tolerance, looks[1])?;
        scene.ground_below();
        Ok(scene)
    };
    let camera = pair(0.1, [CORAL, SEA])?.camera(dvec3(-0.10, -1.0, 0.14), context.aspect());
    let tolerance = FINENESS * camera.tolerance(DVec3::ZERO, context.height());
    let glazed = pair(tolerance, [CORAL, SEA])?;
    context.number("triangles", glazed.triangle_count(), Target::Free);
    context.render(
        "render",
        &glazed,
        &camera,
        "A seahorse of nine cyclide pieces with G1 joints, and its image under a reflection of the Lorentz space.",
        "Two glazed seahorses, sea green and coral, face each other; curled tails, round bellies, fins, coronets, snouts.",
    )?;
    let striped = pair(tolerance, [STRIPED; 2])?;
    context.render(
        "render-zebra",
        &striped,
        &camera,
        "The same under zebra stripes: they bend at the joints, where the curvature jumps, and break nowhere.",
        "The two seahorses covered with black and white reflection stripes that run on without a break.",
    )
}

/// The joints at the third and the fourth sphere from nearby.
fn draw_joints(context: &mut Context, model: &Model) -> Result<()> {
    let joints: Vec<&CanalCurve> = model.body.arcs().iter().skip(4).take(2).collect();
    let mut around = Vec::new();
    let mut rings = Mesh::default();
    for arc in &joints {
        let Some(circle) = arc.at(0.0).circle()?.circle() else {
            continue;
        };
        let points = (0..180)
            .map(|i| circle.point(TAU * f64::from(i) / 180.0, DVec3::Y))
            .collect::<Result<Vec<_>, _>>()?;
        rings.append(Mesh::tube(&points, 0.012 * circle.radius(), true));
        around.extend(points);
    }
    // A little more than the rings themselves.
    let middle = around.iter().sum::<DVec3>() / around.len().max(1) as f64;
    around
        .iter_mut()
        .for_each(|p| *p = middle + 1.15 * (*p - middle));
    let camera = Camera::fit(&around, dvec3(-0.40, -1.0, 0.22), context.aspect());
    let mut scene = Scene::new();
    let tolerance = FINENESS * camera.tolerance(dvec3(1.0, 0.0, 10.0), context.height());
    add(&mut scene, model, tolerance, STRIPED)?;
    scene.add(rings, Material::matte(VERMILION))?;
    scene.ground_below();
    context.render(
        "render-joints",
        &scene,
        &camera,
        "The joints at the spheres S3 and S4 (red rings) from nearby: each stripe goes on across the ring.",
        "The belly from nearby, in zebra stripes, with two thin red rings that the stripes cross unbroken.",
    )
}

/// Adds a seahorse to the scene.
fn add(scene: &mut Scene, model: &Model, tolerance: f64, look: Look) -> Result<()> {
    scene.add(model.body_mesh(tolerance)?, look.skin)?;
    scene.add(model.fin_mesh(tolerance)?, look.fin)?;
    scene.add(model.mouth_mesh(tolerance)?, look.mouth)?;
    scene.add(model.coronet_mesh(tolerance), look.coronet)?;
    let forward = model.forward();
    for eye in &model.eyes {
        let (centre, radius) = (eye.centre(), eye.radius().abs());
        scene.add(Mesh::sphere(centre, radius, tolerance), EYE)?;
        let gaze = 0.5 * forward + centre.y.signum() * DVec3::Y + 0.1 * DVec3::Z;
        scene.add(
            Mesh::cap(centre, 1.004 * radius, gaze, 0.45, tolerance),
            PUPIL,
        )?;
    }
    Ok(())
}

/// The surfaces for other programs: meshes, and the exact rational biquadratic patches of the ten canal surfaces.
fn export(context: &mut Context, model: &Model) -> Result<()> {
    let tolerance = context.pick(2e-3, 2e-2);
    let (body, fin) = (model.body_mesh(tolerance)?, model.fin_mesh(tolerance)?);
    let coronet = model.coronet_mesh(tolerance);
    let eyes = Mesh::merged(
        model
            .eyes
            .iter()
            .map(|eye| Mesh::sphere(eye.centre(), eye.radius(), tolerance)),
    );
    let color = |material: Material| match material.paint {
        Paint::Plain(color) => color,
        _ => GREY,
    };
    context.meshes(
        "seahorse",
        &[
            Part::new("body", &body, color(CORAL.skin)),
            Part::new("dorsal fin", &fin, color(CORAL.fin)),
            Part::new("coronet", &coronet, color(CORAL.coronet)),
            Part::new("eyes", &eyes, color(EYE)),
        ],
    )?;
    let mut step = Step::new("seahorse");
    for arc in model.body.arcs().iter().chain([&model.fin]) {
        let arc = without_tip(arc)?;
        let half = arc.second_family().conic()?;
        // Quarter turns: a half turn has vectors among its control points.
        for half in [half, half.complement()?] {
            for quarter in [half.sub_arc(0.0, 0.5)?, half.sub_arc(0.5, 1.0)?] {
                let patch = ContactPatch::new(arc.curve(), quarter.curve())?.surface()?;
                step.patch(&BezierPatch::from(patch))?;
            }
        }
    }
    context.step("seahorse", &step)
}

/// The surface from a small sphere on, if it starts in a point: there the weights of its patch vanish, which STEP does
/// not know.
fn without_tip(arc: &CanalCurve) -> Result<CanalCurve> {
    const SMALL_RADIUS: f64 = 0.02;
    if arc.at(0.0).vertex().is_none() {
        return Ok(*arc);
    }
    let small = arc.curve().parameters_of_radius(SMALL_RADIUS);
    let start = small
        .iter()
        .filter_map(|t| t.value())
        .find(|t| (0.0..1.0).contains(t));
    Ok(arc.sub_arc(start.unwrap_or(0.0), 1.0)?)
}

/// The constraints and the skeleton in the plane of symmetry.
fn draw_design(context: &mut Context, model: &Model) -> Result<()> {
    let plane = |p: DVec3| DVec2::new(p.x, p.z);
    let mut plot = Plot::geometry("");
    let outline = measure::silhouette(&model.body, 100)?;
    plot.polygon(
        &outline,
        Color::hex(0xf6dcc8)
            .fill()
            .stroke(VERMILION)
            .width(1.6)
            .label("envelope in the plane y = 0"),
    );
    for (i, arc) in model.body.arcs().iter().enumerate() {
        let spine = arc.curve().spine()?;
        let centre = |t: f64| spine.point(t).map_or(DVec2::NAN, plane);
        let style = BLUE.line().width(1.4);
        plot.trace(
            centre,
            0.0,
            1.0,
            if i == 0 {
                style.label("centres of the spheres: nine conics")
            } else {
                style
            },
        );
        let end = arc.at(1.0);
        if let Some(sphere) = end.sphere().and_then(|s| s.object().ok()?.sphere()) {
            let style = GREY.line().width(0.9).dashed();
            plot.circle(
                plane(sphere.centre()),
                sphere.radius(),
                if i == 1 {
                    style.label("given spheres")
                } else {
                    style
                },
            );
            plot.point(
                plane(sphere.centre()),
                &format!("S_{i}"),
                Side::Right,
                BLUE.fill(),
            );
        }
        if let Some(circle) = end.circle()?.circle() {
            let arm = circle.radius() * circle.frame(DVec3::Y)?.1;
            let style = INK.line().width(1.2);
            let style = if i == 1 {
                style.label("joint circles, edge on")
            } else {
                style
            };
            plot.segment(
                plane(circle.centre() + arm),
                plane(circle.centre() - arm),
                style,
            );
        }
    }
    if let Some(&tip) = outline.first() {
        plot.points(&[tip], Marker::Disc, VERMILION.fill());
        plot.text(tip, "M₀", Side::Right);
    }
    context.figure(
        "figure",
        &Figure::new(plot).aspect(1.25),
        "The plane of symmetry: given spheres, joint circles seen edge on, the conics of the centres, the outline.",
        "Outline of a seahorse with dashed circles inside it, black chords at nine joints and a blue line of centres.",
    )
}

fn measure(context: &mut Context, model: &Model) -> Result<()> {
    let joints = measure::joints(&model.body)?;
    let outline = measure::silhouette(&model.body, context.pick(400, 100))?;
    let size = model
        .body_mesh(0.1)?
        .bounds()
        .map_or(1.0, |[low, high]| low.distance(high));
    let curves = model.body.arcs().iter().chain([&model.fin]);
    context.number("pieces", model.body.arcs().len(), Target::exactly(9));
    context.number("g1_max_angle_rad", joints.angle, Target::AtMost(1e-9));
    context.number("fold_backs", joints.fold_backs, Target::exactly(0));
    context.number("position_max_gap", joints.gap / size, Target::AtMost(1e-9));
    context.number(
        "on_unit_quadric_max_error",
        measure::off_unit_quadric(curves),
        Target::AtMost(1e-9),
    );
    context.number(
        "silhouette_self_intersections",
        measure::self_intersections(&outline),
        Target::exactly(0),
    );
    Ok(())
}
