//! Cubics on a direct path, with few branches that depend on the numbers.
//!
//! The signs of the coefficients leave four cases. One change: one root. Two or three changes: the extrema, by the quadratic
//! formula for `F'`, and the signs of `F` there tell how many roots there are and between which extrema. A root is then two
//! steps of Householder's method from a good guess, and two certain signs close its enclosure. Whatever is uncertain returns
//! `None`, and the general path takes over.

use crate::low_degree::checked;
use crate::root::List;
use crate::rounding::U;

/// A term `p_i C(3,i) t^i (1-t)^(3-i)` meets at most 9 roundings, and the terms sum to at most the largest coefficient.
const VALUE_ERROR: f64 = 12.0 * U;

/// How far a computed value at a computed extremum may be from the extreme value: that of a value, several times over. The
/// place has a relative error of at most `2^-30` (see [`LEAST_DISCRIMINANT`]), which enters squared.
const EXTREMUM_ERROR: f64 = 4.0 * VALUE_ERROR;

/// Discriminants above this, relative to their two terms, have at least 30 certain bits: their error is at most `6 U`.
const LEAST_DISCRIMINANT: f64 = 1.0 / (1_u64 << 20) as f64;

/// Attempts to enclose a root, each one step further, before the general path takes over. One in six needs the second.
const ATTEMPTS: usize = 4;

/// A cubic with nonzero ends.
struct Cubic {
    p: [f64; 4],
    /// `3 p_1` and `3 p_2`.
    inner: [f64; 2],
    /// Coefficients of the powers of `t`, for steps; signs are those of the Bernstein form.
    power: [f64; 4],
    largest: f64,
    tolerance: f64,
}

/// An interval with one root.
#[derive(Clone, Copy)]
struct Bracket {
    lo: f64,
    hi: f64,
    negative_lo: bool,
}

/// Appends the roots of a cubic.
#[inline]
pub(crate) fn solve(p: [f64; 4], tolerance: f64, found: &mut List<'_>) -> Option<()> {
    let largest = checked(&p)?;
    let negative = p.map(f64::is_sign_negative);
    // A zero coefficient takes part with either sign: that can only raise the count, by an even number.
    let changes = u8::from(negative[0] != negative[1])
        + u8::from(negative[1] != negative[2])
        + u8::from(negative[2] != negative[3]);
    if changes == 0 {
        return Some(());
    }
    let slopes = [p[1] - p[0], p[2] - p[1], p[3] - p[2]];
    let cubic = Cubic {
        p,
        inner: [3.0 * p[1], 3.0 * p[2]],
        power: [
            p[0],
            3.0 * slopes[0],
            3.0 * (slopes[1] - slopes[0]),
            (p[3] - p[0]) - 3.0 * slopes[1],
        ],
        largest,
        tolerance,
    };
    let bracket = |lo: f64, hi: f64, negative_lo: bool| Bracket {
        lo,
        hi,
        negative_lo,
    };
    let [at_zero, .., at_one] = negative;
    if changes == 1 {
        // The edge of the polygon that crosses zero.
        let edge = usize::from(negative[1] == at_zero) + usize::from(negative[2] == at_zero);
        let (from, to) = (p[edge & 3], p[(edge + 1) & 3]);
        let crossing = (edge as f64 + from / (from - to)) * (1.0 / 3.0);
        found.push_simple(cubic.enclose(bracket(0.0, 1.0, at_zero), crossing)?);
        return Some(());
    }
    let [first, second] = match extrema(slopes) {
        Extrema::Uncertain => return None,
        Extrema::None if changes == 2 => return Some(()),
        Extrema::None => {
            let turn = slopes[0] - slopes[1];
            let inflection = turn / (turn + (slopes[2] - slopes[1]));
            let guess = cubic.step(inflection).0;
            found.push_simple(cubic.enclose(bracket(0.0, 1.0, at_zero), guess)?);
            return Some(());
        }
        Extrema::At(places) => places,
    };
    // Positive: the value has the sign that F has at 0.
    let side = if at_zero { -1.0 } else { 1.0 };
    let value = |t: f64| side * cubic.value(t);
    let error = EXTREMUM_ERROR * largest;
    if changes == 2 {
        // The only extremum that could carry F to the other side is the first (in the order of the formula) if the middle slope
        // has the sign of F at 0.
        let z = if slopes[1].is_sign_negative() == at_zero {
            first
        } else {
            second
        };
        let extreme = value(z);
        if !(z > 0.0 && z < 1.0) || extreme.abs() <= error {
            return None;
        }
        if extreme < 0.0 {
            found.push_simple(cubic.enclose(bracket(0.0, z, at_zero), cubic.beside(z, -1.0))?);
            found.push_simple(cubic.enclose(bracket(z, 1.0, !at_zero), cubic.beside(z, 1.0))?);
        }
        return Some(());
    }
    let (low, high) = (value(first), value(second));
    let ascending = 0.0 < first && first < second && second < 1.0;
    if !ascending || low.abs() <= error || high.abs() <= error {
        return None;
    }
    if low < 0.0 {
        found.push_simple(cubic.enclose(bracket(0.0, first, at_zero), cubic.beside(first, -1.0))?);
    }
    if low < 0.0 && high > 0.0 {
        let guess = first + (second - first) * (low / (low - high));
        found.push_simple(cubic.enclose(bracket(first, second, !at_zero), guess)?);
    }
    if high > 0.0 {
        found.push_simple(cubic.enclose(bracket(second, 1.0, !at_one), cubic.beside(second, 1.0))?);
    }
    Some(())
}

/// The extrema of a cubic.
enum Extrema {
    /// The discriminant is too near zero.
    Uncertain,
    /// The cubic is monotone.
    None,
    /// With three sign changes these ascend.
    At([f64; 2]),
}

/// From the Bernstein coefficients of `F' / 3`: the roots of `a s^2 + 2 b s t + c t^2`, `s = 1 - t`.
#[inline]
fn extrema([a, b, c]: [f64; 3]) -> Extrema {
    let (square, product) = (b * b, a * c);
    let discriminant = square - product;
    let least = LEAST_DISCRIMINANT * (square + product.abs());
    if discriminant < -least {
        Extrema::None
    } else if discriminant <= least {
        Extrema::Uncertain
    } else {
        // t / s is a / q and q / c, without cancellation.
        let q = -(b + discriminant.sqrt().copysign(b));
        Extrema::At([a / (a + q), q / (q + c)])
    }
}

impl Cubic {
    #[inline(always)]
    fn value(&self, t: f64) -> f64 {
        let s = 1.0 - t;
        (self.p[0] * s + self.inner[0] * t) * (s * s)
            + (self.inner[1] * s + self.p[3] * t) * (t * t)
    }

    /// One step of Householder's method of order four, and the slope at `t`.
    #[inline(always)]
    fn step(&self, t: f64) -> (f64, f64) {
        let [a, b, c, d] = self.power;
        let square = t * t;
        let value = (a + b * t) + (c + d * t) * square;
        let slope = (b + 2.0 * c * t) + 3.0 * d * square;
        let bend = c + 3.0 * d * t;
        let (slope_squared, product) = (slope * slope, value * bend);
        let numerator = value * (slope_squared - product);
        let denominator = slope * (slope_squared - (product + product)) + value * value * d;
        (t - numerator / denominator, slope)
    }

    /// A guess for the root below (`side = -1`) or above the extremum at `z`: `value + bend h^2 + d h^3 = 0` to second order.
    #[inline(always)]
    fn beside(&self, z: f64, side: f64) -> f64 {
        let [_, _, c, d] = self.power;
        let curvature = 1.0 / (c + 3.0 * d * z);
        let square = -self.value(z) * curvature;
        z + side * square.sqrt() - 0.5 * d * curvature * square
    }

    /// Encloses the only root of a bracket.
    #[inline(always)]
    fn enclose(&self, bracket: Bracket, guess: f64) -> Option<(f64, f64)> {
        let Bracket {
            lo,
            hi,
            negative_lo,
        } = bracket;
        // Also where the guess is NaN.
        let inside = |t: f64| {
            if t > lo && t < hi { t } else { 0.5 * (lo + hi) }
        };
        let error = VALUE_ERROR * self.largest;
        let mut t = inside(self.step(guess).0);
        for _ in 0..ATTEMPTS {
            let (next, slope) = self.step(t);
            t = inside(next);
            let reach = 4.0 * error / slope.abs() + (4.0 * U + 0.2 * self.tolerance);
            let (left, right) = (t - reach, t + reach);
            let (below, above) = (self.value(left), self.value(right));
            let certain = below.abs() > error
                && above.abs() > error
                && (below < 0.0) == negative_lo
                && (above < 0.0) != negative_lo;
            if certain && left > lo && right < hi && reach <= 0.45 * self.tolerance {
                return Some((left, right));
            }
        }
        None
    }
}
