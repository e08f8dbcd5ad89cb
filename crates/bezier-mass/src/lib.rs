//! Rational Bézier and B-spline curves and patches whose control points may be points or vectors.
//!
//! A [`MassPoint`] is a weighted point `(M; w)` with `w != 0`, or a vector `(u; 0)`. Both are homogeneous vectors
//! `[w, wM]` and `[0, u]`, so they form a vector space, and a curve with mass control points is a polynomial curve in
//! it. Zero and negative weights are ordinary values:
//!
//! ```text
//!         (0,1) vector, weight 0          w1 > 0: minor arc         a vector at an end:
//!           ^                             w1 = 0: semicircle        an asymptote, a parabola's axis
//!       .-- | --.                         w1 < 0: major arc
//!      /    |    \                                                  weight zero on the way:
//!     P2 ---+--- P0    weights 1, 0, 1                              the curve passes infinity, and goes on
//! ```
//!
//! ```
//! use bezier_mass::{Conic, MassPoint, Quadratic, glam::dvec2};
//! // The upper half of the unit circle: no weight to tune, no trigonometry.
//! let half = Quadratic::new([
//!     MassPoint::point(dvec2(1.0, 0.0), 1.0),
//!     MassPoint::vector(dvec2(0.0, 1.0)),
//!     MassPoint::point(dvec2(-1.0, 0.0), 1.0),
//! ])?;
//! assert!((half.point(0.3)?.length() - 1.0).abs() < 1e-15);
//! assert!(matches!(half.conic(), Conic::Circle(circle) if circle.radius == 1.0));
//! # Ok::<(), bezier_mass::Error>(())
//! ```
//!
//! # Types
//! | type | is |
//! |---|---|
//! | [`VectorSpace`] | what control points are made of: `f64`, `DVec2`, `DVec3`, `DVec4`, `[f64; N]`, your own |
//! | [`MassPoint`], [`MassPointKind`] | a weighted point or a vector |
//! | [`Quadratic`], [`BezierCurve`], [`CurveJet`] | a curve of degree two by value, of any degree; a value with derivatives |
//! | [`Parameter`], [`Homography`] | a parameter that may be infinite, and the projective changes of it |
//! | [`Half`] | which half of a conic with a centre |
//! | [`Conic`], [`Circle`], [`CentralConic`], [`Parabola`], [`Degenerate`], [`Line`], [`PlaneFrame`] | the features of a conic, in the plane or in space |
//! | [`Biquadratic`], [`BezierPatch`], [`PatchJet`], [`Partials`], [`SurfacePoint`] | tensor-product patches, with derivatives and normals |
//! | [`Knots`], [`BSplineCurve`], [`BSplineSurface`], [`BezierPiece`], [`PatchPiece`] | splines, and the Bézier pieces that they consist of |
//! | [`bernstein`] | Bernstein polynomials on coefficient slices |
//!
//! # Conventions
//! Curves run over `[0, 1]` but every parameter is allowed, infinity included (as [`Parameter`]). Coefficients and
//! control points come lowest index first; row `i` of a net goes with `B_i(u)`, its entries run along `v`. Normals are
//! along `dP/du x dP/dv`. Angles are radians, turns counter-clockwise. Values at infinity are vectors: a position there
//! is an [`Error::AtInfinity`] or `None`, never a huge number, because a weight below the rounding error of its own sum
//! is set to zero.
//!
//! # Features
//! `serde`: all values. `kurbo`: the module `path`, conversion of plane curves to and from paths. `rayon`: `par_grid`
//! for large tessellations. All off by default.
//!
//! # References
//! - L. Garnier, J.-P. Bécar, L. Druoton, *Canal surfaces as Bézier curves using mass points*, CAGD 54, 2017, pages
//!   15-34, Section 2: mass points, Theorems 1 and 2, homographic changes of parameter. Called the mass-point paper here.
//! - J. C. Fiorot, P. Jeannin, *Courbes et surfaces rationnelles*, Masson 1989.
//! - R. T. Farouki, V. T. Rajan, *Algorithms for polynomials in Bernstein form*, CAGD 5, 1988.
//! - C. de Boor, *A Practical Guide to Splines*, Springer 2001.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod arc;
mod biquadratic;
mod bspline_curve;
mod bspline_surface;
mod conic;
mod conic_of_arc;
mod curve;
mod error;
mod grid;
mod homography;
mod jet;
mod knots;
mod mass_point;
mod patch;
mod plane_frame;
mod quadratic;
mod vector_space;

pub mod bernstein;
#[cfg(feature = "kurbo")]
pub mod path;

pub use arc::Half;
pub use biquadratic::Biquadratic;
pub use bspline_curve::{BSplineCurve, BezierPiece};
pub use bspline_surface::{BSplineSurface, PatchPiece};
pub use conic::{CentralConic, Circle, Conic, Degenerate, Line, Parabola};
pub use curve::BezierCurve;
pub use error::Error;
pub use grid::SurfacePoint;
pub use homography::{Homography, Parameter};
pub use jet::{CurveJet, Partials, PatchJet};
pub use knots::Knots;
pub use mass_point::{MassPoint, MassPointKind};
pub use patch::BezierPatch;
pub use plane_frame::PlaneFrame;
pub use quadratic::Quadratic;
pub use vector_space::VectorSpace;

pub use glam; // its types appear in our signatures
