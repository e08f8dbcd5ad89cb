//! Convex surfaces by their support function.

use glam::{DMat3, DVec3};

use super::{SampledSurface, SpacePoint};
use crate::Error;

/// A convex surface by the support function of its tangent planes: `p(N) = <centre, N> + |half_axes^T N| + distance`.
///
/// A sphere (no half axes), an ellipsoid, their offsets, and the mirror images of all these: rational in a rational
/// parametrisation of the normals wherever the ellipsoid is a sphere, and dual-quadratic before the offset otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredSurface",
        into = "crate::stored::StoredSurface"
    )
)]
pub struct DualSurface {
    centre: DVec3,
    half_axes: DMat3,
    distance: f64,
}

impl DualSurface {
    /// The front of a point source after the time in which it runs `radius` (0 for the point itself).
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn sphere(centre: DVec3, radius: f64) -> Result<Self, Error> {
        if !(centre.is_finite() && radius.is_finite()) {
            return Err(Error::NonFinite { what: "a sphere" });
        }
        Ok(Self {
            centre,
            half_axes: DMat3::ZERO,
            distance: radius,
        })
    }

    /// An ellipsoid with three conjugate half axes.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::OutOfRange`] with their volume if the half axes lie in a plane.
    pub fn ellipsoid(centre: DVec3, half_axes: [DVec3; 3]) -> Result<Self, Error> {
        let half_axes = DMat3::from_cols(half_axes[0], half_axes[1], half_axes[2]);
        if !(centre.is_finite() && half_axes.is_finite()) {
            return Err(Error::NonFinite {
                what: "an ellipsoid",
            });
        }
        let volume = half_axes.determinant().abs();
        if volume == 0.0 {
            return Err(Error::OutOfRange {
                what: "the volume of an ellipsoid's half axes",
                value: volume,
            });
        }
        Ok(Self {
            centre,
            half_axes,
            distance: 0.0,
        })
    }

    /// The distance of the tangent plane with this unit normal from the origin.
    #[must_use]
    pub fn support(&self, normal: DVec3) -> f64 {
        self.centre.dot(normal) + (self.half_axes.transpose() * normal).length() + self.distance
    }

    /// The point with this unit normal: the gradient of the support function.
    #[must_use]
    pub fn point(&self, normal: DVec3) -> DVec3 {
        let image = self.half_axes.transpose() * normal;
        self.centre + self.half_axes * image.normalize_or_zero() + self.distance * normal
    }

    /// The derivative of the point as the unit normal turns by a vector across it.
    pub(crate) fn point_change(&self, normal: DVec3, turn: DVec3) -> DVec3 {
        let (image, change) = (
            self.half_axes.transpose() * normal,
            self.half_axes.transpose() * turn,
        );
        let Some(unit) = image.try_normalize() else {
            return self.distance * turn;
        };
        let across = (change - change.dot(unit) * unit) / image.length();
        self.half_axes * across + self.distance * turn
    }

    /// The front after running `distance` along its normals; negative to run back, through every focus.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        Self {
            distance: self.distance + distance,
            ..*self
        }
    }

    /// The front after reflection in the plane `<normal, x> = height`: the mirror image, exactly.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] for a normal without length.
    pub fn reflect(&self, normal: DVec3, height: f64) -> Result<Self, Error> {
        let unit = normal.try_normalize().ok_or(Error::ZeroDirection {
            what: "the normal of a mirror",
        })?;
        let height = height / normal.length();
        let image = |v: DVec3| v - 2.0 * v.dot(unit) * unit;
        let half_axes = DMat3::from_cols(
            image(self.half_axes.x_axis),
            image(self.half_axes.y_axis),
            image(self.half_axes.z_axis),
        );
        Ok(Self {
            centre: image(self.centre) + 2.0 * height * unit,
            half_axes,
            distance: self.distance,
        })
    }

    /// The rays of the part with normals `normal(u, v)` over the unit square, on a grid.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than two rows or columns; [`Error::ZeroDirection`] for a normal without length.
    pub fn sample(
        &self,
        columns: usize,
        rows: usize,
        normal: impl Fn(f64, f64) -> DVec3,
    ) -> Result<SampledSurface, Error> {
        SampledSurface::new(columns, rows, |u, v| {
            let normal = normal(u, v).try_normalize()?;
            Some(SpacePoint {
                point: self.point(normal),
                normal,
            })
        })
    }
}

#[cfg(feature = "serde")]
impl From<DualSurface> for crate::stored::StoredSurface {
    fn from(surface: DualSurface) -> Self {
        Self {
            centre: surface.centre,
            half_axes: surface.half_axes,
            distance: surface.distance,
        }
    }
}
