use super::*;
use crate::spatial::outer;
use crate::testing::Noise;

/// A strip with a known frame along the curve of the spatial tests.
fn frame(s: f64) -> DMat3 {
    let x = DVec3::new((0.9 * s).cos(), (0.9 * s).sin(), 0.3 * (1.1 * s).sin()).normalize();
    let y = DVec3::new(-0.2 * s, 0.4, 1.0).cross(x).normalize();
    DMat3::from_cols(x, y, x.cross(y))
}

fn layout(n: usize, length: f64, second: SensorKind) -> RibbonLayout {
    let kind = |i: usize| {
        if i.is_multiple_of(2) {
            SensorKind::Accelerometer
        } else {
            second
        }
    };
    let sensor = |i: usize| Sensor::new(length * i as f64 / n as f64, kind(i));
    RibbonLayout::new((0..=n).map(sensor), WorldFields::with_dip(1.08).unwrap()).unwrap()
}

fn readings(layout: &RibbonLayout) -> Vec<DVec3> {
    let field = |sensor: &Sensor| {
        if sensor.is_magnetometer() {
            layout.world.magnetic()
        } else {
            layout.world.up()
        }
    };
    layout
        .sensors
        .iter()
        .map(|sensor| frame(sensor.s).transpose() * field(sensor))
        .collect()
}

fn error(layout: &RibbonLayout) -> f64 {
    let tangents = layout.tangents(&readings(layout)).unwrap();
    let pairs = tangents.s.iter().zip(&tangents.values);
    pairs
        .map(|(s, t)| (frame(*s).x_axis - *t).length())
        .fold(0.0, f64::max)
}

#[test]
fn alternating_sensors_converge_with_order_above_three_and_a_half() {
    let errors = [64, 128].map(|n| error(&layout(n, 4.0, SensorKind::Magnetometer)));
    assert!((errors[0] / errors[1]).log2() > 3.5, "{errors:?}");
    // The two-axis device carries the same information while gravity has a normal component.
    let two = [64, 128].map(|n| error(&layout(n, 1.0, SensorKind::MagnetometerTwoAxis)));
    assert!((two[0] / two[1]).log2() > 3.5, "{two:?}");
}

#[test]
fn both_kinds_at_each_place_are_exact() {
    let world = WorldFields::with_dip(1.08).unwrap();
    let kinds = [SensorKind::Accelerometer, SensorKind::Magnetometer];
    let sensors = (0..8).flat_map(|i| kinds.map(|kind| Sensor::new(0.5 * f64::from(i), kind)));
    let layout = RibbonLayout::new(sensors, world).unwrap();
    assert!(error(&layout) < 1e-14);
    assert_eq!(layout.arc_lengths().len(), 8);
}

#[test]
fn covariance_from_readings_agrees_with_simulation() {
    let layout = layout(16, 0.8, SensorKind::Magnetometer);
    let exact = readings(&layout);
    let sigma = 0.005;
    let tangents = layout.tangents(&exact).unwrap();
    let ribbon = tangents.ribbon().unwrap();
    let predicted = tangents.position_covariance(&ribbon, sigma).unwrap()[16];
    let mut noise = Noise::new(21);
    let runs = 2000;
    let mut measured = DMat3::ZERO;
    for _ in 0..runs {
        let noisy: Vec<DVec3> = exact
            .iter()
            .map(|r| *r + noise.gaussian_vector() * sigma)
            .collect();
        let end =
            layout.tangents(&noisy).unwrap().ribbon().unwrap().points()[16] - ribbon.points()[16];
        measured += outer(end, end) * (1.0 / f64::from(runs));
    }
    let trace = |m: DMat3| m.x_axis.x + m.y_axis.y + m.z_axis.z;
    // 2,000 draws: relative standard error of a variance 3.2 %; four of them.
    assert!(
        (trace(measured) / trace(predicted) - 1.0).abs() < 0.13,
        "{measured} {predicted}"
    );
}

#[test]
fn impossible_readings_are_named() {
    use crate::sensor::{Calibration, ReadingFault};
    let layout = layout(8, 1.0, SensorKind::Magnetometer);
    let good = readings(&layout);
    let with = |index: usize, value: DVec3| {
        let mut bad = good.clone();
        bad[index] = value;
        layout.tangents(&bad)
    };
    assert!(matches!(
        with(3, DVec3::NAN),
        Err(Error::Reading {
            sensor: 3,
            fault: ReadingFault::NonFinite
        })
    ));
    assert!(matches!(
        with(4, DVec3::ZERO),
        Err(Error::Reading {
            sensor: 4,
            fault: ReadingFault::FieldLost { .. }
        })
    ));
    assert!(matches!(
        layout.tangents(&good[1..]),
        Err(Error::LengthMismatch { .. })
    ));
    let mut sensors = layout.sensors().to_vec();
    let limit = Calibration::new(DVec3::ZERO, DVec3::ONE, DMat3::IDENTITY, 0.5, 1.0).unwrap();
    sensors[0] = sensors[0].with_calibration(limit);
    let limited = RibbonLayout::new(sensors, layout.world).unwrap();
    let fault = limited.tangents(&good);
    assert!(
        matches!(
            fault,
            Err(Error::Reading {
                sensor: 0,
                fault: ReadingFault::Saturated { .. }
            })
        ),
        "{fault:?}"
    );
    let same = vec![DVec3::Z; 9];
    assert!(matches!(
        layout.tangents(&same),
        Err(Error::ParallelFields { .. })
    ));
    let few = (0..5).map(|i| Sensor::new(f64::from(i), SensorKind::Accelerometer));
    assert!(matches!(
        RibbonLayout::new(few, layout.world),
        Err(Error::TooFew { .. })
    ));
}

/// A field that is gone, too weak or too strong is noticed without the third axis, on a flat and on an upright ribbon.
#[test]
fn a_lost_field_is_noticed_with_two_axes() {
    let layout = layout(16, 0.8, SensorKind::MagnetometerTwoAxis);
    let flat = |s: f64| {
        let x = DVec3::new((0.9 * s).cos(), (0.9 * s).sin(), 0.1 * s).normalize();
        let y = DVec3::Z.cross(x).normalize();
        DMat3::from_cols(x, y, x.cross(y))
    };
    let upright = |s: f64| {
        let x = DVec3::new(0.4 * s, (1.0 - 0.16 * s * s).sqrt(), 0.0);
        DMat3::from_cols(x, DVec3::Z, x.cross(DVec3::Z))
    };
    let frames: [&dyn Fn(f64) -> DMat3; 2] = [&flat, &upright];
    for frame in frames {
        let read = |factor: f64| -> Vec<DVec3> {
            let field = |sensor: &Sensor| {
                if sensor.is_magnetometer() {
                    layout.world.magnetic() * factor
                } else {
                    layout.world.up()
                }
            };
            let sensors = layout.sensors.iter();
            sensors
                .map(|sensor| frame(sensor.s).transpose() * field(sensor))
                .collect()
        };
        for factor in [0.8, 1.0, 1.2] {
            assert!(layout.tangents(&read(factor)).is_ok(), "{factor}");
        }
        for factor in [0.0, 0.1, 3.0] {
            assert!(
                matches!(
                    layout.tangents(&read(factor)),
                    Err(Error::Reading {
                        sensor: 1,
                        fault: ReadingFault::FieldLost { .. }
                    })
                ),
                "{factor}"
            );
        }
    }
}

#[test]
fn a_misplaced_sensor_is_counted_among_all() {
    let kinds = [SensorKind::Accelerometer, SensorKind::Magnetometer];
    let place = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.05];
    let sensors = (0..8).map(|i| Sensor::new(place[i], kinds[i % 2]));
    assert!(matches!(
        RibbonLayout::new(sensors, WorldFields::with_dip(1.08).unwrap()),
        Err(Error::NotIncreasing { index: 7, .. })
    ));
}
