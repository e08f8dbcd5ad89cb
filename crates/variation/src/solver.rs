//! The front door: from coefficients to roots, through `f64` first and exact arithmetic where that cannot decide.

use crate::Error;
#[cfg(feature = "exact")]
use crate::exact::{self, Decomposition};
use crate::isolate::{self, Finding, Findings, Node, Values, node_capacity, rows_len};
use crate::low_degree;
use crate::root::{Count, INLINE, Interval, Root, Roots};
use crate::rounding::power_of_two;
use crate::rounding::{BINOMIALS, Evaluator, MAX_FLOAT_DEGREE, SAFE_EXPONENT, U, evaluator_len};
use crate::sharp::{Sharp, sharp_len};
use crate::sign_changes::descartes_changes;
use crate::subdivision::{self, Coefficient};

/// The width, relative to the interval, to which roots are enclosed unless asked otherwise.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;

/// All real roots in `[0, 1]` of `sum p_i C(n,i) t^i (1-t)^(n-i)`, ascending, each certified.
///
/// Allocates nothing up to degree 16 unless `f64` cannot decide a sign. To solve many, keep a [`Solver`].
///
/// # Errors
/// [`Error::NoCoefficients`], [`Error::NotFinite`], [`Error::IdenticallyZero`]. A nonzero constant has no roots.
///
/// # Examples
/// ```
/// // (4t - 1)^2 (4t - 3)^2, times 3: two double roots
/// let roots = variation::roots(&[27.0, -45.0, 59.0, -45.0, 27.0])?;
/// assert!((roots[0].value() - 0.25).abs() <= 1e-12 && (roots[1].value() - 0.75).abs() <= 1e-12);
/// # #[cfg(feature = "exact")]
/// assert_eq!(roots[0].multiplicity(), Some(2));
/// # Ok::<(), variation::Error>(())
/// ```
pub fn roots(coefficients: &[f64]) -> Result<Roots, Error> {
    roots_on(coefficients, Interval::UNIT)
}

/// All real roots in `interval` of a polynomial given by its Bernstein coefficients on that interval.
///
/// # Errors
/// As [`roots`].
pub fn roots_on(coefficients: &[f64], interval: Interval) -> Result<Roots, Error> {
    const N: usize = INLINE;
    if let Some(found) = low_degree::solve(coefficients, DEFAULT_TOLERANCE) {
        return Ok(roots_of_spans(&found, interval).collect());
    }
    if coefficients.len() > N + 1 {
        return Solver::new()
            .roots_on(coefficients, interval)
            .map(Roots::from_slice);
    }
    let mut numbers = [0.0; numbers_len(N)];
    let mut waiting = [Node::NONE; node_capacity(N)];
    let mut findings = [Finding::NONE; node_capacity(N)];
    let mut roots = [Root::NONE; roots_capacity(N)];
    let scratch = Scratch {
        numbers: &mut numbers,
        waiting: &mut waiting,
        findings: &mut findings,
        fixed: &mut Fixed::default(),
        roots: &mut roots,
    };
    let len = solve(
        &Input::exactly(coefficients),
        interval,
        Options::DEFAULT,
        scratch,
    )?;
    Ok(Roots::from_slice(&roots[..len]))
}

/// The bound (4.2) with the pole 1/2 and the polygon of the polar derivative, for nonzero ends: zeros inside counted by the
/// parity of their neighbours, the whole lowered to the parity of the ends. The sign of a sum of two `f64` is exact.
fn pole_half_changes(p: &[f64]) -> usize {
    let (mut changes, mut zeros) = (0_usize, 0_usize);
    let mut negative = p[0] < 0.0;
    let last = p.len() - 1;
    let sums = p.windows(2).map(|p| p[0] + p[1]).chain([p[last]]);
    for q in sums {
        if q == 0.0 {
            zeros += 1;
            continue;
        }
        let odd = usize::from(negative != (q < 0.0));
        changes += if zeros >= odd {
            zeros - (zeros - odd) % 2
        } else {
            odd
        };
        (zeros, negative) = (0, q < 0.0);
    }
    changes
}

/// Simple roots, mapped to the interval.
#[inline]
fn roots_of_spans(
    found: &low_degree::Enclosures,
    interval: Interval,
) -> impl Iterator<Item = Root> + '_ {
    found.as_slice().iter().map(move |&(lo, hi)| {
        let (lo, hi) = interval.image(lo, hi);
        Root::exactly(lo, hi, 1)
    })
}

/// The roots of many polynomials, in their order; with the feature `rayon` on all cores.
///
/// # Examples
/// ```
/// let answers = variation::roots_of_all(&[vec![-1.0, 1.0], vec![1.0, -3.0, 1.0], vec![]]);
/// assert_eq!(answers[1].as_ref().map(|roots| roots.len()), Ok(2));
/// assert_eq!(answers[2], Err(variation::Error::NoCoefficients));
/// ```
#[must_use]
pub fn roots_of_all(polynomials: &[Vec<f64>]) -> Vec<Result<Roots, Error>> {
    let answer = |solver: &mut Solver, polynomial: &Vec<f64>| {
        solver.roots(polynomial).map(Roots::from_slice)
    };
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        polynomials
            .par_iter()
            .map_init(Solver::new, answer)
            .collect()
    }
    #[cfg(not(feature = "rayon"))]
    {
        let mut solver = Solver::new();
        polynomials
            .iter()
            .map(|polynomial| answer(&mut solver, polynomial))
            .collect()
    }
}

/// A polynomial as the algorithm sees it.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub(crate) coefficients: &'a [f64],
    /// Bound on the absolute error of each coefficient.
    pub(crate) error: f64,
    /// Numbers of leading and of trailing coefficients that are certainly zero.
    pub(crate) zeros: (usize, usize),
    #[cfg_attr(
        not(feature = "exact"),
        expect(dead_code, reason = "only exact arithmetic asks for it")
    )]
    pub(crate) origin: Origin<'a>,
}

impl<'a> Input<'a> {
    /// The polynomial with exactly these coefficients.
    fn exactly(coefficients: &'a [f64]) -> Self {
        let leading = coefficients.iter().take_while(|p| **p == 0.0).count();
        let trailing = coefficients.iter().rev().take_while(|p| **p == 0.0).count();
        Self {
            coefficients,
            error: 0.0,
            zeros: (leading, trailing),
            origin: Origin::Coefficients,
        }
    }
}

/// Where the exact coefficients come from.
#[derive(Clone, Copy)]
pub(crate) enum Origin<'a> {
    /// They are the given ones.
    Coefficients,
    /// The given ones are rounded; this forms the exact ones, in scaled form.
    #[cfg(feature = "exact")]
    Formed(&'a dyn Fn() -> Vec<exact::Exact>),
    /// The given ones are rounded and there is no exact arithmetic.
    #[cfg(not(feature = "exact"))]
    Formed(std::marker::PhantomData<&'a ()>),
}

#[derive(Clone, Copy, Debug)]
struct Options {
    tolerance: f64,
    exact: bool,
}

impl Options {
    const DEFAULT: Self = Self {
        tolerance: DEFAULT_TOLERANCE,
        exact: cfg!(feature = "exact"),
    };
}

/// Storage for one solve.
struct Scratch<'a> {
    numbers: &'a mut [f64],
    waiting: &'a mut [Node<f64>],
    findings: &'a mut [Finding],
    fixed: &'a mut Fixed,
    roots: &'a mut [Root],
}

/// Storage of the fixed-point tier, allocated when it is first needed.
#[derive(Clone, Debug, Default)]
struct Fixed {
    waiting: Vec<Node<i128>>,
    rows: Vec<i128>,
}

const fn numbers_len(degree: usize) -> usize {
    (degree + 1) + evaluator_len(degree) + sharp_len(degree) + rows_len(degree)
}

/// Room for every finding and the two ends.
const fn roots_capacity(degree: usize) -> usize {
    node_capacity(degree) + 2
}

/// A root finder that keeps its storage between polynomials.
///
/// # Examples
/// ```
/// let mut solver = variation::Solver::new();
/// let mut total = 0;
/// for k in 1..10 {
///     total += solver.roots(&[-1.0, 0.5 * f64::from(k), 1.0])?.len();
/// }
/// assert_eq!(total, 9);
/// # Ok::<(), variation::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Solver {
    options: Options,
    numbers: Vec<f64>,
    waiting: Vec<Node<f64>>,
    findings: Vec<Finding>,
    fixed: Fixed,
    roots: Vec<Root>,
}

impl Default for Solver {
    fn default() -> Self {
        Self::new()
    }
}

impl Solver {
    /// A solver with [`DEFAULT_TOLERANCE`] and, if the feature `exact` is on, the exact path.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            options: Options::DEFAULT,
            numbers: Vec::new(),
            waiting: Vec::new(),
            findings: Vec::new(),
            fixed: Fixed {
                waiting: Vec::new(),
                rows: Vec::new(),
            },
            roots: Vec::new(),
        }
    }

    /// Encloses roots to `tolerance`, relative to the interval; at least a few units in the last place are left.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.options.tolerance = tolerance.max(16.0 * U);
        self
    }

    /// Forbids exact arithmetic: what remains undecided without it is reported as [`Count::AtMost`].
    #[must_use]
    pub fn without_exact(mut self) -> Self {
        self.options.exact = false;
        self
    }

    /// As [`crate::roots`].
    ///
    /// # Errors
    /// As [`crate::roots`].
    pub fn roots(&mut self, coefficients: &[f64]) -> Result<&[Root], Error> {
        self.roots_on(coefficients, Interval::UNIT)
    }

    /// As [`crate::roots_on`].
    ///
    /// # Errors
    /// As [`crate::roots`].
    pub fn roots_on(&mut self, coefficients: &[f64], interval: Interval) -> Result<&[Root], Error> {
        if let Some(found) = low_degree::solve(coefficients, self.options.tolerance) {
            self.roots.clear();
            self.roots.extend(roots_of_spans(&found, interval));
            return Ok(&self.roots);
        }
        self.solve(&Input::exactly(coefficients), interval)
    }

    /// The number of roots in `[0, 1]` with multiplicity, without enclosing them.
    ///
    /// Two bounds of cost O(n) come first: Descartes' count, and the polygon of the polar derivative with the pole 1/2. A bound
    /// of 0 or 1 with the parity of the end signs is the number itself.
    ///
    /// # Errors
    /// As [`crate::roots`].
    ///
    /// # Examples
    /// ```
    /// // Three sign changes, one root.
    /// let count = variation::Solver::new().count(&[-11.0, 7.0, -9.0, -5.0, -12.0, 12.0])?;
    /// assert_eq!(count, variation::Count::Exactly(1));
    /// # Ok::<(), variation::Error>(())
    /// ```
    pub fn count(&mut self, coefficients: &[f64]) -> Result<Count, Error> {
        largest(coefficients)?;
        let (at_zero, at_one) = Input::exactly(coefficients).zeros;
        if at_zero == coefficients.len() {
            return Err(Error::IdenticallyZero);
        }
        let inner = &coefficients[at_zero..coefficients.len() - at_one];
        let whole = at_zero + at_one == 0;
        // Without the zeros at the ends the signs of the coefficients stay, the sums of neighbours do not.
        let least = descartes_changes(inner);
        let least = if least > 1 && whole {
            least.min(pole_half_changes(coefficients))
        } else {
            least
        };
        if least <= 1 {
            return Ok(Count::Exactly((at_zero + least + at_one) as u32));
        }
        let tolerance = std::mem::replace(&mut self.options.tolerance, 1.0);
        let found = self.roots(coefficients).map(|roots| {
            roots
                .iter()
                .fold((0, true), |(sum, exactly), root| match root.count {
                    Count::Exactly(multiplicity) => (sum + multiplicity, exactly),
                    Count::AtMost(most) => (sum + most, false),
                })
        });
        self.options.tolerance = tolerance;
        let (sum, exactly) = found?;
        Ok(if exactly {
            Count::Exactly(sum)
        } else {
            Count::AtMost(sum)
        })
    }

    pub(crate) fn solve(
        &mut self,
        input: &Input<'_>,
        interval: Interval,
    ) -> Result<&[Root], Error> {
        let degree = input.coefficients.len().saturating_sub(1);
        if self.findings.len() < node_capacity(degree) {
            self.numbers
                .resize(numbers_len(degree.min(MAX_FLOAT_DEGREE)), 0.0);
            self.waiting.resize(node_capacity(degree), Node::NONE);
            self.findings.resize(node_capacity(degree), Finding::NONE);
        }
        self.roots
            .resize(self.roots.len().max(roots_capacity(degree)), Root::NONE);
        let scratch = Scratch {
            numbers: &mut self.numbers,
            waiting: &mut self.waiting,
            findings: &mut self.findings,
            fixed: &mut self.fixed,
            roots: &mut self.roots,
        };
        let len = solve(input, interval, self.options, scratch)?;
        Ok(&self.roots[..len])
    }
}

fn solve(
    input: &Input<'_>,
    interval: Interval,
    options: Options,
    scratch: Scratch<'_>,
) -> Result<usize, Error> {
    let coefficients = input.coefficients;
    let largest = largest(coefficients)?;
    if input.zeros.0 == coefficients.len() {
        return Err(Error::IdenticallyZero);
    }
    let certain = |p: Option<&f64>| p.is_some_and(|p| p.abs() > input.error);
    let (at_zero, at_one) = input.zeros;
    let inner = &coefficients[at_zero..coefficients.len() - at_one];
    let certain_ends = certain(inner.first()) && certain(inner.last());
    // With an uncertain end the exact path decides on everything, the multiplicities of the ends included.
    let (at_zero, at_one, inner) = if certain_ends {
        (at_zero, at_one, inner)
    } else {
        (0, 0, coefficients)
    };
    let degree = inner.len() - 1;

    let mut findings = Findings::new(&mut scratch.findings[..node_capacity(degree)]);
    if coefficients.len() > MAX_FLOAT_DEGREE + 1 || !certain_ends {
        findings.give_up(degree);
    } else if degree > 0 {
        let mut storage = Storage {
            numbers: scratch.numbers,
            waiting: scratch.waiting,
            fixed: scratch.fixed,
        };
        let problem = Problem {
            inner,
            at_zero,
            formal: coefficients.len() - 1,
            error: input.error,
        };
        problem.solve(largest, options.tolerance, &mut storage, &mut findings);
    }

    let mut list = List {
        roots: scratch.roots,
        len: 0,
        interval,
    };
    if at_zero > 0 {
        list.push(Root::exactly(0.0, 0.0, at_zero as u32));
    }
    for (i, finding) in findings.as_slice().iter().enumerate() {
        match *finding {
            Finding::Refined { lo, hi } => list.push(Root::exactly(lo, hi, 1)),
            _ if options.exact => {
                conclude(
                    input,
                    options.tolerance,
                    &findings.as_slice()[i..],
                    !certain_ends,
                    &mut list,
                )?;
                break;
            }
            Finding::Wide { lo, hi } => list.push(Root::exactly(lo, hi, 1)),
            Finding::Undecided { lo, hi, at_most } => list.push(Root {
                lo,
                hi,
                count: Count::AtMost(at_most),
            }),
        }
    }
    if at_one > 0 {
        list.push(Root::exactly(1.0, 1.0, at_one as u32));
    }
    Ok(list.len)
}

/// The largest magnitude.
fn largest(coefficients: &[f64]) -> Result<f64, Error> {
    if coefficients.is_empty() {
        return Err(Error::NoCoefficients);
    }
    let mut largest = 0.0_f64;
    let mut finite = true;
    for p in coefficients {
        finite &= p.abs() <= f64::MAX;
        largest = if p.abs() > largest { p.abs() } else { largest };
    }
    if finite {
        return Ok(largest);
    }
    let index = coefficients
        .iter()
        .position(|p| !p.is_finite())
        .unwrap_or(0);
    Err(Error::NotFinite {
        index,
        value: coefficients[index],
    })
}

/// A polynomial with nonzero ends: the coefficients that remain without the zeros at both ends, of a polynomial of degree
/// `formal` with `at_zero` leading zeros. Dividing out the factor `t^at_zero (1-t)^at_one` leaves `C(n,i) p_i` as it is.
struct Problem<'a> {
    inner: &'a [f64],
    at_zero: usize,
    formal: usize,
    error: f64,
}

/// Storage of the tiers without exact arithmetic.
struct Storage<'a> {
    numbers: &'a mut [f64],
    waiting: &'a mut [Node<f64>],
    fixed: &'a mut Fixed,
}

impl Problem<'_> {
    /// The roots in the open interval, as far as `f64` and fixed point decide them.
    fn solve(
        &self,
        largest: f64,
        tolerance: f64,
        storage: &mut Storage<'_>,
        findings: &mut Findings<'_>,
    ) {
        let degree = self.inner.len() - 1;
        let (scaled, numbers) = storage.numbers.split_at_mut(degree + 1);
        let (plain, numbers) = numbers.split_at_mut(evaluator_len(degree));
        let (sharp, rows) = numbers.split_at_mut(sharp_len(degree));
        let mut error = self.error;
        scaled.copy_from_slice(self.inner);
        let exponent = exponent_of(largest);
        let in_range = exponent.abs() <= SAFE_EXPONENT;
        if !in_range {
            // Two factors, since 2^-exponent alone may leave the range.
            let (half, rest) = (
                power_of_two(-exponent / 2),
                power_of_two(-exponent - (-exponent / 2)),
            );
            for p in &mut *scaled {
                *p = *p * half * rest;
            }
            error = error * half * rest + f64::MIN_POSITIVE;
        }
        let whole = degree == self.formal;
        let before = &BINOMIALS[self.formal][self.at_zero..=self.at_zero + degree];
        let after = &BINOMIALS[degree][..=degree];
        if !whole {
            error *= before
                .iter()
                .zip(after)
                .fold(1.0_f64, |g, (b, a)| g.max(b / a))
                * (1.0 + 8.0 * U);
        }
        let plain = Evaluator::new(
            scaled.iter().zip(before).map(|(p, b)| p * b),
            degree,
            error,
            plain,
        );
        let row = &mut rows[..=degree];
        row.copy_from_slice(scaled);
        if !whole {
            for ((p, b), a) in row.iter_mut().zip(before).zip(after) {
                *p = *p * b / a;
            }
            // Two roundings of the binomials, a product and a quotient.
            error += 5.0 * U * row.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        }
        if !(row[0].exceeds(error) && row[degree].exceeds(error)) {
            return findings.give_up(degree);
        }
        let exactly_known = (whole && in_range && self.error == 0.0).then_some(self.inner);
        let mut values = Values {
            plain,
            sharp: Sharp::new(exactly_known, sharp),
            tolerance,
        };
        isolate::isolate(degree, error, &mut values, storage.waiting, rows, findings);
        let undecided = findings
            .as_slice()
            .iter()
            .any(|f| matches!(f, Finding::Undecided { .. }));
        if let (true, Some(coefficients)) = (undecided, exactly_known) {
            storage
                .fixed
                .isolate(coefficients, exponent, &mut values, findings);
        }
    }
}

impl Fixed {
    /// Repeats the isolation in fixed point.
    fn isolate(
        &mut self,
        coefficients: &[f64],
        exponent: i32,
        values: &mut Values<'_>,
        findings: &mut Findings<'_>,
    ) {
        let degree = coefficients.len() - 1;
        self.rows.resize(self.rows.len().max(rows_len(degree)), 0);
        self.waiting
            .resize(self.waiting.len().max(node_capacity(degree)), Node::NONE);
        let row = &mut self.rows[..=degree];
        let error = subdivision::to_fixed(coefficients, exponent, row);
        if row[0].exceeds(error) && row[degree].exceeds(error) {
            findings.clear();
            isolate::isolate(
                degree,
                error,
                values,
                &mut self.waiting,
                &mut self.rows,
                findings,
            );
        }
    }
}

/// The exponent of the leading bit of a positive number.
fn exponent_of(x: f64) -> i32 {
    let biased = ((x.to_bits() >> 52) & 0x7ff) as i32;
    if biased == 0 {
        -1011 - x.to_bits().leading_zeros() as i32
    } else {
        biased - 1023
    }
}

/// Roots in the order of their discovery, mapped to the interval.
struct List<'a> {
    roots: &'a mut [Root],
    len: usize,
    interval: Interval,
}

impl List<'_> {
    fn push(&mut self, root: Root) {
        if let Some(slot) = self.roots.get_mut(self.len) {
            let (lo, hi) = self.interval.image(root.lo, root.hi);
            *slot = Root {
                lo,
                hi,
                count: root.count,
            };
            self.len += 1;
        }
    }
}

/// Turns findings, from the first open one on, into roots, by exact arithmetic.
#[cfg(feature = "exact")]
fn conclude(
    input: &Input<'_>,
    tolerance: f64,
    findings: &[Finding],
    ends_open: bool,
    list: &mut List<'_>,
) -> Result<(), Error> {
    let decomposition = match input.origin {
        Origin::Coefficients => Decomposition::of_bernstein(input.coefficients),
        Origin::Formed(form) => Decomposition::of_homogeneous(exact::common_integers(&form())),
    };
    let decomposition = decomposition.ok_or(Error::IdenticallyZero)?;
    let (at_zero, at_one) = decomposition.ends();
    if ends_open && at_zero > 0 {
        list.push(Root::exactly(0.0, 0.0, at_zero));
    }
    for finding in findings {
        match *finding {
            Finding::Refined { lo, hi } => list.push(Root::exactly(lo, hi, 1)),
            Finding::Wide { lo, hi } | Finding::Undecided { lo, hi, .. } => {
                for root in decomposition.roots_between(lo, hi, tolerance) {
                    list.push(root);
                }
            }
        }
    }
    if ends_open && at_one > 0 {
        list.push(Root::exactly(1.0, 1.0, at_one));
    }
    Ok(())
}

/// Never called: without the feature `exact` no option asks for it.
#[cfg(not(feature = "exact"))]
fn conclude(_: &Input<'_>, _: f64, _: &[Finding], _: bool, _: &mut List<'_>) -> Result<(), Error> {
    Ok(())
}
