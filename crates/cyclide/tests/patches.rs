//! Patches and their way back, on random surfaces of every type.

mod common;
use bezier_mass::{Biquadratic, MassPoint};
use common::pairs::Random;
use cyclide::glam::DVec3;
use cyclide::{
    Dupin, Error, Frame, Kind, convert, convert_torus, inspect, patch_from_corners, solve_weights,
};

const PATCHES: u32 = 10_000;

fn frame(random: &mut Random, scale: f64) -> Frame {
    let rotation = random.rotation();
    let origin = 3.0 * scale * random.unit() * random.direction();
    Frame::from_directions(origin, rotation * DVec3::X, rotation * DVec3::Y).unwrap()
}

/// A quartic with `c / a` below 0.999 and the lengths of any type, or a torus now and then.
fn quartic(random: &mut Random) -> Dupin {
    let scale = 10_f64.powf(random.between(-3.0, 3.0));
    let a = scale * random.between(0.5, 3.0);
    let c = if random.unit() < 0.1 {
        0.0
    } else {
        a * random.between(0.001, 0.999)
    };
    let mu = scale * random.between(0.05, 5.0);
    Dupin::quartic(a, c, mu, frame(random, scale)).unwrap()
}

fn span(random: &mut Random) -> [f64; 2] {
    let from = random.between(0.0, std::f64::consts::TAU);
    [from, from + random.sign() * random.between(0.2, 3.0)]
}

/// Transposed, reversed, and reparametrised by a homography: still the same patch.
fn disguised(net: Biquadratic<DVec3>, random: &mut Random) -> Biquadratic<DVec3> {
    let mut net = net;
    if random.unit() < 0.5 {
        net = net.transposed();
    }
    if random.unit() < 0.5 {
        net = net.reversed_u();
    }
    let (l, r, all) = (
        random.between(0.3, 3.0),
        random.between(0.3, 3.0),
        random.sign() * random.between(0.1, 10.0),
    );
    let control = net.control();
    let powers = |ratio: f64| [1.0, ratio, ratio * ratio];
    Biquadratic::new(
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| control[i][j] * (all * powers(l)[i] * powers(r)[j]))),
    )
    .unwrap()
}

/// Whether the patch stays clear of singular points, where a tangent sphere shrinks to a point.
fn is_clear(surface: &Dupin, first: [f64; 2], second: [f64; 2]) -> bool {
    let at = |[from, to]: [f64; 2], i: u32| from + (to - from) * f64::from(i) / 24.0;
    let size = surface
        .as_quartic()
        .map_or(1.0, |quartic| quartic.a().max(quartic.mu()));
    let signs = |radius: &dyn Fn(u32) -> f64| {
        let values: Vec<f64> = (0..=24).map(radius).collect();
        values.iter().all(|value| *value > 0.02 * size)
            || values.iter().all(|value| *value < -0.02 * size)
    };
    let quartic = *surface.as_quartic().unwrap();
    signs(&|i| quartic.mu() - quartic.c() * at(first, i).cos())
        && signs(&|i| quartic.a() - quartic.mu() * at(second, i).cos())
}

#[test]
fn random_patches_come_back() {
    let mut random = Random(3);
    let (mut worst, mut singular, mut tested) = (0.0_f64, 0_u32, 0_u32);
    while tested < PATCHES {
        let surface = quartic(&mut random);
        let (first, second) = (span(&mut random), span(&mut random));
        let net = disguised(*surface.patch(first, second).unwrap().net(), &mut random);
        if !is_clear(&surface, first, second) {
            // Through a singular point: either it comes back or it is refused, and never a panic.
            singular += 1;
            if let Ok(found) = convert(&net) {
                assert!(found.residual <= 1e-8);
            }
            continue;
        }
        tested += 1;
        let found = convert(&net).unwrap_or_else(|error| {
            panic!("{tested}: {error} for {surface:?} {first:?} {second:?}")
        });
        worst = worst.max(found.residual);
        let (one, other) = (
            surface.as_quartic().unwrap(),
            found.surface.as_quartic().unwrap(),
        );
        let size = one.a().max(one.mu());
        let parameters = [
            one.a() - other.a(),
            one.c() - other.c(),
            one.mu() - other.mu(),
        ];
        assert!(
            parameters
                .iter()
                .all(|difference| difference.abs() < 1e-5 * size),
            "{surface:?} {found:?}"
        );
    }
    println!(
        "worst residual {worst:.1e}; {singular} patches through or near singular points beside"
    );
    assert!(worst < 1e-8);
}

#[test]
fn parabolic_and_spherical_patches_come_back() {
    let mut random = Random(5);
    let mut worst = 0.0_f64;
    for index in 0..2000 {
        let scale = 10_f64.powf(random.between(-3.0, 3.0));
        let frame = frame(&mut random, scale);
        let surface = if index % 2 == 0 {
            // Singular points, if any, are at smaller v than the patches.
            let f = scale * random.between(0.3, 2.0);
            Dupin::parabolic(f, f * random.between(-0.45, 0.9), frame).unwrap()
        } else {
            cyclide::Quartic::double_sphere(
                scale * random.between(0.5, 2.0),
                random.between(0.0, 0.9),
                frame,
            )
            .unwrap()
            .into()
        };
        let patch = if index % 2 == 0 {
            let (u, v) = (random.between(-1.0, 0.5), random.between(0.8, 1.4));
            surface.patch(
                [u, u + random.between(0.3, 1.0)],
                [v, v + random.between(0.3, 1.0)],
            )
        } else {
            // Away from the poles, where circles shrink.
            let psi = random.between(-1.0, 0.3);
            let theta = random.between(0.0, 6.0);
            surface.patch(
                [theta, theta + random.between(0.3, 3.0)],
                [psi, psi + random.between(0.2, 1.0)],
            )
        };
        let found = convert(&disguised(*patch.unwrap().net(), &mut random))
            .unwrap_or_else(|error| panic!("{index}: {error}, {surface:?}"));
        assert_eq!(found.kind().is_parabolic(), index % 2 == 0);
        worst = worst.max(found.residual);
    }
    println!("worst residual {worst:.1e}");
    assert!(worst < 1e-8);
}

#[test]
fn solved_weights_are_those_of_the_surface() {
    let mut random = Random(8);
    for _ in 0..500 {
        let surface = quartic(&mut random);
        let (first, second) = (span(&mut random), span(&mut random));
        if !is_clear(&surface, first, second) {
            continue;
        }
        let net = surface
            .patch(first, second)
            .unwrap()
            .normalised_net()
            .unwrap();
        let control = net.control();
        if control
            .as_flattened()
            .iter()
            .any(|mass_point| mass_point.weight.abs() < 0.05)
        {
            continue;
        }
        let report = inspect(&net).unwrap();
        // Accuracy is relative to the net; near infinity a weight is a difference of large coordinates.
        assert!(
            report.check().is_ok(),
            "{report:?} {surface:?} {first:?} {second:?}"
        );
        let points = control.map(|row| row.map(|mass_point| mass_point.position().unwrap()));
        let solved = solve_weights(&points).unwrap();
        for (solved, control) in solved
            .control()
            .as_flattened()
            .iter()
            .zip(control.as_flattened())
        {
            assert!(
                (solved.weight.abs() - control.weight.abs()).abs()
                    < 1e-7 * control.weight.abs().max(1.0)
            );
        }
    }
}

#[test]
fn corners_with_a_frame_make_a_patch_that_converts() {
    let mut random = Random(21);
    let mut made = 0;
    for _ in 0..1000 {
        let (centre, axis) = (random.direction(), random.direction());
        let (u, v) = (
            axis.any_orthonormal_vector(),
            axis.cross(axis.any_orthonormal_vector()),
        );
        let mut angles = [0; 4].map(|_| random.between(0.0, std::f64::consts::TAU));
        angles.sort_by(f64::total_cmp);
        if (1..4).any(|i| angles[i] - angles[i - 1] < 0.4) || angles[3] - angles[0] > 5.8 {
            continue;
        }
        let on_circle = angles.map(|angle| centre + 1.5 * (angle.cos() * u + angle.sin() * v));
        let corners = [on_circle[0], on_circle[1], on_circle[3], on_circle[2]];
        let row = random.direction();
        let column = row.cross(random.direction()).normalize();
        match patch_from_corners(corners, row, column) {
            Ok(net) => {
                made += 1;
                match convert(&net) {
                    Ok(found) => assert!(found.residual < 1e-8),
                    // A patch may run through a singular point, where it has no normal.
                    Err(
                        Error::NetResidual { .. }
                        | Error::NoNormal { .. }
                        | Error::CornerWeights { .. },
                    ) => {}
                    Err(error) => panic!("{error}"),
                }
            }
            Err(Error::Corners { .. } | Error::NotAPatch { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    }
    assert!(made > 200, "{made}");
}

#[test]
fn a_torus_keeps_the_frame_of_the_hint() {
    let torus = Dupin::torus(1.63, 4.32, Frame::WORLD).unwrap();
    let patch = torus
        .patch(
            [2.526_112_925, 3.757_072_362],
            [2.427_868_285, 3.855_317_02],
        )
        .unwrap();
    let found = convert_torus(&patch.net().transposed(), Some([DVec3::X, DVec3::Z])).unwrap();
    assert_eq!(found.kind(), Kind::SpindleTorus);
    let angles = [
        found.first[0] - 2.526_112_925,
        found.first[1] - 3.757_072_362,
        found.second[0] - 2.427_868_285,
        found.second[1] - 3.855_317_02,
    ];
    assert!(angles.iter().all(|angle| angle.abs() < 1e-13), "{angles:?}");
}

#[test]
fn positive_patches_cover_the_area() {
    let surface = Dupin::quartic(3.0, 2.0, 1.0, Frame::WORLD).unwrap();
    let whole = [0.0, std::f64::consts::TAU];
    let patches = surface
        .positive_patches(whole, whole, cyclide::tolerance::POSITIVE_WEIGHT)
        .unwrap();
    let area: f64 = patches
        .iter()
        .map(|patch| surface.area(patch.first(), patch.second()).unwrap())
        .sum();
    assert!((area - surface.area(whole, whole).unwrap()).abs() < 1e-9 * area);
    assert!(patches.iter().all(|patch| patch.has_weights_above(0.05)));
}

#[test]
fn the_atlas_of_a_parabolic_cyclide_reaches_infinity() {
    let surface = Dupin::parabolic(1.0, 0.2, Frame::WORLD).unwrap();
    let atlas = surface.atlas().unwrap();
    assert_eq!(atlas.len(), 9);
    for patch in &atlas {
        for (u, v) in [(0.2, 0.3), (0.5, 0.5), (0.9, 0.4)] {
            let point = patch.net().point(u, v).unwrap();
            assert!(
                surface.signed_distance(point).unwrap().abs() < 1e-9 * (1.0 + point.length()),
                "{patch:?}"
            );
        }
    }
}

/// The collinearity of the tangent spheres is decided to 1e-9, not to the square root of the rounding.
#[test]
fn patches_of_cones_and_cylinders_are_named() {
    let mut random = Random(17);
    for _ in 0..500 {
        let place = frame(&mut random, 1.0);
        let (half, height) = (random.between(0.2, 1.4), random.between(0.3, 2.0));
        let radii = [random.between(0.4, 2.0), random.between(0.4, 2.0)];
        let end = radii[usize::from(random.unit() < 0.5)];
        let row = |share: f64| {
            let (radius, z) = (radii[0] + share * (end - radii[0]), share * height);
            [
                (1.0, half.cos(), -half.sin()),
                (half.cos(), 1.0, 0.0),
                (1.0, half.cos(), half.sin()),
            ]
            .map(|(w, c, s)| {
                let local = DVec3::new(radius * c, radius * s, z * w);
                MassPoint::from_homogeneous(w, place.vector_to_world(local) + w * place.origin())
            })
        };
        let net = Biquadratic::new([row(0.0), row(0.5), row(1.0)]).unwrap();
        assert_eq!(convert(&net), Err(Error::ConeOrCylinder));
        assert_eq!(convert(&net.transposed()), Err(Error::ConeOrCylinder));
    }
}

/// The free direction of a torus points to the centre of the first circle, whichever way the net's normals point.
#[test]
fn a_torus_starts_at_angle_zero() {
    let mut random = Random(18);
    for _ in 0..500 {
        let place = frame(&mut random, 1.0);
        let (a, mu) = (random.between(0.5, 3.0), random.between(0.2, 4.0));
        let surface = Dupin::quartic(a, 0.0, mu, place).unwrap();
        let (first, second) = (span(&mut random), span(&mut random));
        if !is_clear(&surface, first, second) {
            continue;
        }
        let net = *surface.patch(first, second).unwrap().net();
        let found = convert(&net).unwrap();
        assert!((0.0..1e-12).contains(&found.first[0]));
        let start = if first[1] > first[0] {
            first[0]
        } else {
            -first[0]
        };
        let (sin, cos) = start.sin_cos();
        let y = if first[1] > first[0] {
            place.y()
        } else {
            -place.y()
        };
        let towards = cos * place.x() + sin * y;
        assert!(found.surface.frame().x().distance(towards) < 1e-9);
    }
}

#[test]
fn hostile_nets_are_refused() {
    let good = *Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)
        .unwrap()
        .patch([0.3, 1.7], [0.4, 1.9])
        .unwrap()
        .net();
    let spoilt = |i: usize, j: usize, with: MassPoint<DVec3>| {
        let mut control = *good.control();
        control[i][j] = with;
        Biquadratic::new(control)
    };
    assert!(spoilt(1, 1, MassPoint::point(DVec3::NAN, 1.0)).is_err());
    for (i, j) in [(0, 0), (0, 1), (1, 1), (2, 2)] {
        for with in [
            MassPoint::vector(DVec3::ZERO),
            MassPoint::vector(DVec3::X),
            MassPoint::point(DVec3::splat(1e150), 1.0),
            MassPoint::point(DVec3::ZERO, -1.0),
        ] {
            let net = spoilt(i, j, with).unwrap();
            assert!(
                convert(&net).is_err() && convert_torus(&net, None).is_err(),
                "{i} {j} {with:?}"
            );
        }
    }
    let collapsed = Biquadratic::new([[MassPoint::point(DVec3::ONE, 1.0); 3]; 3]).unwrap();
    assert!(
        convert(&collapsed).is_err()
            && inspect(&collapsed)
                .and_then(|report| report.check())
                .is_err()
    );
    let point = DVec3::ZERO;
    assert!(solve_weights(&[[point; 3]; 3]).is_err());
    assert!(solve_weights(&[[DVec3::INFINITY; 3]; 3]).is_err());
    assert!(patch_from_corners([point; 4], DVec3::X, DVec3::Y).is_err());
    for span in [
        [0.0, 0.0],
        [0.0, 7.0],
        [f64::NAN, 1.0],
        [0.0, f64::INFINITY],
    ] {
        let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap();
        assert!(ring.patch(span, [0.0, 1.0]).is_err());
        assert!(ring.positive_patches(span, [0.0, 1.0], 0.05).is_err());
    }
}

/// The weights of nearly a full turn gather almost all of it in a small part of the net.
#[test]
fn patches_of_nearly_a_full_turn_come_back() {
    let mut random = Random(31);
    for turn in [6.05, 6.1, 6.15, 6.2, std::f64::consts::TAU - 0.003] {
        let (mut worst, mut failures) = (0.0_f64, 0);
        for index in 0..400 {
            let scale = 10_f64.powf(random.between(-3.0, 3.0));
            let a = scale * random.between(0.5, 3.0);
            let c = a * random.between(0.0, 0.97);
            // A ring has no singular point on the way round.
            let mu = random.between(c + 0.02 * (a - c), a - 0.02 * (a - c));
            let surface = Dupin::quartic(a, c, mu, frame(&mut random, scale)).unwrap();
            let from = random.between(0.0, 6.0);
            let long = [from, from + random.sign() * turn];
            let short = span(&mut random);
            let patch = if index % 2 == 0 {
                surface.patch(long, short)
            } else {
                surface.patch(short, long)
            };
            match convert(&disguised(*patch.unwrap().net(), &mut random)) {
                Ok(found) => worst = worst.max(found.residual),
                Err(error) => {
                    failures += 1;
                    println!("{turn} {index}: {error} {surface:?} {from}");
                }
            }
        }
        println!("turn {turn}: {failures} of 400 refused, worst residual {worst:.1e}");
        assert_eq!(failures, 0);
    }
}

/// At a pole a circle of the net shrinks to a point, and beyond it the normals of the net are reversed.
#[test]
fn double_spheres_come_back_across_their_poles() {
    let mut random = Random(33);
    let half = std::f64::consts::FRAC_PI_2;
    let sphere = |e: f64| -> Dupin {
        cyclide::Quartic::double_sphere(1.3, e, Frame::WORLD)
            .unwrap()
            .into()
    };
    for (e, first, second) in [
        (0.0, [0.3, 2.0], [-2.0, -0.5]),
        (0.0, [0.0, 1.0], [half, 2.0]),
        (0.4, [0.0, 1.0], [half, 2.0]),
        (0.0, [0.0, 1.0], [0.3, half]),
        (0.3, [0.0, std::f64::consts::PI], [-half, half]),
        (0.0, [0.2, 1.2], [half - 1e-3, half + 0.4]),
    ] {
        let net = *sphere(e).patch(first, second).unwrap().net();
        let found =
            convert(&net).unwrap_or_else(|error| panic!("{error}: {e} {first:?} {second:?}"));
        assert_eq!(found.kind(), Kind::DoubleSphere);
        assert!(found.residual < 1e-9, "{found:?}");
    }
    let (mut worst, mut failures) = (0.0_f64, 0);
    for index in 0..1000 {
        let scale = 10_f64.powf(random.between(-3.0, 3.0));
        let surface: Dupin = cyclide::Quartic::double_sphere(
            scale * random.between(0.5, 2.0),
            if index % 4 == 0 {
                0.0
            } else {
                random.between(0.0, 0.95)
            },
            frame(&mut random, scale),
        )
        .unwrap()
        .into();
        let theta = random.between(0.0, 6.0);
        let pole = random.sign() * half;
        let mut second = [
            pole - random.between(0.05, 1.2),
            pole + random.between(0.05, 1.2),
        ];
        if random.unit() < 0.5 {
            second.reverse();
        }
        let first = [theta, theta + random.sign() * random.between(0.2, 3.0)];
        let net = disguised(*surface.patch(first, second).unwrap().net(), &mut random);
        match convert(&net) {
            Ok(found) => worst = worst.max(found.residual),
            Err(error) => {
                failures += 1;
                println!("{index}: {error} {first:?} {second:?} {surface:?}");
            }
        }
    }
    println!("{failures} of 1000 refused, worst residual {worst:.1e}");
    assert_eq!(failures, 0);
}

/// The corners and the frame at the first one of a patch of a surface.
fn corner_data(surface: &Dupin, first: [f64; 2], second: [f64; 2]) -> ([DVec3; 4], [DVec3; 2]) {
    let at = |i: usize, j: usize| surface.point(first[i], second[j]);
    let [along_first, along_second] = surface.partials(first[0], second[0]);
    (
        [at(0, 0), at(0, 1), at(1, 0), at(1, 1)],
        [along_second, along_first],
    )
}

/// The tangent planes of an elbow with semicircular ends are parallel, or one plane, and its central control is a vector.
#[test]
fn corners_of_an_elbow_make_its_patch() {
    let half = std::f64::consts::FRAC_PI_2;
    let torus = Dupin::torus(3.0, 1.0, Frame::WORLD).unwrap();
    let mut random = Random(41);
    let turned = Dupin::torus(3e-3, 1e-3, frame(&mut random, 1.0)).unwrap();
    for surface in [torus, turned] {
        for (first, second) in [
            ([0.0, 1.0], [-half, half]),
            ([0.4, 2.0 * half + 0.4], [-half, half]),
            ([0.0, 2.0 * half], [0.3, 1.2]),
            ([0.1, 1.3], [0.2, 0.9]),
        ] {
            let (corners, [row, column]) = corner_data(&surface, first, second);
            let net = patch_from_corners(corners, row, column).unwrap();
            let expected = surface
                .patch(first, second)
                .unwrap()
                .normalised_net()
                .unwrap();
            for (made, expected) in net
                .control()
                .as_flattened()
                .iter()
                .zip(expected.control().as_flattened())
            {
                assert!(
                    (made.weight - expected.weight).abs() < 1e-11,
                    "{made:?} {expected:?}"
                );
                assert!(
                    made.weighted.distance(expected.weighted) < 1e-11,
                    "{made:?} {expected:?}"
                );
            }
            assert!(convert(&net).unwrap().residual < 1e-9);
        }
    }
    let (corners, [row, column]) = corner_data(&torus, [0.0, 1.0], [-half, half]);
    let off = [
        corners[0],
        corners[1],
        corners[2],
        corners[3] + 0.1 * DVec3::Z,
    ];
    assert!(matches!(
        patch_from_corners(off, row, column),
        Err(Error::NotAPatch { .. })
    ));
}

/// An edge of the net may be a singular point, where the surface has no circle.
#[test]
fn torus_patches_with_an_edge_at_a_singular_point_come_back() {
    let mut random = Random(43);
    for index in 0..200 {
        let place = frame(&mut random, 1.0);
        let mu = random.between(1.0, 3.0);
        let surface: Dupin = if index % 4 == 0 {
            cyclide::Quartic::double_sphere(mu, 0.0, place)
                .unwrap()
                .into()
        } else {
            Dupin::torus(mu * random.between(0.1, 0.95), mu, place).unwrap()
        };
        let quartic = surface.as_quartic().unwrap();
        let psi = (quartic.a() / quartic.mu()).acos();
        let second = match index % 3 {
            0 => [psi, psi + random.between(0.3, 1.5)],
            1 => [psi + random.between(0.3, 1.5), psi],
            _ => [psi, psi - 0.5 * psi],
        };
        let net = *surface.patch(span(&mut random), second).unwrap().net();
        for net in [net, net.transposed(), net.reversed_u()] {
            let found = convert_torus(&net, None)
                .unwrap_or_else(|error| panic!("{index}: {error} {surface:?} {second:?}"));
            assert!(found.residual < 1e-9);
            let found = convert(&net).unwrap_or_else(|error| panic!("{index}: {error}"));
            assert!(found.residual < 1e-8);
        }
    }
}

#[test]
fn a_control_at_infinity_is_named() {
    let half = std::f64::consts::FRAC_PI_2;
    let torus = Dupin::torus(3.0, 1.0, Frame::WORLD).unwrap();
    let mut control = *torus
        .patch([0.0, 1.0], [-half, half])
        .unwrap()
        .net()
        .control();
    control[0][1].weight = 0.0;
    let net = Biquadratic::new(control).unwrap();
    assert_eq!(
        inspect(&net),
        Err(Error::ControlAtInfinity { row: 0, column: 1 })
    );
}

/// Between a torus and a double sphere lie surfaces whose axes are hidden in the last digits of their tangent spheres.
#[test]
fn nearly_spherical_patches_come_back() {
    let mut random = Random(47);
    let (mut worst, mut failures) = (0.0_f64, 0);
    for exponent in [-12, -10, -9, -8, -7, -6, -5, -4, -3] {
        let mut worst_here = 0.0_f64;
        for index in 0..200 {
            let place = frame(&mut random, 1.0);
            let share = 10_f64.powi(exponent);
            let (surface, first, second) = if index == 0 {
                let torus = Dupin::torus(share, 1.3, Frame::WORLD).unwrap();
                (torus, [0.0, 1.0], [0.2, 1.2])
            } else {
                let mu = random.between(0.5, 2.0);
                let a = mu * share * random.between(0.3, 3.0);
                let c = if index % 2 == 0 {
                    0.0
                } else {
                    a * random.between(0.05, 0.9)
                };
                let (theta, psi) = (random.between(0.0, 6.0), random.between(-1.0, 0.2));
                (
                    Dupin::quartic(a, c, mu, place).unwrap(),
                    [theta, theta + random.between(0.4, 2.5)],
                    [psi, psi + random.between(0.4, 1.1)],
                )
            };
            let net = *surface.patch(first, second).unwrap().net();
            match convert(&net) {
                Ok(found) => {
                    worst_here = worst_here.max(found.residual);
                    let quartic = found.surface.as_quartic().unwrap();
                    let given = surface.as_quartic().unwrap();
                    assert!((quartic.mu() - given.mu()).abs() < 1e-8 * given.mu());
                }
                Err(error) => {
                    failures += 1;
                    println!("{exponent} {index}: {error}");
                }
            }
        }
        println!("a / mu near 1e{exponent}: worst residual {worst_here:.1e}");
        worst = worst.max(worst_here);
    }
    assert_eq!(failures, 0);
    assert!(worst < 2e-9);
}
