//! The documented behaviour of the root finder on small and special input.

use variation::{Count, Error, Interval, Root, Solver, roots, roots_on};

fn values(coefficients: &[f64]) -> Vec<(f64, Option<u32>)> {
    roots(coefficients)
        .unwrap()
        .iter()
        .map(|r| (r.value(), r.multiplicity()))
        .collect()
}

fn multiplicities(coefficients: &[f64]) -> Vec<Option<u32>> {
    roots(coefficients)
        .unwrap()
        .iter()
        .map(Root::multiplicity)
        .collect()
}

#[test]
fn input_is_checked_at_the_door() {
    assert_eq!(roots(&[]), Err(Error::NoCoefficients));
    assert!(matches!(
        roots(&[1.0, f64::NAN, -1.0]),
        Err(Error::NotFinite { index: 1, .. })
    ));
    assert!(matches!(
        roots(&[1.0, f64::NEG_INFINITY]),
        Err(Error::NotFinite { index: 1, .. })
    ));
    assert_eq!(roots(&[0.0, -0.0, 0.0]), Err(Error::IdenticallyZero));
    assert_eq!(roots(&[0.0]), Err(Error::IdenticallyZero));
    assert!(matches!(
        Interval::try_new(1.0, 0.0),
        Err(Error::EmptyInterval { .. })
    ));
    assert!(matches!(
        Interval::try_new(0.5, 0.5),
        Err(Error::EmptyInterval { .. })
    ));
    assert!(matches!(
        Interval::try_new(-f64::MAX, f64::MAX),
        Err(Error::EmptyInterval { .. })
    ));
    assert!(matches!(
        Interval::try_new(f64::NAN, 1.0),
        Err(Error::NotFinite { .. })
    ));
}

#[test]
fn constants_have_no_roots() {
    assert!(roots(&[3.0]).unwrap().is_empty());
    assert!(roots(&[-2.0, -2.0, -2.0]).unwrap().is_empty());
}

#[test]
fn ends_are_roots_with_multiplicity() {
    assert_eq!(values(&[0.0, 1.0]), [(0.0, Some(1))]);
    assert_eq!(values(&[1.0, 0.0]), [(1.0, Some(1))]);
    let found = values(&[0.0, 0.0, 1.0 / 42.0, -3.0 / 14.0, 0.0]);
    assert_eq!((found[0], found[2]), ((0.0, Some(2)), (1.0, Some(1))));
    // t^2 (1-t)
    assert_eq!(
        values(&[0.0, 0.0, 1.0, 0.0]),
        [(0.0, Some(2)), (1.0, Some(1))]
    );
}

#[test]
fn a_root_in_the_middle_is_found_once() {
    for n in [1_usize, 3, 5, 9, 17, 33] {
        let linear: Vec<f64> = (0..=n).map(|i| 2.0 * i as f64 - n as f64).collect();
        let found = roots(&linear).unwrap();
        assert_eq!(found.len(), 1, "degree {n}");
        assert!(found[0].lo <= 0.5 && 0.5 <= found[0].hi && found[0].width() <= 1e-12);
    }
}

#[test]
fn huge_and_tiny_coefficients_are_scaled() {
    let p = [-1.0, 6.0, -11.0, 3.0, 2.0, -1.5];
    let expected = roots(&p).unwrap();
    for scale in [f64::MAX / 16.0, 2.0_f64.powi(-1000), 2.0_f64.powi(500)] {
        let found = roots(&p.map(|x| x * scale)).unwrap();
        assert_eq!(found.len(), expected.len());
        for (a, b) in found.iter().zip(&expected) {
            assert!(a.lo <= b.hi && b.lo <= a.hi);
        }
    }
    // Nothing is left of f64 here, the exact path decides: -5e-324 + t * 1e-323 has the root 1/3.
    let found = roots(&[-5e-324, 1e-323]).unwrap();
    assert_eq!(found.len(), 1);
    assert!((found[0].value() - 1.0 / 3.0).abs() < 1e-12);
}

#[cfg(feature = "exact")]
#[test]
fn multiple_roots_are_counted_exactly() {
    // (2t - 1)^2 and (2t - 1)^3
    assert_eq!(multiplicities(&[1.0, -1.0, 1.0]), [Some(2)]);
    assert_eq!(multiplicities(&[-1.0, 1.0, -1.0, 1.0]), [Some(3)]);
    // 3 (4t - 1)^2 (4t - 3)^2
    assert_eq!(
        multiplicities(&[27.0, -45.0, 59.0, -45.0, 27.0]),
        [Some(2), Some(2)]
    );
}

#[test]
fn without_the_exact_path_a_double_root_is_a_cluster() {
    let mut solver = Solver::new().without_exact();
    let found = solver.roots(&[1.0, -1.0, 1.0]).unwrap();
    assert!(
        matches!(found, [Root { lo, hi, count: Count::AtMost(2) }] if *lo <= 0.5 && 0.5 <= *hi)
    );
}

#[test]
fn an_interval_only_changes_the_scale() {
    let p = [1.0, -3.0, 2.0, 4.0, -1.0];
    let unit = roots(&p).unwrap();
    let interval = Interval::try_new(-3.0, 5.0).unwrap();
    let mapped = roots_on(&p, interval).unwrap();
    assert_eq!(unit.len(), mapped.len());
    for (u, t) in unit.iter().zip(&mapped) {
        assert!(t.lo <= -3.0 + 8.0 * u.value() && -3.0 + 8.0 * u.value() <= t.hi);
        assert!(t.width() <= 8e-12);
    }
}
