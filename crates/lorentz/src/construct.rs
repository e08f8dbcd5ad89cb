//! The three constructions of Section 4.1: canal curves from points, spheres and circles.
//!
//! | given | function | in the paper |
//! |---|---|---|
//! | vertex and sphere | [`cone`], [`cone_between_radii`] | Algorithm 1, Lemma 2 |
//! | two points and a sphere | [`between_points`] | Algorithm 1 with any second point |
//! | circle and point | [`circle_to_point`] | Algorithm 2 |
//! | circle and sphere | [`circle_to_sphere`] | Section 4.1.3 |
//!
//! All use the closed forms of the middle control point and its weight, which lose no digits to the paper's quotients
//! of differences, and follow the signs that the paper leaves open.

use glam::DVec3;

use crate::sphere_vector::{decide_product, product_and_terms};
use crate::tolerance::{DECISION, ROUNDING};
use crate::{
    CanalCurve, Error, LorentzVector, Point, Sphere, SphereCurve, SphereMassPoint, SphereVector,
};

/// The type of the conic that a curve of spheres is, by the discriminant of its weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ConicType {
    /// No real zero of the weight: a connected circle of the space of spheres.
    Ellipse,
    /// A double zero of the weight: one singular point.
    Parabola,
    /// Two zeros of the weight: two singular points.
    Hyperbola,
}

impl ConicType {
    /// By the sign of a discriminant, which counts as zero below `tolerance`.
    pub(crate) fn from_discriminant(discriminant: f64, tolerance: f64) -> Self {
        if discriminant.abs() <= tolerance {
            Self::Parabola
        } else if discriminant < 0.0 {
            Self::Ellipse
        } else {
            Self::Hyperbola
        }
    }

    /// The word for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ellipse => "ellipse",
            Self::Parabola => "parabola",
            Self::Hyperbola => "hyperbola",
        }
    }
}

/// What Algorithm 1 finds: a surface between two of its singular points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BetweenPoints {
    /// Centre of the hyperbola on the space of spheres; the middle control point, not multiplied by its weight.
    pub centre: LorentzVector,
    /// The middle weight. Its sign selects the branch that contains the sphere.
    pub weight: f64,
    /// Parameter of the given sphere.
    pub parameter_of_sphere: f64,
    /// The surface, from the first point at t = 0 to the second at t = 1.
    pub curve: CanalCurve,
}

/// The surface with two singular points `first` and `second` around a sphere (Algorithm 1): a cone if one is infinity,
/// else a piece of a horned or spindle cyclide.
///
/// The sphere must leave both points on one side: outside, or both inside. The paper asks that the first be outside,
/// which is right for a cone only, and leaves the sign of the weight free, although one sign alone contains the sphere.
///
/// # Errors
/// In this order: [`Error::CoincidentPoints`]; [`Error::PointOnSphere`] (a plane passes through infinity);
/// [`Error::SphereSeparatesPoints`]; [`Error::NonFinite`].
pub fn between_points(
    first: Point,
    second: Point,
    sphere: SphereVector,
) -> Result<BetweenPoints, Error> {
    let (m0, m2, sigma) = (first.vector(), second.vector(), sphere.vector());
    let mutual = match (first.position(), second.position()) {
        (None, None) => 0.0,
        (Some(p), Some(q)) if p.distance(q) <= ROUNDING * p.length().max(q.length()) => 0.0,
        (Some(p), Some(q)) => -0.5 * p.distance_squared(q),
        _ => -1.0,
    };
    if mutual == 0.0 {
        return Err(Error::CoincidentPoints);
    }
    let (p0, p2) = (
        sphere.product_with_point(first),
        sphere.product_with_point(second),
    );
    if sphere.contains(first) || sphere.contains(second) {
        return Err(Error::PointOnSphere {
            first: p0,
            second: p2,
        });
    }
    if p0 * p2 < 0.0 {
        return Err(Error::SphereSeparatesPoints {
            first: p0,
            second: p2,
        });
    }
    let (a, b) = (p2 / mutual, p0 / mutual);
    let centre = sigma - a * m0 - b * m2;
    let weight = (0.5 * mutual.abs() / (p0 * p2).sqrt()).copysign(a);
    let control = [
        SphereMassPoint::vector(m0),
        SphereMassPoint::point(centre, weight),
        SphereMassPoint::vector(m2),
    ];
    let parameter_of_sphere = 1.0 / (1.0 + (a / b).sqrt());
    Ok(BetweenPoints {
        centre,
        weight,
        parameter_of_sphere,
        curve: constructed(control)?,
    })
}

/// The cone with this `vertex` around a sphere (Algorithm 1), from the vertex at t = 0 to infinity at t = 1.
///
/// # Errors
/// [`Error::PointOnSphere`], [`Error::SphereSeparatesPoints`] if the vertex is inside; [`Error::NonFinite`].
pub fn cone(vertex: DVec3, sphere: Sphere) -> Result<BetweenPoints, Error> {
    between_points(Point::new(vertex)?, Point::INFINITY, sphere.into())
}

/// The parameter of the sphere with a given radius on the curve of [`cone`] with this middle weight (Lemma 2).
///
/// # Errors
/// [`Error::WrongSign`] if the radius has not the sign of the weight; [`Error::NonFinite`].
pub fn cone_parameter(radius: f64, weight: f64) -> Result<f64, Error> {
    if !(radius.is_finite() && weight.is_finite()) {
        return Err(Error::NonFinite {
            what: "a radius or a weight",
        });
    }
    if radius * weight.signum() <= 0.0 || weight == 0.0 {
        return Err(Error::WrongSign { radius, weight });
    }
    Ok(radius / (2.0 * weight + radius))
}

/// A piece of a cone between two of its spheres.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ConePatch {
    /// The whole cone, from its vertex to infinity.
    pub cone: BetweenPoints,
    /// Parameters of the two end spheres on the whole cone (Lemma 2).
    pub parameters: [f64; 2],
    /// The middle control point, not multiplied by its weight.
    pub middle: LorentzVector,
    /// The middle weight; the end weights are 1, or -1 if the radii are negative.
    pub weight: f64,
    /// The piece.
    pub curve: CanalCurve,
}

/// The piece of the cone with this `vertex` around `sphere` between the spheres of the two `radii`.
///
/// The dorsal fin of the paper's seahorse: vertex (-25/3, 0, 43/3), a sphere of radius 2 about (2, 0, 16), radii 2 and 3.
///
/// # Errors
/// Those of [`cone`] and [`cone_parameter`]; [`Error::Bezier`] if the radii are equal.
pub fn cone_between_radii(
    vertex: DVec3,
    sphere: Sphere,
    radii: [f64; 2],
) -> Result<ConePatch, Error> {
    let whole = cone(vertex, sphere)?;
    let parameters = [
        cone_parameter(radii[0], whole.weight)?,
        cone_parameter(radii[1], whole.weight)?,
    ];
    bezier_mass::Homography::between(parameters[0], parameters[1])?;
    let (m0, omega) = (Point::new(vertex)?.vector(), whole.centre);
    // The sphere of radius r is Omega + m0/r + r/(4 w^2) e_inf.
    let infinity_part = LorentzVector::INFINITY / (4.0 * whole.weight * whole.weight);
    let member = |radius: f64| omega + m0 / radius + radius * infinity_part;
    let [r0, r1] = radii;
    let middle = omega + (2.0 / (r0 + r1)) * m0 + (2.0 * r0 * (r1 / (r0 + r1))) * infinity_part;
    let sign = whole.weight.signum();
    let weight = sign * (0.5 * ((r0 / r1).sqrt() + (r1 / r0).sqrt()));
    let control = [
        SphereMassPoint::point(member(r0), sign),
        SphereMassPoint::point(middle, weight),
        SphereMassPoint::point(member(r1), sign),
    ];
    Ok(ConePatch {
        cone: whole,
        parameters,
        middle,
        weight,
        curve: constructed(control)?,
    })
}

/// What Algorithm 2 finds: a surface from a circle to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CircleToPoint {
    /// The middle control.
    pub middle: CircleToPointMiddle,
    /// Sign of the last control vector: 1, or -1 where the arc passes a plane and reaches the point with negative radius.
    pub light_sign: f64,
    /// The surface, from the circle at t = 0 to the point at t = 1.
    pub curve: CanalCurve,
}

/// The two cases of Algorithm 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CircleToPointMiddle {
    /// A second singular point exists: the conic is a hyperbola.
    Hyperbola {
        /// Centre of the hyperbola (Lemma 1).
        centre: LorentzVector,
        /// The middle control point P1, not multiplied.
        point: LorentzVector,
        /// Its weight, positive.
        weight: f64,
    },
    /// The point lies on the derivative sphere: the conic is a parabola without centre (a cylinder, a horn torus or a
    /// cyclide with one singular point), and the middle control is this vector.
    Parabola {
        /// The middle control vector.
        vector: LorentzVector,
    },
}

/// The surface from the circle of two orthogonal spheres to a singular point (Algorithm 2).
///
/// The arc may leave `sphere` against `derivative`: it has a positive middle weight. Where the paper's weight (30) would
/// be imaginary, the last control vector is reversed; where the point lies on the derivative sphere and Lemma 1 has no
/// centre, the conic is a parabola.
///
/// # Errors
/// In this order: [`Error::NotOrthogonal`]; [`Error::PointOnFirstSphere`]; [`Error::NonFinite`].
pub fn circle_to_point(
    sphere: SphereVector,
    derivative: SphereVector,
    point: Point,
) -> Result<CircleToPoint, Error> {
    require_orthogonal(sphere, derivative)?;
    let p = sphere.product_with_point(point);
    if sphere.contains(point) {
        return Err(Error::PointOnFirstSphere { product: p });
    }
    let (sigma, sd, m0) = (sphere.vector(), derivative.vector(), point.vector());
    let light_sign = -p.signum();
    let last = SphereMassPoint::vector(light_sign * m0);
    if derivative.contains(point) {
        let vector = (0.5 * p.abs()).sqrt() * sd;
        let control = [
            SphereMassPoint::point(sigma, 1.0),
            SphereMassPoint::vector(vector),
            last,
        ];
        let middle = CircleToPointMiddle::Parabola { vector };
        return Ok(CircleToPoint {
            middle,
            light_sign,
            curve: constructed(control)?,
        });
    }
    let c = derivative.product_with_point(point);
    let p1 = sigma - (p / c) * sd;
    let weight = c.abs() / (2.0 * p.abs()).sqrt();
    let control = [
        SphereMassPoint::point(sigma, 1.0),
        SphereMassPoint::point(p1, weight),
        last,
    ];
    let middle = CircleToPointMiddle::Hyperbola {
        centre: p1 + (p / c / c) * m0,
        point: p1,
        weight,
    };
    Ok(CircleToPoint {
        middle,
        light_sign,
        curve: constructed(control)?,
    })
}

/// What Section 4.1.3 finds: a surface from a circle to a sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CircleToSphere {
    /// The middle control.
    pub middle: CircleToSphereMiddle,
    /// Weight of the second sphere: 1, or -1 if the spheres are nested with the same orientation. In that case the
    /// weight vanishes once on the way, and the surface contains a singular point.
    pub end_weight: f64,
    /// The type of the conic on the space of spheres.
    pub conic: ConicType,
    /// Centre of the conic (38); none for a parabola.
    pub centre: Option<LorentzVector>,
    /// Whether the second sphere misses the first circle. If not, the surface is pinched: every circle passes
    /// singular points.
    pub is_regular: bool,
    /// The surface, leaving the circle in the direction of the derivative sphere.
    pub curve: CanalCurve,
}

/// The two cases of Section 4.1.3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CircleToSphereMiddle {
    /// A middle control point and its weight, of any sign.
    General {
        /// The middle control point P1, not multiplied.
        point: LorentzVector,
        /// Its weight; negative if the arc that leaves in the given direction is the longer one.
        weight: f64,
    },
    /// The spheres are the ends of a diameter of the conic.
    Diameter {
        /// The middle control vector.
        vector: LorentzVector,
    },
}

impl CircleToSphere {
    /// Whether this is a joint to model with: the weight is positive all along and the surface has no singular point.
    #[must_use]
    pub fn is_good_joint(&self) -> bool {
        let forward = match self.middle {
            CircleToSphereMiddle::General { weight, .. } => weight > 0.0,
            CircleToSphereMiddle::Diameter { .. } => true,
        };
        forward && self.end_weight > 0.0 && self.is_regular
    }

    /// The other arc of the same conic, leaving the circle in the opposite direction.
    ///
    /// # Errors
    /// None on a construction that exists.
    pub fn complement(&self) -> Result<CanalCurve, Error> {
        self.curve.complement()
    }
}

/// The surface that leaves the circle of two orthogonal spheres and ends in the sphere `second` (Section 4.1.3).
///
/// # Errors
/// In this order: [`Error::NotOrthogonal`]; [`Error::SecondEqualsFirst`]; [`Error::TangentSameOrientation`];
/// [`Error::NonFinite`].
pub fn circle_to_sphere(
    first: SphereVector,
    derivative: SphereVector,
    second: SphereVector,
) -> Result<CircleToSphere, Error> {
    require_orthogonal(first, derivative)?;
    let product = first.product(second);
    if first.same_up_to_orientation(second).is_some() {
        return Err(Error::SecondEqualsFirst { product });
    }
    let (sigma1, sd, sigma2) = (first.vector(), derivative.vector(), second.vector());
    if decide_product(sigma1, sigma2, 1.0) {
        return Err(Error::TangentSameOrientation);
    }
    // d2 = (sigma2 - sigma1)^2, c = sd . sigma2.
    let (d2, c) = (2.0 * (1.0 - product), derivative.product(second));
    let end_weight = d2.signum();
    let end = SphereMassPoint::point(sigma2, end_weight);
    let start = SphereMassPoint::point(sigma1, 1.0);
    let discriminant = d2 - c * c;
    let conic = ConicType::from_discriminant(-discriminant, DECISION * d2.abs().max(c * c));
    let centre = (conic != ConicType::Parabola)
        .then(|| sigma1 + (0.5 * d2 / discriminant) * ((sigma2 - sigma1) - c * sd));
    let is_regular = product * product + c * c > 1.0 + DECISION * (product * product + c * c);
    let (middle, control) = if decide_product(sd, sigma2, 0.0) {
        let vector = (0.5 * d2.abs().sqrt()) * sd;
        (
            CircleToSphereMiddle::Diameter { vector },
            SphereMassPoint::vector(vector),
        )
    } else {
        let step = d2 / (2.0 * c);
        let point = sigma1 + step * sd;
        let weight = (c.abs() / d2.abs().sqrt()).copysign(step);
        (
            CircleToSphereMiddle::General { point, weight },
            SphereMassPoint::point(point, weight),
        )
    };
    let curve = constructed([start, control, end])?;
    Ok(CircleToSphere {
        middle,
        end_weight,
        conic,
        centre,
        is_regular,
        curve,
    })
}

/// The canal curve of controls that lie on the space of spheres by their formulas.
fn constructed(control: [SphereMassPoint; 3]) -> Result<CanalCurve, Error> {
    CanalCurve::from_curve(SphereCurve::on_quadric(bezier_mass::Quadratic::new(
        control,
    )?))
}

fn require_orthogonal(sphere: SphereVector, derivative: SphereVector) -> Result<(), Error> {
    let (s, d) = (sphere.vector(), derivative.vector());
    if decide_product(s, d, 0.0) {
        Ok(())
    } else {
        Err(Error::NotOrthogonal {
            product: product_and_terms(s, d).0,
        })
    }
}
