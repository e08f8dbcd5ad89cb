//! Text as outlines: DejaVu Sans, whose licence is in `xtask/fonts/DejaVu-LICENSE`.
//!
//! A letter after `_` is a subscript: most of them have no character of their own.

use std::sync::OnceLock;

use glam::DVec2;
use ttf_parser::{Face, OutlineBuilder};

use super::path::Path;

fn face() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(dejavu::sans::regular(), 0).ok())
        .as_ref()
}

/// Height of a line over the size of its text; the outlines of all letters lie within.
const LINE_HEIGHT: f64 = 1.2;
/// Depth of the base line under the top of the line, over the size.
const BASE_LINE: f64 = 0.92;

/// Size of a subscript over that of its text, and how far it stands below the base line, over the size.
const SUBSCRIPT: (f64, f64) = (0.7, 0.16);

/// The letters of a line, each with whether it is a subscript.
fn letters(line: &str) -> impl Iterator<Item = (char, bool)> {
    let mut characters = line.chars().peekable();
    std::iter::from_fn(move || {
        let first = characters.next()?;
        let below = if first == '_' {
            characters.next()
        } else {
            None
        };
        Some(below.map_or((first, false), |letter| (letter, true)))
    })
}

/// Width and height of a text's box, in points.
pub(super) fn extent(text: &str, size: f64) -> DVec2 {
    let widths = text.lines().map(|line| {
        face().map_or(0.0, |face| {
            let advance = |(c, is_below): (char, bool)| {
                let units = glyph(face, c).map_or(0, |id| face.glyph_hor_advance(id).unwrap_or(0));
                f64::from(units) * if is_below { SUBSCRIPT.0 } else { 1.0 }
            };
            letters(line).map(advance).sum::<f64>() * size / f64::from(face.units_per_em())
        })
    });
    let lines = text.lines().count().max(1) as f64;
    DVec2::new(
        widths.fold(0.0, f64::max),
        (lines - 1.0) * 1.35 * size + LINE_HEIGHT * size,
    )
}

/// The letters' outlines, the box's top left corner at the origin, y down. Lines stand one below another.
pub(super) fn outline(text: &str, size: f64) -> Path {
    let mut pen = Pen {
        path: Path::new(),
        origin: DVec2::ZERO,
        scale: 0.0,
    };
    if let Some(face) = face() {
        let full = size / f64::from(face.units_per_em());
        for (number, line) in text.lines().enumerate() {
            pen.origin.x = 0.0;
            for (c, is_below) in letters(line) {
                let (scale, drop) = if is_below { SUBSCRIPT } else { (1.0, 0.0) };
                pen.scale = full * scale;
                pen.origin.y = (BASE_LINE + 1.35 * number as f64 + drop) * size;
                if let Some(id) = glyph(face, c) {
                    // A blank has no outline.
                    let _ = face.outline_glyph(id, &mut pen);
                    pen.origin.x += f64::from(face.glyph_hor_advance(id).unwrap_or(0)) * pen.scale;
                }
            }
        }
    }
    pen.path
}

/// The glyph of a character, the box of "no such character" where the font lacks it.
fn glyph(face: &Face<'_>, c: char) -> Option<ttf_parser::GlyphId> {
    face.glyph_index(c).or_else(|| face.glyph_index('\u{fffd}'))
}

struct Pen {
    path: Path,
    origin: DVec2,
    scale: f64,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> DVec2 {
        self.origin + DVec2::new(f64::from(x), -f64::from(y)) * self.scale
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.at(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.at(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quadratic_to(self.at(x1, y1), self.at(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path
            .cubic_to(self.at(x1, y1), self.at(x2, y2), self.at(x, y));
    }

    fn close(&mut self) {
        self.path.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_font_has_our_symbols() {
        let face = face().unwrap();
        for c in "κρφθλμ∇∫⊥∥∈⟨⟩ℝ₀₁₂⁻⁹≤≥±·×→′″√∞°".chars()
        {
            assert!(face.glyph_index(c).is_some(), "{c}");
        }
    }

    #[test]
    fn a_subscript_is_smaller_and_lower() {
        assert_eq!(
            letters("a_b_").collect::<Vec<_>>(),
            [('a', false), ('b', true), ('_', false)]
        );
        let [plain, below] = ["Rd", "R_d"].map(|text| {
            let points = outline(text, 20.0).samples(1.0);
            (
                extent(text, 20.0).x,
                points.iter().map(|p| p.y).fold(0.0, f64::max),
            )
        });
        assert!(below.0 < plain.0 && below.1 > plain.1 + 2.0);
    }

    #[test]
    fn letters_stay_in_their_box() {
        let text = "Ägypten, W_e";
        let size = extent(text, 20.0);
        for p in outline(text, 20.0).samples(1.0) {
            assert!(
                p.x >= -1.0 && p.x <= size.x + 1.0 && p.y >= -1.0 && p.y <= size.y,
                "{p}"
            );
        }
    }
}
