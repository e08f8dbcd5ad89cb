//! Numbers `m 2^e` with integers `m`: every `f64`, and what sums and products make of them.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;

use crate::arithmetic::Number;
use crate::twofold::Twofold;

/// A number `numerator / 2^exponent`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dyadic {
    pub(crate) numerator: BigInt,
    pub(crate) exponent: u64,
}

/// A number `mantissa * 2^exponent`, for forming polynomials without rounding.
#[derive(Clone, Debug)]
pub(crate) struct Exact {
    mantissa: BigInt,
    exponent: i64,
}

impl Exact {
    fn combined(&self, other: &Self, combine: impl Fn(BigInt, BigInt) -> BigInt) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let aligned = |x: &Self| &x.mantissa << (x.exponent - exponent).unsigned_abs();
        Self {
            mantissa: combine(aligned(self), aligned(other)),
            exponent,
        }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.mantissa == BigInt::ZERO
    }

    /// To twice the digits of `f64`.
    pub(crate) fn twofold(&self) -> Twofold {
        let high = self.nearest();
        Twofold {
            high,
            low: self.difference(&Self::exactly(high)).nearest(),
        }
    }

    /// The nearest `f64`, unless that is subnormal.
    pub(crate) fn nearest(&self) -> f64 {
        let shift = self.mantissa.bits().saturating_sub(64);
        let top = (self.mantissa.magnitude() >> shift)
            .iter_u64_digits()
            .next()
            .unwrap_or(0);
        // Bits below the 64 kept only matter as "more than a half": one sticky bit stands for them.
        let sticky = self
            .mantissa
            .trailing_zeros()
            .is_some_and(|zeros| zeros < shift);
        let magnitude = scale_by_power(
            (top | u64::from(sticky)) as f64,
            self.exponent + shift as i64,
        );
        if self.mantissa.sign() == Sign::Minus {
            -magnitude
        } else {
            magnitude
        }
    }

    /// For a number of `[0, 1]`: itself and its complement to 1, in the same unit.
    pub(crate) fn share(&self) -> (BigInt, BigInt) {
        let unit = BigInt::from(1) << self.exponent.min(0).unsigned_abs();
        let own = &self.mantissa << self.exponent.max(0).unsigned_abs();
        let complement = unit - &own;
        (own, complement)
    }

    pub(crate) fn to_rational(&self) -> BigRational {
        if self.exponent >= 0 {
            BigRational::from(&self.mantissa << self.exponent.unsigned_abs())
        } else {
            BigRational::new(
                self.mantissa.clone(),
                BigInt::from(1) << self.exponent.unsigned_abs(),
            )
        }
    }
}

impl Number for Exact {
    fn exactly(x: f64) -> Self {
        let (mantissa, exponent) = reduced(x);
        Self {
            mantissa: BigInt::from(mantissa),
            exponent: i64::from(exponent),
        }
    }

    fn sum(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a + b)
    }

    fn difference(&self, other: &Self) -> Self {
        self.combined(other, |a, b| a - b)
    }

    fn product(&self, other: &Self) -> Self {
        Self {
            mantissa: &self.mantissa * &other.mantissa,
            exponent: self.exponent + other.exponent,
        }
    }

    fn times(&self, factor: u128) -> Self {
        Self {
            mantissa: &self.mantissa * factor,
            exponent: self.exponent,
        }
    }
}

/// A positive multiple of the list, in integers.
pub(crate) fn common_integers(values: &[Exact]) -> Vec<BigInt> {
    let nonzero = values.iter().filter(|v| !v.is_zero());
    let exponent = nonzero.map(|v| v.exponent).min().unwrap_or(0);
    values
        .iter()
        .map(|v| {
            if v.is_zero() {
                BigInt::ZERO
            } else {
                &v.mantissa << (v.exponent - exponent).unsigned_abs()
            }
        })
        .collect()
}
/// The mantissa and the exponent of a finite `f64`: the value is `mantissa * 2^exponent`.
fn decode(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) = if biased == 0 {
        (fraction, -1074)
    } else {
        (fraction | (1 << 52), biased - 1075)
    };
    (if x < 0.0 { -mantissa } else { mantissa }, exponent)
}

/// As [`decode`], with an odd mantissa.
fn reduced(x: f64) -> (i64, i32) {
    let (mantissa, exponent) = decode(x);
    if mantissa == 0 {
        return (0, 0);
    }
    let zeros = mantissa.trailing_zeros();
    (mantissa >> zeros, exponent + zeros as i32)
}
impl Dyadic {
    pub(crate) fn from_f64(x: f64) -> Self {
        let (mantissa, exponent) = reduced(x);
        if exponent >= 0 {
            Self {
                numerator: BigInt::from(mantissa) << exponent.unsigned_abs(),
                exponent: 0,
            }
        } else {
            Self {
                numerator: BigInt::from(mantissa),
                exponent: u64::from(exponent.unsigned_abs()),
            }
        }
    }

    /// `lo + (hi - lo) * numerator / 2^exponent`.
    pub(crate) fn between(lo: &Self, hi: &Self, numerator: &BigInt, exponent: u64) -> Self {
        let common = lo.exponent.max(hi.exponent);
        let lo = &lo.numerator << (common - lo.exponent);
        let hi = &hi.numerator << (common - hi.exponent);
        Self {
            numerator: (&lo << exponent) + (hi - lo) * numerator,
            exponent: common + exponent,
        }
    }

    pub(crate) fn to_rational(&self) -> BigRational {
        BigRational::new(self.numerator.clone(), BigInt::from(1) << self.exponent)
    }

    /// The nearest `f64` that is not above (`up = false`) or not below (`up = true`).
    pub(crate) fn to_f64(&self, up: bool) -> f64 {
        round(&self.numerator, self.exponent, up)
    }
}

/// `numerator / 2^exponent` rounded down or up.
fn round(numerator: &BigInt, exponent: u64, up: bool) -> f64 {
    let bits = numerator.bits();
    if bits == 0 {
        return 0.0;
    }
    // Keep 53 bits, or fewer where the result is subnormal.
    let lowest = (bits as i64 - 53).max(exponent as i64 - 1074);
    let kept = if lowest > 0 {
        numerator.magnitude() >> lowest as u64
    } else {
        numerator.magnitude().clone()
    };
    let exact = lowest <= 0
        || numerator
            .magnitude()
            .trailing_zeros()
            .is_some_and(|z| z >= lowest as u64);
    let mantissa = kept.iter_u64_digits().next().unwrap_or(0);
    let scale = lowest.max(0) - exponent as i64;
    let magnitude = scale_by_power(mantissa as f64, scale);
    let negative = numerator.sign() == Sign::Minus;
    let value = if negative { -magnitude } else { magnitude };
    match (exact, up) {
        (true, _) => value,
        (false, true) if negative => value,
        (false, true) => value.next_up(),
        (false, false) if negative => value.next_down(),
        (false, false) => value,
    }
}

/// `x * 2^exponent`, exact unless it leaves the range.
pub(crate) fn scale_by_power(mut x: f64, mut exponent: i64) -> f64 {
    while exponent > 1000 && x.is_finite() {
        x *= 2.0_f64.powi(1000);
        exponent -= 1000;
    }
    while exponent < -1000 && x != 0.0 {
        x *= 2.0_f64.powi(-1000);
        exponent += 1000;
    }
    x * 2.0_f64.powi(exponent.clamp(-1000, 1000) as i32)
}

/// A value as `mantissa * 2^exponent`, for ratios of numbers beyond the range of `f64`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Float {
    pub(crate) mantissa: f64,
    exponent: i64,
}

impl Float {
    pub(crate) fn new(value: &BigInt, denominator_bits: u64) -> Self {
        let shift = value.bits().saturating_sub(60);
        let top = (value.magnitude() >> shift)
            .iter_u64_digits()
            .next()
            .unwrap_or(0) as f64;
        let mantissa = if value.sign() == Sign::Minus {
            -top
        } else {
            top
        };
        Self {
            mantissa,
            exponent: shift as i64 - denominator_bits as i64,
        }
    }

    /// `a / (a - b)` for opposite signs: where the chord from `a` at 0 to `b` at 1 crosses zero.
    pub(crate) fn chord(a: Self, b: Self) -> f64 {
        let exponent = a.exponent.max(b.exponent);
        let a = scale_by_power(a.mantissa, (a.exponent - exponent).max(-2000));
        let b = scale_by_power(b.mantissa, (b.exponent - exponent).max(-2000));
        a / (a - b)
    }

    pub(crate) fn halved(self) -> Self {
        Self {
            mantissa: 0.5 * self.mantissa,
            ..self
        }
    }
}
