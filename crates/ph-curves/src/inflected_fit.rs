//! Fits about an inflection: curvature elements at both ends, and a polynomial through tangents in between.

use crate::course::{End, Interval};
use crate::fit::{Attempt, Fit, Fitter};
use crate::wide::{APART, CLOSE, Frame, NODES, PEAK, PEAKS, largest_between};
use crate::{InflectedArc, PlaneCurve, SupportJet};

/// Shares at which the error is measured where one tangent in between is interpolated.
const SHARES: [f64; 8] = [0.1, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9];
/// Where the one tangent may lie; the one farther from the inflection is taken, for its digits.
const MIDDLES: [f64; 2] = [0.45, 0.55];

/// A value of the factor `r` and its first two derivatives by the own parameter of the arc, where only as many are used as nodes
/// coincide there.
#[derive(Clone, Copy)]
struct Node {
    own: f64,
    jet: [f64; 3],
}

impl<C: PlaneCurve + ?Sized> Fitter<'_, C> {
    /// One arc of class 9 about `inflection`, at an end of the interval, inside, or beside it: seven coefficients from the
    /// elements at the ends and from tangents in between.
    pub(crate) fn inflected(&self, interval: &Interval, inflection: &End) -> Option<Attempt> {
        let Interval { start, end } = interval;
        // The arc is about the inflection, and reaches to the end whose normal is turned the most.
        let turning = |e: &End| inflection.normal.dot(e.normal);
        let backwards = turning(start) < turning(end);
        let (near, far) = if backwards {
            (end, start)
        } else {
            (start, end)
        };
        let at = inflection.parameter();
        let side = |parameter: f64| {
            let beyond = (parameter - at) * (far.parameter() - at);
            if beyond < 0.0 { -1.0 } else { 1.0 }
        };
        let frame = Frame::new(inflection, far);
        let sample = |share: f64| -> Option<(f64, f64)> {
            let (parameter, [point, velocity, _]) = self.course.jet_at(interval, share);
            let sample = frame.sample(point, velocity)?;
            Some((side(parameter) * sample.t.max(0.0).sqrt(), sample.numerator))
        };
        let node = |share: f64| -> Option<Node> {
            let (own, numerator) = sample(share)?;
            let jet = [numerator / (own * own * own), 0.0, 0.0];
            Some(Node { own, jet })
        };

        let last = frame.node(far, 1.0);
        let (from, nodes) = if near.parameter() == at {
            let [a, b, c, d] = NODES;
            (
                0.0,
                [node(a)?, node(b)?, node(c)?, node(d)?, last, last, last],
            )
        } else {
            let tau = frame.parameter(near.normal)?;
            let first = frame.node(near, side(near.parameter()) * tau.sqrt());
            let distances = MIDDLES.map(|share| sample(share).map_or(0.0, |(own, _)| own.abs()));
            let middle = node(MIDDLES[usize::from(distances[1] > distances[0])])?;
            (first.own, [first, first, first, middle, last, last, last])
        };
        let range = [from, 1.0];
        let r = bernstein_through(nodes, range);
        if !r.iter().all(|c| c.is_finite()) {
            return None;
        }
        let arc = InflectedArc::from_parts(frame.origin, frame.spinors, range, r);
        if !arc.is_regular(far.curvature) {
            return None;
        }
        let shares: &[f64] = if start.span < end.span {
            &CLOSE
        } else if from == 0.0 {
            &PEAKS
        } else {
            &SHARES
        };
        let error = largest_between(shares, APART, |share| {
            let (own, numerator) = sample(share)?;
            let t = (own - from) / (1.0 - from);
            let difference = arc.support_numerator(own) - numerator;
            Some((if backwards { 1.0 - t } else { t }, difference))
        })?;
        Some(Attempt {
            fit: Some(Fit::Inflected(if backwards { arc.reverse() } else { arc })),
            error: PEAK * error / frame.least_length(),
            order: 10.0,
        })
    }
}

impl Frame {
    /// The factor of the support at a curvature element, with two derivatives by the arc's own parameter `t = own`.
    fn node(&self, end: &End, own: f64) -> Node {
        let radius = end.curvature.recip();
        let jet = SupportJet::of_element(end.point - self.origin, end.normal, radius);
        let [g, slope, bend] = self.numerator(&jet, own * own);
        // By t instead of τ = t², and then g = t³ r.
        let slope = 2.0 * own * slope;
        let bend = slope / own + 4.0 * own * own * bend;
        let cube = own * own * own;
        let r = g / cube;
        let dr = slope / cube - 3.0 * r / own;
        let ddr = bend / cube - 6.0 * (r / own + dr) / own;
        Node {
            own,
            jet: [r, dr, ddr],
        }
    }
}

/// Bernstein coefficients over a range of the polynomial through these nodes, of which equal ones stand side by side: Newton's
/// divided differences, with derivatives where nodes coincide.
fn bernstein_through(nodes: [Node; 7], [from, to]: [f64; 2]) -> [f64; 7] {
    let mut c = nodes.map(|node| node.jet[0]);
    for level in 1..7 {
        for k in (level..7).rev() {
            let width = nodes[k].own - nodes[k - level].own;
            c[k] = if width == 0.0 {
                // Nodes coincide three at most.
                nodes[k].jet[level.min(2)] / if level == 2 { 2.0 } else { 1.0 }
            } else {
                (c[k] - c[k - 1]) / width
            };
        }
    }
    // Horner's scheme: times (t - node), which is linear over the range.
    let mut b = [0.0; 7];
    b[0] = c[6];
    for degree in 1..7 {
        let node = nodes[6 - degree].own;
        let (low, high) = (from - node, to - node);
        for k in (0..=degree).rev() {
            let share = k as f64 / degree as f64;
            let below = if k > 0 { b[k - 1] } else { 0.0 };
            b[k] = share * high * below + (1.0 - share) * low * b[k] + c[6 - degree];
        }
    }
    b
}
