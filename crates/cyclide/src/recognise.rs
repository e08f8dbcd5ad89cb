//! What makes a biquadratic net the net of a cyclide patch: PG1 to PG4 and the weights.

use crate::frame::{finite, place};
use crate::patch::normalise;
use crate::{Error, tolerance};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;
use std::fmt;

/// The conditions on the nets of cyclide patches, in the order in which they are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Condition {
    /// PG1: the four corners lie on one circle.
    ConcyclicCorners,
    /// PG2: the middle control of each edge is equally far from its ends.
    EqualEdges,
    /// PG3: the edges meet at right angles.
    RightAngles,
    /// PG4: the central control lies in the tangent planes of all corners.
    CornerPlanes,
    /// The weight of the fourth corner follows from the diagonals of the corner quadrilateral.
    FourthCornerWeight,
    /// The edges are circular arcs.
    EdgeWeights,
    /// The central weight follows from the edges.
    CentralWeight,
}

impl fmt::Display for Condition {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::ConcyclicCorners => "PG1 (corners concyclic)",
            Self::EqualEdges => "PG2 (edge controls equidistant from their ends)",
            Self::RightAngles => "PG3 (edges orthogonal)",
            Self::CornerPlanes => "PG4 (central control in all corner planes)",
            Self::FourthCornerWeight => "weight w22",
            Self::EdgeWeights => "edge weights (circular arcs)",
            Self::CentralWeight => "weight w11",
        })
    }
}

/// The residuals of all conditions, each dimensionless: lengths relative to the diagonal of the net's bounding box, angles as cosines,
/// weights relative to 1 after normalising `w00 = w02 = w20 = 1`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NetReport {
    /// PG1.
    pub concyclic_corners: f64,
    /// PG2.
    pub equal_edges: f64,
    /// PG3.
    pub right_angles: f64,
    /// PG4.
    pub corner_planes: f64,
    /// Weight `w22`.
    pub fourth_corner_weight: f64,
    /// Weights `w01`, `w10`, `w21`, `w12`.
    pub edge_weights: f64,
    /// Weight `w11`.
    pub central_weight: f64,
}

impl NetReport {
    /// The conditions with their residuals, in the order of reporting.
    #[must_use]
    pub const fn residuals(&self) -> [(Condition, f64); 7] {
        [
            (Condition::ConcyclicCorners, self.concyclic_corners),
            (Condition::EqualEdges, self.equal_edges),
            (Condition::RightAngles, self.right_angles),
            (Condition::CornerPlanes, self.corner_planes),
            (Condition::FourthCornerWeight, self.fourth_corner_weight),
            (Condition::EdgeWeights, self.edge_weights),
            (Condition::CentralWeight, self.central_weight),
        ]
    }

    /// Passes if every residual is at most [`tolerance::NET`].
    ///
    /// # Errors
    ///
    /// [`Error::NotAPatch`] with the first condition that fails and by how much.
    pub fn check(&self) -> Result<(), Error> {
        let allowed = tolerance::NET;
        for (condition, residual) in self.residuals() {
            // A residual that is not a number fails too.
            if residual.is_nan() || residual > allowed {
                return Err(Error::NotAPatch {
                    condition,
                    residual,
                    allowed,
                });
            }
        }
        Ok(())
    }
}

/// Measures a net of control points with weights against all conditions.
///
/// For nets whose controls are all points; a net with vectors is judged as a whole by [`crate::convert`].
///
/// # Errors
///
/// [`Error::CornerWeights`]; [`Error::ControlAtInfinity`] if a control is a vector.
pub fn inspect(net: &Biquadratic<DVec3>) -> Result<NetReport, Error> {
    let net = normalise(net)?;
    let mut points = [[DVec3::ZERO; 3]; 3];
    for (row, (points, controls)) in points.iter_mut().zip(net.control()).enumerate() {
        for (column, (point, control)) in points.iter_mut().zip(controls).enumerate() {
            *point = control
                .position()
                .ok_or(Error::ControlAtInfinity { row, column })?;
        }
    }
    let weights = net.control().map(|row| row.map(|control| control.weight));
    let [concyclic_corners, equal_edges, right_angles, corner_planes] =
        geometric_residuals(&points);

    let fourth = fourth_corner_weight(&points);
    let root = weights[2][2].abs().sqrt();
    let cosines = edge_cosines(&points);
    let given = [weights[0][1], weights[1][0], weights[2][1], weights[1][2]];
    let edge_weights = [0, 1, 2, 3]
        .map(|edge| (given[edge].abs() - cosines[edge] * if edge < 2 { 1.0 } else { root }).abs());
    // The signs of the edges agree with each other if all corners give the same central weight.
    let central_weight = CORNERS.map(|corner| {
        let central = central_weight(&points, &weights, corner);
        (weights[1][1] - central).abs() / central.abs().max(1.0)
    });
    Ok(NetReport {
        concyclic_corners,
        equal_edges,
        right_angles,
        corner_planes,
        fourth_corner_weight: (weights[2][2] - fourth).abs() / fourth.max(1.0),
        edge_weights: worst(edge_weights),
        central_weight: worst(central_weight),
    })
}

/// The net of the cyclide patch with these control points: weights solved, with `w00 = w02 = w20 = 1` and the shorter arc on
/// the edges of corner 00 (the three complementary patches have the opposite sign on opposite edges).
///
/// # Errors
///
/// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::NotAPatch`] with the first of PG1 to PG4 that fails.
pub fn solve_weights(points: &[[DVec3; 3]; 3]) -> Result<Biquadratic<DVec3>, Error> {
    for &point in points.as_flattened() {
        place("control point", point)?;
    }
    let [concyclic_corners, equal_edges, right_angles, corner_planes] = geometric_residuals(points);
    NetReport {
        concyclic_corners,
        equal_edges,
        right_angles,
        corner_planes,
        fourth_corner_weight: 0.0,
        edge_weights: 0.0,
        central_weight: 0.0,
    }
    .check()?;
    let fourth = finite("weight w22", fourth_corner_weight(points))?;
    let root = fourth.sqrt();
    let [row, column, far_row, far_column] = edge_cosines(points);
    let mut weights = [
        [1.0, row, 1.0],
        [column, 0.0, root * far_column],
        [1.0, root * far_row, fourth],
    ];
    weights[1][1] = finite("weight w11", central_weight(points, &weights, (0, 0)))?;
    // On a patch of nearly half a turn one edge can be a longer arc where the opposite one is a shorter: the corners must agree on w11.
    if central_weight(points, &weights, (0, 2)) * weights[1][1] < 0.0 {
        weights[1][2] = -weights[1][2];
    }
    if central_weight(points, &weights, (2, 0)) * weights[1][1] < 0.0 {
        weights[2][1] = -weights[2][1];
    }
    let control =
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| MassPoint::point(points[i][j], weights[i][j])));
    Ok(Biquadratic::new(control)?)
}

/// The middle weight of the shorter circular arc with end weights 1: the cosine of the angle between tangent and chord.
fn arc_weight([start, middle, end]: [DVec3; 3]) -> f64 {
    (middle - start).dot(end - start) / ((middle - start).length() * (end - start).length())
}

/// The arc weights of row 0, column 0, row 2, column 2.
fn edge_cosines(points: &[[DVec3; 3]; 3]) -> [f64; 4] {
    let column = |j: usize| [points[0][j], points[1][j], points[2][j]];
    [
        arc_weight(points[0]),
        arc_weight(column(0)),
        arc_weight(points[2]),
        arc_weight(column(2)),
    ]
}

/// Ueda's weight: for any weights on four concyclic points, `w00 w22 |P00 P22|² = w02 w20 |P02 P20|²`.
fn fourth_corner_weight(points: &[[DVec3; 3]; 3]) -> f64 {
    (points[0][2] - points[2][0]).length_squared() / (points[0][0] - points[2][2]).length_squared()
}

/// Rows and columns of the corners.
const CORNERS: [(usize, usize); 4] = [(0, 0), (0, 2), (2, 0), (2, 2)];

/// `w11` from the affine coordinates of `P11` in the tangent plane of a corner and the weights there. The bisector condition of the paper is
/// empty for every torus and for symmetric patches; this local one is not.
fn central_weight(
    points: &[[DVec3; 3]; 3],
    weights: &[[f64; 3]; 3],
    (i, j): (usize, usize),
) -> f64 {
    let corner = points[i][j];
    let (along_row, along_column, central) = (
        points[i][1] - corner,
        points[1][j] - corner,
        points[1][1] - corner,
    );
    let lambda = central.dot(along_row) / along_row.length_squared();
    let nu = central.dot(along_column) / along_column.length_squared();
    weights[i][1] * weights[1][j] * (lambda + nu - 1.0) / (weights[i][j] * lambda * nu)
}

/// Residuals of PG1 to PG4.
fn geometric_residuals(points: &[[DVec3; 3]; 3]) -> [f64; 4] {
    let flat = points.as_flattened();
    let (low, high) = flat.iter().fold((flat[0], flat[0]), |(low, high), &point| {
        (low.min(point), high.max(point))
    });
    let size = high.distance(low);
    let column = |j: usize| [points[0][j], points[1][j], points[2][j]];
    let edges = [points[0], points[2], column(0), column(2)];
    let equal_edges =
        worst(edges.map(|[start, middle, end]| {
            (start.distance(middle) - middle.distance(end)).abs() / size
        }));
    let corners = CORNERS.map(|(i, j)| {
        let corner = points[i][j];
        (
            points[i][1] - corner,
            points[1][j] - corner,
            points[1][1] - corner,
        )
    });
    let right_angles = worst(
        corners.map(|(row, column, _)| row.dot(column).abs() / (row.length() * column.length())),
    );
    let corner_planes = worst(corners.map(|(row, column, central)| {
        let normal = row.cross(column);
        (central.dot(normal) / normal.length()).abs() / size
    }));
    [
        concyclicity(
            [points[0][0], points[0][2], points[2][2], points[2][0]],
            size,
        ),
        equal_edges,
        right_angles,
        corner_planes,
    ]
}

/// The largest of four residuals; not a number if one of them is none.
fn worst(residuals: [f64; 4]) -> f64 {
    residuals.into_iter().fold(0.0, |worst, residual| {
        if residual > worst || residual.is_nan() {
            residual
        } else {
            worst
        }
    })
}

/// How far four points are from one circle or line, relative to `size`.
pub(crate) fn concyclicity(corners: [DVec3; 4], size: f64) -> f64 {
    let [a, b, c, d] = corners;
    // The largest triangle carries the circle.
    let triangles = [(a, b, c, d), (b, c, d, a), (c, d, a, b), (d, a, b, c)];
    let area = |&(p, q, r, _): &(DVec3, DVec3, DVec3, DVec3)| (q - p).cross(r - p).length();
    let Some(&(p, q, r, fourth)) = triangles.iter().max_by(|s, t| area(s).total_cmp(&area(t)))
    else {
        return f64::INFINITY;
    };
    let (to_q, to_r) = (q - p, r - p);
    let normal = to_q.cross(to_r);
    if normal.length() <= tolerance::NET * size * size {
        // On one line: the height of the largest triangle is the deviation.
        let longest = to_q.length().max(to_r.length()).max(q.distance(r));
        return normal.length() / (longest * size);
    }
    let towards = (to_q.length_squared() * to_r - to_r.length_squared() * to_q).cross(normal);
    let centre = p + towards / (2.0 * normal.length_squared());
    let radius = p.distance(centre);
    let offset = fourth - centre;
    let height = offset.dot(normal.normalize());
    let in_plane = (offset - height * normal.normalize()).length();
    height.hypot(in_plane - radius) / size
}
