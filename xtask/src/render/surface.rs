//! The places of surfaces that rays meet, with their normals and paint.

use glam::{Vec3A, vec3a};

use super::accel::{Accel, Hit};
use super::environment::smoothstep;
use super::material::{Finish, Material, Paint};
use super::scene::Object;
use crate::color::Color;

/// Half the width of an isoline, in the unit ball's coordinates.
const LINE: f32 = 0.0028;

/// A surface point as the shader sees it.
pub(super) struct Surface {
    pub(super) point: Vec3A,
    /// Shading normal on the viewer's side.
    pub(super) normal: Vec3A,
    /// The triangle's own normal on the viewer's side.
    pub(super) plane: Vec3A,
    /// Where rays towards the light start.
    pub(super) start: Vec3A,
    pub(super) color: Vec3A,
    pub(super) finish: Finish,
}

/// Vertex data of one object in the unit ball's coordinates.
pub(super) struct Vertices {
    pub(super) positions: Vec<Vec3A>,
    pub(super) normals: Vec<Vec3A>,
    pub(super) scalar: Option<Vec<f32>>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) material: Material,
}

impl Surface {
    /// Near the outline an interpolated normal may lean away from the viewer: it is bent back.
    pub(super) fn facing(self, direction: Vec3A) -> Self {
        let away = self.normal.dot(direction);
        debug_assert!(self.point.is_finite());
        if away < 0.0 {
            return self;
        }
        let normal = (self.normal - direction * (away + 0.01)).normalize_or(self.plane);
        Self { normal, ..self }
    }
}

impl Vertices {
    pub(super) fn new(object: &Object, accel: &Accel) -> Self {
        Self {
            positions: object
                .mesh
                .positions
                .iter()
                .map(|&p| accel.local(p))
                .collect(),
            normals: object.mesh.normals.iter().map(|n| n.as_vec3a()).collect(),
            scalar: object
                .mesh
                .scalar
                .as_ref()
                .map(|s| s.iter().map(|&x| x as f32).collect()),
            triangles: object.mesh.triangles.clone(),
            material: object.material,
        }
    }

    fn corners(&self, hit: &Hit) -> [usize; 3] {
        self.triangles[hit.triangle as usize].map(|i| i as usize)
    }

    pub(super) fn normal(&self, hit: &Hit) -> Vec3A {
        let [a, b, c] = self.corners(hit);
        let [u, v, w] = hit.weights;
        (self.normals[a] * u + self.normals[b] * v + self.normals[c] * w).normalize_or(hit.plane)
    }

    /// The normal on the side from which the ray comes.
    pub(super) fn facing_normal(&self, hit: &Hit, direction: Vec3A) -> Vec3A {
        let normal = self.normal(hit);
        if normal.dot(direction) > 0.0 {
            -normal
        } else {
            normal
        }
    }

    pub(super) fn scalar(&self, hit: &Hit) -> Option<f32> {
        let scalar = self.scalar.as_ref()?;
        let [a, b, c] = self.corners(hit);
        let [u, v, w] = hit.weights;
        Some(scalar[a] * u + scalar[b] * v + scalar[c] * w).filter(|x| x.is_finite())
    }

    /// The point lifted from the facet to the surface that the vertex normals describe, so that a
    /// facet does not shade its neighbour where the light grazes (Hanika, *Hacking the shadow
    /// terminator*, Ray Tracing Gems II, 2021).
    pub(super) fn smooth_point(&self, hit: &Hit, point: Vec3A, behind: bool) -> Vec3A {
        let side = if behind { -1.0 } else { 1.0 };
        let lift = |(&corner, weight): (&usize, f32)| {
            let normal = self.normals[corner] * side;
            let below = (point - self.positions[corner]).dot(normal).min(0.0);
            normal * (-below * weight)
        };
        self.corners(hit)
            .iter()
            .zip(hit.weights)
            .map(lift)
            .fold(point, |sum, lift| sum + lift)
    }

    pub(super) fn color(&self, hit: &Hit, normal: Vec3A, direction: Vec3A) -> Vec3A {
        let linear = |color: Color| Vec3A::from_array(color.linear());
        match self.material.paint {
            Paint::Plain(color) => linear(color),
            Paint::Zebra { stripes } => {
                let mirror = reflect(direction, normal);
                let angle = mirror.dot(vec3a(0.36, 0.48, 0.8)).clamp(-1.0, 1.0).acos();
                // The middle of a bull's eye is the middle of a stripe.
                let wave = (angle * stripes).cos();
                Vec3A::splat(0.025).lerp(Vec3A::splat(0.9), smoothstep(-0.08, 0.08, wave))
            }
            Paint::Scalar {
                map,
                low,
                high,
                isolines,
            } => {
                let Some(value) = self.scalar(hit) else {
                    return linear(crate::color::GREY);
                };
                let color = linear(map.at((f64::from(value) - low) / (high - low)));
                let line = isolines.map_or(0.0, |spacing| self.isoline(hit, value, spacing as f32));
                color * (1.0 - 0.85 * line)
            }
        }
    }

    /// One on an isoline, zero off it: the distance to the next multiple of `spacing` is the difference of
    /// the numbers over the length of their gradient in the triangle.
    fn isoline(&self, hit: &Hit, value: f32, spacing: f32) -> f32 {
        let Some(scalar) = &self.scalar else {
            return 0.0;
        };
        let [a, b, c] = self.corners(hit);
        let (e1, e2) = (
            self.positions[b] - self.positions[a],
            self.positions[c] - self.positions[a],
        );
        let (d1, d2) = (scalar[b] - scalar[a], scalar[c] - scalar[a]);
        let normal = e1.cross(e2);
        let gradient = (e2 * d1 - e1 * d2).cross(normal) / normal.length_squared();
        let off = (value - spacing * (value / spacing).round()).abs();
        let distance = off / gradient.length();
        1.0 - smoothstep(
            0.6 * LINE,
            1.2 * LINE,
            if distance.is_nan() { 1.0 } else { distance },
        )
    }
}

pub(super) fn reflect(direction: Vec3A, normal: Vec3A) -> Vec3A {
    direction - normal * (2.0 * direction.dot(normal))
}
