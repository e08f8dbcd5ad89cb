//! Quaternions as square roots of vectors: the numbers that spatial Pythagorean hodographs are made of.

use bezier_mass::VectorSpace;
use glam::{DQuat, DVec2, DVec3};

use crate::Error;

/// A quaternion `u + v i + p j + q k`, of any norm: the coefficient of a preimage, not a rotation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Quaternion {
    /// The real part `u`.
    pub scalar: f64,
    /// The imaginary part `(v, p, q)`.
    pub vector: DVec3,
}

impl Quaternion {
    /// `u + v i + p j + q k`.
    #[must_use]
    pub const fn new(u: f64, v: f64, p: f64, q: f64) -> Self {
        Self {
            scalar: u,
            vector: DVec3::new(v, p, q),
        }
    }

    /// `e^{angle i}`: multiplied from the right, it leaves `A i A*` alone and turns the other two axes.
    #[must_use]
    pub fn turn_about_i(angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self::new(cosine, sine, 0.0, 0.0)
    }

    /// The square root `A` of a vector in the sense `A i A* = vector`; all of them are
    /// `sqrt(|vector|) b e^{angle i}` with `b` the unit bisector of `i` and the vector.
    ///
    /// For a vector along `-i`, where every direction orthogonal to `i` bisects, `b = j`.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`] for NaN or infinite input. The root of the zero vector is zero.
    pub fn square_root(vector: DVec3, angle: f64) -> Result<Self, Error> {
        if !vector.is_finite() || !angle.is_finite() {
            return Err(Error::NonFinite {
                what: "vector or angle of a quaternion square root",
            });
        }
        let Some((unit, length)) = direction_and_length(vector) else {
            return Ok(Self::default());
        };
        // i + v/|v| cancels in its first coordinate near -i; this form of it does not.
        let sideways = DVec3::new(0.0, unit.y, unit.z);
        let first = if unit.x >= 0.0 {
            1.0 + unit.x
        } else {
            sideways.length_squared() / (1.0 - unit.x)
        };
        let bisector =
            direction_and_length(sideways + first * DVec3::X).map_or(DVec3::Y, |(unit, _)| unit);
        Ok(Self {
            scalar: 0.0,
            vector: bisector,
        }
        .times(length.sqrt())
        .product(Self::turn_about_i(angle)))
    }

    /// The Hamilton product.
    #[must_use]
    pub fn product(self, other: Self) -> Self {
        Self {
            scalar: self.scalar * other.scalar - self.vector.dot(other.vector),
            vector: self.scalar * other.vector
                + other.scalar * self.vector
                + self.vector.cross(other.vector),
        }
    }

    /// The conjugate `A* = u - v i - p j - q k`.
    #[must_use]
    pub fn conjugate(self) -> Self {
        Self {
            scalar: self.scalar,
            vector: -self.vector,
        }
    }

    /// The scalar product of the two 4-vectors.
    #[must_use]
    pub fn dot(self, other: Self) -> f64 {
        self.scalar * other.scalar + self.vector.dot(other.vector)
    }

    /// `|A|^2 = A A*`.
    #[must_use]
    pub fn norm_squared(self) -> f64 {
        self.dot(self)
    }

    /// The vector `A axis A*`: the axis turned by the quaternion and stretched by `|A|^2`.
    #[must_use]
    pub fn image(self, axis: DVec3) -> DVec3 {
        let twice_cross = 2.0 * self.vector.cross(axis);
        (self.scalar * self.scalar - self.vector.length_squared()) * axis
            + 2.0 * self.vector.dot(axis) * self.vector
            + self.scalar * twice_cross
    }

    /// The symmetric product `(A i B* + B i A*) / 2`, the polar form of [`Quaternion::image`] of `i`.
    #[must_use]
    pub fn polar_image(self, other: Self) -> DVec3 {
        self.polar_image_of(DVec3::X, other)
    }

    /// The symmetric product `(A axis B* + B axis A*) / 2`.
    #[must_use]
    pub fn polar_image_of(self, axis: DVec3, other: Self) -> DVec3 {
        let axis = Self {
            scalar: 0.0,
            vector: axis,
        };
        let one = self.product(axis).product(other.conjugate());
        one.vector
            .midpoint(other.product(axis).product(self.conjugate()).vector)
    }

    /// The `(1, i)` part of `A* B` as a complex number: real part [`Quaternion::dot`], imaginary part the twist
    /// about the tangent.
    #[must_use]
    pub fn complex_product(self, other: Self) -> DVec2 {
        let product = self.conjugate().product(other);
        DVec2::new(product.scalar, product.vector.x)
    }

    /// The `(j, k)` part of `A* B` as a complex number; for `B = A'` it is half the bending of the tangent.
    #[must_use]
    pub fn transversal_product(self, other: Self) -> DVec2 {
        let product = self.conjugate().product(other);
        DVec2::new(product.vector.y, product.vector.z)
    }

    /// The product with a complex number `x + y i` from the right.
    #[must_use]
    pub fn times_complex(self, factor: DVec2) -> Self {
        self.product(Self::new(factor.x, factor.y, 0.0, 0.0))
    }
}

/// The unit vector and the length of a vector other than zero, also where its square underflows.
fn direction_and_length(vector: DVec3) -> Option<(DVec3, f64)> {
    let scale = vector.abs().max_element();
    if scale == 0.0 {
        return None;
    }
    let scaled = vector / scale;
    let length = scaled.length();
    Some((scaled / length, scale * length))
}

impl From<DQuat> for Quaternion {
    fn from(q: DQuat) -> Self {
        Self::new(q.w, q.x, q.y, q.z)
    }
}

impl VectorSpace for Quaternion {
    const ZERO: Self = Self::new(0.0, 0.0, 0.0, 0.0);

    fn plus(self, other: Self) -> Self {
        Self {
            scalar: self.scalar + other.scalar,
            vector: self.vector + other.vector,
        }
    }

    fn times(self, factor: f64) -> Self {
        Self {
            scalar: factor * self.scalar,
            vector: factor * self.vector,
        }
    }

    fn magnitude(self) -> f64 {
        self.scalar.abs().max(self.vector.abs().max_element())
    }

    fn is_finite(self) -> bool {
        self.scalar.is_finite() && self.vector.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_root_gives_its_vector_back_in_every_direction() {
        let directions = [
            DVec3::X,
            DVec3::NEG_X,
            DVec3::new(-1.0, 1e-9, 0.0),
            DVec3::new(-1.0, 0.0, 1e-160),
            DVec3::new(0.3, -2.0, 7.0),
            DVec3::new(1e-200, 0.0, 1e-200),
        ];
        for vector in directions {
            for angle in [0.0, 0.5, -3.0] {
                let root = Quaternion::square_root(vector, angle).unwrap();
                let error = (root.image(DVec3::X) - vector).length();
                // A handful of roundings of terms no larger than the vector.
                assert!(
                    error <= 8.0 * f64::EPSILON * vector.length(),
                    "{vector}: {error:e}"
                );
            }
        }
        assert_eq!(
            Quaternion::square_root(DVec3::ZERO, 1.0).unwrap(),
            Quaternion::ZERO
        );
        assert!(Quaternion::square_root(DVec3::new(f64::NAN, 0.0, 0.0), 0.0).is_err());
    }

    #[test]
    fn the_image_is_the_sandwich_product() {
        let a = Quaternion::new(1.0, 0.2, -0.3, 0.1);
        let axis = DVec3::new(0.4, -1.0, 2.0);
        let sandwich = a
            .product(Quaternion {
                scalar: 0.0,
                vector: axis,
            })
            .product(a.conjugate());
        assert!((sandwich.vector - a.image(axis)).length() < 1e-15);
        assert!((a.polar_image(a) - a.image(DVec3::X)).length() < 1e-15);
        assert!((a.image(axis).length() - a.norm_squared() * axis.length()).abs() < 1e-15);
    }

    #[test]
    fn a_rotation_is_a_unit_quaternion() {
        let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 2.0) / 3.0, 0.7);
        let image = Quaternion::from(rotation).image(DVec3::Z);
        assert!((image - rotation * DVec3::Z).length() < 1e-15);
    }
}
