use super::*;
use std::f64::consts::TAU;

fn wave(x: f64) -> [f64; 3] {
    let (sine, cosine) = (TAU * x).sin_cos();
    [
        0.5 + 0.06 * sine,
        0.06 * TAU * cosine,
        -0.06 * TAU * TAU * sine,
    ]
}

#[test]
fn shapes_are_hit_where_they_are() {
    let (origin, velocity) = (DVec2::new(-3.0, 0.4), DVec2::new(2.0, 0.1));
    let circle = Interface::circle(DVec2::new(0.2, 0.1), 1.0).unwrap();
    let hit = circle.first_impact(origin, velocity, 0.0).unwrap();
    assert!((hit.point.distance(DVec2::new(0.2, 0.1)) - 1.0).abs() < 1e-14);
    assert!((hit.curvature.abs() - 1.0).abs() < 1e-13 && hit.point.x < 0.0);
    assert_eq!(circle.count_impacts(origin, velocity), 2);
    assert_eq!(circle.count_impacts(DVec2::ZERO, velocity), 1);
    let parabola = Interface::conic([1.0, 0.0, 0.0, 0.0, -4.0, 0.0]).unwrap();
    let hit = parabola
        .first_impact(DVec2::new(1.0, 5.0), DVec2::NEG_Y, 0.0)
        .unwrap();
    assert!((hit.point - DVec2::new(1.0, 0.25)).length() < 1e-15);
    let flat = Interface::horizontal(0.5).unwrap();
    assert!(flat.first_impact(DVec2::ZERO, DVec2::X, 0.0).is_none());
    assert!(
        (flat
            .first_impact(DVec2::ZERO, DVec2::Y * 0.25, 0.0)
            .unwrap()
            .time
            - 2.0)
            .abs()
            < 1e-15
    );
}

#[test]
fn a_graph_is_met_to_its_order_and_found_again_from_nearby() {
    let coarse = Interface::graph(-1.0, 2.0, 60, wave).unwrap();
    let fine = Interface::graph(-1.0, 2.0, 120, wave).unwrap();
    let (first, second) = (
        graph_error(&coarse, |x| wave(x)[0]),
        graph_error(&fine, |x| wave(x)[0]),
    );
    assert!(
        ((first / second).log2() - 6.0).abs() < 0.5,
        "{first:e} {second:e}"
    );
    assert!(second < 1e-10);
    let (origin, velocity) = (DVec2::new(0.3, 1.0), DVec2::new(0.2, -1.0));
    let hit = fine.first_impact(origin, velocity, 0.0).unwrap();
    assert!((hit.point.y - wave(hit.point.x)[0]).abs() < 1e-10);
    let again = fine
        .impact_near(origin, velocity, 0.0, hit.parameter + 0.3)
        .unwrap();
    assert!((again.time - hit.time).abs() < 1e-14);
    let [_, slope, bend] = wave(hit.point.x);
    assert!((hit.curvature - bend / (1.0 + slope * slope).powf(1.5)).abs() < 1e-5);
}

#[test]
fn conics_are_fitted_to_samples_of_a_conic_exactly() {
    let sample = |i: u32| {
        let angle = 0.1 * f64::from(i);
        (
            DVec2::new(2.0 * angle.cos(), angle.sin()),
            DVec2::new(-2.0 * angle.sin(), angle.cos()),
        )
    };
    let samples: Vec<_> = (0..=20).map(sample).collect();
    let interface = Interface::fit_conics(&samples, 5).unwrap();
    for point in interface.polyline(DVec2::splat(-9.0), DVec2::splat(9.0), 100) {
        assert!(((point.x / 2.0).powi(2) + point.y.powi(2) - 1.0).abs() < 1e-13);
    }
    let inflected = [(DVec2::ZERO, DVec2::ONE), (DVec2::X, DVec2::ONE)];
    assert!(matches!(
        Interface::fit_conics(&inflected, 1),
        Err(Error::BadInterface { .. })
    ));
}

#[test]
fn shapes_that_are_none_are_refused() {
    assert!(matches!(
        Interface::circle(DVec2::ZERO, 0.0),
        Err(Error::BadInterface { .. })
    ));
    assert!(matches!(
        Interface::circle(DVec2::NAN, 1.0),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        Interface::line(DVec2::ZERO, DVec2::ZERO),
        Err(Error::ZeroDirection { .. })
    ));
    assert!(matches!(
        Interface::conic([0.0; 6]),
        Err(Error::BadInterface { .. })
    ));
    assert!(matches!(
        Interface::curve([]),
        Err(Error::BadInterface { .. })
    ));
    assert!(matches!(
        Interface::graph(0.0, 0.0, 5, wave),
        Err(Error::OutOfRange { .. })
    ));
}
