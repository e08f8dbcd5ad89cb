//! A plot on its place on the page: the fit, the axes, the items, the legend.

use glam::DVec2;

use super::font;
use super::legend;
use super::mark::{Mark, Rect, Stroke};
use super::path::Path;
use super::plot::{Item, Marker, Plot, Side};
use super::scale::Tick;
use super::style::Style;
use crate::color::{INK, MIST, WHITE};

const TITLE_SIZE: f64 = 13.0;
const LABEL_SIZE: f64 = 12.0;
const TICK_SIZE: f64 = 11.0;
/// Distance of a text from its point, in points.
const TEXT_GAP: f64 = 6.0;
/// Free border inside a plot, as part of the world's extent.
const PADDING: f64 = 0.045;

/// From world units to page points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// Lengths (logarithms on a log axis) at the low corner.
    origin: DVec2,
    scale: DVec2,
    frame: Rect,
}

impl Fit {
    fn page(&self, plot: &Plot, world: DVec2) -> DVec2 {
        let length = DVec2::new(
            plot.scales[0].length(world.x),
            plot.scales[1].length(world.y),
        );
        let offset = (length - self.origin) * self.scale;
        DVec2::new(self.frame.low.x + offset.x, self.frame.high.y - offset.y)
    }

    /// The lengths at the frame's low and high corners.
    fn range(&self) -> [DVec2; 2] {
        [self.origin, self.origin + self.frame.size() / self.scale]
    }
}

/// Draws a plot into `place`.
pub(super) fn draw(plot: &Plot, place: Rect, marks: &mut Vec<Mark>) {
    let mut frame = place;
    if !plot.title.is_empty() {
        let at = DVec2::new(0.5 * (place.low.x + place.high.x), place.low.y);
        marks.push(Mark::text(
            &plot.title,
            at,
            DVec2::new(0.5, 0.0),
            TITLE_SIZE,
        ));
        frame.low.y += TITLE_SIZE * 1.2 + 6.0;
    }
    let entries = legend::entries(plot);
    let fitted = |frame: Rect| {
        let frame = if plot.axes.is_some() {
            inside_axes(plot, frame)
        } else {
            frame
        };
        fit(plot, frame)
    };
    let mut fit = fitted(frame);
    if plot.axes.is_none() {
        let [left_top, right_bottom] = overhang(plot, &fit);
        frame = Rect::new(frame.low + left_top, frame.high - right_bottom);
        fit = fitted(frame);
    }
    let mut spot = None;
    if !entries.is_empty() {
        let size = legend::size(&entries);
        spot = legend::corner(plot.legend, fit.frame, size, &occupied(plot, &fit));
        if spot.is_none() {
            // No free corner: a strip under the plot.
            let strip = legend::strip_height(&entries, place.size().x);
            fit = fitted(Rect::new(frame.low, frame.high - DVec2::new(0.0, strip)));
        }
    }
    if plot.axes.is_some() {
        draw_axes(plot, &fit, marks);
    }
    let clip = (plot.view.is_some() || plot.axes.is_some()).then_some(fit.frame);
    for item in &plot.items {
        draw_item(plot, item, &fit, clip, marks);
    }
    match spot {
        Some(low) => legend::draw_box(&entries, low, marks),
        None => legend::draw_strip(&entries, place, marks),
    }
}

/// How far texts stand out of the frame, to the left and above, to the right and below: the fit knows their points only.
fn overhang(plot: &Plot, fit: &Fit) -> [DVec2; 2] {
    // A text may reach this far into the white around the plot.
    const ALLOWED: f64 = 4.0;
    let (mut before, mut after) = (DVec2::ZERO, DVec2::ZERO);
    for item in &plot.items {
        if let Item::Text { at, text, side, .. } = item {
            let low = text_corner(fit.page(plot, *at), text, *side);
            let high = low + font::extent(text, LABEL_SIZE);
            if low.is_finite() && !text.is_empty() {
                before = before.max(fit.frame.low - low - ALLOWED);
                after = after.max(high - fit.frame.high - ALLOWED);
            }
        }
    }
    // Wildly long texts must leave room for the plot.
    let most = 0.3 * fit.frame.size();
    [before.min(most), after.min(most)]
}

/// Page points that the legend should not cover.
fn occupied(plot: &Plot, fit: &Fit) -> Vec<DVec2> {
    let page = |p: DVec2| fit.page(plot, p);
    let mut points = Vec::new();
    for item in &plot.items {
        match item {
            Item::Shape { path, .. } => points.extend(path.map(page).samples(4.0)),
            Item::Points { at, .. } => points.extend(at.iter().map(|&p| page(p))),
            Item::Arrow { from, to, .. } => {
                points.extend(Path::polyline(&[page(*from), page(*to)], false).samples(4.0))
            }
            Item::Text { at, text, side, .. } => {
                let low = text_corner(page(*at), text, *side);
                let size = font::extent(text, LABEL_SIZE);
                points.extend([0.0, 0.5, 1.0].map(|t| low + size * DVec2::new(t, 0.5)));
            }
        }
    }
    points
}

/// The lengths that the items span.
fn extent(plot: &Plot) -> [DVec2; 2] {
    if let Some([low, high]) = plot.view {
        let length = |p: DVec2| DVec2::new(plot.scales[0].length(p.x), plot.scales[1].length(p.y));
        let (low, high) = (length(low), length(high));
        if low.is_finite() && high.is_finite() && low.cmplt(high).all() {
            return [low, high];
        }
    }
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut include = |p: DVec2| {
        for axis in 0..2 {
            let length = plot.scales[axis].length(p[axis]);
            if length.is_finite() {
                low[axis] = low[axis].min(length);
                high[axis] = high[axis].max(length);
            }
        }
    };
    for item in &plot.items {
        match item {
            Item::Shape { path, .. } => path.samples(0.0).into_iter().for_each(&mut include),
            Item::Points { at, .. } => at.iter().copied().for_each(&mut include),
            Item::Arrow { from, to, .. } => [*from, *to].into_iter().for_each(&mut include),
            Item::Text { at, .. } => include(*at),
        }
    }
    for axis in 0..2 {
        if low[axis] > high[axis] {
            (low[axis], high[axis]) = (0.0, 1.0);
        }
    }
    let size = high - low;
    for axis in 0..2 {
        // A single value, or a single line along an axis, gets room around it.
        let room = if size[axis] > 0.0 {
            PADDING * size[axis]
        } else if plot.equal && size.max_element() > 0.0 {
            PADDING * size.max_element()
        } else {
            (0.5 * low[axis].abs()).max(0.5)
        };
        low[axis] -= room;
        high[axis] += room;
    }
    [low, high]
}

fn fit(plot: &Plot, mut frame: Rect) -> Fit {
    let [mut low, high] = extent(plot);
    let mut scale = frame.size() / (high - low);
    if plot.equal {
        scale = DVec2::splat(scale.min_element());
        let used = (high - low) * scale;
        if plot.view.is_some() {
            // A fixed view keeps its box: the frame shrinks around the middle.
            let middle = 0.5 * (frame.low + frame.high);
            frame = Rect::new(middle - 0.5 * used, middle + 0.5 * used);
        } else {
            low -= 0.5 * (frame.size() - used) / scale;
        }
    }
    Fit {
        origin: low,
        scale,
        frame,
    }
}

/// The frame that is left beside tick texts and labels.
fn inside_axes(plot: &Plot, place: Rect) -> Rect {
    let [x_label, y_label] = plot
        .axes
        .as_ref()
        .map_or(["", ""], |labels| [labels[0].as_str(), labels[1].as_str()]);
    let rough = fit(
        plot,
        Rect::new(
            place.low + DVec2::new(50.0, 4.0),
            place.high - DVec2::new(8.0, 40.0),
        ),
    );
    let [_, y_ticks] = ticks(plot, &rough);
    let widest = y_ticks
        .iter()
        .map(|t| font::extent(&t.text, TICK_SIZE).x)
        .fold(0.0, f64::max);
    let left = widest
        + 9.0
        + if y_label.is_empty() {
            0.0
        } else {
            LABEL_SIZE * 1.2 + 4.0
        };
    let bottom = TICK_SIZE * 1.2
        + 7.0
        + if x_label.is_empty() {
            0.0
        } else {
            LABEL_SIZE * 1.2 + 2.0
        };
    Rect::new(
        place.low + DVec2::new(left, 4.0),
        place.high - DVec2::new(10.0, bottom),
    )
}

fn ticks(plot: &Plot, fit: &Fit) -> [Vec<Tick>; 2] {
    let [low, high] = fit.range();
    let size = fit.frame.size();
    let mut wanted = size / DVec2::new(50.0, 38.0);
    if plot.equal {
        // Equal units want equal steps, the ones for which there is room on both axes.
        let per_unit = (wanted / (high - low)).min_element();
        wanted = (high - low) * per_unit;
    }
    let named = (1..).zip(&plot.categories).map(|(place, name)| Tick {
        value: f64::from(place),
        text: name.clone(),
    });
    let x_ticks = if plot.categories.is_empty() {
        plot.scales[0].ticks(low.x, high.x, wanted.x)
    } else {
        named.collect()
    };
    [x_ticks, plot.scales[1].ticks(low.y, high.y, wanted.y)]
}

fn draw_axes(plot: &Plot, fit: &Fit, marks: &mut Vec<Mark>) {
    let frame = fit.frame;
    let [x_ticks, y_ticks] = ticks(plot, fit);
    for tick in &x_ticks {
        let x = frame.low.x + (plot.scales[0].length(tick.value) - fit.origin.x) * fit.scale.x;
        let line = [DVec2::new(x, frame.low.y), DVec2::new(x, frame.high.y)];
        marks.push(Mark::line(Path::polyline(&line, false), MIST, 0.7));
        let at = DVec2::new(x, frame.high.y + 5.0);
        marks.push(Mark::text(&tick.text, at, DVec2::new(0.5, 0.0), TICK_SIZE));
    }
    for tick in &y_ticks {
        let y = frame.high.y - (plot.scales[1].length(tick.value) - fit.origin.y) * fit.scale.y;
        let line = [DVec2::new(frame.low.x, y), DVec2::new(frame.high.x, y)];
        marks.push(Mark::line(Path::polyline(&line, false), MIST, 0.7));
        let at = DVec2::new(frame.low.x - 6.0, y);
        marks.push(Mark::text(&tick.text, at, DVec2::new(1.0, 0.56), TICK_SIZE));
    }
    marks.push(Mark::line(frame.path(), INK, 0.9));
    if let Some([x_label, y_label]) = &plot.axes {
        let bottom = frame.high.y + TICK_SIZE * 1.2 + 7.0;
        let at = DVec2::new(0.5 * (frame.low.x + frame.high.x), bottom);
        marks.push(Mark::text(x_label, at, DVec2::new(0.5, 0.0), LABEL_SIZE));
        let widest = y_ticks
            .iter()
            .map(|t| font::extent(&t.text, TICK_SIZE).x)
            .fold(0.0, f64::max);
        let at = DVec2::new(
            frame.low.x - widest - 9.0 - LABEL_SIZE * 0.6,
            0.5 * (frame.low.y + frame.high.y),
        );
        marks.push(Mark::upright_text(y_label, at, LABEL_SIZE));
    }
}

fn draw_item(plot: &Plot, item: &Item, fit: &Fit, clip: Option<Rect>, marks: &mut Vec<Mark>) {
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
fn finite(path: &Path) -> Vec<super::path::Verb> {
    use super::path::Verb;
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
        dash: super::style::Dash::Solid,
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

fn text_corner(at: DVec2, text: &str, side: Side) -> DVec2 {
    let direction = side.direction();
    let size = font::extent(text, LABEL_SIZE);
    let gap = if direction.x != 0.0 && direction.y != 0.0 {
        0.6 * TEXT_GAP
    } else {
        TEXT_GAP
    };
    at + direction * gap + (direction - 1.0) * 0.5 * size
}
