//! Truncated Taylor series: how this crate differentiates exactly.
//!
//! A curve that is written once as a formula in a [`Series`] yields its point and its derivatives to fourth
//! order together, to rounding. The fourth is needed: the surface's second derivative along a boundary
//! contains the second derivative of the binormal, hence `r''''`.

use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::DVec3;

/// A function of one parameter near a point, as its Taylor coefficients `f^(k)(t0) / k!`, `k < N`.
///
/// Arithmetic is that of truncated power series, so a formula evaluated on [`Series::parameter`] gives every
/// derivative at once, without differences and without symbolic algebra.
///
/// ```
/// use reconstruct::Series;
/// let t: Series = Series::parameter(0.5);
/// let f = (t * 2.0).sin() / (t * t + 1.0);
/// let exact = 2.0 * 1f64.cos() / 1.25 - 1f64.sin() / (1.25 * 1.25);
/// assert!((f.derivative_at(1) - exact).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series<const N: usize = 5>(pub [f64; N]);

impl<const N: usize> Series<N> {
    /// The constant function.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        let mut coefficients = [0.0; N];
        if let Some(first) = coefficients.first_mut() {
            *first = value;
        }
        Self(coefficients)
    }

    /// The function `t` itself, expanded at `at`.
    #[must_use]
    pub fn parameter(at: f64) -> Self {
        let mut series = Self::constant(at);
        if let Some(slope) = series.0.get_mut(1) {
            *slope = 1.0;
        }
        series
    }

    /// The value at the point of expansion.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.0.first().copied().unwrap_or(0.0)
    }

    /// The derivative of the given order at the point of expansion; zero beyond the stored orders.
    #[must_use]
    pub fn derivative_at(&self, order: usize) -> f64 {
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        self.0.get(order).copied().unwrap_or(0.0) * factorial
    }

    /// The series of the derivative. It knows one order less: its last coefficient is set to zero.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self(core::array::from_fn(|k| {
            if k + 1 < N {
                self.0[k + 1] * (k + 1) as f64
            } else {
                0.0
            }
        }))
    }

    /// Sine and cosine together.
    #[must_use]
    pub fn sin_cos(&self) -> (Self, Self) {
        let (mut sin, mut cos) = (
            Self::constant(self.value().sin()),
            Self::constant(self.value().cos()),
        );
        for k in 1..N {
            let (mut s, mut c) = (0.0, 0.0);
            for j in 1..=k {
                let slope = j as f64 * self.0[j];
                s += slope * cos.0[k - j];
                c -= slope * sin.0[k - j];
            }
            sin.0[k] = s / k as f64;
            cos.0[k] = c / k as f64;
        }
        (sin, cos)
    }

    /// Sine.
    #[must_use]
    pub fn sin(&self) -> Self {
        self.sin_cos().0
    }

    /// Cosine.
    #[must_use]
    pub fn cos(&self) -> Self {
        self.sin_cos().1
    }

    /// Exponential.
    #[must_use]
    pub fn exp(&self) -> Self {
        let mut result = Self::constant(self.value().exp());
        for k in 1..N {
            let sum: f64 = (1..=k)
                .map(|j| j as f64 * self.0[j] * result.0[k - j])
                .sum();
            result.0[k] = sum / k as f64;
        }
        result
    }

    /// Square root; NaN where the value is negative, infinite derivatives where it is zero.
    #[must_use]
    pub fn sqrt(&self) -> Self {
        let root = self.value().sqrt();
        let mut result = Self::constant(root);
        for k in 1..N {
            let inner: f64 = (1..k).map(|j| result.0[j] * result.0[k - j]).sum();
            result.0[k] = (self.0[k] - inner) / (2.0 * root);
        }
        result
    }
}

impl<const N: usize> Add for Series<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<const N: usize> Sub for Series<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<const N: usize> Neg for Series<N> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.map(|c| -c))
    }
}

impl<const N: usize> Mul for Series<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| {
            (0..=k).map(|j| self.0[j] * other.0[k - j]).sum()
        }))
    }
}

impl<const N: usize> Div for Series<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let mut quotient = [0.0; N];
        for k in 0..N {
            let known: f64 = (0..k).map(|j| quotient[j] * other.0[k - j]).sum();
            quotient[k] = (self.0[k] - known) / other.0[0];
        }
        Self(quotient)
    }
}

impl<const N: usize> Add<f64> for Series<N> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Self::constant(other)
    }
}

impl<const N: usize> Sub<f64> for Series<N> {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        self - Self::constant(other)
    }
}

impl<const N: usize> Mul<f64> for Series<N> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|c| c * factor))
    }
}

impl<const N: usize> Div<f64> for Series<N> {
    type Output = Self;
    fn div(self, divisor: f64) -> Self {
        Self(self.0.map(|c| c / divisor))
    }
}

/// A point moving in space near a parameter, as its Taylor coefficients `r^(k)(t0) / k!`, `k < N`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VectorSeries<const N: usize = 5>(pub [DVec3; N]);

impl<const N: usize> VectorSeries<N> {
    /// A vector that does not move.
    #[must_use]
    pub fn constant(value: DVec3) -> Self {
        Self(core::array::from_fn(|k| {
            if k == 0 { value } else { DVec3::ZERO }
        }))
    }

    /// From the three coordinate functions.
    #[must_use]
    pub fn from_coordinates([x, y, z]: [Series<N>; 3]) -> Self {
        Self(core::array::from_fn(|k| DVec3::new(x.0[k], y.0[k], z.0[k])))
    }

    /// The value at the point of expansion.
    #[must_use]
    pub fn value(&self) -> DVec3 {
        self.0.first().copied().unwrap_or(DVec3::ZERO)
    }

    /// The derivative of the given order at the point of expansion; zero beyond the stored orders.
    #[must_use]
    pub fn derivative_at(&self, order: usize) -> DVec3 {
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        self.0.get(order).copied().unwrap_or(DVec3::ZERO) * factorial
    }

    /// The series of the derivative. It knows one order less: its last coefficient is set to zero.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self(core::array::from_fn(|k| {
            if k + 1 < N {
                self.0[k + 1] * (k + 1) as f64
            } else {
                DVec3::ZERO
            }
        }))
    }

    /// Value, first and second derivative.
    #[must_use]
    pub fn first_three(&self) -> [DVec3; 3] {
        [
            self.derivative_at(0),
            self.derivative_at(1),
            self.derivative_at(2),
        ]
    }

    /// Scalar product.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Series<N> {
        Series(core::array::from_fn(|k| {
            (0..=k).map(|j| self.0[j].dot(other.0[k - j])).sum()
        }))
    }

    /// Vector product.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        Self(core::array::from_fn(|k| {
            (0..=k).map(|j| self.0[j].cross(other.0[k - j])).sum()
        }))
    }

    /// Product with a scalar function.
    #[must_use]
    pub fn scaled(&self, factor: &Series<N>) -> Self {
        Self(core::array::from_fn(|k| {
            (0..=k).map(|j| self.0[j] * factor.0[k - j]).sum()
        }))
    }

    /// The unit vector along this one; not finite where the vector vanishes.
    #[must_use]
    pub fn normalised(&self) -> Self {
        self.scaled(&(Series::constant(1.0) / self.dot(self).sqrt()))
    }

    /// Whether every stored coefficient is finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }
}

impl<const N: usize> Add for VectorSeries<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<const N: usize> Sub for VectorSeries<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(core::array::from_fn(|k| self.0[k] - other.0[k]))
    }
}

impl<const N: usize> Mul<f64> for VectorSeries<N> {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|c| c * factor))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Derivatives of `exp(sin t) sqrt(1 + t^2)` against those of a long expansion re-expanded nearby.
    #[test]
    fn a_short_series_agrees_with_a_long_one_moved() {
        fn f<const N: usize>(t: Series<N>) -> Series<N> {
            t.sin().exp() * (t * t + 1.0).sqrt() / (t.cos() + 3.0)
        }
        let long: Series<24> = f(Series::parameter(0.3));
        let h = 0.05;
        let moved: Series = f(Series::parameter(0.3 + h));
        for order in 0..5 {
            let mut derivative = long;
            for _ in 0..order {
                derivative = derivative.derivative();
            }
            let value: f64 = derivative.0.iter().rev().fold(0.0, |sum, c| sum * h + c);
            assert!(
                (value - moved.derivative_at(order)).abs() < 1e-11,
                "order {order}"
            );
        }
    }

    #[test]
    fn unit_vectors_stay_unit() {
        let t: Series = Series::parameter(0.7);
        let v = VectorSeries::from_coordinates([t.cos(), t * t, t.exp()]).normalised();
        let square = v.dot(&v);
        assert!((square.value() - 1.0).abs() < 1e-15);
        assert!(square.0[1..].iter().all(|c| c.abs() < 1e-14));
    }
}
