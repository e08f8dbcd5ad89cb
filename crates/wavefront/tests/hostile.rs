//! Input that nobody should give: an error that says what is wrong, and where.

use bezier_mass::BezierCurve;
use wavefront::glam::{DVec2, dvec2};
use wavefront::{
    Code, Error, Fan, FanOptions, Front, FrontTolerance, Interface, Medium, Mode, Model, Source,
    Step,
};

fn medium() -> Medium {
    Medium::isotropic(1.0).unwrap()
}

fn layered(interfaces: Vec<Interface>) -> Result<Model, Error> {
    let media = vec![medium(); interfaces.len() + 1];
    Model::try_new(DVec2::splat(-2.0), DVec2::splat(2.0), media, interfaces)
}

fn flat(height: f64) -> Interface {
    Interface::horizontal(height).unwrap()
}

fn graph(f: impl Fn(f64) -> [f64; 3]) -> Interface {
    Interface::graph(-3.0, 3.0, 30, f).unwrap()
}

#[test]
fn crossing_interfaces_are_refused_with_their_numbers_and_the_place() {
    let wave = |x: f64| [-0.5 + 0.7 * x, 0.7, 0.0];
    let crossing = layered(vec![flat(1.5), flat(0.0), graph(wave)]);
    let Err(Error::InterfacesCross {
        first,
        second,
        place,
    }) = crossing
    else {
        panic!("{crossing:?}");
    };
    assert_eq!((first, second), (1, 2));
    assert!(place.distance(dvec2(0.5 / 0.7, 0.0)) < 1e-9);
    // Two curves, and one of them twice the same.
    let bump = |x: f64| [0.4 - x * x, -2.0 * x, -2.0];
    let Err(Error::InterfacesCross { place, .. }) = layered(vec![graph(bump), graph(wave)]) else {
        panic!("the bump crosses the slope");
    };
    assert!((place.y - (0.4 - place.x * place.x)).abs() < 1e-3);
    assert!((place.y - wave(place.x)[0]).abs() < 1e-3);
}

#[test]
fn an_interface_that_is_none_is_named() {
    let away = layered(vec![flat(1.0), flat(-7.0)]);
    assert!(
        matches!(away, Err(Error::BadInterface { interface: 1, .. })),
        "{away:?}"
    );
    let far = graph(|_| [90.0, 0.0, 0.0]);
    let away = layered(vec![flat(1.0), flat(0.5), far]);
    assert!(
        matches!(away, Err(Error::BadInterface { interface: 2, .. })),
        "{away:?}"
    );
    let shapes = [
        Interface::circle(DVec2::ZERO, 0.0),
        Interface::circle(dvec2(f64::NAN, 0.0), 1.0),
        Interface::line(DVec2::ZERO, DVec2::ZERO),
        Interface::conic([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
        Interface::graph(0.0, 0.0, 3, |_| [0.0; 3]),
        Interface::graph(0.0, 1.0, 0, |_| [0.0; 3]),
        Interface::graph(0.0, 1.0, 3, |_| [f64::INFINITY, 0.0, 0.0]),
        Interface::curve([]),
        Interface::curve([BezierCurve::polynomial(&[DVec2::ONE; 4]).unwrap()]),
        Interface::curve([
            BezierCurve::polynomial(&[dvec2(-3.0, 0.0), dvec2(0.0, 0.0)]).unwrap(),
            BezierCurve::polynomial(&[dvec2(0.1, 0.0), dvec2(3.0, 0.0)]).unwrap(),
        ]),
        Interface::fit_conics(&[(DVec2::ZERO, DVec2::X)], 1),
    ];
    for shape in shapes {
        let error = shape.unwrap_err().at_interface(3);
        assert!(
            matches!(error, Error::BadInterface { interface: 3, .. }),
            "{error}"
        );
        assert!(error.to_string().contains("interface 3"), "{error}");
    }
}

#[test]
fn models_must_have_a_box_and_a_medium_for_each_layer() {
    let build = |low: DVec2, high: DVec2, media: usize| {
        Model::try_new(low, high, vec![medium(); media], vec![flat(0.0)])
    };
    let (low, high) = (DVec2::splat(-1.0), DVec2::ONE);
    assert!(matches!(build(low, high, 1), Err(Error::LayerCount { .. })));
    assert!(matches!(build(low, high, 3), Err(Error::LayerCount { .. })));
    assert!(matches!(build(high, low, 2), Err(Error::OutOfRange { .. })));
    assert!(matches!(
        build(low, DVec2::INFINITY, 2),
        Err(Error::NonFinite { .. })
    ));
}

#[test]
fn sources_codes_and_receivers_are_checked() {
    let model = layered(vec![flat(0.0)]).unwrap();
    let fan = |source: Source, code: Code, options: FanOptions| {
        Fan::new(&model, source, code, options).map(|fan| fan.ray_count())
    };
    let down = Code {
        steps: vec![Step {
            interface: 0,
            mode: Mode::Transmit,
        }],
    };
    let source = Source::point(dvec2(0.1, 1.0));
    let nowhere = Source::point(dvec2(f64::NAN, 1.0));
    let fine = FanOptions::default();
    assert!(matches!(
        fan(nowhere, down.clone(), fine),
        Err(Error::NonFinite { .. })
    ));
    let blind = Source::Point {
        position: DVec2::ONE,
        angles: [1.0, 1.0],
    };
    assert!(matches!(
        fan(blind, down.clone(), fine),
        Err(Error::ZeroDirection { .. })
    ));
    let other = Code {
        steps: vec![Step {
            interface: 4,
            mode: Mode::Reflect,
        }],
    };
    assert!(matches!(
        fan(source.clone(), other, fine),
        Err(Error::BadCode { step: 0, .. })
    ));
    for (rays, accuracy) in [(0, 1e-5), (64, 0.0), (64, f64::NAN)] {
        let options = FanOptions { rays, accuracy };
        assert!(matches!(
            fan(source.clone(), down.clone(), options),
            Err(Error::OutOfRange { .. })
        ));
    }
    // Tiny accuracies end, too.
    let finest = FanOptions {
        rays: 16,
        accuracy: 1e-300,
    };
    assert!(fan(source.clone(), down.clone(), finest).unwrap() > 1000);
    let fan = Fan::new(&model, source, down, fine).unwrap();
    let strange = [
        DVec2::NAN,
        DVec2::INFINITY,
        DVec2::splat(1e300),
        DVec2::splat(-1e300),
    ];
    fan.visit_arrivals(&strange, |_, arrival| assert!(arrival.time > 0.0));
    assert!(fan.arrivals(DVec2::NAN).is_empty());
    // Many receivers at one place.
    let mut heard = 0;
    fan.visit_arrivals(&[dvec2(0.3, -0.5); 100], |_, _| heard += 1);
    assert_eq!(heard, 100);
}

#[test]
fn tolerances_of_fronts_are_checked_and_impossible_ones_end() {
    let model = layered(vec![graph(|x| {
        [0.2 * x.sin(), 0.2 * x.cos(), -0.2 * x.sin()]
    })])
    .unwrap();
    let code = Code {
        steps: vec![Step {
            interface: 0,
            mode: Mode::Reflect,
        }],
    };
    let source = Source::point(dvec2(0.1, 1.0));
    let fan = Fan::new(&model, source, code, FanOptions::default()).unwrap();
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let fronts = fan.fronts(FrontTolerance::time(time));
        assert!(matches!(fronts, Err(Error::OutOfRange { .. })));
    }
    let impossible = fan.fronts(FrontTolerance::time(1e-30));
    assert!(matches!(impossible, Err(Error::NotConverged { .. })));
    let none = |_: f64| Err(Error::Miss { from: DVec2::ZERO });
    let nothing = Front::fit(&medium(), 0, &[0.0, 1.0], none, FrontTolerance::time(1e-3));
    assert!(nothing.is_err());
}
