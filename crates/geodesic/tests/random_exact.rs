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

/// A point on a short edge that rounding puts at the edge's end is a source in all directions.
#[cfg(feature = "triangulate")]
#[test]
fn sources_that_coincide_with_a_vertex() {
    use geodesic::SurfacePoint;
    use geodesic::glam::{DVec2, DVec3};
    let mut state = 7u64;
    let mut random = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    // A flat sheet, so that chords are distances, with clusters of points.
    let points: Vec<DVec3> = (0..300)
        .map(|i| {
            let width = if i % 3 == 0 { 1e-5 } else { 1.0 };
            let centre = DVec2::new(f64::from(i % 5) * 0.2, f64::from(i % 7) * 0.14);
            let [x, y] = [(); 2].map(|()| width * random());
            (centre + DVec2::new(x, y)).extend(0.0)
        })
        .collect();
    let mesh = Mesh::terrain(&points, &[]).unwrap();
    let mut sweep = Sweep::new(&mesh);
    for halfedge in [63, 409] {
        let a = SurfacePoint::Edge { halfedge, t: 1e-11 };
        let b = SurfacePoint::Edge {
            halfedge: 959,
            t: 0.5250892478272535,
        };
        let [there, back] = [(a, b), (b, a)].map(|(from, to)| sweep.distance(from, to).unwrap());
        let [from, to] = [a, b].map(|p| mesh.point_position(p).unwrap());
        assert!((there - back).abs() < 10.0 * AGREEMENT * mesh.diameter());
        // The hull of the points is not quite convex.
        assert!(there - from.distance(to) < 2e-3, "{halfedge}: {there}");
    }
}
