//! Approximations proven to be within their tolerance.

#[path = "common/walk.rs"]
mod walk;

use bezier_mass::{BSplineCurve, Knots, MassPoint};
use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{Approximation, CubicPath, Error, Joint, PlaneCurve, RationalPath, approximate};
use walk::walk;

fn approximations(tolerance: f64) -> [Approximation; 4] {
    let quartics = Approximation::quartics(tolerance);
    [
        Approximation::within(tolerance),
        Approximation::fewest(tolerance),
        quartics,
        Approximation {
            continuity: Joint::G1,
            ..quartics
        },
    ]
}

#[test]
fn random_splines_are_proven_to_keep_the_tolerance() {
    for seed in 0..150 {
        let curve = walk(seed, 10, seed.is_multiple_of(2));
        for tolerance in [1e-3, 1e-6] {
            for how in approximations(tolerance) {
                let result = approximate(&curve, &how).unwrap();
                let proven = result.certify(&curve, tolerance);
                assert!(
                    proven.is_ok_and(|bound| bound <= tolerance),
                    "seed {seed}, {how:?}: {proven:?}, sampled {:e}",
                    result.error
                );
            }
        }
    }
}

#[test]
fn a_bound_below_the_true_error_is_refused() {
    for seed in 0..40 {
        let curve = walk(seed, 10, seed.is_multiple_of(2));
        let tolerance = 1e-4;
        for how in approximations(tolerance) {
            let result = approximate(&curve, &how).unwrap();
            // The reported error is a factor of at most 2 for the peaks, and of 2 for the turning, above a difference at a sample.
            let there = result.error / 4.0;
            assert!(matches!(
                result.certify(&curve, 0.99 * there),
                Err(Error::NotCertified { bound, .. }) if bound > 0.99 * there
            ));
        }
    }
}

#[test]
fn cusps_corners_and_straight_parts_are_certified() {
    let cubic = |c: [(f64, f64); 4]| CubicPath::new(vec![c.map(DVec2::from)], false).unwrap();
    let curves = [
        cubic([(0.0, 0.0), (100.0, 100.0), (0.0, 100.0), (100.0, 0.0)]),
        cubic([(0.0, 0.0), (100.0, 100.0001), (0.0, 100.0), (100.0, 0.0)]),
        cubic([(0.0, 0.0), (0.0, 0.0), (60.0, 80.0), (100.0, 0.0)]),
        cubic([(0.0, 0.0), (20.0, 10.0), (70.0, 35.0), (100.0, 50.0)]),
        cubic([(0.0, 0.0), (150.0, 0.0), (-50.0, 0.0), (100.0, 0.0)]),
        cubic([(0.0, 0.0), (100.0, 80.0), (100.0, 80.0), (0.0, 0.0)]),
        CubicPath::polyline(
            &[dvec2(0.0, 0.0), dvec2(40.0, 0.0), dvec2(40.0, 30.0)],
            true,
        )
        .unwrap(),
    ];
    for (index, curve) in curves.iter().enumerate() {
        for how in approximations(1e-4) {
            let result = approximate(curve, &how).unwrap();
            let proven = result.certify(curve, how.tolerance);
            assert!(proven.is_ok(), "curve {index}, {how:?}: {proven:?}");
        }
    }
}

#[test]
fn enclosures_hold_the_derivatives() {
    let nurbs = nurbs();
    let cubics = walk(7, 10, false);
    let curves: [&dyn PlaneCurve; 2] = [&nurbs, &cubics];
    for curve in curves {
        for span in 0..curve.spans() {
            for part in [[0.0, 1.0], [0.2, 0.3], [0.7, 1.0], [0.5, 0.5001]] {
                let bounds = curve.enclosure(span, part).unwrap();
                let inside = |[least, most]: [f64; 2], value: f64| {
                    let slack = 1e-11 * (least.abs() + most.abs());
                    (least - slack..=most + slack).contains(&value)
                };
                for k in 0..=20 {
                    let t = part[0] + (part[1] - part[0]) * f64::from(k) / 20.0;
                    let [_, first, second] = curve.jet(span, t);
                    assert!(inside(bounds.speed_squared, first.length_squared()));
                    assert!(inside(bounds.bend, first.perp_dot(second)));
                    assert!(second.length() <= bounds.acceleration * (1.0 + 1e-11));
                }
                // They are those of the part: near to the values on a short one.
                if part[1] - part[0] < 1e-3 {
                    let [least, most] = bounds.speed_squared;
                    assert!(most - least < 0.01 * most);
                }
            }
        }
    }
}

/// A NURBS curve with weights between 0.4 and 3, of degree 4.
fn nurbs() -> RationalPath {
    let knots = Knots::clamped(4, &[0.0, 1.0, 1.5, 4.0]).unwrap();
    let control = [
        (0.0, 0.0, 1.0),
        (1.0, 3.0, 0.4),
        (4.0, 4.0, 3.0),
        (6.0, 1.0, 1.0),
        (9.0, -1.0, 2.0),
        (11.0, 2.0, 0.7),
        (12.0, 5.0, 1.0),
    ]
    .map(|(x, y, w)| MassPoint::point(dvec2(x, y), w));
    RationalPath::nurbs(&BSplineCurve::new(knots, control.to_vec()).unwrap()).unwrap()
}

#[test]
fn rational_curves_are_certified() {
    let curve = nurbs();
    for tolerance in [1e-3, 1e-6] {
        for how in approximations(tolerance) {
            let result = approximate(&curve, &how).unwrap();
            let proven = result.certify(&curve, tolerance);
            assert!(proven.is_ok(), "{how:?}: {proven:?}");
        }
    }
}

#[test]
fn another_curve_is_not_certified() {
    let curve = walk(3, 10, false);
    let result = approximate(&curve, &Approximation::within(1e-3)).unwrap();
    assert!(matches!(
        result.certify(&curve.reverse(), 1e-3),
        Err(Error::NotCertified { .. })
    ));
    assert!(matches!(
        result.certify(&walk(5, 10, false), 1e-3),
        Err(Error::NotCertified { .. })
    ));
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            result.certify(&curve, tolerance),
            Err(Error::BadTolerance { .. })
        ));
    }
}

#[test]
fn sources_that_do_not_belong_to_the_spline_prove_nothing() {
    let curve = walk(4, 10, true);
    let result = approximate(&curve, &Approximation::within(1e-3)).unwrap();
    let nonsense: [Vec<[f64; 2]>; 6] = [
        Vec::new(),
        vec![[0.0, 1e300]; 3],
        vec![[f64::NAN, 2.0]; 3],
        vec![[-1.0, 2.0]; 3],
        vec![[0.0, 10.0]],
        (0..500).map(|k| [0.01 * f64::from(k), 10.0]).collect(),
    ];
    for sources in nonsense {
        let mut changed = result.clone();
        changed.sources = sources;
        assert!(matches!(
            changed.certify(&curve, 1e-3),
            Err(Error::NotCertified { .. })
        ));
    }
}

#[test]
fn curves_without_enclosures_say_so() {
    struct Parabola;
    impl PlaneCurve for Parabola {
        fn spans(&self) -> usize {
            1
        }
        fn is_closed(&self) -> bool {
            false
        }
        fn jet(&self, _: usize, t: f64) -> [DVec2; 3] {
            [dvec2(t, t * t), dvec2(1.0, 2.0 * t), dvec2(0.0, 2.0)]
        }
    }
    let result = approximate(&Parabola, &Approximation::within(1e-6)).unwrap();
    assert_eq!(
        result.certify(&Parabola, 1e-6),
        Err(Error::NoEnclosure { span: 0 })
    );
}
