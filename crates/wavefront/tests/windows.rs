//! Windows of rays: none is missed, however narrow, and where one may be it is said.

use std::f64::consts::TAU;

use wavefront::glam::{DVec2, dvec2};
use wavefront::{Code, Fan, FanOptions, Interface, Medium, Mode, Model, Source, Step};

fn code(steps: &[(usize, Mode)]) -> Code {
    let steps = steps
        .iter()
        .map(|&(interface, mode)| Step { interface, mode });
    Code {
        steps: steps.collect(),
    }
}

fn model(media: &[Medium], interfaces: Vec<Interface>) -> Model {
    let corner = DVec2::splat(2.0);
    Model::try_new(-corner, corner, media.to_vec(), interfaces).unwrap()
}

fn fan(model: &Model, source: DVec2, code: Code) -> Fan<'_> {
    Fan::new(model, Source::point(source), code, FanOptions::default()).unwrap()
}

#[test]
fn an_obstacle_of_a_hundred_thousandth_is_seen() {
    let medium = Medium::isotropic(1.0).unwrap();
    let place = dvec2(0.3137, -0.271);
    let shapes = [
        Interface::circle(place, 2e-5).unwrap(),
        Interface::ellipse(place, dvec2(3e-5, 1e-5), dvec2(0.0, 1e-5)).unwrap(),
    ];
    for shape in shapes {
        let model = model(&[medium.clone(), medium.clone()], vec![shape]);
        let source = dvec2(-1.1, 0.9);
        let fan = fan(&model, source, code(&[(0, Mode::Reflect)]));
        let windows: Vec<_> = fan.illuminated().collect();
        let cuts: Vec<_> = fan.cuts().take(6).collect();
        assert_eq!(windows.len(), 1, "{windows:?} {cuts:?}");
        assert!(fan.unsearched().is_empty(), "{:?}", fan.unsearched());
        // The window is as wide as the obstacle is seen, and its ends are rays that touch it.
        let seen = windows[0][1] - windows[0][0];
        assert!(seen > 1e-5 / TAU && seen < 4e-5 / TAU, "{seen}");
    }
}

#[test]
fn a_slit_in_a_hill_lets_rays_through() {
    // A steep notch, as wide as a ten thousandth of the model, in a mirror that is flat elsewhere.
    let medium = Medium::isotropic(1.0).unwrap();
    let (centre, width, depth) = (0.377, 2e-4, 4e-4);
    let points = [
        dvec2(-3.0, -1.0),
        dvec2(centre - width, -1.0),
        dvec2(centre, -1.0 - depth),
        dvec2(centre + width, -1.0),
        dvec2(3.0, -1.0),
    ];
    let pieces = points
        .windows(2)
        .map(|ends| bezier_mass::BezierCurve::polynomial(ends).unwrap());
    let model = model(
        &[medium.clone(), medium],
        vec![Interface::curve(pieces).unwrap()],
    );
    let source = dvec2(0.2, 1.0);
    let fan = fan(&model, source, code(&[(0, Mode::Reflect)]));
    // Each side of the notch is a window of its own, next to those of the plain.
    let hits = |low: f64, high: f64| {
        fan.traces()
            .filter(|trace| (low..high).contains(&trace.impacts[0].point.x))
            .count()
    };
    assert!(hits(centre - width, centre) > 1 && hits(centre, centre + width) > 1);
}

#[test]
fn flat_layers_are_searched_to_the_end() {
    let media = [1.0, 2.0, 1.5].map(|speed| Medium::isotropic(speed).unwrap());
    let tilted = Medium::elliptical(1.4, 0.9, 0.4).unwrap();
    let lines = || {
        vec![
            Interface::line(dvec2(0.0, 0.4), dvec2(1.0, 0.05)).unwrap(),
            Interface::horizontal(-0.5).unwrap(),
        ]
    };
    let (down, back) = (Mode::Transmit, Mode::Reflect);
    for middle in [media[1].clone(), tilted] {
        let model = model(&[media[0].clone(), middle, media[2].clone()], lines());
        for steps in [
            vec![(0, down)],
            vec![(0, back)],
            vec![(0, down), (1, down)],
            vec![(0, down), (1, back), (0, down)],
            vec![(0, down), (1, back), (0, back), (1, down)],
        ] {
            let fan = fan(&model, dvec2(0.1, 1.1), code(&steps));
            assert!(fan.ray_count() > 0);
            assert!(
                fan.unsearched().is_empty(),
                "{steps:?} {:?}",
                fan.unsearched()
            );
        }
    }
}

/// What dense shooting finds lies in the fan's windows, unless it is in a stretch that is said to be unsearched.
#[test]
fn dense_shooting_finds_no_other_windows() {
    let mut random = variation::sets::SplitMix64::new(11);
    let mut between = move |low: f64, high: f64| low + (high - low) * random.unit();
    let mut windows = 0;
    for number in 0..40 {
        let mut wave = |level: f64| {
            let (a, k, phase) = (between(0.0, 0.25), between(1.0, 9.0), between(0.0, TAU));
            Interface::graph(-5.0, 5.0, 160, |x| {
                let (sin, cos) = (k * x + phase).sin_cos();
                [level + a * sin, a * k * cos, -a * k * k * sin]
            })
            .unwrap()
        };
        let interfaces = vec![wave(0.4), wave(-0.6)];
        let speed = between(0.7, 2.0);
        let media = [
            Medium::isotropic(1.0).unwrap(),
            Medium::elliptical(speed, speed * between(0.8, 1.2), 0.5).unwrap(),
            Medium::isotropic(1.3).unwrap(),
        ];
        let model = model(&media, interfaces);
        let source = dvec2(between(-1.0, 1.0), 1.2);
        let layer = model.layer_at(source);
        for code in model.codes(layer, 2) {
            let fan = fan(&model, source, code.clone());
            let inside = |t: f64| {
                let slack = 2e-6;
                let mut known = fan.illuminated().chain(fan.unsearched().iter().copied());
                known.any(|[start, end]| t > start - slack && t < end + slack)
            };
            windows += fan.illuminated().count();
            for i in 0..4000 {
                let t = (f64::from(i) + 0.5) / 4000.0;
                assert!(
                    fan.trace(t).is_err() || inside(t),
                    "model {number}, {code:?}: the ray {t} is in no window"
                );
            }
        }
    }
    assert!(windows > 200, "{windows}");
}

#[test]
fn curved_sources_say_that_they_are_searched_at_some_places_only() {
    let medium = Medium::isotropic(1.0).unwrap();
    let place = dvec2(0.3137, -0.271);
    let obstacle = Interface::circle(place, 1e-5).unwrap();
    let model = model(&[medium.clone(), medium], vec![obstacle]);
    let curve =
        bezier_mass::BezierCurve::polynomial(&[dvec2(-1.0, 1.0), dvec2(0.0, 1.2), DVec2::ONE]);
    let source = Source::Reflector {
        curve: curve.unwrap(),
        left: false,
    };
    let code = code(&[(0, Mode::Reflect)]);
    let fan = Fan::new(&model, source, code, FanOptions::default()).unwrap();
    let unsearched: f64 = fan
        .unsearched()
        .iter()
        .map(|[start, end]| end - start)
        .sum();
    let found = fan.illuminated().count() > 0;
    assert!(found || unsearched > 0.9, "{unsearched}");
}
