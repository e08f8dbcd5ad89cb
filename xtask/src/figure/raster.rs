//! The page as pixels, by tiny-skia.

use glam::DVec2;
use tiny_skia::{
    FillRule, LineCap, LineJoin, Mask, Paint, PathBuilder, Pixmap, StrokeDash, Transform,
};

use super::mark::{Mark, Rect, Stroke};
use super::path::{Path, Verb};
use crate::color::Color;
use crate::image::Image;

/// The marks on white, `scale` pixels a point.
pub(super) fn image(marks: &[Mark], page: DVec2, scale: f64) -> Image {
    let size = (page * scale).ceil().max(DVec2::ONE);
    let (width, height) = (size.x as u32, size.y as u32);
    let Some(mut pixmap) = Pixmap::new(width, height) else {
        return Image::new(width, height, Vec::new());
    };
    pixmap.fill(tiny_skia::Color::WHITE);
    let mut clip: Option<(Rect, Mask)> = None;
    for mark in marks {
        if let Some(wanted) = mark.clip
            && clip.as_ref().is_none_or(|(rect, _)| *rect != wanted)
        {
            clip = mask(wanted, width, height, scale).map(|mask| (wanted, mask));
        }
        let mask = mark.clip.and(clip.as_ref().map(|(_, mask)| mask));
        draw(mark, &mut pixmap, scale, mask);
    }
    Image::new(width, height, pixmap.take_demultiplied())
}

fn mask(rect: Rect, width: u32, height: u32, scale: f64) -> Option<Mask> {
    let mut mask = Mask::new(width, height)?;
    mask.fill_path(
        &build(&rect.path())?,
        FillRule::Winding,
        true,
        transform(scale),
    );
    Some(mask)
}

fn transform(scale: f64) -> Transform {
    Transform::from_scale(scale as f32, scale as f32)
}

fn draw(mark: &Mark, pixmap: &mut Pixmap, scale: f64, mask: Option<&Mask>) {
    let Some(path) = build(&mark.path) else {
        return;
    };
    let fill = |pixmap: &mut Pixmap| {
        if let Some(color) = mark.fill {
            pixmap.fill_path(
                &path,
                &paint(color),
                FillRule::Winding,
                transform(scale),
                mask,
            );
        }
    };
    let stroke = |pixmap: &mut Pixmap| {
        if let Some(stroke) = mark.stroke {
            pixmap.stroke_path(
                &path,
                &paint(stroke.color),
                &looks(stroke),
                transform(scale),
                mask,
            );
        }
    };
    // The rim of a text lies under its letters, any other outline over its region.
    if mark.words.is_some() {
        stroke(pixmap);
        fill(pixmap);
    } else {
        fill(pixmap);
        stroke(pixmap);
    }
}

fn paint(color: Color) -> Paint<'static> {
    let mut paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    let c = [color.r, color.g, color.b, color.a].map(|c| c.clamp(0.0, 1.0));
    paint.set_color(
        tiny_skia::Color::from_rgba(c[0], c[1], c[2], c[3]).unwrap_or(tiny_skia::Color::BLACK),
    );
    paint
}

fn looks(stroke: Stroke) -> tiny_skia::Stroke {
    let pattern = stroke.dash.pattern(stroke.width);
    tiny_skia::Stroke {
        width: stroke.width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        dash: pattern.and_then(|lengths| StrokeDash::new(lengths.map(|l| l as f32).to_vec(), 0.0)),
        ..tiny_skia::Stroke::default()
    }
}

fn build(path: &Path) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    for verb in &path.verbs {
        match *verb {
            Verb::Move(p) => builder.move_to(p.x as f32, p.y as f32),
            Verb::Line(p) => builder.line_to(p.x as f32, p.y as f32),
            Verb::Cubic(a, b, c) => {
                builder.cubic_to(
                    a.x as f32, a.y as f32, b.x as f32, b.y as f32, c.x as f32, c.y as f32,
                );
            }
            Verb::Close => builder.close(),
        }
    }
    builder.finish()
}
