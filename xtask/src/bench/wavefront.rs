//! Arrivals at 10,000 scattered receivers in the two-layer models that grid solvers are measured on.

use std::f64::consts::TAU;
use std::hint::black_box;

use anyhow::{Result, ensure};
use glam::{DVec2, dvec2};
use serde_json::{Value, json};
use wavefront::{Code, Fan, FanOptions, Interface, Medium, Mode, Model, Source, Step};

use super::{Bench, Timer};

#[derive(clap::Args, Debug)]
pub(super) struct Wavefront {
    /// Number of receivers
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    receivers: u32,
}

/// The source, in the slow upper layer of the unit square.
const SOURCE: DVec2 = dvec2(0.3, 0.9);
/// Speeds above and below the interface.
const SPEEDS: [f64; 2] = [1.0, 2.0];
/// Times that differ by less belong to the same arrival.
const SAME: f64 = 1e-6;

/// Height, slope and second derivative of an interface.
type Jet = fn(f64) -> [f64; 3];

impl Bench for Wavefront {
    const NAME: &'static str = "wavefront";
    const ABOUT: &'static str = "All arrivals below a flat and a sinusoidal interface";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let flat: Jet = |_| [0.5, 0.0, 0.0];
        let sinusoidal: Jet = |x| {
            let (sin, cos) = (TAU * x).sin_cos();
            [0.5 + 0.06 * sin, 0.06 * TAU * cos, -0.06 * TAU * TAU * sin]
        };
        // So many pieces that the interface itself is right to 1e-12.
        let wavy = Interface::graph(-0.5, 1.5, 160, sinusoidal)?;
        let rows = [
            self.row(timer, "flat", Interface::horizontal(0.5)?, flat)?,
            self.row(timer, "sinusoidal", wavy, sinusoidal)?,
        ];
        Ok(json!({ "rows": rows }))
    }
}

impl Wavefront {
    /// The time to trace the fan and to answer all receivers, and the largest error of the arrivals.
    fn row(&self, timer: &Timer, name: &str, interface: Interface, jet: Jet) -> Result<Value> {
        let media = SPEEDS.map(Medium::isotropic).into_iter();
        let media = media.collect::<Result<Vec<_>, _>>()?;
        let model = Model::try_new(DVec2::ZERO, DVec2::ONE, media, vec![interface])?;
        let down = Step {
            interface: 0,
            mode: Mode::Transmit,
        };
        let places = self.places(jet);
        let fan = || {
            let code = Code { steps: vec![down] };
            Fan::new(&model, Source::point(SOURCE), code, FanOptions::default())
        };
        let mut times = vec![Vec::new(); places.len()];
        fan()?.visit_arrivals(&places, |receiver, arrival| {
            times[receiver].push(arrival.time);
        });
        let arrivals: usize = times.iter().map(Vec::len).sum();
        ensure!(arrivals > 0, "no receiver of the {name} model is reached");
        // The independent solution costs far more than ours: every tenth receiver.
        let (mut largest, mut missed) = (0.0_f64, 0);
        for (place, times) in places.iter().zip(&times).step_by(10) {
            for exact in snell(*place, jet) {
                let errors = times.iter().map(|time| (time - exact).abs());
                let error = errors.fold(f64::INFINITY, f64::min);
                if error < SAME {
                    largest = largest.max(error);
                } else {
                    missed += 1;
                }
            }
        }
        let mut firsts = vec![f64::INFINITY; places.len()];
        let seconds = 1e-9
            * timer.nanoseconds(|| {
                firsts.fill(f64::INFINITY);
                let Ok(fan) = fan() else { return 0.0 };
                fan.visit_arrivals(&places, |receiver, arrival| {
                    firsts[receiver] = firsts[receiver].min(arrival.time);
                });
                black_box(firsts[0])
            });
        Ok(json!({
            "model": name, "receivers": places.len(), "seconds": seconds, "max_error": largest,
            "arrivals": arrivals, "missed": missed,
        }))
    }

    /// Receivers scattered evenly below the interface: a lattice of two irrational steps.
    fn places(&self, jet: Jet) -> Vec<DVec2> {
        (0..self.receivers)
            .map(|i| {
                let x = (0.754_877_666 * f64::from(i)).fract();
                let depth = (0.569_840_291 * f64::from(i)).fract();
                dvec2(x, depth * (jet(x)[0] - 0.02))
            })
            .collect()
    }
}

/// The times of all crossings at which Snell's law holds, by sign changes and bisection along the interface.
fn snell(receiver: DVec2, jet: Jet) -> Vec<f64> {
    const GRID: u32 = 1000;
    let cross = |x: f64| dvec2(x, jet(x)[0]);
    let excess = |x: f64| {
        let tangent = dvec2(1.0, jet(x)[1]);
        let (down, on) = (cross(x) - SOURCE, receiver - cross(x));
        tangent.dot(down) / (down.length() * SPEEDS[0])
            - tangent.dot(on) / (on.length() * SPEEDS[1])
    };
    let time =
        |x: f64| cross(x).distance(SOURCE) / SPEEDS[0] + receiver.distance(cross(x)) / SPEEDS[1];
    let place = |i: u32| f64::from(i) / f64::from(GRID);
    // The way from the source stays above the interface, the way to the receiver below it.
    let is_free = |x: f64| {
        (1..100).map(|i| f64::from(i) / 100.0).all(|share| {
            let (above, below) = (SOURCE.lerp(cross(x), share), receiver.lerp(cross(x), share));
            above.y > jet(above.x)[0] && below.y < jet(below.x)[0]
        })
    };
    (0..GRID)
        .map(|i| [place(i), place(i + 1)])
        .filter(|&[low, high]| (excess(low) < 0.0) != (excess(high) < 0.0))
        .map(|[mut low, mut high]| {
            let falls = excess(low) < 0.0;
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if (excess(middle) < 0.0) == falls {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            0.5 * (low + high)
        })
        .filter(|x| is_free(*x))
        .map(time)
        .collect()
}
