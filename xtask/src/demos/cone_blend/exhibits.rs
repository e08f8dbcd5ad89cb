//! One blend for every position of two cones.

use anyhow::{Result, anyhow};
use cyclide::{Cone, RingPreference, classify};
use glam::{DAffine3, DQuat, DVec3, dvec3};

use super::model::Model;
use super::{glossy, scene_of};
use crate::demo::Context;
use crate::mesh::Mesh;
use crate::render::Material;
use crate::report::Target;

/// A blend of the gallery.
pub(super) struct Exhibit {
    pub model: Model,
    name: &'static str,
}

/// Twelve pairs in the plane y = 0 (the axial plane), each with a blend that shows its class.
pub(super) fn gallery() -> Result<Vec<Exhibit>> {
    let around = |axis: DVec3, half_angle: f64, radius: f64| {
        Cone::new(-axis * (radius / half_angle.sin()), axis, half_angle)
    };
    let tilted = |angle: f64| dvec3(angle.cos(), 0.0, angle.sin());
    let pairs: Vec<(&'static str, [Cone; 2])> = vec![
        (
            "cylinder and cone",
            [
                Cone::cylinder(DVec3::ZERO, DVec3::Z, 0.8)?,
                around(tilted(0.35), 0.3, 0.8)?,
            ],
        ),
        (
            "two cylinders",
            [
                Cone::cylinder(DVec3::ZERO, DVec3::Z, 0.7)?,
                Cone::cylinder(DVec3::ZERO, tilted(0.5), 0.7)?,
            ],
        ),
        (
            "two cones",
            [
                around(DVec3::Z, 0.35, 0.8)?,
                around(tilted(0.25), 0.25, 0.8)?,
            ],
        ),
        (
            "wide and narrow cone",
            [
                around(DVec3::Z, 0.85, 0.8)?,
                around(tilted(0.9), 0.35, 0.8)?,
            ],
        ),
        (
            "parallel axes",
            [
                Cone::new(DVec3::ZERO, DVec3::Z, 0.3)?,
                Cone::new(dvec3(2.6, 0.0, 0.6), -DVec3::Z, 0.3)?,
            ],
        ),
        (
            "parallel cylinders",
            [
                Cone::cylinder(DVec3::ZERO, DVec3::Z, 0.7)?,
                Cone::cylinder(dvec3(2.4, 0.0, 0.0), DVec3::Z, 0.45)?,
            ],
        ),
        (
            "a double line",
            [
                around(DVec3::Z, 0.6, 0.8)?,
                around(dvec3(0.35_f64.sin(), 0.0, 0.35_f64.cos()), 0.25, 0.8)?,
            ],
        ),
        (
            "a common vertex",
            [
                Cone::new(DVec3::ZERO, DVec3::Z, 0.3)?,
                Cone::new(DVec3::ZERO, tilted(0.3), 0.35)?,
            ],
        ),
        (
            "one axis, two angles",
            [
                Cone::new(DVec3::ZERO, DVec3::Z, 0.35)?,
                Cone::new(dvec3(0.0, 0.0, 3.6), DVec3::Z, 0.65)?,
            ],
        ),
        (
            "one axis, one angle",
            [
                Cone::new(DVec3::ZERO, DVec3::Z, 0.5)?,
                Cone::new(dvec3(0.0, 0.0, 3.0), -DVec3::Z, 0.5)?,
            ],
        ),
        (
            "cone and coaxial cylinder",
            [
                Cone::cylinder(DVec3::ZERO, DVec3::Z, 0.5)?,
                Cone::new(DVec3::ZERO, DVec3::Z, 0.6)?,
            ],
        ),
        (
            "a common vertex, touching",
            [
                Cone::new(DVec3::ZERO, DVec3::Z, 0.4)?,
                Cone::new(
                    DVec3::ZERO,
                    dvec3(0.75_f64.sin(), 0.0, 0.75_f64.cos()),
                    0.35,
                )?,
            ],
        ),
    ];
    pairs
        .into_iter()
        .map(|(name, cones)| exhibit(name, cones))
        .collect()
}

/// The best blend of a pair for a picture: a ring on single nappes if there is one, the most compact of them.
fn exhibit(name: &'static str, cones: [Cone; 2]) -> Result<Exhibit> {
    let found = classify(&cones[0], &cones[1]);
    let mut best: Option<(f64, Model)> = None;
    for family in found.families() {
        let rings = [
            RingPreference::Widest,
            RingPreference::SmallestCurvature { reach: 3.0 },
        ]
        .into_iter()
        .filter_map(|wish| family.ring_blend(wish).ok());
        let others = (-12..=12)
            .filter(|step| *step != 0)
            .filter_map(|step| family.blend(0.35 * f64::from(step)).ok());
        for blend in rings.chain(others) {
            let Ok(model) = Model::new(blend, cones) else {
                continue;
            };
            let radii = model.blend.contacts().map(|contact| contact.circle.radius);
            let thick = radii[0].min(radii[1]);
            let Some([low, high]) = model.tube_mesh(&|_| 0.1).bounds() else {
                continue;
            };
            let extent = (high - low).length();
            // Compact, not thin, one nappe, smooth.
            let score = extent
                + 3.0 * (thick - 0.8).abs()
                + if model.tube.is_smooth() { 0.0 } else { 50.0 }
                + if model.blend.is_single_nappe() {
                    0.0
                } else {
                    6.0
                }
                + if model.blend.kind().is_ring() {
                    0.0
                } else {
                    2.0
                };
            if best.as_ref().is_none_or(|(other, _)| score < *other) {
                best = Some((score, model));
            }
        }
    }
    let (_, model) = best.ok_or_else(|| anyhow!("{name}: no blend to show ({})", found.class()))?;
    Ok(Exhibit { model, name })
}

/// Places each model in the unit cell of a grid, standing on the ground.
fn arranged(exhibits: &[Exhibit]) -> Vec<(&Model, DAffine3)> {
    let columns = 4;
    exhibits
        .iter()
        .enumerate()
        .filter_map(|(index, exhibit)| {
            let coarse = |_: DVec3| 0.05;
            let [one, other] = exhibit.model.cone_meshes(&coarse);
            let mesh = Mesh::merged([one, other, exhibit.model.tube_mesh(&coarse)]);
            let [low, high] = mesh.bounds()?;
            let scale = 1.0 / (high - low).max_element();
            let (column, row) = ((index % columns) as f64, (index / columns) as f64);
            let place = dvec3(1.4 * column, 2.05 * row, 0.0);
            let middle = dvec3(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
            Some((
                &exhibit.model,
                DAffine3::from_scale_rotation_translation(
                    DVec3::splat(scale),
                    DQuat::IDENTITY,
                    place - scale * middle,
                ),
            ))
        })
        .collect()
}

pub(super) fn draw_gallery(context: &mut Context, gallery: &[Exhibit]) -> Result<()> {
    let placed = arranged(gallery);
    let materials = glossy();
    let camera = scene_of(&placed, |_| 0.02, materials)?
        .camera(dvec3(-0.25, -1.0, 0.66), context.aspect_or(1.5));
    let height = context.height();
    let scene = scene_of(&placed, |p| 0.5 * camera.tolerance(p, height), materials)?;
    let names: Vec<&str> = gallery.iter().map(|exhibit| exhibit.name).collect();
    context.number("blends_shown", names.len(), Target::exactly(12));
    context.render(
        "render",
        &scene,
        &camera,
        &format!("One blend for every position of two cones or cylinders; from the front left: {}.", names.join(", ")),
        "Twelve pairs of blue and orange cones and cylinders on a light ground, each joined by a smooth white tube between two dark rings.",
    )
}

pub(super) fn draw_zebra(context: &mut Context, model: &Model) -> Result<()> {
    let place = [(model, DAffine3::IDENTITY)];
    let materials = [Material::zebra(); 3];
    let camera = scene_of(&place, |_| 0.02 * model.size(), materials)?
        .camera(dvec3(-0.35, -1.0, 0.35), context.aspect());
    let height = context.height();
    let scene = scene_of(&place, |p| 0.25 * camera.tolerance(p, height), materials)?;
    context.render(
        "render-zebra",
        &scene,
        &camera,
        "Stripes of reflected light on a cylinder, a cone and their blend: bent at the contact circles, nowhere broken.",
        "A cylinder and a cone joined by a tube, covered by black and white stripes that run on across the dark rings.",
    )
}
