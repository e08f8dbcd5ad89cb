//! Pairs of cones whose vertices, angles or contact circles lie in extreme places.

use cyclide::glam::{DVec3, dvec3};
use cyclide::{Class, Cone, Error, Family, Obstacle, RingPreference, classify, contact_residual};
use std::f64::consts::FRAC_PI_2;

/// The larger residual of the member against the two cones as they were given.
fn residual(family: &Family, parameter: f64, cones: [&Cone; 2]) -> Result<f64, Error> {
    let blend = family.blend(parameter)?;
    let residuals = [0, 1].map(|index| {
        contact_residual(
            blend.surface(),
            blend.contact_family(),
            blend.contacts()[index].parameter,
            cones[index],
        )
    });
    Ok(residuals[0].max(residuals[1]))
}

#[test]
fn the_point_given_on_an_axis_does_not_change_the_answer() {
    let first = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0).unwrap();
    for along in [0.0, 1.0, -1e3, 1e6, 1e9] {
        let skew = Cone::cylinder(dvec3(along, 0.0005, 0.0), DVec3::X, 1.0).unwrap();
        for [one, other] in [[&first, &skew], [&skew, &first]] {
            let class = classify(one, other).class();
            assert!(
                matches!(class, Class::NotBlendable(Obstacle::SkewAxes { distance })
                    if (distance - 0.0005).abs() < 1e-12),
                "{along}: {class}"
            );
        }
        let meeting = Cone::cylinder(dvec3(along, 0.0, 0.0), DVec3::X, 1.0).unwrap();
        let found = classify(&first, &meeting);
        assert_eq!(found.class(), Class::GeneralIntersecting, "{along}");
        for family in found.families() {
            let residual = residual(family, 2.0, [&first, &meeting]).unwrap();
            assert!(residual < 1e-8, "{along}: {residual:e}");
        }
        let unequal = Cone::cylinder(dvec3(along, 0.0, 0.0), DVec3::X, 1.0005).unwrap();
        assert!(classify(&first, &unequal).families().is_empty(), "{along}");

        // Parallel axes: 0.0005 apart is not one axis.
        let beside = Cone::cylinder(dvec3(0.0, 0.0005, along), DVec3::Z, 2.0).unwrap();
        assert_eq!(
            classify(&first, &beside).class(),
            Class::GeneralParallel,
            "{along}"
        );
    }
}

/// Drafted cones: the vertices are far away, the radii where the axes meet are not.
#[test]
fn vertices_far_away_do_not_excuse_a_gap() {
    let around = |centre: DVec3, axis: DVec3, half_angle: f64| {
        Cone::new(centre - axis / half_angle.sin(), axis, half_angle).unwrap()
    };
    let slanted = dvec3(0.8, 0.0, 0.6);
    for draft in [1e-3, 1e-5, 1e-6] {
        let first = around(DVec3::ZERO, DVec3::Z, draft);
        let meeting = around(DVec3::ZERO, slanted, 1.3 * draft);
        let found = classify(&first, &meeting);
        assert_eq!(found.class(), Class::GeneralIntersecting, "{draft:e}");
        for family in found.families() {
            let residual = residual(family, 2.0, [&first, &meeting]).unwrap();
            assert!(residual < 1e-8, "{draft:e}: {residual:e}");
        }
        for gap in [1e-4, 1e-6] {
            let skew = around(DVec3::Y * gap, slanted, 1.3 * draft);
            let class = classify(&first, &skew).class();
            assert!(
                matches!(class, Class::NotBlendable(Obstacle::SkewAxes { .. })),
                "{draft:e} {gap:e}: {class}"
            );
        }
        // One axis, or nearly.
        let beside = around(DVec3::Y * 1e-4, DVec3::Z, 1.3 * draft);
        assert!(
            classify(&first, &beside).families().is_empty(),
            "{draft:e}: {}",
            classify(&first, &beside).class()
        );
    }
}

/// Axes that are parallel within the tolerance part far away: there no blend is handed out that misses its cone.
#[test]
fn no_blend_is_handed_out_that_misses_a_given_cone() {
    let first = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0).unwrap();
    let axis = dvec3(0.0, 8e-10, 1.0);
    for along in [0.0, 1e6] {
        let second = Cone::cylinder(dvec3(5.0, 0.0, 0.0) + along * axis, axis, 1.5).unwrap();
        for family in classify(&first, &second).families() {
            assert!(residual(family, 1.0, [&first, &second]).unwrap() < 1e-8);
            for s in [1e3, 1e5, 1e7] {
                match residual(family, s, [&first, &second]) {
                    Ok(residual) => assert!(residual < 1e-8, "{s}: {residual:e}"),
                    Err(error) => assert!(matches!(error, Error::NotTangent { .. }), "{error}"),
                }
            }
        }
    }
}

/// The circle of a contact has the axis of the cone as it was given, also where parallel axes are turned to one direction.
#[test]
fn contact_circles_have_the_axis_of_their_cone() {
    let first = Cone::new(DVec3::ZERO, DVec3::Z, 0.4).unwrap();
    for second in [
        Cone::new(dvec3(2.0, 0.0, 0.5), -DVec3::Z, 0.4).unwrap(),
        Cone::new(dvec3(0.0, 0.0, 3.0), -DVec3::Z, 0.7).unwrap(),
        Cone::cylinder(DVec3::ZERO, -DVec3::Z, 0.7).unwrap(),
    ] {
        let found = classify(&first, &second);
        assert!(!found.families().is_empty());
        for family in found.families() {
            let [one, other] = family.blend(1.7).unwrap().contacts().map(|c| c.circle.axis);
            assert_eq!([one, other], [first.axis(), second.axis()]);
        }
    }
}

/// The distance from a cone is measured beside the contact circle: a vertex 1e6 radii away costs the rounding of its coordinates, once.
#[test]
fn sampled_distances_of_drafted_cones_are_not_cancelled() {
    let around = |axis: DVec3, half_angle: f64| {
        Cone::new(-axis / half_angle.sin(), axis, half_angle).unwrap()
    };
    let found = classify(
        &around(DVec3::Z, 1e-6),
        &around(dvec3(0.8, 0.0, 0.6), 1.3e-6),
    );
    for family in found.families() {
        let (distance, angle) = family.blend(2.0).unwrap().sampled_error(24);
        assert!(distance < 1e-9 && angle < 1e-9, "{distance:e} {angle:e}");
    }
}

/// Nearly flat cones: their sines agree to many digits, their angles do not.
#[test]
fn flat_cones_are_told_apart_by_their_angles() {
    let flat = |z: f64, short: f64| Cone::new(DVec3::Z * z, DVec3::Z, FRAC_PI_2 - short).unwrap();
    let found = classify(&flat(0.0, 1e-5), &flat(1.0, 4e-5));
    assert_eq!(found.class(), Class::IdenticalAxes);
    assert_eq!(found.families().len(), 4);

    let beside = |short: f64| Cone::new(dvec3(2.0, 0.0, 0.0), DVec3::Z, FRAC_PI_2 - short).unwrap();
    assert!(matches!(
        classify(&flat(0.0, 1e-5), &beside(4e-5)).class(),
        Class::NotBlendable(Obstacle::ParallelDifferentAngles { .. })
    ));
}

/// A ring that is asked for is one: where `a` and `c` agree to nine digits no double tells the ring from its limits.
#[test]
fn a_ring_blend_is_a_ring_also_between_flat_cones() {
    for short in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let [first, second] = [DVec3::ZERO, dvec3(2.0, 0.0, 0.0)]
            .map(|vertex| Cone::new(vertex, DVec3::Z, FRAC_PI_2 - short).unwrap());
        for family in classify(&first, &second).families() {
            match family.ring_blend(RingPreference::Widest) {
                Ok(blend) => assert!(blend.kind().is_ring() && blend.is_usable(), "{short:e}"),
                Err(error) => assert!(
                    short < 1e-3
                        && matches!(error, Error::NoRing { .. } | Error::NotTangent { .. }),
                    "{short:e}: {error}"
                ),
            }
        }
    }
}

/// Cylinders with parallel axes have families of one type, which need not be rings.
#[test]
fn parallel_cylinders_have_two_families_with_or_without_rings() {
    let first = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0).unwrap();
    for (offset, radius, class, rings) in [
        (0.0, 2.0, Class::IdenticalAxes, [false, true]),
        (1.0, 1.0, Class::GeneralParallel, [false, false]),
        (3.0, 1.0, Class::GeneralParallel, [true, false]),
    ] {
        let second = Cone::cylinder(DVec3::X * offset, DVec3::Z, radius).unwrap();
        let found = classify(&first, &second);
        assert_eq!(found.class(), class);
        let has: Vec<bool> = found.families().iter().map(Family::has_rings).collect();
        assert_eq!(has, rings, "{offset}");
    }
}
