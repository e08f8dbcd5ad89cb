//! The conditions under which given curves can bound a surface as geodesics.
//!
//! Section 3.5 of the thesis chapter: (C1) at each corner the principal normals agree up to sign; (C2) the
//! principal normal, carried around the boundary, reverses an even number of times; (C3) the crossing identity
//! (3.7) holds at each corner. Proposition 5: they are necessary, and without inflections sufficient.

use crate::Error;
use crate::strip::{Strip, StripSample};
use core::fmt;
use glam::DVec3;

/// A corner of a boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Corner {
    /// The corner of a rectangle at `u = i`, `v = j`.
    Rectangle(usize, usize),
    /// The vertex of a triangle.
    Triangle(usize),
}

impl fmt::Display for Corner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rectangle(i, j) => write!(f, "{i}{j}"),
            Self::Triangle(i) => write!(f, "{i}"),
        }
    }
}

/// One thing that is wrong with a boundary, with its measure. Sides are counted as they are given.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Violation {
    /// Two curves do not meet where they should.
    #[error("the curves at corner {corner} end {distance:e} apart")]
    CornerMismatch {
        /// The corner.
        corner: Corner,
        /// The distance between the two ends.
        distance: f64,
    },
    /// A curve has no direction at a corner.
    #[error("the curve {side} has no velocity at corner {corner}")]
    IrregularCurve {
        /// The corner.
        corner: Corner,
        /// The curve.
        side: usize,
    },
    /// The curves touch at a corner, so they span no tangent plane.
    #[error("the curves at corner {corner} are parallel (sine {sine:e})")]
    ParallelTangents {
        /// The corner.
        corner: Corner,
        /// The sine of the angle between them.
        sine: f64,
    },
    /// A curve has no principal normal at a corner.
    #[error("the curve {side} has an inflection at corner {corner}")]
    InflectionAtCorner {
        /// The corner.
        corner: Corner,
        /// The curve.
        side: usize,
    },
    /// (C1) A principal normal is not normal to the tangent plane at a corner.
    #[error(
        "C1: the normal of curve {side} leaves the surface normal at corner {corner} (sine {sine:e})"
    )]
    C1 {
        /// The corner.
        corner: Corner,
        /// The curve.
        side: usize,
        /// The sine of the angle between the two normals.
        sine: f64,
    },
    /// (C3) The crossing identity fails at a corner.
    #[error("C3: the crossing identity fails at corner {corner} (relative residual {residual:e})")]
    C3 {
        /// The corner.
        corner: Corner,
        /// The residual of (3.7), relative to `1 + k1 + k2 + |tau1| + |tau2|` in units of the boundary's size.
        residual: f64,
    },
    /// (C2) The principal normal reverses an odd number of times around the boundary.
    #[error("C2: the principal normal reverses {reversals} times around the boundary")]
    C2 {
        /// The number of reversals.
        reversals: usize,
    },
}

impl Violation {
    /// The short name of the condition violated: `corner mismatch`, `irregular curve`, `parallel tangents`,
    /// `inflection`, `C1`, `C3` or `C2`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::CornerMismatch { .. } => "corner mismatch",
            Self::IrregularCurve { .. } => "irregular curve",
            Self::ParallelTangents { .. } => "parallel tangents",
            Self::InflectionAtCorner { .. } => "inflection",
            Self::C1 { .. } => "C1",
            Self::C3 { .. } => "C3",
            Self::C2 { .. } => "C2",
        }
    }

    /// The corner at which it was found; `None` for C2, which concerns the whole boundary.
    #[must_use]
    pub fn corner(&self) -> Option<Corner> {
        match *self {
            Self::CornerMismatch { corner, .. }
            | Self::IrregularCurve { corner, .. }
            | Self::ParallelTangents { corner, .. }
            | Self::InflectionAtCorner { corner, .. }
            | Self::C1 { corner, .. }
            | Self::C3 { corner, .. } => Some(corner),
            Self::C2 { .. } => None,
        }
    }
}

/// What the conditions say about a boundary.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BoundaryReport {
    /// Everything wrong, corner by corner, C2 last.
    pub violations: Vec<Violation>,
    /// Reversals of the principal normal around the boundary, corners and inflections included.
    pub reversals: usize,
    /// Where the normal of a curve reverses inside: curve and parameter.
    pub inflections: Vec<(usize, f64)>,
    /// The largest relative residual of C3 over the corners at which it could be measured.
    pub c3_residual: f64,
}

impl BoundaryReport {
    /// The report, if these strips can bound a surface as geodesics.
    pub(crate) fn admit<S: Strip>(self, strips: &[S]) -> Result<Self, Error> {
        if !self.violations.is_empty() {
            return Err(Error::Conditions(self.violations));
        }
        let impassable = |(side, _): &&(usize, f64)| !strips[*side].passes_inflections();
        match self.inflections.iter().find(impassable) {
            Some(&(side, t)) => Err(Error::Inflection { side, t }),
            None => Ok(self),
        }
    }
}

/// Tolerance of the conditions unless another is asked for, relative to the size of the boundary: well above
/// the rounding of third derivatives, and small enough that the geodesic curvature a mismatch leaves (some
/// hundredths of it) stays below 1e-8.
pub const CONDITION_TOLERANCE: f64 = 1e-8;
/// Rounding of a coordinate of a curve's end, relative to it.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Sine below which two curves at a corner count as touching.
const PARALLEL: f64 = 1e-6;
/// Curvature times size below which a corner counts as an inflection.
const NO_CURVATURE: f64 = 1e-10;

/// One of the two curves at a corner: which, where, and how its direction at the corner is oriented against
/// its parameter (for the tangents of triangles, which all point away from the vertex).
#[derive(Clone, Copy, Debug)]
pub(crate) struct CornerCurve {
    pub(crate) side: usize,
    pub(crate) t: f64,
    pub(crate) outward: f64,
}

/// A corner with what the conditions need to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CornerCurves {
    pub(crate) corner: Corner,
    pub(crate) first: CornerCurve,
    pub(crate) second: CornerCurve,
}

/// Checks a closed boundary: its corners, and the way around it as `(side, reversed)`.
pub(crate) fn check<S: Strip>(
    strips: &[S],
    corners: &[CornerCurves],
    around: &[(usize, bool)],
    tolerance: f64,
) -> BoundaryReport {
    let samples: Vec<[StripSample; 2]> = strips
        .iter()
        .map(|strip| [strip.sample(0.0), strip.sample(1.0)])
        .collect();
    let at = |curve: CornerCurve| samples[curve.side][usize::from(curve.t > 0.5)];
    let size = samples
        .iter()
        .map(|[a, b]| a.point[0].distance(b.point[0]))
        .fold(0.0, f64::max);
    let passing: Vec<bool> = strips.iter().map(Strip::passes_inflections).collect();
    let mut report = BoundaryReport::default();
    let mut countable = true;
    for CornerCurves {
        corner,
        first,
        second,
    } in corners
    {
        let found = corner_violation(
            *corner,
            [(*first, at(*first)), (*second, at(*second))],
            &passing,
            size,
            tolerance,
        );
        countable &= !matches!(
            found,
            Err(Violation::IrregularCurve { .. } | Violation::InflectionAtCorner { .. })
        );
        match found {
            Ok(residual) => report.c3_residual = report.c3_residual.max(residual),
            Err(violation) => {
                if let Violation::C3 { residual, .. } = violation {
                    report.c3_residual = report.c3_residual.max(residual);
                }
                report.violations.push(violation);
            }
        }
    }
    if countable {
        count_reversals(strips, around, &mut report);
        if !report.reversals.is_multiple_of(2) {
            report.violations.push(Violation::C2 {
                reversals: report.reversals,
            });
        }
    }
    report
}

/// The first condition that a corner violates, or the relative residual of C3.
fn corner_violation(
    corner: Corner,
    curves: [(CornerCurve, StripSample); 2],
    passes_inflections: &[bool],
    size: f64,
    tolerance: f64,
) -> Result<f64, Violation> {
    let [p, q] = curves.map(|(_, sample)| sample.point[0]);
    let distance = p.distance(q);
    let rounding = ROUNDING * p.abs().max_element();
    // Negated, so that NaN counts as wrong.
    if !(distance <= tolerance * size + rounding) {
        return Err(Violation::CornerMismatch { corner, distance });
    }
    let mut tangents = [DVec3::ZERO; 2];
    for (tangent, (curve, sample)) in tangents.iter_mut().zip(&curves) {
        *tangent = sample.point[1].normalize_or_zero() * curve.outward;
        if *tangent == DVec3::ZERO {
            return Err(Violation::IrregularCurve {
                corner,
                side: curve.side,
            });
        }
    }
    let cross = tangents[0].cross(tangents[1]);
    let sine = cross.length();
    if sine < PARALLEL {
        return Err(Violation::ParallelTangents { corner, sine });
    }
    let normal = cross / sine;
    for (curve, sample) in &curves {
        let [_, velocity, acceleration, _] = sample.point;
        let curved =
            velocity.cross(acceleration).length() > NO_CURVATURE * velocity.length_squared();
        let defined =
            sample.across[0] != DVec3::ZERO && sample.across.iter().all(|v| v.is_finite());
        if !defined || !(curved || passes_inflections[curve.side]) {
            return Err(Violation::InflectionAtCorner {
                corner,
                side: curve.side,
            });
        }
    }
    for (curve, sample) in &curves {
        let sine = sample.normal().cross(normal).length();
        if !(sine <= tolerance) {
            return Err(Violation::C1 {
                corner,
                side: curve.side,
                sine,
            });
        }
    }
    let [first, second] = curves.map(|(_, sample)| signed_invariants(&sample, normal));
    let ([k1, tau1], [k2, tau2]) = (first, second);
    let cosine = tangents[0].dot(tangents[1]);
    let residual = ((tau1 + tau2) * sine - (k2 - k1) * cosine).abs() * size
        / (1.0 + size * (k1.abs() + k2.abs() + tau1.abs() + tau2.abs()));
    if residual <= tolerance {
        Ok(residual)
    } else {
        Err(Violation::C3 { corner, residual })
    }
}

/// Normal curvature `sigma k` and torsion of the strip at a corner. With `h = N x e` the torsion is the rate
/// at which `h` tilts towards `N`, `h' = tau v N`: for a curve with a principal normal this is its torsion, and
/// it exists at inflections of strips that pass them. Both are even in the direction of travel.
fn signed_invariants(sample: &StripSample, normal: DVec3) -> [f64; 2] {
    let speed = sample.point[1].length();
    let tangent = sample.point[1] / speed;
    let curvature = sample.point[2].dot(normal) / (speed * speed);
    // `across` is c h with c = across . h; its tilt towards N does not feel the change of c.
    let component = sample.across[0].dot(normal.cross(tangent));
    let torsion = sample.across[1].dot(normal) / (component * speed);
    [curvature, torsion]
}

/// Samples a side to begin with; refined where the normal turns.
const FIRST_SAMPLES: usize = 16;
/// A turn with a larger cosine than this between neighbouring samples is followed without refining.
const SMALL_TURN: f64 = 0.8;
/// Bisections before a change of sign counts as a reversal: 2^-34 of a sixteenth of the parameter range.
const BISECTIONS: u32 = 34;
/// Offset from an end at which a one-sided limit is taken when the end itself has no normal.
const LIMIT: f64 = 1e-6;

fn count_reversals<S: Strip>(strips: &[S], around: &[(usize, bool)], report: &mut BoundaryReport) {
    let mut ends: Vec<[DVec3; 2]> = Vec::with_capacity(around.len());
    for &(side, reversed) in around {
        let [start, end] = reversals(&strips[side], &mut |t| report.inflections.push((side, t)));
        ends.push(if reversed { [end, start] } else { [start, end] });
    }
    let corners = ends
        .iter()
        .zip(ends.iter().cycle().skip(1))
        .filter(|(a, b)| a[1].dot(b[0]) < 0.0)
        .count();
    report.reversals = report.inflections.len() + corners;
}

/// Finds the reversals of the principal normal along a strip; returns the normals at its ends.
fn reversals<S: Strip>(strip: &S, found: &mut impl FnMut(f64)) -> [DVec3; 2] {
    let normal = |t: f64| principal_normal(strip, t);
    let mut samples: Vec<(f64, DVec3)> = probes().map(|t| (t, normal(t))).collect();
    let last = samples.len() - 1;
    // At an end or a probe that is itself an inflection take the limit from inside.
    for (i, (t, n)) in samples.iter_mut().enumerate() {
        if *n == DVec3::ZERO {
            *t += if i == last { -LIMIT } else { LIMIT };
            *n = normal(*t);
        }
    }
    for pair in samples.windows(2) {
        follow(&normal, pair[0], pair[1], BISECTIONS, found);
    }
    [samples[0].1, samples[last].1]
}

fn probes() -> impl Iterator<Item = f64> {
    (0..=FIRST_SAMPLES).map(|i| i as f64 / FIRST_SAMPLES as f64)
}

/// Refuses a strip whose `across` reverses, or is undefined, at an inflection of its curve.
pub(crate) fn refuse_inflections<S: Strip>(strip: &S, side: usize) -> Result<(), Error> {
    if strip.passes_inflections() {
        return Ok(());
    }
    let mut first = probes().find(|t| principal_normal(strip, *t) == DVec3::ZERO);
    reversals(strip, &mut |t| {
        first = Some(first.map_or(t, |before| before.min(t)))
    });
    match first {
        Some(t) => Err(Error::Inflection { side, t }),
        None => Ok(()),
    }
}

/// Finds the reversals of a unit vector between two parameters.
fn follow(
    normal: &impl Fn(f64) -> DVec3,
    (a, start): (f64, DVec3),
    (b, end): (f64, DVec3),
    depth: u32,
    found: &mut impl FnMut(f64),
) {
    let cosine = start.dot(end);
    if cosine > SMALL_TURN || start == DVec3::ZERO || end == DVec3::ZERO {
        return;
    }
    let middle = 0.5 * (a + b);
    let mut here = (middle, normal(middle));
    if here.1 == DVec3::ZERO {
        // Exactly an inflection: step aside, the sides will show whether it reverses.
        here.0 = a + 0.499 * (b - a);
        here.1 = normal(here.0);
    }
    // So near an inflection that the normal is lost in rounding, the ends tell.
    if depth == 0 || here.1 == DVec3::ZERO {
        if cosine < 0.0 {
            found(middle);
        }
        return;
    }
    follow(normal, (a, start), here, depth - 1, found);
    follow(normal, here, (b, end), depth - 1, found);
}

/// The principal normal of the curve at `t`; of a straight curve the strip's normal; zero at an inflection.
fn principal_normal<S: Strip>(strip: &S, t: f64) -> DVec3 {
    let [_, velocity, acceleration] = strip.series(t).first_three();
    let across = velocity.cross(acceleration);
    let scale = velocity.length_squared();
    if across.length() > NO_CURVATURE * scale {
        across.cross(velocity).normalize_or_zero()
    } else if strip.is_straight() {
        strip.sample(t).normal()
    } else {
        DVec3::ZERO
    }
}
