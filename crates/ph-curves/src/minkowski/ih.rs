//! Isoperimetric-hodograph curves: rational curves whose general offsets are rational.

use std::f64::consts::TAU;

use bezier_mass::{BezierCurve, bernstein};
use glam::{DVec2, DVec3};

use super::{Bumped, Ellipse};
use crate::complex::{sqrt, square};
use crate::{DualCurve, Error};

/// A dual Bézier curve whose Bézier and Farin lines are parallel to those of an arc of the indicatrix: its `U`-offsets
/// move each line by the distance times the support of the indicatrix's line, and are rational of the same class.
///
/// This is Pottmann's construction with the indicatrix in the part of the unit circle.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IsoperimetricArc {
    curve: DualCurve,
    indicatrix: DualCurve,
}

/// Lines count as parallel in the same scale if their normals agree to this share of the largest one: a few thousand
/// roundings, and far below any tolerance of drawing.
const PARALLEL_TOLERANCE: f64 = 1e-12;

impl IsoperimetricArc {
    /// Pairs a dual curve with the arc of the indicatrix that has the same normals, of the same class; the indicatrix is
    /// brought to the scale of the curve.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] if the classes differ; [`Error::NotParallel`] with the first pair of lines that are not.
    pub fn try_new(curve: DualCurve, indicatrix: &DualCurve) -> Result<Self, Error> {
        let (given, needed) = (indicatrix.vectors().len(), curve.vectors().len());
        if given != needed {
            return Err(Error::TooFew {
                what: "lines of the indicatrix",
                given,
                needed,
            });
        }
        let normal = |u: &DVec3| DVec2::new(u.y, u.z);
        let pairs = || {
            curve
                .vectors()
                .iter()
                .zip(indicatrix.vectors())
                .map(|(u, v)| (normal(u), normal(v)))
        };
        let shared = pairs().map(|(n, m)| n.dot(m)).sum::<f64>();
        let scale = shared / pairs().map(|(_, m)| m.length_squared()).sum::<f64>();
        let size = pairs().map(|(n, _)| n.length()).fold(0.0, f64::max);
        for (index, (n, m)) in pairs().enumerate() {
            let defect = (n - scale * m).length() / size;
            if defect.is_nan() || defect > PARALLEL_TOLERANCE {
                return Err(Error::NotParallel { index, defect });
            }
        }
        let scaled: Vec<DVec3> = indicatrix.vectors().iter().map(|v| scale * *v).collect();
        Ok(Self {
            curve,
            indicatrix: DualCurve::from_vectors(&scaled)?,
        })
    }

    /// The curve with the normals of an arc of the indicatrix and these support coefficients: lines `(-g_i, n_i)`.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] unless there is one coefficient a line; [`Error::NonFinite`].
    pub fn from_supports(indicatrix: DualCurve, supports: &[f64]) -> Result<Self, Error> {
        let (given, needed) = (supports.len(), indicatrix.vectors().len());
        if given != needed {
            return Err(Error::TooFew {
                what: "support coefficients",
                given,
                needed,
            });
        }
        let lines: Vec<DVec3> = indicatrix
            .vectors()
            .iter()
            .zip(supports)
            .map(|(v, g)| DVec3::new(-g, v.y, v.z))
            .collect();
        Ok(Self {
            curve: DualCurve::from_vectors(&lines)?,
            indicatrix,
        })
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &DualCurve {
        &self.curve
    }

    /// The arc of the indicatrix with the same normals.
    #[must_use]
    pub fn indicatrix(&self) -> &DualCurve {
        &self.indicatrix
    }

    /// The general offset at a signed distance along the outward normal: `u0 -> u0 - d P_i`, exact.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`].
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        let moved = self.curve.vectors().iter().zip(self.indicatrix.vectors());
        let lines: Vec<DVec3> = moved
            .map(|(u, v)| DVec3::new(u.x + distance * v.x, u.y, u.z))
            .collect();
        Ok(Self {
            curve: DualCurve::from_vectors(&lines)?,
            indicatrix: self.indicatrix.clone(),
        })
    }

    /// The arc with opposite normals that makes a curve of constant Minkowski width together with this one.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`].
    pub fn antipode(&self, width: f64) -> Result<Self, Error> {
        let inner = self.offset(-width)?;
        let turned = |curve: &DualCurve, sign: f64| {
            let lines: Vec<DVec3> = curve
                .vectors()
                .iter()
                .map(|u| DVec3::new(sign * u.x, -u.y, -u.z))
                .collect();
            DualCurve::from_vectors(&lines)
        };
        Ok(Self {
            curve: turned(&inner.curve, -1.0)?,
            indicatrix: turned(&self.indicatrix, 1.0)?,
        })
    }

    /// Whether the arc turns left with a positive radius of curvature throughout, proved by Bernstein coefficients.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        let lines = self.curve.vectors();
        let first = bernstein::derivative(lines);
        let cross = bernstein::product_with(lines, &first, |u, v| u.cross(*v));
        // R = -det(U, U', U'') |n|³ / s³ with s > 0.
        let bend =
            bernstein::product_with(&cross, &bernstein::derivative(&first), |u: &DVec3, v| {
                -u.dot(*v)
            });
        crate::rosette::keeps_positive(&self.curve.turn_polynomial(), 0)
            && crate::rosette::keeps_positive(&bend, 0)
    }
}

impl Ellipse {
    /// How far a rational curve is from being isoperimetric with respect to this ellipse: `||F'||_U0` is rational if and
    /// only if `b² x'² + a² y'²`, freed of denominators, is the square of a polynomial. The result is the relative
    /// residual of its square root: below 1e-9 for such a curve up to degree 17, far above for others unless they are
    /// nearly such (of 300 random cubics the least has 6e-5).
    ///
    /// For an indicatrix given by dual arcs there is no such test; see [`Bumped::isoperimetric_residual`].
    ///
    /// # Errors
    ///
    /// [`Error::BadRadius`] unless both semi-axes are positive and finite; [`Error::SinglePoint`].
    pub fn isoperimetric_residual(&self, curve: &BezierCurve<DVec2>) -> Result<f64, Error> {
        self.check()?;
        let stretch = DVec2::new(self.b, self.a) / self.a.max(self.b);
        square_root_residual(curve, stretch)
    }
}

impl Bumped {
    /// How far a rational curve is from being isoperimetric with respect to this curve, as for
    /// [`Ellipse::isoperimetric_residual`]. With the normal's direction `N` as a complex number the norm is
    /// `||F'||_U0 = |F'| (1 + height Re N⁴) = (|F'|⁴ + height Re F'⁴) / |F'|³`: rational if and only if `|F'|` is, that is,
    /// for the Pythagorean curves.
    ///
    /// # Errors
    ///
    /// [`Error::NotConvex`] unless `|height| < 1/15`; [`Error::SinglePoint`].
    pub fn isoperimetric_residual(&self, curve: &BezierCurve<DVec2>) -> Result<f64, Error> {
        self.check()?;
        square_root_residual(curve, DVec2::ONE)
    }
}

/// Rounding may grow by this much from the coefficients of `s` to its values on the ellipse.
const GROWTH: f64 = 1e3;
/// A residual that needs no other ellipse to be lower.
const ROUNDING: f64 = 1e-12;
/// Ellipses tried, the largest sum of distances of their points to 0 and 1, and the least number of points on them.
const ELLIPSES: usize = 12;
const WIDEST: f64 = 2.0;
const LEAST_POINTS: usize = 512;

/// The largest difference, relative to the largest value, between `s = |stretch F'|²`, freed of denominators, and the
/// square of a polynomial of half its degree.
///
/// The root is followed around an ellipse with foci 0 and 1 in the complex plane, so that its sign is known where it
/// changes on the interval, and expanded in Chebyshev polynomials there; common factors of `s` do not matter. A square is
/// one on every ellipse, but may pass near its zeros on some: the least residual of some ellipses counts.
fn square_root_residual(curve: &BezierCurve<DVec2>, stretch: DVec2) -> Result<f64, Error> {
    let control = homogeneous(curve, stretch);
    let last = control.len() - 1;
    let polynomial = control.iter().all(|mass| mass[2] == control[0][2]);
    let degree = match last {
        0 => return Err(Error::SinglePoint),
        _ if polynomial => last - 1,
        _ => 2 * (last - 1),
    };
    let widest = GROWTH.powf(0.5 / degree.max(1) as f64).min(WIDEST);
    let residuals = (1..=ELLIPSES).filter_map(|ellipse| {
        let sum = 1.0 + (widest - 1.0) * ellipse as f64 / ELLIPSES as f64;
        residual_on_ellipse(&control, degree, sum + (sum * sum - 1.0).sqrt())
    });
    let mut least = None;
    for residual in residuals {
        least = Some(least.map_or(residual, |least: f64| least.min(residual)));
        if residual < ROUNDING {
            break;
        }
    }
    least.ok_or(Error::SinglePoint)
}

/// The residual on the ellipse of the points `1/2 + (u + 1/u) / 4`, `|u| = radius`; none if the curve is a point.
fn residual_on_ellipse(control: &[[f64; 3]], degree: usize, radius: f64) -> Option<f64> {
    let points = LEAST_POINTS.max(8 * (degree + 1));
    let angle = |j: usize| TAU * j as f64 / points as f64;
    let values: Vec<DVec2> = (0..points)
        .map(|j| {
            let (u, inverse) = joukowski(radius, angle(j));
            squared_speed(control, DVec2::new(0.5, 0.0) + 0.25 * (u + inverse))
        })
        .collect();
    let size = values.iter().map(|s| s.length()).fold(0.0, f64::max);
    if size == 0.0 {
        return None;
    }
    let mut roots: Vec<DVec2> = Vec::with_capacity(points);
    for value in &values {
        let root = sqrt(*value / size);
        // Extrapolated from the last two, so that it may pass near zero.
        let expected = match roots[..] {
            [.., before, last] => 2.0 * last - before,
            [last] => last,
            [] => root,
        };
        roots.push(if expected.dot(root) < 0.0 {
            -root
        } else {
            root
        });
    }
    let coefficients: Vec<DVec2> = (0..=degree)
        .map(|k| {
            let waves = roots.iter().enumerate();
            let sum: DVec2 = waves
                .map(|(j, root)| root.rotate(DVec2::from_angle(-angle(j * k % points))))
                .sum();
            let share = if k == 0 {
                1.0
            } else {
                2.0 * radius.powi(-(k as i32))
            };
            sum * (share / points as f64)
        })
        .collect();
    let residual = |(j, value): (usize, &DVec2)| {
        let (mut power, mut inverse) = (DVec2::X, DVec2::X);
        let (u, over) = joukowski(radius, angle(j));
        let root = coefficients.iter().fold(DVec2::ZERO, |sum, coefficient| {
            let next = sum + coefficient.rotate(0.5 * (power + inverse));
            (power, inverse) = (power.rotate(u), inverse.rotate(over));
            next
        });
        (square(root) - *value / size).length()
    };
    Some(values.iter().enumerate().map(residual).fold(0.0, f64::max))
}

/// `u = radius e^{i angle}` and `1 / u`.
fn joukowski(radius: f64, angle: f64) -> (DVec2, DVec2) {
    (
        radius * DVec2::from_angle(angle),
        DVec2::from_angle(-angle) / radius,
    )
}

/// The control points as `(w x, w y, w)`, stretched, about one of them and of size one.
fn homogeneous(curve: &BezierCurve<DVec2>, stretch: DVec2) -> Vec<[f64; 3]> {
    let control = curve.control();
    let heaviest = control
        .iter()
        .fold(0.0, |m: f64, mass| m.max(mass.weight.abs()));
    let origin = control
        .iter()
        .find_map(|mass| mass.position())
        .unwrap_or(DVec2::ZERO);
    let moved: Vec<DVec2> = control
        .iter()
        .map(|mass| stretch * (mass.weighted - mass.weight * origin))
        .collect();
    let size = moved
        .iter()
        .fold(0.0, |m: f64, v| m.max(v.abs().max_element()));
    let (size, heaviest) = (
        if size > 0.0 { size } else { 1.0 },
        if heaviest > 0.0 { heaviest } else { 1.0 },
    );
    control
        .iter()
        .zip(moved)
        .map(|(mass, v)| [v.x / size, v.y / size, mass.weight / heaviest])
        .collect()
}

/// `(x' w - x w')² + (y' w - y w')²` at a complex parameter, from the last step of de Casteljau, up to a constant.
fn squared_speed(control: &[[f64; 3]], z: DVec2) -> DVec2 {
    let mut row: Vec<[DVec2; 3]> = control
        .iter()
        .map(|mass| mass.map(|c| DVec2::new(c, 0.0)))
        .collect();
    while row.len() > 2 {
        for k in 1..row.len() {
            row[k - 1] =
                std::array::from_fn(|i| row[k - 1][i] + z.rotate(row[k][i] - row[k - 1][i]));
        }
        row.pop();
    }
    let [a, b] = row[..] else {
        return DVec2::ZERO;
    };
    let moment = |i: usize| a[2].rotate(b[i]) - b[2].rotate(a[i]);
    square(moment(0)) + square(moment(1))
}

#[cfg(test)]
mod tests {
    use super::super::{Indicatrix, MinkowskiPlane, Support};
    use super::*;
    use crate::{PolynomialPh, SupportJet};

    #[test]
    fn offsets_of_isoperimetric_arcs_are_minkowski_sums() {
        let bumped = Bumped { height: 0.05 };
        let arc = bumped.arc(0.3, 1.5).unwrap();
        let supports = [3.0, 3.1, 3.0, 2.9, 3.2, 3.0, 3.1, 3.0, 2.9];
        let curve = IsoperimetricArc::from_supports(arc.clone(), &supports).unwrap();
        let again = IsoperimetricArc::try_new(curve.curve().clone(), &arc).unwrap();
        assert_eq!(again.curve(), curve.curve());
        let offset = curve.offset(0.4).unwrap();
        for i in 0..=10 {
            let t = f64::from(i) / 10.0;
            let (here, there) = (
                curve.curve().contact(t).unwrap(),
                offset.curve().contact(t).unwrap(),
            );
            let unit = bumped.contact(here.normal.to_angle());
            assert!((there.point - here.point - 0.4 * unit.point).length() < 1e-11);
            assert!((there.normal - here.normal).length() < 1e-14);
        }
        let tilted = Bumped { height: 0.01 }.arc(0.3, 1.6).unwrap();
        assert!(matches!(
            IsoperimetricArc::try_new(curve.curve().clone(), &tilted),
            Err(Error::NotParallel { .. })
        ));
    }

    /// A curve is isoperimetric for an ellipse if and only if its affine image is Pythagorean.
    #[test]
    fn isoperimetric_curves_are_recognised() {
        let ellipse = Ellipse { a: 2.0, b: 1.0 };
        let preimage = [
            DVec2::new(1.0, 0.2),
            DVec2::new(0.8, -0.7),
            DVec2::new(0.4, 0.9),
        ];
        let ph = PolynomialPh::try_new(DVec2::ZERO, preimage).unwrap();
        let stretched: Vec<DVec2> = ph
            .control_points()
            .iter()
            .map(|p| DVec2::new(2.0, 1.0) * *p)
            .collect();
        let image = BezierCurve::polynomial(&stretched).unwrap();
        let plain = BezierCurve::polynomial(ph.control_points()).unwrap();
        let residual = ellipse.isoperimetric_residual(&image).unwrap();
        assert!(residual < 1e-12, "{residual:e}");
        assert!(ellipse.isoperimetric_residual(&plain).unwrap() > 1e-3);
        let dual =
            IsoperimetricArc::from_supports(ellipse.arc(0.1, 1.3).unwrap(), &[2.0, 2.3, 2.2])
                .unwrap();
        let dual = dual.curve().to_points().unwrap();
        assert!(ellipse.isoperimetric_residual(&dual).unwrap() < 1e-10);
    }

    /// A number in (-1, 1) from a multiplicative congruence.
    fn next(state: &mut u64) -> f64 {
        *state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// Images of Pythagorean curves and of their offsets are isoperimetric by construction, whatever their degree and
    /// wherever their speed vanishes.
    #[test]
    fn images_of_pythagorean_curves_of_high_degree_are_recognised() {
        let ellipse = Ellipse { a: 2.0, b: 1.0 };
        let mut state = 7;
        for (degree, bound) in [(2, 1e-10), (4, 1e-9), (6, 1e-8)] {
            for _ in 0..30 {
                let preimage: Vec<DVec2> = (0..=degree)
                    .map(|_| DVec2::new(next(&mut state), next(&mut state)))
                    .collect();
                let ph = PolynomialPh::try_new(DVec2::ZERO, preimage).unwrap();
                let curve = BezierCurve::polynomial(ph.control_points()).unwrap();
                let stretched = |curve: &BezierCurve<DVec2>| {
                    curve
                        .map(|mass| mass.map_linear(|p| DVec2::new(2.0, 1.0) * p))
                        .unwrap()
                };
                let residual = ellipse.isoperimetric_residual(&stretched(&curve)).unwrap();
                assert!(residual < 1e-13, "degree {degree}: {residual:e}");
                let offset = stretched(&ph.offset(0.3).unwrap());
                let residual = ellipse.isoperimetric_residual(&offset).unwrap();
                assert!(residual < bound, "offset of degree {degree}: {residual:e}");
            }
        }
        for _ in 0..100 {
            let plain = [(); 4].map(|()| DVec2::new(next(&mut state), next(&mut state)));
            let plain = BezierCurve::polynomial(&plain).unwrap();
            let residual = ellipse.isoperimetric_residual(&plain).unwrap();
            assert!(residual > 1e-5, "{residual:e}");
        }
    }

    #[test]
    fn the_bumped_curve_has_the_pythagorean_curves() {
        let bumped = Bumped { height: 0.05 };
        let w = [
            DVec2::new(1.0, 0.2),
            DVec2::new(0.8, -0.7),
            DVec2::new(0.4, 0.9),
        ];
        let ph = PolynomialPh::try_new(DVec2::ZERO, w).unwrap();
        let curve = |stretch: DVec2| {
            let points: Vec<DVec2> = ph.control_points().iter().map(|p| stretch * *p).collect();
            BezierCurve::polynomial(&points).unwrap()
        };
        assert!(bumped.isoperimetric_residual(&curve(DVec2::ONE)).unwrap() < 1e-12);
        assert!(
            bumped
                .isoperimetric_residual(&curve(DVec2::new(2.0, 1.0)))
                .unwrap()
                > 1e-3
        );
        assert!(
            Bumped { height: 0.1 }
                .isoperimetric_residual(&curve(DVec2::ONE))
                .is_err()
        );
        let nothing = Ellipse {
            a: f64::NAN,
            b: 1.0,
        };
        assert!(matches!(
            nothing.isoperimetric_residual(&curve(DVec2::ONE)),
            Err(Error::BadRadius { .. })
        ));
        let point = BezierCurve::polynomial(&[DVec2::ONE; 4]).unwrap();
        assert_eq!(
            bumped.isoperimetric_residual(&point),
            Err(Error::SinglePoint)
        );
    }

    /// The other characterisation: such curves are the involutes of curves with rational `U`-length, which is the change
    /// of the circular radius between two points of the evolute.
    #[test]
    fn the_length_of_the_evolute_is_the_change_of_the_radius() {
        let bumped = Bumped { height: 0.03 };
        let plane = MinkowskiPlane::new(Indicatrix::try_new(bumped).unwrap());
        let curve = |psi: f64| SupportJet {
            support: 5.0 + 0.2 * psi.sin() + psi,
            slope: 0.2 * psi.cos() + 1.0,
            bend: -0.2 * psi.sin(),
        };
        let radius = |psi: f64| curve(psi).radius() / bumped.jet(psi).radius();
        let centre =
            |psi: f64| curve.contact(psi).point - radius(psi) * plane.indicatrix_point(psi);
        let step = 1e-4;
        let speed = |psi: f64| (centre(psi + step) - centre(psi - step)) / (2.0 * step);
        let length = plane.arc_length(0.2, 0.5, 2, speed);
        assert!((length - (radius(0.5) - radius(0.2)).abs()).abs() < 1e-6);
    }
}
