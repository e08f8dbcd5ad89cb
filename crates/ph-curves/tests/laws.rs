//! What is built from points moves with them: rigid motions, scaling and reversal act on results as on data.

use ph_curves::glam::{DVec2, DVec3, dvec2};
use ph_curves::{
    Approximation, CubicPath, CurvatureElement, DualCurve, EvolutePolygon, G2Pair, Hermite, Line,
    PhSpline, PolynomialPh, SpatialHermite, SplineEnds, TCubic, approximate,
};
use proptest::prelude::*;

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 60,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(20_261_122),
        ..ProptestConfig::default()
    }
}

fn plane() -> impl Strategy<Value = DVec2> {
    (-1.0..1.0, -1.0..1.0).prop_map(|(x, y)| dvec2(x, y))
}

/// A similarity that keeps orientation.
#[derive(Clone, Copy, Debug)]
struct Motion {
    turn: DVec2,
    scale: f64,
    shift: DVec2,
}

impl Motion {
    fn point(&self, p: DVec2) -> DVec2 {
        self.turn.rotate(p) * self.scale + self.shift
    }

    fn vector(&self, v: DVec2) -> DVec2 {
        self.turn.rotate(v) * self.scale
    }
}

fn motion() -> impl Strategy<Value = Motion> {
    (0.0..std::f64::consts::TAU, -2.0..2.0, plane()).prop_map(|(angle, power, shift)| {
        let scale = 10.0_f64.powf(power);
        Motion {
            turn: DVec2::from_angle(angle),
            scale,
            shift: shift * scale * 3.0,
        }
    })
}

/// A triangle with no angle near 0 or pi.
fn triangle() -> impl Strategy<Value = [DVec2; 3]> {
    [plane(), plane(), plane()].prop_filter("thin", |[a, b, c]| {
        let area = (*b - *a).perp_dot(*c - *a).abs();
        let longest = [*b - *a, *c - *b, *a - *c]
            .map(|side| side.length_squared())
            .into_iter()
            .fold(0.0, f64::max);
        area > 0.1 * longest && longest > 0.01
    })
}

const SHARES: [f64; 4] = [0.0, 0.31, 0.77, 1.0];

proptest! {
    #![proptest_config(config())]

    #[test]
    fn cubics_in_triangles(corners in triangle(), motion in motion()) {
        let [a, b, c] = corners;
        let here = TCubic::in_triangle(a, b, c)?;
        let [a, b, c] = corners.map(|p| motion.point(p));
        let there = TCubic::in_triangle(a, b, c)?;
        prop_assert!((there.length() - motion.scale * here.length()).abs() < 1e-12 * motion.scale);
        for t in SHARES {
            let apart = (motion.point(here.point(t)) - there.point(t)).length();
            prop_assert!(apart < 1e-12 * motion.scale);
        }
    }

    #[test]
    fn hermite_quintics_and_their_recognition(
        end in plane(), d0 in plane(), d1 in plane(), motion in motion()
    ) {
        prop_assume!(end.length() > 0.2 && d0.length() > 0.2 && d1.length() > 0.2);
        let data = Hermite { start: DVec2::ZERO, start_derivative: d0, end, end_derivative: d1 };
        let moved = Hermite {
            start: motion.point(data.start),
            start_derivative: motion.vector(d0),
            end: motion.point(end),
            end_derivative: motion.vector(d1),
        };
        let (here, there) = (data.least_bending()?, moved.least_bending()?);
        let size = motion.scale;
        // The least energy may be shared by two curves; their energies agree.
        let energy = here.bending_energy();
        prop_assert!((energy - there.bending_energy() * size).abs() < 1e-6 * energy.max(1.0));
        let found = PolynomialPh::recognise(there.control_points())?;
        for t in SHARES {
            prop_assert!((found.point(t) - there.point(t)).length() < 1e-9 * size);
            let (a, b) = (found.arc_length().up_to(t), there.arc_length().up_to(t));
            prop_assert!((a - b).abs() < 1e-7 * there.arc_length().total());
        }
    }

    #[test]
    fn pairs_of_quartics(start in 0.0..1.0_f64, turn in 0.3..2.0_f64, slope in 0.1..0.6_f64, motion in motion()) {
        // Elements of a logarithmic spiral are always admissible.
        let element = |theta: f64| {
            let r = (slope * theta).exp();
            let normal = dvec2(1.0, -slope).rotate(DVec2::from_angle(theta));
            (DVec2::from_angle(theta) * r, normal, r * (1.0 + slope * slope).sqrt())
        };
        let pair = |map: &dyn Fn((DVec2, DVec2, f64)) -> Result<CurvatureElement, ph_curves::Error>| {
            G2Pair::new(&map(element(start))?, &map(element(start + turn))?, 0.5)
        };
        let here = pair(&|(p, n, r)| CurvatureElement::new(p, n, r))?;
        let there = pair(&|(p, n, r)| {
            CurvatureElement::new(motion.point(p), motion.turn.rotate(n), r * motion.scale)
        })?;
        for (a, b) in here.arcs.iter().zip(&there.arcs) {
            for t in SHARES {
                prop_assert!((motion.point(a.point(t)) - b.point(t)).length() < 1e-7 * motion.scale);
            }
        }
    }

    #[test]
    fn envelopes_of_lines(angles in [0.1..0.6_f64, 0.1..0.6, 0.1..0.6], supports in [1.0..2.0_f64, 1.0..2.0, 1.0..2.0, 1.0..2.0], motion in motion()) {
        let mut angle = 0.0;
        let normals: Vec<DVec2> = std::iter::once(0.0)
            .chain(angles)
            .map(|step| { angle += step; DVec2::from_angle(angle) })
            .collect();
        let lines = |map: &dyn Fn(DVec2, f64) -> Result<Line, ph_curves::Error>| {
            normals.iter().zip(supports).map(|(n, p)| map(*n, p)).collect::<Result<Vec<_>, _>>()
        };
        let here = DualCurve::new(&lines(&|n, p| Line::new(-p, n.x, n.y))?)?;
        let there = DualCurve::new(&lines(&|n, p| {
            let turned = motion.turn.rotate(n);
            Line::new(-p * motion.scale - turned.dot(motion.shift), turned.x, turned.y)
        })?)?;
        for t in SHARES {
            let (a, b) = (here.contact(t)?, there.contact(t)?);
            prop_assert!((motion.point(a.point) - b.point).length() < 1e-11 * motion.scale);
            prop_assert!((motion.turn.rotate(a.normal) - b.normal).length() < 1e-12);
            prop_assert!((a.radius * motion.scale - b.radius).abs() < 1e-9 * motion.scale * a.radius.abs().max(1.0));
        }
    }

    #[test]
    fn splines_through_points(points in proptest::collection::vec(0.8..1.3_f64, 5..9), motion in motion()) {
        let count = points.len() as f64;
        let points: Vec<DVec2> = points.iter().enumerate()
            .map(|(k, r)| DVec2::from_angle(std::f64::consts::TAU * k as f64 / count) * *r)
            .collect();
        let moved: Vec<DVec2> = points.iter().map(|p| motion.point(*p)).collect();
        let here = PhSpline::interpolate(&points, SplineEnds::Closed)?;
        let there = PhSpline::interpolate(&moved, SplineEnds::Closed)?;
        prop_assert!((here.length() * motion.scale - there.length()).abs() < 1e-9 * there.length());
    }

    #[test]
    fn ovals_of_constant_width(corners in triangle(), motion in motion()) {
        let Ok(here) = EvolutePolygon::try_new(&corners) else {
            // Obtuse triangles have none, wherever they lie.
            prop_assert!(EvolutePolygon::try_new(&corners.map(|p| motion.point(p))).is_err());
            return Ok(());
        };
        let there = EvolutePolygon::try_new(&corners.map(|p| motion.point(p)))?;
        prop_assert!((here.minimum_width() * motion.scale - there.minimum_width()).abs() < 1e-9 * motion.scale);
        let width = 1.5 * here.minimum_width();
        let rosette = there.rosette(width * motion.scale)?;
        prop_assert!((rosette.perimeter() - std::f64::consts::PI * width * motion.scale).abs() < 1e-9 * motion.scale);
    }

    #[test]
    fn trimmed_offsets(radii in proptest::collection::vec(0.6..1.4_f64, 5..8), motion in motion(), distance in -0.4..0.4_f64) {
        let count = radii.len() as f64;
        let points: Vec<DVec2> = radii.iter().enumerate()
            .map(|(k, r)| DVec2::from_angle(std::f64::consts::TAU * k as f64 / count) * *r)
            .collect();
        let trimmed = |points: &[DVec2], scale: f64| -> Result<f64, ph_curves::Error> {
            let path = CubicPath::uniform_bspline(points, true)?;
            let spline = approximate(&path, &Approximation::within(1e-7 * scale))?.spline;
            Ok(spline.trimmed_offset(distance * scale)?.iter().map(|chain| chain.length()).sum())
        };
        let moved: Vec<DVec2> = points.iter().map(|p| motion.point(*p)).collect();
        let (here, there) = (trimmed(&points, 1.0)?, trimmed(&moved, motion.scale)?);
        prop_assert!((here * motion.scale - there).abs() < 1e-5 * motion.scale, "{} {}", here, there / motion.scale);
    }

    #[test]
    fn space_quintics_of_given_length(end in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], power in -3.0..3.0_f64) {
        let end = DVec3::from(end);
        prop_assume!(end.length() > 0.3);
        let scale = 10.0_f64.powf(power);
        let data = |scale: f64| SpatialHermite {
            start: DVec3::ZERO,
            start_derivative: DVec3::new(1.0, 0.3, 0.2) * scale,
            end: end * scale,
            end_derivative: DVec3::new(0.4, 1.0, -0.3) * scale,
        };
        let (here, there) = (data(1.0).least_bending()?, data(scale).least_bending()?);
        let length = here.arc_length().total();
        prop_assert!((length * scale - there.arc_length().total()).abs() < 1e-6 * length * scale);
    }
}
