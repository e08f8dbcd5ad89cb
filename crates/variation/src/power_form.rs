//! Polynomials in powers of `t`: solved through their exact Bernstein form, whatever the conversion would have rounded.

use crate::Error;
use crate::arithmetic::{Form, Number, add, convolve, multiply, roots_of};
use crate::root::{Interval, Roots};
use crate::solver::Solver;

/// The real roots, in an interval, of `sum a_k t^k`: certified for these power coefficients.
///
/// # Errors
/// As [`crate::roots`]; [`Error::DegreeTooHigh`] beyond degree 120.
///
/// # Examples
/// ```
/// use variation::{Interval, roots_of_power_form};
/// let roots = roots_of_power_form(&[-2.0, 0.0, 1.0], Interval::try_new(0.0, 2.0)?)?;
/// assert!((roots[0].value() - 2.0_f64.sqrt()).abs() < 1e-12);
/// # Ok::<(), variation::Error>(())
/// ```
pub fn roots_of_power_form(coefficients: &[f64], interval: Interval) -> Result<Roots, Error> {
    if coefficients.is_empty() {
        return Err(Error::NoCoefficients);
    }
    if let Some(index) = coefficients.iter().position(|a| !a.is_finite()) {
        return Err(Error::NotFinite {
            index,
            value: coefficients[index],
        });
    }
    let mut solver = Solver::new();
    roots_of(
        &PowerForm {
            coefficients,
            interval,
        },
        interval,
        &mut solver,
    )
    .map(Roots::from_slice)
}

/// `sum a_k t^k` with `t = a v + b u` and `1 = u + v`, by Horner's scheme.
struct PowerForm<'a> {
    coefficients: &'a [f64],
    interval: Interval,
}

impl Form for PowerForm<'_> {
    fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    fn scaled<N: Number>(&self) -> Vec<N> {
        let t = [N::exactly(self.interval.a()), N::exactly(self.interval.b())];
        let one = [N::exactly(1.0), N::exactly(1.0)];
        let mut power_of_one = vec![N::exactly(1.0)];
        let mut sum: Option<Vec<N>> = None;
        for a in self.coefficients.iter().rev() {
            let term = multiply(&power_of_one, *a);
            sum = Some(match sum {
                None => term,
                Some(sum) => add(&convolve(&sum, &t), &term),
            });
            power_of_one = convolve(&power_of_one, &one);
        }
        sum.unwrap_or_default()
    }
}
