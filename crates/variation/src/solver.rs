//! The front door: from coefficients to roots, through `f64` first and exact arithmetic where that cannot decide.

use crate::Error;
#[cfg(feature = "exact")]
use crate::exact::{self, Decomposition};
use crate::isolate::{self, Finding, Findings, Node, node_capacity, rows_len};
use crate::root::{Count, INLINE, Interval, Root, Roots};
use crate::rounding::{BINOMIALS, Evaluator, MAX_FLOAT_DEGREE, SAFE_EXPONENT, U, evaluator_len};

/// The width, relative to the interval, to which roots are enclosed unless asked otherwise.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;

/// All real roots in `[0, 1]` of `sum p_i C(n,i) t^i (1-t)^(n-i)`, ascending, each certified.
///
/// Allocates nothing up to degree 16 unless a sign has to be decided exactly. To solve many, keep a [`Solver`].
///
/// # Errors
/// [`Error::NoCoefficients`], [`Error::NotFinite`], [`Error::IdenticallyZero`]. A nonzero constant has no roots.
///
/// # Examples
/// ```
/// // (4t - 1)^2 (4t - 3)^2, times 3: two double roots
/// let roots = variation::roots(&[27.0, -45.0, 59.0, -45.0, 27.0])?;
/// assert_eq!(roots.iter().map(|root| root.value()).collect::<Vec<_>>(), [0.25, 0.75]);
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
    let input = Input {
        coefficients,
        error: 0.0,
        origin: Origin::Coefficients,
    };
    if coefficients.len() <= N + 1 {
        let mut numbers = [0.0; numbers_len(N)];
        let mut waiting = [Node::NONE; node_capacity(N)];
        let mut findings = [Finding::NONE; node_capacity(N)];
        let mut roots = [Root::NONE; roots_capacity(N)];
        let scratch = Scratch {
            numbers: &mut numbers,
            waiting: &mut waiting,
            findings: &mut findings,
            roots: &mut roots,
        };
        let len = solve(&input, interval, Options::DEFAULT, scratch)?;
        Ok(Roots::from_slice(&roots[..len]))
    } else {
        Solver::new()
            .roots_on(coefficients, interval)
            .map(Roots::from_slice)
    }
}

/// A polynomial as the algorithm sees it.
#[derive(Clone, Copy)]
pub(crate) struct Input<'a> {
    pub(crate) coefficients: &'a [f64],
    /// Bound on the absolute error of each coefficient.
    pub(crate) error: f64,
    pub(crate) origin: Origin<'a>,
}

/// Where the exact coefficients come from.
#[derive(Clone, Copy)]
pub(crate) enum Origin<'a> {
    /// They are the given ones.
    Coefficients,
    /// The given ones are rounded; this forms the exact ones, as a positive multiple in integers.
    #[cfg(feature = "exact")]
    Formed(&'a dyn Fn() -> Vec<num_bigint::BigInt>),
    /// The given ones are rounded and the exact ones unknown.
    #[cfg(not(feature = "exact"))]
    Rounded(std::marker::PhantomData<&'a ()>),
}

#[derive(Clone, Copy, Debug)]
struct Options {
    tolerance: f64,
    #[cfg_attr(
        not(feature = "exact"),
        expect(dead_code, reason = "there is no exact path to forbid")
    )]
    exact: bool,
}

impl Options {
    const DEFAULT: Self = Self {
        tolerance: DEFAULT_TOLERANCE,
        exact: true,
    };
}

/// Storage for one solve.
struct Scratch<'a> {
    numbers: &'a mut [f64],
    waiting: &'a mut [Node],
    findings: &'a mut [Finding],
    roots: &'a mut [Root],
}

const fn numbers_len(degree: usize) -> usize {
    (degree + 1) + evaluator_len(degree) + rows_len(degree)
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
    waiting: Vec<Node>,
    findings: Vec<Finding>,
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
            roots: Vec::new(),
        }
    }

    /// Encloses roots to `tolerance`, relative to the interval; at least a few units in the last place are left.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: f64) -> Self {
        self.options.tolerance = tolerance.max(16.0 * U);
        self
    }

    /// Forbids the exact path: what `f64` cannot decide is reported as [`Count::AtMost`].
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
        self.solve(
            &Input {
                coefficients,
                error: 0.0,
                origin: Origin::Coefficients,
            },
            interval,
        )
    }

    pub(crate) fn solve(
        &mut self,
        input: &Input<'_>,
        interval: Interval,
    ) -> Result<&[Root], Error> {
        let degree = input.coefficients.len().saturating_sub(1);
        let float_degree = degree.min(MAX_FLOAT_DEGREE);
        if self.numbers.len() < numbers_len(float_degree) {
            self.numbers.resize(numbers_len(float_degree), 0.0);
        }
        if self.roots.len() < roots_capacity(degree) {
            self.waiting.resize(node_capacity(degree), Node::NONE);
            self.findings.resize(node_capacity(degree), Finding::NONE);
            self.roots.resize(roots_capacity(degree), Root::NONE);
        }
        let scratch = Scratch {
            numbers: &mut self.numbers,
            waiting: &mut self.waiting,
            findings: &mut self.findings,
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
    let Scratch {
        numbers,
        waiting,
        findings,
        roots,
    } = scratch;
    let coefficients = input.coefficients;
    let largest = largest(coefficients)?;
    if largest == 0.0 && input.error == 0.0 {
        return Err(Error::IdenticallyZero);
    }
    let (at_zero, at_one) = if input.error == 0.0 {
        zeros_at_ends(coefficients)
    } else {
        (0, 0)
    };
    let inner = &coefficients[at_zero..coefficients.len() - at_one];
    let degree = inner.len() - 1;

    let mut findings = Findings::new(&mut findings[..node_capacity(degree)]);
    let certain_ends = inner[0].abs() > input.error && inner[degree].abs() > input.error;
    if degree > MAX_FLOAT_DEGREE || !certain_ends {
        findings.give_up(degree);
    } else if degree > 0 {
        find_inside(
            input,
            inner,
            at_zero,
            largest,
            options,
            numbers,
            waiting,
            &mut findings,
        );
    }

    let mut list = List {
        roots,
        len: 0,
        interval,
    };
    if at_zero > 0 {
        list.push(Root::exactly(0.0, 0.0, at_zero as u32));
    }
    conclude(input, options, &findings, &mut list)?;
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

/// Multiplicities of the roots 0 and 1: the numbers of leading and trailing zeros.
fn zeros_at_ends(coefficients: &[f64]) -> (usize, usize) {
    let leading = coefficients.iter().take_while(|p| **p == 0.0).count();
    let trailing = coefficients.iter().rev().take_while(|p| **p == 0.0).count();
    (leading, trailing)
}

/// The roots in the open interval, without the factors of the ends, as far as `f64` decides them.
#[expect(
    clippy::too_many_arguments,
    reason = "the parts of one solve, split where the storage is borrowed"
)]
fn find_inside(
    input: &Input<'_>,
    inner: &[f64],
    at_zero: usize,
    largest: f64,
    options: Options,
    numbers: &mut [f64],
    waiting: &mut [Node],
    findings: &mut Findings<'_>,
) {
    let degree = inner.len() - 1;
    let formal = input.coefficients.len() - 1;
    let (scaled, numbers) = numbers.split_at_mut(degree + 1);
    let (store, rows) = numbers.split_at_mut(evaluator_len(degree));
    let exponent = exponent_of(largest);
    let mut error = input.error;
    scaled.copy_from_slice(inner);
    if exponent.abs() > SAFE_EXPONENT {
        // Two factors, since 2^-exponent alone may leave the range.
        let (half, rest) = (
            2.0_f64.powi(-exponent / 2),
            2.0_f64.powi(-exponent - (-exponent / 2)),
        );
        for p in &mut *scaled {
            *p = *p * half * rest;
        }
        error = error * half * rest + f64::MIN_POSITIVE;
    }
    if degree == formal {
        let binomials = &BINOMIALS[degree];
        let evaluator = Evaluator::new(
            scaled.iter().zip(binomials).map(|(p, b)| p * b),
            degree,
            error,
            store,
        );
        isolate::isolate(
            scaled,
            error,
            &evaluator,
            options.tolerance,
            waiting,
            rows,
            findings,
        );
    } else if formal <= MAX_FLOAT_DEGREE {
        // Without the factor t^at_zero (1-t)^at_one the scaled coefficients stay the same.
        let (before, after) = (&BINOMIALS[formal][at_zero..], &BINOMIALS[degree]);
        for (p, b) in scaled.iter_mut().zip(before) {
            *p *= b;
        }
        let evaluator = Evaluator::new(scaled.iter().copied(), degree, error, store);
        let mut largest = 0.0_f64;
        for (p, b) in scaled.iter_mut().zip(after) {
            *p /= b;
            largest = largest.max(p.abs());
        }
        // Two roundings of the binomials, a product and a quotient.
        error += 5.0 * U * largest;
        if scaled[0].abs() > error && scaled[degree].abs() > error {
            isolate::isolate(
                scaled,
                error,
                &evaluator,
                options.tolerance,
                waiting,
                rows,
                findings,
            );
        } else {
            findings.give_up(degree);
        }
    } else {
        findings.give_up(degree);
    }
}

/// The exponent of the leading bit of a positive number.
fn exponent_of(x: f64) -> i32 {
    let biased = ((x.to_bits() >> 52) & 0x7ff) as i32;
    if biased == 0 {
        -1074 + (63 - x.to_bits().leading_zeros() as i32)
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

/// Turns findings into roots, deciding exactly what is still open.
#[cfg(feature = "exact")]
fn conclude(
    input: &Input<'_>,
    options: Options,
    findings: &Findings<'_>,
    list: &mut List<'_>,
) -> Result<(), Error> {
    let mut exactly: Option<Decomposition> = None;
    for finding in findings.iter() {
        let (lo, hi) = match *finding {
            Finding::Refined { lo, hi } => {
                list.push(Root::exactly(lo, hi, 1));
                continue;
            }
            _ if !options.exact => {
                list.push(undecided(*finding));
                continue;
            }
            Finding::Wide { lo, hi } | Finding::Undecided { lo, hi, .. } => (lo, hi),
        };
        let decomposition = match &mut exactly {
            Some(known) => known,
            unknown => {
                let integers = match input.origin {
                    Origin::Coefficients => exact::integers(input.coefficients),
                    Origin::Formed(form) => form(),
                };
                unknown.insert(Decomposition::of_bernstein(integers).ok_or(Error::IdenticallyZero)?)
            }
        };
        let (at_zero, at_one) = decomposition.ends();
        let ends_unknown = input.error > 0.0;
        if ends_unknown && lo == 0.0 && at_zero > 0 {
            list.push(Root::exactly(0.0, 0.0, at_zero));
        }
        for root in decomposition.roots_between(lo, hi, options.tolerance) {
            list.push(root);
        }
        if ends_unknown && hi == 1.0 && at_one > 0 {
            list.push(Root::exactly(1.0, 1.0, at_one));
        }
    }
    Ok(())
}

/// Turns findings into roots; what is still open stays open.
#[cfg(not(feature = "exact"))]
fn conclude(
    _: &Input<'_>,
    _: Options,
    findings: &Findings<'_>,
    list: &mut List<'_>,
) -> Result<(), Error> {
    for finding in findings.iter() {
        list.push(undecided(*finding));
    }
    Ok(())
}

fn undecided(finding: Finding) -> Root {
    match finding {
        Finding::Refined { lo, hi } | Finding::Wide { lo, hi } => Root::exactly(lo, hi, 1),
        Finding::Undecided { lo, hi, at_most } => Root {
            lo,
            hi,
            count: Count::AtMost(at_most),
        },
    }
}
