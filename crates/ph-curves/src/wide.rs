//! Fits of class up to 14: curvature elements at both ends, up to nine tangents in between.

use glam::DVec2;

use crate::complex::{conj, sqrt};
use crate::course::{End, Interval};
use crate::fit::{Attempt, Fit, Fitter};
use crate::polynomial::{Newton, bernstein_5, binomials, is_positive, quintic};
use crate::{Arcs, PhArc, PlaneCurve, SupportJet};

/// Zeros of the ultraspherical polynomial of degree 4 for the weight `t^3 (1-t)^3`: the interpolation nodes of class 9.
pub(crate) const NODES: [f64; 4] = [0.1797, 0.387, 0.613, 0.8203];
/// Shares between these nodes, where the error of class 9 peaks; the other nodes of class 14.
pub(crate) const PEAKS: [f64; 5] = [0.1, 0.28, 0.5, 0.72, 0.9];
/// The share where errors of lower classes peak besides, which is not looked at where the error at the nodes times a larger
/// factor is small enough.
const MIDDLE: [f64; 1] = [0.5];
const SURE: f64 = 16.0;
/// Shares between the nodes of class 14, where its error peaks, twice at the ends.
const LATE_PEAKS: [f64; 12] = [
    0.02, 0.05, 0.14, 0.23, 0.333, 0.444, 0.556, 0.667, 0.77, 0.86, 0.95, 0.98,
];
/// Shares for arcs of class 9 over knots, where the error has other peaks.
pub(crate) const CLOSE: [f64; 15] = [
    0.03, 0.09, 0.14, 0.22, 0.28, 0.34, 0.44, 0.5, 0.56, 0.66, 0.72, 0.78, 0.86, 0.91, 0.97,
];
/// The true error exceeds that at the shares by a little: parts are not cut at vertices, where peaks move. The order makes
/// the factor cheap.
pub(crate) const PEAK: f64 = 2.0;
/// The same at the closer shares of class 14.
const LATE_PEAK: f64 = 1.3;
/// An error of class 9 above this many tolerances is too large for class 14 too.
const HOPELESS: f64 = 30.0;
/// Slack of rounding of a parameter outside of `[0, 1]`.
const SLACK: f64 = 1e-9;

/// The normals of an arc and its origin: the numerator of its support is a polynomial of the parameter of the normals.
pub(crate) struct Frame {
    /// Unit spinors of the end normals.
    pub(crate) spinors: [DVec2; 2],
    /// Sine and cosine of the angle between them.
    half_turning: (f64, f64),
    start: DVec2,
    pub(crate) origin: DVec2,
}

/// A tangent of the curve in a frame.
pub(crate) struct Sample {
    /// The parameter of its normal.
    pub(crate) t: f64,
    /// The numerator `p |w|^2` of its support.
    pub(crate) numerator: f64,
}

impl Frame {
    #[inline]
    pub(crate) fn new(start: &End, end: &End) -> Self {
        let turn = conj(start.normal).rotate(end.normal);
        let cosine = (0.5 * (1.0 + turn.x)).sqrt();
        let sine = 0.5 * turn.y / cosine;
        let spinor = sqrt(start.normal);
        Self {
            spinors: [spinor, spinor.rotate(DVec2::new(cosine, sine))],
            half_turning: (sine, cosine),
            start: start.normal,
            origin: start.point,
        }
    }

    /// The parameter of a unit normal, in `[0, 1]`.
    pub(crate) fn parameter(&self, normal: DVec2) -> Option<f64> {
        let Sample { t, .. } = self.sample(self.origin, normal.perp())?;
        Some(t.clamp(0.0, 1.0))
    }

    /// The tangent at a point with a velocity; none if its normal lies outside of the arc.
    #[inline]
    pub(crate) fn sample(&self, point: DVec2, velocity: DVec2) -> Option<Sample> {
        let Remainder { t, rest, .. } = self.remainder(&[0.0; 6], [[point, velocity]])?;
        Some(Sample {
            t: t[0],
            numerator: rest[0],
        })
    }

    /// Unit spinors h apart are at least cos(h/2) long in between: the square of that.
    pub(crate) const fn least_length(&self) -> f64 {
        0.5 * (1.0 + self.half_turning.1)
    }

    /// The numerator of the support with this jet, and its first two derivatives, at the parameter `t`.
    #[inline]
    pub(crate) fn numerator(&self, jet: &SupportJet, t: f64) -> [f64; 3] {
        let [w0, w1] = self.spinors;
        let dw = w1 - w0;
        let w = w0 + dw * t;
        let (q, dq, ddq) = (
            w.length_squared(),
            2.0 * w.dot(dw),
            2.0 * dw.length_squared(),
        );
        let rate = 2.0 * self.half_turning.0 / q;
        let slope = jet.slope * rate;
        let bend = jet.bend * rate * rate - slope * dq / q;
        [
            jet.support * q,
            slope * q + jet.support * dq,
            bend * q + 2.0 * slope * dq + jet.support * ddq,
        ]
    }

    /// The six conditions at the ends are met by a polynomial of degree 5.
    #[inline]
    fn ends(&self, start: &End, end: &End) -> [f64; 6] {
        let jet = |e: &End, sense: f64| {
            let jet = SupportJet::of_element(e.point - self.origin, e.normal, e.curvature.recip());
            let slope = sense * jet.slope;
            SupportJet { slope, ..jet }.numerator(self.half_turning)
        };
        quintic(jet(start, 1.0), jet(end, -1.0))
    }
}

/// What tangents of the curve leave over the quintic through the ends, in columns.
struct Remainder<const K: usize> {
    /// Parameters of the normals.
    t: [f64; K],
    /// `t^3 (1-t)^3`, which changes nothing at the ends up to second derivatives.
    weight: [f64; K],
    /// Numerators of the supports less the quintic.
    rest: [f64; K],
}

impl<const K: usize> Remainder<K> {
    /// The factors of the weight at the nodes.
    fn quotient(&self) -> [f64; K] {
        std::array::from_fn(|k| self.rest[k] / self.weight[k])
    }

    /// The largest difference from the weight times a factor.
    fn largest_beyond(&self, factor: impl Fn(f64) -> f64) -> f64 {
        let Self { t, weight, rest } = self;
        (0..K).fold(0.0, |most, k| {
            let difference: f64 = rest[k] - weight[k] * factor(t[k]);
            most.max(difference.abs())
        })
    }
}

impl Frame {
    /// What tangents at points with velocities leave over a quintic; none if a normal lies outside of the arc.
    #[inline]
    fn remainder<const K: usize>(
        &self,
        quintic: &[f64; 6],
        tangents: [[DVec2; 2]; K],
    ) -> Option<Remainder<K>> {
        let x = tangents.map(|[point, _]| point.x - self.origin.x);
        let y = tangents.map(|[point, _]| point.y - self.origin.y);
        let normal_x = tangents.map(|[_, velocity]| velocity.y);
        let normal_y = tangents.map(|[_, velocity]| -velocity.x);
        let ([w0, w1], (turn_y, turn_x)) = (self.spinors, self.half_turning);
        let (mut t, mut weight, mut rest) = ([0.0; K], [0.0; K], [0.0; K]);
        for k in 0..K {
            let speed = (normal_x[k] * normal_x[k] + normal_y[k] * normal_y[k]).sqrt();
            // The spinor of a normal bisects it and the start.
            let cosine = speed + self.start.x * normal_x[k] + self.start.y * normal_y[k];
            let sine = self.start.x * normal_y[k] - self.start.y * normal_x[k];
            let before = turn_y * cosine - turn_x * sine;
            let scale = 1.0 / (sine + before);
            let (s, beyond) = (before * scale, sine * scale);
            let (wx, wy) = (w0.x * s + w1.x * beyond, w0.y * s + w1.y * beyond);
            let away = normal_x[k] * x[k] + normal_y[k] * y[k];
            let numerator = away * (wx * wx + wy * wy) / speed;
            let product = s * beyond;
            t[k] = beyond;
            weight[k] = product * product * product;
            rest[k] = numerator - bernstein_5(quintic, s, beyond);
        }
        let inside = (0..K).all(|k| t[k] >= -SLACK && t[k] <= 1.0 + SLACK && rest[k].is_finite());
        inside.then_some(Remainder { t, weight, rest })
    }
}

/// What all fits of one interval start from.
struct Base<'a> {
    interval: &'a Interval,
    frame: Frame,
    /// The quintic that meets the conditions at the ends.
    quintic: [f64; 6],
    /// The error that is allowed for numerators of supports.
    allowed: f64,
}

impl Base<'_> {
    fn over_knots(&self) -> bool {
        self.interval.start.span < self.interval.end.span
    }

    fn attempt(&self, fit: Option<Fit>, error: f64, order: f64) -> Attempt {
        Attempt {
            fit,
            error: error / self.frame.least_length(),
            order,
        }
    }

    /// The arc of class 9 with the quintic and these coefficients of the factor; none if it may have a cusp.
    fn class_9(&self, factor: [f64; 4], error: f64, order: f64) -> Option<Attempt> {
        let arc = self.frame.arc(&self.quintic, &factor, &self.interval.end)?;
        Some(self.attempt(Some(Fit::Wide(arc)), error, order))
    }
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// One arc of class 9 or 14: six support coefficients from the elements at the ends, the others from tangents in between,
    /// which first tell whether a lower class would do.
    #[inline]
    pub(crate) fn wide(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let frame = Frame::new(start, end);
        let base = Base {
            quintic: frame.ends(start, end),
            allowed: self.how.tolerance * frame.least_length(),
            interval,
            frame,
        };
        let nodes = self.remainder(&base, NODES)?;
        let quotient = nodes.quotient();
        if !base.over_knots()
            && largest_gap(nodes.t) <= APART
            && let Some((line, error, order)) = self.low_class(&base, &nodes, quotient)
        {
            // Raised by two degrees.
            let (a, b) = (line[0], line[0] + line[1]);
            return base.class_9([a, 2.0 * a + b, a + 2.0 * b, b], error, order);
        }
        self.high_class(&base, &nodes, quotient)
    }

    /// The remainder at shares of the interval.
    #[inline(always)]
    fn remainder<const K: usize>(&self, base: &Base<'_>, shares: [f64; K]) -> Option<Remainder<K>> {
        let tangents = self.course.tangents(base.interval, shares);
        base.frame.remainder(&base.quintic, tangents)
    }

    /// The remainder over `t^3 (1-t)^3` as nothing, or as a line through the inner nodes, which is class 7, if that suffices: value
    /// and slope of the line, the error and its order.
    #[inline]
    fn low_class(
        &self,
        base: &Base<'_>,
        nodes: &Remainder<4>,
        [_, b, c, _]: [f64; 4],
    ) -> Option<([f64; 2], f64, f64)> {
        let slope = (c - b) / (nodes.t[2] - nodes.t[1]);
        let through = [b - slope * nodes.t[1], slope];
        for (line, order) in [([0.0; 2], 6.0), (through, 8.0)] {
            let at = |t: f64| line[0] + line[1] * t;
            let mut error = nodes.largest_beyond(at);
            if PEAK * error <= base.allowed {
                if SURE * error > base.allowed {
                    let middle = self.remainder(base, MIDDLE)?;
                    error = middle.largest_beyond(at).max(error);
                }
                return (PEAK * error <= base.allowed).then_some((line, PEAK * error, order));
            }
        }
        None
    }

    /// The remainder over `t^3 (1-t)^3` as a cubic through all four nodes, or else as a polynomial through these and five more.
    #[inline(never)] // It is large, and the lower classes are the quick way.
    fn high_class(
        &self,
        base: &Base<'_>,
        nodes: &Remainder<4>,
        quotient: [f64; 4],
    ) -> Option<Attempt> {
        let cubic = Newton::through(nodes.t, quotient);
        let peaks = self.remainder(base, PEAKS)?;
        let mut error = PEAK * peaks.largest_beyond(|t| cubic.value(t));
        let parameters = merged(nodes.t, peaks.t);
        if error <= base.allowed && (base.over_knots() || largest_gap(parameters) > CLOSE_APART) {
            let shares: &[f64] = if base.over_knots() { &CLOSE } else { &PEAKS };
            error = PEAK * self.largest_beyond(base, &cubic, shares, CLOSE_APART)?;
        }
        if error <= base.allowed {
            return base.class_9(cubic.homogeneous(), error, 10.0);
        }
        if self.how.arcs != Arcs::Class14 || error > HOPELESS * base.allowed {
            return Some(base.attempt(None, error, 10.0));
        }
        let octic = Newton::through(parameters, merged(quotient, peaks.quotient()));
        let late = self.remainder(base, LATE_PEAKS)?;
        let mut error = LATE_PEAK * late.largest_beyond(|t| octic.value(t));
        if error <= base.allowed && largest_gap(late.t) > LATE_APART {
            error = LATE_PEAK * self.largest_beyond(base, &octic, &LATE_PEAKS, LATE_APART)?;
        }
        if error > base.allowed {
            return Some(base.attempt(None, error, 15.0));
        }
        let factor = octic.homogeneous();
        let arc = base.frame.arc(&base.quintic, &factor, &base.interval.end)?;
        Some(base.attempt(Some(Fit::Wider(arc)), error, 15.0))
    }

    /// The largest error of an arc at shares of an interval, and in between where the parameters of normals are `apart`.
    fn largest_beyond<const K: usize>(
        &self,
        base: &Base<'_>,
        factor: &Newton<K>,
        shares: &[f64],
        apart: f64,
    ) -> Option<f64> {
        largest_between(shares, apart, |share| {
            let Remainder { t, weight, rest } = self.remainder(base, [share])?;
            Some((t[0], rest[0] - weight[0] * factor.value(t[0])))
        })
    }
}

/// What belongs to the nodes of class 9 and to the peaks between them, in the order of the curve.
fn merged([b, d, f, h]: [f64; 4], [a, c, e, g, i]: [f64; 5]) -> [f64; 9] {
    [a, b, c, d, e, f, g, h, i]
}

impl Frame {
    /// The arc whose support has this quintic and `t^3 (1-t)^3` times a polynomial, given by its coefficients of
    /// `s^(K-1-k) t^k`; none if it may have a cusp.
    #[inline]
    fn arc<const K: usize, const N: usize>(
        &self,
        quintic: &[f64; 6],
        factor: &[f64; K],
        end: &End,
    ) -> Option<PhArc<N>> {
        // The quintic raised: a product with a power of s + t.
        let (row, power) = const { (binomials::<N>(N - 1), binomials::<N>(N - 6)) };
        let mut g = [0.0; N];
        for (i, (c, binomial)) in quintic
            .iter()
            .zip([1.0, 5.0, 10.0, 10.0, 5.0, 1.0])
            .enumerate()
        {
            for j in 0..N - 5 {
                g[i + j] += c * binomial * power[j];
            }
        }
        for k in 0..K {
            g[3 + k] += factor[k];
        }
        for k in 0..N {
            g[k] /= row[k];
        }
        let arc = PhArc::from_parts(self.spinors[0], self.spinors[1], g);
        let radius = arc.radius_polynomial().map(|r| r * end.curvature);
        is_positive(&radius).then_some(arc)
    }
}

/// Parameters farther apart than this leave room for an error that samples do not show: those of a curve of slowly varying
/// curvature are about 0.2 apart.
pub(crate) const APART: f64 = 0.26;
/// The same where more samples are taken.
const CLOSE_APART: f64 = 0.16;
const LATE_APART: f64 = 0.13;
/// There samples are taken until parameters are as near as this, or the shares as near as that: a cusp.
const CLOSER: f64 = 0.1;
const LEAST_STEP: f64 = 1.0 / (1 << 24) as f64;

/// The largest gap between parameters in `[0, 1]`, and between them and the ends.
fn largest_gap<const K: usize>(t: [f64; K]) -> f64 {
    let (mut most, mut last) = (0.0_f64, 0.0);
    for t in t.into_iter().chain([1.0]) {
        most = most.max(t - last);
        last = t;
    }
    most
}

/// The largest error at increasing shares, and between two of them as long as their parameters in `[0, 1]` are far apart; `at` gives
/// parameter and error at a share.
pub(crate) fn largest_between(
    shares: &[f64],
    apart: f64,
    at: impl Fn(f64) -> Option<(f64, f64)>,
) -> Option<f64> {
    let (mut most, mut last) = (0.0_f64, (0.0, 0.0));
    let mut waiting = Vec::new();
    for share in shares.iter().copied().chain([1.0]) {
        let (t, error) = if share < 1.0 { at(share)? } else { (1.0, 0.0) };
        most = most.max(error.abs());
        if t - last.1 > apart {
            waiting.push([last, (share, t)]);
        }
        last = (share, t);
    }
    while let Some([from, to]) = waiting.pop() {
        let share = 0.5 * (from.0 + to.0);
        let (t, error) = at(share)?;
        most = most.max(error.abs());
        let halves = [[from, (share, t)], [(share, t), to]];
        let far =
            |[from, to]: &[(f64, f64); 2]| to.1 - from.1 > CLOSER && to.0 - from.0 > LEAST_STEP;
        waiting.extend(halves.into_iter().filter(far));
    }
    Some(most)
}
