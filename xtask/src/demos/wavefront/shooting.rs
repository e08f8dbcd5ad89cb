//! Arrivals by shooting rays: what follows knows nothing of the crate's rays, it is there to check them.

use std::f64::consts::TAU;

use glam::{DVec2, dvec2};
use wavefront::{Code, Fan, Mode};

use super::survey::Survey;

/// How the arrivals compare with those found by shooting.
pub(super) struct Comparison {
    pub(super) largest: f64,
    pub(super) missed: usize,
    pub(super) compared: usize,
}

impl Survey {
    /// The first place where a ray leaves a layer: the interface and the travel along `direction`, scanned and bisected.
    fn exit(
        &self,
        from: DVec2,
        direction: DVec2,
        layer: usize,
        reach: f64,
    ) -> Option<(usize, f64)> {
        const STEPS: u32 = 160;
        let bounds = [
            layer.checked_sub(1),
            (layer < self.graphs.len()).then_some(layer),
        ];
        let sides = bounds.into_iter().flatten().map(|interface| {
            // Below the upper boundary, above the lower one: positive inside.
            let sign = if interface == layer { 1.0 } else { -1.0 };
            let inside = move |s: f64| {
                let p = from + s * direction;
                sign * (p.y - self.graphs[interface].at(p.x).0)
            };
            let place = |i: u32| reach * (f64::from(i) + 1e-6) / f64::from(STEPS);
            let i = (0..STEPS).find(|&i| inside(place(i)) > 0.0 && inside(place(i + 1)) <= 0.0)?;
            let (mut low, mut high) = (place(i), place(i + 1));
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if inside(middle) > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
            }
            Some((interface, 0.5 * (low + high)))
        });
        sides.flatten().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The slowness of the wave with a front normal, and the direction of its ray.
    fn wave(&self, layer: usize, slowness: DVec2) -> (DVec2, DVec2) {
        let map = self.indicatrices[layer];
        (slowness, map * (map.transpose() * slowness))
    }

    /// Shoots a ray through a code to the receivers' line: where it lands, and when.
    fn shoot(&self, code: &Code, angle: f64) -> Option<(f64, f64)> {
        let reach = 2.0 * self.model.size();
        let normal = DVec2::from_angle(angle);
        let start = normal / (self.indicatrices[self.layer].transpose() * normal).length();
        let (mut point, mut layer, mut time) = (self.source, self.layer, 0.0);
        let (mut slowness, mut velocity) = self.wave(layer, start);
        for step in &code.steps {
            let direction = velocity.normalize();
            let (interface, along) = self.exit(point, direction, layer, reach)?;
            if interface != step.interface {
                return None;
            }
            point += along * direction;
            time += along / velocity.length();
            let tangent = dvec2(1.0, self.graphs[interface].at(point.x).1).normalize();
            let below = if layer == interface {
                interface + 1
            } else {
                interface
            };
            if step.mode == Mode::Transmit {
                layer = below;
            }
            // |map^T (tau t + nu n)| = 1 for the component nu, on the side where the wave continues.
            let map = self.indicatrices[layer].transpose();
            let (u, v) = (
                slowness.dot(tangent) * (map * tangent),
                map * tangent.perp(),
            );
            let (a, b, c) = (v.length_squared(), u.dot(v), u.length_squared() - 1.0);
            let root = (b * b - a * c).sqrt();
            // The ray's component along n is a nu + b; upwards in the layer above the interface, downwards below it.
            let side = if layer == interface { 1.0 } else { -1.0 };
            let nu = (side * root - b) / a;
            if nu.is_nan() {
                return None;
            }
            (slowness, velocity) =
                self.wave(layer, slowness.dot(tangent) * tangent + nu * tangent.perp());
        }
        let travel = (self.receivers[0].y - point.y) / velocity.y;
        let reaches = travel > 0.0
            && self
                .exit(point, velocity.normalize(), layer, reach)
                .is_none_or(|(_, along)| along > travel * velocity.length());
        reaches.then_some((point.x + travel * velocity.x, time + travel))
    }

    /// Arrivals by shooting: `angles` rays, and bisection wherever two neighbours land on different sides of the receiver.
    pub(super) fn check_arrivals(
        &self,
        fans: &[Fan<'_>],
        receivers: usize,
        angles: u32,
    ) -> Comparison {
        let mut comparison = Comparison {
            largest: 0.0,
            missed: 0,
            compared: 0,
        };
        let angle = |i: u32| TAU * (f64::from(i) + 0.37) / f64::from(angles);
        for fan in fans {
            let landings: Vec<_> = (0..angles)
                .map(|i| self.shoot(fan.code(), angle(i)))
                .collect();
            for index in 0..receivers {
                let receiver = self.receiver((index as f64 + 0.5) / receivers as f64);
                let found: Vec<f64> = fan
                    .arrivals(receiver)
                    .iter()
                    .map(|arrival| arrival.time)
                    .collect();
                for i in 0..angles - 1 {
                    let (Some((left, _)), Some((right, _))) =
                        (landings[i as usize], landings[i as usize + 1])
                    else {
                        continue;
                    };
                    if (left < receiver.x) == (right < receiver.x) {
                        continue;
                    }
                    let Some(time) = self.bisect(fan.code(), [angle(i), angle(i + 1)], receiver.x)
                    else {
                        continue;
                    };
                    let error = found
                        .iter()
                        .map(|other| (other / time - 1.0).abs())
                        .fold(f64::INFINITY, f64::min);
                    comparison.compared += 1;
                    if error < 1e-6 {
                        comparison.largest = comparison.largest.max(error);
                    } else {
                        comparison.missed += 1;
                    }
                }
            }
        }
        comparison
    }

    /// The time of the ray between two angles that lands at `x`; none if the rays in between are torn apart.
    fn bisect(&self, code: &Code, [mut low, mut high]: [f64; 2], x: f64) -> Option<f64> {
        let before = self.shoot(code, low)?.0 < x;
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if (self.shoot(code, middle)?.0 < x) == before {
                low = middle
            } else {
                high = middle
            }
        }
        let (place, time) = self.shoot(code, 0.5 * (low + high))?;
        ((place - x).abs() < 1e-8 * self.model.size()).then_some(time)
    }
}
