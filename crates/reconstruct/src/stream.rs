//! Reconstruction frame by frame, as the real-time demonstrator does (Section 3.2 of the thesis chapter).

use crate::quadrature::SIX;
use crate::spatial::ANTIPODAL;
use crate::spline::SplineSystem;
use crate::tangent::{RibbonLayout, Scratch};
use crate::{EndCondition, Error};
use glam::DVec3;

/// A spline of unit vectors shorter than this has lost its direction.
const NEAR_ZERO: f64 = 0.1;

/// Reconstructs a ribbon from one frame of readings after the other, without allocating.
///
/// The same mathematics as [`RibbonLayout::tangents`] followed by [`SpatialRibbon::new`](crate::SpatialRibbon::new),
/// with one six-point Gauss step between neighbouring sensors. How far the positions differ from the ribbon's by that,
/// in parts of its length, depends on the turn from one sensor to the next: below `1e-13` at 0.2 radians, and for 8 sensors
/// on a bend `3e-11` at 0.5, `6e-7` at 1 and `7e-3` at 1.5. All systems are factored when the stream is made.
#[derive(Clone, Debug, PartialEq)]
pub struct RibbonStream {
    layout: RibbonLayout,
    system: SplineSystem,
    scratch: Scratch,
    tangents: Vec<DVec3>,
    moments: Vec<DVec3>,
    points: Vec<DVec3>,
    /// The frame in work; exchanged with `points` when it is good.
    next: Vec<DVec3>,
    /// Rows of (value, value, moment, moment) weights at the Gauss nodes; the moments' ones are to be
    /// multiplied by the squared spacing.
    node_weights: [[f64; 4]; 6],
}

impl RibbonStream {
    /// A stream for ribbons of this layout.
    ///
    /// # Errors
    /// None for a valid layout; those of the spline's knots.
    pub fn new(layout: RibbonLayout) -> Result<Self, Error> {
        let system = SplineSystem::new(layout.arc_lengths(), EndCondition::NotAKnot)?;
        let zeros = vec![DVec3::ZERO; layout.arc_lengths().len()];
        let node_weights = SIX.map(|(b, _)| {
            let a = 1.0 - b;
            [a, b, (a * a * a - a) / 6.0, (b * b * b - b) / 6.0]
        });
        Ok(Self {
            scratch: layout.scratch(),
            layout,
            system,
            tangents: zeros.clone(),
            moments: zeros.clone(),
            points: zeros.clone(),
            next: zeros,
            node_weights,
        })
    }

    /// The positions at the layout's arc lengths (the first is the origin) for one frame of raw readings.
    ///
    /// # Errors
    /// As [`RibbonLayout::tangents`]; [`Error::AntipodalTangents`] and [`Error::TangentLost`] for tangents
    /// that turn too fast. The positions of the last good frame are then kept.
    pub fn frame(&mut self, readings: &[DVec3]) -> Result<&[DVec3], Error> {
        self.layout
            .tangents_into(readings, &mut self.scratch, &mut self.tangents)?;
        for (i, pair) in self.tangents.windows(2).enumerate() {
            let cosine = pair[0].dot(pair[1]);
            if cosine < ANTIPODAL {
                return Err(Error::AntipodalTangents {
                    index: i + 1,
                    cosine,
                });
            }
        }
        self.system.moments_into(&self.tangents, &mut self.moments);
        let knots = self.system.knots();
        let mut point = DVec3::ZERO;
        let mut weakest = (f64::INFINITY, 0.0);
        for i in 0..knots.len() - 1 {
            let spacing = knots[i + 1] - knots[i];
            let square = spacing * spacing;
            let mut sum = DVec3::ZERO;
            for ([a, b, p, q], (_, weight)) in self.node_weights.iter().zip(SIX) {
                let value = self.tangents[i] * *a
                    + self.tangents[i + 1] * *b
                    + (self.moments[i] * *p + self.moments[i + 1] * *q) * square;
                let length = value.length();
                if length < weakest.0 {
                    weakest = (length, knots[i]);
                }
                sum += value * (weight / length);
            }
            if !(weakest.0 >= NEAR_ZERO) {
                return Err(Error::TangentLost {
                    s: weakest.1,
                    length: weakest.0,
                });
            }
            point += sum * spacing;
            self.next[i + 1] = point;
        }
        core::mem::swap(&mut self.points, &mut self.next);
        Ok(&self.points)
    }

    /// The positions of the last good frame.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The unit tangents of the last frame.
    #[must_use]
    pub fn tangents(&self) -> &[DVec3] {
        &self.tangents
    }

    /// The layout.
    #[must_use]
    pub fn layout(&self) -> &RibbonLayout {
        &self.layout
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Sensor, SensorKind, WorldFields};
    use glam::DMat3;

    fn frame_at(s: f64, time: f64) -> DMat3 {
        let x = DVec3::new(
            (0.9 * s + time).cos(),
            (0.9 * s).sin(),
            0.3 * (1.1 * s + time).sin(),
        )
        .normalize();
        let y = DVec3::new(-0.2 * s, 0.4, 1.0).cross(x).normalize();
        DMat3::from_cols(x, y, x.cross(y))
    }

    #[test]
    fn a_stream_gives_what_the_ribbon_gives_and_moves_no_buffer() {
        let world = WorldFields::with_dip(1.08).unwrap();
        let kind = |i: usize| {
            if i.is_multiple_of(2) {
                SensorKind::Accelerometer
            } else {
                SensorKind::Magnetometer
            }
        };
        let layout = RibbonLayout::new(
            (0..32).map(|i| Sensor::new(0.05 * i as f64, kind(i))),
            world,
        )
        .unwrap();
        let mut stream = RibbonStream::new(layout.clone()).unwrap();
        let buffers = |stream: &RibbonStream| {
            let mut two = [stream.points.as_ptr(), stream.next.as_ptr()];
            two.sort();
            (two, stream.tangents.as_ptr(), stream.moments.as_ptr())
        };
        let before = buffers(&stream);
        for time in [0.0, 0.1, 0.2] {
            let readings: Vec<DVec3> = layout
                .sensors()
                .iter()
                .map(|sensor| {
                    let field = if sensor.is_magnetometer() {
                        world.magnetic()
                    } else {
                        world.up()
                    };
                    frame_at(sensor.s, time).transpose() * field
                })
                .collect();
            let ribbon = layout.tangents(&readings).unwrap().ribbon().unwrap();
            let points = stream.frame(&readings).unwrap();
            for (a, b) in points.iter().zip(ribbon.points()) {
                assert!((*a - *b).length() < 2e-13);
            }
        }
        assert_eq!(before, buffers(&stream));
        let good = stream.points().to_vec();
        assert!(stream.frame(&[DVec3::NAN; 32]).is_err());
        assert_eq!(stream.points(), good);
    }

    /// The accuracy that the documentation of the stream states.
    #[test]
    fn accuracy_by_the_turn_between_sensors() {
        let world = WorldFields::with_dip(1.08).unwrap();
        let kinds = [SensorKind::Accelerometer, SensorKind::Magnetometer];
        // Both kinds at each of eight places, so that the tangents are exact.
        let sensors = (0..8).flat_map(|i| kinds.map(|kind| Sensor::new(0.05 * f64::from(i), kind)));
        let layout = RibbonLayout::new(sensors, world).unwrap();
        let mut stream = RibbonStream::new(layout.clone()).unwrap();
        for (turn, bound) in [(0.2, 1e-13), (0.5, 3e-11), (1.0, 6e-7), (1.5, 7e-3)] {
            let frame = |s: f64| {
                let (sin, cos) = (turn / 0.05 * s).sin_cos();
                let x = DVec3::new(cos, sin, 0.2).normalize();
                let y = DVec3::Z.cross(x).normalize();
                DMat3::from_cols(x, y, x.cross(y))
            };
            let readings: Vec<DVec3> = layout
                .sensors()
                .iter()
                .map(|sensor| {
                    let field = if sensor.is_magnetometer() {
                        world.magnetic()
                    } else {
                        world.up()
                    };
                    frame(sensor.s).transpose() * field
                })
                .collect();
            let ribbon = layout.tangents(&readings).unwrap().ribbon().unwrap();
            let end = stream.frame(&readings).unwrap()[7];
            let error = end.distance(ribbon.points()[7]) / 0.35;
            assert!(error < bound, "{turn}: {error:e}");
        }
    }
}
