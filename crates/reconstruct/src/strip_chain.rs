//! Chains of surfaces through two curves.

use crate::conditions::refuse_inflections;
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::two_curves::{LEAST_ACROSS, PLACES};
use crate::{CubicSpline, EndCondition, ScalarFunction};
use crate::{EndField, Error, Surface, TwoCurveSurface};
use nalgebra::{DMatrix, DVector};

/// Several strips joined to one C1 surface: consecutive two-curve surfaces that share the end vectors of their common
/// curve (Figs 3.13 to 3.15).
#[derive(Clone, Debug)]
pub struct StripChain {
    surfaces: Vec<TwoCurveSurface>,
    widths: Vec<f64>,
}

impl StripChain {
    /// The chain through three or more curves, with end vectors straight across whose lengths minimise the bending
    /// `int |F_vv|² dv` over the whole width, place by place; `widths` are the lengths of the intervals of `v`, one
    /// less than the curves. Along a fixed `u` this is the natural cubic spline through the curves whose slopes are
    /// held in their tangent planes.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::LengthMismatch`], [`Error::OutOfRange`] for a width that is not positive; those of
    /// [`TwoCurveSurface::new`].
    pub fn new(strips: Vec<GeodesicStrip>, widths: &[f64]) -> Result<Self, Error> {
        let n = strips.len();
        if n < 2 {
            return Err(Error::TooFew {
                what: "curves",
                needed: 2,
                got: n,
            });
        }
        if widths.len() != n - 1 {
            return Err(Error::LengthMismatch {
                what: "widths",
                expected: n - 1,
                got: widths.len(),
            });
        }
        if let Some(&value) = widths.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
            return Err(Error::OutOfRange {
                what: "width",
                value,
                range: [0.0, f64::INFINITY],
            });
        }
        for (side, strip) in strips.iter().enumerate() {
            refuse_inflections(strip, side)?;
        }
        let strips = oriented_chain(strips)?;
        let places: Vec<f64> = (0..=PLACES).map(|i| i as f64 / PLACES as f64).collect();
        let mut lengths = vec![Vec::with_capacity(places.len()); n];
        for &u in &places {
            let samples: Vec<StripSample> = strips.iter().map(|strip| strip.sample(u)).collect();
            for (k, length) in chain_lengths(&samples, widths)?.into_iter().enumerate() {
                lengths[k].push(length);
            }
        }
        let splines: Vec<CubicSpline<f64>> = lengths
            .iter()
            .map(|values| CubicSpline::new(&places, values, EndCondition::NotAKnot))
            .collect::<Result<_, _>>()?;
        let field = |k: usize, width: f64| {
            let scaled: Vec<f64> = lengths[k].iter().map(|l| l * width).collect();
            // Splines are linear in their data: the scaled one is the same function times the width.
            CubicSpline::new(splines[k].knots(), &scaled, EndCondition::NotAKnot).map(|spline| {
                EndField::Components {
                    along: 0.0.into(),
                    across: ScalarFunction::Spline(spline),
                }
            })
        };
        let surfaces = (0..n - 1)
            .map(|k| {
                Ok(
                    TwoCurveSurface::between([strips[k].clone(), strips[k + 1].clone()])
                        .with_fields([field(k, widths[k])?, field(k + 1, widths[k])?]),
                )
            })
            .collect::<Result<_, Error>>()?;
        Ok(Self {
            surfaces,
            widths: widths.to_vec(),
        })
    }

    /// The surfaces, each over the unit square.
    #[must_use]
    pub fn surfaces(&self) -> &[TwoCurveSurface] {
        &self.surfaces
    }

    /// The largest angle between the normals of neighbouring surfaces along their common curves, radians, from
    /// `samples + 1` places each.
    #[must_use]
    pub fn joint_angle(&self, samples: usize) -> f64 {
        let n = samples.max(1);
        let mut worst: f64 = 0.0;
        for pair in self.surfaces.windows(2) {
            for i in 0..=n {
                let u = i as f64 / n as f64;
                let (a, b) = (pair[0].normal(u, 1.0), pair[1].normal(u, 0.0));
                worst = worst.max(a.cross(b).length().atan2(a.dot(b)));
            }
        }
        worst
    }

    /// The largest jump of the derivative across common curves, relative to it: zero for a C1 surface over the
    /// intervals of the given widths.
    #[must_use]
    pub fn joint_jump(&self, samples: usize) -> f64 {
        let n = samples.max(1);
        let mut worst: f64 = 0.0;
        for (pair, widths) in self.surfaces.windows(2).zip(self.widths.windows(2)) {
            for i in 0..=n {
                let u = i as f64 / n as f64;
                let (a, b) = (
                    pair[0].partials(u, 1.0).dv / widths[0],
                    pair[1].partials(u, 0.0).dv / widths[1],
                );
                worst = worst.max(a.distance(b) / a.length());
            }
        }
        worst
    }
}

/// Turns every strip so that `across` points on along the chain.
fn oriented_chain(strips: Vec<GeodesicStrip>) -> Result<Vec<GeodesicStrip>, Error> {
    let samples: Vec<StripSample> = strips.iter().map(|strip| strip.sample(0.5)).collect();
    let last = samples.len() - 1;
    strips
        .into_iter()
        .enumerate()
        .map(|(k, strip)| {
            let onward =
                samples[(k + 1).min(last)].point[0] - samples[k.saturating_sub(1)].point[0];
            let towards = samples[k].across[0].dot(onward) / onward.length();
            if !(towards.abs() > 1e-6) {
                return Err(Error::IrregularBoundary {
                    side: k,
                    t: 0.5,
                    across: towards,
                });
            }
            Ok(if towards < 0.0 {
                strip.flipped()
            } else {
                strip
            })
        })
        .collect()
}

/// The lengths `l_k` of the vectors `l_k h_k` (per unit of `v`) of least total bending
/// `sum (12 |D|² - 12 d D.(X + Y) + 4 d² (|X|² + X.Y + |Y|²)) / d³`, held above the least component across.
fn chain_lengths(samples: &[StripSample], widths: &[f64]) -> Result<Vec<f64>, Error> {
    let n = samples.len();
    let (mut matrix, mut right) = (DMatrix::<f64>::zeros(n, n), DVector::<f64>::zeros(n));
    let mut least = vec![f64::INFINITY; n];
    for (k, &d) in widths.iter().enumerate() {
        let chord = samples[k + 1].point[0] - samples[k].point[0];
        let [h0, h1] = [samples[k].across[0], samples[k + 1].across[0]];
        matrix[(k, k)] += 8.0 / d;
        matrix[(k + 1, k + 1)] += 8.0 / d;
        matrix[(k, k + 1)] += 4.0 * h0.dot(h1) / d;
        matrix[(k + 1, k)] += 4.0 * h0.dot(h1) / d;
        right[k] += 12.0 * chord.dot(h0) / (d * d);
        right[k + 1] += 12.0 * chord.dot(h1) / (d * d);
        for end in [k, k + 1] {
            least[end] = least[end].min(LEAST_ACROSS * chord.length() / d);
        }
    }
    let solution = matrix
        .cholesky()
        .ok_or(Error::DegenerateEnergy)?
        .solve(&right);
    Ok(solution
        .iter()
        .zip(least)
        .map(|(l, least)| l.max(least))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{boundary, helix, inflected};

    #[test]
    fn a_chain_is_one_smooth_surface() {
        let strips = (0..5)
            .map(|k| helix(0.2 - 0.1 * f64::from(k), 0.8 * f64::from(k)))
            .collect();
        let chain = StripChain::new(strips, &[1.0, 0.9, 1.1, 1.0]).unwrap();
        assert_eq!(chain.surfaces().len(), 4);
        assert!(chain.joint_angle(16) < 1e-14 && chain.joint_jump(16) < 1e-13);
        for surface in chain.surfaces() {
            assert!(boundary(surface) < 1e-13);
            assert!((surface.point(0.4, 0.5).truncate().length() - 1.0).abs() < 1e-2);
        }
        assert!(matches!(
            StripChain::new(vec![helix(0.1, 0.0)], &[]),
            Err(Error::TooFew { .. })
        ));
        let two = || vec![helix(0.1, 0.0), helix(0.1, 1.0)];
        assert!(matches!(
            StripChain::new(two(), &[-1.0]),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            StripChain::new(two(), &[1.0, 1.0]),
            Err(Error::LengthMismatch { .. })
        ));
        let bent = vec![helix(0.1, 0.0), helix(0.1, 1.0), inflected(2.0)];
        assert!(matches!(
            StripChain::new(bent, &[1.0, 1.0]),
            Err(Error::Inflection { side: 2, t }) if (t - 0.4).abs() < 1e-6
        ));
    }
}
