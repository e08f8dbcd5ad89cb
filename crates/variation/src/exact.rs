//! Exact arithmetic: what `f64` cannot decide is decided here, on integers.
//!
//! `sum c_i t^i (1-t)^(n-i)` with integers `c_i` is the ordinary polynomial `sum c_i x^i` at `x = t / (1-t)`, with the same
//! multiplicities. A square-free decomposition (Yun) separates the multiplicities, Descartes' rule with exact bisection
//! the roots of each factor, and exact values at `f64` points enclose each root as tightly as asked.

use num_bigint::{BigInt, Sign};

use crate::arithmetic::Number;
use crate::dyadic::{Dyadic, Exact, Float, common_integers};
use crate::rational::ExactRoot;
use crate::root::Root;
use crate::square_free::{derivative, gcd_integers, square_free};

/// A nonzero polynomial with integer coefficients `c_i` of `t^i (1-t)^(n-i)`, nonzero at both ends.
#[derive(Clone, Debug)]
struct Homogeneous {
    coefficients: Vec<BigInt>,
}
/// A root of one polynomial, as exact as its ends: simple roots of square-free factors.
#[derive(Clone, Debug)]
struct Isolated {
    lo: Dyadic,
    hi: Dyadic,
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
            factors: square_free(coefficients)
                .into_iter()
                .map(|(coefficients, multiplicity)| (Homogeneous { coefficients }, multiplicity))
                .collect(),
            at_zero: at_zero as u32,
            at_one: at_one as u32,
        })
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
