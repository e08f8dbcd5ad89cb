//! What is written as JSON is read back the same, and what could not be made is not read.
#![cfg(feature = "serde")]

use reconstruct::bezier_mass::BezierCurve;
use reconstruct::glam::{DMat3, DVec3};
use reconstruct::{
    BezierStrip, Calibration, ClosedPlanarRibbon, ClosedSpatialRibbon, CornerData, Crossing,
    CubicSpline, Curve, EndCondition, PlanarRibbon, RibbonLayout, RibbonNetwork, SampledCurve,
    Sensor, SensorKind, SpatialRibbon, Strip, TangentMethod, Tangents, WorldFields,
};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, from_value, json, to_string, to_value};
use std::f64::consts::TAU;

fn again<T: Serialize + DeserializeOwned>(value: &T) -> T {
    serde_json::from_str(&to_string(value).unwrap()).unwrap()
}

/// Replaces one field of a stored value and tries to read that.
fn broken<T: Serialize + DeserializeOwned>(value: &T, field: &str, other: Value) -> bool {
    let mut stored = to_value(value).unwrap();
    assert!(!stored[field].is_null(), "no field {field}");
    stored[field] = other;
    from_value::<T>(stored).is_err()
}

fn places() -> Vec<f64> {
    (0..9).map(|i| 0.25 * f64::from(i)).collect()
}

fn tangent(s: f64) -> DVec3 {
    DVec3::new((0.7 * s).cos(), (0.7 * s).sin(), 0.3)
}

#[test]
fn splines_and_sampled_curves() {
    let values: Vec<f64> = places().iter().map(|s| s.sin()).collect();
    let spline = CubicSpline::new(&places(), &values, EndCondition::NotAKnot).unwrap();
    assert!((again(&spline).value(0.6) - spline.value(0.6)).abs() < 1e-15);
    for field in ["knots", "values", "moments"] {
        assert!(broken(&spline, field, json!([])));
        assert!(broken(
            &spline,
            field,
            json!([0.0, 3.0, 1.0, 2.0, 4.0, 5.0, 6.0, 8.0, 7.0])
        ));
    }
    let empty = json!({"knots": [], "values": [], "moments": []});
    assert!(from_value::<CubicSpline<f64>>(empty).is_err());

    let points: Vec<DVec3> = (0..20).map(|i| tangent(0.1 * f64::from(i))).collect();
    let curve = SampledCurve::fit(&points, 3).unwrap();
    assert!(again(&curve).point(0.4).distance(curve.point(0.4)) < 1e-14);
    assert!(broken(&curve, "coefficients", json!([])));
    assert!(broken(&curve, "parameters", json!([0.0, 0.5, 0.4])));
}

#[test]
fn ribbons_and_networks() {
    let s = places();
    let end = EndCondition::Natural;
    let planar = PlanarRibbon::new(&s, &s, end).unwrap();
    assert!(again(&planar).points()[8].distance(planar.points()[8]) < 1e-14);
    assert!(broken(&planar, "s", json!([])) && broken(&planar, "angles", json!([0.0])));

    let tangents: Vec<DVec3> = s.iter().map(|s| tangent(*s)).collect();
    for method in [TangentMethod::Projected, TangentMethod::SphericalSpline] {
        let ribbon = SpatialRibbon::with_method(&s, &tangents, method, end).unwrap();
        let read = again(&ribbon);
        assert_eq!((read.method(), read.end_condition()), (method, end));
        assert!(read.points()[8].distance(ribbon.points()[8]) < 1e-14);
        assert!(broken(&ribbon, "s", json!([])) && broken(&ribbon, "tangents", json!([])));
    }

    let around: Vec<f64> = (0..24).map(|i| f64::from(i) / 24.0).collect();
    let angles: Vec<f64> = around
        .iter()
        .map(|s| s * TAU + 0.1 * (2.0 * s * TAU).sin())
        .collect();
    let closed = ClosedPlanarRibbon::new(&around, &angles, 1.0).unwrap();
    assert!((again(&closed).angle(1.3) - closed.angle(1.3)).abs() < 1e-14);
    assert!(broken(&closed, "turning_rate", json!(1.0)));
    let turning: Vec<DVec3> = angles
        .iter()
        .map(|a| DVec3::new(a.cos(), a.sin(), 0.3 * (2.0 * a).cos()))
        .collect();
    let closed = ClosedSpatialRibbon::new(&around, &turning, 1.0).unwrap();
    assert!(again(&closed).tangent(1.3).distance(closed.tangent(1.3)) < 1e-14);
    let open = CubicSpline::new(&s, &tangents, end).unwrap();
    assert!(broken(&closed, "spline", to_value(open).unwrap()));

    let ribbon = SpatialRibbon::new(&s, &tangents).unwrap();
    let crossings = [[0.1, 0.12], [1.8, 1.83]].map(|s| Crossing { ribbons: [0, 1], s });
    let network = RibbonNetwork::new(vec![ribbon.clone(), ribbon], crossings.to_vec()).unwrap();
    let read = again(&network);
    assert!(
        read.point(1, 0.7)
            .unwrap()
            .distance(network.point(1, 0.7).unwrap())
            < 1e-13
    );
    assert!(broken(&network, "origins", json!([])));
    assert!(broken(
        &network,
        "origins",
        json!([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    ));
    assert!(broken(&network, "ribbons", json!([])));
}

#[test]
fn sensors_and_what_they_amount_to() {
    assert_eq!(again(&Calibration::default()), Calibration::default());
    let calibration = Calibration::new(DVec3::X, DVec3::ONE, DMat3::IDENTITY, 8.0, 2.0).unwrap();
    assert_eq!(again(&calibration), calibration);
    assert!(broken(&calibration, "magnitude", json!(0.0)));
    assert!(broken(&calibration, "matrix", json!(vec![0.0; 9])));
    let world = WorldFields::with_dip(1.08).unwrap();
    assert!(broken(&world, "magnetic", json!([0.0, 0.0, 1.0])));

    let kinds = [SensorKind::Accelerometer, SensorKind::Magnetometer];
    let sensors = (0..8).map(|i| Sensor::new(0.1 * i as f64, kinds[i % 2]));
    let layout = RibbonLayout::new(sensors, world).unwrap();
    let read = again(&layout);
    assert_eq!(read.arc_lengths(), layout.arc_lengths());
    assert!(broken(&layout, "sensors", json!([])));

    let fields = [DVec3::Z, DVec3::new(0.47, 0.0, -0.88)];
    let readings: Vec<DVec3> = (0..8).map(|i| fields[i % 2]).collect();
    let tangents: Tangents = read.tangents(&readings).unwrap();
    let back = again(&tangents);
    assert_eq!(back.values().len(), 8);
    let covariance = |t: &Tangents| t.position_covariance(&t.ribbon().unwrap(), 0.1).unwrap()[7];
    assert!(
        (covariance(&back) - covariance(&tangents))
            .to_cols_array()
            .iter()
            .all(|x| x.abs() < 1e-14)
    );
    assert!(broken(&tangents, "sensitivity", json!([1.0])));
    assert!(broken(&tangents, "values", json!([[2.0, 0.0, 0.0]])));
}

#[test]
fn strips_and_corners() {
    let control = [
        DVec3::ZERO,
        DVec3::X,
        DVec3::new(1.0, 1.0, 0.0),
        DVec3::new(1.0, 1.0, 1.0),
    ];
    let strip = BezierStrip::new(BezierCurve::polynomial(&control).unwrap()).unwrap();
    assert_eq!(again(&strip).sample(0.3), strip.sample(0.3));
    let line = BezierCurve::polynomial(&[DVec3::ZERO, DVec3::X]).unwrap();
    assert!(broken(&strip, "curve", to_value(line).unwrap()));
    let corner = CornerData::new(DVec3::ZERO, DVec3::Z, [DVec3::X, DVec3::Y], [1.0, 2.0])
        .unwrap()
        .with_torsion_difference(0.3);
    assert_eq!(again(&corner), corner);
    assert!(broken(&corner, "normal", json!([0.0, 0.0, 0.0])));
}
