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
mod denoise;
mod environment;
mod exr;
mod material;
mod picture;
mod sampler;
mod scene;
mod shade;
mod surface;
mod wide;

pub use accel::{Accel, Hit};
pub use camera::Camera;
pub use material::{Finish, Material, Paint};
pub use picture::Picture;
pub use scene::Scene;

use glam::Vec3A;
use rayon::prelude::*;

use denoise::{Frame, Mean, denoise};
use environment::Studio;
use picture::Seen;
use sampler::Sampler;
use shade::{Sample, Shader};

/// Size and quality of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Rays through a pixel on an edge. Pixels inside a surface get a quarter of them, and their light
    /// is smoothed.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Pixels inside a surface get one ray for so many of an edge pixel.
const INSIDE: u32 = 4;
/// Surfaces darker than this have no lighting to speak of.
const DARK: f32 = 1e-4;

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
    let (width, height) = (options.width, options.height);
    let rows = || (0..height).into_par_iter();
    let seen: Vec<Seen> = rows()
        .flat_map_iter(|y| {
            let (shader, view) = (&shader, &view);
            (0..width)
                .map(move |x| shader.seen(view.eye, view.through(x, y), view.forward, view.unit))
        })
        .collect();
    let frame = Frame::new(width, height, &seen);
    let samples: Vec<Mean> = rows()
        .flat_map_iter(|y| {
            let row: Vec<Mean> = (0..width)
                .map(|x| pixel(&shader, &view, &frame, x, y))
                .collect();
            row_done(y);
            row
        })
        .collect();
    let colors = denoise(&frame, &samples);
    Picture::new(
        [width, height],
        colors,
        seen,
        scene.layer_name().map(str::to_owned),
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

    /// Unit direction through the middle of a pixel.
    fn through(&self, x: u32, y: u32) -> Vec3A {
        self.direction(x as f32 + 0.5, y as f32 + 0.5)
    }

    /// Unit direction through the point `(x, y)` of the picture, in pixels.
    fn direction(&self, x: f32, y: f32) -> Vec3A {
        let (width, height) = (self.options.width as f32, self.options.height as f32);
        (self.forward + self.right * (x - 0.5 * width) + self.down * (y - 0.5 * height)).normalize()
    }
}

/// The mean of the light through a pixel.
fn pixel(shader: &Shader<'_>, view: &View, frame: &Frame<'_>, x: u32, y: u32) -> Mean {
    let options = view.options;
    let number = u64::from(y) * u64::from(options.width) + u64::from(x);
    let is_edge = frame.is_edge(x, y);
    let count = if is_edge {
        options.samples
    } else {
        options.samples / INSIDE
    }
    .max(1);
    let mut sum = Sample::default();
    for index in 0..count {
        let mut sampler = Sampler::new(options.seed, number, index);
        let [u, v] = sampler.pair();
        // A single ray goes through the middle.
        let [right, down] = if count == 1 {
            [0.5; 2]
        } else {
            [0.5 + tent(u), 0.5 + tent(v)]
        };
        let direction = view.direction(x as f32 + right, y as f32 + down);
        let sample = shader.radiance(view.eye, direction, &mut sampler);
        sum.color += sample.color;
        sum.albedo += sample.albedo;
        sum.diffuse += sample.diffuse;
    }
    let share = 1.0 / count as f32;
    Mean {
        color: sum.color * share,
        albedo: sum.albedo * share,
        lighting: sum.diffuse / sum.albedo.max(Vec3A::splat(DARK)),
        is_edge,
    }
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
