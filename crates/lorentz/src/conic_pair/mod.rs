//! A Dupin cyclide as the union of two conics on the space of spheres: both families of its spheres.

mod classification;
mod contact_patch;
mod implicit;
mod second_family;

pub use classification::{Classification, CyclideKind, Invariants};
pub use contact_patch::ContactPatch;
pub use implicit::{ImplicitCyclide, OwnParameter};
pub use second_family::SecondFamily;
