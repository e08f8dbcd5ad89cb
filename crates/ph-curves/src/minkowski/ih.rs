//! Isoperimetric-hodograph curves: rational curves whose general offsets are rational.

use bezier_mass::{BezierCurve, bernstein};
use glam::{DVec2, DVec3};

use super::Ellipse;
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
    /// residual of its square root: at rounding for such a curve, typically above 1e-3 for others.
    #[must_use]
    pub fn isoperimetric_residual(&self, curve: &BezierCurve<DVec2>) -> f64 {
        let control = curve.control();
        let last = control.len() - 1;
        let polynomial = control.iter().all(|mass| mass.weight == control[0].weight);
        let hodograph = if polynomial {
            bernstein::derivative(&control.iter().map(|mass| mass.weighted).collect::<Vec<_>>())
        } else {
            // X' w - X w' of degree 2n - 2, from the last step of de Casteljau.
            bernstein::product_with(&control[..last], &control[1..], |a, b| a.moment(*b))
        };
        let stretch = DVec2::new(self.b, self.a);
        let square = bernstein::product_with(&hodograph, &hodograph, |u, v| {
            (stretch * *u).dot(stretch * *v)
        });
        square_root_residual(&square)
    }
}

/// The largest difference between a non-negative polynomial and the square of its formal square root, over its largest
/// coefficient. The root is developed at an inner parameter where the polynomial is not small.
fn square_root_residual(polynomial: &[f64]) -> f64 {
    let start = [0.1, 0.23, 0.37].into_iter().max_by(|&s, &t| {
        bernstein::evaluate::<f64>(polynomial, s).total_cmp(&bernstein::evaluate(polynomial, t))
    });
    let square = bernstein::restrict(polynomial, start.unwrap_or(0.1), 1.0);
    let (degree, size) = (
        square.len().saturating_sub(1),
        square.iter().fold(0.0, |m: f64, c| m.max(c.abs())),
    );
    if size == 0.0 {
        return 0.0;
    }
    let mut scaled = vec![square[0].sqrt()];
    for k in 1..=degree / 2 {
        let known: f64 = (1..k).map(|i| scaled[i] * scaled[k - i]).sum();
        scaled.push((bernstein::binomial(degree, k) * square[k] - known) / (2.0 * scaled[0]));
    }
    let root: Vec<f64> = scaled
        .iter()
        .enumerate()
        .map(|(k, c)| c / bernstein::binomial(degree / 2, k))
        .collect();
    let found = bernstein::elevate_to(&bernstein::product(&root, &root), degree);
    found
        .iter()
        .zip(&square)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
        / size
}

#[cfg(test)]
mod tests {
    use super::super::{Bumped, Indicatrix, MinkowskiPlane, Support};
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
        let residual = ellipse.isoperimetric_residual(&image);
        assert!(residual < 1e-12, "{residual:e}");
        assert!(ellipse.isoperimetric_residual(&plain) > 1e-3);
        let dual =
            IsoperimetricArc::from_supports(ellipse.arc(0.1, 1.3).unwrap(), &[2.0, 2.3, 2.2])
                .unwrap();
        assert!(ellipse.isoperimetric_residual(&dual.curve().to_points().unwrap()) < 1e-10);
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
