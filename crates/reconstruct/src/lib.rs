//! Curves from ribbons of orientation sensors, and surfaces whose given boundary curves are geodesics

mod conditions;
mod curve;
mod error;
mod integrate;
mod planar;
mod quadrature;
mod sensor;
mod series;
mod spatial;
mod sphere;
mod spline;
mod stream;
mod tangent;
#[cfg(test)]
mod testing;

pub use curve::{AnalyticCurve, Curve, Reversed};
pub use error::Error;
pub use planar::{ClosedPlanarRibbon, PlanarRibbon};
pub use sensor::{Calibration, ReadingFault, Sensor, SensorKind, WorldFields, inclinations, inclinations_past_vertical};
pub use series::{Series, VectorSeries};
pub use spatial::{ClosedSpatialRibbon, RibbonCurve, SpatialRibbon, TangentMethod};
pub use spline::{CubicSpline, EndCondition};
pub use stream::RibbonStream;
pub use tangent::{RibbonLayout, Tangents};
mod coons;
mod frame;
mod hermite;
mod smoothing;
mod strip;
mod surface;
pub use coons::{CoonsPatch, Rectangle, Twists, check_rectangle};
pub use conditions::{BoundaryReport, CONDITION_TOLERANCE, Corner, Violation};
pub use frame::{DarbouxFrame, FrenetFrame, GeodesicCheck, crossing_residual};
pub use smoothing::{Criterion, Smoothed};
pub use strip::{GeodesicStrip, Strip, StripSample};
pub use surface::{Curvatures, Surface, Tessellation, boundary_geodesic_curvature, geodesic_curvature, tessellate, tessellate_triangle};
mod bezier_patch;
mod boundary;
pub use bezier_patch::BezierStrip;
pub use boundary::{CornerData, Corners, Degree7Shape, EndInvariants, ThirdDerivative, degree7_boundaries, quintic_end_invariants, quintic_weights, rational_quintic_boundaries};
mod triangle;
mod two_curves;
pub use triangle::{SmoothedTriangle, Triangle, TrianglePatch, TriangleTwists, barycentric_gradients, check_triangle};
pub use two_curves::{EndField, Freedom, HermiteArc, LeastMagnitudes, LocalCriterion, ScalarFunction, StripChain, TwoCurveSurface};
