//! The tangent spheres of a cyclide: its two conics on the space of spheres.

use crate::{Parabolic, Quartic};
use glam::DVec3;
use lorentz::Cycle;

/// A tangent sphere of a family and the direction in which it moves, both in world coordinates: a point of the conic in
/// R^{3,1} and a tangent vector there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MovingSphere {
    pub(crate) sphere: Cycle,
    pub(crate) velocity: Cycle,
}

impl Quartic {
    fn cycle(&self, centre: DVec3, radius: f64) -> Cycle {
        Cycle::new(self.frame().point_to_world(centre), radius)
    }

    fn cycle_velocity(&self, centre: DVec3, radius: f64) -> Cycle {
        Cycle::new(self.frame().vector_to_world(centre), radius)
    }

    /// The sphere that touches the surface along the circle `theta = const`: centre on the ellipse, radius
    /// `mu - c cos theta`.
    #[must_use]
    pub fn theta_sphere(&self, theta: f64) -> Cycle {
        self.moving_theta_sphere(theta).sphere
    }

    pub(crate) fn moving_theta_sphere(&self, theta: f64) -> MovingSphere {
        let (sin, cos) = theta.sin_cos();
        let (a, b, c) = (self.a(), self.b(), self.c());
        MovingSphere {
            sphere: self.cycle(DVec3::new(a * cos, b * sin, 0.0), self.mu() - c * cos),
            velocity: self.cycle_velocity(DVec3::new(-a * sin, b * cos, 0.0), c * sin),
        }
    }

    /// The sphere that touches the surface along the circle `psi = const`: centre on the hyperbola, radius
    /// `mu - a / cos psi`. Not finite where `cos psi = 0`: there it is a plane, see [`Quartic::psi_sphere_homogeneous`].
    #[must_use]
    pub fn psi_sphere(&self, psi: f64) -> Cycle {
        self.moving_psi_sphere(psi).sphere
    }

    pub(crate) fn moving_psi_sphere(&self, psi: f64) -> MovingSphere {
        let (sin, cos) = psi.sin_cos();
        let (a, b, c) = (self.a(), self.b(), self.c());
        MovingSphere {
            sphere: self.cycle(DVec3::new(c, 0.0, -b * sin) / cos, self.mu() - a / cos),
            velocity: self.cycle_velocity(DVec3::new(c * sin, 0.0, -b), -a * sin),
        }
    }

    /// The sphere of [`Quartic::psi_sphere`] as weight and weighted cycle, `(cos psi; cos psi (centre; radius))`, defined where
    /// it is a plane (weight zero: `centre` is then minus the `radius` times the plane's normal).
    #[must_use]
    pub fn psi_sphere_homogeneous(&self, psi: f64) -> (f64, Cycle) {
        let (sin, cos) = psi.sin_cos();
        let centre = self
            .frame()
            .vector_to_world(DVec3::new(self.c(), 0.0, -self.b() * sin));
        (
            cos,
            Cycle::new(
                cos * self.frame().origin() + centre,
                self.mu() * cos - self.a(),
            ),
        )
    }
}

impl Parabolic {
    /// The sphere that touches the surface along the circle `u = const`.
    #[must_use]
    pub fn u_sphere(&self, u: f64) -> Cycle {
        self.moving_u_sphere(u).sphere
    }

    pub(crate) fn moving_u_sphere(&self, u: f64) -> MovingSphere {
        let f = self.f();
        self.moving(
            DVec3::new(f * (u * u - 0.5), 2.0 * f * u, 0.0),
            self.u_radius(u),
            DVec3::new(u, 1.0, 0.0),
            u,
        )
    }

    /// The sphere that touches the surface along the circle `v = const`.
    #[must_use]
    pub fn v_sphere(&self, v: f64) -> Cycle {
        self.moving_v_sphere(v).sphere
    }

    pub(crate) fn moving_v_sphere(&self, v: f64) -> MovingSphere {
        let f = self.f();
        self.moving(
            DVec3::new(f * (0.5 - v * v), 0.0, 2.0 * f * v),
            self.v_radius(v),
            DVec3::new(-v, 0.0, 1.0),
            -v,
        )
    }

    fn moving(&self, centre: DVec3, radius: f64, direction: DVec3, rate: f64) -> MovingSphere {
        MovingSphere {
            sphere: Cycle::new(self.frame().point_to_world(centre), radius),
            velocity: Cycle::new(self.frame().vector_to_world(direction), rate),
        }
    }
}
