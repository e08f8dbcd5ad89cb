//! What surfaces look like.

use crate::color::{Color, ColorMap};

/// Where a surface takes its colour from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// One colour.
    Plain(Color),
    /// Black and white stripes of the reflected direction: unbroken across a joint exactly where the
    /// normals agree (G1), without a kink where the curvature agrees too.
    Zebra {
        /// Stripes in half a turn of the reflected direction.
        stripes: f32,
    },
    /// The vertices' numbers through a colour map.
    Scalar {
        /// The colours.
        map: ColorMap,
        /// Number that gets the first colour.
        low: f64,
        /// Number that gets the last colour.
        high: f64,
        /// Distance of isolines, if there are any.
        isolines: Option<f64>,
    },
}

/// How a surface meets the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Diffuse, like plaster.
    Matte,
    /// Diffuse under a clear coat, like glazed ceramics.
    Glossy,
    /// A thin coloured shell that one sees through, denser towards its outline.
    Glass,
}

/// Paint and finish.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Where the colour comes from.
    pub paint: Paint,
    /// How it meets the light.
    pub finish: Finish,
}

impl Material {
    /// Diffuse, in one colour.
    #[must_use]
    pub const fn matte(color: Color) -> Self {
        Self {
            paint: Paint::Plain(color),
            finish: Finish::Matte,
        }
    }

    /// Under a clear coat, in one colour.
    #[must_use]
    pub const fn glossy(color: Color) -> Self {
        Self {
            paint: Paint::Plain(color),
            finish: Finish::Glossy,
        }
    }

    /// A coloured shell that one sees through.
    #[must_use]
    pub const fn glass(color: Color) -> Self {
        Self {
            paint: Paint::Plain(color),
            finish: Finish::Glass,
        }
    }

    /// Reflection lines: 14 stripes in half a turn, without other mirror images that would cross them.
    #[must_use]
    pub const fn zebra() -> Self {
        Self {
            paint: Paint::Zebra { stripes: 14.0 },
            finish: Finish::Matte,
        }
    }

    /// The vertices' numbers between `low` and `high` through a colour map.
    #[must_use]
    pub const fn scalar(map: ColorMap, low: f64, high: f64) -> Self {
        Self {
            paint: Paint::Scalar {
                map,
                low,
                high,
                isolines: None,
            },
            finish: Finish::Matte,
        }
    }

    /// The same with dark lines where the number is a multiple of `spacing`.
    #[must_use]
    pub const fn isolines(mut self, spacing: f64) -> Self {
        if let Paint::Scalar { isolines, .. } = &mut self.paint {
            *isolines = Some(spacing);
        }
        self
    }
}
