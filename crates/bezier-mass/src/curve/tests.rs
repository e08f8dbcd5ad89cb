use super::*;
use glam::{DVec2, dvec2};

fn semicircle() -> Result<BezierCurve<DVec2>, Error> {
    BezierCurve::new(vec![
        MassPoint::point(dvec2(1.0, 0.0), 1.0),
        MassPoint::vector(dvec2(0.0, 1.0)),
        MassPoint::point(dvec2(-1.0, 0.0), 1.0),
    ])
}

#[test]
fn semicircle_stays_on_the_circle_in_every_form() -> Result<(), Error> {
    let arc = semicircle()?;
    let forms = [
        arc.clone(),
        arc.elevated_to(5),
        arc.subdivide(0.3).0,
        arc.sub_arc(0.25, Parameter::INFINITY)?,
        arc.elevated_to(4).sub_arc(2.0, -1.0)?,
        arc.complement(),
    ];
    for (number, form) in forms.iter().enumerate() {
        for i in 0..=16 {
            let point = form.point(f64::from(i) / 16.0)?;
            assert!(
                (point.length() - 1.0).abs() < 1e-14,
                "form {number} at {i}/16: {point}"
            );
        }
    }
    Ok(())
}

#[test]
fn jets_agree_with_differences() -> Result<(), Error> {
    let curve = semicircle()?.elevated();
    let (t, step) = (0.3, 1e-5);
    let [before, here, after] = [t - step, t, t + step].map(|t| curve.point(t));
    let (before, here, after) = (before?, here?, after?);
    let jet = curve.jet(t);
    let velocity = (after - before) / (2.0 * step);
    let acceleration = (after - 2.0 * here + before) / (step * step);
    assert!(
        jet.velocity()
            .is_some_and(|v| (v - velocity).length() < 1e-8)
    );
    assert!(
        jet.acceleration()
            .is_some_and(|a| (a - acceleration).length() < 1e-4)
    );
    Ok(())
}

#[test]
fn the_direction_at_a_vanishing_weight_is_the_asymptote() -> Result<(), Error> {
    // The hyperbola x^2 - y^2 = 1 from (1, 0) through infinity to (-1, 0).
    let branch = BezierCurve::new(vec![
        MassPoint::point(dvec2(1.0, 0.0), 1.0),
        MassPoint::vector(dvec2(0.0, 1.0)),
        MassPoint::point(dvec2(-1.0, 0.0), -1.0),
    ])?;
    assert!(branch.at(0.5).is_vector());
    assert_eq!(branch.point(0.5), Err(Error::AtInfinity { t: 0.5 }));
    let direction = branch.tangent_direction(0.5).unwrap_or(DVec2::NAN);
    assert!((direction.normalize() - dvec2(0.5, 0.5).normalize()).length() < 1e-15);
    Ok(())
}

#[test]
fn directions_at_coincident_control_points_and_cusps() -> Result<(), Error> {
    let [o, e] = [dvec2(0.0, 0.0), dvec2(1.0, 2.0)];
    let stays = BezierCurve::polynomial(&[o, o, e, e])?;
    for t in [0.0, 1.0] {
        let direction = stays.tangent_direction(t).unwrap_or(DVec2::NAN);
        assert!(
            (direction.normalize() - e.normalize()).length() < 1e-15,
            "at {t}: {direction}"
        );
    }
    // (t^2, t^3) around its cusp: it leaves along +x.
    let cusp = BezierCurve::polynomial(&[
        dvec2(1.0, -1.0),
        dvec2(-1.0, 1.0),
        dvec2(-1.0, -1.0),
        dvec2(1.0, 1.0),
    ])?;
    let direction = cusp.tangent_direction(0.5).unwrap_or(DVec2::NAN);
    assert!(
        (direction.normalize() - dvec2(1.0, 0.0)).length() < 1e-12,
        "{direction}"
    );
    assert_eq!(
        BezierCurve::polynomial(&[e, e, e])?.tangent_direction(0.5),
        None
    );
    assert_eq!(BezierCurve::polynomial(&[e])?.tangent_direction(0.5), None);
    Ok(())
}

#[test]
fn hostile_input_is_refused() -> Result<(), Error> {
    assert!(matches!(
        BezierCurve::<f64>::new(Vec::new()),
        Err(Error::WrongCount { .. })
    ));
    assert!(matches!(
        BezierCurve::polynomial(&[1.0, f64::NAN]),
        Err(Error::NonFinite { .. })
    ));
    let arc = semicircle()?;
    assert!(matches!(
        arc.point(f64::INFINITY),
        Err(Error::NonFinite { .. })
    ));
    assert_eq!(arc.at(f64::NAN).position(), None);
    assert!(arc.sub_arc(0.5, f64::NAN).is_err());
    assert!(arc.sub_arc(0.5, 0.5).is_err());
    Ok(())
}
