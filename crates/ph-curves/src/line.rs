//! Oriented lines in homogeneous line coordinates.

use glam::{DVec2, DVec3};

use crate::Error;
use crate::complex::unit;

/// The line `u0 + u1 x + u2 y = 0` with normal `(u1, u2)`, not necessarily of unit length.
///
/// The coordinate vector matters up to a positive factor for an oriented line, and including its
/// length for a control line of a dual Bézier curve, where the factor is a weight. `(u0, 0, 0)` is
/// the line at infinity.
///
/// ```
/// use ph_curves::{Line, glam::DVec2};
/// let wall = Line::through(DVec2::new(2.0, 0.0), DVec2::X)?;
/// assert_eq!(wall.support()?, 2.0);
/// assert_eq!(wall.offset(0.5)?.support()?, 2.5);
/// # Ok::<(), ph_curves::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "DVec3", into = "DVec3"))]
pub struct Line(DVec3);

impl Line {
    /// The line with coordinates `(u0, u1, u2)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`], or [`Error::ZeroLine`] for the zero vector.
    pub fn new(u0: f64, u1: f64, u2: f64) -> Result<Self, Error> {
        Self::try_from(DVec3::new(u0, u1, u2))
    }

    /// The line through `point` with the given normal (of any length but zero).
    ///
    /// # Errors
    /// [`Error::NonFinite`], or [`Error::ZeroDirection`] for a zero normal.
    pub fn through(point: DVec2, normal: DVec2) -> Result<Self, Error> {
        if normal == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "the normal of a line",
            });
        }
        Self::new(-normal.dot(point), normal.x, normal.y)
    }

    /// The line with coordinates that are known to be valid.
    pub(crate) const fn unchecked(coordinates: DVec3) -> Self {
        Self(coordinates)
    }

    /// `(u0, u1, u2)`.
    #[must_use]
    pub const fn coordinates(self) -> DVec3 {
        self.0
    }

    /// `(u1, u2)`: zero for the line at infinity.
    #[must_use]
    pub const fn normal(self) -> DVec2 {
        DVec2::new(self.0.y, self.0.z)
    }

    /// Signed distance of the line from the origin along its normal.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] for the line at infinity.
    pub fn support(self) -> Result<f64, Error> {
        let length = self.normal().length();
        if length == 0.0 {
            return Err(Error::ZeroDirection {
                what: "the line at infinity",
            });
        }
        Ok(-self.0.x / length)
    }

    /// Signed distance of `point` from the line, positive on the side of the normal.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] for the line at infinity.
    pub fn signed_distance(self, point: DVec2) -> Result<f64, Error> {
        let length = self.normal().length();
        if length == 0.0 {
            return Err(Error::ZeroDirection {
                what: "the line at infinity",
            });
        }
        Ok((self.0.x + self.normal().dot(point)) / length)
    }

    /// The parallel line at signed distance `distance` along the normal.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the distance is not finite or the coordinates overflow.
    pub fn offset(self, distance: f64) -> Result<Self, Error> {
        let length = self.0.y.hypot(self.0.z);
        Self::new(self.0.x - distance * length, self.0.y, self.0.z)
    }

    /// The line moved by `vector`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the vector is not finite or the coordinates overflow.
    pub fn translate(self, vector: DVec2) -> Result<Self, Error> {
        let u0 = self.0.x - self.normal().dot(vector);
        Self::new(u0, self.0.y, self.0.z)
    }

    /// The line turned about the origin by the argument of the complex number `turn`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if `turn` is zero.
    pub fn rotate(self, turn: DVec2) -> Result<Self, Error> {
        let normal = unit(turn)?.rotate(self.normal());
        Self::new(self.0.x, normal.x, normal.y)
    }

    /// The mirror image in the finite line `mirror`: `n -> n - 2k nu`, `u0 -> u0 + 2ck`, `k = <n, nu>`
    /// for the mirror `<nu, x> = c` with unit normal nu.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] if the mirror is the line at infinity.
    pub fn reflect(self, mirror: Self) -> Result<Self, Error> {
        let c = mirror.support()?;
        let nu = mirror.normal().normalize();
        let k = self.normal().dot(nu);
        let normal = self.normal() - 2.0 * k * nu;
        Ok(Self(DVec3::new(self.0.x + 2.0 * c * k, normal.x, normal.y)))
    }

    /// Homogeneous coordinates `(x0, x1, x2)` of the common point; the point is `(x1, x2) / x0`,
    /// at infinity for parallel lines and zero for one and the same line.
    #[must_use]
    pub fn meet(self, other: Self) -> DVec3 {
        self.0.cross(other.0)
    }
}

impl TryFrom<DVec3> for Line {
    type Error = Error;

    fn try_from(u: DVec3) -> Result<Self, Error> {
        if !u.is_finite() {
            return Err(Error::NonFinite {
                what: "a line coordinate",
            });
        }
        if u == DVec3::ZERO {
            return Err(Error::ZeroLine { index: 0 });
        }
        Ok(Self(u))
    }
}

impl From<Line> for DVec3 {
    fn from(line: Line) -> Self {
        line.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallels_keep_their_distance_under_any_weight() {
        for weight in [1.0, 1e-7, 3e9] {
            let line = Line::new(-2.0 * weight, 0.6 * weight, 0.8 * weight).unwrap();
            assert!((line.offset(0.25).unwrap().support().unwrap() - 2.25).abs() < 1e-15);
        }
    }

    #[test]
    fn a_mirror_is_an_involution_that_fixes_itself() {
        let mirror = Line::new(-1.0, 0.6, 0.8).unwrap();
        let line = Line::new(0.3, 2.0, -1.0).unwrap();
        let twice = line.reflect(mirror).unwrap().reflect(mirror).unwrap();
        assert!((twice.coordinates() - line.coordinates()).length() < 1e-15);
        let own = mirror.reflect(mirror).unwrap();
        assert!((own.coordinates() + mirror.coordinates()).length() < 1e-15);
    }

    #[test]
    fn degenerate_lines_are_named() {
        assert_eq!(Line::new(0.0, 0.0, 0.0), Err(Error::ZeroLine { index: 0 }));
        assert!(matches!(
            Line::new(f64::NAN, 1.0, 0.0),
            Err(Error::NonFinite { .. })
        ));
        let infinity = Line::new(1.0, 0.0, 0.0).unwrap();
        assert!(infinity.support().is_err() && infinity.signed_distance(DVec2::X).is_err());
        assert!(Line::through(DVec2::ZERO, DVec2::ZERO).is_err());
        assert!(infinity.rotate(DVec2::ZERO).is_err());
    }

    #[test]
    fn a_motion_never_makes_an_invalid_line() {
        let line = Line::new(-2.0, 0.6, 0.8).unwrap();
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(line.offset(bad).is_err());
            assert!(line.translate(DVec2::new(bad, 0.0)).is_err());
            assert!(line.rotate(DVec2::new(bad, 0.0)).is_err());
        }
        let far = Line::new(-1e308, 1.0, 0.0).unwrap();
        assert!(far.translate(DVec2::splat(1e308)).is_err());
        // Only the argument of the turn counts.
        let turned = line.rotate(DVec2::new(0.0, 3e200)).unwrap();
        assert_eq!(turned.coordinates(), DVec3::new(-2.0, -0.8, 0.6));
    }
}
