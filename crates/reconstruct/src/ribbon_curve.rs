//! A stretch of a ribbon as a curve with derivatives.

use crate::spatial::Tangent;
use crate::spline::interval;
use crate::{Curve, Error, SpatialRibbon, VectorSeries};
use glam::DVec3;

/// A stretch of a ribbon as a curve over `[0, 1]`, with exact derivatives (projected method).
///
/// The tangent is a normalised piecewise cubic: derivatives of the position up to the third are continuous,
/// the fourth jumps at the sensors.
#[derive(Clone, Debug, PartialEq)]
pub struct RibbonCurve {
    ribbon: SpatialRibbon,
    start: f64,
    length: f64,
    origin: DVec3,
}

impl RibbonCurve {
    /// The stretch `[start, end]` of arc length, with the ribbon's own start put at `origin`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] unless `start < end` lie on the ribbon; [`Error::Unsupported`] for a ribbon by
    /// the spherical spline.
    pub fn new(ribbon: SpatialRibbon, start: f64, end: f64, origin: DVec3) -> Result<Self, Error> {
        let [first, last] = [ribbon.knots[0], ribbon.knots[ribbon.knots.len() - 1]];
        if !(first <= start && start < end && end <= last) {
            return Err(Error::OutOfRange {
                what: "arc length",
                value: if start < first { start } else { end },
                range: [first, last],
            });
        }
        if matches!(ribbon.tangent, Tangent::Spherical(_)) {
            return Err(Error::Unsupported {
                what: "derivatives of the spline on the sphere",
            });
        }
        Ok(Self {
            ribbon,
            start,
            length: end - start,
            origin,
        })
    }
}

impl Curve for RibbonCurve {
    fn series(&self, t: f64) -> VectorSeries {
        let s = self.start + t * self.length;
        let Tangent::Projected(spline) = &self.ribbon.tangent else {
            return VectorSeries::constant(DVec3::NAN);
        };
        let piece = spline.piece(interval(&self.ribbon.knots, s));
        let third = (piece.moments[1] - piece.moments[0]) / piece.length;
        let cubic = VectorSeries([
            piece.value(s),
            piece.derivative(s),
            piece.second_derivative(s) / 2.0,
            third / 6.0,
            DVec3::ZERO,
        ]);
        let tangent = cubic.normalised();
        let point = self.ribbon.point(s).map_or(DVec3::NAN, |p| self.origin + p);
        let mut scale = 1.0;
        VectorSeries(core::array::from_fn(|k| {
            if k == 0 {
                return point;
            }
            scale *= self.length;
            tangent.0[k - 1] * (scale / k as f64)
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_is_a_curve_with_its_derivatives() {
        let s: Vec<f64> = (0..=16).map(|i| f64::from(i) / 4.0).collect();
        let tangent = |s: &f64| DVec3::new((1.3 * s).sin(), (2.1 * s).cos(), 1.5);
        let tangents: Vec<DVec3> = s.iter().map(tangent).collect();
        let ribbon = SpatialRibbon::new(&s, &tangents).unwrap();
        let curve = RibbonCurve::new(ribbon.clone(), 0.5, 3.1, DVec3::ONE).unwrap();
        let r = curve.series(0.37);
        let h = 1e-4;
        let [before, after] = [curve.series(0.37 - h), curve.series(0.37 + h)];
        for order in 0..4 {
            let difference = (after.derivative_at(order) - before.derivative_at(order)) / (2.0 * h);
            assert!(
                (difference - r.derivative_at(order + 1)).length() < 1e-4,
                "{order}"
            );
        }
        assert!(
            (r.derivative_at(2) / (2.6 * 2.6) - ribbon.curvature_vector(0.5 + 0.37 * 2.6)).length()
                < 1e-12
        );
        assert!(RibbonCurve::new(ribbon, -1.0, 2.0, DVec3::ZERO).is_err());
    }
}
