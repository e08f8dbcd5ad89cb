//! Oriented spheres, planes and points as vectors of the Lorentz space L(4,1), and canal surfaces as curves there.
//!
//! An oriented sphere becomes a vector of square one, a point a vector of square zero, and their product says how they
//! lie: 0 at a right angle, 1 in contact, a cosine where they meet. A curve of such vectors is a family of spheres, and
//! its envelope a canal surface. Where the curve is a rational quadratic Bézier curve with mass control points, the
//! surface is a piece of a Dupin cyclide, a torus, a cone or a cylinder, exactly.
//!
//! ```text
//!            e_inf                 on the space of spheres             in space
//!     light    |
//!     cone \   |   / x.x = 0       sigma1 (1) ------- P1 (w1)          circle of sigma1 and
//!  points   \  |  /                     \              |               its derivative sphere
//!  P + ...   \ | /  x.x = 1               ' . _        |                  ___------___
//!  ___________\|/___ spheres  ---->             ' - .  |        ---->    (  )        (  )
//!             /|\                                     'sigma2 (1)         |            |
//!            / | \                  a quadratic Bézier curve,           a piece of a cyclide from
//!           /  |  \                 a circle of this geometry           a circle to a sphere
//! ```
//!
//! ```
//! use lorentz::{Course, Plane, Sphere, TubeGrid, construct, glam::{DVec3, dvec3}};
//!
//! // A surface that leaves the equator of the unit sphere upward and ends in another sphere (Section 4.1.3) ...
//! let start = Sphere::new(DVec3::ZERO, 1.0)?;
//! let equator = Plane::new(DVec3::Z, DVec3::ZERO)?;
//! let end = Sphere::new(dvec3(0.5, 0.0, 3.0), 1.5)?;
//! let first = construct::circle_to_sphere(start.into(), equator.into(), end.into())?.curve;
//!
//! // ... and goes on from its last circle to a third sphere, with a common tangent plane.
//! let last = first.at(1.0);
//! let (sphere, derivative) = (last.sphere().unwrap(), last.derivative_sphere().unwrap());
//! let third = Sphere::new(dvec3(3.0, 0.0, 6.0), 0.7)?;
//! let second = construct::circle_to_sphere(sphere, derivative, third.into())?.curve;
//! let joint = first.joint_with(&second)?;
//! assert_eq!(joint.course, Course::Continues);
//! assert!(joint.angle < 1e-12);
//!
//! let tube = second.tessellate(&TubeGrid::new(100, 48))?; // positions, unit normals, triangles
//! assert_eq!(tube.positions().len(), 101 * 48);
//! # Ok::<(), lorentz::Error>(())
//! ```
//!
//! # The types
//!
//! | | |
//! |---|---|
//! | [`LorentzVector`] | a vector of L(4,1) with the product; [`recover`](LorentzVector::recover) finds the [`Object`] it stands for |
//! | [`Point`], [`Sphere`], [`Plane`] | what lives in space, checked; infinity is a point |
//! | [`SphereVector`] | a sphere or a plane on the space of spheres: products, relations, normals |
//! | [`Cycle`] | centre and signed radius in R^{3,1} |
//! | [`Pencil`], [`CharacteristicCircle`] | linear families, and the circle of two orthogonal spheres |
//! | [`LorentzMap`] | inversions, similarities, their products and inverses |
//! | [`SphereCurve`] | a conic on the space of spheres, with or without an envelope; its [`Classification`] |
//! | [`CanalCurve`] | its envelope: circles, points, normals, [`Tube`]s of vertices |
//! | [`construct`] | curves from points, circles and spheres (Algorithms 1 and 2, Section 4.1.3) |
//! | [`Joint`], [`CanalChain`] | G1 joints measured, chains of surfaces |
//! | [`SecondFamily`], [`ContactPatch`], [`ImplicitCyclide`] | the other family of a cyclide, its biquadratic patch, its equation |
//! | [`dandelin`] | plane sections of a cone |
//!
//! # Conventions
//! - Coordinates are `[xo, x1, x2, x3, xinf]` in the null basis, with `e_o . e_inf = -1`.
//! - A positive radius means that the normal points outward, `n = (x - C)/rho`. For every sphere or plane
//!   `n(x) = xo x - v`; for a plane this is *minus* its normal (see [`Plane`]).
//! - Curves run over `[0, 1]`; derivative spheres and axes follow increasing `t`. Angles are radians.
//! - Tolerances are relative: products of unit vectors are cosines and are compared with 1e-10, coordinates with 1e-12
//!   of the largest. Coordinates along `e_inf` grow with the square of the distance from the origin: a model of size 1
//!   that stands 10^5 units away has lost ten digits there, so move it near the origin first.
//!
//! # Where the paper is corrected
//! - The sign of the middle weight in Algorithm 1 is not free if the surface shall contain the given sphere, and two
//!   points inside the sphere are as good as two outside.
//! - Formula (30) of Algorithm 2 has a real solution for points outside only; for points inside, the last control
//!   vector is reversed. Lemma 1 has no centre if the point lies on the derivative sphere: a parabola.
//! - Formulas (38) and (39) fail on a parabola; (40) is imaginary for nested spheres with the same orientation, where the last
//!   weight is -1. The closed form `P1 = sigma1 + d^2/(2c) sigma1'` has neither fault.
//! - Formulas (41), (42) for the derivative spheres hold for positive end weights and `w1 > 0` only.
//! - Spheres with `|product| = 1` may also be equal (Theorem 4), and may touch at infinity.
//! - The space of mass points pairs vectors with the number 0 (the definition prints a zero vector); a sphere that grows to
//!   a plane tends to *minus* the printed plane vector; the arc of Theorem 2 is another arc of the same hyperbola.
//!
//! # Features
//! - `serde`: serialisation of all value types, checked on the way in.
//! - `rayon`: `CanalCurve::tessellate_parallel`, a grid filled by all cores.
//!
//! # What is left open
//! G2 joints, and the pairing of points on the skeleton of a canal surface. The crate has one kind of curve, the conics:
//! curves of spheres of higher degree are not there.
//!
//! # References
//! - "The mass-point paper" in these pages is the one on rational quadratic Bézier curves with control mass points in the
//!   Minkowski-Lorentz space whose example is a seahorse; numbers of sections, formulas and algorithms are its own.
//! - L. Dorst, D. Fontijne, S. Mann, *Geometric Algebra for Computer Science*, 2007.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod canal;
mod chain;
mod circle;
mod conic_pair;
pub mod construct;
pub mod dandelin;
mod error;
mod joint;
mod object;
mod pencil;
mod plane;
mod point;
mod relation;
mod roots;
mod sphere;
mod sphere_curve;
mod sphere_vector;
mod tessellation;
mod tolerance;
mod transform;
mod vector;

pub use bezier_mass; // its mass points, parameters and quadratics appear in our signatures
pub use canal::{CanalCurve, CanalMember, SurfacePoint};
pub use chain::CanalChain;
pub use circle::{CharacteristicCircle, Circle, Line};
pub use conic_pair::{
    Classification, ContactPatch, CyclideKind, ImplicitCyclide, Invariants, OwnParameter,
    SecondFamily,
};
pub use construct::ConicType;
pub use error::Error;
pub use glam; // its types appear in our signatures
pub use joint::{Course, Joint};
pub use object::Object;
pub use pencil::{Pencil, PencilKind};
pub use plane::Plane;
pub use point::Point;
pub use relation::{PointPosition, Relation, Side, SpherePosition};
pub use sphere::{Cycle, Sphere};
pub use sphere_curve::{SphereCurve, SphereMassPoint, lie_product};
pub use sphere_vector::SphereVector;
pub use tessellation::{Spacing, Tube, TubeGrid};
pub use transform::LorentzMap;
pub use vector::{CausalType, LorentzVector};
