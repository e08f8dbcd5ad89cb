//! How the cost of arrivals grows with the receivers and with the layers.
//!
//! `cargo bench -p wavefront --bench receivers`

use std::f64::consts::TAU;

use divan::{Bencher, black_box};
use glam::{DVec2, dvec2};
use wavefront::{Code, Fan, FanOptions, Interface, Medium, Mode, Model, Source, Step, glam};

fn main() {
    divan::main();
}

/// The unit square with media of growing speed between evenly spaced waves, which may be flat.
fn layers(count: u32, height: f64) -> Model {
    let interface = |k: u32| {
        let level = 1.0 - f64::from(k + 1) / f64::from(count);
        if height == 0.0 {
            return Interface::horizontal(level);
        }
        Interface::graph(-0.5, 1.5, 160, move |x| {
            let (sin, cos) = (TAU * x).sin_cos();
            [
                level + height * sin,
                height * TAU * cos,
                -height * TAU * TAU * sin,
            ]
        })
    };
    let media = (0..count).map(|k| Medium::isotropic(1.0 + f64::from(k) / f64::from(count - 1)));
    Model::try_new(
        DVec2::ZERO,
        DVec2::ONE,
        media.collect::<Result<_, _>>().unwrap(),
        (0..count - 1)
            .map(interface)
            .collect::<Result<_, _>>()
            .unwrap(),
    )
    .unwrap()
}

/// The wave that passes all interfaces.
fn fan(model: &Model) -> Fan<'_> {
    let steps = (0..model.interfaces().len())
        .map(|interface| Step {
            interface,
            mode: Mode::Transmit,
        })
        .collect();
    let source = Source::point(dvec2(0.3, 0.97));
    Fan::new(model, source, Code { steps }, FanOptions::default()).unwrap()
}

/// Receivers scattered below a height.
fn receivers(count: usize, height: f64) -> Vec<DVec2> {
    (0..count)
        .map(|i| {
            let share = |step: f64| (step * i as f64).fract();
            dvec2(share(0.754_877_666), height * share(0.569_840_291))
        })
        .collect()
}

/// Tracing the rays alone, over the number of layers.
#[divan::bench(args = [2, 3, 5, 9])]
fn fan_of_wavy_layers(bencher: Bencher<'_, '_>, count: u32) {
    let model = layers(count, 0.02);
    bencher.bench(|| black_box(fan(&model)).ray_count());
}

/// Rays and all arrivals below a flat interface.
#[divan::bench(args = [100, 1000, 10_000, 100_000])]
fn below_a_line(bencher: Bencher<'_, '_>, count: usize) {
    arrivals(bencher, 2, 0.0, count);
}

/// Rays and all arrivals below a sinusoidal interface.
#[divan::bench(args = [100, 1000, 10_000, 100_000])]
fn below_a_wave(bencher: Bencher<'_, '_>, count: usize) {
    arrivals(bencher, 2, 0.06, count);
}

/// Rays and all arrivals through five layers.
#[divan::bench(args = [100, 1000, 10_000])]
fn through_five_layers(bencher: Bencher<'_, '_>, count: usize) {
    arrivals(bencher, 5, 0.02, count);
}

fn arrivals(bencher: Bencher<'_, '_>, layer_count: u32, height: f64, count: usize) {
    let model = layers(layer_count, height);
    let places = receivers(count, 1.0 / f64::from(layer_count) - height - 0.01);
    bencher.bench(|| {
        let mut sum = 0.0;
        fan(&model).visit_arrivals(&places, |_, arrival| sum += arrival.time);
        sum
    });
}
