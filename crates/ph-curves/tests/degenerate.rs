//! Degenerate curves get an answer or a named error, the same at every size; hostile numbers get an error.

use ph_curves::glam::{DVec2, dvec2};
use ph_curves::{
    Approximated, Approximation, CubicPath, CurvatureElement, DualCurve, Error, G1Ends, G2Pair,
    Joint, Line, LineElement, PhArc, Piece, TCubic, approximate,
};

const INPUTS: [(&str, [(f64, f64); 4]); 9] = [
    (
        "cusp in the offset",
        [(0.0, 0.0), (50.0, 2.0), (50.0, 2.0), (100.0, 0.0)],
    ),
    (
        "zero derivative at the start",
        [(0.0, 0.0), (0.0, 0.0), (60.0, 80.0), (100.0, 0.0)],
    ),
    (
        "zero derivatives at the start",
        [(0.0, 0.0), (0.0, 0.0), (0.0, 0.0), (100.0, 30.0)],
    ),
    (
        "zero derivatives at both ends",
        [(0.0, 0.0), (0.0, 0.0), (100.0, 30.0), (100.0, 30.0)],
    ),
    (
        "near-cusp",
        [(0.0, 0.0), (100.0, 100.0001), (0.0, 100.0), (100.0, 0.0)],
    ),
    (
        "interior cusp",
        [(0.0, 0.0), (100.0, 100.0), (0.0, 100.0), (100.0, 0.0)],
    ),
    (
        "collinear",
        [(0.0, 0.0), (20.0, 10.0), (70.0, 35.0), (100.0, 50.0)],
    ),
    (
        "collinear with turn-back",
        [(0.0, 0.0), (150.0, 0.0), (-50.0, 0.0), (100.0, 0.0)],
    ),
    (
        "closed onto itself",
        [(0.0, 0.0), (100.0, 80.0), (100.0, 80.0), (0.0, 0.0)],
    ),
];

fn both(tolerance: f64) -> [Approximation; 2] {
    [
        Approximation::quartics(tolerance),
        Approximation::within(tolerance),
    ]
}

/// Counts and lengths of an answer, free of its size; radii at joints are left out.
fn summary(result: &Approximated, scale: f64) -> (usize, usize, f64) {
    (
        result.spline.pieces().len(),
        result.corners,
        result.spline.length() / scale,
    )
}

#[test]
fn every_degenerate_cubic_is_answered_alike_at_every_size() {
    for (name, control) in INPUTS {
        for tolerance in [1e-2, 1e-4, 1e-7] {
            for (k, _) in both(1.0).iter().enumerate() {
                let answer = |scale: f64| {
                    let points = control.map(|p| DVec2::from(p) * scale);
                    let curve = CubicPath::new(vec![points], false).unwrap();
                    approximate(&curve, &both(tolerance * scale)[k]).map(|result| {
                        for piece in result.spline.offset(5.0 * scale).unwrap().pieces() {
                            for t in [0.0, 0.5, 1.0] {
                                assert!(piece.point(t).is_finite(), "{name} at {scale}");
                            }
                        }
                        summary(&result, scale)
                    })
                };
                let unit = answer(1.0).unwrap_or_else(|error| panic!("{name}: {error}"));
                // Powers of two change no digit; 1e-7 and 1e9 change the last ones, which make a cusp a near-cusp.
                for scale in [2.0_f64.powi(-24), 2.0_f64.powi(30)] {
                    assert_eq!(answer(scale).unwrap(), unit, "{name} at {scale}");
                }
                for scale in [1e-7, 1e9] {
                    let (_, _, length) = answer(scale).unwrap();
                    assert!(
                        (length - unit.2).abs() <= tolerance,
                        "{name} at {scale}: {length} for {}",
                        unit.2
                    );
                }
            }
        }
    }
}

#[test]
fn one_point_has_no_offset() {
    let point = dvec2(3.0, -1.0);
    assert_eq!(
        CubicPath::new(vec![[point; 4]], false),
        Err(Error::SinglePoint)
    );
    assert!(matches!(
        CubicPath::through(&[point; 5], false),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        CubicPath::polyline(&[], false),
        Err(Error::TooFew { .. })
    ));
}

#[test]
fn far_from_the_origin_the_answer_is_the_same() {
    let control = [(0.0, 0.0), (20.0, 70.0), (80.0, 70.0), (100.0, 0.0)].map(DVec2::from);
    let near = CubicPath::new(vec![control], false).unwrap();
    let far = CubicPath::new(vec![control.map(|p| p + dvec2(1e9, -1e9))], false).unwrap();
    for how in both(1e-3) {
        let (near, far) = (
            approximate(&near, &how).unwrap(),
            approximate(&far, &how).unwrap(),
        );
        assert_eq!(near.spline.pieces().len(), far.spline.pieces().len());
        assert!((near.spline.length() - far.spline.length()).abs() < 1e-5);
    }
    let refused = approximate(&far, &Approximation::quartics(1e-7));
    assert!(matches!(refused, Err(Error::ToleranceTooSmall { .. })));
}

#[test]
fn an_offset_onto_the_centre_of_an_arc_is_a_point() {
    let radius = 10.0;
    let ends = G1Ends::new(
        LineElement::new(dvec2(radius, 0.0), DVec2::X).unwrap(),
        LineElement::new(dvec2(0.0, radius), DVec2::Y).unwrap(),
    )
    .unwrap();
    let point = ends.arc(1.0).unwrap().offset(-radius);
    assert!(point.point(0.3).length() < 1e-13 && point.length() < 1e-12);
}

#[test]
fn straight_runs_and_circles_stay_what_they_are() {
    let corners = [dvec2(0.0, 0.0), dvec2(4.0, 0.0), dvec2(4.0, 3.0)];
    let result = approximate(
        &CubicPath::polyline(&corners, true).unwrap(),
        &Approximation::quartics(1e-6),
    )
    .unwrap();
    let segments = result
        .spline
        .pieces()
        .iter()
        .filter(|piece| matches!(piece, Piece::Segment(_)))
        .count();
    assert_eq!((segments, result.corners, result.error), (3, 3, 0.0));
    // A quarter circle as a rational quadratic is one exact arc.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let control = [
        (dvec2(1.0, 0.0), 1.0),
        (dvec2(1.0, 1.0), half),
        (dvec2(0.0, 1.0), 1.0),
    ];
    let circle = bezier_mass::BezierCurve::new(
        control
            .map(|(p, w)| bezier_mass::MassPoint::point(p, w))
            .to_vec(),
    )
    .unwrap();
    let result = approximate(&circle, &Approximation::quartics(1e-9)).unwrap();
    assert_eq!(result.spline.pieces().len(), 1);
    assert!(
        result.error < 1e-14
            && (result.spline.length() - std::f64::consts::FRAC_PI_2).abs() < 1e-14
    );
}

#[test]
fn hostile_numbers_are_refused() {
    let curve = CubicPath::polyline(&[DVec2::ZERO, DVec2::X], false).unwrap();
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(CubicPath::polyline(&[DVec2::ZERO, dvec2(bad, 0.0)], false).is_err());
        assert!(CubicPath::through(&[DVec2::ZERO, dvec2(0.0, bad), DVec2::X], false).is_err());
        assert!(matches!(
            approximate(&curve, &Approximation::quartics(bad)),
            Err(Error::BadTolerance { .. })
        ));
        let spline = approximate(&curve, &Approximation::quartics(1e-3))
            .unwrap()
            .spline;
        assert!(spline.offset(bad).is_err() && spline.trimmed_offset(bad).is_err());
        assert!(
            Line::new(bad, 1.0, 0.0).is_err() && Line::through(dvec2(bad, 0.0), DVec2::X).is_err()
        );
        assert!(PhArc::<4>::new(dvec2(bad, 1.0), DVec2::X, [0.0; 4]).is_err());
        assert!(LineElement::new(dvec2(0.0, bad), DVec2::X).is_err());
        assert!(CurvatureElement::new(DVec2::ZERO, DVec2::X, bad).is_err());
        assert!(TCubic::new([DVec2::ZERO, DVec2::X, dvec2(bad, 1.0), DVec2::Y]).is_err());
        assert!(TCubic::in_triangle(DVec2::ZERO, DVec2::X, dvec2(bad, 1.0)).is_err());
        assert!(DualCurve::from_vectors(&[ph_curves::glam::DVec3::splat(bad); 4]).is_err());
    }
    assert!(
        approximate(
            &curve,
            &Approximation {
                beta: 1.0,
                ..Approximation::quartics(1.0)
            }
        )
        .is_err()
    );
    assert!(approximate(&curve, &Approximation::quartics(0.0)).is_err());
    let element =
        |x: f64, r: f64| CurvatureElement::new(dvec2(x, 0.0), DVec2::from_angle(x), r).unwrap();
    assert!(G2Pair::new(&element(0.0, 1.0), &element(1.0, -1.0), 0.5).is_err());
}

/// Rigid motions and scaling act on the result as on the curve.
#[test]
fn the_approximation_moves_with_the_curve() {
    let control = [
        (0.0, 0.0),
        (1.0, 1.6),
        (2.4, 1.2),
        (3.0, -0.8),
        (4.4, -1.0),
        (5.5, 0.6),
    ]
    .map(DVec2::from);
    let turn = DVec2::from_angle(0.77);
    let (shift, scale) = (dvec2(3.0, -8.0), 4.0);
    let curve = CubicPath::uniform_bspline(&control, false).unwrap();
    let moved = CubicPath::uniform_bspline(&control.map(|p| turn.rotate(p) * scale + shift), false)
        .unwrap();
    for (how, scaled) in both(1e-4).into_iter().zip(both(1e-4 * scale)) {
        let (here, there) = (
            approximate(&curve, &how).unwrap(),
            approximate(&moved, &scaled).unwrap(),
        );
        assert_eq!(here.spline.joints(), there.spline.joints());
        assert_eq!(
            here.g1_joints,
            here.spline
                .joints()
                .iter()
                .filter(|j| **j == Joint::G1)
                .count()
        );
        for (a, b) in here
            .spline
            .offset(0.3)
            .unwrap()
            .pieces()
            .iter()
            .zip(there.spline.offset(1.2).unwrap().pieces())
        {
            for t in [0.0, 0.4, 1.0] {
                assert!((turn.rotate(a.point(t)) * scale + shift - b.point(t)).length() < 1e-7);
            }
        }
    }
}
