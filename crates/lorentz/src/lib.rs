//! Oriented spheres, planes and points as vectors of the Lorentz space L(4,1), and canal surfaces as curves there
mod canal;
mod chain;
mod circle;
mod conic_pair;
pub mod construct;
pub mod dandelin;
mod error;
mod joint;
mod object;
mod pencil;
mod plane;
mod point;
mod relation;
mod roots;
mod sphere;
mod sphere_curve;
mod sphere_vector;
mod tessellation;
mod tolerance;
mod transform;
mod vector;

pub use canal::{CanalCurve, CanalMember, SurfacePoint};
pub use chain::CanalChain;
pub use circle::{CharacteristicCircle, Circle, Line};
pub use conic_pair::{
    Classification, ContactPatch, CyclideKind, ImplicitCyclide, Invariants, OwnParameter,
    SecondFamily,
};
pub use construct::ConicType;
pub use error::Error;
pub use glam; // its types appear in our signatures
pub use joint::{Course, Joint};
pub use object::Object;
pub use pencil::{Pencil, PencilKind};
pub use plane::Plane;
pub use point::Point;
pub use relation::{PointPosition, Relation, Side, SpherePosition};
pub use sphere::{Cycle, Sphere};
pub use sphere_curve::{SphereCurve, SphereMassPoint, lie_product};
pub use sphere_vector::SphereVector;
pub use tessellation::{Spacing, Tube, TubeGrid};
pub use transform::LorentzMap;
pub use vector::{CausalType, LorentzVector};
