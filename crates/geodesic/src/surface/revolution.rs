//! Surfaces of revolution, on whose geodesics Clairaut's constant checks every computation.

use glam::{DVec2, DVec3};

use super::smooth::{SmoothSurface, SurfaceJet};

/// A profile in the half-plane `(ρ, z)` with its first and second derivative, turned about the z axis: `u` is the angle, `v`
/// the profile's parameter.
///
/// ```
/// use geodesic::{SurfaceOfRevolution, SurfaceRay, glam::DVec2, trace_smooth};
/// // The catenoid.
/// let surface = SurfaceOfRevolution::new(|v: f64| {
///     [DVec2::new(v.cosh(), v), DVec2::new(v.sinh(), 1.0), DVec2::new(v.cosh(), 0.0)]
/// });
/// let start = SurfaceRay { uv: DVec2::new(0.0, -1.5), direction: DVec2::new(0.3, 1.0) };
/// let end = trace_smooth(&surface, start, 4.0, 1e-12)?;
/// let drift = surface.clairaut(end.uv, end.direction) - surface.clairaut(start.uv, start.direction);
/// assert!(drift.abs() < 1e-9);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SurfaceOfRevolution<F> {
    profile: F,
}

impl<F: Fn(f64) -> [DVec2; 3]> SurfaceOfRevolution<F> {
    /// The surface of a profile: position `(ρ, z)`, first and second derivative at a parameter.
    pub fn new(profile: F) -> Self {
        Self { profile }
    }

    /// Clairaut's constant `ρ cos ψ` of a direction: the distance from the axis times the cosine of the angle to the
    /// parallel. It does not change along a geodesic.
    #[must_use]
    pub fn clairaut(&self, uv: DVec2, direction: DVec2) -> f64 {
        let jet = self.jet(uv);
        let tangent = jet.tangent(direction);
        jet.first[0].dot(tangent) / tangent.length()
    }
}

impl<F: Fn(f64) -> [DVec2; 3]> SmoothSurface for SurfaceOfRevolution<F> {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        let [point, first, second] = (self.profile)(uv.y);
        let (sine, cosine) = uv.x.sin_cos();
        let (out, along) = (
            DVec3::new(cosine, sine, 0.0),
            DVec3::new(-sine, cosine, 0.0),
        );
        let turned = |p: DVec2| p.x * out + p.y * DVec3::Z;
        SurfaceJet {
            point: turned(point),
            first: [point.x * along, turned(first)],
            second: [-point.x * out, first.x * along, turned(second)],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{TorusSurface, geodesic_between};

    #[test]
    fn a_torus_is_one() {
        let torus = TorusSurface {
            major: 2.0,
            minor: 0.7,
        };
        let turned = SurfaceOfRevolution::new(|v: f64| {
            let (sine, cosine) = v.sin_cos();
            [
                DVec2::new(2.0 + 0.7 * cosine, 0.7 * sine),
                DVec2::new(-0.7 * sine, 0.7 * cosine),
                DVec2::new(-0.7 * cosine, -0.7 * sine),
            ]
        });
        let uv = DVec2::new(0.4, 1.9);
        let (a, b) = (torus.jet(uv), turned.jet(uv));
        assert!(a.point.distance(b.point) < 1e-15);
        let differences = [
            (a.first[0], b.first[0]),
            (a.first[1], b.first[1]),
            (a.second[0], b.second[0]),
            (a.second[1], b.second[1]),
            (a.second[2], b.second[2]),
        ];
        assert!(differences.iter().all(|(a, b)| a.distance(*b) < 1e-15));
        let direction = DVec2::new(0.3, -1.0);
        assert!((torus.clairaut(uv, direction) - turned.clairaut(uv, direction)).abs() < 1e-15);
    }

    /// On a cone laid flat geodesics are straight: the chord by the law of cosines.
    #[test]
    fn geodesics_of_a_cone_are_chords() {
        let cone = SurfaceOfRevolution::new(|v: f64| {
            [
                DVec2::new(0.6 * v, 0.8 * v),
                DVec2::new(0.6, 0.8),
                DVec2::ZERO,
            ]
        });
        let (from, to) = (DVec2::new(0.2, 1.0), DVec2::new(2.9, 1.7));
        let geodesic = geodesic_between(&cone, &[from, to], 1e-11).unwrap();
        let angle = 0.6 * (to.x - from.x);
        let chord = (from.y * from.y + to.y * to.y - 2.0 * from.y * to.y * f64::cos(angle)).sqrt();
        assert!((geodesic.length - chord).abs() < 1e-10);
        let constants = geodesic
            .nodes
            .iter()
            .map(|node| cone.clairaut(node.uv, node.direction));
        let (low, high) = constants.fold((f64::INFINITY, 0.0), |(a, b), c| (c.min(a), c.max(b)));
        assert!(low > 0.1 && high - low < 1e-10);
    }
}
