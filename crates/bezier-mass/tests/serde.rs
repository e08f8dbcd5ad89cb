//! Values survive being written and read, and what could not have been constructed cannot be read.

#![cfg(feature = "serde")]

use bezier_mass::glam::dvec2;
use bezier_mass::{
    BSplineCurve, BezierCurve, BezierPatch, Biquadratic, Homography, Knots, MassPoint, Quadratic,
};
use serde_json::{from_str, to_string};

#[test]
fn values_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let (p, v) = (
        MassPoint::point(dvec2(1.0, 2.0), 0.5),
        MassPoint::vector(dvec2(3.0, -1.0)),
    );
    let quadratic = Quadratic::new([p, v, p])?;
    assert_eq!(
        from_str::<Quadratic<_>>(&to_string(&quadratic)?)?,
        quadratic
    );
    let curve = BezierCurve::from(quadratic);
    assert_eq!(from_str::<BezierCurve<_>>(&to_string(&curve)?)?, curve);
    let patch = Biquadratic::new([[p, v, p], [v, p, p], [p, p, v]])?;
    assert_eq!(from_str::<Biquadratic<_>>(&to_string(&patch)?)?, patch);
    let patch = BezierPatch::from(patch);
    assert_eq!(from_str::<BezierPatch<_>>(&to_string(&patch)?)?, patch);
    for knots in [
        Knots::clamped_uniform(2, 3)?,
        Knots::periodic_uniform(2, 3)?,
    ] {
        let spline = BSplineCurve::new(knots, vec![p, v, p])?;
        assert_eq!(from_str::<BSplineCurve<_>>(&to_string(&spline)?)?, spline);
    }
    let homography = Homography::new(1.0, 2.0, 4.0, 3.0)?;
    assert_eq!(
        from_str::<Homography>(&to_string(&homography)?)?,
        homography
    );
    let semicircle = Quadratic::new([
        MassPoint::point(dvec2(1.0, 0.0), 1.0),
        MassPoint::vector(dvec2(0.0, 1.0)),
        MassPoint::point(dvec2(-1.0, 0.0), 1.0),
    ])?;
    let circle = semicircle.conic();
    assert_eq!(
        from_str::<bezier_mass::Conic>(&to_string(&circle)?)?,
        circle
    );
    Ok(())
}

#[test]
fn what_is_not_valid_is_refused() {
    assert!(from_str::<BezierCurve<f64>>("[]").is_err());
    assert!(from_str::<BezierPatch<f64>>("[[], []]").is_err());
    assert!(
        from_str::<Knots>(r#"{"degree": 2, "knots": [0, 1, 0.5, 2, 3, 4], "periodic": false}"#)
            .is_err()
    );
    assert!(from_str::<Knots>(r#"{"degree": 9, "knots": [0, 1], "periodic": true}"#).is_err());
    let knots = r#"{"degree": 1, "knots": [0, 0, 1, 1], "periodic": false}"#;
    assert!(
        from_str::<BSplineCurve<f64>>(&format!(r#"{{"knots": {knots}, "control": []}}"#)).is_err()
    );
    assert!(from_str::<Homography>("[1, 2, 2, 4]").is_err());
    assert!(from_str::<bezier_mass::Parameter>("[0, 0]").is_err());
}
