use super::*;

fn ends() -> G1Ends {
    let start = LineElement::new(DVec2::new(1.0, 0.0), DVec2::from_angle(0.1)).unwrap();
    let end = LineElement::new(DVec2::new(0.55, 1.1), DVec2::from_angle(1.35)).unwrap();
    G1Ends::new(start, end).unwrap()
}

#[test]
fn the_radii_change_sign_at_the_ends_of_the_regular_interval() {
    let (low, high) = ends().regular_alphas().unwrap();
    assert!(high.is_infinite());
    assert!(ends().end_radii(low * 1.0001)[1] > 0.0 && ends().end_radii(low * 0.9999)[1] < 0.0);
    let inside = ends().clamp_alpha(0.01).unwrap();
    assert!(
        ends()
            .arc(inside)
            .unwrap()
            .end_radii()
            .iter()
            .all(|r| *r > 0.0)
    );
}

#[test]
fn a_fit_to_an_arc_finds_its_shape() {
    let arc = ends().arc(2.7).unwrap();
    let samples = [0.2, 0.45, 0.7].map(|t| (arc.normal(t), arc.support(t)));
    assert!((ends().fit_alpha(samples) - 2.7).abs() < 1e-11);
    assert!((ends().alpha_for_start_radius(arc.end_radii()[0]).unwrap() - 2.7).abs() < 1e-11);
    assert!((ends().t_connected(arc.end_radii(), 1e-9).unwrap() - 2.7).abs() < 1e-11);
    assert_eq!(
        ends().t_connected([arc.end_radii()[0], 1.01 * arc.end_radii()[1]], 1e-9),
        None
    );
}

#[test]
fn a_cusp_splits_the_length() {
    let arc = ends().arc(0.8).unwrap();
    let t = arc.cusp().unwrap();
    assert!(arc.radius(t).abs() < 1e-14);
    assert!((arc.length() - 1.404_320_983_582_101_1).abs() < 1e-12);
    assert!(arc.signed_length() < arc.length() - 1e-3);
}

#[test]
fn the_evolute_is_a_t_cubic_whose_involute_is_the_arc() {
    let arc = ends().arc(2.7).unwrap();
    let evolute = TCubic::new(*arc.evolute().points()).unwrap();
    let [r0, r1] = arc.end_radii();
    assert!((evolute.length() - (r0 - r1).abs()).abs() < 1e-12);
    for t in [0.0, 0.3, 1.0] {
        assert!((evolute.point(t) - arc.contact(t).centre()).length() < 1e-12);
    }
    // The normal of the involute points along the travel of the evolute: here the radius decreases.
    let involute = evolute.involute(r0).unwrap();
    for t in [0.0, 0.3, 1.0] {
        assert!((involute.point(t) - arc.point(t)).length() < 1e-12);
    }
}

#[test]
fn the_quartic_is_the_point_form() {
    for arc in [ends().arc(2.7).unwrap(), ends().arc(2.7).unwrap().reverse()] {
        let quartic = arc.quartic();
        for (x, y) in quartic.iter().zip(arc.point_control()) {
            assert!(x.x > 0.0);
            // The general form carries the factor m = 3 and the sign of the turning.
            assert!((x.y / x.x - y.y / y.x).abs() < 1e-13 && (x.z / x.x - y.z / y.x).abs() < 1e-13);
        }
    }
}

#[test]
fn equal_legs_give_the_circle_whatever_the_shape() {
    let end = DVec2::from_angle(0.9);
    let start = LineElement::new(DVec2::X, DVec2::X).unwrap();
    let circle = G1Ends::new(start, LineElement::new(end, end).unwrap()).unwrap();
    for alpha in [0.1, 1.0, 7.0] {
        let arc = circle.arc(alpha).unwrap();
        assert!(
            (arc.point(0.4).length() - 1.0).abs() < 1e-14 && (arc.radius(0.4) - 1.0).abs() < 1e-13
        );
    }
}

#[test]
fn a_fan_is_a_point_whose_offset_is_a_circular_arc() {
    let corner = DVec2::new(3.0, -2.0);
    let fan = TQuartic::point_fan(corner, DVec2::X, DVec2::from_angle(1.5)).unwrap();
    for t in [0.0, 0.5, 1.0] {
        assert!((fan.point(t) - corner).length() < 1e-14);
        assert!(((fan.offset(0.5).point(t) - corner).length() - 0.5).abs() < 1e-14);
    }
    assert_eq!(fan.cusp(), None);
}

#[test]
fn elements_without_an_arc_are_refused() {
    let at = |angle: f64| LineElement::new(DVec2::ZERO, DVec2::from_angle(angle)).unwrap();
    assert!(matches!(
        G1Ends::new(at(0.0), at(0.0)),
        Err(Error::NoTurning { .. })
    ));
    let opposite = LineElement::new(DVec2::ZERO, -DVec2::X).unwrap();
    assert!(matches!(
        G1Ends::new(at(0.0), opposite),
        Err(Error::TurningTooLarge { .. })
    ));
    assert!(matches!(
        ends().arc(0.0),
        Err(Error::NonPositiveAlpha { .. })
    ));
    assert!(matches!(
        ends().arc(f64::NAN),
        Err(Error::NonPositiveAlpha { .. })
    ));
    assert!(LineElement::new(DVec2::ZERO, DVec2::ZERO).is_err());
    let zigzag = LineElement::new(DVec2::new(-1.0, 1.0), DVec2::from_angle(0.3)).unwrap();
    assert!(matches!(
        G1Ends::new(at(0.0), zigzag).unwrap().regular_alphas(),
        Err(Error::NoRegularArc { .. })
    ));
}
