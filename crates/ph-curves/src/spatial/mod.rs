//! Pythagorean-hodograph curves in space.
//!
//! A polynomial curve `r` whose speed is a polynomial is `r' = A i A*` for a quaternion polynomial `A`, its *preimage*
//! (Dietz, Hoschek, Jüttler 1993; Choi et al. 2002). The components of the hodograph are
//! `x' = u² + v² - p² - q²`, `y' = 2 (u q + v p)`, `z' = 2 (v q - u p)` with `A = u + v i + p j + q k`, the speed is
//! `|A|²`, and the arc length is again a polynomial.

mod curve;
mod frame;
mod hermite;
mod quaternion;
mod rrmf;
mod tube;

pub use curve::SpatialPh;
pub use frame::{Frame, rotation_minimising_frames};
pub use hermite::{SpatialHermite, SpatialHermiteAngles};
pub use quaternion::Quaternion;
pub use rrmf::RationalFrameQuintic;
pub use tube::{euler_rodrigues_tube, rotation_minimising_tube};
