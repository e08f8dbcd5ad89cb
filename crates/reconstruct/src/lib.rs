//! Curves from ribbons of orientation sensors, and surfaces whose given boundary curves are geodesics.
//!
//! ```text
//!   sensors        tangents            curve               network            surface
//!   a m a m a  ->  / / - - \ \   ->    .-''-.     ->     --+---+--    ->     .--+--.
//!   (gravity,      (unit vectors       (integral:          |   |            /  /  /  every grid line
//!    field)         on a sphere)        length kept)     --+---+--         '--+--'   is a geodesic
//! ```
//!
//! A ribbon laid on a surface runs along a geodesic: it bends and twists, but does not turn in its own plane. Sensors on
//! it know the direction of the ribbon, not where they are. So a curve is found by interpolating tangents and integrating
//! them; and a surface by filling a net of curves such that every one of them is a geodesic of it. A regular curve is a
//! geodesic exactly where the surface normal is its principal normal, so each boundary brings its tangent planes along,
//! and what is left to choose is how fast the surface leaves the boundary, which energies decide.
//!
//! ```
//! use reconstruct::{AnalyticCurve, Criterion, GeodesicStrip, Rectangle, Surface, boundary_geodesic_curvature};
//! // Four helices on the unit cylinder, between corners given by (angle, height).
//! let corners = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.25, 1.15]];
//! let helix = |a: usize, b: usize| {
//!     GeodesicStrip::new(AnalyticCurve::new(move |t| {
//!         let [angle, height] = [0, 1].map(|k| t * (corners[b][k] - corners[a][k]) + corners[a][k]);
//!         [angle.cos(), angle.sin(), height]
//!     }))
//! };
//! let rectangle = Rectangle::new([helix(0, 1)?, helix(0, 2)?, helix(2, 3)?, helix(1, 3)?])?;
//! let smooth = rectangle.smoothest(Criterion::ThinPlate)?.patch;
//! assert!(boundary_geodesic_curvature(&smooth, 20) < 1e-12);
//! // The patch knows nothing of the cylinder, and finds it.
//! assert!((smooth.point(0.5, 0.5).truncate().length() - 1.0).abs() < 1e-5);
//! # Ok::<(), reconstruct::Error>(())
//! ```
//!
//! # What there is
//!
//! | from | to | types |
//! |---|---|---|
//! | raw readings | unit tangents | [`Sensor`], [`Calibration`], [`WorldFields`], [`RibbonLayout`], [`Tangents`], [`inclinations`] |
//! | angles or tangents | curves with covariance | [`PlanarRibbon`], [`SpatialRibbon`], closed: [`ClosedPlanarRibbon`], [`ClosedSpatialRibbon`] |
//! | frames of readings | positions, without allocating | [`RibbonStream`] |
//! | ribbons that cross | a network that closes | [`RibbonNetwork`], [`Crossing`] |
//! | formulas, Bézier curves, ribbons, samples | curves with exact derivatives | [`Curve`], [`AnalyticCurve`], [`RibbonCurve`], [`SampledCurve`], [`Series`] |
//! | a curve | its tangent planes | [`GeodesicStrip`], [`BezierStrip`], [`FrenetFrame`], [`DarbouxFrame`] |
//! | two and more strips | surfaces, chains of them | [`TwoCurveSurface`], [`StripChain`] |
//! | four strips | a patch | [`check_rectangle`], [`Rectangle`], [`CoonsPatch`], [`Criterion`] |
//! | three strips | a triangular patch | [`check_triangle`], [`Triangle`], [`TrianglePatch`] |
//! | corner data | Bézier boundaries and patches | [`CornerData`], [`degree7_boundaries`], [`rational_quintic_boundaries`], [`CoonsPatch::to_bezier`] |
//! | any of these surfaces | points, curvatures, triangles | [`Surface`], [`Curvatures`], [`tessellate`] |
//!
//! # Conventions
//! Right-handed space, radians, arc lengths and positions in one unit of length. A rectangle's boundaries are
//! `r1(u) = R(u,0)`, `r2(v) = R(0,v)`, `r3(u) = R(u,1)`, `r4(v) = R(1,v)`; a triangle's side `k` runs from vertex `k + 1`
//! to vertex `k + 2`. Normals point along `R_u x R_v`. Ribbons start at the origin. Energies carry no factor 1/2.
//! Torsion is that of `n' = -k e + tau b`.
//!
//! # Limits
//! Open, as in the literature: patches whose boundaries have prescribed lengths, and animated surfaces. A regular
//! boundary is tested; a regular interior is measured ([`CoonsPatch::regularity`]), not promised.
//!
//! # Features
//! `serde` (off by default): `Serialize` and `Deserialize` for the value types. What is read passes the checks of the
//! constructors.
//!
//! # References
//! - N. Sprynski, N. Szafran, B. Lacolle, L. Biard, *Surface reconstruction via geodesic interpolation*, CAD 40, 2008;
//!   gathered with the other methods as Chapter 3 of the "thesis" cited throughout this crate (L. Biard).
//! - R. T. Farouki, N. Szafran, L. Biard, *Existence conditions for Coons patches interpolating geodesic boundary curves*,
//!   CAGD 26, 2009; *Construction of Bézier surface patches with Bézier curves as geodesic boundaries*, CAD 41, 2009;
//!   *Construction and smoothing of triangular Coons patches with geodesic boundary curves*, CAGD 27, 2010.
//! - G. M. Nielson, *nu-quaternion splines for the smooth interpolation of orientations*, IEEE TVCG 10, 2004.
//!
//! # Errata found in the sources
//! - Natural splines cost one order of convergence at the ends: 3, not 4 ([`EndCondition`]).
//! - The binormal flips at inflections; the continuous field is `h = N x e` ([`GeodesicStrip`]).
//! - The angles in the Gauss-Bonnet formula (3.9) are exterior ([`Triangle::total_curvature`]).
//! - Quadratic in component unknowns only; unit vector fields cannot meet the corner values and are scaled
//!   ([`Rectangle::smoothest`]).
//! - `r' x r''` vanishes at an inflection, where the Bézier construction is singular unless the common factor is divided
//!   out ([`BezierStrip`]).
//! - The end torsions of a rational quintic must have the signs that its control points give them ([`quintic_weights`]).
//! - The geodesic curvature of the boundaries cannot see a violation of C2; it is counted on its own
//!   ([`check_rectangle`]).

#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "refusals are written as !(good), so that NaN is refused"
)]

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod bezier_patch;
mod closed_spatial;
mod conditions;
mod coons;
mod corner;
mod curve;
mod degree7;
mod end_field;
mod error;
mod frame;
mod hermite;
mod hermite_arc;
mod integrate;
mod network;
mod planar;
mod plate;
mod quadrature;
mod rational_quintic;
mod ribbon_curve;
mod sampled;
mod sensor;
mod series;
mod smoothing;
mod spatial;
mod sphere;
mod spline;
mod stream;
mod strip;
mod strip_chain;
mod surface;
mod tangent;
#[cfg(test)]
mod testing;
mod triangle;
mod triangle_patch;
mod triangle_plate;
mod two_curves;

pub use bezier_patch::BezierStrip;
pub use closed_spatial::ClosedSpatialRibbon;
pub use conditions::{BoundaryReport, CONDITION_TOLERANCE, Corner, Violation};
pub use coons::{CoonsPatch, Rectangle, Twists, check_rectangle};
pub use corner::{CornerData, Corners};
pub use curve::{AnalyticCurve, Curve, Reversed};
pub use degree7::{Degree7Shape, ThirdDerivative, degree7_boundaries};
pub use end_field::{EndField, ScalarFunction};
pub use error::Error;
pub use frame::{DarbouxFrame, FrenetFrame, GeodesicCheck, crossing_residual};
pub use hermite_arc::{Freedom, HermiteArc, LeastMagnitudes, LocalCriterion};
pub use network::{Crossing, RibbonNetwork};
pub use planar::{ClosedPlanarRibbon, PlanarRibbon};
pub use rational_quintic::{
    EndInvariants, quintic_end_invariants, quintic_weights, rational_quintic_boundaries,
};
pub use ribbon_curve::RibbonCurve;
pub use sampled::SampledCurve;
pub use sensor::{
    Calibration, ReadingFault, Sensor, SensorKind, WorldFields, inclinations,
    inclinations_past_vertical,
};
pub use series::{Series, VectorSeries};
pub use smoothing::{Criterion, Smoothed};
pub use spatial::{SpatialRibbon, TangentMethod};
pub use spline::{CubicSpline, EndCondition};
pub use stream::RibbonStream;
pub use strip::{GeodesicStrip, Strip, StripSample};
pub use strip_chain::StripChain;
pub use surface::{
    Curvatures, Surface, Tessellation, boundary_geodesic_curvature, geodesic_curvature, tessellate,
    tessellate_triangle,
};
pub use tangent::{RibbonLayout, Tangents};
pub use triangle::{Triangle, TriangleTwists, check_triangle};
pub use triangle_patch::TrianglePatch;
pub use triangle_plate::{SmoothedTriangle, barycentric_gradients};
pub use two_curves::TwoCurveSurface;

pub use bezier_mass; // the types of Bézier curves and patches appear in our signatures
pub use glam; // so do its vectors
