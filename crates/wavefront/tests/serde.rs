//! Values that are written and read again, and texts that nobody should write.

#![cfg(feature = "serde")]

use std::fmt::Debug;

use bezier_mass::BezierCurve;
use ph_curves::Bumped;
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Value, from_value, json, to_value};
use wavefront::glam::{DMat3, DVec2, DVec3, dvec2};
use wavefront::{
    Code, Cut, DualSurface, Error, Fan, FanOptions, Front, FrontTolerance, Interface, Medium,
    Mirror, Mode, Model, SampledSurface, Source, Step,
};

/// A value comes back as it was. Through a tree of values, where numbers keep all their digits.
fn comes_back<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    let written = to_value(value).unwrap();
    assert_eq!(&from_value::<T>(written).unwrap(), value);
}

fn media() -> Vec<Medium> {
    vec![
        Medium::isotropic(1.7).unwrap(),
        Medium::elliptical(1.3, 0.8, 0.3).unwrap(),
        Medium::rational(Bumped { height: 0.04 }.dual().unwrap()),
        Medium::isotropic(0.3).unwrap(),
        Medium::isotropic(2.0).unwrap(),
    ]
}

fn interfaces() -> Vec<Interface> {
    let wave = |x: f64| [-1.0 + 0.1 * x.sin(), 0.1 * x.cos(), -0.1 * x.sin()];
    vec![
        Interface::line(dvec2(0.0, 1.0), dvec2(1.0, 0.03)).unwrap(),
        Interface::conic([0.01, 0.0, 0.0, 0.0, 1.0, 0.0]).unwrap(),
        Interface::graph(-4.0, 4.0, 20, wave).unwrap(),
        Interface::ellipse(dvec2(0.3, -2.2), DVec2::X, 0.4 * DVec2::Y).unwrap(),
    ]
}

fn model() -> Model {
    Model::try_new(DVec2::splat(-3.0), DVec2::splat(3.0), media(), interfaces()).unwrap()
}

#[test]
fn models_and_their_parts_come_back() {
    for medium in media() {
        comes_back(&medium);
    }
    for interface in interfaces() {
        comes_back(&interface);
    }
    comes_back(&model());
}

#[test]
fn waves_come_back() {
    let model = model();
    let step = Step {
        interface: 0,
        mode: Mode::Transmit,
    };
    let code = Code { steps: vec![step] };
    comes_back(&code);
    let curve = BezierCurve::polynomial(&[DVec2::ZERO, DVec2::ONE, DVec2::X]).unwrap();
    let source = Source::point(dvec2(0.2, 2.0));
    let fan = Fan::new(&model, source.clone(), code, FanOptions::default()).unwrap();
    let fronts = fan.fronts(FrontTolerance::time(1e-6)).unwrap();
    assert!(!fronts.is_empty());
    let sources = [
        source,
        Source::Plane {
            ends: [DVec2::ZERO, DVec2::X],
            towards: DVec2::Y,
        },
        Source::Reflector { curve, left: true },
        Source::Front(fronts[0].clone()),
    ];
    for source in &sources {
        comes_back(source);
    }
    for front in &fronts {
        comes_back(front);
        for piece in front.pieces() {
            comes_back(piece);
        }
    }
    assert!(fan.cuts().count() > 0);
    for cut in fan.cuts() {
        comes_back(cut);
    }
    for trace in fan.traces().take(3) {
        comes_back(trace);
    }
    for arrival in fan.arrivals(dvec2(0.1, 0.5)) {
        comes_back(&arrival);
    }
}

#[test]
fn what_is_in_space_comes_back() {
    let axes = [2.0 * DVec3::X, DVec3::Y, 0.5 * DVec3::Z];
    let ellipsoid = DualSurface::ellipsoid(DVec3::ONE, axes).unwrap();
    comes_back(&ellipsoid.offset(0.7));
    comes_back(&DualSurface::sphere(DVec3::ONE, 0.2).unwrap());
    comes_back(&Mirror::quadric(DMat3::IDENTITY, DVec3::X, -4.0).unwrap());
    let grid = ellipsoid.sample(3, 4, |u, v| DVec3::new(u, v, 1.0));
    comes_back(&grid.unwrap());
}

#[test]
fn other_reasons_keep_their_words() {
    let cut = Cut {
        parameter: 0.3,
        place: DVec2::NAN,
        reason: Error::ZeroDirection { what: "a tangent" },
    };
    let back: Cut = from_value(to_value(&cut).unwrap()).unwrap();
    assert!(back.place.is_nan());
    assert_eq!(back.reason.to_string(), cut.reason.to_string());
}

fn refused<T: DeserializeOwned + Debug>(text: Value) {
    let read = from_value::<T>(text.clone());
    assert!(read.is_err(), "{text} was read as {read:?}");
}

#[test]
fn impossible_values_are_not_read() {
    refused::<Medium>(json!({"isotropic": {"speed": -1.0}}));
    refused::<Medium>(json!({"elliptical": {"semi_axes": [1.0, 0.0], "angle": 0.0}}));
    refused::<Medium>(json!({"rational": {"arcs": []}}));
    refused::<Interface>(json!({"line": {"point": [0.0, 0.0], "direction": [0.0, 0.0]}}));
    refused::<Interface>(json!({"curve": {"pieces": []}}));
    let nothing = json!({"centre": [0.0, 0.0], "form": [0.0, 0.0, 0.0, 0.0], "linear": [1.0, 0.0], "constant": 1.0});
    refused::<Interface>(json!({ "conic": nothing }));
    refused::<Source>(json!({"point": {"position": [0.0, 0.0], "angles": [1.0, 1.0]}}));
    refused::<Source>(json!({"plane": {"ends": [[0.0, 0.0], [1.0, 0.0]], "towards": [1.0, 0.0]}}));

    // A model is checked as a whole.
    let mut crossing = to_value(model()).unwrap();
    crossing["interfaces"][1] = crossing["interfaces"][0].clone();
    refused::<Model>(crossing);
    let mut poor = to_value(model()).unwrap();
    poor["media"] = json!([{"isotropic": {"speed": 1.0}}]);
    refused::<Model>(poor);
    let mut empty = to_value(model()).unwrap();
    empty["high"] = json!([-9.0, -9.0]);
    refused::<Model>(empty);

    let front = Front::from_point(&media()[0], 0, DVec2::ONE, [0.0, 1.0]).unwrap();
    for (key, value) in [
        ("error", json!(-1.0)),
        ("medium", to_value(&media()[2]).unwrap()),
        (
            "pieces",
            json!([{"shape": {"straight": {"ends": [[0.0, 0.0], [1.0, 0.0]], "normal": [0.0, 2.0]}}}]),
        ),
    ] {
        let mut text = to_value(&front).unwrap();
        text[key] = value;
        refused::<Front>(text);
    }

    let sphere = json!({"centre": [0.0, 0.0, 0.0], "half_axes": [1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0], "distance": 0.0});
    refused::<DualSurface>(sphere);
    let ray = json!({"point": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0]});
    refused::<SampledSurface>(json!({"columns": 2, "rays": [ray, ray, ray]}));
    refused::<SampledSurface>(json!({"columns": 0, "rays": []}));
    let long = json!({"point": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 3.0]});
    refused::<SampledSurface>(json!({"columns": 2, "rays": [ray, ray, ray, long]}));
}
