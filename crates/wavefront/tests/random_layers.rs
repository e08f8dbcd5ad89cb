//! Random layered models against brute-force ray shooting that shares no code with the crate.
//!
//! A thousand models in every run.

use std::f64::consts::TAU;

use wavefront::glam::{DMat2, DVec2, dvec2};
use wavefront::{Code, Fan, FanOptions, FrontTolerance, Interface, Medium, Mode, Model, Source};

/// Half the width of the models.
const HALF_WIDTH: f64 = 2.0;
/// Rays that are shot.
const RAYS: u32 = 300;
/// Times agree to this.
const SAME: f64 = 1e-6;

/// Numbers in `[0, 1)`, the same in every run.
struct Random(variation::sets::SplitMix64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        ((count as f64 * self.0.unit()) as usize).min(count - 1)
    }
}

/// A boundary `y = level + sum of a sin(k x + phase)`.
#[derive(Clone, Copy)]
struct Wave {
    level: f64,
    terms: [[f64; 3]; 2],
}

impl Wave {
    fn jet(&self, x: f64) -> [f64; 3] {
        self.terms
            .iter()
            .fold([self.level, 0.0, 0.0], |sum, [a, k, phase]| {
                let (sin, cos) = (k * x + phase).sin_cos();
                [
                    sum[0] + a * sin,
                    sum[1] + a * k * cos,
                    sum[2] - a * k * k * sin,
                ]
            })
    }
}

/// A model as formulas.
struct Layers {
    waves: Vec<Wave>,
    /// The maps from the unit circle to the indicatrices.
    indicatrices: Vec<DMat2>,
    low: DVec2,
    high: DVec2,
    source: DVec2,
}

/// A ray on its last leg.
#[derive(Clone, Copy)]
struct Leg {
    point: DVec2,
    velocity: DVec2,
    slowness: DVec2,
    time: f64,
    layer: usize,
}

impl Layers {
    fn random(random: &mut Random) -> (Self, Model) {
        let count = 2 + random.below(5);
        let spacing = 0.9;
        let flat = random.below(4) == 0;
        let waves: Vec<Wave> = (0..count - 1)
            .map(|i| {
                let mut term = |most: f64, slow: f64, fast: f64| {
                    let a = if flat { 0.0 } else { random.between(0.0, most) };
                    [a, random.between(slow, fast), random.between(0.0, TAU)]
                };
                Wave {
                    level: -spacing * (i as f64 + 1.0),
                    terms: [term(0.22, 0.5, 2.0), term(0.06, 2.0, 5.0)],
                }
            })
            .collect();
        let mut media = Vec::new();
        let mut indicatrices = Vec::new();
        for _ in 0..count {
            let a = random.between(1.0, 3.0);
            let (b, angle) = if random.below(3) == 0 {
                (a * random.between(0.7, 1.4), random.between(0.0, 3.0))
            } else {
                (a, 0.0)
            };
            media.push(Medium::elliptical(a, b, angle).unwrap());
            indicatrices.push(DMat2::from_angle(angle) * DMat2::from_diagonal(dvec2(a, b)));
        }
        let low = dvec2(-HALF_WIDTH, -spacing * count as f64);
        let high = dvec2(HALF_WIDTH, 0.3);
        let interfaces = waves.iter().map(|wave| {
            if flat {
                return Interface::horizontal(wave.level).unwrap();
            }
            Interface::graph(-2.5 * HALF_WIDTH, 2.5 * HALF_WIDTH, 200, |x| wave.jet(x)).unwrap()
        });
        let model = Model::try_new(low, high, media, interfaces.collect()).unwrap();
        let source = dvec2(random.between(-1.2, 1.2), random.between(-0.4, 0.2));
        let layers = Self {
            waves,
            indicatrices,
            low,
            high,
            source,
        };
        (layers, model)
    }

    /// The first place where a ray leaves its layer, scanned with so many steps and bisected: the boundary and the time.
    fn exit(&self, leg: &Leg, steps: u32) -> Option<(usize, f64)> {
        let reach = 1.2 * (self.high - self.low).length() / leg.velocity.length();
        let bounds = [leg.layer.checked_sub(1), Some(leg.layer)];
        let bounds = bounds
            .into_iter()
            .flatten()
            .filter(|i| *i < self.waves.len());
        let exits = bounds.filter_map(|boundary| {
            let sign = if boundary == leg.layer { 1.0 } else { -1.0 };
            let inside = |time: f64| {
                let p = leg.point + time * leg.velocity;
                sign * (p.y - self.waves[boundary].jet(p.x)[0])
            };
            let at = |i: u32| reach * (f64::from(i) / f64::from(steps)).max(1e-7);
            let i = (0..steps).find(|&i| inside(at(i + 1)) <= 0.0)?;
            let (mut low, mut high) = (at(i), at(i + 1));
            if inside(low) <= 0.0 {
                return Some((boundary, low));
            }
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if inside(middle) > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            Some((boundary, high))
        });
        exits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Shoots a ray through a code by the conservation of the slowness along each boundary.
    fn shoot(&self, code: &Code, angle: f64, steps: u32) -> Option<Leg> {
        let group = |layer: usize, slowness: DVec2| {
            let map = self.indicatrices[layer];
            map * (map.transpose() * slowness)
        };
        let normal = DVec2::from_angle(angle);
        let slowness = normal / (self.indicatrices[0].transpose() * normal).length();
        let mut leg = Leg {
            point: self.source,
            velocity: group(0, slowness),
            slowness,
            time: 0.0,
            layer: 0,
        };
        for step in &code.steps {
            let (boundary, time) = self.exit(&leg, steps)?;
            leg.point += time * leg.velocity;
            leg.time += time;
            if boundary != step.interface || leg.point.x.abs() > HALF_WIDTH {
                return None;
            }
            let tangent = dvec2(1.0, self.waves[boundary].jet(leg.point.x)[1]).normalize();
            if step.mode == Mode::Transmit {
                leg.layer = if leg.layer == boundary {
                    boundary + 1
                } else {
                    boundary
                };
            }
            let along = leg.slowness.dot(tangent);
            let map = self.indicatrices[leg.layer].transpose();
            let (u, v) = (along * (map * tangent), map * tangent.perp());
            let (a, b, c) = (v.length_squared(), u.dot(v), u.length_squared() - 1.0);
            let root = (b * b - a * c).sqrt();
            let up = if leg.layer == boundary { 1.0 } else { -1.0 };
            let across = (up * root - b) / a;
            if across.is_nan() {
                return None;
            }
            leg.slowness = along * tangent + across * tangent.perp();
            leg.velocity = group(leg.layer, leg.slowness);
        }
        Some(leg)
    }

    /// The time at which a leg passes a point and its distance, if nothing is in its way.
    fn passes(&self, leg: &Leg, point: DVec2, steps: u32) -> Option<(f64, f64)> {
        let speed = leg.velocity.length();
        let travel = leg.velocity.dot(point - leg.point) / (speed * speed);
        let free = self.exit(leg, steps).is_none_or(|(_, time)| time > travel);
        let distance = leg.velocity.perp_dot(point - leg.point) / speed;
        (travel > 0.0 && free).then(|| (leg.time + leg.slowness.dot(point - leg.point), distance))
    }

    /// All arrival times: where neighbouring rays pass on different sides of the point there is one between them.
    fn arrivals(&self, code: &Code, fan: &[Option<Leg>], point: DVec2) -> Vec<f64> {
        const STEPS: u32 = 120;
        let side = |leg: &Leg| leg.velocity.perp_dot(point - leg.point) / leg.velocity.length();
        let mut times = Vec::new();
        for (i, pair) in fan.windows(2).enumerate() {
            let [Some(one), Some(two)] = pair else {
                continue;
            };
            if (side(one) > 0.0) == (side(two) > 0.0) {
                continue;
            }
            let (mut low, mut high) = (angle(i), angle(i + 1));
            let mut found = None;
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                let Some(leg) = self.shoot(code, middle, STEPS) else {
                    found = None;
                    break;
                };
                if (side(&leg) > 0.0) == (side(one) > 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
                found = Some(middle);
            }
            // Once more with small steps, that no grazed boundary is passed over.
            let exact = found.and_then(|angle| self.shoot(code, angle, 20 * STEPS));
            let passed = exact.and_then(|leg| self.passes(&leg, point, 20 * STEPS));
            times.extend(
                passed
                    .filter(|(_, off)| off.abs() < 1e-7)
                    .map(|(time, _)| time),
            );
        }
        times
    }
}

fn angle(i: usize) -> f64 {
    TAU * (i as f64 + 0.37) / f64::from(RAYS)
}

/// What was found and what went wrong in some models.
#[derive(Default)]
struct Tally {
    compared: usize,
    several: usize,
    failures: Vec<String>,
}

fn check(models: std::ops::Range<u64>) -> Tally {
    let mut tally = Tally::default();
    for seed in models {
        let mut random = Random(variation::sets::SplitMix64::new(seed));
        let (layers, model) = Layers::random(&mut random);
        let codes = model.codes(0, 5);
        for _ in 0..3 {
            let code = &codes[random.below(codes.len())];
            let source = Source::point(layers.source);
            let fan = Fan::new(&model, source, code.clone(), FanOptions::default()).unwrap();
            let shot: Vec<_> = (0..RAYS as usize + 1)
                .map(|i| layers.shoot(code, angle(i), 120))
                .collect();
            let layer = fan.last_layer();
            // Above the wave below, under the one above.
            let x = random.between(-0.9, 0.9) * HALF_WIDTH;
            let height = |i: usize| layers.waves.get(i).map(|wave| wave.jet(x)[0]);
            let top = layer
                .checked_sub(1)
                .and_then(height)
                .unwrap_or(layers.high.y);
            let bottom = height(layer).unwrap_or(layers.low.y);
            let share = random.between(0.05, 0.95);
            let point = dvec2(x, bottom + share * (top - bottom));

            let found = fan.arrivals(point);
            let expected = layers.arrivals(code, &shot, point);
            tally.compared += expected.len();
            tally.several += usize::from(expected.len() > 1);
            for time in &expected {
                if !found
                    .iter()
                    .any(|arrival| (arrival.time / time - 1.0).abs() < SAME)
                {
                    let missed = format!("model {seed}: {time} is missing, {:?}", code.steps);
                    tally.failures.push(missed);
                }
            }
            for arrival in &found {
                let again = layers
                    .shoot(code, TAU * arrival.parameter, 4000)
                    .and_then(|leg| layers.passes(&leg, point, 4000));
                // Rays spread: the interfaces' interpolation, 1e-10, is magnified at each of them.
                let right = again.is_some_and(|(time, off)| {
                    off.abs() < 1e-4 && (arrival.time / time - 1.0).abs() < SAME
                });
                if !right {
                    let wrong = format!("model {seed}: no ray {arrival:?}, {again:?}");
                    tally.failures.push(wrong);
                }
            }
            // Fronts end somewhere, too, and stay within their tolerance.
            for front in fan.fronts(FrontTolerance::time(1e-5)).unwrap() {
                if front.pieces().len() > 400 {
                    let many = format!("model {seed}: {} arcs", front.pieces().len());
                    tally.failures.push(many);
                }
                if front.error() > 1e-5 {
                    tally
                        .failures
                        .push(format!("model {seed}: front {}", front.error()));
                }
            }
        }
    }
    tally
}

fn assert_right(tally: &Tally, at_least: usize) {
    assert!(tally.failures.is_empty(), "{}", tally.failures.join("\n"));
    assert!(tally.compared > at_least, "{} compared", tally.compared);
    assert!(
        tally.several > at_least / 100,
        "{} with several",
        tally.several
    );
}

#[test]
fn a_thousand_models_agree_with_shooting() {
    assert_right(&check(0..1000), 1000);
}
