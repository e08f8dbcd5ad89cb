//! Points, normals and curvatures of a quartic cyclide at its parameters, and the way back.

use super::Quartic;
use glam::DVec3;
use std::f64::consts::PI;

/// One point of the parametrisation: cosines, sines and the common denominator, all divided by `a`.
#[derive(Clone, Copy, Debug)]
struct Angles {
    cos_theta: f64,
    sin_theta: f64,
    cos_psi: f64,
    sin_psi: f64,
    /// `cos theta cos psi`
    product: f64,
    /// `1 - e cos theta cos psi`, positive for `c < a`
    denominator: f64,
}

/// Below this share `a / mu` the digits of `psi` are taken from the normal.
const NEARLY_SPHERICAL: f64 = 1e-3;

impl Quartic {
    fn angles(&self, theta: f64, psi: f64) -> Angles {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_psi, cos_psi) = psi.sin_cos();
        let product = cos_theta * cos_psi;
        Angles {
            cos_theta,
            sin_theta,
            cos_psi,
            sin_psi,
            product,
            denominator: 1.0 - self.eccentricity * product,
        }
    }

    /// The point at `(theta, psi)`, both with period `2 pi`; world coordinates.
    #[must_use]
    pub fn point(&self, theta: f64, psi: f64) -> DVec3 {
        let at = self.angles(theta, psi);
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let local = DVec3::new(
            self.mu * (e - at.product) + self.b * q * at.cos_theta,
            q * at.sin_theta * (self.a - self.mu * at.cos_psi),
            q * at.sin_psi * (self.c * at.cos_theta - self.mu),
        );
        self.frame.point_to_world(local / at.denominator)
    }

    /// The unit normal at `(theta, psi)`, defined at singular points too (as the normal of the parametrisation).
    #[must_use]
    pub fn normal(&self, theta: f64, psi: f64) -> DVec3 {
        self.frame
            .vector_to_world(self.local_normal(&self.angles(theta, psi)))
    }

    fn local_normal(&self, at: &Angles) -> DVec3 {
        let (e, q) = (self.eccentricity, self.minor_ratio);
        DVec3::new(
            e - at.product,
            -q * at.sin_theta * at.cos_psi,
            -q * at.sin_psi,
        ) / at.denominator
    }

    /// Unit tangents of the two lines of curvature through `(theta, psi)`: first along growing `theta` (where
    /// `a > mu cos psi`), then along growing `psi` (where `mu > c cos theta`); both on a ring. They are defined at
    /// singular points too.
    #[must_use]
    pub fn principal_directions(&self, theta: f64, psi: f64) -> [DVec3; 2] {
        let at = self.angles(theta, psi);
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let numerator = self.local_normal(&at) * at.denominator;
        // N_theta / cos psi and N_psi, each of length q / denominator.
        let along_theta = DVec3::new(at.sin_theta, -q * at.cos_theta, 0.0) * at.denominator
            - e * at.sin_theta * numerator;
        let along_psi = DVec3::new(
            at.cos_theta * at.sin_psi,
            q * at.sin_theta * at.sin_psi,
            -q * at.cos_psi,
        ) * at.denominator
            - e * at.cos_theta * at.sin_psi * numerator;
        let scale = 1.0 / (q * at.denominator);
        [
            -scale * self.frame.vector_to_world(along_theta),
            scale * self.frame.vector_to_world(along_psi),
        ]
    }

    /// The derivatives of [`Quartic::point`] by `theta` and `psi`.
    #[must_use]
    pub fn partials(&self, theta: f64, psi: f64) -> [DVec3; 2] {
        let [along_theta, along_psi] = self.principal_directions(theta, psi);
        let at = self.angles(theta, psi);
        let scale = self.minor_ratio / at.denominator;
        [
            scale * (self.a - self.mu * at.cos_psi) * along_theta,
            scale * (self.mu - self.c * at.cos_theta) * along_psi,
        ]
    }

    /// Principal curvatures along `theta` and along `psi`, with `dN = kappa dP`: positive where the surface bends away
    /// from the normal. Infinite where the tangent sphere is a point.
    #[must_use]
    pub fn principal_curvatures(&self, theta: f64, psi: f64) -> [f64; 2] {
        [
            psi.cos() / (self.mu * psi.cos() - self.a),
            1.0 / (self.mu - self.c * theta.cos()),
        ]
    }

    /// The parameters `[theta, psi]`, each in `(-pi, pi]`, of a point of the surface. For a point beside the surface the
    /// result belongs to some point near it; project with [`crate::Dupin::closest`] first where that matters.
    ///
    /// Closed form from `S = 2 b² (a - mu cos psi) / D` and `T = 2 b² cos psi (c cos theta - mu) / D`, the two squares
    /// inside the printed equations; nothing is iterated.
    #[must_use]
    pub fn parameters_at(&self, point: DVec3) -> [f64; 2] {
        let p = self.frame.point_to_local(point);
        if self.a == 0.0 {
            return self.parameters_of_normal(p.normalize_or(DVec3::X));
        }
        let (a, b, c, mu) = (self.a, self.b, self.c, self.mu);
        let square = p.length_squared() - mu * mu;
        let theta_sign = (square + b * b).signum();
        let theta = angle(theta_sign * b * p.y, theta_sign * (a * p.x - c * mu));
        if a < NEARLY_SPHERICAL * mu {
            // Next to a sphere the squares below cancel; the normal, from the centre on the ellipse, does not.
            let (sin, cos) = theta.sin_cos();
            let normal = (p - DVec3::new(a * cos, b * sin, 0.0)) / (mu - c * cos);
            let [other, psi] = self.parameters_of_normal(normal);
            let psi = if (theta - other).cos() > 0.0 {
                psi
            } else if psi < 0.0 {
                -PI - psi
            } else {
                PI - psi
            };
            return [theta, psi];
        }
        let lever = c * p.x - a * mu;
        let psi_sign = lever.signum();
        let psi = angle(psi_sign * 2.0 * b * p.z, psi_sign * (square - b * b));
        [theta, psi]
    }

    /// One of the two parameter pairs with the given local unit normal, that with `cos psi >= 0`; the other is
    /// `(theta + pi, pi - psi)`. The inverse of the Gauss map.
    pub(crate) fn parameters_of_normal(&self, normal: DVec3) -> [f64; 2] {
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let denominator = 1.0 - e * normal.x;
        let product = (e - normal.x) / denominator;
        let cos_psi_sin_theta = -q * normal.y / denominator;
        let sin_psi = -q * normal.z / denominator;
        [
            angle(cos_psi_sin_theta, product),
            sin_psi.atan2(product.hypot(cos_psi_sin_theta)),
        ]
    }
}

/// The angle of a vector, in `(-pi, pi]`: minus pi, the answer for a sine of minus zero, is pi.
fn angle(sin: f64, cos: f64) -> f64 {
    let angle = sin.atan2(cos);
    if angle == -PI { PI } else { angle }
}
