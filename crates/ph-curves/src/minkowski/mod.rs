//! The Minkowski plane: a centrally symmetric, strictly convex curve, the *indicatrix* `U`, takes the part of the unit circle.
//!
//! ```text
//!   indicatrix U            isoperimetrix U0            offset F + d u
//!     .-----.                    .-.                   each point moves to the
//!    /   o-->u                 /     \                 copy of U around it that
//!    \       /                |   o   |                has the same outward normal
//!     '-----'                  \     /
//!                                '-'
//! ```
//!
//! The norm of a vector is measured by the diameter of `U` parallel to it. The *isoperimetrix* `U0`, the polar reciprocal
//! of `U` turned by `-π/2`, is the indicatrix of the dual plane: a line is `U`-normal to another if and only if the other
//! is `U0`-normal to it. Source: Ait-Haddou, Biard, Slawinski, *Minkowski isoperimetric-hodograph curves*, CAGD 2000.

mod ih;
mod indicatrix;
mod plane;
mod width;

pub use ih::IsoperimetricArc;
pub use indicatrix::{Bumped, DualIndicatrix, Ellipse, Indicatrix, Support};
pub use plane::{MinkowskiFrame, MinkowskiPlane};
pub use width::{ConstantMinkowskiWidth, constant_width_arcs};
