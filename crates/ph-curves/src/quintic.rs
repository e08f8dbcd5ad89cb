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
        let (preimages, size) = self.preimages();
        let [a, b, c, d] =
            preimages.map(|preimage| PolynomialPh::try_new(self.start, preimage.map(|w| size * w)));
        Ok([a?, b?, c?, d?])
    }

    /// The preimages of the four for data of size one, and the factor that brings them to the size of these data: a power
    /// of two, which keeps their digits.
    fn preimages(&self) -> ([[DVec2; 3]; 4], f64) {
        let chord = self.end - self.start;
        let largest = [chord, self.start_derivative, self.end_derivative]
            .into_iter()
            .fold(0.0, |largest: f64, v| largest.max(v.abs().max_element()));
        let size = (0.5 * largest.log2()).round().exp2();
        let [chord, d0, d1] =
            [chord, self.start_derivative, self.end_derivative].map(|v| v / size / size);
        let first = complex::sqrt(d0);
        let preimage = |last: DVec2, sign: f64| {
            let root = complex::sqrt(120.0 * chord - 15.0 * (d0 + d1) + 10.0 * first.rotate(last));
            [first, 0.25 * (sign * root - 3.0 * (first + last)), last]
        };
        let last = complex::sqrt(d1);
        let four = [(last, 1.0), (last, -1.0), (-last, 1.0), (-last, -1.0)];
        (four.map(|(last, sign)| preimage(last, sign)), size)
    }

    /// The one of the four with the least bending energy: the criterion does not depend on the frame, and finds the
    /// curve without loops for data that have one.
    ///
    /// # Errors
    ///
    /// As for [`Hermite::quintics`].
    pub fn least_bending(&self) -> Result<PolynomialPh, Error> {
        let [mut best, others @ ..] = self.quintics()?;
        // Energies of huge and tiny curves overflow: those of size one are compared.
        let energy = |preimage: [DVec2; 3]| -> Result<f64, Error> {
            Ok(PolynomialPh::try_new(DVec2::ZERO, preimage)?.bending_energy())
        };
        let [first, rest @ ..] = self.preimages().0;
        let mut least = energy(first)?;
        for (curve, preimage) in others.into_iter().zip(rest) {
            let energy = energy(preimage)?;
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
    fn huge_and_tiny_data_are_interpolated() {
        let plain = DATA.least_bending().unwrap().arc_length().total();
        for size in [1e-160, 1e-100, 1e100, 1e150] {
            let data = Hermite {
                start: DATA.start * size,
                start_derivative: DATA.start_derivative * size,
                end: DATA.end * size,
                end_derivative: DATA.end_derivative * size,
            };
            for curve in data.quintics().unwrap() {
                assert!((curve.point(1.0) / size - DATA.end).length() < 1e-14);
            }
            let length = data.least_bending().unwrap().arc_length().total();
            assert!((length / size / plain - 1.0).abs() < 1e-14);
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
