//! The taut path in a flattened strip: the linear funnel of Chazelle, and of Lee and Preparata.

use glam::DVec2;
use robust::{Coord, orient2d};

use crate::strip::{Side, Strip};

/// A bend closer to straight than this, in radians, counts as straight: the path *touches* the vertex.
///
/// Images drift by about `n ε` of the strip's length over `n` faces and links are rarely shorter than 1e-4 of it, so
/// that 1e-10 is reached by rounding only in strips of tens of thousands of faces; and it is the tolerance of the
/// certificate, so that a vertex kept as touched passes it.
pub(crate) const TOUCH_ANGLE: f64 = 1e-10;

/// A vertex of a taut path: where it bends, or touches an end of a portal without bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    /// Side of the strip on which the vertex lies.
    pub(crate) side: Side,
    /// First and last of the consecutive portals that end there.
    pub(crate) first: u32,
    pub(crate) last: u32,
    /// Image of the vertex.
    pub(crate) at: DVec2,
}

/// Scratch of the funnel: an apex and two chains, of which the left one turns left and the right one right.
#[derive(Clone, Debug, Default)]
pub(crate) struct Funnel {
    left: Chain,
    right: Chain,
    bends: Vec<Corner>,
    /// The corners of the taut path, in order.
    pub(crate) corners: Vec<Corner>,
}

/// A chain of portal ends, popped at its far end and, when the apex advances, at its near end.
#[derive(Clone, Debug, Default)]
struct Chain {
    ends: Vec<(u32, DVec2)>,
    begin: usize,
}

impl Chain {
    fn clear(&mut self) {
        self.ends.clear();
        self.begin = 0;
    }

    fn live(&self) -> &[(u32, DVec2)] {
        &self.ends[self.begin..]
    }
}

/// Twice the signed area, its sign exact for the given numbers: positive when `c` lies left of `a -> b`.
#[inline]
fn orient(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

impl Funnel {
    /// The taut path of a flattened strip, in time linear in the number of its portals.
    pub(crate) fn solve(&mut self, strip: &Strip) {
        self.left.clear();
        self.right.clear();
        self.bends.clear();
        let mut apex = strip.from;
        for k in 0..strip.portals.len() as u32 {
            if strip.left_since[k as usize] == k {
                self.insert(&mut apex, Side::Left, k, strip.left[k as usize], strip);
            }
            if strip.right_since[k as usize] == k {
                self.insert(&mut apex, Side::Right, k, strip.right[k as usize], strip);
            }
        }
        self.insert(&mut apex, Side::Left, u32::MAX, strip.to, strip);
        let rest = self.left.live();
        for &(k, at) in &rest[..rest.len().saturating_sub(1)] {
            self.bends.push(Corner {
                side: Side::Left,
                first: k,
                last: strip.copy_until(k, Side::Left),
                at,
            });
        }
        self.add_touched(strip);
    }

    /// One end of a new portal.
    fn insert(&mut self, apex: &mut DVec2, side: Side, k: u32, p: DVec2, strip: &Strip) {
        // The right side is the mirror image of the left one.
        let (near, far, turn) = match side {
            Side::Left => (&mut self.left, &mut self.right, 1.0),
            Side::Right => (&mut self.right, &mut self.left, -1.0),
        };
        while let Some(&(_, last)) = near.live().last() {
            let before = match near.live() {
                [.., (_, before), _] => *before,
                _ => *apex,
            };
            if turn * orient(before, last, p) > 0.0 {
                break;
            }
            near.ends.pop();
        }
        if near.live().is_empty() {
            while let Some(&(k, first)) = far.live().first() {
                if turn * orient(*apex, first, p) > 0.0 {
                    break;
                }
                let side = if side == Side::Left {
                    Side::Right
                } else {
                    Side::Left
                };
                self.bends.push(Corner {
                    side,
                    first: k,
                    last: strip.copy_until(k, side),
                    at: first,
                });
                *apex = first;
                far.begin += 1;
            }
        }
        near.ends.push((k, p));
    }

    /// Puts the vertices that the path touches without bending between its bends.
    fn add_touched(&mut self, strip: &Strip) {
        self.corners.clear();
        let (mut from, mut begin) = (strip.from, 0);
        for i in 0..=self.bends.len() {
            let bend = self.bends.get(i).copied();
            let (to, end) =
                bend.map_or((strip.to, strip.portals.len() as u32), |b| (b.at, b.first));
            self.add_touched_between(strip, from, to, begin..end);
            if let Some(bend) = bend {
                self.corners.push(bend);
                (from, begin) = (bend.at, bend.last + 1);
            }
        }
    }

    fn add_touched_between(
        &mut self,
        strip: &Strip,
        from: DVec2,
        to: DVec2,
        portals: std::ops::Range<u32>,
    ) {
        let (begin, settled) = (portals.start, self.corners.len());
        let length = from.distance(to);
        let along = (to - from) / length;
        for k in portals {
            for side in [Side::Left, Side::Right] {
                let since = match side {
                    Side::Left => strip.left_since[k as usize],
                    Side::Right => strip.right_since[k as usize],
                };
                if since != k && k != begin {
                    continue;
                }
                let at = strip.end(k, side);
                let (ahead, aside) = (along.dot(at - from), along.perp_dot(at - from).abs());
                let behind = length - ahead;
                // Bend at the vertex if the path went through it, for small angles.
                if ahead > 0.0 && behind > 0.0 && aside * length <= TOUCH_ANGLE * ahead * behind {
                    self.corners.push(Corner {
                        side,
                        first: since,
                        last: strip.copy_until(k, side),
                        at,
                    });
                }
            }
        }
        self.corners[settled..]
            .sort_unstable_by(|a, b| along.dot(a.at).total_cmp(&along.dot(b.at)));
    }
}
