//! Canal surfaces and parts of spheres as meshes.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use glam::DVec3;
use lorentz::{CanalCurve, TubeGrid};

use super::{Mesh, chord_steps};

/// Rings and sectors of the first look at a surface.
const FIRST_LOOK: (usize, usize) = (64, 8);
/// No surface gets more rings than this.
const MOST_STEPS: f64 = 4096.0;

impl Mesh {
    /// The canal surface of `curve` over `[start, end]`, its chord error within `tolerance`.
    ///
    /// # Errors
    /// Where the surface has no mesh: a line or a vertex at infinity in the interval.
    pub fn canal(curve: &CanalCurve, [start, end]: [f64; 2], tolerance: f64) -> Result<Self> {
        let grid = |steps, sectors| TubeGrid::new(steps, sectors).with_interval(start, end);
        let look = curve.tessellate(&grid(FIRST_LOOK.0, FIRST_LOOK.1))?;
        // The height of a chord over two steps is four times that over one, and falls by the square of their number.
        let sectors = look.sectors();
        let height = |i: usize| {
            let [a, b, c] = [i - sectors, i, i + sectors].map(|k| look.positions()[k]);
            0.25 * b.distance(0.5 * (a + c))
        };
        let inner = sectors..look.positions().len().saturating_sub(sectors);
        let bend = inner.map(height).fold(0.0, f64::max);
        let steps = (FIRST_LOOK.0 as f64 * (2.0 * bend / tolerance).sqrt())
            .ceil()
            .clamp(1.0, MOST_STEPS);
        let radius = look
            .positions()
            .chunks_exact(sectors)
            .map(|ring| 0.5 * ring[0].distance(ring[sectors / 2]))
            .fold(0.0, f64::max);
        let around = chord_steps(radius, TAU * radius, 0.5 * tolerance).max(8);
        let tube = curve.tessellate(&grid(steps as usize, around))?;
        Ok(Self::new(
            tube.positions().to_vec(),
            tube.normals().to_vec(),
            tube.triangles(),
        ))
    }

    /// The part of a sphere within `angle` of the direction `pole`, its chord error within `tolerance`.
    #[must_use]
    pub fn cap(centre: DVec3, radius: f64, pole: DVec3, angle: f64, tolerance: f64) -> Self {
        let pole = pole.normalize_or(DVec3::Z);
        let (u, v) = pole.any_orthonormal_pair();
        let angle = angle.clamp(0.0, PI);
        let rings = chord_steps(radius, angle * radius, tolerance).max(2);
        let around = chord_steps(radius, TAU * radius, tolerance).max(8);
        Self::grid(around, rings, |azimuth, polar| {
            let ((sin_a, cos_a), (sin_p, cos_p)) =
                ((TAU * azimuth).sin_cos(), (angle * polar).sin_cos());
            let normal = cos_p * pole + sin_p * (cos_a * u + sin_a * v);
            (centre + radius * normal, normal)
        })
    }
}
