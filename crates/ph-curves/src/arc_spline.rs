//! Splines of class-3 arcs and straight segments, whose offsets are exact.

use bezier_mass::BezierCurve;
use glam::{DVec2, DVec3};

use crate::dual::rational_curve;
use crate::{Error, PhArc};

/// One piece of an [`ArcSpline`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Piece {
    /// A straight segment; its normal is the right-hand one of its direction of travel.
    Segment(Segment),
    /// An arc of class 3. Its radius is zero for a corner, a point with a fan of normals.
    Arc(PlacedArc),
    /// A PH arc of class 9, without cusp.
    Wide(PlacedArc<10>),
}

/// A PH arc (of class 3 unless said otherwise) about an origin of its own, near to it: supports are then as small as the arc, and small arcs far from
/// the origin of the plane keep their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlacedArc<const N: usize = 4> {
    /// Where the arc's own origin lies.
    pub origin: DVec2,
    /// The arc about its own origin.
    pub local: PhArc<N>,
}

impl<const N: usize> PlacedArc<N> {
    /// The same arc about the origin of the plane.
    #[must_use]
    pub fn arc(&self) -> PhArc<N> {
        self.local.translate(self.origin)
    }

    /// The point at `t` in `[0, 1]`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        self.origin + self.local.point(t)
    }

    #[inline]
    fn offset(&self, distance: f64) -> Self {
        Self {
            local: self.local.offset(distance),
            ..*self
        }
    }

    fn part(&self, from: f64, to: f64) -> Result<Self, Error> {
        Ok(Self {
            local: self.local.part(from, to)?,
            ..*self
        })
    }

    /// The arc run backwards, with its normals reversed: they stay on the right of travel.
    fn reverse(&self) -> Self {
        Self {
            local: self.local.reverse().flip(),
            ..*self
        }
    }

    fn homogeneous(&self) -> Vec<DVec3> {
        let origin = self.origin;
        let sign = self.local.turning().signum();
        self.local
            .point_control()
            .iter()
            .map(|x| DVec3::new(x.x, x.y + x.x * origin.x, x.z + x.x * origin.y) * sign)
            .collect()
    }
}

/// A straight segment of an [`ArcSpline`] with its unit normal, which stays when it shrinks or is offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Segment {
    pub(crate) start: DVec2,
    pub(crate) end: DVec2,
    pub(crate) normal: DVec2,
}

impl Segment {
    /// The segment between two different points.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] for equal points.
    pub fn new(start: DVec2, end: DVec2) -> Result<Self, Error> {
        if !(start.is_finite() && end.is_finite()) {
            return Err(Error::NonFinite {
                what: "an end of a segment",
            });
        }
        let direction = (end - start)
            .try_normalize()
            .ok_or(Error::ZeroDirection { what: "a segment" })?;
        Ok(Self {
            start,
            end,
            normal: -direction.perp(),
        })
    }

    /// Start point.
    #[must_use]
    pub const fn start(&self) -> DVec2 {
        self.start
    }

    /// End point.
    #[must_use]
    pub const fn end(&self) -> DVec2 {
        self.end
    }

    /// Unit normal to the right of travel.
    #[must_use]
    pub const fn normal(&self) -> DVec2 {
        self.normal
    }
}

impl Piece {
    /// The point at `t` in `[0, 1]`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        match self {
            Self::Segment(segment) => segment.start.lerp(segment.end, t),
            Self::Arc(arc) => arc.point(t),
            Self::Wide(arc) => arc.point(t),
        }
    }

    /// The unit normal at `t`.
    #[must_use]
    pub fn normal(&self, t: f64) -> DVec2 {
        match self {
            Self::Segment(segment) => segment.normal,
            Self::Arc(arc) => arc.local.normal(t),
            Self::Wide(arc) => arc.local.normal(t),
        }
    }

    /// Signed radius of curvature, infinite on a segment.
    #[must_use]
    pub fn radius(&self, t: f64) -> f64 {
        match self {
            Self::Segment(_) => f64::INFINITY,
            Self::Arc(arc) => arc.local.radius(t),
            Self::Wide(arc) => arc.local.radius(t),
        }
    }

    /// Derivative of the point by `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        match self {
            Self::Segment(segment) => segment.end - segment.start,
            Self::Arc(arc) => arc.local.velocity(t),
            Self::Wide(arc) => arc.local.velocity(t),
        }
    }

    /// Distance of `point` to the piece.
    #[must_use]
    pub fn distance(&self, point: DVec2) -> f64 {
        let feet = match self {
            Self::Segment(segment) => {
                let along = segment.end - segment.start;
                vec![((point - segment.start).dot(along) / along.length_squared()).clamp(0.0, 1.0)]
            }
            Self::Arc(arc) => arc.local.feet(point - arc.origin),
            Self::Wide(arc) => arc.local.feet(point - arc.origin),
        };
        let away = |t: f64| (self.point(t) - point).length();
        feet.into_iter()
            .map(away)
            .fold(away(0.0).min(away(1.0)), f64::min)
    }

    /// Signed turning angle of the normal, zero on a segment.
    #[must_use]
    pub fn turning(&self) -> f64 {
        match self {
            Self::Segment(_) => 0.0,
            Self::Arc(arc) => arc.local.turning(),
            Self::Wide(arc) => arc.local.turning(),
        }
    }

    /// The parallel piece at signed distance `distance` along the normals; exact.
    #[must_use]
    #[inline]
    pub fn offset(&self, distance: f64) -> Self {
        match self {
            Self::Segment(segment) => {
                let shift = segment.normal * distance;
                Self::Segment(Segment {
                    start: segment.start + shift,
                    end: segment.end + shift,
                    ..*segment
                })
            }
            Self::Arc(arc) => Self::Arc(arc.offset(distance)),
            Self::Wide(arc) => Self::Wide(arc.offset(distance)),
        }
    }

    /// Arc length; parts on both sides of a cusp count positively.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Segment(segment) => (segment.end - segment.start).length(),
            Self::Arc(arc) => arc.local.length(),
            Self::Wide(arc) => arc.local.length(),
        }
    }

    /// Parameters of the cusps, where the radius of curvature vanishes.
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        match self {
            Self::Segment(_) => Vec::new(),
            Self::Arc(arc) => arc.local.cusp().into_iter().collect(),
            Self::Wide(arc) => arc.local.cusps(),
        }
    }

    /// The part between two parameters `0 <= from < to <= 1`.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] otherwise.
    pub fn part(&self, from: f64, to: f64) -> Result<Self, Error> {
        match self {
            Self::Arc(arc) => arc.part(from, to).map(Self::Arc),
            Self::Wide(arc) => arc.part(from, to).map(Self::Wide),
            Self::Segment(segment) => {
                if !(from >= 0.0 && from < to && to <= 1.0) {
                    return Err(Error::OutsideDomain {
                        value: from,
                        start: 0.0,
                        end: to.min(1.0),
                    });
                }
                let (start, end) = (self.point(from), self.point(to));
                Ok(Self::Segment(Segment {
                    start,
                    end,
                    ..*segment
                }))
            }
        }
    }

    /// The piece run backwards; its normals turn around, so that they stay on the right of travel.
    #[must_use]
    pub fn reverse(&self) -> Self {
        match self {
            Self::Segment(segment) => Self::Segment(Segment {
                start: segment.end,
                end: segment.start,
                normal: -segment.normal,
            }),
            Self::Arc(arc) => Self::Arc(arc.reverse()),
            Self::Wide(arc) => Self::Wide(arc.reverse()),
        }
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point form, with positive weights: degree 1 for a
    /// segment, 4 for an arc of class 3, 10 for one of class 9.
    #[must_use]
    pub fn homogeneous(&self) -> Vec<DVec3> {
        match self {
            Self::Segment(segment) => [segment.start, segment.end]
                .map(|p| DVec3::new(1.0, p.x, p.y))
                .to_vec(),
            Self::Arc(arc) => arc.homogeneous(),
            Self::Wide(arc) => arc.homogeneous(),
        }
    }

    /// The piece as a rational Bézier curve, of the degree of [`Piece::homogeneous`].
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the coefficients overflow.
    pub fn to_bezier(&self) -> Result<BezierCurve<DVec2>, Error> {
        rational_curve(&self.homogeneous())
    }
}

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
/// a circular arc on its outer side; only trimmed splines have joints of kind [`Joint::Corner`]. The offset at distance d moves every point by d along its normal, to the
/// *right* of travel for positive d. It is exact, and it may have cusps and loops; see [`ArcSpline::trimmed_offset`].
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
        let pieces = self
            .pieces
            .iter()
            .map(|piece| piece.offset(distance))
            .collect();
        Ok(Self {
            pieces,
            joints: self.joints.clone(),
            closed: self.closed,
        })
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
