use std::ops::Neg;

use glam::DVec3;

use crate::vector::power_of_two_near;
use crate::{Error, LorentzVector};

/// An oriented plane: unit normal and offset, the set of the `x` with `normal . x = offset`.
///
/// Its vector is `normal + offset e_inf` (Section 3.1). The normal points to the *positive side*, where the signed
/// distance is positive. Mind the orientation: a sphere with outward normal `N` at a point, growing to a plane there,
/// tends to *minus* the plane vector with normal `N`, so that [`SphereVector::normal_at`](crate::SphereVector::normal_at)
/// is `-normal` for a plane (the paper's orientation sentence does not say so).
///
/// ```
/// use lorentz::{Plane, glam::{DVec3, dvec3}};
/// let plane = Plane::new(dvec3(0.0, 3.0, 4.0), dvec3(0.0, 0.0, 2.5))?; // any length of the normal
/// assert_eq!(plane.normal(), dvec3(0.0, 0.6, 0.8));
/// assert_eq!(plane.signed_distance(DVec3::ZERO), -2.0);
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "(DVec3, f64)", into = "(DVec3, f64)")
)]
pub struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Plane {
    /// The plane through `point` with the given `normal`, of any length but zero.
    ///
    /// # Errors
    /// [`Error::ZeroNormal`], [`Error::NonFinite`].
    pub fn new(normal: DVec3, point: DVec3) -> Result<Self, Error> {
        let normal = unit_direction(normal)?;
        Self::from_unit(normal, normal.dot(point))
    }

    /// The plane `normal . x = offset`, for a unit normal; a normal of another length is normalised and the offset
    /// divided by its length.
    ///
    /// # Errors
    /// [`Error::ZeroNormal`], [`Error::NonFinite`].
    pub fn from_normal_and_offset(normal: DVec3, offset: f64) -> Result<Self, Error> {
        let unit = unit_direction(normal)?;
        Self::from_unit(unit, offset / normal.dot(unit))
    }

    fn from_unit(normal: DVec3, offset: f64) -> Result<Self, Error> {
        if (offset * offset).is_finite() {
            Ok(Self { normal, offset })
        } else {
            Err(Error::NonFinite {
                what: "the offset of a plane",
            })
        }
    }

    /// Unit normal, pointing to the positive side.
    #[must_use]
    pub const fn normal(self) -> DVec3 {
        self.normal
    }

    /// Signed distance of the plane from the origin, along the normal.
    #[must_use]
    pub const fn offset(self) -> f64 {
        self.offset
    }

    /// Signed distance of the point `x`, positive on the side of the normal (formula (16)).
    #[must_use]
    pub fn signed_distance(self, x: DVec3) -> f64 {
        self.normal.dot(x) - self.offset
    }

    /// The unit vector of this plane on the space of spheres.
    #[must_use]
    pub const fn vector(self) -> LorentzVector {
        LorentzVector::new(0.0, self.normal, self.offset)
    }
}

/// A checked unit vector along `direction`, of any length but zero.
pub(crate) fn unit_direction(direction: DVec3) -> Result<DVec3, Error> {
    if !direction.is_finite() {
        return Err(Error::NonFinite {
            what: "a direction",
        });
    }
    let largest = direction.abs().max_element();
    if largest == 0.0 {
        return Err(Error::ZeroNormal);
    }
    // First to the size of one, without rounding: the square of a huge or a tiny vector is out of range.
    let direction = direction / power_of_two_near(largest);
    Ok(direction / direction.length())
}

impl Neg for Plane {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            normal: -self.normal,
            offset: -self.offset,
        }
    }
}

impl From<Plane> for LorentzVector {
    fn from(plane: Plane) -> Self {
        plane.vector()
    }
}

impl From<Plane> for (DVec3, f64) {
    fn from(plane: Plane) -> Self {
        (plane.normal, plane.offset)
    }
}

impl TryFrom<(DVec3, f64)> for Plane {
    type Error = Error;
    fn try_from((normal, offset): (DVec3, f64)) -> Result<Self, Error> {
        Self::from_normal_and_offset(normal, offset)
    }
}
