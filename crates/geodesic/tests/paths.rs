//! Locally shortest paths: closed forms, and the certificate on many random pairs.

use geodesic::glam::DVec3;
use geodesic::{Error, Mesh, PathFinder, Start, SurfacePoint, shapes};

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

/// The stages end with the answer, and their lengths fall.
#[test]
fn stages_of_shortening() {
    let mesh = shapes::plate(2, 2).unwrap();
    for start in [Start::Vertices, Start::Edges, Start::Faces] {
        let mut finder = PathFinder::new(&mesh).with_start(start);
        let (from, to) = (3.into(), 200.into());
        let stages = finder.stages(from, to).unwrap();
        let path = finder.shortest(from, to).unwrap();
        assert_eq!(stages.last(), Some(path));
        assert!(
            stages
                .windows(2)
                .all(|s| s[1].length() <= s[0].length() * (1.0 + 1e-14))
        );
    }
}

/// On a cone, a guide decides on which side of the apex a path passes; so does a sequence of faces.
#[test]
fn a_guide_chooses_the_class() {
    let rim = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::TAU / 12.0;
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    };
    let mut points: Vec<DVec3> = (0..12).map(rim).collect();
    points.push(DVec3::Z);
    let faces: Vec<[u32; 3]> = (0..12).map(|i| [i, (i + 1) % 12, 12]).collect();
    let cone = Mesh::new(&points, &faces).unwrap();
    let mut finder = PathFinder::new(&cone);
    let near = finder.shortest(0.into(), 5.into()).unwrap().length();
    let far = [7, 8, 9, 10].map(|f| cone.face_point(f, [0.1, 0.1, 0.8]).unwrap());
    let guide: Vec<_> = [5.into()]
        .into_iter()
        .chain(far)
        .chain([0.into()])
        .collect();
    let guided = finder.guided(&guide).unwrap().clone();
    assert!(guided.length() > near && guided.certify(&cone).unwrap().is_geodesic());
    assert!(guided.faces().contains(&8));
    let along = finder
        .with_neighbouring_classes(false)
        .along(&[5, 6, 7, 8, 9, 10, 11], 5.into(), 0.into())
        .unwrap()
        .clone();
    assert!((along.length() - guided.length()).abs() < 1e-14);
}

#[test]
fn hostile_questions_are_refused() {
    let mesh = shapes::cube().unwrap();
    let mut finder = PathFinder::new(&mesh);
    assert_eq!(
        finder.shortest(8.into(), 0.into()),
        Err(Error::NoSuchVertex {
            vertex: 8,
            vertices: 8
        })
    );
    let (a, b) = (0.into(), 7.into());
    assert_eq!(
        finder.along(&[0, 2], a, b),
        Err(Error::BrokenSequence {
            position: 1,
            faces: [0, 2]
        })
    );
    assert_eq!(
        finder.along(&[], a, b),
        Err(Error::BrokenSequence {
            position: 0,
            faces: [0, 0]
        })
    );
    assert_eq!(
        finder.along(&[0, 99], a, b),
        Err(Error::NoSuchFace {
            face: 99,
            faces: 12
        })
    );
    assert_eq!(
        finder.along(&[4], a, b),
        Err(Error::SequenceMissesPoint { point: b })
    );
    assert_eq!(finder.guided(&[a]), Err(Error::ShortLoop { points: 1 }));
    assert_eq!(finder.shortest(a, a).unwrap().length(), 0.0);
    assert_eq!(finder.guided(&[a, a]).unwrap().length(), 0.0);
}

/// Ends within 1e-11 to 1e-7 of a vertex: bends there are lost in rounding, and many updates change nothing else.
#[test]
fn ends_close_to_vertices() {
    let flat = |n| shapes::sheet(n, n, |p| p.extend(0.0)).unwrap();
    let close = |halfedge, t| SurfacePoint::Edge { halfedge, t };
    let (small, large) = (flat(3), flat(8));
    for (mesh, from, to) in [
        (&small, close(49, 0.999999999), close(40, 1e-9)),
        (&large, close(9, 0.999999999), close(225, 0.999999999)),
    ] {
        let mut finder = PathFinder::new(mesh);
        let path = finder.shortest(from, to).unwrap();
        let certificate = path.certify(mesh).unwrap();
        assert!(certificate.is_geodesic(), "{certificate:?}");
    }
    let meshes = [
        small,
        large,
        shapes::cube().unwrap(),
        shapes::torus(2.0, 0.7, 24, 12).unwrap(),
        shapes::plate(1, 1).unwrap(),
    ];
    let mut state = 1u64;
    let mut random = |n: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        ((state >> 33) % n as u64) as u32
    };
    for mesh in &meshes {
        let mut finder = PathFinder::new(mesh);
        for _ in 0..1500 {
            let near = [1e-11, 1e-10, 1e-9, 1e-8, 1e-7][random(5) as usize];
            let ends = [(); 2].map(|()| match random(3) {
                0 => SurfacePoint::Vertex(random(mesh.vertex_count())),
                1 => close(random(mesh.halfedge_count()), near),
                _ => close(random(mesh.halfedge_count()), 1.0 - near),
            });
            let path = finder.shortest(ends[0], ends[1]).unwrap();
            let certificate = path.certify(mesh).unwrap();
            assert!(certificate.is_geodesic(), "{ends:?} {certificate:?}");
        }
    }
}

/// What rounding explains at an end close to a vertex is no excuse for a bend further on.
#[test]
fn bends_far_from_the_ends_are_not_excused() {
    let sheet = shapes::sheet(8, 8, |p| p.extend(0.0)).unwrap();
    let mut finder = PathFinder::new(&sheet);
    // Up the first column and along the second row, from a point 1e-10 beside vertex 0.
    let from = sheet.edge_point(0, 9, 1e-10).unwrap();
    let mut faces: Vec<u32> = vec![1, 16, 17, 32];
    faces.extend((1..8).flat_map(|i| [32 + 2 * i + 1, 32 + 2 * i]));
    let to = sheet.edge_point(26, 35, 0.3).unwrap();
    let bent = finder.taut(&faces, from, to).unwrap();
    assert!(!bent.pivots().is_empty());
    assert!(!bent.certify(&sheet).unwrap().is_geodesic());
}
