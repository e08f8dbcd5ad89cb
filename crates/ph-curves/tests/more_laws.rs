//! Cams, Minkowski norms, frames in space and feeds do not depend on where the data lie, nor on the unit of length.

use std::f64::consts::TAU;

use ph_curves::glam::{DQuat, DVec2, DVec3, dvec2, dvec3};
use ph_curves::{
    Bumped, Cam, Ellipse, FeedInterpolator, FeedRate, Frame, HarmonicLift, Indicatrix,
    MinkowskiPlane, PhSpline, RationalFrameQuintic, SplineEnds, Support, SupportJet,
    rotation_minimising_frames,
};
use proptest::prelude::*;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(20_261_129),
        ..ProptestConfig::default()
    }
}

fn number() -> impl Strategy<Value = f64> {
    -1.0..1.0_f64
}

fn angle() -> impl Strategy<Value = f64> {
    0.0..TAU
}

fn scale() -> impl Strategy<Value = f64> {
    (-3.0..3.0_f64).prop_map(|power| 10.0_f64.powf(power))
}

fn plane() -> impl Strategy<Value = DVec2> {
    (number(), number()).prop_map(|(x, y)| dvec2(x, y))
}

fn space() -> impl Strategy<Value = DVec3> {
    (number(), number(), number()).prop_map(|(x, y, z)| dvec3(x, y, z))
}

fn rotation() -> impl Strategy<Value = DQuat> {
    (angle(), angle(), angle()).prop_map(|(a, b, c)| {
        DQuat::from_rotation_z(a) * DQuat::from_rotation_x(b) * DQuat::from_rotation_z(c)
    })
}

/// The support function of the same curve turned about the origin and scaled.
fn turned<'a>(curve: &'a impl Support, angle: f64, scale: f64) -> impl Support + 'a {
    move |psi: f64| {
        let jet = curve.jet(psi - angle);
        SupportJet {
            support: scale * jet.support,
            slope: scale * jet.slope,
            bend: scale * jet.bend,
        }
    }
}

/// Points on a circle moved by up to a fifth of its radius, which a closed PH spline passes without loops.
fn ring(moves: &[DVec2], map: impl Fn(DVec2) -> DVec2) -> Vec<DVec2> {
    let count = moves.len() as f64;
    moves
        .iter()
        .enumerate()
        .map(|(i, by)| map(DVec2::from_angle(TAU * i as f64 / count) + 0.2 * *by))
        .collect()
}

fn along(curve: &RationalFrameQuintic, steps: u32) -> Vec<(DVec3, DVec3)> {
    (0..=steps)
        .filter_map(|i| {
            curve
                .curve()
                .point_and_tangent(f64::from(i) / f64::from(steps))
                .ok()
        })
        .collect()
}

proptest! {
    #![proptest_config(config(40))]

    /// Turning the cam's zero angle shifts the lift, the unit of length scales it: the cam follows.
    #[test]
    fn cams(third in (-0.05..0.05_f64, -0.05..0.05_f64), fifth in (-0.01..0.01_f64, -0.01..0.01_f64), start in angle(), scale in scale()) {
        let zero = (0.0, 0.0);
        let lift = HarmonicLift { mean: 1.0, harmonics: vec![zero, zero, third, zero, fifth] };
        let here = Cam::try_new(&lift, 16)?;
        let there = Cam::try_new(&turned(&|psi: f64| {
            let [support, slope, bend] = ph_curves::Lift::jet(&lift, psi);
            SupportJet { support, slope, bend }
        }, start, scale).into_lift(), 16)?;
        prop_assert!((there.width - scale * here.width).abs() < 1e-12 * scale);
        for i in 0..20 {
            let psi = 0.37 * f64::from(i);
            // Nodes differ, so that both follow the lift to the error that they state.
            let lifts = (here.profile.contact(psi).support, there.profile.contact(psi).support);
            let wanted = ph_curves::Lift::jet(&lift, psi)[0];
            let shifted = ph_curves::Lift::jet(&lift, psi - start)[0];
            prop_assert!((lifts.0 - wanted).abs() < 1e-6);
            prop_assert!((lifts.1 - scale * shifted).abs() < 1e-6 * scale);
        }
        // From the same zero angle the profile is the same curve, scaled.
        let scaled = HarmonicLift {
            mean: scale,
            harmonics: lift.harmonics.iter().map(|(c, s)| (scale * c, scale * s)).collect(),
        };
        let scaled = Cam::try_new(&scaled, 16)?;
        prop_assert!((scaled.least_radius - scale * here.least_radius).abs() < 1e-12 * scale);
        for i in 0..20 {
            let psi = 0.37 * f64::from(i);
            let apart = scaled.profile.contact(psi).point - scale * here.profile.contact(psi).point;
            prop_assert!(apart.length() < 1e-12 * scale);
        }
    }

    /// Norms, frames and curvatures of a plane turned together with its indicatrix, in another unit of length.
    #[test]
    fn minkowski_planes(height in -0.05..0.05_f64, v in plane(), second in plane(), turn in angle(), scale in scale()) {
        prop_assume!(v.length() > 0.1);
        let indicatrix = Bumped { height };
        let by = DVec2::from_angle(turn);
        let here = MinkowskiPlane::new(Indicatrix::try_new(indicatrix)?);
        let there = MinkowskiPlane::new(Indicatrix::try_new(turned(&indicatrix, turn, scale))?);
        let moved = by.rotate(v);
        prop_assert!((there.norm(moved) * scale / here.norm(v) - 1.0).abs() < 1e-12);
        prop_assert!((there.dual_norm(moved) / (scale * here.dual_norm(v)) - 1.0).abs() < 1e-12);
        // A norm is homogeneous, symmetric, and the sum of two sides is longer.
        prop_assert!((here.norm(-scale * v) / (scale * here.norm(v)) - 1.0).abs() < 1e-12);
        prop_assert!(here.norm(v + second) <= here.norm(v) + here.norm(second) + 1e-14);
        let (a, b) = (here.frame(v)?, there.frame(moved)?);
        prop_assert!((by.rotate(a.tangent) * scale - b.tangent).length() < 1e-12 * scale);
        prop_assert!((by.rotate(a.normal) / scale - b.normal).length() < 1e-12 / scale);
        let curvatures = (here.circular_curvature(v, second)?, there.circular_curvature(moved, by.rotate(second))?);
        prop_assert!((curvatures.0 * scale - curvatures.1).abs() < 1e-11 * scale * (1.0 + curvatures.0.abs()));
    }

    /// Lengths in the norm of an indicatrix, and with them widths, are kept by a linear map of both: here of a circle to
    /// an ellipse.
    #[test]
    fn minkowski_widths(a in 0.2..5.0_f64, b in 0.2..5.0_f64, v in plane(), scale in scale()) {
        prop_assume!(v.length() > 0.1);
        let map = dvec2(a, b);
        let ellipse = MinkowskiPlane::new(Indicatrix::try_new(Ellipse { a: scale * a, b: scale * b })?);
        let circle = MinkowskiPlane::new(Indicatrix::try_new(Ellipse { a: scale, b: scale })?);
        prop_assert!((ellipse.norm(map * v) / circle.norm(v) - 1.0).abs() < 1e-12);
        // An offset line touches the indicatrix; the strip between two of them has a width.
        let distance = |plane: &MinkowskiPlane<Ellipse>, side: DVec2| -> Result<DVec2, ph_curves::Error> {
            plane.offset_point(DVec2::ZERO, side, 0.7)
        };
        let (image, plain) = (distance(&ellipse, map * v)?, distance(&circle, v)?);
        prop_assert!((image - map * plain).length() < 1e-12 * scale * map.length());
    }

    /// Double reflection commutes with rigid motions and scaling.
    #[test]
    fn rotation_minimising_frames_move_with_the_curve(
        points in prop::collection::vec(space(), 3..8), rotation in rotation(), shift in space(), scale in scale()
    ) {
        let samples: Vec<(DVec3, DVec3)> = points
            .windows(2)
            .filter_map(|pair| Some((pair[0], (pair[1] - pair[0]).try_normalize()?)))
            .collect();
        prop_assume!(samples.len() > 1 && samples.windows(2).all(|s| s[0].1.dot(s[1].1) > -0.9));
        let first = Frame::try_new(samples[0].1, samples[0].1.any_orthonormal_vector())?;
        let here = rotation_minimising_frames(first, samples.iter().copied())?;
        let moved = Frame::try_new(rotation * first.tangent, rotation * first.second)?;
        let there = rotation_minimising_frames(
            moved,
            samples.iter().map(|(p, t)| (scale * (rotation * *p + shift), rotation * *t)),
        )?;
        for (a, b) in here.iter().zip(&there) {
            prop_assert!((rotation * a.second - b.second).length() < 1e-9);
            prop_assert!((rotation * a.third - b.third).length() < 1e-9);
        }
    }

    /// Equal times are equal lengths, in any unit, wherever the path lies.
    #[test]
    fn feeds(moves in prop::collection::vec(plane(), 5..9), turn in angle(), shift in plane(), scale in scale(), steps in 10.0..60.0_f64) {
        let by = DVec2::from_angle(turn);
        let here = PhSpline::interpolate(&ring(&moves, |p| p), SplineEnds::Closed)?;
        let there = PhSpline::interpolate(&ring(&moves, |p| scale * (by.rotate(p) + shift)), SplineEnds::Closed)?;
        prop_assert!((there.length() - scale * here.length()).abs() < 1e-9 * there.length());
        let feed = here.length() / steps;
        let points = FeedInterpolator::try_new(&here, FeedRate::Constant(feed), 1.0)?;
        let images = FeedInterpolator::try_new(&there, FeedRate::Constant(scale * feed), 1.0)?;
        let mut before = None;
        let mut count = 0;
        for (a, b) in points.zip(images) {
            prop_assert!((scale * (by.rotate(a.point) + shift) - b.point).length() < 1e-8 * scale);
            prop_assert!(a.length_error.abs() < 1e-13 * here.length());
            prop_assert!(b.length_error.abs() < 1e-13 * there.length());
            // The chord of a step is no longer than the step.
            if let Some(last) = before.replace(b.point) {
                prop_assert!(b.point.distance(last) <= scale * feed * (1.0 + 1e-9));
            }
            count += 1;
        }
        prop_assert!((f64::from(count) - steps.floor() - 1.0).abs() <= 1.0);
    }
}

proptest! {
    // An interpolation takes some milliseconds.
    #![proptest_config(config(20))]

    /// Moved data are interpolated as well (by another of the many quintics), and the rational frame is the one that
    /// double reflection finds.
    #[test]
    fn quintics_with_rational_frames(start in space(), end in space(), d0 in space(), d1 in space(), rotation in rotation(), scale in scale()) {
        let chord = end - start;
        prop_assume!(chord.length() > 0.2);
        // Tangents near the chord, where an interpolant exists.
        let (d0, d1) = (chord.normalize() + 0.4 * d0, chord.normalize() + 0.4 * d1);
        let here = RationalFrameQuintic::interpolate(start, d0, end, d1)?;
        let there = RationalFrameQuintic::interpolate(
            scale * (rotation * start), rotation * d0, scale * (rotation * end), rotation * d1)?;
        for (curve, size, turn) in [(&here, 1.0, DQuat::IDENTITY), (&there, scale, rotation)] {
            prop_assert!((curve.curve().point(1.0) - size * (turn * end)).length() < 1e-11 * size);
            prop_assert!(curve.frame(0.0)?.tangent.distance(turn * d0.normalize()) < 1e-11);
            prop_assert!(curve.frame(1.0)?.tangent.distance(turn * d1.normalize()) < 1e-11);
            let carried = rotation_minimising_frames(curve.frame(0.0)?, along(curve, 400))?;
            let last = carried.last().copied().unwrap_or(curve.frame(0.0)?);
            prop_assert!(curve.frame(1.0)?.angle_to(&last).abs() < 1e-6);
        }
    }
}

/// A support function read as a lift.
trait IntoLift {
    fn into_lift(self) -> impl Fn(f64) -> [f64; 3];
}

impl<S: Support> IntoLift for S {
    fn into_lift(self) -> impl Fn(f64) -> [f64; 3] {
        move |psi| {
            let jet = self.jet(psi);
            [jet.support, jet.slope, jet.bend]
        }
    }
}
