//! Laws of the constructions: rotation, scale, C2, planar boundaries, hostile numbers.

use bezier_mass::BezierCurve;
use core::array::from_fn;
use glam::{DQuat, DVec3};
use reconstruct::{
    AnalyticCurve, BezierStrip, CornerData, Corners, Criterion, Degree7Shape, EndInvariants, Error,
    FrenetFrame, GeodesicStrip, Rectangle, Series, Surface, ThirdDerivative, Violation,
    boundary_geodesic_curvature, check_rectangle, degree7_boundaries, quintic_end_invariants,
    quintic_weights, rational_quintic_boundaries,
};

/// Corners on the graph `z = x² / 5 - y² / 8 + x y / 10`.
fn corners() -> Corners {
    let at = |x: f64, y: f64, tilt: f64| {
        let (fx, fy) = (0.4 * x + 0.1 * y, -0.25 * y + 0.1 * x);
        let tangent = |a: f64, b: f64| DVec3::new(a, b, fx * a + fy * b);
        let normal = DVec3::new(-fx, -fy, 1.0);
        let curvature = |a: f64, b: f64| {
            (0.4 * a * a + 0.2 * a * b - 0.25 * b * b)
                / (normal.length() * tangent(a, b).length_squared())
        };
        CornerData::new(
            DVec3::new(x, y, 0.2 * x * x - 0.125 * y * y + 0.1 * x * y),
            normal,
            [tangent(1.0, tilt), tangent(-tilt, 1.0)],
            [curvature(1.0, tilt), curvature(-tilt, 1.0)],
        )
        .unwrap()
    };
    [
        [at(-1.0, -1.1, 0.1), at(-1.2, 0.9, 0.05)],
        [at(1.1, -0.9, -0.05), at(0.9, 1.2, 0.1)],
    ]
}

fn strips(curves: [BezierCurve<DVec3>; 4]) -> [BezierStrip; 4] {
    curves.map(|curve| BezierStrip::new(curve).unwrap())
}

#[test]
fn degree_7_and_rational_quintics_meet_their_corner_data_and_bound_geodesic_patches() {
    let corners = corners();
    let shapes = [
        ThirdDerivative::LeastJerk,
        ThirdDerivative::LeastBending,
        ThirdDerivative::Given([0.0; 2]),
    ];
    let mut sets: Vec<[BezierCurve<DVec3>; 4]> = shapes
        .into_iter()
        .map(|third_derivative| {
            degree7_boundaries(
                &corners,
                &Degree7Shape {
                    third_derivative,
                    ..Degree7Shape::default()
                },
            )
            .unwrap()
        })
        .collect();
    sets.push(rational_quintic_boundaries(&corners).unwrap());
    for curves in sets {
        for (i, row) in corners.iter().enumerate() {
            for (j, corner) in row.iter().enumerate() {
                for (axis, (side, t)) in [(2 * j, i as f64), (1 + 2 * i, j as f64)]
                    .into_iter()
                    .enumerate()
                {
                    let frame = FrenetFrame::at(&curves[side], t).unwrap();
                    assert!(frame.point.distance(corner.point()) < 1e-13);
                    assert!(frame.tangent.distance(corner.tangents()[axis]) < 1e-12);
                    let bend = corner.normal() * corner.curvatures()[axis];
                    assert!((frame.normal * frame.curvature).distance(bend) < 1e-11);
                }
            }
        }
        let rational = curves[0].degree() == 5;
        let rectangle = Rectangle::new(strips(curves)).unwrap();
        assert!(rectangle.report().c3_residual < 1e-10);
        let patch = rectangle.patch(rectangle.regular_twists()).unwrap();
        let bezier = patch.to_bezier().unwrap();
        // 5 n - 3 for rational boundaries, 4 n - 3 where opposite ones share their weights, 2 n - 1 for polynomial ones.
        let allowed: &[usize] = if rational { &[17, 22] } else { &[13] };
        assert!(
            bezier
                .degrees()
                .iter()
                .all(|degree| allowed.contains(degree)),
            "{:?}",
            bezier.degrees()
        );
        assert!(boundary_geodesic_curvature(&patch, 40) < 1e-10);
        assert!(boundary_geodesic_curvature(&bezier, 40) < 1e-8);
        for (u, v) in [(0.0, 0.3), (0.4, 0.7), (1.0, 1.0), (0.9, 0.1)] {
            assert!(patch.point(u, v).distance(Surface::point(&bezier, u, v)) < 1e-12);
            assert!(patch.partials(u, v).duv.distance(bezier.partials(u, v).duv) < 1e-9);
        }
        if rational {
            assert!(bezier.control().iter().all(|h| h.weight > 0.0));
        }
    }
}

/// The boundary of the right half of Fig. 3.18: C1 and C3 hold at every corner, and the normal reverses once. The
/// geodesic curvature cannot see it; the count does.
#[test]
fn a_violation_of_c2_is_caught_by_its_own_test() {
    let mut corners = corners();
    let old = corners[1][1];
    let [k, l] = old.curvatures();
    corners[1][1] = CornerData::new(old.point(), old.normal(), old.tangents(), [-k, l]).unwrap();
    let strips = strips(degree7_boundaries(&corners, &Degree7Shape::default()).unwrap());
    let report = check_rectangle(&strips, 1e-8);
    assert!(
        matches!(report.violations[..], [Violation::C2 { .. }]),
        "{:?}",
        report.violations
    );
    assert!(report.c3_residual < 1e-10);
    assert!(matches!(Rectangle::new(strips), Err(Error::Conditions(_))));
}

/// Fig. 3.22: four plane boundaries of degree 4, each with two inflections; the patch has bidegree 6.
#[test]
fn plane_boundaries_pass_their_inflections() {
    // A symmetric bump: curved down at its ends and up in the middle.
    let bump = |a: DVec3, b: DVec3| {
        let heights = [0.0, 0.25, -0.35, 0.25, 0.0];
        let points: Vec<DVec3> = (0..5)
            .map(|i| a.lerp(b, f64::from(i) / 4.0) + DVec3::Z * heights[i as usize])
            .collect();
        BezierStrip::new(BezierCurve::polynomial(&points).unwrap()).unwrap()
    };
    let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let strips = [
        bump(corner(0.0, 0.0), corner(1.0, 0.0)),
        bump(corner(0.0, 0.0), corner(0.0, 1.0)),
        bump(corner(0.0, 1.0), corner(1.0, 1.0)),
        bump(corner(1.0, 0.0), corner(1.0, 1.0)),
    ];
    // At a corner the plane curves rise in their own planes, so their normals leave the tangent plane's: C1 fails
    // unless the corner is flat. Turn the end tangents level to make it so.
    assert!(matches!(Rectangle::new(strips), Err(Error::Conditions(_))));
    let level = |a: DVec3, b: DVec3| {
        let heights = [0.0, 0.0, 0.4, 0.0, 0.0];
        let points: Vec<DVec3> = (0..5)
            .map(|i| a.lerp(b, f64::from(i) / 4.0) + DVec3::Z * heights[i as usize])
            .collect();
        BezierStrip::new(BezierCurve::polynomial(&points).unwrap()).unwrap()
    };
    let rectangle = Rectangle::new([
        level(corner(0.0, 0.0), corner(1.0, 0.0)),
        level(corner(0.0, 0.0), corner(0.0, 1.0)),
        level(corner(0.0, 1.0), corner(1.0, 1.0)),
        level(corner(1.0, 0.0), corner(1.0, 1.0)),
    ])
    .unwrap();
    assert_eq!(rectangle.report().inflections.len(), 8);
    let patch = rectangle
        .smoothest(Criterion::ThinPlate)
        .unwrap()
        .patch
        .to_bezier()
        .unwrap();
    assert_eq!(patch.degrees(), [6, 6]);
    assert!(boundary_geodesic_curvature(&patch, 40) < 1e-10);
    assert!(Surface::point(&patch, 0.5, 0.0).z > 0.1);
}

fn helices(turn: DQuat, scale: f64) -> [GeodesicStrip; 4] {
    let corners = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.25, 1.15]];
    [(0, 1), (0, 2), (2, 3), (1, 3)].map(|(a, b): (usize, usize)| {
        GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
            let [angle, height] =
                [0, 1].map(|k| t * (corners[b][k] - corners[a][k]) + corners[a][k]);
            let (sin, cos) = angle.sin_cos();
            let axes = [turn * DVec3::X, turn * DVec3::Y, turn * DVec3::Z].map(|v| v * scale);
            from_fn(|k| cos * axes[0][k] + sin * axes[1][k] + height * axes[2][k])
        }))
        .unwrap()
    })
}

/// Turning and scaling the boundary turns and scales the patch, to 1e-12 of its size.
#[test]
fn patches_commute_with_similarities() {
    let plain = Rectangle::new(helices(DQuat::IDENTITY, 1.0))
        .unwrap()
        .smoothest(Criterion::ThinPlate)
        .unwrap()
        .patch;
    for (axis, angle, scale) in [
        (DVec3::X, 1.0, 1.0),
        (DVec3::new(0.6, 0.0, 0.8), 2.5, 1e-6),
        (DVec3::Y, -0.7, 1e6),
    ] {
        let turn = DQuat::from_axis_angle(axis, angle);
        let moved = Rectangle::new(helices(turn, scale))
            .unwrap()
            .smoothest(Criterion::ThinPlate)
            .unwrap()
            .patch;
        for (u, v) in [(0.2, 0.3), (0.5, 0.5), (0.9, 0.7)] {
            let expected = turn * plain.point(u, v) * scale;
            assert!(moved.point(u, v).distance(expected) < 1e-12 * scale);
        }
        assert!(boundary_geodesic_curvature(&moved, 20) < 1e-12);
    }
}

#[test]
fn hostile_numbers_are_refused() {
    let rectangle = Rectangle::new(helices(DQuat::IDENTITY, 1.0)).unwrap();
    assert!(matches!(
        rectangle.patch([[f64::NAN; 2]; 4]),
        Err(Error::NonFinite { .. })
    ));
    // A huge twist turns the transverse derivative over: the boundary would fold.
    assert!(matches!(
        rectangle.patch([[0.0, -1e3]; 4]),
        Err(Error::IrregularBoundary { .. })
    ));
    assert!(rectangle.patch([[1e300; 2]; 4]).is_err());
    for bad in [f64::NAN, f64::INFINITY, 0.0] {
        assert!(CornerData::new(DVec3::ZERO, DVec3::Z, [DVec3::X, DVec3::Y], [bad, 1.0]).is_err());
        let shape = Degree7Shape {
            speed: Some(bad),
            ..Degree7Shape::default()
        };
        assert!(degree7_boundaries(&corners(), &shape).is_err());
    }
    let same = corners()[0][0];
    assert!(matches!(
        degree7_boundaries(&[[same; 2]; 2], &Degree7Shape::default()),
        Err(Error::CornerData { .. })
    ));
    assert!(rational_quintic_boundaries(&[[same; 2]; 2]).is_err());
    let line: [DVec3; 6] = from_fn(|i| DVec3::X * i as f64);
    assert!(matches!(
        quintic_end_invariants(&line, &[1.0; 6]),
        Err(Error::Inflection { .. })
    ));
    assert!(quintic_end_invariants(&[DVec3::ZERO; 6], &[1.0; 6]).is_err());
    assert!(quintic_end_invariants(&line, &[-1.0; 6]).is_err());
    let wanted = EndInvariants {
        curvature: f64::NAN,
        torsion: 1.0,
    };
    let bent: [DVec3; 6] = from_fn(|i| DVec3::new(i as f64, (i * i) as f64, (i * i * i) as f64));
    assert!(quintic_weights(&bent, [wanted; 2]).is_err());
    let far = GeodesicStrip::new(AnalyticCurve::new(|t: Series| {
        [t.exp() * 1e200, t * 1e200, t * t * 1e200]
    }));
    if let Ok(strip) = far {
        // Squares overflow: whatever is said, it must be said, not panicked.
        let _ = check_rectangle(&from_fn::<GeodesicStrip, 4, _>(|_| strip.clone()), 1e-8);
        assert!(Rectangle::new(from_fn(|_| strip.clone())).is_err());
    }
}

#[test]
fn rational_quintics_keep_the_split_of_the_torsions_that_a_corner_asks_for() {
    let torsions = |corners: &Corners| {
        rational_quintic_boundaries(corners)
            .map(|curves| [0, 1].map(|k| FrenetFrame::at(&curves[k], 0.0).unwrap().torsion))
    };
    let mut asked = corners();
    let [a, b] = torsions(&asked).unwrap();
    for factor in [0.8, 1.25] {
        asked[0][0] = asked[0][0].with_torsion_difference((a - b) * factor);
        let wanted = asked[0][0].torsions();
        for (found, wanted) in torsions(&asked).unwrap().into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-10, "{found} {wanted}");
        }
    }
    // Boundaries in planes of symmetry have no torsion to give.
    let at = |x: f64, y: f64| {
        let tangents = [
            DVec3::new(1.0, 0.0, -0.5 * x),
            DVec3::new(0.0, 1.0, -0.5 * y),
        ];
        let point = DVec3::new(x, y, -0.25 * (x * x + y * y));
        let normal = DVec3::new(0.5 * x, 0.5 * y, 1.0);
        CornerData::new(point, normal, tangents, [-0.5, -0.45]).unwrap()
    };
    let mut flat = [0.0, 1.0].map(|x| [0.0, 1.0].map(|y| at(x, y)));
    assert!(torsions(&flat).is_ok());
    flat[0][0] = flat[0][0].with_torsion_difference(0.3);
    assert!(matches!(torsions(&flat), Err(Error::TorsionSign { .. })));
}
