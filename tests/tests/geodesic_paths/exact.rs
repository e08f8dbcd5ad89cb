//! Exact distances, smooth surfaces and surfaces of revolution: kinds of cases that are not answered yet.

use geodesic::{Mesh, SurfacePoint, Sweep};
use integration_tests::Case;

/// Kinds that [`answer`] does not know yet.
pub(crate) const PENDING: [&str; 3] = [
    "parametric_geodesic",
    "torus_closed_geodesic",
    "surface_ivp",
];

/// The exact distance, where the file states it.
pub(crate) fn shortest(case: &Case<'_>, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
    case.seen("exact_shortest");
    case.seen("closed_form");
    let mut sweep = Sweep::new(mesh);
    let found = sweep
        .shortest_path(from, to)
        .and_then(|path| Ok((path.length(), sweep.distance(from, to)?)));
    for key in ["exact_shortest", "closed_form"] {
        if !case.expected()[key].is_number() {
            continue;
        }
        match &found {
            Ok((traced, distance)) => {
                case.compare(key, *distance);
                case.compare(key, *traced);
            }
            Err(error) => case.fail(format!("{key}: {error}")),
        }
    }
}

/// Answers a case, or says that its kind is another's.
pub(crate) fn answer(_case: &Case<'_>) -> bool {
    false
}
