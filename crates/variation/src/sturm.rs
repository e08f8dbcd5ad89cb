//! Sturm's theorem in integers: an independent judge of what the solver answers.
//!
//! Nothing here is shared with the solver but the decoding of `f64`: no subdivision, no sign rule, no rounding.

use num_bigint::BigInt;

use crate::Error;
use crate::arithmetic::Number;
use crate::dyadic::{Exact, common_integers};
use crate::finite::finite_degree;
use crate::judge::Verdict;
use crate::root::Root;
use crate::sign_changes::Signed;

/// The Sturm chain of a polynomial with `f64` Bernstein coefficients on `[0, 1]`, in exact integers.
///
/// Polynomials are taken in `x = t / (1 - t)`, where the scaled coefficients `C(n,i) p_i` are those of the powers.
///
/// # Examples
/// ```
/// use variation::SturmChain;
/// let chain = SturmChain::try_new(&[27.0, -45.0, 59.0, -45.0, 27.0])?; // 3 (4t - 1)^2 (4t - 3)^2
/// assert_eq!(chain.distinct_roots(0.0, 1.0), 2);
/// assert_eq!(chain.multiplicity(0.2, 0.3), 2);
/// # Ok::<(), variation::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SturmChain {
    /// Powers of `x`, without the roots at the ends.
    chain: Vec<Vec<BigInt>>,
    at_zero: u32,
    at_one: u32,
}

impl SturmChain {
    /// The chain of these Bernstein coefficients, taken exactly.
    ///
    /// # Errors
    /// [`Error::NoCoefficients`], [`Error::NotFinite`], [`Error::IdenticallyZero`].
    pub fn try_new(coefficients: &[f64]) -> Result<Self, Error> {
        let degree = finite_degree(coefficients)?;
        let exact: Vec<Exact> = coefficients.iter().map(|p| Exact::exactly(*p)).collect();
        let binomials = crate::exact::binomials(degree);
        let mut f: Vec<BigInt> = common_integers(&exact)
            .into_iter()
            .zip(binomials)
            .map(|(p, b)| p * b)
            .collect();
        let at_one = f.iter().rev().take_while(|c| c.signum() == 0).count();
        f.truncate(f.len() - at_one);
        let at_zero = f.iter().take_while(|c| c.signum() == 0).count();
        f.drain(..at_zero);
        if f.is_empty() {
            return Err(Error::IdenticallyZero);
        }
        Ok(Self {
            chain: chain(f),
            at_zero: at_zero as u32,
            at_one: at_one as u32,
        })
    }

    /// The number of distinct roots in the closed interval `[lo, hi]` within `[0, 1]`.
    #[must_use]
    pub fn distinct_roots(&self, lo: f64, hi: f64) -> usize {
        let ends =
            usize::from(lo <= 0.0 && self.at_zero > 0) + usize::from(hi >= 1.0 && self.at_one > 0);
        let Some(first) = self.chain.first() else {
            return ends;
        };
        // Sturm counts (lo, hi]; the theorem holds at multiple roots too.
        let at_lo = usize::from(value(first, lo).signum() == 0);
        ends + at_lo + self.variations(lo).saturating_sub(self.variations(hi))
    }

    /// `Z`: the number of roots in `[0, 1]` with multiplicity.
    #[must_use]
    pub fn root_count(&self) -> usize {
        // A root of multiplicity m occurs on m levels.
        let inner: usize = self
            .levels()
            .map(|level| level.distinct_roots(0.0, 1.0))
            .sum();
        inner + (self.at_zero + self.at_one) as usize
    }

    /// The multiplicity of the only root in `[lo, hi]`, or the largest one there.
    #[must_use]
    pub fn multiplicity(&self, lo: f64, hi: f64) -> u32 {
        let at_zero = if lo <= 0.0 { self.at_zero } else { 0 };
        let at_one = if hi >= 1.0 { self.at_one } else { 0 };
        let inner = self
            .levels()
            .take_while(|level| level.distinct_roots(lo, hi) > 0)
            .count() as u32;
        at_zero.max(at_one).max(inner)
    }

    /// The chains of `f`, of the greatest common divisor of `f` and `f'`, of that of the divisor and its derivative, and so on,
    /// without the roots at the ends: a root of multiplicity `m` occurs on `m` levels.
    fn levels(&self) -> impl Iterator<Item = Self> {
        let inner = |chain: Vec<Vec<BigInt>>| Self {
            chain,
            at_zero: 0,
            at_one: 0,
        };
        std::iter::successors(Some(inner(self.chain.clone())), move |level| {
            let divisor = level.chain.last().filter(|divisor| divisor.len() > 1)?;
            Some(inner(chain(divisor.clone())))
        })
    }

    /// Compares a solver's answer with the truth.
    #[must_use]
    pub fn judge(&self, roots: &[Root]) -> Verdict {
        let mut verdict = Verdict::default();
        let mut held = 0;
        let mut i = 0;
        while i < roots.len() {
            // Roots closer than the grid of f64 share their enclosures: judge what overlaps together.
            let (lo, mut hi) = (roots[i].lo, roots[i].hi);
            let first = i;
            i += 1;
            while i < roots.len() && roots[i].lo <= hi {
                hi = hi.max(roots[i].hi);
                i += 1;
            }
            let group = &roots[first..i];
            let true_roots = self.distinct_roots(lo, hi);
            held += true_roots.min(group.len());
            verdict.false_roots += group.len().saturating_sub(true_roots);
            if let [root] = group {
                verdict.wrong_multiplicities += usize::from(
                    true_roots == 1 && root.multiplicity() != Some(self.multiplicity(lo, hi)),
                );
            }
        }
        verdict.missed = self.distinct_roots(0.0, 1.0) - held;
        verdict
    }

    fn variations(&self, t: f64) -> usize {
        let signs: Vec<i8> = self
            .chain
            .iter()
            .map(|f| value(f, t).signum())
            .filter(|s| *s != 0)
            .collect();
        signs.windows(2).filter(|s| s[0] != s[1]).count()
    }
}

/// `f(x) (1-t)^n` times a power of two.
fn value(f: &[BigInt], t: f64) -> BigInt {
    let (t, one_less) = Exact::exactly(t).share();
    let mut sum = BigInt::ZERO;
    let mut power = BigInt::from(1);
    for c in f.iter().rev() {
        sum = sum * &t + c * &power;
        power *= &one_less;
    }
    sum
}

/// The negated remainders of `f` and `f'`, by the subresultant algorithm (Brown 1978): positive multiples of Sturm's chain.
fn chain(f: Vec<BigInt>) -> Vec<Vec<BigInt>> {
    let slope: Vec<BigInt> = f.iter().enumerate().skip(1).map(|(i, c)| c * i).collect();
    let mut chain = vec![f];
    if slope.is_empty() {
        return chain;
    }
    chain.push(slope);
    let one = BigInt::from(1);
    let mut psi = one.clone();
    let mut beta = one;
    loop {
        let (f, g) = (&chain[chain.len() - 2], &chain[chain.len() - 1]);
        let delta = f.len() - g.len();
        let remainder = negated_remainder(f, g);
        if remainder.is_empty() {
            return chain;
        }
        let next: Vec<BigInt> = remainder.into_iter().map(|c| c / &beta).collect();
        // The factor of the next division: |lc g| psi^delta, with psi = |lc g|^delta / psi^(delta - 1).
        let lead = magnitude(&g[g.len() - 1]);
        let power = lead.pow(delta as u32);
        psi = if delta == 0 {
            psi
        } else {
            power / psi.pow(delta as u32 - 1)
        };
        let next_delta = (g.len() - next.len()) as u32;
        beta = lead * psi.pow(next_delta);
        chain.push(next);
    }
}

fn magnitude(x: &BigInt) -> BigInt {
    if x.signum() < 0 { -x } else { x.clone() }
}

/// `-(f |lc g|^(delta + 1) mod g)`, empty for zero.
fn negated_remainder(f: &[BigInt], g: &[BigInt]) -> Vec<BigInt> {
    let mut f = f.to_vec();
    let lead = &g[g.len() - 1];
    let scale = magnitude(lead);
    let negative = lead.signum() < 0;
    let mut missing = f.len() - g.len() + 1;
    while f.len() >= g.len() {
        let Some(top) = f.pop() else { break };
        missing -= 1;
        let top = if negative { -top } else { top };
        let shift = f.len() + 1 - g.len();
        for c in &mut f {
            *c *= &scale;
        }
        for (i, c) in g[..g.len() - 1].iter().enumerate() {
            f[shift + i] -= &top * c;
        }
        while f.last().is_some_and(|c| c.signum() == 0) && f.len() >= g.len() {
            f.pop();
            missing -= 1;
            for c in &mut f {
                *c *= &scale;
            }
        }
    }
    while f.last().is_some_and(|c| c.signum() == 0) {
        f.pop();
    }
    let rest = scale.pow(missing as u32);
    f.into_iter().map(|c| -c * &rest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_polynomials() {
        // (2t - 1)^2 and its neighbours
        let chain = SturmChain::try_new(&[1.0, -1.0, 1.0]).unwrap();
        assert_eq!(
            (chain.distinct_roots(0.0, 1.0), chain.multiplicity(0.4, 0.6)),
            (1, 2)
        );
        assert_eq!(
            SturmChain::try_new(&[1.0, -0.999, 1.0])
                .unwrap()
                .distinct_roots(0.0, 1.0),
            0
        );
        assert_eq!(
            SturmChain::try_new(&[1.0, -1.001, 1.0])
                .unwrap()
                .distinct_roots(0.0, 1.0),
            2
        );
        // t^2 (1-t) (1 - 2t)
        let chain = SturmChain::try_new(&[0.0, 0.0, 1.0 / 6.0, -0.25, 0.0]).unwrap();
        assert_eq!(chain.distinct_roots(0.0, 1.0), 3);
        assert_eq!(
            (chain.multiplicity(0.0, 0.1), chain.multiplicity(0.9, 1.0)),
            (2, 1)
        );
    }

    #[test]
    fn judgement() {
        let p = [3.0, -5.0, 3.0]; // (4t - 1)(4t - 3)
        let chain = SturmChain::try_new(&p).unwrap();
        let roots = crate::roots(&p).unwrap();
        assert_eq!(chain.judge(&roots), Verdict::default());
        assert_eq!(chain.judge(&roots[..1]).missed, 1);
        let wrong = Root {
            lo: 0.5,
            hi: 0.6,
            count: crate::Count::Exactly(1),
        };
        assert_eq!(
            chain.judge(&[roots[0], wrong]),
            Verdict {
                missed: 1,
                false_roots: 1,
                wrong_multiplicities: 0
            }
        );
    }
}
