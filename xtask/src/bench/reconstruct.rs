//! Ribbons frame by frame, and patches.

use std::hint::black_box;

use anyhow::Result;
use bezier_mass::BezierCurve;
use glam::{DVec3, dvec3};
use reconstruct::{
    AnalyticCurve, BezierStrip, CornerData, Corners, Criterion, Degree7Shape, GeodesicStrip,
    Rectangle, RibbonStream, degree7_boundaries,
};
use serde_json::{Value, json};

use super::{Bench, Timer};
use crate::demos::alternating;

#[derive(clap::Args, Debug)]
pub(super) struct Reconstruct {
    /// Largest number of sensors
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(8..=100_000))]
    sensors: u32,
}

impl Bench for Reconstruct {
    const NAME: &'static str = "reconstruct";
    const ABOUT: &'static str =
        "Frames of ribbon sensors, smoothing of rectangles, construction of patches";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let mut rows = Vec::new();
        let mut sensors = 8;
        while sensors <= self.sensors as usize {
            let (mut stream, readings) = ribbon(sensors)?;
            let ns = timer.nanoseconds(|| {
                stream
                    .frame(black_box(&readings))
                    .map(|points| points[points.len() - 1])
            });
            rows.push(json!({ "work": "frame", "sensors": sensors, "µs": ns / 1e3, "ns per sensor": ns / sensors as f64 }));
            sensors *= 2;
        }
        let cylinder = cylinder()?;
        let curves = degree7_boundaries(&corners()?, &Degree7Shape::default())?;
        let bezier = Rectangle::new(strips(&curves)?)?;
        let mut push = |work: &str, ns: f64| rows.push(json!({ "work": work, "µs": ns / 1e3 }));
        push(
            "rectangle of helices: conditions and patch",
            timer.nanoseconds(|| {
                Rectangle::new(black_box(cylinder.clone())).and_then(|r| r.patch([[0.0; 2]; 4]))
            }),
        );
        push(
            "rectangle of degree 7: conditions and patch",
            timer.nanoseconds(|| {
                strips(black_box(&curves))
                    .and_then(Rectangle::new)
                    .and_then(|r| r.patch([[0.0; 2]; 4]))
            }),
        );
        let patch = bezier.patch([[0.0; 2]; 4])?;
        push(
            "its control net, bidegree 13",
            timer.nanoseconds(|| black_box(&patch).to_bezier()),
        );
        push(
            "boundaries of degree 7",
            timer.nanoseconds(|| {
                corners().and_then(|c| degree7_boundaries(&c, &Degree7Shape::default()))
            }),
        );
        let helices = Rectangle::new(cylinder.clone())?;
        for (criterion, name) in [
            (Criterion::Dirichlet, "Dirichlet"),
            (Criterion::ThinPlate, "thin plate"),
            (Criterion::SpeedVariation, "speed variation"),
        ] {
            push(
                &format!("smoothing of helices, {name}"),
                timer.nanoseconds(|| black_box(&helices).smoothest(criterion)),
            );
        }
        Ok(json!({ "rows": rows }))
    }
}

/// An alternating ribbon along a helix.
fn ribbon(sensors: usize) -> Result<(RibbonStream, Vec<DVec3>)> {
    alternating(sensors, 4.0, |s| dvec3(-0.6 * s.sin(), 0.6 * s.cos(), 0.8))
}

/// Four helices on the unit cylinder.
fn cylinder() -> Result<[GeodesicStrip; 4], reconstruct::Error> {
    let corners = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.25, 1.15]];
    let helix = |a: usize, b: usize| {
        GeodesicStrip::new(AnalyticCurve::new(move |t| {
            let [angle, height] =
                [0, 1].map(|k| t * (corners[b][k] - corners[a][k]) + corners[a][k]);
            let (sin, cos) = angle.sin_cos();
            [cos, sin, height]
        }))
    };
    Ok([helix(0, 1)?, helix(0, 2)?, helix(2, 3)?, helix(1, 3)?])
}

/// Corners on the paraboloid `z = (x² + y²) / 4`.
fn corners() -> Result<Corners, reconstruct::Error> {
    let at = |x: f64, y: f64| {
        let (u, v) = (dvec3(1.0, 0.0, 0.5 * x), dvec3(0.0, 1.0, 0.5 * y));
        let normal = u.cross(v);
        let curvature = |t: DVec3| 0.5 / (normal.length() * t.length_squared());
        CornerData::new(
            dvec3(x, y, 0.25 * (x * x + y * y)),
            normal,
            [u, v],
            [curvature(u), curvature(v)],
        )
    };
    Ok([
        [at(0.1, -0.2)?, at(0.0, 1.1)?],
        [at(1.2, 0.0)?, at(1.0, 1.0)?],
    ])
}

fn strips(curves: &[BezierCurve<DVec3>; 4]) -> Result<[BezierStrip; 4], reconstruct::Error> {
    let [a, b, c, d] = curves.clone().map(BezierStrip::new);
    Ok([a?, b?, c?, d?])
}
