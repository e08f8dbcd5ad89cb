//! Canal surfaces: constructions, and vertices with normals per second.

use std::hint::black_box;

use anyhow::Result;
use glam::{DVec3, dvec3};
use lorentz::construct::{circle_to_sphere, cone};
use lorentz::{
    CanalCurve, Plane, Point, Spacing, Sphere, SphereVector, SurfacePoint, Tube, TubeGrid,
};
use serde_json::{Value, json};

use super::{Bench, Timer};

#[derive(clap::Args, Debug)]
pub(super) struct Lorentz {
    /// Largest number of steps along the surface
    #[arg(long, default_value_t = 4096)]
    steps: usize,
    /// Vertices around each ring
    #[arg(long, default_value_t = 64)]
    sectors: usize,
}

impl Bench for Lorentz {
    const NAME: &'static str = "lorentz";
    const ABOUT: &'static str =
        "Canal surfaces: constructions, joints, vertices with normals per second";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let (start, equator, end) = data()?;
        let arc = circle_to_sphere(start, equator, end)?.curve;
        let (first, second) = arc.subdivide(0.4)?;
        let (vertex, ball) = (
            dvec3(-8.0, 0.0, 14.0),
            Sphere::new(dvec3(2.0, 0.0, 16.0), 2.0)?,
        );
        let mut rows = vec![
            json!({ "work": "arc from circle and sphere",
                "ns": timer.nanoseconds(|| circle_to_sphere(black_box(start), equator, end)) }),
            json!({ "work": "cone from vertex and sphere",
                "ns": timer.nanoseconds(|| cone(black_box(vertex), ball)) }),
            json!({ "work": "joint measured", "ns": timer.nanoseconds(|| black_box(&first).joint_with(&second)) }),
            json!({ "work": "kind found", "ns": timer.nanoseconds(|| black_box(&arc).curve().classify()) }),
            json!({ "work": "second family", "ns": timer.nanoseconds(|| black_box(&arc).second_family().conic()) }),
        ];
        let mut tube = Tube::default();
        for steps in [
            self.steps / 256,
            self.steps / 64,
            self.steps / 16,
            self.steps / 4,
            self.steps,
        ] {
            let steps = steps.max(1);
            for (work, spacing) in [
                ("equal parameters", Spacing::Parameter),
                ("equal distances", Spacing::ArcLength),
            ] {
                let grid = TubeGrid::new(steps, self.sectors).with_spacing(spacing);
                let vertices = ((steps + 1) * self.sectors) as f64;
                let (ns, plain, ratio) = timer.against(
                    || black_box(&arc).tessellate_into(&grid, &mut tube),
                    || point_by_point(black_box(&arc), &grid),
                );
                rows.push(
                    json!({ "work": work, "vertices": vertices, "ns": ns / vertices,
                    "million per second": 1e3 * vertices / ns,
                    "peer": "point by point", "peer ns": plain / vertices, "ratio": ratio }),
                );
            }
        }
        let grid = TubeGrid::new(200, self.sectors);
        arc.tessellate_into(&grid, &mut tube)?;
        Ok(
            json!({ "rows": rows, "greatest distance from the envelope over the radius": off_envelope(&arc, &tube)? }),
        )
    }
}

/// A piece of a ring cyclide.
fn data() -> Result<(SphereVector, SphereVector, SphereVector)> {
    let start = Sphere::new(DVec3::ZERO, 1.0)?;
    let equator = Plane::new(DVec3::Z, DVec3::ZERO)?;
    let end = Sphere::new(dvec3(4.0, 0.0, 1.0), 1.5)?;
    Ok((start.into(), equator.into(), end.into()))
}

/// The same vertices one by one, with a frame, a sine and a cosine for each.
fn point_by_point(arc: &CanalCurve, grid: &TubeGrid) -> Result<Vec<SurfacePoint>, lorentz::Error> {
    let reference = arc.reference();
    let mut points = Vec::with_capacity((grid.steps + 1) * grid.sectors);
    for i in 0..=grid.steps {
        let member = arc.at(i as f64 / grid.steps as f64);
        for j in 0..grid.sectors {
            let angle = std::f64::consts::TAU * (j as f64 / grid.sectors as f64);
            points.push(member.surface_point(angle, reference)?);
        }
    }
    Ok(points)
}

/// How far the vertices are from their spheres and from the planes of their circles, in radii.
fn off_envelope(arc: &CanalCurve, tube: &Tube) -> Result<f64> {
    let mut worst = 0.0_f64;
    for (t, ring) in tube
        .parameters()
        .iter()
        .zip(tube.positions().chunks_exact(tube.sectors()))
    {
        let member = arc.at(*t);
        let (Some(sphere), Some(circle)) = (member.sphere(), member.circle()?.circle()) else {
            continue;
        };
        for p in ring {
            let off_sphere =
                sphere.product_with_point(Point::new(*p)?).abs() * sphere.curvature().abs();
            let off_circle = (*p - circle.centre()).dot(circle.axis()).abs() / circle.radius();
            worst = worst.max(off_sphere).max(off_circle);
        }
    }
    Ok(worst)
}
