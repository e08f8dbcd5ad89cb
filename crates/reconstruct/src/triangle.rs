//! The triangular patch whose three boundaries are geodesics.
//!
//! Section 3.6 of the thesis chapter ("Geodesic interpolation of a curvilinear triangle") and R. T. Farouki,
//! N. Szafran, L. Biard, *Construction and smoothing of triangular Coons patches with geodesic boundary curves*,
//! CAGD 27, 2010. The thesis names J. A. Gregory's cubically blended scheme only; the form here is a convex
//! combination `R = sum a_i P_i` of three interpolants, each of which has the two sides at a vertex with their
//! transverse derivatives, with weights `a_i = l_i² (3 - 2 l_i + 6 l_j l_k)` that add up to one and have a double
//! zero on the opposite side.

use crate::conditions::{
    BoundaryReport, CONDITION_TOLERANCE, Corner, CornerCurve, CornerCurves, check,
};
use crate::coons::{TransverseField, normal_twist};
use crate::hermite::least_same_sign;
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::{Error, TrianglePatch};
use core::array::from_fn;
use glam::DVec3;

/// The tangential parts of the twists at the three vertices: the mixed derivative by the barycentric coordinates of
/// the two other vertices, components along `e` and `N x e`, `e` the unit tangent of the side that leaves the vertex
/// for the next one. In units of length.
pub type TriangleTwists = [[f64; 2]; 3];

/// Checks the conditions C1 to C3 for three strips; side `k` runs from vertex `k + 1` to vertex `k + 2` (modulo 3).
pub fn check_triangle<S: Strip>(strips: &[S; 3], tolerance: f64) -> BoundaryReport {
    let corners: [CornerCurves; 3] = from_fn(|i| CornerCurves {
        corner: Corner::Triangle(i),
        first: CornerCurve {
            side: (i + 2) % 3,
            t: 0.0,
            outward: 1.0,
        },
        second: CornerCurve {
            side: (i + 1) % 3,
            t: 1.0,
            outward: -1.0,
        },
    });
    check(
        strips,
        &corners,
        &[(2, false), (0, false), (1, false)],
        tolerance,
    )
}

/// What a vertex fixes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) point: DVec3,
    /// Derivatives along the two sides, away from the vertex, towards the next and the previous one.
    pub(crate) sides: [DVec3; 2],
    /// `e` and `N x e`.
    pub(crate) tangents: [DVec3; 2],
    pub(crate) normal: DVec3,
    twist_normal: f64,
    angle: f64,
}

/// Three strips that satisfy the conditions, ready to be filled.
#[derive(Clone, Debug)]
pub struct Triangle<S = GeodesicStrip> {
    pub(crate) strips: [S; 3],
    pub(crate) ends: [[StripSample; 2]; 3],
    pub(crate) vertices: [Vertex; 3],
    report: BoundaryReport,
}

/// The part of its corner values below which the component across a side counts as vanishing.
const REGULAR: f64 = 1e-9;

impl<S: Strip> Triangle<S> {
    /// A triangle from its sides; side `k` lies opposite vertex `k` and runs from vertex `k + 1` to vertex `k + 2`.
    ///
    /// # Errors
    /// [`Error::Conditions`] with every violation found; [`Error::Inflection`] when a curve has an inflection that
    /// its strip cannot pass.
    pub fn new(strips: [S; 3]) -> Result<Self, Error> {
        Self::with_tolerance(strips, CONDITION_TOLERANCE)
    }

    /// As [`Triangle::new`] with a tolerance for the conditions.
    ///
    /// # Errors
    /// As [`Triangle::new`].
    pub fn with_tolerance(strips: [S; 3], tolerance: f64) -> Result<Self, Error> {
        let report = check_triangle(&strips, tolerance).admit(&strips)?;
        let ends: [[StripSample; 2]; 3] =
            from_fn(|k| [strips[k].sample(0.0), strips[k].sample(1.0)]);
        let vertices = from_fn(|i| {
            let (leaving, arriving) = (&ends[(i + 2) % 3][0], &ends[(i + 1) % 3][1]);
            let (to_next, to_previous) = (leaving.point[1], -arriving.point[1]);
            let cross = to_next.cross(to_previous);
            let (normal, tangent) = (cross.normalize_or_zero(), to_next.normalize_or_zero());
            // The twist is the derivative of the transverse field on either side; seen from the arriving one the
            // field is `B' + d_next` and the twist `B''` less its derivative.
            let from_leaving = normal_twist(leaving, to_previous, normal);
            let field = arriving.point[1] + to_next;
            let from_arriving =
                arriving.point[2].dot(normal) - normal_twist(arriving, field, normal);
            Vertex {
                point: 0.5 * (leaving.point[0] + arriving.point[0]),
                sides: [to_next, to_previous],
                tangents: [tangent, normal.cross(tangent)],
                normal,
                twist_normal: 0.5 * (from_leaving + from_arriving),
                angle: cross.length().atan2(to_next.dot(to_previous)),
            }
        });
        Ok(Self {
            strips,
            ends,
            vertices,
            report,
        })
    }

    /// The boundary strips.
    #[must_use]
    pub fn strips(&self) -> &[S; 3] {
        &self.strips
    }

    /// What the check of the conditions found.
    #[must_use]
    pub fn report(&self) -> &BoundaryReport {
        &self.report
    }

    /// The normal components of the twists at the vertices: the part that is not free.
    #[must_use]
    pub fn twist_normals(&self) -> [f64; 3] {
        self.vertices.map(|vertex| vertex.twist_normal)
    }

    /// The interior angles at the vertices, radians.
    #[must_use]
    pub fn interior_angles(&self) -> [f64; 3] {
        self.vertices.map(|vertex| vertex.angle)
    }

    /// The integral of the Gaussian curvature over every surface with these geodesic boundaries, by Gauss and
    /// Bonnet: the sum of the interior angles less `pi`. (Equation (3.9) of the thesis holds with exterior angles.)
    #[must_use]
    pub fn total_curvature(&self) -> f64 {
        self.interior_angles().iter().sum::<f64>() - core::f64::consts::PI
    }

    /// The patch with the given twists.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::IrregularBoundary`] when a transverse derivative becomes tangent to its side.
    pub fn patch(&self, twists: TriangleTwists) -> Result<TrianglePatch<S>, Error> {
        if let Some(index) = twists.iter().flatten().position(|w| !w.is_finite()) {
            return Err(Error::NonFinite {
                what: "twist component",
                index,
            });
        }
        let vectors: [DVec3; 3] = from_fn(|i| {
            let Vertex {
                tangents,
                normal,
                twist_normal,
                ..
            } = &self.vertices[i];
            tangents[0] * twists[i][0] + tangents[1] * twists[i][1] + *normal * *twist_normal
        });
        let fields: [TransverseField; 3] = from_fn(|k| {
            let (start, end) = ((k + 1) % 3, (k + 2) % 3);
            let [first, last] = &self.ends[k];
            let mut field = TransverseField::default();
            field.set_end(0, first, self.vertices[start].sides[1], vectors[start]);
            field.set_end(
                1,
                last,
                last.point[1] + self.vertices[end].sides[0],
                last.point[2] - vectors[end],
            );
            field
        });
        for (side, field) in fields.iter().enumerate() {
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
        Ok(TrianglePatch {
            triangle: self.clone(),
            twists,
            vectors,
            fields,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnalyticCurve, Series, Surface};
    use glam::DVec2;

    fn great_circles() -> Triangle {
        ball(1.0)
    }

    fn ball(radius: f64) -> Triangle {
        let corners = [
            DVec3::new(1.0, 0.0, 0.1),
            DVec3::new(0.2, 0.9, 0.0),
            DVec3::new(0.3, 0.2, 0.9),
        ]
        .map(DVec3::normalize);
        let arc = |a: DVec3, b: DVec3| {
            let across = (b - a * a.dot(b)).normalize();
            let angle = a.angle_between(b);
            GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
                let (sin, cos) = (t * angle).sin_cos();
                from_fn(|k| (cos * a[k] + sin * across[k]) * radius)
            }))
            .unwrap()
        };
        Triangle::new([
            arc(corners[1], corners[2]),
            arc(corners[2], corners[0]),
            arc(corners[0], corners[1]),
        ])
        .unwrap()
    }

    #[test]
    fn derivatives_boundaries_and_total_curvature() {
        let triangle = great_circles();
        let patch = triangle
            .patch([[0.143, -0.06], [0.109, 0.209], [-0.041, -0.163]])
            .unwrap();
        let (u, v, h) = (0.3, 0.25, 1e-5);
        let at = patch.partials(u, v);
        let difference = |du: f64, dv: f64| {
            (
                patch.partials(u + du, v + dv),
                patch.partials(u - du, v - dv),
            )
        };
        let (east, west) = difference(h, 0.0);
        let (north, south) = difference(0.0, h);
        assert!(((east.position - west.position) / (2.0 * h) - at.du).length() < 1e-9);
        assert!(((north.du - south.du) / (2.0 * h) - at.duv).length() < 1e-8);
        assert!(((east.du - west.du) / (2.0 * h) - at.duu).length() < 1e-8);
        assert!(((north.dv - south.dv) / (2.0 * h) - at.dvv).length() < 1e-8);
        assert!(patch.boundary_geodesic_curvature(32) < 1e-12);
        for i in 0..=8 {
            let t = f64::from(i) / 8.0;
            let side = triangle.strips()[1].series(t).value();
            assert!((patch.at([t, 0.0, 1.0 - t]) - side).length() < 1e-14);
        }
        assert!((patch.integrated_curvature(16) - triangle.total_curvature()).abs() < 1e-9);
    }

    /// The values of the specification: energy 1.7928 at zero, 1.3937 at the minimum, 2.9e-3 from the sphere.
    #[test]
    fn smoothing_brings_the_patch_near_the_sphere() {
        let triangle = great_circles();
        let domain = [DVec2::ZERO, DVec2::new(2.0, 0.3), DVec2::new(0.4, 1.5)];
        let smoothed = triangle.smoothest(domain).unwrap();
        assert!(
            (smoothed.energy_at_zero - 1.7928).abs() < 1e-4
                && (smoothed.energy - 1.3937).abs() < 1e-4
        );
        assert!(
            (smoothed.patch.thin_plate_energy(domain).unwrap() - smoothed.energy).abs() < 1e-12
        );
        let away = |patch: &TrianglePatch| {
            let nodes = (0..=20).flat_map(|i| {
                (0..=20 - i).map(move |j| [f64::from(i) / 20.0, f64::from(j) / 20.0])
            });
            nodes
                .map(|[u, v]| (patch.point(u, v).length() - 1.0).abs())
                .fold(0.0, f64::max)
        };
        let before = away(&triangle.patch([[0.0; 2]; 3]).unwrap());
        let after = away(&smoothed.patch);
        assert!(after < 3e-3 && before > 2e-2, "{before} {after}");
        assert!(matches!(
            triangle.smoothest([DVec2::ZERO; 3]),
            Err(Error::OutOfRange { .. })
        ));
    }

    #[test]
    fn smoothing_does_not_depend_on_the_unit_of_length() {
        let domain = [DVec2::ZERO, DVec2::new(2.0, 0.3), DVec2::new(0.4, 1.5)];
        let unit = ball(1.0).smoothest(domain).unwrap();
        for radius in [1e-30, 1e12, 1e30] {
            let large = ball(radius).smoothest(domain).unwrap();
            assert!((large.energy / (radius * radius) - unit.energy).abs() < 1e-12);
            let (a, b) = (large.patch.point(0.3, 0.3), unit.patch.point(0.3, 0.3));
            assert!((a / radius - b).length() < 1e-13, "{radius}");
        }
    }
}
