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
