//! Lengths and foot points of PH arcs.

use bezier_mass::bernstein;
use glam::DVec2;

use super::PhArc;
use crate::Error;
use crate::arc_length::power_coefficients;
use crate::polynomial::roots;
use crate::quadrature::integrate;

/// Largest `|w1 - w0|^2 / min(|w0|, |w1|)^2` for which the arc length is integrated by Gauss's rule.
///
/// The closed form divides by `|w1 - w0|^2` and loses that many digits; the poles of the integrand
/// are `|w0| / |w1 - w0| >= 2` away from the arc, where sixteen nodes reach rounding (7.9^-32).
const NEARLY_PROPORTIONAL: f64 = 0.25;

impl<const N: usize> PhArc<N> {
    /// `int R d psi`, the length with the sign of radius times turning: parts beyond a cusp count
    /// negatively. In closed form, exact to rounding.
    #[must_use]
    pub fn signed_length(&self) -> f64 {
        let dw = self.w1 - self.w0;
        let slack = dw.length_squared() / self.w0.length_squared().min(self.w1.length_squared());
        if slack <= NEARLY_PROPORTIONAL {
            self.length_by_gauss()
        } else {
            self.length_by_division()
        }
    }

    /// `2 kappa int R/q dt` by one Gauss rule.
    fn length_by_gauss(&self) -> f64 {
        let radius = self.radius_polynomial();
        let rate = |t: f64| bernstein::evaluate(&radius, t) / self.spinor(t).length_squared();
        2.0 * self.kappa() * integrate(0.0, 1.0, 1, rate)
    }

    /// The same from `R = A q + (b t + c)`: a polynomial, a logarithm and the angle h.
    fn length_by_division(&self) -> f64 {
        let mut remainder = power_coefficients(&self.radius_polynomial());
        let dw = self.w1 - self.w0;
        let (q0, q1, q2) = (
            self.w0.length_squared(),
            2.0 * self.w0.dot(dw),
            dw.length_squared(),
        );
        let mut quotient_integral = 0.0;
        for k in (2..N).rev() {
            let a = remainder[k] / q2;
            remainder[k - 1] -= a * q1;
            remainder[k - 2] -= a * q0;
            quotient_integral += a / (k - 1) as f64;
        }
        let (c, b) = (remainder[0], remainder[1]);
        let logarithm = (self.w1.length_squared() / self.w0.length_squared()).ln();
        let kappa = self.kappa();
        let half_turning = 0.5 * self.turning();
        2.0 * kappa * (quotient_integral + b / (2.0 * q2) * logarithm)
            + 2.0 * (c - b * q1 / (2.0 * q2)) * half_turning
    }

    /// Arc length, the length of all parts: across a cusp both sides count positively. In closed form.
    #[must_use]
    pub fn length(&self) -> f64 {
        let (mut rest, mut begin, mut length) = (*self, 0.0, 0.0);
        for t in self.cusps() {
            if t > begin && t < 1.0 {
                let (before, after) = rest.split_inside((t - begin) / (1.0 - begin));
                length += before.signed_length().abs();
                (rest, begin) = (after, t);
            }
        }
        length + rest.signed_length().abs()
    }

    /// Parameters in `[0, 1]` of the points whose normal passes through `point`: the critical points of the distance,
    /// isolated and certified as roots of a polynomial of degree `N`. None if every normal does (a circle about it).
    #[must_use]
    pub fn feet(&self, point: DVec2) -> Vec<f64> {
        let normals = self.control_normals();
        // The tangent at t is h/q away, h = <n, X> - g; critical where h' q - h q' = 0, of degree N.
        let h: [f64; N] = std::array::from_fn(|k| normals[k].dot(point) - self.g[k]);
        let [q0, q1, q2] = self.normal_length();
        let (dq0, dq1) = (2.0 * (q1 - q0), 2.0 * (q2 - q1));
        // Bernstein products, times N. What lies beyond an end has the factor 0.
        let value = |k: usize| h.get(k).copied().unwrap_or(0.0);
        let rate: Vec<f64> = (0..=N)
            .map(|k| {
                let (left, right) = (k as f64, (N - k) as f64);
                let [a, b, c, d] = [3, 2, 1, 0].map(|back| value((k + 1).wrapping_sub(back)));
                let slope = right * (right - 1.0) * q0 * (d - c)
                    + 2.0 * left * right * q1 * (c - b)
                    + left * (left - 1.0) * q2 * (b - a);
                slope - right * dq0 * c - left * dq1 * b
            })
            .collect();
        roots(&rate)
    }

    /// Arc length from the start to parameter `t`, signed as [`PhArc::signed_length`].
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] unless `0 <= t <= 1`.
    pub fn signed_length_to(&self, t: f64) -> Result<f64, Error> {
        if t == 0.0 {
            Ok(0.0)
        } else {
            Ok(self.part(0.0, t)?.signed_length())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::arc;

    #[test]
    fn both_forms_of_the_length_agree() {
        let arc = arc(1.0);
        let (gauss, division) = (arc.length_by_gauss(), arc.length_by_division());
        assert!(
            (gauss - division).abs() < 1e-12 * gauss.abs(),
            "{gauss} {division}"
        );
    }
}
