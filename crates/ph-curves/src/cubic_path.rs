//! Paths of cubic Bézier spans.

use bezier_mass::bernstein;
use glam::DVec2;

use crate::plane_curve::{STRAIGHT, one_signed, push_roots};
use crate::polynomial::range;
use crate::{Break, BreakKind, Enclosure, Error, PlaneCurve, Side};

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
#[cfg_attr(feature = "serde", serde(try_from = "StoredPath", into = "StoredPath"))]
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

/// The form in which a path is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredPath {
    cubics: Vec<[DVec2; 4]>,
    closed: bool,
}

#[cfg(feature = "serde")]
impl From<CubicPath> for StoredPath {
    fn from(path: CubicPath) -> Self {
        Self {
            cubics: path.cubics,
            closed: path.closed,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredPath> for CubicPath {
    type Error = Error;

    fn try_from(stored: StoredPath) -> Result<Self, Error> {
        Self::new(stored.cubics, stored.closed)
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

#[inline]
fn legs(cubic: &[DVec2; 4]) -> [DVec2; 3] {
    [
        cubic[1] - cubic[0],
        cubic[2] - cubic[1],
        cubic[3] - cubic[2],
    ]
}

/// Bernstein coefficients of det(D, D') / 2, with the hodograph D = r'/3 of these legs.
#[inline]
fn bend([d0, d1, d2]: [DVec2; 3]) -> [f64; 3] {
    [d0.perp_dot(d1), 0.5 * d0.perp_dot(d2), d1.perp_dot(d2)]
}

/// Whether the bend of these legs is rounding.
#[inline]
fn is_straight(legs: &[DVec2; 3], [a, b, c]: &[f64; 3]) -> bool {
    let size = legs
        .map(DVec2::abs)
        .into_iter()
        .fold(DVec2::ZERO, DVec2::max);
    let size = size.max_element();
    a.abs().max(2.0 * b.abs()).max(c.abs()) <= STRAIGHT * size * size
}

impl PlaneCurve for CubicPath {
    fn spans(&self) -> usize {
        self.cubics.len()
    }

    fn is_closed(&self) -> bool {
        self.closed
    }

    #[inline(always)]
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

    #[inline]
    fn is_straight(&self, span: usize) -> bool {
        let legs = legs(&self.cubics[span]);
        is_straight(&legs, &bend(legs))
    }

    #[inline]
    fn inflections(&self, span: usize, breaks: &mut Vec<Break>) {
        let legs = legs(&self.cubics[span]);
        let bend = bend(legs);
        if !is_straight(&legs, &bend) {
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

    fn continued_inflections(&self, span: usize) -> [Option<f64>; 2] {
        // b0 s^2 + 2 b1 s t + b2 t^2 by powers of t.
        let [b0, b1, b2] = bend(legs(&self.cubics[span]));
        let (a, half) = (b0 - 2.0 * b1 + b2, b1 - b0);
        let root = (half * half - a * b0).sqrt();
        let far = -half - root.copysign(half);
        [far / a, b0 / far].map(|t| t.is_finite().then_some(t))
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

    fn enclosure(&self, span: usize, [from, to]: [f64; 2]) -> Option<Enclosure> {
        let legs = legs(&self.cubics[span]);
        // det(r', r'') is 18 times the bend, and r' 3 times the hodograph of the legs.
        let bend = bernstein::restrict(&bend(legs), from, to);
        let hodograph = bernstein::restrict(&legs, from, to);
        let square = bernstein::product_with(&hodograph, &hodograph, |a, b| a.dot(*b));
        let second = [from, to].map(|t| self.jet(span, t)[2].length());
        Some(Enclosure {
            speed_squared: range(&square).map(|q| 9.0 * q),
            bend: range(&bend).map(|b| 18.0 * b),
            acceleration: second[0].max(second[1]),
        })
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
