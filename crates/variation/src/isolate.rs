//! Isolation in `f64`: subdivision by Descartes' rule of signs, every decision certified.
//!
//! A node is a dyadic subinterval with the coefficients of `F` on it. `V` sign changes bound its roots (Descartes); both
//! have the same parity. The node is dropped at `V = 0`, handed to the refinement at `V = 1`; at `V = 2, 3` the matching
//! *lower* bound is tried first: values of `F` at `V - 1` points between the crossings of the polygon. If their signs
//! alternate, all `V` roots are separated without a subdivision. Otherwise de Casteljau at 1/2.
//!
//! A sign counts only if it exceeds the error bound of its number. What cannot be decided so is returned as
//! [`Finding::Undecided`], and the exact path takes over.

use crate::refine::{self, Bracket, Refined};
use crate::rounding::{Evaluator, HALF_POWERS, U};

/// A node narrower than this is given up in `f64` (its ends need at most 49 bits, so they are exact).
const NARROWEST: f64 = 1.0 / (1_u64 << 44) as f64;

/// Split points tried in turn where the value at 1/2 is zero or uncertain. Dyadic, so `1 - z` is exact.
const SPLITS: [f64; 3] = [17.0 / 32.0, 15.0 / 32.0, 9.0 / 16.0];

/// What is known about one place of `[0, 1]`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Finding {
    /// Exactly one root, simple, enclosed to the tolerance.
    Refined { lo: f64, hi: f64 },
    /// Exactly one root, simple; `f64` cannot enclose it to the tolerance.
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
    fn push(&mut self, finding: Finding) -> bool {
        let Some(slot) = self.slots.get_mut(self.len) else {
            return false;
        };
        *slot = finding;
        self.len += 1;
        true
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

    pub(crate) fn iter(&self) -> std::slice::Iter<'_, Finding> {
        self.slots[..self.len].iter()
    }
}

/// An interval whose coefficients have at least one sign change. Both end values have a certain sign.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    lo: f64,
    hi: f64,
    /// Bound on the absolute error of each coefficient.
    error: f64,
    /// The largest number of sign changes that the errors allow.
    changes: u32,
}

impl Node {
    pub(crate) const NONE: Self = Self {
        lo: 0.0,
        hi: 0.0,
        error: 0.0,
        changes: 0,
    };
}

/// Nodes waiting at one time: their intervals are disjoint and each has a sign change, so at most the degree of them,
/// and one more while a node is split.
pub(crate) const fn node_capacity(degree: usize) -> usize {
    degree + 2
}

/// Number of `f64` that the rows of all waiting nodes need, with one row to spare.
pub(crate) const fn rows_len(degree: usize) -> usize {
    (node_capacity(degree) + 1) * (degree + 1)
}

/// Isolates and refines the roots in the open interval `(0, 1)`.
///
/// `coefficients` are nonzero at both ends, with absolute errors of at most `error` (smaller than the end values);
/// `waiting` and `rows` hold [`node_capacity`] nodes and as many rows of coefficients.
pub(crate) fn isolate(
    coefficients: &[f64],
    error: f64,
    evaluator: &Evaluator<'_>,
    tolerance: f64,
    waiting: &mut [Node],
    rows: &mut [f64],
    findings: &mut Findings<'_>,
) {
    let degree = coefficients.len() - 1;
    let size = degree + 1;
    let changes = sign_changes(coefficients, error);
    if changes == 0 {
        return;
    }
    rows[..size].copy_from_slice(coefficients);
    waiting[0] = Node {
        lo: 0.0,
        hi: 1.0,
        error,
        changes,
    };
    let mut len = 1;
    while len > 0 {
        len -= 1;
        let node = waiting[len];
        let (row, rest) = rows[len * size..].split_at_mut(size);
        let done = match node.changes {
            1 => {
                let bracket = Bracket {
                    lo: node.lo,
                    hi: node.hi,
                    negative_lo: row[0] < 0.0,
                };
                let mut guess = [0.0; 3];
                crossings(row, &mut guess);
                findings.push(settle(
                    evaluator,
                    bracket,
                    node.lo + (node.hi - node.lo) * guess[0],
                    tolerance,
                ))
            }
            2 | 3 if sample(row, node, evaluator, tolerance, findings) => true,
            changes if len + 2 > waiting.len() => findings.push(Finding::Undecided {
                lo: node.lo,
                hi: node.hi,
                at_most: changes,
            }),
            changes => {
                let (left, rest) = rest.split_at_mut(size);
                match split(row, left, &mut rest[..size], node) {
                    None => findings.push(Finding::Undecided {
                        lo: node.lo,
                        hi: node.hi,
                        at_most: changes,
                    }),
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

fn settle(evaluator: &Evaluator<'_>, bracket: Bracket, guess: f64, tolerance: f64) -> Finding {
    match refine::refine(evaluator, bracket, guess, tolerance) {
        Refined::Enclosed { lo, hi } => Finding::Refined { lo, hi },
        Refined::Stuck { lo, hi } => Finding::Wide { lo, hi },
    }
}

/// Splits a node into `left` and (in place) right half; `spare` keeps the parent for a second attempt.
/// `None` where `f64` cannot decide.
fn split(row: &mut [f64], left: &mut [f64], spare: &mut [f64], node: Node) -> Option<(Node, Node)> {
    let width = node.hi - node.lo;
    let largest = row.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
    if width < NARROWEST || largest <= 4.0 * node.error {
        return None;
    }
    let children = |row: &[f64], left: &[f64], z: f64, error: f64| {
        let middle = node.lo + z * width;
        let left = Node {
            lo: node.lo,
            hi: middle,
            error,
            changes: sign_changes(left, error),
        };
        (
            left,
            Node {
                lo: middle,
                hi: node.hi,
                error,
                changes: sign_changes(row, error),
            },
        )
    };
    // Each row rounds once by at most U * largest (averages never grow); one row more pays for rounding this bound.
    let rounding = row.len() as f64 * U * largest;
    spare.copy_from_slice(row);
    halve(row, left);
    if row[0].abs() > node.error + rounding {
        return Some(children(row, left, 0.5, node.error + rounding));
    }
    for z in SPLITS {
        row.copy_from_slice(spare);
        cut(row, left, z);
        // Two products and a sum: at most 2 U * largest a row.
        if row[0].abs() > node.error + 2.0 * rounding {
            return Some(children(row, left, z, node.error + 2.0 * rounding));
        }
    }
    None
}

/// De Casteljau at 1/2, with sums only: row `j` carries a factor `2^j`, taken out at the end (exactly).
fn halve(row: &mut [f64], left: &mut [f64]) {
    let degree = row.len() - 1;
    left[0] = row[0];
    for j in 1..=degree {
        for i in 0..=degree - j {
            row[i] += row[i + 1];
        }
        left[j] = row[0] * HALF_POWERS[j];
    }
    for (value, power) in row.iter_mut().zip(HALF_POWERS[..=degree].iter().rev()) {
        *value *= power;
    }
}

/// De Casteljau at any `z` whose complement is exact.
fn cut(row: &mut [f64], left: &mut [f64], z: f64) {
    let degree = row.len() - 1;
    left[0] = row[0];
    for j in 1..=degree {
        for i in 0..=degree - j {
            row[i] = (1.0 - z) * row[i] + z * row[i + 1];
        }
        left[j] = row[0];
    }
}

/// The largest number of sign changes over all polynomials within `error` of these coefficients.
/// The two end signs are taken as certain. Certain zeros (`error = 0`) are dropped.
fn sign_changes(row: &[f64], error: f64) -> u32 {
    let degree = row.len() - 1;
    let uncertain: u64 = row[1..degree]
        .iter()
        .map(|p| u64::from(p.abs() <= error))
        .sum();
    if uncertain == 0 {
        return row
            .windows(2)
            .map(|p| (p[0].to_bits() ^ p[1].to_bits()) >> 63)
            .sum::<u64>() as u32;
    }
    // The most changes that end in a positive and in a negative sign.
    let (mut positive, mut negative) = if row[0] > 0.0 {
        (0, i32::MIN)
    } else {
        (i32::MIN, 0)
    };
    for (i, &p) in row.iter().enumerate().skip(1) {
        let (from_negative, from_positive) =
            (negative.saturating_add(1), positive.saturating_add(1));
        if p.abs() > error || i == degree {
            if p > 0.0 {
                (positive, negative) = (positive.max(from_negative), i32::MIN);
            } else {
                (positive, negative) = (i32::MIN, negative.max(from_positive));
            }
        } else if error > 0.0 {
            (positive, negative) = (positive.max(from_negative), negative.max(from_positive));
        }
    }
    positive.max(negative) as u32
}

/// Where the control polygon crosses zero, as shares of the node; at most three are stored, all are counted.
fn crossings(row: &[f64], at: &mut [f64; 3]) -> u32 {
    let mut count = 0;
    let scale = 1.0 / (row.len() - 1) as f64;
    for (i, p) in row.windows(2).enumerate() {
        if (p[0] < 0.0) != (p[1] < 0.0) {
            if let Some(at) = at.get_mut(count) {
                *at = (i as f64 + p[0] / (p[0] - p[1])) * scale;
            }
            count += 1;
        }
    }
    count as u32
}

/// The matching lower bound: if `F` alternates at points between the crossings, all roots of the node are separated.
fn sample(
    row: &[f64],
    node: Node,
    evaluator: &Evaluator<'_>,
    tolerance: f64,
    findings: &mut Findings<'_>,
) -> bool {
    let mut at = [0.0; 3];
    if crossings(row, &mut at) != node.changes {
        return false;
    }
    let width = node.hi - node.lo;
    let mut ends = [node.lo, node.hi, node.hi, node.hi];
    let mut negative = row[0] < 0.0;
    let inner = node.changes as usize - 1;
    for k in 0..inner {
        let t = node.lo + width * (0.5 * (at[k] + at[k + 1]));
        if evaluator.value(t).is_negative() != Some(!negative) {
            return false;
        }
        negative = !negative;
        ends[k + 1] = t;
    }
    negative = row[0] < 0.0;
    for k in 0..=inner {
        let bracket = Bracket {
            lo: ends[k],
            hi: ends[k + 1],
            negative_lo: negative,
        };
        if !findings.push(settle(
            evaluator,
            bracket,
            node.lo + width * at[k],
            tolerance,
        )) {
            return false;
        }
        negative = !negative;
    }
    true
}
