//! PH quintics by C1 Hermite interpolation.

use glam::DVec2;

use crate::complex;
use crate::{Error, PolynomialPh};

/// End points and end derivatives of a plane curve on `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hermite {
    /// The start.
    pub start: DVec2,
    /// The derivative at the start, not zero.
    pub start_derivative: DVec2,
    /// The end.
    pub end: DVec2,
    /// The derivative at the end, not zero.
    pub end_derivative: DVec2,
}

impl Hermite {
    /// The four PH quintics with these ends (Farouki, Neff 1995): `w0 = √d0`, `w2 = ±√d1`,
    /// `w1 = (-3 (w0 + w2) ± √(120 Δp - 15 (w0² + w2²) + 10 w0 w2)) / 4`.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] for a zero end derivative.
    pub fn quintics(&self) -> Result<[PolynomialPh; 4], Error> {
        if !(self.start.is_finite() && self.end.is_finite()) {
            return Err(Error::NonFinite {
                what: "end point of Hermite data",
            });
        }
        if self.start_derivative == DVec2::ZERO || self.end_derivative == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "end derivative of Hermite data",
            });
        }
        let chord = self.end - self.start;
        let first = complex::sqrt(self.start_derivative);
        let quintic = |last: DVec2, sign: f64| {
            let squares = self.start_derivative + self.end_derivative;
            let root = complex::sqrt(120.0 * chord - 15.0 * squares + 10.0 * first.rotate(last));
            PolynomialPh::try_new(
                self.start,
                [first, 0.25 * (sign * root - 3.0 * (first + last)), last],
            )
        };
        let last = complex::sqrt(self.end_derivative);
        Ok([
            quintic(last, 1.0)?,
            quintic(last, -1.0)?,
            quintic(-last, 1.0)?,
            quintic(-last, -1.0)?,
        ])
    }

    /// The one of the four with the least bending energy: the criterion does not depend on the frame, and finds the
    /// curve without loops for data that have one.
    ///
    /// # Errors
    ///
    /// As for [`Hermite::quintics`].
    pub fn least_bending(&self) -> Result<PolynomialPh, Error> {
        let [mut best, others @ ..] = self.quintics()?;
        let mut least = best.bending_energy();
        for curve in others {
            let energy = curve.bending_energy();
            if energy < least || least.is_nan() {
                (best, least) = (curve, energy);
            }
        }
        Ok(best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DATA: Hermite = Hermite {
        start: DVec2::new(0.0, 0.0),
        start_derivative: DVec2::new(1.6, 0.0),
        end: DVec2::new(1.0, 1.0),
        end_derivative: DVec2::new(0.0, 1.6),
    };

    #[test]
    fn all_four_interpolate_and_the_best_does_not_depend_on_the_frame() {
        for curve in DATA.quintics().unwrap() {
            assert!((curve.point(1.0) - DATA.end).length() < 1e-14);
            assert!((curve.velocity(0.0) - DATA.start_derivative).length() < 1e-14);
            assert!((curve.velocity(1.0) - DATA.end_derivative).length() < 1e-14);
        }
        let best = DATA.least_bending().unwrap().arc_length().total();
        for i in 0..24 {
            let turn = DVec2::from_angle(f64::from(i) * 0.3);
            let turned = Hermite {
                start: DATA.start.rotate(turn),
                start_derivative: DATA.start_derivative.rotate(turn),
                end: DATA.end.rotate(turn),
                end_derivative: DATA.end_derivative.rotate(turn),
            };
            assert!((turned.least_bending().unwrap().arc_length().total() - best).abs() < 1e-13);
        }
    }

    #[test]
    fn a_straight_line_with_constant_speed_is_found() {
        let line = Hermite {
            end_derivative: DVec2::X,
            start_derivative: DVec2::X,
            start: DVec2::ZERO,
            end: DVec2::X,
        };
        let curve = line.least_bending().unwrap();
        assert!((curve.arc_length().total() - 1.0).abs() < 1e-15);
        assert!(curve.bending_energy() < 1e-28);
    }

    #[test]
    fn hostile_data_are_refused() {
        let still = Hermite {
            end_derivative: DVec2::ZERO,
            ..DATA
        };
        assert!(matches!(still.quintics(), Err(Error::ZeroDirection { .. })));
        assert!(matches!(
            Hermite {
                end: DVec2::NAN,
                ..DATA
            }
            .least_bending(),
            Err(Error::NonFinite { .. })
        ));
    }
}
