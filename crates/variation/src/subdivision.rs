//! De Casteljau's subdivision with an error bound, in `f64` and in 128-bit fixed point.
//!
//! Fixed point is the second tier: 120 bits instead of 53 for four times the work, still without allocation. Both
//! arithmetics round once a row, both count sign changes over all completions of the signs that they cannot decide.

use crate::rounding::{HALF_POWERS, U, exponent_of, power_of_two};
use crate::twofold::Twofold;

/// A coefficient in one of the two arithmetics.
pub(crate) trait Coefficient: Copy {
    const ZERO: Self;
    fn is_negative(self) -> bool;
    fn magnitude(self) -> Self;
    /// Whether the magnitude is above `error`: the sign is certain.
    fn exceeds(self, error: Self) -> bool;
    /// The error after a subdivision into halves (`weighted = false`) or at another point, of `size` coefficients.
    fn error_after(error: Self, size: usize, largest: Self, weighted: bool) -> Self;
    /// Another bound on the error, from the number of roundings and a bound on the sum of magnitudes that were rounded.
    fn tightened(error: Self, roundings: u32, magnitude: impl FnOnce() -> f64) -> Self;
    /// Whether coefficients of this size are mere rounding errors.
    fn is_noise(largest: Self, error: Self) -> bool;
    /// Where the line from `self` at 0 to `next` at 1 crosses zero; the signs differ.
    fn crossing(self, next: Self) -> f64;
    /// Splits at 1/2: `row` becomes the right half.
    fn halve(row: &mut [Self], left: &mut [Self]);
    /// Splits at `z / 32`.
    fn cut(row: &mut [Self], left: &mut [Self], z: u8);
    /// Sign changes of a row whose signs are all certain.
    fn certain_sign_changes(row: &[Self]) -> u32;
    /// How many inner coefficients have no certain sign.
    fn uncertain_signs(row: &[Self], error: Self) -> usize;
}

impl Coefficient for f64 {
    const ZERO: Self = 0.0;

    #[inline]
    fn is_negative(self) -> bool {
        self < 0.0
    }

    #[inline]
    fn magnitude(self) -> Self {
        self.abs()
    }

    #[inline]
    fn exceeds(self, error: Self) -> bool {
        self.abs() > error
    }

    /// Each row rounds once by at most `U * largest`, since averages never grow (with weights: two products and a sum, at
    /// most `2 U * largest`). One row more than there are pays for rounding the bound.
    #[inline]
    fn error_after(error: Self, size: usize, largest: Self, weighted: bool) -> Self {
        let rounding = size as f64 * U * largest;
        error + if weighted { 2.0 * rounding } else { rounding }
    }

    /// A coefficient is a sum of the given ones with positive weights, each term rounded so many times.
    fn tightened(error: Self, roundings: u32, magnitude: impl FnOnce() -> f64) -> Self {
        let bound = f64::from(roundings + 1) * U * magnitude();
        if bound < error { bound } else { error }
    }

    #[inline]
    fn is_noise(largest: Self, error: Self) -> bool {
        largest <= 4.0 * error
    }

    #[inline]
    fn crossing(self, next: Self) -> f64 {
        self / (self - next)
    }

    /// Sums only: row `j` carries a factor `2^j`, taken out at the end without rounding.
    #[inline]
    fn halve(row: &mut [Self], left: &mut [Self]) {
        let degree = row.len() - 1;
        left[0] = row[0];
        for (j, slot) in left.iter_mut().enumerate().skip(1) {
            for i in 0..=degree - j {
                row[i] += row[i + 1];
            }
            *slot = row[0] * HALF_POWERS[j];
        }
        for (value, power) in row.iter_mut().zip(HALF_POWERS[..=degree].iter().rev()) {
            *value *= power;
        }
    }

    fn cut(row: &mut [Self], left: &mut [Self], z: u8) {
        let degree = row.len() - 1;
        let z = f64::from(z) / 32.0;
        left[0] = row[0];
        for (j, slot) in left.iter_mut().enumerate().skip(1) {
            for i in 0..=degree - j {
                row[i] = (1.0 - z) * row[i] + z * row[i + 1];
            }
            *slot = row[0];
        }
    }

    #[inline]
    fn certain_sign_changes(row: &[Self]) -> u32 {
        row.windows(2)
            .map(|p| (p[0].to_bits() ^ p[1].to_bits()) >> 63)
            .sum::<u64>() as u32
    }

    #[inline]
    fn uncertain_signs(row: &[Self], error: Self) -> usize {
        row[1..row.len() - 1]
            .iter()
            .map(|p| u64::from(p.abs() <= error))
            .sum::<u64>() as usize
    }
}

/// Bits of a fixed-point coefficient: seven are left for the sign and for the weights of [`Coefficient::cut`].
const FIXED_BITS: i32 = 120;

/// Writes coefficients in units of `2^-FIXED_BITS` of a power of two above the largest; returns the error of each.
/// `relative` bounds the relative error of those given.
pub(crate) fn to_fixed(
    coefficients: impl Iterator<Item = Twofold> + Clone,
    relative: f64,
    row: &mut [i128],
) -> i128 {
    let largest = coefficients
        .clone()
        .fold(0.0_f64, |m, p| m.max(p.high.abs()));
    let unit = exponent_of(largest) + 1 - FIXED_BITS;
    let mut error = 0;
    for (fixed, p) in row.iter_mut().zip(coefficients) {
        let (high, low) = (in_units(p.high, unit), in_units(p.low, unit));
        *fixed = high.0 + low.0;
        error = error.max(high.1 + low.1);
    }
    error + (relative * power_of_two(FIXED_BITS)).ceil() as i128
}

/// `p` in units of `2^unit`, and the error, 0 or 1: digits below the unit are cut off.
fn in_units(p: f64, unit: i32) -> (i128, i128) {
    let bits = p.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = i128::from(bits & ((1 << 52) - 1));
    let (mantissa, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, biased - 1075)
    };
    let shift = exponent - unit;
    let (magnitude, error) = if shift >= 0 {
        (mantissa << shift, 0)
    } else {
        let kept = mantissa >> (-shift).min(127);
        (kept, i128::from(kept << (-shift).min(63) != mantissa))
    };
    (if p < 0.0 { -magnitude } else { magnitude }, error)
}

impl Coefficient for i128 {
    const ZERO: Self = 0;

    fn is_negative(self) -> bool {
        self < 0
    }

    fn magnitude(self) -> Self {
        self.abs()
    }

    fn exceeds(self, error: Self) -> bool {
        self.abs() > error
    }

    /// Each row is rounded down by less than one unit.
    fn error_after(error: Self, size: usize, _: Self, _: bool) -> Self {
        error + size as i128
    }

    fn tightened(error: Self, _: u32, _: impl FnOnce() -> f64) -> Self {
        error
    }

    fn is_noise(largest: Self, error: Self) -> bool {
        largest <= 4 * error
    }

    fn crossing(self, next: Self) -> f64 {
        let (a, b) = (self as f64, next as f64);
        a / (a - b)
    }

    fn halve(row: &mut [Self], left: &mut [Self]) {
        let degree = row.len() - 1;
        left[0] = row[0];
        for (j, slot) in left.iter_mut().enumerate().skip(1) {
            for i in 0..=degree - j {
                row[i] = (row[i] + row[i + 1]) >> 1;
            }
            *slot = row[0];
        }
    }

    fn cut(row: &mut [Self], left: &mut [Self], z: u8) {
        let degree = row.len() - 1;
        let z = i128::from(z);
        left[0] = row[0];
        for (j, slot) in left.iter_mut().enumerate().skip(1) {
            for i in 0..=degree - j {
                row[i] = (row[i] * (32 - z) + row[i + 1] * z) >> 5;
            }
            *slot = row[0];
        }
    }

    fn certain_sign_changes(row: &[Self]) -> u32 {
        row.windows(2).map(|p| u32::from((p[0] ^ p[1]) < 0)).sum()
    }

    fn uncertain_signs(row: &[Self], error: Self) -> usize {
        row[1..row.len() - 1]
            .iter()
            .filter(|p| p.abs() <= error)
            .count()
    }
}

/// The largest number of sign changes over all polynomials within `error` of these coefficients.
/// The two end signs are taken as certain. Certain zeros (`error = 0`) are dropped.
pub(crate) fn sign_changes<C: Coefficient>(row: &[C], error: C) -> u32 {
    if row.len() == 1 || C::uncertain_signs(row, error) == 0 {
        return C::certain_sign_changes(row);
    }
    let degree = row.len() - 1;
    let certain_zeros = !error.exceeds(C::ZERO);
    // The most changes that end in a positive and in a negative sign.
    let (mut positive, mut negative) = if row[0].is_negative() {
        (i32::MIN, 0)
    } else {
        (0, i32::MIN)
    };
    for (i, &p) in row.iter().enumerate().skip(1) {
        let (from_negative, from_positive) =
            (negative.saturating_add(1), positive.saturating_add(1));
        if p.exceeds(error) || i == degree {
            (positive, negative) = if p.is_negative() {
                (i32::MIN, negative.max(from_positive))
            } else {
                (positive.max(from_negative), i32::MIN)
            };
        } else if !certain_zeros {
            (positive, negative) = (positive.max(from_negative), negative.max(from_positive));
        }
    }
    positive.max(negative).max(0) as u32
}

/// Where the control polygon crosses zero, in `[0, 1]`; at most three are stored, all are counted.
pub(crate) fn crossings<C: Coefficient>(row: &[C], at: &mut [f64; 3]) -> u32 {
    let mut count = 0;
    let scale = 1.0 / (row.len() - 1) as f64;
    for (i, p) in row.windows(2).enumerate() {
        if p[0].is_negative() != p[1].is_negative() {
            if let Some(at) = at.get_mut(count) {
                *at = (i as f64 + p[0].crossing(p[1])) * scale;
            }
            count += 1;
        }
    }
    count as u32
}
