//! Exact distances between random points of twenty generated meshes: symmetric, obeying the triangle inequality, met by the
//! traced path, and not above any locally shortest path.

mod meshes;

use geodesic::{Error, Mesh, PathFinder, Sweep};

/// Distances agree to this share of the mesh's size.
const AGREEMENT: f64 = 1e-12;

/// What fails for triples of points on one mesh, in words.
fn failures(name: &str, mesh: &Mesh, random: &mut meshes::Random, triples: usize) -> Vec<String> {
    let (mut there, mut back) = (Sweep::new(mesh), Sweep::new(mesh));
    let mut finder = PathFinder::new(mesh);
    let tolerance = AGREEMENT * mesh.diameter();
    let mut failures = Vec::new();
    for _ in 0..triples {
        let [a, b, c] = [(); 3].map(|()| random.point(mesh));
        let (ab, bc, ca) = match (
            there.distance(a, b),
            there.distance(b, c),
            there.distance(c, a),
        ) {
            (Ok(ab), Ok(bc), Ok(ca)) => (ab, bc, ca),
            (ab, bc, ca) => {
                for error in [ab, bc, ca].into_iter().filter_map(Result::err) {
                    if !matches!(error, Error::NoPath { .. }) {
                        failures.push(format!("{name}: {error}"));
                    }
                }
                continue;
            }
        };
        let mut expect = |holds: bool, what: String| {
            if !holds {
                failures.push(format!("{name}, {a:?}, {b:?}, {c:?}: {what}"));
            }
        };
        expect(
            ab <= bc + ca + tolerance && bc <= ca + ab + tolerance && ca <= ab + bc + tolerance,
            format!("triangle inequality: {ab} {bc} {ca}"),
        );
        match back.distance(b, a) {
            Ok(ba) => expect(
                (ab - ba).abs() <= tolerance,
                format!("{ab} there, {ba} back"),
            ),
            Err(error) => expect(false, error.to_string()),
        }
        match finder.shortest(a, b) {
            Ok(path) => expect(
                path.length() >= ab - tolerance,
                format!("exact {ab}, local {}", path.length()),
            ),
            Err(error) => expect(false, error.to_string()),
        }
        match there.shortest_path(a, b) {
            Ok(path) => {
                expect(
                    (path.length() - ab).abs() <= tolerance,
                    format!("exact {ab}, traced {}", path.length()),
                );
                expect(
                    path.certify(mesh).is_ok_and(|c| c.is_geodesic()),
                    format!("not certified: {:?}", path.certify(mesh)),
                );
            }
            Err(error) => expect(false, error.to_string()),
        }
    }
    failures
}

fn on_every_mesh(triples: usize, seed: u64) {
    let mut random = meshes::Random(seed);
    let failures: Vec<String> = meshes::all()
        .iter()
        .flat_map(|(name, mesh)| failures(name, mesh, &mut random, triples))
        .collect();
    assert!(
        failures.is_empty(),
        "{} failures, the first:\n{}",
        failures.len(),
        failures[..failures.len().min(12)].join("\n")
    );
}

/// Twenty thousand pairs (each triple has three).
#[test]
fn twenty_thousand_exact_distances_are_a_metric_and_met_by_paths() {
    on_every_mesh(334, 6);
}
