//! The bicubically blended Coons patch whose four boundaries are geodesics.
//!
//! Section 3.6 of the thesis chapter, and R. T. Farouki, N. Szafran, L. Biard, *Existence conditions for Coons
//! patches interpolating geodesic boundary curves*, CAGD 26, 2009. The transverse derivatives along a boundary
//! lie in its tangent planes, `T = p along + q across` with cubic `p`, `q`. The twist `R_uv` at a corner has a
//! normal part that both boundaries agree on exactly when the crossing identity holds; its tangential part, two
//! numbers a corner, is free.

use crate::conditions::{
    BoundaryReport, CONDITION_TOLERANCE, Corner, CornerCurve, CornerCurves, check,
};
use crate::hermite::{HermiteCubic, combine, hermite, least_same_sign};
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::{Error, Surface};
use bezier_mass::Partials;
use glam::{DMat2, DVec2, DVec3};

/// The tangential parts of the four corner twists `R_uv`, the free parameters of a rectangle: corners in the
/// order 00, 10, 01, 11, components along `e` and `N x e`, `e` the unit tangent of the boundary along `u` and
/// `N` the surface normal. In units of length.
pub type Twists = [[f64; 2]; 4];

/// The corner with this index in the order 00, 10, 01, 11, as `[i, j]` for `u = i`, `v = j`.
pub(crate) const CORNERS: [[usize; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// The two boundary curves at a corner: `r1` or `r3` along `u`, `r2` or `r4` along `v`.
fn sides_at([i, j]: [usize; 2]) -> [usize; 2] {
    [2 * j, 1 + 2 * i]
}

fn corner_curves() -> [CornerCurves; 4] {
    CORNERS.map(|[i, j]| {
        let [along_u, along_v] = sides_at([i, j]);
        CornerCurves {
            corner: Corner::Rectangle(i, j),
            first: CornerCurve {
                side: along_u,
                t: i as f64,
                outward: 1.0,
            },
            second: CornerCurve {
                side: along_v,
                t: j as f64,
                outward: 1.0,
            },
        }
    })
}

/// Around the rectangle as equation (3.8): `r2`, `r3`, then `r4` and `r1` backwards.
const AROUND: [(usize, bool); 4] = [(1, false), (2, false), (3, true), (0, true)];

/// Checks the conditions C1 to C3 for four strips `r1(u) = R(u,0)`, `r2(v) = R(0,v)`, `r3(u) = R(u,1)`,
/// `r4(v) = R(1,v)`, with a tolerance relative to the size of the boundary.
///
/// A corner that fails one check is not tested further, so a C1 failure hides C3 there.
pub fn check_rectangle<S: Strip>(strips: &[S; 4], tolerance: f64) -> BoundaryReport {
    check(strips, &corner_curves(), &AROUND, tolerance)
}

/// What a corner of a rectangle fixes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CornerFrame {
    point: DVec3,
    /// Unit tangent of the boundary along `u`, and `N x` it.
    tangents: [DVec3; 2],
    normal: DVec3,
    /// The normal component of `R_uv`.
    twist_normal: f64,
    /// Angle from the boundary along `u` to that along `v`, radians.
    angle: f64,
}

/// Four strips that satisfy the conditions, ready to be filled.
#[derive(Clone, Debug)]
pub struct Rectangle<S = GeodesicStrip> {
    strips: [S; 4],
    /// Samples at the ends 0 and 1 of every strip.
    ends: [[StripSample; 2]; 4],
    corners: [CornerFrame; 4],
    report: BoundaryReport,
}

impl<S: Strip> Rectangle<S> {
    /// A rectangle from its boundaries `r1(u) = R(u,0)`, `r2(v) = R(0,v)`, `r3(u) = R(u,1)`, `r4(v) = R(1,v)`.
    ///
    /// # Errors
    /// [`Error::Conditions`] with every violation found; [`Error::Inflection`] when a curve has an inflection
    /// that its strip cannot pass.
    pub fn new(strips: [S; 4]) -> Result<Self, Error> {
        Self::with_tolerance(strips, CONDITION_TOLERANCE)
    }

    /// As [`Rectangle::new`] with a tolerance for the conditions. The geodesic curvature left at the boundary
    /// is of the order of a hundredth of the residual of C3 admitted.
    ///
    /// # Errors
    /// As [`Rectangle::new`].
    pub fn with_tolerance(strips: [S; 4], tolerance: f64) -> Result<Self, Error> {
        let report = check_rectangle(&strips, tolerance).admit(&strips)?;
        let ends =
            [0, 1, 2, 3].map(|side: usize| [strips[side].sample(0.0), strips[side].sample(1.0)]);
        let corners = CORNERS.map(|[i, j]| {
            let [u, v] = sides_at([i, j]);
            let (along_u, along_v) = (&ends[u][i], &ends[v][j]);
            let cross = along_u.point[1].cross(along_v.point[1]);
            let (normal, tangent) = (
                cross.normalize_or_zero(),
                along_u.point[1].normalize_or_zero(),
            );
            // Equal by the crossing identity, up to the tolerance: the mean shares what is left.
            let twist_normal = 0.5
                * (normal_twist(along_u, along_v.point[1], normal)
                    + normal_twist(along_v, along_u.point[1], normal));
            let angle = cross.length().atan2(along_u.point[1].dot(along_v.point[1]));
            CornerFrame {
                point: 0.5 * (along_u.point[0] + along_v.point[0]),
                tangents: [tangent, normal.cross(tangent)],
                normal,
                twist_normal,
                angle,
            }
        });
        Ok(Self {
            strips,
            ends,
            corners,
            report,
        })
    }

    /// The boundary strips.
    #[must_use]
    pub fn strips(&self) -> &[S; 4] {
        &self.strips
    }

    /// What the check of the conditions found: reversals, inflections, residuals.
    #[must_use]
    pub fn report(&self) -> &BoundaryReport {
        &self.report
    }

    /// The normal components of the corner twists, in the order 00, 10, 01, 11: the part that is not free.
    #[must_use]
    pub fn twist_normals(&self) -> [f64; 4] {
        self.corners.map(|corner| corner.twist_normal)
    }

    /// The interior angles at the corners 00, 10, 01, 11, radians. By Gauss and Bonnet every patch with these
    /// geodesic boundaries has the total curvature `sum - 2 pi`.
    #[must_use]
    pub fn interior_angles(&self) -> [f64; 4] {
        let mut angles = self.corners.map(|corner| corner.angle);
        // At 10 and 01 one of the tangents points out of the patch.
        for index in [1, 2] {
            angles[index] = core::f64::consts::PI - angles[index];
        }
        angles
    }

    /// The twist vector `R_uv` at a corner.
    fn twist(&self, corner: usize, [a, b]: [f64; 2]) -> DVec3 {
        let frame = &self.corners[corner];
        frame.tangents[0] * a + frame.tangents[1] * b + frame.normal * frame.twist_normal
    }

    /// The twists with which the component across each boundary is stationary at its ends. Between end values of one
    /// sign it is then monotone and vanishes nowhere: these twists give a regular boundary where any do.
    ///
    /// For strips of frames they are zero; for Bézier strips they compensate that `across` grows along the curve.
    #[must_use]
    pub fn regular_twists(&self) -> Twists {
        core::array::from_fn(|corner| {
            let [i, j] = CORNERS[corner];
            let [u, v] = sides_at([i, j]);
            let (along_u, along_v) = (&self.ends[u][i], &self.ends[v][j]);
            // The slope of `q` vanishes where `W . b = (p a' + q b') . b`: two equations for the tangential part.
            let demand = |sample: &StripSample, value: DVec3| {
                let [p, q] = components(sample, value);
                let direction = sample.across[0].normalize_or_zero();
                (
                    direction,
                    (sample.along[1] * p + sample.across[1] * q).dot(direction),
                )
            };
            let (b1, c1) = demand(along_u, along_v.point[1]);
            let (b2, c2) = demand(along_v, along_u.point[1]);
            let [e, h] = self.corners[corner].tangents;
            let matrix = DMat2::from_cols(
                DVec2::new(b1.dot(e), b2.dot(e)),
                DVec2::new(b1.dot(h), b2.dot(h)),
            );
            (matrix.inverse() * DVec2::new(c1, c2)).to_array()
        })
    }

    /// The patch with the given twists.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::IrregularBoundary`] when a transverse derivative becomes tangent to its
    /// boundary.
    pub fn patch(&self, twists: Twists) -> Result<CoonsPatch<S>, Error> {
        let patch = self.patch_unchecked(twists)?;
        patch.check_boundary()?;
        Ok(patch)
    }

    /// As [`Rectangle::patch`] without the check of the boundary.
    pub(crate) fn patch_unchecked(&self, twists: Twists) -> Result<CoonsPatch<S>, Error> {
        if let Some(index) = twists.iter().flatten().position(|w| !w.is_finite()) {
            return Err(Error::NonFinite {
                what: "twist component",
                index,
            });
        }
        let vectors: [DVec3; 4] = core::array::from_fn(|corner| self.twist(corner, twists[corner]));
        let mut fields = [TransverseField::default(); 4];
        let mut grid = [[DVec3::ZERO; 4]; 4];
        for (corner, [i, j]) in CORNERS.into_iter().enumerate() {
            let [u, v] = sides_at([i, j]);
            let (along_u, along_v) = (&self.ends[u][i], &self.ends[v][j]);
            fields[u].set_end(i, along_u, along_v.point[1], vectors[corner]);
            fields[v].set_end(j, along_v, along_u.point[1], vectors[corner]);
            let (value, slope) = (3 * i, 1 + i);
            let (value_v, slope_v) = (3 * j, 1 + j);
            grid[value][value_v] = self.corners[corner].point;
            grid[value][slope_v] = along_v.point[1];
            grid[slope][value_v] = along_u.point[1];
            grid[slope][slope_v] = vectors[corner];
        }
        Ok(CoonsPatch {
            rectangle: self.clone(),
            twists,
            fields,
            grid,
        })
    }

    /// The direction of a free parameter at its corner, and its corner.
    pub(crate) fn free_direction(&self, parameter: usize) -> (usize, DVec3) {
        (
            parameter / 2,
            self.corners[parameter / 2].tangents[parameter % 2],
        )
    }
}

/// The normal component of the derivative along a strip of a transverse field with value `transverse`.
pub(crate) fn normal_twist(sample: &StripSample, transverse: DVec3, normal: DVec3) -> f64 {
    let [p, q] = components(sample, transverse);
    p * sample.along[1].dot(normal) + q * sample.across[1].dot(normal)
}

/// Components of a tangent vector in the orthogonal basis of a strip.
pub(crate) fn components(sample: &StripSample, vector: DVec3) -> [f64; 2] {
    [sample.along[0], sample.across[0]].map(|basis| vector.dot(basis) / basis.length_squared())
}

/// The cubic components `p`, `q` of a transverse derivative `p along + q across`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TransverseField {
    pub(crate) along: HermiteCubic,
    pub(crate) across: HermiteCubic,
}

impl TransverseField {
    /// Makes the field have this value and derivative at the end 0 or 1, whose sample is given. The normal part of
    /// the derivative takes care of itself.
    pub(crate) fn set_end(
        &mut self,
        end: usize,
        sample: &StripSample,
        value: DVec3,
        derivative: DVec3,
    ) {
        let [p, q] = components(sample, value);
        let rest = derivative - sample.along[1] * p - sample.across[1] * q;
        let [p_slope, q_slope] = components(sample, rest);
        let (at, slope) = (3 * end, 1 + end);
        (self.along[at], self.across[at]) = (p, q);
        (self.along[slope], self.across[slope]) = (p_slope, q_slope);
    }

    /// The field and its two derivatives at a sample, given the Hermite functions there.
    pub(crate) fn at(&self, sample: &StripSample, functions: &[[f64; 4]; 3]) -> [DVec3; 3] {
        let (p, q) = (
            combine(&self.along, functions),
            combine(&self.across, functions),
        );
        let product = |c: [f64; 3], v: &[DVec3; 3]| {
            [
                v[0] * c[0],
                v[0] * c[1] + v[1] * c[0],
                v[0] * c[2] + v[1] * (2.0 * c[1]) + v[2] * c[0],
            ]
        };
        let (a, b) = (product(p, &sample.along), product(q, &sample.across));
        [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
    }
}

/// Where one pair of opposite boundaries stands at a parameter, with all its derivatives: the four functions that
/// the Hermite functions of the other parameter blend.
pub(crate) type Column = [[DVec3; 3]; 4];

/// Everything about one parameter value that does not depend on the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) functions: [[f64; 4]; 3],
    pub(crate) samples: [StripSample; 2],
    pub(crate) column: Column,
}

/// A Coons patch over the unit square with geodesic boundaries.
#[derive(Clone, Debug)]
pub struct CoonsPatch<S = GeodesicStrip> {
    rectangle: Rectangle<S>,
    twists: Twists,
    fields: [TransverseField; 4],
    grid: [[DVec3; 4]; 4],
}

impl<S: Strip> CoonsPatch<S> {
    /// The boundary.
    #[must_use]
    pub fn rectangle(&self) -> &Rectangle<S> {
        &self.rectangle
    }

    /// The free parameters it was made with.
    #[must_use]
    pub fn twists(&self) -> &Twists {
        &self.twists
    }

    pub(crate) fn fields(&self) -> &[TransverseField; 4] {
        &self.fields
    }

    pub(crate) fn grid(&self) -> &[[DVec3; 4]; 4] {
        &self.grid
    }

    /// The curves along `u` (`r1`, `T1`, `T3`, `r3`) at `u = t`, or those along `v` at `v = t`.
    pub(crate) fn line(&self, along_v: bool, t: f64) -> Line {
        let (low, high) = if along_v { (1, 3) } else { (0, 2) };
        let functions = hermite(t);
        let samples = [
            self.rectangle.strips[low].sample(t),
            self.rectangle.strips[high].sample(t),
        ];
        let point = |sample: &StripSample| [sample.point[0], sample.point[1], sample.point[2]];
        let column = [
            point(&samples[0]),
            self.fields[low].at(&samples[0], &functions),
            self.fields[high].at(&samples[1], &functions),
            point(&samples[1]),
        ];
        Line {
            functions,
            samples,
            column,
        }
    }

    /// The mixed derivative of orders `a` in `u` and `b` in `v`.
    pub(crate) fn derivative(&self, u: &Line, v: &Line, a: usize, b: usize) -> DVec3 {
        let (hu, hv) = (&u.functions[a], &v.functions[b]);
        (0..4)
            .map(|k| {
                let corner: DVec3 = (0..4).map(|l| self.grid[k][l] * hv[l]).sum();
                u.column[k][a] * hv[k] + (v.column[k][b] - corner) * hu[k]
            })
            .sum()
    }

    /// Refuses a patch that folds at a boundary: `R_u x R_v` there is `q` times a vector that never vanishes, so
    /// the cubic `q` must keep its sign. Patches made by [`Rectangle::patch`] have passed this.
    ///
    /// # Errors
    /// [`Error::IrregularBoundary`] with the side and the place.
    pub fn check_boundary(&self) -> Result<(), Error> {
        for (side, field) in self.fields.iter().enumerate() {
            let scale = field.across[0].abs().max(field.across[3].abs());
            let (least, t) = least_same_sign(field.across);
            if !(least > REGULAR * scale) {
                return Err(Error::IrregularBoundary {
                    side,
                    t,
                    across: least / scale,
                });
            }
        }
        Ok(())
    }

    /// The smallest `|R_u x R_v| / (|R_u| |R_v|)` over a grid of `(n + 1)²` parameters and where: zero at a
    /// singular point; negative where the normal is turned by more than a right angle against the nearest
    /// corner's, which a fold does.
    #[must_use]
    pub fn regularity(&self, n: usize) -> (f64, [f64; 2]) {
        let n = n.max(1);
        let parameter = |i: usize| i as f64 / n as f64;
        let lines: Vec<[Line; 2]> = (0..=n)
            .map(|i| {
                [
                    self.line(false, parameter(i)),
                    self.line(true, parameter(i)),
                ]
            })
            .collect();
        let mut worst = (f64::INFINITY, [0.0; 2]);
        for (i, [u, _]) in lines.iter().enumerate() {
            for (j, [_, v]) in lines.iter().enumerate() {
                let (du, dv) = (self.derivative(u, v, 1, 0), self.derivative(u, v, 0, 1));
                let cross = du.cross(dv);
                let corner = usize::from(2 * i > n) + 2 * usize::from(2 * j > n);
                let sine = cross.length() / (du.length() * dv.length());
                let signed = sine.copysign(cross.dot(self.rectangle.corners[corner].normal));
                if !(signed >= worst.0) {
                    worst = (signed, [parameter(i), parameter(j)]);
                }
            }
        }
        worst
    }
}

/// The part of its corner values below which the component across a boundary counts as vanishing.
const REGULAR: f64 = 1e-9;

impl<S: Strip> Surface for CoonsPatch<S> {
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
        let (u, v) = (self.line(false, u), self.line(true, v));
        let at = |a, b| self.derivative(&u, &v, a, b);
        Partials {
            position: at(0, 0),
            du: at(1, 0),
            dv: at(0, 1),
            duu: at(2, 0),
            duv: at(1, 1),
            dvv: at(0, 2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AnalyticCurve;

    /// The tolerance is that of the boundary's size, wherever it lies.
    #[test]
    fn a_gap_far_from_the_origin_is_a_gap() {
        let corners = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.25, 1.15]];
        let far = 1e9;
        let side = |a: usize, b: usize, gap: f64| {
            GeodesicStrip::new(AnalyticCurve::new(move |t| {
                let [angle, height] =
                    [0, 1].map(|k| t * (corners[b][k] - corners[a][k]) + corners[a][k]);
                [angle.cos() + far, angle.sin() + far, height + (far + gap)]
            }))
            .unwrap()
        };
        let with_gap = |gap: f64| {
            Rectangle::new([
                side(0, 1, 0.0),
                side(0, 2, 0.0),
                side(2, 3, gap),
                side(1, 3, 0.0),
            ])
        };
        assert!(with_gap(0.0).is_ok());
        for gap in [5.0, 1e-4] {
            assert!(matches!(with_gap(gap), Err(Error::Conditions(_))), "{gap}");
        }
    }
}
