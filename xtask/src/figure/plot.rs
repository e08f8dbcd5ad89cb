//! One plot: what is drawn, in the coordinates of the mathematics.

use glam::DVec2;

use super::path::Path;
use super::scale::Scale;
use super::style::Style;

/// On which side of its point a text stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Side {
    Centre,
    Left,
    Right,
    Above,
    Below,
    AboveLeft,
    AboveRight,
    BelowLeft,
    BelowRight,
}

impl Side {
    /// Unit steps to the right and down (page directions).
    pub(super) const fn direction(self) -> DVec2 {
        let (x, y) = match self {
            Self::Centre => (0.0, 0.0),
            Self::Left => (-1.0, 0.0),
            Self::Right => (1.0, 0.0),
            Self::Above => (0.0, -1.0),
            Self::Below => (0.0, 1.0),
            Self::AboveLeft => (-1.0, -1.0),
            Self::AboveRight => (1.0, -1.0),
            Self::BelowLeft => (-1.0, 1.0),
            Self::BelowRight => (1.0, 1.0),
        };
        DVec2::new(x, y)
    }
}

/// The shape that marks a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A filled disc: the usual point.
    Disc,
    /// A small filled disc: samples.
    Dot,
    /// A ring: control points, candidates.
    Ring,
    /// A square: joints.
    Square,
    /// An oblique cross: singular points, refusals.
    Cross,
}

/// Where the legend stands in the plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Corner {
    TopLeft,
    TopRight,
    BottomLeft,
    BottomRight,
}

/// What a plot shows, in world units.
#[derive(Clone, Debug)]
pub(super) enum Item {
    Shape {
        path: Path,
        style: Style,
    },
    Points {
        at: Vec<DVec2>,
        marker: Marker,
        style: Style,
    },
    Arrow {
        from: DVec2,
        to: DVec2,
        style: Style,
    },
    Text {
        at: DVec2,
        text: String,
        side: Side,
        style: Style,
    },
}

/// A plot, made by adding things to draw; later ones lie above earlier ones.
///
/// The world is fitted to the plot's place on the page unless [`Plot::view`] fixes it.
#[derive(Clone, Debug)]
pub struct Plot {
    pub(super) title: String,
    pub(super) items: Vec<Item>,
    pub(super) equal: bool,
    pub(super) axes: Option<[String; 2]>,
    pub(super) scales: [Scale; 2],
    pub(super) view: Option<[DVec2; 2]>,
    pub(super) legend: Option<Corner>,
    /// Names of x = 1, 2, ... in place of numbers.
    pub(super) categories: Vec<String>,
}

impl Plot {
    /// A drawing of plane geometry: equal units on both axes, which are not drawn.
    #[must_use]
    pub fn geometry(title: &str) -> Self {
        Self {
            title: title.into(),
            items: Vec::new(),
            equal: true,
            axes: None,
            scales: [Scale::Linear; 2],
            view: None,
            legend: None,
            categories: Vec::new(),
        }
    }

    /// A chart with labelled axes, each with its own unit.
    #[must_use]
    pub fn chart(title: &str, x: &str, y: &str) -> Self {
        Self {
            equal: false,
            axes: Some([x.into(), y.into()]),
            ..Self::geometry(title)
        }
    }

    /// Draws axes with ticks and these labels (they may be empty).
    pub fn axes(&mut self, x: &str, y: &str) -> &mut Self {
        self.axes = Some([x.into(), y.into()]);
        self
    }

    /// Equal units on both axes.
    pub fn equal(&mut self) -> &mut Self {
        self.equal = true;
        self
    }

    /// Logarithmic x axis: values that are not positive are not drawn.
    pub fn log_x(&mut self) -> &mut Self {
        self.scales[0] = Scale::Log;
        self.equal = false;
        self
    }

    /// Logarithmic y axis: values that are not positive are not drawn.
    pub fn log_y(&mut self) -> &mut Self {
        self.scales[1] = Scale::Log;
        self.equal = false;
        self
    }

    /// The x axis names its places 1, 2, ... and has no other ticks.
    pub fn categories(&mut self, names: &[&str]) -> &mut Self {
        self.categories = names.iter().map(|&name| name.into()).collect();
        self
    }

    /// Shows the box between two corners, and cuts off what lies outside.
    pub fn view(&mut self, low: DVec2, high: DVec2) -> &mut Self {
        self.view = Some([low.min(high), low.max(high)]);
        self
    }

    /// Puts the legend into a corner; otherwise it takes the emptiest one, or a place below the plot.
    pub fn legend(&mut self, corner: Corner) -> &mut Self {
        self.legend = Some(corner);
        self
    }

    /// A shape of lines and cubic curves.
    pub fn path(&mut self, path: Path, style: Style) -> &mut Self {
        self.items.push(Item::Shape { path, style });
        self
    }

    /// Straight lines through `points`; a point that is not finite interrupts them.
    pub fn polyline(&mut self, points: &[DVec2], style: Style) -> &mut Self {
        self.path(Path::polyline(points, false), style)
    }

    /// A closed polygon or filled region.
    pub fn polygon(&mut self, points: &[DVec2], style: Style) -> &mut Self {
        self.path(Path::polyline(points, true), style)
    }

    /// A straight line.
    pub fn segment(&mut self, from: DVec2, to: DVec2, style: Style) -> &mut Self {
        self.polyline(&[from, to], style)
    }

    /// The curve `f` over `[start, end]`, sampled as densely as its bends need. Where `f` is not
    /// finite the curve is interrupted.
    pub fn trace(
        &mut self,
        f: impl Fn(f64) -> DVec2,
        start: f64,
        end: f64,
        style: Style,
    ) -> &mut Self {
        let points = sample(&f, start, end, self.equal);
        self.polyline(&points, style)
    }

    /// The graph `y = f(x)` over `[start, end]`.
    pub fn graph(
        &mut self,
        f: impl Fn(f64) -> f64,
        start: f64,
        end: f64,
        style: Style,
    ) -> &mut Self {
        self.trace(|x| DVec2::new(x, f(x)), start, end, style)
    }

    /// A circle.
    pub fn circle(&mut self, centre: DVec2, radius: f64, style: Style) -> &mut Self {
        self.path(Path::circle(centre, radius.abs()), style)
    }

    /// An arc of a circle from angle `start` to angle `end`, in radians.
    pub fn arc(
        &mut self,
        centre: DVec2,
        radius: f64,
        start: f64,
        end: f64,
        style: Style,
    ) -> &mut Self {
        self.path(Path::arc(centre, radius.abs(), start, end), style)
    }

    /// Marked points.
    pub fn points(&mut self, at: &[DVec2], marker: Marker, style: Style) -> &mut Self {
        self.items.push(Item::Points {
            at: at.to_vec(),
            marker,
            style,
        });
        self
    }

    /// One marked point with a text beside it.
    pub fn point(&mut self, at: DVec2, text: &str, side: Side, style: Style) -> &mut Self {
        self.points(
            &[at],
            Marker::Disc,
            Style {
                label: None,
                ..style.clone()
            },
        );
        self.colored_text(at, text, side, style)
    }

    /// A vector from `from` to `to`, with an arrow head.
    pub fn arrow(&mut self, from: DVec2, to: DVec2, style: Style) -> &mut Self {
        self.items.push(Item::Arrow { from, to, style });
        self
    }

    /// A text beside a point.
    pub fn text(&mut self, at: DVec2, text: &str, side: Side) -> &mut Self {
        self.colored_text(at, text, side, crate::color::INK.line())
    }

    /// A text beside a point in the colour of `style`.
    pub fn colored_text(&mut self, at: DVec2, text: &str, side: Side, style: Style) -> &mut Self {
        self.items.push(Item::Text {
            at,
            text: text.into(),
            side,
            style,
        });
        self
    }
}

/// Spans into which a traced curve is cut at first, so that no wave falls between samples.
const FIRST_SPANS: usize = 64;
/// Each span is halved at most this often.
const MAX_HALVINGS: u32 = 6;
/// A span is halved while its middle is off the chord by more than this part of the curve's extent:
/// a third of a pixel on a picture of 1280.
const FLATNESS: f64 = 2.5e-4;

/// With `equal` units on both axes bends are seen as they are, otherwise each axis is stretched to the picture.
fn sample(f: &impl Fn(f64) -> DVec2, start: f64, end: f64, equal: bool) -> Vec<DVec2> {
    let at = |i: usize| start + (end - start) * i as f64 / FIRST_SPANS as f64;
    let first: Vec<DVec2> = (0..=FIRST_SPANS).map(|i| f(at(i))).collect();
    let finite = || first.iter().filter(|p| p.is_finite());
    let low = finite().copied().fold(DVec2::INFINITY, DVec2::min);
    let high = finite().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
    let size = high - low;
    let stretch = if equal {
        DVec2::splat(size.length().recip())
    } else {
        size.recip()
    };
    // A curve without any extent on an axis does not bend there.
    let stretch = DVec2::select(stretch.is_finite_mask(), stretch, DVec2::ZERO);
    let mut points = vec![first[0]];
    for (i, pair) in first.windows(2).enumerate() {
        halve(
            f,
            [at(i), at(i + 1)],
            [pair[0], pair[1]],
            stretch,
            MAX_HALVINGS,
            &mut points,
        );
    }
    points
}

fn halve(
    f: &impl Fn(f64) -> DVec2,
    [a, b]: [f64; 2],
    [from, to]: [DVec2; 2],
    stretch: DVec2,
    depth: u32,
    out: &mut Vec<DVec2>,
) {
    let middle = 0.5 * (a + b);
    let at = f(middle);
    let (chord, before, after) = (
        (to - from) * stretch,
        (at - from) * stretch,
        (at - to) * stretch,
    );
    let off = before.perp_dot(chord).abs() / chord.length().max(f64::MIN_POSITIVE);
    let flat = off <= FLATNESS && before.dot(after) <= 0.0;
    if depth == 0 || flat || !(from.is_finite() || to.is_finite()) {
        out.push(to);
    } else {
        halve(f, [a, middle], [from, at], stretch, depth - 1, out);
        halve(f, [middle, b], [at, to], stretch, depth - 1, out);
    }
}
