//! Rational B-spline surfaces.

use crate::curve::position_at;
use crate::{BSplineCurve, BezierPatch, Error, Knots, MassPoint, PatchJet, VectorSpace};
use glam::DVec3;

/// A rational B-spline surface (NURBS surface) whose control points are mass points; each direction clamped, loose or
/// periodic.
///
/// The control net is stored row by row: row `i` is a control polygon along `v`. For many evaluations, or anything else
/// that Bézier patches can do, take its [`pieces`](BSplineSurface::pieces).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "SurfaceData<V>", into = "SurfaceData<V>")
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(serialize = "V: VectorSpace + serde::Serialize"))
)]
#[cfg_attr(
    feature = "serde",
    serde(bound(deserialize = "V: VectorSpace + serde::Deserialize<'de>"))
)]
pub struct BSplineSurface<V> {
    knots: [Knots; 2],
    control: Vec<MassPoint<V>>,
}

/// A polynomial piece of a spline surface: a Bézier patch over a rectangle of the surface's parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchPiece<V> {
    /// The surface's `u` at the patch's own 0 and 1.
    pub u: [f64; 2],
    /// The surface's `v` at the patch's own 0 and 1.
    pub v: [f64; 2],
    /// The piece.
    pub patch: BezierPatch<V>,
}

impl<V: VectorSpace> BSplineSurface<V> {
    /// The surface with these knots in `u` and `v` and this control net, row by row.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are as many control mass points as the product of the two
    /// [`Knots::control_count`]; [`Error::NonFinite`].
    pub fn new(knots: [Knots; 2], control: Vec<MassPoint<V>>) -> Result<Self, Error> {
        let needed = knots[0]
            .control_count()
            .saturating_mul(knots[1].control_count());
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
        Ok(Self { knots, control })
    }

    /// The polynomial surface with these knots and control points, all of weight one.
    ///
    /// # Errors
    /// As [`BSplineSurface::new`].
    pub fn polynomial(knots: [Knots; 2], points: &[V]) -> Result<Self, Error> {
        Self::new(
            knots,
            points
                .iter()
                .map(|&position| MassPoint::point(position, 1.0))
                .collect(),
        )
    }

    /// The knots in `u` and in `v`.
    #[must_use]
    pub fn knots(&self) -> &[Knots; 2] {
        &self.knots
    }

    /// The control net, row by row; in a periodic direction one period of it.
    #[must_use]
    pub fn control(&self) -> &[MassPoint<V>] {
        &self.control
    }

    /// The rows of the control net: one control polygon along `v` for each `i`.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &[MassPoint<V>]> + Clone {
        self.control.chunks_exact(self.knots[1].control_count())
    }

    /// The mass point at `(u, v)`: a point, or a vector where the weight vanishes to rounding.
    #[must_use]
    pub fn at(&self, u: f64, v: f64) -> MassPoint<V> {
        self.curve_at_v(v).at(u)
    }

    /// The position at `(u, v)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if a parameter is; [`Error::AtInfinity`] where the weight vanishes.
    pub fn point(&self, u: f64, v: f64) -> Result<V, Error> {
        position_at(self.at(u, v), if v.is_finite() { u } else { v })
    }

    /// The value with its partial derivatives to second order at `(u, v)`, as mass points (at a knot: of the piece that
    /// begins there).
    #[must_use]
    pub fn jet(&self, u: f64, v: f64) -> PatchJet<V> {
        let row_jets: Vec<[MassPoint<V>; 3]> =
            self.rows().map(|row| self.knots[1].jet(row, v)).collect();
        let along_u = |order: usize| -> [MassPoint<V>; 3] {
            let column: Vec<_> = row_jets.iter().map(|jet| jet[order]).collect();
            self.knots[0].jet(&column, u)
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

    /// The iso-curve at fixed `u`, a spline in `v`.
    #[must_use]
    pub fn curve_at_u(&self, u: f64) -> BSplineCurve<V> {
        self.transposed().curve_at_v(u)
    }

    /// The iso-curve at fixed `v`, a spline in `u`.
    #[must_use]
    pub fn curve_at_v(&self, v: f64) -> BSplineCurve<V> {
        let control = self
            .rows()
            .map(|row| self.knots[1].evaluate(row, v))
            .collect();
        BSplineCurve::from_checked(self.knots[0].clone(), control)
    }

    /// The surface with `u` and `v` exchanged.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let [u, v] = self.knots.clone();
        let control = (0..v.control_count())
            .flat_map(|j| self.rows().map(move |row| row[j]))
            .collect();
        Self {
            knots: [v, u],
            control,
        }
    }

    /// The polynomial pieces as Bézier patches, those over one span of `u` one after the other.
    #[must_use]
    pub fn pieces(&self) -> Vec<PatchPiece<V>> {
        // Along v first: the coefficients of each row on each span of v; then the columns along u.
        let rows: Vec<_> = self
            .rows()
            .map(|row| self.knots[1].bezier_pieces(row))
            .collect();
        let columns = self.knots[1].degree() + 1;
        let strips = rows.first().map_or(0, Vec::len);
        let mut pieces = Vec::new();
        for strip in 0..strips {
            let v = rows[0][strip].0;
            let along_u: Vec<_> = (0..columns)
                .map(|j| {
                    let column: Vec<_> = rows.iter().map(|row| row[strip].1[j]).collect();
                    self.knots[0].bezier_pieces(&column)
                })
                .collect();
            for (span, (u, first)) in along_u[0].iter().enumerate() {
                let net = (0..first.len())
                    .flat_map(|i| along_u.iter().map(move |column| column[span].1[i]));
                let degrees = self.knots.each_ref().map(Knots::degree);
                pieces.push(PatchPiece {
                    u: *u,
                    v,
                    patch: BezierPatch::from_checked(degrees, net.collect()),
                });
            }
        }
        pieces.sort_by(|a, b| a.u[0].total_cmp(&b.u[0]));
        pieces
    }

    /// The same surface with one more knot at `u`.
    ///
    /// # Errors
    /// As [`BSplineCurve::with_knot`].
    pub fn with_knot_u(&self, u: f64) -> Result<Self, Error> {
        Ok(self.transposed().with_knot_v(u)?.transposed())
    }

    /// The same surface with one more knot at `v`.
    ///
    /// # Errors
    /// As [`BSplineCurve::with_knot`].
    pub fn with_knot_v(&self, v: f64) -> Result<Self, Error> {
        let mut refined = self.knots[1].clone();
        let mut control = Vec::with_capacity(self.control.len() + self.knots[0].control_count());
        for row in self.rows() {
            let (knots, row) = self.knots[1].insert(row, v)?;
            refined = knots;
            control.extend(row);
        }
        Ok(Self {
            knots: [self.knots[0].clone(), refined],
            control,
        })
    }

    /// The surface with every control mass point mapped by `map`, which should be linear in the mass point.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `map` produces such a value.
    pub fn map<W: VectorSpace>(
        &self,
        map: impl Fn(MassPoint<V>) -> MassPoint<W>,
    ) -> Result<BSplineSurface<W>, Error> {
        BSplineSurface::new(
            self.knots.clone(),
            self.control.iter().map(|&h| map(h)).collect(),
        )
    }
}

impl BSplineSurface<DVec3> {
    /// The unit normal along `dP/du x dP/dv`; see [`BezierPatch::normal`] for where it is a limit or missing.
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        let [[u0, u1], [v0, v1]] = self.knots.each_ref().map(Knots::domain);
        self.jet(u, v)
            .normal_or_limit((u - u0) / (u1 - u0), (v - v0) / (v1 - v0))
    }
}

/// A Bézier patch as a surface of one piece on the unit square.
impl<V: VectorSpace> TryFrom<&BezierPatch<V>> for BSplineSurface<V> {
    type Error = Error;

    fn try_from(patch: &BezierPatch<V>) -> Result<Self, Error> {
        let [m, n] = patch.degrees();
        let knots = [
            Knots::clamped(m, &[0.0, 1.0])?,
            Knots::clamped(n, &[0.0, 1.0])?,
        ];
        Self::new(knots, patch.control().to_vec())
    }
}

/// What a surface is written as.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct SurfaceData<V> {
    knots: [Knots; 2],
    control: Vec<MassPoint<V>>,
}

#[cfg(feature = "serde")]
impl<V> From<BSplineSurface<V>> for SurfaceData<V> {
    fn from(BSplineSurface { knots, control }: BSplineSurface<V>) -> Self {
        Self { knots, control }
    }
}

#[cfg(feature = "serde")]
impl<V: VectorSpace> TryFrom<SurfaceData<V>> for BSplineSurface<V> {
    type Error = Error;

    fn try_from(SurfaceData { knots, control }: SurfaceData<V>) -> Result<Self, Error> {
        Self::new(knots, control)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    /// A wavy tube: periodic cubic round the axis, clamped quadratic with a double knot along it.
    fn tube() -> Result<BSplineSurface<DVec3>, Error> {
        let knots = [
            Knots::new(2, vec![0.0, 0.0, 0.0, 1.0, 3.0, 3.0, 4.0, 4.0, 4.0])?,
            Knots::periodic_uniform(3, 7)?,
        ];
        let net = (0..6_u8).flat_map(|i| {
            (0..7_u8).map(move |j| {
                let (z, angle) = (f64::from(i), f64::from(j) * core::f64::consts::TAU / 7.0);
                let radius = 2.0 + 0.3 * z.sin();
                MassPoint::point(
                    dvec3(radius * angle.cos(), radius * angle.sin(), z),
                    1.0 + 0.1 * f64::from(i * j % 5),
                )
            })
        });
        BSplineSurface::new(knots, net.collect())
    }

    #[test]
    fn pieces_refinement_and_iso_curves_are_the_same_surface() -> Result<(), Error> {
        let tube = tube()?;
        let pieces = tube.pieces();
        assert_eq!(pieces.len(), 3 * 7);
        for piece in &pieces {
            for (s, t) in [(0.0, 0.0), (0.3, 0.9), (1.0, 0.5)] {
                let u = piece.u[0] + s * (piece.u[1] - piece.u[0]);
                let v = piece.v[0] + t * (piece.v[1] - piece.v[0]);
                let point = tube.point(u, v)?;
                assert!((piece.patch.point(s, t)? - point).length() < 1e-14);
                assert!((tube.curve_at_u(u).point(v)? - point).length() < 1e-14);
                assert!((tube.transposed().point(v, u)? - point).length() < 1e-14);
                assert!(
                    (tube.with_knot_u(0.4)?.with_knot_v(0.9)?.point(u, v)? - point).length()
                        < 1e-14
                );
                assert!((tube.point(u, v + 1.0)? - point).length() < 1e-14);
            }
            let [u, v] = [piece.u, piece.v].map(|[a, b]| a + 0.3 * (b - a));
            let (local, global) = (piece.patch.normal(0.3, 0.3), tube.normal(u, v));
            assert!(
                local
                    .zip(global)
                    .is_some_and(|(a, b)| (a - b).length() < 1e-13)
            );
        }
        Ok(())
    }

    #[test]
    fn a_patch_is_a_surface_of_one_piece() -> Result<(), Error> {
        let points: Vec<DVec3> = (0..6_u8)
            .map(|i| dvec3(f64::from(i / 3), f64::from(i % 3), f64::from(i * i)))
            .collect();
        let patch = BezierPatch::polynomial([1, 2], &points)?;
        let surface = BSplineSurface::try_from(&patch)?;
        assert_eq!(surface.pieces()[0].patch, patch);
        let (a, b) = (patch.jet(0.2, 0.7), surface.jet(0.2, 0.7));
        assert!((a.duv - b.duv).magnitude() < 1e-14 && (a.dvv - b.dvv).magnitude() < 1e-14);
        Ok(())
    }

    #[test]
    fn wrong_nets_are_refused() -> Result<(), Error> {
        let knots = [Knots::clamped_uniform(2, 4)?, Knots::clamped_uniform(1, 2)?];
        assert!(matches!(
            BSplineSurface::polynomial(knots, &[1.0; 7]),
            Err(Error::WrongCount { needed: 8, .. })
        ));
        Ok(())
    }
}
