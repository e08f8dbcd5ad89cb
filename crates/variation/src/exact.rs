//! Exact arithmetic: what `f64` cannot decide is decided here, on integers.
//!
//! `sum c_i t^i (1-t)^(n-i)` with integers `c_i` is the ordinary polynomial `sum c_i x^i` at `x = t / (1-t)`, with the same
//! multiplicities. A square-free decomposition (Yun) separates the multiplicities, Descartes' rule with exact bisection
//! the roots of each factor, and exact values at `f64` points enclose each root as tightly as asked.

use num_bigint::{BigInt, BigUint, Sign};
use num_rational::BigRational;

use crate::arithmetic::Number;
use crate::rational::ExactRoot;
use crate::root::Root;

/// A nonzero polynomial with integer coefficients `c_i` of `t^i (1-t)^(n-i)`, nonzero at both ends.
#[derive(Clone, Debug)]
struct Homogeneous {
    coefficients: Vec<BigInt>,
}

/// A number `numerator / 2^exponent`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Dyadic {
    numerator: BigInt,
    exponent: u64,
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
}

impl Exact {
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
    let nonzero = values.iter().filter(|v| v.mantissa != BigInt::ZERO);
    let exponent = nonzero.map(|v| v.exponent).min().unwrap_or(0);
    values
        .iter()
        .map(|v| {
            if v.mantissa == BigInt::ZERO {
                BigInt::ZERO
            } else {
                &v.mantissa << (v.exponent - exponent).unsigned_abs()
            }
        })
        .collect()
}

/// A root of one polynomial, as exact as its ends: simple roots of square-free factors.
#[derive(Clone, Debug)]
struct Isolated {
    lo: Dyadic,
    hi: Dyadic,
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

/// `C(n, 0..=n)`.
pub(crate) fn binomials(n: usize) -> Vec<BigInt> {
    let mut row = vec![BigInt::from(1)];
    for i in 0..n {
        let next = &row[i] * (n - i) / (i + 1);
        row.push(next);
    }
    row
}

impl Dyadic {
    fn from_f64(x: f64) -> Self {
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
    fn between(lo: &Self, hi: &Self, numerator: &BigInt, exponent: u64) -> Self {
        let common = lo.exponent.max(hi.exponent);
        let lo = &lo.numerator << (common - lo.exponent);
        let hi = &hi.numerator << (common - hi.exponent);
        Self {
            numerator: (&lo << exponent) + (hi - lo) * numerator,
            exponent: common + exponent,
        }
    }

    fn to_rational(&self) -> BigRational {
        BigRational::new(self.numerator.clone(), BigInt::from(1) << self.exponent)
    }

    /// The nearest `f64` that is not above (`up = false`) or not below (`up = true`).
    fn to_f64(&self, up: bool) -> f64 {
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
struct Float {
    mantissa: f64,
    exponent: i64,
}

impl Float {
    fn new(value: &BigInt, denominator_bits: u64) -> Self {
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
    fn chord(a: Self, b: Self) -> f64 {
        let exponent = a.exponent.max(b.exponent);
        let a = scale_by_power(a.mantissa, (a.exponent - exponent).max(-2000));
        let b = scale_by_power(b.mantissa, (b.exponent - exponent).max(-2000));
        a / (a - b)
    }

    fn halved(self) -> Self {
        Self {
            mantissa: 0.5 * self.mantissa,
            ..self
        }
    }
}

/// The square-free factors of a polynomial with the multiplicity of each; and the multiplicities of the ends.
#[derive(Clone, Debug)]
pub(crate) struct Decomposition {
    factors: Vec<(Homogeneous, u32)>,
    at_zero: u32,
    at_one: u32,
}

impl Decomposition {
    /// From Bernstein coefficients on `[0, 1]`; `None` for the zero polynomial.
    pub(crate) fn of_bernstein(coefficients: &[f64]) -> Option<Self> {
        let exact: Vec<Exact> = coefficients.iter().map(|p| Exact::exactly(*p)).collect();
        let degree = coefficients.len().checked_sub(1)?;
        Self::of_homogeneous(
            common_integers(&exact)
                .into_iter()
                .zip(binomials(degree))
                .map(|(p, b)| p * b)
                .collect(),
        )
    }

    /// From the coefficients of `t^i (1-t)^(n-i)`; `None` for the zero polynomial.
    pub(crate) fn of_homogeneous(mut coefficients: Vec<BigInt>) -> Option<Self> {
        let at_zero = coefficients.iter().position(|c| *c != BigInt::ZERO)?;
        let last = coefficients.iter().rposition(|c| *c != BigInt::ZERO)?;
        let at_one = coefficients.len() - 1 - last;
        coefficients.truncate(last + 1);
        coefficients.drain(..at_zero);
        Some(Self {
            factors: square_free(coefficients),
            at_zero: at_zero as u32,
            at_one: at_one as u32,
        })
    }

    /// Multiplicities of the roots 0 and 1.
    pub(crate) fn ends(&self) -> (u32, u32) {
        (self.at_zero, self.at_one)
    }

    /// All roots in the open interval `(lo, hi)`, ascending, each enclosed to `tolerance`.
    pub(crate) fn roots_between(&self, lo: f64, hi: f64, tolerance: f64) -> Vec<Root> {
        let mut roots: Vec<Root> = self
            .isolated(&Dyadic::from_f64(lo), &Dyadic::from_f64(hi), tolerance)
            .iter()
            .map(|(at, multiplicity)| {
                Root::exactly(at.lo.to_f64(false), at.hi.to_f64(true), *multiplicity)
            })
            .collect();
        roots.sort_by(|a, b| a.lo.total_cmp(&b.lo).then(a.hi.total_cmp(&b.hi)));
        roots
    }

    /// All roots in `[0, 1]`, ascending.
    pub(crate) fn exact_roots(&self, tolerance: f64) -> Vec<ExactRoot> {
        let end = |at: f64, multiplicity: u32| {
            let at = Dyadic::from_f64(at);
            (multiplicity > 0).then(|| {
                (
                    Isolated {
                        lo: at.clone(),
                        hi: at,
                    },
                    multiplicity,
                )
            })
        };
        let inner = self.isolated(&Dyadic::from_f64(0.0), &Dyadic::from_f64(1.0), tolerance);
        let mut roots: Vec<ExactRoot> = end(0.0, self.at_zero)
            .into_iter()
            .chain(inner)
            .chain(end(1.0, self.at_one))
            .map(|(at, multiplicity)| ExactRoot {
                lo: at.lo.to_rational(),
                hi: at.hi.to_rational(),
                multiplicity,
            })
            .collect();
        roots.sort_by(|a, b| a.lo.cmp(&b.lo).then(a.hi.cmp(&b.hi)));
        roots
    }

    fn isolated(&self, lo: &Dyadic, hi: &Dyadic, tolerance: f64) -> Vec<(Isolated, u32)> {
        let mut found = Vec::new();
        for (factor, multiplicity) in &self.factors {
            for isolated in factor.isolate(lo, hi) {
                found.push((factor.enclose(isolated, tolerance), *multiplicity));
            }
        }
        found
    }
}

impl Homogeneous {
    fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Bernstein coefficients on `[lo, hi]`, up to a positive factor.
    fn bernstein_between(&self, lo: &Dyadic, hi: &Dyadic) -> Vec<BigInt> {
        let degree = self.degree();
        let binomials = binomials(degree);
        // The least common multiple of C(n, 0..=n) is lcm(1..=n+1) / (n+1); any common multiple serves.
        let multiple = binomials
            .iter()
            .fold(BigInt::from(1), |m, b| &m / gcd_integers(&m, b) * b);
        let mut row: Vec<BigInt> = self
            .coefficients
            .iter()
            .zip(&binomials)
            .map(|(c, b)| c * (&multiple / b))
            .collect();
        let exponent = lo.exponent.max(hi.exponent);
        let one = BigInt::from(1) << exponent;
        let hi = &hi.numerator << (exponent - hi.exponent);
        let lo = &lo.numerator << (exponent - lo.exponent);
        if hi != one {
            let complement = &one - &hi;
            let mut left = vec![&row[0] << (exponent * degree as u64)];
            for j in 1..=degree {
                for i in 0..=degree - j {
                    row[i] = &row[i] * &complement + &row[i + 1] * &hi;
                }
                left.push(&row[0] << (exponent * (degree - j) as u64));
            }
            row = left;
            reduce(&mut row);
        }
        if lo != BigInt::ZERO {
            let complement = &hi - &lo;
            for j in 1..=degree {
                for i in 0..=degree - j {
                    row[i] = &row[i] * &complement + &row[i + 1] * &lo;
                }
            }
            let mut power = BigInt::from(1);
            for value in &mut row {
                *value *= &power;
                power *= &hi;
            }
            reduce(&mut row);
        }
        row
    }

    /// One interval for each root in the open interval; the polynomial is square-free, so this ends.
    fn isolate(&self, lo: &Dyadic, hi: &Dyadic) -> Vec<Isolated> {
        let degree = self.degree();
        let mut found = Vec::new();
        if degree == 0 {
            return found;
        }
        let mut waiting = vec![(self.bernstein_between(lo, hi), BigInt::ZERO, 0_u64)];
        while let Some((mut row, position, depth)) = waiting.pop() {
            match sign_changes(&row) {
                0 => {}
                1 => found.push(Isolated {
                    lo: Dyadic::between(lo, hi, &position, depth),
                    hi: Dyadic::between(lo, hi, &(&position + 1), depth),
                }),
                _ => {
                    let mut left = halve(&mut row);
                    let middle: BigInt = (&position << 1) + 1;
                    if row[0] == BigInt::ZERO {
                        let at = Dyadic::between(lo, hi, &middle, depth + 1);
                        found.push(Isolated {
                            lo: at.clone(),
                            hi: at,
                        });
                    }
                    reduce(&mut left);
                    reduce(&mut row);
                    waiting.push((left, position << 1, depth + 1));
                    waiting.push((row, middle, depth + 1));
                }
            }
        }
        found
    }

    /// `F(t)` times a positive number, which is `2^(degree * exponent of t)`.
    fn value(&self, t: &Dyadic) -> BigInt {
        let complement = (BigInt::from(1) << t.exponent) - &t.numerator;
        let mut sum = BigInt::ZERO;
        let mut power = BigInt::from(1);
        for c in self.coefficients.iter().rev() {
            sum = sum * &t.numerator + c * &power;
            power *= &complement;
        }
        sum
    }

    fn float(&self, t: &Dyadic) -> Float {
        Float::new(&self.value(t), self.degree() as u64 * t.exponent)
    }

    /// Sign of `F` just right of `t`.
    fn is_negative_after(&self, t: &Dyadic, value: &Float) -> bool {
        if value.mantissa != 0.0 {
            return value.mantissa < 0.0;
        }
        // A simple root: the sign of the derivative in x = t / (1-t), which grows with t.
        let derivative = derivative(&self.coefficients);
        Self {
            coefficients: derivative,
        }
        .value(t)
        .sign()
            == Sign::Minus
    }

    /// Shrinks an isolating interval to `tolerance` by the chord (Illinois) and bisection, on exact values at `f64` points.
    fn enclose(&self, at: Isolated, tolerance: f64) -> Isolated {
        let Isolated { mut lo, mut hi } = at;
        if lo == hi {
            return Isolated { lo, hi };
        }
        let mut value_lo = self.float(&lo);
        let mut value_hi = self.float(&hi);
        let negative_lo = self.is_negative_after(&lo, &value_lo);
        let mut last_below = None;
        for turn in 1_u64.. {
            let (a, b) = (lo.to_f64(false), hi.to_f64(true));
            if b - a <= tolerance || b <= a.next_up().next_up() {
                break;
            }
            let ends_known = value_lo.mantissa != 0.0 && value_hi.mantissa != 0.0;
            let chord = ends_known && turn % 4 != 0;
            let share = if chord {
                Float::chord(value_lo, value_hi)
            } else {
                0.5
            };
            let x = (a + (b - a) * share).clamp(a.next_up(), b.next_down());
            let point = Dyadic::from_f64(x);
            let value = self.float(&point);
            if value.mantissa == 0.0 {
                return Isolated {
                    lo: point.clone(),
                    hi: point,
                };
            }
            let below = (value.mantissa < 0.0) == negative_lo;
            if below {
                (lo, value_lo) = (point, value);
            } else {
                (hi, value_hi) = (point, value);
            }
            // Illinois: an end that stays twice loses half its weight.
            match last_below {
                Some(true) if below => value_hi = value_hi.halved(),
                Some(false) if !below => value_lo = value_lo.halved(),
                _ => {}
            }
            last_below = Some(below);
            // The chord soon lands beside the root: a second point a little further closes the bracket.
            let beside = if below {
                x + 0.5 * tolerance
            } else {
                x - 0.5 * tolerance
            };
            if chord && beside > lo.to_f64(true) && beside < hi.to_f64(false) {
                let point = Dyadic::from_f64(beside);
                let value = self.float(&point);
                if value.mantissa == 0.0 {
                    return Isolated {
                        lo: point.clone(),
                        hi: point,
                    };
                }
                if (value.mantissa < 0.0) == negative_lo {
                    (lo, value_lo) = (point, value);
                } else {
                    (hi, value_hi) = (point, value);
                }
            }
        }
        Isolated { lo, hi }
    }
}

/// Sign changes, zeros dropped (Descartes' count for the open interval).
fn sign_changes(row: &[BigInt]) -> usize {
    let mut changes = 0;
    let mut last = Sign::NoSign;
    for sign in row.iter().map(BigInt::sign).filter(|s| *s != Sign::NoSign) {
        changes += usize::from(last != Sign::NoSign && sign != last);
        last = sign;
    }
    changes
}

/// De Casteljau at 1/2 without divisions: `row` becomes the right half, the left is returned.
fn halve(row: &mut [BigInt]) -> Vec<BigInt> {
    let degree = row.len() - 1;
    let mut left = vec![&row[0] << degree];
    for j in 1..=degree {
        for i in 0..=degree - j {
            let (head, tail) = row.split_at_mut(i + 1);
            head[i] += &tail[0];
        }
        left.push(&row[0] << (degree - j));
    }
    for (i, value) in row.iter_mut().enumerate() {
        *value <<= i;
    }
    left
}

/// Takes out the common power of two.
fn reduce(row: &mut [BigInt]) {
    let common = row
        .iter()
        .filter_map(BigInt::trailing_zeros)
        .min()
        .unwrap_or(0);
    if common > 0 {
        for value in row {
            *value >>= common;
        }
    }
}

fn gcd_integers(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.magnitude().clone(), b.magnitude().clone());
    while b != BigUint::ZERO {
        let r = &a % &b;
        a = b;
        b = r;
    }
    BigInt::from(a)
}

fn derivative(f: &[BigInt]) -> Vec<BigInt> {
    f.iter().enumerate().skip(1).map(|(i, c)| c * i).collect()
}

/// Divides by the common divisor of all coefficients.
fn primitive(mut f: Vec<BigInt>) -> Vec<BigInt> {
    while f.last().is_some_and(|c| *c == BigInt::ZERO) {
        f.pop();
    }
    let mut content = BigInt::ZERO;
    for c in &f {
        content = gcd_integers(c, &content);
        if content == BigInt::from(1) {
            return f;
        }
    }
    if content != BigInt::ZERO {
        for c in &mut f {
            *c /= &content;
        }
    }
    f
}

/// Remainder of a positive or negative multiple of `f` by `g` (the sign does not matter for a divisor).
fn pseudo_remainder(mut f: Vec<BigInt>, g: &[BigInt]) -> Vec<BigInt> {
    let Some(lead) = g.last() else { return f };
    while f.len() >= g.len() {
        let Some(top) = f.pop() else { break };
        let shift = f.len() + 1 - g.len();
        for c in &mut f {
            *c *= lead;
        }
        for (i, c) in g[..g.len() - 1].iter().enumerate() {
            f[shift + i] -= &top * c;
        }
        while f.last().is_some_and(|c| *c == BigInt::ZERO) {
            f.pop();
        }
    }
    f
}

/// Greatest common divisor by primitive remainders.
fn gcd(f: &[BigInt], g: &[BigInt]) -> Vec<BigInt> {
    let (mut f, mut g) = (primitive(f.to_vec()), primitive(g.to_vec()));
    while !g.is_empty() {
        let r = primitive(pseudo_remainder(f, &g));
        f = g;
        g = r;
    }
    f
}

/// `f / g` for a primitive divisor `g`, exact.
fn quotient(f: &[BigInt], g: &[BigInt]) -> Vec<BigInt> {
    let mut f = f.to_vec();
    let mut result = Vec::new();
    if let Some(lead) = g.last() {
        while f.len() >= g.len() {
            let Some(top) = f.pop() else { break };
            let factor = top / lead;
            let shift = f.len() + 1 - g.len();
            for (i, c) in g[..g.len() - 1].iter().enumerate() {
                f[shift + i] -= &factor * c;
            }
            result.push(factor);
        }
    }
    result.reverse();
    result
}

/// Yun's decomposition: square-free factors with their multiplicities, constants left out.
fn square_free(f: Vec<BigInt>) -> Vec<(Homogeneous, u32)> {
    if f.len() <= 1 {
        return Vec::new();
    }
    if coprime_modulo(&f, &derivative(&f)) {
        return vec![(Homogeneous { coefficients: f }, 1)];
    }
    let f = primitive(f);
    let slope = derivative(&f);
    let common = gcd(&f, &slope);
    let mut rest = quotient(&f, &common);
    let mut other = quotient(&slope, &common);
    let mut factors = Vec::new();
    let mut multiplicity = 1;
    while rest.len() > 1 {
        let mut difference = other;
        let own = derivative(&rest);
        difference.resize(difference.len().max(own.len()), BigInt::ZERO);
        for (d, c) in difference.iter_mut().zip(own) {
            *d -= c;
        }
        while difference.last().is_some_and(|c| *c == BigInt::ZERO) {
            difference.pop();
        }
        let factor = if difference.is_empty() {
            rest.clone()
        } else {
            gcd(&rest, &difference)
        };
        rest = quotient(&rest, &factor);
        other = quotient(&difference, &factor);
        if factor.len() > 1 {
            factors.push((
                Homogeneous {
                    coefficients: factor,
                },
                multiplicity,
            ));
        }
        multiplicity += 1;
    }
    factors
}

/// The prime `2^61 - 1`.
const PRIME: u64 = (1 << 61) - 1;

/// Whether `f` and `g` are coprime modulo a prime that divides neither leading coefficient: then they are coprime.
fn coprime_modulo(f: &[BigInt], g: &[BigInt]) -> bool {
    let residues = |f: &[BigInt]| -> Vec<u64> {
        f.iter()
            .map(|c| {
                let r = (c.magnitude() % PRIME)
                    .iter_u64_digits()
                    .next()
                    .unwrap_or(0);
                if c.sign() == Sign::Minus && r > 0 {
                    PRIME - r
                } else {
                    r
                }
            })
            .collect()
    };
    let (mut f, mut g) = (residues(f), residues(g));
    if f.last() == Some(&0) || g.last() == Some(&0) {
        return false;
    }
    loop {
        while g.last() == Some(&0) {
            g.pop();
        }
        match g.len() {
            0 => return false,
            1 => return true,
            _ => {}
        }
        // f modulo g, division-free.
        let lead = g[g.len() - 1];
        while f.len() >= g.len() {
            let Some(top) = f.pop() else { break };
            let shift = f.len() + 1 - g.len();
            for c in &mut f {
                *c = multiply(*c, lead);
            }
            for (i, c) in g[..g.len() - 1].iter().enumerate() {
                let d = multiply(top, *c);
                let value = &mut f[shift + i];
                *value = if *value >= d {
                    *value - d
                } else {
                    *value + PRIME - d
                };
            }
        }
        std::mem::swap(&mut f, &mut g);
    }
}

fn multiply(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    let folded = (product & u128::from(PRIME)) as u64 + (product >> 61) as u64;
    if folded >= PRIME {
        folded - PRIME
    } else {
        folded
    }
}
