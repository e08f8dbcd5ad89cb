//! A plot on its place on the page: the fit, the axes, the items, the legend.

use glam::DVec2;

use super::font;
use super::items::{draw_item, text_corner};
use super::legend;
use super::mark::{Mark, Rect};
use super::path::Path;
use super::plot::{Item, Plot};
use super::scale::Tick;
use crate::color::{INK, MIST};

const TITLE_SIZE: f64 = 13.0;
pub(super) const LABEL_SIZE: f64 = 12.0;
const TICK_SIZE: f64 = 11.0;
/// Free border inside a plot, as part of the world's extent.
const PADDING: f64 = 0.045;

/// From world units to page points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// Lengths (logarithms on a log axis) at the low corner.
    origin: DVec2,
    scale: DVec2,
    pub(super) frame: Rect,
}

impl Fit {
    pub(super) fn page(&self, plot: &Plot, world: DVec2) -> DVec2 {
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
