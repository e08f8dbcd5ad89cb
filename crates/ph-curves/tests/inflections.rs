//! Class 9 passes inflections with continuous curvature, and stays exact under offsets there.

use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{Approximated, Approximation, CubicPath, Joint, Piece, PlaneCurve, approximate};

/// A cubic with an inflection in its middle.
fn s_curve() -> CubicPath {
    let control = [(0.0, 0.0), (40.0, 60.0), (60.0, -60.0), (100.0, 0.0)].map(DVec2::from);
    CubicPath::new(vec![control], false).unwrap()
}

fn approximated(tolerance: f64) -> Approximated {
    approximate(&s_curve(), &Approximation::within(tolerance)).unwrap()
}

#[test]
fn an_inflection_is_a_g2_joint_of_two_arcs() {
    let result = approximated(1e-7);
    assert_eq!(result.g1_joints, 0);
    assert!(
        result
            .spline
            .joints()
            .iter()
            .all(|joint| *joint == Joint::G2)
    );
    let pieces = result.spline.pieces();
    assert!(pieces.len() <= 18, "{}", pieces.len());
    let inflected: Vec<usize> = (0..pieces.len())
        .filter(|i| matches!(pieces[*i], Piece::Inflected(_)))
        .collect();
    assert_eq!(inflected.len(), 2);
    let (before, after) = (&pieces[inflected[0]], &pieces[inflected[1]]);
    // The curvature goes through zero in proportion to the parameter.
    for (piece, t, sign) in [(before, 1.0 - 1e-6, -1.0), (after, 1e-6, 1.0)] {
        let curvature = 1.0 / piece.radius(t);
        assert!(curvature * sign > 0.0 && curvature.abs() < 1e-6);
    }
    assert!((before.point(1.0) - dvec2(50.0, 0.0)).length() < 1e-12);
    assert_eq!(after.to_bezier().unwrap().degree(), 11);
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
