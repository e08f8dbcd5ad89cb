//! Files that other programs open.
//!
//! | file | holds | opens in |
//! |---|---|---|
//! | [`obj`](fn@obj) | triangles with normals, full `f64` digits | every mesh program |
//! | [`gltf`](fn@gltf) | triangles with normals and colours, `f32` | viewers, browsers, Blender |
//! | [`Step`] | exact rational B-spline surfaces with their boundary curves | CAD |
//!
//! Plane drawings become SVG by [`Figure::svg`](crate::figure::Figure::svg).

mod gltf;
mod obj;
mod step;

pub use gltf::gltf;
pub use obj::obj;
pub use step::Step;

use crate::color::Color;
use crate::mesh::Mesh;

/// A mesh under a name, in a colour where the format has colours.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// The name that other programs show.
    pub name: &'a str,
    /// The triangles.
    pub mesh: &'a Mesh,
    /// The colour.
    pub color: Color,
}

impl<'a> Part<'a> {
    /// A mesh under a name.
    #[must_use]
    pub const fn new(name: &'a str, mesh: &'a Mesh, color: Color) -> Self {
        Self { name, mesh, color }
    }
}

#[cfg(test)]
mod tests;
