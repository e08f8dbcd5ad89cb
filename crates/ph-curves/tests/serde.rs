//! Values that are written and read again, and texts that nobody should write.

#![cfg(feature = "serde")]

use std::fmt::Debug;

use bezier_mass::BezierCurve;
use ph_curves::{
    Approximation, ArcSpline, CubicPath, CurvatureElement, DualCurve, EvolutePolygon, G1Ends,
    LineElement, PhSpline, PolynomialPh, RationalPath, Rosette, Segment, Side, SplineEnds,
    approximate,
    glam::{DVec2, dvec2},
};
use serde_json::{Value, from_value, json, to_value};

/// Whether the constructors refuse what stands here.
fn is_refused<T: serde::de::DeserializeOwned>(text: Value) -> bool {
    from_value::<T>(text).is_err()
}

/// A value comes back as it was. Through a tree of values, where numbers keep all their digits.
fn comes_back<T: serde::Serialize + serde::de::DeserializeOwned + PartialEq + Debug>(value: &T) {
    let written = to_value(value).unwrap();
    assert_eq!(&from_value::<T>(written).unwrap(), value);
}

const POINTS: [DVec2; 5] = [
    dvec2(0.0, 0.0),
    dvec2(4.0, 1.0),
    dvec2(3.0, 5.0),
    dvec2(-1.0, 3.0),
    dvec2(-3.0, -1.0),
];

#[test]
fn values_come_back() {
    for closed in [false, true] {
        let path = CubicPath::through(&POINTS, closed).unwrap();
        comes_back(&path);
        comes_back(&path.reverse());
        for how in [
            Approximation::within(1e-4),
            Approximation::fewest(1e-6),
            Approximation::quartics(1e-3),
        ] {
            let found = approximate(&path, &how).unwrap();
            comes_back(&found);
            comes_back(&found.spline.offset(3.0).unwrap());
        }
        for part in approximate(&path, &Approximation::within(1e-4))
            .unwrap()
            .spline
            .trimmed_offset(-0.9)
            .unwrap()
        {
            comes_back(&part);
        }
        comes_back(&CubicPath::polyline(&POINTS, closed).unwrap());
    }
    let polygon = CubicPath::polyline(&POINTS, true).unwrap();
    let found = approximate(&polygon, &Approximation::within(1e-4)).unwrap();
    comes_back(&found.spline.offset(-0.5).unwrap());
    let spline = PhSpline::interpolate(&POINTS, SplineEnds::Closed).unwrap();
    comes_back(&spline);
    comes_back(&spline.spans()[1]);
    comes_back(&RationalPath::new(vec![BezierCurve::polynomial(&POINTS).unwrap()]).unwrap());
    let element = CurvatureElement::new(dvec2(0.1, 0.2), dvec2(0.3, 0.7), -2.0).unwrap();
    comes_back(&element);
    let end = LineElement::new(DVec2::Y, dvec2(-0.4, 0.9)).unwrap();
    comes_back(&G1Ends::new(element.line(), end).unwrap());
    comes_back(&Segment::new(dvec2(0.1, 0.2), dvec2(0.4, 0.9)).unwrap());
    comes_back(&Side::Before);
    let oval = EvolutePolygon::try_new(&[dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.4, 0.9)])
        .and_then(|polygon| polygon.rosette(4.0))
        .unwrap();
    comes_back(&oval);
}

#[test]
fn invalid_values_are_refused() {
    assert!(is_refused::<PhSpline>(json!([])));
    assert!(is_refused::<PhSpline>(json!({"spans": [], "lengths": []})));
    assert!(is_refused::<CubicPath>(
        json!({"cubics": [], "closed": true})
    ));
    let line = |a: f64, b: f64| [[a, 0.0], [a, 1.0], [b, 1.0], [b, 0.0]];
    assert!(is_refused::<CubicPath>(
        json!({"cubics": [line(0.0, 1.0), line(2.0, 3.0)], "closed": false})
    ));
    assert!(is_refused::<RationalPath>(json!([])));
    assert!(is_refused::<Rosette<4>>(json!([])));
    assert!(is_refused::<PolynomialPh>(
        json!({"start": [0.0, 0.0], "factor": [1.0], "preimage": []})
    ));
    assert!(is_refused::<PolynomialPh>(
        json!({"start": [0.0, 0.0], "factor": [1.0, -1.0], "preimage": [[1.0, 0.0]]})
    ));
    let element = |normal: [f64; 2], radius: f64| json!({"line": {"point": [1.0, 2.0], "normal": normal}, "radius": radius});
    assert!(is_refused::<CurvatureElement>(element([0.0, 0.0], 1.0)));
    assert!(is_refused::<CurvatureElement>(element([1.0, 0.0], 0.0)));
    let long: CurvatureElement = from_value(element([5.0, 0.0], 1.0)).unwrap();
    assert_eq!(long.normal(), DVec2::X);
    let facing = json!({"point": [1.0, 2.0], "normal": [1.0, 0.0]});
    assert!(is_refused::<G1Ends>(json!([facing, facing])));
    assert!(is_refused::<Segment>(
        json!({"start": [0.0, 0.0], "end": [1.0, 0.0], "normal": [0.0, 0.0]})
    ));
    assert!(is_refused::<DualCurve>(json!([
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0]
    ])));
}

#[test]
fn joints_fit_the_pieces() {
    let path = CubicPath::polyline(&POINTS[..3], false).unwrap();
    let spline = approximate(&path, &Approximation::within(1e-4))
        .unwrap()
        .spline;
    let text = to_value(&spline).unwrap();
    let with = |key: &str, value: Value| {
        let mut text = text.clone();
        text[key] = value;
        text
    };
    assert!(is_refused::<ArcSpline>(with("pieces", json!([]))));
    assert!(is_refused::<ArcSpline>(with("joints", json!([]))));
    assert!(is_refused::<ArcSpline>(with("closed", json!(true))));
    let mut swapped = spline.pieces().to_vec();
    swapped.reverse();
    assert!(is_refused::<ArcSpline>(with(
        "pieces",
        to_value(&swapped).unwrap()
    )));
}
