use super::*;
use bezier_mass::bernstein;
use std::f64::consts::TAU;

fn second_derivative(curve: &PolynomialPh, t: f64) -> DVec2 {
    bernstein::evaluate(
        &bernstein::derivative(&bernstein::derivative(curve.control_points())),
        t,
    )
}

fn is_c2(pairs: impl Iterator<Item = (PolynomialPh, PolynomialPh)>) {
    for (one, two) in pairs {
        assert!((one.point(1.0) - two.point(0.0)).length() < 1e-12);
        assert!((one.velocity(1.0) - two.velocity(0.0)).length() < 1e-12);
        assert!((second_derivative(&one, 1.0) - second_derivative(&two, 0.0)).length() < 1e-11);
    }
}

#[test]
fn a_clamped_spline_is_c2_and_meets_its_ends() {
    let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 1.2), (3.0, 0.3), (4.0, -0.5)]
        .map(|(x, y)| DVec2::new(x, y));
    let (start_derivative, end_derivative) = (DVec2::new(1.2, 0.4), DVec2::new(1.0, -0.8));
    let spline = PhSpline::interpolate(
        &points,
        SplineEnds::Clamped {
            start_derivative,
            end_derivative,
        },
    )
    .unwrap();
    is_c2(
        spline
            .spans()
            .windows(2)
            .map(|pair| (pair[0].clone(), pair[1].clone())),
    );
    assert!((spline.velocity(0.0) - start_derivative).length() < 1e-12);
    assert!((spline.velocity(4.0) - end_derivative).length() < 1e-12);
    for (i, point) in points.iter().enumerate() {
        assert!((spline.point(i as f64) - *point).length() < 1e-12);
    }
}

/// Closed curves of every small rotation number: odd ones need the sign -1.
#[test]
fn closed_splines_are_c2_around_the_seam() {
    for turns in 1..=3 {
        let count = 8 * turns;
        let points: Vec<DVec2> = (0..count)
            .map(|i| {
                let angle = TAU * f64::from(turns) * f64::from(i) / f64::from(count);
                DVec2::from_angle(angle)
                    * (2.0 + 0.5 * (TAU * f64::from(i) / f64::from(count)).cos())
            })
            .collect();
        let spline = PhSpline::interpolate(&points, SplineEnds::Closed).unwrap();
        let spans = spline.spans();
        assert_eq!(spans.len(), points.len());
        is_c2((0..spans.len()).map(|i| (spans[i].clone(), spans[(i + 1) % spans.len()].clone())));
    }
}

#[test]
fn a_single_clamped_span_and_arc_length_across_spans() {
    let points = [DVec2::ZERO, DVec2::new(1.0, 1.0)];
    let ends = SplineEnds::Clamped {
        start_derivative: DVec2::X,
        end_derivative: DVec2::Y,
    };
    let spline = PhSpline::interpolate(&points, ends).unwrap();
    assert!((spline.point(1.0) - points[1]).length() < 1e-13);
    for i in 0..=10 {
        let s = spline.length() * f64::from(i) / 10.0;
        assert!((spline.length_up_to(spline.parameter_at(s).unwrap()) - s).abs() < 1e-14);
    }
    assert!(spline.parameter_at(-1.0).is_err() && spline.parameter_at(f64::NAN).is_err());
}

#[test]
fn hostile_points_are_refused() {
    let closed = |points: &[DVec2]| PhSpline::interpolate(points, SplineEnds::Closed);
    assert!(matches!(
        closed(&[DVec2::ZERO, DVec2::X]),
        Err(Error::TooFew { .. })
    ));
    assert!(matches!(
        closed(&[DVec2::ZERO, DVec2::X, DVec2::X]),
        Err(Error::ZeroDirection { .. })
    ));
    assert!(matches!(
        closed(&[DVec2::ZERO, DVec2::X, DVec2::NAN]),
        Err(Error::NonFinite { .. })
    ));
    let still = SplineEnds::Clamped {
        start_derivative: DVec2::ZERO,
        end_derivative: DVec2::X,
    };
    assert!(matches!(
        PhSpline::interpolate(&[DVec2::ZERO, DVec2::X], still),
        Err(Error::ZeroDirection { .. })
    ));
    assert!(matches!(
        PhSpline::try_new(vec![]),
        Err(Error::TooFew { .. })
    ));
}
