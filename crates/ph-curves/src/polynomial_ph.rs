//! Plane polynomial curves whose speed is a polynomial.

use bezier_mass::{BezierCurve, MassPoint, bernstein};
use glam::DVec2;

use crate::complex;
use crate::{ArcLength, Error, quadrature};

/// The curve `r(t) = start + ∫ h w²` of a complex polynomial `w`, its *preimage*, and a real common factor `h`.
///
/// By Kubota's theorem every plane polynomial curve with a polynomial speed `σ = h |w|²` has this form: with
/// `w = u + i v`, `x' = h (u² - v²)` and `y' = 2 h u v`. The arc length is a polynomial, the offsets are rational.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PolynomialPh {
    factor: Vec<f64>,
    preimage: Vec<DVec2>,
    preimage_derivative: Vec<DVec2>,
    hodograph: Vec<DVec2>,
    control_points: Vec<DVec2>,
    arc_length: ArcLength,
}

/// A hodograph counts as Pythagorean if `x'² + y'²` is a square up to this share of its largest coefficient: far above
/// the rounding of control points given to double precision, far below any curve that is not meant to be one.
const RECOGNITION_TOLERANCE: f64 = 1e-9;

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
    /// As for [`PolynomialPh::try_new`], and [`Error::NegativeSpeed`] if a Bernstein coefficient of `h` is negative
    /// (which keeps the speed from being proved non-negative; subdivide, or reverse the sign of `h`).
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
        if let Some(&coefficient) = factor.iter().find(|h| **h < 0.0) {
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

    /// Recognises a polynomial Bézier curve without a common factor of `x'` and `y'`: the preimage is the polynomial
    /// square root of the complex hodograph.
    ///
    /// # Errors
    ///
    /// [`Error::NotPythagorean`] with the relative residual of the square; [`Error::TooFew`] for less than two points;
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if the first derivative vanishes (then there is a common factor).
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
        let hodograph = bernstein::derivative(control_points);
        let scale = hodograph
            .iter()
            .fold(0.0, |largest: f64, z| largest.max(z.length()));
        let Some(preimage) = square_root(&hodograph) else {
            return Err(Error::ZeroDirection {
                what: "first derivative of the curve",
            });
        };
        let square = bernstein::product_with(&preimage, &preimage, |a, b| a.rotate(*b));
        let misses = square
            .iter()
            .zip(&hodograph)
            .map(|(found, given)| (*found - *given).length());
        let relative_residual = if square.len() == hodograph.len() {
            misses.fold(0.0, f64::max) / scale
        } else {
            1.0
        };
        if relative_residual.is_nan() || relative_residual > RECOGNITION_TOLERANCE {
            return Err(Error::NotPythagorean { relative_residual });
        }
        Self::try_new(start, preimage)
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

/// The complex polynomial whose square has these Bernstein coefficients, if there is one: solved for from the start,
/// coefficient by coefficient, so that only the first half of the equations is met by construction.
fn square_root(square: &[DVec2]) -> Option<Vec<DVec2>> {
    let degree = square.len().checked_sub(1)?;
    let half = degree / 2;
    let first = complex::sqrt(*square.first()?);
    if first == DVec2::ZERO {
        return None;
    }
    // In powers of t / (1 - t) a Bernstein coefficient carries its binomial, and products are plain convolutions.
    let mut scaled = vec![first];
    for k in 1..=half {
        let known = (1..k).fold(DVec2::ZERO, |sum, i| sum + scaled[i].rotate(scaled[k - i]));
        let rest = bernstein::binomial(degree, k) * square[k] - known;
        scaled.push(complex::divide(rest, 2.0 * first));
    }
    Some(
        scaled
            .iter()
            .enumerate()
            .map(|(k, w)| *w / bernstein::binomial(half, k))
            .collect(),
    )
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
        let still = [DVec2::ONE, DVec2::ONE, DVec2::X, DVec2::Y];
        assert!(matches!(
            PolynomialPh::recognise(&still),
            Err(Error::ZeroDirection { .. })
        ));
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
