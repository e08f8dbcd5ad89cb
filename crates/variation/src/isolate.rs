//! Isolation by subdivision and Descartes' rule of signs, every decision certified.
//!
//! A node is a dyadic subinterval with the coefficients of `F` on it. `V` sign changes bound its roots (Descartes); both
//! have the same parity. The node is dropped at `V = 0`, handed to the refinement at `V = 1`; at `V = 2, 3` the matching
//! *lower* bound is tried first: values of `F` at `V - 1` points between the crossings of the polygon. If their signs
//! alternate, all `V` roots are separated without a subdivision. Otherwise de Casteljau at 1/2.
//!
//! A sign counts only if it exceeds the error bound of its number. What an arithmetic cannot decide so is returned as
//! [`Finding::Undecided`], and the next one takes over: fixed point, then integers.

use crate::refine::{self, Bracket, Refined};
use crate::root::{Count, Root};
use crate::rounding::Evaluator;
use crate::sharp::Sharp;
use crate::subdivision::{Coefficient, crossings, sign_changes};

/// A node narrower than this is given up (its ends need at most 49 bits, so they are exact).
const NARROWEST: f64 = 1.0 / (1_u64 << 44) as f64;

/// Split points, in 32nds: 1/2, and others in turn where the value there is zero or uncertain.
const SPLITS: [u8; 4] = [16, 17, 15, 18];

/// What is known about one place of `[0, 1]`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Finding {
    /// Exactly one root, simple, enclosed to the tolerance.
    Refined { lo: f64, hi: f64 },
    /// Exactly one root, simple; it could not be enclosed to the tolerance.
    Wide { lo: f64, hi: f64 },
    /// At most so many roots; the ends are no roots (except where they are ends of the whole interval).
    Undecided { lo: f64, hi: f64, at_most: u32 },
}

impl Finding {
    pub(crate) const NONE: Self = Self::Undecided {
        lo: 0.0,
        hi: 0.0,
        at_most: 0,
    };

    /// What it says of the roots in its interval.
    pub(crate) fn as_root(&self) -> Root {
        match *self {
            Self::Refined { lo, hi } | Self::Wide { lo, hi } => Root::exactly(lo, hi, 1),
            Self::Undecided { lo, hi, at_most } => Root {
                lo,
                hi,
                count: Count::AtMost(at_most),
            },
        }
    }
}

/// A list of findings in storage that the caller provides.
#[derive(Debug)]
pub(crate) struct Findings<'a> {
    slots: &'a mut [Finding],
    len: usize,
}

impl<'a> Findings<'a> {
    pub(crate) fn new(slots: &'a mut [Finding]) -> Self {
        Self { slots, len: 0 }
    }

    /// Adds a finding; `false` if there is no room.
    pub(crate) fn push(&mut self, finding: Finding) -> bool {
        let Some(slot) = self.slots.get_mut(self.len) else {
            return false;
        };
        *slot = finding;
        self.len += 1;
        true
    }

    pub(crate) fn clear(&mut self) {
        self.len = 0;
    }

    /// Forgets everything but that nothing is known.
    pub(crate) fn give_up(&mut self, degree: usize) {
        self.len = 0;
        self.push(Finding::Undecided {
            lo: 0.0,
            hi: 1.0,
            at_most: degree as u32,
        });
    }

    pub(crate) fn as_slice(&self) -> &[Finding] {
        &self.slots[..self.len]
    }
}

/// An interval whose coefficients have at least one sign change. Both end values have a certain sign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node<C> {
    lo: f64,
    hi: f64,
    /// Bound on the absolute error of each coefficient.
    error: C,
    /// How many roundings went into each coefficient.
    roundings: u32,
    /// The largest number of sign changes that the errors allow.
    changes: u32,
}

impl<C: Coefficient> Node<C> {
    pub(crate) const NONE: Self = Self {
        lo: 0.0,
        hi: 0.0,
        error: C::ZERO,
        roundings: 0,
        changes: 0,
    };
}

/// Nodes waiting at one time: their intervals are disjoint and each has a sign change, so at most the degree of them,
/// and one more while a node is split.
pub(crate) const fn node_capacity(degree: usize) -> usize {
    degree + 2
}

/// Number of coefficients that the rows of all waiting nodes need, with one row to spare.
pub(crate) const fn rows_len(degree: usize) -> usize {
    (node_capacity(degree) + 1) * (degree + 1)
}

/// The two evaluations that refinement works with.
#[derive(Debug)]
pub(crate) struct Values<'a> {
    pub(crate) plain: Evaluator<'a>,
    pub(crate) sharp: Sharp<'a>,
    /// Width to which roots are to be enclosed.
    pub(crate) tolerance: f64,
}

impl Values<'_> {
    fn settle(&mut self, bracket: Bracket, guess: f64) -> Finding {
        let refined = match refine::refine(&self.plain, bracket, guess, self.tolerance) {
            Refined::Stuck { lo, hi, at } => self.sharp.refine(
                &self.plain,
                Bracket { lo, hi, ..bracket },
                at,
                self.tolerance,
            ),
            enclosed => enclosed,
        };
        match refined {
            Refined::Enclosed { lo, hi } => Finding::Refined { lo, hi },
            Refined::Stuck { lo, hi, .. } => Finding::Wide { lo, hi },
        }
    }
}

/// Isolates and refines the roots in the open interval `(0, 1)`.
///
/// The first of the `rows` holds the coefficients, nonzero at both ends, with absolute errors of at most `error` (smaller
/// than the end values); `waiting` has [`node_capacity`] and `rows` [`rows_len`] places.
pub(crate) fn isolate<C: Coefficient>(
    degree: usize,
    error: C,
    values: &mut Values<'_>,
    waiting: &mut [Node<C>],
    rows: &mut [C],
    findings: &mut Findings<'_>,
) {
    let size = degree + 1;
    let changes = sign_changes(&rows[..size], error);
    if changes == 0 {
        return;
    }
    waiting[0] = Node {
        lo: 0.0,
        hi: 1.0,
        error,
        roundings: 0,
        changes,
    };
    let mut len = 1;
    while len > 0 {
        len -= 1;
        let node = waiting[len];
        let (row, rest) = rows[len * size..].split_at_mut(size);
        let undecided = Finding::Undecided {
            lo: node.lo,
            hi: node.hi,
            at_most: node.changes,
        };
        let done = match node.changes {
            1 => {
                let bracket = Bracket {
                    lo: node.lo,
                    hi: node.hi,
                    negative_lo: row[0].is_negative(),
                };
                let mut at = [0.5; 3];
                crossings(row, &mut at);
                findings.push(values.settle(bracket, node.lo + (node.hi - node.lo) * at[0]))
            }
            2 | 3 if sample(row, node, values, findings) => true,
            _ if len + 2 > waiting.len() => findings.push(undecided),
            _ => {
                let (left, rest) = rest.split_at_mut(size);
                match split(row, left, &mut rest[..size], node, &values.plain) {
                    None => findings.push(undecided),
                    Some((left_node, right_node)) => {
                        if right_node.changes > 0 {
                            waiting[len] = right_node;
                            len += 1;
                        } else {
                            row.copy_from_slice(left);
                        }
                        if left_node.changes > 0 {
                            waiting[len] = left_node;
                            len += 1;
                        }
                        true
                    }
                }
            }
        };
        if !done {
            return findings.give_up(degree);
        }
    }
}

/// Splits a node into `left` and (in place) right half; `spare` keeps the parent for a second attempt.
/// `None` where this arithmetic cannot decide.
fn split<C: Coefficient>(
    row: &mut [C],
    left: &mut [C],
    spare: &mut [C],
    node: Node<C>,
    plain: &Evaluator<'_>,
) -> Option<(Node<C>, Node<C>)> {
    let (size, width) = (row.len(), node.hi - node.lo);
    let largest = row
        .iter()
        .fold(C::ZERO, |m, p| if p.exceeds(m) { p.magnitude() } else { m });
    if width < NARROWEST || C::is_noise(largest, node.error) {
        return None;
    }
    // The bound that the subdivision carries along is the same for all coefficients; where it is too coarse, the sum of
    // magnitudes over the interval gives another.
    let tightened = |error: C, roundings: u32, lo: f64, hi: f64| {
        C::tightened(error, roundings, || plain.magnitude_between(lo, hi))
    };
    let child = |row: &[C], lo: f64, hi: f64, error: C, roundings: u32| {
        let uncertain = C::uncertain_signs(row, error) > 0;
        let error = if uncertain {
            tightened(error, roundings, lo, hi)
        } else {
            error
        };
        Node {
            lo,
            hi,
            error,
            roundings,
            changes: sign_changes(row, error),
        }
    };
    spare.copy_from_slice(row);
    for z in SPLITS {
        let middle = node.lo + width * f64::from(z) / 32.0;
        let weighted = z != 16;
        if weighted {
            row.copy_from_slice(spare);
            C::cut(row, left, z);
        } else {
            C::halve(row, left);
        }
        let error = C::error_after(node.error, size, largest, weighted);
        let roundings = node.roundings + if weighted { 2 } else { 1 } * (size as u32 - 1);
        if row[0].exceeds(error) || row[0].exceeds(tightened(error, roundings, middle, middle)) {
            return Some((
                child(left, node.lo, middle, error, roundings),
                child(row, middle, node.hi, error, roundings),
            ));
        }
    }
    None
}

/// The matching lower bound: if `F` alternates at points between the crossings, all roots of the node are separated.
fn sample<C: Coefficient>(
    row: &[C],
    node: Node<C>,
    values: &mut Values<'_>,
    findings: &mut Findings<'_>,
) -> bool {
    let mut at = [0.0; 3];
    if crossings(row, &mut at) != node.changes {
        return false;
    }
    let width = node.hi - node.lo;
    let mut ends = [node.lo, node.hi, node.hi, node.hi];
    let mut negative = row[0].is_negative();
    let inner = node.changes as usize - 1;
    for k in 0..inner {
        let t = node.lo + width * (0.5 * (at[k] + at[k + 1]));
        if values.plain.value(t).is_negative() != Some(!negative) {
            return false;
        }
        negative = !negative;
        ends[k + 1] = t;
    }
    negative = row[0].is_negative();
    for k in 0..=inner {
        let bracket = Bracket {
            lo: ends[k],
            hi: ends[k + 1],
            negative_lo: negative,
        };
        if !findings.push(values.settle(bracket, node.lo + width * at[k])) {
            return false;
        }
        negative = !negative;
    }
    true
}
