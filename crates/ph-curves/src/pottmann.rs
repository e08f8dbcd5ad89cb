//! Pottmann's real form of rational PH curves, `U = (-e (a^2 + b^2), 2abf, (a^2 - b^2) f)`.

use bezier_mass::bernstein;
use glam::{DVec2, DVec3};

use crate::{DualCurve, Error, PhArc, TQuartic};

/// A rational PH curve by four real polynomials in Bernstein form on `[0, 1]`: normal
/// `(2ab, a^2 - b^2) / (a^2 + b^2)` and support `e/f`.
///
/// The circle of radius d with outward normal is `e = d f` (the source prints the opposite sign).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PottmannForm {
    /// Bernstein coefficients of a.
    pub a: Vec<f64>,
    /// Bernstein coefficients of b.
    pub b: Vec<f64>,
    /// Bernstein coefficients of the numerator of the support.
    pub e: Vec<f64>,
    /// Bernstein coefficients of the denominator of the support.
    pub f: Vec<f64>,
}

impl PottmannForm {
    /// The dual Bézier curve (1.7).
    ///
    /// # Errors
    /// [`Error::TooFew`] if a polynomial has no coefficients, and as [`DualCurve::from_vectors`].
    pub fn to_dual(&self) -> Result<DualCurve, Error> {
        for polynomial in [&self.a, &self.b, &self.e, &self.f] {
            if polynomial.is_empty() {
                return Err(Error::TooFew {
                    what: "coefficients",
                    given: 0,
                    needed: 1,
                });
            }
        }
        let degree = self.a.len().max(self.b.len()) - 1;
        let (a, b) = (
            bernstein::elevate_to(&self.a, degree),
            bernstein::elevate_to(&self.b, degree),
        );
        let spinor: Vec<DVec2> = a.iter().zip(&b).map(|(a, b)| DVec2::new(*a, *b)).collect();
        // (a^2 + b^2, 2ab, a^2 - b^2)
        let circle = bernstein::product_with(&spinor, &spinor, |u, v| {
            DVec3::new(u.dot(*v), u.x * v.y + u.y * v.x, u.x * v.x - u.y * v.y)
        });
        let support =
            bernstein::product_with(&self.e, &circle, |e, c| DVec3::new(-e * c.x, 0.0, 0.0));
        let normal =
            bernstein::product_with(&self.f, &circle, |f, c| DVec3::new(0.0, f * c.y, f * c.z));
        let class = support.len().max(normal.len()) - 1;
        let (support, normal) = (
            bernstein::elevate_to(&support, class),
            bernstein::elevate_to(&normal, class),
        );
        let vectors: Vec<DVec3> = support.iter().zip(&normal).map(|(s, n)| *s + *n).collect();
        DualCurve::from_vectors(&vectors)
    }

    /// The parallel curve at signed distance `distance` along the normal: `e + d f`.
    ///
    /// # Errors
    /// [`Error::TooFew`] if the numerator or the denominator has no coefficients; [`Error::NonFinite`].
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        if self.e.is_empty() || self.f.is_empty() {
            return Err(Error::TooFew {
                what: "coefficients",
                given: 0,
                needed: 1,
            });
        }
        let degree = self.e.len().max(self.f.len()).saturating_sub(1);
        let (e, f) = (
            bernstein::elevate_to(&self.e, degree),
            bernstein::elevate_to(&self.f, degree),
        );
        let e: Vec<f64> = e.iter().zip(&f).map(|(e, f)| e + distance * f).collect();
        if e.iter().any(|c| !c.is_finite()) {
            return Err(Error::NonFinite {
                what: "a coefficient or the distance of an offset",
            });
        }
        Ok(Self { e, ..self.clone() })
    }
}

/// Tschirnhausen's quartic as the source writes it: `a = t`, `b = 1`, `e = alpha t + beta`,
/// `f = gamma t + delta`, over any parameter interval.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TQuarticCoefficients {
    /// Slope of the numerator of the support.
    pub alpha: f64,
    /// Constant of the numerator of the support.
    pub beta: f64,
    /// Slope of the denominator of the support.
    pub gamma: f64,
    /// Constant of the denominator of the support.
    pub delta: f64,
}

impl TQuarticCoefficients {
    /// The parallel curve: `alpha + gamma d`, `beta + delta d` (the source prints `beta + gamma d`).
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        Self {
            alpha: self.alpha + self.gamma * distance,
            beta: self.beta + self.delta * distance,
            ..*self
        }
    }

    /// The arc over `[t0, t1]` in complex form; its parameter s relates to t by
    /// `(t - t0)/(t1 - t0) = rho s / ((1 - s) + rho s)`, `rho = f(t0)/f(t1)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::Pole`] if f vanishes on the interval; as [`PhArc::new`].
    pub fn arc(&self, t0: f64, t1: f64) -> Result<TQuartic, Error> {
        let ends = [t0, t1].map(|t| (self.alpha * t + self.beta, self.gamma * t + self.delta));
        if !ends.iter().all(|(e, f)| e.is_finite() && f.is_finite()) {
            return Err(Error::NonFinite {
                what: "a coefficient or a parameter",
            });
        }
        let [(e0, f0), (e1, f1)] = ends;
        // The product of the two may underflow.
        if f0 == 0.0 || f1 == 0.0 || (f0 > 0.0) != (f1 > 0.0) {
            return Err(Error::Pole { f0, f1 });
        }
        let rho = f0 / f1;
        let eighth_turn = DVec2::ONE.normalize();
        let spinor = |t: f64| eighth_turn.rotate(DVec2::new(t, -1.0));
        // e (t^2 + 1) in Bernstein form on [t0, t1].
        let length = [t0 * t0 + 1.0, t0 * t1 + 1.0, t1 * t1 + 1.0];
        let support = bernstein::product(&[e0, e1], &length);
        let mut power = 1.0 / f0;
        let g = [support[0], support[1], support[2], support[3]].map(|c| {
            let scaled = c * power;
            power *= rho;
            scaled
        });
        PhArc::new(spinor(t0), spinor(t1) * rho, g)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_real_form_and_the_complex_form_are_one_curve() {
        let source = TQuarticCoefficients {
            alpha: 0.7,
            beta: 1.9,
            gamma: 0.3,
            delta: 1.1,
        };
        let (t0, t1) = (-0.4, 0.9);
        let at = |slope: f64, constant: f64| vec![slope * t0 + constant, slope * t1 + constant];
        let form = PottmannForm {
            a: at(1.0, 0.0),
            b: vec![1.0],
            e: at(source.alpha, source.beta),
            f: at(source.gamma, source.delta),
        };
        for distance in [0.0, 0.8, -3.0] {
            let arc = source.offset(distance).arc(t0, t1).unwrap();
            let dual = form.offset(distance).unwrap().to_dual().unwrap();
            assert_eq!(dual.class(), 3);
            for t in [0.0, 0.3, 1.0] {
                let contact = dual.contact(t).unwrap();
                let s = arc.parameter_of_normal(contact.normal).unwrap();
                assert!((arc.point(s) - contact.point).length() < 1e-13);
                assert!((arc.radius(s) - contact.radius).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn equal_numerator_and_denominator_are_the_unit_circle() {
        let form = PottmannForm {
            a: vec![1.0, 0.2],
            b: vec![0.0, 1.0],
            e: vec![1.0, 1.0],
            f: vec![1.0],
        };
        let contact = form.to_dual().unwrap().contact(0.4).unwrap();
        assert!(
            (contact.point.length() - 1.0).abs() < 1e-15 && (contact.radius - 1.0).abs() < 1e-14
        );
        assert!(form.offset(f64::NAN).is_err());
        let empty = PottmannForm { f: vec![], ..form };
        assert!(empty.to_dual().is_err() && empty.offset(1.0).is_err());
        let empty = PottmannForm { e: vec![], ..empty };
        assert!(empty.offset(1.0).is_err());
    }

    #[test]
    fn a_common_factor_of_the_coefficients_is_no_pole() {
        let scaled = |factor: f64| TQuarticCoefficients {
            alpha: 0.7 * factor,
            beta: 1.9 * factor,
            gamma: 0.3 * factor,
            delta: 1.1 * factor,
        };
        let plain = scaled(1.0).arc(-0.4, 0.9).unwrap();
        for factor in [1e-170, -1e-170, 1e170] {
            let arc = scaled(factor).arc(-0.4, 0.9).unwrap();
            assert!((arc.point(0.3) - plain.point(0.3)).length() < 1e-14);
        }
        assert!(matches!(
            scaled(1e-170).arc(-5.0, 0.9),
            Err(Error::Pole { .. })
        ));
    }
}
