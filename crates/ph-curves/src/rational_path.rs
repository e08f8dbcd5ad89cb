//! Rational Bézier curves as plane curves, and paths of them: what a NURBS curve is made of.

use bezier_mass::{BSplineCurve, BezierCurve, bernstein};
use glam::{DVec2, DVec3};

use crate::plane_curve::{STRAIGHT, push_roots};
use crate::polynomial::range;
use crate::{Break, BreakKind, Enclosure, Error, PlaneCurve, Side};

/// A connected path of rational Bézier curves of any degrees: a B-spline or NURBS curve with any knots, an outline of lines
/// and conics.
///
/// ```
/// use bezier_mass::{BSplineCurve, Knots};
/// use ph_curves::{Approximation, RationalPath, approximate, glam::dvec2};
///
/// // A clamped cubic B-spline with knots at uneven steps.
/// let knots = Knots::clamped(3, &[0.0, 1.0, 1.5, 4.0])?;
/// let control = [(0.0, 0.0), (1.0, 2.0), (3.0, 2.5), (4.0, 0.0), (6.0, -1.0), (8.0, 1.0)].map(|(x, y)| dvec2(x, y));
/// let path = RationalPath::nurbs(&BSplineCurve::polynomial(knots, &control)?)?;
/// let result = approximate(&path, &Approximation::within(1e-6))?;
/// assert!(result.error <= 1e-6 && result.spline.pieces().len() < 30);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<BezierCurve<DVec2>>", into = "Vec<BezierCurve<DVec2>>")
)]
pub struct RationalPath {
    spans: Vec<BezierCurve<DVec2>>,
    closed: bool,
}

/// Largest gap between consecutive spans, relative to the largest coordinate: some ulps.
const GAP: f64 = 1e-12;

impl RationalPath {
    /// The path of these spans, closed if its end is its start.
    ///
    /// # Errors
    /// [`Error::TooFew`] without spans; [`Error::NonFinite`] if a span begins or ends at infinity; [`Error::Gap`] if a span
    /// does not start where the one before it ends.
    pub fn new(spans: Vec<BezierCurve<DVec2>>) -> Result<Self, Error> {
        let ends: Vec<[DVec2; 2]> = spans
            .iter()
            .map(|span| match (span.point(0.0), span.point(1.0)) {
                (Ok(start), Ok(end)) => Ok([start, end]),
                _ => Err(Error::NonFinite {
                    what: "an end of a span",
                }),
            })
            .collect::<Result<_, _>>()?;
        let (Some([start, _]), Some([_, end])) = (ends.first(), ends.last()) else {
            return Err(Error::TooFew {
                what: "spans",
                given: 0,
                needed: 1,
            });
        };
        let size = ends
            .iter()
            .flatten()
            .map(|p| p.abs().max_element())
            .fold(0.0, f64::max);
        for (index, pair) in ends.windows(2).enumerate() {
            let distance = (pair[1][0] - pair[0][1]).length();
            if distance > GAP * size {
                return Err(Error::Gap { index, distance });
            }
        }
        let closed = (*start - *end).length() <= GAP * size;
        Ok(Self { spans, closed })
    }

    /// The Bézier pieces of a B-spline or NURBS curve.
    ///
    /// # Errors
    /// As for [`RationalPath::new`]; a gap is a knot of full multiplicity at which the curve jumps.
    pub fn nurbs(curve: &BSplineCurve<DVec2>) -> Result<Self, Error> {
        Self::new(
            curve
                .pieces()
                .into_iter()
                .map(|piece| piece.curve)
                .collect(),
        )
    }

    /// The spans.
    #[must_use]
    pub fn curves(&self) -> &[BezierCurve<DVec2>] {
        &self.spans
    }
}

impl TryFrom<Vec<BezierCurve<DVec2>>> for RationalPath {
    type Error = Error;

    fn try_from(spans: Vec<BezierCurve<DVec2>>) -> Result<Self, Error> {
        Self::new(spans)
    }
}

impl From<RationalPath> for Vec<BezierCurve<DVec2>> {
    fn from(path: RationalPath) -> Self {
        path.spans
    }
}

impl PlaneCurve for RationalPath {
    fn spans(&self) -> usize {
        self.spans.len()
    }

    fn is_closed(&self) -> bool {
        self.closed
    }

    fn jet(&self, span: usize, t: f64) -> [DVec2; 3] {
        PlaneCurve::jet(&self.spans[span], 0, t)
    }

    fn is_straight(&self, span: usize) -> bool {
        self.spans[span].is_straight(0)
    }

    fn inflections(&self, span: usize, breaks: &mut Vec<Break>) {
        self.spans[span].inflections(0, breaks);
    }

    fn vertices(&self, span: usize, breaks: &mut Vec<Break>) {
        self.spans[span].vertices(0, breaks);
    }

    fn enclosure(&self, span: usize, part: [f64; 2]) -> Option<Enclosure> {
        self.spans[span].enclosure(0, part)
    }

    fn direction(&self, span: usize, t: f64, side: Side) -> DVec2 {
        self.spans[span].direction(0, t, side)
    }
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

    fn enclosure(&self, _span: usize, [from, to]: [f64; 2]) -> Option<Enclosure> {
        use bernstein::{derivative, product_with, restrict};
        let h = homogeneous(self);
        let n = self.degree() as f64;
        let width = to - from;
        let weight = restrict(&h.iter().map(|x| x.x).collect::<Vec<_>>(), from, to);
        let [light, heavy] = range(&weight);
        if light <= 0.0 && heavy >= 0.0 {
            return None;
        }
        // r' = n V / w², r'' = n (V' w - 2 V w') / w³ and det(r', r'') = n² (n - 1) S / w³ with these polynomials V and S.
        let velocity = restrict(&velocity_polynomial(&h), from, to);
        let bend = restrict(&bend_polynomial(&h), from, to);
        let square = product_with(&velocity, &velocity, |a, b| a.dot(*b));
        let change = product_with(&weight, &derivative(&velocity), |w, v| *v * *w);
        let drag = product_with(&derivative(&weight), &velocity, |w, v| *v * (2.0 * *w));
        let longest = |v: &[DVec2]| v.iter().fold(0.0, |most, v| v.length().max(most));
        let over = |part: [f64; 2], power: i32, factor: f64| {
            let [a, b] = [light, heavy].map(|w| factor / w.powi(power));
            range(&[part[0] * a, part[0] * b, part[1] * a, part[1] * b])
        };
        let least_weight = light.abs().min(heavy.abs());
        Some(Enclosure {
            speed_squared: over(range(&square), 4, n * n),
            bend: over(range(&bend), 3, n * n * (n - 1.0)),
            // The derivatives are by the parameter of the part.
            acceleration: n * (longest(&change) + longest(&drag)) / (width * least_weight.powi(3)),
        })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Approximation, CubicPath, approximate};
    use bezier_mass::{Knots, MassPoint};

    #[test]
    fn a_uniform_b_spline_is_the_cubic_path() {
        let control = [
            (0.0, 0.0),
            (1.0, 1.6),
            (2.4, 1.2),
            (3.0, -0.8),
            (4.4, -1.0),
            (5.5, 0.6),
        ]
        .map(DVec2::from);
        let knots = Knots::new(3, (0..10).map(f64::from).collect()).unwrap();
        let spline = BSplineCurve::polynomial(knots, &control).unwrap();
        let rational = RationalPath::nurbs(&spline).unwrap();
        let cubic = CubicPath::uniform_bspline(&control, false).unwrap();
        assert_eq!(rational.spans(), cubic.spans());
        for how in [Approximation::within(1e-5), Approximation::quartics(1e-5)] {
            let (a, b) = (
                approximate(&rational, &how).unwrap(),
                approximate(&cubic, &how).unwrap(),
            );
            assert_eq!(a.spline.pieces().len(), b.spline.pieces().len());
            assert!((a.spline.length() - b.spline.length()).abs() < 1e-9);
        }
    }

    #[test]
    fn a_circle_of_four_conics_stays_a_circle() {
        // The quadratic NURBS circle with double knots.
        let knots = Knots::clamped(2, &[0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0]).unwrap();
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let control = (0..9)
            .map(|k| {
                let corner = k % 2 == 1;
                let direction = DVec2::from_angle(std::f64::consts::FRAC_PI_4 * f64::from(k));
                if corner {
                    MassPoint::point(direction / half, half)
                } else {
                    MassPoint::point(direction, 1.0)
                }
            })
            .collect();
        let circle = RationalPath::nurbs(&BSplineCurve::new(knots, control).unwrap()).unwrap();
        assert!(circle.is_closed());
        let result = approximate(&circle, &Approximation::within(1e-9)).unwrap();
        assert_eq!((result.spline.pieces().len(), result.corners), (4, 0));
        assert!((result.spline.length() - std::f64::consts::TAU).abs() < 1e-12);
    }

    #[test]
    fn gaps_and_points_at_infinity_are_refused() {
        let line = |a: DVec2, b: DVec2| BezierCurve::polynomial(&[a, b]).unwrap();
        let (o, x) = (DVec2::ZERO, DVec2::X);
        assert!(matches!(
            RationalPath::new(Vec::new()),
            Err(Error::TooFew { .. })
        ));
        assert!(matches!(
            RationalPath::new(vec![line(o, x), line(DVec2::ONE, x)]),
            Err(Error::Gap { index: 0, .. })
        ));
        let ray = BezierCurve::new(vec![MassPoint::point(o, 1.0), MassPoint::vector(x)]).unwrap();
        assert!(matches!(
            RationalPath::new(vec![ray]),
            Err(Error::NonFinite { .. })
        ));
    }
}
