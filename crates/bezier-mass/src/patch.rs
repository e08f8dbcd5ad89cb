//! Tensor-product rational patches of any bidegree.

use crate::curve::position_at;
use crate::mass_point::is_clear;
use crate::{
    BezierCurve, Error, Homography, MassPoint, Parameter, PatchJet, VectorSpace, bernstein,
};
use glam::DVec3;

/// A rational tensor-product Bézier patch of any bidegree `(m, n)` with mass control points.
///
/// `h(u, v) = sum_ij B_i(u) B_j(v) h_ij`. The control net is stored row by row: row `i` is a control polygon
/// along `v`. For bidegree (2, 2) without allocation see [`Biquadratic`](crate::Biquadratic).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "ControlNet<V>", into = "ControlNet<V>")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct BezierPatch<V> {
    degrees: [usize; 2],
    control: Vec<MassPoint<V>>,
}

/// What a patch is written as: the rows of its control net.
#[cfg(feature = "serde")]
type ControlNet<V> = Vec<Vec<MassPoint<V>>>;

impl<V: VectorSpace> BezierPatch<V> {
    /// The patch of bidegree `degrees` (in `u`, in `v`) with the control net `control`, row by row.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are `(m + 1) (n + 1)` control mass points; [`Error::NonFinite`].
    pub fn new(degrees: [usize; 2], control: Vec<MassPoint<V>>) -> Result<Self, Error> {
        let needed = degrees
            .map(|degree| degree.saturating_add(1))
            .into_iter()
            .fold(1, usize::saturating_mul);
        if control.len() != needed {
            return Err(Error::WrongCount {
                what: "control mass points of the net",
                found: control.len(),
                needed,
            });
        }
        for &mass_point in &control {
            mass_point.checked()?;
        }
        Ok(Self { degrees, control })
    }

    /// The patch whose control net has these rows, each a control polygon along `v`.
    ///
    /// # Errors
    /// [`Error::WrongCount`] for no rows, empty rows or rows of different lengths; [`Error::NonFinite`].
    pub fn from_rows<R: AsRef<[MassPoint<V>]>>(rows: &[R]) -> Result<Self, Error> {
        let columns = rows.first().map_or(0, |row| row.as_ref().len());
        if columns == 0 {
            return Err(Error::WrongCount {
                what: "control mass points of the first row",
                found: 0,
                needed: 1,
            });
        }
        if let Some(row) = rows.iter().find(|row| row.as_ref().len() != columns) {
            let found = row.as_ref().len();
            return Err(Error::WrongCount {
                what: "control mass points of a row",
                found,
                needed: columns,
            });
        }
        let control = rows
            .iter()
            .flat_map(|row| row.as_ref().iter().copied())
            .collect();
        Self::new([rows.len() - 1, columns - 1], control)
    }

    /// The polynomial patch of bidegree `degrees` with these control points, all of weight one.
    ///
    /// # Errors
    /// As [`BezierPatch::new`].
    pub fn polynomial(degrees: [usize; 2], points: &[V]) -> Result<Self, Error> {
        Self::new(
            degrees,
            points
                .iter()
                .map(|&position| MassPoint::point(position, 1.0))
                .collect(),
        )
    }

    /// The patch with a control net that is known to be right.
    pub(crate) const fn from_checked(degrees: [usize; 2], control: Vec<MassPoint<V>>) -> Self {
        Self { degrees, control }
    }

    /// The degrees in `u` and `v`.
    #[must_use]
    pub fn degrees(&self) -> [usize; 2] {
        self.degrees
    }

    /// The control net, row by row.
    #[must_use]
    pub fn control(&self) -> &[MassPoint<V>] {
        &self.control
    }

    /// The rows of the control net: one control polygon along `v` for each `i`.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[MassPoint<V>]> + Clone {
        self.control.chunks_exact(self.degrees[1] + 1)
    }

    /// The mass point at `(u, v)`: a point, or a vector where the weight vanishes to rounding. Does not allocate.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> MassPoint<V> {
        let rows = self.rows().map(|row| bernstein::evaluate(row, v));
        let value = bernstein::evaluate_terms(rows, u);
        if self.is_clear(value.weight, u, v) {
            value
        } else {
            value.settled(self.weight_terms(u, v))
        }
    }

    /// Whether a weight computed at `(u, v)` is far above its rounding error.
    pub(crate) fn is_clear(&self, weight: f64, u: f64, v: f64) -> bool {
        let unit = 0.0..=1.0;
        unit.contains(&u) && unit.contains(&v) && is_clear(weight, &self.control)
    }

    /// The absolute terms of the weight's Bernstein sum, which bound its rounding error.
    fn weight_terms(&self, u: f64, v: f64) -> f64 {
        let absolute = |t: f64, degree: usize| {
            bernstein::basis(degree, t)
                .into_iter()
                .map(f64::abs)
                .collect()
        };
        let (b, c): (Vec<f64>, Vec<f64>) =
            (absolute(u, self.degrees[0]), absolute(v, self.degrees[1]));
        let row = |row: &[MassPoint<V>]| -> f64 {
            row.iter().zip(&c).map(|(h, c)| h.weight.abs() * c).sum()
        };
        self.rows().zip(&b).map(|(h, b)| b * row(h)).sum()
    }

    /// The position at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point(&self, u: f64, v: f64) -> Result<V, Error> {
        position_at(self.at(u, v), if v.is_finite() { u } else { v })
    }

    /// The value with its partial derivatives to second order at `(u, v)`, as mass points.
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> PatchJet<V> {
        let row_jets: Vec<[MassPoint<V>; 3]> =
            self.rows().map(|row| bernstein::jet(row, v)).collect();
        let along_u = |order: usize| -> [MassPoint<V>; 3] {
            let column: Vec<_> = row_jets.iter().map(|jet| jet[order]).collect();
            bernstein::jet(&column, u)
        };
        let ([_, du, duu], [dv, duv, _], [dvv, _, _]) = (along_u(0), along_u(1), along_u(2));
        PatchJet {
            value: self.at(u, v),
            du,
            dv,
            duu,
            duv,
            dvv,
        }
    }

    /// The iso-curve at fixed `u`, a curve in `v`.
    #[must_use]
    pub fn curve_at_u(&self, u: f64) -> BezierCurve<V> {
        self.transposed().curve_at_v(u)
    }

    /// The iso-curve at fixed `v`, a curve in `u`.
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> BezierCurve<V> {
        BezierCurve::from_checked(self.rows().map(|row| bernstein::evaluate(row, v)).collect())
    }

    /// The barycentric middle curves: the first along `u` (at `v = 1/2`), the second along `v`.
    ///
    /// Control `i` of the first is the barycentre of row `i` with the binomial coefficients as weights, not divided by
    /// their sum.
    #[must_use]
    pub fn middle_curves(&self) -> [BezierCurve<V>; 2] {
        [self, &self.transposed()].map(|patch| {
            let sum = f64::powi(2.0, patch.degrees[1] as i32);
            BezierCurve::from_checked(
                patch
                    .rows()
                    .map(|row| bernstein::evaluate(row, 0.5) * sum)
                    .collect(),
            )
        })
    }

    /// The patch with `u` and `v` exchanged.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [m, n] = self.degrees;
        let control = (0..=n)
            .flat_map(|j| self.rows().map(move |row| row[j]))
            .collect();
        Self {
            degrees: [n, m],
            control,
        }
    }

    /// The patch with every row replaced by `change(row)`; all of these have one length.
    fn map_rows(&self, change: impl Fn(&[MassPoint<V>]) -> Vec<MassPoint<V>>) -> Self {
        let control: Vec<_> = self.rows().flat_map(change).collect();
        let columns = control.len() / (self.degrees[0] + 1);
        Self {
            degrees: [self.degrees[0], columns - 1],
            control,
        }
    }

    /// The patch run backwards in `u`. Its normal changes side.
    #[must_use]
    pub fn reversed_u(&self) -> Self {
        self.transposed().reversed_v().transposed()
    }

    /// The patch run backwards in `v`. Its normal changes side.
    #[must_use]
    pub fn reversed_v(&self) -> Self {
        self.map_rows(|row| row.iter().rev().copied().collect())
    }

    /// The patch after a homographic change of each parameter.
    #[must_use]
    pub fn reparametrised(&self, u: Homography, v: Homography) -> Self {
        let along_v = |patch: &Self, h: Homography| {
            patch.map_rows(|row| {
                bernstein::reparametrise(row, h.start().barycentric(), h.end().barycentric())
            })
        };
        along_v(&along_v(self, v).transposed(), u).transposed()
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
        let below = self.map_rows(|row| bernstein::subdivide(row, v).0);
        let above = self.map_rows(|row| bernstein::subdivide(row, v).1);
        (below, above)
    }

    /// The same patch written with degrees at least `degrees`.
    #[must_use]
    pub fn elevated_to(&self, degrees: [usize; 2]) -> Self {
        let along_v = self
            .map_rows(|row| bernstein::elevate_to(row, degrees[1]))
            .transposed();
        along_v
            .map_rows(|row| bernstein::elevate_to(row, degrees[0]))
            .transposed()
    }

    /// The patch with every control mass point mapped by `map`, which should be linear in the mass point.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<BezierPatch<W>, Error> {
        BezierPatch::new(self.degrees, self.control.iter().map(|&h| map(h)).collect())
    }
}

impl BezierPatch<DVec3> {
    /// The unit normal along `dP/du x dP/dv`.
    ///
    /// Computed from the plane through `h`, `h_u`, `h_v`, without a division by the weight. Where that is undetermined
    /// (a collapsed edge, a pole) it is the limit on the way from the middle of the patch; `None` where this is not
    /// determined by the derivatives to second order either.
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        self.jet(u, v).normal_or_limit(u, v)
    }
}

#[cfg(feature = "serde")]
impl<V: VectorSpace> TryFrom<ControlNet<V>> for BezierPatch<V> {
    type Error = Error;

    fn try_from(rows: ControlNet<V>) -> Result<Self, Error> {
        Self::from_rows(&rows)
    }
}

#[cfg(feature = "serde")]
impl<V: VectorSpace> From<BezierPatch<V>> for ControlNet<V> {
    fn from(patch: BezierPatch<V>) -> Self {
        patch.rows().map(<[_]>::to_vec).collect()
    }
}

#[cfg(test)]
mod tests;
