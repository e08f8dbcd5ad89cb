//! Rational Bézier and B-spline curves and patches whose control points may be points or vectors

mod arc;
mod biquadratic;
mod bspline_curve;
mod bspline_surface;
mod conic;
mod curve;
mod error;
mod grid;
mod homography;
mod jet;
mod knots;
mod mass_point;
mod patch;
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
pub use quadratic::Quadratic;
pub use vector_space::VectorSpace;

pub use glam; // its types appear in our signatures
