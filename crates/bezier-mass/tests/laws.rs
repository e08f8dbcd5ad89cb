//! The laws that hold for every curve, patch and spline, on random control mass points: of any weights, vectors included.

use bezier_mass::glam::{DAffine2, DVec2, dvec2};
use bezier_mass::{
    BSplineCurve, BezierCurve, BezierPatch, Biquadratic, Conic, Half, Homography, Knots, MassPoint,
    Parameter, Quadratic, VectorSpace,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// The same cases in every run.
fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 256,
        rng_seed: RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// Mass points of coordinates up to ten, one in five a vector, one in five of negative weight.
fn mass_point() -> impl Strategy<Value = MassPoint<DVec2>> {
    let weight = prop_oneof![1 => Just(0.0), 1 => -3.0..-0.1, 3 => 0.1..3.0];
    (weight, -10.0..10.0, -10.0..10.0).prop_map(|(weight, x, y)| {
        if weight == 0.0 {
            MassPoint::vector(dvec2(x, y))
        } else {
            MassPoint::point(dvec2(x, y), weight)
        }
    })
}

fn quadratic() -> impl Strategy<Value = Quadratic<DVec2>> {
    [mass_point(), mass_point(), mass_point()]
        .prop_map(|control| Quadratic::new(control).expect("finite"))
}

/// Curves of degree 0 to 8.
fn curve() -> impl Strategy<Value = BezierCurve<DVec2>> {
    prop::collection::vec(mass_point(), 1..10)
        .prop_map(|control| BezierCurve::new(control).expect("finite"))
}

/// Homographies whose determinant is not small against their coefficients.
fn homography() -> impl Strategy<Value = Homography> {
    [-2.0..2.0_f64, -2.0..2.0, -2.0..2.0, -2.0..2.0]
        .prop_filter("well away from singular", |[a, b, c, d]| {
            (a * d - b * c).abs() > 0.3
        })
        .prop_map(|[a, b, c, d]| Homography::new(a, b, c, d).expect("regular"))
}

/// Equal up to rounding, where `scale` bounds the terms that were added up.
fn close(a: MassPoint<DVec2>, b: MassPoint<DVec2>, scale: f64) -> bool {
    (a - b).magnitude() <= 1e-13 * scale
}

proptest! {
    #![proptest_config(config())]

    /// Moving the control mass points by an affine map moves the curve.
    #[test]
    fn affine_invariance(curve in curve(), angle in 0.0..6.3, shift in (-9.0..9.0, -9.0..9.0), t in -0.5..1.5) {
        let map = DAffine2::from_scale_angle_translation(dvec2(1.5, 0.5), angle, dvec2(shift.0, shift.1));
        let apply = |h: MassPoint<DVec2>| h.map_linear(|x| map.transform_vector2(x)).translated(map.translation);
        let moved = curve.map(apply).expect("finite");
        prop_assert!(close(moved.at(t), apply(curve.at(t)), 1e3 * 2.0_f64.powi(curve.degree() as i32)));
    }

    /// Both parts of a subdivision are the curve, and their common end is one value.
    #[test]
    fn subdivision(curve in curve(), split in -0.5..1.5, s in 0.0..1.0) {
        let (left, right) = curve.subdivide(split);
        let scale = 1e2 * 4.0_f64.powi(curve.degree() as i32);
        prop_assert!(close(left.at(s), curve.at(s * split), scale));
        prop_assert!(close(right.at(s), curve.at(split + s * (1.0 - split)), scale));
        prop_assert_eq!(left.at(1.0), right.at(0.0));
    }

    /// A higher degree writes the same curve.
    #[test]
    fn elevation(curve in curve(), more in 0_usize..6, t in 0.0..1.0) {
        let raised = curve.elevated_to(curve.degree() + more);
        prop_assert_eq!(raised.degree(), curve.degree() + more);
        prop_assert!(close(raised.at(t), curve.at(t), 1e2));
    }

    /// The blossom is symmetric, affine in each argument, and its diagonal is the curve.
    #[test]
    fn blossom(curve in curve(), mut at in prop::collection::vec(-1.0..2.0, 9), other in -1.0..2.0, share in 0.0..1.0) {
        let scale = 1e2 * 8.0_f64.powi(curve.degree() as i32);
        at.truncate(curve.degree());
        prop_assert!(close(curve.blossom(&vec![other; curve.degree()]), curve.at(other), scale));
        let value = curve.blossom(&at);
        at.reverse();
        prop_assert!(close(curve.blossom(&at), value, scale));
        if let Some(first) = at.first().copied() {
            let mut moved = |x: f64| { at[0] = x; curve.blossom(&at) };
            let mixed = moved(first + share * (other - first));
            prop_assert!(close(mixed, moved(first).lerp(moved(other), share), scale));
        }
    }

    /// Reparametrising gives the value at the changed parameter, factor included.
    #[test]
    fn homography_is_a_change_of_parameter(curve in curve(), h in homography(), u in 0.0..1.0) {
        let scale = 1e2 * 16.0_f64.powi(curve.degree() as i32);
        prop_assert!(close(curve.reparametrised(h).at(u), curve.at_parameter(h.apply(u)), scale));
    }

    /// Two changes of parameter in turn are their composition; a change and its inverse cancel.
    #[test]
    fn homographies_compose(curve in quadratic(), g in homography(), h in homography()) {
        let both = curve.reparametrised(g.compose(h).expect("regular"));
        for (x, y) in both.control().iter().zip(curve.reparametrised(g).reparametrised(h).control()) {
            prop_assert!(close(*x, *y, 1e6), "{x:?} against {y:?}");
        }
        let back = curve.reparametrised(g).reparametrised(g.inverse().expect("regular"));
        for (x, y) in back.control().iter().zip(curve.control()) {
            prop_assert!(close(*x, *y, 1e6), "{x:?} against {y:?}");
        }
    }

    /// A change of parameter keeps the conic: the same equation, and points of the new arc are on the old conic.
    #[test]
    fn reparametrisation_keeps_the_conic(curve in quadratic(), h in homography(), t in 0.0..1.0) {
        let conic = curve.conic();
        let changed = curve.reparametrised(h);
        let Some(position) = changed.at(t).position() else { return Ok(()) };
        // The conic's own size and flatness set how many digits its equation keeps.
        let (size, flat) = match conic {
            Conic::Circle(c) => (c.radius, 1.0),
            Conic::Ellipse(c) | Conic::Hyperbola(c) => (c.semi_axes()[0].min(c.semi_axes()[1]), c.semi_axes()[0] / c.semi_axes()[1]),
            Conic::Parabola(p) => (p.focal_parameter(), 1.0),
            Conic::Degenerate(_) => return Ok(()),
        };
        let scale = (1.0 + (10.0 + position.length()) / size).powi(2) * (flat + 1.0 / flat).powi(2);
        let residual = conic.implicit(position).expect("a proper conic");
        prop_assert!(residual.abs() <= 1e-11 * scale, "{conic:?} at {position}: {residual}, scale {scale}");
    }

    /// The complement joins the ends the other way round, and twice is back.
    #[test]
    fn complement(curve in curve()) {
        let rest = curve.complement();
        prop_assert_eq!(rest.complement(), curve.clone());
        prop_assert!(close(rest.at(0.0), curve.at(0.0), 1e2));
        // The complementary arc is the same curve at the parameters t / (2t - 1).
        let mirrored = curve.sub_arc(0.0, Parameter::from(1.0).opposite()).expect("different ends");
        for (x, y) in rest.control().iter().zip(mirrored.control()) {
            prop_assert!(close(*x, *y, 1e2));
        }
    }

    /// A curve run backwards.
    #[test]
    fn reversal(curve in curve(), t in 0.0..1.0) {
        prop_assert!(close(curve.reversed().at(t), curve.at(1.0 - t), 1e2));
        let by_homography = curve.reparametrised(Homography::REVERSAL);
        prop_assert!(close(by_homography.at(t), curve.at(1.0 - t), 1e2));
    }

    /// Velocity and direction agree wherever there is a position.
    #[test]
    fn direction_is_along_the_velocity(curve in quadratic(), t in 0.0..1.0) {
        let (Some(velocity), Some(direction)) = (curve.jet(t).velocity(), curve.tangent_direction(t)) else {
            return Ok(());
        };
        let sine = velocity.perp_dot(direction) / (velocity.length() * direction.length());
        prop_assert!(sine.abs() < 1e-9 && velocity.dot(direction) > 0.0, "{velocity} against {direction}");
    }

    /// Circular arcs through random ends, both halves of a chord and any positive end weights.
    #[test]
    fn theorem_1(angles in (0.0..6.3_f64, 0.01..6.27_f64), radius in 0.01..100.0_f64, weights in (0.01..10.0, 0.01..10.0), t in 0.0..1.0) {
        let centre = dvec2(3.0, -1.0);
        let ends = [angles.0, angles.0 + angles.1].map(|angle| centre + radius * DVec2::from_angle(angle));
        let arc = Quadratic::circular_arc(centre, ends, [weights.0, weights.1]).expect("a proper arc");
        prop_assert!(arc.control()[1].weight >= 0.0);
        for curve in [arc, arc.complement()] {
            let distance = curve.point(t).expect("bounded").distance(centre);
            prop_assert!((distance / radius - 1.0).abs() < 1e-9, "{distance} against {radius}");
        }
    }

    /// Half a conic ends opposite to its start, and is an arc of the same conic with a vector in the middle.
    #[test]
    fn theorem_2(curve in quadratic(), along in any::<bool>()) {
        let half = if along { Half::Along } else { Half::Against };
        let Ok(result) = curve.half_conic(half) else { return Ok(()) };
        let [start, middle, end] = *result.control();
        prop_assert!(middle.is_vector());
        let (Some(centre), Some(start), Some(end)) = (curve.centre().position(), start.position(), end.position()) else {
            return Ok(());
        };
        prop_assert!((start + end - 2.0 * centre).length() <= 1e-9 * (1.0 + centre.length() + start.length()));
    }

    /// A patch's iso-curves, partial derivatives and parts are those of its rows and columns.
    #[test]
    fn patches(net in prop::array::uniform9(mass_point()), u in 0.0..1.0, v in 0.0..1.0, split in 0.1..0.9) {
        let [a, b, c, d, e, f, g, h, i] = net;
        let patch = Biquadratic::new([[a, b, c], [d, e, f], [g, h, i]]).expect("finite");
        let general = BezierPatch::from(patch);
        prop_assert!(close(patch.at(u, v), general.at(u, v), 1e2));
        prop_assert!(close(patch.curve_at_u(u).at(v), patch.at(u, v), 1e2));
        prop_assert!(close(patch.curve_at_v(v).at(u), patch.at(u, v), 1e2));
        let jet = patch.jet(u, v);
        prop_assert!(close(jet.du, patch.curve_at_v(v).jet(u).first, 1e3));
        prop_assert!(close(jet.dvv, patch.curve_at_u(u).jet(v).second, 1e3));
        let (below, above) = patch.subdivide_u(split);
        prop_assert!(close(below.at(u, v), patch.at(u * split, v), 1e2));
        prop_assert!(close(above.at(u, v), patch.at(split + u * (1.0 - split), v), 1e2));
        prop_assert!(close(general.elevated_to([3, 5]).at(u, v), patch.at(u, v), 1e2));
    }

    /// Knot insertion and Bézier pieces keep a spline, clamped or periodic, of any degree.
    #[test]
    fn splines(control in prop::collection::vec(mass_point(), 6..12), degree in 1_usize..5, closed in any::<bool>(),
               knot in 0.01..0.99, t in 0.0..1.0) {
        let knots = if closed { Knots::periodic_uniform(degree, control.len()) } else { Knots::clamped_uniform(degree, control.len()) };
        let spline = BSplineCurve::new(knots.expect("enough control points"), control).expect("finite");
        let refined = spline.with_knot(knot).and_then(|spline| spline.with_knot(0.5 * knot)).expect("new knots");
        prop_assert!(close(refined.at(t), spline.at(t), 1e3));
        let pieces = spline.pieces();
        let piece = pieces.iter().find(|piece| t <= piece.interval[1]).expect("the pieces cover the domain");
        let [start, end] = piece.interval;
        prop_assert!(close(piece.curve.at((t - start) / (end - start)), spline.at(t), 1e3));
    }
}
