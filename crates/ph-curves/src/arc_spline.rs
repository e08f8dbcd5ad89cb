//! Splines of PH arcs and straight segments, whose offsets are exact.

use bezier_mass::BezierCurve;
use glam::DVec2;

use crate::{Error, Piece};

/// How two consecutive pieces of an [`ArcSpline`] meet, in point, normal and curvature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Joint {
    /// Common point, normal and curvature.
    G2,
    /// Common point and normal.
    G1,
    /// Common point: the tangent turns, as where a trimmed offset changes from one branch to another.
    Corner,
}

/// A chain of PH arcs and straight segments with continuous normal: a front, not only a curve.
///
/// Corners are arcs of radius zero that turn the normal, so that every offset is again such a chain: a corner becomes
/// a circular arc on its outer side; only trimmed splines have joints of kind [`Joint::Corner`]. The offset at distance d
/// moves every point by d along its normal, to the *right* of travel for positive d. It is exact, and it may have cusps and
/// loops; see [`ArcSpline::trimmed_offset`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "StoredSpline", into = "StoredSpline")
)]
pub struct ArcSpline {
    pub(crate) pieces: Vec<Piece>,
    pub(crate) joints: Vec<Joint>,
    pub(crate) closed: bool,
}

impl ArcSpline {
    /// The pieces in order of travel.
    #[must_use]
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The joints: joint `i` lies between pieces `i` and `i + 1`; a closed spline has one more, from its end to
    /// its start.
    #[must_use]
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Whether the end is the start.
    #[must_use]
    pub const fn is_closed(&self) -> bool {
        self.closed
    }

    /// The parallel spline at signed distance `distance`, to the right of travel if positive. Exact: normals stay,
    /// supports grow by `distance`; joints keep their continuity.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for a distance that is not finite.
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        if !distance.is_finite() {
            return Err(Error::NonFinite {
                what: "an offset distance",
            });
        }
        let mut moved = self.clone();
        for piece in &mut moved.pieces {
            piece.shift(distance);
        }
        Ok(moved)
    }

    /// Total arc length of the pieces.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// Largest relative jump of the radius of curvature over the joints of kind [`Joint::G2`], as
    /// `|1/R - 1/R'|` over the larger curvature.
    #[must_use]
    pub fn g2_jump(&self) -> f64 {
        self.joints
            .iter()
            .enumerate()
            .filter(|(_, joint)| **joint == Joint::G2)
            .filter_map(|(i, _)| {
                let (before, after) = (
                    self.pieces.get(i)?,
                    self.pieces.get((i + 1) % self.pieces.len())?,
                );
                let (a, b) = (1.0 / before.radius(1.0), 1.0 / after.radius(0.0));
                Some(if a == b {
                    0.0
                } else {
                    (a - b).abs() / a.abs().max(b.abs())
                })
            })
            .fold(0.0, f64::max)
    }

    /// Every piece as a rational Bézier curve.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if coefficients overflow.
    pub fn to_beziers(&self) -> Result<Vec<BezierCurve<DVec2>>, Error> {
        self.pieces.iter().map(Piece::to_bezier).collect()
    }
}

/// Largest distance of two pieces at a joint that is read, relative to the largest coordinate: that of the computed
/// crossings of a trimmed offset.
#[cfg(feature = "serde")]
const GAP: f64 = 1e-6;

/// The form in which a spline is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredSpline {
    pieces: Vec<Piece>,
    joints: Vec<Joint>,
    closed: bool,
}

#[cfg(feature = "serde")]
impl From<ArcSpline> for StoredSpline {
    fn from(spline: ArcSpline) -> Self {
        Self {
            pieces: spline.pieces,
            joints: spline.joints,
            closed: spline.closed,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredSpline> for ArcSpline {
    type Error = Error;

    fn try_from(stored: StoredSpline) -> Result<Self, Error> {
        let StoredSpline {
            pieces,
            joints,
            closed,
        } = stored;
        let count = pieces.len();
        if count == 0 {
            return Err(Error::TooFew {
                what: "pieces",
                given: 0,
                needed: 1,
            });
        }
        if joints.len() + usize::from(!closed) != count {
            return Err(Error::JointCount {
                pieces: count,
                joints: joints.len(),
                closed,
            });
        }
        let ends: Vec<[DVec2; 2]> = pieces
            .iter()
            .map(|piece| [piece.point(0.0), piece.point(1.0)])
            .collect();
        if !ends.iter().flatten().all(|end| end.is_finite()) {
            return Err(Error::NonFinite {
                what: "an end of a piece",
            });
        }
        let size = ends
            .iter()
            .flatten()
            .map(|end| end.abs().max_element())
            .fold(0.0, f64::max);
        for index in 0..joints.len() {
            let distance = ends[index][1].distance(ends[(index + 1) % count][0]);
            if distance > GAP * size {
                return Err(Error::Gap { index, distance });
            }
        }
        Ok(Self {
            pieces,
            joints,
            closed,
        })
    }
}
