//! The light that comes back along a ray.

use std::f32::consts::{PI, TAU};

use glam::{Vec3, Vec3A};

use super::accel::{Accel, Hit};
use super::environment::{KEY, Studio, smoothstep};
use super::material::Finish;
use super::picture::{Behind, Seen};
use super::sampler::Sampler;
use super::scene::Scene;
use super::surface::{Surface, Vertices, reflect};

/// Distance by which rays start off a surface, in the unit ball's coordinates: some hundred roundings.
const OFFSET: f32 = 3e-5;
/// Clear shells that one ray may pass.
const MOST_SHELLS: usize = 16;
/// Share of light that a clear coat mirrors head on: that of glass and glaze in air.
const HEAD_ON: f32 = 0.04;

/// The light along one ray: all of it, and the diffuse part taken apart, whose noise the denoiser may
/// smooth without touching colours and mirror images.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sample {
    pub(super) color: Vec3A,
    /// Share of diffuse light that surfaces on the ray send to the eye.
    pub(super) albedo: Vec3A,
    /// What of it they do send.
    pub(super) diffuse: Vec3A,
}

impl Sample {
    fn add(&mut self, passed: Vec3A, albedo: Vec3A, lighting: Vec3A, mirrored: Vec3A) {
        let diffuse = passed * albedo * lighting;
        self.color += diffuse + passed * mirrored;
        self.albedo += passed * albedo;
        self.diffuse += diffuse;
    }
}

/// Everything that a ray may ask.
pub(super) struct Shader<'a> {
    accel: &'a Accel,
    studio: &'a Studio,
    objects: Vec<Vertices>,
}

impl<'a> Shader<'a> {
    pub(super) fn new(scene: &Scene, accel: &'a Accel, studio: &'a Studio) -> Self {
        Self {
            accel,
            studio,
            objects: scene
                .objects
                .iter()
                .map(|object| Vertices::new(object, accel))
                .collect(),
        }
    }

    /// What is seen in the middle of a pixel, in `direction`.
    pub(super) fn seen(&self, eye: Vec3A, direction: Vec3A, forward: Vec3A, unit: f64) -> Seen {
        let ground = self.ground_distance(eye, direction);
        let depth = |distance: f32| (f64::from(distance * direction.dot(forward)) * unit) as f32;
        match self.accel.trace(eye, direction, 0.0) {
            Some(hit) if ground.is_none_or(|distance| hit.distance <= distance) => {
                let object = &self.objects[hit.object as usize];
                let normal = object.facing_normal(&hit, direction);
                let is_clear = object.material.finish == Finish::Glass;
                Seen {
                    depth: depth(hit.distance),
                    normal,
                    id: hit.object + 1,
                    scalar: object.scalar(&hit).unwrap_or(0.0),
                    point: eye + direction * hit.distance,
                    paint: object.color(&hit, normal, direction),
                    behind: is_clear.then(|| self.behind(eye, direction, &hit)),
                }
            }
            _ => Seen {
                depth: ground.map_or(Seen::FAR, depth),
                normal: self.ground_normal(ground),
                id: 0,
                scalar: 0.0,
                point: ground.map_or(Vec3A::ZERO, |distance| eye + direction * distance),
                paint: Vec3A::ZERO,
                behind: None,
            },
        }
    }

    /// What is seen through the clear shell that a ray meets first.
    fn behind(&self, eye: Vec3A, direction: Vec3A, first: &Hit) -> Behind {
        let ground = self.ground_distance(eye, direction);
        let mut passed = first.object + 1;
        let mut nearest = first.distance + OFFSET;
        for _ in 1..MOST_SHELLS {
            let hit = self.accel.trace(eye, direction, nearest);
            let Some(hit) = hit.filter(|hit| ground.is_none_or(|far| hit.distance <= far)) else {
                break;
            };
            let object = &self.objects[hit.object as usize];
            passed = passed.wrapping_mul(31).wrapping_add(hit.object + 1);
            if object.material.finish != Finish::Glass {
                let normal = object.facing_normal(&hit, direction);
                return Behind {
                    passed,
                    point: (eye + direction * hit.distance).into(),
                    normal: normal.into(),
                    paint: object.color(&hit, normal, direction).into(),
                };
            }
            nearest = hit.distance + OFFSET;
        }
        let point = ground.map_or(Vec3A::ZERO, |distance| eye + direction * distance);
        Behind {
            passed: passed.wrapping_mul(31),
            point: point.into(),
            normal: self.ground_normal(ground).into(),
            paint: Vec3::ZERO,
        }
    }

    /// The ground's normal where a ray meets it, none where it does not.
    fn ground_normal(&self, distance: Option<f32>) -> Vec3A {
        let ground = distance.and(self.studio.ground);
        ground.map_or(Vec3A::ZERO, |ground| ground.normal)
    }

    /// Light along a ray from the eye.
    pub(super) fn radiance(&self, eye: Vec3A, direction: Vec3A, sampler: &mut Sampler) -> Sample {
        let mut sample = Sample::default();
        let mut passed = Vec3A::ONE;
        let mut nearest = 0.0;
        for shell in 0..MOST_SHELLS {
            let ground = self.ground_distance(eye, direction);
            let hit = self.accel.trace(eye, direction, nearest);
            let hit = hit.filter(|hit| ground.is_none_or(|distance| hit.distance <= distance));
            let Some(hit) = hit else {
                let lighting =
                    ground
                        .zip(self.studio.ground)
                        .map_or(Vec3A::ONE, |(distance, ground)| {
                            self.ground_lighting(eye + direction * distance, ground.normal, sampler)
                        });
                sample.add(passed, Studio::backdrop(direction), lighting, Vec3A::ZERO);
                return sample;
            };
            let surface = self.surface(eye, direction, &hit);
            let is_behind = shell > 0 && surface.finish == Finish::Glass;
            let (albedo, lighting, mirrored) = if is_behind {
                self.dim_shade(&surface, direction, sampler)
            } else {
                self.shade(&surface, direction, sampler)
            };
            if surface.finish != Finish::Glass {
                sample.add(passed, albedo, lighting, mirrored);
                return sample;
            }
            // A thin shell: the longer the way through it, the less passes.
            let facing = surface.normal.dot(-direction).clamp(0.02, 1.0);
            let opacity = (1.0 - (1.0 - 0.22_f32).powf(1.0 / facing)).max(fresnel(facing));
            sample.add(passed * opacity, albedo, lighting, mirrored);
            let tint = Vec3A::ONE.lerp(surface.color, 0.35);
            passed *= tint * (1.0 - opacity);
            nearest = hit.distance + OFFSET;
        }
        sample
    }

    fn ground_distance(&self, eye: Vec3A, direction: Vec3A) -> Option<f32> {
        let ground = self.studio.ground?;
        let (height, slope) = (
            eye.dot(ground.normal) - ground.offset,
            direction.dot(ground.normal),
        );
        let distance = -height / slope;
        (height > 0.0 && slope < 0.0 && distance.is_finite()).then_some(distance)
    }

    /// How much light the ground gets, over what it would get if nothing stood on it.
    fn ground_lighting(&self, point: Vec3A, normal: Vec3A, sampler: &mut Sampler) -> Vec3A {
        let start = point + normal * OFFSET;
        let key = KEY * self.studio.key().dot(normal).max(0.1);
        let got =
            key * self.key_visibility(start, normal, sampler) + self.sky(start, normal, sampler);
        (got / (key + Studio::open_sky(normal))).min(Vec3A::ONE)
    }

    fn key_visibility(&self, start: Vec3A, normal: Vec3A, sampler: &mut Sampler) -> f32 {
        let towards = self.studio.key_sample(sampler.pair());
        if towards.dot(normal) > 0.0 {
            self.accel.light(start, towards)
        } else {
            0.0
        }
    }

    /// Light from one direction of the hemisphere: the sky, or the surface that hides it.
    fn sky(&self, start: Vec3A, normal: Vec3A, sampler: &mut Sampler) -> Vec3A {
        let direction = cosine_sample(normal, sampler.pair());
        match self.accel.trace(start, direction, 0.0) {
            None => Studio::sky(direction),
            Some(hit) => {
                let surface = self.surface(start, direction, &hit);
                let clear = if surface.finish == Finish::Glass {
                    0.6
                } else {
                    0.0
                };
                self.rough_shade(&surface)
                    .lerp(Studio::sky(direction), clear)
            }
        }
    }

    /// The shade of a surface that is seen only by reflection: no shadows.
    fn rough_shade(&self, surface: &Surface) -> Vec3A {
        let key = KEY * surface.normal.dot(self.studio.key()).max(0.0) * 0.6;
        surface.color * (key + Studio::sky(surface.normal) * 0.6)
    }

    /// The share of diffuse light that a surface sends on, that light, and what is mirrored.
    fn shade(
        &self,
        surface: &Surface,
        direction: Vec3A,
        sampler: &mut Sampler,
    ) -> (Vec3A, Vec3A, Vec3A) {
        let (lighting, visible) = self.lighting(surface, sampler);
        if surface.finish == Finish::Matte {
            return (surface.color, lighting, Vec3A::ZERO);
        }
        let towards_eye = -direction;
        let share = fresnel(surface.normal.dot(towards_eye).clamp(0.0, 1.0));
        let glint = glint(surface.normal, towards_eye, self.studio.key()) * visible;
        let mirrored = self.mirrored(surface, direction) * share + KEY * glint;
        (surface.color * (1.0 - share), lighting, mirrored)
    }

    /// The shade of a clear shell behind another: every other ray is lit, for two, and nothing but the studio is mirrored.
    fn dim_shade(
        &self,
        surface: &Surface,
        direction: Vec3A,
        sampler: &mut Sampler,
    ) -> (Vec3A, Vec3A, Vec3A) {
        let [choice, _] = sampler.pair();
        let lighting = if choice < 0.5 {
            2.0 * self.lighting(surface, sampler).0
        } else {
            Vec3A::ZERO
        };
        let share = fresnel(surface.normal.dot(-direction).clamp(0.0, 1.0));
        let mirror = reflect(direction, surface.normal);
        (
            surface.color * (1.0 - share),
            lighting,
            self.studio.mirrored(mirror) * share,
        )
    }

    /// The light that falls on a surface, and the part of the key light that is seen from there.
    fn lighting(&self, surface: &Surface, sampler: &mut Sampler) -> (Vec3A, f32) {
        let facing = surface.normal.dot(self.studio.key());
        let visible = if facing > 0.0 {
            self.key_visibility(surface.start, surface.plane, sampler)
        } else {
            0.0
        };
        let key = KEY * (facing.max(0.0) * visible);
        (
            key + self.sky(surface.start, surface.normal, sampler),
            visible,
        )
    }

    /// What a clear coat mirrors: the studio, or another surface.
    fn mirrored(&self, surface: &Surface, direction: Vec3A) -> Vec3A {
        let mirror = reflect(direction, surface.normal);
        if mirror.dot(surface.plane) <= 0.0 {
            return Studio::sky(mirror);
        }
        match self.accel.trace(surface.start, mirror, 0.0) {
            Some(hit) => self.rough_shade(&self.surface(surface.start, mirror, &hit)),
            None => self.studio.mirrored(mirror),
        }
    }

    fn surface(&self, origin: Vec3A, direction: Vec3A, hit: &Hit) -> Surface {
        let object = &self.objects[hit.object as usize];
        let point = origin + direction * hit.distance;
        let mut normal = object.normal(hit);
        let mut plane = hit.plane;
        let behind = plane.dot(direction) > 0.0;
        if behind {
            plane = -plane;
        }
        if normal.dot(plane) < 0.0 {
            normal = -normal;
        }
        let start = object.smooth_point(hit, point, behind) + plane * OFFSET;
        let color = object.color(hit, normal, direction);
        Surface {
            point,
            normal,
            plane,
            start,
            color,
            finish: object.material.finish,
        }
        .facing(direction)
    }
}

/// Schlick's approximation of the share of light that a clear coat mirrors.
fn fresnel(facing: f32) -> f32 {
    HEAD_ON + (1.0 - HEAD_ON) * (1.0 - facing).powi(5)
}

/// The key light mirrored by a coat of some roughness (the distribution of Trowbridge and Reitz).
fn glint(normal: Vec3A, towards_eye: Vec3A, key: Vec3A) -> f32 {
    const ROUGHNESS: f32 = 0.17;
    let half = (towards_eye + key).normalize_or(normal);
    let (cosine, square) = (normal.dot(half).max(0.0), ROUGHNESS * ROUGHNESS);
    let spread = cosine * cosine * (square - 1.0) + 1.0;
    let distribution = square / (PI * spread * spread);
    let grazing = normal.dot(key).max(0.0);
    fresnel(half.dot(key).clamp(0.0, 1.0))
        * distribution
        * PI
        * 0.25
        * smoothstep(0.0, 0.2, grazing)
}

/// A direction of the hemisphere, likelier near the normal by the cosine.
fn cosine_sample(normal: Vec3A, [u, v]: [f32; 2]) -> Vec3A {
    let (radius, (sin, cos)) = (u.sqrt(), (TAU * v).sin_cos());
    let across = normal.any_orthonormal_vector();
    let along = normal.cross(across);
    (across * (radius * cos) + along * (radius * sin) + normal * (1.0 - u).max(0.0).sqrt())
        .normalize()
}
