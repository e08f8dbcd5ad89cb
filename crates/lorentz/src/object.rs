use crate::{LorentzVector, Plane, Point, Sphere};

/// What a vector of the Minkowski-Lorentz space stands for in Euclidean space (Appendix A.1 of the paper).
///
/// Found by [`LorentzVector::recover`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Object {
    /// A light-like vector off the direction of `e_inf`.
    Point {
        /// The point.
        point: Point,
        /// The vector is `scale` times the vector of the point.
        scale: f64,
    },
    /// A multiple of `e_inf`.
    Infinity {
        /// The vector is `scale` times `e_inf`.
        scale: f64,
    },
    /// A space-like vector with a coordinate along `e_o`.
    Sphere(Sphere),
    /// A space-like vector without one: a sphere through the point at infinity.
    Plane(Plane),
}

impl Object {
    /// The normalised vector of the object: the scale of a point is left out.
    #[must_use]
    pub fn vector(self) -> LorentzVector {
        match self {
            Self::Point { point, .. } => point.vector(),
            Self::Infinity { .. } => LorentzVector::INFINITY,
            Self::Sphere(sphere) => sphere.vector(),
            Self::Plane(plane) => plane.vector(),
        }
    }

    /// The point, if it is one; infinity counts.
    #[must_use]
    pub fn point(self) -> Option<Point> {
        match self {
            Self::Point { point, .. } => Some(point),
            Self::Infinity { .. } => Some(Point::INFINITY),
            Self::Sphere(_) | Self::Plane(_) => None,
        }
    }

    /// The sphere, if it is one.
    #[must_use]
    pub fn sphere(self) -> Option<Sphere> {
        if let Self::Sphere(sphere) = self {
            Some(sphere)
        } else {
            None
        }
    }

    /// The plane, if it is one.
    #[must_use]
    pub fn plane(self) -> Option<Plane> {
        if let Self::Plane(plane) = self {
            Some(plane)
        } else {
            None
        }
    }
}
