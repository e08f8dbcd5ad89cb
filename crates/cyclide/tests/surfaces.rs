//! Laws of single surfaces: both conics, principal circles, distances, rays, tangent cones, blends of special cases.

mod common;
use common::pairs::Random;
use cyclide::glam::DVec3;
use cyclide::{
    Cone, CurvatureCircle, Dupin, Error, Frame, Joined, Kind, Quartic, RingPreference, classify,
    common_sphere, join,
};
use std::f64::consts::TAU;

fn frame(random: &mut Random) -> Frame {
    let rotation = random.rotation();
    Frame::from_directions(
        3.0 * random.direction(),
        rotation * DVec3::X,
        rotation * DVec3::Y,
    )
    .unwrap()
}

/// One surface of every kind.
fn zoo(random: &mut Random) -> Vec<(Kind, Dupin)> {
    let quartics = [
        (Kind::Ring, 3.0, 1.0, 2.0),
        (Kind::SinglyHorned, 3.0, 1.0, 1.0),
        (Kind::DoublyHorned, 3.0, 2.0, 1.0),
        (Kind::OneSingularitySpindle, 3.0, 1.0, 3.0),
        (Kind::TwoSingularitySpindle, 3.0, 1.0, 4.5),
        (Kind::RingTorus, 3.0, 0.0, 1.0),
        (Kind::HornTorus, 2.0, 0.0, 2.0),
        (Kind::SpindleTorus, 1.6, 0.0, 4.3),
    ];
    let parabolics = [
        (Kind::ParabolicRing, 1.0, 0.2),
        (Kind::ParabolicOneSingularity, 1.0, 0.5),
        (Kind::ParabolicTwoSingularities, 1.0, 1.2),
        (Kind::ParabolicTwoSingularities, 1.0, -0.9),
    ];
    let mut all: Vec<(Kind, Dupin)> = Vec::new();
    for (kind, a, c, mu) in quartics {
        all.push((kind, Dupin::quartic(a, c, mu, frame(random)).unwrap()));
    }
    for (kind, f, k) in parabolics {
        all.push((kind, Dupin::parabolic(f, k, frame(random)).unwrap()));
    }
    all.push((
        Kind::DoubleSphere,
        Quartic::double_sphere(2.0, 0.4, frame(random))
            .unwrap()
            .into(),
    ));
    all
}

#[test]
fn every_kind_is_named_and_lies_on_its_implicit_form() {
    let mut random = Random(1);
    for (kind, surface) in zoo(&mut random) {
        assert_eq!(surface.kind(), kind);
        assert_eq!(surface.singular_points().len(), kind.singular_point_count());
        for point in surface.singular_points() {
            assert!(
                surface.implicit(point).abs() < 1e-10 && surface.gradient(point).length() < 1e-6,
                "{kind}"
            );
        }
        for _ in 0..200 {
            let (p, q) = (random.between(-1.5, 1.5), random.between(-1.5, 1.5));
            let (point, normal) = (surface.point(p, q), surface.normal(p, q));
            assert!(surface.implicit(point).abs() < 1e-10, "{kind}");
            let first = surface.first_sphere(p);
            assert!(
                first.point_with_normal(normal).distance(point) < 1e-12,
                "{kind}"
            );
            let [along_first, along_second] = surface.principal_directions(p, q);
            assert!(
                along_first.dot(along_second).abs()
                    + along_first.dot(normal).abs()
                    + along_second.dot(normal).abs()
                    < 1e-13
            );
            assert!(
                (along_first.length() - 1.0).abs() + (along_second.length() - 1.0).abs() < 1e-13,
                "{kind}"
            );
            // Central differences against the closed derivatives.
            let step = 1e-6;
            let [by_first, by_second] = surface.partials(p, q);
            let difference =
                (surface.point(p + step, q) - surface.point(p - step, q)) / (2.0 * step);
            assert!((difference - by_first).length() < 1e-7, "{kind}");
            let difference =
                (surface.point(p, q + step) - surface.point(p, q - step)) / (2.0 * step);
            assert!((difference - by_second).length() < 1e-7, "{kind}");
            // dN = kappa dP.
            let [kappa, other] = surface.principal_curvatures(p, q);
            let turn = (surface.normal(p, q + step) - surface.normal(p, q - step)) / (2.0 * step);
            if other.abs() < 100.0 {
                assert!((turn - other * by_second).length() < 1e-6, "{kind}");
            }
            let turn = (surface.normal(p + step, q) - surface.normal(p - step, q)) / (2.0 * step);
            if kappa.abs() < 100.0 {
                assert!((turn - kappa * by_first).length() < 1e-6, "{kind}");
            }
        }
    }
}

#[test]
fn parameters_are_recovered_away_from_singular_points() {
    let mut random = Random(2);
    for (kind, surface) in zoo(&mut random) {
        for _ in 0..500 {
            let (p, q) = (random.between(-3.0, 3.0), random.between(-3.0, 3.0));
            if surface.area_density(p, q) < 0.05 {
                continue;
            }
            let [found, other] = surface.parameters_at(surface.point(p, q));
            assert!(
                surface.point(found, other).distance(surface.point(p, q)) < 1e-10,
                "{kind}"
            );
            if kind != Kind::DoubleSphere {
                assert!(
                    (found - p).abs() < 1e-9 && (other - q).abs() < 1e-9,
                    "{kind} {p} {q}: {found} {other}"
                );
            }
        }
    }
}

#[test]
fn the_closest_point_is_closer_than_samples_and_the_offset_passes_through_the_query() {
    let mut random = Random(3);
    for (kind, surface) in zoo(&mut random) {
        let at = |t: f64| {
            if kind.is_parabolic() {
                (0.5 * t).tan()
            } else {
                t
            }
        };
        let samples: Vec<DVec3> = (0..40_000)
            .map(|i| {
                surface.point(
                    at(TAU * f64::from(i % 200) / 200.0 - 3.0),
                    at(TAU * f64::from(i / 200) / 200.0 - 3.0),
                )
            })
            .collect();
        for _ in 0..40 {
            let query = surface.frame().origin() + 5.0 * random.unit() * random.direction();
            let closest = surface.closest(query).unwrap();
            let nearest = samples
                .iter()
                .map(|sample| sample.distance(query))
                .fold(f64::INFINITY, f64::min);
            assert!(
                closest.distance.abs() <= nearest + 1e-9,
                "{kind} {} {nearest}",
                closest.distance
            );
            assert!(
                (closest.point + closest.distance * closest.normal).distance(query) < 1e-9,
                "{kind}"
            );
            assert!(
                surface.signed_distance(closest.point).unwrap().abs() < 1e-6,
                "{kind}"
            );
            if let Ok(offset) = surface.offset(closest.distance) {
                assert!(
                    offset.signed_distance(query).unwrap().abs() < 1e-9,
                    "{kind}"
                );
            }
        }
        // The centres of tangent spheres are the hard queries: two roots meet there.
        for t in [0.3, 1.2, 2.2] {
            let centre = surface.first_sphere(t);
            let found = surface.closest(centre.centre).unwrap().distance.abs();
            assert!(
                found <= centre.radius.abs() + 1e-7,
                "{kind}: {found} {}",
                centre.radius
            );
        }
    }
}

#[test]
fn rays_meet_the_points_they_were_aimed_at() {
    let mut random = Random(4);
    for (kind, surface) in zoo(&mut random) {
        for _ in 0..500 {
            let target = surface.point(random.between(-1.2, 1.2), random.between(-1.2, 1.2));
            let direction = random.direction() * random.between(0.1, 10.0);
            let origin = target - random.between(0.5, 5.0) * direction;
            let hits = surface.intersect(origin, direction).unwrap();
            let miss = hits
                .iter()
                .map(|hit| (origin + hit.s * direction).distance(target))
                .fold(f64::INFINITY, f64::min);
            assert!(miss < 1e-5, "{kind}: {miss:e} {hits:?}");
            assert!(hits.windows(2).all(|pair| pair[0].s <= pair[1].s), "{kind}");
            for hit in hits.iter() {
                assert!(
                    surface
                        .signed_distance(origin + hit.s * direction)
                        .unwrap()
                        .abs()
                        < 1e-6,
                    "{kind}"
                );
            }
        }
    }
}

#[test]
fn rays_that_touch_or_pass_singular_points_count_them_twice() {
    let torus = Dupin::torus(3.0, 1.0, Frame::WORLD).unwrap();
    let hits = torus
        .intersect(DVec3::new(-9.0, 0.0, 1.0), DVec3::X)
        .unwrap();
    assert!(
        hits.len() == 2 && hits.iter().all(|hit| hit.multiplicity == 2),
        "{hits:?}"
    );
    assert!(
        (hits[0].s - 6.0).abs() < 1e-10 && (hits[1].s - 12.0).abs() < 1e-10,
        "{hits:?}"
    );
    let horned = Dupin::quartic(3.0, 1.0, 1.0, Frame::WORLD).unwrap();
    let hits = horned
        .intersect(DVec3::new(3.0, 0.0, -5.0), DVec3::Z)
        .unwrap();
    assert!(
        hits.iter().any(|hit| (hit.s - 5.0).abs() < 1e-6),
        "{hits:?}"
    );
    assert!(
        torus.intersect(DVec3::ZERO, DVec3::ZERO).is_err()
            && torus.intersect(DVec3::NAN, DVec3::X).is_err()
    );
    // A line far away misses; one so far away that it has no digits left near the surface is refused.
    let from = |height: f64| torus.intersect(DVec3::new(0.0, 0.0, height), DVec3::X);
    assert!(from(1e60).unwrap().is_empty());
    assert!(matches!(from(1e300), Err(Error::LengthOutOfRange { .. })));
}

#[test]
fn both_conics_and_three_spheres_give_the_surface_back() {
    let mut random = Random(5);
    for (kind, surface) in zoo(&mut random) {
        if kind == Kind::DoubleSphere {
            continue;
        }
        for canal in [
            surface.first_canal([0.2, 1.4]).unwrap(),
            surface.second_canal([0.1, 0.9]).unwrap(),
        ] {
            let found = Dupin::from_canal(&canal).unwrap();
            assert_eq!(
                found.surface.kind_within(1e-8),
                kind,
                "{found:?} {surface:?}"
            );
            for _ in 0..20 {
                let point = surface.point(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                assert!(
                    found.surface.signed_distance(point).unwrap().abs() < 1e-8,
                    "{kind}"
                );
            }
        }
    }
}

#[test]
fn principal_circles_with_tangent_circles_give_the_surface_back() {
    let mut random = Random(6);
    for (kind, surface) in zoo(&mut random) {
        let frame = *surface.frame();
        match &surface {
            Dupin::Quartic(quartic) if kind != Kind::DoubleSphere => {
                let [zero, pi, theta_zero, theta_pi] = quartic.principal_circles();
                let great = |sphere: lorentz::Cycle, axis: DVec3| CurvatureCircle {
                    centre: sphere.centre,
                    radius: sphere.radius.abs(),
                    axis,
                };
                let in_z = [0.7, 2.0].map(|theta| great(quartic.theta_sphere(theta), frame.z()));
                let in_y = [0.5, 0.9].map(|psi| great(quartic.psi_sphere(psi), frame.y()));
                for (circles, tangents) in [([zero, pi], in_z), ([theta_zero, theta_pi], in_y)] {
                    let found = Dupin::from_principal_circles(circles, tangents)
                        .unwrap_or_else(|error| panic!("{kind}: {error}"));
                    let point = surface.point(0.4, 0.8);
                    assert!(
                        found.signed_distance(point).unwrap().abs() < 1e-9,
                        "{kind}: {found:?}"
                    );
                    assert_eq!(found.kind_within(1e-9), kind);
                }
            }
            Dupin::Parabolic(parabolic) => {
                let line = frame.point_to_world(DVec3::X * (-parabolic.f() - parabolic.k()));
                let sphere = parabolic.u_sphere(0.6);
                let tangent = CurvatureCircle {
                    centre: sphere.centre,
                    radius: sphere.radius.abs(),
                    axis: frame.z(),
                };
                let circle = CurvatureCircle {
                    axis: frame.z(),
                    ..parabolic.v_circle(0.0)
                };
                if sphere.radius <= 0.0 {
                    continue;
                }
                let found = Dupin::from_principal_line_and_circle(line, frame.y(), circle, tangent)
                    .unwrap();
                assert!(
                    found
                        .signed_distance(surface.point(0.4, 0.8))
                        .unwrap()
                        .abs()
                        < 1e-9,
                    "{kind}"
                );
            }
            Dupin::Quartic(_) => {}
        }
    }
}

#[test]
fn circles_of_one_family_lie_on_spheres_and_cones_touch_along_them() {
    let mut random = Random(7);
    for (kind, surface) in zoo(&mut random) {
        if kind == Kind::DoubleSphere {
            continue;
        }
        for (one, other) in [(0.3, 1.1), (0.4, 0.9)] {
            let circles = [surface.first_circle(one), surface.first_circle(other)];
            let sphere = common_sphere(&circles[0], &circles[1])
                .expect("a sphere")
                .sphere()
                .expect("no plane");
            for circle in circles {
                assert!(
                    (circle.point(1.0).distance(sphere.centre()) - sphere.radius().abs()).abs()
                        < 1e-9 * sphere.radius().abs().max(1.0)
                );
            }
            let cone = surface.first_tangent_cone(one).expect("a cone");
            let family = if kind.is_parabolic() {
                cyclide::ContactFamily::U
            } else {
                cyclide::ContactFamily::Theta
            };
            assert!(
                cyclide::contact_residual(&surface, family, one, &cone) < 1e-10,
                "{kind}"
            );
        }
        let [first, second] = surface.axes().unwrap();
        assert!(
            first.is_some() && (second.is_some() || kind.is_torus()),
            "{kind}"
        );
    }
}

#[test]
fn villarceau_circles_lie_on_the_ring() {
    let mut random = Random(8);
    for c in [0.0, 1.0, 1.9] {
        let ring = Quartic::new(3.0, c, 2.0, frame(&mut random)).unwrap();
        let point = ring.point(0.8, 2.2);
        let through = ring.villarceau_circles_at(point).unwrap();
        for circle in through {
            assert!(circle.distance(point) < 1e-10);
            for i in 0..20 {
                let on_circle = circle
                    .point(f64::from(i), DVec3::new(0.3, 0.5, 0.9))
                    .unwrap();
                assert!(Dupin::from(ring).signed_distance(on_circle).unwrap().abs() < 1e-10);
            }
        }
    }
    assert!(matches!(
        Quartic::new(3.0, 2.0, 1.0, Frame::WORLD)
            .unwrap()
            .villarceau_circle(0.0, 1.0),
        Err(Error::NotARing { .. })
    ));
}

/// Shene's counterexample: a common inscribed sphere is not enough for a revolute quadric. The tangent cones of the ellipsoid contain it
/// properly, so none shares the cylinder's sphere, and no circle of the ellipsoid is joined to the cylinder.
#[test]
fn an_ellipsoid_and_a_cylinder_with_a_common_sphere_have_no_blend() {
    // The ellipsoid x²/9 + y² + z² = 1 holds the unit sphere; so does the cylinder about y.
    let cylinder = Cone::cylinder(DVec3::ZERO, DVec3::Y, 1.0).unwrap();
    for step in 1..100 {
        let x = -3.0 + 6.0 * f64::from(step) / 100.0;
        let radius = (1.0 - x * x / 9.0).sqrt();
        if x == 0.0 {
            continue;
        }
        // The tangent at (x, radius) meets the axis in 9 / x.
        let vertex = DVec3::X * (9.0 / x);
        let half_angle = (radius / (9.0 / x - x).abs()).atan();
        let tangent_cone = Cone::new(vertex, -DVec3::X * x.signum(), half_angle).unwrap();
        let found = classify(&tangent_cone, &cylinder);
        assert!(found.families().is_empty(), "x = {x}: {}", found.class());
        assert!(found.obstacle().is_some());
    }
}

#[test]
fn a_parallel_pair_of_circles_is_joined_once_and_others_twice() {
    let first = Cone::new(DVec3::new(0.0, 0.0, 4.0), -DVec3::Z, 0.4).unwrap();
    let second =
        Cone::cylinder(DVec3::new(0.0, 3.0, -1.0), DVec3::new(0.2, 1.0, 0.1), 0.7).unwrap();
    let circles = [first.circle_at(3.0), second.circle_at(1.0)];
    let Joined::Twice(double) = join([&first, &second], [&circles[0], &circles[1]]).unwrap() else {
        panic!("one cyclide for skew axes")
    };
    assert!(double.residual() < 1e-9);
    for (contact, circle) in [
        (double.first.contacts()[0], circles[0]),
        (double.second.contacts()[1], circles[1]),
    ] {
        assert!(
            contact.circle.centre.distance(circle.centre) < 1e-9
                && (contact.circle.radius - circle.radius).abs() < 1e-9
        );
    }
    let joints = [
        double.first.contacts()[1].circle,
        double.second.contacts()[0].circle,
    ];
    assert!(
        joints[0].centre.distance(joints[1].centre) < 1e-9
            && (joints[0].radius - joints[1].radius).abs() < 1e-9
    );
    assert!(double.tubes.iter().all(|tube| tube.is_smooth()));

    // Two members of one family are joined by that member.
    let second = Cone::new(DVec3::new(3.0, 0.0, 0.0), DVec3::new(-1.0, 0.0, 0.2), 0.5).unwrap();
    let vertex = second.point();
    let meet = DVec3::ZERO;
    let radius = (meet - vertex).length() * 0.5_f64.sin();
    let axis = (meet - vertex).normalize();
    let second = Cone::new(vertex, axis, 0.5).unwrap();
    let first = Cone::new(DVec3::Z * (radius / 0.4_f64.sin()), -DVec3::Z, 0.4).unwrap();
    let blend = classify(&first, &second).families()[0]
        .ring_blend(RingPreference::Widest)
        .unwrap();
    let circles = blend.contacts().map(|contact| contact.circle);
    let Joined::Once(same) = join([&first, &second], [&circles[0], &circles[1]]).unwrap() else {
        panic!("two cyclides where one will do")
    };
    assert!((same.parameter() - blend.parameter()).abs() < 1e-9);
    assert!(join([&first, &second], [&circles[1], &circles[0]]).is_err());
}

#[test]
fn hostile_cones_and_surfaces_are_refused() {
    assert!(matches!(
        Cone::new(DVec3::ZERO, DVec3::ZERO, 0.4),
        Err(Error::Axis { .. })
    ));
    assert!(matches!(
        Cone::new(DVec3::ZERO, DVec3::INFINITY, 0.4),
        Err(Error::Axis { .. })
    ));
    for angle in [
        0.0,
        -0.3,
        std::f64::consts::FRAC_PI_2,
        f64::NAN,
        f64::INFINITY,
    ] {
        assert!(matches!(
            Cone::new(DVec3::ZERO, DVec3::X, angle),
            Err(Error::HalfAngle { .. })
        ));
    }
    assert!(
        Cone::new(DVec3::NAN, DVec3::X, 0.4).is_err()
            && Cone::cylinder(DVec3::ZERO, DVec3::X, 0.0).is_err()
    );
    for (a, c, mu) in [
        (1.0, 2.0, 1.0),
        (1.0, -0.5, 1.0),
        (f64::NAN, 0.0, 1.0),
        (1.0, 0.0, f64::INFINITY),
        (0.0, 0.0, 0.0),
        (1.0, 1.0, 0.5),
    ] {
        assert!(Dupin::quartic(a, c, mu, Frame::WORLD).is_err());
    }
    for f in [0.0, -1.0, f64::NAN] {
        assert!(Dupin::parabolic(f, 0.0, Frame::WORLD).is_err());
    }
    assert!(Frame::new(DVec3::ZERO, DVec3::X, DVec3::X, DVec3::Z).is_err());
    assert!(Frame::new(DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::Y).is_err());
    // Huge, tiny and nearly coincident cones give an answer.
    assert!(matches!(
        Cone::new(DVec3::Y * 1e150, DVec3::X, 0.4),
        Err(Error::LengthOutOfRange { .. })
    ));
    for scale in [1e-150, 1e-12, 1e12, 1e60] {
        let cones = [
            Cone::new(DVec3::ZERO, DVec3::X, 0.4),
            Cone::new(DVec3::Y * scale, DVec3::new(1.0, 0.5, 0.0), 0.6),
        ]
        .map(Result::unwrap);
        for family in classify(&cones[0], &cones[1]).families() {
            for t in [0.0, f64::NAN, f64::INFINITY, 1e-300, 1.0, 1e300] {
                let _ = family.blend(t);
                let _ = family.ring_blend(RingPreference::SmallestCurvature { reach: t });
            }
        }
    }
}

/// Directions have any length that a double holds, and rays start as far away as a length may be.
#[test]
fn directions_of_any_length_and_distant_origins_are_rays() {
    let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap();
    for length in [1e-300, 1e-200, 1.0, 1e200, 1e308] {
        let hits = ring
            .intersect(DVec3::new(-10.0, 0.0, 0.0), DVec3::X * length)
            .unwrap();
        let x: Vec<f64> = hits.iter().map(|hit| hit.s * length - 10.0).collect();
        for (x, expected) in x.iter().zip([-6.0, 0.0, 2.0, 4.0]) {
            assert!((x - expected).abs() < 1e-12, "{length:e}: {x:?}");
        }
        assert_eq!(x.len(), 4);
        let cone = Cone::new(DVec3::ZERO, DVec3::Z * length, 0.4).unwrap();
        assert_eq!(cone.axis(), DVec3::Z);
        assert!(Cone::cylinder(DVec3::ZERO, DVec3::splat(length), 1.0).is_ok());
        assert!(Frame::around(DVec3::ZERO, DVec3::splat(length)).is_some());
    }
    assert_eq!(
        ring.intersect(DVec3::new(-10.0, 0.0, 0.0), DVec3::X * 5e-324),
        Err(Error::Direction)
    );
    for distance in [1e9, 1e17, 1e30, 1e69] {
        let hits = ring
            .intersect(DVec3::new(-distance, 0.0, 0.0), DVec3::X)
            .unwrap();
        assert_eq!(hits.len(), 4);
        for (hit, expected) in hits.iter().zip([-6.0, 0.0, 2.0, 4.0]) {
            assert!((hit.s - distance - expected).abs() <= hit.error, "{hit:?}");
        }
    }
}

#[test]
fn parameters_at_the_ends_of_their_ranges_are_as_documented() {
    let ring = *Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)
        .unwrap()
        .as_quartic()
        .unwrap();
    for zero in [0.0, -0.0] {
        for place in [DVec3::new(-6.0, zero, zero), DVec3::new(-6.0, zero, -zero)] {
            let angles = ring.parameters_at(place);
            assert!(
                angles.iter().all(|&angle| angle > -TAU / 2.0),
                "{place} {angles:?}"
            );
        }
    }
    let sphere = Quartic::double_sphere(1.0, 0.0, Frame::WORLD).unwrap();
    for place in [DVec3::new(1.0, 0.0, 0.0), DVec3::new(1.0, -0.0, -0.0)] {
        assert!(sphere.parameters_at(place)[0] > -TAU / 2.0);
    }
    let parabolic = Dupin::parabolic(1.0, 0.25, Frame::WORLD).unwrap();
    let on_axis = parabolic.parameters_at(DVec3::new(0.75, 0.0, 0.5));
    assert_eq!(on_axis, [f64::INFINITY, 0.25]);
    let on_other = parabolic.parameters_at(DVec3::new(-1.25, 0.5, 0.0));
    assert_eq!(on_other, [0.25, f64::INFINITY]);
    for sign in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            ring.villarceau_circle(0.3, sign),
            Err(Error::NotFinite { what: "sign", .. })
        ));
    }
}

/// Next to a sphere the squares of the closed form cancel; the parameters keep their digits all the same.
#[test]
fn parameters_of_nearly_spherical_surfaces_keep_their_digits() {
    let mut random = Random(61);
    for share in [1e-9, 1e-7, 1e-5, 0.9e-3, 1.1e-3] {
        for _ in 0..200 {
            let surface = Dupin::quartic(share, 0.4 * share, 1.0, Frame::WORLD).unwrap();
            let theta = random.between(-3.1, 3.1);
            // Away from the poles, where theta has no digits.
            let psi = random.between(-1.4, 1.4) + if random.unit() < 0.5 { 0.0 } else { TAU / 2.0 };
            let [found_theta, found_psi] = surface.parameters_at(surface.point(theta, psi));
            assert!(
                (found_theta - theta).sin().abs() < 1e-11,
                "{share:e}: {theta}"
            );
            let difference = (found_psi - psi).sin().abs();
            assert!(difference < 1e-11, "{share:e}: {psi} {found_psi}");
            assert!(found_psi > -TAU / 2.0 && found_psi <= TAU / 2.0);
            assert!((found_psi - psi).cos() > 0.0 && (found_theta - theta).cos() > 0.0);
        }
    }
}
