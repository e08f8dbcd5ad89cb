//! Rational Bézier curves of any degree.

use crate::mass_point::is_clear;
use crate::{CurveJet, Error, Homography, MassPoint, Parameter, VectorSpace, bernstein};

/// A rational Bézier curve of any degree whose control points are mass points.
///
/// The curve is `h(t) = sum_i B_i(t) h_i`, a polynomial curve in the vector space of mass points; where its
/// weight `w(t)` is not zero it is the point `X(t) / w(t)`. Weights may be zero, negative, and `w(t)` may
/// change its sign on `[0, 1]`: the curve then passes through infinity, and everything here still works.
/// For degree two without allocation see [`Quadratic`](crate::Quadratic).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<MassPoint<V>>", into = "Vec<MassPoint<V>>")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct BezierCurve<V> {
    control: Vec<MassPoint<V>>,
}

impl<V: VectorSpace> BezierCurve<V> {
    /// The curve with these control mass points; its degree is one less than their number.
    ///
    /// # Errors
    /// [`Error::WrongCount`] without any; [`Error::NonFinite`].
    pub fn new(control: Vec<MassPoint<V>>) -> Result<Self, Error> {
        if control.is_empty() {
            return Err(Error::WrongCount {
                what: "control mass points",
                found: 0,
                needed: 1,
            });
        }
        for &mass_point in &control {
            mass_point.checked()?;
        }
        Ok(Self { control })
    }

    /// The curve with control mass points that are known to be finite, at least one of them.
    pub(crate) const fn from_checked(control: Vec<MassPoint<V>>) -> Self {
        Self { control }
    }

    /// The polynomial curve with these control points, all of weight one.
    ///
    /// # Errors
    /// As [`BezierCurve::new`].
    pub fn polynomial(points: &[V]) -> Result<Self, Error> {
        Self::new(
            points
                .iter()
                .map(|&position| MassPoint::point(position, 1.0))
                .collect(),
        )
    }

    /// The control mass points.
    #[must_use]
    pub fn control(&self) -> &[MassPoint<V>] {
        &self.control
    }

    /// The degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.control.len() - 1
    }

    /// The mass point at `t`: a point, or a vector where the weight vanishes to rounding.
    ///
    /// `t` may be any number, also outside `[0, 1]`; NaN gives a mass point without position.
    #[must_use]
    pub fn at(&self, t: f64) -> MassPoint<V> {
        let value = bernstein::evaluate(&self.control, t);
        if (0.0..=1.0).contains(&t) && is_clear(value.weight, &self.control) {
            value
        } else {
            value.settled(self.weight_terms([1.0 - t, t]))
        }
    }

    /// The mass point at a projective parameter, which may be infinite. Its weight carries the factor
    /// `denominator^n`.
    #[must_use]
    pub fn at_parameter(&self, parameter: Parameter) -> MassPoint<V> {
        let argument = parameter.barycentric();
        let value = bernstein::blossom(&self.control, &vec![argument; self.degree()]);
        value.settled(self.weight_terms(argument))
    }

    /// The absolute terms of the weight's Bernstein sum, which bound its rounding error.
    fn weight_terms(&self, [x, y]: [f64; 2]) -> f64 {
        let (n, x, y) = (self.degree() as i32, x.abs(), y.abs());
        let term = |(k, h): (i32, &MassPoint<V>)| {
            bernstein::binomial(n as usize, k as usize) * x.powi(n - k) * y.powi(k) * h.weight.abs()
        };
        (0..).zip(&self.control).map(term).sum()
    }

    /// The position at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `t` is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point(&self, t: f64) -> Result<V, Error> {
        position_at(self.at(t), t)
    }

    /// Value, first and second derivative at `t` as mass points.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet<V> {
        let [_, first, second] = bernstein::jet(&self.control, t);
        CurveJet {
            value: self.at(t),
            first,
            second,
        }
    }

    /// The derivative curve in the space of mass points, of one degree less (degree 0 stays degree 0).
    #[must_use]
    pub fn hodograph(&self) -> Self {
        let control = bernstein::derivative(&self.control);
        Self {
            control: if control.is_empty() {
                vec![MassPoint::ZERO]
            } else {
                control
            },
        }
    }

    /// The direction of travel at `t`, not normalised; `None` only if the curve is a single point.
    ///
    /// A positive multiple of the velocity where that exists and is not zero; the asymptote's direction
    /// where the weight vanishes; at a cusp or an end with coincident control points the limit for `t`
    /// increasing away from it (at `t >= 1`: arriving at it).
    #[must_use]
    pub fn tangent_direction(&self, t: f64) -> Option<V> {
        let [value, first, _] = bernstein::jet(&self.control, t);
        let tolerance = tangent_rounding(&self.control) * self.degree() as f64;
        let direction = value.moment(first);
        if direction.magnitude() > tolerance {
            return Some(direction);
        }
        let derivative = bernstein::derivative(&self.control);
        let moments = bernstein::product_with(&self.control, &derivative, |h, d| h.moment(*d));
        first_direction(moments, t, tolerance)
    }

    /// The curve after a homographic change of parameter: `q(u)` is `h` at `homography(u)` times
    /// `(c (1-u) + d u)^n`.
    #[must_use]
    pub fn reparametrised(&self, homography: Homography) -> Self {
        let (from, to) = (
            homography.start().barycentric(),
            homography.end().barycentric(),
        );
        Self {
            control: bernstein::reparametrise(&self.control, from, to),
        }
    }

    /// The part from parameter `start` to `end`: any two different parameters, also outside `[0, 1]`,
    /// infinite, or in reverse order. With finite numbers it is the part that avoids the parameter
    /// infinity; [`Parameter::opposite`] of one end selects the complementary part.
    ///
    /// # Errors
    /// [`Error::SingularHomography`] if the ends coincide; [`Error::NonFinite`].
    pub fn sub_arc(
        &self,
        start: impl Into<Parameter>,
        end: impl Into<Parameter>,
    ) -> Result<Self, Error> {
        Ok(self.reparametrised(Homography::between(start, end)?))
    }

    /// The rest of the whole curve: from the start to the end the other way, through the parameter infinity.
    #[must_use]
    pub fn complement(&self) -> Self {
        let flip = |(i, &h): (usize, &MassPoint<V>)| if i % 2 == 1 { -h } else { h };
        Self {
            control: self.control.iter().enumerate().map(flip).collect(),
        }
    }

    /// The curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            control: self.control.iter().rev().copied().collect(),
        }
    }

    /// de Casteljau's subdivision at `t` into the two parts; no weight is divided out.
    #[must_use]
    pub fn subdivide(&self, t: f64) -> (Self, Self) {
        let (mut left, mut right) = bernstein::subdivide(&self.control, t);
        let split = self.at(t);
        if let (Some(end), Some(start)) = (left.last_mut(), right.first_mut()) {
            (*end, *start) = (split, split);
        }
        (Self { control: left }, Self { control: right })
    }

    /// The same curve written with one degree more.
    #[must_use]
    pub fn elevated(&self) -> Self {
        Self {
            control: bernstein::elevate(&self.control),
        }
    }

    /// The same curve written with degree at least `degree`.
    #[must_use]
    pub fn elevated_to(&self, degree: usize) -> Self {
        Self {
            control: bernstein::elevate_to(&self.control, degree),
        }
    }

    /// The blossom at one parameter per degree (further ones are ignored, missing ones count as 0).
    #[must_use]
    pub fn blossom(&self, parameters: &[f64]) -> MassPoint<V> {
        let arguments: Vec<_> = parameters.iter().map(|&t| [1.0 - t, t]).collect();
        bernstein::blossom(&self.control, &arguments)
    }

    /// The curve with every control mass point mapped by `map`, which should be linear in the mass point:
    /// [`MassPoint::translated`], [`MassPoint::map_linear`], a projective map, a change of space.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<BezierCurve<W>, Error> {
        BezierCurve::new(self.control.iter().map(|&h| map(h)).collect())
    }
}

impl<V: VectorSpace> TryFrom<Vec<MassPoint<V>>> for BezierCurve<V> {
    type Error = Error;

    fn try_from(control: Vec<MassPoint<V>>) -> Result<Self, Error> {
        Self::new(control)
    }
}

impl<V> From<BezierCurve<V>> for Vec<MassPoint<V>> {
    fn from(curve: BezierCurve<V>) -> Self {
        curve.control
    }
}

/// The position of the value at `t`, or why there is none.
pub(crate) fn position_at<V: VectorSpace>(value: MassPoint<V>, t: f64) -> Result<V, Error> {
    value.position().ok_or(if t.is_finite() {
        Error::AtInfinity { t }
    } else {
        Error::NonFinite { what: "parameter" }
    })
}

/// A moment of mass points of this size is rounding error: each product carries a unit in the last place of
/// the largest weight times the largest weighted position, and 16 of them meet in one value.
pub(crate) fn tangent_rounding<V: VectorSpace>(control: &[MassPoint<V>]) -> f64 {
    let weight = control
        .iter()
        .fold(0.0, |largest: f64, h| largest.max(h.weight.abs()));
    let weighted = control
        .iter()
        .fold(0.0, |largest: f64, h| largest.max(h.weighted.magnitude()));
    16.0 * f64::EPSILON * weight * weighted
}

/// The first derivative, counting from the zeroth, in which a polynomial does not vanish at `t`, with the sign
/// that the polynomial has just after `t` (just before `t`, if `t >= 1`).
pub(crate) fn first_direction<V: VectorSpace>(
    mut coefficients: Vec<V>,
    t: f64,
    tolerance: f64,
) -> Option<V> {
    let side = if t < 1.0 { 1.0 } else { -1.0 };
    let mut sign = 1.0;
    while !coefficients.is_empty() {
        let value = bernstein::evaluate(&coefficients, t);
        if value.magnitude() > tolerance {
            return Some(value.times(sign));
        }
        coefficients = bernstein::derivative(&coefficients);
        sign *= side;
    }
    None
}

#[cfg(test)]
mod tests;
