//! A judge of what the solver answers, fast where the answer is right.
//!
//! The interval is halved until the polynomial, or its derivative, keeps one sign on each part by its Bernstein coefficients:
//! no root, or exactly one and simple if the ends differ. Each enclosure must then hold the root of one part. This proves
//! most right answers in sums of two `f64`, with a bound on their error. Whatever is not proven is left to Sturm's theorem.
//!
//! Nothing is shared with the solver but sums of two `f64` and the coefficients in them: no Descartes' count, no refinement, no
//! fixed point.

use crate::Error;
use crate::input::Input;
use crate::root::Root;
use crate::rounding::{HALF_POWERS, MAX_FLOAT_DEGREE, U, power_of_two};
use crate::sturm::SturmChain;
use crate::twofold::Twofold;

/// How an answer compares with the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// Distinct roots of the closed interval that no enclosure holds.
    pub missed: usize,
    /// Enclosures without a root of their own.
    pub false_roots: usize,
    /// Enclosures whose multiplicity is wrong.
    pub wrong_multiplicities: usize,
}

impl Verdict {
    /// Judges what a solver found to be the roots in `[0, 1]` of the polynomial with exactly these Bernstein coefficients.
    ///
    /// A right answer is proven without big integers where no root is multiple inside the interval; anything else is judged
    /// by [`SturmChain`].
    ///
    /// # Errors
    /// [`Error::NoCoefficients`], [`Error::NotFinite`], [`Error::IdenticallyZero`].
    ///
    /// # Examples
    /// ```
    /// use variation::Verdict;
    /// let polynomial = [3.0, -5.0, 3.0]; // (4t - 1)(4t - 3)
    /// let roots = variation::roots(&polynomial)?;
    /// assert_eq!(Verdict::of(&polynomial, &roots)?, Verdict::default());
    /// assert_eq!(Verdict::of(&polynomial, &roots[1..])?.missed, 1);
    /// # Ok::<(), variation::Error>(())
    /// ```
    pub fn of(coefficients: &[f64], roots: &[Root]) -> Result<Self, Error> {
        if Proof::of(coefficients, roots).is_some() {
            return Ok(Self::default());
        }
        Ok(SturmChain::try_new(coefficients)?.judge(roots))
    }
}

/// Halvings before a proof is given up.
const MAX_DEPTH: u32 = 50;

/// Magnitudes of coefficients with which nothing overflows, and powers of `1 - t` underflow only where they do not matter.
const LEAST: f64 = power_of_two(-150);
const MOST: f64 = power_of_two(150);

/// That an answer is right.
struct Proof;

/// A part `[lo, hi]` of the interval with the Bernstein coefficients there, each with an absolute error of at most `error`.
struct Part {
    lo: f64,
    hi: f64,
    depth: u32,
    row: Vec<Twofold>,
    error: f64,
}

/// A part that holds exactly one root, simple.
#[derive(Clone, Copy, Debug)]
struct Isolated {
    lo: f64,
    hi: f64,
    negative_lo: bool,
}

impl Proof {
    /// `None` if the answer is wrong or this arithmetic cannot tell.
    fn of(coefficients: &[f64], roots: &[Root]) -> Option<Self> {
        let in_range = |p: &f64| *p == 0.0 || (LEAST..=MOST).contains(&p.abs());
        let size = coefficients.len();
        if size == 0 || size > MAX_FLOAT_DEGREE + 1 || !coefficients.iter().all(in_range) {
            return None;
        }
        let input = Input::exactly(coefficients);
        let (at_zero, at_one) = input.zeros;
        if at_zero == size {
            return None;
        }
        let mut inner = roots;
        for (at, multiplicity) in [(0.0, at_zero), (1.0, at_one)] {
            if multiplicity > 0 {
                let (end, rest) = if at == 0.0 {
                    inner.split_first()?
                } else {
                    inner.split_last()?
                };
                if *end != Root::exactly(at, at, multiplicity as u32) {
                    return None;
                }
                inner = rest;
            }
        }
        let isolated = isolate(&input)?;
        if isolated.len() != inner.len() {
            return None;
        }
        let values = Values::new(&input)?;
        let mut last = 0.0;
        for (isolated, root) in isolated.iter().zip(inner) {
            let apart = root.lo >= last;
            last = root.hi;
            if !(apart && root.multiplicity() == Some(1) && values.encloses(*isolated, root)) {
                return None;
            }
        }
        Some(Self)
    }
}

/// The parts that hold the roots of the open interval, ascending.
fn isolate(input: &Input<'_>) -> Option<Vec<Isolated>> {
    let row: Option<Vec<Twofold>> = (0..input.inner().len())
        .map(|k| input.remaining(k))
        .collect();
    let row = row?;
    let error = if input.is_given() {
        0.0
    } else {
        Twofold::ERROR * largest(&row)
    };
    let mut waiting = vec![Part {
        lo: 0.0,
        hi: 1.0,
        depth: 0,
        row,
        error,
    }];
    let mut isolated = Vec::new();
    while let Some(part) = waiting.pop() {
        let (first, last) = (part.row.first()?.high, part.row.last()?.high);
        if first.abs() <= part.error || last.abs() <= part.error {
            return None;
        }
        if part.keeps_its_sign() {
            continue;
        }
        if part.is_monotone() {
            if (first < 0.0) != (last < 0.0) {
                isolated.push(Isolated {
                    lo: part.lo,
                    hi: part.hi,
                    negative_lo: first < 0.0,
                });
            }
            continue;
        }
        if part.depth == MAX_DEPTH {
            return None;
        }
        let (left, right) = part.halves();
        waiting.push(right);
        waiting.push(left);
    }
    Some(isolated)
}

fn largest(row: &[Twofold]) -> f64 {
    row.iter().fold(0.0_f64, |m, p| m.max(p.high.abs()))
}

/// Whether all numbers are certainly positive, or all certainly negative.
fn one_sign(mut numbers: impl Iterator<Item = f64> + Clone, error: f64) -> bool {
    numbers.clone().all(|x| x > error) || numbers.all(|x| x < -error)
}

impl Part {
    fn keeps_its_sign(&self) -> bool {
        one_sign(self.row.iter().map(|p| p.high), self.error)
    }

    fn is_monotone(&self) -> bool {
        let error = 2.0 * (self.error + Twofold::ROUNDING * largest(&self.row));
        one_sign(
            self.row.windows(2).map(|p| p[1].minus(p[0]).high),
            // The difference of the high parts alone is rounded once more.
            error * (1.0 + 8.0 * U),
        )
    }

    /// De Casteljau at 1/2; row `j` carries a factor `2^j` until the end.
    fn halves(self) -> (Self, Self) {
        let Self {
            lo,
            hi,
            depth,
            mut row,
            error,
        } = self;
        let degree = row.len() - 1;
        // Each row rounds its averages once, and averages never grow; one row more pays for rounding the bound.
        let error = error + (degree + 2) as f64 * Twofold::ROUNDING * largest(&row);
        let mut left = Vec::with_capacity(row.len());
        left.push(row[0]);
        for (j, power) in HALF_POWERS[..=degree].iter().enumerate().skip(1) {
            for i in 0..=degree - j {
                row[i] = row[i].plus(row[i + 1]);
            }
            left.push(row[0].scaled(*power));
        }
        for (value, power) in row.iter_mut().zip(HALF_POWERS[..=degree].iter().rev()) {
            *value = value.scaled(*power);
        }
        let middle = 0.5 * (lo + hi);
        let part = |lo: f64, hi: f64, row: Vec<Twofold>| Self {
            lo,
            hi,
            depth: depth + 1,
            row,
            error,
        };
        (part(lo, middle, left), part(middle, hi, row))
    }
}

/// Signs of values.
struct Values {
    /// `C(n,i) p_i`.
    scaled: Vec<Twofold>,
}

impl Values {
    fn new(input: &Input<'_>) -> Option<Self> {
        let scaled: Option<Vec<Twofold>> =
            (0..input.inner().len()).map(|k| input.scaled(k)).collect();
        Some(Self { scaled: scaled? })
    }

    /// Whether the only root of a part, on which the polynomial is monotone, lies in an enclosure.
    fn encloses(&self, isolated: Isolated, root: &Root) -> bool {
        let Isolated {
            lo,
            hi,
            negative_lo,
        } = isolated;
        if root.hi <= lo || root.lo >= hi {
            return false;
        }
        let below = root.lo <= lo || self.sign(root.lo) == Some(negative_lo);
        let above = root.hi >= hi || self.sign(root.hi) == Some(!negative_lo);
        below && above
    }

    /// Whether the value at `t` is negative, where that is certain: Horner's scheme in `t` and `1 - t`.
    fn sign(&self, t: f64) -> Option<bool> {
        let rest = Twofold::new(1.0).minus(Twofold::new(t));
        let t = Twofold::new(t);
        let mut power = Twofold::new(1.0);
        let (mut sum, mut magnitude) = (Twofold::ZERO, 0.0);
        for c in self.scaled.iter().rev() {
            let term = c.times(power);
            sum = sum.times(t).plus(term);
            magnitude = magnitude * t.high + term.high.abs();
            power = power.times(rest);
        }
        // A term meets one rounding in each product and sum on its way, and those of its coefficient.
        let roundings = (3 * self.scaled.len() + 8) as f64;
        let error = 2.0 * roundings * Twofold::ROUNDING * magnitude + f64::MIN_POSITIVE;
        (sum.high.abs() > error).then_some(sum.high < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sets::{Set, SplitMix64, planted};

    /// The proof never contradicts Sturm's theorem, and wrong answers are never proven.
    #[test]
    fn proofs_and_sturm_agree() {
        let mut random = SplitMix64::new(1);
        let mut proven = 0;
        for k in 0..400 {
            let p = planted(1 + k % 12, &mut random);
            let roots = crate::roots(&p).unwrap();
            let chain = SturmChain::try_new(&p).unwrap();
            assert_eq!(chain.judge(&roots), Verdict::default());
            proven += usize::from(Proof::of(&p, &roots).is_some());
            if let Some((last, others)) = roots.split_last() {
                assert!(Proof::of(&p, others).is_none(), "a missed root: {p:?}");
                let mut wrong = others.to_vec();
                wrong.push(Root {
                    count: crate::Count::Exactly(9),
                    ..*last
                });
                assert!(Proof::of(&p, &wrong).is_none(), "a wrong multiplicity");
                wrong.pop();
                wrong.push(Root::exactly(last.hi.next_up(), last.hi + 1e-9, 1));
                assert!(Proof::of(&p, &wrong).is_none(), "a wrong place: {p:?}");
            }
        }
        assert!(proven > 360, "{proven} of 400");
    }

    #[test]
    fn a_root_too_many_is_not_proven() {
        let p = Set::RootFree.polynomial(8, 0);
        assert!(Proof::of(&p, &[]).is_some());
        assert!(Proof::of(&p, &[Root::exactly(0.4, 0.5, 1)]).is_none());
    }
}
