//! How a shape looks.

use crate::color::Color;

/// The pattern of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dash {
    /// Unbroken.
    #[default]
    Solid,
    /// Long strokes: construction lines, asymptotes.
    Dashed,
    /// Dots: things behind, hidden, or at infinity.
    Dotted,
}

impl Dash {
    /// Lengths of stroke and gap in points for a line of this width.
    pub(super) fn pattern(self, width: f64) -> Option<[f64; 2]> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some([3.0 + 2.0 * width, 2.0 + 1.5 * width]),
            Self::Dotted => Some([0.01, 1.5 + 1.5 * width]),
        }
    }
}

/// Outline, filling and legend entry of a shape. Made from a colour: `BLUE.line().dashed()`.
#[derive(Clone, Debug, PartialEq)]
pub struct Style {
    /// Colour of the outline, if it has one.
    pub stroke: Option<Color>,
    /// Width of the outline in points.
    pub width: f64,
    /// Pattern of the outline.
    pub dash: Dash,
    /// Colour of the interior, if it is filled.
    pub fill: Option<Color>,
    /// Entry in the legend, if it has one.
    pub label: Option<String>,
}

impl Style {
    /// An outline in `color`, 1.6 points wide.
    #[must_use]
    pub const fn stroked(color: Color) -> Self {
        Self {
            stroke: Some(color),
            width: 1.6,
            dash: Dash::Solid,
            fill: None,
            label: None,
        }
    }

    /// A filled interior in `color`, no outline.
    #[must_use]
    pub const fn filled(color: Color) -> Self {
        Self {
            stroke: None,
            width: 1.6,
            dash: Dash::Solid,
            fill: Some(color),
            label: None,
        }
    }

    /// The same with a filled interior.
    #[must_use]
    pub fn fill(self, color: Color) -> Self {
        Self {
            fill: Some(color),
            ..self
        }
    }

    /// The same with an outline.
    #[must_use]
    pub fn stroke(self, color: Color) -> Self {
        Self {
            stroke: Some(color),
            ..self
        }
    }

    /// The same with a line of `points` width.
    #[must_use]
    pub fn width(self, points: f64) -> Self {
        Self {
            width: points,
            ..self
        }
    }

    /// The same, dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self {
            dash: Dash::Dashed,
            ..self
        }
    }

    /// The same, dotted.
    #[must_use]
    pub fn dotted(self) -> Self {
        Self {
            dash: Dash::Dotted,
            ..self
        }
    }

    /// The same with an entry in the legend. Equal entries are shown once.
    #[must_use]
    pub fn label(self, text: impl Into<String>) -> Self {
        Self {
            label: Some(text.into()),
            ..self
        }
    }

    /// The colour that stands for the shape: the outline's, else the interior's.
    pub(super) fn color(&self) -> Color {
        self.stroke.or(self.fill).unwrap_or(crate::color::INK)
    }
}
