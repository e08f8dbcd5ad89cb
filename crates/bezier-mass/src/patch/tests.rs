use super::*;
use glam::dvec3;

/// A bicubic-by-quadratic saddle with all weights different, one of them zero and one negative.
fn patch() -> Result<BezierPatch<DVec3>, Error> {
    let weight = |i: usize, j: usize| [3.0, 1.0, 0.0, 2.0][i] + [0.5, -0.25, 1.0][j];
    let rows: Vec<Vec<_>> = (0..4)
        .map(|i| {
            let (x, w) = (i as f64, weight);
            (0..3)
                .map(|j| MassPoint::point(dvec3(x, j as f64, x * j as f64 - 0.5 * x * x), w(i, j)))
                .collect()
        })
        .collect();
    BezierPatch::from_rows(&rows)
}

#[test]
fn partial_derivatives_agree_with_differences() -> Result<(), Error> {
    let (patch, u, v, step) = (patch()?, 0.4, 0.7, 1e-4);
    let at = |i: i32, j: i32| patch.point(u + f64::from(i) * step, v + f64::from(j) * step);
    let partials = patch
        .jet(u, v)
        .partials()
        .ok_or(Error::AtInfinity { t: u })?;
    let du = (at(1, 0)? - at(-1, 0)?) / (2.0 * step);
    let dv = (at(0, 1)? - at(0, -1)?) / (2.0 * step);
    let duu = (at(1, 0)? - 2.0 * at(0, 0)? + at(-1, 0)?) / (step * step);
    let dvv = (at(0, 1)? - 2.0 * at(0, 0)? + at(0, -1)?) / (step * step);
    let duv = (at(1, 1)? - at(1, -1)? - at(-1, 1)? + at(-1, -1)?) / (4.0 * step * step);
    assert!((partials.position - at(0, 0)?).length() < 1e-15);
    for (exact, difference, tolerance) in [
        (partials.du, du, 1e-6),
        (partials.dv, dv, 1e-6),
        (partials.duu, duu, 1e-5),
        (partials.duv, duv, 1e-5),
        (partials.dvv, dvv, 1e-5),
    ] {
        assert!(
            (exact - difference).length() < tolerance * (1.0 + exact.length()),
            "{exact} against {difference}"
        );
    }
    let normal = patch.normal(u, v).unwrap_or(DVec3::NAN);
    assert!((normal - partials.du.cross(partials.dv).normalize()).length() < 1e-14);
    Ok(())
}

#[test]
fn every_form_of_the_patch_is_the_same_surface() -> Result<(), Error> {
    let patch = patch()?;
    assert_eq!(patch.degrees(), [3, 2]);
    let raised = patch.elevated_to([4, 5]);
    assert_eq!(raised.degrees(), [4, 5]);
    let part = patch.sub_patch([0.75, 0.25], [Parameter::from(0.5), Parameter::INFINITY])?;
    for (u, v) in [(0.1, 0.2), (0.5, 0.5), (0.9, 0.3)] {
        let point = patch.point(u, v)?;
        assert!((raised.point(u, v)? - point).length() < 1e-13);
        assert!((patch.transposed().point(v, u)? - point).length() < 1e-13);
        assert!((patch.reversed_u().point(1.0 - u, v)? - point).length() < 1e-13);
        assert!((patch.curve_at_u(u).point(v)? - point).length() < 1e-13);
        assert!((patch.curve_at_v(v).point(u)? - point).length() < 1e-13);
        let homography = Homography::between(0.5, Parameter::INFINITY)?;
        let outside = homography.apply(v).value().unwrap_or(f64::NAN);
        let expected = patch.point(0.75 - 0.5 * u, outside)?;
        assert!((part.point(u, v)? - expected).length() < 1e-12 * expected.length());
    }
    let [along_u, along_v] = patch.middle_curves();
    assert!((along_u.point(0.3)? - patch.point(0.3, 0.5)?).length() < 1e-13);
    assert!((along_v.point(0.3)? - patch.point(0.5, 0.3)?).length() < 1e-13);
    Ok(())
}

#[test]
fn malformed_nets_are_refused() {
    let one = MassPoint::point(1.0, 1.0);
    assert!(matches!(
        BezierPatch::new([1, 1], vec![one; 3]),
        Err(Error::WrongCount { needed: 4, .. })
    ));
    assert!(matches!(
        BezierPatch::new([usize::MAX, 1], vec![one; 3]),
        Err(Error::WrongCount { .. })
    ));
    assert!(matches!(
        BezierPatch::from_rows(&[vec![one], vec![one; 2]]),
        Err(Error::WrongCount { .. })
    ));
    assert!(matches!(
        BezierPatch::<f64>::from_rows::<Vec<_>>(&[]),
        Err(Error::WrongCount { .. })
    ));
    assert!(matches!(
        BezierPatch::polynomial([0, 0], &[f64::NAN]),
        Err(Error::NonFinite { .. })
    ));
}
