//! Nothing that a caller can pass makes the crate panic, hang, or return a finite answer to a non-finite question.

use bezier_mass::glam::{DVec2, DVec3, dvec2, dvec3};
use bezier_mass::{
    BSplineCurve, BSplineSurface, BezierCurve, BezierPatch, Biquadratic, Homography, Knots,
    MassPoint, Parameter, Quadratic, bernstein,
};

const WILD: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-320,
    1e-200,
    1e200,
    -1e308,
    f64::EPSILON,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// All triples of wild numbers.
fn triples() -> impl Iterator<Item = [f64; 3]> {
    WILD.into_iter().flat_map(|a| {
        WILD.into_iter()
            .flat_map(move |b| WILD.into_iter().map(move |c| [a, b, c]))
    })
}

#[test]
fn quadratics_of_wild_numbers() {
    for [a, b, c] in triples() {
        let control = [
            MassPoint::from_homogeneous(a, dvec2(b, c)),
            MassPoint::from_homogeneous(b, dvec2(c, a)),
            MassPoint::from_homogeneous(c, dvec2(a, b)),
        ];
        let finite = [a, b, c].iter().all(|x| x.is_finite());
        let curve = Quadratic::new(control);
        assert_eq!(curve.is_ok(), finite);
        let Ok(curve) = curve else { continue };
        let _ = (
            curve.conic(),
            curve.centre(),
            curve.tangent_direction(0.5),
            curve.with_unit_end_weights(),
        );
        let _ = (
            curve.half_conic(bezier_mass::Half::Along),
            curve.jet(0.3).acceleration(),
        );
        for t in WILD {
            let _ = (
                curve.at(t),
                curve.tangent_direction(t),
                curve.subdivide(t),
                curve.sub_arc(t, a),
            );
            assert!(t.is_finite() || curve.point(t).is_err());
            if let Ok(point) = curve.point(t) {
                assert!(point.is_finite());
            }
        }
    }
}

#[test]
fn constructions_of_wild_numbers() {
    for [a, b, c] in triples() {
        let _ = Homography::new(a, b, c, 1.0).map(|h| {
            (
                h.inverse(),
                h.compose(h),
                h.apply(b),
                h.apply(Parameter::INFINITY),
            )
        });
        let _ = Parameter::new(a, b);
        for arc in [
            Quadratic::circular_arc(DVec2::ZERO, [dvec2(a, b), dvec2(b, c)], [1.0, 1.0]),
            Quadratic::circular_arc(dvec2(a, b), [DVec2::X, DVec2::Y], [1.0, c]),
            Quadratic::circular_arc_by_angles(dvec2(a, 1.0), b, 0.5, c),
            Quadratic::hyperbola_as_semicircle(
                [dvec2(a, b), dvec2(b, a), DVec2::X],
                c,
                bezier_mass::Half::Along,
            ),
        ]
        .into_iter()
        .flatten()
        {
            assert!(
                arc.control()
                    .iter()
                    .all(|h| h.weight.is_finite() && h.weighted.is_finite())
            );
        }
        let ends = [dvec3(a, b, c), dvec3(-a, -b, -c)];
        let _ = Quadratic::circular_arc_about_axis(DVec3::ZERO, dvec3(c, b, a), ends, [1.0, 1.0]);
    }
}

#[test]
fn bernstein_functions_of_wild_numbers() {
    for [a, b, c] in triples() {
        let coefficients = [a, b, c];
        let _ = (
            bernstein::evaluate(&coefficients, a),
            bernstein::jet(&coefficients, b),
        );
        let _ = (
            bernstein::subdivide(&coefficients, c),
            bernstein::restrict(&coefficients, a, b),
        );
        let _ = (
            bernstein::product(&coefficients, &coefficients),
            bernstein::elevate_to(&coefficients, 5),
        );
        let _ = (
            bernstein::integral(&coefficients, a),
            bernstein::basis(3, a),
            bernstein::blossom(&coefficients, &[[a, b]]),
        );
    }
}

#[test]
fn patches_of_wild_numbers() {
    for [a, b, c] in triples() {
        let h = |i: u8, j: u8| {
            MassPoint::from_homogeneous(
                [a, b, c][usize::from((i + j) % 3)],
                dvec3(f64::from(i), f64::from(j), a),
            )
        };
        let net = [0, 1, 2].map(|i| [0, 1, 2].map(|j| h(i, j)));
        let Ok(patch) = Biquadratic::new(net) else {
            continue;
        };
        let general = BezierPatch::from(patch);
        for t in WILD {
            let _ = (
                patch.at(t, 0.5),
                patch.jet(0.5, t).partials(),
                patch.normal(t, t),
                general.normal(t, 0.5),
            );
            let _ = (
                patch.grid(&[t, 0.5], &[0.5, t]),
                general.grid(&[t], &[0.5]),
                patch.subdivide_u(t),
            );
            assert!(
                t.is_finite() || patch.point(0.5, t).is_err() && general.point(t, 0.5).is_err()
            );
        }
    }
}

#[test]
fn splines_of_wild_knots_and_parameters() {
    for [a, b, c] in triples() {
        for degree in [0, 1, 2, 3, usize::MAX] {
            for knots in [
                Knots::new(degree, vec![0.0, 0.0, a, b, c, 1.0, 1.0]),
                Knots::clamped(degree, &[a, b, c]),
                Knots::periodic(degree, &[a, b, c, 9.0]),
            ] {
                let Ok(knots) = knots else { continue };
                let points: Vec<f64> = (0..knots.control_count()).map(|i| i as f64).collect();
                let spline = BSplineCurve::polynomial(knots.clone(), &points)
                    .expect("as many points as asked for");
                let _ = (spline.pieces(), spline.sample(7), spline.with_knot(a));
                for t in WILD {
                    let _ = (
                        spline.at(t),
                        spline.jet(t),
                        spline.tangent_direction(t),
                        spline.with_knot(t),
                    );
                    assert!(t.is_finite() || spline.point(t).is_err());
                }
            }
        }
    }
    assert!(Knots::clamped_uniform(usize::MAX, 3).is_err());
    assert!(Knots::periodic_uniform(usize::MAX, 3).is_err());
}

#[test]
fn nothing_in_lists() {
    let none: &[MassPoint<DVec3>] = &[];
    assert!(BezierCurve::new(none.to_vec()).is_err());
    assert!(BezierPatch::new([0, 0], none.to_vec()).is_err());
    assert!(BezierPatch::new([usize::MAX, usize::MAX], none.to_vec()).is_err());
    let knots = Knots::clamped_uniform(2, 5).expect("uniform knots");
    assert!(BSplineCurve::new(knots.clone(), none.to_vec()).is_err());
    assert!(BSplineSurface::new([knots.clone(), knots], none.to_vec()).is_err());
}
