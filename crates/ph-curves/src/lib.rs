//! Planar curves whose offsets are exact.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod approximate;
mod arc_length;
mod arc_spline;
mod cam;
mod class3;
mod complex;
mod constant_width;
mod curvature_element;
mod dual;
mod error;
mod fit;
mod interpolator;
#[cfg(feature = "kurbo")]
mod kurbo_path;
mod line;
mod minkowski;
mod ph_arc;
mod ph_spline;
mod plane_curve;
mod polynomial_ph;
mod pottmann;
mod quadrature;
mod quintic;
mod rosette;
mod sampled;
mod spatial;
mod t_cubic;
mod trim;

pub use approximate::{Approximated, Approximation, Arcs, Breakpoints, approximate, breakpoints};
pub use arc_length::ArcLength;
pub use arc_spline::{ArcSpline, Joint, Piece, PlacedArc, Segment};
pub use cam::{Antisymmetric, Cam, HarmonicLift, Lift};
pub use class3::{G1Ends, LineElement};
pub use constant_width::{
    EvolutePolygon, SupportJet, antipodal_arc, hermite_arc, interpolate_constant_width,
};
pub use curvature_element::{CurvatureElement, EvoluteTriangle, G2Pair, similarity_centre};
pub use dual::DualCurve;
pub use error::Error;
pub use glam;
pub use interpolator::{FeedInterpolator, FeedPoint, FeedRate};
pub use line::Line;
pub use minkowski::{
    Bumped, ConstantMinkowskiWidth, DualIndicatrix, Ellipse, Indicatrix, IsoperimetricArc,
    MinkowskiFrame, MinkowskiPlane, Support, constant_width_arcs,
};
pub use ph_arc::{Contact, PhArc, TQuartic};
pub use ph_spline::{PhSpline, SplineEnds};
pub use plane_curve::{Break, BreakKind, CubicPath, PlaneCurve, Side};
pub use polynomial_ph::PolynomialPh;
pub use pottmann::{PottmannForm, TQuarticCoefficients};
pub use quintic::Hermite;
pub use rosette::{Diameter, Rosette};
pub use spatial::{
    Frame, Quaternion, RationalFrameQuintic, SpatialHermite, SpatialHermiteAngles, SpatialPh,
    euler_rodrigues_tube, rotation_minimising_frames, rotation_minimising_tube,
};
pub use t_cubic::TCubic;
pub use trim::Crossing;
