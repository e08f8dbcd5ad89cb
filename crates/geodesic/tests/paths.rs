//! Locally shortest paths: closed forms, and the certificate on many random pairs.

use geodesic::glam::DVec3;
use geodesic::{Error, Mesh, PathFinder, Start, shapes};

#[test]
fn closed_forms() {
    let cube = shapes::cube().unwrap();
    for start in [Start::Vertices, Start::Edges, Start::Faces] {
        let mut finder = PathFinder::new(&cube).with_start(start);
        let ends = [0, 7].map(|v| cube.vertex_point(v).unwrap());
        let path = finder.shortest(ends[0], ends[1]).unwrap();
        assert!(
            (path.length() - 5f64.sqrt()).abs() < 1e-14,
            "{start:?} {path:?}"
        );
        assert!(path.certify(&cube).unwrap().is_geodesic());
        let centres = [
            cube.edge_point(0, 3, 0.5).unwrap(),
            cube.edge_point(4, 7, 0.5).unwrap(),
        ];
        let path = finder.shortest(centres[0], centres[1]).unwrap();
        assert!((path.length() - 2.0).abs() < 1e-14, "{start:?} {path:?}");
    }
}

#[test]
fn different_components_have_no_path() {
    let corners: Vec<DVec3> = (0..6)
        .map(|i| DVec3::new(f64::from(i), f64::from(i * i), 0.0))
        .collect();
    let mesh = Mesh::new(&corners, &[[0, 1, 2], [3, 4, 5]]).unwrap();
    for start in [Start::Vertices, Start::Edges, Start::Faces] {
        let mut finder = PathFinder::new(&mesh).with_start(start);
        let answer = finder.shortest(0.into(), 4.into());
        assert_eq!(
            answer,
            Err(Error::NoPath {
                from: 0.into(),
                to: 4.into()
            })
        );
    }
}

#[test]
fn random_pairs_are_certified() {
    let mut state = 7u64;
    let mut random = |n: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 33) as usize % n) as u32
    };
    let meshes = [
        shapes::sphere(3).unwrap(),
        shapes::torus(2.0, 0.7, 24, 12).unwrap(),
        shapes::plate(2, 2).unwrap(),
        shapes::sheet(20, 20, |p| p.extend((3.0 * p.x).sin() * (2.0 * p.y).cos())).unwrap(),
    ];
    for mesh in &meshes {
        for start in [Start::Vertices, Start::Edges, Start::Faces] {
            let mut finder = PathFinder::new(mesh).with_start(start);
            for _ in 0..200 {
                let (a, b) = (random(mesh.vertex_count()), random(mesh.vertex_count()));
                let path = finder.shortest(a.into(), b.into()).unwrap();
                let certificate = path.certify(mesh).unwrap();
                assert!(
                    certificate.is_geodesic(),
                    "{start:?} {a} {b} {certificate:?} {:?}",
                    path.pivots()
                );
                assert!(
                    (certificate.length - path.length()).abs() < 1e-12 * path.length().max(1.0)
                );
            }
        }
    }
}
