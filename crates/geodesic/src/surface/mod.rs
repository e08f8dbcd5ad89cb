//! Geodesics on smooth surfaces: as limits of paths on polyhedra, by their differential equation, and on a torus in closed
//! form.

mod between;
mod carry;
mod convergence;
mod grid;
mod levels;
mod net;
mod polyhedron;
mod revolution;
mod smooth;
mod subdivision;
mod tiles;
mod torus_loops;
mod trace;

pub use between::{SmoothGeodesic, geodesic_between};
pub use convergence::Convergence;
pub use levels::{LevelPath, PatchLevels};
pub use revolution::SurfaceOfRevolution;
pub use smooth::{SmoothSurface, SurfaceJet, TorusSurface};
pub use subdivision::{Scheme, SubdivisionSurface};
pub use torus_loops::{ClosedTorusGeodesic, closed_torus_geodesic};
pub use trace::{SurfaceRay, trace_smooth, trace_smooth_points};
