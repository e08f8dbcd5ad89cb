use crate::sphere_vector::{decide_product, product_and_terms};
use crate::tolerance::DECISION;
use crate::{LorentzVector, Object, Point, SphereVector};

/// The position of a point with respect to a sphere or a plane (Theorem 3).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PointPosition {
    /// The Lorentz product of the two.
    pub product: f64,
    /// On which side the point lies.
    pub side: Side,
}

/// The side of a sphere or of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// On the surface.
    On,
    /// In the ball, whatever the orientation of the sphere.
    Inside,
    /// Outside of the ball, whatever the orientation of the sphere.
    Outside,
    /// On the side of the plane to which its normal points.
    Positive,
    /// On the other side of the plane.
    Negative,
}

/// The position of two oriented spheres or planes (Theorem 4, with the cases which it leaves out).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpherePosition {
    /// The Lorentz product of the two unit vectors.
    pub product: f64,
    /// What it means.
    pub relation: Relation,
}

/// The five ways, in which two spheres or planes lie, and orthogonality.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Relation {
    /// The same sphere with the same orientation.
    Identical,
    /// The same sphere with opposite orientations.
    Opposite,
    /// They meet at a right angle: product 0.
    Orthogonal,
    /// They touch: product 1 with the same orientation at the point of contact, -1 with opposite ones.
    Tangent {
        /// The point of contact; infinity for parallel planes.
        contact: Object,
        /// Whether the normals agree there.
        same_orientation: bool,
    },
    /// They meet in a circle (two planes in a line).
    Secant {
        /// Angle between their unit normals along the circle, in radians.
        angle: f64,
    },
    /// They have no common point.
    Disjoint {
        /// The inversive distance `arcosh |product|`, unchanged by inversions.
        inversive_distance: f64,
    },
}

impl Relation {
    /// The name of the relation, as a word.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Identical => "identical",
            Self::Opposite => "identical with opposite orientation",
            Self::Orthogonal => "orthogonal",
            Self::Tangent { .. } => "tangent",
            Self::Secant { .. } => "secant",
            Self::Disjoint { .. } => "disjoint",
        }
    }
}

impl SphereVector {
    /// Where the point lies with respect to this sphere or plane.
    ///
    /// The sign of the product alone does not tell inside from outside: it changes with the orientation.
    /// The point at infinity lies on every plane and outside of every sphere.
    #[must_use]
    pub fn position_of_point(self, point: Point) -> PointPosition {
        let product = self.product_with_point(point);
        let side = if self.contains(point) {
            Side::On
        } else if self.vector().is_flat() {
            if product > 0.0 {
                Side::Positive
            } else {
                Side::Negative
            }
        } else if product * self.curvature() > 0.0 {
            Side::Inside
        } else {
            Side::Outside
        };
        PointPosition { product, side }
    }

    /// How this sphere or plane lies with respect to another one.
    ///
    /// ```
    /// use lorentz::{Relation, Sphere, SphereVector, glam::dvec3};
    /// let a = SphereVector::from(Sphere::new(dvec3(0.0, 0.0, 0.0), 2.0)?);
    /// let b = SphereVector::from(Sphere::new(dvec3(5.0, 0.0, 0.0), 3.0)?);
    /// let position = a.position_of(b);
    /// assert_eq!(position.product, -1.0);
    /// let Relation::Tangent { contact, same_orientation: false } = position.relation else { panic!() };
    /// let contact = contact.point().and_then(|p| p.position()).expect("a finite point");
    /// assert!((contact - dvec3(2.0, 0.0, 0.0)).length() < 1e-15);
    /// # Ok::<(), lorentz::Error>(())
    /// ```
    #[must_use]
    pub fn position_of(self, other: Self) -> SpherePosition {
        let (s, t) = (self.vector(), other.vector());
        let (product, _) = product_and_terms(s, t);
        let same = self.same_up_to_orientation(other);
        let relation = if same == Some(1.0) {
            Relation::Identical
        } else if same.is_some() {
            Relation::Opposite
        } else if decide_product(s, t, 0.0) {
            Relation::Orthogonal
        } else if decide_product(s, t, product.signum()) {
            Relation::Tangent {
                contact: contact(s, t, product.signum()),
                same_orientation: product > 0.0,
            }
        } else if product.abs() < 1.0 {
            Relation::Secant {
                angle: product.acos(),
            }
        } else {
            Relation::Disjoint {
                inversive_distance: product.abs().acosh(),
            }
        };
        SpherePosition { product, relation }
    }

    /// Whether the two are the same sphere, `Some(1.0)` with the same orientation and `Some(-1.0)` with opposite ones.
    ///
    /// Centres and radii are compared in units of the radius: the product alone would not tell equal spheres from
    /// touching ones.
    #[must_use]
    pub fn same_up_to_orientation(self, other: Self) -> Option<f64> {
        same_within(self, other, DECISION)
    }
}

/// [`SphereVector::same_up_to_orientation`] to a given relative tolerance.
pub(crate) fn same_within(a: SphereVector, b: SphereVector, tolerance: f64) -> Option<f64> {
    let (s, t) = (a.vector(), b.vector());
    [1.0, -1.0]
        .into_iter()
        .find(|&sign| same_unit_vector(s, sign * t, tolerance))
}

fn same_unit_vector(s: LorentzVector, t: LorentzVector, tolerance: f64) -> bool {
    if s.is_flat() || t.is_flat() {
        // A plane has no size of its own: compare coordinates, relative to the largest.
        return (s - t).max_abs() <= tolerance * s.max_abs().max(t.max_abs());
    }
    let (centres, radii) = ((s.v / s.o, t.v / t.o), (1.0 / s.o, 1.0 / t.o));
    // The subtraction of the centres cannot know more than their rounding.
    let allowed =
        tolerance * radii.0.abs() + 4.0 * f64::EPSILON * (centres.0.length() + centres.1.length());
    centres.0.distance(centres.1) <= allowed && (radii.0 - radii.1).abs() <= allowed
}

/// The light-like vector `s - sign t` of two touching spheres is their point of contact.
fn contact(s: LorentzVector, t: LorentzVector, sign: f64) -> Object {
    LorentzVector::recover_point_between(s, -sign, t).unwrap_or(Object::Infinity {
        scale: (s - sign * t).inf,
    })
}
