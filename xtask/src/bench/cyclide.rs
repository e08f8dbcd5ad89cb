//! Cyclides: points, parameters, rays (with a tessellation of the same surface beside), conversion, blends.

use std::hint::black_box;

use anyhow::{Result, anyhow};
use cyclide::{Cone, Dupin, Frame, RayCaster, RingPreference, classify, convert, convert_torus};
use glam::{DVec3, dvec3};
use serde_json::{Value, json};

use super::{Bench, Timer};
use crate::color::GREY;
use crate::mesh::Mesh;
use crate::render::{Material, Scene};

#[derive(clap::Args, Debug)]
pub(super) struct Cyclide {
    /// Rays in a batch
    #[arg(long, default_value_t = 4096)]
    rays: usize,
}

impl Bench for Cyclide {
    const NAME: &'static str = "cyclide";
    const ABOUT: &'static str =
        "Points, parameters and rays of a ring cyclide, conversion of patches, blends of cones";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
        let patch = ring.patch([0.3, 1.7], [0.4, 1.9])?;
        let torus = Dupin::torus(3.0, 1.0, Frame::WORLD)?
            .patch([0.3, 1.7], [0.4, 1.9])?
            .net()
            .transposed();
        let point = ring.point(0.7, 1.9);
        let axis = dvec3(0.3, 0.95, 0.0).normalize();
        let cones = [
            Cone::cylinder(DVec3::ZERO, DVec3::X, 1.0)?,
            Cone::new(-axis / 0.4_f64.sin(), axis, 0.4)?,
        ];
        let family = *classify(&cones[0], &cones[1])
            .families()
            .first()
            .ok_or_else(|| anyhow!("no family"))?;
        let mut rows = vec![
            json!({"work": "patch point", "ns": timer.nanoseconds(|| black_box(&patch).net().point(black_box(0.3), 0.6))}),
            json!({"work": "parameters of a point", "ns": timer.nanoseconds(|| ring.parameters_at(black_box(point)))}),
            json!({"work": "closest point", "ns": timer.nanoseconds(|| ring.closest(black_box(dvec3(4.3, -1.2, 0.9))))}),
            json!({"work": "conversion of a patch", "ns": timer.nanoseconds(|| convert(black_box(patch.net())))}),
            json!({"work": "conversion by Algorithm 1", "ns": timer.nanoseconds(|| convert_torus(black_box(&torus), None))}),
            json!({"work": "classification of two cones", "ns": timer.nanoseconds(|| classify(black_box(&cones[0]), &cones[1]))}),
            json!({"work": "one blend", "ns": timer.nanoseconds(|| family.blend(black_box(1.3)))}),
            json!({"work": "classification and widest ring", "ns": timer.nanoseconds(|| {
                classify(black_box(&cones[0]), &cones[1]).families().first().map(|family| family.ring_blend(RingPreference::Widest))
            })}),
        ];
        self.rays(timer, ring, &mut rows)?;
        Ok(json!({ "rows": rows }))
    }
}

impl Cyclide {
    /// Rays from a sphere around the ring to points of its box; about two thirds of them meet it.
    fn rays(&self, timer: &Timer, ring: Dupin, rows: &mut Vec<Value>) -> Result<()> {
        let mut state = 1_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
        };
        let rays: Vec<(DVec3, DVec3)> = (0..self.rays.max(1))
            .map(|_| {
                let from = dvec3(unit(), unit(), unit()).normalize() * 9.0;
                let to = dvec3(unit(), unit(), unit()) * 4.0;
                (from, (to - from).normalize())
            })
            .collect();
        let count = rays.len() as f64;
        let mut caster = RayCaster::new(ring);
        let mut hits = 0_usize;
        let mut residual = 0.0_f64;
        for &(origin, direction) in &rays {
            for hit in caster.intersect(origin, direction)?.iter() {
                hits += 1;
                residual =
                    residual.max(ring.implicit(origin + hit.s * direction).abs() / 6.0_f64.powi(4));
            }
        }
        let exact = timer.nanoseconds(|| {
            rays.iter()
                .filter_map(|&(origin, direction)| caster.intersect(origin, direction).ok())
                .map(|found| found.len())
                .sum::<usize>()
        }) / count;
        rows.push(json!({
            "work": "all hits of a ray", "ns": exact, "million per second": 1e3 / exact, "hits per ray": hits as f64 / count,
            "residual": residual,
        }));
        // The nearest hit with triangles of the same surface, for several finenesses.
        for steps in [60_usize, 240, 960] {
            let turn = std::f64::consts::TAU;
            let mesh = Mesh::grid(2 * steps, steps, |u, v| {
                (
                    ring.point(turn * u, turn * v),
                    ring.normal(turn * u, turn * v),
                )
            });
            let mut worst = 0.0_f64;
            for (i, j) in (0..200).flat_map(|i| (0..7).map(move |j| (i, j))) {
                let triangle = mesh.triangles[(i * 7919 + j * 104_729) % mesh.triangles.len()];
                let middle = triangle
                    .iter()
                    .map(|&k| mesh.positions[k as usize])
                    .sum::<DVec3>()
                    / 3.0;
                worst = worst.max(ring.signed_distance(middle)?.abs());
            }
            let triangles = mesh.triangles.len();
            let mut scene = Scene::new();
            scene.add(mesh, Material::matte(GREY))?;
            let accel = scene.accel();
            let local: Vec<_> = rays
                .iter()
                .map(|&(origin, direction)| (accel.local(origin), direction.as_vec3a()))
                .collect();
            let traced = timer.nanoseconds(|| {
                local
                    .iter()
                    .filter(|&&(origin, direction)| accel.trace(origin, direction, 0.0).is_some())
                    .count()
            }) / count;
            rows.push(json!({
                "work": "nearest hit by obvhs", "triangles": triangles, "ns": traced, "million per second": 1e3 / traced,
                "off the surface by": worst, "ratio": exact / traced,
            }));
        }
        Ok(())
    }
}
