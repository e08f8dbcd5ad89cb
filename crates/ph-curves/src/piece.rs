//! The pieces of an [`ArcSpline`](crate::ArcSpline): PH arcs about origins of their own, and straight segments.

use bezier_mass::BezierCurve;
use glam::{DVec2, DVec3};

use crate::course::End;
use crate::dual::rational_curve;
use crate::{Error, InflectedArc, PhArc};

/// One piece of an [`ArcSpline`](crate::ArcSpline).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Piece {
    /// A straight segment; its normal is the right-hand one of its direction of travel.
    Segment(Segment),
    /// An arc of class 3. Its radius is zero for a corner, a point with a fan of normals.
    Arc(PlacedArc),
    /// A PH arc of class 9.
    Wide(PlacedArc<10>),
    /// A PH arc of class 14.
    Wider(PlacedArc<15>),
    /// A PH arc of class 9 about an inflection, which may lie inside, at an end, or beside it.
    Inflected(InflectedArc),
}

/// An offset of a PH arc (of class 3 unless said otherwise) about an origin of its own, near to it: supports are then as
/// small as the arc, and small arcs far from the origin of the plane, or far from their original, keep their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlacedArc<const N: usize = 4> {
    /// Where the arc's own origin lies.
    pub origin: DVec2,
    /// The original about its own origin.
    pub local: PhArc<N>,
    /// Signed distance from the original along its normals.
    pub distance: f64,
}

impl<const N: usize> PlacedArc<N> {
    /// An arc given about `origin`.
    #[must_use]
    pub const fn new(origin: DVec2, local: PhArc<N>) -> Self {
        Self {
            origin,
            local,
            distance: 0.0,
        }
    }

    /// The same arc about the origin of the plane.
    #[must_use]
    pub fn arc(&self) -> PhArc<N> {
        self.moved().translate(self.origin)
    }

    /// The offset about the arc's own origin.
    fn moved(&self) -> PhArc<N> {
        self.local.offset(self.distance)
    }

    /// The point at `t` in `[0, 1]`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        self.origin + self.local.point(t) + self.distance * self.local.normal(t)
    }

    /// Signed radius of curvature at `t`.
    #[must_use]
    pub fn radius(&self, t: f64) -> f64 {
        self.local.radius(t) + self.distance
    }

    /// Derivative of the point by `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        self.local.normal(t).perp() * (self.radius(t) * self.local.turning_rate(t))
    }

    /// Bernstein coefficients of the radius of curvature.
    pub(crate) fn radius_coefficients(&self) -> Vec<f64> {
        let radius = self.local.radius_polynomial();
        radius.iter().map(|r| r + self.distance).collect()
    }

    fn cusps(&self) -> Vec<f64> {
        self.local.cusps_of_offset(self.distance)
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
            distance: -self.distance,
            ..*self
        }
    }

    fn homogeneous(&self) -> Vec<DVec3> {
        let origin = self.origin;
        let sign = self.local.turning().signum();
        self.moved()
            .point_control()
            .iter()
            .map(|x| DVec3::new(x.x, x.y + x.x * origin.x, x.z + x.x * origin.y) * sign)
            .collect()
    }
}

/// A straight segment of an [`ArcSpline`](crate::ArcSpline) with its unit normal, which stays when it shrinks or is offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "StoredSegment", into = "StoredSegment")
)]
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

/// The form in which a segment is serialized. Its ends may be one point or the wrong way round, as in an offset.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredSegment {
    start: DVec2,
    end: DVec2,
    normal: DVec2,
}

#[cfg(feature = "serde")]
impl From<Segment> for StoredSegment {
    fn from(segment: Segment) -> Self {
        Self {
            start: segment.start,
            end: segment.end,
            normal: segment.normal,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredSegment> for Segment {
    type Error = Error;

    fn try_from(StoredSegment { start, end, normal }: StoredSegment) -> Result<Self, Error> {
        let element = crate::LineElement::new(start, normal)?;
        if !end.is_finite() {
            return Err(Error::NonFinite {
                what: "an end of a segment",
            });
        }
        // A unit normal comes back as it was.
        let normal = if crate::complex::is_unit(normal) {
            normal
        } else {
            element.normal()
        };
        Ok(Self { start, end, normal })
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
            Self::Wider(arc) => arc.point(t),
            Self::Inflected(arc) => arc.point(t),
        }
    }

    /// The unit normal at `t`.
    #[must_use]
    pub fn normal(&self, t: f64) -> DVec2 {
        match self {
            Self::Segment(segment) => segment.normal,
            Self::Arc(arc) => arc.local.normal(t),
            Self::Wide(arc) => arc.local.normal(t),
            Self::Wider(arc) => arc.local.normal(t),
            Self::Inflected(arc) => arc.normal(t),
        }
    }

    /// Signed radius of curvature, infinite on a segment.
    #[must_use]
    pub fn radius(&self, t: f64) -> f64 {
        match self {
            Self::Segment(_) => f64::INFINITY,
            Self::Arc(arc) => arc.radius(t),
            Self::Wide(arc) => arc.radius(t),
            Self::Wider(arc) => arc.radius(t),
            Self::Inflected(arc) => arc.radius(t),
        }
    }

    /// Derivative of the point by `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        match self {
            Self::Segment(segment) => segment.end - segment.start,
            Self::Arc(arc) => arc.velocity(t),
            Self::Wide(arc) => arc.velocity(t),
            Self::Wider(arc) => arc.velocity(t),
            Self::Inflected(arc) => arc.velocity(t),
        }
    }

    /// The parameter, also outside of `[0, 1]`, of the normal of a point of a curve that the piece approximates.
    pub(crate) fn parameter_like(&self, end: &End) -> f64 {
        match self {
            Self::Segment(_) => 0.0,
            Self::Arc(arc) => arc.local.parameter_beyond(end.normal),
            Self::Wide(arc) => arc.local.parameter_beyond(end.normal),
            Self::Wider(arc) => arc.local.parameter_beyond(end.normal),
            Self::Inflected(arc) => arc.parameter_like(end.normal, end.curvature),
        }
    }

    /// Distance of `point` to the piece.
    #[must_use]
    pub fn distance(&self, point: DVec2) -> f64 {
        self.nearest(point).1
    }

    /// The parameter of the nearest point of the piece, and its distance.
    pub(crate) fn nearest(&self, point: DVec2) -> (f64, f64) {
        let feet = match self {
            Self::Segment(segment) => {
                let along = segment.end - segment.start;
                vec![((point - segment.start).dot(along) / along.length_squared()).clamp(0.0, 1.0)]
            }
            Self::Arc(arc) => arc.local.feet(point - arc.origin),
            Self::Wide(arc) => arc.local.feet(point - arc.origin),
            Self::Wider(arc) => arc.local.feet(point - arc.origin),
            Self::Inflected(arc) => arc.feet(point),
        };
        [0.0, 1.0]
            .into_iter()
            .chain(feet)
            .map(|t| (t, (self.point(t) - point).length()))
            .fold((0.0, f64::INFINITY), |best, next| {
                if next.1 < best.1 { next } else { best }
            })
    }

    /// Signed turning angle of the normal, zero on a segment.
    #[must_use]
    pub fn turning(&self) -> f64 {
        match self {
            Self::Segment(_) => 0.0,
            Self::Arc(arc) => arc.local.turning(),
            Self::Wide(arc) => arc.local.turning(),
            Self::Wider(arc) => arc.local.turning(),
            Self::Inflected(arc) => arc.turning(),
        }
    }

    /// The parallel piece at signed distance `distance` along the normals; exact.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        let mut moved = *self;
        moved.shift(distance);
        moved
    }

    /// Moves the piece along its normals.
    #[inline]
    pub(crate) fn shift(&mut self, distance: f64) {
        match self {
            Self::Segment(segment) => {
                let shift = segment.normal * distance;
                segment.start += shift;
                segment.end += shift;
            }
            Self::Arc(arc) => arc.distance += distance,
            Self::Wide(arc) => arc.distance += distance,
            Self::Wider(arc) => arc.distance += distance,
            Self::Inflected(arc) => arc.shift(distance),
        }
    }

    /// Arc length; parts on both sides of a cusp count positively.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Segment(segment) => (segment.end - segment.start).length(),
            Self::Arc(arc) => arc.moved().length(),
            Self::Wide(arc) => arc.moved().length(),
            Self::Wider(arc) => arc.moved().length(),
            Self::Inflected(arc) => arc.length(),
        }
    }

    /// The parameter inside `(0, 1)` at which the piece has an inflection.
    #[must_use]
    pub fn inflection(&self) -> Option<f64> {
        match self {
            Self::Inflected(arc) => arc.inflection(),
            _ => None,
        }
    }

    /// Parameters of the cusps, where the radius of curvature vanishes.
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        match self {
            Self::Segment(_) => Vec::new(),
            Self::Arc(arc) => arc.moved().cusp().into_iter().collect(),
            Self::Wide(arc) => arc.cusps(),
            Self::Wider(arc) => arc.cusps(),
            Self::Inflected(arc) => arc.cusps(),
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
            Self::Wider(arc) => arc.part(from, to).map(Self::Wider),
            Self::Inflected(arc) => arc.part(from, to).map(Self::Inflected),
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
            Self::Wider(arc) => Self::Wider(arc.reverse()),
            Self::Inflected(arc) => Self::Inflected(arc.reverse().flip()),
        }
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point form, with positive weights: degree 1 for a
    /// segment, 4 for an arc of class 3, 10 for one of class 9, 15 for one of class 14, 11 for one about an inflection.
    #[must_use]
    pub fn homogeneous(&self) -> Vec<DVec3> {
        match self {
            Self::Segment(segment) => [segment.start, segment.end]
                .map(|p| DVec3::new(1.0, p.x, p.y))
                .to_vec(),
            Self::Arc(arc) => arc.homogeneous(),
            Self::Wide(arc) => arc.homogeneous(),
            Self::Wider(arc) => arc.homogeneous(),
            Self::Inflected(arc) => arc.homogeneous(),
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
