//! Numbers that no polynomial should have, through every door of the crate: an error with the numbers, or an answer that
//! is finite, never a panic.

use variation::glam::{DVec2, DVec3};
use variation::{
    Curve, Error, ImplicitCurve, Interval, Line, Plane, PoleStrategy, Solver, Term, blossom,
    chain_bound, chain_bound_by, corollary_bound, meet_plane, plane_bound, polar_derivative,
    polar_derivatives, pole_bound, roots, roots_of_power_form, roots_on,
};

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// The ends of the range of `f64`, and what lies between.
const EXTREME: [f64; 8] = [
    f64::MAX,
    -f64::MAX,
    1e300,
    -1e300,
    1e-300,
    f64::MIN_POSITIVE,
    5e-324,
    -5e-324,
];

fn not_finite<T: std::fmt::Debug>(answer: Result<T, Error>) {
    assert!(matches!(answer, Err(Error::NotFinite { .. })), "{answer:?}");
}

#[test]
fn what_is_not_finite_is_refused_everywhere() {
    for bad in NOT_FINITE {
        for place in 0..4 {
            let mut p = [1.0, -2.0, 3.0, -1.0];
            p[place] = bad;
            not_finite(roots(&p));
            not_finite(roots_of_power_form(&p, Interval::UNIT));
            not_finite(polar_derivative(&p, &0.5));
            not_finite(polar_derivatives(&p, &[0.5, 0.25]));
            not_finite(blossom(&p, &[0.1, 0.2, 0.3]));
            not_finite(pole_bound(&p, &0.5));
            not_finite(corollary_bound(&p, 1, 2));
            not_finite(chain_bound(&p, &[0.5]));
            for strategy in [
                PoleStrategy::Halving,
                PoleStrategy::Vanishing,
                PoleStrategy::Greedy,
            ] {
                not_finite(chain_bound_by(&p, 2, strategy));
            }
            not_finite(Solver::new().count(&p));
        }
        let p = [1.0, -2.0, 3.0, -1.0];
        not_finite(polar_derivative(&p, &bad));
        not_finite(blossom(&p, &[0.1, bad, 0.3]));
        assert!(pole_bound(&p, &bad).is_err() && chain_bound(&p, &[bad]).is_err());
        not_finite(Interval::try_new(bad, 1.0));
        not_finite(Interval::try_new(0.0, bad));
        not_finite(Line::try_new(bad, 1.0, 0.0));
        not_finite(Line::try_new(0.0, 1.0, bad));
        assert!(Curve::polynomial(&[DVec2::ZERO, DVec2::new(bad, 0.0)]).is_err());
        assert!(Curve::rational(&[DVec2::ZERO, DVec2::ONE], &[1.0, bad]).is_err());
        let term = Term {
            x_power: 1,
            y_power: 0,
            coefficient: bad,
        };
        assert!(ImplicitCurve::try_new(vec![term]).is_err());
        let curve = [DVec2::ZERO, DVec2::ONE];
        let curve = Curve::polynomial(&curve).unwrap();
        let off = DVec2::new(bad, 0.0);
        assert!(curve.meet_ray(off, DVec2::X).is_err() && curve.meet_ray(DVec2::X, off).is_err());
        assert!(curve.meet_segment(off, DVec2::X).is_err());
        assert!(curve.meet_circle(off, 1.0).is_err() && curve.meet_circle(DVec2::X, bad).is_err());
        assert!(Plane::try_new(DVec3::new(bad, 0.0, 1.0), 0.0).is_err());
        let plane = Plane::try_new(DVec3::Z, 0.0).unwrap();
        let points = [DVec3::ZERO, DVec3::splat(bad)];
        assert!(meet_plane(&points, None, plane).is_err());
        assert!(plane_bound(&points, None, plane, &[0.5]).is_err());
        let good = [DVec3::Z, DVec3::NEG_Z];
        assert!(plane_bound(&good, Some(&[1.0, bad]), plane, &[]).is_err());
        assert!(plane_bound(&good, None, plane, &[bad]).is_err());
    }
}

/// Poles outside extrapolate: what overflows is no value.
#[test]
fn overflow_is_an_error() {
    not_finite(polar_derivative(&[1e300, -1e300], &1e10));
    not_finite(blossom(&[1e300, -1e300, 1e300], &[1e200, 1e200]));
}

/// The number of roots does not depend on the unit of the coefficients, to the ends of the range.
#[test]
fn roots_of_extreme_coefficients_are_those_of_plain_ones() {
    for scale in EXTREME {
        for signs in [
            vec![1.0, -1.0],
            vec![1.0, -1.0, 1.0],
            vec![0.0, 1.0, -1.0, 0.0],
            vec![1.0, 1.0, -1.0, -1.0, 1.0],
        ] {
            let plain = roots(&signs).unwrap();
            let scaled: Vec<f64> = signs.iter().map(|s| s * scale).collect();
            let found = roots(&scaled).unwrap();
            assert_eq!(found.len(), plain.len(), "{scaled:?}");
            for (ours, theirs) in found.iter().zip(plain.iter()) {
                assert!(ours.lo <= ours.hi && ours.lo >= 0.0 && ours.hi <= 1.0);
                assert!((ours.value() - theirs.value()).abs() < 1e-11);
            }
        }
    }
}

/// All pairs of extreme numbers as coefficients and as ends of the interval.
#[test]
fn extreme_mixtures_end_with_a_finite_answer() {
    for a in EXTREME {
        for b in EXTREME {
            for c in [0.0, 1.0, a] {
                for p in [vec![a, c, b], vec![a, b, c, -a], vec![c, a, -b, b, -c]] {
                    let answers = [roots(&p), roots_of_power_form(&p, Interval::UNIT)];
                    for root in answers.iter().flatten().flat_map(|roots| roots.iter()) {
                        assert!(root.value().is_finite() && root.lo <= root.hi, "{p:?}");
                    }
                }
            }
            if let Ok(interval) = Interval::try_new(a, b) {
                let answer = roots_on(&[1.0, -2.0, 0.5], interval);
                for root in answer.iter().flat_map(|roots| roots.iter()) {
                    assert!(a <= root.lo && root.hi <= b, "{root:?} in [{a}, {b}]");
                }
            }
            let points = [DVec2::new(a, 0.0), DVec2::new(0.0, b), DVec2::new(b, a)];
            let curve = Curve::polynomial(&points).unwrap();
            if let Ok(line) = Line::try_new(b, a, a.abs().min(1.0))
                && let Ok(hits) = curve.meet_line(line)
            {
                assert!(hits.iter().all(|hit| hit.point.is_finite()), "{points:?}");
            }
            let weights = [a.abs(), 1.0, b.abs()];
            let rational = Curve::rational(&points, &weights).unwrap();
            for curve in [curve, rational] {
                let answers = [
                    curve.meet_circle(DVec2::ZERO, a.abs()),
                    curve.meet_segment(points[0], points[1]),
                    curve.meet_ray(DVec2::ZERO, points[2]),
                ];
                for hit in answers.into_iter().flatten().flatten() {
                    assert!(hit.point.is_finite(), "{points:?} {weights:?}: {hit:?}");
                }
                let _ = (curve.inflections(), curve.extrema(DVec2::new(a, b)));
            }
        }
    }
}

#[test]
fn empty_constant_and_vanishing_input_has_its_own_answer() {
    assert!(matches!(roots(&[]), Err(Error::NoCoefficients)));
    assert!(matches!(roots(&[0.0; 7]), Err(Error::IdenticallyZero)));
    assert_eq!(roots(&[3.0]).unwrap().len(), 0);
    assert_eq!(roots(&[5e-324; 4]).unwrap().len(), 0);
    assert!(Curve::polynomial(&[]).is_err());
    assert!(Curve::rational(&[DVec2::ZERO], &[0.0]).is_err());
    assert!(Line::try_new(0.0, 0.0, 1.0).is_err());
    assert!(ImplicitCurve::try_new(Vec::new()).is_err());
    assert!(
        Interval::try_new(1.0, 1.0).is_err() && Interval::try_new(-f64::MAX, f64::MAX).is_err()
    );
    // A point for a curve: on the line or off it.
    let at = [DVec2::ONE; 4];
    let curve = Curve::polynomial(&at).unwrap();
    assert_eq!(
        curve
            .meet_line(Line::try_new(1.0, 0.0, 0.0).unwrap())
            .unwrap()
            .len(),
        0
    );
    assert!(matches!(
        curve.meet_line(Line::try_new(1.0, -1.0, 0.0).unwrap()),
        Err(Error::LiesOn)
    ));
}

/// A high degree takes its time, not forever.
#[test]
fn high_degrees_end() {
    for degree in [60_usize, 200, 1000] {
        let alternating: Vec<f64> = (0..=degree)
            .map(|i| if i % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        let found = roots(&alternating);
        assert!(found.is_ok() || matches!(found, Err(Error::DegreeTooHigh { .. })));
        let flat: Vec<f64> = (0..=degree)
            .map(|i| if i == degree / 2 { -1e-9 } else { 1.0 })
            .collect();
        assert!(roots(&flat).map_or(true, |roots| roots.len() <= 2));
    }
}
