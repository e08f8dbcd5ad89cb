//! The tiers of a solve: `f64`, then twice its digits and 128-bit fixed point, then integers. Each takes over what the one
//! before could not decide.

use crate::Error;
use crate::finite::check_all;
use crate::input::Input;
#[cfg(feature = "exact")]
use crate::input::Origin;
use crate::isolate::{self, Finding, Findings, Node, Values, node_capacity, rows_len};
use crate::root::{Interval, List, Root};
use crate::rounding::{
    BINOMIALS, Evaluator, MAX_FLOAT_DEGREE, SAFE_EXPONENT, U, evaluator_len, exponent_of,
    power_of_two,
};
use crate::sharp::{Sharp, sharp_len};
use crate::subdivision::{self, Coefficient};
use crate::twofold::Twofold;

/// The width, relative to the interval, to which roots are enclosed unless asked otherwise.
pub const DEFAULT_TOLERANCE: f64 = 1e-12;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Options {
    pub(crate) tolerance: f64,
    pub(crate) exact: bool,
}

impl Options {
    pub(crate) const DEFAULT: Self = Self {
        tolerance: DEFAULT_TOLERANCE,
        exact: cfg!(feature = "exact"),
    };
}

/// Storage for one solve.
pub(crate) struct Scratch<'a> {
    pub(crate) numbers: &'a mut [f64],
    pub(crate) waiting: &'a mut [Node<f64>],
    pub(crate) findings: &'a mut [Finding],
    pub(crate) fixed: &'a mut Fixed,
    /// As many as the degree.
    pub(crate) roots: &'a mut [Root],
}

/// Storage of the fixed-point tier, allocated when it is first needed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fixed {
    waiting: Vec<Node<i128>>,
    rows: Vec<i128>,
}

impl Fixed {
    pub(crate) const EMPTY: Self = Self {
        waiting: Vec::new(),
        rows: Vec::new(),
    };
}

/// How many `f64` a solve of this degree stores.
pub(crate) const fn numbers_len(degree: usize) -> usize {
    (degree + 1) + evaluator_len(degree) + sharp_len(degree) + rows_len(degree)
}

/// Writes the roots in `interval` to the scratch, and returns their number.
pub(crate) fn solve(
    input: &Input<'_>,
    interval: Interval,
    options: Options,
    scratch: &mut Scratch<'_>,
) -> Result<usize, Error> {
    let coefficients = input.coefficients;
    let largest = largest(coefficients)?;
    if input.zeros.0 == coefficients.len() {
        return Err(Error::IdenticallyZero);
    }
    let degree = input.inner().len() - 1;
    let mut findings =
        Findings::new(&mut scratch.findings[..node_capacity(coefficients.len() - 1)]);
    if !input.knows_its_ends() {
        findings.give_up(coefficients.len() - 1);
    } else if coefficients.len() > MAX_FLOAT_DEGREE + 1 {
        findings.give_up(degree);
    } else if degree > 0 {
        let mut storage = Storage {
            numbers: scratch.numbers,
            waiting: scratch.waiting,
            fixed: scratch.fixed,
        };
        float_tiers(
            input,
            largest,
            options.tolerance,
            &mut storage,
            &mut findings,
        );
    }
    let is_open = |finding: &Finding| !matches!(finding, Finding::Refined { .. });
    let first_open = findings.as_slice().iter().position(is_open);

    #[cfg(feature = "exact")]
    if let (true, Some(_), Origin::Formed(form)) = (options.exact, first_open, input.origin) {
        let exact = form();
        let mut rounded = Vec::new();
        let input = Input::nearest_to(&exact, &mut rounded);
        return solve(&input, interval, options, scratch);
    }

    let (at_zero, at_one) = if input.knows_its_ends() {
        input.zeros
    } else {
        (0, 0)
    };
    let mut list = List::new(scratch.roots, interval);
    list.push_end(0.0, at_zero);
    if options.exact && first_open.is_some() {
        conclude(input, options.tolerance, findings.as_slice(), &mut list)?;
    } else {
        for finding in findings.as_slice() {
            list.push(finding.as_root());
        }
    }
    list.push_end(1.0, at_one);
    Ok(list.len())
}

/// The largest magnitude.
pub(crate) fn largest(coefficients: &[f64]) -> Result<f64, Error> {
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
    check_all(coefficients).map(|()| largest)
}

/// Storage of the tiers without integers.
struct Storage<'a> {
    numbers: &'a mut [f64],
    waiting: &'a mut [Node<f64>],
    fixed: &'a mut Fixed,
}

/// The roots in the open interval, as far as `f64` and fixed point decide them.
///
/// Dividing out the factor `t^at_zero (1-t)^at_one` leaves `C(n,i) p_i` as it is.
fn float_tiers(
    input: &Input<'_>,
    largest: f64,
    tolerance: f64,
    storage: &mut Storage<'_>,
    findings: &mut Findings<'_>,
) {
    let inner = input.inner();
    let (degree, formal, at_zero) = (inner.len() - 1, input.coefficients.len() - 1, input.zeros.0);
    let (scaled, numbers) = storage.numbers.split_at_mut(degree + 1);
    let (plain, numbers) = numbers.split_at_mut(evaluator_len(degree));
    let (sharp, rows) = numbers.split_at_mut(sharp_len(degree));
    let mut error = input.error;
    scaled.copy_from_slice(inner);
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
    let whole = degree == formal;
    let before = &BINOMIALS[formal][at_zero..=at_zero + degree];
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
    let digits = (in_range && input.has_digits()).then_some(*input);
    let mut values = Values {
        plain,
        sharp: Sharp::new(digits, sharp),
        tolerance,
    };
    if row[0].exceeds(error) && row[degree].exceeds(error) {
        isolate::isolate(degree, error, &mut values, storage.waiting, rows, findings);
    } else {
        findings.give_up(degree);
    }
    let is_undecided = |finding: &Finding| matches!(finding, Finding::Undecided { .. });
    if let (true, Some(input)) = (findings.as_slice().iter().any(is_undecided), digits) {
        storage.fixed.isolate(&input, &mut values, findings);
    }
}

impl Fixed {
    /// Repeats the isolation in fixed point.
    fn isolate(&mut self, input: &Input<'_>, values: &mut Values<'_>, findings: &mut Findings<'_>) {
        let size = input.inner().len();
        let degree = size - 1;
        self.rows.resize(self.rows.len().max(rows_len(degree)), 0);
        self.waiting
            .resize(self.waiting.len().max(node_capacity(degree)), Node::NONE);
        let row = &mut self.rows[..size];
        let relative = if input.is_given() {
            0.0
        } else {
            Twofold::ERROR
        };
        let coefficients = (0..size).filter_map(|k| input.remaining(k));
        let error = subdivision::to_fixed(coefficients, relative, row);
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

/// Turns findings into roots, the open ones by integers.
#[cfg(feature = "exact")]
fn conclude(
    input: &Input<'_>,
    tolerance: f64,
    findings: &[Finding],
    list: &mut List<'_>,
) -> Result<(), Error> {
    let decomposition = input.decomposition().ok_or(Error::IdenticallyZero)?;
    for finding in findings {
        match *finding {
            Finding::Refined { .. } => list.push(finding.as_root()),
            Finding::Wide { lo, hi } | Finding::Undecided { lo, hi, .. } => {
                for root in decomposition.roots_between(lo, hi, tolerance) {
                    list.push(root);
                }
            }
        }
    }
    Ok(())
}

/// Never called: without the feature `exact` no option asks for it.
#[cfg(not(feature = "exact"))]
fn conclude(_: &Input<'_>, _: f64, _: &[Finding], _: &mut List<'_>) -> Result<(), Error> {
    Ok(())
}
