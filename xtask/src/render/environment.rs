//! The studio: a soft key light, a sky around it, panels that shine in glazed surfaces, a backdrop.

use glam::{Vec3A, vec3a};

use super::camera::Camera;
use super::scene::Scene;

/// Light that a surface facing the key light sends on if it is white: most of the picture's brightness.
pub(super) const KEY: Vec3A = vec3a(0.86, 0.835, 0.79);
/// Sine of the key light's angular radius: the softness of shadows.
const KEY_RADIUS: f32 = 0.16;
/// Colours of the sky: around the horizon, overhead, and what the ground sends back.
const HORIZON: Vec3A = vec3a(0.37, 0.39, 0.42);
const ZENITH: Vec3A = vec3a(0.40, 0.45, 0.53);
const NADIR: Vec3A = vec3a(0.30, 0.29, 0.28);
/// The backdrop at the level of the eye and overhead, and the ground that runs into it.
const BACKDROP: Vec3A = vec3a(0.80, 0.83, 0.87);
const BACKDROP_TOP: Vec3A = vec3a(0.66, 0.72, 0.80);
const BACKDROP_FLOOR: Vec3A = vec3a(0.86, 0.87, 0.885);

/// Directions and colours of all light.
#[derive(Clone, Debug)]
pub(super) struct Studio {
    /// Towards the key light, and two directions across.
    key: [Vec3A; 3],
    /// Middles of the panels with their radiance.
    panels: [(Vec3A, f32, f32); 2],
    pub(super) ground: Option<Ground>,
}

/// The plane that takes shadows, in the unit ball's coordinates: the ground, or a wall.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground {
    /// Unit, towards the scene.
    pub(super) normal: Vec3A,
    /// Of the plane from the origin, along the normal.
    pub(super) offset: f32,
}

impl Studio {
    /// The studio set up around a camera.
    pub(super) fn new(scene: &Scene, camera: &Camera) -> Self {
        let [right, up, forward] = camera.axes().map(|axis| axis.as_vec3a());
        let behind = vec3a(-forward.x, -forward.y, 0.0).normalize_or(up);
        let default = (Vec3A::Z * 1.0 - right * 0.72 + behind * 0.62).normalize();
        let key = scene
            .light
            .map_or(default, |direction| direction.as_vec3a());
        let across = key.any_orthonormal_vector();
        let (centre, unit) = scene.frame();
        Self {
            key: [key, across, key.cross(across)],
            panels: [
                (
                    (Vec3A::Z * 0.75 - right * 0.9 + behind * 0.25).normalize(),
                    0.86,
                    2.6,
                ),
                (
                    (Vec3A::Z * 0.25 + right * 0.95 - behind * 0.2).normalize(),
                    0.93,
                    1.5,
                ),
            ],
            ground: scene.ground.map(|(normal, offset)| Ground {
                normal: normal.as_vec3a(),
                offset: ((offset - centre.dot(normal)) / unit) as f32,
            }),
        }
    }

    /// Towards the middle of the key light.
    pub(super) const fn key(&self) -> Vec3A {
        self.key[0]
    }

    /// A direction towards the key light's disc.
    pub(super) fn key_sample(&self, [u, v]: [f32; 2]) -> Vec3A {
        let radius = KEY_RADIUS * u.sqrt();
        let (sin, cos) = (std::f32::consts::TAU * v).sin_cos();
        let [key, across, along] = self.key;
        (key * (1.0 - radius * radius).sqrt() + across * (radius * cos) + along * (radius * sin))
            .normalize()
    }

    /// What the sky lights a diffuse surface with from `direction`.
    pub(super) fn sky(direction: Vec3A) -> Vec3A {
        let height = direction.z;
        if height >= 0.0 {
            HORIZON.lerp(ZENITH, height.sqrt())
        } else {
            HORIZON.lerp(NADIR, (-height).sqrt())
        }
    }

    /// What a diffuse surface gets from the sky if nothing stands before it: the mean of [`Studio::sky`] over the hemisphere,
    /// weighted by the cosine.
    pub(super) fn open_sky(normal: Vec3A) -> Vec3A {
        // The mean of the square root of the height, over the half of the sky that is seen.
        const FLAT: f32 = 0.8;
        const UPRIGHT: f32 = 0.61;
        let flat = HORIZON.lerp(ZENITH, FLAT);
        let upright = 0.5 * (HORIZON.lerp(ZENITH, UPRIGHT) + HORIZON.lerp(NADIR, UPRIGHT));
        upright.lerp(flat, normal.z.clamp(0.0, 1.0))
    }

    /// What a glazed surface mirrors from `direction`.
    pub(super) fn mirrored(&self, direction: Vec3A) -> Vec3A {
        let panel = |(middle, edge, radiance): (Vec3A, f32, f32)| {
            let inside = smoothstep(edge, edge + 0.05, direction.dot(middle));
            Vec3A::splat(radiance * inside)
        };
        // A soft horizon: a sharp one would draw a line that is not on the surface.
        let above = Self::sky(direction) * 1.7;
        let floor = (BACKDROP_FLOOR * 0.6).lerp(above, smoothstep(-0.25, 0.15, direction.z));
        self.panels
            .iter()
            .fold(floor, |light, &shape| light + panel(shape))
    }

    /// What the camera sees where nothing is, or where the ground is unshaded.
    pub(super) fn backdrop(direction: Vec3A) -> Vec3A {
        let height = direction.z;
        if height >= 0.0 {
            BACKDROP.lerp(BACKDROP_TOP, smoothstep(0.0, 0.55, height))
        } else {
            BACKDROP.lerp(BACKDROP_FLOOR, smoothstep(0.0, 0.5, -height))
        }
    }
}

/// Zero below `low`, one above `high`, smooth between.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
