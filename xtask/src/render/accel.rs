//! Rays against many triangles: a binary BVH (obvhs) over triangles stored in the order of its leaves.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2_from_tris;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

use super::material::Finish;
use super::scene::Object;

/// How far outside a triangle's edge a ray may pass and still hit, in barycentric coordinates. Two
/// triangles reckon their common edge with different roundings; without it pinholes open there.
const EDGE_SLACK: f32 = 1e-6;

/// A triangle ready for intersection: a vertex, two edges, and their product.
#[derive(Clone, Copy, Debug)]
struct Facet {
    corner: Vec3A,
    edge1: Vec3A,
    edge2: Vec3A,
    normal: Vec3A,
}

impl Facet {
    fn new(triangle: &Triangle) -> Self {
        let (edge1, edge2) = (triangle.v0 - triangle.v1, triangle.v2 - triangle.v0);
        Self {
            corner: triangle.v0,
            edge1,
            edge2,
            normal: edge1.cross(edge2),
        }
    }

    /// Barycentric coordinates of the second and third vertex, and the distance along the ray (Möller and
    /// Trumbore, with the normal kept).
    #[inline(always)]
    fn meet(&self, origin: Vec3A, direction: Vec3A) -> (f32, f32, f32) {
        let to_corner = self.corner - origin;
        let moment = direction.cross(to_corner);
        let inverse = 1.0 / self.normal.dot(direction);
        let second = moment.dot(self.edge2) * inverse;
        let third = moment.dot(self.edge1) * inverse;
        (second, third, self.normal.dot(to_corner) * inverse)
    }

    #[inline(always)]
    fn distance(&self, ray: &Ray) -> f32 {
        let (second, third, distance) = self.meet(ray.origin, ray.direction);
        // Written so that NaN (a ray in the triangle's plane) is a miss.
        let inside =
            second >= -EDGE_SLACK && third >= -EDGE_SLACK && second + third <= 1.0 + EDGE_SLACK;
        if inside && distance >= ray.tmin && distance <= ray.tmax {
            distance
        } else {
            f32::INFINITY
        }
    }
}

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

/// A scene's triangles in the unit ball around the origin, under a BVH.
#[derive(Clone)]
pub struct Accel {
    bvh: Bvh2,
    facets: Vec<Facet>,
    /// Object and triangle of every facet.
    sources: Vec<[u32; 2]>,
    /// Whether light passes the facet.
    clear: Vec<bool>,
    centre: DVec3,
    unit: f64,
}

impl std::fmt::Debug for Accel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Accel")
            .field("triangles", &self.facets.len())
            .finish_non_exhaustive()
    }
}

impl Accel {
    pub(super) fn new(objects: &[Object], (centre, unit): (DVec3, f64)) -> Self {
        let local = |p: DVec3| ((p - centre) / unit).as_vec3a();
        let mut triangles = Vec::new();
        let mut origins = Vec::new();
        for (number, object) in objects.iter().enumerate() {
            let positions: Vec<Vec3A> = object.mesh.positions.iter().map(|&p| local(p)).collect();
            for (triangle, corners) in object.mesh.triangles.iter().enumerate() {
                let [v0, v1, v2] = corners.map(|i| positions[i as usize]);
                triangles.push(Triangle { v0, v1, v2 });
                origins.push([number as u32, triangle as u32]);
            }
        }
        let bvh = if triangles.is_empty() {
            Bvh2::default()
        } else {
            build_bvh2_from_tris(
                &triangles,
                BvhBuildParams::medium_build(),
                &mut Duration::default(),
            )
        };
        // The order of the leaves, so that traversal needs no look-up.
        let facets = bvh
            .primitive_indices
            .iter()
            .map(|&slot| Facet::new(&triangles[slot as usize]))
            .collect();
        let sources: Vec<[u32; 2]> = bvh
            .primitive_indices
            .iter()
            .map(|&slot| origins[slot as usize])
            .collect();
        let is_clear = |object: u32| objects[object as usize].material.finish == Finish::Glass;
        let clear = if objects
            .iter()
            .any(|object| object.material.finish == Finish::Glass)
        {
            sources
                .iter()
                .map(|&[object, _]| is_clear(object))
                .collect()
        } else {
            Vec::new()
        };
        Self {
            bvh,
            facets,
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
        let ray = Ray::new(origin, direction, nearest, f32::INFINITY);
        let mut found = RayHit::none();
        if !self
            .bvh
            .ray_traverse(ray, &mut found, |ray, slot| self.facets[slot].distance(ray))
        {
            return None;
        }
        let slot = found.primitive_id as usize;
        let facet = &self.facets[slot];
        let (second, third, distance) = facet.meet(origin, direction);
        let [object, triangle] = self.sources[slot];
        Some(Hit {
            distance,
            object,
            triangle,
            weights: [1.0 - second - third, second, third],
            plane: -facet.normal.normalize_or_zero(),
        })
    }

    /// Whether nothing is on a ray up to the distance `farthest`; clear surfaces let light pass.
    #[must_use]
    pub fn is_free(&self, origin: Vec3A, direction: Vec3A, farthest: f32) -> bool {
        let ray = Ray::new(origin, direction, 0.0, farthest);
        if self.clear.is_empty() {
            self.bvh
                .ray_traverse_miss(ray, |ray, slot| self.facets[slot].distance(ray))
        } else {
            self.bvh.ray_traverse_miss(ray, |ray, slot| {
                if self.clear[slot] {
                    f32::INFINITY
                } else {
                    self.facets[slot].distance(ray)
                }
            })
        }
    }

    /// How much light passes the clear surfaces along a ray that meets nothing else.
    pub(super) fn clearness(&self, origin: Vec3A, direction: Vec3A) -> f32 {
        /// Part of the light that one clear surface lets through.
        const PASSED: f32 = 0.82;
        if self.clear.is_empty() {
            return 1.0;
        }
        let mut light = 1.0;
        let ray = Ray::new(origin, direction, 0.0, f32::INFINITY);
        self.bvh.ray_traverse_anyhit(ray, |ray, slot| {
            if self.clear[slot] && self.facets[slot].distance(ray).is_finite() {
                light *= PASSED;
            }
        });
        light
    }
}
