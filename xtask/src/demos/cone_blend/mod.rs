//! Blends of two cones by Dupin cyclides, one of each class, and one family through all its types.
//!
//! What one sees: twelve pairs of blue and orange cones and cylinders on a light ground, each pair joined by a white tube that leaves
//! both without an edge along thin dark rings. The strip is an animation: the point X walks along a diagonal, the cones stand still, and the tube
//! between them grows, closes to a point, passes through itself and returns as the type of the cyclide changes. The zebra picture shows one
//! blend under stripes of reflected light: they bend at the rings and break nowhere.

mod model;
#[allow(
    clippy::expect_used,
    unreachable_pub,
    dead_code,
    reason = "test data of the crate, shared with its own tests"
)]
#[path = "../../../../crates/cyclide/tests/common/pairs.rs"]
mod pairs;
mod search;

use std::collections::BTreeSet;
use std::path::PathBuf;

use anyhow::{Result, anyhow};
use cyclide::{Blend, Class, Cone, Dupin, Family, Kind, RingPreference, classify};
use glam::{DAffine3, DQuat, DVec3, dvec3};
use lorentz::CyclideKind;
use serde_json::Value;

use crate::color::{Color, INK};
use crate::demo::{BadInput, Context, Demo, OrBadInput as _};
use crate::export::Part;
use crate::figure::{Figure, Plot, Side};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Scene};
use crate::report::Target;
use model::Model;
use pairs::{CONSTRUCTIONS, Random, pair};

const CONE: Color = Color::hex(0x3f7fbd);
const OTHER: Color = Color::hex(0xe08a3c);
const TUBE: Color = Color::hex(0xf3efe6);

#[derive(clap::Args, Debug)]
pub(super) struct ConeBlend {
    /// Blend the two cones of this JSON file instead: a list of two, each with `vertex`, `axis`, `half_angle` (radians), or `point`, `axis`, `radius`
    #[arg(long, value_name = "FILE")]
    cones: Option<PathBuf>,
}

impl Demo for ConeBlend {
    const NAME: &'static str = "cone-blend";
    const PAPER: &'static str = "blending-two-cones, Plates 2 to 15, Table 1, Fig. 13";
    const ABOUT: &'static str =
        "Cyclides that blend two cones: every class, every family, every type";

    fn run(&self, context: &mut Context) -> Result<()> {
        if let Some(path) = &self.cones {
            let text = std::fs::read_to_string(path).or_bad_input("--cones")?;
            return blend_own(context, parse(&text)?);
        }
        measure(context)?;
        let gallery = gallery()?;
        draw_gallery(context, &gallery)?;
        let model = gallery.first().ok_or_else(|| anyhow!("no blend"))?;
        export(context, "blend", &model.model)?;
        draw_zebra(context, &model.model)?;
        draw_diagonal(context)?;
        draw_strip(context)
    }
}

/// Two cones from the user's file.
fn parse(text: &str) -> Result<[Cone; 2]> {
    let file: Value = serde_json::from_str(text).or_bad_input("--cones")?;
    let entry = |index: usize, key: &str| {
        file.get(index)
            .or_else(|| file.get(key))
            .cloned()
            .unwrap_or(Value::Null)
    };
    let cone = |name: &str, value: Value| -> Result<Cone> {
        let bad = |what: &str| BadInput(format!("--cones: {name}: {what}"));
        let vector = |key: &str| -> Result<DVec3> {
            let numbers: Vec<f64> = value[key]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(Value::as_f64)
                .collect();
            match numbers.as_slice() {
                &[x, y, z] => Ok(dvec3(x, y, z)),
                _ => Err(bad(&format!("{key} must be a list of three numbers")).into()),
            }
        };
        let number = |key: &str| {
            value[key]
                .as_f64()
                .ok_or_else(|| bad(&format!("{key} must be a number")))
        };
        if value.get("radius").is_some() {
            let key = if value.get("point").is_some() {
                "point"
            } else {
                "cylinder_point"
            };
            return Cone::cylinder(vector(key)?, vector("axis")?, number("radius")?)
                .or_bad_input(format!("--cones: {name}"));
        }
        Cone::new(vector("vertex")?, vector("axis")?, number("half_angle")?)
            .or_bad_input(format!("--cones: {name}"))
    };
    Ok([
        cone("cone 1", entry(0, "cone1"))?,
        cone("cone 2", entry(1, "cone2"))?,
    ])
}

/// The user's own pair: the widest ring of each family that has one, the first of them drawn and exported.
fn blend_own(context: &mut Context, cones: [Cone; 2]) -> Result<()> {
    let found = classify(&cones[0], &cones[1]);
    if found.families().is_empty() {
        return Err(BadInput(format!("--cones: {}", found.class())).into());
    }
    context.number("class", found.class().to_string(), Target::Free);
    context.number("families", found.families().len(), Target::Free);
    let blends: Vec<Blend> = found
        .families()
        .iter()
        .filter_map(|family| family.ring_blend(RingPreference::Widest).ok())
        .collect();
    context.number("ring_blends_found", blends.len(), Target::Free);
    let blend = *blends
        .iter()
        .min_by_key(|blend| !blend.is_single_nappe())
        .ok_or_else(|| anyhow!("no family of these cones has a ring cyclide"))?;
    context.number("g1_max_residual", blend.residual(), Target::AtMost(1e-9));
    let model = Model::new(blend, cones)?;
    export(context, "blend", &model)?;
    let scene = scene_of(
        &[(&model, DAffine3::IDENTITY)],
        |_| 0.01 * model.size(),
        [
            Material::glossy(CONE),
            Material::glossy(OTHER),
            Material::glossy(TUBE),
        ],
    )?;
    let camera = scene.camera(dvec3(0.5, -1.0, 0.5), context.aspect());
    let height = context.height();
    let scene = scene_of(
        &[(&model, DAffine3::IDENTITY)],
        |p| camera.tolerance(p, height),
        [
            Material::glossy(CONE),
            Material::glossy(OTHER),
            Material::glossy(TUBE),
        ],
    )?;
    context.render(
        "render",
        &scene,
        &camera,
        "The two cones and their blend.",
        "Two cones joined by a smooth tube.",
    )
}

/// Pairs of each construction that can be blended: classes, families against the planar search, residuals, types, rings.
fn measure(context: &mut Context) -> Result<()> {
    let count = context.pick(100, 12);
    let mut random = Random(context.seed());
    let mut classes = BTreeSet::new();
    let (mut pairs, mut mismatches, mut type_mismatches, mut found, mut absent, mut unexplained) =
        (0_u32, 0_u32, 0_u32, 0_u32, 0_u32, 0_u32);
    let (mut residual, mut angle) = (0.0_f64, 0.0_f64);
    for construction in CONSTRUCTIONS {
        for _ in 0..count {
            let (raw, scale) = pair(construction, &mut random);
            let cones = raw.map(|cone| cone.cone());
            let classification = classify(&cones[0], &cones[1]);
            classes.insert(
                classification
                    .class()
                    .to_string()
                    .split(": ")
                    .next()
                    .unwrap_or_default()
                    .to_owned()
                    + &classification
                        .obstacle()
                        .map_or(String::new(), |obstacle| format!(": {obstacle}")),
            );
            pairs += 1;
            mismatches += u32::from(!families_agree(&cones, &classification, scale, &mut random));
            for family in classification.families() {
                let t = parameter(family, scale, &mut random);
                let blend = family.blend(t)?;
                residual = residual.max(blend.residual());
                angle = angle.max(blend.sampled_error(12).1);
                type_mismatches += u32::from(!type_agrees(family, t, &blend)?);
                match family.ring_blend(RingPreference::Widest) {
                    Ok(ring) => {
                        found += 1;
                        residual = residual.max(ring.residual());
                    }
                    Err(_) => {
                        absent += 1;
                        unexplained += u32::from(
                            !matches!(classification.class(), Class::CommonVertex { .. })
                                && family.only_kind().is_none(),
                        );
                    }
                }
            }
        }
    }
    context.number("classes", classes.len(), Target::exactly(11));
    context.number("pairs", pairs, Target::exactly(15 * count));
    context.number("family_mismatches", mismatches, Target::exactly(0));
    context.number("g1_max_residual", residual, Target::AtMost(1e-9));
    context.number("g1_max_angle_rad", angle, Target::AtMost(1e-7));
    context.number("type_mismatches", type_mismatches, Target::exactly(0));
    context.number("ring_blends_found", found, Target::AtLeast(1.0));
    context.number("ring_blends_absent", absent, Target::Free);
    context.number(
        "ring_blends_absent_where_types_change",
        unexplained,
        Target::exactly(0),
    );
    Ok(())
}

/// A parameter of the order of the data and away from the ends of the types.
fn parameter(family: &Family, scale: f64, random: &mut Random) -> f64 {
    loop {
        let parameter = random.sign() * scale * random.between(0.2, 3.0);
        let coordinate = if family.pairing() == 0 {
            parameter
        } else {
            1.0 / parameter
        };
        let close = |end: &f64| (end - coordinate).abs() < 1e-3 * coordinate.abs();
        if !family
            .intervals()
            .iter()
            .any(|interval| close(&interval.from) || close(&interval.to))
        {
            return parameter;
        }
    }
}

/// Whether the planar search finds the members of all families, and no other, for one circle of the first cone.
fn families_agree(
    cones: &[Cone; 2],
    classification: &cyclide::Classification,
    scale: f64,
    random: &mut Random,
) -> bool {
    let Some(family) = classification.families().first() else {
        return true;
    };
    let height = scale * random.sign() * random.between(0.4, 2.5);
    let Ok(blends) = classification.blends_at_height(height) else {
        return false;
    };
    let mut expected: Vec<f64> = blends
        .iter()
        .map(|blend| (blend.contacts()[1].circle.centre - cones[1].point()).dot(cones[1].axis()))
        .collect();
    let mut found: Vec<f64> = search::search(
        [&cones[0], &cones[1]],
        family.axial_plane_normal(),
        height,
        scale,
    )
    .iter()
    .map(|found| found.height)
    .collect();
    expected.sort_by(f64::total_cmp);
    found.sort_by(f64::total_cmp);
    expected.len() == found.len()
        && expected
            .iter()
            .zip(&found)
            .all(|(one, other)| (one - other).abs() <= 1e-6 * (scale + one.abs()))
}

/// Whether the type that the interval of the family predicts is the one that the space of spheres gives for the built surface.
fn type_agrees(family: &Family, t: f64, blend: &Blend) -> Result<bool> {
    let coordinate = if family.pairing() == 0 { t } else { 1.0 / t };
    let predicted = family
        .intervals()
        .into_iter()
        .find(|interval| interval.contains(coordinate))
        .map(|interval| interval.kind);
    let frame = cyclide::Frame::WORLD;
    // The classification of a whole conic does not depend on its place and size, so it is taken where it keeps its digits.
    let canal = match blend.surface() {
        Dupin::Quartic(surface) => Dupin::quartic(
            1.0,
            surface.eccentricity(),
            surface.mu() / surface.a(),
            frame,
        )?
        .first_canal([0.2, 2.2])?,
        Dupin::Parabolic(surface) => {
            Dupin::parabolic(1.0, surface.k() / surface.f(), frame)?.first_canal([-0.7, 0.9])?
        }
    };
    let measured = match lorentz::Classification::of(*canal.control())?.kind {
        CyclideKind::RingTorus => Kind::RingTorus,
        CyclideKind::HornTorus => Kind::HornTorus,
        CyclideKind::SpindleTorus => Kind::SpindleTorus,
        CyclideKind::RingCyclide => Kind::Ring,
        CyclideKind::SinglyHornedCyclide => Kind::SinglyHorned,
        CyclideKind::HornedCyclide => Kind::DoublyHorned,
        CyclideKind::OneSingularitySpindleCyclide => Kind::OneSingularitySpindle,
        CyclideKind::SpindleCyclide => Kind::TwoSingularitySpindle,
        CyclideKind::ParabolicRingCyclide => Kind::ParabolicRing,
        CyclideKind::ParabolicCyclideWithOneSingularPoint => Kind::ParabolicOneSingularity,
        CyclideKind::ParabolicCyclideWithTwoSingularPoints => Kind::ParabolicTwoSingularities,
        _ => return Ok(false),
    };
    Ok(predicted == Some(measured))
}

/// A blend of the gallery.
struct Exhibit {
    model: Model,
    name: &'static str,
}

/// Twelve pairs in the plane y = 0 (the axial plane), each with a blend that shows its class.
fn gallery() -> Result<Vec<Exhibit>> {
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

/// Models in one scene, each placed by its map; materials of the first cone, the second cone and the tube.
fn scene_of(
    models: &[(&Model, DAffine3)],
    tolerance: impl Fn(DVec3) -> f64,
    [first, second, tube]: [Material; 3],
) -> Result<Scene> {
    let mut scene = Scene::new();
    for (model, map) in models {
        let scale = map.matrix3.x_axis.length();
        let placed = |p: DVec3| tolerance(map.transform_point3(p)) / scale;
        let [one, other] = model.cone_meshes(&placed);
        for (mesh, material) in [
            (one, first),
            (other, second),
            (model.tube_mesh(&placed), tube),
            (model.rings(0.012 * model.size()), Material::matte(INK)),
        ] {
            scene.add(mesh.transformed(*map), material)?;
        }
    }
    scene.ground_below();
    Ok(scene)
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
            let place = dvec3(1.4 * column, 1.75 * row, 0.0);
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

fn draw_gallery(context: &mut Context, gallery: &[Exhibit]) -> Result<()> {
    let placed = arranged(gallery);
    let materials = [
        Material::glossy(CONE),
        Material::glossy(OTHER),
        Material::glossy(TUBE),
    ];
    let camera =
        scene_of(&placed, |_| 0.02, materials)?.camera(dvec3(-0.25, -1.0, 0.62), context.aspect());
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

fn draw_zebra(context: &mut Context, model: &Model) -> Result<()> {
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

/// Writes a blend as OBJ, glTF and STEP.
fn export(context: &mut Context, name: &str, model: &Model) -> Result<()> {
    let tolerance = |_: DVec3| 1e-3 * model.size();
    let (tube, [first, second]) = (model.tube_mesh(&tolerance), model.cone_meshes(&tolerance));
    context.meshes(
        name,
        &[
            Part::new("cone 1", &first, CONE),
            Part::new("cone 2", &second, OTHER),
            Part::new("blend", &tube, TUBE),
        ],
    )?;
    let step = model.step(name)?;
    context.number("step_faces", step.face_count(), Target::Free);
    let area: f64 = {
        let mut area = 0.0;
        for patch in model
            .tube
            .positive_patches(cyclide::tolerance::POSITIVE_WEIGHT)?
        {
            area += patch
                .surface()
                .area(finite_span(patch.first()), finite_span(patch.second()))?;
        }
        area
    };
    if model.tube.surface().as_quartic().is_some() {
        context.number("step_area", area, Target::Free);
    }
    context.step(name, &step)
}

/// Spans of parabolic patches may end at infinity, where the area is not asked for.
fn finite_span(span: [f64; 2]) -> [f64; 2] {
    span.map(|bound| bound.clamp(-1e6, 1e6))
}

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
fn draw_diagonal(context: &mut Context) -> Result<()> {
    let (cones, family) = strip_pair()?;
    let flat = |p: DVec3| glam::dvec2(p.x, p.z);
    let mut plot = Plot::geometry("the types along a diagonal");
    for cone in &cones {
        let across = DVec3::Y.cross(cone.axis());
        for side in [1.0, -1.0] {
            let at = |height: f64| {
                cone.point()
                    + height * cone.axis()
                    + side * (cone.radius() + height * cone.half_angle().tan()) * across
            };
            plot.segment(flat(at(-7.0)), flat(at(7.0)), crate::color::GREY.line());
        }
    }
    let diagonal = family.diagonal().ok_or_else(|| anyhow!("no diagonal"))?;
    let colors = [
        crate::color::BLUE,
        crate::color::GREEN,
        crate::color::VERMILION,
    ];
    let color = |kind: Kind| match kind {
        Kind::Ring => colors[1],
        Kind::DoublyHorned => colors[2],
        _ => colors[0],
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
            let name = ["R (μ = a)", "S (μ = −a)", "φ₁ (μ = c)", "φ₂ (μ = −c)"][index];
            plot.point(flat(x), name, Side::Right, INK.fill());
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
fn draw_strip(context: &mut Context) -> Result<()> {
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
    let materials = [
        Material::glossy(CONE),
        Material::glossy(OTHER),
        Material::glossy(TUBE),
    ];
    let camera = Camera::look_at(dvec3(-5.0, -17.0, 7.0), dvec3(0.4, 0.0, 0.4));
    let mut images = Vec::new();
    let mut kinds = BTreeSet::new();
    let bar = context.progress("strip", u64::from(frames));
    for frame in 0..frames {
        let blend = family.blend(parameter(frame))?;
        kinds.insert(blend.kind());
        let scene = strip_scene(&cones, &blend, materials)?;
        images.push(context.picture_of("strip", &scene, &camera).image());
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
                finish: crate::render::Finish::Glass,
                ..material
            },
        )?;
    }
    let surface = *blend.surface();
    let turn = std::f64::consts::TAU;
    let mut mesh = Mesh::grid(420, 420, |u, v| {
        (
            surface.point(turn * u, turn * v),
            surface.normal(turn * u, turn * v),
        )
    });
    // The far parts of large members are cut away, so that the camera can stay.
    let near: Vec<bool> = mesh.positions.iter().map(|p| p.length() < 5.0).collect();
    mesh.triangles.retain(|triangle| {
        triangle
            .iter()
            .all(|&i| near.get(i as usize).copied().unwrap_or(false))
    });
    scene.add(mesh, surface_material)?;
    let rings = Mesh::merged(
        blend
            .contacts()
            .iter()
            .filter(|contact| contact.circle.centre.length() < 5.0 && contact.circle.radius < 4.0)
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
    Ok(scene)
}
