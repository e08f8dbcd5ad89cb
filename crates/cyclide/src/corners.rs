//! Cyclide patches from the outside in: four concircular corners and the frame at one of them.

use crate::frame::place;
use crate::recognise::concyclicity;
use crate::{Condition, Error, inspect, tolerance};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;

/// The biquadratic net of the cyclide patch with four given corners and given edge directions at the first.
///
/// The corners `[P00, P02, P20, P22]` must lie on one circle; `along_row` and `along_column` are orthogonal directions of the edges to `P02` and to
/// `P20` at `P00` (any length). These data determine the patch: each edge is the arc with the given tangent, the frame at the next
/// corner is the reflection of the given one in the bisector plane of the edge's chord, and the weights follow. The result can be handed to
/// [`crate::convert`].
///
/// # Errors
///
/// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::Corners`] if the directions are not orthogonal, corners coincide, or an
/// edge is a full circle;
/// [`Error::NotAPatch`] if the corners are not on one circle.
///
/// # Examples
///
/// ```
/// use cyclide::{convert, patch_from_corners, glam::{DVec3, dvec3}};
/// let corners = [dvec3(0.0, 0.0, 0.0), dvec3(2.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(2.0, 1.0, 0.0)];
/// let net = patch_from_corners(corners, dvec3(2.0, 0.2, 0.8), dvec3(-0.3, 2.0, 0.25))?;
/// assert!(convert(&net)?.residual < 1e-10);
/// # Ok::<(), cyclide::Error>(())
/// ```
pub fn patch_from_corners(
    corners: [DVec3; 4],
    along_row: DVec3,
    along_column: DVec3,
) -> Result<Biquadratic<DVec3>, Error> {
    for vector in corners.into_iter().chain([along_row, along_column]) {
        place("corner data", vector)?;
    }
    let no_direction = Error::Corners {
        reason: "an edge direction is zero",
    };
    let along_row = along_row.try_normalize().ok_or(no_direction)?;
    let along_column = along_column.try_normalize().ok_or(no_direction)?;
    if along_row.dot(along_column).abs() > tolerance::NET {
        return Err(Error::Corners {
            reason: "the edge directions are not orthogonal",
        });
    }
    let [p00, p02, p20, p22] = corners;
    let coincide = Error::Corners {
        reason: "two corners coincide",
    };
    let mirror = |from: DVec3, to: DVec3| {
        (to - from)
            .try_normalize()
            .map(|chord| move |v: DVec3| v - 2.0 * v.dot(chord) * chord)
            .ok_or(coincide)
    };
    let (over_row, over_column) = (mirror(p00, p02)?, mirror(p00, p20)?);
    // Middle control of the arc that leaves `from` along `tangent` and ends in `to`: weight cos(span/2), a vector for a semicircle.
    let arc = |from: DVec3, tangent: DVec3, to: DVec3| {
        let length = from.distance(to);
        let weight = (to - from).dot(tangent) / length;
        MassPoint::from_homogeneous(weight, weight * from + 0.5 * length * tangent)
    };
    let (row, column) = (arc(p00, along_row, p02), arc(p00, along_column, p20));
    let root = p02.distance(p20) / p00.distance(p22);
    if !(root.is_finite() && root > 0.0) {
        return Err(coincide);
    }
    let far_column = arc(p02, over_row(along_column), p22) * root;
    let far_row = arc(p20, over_column(along_row), p22) * root;
    // The iso-curve from the middle of the first row to the middle of the last is an arc too; its middle control is that of the rows.
    let middle = |start: MassPoint<DVec3>, control: MassPoint<DVec3>, end: MassPoint<DVec3>| {
        start * 0.25 + control * 0.5 + end * 0.25
    };
    let corner_controls = [(p00, 1.0), (p02, 1.0), (p20, 1.0), (p22, root * root)]
        .map(|(at, weight)| MassPoint::point(at, weight));
    let [from, to] = [
        middle(corner_controls[0], row, corner_controls[1]),
        middle(corner_controls[2], far_row, corner_controls[3]),
    ];
    let collapse = Error::Corners {
        reason: "the edges fold back on themselves",
    };
    let (start, end) = (
        from.position().ok_or(collapse)?,
        to.position().ok_or(collapse)?,
    );
    let tangent = mirror(p00, start)?(along_column);
    let scale = (from.weight * to.weight).sqrt();
    let central = arc(start, tangent, end) * (2.0 * scale) - (column + far_column) * 0.5;
    if !(central.weight.is_finite() && central.weighted.is_finite()) {
        return Err(collapse);
    }
    let [start, row_end, column_end, end] = corner_controls;
    let net = Biquadratic::new([
        [start, row, row_end],
        [column, central, far_column],
        [column_end, far_row, end],
    ])?;
    let size = p00
        .distance(p02)
        .max(p00.distance(p20))
        .max(p00.distance(p22));
    let concyclic = concyclicity([p00, p02, p22, p20], size);
    if concyclic.is_nan() || concyclic > tolerance::NET {
        return Err(Error::NotAPatch {
            condition: Condition::ConcyclicCorners,
            residual: concyclic,
            allowed: tolerance::NET,
        });
    }
    // Controls at infinity, as of semicircular edges, cannot be judged as points; nor can those that only rounding keeps from there.
    let largest = largest_weight(&net);
    let are_points = net
        .control()
        .as_flattened()
        .iter()
        .all(|control| control.weight.abs() > NEAR_INFINITY * largest);
    if are_points {
        inspect(&net)?.check()?;
    }
    Ok(net)
}

/// Controls with a smaller share of the largest weight have lost too many digits as points.
const NEAR_INFINITY: f64 = 1e-6;

fn largest_weight(net: &Biquadratic<DVec3>) -> f64 {
    net.control()
        .as_flattened()
        .iter()
        .fold(0.0, |largest, control| control.weight.abs().max(largest))
}
