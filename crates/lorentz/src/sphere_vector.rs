use std::ops::Neg;

use glam::DVec3;

use crate::tolerance::{DECISION, ROUNDING};
use crate::{Error, LorentzVector, Object, Plane, Point, Sphere};

/// A point of the space of spheres `Lambda^4 = { x : x . x = 1 }`: an oriented sphere or an oriented plane.
///
/// In this space planes are spheres through infinity and nothing distinguishes them (Section 3.1, formula (14)), so
/// every construction of the crate asks for this type; [`Sphere`] and [`Plane`] convert into it.
///
/// ```
/// use lorentz::{Plane, Sphere, SphereVector, glam::dvec3};
/// let sphere = SphereVector::from(Sphere::new(dvec3(1.0, 0.0, 0.0), 2.0)?);
/// let plane = SphereVector::from(Plane::new(dvec3(1.0, 0.0, 0.0), dvec3(2.0, 0.0, 0.0))?);
/// assert_eq!(sphere.product(plane), -0.5); // the cosine of their angle
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "LorentzVector", into = "LorentzVector")
)]
pub struct SphereVector {
    vector: LorentzVector,
}

impl SphereVector {
    /// The object along a space-like vector of any length; the sign is kept as orientation.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::ZeroVector`], [`Error::LightLike`], [`Error::TimeLike`].
    pub fn along(vector: LorentzVector) -> Result<Self, Error> {
        match vector.recover()? {
            // Through the recovered object, so that the unit vector is one to the last bit that matters.
            Object::Sphere(sphere) => Ok(sphere.into()),
            Object::Plane(plane) => Ok(plane.into()),
            Object::Point { .. } | Object::Infinity { .. } => Err(Error::LightLike {
                square: vector.square(),
            }),
        }
    }

    /// A vector that is a unit vector by its formula.
    pub(crate) const fn from_unit(vector: LorentzVector) -> Self {
        Self { vector }
    }

    /// The unit vector.
    #[must_use]
    pub const fn vector(self) -> LorentzVector {
        self.vector
    }

    /// The sphere or the plane in space.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if centre or radius overflow.
    pub fn object(self) -> Result<Object, Error> {
        if self.vector.is_flat() {
            Plane::from_normal_and_offset(self.vector.v, self.vector.inf).map(Object::Plane)
        } else {
            Sphere::new(self.vector.v / self.vector.o, 1.0 / self.vector.o).map(Object::Sphere)
        }
    }

    /// Signed curvature 1/radius; zero for a plane.
    #[must_use]
    pub const fn curvature(self) -> f64 {
        self.vector.o
    }

    /// Unit normal at a point `x` of the sphere or the plane: `curvature * x - v` for both.
    ///
    /// Outward for a sphere of positive radius; *minus* the plane's normal for a plane (see [`Plane`]).
    #[must_use]
    pub fn normal_at(self, x: DVec3) -> DVec3 {
        self.vector.o * x - self.vector.v
    }

    /// The Lorentz product: the cosine of the angle under which the two meet, if they meet (Theorem 4).
    ///
    /// Computed from the distance of the centres where that has the smaller terms, so that spheres far from the
    /// origin lose no digits.
    #[must_use]
    pub fn product(self, other: Self) -> f64 {
        product_and_terms(self.vector, other.vector).0
    }

    /// The product with a point, `-power / (2 radius)` for a sphere and the signed distance for a plane (Theorem 3).
    ///
    /// The plane at a signed distance gives a length; so does the sphere, where it is close to the distance from the
    /// surface for points nearby. With the point at infinity it is minus the curvature.
    #[must_use]
    pub fn product_with_point(self, point: Point) -> f64 {
        point.position().map_or(-self.vector.o, |position| {
            self.point_product_and_terms(position).0
        })
    }

    /// Whether the point lies on the sphere or the plane.
    ///
    /// The product may be 1e-10 of the radius, or of the distances that it was computed from where these are smaller
    /// (planes, and spheres that are nearly planes).
    #[must_use]
    pub fn contains(self, point: Point) -> bool {
        let Some(position) = point.position() else {
            return self.vector.is_flat();
        };
        let (product, terms) = self.point_product_and_terms(position);
        let radius = self.vector.o.recip().abs();
        product.abs() <= DECISION * terms.min(radius) + ROUNDING * terms
    }

    /// The product with the point at `p` and the magnitude of the terms that were added: the smaller of two ways.
    fn point_product_and_terms(self, p: DVec3) -> (f64, f64) {
        let s = self.vector;
        let (linear, quadratic) = (s.v.dot(p), 0.5 * s.o * p.length_squared());
        let direct_terms = s.v.length() * p.length() + quadratic.abs() + s.inf.abs();
        if s.o == 0.0 {
            return (linear - s.inf, direct_terms);
        }
        let radius = 1.0 / s.o;
        let distance = 0.5 * s.o * p.distance_squared(s.v / s.o);
        let central_terms = 0.5 * radius.abs() + distance.abs();
        if central_terms <= direct_terms {
            (0.5 * radius - distance, central_terms)
        } else {
            (linear - quadratic - s.inf, direct_terms)
        }
    }
}

/// The product of two unit vectors and the magnitude of the terms that were added: the smaller of two ways.
pub(crate) fn product_and_terms(s: LorentzVector, t: LorentzVector) -> (f64, f64) {
    let (dot, cross) = (s.v.dot(t.v), s.o * t.inf + s.inf * t.o);
    let direct_terms = s.v.length() * t.v.length() + (s.o * t.inf).abs() + (s.inf * t.o).abs();
    if s.o == 0.0 || t.o == 0.0 {
        return (dot - cross, direct_terms);
    }
    let ratio = 0.5 * (s.o / t.o + t.o / s.o);
    let distance = 0.5 * s.o * t.o * (s.v / s.o).distance_squared(t.v / t.o);
    let central_terms = ratio.abs() + distance.abs();
    if central_terms <= direct_terms {
        (ratio - distance, central_terms)
    } else {
        (dot - cross, direct_terms)
    }
}

/// Whether a product of unit vectors equals `value`: to the decision tolerance, or to the rounding of its terms.
pub(crate) fn decide_product(s: LorentzVector, t: LorentzVector, value: f64) -> bool {
    let (product, terms) = product_and_terms(s, t);
    (product - value).abs() <= DECISION.max(ROUNDING * terms)
}

impl From<Sphere> for SphereVector {
    fn from(sphere: Sphere) -> Self {
        Self::from_unit(sphere.vector())
    }
}

impl From<Plane> for SphereVector {
    fn from(plane: Plane) -> Self {
        Self::from_unit(plane.vector())
    }
}

impl From<SphereVector> for LorentzVector {
    fn from(sphere: SphereVector) -> Self {
        sphere.vector
    }
}

impl TryFrom<LorentzVector> for SphereVector {
    type Error = Error;
    fn try_from(vector: LorentzVector) -> Result<Self, Error> {
        Self::along(vector)
    }
}

impl Neg for SphereVector {
    type Output = Self;
    fn neg(self) -> Self {
        Self::from_unit(-self.vector)
    }
}
