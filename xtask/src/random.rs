//! Random numbers that are the same on every machine.

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};
use variation::sets::SplitMix64;

/// A generator with the distributions that demos ask for.
#[derive(Clone, Debug)]
pub struct Random(SplitMix64);

impl Random {
    /// The generator of a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(SplitMix64::new(seed))
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0.unit()
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Normal with mean 0 and variance 1 (Box and Muller).
    pub fn gaussian(&mut self) -> f64 {
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (TAU * self.unit()).cos()
    }

    /// A unit vector, uniform on the sphere.
    pub fn direction(&mut self) -> DVec3 {
        let (z, angle) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let radius = (1.0 - z * z).sqrt();
        dvec3(radius * angle.cos(), radius * angle.sin(), z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_moments_are_those_of_the_distributions() {
        let mut random = Random::new(7);
        let count = 100_000;
        let mut mean = |draw: &dyn Fn(&mut Random) -> f64| {
            (0..count).map(|_| draw(&mut random)).sum::<f64>() / f64::from(count)
        };
        // Six standard deviations of the means of so many draws.
        let room = 6.0 / f64::from(count).sqrt();
        assert!((mean(&|r| r.unit()) - 0.5).abs() < room * 0.29);
        assert!(mean(&|r| r.gaussian()).abs() < room);
        assert!((mean(&|r| r.gaussian().powi(2)) - 1.0).abs() < room * 1.42);
        assert!((mean(&|r| r.direction().x.powi(2)) - 1.0 / 3.0).abs() < room * 0.3);
        assert!((mean(&|r| r.direction().z.powi(2)) - 1.0 / 3.0).abs() < room * 0.3);
    }
}
