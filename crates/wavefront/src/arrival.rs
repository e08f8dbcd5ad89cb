//! Arrivals: the rays of a fan that pass through given points.

use glam::DVec2;

use crate::fan::Run;
use crate::{Fan, Medium, Ray};

/// A wave's arrival at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arrival {
    /// The arrival time.
    pub time: f64,
    /// The source's parameter of the ray.
    pub parameter: f64,
    /// The ray on its last leg.
    pub ray: Ray,
    /// The width of the ray tube at the point, per unit of the source's parameter: the amplitude falls with its square root.
    pub tube_width: f64,
    /// Whether the ray has touched the caustic on its last leg.
    pub beyond_caustic: bool,
}

impl Arrival {
    /// The amplitude by ray-tube spreading, relative to that at unit distance from a point source of unit strength per
    /// radian, whose parameter covers `angles` radians. Infinite on a caustic, where ray theory ends.
    #[must_use]
    pub fn amplitude(&self, angles: f64) -> f64 {
        (angles.abs() / self.tube_width).sqrt()
    }
}

/// A ray counts as passing through a point at this share of the model's size: the time is stationary there, so that its own
/// error is the square of it.
const THROUGH: f64 = 1e-10;
/// Newton's method in a bracket, with a halving where it leaves or stalls.
const STEPS: usize = 60;

impl Fan<'_> {
    /// All arrivals at a point, by increasing time.
    ///
    /// Rays through the point are zeros of its signed distance from the rays along the fan; a pair of them between two
    /// sampled rays shows in the distance's slopes.
    #[must_use]
    pub fn arrivals(&self, point: DVec2) -> Vec<Arrival> {
        let mut found = Vec::new();
        self.visit_arrivals(point, |arrival| found.push(arrival));
        found.sort_by(|a, b| a.time.total_cmp(&b.time));
        found
    }

    /// The first arrival at a point.
    #[must_use]
    pub fn first_arrival(&self, point: DVec2) -> Option<Arrival> {
        let mut first: Option<Arrival> = None;
        self.visit_arrivals(point, |arrival| {
            if first.is_none_or(|known| arrival.time < known.time) {
                first = Some(arrival);
            }
        });
        first
    }

    fn visit_arrivals(&self, point: DVec2, mut found: impl FnMut(Arrival)) {
        if !point.is_finite() {
            return;
        }
        let layer = self.last_layer();
        let left = self.code().steps.last().map(|step| step.interface);
        let medium = &self.model().media()[layer];
        for run in self.runs() {
            for i in 0..run.sides.len().saturating_sub(1) {
                let (low, high) = (run.sides[i].value(point), run.sides[i + 1].value(point));
                let crosses = (low <= 0.0) != (high <= 0.0);
                // The same side, and both ends lead towards zero: there may be two rays in between.
                let may_touch = !crosses
                    && low * run.sides[i].slope(point) < 0.0
                    && high * run.sides[i + 1].slope(point) > 0.0;
                let brackets = match (crosses, may_touch) {
                    (true, _) => [Some([run.parameters[i], run.parameters[i + 1]]), None],
                    (_, true) => self.split_at_extremum(run, i, point),
                    _ => continue,
                };
                for bracket in brackets.into_iter().flatten() {
                    let Some((parameter, ray)) = self.refine(run, i, bracket, point) else {
                        continue;
                    };
                    if self.model().reaches(&ray, layer, left, point) {
                        found(arrival(parameter, ray, medium, point));
                    }
                }
            }
        }
    }

    /// The two brackets around a pair of zeros between two samples, if the distance changes sign at all.
    fn split_at_extremum(&self, run: &Run, i: usize, point: DVec2) -> [Option<[f64; 2]>; 2] {
        let (start, end) = (run.parameters[i], run.parameters[i + 1]);
        let (mut low, mut high) = (start, end);
        let sign = run.sides[i].value(point).signum();
        // The slope cannot lead to zero from this far.
        let reach = (end - start)
            * run.sides[i]
                .slope(point)
                .abs()
                .max(run.sides[i + 1].slope(point).abs());
        if run.sides[i].value(point).abs() > reach {
            return [None, None];
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (low + high);
            let Some(ray) = self.ray_near(middle, &run.traces[i]) else {
                return [None, None];
            };
            let form = self.side_form(&ray);
            if form.value(point) * sign <= 0.0 {
                return [Some([start, middle]), Some([middle, end])];
            }
            if form.slope(point) * sign < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
            if high - low <= f64::EPSILON {
                break;
            }
        }
        [None, None]
    }

    /// The ray through the point inside a bracket.
    fn refine(
        &self,
        run: &Run,
        i: usize,
        [start, end]: [f64; 2],
        point: DVec2,
    ) -> Option<(f64, Ray)> {
        let neighbour = &run.traces[i];
        let through = THROUGH * self.model().size();
        let value_at = |parameter: f64| {
            let ray = self.ray_near(parameter, neighbour)?;
            let form = self.side_form(&ray);
            Some((form.value(point), form.slope(point), ray))
        };
        let (mut low, mut high) = (start, end);
        let at_start = if start == run.parameters[i] {
            run.sides[i].value(point)
        } else {
            value_at(start)?.0
        };
        let at_end = if end == run.parameters[i + 1] {
            run.sides[i + 1].value(point)
        } else {
            value_at(end)?.0
        };
        let mut parameter =
            start + (end - start) * (at_start / (at_start - at_end)).clamp(0.0, 1.0);
        let mut best = None;
        for step in 0..STEPS {
            let (value, slope, ray) = value_at(parameter)?;
            best = Some((parameter, ray));
            if value.abs() <= through || high - low <= f64::EPSILON {
                break;
            }
            if (value <= 0.0) == (at_start <= 0.0) {
                low = parameter;
            } else {
                high = parameter;
            }
            let newton = parameter - value / slope;
            let inside = newton > low && newton < high && step % 8 != 7;
            parameter = if inside { newton } else { 0.5 * (low + high) };
        }
        best
    }
}

fn arrival(parameter: f64, ray: Ray, medium: &Medium, point: DVec2) -> Arrival {
    let velocity = medium.group_velocity(ray.slowness);
    let travel = velocity.dot(point - ray.point) / velocity.length_squared();
    let there = ray.after(travel, medium);
    let side = |ray: &Ray| ray.point_change.perp_dot(velocity);
    Arrival {
        time: ray.time_at(point),
        parameter,
        ray,
        tube_width: there.tube_width(medium),
        beyond_caustic: side(&ray) * side(&there) < 0.0,
    }
}

/// The first arrival at a point over several fans (one a code), and which of them brings it.
#[must_use]
pub fn first_arrival(fans: &[Fan<'_>], point: DVec2) -> Option<(usize, Arrival)> {
    let firsts = fans
        .iter()
        .enumerate()
        .filter_map(|(index, fan)| Some((index, fan.first_arrival(point)?)));
    firsts.min_by(|a, b| a.1.time.total_cmp(&b.1.time))
}

/// First arrivals on a grid of `columns` by `rows` points over a box, row by row from its lower corner; none where nothing
/// arrives.
#[must_use]
pub fn travel_time_table(
    fans: &[Fan<'_>],
    low: DVec2,
    high: DVec2,
    columns: usize,
    rows: usize,
) -> Vec<Option<f64>> {
    let share = |i: usize, count: usize| i as f64 / count.saturating_sub(1).max(1) as f64;
    let points: Vec<DVec2> = (0..columns * rows)
        .map(|i| {
            low + (high - low) * DVec2::new(share(i % columns, columns), share(i / columns, rows))
        })
        .collect();
    for_each_point(&points, |point| {
        first_arrival(fans, point).map(|(_, arrival)| arrival.time)
    })
}

/// The answers at all points in order, on all cores with the feature `rayon`.
fn for_each_point<T: Send>(points: &[DVec2], answer: impl Fn(DVec2) -> T + Sync) -> Vec<T> {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        points.par_iter().map(|&point| answer(point)).collect()
    }
    #[cfg(not(feature = "rayon"))]
    {
        points.iter().map(|&point| answer(point)).collect()
    }
}

/// A section: for every receiver in order all arrivals of all fans, `(fan, arrival)`, by increasing time.
#[must_use]
pub fn section(fans: &[Fan<'_>], receivers: &[DVec2]) -> Vec<Vec<(usize, Arrival)>> {
    let gather = |receiver: DVec2| {
        let all = fans
            .iter()
            .enumerate()
            .flat_map(|(index, fan)| fan.arrivals(receiver).into_iter().map(move |a| (index, a)));
        let mut arrivals: Vec<_> = all.collect();
        arrivals.sort_by(|a, b| a.1.time.total_cmp(&b.1.time));
        arrivals
    };
    for_each_point(receivers, gather)
}
