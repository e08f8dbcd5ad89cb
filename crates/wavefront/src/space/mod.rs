//! Fronts in space: surfaces given by their support function, propagated and reflected.
//!
//! In space as in the plane a front is the envelope of its tangent planes, and propagation adds the time to their
//! distances. The support functions here are those of spheres and ellipsoids; a reflection in a plane maps planes to
//! planes and is exact. A reflection in a quadric has no such form: it is sampled ray by ray, exactly, on a grid, or
//! interpolated by patches that join smoothly.

mod dual;
mod mirror;
mod patches;
mod sampled;
#[cfg(test)]
mod tests;

use glam::DVec3;

pub use dual::DualSurface;
pub use mirror::Mirror;
pub use patches::{FrontPatches, Omission, PatchOptions};
pub use sampled::SampledSurface;

/// A point of a surface with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SpacePoint {
    /// The point.
    pub point: DVec3,
    /// The unit normal, the direction in which the front runs.
    pub normal: DVec3,
}
