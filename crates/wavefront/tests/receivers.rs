//! Receivers at places where others give up: on an interface, at the source, on a caustic, at a cusp, in a focus; behind
//! interfaces of every kind, in media of every kind, with codes that bounce.

use std::f64::consts::{PI, TAU};

use bezier_mass::{BezierCurve, MassPoint};
use ph_curves::Bumped;
use wavefront::glam::{DVec2, dvec2};
use wavefront::{
    Code, Fan, FanOptions, FrontTolerance, Interface, Medium, Mode, Model, Source, Step,
};

fn code(steps: &[(usize, Mode)]) -> Code {
    let steps = steps
        .iter()
        .map(|&(interface, mode)| Step { interface, mode });
    Code {
        steps: steps.collect(),
    }
}

fn model(media: &[Medium], interfaces: Vec<Interface>) -> Model {
    let corner = DVec2::splat(4.0);
    Model::try_new(-corner, corner, media.to_vec(), interfaces).unwrap()
}

fn isotropic(speeds: &[f64]) -> Vec<Medium> {
    let media = speeds.iter().map(|speed| Medium::isotropic(*speed));
    media.collect::<Result<_, _>>().unwrap()
}

#[test]
fn a_receiver_on_an_interface_hears_every_wave_there() {
    let wave = |x: f64| [0.3 * x.sin(), 0.3 * x.cos(), -0.3 * x.sin()];
    for (interface, height) in [
        (Interface::horizontal(0.0).unwrap(), 0.0),
        (Interface::graph(-5.0, 5.0, 200, wave).unwrap(), 0.3),
    ] {
        let model = model(&isotropic(&[1.0, 1.3]), vec![interface]);
        let source = dvec2(-0.4, 1.5);
        for steps in [vec![], vec![(0, Mode::Reflect)], vec![(0, Mode::Transmit)]] {
            let fan = Fan::new(
                &model,
                Source::point(source),
                code(&steps),
                FanOptions::default(),
            )
            .unwrap();
            for i in 0..40 {
                let x = -1.0 + 0.05 * f64::from(i) + 0.003;
                let receiver = dvec2(x, height * x.sin());
                let time = source.distance(receiver);
                let arrivals = fan.arrivals(receiver);
                assert!(
                    arrivals.iter().any(|a| (a.time - time).abs() < 1e-8),
                    "{steps:?} at {receiver}: {arrivals:?}"
                );
            }
        }
    }
}

#[test]
fn a_receiver_at_the_source_does_no_harm() {
    let model = model(
        &isotropic(&[1.0, 2.0]),
        vec![Interface::horizontal(0.0).unwrap()],
    );
    let source = dvec2(0.3, 1.0);
    for steps in [vec![], vec![(0, Mode::Reflect)]] {
        let fan = Fan::new(
            &model,
            Source::point(source),
            code(&steps),
            FanOptions::default(),
        );
        let fan = fan.unwrap();
        let arrivals = fan.arrivals(source);
        if steps.is_empty() {
            // All rays start there, and none comes back.
            assert!(arrivals.iter().all(|a| a.time.abs() < 1e-12));
        } else {
            assert_eq!(arrivals.len(), 1);
            assert!((arrivals[0].time - 2.0).abs() < 1e-12);
        }
    }
}

/// Parallel light in a circle: the caustic is a nephroid with its cusp in (1/2, 0).
fn nephroid() -> Model {
    let circle = Interface::circle(DVec2::ZERO, 1.0).unwrap();
    model(&isotropic(&[1.0, 1.0]), vec![circle])
}

fn beam() -> Source {
    Source::Plane {
        ends: [dvec2(-0.3, -0.9), dvec2(-0.3, 0.9)],
        towards: DVec2::X,
    }
}

#[test]
fn at_a_cusp_and_on_a_caustic_the_time_is_right() {
    let model = nephroid();
    let fan = Fan::new(
        &model,
        beam(),
        code(&[(0, Mode::Reflect)]),
        FanOptions::default(),
    )
    .unwrap();
    let cusp = fan.arrivals(dvec2(0.5, 0.0));
    // From -0.3 to the wall and back to 0.5. Three rays fall together there.
    assert!((1..=3).contains(&cusp.len()), "{cusp:?}");
    assert!(cusp.iter().all(|a| (a.time - 1.8).abs() < 1e-9), "{cusp:?}");
    for i in 1..30 {
        let angle = 0.03 * f64::from(i);
        let (hit, thrice) = (DVec2::from_angle(angle), DVec2::from_angle(3.0 * angle));
        let caustic = 0.75 * hit - 0.25 * thrice;
        let time = 0.3 + hit.x + hit.distance(caustic);
        for receiver in [caustic, caustic + 1e-12, caustic - 1e-12] {
            let arrivals = fan.arrivals(receiver);
            assert!(arrivals.len() <= 3);
            assert!(
                arrivals
                    .iter()
                    .all(|a| a.time.is_finite() && !a.tube_width.is_nan()),
                "{arrivals:?}"
            );
            // To one side of the caustic the two rays that touch it are gone.
            let close = arrivals.iter().filter(|a| (a.time - time).abs() < 1e-6);
            assert!(close.count() <= 2);
        }
        // To one side of it both are there, to the other none; the third has nothing to do with it.
        let across = 1e-4 * (caustic - hit).normalize().perp();
        let heard = |receiver: DVec2| fan.arrivals(receiver).len();
        if i > 3 {
            let places = [caustic + across, caustic - across];
            let mut counts = places.map(heard);
            counts.sort_unstable();
            assert_eq!(counts, [1, 3], "at {angle}");
        }
    }
}

#[test]
fn in_a_focus_all_that_arrives_has_one_time() {
    let (a, b) = (2.0_f64, 1.2);
    let focus = dvec2((a * a - b * b).sqrt(), 0.0);
    let ellipse = Interface::ellipse(DVec2::ZERO, a * DVec2::X, b * DVec2::Y).unwrap();
    let model = model(&isotropic(&[1.0, 1.0]), vec![ellipse]);
    let fan = Fan::new(
        &model,
        Source::point(-focus),
        code(&[(0, Mode::Reflect)]),
        FanOptions::default(),
    )
    .unwrap();
    for receiver in [focus, focus + 1e-13, focus - 1e-10] {
        for arrival in fan.arrivals(receiver) {
            assert!((arrival.time - 2.0 * a).abs() < 1e-9, "{arrival:?}");
        }
    }
    // Off the focus there are two, on the line through both.
    assert!(!fan.arrivals(focus + 0.05).is_empty());
}

/// The same level line, in every form that an interface can have.
fn lines() -> Vec<Interface> {
    let ends = [dvec2(-9.0, 0.0), dvec2(9.0, 0.0)];
    let weights = [1.0, 2.5, 1.0];
    let rational = [-9.0, 0.0, 9.0].iter().zip(weights);
    let rational = rational.map(|(x, weight)| MassPoint::point(dvec2(*x, 0.0), weight));
    let along: Vec<_> = (-9..=9)
        .map(|x| (dvec2(f64::from(x), 0.0), DVec2::X))
        .collect();
    vec![
        Interface::line(dvec2(3.0, 0.0), -DVec2::X).unwrap(),
        Interface::curve([BezierCurve::polynomial(&ends).unwrap()]).unwrap(),
        Interface::curve([BezierCurve::polynomial(&ends).unwrap().elevated_to(9)]).unwrap(),
        Interface::curve([BezierCurve::new(rational.collect()).unwrap()]).unwrap(),
        Interface::graph(-9.0, 9.0, 7, |_| [0.0; 3]).unwrap(),
        Interface::fit_conics(&along, 3).unwrap(),
    ]
}

#[test]
fn every_form_of_an_interface_gives_the_same_times() {
    let media = [
        Medium::isotropic(1.0).unwrap(),
        Medium::elliptical(1.7, 1.2, 0.4).unwrap(),
        Medium::rational(Bumped { height: 0.04 }.dual().unwrap()),
    ];
    let bounce = vec![(0, Mode::Transmit), (1, Mode::Reflect), (0, Mode::Transmit)];
    for (above, below) in [(0, 1), (1, 0), (0, 2), (2, 1)] {
        let mut expected: Option<Vec<Vec<f64>>> = None;
        for line in lines() {
            let floor = Interface::horizontal(-1.5).unwrap();
            let three = [media[above].clone(), media[below].clone(), media[0].clone()];
            let model = model(&three, vec![line, floor]);
            let fan = |steps: &[(usize, Mode)]| {
                let source = Source::point(dvec2(0.2, 1.1));
                Fan::new(&model, source, code(steps), FanOptions::default()).unwrap()
            };
            let (down, back) = (fan(&bounce[..1]), fan(&bounce));
            let mut times = Vec::new();
            for i in 0..12 {
                let x = -1.5 + 0.27 * f64::from(i);
                for arrivals in [down.arrivals(dvec2(x, -0.7)), back.arrivals(dvec2(x, 0.6))] {
                    times.push(arrivals.iter().map(|a| a.time).collect::<Vec<_>>());
                }
            }
            assert!(times.iter().all(|found| !found.is_empty()));
            match &expected {
                None => expected = Some(times),
                Some(expected) => {
                    for (found, known) in times.iter().zip(expected) {
                        assert_eq!(found.len(), known.len());
                        for (a, b) in found.iter().zip(known) {
                            assert!((a - b).abs() < 1e-9, "{a} {b}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn long_codes_end_and_count_their_way() {
    let interfaces = vec![
        Interface::horizontal(0.0).unwrap(),
        Interface::horizontal(-1.0).unwrap(),
    ];
    let model = model(&isotropic(&[1.0, 1.5, 1.0]), interfaces);
    for bounces in [1, 5, 25, 101] {
        // Down, to and fro between the two interfaces, and out below.
        let mut steps = vec![(0, Mode::Transmit)];
        for i in 0..bounces - 1 {
            steps.push((1 - i % 2, Mode::Reflect));
        }
        steps.push((1, Mode::Transmit));
        let source = dvec2(0.0, 1.0);
        let fan = Fan::new(
            &model,
            Source::point(source),
            code(&steps),
            FanOptions::default(),
        );
        let arrivals = fan.unwrap().arrivals(dvec2(0.0, -2.0));
        assert_eq!(arrivals.len(), 1, "{bounces}");
        let time = 2.0 + bounces as f64 / 1.5;
        assert!((arrivals[0].time - time).abs() < 1e-12 * time);
    }
    // Back into the same interface at once: nothing comes, and nothing breaks.
    let twice = code(&[(0, Mode::Reflect), (0, Mode::Reflect)]);
    let fan = Fan::new(
        &model,
        Source::point(DVec2::Y),
        twice,
        FanOptions::default(),
    )
    .unwrap();
    assert!(fan.arrivals(dvec2(0.3, 0.5)).is_empty());
}

#[test]
fn a_whispering_gallery_is_heard_inside_a_circle() {
    // n reflections along a circle from its inside: chords of equal length, through a regular polygon.
    let model = nephroid();
    for count in [2, 3, 6] {
        let source = dvec2(0.0, -0.8);
        let steps = vec![(0, Mode::Reflect); count];
        let fan = Fan::new(
            &model,
            Source::point(source),
            code(&steps),
            FanOptions::default(),
        );
        let fan = fan.unwrap();
        for arrival in fan.arrivals(dvec2(0.1, 0.75)) {
            let trace = fan.trace(arrival.parameter).unwrap();
            // Fermat, without derivatives: the sum of the chords is the time.
            let mut way = vec![source];
            way.extend(trace.impacts.iter().map(|impact| impact.point));
            way.push(dvec2(0.1, 0.75));
            let length: f64 = way.windows(2).map(|ends| ends[0].distance(ends[1])).sum();
            assert!((length - arrival.time).abs() < 1e-9);
        }
        assert!(fan.arrivals(dvec2(0.1, 0.75)).len() >= 2);
        assert!(fan.fronts(FrontTolerance::time(1e-6)).is_ok());
    }
}

#[test]
fn half_of_the_directions_and_turned_ranges_are_sources_too() {
    let model = model(
        &isotropic(&[1.0, 2.0]),
        vec![Interface::horizontal(0.0).unwrap()],
    );
    for angles in [
        [PI, TAU],
        [TAU, PI],
        [-PI, 0.0],
        [PI + 1e-9, PI - 1e-9 + TAU],
    ] {
        let source = Source::Point {
            position: dvec2(0.0, 1.0),
            angles,
        };
        let fan = Fan::new(
            &model,
            source,
            code(&[(0, Mode::Reflect)]),
            FanOptions::default(),
        );
        let arrivals = fan.unwrap().arrivals(dvec2(0.5, 1.0));
        assert_eq!(arrivals.len(), 1, "{angles:?}");
        assert!((arrivals[0].time - 0.5_f64.hypot(2.0)).abs() < 1e-12);
    }
}
