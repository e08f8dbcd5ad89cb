//! Values with derivatives: what a curve or a patch knows about one parameter.

use crate::{MassPoint, VectorSpace};
use glam::DVec3;

/// The value of a curve at a parameter with its first and second derivative, all as mass points.
///
/// The homogeneous derivatives are polynomial and exist everywhere, also where the weight vanishes; the
/// methods turn them into derivatives of the position.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CurveJet<V> {
    /// The value `h(t)`.
    pub value: MassPoint<V>,
    /// The derivative `h'(t)`.
    pub first: MassPoint<V>,
    /// The second derivative `h''(t)`.
    pub second: MassPoint<V>,
}

impl<V: VectorSpace> CurveJet<V> {
    /// The position; `None` where the weight vanishes.
    #[must_use]
    pub fn position(&self) -> Option<V> {
        self.value.position()
    }

    /// The derivative of the position by the parameter; `None` where the weight vanishes.
    #[must_use]
    pub fn velocity(&self) -> Option<V> {
        let weight = self.value.weight;
        finite(self.value.moment(self.first).times(1.0 / (weight * weight)))
    }

    /// The second derivative of the position by the parameter; `None` where the weight vanishes.
    #[must_use]
    pub fn acceleration(&self) -> Option<V> {
        quotient_second(self.value, [self.first, self.first], self.second)
    }
}

/// `(X_ab - w_a P_b - w_b P_a - w_ab P) / w`: the second derivative of the quotient `P = X / w`.
fn quotient_second<V: VectorSpace>(
    value: MassPoint<V>,
    [a, b]: [MassPoint<V>; 2],
    mixed: MassPoint<V>,
) -> Option<V> {
    let weight = value.weight;
    let moments = value
        .moment(a)
        .times(b.weight)
        .plus(value.moment(b).times(a.weight));
    let second = value.moment(mixed).times(1.0 / (weight * weight));
    finite(second.minus(moments.times(1.0 / (weight * weight * weight))))
}

fn finite<V: VectorSpace>(vector: V) -> Option<V> {
    vector.is_finite().then_some(vector)
}

/// The value of a patch at a parameter pair with its partial derivatives to second order, as mass points.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PatchJet<V> {
    /// The value `h(u, v)`.
    pub value: MassPoint<V>,
    /// The partial derivative by `u`.
    pub du: MassPoint<V>,
    /// The partial derivative by `v`.
    pub dv: MassPoint<V>,
    /// The second partial derivative by `u`.
    pub duu: MassPoint<V>,
    /// The mixed partial derivative.
    pub duv: MassPoint<V>,
    /// The second partial derivative by `v`.
    pub dvv: MassPoint<V>,
}

/// Position and partial derivatives of a surface in its own space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Partials<V> {
    /// The position.
    pub position: V,
    /// The partial derivative by `u`.
    pub du: V,
    /// The partial derivative by `v`.
    pub dv: V,
    /// The second partial derivative by `u`.
    pub duu: V,
    /// The mixed partial derivative.
    pub duv: V,
    /// The second partial derivative by `v`.
    pub dvv: V,
}

impl<V: VectorSpace> PatchJet<V> {
    /// The position; `None` where the weight vanishes.
    #[must_use]
    pub fn position(&self) -> Option<V> {
        self.value.position()
    }

    /// Position and partial derivatives in space; `None` where the weight vanishes.
    #[must_use]
    pub fn partials(&self) -> Option<Partials<V>> {
        let Self {
            value,
            du,
            dv,
            duu,
            duv,
            dvv,
        } = *self;
        let inverse_square = 1.0 / (value.weight * value.weight);
        Some(Partials {
            position: value.position()?,
            du: finite(value.moment(du).times(inverse_square))?,
            dv: finite(value.moment(dv).times(inverse_square))?,
            duu: quotient_second(value, [du, du], duu)?,
            duv: quotient_second(value, [du, dv], duv)?,
            dvv: quotient_second(value, [dv, dv], dvv)?,
        })
    }
}

impl PatchJet<DVec3> {
    /// The unit normal along `dP/du x dP/dv`; `None` where the tangent plane is not determined by the first
    /// derivatives.
    ///
    /// Computed without a division by the weight, as the plane through `h`, `h_u`, `h_v`; so it exists where
    /// the weight vanishes too, where it is the normal of the asymptotic plane (of either orientation).
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        unit_normal([self.value, self.du, self.dv])
    }

    /// The normal, or its limit on the way from the middle of the parameter square to `(u, v)`.
    pub(crate) fn normal_or_limit(&self, u: f64, v: f64) -> Option<DVec3> {
        self.normal().or_else(|| {
            let Self {
                value: h,
                du,
                dv,
                duu,
                duv,
                dvv,
            } = *self;
            let by_u = plane_normal(h, duu, dv) + plane_normal(h, du, duv);
            let by_v = plane_normal(h, duv, dv) + plane_normal(h, du, dvv);
            let sizes =
                [(duu, dv), (du, duv), (duv, dv), (du, dvv)].map(|(a, b)| plane_size(h, a, b));
            let (a, b) = (0.5 - u, 0.5 - v);
            oriented(by_u * a + by_v * b, h.weight, sizes.iter().sum())
        })
    }
}

/// The unit normal of the plane through `[h, h_u, h_v]` on the side of `P_u x P_v`.
fn unit_normal([value, du, dv]: [MassPoint<DVec3>; 3]) -> Option<DVec3> {
    oriented(
        plane_normal(value, du, dv),
        value.weight,
        plane_size(value, du, dv),
    )
}

/// A multiple of the normal made a unit vector on the side of `P_u x P_v`; `None` if it is rounding error of terms of
/// the size given.
fn oriented(normal: DVec3, weight: f64, size: f64) -> Option<DVec3> {
    let length = normal.length();
    let reached = length > NORMAL_ROUNDING * size && length.is_finite();
    reached.then(|| normal * (if weight < 0.0 { -1.0 } else { 1.0 } / length))
}

/// The normal of the plane through three mass points: the Euclidean part of their exterior product.
fn plane_normal(a: MassPoint<DVec3>, b: MassPoint<DVec3>, c: MassPoint<DVec3>) -> DVec3 {
    b.weighted.cross(c.weighted) * a.weight
        + c.weighted.cross(a.weighted) * b.weight
        + a.weighted.cross(b.weighted) * c.weight
}

/// The size of the terms of [`plane_normal`].
fn plane_size(a: MassPoint<DVec3>, b: MassPoint<DVec3>, c: MassPoint<DVec3>) -> f64 {
    let [x, y, z] = [a, b, c].map(|h| h.weighted.magnitude());
    a.weight.abs() * y * z + b.weight.abs() * z * x + c.weight.abs() * x * y
}

/// A normal shorter than this fraction of its terms is rounding error: its nine products of three coordinates
/// that carry a few units in the last place each.
const NORMAL_ROUNDING: f64 = 64.0 * f64::EPSILON;
