//! Degrees 1 to 5 on a direct path: everything in registers, sizes known to the compiler.
//!
//! Linear and quadratic polynomials have formulas whose rounding is bounded here; cubics have a file of their own. Degrees 4 and
//! 5 are halved where Descartes' count is not yet 0 or 1 and refined by Householder's method on the original coefficients; two certain signs
//! close each enclosure. Whatever is uncertain returns `None`, and the general path takes over.

use crate::cubic;
use crate::root::{Interval, List, Root};
use crate::rounding::{SAFE_LEAST, SAFE_MOST, U};

/// The highest degree of the direct path.
pub(crate) const MAX_DEGREE: usize = 5;

/// The direct path: writes the roots, ascending, and counts them. `None` for other degrees, zeros at the ends, numbers out of
/// range, and where it cannot decide.
#[inline]
pub(crate) fn solve(
    coefficients: &[f64],
    tolerance: f64,
    slots: &mut [Root],
    interval: Interval,
) -> Option<usize> {
    let mut found = List::new(slots, interval);
    match *coefficients {
        [a, b] => linear([a, b], &mut found)?,
        [a, b, c] => quadratic([a, b, c], tolerance, &mut found)?,
        [a, b, c, d] => cubic::solve([a, b, c, d], tolerance, &mut found)?,
        [a, b, c, d, e] => roots(&[a, b, c, d, e], tolerance, &mut found)?,
        [a, b, c, d, e, f] => roots(&[a, b, c, d, e, f], tolerance, &mut found)?,
        _ => return None,
    }
    Some(found.len())
}

/// The largest magnitude, if the ends are not zero and nothing can overflow or underflow.
#[inline]
pub(crate) fn checked<const M: usize>(p: &[f64; M]) -> Option<f64> {
    let mut largest = 0.0_f64;
    let mut finite = true;
    for x in p {
        // A comparison with NaN is false.
        finite &= x.abs() <= SAFE_MOST;
        largest = if x.abs() > largest { x.abs() } else { largest };
    }
    (finite && largest >= SAFE_LEAST && p[0] != 0.0 && p[M - 1] != 0.0).then_some(largest)
}

/// The root of a linear polynomial whose coefficients have opposite signs. Two roundings, no cancellation.
fn linear([a, b]: [f64; 2], found: &mut List<'_>) -> Option<()> {
    checked(&[a, b])?;
    if (a < 0.0) != (b < 0.0) {
        found.push_simple(around(a / (a - b), 4.0 * U));
    }
    Some(())
}

/// `t` with a relative error, kept within `[0, 1]`.
fn around(t: f64, relative: f64) -> (f64, f64) {
    (t * (1.0 - relative), (t * (1.0 + relative)).min(1.0))
}

/// The roots of a quadratic polynomial with nonzero ends; `None` if the discriminant is uncertain or too small for the tolerance.
///
/// In `r = t / (1-t)` it is `c r^2 + 2 b r + a`; both roots come from `q = -(b + sign(b) sqrt(d))` as `q / c` and `a / q`, which
/// do not cancel.
fn quadratic([a, b, c]: [f64; 3], tolerance: f64, found: &mut List<'_>) -> Option<()> {
    checked(&[a, b, c])?;
    let opposite = (a < 0.0) != (c < 0.0);
    if !opposite && (b == 0.0 || (a < 0.0) == (b < 0.0)) {
        return Some(());
    }
    let (square, product) = (b * b, a * c);
    let discriminant = square - product;
    // Three roundings: each at most U times one of the terms or their sum.
    let error = 2.0 * U * (square + product.abs());
    if discriminant < -error {
        return Some(());
    }
    if discriminant <= 4.0 * error {
        return None;
    }
    // Half the relative error of the discriminant, then the root, the sum, the quotient, and t = r / (1 + r).
    let relative = error / discriminant + 8.0 * U;
    if 2.0 * relative > tolerance {
        return None;
    }
    let q = -(b + discriminant.sqrt().copysign(b));
    let parameter = |numerator: f64, denominator: f64| numerator / (numerator + denominator);
    if opposite {
        let t = if (q < 0.0) == (c < 0.0) {
            parameter(q, c)
        } else {
            parameter(a, q)
        };
        found.push_simple(around(t, relative));
    } else {
        let (s, t) = (parameter(q, c), parameter(a, q));
        let (first, second) = (around(s.min(t), relative), around(s.max(t), relative));
        if first.1 >= second.0 {
            return None;
        }
        found.push_simple(first);
        found.push_simple(second);
    }
    Some(())
}

/// A polynomial of degree `M - 1` with what its evaluation needs.
struct Small<const M: usize> {
    /// `C(n,i) p_i`.
    scaled: [f64; M],
    /// `C(n-1,i)` times the coefficients of the derivative; the last entry is unused.
    first: [f64; M],
    /// Likewise of the second derivative; the last two entries are unused.
    second: [f64; M],
    /// Likewise of the third derivative.
    third: [f64; M],
    /// Bound on the error of a value.
    error: f64,
}

/// Binomials up to degree 5.
const BINOMIALS: [[f64; 6]; 6] = [
    [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
    [1.0, 2.0, 1.0, 0.0, 0.0, 0.0],
    [1.0, 3.0, 3.0, 1.0, 0.0, 0.0],
    [1.0, 4.0, 6.0, 4.0, 1.0, 0.0],
    [1.0, 5.0, 10.0, 10.0, 5.0, 1.0],
];

impl<const M: usize> Small<M> {
    const DEGREE: usize = M - 1;

    #[inline]
    fn new(p: &[f64; M], largest: f64) -> Self {
        let n = Self::DEGREE;
        let mut scaled = [0.0; M];
        let mut first = [0.0; M];
        let mut second = [0.0; M];
        let mut third = [0.0; M];
        for i in 0..M {
            scaled[i] = BINOMIALS[n][i] * p[i];
        }
        for i in 0..n {
            first[i] = (p[i + 1] - p[i]) * n as f64;
        }
        for i in 0..n - 1 {
            second[i] = (first[i + 1] - first[i]) * (n - 1) as f64;
        }
        for i in 0..n - 2 {
            third[i] = (second[i + 1] - second[i]) * (n - 2) as f64 * BINOMIALS[n - 3][i];
        }
        for i in 0..n {
            first[i] *= BINOMIALS[n - 1][i];
        }
        for i in 0..n - 1 {
            second[i] *= BINOMIALS[n - 2][i];
        }
        // A term c_i t^i (1-t)^(n-i) meets at most 3 n + 1 roundings: one in c_i, one in each 1 - t, and one for each product
        // and sum on its way. The terms sum to at most the largest coefficient.
        Self {
            scaled,
            first,
            second,
            third,
            error: (3 * n + 3) as f64 * U * largest,
        }
    }

    /// `sum c_i t^i s^(k-i)` for `i = 0..=k`, arranged for short chains of operations.
    #[inline]
    fn sum(c: &[f64; M], k: usize, t: f64, s: f64) -> f64 {
        let pair = |i: usize| c[i] * s + c[i + 1] * t;
        match k {
            0 => c[0],
            1 => pair(0),
            2 => pair(0) * s + c[2] * (t * t),
            3 => pair(0) * (s * s) + pair(2) * (t * t),
            4 => (pair(0) * s + c[2] * (t * t)) * (s * s) + pair(3) * (t * t * t),
            _ => (pair(0) * (s * s) + pair(2) * (t * t)) * (s * s) + pair(4) * ((t * t) * (t * t)),
        }
    }

    #[inline]
    fn value(&self, t: f64) -> f64 {
        Self::sum(&self.scaled, Self::DEGREE, t, 1.0 - t)
    }

    /// Whether the value is certainly negative (`Some(true)`) or positive.
    #[inline]
    fn is_negative(&self, t: f64) -> Option<bool> {
        let value = self.value(t);
        (value.abs() > self.error).then_some(value < 0.0)
    }

    /// Encloses the only root of a bracket.
    #[inline]
    fn refine(
        &self,
        bracket: (f64, f64),
        negative_lo: bool,
        guess: f64,
        tolerance: f64,
    ) -> Option<(f64, f64)> {
        let (mut lo, mut hi) = bracket;
        let mut x = guess;
        for _ in 0..16 {
            let s = 1.0 - x;
            let value = Self::sum(&self.scaled, Self::DEGREE, x, s);
            let first = Self::sum(&self.first, Self::DEGREE - 1, x, s);
            let second = Self::sum(&self.second, Self::DEGREE - 2, x, s);
            if (value < 0.0) == negative_lo {
                lo = x;
            } else {
                hi = x;
            }
            let third = Self::sum(&self.third, Self::DEGREE - 3, x, s);
            // Householder's method of order four: the slope of f / (1/f)''.
            let (square, product) = (first * first, value * second);
            let numerator = value * (6.0 * square - 3.0 * product);
            let step = numerator / (6.0 * first * (square - product) + value * value * third);
            let next = x - step;
            if !(next >= lo && next <= hi) {
                x = 0.5 * (lo + hi);
                continue;
            }
            x = next;
            let slope = first.abs();
            let bend = (second.abs() + third.abs() * step.abs()) * step.abs();
            // The error of the method is about the step times the cube of its relative bend.
            if bend * bend * bend * step.abs() > 0.1 * tolerance * (slope * slope * slope) {
                continue;
            }
            let reach = (4.0 * self.error) / slope + (4.0 * U + 0.2 * tolerance);
            if reach > 0.45 * tolerance {
                return None;
            }
            let (left, right) = ((x - reach).max(bracket.0), (x + reach).min(bracket.1));
            let certain_left = left == bracket.0 || self.is_negative(left) == Some(negative_lo);
            let certain_right = right == bracket.1 || self.is_negative(right) == Some(!negative_lo);
            if certain_left && certain_right {
                return Some((left, right));
            }
        }
        None
    }
}

#[inline]
fn sign_changes<const M: usize>(p: &[f64; M]) -> u64 {
    let mut changes = 0;
    for i in 1..M {
        changes += (p[i].to_bits() ^ p[i - 1].to_bits()) >> 63;
    }
    changes
}

/// A part of the interval with its coefficients.
#[derive(Clone, Copy)]
struct Piece<const M: usize> {
    lo: f64,
    hi: f64,
    p: [f64; M],
}

/// Parts that may wait, and splits, before the general path takes over.
const MAX_PIECES: usize = 4;
const MAX_SPLITS: usize = 6;

/// The roots of a polynomial of degree 4 or 5.
#[inline]
fn roots<const M: usize>(p: &[f64; M], tolerance: f64, found: &mut List<'_>) -> Option<()> {
    let largest = checked(p)?;
    // A zero coefficient takes part with either sign: that can only raise the count, by an even number.
    let changes = sign_changes(p);
    if changes == 0 {
        return Some(());
    }
    let small = Small::new(p, largest);
    let whole = Piece {
        lo: 0.0,
        hi: 1.0,
        p: *p,
    };
    if changes == 1 {
        found.push_simple(small.refine((0.0, 1.0), p[0] < 0.0, crossing(p), tolerance)?);
        return Some(());
    }
    // Each row of a halving rounds once by at most U * largest; the surplus pays for rounding the bound.
    let split_error = (2 * M * MAX_SPLITS) as f64 * U * largest;
    let mut waiting = [whole; MAX_PIECES];
    let mut len = 1;
    let mut splits = 0;
    while len > 0 {
        len -= 1;
        let piece = waiting[len];
        match sign_changes(&piece.p) {
            0 => {}
            1 => {
                let guess = piece.lo + (piece.hi - piece.lo) * crossing(&piece.p);
                found.push_simple(small.refine(
                    (piece.lo, piece.hi),
                    piece.p[0] < 0.0,
                    guess,
                    tolerance,
                )?);
            }
            _ => {
                splits += 1;
                if splits > MAX_SPLITS || len + 2 > MAX_PIECES {
                    return None;
                }
                let (left, right) = piece.halves();
                let inner_certain =
                    certain_inside(&left.p, split_error) && certain_inside(&right.p, split_error);
                if !inner_certain || right.p[0].abs() <= split_error {
                    return None;
                }
                waiting[len] = right;
                waiting[len + 1] = left;
                len += 2;
            }
        }
    }
    Some(())
}

/// Whether all but the two ends have certain signs.
#[inline]
fn certain_inside<const M: usize>(p: &[f64; M], error: f64) -> bool {
    let mut certain = true;
    for value in &p[1..M - 1] {
        certain &= value.abs() > error;
    }
    certain
}

/// Where the control polygon first crosses zero.
#[inline]
fn crossing<const M: usize>(p: &[f64; M]) -> f64 {
    for i in 1..M {
        if (p[i] < 0.0) != (p[i - 1] < 0.0) {
            return ((i - 1) as f64 + p[i - 1] / (p[i - 1] - p[i])) / (M - 1) as f64;
        }
    }
    0.5
}

impl<const M: usize> Piece<M> {
    #[inline]
    fn halves(&self) -> (Self, Self) {
        let mut row = self.p;
        let mut left = self.p;
        for (j, slot) in left.iter_mut().enumerate().skip(1) {
            for i in 0..M - j {
                row[i] = 0.5 * (row[i] + row[i + 1]);
            }
            *slot = row[0];
        }
        let middle = 0.5 * (self.lo + self.hi);
        (
            Self {
                hi: middle,
                p: left,
                ..*self
            },
            Self {
                lo: middle,
                p: row,
                ..*self
            },
        )
    }
}
