//! Certified real roots of Bernstein polynomials, refined variation-diminishing bounds, and curve intersections

mod error;
#[cfg(feature = "exact")]
mod exact;
mod isolate;
mod refine;
mod root;
mod rounding;
pub mod sets;
mod solver;

pub use error::Error;
pub use root::{Count, Interval, Root, Roots};
pub use solver::{DEFAULT_TOLERANCE, Solver, roots, roots_on};
