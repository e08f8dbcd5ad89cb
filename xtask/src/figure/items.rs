//! What a plot shows, as marks on the page: shapes, points, arrows, texts.

use glam::DVec2;

use super::axes::{Fit, LABEL_SIZE};
use super::font;
use super::mark::{Mark, Rect, Stroke};
use super::path::{Path, Verb};
use super::plot::{Item, Marker, Plot, Side};
use super::style::{Dash, Style};
use crate::color::WHITE;

/// Distance of a text from its point, in points.
const TEXT_GAP: f64 = 6.0;

pub(super) fn draw_item(
    plot: &Plot,
    item: &Item,
    fit: &Fit,
    clip: Option<Rect>,
    marks: &mut Vec<Mark>,
) {
    let page = |p: DVec2| fit.page(plot, p);
    match item {
        Item::Shape { path, style } => {
            let reach = 4.0 * fit.frame.size();
            let path = Path {
                verbs: finite(&path.map(page)),
            };
            let path = path.cut_lines(fit.frame.low - reach, fit.frame.high + reach);
            marks.push(Mark {
                clip,
                ..styled(path, style)
            });
        }
        Item::Points { at, marker, style } => {
            let inside = |p: &DVec2| p.is_finite() && clip.is_none_or(|frame| frame.contains(*p));
            for at in at.iter().map(|&p| page(p)).filter(inside) {
                marks.push(marker_mark(at, *marker, style));
            }
        }
        Item::Arrow { from, to, style } => arrow(page(*from), page(*to), style, clip, marks),
        Item::Text {
            at,
            text,
            side,
            style,
        } => {
            let low = text_corner(page(*at), text, *side);
            if low.is_finite() {
                let mark = Mark::text(text, low, DVec2::ZERO, LABEL_SIZE);
                marks.push(Mark {
                    fill: Some(style.color()),
                    ..mark.with_halo()
                });
            }
        }
    }
}

/// The steps of a path with those dropped that a log axis cannot show.
fn finite(path: &Path) -> Vec<Verb> {
    let mut verbs = Vec::with_capacity(path.verbs.len());
    let mut broken = true;
    for verb in &path.verbs {
        let end = match *verb {
            Verb::Move(p) | Verb::Line(p) => Some(p),
            Verb::Cubic(a, b, c) => Some(if a.is_finite() && b.is_finite() {
                c
            } else {
                DVec2::NAN
            }),
            Verb::Close => None,
        };
        match end {
            Some(p) if !p.is_finite() => broken = true,
            Some(p) if broken => {
                verbs.push(Verb::Move(p));
                broken = false;
            }
            None if broken => {}
            _ => verbs.push(*verb),
        }
    }
    verbs
}

pub(super) fn styled(path: Path, style: &Style) -> Mark {
    let stroke = style.stroke.map(|color| Stroke {
        color,
        width: style.width,
        dash: style.dash,
    });
    Mark {
        path,
        fill: style.fill,
        stroke,
        clip: None,
        words: None,
    }
}

pub(super) fn marker_mark(at: DVec2, marker: Marker, style: &Style) -> Mark {
    let color = style.color();
    match marker {
        Marker::Disc => Mark {
            stroke: Some(rim()),
            ..Mark::filled(Path::circle(at, 3.6), color)
        },
        Marker::Dot => Mark::filled(Path::circle(at, 1.9), color),
        Marker::Ring => Mark {
            fill: Some(WHITE),
            ..Mark::line(Path::circle(at, 3.2), color, 1.5)
        },
        Marker::Square => {
            let square = Rect::new(at - 3.1, at + 3.1).path();
            Mark {
                stroke: Some(rim()),
                ..Mark::filled(square, color)
            }
        }
        Marker::Cross => {
            let mut path = Path::new();
            for d in [DVec2::new(3.4, 3.4), DVec2::new(3.4, -3.4)] {
                path.move_to(at - d);
                path.line_to(at + d);
            }
            Mark::line(path, color, 1.8)
        }
    }
}

/// A thin white rim sets a point off from the lines through it.
const fn rim() -> Stroke {
    Stroke {
        color: WHITE,
        width: 0.8,
        dash: Dash::Solid,
    }
}

fn arrow(from: DVec2, to: DVec2, style: &Style, clip: Option<Rect>, marks: &mut Vec<Mark>) {
    let length = from.distance(to);
    if !(length > 0.0 && length.is_finite()) {
        return;
    }
    let direction = (to - from) / length;
    let head = (5.0 + 2.2 * style.width).min(length);
    let base = to - direction * head;
    let side = direction.perp() * 0.38 * head;
    let shaft = Path::polyline(&[from, to - direction * (0.8 * head)], false);
    marks.push(Mark {
        clip,
        fill: None,
        ..styled(
            shaft,
            &Style {
                stroke: Some(style.color()),
                ..style.clone()
            },
        )
    });
    // The notch at the back of the head makes it read as an arrow, not as a triangle.
    let outline = [to, base + side, to - direction * (0.75 * head), base - side];
    marks.push(Mark {
        clip,
        ..Mark::filled(Path::polyline(&outline, true), style.color())
    });
}

pub(super) fn text_corner(at: DVec2, text: &str, side: Side) -> DVec2 {
    let direction = side.direction();
    let size = font::extent(text, LABEL_SIZE);
    let gap = if direction.x != 0.0 && direction.y != 0.0 {
        0.6 * TEXT_GAP
    } else {
        TEXT_GAP
    };
    at + direction * gap + (direction - 1.0) * 0.5 * size
}
