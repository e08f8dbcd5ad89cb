//! One kind of sensor along the ribbon, interpolated to every place.

use super::NEEDED;
use crate::sensor::Sensor;
use crate::spline::{SplineSystem, interval};
use crate::{EndCondition, Error};
use glam::DVec3;
use nalgebra::DMatrix;

/// A weighted sum of two values and two moments: a spline's value at a fixed place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stencil {
    pub(super) first: usize,
    pub(super) values: [f64; 2],
    pub(super) moments: [f64; 2],
}

/// The sensors that measure one field, with the spline that carries it to all places.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Channel {
    pub(super) sensors: Vec<usize>,
    pub(super) system: SplineSystem,
    /// How to evaluate at every place of the layout.
    everywhere: Vec<Stencil>,
}

impl Channel {
    pub(super) fn new(sensors: &[Sensor], magnetic: bool, places: &[f64]) -> Result<Self, Error> {
        let mine: Vec<usize> = (0..sensors.len())
            .filter(|i| sensors[*i].is_magnetometer() == magnetic)
            .collect();
        if mine.len() < NEEDED {
            let what = if magnetic {
                "magnetometers"
            } else {
                "accelerometers"
            };
            return Err(Error::TooFew {
                what,
                needed: NEEDED,
                got: mine.len(),
            });
        }
        let knots: Vec<f64> = mine.iter().map(|i| sensors[*i].s).collect();
        // Places are counted among all sensors, not only these.
        let system =
            SplineSystem::new(&knots, EndCondition::NotAKnot).map_err(|error| match error {
                Error::NotIncreasing {
                    index,
                    previous,
                    next,
                } => Error::NotIncreasing {
                    index: mine[index],
                    previous,
                    next,
                },
                Error::NonFinite { what, index } => Error::NonFinite {
                    what,
                    index: mine[index],
                },
                other => other,
            })?;
        let everywhere = places.iter().map(|s| stencil(&knots, *s)).collect();
        Ok(Self {
            sensors: mine,
            system,
            everywhere,
        })
    }

    pub(super) fn value(&self, place: usize, values: &[DVec3], moments: &[DVec3]) -> DVec3 {
        let Stencil {
            first: i,
            values: [a, b],
            moments: [p, q],
        } = self.everywhere[place];
        values[i] * a + values[i + 1] * b + moments[i] * p + moments[i + 1] * q
    }
}

pub(super) fn stencil(knots: &[f64], s: f64) -> Stencil {
    let first = interval(knots, s);
    let h = knots[first + 1] - knots[first];
    let b = (s - knots[first]) / h;
    let a = 1.0 - b;
    let sixth = h * h / 6.0;
    Stencil {
        first,
        values: [a, b],
        moments: [(a * a * a - a) * sixth, (b * b * b - b) * sixth],
    }
}

/// Value of each sensor's cardinal spline at each place.
pub(super) fn cardinal_values(channel: &Channel, places: usize) -> DMatrix<f64> {
    let n = channel.sensors.len();
    let mut matrix = DMatrix::zeros(places, n);
    let mut moments = vec![0.0; n];
    for k in 0..n {
        let unit: Vec<f64> = (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
        channel.system.moments_into(&unit, &mut moments);
        for place in 0..places {
            let Stencil {
                first: i,
                values: [a, b],
                moments: [p, q],
            } = channel.everywhere[place];
            matrix[(place, k)] =
                a * unit[i] + b * unit[i + 1] + p * moments[i] + q * moments[i + 1];
        }
    }
    matrix
}
