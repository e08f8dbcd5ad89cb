//! The cubic interpolating spline, for numbers and vectors.
//!
//! C. de Boor, *A Practical Guide to Splines*, Springer 1978, chapter IV. Unknowns are the second
//! derivatives ("moments") at the knots.

use crate::{Error, Series};
use bezier_mass::VectorSpace;

/// What a cubic spline does at its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum EndCondition {
    /// The third derivative is continuous at the second and at the last but one knot. Order 4 everywhere:
    /// the accurate choice, and the default.
    #[default]
    NotAKnot,
    /// The second derivative vanishes at the ends, as for an elastic strip with free ends: the physical
    /// choice of the thesis, of order 2 near the ends.
    Natural,
}

/// The factored system for the moments of a cubic spline on fixed knots.
///
/// Everything that depends on the knots alone is done once; after that a solve is two short sweeps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SplineSystem {
    knots: Vec<f64>,
    end: EndCondition,
    /// Thomas elimination of the tridiagonal system for the inner moments `1..n-1`: sub-diagonal,
    /// reciprocal pivot, super-diagonal over the pivot.
    lower: Vec<f64>,
    pivot: Vec<f64>,
    upper: Vec<f64>,
}

impl SplineSystem {
    /// # Errors
    /// [`Error::TooFew`], [`Error::NonFinite`] or [`Error::NotIncreasing`] for the knots.
    pub(crate) fn new(knots: &[f64], end: EndCondition) -> Result<Self, Error> {
        check_increasing(knots)?;
        let inner = knots.len().saturating_sub(2);
        let (mut lower, mut pivot, mut upper) =
            (vec![0.0; inner], vec![0.0; inner], vec![0.0; inner]);
        for (row, window) in knots.windows(3).enumerate() {
            let (h0, h1) = (window[1] - window[0], window[2] - window[1]);
            let (mut below, mut diagonal, mut above) = (h0 / 6.0, (h0 + h1) / 3.0, h1 / 6.0);
            if end == EndCondition::NotAKnot && inner == 1 {
                // Three data: one parabola, all moments equal.
                diagonal += below + above;
            } else if end == EndCondition::NotAKnot {
                // M_0 = M_1 + (M_1 - M_2) h0/h1, and likewise at the other end.
                if row == 0 {
                    diagonal += below * (1.0 + h0 / h1);
                    above -= below * h0 / h1;
                }
                if row + 1 == inner {
                    diagonal += h1 / 6.0 * (1.0 + h1 / h0);
                    below -= h1 / 6.0 * h1 / h0;
                }
            }
            let before = if row == 0 { 0.0 } else { upper[row - 1] };
            lower[row] = if row == 0 { 0.0 } else { below };
            pivot[row] = 1.0 / (diagonal - lower[row] * before);
            upper[row] = above * pivot[row];
        }
        Ok(Self {
            knots: knots.to_vec(),
            end,
            lower,
            pivot,
            upper,
        })
    }

    pub(crate) fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The moments at all knots, written into `moments`; `values` and `moments` have one entry a knot.
    pub(crate) fn moments_into<V: VectorSpace>(&self, values: &[V], moments: &mut [V]) {
        let n = self.knots.len();
        let inner = n - 2.min(n);
        for row in 0..inner {
            let (h0, h1) = (
                self.knots[row + 1] - self.knots[row],
                self.knots[row + 2] - self.knots[row + 1],
            );
            let slope = |i: usize, h: f64| values[i + 1].minus(values[i]).times(1.0 / h);
            let mut right = slope(row + 1, h1).minus(slope(row, h0));
            if row > 0 {
                right = right.minus(moments[row].times(self.lower[row]));
            }
            moments[row + 1] = right.times(self.pivot[row]);
        }
        for row in (0..inner.saturating_sub(1)).rev() {
            moments[row + 1] = moments[row + 1].minus(moments[row + 2].times(self.upper[row]));
        }
        let (first, last) = match self.end {
            _ if inner == 0 => (V::ZERO, V::ZERO),
            EndCondition::Natural => (V::ZERO, V::ZERO),
            EndCondition::NotAKnot if inner == 1 => (moments[1], moments[1]),
            EndCondition::NotAKnot => {
                let outward = |end: V, next: V, outer: f64, inner: f64| {
                    end.plus(end.minus(next).times(outer / inner))
                };
                let h = |i: usize| self.knots[i + 1] - self.knots[i];
                (
                    outward(moments[1], moments[2], h(0), h(1)),
                    outward(moments[n - 2], moments[n - 3], h(n - 2), h(n - 3)),
                )
            }
        };
        moments[0] = first;
        moments[n - 1] = last;
    }
}

/// The moments of the periodic spline whose last value repeats the first; the system is cyclic and is
/// solved by one Thomas sweep with a rank-one correction (Sherman and Morrison).
pub(crate) fn periodic_moments<V: VectorSpace>(knots: &[f64], values: &[V]) -> Vec<V> {
    let n = knots.len() - 1;
    if n < 2 {
        return vec![V::ZERO; knots.len()];
    }
    let h = |i: usize| knots[i % n + 1] - knots[i % n];
    let slope = |i: usize| values[i % n + 1].minus(values[i % n]).times(1.0 / h(i));
    let below = |i: usize| h(i + n - 1) / 6.0;
    let corner = below(0);
    // A = T + corner * (u u^T) with u = e_0 + e_{n-1}; for n = 2 both neighbours coincide.
    let mut pivot = vec![0.0; n];
    let mut right: Vec<V> = (0..n).map(|i| slope(i).minus(slope(i + n - 1))).collect();
    let mut unit = vec![0.0; n];
    (unit[0], unit[n - 1]) = (1.0, 1.0);
    let diagonal =
        |i: usize| (h(i) + h(i + n - 1)) / 3.0 - if i == 0 || i == n - 1 { corner } else { 0.0 };
    pivot[0] = diagonal(0);
    for i in 1..n {
        let factor = below(i) / pivot[i - 1];
        pivot[i] = diagonal(i) - factor * below(i);
        right[i] = right[i].minus(right[i - 1].times(factor));
        unit[i] -= factor * unit[i - 1];
    }
    for i in (0..n).rev() {
        if i + 1 < n {
            right[i] = right[i].minus(right[i + 1].times(below(i + 1)));
            unit[i] -= below(i + 1) * unit[i + 1];
        }
        right[i] = right[i].times(1.0 / pivot[i]);
        unit[i] /= pivot[i];
    }
    let share = corner / (1.0 + corner * (unit[0] + unit[n - 1]));
    let correction = right[0].plus(right[n - 1]).times(share);
    let mut moments: Vec<V> = right
        .iter()
        .zip(&unit)
        .map(|(x, z)| x.minus(correction.times(*z)))
        .collect();
    moments.push(moments[0]);
    moments
}

/// A C2 piecewise cubic through given values.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        try_from = "StoredSpline<V>",
        bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>")
    )
)]
pub struct CubicSpline<V> {
    knots: Vec<f64>,
    values: Vec<V>,
    moments: Vec<V>,
}

impl<V: VectorSpace> CubicSpline<V> {
    /// The spline through `values` at strictly increasing `knots`. Two data give a straight line; three with
    /// [`EndCondition::NotAKnot`] a parabola.
    ///
    /// # Errors
    /// [`Error::TooFew`] below two data, [`Error::LengthMismatch`], [`Error::NonFinite`],
    /// [`Error::NotIncreasing`]; [`Error::OutOfRange`] for values above 1e90 and intervals outside of 1e-90 to 1e90.
    pub fn new(knots: &[f64], values: &[V], end: EndCondition) -> Result<Self, Error> {
        check_values(knots, values)?;
        Ok(Self::solve(&SplineSystem::new(knots, end)?, values))
    }

    /// The spline on a system factored before.
    pub(crate) fn solve(system: &SplineSystem, values: &[V]) -> Self {
        let mut moments = vec![V::ZERO; values.len()];
        system.moments_into(values, &mut moments);
        Self {
            knots: system.knots.clone(),
            values: values.to_vec(),
            moments,
        }
    }

    /// The periodic spline; the last value must repeat the first, the period is the span of the knots.
    ///
    /// # Errors
    /// As [`CubicSpline::new`]; [`Error::NotPeriodic`] when the first and last values differ.
    pub fn periodic(knots: &[f64], values: &[V]) -> Result<Self, Error> {
        check_values(knots, values)?;
        check_increasing(knots)?;
        if let (Some(&first), Some(&last)) = (values.first(), values.last()) {
            let gap = last.minus(first).magnitude();
            // Rounding of the value itself; anything more is a different function.
            if gap > 16.0 * f64::EPSILON * first.magnitude() {
                return Err(Error::NotPeriodic { gap });
            }
        }
        Ok(Self {
            knots: knots.to_vec(),
            values: values.to_vec(),
            moments: periodic_moments(knots, values),
        })
    }

    /// The knots.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The values at the knots.
    #[must_use]
    pub fn values(&self) -> &[V] {
        &self.values
    }

    /// The value at `s`; the end cubics continue beyond the ends.
    #[must_use]
    pub fn value(&self, s: f64) -> V {
        self.piece(interval(&self.knots, s)).value(s)
    }

    /// The value at `s` of a periodic spline, the period being the span of the knots.
    pub(crate) fn periodic_value(&self, s: f64) -> V {
        let [start, end] = [self.knots[0], self.knots[self.knots.len() - 1]];
        self.value(start + (s - start).rem_euclid(end - start))
    }

    /// The cubic on the interval with this index, which must exist.
    pub(crate) fn piece(&self, i: usize) -> Cubic<V> {
        Cubic {
            start: self.knots[i],
            length: self.knots[i + 1] - self.knots[i],
            values: [self.values[i], self.values[i + 1]],
            moments: [self.moments[i], self.moments[i + 1]],
        }
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "CubicSpline")]
struct StoredSpline<V> {
    knots: Vec<f64>,
    values: Vec<V>,
    moments: Vec<V>,
}

#[cfg(feature = "serde")]
impl<V: VectorSpace> TryFrom<StoredSpline<V>> for CubicSpline<V> {
    type Error = Error;

    fn try_from(stored: StoredSpline<V>) -> Result<Self, Error> {
        /// Jump of the slope at a knot, relative to its terms: well above the rounding of the system that was solved.
        const SMOOTH: f64 = 1e-6;
        let StoredSpline {
            knots,
            values,
            moments,
        } = stored;
        check_increasing(&knots)?;
        check_values(&knots, &values)?;
        let wrong = Error::Stored {
            what: "second derivatives of a spline",
        };
        if moments.len() != knots.len() || !moments.iter().all(|m| m.is_finite()) {
            return Err(wrong);
        }
        let spline = Self {
            knots,
            values,
            moments,
        };
        for i in 1..spline.knots.len() - 1 {
            let (s, [a, b]) = (spline.knots[i], [spline.piece(i - 1), spline.piece(i)]);
            let jump = b.derivative(s).minus(a.derivative(s)).magnitude();
            let terms: f64 = [a, b].map(Cubic::largest_slope).iter().sum();
            if !(jump <= SMOOTH * terms) {
                return Err(wrong);
            }
        }
        Ok(spline)
    }
}

impl CubicSpline<f64> {
    /// The uniform cubic B-spline over `[0, 1]` with these coefficients, three more than its spans.
    pub(crate) fn from_uniform_coefficients(c: &[f64]) -> Self {
        let spans = c.len() - 3;
        let step = 1.0 / spans as f64;
        Self {
            knots: (0..=spans).map(|k| k as f64 * step).collect(),
            values: c
                .windows(3)
                .map(|c| (c[0] + 4.0 * c[1] + c[2]) / 6.0)
                .collect(),
            moments: c
                .windows(3)
                .map(|c| (c[0] - 2.0 * c[1] + c[2]) / (step * step))
                .collect(),
        }
    }

    /// The spline of a function: value and derivatives through the point of expansion.
    #[must_use]
    pub fn of_series(&self, s: Series) -> Series {
        let piece = self.piece(interval(&self.knots, s.value()));
        let ([y0, y1], [m0, m1], h) = (piece.values, piece.moments, piece.length);
        let b = (s - piece.start) / h;
        let a = -b + 1.0;
        a * y0 + b * y1 + ((a * a * a - a) * m0 + (b * b * b - b) * m1) * (h * h / 6.0)
    }
}

/// One cubic of a spline by end values and end moments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cubic<V> {
    pub(crate) start: f64,
    pub(crate) length: f64,
    pub(crate) values: [V; 2],
    pub(crate) moments: [V; 2],
}

impl<V: VectorSpace> Cubic<V> {
    pub(crate) fn value(&self, s: f64) -> V {
        let b = (s - self.start) / self.length;
        let a = 1.0 - b;
        let sixth = self.length * self.length / 6.0;
        self.values[0]
            .times(a)
            .plus(self.values[1].times(b))
            .plus(self.moments[0].times((a * a * a - a) * sixth))
            .plus(self.moments[1].times((b * b * b - b) * sixth))
    }

    pub(crate) fn derivative(&self, s: f64) -> V {
        let b = (s - self.start) / self.length;
        let a = 1.0 - b;
        let sixth = self.length / 6.0;
        self.values[1]
            .minus(self.values[0])
            .times(1.0 / self.length)
            .plus(self.moments[0].times((1.0 - 3.0 * a * a) * sixth))
            .plus(self.moments[1].times((3.0 * b * b - 1.0) * sixth))
    }

    /// A bound of the terms of [`Cubic::derivative`].
    #[cfg(feature = "serde")]
    fn largest_slope(self) -> f64 {
        self.values
            .iter()
            .map(|v| v.magnitude() / self.length)
            .chain(self.moments.iter().map(|m| m.magnitude() * self.length))
            .sum()
    }

    pub(crate) fn second_derivative(&self, s: f64) -> V {
        let b = (s - self.start) / self.length;
        self.moments[0].lerp(self.moments[1], b)
    }
}

/// The index of the interval of `knots` that contains `s`, the first or last one outside.
pub(crate) fn interval(knots: &[f64], s: f64) -> usize {
    knots
        .partition_point(|knot| *knot <= s)
        .saturating_sub(1)
        .min(knots.len().saturating_sub(2))
}

/// Refuses fewer than two knots, knots that are no numbers or that do not increase strictly.
pub(crate) fn check_increasing(knots: &[f64]) -> Result<(), Error> {
    if knots.len() < 2 {
        return Err(Error::TooFew {
            what: "arc lengths",
            needed: 2,
            got: knots.len(),
        });
    }
    if let Some(index) = knots.iter().position(|s| !s.is_finite()) {
        return Err(Error::NonFinite {
            what: "arc length",
            index,
        });
    }
    if let Some(i) = knots.windows(2).position(|pair| pair[1] <= pair[0]) {
        return Err(Error::NotIncreasing {
            index: i + 1,
            previous: knots[i],
            next: knots[i + 1],
        });
    }
    let mut intervals = knots.windows(2).map(|pair| pair[1] - pair[0]);
    match intervals.find(|interval| !(1.0 / EXTREME..=EXTREME).contains(interval)) {
        Some(value) => Err(Error::OutOfRange {
            what: "the interval of arc lengths",
            value,
            range: [1.0 / EXTREME, EXTREME],
        }),
        None => Ok(()),
    }
}

/// Intervals and values stay below this, intervals also above its inverse: moments are values over squares of intervals,
/// which a double then holds.
const EXTREME: f64 = 1e90;

fn check_values<V: VectorSpace>(knots: &[f64], values: &[V]) -> Result<(), Error> {
    if values.len() != knots.len() {
        return Err(Error::LengthMismatch {
            what: "values",
            expected: knots.len(),
            got: values.len(),
        });
    }
    if let Some(index) = values.iter().position(|v| !v.is_finite()) {
        return Err(Error::NonFinite {
            what: "value",
            index,
        });
    }
    match values.iter().find(|v| v.magnitude() > EXTREME) {
        Some(value) => Err(Error::OutOfRange {
            what: "the size of a value",
            value: value.magnitude(),
            range: [0.0, EXTREME],
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;
