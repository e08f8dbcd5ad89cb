//! Projective changes of the parameter.

use crate::Error;

/// A parameter of a rational curve, possibly infinite: the ratio `numerator : denominator`.
///
/// Every finite `f64` converts into one; [`Parameter::INFINITY`] is `1 : 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[f64; 2]", into = "[f64; 2]"))]
pub struct Parameter {
    numerator: f64,
    denominator: f64,
}

impl Parameter {
    /// The parameter at infinity.
    pub const INFINITY: Self = Self {
        numerator: 1.0,
        denominator: 0.0,
    };

    /// The parameter `numerator / denominator`. A common factor changes only the factor of the mass
    /// points computed from it, and a common sign selects between complementary arcs.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroParameter`] for `0 : 0`.
    pub fn new(numerator: f64, denominator: f64) -> Result<Self, Error> {
        if !(numerator.is_finite() && denominator.is_finite()) {
            return Err(Error::NonFinite { what: "parameter" });
        }
        if numerator == 0.0 && denominator == 0.0 {
            return Err(Error::ZeroParameter);
        }
        Ok(Self {
            numerator,
            denominator,
        })
    }

    /// The ratio as a number; `None` at infinity.
    #[must_use]
    pub fn value(self) -> Option<f64> {
        (self.denominator != 0.0).then(|| self.numerator / self.denominator)
    }

    /// The barycentric coordinates `(denominator - numerator, numerator)`, which are `(1 - t, t)` for the
    /// parameter `t : 1`.
    #[must_use]
    pub fn barycentric(self) -> [f64; 2] {
        [self.denominator - self.numerator, self.numerator]
    }

    /// The same parameter with both terms negated: as the end of a sub-arc it selects the complementary arc.
    #[must_use]
    pub fn opposite(self) -> Self {
        Self {
            numerator: -self.numerator,
            denominator: -self.denominator,
        }
    }
}

/// `t` as `t : 1`. Non-finite numbers are refused where the parameter is used.
impl From<f64> for Parameter {
    fn from(t: f64) -> Self {
        Self {
            numerator: t,
            denominator: 1.0,
        }
    }
}

/// From the pair `[numerator, denominator]`.
impl TryFrom<[f64; 2]> for Parameter {
    type Error = Error;

    fn try_from([numerator, denominator]: [f64; 2]) -> Result<Self, Error> {
        Self::new(numerator, denominator)
    }
}

impl From<Parameter> for [f64; 2] {
    fn from(parameter: Parameter) -> Self {
        [parameter.numerator, parameter.denominator]
    }
}

/// The change of parameter `h(u) = (a (1-u) + b u) / (c (1-u) + d u)` with `ad - bc != 0`
/// (mass-point paper, Section 2.2).
///
/// It takes `u = 0` to `a/c` and `u = 1` to `b/d`, either of which may be infinite. The sign of the pair
/// `(b, d)` against `(a, c)` chooses between the arc that avoids the parameter infinity (`c` and `d` of the
/// same sign) and the complementary one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[f64; 4]", into = "[f64; 4]"))]
pub struct Homography {
    start: Parameter,
    end: Parameter,
}

/// A determinant below this fraction of its terms is rounding: `ad` and `bc` carry half a unit in the
/// last place each, and the numbers themselves usually come from a division or two.
const SINGULAR_DETERMINANT: f64 = 8.0 * f64::EPSILON;

impl Homography {
    /// The identity, `(a, b, c, d) = (0, 1, 1, 1)`.
    pub const IDENTITY: Self = Self {
        start: Parameter {
            numerator: 0.0,
            denominator: 1.0,
        },
        end: Parameter {
            numerator: 1.0,
            denominator: 1.0,
        },
    };

    /// The reversal `u -> 1 - u`, `(a, b, c, d) = (1, 0, 1, 1)`.
    pub const REVERSAL: Self = Self {
        start: Self::IDENTITY.end,
        end: Self::IDENTITY.start,
    };

    /// The homography with the four coefficients `a, b, c, d`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::SingularHomography`] if `ad - bc` is zero to rounding.
    pub fn new(a: f64, b: f64, c: f64, d: f64) -> Result<Self, Error> {
        if ![a, b, c, d].iter().all(|x| x.is_finite()) {
            return Err(Error::NonFinite {
                what: "coefficient of the homography",
            });
        }
        // Each column scaled to size one, so that the products neither overflow nor vanish.
        let (start, end) = (a.abs().max(c.abs()), b.abs().max(d.abs()));
        let (ad, bc) = ((a / start) * (d / end), (b / end) * (c / start));
        let determinant = ad - bc;
        // A pair 0 : 0 makes it NaN.
        if determinant.is_nan() || determinant.abs() <= SINGULAR_DETERMINANT * (ad.abs() + bc.abs())
        {
            return Err(Error::SingularHomography { determinant });
        }
        Ok(Self {
            start: Parameter {
                numerator: a,
                denominator: c,
            },
            end: Parameter {
                numerator: b,
                denominator: d,
            },
        })
    }

    /// The homography that takes 0 to `start` and 1 to `end`, both terms of each parameter as they are.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::SingularHomography`] if the two parameters coincide.
    pub fn between(start: impl Into<Parameter>, end: impl Into<Parameter>) -> Result<Self, Error> {
        let (start, end) = (start.into(), end.into());
        Self::new(
            start.numerator,
            end.numerator,
            start.denominator,
            end.denominator,
        )
    }

    /// The coefficients `[a, b, c, d]`.
    #[must_use]
    pub fn coefficients(self) -> [f64; 4] {
        [
            self.start.numerator,
            self.end.numerator,
            self.start.denominator,
            self.end.denominator,
        ]
    }

    /// The image `a : c` of 0.
    #[must_use]
    pub fn start(self) -> Parameter {
        self.start
    }

    /// The image `b : d` of 1.
    #[must_use]
    pub fn end(self) -> Parameter {
        self.end
    }

    /// The image of a parameter.
    #[must_use]
    pub fn apply(self, u: impl Into<Parameter>) -> Parameter {
        let [x, y] = u.into().barycentric();
        Parameter {
            numerator: self.start.numerator * x + self.end.numerator * y,
            denominator: self.start.denominator * x + self.end.denominator * y,
        }
    }

    /// The homography `u -> self(inner(u))`. Reparametrising a curve by it is the same as
    /// reparametrising by `self` first and by `inner` second.
    ///
    /// # Errors
    /// [`Error::SingularHomography`] or [`Error::NonFinite`] if the product is out of range.
    pub fn compose(self, inner: Self) -> Result<Self, Error> {
        Self::between(self.apply(inner.start), self.apply(inner.end))
    }

    /// The inverse homography.
    ///
    /// # Errors
    /// [`Error::SingularHomography`] or [`Error::NonFinite`] if the coefficients are out of range.
    pub fn inverse(self) -> Result<Self, Error> {
        // In barycentric coordinates the map is the matrix with columns `start`, `end`.
        let ([p, q], [r, s]) = (self.start.barycentric(), self.end.barycentric());
        let determinant = p * s - q * r;
        let [start, end] =
            [[s, -q], [-r, p]].map(|[x, y]| [y / determinant, (x + y) / determinant]);
        Self::new(start[0], end[0], start[1], end[1])
    }
}

/// From the coefficients `[a, b, c, d]`.
impl TryFrom<[f64; 4]> for Homography {
    type Error = Error;

    fn try_from([a, b, c, d]: [f64; 4]) -> Result<Self, Error> {
        Self::new(a, b, c, d)
    }
}

impl From<Homography> for [f64; 4] {
    fn from(homography: Homography) -> Self {
        homography.coefficients()
    }
}

impl Default for Homography {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_go_where_they_should() -> Result<(), Error> {
        let h = Homography::new(1.0, 2.0, 4.0, 0.0)?;
        assert_eq!(h.apply(0.0).value(), Some(0.25));
        assert_eq!(h.apply(1.0).value(), None);
        assert_eq!(h.apply(0.5).value(), Some(0.75));
        assert_eq!(h.apply(Parameter::INFINITY).value(), Some(-0.25));
        Ok(())
    }

    #[test]
    fn inverse_and_composition() -> Result<(), Error> {
        let h = Homography::new(1.0, 2.0, 4.0, 3.0)?;
        let g = Homography::new(-1.0, 2.0, 0.5, 3.0)?;
        let identity = h.compose(h.inverse()?)?.coefficients();
        for (x, y) in identity.iter().zip([0.0, 1.0, 1.0, 1.0]) {
            assert!((x - y).abs() < 1e-15, "{identity:?}");
        }
        for u in [-2.0, 0.25, 0.5, 7.0] {
            let both = h.compose(g)?.apply(u).value().unwrap_or(f64::NAN);
            let in_turn = h.apply(g.apply(u)).value().unwrap_or(f64::NAN);
            assert!((both - in_turn).abs() < 1e-14 * in_turn.abs());
        }
        Ok(())
    }

    #[test]
    fn singular_and_hostile_coefficients_are_refused() {
        assert!(matches!(
            Homography::new(1.0, 2.0, 2.0, 4.0),
            Err(Error::SingularHomography { .. })
        ));
        assert!(matches!(
            Homography::new(0.0, 0.0, 0.0, 0.0),
            Err(Error::SingularHomography { .. })
        ));
        assert!(matches!(
            Homography::between(0.5, 0.5),
            Err(Error::SingularHomography { .. })
        ));
        assert!(matches!(
            Homography::between(f64::NAN, 0.5),
            Err(Error::NonFinite { .. })
        ));
        assert!(Homography::new(1e200, -1e200, 1e200, 1e200).is_ok());
        assert!(Homography::new(1e-200, -1e-200, 1e-200, 1e-200).is_ok());
        assert_eq!(Parameter::new(0.0, 0.0), Err(Error::ZeroParameter));
    }
}
