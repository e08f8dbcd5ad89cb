//! The renderer: rays per second and the time to build its hierarchy, on one thread.
//!
//! `--mesh FILE.obj` also writes the mesh; with the camera in the result another renderer can be timed on
//! the same rays (`xtask/scripts/time_embree.py`, `xtask/scripts/time_povray.py`).

use std::hint::black_box;
use std::path::PathBuf;

use anyhow::Result;
use glam::{DVec3, Vec3A};
use serde_json::{Value, json};

use super::{Bench, Timer};
use crate::color::BLUE;
use crate::export::{Part, obj};
use crate::mesh::Mesh;
use crate::render::{Camera, Material, Options, Scene, render};

#[derive(clap::Args, Debug)]
pub(super) struct Render {
    /// Triangles, at least
    #[arg(long, default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(100..=20_000_000))]
    triangles: u32,
    /// Width of the picture in pixels; the height is three quarters of it
    #[arg(long, default_value_t = 1280, value_parser = clap::value_parser!(u32).range(16..=16384))]
    width: u32,
    /// Rays per pixel of the picture
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=4096))]
    samples: u32,
    /// Write the mesh, so that a peer can be timed on it
    #[arg(long, value_name = "FILE.obj")]
    mesh: Option<PathBuf>,
}

impl Bench for Render {
    const NAME: &'static str = "render";
    const ABOUT: &'static str = "Primary and shadow rays per second, BVH build, a whole picture";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let mesh = knot(self.triangles as usize);
        if let Some(path) = &self.mesh {
            std::fs::write(path, obj(&[Part::new("knot", &mesh, BLUE)])?)?;
        }
        let triangles = mesh.triangles.len();
        let mut scene = Scene::new();
        scene.add(mesh, Material::matte(BLUE))?;
        scene.ground_below();
        let camera = scene.camera(DVec3::new(0.3, -2.0, 1.2), 4.0 / 3.0);
        let (width, height) = (self.width, (self.width * 3).div_ceil(4));
        let accel = scene.accel();
        let directions = directions(&camera, width, height);
        let eye = accel.local(camera.eye());
        let primary = timer.nanoseconds(|| {
            directions
                .iter()
                .filter(|&&d| accel.trace(eye, d, 0.0).is_some())
                .count()
        });
        let starts: Vec<Vec3A> = directions
            .iter()
            .filter_map(|&d| {
                let hit = accel.trace(eye, d, 0.0)?;
                let towards_eye = if hit.plane.dot(d) > 0.0 {
                    -hit.plane
                } else {
                    hit.plane
                };
                Some(eye + d * hit.distance + towards_eye * 1e-4)
            })
            .collect();
        let light = Vec3A::new(-0.5, -0.4, 0.77).normalize();
        let shadow = timer.nanoseconds(|| {
            starts
                .iter()
                .filter(|&&s| accel.is_free(s, light, f32::INFINITY))
                .count()
        });
        let build = timer.nanoseconds(|| scene.accel());
        let options = Options {
            width,
            height,
            samples: self.samples,
            seed: 1,
        };
        let picture = timer
            .nanoseconds_of_all_threads(|| black_box(render(&scene, &camera, options, |_| ())));
        Ok(json!({
            "triangles": triangles,
            "hits_share": starts.len() as f64 / directions.len() as f64,
            "primary_mrays_per_second": directions.len() as f64 / primary * 1e3,
            "shadow_mrays_per_second": starts.len() as f64 / shadow * 1e3,
            "build_ms": build / 1e6,
            "picture_cpu_seconds": picture / 1e9,
            "eye": camera.eye().to_array(),
            "axes": camera.axes().map(|axis| axis.to_array()),
            "half_height": camera.half_height(),
        }))
    }
}

/// Unit directions through the middles of all pixels, row by row.
fn directions(camera: &Camera, width: u32, height: u32) -> Vec<Vec3A> {
    let [right, up, forward] = camera.axes();
    let step = 2.0 * camera.half_height() / f64::from(height);
    let at = |x: u32, y: u32| {
        let across = (f64::from(x) + 0.5 - 0.5 * f64::from(width)) * step;
        let down = (f64::from(y) + 0.5 - 0.5 * f64::from(height)) * step;
        (forward + right * across - up * down)
            .normalize()
            .as_vec3a()
    };
    (0..height)
        .flat_map(|y| (0..width).map(move |x| at(x, y)))
        .collect()
}

/// A trefoil knot as a tube with waves, of at least so many triangles.
fn knot(triangles: usize) -> Mesh {
    use std::f64::consts::TAU;
    let around = ((triangles as f64 / 20.0).sqrt().ceil() as usize).max(3);
    let curve = |t: f64| {
        let r = 2.0 + (3.0 * t).cos();
        DVec3::new(r * (2.0 * t).cos(), r * (2.0 * t).sin(), (3.0 * t).sin())
    };
    let position = |u: f64, v: f64| {
        let t = TAU * u;
        let tangent = (curve(t + 1e-4) - curve(t - 1e-4)).normalize();
        let across = tangent.cross(DVec3::Z).normalize();
        let (sin, cos) = (TAU * v).sin_cos();
        let radius = 0.55 + 0.04 * (40.0 * t).sin() * (5.0 * TAU * v).sin();
        curve(t) + radius * (across * cos + tangent.cross(across) * sin)
    };
    let h = 1e-4;
    Mesh::grid(10 * around, around, |u, v| {
        let du = position(u + h, v) - position(u - h, v);
        let dv = position(u, v + h) - position(u, v - h);
        (position(u, v), du.cross(dv).normalize_or(DVec3::Z))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn the_bench_runs_small() {
        let bench = Render {
            triangles: 500,
            width: 32,
            samples: 1,
            mesh: None,
        };
        let result = bench.run(&Timer::new(Duration::from_millis(2))).unwrap();
        assert!(result["triangles"].as_u64().unwrap() >= 500);
        assert!(result["primary_mrays_per_second"].as_f64().unwrap() > 0.0);
        assert!(result["hits_share"].as_f64().unwrap() > 0.1);
    }
}
