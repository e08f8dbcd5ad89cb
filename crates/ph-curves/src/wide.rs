//! Fits of class up to 9: curvature elements at both ends, up to four tangents in between.

use glam::DVec2;

use crate::complex::{conj, sqrt};
use crate::course::{End, Interval};
use crate::fit::{Attempt, Fit, Fitter};
use crate::{PhArc, PlaneCurve, SupportJet};

/// Zeros of the ultraspherical polynomial of degree 4 for the weight `t^3 (1-t)^3`: the interpolation nodes.
pub(crate) const NODES: [f64; 4] = [0.1797, 0.387, 0.613, 0.8203];
/// Shares between these nodes, where the error peaks.
pub(crate) const PEAKS: [f64; 5] = [0.1, 0.28, 0.5, 0.72, 0.9];
/// The same, closer, for arcs that run over knots, where the error has other peaks.
pub(crate) const CLOSE: [f64; 15] = [
    0.03, 0.09, 0.14, 0.22, 0.28, 0.34, 0.44, 0.5, 0.56, 0.66, 0.72, 0.78, 0.86, 0.91, 0.97,
];
/// The true error exceeds that at the shares by a little: parts are not cut at vertices, where peaks move. The order makes
/// the factor cheap.
pub(crate) const PEAK: f64 = 2.0;
/// Slack of rounding of a parameter outside of `[0, 1]`.
const SLACK: f64 = 1e-9;
/// Binomial coefficients of degree 9.
const BINOMIALS: [f64; 10] = [1.0, 9.0, 36.0, 84.0, 126.0, 126.0, 84.0, 36.0, 9.0, 1.0];

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
    /// Barycentric parameter `(1 - t, t)` of its normal.
    s: f64,
    pub(crate) t: f64,
    /// The numerator `p |w|^2` of its support.
    pub(crate) numerator: f64,
}

impl Frame {
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

    /// Barycentric parameter `(1 - t, t)` of a normal of length `length`; none (but for a slack of rounding) outside of the arc.
    #[inline]
    fn barycentric(&self, normal: DVec2, length: f64) -> Option<(f64, f64)> {
        let [w0, w1] = self.spinors;
        // The spinor of a normal bisects it and the start.
        let turn = DVec2::new(length + self.start.dot(normal), self.start.perp_dot(normal));
        let spinor = w0.rotate(turn);
        let (a, b) = (w0.perp_dot(spinor), spinor.perp_dot(w1));
        let scale = 1.0 / (a + b);
        let (t, s) = (a * scale, b * scale);
        (t >= -SLACK && s >= -SLACK).then_some((s, t))
    }

    /// The parameter of a unit normal, in `[0, 1]`.
    pub(crate) fn parameter(&self, normal: DVec2) -> Option<f64> {
        self.barycentric(normal, 1.0)
            .map(|(_, t)| t.clamp(0.0, 1.0))
    }

    /// The tangent at a point with a velocity; none if its normal lies outside of the arc.
    #[inline]
    pub(crate) fn sample(&self, point: DVec2, velocity: DVec2) -> Option<Sample> {
        let [w0, w1] = self.spinors;
        let (speed, normal) = (velocity.length(), -velocity.perp());
        let (s, t) = self.barycentric(normal, speed)?;
        let length = (w0 * s + w1 * t).length_squared();
        let numerator = normal.dot(point - self.origin) * length / speed;
        numerator.is_finite().then_some(Sample { s, t, numerator })
    }

    /// Unit spinors h apart are at least cos(h/2) long in between: the square of that.
    pub(crate) const fn least_length(&self) -> f64 {
        0.5 * (1.0 + self.half_turning.1)
    }

    /// The numerator of the support with this jet, and its first two derivatives, at the parameter `t`.
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

    /// The six conditions at the ends are met by a polynomial of degree 5, here raised to 9.
    fn ends(&self, start: &End, end: &End) -> [f64; 10] {
        let jet = |e: &End, sense: f64| {
            let jet = SupportJet::of_element(e.point - self.origin, e.normal, e.curvature.recip());
            let slope = sense * jet.slope;
            SupportJet { slope, ..jet }.numerator(self.half_turning)
        };
        quintic(jet(start, 1.0), jet(end, -1.0))
    }
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// One arc of class 9: six support coefficients from the elements at the ends, four from tangents in between, which
    /// first tell whether class 5 or 7 would do.
    pub(crate) fn wide(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end } = interval;
        let frame = Frame::new(start, end);
        let mut g = frame.ends(start, end);
        let sample = |share: f64| {
            let [point, velocity, _] = self.course.jet(interval, share);
            frame.sample(point, velocity)
        };

        let least_length = frame.least_length();
        let allowed = self.how.tolerance * least_length / PEAK;
        let (mut at, mut weight, mut rest) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        for (k, share) in NODES.into_iter().enumerate() {
            let Sample { s, t, numerator } = sample(share)?;
            let product = s * t;
            (at[k], weight[k]) = (t, product * product * product);
            rest[k] = numerator - bernstein_9(&g, s, t);
        }
        let (mut error, mut order) = (largest(rest), 6.0);
        let over_knots = start.span < end.span;
        let uneven = over_knots || is_uneven(at);
        if error > allowed || uneven {
            // The remainder over t^3 (1-t)^3, first as a line through the inner nodes, which is class 7 ...
            let quotient: [f64; 4] = std::array::from_fn(|k| rest[k] / weight[k]);
            let slope = (quotient[2] - quotient[1]) / (at[2] - at[1]);
            let line = [quotient[1] - slope * at[1], slope, 0.0, 0.0];
            error = largest([0, 3].map(|k| rest[k] - weight[k] * (line[0] + slope * at[k])));
            order = 8.0;
            if error <= allowed && !uneven {
                add_cubic(&mut g, line);
            } else {
                // ... and then as a cubic through all four.
                add_cubic(&mut g, newton(at, quotient));
                order = 10.0;
                // Over knots the excess tells nothing of the length to be tried next.
                let (shares, enough): (&[f64], f64) = if over_knots {
                    (&CLOSE, allowed)
                } else {
                    (&PEAKS, f64::INFINITY)
                };
                error = largest_between(shares, enough, |share| {
                    let Sample { s, t, numerator } = sample(share)?;
                    Some((t, bernstein_9(&g, s, t) - numerator))
                })?;
            }
        }

        // Bernstein coefficients of one sign certify that the arc has no cusp.
        let arc = PhArc::from_parts(frame.spinors[0], frame.spinors[1], g);
        let sign = end.curvature;
        if !arc.radius_polynomial().iter().all(|r| r * sign > 0.0) {
            return None;
        }
        Some(Attempt {
            fit: Fit::Wide(arc),
            error: PEAK * error / least_length,
            order,
            matched: true,
        })
    }
}

/// Degree 9 coefficients of the quintic with these values and first two derivatives at both ends, counted from each end.
fn quintic(first: [f64; 3], last: [f64; 3]) -> [f64; 10] {
    let ends = |[value, slope, bend]: [f64; 3]| {
        let next = value + slope / 5.0;
        [value, next, bend / 20.0 + 2.0 * next - value]
    };
    let ([a, b, c], [f, e, d]) = (ends(first), ends(last));
    // Raised by four degrees: a product with (s + t)^4 in scaled coefficients.
    let scaled = [a, 5.0 * b, 10.0 * c, 10.0 * d, 5.0 * e, f];
    let mut g = [0.0; 10];
    for (i, c) in scaled.into_iter().enumerate() {
        for (j, binomial) in [1.0, 4.0, 6.0, 4.0, 1.0].into_iter().enumerate() {
            g[i + j] += c * binomial;
        }
    }
    for (g, binomial) in g.iter_mut().zip(BINOMIALS) {
        *g /= binomial;
    }
    g
}

/// Parameters farther apart than this leave room for an error that samples do not show: those of a curve of slowly varying
/// curvature are about 0.2 apart.
const APART: f64 = 0.3;

/// Whether the normals of the nodes are unevenly distributed.
fn is_uneven([a, b, c, d]: [f64; 4]) -> bool {
    a.max(b - a).max(c - b).max(d - c).max(1.0 - d) > APART
}

/// The largest error at increasing shares, and between two of them where their parameters in `[0, 1]` are far apart, or the first
/// one above `enough`; `at` gives parameter and error at a share.
pub(crate) fn largest_between(
    shares: &[f64],
    enough: f64,
    at: impl Fn(f64) -> Option<(f64, f64)>,
) -> Option<f64> {
    let (mut most, mut last) = (0.0_f64, (0.0, 0.0));
    for share in shares.iter().copied().chain([1.0]) {
        let (t, error) = if share < 1.0 { at(share)? } else { (1.0, 0.0) };
        most = most.max(error.abs());
        if most > enough {
            break;
        }
        if t - last.1 > APART {
            for part in [0.25, 0.5, 0.75] {
                let (_, error) = at(last.0 + part * (share - last.0))?;
                most = most.max(error.abs());
            }
        }
        last = (share, t);
    }
    Some(most)
}

fn largest<const K: usize>(values: [f64; K]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Coefficients by powers of the cubic through `(x, c)`: Newton's divided differences.
fn newton(x: [f64; 4], mut c: [f64; 4]) -> [f64; 4] {
    for level in 1..4 {
        for k in (level..4).rev() {
            c[k] = (c[k] - c[k - 1]) / (x[k] - x[k - level]);
        }
    }
    let mut cubic = [c[3], 0.0, 0.0, 0.0];
    for k in (0..3).rev() {
        for i in (1..4).rev() {
            cubic[i] = cubic[i - 1] - x[k] * cubic[i];
        }
        cubic[0] = c[k] - x[k] * cubic[0];
    }
    cubic
}

/// Adds `t^3 (1-t)^3` times a cubic by powers of t, which changes nothing at the ends up to second derivatives.
fn add_cubic(g: &mut [f64; 10], [a, b, c, d]: [f64; 4]) {
    let bernstein = [a, 3.0 * a + b, 3.0 * a + 2.0 * b + c, a + b + c + d];
    for (i, scaled) in bernstein.into_iter().enumerate() {
        g[3 + i] += scaled / BINOMIALS[3 + i];
    }
}

/// Value of a Bernstein polynomial of degree 9 at `t = 1 - s`, as two halves of Horner's scheme.
#[inline]
fn bernstein_9(g: &[f64; 10], s: f64, t: f64) -> f64 {
    let (s2, t2) = (s * s, t * t);
    let (s4, t4) = (s2 * s2, t2 * t2);
    let low = s4 * s * g[0]
        + 9.0 * s4 * t * g[1]
        + 36.0 * s2 * s * t2 * g[2]
        + 84.0 * s2 * t2 * t * g[3]
        + 126.0 * s * t4 * g[4];
    let high = 126.0 * s4 * t * g[5]
        + 84.0 * s2 * s * t2 * g[6]
        + 36.0 * s2 * t2 * t * g[7]
        + 9.0 * s * t4 * g[8]
        + t4 * t * g[9];
    s4 * low + t4 * high
}
