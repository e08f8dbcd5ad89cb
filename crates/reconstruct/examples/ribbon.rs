//! One frame of an alternating sensor ribbon, from raw readings to positions with their uncertainty.
//!
//! `cargo run -p reconstruct --example ribbon`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use glam::{DMat3, DVec3};
use reconstruct::{Calibration, RibbonLayout, RibbonStream, Sensor, SensorKind, WorldFields};

fn main() -> Result<(), reconstruct::Error> {
    // 32 sensors 25 mm apart, accelerometers in m/s² and magnetometers in µT.
    let world = WorldFields::with_dip(62_f64.to_radians())?;
    let one = DVec3::ONE;
    let gravity = Calibration::new(DVec3::ZERO, one, DMat3::IDENTITY, 19.6, 9.81)?;
    let field = Calibration::new(
        DVec3::new(3.0, -1.0, 2.0),
        one,
        DMat3::IDENTITY,
        600.0,
        48.0,
    )?;
    let layout = RibbonLayout::new(
        (0..32).map(|i| {
            let s = 0.025 * f64::from(i);
            if i % 2 == 0 {
                Sensor::new(s, SensorKind::Accelerometer).with_calibration(gravity)
            } else {
                Sensor::new(s, SensorKind::Magnetometer).with_calibration(field)
            }
        }),
        world,
    )?;

    // What the sensors read when the ribbon is wound around a drum of radius 0.2 m with a pitch.
    let readings: Vec<DVec3> = layout
        .sensors()
        .iter()
        .map(|sensor| {
            let angle = 4.0 * sensor.s;
            let x = DVec3::new(-0.8 * angle.sin(), 0.8 * angle.cos(), 0.6);
            let z = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let body = DMat3::from_cols(x, z.cross(x), z).transpose();
            match sensor.kind {
                SensorKind::Accelerometer => body * world.up() * 9.81,
                _ => body * world.magnetic() * 48.0 + DVec3::new(3.0, -1.0, 2.0),
            }
        })
        .collect();

    let tangents = layout.tangents(&readings)?;
    let ribbon = tangents.ribbon()?;
    let covariance = tangents.position_covariance(&ribbon, 0.005)?;
    for i in [0, 8, 16, 24, 31] {
        let (s, p, c) = (ribbon.arc_lengths()[i], ribbon.points()[i], covariance[i]);
        let sigma = (c.x_axis.x + c.y_axis.y + c.z_axis.z).sqrt();
        println!(
            "s = {s:.3} m   position {p:.4}   sigma {:.2} mm",
            1e3 * sigma
        );
    }

    // Frame by frame, without allocating; an impossible reading is named and the last good shape kept.
    let mut stream = RibbonStream::new(layout)?;
    stream.frame(&readings)?;
    let mut broken = readings;
    broken[4] = DVec3::new(25.0, 0.0, 0.0);
    if let Err(error) = stream.frame(&broken) {
        println!("refused: {error}");
    }
    println!("still there: {} positions", stream.points().len());
    Ok(())
}
