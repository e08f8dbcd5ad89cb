use super::*;
use crate::testing::Noise;
use glam::DQuat;

fn tangent(s: f64) -> DVec3 {
    let (theta, phi) = (
        0.9 + 0.5 * (1.3 * s).sin(),
        0.3 + 0.8 * s + 0.2 * (2.1 * s).cos(),
    );
    DVec3::new(
        theta.sin() * phi.cos(),
        theta.sin() * phi.sin(),
        theta.cos(),
    )
}

fn data(n: usize) -> (Vec<f64>, Vec<DVec3>) {
    let s: Vec<f64> = (0..=n).map(|i| 4.0 * i as f64 / n as f64).collect();
    let tangents = s.iter().map(|s| tangent(*s)).collect();
    (s, tangents)
}

fn error(n: usize, method: TangentMethod, end: EndCondition) -> f64 {
    let (s, tangents) = data(n);
    let ribbon = SpatialRibbon::with_method(&s, &tangents, method, end).unwrap();
    let (exact, _) = positions(&s, &tangent, 1e-13).unwrap();
    ribbon
        .points()
        .iter()
        .zip(&exact)
        .map(|(p, q)| (*p - *q).length())
        .fold(0.0, f64::max)
}

#[test]
fn orders_of_convergence() {
    let order = |method, end| (error(48, method, end) / error(96, method, end)).log2();
    let a = order(TangentMethod::Projected, EndCondition::NotAKnot);
    assert!(a > 3.9, "projected, not-a-knot: {a}");
    let natural = order(TangentMethod::Projected, EndCondition::Natural);
    assert!(
        (2.7..3.4).contains(&natural),
        "projected, natural: {natural}"
    );
    let sphere = order(TangentMethod::SphericalSpline, EndCondition::Natural);
    assert!((2.7..3.4).contains(&sphere), "sphere: {sphere}");
}

/// Turning the data turns the curve, to 1e-12 of its length.
#[test]
fn rotation_invariance() {
    let (s, tangents) = data(24);
    let mut noise = Noise::new(3);
    for method in [TangentMethod::Projected, TangentMethod::SphericalSpline] {
        let ribbon =
            SpatialRibbon::with_method(&s, &tangents, method, EndCondition::NotAKnot).unwrap();
        for _ in 0..20 {
            let q = DQuat::from_xyzw(
                noise.gaussian(),
                noise.gaussian(),
                noise.gaussian(),
                noise.gaussian(),
            )
            .normalize();
            let turned: Vec<DVec3> = tangents.iter().map(|t| q * *t).collect();
            let other =
                SpatialRibbon::with_method(&s, &turned, method, EndCondition::NotAKnot).unwrap();
            for (a, b) in ribbon.points().iter().zip(other.points()) {
                assert!((q * *a - *b).length() < 4e-12);
            }
        }
    }
}

#[test]
fn sensitivity_is_the_derivative() {
    let (s, tangents) = data(12);
    let ribbon = SpatialRibbon::new(&s, &tangents).unwrap();
    let at = 2.9;
    let matrices = ribbon.sensitivity(at);
    for j in [0, 5, 11] {
        for axis in DVec3::AXES {
            let across = axis - tangents[j] * axis.dot(tangents[j]);
            let move_by = |step: f64| {
                let mut moved = tangents.clone();
                moved[j] += across * step;
                SpatialRibbon::new(&s, &moved).unwrap().point(at).unwrap()
            };
            let difference = (move_by(1e-5) - move_by(-1e-5)) / 2e-5;
            assert!((difference - matrices[j] * across).length() < 1e-8);
        }
    }
}

/// Also beyond the ends, and of the spherical spline as far as its ends go, whatever the caller's condition.
#[test]
fn sensitivity_of_either_method_and_beyond_the_ends() {
    let s: Vec<f64> = (0..9).map(|i| 0.25 * f64::from(i)).collect();
    let tangents: Vec<DVec3> = s
        .iter()
        .map(|x| DVec3::new((0.7 * x).cos(), (0.7 * x).sin(), 0.3 * (0.5 * x).cos()).normalize())
        .collect();
    for (method, end, places, bound) in [
        (
            TangentMethod::SphericalSpline,
            EndCondition::NotAKnot,
            vec![2.0],
            5e-3,
        ),
        (
            TangentMethod::SphericalSpline,
            EndCondition::Natural,
            vec![2.0],
            5e-3,
        ),
        (
            TangentMethod::Projected,
            EndCondition::NotAKnot,
            vec![-0.2, 1.1, 2.0, 2.3],
            1e-6,
        ),
        (
            TangentMethod::Projected,
            EndCondition::Natural,
            vec![-0.2, 1.1, 2.0, 2.3],
            1e-6,
        ),
    ] {
        let ribbon = SpatialRibbon::with_method(&s, &tangents, method, end).unwrap();
        for at in places {
            let matrices = ribbon.sensitivity(at);
            for j in 0..s.len() {
                let across = tangents[j].any_orthonormal_vector();
                let moved = |step: f64| {
                    let mut moved = tangents.clone();
                    moved[j] += across * step;
                    let ribbon = SpatialRibbon::with_method(&s, &moved, method, end).unwrap();
                    ribbon.point(at).unwrap()
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                let error = (difference - matrices[j] * across).length();
                assert!(
                    error < bound * difference.length().max(1e-2),
                    "{method:?} {end:?} {at} {j}: {error}"
                );
            }
        }
        assert!(ribbon.sensitivity(f64::NAN).iter().all(|m| m.is_nan()));
    }
}

#[test]
fn covariance_agrees_with_simulation() {
    let (s, tangents) = data(16);
    let ribbon = SpatialRibbon::new(&s, &tangents).unwrap();
    let sigma = 0.01;
    let predicted = ribbon.covariance(sigma)[16];
    let mut noise = Noise::new(11);
    let mut measured = DMat3::ZERO;
    let runs = 3000;
    for _ in 0..runs {
        let noisy: Vec<DVec3> = tangents
            .iter()
            .map(|t| *t + noise.gaussian_vector() * sigma)
            .collect();
        let end = SpatialRibbon::new(&s, &noisy).unwrap().points()[16] - ribbon.points()[16];
        measured += outer(end, end) * (1.0 / f64::from(runs));
    }
    // Relative standard error of a variance from 3,000 draws: 2.6 %; allow four of them on the trace.
    let trace = |m: DMat3| m.x_axis.x + m.y_axis.y + m.z_axis.z;
    assert!(
        (trace(measured) / trace(predicted) - 1.0).abs() < 0.1,
        "{measured} {predicted}"
    );
}

#[test]
fn hostile_data() {
    let s = [0.0, 1.0, 2.0];
    for size in [1e-300, 1e300] {
        let long = [DVec3::new(3.0, 4.0, 0.0) * size, DVec3::Y, DVec3::Z];
        let ribbon = SpatialRibbon::new(&s, &long).unwrap();
        assert!((ribbon.tangents()[0] - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-15);
    }
    let bad = |tangents: [DVec3; 3]| SpatialRibbon::new(&s, &tangents);
    assert!(matches!(
        bad([DVec3::X, -DVec3::X, DVec3::Y]),
        Err(Error::AntipodalTangents { index: 1, .. })
    ));
    assert!(matches!(
        bad([DVec3::X, DVec3::ZERO, DVec3::Y]),
        Err(Error::ZeroVector { index: 1, .. })
    ));
    assert!(matches!(
        bad([DVec3::X, DVec3::NAN, DVec3::Y]),
        Err(Error::NonFinite { index: 1, .. })
    ));
    let wild = [DVec3::X, DVec3::new(-0.999, 0.04, 0.0), DVec3::X];
    assert!(matches!(bad(wild), Err(Error::TangentLost { .. })));
    let method = TangentMethod::SphericalSpline;
    let uneven = SpatialRibbon::with_method(
        &[0.0, 1.0, 3.0],
        &[DVec3::X, DVec3::Y, DVec3::Z],
        method,
        EndCondition::Natural,
    );
    assert!(matches!(uneven, Err(Error::NotUniform { .. })));
}
