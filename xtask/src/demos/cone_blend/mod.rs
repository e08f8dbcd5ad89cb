//! Blends of two cones by Dupin cyclides, one of each class, and one family through all its types.
//!
//! What one sees: twelve pairs of blue and orange cones and cylinders on a light ground, each pair joined by a white tube that leaves
//! both without an edge along thin dark rings. The strip is an animation: the point X walks along a diagonal, the cones stand still, and the tube
//! between them grows, closes to a point, passes through itself and returns as the type of the cyclide changes. The zebra picture shows one
//! blend under stripes of reflected light: they bend at the rings and break nowhere.

mod exhibits;
mod measure;
mod model;
mod own;
#[allow(
    clippy::expect_used,
    unreachable_pub,
    dead_code,
    reason = "test data of the crate, shared with its own tests"
)]
#[path = "../../../../crates/cyclide/tests/common/pairs.rs"]
mod pairs;
mod search;
mod strip;

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use glam::{DAffine3, DVec3};

use crate::color::{Color, INK};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::export::Part;
use crate::render::{Material, Scene};
use crate::report::Target;
use model::Model;

const CONE: Color = Color::hex(0x3f7fbd);
const OTHER: Color = Color::hex(0xe08a3c);
const TUBE: Color = Color::hex(0xf3efe6);

/// Materials of the first cone, the second cone and the tube.
fn glossy() -> [Material; 3] {
    [CONE, OTHER, TUBE].map(Material::glossy)
}

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
            return own::blend_own(context, own::parse(&text)?);
        }
        measure::measure(context)?;
        let gallery = exhibits::gallery()?;
        exhibits::draw_gallery(context, &gallery)?;
        let model = gallery.first().ok_or_else(|| anyhow!("no blend"))?;
        export(context, "blend", &model.model)?;
        exhibits::draw_zebra(context, &model.model)?;
        strip::draw_diagonal(context)?;
        strip::draw_strip(context)
    }
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
