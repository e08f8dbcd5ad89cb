//! Closed geodesics.

use std::f64::consts::PI;

use geodesic::{Error, GeodesicLoop, LoopFinder, Mesh, SurfacePoint, shapes};
use integration_tests::Case;

/// Answers a case, or says that its kind is another's.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    if case.kind() != "torus_mesh_loops" {
        return false;
    }
    if let Err(error) = torus_mesh_loops(case) {
        case.fail(error.to_string());
    }
    true
}

fn torus_mesh_loops(case: &Case<'_>) -> Result<(), Error> {
    let (major, minor) = (case.number("R"), case.number("r"));
    let (around, tube) = (case.number("nu") as u32, case.number("nv") as u32);
    case.require(
        case.input()["vertex_order"].is_string(),
        "the vertex order is not the known one",
    );
    let mesh = shapes::torus(major, minor, around, tube)?;
    let row = |j: u32| {
        (0..around)
            .map(|i| (j * around + i).into())
            .collect::<Vec<SurfacePoint>>()
    };
    // From half-way up the inner side the loop slides down to the equator.
    let equator = LoopFinder::new(&mesh).tighten(&row(tube / 2 - 1))?;
    certified(case, &mesh, &equator, "inner equator");
    case.compare("inner_equator_loop", equator.length());
    let mut vertices = equator.vertices();
    vertices.sort_unstable();
    let row: Vec<u32> = (0..around).map(|i| tube / 2 * around + i).collect();
    case.compare("inner_equator_all_vertices_critical", vertices == row);

    let column: Vec<SurfacePoint> = (0..tube).map(|j| (j * around).into()).collect();
    let meridian = LoopFinder::new(&mesh).tighten(&column)?;
    certified(case, &mesh, &meridian, "meridian");
    case.compare("meridian_loop", meridian.length());
    // Parallel meridians of a strip between two columns are equally long; this one is held at a midpoint.
    let mut middle = column;
    middle[0] = mesh.edge_point(0, 1, 0.5)?;
    let middle = LoopFinder::new(&mesh).held_at_first(&middle)?;
    certified(case, &mesh, &middle, "meridian through midpoints");
    let passed = (0..tube).all(|j| {
        let midpoint = mesh
            .edge_point(j * around, j * around + 1, 0.5)
            .and_then(|p| mesh.point_position(p));
        midpoint.is_ok_and(|m| {
            middle
                .path()
                .positions()
                .iter()
                .any(|p| p.distance(m) < 1e-9)
        })
    });
    let same = (middle.length() - meridian.length()).abs() < 1e-9;
    case.compare("meridian_loop_passes_edge_midpoints", passed && same);

    // The limits of the smooth torus, to which the two loops and the outer row converge.
    case.compare("smooth_inner_equator", 2.0 * PI * (major - minor));
    case.compare("smooth_meridian", 2.0 * PI * minor);
    case.compare("smooth_outer_equator_unstable", 2.0 * PI * (major + minor));
    Ok(())
}

fn certified(case: &Case<'_>, mesh: &Mesh, geodesic: &GeodesicLoop, what: &str) {
    let certificate = geodesic.certify(mesh);
    case.require(
        certificate.as_ref().is_ok_and(|c| c.is_geodesic()),
        &format!("{what}: {certificate:?}"),
    );
}
