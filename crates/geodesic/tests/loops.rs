//! Closed geodesics.

use std::f64::consts::PI;

use geodesic::glam::DVec3;
use geodesic::{
    Error, LoopFinder, Mesh, SubdivisionSurface, SurfacePoint, TorusClasses, closed_torus_geodesic,
    shapes,
};

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

/// Classes with small numbers, of either sign, against Clairaut's relation; `(k, 0)` against the inner equator.
#[test]
fn every_class_of_a_torus() {
    let (around, tube) = (16, 8);
    let mesh = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
    let mut classes = TorusClasses::new(&mesh, &row(around, 0), &column(around, tube, 0)).unwrap();
    for (p, q) in [(1, 0), (0, -1), (-1, 1), (2, 1), (-1, -2), (0, 2)] {
        let geodesic = classes.shortest(p, q).unwrap();
        let certificate = geodesic.certify(&mesh).unwrap();
        assert!(certificate.is_geodesic(), "({p}, {q}): {certificate:?}");
        let points = &geodesic.path().points()[1..];
        assert_eq!(classes.class_of(points), Ok([p, q]));
        let smooth = match q {
            0 => f64::from(i32::abs(p)) * 2.0 * PI * (MAJOR - MINOR),
            _ => {
                let (p, q) = (i32::unsigned_abs(p), i32::unsigned_abs(q));
                closed_torus_geodesic(MAJOR, MINOR, p, q).unwrap().length
            }
        };
        let error = geodesic.length() / smooth - 1.0;
        assert!(error.abs() < 0.05, "({p}, {q}): {error}");
    }
}

/// A point of the closed geodesic (1, 3) and its direction there: on finer meshes the loop that is found leaves it
/// ever closer to that direction.
#[test]
fn the_loop_through_a_point_of_a_closed_geodesic() {
    let smooth = closed_torus_geodesic(MAJOR, MINOR, 1, 3).unwrap();
    // At the top of the tube ρ is the major radius, and ρ cos ψ the constant.
    let cosine = smooth.clairaut / MAJOR;
    let mut residuals = Vec::new();
    for (around, tube) in [(16, 8), (32, 16), (64, 32)] {
        let mesh = shapes::torus(MAJOR, MINOR, around, tube).unwrap();
        let v = tube / 4 * around;
        let here = mesh.positions()[v as usize];
        // Downwards at the top is inwards: along -x at the point (2, 0, 0.7).
        let direction = DVec3::new(-(1.0 - cosine * cosine).sqrt(), cosine, 0.0);
        assert!(here.distance(DVec3::new(MAJOR, 0.0, MINOR)) < 1e-12);
        let mut classes =
            TorusClasses::new(&mesh, &row(around, 0), &column(around, tube, 0)).unwrap();
        let answers = classes.through(v.into(), direction, 3).unwrap();
        let (class, best) = &answers[0];
        assert_eq!(*class, [1, 3], "{}", best.residual());
        assert!((best.geodesic.length() / smooth.length - 1.0).abs() < 0.05);
        assert!(
            answers
                .windows(2)
                .all(|pair| pair[0].1.residual() <= pair[1].1.residual())
        );
        assert!(best.closing_residual < 0.06);
        residuals.push(best.direction_residual);
    }
    assert!(
        residuals[2] < 0.03 && residuals.is_sorted_by(|a, b| a > b),
        "{residuals:?}"
    );
}

/// Loops carried over the levels of a subdivision surface become smooth: the largest turn falls with the edges.
#[test]
fn loops_of_a_subdivision_surface() {
    let (around, tube) = (10, 6);
    let coarse = shapes::torus(MAJOR, 0.9, around, tube).unwrap();
    let mut surface = SubdivisionSurface::loop_scheme(&coarse).unwrap();
    let mut points: Vec<SurfacePoint> = (0..2 * around)
        .map(|k| (k / 2 % around + k * tube / (2 * around) % tube * around).into())
        .collect();
    let (mut lengths, mut turns) = (Vec::new(), Vec::new());
    for _ in 0..4 {
        let tight = LoopFinder::new(surface.mesh()).tighten(&points).unwrap();
        assert!(tight.certify(surface.mesh()).unwrap().is_geodesic());
        lengths.push(tight.length());
        turns.push(largest_turn(tight.path().positions()));
        let carried = tight.path().points()[1..].iter().map(|p| surface.carry(*p));
        points = carried.collect::<Result<_, _>>().unwrap();
        surface = surface.refined().unwrap();
    }
    let changes: Vec<f64> = lengths.windows(2).map(|l| (l[1] - l[0]).abs()).collect();
    assert!(
        changes[1] < 0.5 * changes[0] && changes[2] < 0.5 * changes[1],
        "{lengths:?}"
    );
    assert!(turns.windows(2).all(|t| t[1] < t[0]), "{turns:?}");
}

fn largest_turn(positions: &[DVec3]) -> f64 {
    let mut points = positions.to_vec();
    points.dedup_by(|a, b| a.distance(*b) < 1e-6);
    let turn = |p: &[DVec3]| (p[1] - p[0]).angle_between(p[2] - p[1]);
    points.windows(3).map(turn).fold(0.0, f64::max)
}
