use super::*;
use crate::{Sweep, shapes};

fn length(line: &Isoline) -> f64 {
    line.positions
        .windows(2)
        .map(|ends| ends[0].distance(ends[1]))
        .sum()
}

#[test]
fn on_a_plane_they_are_circles() {
    let sheet = shapes::sheet(10, 10, |p| p.extend(0.0)).unwrap();
    let middle = sheet.face_point(111, [0.2, 0.3, 0.5]).unwrap();
    let mut sweep = Sweep::new(&sheet);
    let field = sweep.from_points(&[middle]).unwrap();
    for level in [0.01, 0.4, 3.3] {
        let lines = field.isolines(level, 1e-4 * level).unwrap();
        assert_eq!(lines.len(), 1, "level {level}");
        assert!(lines[0].is_closed);
        let missing = 1.0 - length(&lines[0]) / (TAU * level);
        assert!(missing > 0.0 && missing < 2e-4, "level {level}: {missing}");
    }
    let beyond = field.isolines(6.5, 1e-3).unwrap();
    assert!(!beyond.is_empty() && beyond.iter().all(|line| !line.is_closed));
}

/// On a rough terrain lines end at the boundary only, and their points have the distance.
#[test]
fn on_a_rough_terrain_they_end_at_the_boundary() {
    let height = |x: f64, y: f64| (0.9 * x).sin() * (0.7 * y).cos() + 0.3 * (3.1 * x * y).sin();
    let mesh = shapes::sheet(30, 30, |p| p.extend(height(p.x, p.y))).unwrap();
    let mut sweep = Sweep::new(&mesh);
    let field = sweep.from_points(&[200.into()]).unwrap();
    let farthest = field.vertex_distances().iter().copied().fold(0.0, f64::max);
    let is_on_boundary = |p: DVec3| {
        [p.x, p.y, 30.0 - p.x, 30.0 - p.y]
            .iter()
            .any(|d| d.abs() < 1e-9)
    };
    for k in 1..32 {
        let level = farthest * f64::from(k) / 32.0;
        for line in field.isolines(level, 1e-3).unwrap() {
            for &point in &line.points {
                let distance = field.distance(point).unwrap();
                assert!(
                    (distance - level).abs() < 1e-9 * farthest,
                    "level {level}: {distance}"
                );
            }
            let ends = [line.positions[0], line.positions[line.positions.len() - 1]];
            assert!(
                line.is_closed || ends.map(is_on_boundary) == [true, true],
                "level {level}: {ends:?}"
            );
        }
    }
}

/// On a bumpy sphere, with ridges where fronts meet: all lines close, and their points have the distance.
#[test]
fn their_points_have_the_distance_and_closed_surfaces_have_closed_ones() {
    let mesh = super::super::tests::bumpy(3);
    let mut sweep = Sweep::new(&mesh);
    let sources = [0.into(), mesh.face_point(500, [0.2, 0.3, 0.5]).unwrap()];
    let field = sweep.from_points(&sources).unwrap();
    let farthest = field.vertex_distances().iter().copied().fold(0.0, f64::max);
    let (mut count, mut worst) = (0, 0.0_f64);
    for k in 1..40 {
        let level = farthest * f64::from(k) / 40.0;
        for line in field.isolines(level, 1e-3).unwrap() {
            assert!(
                line.is_closed,
                "level {level}: {} points",
                line.points.len()
            );
            for &point in &line.points {
                worst = worst.max((field.distance(point).unwrap() - level).abs());
                count += 1;
            }
        }
    }
    assert!(count > 2000 && worst < 1e-9, "{count} points, {worst:e}");
    assert!(field.isolines(f64::NAN, 1e-3).is_err() && field.isolines(1.0, 0.0).is_err());
    assert!(field.isolines(2.0 * farthest, 1e-3).unwrap().is_empty());
}

#[test]
fn tolerances_that_take_all_memory_are_refused() {
    let sheet = shapes::sheet(1, 1, |p| p.extend(0.0)).unwrap();
    let mut sweep = Sweep::new(&sheet);
    let field = sweep.from_points(&[0.into()]).unwrap();
    for tolerance in [1e-18, 1e-300] {
        let refused = field.isolines(0.5, tolerance);
        assert_eq!(refused, Err(Error::InvalidTolerance { tolerance }));
    }
    let finest = field.isolines(0.5, 2e-10).unwrap();
    assert!(finest[0].points.len() > 10_000);
}
