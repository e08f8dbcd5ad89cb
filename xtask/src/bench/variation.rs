//! Root isolation: time, missed and false roots by set and degree, beside power-basis solvers; and the soak test.

use std::hint::black_box;
use std::time::{Duration, Instant};

use ::variation::sets::{Set, SplitMix64, planted};
use ::variation::{Root, Solver, Verdict, to_power_form};
use aberth::AberthSolver;
use anyhow::{Context as _, Result, ensure};
use polycool::{Poly, PolyDyn};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::{Bench, Timer};
use crate::demo::progress_bar;

/// A found root counts if it lies this close to a true one.
const MATCH: f64 = 1e-6;

/// Accuracy that every solver is asked for, where it can be told.
const ACCURACY: f64 = 1e-12;

/// An imaginary part up to this, relative to `1 + |re|`, counts as none.
const REAL: f64 = 1e-9;

/// Degrees up to which peers are timed.
const PEER_DEGREE: usize = 40;

/// A peer that is slow takes the first polynomials of a set, as many as it solves in this time; the table states how many.
const PEER_TIME: Duration = Duration::from_millis(250);

#[derive(clap::Args, Debug)]
pub(super) struct Variation {
    /// Letters of the sets to measure
    #[arg(long, default_value = "UKACMLWF")]
    sets: String,
    /// Degrees to measure
    #[arg(long, value_delimiter = ',', default_value = "3,5,8,12,20,40")]
    degrees: Vec<usize>,
    /// Leave the peers out
    #[arg(long)]
    alone: bool,
    /// Judge the roots of random polynomials with planted roots instead of timing
    #[arg(long)]
    soak: bool,
    /// How many polynomials the soak test takes
    #[arg(long, default_value_t = 10_000_000)]
    soak_count: u64,
    /// Where the soak test starts counting, to continue an earlier run
    #[arg(long, default_value_t = 0)]
    soak_start: u64,
}

impl Bench for Variation {
    const NAME: &'static str = "variation";
    const ABOUT: &'static str = "Certified real roots of Bernstein polynomials";

    fn run(&self, timer: &Timer) -> Result<Value> {
        if self.soak {
            return Ok(soak(self.soak_start, self.soak_count));
        }
        let mut rows = Vec::new();
        for letter in self.sets.chars() {
            let set =
                Set::from_letter(letter).with_context(|| format!("there is no set {letter}"))?;
            for &degree in &self.degrees {
                ensure!(
                    (2..=60).contains(&degree),
                    "the sets are defined for degrees 2 to 60"
                );
                rows.push(self.row(set, degree, timer)?);
            }
        }
        Ok(json!({ "rows": rows }))
    }
}

/// Missed and false roots.
#[derive(Clone, Copy, Debug, Default)]
struct Score {
    missed: usize,
    false_roots: usize,
}

impl Variation {
    fn row(&self, set: Set, degree: usize, timer: &Timer) -> Result<Value> {
        let items: Vec<Vec<f64>> = (0..set.items())
            .map(|index| set.polynomial(degree, index))
            .collect();
        let mut solver = Solver::new();
        let ns = timer.nanoseconds(|| {
            for item in &items {
                let _ = black_box(solver.roots(black_box(item)));
            }
        }) / items.len() as f64;
        let truth = truth(&items)?;
        let score = truth
            .iter()
            .fold(Score::default(), |sum, (_, own)| sum.plus(*own));
        let mut row = json!({
            "set": set.letter().to_string(),
            "degree": degree,
            "ns": ns.round(),
            "roots": truth.iter().map(|(roots, _)| roots.len()).sum::<usize>(),
            "missed": score.missed,
            "false": score.false_roots,
        });
        if !self.alone && degree <= PEER_DEGREE {
            row["peers"] = Value::Object(peers(&items, degree, &truth, timer)?);
        }
        Ok(row)
    }
}

impl Score {
    fn plus(self, other: Self) -> Self {
        Self {
            missed: self.missed + other.missed,
            false_roots: self.false_roots + other.false_roots,
        }
    }
}

/// The exact roots of each polynomial, and how our answer compares with them.
///
/// The enclosures are the solver's own; they are the truth only because, and where, the judge confirms every one.
fn truth(items: &[Vec<f64>]) -> Result<Vec<(Vec<f64>, Score)>> {
    items
        .par_iter()
        .map_init(Solver::new, |solver, item| {
            let roots: Vec<Root> = solver.roots(item)?.to_vec();
            let verdict = Verdict::of(item, &roots)?;
            let score = Score {
                missed: verdict.missed,
                false_roots: verdict.false_roots + verdict.wrong_multiplicities,
            };
            Ok((roots.iter().map(Root::value).collect(), score))
        })
        .collect()
}

/// A solver of power coefficients, constant first; roots in `[0, 1]` in any order.
type Peer<'a> = Box<dyn FnMut(&[f64]) -> Vec<f64> + 'a>;

fn peers(
    items: &[Vec<f64>],
    degree: usize,
    truth: &[(Vec<f64>, Score)],
    timer: &Timer,
) -> Result<Map<String, Value>> {
    let powers: Vec<Vec<f64>> = items
        .iter()
        .map(|item| to_power_form(item))
        .collect::<Result<_, _>>()?;
    let mut peers: Vec<(&str, Peer<'_>)> = Vec::new();
    peers.push(("polycool", polycool(degree)));
    if degree == 3 {
        peers.push(("kurbo", Box::new(kurbo)));
    }
    let mut aberth = AberthSolver::<f64>::new();
    aberth.epsilon = ACCURACY;
    peers.push((
        "aberth",
        Box::new(move |a| {
            aberth
                .find_roots(a)
                .iter()
                .filter(|z| is_real(z.re, z.im))
                .map(|z| z.re)
                .filter(in_unit)
                .collect()
        }),
    ));
    if let Some(rpoly) = rpoly(degree) {
        peers.push(("rpoly", rpoly));
    }
    let mut result = Map::new();
    for (name, mut solve) in peers {
        let clock = Instant::now();
        let (mut score, mut taken) = (Score::default(), 0);
        for (power, (roots, _)) in powers.iter().zip(truth) {
            score = score.plus(compare(roots, solve(power)));
            taken += 1;
            if clock.elapsed() > PEER_TIME {
                break;
            }
        }
        let ns = timer.nanoseconds(|| {
            for power in &powers[..taken] {
                black_box(solve(black_box(power)));
            }
        }) / taken as f64;
        let mut figures =
            json!({ "ns": ns.round(), "missed": score.missed, "false": score.false_roots });
        if taken < powers.len() {
            figures["of"] = json!(taken);
        }
        result.insert(name.into(), figures);
    }
    Ok(result)
}

fn in_unit(t: &f64) -> bool {
    (-MATCH..=1.0 + MATCH).contains(t)
}

fn is_real(re: f64, im: f64) -> bool {
    im.abs() <= REAL * (1.0 + re.abs())
}

/// Matches ascending lists one to one.
fn compare(truth: &[f64], mut found: Vec<f64>) -> Score {
    found.sort_by(f64::total_cmp);
    let (mut i, mut matched) = (0, 0);
    for root in truth {
        while i < found.len() && found[i] < root - MATCH {
            i += 1;
        }
        if i < found.len() && found[i] <= root + MATCH {
            matched += 1;
            i += 1;
        }
    }
    // A root just outside the interval is no false one: it may belong to an end.
    let inside = found.iter().filter(|t| (0.0..=1.0).contains(*t)).count();
    Score {
        missed: truth.len() - matched,
        false_roots: inside.saturating_sub(matched),
    }
}

/// The fastest form that the crate has for this degree.
fn polycool<'a>(degree: usize) -> Peer<'a> {
    fn fixed<const N: usize>(a: &[f64]) -> Poly<N> {
        let mut coefficients = [0.0; N];
        for (c, a) in coefficients.iter_mut().zip(a) {
            *c = *a;
        }
        Poly::new(coefficients)
    }
    match degree {
        3 => Box::new(|a| fixed::<4>(a).roots_between(0.0, 1.0, ACCURACY).to_vec()),
        4 => Box::new(|a| fixed::<5>(a).roots_between(0.0, 1.0, ACCURACY).to_vec()),
        5 => Box::new(|a| fixed::<6>(a).roots_between(0.0, 1.0, ACCURACY).to_vec()),
        8 => Box::new(|a| fixed::<9>(a).roots_between(0.0, 1.0, ACCURACY).to_vec()),
        _ => {
            let (mut out, mut scratch) = (Vec::new(), Vec::new());
            Box::new(move |a| {
                PolyDyn::new(a.iter().copied()).roots_between_with_buffer(
                    0.0,
                    1.0,
                    ACCURACY,
                    &mut out,
                    &mut scratch,
                );
                out.clone()
            })
        }
    }
}

fn kurbo(a: &[f64]) -> Vec<f64> {
    let &[c0, c1, c2, c3] = a else {
        return Vec::new();
    };
    ::kurbo::common::solve_cubic(c0, c1, c2, c3)
        .into_iter()
        .filter(in_unit)
        .collect()
}

fn rpoly<'a>(degree: usize) -> Option<Peer<'a>> {
    fn solve<const N: usize>(a: &[f64]) -> Vec<f64> {
        let mut coefficients = [0.0; N];
        for (c, a) in coefficients.iter_mut().rev().zip(a) {
            *c = *a;
        }
        ::rpoly::rpoly(&coefficients).map_or_else(
            |_| Vec::new(),
            |roots| {
                roots
                    .into_iter()
                    .filter(|z| is_real(z.re, z.im))
                    .map(|z| z.re)
                    .filter(in_unit)
                    .collect()
            },
        )
    }
    Some(match degree {
        3 => Box::new(solve::<4>),
        4 => Box::new(solve::<5>),
        5 => Box::new(solve::<6>),
        8 => Box::new(solve::<9>),
        12 => Box::new(solve::<13>),
        20 => Box::new(solve::<21>),
        40 => Box::new(solve::<41>),
        _ => return None,
    })
}

/// Random polynomials of degree 1 to 20 with planted roots, each judged on the exact roots of the rounded coefficients.
fn soak(start: u64, count: u64) -> Value {
    /// Polynomials between two reports of progress.
    const STRIDE: u64 = 1000;
    let clock = Instant::now();
    let bar = progress_bar("soak", count);
    let blocks = (start / STRIDE..(start + count).div_ceil(STRIDE)).into_par_iter();
    let sums = blocks
        .map_init(Solver::new, |solver, block| {
            let mut random = SplitMix64::new(0x50AC_0000_0000_0000 + block);
            let mut sums = [0_usize; 4];
            for k in 0..STRIDE {
                let polynomial = planted(1 + (k % 20) as usize, &mut random);
                let verdict = solver.roots(&polynomial).and_then(|roots| {
                    sums[0] += roots.len();
                    Verdict::of(&polynomial, roots)
                });
                // Every planted polynomial is finite and not zero, so an error is a wrong answer.
                let verdict = verdict.unwrap_or(Verdict {
                    missed: 1,
                    ..Verdict::default()
                });
                sums[1] += verdict.missed;
                sums[2] += verdict.false_roots;
                sums[3] += verdict.wrong_multiplicities;
            }
            bar.inc(STRIDE);
            sums
        })
        .reduce(|| [0; 4], |a, b| std::array::from_fn(|i| a[i] + b[i]));
    bar.finish_and_clear();
    json!({
        "polynomials": count,
        "distinct_roots": sums[0],
        "missed": sums[1],
        "false": sums[2],
        "wrong_multiplicities": sums[3],
        "seconds": clock.elapsed().as_secs_f64().round(),
    })
}
