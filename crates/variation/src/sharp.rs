//! Evaluation as if in twice the precision of `f64`: compensated Horner.
//!
//! S. Graillat, Ph. Langlois, N. Louvet, *Algorithms for accurate, validated and fast polynomial evaluation*, Japan J. Indust.
//! Appl. Math. 26 (2009): the rounding errors of Horner's scheme are themselves computed without error and summed by a second
//! scheme. The scaled coefficients `C(n,i) p_i` are kept as unevaluated sums of two numbers, and `u = t / (1-t)` is the
//! variable, chosen in `f64`; only the final ends are mapped back to `t`, outward.

use crate::input::Input;
use crate::refine::{Bracket, Refined};
use crate::rounding::{Bounded, Evaluator, U};
use crate::twofold::{halves, two_product, two_sum};

/// Secant steps; convergence takes three or four.
const MAX_STEPS: usize = 24;

/// The scaled coefficients to twice the precision, formed when first needed.
#[derive(Debug)]
pub(crate) struct Sharp<'a> {
    /// `None` where only rounded coefficients are known.
    input: Option<Input<'a>>,
    store: &'a mut [f64],
    ready: bool,
}

/// Number of `f64` that a [`Sharp`] of this degree stores.
pub(crate) const fn sharp_len(degree: usize) -> usize {
    2 * (degree + 1)
}

/// One variable for each half of the interval: `u = t / (1-t)`, or `(1-t) / t` for the upper half.
#[derive(Clone, Copy, Debug)]
struct Side {
    upper: bool,
}

impl Side {
    fn of(t: f64) -> Self {
        Self { upper: t > 0.5 }
    }

    fn variable(self, t: f64) -> f64 {
        if self.upper {
            (1.0 - t) / t
        } else {
            t / (1.0 - t)
        }
    }

    /// `t`, to three roundings.
    fn parameter(self, u: f64) -> f64 {
        if self.upper {
            1.0 / (1.0 + u)
        } else {
            u / (1.0 + u)
        }
    }

    fn parameter_below(self, u: f64) -> f64 {
        self.parameter(u) * (1.0 - 4.0 * U)
    }

    fn parameter_above(self, u: f64) -> f64 {
        self.parameter(u) * (1.0 + 4.0 * U)
    }
}

impl<'a> Sharp<'a> {
    pub(crate) fn new(input: Option<Input<'a>>, store: &'a mut [f64]) -> Self {
        Self {
            input,
            store,
            ready: false,
        }
    }

    fn prepare(&mut self) -> bool {
        let Some(input) = self.input else {
            return false;
        };
        if !self.ready {
            let (high, low) = self.store.split_at_mut(input.inner().len());
            for (k, (high, low)) in high.iter_mut().zip(low).enumerate() {
                let Some(c) = input.scaled(k) else {
                    return false;
                };
                (*high, *low) = (c.high, c.low);
            }
            self.ready = true;
        }
        true
    }

    /// `sum c_i u^i` (or backwards), up to the positive factor that `u` leaves out.
    fn value(&self, side: Side, u: f64) -> Bounded {
        let size = self.store.len() / 2;
        let (high, low) = self.store.split_at(size);
        let (sum, correction, magnitude) = if side.upper {
            compensated(high.iter().zip(low), u)
        } else {
            compensated(high.iter().zip(low).rev(), u)
        };
        let value = sum + correction;
        let n = size as f64;
        // The bound of the paper, gamma_2n^2 times the magnitudes, with one term more for the low parts.
        let bound = 2.0 * U * value.abs()
            + (2.0 * n + 4.0) * (2.0 * n + 4.0) * U * U * magnitude
            + f64::MIN_POSITIVE * n;
        Bounded { value, bound }
    }

    /// Continues a refinement that plain `f64` gave up.
    pub(crate) fn refine(
        &mut self,
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
        if !self.prepare() {
            return Refined::Stuck { lo, hi, at: guess };
        }
        let guess = if guess > lo && guess < hi {
            guess
        } else {
            0.5 * (lo + hi)
        };
        let side = Side::of(guess);
        let mut u = side.variable(guess);
        let mut at = self.value(side, u);
        let mut slope = evaluator.slope_in_side(guess);
        for _ in 0..MAX_STEPS {
            let newton = at.value / slope;
            // dt / du
            let scale = 1.0 / ((1.0 + u) * (1.0 + u));
            let widest = 0.45 * tolerance / scale;
            if newton.abs() < 0.25 * widest {
                let noise = 2.0 * (at.bound / slope).abs() + 4.0 * U * u;
                let enclosed = self
                    .enclose(
                        side,
                        u - newton,
                        (0.25 * newton.abs() + noise).min(widest),
                        bracket,
                    )
                    .or_else(|| self.enclose(side, u - newton, widest, bracket));
                if let Some(refined) = enclosed {
                    return refined;
                }
            }
            let Some(negative) = at.is_negative() else {
                break;
            };
            let t = side.parameter(u);
            if negative == negative_lo {
                lo = lo.max(t);
            } else {
                hi = hi.min(t);
            }
            let mut next = u - newton;
            let t = side.parameter(next);
            if !(t > lo && t < hi) {
                next = side.variable(0.5 * (lo + hi));
            }
            let value = self.value(side, next);
            let secant = (value.value - at.value) / (next - u);
            if secant.is_finite() && secant != 0.0 {
                slope = secant;
            }
            (u, at) = (next, value);
        }
        let scale = 1.0 / ((1.0 + u) * (1.0 + u));
        self.enclose(side, u, 0.45 * tolerance / scale, bracket)
            .unwrap_or(Refined::Stuck {
                lo: bracket.lo,
                hi: bracket.hi,
                at: side.parameter(u),
            })
    }

    /// An enclosure between two certain and opposite signs, inside the bracket.
    fn enclose(&self, side: Side, u: f64, reach: f64, bracket: Bracket) -> Option<Refined> {
        let (near, far) = (u - reach, u + reach);
        if near <= 0.0 {
            return None;
        }
        let (left, right) = if side.upper { (far, near) } else { (near, far) };
        let (mut lo, mut hi) = (side.parameter_below(left), side.parameter_above(right));
        if lo <= bracket.lo {
            lo = bracket.lo;
        } else if self.value(side, left).is_negative() != Some(bracket.negative_lo) {
            return None;
        }
        if hi >= bracket.hi {
            hi = bracket.hi;
        } else if self.value(side, right).is_negative() != Some(!bracket.negative_lo) {
            return None;
        }
        Some(Refined::Enclosed { lo, hi })
    }
}

/// Horner's sum, the sum of its errors, and the sum of magnitudes.
#[inline]
fn compensated<'c>(terms: impl Iterator<Item = (&'c f64, &'c f64)>, u: f64) -> (f64, f64, f64) {
    let u_halves = halves(u);
    let (mut sum, mut correction, mut magnitude) = (0.0, 0.0, 0.0);
    for (high, low) in terms {
        let (product, product_error) = two_product(sum, u, u_halves);
        let (next, sum_error) = two_sum(product, *high);
        sum = next;
        correction = correction * u + (product_error + (sum_error + low));
        magnitude = magnitude * u + high.abs();
    }
    (sum, correction, magnitude)
}
