//! Plane polynomial curves whose speed is a polynomial.

use bezier_mass::{BezierCurve, MassPoint, bernstein};
use glam::DVec2;

use crate::{ArcLength, Error, kubota, quadrature};

/// The curve `r(t) = start + ∫ h w²` of a complex polynomial `w`, its *preimage*, and a real common factor `h`.
///
/// By Kubota's theorem every plane polynomial curve with a polynomial speed `σ = h |w|²` has this form: with
/// `w = u + i v`, `x' = h (u² - v²)` and `y' = 2 h u v`. The arc length is a polynomial, the offsets are rational.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "StoredCurve", into = "StoredCurve")
)]
pub struct PolynomialPh {
    factor: Vec<f64>,
    preimage: Vec<DVec2>,
    preimage_derivative: Vec<DVec2>,
    hodograph: Vec<DVec2>,
    control_points: Vec<DVec2>,
    arc_length: ArcLength,
}

impl PolynomialPh {
    /// The curve from `start` with the given preimage (Bernstein coefficients on `[0, 1]`) and no common factor.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if the preimage is empty or zero, which is a point.
    pub fn try_new(start: DVec2, preimage: impl Into<Vec<DVec2>>) -> Result<Self, Error> {
        Self::with_factor(start, vec![1.0], preimage)
    }

    /// The curve with a real common factor `h` of the hodograph, not negative on `[0, 1]`.
    ///
    /// # Errors
    ///
    /// As for [`PolynomialPh::try_new`], and [`Error::NegativeSpeed`] with the least Bernstein coefficient of `h` if it
    /// is negative somewhere on `[0, 1]`.
    pub fn with_factor(
        start: DVec2,
        factor: Vec<f64>,
        preimage: impl Into<Vec<DVec2>>,
    ) -> Result<Self, Error> {
        let preimage = preimage.into();
        let finite = start.is_finite()
            && preimage.iter().all(|w| w.is_finite())
            && factor.iter().all(|h| h.is_finite());
        if !finite {
            return Err(Error::NonFinite {
                what: "start, factor or preimage of a PH curve",
            });
        }
        if preimage.iter().all(|w| *w == DVec2::ZERO) || factor.iter().all(|h| *h == 0.0) {
            return Err(Error::ZeroDirection {
                what: "hodograph of a PH curve",
            });
        }
        if !is_non_negative(&factor) {
            let coefficient = factor.iter().copied().fold(f64::INFINITY, f64::min);
            return Err(Error::NegativeSpeed { coefficient });
        }
        let square = bernstein::product_with(&preimage, &preimage, |a, b| a.rotate(*b));
        let norm = bernstein::product_with(&preimage, &preimage, |a, b| a.dot(*b));
        let hodograph = bernstein::product(&factor, &square);
        Ok(Self {
            preimage_derivative: bernstein::derivative(&preimage),
            control_points: bernstein::integral(&hodograph, start),
            arc_length: ArcLength::try_new(bernstein::product(&factor, &norm))?,
            factor,
            preimage,
            hodograph,
        })
    }

    /// Recognises a polynomial Bézier curve: by Kubota's theorem its hodograph is the square of a preimage times the real
    /// common factor of `x'` and `y'`, which may be constant.
    ///
    /// # Errors
    ///
    /// [`Error::NotPythagorean`] with the relative residual of `h w²`; [`Error::NegativeSpeed`] if the common factor changes
    /// its sign on `[0, 1]`, which makes a cusp; [`Error::TooFew`] for less than two points; [`Error::NonFinite`];
    /// [`Error::ZeroDirection`] for a single point.
    pub fn recognise(control_points: &[DVec2]) -> Result<Self, Error> {
        let (Some(&start), 2..) = (control_points.first(), control_points.len()) else {
            return Err(Error::TooFew {
                what: "control points",
                given: control_points.len(),
                needed: 2,
            });
        };
        if control_points.iter().any(|point| !point.is_finite()) {
            return Err(Error::NonFinite {
                what: "control point",
            });
        }
        let (factor, preimage) = kubota::factorise(&bernstein::derivative(control_points))?;
        Self::with_factor(start, factor, preimage)
    }

    /// The Bernstein coefficients of the real common factor `h`.
    #[must_use]
    pub fn factor(&self) -> &[f64] {
        &self.factor
    }

    /// The Bernstein coefficients of the preimage `w`.
    #[must_use]
    pub fn preimage(&self) -> &[DVec2] {
        &self.preimage
    }

    /// The Bézier control points.
    #[must_use]
    pub fn control_points(&self) -> &[DVec2] {
        &self.control_points
    }

    /// The exact arc length and its inverse.
    #[must_use]
    pub fn arc_length(&self) -> &ArcLength {
        &self.arc_length
    }

    /// The point at `t`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        bernstein::evaluate(&self.control_points, t)
    }

    /// The velocity at `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        bernstein::evaluate(&self.hodograph, t)
    }

    /// The signed curvature `2 det(w, w') / (h |w|⁴)` at `t`, positive where the curve turns left; infinite or NaN at a cusp.
    #[must_use]
    pub fn curvature(&self, t: f64) -> f64 {
        let (w, slope) = self.preimage_jet(t);
        let norm = w.length_squared();
        2.0 * w.perp_dot(slope) / (bernstein::evaluate::<f64>(&self.factor, t) * norm * norm)
    }

    /// The integral of the squared curvature over the arc length, by Gauss-Legendre quadrature with 16 points on each
    /// of four quarters: a criterion to compare curves, not a certified value.
    #[must_use]
    pub fn bending_energy(&self) -> f64 {
        quadrature::integrate(0.0, 1.0, 4, |t| {
            let curvature = self.curvature(t);
            curvature * curvature * self.arc_length.speed(t)
        })
    }

    /// The exact offset at the signed distance `distance` along the right normal `N = -i w² / |w|²`, a rational curve of
    /// degree `2n - 1` for a curve of degree `n`: `(σ | σ r - i distance h w²)`.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`] for the distance.
    pub fn offset(&self, distance: f64) -> Result<BezierCurve<DVec2>, Error> {
        if !distance.is_finite() {
            return Err(Error::NonFinite {
                what: "offset distance",
            });
        }
        let speed = self.arc_length.speed_coefficients();
        let degree = speed.len() + self.control_points.len() - 2;
        let weights = bernstein::elevate_to(speed, degree);
        let curve = bernstein::product(speed, &self.control_points);
        let normal = bernstein::elevate_to(&self.hodograph, degree);
        let control =
            weights
                .iter()
                .zip(curve.iter().zip(&normal))
                .map(|(&weight, (&point, &along))| {
                    MassPoint::from_homogeneous(weight, point - distance * along.perp())
                });
        Ok(BezierCurve::new(control.collect())?)
    }

    fn preimage_jet(&self, t: f64) -> (DVec2, DVec2) {
        (
            bernstein::evaluate(&self.preimage, t),
            bernstein::evaluate(&self.preimage_derivative, t),
        )
    }
}

/// A common factor may be negative by this share of its largest coefficient: a double zero is that much below zero in
/// rounded coefficients.
const NEGATIVE: f64 = 1e-12;

/// Whether a polynomial is not negative on `[0, 1]`: by the signs of its Bernstein coefficients, or else by its values at
/// the ends and at the certified zeros of its derivative.
fn is_non_negative(coefficients: &[f64]) -> bool {
    if coefficients.iter().all(|c| *c >= 0.0) {
        return true;
    }
    let largest = coefficients
        .iter()
        .fold(0.0_f64, |most, c| most.max(c.abs()));
    let allowed = |t: f64| bernstein::evaluate::<f64>(coefficients, t) >= -NEGATIVE * largest;
    allowed(0.0)
        && allowed(1.0)
        && variation::roots(&bernstein::derivative(coefficients))
            .is_ok_and(|roots| roots.iter().all(|root| allowed(root.value())))
}

/// The form in which a curve is serialized: what it is made from.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredCurve {
    start: DVec2,
    factor: Vec<f64>,
    preimage: Vec<DVec2>,
}

#[cfg(feature = "serde")]
impl From<PolynomialPh> for StoredCurve {
    fn from(curve: PolynomialPh) -> Self {
        Self {
            start: curve.point(0.0),
            factor: curve.factor,
            preimage: curve.preimage,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredCurve> for PolynomialPh {
    type Error = Error;

    fn try_from(stored: StoredCurve) -> Result<Self, Error> {
        Self::with_factor(stored.start, stored.factor, stored.preimage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PREIMAGE: [DVec2; 3] = [
        DVec2::new(1.0, 0.2),
        DVec2::new(0.8, -0.7),
        DVec2::new(0.4, 0.9),
    ];

    #[test]
    fn the_speed_is_the_length_of_the_velocity_and_offsets_keep_their_distance() {
        let curve = PolynomialPh::with_factor(DVec2::new(3.0, -1.0), vec![1.0, 0.5, 2.0], PREIMAGE)
            .unwrap();
        let offset = curve.offset(0.25).unwrap();
        for i in 0..=20 {
            let t = f64::from(i) / 20.0;
            let velocity = curve.velocity(t);
            assert!((velocity.length() - curve.arc_length().speed(t)).abs() < 1e-14);
            let expected = curve.point(t) - 0.25 * velocity.normalize().perp();
            assert!((offset.point(t).unwrap() - expected).length() < 1e-14);
        }
    }

    #[test]
    fn a_ph_curve_is_recognised_and_others_are_not() {
        let curve = PolynomialPh::try_new(DVec2::ONE, PREIMAGE).unwrap();
        let found = PolynomialPh::recognise(curve.control_points()).unwrap();
        let sign = found.preimage()[0].dot(PREIMAGE[0]).signum();
        for (w, given) in found.preimage().iter().zip(PREIMAGE) {
            assert!((sign * *w - given).length() < 1e-14);
        }
        let mut bent = curve.control_points().to_vec();
        bent[2].y += 1e-6;
        assert!(matches!(
            PolynomialPh::recognise(&bent),
            Err(Error::NotPythagorean { .. })
        ));
        let parabola = [DVec2::ZERO, DVec2::X, DVec2::ONE];
        assert!(matches!(
            PolynomialPh::recognise(&parabola),
            Err(Error::NotPythagorean { .. })
        ));
        assert!(matches!(
            PolynomialPh::recognise(&[DVec2::ONE]),
            Err(Error::TooFew { .. })
        ));
        assert!(matches!(
            PolynomialPh::recognise(&[DVec2::ONE; 3]),
            Err(Error::ZeroDirection { .. })
        ));
    }

    #[test]
    fn a_common_factor_is_recognised() {
        let factors = [
            vec![2.0],
            vec![1.0, 3.0],
            vec![0.0, 1.0],
            vec![1.0, 0.5, 2.0],
            vec![1.0, -0.2, 1.0],
            vec![1.0, -1.0, 1.0],
            vec![0.3, 1.0, 0.2, 2.0],
        ];
        for factor in &factors {
            for preimage in [&PREIMAGE[..1], &PREIMAGE[..2], &PREIMAGE] {
                let curve =
                    PolynomialPh::with_factor(DVec2::ONE, factor.clone(), preimage).unwrap();
                let found = PolynomialPh::recognise(curve.control_points()).unwrap();
                assert_eq!(
                    found.factor().len(),
                    factor.len(),
                    "{factor:?} {preimage:?}"
                );
                for t in [0.0, 0.2, 0.9] {
                    assert!((found.point(t) - curve.point(t)).length() < 1e-12);
                    let (a, b) = (found.arc_length().up_to(t), curve.arc_length().up_to(t));
                    assert!((a - b).abs() < 1e-12, "{factor:?} {preimage:?}");
                }
            }
        }
        // A factor of both signs is a cusp, at which the speed has no polynomial form.
        let turned = [DVec2::ZERO, DVec2::X, DVec2::new(0.2, 0.0)];
        assert!(matches!(
            PolynomialPh::recognise(&turned),
            Err(Error::NegativeSpeed { .. })
        ));
    }

    #[test]
    fn recognition_does_not_depend_on_place_size_or_direction() {
        let curve = PolynomialPh::with_factor(DVec2::ONE, vec![1.0, 0.5, 2.0], PREIMAGE).unwrap();
        for scale in [1e-7, 1.0, 1e9] {
            for angle in [0.0, 1.0, 2.0, 3.0, 4.0] {
                let turn = DVec2::from_angle(angle);
                let moved: Vec<DVec2> = curve
                    .control_points()
                    .iter()
                    .map(|p| (turn.rotate(*p) + DVec2::new(3.0, -8.0)) * scale)
                    .collect();
                let found = PolynomialPh::recognise(&moved).unwrap();
                assert_eq!(found.factor().len(), 3);
                let length = found.arc_length().total() / scale;
                assert!((length - curve.arc_length().total()).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn the_curvature_is_that_of_the_definition() {
        let curve = PolynomialPh::try_new(DVec2::ZERO, PREIMAGE).unwrap();
        let acceleration = bernstein::derivative(&bernstein::derivative(curve.control_points()));
        for t in [0.0, 0.3, 1.0] {
            let velocity = curve.velocity(t);
            let expected = velocity.perp_dot(bernstein::evaluate(&acceleration, t))
                / velocity.length().powi(3);
            assert!((curve.curvature(t) - expected).abs() < 1e-13);
        }
    }

    #[test]
    fn hostile_input_is_refused() {
        assert!(matches!(
            PolynomialPh::try_new(DVec2::ZERO, []),
            Err(Error::ZeroDirection { .. })
        ));
        assert!(matches!(
            PolynomialPh::try_new(DVec2::NAN, PREIMAGE),
            Err(Error::NonFinite { .. })
        ));
        let negative = PolynomialPh::with_factor(DVec2::ZERO, vec![1.0, -1.0], PREIMAGE);
        assert!(matches!(negative, Err(Error::NegativeSpeed { .. })));
        assert!(
            PolynomialPh::try_new(DVec2::ZERO, PREIMAGE)
                .unwrap()
                .offset(f64::INFINITY)
                .is_err()
        );
    }
}
