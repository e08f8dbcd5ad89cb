//! NaN and infinities are refused at the door, whatever the kind of number.

use glam::{DVec2, DVec3};

use crate::Error;

/// A number or a point, which may be NaN or infinite; exact numbers never are.
pub trait Finite {
    /// A coordinate that is NaN or infinite, if there is one.
    fn not_finite(&self) -> Option<f64> {
        None
    }
}

impl Finite for f64 {
    fn not_finite(&self) -> Option<f64> {
        (!self.is_finite()).then_some(*self)
    }
}

impl Finite for DVec2 {
    fn not_finite(&self) -> Option<f64> {
        self.to_array().into_iter().find(|x| !x.is_finite())
    }
}

impl Finite for DVec3 {
    fn not_finite(&self) -> Option<f64> {
        self.to_array().into_iter().find(|x| !x.is_finite())
    }
}

impl Finite for i64 {}

#[cfg(feature = "exact")]
impl Finite for num_bigint::BigInt {}

#[cfg(feature = "exact")]
impl Finite for num_rational::BigRational {}

/// The first entry of a list that is not finite, as an error.
pub(crate) fn check_all<T: Finite>(list: &[T]) -> Result<(), Error> {
    let offending = |(index, entry): (usize, &T)| Some((index, entry.not_finite()?));
    match list.iter().enumerate().find_map(offending) {
        Some((index, value)) => Err(Error::NotFinite { index, value }),
        None => Ok(()),
    }
}

/// The degree of a list of coefficients, which must not be empty and all finite.
pub(crate) fn finite_degree<T: Finite>(coefficients: &[T]) -> Result<usize, Error> {
    let degree = coefficients
        .len()
        .checked_sub(1)
        .ok_or(Error::NoCoefficients)?;
    check_all(coefficients)?;
    Ok(degree)
}
