//! The two arithmetics in which a derived polynomial is formed: `f64` with a running error bound, and exact.
//!
//! Lines, implicit curves, powers and determinants of control points all lead to sums of products of the given numbers.
//! They are written once, over [`Number`], in the *scaled* form `c_i = C(n,i) p_i`, in which a product of polynomials is a
//! convolution.

use crate::Error;
use crate::input::{Input, Origin, zeros_at_ends};
use crate::root::{Interval, Root};
use crate::rounding::{BINOMIALS, MAX_FLOAT_DEGREE, U};
use crate::solver::Solver;

/// What a derived polynomial needs of its numbers.
pub(crate) trait Number: Clone {
    fn exactly(x: f64) -> Self;
    fn sum(&self, other: &Self) -> Self;
    fn difference(&self, other: &Self) -> Self;
    fn product(&self, other: &Self) -> Self;
    /// The product with an integer.
    fn times(&self, factor: u128) -> Self;
}

/// A computed number with a bound on its absolute error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Approximate {
    value: f64,
    error: f64,
}

impl Approximate {
    /// Adds the rounding of the last operation. The factor pays for the roundings of the bound, the constant for underflow.
    fn rounded(value: f64, error: f64) -> Self {
        Self {
            value,
            error: (error + U * value.abs()) * (1.0 + 8.0 * U) + f64::MIN_POSITIVE,
        }
    }
}

impl Number for Approximate {
    fn exactly(x: f64) -> Self {
        Self {
            value: x,
            error: 0.0,
        }
    }

    fn sum(&self, other: &Self) -> Self {
        if other.value == 0.0 && other.error == 0.0 {
            return *self;
        }
        if self.value == 0.0 && self.error == 0.0 {
            return *other;
        }
        Self::rounded(self.value + other.value, self.error + other.error)
    }

    fn difference(&self, other: &Self) -> Self {
        self.sum(&Self {
            value: -other.value,
            ..*other
        })
    }

    fn product(&self, other: &Self) -> Self {
        let value = self.value * other.value;
        if value == 0.0 && (self.is_zero() || other.is_zero()) {
            return Self::exactly(0.0);
        }
        // A factor that is a power of two (1 above all) is exact.
        let exact =
            (self.is_sign() && other.error == 0.0) || (other.is_sign() && self.error == 0.0);
        if exact {
            return Self::exactly(value);
        }
        let error = self.error * other.value.abs()
            + other.error * self.value.abs()
            + self.error * other.error;
        Self::rounded(value, error)
    }

    fn times(&self, factor: u128) -> Self {
        let exact = factor <= 1 << 53;
        let factor = Self {
            value: factor as f64,
            error: if exact { 0.0 } else { U * factor as f64 },
        };
        self.product(&factor)
    }
}

impl Approximate {
    fn is_zero(&self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }

    /// Exactly 1 or -1.
    fn is_sign(&self) -> bool {
        self.value.abs() == 1.0 && self.error == 0.0
    }
}

/// Derived polynomials are formed up to this degree: their binomials fit `u128`.
const MAX_DERIVED_DEGREE: usize = 120;

/// A derived polynomial, written once for both arithmetics.
pub(crate) trait Form {
    fn degree(&self) -> usize;
    /// Its scaled coefficients `C(n,i) p_i`, up to a common positive factor.
    fn scaled<N: Number>(&self) -> Vec<N>;
}

/// Bernstein coefficients of a form, rounded, with a bound on the error of each.
pub(crate) fn coefficients(form: &impl Form) -> Result<(Vec<f64>, f64), Error> {
    let scaled = checked(form)?;
    Ok(unscaled(&scaled))
}

fn checked(form: &impl Form) -> Result<Vec<Approximate>, Error> {
    let degree = form.degree();
    if degree > MAX_DERIVED_DEGREE {
        return Err(Error::DegreeTooHigh {
            degree,
            limit: MAX_DERIVED_DEGREE,
        });
    }
    let scaled = form.scaled::<Approximate>();
    match scaled
        .iter()
        .position(|c| !(c.value.is_finite() && c.error.is_finite()))
    {
        Some(index) => Err(Error::NotFinite {
            index,
            value: scaled[index].value,
        }),
        None => Ok(scaled),
    }
}

/// The roots of a form.
pub(crate) fn roots_of<'s>(
    form: &impl Form,
    interval: Interval,
    solver: &'s mut Solver,
) -> Result<&'s [Root], Error> {
    let scaled = checked(form)?;
    let zeros = zeros_at_ends(&scaled, Approximate::is_zero);
    let (coefficients, error) = unscaled(&scaled);
    #[cfg(feature = "exact")]
    let exactly = || form.scaled::<crate::dyadic::Exact>();
    #[cfg(feature = "exact")]
    let origin = Origin::Formed(&exactly);
    #[cfg(not(feature = "exact"))]
    let origin = Origin::Formed(std::marker::PhantomData);
    solver.solve(
        &Input {
            coefficients: &coefficients,
            error,
            zeros,
            origin,
        },
        interval,
    )
}

/// `C(n, i)` for `n` up to [`MAX_DERIVED_DEGREE`].
pub(crate) fn binomial(n: usize, i: usize) -> u128 {
    (0..i.min(n - i) as u128).fold(1, |c, k| c * (n as u128 - k) / (k + 1))
}

/// Product of two scaled polynomials.
pub(crate) fn convolve<N: Number>(f: &[N], g: &[N]) -> Vec<N> {
    let mut result = vec![N::exactly(0.0); (f.len() + g.len()).saturating_sub(1)];
    for (i, x) in f.iter().enumerate() {
        for (j, y) in g.iter().enumerate() {
            result[i + j] = result[i + j].sum(&x.product(y));
        }
    }
    result
}

/// Every coefficient times a number.
pub(crate) fn multiply<N: Number>(f: &[N], factor: f64) -> Vec<N> {
    let factor = N::exactly(factor);
    f.iter().map(|c| c.product(&factor)).collect()
}

/// Sum of two scaled polynomials of the same degree.
pub(crate) fn add<N: Number>(f: &[N], g: &[N]) -> Vec<N> {
    f.iter().zip(g).map(|(x, y)| x.sum(y)).collect()
}

/// Difference of two scaled polynomials of the same degree.
pub(crate) fn subtract<N: Number>(f: &[N], g: &[N]) -> Vec<N> {
    f.iter().zip(g).map(|(x, y)| x.difference(y)).collect()
}

/// `sum c X^i Y^j W^(m-i-j)` in scaled form, `m` the largest `i + j`.
pub(crate) fn compose<N: Number>(x: &[N], y: &[N], w: &[N], terms: &[(usize, usize, N)]) -> Vec<N> {
    let m = terms.iter().map(|(i, j, _)| i + j).max().unwrap_or(0);
    let powers = |base: &[N]| {
        let mut powers = vec![vec![N::exactly(1.0)]];
        for k in 0..m {
            let next = convolve(&powers[k], base);
            powers.push(next);
        }
        powers
    };
    let (x, y, w) = (powers(x), powers(y), powers(w));
    terms
        .iter()
        .map(|(i, j, c)| {
            let product = convolve(&convolve(&x[*i], &y[*j]), &w[m - i - j]);
            product.iter().map(|p| p.product(c)).collect::<Vec<N>>()
        })
        .reduce(|sum, term| add(&sum, &term))
        .unwrap_or_default()
}

/// Bernstein coefficients of a scaled polynomial, and a bound on the error of each.
fn unscaled(scaled: &[Approximate]) -> (Vec<f64>, f64) {
    let degree = scaled.len().saturating_sub(1);
    let mut error = 0.0_f64;
    let coefficients = scaled
        .iter()
        .enumerate()
        .map(|(i, c)| {
            let exact = binomial_f64(degree, i);
            let value = c.value / exact;
            let own = if exact == 1.0 {
                c.error
            } else {
                (c.error / exact + 2.0 * U * value.abs()) * (1.0 + 8.0 * U)
            };
            error = error.max(own);
            value
        })
        .collect();
    (coefficients, error)
}

/// `C(n, i)`, rounded.
pub(crate) fn binomial_f64(n: usize, i: usize) -> f64 {
    if n <= MAX_FLOAT_DEGREE {
        BINOMIALS[n][i]
    } else {
        binomial(n, i) as f64
    }
}
