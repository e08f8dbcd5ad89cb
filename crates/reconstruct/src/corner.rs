//! What is known of a surface at the corners of a patch, and the curves that join them.
//!
//! Section 3.7 of the thesis chapter: corner points, tangent planes, the directions of the curves in them and their
//! curvatures; the torsions follow from the crossing identity.

use crate::Error;
use crate::spatial::unit;
use glam::DVec3;

/// The four corners `[i][j]` of a rectangle at `u = i`, `v = j`.
pub type Corners = [[CornerData; 2]; 2];

/// What is known of a surface at a corner of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredCorner")
)]
pub struct CornerData {
    point: DVec3,
    normal: DVec3,
    tangents: [DVec3; 2],
    curvatures: [f64; 2],
    torsion_difference: f64,
}

/// Largest cosine between a tangent and the normal that counts as a slip of rounding and is projected away.
const ORTHOGONAL: f64 = 1e-6;
/// Smallest sine between the two tangents, and smallest curvature in units of one over the patch size is left to
/// the user: zero only is refused.
const PARALLEL: f64 = 1e-6;

impl CornerData {
    /// The corner at `point` with the surface normal `normal`, tangents along increasing `u` and `v` in the tangent
    /// plane (any lengths), and the normal curvatures of the two boundaries, one over length: positive where the
    /// boundary bends towards `normal`.
    ///
    /// # Errors
    /// [`Error::CornerData`] (with corner `[0, 0]`) for numbers that are not finite, zero vectors, tangents out of
    /// the tangent plane or parallel, `(tangent_u x tangent_v)` opposite to the normal, and for a curvature of zero,
    /// which leaves the osculating plane open.
    pub fn new(
        point: DVec3,
        normal: DVec3,
        tangents: [DVec3; 2],
        curvatures: [f64; 2],
    ) -> Result<Self, Error> {
        let refuse = |what, value| {
            Err(Error::CornerData {
                corner: [0, 0],
                what,
                value,
            })
        };
        let finite =
            point.is_finite() && normal.is_finite() && tangents.iter().all(|t| t.is_finite());
        if !finite || !curvatures.iter().all(|k| k.is_finite()) {
            return refuse("a number is not finite", f64::NAN);
        }
        let Some(normal) = unit(normal) else {
            return refuse("the normal is zero", 0.0);
        };
        let mut units = [DVec3::ZERO; 2];
        for (projected, tangent) in units.iter_mut().zip(tangents) {
            let Some(direction) = unit(tangent) else {
                return refuse("a tangent is zero", 0.0);
            };
            let slip = direction.dot(normal);
            if slip.abs() > ORTHOGONAL {
                return refuse(
                    "a tangent leaves the tangent plane (cosine to the normal)",
                    slip,
                );
            }
            *projected = (direction - normal * slip).normalize();
        }
        let sine = units[0].cross(units[1]).dot(normal);
        if sine.abs() < PARALLEL {
            return refuse("the tangents are parallel (sine)", sine);
        }
        if sine < 0.0 {
            return refuse("the tangents are ordered against the normal (sine)", sine);
        }
        if curvatures.contains(&0.0) {
            return refuse("a boundary has no curvature", 0.0);
        }
        Ok(Self {
            point,
            normal,
            tangents: units,
            curvatures,
            torsion_difference: 0.0,
        })
    }

    /// The same corner with another split of the torsions: that of the boundary along `u` minus that along `v`.
    ///
    /// A difference of zero, that of a new corner, asks for nothing: constructions that cannot choose the torsions freely
    /// ([`rational_quintic_boundaries`](crate::rational_quintic_boundaries)) may then split them as they need.
    #[must_use]
    pub fn with_torsion_difference(self, difference: f64) -> Self {
        Self {
            torsion_difference: difference,
            ..self
        }
    }

    /// The point.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.point
    }

    /// The unit normal of the surface.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The unit tangents along `u` and `v`.
    #[must_use]
    pub fn tangents(&self) -> [DVec3; 2] {
        self.tangents
    }

    /// The normal curvatures of the boundaries along `u` and `v`.
    #[must_use]
    pub fn curvatures(&self) -> [f64; 2] {
        self.curvatures
    }

    /// The sum of the two torsions that the crossing identity (3.7) asks for.
    #[must_use]
    pub fn torsion_sum(&self) -> f64 {
        let [e1, e2] = self.tangents;
        let [k1, k2] = self.curvatures;
        (k2 - k1) * e1.dot(e2) / e1.cross(e2).dot(self.normal)
    }

    /// The torsion of the boundary along `u` minus that along `v` that was asked for.
    #[must_use]
    pub fn torsion_difference(&self) -> f64 {
        self.torsion_difference
    }

    /// The torsions of the boundaries along `u` and `v`: equal unless another split was asked for.
    #[must_use]
    pub fn torsions(&self) -> [f64; 2] {
        let half = 0.5 * self.torsion_sum();
        [
            half + 0.5 * self.torsion_difference,
            half - 0.5 * self.torsion_difference,
        ]
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "CornerData")]
struct StoredCorner {
    point: DVec3,
    normal: DVec3,
    tangents: [DVec3; 2],
    curvatures: [f64; 2],
    torsion_difference: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<StoredCorner> for CornerData {
    type Error = Error;

    fn try_from(stored: StoredCorner) -> Result<Self, Error> {
        let StoredCorner {
            point,
            normal,
            tangents,
            curvatures,
            torsion_difference,
        } = stored;
        Self::new(point, normal, tangents, curvatures)
            .map(|corner| corner.with_torsion_difference(torsion_difference))
    }
}

/// One end of a boundary curve: data with the curve's own direction of travel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CurveEnd {
    pub(crate) point: DVec3,
    pub(crate) tangent: DVec3,
    pub(crate) normal: DVec3,
    pub(crate) curvature: f64,
    pub(crate) torsion: f64,
}

fn curve_end(corner: &CornerData, along: usize) -> CurveEnd {
    CurveEnd {
        point: corner.point,
        tangent: corner.tangents[along],
        normal: corner.normal,
        curvature: corner.curvatures[along],
        torsion: corner.torsions()[along],
    }
}

/// The axis along which a boundary runs, and the corners `[i, j]` that it joins.
pub(crate) type Side = (usize, [[usize; 2]; 2]);

/// The ends of `r1(u)`, `r2(v)`, `r3(u)`, `r4(v)` in the corners.
pub(crate) const SIDES: [Side; 4] = [
    (0, [[0, 0], [1, 0]]),
    (1, [[0, 0], [0, 1]]),
    (0, [[0, 1], [1, 1]]),
    (1, [[1, 0], [1, 1]]),
];

/// The ends of one boundary and the length of its chord.
pub(crate) fn curve_ends(
    corners: &Corners,
    (axis, [a, b]): Side,
) -> Result<([CurveEnd; 2], f64), Error> {
    let ends = [a, b].map(|[i, j]| curve_end(&corners[i][j], axis));
    let chord = ends[0].point.distance(ends[1].point);
    if chord > 0.0 {
        return Ok((ends, chord));
    }
    Err(Error::CornerData {
        corner: b,
        what: "two corners coincide (distance)",
        value: chord,
    })
}

pub(crate) fn four<T>(values: Vec<T>) -> Result<[T; 4], Error> {
    let got = values.len();
    values.try_into().map_err(|_| Error::TooFew {
        what: "boundaries",
        needed: 4,
        got,
    })
}
