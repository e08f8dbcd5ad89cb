//! Rational biquadratic patches by value.

use crate::curve::position_at;
use crate::mass_point::CLEAR_WEIGHT;
use crate::{
    BezierPatch, Error, Homography, MassPoint, Parameter, PatchJet, Quadratic, VectorSpace,
    bernstein,
};
use glam::DVec3;

/// A rational biquadratic Bézier patch with mass control points, a plain value: nothing here allocates.
///
/// `control[i][j]` goes with `B_i(u) B_j(v)`: a row is a control polygon along `v`. Dupin cyclides, tori,
/// spheres and cones have exact patches of this kind.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "[[MassPoint<V>; 3]; 3]", into = "[[MassPoint<V>; 3]; 3]")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct Biquadratic<V> {
    control: [[MassPoint<V>; 3]; 3],
    /// A weight above this is clear of the rounding error of the Bernstein sum in the unit square.
    clear_weight: f64,
}

impl<V: VectorSpace> Biquadratic<V> {
    /// The patch with these control mass points.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn new(control: [[MassPoint<V>; 3]; 3]) -> Result<Self, Error> {
        for &mass_point in control.iter().flatten() {
            mass_point.checked()?;
        }
        Ok(Self::from_checked(control))
    }

    /// The patch with control mass points that are known to be finite.
    fn from_checked(control: [[MassPoint<V>; 3]; 3]) -> Self {
        let weights = control.iter().flatten().map(|h| h.weight.abs());
        Self {
            control,
            clear_weight: CLEAR_WEIGHT * weights.fold(0.0, f64::max),
        }
    }

    /// The control mass points, `control[i][j]` for `B_i(u) B_j(v)`.
    #[inline]
    #[must_use]
    pub const fn control(&self) -> &[[MassPoint<V>; 3]; 3] {
        &self.control
    }

    /// The mass point at `(u, v)`: a point, or a vector where the weight vanishes to rounding.
    #[inline]
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> MassPoint<V> {
        let (b, c) = (bernstein::quadratic_basis(u), bernstein::quadratic_basis(v));
        let [r0, r1, r2] = &self.control;
        let row = |h: &[MassPoint<V>; 3], b: f64| {
            h[0] * (b * c[0]) + h[1] * (b * c[1]) + h[2] * (b * c[2])
        };
        let mut value = row(r0, b[0]) + row(r1, b[1]) + row(r2, b[2]);
        if !self.is_clear(value.weight, u, v) {
            value.weight = self.settled_weight(value.weight, u, v);
        }
        value
    }

    /// Whether a weight computed at `(u, v)` is far above its rounding error.
    #[expect(
        clippy::manual_range_contains,
        reason = "without branches it costs nothing"
    )]
    #[inline]
    pub(crate) fn is_clear(&self, weight: f64, u: f64, v: f64) -> bool {
        let inside = (u >= 0.0) & (u <= 1.0) & (v >= 0.0) & (v <= 1.0);
        (weight.abs() > self.clear_weight) & inside
    }

    /// The weight at `(u, v)`, zero if it is no more than the rounding error of its Bernstein sum.
    #[cold]
    #[inline(never)]
    fn settled_weight(&self, weight: f64, u: f64, v: f64) -> f64 {
        let [b, c] = [u, v].map(|t| bernstein::quadratic_basis(t).map(f64::abs));
        let terms: f64 = (0..3)
            .flat_map(|i| (0..3).map(move |j| (i, j)))
            .map(|(i, j)| b[i] * c[j] * self.control[i][j].weight.abs())
            .sum();
        MassPoint::from_homogeneous(weight, V::ZERO)
            .settled(terms)
            .weight
    }

    /// The position at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    #[inline]
    pub fn point(&self, u: f64, v: f64) -> Result<V, Error> {
        position_at(self.at(u, v), if v.is_finite() { u } else { v })
    }

    /// The value with its partial derivatives to second order at `(u, v)`, as mass points.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> PatchJet<V> {
        let b = bernstein::quadratic_basis(u);
        let rows = self.control.map(|row| quadratic_jet(row, v));
        let [_, du, duu] = quadratic_jet(rows.map(|[value, _, _]| value), u);
        let [dv, duv, _] = quadratic_jet(rows.map(|[_, first, _]| first), u);
        let [q0, q1, q2] = rows.map(|[_, _, second]| second);
        PatchJet {
            value: self.at(u, v),
            du,
            dv,
            duu,
            duv,
            dvv: q0 * b[0] + q1 * b[1] + q2 * b[2],
        }
    }

    /// The iso-curve at fixed `u`, a curve in `v`.
    #[must_use]
    pub fn curve_at_u(&self, u: f64) -> Quadratic<V> {
        let [b0, b1, b2] = bernstein::quadratic_basis(u);
        let [r0, r1, r2] = self.control;
        Quadratic::from_checked([0, 1, 2].map(|j| r0[j] * b0 + r1[j] * b1 + r2[j] * b2))
    }

    /// The iso-curve at fixed `v`, a curve in `u`.
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> Quadratic<V> {
        let [c0, c1, c2] = bernstein::quadratic_basis(v);
        Quadratic::from_checked(self.control.map(|[h0, h1, h2]| h0 * c0 + h1 * c1 + h2 * c2))
    }

    /// The barycentric middle curves: the first along `u` (at `v = 1/2`), the second along `v`.
    ///
    /// Control `i` of the first is the barycentre `h_i0 + 2 h_i1 + h_i2` of row `i`, not divided by four; on a
    /// patch of a Dupin cyclide both curves are circular arcs (Theorem 1 of the paper on biquadratic cyclide
    /// patches).
    #[must_use]
    pub fn middle_curves(&self) -> [Quadratic<V>; 2] {
        let barycentre = |[h0, h1, h2]: [MassPoint<V>; 3]| h0 + h1 * 2.0 + h2;
        [self, &self.transposed()]
            .map(|patch| Quadratic::from_checked(patch.control.map(barycentre)))
    }

    /// The patch with `u` and `v` exchanged.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let h = &self.control;
        Self::from_checked([0, 1, 2].map(|j| [h[0][j], h[1][j], h[2][j]]))
    }

    /// The patch run backwards in `u`. Its normal changes side.
    #[must_use]
    pub fn reversed_u(&self) -> Self {
        let [r0, r1, r2] = self.control;
        Self::from_checked([r2, r1, r0])
    }

    /// The patch run backwards in `v`. Its normal changes side.
    #[must_use]
    pub fn reversed_v(&self) -> Self {
        Self::from_checked(self.control.map(|[h0, h1, h2]| [h2, h1, h0]))
    }

    /// The patch after a homographic change of each parameter.
    #[must_use]
    pub fn reparametrised(&self, u: Homography, v: Homography) -> Self {
        let along_v = |row| *Quadratic::from_checked(row).reparametrised(v).control();
        let along_u = |column| *Quadratic::from_checked(column).reparametrised(u).control();
        Self::from_checked(
            Self::from_checked(self.control.map(along_v))
                .transposed()
                .control
                .map(along_u),
        )
        .transposed()
    }

    /// The part over `[u[0], u[1]] x [v[0], v[1]]`; the ends may lie outside `[0, 1]` or at infinity.
    ///
    /// # Errors
    /// [`Error::SingularHomography`] if two ends coincide; [`Error::NonFinite`].
    pub fn sub_patch(
        &self,
        u: [impl Into<Parameter>; 2],
        v: [impl Into<Parameter>; 2],
    ) -> Result<Self, Error> {
        let ([u0, u1], [v0, v1]) = (u, v);
        Ok(self.reparametrised(Homography::between(u0, u1)?, Homography::between(v0, v1)?))
    }

    /// de Casteljau's subdivision at `u`: the parts below and above.
    #[must_use]
    pub fn subdivide_u(&self, u: f64) -> (Self, Self) {
        let (below, above) = self.transposed().subdivide_v(u);
        (below.transposed(), above.transposed())
    }

    /// de Casteljau's subdivision at `v`: the parts below and above.
    #[must_use]
    pub fn subdivide_v(&self, v: f64) -> (Self, Self) {
        let parts = self
            .control
            .map(|row| Quadratic::from_checked(row).subdivide(v));
        (
            Self::from_checked(parts.map(|(below, _)| *below.control())),
            Self::from_checked(parts.map(|(_, above)| *above.control())),
        )
    }

    /// The patch with every control mass point mapped by `map`, which should be linear in the mass point.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<Biquadratic<W>, Error> {
        Biquadratic::new(self.control.map(|row| row.map(&map)))
    }
}

impl Biquadratic<DVec3> {
    /// The unit normal along `dP/du x dP/dv`; see [`BezierPatch::normal`] for where it is a limit or missing.
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        self.jet(u, v).normal_or_limit(u, v)
    }
}

/// Value, first and second derivative of a quadratic Bernstein polynomial, sharing the differences.
#[inline]
fn quadratic_jet<V: VectorSpace>([h0, h1, h2]: [MassPoint<V>; 3], t: f64) -> [MassPoint<V>; 3] {
    let (p0, p1) = (h0.lerp(h1, t), h1.lerp(h2, t));
    [p0.lerp(p1, t), (p1 - p0) * 2.0, (h0 + h2 - h1 * 2.0) * 2.0]
}

impl<V: VectorSpace> TryFrom<[[MassPoint<V>; 3]; 3]> for Biquadratic<V> {
    type Error = Error;

    fn try_from(control: [[MassPoint<V>; 3]; 3]) -> Result<Self, Error> {
        Self::new(control)
    }
}

impl<V> From<Biquadratic<V>> for [[MassPoint<V>; 3]; 3] {
    fn from(patch: Biquadratic<V>) -> Self {
        patch.control
    }
}

impl<V: VectorSpace> From<Biquadratic<V>> for BezierPatch<V> {
    fn from(patch: Biquadratic<V>) -> Self {
        Self::from_checked([2, 2], patch.control.as_flattened().to_vec())
    }
}

/// A patch of bidegree at most two (lower degrees are raised).
impl<V: VectorSpace> TryFrom<&BezierPatch<V>> for Biquadratic<V> {
    type Error = Error;

    fn try_from(patch: &BezierPatch<V>) -> Result<Self, Error> {
        let raised = patch.elevated_to([2, 2]);
        let wrong = Error::WrongCount {
            what: "control mass points of a biquadratic patch",
            found: raised.control().len(),
            needed: 9,
        };
        match raised.control().as_chunks::<3>() {
            ([r0, r1, r2], []) if raised.degrees() == [2, 2] => {
                Ok(Self::from_checked([*r0, *r1, *r2]))
            }
            _ => Err(wrong),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// An eighth of the unit sphere: the parallels u = const collapse to the pole at u = 1.
    pub(crate) fn octant() -> Result<Biquadratic<DVec3>, Error> {
        let h = 0.5_f64.sqrt();
        let (rim, top) = (
            [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
            [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        );
        let weight = [1.0, h, 1.0];
        let control = [0, 1, 2].map(|i| {
            [0, 1, 2].map(|j| {
                let ((r, z), (x, y)) = (top[i], rim[j]);
                MassPoint::point(dvec3(r * x, r * y, z), weight[i] * weight[j])
            })
        });
        Biquadratic::new(control)
    }

    #[test]
    fn the_octant_is_on_the_sphere_with_radial_normals_up_to_the_pole() -> Result<(), Error> {
        let octant = octant()?;
        for i in 0..=8 {
            for j in 0..=8 {
                let (u, v) = (f64::from(i) / 8.0, f64::from(j) / 8.0);
                let point = octant.point(u, v)?;
                assert!((point.length() - 1.0).abs() < 1e-15);
                let normal = octant.normal(u, v).unwrap_or(DVec3::NAN);
                // u goes up and v goes round, so the normal points inwards.
                assert!(
                    (normal + point).length() < 1e-14,
                    "at ({u}, {v}): {normal} against {point}"
                );
            }
        }
        Ok(())
    }

    #[test]
    fn the_biquadratic_is_the_patch_of_bidegree_two() -> Result<(), Error> {
        let octant = octant()?;
        let patch = BezierPatch::from(octant);
        assert_eq!(Biquadratic::try_from(&patch)?, octant);
        for (u, v) in [(0.0, 0.0), (0.3, 0.8), (1.0, 0.5), (-0.5, 1.5)] {
            let (a, b) = (octant.jet(u, v), patch.jet(u, v));
            let pairs = [
                (a.value, b.value),
                (a.du, b.du),
                (a.dv, b.dv),
                (a.duu, b.duu),
                (a.duv, b.duv),
                (a.dvv, b.dvv),
            ];
            for (x, y) in pairs {
                assert!(
                    (x - y).magnitude() < 1e-13,
                    "at ({u}, {v}): {x:?} against {y:?}"
                );
            }
        }
        Ok(())
    }

    #[test]
    fn parts_are_parts_of_the_same_patch() -> Result<(), Error> {
        let octant = octant()?;
        let part = octant.sub_patch([0.25, 0.75], [0.5, 2.0])?;
        let (_, above) = octant.subdivide_u(0.25);
        let (below, _) = above.subdivide_v(0.5);
        for (s, t) in [(0.0, 0.0), (0.5, 0.25), (1.0, 1.0)] {
            let expected = octant.point(0.25 + 0.5 * s, 0.5 + 1.5 * t)?;
            assert!((part.point(s, t)? - expected).length() < 1e-14);
            let expected = octant.point(0.25 + 0.75 * s, 0.5 * t)?;
            assert!((below.point(s, t)? - expected).length() < 1e-14);
        }
        Ok(())
    }

    #[test]
    fn middle_curves_are_iso_curves() -> Result<(), Error> {
        let octant = octant()?;
        let [along_u, along_v] = octant.middle_curves();
        for t in [0.0, 0.3, 1.0] {
            assert!((along_u.point(t)? - octant.point(t, 0.5)?).length() < 1e-15);
            assert!((along_v.point(t)? - octant.point(0.5, t)?).length() < 1e-15);
            assert!((octant.curve_at_u(0.3).point(t)? - octant.point(0.3, t)?).length() < 1e-15);
            assert!((octant.curve_at_v(0.3).point(t)? - octant.point(t, 0.3)?).length() < 1e-15);
        }
        Ok(())
    }
}
