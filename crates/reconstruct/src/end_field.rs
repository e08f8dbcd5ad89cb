//! The free functions of a surface through two geodesics.

use crate::strip::StripSample;
use crate::{CubicSpline, Series};
use core::array::from_fn;
use core::fmt;
use glam::DVec3;
use std::sync::Arc;

/// A function of one parameter with its derivatives.
#[derive(Clone)]
pub enum ScalarFunction {
    /// A constant.
    Constant(f64),
    /// A cubic spline.
    Spline(CubicSpline<f64>),
    /// A formula.
    Formula(Arc<dyn Fn(Series) -> Series + Send + Sync>),
}

impl ScalarFunction {
    /// A function given by a formula.
    pub fn formula(formula: impl Fn(Series) -> Series + Send + Sync + 'static) -> Self {
        Self::Formula(Arc::new(formula))
    }

    /// Value and derivatives at `u`.
    #[must_use]
    pub fn at(&self, u: f64) -> Series {
        match self {
            Self::Constant(value) => Series::constant(*value),
            Self::Spline(spline) => spline.of_series(Series::parameter(u)),
            Self::Formula(formula) => formula(Series::parameter(u)),
        }
    }
}

impl fmt::Debug for ScalarFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => f.debug_tuple("Constant").field(value).finish(),
            Self::Spline(spline) => f.debug_tuple("Spline").field(spline).finish(),
            Self::Formula(_) => f.write_str("Formula(..)"),
        }
    }
}

impl From<f64> for ScalarFunction {
    fn from(value: f64) -> Self {
        Self::Constant(value)
    }
}

/// The free functions of one curve: the vector `X` with which the surface leaves it (or arrives at it), always in the
/// direction of increasing `v`.
#[derive(Clone, Debug)]
pub enum EndField {
    /// Angle `alpha` from the direction across towards that along the curve, radians, and length `lambda`.
    Polar {
        /// The angle function.
        angle: ScalarFunction,
        /// The length function.
        length: ScalarFunction,
    },
    /// Components along the curve and across it.
    Components {
        /// The component along the tangent.
        along: ScalarFunction,
        /// The component along `h`, to be kept positive.
        across: ScalarFunction,
    },
}

impl EndField {
    /// The components along and across at `u`.
    pub(crate) fn components(&self, u: f64) -> [Series; 2] {
        match self {
            Self::Components { along, across } => [along.at(u), across.at(u)],
            Self::Polar { angle, length } => {
                let (sin, cos) = angle.at(u).sin_cos();
                let length = length.at(u);
                [sin * length, cos * length]
            }
        }
    }

    /// The end vector with two derivatives.
    pub(crate) fn at(&self, u: f64, sample: &StripSample) -> [DVec3; 3] {
        let [p, q] = self.components(u);
        let product = |c: Series, v: &[DVec3; 3]| {
            let c: [f64; 3] = from_fn(|k| c.derivative_at(k));
            [
                v[0] * c[0],
                v[0] * c[1] + v[1] * c[0],
                v[0] * c[2] + v[1] * (2.0 * c[1]) + v[2] * c[0],
            ]
        };
        let (a, b) = (product(p, &sample.along), product(q, &sample.across));
        from_fn(|k| a[k] + b[k])
    }
}
