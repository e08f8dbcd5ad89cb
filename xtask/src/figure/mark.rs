//! The drawing model: shapes in page points, y down, ready for either writer.

use glam::DVec2;

use super::font;
use super::path::Path;
use super::style::Dash;
use crate::color::{Color, INK, WHITE};

/// A box on the page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rect {
    pub(super) low: DVec2,
    pub(super) high: DVec2,
}

impl Rect {
    pub(super) const fn new(low: DVec2, high: DVec2) -> Self {
        Self { low, high }
    }

    pub(super) fn size(self) -> DVec2 {
        self.high - self.low
    }

    pub(super) fn contains(self, point: DVec2) -> bool {
        point.cmpge(self.low).all() && point.cmple(self.high).all()
    }

    pub(super) fn path(self) -> Path {
        let corners = [
            self.low,
            DVec2::new(self.high.x, self.low.y),
            self.high,
            DVec2::new(self.low.x, self.high.y),
        ];
        Path::polyline(&corners, true)
    }
}

/// A line's looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) dash: Dash,
}

/// One shape on the page. A text is a shape that knows its words.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mark {
    pub(super) path: Path,
    pub(super) fill: Option<Color>,
    pub(super) stroke: Option<Stroke>,
    pub(super) clip: Option<Rect>,
    pub(super) words: Option<String>,
}

impl Mark {
    pub(super) const fn filled(path: Path, color: Color) -> Self {
        Self {
            path,
            fill: Some(color),
            stroke: None,
            clip: None,
            words: None,
        }
    }

    pub(super) const fn line(path: Path, color: Color, width: f64) -> Self {
        let stroke = Stroke {
            color,
            width,
            dash: Dash::Solid,
        };
        Self {
            path,
            fill: None,
            stroke: Some(stroke),
            clip: None,
            words: None,
        }
    }

    /// A text whose box has the point `at` at the fraction `anchor` of its width and height.
    pub(super) fn text(words: &str, at: DVec2, anchor: DVec2, size: f64) -> Self {
        let low = at - anchor * font::extent(words, size);
        let path = font::outline(words, size).map(|p| p + low);
        Self {
            words: Some(words.into()),
            ..Self::filled(path, INK)
        }
    }

    /// A text that reads upwards, its middle at `at`.
    pub(super) fn upright_text(words: &str, at: DVec2, size: f64) -> Self {
        let middle = 0.5 * font::extent(words, size);
        let path = font::outline(words, size).map(|p| {
            let q = p - middle;
            at + DVec2::new(q.y, -q.x)
        });
        Self {
            words: Some(words.into()),
            ..Self::filled(path, INK)
        }
    }

    /// The same with a white rim, legible over lines.
    pub(super) fn with_halo(self) -> Self {
        let stroke = Stroke {
            color: WHITE.alpha(0.85),
            width: 3.0,
            dash: Dash::Solid,
        };
        Self {
            stroke: Some(stroke),
            ..self
        }
    }
}
