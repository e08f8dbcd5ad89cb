//! Rays against a scene: which object, which triangle, where on it.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::triangle::Triangle;

use super::material::Finish;
use super::scene::Object;
use super::wide::Tree;

/// obvhs's preset of middling effort, with leaves of four triangles, as many as the tree holds in one.
const BUILD: BvhBuildParams = BvhBuildParams {
    max_prims_per_leaf: 4,
    ..BvhBuildParams::medium_build()
};

/// What a ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the (unit) direction.
    pub distance: f32,
    /// Index of the object in the scene.
    pub object: u32,
    /// Number of the triangle in the object's mesh.
    pub triangle: u32,
    /// Weights of the triangle's three vertices.
    pub weights: [f32; 3],
    /// Normal of the triangle's plane, unit, to the front.
    pub plane: Vec3A,
}

/// A scene's triangles in the unit ball around the origin, under a hierarchy of boxes.
#[derive(Clone)]
pub struct Accel {
    tree: Tree,
    /// Object, triangle and front normal of every triangle.
    sources: Vec<([u32; 2], Vec3A)>,
    /// Whether light passes the triangle; empty if it passes none.
    clear: Vec<bool>,
    centre: DVec3,
    unit: f64,
}

impl std::fmt::Debug for Accel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Accel")
            .field("triangles", &self.sources.len())
            .finish_non_exhaustive()
    }
}

impl Accel {
    pub(super) fn new(objects: &[Object], (centre, unit): (DVec3, f64)) -> Self {
        let local = |p: DVec3| ((p - centre) / unit).as_vec3a();
        let mut triangles = Vec::new();
        let mut sources = Vec::new();
        for (number, object) in objects.iter().enumerate() {
            let positions: Vec<Vec3A> = object.mesh.positions.iter().map(|&p| local(p)).collect();
            for (triangle, corners) in object.mesh.triangles.iter().enumerate() {
                let [v0, v1, v2] = corners.map(|i| positions[i as usize]);
                let front = (v1 - v0).cross(v2 - v0).normalize_or_zero();
                triangles.push(Triangle { v0, v1, v2 });
                sources.push(([number as u32, triangle as u32], front));
            }
        }
        let binary = if triangles.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2_from_tris(&triangles, BUILD, &mut Duration::default())
        };
        let is_clear = |object: &Object| object.material.finish == Finish::Glass;
        let clear = if objects.iter().any(is_clear) {
            sources
                .iter()
                .map(|([object, _], _)| is_clear(&objects[*object as usize]))
                .collect()
        } else {
            Vec::new()
        };
        Self {
            tree: Tree::new(&binary, &triangles),
            sources,
            clear,
            centre,
            unit,
        }
    }

    /// A point of the world in the unit ball's coordinates.
    #[must_use]
    pub fn local(&self, point: DVec3) -> Vec3A {
        ((point - self.centre) / self.unit).as_vec3a()
    }

    /// The length in world units that is one in the unit ball's coordinates.
    #[must_use]
    pub const fn unit(&self) -> f64 {
        self.unit
    }

    /// The first triangle on a ray with unit direction, beyond the distance `nearest`.
    #[must_use]
    pub fn trace(&self, origin: Vec3A, direction: Vec3A, nearest: f32) -> Option<Hit> {
        let found = self.tree.first(origin, direction, nearest)?;
        let ([object, triangle], plane) = self.sources[found.triangle as usize];
        let [second, third] = found.weights;
        Some(Hit {
            distance: found.distance,
            object,
            triangle,
            weights: [1.0 - second - third, second, third],
            plane,
        })
    }

    /// Whether nothing is on a ray up to the distance `farthest`; clear surfaces let light pass.
    #[must_use]
    pub fn is_free(&self, origin: Vec3A, direction: Vec3A, farthest: f32) -> bool {
        if self.clear.is_empty() {
            !self.tree.any(origin, direction, farthest, |_| true)
        } else {
            !self.tree.any(origin, direction, farthest, |triangle| {
                !self.clear[triangle as usize]
            })
        }
    }

    /// How much of the key light comes along a ray: nothing past an opaque surface, less past clear ones.
    pub(super) fn light(&self, origin: Vec3A, direction: Vec3A) -> f32 {
        /// Part of the light that one clear surface lets through.
        const PASSED: f32 = 0.82;
        let mut light = 1.0;
        let blocked = self.tree.any(origin, direction, f32::INFINITY, |triangle| {
            if self.clear.get(triangle as usize) == Some(&true) {
                light *= PASSED;
                return false;
            }
            true
        });
        if blocked { 0.0 } else { light }
    }
}
