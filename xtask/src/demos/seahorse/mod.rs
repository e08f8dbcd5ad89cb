//! PLACEHOLDER

mod measure;
mod model;

use std::path::PathBuf;

use anyhow::Result;
use glam::dvec3;

use crate::color::Color;
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::mesh::Mesh;
use crate::render::{Material, Scene};
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

const SKIN: Color = Color::hex(0xe2793b);
const FIN: Color = Color::hex(0xf2b45a);
const EYE: Color = Color::hex(0xf4f1e6);
const PUPIL: Color = Color::hex(0x15181c);
const CORONET: Color = Color::hex(0xc9552b);

impl Demo for Seahorse {
    const NAME: &'static str = "seahorse";
    const PAPER: &'static str = "mass-points-and-spheres, Figs 6 to 10";
    const ABOUT: &'static str = "A seahorse of nine cyclide pieces with G1 joints, a cone and three quadrics";

    fn run(&self, context: &mut Context) -> Result<()> {
        let text = match &self.design {
            Some(path) => std::fs::read_to_string(path).or_bad_input("--design")?,
            None => DESIGN.to_owned(),
        };
        let design: Design = serde_json::from_str(&text).or_bad_input("--design")?;
        let model = Model::new(&design).or_bad_input("--design")?;
        measure(context, &model)?;

        let towards_eye = dvec3(-0.42, -1.0, 0.16);
        let coarse = scene(&model, 0.05, Material::glossy(SKIN))?;
        let camera = coarse.camera(towards_eye, context.aspect());
        let tolerance = 0.25 * camera.tolerance(dvec3(0.0, 0.0, 14.0), context.height());
        let mut glazed = scene(&model, tolerance, Material::glossy(SKIN))?;
        let partner = model.mirrored(lorentz::Plane::new(glam::DVec3::X, dvec3(-12.0,0.0,0.0))?)?;
        add(&mut glazed, &partner, tolerance, Material::glossy(Color::hex(0x2f8f9d)))?;
        let camera = glazed.camera(dvec3(-0.12, -1.0, 0.16), context.aspect());
        context.number("triangles", glazed.triangle_count(), Target::Free);
        context.render("render", &glazed, &camera, "c", "a")?;
        Ok(())
    }
}

fn scene(model: &Model, tolerance: f64, skin: Material) -> Result<Scene> {
    let mut scene = Scene::new();
    add(&mut scene, model, tolerance, skin)?;
    Ok(scene)
}

fn add(scene: &mut Scene, model: &Model, tolerance: f64, skin: Material) -> Result<()> {
    scene.add(model.body_mesh(tolerance)?, skin)?;
    scene.add(model.fin_mesh(tolerance)?, Material::glossy(FIN))?;
    scene.add(model.mouth_mesh(tolerance)?, Material::matte(CORONET))?;
    scene.add(model.coronet_mesh(tolerance), Material::glossy(CORONET))?;
    for eye in &model.eyes {
        scene.add(Mesh::sphere(eye.centre(), eye.radius(), tolerance), Material::glossy(EYE))?;
        let outward = dvec3(if eye.centre().x < -12.0 { 0.55 } else { -0.55 }, eye.centre().y.signum(), 0.12);
        scene.add(Mesh::cap(eye.centre(), 1.004 * eye.radius(), outward, 0.45, tolerance), Material::glossy(PUPIL))?;
    }
    scene.ground_below();
    Ok(())
}

fn measure(context: &mut Context, model: &Model) -> Result<()> {
    let joints = measure::joints(&model.body)?;
    let outline = measure::silhouette(&model.body, context.pick(400, 100))?;
    let size = model.body_mesh(0.1)?.bounds().map_or(1.0, |[low, high]| low.distance(high));
    let curves = model.body.arcs().iter().chain([&model.fin]);
    context.number("pieces", model.body.arcs().len(), Target::exactly(9));
    context.number("g1_max_angle_rad", joints.angle, Target::AtMost(1e-9));
    context.number("fold_backs", joints.fold_backs, Target::exactly(0));
    context.number("position_max_gap", joints.gap / size, Target::AtMost(1e-9));
    context.number("on_unit_quadric_max_error", measure::off_unit_quadric(curves), Target::AtMost(1e-9));
    context.number("silhouette_self_intersections", measure::self_intersections(&outline), Target::exactly(0));
    Ok(())
}
