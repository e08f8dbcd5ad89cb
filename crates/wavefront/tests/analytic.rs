//! Cases with answers in closed form.

use std::f64::consts::{FRAC_PI_2, PI};

use wavefront::glam::{DVec2, dvec2};
use wavefront::{
    Code, Error, Fan, FanOptions, FrontTolerance, Interface, Medium, Mode, Model, Source, Step,
    first_arrival, section, travel_time_table,
};

/// What the crate promises where it is exact.
const EXACT: f64 = 1e-12;

fn model(interfaces: Vec<Interface>, speeds: &[f64]) -> Model {
    model_of_size(20.0, interfaces, speeds)
}

fn model_of_size(size: f64, interfaces: Vec<Interface>, speeds: &[f64]) -> Model {
    let media = speeds
        .iter()
        .map(|speed| Medium::isotropic(*speed).unwrap());
    let corner = DVec2::splat(size);
    Model::try_new(-corner, corner, media.collect(), interfaces).unwrap()
}

fn fan<'m>(model: &'m Model, source: Source, steps: &[(usize, Mode)]) -> Fan<'m> {
    let steps = steps
        .iter()
        .map(|&(interface, mode)| Step { interface, mode });
    let code = Code {
        steps: steps.collect(),
    };
    Fan::new(model, source, code, FanOptions::default()).unwrap()
}

#[test]
fn a_plane_mirror_shows_the_image_source() {
    let mirror = Interface::line(dvec2(0.0, -1.0), dvec2(1.0, 0.3)).unwrap();
    let model = model(vec![mirror], &[1.7, 1.7]);
    let source = dvec2(0.4, 1.2);
    let normal = dvec2(1.0, 0.3).perp().normalize();
    let image = source - 2.0 * normal.dot(source - dvec2(0.0, -1.0)) * normal;
    let fan = fan(&model, Source::point(source), &[(0, Mode::Reflect)]);
    for i in 0..40 {
        let receiver = dvec2(-3.0 + 0.15 * f64::from(i), 3.0);
        let arrivals = fan.arrivals(receiver);
        assert_eq!(arrivals.len(), 1);
        let time = receiver.distance(image) / 1.7;
        assert!((arrivals[0].time / time - 1.0).abs() < EXACT);
        // The tube of a point source is as wide as the ray is long, per radian.
        let width = std::f64::consts::TAU * receiver.distance(image);
        assert!((arrivals[0].tube_width / width - 1.0).abs() < EXACT);
        assert_eq!(arrivals[0].caustics, 0);
    }
}

#[test]
fn a_parabola_makes_a_plane_wave_of_its_focus() {
    let focus = 0.7;
    let parabola = Interface::conic([1.0, 0.0, 0.0, 0.0, -4.0 * focus, 0.0]).unwrap();
    let model = model(vec![parabola], &[1.0, 1.0]);
    let source = Source::point(dvec2(0.0, focus));
    let fan = fan(&model, source, &[(0, Mode::Reflect)]);
    for i in 0..20 {
        let receiver = dvec2(-1.9 + 0.2 * f64::from(i), 3.0);
        let times = fan.arrivals(receiver);
        assert!(
            times
                .iter()
                .any(|a| (a.time / (3.0 + focus) - 1.0).abs() < EXACT)
        );
    }
    for front in fan.fronts(FrontTolerance::time(1e-9)).unwrap() {
        assert!(front.error() < 1e-9);
        assert!(
            front.propagated(0.0).count() == 0,
            "a plane wave has no arcs"
        );
    }
}

#[test]
fn an_ellipse_collects_one_focus_in_the_other() {
    let (a, b) = (2.0_f64, 1.2);
    let focus = dvec2((a * a - b * b).sqrt(), 0.0);
    let ellipse = Interface::ellipse(DVec2::ZERO, DVec2::X * a, DVec2::Y * b).unwrap();
    let model = model(vec![ellipse], &[1.0, 1.0]);
    let fan = fan(&model, Source::point(-focus), &[(0, Mode::Reflect)]);
    for trace in fan.traces() {
        let ray = trace.last().unwrap();
        assert!((ray.time_at(focus) - 2.0 * a).abs() < EXACT);
        assert!(ray.caustic_point(&model.media()[0]).distance(focus) < 1e-11);
    }
}

#[test]
fn circles_have_the_cardioid_and_the_nephroid() {
    let circle = || Interface::circle(DVec2::ZERO, 1.0).unwrap();
    let model = model(vec![circle()], &[1.0, 1.0]);
    // A source on the circle: the place of reflection at the angle t from the axis through the source.
    let source = Source::Point {
        position: dvec2(-1.0, 0.0),
        angles: [-1.4, 1.4],
    };
    let cardioid = |t: f64| {
        dvec2(
            2.0 * t.cos() - (2.0 * t).cos(),
            2.0 * t.sin() - (2.0 * t).sin(),
        ) / 3.0
    };
    check_caustic(&fan(&model, source, &[(0, Mode::Reflect)]), cardioid);
    let beam = Source::Plane {
        ends: [dvec2(0.0, -0.99), dvec2(0.0, 0.99)],
        towards: DVec2::X,
    };
    let nephroid = |t: f64| {
        dvec2(
            0.75 * t.cos() - 0.25 * (3.0 * t).cos(),
            0.75 * t.sin() - 0.25 * (3.0 * t).sin(),
        )
    };
    check_caustic(&fan(&model, beam, &[(0, Mode::Reflect)]), nephroid);
}

/// The rays' caustic points, the cubics of the fronts and the cusps of the fronts against a curve over the angle of the hit.
fn check_caustic(fan: &Fan<'_>, curve: impl Fn(f64) -> DVec2) {
    let medium = &fan.model().media()[0];
    for trace in fan.traces() {
        let hit = trace.impacts[0].point.to_angle();
        let found = trace.last().unwrap().caustic_point(medium);
        assert!(found.distance(curve(hit)) < 1e-10);
    }
    let dense: Vec<DVec2> = (0..=40_000)
        .map(|i| curve(PI * (f64::from(i) / 20_000.0 - 1.0)))
        .collect();
    let away = |point: DVec2| {
        let near = dense.iter().map(|p| p.distance(point));
        near.fold(f64::INFINITY, f64::min)
    };
    let mut cusps = 0;
    for front in fan.fronts(FrontTolerance::time(1e-9)).unwrap() {
        assert!(front.joint_errors().0 < EXACT && front.joint_errors().1 < 1e-9);
        for i in 0..12 {
            for cusp in front.cusps(1.2 + 0.1 * f64::from(i)) {
                cusps += 1;
                // The caustic moves with the square root of the tolerance; the curve is sampled each 2e-4.
                assert!(away(cusp.point) < 3e-4, "{cusp:?}");
            }
        }
    }
    assert!(cusps > 4);
}

#[test]
fn three_rays_meet_inside_the_nephroid_and_count_their_caustics() {
    let circle = Interface::circle(DVec2::ZERO, 1.0).unwrap();
    let model = model(vec![circle], &[1.0, 1.0]);
    let beam = Source::Plane {
        ends: [dvec2(-0.2, -0.9), dvec2(-0.2, 0.9)],
        towards: DVec2::X,
    };
    let fan = fan(&model, beam, &[(0, Mode::Reflect)]);
    let arrivals = fan.arrivals(dvec2(0.7, 0.01));
    assert_eq!(arrivals.len(), 3);
    assert!(arrivals.iter().any(|a| a.caustics == 0) && arrivals.iter().any(|a| a.caustics == 1));
    assert_eq!(fan.arrivals(dvec2(0.2, 0.01)).len(), 1);
}

/// The time through flat layers by the horizontal slowness, which is the same in all of them.
fn flat_time(thickness: &[f64], speeds: &[f64], offset: f64) -> f64 {
    let fastest = speeds.iter().copied().fold(0.0, f64::max);
    let layers = || thickness.iter().zip(speeds);
    let reach = |p: f64| -> f64 {
        layers()
            .map(|(h, v)| h * p * v / (1.0 - (p * v).powi(2)).sqrt())
            .sum()
    };
    let (mut low, mut high) = (0.0, 1.0 / fastest);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if reach(middle) < offset {
            low = middle;
        } else {
            high = middle;
        }
    }
    layers()
        .map(|(h, v)| h / (v * (1.0 - (low * v).powi(2)).sqrt()))
        .sum()
}

#[test]
fn flat_layers_have_the_times_of_snell() {
    let depths = [-1.0, -1.7, -2.9, -3.4];
    let speeds = [1.0, 1.6, 1.3, 2.2, 2.9];
    for count in [2, 5] {
        let interfaces = depths[..count - 1]
            .iter()
            .map(|y| Interface::horizontal(*y).unwrap());
        let model = model(interfaces.collect(), &speeds[..count]);
        let steps: Vec<_> = (0..count - 1).map(|i| (i, Mode::Transmit)).collect();
        let fan = fan(&model, Source::point(dvec2(0.3, 0.0)), &steps);
        let bottom = depths[count - 2] - 0.6;
        let mut above = 0.0;
        let thickness: Vec<f64> = depths[..count - 1]
            .iter()
            .chain([&bottom])
            .map(|y| {
                let h = above - y;
                above = *y;
                h
            })
            .collect();
        for i in 0..30 {
            let receiver = dvec2(0.3 + 0.3 * f64::from(i), bottom);
            let arrivals = fan.arrivals(receiver);
            assert_eq!(arrivals.len(), 1, "{count} layers, {receiver}");
            let time = flat_time(&thickness, &speeds[..count], receiver.x - 0.3);
            assert!((arrivals[0].time / time - 1.0).abs() < EXACT);
        }
        // There and back again, through all of them twice.
        let mut echo = steps[..count - 2].to_vec();
        echo.push((count - 2, Mode::Reflect));
        echo.extend((0..count - 2).rev().map(|i| (i, Mode::Transmit)));
        let fan = self::fan(&model, Source::point(dvec2(0.3, 0.0)), &echo);
        let twice: Vec<f64> = thickness[..count - 1].iter().map(|h| 2.0 * h).collect();
        let time = flat_time(&twice, &speeds[..count - 1], 2.2);
        let arrival = fan.first_arrival(dvec2(2.5, 0.0)).unwrap();
        assert!((arrival.time / time - 1.0).abs() < EXACT);
    }
}

#[test]
fn an_elliptical_medium_is_a_stretched_isotropic_one() {
    let (a, b, turn) = (2.0, 1.1, 0.6);
    let medium = || Medium::elliptical(a, b, turn).unwrap();
    let mirror = Interface::line(dvec2(0.0, -1.0), dvec2(1.0, 0.2)).unwrap();
    let corner = DVec2::splat(20.0);
    let model = Model::try_new(-corner, corner, vec![medium(), medium()], vec![mirror]).unwrap();
    let source = dvec2(0.2, 1.0);
    // In the plane where the indicatrix is the unit circle the mirror is a mirror.
    let map = medium().unit_plane().unwrap();
    let normal = (map * dvec2(1.0, 0.2)).perp().normalize();
    let image = map * source - 2.0 * normal.dot(map * (source - dvec2(0.0, -1.0))) * normal;
    let fan = fan(&model, Source::point(source), &[(0, Mode::Reflect)]);
    for i in 0..30 {
        let receiver = dvec2(-2.0 + 0.2 * f64::from(i), 2.5);
        let time = (map * receiver).distance(image);
        let arrival = fan.first_arrival(receiver).unwrap();
        assert!((arrival.time / time - 1.0).abs() < EXACT);
    }
}

#[test]
fn total_reflection_is_an_error_for_a_ray_and_a_cut_for_a_wave() {
    let model = model(vec![Interface::horizontal(0.0).unwrap()], &[1.0, 2.0]);
    let source = Source::Point {
        position: dvec2(0.0, 1.0),
        angles: [PI, 2.0 * PI],
    };
    let fan = fan(&model, source, &[(0, Mode::Transmit)]);
    assert!(matches!(
        fan.trace(0.05),
        Err(Error::TotalReflection { .. })
    ));
    let cuts: Vec<_> = fan.cuts().collect();
    assert_eq!(cuts.len(), 2);
    // The critical angle has the sine 1/2.
    let critical = (PI / 6.0).tan();
    for (cut, side) in cuts.iter().zip([-1.0, 1.0]) {
        assert!(cut.place.distance(dvec2(side * critical, 0.0)) < 1e-6);
        assert!(matches!(cut.reason, Error::TotalReflection { .. }));
        assert!((cut.parameter - (0.5 + side / 6.0)).abs() < 1e-9);
    }
    for front in fan.fronts(FrontTolerance::time(1e-7)).unwrap() {
        assert!(front.cuts().iter().all(Option::is_some));
    }
}

#[test]
fn tables_and_sections_say_what_single_receivers_hear() {
    let wave = |x: f64| [-1.0 + 0.5 * x.sin(), 0.5 * x.cos(), -0.5 * x.sin()];
    let valley = Interface::graph(-25.0, 25.0, 250, wave).unwrap();
    let model = model(vec![valley], &[1.0, 1.4]);
    let source = Source::point(dvec2(0.5, 0.5));
    let fans = [
        fan(&model, source.clone(), &[]),
        fan(&model, source.clone(), &[(0, Mode::Reflect)]),
        fan(&model, source, &[(0, Mode::Transmit)]),
    ];
    let (low, high) = (dvec2(-3.0, -3.0), dvec2(3.0, 1.0));
    let table = travel_time_table(&fans, low, high, 31, 21);
    let place =
        |i: usize| low + (high - low) * dvec2((i % 31) as f64 / 30.0, (i / 31) as f64 / 20.0);
    let receivers: Vec<DVec2> = (0..table.len()).map(place).collect();
    let heard = section(&fans, &receivers);
    let mut several = 0;
    for ((time, all), receiver) in table.iter().zip(&heard).zip(&receivers) {
        let first = first_arrival(&fans, *receiver).map(|(_, arrival)| arrival.time);
        assert_eq!(*time, first);
        assert_eq!(all.first().map(|(_, arrival)| arrival.time), first);
        let alone: usize = fans.iter().map(|fan| fan.arrivals(*receiver).len()).sum();
        assert_eq!(all.len(), alone);
        assert!(all.windows(2).all(|pair| pair[0].1.time <= pair[1].1.time));
        several += usize::from(all.len() > 2);
    }
    let reached = table.iter().flatten().count();
    assert!(several > 0 && reached > 500, "{several} {reached}");
}

#[test]
fn a_snapshot_ends_on_the_interfaces() {
    let model = model_of_size(
        3.0,
        vec![
            Interface::horizontal(0.0).unwrap(),
            Interface::horizontal(-1.0).unwrap(),
        ],
        &[1.0, 1.5, 1.0],
    );
    let source = Source::Point {
        position: dvec2(0.0, 1.0),
        angles: [PI + 0.01, 2.0 * PI - 0.01],
    };
    let fan = fan(&model, source, &[(0, Mode::Transmit)]);
    let time = 1.8;
    let mut ends = Vec::new();
    for front in fan.fronts(FrontTolerance::time(1e-8)).unwrap() {
        for stretch in front.snapshot_inside(&model, time, 32) {
            // A ray next to the critical one has set out where it is: to a small part of the model's size.
            assert!(stretch.iter().all(|p| p.y < 0.01 && p.y > -1.0 - 1e-6));
            ends.extend([stretch[0], stretch[stretch.len() - 1]]);
        }
    }
    // To the left and to the right of the axis the front hangs between the two interfaces.
    assert_eq!(ends.len(), 4, "{ends:?}");
    assert!(
        ends.iter().filter(|p| (p.y + 1.0).abs() < 1e-6).count() == 2,
        "{ends:?}"
    );
    assert!(ends.iter().map(|p| p.x).sum::<f64>().abs() < 1e-3);
    let straight_down = fan.first_arrival(dvec2(0.0, -0.5)).unwrap();
    assert!((straight_down.ray.normal().to_angle() + FRAC_PI_2).abs() < 1e-9);
}
