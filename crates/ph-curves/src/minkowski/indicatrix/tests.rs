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
}
