//! Fits of class 9: curvature elements at both ends, four tangents in between, and inflections at an end.

use glam::DVec2;

use crate::fit::{Attempt, End, Fit, Fitter, Interval};
use crate::{G1Ends, InflectedArc, LineElement, PhArc, PlaneCurve, SupportJet};

/// Zeros of the ultraspherical polynomial of degree 4 for the weight `t^3 (1-t)^3`: the interpolation nodes.
const NODES: [f64; 4] = [0.1797, 0.387, 0.613, 0.8203];
/// Shares between these nodes, where the error peaks.
const PEAKS: [f64; 5] = [0.1, 0.28, 0.5, 0.72, 0.9];
/// The true error exceeds that at the shares by a little: parts are not cut at vertices, where peaks move. The order makes
/// the factor cheap.
const PEAK: f64 = 2.0;
/// Binomial coefficients of degree 9.
const BINOMIALS: [f64; 10] = [1.0, 9.0, 36.0, 84.0, 126.0, 126.0, 84.0, 36.0, 9.0, 1.0];

/// What the numerator of the support is a polynomial of: the parameter of the normals, or its root from an inflection on.
struct Frame {
    spinors: [DVec2; 2],
    start: DVec2,
    inflected: bool,
}

impl Frame {
    /// Barycentric parameter `(1 - t, t)` of a unit normal and the length `|w|^2` there; none (but for a slack of
    /// rounding) outside of the arc.
    #[inline]
    fn parameter(&self, normal: DVec2) -> Option<(f64, f64, f64)> {
        let [w0, w1] = self.spinors;
        let (cosine, sine) = (self.start.dot(normal), self.start.perp_dot(normal));
        let spinor = w0.rotate(DVec2::new(1.0 + cosine, sine));
        let (a, b) = (w0.perp_dot(spinor), spinor.perp_dot(w1));
        let scale = 1.0 / (a + b);
        let (t, s) = (a * scale, b * scale);
        if !(t >= -1e-9 && s >= -1e-9) {
            return None;
        }
        let length = (w0 * s + w1 * t).length_squared();
        if !self.inflected {
            return Some((s, t, length));
        }
        let root = t.max(0.0).sqrt();
        Some((s / (1.0 + root), root, length))
    }
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// One arc of class 9: six support coefficients from the elements at the ends, four from tangents in between. Where
    /// an end is an inflection, the arc begins there.
    pub(crate) fn wide(&self, interval: &Interval) -> Option<Attempt> {
        let (inflected, backwards) = (
            interval.start.curvature == 0.0 || interval.end.curvature == 0.0,
            interval.end.curvature == 0.0,
        );
        let (start, end) = if backwards {
            (&interval.end, &interval.start)
        } else {
            (&interval.start, &interval.end)
        };
        let origin = start.point;
        let ends = G1Ends::between(
            LineElement::from_unit(DVec2::ZERO, start.normal),
            LineElement::from_unit(DVec2::ZERO, end.normal),
        );
        let (spinors, half_turning) = (ends.unit_spinors(), ends.half_turning());
        let frame = Frame {
            spinors: [spinors.0, spinors.1],
            start: start.normal,
            inflected,
        };

        // The six conditions at the ends are met by a polynomial of degree 5.
        let (cosine, sine) = half_turning;
        let jet = |e: &End, sense: f64| {
            let jet = SupportJet::of_element(e.point - origin, e.normal, e.curvature.recip());
            let slope = sense * jet.slope;
            SupportJet { slope, ..jet }.numerator((sine, cosine))
        };
        let mut last = jet(end, -1.0);
        let first = if inflected {
            // From the end on τ = (1 - t)^2 with dτ = -2 dt, ddτ = 2 dt^2.
            last = [last[0], 2.0 * last[1], 4.0 * last[2] - 2.0 * last[1]];
            [0.0; 3]
        } else {
            jet(start, 1.0)
        };
        let mut g = quintic(first, last);

        // With x = t/(1-t) the remainder over t^3 (1-t)^6 is a cubic in x: Newton's divided differences.
        let (mut x, mut c) = ([0.0; 4], [0.0; 4]);
        let mut error = 0.0_f64;
        for (k, share) in NODES.into_iter().enumerate() {
            let (normal, support) = self.tangent_about(interval, share, origin);
            let (s, t, length) = frame.parameter(normal)?;
            let rest = support * length - bernstein_9(&g, s, t);
            error = error.max((rest / length).abs());
            let cube = s * s * s;
            x[k] = t / s;
            c[k] = rest / (t * t * t * cube * cube);
        }
        if PEAK * error > self.how.tolerance {
            add_cubic(&mut g, newton(x, c));
            error = 0.0;
            for share in PEAKS {
                let (normal, support) = self.tangent_about(interval, share, origin);
                let (s, t, length) = frame.parameter(normal)?;
                error = error.max((bernstein_9(&g, s, t) / length - support).abs());
            }
        }

        // Bernstein coefficients of one sign certify that the arc has no cusp.
        let sign = end.curvature;
        let fit = if inflected {
            let r = std::array::from_fn(|k| {
                g[k + 3] * BINOMIALS[k + 3] / [1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0][k]
            });
            let arc = InflectedArc::from_parts(origin, frame.spinors, r);
            if !arc.is_regular(sign) {
                return None;
            }
            Fit::Inflected(if backwards { arc.reverse() } else { arc })
        } else {
            let arc = PhArc::from_parts(spinors.0, spinors.1, g);
            if !arc.radius_polynomial().iter().all(|r| r * sign > 0.0) {
                return None;
            }
            Fit::Wide(arc)
        };
        Some(Attempt {
            fit,
            error: PEAK * error,
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

/// Coefficients by powers of x of the cubic through `(x, c)`.
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

/// Adds `t^3 (1-t)^6` times a cubic in `t/(1-t)`, which changes nothing at the ends up to second derivatives.
fn add_cubic(g: &mut [f64; 10], cubic: [f64; 4]) {
    for (i, c) in cubic.into_iter().enumerate() {
        g[3 + i] += c / BINOMIALS[3 + i];
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
