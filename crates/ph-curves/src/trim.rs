//! Offsets without their loops: the parts that keep their distance.

use glam::DVec2;

use crate::crossing::{Crossing, Stretch, around, crossings};
use crate::{ArcSpline, Error, Joint, Piece, PlacedArc, TQuartic};

/// A part is kept if its distance to the original is the offset's, less this share of it for rounding.
const KEPT: f64 = 1e-9;

/// Length of a swallowtail's tip, in shares of the distance, below which its lack of distance is rounding.
const TIP: f64 = 1e-5;

impl ArcSpline {
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
            .filter(|part| !part.is_tip(&raw, distance))
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

impl Part {
    /// Whether the part is the tip of a swallowtail, from a crossing to a cusp, that is too small to be judged by its distance.
    /// Close to a cusp the offset is always nearer to the original than it should be.
    fn is_tip(&self, raw: &ArcSpline, distance: f64) -> bool {
        let (Some((_, first)), Some((_, last))) = (self.ranges.first(), self.ranges.last()) else {
            return false;
        };
        // Cusps are the only ends inside of pieces.
        let from_cusp = self.start == Limit::End && first[0] > 0.0;
        let to_cusp = self.end == Limit::End && last[1] < 1.0;
        let length: f64 = self
            .ranges
            .iter()
            .map(|(index, [from, to])| {
                let piece = &raw.pieces[*index];
                (piece.point(*to) - piece.point(*from)).length()
            })
            .sum();
        (from_cusp || to_cusp) && length <= TIP * distance.abs()
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
