//! A small ray tracer: triangle meshes, one soft key light under a sky, and materials that make
//! curvature legible.
//!
//! ```text
//!   Mesh + Material ─> Scene ─> BVH ─> rays per pixel ─> Picture ─> EXR (linear, with layers)
//!                       Camera ┘                               └──> PNG (tone-mapped)
//! ```
//!
//! Geometry comes in as `f64` and is moved to the unit ball around the origin before it becomes
//! `f32`, so that a model's size and place do not matter. Every pixel has its own sequence of
//! random numbers: a picture depends on the seed and not on the number of threads.
//!
//! ```
//! use glam::DVec3;
//! use xtask::color::{BLUE, GREY};
//! use xtask::mesh::Mesh;
//! use xtask::render::{Material, Options, Scene, render};
//!
//! let mut scene = Scene::new();
//! scene.add(Mesh::sphere(DVec3::ZERO, 1.0, 1e-3), Material::glossy(BLUE))?;
//! scene.ground(-1.0);
//! let camera = scene.camera(DVec3::new(1.0, -2.0, 0.8), 4.0 / 3.0);
//! let picture = render(&scene, &camera, Options { width: 32, height: 24, samples: 4, seed: 1 }, |_| ());
//! assert_eq!(picture.image().width(), 32);
//! # Ok::<(), anyhow::Error>(())
//! ```

mod accel;
mod camera;
mod environment;
mod exr;
mod material;
mod picture;
mod sampler;
mod scene;
mod shade;
mod wide;

pub use accel::{Accel, Hit};
pub use camera::Camera;
pub use material::{Finish, Material, Paint};
pub use picture::Picture;
pub use scene::Scene;

use glam::{Vec3A, vec3a};
use rayon::prelude::*;

use environment::Studio;
use picture::Pixel;
use sampler::Sampler;
use shade::Shader;

/// Size and quality of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Most rays through a pixel. Pixels whose colour has settled get fewer.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Rays through a pixel before it is asked whether it has settled.
const FIRST_SAMPLES: u32 = 8;
/// A pixel has settled when the standard error of its brightness, as displayed, is below this: one
/// step of an 8-bit picture.
const SETTLED: f32 = 1.0 / 255.0;

/// Renders a scene on all cores. `row_done` is called once per finished row, from any thread.
#[must_use]
pub fn render(
    scene: &Scene,
    camera: &Camera,
    options: Options,
    row_done: impl Fn(u32) + Sync,
) -> Picture {
    let accel = scene.accel();
    let studio = Studio::new(scene, camera);
    let shader = Shader::new(scene, &accel, &studio);
    let view = View::new(camera, &accel, options);
    let rows: Vec<Vec<Pixel>> = (0..options.height)
        .into_par_iter()
        .map(|y| {
            let row = (0..options.width)
                .map(|x| pixel(&shader, &view, x, y))
                .collect();
            row_done(y);
            row
        })
        .collect();
    let layer = scene.layer_name().map(str::to_owned);
    Picture::new(
        options.width,
        options.height,
        rows.into_iter().flatten().collect(),
        layer,
    )
}

/// The camera in the unit ball's coordinates and `f32`.
struct View {
    eye: Vec3A,
    forward: Vec3A,
    /// The steps from pixel to pixel on the image plane at distance one.
    right: Vec3A,
    down: Vec3A,
    unit: f64,
    options: Options,
}

impl View {
    fn new(camera: &Camera, accel: &Accel, options: Options) -> Self {
        let [right, up, forward] = camera.axes();
        let step = 2.0 * camera.half_height() / f64::from(options.height);
        Self {
            eye: accel.local(camera.eye()),
            forward: forward.as_vec3a(),
            right: (right * step).as_vec3a(),
            down: (-up * step).as_vec3a(),
            unit: accel.unit(),
            options,
        }
    }

    /// Unit direction through the point `(x, y)` of the picture, in pixels.
    fn direction(&self, x: f32, y: f32) -> Vec3A {
        let (width, height) = (self.options.width as f32, self.options.height as f32);
        (self.forward + self.right * (x - 0.5 * width) + self.down * (y - 0.5 * height)).normalize()
    }
}

fn pixel(shader: &Shader<'_>, view: &View, x: u32, y: u32) -> Pixel {
    let number = u64::from(y) * u64::from(view.options.width) + u64::from(x);
    let (centre_x, centre_y) = (x as f32 + 0.5, y as f32 + 0.5);
    let centre = view.direction(centre_x, centre_y);
    let mut pixel = shader.first_hit(view.eye, centre, view.forward, view.unit);
    let samples = view.options.samples.max(1);
    let (mut sum, mut mean, mut spread) = (Vec3A::ZERO, 0.0_f32, 0.0_f32);
    let mut count = 0;
    for index in 0..samples {
        let mut sampler = Sampler::new(view.options.seed, number, index);
        let [u, v] = sampler.pair();
        let jitter = if samples == 1 {
            [0.0; 2]
        } else {
            [tent(u), tent(v)]
        };
        let direction = view.direction(centre_x + jitter[0], centre_y + jitter[1]);
        let color = shader.radiance(view.eye, direction, &mut sampler);
        sum += color;
        count += 1;
        // Welford's running variance of the displayed brightness.
        let shown = color
            .dot(vec3a(0.2126, 0.7152, 0.0722))
            .clamp(0.0, 1.5)
            .sqrt();
        let off = shown - mean;
        mean += off / count as f32;
        spread += off * (shown - mean);
        if count >= FIRST_SAMPLES && count % 4 == 0 {
            let variance = spread / (count - 1) as f32 / count as f32;
            if variance < SETTLED * SETTLED {
                break;
            }
        }
    }
    let color = sum / count as f32;
    pixel.color = [color.x, color.y, color.z, 1.0];
    pixel
}

/// A tent of width two pixels: neighbouring pixels share their edge, as a good filter asks.
fn tent(u: f32) -> f32 {
    if u < 0.5 {
        (2.0 * u).sqrt() - 1.0
    } else {
        1.0 - (2.0 - 2.0 * u).sqrt()
    }
}

#[cfg(test)]
mod tests;
