//! The arc length of a curve whose speed is a polynomial: a polynomial too, and exactly invertible.

use crate::Error;

/// The arc length from the start, as a function of the parameter in `[0, 1]`: the integral of a polynomial speed.
///
/// Both directions cost some nanoseconds and are right to rounding; nothing is integrated numerically.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<f64>", into = "Vec<f64>"))]
pub struct ArcLength {
    speed: Vec<f64>,
    total: f64,
    /// Length and speed by powers of `t`.
    from_start: Powers,
    /// Those of the curve run backwards, by powers of `1 - t`.
    from_end: Powers,
    inverse: [InversePiece; INVERSE_PIECES],
}

/// Length from one end and speed, by powers of the distance to that end: used on the nearer half, where powers keep the
/// digits of a polynomial.
#[derive(Clone, Debug, PartialEq)]
struct Powers {
    length: Vec<f64>,
    speed: Vec<f64>,
}

/// The parameter as a monotone cubic of the length, on a part of the curve: the start of Newton's iteration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct InversePiece {
    /// Length at which the part begins.
    length: f64,
    /// Powers of the length beyond that.
    coefficients: [f64; 4],
}

/// Parts of the precomputed inverse. With eight, two steps of Newton's iteration reach rounding on ordinary curves.
const INVERSE_PIECES: usize = 8;
/// Newton's method from inside a bracket: a halving is taken where Newton leaves it, so that each of these steps at
/// least halves the bracket or squares the error; 2^-60 of the unit interval is below the spacing of doubles near 1.
const INVERSION_STEPS: usize = 64;

impl ArcLength {
    /// The arc length of a curve with this speed: Bernstein coefficients on `[0, 1]`, of a polynomial that is not
    /// negative there.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] without coefficients; [`Error::NonFinite`]; [`Error::RunsBackwards`] where the speed is negative.
    pub fn try_new(speed: Vec<f64>) -> Result<Self, Error> {
        if speed.is_empty() {
            return Err(Error::TooFew {
                what: "speed coefficients",
                given: 0,
                needed: 1,
            });
        }
        let total = speed.iter().sum::<f64>() / speed.len() as f64;
        if !total.is_finite() {
            return Err(Error::NonFinite {
                what: "a speed coefficient",
            });
        }
        if let Some((t, speed)) = negative_value(&speed) {
            return Err(Error::RunsBackwards { t, speed });
        }
        let backwards: Vec<f64> = speed.iter().rev().copied().collect();
        let mut arc = Self {
            from_start: Powers::of_speed(&speed),
            from_end: Powers::of_speed(&backwards),
            inverse: [InversePiece::default(); INVERSE_PIECES],
            total,
            speed,
        };
        arc.inverse = arc.tabulate_inverse();
        Ok(arc)
    }

    /// The speed's Bernstein coefficients.
    #[must_use]
    pub fn speed_coefficients(&self) -> &[f64] {
        &self.speed
    }

    /// The speed `ds/dt` at `t`.
    #[must_use]
    pub fn speed(&self, t: f64) -> f64 {
        if t <= 0.5 {
            evaluate(&self.from_start.speed, t)
        } else {
            evaluate(&self.from_end.speed, 1.0 - t)
        }
    }

    /// The whole length.
    #[must_use]
    pub const fn total(&self) -> f64 {
        self.total
    }

    /// The length from 0 to `t`.
    #[must_use]
    pub fn up_to(&self, t: f64) -> f64 {
        if t <= 0.5 {
            t * evaluate(&self.from_start.length, t)
        } else {
            let rest = 1.0 - t;
            self.total - rest * evaluate(&self.from_end.length, rest)
        }
    }

    /// The parameter at which the length `s` is reached.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideDomain`] unless `0 <= s <= total` (a rounding of the total beyond is clamped).
    pub fn parameter_at(&self, s: f64) -> Result<f64, Error> {
        let slack = 4.0 * f64::EPSILON * self.total;
        if !(s >= -slack && s <= self.total + slack) {
            return Err(Error::OutsideDomain {
                value: s,
                start: 0.0,
                end: self.total,
            });
        }
        if s <= 0.0 || s >= self.total {
            return Ok(if s <= 0.0 { 0.0 } else { 1.0 });
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut t = self.inverse_start(s);
        let mut last_step = 0.0_f64;
        for _ in 0..INVERSION_STEPS {
            let excess = self.up_to(t) - s;
            if excess > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let newton = t - excess / self.speed(t);
            let next = if newton >= low && newton <= high {
                newton
            } else {
                0.5 * (low + high)
            };
            // Steps shrink quadratically: from two of them the third is known, and not taken if it is rounding.
            let step = (next - t).abs();
            let after = step * step * step / (last_step * last_step);
            (t, last_step) = (next, step);
            if step <= f64::EPSILON * t || after <= f64::EPSILON * t {
                break;
            }
        }
        Ok(t)
    }

    fn inverse_start(&self, s: f64) -> f64 {
        let [first, rest @ ..] = &self.inverse;
        let piece = rest.iter().fold(
            first,
            |last, piece| if piece.length <= s { piece } else { last },
        );
        let x = s - piece.length;
        let [a, b, c, d] = piece.coefficients;
        (a + x * (b + x * (c + x * d))).clamp(0.0, 1.0)
    }

    /// Cubic Hermite interpolation of the inverse at equal steps of the parameter. Where the speed vanishes the inverse
    /// has no derivative: slopes are limited to three secants, which keeps the cubics monotone (Fritsch, Carlson 1980).
    fn tabulate_inverse(&self) -> [InversePiece; INVERSE_PIECES] {
        let step = 1.0 / INVERSE_PIECES as f64;
        let knot = |k: usize| {
            let t = step * k as f64;
            (self.up_to(t), self.speed(t))
        };
        std::array::from_fn(|k| {
            let ((length, speed), (next_length, next_speed)) = (knot(k), knot(k + 1));
            let start = step * k as f64;
            let width = next_length - length;
            let secant = step / width;
            if !secant.is_finite() {
                return InversePiece {
                    length,
                    coefficients: [start, 0.0, 0.0, 0.0],
                };
            }
            let slope = |speed: f64| (1.0 / speed.max(0.0)).min(3.0 * secant);
            let (a, b) = (slope(speed), slope(next_speed));
            InversePiece {
                length,
                coefficients: [
                    start,
                    a,
                    (3.0 * secant - 2.0 * a - b) / width,
                    (a + b - 2.0 * secant) / (width * width),
                ],
            }
        })
    }
}

impl Powers {
    /// From the Bernstein coefficients of the speed; the length lacks its factor, the parameter.
    fn of_speed(speed: &[f64]) -> Self {
        let speed = power_coefficients(speed);
        let length = speed
            .iter()
            .zip(1..)
            .map(|(c, k)| c / f64::from(k))
            .collect();
        Self { length, speed }
    }
}

#[cfg(feature = "serde")]
impl From<ArcLength> for Vec<f64> {
    fn from(arc: ArcLength) -> Self {
        arc.speed
    }
}

#[cfg(feature = "serde")]
impl TryFrom<Vec<f64>> for ArcLength {
    type Error = Error;

    fn try_from(speed: Vec<f64>) -> Result<Self, Error> {
        Self::try_new(speed)
    }
}

/// Negative values of a speed down to this share of its largest coefficient are the rounding of a zero.
const ROUNDING_OF_ZERO: f64 = 1e-9;
/// Halvings after which the coefficients of a part tell its values to that share: they are of order 2 in its width.
const HALVINGS: u32 = 20;

/// A parameter at which a polynomial in Bernstein form is negative, and its value there.
fn negative_value(coefficients: &[f64]) -> Option<(f64, f64)> {
    if coefficients.iter().all(|c| *c >= 0.0) {
        return None;
    }
    let size = coefficients.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    negative_value_on(coefficients, (0.0, 1.0), -ROUNDING_OF_ZERO * size, HALVINGS)
}

fn negative_value_on(
    coefficients: &[f64],
    (start, end): (f64, f64),
    least: f64,
    halvings: u32,
) -> Option<(f64, f64)> {
    let (&first, &last) = (coefficients.first()?, coefficients.last()?);
    if first < least || last < least {
        return Some(if first <= last {
            (start, first)
        } else {
            (end, last)
        });
    }
    if halvings == 0 || coefficients.iter().all(|c| *c >= least) {
        return None;
    }
    let middle = 0.5 * (start + end);
    let (left, right) = bezier_mass::bernstein::subdivide(coefficients, 0.5);
    negative_value_on(&left, (start, middle), least, halvings - 1)
        .or_else(|| negative_value_on(&right, (middle, end), least, halvings - 1))
}

/// A polynomial by powers, Horner's scheme on its even and its odd part side by side.
#[inline]
fn evaluate(coefficients: &[f64], x: f64) -> f64 {
    let square = x * x;
    let pairs = coefficients.chunks_exact(2);
    let mut even = pairs.remainder().first().copied().unwrap_or(0.0);
    let mut odd = 0.0;
    for pair in pairs.rev() {
        even = even * square + pair[0];
        odd = odd * square + pair[1];
    }
    even + x * odd
}

/// Coefficients of the powers of t from Bernstein coefficients: binomials times forward differences.
pub(crate) fn power_coefficients(coefficients: &[f64]) -> Vec<f64> {
    let mut row = coefficients.to_vec();
    let n = row.len();
    for level in 1..n {
        for k in (level..n).rev() {
            row[k] -= row[k - 1];
        }
    }
    let mut binomial = 1.0;
    for (k, c) in row.iter_mut().enumerate() {
        *c *= binomial;
        binomial *= (n - 1 - k) as f64 / (k + 1) as f64;
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use bezier_mass::bernstein;

    /// Speeds with a zero inside, at an end, nearly one, and none, of even and odd degree.
    fn speeds() -> [Vec<f64>; 7] {
        [
            vec![1.0, -1.0, 1.0],
            vec![0.0, 0.0, 1.0],
            vec![1.0, -1.0 + 1e-9, 1.0],
            vec![3.0, 0.5, 2.0, 0.1, 4.0],
            vec![3.0, 0.5, 2.0, 0.1],
            vec![2.0],
            vec![1.0, 3.0, 0.2, 5.0, 1.0, 0.3, 2.0, 2.0, 1.0],
        ]
    }

    #[test]
    fn powers_give_what_bernstein_coefficients_give() {
        for speed in speeds() {
            let arc = ArcLength::try_new(speed.clone()).unwrap();
            let length = bernstein::integral(&speed, 0.0);
            for i in 0..=100 {
                let t = f64::from(i) / 100.0;
                let (up_to, rate) = (
                    bernstein::evaluate::<f64>(&length, t),
                    bernstein::evaluate::<f64>(&speed, t),
                );
                assert!((arc.up_to(t) - up_to).abs() <= 16.0 * f64::EPSILON * arc.total());
                assert!((arc.speed(t) - rate).abs() <= 256.0 * f64::EPSILON * arc.total());
            }
        }
    }

    #[test]
    fn the_inverse_undoes_the_length() {
        for speed in speeds() {
            let arc = ArcLength::try_new(speed).unwrap();
            for i in 0..=100 {
                let s = arc.total() * f64::from(i) / 100.0;
                let t = arc.parameter_at(s).unwrap();
                assert!(
                    (arc.up_to(t) - s).abs() <= 16.0 * f64::EPSILON * arc.total(),
                    "{arc:?} at {s}"
                );
            }
        }
    }

    #[test]
    fn small_lengths_keep_their_digits() {
        let arc = ArcLength::try_new(vec![3.0, 0.5, 2.0]).unwrap();
        for s in [1e-3, 1e-9, 1e-100] {
            let t = arc.parameter_at(s).unwrap();
            assert!((arc.up_to(t) - s).abs() <= 4.0 * f64::EPSILON * s);
        }
    }

    #[test]
    fn a_length_that_the_arc_does_not_have_is_refused() {
        let arc = ArcLength::try_new(vec![1.0, 2.0]).unwrap();
        for s in [-0.1, 1.6, f64::NAN, f64::INFINITY] {
            assert!(matches!(
                arc.parameter_at(s),
                Err(Error::OutsideDomain { .. })
            ));
        }
    }

    #[test]
    fn hostile_speeds_are_refused() {
        assert!(matches!(
            ArcLength::try_new(Vec::new()),
            Err(Error::TooFew { .. })
        ));
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(matches!(
                ArcLength::try_new(vec![1.0, bad]),
                Err(Error::NonFinite { .. })
            ));
        }
        for backwards in [
            vec![1.0, -10.0, 1.0],
            vec![3.0, -4.0, 3.0],
            vec![-1.0],
            vec![1.0, -1.0 - 1e-6, 1.0],
            vec![1.0, 2.0, -1e-6],
        ] {
            match ArcLength::try_new(backwards.clone()) {
                Err(Error::RunsBackwards { t, speed }) => {
                    let value: f64 = bernstein::evaluate(&backwards, t);
                    assert!(speed < 0.0 && (value - speed).abs() < 1e-15);
                }
                other => panic!("{backwards:?}: {other:?}"),
            }
        }
        // A point: no length but zero.
        assert_eq!(
            ArcLength::try_new(vec![0.0; 3]).unwrap().parameter_at(0.0),
            Ok(0.0)
        );
    }
}
