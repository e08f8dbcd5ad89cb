//! Readings and curves that no ribbon should have: an error with the numbers, or an answer that is finite, never a panic.

use bezier_mass::{BezierCurve, MassPoint};
use core::array::from_fn;
use glam::{DVec2, DVec3, dvec2, dvec3};
use reconstruct::{
    BezierStrip, ClosedPlanarRibbon, ClosedSpatialRibbon, CornerData, Crossing, CubicSpline,
    Degree7Shape, EndCondition, EndInvariants, PlanarRibbon, RibbonLayout, RibbonNetwork,
    RibbonStream, SampledCurve, Sensor, SensorKind, SpatialRibbon, TangentMethod, ThirdDerivative,
    WorldFields, barycentric_gradients, degree7_boundaries, inclinations,
    inclinations_past_vertical, quintic_end_invariants, quintic_weights,
};

const NUMBERS: [f64; 14] = [
    0.0,
    1.0,
    -1.0,
    0.5,
    3.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    -1e300,
    1e150,
    1e-150,
    f64::MIN_POSITIVE,
    5e-324,
];

const ENDS: [EndCondition; 2] = [EndCondition::Natural, EndCondition::NotAKnot];

/// One number of a list replaced by each of the hostile ones.
fn spoilt(list: &[f64]) -> impl Iterator<Item = Vec<f64>> + '_ {
    (0..list.len()).flat_map(move |place| {
        NUMBERS.map(move |number| {
            let mut list = list.to_vec();
            list[place] = number;
            list
        })
    })
}

const LENGTHS: [f64; 5] = [0.0, 0.4, 1.0, 1.5, 2.0];
const ANGLES: [f64; 5] = [0.1, 0.5, 0.9, 0.7, 0.2];

fn directions(angles: &[f64]) -> Vec<DVec3> {
    angles
        .iter()
        .map(|a| dvec3(a.cos(), a.sin(), 0.4))
        .collect()
}

#[test]
fn planar_ribbons_are_finite_or_refused() {
    let cases = spoilt(&LENGTHS)
        .map(|s| (s, ANGLES.to_vec()))
        .chain(spoilt(&ANGLES).map(|angles| (LENGTHS.to_vec(), angles)));
    for (s, angles) in cases {
        for end in ENDS {
            if let Ok(ribbon) = PlanarRibbon::new(&s, &angles, end) {
                assert!(
                    ribbon.points().iter().all(|p| p.is_finite()),
                    "{s:?} {angles:?}"
                );
                for at in NUMBERS {
                    assert!(
                        ribbon.point(at).is_ok_and(|p| p.is_finite()) || ribbon.point(at).is_err()
                    );
                }
                assert!(ribbon.covariance(0.01).iter().all(|c| c.is_finite()));
            }
            for accuracy in NUMBERS {
                if let Ok(ribbon) = PlanarRibbon::with_accuracy(&s, &angles, end, accuracy) {
                    assert!(ribbon.points().iter().all(|p| p.is_finite()));
                }
            }
            if let Ok(spline) = CubicSpline::new(&s, &angles, end) {
                assert!(spline.value(0.7).is_finite(), "{s:?} {angles:?}");
            }
        }
        for length in NUMBERS {
            if let Ok(ribbon) = ClosedPlanarRibbon::new(&s, &angles, length) {
                assert!(
                    ribbon.points().iter().all(|p| p.is_finite()),
                    "{s:?} {angles:?}"
                );
            }
        }
        let _ = (inclinations(&angles), inclinations_past_vertical(&angles));
    }
    for (s, angles) in [(&[][..], &[][..]), (&[1.0], &[1.0]), (&[0.0, 1.0], &[1.0])] {
        assert!(PlanarRibbon::new(s, angles, EndCondition::Natural).is_err());
        assert!(CubicSpline::new(s, angles, EndCondition::Natural).is_err());
        assert!(ClosedPlanarRibbon::new(s, angles, 2.0).is_err());
    }
}

#[test]
fn spatial_ribbons_are_finite_or_refused() {
    let good = directions(&ANGLES);
    let uniform = [0.0, 0.5, 1.0, 1.5, 2.0];
    let check = |s: &[f64], tangents: &[DVec3]| {
        for method in [TangentMethod::Projected, TangentMethod::SphericalSpline] {
            for end in ENDS {
                let Ok(ribbon) = SpatialRibbon::with_method(s, tangents, method, end) else {
                    continue;
                };
                assert!(
                    ribbon.points().iter().all(|p| p.is_finite()),
                    "{s:?} {tangents:?}"
                );
                for at in NUMBERS {
                    let point = ribbon.point(at);
                    assert!(point.is_err() || point.is_ok_and(|p| p.is_finite()));
                    let _ = (ribbon.tangent(at), ribbon.curvature_vector(at));
                }
            }
        }
        for length in [f64::NAN, -1.0, 2.5, 1e300] {
            if let Ok(ribbon) = ClosedSpatialRibbon::new(s, tangents, length) {
                assert!(ribbon.points().iter().all(|p| p.is_finite()));
            }
        }
    };
    for s in spoilt(&uniform) {
        check(&s, &good);
    }
    for place in 0..5 {
        for number in NUMBERS {
            for vector in [
                DVec3::splat(number),
                dvec3(number, 0.0, 0.0),
                dvec3(1.0, number, -1.0),
            ] {
                let mut tangents = good.clone();
                tangents[place] = vector;
                check(&uniform, &tangents);
            }
        }
    }
    assert!(
        SpatialRibbon::new(&[], &[]).is_err() && SpatialRibbon::new(&[1.0], &good[..1]).is_err()
    );
    assert!(SpatialRibbon::new(&uniform, &good[..3]).is_err());
}

#[test]
fn sensors_are_finite_or_refused() {
    let world = WorldFields::with_dip(0.8).unwrap();
    for number in NUMBERS {
        for vector in [DVec3::splat(number), dvec3(0.0, number, 0.0)] {
            let _ = (
                WorldFields::new(vector, DVec3::Y),
                WorldFields::new(DVec3::Z, vector),
            );
        }
        let _ = WorldFields::with_dip(number);
    }
    let layout = |s: &[f64]| {
        let kinds = [SensorKind::Accelerometer, SensorKind::Magnetometer];
        let sensors = s
            .iter()
            .enumerate()
            .map(|(i, &s)| Sensor::new(s, kinds[i % 2]));
        RibbonLayout::new(sensors, world)
    };
    let s: Vec<f64> = (0..8).map(|i| 0.1 * f64::from(i)).collect();
    for s in spoilt(&s) {
        let _ = layout(&s);
    }
    assert!(layout(&[]).is_err() && layout(&s[..3]).is_err());
    let readings: Vec<DVec3> = (0..8)
        .map(|i| {
            if i % 2 == 0 {
                world.up()
            } else {
                world.magnetic()
            }
        })
        .collect();
    let layout = layout(&s).unwrap();
    let mut stream = RibbonStream::new(layout.clone()).unwrap();
    for place in 0..8 {
        for number in NUMBERS {
            for vector in [DVec3::splat(number), dvec3(number, 0.1, 0.3)] {
                let mut readings = readings.clone();
                readings[place] = vector;
                let whole = layout.tangents(&readings);
                if let Ok(tangents) = &whole {
                    assert!(
                        tangents.values().iter().all(|t| t.is_finite()),
                        "{readings:?}"
                    );
                }
                if let Ok(points) = stream.frame(&readings) {
                    assert!(points.iter().all(|p| p.is_finite()), "{readings:?}");
                }
            }
        }
    }
    assert!(layout.tangents(&readings[..5]).is_err() && stream.frame(&[]).is_err());
    assert!(
        stream.frame(&readings).is_ok(),
        "a bad frame spoils the next one"
    );
}

#[test]
fn networks_of_bad_crossings_are_refused() {
    let ribbon = || SpatialRibbon::new(&LENGTHS, &directions(&ANGLES)).unwrap();
    assert!(RibbonNetwork::new(Vec::new(), Vec::new()).is_err());
    assert!(RibbonNetwork::new(vec![ribbon(), ribbon()], Vec::new()).is_err());
    for number in NUMBERS {
        for ribbons in [[0, 1], [1, 1], [0, 7]] {
            let crossing = Crossing {
                ribbons,
                s: [number, 1.0],
            };
            if let Ok(network) = RibbonNetwork::new(vec![ribbon(), ribbon()], vec![crossing]) {
                assert!(network.origins().iter().all(|p| p.is_finite()));
                assert!(network.gap().is_finite());
                let _ = (
                    network.corner(0),
                    network.corner(9),
                    network.point(5, number),
                );
            }
        }
    }
}

#[test]
fn corner_data_and_curves_are_finite_or_refused() {
    for number in NUMBERS {
        for vector in [
            DVec3::splat(number),
            dvec3(number, 1.0, 0.0),
            dvec3(0.0, 0.0, number),
        ] {
            let tangents = [DVec3::X, DVec3::Y];
            let results = [
                CornerData::new(vector, DVec3::Z, tangents, [0.3, 0.4]),
                CornerData::new(DVec3::ZERO, vector, tangents, [0.3, 0.4]),
                CornerData::new(DVec3::ZERO, DVec3::Z, [vector, DVec3::Y], [0.3, 0.4]),
                CornerData::new(DVec3::ZERO, DVec3::Z, tangents, [number, 0.4]),
            ];
            for corner in results.into_iter().flatten() {
                assert!(
                    corner.torsions().iter().all(|t| t.is_finite()),
                    "{corner:?}"
                );
                let good = |p: DVec3| CornerData::new(p, DVec3::Z, tangents, [0.3, 0.4]).unwrap();
                let corners = [
                    [corner, good(DVec3::Y)],
                    [good(DVec3::X), good(dvec3(1.0, 1.0, 0.0))],
                ];
                for speed in [None, Some(number)] {
                    let shape = Degree7Shape {
                        speed,
                        speed_derivative: number,
                        third_derivative: ThirdDerivative::Given([number, 0.0]),
                    };
                    if let Ok(curves) = degree7_boundaries(&corners, &shape) {
                        let points = curves.iter().flat_map(|curve| curve.control());
                        assert!(points.into_iter().all(|h| h.weighted.is_finite()));
                    }
                }
            }
            let points: Vec<DVec3> = (0..12)
                .map(|i| {
                    if i == 4 {
                        vector
                    } else {
                        dvec3(f64::from(i), (f64::from(i) * 0.4).sin(), 0.2)
                    }
                })
                .collect();
            if let Ok(curve) = SampledCurve::fit(&points, 5) {
                assert!(curve.residual().is_finite(), "{vector}");
                let _ = curve.strip(4);
            }
            let control: Vec<MassPoint<DVec3>> =
                [DVec3::ZERO, vector, dvec3(2.0, 1.0, 0.0), DVec3::X]
                    .map(|p| MassPoint::point(p, 1.0))
                    .to_vec();
            let _ = BezierCurve::new(control).map(BezierStrip::new);
            let mut six: [DVec3; 6] =
                from_fn(|i| dvec3(i as f64, (i * i) as f64 * 0.2, (i * i * i) as f64 * 0.05));
            six[2] = vector;
            if let Ok(ends) = quintic_end_invariants(&six, &[1.0; 6]) {
                assert!(
                    ends.iter()
                        .all(|end| end.curvature.is_finite() && end.torsion.is_finite()),
                    "{six:?}"
                );
            }
            let end = EndInvariants {
                curvature: number,
                torsion: 0.3,
            };
            if let Ok(weights) = quintic_weights(&six, [end, end]) {
                assert!(
                    weights.iter().all(|w| w.is_finite() && *w > 0.0),
                    "{six:?} {number}"
                );
            }
        }
        for place in [DVec2::splat(number), dvec2(number, 0.0)] {
            if let Ok(gradients) = barycentric_gradients([DVec2::ZERO, DVec2::X, place]) {
                assert!(gradients.iter().all(|g| g.is_finite()), "{place}");
            }
        }
    }
}
