//! The G2 pipeline on a thousand random B-splines, and its laws.

#[path = "common/random.rs"]
mod random;

use ph_curves::glam::DVec2;
use ph_curves::{Approximated, Approximation, CubicPath, Piece, PlaneCurve, approximate};
use random::Random;

impl Random {
    fn point(&mut self) -> DVec2 {
        DVec2::new(self.unit(), self.unit()) * 2.0 - 1.0
    }
}

/// Control points of one of six families, and whether the spline is closed.
fn control(random: &mut Random, family: usize) -> (Vec<DVec2>, bool) {
    let count = 4 + (random.unit() * 12.0) as usize;
    match family {
        // Anything: inflections and loops.
        0 => ((0..count).map(|_| random.point()).collect(), false),
        1 => ((0..count).map(|_| random.point()).collect(), true),
        // A star-shaped closed loop.
        2 => {
            let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
            let points = (0..count)
                .map(|k| DVec2::from_angle(angle(k)) * (0.4 + random.unit()))
                .collect();
            (points, true)
        }
        // Straight runs between bends.
        3 => {
            let mut points = vec![random.point()];
            while points.len() < count {
                let (from, step) = (points[points.len() - 1], random.point() * 0.4);
                points.extend((1..=4).map(|k| from + step * f64::from(k)));
            }
            (points, random.unit() < 0.5)
        }
        // Near-cusps: a step forwards and almost the same step back.
        4 => {
            let mut points = Vec::new();
            while points.len() < count + 4 {
                let (p, q) = (random.point(), random.point());
                let wobble = random.point() * 10.0_f64.powf(-1.0 - 7.0 * random.unit());
                points.extend([p, q, p + wobble]);
            }
            (points, random.unit() < 0.5)
        }
        // A wave with small noise: many inflections at small turning.
        _ => {
            let points = (0..count + 6)
                .map(|k| DVec2::new(0.2 * k as f64, 0.1 * (k as f64).sin()) + random.point() * 0.02)
                .collect();
            (points, false)
        }
    }
}

/// Distance from `point` to the pieces: golden section about the best of some samples.
fn distance(pieces: &[Piece], point: DVec2) -> f64 {
    const SAMPLES: u32 = 32;
    let mut best = f64::INFINITY;
    for piece in pieces {
        let away = |t: f64| (piece.point(t) - point).length();
        let (mut nearest, mut least) = (0.0, f64::INFINITY);
        for t in (0..=SAMPLES).map(|k| f64::from(k) / f64::from(SAMPLES)) {
            let distance = away(t);
            if distance < least {
                (nearest, least) = (t, distance);
            }
        }
        let step = 1.0 / f64::from(SAMPLES);
        let (mut low, mut high) = ((nearest - step).max(0.0), (nearest + step).min(1.0));
        for _ in 0..44 {
            let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
            if away(a) < away(b) { high = b } else { low = a }
        }
        best = best.min(least).min(away(0.5 * (low + high)));
    }
    best
}

/// Largest distance from the curve to the pieces made from the same parameters.
fn error(curve: &CubicPath, result: &Approximated, samples: usize) -> f64 {
    let mut worst = 0.0_f64;
    let sources = &result.sources;
    let mut first = 0;
    while first < sources.len() {
        let mut after = first + 1;
        while after < sources.len() && (sources[after] == sources[first]) {
            after += 1;
        }
        let [from, to] = sources[first];
        // A bridge has corners with empty sources on both sides.
        let pieces =
            &result.spline.pieces()[first.saturating_sub(2)..(after + 2).min(sources.len())];
        for k in 0..=samples {
            let parameter = from + (to - from) * k as f64 / samples as f64;
            let span = (parameter as usize).min(curve.spans() - 1);
            let point = curve.jet(span, parameter - span as f64)[0];
            worst = worst.max(distance(pieces, point));
        }
        first = after;
    }
    worst
}

#[test]
fn a_thousand_random_b_splines_stay_within_tolerance_with_quartics() {
    survive(Approximation::quartics);
}

#[test]
fn a_thousand_random_b_splines_stay_within_tolerance_with_class_9() {
    survive(Approximation::within);
}

#[test]
fn a_thousand_random_b_splines_stay_within_tolerance_with_class_14() {
    survive(Approximation::fewest);
}

/// A spiral of 20 spans: class 14 runs over knots where class 9 needs an arc for every span.
#[test]
fn class_14_takes_fewer_arcs_over_knots() {
    let spiral: Vec<DVec2> = (0..23)
        .map(|k| DVec2::from_angle(0.45 * f64::from(k)) * (12.0 + 1.75 * f64::from(k)))
        .collect();
    let curve = CubicPath::uniform_bspline(&spiral, false).unwrap();
    let few = approximate(&curve, &Approximation::within(1e-4)).unwrap();
    let fewest = approximate(&curve, &Approximation::fewest(1e-4)).unwrap();
    assert_eq!(few.spline.pieces().len(), 20);
    assert!(fewest.spline.pieces().len() <= 12);
    assert!(error(&curve, &fewest, 100) <= 1e-4);
    assert_eq!(fewest.g1_joints, 0);
    for piece in fewest.spline.pieces() {
        assert!(matches!(piece, Piece::Wider(_) | Piece::Wide(_)));
        let (part, back) = (piece.part(0.25, 0.75).unwrap(), piece.reverse());
        let bezier = piece.to_bezier().unwrap();
        for t in [0.0, 0.3, 0.8, 1.0] {
            // Rounding at size 50, some ulps more for a degree of 15.
            assert!((part.point(t) - piece.point(0.25 + 0.5 * t)).length() < 1e-11);
            assert!((back.point(t) - piece.point(1.0 - t)).length() < 1e-11);
            assert!((bezier.point(t).unwrap() - piece.point(t)).length() < 1e-11);
            let moved = piece.offset(2.0).point(t) - piece.point(t) - 2.0 * piece.normal(t);
            assert!(moved.length() < 1e-11);
        }
    }
}

fn survive(how: impl Fn(f64) -> Approximation) {
    let mut random = Random(20_261_122);
    let (mut refused, mut pieces) = (0, 0);
    for case in 0..1000 {
        let family = case % 6;
        let (points, closed) = control(&mut random, family);
        let scale = 10.0_f64.powf(-7.0 + 16.0 * random.unit());
        let points: Vec<DVec2> = points.iter().map(|p| *p * scale).collect();
        let curve = CubicPath::uniform_bspline(&points, closed).unwrap();
        let tolerance = scale * 10.0_f64.powf(-2.0 - 5.0 * random.unit());
        let result = match approximate(&curve, &how(tolerance)) {
            Ok(result) => result,
            Err(reason) => {
                println!("case {case}, family {family}: {reason}");
                refused += 1;
                continue;
            }
        };
        pieces += result.spline.pieces().len();
        assert!(result.error <= tolerance);
        let found = error(&curve, &result, 5);
        assert!(
            found <= 1.001 * tolerance,
            "case {case}, family {family}: {} of the tolerance",
            found / tolerance
        );
        // Continuity: points and normals agree at every joint.
        let all = result.spline.pieces();
        for (i, _) in result.spline.joints().iter().enumerate() {
            let (a, b) = (&all[i], &all[(i + 1) % all.len()]);
            let gap = (a.point(1.0) - b.point(0.0)).length();
            let turn = (a.normal(1.0) - b.normal(0.0)).length();
            assert!(
                gap < (1e-9 * scale).max(0.01 * tolerance) && turn < 1e-8,
                "case {case}, family {family}, joint {i}: {gap} {turn}"
            );
        }
        assert!(
            result.spline.g2_jump() < 1e-4,
            "case {case}: {}",
            result.spline.g2_jump()
        );
    }
    println!("{refused} refused, {pieces} pieces");
    assert!(refused <= 10, "{refused} of 1000 refused");
}

/// Samples far denser than the tolerance needs: arcs run over many knots.
#[test]
fn dense_samples_take_few_arcs() {
    for count in [1000_u32, 4000] {
        let points: Vec<DVec2> = (0..count)
            .map(|k| {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count);
                DVec2::from_angle(angle) * (50.0 + 7.0 * (3.0 * angle).sin())
            })
            .collect();
        let curve = CubicPath::through(&points, true).unwrap();
        for tolerance in [1e-3, 1e-5] {
            let result = approximate(&curve, &Approximation::within(tolerance)).unwrap();
            let pieces = result.spline.pieces().len();
            assert!(pieces <= 60, "{count} samples, {tolerance}: {pieces}");
            assert_eq!(result.g1_joints, 0);
            assert!(error(&curve, &result, 40) <= tolerance);
        }
    }
}
