//! Trimmed offsets keep their distance and lose nothing that has it.

#[path = "common/random.rs"]
mod random;

use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{Approximation, ArcSpline, CubicPath, Piece, approximate};
use random::Random;

fn spline(curve: &CubicPath, how: Approximation) -> ArcSpline {
    approximate(curve, &how).unwrap().spline
}

fn rectangle(width: f64, height: f64, scale: f64) -> ArcSpline {
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(width, 0.0),
        dvec2(width, height),
        dvec2(0.0, height),
    ];
    let path = CubicPath::polyline(&corners.map(|p| p * scale), true).unwrap();
    spline(&path, Approximation::quartics(1e-6 * scale))
}

fn distance(spline: &ArcSpline, point: DVec2) -> f64 {
    spline
        .pieces()
        .iter()
        .map(|piece| piece.distance(point))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn a_rectangle_grows_with_round_corners_and_shrinks_with_sharp_ones() {
    for scale in [1.0, 1e-7, 1e9] {
        // Counter-clockwise: the right-hand side is outside.
        let rectangle = rectangle(10.0, 4.0, scale);
        let outer = rectangle.trimmed_offset(scale).unwrap();
        assert_eq!(outer.len(), 1);
        assert!(outer[0].is_closed());
        assert!((outer[0].length() / scale - 28.0 - std::f64::consts::TAU).abs() < 1e-9);
        let inner = rectangle.trimmed_offset(-scale).unwrap();
        assert_eq!(inner.len(), 1);
        assert!(inner[0].is_closed());
        assert_eq!(inner[0].pieces().len(), 4);
        assert!((inner[0].length() / scale - 20.0).abs() < 1e-9);
        assert!(rectangle.trimmed_offset(-2.5 * scale).unwrap().is_empty());
    }
}

#[test]
fn a_waist_separates_the_inner_offset_into_two() {
    let outline = [
        dvec2(0.0, 0.0),
        dvec2(4.0, 0.0),
        dvec2(5.0, 1.2),
        dvec2(6.0, 0.0),
        dvec2(10.0, 0.0),
        dvec2(10.0, 4.0),
        dvec2(6.0, 4.0),
        dvec2(5.0, 2.8),
        dvec2(4.0, 4.0),
        dvec2(0.0, 4.0),
    ];
    let path = CubicPath::polyline(&outline, true).unwrap();
    let spline = spline(&path, Approximation::quartics(1e-6));
    let parts = spline.trimmed_offset(-1.0).unwrap();
    assert_eq!(parts.len(), 2);
    assert!(parts.iter().all(ArcSpline::is_closed));
    assert!((parts[0].length() - parts[1].length()).abs() < 1e-9);
}

#[test]
fn random_loops_keep_exactly_what_keeps_its_distance() {
    let mut random = Random(7);
    for case in 0..120 {
        let closed = case % 3 > 0;
        let count = 6 + (random.unit() * 10.0) as usize;
        let control: Vec<DVec2> = (0..count)
            .map(|k| {
                let angle = std::f64::consts::TAU * k as f64 / count as f64;
                if case % 2 == 0 {
                    DVec2::from_angle(angle) * (0.3 + random.unit())
                } else {
                    dvec2(random.unit(), random.unit())
                }
            })
            .collect();
        let path = CubicPath::uniform_bspline(&control, closed).unwrap();
        let how = if case % 2 == 0 {
            Approximation::within(1e-6)
        } else {
            Approximation::quartics(1e-4)
        };
        let spline = spline(&path, how);
        let d = (random.unit() - 0.5) * 0.6;
        let raw = spline.offset(d).unwrap();
        let trimmed = spline.trimmed_offset(d).unwrap();
        // Every point of the result keeps its distance.
        let on = |piece: &Piece| [0.03, 0.31, 0.5, 0.77, 0.98].map(|t| piece.point(t));
        for piece in trimmed.iter().flat_map(ArcSpline::pieces) {
            for point in on(piece) {
                let kept = distance(&spline, point);
                assert!(kept >= d.abs() - 1e-7, "case {case}: {kept} for {d}");
            }
        }
        // No point of the offset that keeps its distance is missing.
        for piece in raw.pieces() {
            for point in on(piece) {
                if distance(&spline, point) >= d.abs() * (1.0 - 1e-10) {
                    let away = trimmed
                        .iter()
                        .map(|chain| distance(chain, point))
                        .fold(f64::INFINITY, f64::min);
                    assert!(away < 1e-7, "case {case}: {point} is missing by {away}");
                }
            }
        }
        for chain in &trimmed {
            // A loop that crosses itself is bounded on both sides: the chains of one of them may be open.
            let simple = spline.crossings().is_empty();
            assert!(
                !(closed && simple) || chain.is_closed(),
                "case {case}: an open chain of a simple loop"
            );
            let pieces = chain.pieces();
            for (i, _) in chain.joints().iter().enumerate() {
                let gap =
                    (pieces[i].point(1.0) - pieces[(i + 1) % pieces.len()].point(0.0)).length();
                assert!(gap < 1e-9, "case {case}: gap {gap}");
            }
            assert!(
                chain.crossings().is_empty(),
                "case {case}: {:?}",
                chain.crossings()
            );
        }
    }
}
