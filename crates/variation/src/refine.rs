//! Refinement of one isolated simple root: Newton's method that cannot leave its bracket, closed by two certain signs.

use crate::rounding::{Evaluator, U};

/// More steps than this only occur where `f64` has nothing more to say.
const MAX_STEPS: usize = 48;

/// A bracket of exactly one root, simple. The ends are given with the sign of `F` just inside them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bracket {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) negative_lo: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) enum Refined {
    /// Enclosed to the tolerance.
    Enclosed { lo: f64, hi: f64 },
    /// The signs that could be decided leave this bracket; the root is probably near `at`.
    Stuck { lo: f64, hi: f64, at: f64 },
}

/// Shrinks the bracket to at most `tolerance`, starting from `guess`.
pub(crate) fn refine(
    evaluator: &Evaluator<'_>,
    bracket: Bracket,
    guess: f64,
    tolerance: f64,
) -> Refined {
    let Bracket {
        mut lo,
        mut hi,
        negative_lo,
    } = bracket;
    // Root spacing is about the width of the bracket, so a Newton step of length d leaves an error of about d^2 / width.
    let curvature = 2.0 / (hi - lo);
    let mut x = if guess > lo && guess < hi {
        guess
    } else {
        0.5 * (lo + hi)
    };
    for _ in 0..MAX_STEPS {
        let local = evaluator.local(x);
        let Some(negative) = local.at.is_negative() else {
            break;
        };
        if negative == negative_lo {
            lo = x;
        } else {
            hi = x;
        }
        let step = local.at.value / local.slope;
        let next = x - step;
        if !(next > lo && next < hi) {
            // Also where the slope vanishes: the comparison refuses NaN.
            x = 0.5 * (lo + hi);
            if !(x > lo && x < hi) {
                break;
            }
            continue;
        }
        x = next;
        let error = step * step * curvature;
        if error < 0.125 * tolerance {
            let noise = 2.0 * (local.at.bound / local.slope).abs() + 4.0 * U * x;
            let reach = (noise + error).min(0.499 * tolerance);
            if let Some((lo, hi)) = enclose(evaluator, x, reach, negative_lo, &mut lo, &mut hi) {
                return Refined::Enclosed { lo, hi };
            }
        }
    }
    // The value at x is within its error bound: the widest enclosure that is still accepted is the last attempt.
    match enclose(
        evaluator,
        x,
        0.499 * tolerance,
        negative_lo,
        &mut lo,
        &mut hi,
    ) {
        Some((lo, hi)) => Refined::Enclosed { lo, hi },
        None if hi - lo <= tolerance => Refined::Enclosed { lo, hi },
        None => Refined::Stuck { lo, hi, at: x },
    }
}

/// Whether the root lies within `reach` of `x`, by certain signs; every certain sign tightens the bracket.
fn enclose(
    evaluator: &Evaluator<'_>,
    x: f64,
    reach: f64,
    negative_lo: bool,
    lo: &mut f64,
    hi: &mut f64,
) -> Option<(f64, f64)> {
    let (left, right) = (x - reach, x + reach);
    for t in [left, right] {
        if t > *lo && t < *hi {
            match evaluator.value(t).is_negative() {
                Some(negative) if negative == negative_lo => *lo = t,
                Some(_) => *hi = t,
                None => {}
            }
        }
    }
    (*lo >= left && *hi <= right).then_some((*lo, *hi))
}
