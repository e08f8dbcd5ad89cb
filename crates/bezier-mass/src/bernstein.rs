//! Bernstein polynomials: plain functions on slices of coefficients in any [`VectorSpace`].
//!
//! A polynomial of degree `n` is its `n + 1` Bernstein coefficients on `[0, 1]`,
//! `p(t) = sum_i binomial(n, i) t^i (1-t)^(n-i) c_i`, lowest index first. The coefficients may be numbers,
//! vectors, complex numbers (as `DVec2`), line coordinates or mass points. An empty slice is the zero
//! polynomial; no function here fails or panics, and a NaN that goes in comes out.
//!
//! Source: R. T. Farouki, V. T. Rajan, *Algorithms for polynomials in Bernstein form*, CAGD 5, 1988.

use crate::VectorSpace;

/// The binomial coefficient `n` over `k` (exact up to `n = 56`); zero for `k > n`.
#[must_use]
pub fn binomial(n: usize, k: usize) -> f64 {
    if k > n {
        return 0.0;
    }
    (0..k.min(n - k)).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
}

/// The `n + 1` Bernstein polynomials of degree `n` at `t`; they add up to one.
#[must_use]
pub fn basis(n: usize, t: f64) -> Vec<f64> {
    let mut values = vec![1.0];
    values.reserve(n);
    for _ in 0..n {
        let mut carried = 0.0;
        for value in &mut values {
            let left = *value;
            *value = carried + (1.0 - t) * left;
            carried = t * left;
        }
        values.push(carried);
    }
    values
}

/// The three quadratic Bernstein polynomials `(1-t)^2, 2t(1-t), t^2` at `t`.
#[inline]
#[must_use]
pub fn quadratic_basis(t: f64) -> [f64; 3] {
    let s = 1.0 - t;
    [s * s, 2.0 * t * s, t * t]
}

/// The value at `t`, by a Horner scheme in the Bernstein basis: linear cost, no allocation.
#[inline]
#[must_use]
pub fn evaluate<V: VectorSpace>(coefficients: &[V], t: f64) -> V {
    evaluate_terms(coefficients.iter().copied(), t)
}

/// [`evaluate`] on coefficients that are computed on the way.
pub(crate) fn evaluate_terms<V: VectorSpace>(
    mut coefficients: impl ExactSizeIterator<Item = V>,
    t: f64,
) -> V {
    let Some(first) = coefficients.next() else {
        return V::ZERO;
    };
    let (n, s) = (coefficients.len(), 1.0 - t);
    let (mut power, mut binomial, mut sum) = (1.0, 1.0, first);
    for (i, coefficient) in coefficients.enumerate() {
        power *= t;
        binomial *= (n - i) as f64 / (i + 1) as f64;
        sum = sum.times(s).plus(coefficient.times(power * binomial));
    }
    sum
}

/// The value and the first and second derivative at `t`: linear cost, no allocation.
#[must_use]
pub fn jet<V: VectorSpace>(coefficients: &[V], t: f64) -> [V; 3] {
    let n = coefficients.len().saturating_sub(1) as f64;
    let first = coefficients.windows(2).map(|pair| pair[1].minus(pair[0]));
    let second = coefficients
        .windows(3)
        .map(|three| three[2].plus(three[0]).minus(three[1].times(2.0)));
    [
        evaluate(coefficients, t),
        evaluate_terms(first, t).times(n),
        evaluate_terms(second, t).times(n * (n - 1.0)),
    ]
}

/// The blossom (polar form) at one argument per degree, each given as barycentric coordinates
/// `(1 - t, t)` of a parameter; any other pair `(x, y)` is a projective parameter `y / (x + y)`.
///
/// Takes the arguments in order; missing ones leave the polynomial as it is, so the result is the first
/// coefficient of what remains.
#[must_use]
pub fn blossom<V: VectorSpace>(coefficients: &[V], arguments: &[[f64; 2]]) -> V {
    let mut level = coefficients.to_vec();
    for &argument in arguments.iter().take(coefficients.len().saturating_sub(1)) {
        polarise(&mut level, argument);
    }
    level.first().copied().unwrap_or(V::ZERO)
}

/// One step of de Casteljau with barycentric argument: the polynomial of one degree less.
fn polarise<V: VectorSpace>(level: &mut Vec<V>, [x, y]: [f64; 2]) {
    for i in 1..level.len() {
        level[i - 1] = level[i - 1].times(x).plus(level[i].times(y));
    }
    level.pop();
}

/// The coefficients after the projective change of parameter that takes the new ends to the parameters with
/// barycentric coordinates `from` and `to`: coefficient `k` is the blossom at `n - k` times `from` and `k`
/// times `to`. With affine pairs `(1 - t, t)` this is the restriction to an interval.
#[must_use]
pub fn reparametrise<V: VectorSpace>(coefficients: &[V], from: [f64; 2], to: [f64; 2]) -> Vec<V> {
    let mut level = coefficients.to_vec();
    let mut result = level.clone();
    // Before the step with index k, `level` holds the polynomial polarised `n - k` times at `from`.
    for k in (0..coefficients.len()).rev() {
        let mut inner = level.clone();
        for _ in 0..k {
            polarise(&mut inner, to);
        }
        if let (Some(slot), Some(&value)) = (result.get_mut(k), inner.first()) {
            *slot = value;
        }
        polarise(&mut level, from);
    }
    result
}

/// The coefficients on `[start, end]`, an interval anywhere on the line (reversed if `end < start`).
#[must_use]
pub fn restrict<V: VectorSpace>(coefficients: &[V], start: f64, end: f64) -> Vec<V> {
    reparametrise(coefficients, [1.0 - start, start], [1.0 - end, end])
}

/// de Casteljau's subdivision: the coefficients on `[0, t]` and on `[t, 1]`.
#[must_use]
pub fn subdivide<V: VectorSpace>(coefficients: &[V], t: f64) -> (Vec<V>, Vec<V>) {
    let mut level = coefficients.to_vec();
    let mut left = Vec::with_capacity(level.len());
    let mut right = Vec::with_capacity(level.len());
    while let (Some(&first), Some(&last)) = (level.first(), level.last()) {
        left.push(first);
        right.push(last);
        polarise(&mut level, [1.0 - t, t]);
    }
    right.reverse();
    (left, right)
}

/// The coefficients of the derivative, `n (c[i+1] - c[i])`; empty for a constant.
#[must_use]
pub fn derivative<V: VectorSpace>(coefficients: &[V]) -> Vec<V> {
    let degree = coefficients.len().saturating_sub(1) as f64;
    coefficients
        .windows(2)
        .map(|pair| pair[1].minus(pair[0]).times(degree))
        .collect()
}

/// The coefficients of the integral from 0, plus `constant`.
#[must_use]
pub fn integral<V: VectorSpace>(coefficients: &[V], constant: V) -> Vec<V> {
    let share = 1.0 / coefficients.len().max(1) as f64;
    let partial_sums = coefficients.iter().scan(constant, |sum, c| {
        *sum = sum.plus(c.times(share));
        Some(*sum)
    });
    core::iter::once(constant).chain(partial_sums).collect()
}

/// The same polynomial written with one degree more.
#[must_use]
pub fn elevate<V: VectorSpace>(coefficients: &[V]) -> Vec<V> {
    let (Some(&first), Some(&last)) = (coefficients.first(), coefficients.last()) else {
        return Vec::new();
    };
    let degree = coefficients.len();
    let mut elevated = Vec::with_capacity(degree + 1);
    elevated.push(first);
    elevated.extend(coefficients.windows(2).zip(1..).map(|(pair, i)| {
        let share = f64::from(i) / degree as f64;
        pair[1].lerp(pair[0], share)
    }));
    elevated.push(last);
    elevated
}

/// The same polynomial written with degree at least `degree` (unchanged if it has that already).
#[must_use]
pub fn elevate_to<V: VectorSpace>(coefficients: &[V], degree: usize) -> Vec<V> {
    let mut elevated = coefficients.to_vec();
    while !elevated.is_empty() && elevated.len() <= degree {
        elevated = elevate(&elevated);
    }
    elevated
}

/// The product of a number-valued polynomial and another polynomial; the degrees add up.
///
/// ```
/// use bezier_mass::bernstein;
/// // (1 - t) * t = t - t^2
/// assert_eq!(bernstein::product(&[1.0, 0.0], &[0.0, 1.0]), [0.0, 0.5, 0.0]);
/// ```
#[must_use]
pub fn product<V: VectorSpace>(numbers: &[f64], coefficients: &[V]) -> Vec<V> {
    product_with(numbers, coefficients, |&x, &y| y.times(x))
}

/// The product of two polynomials under any bilinear map: complex multiplication, dot product, cross
/// product, the moment of mass points, ... The degrees add up.
///
/// ```
/// use bezier_mass::{bernstein, glam::dvec2};
/// // The squared speed of a quadratic with control points (0,0), (1,2), (3,0).
/// let velocity = bernstein::derivative(&[dvec2(0.0, 0.0), dvec2(1.0, 2.0), dvec2(3.0, 0.0)]);
/// let squared_speed = bernstein::product_with(&velocity, &velocity, |a, b| a.dot(*b));
/// assert_eq!(squared_speed, [20.0, -8.0, 32.0]);
/// ```
#[must_use]
pub fn product_with<A, B, V: VectorSpace>(
    a: &[A],
    b: &[B],
    bilinear: impl Fn(&A, &B) -> V,
) -> Vec<V> {
    if a.is_empty() || b.is_empty() {
        return Vec::new();
    }
    let (m, n) = (a.len() - 1, b.len() - 1);
    let mut scaled = vec![V::ZERO; m + n + 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            scaled[i + j] =
                scaled[i + j].plus(bilinear(x, y).times(binomial(m, i) * binomial(n, j)));
        }
    }
    for (k, coefficient) in scaled.iter_mut().enumerate() {
        *coefficient = coefficient.times(1.0 / binomial(m + n, k));
    }
    scaled
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `t^k` in Bernstein form of degree `n`: coefficient `i` is `binomial(i, k) / binomial(n, k)`.
    fn monomial(n: usize, k: usize) -> Vec<f64> {
        (0..=n).map(|i| binomial(i, k) / binomial(n, k)).collect()
    }

    fn close(a: &[f64], b: &[f64]) {
        assert_eq!(a.len(), b.len());
        for (x, y) in a.iter().zip(b) {
            assert!(
                (x - y).abs() <= 1e-13 * y.abs().max(1.0),
                "{a:?} against {b:?}"
            );
        }
    }

    #[test]
    fn monomials_evaluate_to_powers_inside_and_outside_the_unit_interval() {
        for n in 0..12 {
            for k in 0..=n {
                for t in [-0.75, 0.0, 0.125, 0.5, 0.9, 1.0, 1.5] {
                    let exact = f64::powi(t, k as i32);
                    let scale = (1.0 + 2.0 * f64::abs(t)).powi(n as i32);
                    assert!(
                        (evaluate(&monomial(n, k), t) - exact).abs() <= 1e-15 * scale,
                        "t^{k} in degree {n} at {t}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_basis_sums_the_coefficients_and_adds_up_to_one() {
        let coefficients = [3.0, -1.0, 4.0, 1.0, -5.0];
        let basis = basis(4, 0.3);
        let sum: f64 = basis.iter().zip(coefficients).map(|(b, c)| b * c).sum();
        close(
            &[sum, basis.iter().sum()],
            &[evaluate(&coefficients, 0.3), 1.0],
        );
        close(&super::basis(2, 0.3), &quadratic_basis(0.3));
    }

    #[test]
    fn the_jet_is_the_value_and_the_derivatives() {
        let coefficients = [3.0, -1.0, 4.0, 1.0, -5.0];
        let first = derivative(&coefficients);
        let second = derivative(&first);
        let expected = [&coefficients[..], &first, &second].map(|c| evaluate(c, 0.7));
        close(&jet(&coefficients, 0.7), &expected);
        assert_eq!(jet(&[7.0], 0.3), [7.0, 0.0, 0.0]);
    }

    #[test]
    fn degrees_zero_and_none() {
        let none: [f64; 0] = [];
        assert_eq!(evaluate(&none, 0.5), 0.0);
        assert_eq!(evaluate(&[7.0], 0.5), 7.0);
        assert!(derivative(&[7.0]).is_empty() && derivative(&none).is_empty());
        assert!(elevate(&none).is_empty() && elevate_to(&none, 3).is_empty());
        assert!(product(&none, &[1.0]).is_empty());
        assert_eq!(elevate(&[7.0]), [7.0, 7.0]);
        assert_eq!(integral(&none, 2.0), [2.0]);
        assert_eq!(subdivide(&none, 0.5), (Vec::new(), Vec::new()));
        assert_eq!(blossom(&none, &[[0.5, 0.5]]), 0.0);
    }

    #[test]
    fn products_of_monomials_are_monomials() {
        close(&product(&monomial(3, 2), &monomial(4, 1)), &monomial(7, 3));
    }

    #[test]
    fn derivative_undoes_integral() {
        let coefficients = [3.0, -1.0, 4.0, 1.0];
        close(&derivative(&integral(&coefficients, 9.0)), &coefficients);
        close(
            &derivative(&monomial(5, 3)),
            &monomial(4, 2).iter().map(|c| 3.0 * c).collect::<Vec<_>>(),
        );
    }

    #[test]
    fn the_blossom_is_symmetric_and_its_diagonal_is_the_polynomial() {
        let coefficients = [3.0, -1.0, 4.0, 1.0];
        let at = |t: f64| [1.0 - t, t];
        let value = blossom(&coefficients, &[at(0.2), at(0.7), at(-1.0)]);
        close(
            &[blossom(&coefficients, &[at(-1.0), at(0.2), at(0.7)])],
            &[value],
        );
        close(
            &[blossom(&coefficients, &[at(0.3); 3])],
            &[evaluate(&coefficients, 0.3)],
        );
    }

    #[test]
    fn restriction_and_subdivision_agree_with_the_polynomial() {
        let coefficients = [3.0, -1.0, 4.0, 1.0, -5.0];
        let (left, right) = subdivide(&coefficients, 0.3);
        close(&left, &restrict(&coefficients, 0.0, 0.3));
        close(&right, &restrict(&coefficients, 0.3, 1.0));
        let beyond = restrict(&coefficients, 1.5, -0.5);
        for u in [0.0, 0.25, 1.0] {
            close(
                &[evaluate(&beyond, u)],
                &[evaluate(&coefficients, 1.5 - 2.0 * u)],
            );
        }
    }

    #[test]
    fn elevation_keeps_the_polynomial() {
        let coefficients = [3.0, -1.0, 4.0];
        let elevated = elevate_to(&coefficients, 6);
        assert_eq!(elevated.len(), 7);
        close(&[evaluate(&elevated, 0.7)], &[evaluate(&coefficients, 0.7)]);
    }
}
