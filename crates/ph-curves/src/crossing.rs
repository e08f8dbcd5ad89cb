//! Certified self-intersections of splines.

use glam::DVec2;

use crate::{ArcSpline, Joint, Piece};

/// Largest turning of one stretch: two neighbours then turn by less than pi together, and cannot meet again.
const MOST_TURNING: f64 = 1.2;
/// A box smaller than this share of the spline is a point: what still overlaps there touches without crossing.
const TOUCHING: f64 = 1e-13;
/// Halvings of two stretches before they count as touching.
const MOST_DEPTH: u32 = 48;
/// Newton's iteration for a crossing ends here in any case; it needs about five steps.
const MOST_STEPS: usize = 24;
/// Parameters this close to the ends of neighbouring pieces are their common point.
const COMMON_END: f64 = 1e-9;
/// Newton's steps below this share of a stretch that no longer shrink are rounding.
const SETTLED: f64 = 1e-6;
/// A point in which a spline crosses itself.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// Piece number and parameter of the earlier passage.
    pub first: (usize, f64),
    /// Piece number and parameter of the later passage.
    pub second: (usize, f64),
    /// The point.
    pub point: DVec2,
}

/// A part of a piece without cusp, with a triangle around it: its ends and the meeting point of their tangents.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch<'a> {
    pub(crate) piece: &'a Piece,
    pub(crate) index: usize,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) ends: [DVec2; 2],
    /// Unit directions of travel at the ends.
    pub(crate) tangents: [DVec2; 2],
    /// The meeting point of the tangents.
    pub(crate) apex: DVec2,
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    /// Absolute turning of the spline up to the start of the stretch, and to its end.
    pub(crate) turned: [f64; 2],
    /// The same with its sign.
    pub(crate) signed: [f64; 2],
    /// Number of the connected run of travel that this stretch belongs to.
    pub(crate) run: usize,
    /// Whether this run begins in the cusp in which the one before ended.
    pub(crate) after_cusp: bool,
}

impl<'a> Stretch<'a> {
    /// The part of a piece that travels with its tangents, or against them if `sense` is negative.
    fn new(piece: &'a Piece, index: usize, [from, to]: [f64; 2], sense: f64) -> Self {
        let ends = [piece.point(from), piece.point(to)];
        let tangents = [piece.normal(from), piece.normal(to)].map(|n| n.perp() * sense);
        let sine = tangents[0].perp_dot(tangents[1]);
        let chord = ends[1] - ends[0];
        let mut apex = ends[0] + tangents[0] * (chord.perp_dot(tangents[1]) / sine);
        if !apex.is_finite() {
            apex = ends[0];
        }
        let low = ends[0].min(ends[1]).min(apex);
        let high = ends[0].max(ends[1]).max(apex);
        Self {
            piece,
            index,
            from,
            to,
            ends,
            tangents,
            apex,
            low,
            high,
            turned: [0.0; 2],
            signed: [0.0; 2],
            run: 0,
            after_cusp: false,
        }
    }

    fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.from + self.to);
        let sense = if self.tangents[0].dot(self.piece.normal(self.from).perp()) < 0.0 {
            -1.0
        } else {
            1.0
        };
        [[self.from, middle], [middle, self.to]]
            .map(|range| Self::new(self.piece, self.index, range, sense))
    }

    fn overlaps(&self, other: &Self) -> bool {
        let boxes = self.low.cmple(other.high).all() && other.low.cmple(self.high).all();
        boxes && !self.chord_separates(other) && !other.chord_separates(self)
    }

    /// Whether a parallel to the chord lies between the triangles: stretches that run side by side are found apart by it.
    fn chord_separates(&self, other: &Self) -> bool {
        let chord = self.ends[1] - self.ends[0];
        let height = |p: DVec2| chord.perp_dot(p - self.ends[0]);
        let own = height(self.apex);
        let [a, b, c] = [other.ends[0], other.ends[1], other.apex].map(height);
        let rounding = COMMON_END * chord.length_squared();
        a.min(b).min(c) > own.max(0.0) + rounding || a.max(b).max(c) < own.min(0.0) - rounding
    }

    /// Whether no tangent of one is parallel to a tangent of the other: they then cross at most once. Tangents turn by
    /// less than a half turn from one end to the other.
    fn transversal(&self, other: &Self) -> bool {
        let side = |a: DVec2| other.tangents.map(|b| a.perp_dot(b));
        let [first, second] = self.tangents.map(side);
        let all = [first[0], first[1], second[0], second[1]];
        let narrow = self.tangents[0].dot(self.tangents[1]) > 0.0
            && other.tangents[0].dot(other.tangents[1]) > 0.0;
        narrow && (all.iter().all(|s| *s > 0.0) || all.iter().all(|s| *s < 0.0))
    }

    fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

impl ArcSpline {
    /// All points in which the spline crosses itself, apart from common points of neighbours.
    ///
    /// Two stretches of the spline are halved until the triangles around them are disjoint (no crossing) or no tangents
    /// of theirs are parallel (at most one crossing, which Newton's iteration then finds to rounding). Stretches between
    /// which the tangent turns by less than pi in all cannot meet and are not compared. Contacts without crossing are
    /// not reported.
    #[must_use]
    pub fn crossings(&self) -> Vec<Crossing> {
        let stretches = self.stretches(|_| true);
        let mut found = crossings(&stretches, stretches.len(), self.closed);
        let count = self.pieces.len();
        found.retain(|Crossing { first, second, .. }| {
            let follows =
                first.0 + 1 == second.0 && first.1 >= 1.0 - COMMON_END && second.1 <= COMMON_END;
            let around = first.0 == 0
                && second.0 + 1 == count
                && first.1 <= COMMON_END
                && second.1 >= 1.0 - COMMON_END;
            !(follows || (around && self.closed))
        });
        found
    }

    /// Stretches of all pieces, or of those that travel along their tangents if `keep` says so.
    pub(crate) fn stretches(&self, keep: impl Fn(bool) -> bool) -> Vec<Stretch<'_>> {
        let mut stretches: Vec<Stretch<'_>> = Vec::with_capacity(2 * self.pieces.len());
        let (mut turned, mut signed, mut run, mut after_cusp) = (0.0, 0.0, 0, false);
        // The sense of the stretch before, if it goes on in the next one.
        let mut sense_before: Option<bool> = None;
        for (index, piece) in self.pieces.iter().enumerate() {
            if index > 0 && self.joints[index - 1] == Joint::Corner {
                (run, after_cusp, sense_before) = (run + 1, false, None);
            }
            let mut places = piece.cusps();
            let cusped = !places.is_empty();
            let inflection = piece.inflection();
            places.extend(inflection);
            places.sort_by(f64::total_cmp);
            let mut begin = 0.0;
            for place in places.into_iter().chain([1.0]) {
                let range = [begin, place];
                begin = place;
                if range[1] - range[0] <= f64::EPSILON {
                    continue;
                }
                // The ends are quicker to evaluate, and as good where no radius vanishes.
                let at = if range == [0.0, 1.0] && !cusped {
                    0.0
                } else {
                    0.5 * (range[0] + range[1])
                };
                let forwards = piece.velocity(at).dot(piece.normal(at).perp()) >= 0.0;
                if !keep(forwards) {
                    (run, after_cusp, sense_before) = (run + 1, false, None);
                    continue;
                }
                // At a cusp the direction of travel reverses: inside of a piece, or in a joint where the radius changes its sign.
                if sense_before == Some(!forwards) {
                    (run, after_cusp) = (run + 1, true);
                }
                sense_before = Some(forwards);
                let [a, b] = range.map(|t| piece.normal(t));
                let turning = a.perp_dot(b).atan2(a.dot(b));
                let parts = (turning.abs() / MOST_TURNING).ceil().max(1.0);
                for part in 0..parts as usize {
                    let at = |k: usize| range[0] + (range[1] - range[0]) * k as f64 / parts;
                    let mut stretch = Stretch::new(
                        piece,
                        index,
                        [at(part), at(part + 1)],
                        if forwards { 1.0 } else { -1.0 },
                    );
                    let [a, b] = stretch.tangents;
                    let turn = if parts == 1.0 {
                        turning
                    } else {
                        a.perp_dot(b).atan2(a.dot(b))
                    };
                    stretch.turned = [turned, turned + turn.abs()];
                    stretch.signed = [signed, signed + turn];
                    (turned, signed) = (stretch.turned[1], stretch.signed[1]);
                    stretch.run = run;
                    stretch.after_cusp = after_cusp;
                    stretches.push(stretch);
                }
            }
        }
        stretches
    }
}

/// Compares stretches whose boxes overlap, in the order of their left ends.
///
/// The first `own` of them belong to the spline; the others only cut it and are not compared with each other.
pub(crate) fn crossings(stretches: &[Stretch<'_>], own: usize, closed: bool) -> Vec<Crossing> {
    let around = around(&stretches[..own], closed);
    let mut order: Vec<usize> = (0..stretches.len()).collect();
    order.sort_unstable_by(|a, b| stretches[*a].low.x.total_cmp(&stretches[*b].low.x));
    let size = stretches
        .iter()
        .map(|s| s.low.abs().max(s.high.abs()).max_element())
        .fold(0.0, f64::max);
    let mut found = Vec::new();
    let mut waiting = Vec::new();
    for (place, &a) in order.iter().enumerate() {
        for &b in &order[place + 1..] {
            if stretches[b].low.x > stretches[a].high.x {
                break;
            }
            if a.min(b) >= own {
                continue;
            }
            let (first, second) = (&stretches[a.min(b)], &stretches[a.max(b)]);
            if cannot_meet(first, second, around) || !first.overlaps(second) {
                continue;
            }
            waiting.push((*first, *second, 0));
            while let Some((first, second, depth)) = waiting.pop() {
                if !first.overlaps(&second) {
                    continue;
                }
                if first.transversal(&second) {
                    match newton(&first, &second) {
                        Meeting::Cross(t, s) => {
                            let point = first.piece.point(t);
                            found.push(Crossing {
                                first: (first.index, t),
                                second: (second.index, s),
                                point,
                            });
                            continue;
                        }
                        Meeting::Miss => continue,
                        Meeting::Unknown => {}
                    }
                }
                if depth >= MOST_DEPTH || first.size().max(second.size()) <= TOUCHING * size {
                    continue;
                }
                if first.size() >= second.size() {
                    waiting.extend(first.halves().map(|half| (half, second, depth + 1)));
                } else {
                    waiting.extend(second.halves().map(|half| (first, half, depth + 1)));
                }
            }
        }
    }
    found.sort_by(|a, b| {
        let key = |c: &Crossing| (c.first.0 as f64 + c.first.1, c.second.0 as f64 + c.second.1);
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    // A crossing at a common end of two halves or two pieces is found from both sides.
    found.dedup_by(|b, a| (a.point - b.point).length() <= 16.0 * f64::EPSILON * size);
    found
}

/// Whether the way from one stretch to the other is so short that they cannot cross: their common travel turns by less
/// than pi, so that all tangents point into one half plane; or it has a single cusp and no inflection, and the two
/// branches lie on different sides of the tangent of the cusp.
fn cannot_meet(first: &Stretch<'_>, second: &Stretch<'_>, around: Option<(f64, usize)>) -> bool {
    let half_turn = std::f64::consts::PI;
    let between = second.turned[1] - first.turned[0];
    if (first.run == second.run && between < half_turn) || smooth_neighbours(first, second) {
        return true;
    }
    if second.run == first.run + 1 && second.after_cusp && between < half_turn {
        let signed = (second.signed[1] - first.signed[0]).abs();
        return between - signed <= 1e-12;
    }
    around.is_some_and(|(total, run)| {
        first.run == 0
            && second.run == run
            && total - second.turned[0] + first.turned[1] < half_turn
    })
}

/// Whether one stretch goes on smoothly where the other ends, in either sense of travel, and both turn by less than pi
/// together: as where the half circle around an end meets the offset of the other side.
fn smooth_neighbours(first: &Stretch<'_>, second: &Stretch<'_>) -> bool {
    let turning = first.turned[1] - first.turned[0] + second.turned[1] - second.turned[0];
    let size = first.size() + second.size();
    turning < std::f64::consts::PI
        && [(0, 0), (0, 1), (1, 0), (1, 1)].iter().any(|&(i, j)| {
            let onwards = if i == j { -1.0 } else { 1.0 };
            let (a, b) = (first.tangents[i], second.tangents[j] * onwards);
            (first.ends[i] - second.ends[j]).length() <= COMMON_END * size
                && a.dot(b) > 0.0
                && a.perp_dot(b).abs() <= COMMON_END
        })
}

/// If the end of a closed spline goes on in its start: the total turning and the last run.
pub(crate) fn around(stretches: &[Stretch<'_>], closed: bool) -> Option<(f64, usize)> {
    let (first, last) = (stretches.first()?, stretches.last()?);
    let same = |a: DVec2, b: DVec2| (a - b).length() <= 1e-6 * (first.size() + last.size());
    let whole = first.index == 0
        && first.from == 0.0
        && last.to == 1.0
        && same(first.ends[0], last.ends[1]);
    let smooth = first.tangents[0].dot(last.tangents[1]) > 0.0;
    (closed && whole && smooth).then_some((last.turned[1], last.run))
}

/// How two stretches without parallel tangents meet.
enum Meeting {
    /// In these parameters.
    Cross(f64, f64),
    /// Not at all.
    Miss,
    /// The iteration did not tell.
    Unknown,
}

/// Newton's iteration from the intersection of the chords. The parameters run over the stretches.
fn newton(first: &Stretch<'_>, second: &Stretch<'_>) -> Meeting {
    let (c0, c1) = (
        first.ends[1] - first.ends[0],
        second.ends[1] - second.ends[0],
    );
    let between = second.ends[0] - first.ends[0];
    let determinant = c0.perp_dot(c1);
    let (mut t, mut s) = (
        between.perp_dot(c1) / determinant,
        between.perp_dot(c0) / determinant,
    );
    // Chords that meet far from both stretches: the triangles decide after halving.
    if !(t > -1.0 && t < 2.0 && s > -1.0 && s < 2.0) {
        return Meeting::Unknown;
    }
    let at = |stretch: &Stretch<'_>, share: f64| stretch.from + (stretch.to - stretch.from) * share;
    let mut last_step = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (u, v) = (at(first, t), at(second, s));
        let gap = second.piece.point(v) - first.piece.point(u);
        let (a, b) = (
            first.piece.velocity(u) * (first.to - first.from),
            second.piece.velocity(v) * (second.to - second.from),
        );
        let determinant = a.perp_dot(b);
        let (dt, ds) = (gap.perp_dot(b) / determinant, gap.perp_dot(a) / determinant);
        if !(dt.is_finite() && ds.is_finite()) {
            return Meeting::Unknown;
        }
        (t, s) = (t + dt, s + ds);
        if !(t > -0.5 && t < 1.5 && s > -0.5 && s < 1.5) {
            return Meeting::Unknown;
        }
        let step = dt.abs().max(ds.abs());
        // Quadratic convergence ends in the rounding of the points, which steps do not get below.
        let settled = step <= 8.0 * f64::EPSILON || (step < SETTLED && step > 0.1 * last_step);
        last_step = step;
        if settled {
            let slack = 1e-12_f64.max(4.0 * step);
            let inside = |x: f64| (-slack..=1.0 + slack).contains(&x);
            // The continuations of both stretches cross here and nowhere else near: outside means a miss.
            return if inside(t) && inside(s) {
                Meeting::Cross(at(first, t.clamp(0.0, 1.0)), at(second, s.clamp(0.0, 1.0)))
            } else if [t, s].iter().any(|x| !(-0.01..=1.01).contains(x)) {
                Meeting::Unknown
            } else {
                Meeting::Miss
            };
        }
    }
    Meeting::Unknown
}
