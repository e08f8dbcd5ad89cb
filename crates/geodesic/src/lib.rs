//! Shortest and straightest paths on triangle meshes and smooth surfaces, exact where asked and certified always

mod error;
mod mesh;
pub mod shapes;
mod surface_point;

pub use error::Error;
pub use glam;
#[cfg(feature = "triangulate")]
pub use mesh::triangulate_domain;
pub use mesh::{
    FLAT_ANGLE, Mesh, NONE, RepairReport, Repaired, Star, TriangleSoup, VertexKind, face_of, next,
    previous,
};
pub use surface_point::{OUTSIDE, SNAP, SurfacePoint};
