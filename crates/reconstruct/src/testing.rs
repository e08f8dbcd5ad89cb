//! What the tests of several modules share: seeded noise, strips along helices.

use crate::{AnalyticCurve, GeodesicStrip, Surface, geodesic_curvature};
use glam::DVec3;

/// A small deterministic generator (SplitMix64).
pub(crate) struct Noise(u64);

impl Noise {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Uniform in `[0, 1)`.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Standard normal (Box and Muller).
    pub(crate) fn gaussian(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (core::f64::consts::TAU * self.uniform()).cos()
    }

    pub(crate) fn gaussian_vector(&mut self) -> DVec3 {
        DVec3::new(self.gaussian(), self.gaussian(), self.gaussian())
    }
}

/// A geodesic of the unit cylinder.
pub(crate) fn helix(pitch: f64, z: f64) -> GeodesicStrip {
    GeodesicStrip::new(AnalyticCurve::new(move |t| {
        [t.cos(), t.sin(), t * pitch + z]
    }))
    .unwrap()
}

/// Largest geodesic curvature of the edges `v = 0` and `v = 1`.
pub(crate) fn boundary(surface: &impl Surface) -> f64 {
    let places = (0..=20).map(|i| f64::from(i) / 20.0);
    places
        .flat_map(|u| [0.0, 1.0].map(|v| surface.partials(u, v)))
        .map(|at| geodesic_curvature(at.du, at.duu, at.du.cross(at.dv)).abs())
        .fold(0.0, f64::max)
}

/// The strip of a space curve by its binormal, which reverses at 0.4.
pub(crate) fn inflected(z: f64) -> GeodesicStrip {
    GeodesicStrip::new(AnalyticCurve::new(move |t| {
        let x = t - 0.4;
        [t, x * x * x, x * x * x * x * 2.0 + z]
    }))
    .unwrap()
}
