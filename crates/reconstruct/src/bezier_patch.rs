//! Bézier patches with geodesic boundaries.
//!
//! Section 3.7 of the thesis chapter, and R. T. Farouki, N. Szafran, L. Biard, *Construction of Bézier surface
//! patches with Bézier curves as geodesic boundaries*, CAD 41, 2009. The frames of Section 3.6 are not rational;
//! the vectors `r'` and `r' x r''` span the same tangent planes and are: equation (3.11).

use crate::coons::CoonsPatch;
use crate::curve::taylor;
use crate::hermite::to_bernstein;
use crate::strip::{Strip, StripSample};
use crate::{Curve, Error, Series, VectorSeries};
use bezier_mass::{BezierCurve, BezierPatch, MassPoint, VectorSpace, bernstein};
use core::array::from_fn;
use glam::DVec3;

/// A Bézier curve over `[0, 1]` with its tangent planes spanned by polynomials: for `r = P / w`,
/// `along = Q / w` with `Q = P' w - P w'`, and `across = (Q x Q') / w` with all factors common to its three
/// coordinates divided out. Polynomial curves have `w = 1`, `Q = r'` and `Q x Q' = r' x r''`.
///
/// A plane curve's `across` is the normal of its plane, so its inflections do no harm; neither do isolated
/// inflections of other curves.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredStrip", into = "StoredStrip")
)]
pub struct BezierStrip {
    curve: BezierCurve<DVec3>,
    position: Vec<DVec3>,
    weight: Vec<f64>,
    along: Vec<DVec3>,
    across: Vec<DVec3>,
    divided: bool,
}

/// Relative size below which a polynomial counts as zero, or as lying along one direction.
const VANISHING: f64 = 1e-12;
/// Relative size of a binormal at a parameter that counts as an inflection to be divided out; a root is found
/// to the square root of rounding when it is double.
const INFLECTION: f64 = 1e-10;

impl BezierStrip {
    /// The strip of a polynomial curve or a rational one with positive weights.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a weight that is not positive; [`Error::TooFew`] for a curve of degree zero;
    /// [`Error::Inflection`] for a straight one.
    pub fn new(curve: BezierCurve<DVec3>) -> Result<Self, Error> {
        let control = curve.control();
        if control.len() < 2 {
            return Err(Error::TooFew {
                what: "control points",
                needed: 2,
                got: control.len(),
            });
        }
        if let Some(h) = control.iter().find(|h| !(h.weight > 0.0)) {
            return Err(Error::OutOfRange {
                what: "weight",
                value: h.weight,
                range: [0.0, f64::INFINITY],
            });
        }
        let first = control[0].weight;
        let polynomial = control.iter().all(|h| h.weight == first);
        let (position, weight): (Vec<DVec3>, Vec<f64>) = if polynomial {
            (
                control.iter().map(|h| h.weighted / first).collect(),
                vec![1.0],
            )
        } else {
            control.iter().map(|h| (h.weighted, h.weight)).unzip()
        };
        let along = if polynomial {
            bernstein::derivative(&position)
        } else {
            moment(control)
        };
        let across = wronskian(&along);
        let size = magnitude(&along);
        if magnitude(&across) <= VANISHING * size * size {
            return Err(Error::Inflection { side: 0, t: 0.0 });
        }
        let (across, divided) = without_common_factor(across);
        Ok(Self {
            curve,
            position,
            weight,
            along,
            across,
            divided,
        })
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &BezierCurve<DVec3> {
        &self.curve
    }
}

/// A strip by its curve; the rest is computed from it.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "BezierStrip")]
struct StoredStrip {
    curve: BezierCurve<DVec3>,
}

#[cfg(feature = "serde")]
impl From<BezierStrip> for StoredStrip {
    fn from(strip: BezierStrip) -> Self {
        Self { curve: strip.curve }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredStrip> for BezierStrip {
    type Error = Error;

    fn try_from(stored: StoredStrip) -> Result<Self, Error> {
        Self::new(stored.curve)
    }
}

impl Strip for BezierStrip {
    fn sample(&self, t: f64) -> StripSample {
        let mut position = VectorSeries::<4>(taylor(&self.position, t));
        let (mut along, mut across) = (
            VectorSeries::<3>(taylor(&self.along, t)),
            VectorSeries(taylor(&self.across, t)),
        );
        if self.weight.len() > 1 {
            let reciprocal = Series::<4>::constant(1.0) / Series(taylor(&self.weight, t));
            position = position.scaled(&reciprocal);
            let reciprocal = Series(from_fn(|k| reciprocal.0[k]));
            (along, across) = (along.scaled(&reciprocal), across.scaled(&reciprocal));
        }
        StripSample {
            point: from_fn(|k| position.derivative_at(k)),
            along: along.first_three(),
            across: across.first_three(),
        }
    }

    fn series(&self, t: f64) -> VectorSeries {
        self.curve.series(t)
    }

    fn passes_inflections(&self) -> bool {
        self.divided
    }
}

/// `P' w - P w'` without the formal top degree: `n (P1 w0 - P0 w1)`, where index 0 and 1 mean the polynomials of
/// the first and of the last `n` coefficients.
fn moment(control: &[MassPoint<DVec3>]) -> Vec<DVec3> {
    let n = control.len() - 1;
    bernstein::product_with(&control[..n], &control[1..], |a, b| {
        (b.weighted * a.weight - a.weighted * b.weight) * n as f64
    })
}

/// `Q x Q' = n (Q0 x Q1)`, in the same notation: degree `2 n - 2` without a cancelled leading term.
fn wronskian(q: &[DVec3]) -> Vec<DVec3> {
    let n = q.len() - 1;
    bernstein::product_with(&q[..n], &q[1..], |a, b| a.cross(*b) * n as f64)
}

fn magnitude<V: VectorSpace>(coefficients: &[V]) -> f64 {
    coefficients
        .iter()
        .fold(0.0, |largest, c| largest.max(c.magnitude()))
}

/// The polynomial divided by what its coordinates have in common: a constant direction, or zeros in `[0, 1]`.
/// Says whether anything was divided out.
fn without_common_factor(mut across: Vec<DVec3>) -> (Vec<DVec3>, bool) {
    let largest =
        across.iter().copied().fold(
            DVec3::ZERO,
            |a, b| if b.length() > a.length() { b } else { a },
        );
    let direction = largest.normalize_or_zero();
    if across
        .iter()
        .all(|b| b.cross(direction).length() <= VANISHING * largest.length())
    {
        return (vec![direction], true);
    }
    let mut divided = false;
    while across.len() > 1 {
        let Some(root) = common_zero(&across) else {
            break;
        };
        across = divide_by_root(&across, root);
        divided = true;
    }
    (across, divided)
}

/// Probes for common zeros, a few for every zero that a binormal of the degrees in use can have.
const PROBES: usize = 48;

/// A parameter in `[0, 1]` where all coordinates vanish.
fn common_zero(polynomial: &[DVec3]) -> Option<f64> {
    let size = magnitude(polynomial);
    let at = |t: f64| bernstein::evaluate(polynomial, t);
    let slope = bernstein::derivative(polynomial);
    let probe = |i: usize| i as f64 / PROBES as f64;
    let lengths: Vec<f64> = (0..=PROBES).map(|i| at(probe(i)).length()).collect();
    for i in 0..=PROBES {
        let lowest = (i == 0 || lengths[i] <= lengths[i - 1])
            && (i == PROBES || lengths[i] <= lengths[i + 1]);
        if !lowest || lengths[i] > 0.3 * size {
            continue;
        }
        // Gauss-Newton for the least |B|; at a common zero it converges to it, linearly if the zero is double.
        let mut t = probe(i);
        for _ in 0..60 {
            let d = bernstein::evaluate(&slope, t);
            let step = at(t).dot(d) / d.length_squared();
            if !step.is_finite() || step.abs() <= f64::EPSILON {
                break;
            }
            t = (t - step).clamp(0.0, 1.0);
        }
        if at(t).length() <= INFLECTION * size {
            return Some(t);
        }
    }
    None
}

/// The quotient by `t - root`, from the end where the recursion contracts.
fn divide_by_root(polynomial: &[DVec3], root: f64) -> Vec<DVec3> {
    let n = polynomial.len() - 1;
    let mut quotient = vec![DVec3::ZERO; n];
    let degree = n as f64;
    // The coefficients of the product of quotient and (t - root):
    // b_i = -root (n - i)/n c_i + (1 - root) i/n c_(i-1).
    if root >= 0.5 {
        for i in 0..n {
            let before = if i == 0 {
                DVec3::ZERO
            } else {
                quotient[i - 1] * ((1.0 - root) * i as f64 / degree)
            };
            quotient[i] = (polynomial[i] - before) * (degree / ((n - i) as f64 * -root));
        }
    } else {
        for i in (1..=n).rev() {
            let after = if i == n {
                DVec3::ZERO
            } else {
                quotient[i] * (-root * (n - i) as f64 / degree)
            };
            quotient[i - 1] = (polynomial[i] - after) * (degree / (i as f64 * (1.0 - root)));
        }
    }
    quotient
}

/// Two opposite boundaries as polynomial columns over a common denominator.
struct Columns {
    /// Numerators of `r`, `T`, `T`, `r` of the two boundaries.
    numerators: [Vec<DVec3>; 4],
    denominator: Vec<f64>,
}

impl CoonsPatch<BezierStrip> {
    /// This patch as a tensor-product Bézier patch, exactly: polynomial of bidegree `2 n - 1` for polynomial
    /// boundaries of degree `n` with torsion (`n + 2` for plane ones), rational of bidegree at most `5 n - 3`
    /// for rational ones and `4 n - 3` where opposite boundaries have the same weights. Rows run along `u`.
    ///
    /// # Errors
    /// [`Error::Bezier`] if a control point is not finite.
    pub fn to_bezier(&self) -> Result<BezierPatch<DVec3>, Error> {
        let (by_u, by_v) = (self.columns(0, 2), self.columns(1, 3));
        let blends = |denominator: &[f64]| -> [Vec<f64>; 4] {
            from_fn(|k| {
                bernstein::product(
                    denominator,
                    &to_bernstein(from_fn(|i| f64::from(u8::from(i == k)))),
                )
            })
        };
        let (blend_u, blend_v) = (blends(&by_u.denominator), blends(&by_v.denominator));
        let degree = |columns: &Columns, blend: &[Vec<f64>; 4]| {
            columns
                .numerators
                .iter()
                .map(Vec::len)
                .chain(blend.iter().map(Vec::len))
                .max()
                .unwrap_or(1)
                - 1
        };
        let degrees = [degree(&by_u, &blend_u), degree(&by_v, &blend_v)];
        let blend_u = blend_u.map(|b| elevated(&b, degrees[0]));
        let blend_v = blend_v.map(|b| elevated(&b, degrees[1]));
        let weights = [
            elevated(&by_u.denominator, degrees[0]),
            elevated(&by_v.denominator, degrees[1]),
        ];
        let columns_u = by_u.numerators.map(|x| elevated(&x, degrees[0]));
        let columns_v = by_v.numerators.map(|y| elevated(&y, degrees[1]));
        let mut control = Vec::with_capacity((degrees[0] + 1) * (degrees[1] + 1));
        for i in 0..=degrees[0] {
            // The part of R_0 that blends to the corner data at this row.
            let corners: [DVec3; 4] =
                from_fn(|l| (0..4).map(|k| self.grid()[k][l] * blend_u[k][i]).sum());
            for j in 0..=degrees[1] {
                let weighted: DVec3 = (0..4)
                    .map(|k| {
                        (columns_u[k][i] - corners[k]) * blend_v[k][j]
                            + columns_v[k][j] * blend_u[k][i]
                    })
                    .sum();
                control.push(MassPoint::from_homogeneous(
                    weights[0][i] * weights[1][j],
                    weighted,
                ));
            }
        }
        Ok(BezierPatch::new(degrees, control)?)
    }

    fn columns(&self, low: usize, high: usize) -> Columns {
        let strips = self.rectangle().strips();
        let [first, second] = [&strips[low], &strips[high]];
        let numerators = |side: usize| {
            let (strip, field) = (&strips[side], &self.fields()[side]);
            let along = bernstein::product(&to_bernstein(field.along), &strip.along);
            let across = bernstein::product(&to_bernstein(field.across), &strip.across);
            (strip.position.clone(), sum(along, across))
        };
        let ((r1, t1), (r3, t3)) = (numerators(low), numerators(high));
        if proportional(&first.weight, &second.weight) {
            let factor = first.weight[0] / second.weight[0];
            let scaled = |x: Vec<DVec3>| x.into_iter().map(|c| c * factor).collect();
            return Columns {
                numerators: [r1, t1, scaled(t3), scaled(r3)],
                denominator: first.weight.clone(),
            };
        }
        let times = |weight: &[f64], x: &[DVec3]| bernstein::product(weight, x);
        Columns {
            numerators: [
                times(&second.weight, &r1),
                times(&second.weight, &t1),
                times(&first.weight, &t3),
                times(&first.weight, &r3),
            ],
            denominator: bernstein::product(&first.weight, &second.weight),
        }
    }
}

/// Whether two lists of positive weights describe the same denominator up to a factor.
fn proportional(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(x, y)| (x * b[0] - y * a[0]).abs() <= 4.0 * f64::EPSILON * x * b[0])
}

fn elevated<V: VectorSpace>(coefficients: &[V], degree: usize) -> Vec<V> {
    bernstein::product(&vec![1.0; degree + 2 - coefficients.len()], coefficients)
}

fn sum(a: Vec<DVec3>, b: Vec<DVec3>) -> Vec<DVec3> {
    let degree = a.len().max(b.len()) - 1;
    elevated(&a, degree)
        .into_iter()
        .zip(elevated(&b, degree))
        .map(|(x, y)| x + y)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_by_roots() {
        let factor: Vec<DVec3> = (0..5)
            .map(|i| DVec3::new(1.0 + f64::from(i), (f64::from(i)).cos(), -2.0))
            .collect();
        for root in [0.0, 0.2, 0.5, 0.77, 1.0] {
            let product = bernstein::product(&[-root, 1.0 - root], &factor);
            for (a, b) in divide_by_root(&product, root).iter().zip(&factor) {
                assert!((*a - *b).length() < 1e-13);
            }
            assert!((common_zero(&product).unwrap() - root).abs() < 1e-12);
        }
        assert_eq!(common_zero(&factor), None);
    }

    /// A space cubic has an inflection nowhere; a quintic is built with one in the middle, which is divided out.
    #[test]
    fn an_isolated_inflection_is_passed() {
        // r'' = (t - 1/2) a(t): r' x r'' vanishes at 1/2, and r' x a does not.
        let a = [DVec3::new(1.0, 2.0, 0.0), DVec3::new(0.0, 2.0, 3.0)];
        let second = bernstein::product(&[-0.5, 0.5], &a);
        let velocity = bernstein::integral(&second, DVec3::new(1.0, 0.0, 0.5));
        let curve = BezierCurve::polynomial(&bernstein::integral(&velocity, DVec3::ZERO)).unwrap();
        let strip = BezierStrip::new(curve).unwrap();
        assert!(strip.passes_inflections());
        let [before, at, after] = [0.499, 0.5, 0.501].map(|t| strip.sample(t));
        assert!(at.across[0].length() > 0.1 && before.across[0].dot(after.across[0]) > 0.0);
        assert!(at.across[0].dot(at.point[1]).abs() < 1e-12);
        // Across stays normal to the acceleration: the strip is the one of the curve.
        assert!(after.across[0].dot(after.point[2]).abs() < 1e-12);
    }

    #[test]
    fn lines_and_bad_weights_are_refused() {
        let line = BezierCurve::polynomial(&[DVec3::ZERO, DVec3::X, DVec3::X * 3.0]).unwrap();
        assert!(matches!(
            BezierStrip::new(line),
            Err(Error::Inflection { .. })
        ));
        let control = [(DVec3::ZERO, 1.0), (DVec3::Y, -1.0), (DVec3::X, 1.0)]
            .map(|(p, w)| MassPoint::point(p, w));
        let negative = BezierCurve::new(control.to_vec()).unwrap();
        assert!(matches!(
            BezierStrip::new(negative),
            Err(Error::OutOfRange { .. })
        ));
        let plane =
            BezierCurve::polynomial(&[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]).unwrap();
        assert_eq!(BezierStrip::new(plane).unwrap().across.len(), 1);
    }
}
