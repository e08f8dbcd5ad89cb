//! Sensors on a ribbon: what they measure, and when a reading cannot be true.
//!
//! Section 3.1 of the thesis chapter. The first device carries single-axis accelerometers, which know the
//! angle to the vertical; the second one three-axis accelerometers alternating with two-axis magnetometers.

use crate::Error;
use crate::spatial::unit;
use core::f64::consts::PI;
use glam::{DMat3, DVec3};

/// What a sensor measures, in the frame of the ribbon at its place: x along, y across, z normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SensorKind {
    /// Three-axis accelerometer at rest: the upward direction.
    Accelerometer,
    /// Three-axis magnetometer: the direction of the field.
    Magnetometer,
    /// Magnetometer without the axis normal to the ribbon; the third coordinate of its readings is ignored
    /// and completed from gravity and the dip of the field.
    ///
    /// With two axes a lost field is found less often: where gravity leaves the ribbon's plane by more than 0.1, when
    /// the completed field's horizontal part is wrong by more than half; elsewhere, when the two axes contradict the dip
    /// by as much. A weak field on a tilted ribbon can pass for one of another heading, and on a ribbon edge-on to gravity
    /// near the magnetic equator a weak field passes for one along the missing axis. Two zeros are refused as a dead
    /// sensor.
    MagnetometerTwoAxis,
}

/// How raw readings become body vectors: `body = matrix * (raw - offset)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredCalibration", into = "StoredCalibration")
)]
pub struct Calibration {
    offset: DVec3,
    matrix: DMat3,
    full_scale: f64,
    magnitude: f64,
}

impl Default for Calibration {
    /// Readings that are body vectors of unit magnitude already, with no limit.
    fn default() -> Self {
        Self {
            offset: DVec3::ZERO,
            matrix: DMat3::IDENTITY,
            full_scale: f64::INFINITY,
            magnitude: 1.0,
        }
    }
}

impl Calibration {
    /// From `raw = misalignment * (gain * body) + offset`.
    ///
    /// `gain` is raw units per physical unit on each axis; the columns of `misalignment` are the directions
    /// of the sensor's axes in the ribbon's frame (the identity for a perfect mounting); a raw coordinate of
    /// absolute value `full_scale` or more is saturated; `magnitude` is the physical magnitude of the field
    /// measured (9.81 for gravity in m/s², about 48 for the field in µT; 1 for unit readings).
    ///
    /// # Errors
    /// [`Error::NonFinite`] for a number that is none, [`Error::OutOfRange`] for a gain, limit or magnitude
    /// that is not positive and for a misalignment that is singular.
    pub fn new(
        offset: DVec3,
        gain: DVec3,
        misalignment: DMat3,
        full_scale: f64,
        magnitude: f64,
    ) -> Result<Self, Error> {
        if !(offset.is_finite()
            && gain.is_finite()
            && misalignment.is_finite()
            && magnitude.is_finite())
        {
            return Err(Error::NonFinite {
                what: "calibration",
                index: 0,
            });
        }
        let positive = |what, value: f64| {
            if value > 0.0 {
                Ok(())
            } else {
                Err(Error::OutOfRange {
                    what,
                    value,
                    range: [0.0, f64::INFINITY],
                })
            }
        };
        positive("gain", gain.min_element())?;
        positive("full scale", full_scale)?;
        positive("field magnitude", magnitude)?;
        // Axes within a cone of 90 degrees of each other have a determinant well above this.
        positive(
            "misalignment determinant",
            misalignment.determinant().abs() - 1e-6,
        )?;
        let matrix = (misalignment * DMat3::from_diagonal(gain)).inverse();
        Ok(Self {
            offset,
            matrix,
            full_scale,
            magnitude,
        })
    }

    /// The unit body vector of a raw reading, or what is wrong with it. `axes` is how many coordinates the
    /// sensor has; with two, the third of the result is left open (zero) and the vector is not normalised.
    pub(crate) fn direction(&self, raw: DVec3, axes: usize) -> Result<DVec3, ReadingFault> {
        let raw = if axes == 2 {
            DVec3::new(raw.x, raw.y, self.offset.z)
        } else {
            raw
        };
        if !raw.is_finite() {
            return Err(ReadingFault::NonFinite);
        }
        for (axis, value) in raw.to_array().into_iter().take(axes).enumerate() {
            if value.abs() >= self.full_scale {
                return Err(ReadingFault::Saturated {
                    axis,
                    value,
                    limit: self.full_scale,
                });
            }
        }
        let body = self.matrix * (raw - self.offset) / self.magnitude;
        let magnitude = body.length();
        if axes == 2 {
            let body = DVec3::new(body.x, body.y, 0.0);
            // Exactly nothing on both axes is a dead sensor, not a field along the missing one.
            let dead = body == DVec3::ZERO;
            return if body.length() <= LARGEST_MAGNITUDE && !dead {
                Ok(body)
            } else {
                Err(ReadingFault::FieldLost { magnitude })
            };
        }
        if (SMALLEST_MAGNITUDE..=LARGEST_MAGNITUDE).contains(&magnitude) {
            Ok(body / magnitude)
        } else {
            Err(ReadingFault::FieldLost { magnitude })
        }
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "Calibration")]
struct StoredCalibration {
    offset: DVec3,
    matrix: DMat3,
    /// None without a limit: not every format has infinities.
    full_scale: Option<f64>,
    magnitude: f64,
}

#[cfg(feature = "serde")]
impl From<Calibration> for StoredCalibration {
    fn from(calibration: Calibration) -> Self {
        Self {
            offset: calibration.offset,
            matrix: calibration.matrix,
            full_scale: Some(calibration.full_scale).filter(|limit| limit.is_finite()),
            magnitude: calibration.magnitude,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredCalibration> for Calibration {
    type Error = Error;

    fn try_from(stored: StoredCalibration) -> Result<Self, Error> {
        let StoredCalibration {
            offset,
            matrix,
            full_scale,
            magnitude,
        } = stored;
        let full_scale = full_scale.unwrap_or(f64::INFINITY);
        let invertible = matrix.is_finite() && matrix.inverse().is_finite();
        let positive = full_scale > 0.0 && magnitude > 0.0 && magnitude.is_finite();
        if !(offset.is_finite() && invertible && positive) {
            return Err(Error::Stored {
                what: "numbers of a calibration",
            });
        }
        Ok(Self {
            offset,
            matrix,
            full_scale,
            magnitude,
        })
    }
}

/// A reading weaker than this part of the expected magnitude is not the field: the ribbon falls, is shielded,
/// or the sensor is dead. Sensors of this class err by a few hundredths.
const SMALLEST_MAGNITUDE: f64 = 0.5;
/// A reading stronger than this is not the field alone: the ribbon is shaken, or iron is near.
const LARGEST_MAGNITUDE: f64 = 1.5;

/// Why a reading cannot be true.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ReadingFault {
    /// A coordinate is NaN or infinite.
    #[error("the reading is not a finite number")]
    NonFinite,
    /// A coordinate is at the end of the sensor's range.
    #[error("axis {axis} is saturated, {value} with a full scale of {limit}")]
    Saturated {
        /// The axis, 0 to 2.
        axis: usize,
        /// The raw value.
        value: f64,
        /// The full scale.
        limit: f64,
    },
    /// The magnitude is not that of the field.
    #[error("the field is lost, the magnitude is {magnitude} of the expected one")]
    FieldLost {
        /// Measured over expected magnitude; it should be near one.
        magnitude: f64,
    },
}

/// One sensor of a ribbon.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensor {
    /// Its arc length on the ribbon.
    pub s: f64,
    /// What it measures.
    pub kind: SensorKind,
    /// How its readings are to be taken.
    pub calibration: Calibration,
}

impl Sensor {
    /// A calibrated sensor, whose readings are body vectors of unit magnitude.
    #[must_use]
    pub fn new(s: f64, kind: SensorKind) -> Self {
        Self {
            s,
            kind,
            calibration: Calibration::default(),
        }
    }

    /// The same sensor with a calibration.
    #[must_use]
    pub fn with_calibration(self, calibration: Calibration) -> Self {
        Self {
            calibration,
            ..self
        }
    }

    pub(crate) fn axes(&self) -> usize {
        if self.kind == SensorKind::MagnetometerTwoAxis {
            2
        } else {
            3
        }
    }

    pub(crate) fn is_magnetometer(&self) -> bool {
        self.kind != SensorKind::Accelerometer
    }
}

/// The directions of gravity and of the magnetic field in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredFields")
)]
pub struct WorldFields {
    up: DVec3,
    magnetic: DVec3,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "WorldFields")]
struct StoredFields {
    up: DVec3,
    magnetic: DVec3,
}

#[cfg(feature = "serde")]
impl TryFrom<StoredFields> for WorldFields {
    type Error = Error;

    fn try_from(stored: StoredFields) -> Result<Self, Error> {
        Self::new(stored.up, stored.magnetic)
    }
}

impl WorldFields {
    /// From the upward direction and that of the magnetic field, of any length.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::ZeroVector`], or [`Error::ParallelFields`] when the two are parallel.
    pub fn new(up: DVec3, magnetic: DVec3) -> Result<Self, Error> {
        let checked = |what, index, v: DVec3| {
            if !v.is_finite() {
                return Err(Error::NonFinite { what, index });
            }
            unit(v).ok_or(Error::ZeroVector { what, index })
        };
        let (up, magnetic) = (
            checked("world direction", 0, up)?,
            checked("world direction", 1, magnetic)?,
        );
        let sine = up.cross(magnetic).length();
        if sine < PARALLEL_FIELDS {
            return Err(Error::ParallelFields { s: 0.0, sine });
        }
        Ok(Self { up, magnetic })
    }

    /// Up is z, and the field points north (y) and down by the `dip`, radians.
    ///
    /// # Errors
    /// As [`WorldFields::new`]: a dip of a quarter turn has no north.
    pub fn with_dip(dip: f64) -> Result<Self, Error> {
        Self::new(DVec3::Z, DVec3::new(0.0, dip.cos(), -dip.sin()))
    }

    /// The unit vector upwards.
    #[must_use]
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// The unit vector of the magnetic field.
    #[must_use]
    pub fn magnetic(&self) -> DVec3 {
        self.magnetic
    }
}

/// Sine of the angle between gravity and field below which the direction about them is lost.
pub(crate) const PARALLEL_FIELDS: f64 = 1e-6;

/// A single-axis accelerometer reads this much beyond one (in g) by noise alone; more is not gravity.
const OVERSHOOT: f64 = 0.05;

/// The inclinations of a ribbon in a vertical plane from single-axis accelerometers along it (the first
/// device): readings in g, the sine of the angle to the horizontal; angles in radians, in
/// `[-pi/2, pi/2]`. Noise that carries a reading slightly beyond one is clamped.
///
/// # Errors
/// [`Error::Reading`] for a reading that is no number or beyond 1.05.
pub fn inclinations(readings: &[f64]) -> Result<Vec<f64>, Error> {
    readings
        .iter()
        .enumerate()
        .map(|(sensor, &value)| {
            let fault = |fault| Error::Reading { sensor, fault };
            if !value.is_finite() {
                return Err(fault(ReadingFault::NonFinite));
            }
            if value.abs() > 1.0 + OVERSHOOT {
                return Err(fault(ReadingFault::FieldLost {
                    magnitude: value.abs(),
                }));
            }
            Ok(value.clamp(-1.0, 1.0).asin())
        })
        .collect()
}

/// As [`inclinations`], for a ribbon that turns past the vertical.
///
/// A single axis cannot tell `a` from `pi - a`. The branches are chosen together so that the sum of squared
/// second differences of the unwrapped angle is least (dynamic programming over pairs of branches), starting
/// within a quarter turn of the horizontal. Right when neighbouring sensors turn by clearly less than a
/// quarter turn and the ribbon does not touch the vertical and turn back.
///
/// # Errors
/// As [`inclinations`].
pub fn inclinations_past_vertical(readings: &[f64]) -> Result<Vec<f64>, Error> {
    let principal = inclinations(readings)?;
    let Some(&first) = principal.first() else {
        return Ok(principal);
    };
    // Candidates for a sensor, unwrapped next to the angle before it.
    let near = |angle: f64, before: f64| angle - 2.0 * PI * ((angle - before) / (2.0 * PI)).round();
    // The best chain that ends on each branch of the last two sensors: (cost, angles).
    let mut chains: Vec<(f64, Vec<f64>)> = vec![(0.0, vec![first])];
    for (i, &angle) in principal.iter().enumerate().skip(1) {
        let mut extended: Vec<(f64, Vec<f64>)> = Vec::with_capacity(2 * chains.len());
        for (cost, chain) in &chains {
            let last = chain[i - 1];
            for branch in [angle, PI - angle] {
                let next = near(branch, last);
                let bend = if i >= 2 {
                    next - 2.0 * last + chain[i - 2]
                } else {
                    0.5 * (next - last)
                };
                let mut longer = chain.clone();
                longer.push(next);
                extended.push((cost + bend * bend, longer));
            }
        }
        extended.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Of chains that share their last two angles only the cheapest can win.
        let mut kept: Vec<(f64, Vec<f64>)> = Vec::with_capacity(8);
        for candidate in extended {
            let same = |other: &(f64, Vec<f64>)| {
                (0..=1).all(|back| (other.1[i - back] - candidate.1[i - back]).abs() < 1e-12)
            };
            if !kept.iter().any(same) && kept.len() < 16 {
                kept.push(candidate);
            }
        }
        chains = kept;
    }
    Ok(chains
        .into_iter()
        .next()
        .map_or(principal, |(_, chain)| chain))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn calibration_undoes_the_sensor() {
        let (offset, gain) = (DVec3::new(12.0, -3.0, 5.0), DVec3::new(100.0, 98.0, 103.0));
        let misalignment = DMat3::from_cols(
            DVec3::new(1.0, 0.01, -0.02),
            DVec3::new(0.005, 1.0, 0.01),
            DVec3::new(0.0, 0.02, 1.0),
        );
        let calibration = Calibration::new(offset, gain, misalignment, 2000.0, 9.81).unwrap();
        let body = DVec3::new(0.6, -0.48, 0.64);
        let raw = misalignment * (gain * (body * 9.81)) + offset;
        assert!((calibration.direction(raw, 3).unwrap() - body).length() < 1e-14);
        assert!(matches!(
            calibration.direction(DVec3::new(2500.0, 0.0, 0.0), 3),
            Err(ReadingFault::Saturated { axis: 0, .. })
        ));
        assert!(matches!(
            calibration.direction(offset, 3),
            Err(ReadingFault::FieldLost { .. })
        ));
        assert!(matches!(
            calibration.direction(DVec3::NAN, 3),
            Err(ReadingFault::NonFinite)
        ));
        assert!(Calibration::new(offset, DVec3::ZERO, misalignment, 1.0, 1.0).is_err());
        assert!(Calibration::new(offset, gain, DMat3::ZERO, 1.0, 1.0).is_err());
        assert!(Calibration::new(offset, gain, misalignment, f64::NAN, 1.0).is_err());
    }

    #[test]
    fn inclinations_through_the_vertical() {
        let truth: Vec<f64> = (0..32).map(|i| 0.2 + 0.15 * f64::from(i)).collect();
        let readings: Vec<f64> = truth.iter().map(|a| a.sin()).collect();
        let found = inclinations_past_vertical(&readings).unwrap();
        for (a, b) in truth.iter().zip(&found) {
            assert!((a - b).abs() < 1e-7, "{a} {b}");
        }
        let gentle = inclinations(&readings[..8]).unwrap();
        assert!(
            gentle
                .iter()
                .zip(&truth)
                .all(|(a, b)| (a - b).abs() < 1e-12)
        );
        assert!(matches!(
            inclinations(&[0.0, 1.2]),
            Err(Error::Reading { sensor: 1, .. })
        ));
        assert!(matches!(
            inclinations(&[f64::NAN]),
            Err(Error::Reading { sensor: 0, .. })
        ));
        assert_eq!(inclinations(&[1.01]).unwrap(), [PI / 2.0]);
    }

    #[test]
    fn a_vertical_field_has_no_north() {
        assert!(matches!(
            WorldFields::with_dip(PI / 2.0),
            Err(Error::ParallelFields { .. })
        ));
        assert!(WorldFields::new(DVec3::ZERO, DVec3::X).is_err());
    }
}
