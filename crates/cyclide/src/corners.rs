//! Cyclide patches from the outside in: four concircular corners and the frame at one of them.

use crate::frame::place;
use crate::{Error, inspect, tolerance};
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
/// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::Corners`] if the directions are not orthogonal, corners coincide, or the tangent planes meet in no point;
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
    let normal = along_row.cross(along_column);
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
    let central = central_control(
        corners,
        [along_row, along_column],
        [over_row(normal), over_column(normal)],
    )?;
    let net = Biquadratic::new([
        [MassPoint::point(p00, 1.0), row, MassPoint::point(p02, 1.0)],
        [column, central, far_column],
        [
            MassPoint::point(p20, 1.0),
            far_row,
            MassPoint::point(p22, root * root),
        ],
    ])?;
    // Semicircular edges have controls at infinity, which the point conditions cannot judge.
    if let Ok(report) = inspect(&net) {
        report.check()?;
    }
    Ok(net)
}

/// The control where the corners' tangent planes meet, with its weight.
fn central_control(
    [p00, p02, p20, _]: [DVec3; 4],
    [along_row, along_column]: [DVec3; 2],
    normals: [DVec3; 2],
) -> Result<MassPoint<DVec3>, Error> {
    // P11 = P00 + x along_row + y along_column in the tangent planes at P02 and P20.
    let equations = [(normals[0], p02), (normals[1], p20)].map(|(normal, corner)| {
        (
            normal.dot(along_row),
            normal.dot(along_column),
            normal.dot(corner - p00),
        )
    });
    let [(a, b, e), (c, d, f)] = equations;
    let determinant = a * d - b * c;
    if determinant.abs() <= tolerance::NET * tolerance::NET {
        return Err(Error::Corners {
            reason: "the tangent planes of the corners meet in no point",
        });
    }
    let (x, y) = ((e * d - b * f) / determinant, (a * f - e * c) / determinant);
    let (row, column) = (p02 - p00, p20 - p00);
    // The weight of the biquadratic conditions with lambda = x / (row / 2 cos), nu likewise, written without dividing by cosines.
    let inverse_row = 2.0 * row.dot(along_row) / row.length_squared();
    let inverse_column = 2.0 * column.dot(along_column) / column.length_squared();
    let weight = row.length() * column.length() / (4.0 * x * y)
        * (x * inverse_row + y * inverse_column - 1.0);
    if !weight.is_finite() {
        return Err(Error::Corners {
            reason: "the central control lies on an edge tangent",
        });
    }
    Ok(MassPoint::point(
        p00 + x * along_row + y * along_column,
        weight,
    ))
}
