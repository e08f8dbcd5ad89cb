//! Plane curves to be approximated: the trait, and the places where they have to be cut.

use glam::DVec2;

use crate::Enclosure;

/// Why a curve has to be cut at a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BreakKind {
    /// The curvature changes sign.
    Inflection,
    /// The derivative of the curvature changes sign.
    Vertex,
    /// The derivative of the curve vanishes and the tangent reverses.
    Cusp,
}

/// A parameter strictly inside a span at which the curve has to be cut, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Break {
    /// The local parameter in (0, 1).
    pub t: f64,
    /// What happens there.
    pub kind: BreakKind,
}

/// The side from which a one-sided limit is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// From smaller parameters: arriving.
    Before,
    /// From larger parameters: leaving.
    After,
}

/// A plane curve made of smooth spans, each over the local parameter `[0, 1]`.
///
/// Implement `spans`, `is_closed` and `jet`; the rest has numerical defaults, which the curves of this crate replace
/// by certified ones. Spans follow each other without gaps; where their tangents differ there is a corner.
///
/// Corners and jumps of the curvature lie between spans only: within a span the jet has to be continuous. Nothing looks for
/// breaks inside, and the error of an approximation, measured at a few samples of each piece, may then be reported far too
/// small, even as zero: split such a curve into more spans.
pub trait PlaneCurve {
    /// Number of spans.
    fn spans(&self) -> usize;

    /// Whether the end of the last span is the start of the first.
    fn is_closed(&self) -> bool;

    /// Point, first and second derivative by the local parameter `t` in `[0, 1]` of the span.
    fn jet(&self, span: usize, t: f64) -> [DVec2; 3];

    /// Whether the span lies on a straight line.
    fn is_straight(&self, _span: usize) -> bool {
        false
    }

    /// Appends the inflections and cusps inside the span, in any order.
    ///
    /// The default looks for sign changes of the curvature over 64 steps and bisects them: events closer together than
    /// that are missed. Curves that know better should say so here.
    fn inflections(&self, span: usize, breaks: &mut Vec<Break>) {
        sampled_breaks(
            &|t| curvature_at(self, span, t),
            BreakKind::Inflection,
            breaks,
        );
    }

    /// The parameters, also outside of `[0, 1]`, of inflections of the curve that continues the span, if its jet is that of this
    /// curve there too. An arc about an inflection near to it is close to the curve for longer.
    ///
    /// The default knows none.
    fn continued_inflections(&self, _span: usize) -> [Option<f64>; 2] {
        [None; 2]
    }

    /// Appends the vertices inside the span, where the derivative of the curvature changes sign, in any order.
    ///
    /// The default looks for sign changes of differences of the curvature, as above.
    fn vertices(&self, span: usize, breaks: &mut Vec<Break>) {
        // A central difference of curvatures over a step small against the search grid.
        let step = 0.01 / SEARCH_STEPS as f64;
        let rate = |t: f64| {
            curvature_at(self, span, (t + step).min(1.0))
                - curvature_at(self, span, (t - step).max(0.0))
        };
        sampled_breaks(&rate, BreakKind::Vertex, breaks);
    }

    /// Bounds over a range of the local parameter, for [`Approximated::certify`](crate::Approximated::certify).
    ///
    /// The default has none.
    fn enclosure(&self, _span: usize, _range: [f64; 2]) -> Option<Enclosure> {
        None
    }

    /// Direction of travel at `t`, taken from one side, not normalised; zero only for a span that is a point.
    ///
    /// The default replaces a vanishing derivative by the second one.
    fn direction(&self, span: usize, t: f64, side: Side) -> DVec2 {
        let [_, first, second] = self.jet(span, t);
        if first != DVec2::ZERO {
            return first;
        }
        if side == Side::After { second } else { -second }
    }
}

/// Signed curvature from the first two derivatives; infinite where the first vanishes, 0 for a point.
pub(crate) fn curvature(first: DVec2, second: DVec2) -> f64 {
    let speed = first.length();
    let bend = first.perp_dot(second);
    if bend == 0.0 {
        0.0
    } else {
        bend / (speed * speed * speed)
    }
}

/// Number of steps in which the defaults of [`PlaneCurve`] look for sign changes.
const SEARCH_STEPS: usize = 64;

fn curvature_at<C: PlaneCurve + ?Sized>(curve: &C, span: usize, t: f64) -> f64 {
    let [_, first, second] = curve.jet(span, t);
    curvature(first, second)
}

fn sampled_breaks(function: &dyn Fn(f64) -> f64, kind: BreakKind, breaks: &mut Vec<Break>) {
    let grid = |k: usize| k as f64 / SEARCH_STEPS as f64;
    for k in 0..SEARCH_STEPS {
        let (mut low, mut high) = (grid(k), grid(k + 1));
        let at_low = function(low);
        if at_low * function(high) >= 0.0 {
            continue;
        }
        while high - low > f64::EPSILON {
            let middle = 0.5 * (low + high);
            if function(middle) * at_low > 0.0 {
                low = middle
            } else {
                high = middle
            }
        }
        breaks.push(Break { t: high, kind });
    }
}

/// Parameters closer than this are one break: the roots come with an error of about an ulp of 1 times their condition.
const SAME_BREAK: f64 = 1e-11;

/// Sorts breaks and keeps one of several at one place: a cusp before an inflection before a vertex.
pub(crate) fn merge(breaks: &mut Vec<Break>) {
    let rank = |kind: BreakKind| match kind {
        BreakKind::Cusp => 0,
        BreakKind::Inflection => 1,
        BreakKind::Vertex => 2,
    };
    breaks.retain(|b| b.t > SAME_BREAK && b.t < 1.0 - SAME_BREAK);
    breaks.sort_by(|a, b| a.t.total_cmp(&b.t));
    breaks.dedup_by(|next, kept| {
        let same = next.t - kept.t <= SAME_BREAK;
        if same && rank(next.kind) < rank(kept.kind) {
            *kept = *next;
        }
        same
    });
}

/// Whether the coefficients are of one sign, zeros aside: then there is no root inside (0, 1).
#[inline]
pub(crate) fn one_signed(coefficients: &[f64]) -> bool {
    let positive = coefficients.iter().any(|c| *c > 0.0);
    let negative = coefficients.iter().any(|c| *c < 0.0);
    positive != negative
}

/// Appends the certified roots of a Bernstein polynomial at which it changes sign, or all of them.
pub(crate) fn push_roots(coefficients: &[f64], kind: BreakKind, breaks: &mut Vec<Break>) {
    if one_signed(coefficients) {
        return;
    }
    let Ok(roots) = variation::Solver::new()
        .without_exact()
        .roots(coefficients)
        .map(|r| {
            r.iter()
                .map(|root| (root.value(), root.multiplicity()))
                .collect::<Vec<_>>()
        })
    else {
        return;
    };
    // An undecided cluster is cut at too: a cut too many does no harm.
    breaks.extend(
        roots
            .iter()
            .filter(|(_, multiplicity)| multiplicity.is_none_or(|m| m % 2 == 1))
            .map(|(t, _)| Break { t: *t, kind }),
    );
}

/// A determinant of differences below this share of the size to its power is zero: the rounding of the differences
/// of control points whose own last digits are rounded.
pub(crate) const STRAIGHT: f64 = 1e-13;
