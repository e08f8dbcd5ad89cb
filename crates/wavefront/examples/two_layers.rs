//! A slow layer over a fast one with a valley in between: all reflected arrivals at a line of receivers, and where the wave is
//! cut.
//!
//! `cargo run -p wavefront --example two_layers`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use wavefront::glam::dvec2;
use wavefront::{Code, Error, Fan, FanOptions, Interface, Medium, Mode, Model, Source, Step};

fn main() -> Result<(), Error> {
    // Metres and seconds; the valley is given by its height, slope and second derivative.
    let valley = Interface::graph(-3000.0, 3000.0, 120, |x: f64| {
        let (sine, cosine) = (x / 300.0).sin_cos();
        [-700.0 - 90.0 * cosine, 0.3 * sine, 0.3 / 300.0 * cosine]
    })?;
    let media = vec![Medium::isotropic(1500.0)?, Medium::isotropic(2400.0)?];
    let (low, high) = (dvec2(-2500.0, -2000.0), dvec2(2500.0, 100.0));
    let model = Model::try_new(low, high, media, vec![valley])?;

    for mode in [Mode::Reflect, Mode::Transmit] {
        let code = Code {
            steps: vec![Step { interface: 0, mode }],
        };
        let source = Source::point(dvec2(100.0, 0.0));
        let fan = Fan::new(&model, source, code, FanOptions::default())?;
        println!("{mode:?}: {} rays traced", fan.ray_count());
        for cut in fan.cuts() {
            println!(
                "  cut at ({:.0}, {:.0}): {}",
                cut.place.x, cut.place.y, cut.reason
            );
        }
        let depth = if mode == Mode::Reflect { 0.0 } else { -1500.0 };
        for x in [-800.0, -400.0, 0.0, 400.0, 800.0] {
            for arrival in fan.arrivals(dvec2(x, depth)) {
                println!(
                    "  receiver at {x:>5}: {:.6} s, amplitude {:.4}, {} caustics touched",
                    arrival.time,
                    arrival.amplitude(std::f64::consts::TAU),
                    arrival.caustics,
                );
            }
        }
    }
    Ok(())
}
