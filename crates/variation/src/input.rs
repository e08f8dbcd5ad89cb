//! A polynomial as the solver sees it: rounded coefficients, a bound on their error, and where more digits come from.

#[cfg(feature = "exact")]
use crate::dyadic::{Exact, common_integers};
#[cfg(feature = "exact")]
use crate::exact::Decomposition;
#[cfg(feature = "exact")]
use crate::rounding::U;
use crate::twofold::Twofold;

/// Bernstein coefficients `p_i` of a polynomial on `[0, 1]`.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub(crate) coefficients: &'a [f64],
    /// Bound on the absolute error of each coefficient.
    pub(crate) error: f64,
    /// Numbers of leading and of trailing coefficients that are certainly zero.
    pub(crate) zeros: (usize, usize),
    pub(crate) origin: Origin<'a>,
}

/// Where the exact coefficients come from.
#[derive(Clone, Copy)]
pub(crate) enum Origin<'a> {
    /// They are the given ones.
    Coefficients,
    /// The given ones are these, rounded; in scaled form `C(n,i) p_i`.
    #[cfg(feature = "exact")]
    Exactly(&'a [Exact]),
    /// The given ones are computed; this forms the exact ones, in scaled form.
    #[cfg(feature = "exact")]
    Formed(&'a dyn Fn() -> Vec<Exact>),
    /// The given ones are computed and there is no exact arithmetic.
    #[cfg(not(feature = "exact"))]
    Formed(std::marker::PhantomData<&'a ()>),
}

/// Numbers of leading and trailing entries for which `is_zero` holds.
pub(crate) fn zeros_at_ends<T>(values: &[T], is_zero: impl Fn(&T) -> bool) -> (usize, usize) {
    (
        values.iter().take_while(|v| is_zero(v)).count(),
        values.iter().rev().take_while(|v| is_zero(v)).count(),
    )
}

impl std::fmt::Debug for Input<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.coefficients).finish()
    }
}

impl<'a> Input<'a> {
    /// The polynomial with exactly these coefficients.
    pub(crate) fn exactly(coefficients: &'a [f64]) -> Self {
        Self {
            coefficients,
            error: 0.0,
            zeros: zeros_at_ends(coefficients, |p| *p == 0.0),
            origin: Origin::Coefficients,
        }
    }

    /// The polynomial with exactly these scaled coefficients; `store` keeps the rounded ones.
    #[cfg(feature = "exact")]
    pub(crate) fn nearest_to(exact: &'a [Exact], store: &'a mut Vec<f64>) -> Self {
        let degree = exact.len().saturating_sub(1);
        *store = exact
            .iter()
            .enumerate()
            .map(|(i, c)| c.nearest() / crate::arithmetic::binomial_f64(degree, i))
            .collect();
        let largest = store.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        Self {
            coefficients: store,
            // Two roundings and a quotient; subnormal ones lose less than the constant.
            error: 4.0 * U * largest + f64::MIN_POSITIVE,
            zeros: zeros_at_ends(exact, Exact::is_zero),
            origin: Origin::Exactly(exact),
        }
    }

    /// The coefficients without the zeros at both ends.
    pub(crate) fn inner(&self) -> &'a [f64] {
        &self.coefficients[self.zeros.0..self.coefficients.len() - self.zeros.1]
    }

    /// Whether exactly the coefficients outside of [`Input::inner`] are zeros at the ends.
    pub(crate) fn knows_its_ends(&self) -> bool {
        let certain = |p: Option<&f64>| p.is_some_and(|p| p.abs() > self.error);
        !matches!(self.origin, Origin::Formed(_))
            || certain(self.inner().first()) && certain(self.inner().last())
    }

    /// Whether [`Input::scaled`] has an answer.
    pub(crate) fn has_digits(&self) -> bool {
        !matches!(self.origin, Origin::Formed(_))
    }

    /// `C(n,i) p_i` of the `k`-th inner coefficient to twice the digits of `f64`.
    pub(crate) fn scaled(&self, k: usize) -> Option<Twofold> {
        let i = self.zeros.0 + k;
        match self.origin {
            Origin::Coefficients => {
                let n = self.coefficients.len() - 1;
                Some(Twofold::times_binomial(self.coefficients[i], n, i))
            }
            #[cfg(feature = "exact")]
            Origin::Exactly(exact) => Some(exact[i].twofold()),
            Origin::Formed(_) => None,
        }
    }

    /// The `k`-th Bernstein coefficient of what remains without the factors `t` and `1 - t`, to twice the digits of `f64`;
    /// exact if it is one of the given ones.
    pub(crate) fn remaining(&self, k: usize) -> Option<Twofold> {
        if self.is_given() {
            return Some(Twofold {
                high: self.coefficients[k],
                low: 0.0,
            });
        }
        let degree = self.inner().len() - 1;
        Some(self.scaled(k)?.over_binomial(degree, k))
    }

    /// Whether [`Input::remaining`] is exact.
    pub(crate) fn is_given(&self) -> bool {
        matches!(self.origin, Origin::Coefficients) && self.zeros == (0, 0)
    }

    /// The square-free factors; `None` for the zero polynomial.
    #[cfg(feature = "exact")]
    pub(crate) fn decomposition(&self) -> Option<Decomposition> {
        match self.origin {
            Origin::Coefficients => Decomposition::of_bernstein(self.coefficients),
            Origin::Exactly(exact) => Decomposition::of_homogeneous(common_integers(exact)),
            Origin::Formed(form) => Decomposition::of_homogeneous(common_integers(&form())),
        }
    }
}
