//! Sums of two `f64`: twice the digits, by operations whose rounding errors are computed without error.
//!
//! T. J. Dekker, *A floating-point technique for extending the available precision*, Numer. Math. 18 (1971). No fused
//! multiply-add, which not every processor has. Exact unless something overflows or underflows.

use crate::rounding::{BINOMIAL_RESTS, BINOMIALS, U};

/// `2^27 + 1`, which splits a number into two halves (Veltkamp).
const SPLITTER: f64 = 134_217_729.0;

/// A number as a rounded one and what that is short of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Twofold {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

/// `a + b` and its rounding error (Knuth).
#[inline]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// Two numbers of at most 26 bits with the sum `a`.
#[inline]
pub(crate) fn halves(a: f64) -> (f64, f64) {
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// `a * b` and its rounding error (Dekker), with `b` split beforehand.
#[inline]
pub(crate) fn two_product(a: f64, b: f64, (b_high, b_low): (f64, f64)) -> (f64, f64) {
    let product = a * b;
    let (a_high, a_low) = halves(a);
    (
        product,
        a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low),
    )
}

impl Twofold {
    /// Relative error of [`Twofold::times_binomial`] and [`Twofold::over_binomial`] together, several times over.
    pub(crate) const ERROR: f64 = 64.0 * U * U;

    /// `p C(n, i)`, to two roundings of the low part.
    pub(crate) fn times_binomial(p: f64, n: usize, i: usize) -> Self {
        let (binomial, rest) = (BINOMIALS[n][i], BINOMIAL_RESTS[n][i]);
        let (high, low) = two_product(p, binomial, halves(binomial));
        Self {
            high,
            low: low + p * rest,
        }
    }

    /// `self / C(n, i)`: one step of long division, to six roundings of the low part.
    pub(crate) fn over_binomial(self, n: usize, i: usize) -> Self {
        let (binomial, rest) = (BINOMIALS[n][i], BINOMIAL_RESTS[n][i]);
        let high = self.high / binomial;
        let (product, error) = two_product(high, binomial, halves(binomial));
        let remainder = ((self.high - product) - error) + (self.low - high * rest);
        Self {
            high,
            low: remainder / binomial,
        }
    }
}

/// Sums and products, which only the judge needs.
#[cfg(feature = "exact")]
impl Twofold {
    pub(crate) const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };

    /// Error of [`Twofold::plus`], [`Twofold::minus`] and [`Twofold::times`], relative to the sum of the magnitudes, or to
    /// the product: at most eight roundings of numbers that are themselves roundings, and as much again.
    pub(crate) const ROUNDING: f64 = 16.0 * U * U;

    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }

    /// Of one number.
    pub(crate) fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let (sum, error) = two_sum(self.high, other.high);
        Self::renormalised(sum, error + (self.low + other.low))
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(Self {
            high: -other.high,
            low: -other.low,
        })
    }

    pub(crate) fn times(self, other: Self) -> Self {
        let (product, error) = two_product(self.high, other.high, halves(other.high));
        Self::renormalised(
            product,
            error + (self.high * other.low + self.low * other.high),
        )
    }

    /// Times a power of two, which is exact.
    pub(crate) fn scaled(self, power: f64) -> Self {
        Self {
            high: self.high * power,
            low: self.low * power,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_undo_products() {
        for (n, i) in [(5, 2), (20, 9), (56, 28), (64, 32)] {
            let p = 1.0 / 3.0;
            let back = Twofold::times_binomial(p, n, i).over_binomial(n, i);
            let (difference, rest) = two_sum(back.high, -p);
            assert!(
                (difference + (rest + back.low)).abs() <= Twofold::ERROR * p,
                "{n} {i}"
            );
        }
    }
}
