//! Offsets without their loops: certified self-intersections, and the parts that keep their distance.

use glam::DVec2;

use crate::{ArcSpline, Error, Joint, Piece, PlacedArc, TQuartic};

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
/// A part is kept if its distance to the original is the offset's, less this share of it for rounding.
const KEPT: f64 = 1e-9;

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
struct Stretch<'a> {
    piece: &'a Piece,
    index: usize,
    from: f64,
    to: f64,
    ends: [DVec2; 2],
    /// Unit directions of travel at the ends.
    tangents: [DVec2; 2],
    low: DVec2,
    high: DVec2,
    /// Absolute turning of the spline up to the start of the stretch, and to its end.
    turned: [f64; 2],
    /// The same with its sign.
    signed: [f64; 2],
    /// Number of the connected run of travel that this stretch belongs to.
    run: usize,
    /// Whether this run begins in the cusp in which the one before ended.
    after_cusp: bool,
}

impl<'a> Stretch<'a> {
    /// The part of a piece that travels with its tangents, or against them if `sense` is negative.
    fn new(piece: &'a Piece, index: usize, [from, to]: [f64; 2], sense: f64) -> Self {
        let ends = [piece.point(from), piece.point(to)];
        let tangents = [piece.normal(from), piece.normal(to)].map(|n| n.perp() * sense);
        let sine = tangents[0].perp_dot(tangents[1]);
        let chord = ends[1] - ends[0];
        let mut corners = vec_of_three(ends);
        if sine != 0.0 {
            corners[2] = ends[0] + tangents[0] * (chord.perp_dot(tangents[1]) / sine);
        }
        if !corners[2].is_finite() {
            corners[2] = ends[0];
        }
        let low = corners[0].min(corners[1]).min(corners[2]);
        let high = corners[0].max(corners[1]).max(corners[2]);
        Self {
            piece,
            index,
            from,
            to,
            ends,
            tangents,
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
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
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

fn vec_of_three(ends: [DVec2; 2]) -> [DVec2; 3] {
    [ends[0], ends[1], ends[0]]
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
    fn stretches(&self, keep: impl Fn(bool) -> bool) -> Vec<Stretch<'_>> {
        let mut stretches: Vec<Stretch<'_>> = Vec::with_capacity(2 * self.pieces.len());
        let (mut turned, mut signed, mut run, mut after_cusp) = (0.0, 0.0, 0, false);
        for (index, piece) in self.pieces.iter().enumerate() {
            let turning = piece.turning();
            let mut begin = 0.0;
            for cusp in piece.cusps().into_iter().chain([1.0]) {
                let range = [begin, cusp];
                begin = cusp;
                if range[1] - range[0] <= f64::EPSILON {
                    continue;
                }
                let forwards =
                    turning == 0.0 || piece.radius(0.5 * (range[0] + range[1])) * turning > 0.0;
                if !keep(forwards) {
                    run += 1;
                    after_cusp = false;
                    continue;
                }
                let parts = (turning.abs() * (range[1] - range[0]) / MOST_TURNING)
                    .ceil()
                    .max(1.0);
                for part in 0..parts as usize {
                    let at = |k: usize| range[0] + (range[1] - range[0]) * k as f64 / parts;
                    let mut stretch = Stretch::new(
                        piece,
                        index,
                        [at(part), at(part + 1)],
                        if forwards { 1.0 } else { -1.0 },
                    );
                    let [a, b] = stretch.tangents;
                    let turn = a.perp_dot(b).atan2(a.dot(b));
                    stretch.turned = [turned, turned + turn.abs()];
                    stretch.signed = [signed, signed + turn];
                    (turned, signed) = (stretch.turned[1], stretch.signed[1]);
                    stretch.run = run;
                    stretch.after_cusp = after_cusp;
                    stretches.push(stretch);
                }
                // At a cusp the direction of travel reverses.
                if cusp < 1.0 {
                    run += 1;
                    after_cusp = true;
                }
            }
        }
        stretches
    }

    /// The offset at signed distance `distance` without its loops: the parts whose distance to this spline is that of
    /// the offset, joined at the crossings of the untrimmed offset. Several chains, or none, may remain.
    ///
    /// Parts where the offset runs backwards (beyond the centres of curvature, or on the inner side of a corner) are
    /// nearer to the spline and go at once; the others are cut at their crossings, with each other, with the offset on the
    /// other side and with the half circles around the ends of an open spline, and each part is judged by the distance of one of its points from all
    /// pieces that can be that near.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for a distance that is not finite.
    pub fn trimmed_offset(&self, distance: f64) -> Result<Vec<Self>, Error> {
        if distance == 0.0 {
            return Ok(vec![self.clone()]);
        }
        let (raw, caps) = self.offset(distance)?.with_caps(self, distance)?;
        let mut stretches = raw.stretches(|forwards| forwards);
        let own = stretches.len();
        // What is near to a strand is bounded by the offsets on both of its sides. A simple closed spline separates them.
        let opposite = self.offset(-distance)?;
        if !self.closed || !self.crossings().is_empty() {
            let run = stretches.last().map_or(0, |last| last.run) + 2;
            stretches.extend(
                opposite
                    .stretches(|forwards| forwards)
                    .into_iter()
                    .map(|stretch| Stretch {
                        index: stretch.index + raw.pieces.len(),
                        run: stretch.run + run,
                        ..stretch
                    }),
            );
        }
        let crossings = crossings(&stretches, own, raw.closed);
        stretches.truncate(own);
        let boxes: Vec<(DVec2, DVec2, &Piece)> = self
            .stretches(|_| true)
            .iter()
            .map(|s| (s.low, s.high, s.piece))
            .collect();
        let parts: Vec<Part> = parts(&stretches, &crossings, raw.closed)
            .into_iter()
            .filter_map(|part| part.without(caps.clone()))
            .filter(|part| keeps_distance(part, &boxes, &raw, distance.abs()))
            .collect();
        chains(&parts, &raw)
    }

    /// Extends the offset of an open spline by half circles around its ends, which bound what is near to the ends.
    /// Returns the numbers of the offset's own pieces.
    fn with_caps(
        mut self,
        original: &Self,
        distance: f64,
    ) -> Result<(Self, std::ops::Range<usize>), Error> {
        let (Some(first), Some(last)) = (original.pieces.first(), original.pieces.last()) else {
            return Ok((self, 0..0));
        };
        let count = self.pieces.len();
        if self.closed {
            return Ok((self, 0..count));
        }
        let quarter = DVec2::new(0.0, distance.signum());
        let cap = |point: DVec2, normals: [DVec2; 3]| -> Result<[Piece; 2], Error> {
            let fan = |a: DVec2, b: DVec2| -> Result<Piece, Error> {
                let corner = TQuartic::point_fan(DVec2::ZERO, a, b)?;
                Ok(Piece::Arc(PlacedArc::new(point, corner)).offset(distance))
            };
            Ok([fan(normals[0], normals[1])?, fan(normals[1], normals[2])?])
        };
        let (at_start, at_end) = (first.normal(0.0), last.normal(1.0));
        let before = cap(
            first.point(0.0),
            [-at_start, -quarter.rotate(at_start), at_start],
        )?;
        let after = cap(last.point(1.0), [at_end, quarter.rotate(at_end), -at_end])?;
        self.pieces.splice(0..0, before);
        self.pieces.extend(after);
        self.joints.splice(0..0, [Joint::G1; 2]);
        self.joints.extend([Joint::G1; 2]);
        Ok((self, 2..count + 2))
    }
}

/// Compares stretches whose boxes overlap, in the order of their left ends.
///
/// The first `own` of them belong to the spline; the others only cut it and are not compared with each other.
fn crossings(stretches: &[Stretch<'_>], own: usize, closed: bool) -> Vec<Crossing> {
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
/// branches lie on different sides of the normal of the cusp.
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
fn around(stretches: &[Stretch<'_>], closed: bool) -> Option<(f64, usize)> {
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

/// Where a part begins or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Limit {
    /// At a crossing with this number.
    Crossing(usize),
    /// At a cusp, or where the spline itself ends.
    End,
}

/// A connected run of travel between two limits: pieces with their parameter ranges.
#[derive(Clone, Debug)]
struct Part {
    start: Limit,
    end: Limit,
    ranges: Vec<(usize, [f64; 2])>,
    /// A closed part: the whole of a closed spline.
    closed: bool,
}

impl Part {
    /// The part reduced to the given pieces; a limit that lies outside becomes an end.
    fn without(mut self, own: std::ops::Range<usize>) -> Option<Self> {
        let belongs =
            |range: Option<&(usize, [f64; 2])>| range.is_some_and(|(index, _)| own.contains(index));
        if !belongs(self.ranges.first()) {
            self.start = Limit::End;
        }
        if !belongs(self.ranges.last()) {
            self.end = Limit::End;
        }
        self.ranges.retain(|(index, _)| own.contains(index));
        (!self.ranges.is_empty()).then_some(self)
    }
}

/// Cuts the stretches at their crossings and at the ends of their runs.
fn parts(stretches: &[Stretch<'_>], crossings: &[Crossing], closed: bool) -> Vec<Part> {
    let mut cuts: Vec<(usize, f64, usize)> = crossings
        .iter()
        .enumerate()
        .flat_map(|(id, c)| [(c.first.0, c.first.1, id), (c.second.0, c.second.1, id)])
        .collect();
    cuts.sort_by(|a, b| {
        (a.0, a.1)
            .partial_cmp(&(b.0, b.1))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut cuts = cuts.into_iter().peekable();
    let mut parts: Vec<Part> = Vec::new();
    let mut current: Option<(usize, Part)> = None;
    for stretch in stretches {
        if let Some((run, part)) = current.take() {
            if run == stretch.run {
                current = Some((run, part));
            } else {
                parts.push(part);
            }
        }
        let (run, mut part) = current.take().unwrap_or((
            stretch.run,
            Part {
                start: Limit::End,
                end: Limit::End,
                ranges: Vec::new(),
                closed: false,
            },
        ));
        let mut from = stretch.from;
        while let Some(&(index, t, id)) = cuts.peek() {
            if index > stretch.index || (index == stretch.index && t > stretch.to) {
                break;
            }
            cuts.next();
            if t > from {
                extend(&mut part.ranges, stretch.index, [from, t]);
            }
            part.end = Limit::Crossing(id);
            let next = Part {
                start: Limit::Crossing(id),
                end: Limit::End,
                ranges: Vec::new(),
                closed: false,
            };
            parts.push(std::mem::replace(&mut part, next));
            from = t.max(from);
        }
        if stretch.to > from {
            extend(&mut part.ranges, stretch.index, [from, stretch.to]);
        }
        current = Some((run, part));
    }
    parts.extend(current.map(|(_, part)| part));
    parts.retain(|part| !part.ranges.is_empty());
    close(&mut parts, stretches, closed);
    parts
}

/// Adds a range, or lengthens the last one if it goes on in the same piece.
fn extend(ranges: &mut Vec<(usize, [f64; 2])>, piece: usize, range: [f64; 2]) {
    match ranges.last_mut() {
        Some((last, [_, to])) if *last == piece && *to == range[0] => *to = range[1],
        _ => ranges.push((piece, range)),
    }
}

/// On a closed spline the last part goes on in the first one, if nothing was left out between them.
fn close(parts: &mut Vec<Part>, stretches: &[Stretch<'_>], closed: bool) {
    if around(stretches, closed).is_none() {
        return;
    }
    let (Some(head), Some(tail)) = (parts.first(), parts.last()) else {
        return;
    };
    if head.start != Limit::End || tail.end != Limit::End {
        return;
    }
    if parts.len() == 1 {
        parts[0].closed = true;
        return;
    }
    let head = parts.remove(0);
    if let Some(tail) = parts.last_mut() {
        tail.ranges.extend(head.ranges);
        tail.end = head.end;
    }
}

/// Whether a point in the middle of the part is as far from the original as the offset should be.
fn keeps_distance(
    part: &Part,
    boxes: &[(DVec2, DVec2, &Piece)],
    raw: &ArcSpline,
    distance: f64,
) -> bool {
    let longest = part
        .ranges
        .iter()
        .map(|(index, range)| {
            let piece = &raw.pieces[*index];
            (
                (piece.point(range[1]) - piece.point(range[0])).length_squared(),
                *index,
                0.5 * (range[0] + range[1]),
            )
        })
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, index, t)) = longest else {
        return false;
    };
    let point = raw.pieces[index].point(t);
    let least = distance * (1.0 - KEPT) - 16.0 * f64::EPSILON * point.abs().max_element();
    let mut last: Option<&Piece> = None;
    boxes.iter().all(|(low, high, piece)| {
        let outside = point.clamp(*low, *high) - point;
        if outside.length_squared() >= least * least
            || last.is_some_and(|last| std::ptr::eq(last, *piece))
        {
            return true;
        }
        last = Some(piece);
        piece.distance(point) >= least
    })
}

/// Links the parts that remain at their crossings.
fn chains(parts: &[Part], raw: &ArcSpline) -> Result<Vec<ArcSpline>, Error> {
    let mut used = vec![false; parts.len()];
    let mut result = Vec::new();
    // Chains with a free start first, then the closed ones.
    let free = |part: &Part| {
        part.start == Limit::End || !parts.iter().any(|other| other.end == part.start)
    };
    let order = (0..parts.len())
        .filter(|i| free(&parts[*i]))
        .chain((0..parts.len()).filter(|i| !free(&parts[*i])));
    for first in order.collect::<Vec<_>>() {
        if used[first] {
            continue;
        }
        let mut chain = ArcSpline {
            pieces: Vec::new(),
            joints: Vec::new(),
            closed: parts[first].closed,
        };
        let mut next = Some(first);
        while let Some(i) = next {
            used[i] = true;
            if !chain.pieces.is_empty() {
                chain.joints.push(Joint::Corner);
            }
            append(&mut chain, &parts[i], raw)?;
            let follows = |j: &usize| parts[i].end != Limit::End && parts[*j].start == parts[i].end;
            next = (0..parts.len()).filter(|j| !used[*j]).find(follows);
            if next.is_none() && parts[i].end != Limit::End && parts[first].start == parts[i].end {
                chain.closed = true;
                chain.joints.push(Joint::Corner);
            }
        }
        if parts[first].closed {
            chain
                .joints
                .push(raw.joints.last().copied().unwrap_or(Joint::G1));
        }
        result.push(chain);
    }
    Ok(result)
}

/// Adds the pieces of a part with the joints that they had.
fn append(chain: &mut ArcSpline, part: &Part, raw: &ArcSpline) -> Result<(), Error> {
    let mut last: Option<usize> = None;
    for &(index, [from, to]) in &part.ranges {
        let piece = &raw.pieces[index];
        if let Some(last) = last {
            chain
                .joints
                .push(raw.joints.get(last).copied().unwrap_or(Joint::G1));
        }
        chain.pieces.push(if from == 0.0 && to == 1.0 {
            *piece
        } else {
            piece.part(from, to)?
        });
        last = Some(index);
    }
    Ok(())
}
