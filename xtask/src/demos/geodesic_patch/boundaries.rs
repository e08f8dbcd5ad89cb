//! What the patches are built on: corner data, great circles, and sets of boundaries that must be refused.

use std::array::from_fn;

use anyhow::Result;
use bezier_mass::BezierCurve;
use glam::{DVec2, DVec3, dvec2, dvec3};
use reconstruct::{
    AnalyticCurve, BezierStrip, CornerData, Corners, Degree7Shape, Error, GeodesicStrip, Rectangle,
    Series, Triangle, degree7_boundaries,
};

use crate::demo::Context;
use crate::report::Target;

/// Corner data read off the graph `z = h (x² / 4 - y² / 6) + x y / 12` at a crooked quadrangle; the
/// directions of the boundaries are chosen in the tangent planes.
pub(super) fn corners(height: f64) -> Result<Corners, Error> {
    let at = |x: f64, y: f64, along_u: DVec2, along_v: DVec2| {
        let (a, b) = (height / 2.0, -height / 3.0);
        let z = 0.5 * (a * x * x + b * y * y) + x * y / 12.0;
        let (fx, fy) = (a * x + y / 12.0, b * y + x / 12.0);
        let second = [a, 1.0 / 12.0, b];
        let tangent = |d: DVec2| dvec3(d.x, d.y, fx * d.x + fy * d.y);
        let normal = dvec3(-fx, -fy, 1.0);
        // Normal curvature: second over first fundamental form.
        let curvature = |d: DVec2| {
            let bend = second[0] * d.x * d.x + 2.0 * second[1] * d.x * d.y + second[2] * d.y * d.y;
            bend / (normal.length() * tangent(d).length_squared())
        };
        let (u, v) = (tangent(along_u), tangent(along_v));
        CornerData::new(
            dvec3(x, y, z),
            normal,
            [u, v],
            [curvature(along_u), curvature(along_v)],
        )
    };
    Ok([
        [
            at(-1.5, -1.3, dvec2(1.0, 0.08), dvec2(-0.05, 1.0))?,
            at(-1.6, 1.4, dvec2(1.0, 0.1), dvec2(-0.1, 1.0))?,
        ],
        [
            at(1.6, -1.2, dvec2(1.0, -0.05), dvec2(0.05, 1.0))?,
            at(1.4, 1.6, dvec2(1.0, 0.02), dvec2(-0.08, 1.0))?,
        ],
    ])
}

pub(super) fn strips(curves: &[BezierCurve<DVec3>; 4]) -> Result<[BezierStrip; 4], Error> {
    let [a, b, c, d] = curves.clone().map(BezierStrip::new);
    Ok([a?, b?, c?, d?])
}

/// Three great circles of the unit sphere.
pub(super) fn triangle() -> Result<Triangle, Error> {
    let corners = [
        dvec3(1.0, 0.0, -0.2),
        dvec3(0.1, 1.0, -0.1),
        dvec3(0.25, 0.3, 0.9),
    ]
    .map(DVec3::normalize);
    let side = |k: usize| {
        let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
        let (across, angle) = ((b - a * a.dot(b)).normalize(), a.angle_between(b));
        GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
            let (sin, cos) = (t * angle).sin_cos();
            from_fn(|k| cos * a[k] + sin * across[k])
        }))
    };
    Triangle::new([side(0)?, side(1)?, side(2)?])
}

/// Boundaries that violate one condition each: every one must be refused, and by its name.
pub(super) fn bad_sets(
    context: &mut Context,
    corners: &Corners,
    curves: &[BezierCurve<DVec3>; 4],
) -> Result<()> {
    let moved = |index: usize, offset: DVec3| -> Result<[BezierCurve<DVec3>; 4]> {
        let mut points: Vec<DVec3> = curves[0]
            .control()
            .iter()
            .filter_map(|h| h.position())
            .collect();
        points[index] += offset;
        let mut damaged = curves.clone();
        damaged[0] = BezierCurve::polynomial(&points)?;
        Ok(damaged)
    };
    let [_, along_v] = corners[0][0].tangents();
    // The bend of one corner turned around makes the normal reverse once more (Fig. 3.18, right).
    let mut reversed = *corners;
    let corner = &corners[1][1];
    let [k, l] = corner.curvatures();
    reversed[1][1] = CornerData::new(corner.point(), corner.normal(), corner.tangents(), [-k, l])?;
    let twice = [
        curves[0].clone(),
        curves[0].clone(),
        curves[2].clone(),
        curves[3].clone(),
    ];
    let sets = [
        ("corner mismatch", moved(0, along_v * 0.05)?),
        ("C1", moved(2, along_v * 0.05)?),
        ("C3", moved(3, along_v * 0.05)?),
        (
            "C2",
            degree7_boundaries(&reversed, &Degree7Shape::default())?,
        ),
        ("parallel tangents", twice),
    ];
    let mut refused = 0;
    for (name, set) in &sets {
        if let Err(Error::Conditions(violations)) = Rectangle::new(strips(set)?) {
            refused += usize::from(violations.iter().any(|v| v.name() == *name));
        }
    }
    context.number("bad_sets", sets.len(), Target::exactly(5));
    context.number("bad_sets_refused", refused, Target::exactly(sets.len()));
    Ok(())
}
