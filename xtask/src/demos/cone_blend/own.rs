//! The pair of a user.

use anyhow::{Result, anyhow};
use cyclide::{Blend, Cone, RingPreference, classify};
use glam::{DAffine3, DVec3, dvec3};
use serde_json::Value;

use super::model::Model;
use super::{export, glossy, scene_of};
use crate::demo::{BadInput, Context, OrBadInput as _};
use crate::report::Target;

/// Two cones from the user's file.
pub(super) fn parse(text: &str) -> Result<[Cone; 2]> {
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
pub(super) fn blend_own(context: &mut Context, cones: [Cone; 2]) -> Result<()> {
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
        glossy(),
    )?;
    let camera = scene.camera(dvec3(0.5, -1.0, 0.5), context.aspect());
    let height = context.height();
    let scene = scene_of(
        &[(&model, DAffine3::IDENTITY)],
        |p| camera.tolerance(p, height),
        glossy(),
    )?;
    context.render(
        "render",
        &scene,
        &camera,
        "The two cones and their blend.",
        "Two cones joined by a smooth tube.",
    )
}
