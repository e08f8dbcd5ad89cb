//! A polynomial PH curve in space, given by its preimage.

use bezier_mass::{VectorSpace, bernstein};
use glam::{DVec2, DVec3};

use super::{Frame, Quaternion};
use crate::{ArcLength, Error, quadrature};

/// The curve `r(t) = start + ∫ A i A*` of a quaternion polynomial `A` in Bernstein form on `[0, 1]`.
///
/// A preimage of degree `m` gives a curve of degree `2m + 1`; the spatial PH quintics have `m = 2`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpatialPh {
    preimage: Vec<Quaternion>,
    preimage_derivative: Vec<Quaternion>,
    control_points: Vec<DVec3>,
    arc_length: ArcLength,
}

impl SpatialPh {
    /// The curve from `start` with the given preimage (Bernstein coefficients).
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if the preimage is empty or zero, which is a point.
    pub fn try_new(start: DVec3, preimage: impl Into<Vec<Quaternion>>) -> Result<Self, Error> {
        let preimage = preimage.into();
        if !start.is_finite() || preimage.iter().any(|a| !a.is_finite()) {
            return Err(Error::NonFinite {
                what: "start or preimage of a spatial PH curve",
            });
        }
        if preimage.iter().all(|a| *a == Quaternion::ZERO) {
            return Err(Error::ZeroDirection {
                what: "preimage of a spatial PH curve",
            });
        }
        let hodograph = bernstein::product_with(&preimage, &preimage, |a, b| a.polar_image(*b));
        let speed = bernstein::product_with(&preimage, &preimage, |a, b| a.dot(*b));
        Ok(Self {
            preimage_derivative: bernstein::derivative(&preimage),
            control_points: bernstein::integral(&hodograph, start),
            arc_length: ArcLength::try_new(speed)?,
            preimage,
        })
    }

    /// The Bernstein coefficients of the preimage `A`.
    #[must_use]
    pub fn preimage(&self) -> &[Quaternion] {
        &self.preimage
    }

    /// The Bézier control points.
    #[must_use]
    pub fn control_points(&self) -> &[DVec3] {
        &self.control_points
    }

    /// The exact arc length and its inverse.
    #[must_use]
    pub fn arc_length(&self) -> &ArcLength {
        &self.arc_length
    }

    /// The point at `t`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec3 {
        bernstein::evaluate(&self.control_points, t)
    }

    /// The velocity `r' = A i A*` at `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec3 {
        self.preimage_at(t).image(DVec3::X)
    }

    /// The curvature `2 |(A* A')_jk| / |A|^4` at `t`; infinite or NaN where the speed vanishes.
    #[must_use]
    pub fn curvature(&self, t: f64) -> f64 {
        let a = self.preimage_at(t);
        let speed = a.norm_squared();
        2.0 * a
            .transversal_product(self.preimage_derivative_at(t))
            .length()
            / (speed * speed)
    }

    /// The bending energy: the integral of the squared curvature over the arc length, by Gauss-Legendre quadrature
    /// with 16 points on each of four quarters; a criterion to compare curves, not a certified value.
    #[must_use]
    pub fn bending_energy(&self) -> f64 {
        quadrature::integrate(0.0, 1.0, 4, |t| {
            let a = self.preimage_at(t);
            let speed = a.norm_squared();
            4.0 * a
                .transversal_product(self.preimage_derivative_at(t))
                .length_squared()
                / speed.powi(3)
        })
    }

    /// The Euler-Rodrigues frame `(A i A*, A j A*, A k A*) / |A|^2`: rational, adapted to the curve, and turning about
    /// the tangent with [`SpatialPh::frame_twist`].
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] where the speed vanishes.
    pub fn euler_rodrigues_frame(&self, t: f64) -> Result<Frame, Error> {
        Frame::of_quaternion(self.preimage_at(t))
    }

    /// The rate `f2' . f3 = 2 Im <A, A'> / |A|^2` (radians per parameter) at which the Euler-Rodrigues frame turns about
    /// the tangent. A rotation-minimising frame turns against it.
    #[must_use]
    pub fn frame_twist(&self, t: f64) -> f64 {
        let a = self.preimage_at(t);
        2.0 * a.complex_product(self.preimage_derivative_at(t)).y / a.norm_squared()
    }

    /// The angle in radians by which the Euler-Rodrigues frame turns between two parameters, by Gauss-Legendre
    /// quadrature on `pieces` equal parts; a rotation-minimising frame differs from it by the negative of this.
    #[must_use]
    pub fn frame_twist_between(&self, from: f64, to: f64, pieces: usize) -> f64 {
        quadrature::integrate(from, to, pieces, |t| self.frame_twist(t))
    }

    /// The rotation-minimising frame at `t` that agrees with the Euler-Rodrigues frame at 0.
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] where the speed vanishes.
    pub fn rotation_minimising_frame(&self, t: f64) -> Result<Frame, Error> {
        Ok(self
            .euler_rodrigues_frame(t)?
            .turned(-self.frame_twist_between(0.0, t, 4)))
    }

    /// The Frenet frame at `t`.
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] where the speed or the curvature vanishes.
    pub fn frenet_frame(&self, t: f64) -> Result<Frame, Error> {
        let a = self.preimage_at(t);
        let bend = a.transversal_product(self.preimage_derivative_at(t));
        // With A* A' = m0 + m1 i + m2 j + m3 k, the part of r'' across the tangent is 2 A (m3 j - m2 k) A*.
        let towards = DVec2::new(bend.y, -bend.x).try_normalize();
        let frame = Frame::of_quaternion(a)?;
        towards
            .map(|direction| frame.turned(direction.to_angle()))
            .ok_or(Error::ZeroDirection {
                what: "principal normal of a spatial PH curve",
            })
    }

    /// The point and unit tangent at `t`, the input of [`rotation_minimising_frames`](super::rotation_minimising_frames).
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] where the speed vanishes.
    pub fn point_and_tangent(&self, t: f64) -> Result<(DVec3, DVec3), Error> {
        let tangent = self
            .velocity(t)
            .try_normalize()
            .ok_or(Error::ZeroDirection {
                what: "tangent of a spatial PH curve",
            })?;
        Ok((self.point(t), tangent))
    }

    pub(super) fn preimage_at(&self, t: f64) -> Quaternion {
        bernstein::evaluate(&self.preimage, t)
    }

    fn preimage_derivative_at(&self, t: f64) -> Quaternion {
        bernstein::evaluate(&self.preimage_derivative, t)
    }
}
