//! Plane curves whose offsets are exact, and the space curves and motions that go with them.
//!
//! A curve is described by its tangent lines instead of its points: by the unit normal `N(t)` and the distance `p(t)` of
//! the tangent from the origin. If the normal is rational, so is everything else, and a parallel curve is one addition:
//!
//! ```text
//!              N                     curve    p(t)        = <N(t), C(t)>
//!              ^      offset         offset   p(t) + d
//!       .------|------.
//!     .'   .---|---.   '.            N = w^2/|w|^2   with a complex number w = (1-t) w0 + t w1
//!    /   .'    |    '.   \           p = g/|w|^2     with a real polynomial g:
//!   |   /  C   |  d   \   |              offset by d is  g + d |w|^2
//! ```
//!
//! These are the rational Pythagorean-hodograph (PH) curves. [`PhArc`] is one of them in this complex form; its lowest
//! class, [`TQuartic`] (Tschirnhausen's quartic), has strictly monotone curvature and is the involute of a
//! Tschirnhausen cubic ([`TCubic`]). [`InflectedArc`] runs through such an arc by the root of its parameter, and so through
//! an inflection.
//!
//! ```
//! use ph_curves::{Approximation, CubicPath, approximate, glam::dvec2};
//!
//! // A closed cubic B-spline, approximated with continuous curvature ...
//! let control = [dvec2(0.0, 0.0), dvec2(60.0, -10.0), dvec2(90.0, 40.0), dvec2(40.0, 70.0), dvec2(-20.0, 40.0)];
//! let curve = CubicPath::uniform_bspline(&control, true)?;
//! let spline = approximate(&curve, &Approximation::within(1e-4))?.spline;
//!
//! // ... whose offsets are exact at any distance: outwards, and inwards without loops.
//! let outer = spline.offset(5.0)?;
//! assert!((outer.length() - spline.length() - 5.0 * std::f64::consts::TAU).abs() < 1e-9);
//! let inner = spline.trimmed_offset(-12.0)?;
//! assert!(inner.len() == 1 && inner[0].is_closed());
//! # Ok::<(), ph_curves::Error>(())
//! ```
//!
//! # The types
//!
//! | for | types |
//! |---|---|
//! | lines and their envelopes | [`Line`], [`DualCurve`] (Bézier and Farin lines), [`PottmannForm`], [`Contact`] |
//! | one PH arc | [`PhArc`] of any class, [`InflectedArc`], [`TQuartic`], [`G1Ends`] (between two tangents), [`G2Pair`] (between two [`CurvatureElement`]s) |
//! | polynomial PH curves | [`TCubic`], [`PolynomialPh`], [`Hermite`] quintics, [`PhSpline`], [`ArcLength`], [`FeedInterpolator`] |
//! | curves to approximate | [`PlaneCurve`], [`CubicPath`], [`RationalPath`] |
//! | approximation and offsets | [`approximate`], [`Approximation`], [`ArcSpline`] with [`ArcSpline::trimmed_offset`] |
//! | constant width | [`EvolutePolygon`], [`Rosette`], [`interpolate_constant_width`], [`Cam`] |
//! | Minkowski geometry | [`MinkowskiPlane`], [`Indicatrix`], [`IsoperimetricArc`] |
//! | space | [`SpatialPh`], [`SpatialHermite`], [`RationalFrameQuintic`], [`rotation_minimising_frames`] |
//!
//! # Conventions
//!
//! Plane vectors are complex numbers where that is handy. A line `(u0, u1, u2)` is `u0 + u1 x + u2 y = 0`. The normal is the
//! *right-hand* one of the tangent `i N`: outward on a counter-clockwise convex curve, so positive offsets lie to the right of
//! travel. The radius of curvature `R = p + p''` is signed (positive where the curve bends away from N), a cusp is `R = 0`,
//! an inflection `R` infinite. Parameters run over `[0, 1]`, angles are radians. Tolerances are absolute, in plane units;
//! everything that decides about degeneracy is relative to the data.
//!
//! # Features
//!
//! `serde`: all value types but those that hold a motion or an oval made from others ([`Cam`], [`EvolutePolygon`],
//! [`Antisymmetric`], [`MinkowskiPlane`], [`ConstantMinkowskiWidth`]); what is read goes through the constructors. `kurbo`: [`CubicPath`] from, [`ArcSpline`] to kurbo's paths.
//!
//! # Left open
//!
//! * An arc of class 3 cannot have an inflection: splines of them are G1 there, which is counted and reported.
//! * The error of an approximation is measured at samples, with a factor for the peaks between them. What proves it,
//!   [`Approximated::certify`], takes ten to three hundred times as long, and does not bound the rounding.
//! * Trimming reports crossings, not mere contacts; the offset of a spline at a distance at which two branches just touch is
//!   cut on one side of the contact or not at all.
//! * Existence of a crossing is decided by Newton's iteration to rounding; its uniqueness and the absence of others are
//!   certified by disjoint triangles and tangents.
//! * Surfaces with PH isoparametric curves, RRMF boundaries as lines of curvature, cams optimal at speed.
//!
//! # References
//!
//! * R. Ait-Haddou, L. Biard, and co-authors: the thesis chapter "Pythagorean Hodograph curves and geometric design", whose
//!   theorem and equation numbers are cited; the errata found on the way are noted where the formulas are used.
//! * H. Pottmann, *Rational curves and surfaces with rational offsets*, CAGD 12, 1995.
//! * R. T. Farouki, *Pythagorean-Hodograph Curves*, Springer 2008.
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod approximate;
mod arc_length;
mod arc_spline;
mod assembly;
mod breakpoints;
mod cam;
mod certificate;
mod class3;
mod complex;
mod constant_width;
mod course;
mod cover;
mod crossing;
mod cubic_path;
mod curvature_element;
mod dual;
mod error;
mod fit;
mod inflected;
mod inflected_fit;
mod interpolator;
mod kubota;
#[cfg(feature = "kurbo")]
mod kurbo_path;
mod line;
mod minkowski;
mod ph_arc;
mod ph_spline;
mod piece;
mod plane_curve;
mod polynomial;
mod polynomial_ph;
mod pottmann;
mod quadrature;
mod quintic;
mod rational_path;
mod rosette;
mod sampled;
mod spatial;
mod t_cubic;
mod trim;
mod wide;

pub use approximate::{Approximated, Approximation, Arcs, approximate};
pub use arc_length::ArcLength;
pub use arc_spline::{ArcSpline, Joint};
pub use breakpoints::{Breakpoints, breakpoints};
pub use cam::{Antisymmetric, Cam, HarmonicLift, Lift};
pub use certificate::Enclosure;
pub use class3::{G1Ends, LineElement};
pub use constant_width::{
    EvolutePolygon, SupportJet, antipodal_arc, hermite_arc, interpolate_constant_width,
};
pub use crossing::Crossing;
pub use cubic_path::CubicPath;
pub use curvature_element::{CurvatureElement, EvoluteTriangle, G2Pair, similarity_centre};
pub use dual::DualCurve;
pub use error::Error;
pub use glam; // its types appear in our signatures
pub use inflected::InflectedArc;
pub use interpolator::{FeedInterpolator, FeedPoint, FeedRate};
pub use line::Line;
pub use minkowski::{
    Bumped, ConstantMinkowskiWidth, DualIndicatrix, Ellipse, Indicatrix, IsoperimetricArc,
    MinkowskiFrame, MinkowskiPlane, Support, constant_width_arcs,
};
pub use ph_arc::{Contact, PhArc, TQuartic};
pub use ph_spline::{PhSpline, SplineEnds};
pub use piece::{Piece, PlacedArc, Segment};
pub use plane_curve::{Break, BreakKind, PlaneCurve, Side};
pub use polynomial_ph::PolynomialPh;
pub use pottmann::{PottmannForm, TQuarticCoefficients};
pub use quintic::Hermite;
pub use rational_path::RationalPath;
pub use rosette::{Diameter, Rosette};
pub use spatial::{
    Frame, Quaternion, RationalFrameQuintic, SpatialHermite, SpatialHermiteAngles, SpatialPh,
    euler_rodrigues_tube, rotation_minimising_frames, rotation_minimising_tube,
};
pub use t_cubic::TCubic;
