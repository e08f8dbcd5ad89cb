//! Rational quadratic curves, the paper's BR curves, by value.

use crate::curve::{first_direction, position_at, tangent_rounding};
use crate::{
    BezierCurve, CurveJet, Error, Homography, MassPoint, Parameter, VectorSpace, bernstein,
};

/// A rational quadratic Bézier curve with mass control points: an arc of a conic.
///
/// The same curve as a [`BezierCurve`] of degree two, but a plain value: nothing here allocates.
/// Circular arcs, hyperbolas in standard form and conic features are methods of the quadratics in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "[MassPoint<V>; 3]", into = "[MassPoint<V>; 3]")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct Quadratic<V> {
    control: [MassPoint<V>; 3],
}

impl<V: VectorSpace> Quadratic<V> {
    /// The curve with these control mass points.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn new(control: [MassPoint<V>; 3]) -> Result<Self, Error> {
        let [start, middle, end] = control;
        Ok(Self {
            control: [start.checked()?, middle.checked()?, end.checked()?],
        })
    }

    /// The curve with control mass points that are known to be finite.
    pub(crate) const fn from_checked(control: [MassPoint<V>; 3]) -> Self {
        Self { control }
    }

    /// The control mass points.
    #[inline]
    #[must_use]
    pub const fn control(&self) -> &[MassPoint<V>; 3] {
        &self.control
    }

    /// The mass point at `t`: a point, or a vector where the weight vanishes to rounding.
    ///
    /// `t` may be any number, also outside `[0, 1]`; NaN gives a mass point without position.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f64) -> MassPoint<V> {
        let [b0, b1, b2] = bernstein::quadratic_basis(t);
        let [h0, h1, h2] = self.control;
        let terms = b0 * h0.weight.abs() + b1.abs() * h1.weight.abs() + b2 * h2.weight.abs();
        (h0 * b0 + h1 * b1 + h2 * b2).settled(terms)
    }

    /// The mass point at a projective parameter, which may be infinite. Its weight carries the factor
    /// `denominator^2`.
    #[must_use]
    pub fn at_parameter(&self, parameter: Parameter) -> MassPoint<V> {
        let [x, y] = parameter.barycentric();
        let [w0, w1, w2] = self.control.map(|h| h.weight.abs());
        let terms = x * x * w0 + 2.0 * (x * y).abs() * w1 + y * y * w2;
        self.polar([x, y], [x, y]).settled(terms)
    }

    /// The position at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `t` is; [`Error::AtInfinity`] where the weight vanishes.
    #[inline]
    pub fn point(&self, t: f64) -> Result<V, Error> {
        position_at(self.at(t), t)
    }

    /// Value, first and second derivative at `t` as mass points.
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet<V> {
        let [h0, h1, h2] = self.control;
        let (d0, d1) = (h1 - h0, h2 - h1);
        CurveJet {
            value: self.at(t),
            first: d0.lerp(d1, t) * 2.0,
            second: (d1 - d0) * 2.0,
        }
    }

    /// The Bernstein coefficients of half the moment `w X' - w' X`: a positive multiple of the velocity,
    /// polynomial of degree two, with no division by a weight.
    #[must_use]
    pub fn tangent_moments(&self) -> [V; 3] {
        let [h0, h1, h2] = self.control;
        [h0.moment(h1), h0.moment(h2).times(0.5), h1.moment(h2)]
    }

    /// The direction of travel at `t`, not normalised; `None` only if the curve is a single point.
    ///
    /// A positive multiple of the velocity where that exists and is not zero; the asymptote's direction
    /// where the weight vanishes; at an end with coincident control points the limit for `t` increasing
    /// away from it (at `t >= 1`: arriving at it).
    #[must_use]
    pub fn tangent_direction(&self, t: f64) -> Option<V> {
        let moments = self.tangent_moments();
        let tolerance = tangent_rounding(&self.control);
        let direction = bernstein::evaluate(&moments, t);
        if direction.magnitude() > tolerance {
            return Some(direction);
        }
        first_direction(moments.to_vec(), t, tolerance)
    }

    /// The blossom at two parameters: bilinear, symmetric, and `blossom(t, t)` is the curve.
    #[must_use]
    pub fn blossom(&self, s: f64, t: f64) -> MassPoint<V> {
        self.polar([1.0 - s, s], [1.0 - t, t])
    }

    /// The blossom at two parameters in barycentric coordinates.
    fn polar(&self, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> MassPoint<V> {
        let [h0, h1, h2] = self.control;
        h0 * (x0 * y0) + h1 * (x0 * y1 + x1 * y0) + h2 * (x1 * y1)
    }

    /// The curve after a homographic change of parameter: `q(u)` is `h` at `homography(u)` times
    /// `(c (1-u) + d u)^2` (mass-point paper, Section 2.2).
    #[must_use]
    pub fn reparametrised(&self, homography: Homography) -> Self {
        let (from, to) = (
            homography.start().barycentric(),
            homography.end().barycentric(),
        );
        Self {
            control: [
                self.polar(from, from),
                self.polar(from, to),
                self.polar(to, to),
            ],
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

    /// The complementary arc: the rest of the conic, from the start to the end the other way.
    #[must_use]
    pub fn complement(&self) -> Self {
        let [h0, h1, h2] = self.control;
        Self {
            control: [h0, -h1, h2],
        }
    }

    /// The curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [h0, h1, h2] = self.control;
        Self {
            control: [h2, h1, h0],
        }
    }

    /// de Casteljau's subdivision at `t` into the two parts; no weight is divided out.
    #[must_use]
    pub fn subdivide(&self, t: f64) -> (Self, Self) {
        let [h0, h1, h2] = self.control;
        let (h01, h12) = (h0.lerp(h1, t), h1.lerp(h2, t));
        let h012 = h01
            .lerp(h12, t)
            .settled(h01.weight.abs() + h12.weight.abs());
        (
            Self {
                control: [h0, h01, h012],
            },
            Self {
                control: [h012, h12, h2],
            },
        )
    }

    /// The same arc, parametrised so that each end that is a point has weight 1 or -1; vectors stay.
    #[must_use]
    pub fn with_unit_end_weights(&self) -> Self {
        let [h0, h1, h2] = self.control;
        let factor = |h: MassPoint<V>| {
            if h.is_vector() {
                1.0
            } else {
                1.0 / h.weight.abs().sqrt()
            }
        };
        let (l, m) = (factor(h0), factor(h2));
        Self {
            control: [h0 * (l * l), h1 * (l * m), h2 * (m * m)],
        }
    }

    /// The same curve as a cubic, quartic, ...: see [`BezierCurve::elevated_to`].
    #[must_use]
    pub fn elevated_to(&self, degree: usize) -> BezierCurve<V> {
        BezierCurve::from(*self).elevated_to(degree)
    }

    /// The curve with every control mass point mapped by `map`, which should be linear in the mass point.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<Quadratic<W>, Error> {
        Quadratic::new(self.control.map(map))
    }
}

impl<V: VectorSpace> TryFrom<[MassPoint<V>; 3]> for Quadratic<V> {
    type Error = Error;

    fn try_from(control: [MassPoint<V>; 3]) -> Result<Self, Error> {
        Self::new(control)
    }
}

impl<V> From<Quadratic<V>> for [MassPoint<V>; 3] {
    fn from(quadratic: Quadratic<V>) -> Self {
        quadratic.control
    }
}

impl<V: VectorSpace> From<Quadratic<V>> for BezierCurve<V> {
    fn from(quadratic: Quadratic<V>) -> Self {
        Self::from_checked(quadratic.control.to_vec())
    }
}

/// A curve of degree two, or of a lower degree (which is raised).
impl<V: VectorSpace> TryFrom<&BezierCurve<V>> for Quadratic<V> {
    type Error = Error;

    fn try_from(curve: &BezierCurve<V>) -> Result<Self, Error> {
        let control = bernstein::elevate_to(curve.control(), 2);
        let control = control
            .try_into()
            .map_err(|control: Vec<_>| Error::WrongCount {
                what: "control mass points of a quadratic",
                found: control.len(),
                needed: 3,
            })?;
        Ok(Self { control })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, dvec2};

    fn general() -> Result<Quadratic<DVec2>, Error> {
        Quadratic::new([
            MassPoint::point(dvec2(0.0, 0.0), 1.0),
            MassPoint::point(dvec2(1.0, 2.0), 0.5),
            MassPoint::point(dvec2(3.0, 1.0), 2.0),
        ])
    }

    #[test]
    fn the_quadratic_is_the_curve_of_degree_two() -> Result<(), Error> {
        let quadratic = general()?;
        let curve = BezierCurve::from(quadratic);
        assert_eq!(Quadratic::try_from(&curve)?, quadratic);
        for t in [-0.5, 0.0, 0.3, 1.0, 1.7] {
            assert!((quadratic.at(t) - curve.at(t)).magnitude() < 1e-14);
            let (a, b) = (quadratic.jet(t), curve.jet(t));
            assert!((a.first - b.first).magnitude() < 1e-14);
            assert!((a.second - b.second).magnitude() < 1e-14);
            let parameter = Parameter::new(t, 1.0)?;
            assert!((quadratic.at_parameter(parameter) - quadratic.at(t)).magnitude() < 1e-14);
            assert!((curve.at_parameter(parameter) - quadratic.at(t)).magnitude() < 1e-14);
        }
        let homography = Homography::new(1.0, 2.0, 4.0, 3.0)?;
        let (q, c) = (
            quadratic.reparametrised(homography),
            curve.reparametrised(homography),
        );
        for (a, b) in q.control().iter().zip(c.control()) {
            assert!((*a - *b).magnitude() < 1e-13);
        }
        Ok(())
    }

    #[test]
    fn unit_end_weights_keep_the_conic_arc() -> Result<(), Error> {
        let arc = general()?;
        let unit = arc.with_unit_end_weights();
        assert_eq!(unit.control()[0].weight, 1.0);
        assert!((unit.control()[2].weight - 1.0).abs() < 1e-15);
        // The shape invariant w1^2 / (w0 w2) is kept.
        assert!((unit.control()[1].weight.powi(2) - 0.125).abs() < 1e-15);
        Ok(())
    }

    #[test]
    fn tangent_direction_is_along_the_velocity() -> Result<(), Error> {
        let arc = general()?;
        for t in [0.0, 0.4, 1.0] {
            let velocity = arc.jet(t).velocity().unwrap_or(DVec2::NAN);
            let direction = arc.tangent_direction(t).unwrap_or(DVec2::NAN);
            assert!((velocity.normalize() - direction.normalize()).length() < 1e-14);
        }
        Ok(())
    }

    #[test]
    fn non_finite_controls_are_refused() {
        let bad = MassPoint::vector(f64::INFINITY);
        assert!(matches!(
            Quadratic::new([bad; 3]),
            Err(Error::NonFinite { .. })
        ));
    }
}
