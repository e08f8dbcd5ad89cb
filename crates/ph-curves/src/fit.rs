//! What replaces a part of a curve, and how far it is from it.

use glam::DVec2;

use crate::course::{Course, End, Interval, Turning};
use crate::curvature_element::EQUAL_RADII;
use crate::wide::{APART, largest_between};
use crate::{
    Approximation, Arcs, CurvatureElement, G1Ends, G2Pair, InflectedArc, Joint, LineElement, PhArc,
    PlaneCurve, Side, TQuartic,
};

/// The curvature falls at least to this share on an interval that lies near to an inflection.
const FALLING: f64 = 0.5;
/// Inflections outside of an interval count if they are nearer than this share of it.
pub(crate) const NEAR: f64 = 1.0;
/// Turning below which the radii at a joint lose their digits (relative error some eps / h): G1 arcs.
const LEAST_G2_TURNING: f64 = 1e-7;
/// Turning below which there are no arcs, but corners and segments.
const LEAST_TURNING: f64 = 1e-12;
/// A radius of more than so many chords counts as that of an inflection.
const FLAT: f64 = 1e7;
/// A radius of less than this share of the chord counts as that of a cusp: its digits are lost in those of the arc.
const SHARP: f64 = 1e-6;
/// Steps at whose ends the distance from a segment is measured.
const STEPS: usize = 12;
/// Interior samples of the error per attempt, over both arcs of a pair.
const SAMPLES: usize = 6;
/// The true error exceeds the sampled one by a little; certified up to 1.18 on thousands of random splines.
const PEAK: f64 = 1.25;
/// The same where arcs of other classes are wanted: parts are not cut at vertices.
const UNCUT_PEAK: f64 = 2.0;

/// What replaces an interval of the curve; arcs are about its start point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fit {
    /// Two arcs of class 3 with the curve's curvatures at both ends.
    Pair([TQuartic; 2]),
    /// One arc of class 3 with the curve's tangents, and whether its end curvatures are those of the curve too.
    Single { arc: TQuartic, matched: bool },
    /// One arc of class 9 with the curve's curvatures at both ends.
    Wide(PhArc<10>),
    /// The same of class 14.
    Wider(PhArc<15>),
    /// The same about an inflection; not about the start point.
    Inflected(InflectedArc),
    /// A corner, a segment and a corner.
    Bridge,
}

/// An attempt: its measured error with the power of the length by which it falls.
pub(crate) struct Attempt {
    /// None above the tolerance, where nobody asks for it.
    pub(crate) fit: Option<Fit>,
    pub(crate) error: f64,
    pub(crate) order: f64,
}

impl Attempt {
    /// Where there is no arc.
    pub(crate) const NONE: Self = Self {
        fit: None,
        error: f64::INFINITY,
        order: 1.0,
    };
}

/// Finds a fit for intervals of a curve.
pub(crate) struct Fitter<'a, C: ?Sized> {
    pub(crate) course: Course<'a, C>,
    pub(crate) how: &'a Approximation,
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// The best fit of one interval with its measured error, if there is an arc. At most one inflection lies inside the
    /// interval, or one is near to it: the given one.
    #[inline]
    pub(crate) fn attempt(&self, interval: &Interval, inflection: Option<&End>) -> Attempt {
        let Interval { start, end } = interval;
        let chord = (end.point - start.point).length();
        let flat = [start, end].into_iter().find(|end| end.curvature == 0.0);
        let inflection = inflection.or(flat);
        let contains = |inflection: &&End| {
            let range = start.parameter()..=end.parameter();
            range.contains(&inflection.parameter())
        };
        let within = inflection.filter(contains);
        if let Some(attempt) = self.smooth(interval, inflection, within, chord) {
            return attempt;
        }
        self.single_or_none(interval, within, chord)
            .or_else(|| {
                // Shorter pieces may do better than a segment over knots.
                (start.span == end.span).then(|| self.bridge(interval, chord))?
            })
            .unwrap_or(Attempt::NONE)
    }

    /// A fit with the curvatures of the ends; the inflection given a second time if it lies within the interval.
    #[inline]
    fn smooth(
        &self,
        interval: &Interval,
        inflection: Option<&End>,
        within: Option<&End>,
        chord: f64,
    ) -> Option<Attempt> {
        if self.how.arcs != Arcs::Class3 {
            if let Some(inflection) = within {
                return self.about(interval, inflection);
            }
            let beside = self
                .beside(interval, inflection)
                .filter(|attempt| attempt.error <= self.how.tolerance);
            if beside.is_some() {
                return beside;
            }
        }
        self.element_to_element(interval, chord)
    }

    /// An arc of class 3 where it is the best that there is: for other classes only where an end has no curvature that could be matched.
    fn single_or_none(
        &self,
        interval: &Interval,
        inflection: Option<&End>,
        chord: f64,
    ) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let inside = inflection.is_some_and(|inflection| {
            let at = inflection.parameter();
            start.parameter() < at && at < end.parameter()
        });
        let turning = start.turning_to(end);
        let matchable = self.how.arcs != Arcs::Class3
            && turning.sine.abs() > LEAST_G2_TURNING
            && [start, end]
                .iter()
                .all(|end| end.curvature == 0.0 || Self::is_curved(end, chord));
        let possible = turning.sine.abs() > LEAST_TURNING && turning.is_moderate();
        (possible && !inside && !matchable).then(|| self.single(interval, chord))?
    }

    /// Whether an end has a curvature that arcs of this chord can have.
    fn is_curved(end: &End, chord: f64) -> bool {
        (FLAT.recip()..SHARP.recip()).contains(&(end.curvature.abs() * chord))
    }

    /// Arcs without inflection with the curvatures of the ends.
    fn element_to_element(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let turning = start.turning_to(end);
        let elements = [start, end].iter().all(|end| Self::is_curved(end, chord))
            && start.curvature * end.curvature > 0.0;
        if !(elements && turning.is_moderate() && turning.sine.abs() > LEAST_G2_TURNING) {
            return None;
        }
        match (self.how.arcs, self.how.continuity) {
            (Arcs::Class3, Joint::G2) => self.pair(interval),
            (Arcs::Class3, _) => None,
            (Arcs::Class9 | Arcs::Class14, _) => self.wide(interval),
        }
    }

    /// An arc about an inflection, where its other ends are curved.
    fn about(&self, interval: &Interval, inflection: &End) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let chord = (end.point - inflection.point)
            .length()
            .max((start.point - inflection.point).length());
        let at = inflection.parameter();
        let curved = |end: &End| end.parameter() == at || Self::is_curved(end, chord);
        let turnings = [start, end].map(|end| inflection.turning_to(end));
        let turns = turnings
            .iter()
            .any(|turning| turning.sine.abs() > LEAST_G2_TURNING);
        let possible = curved(start)
            && curved(end)
            && (start.curvature != 0.0 || end.curvature != 0.0)
            && turnings.iter().all(Turning::is_moderate)
            && turns;
        possible.then(|| self.inflected(interval, inflection))?
    }

    /// An arc about an inflection near the interval: that of the continuation of the span if there is one, or the given one.
    fn beside(&self, interval: &Interval, inflection: Option<&End>) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let curvatures = [start.curvature.abs(), end.curvature.abs()];
        if curvatures[0].min(curvatures[1]) > FALLING * curvatures[0].max(curvatures[1]) {
            return None;
        }
        let continued = (start.span == end.span)
            .then(|| self.continued_inflection(start.span, [start.t, end.t]))
            .flatten();
        self.about(interval, continued.as_ref().or(inflection)?)
    }

    /// The nearest inflection of the continuation of a span beside a range of its parameter.
    fn continued_inflection(&self, span: usize, [from, to]: [f64; 2]) -> Option<End> {
        let curve = self.course.curve;
        let away = |t: f64| (from - t).max(t - to);
        let nearest = curve
            .continued_inflections(span)
            .into_iter()
            .flatten()
            .filter(|t| away(*t) > 0.0)
            .min_by(|a, b| away(*a).total_cmp(&away(*b)))
            .filter(|t| away(*t) <= NEAR * (to - from))?;
        let end = End::at(curve, span, nearest, Side::Before).ok()?;
        Some(End {
            curvature: 0.0,
            ..end
        })
    }

    /// Two arcs of class 3 with the curvatures of the ends.
    fn pair(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let difference = (start.curvature - end.curvature).abs();
        if difference <= EQUAL_RADII * start.curvature.abs().max(end.curvature.abs()) {
            return None;
        }
        let element = |e: &End| {
            CurvatureElement::from_unit(e.point - start.point, e.normal, e.curvature.recip())
        };
        let pair = G2Pair::new(&element(start), &element(end), self.how.beta).ok()?;
        let probes = pair.arcs.map(|arc| Probe::new(&arc));
        let joint = pair.joint.normal();
        let sense = start.normal.perp_dot(joint);
        let error = self.largest_difference(interval, &EVEN_SHARES, |normal| {
            let beyond = usize::from(joint.perp_dot(normal) * sense > 0.0);
            probes[beyond].support(normal)
        })?;
        Some(Attempt {
            fit: Some(Fit::Pair(pair.arcs)),
            error,
            order: 5.0,
        })
    }

    /// One arc of class 3 with G1 contact, its shape fitted to inner tangents.
    fn single(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let element = |e: &End| LineElement::from_unit(e.point - start.point, e.normal);
        let ends = G1Ends::between(element(start), element(end));
        let samples = [0.25, 0.5, 0.75].map(|share| self.tangent(interval, share));
        let alpha = ends.clamp_alpha(ends.fit_alpha(samples)).ok()?;
        let arc = ends.arc_of_positive(alpha);
        let [r0, r1] = arc.end_radii();
        // Nearly equal legs can leave a shape, and with it a cusp, that is rounding.
        if r0 * r1 < 0.0 {
            return None;
        }
        let probe = Probe::new(&arc);
        let error =
            self.largest_difference(interval, &EVEN_SHARES, |normal| probe.support(normal))?;
        let agrees = |radius: f64, curvature: f64| {
            (radius * curvature - 1.0).abs() <= EQUAL_RADII.max(f64::EPSILON * radius.abs() / chord)
        };
        let matched = agrees(r0, start.curvature) && agrees(r1, end.curvature);
        Some(Attempt {
            fit: Some(Fit::Single { arc, matched }),
            error,
            order: 4.0,
        })
    }

    /// A corner, a segment and a corner: right where all of the interval is closer to its chord than the tolerance.
    fn bridge(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval { start, end } = *interval;
        let along = (end.point - start.point).try_normalize();
        let (mut error, mut acceleration) = (0.0_f64, 0.0_f64);
        for k in 0..=STEPS {
            let share = k as f64 / STEPS as f64;
            let [point, _, second] = self.course.jet(interval, share);
            let from = point - start.point;
            let distance = along.map_or(from.length(), |along| {
                let nearest = along * from.dot(along).clamp(0.0, chord);
                (from - nearest).length()
            });
            error = error.max(distance);
            acceleration = acceleration.max(second.length());
        }
        // In between the curve is no farther from its chords; on cubics the second derivative is largest at an end.
        let step = (end.t - start.t) / STEPS as f64;
        let error = error + 0.125 * step * step * acceleration;
        (error <= self.how.tolerance).then_some(Attempt {
            fit: Some(Fit::Bridge),
            error,
            order: 2.0,
        })
    }

    /// Unit normal and support about the start point of the interval, at a share of its parameters.
    #[inline]
    fn tangent(&self, interval: &Interval, share: f64) -> (DVec2, f64) {
        let [point, first, _] = self.course.jet(interval, share);
        let normal = -first.normalize_or_zero().perp();
        (normal, normal.dot(point - interval.start.point))
    }

    /// Largest difference of supports at inner samples, and in between where the normals turn much; none if a normal of the curve
    /// does not occur on the arcs. `fitted` gives their support at a normal.
    #[inline]
    fn largest_difference(
        &self,
        interval: &Interval,
        shares: &[f64],
        fitted: impl Fn(DVec2) -> Option<f64>,
    ) -> Option<f64> {
        let start = interval.start.normal;
        // The tangent of half the turning is that for parameters of arcs of any shape.
        let turned = |normal: DVec2| start.perp_dot(normal) / (1.0 + start.dot(normal));
        let scale = turned(interval.end.normal).recip();
        let error = largest_between(shares, APART, |share| {
            let (normal, support) = self.tangent(interval, share);
            Some((scale * turned(normal), fitted(normal)? - support))
        })?;
        Some(if self.how.arcs == Arcs::Class3 {
            PEAK * error
        } else {
            UNCUT_PEAK * error
        })
    }
}

/// Shares at which the error of arcs of class 3 is sampled.
const EVEN_SHARES: [f64; SAMPLES] = [
    1.0 / 7.0,
    2.0 / 7.0,
    3.0 / 7.0,
    4.0 / 7.0,
    5.0 / 7.0,
    6.0 / 7.0,
];
/// An arc of class 3 prepared for many evaluations of its support by the normal.
struct Probe {
    w0: DVec2,
    w1: DVec2,
    start: DVec2,
    g: [f64; 4],
}

impl Probe {
    /// Barycentric parameter `(1 - t, t)` of a unit normal; none (but for a slack of rounding) outside of the arc.
    #[inline]
    fn parameter(&self, normal: DVec2) -> Option<(f64, f64)> {
        let (cosine, sine) = (self.start.dot(normal), self.start.perp_dot(normal));
        let spinor = self.w0.rotate(DVec2::new(1.0 + cosine, sine));
        let (a, b) = (self.w0.perp_dot(spinor), spinor.perp_dot(self.w1));
        let scale = 1.0 / (a + b);
        let (t, s) = (a * scale, b * scale);
        (t >= -1e-9 && s >= -1e-9).then_some((s, t))
    }

    fn new(arc: &TQuartic) -> Self {
        let (w0, w1) = arc.spinors();
        Self {
            w0,
            w1,
            start: arc.normal(0.0),
            g: *arc.coefficients(),
        }
    }

    /// Support at a unit normal.
    #[inline]
    fn support(&self, normal: DVec2) -> Option<f64> {
        let (s, t) = self.parameter(normal)?;
        let [g0, g1, g2, g3] = self.g;
        let value = s * s * (s * g0 + 3.0 * t * g1) + t * t * (3.0 * s * g2 + t * g3);
        Some(value / (self.w0 * s + self.w1 * t).length_squared())
    }
}
