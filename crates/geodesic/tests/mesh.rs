//! The rules of a mesh, each broken on purpose, and the repair of broken soups.

use geodesic::glam::DVec3;
use geodesic::{Error, Mesh, SurfacePoint, TriangleSoup, VertexKind, shapes};

fn points(list: &[[f64; 3]]) -> Vec<DVec3> {
    list.iter().copied().map(DVec3::from).collect()
}

fn five() -> Vec<DVec3> {
    points(&[
        [0., 0., 0.],
        [1., 0., 0.],
        [0., 1., 0.],
        [0., 0., 1.],
        [0., -1., 0.],
    ])
}

#[test]
fn each_rule_has_its_error() {
    let none: [[u32; 3]; 0] = [];
    assert_eq!(Mesh::new(&five(), &none), Err(Error::EmptyMesh));
    let mut broken = five();
    broken[3].y = f64::NAN;
    assert_eq!(
        Mesh::new(&broken, &[[0, 1, 2]]),
        Err(Error::NonFiniteVertex { vertex: 3 })
    );
    let quad = Mesh::new(&five(), &[vec![0, 1, 2], vec![0, 2, 3, 4]]);
    assert_eq!(
        quad,
        Err(Error::NotATriangle {
            face: 1,
            corners: 4
        })
    );
    let range = Mesh::new(&five(), &[[0, 1, 2], [0, 2, 5]]);
    assert_eq!(
        range,
        Err(Error::IndexOutOfRange {
            face: 1,
            vertex: 5,
            vertices: 5
        })
    );
    assert_eq!(
        Mesh::new(&five(), &[[0, 1, 0]]),
        Err(Error::RepeatedVertex { face: 0, vertex: 0 })
    );
    let thin = Mesh::new(
        &points(&[[0., 0., 0.], [1., 0., 0.], [2., 1e-13, 0.]]),
        &[[0, 1, 2]],
    );
    assert!(
        matches!(thin, Err(Error::DegenerateFace { face: 0, .. })),
        "{thin:?}"
    );
    let book = Mesh::new(&five(), &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    assert_eq!(
        book,
        Err(Error::NonManifoldEdge {
            vertices: [0, 1],
            faces: [0, 1, 2],
            count: 3
        })
    );
    let turned = Mesh::new(&five(), &[[0, 1, 2], [0, 1, 4]]);
    assert_eq!(
        turned,
        Err(Error::InconsistentOrientation {
            vertices: [0, 1],
            faces: [0, 1]
        })
    );
    let twice = Mesh::new(&five(), &[[0, 1, 2], [1, 2, 0]]);
    assert_eq!(twice, Err(Error::RepeatedFace { faces: [0, 1] }));
    let bow_tie = Mesh::new(&five(), &[[0, 1, 2], [0, 3, 4]]);
    assert_eq!(
        bow_tie,
        Err(Error::NonManifoldVertex {
            vertex: 0,
            faces: [0, 1]
        })
    );
    assert_eq!(
        Mesh::new_strict(&five(), &[[0, 1, 2]]),
        Err(Error::UnreferencedVertex { vertex: 3 })
    );
    let lenient = Mesh::new(&five(), &[[0, 1, 2]]).unwrap();
    assert_eq!(
        lenient.vertex_point(3),
        Err(Error::UnreferencedVertex { vertex: 3 })
    );
}

#[test]
fn connectivity_of_closed_shapes() {
    let shapes = [
        (shapes::cube().unwrap(), 2),
        (shapes::sphere(2).unwrap(), 2),
        (shapes::torus(2.0, 0.7, 12, 8).unwrap(), 0),
        (shapes::plate(2, 1).unwrap(), -2),
        (shapes::plate(5, 0).unwrap(), -8),
    ];
    for (mesh, euler) in shapes {
        assert_eq!(mesh.euler_characteristic(), euler);
        assert_eq!(mesh.boundary_edge_count(), 0);
        assert_eq!(mesh.components().iter().max(), Some(&0));
        // Gauss-Bonnet: the angle defects sum to 2π times the Euler characteristic.
        let defect: f64 = mesh
            .angles()
            .iter()
            .map(|a| std::f64::consts::TAU - a)
            .sum();
        assert!((defect - std::f64::consts::TAU * euler as f64).abs() < 1e-10);
    }
}

#[test]
fn a_fan_of_many_faces_is_built_in_linear_time() {
    let n = 200_000u32;
    let mut rim: Vec<DVec3> = (0..n)
        .map(|i| DVec3::new(f64::from(i), 1.0 + f64::from(i % 2), 0.0))
        .collect();
    rim.push(DVec3::new(0.0, -1e6, 0.0));
    let faces: Vec<[u32; 3]> = (1..n).map(|i| [n, i, i - 1]).collect();
    let mesh = Mesh::new(&rim, &faces).unwrap();
    assert_eq!(mesh.star(n).count(), n as usize - 1);
    assert_eq!(mesh.vertex_kind(n), VertexKind::Boundary);
}

#[test]
fn points_take_their_simplest_form() {
    let mesh = shapes::cube().unwrap();
    assert_eq!(mesh.edge_point(0, 3, 0.0), Ok(SurfacePoint::Vertex(0)));
    assert_eq!(mesh.edge_point(3, 0, 1e-13), Ok(SurfacePoint::Vertex(3)));
    assert_eq!(
        mesh.edge_point(0, 7, 0.5),
        Err(Error::NotAnEdge { vertices: [0, 7] })
    );
    assert_eq!(
        mesh.edge_point(0, 99, 0.5),
        Err(Error::NoSuchVertex {
            vertex: 99,
            vertices: 8
        })
    );
    assert!(matches!(
        mesh.edge_point(0, 3, f64::NAN),
        Err(Error::OutsideEdge { .. })
    ));
    assert_eq!(
        mesh.face_point(0, [0.0, 1.0, 0.0]),
        Ok(SurfacePoint::Vertex(2))
    );
    assert!(matches!(
        mesh.face_point(0, [0.0, 0.5, 0.5]),
        Ok(SurfacePoint::Edge { t: 0.5, .. })
    ));
    for bad in [
        [1.5, -0.3, -0.2],
        [0.3, 0.3, 0.3],
        [f64::NAN, 0.5, 0.5],
        [f64::INFINITY, 0.0, 0.0],
    ] {
        assert!(matches!(
            mesh.face_point(0, bad),
            Err(Error::OutsideFace { .. })
        ));
    }
    let centre = mesh.edge_point(3, 0, 0.25).unwrap();
    assert_eq!(mesh.point_position(centre), Ok(DVec3::new(0.75, 0.75, 0.0)));
    assert_eq!(mesh.faces_of(centre).count(), 2);
    assert_eq!(mesh.faces_of(SurfacePoint::Vertex(0)).count(), 6);
}

#[test]
fn repair_leaves_a_mesh_alone() {
    let mesh = shapes::torus(2.0, 0.7, 12, 8).unwrap();
    let repaired = TriangleSoup::from(mesh.clone()).repair().unwrap();
    assert!(repaired.report.is_clean());
    assert_eq!(repaired.mesh, mesh);
}

#[test]
fn repair_says_what_it_did() {
    let mut soup = TriangleSoup {
        positions: five(),
        faces: vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]],
    };
    let repaired = soup.repair().unwrap();
    assert_eq!(repaired.report.split_edges, [[0, 1]]);
    assert_eq!(repaired.report.split_vertices, [0, 1]);
    assert_eq!(
        (repaired.mesh.vertex_count(), repaired.mesh.face_count()),
        (9, 3)
    );
    // A bow tie, a doubled face, a needle without area, a wrong index, a vertex that is not a number.
    soup.positions.push(DVec3::NAN);
    soup.positions.push(DVec3::new(1.0, 0.0, 0.0));
    soup.faces = vec![
        [0, 1, 2],
        [0, 3, 4],
        [2, 1, 0],
        [1, 6, 2],
        [0, 1, 9],
        [0, 1, 5],
    ];
    let report = soup.repair().unwrap().report;
    assert_eq!(report.split_vertices, [0]);
    assert_eq!(report.repeated_faces, [2]);
    assert_eq!(report.degenerate_faces, [3]);
    assert_eq!(report.invalid_faces, [4, 5]);
    assert_eq!(report.welded, [[6, 1]]);
    assert_eq!(report.face_origin, [0, 1]);
}

/// A box whose sides have vertices of their own and random orientations, as CAD programs write it.
#[test]
fn repair_welds_and_orients_a_soup() {
    let cube = TriangleSoup::from(shapes::cube().unwrap());
    let mut soup = TriangleSoup::default();
    for (f, face) in cube.faces.iter().enumerate() {
        let base = soup.positions.len() as u32;
        soup.positions
            .extend(face.map(|v| cube.positions[v as usize]));
        soup.faces.push(if f % 3 == 1 {
            [base, base + 2, base + 1]
        } else {
            [base, base + 1, base + 2]
        });
    }
    let Ok(repaired) = soup.repair() else {
        panic!("a box")
    };
    assert_eq!(repaired.mesh.euler_characteristic(), 2);
    assert_eq!(repaired.mesh.boundary_edge_count(), 0);
    assert_eq!(repaired.report.flipped_faces, [1, 4, 7, 10]);
    assert_eq!(repaired.report.welded.len(), 28);
}

/// A Möbius band cannot be oriented: it is cut once across.
#[test]
fn repair_cuts_what_cannot_be_oriented() {
    let n = 12u32;
    let mut soup = TriangleSoup::default();
    for i in 0..n {
        let u = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        for side in [-0.4, 0.4] {
            let rho = 2.0 + side * (u / 2.0).cos();
            soup.positions.push(DVec3::new(
                rho * u.cos(),
                rho * u.sin(),
                side * (u / 2.0).sin(),
            ));
        }
        let (a, b) = (2 * i, 2 * i + 1);
        let (c, d) = if i + 1 < n { (a + 2, b + 2) } else { (1, 0) };
        soup.faces.extend([[a, c, b], [b, c, d]]);
    }
    let repaired = soup.repair().unwrap();
    assert_eq!(repaired.report.split_edges.len(), 1);
    assert_eq!(repaired.mesh.euler_characteristic(), 1);
}

/// Random triples of few points: whatever they are, the result is a mesh.
#[test]
fn repair_makes_a_mesh_of_anything() {
    let mut state = 1u64;
    let mut random = |n: u64| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) % n
    };
    for round in 0..300 {
        let count = 4 + random(12);
        let positions = (0..count)
            .map(|_| DVec3::new(random(9) as f64, random(9) as f64, random(9) as f64))
            .collect();
        let faces = (0..1 + random(40))
            .map(|_| [0; 3].map(|_| random(count + u64::from(round % 5 == 0)) as u32))
            .collect();
        match (TriangleSoup { positions, faces }).repair() {
            Ok(repaired) => assert_eq!(
                repaired.report.face_origin.len(),
                repaired.mesh.face_count()
            ),
            Err(e) => assert_eq!(e, Error::EmptyMesh),
        }
    }
}
