//! Straightest geodesics from a point in all directions, by the classical rule and by the one that follows vertex normals.
//!
//! What one sees: two coarse balls of flat facets, each seen from the side of the point opposite to the one where thin
//! red lines set out. On the first ball, by the classical rule, the lines arrive scattered about the opposite point; on
//! the second, which knows the normals of the sphere, they all run into it. The chart shows the end error on an
//! ellipsoid against the edge length: the normals make it fall by four when the edges are halved.

use std::f64::consts::{PI, TAU};

use anyhow::{Context as _, Result};
use geodesic::{Mesh as Surface, Straightest as Tracer, SurfacePoint, TriangleSoup, shapes};
use glam::{DAffine3, DQuat, DVec2, DVec3};

use crate::color::{BLUE, GREY, INK, MIST, VERMILION};
use crate::demo::{Context, Demo};
use crate::figure::{Figure, Marker, Plot};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Scene};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Straightest {
    /// How often the faces of the icosahedron in the picture are cut in four
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=6))]
    level: u32,
    /// Number of rays
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=720))]
    rays: u32,
}

/// Semi-axes of the ellipsoid on which the order is measured.
const AXES: DVec3 = DVec3::new(1.5, 1.0, 0.8);
/// Arc length of the traces there.
const LENGTH: f64 = 2.5;

impl Demo for Straightest {
    const NAME: &'static str = "straightest";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Fig. 2.13";
    const ABOUT: &'static str = "Rays from a point on a coarse sphere: the classical rule, and the one that follows normals";

    fn run(&self, context: &mut Context) -> Result<()> {
        let sphere = shapes::sphere(self.level)?;
        let classical = Tracer::new(&sphere);
        let aware = Tracer::new(&sphere).with_normals(sphere.positions())?;
        self.close(context, &sphere, &classical, &aware)?;
        self.draw(context, &sphere, [&classical, &aware])?;
        converge(context)
    }
}

impl Straightest {
    /// How far rays miss their start after a turn round the sphere.
    fn close(
        &self,
        context: &mut Context,
        sphere: &Surface,
        classical: &Tracer<'_>,
        aware: &Tracer<'_>,
    ) -> Result<()> {
        let start = sphere.face_point(7, [0.5, 0.3, 0.2])?;
        let worst = |tracer: &Tracer<'_>| -> Result<f64> {
            let mut worst = 0.0_f64;
            for direction in fan(sphere.point_position(start)?, self.rays) {
                let trace = tracer.trace(start, 7, direction, 1.06 * TAU)?;
                let (_, gap) = trace
                    .nearest_return(PI)
                    .context("the trace is long enough")?;
                worst = worst.max(gap);
            }
            Ok(worst)
        };
        let (aware, classical) = (worst(aware)?, worst(classical)?);
        context.number("great_circle_closing_error", aware, Target::AtMost(1e-13));
        context.number(
            "classical_closing_error",
            classical,
            Target::AtLeast(1e3 * aware.max(1e-16)),
        );
        Ok(())
    }

    fn draw(
        &self,
        context: &mut Context,
        sphere: &Surface,
        tracers: [&Tracer<'_>; 2],
    ) -> Result<()> {
        let face = 7;
        let start = sphere.face_point(face, [1.0 / 3.0; 3])?;
        let pole = sphere.point_position(start)?.normalize();
        // The opposite point is turned towards the viewer.
        let towards_eye = DVec3::new(0.0, -1.0, 0.25);
        let turn = DQuat::from_rotation_arc(-pole, towards_eye.normalize());
        let mut scene = Scene::new();
        let facets = Mesh::faceted(sphere.positions(), sphere.faces());
        let mut around = Vec::new();
        for (k, tracer) in tracers.into_iter().enumerate() {
            let place =
                DAffine3::from_rotation_translation(turn, (2.3 * k as f64 - 1.15) * DVec3::X);
            scene.add(facets.clone().transformed(place), Material::matte(MIST))?;
            around.extend(
                sphere
                    .positions()
                    .iter()
                    .map(|p| place.transform_point3(*p)),
            );
            let mut tubes = Mesh::default();
            for direction in fan(sphere.point_position(start)?, self.rays) {
                let trace = tracer.trace(start, face, direction, PI)?;
                tubes.append(Mesh::tube(&lifted(&trace.positions, place), 0.01, false));
            }
            scene.add(
                tubes,
                Material::matte(if k == 0 { VERMILION } else { BLUE }),
            )?;
            scene.add(
                Mesh::sphere(place.transform_point3(-pole), 0.03, 1e-4),
                Material::glossy(INK),
            )?;
        }
        scene.ground_below();
        let camera = Camera::fit(&around, towards_eye, context.aspect_or(1.9));
        context.render(
            "render",
            &scene,
            &camera,
            "Rays of length π from the far side of a coarse sphere. Left, unfolding alone: they miss the opposite point \
             (black). Right, with the sphere's normals: they meet there.",
            "Two faceted balls; red lines end scattered on the first, blue lines run into one point on the second.",
        )
    }
}

/// Directions all round in the tangent plane of the unit sphere at `point`.
fn fan(point: DVec3, rays: u32) -> impl Iterator<Item = DVec3> {
    let (x, y) = point.normalize().any_orthonormal_pair();
    (0..rays).map(move |k| {
        // Not symmetric about anything on the mesh.
        let angle = 0.1 + TAU * f64::from(k) / f64::from(rays);
        angle.cos() * x + angle.sin() * y
    })
}

/// Points moved, without repetition, and a little off the facets so that a thin tube is seen whole.
fn lifted(points: &[DVec3], place: DAffine3) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = points
        .iter()
        .map(|p| place.transform_point3(*p * 1.004))
        .collect();
    kept.dedup_by(|a, b| a.distance(*b) < 1e-9);
    kept
}

/// End errors on an ellipsoid, level by level.
fn converge(context: &mut Context) -> Result<()> {
    let levels: Vec<u32> = (2..=context.pick(6, 5)).collect();
    let (mut classical, mut aware) = (Vec::new(), Vec::new());
    for &level in &levels {
        let mesh = ellipsoid(level)?;
        let normals: Vec<DVec3> = mesh
            .positions()
            .iter()
            .map(|p| *p / (AXES * AXES))
            .collect();
        let tracers = [
            Tracer::new(&mesh),
            Tracer::new(&mesh).with_normals(&normals)?,
        ];
        let mut errors = [0.0; 2];
        let mut count = 0.0;
        for v in 0..12 {
            let start = mesh.positions()[v as usize];
            let normal = (start / (AXES * AXES)).normalize();
            for direction in fan(normal, 4) {
                let end = smooth_end(start, direction);
                for (error, tracer) in errors.iter_mut().zip(&tracers) {
                    let from = SurfacePoint::Vertex(v);
                    let face = tracer
                        .face_towards(from, direction)
                        .context("a face in this direction")?;
                    let trace = tracer.trace(from, face, direction, LENGTH)?;
                    *error += trace.positions.last().map_or(f64::NAN, |p| p.distance(end));
                }
                count += 1.0;
            }
        }
        classical.push(errors[0] / count);
        aware.push(errors[1] / count);
    }
    let steps = (levels.len() - 2) as f64;
    let order = (aware[1] / aware[aware.len() - 1]).log2() / steps;
    context.number("levels", levels.clone(), Target::Free);
    context.number(
        "ellipsoid_errors_classical",
        classical.clone(),
        Target::Free,
    );
    context.number("ellipsoid_errors", aware.clone(), Target::Free);
    context.number("ellipsoid_order", order, Target::within(2.0, 0.3));

    let mut plot = Plot::chart(
        "",
        "edges along a side of the icosahedron",
        "mean end error after length 2.5",
    );
    plot.log_x().log_y();
    let series = |errors: &[f64]| -> Vec<DVec2> {
        levels
            .iter()
            .zip(errors)
            .map(|(&level, &e)| DVec2::new(f64::from(1 << level), e))
            .collect()
    };
    for (errors, color, name) in [
        (&classical, VERMILION, "classical rule"),
        (&aware, BLUE, "exact normals"),
    ] {
        plot.polyline(&series(errors), color.line().width(2.0).label(name));
        plot.points(&series(errors), Marker::Disc, color.fill());
    }
    let slope: Vec<f64> = levels
        .iter()
        .map(|&level| 0.5 * aware[0] / f64::from(1 << (2 * (level - levels[0]))))
        .collect();
    plot.polyline(&series(&slope), GREY.line().dashed().label("order 2"));
    context.figure(
        "figure",
        &Figure::new(plot),
        "End error on the ellipsoid with semi-axes 1.5, 1 and 0.8, mean of 48 rays.",
        "A chart with two falling lines; the lower one is parallel to a dashed line of slope 2.",
    )
}

fn ellipsoid(level: u32) -> Result<Surface> {
    let mut soup = TriangleSoup::from(shapes::sphere(level)?);
    soup.positions.iter_mut().for_each(|p| *p *= AXES);
    Ok(soup.try_into()?)
}

/// End of the smooth geodesic of the ellipsoid, by the fourth-order Runge-Kutta method on
/// x'' = -(x'.H x') n / |∇F|, H = diag(1/a²) and ∇F = H x.
fn smooth_end(start: DVec3, direction: DVec3) -> DVec3 {
    let acceleration = |x: DVec3, v: DVec3| {
        let gradient = x / (AXES * AXES);
        -(v.dot(v / (AXES * AXES)) / gradient.length_squared()) * gradient
    };
    let steps = 2000;
    let h = LENGTH / f64::from(steps);
    let (mut x, mut v) = (start, direction.normalize());
    for _ in 0..steps {
        let (k1, l1) = (v, acceleration(x, v));
        let (k2, l2) = (
            v + h / 2.0 * l1,
            acceleration(x + h / 2.0 * k1, v + h / 2.0 * l1),
        );
        let (k3, l3) = (
            v + h / 2.0 * l2,
            acceleration(x + h / 2.0 * k2, v + h / 2.0 * l2),
        );
        let (k4, l4) = (v + h * l3, acceleration(x + h * k3, v + h * l3));
        x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        v += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
    x
}
