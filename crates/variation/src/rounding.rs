//! Evaluation in `f64` with a bound on its own rounding error.
//!
//! A polynomial `sum p_i C(n,i) t^i (1-t)^(n-i)` is, up to the positive factor `(1-t)^n`, the ordinary polynomial
//! `sum c_i u^i` with `c_i = C(n,i) p_i` and `u = t / (1-t)`; for `t > 1/2` the list is read backwards with
//! `u = (1-t) / t`. Only the sign of `F` and ratios such as `F / F'` are wanted, so the factor is never formed.
//! The same sum over the magnitudes `|c_i|` bounds the rounding error.

/// Unit roundoff: half the spacing of `f64` above 1.
pub(crate) const U: f64 = 0.5 * f64::EPSILON;

/// Degrees up to this one are tried in `f64`; above it the exact path works alone.
pub(crate) const MAX_FLOAT_DEGREE: usize = 64;

/// Magnitudes within `2^-400 .. 2^400` need no scaling: products and sums of the algorithm neither overflow, nor lose
/// more to underflow (`2^-1074`) than a rounding error that is counted anyway (`2^-453` and above).
pub(crate) const SAFE_EXPONENT: i32 = 400;

/// `2^-400`, see [`SAFE_EXPONENT`].
pub(crate) const SAFE_LEAST: f64 = power_of_two(-SAFE_EXPONENT);
/// `2^400`.
pub(crate) const SAFE_MOST: f64 = power_of_two(SAFE_EXPONENT);

/// `2^exponent`, for normal numbers.
pub(crate) const fn power_of_two(exponent: i32) -> f64 {
    let biased = exponent + 1023;
    let biased = if biased < 1 {
        1
    } else if biased > 2046 {
        2046
    } else {
        biased
    };
    f64::from_bits((biased as u64) << 52)
}

/// The exponent of the leading bit of a positive number.
pub(crate) fn exponent_of(x: f64) -> i32 {
    let biased = ((x.to_bits() >> 52) & 0x7ff) as i32;
    if biased == 0 {
        -1011 - x.to_bits().leading_zeros() as i32
    } else {
        biased - 1023
    }
}

/// `C(n, i)` for `n <= 64`, each rounded once.
pub(crate) static BINOMIALS: [[f64; MAX_FLOAT_DEGREE + 1]; MAX_FLOAT_DEGREE + 1] = binomials(false);

/// What is missing from [`BINOMIALS`]: nonzero for large degrees, where binomials need more than 53 bits.
pub(crate) static BINOMIAL_RESTS: [[f64; MAX_FLOAT_DEGREE + 1]; MAX_FLOAT_DEGREE + 1] =
    binomials(true);

/// `2^-k`.
pub(crate) static HALF_POWERS: [f64; MAX_FLOAT_DEGREE + 1] = half_powers();

const fn binomials(rests: bool) -> [[f64; MAX_FLOAT_DEGREE + 1]; MAX_FLOAT_DEGREE + 1] {
    let mut exact = [0_u128; MAX_FLOAT_DEGREE + 1];
    let mut rows = [[0.0; MAX_FLOAT_DEGREE + 1]; MAX_FLOAT_DEGREE + 1];
    let mut n = 0;
    while n <= MAX_FLOAT_DEGREE {
        exact[n] = 1;
        let mut i = n;
        while i > 1 {
            i -= 1;
            exact[i] += exact[i - 1];
        }
        let mut i = 0;
        while i <= n {
            let rounded = exact[i] as f64;
            rows[n][i] = if rests {
                (exact[i] as i128 - rounded as i128) as f64
            } else {
                rounded
            };
            i += 1;
        }
        n += 1;
    }
    rows
}

const fn half_powers() -> [f64; MAX_FLOAT_DEGREE + 1] {
    let mut powers = [1.0; MAX_FLOAT_DEGREE + 1];
    let mut k = 1;
    while k <= MAX_FLOAT_DEGREE {
        powers[k] = 0.5 * powers[k - 1];
        k += 1;
    }
    powers
}

/// A computed value and a bound on its error, in the same positive but unknown unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounded {
    pub(crate) value: f64,
    pub(crate) bound: f64,
}

impl Bounded {
    /// The sign, where it is certain.
    pub(crate) fn is_negative(self) -> Option<bool> {
        (self.value.abs() > self.bound).then_some(self.value < 0.0)
    }
}

/// What one step of Newton's method needs, in the unit of `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Local {
    pub(crate) at: Bounded,
    /// `F'` with respect to `t`, in the unit of `at`.
    pub(crate) slope: f64,
}

/// `c_i = C(n,i) p_i` and their magnitudes, each in both directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Evaluator<'a> {
    forward: &'a [f64],
    forward_magnitude: &'a [f64],
    backward: &'a [f64],
    backward_magnitude: &'a [f64],
    /// Relative error bound, by which the sum of magnitudes is multiplied.
    unit: f64,
}

/// Number of `f64` that an [`Evaluator`] of degree `n` stores.
pub(crate) const fn evaluator_len(degree: usize) -> usize {
    4 * (degree + 1)
}

impl<'a> Evaluator<'a> {
    /// Stores `scaled[i] = C(n,i) p_i` for evaluation; `error` bounds the absolute error of every `p_i`.
    ///
    /// `scaled` carries at most two roundings a coefficient.
    pub(crate) fn new(
        scaled: impl Iterator<Item = f64>,
        degree: usize,
        error: f64,
        store: &'a mut [f64],
    ) -> Self {
        let size = degree + 1;
        let (forward, rest) = store.split_at_mut(size);
        let (backward, rest) = rest.split_at_mut(size);
        let (forward_magnitude, rest) = rest.split_at_mut(size);
        let (backward_magnitude, _) = rest.split_at_mut(size);
        for (f, c) in forward.iter_mut().zip(scaled) {
            *f = c;
        }
        let unit = Self::unit(degree);
        if error == 0.0 {
            for (m, f) in forward_magnitude.iter_mut().zip(&*forward) {
                *m = f.abs();
            }
        } else {
            let binomials = &BINOMIALS[degree.min(MAX_FLOAT_DEGREE)];
            for ((m, f), binomial) in forward_magnitude.iter_mut().zip(&*forward).zip(binomials) {
                *m = f.abs() + binomial * (error / unit);
            }
        }
        for (b, f) in backward.iter_mut().rev().zip(&*forward) {
            *b = *f;
        }
        for (b, f) in backward_magnitude.iter_mut().rev().zip(&*forward_magnitude) {
            *b = *f;
        }
        Self {
            forward,
            forward_magnitude,
            backward,
            backward_magnitude,
            unit,
        }
    }

    /// The rounding error of a sum is at most this times the sum of the magnitudes.
    ///
    /// Counted in units of `U`: 2 for `c_i`; `u` carries 2 and `w = u^2` 5, each of the at most `n/2` Horner levels adds
    /// a product and a sum, 7 together; the last product with `u` and the last sum add 4. That is `3.5 n + 6`; the
    /// surplus pays for the rounding of the bound itself.
    fn unit(degree: usize) -> f64 {
        (4 * degree + 16) as f64 * U
    }

    fn side(&self, t: f64) -> (&'a [f64], &'a [f64], f64) {
        if t <= 0.5 {
            (self.forward, self.forward_magnitude, t / (1.0 - t))
        } else {
            (self.backward, self.backward_magnitude, (1.0 - t) / t)
        }
    }

    /// `F(t)` for `t` in `[0, 1]`, up to a positive factor.
    pub(crate) fn value(&self, t: f64) -> Bounded {
        let (coefficients, magnitudes, u) = self.side(t);
        let w = u * u;
        let (even, odd) = alternate(coefficients, w);
        let (even_magnitude, odd_magnitude) = alternate(magnitudes, w);
        Bounded {
            value: even + u * odd,
            bound: self.unit * (even_magnitude + u * odd_magnitude),
        }
    }

    /// A bound on the Bernstein coefficients of `sum |p_i| C(n,i) t^i (1-t)^(n-i)` on `[lo, hi]`, which are values of a
    /// blossom there: each factor `t` is at most `hi`, each `1 - t` at most `1 - lo`. Exact up to rounding for `lo = hi`.
    pub(crate) fn magnitude_between(&self, lo: f64, hi: f64) -> f64 {
        let rest = 1.0 - lo;
        let (magnitudes, u, unit) = if hi <= rest {
            (self.forward_magnitude, hi / rest, rest)
        } else {
            (self.backward_magnitude, rest / hi, hi)
        };
        let (even, odd) = alternate(magnitudes, u * u);
        let degree = (magnitudes.len() - 1) as i32;
        // The roundings, also those of the power.
        (even + u * odd) * unit.powi(degree) * (1.0 + 2.0 * self.unit)
    }

    /// `F(t)` and `F'(t)` for `t` in `[0, 1]`, up to a common positive factor.
    pub(crate) fn local(&self, t: f64) -> Local {
        let (at, slope, u) = self.in_side(t);
        // The chain rule, and the factor (1-t)^n or t^n that is left out of the value.
        let n = (self.forward.len() - 1) as f64;
        let s = 1.0 + u;
        let slope = s * (s * slope - n * at.value);
        Local {
            at,
            slope: if t <= 0.5 { slope } else { -slope },
        }
    }

    /// The derivative with respect to `u`.
    pub(crate) fn slope_in_side(&self, t: f64) -> f64 {
        self.in_side(t).1
    }

    /// The sum, its derivative with respect to `u`, and `u`.
    #[inline]
    fn in_side(&self, t: f64) -> (Bounded, f64, f64) {
        let (coefficients, magnitudes, u) = self.side(t);
        let w = u * u;
        let degree = coefficients.len() - 1;
        let (mut even, mut odd, mut even_slope, mut odd_slope) = (0.0, 0.0, 0.0, 0.0);
        let (mut even_magnitude, mut odd_magnitude) = (0.0, 0.0);
        let paired = if degree.is_multiple_of(2) {
            even = coefficients[degree];
            even_magnitude = magnitudes[degree];
            degree
        } else {
            degree + 1
        };
        for (c, m) in coefficients[..paired]
            .chunks_exact(2)
            .zip(magnitudes[..paired].chunks_exact(2))
            .rev()
        {
            even_slope = even_slope * w + even;
            odd_slope = odd_slope * w + odd;
            even = even * w + c[0];
            odd = odd * w + c[1];
            even_magnitude = even_magnitude * w + m[0];
            odd_magnitude = odd_magnitude * w + m[1];
        }
        let at = Bounded {
            value: even + u * odd,
            bound: self.unit * (even_magnitude + u * odd_magnitude),
        };
        // d/du of even(u^2) + u odd(u^2)
        (at, odd + 2.0 * u * (even_slope + u * odd_slope), u)
    }
}

/// The sums of the even and of the odd coefficients, both in powers of `w = u^2`.
#[inline]
fn alternate(coefficients: &[f64], w: f64) -> (f64, f64) {
    let degree = coefficients.len() - 1;
    let (mut even, mut odd) = (0.0, 0.0);
    let paired = if degree.is_multiple_of(2) {
        even = coefficients[degree];
        degree
    } else {
        degree + 1
    };
    for c in coefficients[..paired].chunks_exact(2).rev() {
        even = even * w + c[0];
        odd = odd * w + c[1];
    }
    (even, odd)
}
