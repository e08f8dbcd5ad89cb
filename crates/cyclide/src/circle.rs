//! Lines of curvature: circles that may have shrunk to a point.

use crate::Error;
use glam::DVec3;
use lorentz::Circle;

/// A line of curvature: a circle with its centre, a radius that is zero at a singular point, and the unit normal of
/// its plane.
///
/// [`lorentz::Circle`] has a positive radius; the circle through a singular point of a cyclide may have none.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CurvatureCircle {
    /// Centre, world coordinates.
    pub centre: DVec3,
    /// Radius, zero or positive.
    pub radius: f64,
    /// Unit normal of the plane.
    pub axis: DVec3,
}

impl CurvatureCircle {
    /// The point at an angle (radians) from the arbitrary start `axis.any_orthonormal_vector()`, counter-clockwise
    /// about the axis.
    #[must_use]
    pub fn point(&self, angle: f64) -> DVec3 {
        let start = self.axis.any_orthonormal_vector();
        let (sin, cos) = angle.sin_cos();
        self.centre + self.radius * (cos * start + sin * self.axis.cross(start))
    }

    /// Power of a point with respect to the circle, in the circle's plane: squared distance to the centre minus squared radius.
    #[must_use]
    pub fn power(&self, point: DVec3) -> f64 {
        (point - self.centre).length_squared() - self.radius * self.radius
    }
}

impl From<Circle> for CurvatureCircle {
    fn from(circle: Circle) -> Self {
        Self {
            centre: circle.centre(),
            radius: circle.radius(),
            axis: circle.axis(),
        }
    }
}

impl TryFrom<CurvatureCircle> for Circle {
    type Error = Error;

    fn try_from(circle: CurvatureCircle) -> Result<Self, Error> {
        Ok(Self::new(circle.centre, circle.radius, circle.axis)?)
    }
}
