//! Villarceau circles: the two further circles through every point of a ring.

use crate::{CurvatureCircle, Error, Kind, Quartic};
use glam::DVec3;
use lorentz::Circle;

impl Quartic {
    /// A Villarceau circle: the part of the plane tangent to the cone `(mu x - a c)² + (mu² - c²) y² = (a² - mu²) z²` at angle
    /// `phi` that lies on a sphere about a point of the plane `z = 0`. `sign >= 0` selects the one of the two circles in this plane.
    ///
    /// # Errors
    ///
    /// [`Error::NotARing`] unless `c < mu < a`; [`Error::NotFinite`], [`Error::LengthOutOfRange`].
    pub fn villarceau_circle(&self, phi: f64, sign: f64) -> Result<Circle, Error> {
        self.require_ring()?;
        let (sin, cos) = crate::frame::finite("phi", phi)?.sin_cos();
        let sign = if crate::frame::finite("sign", sign)? < 0.0 {
            -1.0
        } else {
            1.0
        };
        let (a, b, c, mu) = (self.a(), self.b(), self.c(), self.mu());
        let (root_c, root_a) = (((mu - c) * (mu + c)).sqrt(), ((a - mu) * (a + mu)).sqrt());
        let sphere_centre = DVec3::new(-mu * sin, root_c * cos, 0.0) * sign;
        let normal = DVec3::new(cos * mu, sin * root_c, -root_a).normalize();
        let plane = cos * a * c / DVec3::new(cos * mu, sin * root_c, -root_a).length();
        let centre = sphere_centre - (normal.dot(sphere_centre) - plane) * normal;
        let radius = b * ((a + sign * c * sin) / (a - sign * c * sin)).sqrt();
        Ok(Circle::new(
            self.frame().point_to_world(centre),
            radius,
            self.frame().vector_to_world(normal),
        )?)
    }

    /// The two Villarceau circles through a point of the surface, one of each sign.
    ///
    /// # Errors
    ///
    /// As [`Quartic::villarceau_circle`].
    pub fn villarceau_circles_at(&self, point: DVec3) -> Result<[Circle; 2], Error> {
        self.require_ring()?;
        crate::frame::place("point", point)?;
        let p = self.frame().point_to_local(point);
        let (a, c, mu) = (self.a(), self.c(), self.mu());
        let x = mu * p.x - a * c;
        let y = ((mu - c) * (mu + c)).sqrt() * p.y;
        let z = ((a - mu) * (a + mu)).sqrt() * p.z;
        let turn = (z / x.hypot(y)).clamp(-1.0, 1.0).acos();
        let around = y.atan2(x);
        // Both planes through the point carry a circle of each sign; one of them passes through the point.
        let nearest = |sign: f64| -> Result<Circle, Error> {
            let [one, other] = [
                self.villarceau_circle(around + turn, sign)?,
                self.villarceau_circle(around - turn, sign)?,
            ];
            Ok(if one.distance(point) <= other.distance(point) {
                one
            } else {
                other
            })
        };
        Ok([nearest(1.0)?, nearest(-1.0)?])
    }

    fn require_ring(&self) -> Result<(), Error> {
        if matches!(self.kind(), Kind::Ring | Kind::RingTorus) {
            Ok(())
        } else {
            Err(Error::NotARing {
                a: self.a(),
                c: self.c(),
                mu: self.mu(),
            })
        }
    }

    /// The four principal circles: `psi = 0` and `psi = pi` in the plane `z = 0`, then `theta = 0` and `theta = pi` in the
    /// plane `y = 0`.
    #[must_use]
    pub fn principal_circles(&self) -> [CurvatureCircle; 4] {
        use std::f64::consts::PI;
        [
            self.psi_circle(0.0),
            self.psi_circle(PI),
            self.theta_circle(0.0),
            self.theta_circle(PI),
        ]
    }
}
