//! Positions and normals of patches, one by one and on parameter grids for tessellation.

use crate::curve::position_at;
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

/// A row of a biquadratic net at a parameter `v`: the value and the derivative by `v`.
#[derive(Clone, Copy)]
struct RowAt {
    value: MassPoint<DVec3>,
    dv: MassPoint<DVec3>,
}

impl RowAt {
    #[inline]
    fn new(row: &[MassPoint<DVec3>; 3], v: f64) -> Self {
        let [value, dv] = value_and_slope(row, v);
        Self { value, dv }
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
        self.across(&self.rows_at(v), u, v)
    }

    /// Positions and normals over the grid of all `us` and `vs`, those of one `u` one after the other.
    ///
    /// # Errors
    /// As [`Biquadratic::point_and_normal`], at the first grid point that has no position.
    pub fn grid(&self, us: &[f64], vs: &[f64]) -> Result<Vec<SurfacePoint>, Error> {
        // The rows are done once for each v; what remains for each point is a quadratic in u.
        let rows: Vec<_> = vs.iter().map(|&v| self.rows_at(v)).collect();
        let mut points = Vec::with_capacity(us.len().saturating_mul(vs.len()));
        for &u in us {
            for (&v, rows) in vs.iter().zip(&rows) {
                points.push(self.across(rows, u, v)?);
            }
        }
        Ok(points)
    }

    /// [`Biquadratic::grid`] on all cores of rayon's pool, each with its share of the `us`. Pays for large grids.
    ///
    /// # Errors
    /// As [`Biquadratic::grid`], though not always at the first grid point that has no position.
    #[cfg(feature = "rayon")]
    pub fn par_grid(&self, us: &[f64], vs: &[f64]) -> Result<Vec<SurfacePoint>, Error> {
        in_shares(us, |share| self.grid(share, vs))
    }

    /// The three rows at `v`.
    #[inline]
    fn rows_at(&self, v: f64) -> [RowAt; 3] {
        let [r0, r1, r2] = self.control();
        [RowAt::new(r0, v), RowAt::new(r1, v), RowAt::new(r2, v)]
    }

    /// The point at `u` across the three rows at `v`.
    #[inline]
    fn across(&self, [r0, r1, r2]: &[RowAt; 3], u: f64, v: f64) -> Result<SurfacePoint, Error> {
        let [b0, b1, b2] = bernstein::quadratic_basis(u);
        let [value, du] = value_and_slope(&[r0.value, r1.value, r2.value], u);
        let dv = r0.dv * b0 + r1.dv * b1 + r2.dv * b2;
        let clear = if self.is_clear(value.weight, u, v) {
            clear_point(value, du, dv)
        } else {
            None
        };
        clear.map_or_else(|| careful_point(&self.jet(u, v), u, v), Ok)
    }
}

impl BezierPatch<DVec3> {
    /// The position and the unit normal at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point_and_normal(&self, u: f64, v: f64) -> Result<SurfacePoint, Error> {
        let jet = self.jet(u, v);
        careful_point(&jet, u, v)
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
                let clear = if self.is_clear(value.weight, u, v) {
                    clear_point(value, du, dv)
                } else {
                    None
                };
                points.push(clear.map_or_else(|| careful_point(&self.jet(u, v), u, v), Ok)?);
            }
        }
        Ok(points)
    }

    /// [`BezierPatch::grid`] on all cores of rayon's pool, each with its share of the `us`. Pays for large grids.
    ///
    /// # Errors
    /// As [`BezierPatch::grid`], though not always at the first grid point that has no position.
    #[cfg(feature = "rayon")]
    pub fn par_grid(&self, us: &[f64], vs: &[f64]) -> Result<Vec<SurfacePoint>, Error> {
        in_shares(us, |share| self.grid(share, vs))
    }
}

/// The points over every thread's share of the `us`, put together in order.
#[cfg(feature = "rayon")]
fn in_shares(
    us: &[f64],
    grid: impl Fn(&[f64]) -> Result<Vec<SurfacePoint>, Error> + Sync,
) -> Result<Vec<SurfacePoint>, Error> {
    use rayon::prelude::*;
    let share = us.len().div_ceil(rayon::current_num_threads()).max(1);
    let shares: Vec<_> = us.par_chunks(share).map(&grid).collect::<Result<_, _>>()?;
    Ok(shares.concat())
}

/// The value and the derivative of a quadratic Bernstein polynomial.
#[inline]
fn value_and_slope<V: VectorSpace>(&[h0, h1, h2]: &[V; 3], t: f64) -> [V; 2] {
    let [b0, b1, b2] = bernstein::quadratic_basis(t);
    let value = h0.times(b0).plus(h1.times(b1)).plus(h2.times(b2));
    [
        value,
        h1.minus(h0)
            .times(2.0 - 2.0 * t)
            .plus(h2.minus(h1).times(2.0 * t)),
    ]
}

/// The surface point where the first derivatives determine the normal with eight digits or more to spare; nearly all
/// points of nearly all patches. The weight is known to be clear of rounding error.
#[inline]
fn clear_point(
    value: MassPoint<DVec3>,
    du: MassPoint<DVec3>,
    dv: MassPoint<DVec3>,
) -> Option<SurfacePoint> {
    let normal = value.moment(du).cross(value.moment(dv));
    let square = normal.length_squared();
    // The squared sizes of the terms of the two moments bound the rounding error of the normal.
    let size = |d: MassPoint<DVec3>| {
        value.weight * value.weight * d.weighted.length_squared()
            + d.weight * d.weight * value.weighted.length_squared()
    };
    let position = value.weighted * (1.0 / value.weight);
    (square > CLEAR_NORMAL * size(du) * size(dv) && square.is_finite() && position.is_finite())
        .then(|| SurfacePoint {
            position,
            normal: Some(normal * (1.0 / square.sqrt())),
        })
}

/// The squared sine and size below which a normal is computed with more care.
const CLEAR_NORMAL: f64 = 1e-16;

/// The surface point in every case: the weight settled, the normal by the full jet.
#[cold]
fn careful_point(jet: &PatchJet<DVec3>, u: f64, v: f64) -> Result<SurfacePoint, Error> {
    let position = position_at(jet.value, if v.is_finite() { u } else { v })?;
    Ok(SurfacePoint {
        position,
        normal: jet.normal_or_limit(u, v),
    })
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
        #[cfg(feature = "rayon")]
        {
            assert_eq!(cap.par_grid(&us, &vs)?, grid);
            assert_eq!(general.par_grid(&us, &vs)?, general_grid);
            assert!(cap.par_grid(&[], &vs)?.is_empty());
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
