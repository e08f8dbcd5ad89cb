//! Geodesics on smooth surfaces: as limits of paths on nets, by their differential equation, and on a torus in closed form.

mod levels;
mod smooth;
mod torus_loops;

pub use levels::{LevelPath, PatchLevels};
pub use smooth::{SmoothSurface, SurfaceJet, SurfaceRay, TorusSurface, trace_smooth};
pub use torus_loops::{ClosedTorusGeodesic, closed_torus_geodesic};
