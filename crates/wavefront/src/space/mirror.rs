//! Mirrors in space: planes and quadrics.

use glam::{DMat3, DVec3};

use super::SpacePoint;
use crate::Error;

/// A mirror in space: `xᵀ form x + 2 <linear, x> + constant = 0`, a plane if the form vanishes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredMirror",
        into = "crate::stored::StoredMirror"
    )
)]
pub struct Mirror {
    form: DMat3,
    linear: DVec3,
    constant: f64,
}

impl Mirror {
    /// The plane `<normal, x> = height`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`].
    pub fn plane(normal: DVec3, height: f64) -> Result<Self, Error> {
        if normal == DVec3::ZERO {
            return Err(Error::ZeroDirection {
                what: "the normal of a mirror",
            });
        }
        Self::quadric(DMat3::ZERO, 0.5 * normal, -height)
    }

    /// The quadric `xᵀ form x + 2 <linear, x> + constant = 0` with a symmetric form.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn quadric(form: DMat3, linear: DVec3, constant: f64) -> Result<Self, Error> {
        if !(form.is_finite() && linear.is_finite() && constant.is_finite()) {
            return Err(Error::NonFinite { what: "a mirror" });
        }
        Ok(Self {
            form,
            linear,
            constant,
        })
    }

    /// Half the gradient of the mirror's function.
    pub(crate) fn gradient(&self, point: DVec3) -> DVec3 {
        self.form * point + self.linear
    }

    /// And its derivative along a vector.
    pub(crate) fn gradient_change(&self, vector: DVec3) -> DVec3 {
        self.form * vector
    }

    /// The distance along a ray to the mirror, and the mirror's unit normal there; none for a ray that misses.
    #[must_use]
    pub fn hit(&self, ray: SpacePoint) -> Option<(f64, DVec3)> {
        let gradient = |x: DVec3| self.form * x + self.linear;
        let a = ray.normal.dot(self.form * ray.normal);
        let b = ray.normal.dot(gradient(ray.point));
        let c = ray.point.dot(gradient(ray.point) + self.linear) + self.constant;
        let first = if a == 0.0 {
            -c / (2.0 * b)
        } else {
            let root = (b * b - a * c).sqrt();
            let larger = -(b + root.copysign(b));
            let roots = [larger / a, c / larger];
            roots
                .into_iter()
                .filter(|s| *s > 0.0)
                .fold(f64::INFINITY, f64::min)
        };
        let normal = gradient(ray.point + first * ray.normal).try_normalize()?;
        (first > 0.0 && first.is_finite()).then_some((first, normal))
    }
}

#[cfg(feature = "serde")]
impl From<Mirror> for crate::stored::StoredMirror {
    fn from(mirror: Mirror) -> Self {
        Self {
            form: mirror.form,
            linear: mirror.linear,
            constant: mirror.constant,
        }
    }
}
