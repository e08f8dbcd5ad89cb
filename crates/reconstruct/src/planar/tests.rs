use super::*;

fn test_curve(n: usize, length: f64) -> (Vec<f64>, Vec<f64>) {
    let s: Vec<f64> = (0..=n).map(|i| length * i as f64 / n as f64).collect();
    let alpha = s
        .iter()
        .map(|s| 0.3 + 1.4 * (1.7 * s).sin() + 0.4 * s * s / 3.0)
        .collect();
    (s, alpha)
}

fn error(n: usize, end: EndCondition) -> f64 {
    let (s, alpha) = test_curve(n, 3.0);
    let (_, fine) = test_curve(4096, 3.0);
    let exact = PlanarRibbon::new(&test_curve(4096, 3.0).0, &fine, EndCondition::NotAKnot).unwrap();
    let ribbon = PlanarRibbon::new(&s, &alpha, end).unwrap();
    (0..=n)
        .map(|i| (ribbon.points()[i] - exact.points()[i * 4096 / n]).length())
        .fold(0.0, f64::max)
}

/// The orders of the specification: 4 with not-a-knot ends, 3 with natural ones.
#[test]
fn order_of_convergence() {
    let order = |end| (error(64, end) / error(128, end)).log2();
    assert!(
        order(EndCondition::NotAKnot) > 3.9,
        "{}",
        order(EndCondition::NotAKnot)
    );
    let natural = order(EndCondition::Natural);
    assert!((2.8..3.3).contains(&natural), "{natural}");
}

#[test]
fn adding_a_constant_turns_the_curve() {
    let (s, alpha) = test_curve(16, 3.0);
    let ribbon = PlanarRibbon::new(&s, &alpha, EndCondition::Natural).unwrap();
    let shifted: Vec<f64> = alpha.iter().map(|a| a + 1.1).collect();
    let turned = PlanarRibbon::new(&s, &shifted, EndCondition::Natural).unwrap();
    for (p, q) in ribbon.points().iter().zip(turned.points()) {
        assert!((DVec2::from_angle(1.1).rotate(*p) - *q).length() < 1e-13);
    }
    assert!(ribbon.integration_error() < 3e-13);
}

/// Predicted covariance against 4,000 drawn noises.
#[test]
fn covariance_agrees_with_simulation() {
    let (s, alpha) = test_curve(16, 3.0);
    let sigma = 0.01;
    let ribbon = PlanarRibbon::new(&s, &alpha, EndCondition::NotAKnot).unwrap();
    let predicted = ribbon.covariance(sigma)[16];
    let mut noise = crate::testing::Noise::new(7);
    let (mut xx, mut yy) = (0.0, 0.0);
    let runs = 4000;
    for _ in 0..runs {
        let noisy: Vec<f64> = alpha.iter().map(|a| a + sigma * noise.gaussian()).collect();
        let end = PlanarRibbon::new(&s, &noisy, EndCondition::NotAKnot)
            .unwrap()
            .points()[16]
            - ribbon.points()[16];
        xx += end.x * end.x / f64::from(runs);
        yy += end.y * end.y / f64::from(runs);
    }
    // A variance from 4,000 draws has a relative standard error of 2.2 %: four of them.
    assert!(
        (xx / predicted.x_axis.x - 1.0).abs() < 0.09,
        "{xx} {predicted}"
    );
    assert!(
        (yy / predicted.y_axis.y - 1.0).abs() < 0.09,
        "{yy} {predicted}"
    );
}

#[test]
fn a_noisy_ellipse_closes_with_its_length() {
    let n = 40;
    let s: Vec<f64> = (0..n).map(|i| 6.0 * f64::from(i) / f64::from(n)).collect();
    let alpha: Vec<f64> = s
        .iter()
        .map(|s| s * TAU / 6.0 + 0.3 * (2.0 * s * TAU / 6.0).sin() + 0.02 * (17.0 * s).cos())
        .collect();
    let ribbon = ClosedPlanarRibbon::new(&s, &alpha, 6.0).unwrap();
    assert!(ribbon.closing_error().length() > 1e-4);
    assert!((ribbon.points()[n as usize]).length() < 6e-12);
    assert!(ribbon.largest_adjustment() < 0.05);
    // Periodic but for the full turn that the curve makes.
    for around in [-2.0, 1.0, 3.0] {
        let turned = ribbon.angle(0.3 + 6.0 * around) - around * TAU;
        assert!((turned - ribbon.angle(0.3)).abs() < 1e-12);
    }
    let straight = ClosedPlanarRibbon::new(&s, &vec![0.2; n as usize], 6.0);
    assert!(
        matches!(straight, Err(Error::NoConvergence { .. })),
        "{straight:?}"
    );
}

#[test]
fn hostile_data() {
    let end = EndCondition::NotAKnot;
    assert!(matches!(
        PlanarRibbon::new(&[0.0, 1.0], &[0.0, f64::INFINITY], end),
        Err(Error::NonFinite { index: 1, .. })
    ));
    assert!(matches!(
        PlanarRibbon::new(&[0.0, 1.0], &[0.0, PI], end),
        Err(Error::AmbiguousTurn { index: 1, .. })
    ));
    assert!(matches!(
        PlanarRibbon::new(&[0.0, 1.0], &[0.0], end),
        Err(Error::LengthMismatch { .. })
    ));
    assert!(matches!(
        PlanarRibbon::new(&[], &[], end),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        PlanarRibbon::new(&[0.0, f64::MAX, f64::INFINITY], &[0.0; 3], end),
        Err(Error::NonFinite { .. })
    ));
    assert!(ClosedPlanarRibbon::new(&[0.0, 1.0], &[0.0, 0.1], 0.5).is_err());
    let ribbon = PlanarRibbon::new(&[0.0, 1.0], &[0.0, 1.0], end).unwrap();
    assert!(ribbon.point(f64::NAN).is_err());
}
