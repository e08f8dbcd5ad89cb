//! The rays between two sampled neighbours, as lines whose coefficients are cubics: a dual Bézier curve.

use glam::DVec2;

use crate::{Medium, Ray};

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
    control: [SideForm; 4],
    /// The largest length of a control line's side vector: the distances change by this much a unit of length.
    steepness: f64,
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
        let [a, b, c, d] = &strip.control;
        let sum = a.plus(b, 3.0).plus(c, 3.0).plus(d, 1.0);
        let difference = self.form.plus(&sum, -0.125);
        difference.value(centre).abs() + radius * difference.side.length()
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
        Self { control, steepness }
    }

    /// The Bernstein coefficients of the signed distance of a point from the rays.
    #[inline]
    pub(crate) fn distances(&self, point: DVec2) -> [f64; 4] {
        self.control.map(|form| form.value(point))
    }

    /// Whether a ray of the strip may pass a disc.
    #[inline]
    pub(crate) fn may_pass(&self, centre: DVec2, radius: f64) -> bool {
        let reach = radius * self.steepness;
        let distances = self.distances(centre);
        let low = distances.into_iter().fold(f64::INFINITY, f64::min);
        let high = distances.into_iter().fold(f64::NEG_INFINITY, f64::max);
        low <= reach && high >= -reach
    }
}
