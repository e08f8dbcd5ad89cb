//! Positions and normals of patches, one by one and on parameter grids for tessellation.

use crate::curve::position_at;
use crate::jet::unit_normal;
use crate::{BezierPatch, Biquadratic, Error, MassPoint, PatchJet, VectorSpace, bernstein};
use glam::DVec3;

/// A point of a surface and the unit normal there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfacePoint {
    /// The position.
    pub position: DVec3,
    /// The unit normal along `dP/du x dP/dv`, or its limit; `None` where there is neither (see
    /// [`BezierPatch::normal`]).
    pub normal: Option<DVec3>,
}

/// A row of a biquadratic net at a parameter `v`.
#[derive(Clone, Copy)]
struct RowAt {
    value: MassPoint<DVec3>,
    dv: MassPoint<DVec3>,
    /// The absolute terms of the weight, which bound its rounding error.
    terms: f64,
}

impl RowAt {
    #[inline]
    fn new(row: [MassPoint<DVec3>; 3], v: f64) -> Self {
        let [value, dv] = value_and_slope(row, v);
        Self {
            value,
            dv,
            terms: combine(
                row.map(|h| h.weight.abs()),
                bernstein::quadratic_basis(v).map(f64::abs),
            ),
        }
    }
}

impl<V: VectorSpace> Biquadratic<V> {
    /// The mass points over the grid of all `us` and `vs`, those of one `u` one after the other.
    ///
    /// Linear in the number of grid points, with one curve computed for each `u`; cheaper by far than as many calls of
    /// [`Biquadratic::at`].
    #[must_use]
    pub fn grid_values(&self, us: &[f64], vs: &[f64]) -> Vec<MassPoint<V>> {
        let mut values = Vec::with_capacity(us.len().saturating_mul(vs.len()));
        for &u in us {
            let curve = self.curve_at_u(u);
            values.extend(vs.iter().map(|&v| curve.at(v)));
        }
        values
    }
}

impl Biquadratic<DVec3> {
    /// The position and the unit normal at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point_and_normal(&self, u: f64, v: f64) -> Result<SurfacePoint, Error> {
        self.across(self.control().map(|row| RowAt::new(row, v)), u, v)
    }

    /// Positions and normals over the grid of all `us` and `vs`, those of one `u` one after the other.
    ///
    /// # Errors
    /// As [`Biquadratic::point_and_normal`], at the first grid point that has no position.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Result<Vec<SurfacePoint>, Error> {
        // The rows are done once for each v; what remains for each point is a quadratic in u.
        let rows: Vec<_> = vs
            .iter()
            .map(|&v| self.control().map(|row| RowAt::new(row, v)))
            .collect();
        let mut points = Vec::with_capacity(us.len().saturating_mul(vs.len()));
        for &u in us {
            for (&v, &rows) in vs.iter().zip(&rows) {
                points.push(self.across(rows, u, v)?);
            }
        }
        Ok(points)
    }

    /// The point at `u` across the three rows at `v`.
    #[inline]
    fn across(&self, rows: [RowAt; 3], u: f64, v: f64) -> Result<SurfacePoint, Error> {
        let basis = bernstein::quadratic_basis(u);
        let [value, du] = value_and_slope(rows.map(|row| row.value), u);
        let dv = combine(rows.map(|row| row.dv), basis);
        let terms = combine(rows.map(|row| row.terms), basis.map(f64::abs));
        surface_point([value.settled(terms), du, dv], [u, v], || self.jet(u, v))
    }
}

impl BezierPatch<DVec3> {
    /// The position and the unit normal at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point_and_normal(&self, u: f64, v: f64) -> Result<SurfacePoint, Error> {
        let jet = self.jet(u, v);
        surface_point([jet.value, jet.du, jet.dv], [u, v], || jet)
    }

    /// Positions and normals over the grid of all `us` and `vs`, those of one `u` one after the other.
    ///
    /// # Errors
    /// As [`BezierPatch::point_and_normal`], at the first grid point that has no position.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Result<Vec<SurfacePoint>, Error> {
        let mut points = Vec::with_capacity(us.len().saturating_mul(vs.len()));
        let transposed = self.transposed();
        let (mut values, mut slopes) = (Vec::new(), Vec::new());
        for &u in us {
            // The iso-curve at u and its derivative by u, as control polygons in v.
            values.clear();
            slopes.clear();
            for column in transposed.rows() {
                let [value, slope, _] = bernstein::jet(column, u);
                values.push(value);
                slopes.push(slope);
            }
            for &v in vs {
                let [value, dv, _] = bernstein::jet(&values, v);
                let du = bernstein::evaluate(&slopes, v);
                points.push(surface_point([value, du, dv], [u, v], || self.jet(u, v))?);
            }
        }
        Ok(points)
    }
}

/// The value and the derivative of a quadratic Bernstein polynomial.
#[inline]
fn value_and_slope<V: VectorSpace>([h0, h1, h2]: [V; 3], t: f64) -> [V; 2] {
    let (p0, p1) = (h0.lerp(h1, t), h1.lerp(h2, t));
    [p0.lerp(p1, t), p1.minus(p0).times(2.0)]
}

#[inline]
fn combine<V: VectorSpace>([x0, x1, x2]: [V; 3], [b0, b1, b2]: [f64; 3]) -> V {
    x0.times(b0).plus(x1.times(b1)).plus(x2.times(b2))
}

/// The surface point with the value and first derivatives `[h, h_u, h_v]`; the full jet decides where these do not
/// determine the normal.
#[inline]
fn surface_point(
    [value, du, dv]: [MassPoint<DVec3>; 3],
    [u, v]: [f64; 2],
    jet: impl FnOnce() -> PatchJet<DVec3>,
) -> Result<SurfacePoint, Error> {
    let position = position_at(value, if v.is_finite() { u } else { v })?;
    let normal = unit_normal([value, du, dv]).or_else(|| jet().normal_or_limit(u, v));
    Ok(SurfacePoint { position, normal })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// A patch with a collapsed edge at `u = 0` and a weight that vanishes only far outside the unit square.
    fn cap() -> Result<Biquadratic<DVec3>, Error> {
        let rim = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let rows = [(0.0, 1.0, 1.0), (1.0, 1.0, 0.6), (1.0, 0.0, 1.0)];
        let weights = [1.0, 0.7, 1.3];
        Biquadratic::new([0, 1, 2].map(|i| {
            let (r, z, w) = rows[i];
            [0, 1, 2]
                .map(|j| MassPoint::point(dvec3(r * rim[j].0, r * rim[j].1, z), w * weights[j]))
        }))
    }

    #[test]
    fn grids_agree_with_single_points_and_with_the_general_patch() -> Result<(), Error> {
        let (cap, us, vs) = (cap()?, [0.0, 0.3, 1.0], [0.0, 0.25, 0.5, 1.0]);
        let general = BezierPatch::from(cap);
        let (grid, general_grid, values) = (
            cap.grid(&us, &vs)?,
            general.grid(&us, &vs)?,
            cap.grid_values(&us, &vs),
        );
        let parameters = us.iter().flat_map(|&u| vs.iter().map(move |&v| (u, v)));
        for (i, (u, v)) in parameters.enumerate() {
            let normal = cap.normal(u, v).unwrap_or(DVec3::NAN);
            for point in [
                grid[i],
                general_grid[i],
                cap.point_and_normal(u, v)?,
                general.point_and_normal(u, v)?,
            ] {
                assert!((point.position - cap.point(u, v)?).length() < 1e-15);
                assert!(
                    point.normal.is_some_and(|n| (n - normal).length() < 1e-14),
                    "at ({u}, {v}): {point:?}"
                );
            }
            assert!((values[i] - cap.at(u, v)).magnitude() < 1e-15);
        }
        Ok(())
    }

    #[test]
    fn a_grid_point_at_infinity_or_nowhere_is_an_error() -> Result<(), Error> {
        let point = |x, y, w| MassPoint::point(dvec3(x, y, x * y), w);
        let row = |x, w| [point(x, 0.0, w), point(x, 1.0, w), point(x, 2.0, w)];
        let patch = Biquadratic::new([row(0.0, 1.0), row(1.0, 0.0), row(2.0, -1.0)])?;
        assert_eq!(
            patch.grid(&[0.25, 0.5], &[0.5]),
            Err(Error::AtInfinity { t: 0.5 })
        );
        assert_eq!(
            BezierPatch::from(patch).grid(&[0.5], &[0.5]),
            Err(Error::AtInfinity { t: 0.5 })
        );
        assert!(matches!(
            patch.grid(&[0.25], &[f64::NAN]),
            Err(Error::NonFinite { .. })
        ));
        assert_eq!(patch.grid(&[], &[0.5]), Ok(Vec::new()));
        Ok(())
    }
}
