//! The numbers: bounds against exact counts, and the solver against proofs and Sturm's theorem.

use anyhow::{Result, ensure};
use rayon::prelude::*;
use variation::sets::{Set, SplitMix64};
use variation::{
    PoleStrategy, Solver, Verdict, chain_bound, chain_bound_by, corollary_bound, pole_bound,
};

use crate::demo::Context;
use crate::report::Target;

/// Polynomials that one task takes: the stream of random numbers depends on it, the number of threads does not matter.
const STRIDE: u64 = 500;

pub(super) fn record(context: &mut Context) -> Result<()> {
    let polynomials = context.pick(1_000_000_u64, 10_000);
    let bar = context.progress("bounds", polynomials);
    let seed = context.seed();
    let bounds = (0..polynomials / STRIDE)
        .into_par_iter()
        .map_init(Solver::new, |solver, block| {
            let sum = bounds_of_block(seed, block, solver);
            bar.inc(STRIDE);
            sum
        })
        .try_reduce(Bounds::default, |a, b| Ok(a.plus(b)))?;
    bar.finish_and_clear();
    context.number(
        "bound_polynomials",
        bounds.polynomials,
        Target::exactly(polynomials),
    );
    context.number("bound_violations", bounds.violations, Target::exactly(0));
    let tighter = bounds.tighter as f64 / bounds.polynomials as f64;
    context.number("refined_tighter_share", tighter, Target::AtLeast(0.05));

    let degrees: &[usize] = context.pick(&[3, 5, 8, 12, 20, 40], &[3, 5, 8]);
    let items = context.pick(100, 10);
    let (missed, false_roots) = judge_roots(degrees, items)?;
    context.number("roots_missed", missed, Target::exactly(0));
    context.number("roots_false", false_roots, Target::exactly(0));
    Ok(())
}

#[derive(Clone, Copy, Debug, Default)]
struct Bounds {
    polynomials: u64,
    violations: u64,
    tighter: u64,
}

impl Bounds {
    fn plus(self, other: Self) -> Self {
        Self {
            polynomials: self.polynomials + other.polynomials,
            violations: self.violations + other.violations,
            tighter: self.tighter + other.tighter,
        }
    }
}

fn bounds_of_block(seed: u64, block: u64, solver: &mut Solver) -> Result<Bounds> {
    let mut random = SplitMix64::new((seed << 40) ^ block);
    let mut sum = Bounds::default();
    for _ in 0..STRIDE {
        let (p, planted) = integer_polynomial(&mut random);
        let count = planted.map_or_else(|| exact_count(&p, solver), Ok)?;
        let (violated, tighter) = check(&p, count, &mut random, solver)?;
        sum.polynomials += 1;
        sum.violations += u64::from(violated);
        sum.tighter += u64::from(tighter);
    }
    Ok(sum)
}

fn below(n: u64, random: &mut SplitMix64) -> u64 {
    random.bits() % n
}

/// Degree 1 to 7, integer coefficients: random small ones with zeros among them, or a product of linear factors with planted
/// and repeated roots, whose number in `[0, 1]` is returned too. All numbers that the bounds compute from them, with poles in
/// eighths, are exact in `f64`.
fn integer_polynomial(random: &mut SplitMix64) -> (Vec<f64>, Option<usize>) {
    let degree = 1 + below(7, random) as usize;
    if below(2, random) == 0 {
        let p = (0..=degree)
            .map(|_| below(9, random) as f64 - 4.0)
            .collect();
        return (p, None);
    }
    // Scaled coefficients c_i = C(n,i) p_i multiply like powers; 4 t - k is (4 - k) t - k (1 - t).
    let mut scaled = vec![1.0];
    let mut factor = [0.0; 2];
    let mut planted = 0;
    for k in 0..degree {
        if k == 0 || below(3, random) > 0 {
            let root = below(7, random) as f64 - 1.0;
            factor = [-root, 4.0 - root];
        }
        planted += usize::from(factor[0] <= 0.0 && factor[1] >= 0.0);
        let mut next = vec![0.0; scaled.len() + 1];
        for (i, c) in scaled.iter().enumerate() {
            next[i] += c * factor[0];
            next[i + 1] += c * factor[1];
        }
        scaled = next;
    }
    // A common multiple of C(n, 0..=n) keeps the coefficients integers.
    let binomials: Vec<u64> = (0..=degree as u64)
        .map(|i| (0..i).fold(1, |c, k| c * (degree as u64 - k) / (k + 1)))
        .collect();
    let multiple = binomials
        .iter()
        .fold(1_u64, |m, b| m / greatest_common_divisor(m, *b) * b);
    let p = scaled
        .iter()
        .zip(binomials)
        .map(|(c, b)| c * (multiple / b) as f64)
        .collect();
    (p, Some(planted))
}

fn greatest_common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}

/// `Z`, exactly; the degree plus one for the zero polynomial. The roots are the solver's, the judge confirms every one.
fn exact_count(p: &[f64], solver: &mut Solver) -> Result<usize> {
    if p.iter().all(|p| *p == 0.0) {
        return Ok(p.len());
    }
    let roots = solver.roots(p)?;
    ensure!(
        Verdict::of(p, roots)? == Verdict::default(),
        "wrong roots of {p:?}"
    );
    Ok(roots
        .iter()
        .filter_map(variation::Root::multiplicity)
        .sum::<u32>() as usize)
}

/// Whether a bound is violated, and whether poles give a smaller one than the control polygon.
fn check(
    p: &[f64],
    count: usize,
    random: &mut SplitMix64,
    solver: &mut Solver,
) -> Result<(bool, bool)> {
    let degree = p.len() - 1;
    let eighth = |random: &mut SplitMix64| below(9, random) as f64 / 8.0;
    let single = pole_bound(p, &eighth(random))?;
    let (k, l) = (
        below(degree as u64 + 1, random) as usize,
        below(degree as u64 + 1, random) as usize,
    );
    let part = corollary_bound(p, k.min(l), k.max(l))?;
    let poles: Vec<f64> = (0..=below(degree as u64, random))
        .map(|_| eighth(random))
        .collect();
    let chain = chain_bound(p, &poles)?;
    let greedy = chain_bound_by(p, degree.min(3), PoleStrategy::Halving)?;
    let plain = chain_bound(p, &[])?;
    let least = [
        single.total(exact_count(&single.middle, solver)?),
        part.total(exact_count(&part.middle, solver)?),
        chain.printed,
        // For the zero polynomial Z exceeds the degree; parity and sharpening are for the others.
        if count > degree {
            count
        } else {
            chain.best.min(greedy.best).min(plain.best)
        },
    ]
    .into_iter()
    .min()
    .unwrap_or(0);
    Ok((count > least, chain.best.min(greedy.best) < plain.best))
}

/// Missed roots, and false ones or ones of the wrong multiplicity, over the sets U, K, A, C, M and L.
fn judge_roots(degrees: &[usize], items: u64) -> Result<(usize, usize)> {
    let sets = [
        Set::Uniform,
        Set::Known,
        Set::AllReal,
        Set::Chebyshev,
        Set::Mignotte,
        Set::ClosePairs,
    ];
    let mut polynomials = Vec::new();
    for set in sets {
        for &degree in degrees {
            polynomials
                .extend((0..set.items().min(items)).map(|index| set.polynomial(degree, index)));
        }
    }
    polynomials
        .par_iter()
        .map_init(Solver::new, |solver, p| {
            let roots = solver.roots(p)?;
            let verdict = Verdict::of(p, roots)?;
            Ok((
                verdict.missed,
                verdict.false_roots + verdict.wrong_multiplicities,
            ))
        })
        .try_reduce(|| (0, 0), |a, b| Ok((a.0 + b.0, a.1 + b.1)))
}
