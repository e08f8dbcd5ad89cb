//! Polynomial boundaries of degree 7 from corner data, so that the conditions C1 and C3 hold by construction.
//!
//! Section 3.7 of the thesis chapter. C2 is to be checked afterwards: a curve may inflect between its ends.

use crate::Error;
use crate::corner::{Corners, CurveEnd, SIDES, curve_ends, four};
use bezier_mass::{BezierCurve, bernstein};
use core::array::from_fn;
use glam::DVec3;
use nalgebra::{SMatrix, SVector};

/// How the freedom of a degree-7 boundary is used.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Degree7Shape {
    /// `|r'|` at both ends; the distance of the ends if not given.
    pub speed: Option<f64>,
    /// The derivative of the speed at both ends.
    pub speed_derivative: f64,
    /// The components of `r'''` along the tangent and the principal normal.
    pub third_derivative: ThirdDerivative,
}

/// How the components of `r'''` along tangent and principal normal, which the corner data leave free, are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ThirdDerivative {
    /// The same two numbers at all ends.
    Given([f64; 2]),
    /// Those of least `int |r''|²`.
    LeastBending,
    /// Those of least `int |r'''|²`: the default, without the overshoot that zero has.
    LeastJerk,
}

impl Default for Degree7Shape {
    fn default() -> Self {
        Self {
            speed: None,
            speed_derivative: 0.0,
            third_derivative: ThirdDerivative::LeastJerk,
        }
    }
}

/// Four degree-7 Bézier boundaries `r1(u)`, `r2(v)`, `r3(u)`, `r4(v)` with the given corner data. They satisfy C1
/// and C3; whether they satisfy C2, and bend as wanted between the corners, the check of the rectangle says.
///
/// # Errors
/// [`Error::CornerData`] for two corners at one point; [`Error::OutOfRange`] for a speed that is not positive.
pub fn degree7_boundaries(
    corners: &Corners,
    shape: &Degree7Shape,
) -> Result<[BezierCurve<DVec3>; 4], Error> {
    if let Some(value) = shape.speed
        && !(value > 0.0 && value.is_finite())
    {
        return Err(Error::OutOfRange {
            what: "speed",
            value,
            range: [0.0, f64::INFINITY],
        });
    }
    let mut curves = Vec::with_capacity(4);
    for side in SIDES {
        let (ends, chord) = curve_ends(corners, side)?;
        curves.push(BezierCurve::polynomial(&degree7(&ends, chord, shape))?);
    }
    four(curves)
}

/// The control points of one degree-7 curve.
fn degree7(ends: &[CurveEnd; 2], chord: f64, shape: &Degree7Shape) -> [DVec3; 8] {
    let speed = shape.speed.unwrap_or(chord);
    let with = |free: [[f64; 2]; 2]| degree7_control(ends, speed, shape.speed_derivative, free);
    match shape.third_derivative {
        ThirdDerivative::Given(components) => with([components; 2]),
        ThirdDerivative::LeastBending => with(least_energy(&with, 2)),
        ThirdDerivative::LeastJerk => with(least_energy(&with, 3)),
    }
}

/// `b0..b3` from the first four derivatives at 0, `b7..b4` from those at 1; `free` are the components of `r'''`
/// along `e` and `n` at both ends.
fn degree7_control(ends: &[CurveEnd; 2], v: f64, a: f64, free: [[f64; 2]; 2]) -> [DVec3; 8] {
    let derivatives = |end: &CurveEnd, [c_e, c_n]: [f64; 2]| {
        let (e, n) = (end.tangent, end.normal * end.curvature.signum());
        let k = end.curvature.abs();
        let first = e * v;
        let second = e * a + n * (v * v * k);
        let third = e * c_e + n * c_n + e.cross(n) * (v.powi(3) * k * end.torsion);
        [first / 7.0, second / 42.0, third / 210.0]
    };
    let [p0, p7] = [ends[0].point, ends[1].point];
    let ([d1, d2, d3], [g1, g2, g3]) = (
        derivatives(&ends[0], free[0]),
        derivatives(&ends[1], free[1]),
    );
    let b1 = p0 + d1;
    let b2 = b1 * 2.0 - p0 + d2;
    let b3 = b2 * 3.0 - b1 * 3.0 + p0 + d3;
    let b6 = p7 - g1;
    let b5 = b6 * 2.0 - p7 + g2;
    let b4 = b5 * 3.0 - b6 * 3.0 + p7 - g3;
    [p0, b1, b2, b3, b4, b5, b6, p7]
}

/// The free components that minimise the integral of the squared derivative of this order. The curve is affine in
/// them: one small linear system.
fn least_energy(control: &impl Fn([[f64; 2]; 2]) -> [DVec3; 8], order: usize) -> [[f64; 2]; 2] {
    let differentiated =
        |points: &[DVec3]| (0..order).fold(points.to_vec(), |p, _| bernstein::derivative(&p));
    let base = control([[0.0; 2]; 2]);
    let start = differentiated(&base);
    let basis: [Vec<DVec3>; 4] = from_fn(|k| {
        let mut free = [[0.0; 2]; 2];
        free[k / 2][k % 2] = 1.0;
        let moved = control(free);
        differentiated(&from_fn::<DVec3, 8, _>(|i| moved[i] - base[i]))
    });
    let matrix = SMatrix::<f64, 4, 4>::from_fn(|k, l| integral_of_product(&basis[k], &basis[l]));
    let right = SVector::<f64, 4>::from_fn(|k, _| -integral_of_product(&start, &basis[k]));
    // Positive definite: the four directions are linearly independent polynomials.
    let free = matrix
        .cholesky()
        .map_or_else(SVector::zeros, |factors| factors.solve(&right));
    [[free[0], free[1]], [free[2], free[3]]]
}

/// The integral over `[0, 1]` of the scalar product of two polynomials.
fn integral_of_product(a: &[DVec3], b: &[DVec3]) -> f64 {
    let product: Vec<f64> = bernstein::product_with(a, b, |x, y| x.dot(*y));
    product.iter().sum::<f64>() / product.len() as f64
}
