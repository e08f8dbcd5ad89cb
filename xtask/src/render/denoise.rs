//! Few rays, little noise: the diffuse light of a surface is smooth except where the surface has an edge.
//!
//! The light is averaged with that of neighbouring pixels of the same surface, in wider and wider rings
//! (the edge-avoiding wavelets of Dammertz and others, *HPG 2010*, with weights from the local noise as in
//! Schied and others, *HPG 2017*). Colours, stripes, isolines and mirror images are not touched: only
//! the light that falls on the surface is. Pixels on an edge keep their own, for which more rays
//! were spent.

use glam::{Vec3A, vec3a};
use rayon::prelude::*;

use super::picture::{Behind, Seen};

/// Rings of neighbours: the last one is this power of two pixels wide.
const RINGS: u32 = 5;
/// Neighbours count less as their light differs by more than this multiple of the local noise.
const NOISE: f32 = 4.0;
/// Variance left by a ring. Independent pixels would leave a sixth; neighbours that share what they
/// have averaged leave more, and claiming less stops the later rings: clouds in soft shadows.
const LEFT: f32 = 0.45;
/// A change of paint that makes an edge, in linear light.
const PAINT_EDGE: f32 = 0.04;
/// The cosine between normals below which there is an edge.
const NORMAL_EDGE: f32 = 0.9;

/// The mean of the rays through a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mean {
    pub(super) color: Vec3A,
    /// Share of diffuse light that reaches the eye.
    pub(super) albedo: Vec3A,
    /// Diffuse light on the surfaces.
    pub(super) lighting: Vec3A,
    pub(super) is_edge: bool,
}

/// What is seen in the middles of all pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame<'a> {
    width: usize,
    height: usize,
    seen: &'a [Seen],
}

impl<'a> Frame<'a> {
    pub(super) const fn new(width: u32, height: u32, seen: &'a [Seen]) -> Self {
        Self {
            width: width as usize,
            height: height as usize,
            seen,
        }
    }

    /// The pixels `step` away in the eight directions.
    fn around(&self, x: usize, y: usize, step: usize) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width, self.height);
        let shifts = [
            (0, 1),
            (1, 0),
            (2, 1),
            (1, 2),
            (0, 0),
            (2, 0),
            (0, 2),
            (2, 2),
        ];
        shifts.into_iter().filter_map(move |(right, down)| {
            let (x, y) = (
                (x + right * step).checked_sub(step)?,
                (y + down * step).checked_sub(step)?,
            );
            (x < width && y < height).then_some(y * width + x)
        })
    }

    /// Whether a pixel touches another object, a fold of the surface, or a change of its paint; or one of these
    /// is seen through it.
    pub(super) fn is_edge(&self, x: u32, y: u32) -> bool {
        let (x, y) = (x as usize, y as usize);
        let own = &self.seen[y * self.width + x];
        self.around(x, y, 1)
            .map(|index| &self.seen[index])
            .any(|other| {
                other.id != own.id
                    || !Spot::of(own).continues(&Spot::of(other))
                    || match (own.behind, other.behind) {
                        (Some(own), Some(other)) => {
                            other.passed != own.passed
                                || !Spot::behind(own).continues(&Spot::behind(other))
                        }
                        // Equal objects are clear or not.
                        _ => false,
                    }
            })
    }
}

/// A spot of a painted surface.
struct Spot {
    point: Vec3A,
    normal: Vec3A,
    paint: Vec3A,
}

impl Spot {
    const fn of(seen: &Seen) -> Self {
        Self {
            point: seen.point,
            normal: seen.normal,
            paint: seen.paint,
        }
    }

    fn behind(behind: Behind) -> Self {
        let [point, normal, paint] = [behind.point, behind.normal, behind.paint].map(Vec3A::from);
        Self {
            point,
            normal,
            paint,
        }
    }

    /// Whether a neighbour lies on the same sheet without a fold or a change of paint between: the chord, as seen
    /// from both, leaves neither tangent plane steeply.
    fn continues(&self, other: &Self) -> bool {
        let offset = other.point - self.point;
        let steep = offset
            .dot(self.normal)
            .abs()
            .min(offset.dot(other.normal).abs());
        other.normal.dot(self.normal) >= NORMAL_EDGE * self.normal.length_squared()
            && (other.paint - self.paint).abs().max_element() <= PAINT_EDGE
            && steep <= 0.5 * offset.length() + 1e-5
    }
}

fn brightness(light: Vec3A) -> f32 {
    light.dot(vec3a(0.2126, 0.7152, 0.0722))
}

/// Light and the variance of its brightness.
#[derive(Clone, Copy, Debug)]
struct Noisy {
    light: Vec3A,
    variance: f32,
}

/// The colours with their diffuse light smoothed.
pub(super) fn denoise(frame: &Frame<'_>, means: &[Mean]) -> Vec<Vec3A> {
    let each = |f: &(dyn Fn([usize; 2], usize) -> Noisy + Sync)| -> Vec<Noisy> {
        let row = |y: usize| (0..frame.width).map(move |x| f([x, y], y * frame.width + x));
        (0..frame.height)
            .into_par_iter()
            .flat_map_iter(row)
            .collect()
    };
    let mut lights = each(&|at, index| Noisy {
        light: means[index].lighting,
        variance: spread(frame, means, at),
    });
    for ring in 0..RINGS {
        let before = lights;
        lights = each(&|at, index| {
            if means[index].is_edge {
                before[index]
            } else {
                smooth(frame, means, &before, at, 1 << ring)
            }
        });
    }
    let corrected = |(mean, light): (&Mean, &Noisy)| {
        (mean.color + mean.albedo * (light.light - mean.lighting)).max(Vec3A::ZERO)
    };
    means.iter().zip(&lights).map(corrected).collect()
}

/// The variance of the brightness among the neighbours on the same surface.
fn spread(frame: &Frame<'_>, means: &[Mean], [x, y]: [usize; 2]) -> f32 {
    let own = y * frame.width + x;
    let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
    let neighbours = frame
        .around(x, y, 1)
        .chain(frame.around(x, y, 2))
        .chain([own]);
    for index in neighbours.filter(|&i| frame.seen[i].id == frame.seen[own].id && !means[i].is_edge)
    {
        let brightness = brightness(means[index].lighting);
        count += 1.0;
        sum += brightness;
        squares += brightness * brightness;
    }
    if count < 2.0 {
        0.0
    } else {
        ((squares - sum * sum / count) / (count - 1.0)).max(0.0)
    }
}

fn smooth(
    frame: &Frame<'_>,
    means: &[Mean],
    before: &[Noisy],
    [x, y]: [usize; 2],
    step: usize,
) -> Noisy {
    let index = y * frame.width + x;
    let (own, seen) = (&before[index], &frame.seen[index]);
    let scale = 1.0 / (NOISE * own.variance.sqrt() + 2e-3);
    // Weights of a binomial kernel: four in the middle, two at the sides, one at the corners.
    let (mut weights, mut light, mut variance) = (4.0, own.light * 4.0, own.variance * 4.0);
    for place in frame.around(x, y, step) {
        let other = &frame.seen[place];
        if other.id != seen.id || means[place].is_edge {
            continue;
        }
        let offset = other.point - seen.point;
        let bend = other.normal.dot(seen.normal).max(0.0).powi(24);
        let off_plane = offset.dot(seen.normal).abs() / (offset.length() + 1e-6);
        let differs = brightness(before[place].light - own.light).abs() * scale;
        let is_corner = place % frame.width != x && place / frame.width != y;
        let kernel = if is_corner { 1.0 } else { 2.0 };
        let weight = kernel * bend * (-differs - 6.0 * off_plane).exp();
        weights += weight;
        light += before[place].light * weight;
        variance += before[place].variance * weight;
    }
    Noisy {
        light: light / weights,
        variance: LEFT * variance / weights,
    }
}
