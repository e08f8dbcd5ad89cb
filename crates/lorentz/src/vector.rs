use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use bezier_mass::VectorSpace;
use glam::DVec3;

use crate::tolerance::{LIGHT_LIKE, ROUNDING, ZERO_COORDINATE};
use crate::{Error, Object, Plane, Point, Sphere};

/// A vector of the Minkowski-Lorentz space L(4,1), in the null basis `(e_o, e_1, e_2, e_3, e_inf)`.
///
/// The product is `x . y = x1 y1 + x2 y2 + x3 y3 - xo yinf - xinf yo` (Section 3 of the mass-point paper, in the
/// basis that makes the embedding of points a paraboloid). The diagonal basis `(e_-, e_1, e_2, e_3, e_+)` with squares
/// `(-1, 1, 1, 1, 1)` is reached by [`from_diagonal`](Self::from_diagonal) and [`to_diagonal`](Self::to_diagonal).
///
/// ```
/// use lorentz::LorentzVector;
/// let (origin, infinity) = (LorentzVector::ORIGIN, LorentzVector::INFINITY);
/// assert_eq!(origin.product(origin), 0.0);
/// assert_eq!(origin.product(infinity), -1.0);
/// assert_eq!(infinity.to_diagonal(), [0.5, 0.0, 0.0, 0.0, 0.5]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LorentzVector {
    /// Coordinate along `e_o`, the origin of space: the weight of a point, the curvature 1/radius of a sphere.
    pub o: f64,
    /// Euclidean part, coordinates along `e_1, e_2, e_3`.
    pub v: DVec3,
    /// Coordinate along `e_inf`, the point at infinity.
    pub inf: f64,
}

/// The sign of the square of a vector (Section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CausalType {
    /// Positive square: a sphere or a plane.
    SpaceLike,
    /// Square zero: a point, or the point at infinity.
    LightLike,
    /// Negative square: a sphere of imaginary radius.
    TimeLike,
}

impl LorentzVector {
    /// The zero vector.
    pub const ZERO: Self = Self::new(0.0, DVec3::ZERO, 0.0);
    /// `e_o`, the origin of space.
    pub const ORIGIN: Self = Self::new(1.0, DVec3::ZERO, 0.0);
    /// `e_inf`, the point at infinity.
    pub const INFINITY: Self = Self::new(0.0, DVec3::ZERO, 1.0);

    /// The vector `o e_o + v + inf e_inf`.
    #[must_use]
    pub const fn new(o: f64, v: DVec3, inf: f64) -> Self {
        Self { o, v, inf }
    }

    /// From the coordinates `[xo, x1, x2, x3, xinf]`.
    #[must_use]
    pub const fn from_null([o, x, y, z, inf]: [f64; 5]) -> Self {
        Self::new(o, DVec3::new(x, y, z), inf)
    }

    /// The coordinates `[xo, x1, x2, x3, xinf]`.
    #[must_use]
    pub const fn to_null(self) -> [f64; 5] {
        [self.o, self.v.x, self.v.y, self.v.z, self.inf]
    }

    /// From the coordinates `[x-, x1, x2, x3, x+]` in the diagonal basis.
    #[must_use]
    pub const fn from_diagonal([minus, x, y, z, plus]: [f64; 5]) -> Self {
        Self::new(0.5 * (minus - plus), DVec3::new(x, y, z), minus + plus)
    }

    /// The coordinates `[x-, x1, x2, x3, x+]` in the diagonal basis.
    #[must_use]
    pub const fn to_diagonal(self) -> [f64; 5] {
        let half = 0.5 * self.inf;
        [self.o + half, self.v.x, self.v.y, self.v.z, half - self.o]
    }

    /// The Lorentz product.
    #[must_use]
    pub fn product(self, other: Self) -> f64 {
        self.v.dot(other.v) - self.o * other.inf - self.inf * other.o
    }

    /// The Lorentz square, of any sign.
    #[must_use]
    pub fn square(self) -> f64 {
        self.v.length_squared() - 2.0 * self.o * self.inf
    }

    /// The Euclidean square of the coordinates: the yardstick of every relative tolerance.
    #[must_use]
    pub fn coordinate_square(self) -> f64 {
        self.v.length_squared() + self.o * self.o + self.inf * self.inf
    }

    /// The largest coordinate, in magnitude.
    #[must_use]
    pub fn max_abs(self) -> f64 {
        self.v
            .abs()
            .max_element()
            .max(self.o.abs())
            .max(self.inf.abs())
    }

    /// Whether all coordinates are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.o.is_finite() && self.v.is_finite() && self.inf.is_finite()
    }

    /// Space-like, light-like or time-like; the square counts as zero below 1e-12 of the coordinates' squares.
    ///
    /// For a vector of unknown origin only: a sphere far from the origin of space, compared with its radius, is
    /// close to light-like. Where the kind is known there is no need to ask.
    #[must_use]
    pub fn causal_type(self) -> CausalType {
        let square = self.square();
        if square.abs() <= LIGHT_LIKE * self.coordinate_square() {
            CausalType::LightLike
        } else if square > 0.0 {
            CausalType::SpaceLike
        } else {
            CausalType::TimeLike
        }
    }

    /// The object of space which this vector represents (Section 3 and Appendix A.1 of the paper).
    ///
    /// The scale of a space-like vector is dropped and its sign kept as orientation.
    ///
    /// # Errors
    /// [`Error::ZeroVector`], [`Error::TimeLike`], [`Error::NonFinite`].
    pub fn recover(self) -> Result<Object, Error> {
        let largest = self.max_abs();
        if !self.is_finite() {
            return Err(Error::NonFinite {
                what: "a Lorentz vector",
            });
        }
        if largest == 0.0 {
            return Err(Error::ZeroVector);
        }
        // A power of two nearby keeps the squares of huge and tiny vectors in range, without rounding.
        let unit = self / power_of_two_near(largest);
        match unit.causal_type() {
            CausalType::LightLike => self.recover_point(),
            CausalType::SpaceLike => {
                let normalised = unit / unit.square().sqrt();
                if normalised.is_flat() {
                    Plane::from_normal_and_offset(normalised.v, normalised.inf).map(Object::Plane)
                } else {
                    Sphere::new(normalised.v / normalised.o, 1.0 / normalised.o).map(Object::Sphere)
                }
            }
            CausalType::TimeLike => Err(Error::TimeLike {
                square: self.square(),
            }),
        }
    }

    /// The point of a vector that is known to be light-like.
    pub(crate) fn recover_point(self) -> Result<Object, Error> {
        if self.o.abs() <= ZERO_COORDINATE * self.max_abs() {
            return Ok(Object::Infinity { scale: self.inf });
        }
        let point = Point::new(self.v / self.o)?;
        Ok(Object::Point {
            point,
            scale: self.o,
        })
    }

    /// The point of the vector `s + factor t` that is known to be light-like. It is at infinity where the curvatures
    /// cancel to rounding, a test that does not depend on the unit of length.
    pub(crate) fn recover_point_between(s: Self, factor: f64, t: Self) -> Result<Object, Error> {
        let sum = s + factor * t;
        if sum.o.abs() <= ROUNDING * (s.o.abs() + (factor * t.o).abs()) {
            return Ok(Object::Infinity { scale: sum.inf });
        }
        let point = Point::new(sum.v / sum.o)?;
        Ok(Object::Point {
            point,
            scale: sum.o,
        })
    }

    /// Whether a unit vector is a plane: its curvature vanishes to rounding, and `v` is a unit vector without its help.
    pub(crate) fn is_flat(self) -> bool {
        self.o.abs() <= 4.0 * f64::EPSILON * self.max_abs() && (self.o * self.inf).abs() <= ROUNDING
    }

    /// The image under the translation by `shift`: `e_o` moves to the point `shift`, `e_inf` stays.
    #[must_use]
    pub fn translated(self, shift: DVec3) -> Self {
        let inf = self.inf + shift.dot(self.v) + 0.5 * self.o * shift.length_squared();
        Self::new(self.o, self.v + self.o * shift, inf)
    }

    /// The image under the scaling by `factor` about the origin of space.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.o / factor, self.v, self.inf * factor)
    }
}

/// The power of two at or below a positive finite number.
pub(crate) fn power_of_two_near(x: f64) -> f64 {
    // The exponent alone, by clearing the mantissa; subnormal numbers keep their value.
    let exponent_bits = x.to_bits() & 0x7ff0_0000_0000_0000;
    if exponent_bits == 0 {
        x
    } else {
        f64::from_bits(exponent_bits)
    }
}

impl VectorSpace for LorentzVector {
    const ZERO: Self = Self::ZERO;

    #[inline]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    #[inline]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline]
    fn magnitude(self) -> f64 {
        self.max_abs()
    }

    #[inline]
    fn is_finite(self) -> bool {
        Self::is_finite(self)
    }
}

impl Add for LorentzVector {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.o + other.o, self.v + other.v, self.inf + other.inf)
    }
}

impl Sub for LorentzVector {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.o - other.o, self.v - other.v, self.inf - other.inf)
    }
}

impl AddAssign for LorentzVector {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for LorentzVector {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for LorentzVector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.o, -self.v, -self.inf)
    }
}

impl Mul<f64> for LorentzVector {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.o * factor, self.v * factor, self.inf * factor)
    }
}

impl Mul<LorentzVector> for f64 {
    type Output = LorentzVector;
    fn mul(self, vector: LorentzVector) -> LorentzVector {
        vector * self
    }
}

impl Div<f64> for LorentzVector {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self::new(self.o / divisor, self.v / divisor, self.inf / divisor)
    }
}
