//! Space curves with exact derivatives.

use crate::{Series, VectorSeries};
use bezier_mass::bernstein::binomial;
use bezier_mass::{BezierCurve, MassPoint, VectorSpace};
use core::fmt::{self, Debug};
use glam::DVec3;

/// A space curve that knows its Taylor series to fourth order.
///
/// Boundary curves run over `[0, 1]`; a curve may be defined beyond. Implement it for your own curve by
/// evaluating its formula on a [`Series`], or use [`AnalyticCurve`], a
/// [`BezierCurve`], a [`RibbonCurve`](crate::RibbonCurve) or a [`SampledCurve`](crate::SampledCurve).
pub trait Curve: Debug + Send + Sync {
    /// The Taylor coefficients `r^(k)(t) / k!`, `k = 0..=4`.
    fn series(&self, t: f64) -> VectorSeries;

    /// The point at `t`.
    fn point(&self, t: f64) -> DVec3 {
        self.series(t).value()
    }
}

impl<C: Curve + ?Sized> Curve for std::sync::Arc<C> {
    fn series(&self, t: f64) -> VectorSeries {
        (**self).series(t)
    }
}

/// A curve given by a formula.
///
/// ```
/// use reconstruct::{AnalyticCurve, Curve};
/// let helix = AnalyticCurve::new(|t| [t.cos(), t.sin(), t * 0.3]);
/// assert_eq!(helix.series(0.0).derivative_at(2), glam::DVec3::new(-1.0, 0.0, 0.0));
/// ```
#[derive(Clone, Copy)]
pub struct AnalyticCurve<F> {
    formula: F,
}

impl<F: Fn(Series) -> [Series; 3] + Send + Sync> AnalyticCurve<F> {
    /// The curve whose coordinates are the three functions returned.
    #[must_use]
    pub fn new(formula: F) -> Self {
        Self { formula }
    }
}

impl<F> Debug for AnalyticCurve<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnalyticCurve").finish_non_exhaustive()
    }
}

impl<F: Fn(Series) -> [Series; 3] + Send + Sync> Curve for AnalyticCurve<F> {
    fn series(&self, t: f64) -> VectorSeries {
        VectorSeries::from_coordinates((self.formula)(Series::parameter(t)))
    }
}

/// Polynomial and rational Bézier curves.
impl Curve for BezierCurve<DVec3> {
    fn series(&self, t: f64) -> VectorSeries {
        let homogeneous: [MassPoint<DVec3>; 5] = taylor(self.control(), t);
        let numerator = VectorSeries(homogeneous.map(|h| h.weighted));
        let denominator = Series(homogeneous.map(|h| h.weight));
        if denominator == Series::constant(1.0) {
            return numerator;
        }
        numerator.scaled(&(Series::constant(1.0) / denominator))
    }
}

/// Largest number of Bernstein coefficients that [`taylor`] handles without allocating.
const ON_STACK: usize = 32;

/// The first `N` Taylor coefficients at `t` of a Bernstein polynomial of degree `n`:
/// `binomial(n, k)` times the `k`-th difference in the de Casteljau row of length `k + 1`.
pub(crate) fn taylor<V: VectorSpace, const N: usize>(coefficients: &[V], t: f64) -> [V; N] {
    let count = coefficients.len();
    if count > ON_STACK {
        return taylor_in(&mut coefficients.to_vec(), t);
    }
    let mut row = [V::ZERO; ON_STACK];
    row[..count].copy_from_slice(coefficients);
    taylor_in(&mut row[..count], t)
}

fn taylor_in<V: VectorSpace, const N: usize>(row: &mut [V], t: f64) -> [V; N] {
    let mut series = [V::ZERO; N];
    let degree = row.len().saturating_sub(1);
    let mut length = row.len();
    loop {
        // `row[..length]` is the de Casteljau row whose polynomial has degree `length - 1`.
        if length >= 1 && length <= N {
            let order = length - 1;
            let mut difference = V::ZERO;
            for (i, value) in row[..length].iter().enumerate() {
                let sign = if (order - i).is_multiple_of(2) {
                    1.0
                } else {
                    -1.0
                };
                difference = difference.plus(value.times(sign * binomial(order, i)));
            }
            series[order] = difference.times(binomial(degree, order));
        }
        if length <= 1 {
            return series;
        }
        for i in 1..length {
            row[i - 1] = row[i - 1].lerp(row[i], t);
        }
        length -= 1;
    }
}

/// The same curve run backwards over `[0, 1]`.
#[derive(Clone, Debug)]
pub struct Reversed<C>(pub C);

impl<C: Curve> Curve for Reversed<C> {
    fn series(&self, t: f64) -> VectorSeries {
        let mut series = self.0.series(1.0 - t);
        for coefficient in series.0.iter_mut().skip(1).step_by(2) {
            *coefficient = -*coefficient;
        }
        series
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rational quadratic quarter circle keeps `|r| = 1` to every stored order.
    #[test]
    fn quarter_circle() {
        let w = core::f64::consts::FRAC_1_SQRT_2;
        let control = [(DVec3::X, 1.0), (DVec3::X + DVec3::Y, w), (DVec3::Y, 1.0)];
        let arc = BezierCurve::new(control.map(|(p, w)| MassPoint::point(p, w)).to_vec()).unwrap();
        let r = arc.series(0.3);
        let square = r.dot(&r);
        assert!((square.value() - 1.0).abs() < 1e-15);
        assert!(square.0[1..].iter().all(|c| c.abs() < 1e-13), "{square:?}");
    }

    #[test]
    fn taylor_of_a_cubic_is_the_cubic() {
        // (1 + t)^3 has Bernstein coefficients 1, 2, 4, 8.
        let series: [f64; 5] = taylor(&[1.0, 2.0, 4.0, 8.0], 1.0);
        assert_eq!(series, [8.0, 12.0, 6.0, 1.0, 0.0]);
        let reversed = Reversed(AnalyticCurve::new(|t| [t * t, t.exp(), t.sin()]));
        let direct = AnalyticCurve::new(|t| {
            let t = -t + 1.0;
            [t * t, t.exp(), t.sin()]
        });
        for k in 0..5 {
            assert!((reversed.series(0.2).0[k] - direct.series(0.2).0[k]).length() < 1e-15);
        }
    }
}
