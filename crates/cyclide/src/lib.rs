//! Dupin cyclides of every type, their exact rational patches, and the blending of cones
//!
//! (front page to be written last)

mod axes;
mod blend;
mod canal;
mod circle;
mod classify;
mod cone;
mod convert;
mod corners;
mod determine;
mod distance;
mod dupin;
mod error;
mod family;
mod frame;
mod join;
mod kind;
mod measure;
mod parabolic;
mod patch;
mod quartic;
mod ray;
mod recognise;
mod ring;
mod section;
mod spheres;
mod torus_patch;
mod tube;
mod villarceau;
pub mod tolerance;

pub use axes::{Axis, common_sphere};
pub use blend::{Blend, Contact, ContactFamily, contact_residual};
pub use circle::CurvatureCircle;
pub use classify::{Class, Classification, DoubleLine, Obstacle, classify};
pub use cone::{Cone, SphereLine};
pub use convert::{Conversion, convert};
pub use corners::patch_from_corners;
pub use determine::Determined;
pub use distance::Closest;
pub use dupin::Dupin;
pub use error::Error;
pub use family::{Conic, Diagonal, Family, TypeInterval};
pub use frame::Frame;
pub use join::{DoubleBlend, Joined, blend_through, double_blends, join};
pub use kind::Kind;
pub use parabolic::Parabolic;
pub use patch::{CyclidePatch, normalise};
pub use quartic::Quartic;
pub use ring::RingPreference;
pub use section::Section;
pub use torus_patch::convert_torus;
pub use tube::Tube;
pub use ray::{RayCaster, RayHit, RayHits};
pub use recognise::{Condition, NetReport, inspect, solve_weights};

pub use glam; // its types appear in our signatures
