//! Mass points: weighted points and vectors in one vector space.

use crate::{Error, VectorSpace};
use core::iter::Sum;
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

/// A weighted point `(M; w)` with `w != 0`, or a vector `(u; 0)`.
///
/// Stored as the homogeneous vector `[w, wM]` or `[0, u]`. Addition and scaling of these vectors are
/// the operations of the paper (Section 2): two weighted points add to their barycentre with the sum of
/// the weights, opposite weights give a vector, and a vector moves a point.
///
/// ```
/// use bezier_mass::{MassPoint, glam::dvec2};
/// let a = MassPoint::point(dvec2(0.0, 0.0), 1.0);
/// let b = MassPoint::point(dvec2(4.0, 8.0), 3.0);
/// assert_eq!((a + b).position(), Some(dvec2(3.0, 6.0)));             // barycentre
/// assert_eq!(b - 3.0 * a, MassPoint::vector(dvec2(12.0, 24.0)));      // 3 (b - a): a vector
/// ```
///
/// Mass points are plain values like the vectors they are made of: arithmetic on them is unchecked, and
/// the curves and patches that take them as control points refuse non-finite ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MassPoint<V> {
    /// The weight `w`; zero for a vector.
    pub weight: f64,
    /// The weighted position `wM`, or the vector `u` itself.
    pub weighted: V,
}

/// The two kinds of mass point, taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum MassPointKind<V> {
    /// A point and its non-zero weight.
    Point {
        /// Where it is.
        position: V,
        /// Its weight, not zero.
        weight: f64,
    },
    /// A vector (weight zero).
    Vector(V),
}

impl<V: VectorSpace> MassPoint<V> {
    /// The point at `position` with `weight`. A zero weight gives the zero vector, as `0 * (M; w)` does.
    #[inline]
    #[must_use]
    pub fn point(position: V, weight: f64) -> Self {
        Self {
            weight,
            weighted: position.times(weight),
        }
    }

    /// The vector `(u; 0)`.
    #[inline]
    #[must_use]
    pub const fn vector(vector: V) -> Self {
        Self {
            weight: 0.0,
            weighted: vector,
        }
    }

    /// From the homogeneous vector `[w, X]`: the point `X/w`, or the vector `X` if `w = 0`.
    #[inline]
    #[must_use]
    pub const fn from_homogeneous(weight: f64, weighted: V) -> Self {
        Self { weight, weighted }
    }

    /// Whether this is a vector: its weight is exactly zero.
    ///
    /// Values computed by the curves of this crate have their weight set to exactly zero where it
    /// vanishes to rounding, so no tolerance is needed here.
    #[inline]
    #[must_use]
    pub fn is_vector(self) -> bool {
        self.weight == 0.0
    }

    /// The position of a weighted point; `None` for a vector (and where the division overflows).
    #[inline]
    #[must_use]
    pub fn position(self) -> Option<V> {
        let position = self.weighted.times(1.0 / self.weight);
        (!self.is_vector() && position.is_finite()).then_some(position)
    }

    /// The point with its weight, or the vector.
    #[inline]
    #[must_use]
    pub fn kind(self) -> MassPointKind<V> {
        match self.position() {
            Some(position) => MassPointKind::Point {
                position,
                weight: self.weight,
            },
            None => MassPointKind::Vector(self.weighted),
        }
    }

    /// The mass point after the translation by `offset`: points move, vectors stay.
    #[inline]
    #[must_use]
    pub fn translated(self, offset: V) -> Self {
        Self {
            weight: self.weight,
            weighted: self.weighted.plus(offset.times(self.weight)),
        }
    }

    /// The mass point after a linear map of the underlying space (a rotation, a projection, ...).
    #[inline]
    #[must_use]
    pub fn map_linear<W: VectorSpace>(self, map: impl FnOnce(V) -> W) -> MassPoint<W> {
        MassPoint {
            weight: self.weight,
            weighted: map(self.weighted),
        }
    }

    /// The moment `w X' - w' X` of two mass points: `w w'` times the vector between two points, and the
    /// vector itself (times the other's weight) where one of them is a vector.
    ///
    /// This is the exterior product as far as directions go: the tangent of a curve with value `h` and
    /// homogeneous derivative `h'` points along `h.moment(h')`, with no division by the weight.
    #[inline]
    #[must_use]
    pub fn moment(self, other: Self) -> V {
        other
            .weighted
            .times(self.weight)
            .minus(self.weighted.times(other.weight))
    }

    /// The same mass point with its weight set to zero if that weight is no larger than the rounding
    /// error of a sum whose terms have absolute values adding up to `terms`.
    #[inline]
    pub(crate) fn settled(self, terms: f64) -> Self {
        let weight = if self.weight.abs() <= WEIGHT_ROUNDING * terms {
            0.0
        } else {
            self.weight
        };
        Self {
            weight,
            weighted: self.weighted,
        }
    }

    /// `Ok` for finite coordinates and weight.
    pub(crate) fn checked(self) -> Result<Self, Error> {
        if self.is_finite() {
            Ok(self)
        } else {
            Err(Error::NonFinite {
                what: "control mass point",
            })
        }
    }
}

/// A weight below this fraction of the absolute sum that produced it is zero.
///
/// A Bernstein sum of degree `n` in each direction commits a relative error of about `3 n` units in the
/// last place against the sum of the absolute terms; 16 covers the quadratics and the biquadratics, and
/// a weight of that size has no correct digit at any degree.
pub(crate) const WEIGHT_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Weights above this fraction of the largest control weight are ten decades clear of the rounding error of an affine
/// combination, and need no closer look.
pub(crate) const CLEAR_WEIGHT: f64 = 1e-6;

/// Whether a weight that is an affine combination, with shares from 0 to 1, of the weights of `control` is far above its
/// rounding error.
pub(crate) fn is_clear<V: VectorSpace>(weight: f64, control: &[MassPoint<V>]) -> bool {
    let largest = control
        .iter()
        .fold(0.0, |largest: f64, h| largest.max(h.weight.abs()));
    weight.abs() > CLEAR_WEIGHT * largest
}

impl<V: VectorSpace> VectorSpace for MassPoint<V> {
    const ZERO: Self = Self {
        weight: 0.0,
        weighted: V::ZERO,
    };

    #[inline]
    fn plus(self, other: Self) -> Self {
        Self {
            weight: self.weight + other.weight,
            weighted: self.weighted.plus(other.weighted),
        }
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        Self {
            weight: self.weight * factor,
            weighted: self.weighted.times(factor),
        }
    }

    #[inline]
    fn minus(self, other: Self) -> Self {
        Self {
            weight: self.weight - other.weight,
            weighted: self.weighted.minus(other.weighted),
        }
    }

    #[inline]
    fn magnitude(self) -> f64 {
        self.weighted.magnitude().max(self.weight.abs())
    }

    #[inline]
    fn is_finite(self) -> bool {
        self.weight.is_finite() && self.weighted.is_finite()
    }
}

impl<V: VectorSpace> Add for MassPoint<V> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.plus(other)
    }
}

impl<V: VectorSpace> AddAssign for MassPoint<V> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = self.plus(other);
    }
}

impl<V: VectorSpace> Sub for MassPoint<V> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.minus(other)
    }
}

impl<V: VectorSpace> SubAssign for MassPoint<V> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = self.minus(other);
    }
}

impl<V: VectorSpace> Neg for MassPoint<V> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.times(-1.0)
    }
}

impl<V: VectorSpace> Mul<f64> for MassPoint<V> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        self.times(factor)
    }
}

impl<V: VectorSpace> Mul<MassPoint<V>> for f64 {
    type Output = MassPoint<V>;
    #[inline]
    fn mul(self, mass_point: MassPoint<V>) -> MassPoint<V> {
        mass_point.times(self)
    }
}

/// The sum of mass points; as a point, it is their barycentre.
impl<V: VectorSpace> Sum for MassPoint<V> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Self::plus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, dvec2};

    #[test]
    fn the_five_rules_of_addition() {
        let (m, n) = (dvec2(1.0, 1.0), dvec2(3.0, 0.0));
        let p = MassPoint::point;
        assert_eq!(p(m, 2.0) + p(n, 6.0), p(dvec2(2.5, 0.25), 8.0));
        assert_eq!(p(m, 2.0) + p(n, -2.0), MassPoint::vector((m - n) * 2.0));
        assert_eq!(
            (p(m, 2.0) + MassPoint::vector(n)).position(),
            Some(m + n / 2.0)
        );
        assert_eq!(
            MassPoint::vector(m) + MassPoint::vector(n),
            MassPoint::vector(m + n)
        );
        assert_eq!(0.0 * p(m, 2.0), MassPoint::ZERO);
        assert_eq!(
            (-3.0 * p(m, 2.0)).kind(),
            MassPointKind::Point {
                position: m,
                weight: -6.0
            }
        );
    }

    #[test]
    fn a_sum_of_points_is_their_barycentre() {
        let triangle = [dvec2(0.0, 0.0), dvec2(3.0, 0.0), dvec2(0.0, 6.0)];
        let sum: MassPoint<DVec2> = triangle
            .iter()
            .map(|&corner| MassPoint::point(corner, 1.0))
            .sum();
        assert_eq!(
            sum.kind(),
            MassPointKind::Point {
                position: dvec2(1.0, 2.0),
                weight: 3.0
            }
        );
    }

    #[test]
    fn translation_moves_points_and_leaves_vectors() {
        let offset = dvec2(5.0, -1.0);
        assert_eq!(
            MassPoint::point(dvec2(1.0, 1.0), 2.0)
                .translated(offset)
                .position(),
            Some(dvec2(6.0, 0.0))
        );
        assert_eq!(
            MassPoint::vector(dvec2(1.0, 1.0)).translated(offset),
            MassPoint::vector(dvec2(1.0, 1.0))
        );
    }

    #[test]
    fn a_position_that_overflows_or_is_nan_is_none() {
        assert_eq!(MassPoint::from_homogeneous(1e-300, 1e300).position(), None);
        assert_eq!(MassPoint::from_homogeneous(f64::NAN, 1.0).position(), None);
        assert_eq!(MassPoint::vector(1.0).position(), None);
    }
}
