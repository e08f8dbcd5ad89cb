//! Twenty thousand random pairs: no panic, no endless loop, every path certified.

mod meshes;

use geodesic::{Error, PathFinder, Start};

const PAIRS_PER_MESH: usize = 1000;

#[test]
fn twenty_thousand_random_pairs_are_certified() {
    let list = meshes::all();
    assert_eq!(list.len(), 20);
    let mut random = meshes::Random(11);
    let (mut answered, mut separate) = (0, 0);
    let mut failures = Vec::new();
    for (name, mesh) in &list {
        for start in [Start::Vertices, Start::Edges, Start::Faces] {
            let mut finder = PathFinder::new(mesh).with_start(start);
            let share = if start == Start::Vertices {
                PAIRS_PER_MESH * 8 / 10
            } else {
                PAIRS_PER_MESH / 10
            };
            for _ in 0..share {
                let (from, to) = (random.point(mesh), random.point(mesh));
                match finder.shortest(from, to) {
                    Ok(path) => {
                        let certificate = path.certify(mesh).unwrap();
                        let chord = mesh
                            .point_position(from)
                            .unwrap()
                            .distance(mesh.point_position(to).unwrap());
                        let closed =
                            (certificate.length - path.length()).abs() <= 1e-10 * path.length();
                        if !(certificate.is_geodesic()
                            && closed
                            && path.length() >= chord * (1.0 - 1e-12))
                        {
                            failures.push(format!(
                                "{name} {start:?} {from:?} {to:?}: {certificate:?} {:?}",
                                path.pivots()
                            ));
                        }
                        answered += 1;
                    }
                    Err(Error::NoPath { .. }) => separate += 1,
                    Err(error) => {
                        failures.push(format!("{name} {start:?} {from:?} {to:?}: {error}"))
                    }
                }
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} failures, the first:\n{}",
        failures.len(),
        failures[..failures.len().min(12)].join("\n")
    );
    assert_eq!(answered + separate, 20 * PAIRS_PER_MESH);
    assert!(separate < 300, "{separate} pairs in different components");
}
