//! How long is a frame, how does it grow with the sensors, and does it allocate?

use divan::{AllocProfiler, Bencher, black_box};
use glam::{DMat3, DVec3};
use reconstruct::{RibbonLayout, RibbonStream, Sensor, SensorKind, WorldFields};

#[global_allocator]
static ALLOCATIONS: AllocProfiler = AllocProfiler::system();

fn main() {
    divan::main();
}

fn setup(sensors: usize) -> (RibbonLayout, Vec<DVec3>) {
    let world = WorldFields::with_dip(1.08).unwrap();
    let kind = |i: usize| {
        if i.is_multiple_of(2) {
            SensorKind::Accelerometer
        } else {
            SensorKind::Magnetometer
        }
    };
    let s = |i: usize| 4.0 * i as f64 / (sensors - 1) as f64;
    let layout =
        RibbonLayout::new((0..sensors).map(|i| Sensor::new(s(i), kind(i))), world).unwrap();
    let readings = (0..sensors).map(|i| {
        let x = DVec3::new(-0.6 * s(i).sin(), 0.6 * s(i).cos(), 0.8);
        let y = DVec3::Z.cross(x).normalize();
        let field = if i.is_multiple_of(2) {
            world.up()
        } else {
            world.magnetic()
        };
        DMat3::from_cols(x, y, x.cross(y)).transpose() * field
    });
    let readings = readings.collect();
    (layout, readings)
}

/// The streamed frame: no line "alloc" may appear below it.
#[divan::bench(args = [8, 32, 128, 512])]
fn streamed(bencher: Bencher<'_, '_>, sensors: usize) {
    let (layout, readings) = setup(sensors);
    let mut stream = RibbonStream::new(layout).unwrap();
    bencher.bench_local(|| {
        stream
            .frame(black_box(&readings))
            .map(|points| points[sensors - 1])
            .unwrap()
    });
}

/// The same with the covariance ready: cubic in the sensors.
#[divan::bench(args = [8, 32, 128])]
fn with_covariance(bencher: Bencher<'_, '_>, sensors: usize) {
    let (layout, readings) = setup(sensors);
    bencher.bench_local(|| {
        let tangents = layout.tangents(black_box(&readings)).unwrap();
        let ribbon = tangents.ribbon().unwrap();
        tangents.position_covariance(&ribbon, 0.005).unwrap()
    });
}
