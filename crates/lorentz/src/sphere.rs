use std::ops::{Add, Mul, Neg, Sub};

use glam::DVec3;

use crate::{Error, LorentzVector};

/// An oriented sphere: centre and signed radius, which is not zero.
///
/// A positive radius means that the unit normal `(x - centre) / radius` points outward; `-s` is the same sphere with
/// the other orientation (Section 3.1). On the space of spheres it is
/// `(1/radius) (e_o + centre + (|centre|^2 - radius^2)/2 e_inf)` (formula (13)).
///
/// ```
/// use lorentz::{Sphere, glam::dvec3};
/// let s = Sphere::new(dvec3(1.0, 2.0, 3.0), 2.0)?;
/// assert_eq!(s.vector().to_null(), [0.5, 0.5, 1.0, 1.5, 2.5]);
/// assert_eq!(s.vector().square(), 1.0);
/// assert!(Sphere::new(dvec3(1.0, 2.0, 3.0), 0.0).is_err()); // that is a point
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Cycle", into = "Cycle"))]
pub struct Sphere {
    centre: DVec3,
    radius: f64,
}

impl Sphere {
    /// The sphere about `centre` with the signed `radius`.
    ///
    /// # Errors
    /// [`Error::ZeroRadius`]; [`Error::NonFinite`], also when the sphere is too large or too small for its vector.
    pub fn new(centre: DVec3, radius: f64) -> Result<Self, Error> {
        if !(centre.is_finite() && radius.is_finite()) {
            return Err(Error::NonFinite {
                what: "the centre or the radius of a sphere",
            });
        }
        if radius == 0.0 {
            return Err(Error::ZeroRadius { centre });
        }
        let sphere = Self { centre, radius };
        if sphere.vector().coordinate_square().is_finite() {
            Ok(sphere)
        } else {
            Err(Error::NonFinite {
                what: "the vector of a sphere of this centre and radius",
            })
        }
    }

    /// Centre in space.
    #[must_use]
    pub const fn centre(self) -> DVec3 {
        self.centre
    }

    /// Signed radius: positive if the normal points outward.
    #[must_use]
    pub const fn radius(self) -> f64 {
        self.radius
    }

    /// The unit vector of this sphere on the space of spheres.
    #[must_use]
    pub fn vector(self) -> LorentzVector {
        let inf = 0.5 * (self.centre.length_squared() - self.radius * self.radius) / self.radius;
        LorentzVector::new(1.0 / self.radius, self.centre / self.radius, inf)
    }

    /// Unit normal at a point `x` of the sphere.
    #[must_use]
    pub fn normal(self, x: DVec3) -> DVec3 {
        (x - self.centre) / self.radius
    }

    /// Power of the point `x`: squared distance to the centre minus squared radius, positive outside.
    #[must_use]
    pub fn power(self, x: DVec3) -> f64 {
        x.distance_squared(self.centre) - self.radius * self.radius
    }

    /// The oriented sphere as a vector of R^{3,1}.
    #[must_use]
    pub const fn cycle(self) -> Cycle {
        Cycle {
            centre: self.centre,
            radius: self.radius,
        }
    }
}

impl Neg for Sphere {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            centre: self.centre,
            radius: -self.radius,
        }
    }
}

impl From<Sphere> for LorentzVector {
    fn from(sphere: Sphere) -> Self {
        sphere.vector()
    }
}

impl From<Sphere> for Cycle {
    fn from(sphere: Sphere) -> Self {
        sphere.cycle()
    }
}

impl TryFrom<Cycle> for Sphere {
    type Error = Error;
    fn try_from(cycle: Cycle) -> Result<Self, Error> {
        Self::new(cycle.centre, cycle.radius)
    }
}

/// An oriented sphere as a vector `(centre; radius)` of R^{3,1}, the space of Laguerre's cycles.
///
/// The radius may be any number: zero is a point, and differences of cycles are cycles. The product is
/// `p . q - r s`; two cycles touch with the same orientation exactly when their difference has square zero. Unlike
/// [`LorentzVector`] it knows no planes and no point at infinity, but its lines are cones.
///
/// ```
/// use lorentz::{Cycle, glam::dvec3};
/// let big = Cycle::new(dvec3(0.0, 0.0, 0.0), 5.0);
/// let small = Cycle::new(dvec3(2.0, 0.0, 0.0), 3.0);
/// assert_eq!((big - small).square(), 0.0); // the small one touches the big one from inside
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cycle {
    /// Centre in space.
    pub centre: DVec3,
    /// Signed radius.
    pub radius: f64,
}

impl Cycle {
    /// The vector `(centre; radius)`.
    #[must_use]
    pub const fn new(centre: DVec3, radius: f64) -> Self {
        Self { centre, radius }
    }

    /// The product of R^{3,1}: `p . q - r s`.
    #[must_use]
    pub fn product(self, other: Self) -> f64 {
        self.centre.dot(other.centre) - self.radius * other.radius
    }

    /// The square of R^{3,1}: `|p|^2 - r^2`. Of a difference of two cycles it is the squared length of their
    /// common tangents (of the kind that respects the orientations).
    #[must_use]
    pub fn square(self) -> f64 {
        self.centre.length_squared() - self.radius * self.radius
    }

    /// The point `centre + radius * normal`, at which this cycle has the unit normal `normal`.
    #[must_use]
    pub fn point_with_normal(self, normal: DVec3) -> DVec3 {
        self.centre + self.radius * normal
    }

    /// Whether centre and radius are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.centre.is_finite() && self.radius.is_finite()
    }
}

impl Add for Cycle {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.centre + other.centre, self.radius + other.radius)
    }
}

impl Sub for Cycle {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.centre - other.centre, self.radius - other.radius)
    }
}

impl Neg for Cycle {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.centre, -self.radius)
    }
}

impl Mul<f64> for Cycle {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.centre * factor, self.radius * factor)
    }
}
