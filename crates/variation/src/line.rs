//! Lines, planes and implicit curves, and the polynomials to which they reduce a curve.
//!
//! A line `a x + b y + c = 0` turns a curve with points `(x_i, y_i)` and weights `w_i` into the polynomial with coefficients
//! `w_i (a x_i + b y_i + c)`; its roots are the hits, its sign changes the crossings of the control polygon.

use glam::{DVec2, DVec3};

use crate::Error;
use crate::arithmetic::{Form, Number, add, binomial, compose, convolve, subtract};
use crate::curve::Curve;

/// The line `a x + b y + c = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    normal: DVec2,
    offset: f64,
}

impl Line {
    /// The line `a x + b y + c = 0`.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::ZeroNormal`] for `a = b = 0`.
    pub fn try_new(a: f64, b: f64, c: f64) -> Result<Self, Error> {
        check_finite([a, b, c])?;
        if a == 0.0 && b == 0.0 {
            return Err(Error::ZeroNormal);
        }
        Ok(Self {
            normal: DVec2::new(a, b),
            offset: c,
        })
    }

    /// The line through two points, directed from `p` to `q`: positive on its left. Its coefficients are rounded; for hits
    /// with the points taken exactly, use [`Curve::meet_segment`] or [`Curve::meet_ray`].
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::ZeroNormal`] for equal points.
    pub fn through(p: DVec2, q: DVec2) -> Result<Self, Error> {
        let along = q - p;
        Self::try_new(-along.y, along.x, p.x * along.y - p.y * along.x)
    }

    /// `(a, b)`.
    #[must_use]
    pub fn normal(self) -> DVec2 {
        self.normal
    }

    /// `c`.
    #[must_use]
    pub fn offset(self) -> f64 {
        self.offset
    }

    /// `a x + b y + c`: its sign is the side of the point, its size the distance times the length of the normal.
    #[must_use]
    pub fn value(self, point: DVec2) -> f64 {
        self.normal.dot(point) + self.offset
    }
}

/// The plane `n . x + d = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// The plane `normal . x + offset = 0`.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::ZeroNormal`].
    pub fn try_new(normal: DVec3, offset: f64) -> Result<Self, Error> {
        check_finite([normal.x, normal.y, normal.z, offset])?;
        if normal == DVec3::ZERO {
            return Err(Error::ZeroNormal);
        }
        Ok(Self { normal, offset })
    }

    /// The normal, not normalised.
    #[must_use]
    pub fn normal(self) -> DVec3 {
        self.normal
    }

    /// The constant term.
    #[must_use]
    pub fn offset(self) -> f64 {
        self.offset
    }
}

/// A term `coefficient x^x_power y^y_power` of an implicit curve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Term {
    /// Power of `x`.
    pub x_power: u32,
    /// Power of `y`.
    pub y_power: u32,
    /// Factor.
    pub coefficient: f64,
}

/// The implicit algebraic curve on which a sum of terms is zero.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ImplicitCurve {
    terms: Vec<Term>,
}

impl ImplicitCurve {
    /// The curve on which the sum of the terms is zero.
    ///
    /// # Errors
    /// [`Error::NotFinite`]; [`Error::NoCoefficients`] without terms.
    pub fn try_new(terms: Vec<Term>) -> Result<Self, Error> {
        if terms.is_empty() {
            return Err(Error::NoCoefficients);
        }
        for (index, term) in terms.iter().enumerate() {
            if !term.coefficient.is_finite() {
                return Err(Error::NotFinite {
                    index,
                    value: term.coefficient,
                });
            }
        }
        Ok(Self { terms })
    }

    /// The conic `xx x^2 + xy x y + yy y^2 + x x + y y + constant = 0`, coefficients in this order.
    ///
    /// # Errors
    /// [`Error::NotFinite`].
    pub fn conic(coefficients: [f64; 6]) -> Result<Self, Error> {
        let powers = [(2, 0), (1, 1), (0, 2), (1, 0), (0, 1), (0, 0)];
        let term = |((x_power, y_power), coefficient)| Term {
            x_power,
            y_power,
            coefficient,
        };
        Self::try_new(powers.into_iter().zip(coefficients).map(term).collect())
    }

    /// The largest sum of powers.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.terms
            .iter()
            .map(|t| t.x_power as usize + t.y_power as usize)
            .max()
            .unwrap_or(0)
    }
}

pub(crate) fn check_finite<const N: usize>(numbers: [f64; N]) -> Result<(), Error> {
    match numbers.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(Error::NotFinite {
            index,
            value: numbers[index],
        }),
        None => Ok(()),
    }
}

/// `C(n,i) w_i (a x_i + b y_i + c)`.
pub(crate) struct LineForm<'a> {
    pub(crate) curve: Curve<'a>,
    pub(crate) line: Line,
}

impl Form for LineForm<'_> {
    fn degree(&self) -> usize {
        self.curve.degree()
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let (a, b, c) = (
            N::exactly(self.line.normal.x),
            N::exactly(self.line.normal.y),
            N::exactly(self.line.offset),
        );
        weighted(self.curve, |p| {
            a.product(&N::exactly(p.x))
                .sum(&b.product(&N::exactly(p.y)))
                .sum(&c)
        })
    }
}

/// As [`LineForm`], for the line through a point along `to - base`, all taken exactly.
pub(crate) struct ChordForm<'a> {
    pub(crate) curve: Curve<'a>,
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
    pub(crate) base: DVec2,
}

impl Form for ChordForm<'_> {
    fn degree(&self) -> usize {
        self.curve.degree()
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let difference = |a: f64, b: f64| N::exactly(a).difference(&N::exactly(b));
        let (x, y) = (
            difference(self.to.x, self.base.x),
            difference(self.to.y, self.base.y),
        );
        weighted(self.curve, |p| {
            x.product(&difference(p.y, self.from.y))
                .difference(&y.product(&difference(p.x, self.from.x)))
        })
    }
}

/// `C(n,i) w_i f(P_i)`.
pub(crate) fn weighted<N: Number>(curve: Curve<'_>, f: impl Fn(DVec2) -> N) -> Vec<N> {
    let n = curve.degree();
    curve
        .weighted_points()
        .enumerate()
        .map(|(i, (point, weight))| f(point).product(&N::exactly(weight)).times(binomial(n, i)))
        .collect()
}

/// The composition of a curve with an implicit one, homogeneous: `sum c X^i Y^j W^(m-i-j)`.
pub(crate) struct ImplicitForm<'a> {
    pub(crate) curve: Curve<'a>,
    pub(crate) implicit: &'a ImplicitCurve,
}

impl Form for ImplicitForm<'_> {
    fn degree(&self) -> usize {
        self.curve.degree() * self.implicit.degree()
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let x = weighted(self.curve, |p| N::exactly(p.x));
        let y = weighted(self.curve, |p| N::exactly(p.y));
        let w = weighted(self.curve, |_| N::exactly(1.0));
        let term = |t: &Term| {
            (
                t.x_power as usize,
                t.y_power as usize,
                N::exactly(t.coefficient),
            )
        };
        compose(
            &x,
            &y,
            &w,
            &self.implicit.terms.iter().map(term).collect::<Vec<_>>(),
        )
    }
}

/// `(X - x W)^2 + (Y - y W)^2 - r^2 W^2`, with centre and radius taken exactly.
pub(crate) struct CircleForm<'a> {
    pub(crate) curve: Curve<'a>,
    pub(crate) centre: DVec2,
    pub(crate) radius: f64,
}

impl Form for CircleForm<'_> {
    fn degree(&self) -> usize {
        2 * self.curve.degree()
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let from_centre = |p: f64, c: f64| N::exactly(p).difference(&N::exactly(c));
        let x = weighted(self.curve, |p| from_centre(p.x, self.centre.x));
        let y = weighted(self.curve, |p| from_centre(p.y, self.centre.y));
        let r = weighted(self.curve, |_| N::exactly(self.radius));
        subtract(
            &add(&convolve(&x, &x), &convolve(&y, &y)),
            &convolve(&r, &r),
        )
    }
}

/// `C(n,i) w_i (normal . P_i + offset)` in space.
pub(crate) struct PlaneForm<'a> {
    pub(crate) points: &'a [DVec3],
    pub(crate) weights: Option<&'a [f64]>,
    pub(crate) plane: Plane,
}

impl Form for PlaneForm<'_> {
    fn degree(&self) -> usize {
        self.points.len() - 1
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let n = self.degree();
        let value = |p: &DVec3| {
            let products = [
                (self.plane.normal.x, p.x),
                (self.plane.normal.y, p.y),
                (self.plane.normal.z, p.z),
            ]
            .map(|(a, b)| N::exactly(a).product(&N::exactly(b)));
            products
                .iter()
                .fold(N::exactly(self.plane.offset), |sum, product| {
                    sum.sum(product)
                })
        };
        self.points
            .iter()
            .enumerate()
            .map(|(i, p)| {
                let weight = self.weights.and_then(|w| w.get(i)).copied().unwrap_or(1.0);
                value(p).product(&N::exactly(weight)).times(binomial(n, i))
            })
            .collect()
    }
}
