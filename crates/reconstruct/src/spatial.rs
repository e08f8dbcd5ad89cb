//! Space curves from unit tangents.
//!
//! Section 3.2 of the thesis chapter, "Spatial curves": the tangent runs on the unit sphere; interpolate it
//! there, integrate its coordinates.

use crate::integrate::{ACCURACY, integrate, positions};
use crate::planar::cardinal_splines;
use crate::sphere::SphereSpline;
use crate::spline::{check_increasing, interval};
use crate::{CubicSpline, EndCondition, Error};
use glam::{DMat3, DVec3};

/// Neighbouring tangents with a smaller scalar product have no shortest arc between them.
pub(crate) const ANTIPODAL: f64 = -1.0 + 1e-9;
/// A spline of unit vectors shorter than this has lost its direction: the data turn too fast.
const NEAR_ZERO: f64 = 0.1;

/// How tangents are interpolated between sensors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TangentMethod {
    /// A cubic spline of each coordinate, then normalised. Position order above 4 with
    /// [`EndCondition::NotAKnot`], 3 with natural ends.
    #[default]
    Projected,
    /// A cubic B-spline on the sphere by spherical interpolation, as in the thesis: natural-like ends,
    /// equally spaced sensors, position order 3.
    SphericalSpline,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Tangent {
    Projected(CubicSpline<DVec3>),
    Spherical(SphereSpline),
}

impl Tangent {
    fn value(&self, s: f64) -> DVec3 {
        match self {
            Self::Projected(spline) => spline.value(s).normalize_or_zero(),
            Self::Spherical(spline) => spline.value(s),
        }
    }
}

/// A space curve known by its unit tangents at given arc lengths; it starts at the origin.
///
/// ```
/// use reconstruct::SpatialRibbon;
/// use glam::DVec3;
/// let s: Vec<f64> = (0..=32).map(|i| f64::from(i) / 8.0).collect();
/// let helix = |s: &f64| DVec3::new(-0.6 * s.sin(), 0.6 * s.cos(), 0.8);
/// let ribbon = SpatialRibbon::new(&s, &s.iter().map(helix).collect::<Vec<_>>())?;
/// let end = DVec3::new(0.6 * 4f64.cos() - 0.6, 0.6 * 4f64.sin(), 3.2);
/// assert!((ribbon.points()[32] - end).length() < 1e-6);
/// # Ok::<(), reconstruct::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredRibbon", into = "StoredRibbon")
)]
pub struct SpatialRibbon {
    pub(crate) knots: Vec<f64>,
    tangents: Vec<DVec3>,
    pub(crate) tangent: Tangent,
    end: EndCondition,
    points: Vec<DVec3>,
    accuracy: f64,
    integration_error: f64,
}

impl SpatialRibbon {
    /// The ribbon with these tangents (of any length: they are normalised) at strictly increasing arc
    /// lengths, by the projected spline with not-a-knot ends, integrated to `1e-13` of its length.
    ///
    /// # Errors
    /// See [`SpatialRibbon::with_method`].
    pub fn new(s: &[f64], tangents: &[DVec3]) -> Result<Self, Error> {
        Self::with_method(
            s,
            tangents,
            TangentMethod::default(),
            EndCondition::default(),
        )
    }

    /// As [`SpatialRibbon::new`] with a method and an end condition; [`TangentMethod::SphericalSpline`] has
    /// its own natural-like ends, whatever `end` says.
    ///
    /// # Errors
    /// [`Error::TooFew`], [`Error::LengthMismatch`], [`Error::NonFinite`], [`Error::NotIncreasing`],
    /// [`Error::ZeroVector`]; [`Error::AntipodalTangents`] for neighbours that point in opposite directions;
    /// [`Error::TangentLost`] where the projected spline passes near zero; [`Error::NotUniform`] for
    /// unequal spacing and [`Error::NoConvergence`] on the sphere; [`Error::NotIntegrable`].
    pub fn with_method(
        s: &[f64],
        tangents: &[DVec3],
        method: TangentMethod,
        end: EndCondition,
    ) -> Result<Self, Error> {
        check_increasing(s)?;
        if tangents.len() != s.len() {
            return Err(Error::LengthMismatch {
                what: "tangents",
                expected: s.len(),
                got: tangents.len(),
            });
        }
        let tangents = unit_tangents(tangents)?;
        let tangent = match method {
            TangentMethod::Projected => {
                Tangent::Projected(projected(CubicSpline::new(s, &tangents, end)?)?)
            }
            TangentMethod::SphericalSpline => Tangent::Spherical(SphereSpline::new(s, &tangents)?),
        };
        let accuracy = ACCURACY * (s[s.len() - 1] - s[0]);
        let (points, integration_error) = positions(s, &|s| tangent.value(s), accuracy)?;
        Ok(Self {
            knots: s.to_vec(),
            tangents,
            tangent,
            end,
            points,
            accuracy,
            integration_error,
        })
    }

    /// The ribbon with other tangents at the same arc lengths, by the same method with the same ends.
    pub(crate) fn with_tangents(&self, tangents: &[DVec3]) -> Result<Self, Error> {
        Self::with_method(&self.knots, tangents, self.method(), self.end)
    }

    /// How the tangents are interpolated.
    #[must_use]
    pub fn method(&self) -> TangentMethod {
        match self.tangent {
            Tangent::Projected(_) => TangentMethod::Projected,
            Tangent::Spherical(_) => TangentMethod::SphericalSpline,
        }
    }

    /// The end condition; the spherical spline has its own natural-like ends.
    #[must_use]
    pub fn end_condition(&self) -> EndCondition {
        match self.tangent {
            Tangent::Projected(_) => self.end,
            Tangent::Spherical(_) => EndCondition::Natural,
        }
    }

    /// The arc lengths of the data.
    #[must_use]
    pub fn arc_lengths(&self) -> &[f64] {
        &self.knots
    }

    /// The unit tangents at the data.
    #[must_use]
    pub fn tangents(&self) -> &[DVec3] {
        &self.tangents
    }

    /// The positions at the data; the first is the origin.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The estimate of the integration's error at the far end, in units of length.
    #[must_use]
    pub fn integration_error(&self) -> f64 {
        self.integration_error
    }

    /// The unit tangent at arc length `s`.
    #[must_use]
    pub fn tangent(&self, s: f64) -> DVec3 {
        self.tangent.value(s)
    }

    /// The curvature vector `dT/ds` at arc length `s`, one over length.
    ///
    /// Exact for [`TangentMethod::Projected`]; for the spherical spline a central difference over a
    /// thousandth of the sensor spacing, good to six digits.
    #[must_use]
    pub fn curvature_vector(&self, s: f64) -> DVec3 {
        match &self.tangent {
            Tangent::Projected(spline) => {
                let piece = spline.piece(interval(&self.knots, s));
                let value = piece.value(s);
                let (unit, slope) = (value.normalize_or_zero(), piece.derivative(s));
                (slope - unit * unit.dot(slope)) / value.length()
            }
            Tangent::Spherical(spline) => {
                let step = 1e-3 * (self.knots[1] - self.knots[0]);
                (spline.value(s + step) - spline.value(s - step)) / (2.0 * step)
            }
        }
    }

    /// The position at arc length `s`.
    ///
    /// # Errors
    /// [`Error::NotIntegrable`] for an `s` that is no number or absurdly far beyond the ends.
    pub fn point(&self, s: f64) -> Result<DVec3, Error> {
        let i = interval(&self.knots, s);
        Ok(self.points[i]
            + integrate(&|s| self.tangent.value(s), self.knots[i], s, self.accuracy)?.0)
    }

    /// How the position at arc length `s` moves when tangent `j` moves by a small vector: one matrix a
    /// datum, in units of length. `dx(s) = sum_j M_j dT_j`,
    /// `M_j = integral of phi_j (I - T T^T) / |S|`, with the cardinal splines `phi_j` and the spline `S`.
    /// For the spherical spline this is the derivative of the projected one with natural ends, which agrees to first
    /// order in the turning between neighbouring sensors.
    ///
    /// Beyond the ends it goes on as [`SpatialRibbon::point`] does; an `s` that is no number gives NaN.
    #[must_use]
    pub fn sensitivity(&self, s: f64) -> Vec<DMat3> {
        let cardinals = cardinal_splines(&self.knots, self.end_condition());
        let mut totals = vec![DMat3::ZERO; cardinals.len()];
        if s.is_nan() {
            return vec![DMat3::NAN; cardinals.len()];
        }
        let last = self.knots.len() - 2;
        for (i, pair) in self.knots.windows(2).enumerate() {
            let end = if i == last { s } else { s.min(pair[1]) };
            // Before the start the first interval is run backwards.
            if i == 0 || pair[0] < s {
                self.add_sensitivity(&cardinals, pair[0], end, &mut totals);
            }
        }
        totals
    }

    fn add_sensitivity(
        &self,
        cardinals: &[CubicSpline<f64>],
        start: f64,
        end: f64,
        totals: &mut [DMat3],
    ) {
        let length = end - start;
        for (node, weight) in crate::quadrature::SIX {
            let s = start + node * length;
            let turn = self.projector(s) * (weight * length);
            for (total, cardinal) in totals.iter_mut().zip(cardinals) {
                *total += turn * cardinal.value(s);
            }
        }
    }

    /// The derivative of `S / |S|` by `S` at arc length `s`.
    fn projector(&self, s: f64) -> DMat3 {
        let (unit, length) = match &self.tangent {
            Tangent::Projected(spline) => (self.tangent(s), spline.value(s).length()),
            Tangent::Spherical(_) => (self.tangent(s), 1.0),
        };
        (DMat3::IDENTITY - outer(unit, unit)) * (1.0 / length)
    }

    /// The covariance of the position at each datum (length squared), when the tangents carry independent
    /// isotropic errors of standard deviation `sigma` (radians, per direction across the tangent). Only the square of
    /// `sigma` enters, so its sign does not matter; a `sigma` that is no number gives NaN.
    #[must_use]
    pub fn covariance(&self, sigma: f64) -> Vec<DMat3> {
        self.positions_sensitivity()
            .into_iter()
            .map(|row| {
                row.iter()
                    .zip(&self.tangents)
                    .fold(DMat3::ZERO, |sum, (m, t)| {
                        let across = DMat3::IDENTITY - outer(*t, *t);
                        sum + *m * across * m.transpose() * (sigma * sigma)
                    })
            })
            .collect()
    }

    /// [`SpatialRibbon::sensitivity`] at every datum.
    pub(crate) fn positions_sensitivity(&self) -> Vec<Vec<DMat3>> {
        let cardinals = cardinal_splines(&self.knots, self.end_condition());
        let mut row = vec![DMat3::ZERO; cardinals.len()];
        let mut rows = vec![row.clone()];
        for pair in self.knots.windows(2) {
            self.add_sensitivity(&cardinals, pair[0], pair[1], &mut row);
            rows.push(row.clone());
        }
        rows
    }
}

/// The data of a ribbon; the rest is computed from them.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(rename = "SpatialRibbon")]
struct StoredRibbon {
    s: Vec<f64>,
    tangents: Vec<DVec3>,
    method: TangentMethod,
    end: EndCondition,
}

#[cfg(feature = "serde")]
impl From<SpatialRibbon> for StoredRibbon {
    fn from(ribbon: SpatialRibbon) -> Self {
        Self {
            method: ribbon.method(),
            s: ribbon.knots,
            tangents: ribbon.tangents,
            end: ribbon.end,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredRibbon> for SpatialRibbon {
    type Error = Error;

    fn try_from(stored: StoredRibbon) -> Result<Self, Error> {
        Self::with_method(&stored.s, &stored.tangents, stored.method, stored.end)
    }
}

/// The matrix `a b^T`.
pub(crate) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The direction of a finite vector of any length; none of zero.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    // Squares of such coordinates are ordinary numbers.
    if (1e-100..=1e100).contains(&largest) {
        v.try_normalize()
    } else {
        (v / largest).try_normalize()
    }
}

/// The tangents normalised.
///
/// # Errors
/// [`Error::NonFinite`], [`Error::ZeroVector`], [`Error::AntipodalTangents`].
pub(crate) fn unit_tangents(tangents: &[DVec3]) -> Result<Vec<DVec3>, Error> {
    let mut units: Vec<DVec3> = Vec::with_capacity(tangents.len());
    for (index, tangent) in tangents.iter().enumerate() {
        if !tangent.is_finite() {
            return Err(Error::NonFinite {
                what: "tangent",
                index,
            });
        }
        let unit = unit(*tangent).ok_or(Error::ZeroVector {
            what: "tangent",
            index,
        })?;
        if let Some(before) = units.last() {
            let cosine = before.dot(unit);
            if cosine < ANTIPODAL {
                return Err(Error::AntipodalTangents { index, cosine });
            }
        }
        units.push(unit);
    }
    Ok(units)
}

/// Chords into which a spline piece is cut to measure its distance from zero.
const CHORDS: usize = 8;

/// Accepts a spline of unit vectors that keeps away from zero: no chord of it comes near.
pub(crate) fn projected(spline: CubicSpline<DVec3>) -> Result<CubicSpline<DVec3>, Error> {
    for pair in spline.knots().windows(2) {
        let mut before = spline.value(pair[0]);
        for k in 1..=CHORDS {
            let s = pair[0] + (pair[1] - pair[0]) * k as f64 / CHORDS as f64;
            let after = spline.value(s);
            let chord = after - before;
            let nearest = (-before.dot(chord) / chord.length_squared().max(f64::MIN_POSITIVE))
                .clamp(0.0, 1.0);
            let length = (before + chord * nearest).length();
            if !(length >= NEAR_ZERO) {
                return Err(Error::TangentLost { s, length });
            }
            before = after;
        }
    }
    Ok(spline)
}

#[cfg(test)]
mod tests;
