//! Certified real roots of Bernstein polynomials, refined variation-diminishing bounds, and curve intersections

mod arithmetic;
mod bound;
mod curve;
mod error;
#[cfg(feature = "exact")]
mod exact;
mod isolate;
mod line;
mod low_degree;
mod meet;
mod polar;
#[cfg(feature = "exact")]
mod rational;
mod refine;
mod root;
mod rounding;
pub mod sets;
mod sharp;
mod sign_changes;
mod solver;
#[cfg(feature = "exact")]
mod sturm;
mod subdivision;

pub use bound::{
    ChainBound, PoleStrategy, SplitBound, UnitParameter, chain_bound, chain_bound_by,
    corollary_bound, pole_bound,
};
pub use curve::{Curve, Hit, meet_plane, roots_of_power_form};
pub use error::Error;
pub use glam;
pub use line::{ImplicitCurve, Line, Plane, Term};
pub use meet::Meeting;
#[cfg(feature = "exact")]
pub use num_bigint::BigInt;
#[cfg(feature = "exact")]
pub use num_rational::BigRational;
pub use polar::{Affine, blossom, polar_derivative, polar_derivatives};
#[cfg(feature = "exact")]
pub use rational::{ExactCurve, ExactPolynomial, ExactRoot, to_power_form};
pub use root::{Count, Interval, Root, Roots};
pub use sign_changes::{
    Signed, descartes_changes, sign_changes, sign_changes_by_parity, sign_changes_left,
    sign_changes_right,
};
pub use solver::{DEFAULT_TOLERANCE, Solver, roots, roots_on};
#[cfg(feature = "exact")]
pub use sturm::{SturmChain, Verdict};
