//! Straightest geodesics: at edges, vertices and boundaries.

use std::f64::consts::{FRAC_PI_2, PI};

use geodesic::glam::{DVec2, DVec3};
use geodesic::{AtBoundary, Error, Mesh, Stop, Straightest, SurfacePoint, shapes};

/// The rectangle `[0, width] x [0, height]` of unit squares, cut by diagonals.
fn table(width: u32, height: u32) -> Mesh {
    shapes::sheet(width, height, |p| p.extend(0.0)).unwrap()
}

/// The place of a point moving straight, folded into `[0, size]` by mirrors at both ends.
fn folded(x: f64, size: f64) -> f64 {
    let x = x.rem_euclid(2.0 * size);
    if x > size { 2.0 * size - x } else { x }
}

#[test]
fn a_trace_on_a_table_is_a_billiard_ball() {
    let mesh = table(5, 3);
    let tracer = Straightest::new(&mesh).at_boundary(AtBoundary::Reflect);
    let start = mesh.face_point(4, [0.3, 0.5, 0.2]).unwrap();
    let here = mesh.point_position(start).unwrap();
    for k in 0..40 {
        let direction = DVec2::from_angle(0.11 + 0.157 * f64::from(k));
        let length = 60.0;
        let trace = tracer
            .trace(start, 4, direction.extend(0.0), length)
            .unwrap();
        assert_eq!(trace.stop, Stop::Length);
        let straight = here.truncate() + length * direction;
        let expected = DVec3::new(folded(straight.x, 5.0), folded(straight.y, 3.0), 0.0);
        let end = trace.positions[trace.positions.len() - 1];
        assert!(end.distance(expected) < 1e-11, "{k}: {end} {expected}");
        // The polyline is as long as it says, and its faces go along.
        let measured: f64 = trace
            .positions
            .windows(2)
            .map(|p| p[0].distance(p[1]))
            .sum();
        assert!((measured - length).abs() < 1e-10);
        assert_eq!(trace.faces.len() + 1, trace.points.len());
    }
}

#[test]
fn a_trace_stops_at_the_boundary_unless_told_otherwise() {
    let mesh = table(5, 3);
    let tracer = Straightest::new(&mesh);
    let start = mesh.face_point(4, [0.3, 0.5, 0.2]).unwrap();
    let here = mesh.point_position(start).unwrap();
    let trace = tracer
        .trace(start, 4, DVec3::new(1.0, 0.1, 0.0), 60.0)
        .unwrap();
    assert_eq!(trace.stop, Stop::BoundaryEdge);
    let expected = DVec3::new(5.0, here.y + 0.1 * (5.0 - here.x), 0.0);
    assert!(trace.positions.last().unwrap().distance(expected) < 1e-13);
    assert!((trace.length - here.distance(expected)).abs() < 1e-13);
}

/// There is no mirror law at a corner: both policies end there.
#[test]
fn a_trace_ends_at_a_boundary_vertex() {
    let mesh = table(3, 3);
    let start = mesh.face_point(0, [0.25, 0.25, 0.5]).unwrap();
    let towards = DVec3::new(3.0, 3.0, 0.0) - mesh.point_position(start).unwrap();
    for policy in [AtBoundary::Stop, AtBoundary::Reflect] {
        let tracer = Straightest::new(&mesh).at_boundary(policy);
        let trace = tracer.trace(start, 0, towards, 60.0).unwrap();
        assert_eq!(trace.stop, Stop::BoundaryVertex);
        assert_eq!(trace.points.last(), Some(&SurfacePoint::Vertex(15)));
        assert!((trace.length - towards.length()).abs() < 1e-13);
    }
}

/// At an edge that is bent the mirror image is taken in the plane of the face.
#[test]
fn reflection_keeps_the_angle_on_a_curved_sheet() {
    let mesh = shapes::sheet(12, 12, |p| {
        DVec3::new(p.x, p.y, (0.5 * p.x).sin() * (0.4 * p.y).cos())
    })
    .unwrap();
    let tracer = Straightest::new(&mesh).at_boundary(AtBoundary::Reflect);
    let start = mesh.face_point(60, [0.3, 0.4, 0.3]).unwrap();
    let mut reflections = 0;
    for k in 0..12 {
        let direction = DVec2::from_angle(0.2 + 0.5 * f64::from(k)).extend(0.0);
        let trace = tracer.trace(start, 60, direction, 40.0).unwrap();
        for i in 1..trace.points.len() - 1 {
            let SurfacePoint::Edge { halfedge, .. } = trace.points[i] else {
                continue;
            };
            if mesh.twin(halfedge).is_some() {
                continue;
            }
            reflections += 1;
            let corners = mesh.faces()[(halfedge / 3) as usize];
            let [a, b] = [halfedge % 3, (halfedge + 1) % 3]
                .map(|k| mesh.positions()[corners[k as usize] as usize]);
            let [before, after] =
                [i - 1, i].map(|j| (trace.positions[j + 1] - trace.positions[j]).normalize());
            let along = (b - a).normalize();
            assert!((before.dot(along) - after.dot(along)).abs() < 1e-11);
            assert_eq!(trace.faces[i - 1], trace.faces[i]);
            assert!((before + after).cross(along).length() < 1e-10);
        }
    }
    assert!(reflections > 10);
}

/// Through a vertex the trace halves the total angle, wherever it comes from.
#[test]
fn a_trace_halves_the_angle_at_a_vertex() {
    let cube = shapes::cube().unwrap();
    let tracer = Straightest::new(&cube);
    // Along the diagonal of a face into a corner with the total angle 3π/2, and on for 3π/4 on either side.
    let corner = cube.positions()[7];
    for (face, vertices) in cube.faces().iter().enumerate() {
        if !vertices.contains(&7) {
            continue;
        }
        let start = cube.face_point(face as u32, [0.3, 0.4, 0.3]).unwrap();
        let here = cube.point_position(start).unwrap();
        let trace = tracer
            .trace(start, face as u32, corner - here, 1.2)
            .unwrap();
        let passed = trace
            .points
            .iter()
            .position(|p| *p == SurfacePoint::Vertex(7))
            .unwrap();
        let [before, after] = [passed - 1, passed + 1].map(|i| trace.positions[i] - corner);
        // Laid flat, three squares: the angle on one side is the sum of those in between.
        let cosine = before.normalize().dot(after.normalize());
        // Both lie in different squares (or one in the square between): their sides along the shared edges tell.
        assert!(cosine < 0.75_f64.sqrt());
        let onto = |v: DVec3| (0..3).map(|k| v[k].abs() / v.length()).collect::<Vec<_>>();
        let (a, b) = (onto(before), onto(after));
        // The angles to the edges at the corner: those in one face sum to a right angle.
        let to_edge = |c: &[f64], k: usize| c[k].acos();
        let best = (0..3)
            .map(|k| to_edge(&a, k) + to_edge(&b, k))
            .flat_map(|direct| [direct, direct + FRAC_PI_2])
            .map(|angle| (angle - 0.75 * PI).abs())
            .fold(f64::INFINITY, f64::min);
        assert!(best < 1e-9, "{best}");
    }
}

#[test]
fn hostile_traces_are_refused() {
    let cube = shapes::cube().unwrap();
    let tracer = Straightest::new(&cube);
    let start = cube.face_point(0, [0.2, 0.3, 0.5]).unwrap();
    let refused =
        |face, direction, length| tracer.trace(start, face, direction, length).unwrap_err();
    let normal = cube.vertex_normals()[0].normalize();
    assert!(matches!(
        refused(99, DVec3::X, 1.0),
        Error::NoSuchFace { .. }
    ));
    assert!(matches!(
        refused(1, DVec3::X, f64::NAN),
        Error::SequenceMissesPoint { .. } | Error::InvalidLength { .. }
    ));
    for length in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            refused(0, normal, length),
            Error::InvalidLength { .. }
        ));
    }
    assert!(matches!(
        refused(0, DVec3::NAN, 1.0),
        Error::NonFinite { .. }
    ));
    assert!(matches!(
        refused(0, DVec3::ZERO, 1.0),
        Error::NoTangentialPart { .. }
    ));
    let answer = Straightest::new(&cube).with_normals(&[DVec3::Z; 3]);
    assert!(matches!(answer, Err(Error::InvalidNormal { vertex: 3 })));
}

/// Every direction of the tangent plane of a vertex leads into a face, one that may lie along an edge.
#[test]
fn tangent_directions_at_convex_vertices_have_a_face() {
    let meshes = [
        shapes::cube().unwrap(),
        shapes::torus(2.0, 0.7, 24, 12).unwrap(),
        shapes::sphere(2).unwrap(),
    ];
    for mesh in &meshes {
        let tracer = Straightest::new(mesh);
        let normals = mesh.vertex_normals();
        for (v, &normal) in (0..).map(SurfacePoint::Vertex).zip(&normals) {
            let (x, y) = normal.normalize().any_orthonormal_pair();
            for k in 0..100 {
                let direction = DVec2::from_angle(f64::from(k) * 0.0628);
                let direction = direction.x * x + direction.y * y;
                let face = tracer.face_towards(v, direction).unwrap();
                let trace = tracer.trace(v, face, direction, 0.01).unwrap();
                assert_eq!(trace.stop, Stop::Length);
                let way = trace.positions[trace.positions.len() - 1] - trace.positions[0];
                assert!((way.length() - 0.01).abs() < 1e-12);
                assert!(way.dot(direction) > 0.0);
            }
        }
    }
    // Away from all faces, and over the edge of a table, there is nothing.
    let away = Straightest::new(&meshes[0]).face_towards(0.into(), DVec3::NEG_ONE);
    assert_eq!(away, None);
    let table = table(3, 3);
    assert_eq!(
        Straightest::new(&table).face_towards(1.into(), DVec3::NEG_Y),
        None
    );
}

#[test]
fn loops_are_sought_in_every_tangent_direction() {
    let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
    let mut finder = geodesic::LoopFinder::new(&torus);
    // The outer equator, over the edges between two rows of faces.
    let loops = finder.through(0.into(), DVec3::Y, 30.0, 0.5).unwrap();
    assert!(!loops.is_empty());
    assert!(matches!(
        finder.through(0.into(), DVec3::NAN, 30.0, 0.5),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        finder.through(0.into(), DVec3::ZERO, 30.0, 0.5),
        Err(Error::NoTangentialPart { .. })
    ));
    assert!(matches!(
        finder.through(0.into(), DVec3::X, 30.0, 0.5),
        Err(Error::DirectionLeavesSurface { .. })
    ));
}
