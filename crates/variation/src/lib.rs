//! Certified real roots of polynomials in Bernstein form, bounds for their number without solving, and what follows for
//! Bézier curves: hits with lines, rays, segments, planes, circles, implicit curves and other curves.
//!
//! ```text
//!   p1 o                          A polynomial on an interval is drawn as the graph of its
//!     / \          o p3           coefficients p0 .. pn. It cannot cross zero more often than this
//!    /   \_q1   _-' \             polygon does. Cutting corners at a *pole* (here 1/2, points q)
//!   / q0 x \_x-'_    \            gives the polygon p0 q0 .. q(n-1) pn: the polar derivative, and
//! --/------\--_-x-----\------- 0  a bound that is never larger. Where bound and parity leave no
//!  /        \o'  q2    \          choice the roots are counted without solving; elsewhere the
//! o p0       p2         o p4      interval is halved, and every sign on the way is certain.
//! ```
//!
//! ```
//! // 12 t^3 - 18 t^2 + 7 t - 1/2, by its Bernstein coefficients on [0, 1]
//! let roots = variation::roots(&[-0.5, 11.0 / 6.0, -11.0 / 6.0, 0.5])?;
//! for root in &roots {
//!     println!("a root in [{}, {}]", root.lo, root.hi);
//!     assert!(root.width() <= 1e-12);
//! }
//! assert_eq!(roots.len(), 3);
//! # Ok::<(), variation::Error>(())
//! ```
//!
//! # What a root is here
//!
//! A [`Root`] is an enclosure `lo <= root <= hi` with a proven multiplicity. No root is missed and none invented: a sign
//! counts only if it exceeds the bound of its rounding error. What `f64` cannot decide is repeated in 128-bit fixed point
//! (a polynomial derived from a curve is formed exactly first), and what that cannot decide (double roots above all) in
//! integers, where a square-free decomposition gives the multiplicities. Without the feature `exact` the last step is missing and its cases are reported as
//! [`Count::AtMost`]. Coefficients are taken as the exact numbers that they are: a double root of the polynomial that you
//! meant is, once its coefficients are rounded, usually two close roots or none, and that is what is reported.
//!
//! # Where to look
//!
//! | you have | you ask | |
//! |---|---|---|
//! | Bernstein coefficients | roots on an interval | [`roots`], [`roots_on`], [`Solver`] (many, without allocation) |
//! | | how many | [`Solver::count`], [`chain_bound`], [`pole_bound`], [`corollary_bound`] |
//! | | blossom, polar derivative | [`blossom`], [`polar_derivative`], [`polar_derivatives`] |
//! | power coefficients | roots on an interval | [`roots_of_power_form`] |
//! | rational numbers | all of it, exactly | `ExactPolynomial`, `ExactCurve`, and the bounds over `BigRational` |
//! | a plane curve ([`Curve`]) | hits with a [`Line`], ray, segment, circle, [`ImplicitCurve`] | [`Curve::meet_line`] and its neighbours, as [`Hit`]s |
//! | | crossings with a curve, with itself | [`Curve::meet_curve`], [`Curve::self_meetings`], as [`Meeting`]s |
//! | | extrema, inflections | [`Curve::extrema`], [`Curve::inflections`] |
//! | a space curve | hits with a [`Plane`] | [`meet_plane`] |
//! | | how many at most, without solving | [`plane_bound`] |
//! | a solver to test | reproducible hard polynomials, an exact judge | [`sets`], `Verdict`, `SturmChain` |
//!
//! # What the refined bound is good for
//!
//! The refined bound is a corner cutting and costs O(n), but it is *not* a faster way to isolate all roots of a polynomial
//! that has many: nodes that must be split really hold two roots or more. In exact arithmetic, on random coefficients, a
//! reference program (not repeated by the benches here) saw an early exit by poles save a quarter of the subdivision work at
//! degree 5 and 2 per cent at degree 40; on polynomials of known roots nothing. So [`roots`] does not use it. What pays there
//! is the matching *lower* bound, values of alternating sign between the crossings of the polygon.
//!
//! Nor does it make counting faster, as measured. Of the random polynomials that Descartes' count leaves open, one pole
//! decides 26 of 100 at degree 5, 14 at degree 8, 2 at degree 12 and none from degree 20 on; of those without a root 2 at degree
//! 5 and none from degree 12 on. [`Solver::count`] asks it up to degree 8 and takes on the open ones 104 ns instead of the 101 ns
//! of isolating their roots at degree 5, and 349 instead of 352 at degree 8. What a query for the number saves is the
//! refinement: a quarter of the time of [`roots`] at degree 5, a twentieth at degree 20. The use of the refined bound is
//! evidence: a small polygon ([`ChainBound::polygon`]) that proves the number of crossings, for lines that miss above all, in a
//! proof or a figure. Zeros in a polygon must be counted ([`sign_changes`]); leaving them out is unsound for chains.
//!
//! Open in the chapter, and here: the concavity of the control polygon as a further bound, and the poles that make a chain
//! best (a constrained minimum of the blossom); [`PoleStrategy`] offers three heuristics.
//!
//! # Errata of the chapter
//!
//! The printed inequality (4.2) is right with zeros counted as printed. The corollary is true, but not by applying (4.2)
//! repeatedly at an end of the interval as the text says (each `p_0 = 0` would count again): drop the outer term instead. A
//! chain of `n` poles costs O(n^2), like one subdivision. The statement on rational curves needs positive weights.
//!
//! # Conventions
//!
//! Coefficients are listed from the left end. Poles and arguments of blossoms are in the unit parameter
//! ([`Interval::to_unit`]). Tolerances are relative to the interval; the default is [`DEFAULT_TOLERANCE`]. Degrees are
//! unlimited for [`roots`] (above 64 only the exact path works), at most 120 for polynomials derived from curves.
//!
//! # Features
//!
//! - `exact` (default): integer arithmetic decides what `f64` and fixed point cannot; rational input; Sturm's theorem.
//! - `serde`: all value types.
//! - `rayon`: [`roots_of_all`] works on all cores.
//!
//! # References
//!
//! - R. Ait-Haddou, L. Biard, *Variation diminishing property of Bézier curves*, in: L. Biard, habilitation thesis, chapter 4.
//! - E. Laguerre, *Oeuvres*, vol. 1, 1898, pp. 48-49 (polar derivative).
//! - G. E. Collins, A. G. Akritas, *Polynomial real root isolation using Descartes' rule of signs*, SYMSAC 1976.
//! - T. W. Sederberg, T. Nishita, *Curve intersection using Bézier clipping*, CAD 22, 1990.
//! - T. W. Sederberg, R. J. Meyers, *Loop detection in surface patch intersections*, CAGD 5, 1988 (tangent cones).

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod arc;
mod arithmetic;
mod bound;
mod cubic;
mod curve;
#[cfg(feature = "exact")]
mod dyadic;
mod error;
#[cfg(feature = "exact")]
mod exact;
mod fat_line;
mod finite;
mod input;
mod isolate;
#[cfg(feature = "exact")]
mod judge;
mod line;
mod low_degree;
mod meet;
mod polar;
mod power_form;
#[cfg(feature = "exact")]
mod rational;
mod refine;
mod root;
mod rounding;
pub mod sets;
mod sharp;
mod sign_changes;
mod solver;
mod space_curve;
#[cfg(feature = "exact")]
mod square_free;
#[cfg(feature = "exact")]
mod sturm;
mod subdivision;
mod tiers;
mod twofold;

pub use bound::{
    ChainBound, PoleStrategy, SplitBound, UnitParameter, chain_bound, chain_bound_by,
    corollary_bound, pole_bound,
};
pub use curve::{Curve, Hit};
pub use error::Error;
pub use finite::Finite;
pub use glam;
#[cfg(feature = "exact")]
pub use judge::Verdict;
pub use line::{ImplicitCurve, Line, Plane, Term};
pub use meet::Meeting;
#[cfg(feature = "exact")]
pub use num_bigint::BigInt;
#[cfg(feature = "exact")]
pub use num_rational::BigRational;
pub use polar::{Affine, blossom, polar_derivative, polar_derivatives};
pub use power_form::roots_of_power_form;
#[cfg(feature = "exact")]
pub use rational::{ExactCurve, ExactPolynomial, ExactRoot, to_power_form};
pub use root::{Count, Interval, Root, Roots};
pub use sign_changes::{
    Signed, descartes_changes, sign_changes, sign_changes_by_parity, sign_changes_left,
    sign_changes_right,
};
pub use solver::{Solver, roots, roots_of_all, roots_on};
pub use space_curve::{meet_plane, plane_bound};
#[cfg(feature = "exact")]
pub use sturm::SturmChain;
pub use tiers::DEFAULT_TOLERANCE;
