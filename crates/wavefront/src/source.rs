//! Where waves start.

use std::f64::consts::TAU;

use bezier_mass::BezierCurve;
use glam::DVec2;

use crate::{Error, Front, Medium, Ray};

/// The start of a wave at time zero: a family of rays over a parameter in `[0, 1]`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredSource",
        into = "crate::stored::StoredSource"
    )
)]
pub enum Source {
    /// A point, with the range of normal angles (radians) that it radiates into.
    Point {
        /// The place.
        position: DVec2,
        /// First and last normal angle; `0` and `2π` for all directions.
        angles: [f64; 2],
    },
    /// A plane wave: a segment with one normal.
    Plane {
        /// The ends of the segment.
        ends: [DVec2; 2],
        /// The side to which the wave runs: the normal is across the segment, in the half plane of this vector.
        towards: DVec2,
    },
    /// An exploding reflector: every point of a curve radiates at time zero. The wave runs to the left of the curve's
    /// direction, or to the right.
    Reflector {
        /// The reflector.
        curve: BezierCurve<DVec2>,
        /// Whether the wave runs to the left.
        left: bool,
    },
    /// A front that has been computed before.
    Front(Front),
}

impl Source {
    /// A point that radiates in all directions.
    #[must_use]
    pub const fn point(position: DVec2) -> Self {
        Self::Point {
            position,
            angles: [0.0, TAU],
        }
    }

    /// Checks that the source has finite data and a direction.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`].
    pub fn check(&self) -> Result<(), Error> {
        match self {
            Self::Point { position, angles } => {
                if !(position.is_finite() && angles.iter().all(|angle| angle.is_finite())) {
                    return Err(Error::NonFinite {
                        what: "a point source",
                    });
                }
                if angles[0] == angles[1] {
                    return Err(Error::ZeroDirection {
                        what: "the range of angles of a source",
                    });
                }
            }
            Self::Plane { ends, towards } => {
                if !(ends[0].is_finite() && ends[1].is_finite() && towards.is_finite()) {
                    return Err(Error::NonFinite {
                        what: "a plane wave",
                    });
                }
                if (ends[1] - ends[0]).perp_dot(*towards) == 0.0 {
                    return Err(Error::ZeroDirection {
                        what: "the direction of a plane wave across its segment",
                    });
                }
            }
            Self::Reflector { .. } | Self::Front(_) => {}
        }
        Ok(())
    }

    /// The ray at parameter `t`.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] where a reflector has no tangent.
    #[inline]
    pub fn ray(&self, t: f64, medium: &Medium) -> Result<Ray, Error> {
        match self {
            Self::Point { position, angles } => {
                let range = angles[1] - angles[0];
                let normal = DVec2::from_angle(angles[0] + range * t);
                let ray = Ray::radiating(*position, normal, medium);
                Ok(Ray {
                    slowness_change: range * ray.slowness_change,
                    ..ray
                })
            }
            Self::Plane { ends, towards } => {
                let along = ends[1] - ends[0];
                let normal = along.perp().normalize_or_zero() * along.perp_dot(*towards).signum();
                Ok(Ray {
                    point: ends[0] + t * along,
                    slowness: medium.slowness(normal),
                    time: 0.0,
                    point_change: along,
                    slowness_change: DVec2::ZERO,
                    time_change: 0.0,
                })
            }
            Self::Reflector { curve, left } => {
                let jet = curve.jet(t);
                let none = Error::ZeroDirection {
                    what: "the tangent of a reflector",
                };
                let (Some(point), Some(slope), Some(bend)) =
                    (jet.position(), jet.velocity(), jet.acceleration())
                else {
                    return Err(none);
                };
                let side = if *left { 1.0 } else { -1.0 };
                let normal = (side * slope.perp()).try_normalize().ok_or(none)?;
                let ray = Ray::radiating(point, normal, medium);
                let turning = slope.perp_dot(bend) / slope.length_squared();
                Ok(Ray {
                    point_change: slope,
                    slowness_change: turning * ray.slowness_change,
                    ..ray
                })
            }
            Self::Front(front) => front.ray(t),
        }
    }

    /// As [`Source::ray`], from the front's normal at a nearby parameter `known`.
    #[inline(always)]
    pub(crate) fn ray_near(
        &self,
        t: f64,
        (known, normal): (f64, DVec2),
        medium: &Medium,
    ) -> Result<Ray, Error> {
        match self {
            Self::Point { position, angles } => {
                let range = angles[1] - angles[0];
                let normal = normal.rotate(turn(range * (t - known)));
                let ray = Ray::radiating(*position, normal, medium);
                Ok(Ray {
                    slowness_change: range * ray.slowness_change,
                    ..ray
                })
            }
            _ => self.ray(t, medium),
        }
    }

    /// A point from which the wave starts, to find its medium.
    ///
    /// # Errors
    /// As [`Source::ray`].
    pub fn place(&self, medium: &Medium) -> Result<DVec2, Error> {
        Ok(self.ray(0.5, medium)?.point)
    }

    /// The parameters at which the family may have a corner: the joints of a front's arcs.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Front(front) => {
                let count = front.pieces().len();
                (0..=count).map(|i| i as f64 / count as f64).collect()
            }
            _ => vec![0.0, 1.0],
        }
    }
}

/// Angles up to this are turned by through a series.
const SMALL_ANGLE: f64 = 0.11;

/// The unit vector at an angle from the x axis: for a small one by the first terms of the series, exact to rounding, at a
/// third of the cost.
#[inline]
fn turn(angle: f64) -> DVec2 {
    if angle.abs() > SMALL_ANGLE {
        return DVec2::from_angle(angle);
    }
    let x = angle * angle;
    // The next terms are below 0.11^12 / 12!, 7e-21.
    let cosine = 1.0
        + x * (-1.0 / 2.0
            + x * (1.0 / 24.0 + x * (-1.0 / 720.0 + x * (1.0 / 40_320.0 - x / 3_628_800.0))));
    let sine =
        angle * (1.0 + x * (-1.0 / 6.0 + x * (1.0 / 120.0 + x * (-1.0 / 5040.0 + x / 362_880.0))));
    DVec2::new(cosine, sine)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_of_a_small_turn_is_exact() {
        for i in -1000..=1000 {
            let angle = 2e-4 * f64::from(i);
            let difference = turn(angle) - DVec2::from_angle(angle);
            assert!(difference.abs().max_element() <= 2.0 * f64::EPSILON);
        }
    }
}
