//! The two axes of a cyclide and what belongs to them: symmetry planes, tangent cones, spheres through two circles.

use crate::spheres::MovingSphere;
use crate::{Cone, CurvatureCircle, Dupin, Error, Quartic};
use glam::DVec3;
use lorentz::{Cycle, Line, Object, Plane, Sphere};

/// An axis of a quartic cyclide: the line through which the planes of one family of circles pass.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Axis {
    /// The point of the axis in both symmetry planes (`y = z = 0`): a centre of similitude of the two principal circles in the plane
    /// orthogonal to the axis.
    pub point: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// Power of `point` for every circle of the family: the same for all of them.
    pub power: f64,
}

impl Quartic {
    /// The axis of the planes of `theta = const`, parallel to `z` through `(c mu / a, 0, 0)`; the frame's `z` axis for a torus.
    #[must_use]
    pub fn theta_axis(&self) -> Axis {
        let (b, e, mu, q) = (self.b(), self.eccentricity(), self.mu(), self.minor_ratio());
        Axis {
            point: self.frame().point_to_world(DVec3::X * (e * mu)),
            direction: self.frame().z(),
            power: b * b - q * q * mu * mu,
        }
    }

    /// The axis of the planes of `psi = const`, parallel to `y` through `(a mu / c, 0, 0)`. `None` at infinity (tori): the planes are
    /// parallel.
    #[must_use]
    pub fn psi_axis(&self) -> Option<Axis> {
        let (b, e, mu) = (self.b(), self.eccentricity(), self.mu());
        let reach = mu / e;
        reach.is_finite().then(|| Axis {
            point: self.frame().point_to_world(DVec3::X * reach),
            direction: self.frame().y(),
            power: b * b * ((mu / self.c() - 1.0) * (mu / self.c() + 1.0)),
        })
    }
}

impl Dupin {
    /// The axes: first that of the planes of the first family of circles, then that of the second, which is at infinity for a torus. On a
    /// parabolic cyclide they are the two straight lines on the surface.
    ///
    /// # Errors
    ///
    /// [`Error::Lorentz`] only where a coordinate overflows.
    pub fn axes(&self) -> Result<[Option<Line>; 2], Error> {
        let frame = self.frame();
        Ok(match self {
            Self::Quartic(surface) => {
                let first = surface.theta_axis();
                let second = surface
                    .psi_axis()
                    .map(|axis| Line::new(axis.direction, axis.point))
                    .transpose()?;
                [Some(Line::new(first.direction, first.point)?), second]
            }
            Self::Parabolic(surface) => {
                let (f, k) = (surface.f(), surface.k());
                [
                    Some(Line::new(
                        frame.z(),
                        frame.point_to_world(DVec3::X * (f - k)),
                    )?),
                    Some(Line::new(
                        frame.y(),
                        frame.point_to_world(DVec3::X * (-f - k)),
                    )?),
                ]
            }
        })
    }

    /// The centres of similitude of the two principal circles in the plane `z = 0` and of those in the plane `y = 0`, as far as they are
    /// finite: where the axis orthogonal to the plane meets it. (Of the two centres of similitude it is the one that defines the surface.)
    #[must_use]
    pub fn centres_of_similitude(&self) -> [Option<DVec3>; 2] {
        let frame = self.frame();
        match self {
            Self::Quartic(surface) => [
                Some(surface.theta_axis().point),
                surface.psi_axis().map(|axis| axis.point),
            ],
            Self::Parabolic(surface) => [surface.f() - surface.k(), -surface.f() - surface.k()]
                .map(|x| Some(frame.point_to_world(DVec3::X * x))),
        }
    }

    /// The symmetry planes `z = 0` and `y = 0` of the frame; the centres of the tangent spheres lie in them.
    ///
    /// # Errors
    ///
    /// [`Error::Lorentz`] only where a coordinate overflows.
    pub fn symmetry_planes(&self) -> Result<[Plane; 2], Error> {
        let frame = self.frame();
        Ok([
            Plane::new(frame.z(), frame.origin())?,
            Plane::new(frame.y(), frame.origin())?,
        ])
    }

    /// The cone (or cylinder) of revolution that touches the surface along the circle with a constant first parameter. `None` where the
    /// circle is a point of a cylinder.
    #[must_use]
    pub fn first_tangent_cone(&self, first: f64) -> Option<Cone> {
        tangent_cone(match self {
            Self::Quartic(surface) => surface.moving_theta_sphere(first),
            Self::Parabolic(surface) => surface.moving_u_sphere(first),
        })
    }

    /// The cone (or cylinder) of revolution that touches the surface along the circle with a constant second parameter. `None` where the
    /// tangent surface is a plane.
    #[must_use]
    pub fn second_tangent_cone(&self, second: f64) -> Option<Cone> {
        tangent_cone(match self {
            Self::Quartic(surface) => surface.moving_psi_sphere(second),
            Self::Parabolic(surface) => surface.moving_v_sphere(second),
        })
    }
}

fn tangent_cone(moving: MovingSphere) -> Option<Cone> {
    if !moving.sphere.is_finite() {
        return None;
    }
    // One diameter along the tangent of the conic: far enough to keep the digits of the slope.
    let reach = moving.sphere.radius.abs().max(1.0) / moving.velocity.centre.length();
    Cone::through_spheres(moving.sphere, moving.sphere + moving.velocity * reach)
}

/// The sphere or plane that contains two circles of one family of a cyclide (Shene, Lemma 6); its centre is where the axes of the
/// circles meet. `None` if the circles lie on no common sphere, as circles with skew axes never do.
#[must_use]
pub fn common_sphere(first: &CurvatureCircle, second: &CurvatureCircle) -> Option<Object> {
    let size = first
        .radius
        .max(second.radius)
        .max(first.centre.distance(second.centre));
    let offset = second.centre - first.centre;
    let cross = first.axis.cross(second.axis);
    let agree = |one: f64, other: f64| {
        (one - other).abs() <= crate::tolerance::CLASS * one.abs().max(size * size)
    };
    if cross.length() <= crate::tolerance::CLASS {
        let height = offset.dot(first.axis);
        if height.abs() <= crate::tolerance::CLASS * size {
            return Plane::new(first.axis, first.centre).ok().map(Object::Plane);
        }
        if (offset - height * first.axis).length() > crate::tolerance::CLASS * size {
            return None;
        }
        // Coaxial circles in parallel planes.
        let along = (height * height + second.radius * second.radius - first.radius * first.radius)
            / (2.0 * height);
        return Sphere::new(first.centre + along * first.axis, along.hypot(first.radius))
            .ok()
            .map(Object::Sphere);
    }
    let along = offset.cross(second.axis).dot(cross) / cross.length_squared();
    let centre = first.centre + along * first.axis;
    let square = along * along + first.radius * first.radius;
    let other = centre.distance_squared(second.centre) + second.radius * second.radius;
    // The axes must meet; a miss moves the second circle off the sphere by less, the larger the sphere.
    let miss = offset.dot(cross).abs() / cross.length();
    let meet = miss <= crate::tolerance::CLASS * size.max(square.sqrt());
    (meet && agree(square, other))
        .then(|| Sphere::new(centre, square.sqrt()).ok().map(Object::Sphere))
        .flatten()
}

impl Cone {
    /// The oriented spheres of the cone that touches two spheres, as in [`Dupin::first_tangent_cone`]; `None` if one is inside the other.
    #[must_use]
    pub fn around(first: Cycle, second: Cycle) -> Option<Self> {
        Self::through_spheres(first, second)
    }
}
