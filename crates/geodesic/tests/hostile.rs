//! Meshes and questions that nobody should have: an error with the numbers, or an answer that is finite and certified,
//! never a panic, never a search without an end.

use geodesic::glam::{DVec2, DVec3, dvec2, dvec3};
use geodesic::{
    Error, LoopFinder, Mesh, PathFinder, Start, Straightest, SurfacePoint, Sweep, TorusSurface,
    closed_torus_geodesic, shapes,
};

const NUMBERS: [f64; 12] = [
    0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    -1e300,
    1e150,
    1e-150,
    f64::MIN_POSITIVE,
    5e-324,
];

/// A cube without its lid, scaled and moved.
fn scaled(size: f64, shift: DVec3) -> Result<Mesh, geodesic::Error> {
    let cube = shapes::cube()?;
    let positions: Vec<DVec3> = cube.positions().iter().map(|p| *p * size + shift).collect();
    Mesh::new(&positions, &cube.faces()[..10])
}

/// All kinds of points, most of them wrong.
fn points() -> Vec<SurfacePoint> {
    let mut points = vec![
        SurfacePoint::Vertex(0),
        SurfacePoint::Vertex(7),
        SurfacePoint::Vertex(8),
        SurfacePoint::Vertex(u32::MAX),
    ];
    for t in NUMBERS {
        points.push(SurfacePoint::Edge { halfedge: 4, t });
        points.push(SurfacePoint::Face {
            face: 3,
            barycentric: [t, 0.5, 0.5 - t],
        });
        points.push(SurfacePoint::Face {
            face: u32::MAX,
            barycentric: [t, t, t],
        });
    }
    points
}

fn ask(mesh: &Mesh, what: &str) {
    let mut finder = PathFinder::new(mesh).with_start(Start::Faces);
    let mut sweep = Sweep::new(mesh);
    for from in points() {
        for to in points() {
            let local = finder.shortest(from, to).map(|path| path.length());
            let exact = sweep.distance(from, to);
            if let (Ok(local), Ok(exact)) = (&local, &exact) {
                let close = *local >= exact * (1.0 - 1e-9) && local.is_finite();
                assert!(
                    close,
                    "{what}: {from:?} to {to:?} is {local}, exact {exact}"
                );
            }
            assert_eq!(local.is_ok(), exact.is_ok(), "{what}: {from:?} to {to:?}");
        }
        for number in NUMBERS {
            for direction in [DVec3::splat(number), dvec3(1.0, number, 0.2)] {
                for face in [0, 3, u32::MAX] {
                    let tracer = Straightest::new(mesh);
                    if let Ok(trace) = tracer.trace(from, face, direction, 2.5 * mesh.diameter()) {
                        assert!(
                            trace.positions.iter().all(|p| p.is_finite()),
                            "{what}: {from:?}"
                        );
                    }
                    let _ = tracer.trace(from, face, DVec3::X, number);
                }
            }
        }
        let _ = LoopFinder::new(mesh).tighten(&[
            from,
            SurfacePoint::Vertex(3),
            SurfacePoint::Vertex(1),
        ]);
        let _ = mesh.polyline_curvature(&[from, SurfacePoint::Vertex(0)]);
        let _ = finder.guided(&[from]).is_ok();
        let _ = finder.along(&[0, 99], from, from).is_ok();
    }
}

#[test]
fn questions_about_a_mesh_of_any_size_are_answered_or_refused() {
    for size in [1.0, 1e-3, 1e6, 1e-60, 1e60] {
        ask(
            &scaled(size, DVec3::ZERO).unwrap(),
            &format!("size {size:e}"),
        );
    }
    // Far from the origin, as maps are.
    ask(&scaled(1.0, DVec3::splat(1e6)).unwrap(), "far away");
}

#[test]
fn meshes_beyond_the_range_of_numbers_are_refused() {
    for size in [1e-160, 1e-300, 5e-324, 1e160, 1e300, f64::MAX] {
        if let Ok(mesh) = scaled(size, DVec3::ZERO) {
            // What is accepted has lengths and angles that are numbers.
            let sound = |values: &[f64]| values.iter().all(|x| x.is_finite() && *x > 0.0);
            assert!(
                sound(mesh.lengths()) && sound(mesh.angles()),
                "size {size:e}"
            );
        }
    }
    // The shift swallows the size: all faces are points.
    assert!(scaled(1e-3, DVec3::splat(1e20)).is_err());
}

#[test]
fn shapes_of_bad_numbers_are_refused() {
    for major in NUMBERS {
        for minor in NUMBERS {
            if let Ok(mesh) = shapes::torus(major, minor, 6, 5) {
                assert!(mesh.positions().iter().all(|p| p.is_finite()));
            }
            // Radii further apart than this only differ in how long the refusal takes.
            if (minor / major).abs() < 1e-12 && (major, minor) != (f64::MAX, 1.0) {
                continue;
            }
            if let Ok(closed) = closed_torus_geodesic(major, minor, 1, 2) {
                assert!(
                    closed.length.is_finite() && closed.clairaut.is_finite(),
                    "{major:e} {minor:e}"
                );
            }
            let surface = TorusSurface { major, minor };
            let start = geodesic::SurfaceRay {
                uv: dvec2(0.1, 0.2),
                direction: dvec2(1.0, 0.5),
            };
            if let Ok(end) = geodesic::trace_smooth(&surface, start, 1.0, 1e-9) {
                assert!(end.uv.is_finite(), "{major:e} {minor:e}");
            }
        }
        let surface = TorusSurface {
            major: 2.0,
            minor: 0.7,
        };
        for uv in [DVec2::splat(major), dvec2(0.0, major)] {
            for (uv, direction) in [(uv, DVec2::X), (DVec2::ZERO, uv)] {
                let start = geodesic::SurfaceRay { uv, direction };
                for (length, tolerance) in [(1.0, 1e-9), (major, 1e-9), (1.0, major)] {
                    // Lengths of 1e150 and tolerances of 1e-150 take the million steps after which a trace gives up.
                    let takes_all_steps = (length.is_finite() && length.abs() > 1e100)
                        || (tolerance > 0.0 && tolerance < 1e-100);
                    if takes_all_steps {
                        continue;
                    }
                    if let Ok(end) = geodesic::trace_smooth(&surface, start, length, tolerance) {
                        assert!(end.uv.is_finite(), "{start:?} {length:e} {tolerance:e}");
                    }
                }
            }
        }
    }
    for counts in [[0, 0], [1, 5], [2, 2], [3, 2]] {
        assert!(shapes::torus(2.0, 0.7, counts[0], counts[1]).is_err());
    }
}

#[cfg(feature = "triangulate")]
#[test]
fn scattered_points_make_a_mesh_or_are_refused() {
    let good: Vec<DVec3> = (0..12)
        .map(|i| dvec3(f64::from(i % 4), f64::from(i / 4), f64::from(i % 3) * 0.2))
        .collect();
    for number in NUMBERS {
        for place in [
            DVec3::splat(number),
            dvec3(number, 1.0, 0.0),
            dvec3(1.5, 1.5, number),
        ] {
            let mut points = good.clone();
            points[5] = place;
            if let Ok(mesh) = Mesh::terrain(&points, &[]) {
                assert!(mesh.positions().iter().all(|p| p.is_finite()));
            }
            let _ = Mesh::terrain(&[place; 5], &[]);
        }
    }
    assert!(Mesh::terrain(&[], &[]).is_err() && Mesh::terrain(&good[..2], &[]).is_err());
    assert!(Mesh::terrain(&good, &[[0, 99]]).is_err());
    assert!(Mesh::terrain(&good[..4], &[]).is_err(), "points on a line");
}

#[cfg(feature = "obj")]
#[test]
fn broken_files_are_refused() {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("broken.obj");
    for text in [
        &b""[..],
        b"f 1 2 3",
        b"v 0 0\nf 1 1 1",
        b"v a b c",
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9",
        b"v 0 0 0\nf 99999999999 1 2",
        b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        &[0xff, 0xfe, 0, 1, 2],
    ] {
        std::fs::write(&file, text).unwrap();
        assert!(Mesh::read_obj(&file).is_err(), "{text:?}");
    }
    assert!(Mesh::read_obj("no such file.obj").is_err());
}

#[test]
fn things_of_different_meshes_are_not_mixed() {
    let (small, big) = (
        shapes::torus(2.0, 0.7, 24, 12).unwrap(),
        shapes::torus(20.0, 7.0, 24, 12).unwrap(),
    );
    let mut finder = PathFinder::new(&small);
    let path = finder.shortest(0.into(), 150.into()).unwrap().clone();
    assert!(Sweep::new(&small).shorten_globally(&path).is_ok());
    for other in [&big, &shapes::cube().unwrap()] {
        assert!(Sweep::new(other).shorten_globally(&path).is_err());
    }
    let mut sweep = Sweep::new(&small);
    let field = sweep.from_points(&[0.into()]).unwrap();
    assert!(field.path_to(150.into(), &mut finder).is_ok());
    assert_eq!(
        field.path_to(150.into(), &mut PathFinder::new(&big)),
        Err(Error::OtherMesh { what: "finder" })
    );
}

/// Vertices without faces may lie anywhere.
#[test]
fn unreferenced_vertices_do_not_count_in_the_size() {
    let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
    let mut positions = torus.positions().to_vec();
    positions.push(DVec3::splat(1e200));
    let with_stray = Mesh::new(&positions, torus.faces()).unwrap();
    assert_eq!(with_stray.diameter(), torus.diameter());
    let meridian: Vec<SurfacePoint> = (0..12).map(|j| SurfacePoint::Vertex(24 * j)).collect();
    let [plain, stray] =
        [&torus, &with_stray].map(|mesh| LoopFinder::new(mesh).tighten(&meridian).unwrap());
    assert_eq!(plain, stray);
}

#[cfg(feature = "closest-point")]
#[test]
fn the_closest_point_does_not_depend_on_unreferenced_vertices() {
    let cube = shapes::cube().unwrap();
    // First in the list, so that all faces are renumbered.
    let mut positions = vec![dvec3(1e200, 1e200, 0.0)];
    positions.extend_from_slice(cube.positions());
    let faces: Vec<[u32; 3]> = cube.faces().iter().map(|f| f.map(|v| v + 1)).collect();
    let mesh = Mesh::new(&positions, &faces).unwrap();
    let closest = geodesic::ClosestPoint::new(&mesh);
    let found = closest.find(dvec3(0.3, 0.6, 5.0)).unwrap();
    assert!(found.position.distance(dvec3(0.3, 0.6, 1.0)) < 1e-15);
}

#[test]
fn sizes_out_of_range_have_a_name() {
    let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
    let scaled = |scale: f64| {
        let positions: Vec<DVec3> = torus.positions().iter().map(|p| *p * scale).collect();
        Mesh::new(&positions, torus.faces())
    };
    for scale in [1e-120, 1e-80, 1e-65, 1e62, 1e80, 1e160] {
        assert!(
            matches!(scaled(scale), Err(Error::MeshSize { .. })),
            "{scale:e}"
        );
    }
    let length = PathFinder::new(&torus)
        .shortest(3.into(), 150.into())
        .unwrap()
        .length();
    for scale in [1e-60, 1e-20, 1e20, 1e60] {
        let mesh = scaled(scale).unwrap();
        let mut finder = PathFinder::new(&mesh);
        let path = finder.shortest(3.into(), 150.into()).unwrap();
        assert!((path.length() / (length * scale) - 1.0).abs() < 1e-12);
        assert!(path.certify(&mesh).unwrap().is_geodesic(), "{scale:e}");
    }
}

#[test]
fn limits_and_tolerances_are_checked() {
    let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
    let mut sweep = Sweep::new(&torus);
    for limit in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        let refused = sweep.within(&[0.into()], limit).map(|_| ());
        assert!(matches!(refused, Err(Error::InvalidLength { .. })));
    }
    assert!(sweep.within(&[0.into()], 0.0).is_ok());
    let mut loops = LoopFinder::new(&torus);
    for tolerance in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
        let refused = loops.through(0.into(), DVec3::Y, 10.0, tolerance);
        assert!(matches!(refused, Err(Error::InvalidTolerance { .. })));
    }
}

#[test]
fn shapes_too_large_are_refused_before_they_take_memory() {
    let max = u32::MAX;
    for mesh in [
        shapes::torus(2.0, 1.0, 1 << 20, 1 << 20),
        shapes::sheet(max, max, |p| p.extend(0.0)),
        shapes::plate(max, 0),
        shapes::plate(1, max),
        shapes::sphere(max),
    ] {
        assert!(matches!(mesh, Err(Error::TooManyFaces { .. })));
    }
    assert!(shapes::sheet(max, 0, |p| p.extend(0.0)).is_err());
    let soup = geodesic::TriangleSoup {
        positions: vec![DVec3::ZERO],
        faces: vec![[0, 0, 1]],
    };
    assert_eq!(
        shapes::subdivide(&soup),
        Err(Error::IndexOutOfRange {
            face: 0,
            vertex: 1,
            vertices: 1
        })
    );
}
