//! Plane curves to be approximated: a trait, and cubic paths made for it.

use bezier_mass::{BezierCurve, bernstein};
use glam::{DVec2, DVec3};

use crate::Error;

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
fn one_signed(coefficients: &[f64]) -> bool {
    let positive = coefficients.iter().any(|c| *c > 0.0);
    let negative = coefficients.iter().any(|c| *c < 0.0);
    positive != negative
}

/// Appends the certified roots of a Bernstein polynomial at which it changes sign, or all of them.
fn push_roots(coefficients: &[f64], kind: BreakKind, breaks: &mut Vec<Break>) {
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

/// A connected path of cubic Bézier spans, open or closed; lines and quadratics are cubics too.
///
/// ```
/// use ph_curves::{CubicPath, glam::dvec2};
/// let points = [dvec2(0.0, 0.0), dvec2(4.0, 1.0), dvec2(3.0, 5.0), dvec2(-1.0, 3.0)];
/// let loop_through_points = CubicPath::through(&points, true)?;
/// assert_eq!(loop_through_points.cubics().len(), 4);
/// # Ok::<(), ph_curves::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CubicPath {
    cubics: Vec<[DVec2; 4]>,
    closed: bool,
}

/// Largest gap between consecutive spans, relative to the largest coordinate: some ulps.
const GAP: f64 = 1e-12;

impl CubicPath {
    /// The path of these cubics. A closed path whose end is not its start gets the missing line.
    ///
    /// # Errors
    /// [`Error::TooFew`] without cubics; [`Error::NonFinite`]; [`Error::Gap`] if a cubic does not start where the one
    /// before it ends; [`Error::SinglePoint`] if all points are equal.
    pub fn new(mut cubics: Vec<[DVec2; 4]>, closed: bool) -> Result<Self, Error> {
        let (Some(first), Some(last)) = (cubics.first(), cubics.last()) else {
            return Err(Error::TooFew {
                what: "cubics",
                given: 0,
                needed: 1,
            });
        };
        if !cubics.iter().flatten().all(|p| p.is_finite()) {
            return Err(Error::NonFinite {
                what: "a control point",
            });
        }
        let size = cubics
            .iter()
            .flatten()
            .map(|p| p.abs().max_element())
            .fold(0.0, f64::max);
        for (index, pair) in cubics.windows(2).enumerate() {
            let gap = (pair[1][0] - pair[0][3]).length();
            if gap > GAP * size {
                return Err(Error::Gap {
                    index,
                    distance: gap,
                });
            }
        }
        let (start, end) = (first[0], last[3]);
        if closed && (start - end).length() > GAP * size {
            cubics.push(line_cubic(end, start));
        }
        cubics.retain(|cubic| cubic.iter().any(|p| *p != cubic[0]));
        if cubics.is_empty() {
            return Err(Error::SinglePoint);
        }
        Ok(Self { cubics, closed })
    }

    /// The polyline through `points`; `closed` adds the segment from the last to the first.
    ///
    /// # Errors
    /// As [`CubicPath::new`].
    pub fn polyline(points: &[DVec2], closed: bool) -> Result<Self, Error> {
        let cubics = points
            .windows(2)
            .map(|pair| line_cubic(pair[0], pair[1]))
            .collect();
        Self::new(cubics, closed)
    }

    /// The uniform cubic B-spline with these control points: `n - 3` spans, not clamped, or `n` spans if closed.
    ///
    /// # Errors
    /// [`Error::TooFew`] below four control points (three if closed); as [`CubicPath::new`].
    pub fn uniform_bspline(control: &[DVec2], closed: bool) -> Result<Self, Error> {
        let (n, needed) = (control.len(), if closed { 3 } else { 4 });
        if n < needed {
            return Err(Error::TooFew {
                what: "control points",
                given: n,
                needed,
            });
        }
        let cubics = (0..if closed { n } else { n - 3 })
            .map(|i| {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| control[(i + k) % n]);
                [
                    (a + 4.0 * b + c) / 6.0,
                    (2.0 * b + c) / 3.0,
                    (b + 2.0 * c) / 3.0,
                    (b + 4.0 * c + d) / 6.0,
                ]
            })
            .collect();
        Self::new(cubics, closed)
    }

    /// The cubic spline with continuous second derivative through sampled points, parametrised by chord length;
    /// natural at its ends, or periodic if closed. Repeated points are passed once.
    ///
    /// # Errors
    /// [`Error::TooFew`] below two different points (three if closed); as [`CubicPath::new`].
    pub fn through(points: &[DVec2], closed: bool) -> Result<Self, Error> {
        let mut points = points.to_vec();
        points.dedup();
        if closed && points.first() == points.last() {
            points.pop();
        }
        let needed = if closed { 3 } else { 2 };
        if points.len() < needed {
            return Err(Error::TooFew {
                what: "different points",
                given: points.len(),
                needed,
            });
        }
        if !points.iter().all(|p| p.is_finite()) {
            return Err(Error::NonFinite {
                what: "a sampled point",
            });
        }
        Self::new(crate::sampled::interpolate(&points, closed), closed)
    }

    /// The spans.
    #[must_use]
    pub fn cubics(&self) -> &[[DVec2; 4]] {
        &self.cubics
    }

    /// The path run backwards: its right-hand side becomes the left-hand one.
    #[must_use]
    pub fn reverse(&self) -> Self {
        let cubics = self
            .cubics
            .iter()
            .rev()
            .map(|c| [c[3], c[2], c[1], c[0]])
            .collect();
        Self {
            cubics,
            closed: self.closed,
        }
    }
}

/// A line as a cubic, with constant derivative.
pub(crate) fn line_cubic(start: DVec2, end: DVec2) -> [DVec2; 4] {
    [
        start,
        start.lerp(end, 1.0 / 3.0),
        start.lerp(end, 2.0 / 3.0),
        end,
    ]
}

fn legs(cubic: &[DVec2; 4]) -> [DVec2; 3] {
    [
        cubic[1] - cubic[0],
        cubic[2] - cubic[1],
        cubic[3] - cubic[2],
    ]
}

/// Bernstein coefficients of det(D, D') / 2, with the hodograph D = r'/3 of these legs.
fn bend([d0, d1, d2]: [DVec2; 3]) -> [f64; 3] {
    [d0.perp_dot(d1), 0.5 * d0.perp_dot(d2), d1.perp_dot(d2)]
}

/// A determinant of legs below this share of the squared size of the cubic is zero: the rounding of the differences
/// of control points whose own last digits are rounded.
const STRAIGHT: f64 = 1e-13;

impl PlaneCurve for CubicPath {
    fn spans(&self) -> usize {
        self.cubics.len()
    }

    fn is_closed(&self) -> bool {
        self.closed
    }

    #[inline]
    fn jet(&self, span: usize, t: f64) -> [DVec2; 3] {
        let cubic = &self.cubics[span];
        let [d0, d1, d2] = legs(cubic);
        let (e0, e1) = (d1 - d0, d2 - d1);
        let second = e0 + (e1 - e0) * t;
        let first = d0 + (e0 + second) * t;
        // Horner's scheme about the nearer end keeps the digits of both.
        let point = if t <= 0.5 {
            cubic[0] + t * (3.0 * d0 + t * (3.0 * e0 + t * (e1 - e0)))
        } else {
            let s = 1.0 - t;
            cubic[3] - s * (3.0 * d2 - s * (3.0 * e1 - s * (e1 - e0)))
        };
        [point, 3.0 * first, 6.0 * second]
    }

    fn is_straight(&self, span: usize) -> bool {
        let [d0, d1, d2] = legs(&self.cubics[span]);
        let size = d0.abs().max(d1.abs()).max(d2.abs()).max_element();
        let bend = d0
            .perp_dot(d1)
            .abs()
            .max(d1.perp_dot(d2).abs())
            .max(d0.perp_dot(d2).abs());
        bend <= STRAIGHT * size * size
    }

    fn inflections(&self, span: usize, breaks: &mut Vec<Break>) {
        let legs = legs(&self.cubics[span]);
        let bend = bend(legs);
        if !self.is_straight(span) {
            if one_signed(&bend) {
                return;
            }
            if let Some(t) = interior_zero(legs, bend) {
                breaks.push(Break {
                    t,
                    kind: BreakKind::Cusp,
                });
            }
            push_roots(&bend, BreakKind::Inflection, breaks);
            return;
        }
        let [d0, d1, d2] = legs;
        let chord = d0 + d1 + d2;
        let along = if chord.length() > 0.0 {
            chord
        } else {
            legs[usize::from(d0 == DVec2::ZERO)]
        };
        push_roots(&legs.map(|d| d.dot(along)), BreakKind::Cusp, breaks);
    }

    fn vertices(&self, span: usize, breaks: &mut Vec<Break>) {
        if !self.is_straight(span) {
            let legs = legs(&self.cubics[span]);
            push_roots(
                &vertex_polynomial(legs, bend(legs)),
                BreakKind::Vertex,
                breaks,
            );
        }
    }

    fn direction(&self, span: usize, t: f64, side: Side) -> DVec2 {
        let [d0, d1, d2] = legs(&self.cubics[span]);
        let size = d0.abs().max(d1.abs()).max(d2.abs()).max_element();
        let [_, first, second] = self.jet(span, t);
        if first.length() > VANISHING * size {
            return first;
        }
        let second = if side == Side::After { second } else { -second };
        if second.length() > VANISHING * size {
            second
        } else {
            d0 - 2.0 * d1 + d2
        }
    }
}

/// A derivative below this share of the legs is the rounding of one that vanishes.
const VANISHING: f64 = 1e-11;

/// The parameter inside (0, 1) at which the hodograph with these legs vanishes to rounding.
fn interior_zero(legs: [DVec2; 3], bend: [f64; 3]) -> Option<f64> {
    // The bend has a double root there: its derivative vanishes.
    let (e0, e1) = (bend[1] - bend[0], bend[2] - bend[1]);
    let t = e0 / (e0 - e1);
    if !(t > 0.0 && t < 1.0) {
        return None;
    }
    let size = legs
        .iter()
        .map(|d| d.abs().max_element())
        .fold(0.0, f64::max);
    (bernstein::evaluate(&legs, t).length() <= VANISHING * size).then_some(t)
}

/// Bernstein coefficients of `f' |D|^2 - 3 f <D, D'>`, the numerator of the derivative of the curvature of a cubic,
/// with D the hodograph (degree 2) and f = det(D, D')/2.
fn vertex_polynomial([d0, d1, d2]: [DVec2; 3], f: [f64; 3]) -> [f64; 6] {
    // |D|^2, degree 4, and <D, D'>/2, degree 3.
    let s = [
        d0.length_squared(),
        d0.dot(d1),
        (2.0 * d1.length_squared() + d0.dot(d2)) / 3.0,
        d1.dot(d2),
        d2.length_squared(),
    ];
    let (e0, e1) = (d1 - d0, d2 - d1);
    let m = [
        d0.dot(e0),
        (2.0 * d1.dot(e0) + d0.dot(e1)) / 3.0,
        (d2.dot(e0) + 2.0 * d1.dot(e1)) / 3.0,
        d2.dot(e1),
    ];
    // f'/2 in degree 1.
    let g = [f[1] - f[0], f[2] - f[1]];
    // (g s)_k = ((5-k) g0 s_k + k g1 s_{k-1}) / 5; (f m)_k with C(2,i) C(3,k-i) / C(5,k).
    [
        g[0] * s[0] - 3.0 * f[0] * m[0],
        (4.0 * g[0] * s[1] + g[1] * s[0]) / 5.0
            - 3.0 * (3.0 * f[0] * m[1] + 2.0 * f[1] * m[0]) / 5.0,
        (3.0 * g[0] * s[2] + 2.0 * g[1] * s[1]) / 5.0
            - 3.0 * (3.0 * f[0] * m[2] + 6.0 * f[1] * m[1] + f[2] * m[0]) / 10.0,
        (2.0 * g[0] * s[3] + 3.0 * g[1] * s[2]) / 5.0
            - 3.0 * (f[0] * m[3] + 6.0 * f[1] * m[2] + 3.0 * f[2] * m[1]) / 10.0,
        (g[0] * s[4] + 4.0 * g[1] * s[3]) / 5.0
            - 3.0 * (2.0 * f[1] * m[3] + 3.0 * f[2] * m[2]) / 5.0,
        g[1] * s[4] - 3.0 * f[2] * m[3],
    ]
}

/// A rational Bézier curve of any degree is a curve of one span. Curves through infinity are refused when they are
/// approximated.
impl PlaneCurve for BezierCurve<DVec2> {
    fn spans(&self) -> usize {
        1
    }

    fn is_closed(&self) -> bool {
        let (first, last) = (self.point(0.0), self.point(1.0));
        self.degree() > 0 && first.is_ok() && first == last
    }

    fn jet(&self, _span: usize, t: f64) -> [DVec2; 3] {
        let jet = BezierCurve::jet(self, t);
        match (jet.position(), jet.velocity(), jet.acceleration()) {
            (Some(point), Some(first), Some(second)) => [point, first, second],
            _ => [DVec2::NAN; 3],
        }
    }

    fn is_straight(&self, _span: usize) -> bool {
        let homogeneous = homogeneous(self);
        let size = homogeneous
            .iter()
            .map(|x| x.abs().max_element())
            .fold(0.0, f64::max);
        let bend = bend_polynomial(&homogeneous);
        bend.iter()
            .all(|c| c.abs() <= STRAIGHT * size * size * size)
    }

    fn inflections(&self, span: usize, breaks: &mut Vec<Break>) {
        let h = homogeneous(self);
        if !self.is_straight(span) {
            push_roots(&bend_polynomial(&h), BreakKind::Inflection, breaks);
            return;
        }
        let velocity = velocity_polynomial(&h);
        let along = velocity.iter().copied().fold(DVec2::ZERO, |sum, v| sum + v);
        let along = if along == DVec2::ZERO {
            velocity.first().copied().unwrap_or(DVec2::X)
        } else {
            along
        };
        let rate: Vec<f64> = velocity.iter().map(|v| v.dot(along)).collect();
        push_roots(&rate, BreakKind::Cusp, breaks);
    }

    fn vertices(&self, span: usize, breaks: &mut Vec<Break>) {
        if !self.is_straight(span) {
            let h = homogeneous(self);
            let weight: Vec<f64> = h.iter().map(|x| x.x).collect();
            let rate =
                rational_vertex_polynomial(&bend_polynomial(&h), &weight, &velocity_polynomial(&h));
            push_roots(&rate, BreakKind::Vertex, breaks);
        }
    }

    fn direction(&self, _span: usize, t: f64, side: Side) -> DVec2 {
        let velocity = BezierCurve::jet(self, t).velocity().unwrap_or(DVec2::ZERO);
        if velocity != DVec2::ZERO {
            return velocity;
        }
        if side == Side::After {
            return self.tangent_direction(t).unwrap_or(DVec2::ZERO);
        }
        -self
            .reversed()
            .tangent_direction(1.0 - t)
            .unwrap_or(DVec2::ZERO)
    }
}

fn homogeneous(curve: &BezierCurve<DVec2>) -> Vec<DVec3> {
    curve
        .control()
        .iter()
        .map(|m| DVec3::new(m.weight, m.weighted.x, m.weighted.y))
        .collect()
}

/// Bernstein coefficients of `w X' - w' X` up to a positive factor: the velocity times the squared weight, the moment of
/// the last two points of de Casteljau's scheme.
fn velocity_polynomial(h: &[DVec3]) -> Vec<DVec2> {
    let n = h.len() - 1;
    bernstein::product_with(&h[..n], h.get(1..).unwrap_or_default(), |a, b| {
        DVec2::new(a.x * b.y - a.y * b.x, a.x * b.z - a.z * b.x)
    })
}

/// Bernstein coefficients of `det(H, H', H'')` up to a positive factor: the determinant of the last three points of
/// de Casteljau's scheme. The curvature is this times `w^3 / |w X' - w' X|^3`.
fn bend_polynomial(h: &[DVec3]) -> Vec<f64> {
    if h.len() < 3 {
        return vec![0.0];
    }
    let count = h.len() - 2;
    let cross = bernstein::product_with(&h[1..=count], &h[2..], |a, b| a.cross(*b));
    bernstein::product_with(&h[..count], &cross, |a, b| a.dot(*b))
}

/// `S' w |V|^2 + 3 S w' |V|^2 - 3 S w <V, V'>`: the derivative of the curvature `S w^3 / |V|^3` times positive factors
/// (for a weight of one sign).
fn rational_vertex_polynomial(bend: &[f64], weight: &[f64], velocity: &[DVec2]) -> Vec<f64> {
    use bernstein::{derivative, elevate_to, product, product_with};
    let dot = |a: &[DVec2], b: &[DVec2]| product_with(a, b, |x, y| x.dot(*y));
    let length = dot(velocity, velocity);
    let terms = [
        (1.0, product(&derivative(bend), &product(weight, &length))),
        (3.0, product(bend, &product(&derivative(weight), &length))),
        (
            -3.0,
            product(
                bend,
                &product(weight, &dot(velocity, &derivative(velocity))),
            ),
        ),
    ];
    let degree = terms
        .iter()
        .map(|(_, t)| t.len())
        .max()
        .unwrap_or(1)
        .saturating_sub(1);
    let mut sum = vec![0.0; degree + 1];
    let mut largest = 0.0_f64;
    for (factor, term) in terms {
        for (sum, c) in sum.iter_mut().zip(elevate_to(&term, degree)) {
            *sum += factor * c;
            largest = largest.max((factor * c).abs());
        }
    }
    // On a circle the terms cancel and leave rounding, which has roots anywhere.
    if sum.iter().all(|c| c.abs() <= STRAIGHT * largest) {
        sum.fill(0.0);
    }
    sum
}
