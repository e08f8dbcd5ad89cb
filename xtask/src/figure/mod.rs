//! Plane figures: one drawing model, written as PNG (tiny-skia) and as SVG.
//!
//! ```text
//!   Plot (items in world units) ──fit──> [Mark] (shapes in page points) ──> raster, SVG
//! ```
//!
//! A [`Plot`] takes curves, polygons, points, arrows, circles, regions and texts in the coordinates
//! of the mathematics, y up. A [`Figure`] lays plots out on a page of 640 points width; whatever
//! the pixels, text keeps its proportion to the page.
//!
//! ```
//! use glam::DVec2;
//! use xtask::color::{BLUE, GREY};
//! use xtask::figure::{Figure, Marker, Plot, Side};
//!
//! let mut plot = Plot::geometry("a parabola");
//! let control = [DVec2::new(-1.0, 1.0), DVec2::new(0.0, -1.0), DVec2::new(1.0, 1.0)];
//! plot.polyline(&control, GREY.line().dashed());
//! plot.trace(|t| DVec2::new(t, t * t), -1.0, 1.0, BLUE.line().width(2.4).label("y = x²"));
//! plot.points(&control, Marker::Disc, GREY.fill());
//! plot.text(control[1], "P₁", Side::Below);
//! let svg = Figure::new(plot).svg("a parabola and its control polygon");
//! assert!(svg.starts_with("<svg"));
//! ```

mod axes;
mod font;
mod items;
mod legend;
mod mark;
mod path;
mod plot;
mod raster;
mod scale;
mod style;
mod svg;

pub use path::Path;
pub use plot::{Corner, Marker, Plot, Side};
pub use style::{Dash, Style};
pub(crate) use svg::escape;

use glam::DVec2;

use crate::image::Image;
use mark::{Mark, Rect};

/// Width of every page in points; a text of the figure is 11 of them high.
pub const PAGE_WIDTH: f64 = 640.0;
/// Free space around the page and between plots, in points.
const MARGIN: f64 = 12.0;
const TITLE_HEIGHT: f64 = 26.0;

/// Plots laid out in rows and columns on one page.
#[derive(Clone, Debug)]
pub struct Figure {
    plots: Vec<Plot>,
    columns: usize,
    aspect: f64,
    title: Option<String>,
}

impl Figure {
    /// A figure of one plot, four units wide by three high.
    #[must_use]
    pub fn new(plot: Plot) -> Self {
        Self::grid(1, vec![plot])
    }

    /// Plots in rows of `columns`, filled row by row; each plot is four units wide by three high.
    #[must_use]
    pub const fn grid(columns: usize, plots: Vec<Plot>) -> Self {
        let columns = if columns == 0 { 1 } else { columns };
        Self {
            plots,
            columns,
            aspect: 4.0 / 3.0,
            title: None,
        }
    }

    /// The same with plots of width over height `aspect` (between 0.1 and 10).
    #[must_use]
    pub const fn aspect(mut self, aspect: f64) -> Self {
        self.aspect = aspect.clamp(0.1, 10.0);
        self
    }

    /// The same with a title over all plots.
    #[must_use]
    pub fn title(mut self, title: &str) -> Self {
        self.title = Some(title.into());
        self
    }

    fn rows(&self) -> usize {
        self.plots.len().div_ceil(self.columns).max(1)
    }

    /// Size of the page in points.
    #[must_use]
    pub fn page(&self) -> DVec2 {
        let columns = self.columns as f64;
        let plot_width = (PAGE_WIDTH - (columns + 1.0) * MARGIN) / columns;
        let rows = self.rows() as f64;
        let title = if self.title.is_some() {
            TITLE_HEIGHT
        } else {
            0.0
        };
        DVec2::new(
            PAGE_WIDTH,
            title + rows * plot_width / self.aspect + (rows + 1.0) * MARGIN,
        )
    }

    fn marks(&self) -> Vec<Mark> {
        let page = self.page();
        let mut marks = Vec::new();
        let mut top = MARGIN;
        if let Some(title) = &self.title {
            top += TITLE_HEIGHT;
            let at = DVec2::new(0.5 * page.x, MARGIN + 0.5 * TITLE_HEIGHT - 2.0);
            marks.push(Mark::text(title, at, DVec2::splat(0.5), 15.0));
        }
        let columns = self.columns as f64;
        let rows = self.rows() as f64;
        let cell = DVec2::new(
            (page.x - (columns + 1.0) * MARGIN) / columns,
            (page.y - top - rows * MARGIN) / rows,
        );
        for (index, plot) in self.plots.iter().enumerate() {
            let place = DVec2::new((index % self.columns) as f64, (index / self.columns) as f64);
            let corner = DVec2::new(MARGIN, top) + place * (cell + MARGIN);
            axes::draw(plot, Rect::new(corner, corner + cell), &mut marks);
        }
        marks
    }

    /// The figure `width` pixels wide.
    #[must_use]
    pub fn image(&self, width: u32) -> Image {
        raster::image(&self.marks(), self.page(), f64::from(width) / PAGE_WIDTH)
    }

    /// The figure as an SVG document; `alt` describes it for who cannot see it.
    #[must_use]
    pub fn svg(&self, alt: &str) -> String {
        svg::document(&self.marks(), self.page(), alt)
    }
}

#[cfg(test)]
mod tests;
