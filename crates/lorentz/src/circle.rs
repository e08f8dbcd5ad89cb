use glam::DVec3;

use crate::plane::unit_direction;
use crate::sphere_vector::{decide_product, product_and_terms};
use crate::{Error, LorentzVector, Plane, Sphere, SphereVector};

/// A circle in space: centre, positive radius and a unit axis, which gives it a sense of rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "(DVec3, f64, DVec3)", into = "(DVec3, f64, DVec3)")
)]
pub struct Circle {
    centre: DVec3,
    radius: f64,
    axis: DVec3,
}

/// A line in space: a unit direction and the point of the line nearest to the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "(DVec3, DVec3)", into = "(DVec3, DVec3)")
)]
pub struct Line {
    direction: DVec3,
    nearest_to_origin: DVec3,
}

/// The intersection of two orthogonal spheres: a circle, or a line if both are planes (a circle through infinity).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CharacteristicCircle {
    /// A circle of finite radius.
    Circle(Circle),
    /// A circle through the point at infinity.
    Line(Line),
}

impl Circle {
    /// The circle about `centre` with the given `radius` and `axis` (of any length but zero).
    ///
    /// # Errors
    /// [`Error::CircleRadius`], [`Error::ZeroNormal`], [`Error::NonFinite`].
    pub fn new(centre: DVec3, radius: f64, axis: DVec3) -> Result<Self, Error> {
        if !(centre.length_squared().is_finite() && (radius * radius).is_finite()) {
            return Err(Error::NonFinite {
                what: "the centre or the radius of a circle",
            });
        }
        if radius <= 0.0 {
            return Err(Error::CircleRadius { radius });
        }
        Ok(Self {
            centre,
            radius,
            axis: unit_direction(axis)?,
        })
    }

    pub(crate) const fn from_parts(centre: DVec3, radius: f64, axis: DVec3) -> Self {
        Self {
            centre,
            radius,
            axis,
        }
    }

    /// Centre in space.
    #[must_use]
    pub const fn centre(self) -> DVec3 {
        self.centre
    }

    /// Radius, positive.
    #[must_use]
    pub const fn radius(self) -> f64 {
        self.radius
    }

    /// Unit normal of the circle's plane.
    #[must_use]
    pub const fn axis(self) -> DVec3 {
        self.axis
    }

    /// The sphere of which this is a great circle, with outward normal.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the sphere is too large or too small for its vector.
    pub fn great_sphere(self) -> Result<Sphere, Error> {
        Sphere::new(self.centre, self.radius)
    }

    /// The plane of the circle, with the axis as its normal.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if its offset overflows.
    pub fn plane(self) -> Result<Plane, Error> {
        Plane::new(self.axis, self.centre)
    }

    /// An orthonormal pair `(u, v)` spanning the circle's plane: `u` is the part of `reference` orthogonal to the
    /// axis, `v = axis x u`. The point of angle theta is `centre + radius (cos u + sin v)`.
    ///
    /// # Errors
    /// [`Error::ReferenceParallelToAxis`], [`Error::ZeroNormal`], [`Error::NonFinite`].
    pub fn frame(self, reference: DVec3) -> Result<(DVec3, DVec3), Error> {
        frame_about(self.axis, reference)
    }

    /// The point of angle `theta` (radians), counted from the `reference` direction about the axis.
    ///
    /// # Errors
    /// Those of [`frame`](Self::frame).
    pub fn point(self, theta: f64, reference: DVec3) -> Result<DVec3, Error> {
        if !theta.is_finite() {
            return Err(Error::NonFinite {
                what: "the angle on a circle",
            });
        }
        let (u, v) = self.frame(reference)?;
        Ok(self.centre + self.radius * (theta.cos() * u + theta.sin() * v))
    }

    /// Distance of a point `x` from the circle.
    #[must_use]
    pub fn distance(self, x: DVec3) -> f64 {
        let offset = x - self.centre;
        let height = offset.dot(self.axis);
        let in_plane = (offset - height * self.axis).length();
        height.hypot(in_plane - self.radius)
    }
}

/// An orthonormal pair orthogonal to the unit vector `axis`, the first in the direction of `reference`.
pub(crate) fn frame_about(axis: DVec3, reference: DVec3) -> Result<(DVec3, DVec3), Error> {
    let reference = unit_direction(reference)?;
    let u = reference - reference.dot(axis) * axis;
    if u.length_squared() <= crate::tolerance::PARALLEL * crate::tolerance::PARALLEL {
        return Err(Error::ReferenceParallelToAxis { axis });
    }
    let u = u.normalize();
    Ok((u, axis.cross(u)))
}

impl Line {
    /// The line through `point` with the given `direction` (of any length but zero).
    ///
    /// # Errors
    /// [`Error::ZeroNormal`], [`Error::NonFinite`].
    pub fn new(direction: DVec3, point: DVec3) -> Result<Self, Error> {
        let direction = unit_direction(direction)?;
        if !point.length_squared().is_finite() {
            return Err(Error::NonFinite {
                what: "the point of a line",
            });
        }
        Ok(Self {
            direction,
            nearest_to_origin: point - point.dot(direction) * direction,
        })
    }

    pub(crate) const fn from_parts(direction: DVec3, nearest_to_origin: DVec3) -> Self {
        Self {
            direction,
            nearest_to_origin,
        }
    }

    /// Unit direction.
    #[must_use]
    pub const fn direction(self) -> DVec3 {
        self.direction
    }

    /// The point of the line nearest to the origin.
    #[must_use]
    pub const fn nearest_to_origin(self) -> DVec3 {
        self.nearest_to_origin
    }
}

impl CharacteristicCircle {
    /// The circle in which two orthogonal spheres meet (Section 3.3).
    ///
    /// The circle depends only on the pencil of the two, the sense of its axis on their order: if `derivative` is the
    /// derivative sphere of a family, the axis points to where the centres move.
    ///
    /// ```
    /// use lorentz::{CharacteristicCircle, Sphere, glam::dvec3};
    /// let a = Sphere::new(dvec3(0.0, 0.0, 0.0), 3.0)?;
    /// let b = Sphere::new(dvec3(5.0, 0.0, 0.0), 4.0)?;
    /// let circle = CharacteristicCircle::of(a.into(), b.into())?.circle().expect("not a line");
    /// assert!((circle.radius() - 2.4).abs() < 1e-15);
    /// assert!((circle.centre() - dvec3(1.8, 0.0, 0.0)).length() < 1e-15);
    /// # Ok::<(), lorentz::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotOrthogonal`].
    pub fn of(sphere: SphereVector, derivative: SphereVector) -> Result<Self, Error> {
        let (s, t) = (sphere.vector(), derivative.vector());
        if !decide_product(s, t, 0.0) {
            return Err(Error::NotOrthogonal {
                product: product_and_terms(s, t).0,
            });
        }
        Ok(Self::of_orthogonal(s, t))
    }

    /// The circle of two unit vectors that are orthogonal by construction.
    pub(crate) fn of_orthogonal(s: LorentzVector, t: LorentzVector) -> Self {
        if s.is_flat() && t.is_flat() {
            let direction = s.v.cross(t.v).normalize_or_zero();
            return Self::Line(Line::from_parts(direction, s.inf * s.v + t.inf * t.v));
        }
        let curvature = s.o.hypot(t.o);
        let (a, b) = (s.o / curvature, t.o / curvature);
        Self::Circle(Circle::from_parts(
            (a * s.v + b * t.v) / curvature,
            1.0 / curvature,
            a * t.v - b * s.v,
        ))
    }

    /// The circle, unless it is a line.
    #[must_use]
    pub fn circle(self) -> Option<Circle> {
        if let Self::Circle(circle) = self {
            Some(circle)
        } else {
            None
        }
    }

    /// The line, if it is one.
    #[must_use]
    pub fn line(self) -> Option<Line> {
        if let Self::Line(line) = self {
            Some(line)
        } else {
            None
        }
    }

    /// Two orthogonal unit vectors whose spheres meet in this circle, in the order that gives its axis: the great
    /// sphere and the plane, or two planes.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the great sphere overflows.
    pub fn orthogonal_pair(self) -> Result<(SphereVector, SphereVector), Error> {
        match self {
            Self::Circle(circle) => Ok((circle.great_sphere()?.into(), circle.plane()?.into())),
            Self::Line(line) => {
                let first = line.direction.any_orthonormal_vector();
                let second = line.direction.cross(first);
                let through =
                    |normal| Plane::new(normal, line.nearest_to_origin).map(SphereVector::from);
                Ok((through(first)?, through(second)?))
            }
        }
    }
}

impl From<Circle> for CharacteristicCircle {
    fn from(circle: Circle) -> Self {
        Self::Circle(circle)
    }
}

impl From<Line> for CharacteristicCircle {
    fn from(line: Line) -> Self {
        Self::Line(line)
    }
}

impl From<Circle> for (DVec3, f64, DVec3) {
    fn from(circle: Circle) -> Self {
        (circle.centre, circle.radius, circle.axis)
    }
}

impl TryFrom<(DVec3, f64, DVec3)> for Circle {
    type Error = Error;
    fn try_from((centre, radius, axis): (DVec3, f64, DVec3)) -> Result<Self, Error> {
        Self::new(centre, radius, axis)
    }
}

impl From<Line> for (DVec3, DVec3) {
    fn from(line: Line) -> Self {
        (line.direction, line.nearest_to_origin)
    }
}

impl TryFrom<(DVec3, DVec3)> for Line {
    type Error = Error;
    fn try_from((direction, point): (DVec3, DVec3)) -> Result<Self, Error> {
        Self::new(direction, point)
    }
}
