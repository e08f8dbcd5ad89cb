//! Closed geodesics.

use std::f64::consts::PI;

use geodesic::glam::DVec3;
use geodesic::{Error, LoopFinder, Mesh, SurfacePoint, TorusClasses, shapes};

const MAJOR: f64 = 2.0;
const MINOR: f64 = 0.7;

fn row(around: u32, j: u32) -> Vec<SurfacePoint> {
    (0..around).map(|i| (j * around + i).into()).collect()
}

fn column(around: u32, tube: u32, i: u32) -> Vec<SurfacePoint> {
    (0..tube).map(|j| (j * around + i).into()).collect()
}

fn inner_equator(around: u32) -> f64 {
    f64::from(around) * 2.0 * (MAJOR - MINOR) * (PI / f64::from(around)).sin()
}

/// The closed polygon through the midpoints of the edges along the parallels.
fn meridian(around: u32, tube: u32) -> f64 {
    let midpoint = |j: u32| {
        let v = 2.0 * PI * f64::from(j) / f64::from(tube);
        let rho = MAJOR + MINOR * v.cos();
        DVec3::new(rho * (PI / f64::from(around)).cos(), 0.0, MINOR * v.sin())
    };
    (0..tube)
        .map(|j| midpoint(j).distance(midpoint(j + 1)))
        .sum()
}

fn check(mesh: &Mesh, points: &[SurfacePoint], length: f64) {
    let tight = LoopFinder::new(mesh).tighten(points).unwrap();
    assert!(
        (tight.length() - length).abs() < 1e-10,
        "{} instead of {length}",
        tight.length()
    );
    let certificate = tight.certify(mesh).unwrap();
    assert!(certificate.is_geodesic(), "{certificate:?}");
}

#[test]
fn loops_of_a_torus() {
    for (around, tube) in [(12, 8), (24, 12), (30, 14)] {
        let mesh = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
        for j in 1..tube {
            check(&mesh, &row(around, j), inner_equator(around));
        }
        for i in 0..around {
            check(&mesh, &column(around, tube, i), meridian(around, tube));
        }
    }
}

#[test]
fn a_contractible_loop_is_null() {
    let torus = shapes::torus(MAJOR, MINOR, 12, 8).unwrap();
    let sphere = shapes::sphere(2).unwrap();
    for (mesh, points) in [
        (&torus, vec![1.into(), 2.into(), 14.into(), 13.into()]),
        (&torus, vec![0.into(), 3.into(), 40.into()]),
        (&sphere, vec![0.into(), 5.into(), 30.into(), 77.into()]),
        (&sphere, vec![0.into(), 1.into()]),
    ] {
        let answer = LoopFinder::new(mesh).tighten(&points);
        assert!(matches!(answer, Err(Error::NullLoop { .. })), "{answer:?}");
    }
    let answer = LoopFinder::new(&sphere).tighten(&[3.into()]);
    assert_eq!(answer, Err(Error::ShortLoop { points: 1 }));
    let answer = LoopFinder::new(&sphere).tighten(&[3.into(), 3.into()]);
    assert_eq!(answer, Err(Error::ShortLoop { points: 2 }));
}

/// Loops of the meridian class through vertices: on the outer equator they have a corner, on the inner one none.
#[test]
fn a_loop_held_at_a_point() {
    let (around, tube) = (24, 12);
    let mesh = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
    let mut round = column(around, tube, 3);
    let held = LoopFinder::new(&mesh).held_at_first(&round).unwrap();
    assert_eq!(held.path().points()[0], round[0]);
    assert!(held.length() > meridian(around, tube) && held.turn() > 1e-3);
    // A meridian through the midpoint of an edge passes the midpoints of all.
    round[0] = mesh.edge_point(3, 4, 0.5).unwrap();
    let held = LoopFinder::new(&mesh).held_at_first(&round).unwrap();
    assert!((held.length() - meridian(around, tube)).abs() < 1e-12);
    assert!(held.turn() < 1e-9 && held.certify(&mesh).unwrap().is_geodesic());
}

#[test]
fn loops_through_a_point_in_a_direction() {
    let (around, tube) = (24, 12);
    let torus = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
    let start = torus
        .edge_point(tube / 2 * around, tube / 2 * around + 1, 0.5)
        .unwrap();
    let here = torus.point_position(start).unwrap();
    let along = DVec3::new(-here.y, here.x, 0.0);
    let answers = LoopFinder::new(&torus)
        .through(start, along, 9.0, 0.3)
        .unwrap();
    assert!((answers[0].geodesic.length() - inner_equator(around)).abs() < 1e-9);
    assert!(answers[0].direction_residual < 1e-9 && answers[0].closing_residual < 1e-9);
    let tilted = LoopFinder::new(&torus)
        .through(start, along + DVec3::Z, 150.0, 0.3)
        .unwrap();
    assert!(!tilted.is_empty());
    for answer in &tilted {
        let certificate = answer.geodesic.path().certify(&torus).unwrap();
        assert!(certificate.is_geodesic(), "{certificate:?}");
        assert!(
            answer.direction_residual < PI / 2.0 && answer.closing_residual < PI / 2.0,
            "{answer:?}"
        );
    }
}

/// Closed geodesics of the smooth torus by Clairaut's relation: lengths to which those of the mesh converge.
#[test]
fn classes_of_a_torus() {
    let smooth = [
        ((1, 0), 2.0 * PI * (MAJOR - MINOR)),
        ((0, 1), 2.0 * PI * MINOR),
        ((1, 1), 11.03249195),
        ((1, 2), 13.98491680),
    ];
    for (around, tube, tolerance) in [(24, 12, 6e-3), (64, 32, 1e-3)] {
        let mesh = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
        let mut classes =
            TorusClasses::new(&mesh, &row(around, 0), &column(around, tube, 0)).unwrap();
        for ((p, q), length) in smooth {
            let geodesic = classes.shortest(p, q).unwrap();
            assert!(geodesic.certify(&mesh).unwrap().is_geodesic());
            let error = geodesic.length() / length - 1.0;
            assert!(
                error.abs() < tolerance * 3.0,
                "({p}, {q}) on {around}: {error}"
            );
            let mut points = geodesic.path().points().to_vec();
            points.pop();
            assert_eq!(classes.class_of(&points), Ok([p, q]));
        }
        assert!(matches!(
            classes.shortest(0, 0),
            Err(Error::NullLoop { .. })
        ));
    }
    let sphere = shapes::sphere(1).unwrap();
    let answer = TorusClasses::new(&sphere, &[0.into(), 1.into()], &[2.into(), 3.into()]);
    assert!(matches!(
        answer,
        Err(Error::NotATorus {
            euler: 2,
            boundaries: 0
        })
    ));
    let mesh = shapes::torus(MAJOR, MINOR, 12, 8).unwrap();
    let answer = TorusClasses::new(&mesh, &row(12, 0), &row(12, 3));
    assert!(matches!(answer, Err(Error::NotABasis { determinant: 0 })));
}
