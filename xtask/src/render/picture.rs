//! A rendered picture: linear light and the data layers, tone-mapped for the screen.

use std::io::{Seek, Write};

use anyhow::Result;
use glam::{Vec3, Vec3A};

use super::exr;
use crate::image::Image;

/// What is seen in the middle of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// Distance along the line of sight in world units.
    pub(super) depth: f32,
    /// Unit normal on the viewer's side.
    pub(super) normal: Vec3A,
    /// Object number, 0 for the ground and the backdrop.
    pub(super) id: u32,
    /// The vertices' number there.
    pub(super) scalar: f32,
    /// The point in the unit ball's coordinates.
    pub(super) point: Vec3A,
    /// The colour of the surface.
    pub(super) paint: Vec3A,
    /// What is seen through it, if it is clear.
    pub(super) behind: Option<Behind>,
}

/// What is seen through clear shells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Behind {
    /// A number that differs where the ray passes other shells or ends elsewhere.
    pub(super) passed: u32,
    /// The place, unit normal and paint at the end: an opaque surface, the ground or the backdrop.
    pub(super) point: Vec3,
    pub(super) normal: Vec3,
    pub(super) paint: Vec3,
}

impl Seen {
    /// The depth of a pixel that shows only the backdrop.
    pub(super) const FAR: f32 = 1e10;
}

/// Linear, scene-referred colour and the data of the surface in the middle of every pixel.
#[derive(Clone, Debug)]
pub struct Picture {
    width: u32,
    height: u32,
    colors: Vec<Vec3A>,
    seen: Vec<Seen>,
    layer: Option<String>,
}

impl Picture {
    pub(super) const fn new(
        [width, height]: [u32; 2],
        colors: Vec<Vec3A>,
        seen: Vec<Seen>,
        layer: Option<String>,
    ) -> Self {
        Self {
            width,
            height,
            colors,
            seen,
            layer,
        }
    }

    /// Width and height in pixels.
    #[must_use]
    pub const fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Name of the layer of the vertices' numbers.
    #[must_use]
    pub fn layer_name(&self) -> Option<&str> {
        self.layer.as_deref()
    }

    /// Linear red, green, blue and alpha (all of it opaque), row by row from the top.
    pub fn colors(&self) -> impl Iterator<Item = [f32; 4]> {
        self.colors
            .iter()
            .map(|color| [color.x, color.y, color.z, 1.0])
    }

    /// Object numbers, row by row from the top; 0 is the ground or the backdrop.
    pub fn ids(&self) -> impl Iterator<Item = u32> {
        self.seen.iter().map(|seen| seen.id)
    }

    /// Distances along the line of sight in world units; 1e10 for the backdrop.
    pub fn depths(&self) -> impl Iterator<Item = f32> {
        self.seen.iter().map(|seen| seen.depth)
    }

    /// Unit normals on the viewer's side in world directions; zero for the backdrop.
    pub fn normals(&self) -> impl Iterator<Item = [f32; 3]> {
        self.seen.iter().map(|seen| seen.normal.to_array())
    }

    /// The vertices' numbers, interpolated; 0 where there is none.
    pub fn scalars(&self) -> impl Iterator<Item = f32> {
        self.seen.iter().map(|seen| seen.scalar)
    }

    /// The picture for the screen.
    #[must_use]
    pub fn image(&self) -> Image {
        let bytes = (0..).zip(&self.colors).flat_map(|(index, color)| {
            let threshold = threshold(index % self.width, index / self.width);
            let [r, g, b] = tone_map(color.to_array()).map(|c| display(c, threshold));
            [r, g, b, 255]
        });
        Image::new(self.width, self.height, bytes.collect())
    }

    /// The picture as OpenEXR: linear RGBA, `depth.Z`, `normal.X/Y/Z`, `id.I`, and the layer of the
    /// vertices' numbers if the scene names one. The same picture gives the same bytes.
    ///
    /// # Errors
    /// Whatever the writer reports.
    pub fn write_exr(&self, writer: impl Write + Seek) -> Result<()> {
        exr::write(self, writer)
    }
}

/// Khronos' PBR Neutral tone mapping: colours stay what they are up to 0.8, highlights are
/// compressed, and lose colour only as they near white.
fn tone_map(color: [f32; 3]) -> [f32; 3] {
    const START: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    let lowest = color.into_iter().fold(f32::INFINITY, f32::min).max(0.0);
    let offset = if lowest < 0.08 {
        lowest - 6.25 * lowest * lowest
    } else {
        0.04
    };
    let color = color.map(|c| c - offset);
    let peak = color.into_iter().fold(0.0, f32::max);
    if peak < START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    let grey = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.map(|c| {
        let c = c * new_peak / peak;
        c + (new_peak - c) * grey
    })
}

/// Where between two bytes a value rounds up, by Bayer's pattern of eight by eight pixels: with one threshold for
/// all pixels, a smooth backdrop shows bands.
fn threshold(x: u32, y: u32) -> f32 {
    let rank = (0..3).fold(0, |rank, bit| {
        rank << 2 | ((x ^ y) >> bit & 1) << 1 | y >> bit & 1
    });
    (rank as f32 + 0.5) / 64.0
}

/// The byte that shows a linear value, rounded up from this part of the way to the next.
fn display(linear: f32, threshold: f32) -> u8 {
    let c = linear.clamp(0.0, 1.0);
    let encoded = if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    };
    (encoded * 255.0 + threshold).floor() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tone_mapping_keeps_order_and_range() {
        let mut before = -1.0;
        for i in 0..2000 {
            let [r, g, b] = tone_map([i as f32 * 0.01; 3]);
            assert!(r == g && g == b && r > before && r < 1.0, "{i}: {r}");
            before = r;
        }
        assert_eq!([0.0, 1.0, 0.5].map(|c| display(c, 0.5)), [0, 255, 188]);
    }

    #[test]
    fn a_dithered_value_is_right_on_average() {
        let mut ranks = [false; 64];
        let mut sum = 0.0;
        for (x, y) in (0..8).flat_map(|x| (0..8).map(move |y| (x, y))) {
            let threshold = threshold(x, y);
            ranks[(threshold * 64.0) as usize] = true;
            assert_eq!(display(1.0, threshold), 255);
            sum += f32::from(display(0.5, threshold));
        }
        assert!(ranks.iter().all(|&met| met));
        assert!((sum / 64.0 - 187.516).abs() < 0.02, "{sum}");
    }
}
