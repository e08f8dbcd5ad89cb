//! The meshes that the demo makes itself.

use anyhow::Result;
use geodesic::{Mesh as Surface, TriangleSoup, shapes};
use glam::{DVec2, DVec3};

use crate::random::Random;

/// A sphere with bumps.
pub(super) fn bumpy(level: u32) -> Result<Surface> {
    let mut soup = TriangleSoup::from(shapes::sphere(level)?);
    for p in &mut soup.positions {
        *p *= 1.0
            + 0.12 * (7.0 * p.x).sin() * (6.0 * p.y).cos()
            + 0.1 * (5.0 * p.z + 2.0 * p.x).sin();
    }
    Ok(soup.try_into()?)
}

/// A terrain of 10 by 10 over scattered points, with a ridge among its edges.
pub(super) fn terrain(points: usize, seed: u64) -> Result<Surface> {
    let height = |p: DVec2| {
        let hills = 0.7 * (1.1 * p.x).sin() * (0.9 * p.y + 0.5).cos()
            + 0.25 * (2.3 * p.x - 1.7 * p.y).sin();
        let ridge = (-(p.y - 0.6 * p.x - 2.0).powi(2) / 0.5).exp();
        hills + 1.4 * ridge
    };
    let mut random = Random::new(seed);
    let mut plan: Vec<DVec2> = Vec::new();
    let side = (points as f64).sqrt().ceil() as u32;
    for k in 0..side {
        let t = 10.0 * f64::from(k) / f64::from(side);
        plan.extend([
            DVec2::new(t, 0.0),
            DVec2::new(10.0, t),
            DVec2::new(10.0 - t, 10.0),
            DVec2::new(0.0, 10.0 - t),
        ]);
    }
    // One point in each cell, so that no triangle is too thin.
    for cell in 0..side * side {
        let corner = DVec2::new(f64::from(cell % side), f64::from(cell / side));
        let inside = 0.15 + 0.7 * DVec2::new(random.unit(), random.unit());
        plan.push((corner + inside) * 10.0 / f64::from(side));
    }
    let first = plan.len() as u32;
    let ridge = 24;
    plan.extend((1..ridge).map(|k| {
        let x = 10.0 * f64::from(k) / f64::from(ridge);
        DVec2::new(x, 0.6 * x + 2.0)
    }));
    let breaklines: Vec<[u32; 2]> = (first..first + ridge - 2).map(|v| [v, v + 1]).collect();
    let points: Vec<DVec3> = plan.iter().map(|p| p.extend(height(*p))).collect();
    Ok(Surface::terrain(&points, &breaklines)?)
}
