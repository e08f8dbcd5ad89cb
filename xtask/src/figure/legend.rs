//! The legend: in a free corner of the plot, or else in a strip below it.

use glam::DVec2;

use super::font;
use super::items::{marker_mark, styled};
use super::mark::{Mark, Rect};
use super::path::Path;
use super::plot::{Corner, Item, Marker, Plot};
use super::style::Style;
use crate::color::{MIST, WHITE};

const TEXT_SIZE: f64 = 11.0;
const ROW: f64 = 17.0;
const SWATCH: f64 = 24.0;
const GAP: f64 = 7.0;

/// An entry: its text and a sample of its looks.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    text: String,
    style: Style,
    marker: Option<Marker>,
}

/// The labelled items of a plot, equal labels once.
pub(super) fn entries(plot: &Plot) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for item in &plot.items {
        let (style, marker) = match item {
            Item::Shape { style, .. } | Item::Arrow { style, .. } => (style, None),
            Item::Points { style, marker, .. } => (style, Some(*marker)),
            Item::Text { .. } => continue,
        };
        if let Some(text) = &style.label {
            match entries.iter_mut().find(|known| known.text == *text) {
                // A line and the points on it share an entry.
                Some(known) => known.marker = known.marker.or(marker),
                None => entries.push(Entry {
                    text: text.clone(),
                    style: style.clone(),
                    marker,
                }),
            }
        }
    }
    entries
}

fn width(entry: &Entry) -> f64 {
    SWATCH + GAP + font::extent(&entry.text, TEXT_SIZE).x
}

/// Size of the legend as a box of one column.
pub(super) fn size(entries: &[Entry]) -> DVec2 {
    let widest = entries.iter().map(width).fold(0.0, f64::max);
    DVec2::new(widest + 2.0 * GAP, ROW * entries.len() as f64 + GAP)
}

/// The low corner for a box of `size`: the wanted corner, or one without points under it.
pub(super) fn corner(
    wanted: Option<Corner>,
    frame: Rect,
    size: DVec2,
    points: &[DVec2],
) -> Option<DVec2> {
    let inner = Rect::new(frame.low + GAP, frame.high - GAP - size);
    let place = |corner| match corner {
        Corner::TopLeft => inner.low,
        Corner::TopRight => DVec2::new(inner.high.x, inner.low.y),
        Corner::BottomLeft => DVec2::new(inner.low.x, inner.high.y),
        Corner::BottomRight => inner.high,
    };
    if let Some(corner) = wanted {
        return Some(place(corner));
    }
    let free = |low: &DVec2| {
        let around = Rect::new(*low - 4.0, *low + size + 4.0);
        !points.iter().any(|&p| around.contains(p))
    };
    let fits = inner.low.cmple(inner.high).all();
    let corners = [
        Corner::TopRight,
        Corner::TopLeft,
        Corner::BottomRight,
        Corner::BottomLeft,
    ];
    fits.then(|| corners.into_iter().map(place).find(free))
        .flatten()
}

fn draw_entry(entry: &Entry, left: DVec2, marks: &mut Vec<Mark>) {
    let right = left + DVec2::new(SWATCH, 0.0);
    let style = Style {
        label: None,
        ..entry.style.clone()
    };
    if entry.marker.is_none()
        || style.stroke.is_some() && style.fill.is_none() && entry.marker != Some(Marker::Ring)
    {
        let sample = if style.fill.is_some() {
            Rect::new(left - DVec2::new(0.0, 5.0), right + DVec2::new(0.0, 5.0)).path()
        } else {
            Path::polyline(&[left, right], false)
        };
        marks.push(styled(sample, &style));
    }
    if let Some(marker) = entry.marker {
        marks.push(marker_mark(0.5 * (left + right), marker, &style));
    }
    let at = right + DVec2::new(GAP, 0.0);
    marks.push(Mark::text(
        &entry.text,
        at,
        DVec2::new(0.0, 0.56),
        TEXT_SIZE,
    ));
}

/// Draws the legend as a box with this low corner.
pub(super) fn draw_box(entries: &[Entry], low: DVec2, marks: &mut Vec<Mark>) {
    let frame = Rect::new(low, low + size(entries)).path();
    marks.push(Mark {
        fill: Some(WHITE.alpha(0.9)),
        ..Mark::line(frame, MIST, 0.8)
    });
    for (row, entry) in entries.iter().enumerate() {
        let y = low.y + 0.5 * GAP + ROW * (row as f64 + 0.5);
        draw_entry(entry, DVec2::new(low.x + GAP, y), marks);
    }
}

/// The rows of a strip of this width: the first entry of each.
fn rows(entries: &[Entry], strip: f64) -> Vec<Vec<&Entry>> {
    let mut rows: Vec<Vec<&Entry>> = Vec::new();
    let mut used = f64::INFINITY;
    for entry in entries {
        let needed = width(entry) + 2.0 * GAP;
        if used + needed > strip {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += needed;
        if let Some(row) = rows.last_mut() {
            row.push(entry);
        }
    }
    rows
}

/// Height of the legend as a strip of this width.
pub(super) fn strip_height(entries: &[Entry], strip: f64) -> f64 {
    ROW * rows(entries, strip).len() as f64 + GAP
}

/// Draws the legend as a strip along the bottom of `place`.
pub(super) fn draw_strip(entries: &[Entry], place: Rect, marks: &mut Vec<Mark>) {
    let rows = rows(entries, place.size().x);
    for (number, row) in rows.iter().enumerate() {
        let total: f64 = row
            .iter()
            .map(|entry| width(entry) + 2.0 * GAP)
            .sum::<f64>()
            - 2.0 * GAP;
        let y = place.high.y - ROW * (rows.len() as f64 - number as f64 - 0.5);
        let mut x = 0.5 * (place.low.x + place.high.x - total);
        for entry in row {
            draw_entry(entry, DVec2::new(x, y), marks);
            x += width(entry) + 2.0 * GAP;
        }
    }
}
