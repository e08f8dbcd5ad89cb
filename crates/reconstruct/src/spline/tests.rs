use super::*;

const KNOTS: [f64; 6] = [0.0, 0.4, 1.0, 1.3, 2.2, 3.0];

/// A not-a-knot spline reproduces cubics, a natural one straight lines.
#[test]
fn reproduction() {
    let cubic = |s: f64| 1.0 - 2.0 * s + 0.5 * s * s - 0.3 * s * s * s;
    let spline = CubicSpline::new(&KNOTS, &KNOTS.map(cubic), EndCondition::NotAKnot).unwrap();
    let line = CubicSpline::new(&KNOTS, &KNOTS.map(|s| 2.0 - s), EndCondition::Natural).unwrap();
    for i in 0..=30 {
        let s = 0.1 * f64::from(i);
        assert!((spline.value(s) - cubic(s)).abs() < 1e-14);
        assert!((line.value(s) - (2.0 - s)).abs() < 1e-15);
    }
    let parabola = |s: f64| s * s - s;
    let three = CubicSpline::new(
        &KNOTS[..3],
        &KNOTS.map(parabola)[..3],
        EndCondition::NotAKnot,
    )
    .unwrap();
    assert!((three.value(0.7) - parabola(0.7)).abs() < 1e-15);
}

#[test]
fn second_derivatives_are_continuous_and_natural_ends_vanish() {
    let values = KNOTS.map(|s| (3.0 * s).sin());
    for end in [EndCondition::Natural, EndCondition::NotAKnot] {
        let spline = CubicSpline::new(&KNOTS, &values, end).unwrap();
        for (i, &s) in KNOTS.iter().enumerate().take(5).skip(1) {
            let (left, right) = (spline.piece(i - 1), spline.piece(i));
            assert!((left.derivative(s) - right.derivative(s)).abs() < 1e-13);
            assert!((left.second_derivative(s) - right.second_derivative(s)).abs() < 1e-13);
        }
        let series = spline.of_series(Series::parameter(1.7));
        assert!((series.value() - spline.value(1.7)).abs() < 1e-15);
        assert!((series.derivative_at(1) - spline.piece(3).derivative(1.7)).abs() < 1e-13);
    }
}

#[test]
fn a_periodic_spline_closes_with_its_derivatives() {
    for n in [2, 3, 4, 7] {
        let knots: Vec<f64> = (0..=n)
            .map(|i| f64::from(i) + 0.2 * f64::from(i * i % 3))
            .collect();
        let mut values: Vec<f64> = knots.iter().map(|s| (1.3 * s).cos() + s.sin()).collect();
        values[n as usize] = values[0];
        let spline = CubicSpline::periodic(&knots, &values).unwrap();
        let (first, last) = (spline.piece(0), spline.piece(n as usize - 1));
        let (a, b) = (knots[0], knots[n as usize]);
        assert!(
            (first.derivative(a) - last.derivative(b)).abs() < 1e-13,
            "{n}"
        );
        assert!(
            (first.second_derivative(a) - last.second_derivative(b)).abs() < 1e-13,
            "{n}"
        );
        for (i, &s) in knots.iter().enumerate().take(n as usize).skip(1) {
            let (left, right) = (spline.piece(i - 1), spline.piece(i));
            assert!(
                (left.derivative(s) - right.derivative(s)).abs() < 1e-13,
                "{n}"
            );
        }
    }
}

#[test]
fn bad_data_are_refused() {
    let end = EndCondition::Natural;
    assert!(matches!(
        CubicSpline::new(&[0.0], &[1.0], end),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        CubicSpline::new(&[0.0, 0.0], &[1.0, 2.0], end),
        Err(Error::NotIncreasing { index: 1, .. })
    ));
    assert!(matches!(
        CubicSpline::new(&[0.0, f64::NAN], &[1.0, 2.0], end),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        CubicSpline::new(&[0.0, 1.0], &[1.0], end),
        Err(Error::LengthMismatch { .. })
    ));
    assert!(matches!(
        CubicSpline::periodic(&[0.0, 1.0], &[1.0, 2.0]),
        Err(Error::NotPeriodic { .. })
    ));
}
