//! A horned cyclide becomes a cone: one of its two singular points moves to infinity (the animation of Appendix A.3).
//!
//! Every frame is the image of the same two curves of spheres under a Lorentz map: the transversion that fixes the
//! lower singular point with all directions there, and takes the other one from its place to infinity. Nothing is
//! built anew, and the last frame is a cone to rounding.
//!
//! What one sees: an eye-shaped ring of two crescents, an orange one above and a blue one below, that meet in two sharp
//! points; a small dark ball marks the left one. Frame by frame the right point runs away out of the picture and the
//! crescents open after it, while the dark ball and the directions of both horns there stay as they are. In the last
//! frames the sides are straight: two upright nappes of a cone, orange above blue, joined in the dark ball and cut off by
//! the border of the picture, because a cone has no end.

use anyhow::{Context as _, Result};
use glam::{DVec3, dvec3};
use lorentz::construct::between_points;
use lorentz::{CanalCurve, LorentzMap, Point, Sphere, TubeGrid};

use crate::color::{BLUE, INK, ORANGE};
use crate::demo::{Context, Demo};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Options, Scene, render};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct CyclideToCone {
    /// Width of the frames in pixels
    #[arg(long, default_value_t = 480, value_parser = clap::value_parser!(u32).range(16..=4096))]
    frame_width: u32,
}

/// The fixed singular point is the origin; this is the other one, before it moves.
const MOVING: DVec3 = dvec3(3.0, 0.0, 0.0);
/// A sphere of the family.
const CENTRE: DVec3 = dvec3(1.5, 0.0, 1.55);
const RADIUS: f64 = 0.55;
const FRAMES: u32 = 48;
/// Surfaces are cut where they leave the ball of this radius about the fixed point.
const REACH: f64 = 40.0;

impl Demo for CyclideToCone {
    const NAME: &'static str = "cyclide-to-cone";
    const PAPER: &'static str = "mass-points-and-spheres, animation of Appendix A.3";
    const ABOUT: &'static str =
        "A horned cyclide becomes a cone as a singular point moves to infinity";

    fn run(&self, context: &mut Context) -> Result<()> {
        let sphere = Sphere::new(CENTRE, RADIUS)?;
        let horn = between_points(Point::ORIGIN, Point::new(MOVING)?, sphere.into())?.curve;
        let both = [horn, horn.complement()?];
        let width = if context.quick() {
            context.width().min(160)
        } else {
            self.frame_width
        };
        let options = Options {
            width,
            height: (width * 3).div_ceil(4),
            samples: context.samples().min(24),
            seed: context.seed(),
        };
        let camera = camera(context.aspect());
        let (mut frames, mut worst) = (Vec::new(), 0.0_f64);
        let bar = context.progress("frames", u64::from(FRAMES));
        for frame in 0..FRAMES {
            // Slow at both ends.
            let time = f64::from(frame) / f64::from(FRAMES - 1);
            let map = transversion(time * time * (3.0 - 2.0 * time))?;
            let surfaces = [both[0].mapped(&map)?, both[1].mapped(&map)?];
            worst = worst.max(implicit_residual(&surfaces)?);
            let scene = scene(&surfaces, camera.tolerance(DVec3::ZERO, options.height))?;
            frames.push(render(&scene, &camera, options, |_| ()).image());
            bar.inc(1);
        }
        bar.finish_and_clear();
        let map = transversion(1.0)?;
        let last = [both[0].mapped(&map)?, both[1].mapped(&map)?];
        context.number("frames", frames.len(), Target::exactly(FRAMES));
        context.number(
            "every_frame_implicit_max_residual",
            worst,
            Target::AtMost(1e-9),
        );
        context.number(
            "last_frame_cone_max_error",
            off_cone(&last)?,
            Target::AtMost(1e-9),
        );
        context.number(
            "last_frame",
            last[0].curve().classify().kind.name(),
            Target::exactly("circular cone"),
        );
        context.animation(
            "render",
            &frames,
            16,
            "48 frames: a Lorentz map moves one singular point of a horned cyclide to infinity.",
            "Animation: two crescents that meet in two points open and straighten to the two nappes of a cone.",
        )?;
        draw_first(context, &both, &camera)
    }
}

/// The Möbius map that fixes the origin with all directions there and takes `MOVING` to `MOVING / (1 - progress)`:
/// an inversion, a translation and the inversion again.
fn transversion(progress: f64) -> Result<LorentzMap> {
    let inversion = LorentzMap::inversion(Sphere::new(DVec3::ZERO, 1.0)?.into());
    let shift = LorentzMap::translation(-progress * MOVING / MOVING.length_squared())?;
    Ok(inversion * shift * inversion)
}

/// Largest value of the implicit equation of each surface at the vertices of its mesh, relative to its terms.
fn implicit_residual(surfaces: &[CanalCurve]) -> Result<f64> {
    let mut worst = 0.0_f64;
    for surface in surfaces {
        let implicit = surface.curve().implicit();
        let tube =
            surface.tessellate(&TubeGrid::new(48, 24).with_interval(0.0, visible(surface)))?;
        worst = tube
            .positions()
            .iter()
            .map(|p| implicit.residual(*p).abs())
            .fold(worst, f64::max);
    }
    Ok(worst)
}

/// Largest angle by which a vertex of the last frame is off the cone of elementary geometry: the lines through the
/// origin that touch the image of the sphere.
fn off_cone(surfaces: &[CanalCurve]) -> Result<f64> {
    let sphere = transversion(1.0)?.map_sphere(Sphere::new(CENTRE, RADIUS)?.into());
    let sphere = sphere
        .object()?
        .sphere()
        .context("the image of the sphere is a sphere")?;
    let axis = sphere.centre();
    let half_angle = (sphere.radius().abs() / axis.length()).asin();
    let mut worst = 0.0_f64;
    for surface in surfaces {
        let tube =
            surface.tessellate(&TubeGrid::new(48, 24).with_interval(0.05, visible(surface)))?;
        for p in tube.positions() {
            let angle = axis.cross(*p).length().atan2(axis.dot(*p).abs());
            worst = worst.max((angle - half_angle).abs());
        }
    }
    Ok(worst)
}

/// The last parameter up to which the surface stays within reach.
fn visible(surface: &CanalCurve) -> f64 {
    const LOOKS: u32 = 4096;
    let at = |i: u32| f64::from(i) / f64::from(LOOKS);
    let inside = |t: f64| {
        let circle = surface
            .at(t)
            .circle()
            .ok()
            .and_then(|circle| circle.circle());
        circle.is_some_and(|c| c.centre().length() + c.radius() < REACH)
    };
    // At its end the surface shrinks to a point: within reach if the last circle before it is.
    match (1..LOOKS).find(|&i| !inside(at(i))) {
        Some(first) => at(first - 1).max(at(1)),
        None => 1.0,
    }
}

fn camera(aspect: f64) -> Camera {
    Camera::look_at(dvec3(-1.5, -15.0, 4.0), dvec3(1.2, 0.0, -0.1), aspect)
}

fn scene(surfaces: &[CanalCurve; 2], tolerance: f64) -> Result<Scene> {
    let mut scene = Scene::new();
    for (surface, color) in surfaces.iter().zip([ORANGE, BLUE]) {
        scene.add(
            Mesh::canal(surface, [0.0, visible(surface)], tolerance)?,
            Material::glossy(color),
        )?;
    }
    scene.add(
        Mesh::sphere(DVec3::ZERO, 0.1, tolerance),
        Material::glossy(INK),
    )?;
    Ok(scene)
}

/// A frame in full size.
fn draw_first(context: &mut Context, both: &[CanalCurve; 2], camera: &Camera) -> Result<()> {
    let camera = scene(both, 0.05)?.camera(-camera.axes()[2], context.aspect());
    let scene = scene(both, 0.25 * camera.tolerance(DVec3::ZERO, context.height()))?;
    context.render(
        "render-cyclide",
        &scene,
        &camera,
        "The first frame: a horned cyclide, its two horns in two colours.",
        "Two crescents, orange above blue, that meet in two sharp points around an empty middle.",
    )
}
