//! What is in the picture.

use anyhow::{Context, Result};
use glam::DVec3;

use super::accel::Accel;
use super::camera::Camera;
use super::material::Material;
use crate::mesh::Mesh;

/// A mesh and what it looks like.
#[derive(Clone, Debug)]
pub(super) struct Object {
    pub(super) mesh: Mesh,
    pub(super) material: Material,
}

/// Meshes with their materials, a ground, and the light.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub(super) objects: Vec<Object>,
    /// Unit normal of the plane that takes shadows, and its offset along it.
    pub(super) ground: Option<(DVec3, f64)>,
    pub(super) light: Option<DVec3>,
    layer: Option<String>,
}

impl Scene {
    /// The empty scene: no ground, the light from the upper left behind the camera.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an object and returns its number in the `id.I` layer; the first object has number 1.
    ///
    /// # Errors
    /// As [`Mesh::check`].
    pub fn add(&mut self, mesh: Mesh, material: Material) -> Result<u32> {
        let id = self.objects.len() as u32 + 1;
        mesh.check()
            .with_context(|| format!("object {id} of the scene"))?;
        self.objects.push(Object { mesh, material });
        Ok(id)
    }

    /// A ground at height `z`, seamless with the backdrop, that takes shadows. Its number is 0.
    pub const fn ground(&mut self, z: f64) -> &mut Self {
        self.ground = Some((DVec3::Z, z));
        self
    }

    /// A ground under everything that has been added so far.
    pub fn ground_below(&mut self) -> &mut Self {
        let lowest = self.points().map(|p| p.z).fold(f64::INFINITY, f64::min);
        self.ground(if lowest.is_finite() { lowest } else { 0.0 })
    }

    /// Instead of a ground, an upright wall behind everything that has been added so far, for things that hang in rows: it
    /// stands across the horizontal part of `towards_eye`, and the last thing but touches it. The light comes more from the
    /// front then, so that a shadow stays with its thing.
    pub fn wall_behind(&mut self, towards_eye: DVec3) -> &mut Self {
        let normal = towards_eye
            .with_z(0.0)
            .try_normalize()
            .unwrap_or(DVec3::NEG_Y);
        let farthest = self
            .points()
            .map(|p| p.dot(normal))
            .fold(f64::INFINITY, f64::min);
        self.ground = farthest.is_finite().then_some((normal, farthest));
        self.light_from(normal + 0.5 * DVec3::Z - 0.35 * DVec3::Z.cross(normal))
    }

    /// The key light, from this direction.
    pub fn light_from(&mut self, direction: DVec3) -> &mut Self {
        self.light = direction.try_normalize();
        self
    }

    /// Writes the vertices' numbers as an EXR layer: `geodesic.D`, `curvature.K`.
    pub fn layer(&mut self, name: &str) -> &mut Self {
        self.layer = Some(name.into());
        self
    }

    /// The name of the layer of the vertices' numbers.
    pub(super) fn layer_name(&self) -> Option<&str> {
        self.layer.as_deref()
    }

    fn points(&self) -> impl Iterator<Item = DVec3> {
        self.objects
            .iter()
            .flat_map(|object| object.mesh.positions.iter().copied())
    }

    /// A camera in the direction `towards_eye` that sees all objects in a picture of width over height
    /// `aspect`.
    #[must_use]
    pub fn camera(&self, towards_eye: DVec3, aspect: f64) -> Camera {
        let points: Vec<DVec3> = self.points().collect();
        Camera::fit(&points, towards_eye, aspect)
    }

    /// Middle and half diagonal of the box around all objects: the unit ball's place in the world.
    pub(super) fn frame(&self) -> (DVec3, f64) {
        let bounds = self
            .objects
            .iter()
            .filter_map(|object| object.mesh.bounds());
        let bounds = bounds.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        let [low, high] = bounds.unwrap_or([DVec3::NEG_ONE, DVec3::ONE]);
        let radius = 0.5 * (high - low).length();
        (0.5 * (low + high), if radius > 0.0 { radius } else { 1.0 })
    }

    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.objects
            .iter()
            .map(|object| object.mesh.triangles.len())
            .sum()
    }

    /// The scene made ready for rays.
    #[must_use]
    pub fn accel(&self) -> Accel {
        Accel::new(&self.objects, self.frame())
    }
}
