//! Inflections and cusps of dual curves, and what is measured between them.

use bezier_mass::bernstein;
use glam::DVec3;

use super::DualCurve;
use crate::Error;
use crate::quadrature::integrate;

/// Coefficients of a remainder below this, relative to the largest coefficient, are taken for zero: a
/// common factor at a certified root leaves some ulps, grown by the division.
const COMMON_FACTOR: f64 = 1e-9;

impl DualCurve {
    /// Bernstein coefficients of the weight `x0` of the point form, whose roots are the inflections.
    #[must_use]
    pub fn turn_polynomial(&self) -> Vec<f64> {
        self.point_control().iter().map(|x| x.x).collect()
    }

    /// Bernstein coefficients of `det(U, U', U'') / (m^2 (m-1))`, of degree 3m - 6: its roots are the cusps.
    ///
    /// The determinant is that of the last three lines of de Casteljau's scheme.
    #[must_use]
    pub fn cusp_polynomial(&self) -> Vec<f64> {
        let count = self.class() - 1;
        let level = |k: usize| &self.vectors[k..k + count];
        let cross = bernstein::product_with(level(1), level(2), |a, b| a.cross(*b));
        bernstein::product_with(level(0), &cross, |a, b| a.dot(*b))
    }

    /// Parameters in `[0, 1]` where the normal is stationary, in increasing order, isolated and certified.
    ///
    /// None where it is stationary everywhere (all tangents parallel).
    #[must_use]
    pub fn inflections(&self) -> Vec<f64> {
        roots(&self.turn_polynomial())
    }

    /// Parameters in `[0, 1]` where the radius of curvature vanishes, in increasing order, isolated and
    /// certified. None where it vanishes everywhere (a point).
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        roots(&self.cusp_polynomial())
    }

    /// The point curve divided by the common factors that inflections leave in it: `U'` is parallel to
    /// `U` there, so every inflection in `[0, 1]` lowers the degree by one.
    ///
    /// Returns the reduced homogeneous control vectors and the parameters of the factors.
    #[must_use]
    pub fn reduced_points(&self) -> (Vec<DVec3>, Vec<f64>) {
        let mut points = self.point_control();
        let mut removed = Vec::new();
        for t in self.inflections() {
            if let Some(quotient) = divide_by_root(&points, t) {
                points = quotient;
                removed.push(t);
            }
        }
        (points, removed)
    }

    /// Arc length of the segment: all parts between its cusps count positively.
    ///
    /// Gauss's rule on halves until two refinements agree to 1e-13 of the length; exact closed forms exist for
    /// PH arcs ([`PhArc::signed_length`](crate::PhArc::signed_length)).
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if the segment passes through infinity: an inflection of the dual form that does
    /// not divide out, or a tangent at infinity.
    pub fn length(&self) -> Result<f64, Error> {
        // ds = |R dpsi| = |det(U, U', U'')| |n| / s^2 dt, with the factor m^2 (m - 1) / m^2.
        let (cusps, weights) = (self.cusp_polynomial(), self.turn_polynomial());
        if let Some(&t) = roots(&weights).first() {
            return Err(Error::AtInfinity { t });
        }
        let factor = (self.class() - 1) as f64;
        let speed = |t: f64| {
            let normal = bernstein::evaluate(&self.vectors, t);
            let weight = bernstein::evaluate(&weights, t);
            factor * bernstein::evaluate(&cusps, t) * normal.y.hypot(normal.z) / (weight * weight)
        };
        let mut ends = vec![0.0];
        ends.extend(self.cusps().into_iter().filter(|t| *t > 0.0 && *t < 1.0));
        ends.push(1.0);
        Ok(ends
            .windows(2)
            .map(|part| converged(part[0], part[1], speed).abs())
            .sum())
    }
}

/// Relative agreement of two refinements at which an arc length is final.
const LENGTH_AGREEMENT: f64 = 1e-13;
/// Most pieces of sixteen nodes that a length is given.
const MOST_PIECES: usize = 256;

fn converged(from: f64, to: f64, speed: impl Fn(f64) -> f64) -> f64 {
    let mut length = integrate(from, to, 1, &speed);
    let mut pieces = 2;
    while pieces <= MOST_PIECES {
        let finer = integrate(from, to, pieces, &speed);
        let agree = (finer - length).abs() <= LENGTH_AGREEMENT * finer.abs();
        length = finer;
        if agree {
            break;
        }
        pieces *= 2;
    }
    length
}

/// Certified real roots in `[0, 1]`, in increasing order; none of the zero polynomial.
fn roots(coefficients: &[f64]) -> Vec<f64> {
    variation::roots(coefficients).map_or_else(
        |_| Vec::new(),
        |roots| roots.iter().map(|root| root.value()).collect(),
    )
}

/// The quotient by the factor that vanishes at `root` alone, if all coordinates have it.
///
/// In Bernstein form `(t - r)` is `(-r, 1 - r)`. The division runs from both ends towards the middle, each
/// half in the direction in which it does not amplify errors.
fn divide_by_root(coefficients: &[DVec3], root: f64) -> Option<Vec<DVec3>> {
    let n = coefficients.len() - 1;
    let size = coefficients
        .iter()
        .map(|x| x.abs().max_element())
        .fold(0.0, f64::max);
    // n c_k = (n - k) (-r) d_k + k (1 - r) d_{k-1}, for the quotient d of degree n - 1.
    let mut quotient = vec![DVec3::ZERO; n];
    let split = ((n as f64) * root).round() as usize;
    for k in 0..split.min(n) {
        let carried = if k > 0 {
            quotient[k - 1] * (k as f64 * (1.0 - root))
        } else {
            DVec3::ZERO
        };
        quotient[k] = (coefficients[k] * n as f64 - carried) / (-(root * (n - k) as f64));
    }
    for k in (split..n).rev() {
        let carried = if k + 1 < n {
            quotient[k + 1] * (-(root * (n - k - 1) as f64))
        } else {
            DVec3::ZERO
        };
        quotient[k] = (coefficients[k + 1] * n as f64 - carried) / ((k + 1) as f64 * (1.0 - root));
    }
    let product = bernstein::product(&[-root, 1.0 - root], &quotient);
    let defect = product
        .iter()
        .zip(coefficients)
        .map(|(a, b)| (*a - *b).abs().max_element())
        .fold(0.0, f64::max);
    (defect <= COMMON_FACTOR * size && quotient.iter().all(|x| x.is_finite())).then_some(quotient)
}
