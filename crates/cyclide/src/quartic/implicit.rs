//! The implicit equation of a quartic cyclide.

use super::Quartic;
use glam::DVec3;

impl Quartic {
    /// Both printed forms of the implicit polynomial at a world point: (3) and (4) of the biquadratic paper. They are the
    /// same polynomial, so the two values differ by rounding alone.
    #[must_use]
    pub fn implicit_forms(&self, point: DVec3) -> [f64; 2] {
        let p = self.frame.point_to_local(point);
        let (a, b, c, mu) = (self.a, self.b, self.c, self.mu);
        let square = p.length_squared() - mu * mu;
        let (first, second) = (square + b * b, square - b * b);
        let (along_a, along_c) = (a * p.x - c * mu, c * p.x - a * mu);
        [
            first * first - 4.0 * (along_a * along_a + b * b * p.y * p.y),
            second * second - 4.0 * (along_c * along_c - b * b * p.z * p.z),
        ]
    }

    /// The implicit polynomial at a world point; zero on the surface. Its degree is 4 and its unit (length)⁴.
    #[must_use]
    pub fn implicit(&self, point: DVec3) -> f64 {
        self.implicit_forms(point)[0]
    }

    /// Gradient of [`Quartic::implicit`], world coordinates. It vanishes at singular points, and on the double sphere.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        self.frame
            .vector_to_world(self.local_gradient(self.frame.point_to_local(point), self.mu))
    }

    /// Gradient of the polynomial of the parallel surface with mean radius `mu`.
    pub(crate) fn local_gradient(&self, p: DVec3, mu: f64) -> DVec3 {
        let square = p.length_squared() - mu * mu + self.b * self.b;
        4.0 * square * p
            - DVec3::new(
                8.0 * self.a * (self.a * p.x - self.c * mu),
                8.0 * self.b * self.b * p.y,
                0.0,
            )
    }
}
