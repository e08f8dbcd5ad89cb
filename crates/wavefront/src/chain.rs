//! Chains of Bézier curves under a tree of boxes: where rays meet them.

use bezier_mass::BezierCurve;
use glam::DVec2;

use crate::beam::{Part, Wedge};
use crate::piece::{Bounds, MOST_POWERS, Piece, SMALL_PART, impact, sign_changes};
use crate::strip::{Reach, Strip};
use crate::{Error, Impact};

/// Bézier curves one after the other. The parameter is the number of the piece plus that on the piece.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    pieces: Vec<Piece>,
    /// A heap: node k holds its children 2k and 2k + 1, the leaves are the pieces and, behind them, empty boxes.
    boxes: Vec<Bounds>,
}

/// A parameter this far outside `[0, 1]` still belongs to a chain's end piece.
const END_SLACK: f64 = 1e-12;
/// Newton's method from a neighbouring ray's place; it doubles its digits, and is given up for the certified search.
const GUIDED_STEPS: usize = 10;
/// From a place this near (in the piece's parameter) a step of the third order ends the search: what it leaves is the cube of
/// this, below rounding.
const CONVERGED: f64 = 1e-5;
/// The part of that step which is of the second order is the square of its length in a well-placed search, no more than this.
const CURVED: f64 = 1e-10;
/// Between two rays an interface may turn by so much more (radians) than from the one to the other.
const PLAIN_TURN: f64 = 0.1;
/// The pieces of a chain meet to this share of one and their distance from the origin.
const JOINT: f64 = 1e-6;
/// Parts are looked for in a box that is widened by this share of its size, against rounding.
const PART_MARGIN: f64 = 1e-8;
impl Chain {
    pub(crate) fn new(curves: impl IntoIterator<Item = BezierCurve<DVec2>>) -> Result<Self, Error> {
        let pieces: Vec<Piece> = curves.into_iter().map(Piece::new).collect();
        let bad = |reason| Error::BadInterface {
            interface: 0,
            reason,
        };
        if pieces.is_empty() {
            return Err(bad("a curve without pieces"));
        }
        for (first, second) in pieces.iter().zip(pieces.iter().skip(1)) {
            let (end, start) = (
                first.curve.at(1.0).position(),
                second.curve.at(0.0).position(),
            );
            if let (Some(end), Some(start)) = (end, start)
                && end.distance(start) > JOINT * (1.0 + end.length())
            {
                return Err(bad("two neighbouring pieces of a curve do not meet"));
            }
        }
        let leaves = pieces.len().next_power_of_two();
        let mut boxes = vec![Bounds::EMPTY; 2 * leaves];
        for (piece, leaf) in pieces.iter().zip(&mut boxes[leaves..]) {
            *leaf = piece.bounds();
            if leaf.low == leaf.high {
                return Err(bad("a piece of a curve is a single point"));
            }
        }
        for node in (1..leaves).rev() {
            boxes[node] = boxes[2 * node].union(boxes[2 * node + 1]);
        }
        Ok(Self { pieces, boxes })
    }

    #[cfg(feature = "serde")]
    pub(crate) fn into_curves(self) -> Vec<BezierCurve<DVec2>> {
        self.pieces.into_iter().map(|piece| piece.curve).collect()
    }

    pub(crate) fn piece_count(&self) -> usize {
        self.pieces.len()
    }

    pub(crate) fn may_enter(&self, low: DVec2, high: DVec2) -> bool {
        self.boxes[1].overlaps(low, high)
    }

    pub(crate) fn point(&self, parameter: f64) -> Option<DVec2> {
        let (index, t) = self.locate(parameter);
        self.pieces[index].curve.jet(t).position()
    }

    /// The length of the derivative by the parameter.
    pub(crate) fn speed(&self, parameter: f64) -> Option<f64> {
        let (index, t) = self.locate(parameter);
        Some(self.pieces[index].jet(t)?[1].length())
    }

    /// Whether the rays of a strip surely do not meet the chain, or not once more where they start on it (`left`): the pieces
    /// that they may pass are neighbours and run across all of the rays in one sense, so that each ray meets them once.
    pub(crate) fn is_clear_of(&self, strip: &Strip, reach: &Reach, left: bool) -> bool {
        let clear = std::cell::Cell::new(true);
        let (mut last, mut sense) = (None::<usize>, 0.0);
        self.visit_pieces(
            |bounds| match bounds.circle() {
                Some((centre, radius)) => {
                    clear.get()
                        && reach.is_ahead(centre, radius)
                        && strip.may_pass(centre, radius + reach.slack)
                }
                None => !bounds.is_empty(),
            },
            |index| {
                let across = strip.sense_across(self.pieces[index].curve.control());
                let is_next = last.is_none_or(|last| last + 1 == index && across == sense);
                clear.set(left && across != 0.0 && is_next && clear.get());
                (last, sense) = (Some(index), across);
            },
        );
        clear.get()
    }

    /// Whether the whole pieces between two impacts have tangents between those there, but for a little.
    pub(crate) fn is_plain_between(&self, one: &Impact, two: &Impact) -> bool {
        let (first, last) = (self.locate(one.parameter).0, self.locate(two.parameter).0);
        let turn = one.tangent.angle_to(two.tangent);
        let (least, most) = (turn.min(0.0) - PLAIN_TURN, turn.max(0.0) + PLAIN_TURN);
        let inner = self.pieces.get(first.min(last) + 1..first.max(last));
        inner.unwrap_or_default().iter().all(|piece| {
            piece.tangents.is_some_and(|(angle, spread)| {
                let from = one.tangent.angle_to(DVec2::from_angle(angle));
                from - spread >= least && from + spread <= most
            })
        })
    }

    /// Calls `found` with the parts in a box that rays of a wedge may meet, or with none if they turn too much.
    pub(crate) fn visit_parts(
        &self,
        wedge: &Wedge,
        [low, high]: [DVec2; 2],
        found: &mut dyn FnMut(Option<Part>),
    ) {
        let margin = PART_MARGIN * (high - low);
        let (low, high) = (low - margin, high + margin);
        let size = SMALL_PART * (high - low).length();
        self.visit_pieces(
            |bounds| {
                !bounds.is_empty()
                    && bounds.overlaps(low, high)
                    && wedge.may_meet(bounds.low, bounds.high)
            },
            |index| {
                let bounds = self.boxes[self.boxes.len() / 2 + index];
                self.pieces[index].visit_parts(bounds, wedge, [low, high], size, 0, found);
            },
        );
    }

    #[inline]
    fn locate(&self, parameter: f64) -> (usize, f64) {
        let index = (parameter.max(0.0) as usize).min(self.pieces.len() - 1);
        (index, parameter - index as f64)
    }

    /// Calls `visit` with the pieces whose boxes pass the test, in order.
    #[inline]
    fn visit_pieces(&self, keep: impl FnMut(&Bounds) -> bool, visit: impl FnMut(usize)) {
        self.visit_pieces_of(1, keep, visit);
    }

    /// As `visit_pieces`, in the part of the tree under a node.
    #[inline]
    fn visit_pieces_of(
        &self,
        root: usize,
        mut keep: impl FnMut(&Bounds) -> bool,
        mut visit: impl FnMut(usize),
    ) {
        if !keep(&self.boxes[root]) {
            return;
        }
        let leaves = self.boxes.len() / 2;
        let mut waiting = [0_usize; 64];
        let mut count = 1;
        waiting[0] = root;
        while count > 0 {
            count -= 1;
            let node = waiting[count];
            if !keep(&self.boxes[node]) {
                continue;
            }
            if node >= leaves {
                if node - leaves < self.pieces.len() {
                    visit(node - leaves);
                }
            } else {
                (waiting[count], waiting[count + 1]) = (2 * node + 1, 2 * node);
                count += 2;
            }
        }
    }

    /// Calls `found` for every impact later than `after`, in no order.
    pub(crate) fn visit_impacts(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        mut found: impl FnMut(Impact),
    ) {
        self.visit_pieces(
            |bounds| bounds.may_meet(origin, velocity, f64::INFINITY),
            |index| self.visit_piece(index, origin, velocity, after, &mut found),
        );
    }

    /// The first impact later than `after`; boxes behind the first one known are not searched.
    pub(crate) fn first_impact(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
    ) -> Option<Impact> {
        let first = std::cell::Cell::new(None::<Impact>);
        let latest = || first.get().map_or(f64::INFINITY, |impact| impact.time);
        self.visit_pieces(
            |bounds| bounds.may_meet(origin, velocity, latest()),
            |index| {
                self.visit_piece(index, origin, velocity, after, &mut |impact: Impact| {
                    if impact.time < latest() {
                        first.set(Some(impact));
                    }
                });
            },
        );
        first.get()
    }

    fn visit_piece(
        &self,
        index: usize,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        found: &mut impl FnMut(Impact),
    ) {
        let piece = &self.pieces[index];
        let mut room = [0.0; MOST_POWERS];
        let mut more = Vec::new();
        let sides = piece.sides(origin, velocity, &mut room, &mut more);
        if sign_changes(sides) == Some(0) {
            return;
        }
        let Ok(roots) = variation::roots(sides) else {
            return;
        };
        let last = index + 1 == self.pieces.len();
        for root in roots.iter() {
            // A joint belongs to the piece that starts there: both compute the same side of the same point.
            if root.value() >= 1.0 && !last && sides.last() == Some(&0.0) {
                continue;
            }
            let Some(impact) = piece.impact(root.value(), index, origin, velocity) else {
                continue;
            };
            if impact.time > after {
                found(impact);
            }
        }
    }

    /// The impact near a known place, by Newton's method from there.
    #[inline]
    pub(crate) fn impact_near(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        guess: f64,
    ) -> Option<Impact> {
        let mut parameter = guess;
        for _ in 0..GUIDED_STEPS {
            let (index, t) = self.locate(parameter);
            let [position, slope, bend] = self.pieces[index].jet(t)?;
            let approach = velocity.perp_dot(slope).recip();
            let step = -velocity.perp_dot(position - origin) * approach;
            let curved = -0.5 * step * step * velocity.perp_dot(bend) * approach;
            parameter += step;
            if !(parameter > -END_SLACK && parameter < self.pieces.len() as f64 + END_SLACK) {
                return None;
            }
            // Behind a joint another piece goes on.
            if step.abs() <= CONVERGED
                && curved.abs() <= CURVED
                && self.locate(parameter).0 == index
            {
                parameter += curved;
                let step = step + curved;
                let position = position + step * (slope + 0.5 * step * bend);
                let jet = [position, slope + step * bend, bend];
                let impact = impact(jet, parameter, origin, velocity)?;
                return (impact.time > after).then_some(impact);
            }
        }
        None
    }

    /// Whether the way between two points meets the chain, except at its start; `left` is the parameter of the start if that
    /// lies on the chain. Ends closer to the chain than the share `margin` of the way do not count.
    pub(crate) fn blocks(&self, from: DVec2, to: DVec2, left: Option<f64>, margin: f64) -> bool {
        let way = to - from;
        let left = left.map(|parameter| self.locate(parameter).0);
        let keep = |bounds: &Bounds| bounds.overlaps(from, to) && bounds.may_meet(from, way, 1.0);
        let mut blocked = false;
        let mut visit = |index: usize| {
            let mut room = [0.0; MOST_POWERS];
            let mut more = Vec::new();
            let sides = self.pieces[index].sides(from, way, &mut room, &mut more);
            match sign_changes(sides) {
                Some(0) => return,
                // The one crossing of the piece that the way starts from.
                Some(1) if left == Some(index) => return,
                _ => {}
            }
            self.visit_piece(index, from, way, margin, &mut |impact: Impact| {
                blocked |= impact.time < 1.0 - margin;
            });
        };
        let Some(left) = left else {
            self.visit_pieces(keep, visit);
            return blocked;
        };
        // From the piece that is left up to the root, and down its siblings: their boxes are mostly out of the way.
        visit(left);
        let mut node = left + self.boxes.len() / 2;
        while node > 1 {
            self.visit_pieces_of(node ^ 1, keep, &mut visit);
            node /= 2;
        }
        blocked
    }
}
