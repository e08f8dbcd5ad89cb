use super::*;

fn same(a: &impl Support, b: &impl Support) {
    for i in 0..100 {
        let psi = 0.13 * f64::from(i) - 5.0;
        let (a, b) = (a.jet(psi), b.jet(psi));
        assert!((a.support - b.support).abs() < 1e-13, "{psi}: {a:?} {b:?}");
        assert!((a.slope - b.slope).abs() < 1e-13, "{psi}: {a:?} {b:?}");
        assert!((a.bend - b.bend).abs() < 1e-11, "{psi}: {a:?} {b:?}");
    }
}

#[test]
fn the_rational_forms_are_the_curves() {
    let ellipse = Ellipse { a: 2.0, b: 1.0 };
    same(&ellipse, &ellipse.dual().unwrap());
    let bumped = Bumped { height: 0.05 };
    same(&bumped, &bumped.dual().unwrap());
}

#[test]
fn what_is_no_indicatrix_is_refused() {
    assert!(Indicatrix::try_new(Bumped { height: 0.066 }).is_ok());
    assert!(matches!(
        Indicatrix::try_new(Bumped { height: 0.067 }),
        Err(Error::NotConvex { .. })
    ));
    let lopsided = |psi: f64| SupportJet {
        support: 1.0 + 0.05 * (3.0 * psi).cos(),
        slope: 0.0,
        bend: 0.0,
    };
    assert!(matches!(
        Indicatrix::try_new(lopsided),
        Err(Error::NotSymmetric { .. })
    ));
    assert!(matches!(
        Indicatrix::try_new(Ellipse {
            a: f64::NAN,
            b: 1.0
        }),
        Err(Error::NonFinite { .. })
    ));
    assert!(Indicatrix::try_new(Ellipse { a: 0.0, b: 1.0 }).is_err());
    assert!(Ellipse { a: -1.0, b: 1.0 }.dual().is_err());
    assert!(Bumped { height: 0.08 }.dual().is_err());
    for (a, b) in [(-2.0, 1.0), (2.0, -1.0), (-2.0, -1.0)] {
        assert!(Indicatrix::try_new(Ellipse { a, b }).is_err());
    }
}

#[test]
fn arcs_that_do_not_turn_or_turn_too_far_are_refused() {
    let (bumped, ellipse) = (Bumped { height: 0.02 }, Ellipse { a: 2.0, b: 1.0 });
    for (start, end) in [
        (1.0, 1.0),
        (0.0, 4.0),
        (0.0, 4.0 * PI + 0.5),
        (0.0, f64::NAN),
    ] {
        assert!(bumped.arc(start, end).is_err(), "{start} {end}");
        assert!(ellipse.arc(start, end).is_err(), "{start} {end}");
    }
    assert!(matches!(
        Bumped { height: 5.0 }.arc(0.0, 1.0),
        Err(Error::NotConvex { .. })
    ));
}

#[test]
fn clockwise_arcs_close_no_indicatrix() {
    let ellipse = Ellipse { a: 2.0, b: 1.0 };
    let clockwise = [(0.0, -0.5 * PI), (-0.5 * PI, -PI)].map(|(a, b)| ellipse.arc(a, b).unwrap());
    assert!(matches!(
        DualIndicatrix::try_new(clockwise.to_vec()),
        Err(Error::NotRegular { index: 0, .. })
    ));
    let round = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
        .map(|k| ellipse.arc(0.5 * PI * k, 0.5 * PI * (k + 1.0)).unwrap());
    assert!(matches!(
        DualIndicatrix::try_new(round.to_vec()),
        Err(Error::TurningTooLarge { .. })
    ));
}
