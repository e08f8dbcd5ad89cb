//! Many receivers at once: first arrivals, travel-time tables and sections.
//!
//! ```text
//!    +---+---+  receivers lie in cells of a grid, and cells in larger cells; only strips of rays
//!    | .\|   |  that may pass a cell are followed into its parts. In the smallest cells a strip
//!    |---\---|  meets a few receivers one after the other: all that it needs is at hand.
//!    |. .|\ .|
//!    +---+---+
//! ```

use std::ops::Range;

use glam::DVec2;

use crate::scatter::{Cell, Scatter};
use crate::{Arrival, Fan};

/// So few receivers are answered one by one.
const FEW: usize = 16;

/// A group is divided this often: receivers may be scattered over many scales.
const MOST_DIVISIONS: u32 = 48;

/// A strip of a fan: its run, its place in that, and its number.
#[derive(Clone, Copy)]
struct StripPlace {
    run: u32,
    index: u32,
    number: u32,
}

/// What is known of a strip in a batch.
#[derive(Clone, Copy, PartialEq)]
enum Clear {
    Unknown,
    Yes,
    No,
}

/// Many receivers, answered together.
struct Batch<'f, 'm, F> {
    fan: &'f Fan<'m>,
    scatter: Scatter,
    /// The strips that may pass the present cell, behind those of the cells around it.
    candidates: Vec<StripPlace>,
    /// Whether a strip's rays surely meet nothing on their last leg.
    clear: Vec<Clear>,
    slack: f64,
    found: F,
}

impl Fan<'_> {
    /// Calls `found` with the number of a receiver and an arrival for all arrivals at all receivers, in no order.
    ///
    /// Receivers are divided into groups, and only those strips of rays are followed into a group that may pass through it:
    /// the cost of a receiver hardly depends on the number of rays.
    pub fn visit_arrivals(&self, receivers: &[DVec2], found: impl FnMut(usize, Arrival)) {
        let mut candidates = Vec::new();
        for (run, number) in self.runs().iter().zip(0..) {
            for index in 0..run.strips.len() as u32 {
                candidates.push(StripPlace {
                    run: number,
                    index,
                    number: candidates.len() as u32,
                });
            }
        }
        let all = candidates.len();
        let scatter = Scatter::new(receivers, FEW);
        let (root, low, size) = scatter.root();
        Batch {
            fan: self,
            scatter,
            clear: vec![Clear::Unknown; all],
            candidates,
            slack: self.slack(),
            found,
        }
        .cell(root, low, size, 0..all);
    }

    /// The first arrivals at all receivers, in their order.
    #[must_use]
    pub fn first_arrivals(&self, receivers: &[DVec2]) -> Vec<Option<Arrival>> {
        in_parts(receivers, |part| {
            let mut firsts: Vec<Option<Arrival>> = vec![None; part.len()];
            self.visit_arrivals(part, |number, arrival| {
                let first = &mut firsts[number];
                if first.is_none_or(|known| arrival.time < known.time) {
                    *first = Some(arrival);
                }
            });
            firsts
        })
    }
}

impl<F: FnMut(usize, Arrival)> Batch<'_, '_, F> {
    /// Answers the receivers of a cell of the grid from a range of the candidates.
    fn cell(&mut self, cell: Cell, low: DVec2, size: DVec2, range: Range<usize>) {
        let places = self.scatter.places(cell);
        if places.is_empty() {
            return;
        }
        let start = self.candidates.len();
        self.narrow(low + 0.5 * size, 0.5 * size.length(), range);
        let range = start..self.candidates.len();
        if !range.is_empty() {
            match cell.parts() {
                Some(parts) if places.len() > FEW => {
                    let half = 0.5 * size;
                    for (part, corner) in parts.into_iter().zip(Cell::CORNERS) {
                        self.cell(part, low + half * corner, half, range.clone());
                    }
                }
                _ => self.group(places, range, 0),
            }
        }
        self.candidates.truncate(start);
    }

    /// Adds those of a range of the candidates once more that may pass a disc.
    fn narrow(&mut self, centre: DVec2, radius: f64, range: Range<usize>) {
        let reach = radius + self.slack;
        for i in range {
            let candidate = self.candidates[i];
            let run = &self.fan.runs()[candidate.run as usize];
            if run.strips[candidate.index as usize].may_pass(centre, reach) {
                self.candidates.push(candidate);
            }
        }
    }

    /// Answers receivers that the grid does not divide any more: dividing them in two, while they are many and apart.
    fn group(&mut self, places: Range<usize>, range: Range<usize>, depth: u32) {
        if places.len() <= FEW || depth >= MOST_DIVISIONS {
            return self.answer(places, range);
        }
        let (low, high) = self.scatter.bounds(places.clone());
        if low == high {
            return self.answer(places, range);
        }
        let start = self.candidates.len();
        self.narrow(0.5 * (low + high), 0.5 * (high - low).length(), range);
        let range = start..self.candidates.len();
        if !range.is_empty() {
            let middle = self.scatter.divide(places.clone(), low, high);
            self.group(places.start..middle, range.clone(), depth + 1);
            self.group(middle..places.end, range, depth + 1);
        }
        self.candidates.truncate(start);
    }

    /// Answers a few receivers, strip after strip.
    fn answer(&mut self, places: Range<usize>, range: Range<usize>) {
        for candidate in &self.candidates[range] {
            let run = &self.fan.runs()[candidate.run as usize];
            let index = candidate.index as usize;
            let clear = &mut self.clear[candidate.number as usize];
            for &(point, receiver) in self.scatter.slice(places.clone()) {
                let Some(distances) = run.strips[index].distances_within(point, self.slack) else {
                    continue;
                };
                if *clear == Clear::Unknown {
                    *clear = if self.fan.is_clear(run, index) {
                        Clear::Yes
                    } else {
                        Clear::No
                    };
                }
                let is_clear = *clear == Clear::Yes;
                self.fan
                    .follow(run, index, is_clear, distances, point, &mut |arrival| {
                        (self.found)(receiver as usize, arrival);
                    });
            }
        }
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
