//! Rays with their neighbours: Snell's law, and how a bundle spreads.
//!
//! What happens to a ray on its way is inlined always, here and along the whole way: a ray is eighty bytes, and copying it
//! from call to call is a fifth of the time of an arrival.

use glam::DVec2;

use crate::{Error, Impact, Medium};

/// A ray of a one-parameter family, with the derivatives of its data with respect to that parameter: the ray tube.
///
/// Everything a wave needs is in it. The front's normal is the direction of the slowness; `<slowness, X - point> + time`
/// is the arrival time at any point X of the ray; the tube's derivative gives the front's radius, the caustic, the
/// amplitude, and Newton's method its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ray {
    /// A point of the ray.
    pub point: DVec2,
    /// The slowness, normal of the front over its speed.
    pub slowness: DVec2,
    /// The time at which the wave is at the point.
    pub time: f64,
    /// Derivative of the point.
    pub point_change: DVec2,
    /// Derivative of the slowness; it is orthogonal to the group velocity.
    pub slowness_change: DVec2,
    /// Derivative of the time.
    pub time_change: f64,
}

/// What an interface does with a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mode {
    /// The ray stays in its medium.
    Reflect,
    /// The ray goes on into the medium behind.
    Transmit,
}

impl Ray {
    /// The ray from `point` at time zero with this slowness, one of the rays around that point: the parameter is the angle
    /// of the normal.
    #[must_use]
    pub fn from_point(point: DVec2, slowness: DVec2, medium: &Medium) -> Self {
        Self::radiating(point, slowness.normalize(), medium)
    }

    /// As [`Ray::from_point`], by the unit normal.
    #[inline(always)]
    #[must_use]
    pub fn radiating(point: DVec2, normal: DVec2, medium: &Medium) -> Self {
        let slowness = medium.slowness(normal);
        // s = N / P with P = <N, V> and P' = <T, V>.
        let slope = normal.perp().dot(medium.group_velocity(slowness));
        let inverse_speed = slowness.dot(normal);
        Self {
            point,
            slowness,
            time: 0.0,
            point_change: DVec2::ZERO,
            slowness_change: inverse_speed * (normal.perp() - slope * slowness),
            time_change: 0.0,
        }
    }

    /// The unit normal of the front.
    #[must_use]
    pub fn normal(&self) -> DVec2 {
        self.slowness.normalize()
    }

    /// The arrival time at a point of the ray (and to second order near it).
    #[inline]
    #[must_use]
    pub fn time_at(&self, point: DVec2) -> f64 {
        self.time + self.slowness.dot(point - self.point)
    }

    /// The ray after the given travel time in its medium.
    #[inline]
    #[must_use]
    pub fn after(&self, travel: f64, medium: &Medium) -> Self {
        let velocity = medium.group_velocity(self.slowness);
        let velocity_change = medium.group_velocity_change(self.slowness, self.slowness_change);
        Self {
            point: self.point + travel * velocity,
            point_change: self.point_change + travel * velocity_change,
            time: self.time + travel,
            ..*self
        }
    }

    /// The signed radius of curvature of the front at the ray's point: positive where it spreads, zero on the caustic,
    /// infinite for a plane front.
    #[must_use]
    pub fn front_radius(&self, medium: &Medium) -> f64 {
        let normal = self.normal();
        // The front is where the time is constant: take the time's change back along the ray.
        let along = self.point_change - self.time_change * medium.group_velocity(self.slowness);
        let turning = self.slowness.perp_dot(self.slowness_change) / self.slowness.length_squared();
        along.dot(normal.perp()) / turning
    }

    /// The width of the ray tube per unit of the parameter, across the ray, at the ray's point. The amplitude falls with
    /// its square root, and is infinite on the caustic.
    #[must_use]
    pub fn tube_width(&self, medium: &Medium) -> f64 {
        self.point_change
            .perp_dot(medium.group_velocity(self.slowness).normalize())
            .abs()
    }

    /// The point of the caustic on this ray, where the tube closes; infinite or NaN for a parallel bundle.
    #[must_use]
    pub fn caustic_point(&self, medium: &Medium) -> DVec2 {
        let velocity = medium.group_velocity(self.slowness);
        let velocity_change = medium.group_velocity_change(self.slowness, self.slowness_change);
        self.point
            - (self.point_change.perp_dot(velocity) / velocity_change.perp_dot(velocity)) * velocity
    }

    /// The signed distance of a point from the ray, positive to its left, and its derivative along the family.
    #[inline]
    #[must_use]
    pub fn side(&self, point: DVec2, medium: &Medium) -> (f64, f64) {
        let velocity = medium.group_velocity(self.slowness);
        let change = medium.group_velocity_change(self.slowness, self.slowness_change);
        let (way, speed) = (point - self.point, velocity.length());
        let distance = velocity.perp_dot(way) / speed;
        let turning = change.perp_dot(way) - velocity.perp_dot(self.point_change);
        let stretching = distance * velocity.dot(change) / speed;
        (distance, (turning - stretching) / speed)
    }

    /// Whether the ray tube has closed between this place of the ray and a later one of the same leg.
    #[inline]
    pub(crate) fn is_beyond_caustic_at(&self, later: &Self, velocity: DVec2) -> bool {
        self.point_change.perp_dot(velocity) * later.point_change.perp_dot(velocity) < 0.0
    }

    /// The neighbouring ray at a small step of the parameter, to first order.
    #[inline]
    pub(crate) fn moved(&self, step: f64) -> Self {
        Self {
            point: self.point + step * self.point_change,
            slowness: self.slowness + step * self.slowness_change,
            time: self.time + step * self.time_change,
            ..*self
        }
    }

    /// The ray at an impact, its derivatives taken along the interface.
    #[inline(always)]
    #[must_use]
    pub fn arrive(&self, impact: &Impact, medium: &Medium) -> Self {
        let velocity = medium.group_velocity(self.slowness);
        let velocity_change = medium.group_velocity_change(self.slowness, self.slowness_change);
        let drift = self.point_change + impact.time * velocity_change;
        // Neighbours hit later by as much as brings them back to the interface's tangent.
        let delay = -impact.tangent.perp_dot(drift) / impact.tangent.perp_dot(velocity);
        Self {
            point: impact.point,
            point_change: drift + delay * velocity,
            time: self.time + impact.time,
            time_change: self.time_change + delay,
            ..*self
        }
    }

    /// The ray that leaves an interface at the place where this one has arrived, into the medium `beyond` (for a
    /// reflection the medium that it came in).
    ///
    /// The component of the slowness along the interface is kept, in every medium.
    ///
    /// # Errors
    /// [`Error::TotalReflection`] if nothing is transmitted.
    #[inline(always)]
    pub fn scatter(
        &self,
        impact: &Impact,
        mode: Mode,
        medium: &Medium,
        beyond: &Medium,
    ) -> Result<Self, Error> {
        let tangent = impact.tangent;
        let inwards = medium.group_velocity(self.slowness).dot(tangent.perp());
        let onwards = match mode {
            Mode::Transmit => inwards.signum(),
            Mode::Reflect => -inwards.signum(),
        };
        let normal = onwards * tangent.perp();
        let tangential = self.slowness.dot(tangent);
        let slowness = beyond.slowness_behind(tangential, tangent, normal, self.point)?;

        let turn = impact.curvature * self.point_change.dot(tangent);
        let tangent_change = turn * tangent.perp();
        let normal_change = -onwards * turn * tangent;
        let tangential_change =
            self.slowness_change.dot(tangent) + self.slowness.dot(tangent_change);
        let across = slowness.dot(normal);
        let partial =
            tangential_change * tangent + tangential * tangent_change + across * normal_change;
        // The change of slowness stays on the slowness curve, whose normal is the group velocity.
        let velocity = beyond.group_velocity(slowness);
        let slowness_change = partial - (velocity.dot(partial) / velocity.dot(normal)) * normal;
        Ok(Self {
            slowness,
            slowness_change,
            ..*self
        })
    }
}
