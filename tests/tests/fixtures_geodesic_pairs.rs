//! Paths between vertices of real meshes (`geodesic-pairs.json`), when `MESH_DIR` names the folder that holds them.

use geodesic::{Mesh, PathFinder, Start};
use integration_tests::{Case, Tolerance, judge, list_at, mesh_folder, read};
use serde_json::json;

#[path = "geodesic_paths/pairs.rs"]
mod pairs;

#[test]
fn fixtures_geodesic_pairs() {
    let file = read("geodesic-pairs");
    let Some(folder) = mesh_folder() else {
        println!("fixtures_geodesic_pairs: MESH_DIR is not set, the real meshes are not looked at");
        return;
    };
    let meshes = list_at(&file, "meshes");
    let cases = meshes.iter().map(|entry| {
        let name = entry["file"].as_str().expect("a file name");
        Case::new(name, "pairs", entry).expecting(entry, Tolerance::ComponentwiseMax(1e-9))
    });
    judge("geodesic pairs", cases, |case| {
        for described in ["file", "sha256", "about"] {
            case.seen(described);
        }
        let mesh = match Mesh::read_obj(folder.join(case.name())) {
            Ok(mesh) => mesh,
            Err(error) => return case.fail(error.to_string()),
        };
        case.compare("vertices", mesh.vertex_count());
        case.compare("triangles", mesh.face_count());
        local(case, &mesh);
        pairs::exact(case, &mesh);
    });
}

/// Locally shortest paths: certified, never below the exact length, at most the edge path when they start from it, and
/// on average no longer than those of the reference.
fn local(case: &Case<'_>, mesh: &Mesh) {
    case.seen("pairs");
    let listed = case.expected()["pairs"]
        .as_array()
        .expect("a list of pairs");
    for start in [Start::Vertices, Start::Edges] {
        let mut finder = PathFinder::new(mesh).with_start(start);
        let (mut ours, mut theirs) = (0.0, 0.0);
        for pair in listed {
            let number = |key: &str| pair[key].as_f64().expect("a number");
            let ends = ["source", "target"]
                .map(|key| mesh.vertex_point(number(key) as u32).expect("a vertex"));
            let path = finder.shortest(ends[0], ends[1]).expect("a path");
            let what = format!("{start:?} {} to {}", pair["source"], pair["target"]);
            let certificate = path.certify(mesh).expect("a path on this mesh");
            case.require(
                certificate.is_geodesic(),
                &format!("{what}: {certificate:?}"),
            );
            let (length, exact) = (path.length(), number("exact"));
            case.require(
                length >= exact * (1.0 - 1e-12),
                &format!("{what}: {length} below {exact}"),
            );
            case.require(
                length <= number("edge_path") * (1.0 + 1e-12),
                &format!("{what}: {length} above the edges"),
            );
            ours += length / exact;
            theirs += number("flipout") / exact;
        }
        if start == Start::default() {
            let means = json!([ours, theirs]);
            case.require(
                ours <= theirs * (1.0 + 1e-12),
                &format!("mean ratio to exact above the reference: {means}"),
            );
        }
    }
}
