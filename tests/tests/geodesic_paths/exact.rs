//! Exact distances, smooth surfaces and surfaces of revolution: kinds of cases that are not answered yet.

use geodesic::{Mesh, SurfacePoint};
use integration_tests::Case;

/// Kinds that [`answer`] does not know yet.
pub(crate) const PENDING: [&str; 3] = [
    "parametric_geodesic",
    "torus_closed_geodesic",
    "surface_ivp",
];

/// The exact distance, where the file states it.
pub(crate) fn shortest(case: &Case<'_>, _mesh: &Mesh, _from: SurfacePoint, _to: SurfacePoint) {
    case.seen("exact_shortest");
    case.seen("closed_form");
}

/// Answers a case, or says that its kind is another's.
pub(crate) fn answer(_case: &Case<'_>) -> bool {
    false
}
