//! Numbers that no surface should have, through every door of the crate: an error with the numbers, or an answer that is
//! finite, never a panic, never a search without an end.

mod common;
use bezier_mass::Biquadratic;
use common::pairs::Random;
use cyclide::glam::{DVec3, dvec3};
use cyclide::{
    Cone, CurvatureCircle, Dupin, Error, Frame, Parabolic, Quartic, RingPreference, blend_through,
    classify, common_sphere, contact_residual, convert, convert_torus, double_blends, join,
    patch_from_corners, solve_weights,
};
use lorentz::Cycle;

const NUMBERS: [f64; 16] = [
    0.0,
    1.0,
    -1.0,
    0.3,
    2.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    -1e300,
    1e150,
    1e60,
    1e-60,
    1e-150,
    f64::MIN_POSITIVE,
    5e-324,
];

fn places() -> Vec<DVec3> {
    NUMBERS
        .iter()
        .flat_map(|&x| [dvec3(x, 0.0, 0.0), dvec3(1.0, x, -2.0), DVec3::splat(x)])
        .collect()
}

/// Every answer of a surface that was accepted is finite.
fn interrogate(surface: &Dupin, what: &str) {
    let finite =
        |point: DVec3, question: &str| assert!(point.is_finite(), "{what}: {question} {point}");
    for first in [0.0, 0.7, 3.0] {
        for second in [0.0, 1.1, -2.0] {
            finite(surface.point(first, second), "point");
            finite(surface.normal(first, second), "normal");
        }
    }
    for point in surface.singular_points() {
        finite(point, "singular point");
    }
    for place in places() {
        if let Ok(closest) = surface.closest(place) {
            finite(closest.point, "closest");
            assert!(closest.distance.is_finite(), "{what}: distance to {place}");
        }
        if let Ok(hits) = surface.intersect(place, dvec3(0.3, -1.0, 0.2)) {
            assert!(
                hits.iter().all(|hit| hit.s.is_finite()),
                "{what}: ray from {place}"
            );
        }
        let _ = surface.intersect(DVec3::ONE, place);
        let _ = surface.parameters_at(place);
    }
    if let Some(corners) = surface.bounding_box() {
        corners.into_iter().for_each(|corner| finite(corner, "box"));
    }
    for bound in NUMBERS {
        if let Ok(patch) = surface.patch([0.0, 1.0], [bound, 2.5]) {
            assert!(
                patch
                    .net()
                    .control()
                    .as_flattened()
                    .iter()
                    .all(|h| h.weight.is_finite() && h.weighted.is_finite()),
                "{what}"
            );
            let _ = convert(patch.net());
            let _ = convert_torus(patch.net(), None);
        }
        if let Ok(offset) = surface.offset(bound) {
            finite(offset.point(0.4, 0.9), "offset");
        }
        if let Ok(area) = surface.area([0.0, 1.0], [0.5, bound]) {
            assert!(area.is_finite(), "{what}: area to {bound}");
        }
    }
}

#[test]
fn surfaces_are_finite_or_refused() {
    let mut accepted = 0;
    for a in NUMBERS {
        for c in NUMBERS {
            for mu in NUMBERS {
                let Ok(surface) = Quartic::new(a, c, mu, Frame::WORLD) else {
                    continue;
                };
                accepted += 1;
                interrogate(&surface.into(), &format!("a {a:e} c {c:e} mu {mu:e}"));
                for sign in [1.0, -1.0, f64::NAN] {
                    if let Ok(circle) = surface.villarceau_circle(0.7, sign) {
                        assert!(circle.centre().is_finite() && circle.radius().is_finite());
                    }
                }
            }
            if let Ok(surface) = Parabolic::new(a, c, Frame::WORLD) {
                accepted += 1;
                interrogate(&surface.into(), &format!("f {a:e} k {c:e}"));
            }
            let _ = Quartic::double_sphere(a, c, Frame::WORLD);
        }
    }
    assert!(accepted > 100);
}

#[test]
fn what_is_not_finite_is_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let off = dvec3(0.0, bad, 0.0);
        assert!(matches!(
            Dupin::quartic(bad, 1.0, 1.0, Frame::WORLD),
            Err(Error::NotFinite { .. })
        ));
        assert!(matches!(
            Dupin::quartic(3.0, bad, 1.0, Frame::WORLD),
            Err(Error::NotFinite { .. })
        ));
        assert!(matches!(
            Dupin::quartic(3.0, 1.0, bad, Frame::WORLD),
            Err(Error::NotFinite { .. })
        ));
        assert!(matches!(
            Dupin::parabolic(bad, 1.0, Frame::WORLD),
            Err(Error::NotFinite { .. })
        ));
        assert!(Frame::new(off, DVec3::X, DVec3::Y, DVec3::Z).is_err());
        assert!(Frame::new(DVec3::ZERO, off, DVec3::Y, DVec3::Z).is_err());
        assert!(Frame::from_directions(DVec3::ZERO, DVec3::X, off).is_none());
        assert!(Cone::new(off, DVec3::Z, 0.3).is_err() && Cone::new(DVec3::ONE, off, 0.3).is_err());
        assert!(Cone::new(DVec3::ONE, DVec3::Z, bad).is_err());
        assert!(Cone::cylinder(DVec3::ONE, DVec3::Z, bad).is_err());
        assert!(solve_weights(&[[off; 3]; 3]).is_err());
        assert!(patch_from_corners([off; 4], DVec3::X, DVec3::Y).is_err());
        let spheres = [
            Cycle::new(off, 1.0),
            Cycle::new(DVec3::X, 1.0),
            Cycle::new(DVec3::Y, 2.0),
        ];
        assert!(Dupin::from_tangent_spheres(spheres).is_err());
    }
}

fn cones() -> Vec<Cone> {
    let mut cones = Vec::new();
    for place in [0.0, 1.0, 1e-60, 1e60, -1e69, 1e-300] {
        for axis in [
            DVec3::Z,
            dvec3(1.0, 1e-9, 0.0),
            dvec3(1e-300, 0.0, 1.0),
            DVec3::splat(1e150),
        ] {
            for angle in [1e-300, 1e-12, 0.4, 1.57] {
                cones.extend(Cone::new(DVec3::splat(place), axis, angle));
            }
            for radius in [1e-60, 1.0, 1e60] {
                cones.extend(Cone::cylinder(dvec3(place, 0.0, 1.0), axis, radius));
            }
        }
    }
    cones
}

/// All pairs of hostile cones: what is blended touches, and nothing else comes back.
#[test]
fn blends_of_hostile_cones_touch_or_are_refused() {
    let cones = cones();
    let mut random = Random(3);
    for _ in 0..4_000 {
        let [one, other] = [(); 2].map(|()| &cones[(random.unit() * cones.len() as f64) as usize]);
        let found = classify(one, other);
        for family in found.families() {
            for t in NUMBERS {
                let Ok(blend) = family.blend(t) else { continue };
                assert!(
                    blend.residual() < 1e-8,
                    "{one:?} {other:?} at {t:e}: {blend:?}"
                );
                let surface = blend.surface();
                assert!(surface.frame().origin().is_finite());
                for contact in blend.contacts() {
                    assert!(contact.circle.centre.is_finite() && contact.circle.radius.is_finite());
                }
                for tube in blend.tubes().into_iter().flatten() {
                    let _ = (tube.patches(), tube.is_smooth());
                }
                let _ = contact_residual(surface, blend.contact_family(), t, one);
            }
            let _ = (
                family.boundaries(),
                family.intervals(),
                family.ring_parameters(),
            );
            for reach in [f64::NAN, 0.0, 1.0, f64::MAX] {
                for preference in [
                    RingPreference::Widest,
                    RingPreference::ContactAtHeight(reach),
                    RingPreference::SmallestCurvature { reach },
                ] {
                    if let Ok(blend) = family.ring_blend(preference) {
                        assert!(blend.residual() < 1e-8);
                    }
                }
            }
        }
        for place in places() {
            let _ = (found.blends_at(place), found.blends_at_height(place.x));
        }
    }
}

#[test]
fn joins_of_hostile_circles_end() {
    let one = Cone::new(DVec3::ZERO, DVec3::Z, 0.4).unwrap();
    let other = Cone::new(dvec3(3.0, 0.0, 1.0), DVec3::X, 0.7).unwrap();
    let good = one.circle_at(2.0);
    for place in places() {
        for radius in NUMBERS {
            let circle = CurvatureCircle {
                centre: place,
                radius,
                axis: DVec3::X,
            };
            let circles = [&good, &circle];
            let cones = [&one, &other];
            assert!(blend_through(cones, circles).is_err());
            assert!(join(cones, circles).is_err() && double_blends(cones, circles).is_err());
            let _ = common_sphere(&good, &circle);
            let _ = Dupin::from_principal_circles([good, circle], [circle, good]);
            let _ = Dupin::from_principal_line_and_circle(place, DVec3::X, circle, good);
        }
    }
}

/// What is determined by other data obeys the limits of the constructors, after the units are put back.
#[test]
fn determined_surfaces_have_sizes_in_range() {
    let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap();
    let parabolic = Dupin::parabolic(1.0, 0.2, Frame::WORLD).unwrap();
    let refused = |error: Error| matches!(error, Error::LengthOutOfRange { .. });
    for surface in [ring, parabolic] {
        let spheres = [0.1, 1.0, 2.0].map(|first| surface.first_sphere(first));
        let net = *surface.patch([0.3, 1.1], [0.4, 1.3]).unwrap().net();
        for scale in [1e-160, 1e-90, 1e-72, 1e-60, 1.0, 1e60, 1e72, 1e90, 1e150] {
            let scaled = spheres.map(|sphere| sphere * scale);
            let grown = Biquadratic::new(
                net.control()
                    .map(|row| row.map(|control| control.map_linear(|weighted| weighted * scale))),
            )
            .unwrap();
            let in_range = (1e-60..=1e60).contains(&scale);
            let results = [
                Dupin::from_tangent_spheres(scaled).map(|found| found.surface),
                convert(&grown).map(|found| found.surface),
            ];
            for result in results {
                match result {
                    Ok(found) => {
                        assert!(in_range, "{scale:e}: {found:?}");
                        let place = dvec3(4.3, -1.2, 0.9);
                        let (near, expected) = (
                            found.closest(place * scale).unwrap(),
                            surface.closest(place).unwrap(),
                        );
                        assert!((near.distance / scale - expected.distance).abs() < 1e-9);
                    }
                    Err(error) => assert!(
                        !in_range && (refused(error) || !(1e-100..1e100).contains(&scale)),
                        "{scale:e}: {error}"
                    ),
                }
            }
        }
    }
    let circle = |x: f64, radius: f64| CurvatureCircle {
        centre: dvec3(x * 1e-90, 0.0, 0.0),
        radius: radius * 1e-90,
        axis: DVec3::Z,
    };
    let found = Dupin::from_principal_circles(
        [circle(0.0, 4.0), circle(0.0, 2.0)],
        [circle(3.0, 1.0), circle(-3.0, 1.0)],
    );
    assert!(found.is_err_and(refused), "{found:?}");
}
