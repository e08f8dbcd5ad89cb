//! Closed ribbons in space: the closing error is distributed over the tangents.

use crate::integrate::{ACCURACY, gauss_step, positions};
#[cfg(feature = "serde")]
use crate::planar::STORED_CLOSED;
use crate::planar::{CLOSED, CLOSING_STEPS};
use crate::spatial::{outer, projected, unit_tangents};
use crate::spline::check_increasing;
use crate::{CubicSpline, Error};
use glam::{DMat3, DVec3};

/// A closed space ribbon: the tangents adjusted as little as possible so that the curve closes.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredRibbon", into = "StoredRibbon")
)]
pub struct ClosedSpatialRibbon {
    spline: CubicSpline<DVec3>,
    points: Vec<DVec3>,
    closing_error: DVec3,
    largest_adjustment: f64,
}

impl ClosedSpatialRibbon {
    /// The closed ribbon of the given `length` with tangents at arc lengths `s` in `[s[0], s[0] + length)`.
    ///
    /// The tangents become a periodic spline, normalised; the closing error is distributed over them with
    /// least squared change, keeping the length, until the curve closes to `1e-12` of it.
    ///
    /// # Errors
    /// As [`crate::SpatialRibbon::new`]; [`Error::NoConvergence`] when no small change closes the curve.
    pub fn new(s: &[f64], tangents: &[DVec3], length: f64) -> Result<Self, Error> {
        check_increasing(s)?;
        let n = s.len();
        if tangents.len() != n {
            return Err(Error::LengthMismatch {
                what: "tangents",
                expected: n,
                got: tangents.len(),
            });
        }
        let mut knots = s.to_vec();
        knots.push(s[0] + length);
        check_increasing(&knots)?;
        let mut values = tangents.to_vec();
        values.extend(tangents.first());
        let measured = unit_tangents(&values)?;
        let cardinals: Vec<CubicSpline<f64>> = (0..n)
            .map(|j| {
                CubicSpline::periodic(
                    &knots,
                    &(0..=n).map(|i| f64::from(i % n == j)).collect::<Vec<_>>(),
                )
            })
            .collect::<Result<_, _>>()?;
        let mut values = measured.clone();
        let mut closing_error = None;
        for _ in 0..CLOSING_STEPS {
            let spline = projected(CubicSpline::periodic(&knots, &values)?)?;
            let direction = |s: f64| spline.value(s).normalize_or_zero();
            let (points, _) = positions(&knots, &direction, ACCURACY * length)?;
            let gap = points[n];
            let first_gap = *closing_error.get_or_insert(gap);
            if gap.length() <= CLOSED * length {
                let largest_adjustment = values
                    .iter()
                    .zip(&measured)
                    .fold(0.0, |m: f64, (a, b)| m.max(a.angle_between(*b)));
                return Ok(Self {
                    spline,
                    points,
                    closing_error: first_gap,
                    largest_adjustment,
                });
            }
            let slopes: Vec<DMat3> = cardinals
                .iter()
                .map(|cardinal| {
                    let turn = |s: f64| {
                        let value = spline.value(s);
                        let unit = value.normalize_or_zero();
                        let factor = cardinal.value(s) / value.length();
                        ((DMat3::IDENTITY - outer(unit, unit)) * factor).to_cols_array()
                    };
                    let total = knots.windows(2).fold([0.0; 9], |sum, pair| {
                        let step = gauss_step(&turn, pair[0], pair[1]);
                        core::array::from_fn(|i| sum[i] + step[i])
                    });
                    DMat3::from_cols_array(&total)
                })
                .collect();
            let gram = slopes
                .iter()
                .fold(DMat3::ZERO, |sum, m| sum + *m * m.transpose());
            // A straight ribbon cannot close to first order: no tangent moves the end along itself.
            if gram.determinant() <= 1e-12 * length.powi(6) / (n as f64).powi(3) {
                break;
            }
            let multiplier = gram.inverse() * gap;
            for (value, slope) in values.iter_mut().zip(&slopes) {
                *value = (*value - slope.transpose() * multiplier).normalize_or_zero();
            }
            values[n] = values[0];
        }
        Err(Error::NoConvergence {
            what: "closing the ribbon",
            steps: CLOSING_STEPS,
        })
    }

    /// The gap that the measured tangents left, before the adjustment.
    #[must_use]
    pub fn closing_error(&self) -> DVec3 {
        self.closing_error
    }

    /// The largest angle by which a tangent was turned, radians.
    #[must_use]
    pub fn largest_adjustment(&self) -> f64 {
        self.largest_adjustment
    }

    /// The positions at the data; the last repeats the first up to the closing tolerance.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The unit tangent at `s`, periodic with the length.
    #[must_use]
    pub fn tangent(&self, s: f64) -> DVec3 {
        self.spline.periodic_value(s).normalize_or_zero()
    }
}

/// A closed ribbon without its points, which are computed again.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "ClosedSpatialRibbon")]
struct StoredRibbon {
    spline: CubicSpline<DVec3>,
    closing_error: DVec3,
    largest_adjustment: f64,
}

#[cfg(feature = "serde")]
impl From<ClosedSpatialRibbon> for StoredRibbon {
    fn from(ribbon: ClosedSpatialRibbon) -> Self {
        Self {
            spline: ribbon.spline,
            closing_error: ribbon.closing_error,
            largest_adjustment: ribbon.largest_adjustment,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredRibbon> for ClosedSpatialRibbon {
    type Error = Error;

    fn try_from(stored: StoredRibbon) -> Result<Self, Error> {
        let StoredRibbon {
            spline,
            closing_error,
            largest_adjustment,
        } = stored;
        let spline = projected(CubicSpline::periodic(spline.knots(), spline.values())?)?;
        let knots = spline.knots();
        let n = knots.len() - 1;
        let length = knots[n] - knots[0];
        let direction = |s: f64| spline.value(s).normalize_or_zero();
        let (points, _) = positions(knots, &direction, ACCURACY * length)?;
        let closed = points[n].length() <= STORED_CLOSED * length;
        if !(closed && closing_error.is_finite() && largest_adjustment.is_finite()) {
            return Err(Error::Stored {
                what: "tangents of a closed ribbon",
            });
        }
        Ok(Self {
            spline,
            points,
            closing_error,
            largest_adjustment,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Noise;

    #[test]
    fn a_closed_ribbon_closes() {
        let n = 36;
        let length = 5.0;
        let s: Vec<f64> = (0..n)
            .map(|i| length * f64::from(i) / f64::from(n))
            .collect();
        let mut noise = Noise::new(5);
        let tangents: Vec<DVec3> = s
            .iter()
            .map(|s| {
                let t = s / length * core::f64::consts::TAU;
                DVec3::new(-t.sin(), t.cos(), 0.4 * (2.0 * t).cos())
                    + noise.gaussian_vector() * 0.02
            })
            .collect();
        let ribbon = ClosedSpatialRibbon::new(&s, &tangents, length).unwrap();
        assert!(ribbon.closing_error().length() > 1e-4);
        assert!(ribbon.points()[n as usize].length() < 5e-12);
        assert!(ribbon.largest_adjustment() < 0.2);
        for around in [length, -length, 3.0 * length] {
            assert!((ribbon.tangent(0.3 + around) - ribbon.tangent(0.3)).length() < 1e-13);
        }
        let straight = ClosedSpatialRibbon::new(&s, &vec![DVec3::X; n as usize], length);
        assert!(matches!(straight, Err(Error::NoConvergence { .. })));
    }
}
