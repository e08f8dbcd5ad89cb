//! From sensor readings to unit tangents.
//!
//! The two fields are known in the world and measured in the ribbon's frame; two directions fix the frame
//! (the TRIAD method: H. D. Black, *A passive system for determining the attitude of a satellite*, AIAA
//! Journal 2, 1964), and its first axis is the tangent. Where the two kinds of sensor alternate, each field is
//! first interpolated in the body frame to all places.

mod channel;
mod tangents;
mod triad;

use channel::{Channel, Stencil, cardinal_values, stencil};
use triad::{tangent_derivatives, triad};

pub use tangents::Tangents;

use crate::Error;
use crate::sensor::{PARALLEL_FIELDS, ReadingFault, Sensor, SensorKind, WorldFields};
use glam::{DMat3, DVec3};
use nalgebra::DMatrix;

/// Sensors of one kind needed for a not-a-knot spline that follows a bend.
const NEEDED: usize = 3;
/// Smallest component of gravity normal to the ribbon with which the missing axis of a two-axis magnetometer
/// follows from the dip; below it the field's unit length decides, with a sign continued along the ribbon.
const NORMAL_GRAVITY: f64 = 0.1;
/// Part of the expected field by which a completed two-axis reading may differ from it, as for three axes.
const FIELD_SLACK: f64 = 0.5;
/// Error of a reading, in parts of the field, that is not held against it: sensors of this class err by some hundredths.
const READING_ERROR: f64 = 0.05;
/// An interpolated field vector shorter than this has lost its direction.
const NEAR_ZERO: f64 = 0.1;

/// Where the sensors of a ribbon sit and what they measure, with all that can be computed before a reading.
///
/// ```
/// use reconstruct::{RibbonLayout, Sensor, SensorKind, WorldFields};
/// use glam::DVec3;
/// let world = WorldFields::with_dip(1.08)?;
/// let kind = |i| if i % 2 == 0 { SensorKind::Accelerometer } else { SensorKind::Magnetometer };
/// let layout = RibbonLayout::new((0..8).map(|i| Sensor::new(0.025 * i as f64, kind(i))), world)?;
/// // A flat ribbon that points north: its frame is x = north, y = west, z = up.
/// let body = |v: DVec3| DVec3::new(v.y, -v.x, v.z);
/// let readings: Vec<DVec3> =
///     (0..8).map(|i| if i % 2 == 0 { DVec3::Z } else { body(world.magnetic()) }).collect();
/// let tangents = layout.tangents(&readings)?;
/// assert!(tangents.values().iter().all(|t| (*t - DVec3::Y).length() < 1e-14));
/// # Ok::<(), reconstruct::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredLayout", into = "StoredLayout")
)]
pub struct RibbonLayout {
    sensors: Vec<Sensor>,
    world: WorldFields,
    /// Places of the output: the distinct arc lengths of all sensors.
    places: Vec<f64>,
    gravity: Channel,
    magnetic: Channel,
    /// For every magnetometer, how to evaluate gravity at its place.
    gravity_at_magnetometers: Vec<Stencil>,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "RibbonLayout")]
struct StoredLayout {
    sensors: Vec<Sensor>,
    world: WorldFields,
}

#[cfg(feature = "serde")]
impl From<RibbonLayout> for StoredLayout {
    fn from(layout: RibbonLayout) -> Self {
        Self {
            sensors: layout.sensors,
            world: layout.world,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredLayout> for RibbonLayout {
    type Error = Error;

    fn try_from(stored: StoredLayout) -> Result<Self, Error> {
        Self::new(stored.sensors, stored.world)
    }
}

/// Buffers of one reconstruction, to be reused.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Scratch {
    gravity: Vec<DVec3>,
    gravity_moments: Vec<DVec3>,
    magnetic: Vec<DVec3>,
    magnetic_moments: Vec<DVec3>,
}

impl RibbonLayout {
    /// A layout from its sensors, in the order of their readings. Sensors of either kind must come with
    /// increasing arc lengths; an accelerometer and a magnetometer may share a place.
    ///
    /// # Errors
    /// [`Error::TooFew`] below three of either kind; [`Error::NotIncreasing`], [`Error::NonFinite`] for
    /// their arc lengths.
    pub fn new(
        sensors: impl IntoIterator<Item = Sensor>,
        world: WorldFields,
    ) -> Result<Self, Error> {
        let sensors: Vec<Sensor> = sensors.into_iter().collect();
        if let Some(index) = sensors.iter().position(|sensor| !sensor.s.is_finite()) {
            return Err(Error::NonFinite {
                what: "arc length",
                index,
            });
        }
        let mut places: Vec<f64> = sensors.iter().map(|sensor| sensor.s).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let gravity = Channel::new(&sensors, false, &places)?;
        let magnetic = Channel::new(&sensors, true, &places)?;
        let gravity_at_magnetometers = magnetic
            .sensors
            .iter()
            .map(|i| stencil(gravity.system.knots(), sensors[*i].s))
            .collect();
        Ok(Self {
            sensors,
            world,
            places,
            gravity,
            magnetic,
            gravity_at_magnetometers,
        })
    }

    /// The sensors, in the order of their readings.
    #[must_use]
    pub fn sensors(&self) -> &[Sensor] {
        &self.sensors
    }

    /// The arc lengths at which tangents are found: those of all sensors, increasing.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        &self.places
    }

    /// The unit tangents in the world frame at [`RibbonLayout::arc_lengths`], from one raw reading a sensor.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`]; [`Error::Reading`] with the sensor and the reason for an impossible
    /// reading; [`Error::TangentLost`] when an interpolated field vanishes; [`Error::ParallelFields`].
    pub fn tangents(&self, readings: &[DVec3]) -> Result<Tangents, Error> {
        let mut scratch = self.scratch();
        let mut values = vec![DVec3::ZERO; self.places.len()];
        self.tangents_into(readings, &mut scratch, &mut values)?;
        let sensitivity = self.sensitivity(&scratch);
        Ok(Tangents {
            s: self.places.clone(),
            values,
            sensitivity,
        })
    }

    pub(crate) fn scratch(&self) -> Scratch {
        let (g, m) = (
            vec![DVec3::ZERO; self.gravity.sensors.len()],
            vec![DVec3::ZERO; self.magnetic.sensors.len()],
        );
        Scratch {
            gravity: g.clone(),
            gravity_moments: g,
            magnetic: m.clone(),
            magnetic_moments: m,
        }
    }

    /// As [`RibbonLayout::tangents`], into buffers of the right size, without allocating.
    pub(crate) fn tangents_into(
        &self,
        readings: &[DVec3],
        scratch: &mut Scratch,
        tangents: &mut [DVec3],
    ) -> Result<(), Error> {
        if readings.len() != self.sensors.len() {
            return Err(Error::LengthMismatch {
                what: "readings",
                expected: self.sensors.len(),
                got: readings.len(),
            });
        }
        self.read(&self.gravity, readings, &mut scratch.gravity)?;
        self.gravity
            .system
            .moments_into(&scratch.gravity, &mut scratch.gravity_moments);
        self.read(&self.magnetic, readings, &mut scratch.magnetic)?;
        self.complete_two_axis(scratch)?;
        self.magnetic
            .system
            .moments_into(&scratch.magnetic, &mut scratch.magnetic_moments);
        for (place, tangent) in tangents.iter_mut().enumerate() {
            let [a, m] = self.fields(place, scratch);
            for field in [a, m] {
                let length = field.length();
                if !(length >= NEAR_ZERO) {
                    return Err(Error::TangentLost {
                        s: self.places[place],
                        length,
                    });
                }
            }
            let (a, m) = (a.normalize(), m.normalize());
            let sine = a.cross(m).length();
            if sine < PARALLEL_FIELDS {
                return Err(Error::ParallelFields {
                    s: self.places[place],
                    sine,
                });
            }
            *tangent = self.frame(a, m).x_axis;
        }
        Ok(())
    }

    fn read(
        &self,
        channel: &Channel,
        readings: &[DVec3],
        values: &mut [DVec3],
    ) -> Result<(), Error> {
        for (value, &sensor) in values.iter_mut().zip(&channel.sensors) {
            let Sensor { calibration, .. } = &self.sensors[sensor];
            *value = calibration
                .direction(readings[sensor], self.sensors[sensor].axes())
                .map_err(|fault| Error::Reading { sensor, fault })?;
        }
        Ok(())
    }

    /// Both fields in the body frame at a place, not normalised.
    fn fields(&self, place: usize, scratch: &Scratch) -> [DVec3; 2] {
        [
            self.gravity
                .value(place, &scratch.gravity, &scratch.gravity_moments),
            self.magnetic
                .value(place, &scratch.magnetic, &scratch.magnetic_moments),
        ]
    }

    /// The third coordinate of two-axis magnetometers, from `a . m = up . B` where gravity has a component
    /// normal to the ribbon, else from the field's unit length with the sign nearest to the neighbour's.
    fn complete_two_axis(&self, scratch: &mut Scratch) -> Result<(), Error> {
        let dip = self.world.up().dot(self.world.magnetic());
        let horizontal = self.world.up().cross(self.world.magnetic()).length();
        let mut before: Option<f64> = None;
        for (i, &sensor) in self.magnetic.sensors.iter().enumerate() {
            if self.sensors[sensor].kind == SensorKind::MagnetometerTwoAxis {
                let Stencil {
                    first,
                    values,
                    moments,
                } = self.gravity_at_magnetometers[i];
                let a = scratch.gravity[first] * values[0]
                    + scratch.gravity[first + 1] * values[1]
                    + scratch.gravity_moments[first] * moments[0]
                    + scratch.gravity_moments[first + 1] * moments[1];
                let a = a.try_normalize().ok_or(Error::TangentLost {
                    s: self.sensors[sensor].s,
                    length: 0.0,
                })?;
                let m = &mut scratch.magnetic[i];
                let measured = a.x * m.x + a.y * m.y;
                let lost = |magnitude: f64| Error::Reading {
                    sensor,
                    fault: ReadingFault::FieldLost { magnitude },
                };
                let from_dip = |a: DVec3| (dip - measured) / a.z;
                m.z = if a.z.abs() > NORMAL_GRAVITY {
                    let completed = DVec3::new(m.x, m.y, from_dip(a));
                    // The dip is met by construction; what is left to check is the horizontal part.
                    let part = (completed - a * dip).length();
                    let slack = FIELD_SLACK * horizontal + READING_ERROR / a.z.abs();
                    if !((part - horizontal).abs() <= slack) {
                        return Err(lost(part / horizontal));
                    }
                    completed.z
                } else {
                    // What is missing of the dip must not be more than the third axis can add.
                    let slack = FIELD_SLACK * dip.abs() + READING_ERROR + a.z.abs();
                    if !((measured - dip).abs() <= slack) {
                        return Err(lost((measured / dip).abs()));
                    }
                    let size = (1.0 - m.x * m.x - m.y * m.y).max(0.0).sqrt();
                    size.copysign(
                        before.unwrap_or_else(|| if a.z == 0.0 { 1.0 } else { from_dip(a) }),
                    )
                };
                *m = m.try_normalize().ok_or(Error::TangentLost {
                    s: self.sensors[sensor].s,
                    length: 0.0,
                })?;
            }
            before = Some(scratch.magnetic[i].z);
        }
        Ok(())
    }

    /// The ribbon's frame (columns) from the unit fields in the body frame: world triad times body triad
    /// transposed.
    fn frame(&self, a: DVec3, m: DVec3) -> DMat3 {
        triad(self.world.up(), self.world.magnetic()) * triad(a, m).transpose()
    }

    /// The derivative of every tangent by every reading (as unit body vectors): `3 places x 3 sensors`.
    fn sensitivity(&self, scratch: &Scratch) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(3 * self.places.len(), 3 * self.sensors.len());
        let world = triad(self.world.up(), self.world.magnetic());
        for channel in [&self.gravity, &self.magnetic] {
            let cardinals = cardinal_values(channel, self.places.len());
            for place in 0..self.places.len() {
                let [by_gravity, by_magnetic] =
                    tangent_derivatives(world, self.fields(place, scratch));
                let by_field = if core::ptr::eq(channel, &self.gravity) {
                    by_gravity
                } else {
                    by_magnetic
                };
                for (k, &sensor) in channel.sensors.iter().enumerate() {
                    let block = by_field * cardinals[(place, k)];
                    for (row, column) in (0..9).map(|n| (n % 3, n / 3)) {
                        matrix[(3 * place + row, 3 * sensor + column)] = block.col(column)[row];
                    }
                }
            }
        }
        matrix
    }
}

#[cfg(test)]
mod tests;
