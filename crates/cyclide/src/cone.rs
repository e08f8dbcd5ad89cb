//! Cones and cylinders as lines of oriented spheres.

use crate::frame::{direction, place, size};
use crate::{CurvatureCircle, Error};
#[cfg(feature = "serde")]
use crate::{frame::length, tolerance};
use glam::DVec3;
use lorentz::Cycle;
use std::f64::consts::FRAC_PI_2;

/// A circular cone, with both nappes, or a circular cylinder (a cone with its vertex at infinity).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "ConeData", into = "ConeData")
)]
pub struct Cone {
    point: DVec3,
    axis: DVec3,
    half_angle: f64,
    radius: f64,
}

impl Cone {
    /// The cone with the given vertex, axis direction (any length) and half angle in `(0, pi/2)`, radians.
    ///
    /// The nappe on the side of the axis direction is the one whose inscribed spheres have positive radius.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`] for the vertex; [`Error::Axis`] for a zero or infinite direction; [`Error::HalfAngle`].
    pub fn new(vertex: DVec3, axis: DVec3, half_angle: f64) -> Result<Self, Error> {
        place("cone vertex", vertex)?;
        let (axis, _) = direction(axis).ok_or(Error::Axis { axis })?;
        if half_angle > 0.0 && half_angle < FRAC_PI_2 {
            Ok(Self {
                point: vertex,
                axis,
                half_angle,
                radius: 0.0,
            })
        } else {
            Err(Error::HalfAngle { half_angle })
        }
    }

    /// The cylinder of positive radius about the line through `point` with the direction `axis` (any length).
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::Axis`]; [`Error::CylinderRadius`].
    pub fn cylinder(point: DVec3, axis: DVec3, radius: f64) -> Result<Self, Error> {
        place("cylinder point", point)?;
        size("cylinder radius", radius)?;
        let (axis, _) = direction(axis).ok_or(Error::Axis { axis })?;
        if radius <= 0.0 {
            return Err(Error::CylinderRadius { radius });
        }
        Ok(Self {
            point,
            axis,
            half_angle: 0.0,
            radius,
        })
    }

    /// The cone of which the given spheres form the line; `None` if the spheres are equal or one lies inside the other.
    pub(crate) fn through_spheres(from: Cycle, to: Cycle) -> Option<Self> {
        let step = to - from;
        let length = step.centre.length();
        let sine = step.radius / length;
        if sine.is_nan() || sine.abs() >= 1.0 {
            return None;
        }
        let axis = step.centre / length;
        if sine == 0.0 {
            return Self::cylinder(from.centre, axis, from.radius.abs()).ok();
        }
        Self::new(
            from.centre - from.radius / sine * axis,
            axis * sine.signum(),
            sine.abs().asin(),
        )
        .ok()
    }

    /// The cone with the given line of inscribed spheres, in the orientation that cones have.
    #[cfg(feature = "serde")]
    pub(crate) fn of_line(line: &SphereLine) -> Result<Self, Error> {
        if line.sin == 0.0 {
            return Self::cylinder(line.point, line.axis, line.radius.abs());
        }
        Self::new(
            line.point,
            line.axis * line.sin.signum(),
            line.sin.abs().atan2(line.cos),
        )
    }

    /// The vertex; `None` for a cylinder.
    #[must_use]
    pub fn vertex(&self) -> Option<DVec3> {
        (!self.is_cylinder()).then_some(self.point)
    }

    /// The vertex, or the point that was given on the axis of a cylinder.
    #[must_use]
    pub const fn point(&self) -> DVec3 {
        self.point
    }

    /// Unit direction of the axis, towards the nappe of positive radii.
    #[must_use]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Half angle at the vertex, in `[0, pi/2)`; zero for a cylinder.
    #[must_use]
    pub const fn half_angle(&self) -> f64 {
        self.half_angle
    }

    /// Radius of a cylinder, zero for a cone.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// Whether the vertex is at infinity.
    #[must_use]
    pub fn is_cylinder(&self) -> bool {
        self.half_angle == 0.0
    }

    /// The line of inscribed spheres.
    #[must_use]
    pub fn spheres(&self) -> SphereLine {
        let (sin, cos) = self.half_angle.sin_cos();
        SphereLine {
            point: self.point,
            radius: self.radius,
            axis: self.axis,
            sin,
            cos,
        }
    }

    /// The circle in the plane perpendicular to the axis at signed distance `height` from [`Cone::point`].
    #[must_use]
    pub fn circle_at(&self, height: f64) -> CurvatureCircle {
        let radius = self.radius + height * self.half_angle.tan();
        CurvatureCircle {
            centre: self.point + height * self.axis,
            radius: radius.abs(),
            axis: self.axis,
        }
    }

    /// Which nappe the plane at this height cuts: 1 on the side of the axis direction, -1 on the other, 0 at the vertex. Always
    /// 1 for a cylinder.
    #[must_use]
    pub fn nappe_at(&self, height: f64) -> i8 {
        if self.is_cylinder() || height > 0.0 {
            1
        } else if height < 0.0 {
            -1
        } else {
            0
        }
    }
}

/// An oriented cone: the line of its inscribed spheres in R^{3,1}, `(q + s d ; rho + s sin alpha)`.
///
/// Reversing the orientation changes the sign of all radii; reversing `d` together with `sin alpha` names the same
/// oriented cone. Two oriented cones touch a common cyclide along circles of one family exactly if their lines touch one
/// of its two conics, which is why everything about blending two cones is about two lines.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "LineData")
)]
pub struct SphereLine {
    pub(crate) point: DVec3,
    pub(crate) radius: f64,
    pub(crate) axis: DVec3,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl SphereLine {
    /// The sphere with its centre at distance `s` along the axis from the reference point.
    #[must_use]
    pub fn at(&self, s: f64) -> Cycle {
        Cycle::new(self.point + s * self.axis, self.radius + s * self.sin)
    }

    /// The direction of the line with Lorentz length 1, `(d ; sin alpha) / cos alpha`.
    #[must_use]
    pub fn direction(&self) -> Cycle {
        Cycle::new(self.axis / self.cos, self.sin / self.cos)
    }

    /// Unit direction of the axis.
    #[must_use]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// `sin alpha`, signed: the change of radius per unit along the axis.
    #[must_use]
    pub const fn sin(&self) -> f64 {
        self.sin
    }

    /// `tan alpha`, signed.
    #[must_use]
    pub fn tan(&self) -> f64 {
        self.sin / self.cos
    }

    /// The same cone with the other orientation.
    #[must_use]
    pub(crate) fn reversed(self) -> Self {
        Self {
            radius: -self.radius,
            sin: -self.sin,
            ..self
        }
    }

    /// The same oriented cone described with the opposite axis vector.
    #[must_use]
    pub(crate) fn with_opposite_axis(self) -> Self {
        Self {
            axis: -self.axis,
            sin: -self.sin,
            ..self
        }
    }

    /// Distance along the axis from the reference point to the foot of a point.
    #[must_use]
    pub(crate) fn foot(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.axis)
    }

    /// The inscribed sphere that touches the cone in the plane at `height` along the axis, as its distance `s`.
    #[must_use]
    pub(crate) fn sphere_touching_at(&self, height: f64) -> f64 {
        (height + self.radius * self.sin) / (self.cos * self.cos)
    }

    /// The circle along which a sphere of the line touches the cone.
    #[must_use]
    pub fn contact_circle(&self, sphere: Cycle) -> CurvatureCircle {
        CurvatureCircle {
            centre: sphere.centre - sphere.radius * self.sin * self.axis,
            radius: (sphere.radius * self.cos).abs(),
            axis: self.axis,
        }
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(untagged)]
enum ConeData {
    Cone {
        vertex: DVec3,
        axis: DVec3,
        half_angle: f64,
    },
    Cylinder {
        cylinder_point: DVec3,
        axis: DVec3,
        radius: f64,
    },
}

#[cfg(feature = "serde")]
impl TryFrom<ConeData> for Cone {
    type Error = Error;

    fn try_from(data: ConeData) -> Result<Self, Error> {
        match data {
            ConeData::Cone {
                vertex,
                axis,
                half_angle,
            } => Self::new(vertex, axis, half_angle),
            ConeData::Cylinder {
                cylinder_point,
                axis,
                radius,
            } => Self::cylinder(cylinder_point, axis, radius),
        }
    }
}

#[cfg(feature = "serde")]
impl From<Cone> for ConeData {
    fn from(cone: Cone) -> Self {
        let Cone {
            point,
            axis,
            half_angle,
            radius,
        } = cone;
        if cone.is_cylinder() {
            Self::Cylinder {
                cylinder_point: point,
                axis,
                radius,
            }
        } else {
            Self::Cone {
                vertex: point,
                axis,
                half_angle,
            }
        }
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct LineData {
    point: DVec3,
    radius: f64,
    axis: DVec3,
    sin: f64,
    cos: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<LineData> for SphereLine {
    type Error = Error;

    fn try_from(data: LineData) -> Result<Self, Error> {
        let LineData {
            point,
            radius,
            axis,
            sin,
            cos,
        } = data;
        place("cone vertex", point)?;
        length("cylinder radius", radius)?;
        let off = |square: f64| (square - 1.0).abs();
        if axis.is_nan() || off(axis.length_squared()) > tolerance::FRAME {
            return Err(Error::Axis { axis });
        }
        let is_angle = cos > 0.0 && off(sin * sin + cos * cos) <= tolerance::FRAME;
        if !is_angle {
            return Err(Error::HalfAngle {
                half_angle: sin.atan2(cos),
            });
        }
        Ok(Self {
            point,
            radius,
            axis,
            sin,
            cos,
        })
    }
}
