//! Curves met by lines, rays, segments, circles, implicit curves and one another.

use glam::{DVec2, DVec3};
use variation::{
    Curve, Error, ImplicitCurve, Interval, Line, Plane, meet_plane, plane_bound,
    roots_of_power_form,
};

const QUARTER_WEIGHTS: [f64; 3] = [1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0];

fn points<const N: usize>(points: [(f64, f64); N]) -> [DVec2; N] {
    points.map(DVec2::from)
}

#[test]
fn rays_and_segments_keep_their_part_of_the_line() {
    let p = points([(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)]);
    let curve = Curve::polynomial(&p).unwrap();
    assert_eq!(
        curve
            .meet_line(Line::try_new(0.0, 1.0, 0.0).unwrap())
            .unwrap()
            .len(),
        3
    );
    assert_eq!(
        curve
            .meet_ray(DVec2::new(1.0, 0.0), DVec2::X)
            .unwrap()
            .len(),
        2
    );
    assert_eq!(
        curve
            .meet_ray(DVec2::new(1.5, 0.0), DVec2::X)
            .unwrap()
            .len(),
        2,
        "its origin is a hit"
    );
    assert_eq!(
        curve
            .meet_ray(DVec2::new(1.0, 0.0), DVec2::NEG_X)
            .unwrap()
            .len(),
        1
    );
    assert_eq!(
        curve
            .meet_segment(DVec2::new(1.0, 0.0), DVec2::new(2.0, 0.0))
            .unwrap()
            .len(),
        1
    );
    assert_eq!(
        curve
            .meet_segment(DVec2::new(0.0, 0.0), DVec2::new(3.0, 0.0))
            .unwrap()
            .len(),
        3
    );
    assert_eq!(
        curve.meet_segment(DVec2::ONE, DVec2::ONE),
        Err(Error::ZeroNormal)
    );
}

#[cfg(feature = "exact")]
#[test]
fn a_tangent_line_is_hit_once_with_multiplicity_two() {
    let p = points([(0.0, 0.0), (1.0, 2.0), (2.0, 0.0)]);
    let hits = Curve::polynomial(&p)
        .unwrap()
        .meet_line(Line::try_new(0.0, 1.0, -1.0).unwrap())
        .unwrap();
    assert_eq!(hits.len(), 1);
    assert_eq!(hits[0].root.multiplicity(), Some(2));
    assert_eq!(hits[0].point.y, 1.0);
}

/// Fractions that are no binary ones: every coefficient of the derived polynomial is rounded, the first is zero.
#[cfg(feature = "exact")]
#[test]
fn a_segment_from_the_end_of_a_curve_meets_it_exactly_there() {
    let p: Vec<DVec2> = (0..=12)
        .map(|i| DVec2::new(0.1 + f64::from(i) / 12.0, (1.7 * f64::from(i)).sin() + 0.3))
        .collect();
    let hits = Curve::polynomial(&p)
        .unwrap()
        .meet_segment(p[0], p[0] + DVec2::new(0.7, 0.1))
        .unwrap();
    assert_eq!(hits.len(), 2);
    assert_eq!((hits[0].root.lo, hits[0].root.hi), (0.0, 0.0));
    assert_eq!(hits[0].root.multiplicity(), Some(1));
}

#[cfg(feature = "exact")]
#[test]
fn near_a_tangent_line_there_are_two_hits_or_none() {
    let p = points([(0.0, 0.0), (0.3, 0.7), (0.7, 0.7), (1.0, 0.0)]);
    let curve = Curve::polynomial(&p).unwrap();
    let top = curve.point(0.5).y;
    for (offset, hits) in [(-1e-13, 2), (1e-13, 0), (-1e-15, 2), (1e-15, 0)] {
        let y = top + offset;
        let found = curve
            .meet_segment(DVec2::new(-1.0, y), DVec2::new(2.0, y))
            .unwrap();
        assert_eq!(found.len(), hits, "{offset}: {found:?}");
        assert!(found.iter().all(|hit| hit.root.multiplicity() == Some(1)));
    }
}

#[test]
fn hits_with_a_rational_curve_and_their_bound_without_solving() {
    let p = points([(0.0, -1.0), (1.0, 3.0), (2.0, 3.0), (3.0, -1.0)]);
    let curve = Curve::rational(&p, &[1.0, 3.0, 3.0, 1.0]).unwrap();
    let line = |y: f64| Line::try_new(0.0, 1.0, -y).unwrap();
    assert_eq!(curve.meet_line(line(0.0)).unwrap().len(), 2);
    assert_eq!(curve.line_bound(line(0.0), &[]).unwrap().best, 2);
    for hit in curve.meet_line(line(0.0)).unwrap() {
        assert!(hit.point.y.abs() < 1e-11);
    }
    // The polygon crosses, the curve does not; one pole sees that.
    assert!(curve.meet_line(line(2.9)).unwrap().is_empty());
    assert_eq!(curve.line_bound(line(2.9), &[]).unwrap().best, 2);
    assert_eq!(
        curve.line_bound(line(2.9), &[0.5, 0.5, 0.5]).unwrap().best,
        0
    );
}

#[test]
fn circle_and_conic_agree() {
    let p = points([(-2.0, -0.5), (-1.0, 3.0), (1.0, -3.0), (2.0, 0.5)]);
    let curve = Curve::polynomial(&p).unwrap();
    let by_circle = curve.meet_circle(DVec2::ZERO, 1.0).unwrap();
    let by_conic = curve
        .meet_implicit(&ImplicitCurve::conic([1.0, 0.0, 1.0, 0.0, 0.0, -1.0]).unwrap())
        .unwrap();
    assert_eq!((by_circle.len(), by_conic.len()), (2, 2));
    for (a, b) in by_circle.iter().zip(&by_conic) {
        assert!((a.point.length() - 1.0).abs() < 1e-11 && a.point.distance(b.point) < 1e-11);
    }
    assert!(matches!(
        curve.meet_circle(DVec2::ZERO, -1.0),
        Err(Error::Radius { .. })
    ));
}

#[cfg(feature = "exact")]
#[test]
fn a_curve_on_its_implicit_form_is_reported() {
    // (1, 0), (1, 1), (0, 1) with weights 1, 1, 2 is an exact quarter of the unit circle.
    let p = points([(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    let curve = Curve::rational(&p, &[1.0, 1.0, 2.0]).unwrap();
    assert_eq!(curve.meet_circle(DVec2::ZERO, 1.0), Err(Error::LiesOn));
    let flat = points([(0.0, 0.0), (1.0, 1.0), (3.0, 3.0)]);
    let line = Line::try_new(1.0, -1.0, 0.0).unwrap();
    assert_eq!(
        Curve::polynomial(&flat).unwrap().meet_line(line),
        Err(Error::LiesOn)
    );
}

#[test]
fn planes_meet_space_curves() {
    let helix = [
        (0.0, 0.0, 0.0),
        (1.0, 3.0, 1.0),
        (2.0, -3.0, 2.0),
        (3.0, 0.0, 3.0),
    ]
    .map(DVec3::from);
    // No bound is below the number of hits, and more poles do not make it worse than the control polygon.
    for height in [-3.0, -1.5, 0.0, 0.7] {
        let plane = Plane::try_new(DVec3::new(0.3, -0.2, 1.0), height).unwrap();
        let hits = meet_plane(&helix, None, plane).unwrap().len();
        let polygon = plane_bound(&helix, None, plane, &[]).unwrap().best;
        for poles in [&[0.5][..], &[0.25, 0.75], &[0.5, 0.5]] {
            let bound = plane_bound(&helix, None, plane, poles).unwrap().best;
            assert!(
                hits <= bound && bound <= polygon,
                "{height}: {hits} {bound} {polygon}"
            );
        }
    }
    let roots = meet_plane(&helix, None, Plane::try_new(DVec3::Z, -1.5).unwrap()).unwrap();
    assert_eq!(roots.len(), 1);
    assert!((roots[0].value() - 0.5).abs() < 1e-12);
}

#[test]
fn power_form() {
    // (t - 3)(t - 4)(t - 5) on [0, 10]
    let roots = roots_of_power_form(
        &[-60.0, 47.0, -12.0, 1.0],
        Interval::try_new(0.0, 10.0).unwrap(),
    )
    .unwrap();
    let values: Vec<f64> = roots.iter().map(|r| r.value()).collect();
    assert_eq!(values.len(), 3);
    assert!(
        values
            .iter()
            .zip([3.0, 4.0, 5.0])
            .all(|(a, b)| (a - b).abs() < 1e-11)
    );
    assert_eq!(
        roots_of_power_form(&[], Interval::UNIT),
        Err(Error::NoCoefficients)
    );
}

#[test]
fn extrema_and_inflections() {
    let p = points([(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)]);
    let curve = Curve::polynomial(&p).unwrap();
    let extrema = curve.extrema(DVec2::Y).unwrap();
    assert_eq!(extrema.len(), 2);
    assert!((extrema[0].value() - (0.5 - 3.0_f64.sqrt() / 6.0)).abs() < 1e-12);
    let inflections = curve.inflections().unwrap();
    assert_eq!(inflections.len(), 1);
    assert!((inflections[0].value() - 0.5).abs() < 1e-12);
    // A quarter circle as a rational curve: no extrema inside in the diagonal's normal direction but one along it.
    let q = points([(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]);
    let arc = Curve::rational(&q, &QUARTER_WEIGHTS).unwrap();
    let extrema = arc.extrema(DVec2::ONE).unwrap();
    assert_eq!(extrema.len(), 1);
    assert!((extrema[0].value() - 0.5).abs() < 1e-12);
    assert!(arc.inflections().unwrap().is_empty());
    // A rational cubic with an inflection: weights do not move it off the point of symmetry.
    let arc = Curve::rational(&p, &[1.0, 2.0, 2.0, 1.0]).unwrap();
    let inflections = arc.inflections().unwrap();
    assert_eq!(inflections.len(), 1);
    assert!((inflections[0].value() - 0.5).abs() < 1e-12);
}

#[test]
fn cubics_cross_up_to_nine_times() {
    let a = points([(0.0, 0.0), (1.0, 12.0), (-0.2, -11.0), (0.8, 1.0)]);
    let b: Vec<DVec2> = a.iter().map(|p| DVec2::new(p.y, p.x)).collect();
    let (first, second) = (
        Curve::polynomial(&a).unwrap(),
        Curve::polynomial(&b).unwrap(),
    );
    let meetings = first.meet_curve(second).unwrap();
    for m in &meetings {
        let (s, t) = (
            0.5 * (m.first[0] + m.first[1]),
            0.5 * (m.second[0] + m.second[1]),
        );
        assert!(first.point(s).distance(second.point(t)) < 1e-8, "{m:?}");
    }
    // Every crossing on the diagonal is a crossing of the cubic with its mirror line.
    let diagonal = first
        .meet_line(Line::try_new(1.0, -1.0, 0.0).unwrap())
        .unwrap();
    for hit in &diagonal {
        assert!(
            meetings.iter().any(|m| m.point.distance(hit.point) < 1e-8),
            "{hit:?}"
        );
    }
    assert!(meetings.iter().filter(|m| m.crossing).count() >= 3);
}

#[test]
fn curves_that_share_an_end_or_touch() {
    let a = points([(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
    let b = points([(0.0, 0.0), (-1.0, 1.0), (-2.0, 3.0)]);
    let c = points([(0.0, 1.0), (1.0, 0.0), (2.0, 1.0)]);
    let curve = |p| Curve::polynomial(p).unwrap();
    let shared = curve(&a).meet_curve(curve(&b)).unwrap();
    assert_eq!(shared.len(), 1);
    assert!(shared[0].crossing && shared[0].first == [0.0, 0.0] && shared[0].second == [0.0, 0.0]);
    let touching = curve(&a).meet_curve(curve(&c)).unwrap();
    assert_eq!(touching.len(), 1, "{touching:?}");
    assert!(!touching[0].crossing && touching[0].point.distance(DVec2::new(1.0, 0.5)) < 1e-4);
    let same = curve(&a).meet_curve(curve(&a));
    assert_eq!(same, Err(Error::LiesOn));
}

#[test]
fn a_loop_crosses_itself_once() {
    let p = points([(0.0, 0.0), (3.0, 2.0), (-2.0, 2.0), (1.0, 0.0)]);
    let curve = Curve::polynomial(&p).unwrap();
    let meetings = curve.self_meetings().unwrap();
    assert_eq!(meetings.len(), 1, "{meetings:?}");
    let m = meetings[0];
    assert!(m.crossing && m.first[1] < m.second[0]);
    assert!(curve.point(m.first[0]).distance(curve.point(m.second[0])) < 1e-9);
    let plain = points([(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)]);
    assert!(
        Curve::polynomial(&plain)
            .unwrap()
            .self_meetings()
            .unwrap()
            .is_empty()
    );
}

#[test]
fn curves_are_checked() {
    assert_eq!(Curve::polynomial(&[]), Err(Error::NoControlPoints));
    let p = points([(0.0, 0.0), (f64::NAN, 1.0)]);
    assert!(matches!(
        Curve::polynomial(&p),
        Err(Error::NotFinite { index: 2, .. })
    ));
    let p = points([(0.0, 0.0), (1.0, 1.0)]);
    assert_eq!(
        Curve::rational(&p, &[1.0]),
        Err(Error::WeightCount {
            points: 2,
            weights: 1
        })
    );
    assert_eq!(
        Curve::rational(&p, &[1.0, 0.0]),
        Err(Error::WeightNotPositive {
            index: 1,
            weight: 0.0
        })
    );
    assert_eq!(Line::try_new(0.0, 0.0, 1.0), Err(Error::ZeroNormal));
}
