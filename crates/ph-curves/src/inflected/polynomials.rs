//! What arcs about an inflection are by Bernstein coefficients: rational curves, cusps, feet of points.

use bezier_mass::bernstein;
use glam::{DVec2, DVec3};

use super::InflectedArc;
use crate::polynomial::{is_positive, product, roots};

/// Degree of the point form: `g` has degree 9, and the numerator `w (ġ w - 2 g ẇ)` two more.
const POINT_DEGREE: usize = 11;

impl InflectedArc {
    /// Bernstein coefficients over the range of `t` times the radius of curvature: the radius changes its sign in the
    /// inflection, this does not.
    fn scaled_radius(&self) -> [f64; 11] {
        let [from, to] = self.range;
        let span = self.span();
        let dw = self.w1 - self.w0;
        // q and its derivatives by τ, by powers of τ.
        let q = [
            self.w0.length_squared(),
            2.0 * self.w0.dot(dw),
            dw.length_squared(),
        ];
        // q g̈ - q̇ ġ + q̈ g, sorted by r, t r' and t² r''.
        let factors = [
            [0.75 * q[0], -0.75 * q[1], -0.25 * q[2]],
            [1.25 * q[0], 0.75 * q[1], 0.25 * q[2]],
            [0.25 * q[0], 0.25 * q[1], 0.25 * q[2]],
        ];
        let squares = [from * from, from * to, to * to];
        let even = |[a, b, c]: [f64; 3]| -> [f64; 5] {
            let [s0, s1, s2] = squares;
            [
                a + b * s0 + c * s0 * s0,
                a + b * 0.5 * (s0 + s1) + c * s0 * s1,
                a + b * (s0 + 4.0 * s1 + s2) / 6.0 + c * s1 * s1,
                a + b * 0.5 * (s1 + s2) + c * s1 * s2,
                a + b * s2 + c * s2 * s2,
            ]
        };
        let r = &self.r;
        let slope: [f64; 6] = std::array::from_fn(|k| 6.0 * (r[k + 1] - r[k]) / span);
        let bend: [f64; 5] = std::array::from_fn(|k| 5.0 * (slope[k + 1] - slope[k]) / span);
        let parts = [
            *r,
            product::<2, 6, 7>(&[from, to], &slope),
            product::<3, 5, 7>(&squares, &bend),
        ];
        let scale = 1.0 / (4.0 * self.kappa() * self.kappa());
        let mut sum: [f64; 11] =
            std::array::from_fn(|k| self.distance * (from + span * k as f64 / 10.0));
        for (part, factor) in parts.iter().zip(factors) {
            let term = product::<5, 7, 11>(&even(factor), part);
            for (sum, term) in sum.iter_mut().zip(term) {
                *sum += scale * term;
            }
        }
        sum
    }

    /// The coefficients of the radius times the own parameter, that parameter at both ends, and a bound of the speed over the product.
    pub(crate) fn radius_times_own(&self) -> ([f64; 11], [f64; 2], f64) {
        // As on plain arcs, with dτ/dt = 2t: the factor t is in the product.
        let turning = 2.0 * (self.w1 - self.w0).length_squared() / self.kappa().abs();
        let rate = 2.0 * turning * self.span().abs();
        (self.scaled_radius(), self.range, rate)
    }

    /// Whether no cusp lies on the piece and its radius of curvature has the sign of `sign` times `t`, certified by the signs of
    /// Bernstein coefficients.
    pub(crate) fn is_regular(&self, sign: f64) -> bool {
        is_positive(&self.scaled_radius().map(|c| c * sign))
    }

    /// Parameters in `[0, 1]` where the radius of curvature vanishes, in increasing order, isolated and certified.
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        let radius = self.scaled_radius();
        if is_positive(&radius) || is_positive(&radius.map(|r| -r)) {
            return Vec::new();
        }
        roots(&radius)
    }

    /// Parameters in `[0, 1]` of the points whose normal passes through `point`, and perhaps of the inflection.
    #[must_use]
    pub fn feet(&self, point: DVec2) -> Vec<f64> {
        let (support, length) = (self.support_coefficients(), self.length_coefficients());
        let toward = bernstein::elevate_to(&self.normal_coefficients(), 9);
        // The tangent at t is h/q away, h = <n, X> - g.
        let h: Vec<f64> = toward
            .iter()
            .zip(support)
            .map(|(n, g)| n.dot(point - self.origin) - g)
            .collect();
        let first = bernstein::product(&length, &bernstein::derivative(&h));
        let second = bernstein::product(&bernstein::derivative(&length), &h);
        let difference: Vec<f64> = first.iter().zip(&second).map(|(a, b)| a - b).collect();
        roots(&difference)
    }

    /// Bernstein coefficients over the range of `g = t³ r`, of degree 9.
    fn support_coefficients(&self) -> [f64; 10] {
        let [from, to] = self.range;
        let cube = [
            from * from * from,
            from * from * to,
            from * to * to,
            to * to * to,
        ];
        product(&cube, &self.r)
    }

    /// Bernstein coefficients over the range of `|w|²`, of degree 4.
    fn length_coefficients(&self) -> Vec<f64> {
        let w = self.spinor_coefficients();
        bernstein::product_with(&w, &w, |a, b| a.dot(*b))
    }

    /// Bernstein coefficients over the range of `w²`, of degree 4.
    fn normal_coefficients(&self) -> Vec<DVec2> {
        let w = self.spinor_coefficients();
        bernstein::product_with(&w, &w, |a, b| a.rotate(*b))
    }

    /// Bernstein coefficients over the range of w, a quadratic.
    fn spinor_coefficients(&self) -> [DVec2; 3] {
        let ([from, to], dw) = (self.range, self.w1 - self.w0);
        [from * from, from * to, to * to].map(|square| self.w0 + dw * square)
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point form, of degree 11, with positive weights.
    #[must_use]
    pub fn homogeneous(&self) -> Vec<DVec3> {
        let w = self.spinor_coefficients();
        let dw = self.w1 - self.w0;
        // ġ = t (3 r + t r') / 2
        let t_times = |c: &[f64]| bernstein::product(&self.range, c);
        let slope = t_times(&t_times(&bernstein::derivative(&self.r)));
        let rate: Vec<f64> = t_times(&self.r)
            .iter()
            .zip(&slope)
            .map(|(r, s)| 0.5 * (3.0 * r + s / self.span()))
            .collect();
        let inner: Vec<DVec2> = bernstein::product_with(&rate, &w, |g, w| *w * *g)
            .iter()
            .zip(self.support_coefficients())
            .map(|(a, g)| *a - 2.0 * g * dw)
            .collect();
        let numerator = bernstein::product_with(&w, &inner, |w, z| w.rotate(*z).perp());
        let weights = bernstein::elevate_to(&self.length_coefficients(), POINT_DEGREE);
        let normals = bernstein::elevate_to(&self.normal_coefficients(), POINT_DEGREE);
        let (scale, sign) = (2.0 * self.kappa(), self.kappa().signum());
        numerator
            .iter()
            .zip(weights.iter().zip(&normals))
            .map(|(x, (q, n))| {
                let x = *x + scale * (*q * self.origin + self.distance * *n);
                DVec3::new(scale * q, x.x, x.y) * sign
            })
            .collect()
    }
}
