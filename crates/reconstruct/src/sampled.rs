//! Curves known by points: a least-squares spline, and binormals smoothed before use.
//!
//! Section 3.4 of the thesis chapter: of computed geodesics "only numerical data are available", and the surface
//! construction "requires the smoothing of the binormal vectors".

use crate::spatial::unit;
use crate::{Curve, Error, GeodesicStrip, Series, VectorSeries};
use core::array::from_fn;
use glam::DVec3;
use nalgebra::DMatrix;

/// Degree of the splines: with four continuous derivatives, as many as a strip uses.
const DEGREE: usize = 5;

/// Condition number of a fit above which noise of the ninth digit moves the curve by its size.
const LARGEST_CONDITION: f64 = 1e9;

/// A curve over `[0, 1]` fitted to points by a quintic spline with uniform spans, in the sense of least squares.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredCurve")
)]
pub struct SampledCurve {
    coefficients: Vec<DVec3>,
    parameters: Vec<f64>,
    residual: f64,
}

impl SampledCurve {
    /// The curve through (near) these points, its parameter in proportion to the length of the polygon.
    ///
    /// Fewer spans smooth more; `spans + 5` coefficients are fitted.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer points than coefficients; [`Error::NonFinite`]; [`Error::ZeroVector`] when
    /// neighbouring points coincide; [`Error::OutOfRange`] for no span; [`Error::DegenerateEnergy`] when the points
    /// leave so many spans (nearly) empty that they do not determine the curve.
    pub fn fit(points: &[DVec3], spans: usize) -> Result<Self, Error> {
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(Error::NonFinite {
                what: "point",
                index,
            });
        }
        let mut parameters = vec![0.0];
        let mut total = 0.0;
        for (index, pair) in points.windows(2).enumerate() {
            let step = pair[0].distance(pair[1]);
            if step == 0.0 {
                return Err(Error::ZeroVector {
                    what: "step to the point",
                    index: index + 1,
                });
            }
            total += step;
            parameters.push(total);
        }
        for parameter in &mut parameters {
            *parameter /= total;
        }
        Self::fit_at(parameters, points, None, spans)
    }

    /// As [`SampledCurve::fit`], for points that come with unit tangents (of any length), as those of a traced geodesic
    /// do; both are fitted.
    ///
    /// # Errors
    /// As [`SampledCurve::fit`]; [`Error::LengthMismatch`].
    pub fn fit_with_tangents(
        points: &[DVec3],
        tangents: &[DVec3],
        spans: usize,
    ) -> Result<Self, Error> {
        if tangents.len() != points.len() {
            return Err(Error::LengthMismatch {
                what: "tangents",
                expected: points.len(),
                got: tangents.len(),
            });
        }
        let mut units = Vec::with_capacity(tangents.len());
        for (index, tangent) in tangents.iter().enumerate() {
            if !tangent.is_finite() {
                return Err(Error::NonFinite {
                    what: "tangent",
                    index,
                });
            }
            units.push(unit(*tangent).ok_or(Error::ZeroVector {
                what: "tangent",
                index,
            })?);
        }
        let rough = Self::fit(points, spans)?;
        let length: f64 = points
            .windows(2)
            .map(|pair| pair[0].distance(pair[1]))
            .sum();
        let velocities: Vec<DVec3> = units.iter().map(|t| *t * length).collect();
        Self::fit_at(rough.parameters, points, Some(&velocities), spans)
    }

    fn fit_at(
        parameters: Vec<f64>,
        values: &[DVec3],
        velocities: Option<&[DVec3]>,
        spans: usize,
    ) -> Result<Self, Error> {
        if spans == 0 {
            return Err(Error::OutOfRange {
                what: "number of spans",
                value: 0.0,
                range: [1.0, f64::INFINITY],
            });
        }
        let count = spans.saturating_add(DEGREE);
        let conditions = values.len() * if velocities.is_some() { 2 } else { 1 };
        if values.len() < 2 || conditions < count {
            return Err(Error::TooFew {
                what: "points",
                needed: count.max(2),
                got: values.len(),
            });
        }
        let mut matrix = DMatrix::<f64>::zeros(conditions, count);
        let mut right = DMatrix::<f64>::zeros(conditions, 3);
        for (row, (t, value)) in parameters.iter().zip(values).enumerate() {
            let (first, basis) = uniform_basis(*t, spans);
            for (k, b) in basis.iter().enumerate() {
                matrix[(row, first + k)] = b.value();
            }
            for axis in 0..3 {
                right[(row, axis)] = value[axis];
            }
            if let Some(velocities) = velocities {
                // A tangent weighs as much as a displacement over one span.
                let (below, weight) = (row + values.len(), 1.0 / spans as f64);
                for (k, b) in basis.iter().enumerate() {
                    matrix[(below, first + k)] = b.derivative_at(1) * weight;
                }
                for axis in 0..3 {
                    right[(below, axis)] = velocities[row][axis] * weight;
                }
            }
        }
        let qr = matrix.qr();
        let factor = qr.r();
        // Data that leave a span empty determine some coefficients by rounding only.
        let inverse = factor
            .solve_upper_triangular(&DMatrix::identity(count, count))
            .ok_or(Error::DegenerateEnergy)?;
        if !(factor.norm() * inverse.norm() <= LARGEST_CONDITION) {
            return Err(Error::DegenerateEnergy);
        }
        let solution = inverse * (qr.q().transpose() * &right);
        let coefficients: Vec<DVec3> = (0..count)
            .map(|k| DVec3::new(solution[(k, 0)], solution[(k, 1)], solution[(k, 2)]))
            .collect();
        if !coefficients.iter().all(|c| c.is_finite()) {
            return Err(Error::DegenerateEnergy);
        }
        let mut curve = Self {
            coefficients,
            parameters,
            residual: 0.0,
        };
        let distances = curve
            .parameters
            .iter()
            .zip(values)
            .map(|(t, value)| curve.point(*t).distance(*value));
        curve.residual = distances.fold(0.0, f64::max);
        Ok(curve)
    }

    /// The parameters of the points it was fitted to.
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The largest distance between a point and the curve at its parameter.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.residual
    }

    fn spans(&self) -> usize {
        self.coefficients.len() - DEGREE
    }

    /// The strip of this curve by its binormals, smoothed: they are taken at the fitted points with consistent signs,
    /// weighed by the curvature (where the curve is straight they say nothing), and fitted by a spline with `spans`
    /// spans. The curve is then nearly a geodesic of surfaces through the strip; how nearly,
    /// [`GeodesicStrip::geodesic_curvature`] says.
    ///
    /// # Errors
    /// [`Error::Inflection`] for a straight curve; those of [`SampledCurve::fit`].
    pub fn strip(&self, spans: usize) -> Result<GeodesicStrip, Error> {
        let mut binormals: Vec<DVec3> = Vec::with_capacity(self.parameters.len());
        let mut before = DVec3::ZERO;
        for t in &self.parameters {
            let [_, velocity, acceleration] = self.series(*t).first_three();
            let bend = velocity.cross(acceleration) / velocity.length().powi(3);
            // Sign-consistent through inflections: follow the last binormal.
            let bend = if bend.dot(before) < 0.0 { -bend } else { bend };
            before += bend;
            binormals.push(bend);
        }
        let strongest = binormals.iter().map(|b| b.length()).fold(0.0, f64::max);
        if !(strongest > 0.0) {
            return Err(Error::Inflection { side: 0, t: 0.0 });
        }
        // Fitting the unscaled binormals weighs each direction by its curvature.
        let smooth = Self::fit_at(self.parameters.clone(), &binormals, None, spans)?;
        GeodesicStrip::with_normal(
            self.clone(),
            Sideways {
                across: smooth,
                along: self.clone(),
            },
        )
    }

    /// The strip of this curve with surface normals known at its points, fitted by a spline with `spans` spans.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`]; those of [`SampledCurve::fit`] and [`GeodesicStrip::with_normal`].
    pub fn strip_with_normals(
        &self,
        normals: &[DVec3],
        spans: usize,
    ) -> Result<GeodesicStrip, Error> {
        if normals.len() != self.parameters.len() {
            return Err(Error::LengthMismatch {
                what: "normals",
                expected: self.parameters.len(),
                got: normals.len(),
            });
        }
        if let Some(index) = normals.iter().position(|n| !n.is_finite()) {
            return Err(Error::NonFinite {
                what: "normal",
                index,
            });
        }
        let normal = Self::fit_at(self.parameters.clone(), normals, None, spans)?;
        GeodesicStrip::with_normal(self.clone(), normal)
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "SampledCurve")]
struct StoredCurve {
    coefficients: Vec<DVec3>,
    parameters: Vec<f64>,
    residual: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<StoredCurve> for SampledCurve {
    type Error = Error;

    fn try_from(stored: StoredCurve) -> Result<Self, Error> {
        let StoredCurve {
            coefficients,
            parameters,
            residual,
        } = stored;
        if coefficients.len() <= DEGREE {
            return Err(Error::TooFew {
                what: "coefficients",
                needed: DEGREE + 1,
                got: coefficients.len(),
            });
        }
        if let Some(index) = coefficients.iter().position(|c| !c.is_finite()) {
            return Err(Error::NonFinite {
                what: "coefficient",
                index,
            });
        }
        crate::spline::check_increasing(&parameters)?;
        if !(residual >= 0.0 && residual.is_finite()) {
            return Err(Error::Stored { what: "residual" });
        }
        Ok(Self {
            coefficients,
            parameters,
            residual,
        })
    }
}

impl Curve for SampledCurve {
    fn series(&self, t: f64) -> VectorSeries {
        let (first, basis) = uniform_basis(t, self.spans());
        VectorSeries(from_fn(|order| {
            basis
                .iter()
                .zip(&self.coefficients[first..])
                .map(|(b, c)| *c * b.0[order])
                .sum()
        }))
    }
}

/// The normal `r' x across` of a strip whose direction across is known.
#[derive(Clone, Debug)]
struct Sideways {
    across: SampledCurve,
    along: SampledCurve,
}

impl Curve for Sideways {
    fn series(&self, t: f64) -> VectorSeries {
        self.along
            .series(t)
            .derivative()
            .cross(&self.across.series(t))
    }
}

/// The first index and the six quintic B-splines on `spans` uniform spans of `[0, 1]` that do not vanish at `t`, as
/// series, by the recursion of Cox and de Boor. The end spans continue beyond the ends.
fn uniform_basis(t: f64, spans: usize) -> (usize, [Series; DEGREE + 1]) {
    let scaled = Series::parameter(t) * spans as f64;
    // A saturating conversion: what lies before the start belongs to the first span.
    let span = (scaled.value() as usize).min(spans - 1);
    let x = scaled - span as f64;
    let mut basis = [Series::constant(0.0); DEGREE + 1];
    basis[0] = Series::constant(1.0);
    for degree in 1..=DEGREE {
        let mut carried = Series::constant(0.0);
        for (k, spline) in basis.iter_mut().enumerate().take(degree) {
            // Spline k of the lower degree lives on the knots from k + 1 - degree to k + 1 about the span.
            let share = *spline / degree as f64;
            let right = x * -1.0 + (k + 1) as f64;
            *spline = carried + right * share;
            carried = (x + (degree - 1 - k) as f64) * share;
        }
        basis[degree] = carried;
    }
    (span, basis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Noise;

    #[test]
    fn the_basis_is_a_partition_of_unity_with_smooth_joints() {
        let (_, basis) = uniform_basis(0.37, 4);
        let sum = basis.iter().fold(Series::constant(0.0), |sum, b| sum + *b);
        assert!((sum.value() - 1.0).abs() < 1e-15 && sum.0[1..].iter().all(|c| c.abs() < 1e-11));
        let curve = SampledCurve {
            coefficients: (0..9)
                .map(|i| DVec3::new(f64::from(i * i % 5), f64::from(i), 1.0))
                .collect(),
            parameters: vec![],
            residual: 0.0,
        };
        let (left, right) = (curve.series(0.5 - 1e-12), curve.series(0.5));
        for order in 0..5 {
            let scale = 4f64.powi(order);
            assert!(
                (left.0[order as usize] - right.0[order as usize]).length() < 1e-9 * scale,
                "{order}"
            );
        }
    }

    fn helix(n: usize) -> (Vec<DVec3>, Vec<DVec3>) {
        let points = (0..=n).map(|i| 2.0 * i as f64 / n as f64);
        points
            .map(|t| {
                (
                    DVec3::new(t.cos(), t.sin(), 0.4 * t),
                    DVec3::new(-t.sin(), t.cos(), 0.4),
                )
            })
            .unzip()
    }

    #[test]
    fn fits_converge_and_strips_are_nearly_geodesic() {
        let (points, tangents) = helix(200);
        let residuals = [4, 8].map(|spans| SampledCurve::fit(&points, spans).unwrap().residual());
        assert!((residuals[0] / residuals[1]).log2() > 4.5, "{residuals:?}");
        for curve in [
            SampledCurve::fit(&points, 8).unwrap(),
            SampledCurve::fit_with_tangents(&points, &tangents, 8).unwrap(),
        ] {
            let strip = curve.strip(6).unwrap();
            let worst = (0..=50)
                .map(|i| strip.geodesic_curvature(f64::from(i) / 50.0).abs())
                .fold(0.0, f64::max);
            assert!(worst < 1e-4, "{worst}");
        }
        let normals: Vec<DVec3> = points.iter().map(|p| DVec3::new(p.x, p.y, 0.0)).collect();
        let strip = SampledCurve::fit(&points, 8)
            .unwrap()
            .strip_with_normals(&normals, 8)
            .unwrap();
        assert!(strip.geodesic_curvature(0.4).abs() < 1e-4);
    }

    /// With noise the smoothed binormals stay near the true ones, where raw ones are useless.
    #[test]
    fn smoothing_tames_noise() {
        let mut noise = Noise::new(4);
        let (points, _) = helix(400);
        let noisy: Vec<DVec3> = points
            .iter()
            .map(|p| *p + noise.gaussian_vector() * 1e-3)
            .collect();
        let strip = SampledCurve::fit(&noisy, 3).unwrap().strip(2).unwrap();
        let worst = (1..10)
            .map(|i| strip.geodesic_curvature(f64::from(i) / 10.0).abs())
            .fold(0.0, f64::max);
        assert!(worst < 0.2, "{worst}");
    }

    #[test]
    fn hostile_points() {
        let (points, tangents) = helix(20);
        assert!(matches!(
            SampledCurve::fit(&points[..4], 2),
            Err(Error::TooFew { .. })
        ));
        assert!(matches!(
            SampledCurve::fit(&points, 0),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            SampledCurve::fit(&[DVec3::X; 20], 2),
            Err(Error::ZeroVector { .. })
        ));
        assert!(matches!(
            SampledCurve::fit(&[DVec3::NAN; 20], 2),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            SampledCurve::fit_with_tangents(&points, &tangents[1..], 2),
            Err(Error::LengthMismatch { .. })
        ));
        assert!(matches!(
            SampledCurve::fit(&points, usize::MAX),
            Err(Error::TooFew { .. })
        ));
        let mut gap: Vec<DVec3> = (0..10).map(|i| DVec3::X * (0.001 * f64::from(i))).collect();
        gap.extend([1.0, 1.001].map(|x| DVec3::new(x, 0.5, 0.0)));
        assert!(matches!(
            SampledCurve::fit(&gap, 6),
            Err(Error::DegenerateEnergy)
        ));
        let line: Vec<DVec3> = (0..20).map(|i| DVec3::X * f64::from(i)).collect();
        let straight = SampledCurve::fit(&line, 2).unwrap().strip(2);
        // The binormals of a straight line are rounding; whatever comes of them must not be NaN or a panic.
        if let Ok(strip) = straight {
            assert!(strip.geodesic_curvature(0.5).is_finite());
        }
    }
}
