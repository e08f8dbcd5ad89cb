//! Evaluation of rational quadratics and biquadratic patches.

use std::hint::black_box;

use anyhow::Result;
use bezier_mass::{Biquadratic, MassPoint, bernstein};
use glam::{DVec3, dvec3};
use serde_json::{Value, json};

use super::{Bench, Timer};

#[derive(clap::Args, Debug)]
pub(super) struct BezierMass {
    /// Largest number of grid points on a side
    #[arg(long, default_value_t = 400)]
    side: usize,
}

impl Bench for BezierMass {
    const NAME: &'static str = "bezier-mass";
    const ABOUT: &'static str = "Evaluation of rational quadratics and biquadratic patches";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let patch = torus_quarter()?;
        let curve = patch.curve_at_u(0.37);
        let (u, v) = (0.37, 0.61);
        let mut rows = vec![
            json!({
                "work": "quadratic point",
                "ns": timer.nanoseconds(|| black_box(&curve).point(black_box(u))),
            }),
            json!({
                "work": "biquadratic point and normal",
                "ns": timer.nanoseconds(|| black_box(&patch).point_and_normal(black_box(u), v)),
            }),
        ];
        let (ours, plain, ratio) = timer.against(
            || black_box(&patch).point(black_box(u), black_box(v)),
            || plain_sum(black_box(&patch), black_box(u), black_box(v)),
        );
        rows.push(
            json!({ "work": "biquadratic point", "ns": ours, "peer": "plain Bernstein sum",
            "peer ns": plain, "ratio": ratio }),
        );
        // Four times the points each time: the time for a point should stay.
        for side in [
            self.side / 16,
            self.side / 8,
            self.side / 4,
            self.side / 2,
            self.side,
        ] {
            let side = side.max(2);
            let steps: Vec<f64> = (0..side).map(|i| i as f64 / (side - 1) as f64).collect();
            let points = (side * side) as f64;
            let grid = timer.nanoseconds(|| black_box(&patch).grid(&steps, &steps)) / points;
            let values =
                timer.nanoseconds(|| black_box(&patch).grid_values(&steps, &steps)) / points;
            rows.push(
                json!({ "work": "grid with normals", "points": points, "ns": grid,
                "million per second": 1e3 / grid }),
            );
            rows.push(
                json!({ "work": "grid of mass points", "points": points, "ns": values,
                "million per second": 1e3 / values }),
            );
        }
        Ok(json!({ "rows": rows }))
    }
}

/// A quarter of a quarter of a torus with radii 3 and 1.
fn torus_quarter() -> Result<Biquadratic<DVec3>> {
    let h = 0.5_f64.sqrt();
    let quarter = [(1.0, 0.0, 1.0), (1.0, 1.0, h), (0.0, 1.0, 1.0)];
    let net = quarter.map(|(c, s, weight)| {
        quarter.map(|(x, z, other)| {
            let radius = 3.0 + x;
            MassPoint::point(dvec3(radius * c, radius * s, z), weight * other)
        })
    });
    Ok(Biquadratic::new(net)?)
}

/// The nine terms added up with no regard to vanishing weights.
fn plain_sum(patch: &Biquadratic<DVec3>, u: f64, v: f64) -> DVec3 {
    let (b, c) = (bernstein::quadratic_basis(u), bernstein::quadratic_basis(v));
    let (mut weight, mut weighted) = (0.0, DVec3::ZERO);
    for (row, b) in patch.control().iter().zip(b) {
        for (h, c) in row.iter().zip(c) {
            weight += b * c * h.weight;
            weighted += b * c * h.weighted;
        }
    }
    weighted / weight
}
