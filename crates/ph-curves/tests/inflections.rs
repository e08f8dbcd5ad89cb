//! Class 9 passes inflections with continuous curvature, and stays exact under offsets there.

use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{Approximated, Approximation, CubicPath, Piece, PlaneCurve, approximate};

/// A cubic with an inflection in its middle.
fn s_curve() -> CubicPath {
    let control = [(0.0, 0.0), (40.0, 60.0), (60.0, -60.0), (100.0, 0.0)].map(DVec2::from);
    CubicPath::new(vec![control], false).unwrap()
}

fn approximated(tolerance: f64) -> Approximated {
    approximate(&s_curve(), &Approximation::within(tolerance)).unwrap()
}

#[test]
fn one_arc_runs_through_an_inflection() {
    let result = approximated(1e-7);
    assert_eq!(result.g1_joints, 0);
    let pieces = result.spline.pieces();
    assert!(pieces.len() <= 13, "{}", pieces.len());
    let through: Vec<(&Piece, f64)> = pieces
        .iter()
        .filter_map(|piece| Some((piece, piece.inflection()?)))
        .collect();
    let [(piece, t)] = through[..] else {
        panic!("{} pieces have an inflection", through.len())
    };
    assert!((piece.point(t) - dvec2(50.0, 0.0)).length() < 1e-12);
    assert!(piece.velocity(t).length() > 1.0);
    // The curvature goes through zero in proportion to the parameter.
    for (beside, sign) in [(t - 1e-6, -1.0), (t + 1e-6, 1.0)] {
        let curvature = 1.0 / piece.radius(beside);
        assert!(curvature * sign > 0.0 && curvature.abs() < 1e-6);
    }
    assert_eq!(piece.to_bezier().unwrap().degree(), 11);
    // It can be cut there: two arcs that begin in the inflection.
    let halves = [piece.part(0.0, t).unwrap(), piece.part(t, 1.0).unwrap()];
    assert!(halves.iter().all(|half| half.inflection().is_none()));
    assert!((halves[0].length() + halves[1].length() - piece.length()).abs() < 1e-12);
}

/// A line that goes over into a bend and a wave whose knots are inflections: the curvature is zero at ends of spans.
#[test]
fn curvature_that_vanishes_at_knots_is_continuous() {
    let control = [
        0.0, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0, -8.0, 0.0, 8.0, 0.0, 0.0, 0.0, 0.0,
    ];
    let points: Vec<DVec2> = (0..)
        .zip(control)
        .map(|(x, y)| dvec2(10.0 * f64::from(x), y))
        .collect();
    let curve = CubicPath::uniform_bspline(&points, false).unwrap();
    for tolerance in [1e-2, 1e-5, 1e-8] {
        let result = approximate(&curve, &Approximation::within(tolerance)).unwrap();
        assert_eq!(result.g1_joints, 0, "{tolerance}");
        assert!(result.spline.g2_jump() < 1e-6);
        assert!(matches!(result.spline.pieces()[0], Piece::Segment(_)));
    }
}

#[test]
fn the_error_falls_with_the_tenth_power() {
    // At order ten 1e4 in the error are 10^0.4 = 2.5 in the pieces; cuts into whole parts make it somewhat more.
    let counts = [1e-3, 1e-7].map(|tolerance| approximated(tolerance).spline.pieces().len());
    assert!(counts[1] <= 4 * counts[0], "{counts:?}");
}

#[test]
fn offsets_of_inflected_arcs_are_exact_and_as_long_as_they_turn() {
    let spline = approximated(1e-8).spline;
    let offset = spline.offset(1.5).unwrap();
    // The whole turning is zero, so that what one half gains the other loses.
    assert!((offset.length() - spline.length()).abs() < 1e-7);
    for (piece, moved) in spline.pieces().iter().zip(offset.pieces()) {
        for t in [0.0, 0.3, 1.0] {
            let exact = piece.point(t) + 1.5 * piece.normal(t);
            assert!((moved.point(t) - exact).length() < 1e-13);
        }
    }
    // The far side: trimmed where the curve bends too sharply.
    for distance in [12.0, -12.0] {
        let chains = spline.trimmed_offset(distance).unwrap();
        assert!(chains.iter().all(|chain| chain.crossings().is_empty()));
        for point in chains
            .iter()
            .flat_map(|chain| chain.pieces())
            .flat_map(|piece| [0.1, 0.5, 0.9].map(|t| piece.point(t)))
        {
            let nearest = spline
                .pieces()
                .iter()
                .map(|piece| piece.distance(point))
                .fold(f64::INFINITY, f64::min);
            assert!((nearest - 12.0).abs() < 1e-7, "{nearest}");
        }
    }
}

#[test]
fn reversed_curves_have_the_same_spline() {
    let curve = s_curve();
    let (there, back) = (
        approximated(1e-7),
        approximate(&curve.reverse(), &Approximation::within(1e-7)).unwrap(),
    );
    assert_eq!(there.spline.pieces().len(), back.spline.pieces().len());
    assert!((there.spline.length() - back.spline.length()).abs() < 1e-7);
    assert_eq!(curve.spans(), 1);
}
