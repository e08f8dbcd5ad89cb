//! Curves in a vertical plane from tangent angles.
//!
//! Section 3.2 of the thesis chapter, "Planar curves": interpolate the angle `alpha(s)`, integrate
//! `(cos alpha, sin alpha)`. The curve has the given length and the given tangents by construction.

use crate::integrate::{ACCURACY, integrate, positions};
use crate::spline::{SplineSystem, check_increasing};
use crate::{CubicSpline, EndCondition, Error};
use core::f64::consts::{PI, TAU};
use glam::{DMat2, DVec2};

/// A jump between neighbouring sensors this close to half a turn could be either way round.
const HALF_TURN_MARGIN: f64 = 1e-9;

/// A plane curve known by its tangent angle at given arc lengths; it starts at the origin.
///
/// ```
/// use reconstruct::{EndCondition, PlanarRibbon};
/// // A quarter of the unit circle: the angle is linear, so the curve is exact.
/// let s: Vec<f64> = (0..5).map(|i| f64::from(i) * std::f64::consts::FRAC_PI_8).collect();
/// let ribbon = PlanarRibbon::new(&s, &s, EndCondition::Natural)?;
/// let end = ribbon.points()[4];
/// assert!((end - glam::DVec2::new(1.0, 1.0)).length() < 1e-14);
/// # Ok::<(), reconstruct::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredRibbon", into = "StoredRibbon")
)]
pub struct PlanarRibbon {
    angle: CubicSpline<f64>,
    end: EndCondition,
    points: Vec<DVec2>,
    accuracy: f64,
    integration_error: f64,
}

impl PlanarRibbon {
    /// The ribbon with tangent angles `angles` (radians, any branch: they are unwrapped) at strictly
    /// increasing arc lengths `s`, integrated to `1e-13` of its length.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::LengthMismatch`], [`Error::NonFinite`], [`Error::NotIncreasing`];
    /// [`Error::AmbiguousTurn`] where neighbouring angles differ by half a turn;
    /// [`Error::NotIntegrable`] when the angle turns too wildly between two sensors.
    pub fn new(s: &[f64], angles: &[f64], end: EndCondition) -> Result<Self, Error> {
        check_increasing(s)?;
        Self::with_accuracy(s, angles, end, ACCURACY * (s[s.len() - 1] - s[0]))
    }

    /// As [`PlanarRibbon::new`], with positions integrated to the absolute `accuracy`, in units of length.
    ///
    /// # Errors
    /// As [`PlanarRibbon::new`].
    pub fn with_accuracy(
        s: &[f64],
        angles: &[f64],
        end: EndCondition,
        accuracy: f64,
    ) -> Result<Self, Error> {
        let angle = CubicSpline::new(s, &unwrap_angles(angles)?, end)?;
        Self::from_spline(angle, end, accuracy)
    }

    fn from_spline(
        angle: CubicSpline<f64>,
        end: EndCondition,
        accuracy: f64,
    ) -> Result<Self, Error> {
        let (points, integration_error) = positions(
            angle.knots(),
            &|s| DVec2::from_angle(angle.value(s)),
            accuracy,
        )?;
        Ok(Self {
            angle,
            end,
            points,
            accuracy,
            integration_error,
        })
    }

    /// The arc lengths of the data.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        self.angle.knots()
    }

    /// The positions at the arc lengths of the data; the first is the origin.
    #[must_use]
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// The estimate of the integration's error at the far end, in units of length.
    #[must_use]
    pub fn integration_error(&self) -> f64 {
        self.integration_error
    }

    /// The tangent angle at arc length `s`, radians; the end cubics continue beyond the ends.
    #[must_use]
    pub fn angle(&self, s: f64) -> f64 {
        self.angle.value(s)
    }

    /// The signed curvature at arc length `s`, one over length.
    #[must_use]
    pub fn curvature(&self, s: f64) -> f64 {
        self.angle
            .piece(crate::spline::interval(self.angle.knots(), s))
            .derivative(s)
    }

    /// The position at arc length `s`.
    ///
    /// # Errors
    /// [`Error::NotIntegrable`] for an `s` that is no number or absurdly far beyond the ends.
    pub fn point(&self, s: f64) -> Result<DVec2, Error> {
        let i = crate::spline::interval(self.angle.knots(), s);
        let tangent = |s| DVec2::from_angle(self.angle.value(s));
        Ok(self.points[i] + integrate(&tangent, self.angle.knots()[i], s, self.accuracy)?.0)
    }

    /// The covariance of the position at each datum, when the angles carry independent errors of standard
    /// deviation `sigma` (radians). First order: the position is linear in small errors of the angles,
    /// `dx(s) = sum_j dalpha_j * integral of phi_j (-sin, cos)`, `phi_j` the cardinal splines. Only the square of
    /// `sigma` enters, so its sign does not matter; a `sigma` that is no number gives NaN.
    #[must_use]
    pub fn covariance(&self, sigma: f64) -> Vec<DMat2> {
        let knots = self.angle.knots();
        let mut covariance = vec![DMat2::ZERO; knots.len()];
        for cardinal in cardinal_splines(knots, self.end) {
            let speed = |s: f64| DVec2::from_angle(self.angle.value(s)).perp() * cardinal.value(s);
            let mut moved = DVec2::ZERO;
            for (i, pair) in knots.windows(2).enumerate() {
                moved += crate::integrate::gauss_step(&speed, pair[0], pair[1]);
                let shift = moved * sigma;
                covariance[i + 1] += DMat2::from_cols(shift * shift.x, shift * shift.y);
            }
        }
        covariance
    }
}

/// The data of a ribbon; the rest is computed from them.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "PlanarRibbon")]
struct StoredRibbon {
    s: Vec<f64>,
    angles: Vec<f64>,
    end: EndCondition,
    accuracy: f64,
}

#[cfg(feature = "serde")]
impl From<PlanarRibbon> for StoredRibbon {
    fn from(ribbon: PlanarRibbon) -> Self {
        Self {
            s: ribbon.angle.knots().to_vec(),
            angles: ribbon.angle.values().to_vec(),
            end: ribbon.end,
            accuracy: ribbon.accuracy,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredRibbon> for PlanarRibbon {
    type Error = Error;

    fn try_from(stored: StoredRibbon) -> Result<Self, Error> {
        Self::with_accuracy(&stored.s, &stored.angles, stored.end, stored.accuracy)
    }
}

/// The splines that are one at one datum and zero at all others; nothing for knots that are not increasing.
pub(crate) fn cardinal_splines(knots: &[f64], end: EndCondition) -> Vec<CubicSpline<f64>> {
    let Ok(system) = SplineSystem::new(knots, end) else {
        return Vec::new();
    };
    let unit = |j: usize| {
        (0..knots.len())
            .map(|i| if i == j { 1.0 } else { 0.0 })
            .collect::<Vec<_>>()
    };
    (0..knots.len())
        .map(|j| CubicSpline::solve(&system, &unit(j)))
        .collect()
}

/// Adds multiples of a full turn so that neighbours differ by less than half a turn.
///
/// # Errors
/// [`Error::NonFinite`]; [`Error::AmbiguousTurn`] for a difference of half a turn.
pub(crate) fn unwrap_angles(angles: &[f64]) -> Result<Vec<f64>, Error> {
    let mut unwrapped: Vec<f64> = Vec::with_capacity(angles.len());
    for (index, &angle) in angles.iter().enumerate() {
        if !angle.is_finite() {
            return Err(Error::NonFinite {
                what: "angle",
                index,
            });
        }
        let Some(&before) = unwrapped.last() else {
            unwrapped.push(angle);
            continue;
        };
        let jump = angle - before - TAU * ((angle - before) / TAU).round();
        if PI - jump.abs() < HALF_TURN_MARGIN {
            return Err(Error::AmbiguousTurn { index, jump });
        }
        unwrapped.push(before + jump);
    }
    Ok(unwrapped)
}

/// A closed plane ribbon: the angles adjusted as little as possible so that the curve closes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredClosedRibbon", into = "StoredClosedRibbon")
)]
pub struct ClosedPlanarRibbon {
    angle: CubicSpline<f64>,
    /// Full turns of the tangent times 2 pi, over the length.
    turning_rate: f64,
    points: Vec<DVec2>,
    closing_error: DVec2,
    largest_adjustment: f64,
}

impl ClosedPlanarRibbon {
    /// The closed ribbon of the given `length` with angles at arc lengths `s` in `[s[0], s[0] + length)`.
    ///
    /// The angle is a periodic spline plus a whole number of turns. The closing error is distributed over
    /// the angles with least squared change, keeping the length, until the curve closes to `1e-12` of it.
    ///
    /// # Errors
    /// As [`PlanarRibbon::new`]; [`Error::NotIncreasing`] also when `length` does not exceed the span of
    /// `s`; [`Error::NoConvergence`] when no small change of the angles closes the curve (a straight ribbon).
    pub fn new(s: &[f64], angles: &[f64], length: f64) -> Result<Self, Error> {
        check_increasing(s)?;
        let mut knots = s.to_vec();
        knots.push(s[0] + length);
        check_increasing(&knots)?;
        let mut wrapped = angles.to_vec();
        wrapped.extend(angles.first());
        let mut values = unwrap_angles(&wrapped)?;
        if values.len() != knots.len() {
            return Err(Error::LengthMismatch {
                what: "angles",
                expected: s.len(),
                got: angles.len(),
            });
        }
        let turns = ((values[s.len()] - values[0]) / TAU).round();
        let turning_rate = turns * TAU / length;
        for (value, knot) in values.iter_mut().zip(&knots) {
            *value -= turning_rate * (knot - s[0]);
        }
        values[s.len()] = values[0];
        close(knots, values, turning_rate)
    }

    /// The gap that the measured angles left, before the adjustment.
    #[must_use]
    pub fn closing_error(&self) -> DVec2 {
        self.closing_error
    }

    /// The largest change made to an angle, radians.
    #[must_use]
    pub fn largest_adjustment(&self) -> f64 {
        self.largest_adjustment
    }

    /// The positions at the data; the last repeats the first up to the closing tolerance.
    #[must_use]
    pub fn points(&self) -> &[DVec2] {
        &self.points
    }

    /// The tangent angle at `s`, radians; once around it grows by the full turns of the curve.
    #[must_use]
    pub fn angle(&self, s: f64) -> f64 {
        self.angle.periodic_value(s) + self.turning_rate * (s - self.angle.knots()[0])
    }
}

/// A closed ribbon without its points, which are computed again.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "ClosedPlanarRibbon")]
struct StoredClosedRibbon {
    angle: CubicSpline<f64>,
    turning_rate: f64,
    closing_error: DVec2,
    largest_adjustment: f64,
}

#[cfg(feature = "serde")]
impl From<ClosedPlanarRibbon> for StoredClosedRibbon {
    fn from(ribbon: ClosedPlanarRibbon) -> Self {
        Self {
            angle: ribbon.angle,
            turning_rate: ribbon.turning_rate,
            closing_error: ribbon.closing_error,
            largest_adjustment: ribbon.largest_adjustment,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredClosedRibbon> for ClosedPlanarRibbon {
    type Error = Error;

    fn try_from(stored: StoredClosedRibbon) -> Result<Self, Error> {
        let StoredClosedRibbon {
            angle,
            turning_rate,
            closing_error,
            largest_adjustment,
        } = stored;
        let angle = CubicSpline::periodic(angle.knots(), angle.values())?;
        let knots = angle.knots();
        let (start, n) = (knots[0], knots.len() - 1);
        let length = knots[n] - start;
        let turns = turning_rate * length / TAU;
        let whole = (turns - turns.round()).abs() < CLOSED;
        if !(whole && closing_error.is_finite() && largest_adjustment.is_finite()) {
            return Err(Error::Stored {
                what: "turns of a closed ribbon",
            });
        }
        let direction = |s: f64| DVec2::from_angle(angle.value(s) + turning_rate * (s - start));
        let (points, _) = positions(knots, &direction, ACCURACY * length)?;
        if !(points[n].length() <= STORED_CLOSED * length) {
            return Err(Error::Stored {
                what: "angles of a closed ribbon",
            });
        }
        Ok(Self {
            angle,
            turning_rate,
            points,
            closing_error,
            largest_adjustment,
        })
    }
}

/// Closing gap accepted of a stored ribbon, whose numbers may have lost their last digit.
#[cfg(feature = "serde")]
pub(crate) const STORED_CLOSED: f64 = 10.0 * CLOSED;
/// Closing gap accepted, relative to the length: rounding of the integration.
pub(crate) const CLOSED: f64 = 1e-12;
/// Newton steps allowed for closing; quadratic convergence needs about five.
pub(crate) const CLOSING_STEPS: usize = 30;

fn close(
    knots: Vec<f64>,
    mut values: Vec<f64>,
    turning_rate: f64,
) -> Result<ClosedPlanarRibbon, Error> {
    let n = knots.len() - 1;
    let length = knots[n] - knots[0];
    let cardinals: Vec<CubicSpline<f64>> = (0..n)
        .map(|j| {
            let unit: Vec<f64> = (0..=n)
                .map(|i| if i % n == j { 1.0 } else { 0.0 })
                .collect();
            CubicSpline::periodic(&knots, &unit)
        })
        .collect::<Result<_, _>>()?;
    let measured = values.clone();
    let mut closing_error = None;
    for _ in 0..CLOSING_STEPS {
        let spline = CubicSpline::periodic(&knots, &values)?;
        let direction = |s: f64| DVec2::from_angle(spline.value(s) + turning_rate * (s - knots[0]));
        let (points, _) = positions(&knots, &direction, ACCURACY * length)?;
        let gap = points[n];
        let first_gap = *closing_error.get_or_insert(gap);
        if gap.length() <= CLOSED * length {
            let largest_adjustment = values
                .iter()
                .zip(&measured)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
            return Ok(ClosedPlanarRibbon {
                angle: spline,
                turning_rate,
                points,
                closing_error: first_gap,
                largest_adjustment,
            });
        }
        let slopes: Vec<DVec2> = cardinals
            .iter()
            .map(|cardinal| {
                let speed = |s: f64| direction(s).perp() * cardinal.value(s);
                knots
                    .windows(2)
                    .map(|pair| crate::integrate::gauss_step(&speed, pair[0], pair[1]))
                    .sum()
            })
            .collect();
        let gram = slopes.iter().fold(DMat2::ZERO, |sum, j| {
            sum + DMat2::from_cols(*j * j.x, *j * j.y)
        });
        // A straight ribbon has no first-order way to close: the determinant is that of its sagitta.
        if gram.determinant() <= 1e-12 * length.powi(4) {
            break;
        }
        let multiplier = gram.inverse() * gap;
        for (value, slope) in values.iter_mut().zip(&slopes) {
            *value -= slope.dot(multiplier);
        }
        values[n] = values[0];
    }
    Err(Error::NoConvergence {
        what: "closing the ribbon",
        steps: CLOSING_STEPS,
    })
}

#[cfg(test)]
mod tests;
