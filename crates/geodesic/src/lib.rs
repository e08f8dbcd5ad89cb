//! Shortest and straightest paths on triangle meshes and smooth surfaces, exact where asked and certified always

#[cfg(feature = "closest-point")]
mod closest;
mod error;
mod exact;
mod finder;
mod funnel;
mod hop;
mod loops;
mod mesh;
mod path;
mod pivot;
mod search;
pub mod shapes;
mod straightest;
mod strip;
mod surface_point;
mod torus;
mod unfold;

#[cfg(feature = "closest-point")]
pub use closest::{Closest, ClosestPoint};
pub use error::Error;
pub use exact::{DistanceField, Sweep};
pub use finder::{PathFinder, Start};
pub use glam;
pub use loops::{DirectedLoop, GeodesicLoop, LoopFinder};
#[cfg(feature = "triangulate")]
pub use mesh::triangulate_domain;
pub use mesh::{
    FLAT_ANGLE, Mesh, NONE, RepairReport, Repaired, Star, TriangleSoup, VertexKind, face_of, next,
    previous,
};
pub use path::{CERTIFIED_ANGLE, CERTIFIED_STRAIGHTNESS, Certificate, GeodesicPath, Pivot};
pub use pivot::Update;
pub use straightest::{AtBoundary, Stop, Straightest, Trace};
pub use strip::Side;
pub use surface_point::{OUTSIDE, SNAP, SurfacePoint};
pub use torus::TorusClasses;
pub use unfold::Unfolding;
