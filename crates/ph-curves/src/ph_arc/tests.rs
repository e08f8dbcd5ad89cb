use super::*;
use std::f64::consts::PI;

/// An arc of class 5 with no symmetry, its normals turning by `turning`.
pub(super) fn arc(turning: f64) -> PhArc<6> {
    let w0 = DVec2::from_angle(0.3) * 1.3;
    let w1 = DVec2::from_angle(0.3 + 0.5 * turning) * 0.8;
    PhArc::new(w0, w1, [2.0, 1.7, 2.2, 1.9, 2.4, 2.1]).unwrap()
}

#[test]
fn the_point_lies_on_its_tangent_and_moves_along_it() {
    for turning in [1.1, -1.1, 2.9, 1e-2] {
        let arc = arc(turning);
        for t in [0.0, 0.2, 0.77, 1.0] {
            let c = arc.contact(t);
            let size = c.point.length();
            assert!((c.normal.dot(c.point) - c.support).abs() < 1e-13 * size);
            let step = 1e-6;
            let chord = arc.point(t + step) - arc.point(t - step);
            // dC/dpsi = R T, psi_t = 2 kappa / q
            let (w0, w1) = arc.spinors();
            let rate = 2.0 * w0.perp_dot(w1) / (w0 * (1.0 - t) + w1 * t).length_squared();
            let predicted = c.normal.perp() * (c.radius * rate * 2.0 * step);
            assert!(
                (chord - predicted).length() < 1e-4 * predicted.length(),
                "{turning} {t}"
            );
        }
    }
}

#[test]
fn the_radius_polynomial_is_the_radius() {
    let arc = arc(-0.9);
    let polynomial = arc.radius_polynomial();
    for t in [0.0, 0.31, 0.5, 1.0] {
        assert!(
            (bernstein::evaluate(&polynomial, t) - arc.radius(t)).abs()
                < 1e-11 * arc.radius(t).abs()
        );
    }
}

#[test]
fn the_dual_form_and_the_point_form_are_the_arc() {
    for turning in [1.1, -2.0] {
        let arc = arc(turning);
        let dual = crate::DualCurve::from(&arc);
        let points = arc.to_points().unwrap();
        assert_eq!(points.degree(), 6);
        for t in [0.0, 0.25, 0.9, 1.0] {
            let (c, d) = (arc.contact(t), dual.contact(t).unwrap());
            assert!((c.point - d.point).length() < 1e-13 && (c.normal - d.normal).length() < 1e-14);
            assert!((c.radius - d.radius).abs() < 1e-11 * c.radius.abs());
            assert!((points.point(t).unwrap() - c.point).length() < 1e-13);
        }
    }
}

#[test]
fn offsets_move_points_along_normals_and_lines_by_their_circle_distances() {
    let arc = arc(1.4);
    let moved = arc.offset(0.37);
    let lines = crate::DualCurve::from(&arc)
        .translate_lines(&arc.control_distances().map(|c| 0.37 * c))
        .unwrap();
    for t in [0.0, 0.4, 1.0] {
        assert!((moved.point(t) - arc.point(t) - 0.37 * arc.normal(t)).length() < 1e-14);
        assert!((moved.radius(t) - arc.radius(t) - 0.37).abs() < 1e-13);
        assert!((lines.contact(t).unwrap().point - moved.point(t)).length() < 1e-14);
    }
}

#[test]
fn a_normal_is_found_where_it_occurs() {
    for turning in [1e-6, 1.3, -3.1] {
        let arc = arc(turning);
        for t in [0.0, 0.11, 0.5, 0.93, 1.0] {
            let found = arc.parameter_beyond(arc.normal(t));
            assert!((found - t).abs() < 1e-9, "{turning} {t} {found}");
        }
        assert_eq!(arc.parameter_of_normal(-arc.normal(0.5)), None);
    }
}

#[test]
fn impossible_arcs_are_refused() {
    let g = [1.0; 4];
    assert!(matches!(
        TQuartic::new(DVec2::X, DVec2::X, g),
        Err(Error::NoTurning { .. })
    ));
    assert!(
        matches!(TQuartic::new(DVec2::X, DVec2::Y, g), Err(Error::TurningTooLarge { turning }) if (turning - PI).abs() < 1e-15)
    );
    assert!(matches!(
        TQuartic::new(DVec2::X, DVec2::ZERO, g),
        Err(Error::ZeroDirection { .. })
    ));
    assert!(matches!(
        TQuartic::new(DVec2::X, DVec2::NAN, g),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        PhArc::<2>::new(DVec2::X, DVec2::ONE, [1.0; 2]),
        Err(Error::Pencil { class: 1 })
    ));
}
