//! Blossom and polar derivative (Section 4.1 of the chapter).
//!
//! The blossom of `F` is the symmetric function `f(u_1, .., u_n)`, affine in each argument, with `f(t, .., t) = F(t)`. Fixing
//! one argument at a *pole* `z` gives the polar derivative `F_z(t) = f(z, t, .., t)`, of degree `n - 1`, with coefficients
//! `q_i = (1 - z) p_i + z p_(i+1)`. Everything here is in the unit parameter `u` of the interval ([`crate::Interval::to_unit`]).

use glam::{DVec2, DVec3};

use crate::Error;
use crate::finite::{Finite, check_all, finite_degree};

/// What Bernstein coefficients may be: numbers, points of the plane or of space, exact rationals.
pub trait Affine: Clone + Finite {
    /// The numbers that poles and arguments are.
    type Parameter: Clone + Finite;

    /// `(1 - share) * self + share * next`.
    #[must_use]
    fn mix(&self, next: &Self, share: &Self::Parameter) -> Self;
}

impl Affine for f64 {
    type Parameter = Self;

    fn mix(&self, next: &Self, share: &Self) -> Self {
        (1.0 - share) * self + share * next
    }
}

impl Affine for DVec2 {
    type Parameter = f64;

    fn mix(&self, next: &Self, share: &f64) -> Self {
        *self * (1.0 - share) + *next * *share
    }
}

impl Affine for DVec3 {
    type Parameter = f64;

    fn mix(&self, next: &Self, share: &f64) -> Self {
        *self * (1.0 - share) + *next * *share
    }
}

#[cfg(feature = "exact")]
impl Affine for num_rational::BigRational {
    type Parameter = Self;

    fn mix(&self, next: &Self, share: &Self) -> Self {
        self + (next - self) * share
    }
}

/// The polar derivative with respect to one pole, which may lie outside `[0, 1]`. Cost O(n).
///
/// The pole 0 drops the last coefficient, the pole 1 the first. The values satisfy `F_z(z) = F(z)` and
/// `n F_z = n F + (z - t) F'`.
///
/// # Errors
/// [`Error::NoCoefficients`]; [`Error::PolarOfConstant`] for degree 0; [`Error::NotFinite`], also on overflow.
///
/// # Examples
/// ```
/// use glam::DVec2;
/// let cubic = [(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)].map(DVec2::from);
/// let polar = variation::polar_derivative(&cubic, &0.5)?;
/// assert_eq!(polar[1], DVec2::new(1.5, 0.0));
/// # Ok::<(), variation::Error>(())
/// ```
pub fn polar_derivative<P: Affine>(
    coefficients: &[P],
    pole: &P::Parameter,
) -> Result<Vec<P>, Error> {
    check_all(coefficients)?;
    check_all(std::slice::from_ref(pole))?;
    match coefficients.len() {
        0 => Err(Error::NoCoefficients),
        1 => Err(Error::PolarOfConstant),
        _ => row_after(coefficients, pole),
    }
}

/// Refuses more poles than the degree, and coefficients that are not finite.
pub(crate) fn check_pole_count<P: Finite>(coefficients: &[P], poles: usize) -> Result<(), Error> {
    let degree = finite_degree(coefficients)?;
    if poles > degree {
        return Err(Error::TooManyPoles { poles, degree });
    }
    Ok(())
}

/// The row after one pole of a row of finite values, two at least.
fn row_after<P: Affine>(row: &[P], pole: &P::Parameter) -> Result<Vec<P>, Error> {
    let next: Vec<P> = row.windows(2).map(|p| p[0].mix(&p[1], pole)).collect();
    // A pole far outside of [0, 1] extrapolates.
    check_all(&next)?;
    Ok(next)
}

/// The polar derivative with respect to several poles, in any order (they commute); degree `n - m` for `m` poles.
///
/// # Errors
/// [`Error::NoCoefficients`]; [`Error::TooManyPoles`] for more poles than the degree; [`Error::NotFinite`], also on overflow.
pub fn polar_derivatives<P: Affine>(
    coefficients: &[P],
    poles: &[P::Parameter],
) -> Result<Vec<P>, Error> {
    check_pole_count(coefficients, poles.len())?;
    check_all(poles)?;
    let mut row = coefficients.to_vec();
    for pole in poles {
        row = row_after(&row, pole)?;
    }
    Ok(row)
}

/// The blossom `f(u_1, .., u_n)`. Cost O(n^2).
///
/// # Errors
/// [`Error::NoCoefficients`]; [`Error::BlossomArity`] unless there are exactly `n` arguments; [`Error::NotFinite`], also on
/// overflow.
pub fn blossom<P: Affine>(coefficients: &[P], arguments: &[P::Parameter]) -> Result<P, Error> {
    let degree = finite_degree(coefficients)?;
    if arguments.len() != degree {
        return Err(Error::BlossomArity {
            degree,
            arguments: arguments.len(),
        });
    }
    polar_derivatives(coefficients, arguments)?
        .pop()
        .ok_or(Error::NoCoefficients)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The power coefficients of `sum p_i C(n,i) t^i (1-t)^(n-i)` about `z`: `F(z + s) = sum a_k s^k`.
    fn taylor(coefficients: &[f64], z: f64) -> Vec<f64> {
        let n = coefficients.len() - 1;
        let mut binomial = 1.0;
        (0..=n)
            .map(|k| {
                // k-th difference, then the value at z of its polynomial of degree n - k.
                let mut row = coefficients.to_vec();
                for _ in 0..k {
                    row = row.windows(2).map(|p| p[1] - p[0]).collect();
                }
                let value = blossom(&row, &vec![z; n - k]).unwrap() * binomial;
                binomial *= (n - k) as f64 / (k + 1) as f64;
                value
            })
            .collect()
    }

    /// (4.1): `psi_(z,n-1) d psi_(z,n) F = n F_z`, where `psi` reverses the coefficients in powers of `t - z`.
    #[test]
    fn operator_identity() {
        let coefficients = [3.0, -2.0, 5.0, 0.0, -7.0, 4.0];
        let n = 5;
        for z in [0.0, 0.25, 0.5, 1.0, -0.5, 1.75] {
            let mut psi = taylor(&coefficients, z);
            psi.reverse();
            let mut derived: Vec<f64> = psi
                .iter()
                .enumerate()
                .skip(1)
                .map(|(k, a)| k as f64 * a)
                .collect();
            derived.reverse();
            let polar = polar_derivative(&coefficients, &z).unwrap();
            for (ours, theirs) in taylor(&polar, z).iter().zip(&derived) {
                assert!(
                    (n as f64 * ours - theirs).abs() <= 1e-9 * (1.0 + theirs.abs()),
                    "{ours} {theirs}"
                );
            }
        }
    }

    #[test]
    fn poles_commute_and_ends_drop_a_coefficient() {
        let p = [1.0, -4.0, 2.0, 8.0];
        assert_eq!(
            polar_derivatives(&p, &[0.25, 0.75]),
            polar_derivatives(&p, &[0.75, 0.25])
        );
        assert_eq!(polar_derivative(&p, &0.0).unwrap(), &p[..3]);
        assert_eq!(polar_derivative(&p, &1.0).unwrap(), &p[1..]);
        assert_eq!(polar_derivative(&[1.0], &0.5), Err(Error::PolarOfConstant));
        assert_eq!(
            polar_derivative::<f64>(&[], &0.5),
            Err(Error::NoCoefficients)
        );
    }

    #[test]
    fn blossom_is_symmetric_and_diagonal() {
        let p = [1.0, -4.0, 2.0, 8.0];
        assert_eq!(
            blossom(&p, &[0.25, 0.5, 0.75]),
            blossom(&p, &[0.75, 0.25, 0.5])
        );
        assert_eq!(blossom(&p, &[0.0, 0.0, 1.0]).unwrap(), -4.0);
        assert_eq!(
            blossom(&p, &[0.5]),
            Err(Error::BlossomArity {
                degree: 3,
                arguments: 1
            })
        );
    }
}
