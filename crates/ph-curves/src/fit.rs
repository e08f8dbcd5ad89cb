//! What replaces a part of a curve, and how far it is from it.

use glam::DVec2;

use crate::curvature_element::EQUAL_RADII;
use crate::plane_curve::curvature;
use crate::{
    Approximation, Arcs, BreakKind, CurvatureElement, Error, G1Ends, G2Pair, InflectedArc, Joint,
    LineElement, PhArc, PlaneCurve, Side, TQuartic,
};

/// Cosine of the largest turning of one attempt, somewhat below the half turn at which arcs end to exist.
const MOST_TURNING_COSINE: f64 = -0.94;
/// Turning below which the radii at a joint lose their digits (relative error some eps / h): G1 arcs.
const LEAST_G2_TURNING: f64 = 1e-7;
/// Turning below which there are no arcs, but corners and segments.
const LEAST_TURNING: f64 = 1e-12;
/// A radius of more than so many chords counts as that of an inflection.
const FLAT: f64 = 1e7;
/// A radius of less than this share of the chord counts as that of a cusp: its digits are lost in those of the arc.
const SHARP: f64 = 1e-6;
/// Interior samples of the error per attempt, over both arcs of a pair.
const SAMPLES: usize = 6;
/// The true error exceeds the sampled one by a little; measured up to 1.15 on a thousand random splines.
const PEAK: f64 = 1.16;
/// The same where arcs of class 9 are wanted: parts are not cut at vertices.
const UNCUT_PEAK: f64 = 2.0;

/// A first derivative below this share of the second is the rounding of one that vanishes.
const VANISHING: f64 = 1e-11;

/// One end of an interval: the curve's point, right-hand unit normal and signed curvature there, 0 at inflections and
/// infinite at cusps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    pub(crate) t: f64,
    pub(crate) point: DVec2,
    pub(crate) normal: DVec2,
    pub(crate) curvature: f64,
}

impl End {
    /// The end at `t`, with the one-sided tangent where the derivative vanishes.
    pub(crate) fn at<C: PlaneCurve + ?Sized>(
        curve: &C,
        span: usize,
        t: f64,
        side: Side,
    ) -> Result<Self, Error> {
        let [point, first, second] = curve.jet(span, t);
        if !(point.is_finite() && first.is_finite() && second.is_finite()) {
            return Err(Error::NonFinite {
                what: "a point or derivative of the curve",
            });
        }
        let vanished = first.length_squared() <= VANISHING * VANISHING * second.length_squared();
        let direction = if vanished {
            curve.direction(span, t, side)
        } else {
            first
        };
        let normal = -direction.normalize_or_zero().perp();
        let curvature = if vanished {
            f64::INFINITY
        } else {
            curvature(first, second)
        };
        Ok(Self {
            t,
            point,
            normal,
            curvature,
        })
    }
}

/// The curvature that is meant at a break: computed values there are rounding.
pub(crate) fn tagged(curvature: f64, kind: BreakKind) -> f64 {
    match kind {
        BreakKind::Inflection => 0.0,
        BreakKind::Cusp => f64::INFINITY.copysign(curvature),
        BreakKind::Vertex => curvature,
    }
}

/// Whether a curvature is neither zero nor infinite.
pub(crate) fn regular(curvature: f64) -> bool {
    curvature != 0.0 && curvature.is_finite()
}

/// A part of a span without inflection; for arcs of class 3 also without vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub(crate) span: usize,
    pub(crate) start: End,
    pub(crate) end: End,
    pub(crate) depth: u32,
}

/// What replaces an interval of the curve; arcs are about its start point.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Fit {
    /// Two arcs of class 3 with the curve's curvatures at both ends.
    Pair([TQuartic; 2]),
    /// One arc of class 3 with the curve's tangents.
    Single(TQuartic),
    /// One arc of class 9 with the curve's curvatures at both ends.
    Wide(PhArc<10>),
    /// The same with an inflection at one end; about the origin of the plane.
    Inflected(InflectedArc),
    /// A corner, a segment and a corner.
    Bridge,
}

/// An attempt: the fit, its measured error, and whether its end curvatures are those of the curve.
pub(crate) struct Attempt {
    pub(crate) fit: Fit,
    pub(crate) error: f64,
    pub(crate) matched: bool,
}

/// Finds a fit for intervals of a curve.
pub(crate) struct Fitter<'a, C: ?Sized> {
    pub(crate) curve: &'a C,
    pub(crate) how: &'a Approximation,
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// The best fit of one interval with its measured error; none if there is no arc.
    pub(crate) fn attempt(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end, .. } = interval;
        let chord = (end.point - start.point).length();
        let cosine = start.normal.dot(end.normal);
        let sine = start.normal.perp_dot(end.normal);
        if sine.abs() > LEAST_TURNING && cosine > MOST_TURNING_COSINE {
            let resolved = (FLAT.recip() / chord)..(SHARP.recip() / chord);
            let curvatures = [start.curvature, end.curvature];
            let [curved_start, curved_end] = curvatures.map(|c| resolved.contains(&c.abs()));
            let elements = curved_start && curved_end && start.curvature * end.curvature > 0.0;
            // One end may be an inflection, if the other is curved.
            let inflected = (curved_start || curved_end) && start.curvature * end.curvature == 0.0;
            let turns = sine.abs() > LEAST_G2_TURNING;
            let curved = match self.how.arcs {
                Arcs::Class3 if turns && elements && self.how.continuity == Joint::G2 => {
                    self.pair(interval)
                }
                Arcs::Class9 if turns && (elements || inflected) => self.wide(interval),
                _ => None,
            };
            if let Some(attempt) = curved.or_else(|| self.single(interval, chord)) {
                return Some(attempt);
            }
        }
        self.bridge(interval, chord)
    }

    /// Two arcs of class 3 with the curvatures of the ends.
    fn pair(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end, .. } = interval;
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
            let beyond = joint.perp_dot(normal) * sense > 0.0;
            probes[usize::from(beyond)].support(normal)
        })?;
        Some(Attempt {
            fit: Fit::Pair(pair.arcs),
            error,
            matched: true,
        })
    }

    /// One arc of class 3 with G1 contact, its shape fitted to inner tangents.
    fn single(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval { start, end, .. } = interval;
        let element = |e: &End| LineElement::from_unit(e.point - start.point, e.normal);
        let ends = G1Ends::between(element(start), element(end));
        let samples = [0.25, 0.5, 0.75].map(|share| self.tangent(interval, share));
        let alpha = ends.clamp_alpha(ends.fit_alpha(samples)).ok()?;
        let arc = ends.arc_of_positive(alpha);
        let probe = Probe::new(&arc);
        let error =
            self.largest_difference(interval, &EVEN_SHARES, |normal| probe.support(normal))?;
        let [r0, r1] = ends.end_radii(alpha);
        let agrees = |radius: f64, curvature: f64| {
            (radius * curvature - 1.0).abs() <= EQUAL_RADII.max(f64::EPSILON * radius.abs() / chord)
        };
        let matched = agrees(r0, start.curvature) && agrees(r1, end.curvature);
        Some(Attempt {
            fit: Fit::Single(arc),
            error,
            matched,
        })
    }

    /// A corner, a segment and a corner: right where all of the interval is closer to its chord than the tolerance.
    fn bridge(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval {
            span, start, end, ..
        } = *interval;
        let along = (end.point - start.point).try_normalize();
        let mut error = 0.0_f64;
        for share in EVEN_SHARES {
            let [point, ..] = self.curve.jet(span, start.t + (end.t - start.t) * share);
            let from = point - start.point;
            let distance = along.map_or(from.length(), |along| {
                let nearest = along * from.dot(along).clamp(0.0, chord);
                (from - nearest).length()
            });
            error = error.max(distance);
        }
        // A segment replaces a turning curve only where nothing of it can be seen; the factor leaves room for what the
        // samples miss on a piece that may loop.
        let error = 2.0 * error;
        (error <= self.how.tolerance).then_some(Attempt {
            fit: Fit::Bridge,
            error,
            matched: false,
        })
    }

    /// Unit normal and support about the start point of the interval, at a share of its parameters.
    #[inline]
    fn tangent(&self, interval: &Interval, share: f64) -> (DVec2, f64) {
        let (t0, t1) = (interval.start.t, interval.end.t);
        let [point, first, _] = self.curve.jet(interval.span, t0 + (t1 - t0) * share);
        let normal = -first.normalize_or_zero().perp();
        (normal, normal.dot(point - interval.start.point))
    }

    /// Largest difference of supports at inner samples; none if a normal of the curve does not occur on the arcs.
    #[inline]
    fn largest_difference(
        &self,
        interval: &Interval,
        shares: &[f64],
        fitted: impl Fn(DVec2) -> Option<f64>,
    ) -> Option<f64> {
        let mut error = 0.0_f64;
        for &share in shares {
            let (normal, support) = self.tangent(interval, share);
            error = error.max((fitted(normal)? - support).abs());
        }
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

    #[inline]
    fn support(&self, normal: DVec2) -> Option<f64> {
        let (s, t) = self.parameter(normal)?;
        let [g0, g1, g2, g3] = self.g;
        let value = s * s * (s * g0 + 3.0 * t * g1) + t * t * (3.0 * s * g2 + t * g3);
        Some(value / (self.w0 * s + self.w1 * t).length_squared())
    }
}
