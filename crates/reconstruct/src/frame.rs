//! Frenet and Darboux frames, and what makes a curve a geodesic.
//!
//! Section 3.3 of the thesis chapter, equations (3.1) to (3.6).

use crate::{Curve, Error, VectorSeries};
use bezier_mass::Partials;
use glam::DVec3;

/// The Frenet frame of a space curve at a point: `e' = k n`, `n' = -k e + tau b`, `b' = -tau n` by arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrenetFrame {
    /// The point.
    pub point: DVec3,
    /// Unit tangent `e`.
    pub tangent: DVec3,
    /// Principal normal `n`.
    pub normal: DVec3,
    /// Binormal `b = e x n`.
    pub binormal: DVec3,
    /// Curvature `k`, positive, one over length.
    pub curvature: f64,
    /// Torsion `tau = det(r', r'', r''') / |r' x r''|²`, one over length, in any parameter.
    pub torsion: f64,
    /// Speed `|r'|` of the parametrisation.
    pub speed: f64,
}

/// A curvature below this times rounding of the derivatives is an inflection.
const INFLECTION: f64 = 1e-12;

impl FrenetFrame {
    /// The frame of `curve` at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroVector`] where the velocity vanishes; [`Error::Inflection`] where
    /// the curvature does and the normal is undefined.
    pub fn at(curve: &(impl Curve + ?Sized), t: f64) -> Result<Self, Error> {
        Self::of(&curve.series(t), t)
    }

    /// The frame of a Taylor series, `t` its parameter for the error's sake.
    ///
    /// # Errors
    /// As [`FrenetFrame::at`].
    pub fn of(series: &VectorSeries, t: f64) -> Result<Self, Error> {
        if !series.is_finite() {
            return Err(Error::NonFinite {
                what: "derivative of the curve",
                index: 0,
            });
        }
        let [velocity, acceleration, third] = [1, 2, 3].map(|k| series.derivative_at(k));
        let speed = velocity.length();
        let tangent = velocity.try_normalize().ok_or(Error::ZeroVector {
            what: "velocity",
            index: 0,
        })?;
        let cross = velocity.cross(acceleration);
        if cross.length() <= INFLECTION * speed * (speed + acceleration.length()) {
            return Err(Error::Inflection { side: 0, t });
        }
        let binormal = cross.normalize();
        Ok(Self {
            point: series.value(),
            tangent,
            normal: binormal.cross(tangent),
            binormal,
            curvature: cross.length() / speed.powi(3),
            torsion: cross.dot(third) / cross.length_squared(),
            speed,
        })
    }
}

/// The Darboux frame of a curve on a surface at a point, with `h = N x e`:
/// `e' = k_g h + k_n N`, `h' = -k_g e - tau_g N`, `N' = -k_n e + tau_g h` by arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DarbouxFrame {
    /// The point.
    pub point: DVec3,
    /// Unit tangent `e` of the curve.
    pub tangent: DVec3,
    /// Conormal `h = N x e`.
    pub conormal: DVec3,
    /// Unit normal `N` of the surface, along `R_u x R_v`.
    pub normal: DVec3,
    /// Normal curvature `k_n`, one over length.
    pub normal_curvature: f64,
    /// Geodesic curvature `k_g`, one over length; zero on a geodesic.
    pub geodesic_curvature: f64,
    /// Geodesic torsion `tau_g = N' . h`, one over length; minus the torsion on a geodesic.
    pub geodesic_torsion: f64,
}

impl DarbouxFrame {
    /// The frame at a point of the surface with these derivatives, of the curve whose parameters move with
    /// the velocity `[u', v']` and the acceleration `[u'', v'']`.
    ///
    /// # Errors
    /// [`Error::ZeroVector`] where the surface has no normal (index 0) or the curve no velocity (index 1).
    pub fn on_surface(
        at: &Partials<DVec3>,
        [du, dv]: [f64; 2],
        [ddu, ddv]: [f64; 2],
    ) -> Result<Self, Error> {
        let velocity = at.du * du + at.dv * dv;
        let acceleration = at.duu * (du * du)
            + at.duv * (2.0 * du * dv)
            + at.dvv * (dv * dv)
            + at.du * ddu
            + at.dv * ddv;
        let cross = at.du.cross(at.dv);
        let normal = cross.try_normalize().ok_or(Error::ZeroVector {
            what: "surface normal",
            index: 0,
        })?;
        let tangent = velocity.try_normalize().ok_or(Error::ZeroVector {
            what: "velocity",
            index: 1,
        })?;
        let speed = velocity.length();
        let conormal = normal.cross(tangent);
        let cross_rate =
            (at.duu * du + at.duv * dv).cross(at.dv) + at.du.cross(at.duv * du + at.dvv * dv);
        Ok(Self {
            point: at.position,
            tangent,
            conormal,
            normal,
            normal_curvature: acceleration.dot(normal) / (speed * speed),
            geodesic_curvature: acceleration.dot(conormal) / (speed * speed),
            geodesic_torsion: cross_rate.dot(conormal) / (cross.length() * speed),
        })
    }
}

/// How far a curve is from being a geodesic, by the three characterisations of Section 3.3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeodesicCheck {
    /// (D1) The geodesic curvature, one over length.
    pub geodesic_curvature: f64,
    /// (D2) The sine of the angle between the principal normal and the surface normal.
    pub normal_sine: f64,
    /// (D3) The cosine of the angle between the osculating plane and the tangent plane.
    pub osculating_cosine: f64,
}

impl GeodesicCheck {
    /// Measures a Frenet frame against a surface normal of any length. All three vanish on a geodesic, and
    /// `k_g = k` times the second up to sign.
    #[must_use]
    pub fn new(frame: &FrenetFrame, surface_normal: DVec3) -> Self {
        let normal = surface_normal.normalize_or_zero();
        Self {
            geodesic_curvature: (frame.normal * frame.curvature).dot(normal.cross(frame.tangent)),
            normal_sine: frame.normal.cross(normal).length(),
            osculating_cosine: frame.binormal.dot(normal).abs(),
        }
    }
}

/// The geodesic crossing identity (3.7) at a point where two geodesics of a surface cross:
/// `(tau1 + tau2) sin A - (sigma2 k2 - sigma1 k1) cos A`, `A` the angle from the first to the second about
/// `normal`, `sigma = +1` where the principal normal agrees with `normal`, `-1` where it is opposite.
/// Zero on every surface of class C²; not scaled, one over length.
#[must_use]
pub fn crossing_residual(normal: DVec3, first: &FrenetFrame, second: &FrenetFrame) -> f64 {
    let signed = |frame: &FrenetFrame| frame.curvature * 1f64.copysign(frame.normal.dot(normal));
    let sine = first
        .tangent
        .cross(second.tangent)
        .dot(normal.normalize_or_zero());
    let cosine = first.tangent.dot(second.tangent);
    (first.torsion + second.torsion) * sine - (signed(second) - signed(first)) * cosine
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AnalyticCurve;

    /// The torus `R = 2, r = 0.7` by its two angles.
    fn torus(u: f64, v: f64) -> Partials<DVec3> {
        let (rho, z) = (2.0 + 0.7 * v.cos(), 0.7 * v.sin());
        let (c, s) = (
            DVec3::new(u.cos(), u.sin(), 0.0),
            DVec3::new(-u.sin(), u.cos(), 0.0),
        );
        let (rho1, z1) = (-0.7 * v.sin(), 0.7 * v.cos());
        Partials {
            position: c * rho + DVec3::Z * z,
            du: s * rho,
            dv: c * rho1 + DVec3::Z * z1,
            duu: -c * rho,
            duv: s * rho1,
            dvv: -c * (0.7 * v.cos()) - DVec3::Z * (0.7 * v.sin()),
        }
    }

    #[test]
    fn parallels_and_meridians_of_a_torus() {
        // The parallel at tube angle v has geodesic curvature sin v / rho up to sign and no geodesic torsion.
        let v = 0.8f64;
        let parallel = DarbouxFrame::on_surface(&torus(0.4, v), [1.0, 0.0], [0.0, 0.0]).unwrap();
        assert!(
            (parallel.geodesic_curvature.abs() - v.sin() / (2.0 + 0.7 * v.cos())).abs() < 1e-15
        );
        assert!(parallel.geodesic_torsion.abs() < 1e-15);
        let meridian = DarbouxFrame::on_surface(&torus(0.4, v), [0.0, 1.0], [0.0, 0.0]).unwrap();
        assert!(meridian.geodesic_curvature.abs() < 1e-15);
        assert!((meridian.normal_curvature.abs() - 1.0 / 0.7).abs() < 1e-14);
        assert!(DarbouxFrame::on_surface(&torus(0.4, v), [0.0, 0.0], [0.0, 0.0]).is_err());
    }

    /// A helix is a geodesic of its cylinder: D1, D2 and D3 vanish, and `tau_g = -tau`.
    #[test]
    fn the_three_characterisations_and_the_sign_of_the_torsion() {
        let helix = AnalyticCurve::new(|t| [t.cos(), t.sin(), t * 0.4]);
        let frame = FrenetFrame::at(&helix, 0.9).unwrap();
        assert!(
            (frame.curvature - 1.0 / 1.16).abs() < 1e-15
                && (frame.torsion - 0.4 / 1.16).abs() < 1e-15
        );
        let (c, s) = (0.9f64.cos(), 0.9f64.sin());
        let cylinder = Partials {
            position: DVec3::new(c, s, 0.36),
            du: DVec3::new(-s, c, 0.0),
            dv: DVec3::Z,
            duu: DVec3::new(-c, -s, 0.0),
            duv: DVec3::ZERO,
            dvv: DVec3::ZERO,
        };
        let darboux = DarbouxFrame::on_surface(&cylinder, [1.0, 0.4], [0.0, 0.0]).unwrap();
        assert!((darboux.geodesic_torsion + frame.torsion).abs() < 1e-15);
        assert!((darboux.normal_curvature.abs() - frame.curvature).abs() < 1e-15);
        let check = GeodesicCheck::new(&frame, darboux.normal);
        assert!(check.geodesic_curvature.abs() < 1e-15);
        assert!(check.normal_sine < 1e-15 && check.osculating_cosine < 1e-15);
        // A normal tilted about the tangent by 0.1 makes the curve bend on the surface.
        let tilted = darboux.normal * 0.1f64.cos() + darboux.conormal * 0.1f64.sin();
        let check = GeodesicCheck::new(&frame, tilted);
        assert!((check.normal_sine - 0.1f64.sin()).abs() < 1e-15);
        assert!(
            (check.geodesic_curvature.abs() - frame.curvature * check.normal_sine).abs() < 1e-15
        );
    }

    /// Proposition 3: of two surfaces in G1 contact along a curve, the curve has the same geodesic curvature
    /// on both; here a geodesic of the unit sphere and the cylinder that touches it along the equator.
    #[test]
    fn proposition_3() {
        for t in [0.0, 0.7, 2.0f64] {
            let (c, s) = (t.cos(), t.sin());
            let equator = [
                DVec3::new(c, s, 0.0),
                DVec3::new(-s, c, 0.0),
                DVec3::new(-c, -s, 0.0),
            ];
            let [position, du, duu] = equator;
            let sphere = Partials {
                position,
                du,
                dv: DVec3::Z,
                duu,
                duv: DVec3::ZERO,
                dvv: -position,
            };
            let cylinder = Partials {
                dvv: DVec3::ZERO,
                ..sphere
            };
            for surface in [sphere, cylinder] {
                let frame = DarbouxFrame::on_surface(&surface, [1.0, 0.0], [0.0, 0.0]).unwrap();
                assert!(frame.geodesic_curvature.abs() < 1e-15);
            }
        }
    }

    #[test]
    fn inflections_and_cusps_have_no_frame() {
        let wave = AnalyticCurve::new(|t| [t, t * t * t, t * 0.0]);
        assert!(matches!(
            FrenetFrame::at(&wave, 0.0),
            Err(Error::Inflection { .. })
        ));
        let cusp = AnalyticCurve::new(|t| [t * t, t * t * t, t * 0.0]);
        assert!(matches!(
            FrenetFrame::at(&cusp, 0.0),
            Err(Error::ZeroVector { .. })
        ));
        assert!(matches!(
            FrenetFrame::at(&wave, f64::NAN),
            Err(Error::NonFinite { .. })
        ));
    }
}
