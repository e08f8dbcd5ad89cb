//! Interfaces between media: lines, circles, conics and rational curves.

use bezier_mass::BezierCurve;
use glam::{DMat2, DVec2};

use crate::Error;
use crate::beam::{Part, Wedge};
use crate::chain::Chain;
use crate::conic::Conic;
use crate::strip::{Reach, Strip};

/// Where a ray meets an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact {
    /// The travel time from the start of the ray.
    pub time: f64,
    /// The place.
    pub point: DVec2,
    /// The unit tangent of the interface.
    pub tangent: DVec2,
    /// The curvature of the interface, positive if it turns to the left of the tangent.
    pub curvature: f64,
    /// The place on the interface: piece number plus parameter for a curve, 0 for the other shapes.
    pub parameter: f64,
}

/// A line is followed beyond a box by this share of its size, against rounding.
const CLIP_MARGIN: f64 = 1e-8;

/// A curve at which a wave is reflected and transmitted.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredInterface",
        into = "crate::stored::StoredInterface"
    )
)]
pub struct Interface {
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    Line { point: DVec2, tangent: DVec2 },
    Conic(Conic),
    Curve(Chain),
}

impl Interface {
    /// The line through a point.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`].
    pub fn line(point: DVec2, direction: DVec2) -> Result<Self, Error> {
        if !(point.is_finite() && direction.is_finite()) {
            return Err(Error::NonFinite { what: "a line" });
        }
        // A unit vector stays as it is: a line that is written and read is the same.
        let tangent = if (direction.length_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
            direction
        } else {
            direction.try_normalize().ok_or(Error::ZeroDirection {
                what: "the direction of a line",
            })?
        };
        Ok(Self {
            shape: Shape::Line { point, tangent },
        })
    }

    /// A horizontal line.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn horizontal(height: f64) -> Result<Self, Error> {
        Self::line(DVec2::new(0.0, height), DVec2::X)
    }

    /// A circle.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] unless the radius is positive.
    pub fn circle(centre: DVec2, radius: f64) -> Result<Self, Error> {
        Self::ellipse(centre, DVec2::X * radius, DVec2::Y * radius)
    }

    /// An ellipse with two conjugate half axes.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] if the half axes are parallel.
    pub fn ellipse(centre: DVec2, first: DVec2, second: DVec2) -> Result<Self, Error> {
        let axes = DMat2::from_cols(first, second);
        if !(centre.is_finite() && axes.is_finite()) {
            return Err(Error::NonFinite { what: "an ellipse" });
        }
        if axes.determinant() == 0.0 {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "the half axes of an ellipse are parallel",
            });
        }
        let inverse = axes.inverse();
        Self::conic_about(centre, inverse.transpose() * inverse, DVec2::ZERO, -1.0)
    }

    /// The conic `a x² + b xy + c y² + d x + e y + f = 0`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] if the quadratic part vanishes (use a line).
    pub fn conic([a, b, c, d, e, f]: [f64; 6]) -> Result<Self, Error> {
        let form = DMat2::from_cols(DVec2::new(a, 0.5 * b), DVec2::new(0.5 * b, c));
        Self::conic_about(DVec2::ZERO, form, 0.5 * DVec2::new(d, e), f)
    }

    pub(crate) fn conic_about(
        centre: DVec2,
        form: DMat2,
        linear: DVec2,
        constant: f64,
    ) -> Result<Self, Error> {
        Ok(Self {
            shape: Shape::Conic(Conic::new(centre, form, linear, constant)?),
        })
    }

    /// A chain of polynomial or rational Bézier curves: a B-spline's pieces, a piecewise conic.
    ///
    /// # Errors
    /// [`Error::BadInterface`] for no pieces or a piece that is a single point.
    pub fn curve(pieces: impl IntoIterator<Item = BezierCurve<DVec2>>) -> Result<Self, Error> {
        Ok(Self {
            shape: Shape::Curve(Chain::new(pieces)?),
        })
    }

    /// The first impact of a ray later than `after`, if there is one.
    #[inline]
    #[must_use]
    pub fn first_impact(&self, origin: DVec2, velocity: DVec2, after: f64) -> Option<Impact> {
        if let Shape::Curve(chain) = &self.shape {
            return chain.first_impact(origin, velocity, after);
        }
        let mut first: Option<Impact> = None;
        self.visit_impacts(origin, velocity, after, |impact| {
            if first.is_none_or(|known| impact.time < known.time) {
                first = Some(impact);
            }
        });
        first
    }

    /// The number of impacts of a ray; odd from a point inside a closed curve or below a layer boundary (for a ray upwards).
    #[must_use]
    pub fn count_impacts(&self, origin: DVec2, velocity: DVec2) -> usize {
        let mut count = 0;
        self.visit_impacts(origin, velocity, 0.0, |_| count += 1);
        count
    }

    /// The impact near a known place, by Newton's method from there; exact for the shapes that are solved in closed form.
    #[inline(always)]
    #[must_use]
    pub fn impact_near(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        guess: f64,
    ) -> Option<Impact> {
        match &self.shape {
            Shape::Line { point, tangent } => {
                impact_on_line(*point, *tangent, origin, velocity, after)
            }
            Shape::Conic(_) => self.first_impact(origin, velocity, after),
            Shape::Curve(chain) => chain.impact_near(origin, velocity, after, guess),
        }
    }

    /// Whether the straight way between two points meets the interface. A way that starts on it says at which parameter
    /// (`left`) and is not blocked there; at both ends the share `margin` of the way does not count.
    #[must_use]
    pub fn blocks(&self, from: DVec2, to: DVec2, left: Option<f64>, margin: f64) -> bool {
        match &self.shape {
            Shape::Curve(chain) => chain.blocks(from, to, left, margin),
            Shape::Line { .. } if left.is_some() => false,
            _ => self
                .first_impact(from, to - from, if left.is_some() { margin } else { 0.0 })
                .is_some_and(|impact| impact.time < 1.0 - margin),
        }
    }

    /// The length of the curve's derivative by the parameter of an impact; none for the shapes without a parameter.
    pub(crate) fn speed(&self, parameter: f64) -> Option<f64> {
        match &self.shape {
            Shape::Curve(chain) => chain.speed(parameter),
            _ => None,
        }
    }

    /// Whether the rays of a strip surely do not meet the interface; where they start on it (`left`), not again.
    pub(crate) fn is_clear_of(&self, strip: &Strip, reach: &Reach, left: bool) -> bool {
        match &self.shape {
            Shape::Line { .. } => left,
            Shape::Conic(_) => false,
            Shape::Curve(chain) => chain.is_clear_of(strip, reach, left),
        }
    }

    /// Whether the tangents between two impacts are between the tangents there, but for a little.
    pub(crate) fn is_plain_between(&self, one: &Impact, two: &Impact) -> bool {
        match &self.shape {
            Shape::Curve(chain) => chain.is_plain_between(one, two),
            _ => true,
        }
    }

    /// Calls `found` with the parts of the interface in a box that rays of a wedge may meet, or with none where that is not
    /// known.
    pub(crate) fn visit_parts(
        &self,
        wedge: &Wedge,
        [low, high]: [DVec2; 2],
        found: &mut dyn FnMut(Option<Part>),
    ) {
        match &self.shape {
            Shape::Line { point, tangent } => {
                // One tangent: the box in which the line runs is all that a further leg needs.
                let Some((start, end)) = clipped(*point, *tangent, low, high) else {
                    return;
                };
                let part = Part {
                    low: start.min(end),
                    high: start.max(end),
                    tangent: tangent.to_angle(),
                    spread: 0.0,
                };
                part.narrowed(start, end, wedge, found);
            }
            Shape::Conic(conic) => conic.visit_parts(wedge, [low, high], found),
            Shape::Curve(chain) => chain.visit_parts(wedge, [low, high], found),
        }
    }

    /// Calls `found` for every impact later than `after`, in no order.
    #[inline]
    fn visit_impacts(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        mut found: impl FnMut(Impact),
    ) {
        match &self.shape {
            Shape::Line { point, tangent } => {
                if let Some(impact) = impact_on_line(*point, *tangent, origin, velocity, after) {
                    found(impact);
                }
            }
            Shape::Conic(conic) => conic.visit_impacts(origin, velocity, after, found),
            Shape::Curve(chain) => chain.visit_impacts(origin, velocity, after, found),
        }
    }

    /// Whether some of the interface may lie in a box; certain for a line, and by its control points for a curve.
    pub(crate) fn may_enter(&self, low: DVec2, high: DVec2) -> bool {
        match &self.shape {
            Shape::Line { point, tangent } => {
                let (centre, half) = (0.5 * (low + high) - *point, 0.5 * (high - low));
                let reach = tangent.x.abs() * half.y + tangent.y.abs() * half.x;
                tangent.perp_dot(centre).abs() <= reach
            }
            Shape::Conic(_) => true,
            Shape::Curve(chain) => chain.may_enter(low, high),
        }
    }

    /// Points along the interface inside a box, in order, for drawing and for the checks of a model.
    #[must_use]
    pub fn polyline(&self, low: DVec2, high: DVec2, count: usize) -> Vec<DVec2> {
        let share = |i: usize| i as f64 / count.max(1) as f64;
        match &self.shape {
            Shape::Line { point, tangent } => {
                let reach = (high - low).length() + (0.5 * (low + high) - *point).length();
                let along = |i: usize| *point + (2.0 * share(i) - 1.0) * reach * *tangent;
                (0..=count)
                    .map(along)
                    .filter(|p| p.cmpge(low).all() && p.cmple(high).all())
                    .collect()
            }
            Shape::Conic(conic) => {
                // Rays from the centre (or the focus side of a parabola) meet the conic once on each side.
                let heart = conic.heart(low, high);
                let around = |i: usize| {
                    let direction = DVec2::from_angle(std::f64::consts::TAU * share(i));
                    Some(self.first_impact(heart, direction, 0.0)?.point)
                };
                (0..=count).filter_map(around).collect()
            }
            Shape::Curve(chain) => (0..=count)
                .filter_map(|i| chain.point(chain.piece_count() as f64 * share(i)))
                .collect(),
        }
    }
}

#[cfg(feature = "serde")]
impl From<Interface> for crate::stored::StoredInterface {
    fn from(interface: Interface) -> Self {
        match interface.shape {
            Shape::Line { point, tangent } => Self::Line {
                point,
                direction: tangent,
            },
            Shape::Conic(conic) => conic.into(),
            Shape::Curve(chain) => Self::Curve {
                pieces: chain.into_curves(),
            },
        }
    }
}

/// The ends of a line in a box, if it passes through; to a margin beyond it.
fn clipped(point: DVec2, tangent: DVec2, low: DVec2, high: DVec2) -> Option<(DVec2, DVec2)> {
    let margin = CLIP_MARGIN * (high - low);
    let (one, two) = (
        (low - margin - point) / tangent,
        (high + margin - point) / tangent,
    );
    // Along an axis one of the coordinates bounds nothing, or is outside.
    let (near, far) = (one.min(two), one.max(two));
    let inside = |near: f64, far: f64| {
        if near.is_nan() || far.is_nan() {
            None
        } else {
            Some((near, far))
        }
    };
    let (x, y) = (inside(near.x, far.x), inside(near.y, far.y));
    let infinite = (f64::NEG_INFINITY, f64::INFINITY);
    let (x, y) = (x.unwrap_or(infinite), y.unwrap_or(infinite));
    let (from, to) = (x.0.max(y.0), x.1.min(y.1));
    (from < to).then(|| (point + from * tangent, point + to * tangent))
}

#[inline]
fn impact_on_line(
    point: DVec2,
    tangent: DVec2,
    origin: DVec2,
    velocity: DVec2,
    after: f64,
) -> Option<Impact> {
    let approach = velocity.perp_dot(tangent);
    let time = (point - origin).perp_dot(tangent) / approach;
    (approach != 0.0 && time > after).then(|| Impact {
        time,
        point: origin + time * velocity,
        tangent,
        curvature: 0.0,
        parameter: 0.0,
    })
}

/// The largest distance in y between an interface and a function, looked for at 1,000 places.
#[cfg(test)]
fn graph_error(interface: &Interface, f: impl Fn(f64) -> f64) -> f64 {
    let points = interface.polyline(DVec2::ZERO, DVec2::ONE, 1000);
    points
        .iter()
        .map(|p| (p.y - f(p.x)).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests;
