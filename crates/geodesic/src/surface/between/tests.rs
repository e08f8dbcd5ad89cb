use super::*;
use crate::surface::smooth::SurfaceJet;
use crate::{TorusSurface, trace_smooth};
use std::f64::consts::PI;

const TORUS: TorusSurface = TorusSurface {
    major: 2.0,
    minor: 0.7,
};

/// Longitude and latitude.
fn sphere(uv: DVec2) -> SurfaceJet {
    let ((su, cu), (sv, cv)) = (uv.x.sin_cos(), uv.y.sin_cos());
    SurfaceJet {
        point: DVec3::new(cu * cv, su * cv, sv),
        first: [
            DVec3::new(-su * cv, cu * cv, 0.0),
            DVec3::new(-cu * sv, -su * sv, cv),
        ],
        second: [
            DVec3::new(-cu * cv, -su * cv, 0.0),
            DVec3::new(su * sv, -cu * sv, 0.0),
            DVec3::new(-cu * cv, -su * cv, -sv),
        ],
    }
}

#[test]
fn great_circles() {
    for (from, to) in [
        ([0.2, -0.3], [1.4, 0.9]),
        ([0.0, 1.2], [2.8, 1.1]),
        ([0.1, 0.0], [1.0, 0.0]),
    ] {
        let (from, to) = (DVec2::from(from), DVec2::from(to));
        let arc = sphere(from).point.angle_between(sphere(to).point);
        let geodesic = geodesic_between(&sphere, &[from, to], 1e-12).unwrap();
        assert!(
            (geodesic.length - arc).abs() < 1e-11,
            "{} {arc}",
            geodesic.length
        );
        assert_eq!((geodesic.conjugate_points, geodesic.inside), (0, true));
    }
}

/// The long way round a great circle passes the point opposite to its start.
#[test]
fn conjugate_points_are_counted() {
    let way: Vec<DVec2> = (0..=40).map(|k| DVec2::new(0.1 * k as f64, 0.02)).collect();
    let geodesic = geodesic_between(&sphere, &way, 1e-12).unwrap();
    let arc = sphere(way[0]).point.angle_between(sphere(way[40]).point);
    assert!((geodesic.length - (2.0 * PI - arc)).abs() < 1e-10);
    assert_eq!(geodesic.conjugate_points, 1);
}

#[test]
fn both_problems_agree_on_a_torus() {
    for (angle, length) in [(0.3, 2.0), (1.1, 5.0), (2.6, 3.0), (-0.4, 9.0)] {
        let start = SurfaceRay {
            uv: DVec2::new(0.3, 2.2),
            direction: TORUS
                .jet(DVec2::new(0.3, 2.2))
                .unit(DVec2::new(f64::cos(angle) / 1.6, f64::sin(angle) / 0.7)),
        };
        // The traced curve, bent out of shape.
        let rays = trace_smooth_points(&TORUS, start, length, 60, 1e-13).unwrap();
        let way: Vec<DVec2> = rays
            .iter()
            .enumerate()
            .map(|(k, ray)| ray.uv + 0.05 * (PI * k as f64 / 60.0).sin() * DVec2::ONE)
            .collect();
        let geodesic = geodesic_between(&TORUS, &way, 1e-12).unwrap();
        assert!(
            (geodesic.length - length).abs() < 1e-9,
            "{}",
            geodesic.length
        );
        let again = trace_smooth(&TORUS, geodesic.nodes[0], geodesic.length, 1e-13).unwrap();
        assert!((again.uv - way[60]).length() < 1e-7);
    }
}

fn nowhere() -> SurfaceJet {
    SurfaceJet {
        point: DVec3::NAN,
        first: [DVec3::NAN; 2],
        second: [DVec3::NAN; 3],
    }
}

#[test]
fn hostile_ways_are_refused() {
    let p = DVec2::new(0.1, 0.2);
    for way in [
        &[][..],
        &[p],
        &[p, p],
        &[p, DVec2::NAN],
        &[p, DVec2::INFINITY],
    ] {
        assert!(geodesic_between(&TORUS, way, 1e-10).is_err());
    }
    // Over the pole, where longitude and latitude have no tangent plane.
    let way = [DVec2::new(0.0, 1.0), DVec2::new(0.0, 2.0)];
    let cut = |uv: DVec2| if uv.y > 1.5 { nowhere() } else { sphere(uv) };
    assert!(geodesic_between(&cut, &way, 1e-10).is_err());
}
