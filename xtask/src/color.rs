//! Colours, the palette of all figures, and the maps from numbers to colours.

use crate::figure::Style;

/// An sRGB colour; every component, opacity included, lies in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
    /// Opacity: 0 is invisible.
    pub a: f32,
}

/// Near black: text, axes, given data.
pub const INK: Color = Color::hex(0x22262b);
/// Mid grey: construction lines, control polygons.
pub const GREY: Color = Color::hex(0x8a9099);
/// Light grey: grids, faint regions.
pub const MIST: Color = Color::hex(0xdfe3e8);
/// White.
pub const WHITE: Color = Color::hex(0xffffff);
/// The eight colours below are those of Okabe and Ito, told apart by all common kinds of colour vision.
pub const BLUE: Color = Color::hex(0x0072b2);
/// Orange.
pub const ORANGE: Color = Color::hex(0xe69f00);
/// Bluish green.
pub const GREEN: Color = Color::hex(0x009e73);
/// Vermilion, the red of the palette.
pub const VERMILION: Color = Color::hex(0xd55e00);
/// Reddish purple.
pub const PURPLE: Color = Color::hex(0xcc79a7);
/// Sky blue.
pub const SKY: Color = Color::hex(0x56b4e9);
/// Yellow: for fills only, a line in it is hard to see.
pub const YELLOW: Color = Color::hex(0xf0e442);

/// The line colours in the order in which a family of curves should take them.
pub const CYCLE: [Color; 7] = [BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY, INK];

impl Color {
    /// The opaque colour `0xRRGGBB`.
    #[must_use]
    pub const fn hex(rgb: u32) -> Self {
        Self {
            r: ((rgb >> 16) & 255) as f32 / 255.0,
            g: ((rgb >> 8) & 255) as f32 / 255.0,
            b: (rgb & 255) as f32 / 255.0,
            a: 1.0,
        }
    }

    /// The colour of number `index` in a family, cyclic.
    #[must_use]
    pub const fn cycle(index: usize) -> Self {
        CYCLE[index % CYCLE.len()]
    }

    /// The same colour with opacity `alpha`.
    #[must_use]
    pub const fn alpha(self, alpha: f32) -> Self {
        Self { a: alpha, ..self }
    }

    /// The straight mixture `(1 - t) self + t other` of the sRGB components.
    #[must_use]
    pub fn mix(self, other: Self, t: f32) -> Self {
        let lerp = |x: f32, y: f32| x + (y - x) * t;
        Self {
            r: lerp(self.r, other.r),
            g: lerp(self.g, other.g),
            b: lerp(self.b, other.b),
            a: lerp(self.a, other.a),
        }
    }

    /// A line of this colour, 1.6 points wide.
    #[must_use]
    pub fn line(self) -> Style {
        Style::stroked(self)
    }

    /// A region of this colour, without outline.
    #[must_use]
    pub fn fill(self) -> Style {
        Style::filled(self)
    }

    /// Linear-light red, green and blue, as the renderer reckons.
    #[must_use]
    pub fn linear(self) -> [f32; 3] {
        [self.r, self.g, self.b].map(|c| {
            if c <= 0.04045 {
                c / 12.92
            } else {
                ((c + 0.055) / 1.055).powf(2.4)
            }
        })
    }

    /// `#rrggbb`, without the opacity.
    #[must_use]
    pub fn css(self) -> String {
        let byte = |c: f32| (c.clamp(0.0, 1.0) * 255.0).round() as u8;
        format!(
            "#{:02x}{:02x}{:02x}",
            byte(self.r),
            byte(self.g),
            byte(self.b)
        )
    }
}

/// A map from `[0, 1]` to colours of evenly rising (or, diverging, evenly mirrored) lightness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColorMap {
    /// Dark blue over green to yellow: distances, times, magnitudes.
    Sequential,
    /// Blue through white to red: signed values, zero in the middle.
    Diverging,
    /// Closed: angles and phases.
    Cyclic,
}

impl ColorMap {
    /// The colour at `t`, clamped to `[0, 1]`; grey for NaN.
    #[must_use]
    pub fn at(self, t: f64) -> Color {
        if t.is_nan() {
            return GREY;
        }
        // Samples of viridis, and of two maps of our own between palette colours.
        let stops: &[u32] = match self {
            Self::Sequential => &[
                0x440154, 0x482878, 0x3e4989, 0x31688e, 0x26828e, 0x1f9e89, 0x35b779, 0x6ece58,
                0xb5de2b, 0xfde725,
            ],
            Self::Diverging => &[
                0x1d4f8c, 0x3f7fbd, 0x84b3dc, 0xc6dcee, 0xf6f4f1, 0xf6d2b8, 0xe89c6f, 0xcb5e35,
                0x8f2d1b,
            ],
            Self::Cyclic => &[
                0x2f3d73, 0x3f7fbd, 0x8fc1c9, 0xf2ead6, 0xe3a46c, 0xb4503f, 0x6b2a52, 0x2f3d73,
            ],
        };
        let position = t.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let index = (position as usize).min(stops.len() - 2);
        Color::hex(stops[index]).mix(
            Color::hex(stops[index + 1]),
            (position - index as f64) as f32,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_and_css_are_inverse() {
        assert_eq!(Color::hex(0x0072b2).css(), "#0072b2");
    }

    #[test]
    fn maps_meet_their_ends() {
        assert_eq!(ColorMap::Sequential.at(-1.0).css(), "#440154");
        assert_eq!(ColorMap::Sequential.at(2.0).css(), "#fde725");
        assert_eq!(ColorMap::Cyclic.at(0.0), ColorMap::Cyclic.at(1.0));
        assert_eq!(ColorMap::Diverging.at(f64::NAN), GREY);
    }
}
