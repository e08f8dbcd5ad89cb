//! The page as SVG: the same marks, texts as outlines that name their words.

use std::fmt::Write;

use glam::DVec2;

use super::mark::{Mark, Rect};
use super::path::{Path, Verb};
use crate::color::Color;

/// The document; `alt` becomes its title for screen readers.
pub(super) fn document(marks: &[Mark], page: DVec2, alt: &str) -> String {
    let (width, height) = (number(page.x), number(page.y));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" role=\"img\">\n<title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        escape(alt)
    );
    let mut clips: Vec<Rect> = Vec::new();
    for mark in marks {
        let clip = mark.clip.map(|rect| {
            clips
                .iter()
                .position(|known| *known == rect)
                .unwrap_or_else(|| {
                    let id = clips.len();
                    out.push_str(&format!(
                        "<clipPath id=\"clip{id}\"><path d=\"{}\"/></clipPath>\n",
                        data(&rect.path())
                    ));
                    clips.push(rect);
                    id
                })
        });
        out.push_str(&element(mark, clip));
    }
    out.push_str("</svg>\n");
    out
}

fn element(mark: &Mark, clip: Option<usize>) -> String {
    let data = data(&mark.path);
    if data.is_empty() {
        return String::new();
    }
    let mut out = format!("<path d=\"{data}\"");
    // Writing to a String cannot fail.
    let _ = match mark.fill {
        Some(color) => write!(out, " fill=\"{}\"{}", color.css(), opacity("fill", color)),
        None => write!(out, " fill=\"none\""),
    };
    if let Some(stroke) = mark.stroke {
        let color = stroke.color;
        let _ = write!(
            out,
            " stroke=\"{}\"{} stroke-width=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"",
            color.css(),
            opacity("stroke", color),
            number(stroke.width)
        );
        if let Some([on, off]) = stroke.dash.pattern(stroke.width) {
            let _ = write!(out, " stroke-dasharray=\"{} {}\"", number(on), number(off));
        }
    }
    if let Some(words) = &mark.words {
        let _ = write!(
            out,
            " paint-order=\"stroke\" role=\"text\" aria-label=\"{}\"",
            escape(words)
        );
    }
    if let Some(id) = clip {
        let _ = write!(out, " clip-path=\"url(#clip{id})\"");
    }
    out.push_str("/>\n");
    out
}

fn opacity(what: &str, color: Color) -> String {
    if color.a >= 1.0 {
        String::new()
    } else {
        format!(" {what}-opacity=\"{}\"", number(f64::from(color.a)))
    }
}

fn data(path: &Path) -> String {
    let point = |p: DVec2| format!("{} {}", number(p.x), number(p.y));
    let steps = path.verbs.iter().map(|verb| match *verb {
        Verb::Move(p) => format!("M{}", point(p)),
        Verb::Line(p) => format!("L{}", point(p)),
        Verb::Cubic(a, b, c) => format!("C{} {} {}", point(a), point(b), point(c)),
        Verb::Close => "Z".into(),
    });
    steps.collect()
}

/// Hundredths of a point are finer than any screen shows.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

/// Text as it must stand in markup.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
