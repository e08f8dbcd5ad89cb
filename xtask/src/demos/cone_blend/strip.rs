//! One family through all its types.

use std::collections::BTreeSet;

use anyhow::{Result, anyhow};
use cyclide::{Blend, Cone, Family, Kind, classify};
use glam::{DVec3, dvec3};

use super::glossy;
use crate::color::{BLUE, GREEN, GREY, INK, VERMILION};
use crate::demo::Context;
use crate::figure::{Figure, Plot, Side};
use crate::mesh::Mesh;
use crate::render::{Camera, Finish, Material, Scene};
use crate::report::Target;

/// The pair of the strip: two nearly equal cones, for which all four ends of the types are near on the diagonal of contact circles on opposite sides.
fn strip_pair() -> Result<([Cone; 2], Family)> {
    let around = |axis: DVec3, half_angle: f64| {
        Cone::new(-axis * (0.8 / half_angle.sin()), axis, half_angle)
    };
    let cones = [
        around(DVec3::Z, 0.33)?,
        around(dvec3(0.3_f64.cos(), 0.0, 0.3_f64.sin()), 0.3)?,
    ];
    let found = classify(&cones[0], &cones[1]);
    let family = found
        .families()
        .iter()
        .find(|family| family.pairing() < 0)
        .ok_or_else(|| anyhow!("no family"))?;
    Ok((cones, *family))
}

/// The diagonal of the strip's pair with its intervals, in the axial plane (Fig. 13).
pub(super) fn draw_diagonal(context: &mut Context) -> Result<()> {
    let (cones, family) = strip_pair()?;
    let flat = |p: DVec3| glam::dvec2(p.x, p.z);
    let mut plot = Plot::geometry("the types of blends along a diagonal");
    for cone in &cones {
        let across = DVec3::Y.cross(cone.axis());
        for side in [1.0, -1.0] {
            let at = |height: f64| {
                cone.point()
                    + height * cone.axis()
                    + side * (cone.radius() + height * cone.half_angle().tan()) * across
            };
            plot.segment(
                flat(at(-7.0)),
                flat(at(7.0)),
                GREY.line().label("the cones"),
            );
        }
    }
    let diagonal = family.diagonal().ok_or_else(|| anyhow!("no diagonal"))?;
    let color = |kind: Kind| match kind {
        Kind::Ring => GREEN,
        Kind::DoublyHorned => VERMILION,
        _ => BLUE,
    };
    let mut seen = BTreeSet::new();
    let steps = 600;
    let mut along = Vec::new();
    for step in 0..=steps {
        let ordinate = -4.5 + 9.0 * f64::from(step) / f64::from(steps);
        let x = diagonal.point + ordinate * diagonal.direction;
        let Ok(t) = family.parameter_at(x) else {
            continue;
        };
        // At the common sphere itself there is no cyclide.
        if t.abs() > 1e-9 {
            along.push((flat(x), family.kind_at(t)));
        }
    }
    for run in along.chunk_by(|one, other| one.1 == other.1) {
        let Some(&(_, kind)) = run.first() else {
            continue;
        };
        let points: Vec<_> = run.iter().map(|(point, _)| *point).collect();
        let style = color(kind).line().width(3.0);
        plot.polyline(
            &points,
            if seen.insert(kind) {
                style.label(kind.name())
            } else {
                style
            },
        );
    }
    for (index, boundary) in family.boundaries().into_iter().enumerate() {
        let Some(x) = boundary.and_then(|t| family.diagonal_point_of(t).position()) else {
            continue;
        };
        if flat(x).length() < 4.6 {
            let (name, side) = [
                ("R (μ = a)", Side::Left),
                ("S (μ = −a)", Side::AboveRight),
                ("φ₁ (μ = c)", Side::BelowLeft),
                ("φ₂ (μ = −c)", Side::AboveRight),
            ][index];
            plot.point(flat(x), name, side, INK.fill());
        }
    }
    if let Some(sphere) = family.common_sphere() {
        plot.circle(
            flat(sphere.centre),
            sphere.radius.abs(),
            INK.line().dashed().label("common sphere"),
        );
    }
    plot.view(glam::dvec2(-4.6, -3.6), glam::dvec2(4.6, 3.6));
    context.figure(
        "figure",
        &Figure::new(plot),
        "A diagonal of two cones: each point gives a blend, and its type changes at four points only.",
        "Skeletal lines of two cones, their common sphere dashed, and a diagonal coloured by the type of cyclide, with the points R, S, phi 1 and phi 2.",
    )
}

/// The blend while X walks along the diagonal, through infinity and back.
pub(super) fn draw_strip(context: &mut Context) -> Result<()> {
    let (cones, family) = strip_pair()?;
    let frames = context.pick(24_u32, 6);
    // From one side of the common sphere to the other, a third beyond the last end of a type; no frame is at the sphere itself.
    let reach = 1.35
        * family
            .boundaries()
            .into_iter()
            .flatten()
            .fold(0.0_f64, |reach, t| reach.max(t.abs()));
    let parameter = |frame: u32| reach * (2.0 * (f64::from(frame) + 0.5) / f64::from(frames) - 1.0);
    let materials = glossy();
    let camera = Camera::look_at(
        dvec3(-5.4, -18.4, 7.6),
        dvec3(0.4, 0.0, 0.4),
        context.aspect(),
    );
    let mut images = Vec::new();
    let mut kinds = BTreeSet::new();
    let bar = context.progress("strip", u64::from(frames));
    for frame in 0..frames {
        let blend = family.blend(parameter(frame))?;
        kinds.insert(blend.kind());
        let scene = strip_scene(&cones, &blend, materials)?;
        images.push(context.frame_of("strip", &scene, &camera).image());
        bar.inc(1);
    }
    bar.finish_and_clear();
    context.number("strip_kinds", kinds.len(), Target::AtLeast(3.0));
    context.animation(
        "figure-strip",
        &images,
        6,
        "X walks along one diagonal: doubly horned, ring, spindle, past the common sphere, spindle, ring, doubly horned.",
        "A blue and an orange cone stand still while the white cyclide between them changes its shape.",
    )
}

/// The far parts of large members are cut away at this distance, so that the camera can stay.
const REACH: f64 = 4.6;

/// The whole cyclide inside a fixed box with fixed pieces of both cones.
fn strip_scene(
    cones: &[Cone; 2],
    blend: &Blend,
    [first, second, surface_material]: [Material; 3],
) -> Result<Scene> {
    let mut scene = Scene::new();
    // Fine enough that the surfaces part cleanly where they touch.
    let tolerance = |_: DVec3| 0.001;
    for (cone, material) in cones.iter().zip([first, second]) {
        let across = cone.axis().any_orthonormal_vector();
        let other = cone.axis().cross(across);
        let (sin, cos) = cone.half_angle().sin_cos();
        let mesh = Mesh::surface(
            |u, v| {
                let height = -cone.point().dot(cone.axis()) - 2.4 + 4.8 * u;
                let (s, c) = (std::f64::consts::TAU * v).sin_cos();
                let radial = c * across + s * other;
                let radius = cone.radius() + height * cone.half_angle().tan();
                (
                    cone.point() + height * cone.axis() + radius * radial,
                    cos * radial - sin * cone.axis(),
                )
            },
            tolerance,
        );
        scene.add(
            mesh,
            Material {
                finish: Finish::Glass,
                ..material
            },
        )?;
    }
    let surface = *blend.surface();
    let turn = std::f64::consts::TAU;
    let mesh = Mesh::grid(420, 420, |u, v| {
        (
            surface.point(turn * u, turn * v),
            surface.normal(turn * u, turn * v),
        )
    });
    scene.add(mesh.cut(|p| REACH - p.length()), surface_material)?;
    let rings = Mesh::merged(
        blend
            .contacts()
            .iter()
            .filter(|contact| contact.circle.centre.length() < REACH && contact.circle.radius < 4.0)
            .map(|contact| {
                let points: Vec<DVec3> = (0..120)
                    .map(|i| contact.circle.point(turn * f64::from(i) / 120.0))
                    .collect();
                Mesh::tube(&points, 0.03, true)
            }),
    );
    if !rings.positions.is_empty() {
        scene.add(rings, Material::matte(INK))?;
    }
    scene.ground(-REACH);
    Ok(scene)
}
