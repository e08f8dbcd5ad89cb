//! The curves that are timed, all of size 100, and the inputs on which offset code goes astray.

use anyhow::Result;
use glam::{DVec2, dvec2};
use ph_curves::{CubicPath, Error};

/// The extent of the curves; tolerances and errors are relative to it.
pub(super) const SIZE: f64 = 100.0;
/// The offset distance.
pub(super) const DISTANCE: f64 = 5.0;

/// A cubic of moderate curvature, one with an inflection, a spiral of 20 spans, a closed loop of 40.
pub(super) fn curves() -> Result<Vec<(&'static str, CubicPath)>> {
    let spiral: Vec<DVec2> = (0..23)
        .map(|k| DVec2::from_angle(0.45 * f64::from(k)) * (12.0 + 1.75 * f64::from(k)))
        .collect();
    let wavy: Vec<DVec2> = (0..40)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 40.0;
            let radius = 42.0 + 5.0 * (3.0 * angle).sin() + 3.0 * (7.0 * angle + 1.0).cos();
            DVec2::from_angle(angle) * radius
        })
        .collect();
    Ok(vec![
        (
            "a",
            cubic([(0.0, 0.0), (20.0, 70.0), (80.0, 70.0), (100.0, 0.0)])?,
        ),
        (
            "b",
            cubic([(0.0, 0.0), (40.0, 60.0), (60.0, -60.0), (100.0, 0.0)])?,
        ),
        ("c", CubicPath::uniform_bspline(&spiral, false)?),
        ("d", CubicPath::uniform_bspline(&wavy, true)?),
    ])
}

fn cubic(control: [(f64, f64); 4]) -> Result<CubicPath, Error> {
    CubicPath::new(vec![control.map(DVec2::from)], false)
}

/// One cubic at which offset code goes astray, at size 100, and by how much it is moved and then scaled.
pub(super) struct Degenerate {
    pub(super) name: &'static str,
    pub(super) control: [(f64, f64); 4],
    /// The offset distance at size 100.
    pub(super) distance: f64,
    pub(super) origin: DVec2,
}

impl Degenerate {
    /// The control points at a size of `100 * scale`.
    pub(super) fn control(&self, scale: f64) -> [DVec2; 4] {
        self.control.map(|p| (DVec2::from(p) + self.origin) * scale)
    }
}

/// Radius of the quarter circle whose offset is its centre.
const RADIUS: f64 = 100.0;
/// Control length of the cubic of a quarter circle.
const QUARTER: f64 = 0.552_284_749_830_793_4 * RADIUS;

/// The inputs that are known to go wrong elsewhere.
pub(super) const DEGENERATE: [Degenerate; 11] = {
    const fn at(name: &'static str, control: [(f64, f64); 4]) -> Degenerate {
        Degenerate {
            name,
            control,
            distance: DISTANCE,
            origin: DVec2::ZERO,
        }
    }
    [
        at(
            "cusp in the offset",
            [(0.0, 0.0), (55.0, 60.0), (45.0, 60.0), (100.0, 0.0)],
        ),
        at(
            "zero derivative at the start",
            [(0.0, 0.0), (0.0, 0.0), (60.0, 80.0), (100.0, 0.0)],
        ),
        at(
            "zero derivatives at both ends",
            [(0.0, 0.0), (0.0, 0.0), (100.0, 30.0), (100.0, 30.0)],
        ),
        at(
            "near-cusp",
            [(0.0, 0.0), (100.0, 100.0001), (0.0, 100.0), (100.0, 0.0)],
        ),
        at(
            "interior cusp",
            [(0.0, 0.0), (100.0, 100.0), (0.0, 100.0), (100.0, 0.0)],
        ),
        at(
            "collinear",
            [(0.0, 0.0), (20.0, 10.0), (70.0, 35.0), (100.0, 50.0)],
        ),
        at(
            "collinear with turn-back",
            [(0.0, 0.0), (150.0, 0.0), (-50.0, 0.0), (100.0, 0.0)],
        ),
        at("all points equal", [(3.0, 1.0); 4]),
        at(
            "closed onto itself",
            [(0.0, 0.0), (100.0, 80.0), (100.0, 80.0), (0.0, 0.0)],
        ),
        Degenerate {
            distance: -RADIUS,
            ..at(
                "onto the centre of an arc",
                [
                    (RADIUS, 0.0),
                    (RADIUS, QUARTER),
                    (QUARTER, RADIUS),
                    (0.0, RADIUS),
                ],
            )
        },
        Degenerate {
            origin: dvec2(1e9, -1e9),
            ..at(
                "origin moved by 1e9",
                [(0.0, 0.0), (20.0, 70.0), (80.0, 70.0), (100.0, 0.0)],
            )
        },
    ]
};
