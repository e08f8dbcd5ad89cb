//! The rays between two sampled neighbours, as lines whose coefficients are cubics: a dual Bézier curve.

use bezier_mass::MassPoint;
use glam::DVec2;

use crate::{Medium, Ray};

/// Rays cross a piece of an interface in one sense if the sine of the angle to its control polygon is beyond this; far above
/// the accuracy to which a strip knows its rays' directions.
const CLEARLY_ACROSS: f64 = 1e-3;

/// The oriented line of a ray: `<side, X> - offset` is the distance of X to its left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SideForm {
    pub(crate) side: DVec2,
    pub(crate) offset: f64,
}

/// A sampled ray: its line, and the derivative of that along the fan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Knot {
    pub(crate) parameter: f64,
    form: SideForm,
    slope: SideForm,
}

/// The rays between two knots by cubic Hermite interpolation of their lines.
///
/// ```text
///    knot       B1    B2       knot        the control lines of a strip: a receiver X has the four
///      \        |    /       /             distances <side, X> - offset from them, the Bernstein
///       \       |   /      /               coefficients of its distance from the ray at t. Their
///        B0     |  /     B3                signs tell how many rays pass X; all of one sign: none.
/// ```
///
/// The envelope of the lines is the caustic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    /// The control lines, coordinate by coordinate, so that all four distances are computed at once.
    side_x: [f64; 4],
    side_y: [f64; 4],
    offset: [f64; 4],
    /// The largest length of a control line's side vector: the distances change by this much a unit of length.
    steepness: f64,
}

/// Where the rays of a strip are on a leg: before them from its start on, and to a slack beside the strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    direction: DVec2,
    start: f64,
    pub(crate) slack: f64,
}

impl Reach {
    /// For the rays between two that start at these points. In between they may start farther back, but not by the points'
    /// distance.
    pub(crate) fn new(strip: &Strip, starts: [DVec2; 2], slack: f64) -> Self {
        let sides: DVec2 = strip.control().iter().map(|form| form.side).sum();
        let direction = -sides.perp().normalize_or_zero();
        let along = starts.map(|start| direction.dot(start));
        Self {
            direction,
            start: along[0].min(along[1]) - starts[0].distance(starts[1]) - slack,
            slack,
        }
    }

    /// Whether some of a disc may be before the rays.
    #[inline]
    pub(crate) fn is_ahead(&self, centre: DVec2, radius: f64) -> bool {
        self.direction.dot(centre) + radius >= self.start
    }
}

impl SideForm {
    fn value(&self, point: DVec2) -> f64 {
        self.side.dot(point) - self.offset
    }

    fn plus(&self, other: &Self, factor: f64) -> Self {
        Self {
            side: self.side + factor * other.side,
            offset: self.offset + factor * other.offset,
        }
    }
}

impl Knot {
    pub(crate) fn new(parameter: f64, ray: &Ray, medium: &Medium) -> Self {
        let velocity = medium.group_velocity(ray.slowness);
        let change = medium.group_velocity_change(ray.slowness, ray.slowness_change);
        let speed = velocity.length();
        let direction = velocity / speed;
        let turn = (change - direction * direction.dot(change)) / speed;
        Self {
            parameter,
            form: SideForm {
                side: direction.perp(),
                offset: direction.perp_dot(ray.point),
            },
            slope: SideForm {
                side: turn.perp(),
                offset: turn.perp_dot(ray.point) + direction.perp_dot(ray.point_change),
            },
        }
    }

    /// How far a third ray's line is from that of the strip between two knots at its middle, inside a circle.
    pub(crate) fn misfit(&self, strip: &Strip, centre: DVec2, radius: f64) -> f64 {
        let [a, b, c, d] = strip.control();
        let sum = a.plus(&b, 3.0).plus(&c, 3.0).plus(&d, 1.0);
        let difference = self.form.plus(&sum, -0.125);
        difference.value(centre).abs() + radius * difference.side.length()
    }

    /// How quickly the line moves inside a circle, by the parameter.
    pub(crate) fn rate(&self, centre: DVec2, radius: f64) -> f64 {
        self.slope.value(centre).abs() + radius * self.slope.side.length()
    }

    /// How far apart two lines are inside a circle.
    pub(crate) fn distance(&self, other: &Self, centre: DVec2, radius: f64) -> f64 {
        let difference = self.form.plus(&other.form, -1.0);
        difference.value(centre).abs() + radius * difference.side.length()
    }
}

impl Strip {
    pub(crate) fn between(start: &Knot, end: &Knot) -> Self {
        let third = (end.parameter - start.parameter) / 3.0;
        let control = [
            start.form,
            start.form.plus(&start.slope, third),
            end.form.plus(&end.slope, -third),
            end.form,
        ];
        let steepness = control
            .iter()
            .map(|form| form.side.length())
            .fold(0.0, f64::max);
        Self {
            side_x: control.map(|form| form.side.x),
            side_y: control.map(|form| form.side.y),
            offset: control.map(|form| form.offset),
            steepness,
        }
    }

    fn control(&self) -> [SideForm; 4] {
        [0, 1, 2, 3].map(|i| SideForm {
            side: DVec2::new(self.side_x[i], self.side_y[i]),
            offset: self.offset[i],
        })
    }

    /// The Bernstein coefficients of the signed distance of a point from the rays, unless all of them are more than `slack`
    /// on one side: no ray of the strip passes the point then.
    #[inline]
    pub(crate) fn distances_within(&self, point: DVec2, slack: f64) -> Option<[f64; 4]> {
        let mut distances = [0.0; 4];
        for (i, distance) in distances.iter_mut().enumerate() {
            *distance = self.side_x[i] * point.x + self.side_y[i] * point.y - self.offset[i];
        }
        let [a, b, c, d] = distances;
        let apart = if a > slack {
            b > slack && c > slack && d > slack
        } else {
            a < -slack && b < -slack && c < -slack && d < -slack
        };
        (!apart).then_some(distances)
    }

    /// Whether a ray of the strip may pass a disc.
    #[inline]
    pub(crate) fn may_pass(&self, centre: DVec2, radius: f64) -> bool {
        self.distances_within(centre, radius * self.steepness)
            .is_some()
    }

    /// The side, -1 or 1, to which a control polygon runs across all rays of the strip in all of its edges; 0 if there is none.
    pub(crate) fn sense_across(&self, control: &[MassPoint<DVec2>]) -> f64 {
        let mut sense = 0.0;
        for pair in control.windows(2) {
            let (Some(from), Some(to)) = (pair[0].position(), pair[1].position()) else {
                return 0.0;
            };
            let edge = to - from;
            let least = CLEARLY_ACROSS * CLEARLY_ACROSS * edge.length_squared();
            for form in self.control() {
                let across = form.side.dot(edge);
                // An edge without length has no sense.
                let is_clear = across * across > least && across * sense >= 0.0;
                if !is_clear {
                    return 0.0;
                }
                sense = across.signum();
            }
        }
        sense
    }
}
