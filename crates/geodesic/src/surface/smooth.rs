//! Parametric surfaces with two derivatives: what their geodesics are computed from.

use bezier_mass::{BSplineSurface, BezierPatch, PatchJet};
use glam::{DMat2, DVec2, DVec3};

/// A point of a surface with its derivatives to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceJet {
    /// The point.
    pub point: DVec3,
    /// First derivatives, in u and v.
    pub first: [DVec3; 2],
    /// Second derivatives: uu, uv, vv.
    pub second: [DVec3; 3],
}

impl SurfaceJet {
    /// The tangent vector in space of a direction in the parameter plane.
    #[must_use]
    pub fn tangent(&self, direction: DVec2) -> DVec3 {
        direction.x * self.first[0] + direction.y * self.first[1]
    }

    /// The unit normal along `R_u x R_v`; not finite where there is no tangent plane.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.first[0].cross(self.first[1]).normalize()
    }

    /// The Gaussian curvature; not finite where there is no tangent plane.
    #[must_use]
    pub fn gaussian_curvature(&self) -> f64 {
        let normal = self.normal();
        let [uu, uv, vv] = self.second.map(|second| second.dot(normal));
        (uu * vv - uv * uv) / self.first_form().determinant()
    }

    /// The first fundamental form.
    pub(crate) fn first_form(&self) -> DMat2 {
        let [u, v] = self.first;
        let mixed = u.dot(v);
        DMat2::from_cols(DVec2::new(u.dot(u), mixed), DVec2::new(mixed, v.dot(v)))
    }

    /// The Christoffel symbols applied to two directions, `Γ(a, b)`: minus the rate at which the components of `b`
    /// change when it is carried along `a` without turning.
    pub(crate) fn connection(&self, a: DVec2, b: DVec2) -> DVec2 {
        let [uu, uv, vv] = self.second;
        let bend = a.x * b.x * uu + (a.x * b.y + a.y * b.x) * uv + a.y * b.y * vv;
        self.first_form().inverse() * DVec2::new(bend.dot(self.first[0]), bend.dot(self.first[1]))
    }

    /// A direction scaled to unit length on the surface.
    pub(crate) fn unit(&self, direction: DVec2) -> DVec2 {
        direction / self.tangent(direction).length()
    }

    /// The unit direction a quarter turn to the left of a unit direction, seen from the side of the normal.
    pub(crate) fn left_of(&self, direction: DVec2) -> DVec2 {
        let form = self.first_form();
        (form * direction).perp() / form.determinant().sqrt()
    }
}

/// A parametric surface that can be differentiated twice.
///
/// Closures `Fn(DVec2) -> SurfaceJet` are surfaces too.
pub trait SmoothSurface {
    /// The jet at `(u, v)`. Outside the domain it may be that of an extension, or not finite.
    fn jet(&self, uv: DVec2) -> SurfaceJet;

    /// Whether `(u, v)` belongs to the surface rather than to an extension of it.
    fn contains(&self, uv: DVec2) -> bool {
        uv.is_finite()
    }
}

impl<F: Fn(DVec2) -> SurfaceJet> SmoothSurface for F {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        self(uv)
    }
}

/// The unit square is the domain; outside it the same polynomials go on.
impl SmoothSurface for BezierPatch<DVec3> {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        in_space(&Self::jet(self, uv.x, uv.y))
    }

    fn contains(&self, uv: DVec2) -> bool {
        uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all()
    }
}

/// Outside the domain of clamped knots the polynomials of the last span go on; periodic knots have no outside.
impl SmoothSurface for BSplineSurface<DVec3> {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        in_space(&Self::jet(self, uv.x, uv.y))
    }

    fn contains(&self, uv: DVec2) -> bool {
        let within = |axis: usize, t: f64| {
            let knots = &self.knots()[axis];
            let [start, end] = knots.domain();
            knots.is_periodic() || (start..=end).contains(&t)
        };
        uv.is_finite() && within(0, uv.x) && within(1, uv.y)
    }
}

/// Derivatives of mass points as derivatives in space; not finite where the weight vanishes.
fn in_space(jet: &PatchJet<DVec3>) -> SurfaceJet {
    match jet.partials() {
        Some(partials) => SurfaceJet {
            point: partials.position,
            first: [partials.du, partials.dv],
            second: [partials.duu, partials.duv, partials.dvv],
        },
        None => SurfaceJet {
            point: DVec3::NAN,
            first: [DVec3::NAN; 2],
            second: [DVec3::NAN; 3],
        },
    }
}

/// The torus with `u` about the axis and `v` around the tube, 0 outermost.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TorusSurface {
    /// Radius of the circle of the tube's centres.
    pub major: f64,
    /// Radius of the tube.
    pub minor: f64,
}

impl TorusSurface {
    /// Clairaut's constant `ρ cos ψ` of a direction: the distance from the axis times the cosine of the angle to the
    /// parallel. It does not change along a geodesic.
    #[must_use]
    pub fn clairaut(&self, uv: DVec2, direction: DVec2) -> f64 {
        let distance = self.major + self.minor * uv.y.cos();
        let along = DVec2::new(distance * direction.x, self.minor * direction.y);
        distance * along.x / along.length()
    }
}

impl SmoothSurface for TorusSurface {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        let ((su, cu), (sv, cv)) = (uv.x.sin_cos(), uv.y.sin_cos());
        let distance = self.major + self.minor * cv;
        let (out, along) = (DVec3::new(cu, su, 0.0), DVec3::new(-su, cu, 0.0));
        let turn = self.minor * DVec3::new(-sv * cu, -sv * su, cv);
        SurfaceJet {
            point: distance * out + self.minor * sv * DVec3::Z,
            first: [distance * along, turn],
            second: [
                -distance * out,
                -self.minor * sv * along,
                -self.minor * DVec3::new(cv * cu, cv * su, sv),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TORUS: TorusSurface = TorusSurface {
        major: 2.0,
        minor: 0.7,
    };

    #[test]
    fn the_curvature_of_a_torus() {
        for v in [0.0, 0.9, 2.0, 3.1] {
            let jet = TORUS.jet(DVec2::new(0.4, v));
            let expected = v.cos() / (0.7 * (2.0 + 0.7 * v.cos()));
            assert!((jet.gaussian_curvature() - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn left_is_a_quarter_turn() {
        let jet = TORUS.jet(DVec2::new(0.4, 1.1));
        let ahead = jet.unit(DVec2::new(0.3, -2.0));
        let left = jet.tangent(jet.left_of(ahead));
        let ahead = jet.tangent(ahead);
        assert!((ahead.length() - 1.0).abs() < 1e-14);
        assert!((ahead.cross(left) - jet.normal()).length() < 1e-14);
    }
}
