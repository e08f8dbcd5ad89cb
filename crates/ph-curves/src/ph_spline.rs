//! Chains of polynomial PH curves, and the C2 interpolating spline of PH quintics.

use glam::DVec2;

use crate::complex;
use crate::{Error, PolynomialPh};

/// How an interpolating spline ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SplineEnds {
    /// Derivatives at the first and at the last point, for a parameter that grows by 1 a span.
    Clamped {
        /// At the first point, not zero.
        start_derivative: DVec2,
        /// At the last point, not zero.
        end_derivative: DVec2,
    },
    /// A closed curve: the last point joins the first one, which is not repeated.
    Closed,
}

/// A curve made of polynomial PH spans, each over a unit of the parameter, with its exact arc length throughout.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<PolynomialPh>", into = "Vec<PolynomialPh>")
)]
pub struct PhSpline {
    spans: Vec<PolynomialPh>,
    /// Arc length from the start to the end of each span.
    lengths: Vec<f64>,
}

/// Newton's method doubles its digits; from the chords' roots ordinary data need 4 to 6 steps.
const NEWTON_STEPS: usize = 50;
/// The equations count as met at this share of `60 |Δp|`: some roundings of terms whose coefficients add up to 60.
const EQUATION_TOLERANCE: f64 = 1e-13;

impl PhSpline {
    /// The chain of given spans, in order.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] if there is none; [`Error::Gap`] if one does not start where its predecessor ends, within
    /// `1e-9` of the largest coordinate there.
    pub fn try_new(spans: Vec<PolynomialPh>) -> Result<Self, Error> {
        if spans.is_empty() {
            return Err(Error::TooFew {
                what: "spans",
                given: 0,
                needed: 1,
            });
        }
        for (index, pair) in spans.windows(2).enumerate() {
            let (end, start) = (pair[0].point(1.0), pair[1].point(0.0));
            let distance = end.distance(start);
            if distance > 1e-9 * end.abs().max(start.abs()).max_element() {
                return Err(Error::Gap { index, distance });
            }
        }
        let lengths = spans.iter().scan(0.0, |sum, span| {
            *sum += span.arc_length().total();
            Some(*sum)
        });
        Ok(Self {
            lengths: lengths.collect(),
            spans,
        })
    }

    /// The C2 spline of PH quintics through the points (Albrecht, Farouki 1996).
    ///
    /// Span `i` has the preimage `((z₋ + z)/2, z, (z + z₊)/2)` with one complex unknown `z` a span, and
    /// `3 z₋² + 27 z² + 3 z₊² + z₋ z₊ + 13 z₋ z + 13 z z₊ = 60 Δp`. Of the many solutions, Newton's method from the square roots
    /// of the chords, with continuous branches, finds one that follows the polygon.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] for less than 2 points (3 for a closed curve); [`Error::NonFinite`]; [`Error::ZeroDirection`] for a
    /// zero end derivative or two consecutive points that coincide; [`Error::NoInterpolant`] if Newton's method fails.
    pub fn interpolate(points: &[DVec2], ends: SplineEnds) -> Result<Self, Error> {
        let chords = chords(points, ends)?;
        let start = chord_roots(&chords);
        let closure = Closure::of(ends, &start)?;
        let unknowns = newton(&chords, closure, start)?;
        let spans = points.iter().zip(0..chords.len()).map(|(&point, i)| {
            let [before, z, after] = closure.around(&unknowns, i);
            PolynomialPh::try_new(point, [0.5 * (before + z), z, 0.5 * (z + after)])
        });
        Self::try_new(spans.collect::<Result<_, _>>()?)
    }

    /// The spans.
    #[must_use]
    pub fn spans(&self) -> &[PolynomialPh] {
        &self.spans
    }

    /// The whole arc length.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The arc length from the start to parameter `u` in `[0, number of spans]`, clamped to it.
    #[must_use]
    pub fn length_up_to(&self, u: f64) -> f64 {
        let (span, t) = self.locate(u);
        self.length_before(span) + self.spans[span].arc_length().up_to(t)
    }

    /// The parameter, span number plus parameter of the span, at which the length `s` is reached.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideDomain`] unless `0 <= s <= length`.
    pub fn parameter_at(&self, s: f64) -> Result<f64, Error> {
        let total = self.length();
        if !(s >= 0.0 && s <= total) {
            return Err(Error::OutsideDomain {
                value: s,
                start: 0.0,
                end: total,
            });
        }
        let span = self
            .lengths
            .partition_point(|&length| length < s)
            .min(self.spans.len() - 1);
        let arc = self.spans[span].arc_length();
        Ok(span as f64 + arc.parameter_at((s - self.length_before(span)).min(arc.total()))?)
    }

    /// The point at parameter `u`, clamped to `[0, number of spans]`.
    #[must_use]
    pub fn point(&self, u: f64) -> DVec2 {
        let (span, t) = self.locate(u);
        self.spans[span].point(t)
    }

    /// The velocity at parameter `u`, clamped to `[0, number of spans]`.
    #[must_use]
    pub fn velocity(&self, u: f64) -> DVec2 {
        let (span, t) = self.locate(u);
        self.spans[span].velocity(t)
    }

    fn locate(&self, u: f64) -> (usize, f64) {
        let last = self.spans.len() - 1;
        let span = (u.max(0.0) as usize).min(last);
        (span, (u - span as f64).clamp(0.0, 1.0))
    }

    fn length_before(&self, span: usize) -> f64 {
        span.checked_sub(1)
            .map_or(0.0, |previous| self.lengths[previous])
    }
}

impl TryFrom<Vec<PolynomialPh>> for PhSpline {
    type Error = Error;

    fn try_from(spans: Vec<PolynomialPh>) -> Result<Self, Error> {
        Self::try_new(spans)
    }
}

impl From<PhSpline> for Vec<PolynomialPh> {
    fn from(spline: PhSpline) -> Self {
        spline.spans
    }
}

fn chords(points: &[DVec2], ends: SplineEnds) -> Result<Vec<DVec2>, Error> {
    let needed = if ends == SplineEnds::Closed { 3 } else { 2 };
    if points.len() < needed {
        return Err(Error::TooFew {
            what: "points of a PH quintic spline",
            given: points.len(),
            needed,
        });
    }
    let mut chords: Vec<DVec2> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if let (SplineEnds::Closed, [first, .., last]) = (ends, points) {
        chords.push(*first - *last);
    }
    if chords.iter().any(|chord| !chord.is_finite()) {
        return Err(Error::NonFinite {
            what: "point of a PH quintic spline",
        });
    }
    if chords.contains(&DVec2::ZERO) {
        return Err(Error::ZeroDirection {
            what: "chord between two consecutive points",
        });
    }
    Ok(chords)
}

/// The square roots of the chords, each in the half plane of its predecessor.
fn chord_roots(chords: &[DVec2]) -> Vec<DVec2> {
    let mut previous = DVec2::X;
    let continued = chords.iter().map(|&chord| {
        previous = nearer(complex::sqrt(chord), previous);
        previous
    });
    continued.collect()
}

/// Of `±root` the one in the half plane of `direction`.
fn nearer(root: DVec2, direction: DVec2) -> DVec2 {
    if root.dot(direction) < 0.0 {
        -root
    } else {
        root
    }
}

/// What stands before the first and after the last unknown.
#[derive(Clone, Copy, Debug)]
enum Closure {
    /// The roots of the end derivatives: the means of the two values around the end.
    Clamped { first: DVec2, last: DVec2 },
    /// The unknowns continue around; the sign is -1 where the tangent makes an odd number of turns.
    Closed { sign: f64 },
}

impl Closure {
    fn of(ends: SplineEnds, roots: &[DVec2]) -> Result<Self, Error> {
        let (Some(&first_root), Some(&last_root)) = (roots.first(), roots.last()) else {
            return Err(Error::TooFew {
                what: "spans",
                given: 0,
                needed: 1,
            });
        };
        match ends {
            SplineEnds::Closed => Ok(Self::Closed {
                sign: if first_root.dot(last_root) < 0.0 {
                    -1.0
                } else {
                    1.0
                },
            }),
            SplineEnds::Clamped {
                start_derivative,
                end_derivative,
            } => {
                if !(start_derivative.is_finite() && end_derivative.is_finite()) {
                    return Err(Error::NonFinite {
                        what: "end derivative of a PH quintic spline",
                    });
                }
                if start_derivative == DVec2::ZERO || end_derivative == DVec2::ZERO {
                    return Err(Error::ZeroDirection {
                        what: "end derivative of a PH quintic spline",
                    });
                }
                Ok(Self::Clamped {
                    first: nearer(complex::sqrt(start_derivative), first_root),
                    last: nearer(complex::sqrt(end_derivative), last_root),
                })
            }
        }
    }

    /// The unknown `i` between its neighbours.
    fn around(self, z: &[DVec2], i: usize) -> [DVec2; 3] {
        let last = z.len() - 1;
        let before = match self {
            _ if i > 0 => z[i - 1],
            Self::Clamped { first, .. } => 2.0 * first - z[0],
            Self::Closed { sign } => sign * z[last],
        };
        let after = match self {
            _ if i < last => z[i + 1],
            Self::Clamped { last: root, .. } => 2.0 * root - z[last],
            Self::Closed { sign } => sign * z[0],
        };
        [before, z[i], after]
    }
}

/// The left side of equation `i` minus the right one.
fn defect([before, z, after]: [DVec2; 3], chord: DVec2) -> DVec2 {
    let squares =
        3.0 * (complex::square(before) + complex::square(after)) + 27.0 * complex::square(z);
    squares + before.rotate(after) + 13.0 * z.rotate(before + after) - 60.0 * chord
}

/// Newton's method on all equations; a step that does not help is halved.
fn newton(chords: &[DVec2], closure: Closure, start: Vec<DVec2>) -> Result<Vec<DVec2>, Error> {
    let defects = |z: &[DVec2]| -> Vec<DVec2> {
        chords
            .iter()
            .enumerate()
            .map(|(i, &chord)| defect(closure.around(z, i), chord))
            .collect()
    };
    let size = |values: &[DVec2]| {
        values
            .iter()
            .map(|value| value.length())
            .fold(0.0, f64::max)
    };
    let enough = EQUATION_TOLERANCE * 60.0 * size(chords);
    let mut z = start;
    let mut value = defects(&z);
    for _ in 0..NEWTON_STEPS {
        if size(&value) <= enough {
            return Ok(z);
        }
        let step = CyclicTridiagonal::jacobian(closure, &z).solve(&value);
        let mut share = 1.0;
        loop {
            let next: Vec<DVec2> = z
                .iter()
                .zip(&step)
                .map(|(z, step)| *z - share * *step)
                .collect();
            let found = defects(&next);
            if size(&found) < size(&value) {
                (z, value) = (next, found);
                break;
            }
            share *= 0.5;
            if share < 1e-6 {
                return Err(Error::NoInterpolant {
                    what: "C2 PH quintic spline",
                });
            }
        }
    }
    Err(Error::NoInterpolant {
        what: "C2 PH quintic spline",
    })
}

/// A complex tridiagonal matrix with the two corners of a closed chain.
struct CyclicTridiagonal {
    below: Vec<DVec2>,
    diagonal: Vec<DVec2>,
    above: Vec<DVec2>,
    closed: bool,
}

impl CyclicTridiagonal {
    /// The derivatives of the equations; what a closure adds depends linearly on the first or last unknown.
    fn jacobian(closure: Closure, z: &[DVec2]) -> Self {
        let (count, last) = (z.len(), z.len() - 1);
        let mut matrix = Self {
            below: Vec::with_capacity(count),
            diagonal: Vec::with_capacity(count),
            above: Vec::with_capacity(count),
            closed: matches!(closure, Closure::Closed { .. }),
        };
        for i in 0..count {
            let [before, here, after] = closure.around(z, i);
            let mut below = 6.0 * before + after + 13.0 * here;
            let mut diagonal = 54.0 * here + 13.0 * (before + after);
            let mut above = 6.0 * after + before + 13.0 * here;
            match closure {
                Closure::Clamped { .. } => {
                    if i == 0 {
                        diagonal -= below;
                    }
                    if i == last {
                        diagonal -= above;
                    }
                }
                Closure::Closed { sign } => {
                    if i == 0 {
                        below *= sign;
                    }
                    if i == last {
                        above *= sign;
                    }
                }
            }
            matrix.below.push(below);
            matrix.diagonal.push(diagonal);
            matrix.above.push(above);
        }
        matrix
    }

    /// The solution: of the chain without its last unknown, for the right side and for that unknown's column, which the
    /// last equation then fixes. Without corners this is plain elimination. The diagonal dominates (54 against
    /// 2 · 20), so that no pivots are looked for.
    fn solve(&self, right: &[DVec2]) -> Vec<DVec2> {
        let count = right.len();
        if !self.closed {
            return self.eliminate(count, right);
        }
        let last = count - 1;
        let mut column = vec![DVec2::ZERO; last];
        column[0] += self.below[0];
        column[last - 1] += self.above[last - 1];
        let particular = self.eliminate(last, right);
        let response = self.eliminate(last, &column);
        let row =
            |x: &[DVec2]| self.above[last].rotate(x[0]) + self.below[last].rotate(x[last - 1]);
        let end = complex::divide(
            right[last] - row(&particular),
            self.diagonal[last] - row(&response),
        );
        let mut solution: Vec<DVec2> = particular
            .iter()
            .zip(&response)
            .map(|(x, y)| *x - end.rotate(*y))
            .collect();
        solution.push(end);
        solution
    }

    /// Thomas elimination of the first `count` rows, without corners.
    fn eliminate(&self, count: usize, right: &[DVec2]) -> Vec<DVec2> {
        let mut ratios = Vec::with_capacity(count);
        let mut solution: Vec<DVec2> = Vec::with_capacity(count);
        for (i, &value) in right.iter().enumerate().take(count) {
            let (pivot, value) = match (ratios.last(), solution.last()) {
                (Some(&ratio), Some(&previous)) => (
                    self.diagonal[i] - self.below[i].rotate(ratio),
                    value - self.below[i].rotate(previous),
                ),
                _ => (self.diagonal[i], value),
            };
            ratios.push(complex::divide(self.above[i], pivot));
            solution.push(complex::divide(value, pivot));
        }
        for i in (0..count.saturating_sub(1)).rev() {
            let next = solution[i + 1];
            solution[i] -= ratios[i].rotate(next);
        }
        solution
    }
}

#[cfg(test)]
mod tests;
