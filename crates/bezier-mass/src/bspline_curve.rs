//! Rational B-spline curves.

use crate::curve::{position_at, tangent_rounding};
use crate::{BezierCurve, CurveJet, Error, Knots, MassPoint, VectorSpace, bernstein};

/// A rational B-spline curve (NURBS curve) whose control points are mass points; clamped, loose or periodic.
///
/// For many evaluations, or anything else that Bézier curves can do, take its [`pieces`](BSplineCurve::pieces).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "SplineData<V>", into = "SplineData<V>")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct BSplineCurve<V> {
    knots: Knots,
    control: Vec<MassPoint<V>>,
}

/// A polynomial piece of a spline: a Bézier curve over an interval of the spline's parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierPiece<V> {
    /// The spline's parameters at the piece's own 0 and 1.
    pub interval: [f64; 2],
    /// The piece.
    pub curve: BezierCurve<V>,
}

impl<V: VectorSpace> BSplineCurve<V> {
    /// The spline with these knots and control mass points.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are [`Knots::control_count`] control mass points; [`Error::NonFinite`].
    pub fn new(knots: Knots, control: Vec<MassPoint<V>>) -> Result<Self, Error> {
        let (found, needed) = (control.len(), knots.control_count());
        if found != needed {
            return Err(Error::WrongCount {
                what: "control mass points of the spline",
                found,
                needed,
            });
        }
        for &mass_point in &control {
            mass_point.checked()?;
        }
        Ok(Self { knots, control })
    }

    /// The spline with control mass points that are known to be finite and of the right number.
    pub(crate) const fn from_checked(knots: Knots, control: Vec<MassPoint<V>>) -> Self {
        Self { knots, control }
    }

    /// The polynomial spline with these knots and control points, all of weight one.
    ///
    /// # Errors
    /// As [`BSplineCurve::new`].
    pub fn polynomial(knots: Knots, points: &[V]) -> Result<Self, Error> {
        Self::new(
            knots,
            points
                .iter()
                .map(|&position| MassPoint::point(position, 1.0))
                .collect(),
        )
    }

    /// The knots.
    #[must_use]
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// The control mass points; of a periodic spline one period of them.
    #[must_use]
    pub fn control(&self) -> &[MassPoint<V>] {
        &self.control
    }

    /// The mass point at `t`: a point, or a vector where the weight vanishes to rounding.
    ///
    /// Outside the domain a periodic spline repeats itself, any other is continued by its first and last piece.
    #[must_use]
    pub fn at(&self, t: f64) -> MassPoint<V> {
        self.knots.mass_point(&self.control, t)
    }

    /// The position at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `t` is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point(&self, t: f64) -> Result<V, Error> {
        position_at(self.at(t), t)
    }

    /// Value, first and second derivative at `t` as mass points (at a knot: of the piece that begins there).
    #[must_use]
    pub fn jet(&self, t: f64) -> CurveJet<V> {
        let [_, first, second] = self.knots.jet(&self.control, t);
        CurveJet {
            value: self.at(t),
            first,
            second,
        }
    }

    /// The direction of travel at `t`, not normalised; see [`BezierCurve::tangent_direction`].
    #[must_use]
    pub fn tangent_direction(&self, t: f64) -> Option<V> {
        let [value, first, _] = self.knots.jet(&self.control, t);
        let direction = value.moment(first);
        let shortest = self
            .knots
            .breakpoints()
            .windows(2)
            .map(|k| k[1] - k[0])
            .fold(f64::INFINITY, f64::min);
        if direction.magnitude()
            > tangent_rounding(&self.control) * self.knots.degree() as f64 / shortest
        {
            return Some(direction);
        }
        let pieces = self.pieces();
        let inside = pieces
            .iter()
            .find(|piece| t < piece.interval[1])
            .or(pieces.last())?;
        let [start, end] = inside.interval;
        inside.curve.tangent_direction((t - start) / (end - start))
    }

    /// The polynomial pieces as Bézier curves, in order: what knot insertion to full multiplicity gives.
    #[must_use]
    pub fn pieces(&self) -> Vec<BezierPiece<V>> {
        let pieces = self.knots.bezier_pieces(&self.control).into_iter();
        pieces
            .map(|(interval, control)| BezierPiece {
                interval,
                curve: BezierCurve::from_checked(control),
            })
            .collect()
    }

    /// The same curve with one more knot at `t` (Boehm's algorithm).
    ///
    /// # Errors
    /// [`Error::OutsideDomain`]; [`Error::KnotMultiplicity`] if there are as many knots as the degree there already;
    /// [`Error::NonFinite`].
    pub fn with_knot(&self, t: f64) -> Result<Self, Error> {
        let (knots, control) = self.knots.insert(&self.control, t)?;
        Ok(Self { knots, control })
    }

    /// The spline with every control mass point mapped by `map`, which should be linear in the mass point.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<BSplineCurve<W>, Error> {
        BSplineCurve::new(
            self.knots.clone(),
            self.control.iter().map(|&h| map(h)).collect(),
        )
    }

    /// The polyline of positions at `count` equal steps over the domain, both ends included; parameters at infinity are
    /// left out. Works piece by piece, at the cost of Bézier evaluation.
    #[must_use]
    pub fn sample(&self, count: usize) -> Vec<V> {
        let [start, end] = self.knots.domain();
        let pieces = self.pieces();
        let mut piece = pieces.iter().peekable();
        let steps = count.saturating_sub(1).max(1) as f64;
        let parameters = (0..count).map(|i| start + (end - start) * (i as f64 / steps));
        let value = |t: f64| {
            while piece.peek().is_some_and(|piece| t > piece.interval[1]) && piece.len() > 1 {
                piece.next();
            }
            let piece = piece.peek()?;
            let [start, end] = piece.interval;
            bernstein::evaluate(piece.curve.control(), (t - start) / (end - start)).position()
        };
        parameters.filter_map(value).collect()
    }
}

/// A Bézier curve as a spline of one piece on `[0, 1]`.
impl<V: VectorSpace> TryFrom<&BezierCurve<V>> for BSplineCurve<V> {
    type Error = Error;

    fn try_from(curve: &BezierCurve<V>) -> Result<Self, Error> {
        Self::new(
            Knots::clamped(curve.degree(), &[0.0, 1.0])?,
            curve.control().to_vec(),
        )
    }
}

/// What a spline is written as.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct SplineData<V> {
    knots: Knots,
    control: Vec<MassPoint<V>>,
}

#[cfg(feature = "serde")]
impl<V> From<BSplineCurve<V>> for SplineData<V> {
    fn from(BSplineCurve { knots, control }: BSplineCurve<V>) -> Self {
        Self { knots, control }
    }
}

#[cfg(feature = "serde")]
impl<V: VectorSpace> TryFrom<SplineData<V>> for BSplineCurve<V> {
    type Error = Error;

    fn try_from(SplineData { knots, control }: SplineData<V>) -> Result<Self, Error> {
        Self::new(knots, control)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec2, dvec2};

    /// The unit circle as the NURBS of the textbooks: nine control points on a square, degree two.
    fn circle() -> Result<BSplineCurve<DVec2>, Error> {
        let corner = 0.5_f64.sqrt();
        let square = [
            (1, 0),
            (1, 1),
            (0, 1),
            (-1, 1),
            (-1, 0),
            (-1, -1),
            (0, -1),
            (1, -1),
            (1, 0),
        ];
        let control = square.iter().zip(0..).map(|(&(x, y), i)| {
            MassPoint::point(
                dvec2(f64::from(x), f64::from(y)),
                if i % 2 == 1 { corner } else { 1.0 },
            )
        });
        let knots = Knots::new(
            2,
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0],
        )?;
        BSplineCurve::new(knots, control.collect())
    }

    #[test]
    fn the_textbook_circle_is_round_and_has_four_quarters() -> Result<(), Error> {
        let circle = circle()?;
        let points = circle.sample(101);
        assert_eq!(points.len(), 101);
        for (i, point) in points.iter().enumerate() {
            assert!((point.length() - 1.0).abs() < 1e-15);
            assert!((circle.point(i as f64 / 25.0)? - *point).length() < 1e-14);
        }
        let pieces = circle.pieces();
        assert_eq!(pieces.len(), 4);
        assert_eq!(pieces[2].interval, [2.0, 3.0]);
        assert!((pieces[2].curve.point(0.5)? + DVec2::splat(0.5_f64.sqrt())).length() < 1e-15);
        let refined = circle.with_knot(0.3)?.with_knot(0.3)?;
        assert!((refined.point(0.7)? - circle.point(0.7)?).length() < 1e-15);
        assert!(matches!(
            refined.with_knot(0.3),
            Err(Error::KnotMultiplicity { knot: 0.3, .. })
        ));
        Ok(())
    }

    #[test]
    fn a_periodic_cubic_is_smooth_everywhere_and_repeats() -> Result<(), Error> {
        let points = [
            dvec2(0.0, 0.0),
            dvec2(3.0, 0.5),
            dvec2(4.0, 3.0),
            dvec2(1.0, 2.0),
        ];
        let closed =
            BSplineCurve::polynomial(Knots::periodic(3, &[0.0, 1.0, 2.5, 3.0, 5.0])?, &points)?;
        for knot in closed.knots().breakpoints() {
            let (before, after) = (closed.jet(knot - 1e-9), closed.jet(knot + 1e-9));
            for (a, b) in [
                (before.value, after.value),
                (before.first, after.first),
                (before.second, after.second),
            ] {
                assert!((a - b).magnitude() < 1e-7, "at {knot}: {a:?} against {b:?}");
            }
        }
        assert!((closed.point(-1.3)? - closed.point(3.7)?).length() < 1e-14);
        assert!((closed.point(0.0)? - closed.point(5.0)?).length() < 1e-14);
        Ok(())
    }

    #[test]
    fn jets_agree_with_the_pieces() -> Result<(), Error> {
        let circle = circle()?;
        for piece in circle.pieces() {
            let [start, end] = piece.interval;
            let (local, global) = (
                piece.curve.jet(0.3),
                circle.jet(start + 0.3 * (end - start)),
            );
            assert!((local.value - global.value).magnitude() < 1e-14);
            assert!((local.first - global.first * (end - start)).magnitude() < 1e-14);
            assert!((local.second - global.second * (end - start).powi(2)).magnitude() < 1e-13);
        }
        assert!(
            circle
                .tangent_direction(0.0)
                .is_some_and(|d| d.normalize().distance(DVec2::Y) < 1e-15)
        );
        Ok(())
    }

    #[test]
    fn stationary_ends_have_a_direction() -> Result<(), Error> {
        let points = [
            DVec2::ZERO,
            DVec2::ZERO,
            dvec2(1.0, 2.0),
            dvec2(3.0, 2.0),
            dvec2(3.0, 2.0),
        ];
        let curve = BSplineCurve::polynomial(Knots::clamped_uniform(3, 5)?, &points)?;
        for (t, expected) in [(0.0, dvec2(1.0, 2.0)), (1.0, dvec2(1.0, 0.0))] {
            let direction = curve.tangent_direction(t).unwrap_or(DVec2::NAN);
            assert!(
                (direction.normalize() - expected.normalize()).length() < 1e-14,
                "at {t}: {direction}"
            );
        }
        Ok(())
    }

    #[test]
    fn wrong_numbers_of_control_points_are_refused() -> Result<(), Error> {
        let knots = Knots::clamped_uniform(2, 4)?;
        assert!(matches!(
            BSplineCurve::polynomial(knots.clone(), &[1.0; 5]),
            Err(Error::WrongCount { needed: 4, .. })
        ));
        assert!(matches!(
            BSplineCurve::polynomial(knots, &[f64::NAN; 4]),
            Err(Error::NonFinite { .. })
        ));
        Ok(())
    }
}
