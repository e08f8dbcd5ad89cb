//! Strips: a curve together with the tangent planes of the surfaces on which it is a geodesic.
//!
//! A regular curve is a geodesic of a surface exactly when the surface's normal is its principal normal up
//! to sign (the characterisations D1 to D3 of Section 3.3 of the thesis chapter). So a curve with curvature
//! carries its tangent planes with it; a straight one, or one with inflections, needs to be told more.

use crate::{Curve, Error, VectorSeries};
use core::fmt::Debug;
use glam::DVec3;
use std::sync::Arc;

/// A strip at one parameter: the point with three derivatives, and two vectors with two derivatives each that
/// span the tangent plane, one along the curve and one across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StripSample {
    /// `r, r', r'', r'''`.
    pub point: [DVec3; 4],
    /// A multiple of the tangent, with two derivatives.
    pub along: [DVec3; 3],
    /// A tangent vector orthogonal to `along`, continuous along the curve, with two derivatives.
    pub across: [DVec3; 3],
}

impl StripSample {
    /// The unit normal of the tangent plane, `along x across`.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.along[0].cross(self.across[0]).normalize_or_zero()
    }
}

/// A curve over `[0, 1]` with its tangent planes. Transverse derivatives are written
/// `T(t) = p(t) along(t) + q(t) across(t)` with cubic `p` and `q`; which vectors span the planes decides
/// what kind of surface results.
pub trait Strip: Clone + Debug + Send + Sync {
    /// The strip at `t`.
    fn sample(&self, t: f64) -> StripSample;

    /// The curve.
    fn series(&self, t: f64) -> VectorSeries;

    /// Whether `across` is continuous through the inflections of the curve.
    fn passes_inflections(&self) -> bool;

    /// Whether the curve is straight, so that its normal is the strip's own choice.
    fn is_straight(&self) -> bool {
        false
    }
}

/// Where the normal of a strip comes from.
#[derive(Clone, Debug)]
enum Normal {
    /// The principal normal: `across` is the binormal.
    Principal,
    /// A plane curve: `across` is the normal of its plane.
    Planar(DVec3),
    /// A normal field given as a function of the parameter, of any length.
    Given(Arc<dyn Curve>),
}

/// A strip spanned by the unit tangent `e` and the unit vector `h` across: the frame version of the
/// construction (Section 3.6).
#[derive(Clone, Debug)]
pub struct GeodesicStrip {
    curve: Arc<dyn Curve>,
    normal: Normal,
    straight: bool,
    sign: f64,
}

/// Parameters at which a new curve is examined.
const PROBES: usize = 16;
/// A plane curve's binormals have this largest sine to one direction, and a straight curve this largest
/// curvature times length: some rounding errors of the derivatives.
const FLAT: f64 = 1e-12;

impl GeodesicStrip {
    /// The strip of a curve by its principal normal. Plane curves are recognised; their inflections do no harm.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for a curve that is not finite somewhere; [`Error::Inflection`] for a straight
    /// one, which has no principal normal: give one with [`GeodesicStrip::with_normal`].
    pub fn new(curve: impl Curve + 'static) -> Result<Self, Error> {
        let curve: Arc<dyn Curve> = Arc::new(curve);
        let mut binormals = Vec::with_capacity(PROBES + 1);
        for i in 0..=PROBES {
            let r = curve.series(i as f64 / PROBES as f64);
            if !r.is_finite() {
                return Err(Error::NonFinite {
                    what: "point or derivative of the curve at probe",
                    index: i,
                });
            }
            let [_, velocity, acceleration] = r.first_three();
            // Curvature times speed: the turning per unit of the parameter.
            let scale = velocity.length_squared();
            binormals.push(if scale == 0.0 {
                DVec3::ZERO
            } else {
                velocity.cross(acceleration) / scale
            });
        }
        let largest = binormals.iter().copied().fold(DVec3::ZERO, |a, b| {
            if b.length() > a.length() { b } else { a }
        });
        if largest.length() <= FLAT {
            return Err(Error::Inflection { side: 0, t: 0.0 });
        }
        let direction = largest.normalize();
        let planar = binormals
            .iter()
            .all(|b| b.cross(direction).length() <= FLAT * largest.length());
        let normal = if planar {
            Normal::Planar(direction)
        } else {
            Normal::Principal
        };
        Ok(Self {
            curve,
            normal,
            straight: false,
            sign: 1.0,
        })
    }

    /// The strip of a curve with the surface's normal given along it, of any length: for straight lines, for
    /// inflections, for sampled curves. The part of `normal` along the curve is ignored. The curve is a
    /// geodesic as far as the normal is its principal one; see [`GeodesicStrip::geodesic_curvature`].
    ///
    /// # Errors
    /// [`Error::NonFinite`], or [`Error::ZeroVector`] where the normal is along the curve.
    pub fn with_normal(
        curve: impl Curve + 'static,
        normal: impl Curve + 'static,
    ) -> Result<Self, Error> {
        let mut strip = Self {
            curve: Arc::new(curve),
            normal: Normal::Given(Arc::new(normal)),
            straight: true,
            sign: 1.0,
        };
        for index in 0..=PROBES {
            let t = index as f64 / PROBES as f64;
            let (r, normal) = (strip.curve.series(t), strip.normal_direction(t));
            if !(r.is_finite() && normal.is_finite()) {
                return Err(Error::NonFinite {
                    what: "point or normal of the curve at probe",
                    index,
                });
            }
            let [_, velocity, acceleration] = r.first_three();
            strip.straight &=
                velocity.cross(acceleration).length() <= FLAT * velocity.length_squared();
            let tangent = velocity.normalize_or_zero();
            if tangent.cross(normal.normalize_or_zero()).length() < FLAT {
                return Err(Error::ZeroVector {
                    what: "normal across the curve at probe",
                    index,
                });
            }
        }
        Ok(strip)
    }

    fn normal_direction(&self, t: f64) -> DVec3 {
        match &self.normal {
            Normal::Given(normal) => normal.point(t),
            _ => self.sample(t).normal(),
        }
    }

    /// The same strip seen from its other side: `across` reversed.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self {
            sign: -self.sign,
            ..self
        }
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &dyn Curve {
        &*self.curve
    }

    /// The geodesic curvature at `t` that the curve has on any surface through this strip, one over length.
    /// Zero up to rounding unless a normal was given.
    #[must_use]
    pub fn geodesic_curvature(&self, t: f64) -> f64 {
        let sample = self.sample(t);
        let [_, velocity, acceleration, _] = sample.point;
        velocity.cross(acceleration).dot(sample.normal()) / velocity.length().powi(3)
    }
}

impl Strip for GeodesicStrip {
    fn sample(&self, t: f64) -> StripSample {
        let r = self.curve.series(t);
        let velocity = r.derivative();
        let along = velocity.normalised();
        let across = match &self.normal {
            Normal::Principal => velocity.cross(&velocity.derivative()).normalised(),
            Normal::Planar(normal) => VectorSeries::constant(*normal),
            Normal::Given(normal) => normal.series(t).cross(&velocity).normalised(),
        };
        StripSample {
            point: core::array::from_fn(|k| r.derivative_at(k)),
            along: along.first_three(),
            across: (across * self.sign).first_three(),
        }
    }

    fn series(&self, t: f64) -> VectorSeries {
        self.curve.series(t)
    }

    fn passes_inflections(&self) -> bool {
        !matches!(self.normal, Normal::Principal)
    }

    fn is_straight(&self) -> bool {
        self.straight
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::AnalyticCurve;

    #[test]
    fn a_helix_lies_on_its_cylinder() {
        let strip =
            GeodesicStrip::new(AnalyticCurve::new(|t| [t.cos(), t.sin(), t * 0.4])).unwrap();
        let sample = strip.sample(0.6);
        let radial = DVec3::new(0.6f64.cos(), 0.6f64.sin(), 0.0);
        assert!((sample.normal().dot(radial).abs() - 1.0).abs() < 1e-15);
        assert!(strip.geodesic_curvature(0.6).abs() < 1e-15);
        // The torsion is minus the rate at which `across` tilts out of the plane.
        let rate = sample.across[1].dot(sample.normal()) / sample.point[1].length();
        assert!((rate.abs() - 0.4 / 1.16).abs() < 1e-15);
    }

    #[test]
    fn plane_curves_pass_their_inflections_and_lines_need_a_normal() {
        let wave = GeodesicStrip::new(AnalyticCurve::new(|t| {
            [t, ((t - 0.5) * 3.0).sin(), t * 0.0]
        }))
        .unwrap();
        assert!(wave.passes_inflections());
        assert!((wave.sample(0.5).across[0].z.abs() - 1.0).abs() < 1e-15);
        let line = || AnalyticCurve::new(|t| [t, t * 2.0, t * 0.0]);
        assert!(matches!(
            GeodesicStrip::new(line()),
            Err(Error::Inflection { .. })
        ));
        let normal = AnalyticCurve::new(|t| [t * 0.0, t.sin(), t.cos()]);
        let strip = GeodesicStrip::with_normal(line(), normal).unwrap();
        let sample = strip.sample(0.3);
        assert!(sample.across[0].dot(sample.point[1]).abs() < 1e-15);
        let along = AnalyticCurve::new(|t| [t * 0.0 + 1.0, t * 0.0 + 2.0, t * 0.0]);
        assert!(matches!(
            GeodesicStrip::with_normal(line(), along),
            Err(Error::ZeroVector { .. })
        ));
        let broken = AnalyticCurve::new(|t| [t.sqrt(), t, t]);
        assert!(matches!(
            GeodesicStrip::new(broken),
            Err(Error::NonFinite { .. })
        ));
    }
}
