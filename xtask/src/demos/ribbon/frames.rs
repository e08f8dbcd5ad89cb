//! The ribbon as an instrument: a curve from every frame of readings.

use std::time::Instant;

use anyhow::Result;
use glam::{DMat3, DVec3};
use reconstruct::{RibbonLayout, RibbonStream, Sensor, SensorKind, WorldFields};

use super::{LENGTH, tangent};
use crate::demo::Context;
use crate::report::Target;

/// Dip of the magnetic field below the horizontal in central Europe, in radians.
const DIP: f64 = 1.08;

/// The demonstrator's work: 32 alternating sensors, frame after frame.
pub(super) fn time(context: &mut Context) -> Result<()> {
    let (mut stream, readings) = alternating(32, LENGTH, tangent)?;
    let frames = context.pick(20_000, 2_000);
    let mut best = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        for _ in 0..frames / 5 {
            std::hint::black_box(stream.frame(std::hint::black_box(&readings))?);
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e6 / f64::from(frames / 5));
    }
    // The target is that of an optimised build; a development build and a busy machine get room.
    context.number(
        "frame_microseconds",
        best,
        Target::AtMost(if cfg!(debug_assertions) { 1000.0 } else { 50.0 }),
    );
    Ok(())
}

/// A ribbon of so many sensors at equal distances, alternately accelerometers and magnetometers, and what they read where
/// it lies along a curve with these unit tangents, its upper side level.
///
/// # Errors
/// As [`RibbonLayout::new`]: fewer than two sensors, or no length.
pub(crate) fn alternating(
    sensors: usize,
    length: f64,
    tangent: impl Fn(f64) -> DVec3,
) -> Result<(RibbonStream, Vec<DVec3>)> {
    let world = WorldFields::with_dip(DIP)?;
    let kind = |i: usize| {
        if i.is_multiple_of(2) {
            SensorKind::Accelerometer
        } else {
            SensorKind::Magnetometer
        }
    };
    let step = length / (sensors as f64 - 1.0);
    let layout = RibbonLayout::new(
        (0..sensors).map(|i| Sensor::new(i as f64 * step, kind(i))),
        world,
    )?;
    let reading = |sensor: &Sensor| {
        let x = tangent(sensor.s);
        let y = DVec3::Z.cross(x).normalize();
        let field = if sensor.kind == SensorKind::Accelerometer {
            world.up()
        } else {
            world.magnetic()
        };
        DMat3::from_cols(x, y, x.cross(y)).transpose() * field
    };
    let readings = layout.sensors().iter().map(reading).collect();
    Ok((RibbonStream::new(layout)?, readings))
}
