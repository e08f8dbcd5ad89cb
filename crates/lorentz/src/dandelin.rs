//! Dandelin's spheres: the plane sections of a cone, their foci and directrices (Section 5 and its proof sketch).

use glam::DVec3;

use crate::construct::{ConicType, cone};
use crate::tolerance::DECISION;
use crate::{Circle, Error, Line, Plane, Point, Sphere, SphereVector};

/// The section of a cone by a plane, read off the spheres that touch both.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaneSection {
    /// Product of the hyperbola's centre with the plane: `|g| > 1` is an ellipse, 1 a parabola, below a hyperbola.
    pub centre_product: f64,
    /// Signed distance of the vertex from the plane.
    pub vertex_distance: f64,
    /// Numerical eccentricity of the section; 0 for a circle.
    pub eccentricity: f64,
    /// The type of the section.
    pub conic: ConicType,
    /// Whether it is a circle.
    pub is_circle: bool,
    /// The spheres that touch cone and plane, the one with equal orientation first; one only for a parabola.
    pub spheres: Vec<DandelinSphere>,
}

impl PlaneSection {
    /// The word for the section: ellipse, circle, parabola or hyperbola.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        if self.is_circle {
            "circle"
        } else {
            self.conic.name()
        }
    }
}

/// A sphere that touches a cone along a circle and a plane in a focus of its section with the cone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DandelinSphere {
    /// Product with the plane, 1 or -1.
    pub contact_sign: f64,
    /// The sphere; its radius is negative on the nappe opposite to the given sphere.
    pub sphere: Sphere,
    /// Its point of contact with the plane: a focus of the section.
    pub focus: DVec3,
    /// Its circle of contact with the cone.
    pub circle: Circle,
    /// Its parameter on the cone's curve, from the vertex to infinity; outside of `[0, 1]` on the opposite nappe.
    pub t: f64,
    /// The directrix that belongs to the focus, in which the plane meets the plane of the circle; none for a circle.
    pub directrix: Option<Line>,
}

/// The section of the cone with this `vertex` around `sphere` by a plane.
///
/// # Errors
/// Those of [`cone`]; [`Error::PlaneThroughVertex`].
pub fn plane_section(vertex: DVec3, sphere: Sphere, plane: Plane) -> Result<PlaneSection, Error> {
    let whole = cone(vertex, sphere)?;
    // The spheres are S + rho w with the axis vector w, |w| = 1 / sin(half angle).
    let axis_vector = whole.centre.v;
    let plane_vector = SphereVector::from(plane);
    let (g, h) = (
        plane.normal().dot(axis_vector),
        plane.signed_distance(vertex),
    );
    if plane_vector.contains(Point::new(vertex)?) {
        return Err(Error::PlaneThroughVertex { distance: h });
    }
    let square = axis_vector.length_squared();
    // |w|^2 - g^2 as the square of the part of w in the plane: no cancellation for a section close to a circle.
    let in_plane = (axis_vector - g * plane.normal()).length_squared();
    let is_circle = in_plane <= DECISION * DECISION * square;
    let eccentricity = if is_circle {
        0.0
    } else {
        (in_plane / (square - 1.0)).sqrt()
    };
    let conic = ConicType::from_discriminant(1.0 - g.abs(), DECISION);
    let mut spheres = Vec::with_capacity(2);
    for contact_sign in [1.0, -1.0] {
        if (contact_sign - g).abs() <= DECISION {
            continue; // its radius is infinite
        }
        let radius = h / (contact_sign - g);
        let dandelin = Sphere::new(vertex + radius * axis_vector, radius)?;
        // The centre is at the signed distance eps * rho from the plane.
        let focus = dandelin.centre() - contact_sign * radius * plane.normal();
        let circle = contact_circle(vertex, dandelin);
        let directrix = if is_circle {
            None
        } else {
            Some(intersection(plane, circle)?)
        };
        let t = radius / (2.0 * whole.weight + radius);
        spheres.push(DandelinSphere {
            contact_sign,
            sphere: dandelin,
            focus,
            circle,
            t,
            directrix,
        });
    }
    Ok(PlaneSection {
        centre_product: g,
        vertex_distance: h,
        eccentricity,
        conic,
        is_circle,
        spheres,
    })
}

/// The circle in which the tangents from a point touch a sphere; its axis points away from the point where the radius
/// is positive.
fn contact_circle(vertex: DVec3, sphere: Sphere) -> Circle {
    let (offset, r) = (sphere.centre() - vertex, sphere.radius());
    let distance = offset.length();
    let along = r * r / distance;
    let radius = (r / distance).abs() * ((distance - r) * (distance + r)).max(0.0).sqrt();
    let axis = offset * r.signum() / distance;
    Circle::from_parts(sphere.centre() - along * offset / distance, radius, axis)
}

/// The line in which a plane meets the plane of a circle.
fn intersection(plane: Plane, circle: Circle) -> Result<Line, Error> {
    let (n, a) = (plane.normal(), circle.axis());
    let direction = n.cross(a);
    let square = direction.length_squared();
    // The point of both planes nearest to the circle's centre: no distances from the origin enter.
    let height = plane.signed_distance(circle.centre());
    let point = circle.centre() - height * a.cross(direction) / square;
    Line::new(direction, point)
}
