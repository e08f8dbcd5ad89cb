//! Many receivers at once: first arrivals, travel-time tables and sections.

use glam::DVec2;

use crate::{Arrival, Fan};

/// So few receivers are answered one by one.
const FEW: usize = 12;
/// Receivers are divided this often: they may be scattered over many scales.
const MOST_DIVISIONS: u32 = 48;

/// A strip of a fan: its run, and its place in that.
type StripPlace = (u32, u32);

impl Fan<'_> {
    /// Calls `found` with the number of a receiver and an arrival for all arrivals at all receivers, in no order.
    ///
    /// Receivers are divided into groups, and only those strips of rays are followed into a group that may pass through it:
    /// the cost of a receiver hardly depends on the number of rays.
    pub fn visit_arrivals(&self, receivers: &[DVec2], mut found: impl FnMut(usize, Arrival)) {
        let mut places: Vec<(DVec2, usize)> = receivers
            .iter()
            .enumerate()
            .filter(|(_, point)| point.is_finite())
            .map(|(number, point)| (*point, number))
            .collect();
        let strips = self.runs().iter().zip(0..).flat_map(|(run, number)| {
            (0..run.strips.len() as u32).map(move |index| (number, index))
        });
        let mut candidates: Vec<StripPlace> = strips.collect();
        let all = candidates.len();
        self.divide(&mut places, &mut candidates, 0..all, 0, &mut found);
    }

    /// Answers a group of receivers from a range of the candidates, which grow by the groups inside it and shrink again.
    fn divide(
        &self,
        places: &mut [(DVec2, usize)],
        candidates: &mut Vec<StripPlace>,
        range: std::ops::Range<usize>,
        depth: u32,
        found: &mut impl FnMut(usize, Arrival),
    ) {
        let Some((first, _)) = places.first() else {
            return;
        };
        let (low, high) = places
            .iter()
            .fold((*first, *first), |(low, high), (point, _)| {
                (low.min(*point), high.max(*point))
            });
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let reach = half.length() + self.slack();
        let start = candidates.len();
        for i in range {
            let (run, index) = candidates[i];
            if self.runs()[run as usize].strips[index as usize].may_pass(centre, reach) {
                candidates.push((run, index));
            }
        }
        let end = candidates.len();
        if places.len() <= FEW || depth >= MOST_DIVISIONS || half == DVec2::ZERO {
            for (point, number) in places.iter() {
                for &(run, index) in &candidates[start..end] {
                    let run = &self.runs()[run as usize];
                    self.meet(run, index as usize, *point, &mut |arrival| {
                        found(*number, arrival);
                    });
                }
            }
        } else if end > start {
            let split = if half.x > half.y {
                partition(places, |point| point.x < centre.x)
            } else {
                partition(places, |point| point.y < centre.y)
            };
            let (left, right) = places.split_at_mut(split);
            self.divide(left, candidates, start..end, depth + 1, found);
            self.divide(right, candidates, start..end, depth + 1, found);
        }
        candidates.truncate(start);
    }

    /// The first arrivals at all receivers, in their order.
    #[must_use]
    pub fn first_arrivals(&self, receivers: &[DVec2]) -> Vec<Option<Arrival>> {
        let mut firsts: Vec<Option<Arrival>> = vec![None; receivers.len()];
        self.visit_arrivals(receivers, |number, arrival| {
            let first = &mut firsts[number];
            if first.is_none_or(|known| arrival.time < known.time) {
                *first = Some(arrival);
            }
        });
        firsts
    }
}

/// Moves the places with a property to the front; how many there are.
fn partition(places: &mut [(DVec2, usize)], is_first: impl Fn(DVec2) -> bool) -> usize {
    let mut count = 0;
    for i in 0..places.len() {
        if is_first(places[i].0) {
            places.swap(i, count);
            count += 1;
        }
    }
    count
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
    in_parts(&points, |part| {
        let mut times = vec![None; part.len()];
        for fan in fans {
            fan.visit_arrivals(part, |number, arrival| {
                let time: &mut Option<f64> = &mut times[number];
                *time = Some(time.map_or(arrival.time, |known| known.min(arrival.time)));
            });
        }
        times
    })
}

/// A section: for every receiver in order all arrivals of all fans, `(fan, arrival)`, by increasing time.
#[must_use]
pub fn section(fans: &[Fan<'_>], receivers: &[DVec2]) -> Vec<Vec<(usize, Arrival)>> {
    in_parts(receivers, |part| {
        let mut answers = vec![Vec::new(); part.len()];
        for (index, fan) in fans.iter().enumerate() {
            fan.visit_arrivals(part, |number, arrival| {
                answers[number].push((index, arrival));
            });
        }
        for arrivals in &mut answers {
            arrivals.sort_by(|a, b| a.1.time.total_cmp(&b.1.time));
        }
        answers
    })
}

/// The answers at all points in order, in parts on all cores with the feature `rayon`.
fn in_parts<T: Send>(
    points: &[DVec2],
    answer: impl Fn(&[DVec2]) -> Vec<T> + Sync + Send,
) -> Vec<T> {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        let part = points
            .len()
            .div_ceil(4 * rayon::current_num_threads())
            .max(FEW);
        points.par_chunks(part).flat_map_iter(answer).collect()
    }
    #[cfg(not(feature = "rayon"))]
    {
        answer(points)
    }
}
