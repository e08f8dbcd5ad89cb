//! The way along a curve of many spans: places, ends of intervals, and what a share of an interval is.

use glam::DVec2;

use crate::plane_curve::curvature;
use crate::{Break, BreakKind, Error, PlaneCurve, Side};

/// A first derivative below this share of the second is the rounding of one that vanishes.
const VANISHING: f64 = 1e-11;
/// Angle between tangents that makes a corner, far above the rounding of computed tangents.
const CORNER: f64 = 1e-9;
/// Rounding of a second derivative, in units of the last place of the largest coordinate.
const CURVATURE_ULPS: f64 = 256.0;
/// A turning of a span at its curvature at an end that is the rounding of zero curvature.
const NO_TURNING: f64 = 1e-11;
/// No end at whose curvature half of a span would turn by more is looked at more closely.
const NEARLY_FLAT: f64 = 0.05;
/// An end is nearest to an inflection within this share of half its span; there is one such end.
const NEAREST: f64 = 0.9;
/// Share of the tolerance that a curve may be moved by so that the curvature at the end of a span is zero.
const FLATTENED: f64 = 1e-3;
/// Relative difference of curvatures that is their rounding.
const SAME_CURVATURE: f64 = 1e-8;

/// One end of an interval: the curve's point, right-hand unit normal and signed curvature there, 0 at inflections and
/// infinite at cusps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    pub(crate) span: usize,
    /// Local parameter.
    pub(crate) t: f64,
    pub(crate) point: DVec2,
    pub(crate) normal: DVec2,
    pub(crate) curvature: f64,
}

impl End {
    /// The end at `t`, with the one-sided tangent where the derivative vanishes.
    #[inline]
    pub(crate) fn at<C: PlaneCurve + ?Sized>(
        curve: &C,
        span: usize,
        t: f64,
        side: Side,
    ) -> Result<Self, Error> {
        let [point, first, second] = curve.jet(span, t);
        // One sum for all: what is not finite, or overflows, stays so.
        if !(point + first + second).is_finite() {
            return Err(Error::NonFinite {
                what: "a point or derivative of the curve",
            });
        }
        let square = first.length_squared();
        let (direction, curvature) = if square <= VANISHING * VANISHING * second.length_squared() {
            let direction = curve.direction(span, t, side).normalize_or_zero();
            (direction, f64::INFINITY)
        } else {
            let speed = square.sqrt();
            (first / speed, first.perp_dot(second) / (square * speed))
        };
        let normal = -direction.perp();
        Ok(Self {
            span,
            t,
            point,
            normal,
            curvature,
        })
    }

    /// The end at a break, with the curvature that is meant there: computed values are rounding.
    pub(crate) fn at_break<C: PlaneCurve + ?Sized>(
        curve: &C,
        span: usize,
        cut: Break,
        side: Side,
    ) -> Result<Self, Error> {
        let end = Self::at(curve, span, cut.t, side)?;
        let curvature = match cut.kind {
            BreakKind::Inflection => 0.0,
            BreakKind::Cusp => f64::INFINITY.copysign(end.curvature),
            BreakKind::Vertex => end.curvature,
        };
        Ok(Self { curvature, ..end })
    }

    /// Whether an inflection is so near that it may as well be here: where the curvature rises from `k` with a rate `k'`, its zero is
    /// `s = k / k'` away, and in between the curve is `k s^2 / 3` from its tangent. `other` is the curvature at a distance.
    #[inline]
    fn is_flat(&self, other: f64, distance: f64, tolerance: f64) -> bool {
        let here = self.curvature;
        let away = here / (other - here) * distance;
        let near = away.abs() < NEAREST * distance;
        here.abs() * distance < NO_TURNING
            || (near && (here * away * away).abs() < FLATTENED * tolerance)
    }

    /// The turn of the normal from here to another end.
    #[inline]
    pub(crate) fn turning_to(&self, other: &Self) -> Turning {
        Turning {
            cosine: self.normal.dot(other.normal),
            sine: self.normal.perp_dot(other.normal),
        }
    }

    /// Span number plus local parameter.
    #[inline]
    pub(crate) fn parameter(&self) -> f64 {
        self.span as f64 + self.t
    }

    /// Whether another end lies farther on.
    #[inline]
    pub(crate) fn is_before(&self, other: &Self) -> bool {
        self.span < other.span || (self.span == other.span && self.t < other.t)
    }

    /// Whether a curve goes on in `next` with the same tangent.
    #[inline]
    pub(crate) fn is_tangent_to(&self, next: &Self) -> bool {
        let Turning { cosine, sine } = self.turning_to(next);
        cosine > 0.0 && sine.abs() <= CORNER
    }

    /// Whether the curvature is the same in `next`.
    #[inline]
    pub(crate) fn has_curvature_of(&self, next: &Self) -> bool {
        let (a, b) = (self.curvature, next.curvature);
        a == b || (a - b).abs() <= SAME_CURVATURE * a.abs().max(b.abs())
    }
}

/// The angle between two unit normals.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning {
    pub(crate) cosine: f64,
    pub(crate) sine: f64,
}

/// Cosine of the largest turning of one arc, somewhat below the half turn at which arcs end to exist.
const MOST_TURNING_COSINE: f64 = -0.94;

impl Turning {
    /// Whether one arc can turn so far.
    #[inline]
    pub(crate) fn is_moderate(&self) -> bool {
        self.cosine > MOST_TURNING_COSINE
    }
}

/// A part of a curve without corner; for arcs of class 3 also without inflection, vertex and knot inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub(crate) start: End,
    pub(crate) end: End,
}

/// A curve with the ends of its spans, and with their approximate lengths, by which places on several spans are measured.
pub(crate) struct Course<'a, C: ?Sized> {
    pub(crate) curve: &'a C,
    /// Start and end of every span.
    ends: Vec<[End; 2]>,
    /// Length before every span, and of the whole.
    before: Vec<f64>,
    /// Rounding of its largest coordinate.
    pub(crate) rounding: f64,
}

impl<'a, C: PlaneCurve + ?Sized> Course<'a, C> {
    /// The course of a curve that is to be approximated within `tolerance`.
    pub(crate) fn new(curve: &'a C, tolerance: f64) -> Result<Self, Error> {
        let mut ends = Vec::with_capacity(curve.spans());
        let mut before = Vec::with_capacity(curve.spans() + 1);
        let (mut largest, mut length) = (DVec2::ZERO, 0.0);
        before.push(length);
        for span in 0..curve.spans() {
            let mut start = End::at(curve, span, 0.0, Side::After)?;
            let mut end = End::at(curve, span, 1.0, Side::Before)?;
            let [middle, first, second] = curve.jet(span, 0.5);
            let halves = [start, end].map(|end| (middle - end.point).length());
            length += halves[0] + halves[1];
            if !length.is_finite() {
                return Err(Error::NonFinite {
                    what: "a point of the curve",
                });
            }
            let farthest = start.point.abs().max(end.point.abs());
            largest = largest.max(farthest).max(middle.abs());
            for (end, half) in [&mut start, &mut end].into_iter().zip(halves) {
                let nearly = end.curvature.abs() * half < NEARLY_FLAT;
                if nearly && end.is_flat(curvature(first, second), half, tolerance) {
                    end.curvature = 0.0;
                }
            }
            ends.push([start, end]);
            before.push(length);
        }
        let largest = largest.max_element();
        let rounding = f64::EPSILON * largest;
        let mut course = Self {
            curve,
            ends,
            before,
            rounding,
        };
        for knot in 1..course.ends.len() {
            course.unify(knot - 1, knot);
        }
        if curve.is_closed() {
            course.unify(course.ends.len() - 1, 0);
        }
        Ok(course)
    }

    /// Gives the end of one span and the start of another the same curvature if theirs differ by rounding.
    #[inline]
    fn unify(&mut self, before: usize, after: usize) {
        let [end, start] = [self.ends[before][1], self.ends[after][0]];
        let is_rounding = |difference: f64| {
            let length = |span: usize| self.before[span + 1] - self.before[span];
            let shortest = length(before).min(length(after));
            difference.abs() <= CURVATURE_ULPS * self.rounding / (shortest * shortest)
        };
        let same = || end.has_curvature_of(&start) || is_rounding(end.curvature - start.curvature);
        if end.is_tangent_to(&start) && same() {
            self.ends[after][0].curvature = end.curvature;
        }
    }

    /// Start and end of a span.
    #[inline]
    pub(crate) fn ends(&self, span: usize) -> [End; 2] {
        self.ends[span]
    }

    /// Length from the start of the curve.
    #[inline]
    pub(crate) fn length_to(&self, end: &End) -> f64 {
        let [from, to] = [self.before[end.span], self.before[end.span + 1]];
        from + (to - from) * end.t
    }

    /// Span and local parameter at a length from the start of the curve, on the spans from `span` to that of `end`.
    #[inline]
    fn place(&self, mut span: usize, end: &End, length: f64) -> (usize, f64) {
        while span < end.span && self.before[span + 1] <= length {
            span += 1;
        }
        let [from, to] = [self.before[span], self.before[span + 1]];
        let t = (length - from) / (to - from);
        // A span may be a point.
        (
            span,
            if t.is_finite() {
                t.clamp(0.0, 1.0)
            } else {
                0.5
            },
        )
    }

    /// Span and local parameter at a share of an interval.
    #[inline]
    fn share(&self, interval: &Interval, share: f64) -> (usize, f64) {
        let Interval { start, end } = interval;
        if start.span == end.span {
            return (start.span, start.t + (end.t - start.t) * share);
        }
        let (from, to) = (self.length_to(start), self.length_to(end));
        self.place(start.span, end, from + (to - from) * share)
    }

    /// Point and first two derivatives at a share of an interval.
    #[inline]
    pub(crate) fn jet(&self, interval: &Interval, share: f64) -> [DVec2; 3] {
        let (span, t) = self.share(interval, share);
        self.curve.jet(span, t)
    }

    /// Points and first derivatives at increasing shares of an interval.
    #[inline]
    pub(crate) fn tangents<const K: usize>(
        &self,
        interval: &Interval,
        shares: [f64; K],
    ) -> [[DVec2; 2]; K] {
        let Interval { start, end } = interval;
        let mut tangents = [[DVec2::ZERO; 2]; K];
        let tangent = |span: usize, t: f64| {
            let [point, first, _] = self.curve.jet(span, t);
            [point, first]
        };
        if start.span == end.span {
            for k in 0..K {
                tangents[k] = tangent(start.span, start.t + (end.t - start.t) * shares[k]);
            }
        } else {
            let (from, to) = (self.length_to(start), self.length_to(end));
            let mut span = start.span;
            for k in 0..K {
                let (here, t) = self.place(span, end, from + (to - from) * shares[k]);
                tangents[k] = tangent(here, t);
                span = here;
            }
        }
        tangents
    }

    /// The same with the parameter there.
    pub(crate) fn jet_at(&self, interval: &Interval, share: f64) -> (f64, [DVec2; 3]) {
        let (span, t) = self.share(interval, share);
        (span as f64 + t, self.curve.jet(span, t))
    }

    /// The end at a share of an interval.
    pub(crate) fn end_at(&self, interval: &Interval, share: f64) -> Result<End, Error> {
        let (span, t) = self.share(interval, share);
        End::at(self.curve, span, t, Side::Before)
    }

    /// The last knot inside an interval within a length of its start.
    #[inline]
    pub(crate) fn last_knot(&self, interval: &Interval, length: f64) -> Option<End> {
        let Interval { start, end } = interval;
        let limit = self.length_to(start) + length;
        let knots = &self.before[start.span + 1..=end.span];
        let within = knots.iter().take_while(|knot| **knot <= limit).count();
        (within > 0).then(|| self.ends[start.span + within - 1][1])
    }

    /// The first part of an interval, to the end of its first span.
    #[inline]
    pub(crate) fn to_first_knot(&self, interval: &Interval) -> Interval {
        let Interval { start, end } = *interval;
        if start.span == end.span {
            return *interval;
        }
        let [_, end] = self.ends[start.span];
        Interval { start, end }
    }

    /// The interval that is left from `start` on; from a knot on it starts in the next span.
    #[inline]
    pub(crate) fn rest(&self, interval: &Interval, mut start: End) -> Interval {
        if start.t == 1.0 && start.span < interval.end.span {
            start.span += 1;
            start.t = 0.0;
        }
        Interval {
            start,
            end: interval.end,
        }
    }

    /// Length of an interval.
    #[inline]
    pub(crate) fn length(&self, interval: &Interval) -> f64 {
        self.length_to(&interval.end) - self.length_to(&interval.start)
    }
}
