//! Surfaces through two curves that are geodesics of them.
//!
//! Section 3.4 of the thesis chapter: `F(u,v) = H0 f0 + H1 X0 + H2 X1 + H3 f1` with end vectors
//! `X_i = lambda_i (cos alpha_i h_i + sin alpha_i e_i)` in the tangent planes. Both curves are geodesics for any
//! `alpha_i`, `lambda_i` as long as `lambda_i cos alpha_i` does not vanish.

use crate::conditions::refuse_inflections;
use crate::end_field::{EndField, ScalarFunction};
use crate::hermite::hermite;
use crate::hermite_arc::{EndVectorProblem, Freedom, HermiteArc, LocalCriterion};
use crate::plate::PlateSystem;
use crate::quadrature::SIX;
use crate::strip::{GeodesicStrip, Strip, StripSample};
use crate::{CubicSpline, EndCondition, Error, Surface};
use bezier_mass::Partials;
use core::array::from_fn;
use glam::DVec3;

/// A surface `F(u, v)` through two curves at `v = 0` and `v = 1`, both its geodesics.
///
/// ```
/// use reconstruct::{AnalyticCurve, GeodesicStrip, LocalCriterion, Surface, TwoCurveSurface};
/// let helix = |pitch: f64, z: f64| {
///     GeodesicStrip::new(AnalyticCurve::new(move |t| [t.cos(), t.sin(), t * pitch + z]))
/// };
/// let surface = TwoCurveSurface::new([helix(0.3, 0.0)?, helix(-0.2, 1.5)?])?
///     .smoothed(LocalCriterion::Bending, Default::default())?;
/// // Two geodesics of the unit cylinder: the surface stays near that cylinder.
/// assert!((surface.point(0.5, 0.5).truncate().length() - 1.0).abs() < 1e-2);
/// # Ok::<(), reconstruct::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct TwoCurveSurface {
    strips: [GeodesicStrip; 2],
    fields: [EndField; 2],
}

/// Smallest component across a curve that smoothing leaves, in parts of the local distance of the curves: a smaller
/// one would fold the surface back.
pub(crate) const LEAST_ACROSS: f64 = 0.05;
/// Smallest sine between an end vector and its curve whose length may be chosen.
const LEAST_SINE: f64 = 1e-6;
/// Places along the curves at which the local criteria are solved; a cubic spline joins them.
pub(crate) const PLACES: usize = 32;

impl TwoCurveSurface {
    /// The surface through two strips, with end vectors straight across of the length of the chord at the middle.
    /// The strips are turned so that `across` points from the first curve towards the second.
    ///
    /// # Errors
    /// [`Error::Inflection`] when a curve has an inflection that its strip cannot pass: give it a normal that runs on,
    /// with [`GeodesicStrip::with_normal`]. [`Error::IrregularBoundary`] when a curve's `across` is orthogonal to the
    /// way to the other curve at its middle, so that the surface cannot leave it.
    pub fn new(strips: [GeodesicStrip; 2]) -> Result<Self, Error> {
        for (side, strip) in strips.iter().enumerate() {
            refuse_inflections(strip, side)?;
        }
        let [a, b] = [strips[0].sample(0.5), strips[1].sample(0.5)];
        let chord = b.point[0] - a.point[0];
        let mut oriented = Vec::with_capacity(2);
        for (side, (strip, sample)) in strips.into_iter().zip([a, b]).enumerate() {
            let towards = sample.across[0].dot(chord) / chord.length();
            if !(towards.abs() > 1e-6) {
                return Err(Error::IrregularBoundary {
                    side,
                    t: 0.5,
                    across: towards,
                });
            }
            oriented.push(if towards < 0.0 {
                strip.flipped()
            } else {
                strip
            });
        }
        let got = oriented.len();
        let strips = oriented.try_into().map_err(|_| Error::TooFew {
            what: "strips",
            needed: 2,
            got,
        })?;
        let field = EndField::Polar {
            angle: 0.0.into(),
            length: chord.length().into(),
        };
        Ok(Self {
            strips,
            fields: [field.clone(), field],
        })
    }

    /// The surface through two strips as they are oriented, with unit end vectors straight across.
    ///
    /// # Errors
    /// [`Error::Inflection`] as in [`TwoCurveSurface::new`].
    pub fn from_oriented(strips: [GeodesicStrip; 2]) -> Result<Self, Error> {
        for (side, strip) in strips.iter().enumerate() {
            refuse_inflections(strip, side)?;
        }
        Ok(Self::between(strips))
    }

    /// As [`TwoCurveSurface::from_oriented`], of strips known to have no inflections that they cannot pass.
    pub(crate) fn between(strips: [GeodesicStrip; 2]) -> Self {
        let field = EndField::Polar {
            angle: 0.0.into(),
            length: 1.0.into(),
        };
        Self {
            strips,
            fields: [field.clone(), field],
        }
    }

    /// The same curves with other free functions.
    #[must_use]
    pub fn with_fields(self, fields: [EndField; 2]) -> Self {
        Self { fields, ..self }
    }

    /// The strips.
    #[must_use]
    pub fn strips(&self) -> &[GeodesicStrip; 2] {
        &self.strips
    }

    /// The free functions.
    #[must_use]
    pub fn fields(&self) -> &[EndField; 2] {
        &self.fields
    }

    /// The surface with the free functions chosen by a local criterion, place by place over `[0, 1]`: the lengths of
    /// the end vectors at the angles that they have, or the vectors altogether. A component across a curve that would
    /// fall below 0.05 of the chord is held there.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for curves that are not finite; [`Error::IrregularBoundary`] when only lengths are free and
    /// an end vector is within 1e-6 of the direction of its curve or points back, so that no length leads away from it.
    pub fn smoothed(self, criterion: LocalCriterion, freedom: Freedom) -> Result<Self, Error> {
        let places: Vec<f64> = (0..=PLACES).map(|i| i as f64 / PLACES as f64).collect();
        let mut components = [[const { Vec::new() }; 2], [const { Vec::new() }; 2]];
        for &u in &places {
            let samples = [self.strips[0].sample(u), self.strips[1].sample(u)];
            let chosen = self.local_minimum(u, &samples, criterion, freedom)?;
            for end in 0..2 {
                for axis in 0..2 {
                    components[end][axis].push(chosen[end][axis]);
                }
            }
        }
        let spline = |values: &Vec<f64>| {
            CubicSpline::new(&places, values, EndCondition::NotAKnot).map(ScalarFunction::Spline)
        };
        let [first, second] = &components;
        let field = |c: &[Vec<f64>; 2]| -> Result<EndField, Error> {
            Ok(EndField::Components {
                along: spline(&c[0])?,
                across: spline(&c[1])?,
            })
        };
        Ok(Self {
            fields: [field(first)?, field(second)?],
            ..self
        })
    }

    /// Components along and across of both end vectors at one place.
    fn local_minimum(
        &self,
        u: f64,
        samples: &[StripSample; 2],
        criterion: LocalCriterion,
        freedom: Freedom,
    ) -> Result<[[f64; 2]; 2], Error> {
        let chord = samples[1].point[0] - samples[0].point[0];
        let least = LEAST_ACROSS * chord.length();
        match freedom {
            Freedom::Lengths => {
                let directions: [[f64; 2]; 2] = from_fn(|end| {
                    let [p, q] = self.fields[end].components(u).map(|c| c.value());
                    let length = p.hypot(q);
                    [p / length, q / length]
                });
                for (side, [_, across]) in directions.into_iter().enumerate() {
                    if !(across > LEAST_SINE) {
                        return Err(Error::IrregularBoundary { side, t: u, across });
                    }
                }
                let vector = |end: usize| {
                    samples[end].along[0] * directions[end][0]
                        + samples[end].across[0] * directions[end][1]
                };
                let arc = HermiteArc::new(
                    [samples[0].point[0], samples[1].point[0]],
                    [vector(0), vector(1)],
                );
                let magnitudes = arc.least(criterion).magnitudes;
                Ok(from_fn(|end| {
                    directions[end].map(|c| c * magnitudes[end].max(least / directions[end][1]))
                }))
            }
            Freedom::Vectors => {
                let mut basis = Vec::with_capacity(4);
                for (end, sample) in samples.iter().enumerate() {
                    basis.extend([(end, sample.along[0]), (end, sample.across[0])]);
                }
                let (c, _) = EndVectorProblem { chord, basis }.minimum(criterion);
                Ok([[c[0], c[1].max(least)], [c[2], c[3].max(least)]])
            }
        }
    }

    /// The surface of least thin-plate energy `int int |F_uu|² + 2 |F_uv|² + |F_vv|²` (criterion 4, global), over
    /// components of the end vectors that are cubic splines in `u` with `spans` spans: one linear system. Components
    /// across are held above 0.05 of the least chord by fixing spline coefficients there.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no span or more than 256; [`Error::DegenerateEnergy`].
    pub fn smoothed_globally(self, spans: usize) -> Result<Self, Error> {
        if !(1..=256).contains(&spans) {
            return Err(Error::OutOfRange {
                what: "number of spans",
                value: spans as f64,
                range: [1.0, 256.0],
            });
        }
        let system = PlateSystem::assemble(&self.strips, spans);
        let coefficients = system.solve()?;
        let count = spans + 3;
        let component = |index: usize| {
            let c: Vec<f64> = (0..count)
                .map(|k| coefficients[index * count + k])
                .collect();
            ScalarFunction::Spline(CubicSpline::from_uniform_coefficients(&c))
        };
        let field = |end: usize| EndField::Components {
            along: component(2 * end),
            across: component(2 * end + 1),
        };
        Ok(Self {
            fields: [field(0), field(1)],
            ..self
        })
    }

    /// The energy of criterion 4, `int int |F_uu|² + 2 |F_uv|² + |F_vv|²` over the unit square.
    #[must_use]
    pub fn thin_plate_energy(&self) -> f64 {
        const PANELS: usize = 16;
        let mut sum = 0.0;
        for panel in 0..PANELS {
            for (x, wx) in SIX {
                let u = (panel as f64 + x) / PANELS as f64;
                for (v, wv) in SIX {
                    let at = self.partials(u, v);
                    let density = at.duu.length_squared()
                        + 2.0 * at.duv.length_squared()
                        + at.dvv.length_squared();
                    sum += wx * wv * density / PANELS as f64;
                }
            }
        }
        sum
    }
}

impl Surface for TwoCurveSurface {
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
        let samples = [self.strips[0].sample(u), self.strips[1].sample(u)];
        let vectors: [[DVec3; 3]; 2] = from_fn(|end| self.fields[end].at(u, &samples[end]));
        let functions = hermite(v);
        let derivative = |a: usize, b: usize| {
            let h = &functions[b];
            samples[0].point[a] * h[0]
                + vectors[0][a] * h[1]
                + vectors[1][a] * h[2]
                + samples[1].point[a] * h[3]
        };
        Partials {
            position: derivative(0, 0),
            du: derivative(1, 0),
            dv: derivative(0, 1),
            duu: derivative(2, 0),
            duv: derivative(1, 1),
            dvv: derivative(0, 2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{boundary, helix, inflected};

    #[test]
    fn every_choice_of_the_free_functions_keeps_the_curves_geodesic() {
        let base = TwoCurveSurface::new([helix(0.3, 0.0), helix(-0.2, 1.5)]).unwrap();
        let polar = EndField::Polar {
            angle: ScalarFunction::formula(|u| u.sin() * 0.7),
            length: ScalarFunction::formula(|u| u * 0.4 + 1.0),
        };
        assert!(boundary(&base.clone().with_fields([polar.clone(), polar])) < 1e-14);
        for freedom in [Freedom::Lengths, Freedom::Vectors] {
            for criterion in [
                LocalCriterion::Bending,
                LocalCriterion::Stretching,
                LocalCriterion::SpeedVariation,
            ] {
                assert!(boundary(&base.clone().smoothed(criterion, freedom).unwrap()) < 1e-14);
            }
        }
        let global = base.clone().smoothed_globally(4).unwrap();
        assert!(boundary(&global) < 1e-14);
        // The global criterion is the least of its kind.
        let local = base
            .smoothed(LocalCriterion::Bending, Freedom::Vectors)
            .unwrap();
        assert!(global.thin_plate_energy() <= local.thin_plate_energy());
    }

    #[test]
    fn second_derivatives_are_those_of_the_surface() {
        let surface = TwoCurveSurface::new([helix(0.3, 0.0), helix(-0.2, 1.5)])
            .unwrap()
            .smoothed_globally(3)
            .unwrap();
        let (u, v, h) = (0.41, 0.3, 1e-5);
        let at = surface.partials(u, v);
        let [east, west] = [surface.partials(u + h, v), surface.partials(u - h, v)];
        assert!(((east.du - west.du) / (2.0 * h) - at.duu).length() < 1e-8);
        assert!(((east.dv - west.dv) / (2.0 * h) - at.duv).length() < 1e-8);
    }

    /// The binormal reverses at an inflection: the surface would tear there.
    #[test]
    fn inflections_that_the_strip_cannot_pass_are_refused() {
        let refused = |result: Result<TwoCurveSurface, Error>, side: usize| matches!(result, Err(Error::Inflection { side: s, t }) if s == side && (t - 0.4).abs() < 1e-6);
        assert!(refused(
            TwoCurveSurface::new([inflected(0.0), inflected(1.0)]),
            0
        ));
        assert!(refused(
            TwoCurveSurface::new([helix(0.1, 0.0), inflected(1.0)]),
            1
        ));
        assert!(refused(
            TwoCurveSurface::from_oriented([helix(0.1, 0.0), inflected(1.0)]),
            1
        ));
    }

    #[test]
    fn end_vectors_along_their_curve_cannot_be_lengthened_into_a_surface() {
        for angle in [core::f64::consts::FRAC_PI_2, core::f64::consts::PI] {
            let field = EndField::Polar {
                angle: angle.into(),
                length: 1.0.into(),
            };
            let surface = TwoCurveSurface::new([helix(0.1, 0.0), helix(0.1, 1.0)])
                .unwrap()
                .with_fields([field.clone(), field]);
            assert!(matches!(
                surface
                    .clone()
                    .smoothed(LocalCriterion::Bending, Freedom::Lengths),
                Err(Error::IrregularBoundary { side: 0, .. })
            ));
            // With free directions the angle plays no part.
            assert!(
                surface
                    .smoothed(LocalCriterion::Bending, Freedom::Vectors)
                    .is_ok()
            );
        }
    }
}
