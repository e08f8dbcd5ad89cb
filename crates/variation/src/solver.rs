//! The front door: from coefficients to roots, through `f64` first and exact arithmetic where that cannot decide.

use crate::Error;
use crate::input::Input;
use crate::isolate::{Finding, Node, node_capacity};
use crate::low_degree;
use crate::root::{Count, INLINE, Interval, Root, Roots};
use crate::rounding::{MAX_FLOAT_DEGREE, U};
use crate::sign_changes::descartes_changes;
use crate::tiers::{DEFAULT_TOLERANCE, Fixed, Options, Scratch, largest, numbers_len, solve};

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
#[inline]
pub fn roots(coefficients: &[f64]) -> Result<Roots, Error> {
    roots_on(coefficients, Interval::UNIT)
}

/// All real roots in `interval` of a polynomial given by its Bernstein coefficients on that interval.
///
/// # Errors
/// As [`roots`].
#[inline]
pub fn roots_on(coefficients: &[f64], interval: Interval) -> Result<Roots, Error> {
    if coefficients.len() > INLINE + 1 {
        return Solver::new()
            .roots_on(coefficients, interval)
            .map(Roots::from_slice);
    }
    Roots::written(|slots| {
        low_degree::solve(coefficients, DEFAULT_TOLERANCE, slots, interval)
            .map_or_else(|| solve_in_place(coefficients, interval, slots), Ok)
    })
}

/// As [`roots_on`] up to degree [`INLINE`]: all storage on the stack.
fn solve_in_place(
    coefficients: &[f64],
    interval: Interval,
    slots: &mut [Root],
) -> Result<usize, Error> {
    const N: usize = INLINE;
    let mut numbers = [0.0; numbers_len(N)];
    let mut waiting = [Node::NONE; node_capacity(N)];
    let mut findings = [Finding::NONE; node_capacity(N)];
    let mut scratch = Scratch {
        numbers: &mut numbers,
        waiting: &mut waiting,
        findings: &mut findings,
        fixed: &mut Fixed::default(),
        roots: slots,
    };
    solve(
        &Input::exactly(coefficients),
        interval,
        Options::DEFAULT,
        &mut scratch,
    )
}

/// Above this degree the pole 1/2 decides too little: on random coefficients with two sign changes or more 26 of 100 at degree 5,
/// 14 at degree 8, 2 at degree 12 and none at degree 20.
const POLE_DEGREE: usize = 8;

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
            fixed: Fixed::EMPTY,
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
        if self.roots.len() < low_degree::MAX_DEGREE {
            self.roots.resize(low_degree::MAX_DEGREE, Root::NONE);
        }
        let tolerance = self.options.tolerance;
        let found = low_degree::solve(coefficients, tolerance, &mut self.roots, interval);
        if let Some(found) = found {
            return Ok(&self.roots[..found]);
        }
        self.solve(&Input::exactly(coefficients), interval)
    }

    /// The number of roots in `[0, 1]` with multiplicity, without enclosing them.
    ///
    /// Two bounds of cost O(n) come first: Descartes' count, and up to degree 8 the polygon of the polar derivative with the
    /// pole 1/2. A bound of 0 or 1 with the parity of the end signs is the number itself.
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
        let least = if least > 1 && whole && coefficients.len() <= POLE_DEGREE + 1 {
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
        if self.roots.len() <= degree {
            self.roots.resize(degree + 1, Root::NONE);
        }
        let mut scratch = Scratch {
            numbers: &mut self.numbers,
            waiting: &mut self.waiting,
            findings: &mut self.findings,
            fixed: &mut self.fixed,
            roots: &mut self.roots,
        };
        let len = solve(input, interval, self.options, &mut scratch)?;
        Ok(&self.roots[..len])
    }
}
