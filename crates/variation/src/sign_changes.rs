//! The counting functions of Section 4.2: sign changes with zeros counted as the statements need them.

use crate::finite::Finite;

/// A number that has a sign.
pub trait Signed: Finite {
    /// -1, 0 or 1; 0 for NaN, which the functions that can refuse it do refuse.
    fn signum(&self) -> i8;
}

impl Signed for f64 {
    fn signum(&self) -> i8 {
        i8::from(*self > 0.0) - i8::from(*self < 0.0)
    }
}

impl Signed for i64 {
    fn signum(&self) -> i8 {
        i64::signum(*self) as i8
    }
}

#[cfg(feature = "exact")]
impl Signed for num_bigint::BigInt {
    fn signum(&self) -> i8 {
        match self.sign() {
            num_bigint::Sign::Minus => -1,
            num_bigint::Sign::NoSign => 0,
            num_bigint::Sign::Plus => 1,
        }
    }
}

#[cfg(feature = "exact")]
impl Signed for num_rational::BigRational {
    fn signum(&self) -> i8 {
        self.numer().signum()
    }
}

/// `S`: the number of zero entries plus the number of neighbours of opposite sign.
///
/// Each zero counts 1 whatever its neighbours: `S(+,0,-) = S(+,0,+) = 1`. Leaving zeros out would be unsound in the bounds of
/// this crate: a polynomial with a double root can have the polygon `(1/2, 0, 0, 0, 1/2)`.
#[must_use]
pub fn sign_changes<T: Signed>(sequence: &[T]) -> usize {
    let zeros = sequence.iter().filter(|r| r.signum() == 0).count();
    zeros
        + sequence
            .windows(2)
            .filter(|r| r[0].signum() * r[1].signum() < 0)
            .count()
}

/// `S_L(r_1, .., r_s) = S(r_1, .., r_s) - S(r_s)`: a zero at the right end belongs to the middle term.
#[must_use]
pub fn sign_changes_left<T: Signed>(sequence: &[T]) -> usize {
    sign_changes(sequence) - usize::from(sequence.last().is_some_and(|r| r.signum() == 0))
}

/// `S_R(r_1, .., r_s) = S(r_1, .., r_s) - S(r_1)`: a zero at the left end belongs to the middle term.
#[must_use]
pub fn sign_changes_right<T: Signed>(sequence: &[T]) -> usize {
    sign_changes(sequence) - usize::from(sequence.first().is_some_and(|r| r.signum() == 0))
}

/// `V`: sign changes with the zeros left out, Descartes' count. It bounds the roots in the open interval, for coefficients,
/// but not for the polygons of chains.
#[must_use]
pub fn descartes_changes<T: Signed>(sequence: &[T]) -> usize {
    let mut signs = sequence.iter().map(Signed::signum).filter(|s| *s != 0);
    let Some(mut last) = signs.next() else {
        return 0;
    };
    let mut changes = 0;
    for sign in signs {
        changes += usize::from(sign != last);
        last = sign;
    }
    changes
}

/// As [`sign_changes`], except that an inner run of `m` zeros counts the largest number up to `m` of the right parity: even
/// between equal signs, odd between opposite ones. A sound sharpening, `V <= S_par <= S`.
#[must_use]
pub fn sign_changes_by_parity<T: Signed>(sequence: &[T]) -> usize {
    let mut count = 0;
    let mut zeros = 0;
    let mut last = 0;
    for sign in sequence.iter().map(Signed::signum) {
        if sign == 0 {
            zeros += 1;
            continue;
        }
        if last == 0 {
            count += zeros;
        } else {
            let parity = usize::from(sign != last);
            // Without zeros between them the pair itself counts.
            count += if zeros >= parity {
                zeros - (zeros - parity) % 2
            } else {
                parity
            };
        }
        (zeros, last) = (0, sign);
    }
    count + zeros
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_zeros() {
        assert_eq!(sign_changes_by_parity(&[1_i64, 0, 0, -1]), 1);
        assert_eq!(sign_changes_by_parity(&[1_i64, 0, 0, 1]), 2);
        assert_eq!(sign_changes_by_parity(&[1_i64, 0, 0, 0, 1]), 2);
        assert_eq!(sign_changes_by_parity(&[1_i64, -1]), 1);
        assert_eq!(sign_changes_by_parity(&[0_i64, 0]), 2);
        assert_eq!(sign_changes(&[0.0]), 1);
        assert_eq!(sign_changes_left(&[0.0]), 0);
        assert_eq!(descartes_changes(&[0_i64, 1, 0, 0, 1, 0, 0, 0, -2, 0]), 1);
    }
}
