//! C1 Hermite interpolation by spatial PH quintics, with its two free angles.

use std::f64::consts::{FRAC_PI_2, TAU};

use bezier_mass::VectorSpace;
use glam::{DVec2, DVec3};

use super::{Quaternion, SpatialPh};
use crate::Error;

/// End points and end derivatives of a curve on `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpatialHermite {
    /// The start.
    pub start: DVec3,
    /// The derivative at the start, not zero.
    pub start_derivative: DVec3,
    /// The end.
    pub end: DVec3,
    /// The derivative at the end, not zero.
    pub end_derivative: DVec3,
}

/// The angles of the three square roots that a Hermite PH quintic takes. Only their differences matter, so two are free.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpatialHermiteAngles {
    /// Angle of `A0`, radians.
    pub start: f64,
    /// Angle of the middle root `Q`, radians; by default `-π/2`.
    pub middle: f64,
    /// Angle of `A2`, radians.
    pub end: f64,
}

impl Default for SpatialHermiteAngles {
    fn default() -> Self {
        Self {
            start: 0.0,
            middle: -FRAC_PI_2,
            end: 0.0,
        }
    }
}

/// Steps of the grid, a side, on which the two angles are searched before the best cell is refined.
const GRID: usize = 16;
/// The pattern search stops at this step; the criteria are flat to second order at a minimum.
const FINEST_STEP: f64 = 1e-7;

impl SpatialHermite {
    /// The PH quintic with the given angles (Farouki, al-Kandari, Sakkalis 2002):
    /// `A1 = (Q - 3 A0 - 3 A2) / 4` with `Q i Q* = 120 Δp - 15 (d0 + d1) + 5 (A0 i A2* + A2 i A0*)`.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] for a zero end derivative.
    pub fn quintic(&self, angles: SpatialHermiteAngles) -> Result<SpatialPh, Error> {
        SpatialPh::try_new(self.start, self.preimage(angles)?)
    }

    /// The PH quintic of least bending energy over both free angles (a grid search and a refinement of its best point).
    ///
    /// # Errors
    ///
    /// As for [`SpatialHermite::quintic`].
    pub fn least_bending(&self) -> Result<SpatialPh, Error> {
        self.preimage(SpatialHermiteAngles::default())?;
        let unit = self.of_size_one();
        let energy = |angles: DVec2| {
            unit.quintic(free(angles))
                .map_or(f64::INFINITY, |curve| some_number(curve.bending_energy()))
        };
        self.quintic(free(minimise(energy)))
    }

    /// A PH quintic of the given arc length: the one of least bending energy among those found on segments from the
    /// shortest to longer ones. The length is met to rounding.
    ///
    /// # Errors
    ///
    /// As for [`SpatialHermite::quintic`], and [`Error::OutsideDomain`] with the attainable lengths if no choice of the
    /// two angles gives this one.
    pub fn of_length(&self, length: f64) -> Result<SpatialPh, Error> {
        self.preimage(SpatialHermiteAngles::default())?;
        if !length.is_finite() {
            return Err(Error::NonFinite { what: "arc length" });
        }
        let length_at = |angles: DVec2| {
            self.preimage(free(angles))
                .map_or(f64::NAN, |preimage| length_of(&preimage))
        };
        let shortest = minimise(length_at);
        let longest = minimise(|angles| -length_at(angles));
        let (least, most) = (length_at(shortest), length_at(longest));
        if !(least..=most).contains(&length) {
            return Err(Error::OutsideDomain {
                value: length,
                start: least,
                end: most,
            });
        }
        let candidates = grid()
            .chain([longest])
            .filter(|&angles| length_at(angles) >= length);
        let curves = candidates.filter_map(|longer| {
            let share = bisect(0.0, 1.0, |share| {
                length_at(shortest.lerp(longer, share)) - length
            });
            self.quintic(free(shortest.lerp(longer, share))).ok()
        });
        least_bent(curves).ok_or(Error::OutsideDomain {
            value: length,
            start: least,
            end: most,
        })
    }

    /// A PH quintic of the given arc length that keeps the end points and the directions of the end derivatives, both
    /// scaled by one factor (G1 interpolation): of all angles on a grid, with the factor solved for, the one of least
    /// bending energy. Every length above the chord is attained, to rounding.
    ///
    /// # Errors
    ///
    /// As for [`SpatialHermite::quintic`], and [`Error::OutsideDomain`] unless the length exceeds the chord.
    pub fn of_length_along_tangents(&self, length: f64) -> Result<SpatialPh, Error> {
        self.preimage(SpatialHermiteAngles::default())?;
        let chord = self.start.distance(self.end);
        if !length.is_finite() {
            return Err(Error::NonFinite { what: "arc length" });
        }
        if length <= chord {
            return Err(Error::OutsideDomain {
                value: length,
                start: chord,
                end: f64::INFINITY,
            });
        }
        let curves = grid().filter_map(|angles| {
            let excess = |factor: f64| {
                let preimage = self.scaled(factor).preimage(free(angles));
                preimage.map_or(f64::NAN, |preimage| length_of(&preimage) - length)
            };
            // For vanishing derivatives the quintic is the chord; the length grows with the factor in the end.
            let unit = length
                / self
                    .start_derivative
                    .length()
                    .max(self.end_derivative.length());
            let above = (0..12)
                .map(|power| unit * f64::from(1 << power))
                .find(|&factor| excess(factor) >= 0.0)?;
            self.scaled(bisect(0.0, above, excess))
                .quintic(free(angles))
                .ok()
        });
        least_bent(curves).ok_or(Error::NoInterpolant {
            what: "PH quintic of the given length",
        })
    }

    /// The same data from the origin and of size one: energies of huge and tiny curves overflow.
    fn of_size_one(&self) -> Self {
        let chord = self.end - self.start;
        let size = [chord, self.start_derivative, self.end_derivative]
            .into_iter()
            .fold(0.0, |size: f64, v| size.max(v.abs().max_element()));
        Self {
            start: DVec3::ZERO,
            start_derivative: self.start_derivative / size,
            end: chord / size,
            end_derivative: self.end_derivative / size,
        }
    }

    /// The same data with both derivatives multiplied by `factor`.
    fn scaled(&self, factor: f64) -> Self {
        Self {
            start_derivative: factor * self.start_derivative,
            end_derivative: factor * self.end_derivative,
            ..*self
        }
    }

    fn preimage(&self, angles: SpatialHermiteAngles) -> Result<[Quaternion; 3], Error> {
        if !(self.start.is_finite() && self.end.is_finite()) {
            return Err(Error::NonFinite {
                what: "end point of Hermite data",
            });
        }
        let root = |derivative: DVec3, angle| match Quaternion::square_root(derivative, angle)? {
            zero if zero == Quaternion::ZERO => Err(Error::ZeroDirection {
                what: "end derivative of Hermite data",
            }),
            root => Ok(root),
        };
        let first = root(self.start_derivative, angles.start)?;
        let last = root(self.end_derivative, angles.end)?;
        let square = 120.0 * (self.end - self.start)
            - 15.0 * (self.start_derivative + self.end_derivative)
            + 10.0 * first.polar_image(last);
        let middle = Quaternion::square_root(square, angles.middle)?
            .minus(first.plus(last).times(3.0))
            .times(0.25);
        Ok([first, middle, last])
    }
}

/// The two free angles as a point of the plane.
fn free(angles: DVec2) -> SpatialHermiteAngles {
    SpatialHermiteAngles {
        start: angles.x,
        end: angles.y,
        ..SpatialHermiteAngles::default()
    }
}

/// The arc length of a quintic: the mean of the speed's Bernstein coefficients.
fn length_of([first, middle, last]: &[Quaternion; 3]) -> f64 {
    let inner = (2.0 * middle.norm_squared() + first.dot(*last)) / 3.0;
    (first.norm_squared() + first.dot(*middle) + inner + middle.dot(*last) + last.norm_squared())
        / 5.0
}

/// A criterion that is NaN (a cusp) must not win a comparison.
pub(super) fn some_number(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}

pub(super) fn grid() -> impl Iterator<Item = DVec2> {
    let angle = |i: usize| TAU * (i as f64 / GRID as f64) - TAU / 2.0;
    (0..GRID * GRID).map(move |i| DVec2::new(angle(i / GRID), angle(i % GRID)))
}

/// The least value over the torus of two angles: best point of the grid, refined by a compass search.
fn minimise(criterion: impl Fn(DVec2) -> f64) -> DVec2 {
    let (mut best, mut value) = (DVec2::ZERO, f64::INFINITY);
    for angles in grid() {
        let found = some_number(criterion(angles));
        if found < value {
            (best, value) = (angles, found);
        }
    }
    let mut step = TAU / GRID as f64;
    while step > FINEST_STEP {
        let around = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y]
            .map(|direction| best + step * direction);
        let found = around.map(|angles| some_number(criterion(angles)));
        match (0..4).min_by(|&i, &j| found[i].total_cmp(&found[j])) {
            Some(i) if found[i] < value => (best, value) = (around[i], found[i]),
            _ => step *= 0.5,
        }
    }
    best
}

fn least_bent(curves: impl Iterator<Item = SpatialPh>) -> Option<SpatialPh> {
    let energies = curves.map(|curve| (some_number(curve.bending_energy()), curve));
    energies
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, curve)| curve)
}

/// A zero of `f` between `low` and `high`, with `f(low) <= 0 <= f(high)`; halved until the two are neighbours.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    const DATA: SpatialHermite = SpatialHermite {
        start: DVec3::ZERO,
        start_derivative: DVec3::new(1.0, 0.4, 0.2),
        end: DVec3::new(1.0, 1.0, 0.6),
        end_derivative: DVec3::new(0.3, 1.2, -0.2),
    };

    fn interpolates(curve: &SpatialPh) {
        let close = |a: DVec3, b: DVec3| assert!((a - b).length() < 1e-14, "{a} {b}");
        close(curve.point(0.0), DATA.start);
        close(curve.point(1.0), DATA.end);
        close(curve.velocity(0.0), DATA.start_derivative);
        close(curve.velocity(1.0), DATA.end_derivative);
    }

    #[test]
    fn every_choice_of_angles_interpolates() {
        for angles in grid().step_by(7) {
            interpolates(&DATA.quintic(free(angles)).unwrap());
        }
    }

    #[test]
    fn the_least_bending_is_below_the_default() {
        let (best, plain) = (
            DATA.least_bending().unwrap(),
            DATA.quintic(SpatialHermiteAngles::default()).unwrap(),
        );
        interpolates(&best);
        assert!(best.bending_energy() < plain.bending_energy());
        // No choice on a grid that the search did not use is better.
        for angles in grid().map(|angles| angles + DVec2::new(0.1, 0.17)) {
            assert!(best.bending_energy() <= DATA.quintic(free(angles)).unwrap().bending_energy());
        }
    }

    #[test]
    fn the_least_bending_does_not_depend_on_the_size() {
        let plain = DATA.least_bending().unwrap().arc_length().total();
        for size in [1e-120, 1e-60, 1e60, 1e120] {
            let data = SpatialHermite {
                start: DATA.start * size,
                start_derivative: DATA.start_derivative * size,
                end: DATA.end * size,
                end_derivative: DATA.end_derivative * size,
            };
            let found = data.least_bending().unwrap().arc_length().total();
            assert!((found / size / plain - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_length_is_met_or_refused_with_the_attainable_ones() {
        for length in [1.585, 1.6, 1.615] {
            let curve = DATA.of_length(length).unwrap();
            interpolates(&curve);
            assert!((curve.arc_length().total() - length).abs() < 1e-13);
        }
        for length in [1.0, 1.7] {
            assert!(matches!(
                DATA.of_length(length),
                Err(Error::OutsideDomain { .. })
            ));
        }
        assert!(matches!(
            DATA.of_length(f64::NAN),
            Err(Error::NonFinite { .. })
        ));
    }

    #[test]
    fn with_free_speeds_every_length_above_the_chord_is_met() {
        let chord = DATA.end.length();
        for length in [1.001 * chord, 1.7, 3.0, 20.0] {
            let curve = DATA.of_length_along_tangents(length).unwrap();
            assert!((curve.arc_length().total() - length).abs() < 1e-13 * length);
            assert!((curve.point(1.0) - DATA.end).length() < 1e-13);
            assert!(curve.velocity(0.0).angle_between(DATA.start_derivative) < 1e-7);
            assert!(curve.velocity(1.0).angle_between(DATA.end_derivative) < 1e-7);
        }
        assert!(matches!(
            DATA.of_length_along_tangents(chord),
            Err(Error::OutsideDomain { .. })
        ));
    }

    #[test]
    fn hostile_data_are_refused() {
        let still = SpatialHermite {
            start_derivative: DVec3::ZERO,
            ..DATA
        };
        assert!(matches!(
            still.least_bending(),
            Err(Error::ZeroDirection { .. })
        ));
        let nowhere = SpatialHermite {
            end: DVec3::NAN,
            ..DATA
        };
        assert!(matches!(
            nowhere.quintic(SpatialHermiteAngles::default()),
            Err(Error::NonFinite { .. })
        ));
    }
}
