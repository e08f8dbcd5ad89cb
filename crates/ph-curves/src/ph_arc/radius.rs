//! The radius of curvature of PH arcs, a polynomial, and where it vanishes.

use super::PhArc;
use crate::polynomial::{is_positive, roots};

impl<const N: usize> PhArc<N> {
    /// Signed radius of curvature at `t`.
    #[must_use]
    pub fn radius(&self, t: f64) -> f64 {
        let w = self.spinor(t);
        let dw = self.w1 - self.w0;
        let [g, dg, ddg] = self.support_jet(t);
        let (q, dq, ddq) = (
            w.length_squared(),
            2.0 * w.dot(dw),
            2.0 * dw.length_squared(),
        );
        (q * ddg - dq * dg + ddq * g) / (4.0 * self.kappa() * self.kappa())
    }

    /// Bernstein coefficients of the radius of curvature, a polynomial of degree `N - 1`.
    ///
    /// All of one sign certify that the arc is regular and convex.
    #[must_use]
    pub fn radius_polynomial(&self) -> [f64; N] {
        let [q0, q1, q2] = self.normal_length();
        let (dq0, dq1, ddq) = (q1 - q0, q2 - q1, q0 - 2.0 * q1 + q2);
        let g = &self.g;
        let m = Self::CLASS;
        let (mut step, mut bend) = ([0.0; N], [0.0; N]);
        for k in 0..m {
            step[k] = g[k + 1] - g[k];
        }
        for k in 1..m {
            bend[k] = step[k] - step[k - 1];
        }
        // Bernstein products of q with g'', q' with g' and q'' with g; the binomial ratios of the
        // products cancel the factors m and m - 1 of the derivatives.
        let scale = 1.0 / (4.0 * self.kappa() * self.kappa());
        let [dq0, dq1, ddq] = [dq0, dq1, ddq].map(|c| 2.0 * scale * c);
        let [q0, q1, q2] = [q0, q1, q2].map(|c| scale * c);
        let [right, ahead, within, behind, left] = const { Self::radius_factors() };
        let mut radius: [f64; N] = std::array::from_fn(|k| ddq * g[k] + within[k] * q1 * bend[k]);
        for k in 0..m {
            radius[k] -= right[k] * dq0 * step[k];
        }
        for k in 0..m {
            radius[k + 1] -= left[k + 1] * dq1 * step[k];
        }
        for k in 1..m {
            radius[k - 1] += ahead[k - 1] * q0 * bend[k];
        }
        for k in 1..m {
            radius[k + 1] += behind[k + 1] * q2 * bend[k];
        }
        radius
    }

    /// For every coefficient `k` the numbers `r`, `r (r - 1)`, `2 r k`, `k (k - 1)` and `k`, with `r = N - 1 - k`.
    const fn radius_factors() -> [[f64; N]; 5] {
        let mut factors = [[0.0; N]; 5];
        let mut k = 0;
        while k < N {
            let (left, right) = (k as f64, (N - 1 - k) as f64);
            factors[0][k] = right;
            factors[1][k] = right * (right - 1.0);
            factors[2][k] = 2.0 * left * right;
            factors[3][k] = left * (left - 1.0);
            factors[4][k] = left;
            k += 1;
        }
        factors
    }

    /// Signed radii at the two ends.
    #[must_use]
    pub fn end_radii(&self) -> [f64; 2] {
        [self.radius(0.0), self.radius(1.0)]
    }

    /// Parameters in `[0, 1]` where the radius of curvature vanishes, in increasing order, isolated and certified
    /// as roots of the radius polynomial; none for a point, where it vanishes everywhere.
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        self.cusps_of_offset(0.0)
    }

    /// The same for the parallel arc at a distance.
    pub(crate) fn cusps_of_offset(&self, distance: f64) -> Vec<f64> {
        let radius = self.radius_polynomial().map(|r| r + distance);
        if is_positive(&radius) || is_positive(&radius.map(|r| -r)) {
            return Vec::new();
        }
        let noise = self.radius_noise() + f64::EPSILON * distance.abs();
        if radius.iter().all(|r| r.abs() <= noise) {
            return Vec::new();
        }
        roots(&radius)
    }

    /// Rounding error of a coefficient of the radius polynomial: some ulps of its largest term.
    pub(crate) fn radius_noise(&self) -> f64 {
        let largest = self.g.iter().fold(0.0_f64, |most, g| most.max(g.abs()));
        let kappa = self.kappa();
        let m = Self::CLASS as f64;
        let length = self.w0.length_squared().max(self.w1.length_squared());
        2.0 * m * m * f64::EPSILON * largest * length / (kappa * kappa)
    }
}
