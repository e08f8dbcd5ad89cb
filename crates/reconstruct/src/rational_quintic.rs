//! Rational boundaries of degree 5 from corner data, so that the conditions C1 and C3 hold by construction.
//!
//! Section 3.7 of the thesis chapter. C2 is to be checked afterwards: a curve may inflect between its ends.

use crate::Error;
use crate::corner::{CornerData, Corners, CurveEnd, SIDES, curve_ends, four};
use bezier_mass::{BezierCurve, MassPoint};
use core::array::from_fn;
use glam::DVec3;

/// Curvature and torsion of a curve at one end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EndInvariants {
    /// Curvature, not negative, one over length.
    pub curvature: f64,
    /// Torsion, one over length.
    pub torsion: f64,
}

/// A torsion below this part of the curvature is that of a plane curve to rounding.
const PLANAR: f64 = 1e-12;

impl EndInvariants {
    /// The torsion, exactly zero where it is zero to rounding.
    fn settled_torsion(self) -> f64 {
        if self.torsion.abs() <= PLANAR * self.curvature {
            0.0
        } else {
            self.torsion
        }
    }
}

/// Curvature and torsion at both ends of a rational quintic:
/// `k = (4/5) (w0 w2 / w1²) h / a²`, `tau = (3/5) (w0 w3 / (w1 w2)) c / (a h)`, with `a = |p1 - p0|`, `h` the
/// distance of `p2` from the line `p0 p1`, `c` the signed distance of `p3` from the plane `p0 p1 p2`.
///
/// # Errors
/// [`Error::NonFinite`] for points, and for results, that are not finite; [`Error::OutOfRange`] for a weight that is not positive, [`Error::ZeroVector`] for
/// coinciding end points, [`Error::Inflection`] for three collinear ones.
pub fn quintic_end_invariants(
    points: &[DVec3; 6],
    weights: &[f64; 6],
) -> Result<[EndInvariants; 2], Error> {
    if let Some(&value) = weights.iter().find(|w| !(w.is_finite() && **w > 0.0)) {
        return Err(Error::OutOfRange {
            what: "weight",
            value,
            range: [0.0, f64::INFINITY],
        });
    }
    let mut reversed = (*points, *weights);
    reversed.0.reverse();
    reversed.1.reverse();
    Ok([
        invariants_at_start(points, weights, 0)?,
        invariants_at_start(&reversed.0, &reversed.1, 1)?,
    ])
}

fn invariants_at_start(p: &[DVec3; 6], w: &[f64; 6], end: usize) -> Result<EndInvariants, Error> {
    if let Some(index) = p.iter().position(|p| !p.is_finite()) {
        return Err(Error::NonFinite {
            what: "control point",
            index,
        });
    }
    // In units of the largest coordinate, so that no product leaves the range.
    let legs = [1, 2, 3].map(|k| p[k] - p[0]);
    let size = legs
        .iter()
        .fold(0.0, |m: f64, leg| m.max(leg.abs().max_element()));
    let [first, second, third] = legs.map(|leg| if size > 0.0 { leg / size } else { leg });
    let a = first.length();
    if a == 0.0 {
        return Err(Error::ZeroVector {
            what: "end tangent",
            index: end,
        });
    }
    let across = first.cross(second);
    let h = across.length() / a;
    if h <= f64::EPSILON * second.length() {
        return Err(Error::Inflection {
            side: 0,
            t: end as f64,
        });
    }
    let c = third.dot(across.normalize());
    let curvature = 0.8 * (w[0] / w[1]) * (w[2] / w[1]) * h / (a * a) / size;
    let torsion = 0.6 * (w[0] / w[1]) * (w[3] / w[2]) * c / (a * h) / size;
    if !(curvature.is_finite() && torsion.is_finite()) {
        return Err(Error::NonFinite {
            what: "curvature or torsion at end",
            index: end,
        });
    }
    Ok(EndInvariants { curvature, torsion })
}

/// The weights `1, w1, .., w4, 1` with which a rational quintic has the wanted curvatures and torsions at its ends:
/// unique and positive, by a linear system in their logarithms. A torsion of zero is met where the control points
/// give zero already.
///
/// # Errors
/// [`Error::TorsionSign`] where a torsion has not the sign that the control points give it;
/// [`Error::OutOfRange`] for a curvature that is not positive; those of [`quintic_end_invariants`].
pub fn quintic_weights(points: &[DVec3; 6], wanted: [EndInvariants; 2]) -> Result<[f64; 6], Error> {
    let natural = quintic_end_invariants(points, &[1.0; 6])?;
    let mut logarithms = [[0.0; 2]; 2];
    for (end, (wanted, natural)) in wanted.into_iter().zip(natural).enumerate() {
        if !(wanted.curvature > 0.0 && wanted.curvature.is_finite()) {
            return Err(Error::OutOfRange {
                what: "curvature",
                value: wanted.curvature,
                range: [0.0, f64::INFINITY],
            });
        }
        let flat = natural.settled_torsion() == 0.0;
        let ratio = if wanted.torsion == 0.0 && flat {
            1.0
        } else {
            wanted.torsion / natural.torsion
        };
        if !(ratio > 0.0 && ratio.is_finite()) || (flat && wanted.torsion != 0.0) {
            return Err(Error::TorsionSign {
                end,
                wanted: wanted.torsion,
                natural: natural.torsion,
            });
        }
        logarithms[end] = [(wanted.curvature / natural.curvature).ln(), ratio.ln()];
    }
    // y - 2x = a, z - x - y = b, z - 2t = c, y - t - z = d for the logarithms x, y, z, t of w1..w4.
    let [[a, b], [c, d]] = logarithms;
    // y = a + 2x, z = a + b + 3x, t = (a + b - c + 3x) / 2; the last equation is then linear in x:
    // a + 2x - (a + b - c + 3x)/2 - (a + b + 3x) = d.
    let x = (-d - b - 0.5 * (a + b - c)) / 2.5;
    let (y, z) = (a + 2.0 * x, a + b + 3.0 * x);
    let t = 0.5 * (z - c);
    Ok([1.0, x.exp(), y.exp(), z.exp(), t.exp(), 1.0])
}

/// Lengths of the end legs `p0 p1` and of the next legs along the tangent, in parts of the chord, that are tried
/// for a rational quintic; the first is the plain fifth.
const LEGS: [[f64; 2]; 6] = [
    [0.2, 0.2],
    [0.2, 0.1],
    [0.2, 0.3],
    [0.15, 0.3],
    [0.3, 0.1],
    [0.1, 0.2],
];

/// Four rational quintic boundaries with the given corner data: points, tangent planes, osculating planes and
/// curvatures at the corners. Control points are laid out in the osculating planes so that the curvatures are met
/// with unit weights. The inner ones are slid along the end tangents to where unit weights give the torsions too, if
/// that is not far away; otherwise the torsions are split at each corner so that their signs fit, unless the corner asks
/// for a split ([`CornerData::with_torsion_difference`]). The weights follow.
///
/// # Errors
/// [`Error::CornerData`] for two corners at one point; [`Error::TorsionSign`] when at some corner no split, or the one
/// asked for, has with any of the layouts tried the right sum and signs.
pub fn rational_quintic_boundaries(corners: &Corners) -> Result<[BezierCurve<DVec3>; 4], Error> {
    let mut refusal = Error::TorsionSign {
        end: 0,
        wanted: 0.0,
        natural: 0.0,
    };
    let mut best: Option<(f64, [BezierCurve<DVec3>; 4])> = None;
    for (legs, slide) in LEGS
        .into_iter()
        .flat_map(|legs| [(legs, true), (legs, false)])
    {
        match quintic_layout(corners, legs, slide) {
            Ok((effort, curves)) => {
                if best.as_ref().is_none_or(|(least, _)| effort < *least) {
                    best = Some((effort, curves));
                }
            }
            Err(error @ Error::CornerData { .. }) => return Err(error),
            Err(error) => refusal = error,
        }
    }
    best.map(|(_, curves)| curves).ok_or(refusal)
}

/// The curves of one layout, with the largest logarithm of a weight.
fn quintic_layout(
    corners: &Corners,
    legs: [f64; 2],
    slide: bool,
) -> Result<(f64, [BezierCurve<DVec3>; 4]), Error> {
    let mut points = Vec::with_capacity(4);
    let mut natural = Vec::with_capacity(4);
    for side in SIDES {
        let (ends, chord) = curve_ends(corners, side)?;
        let control = quintic_control(&ends, chord, legs, slide);
        natural.push(quintic_end_invariants(&control, &[1.0; 6])?);
        points.push(control);
    }
    let mut wanted = natural.clone();
    for i in 0..2 {
        for j in 0..2 {
            let (along_u, along_v) = (2 * j, 1 + 2 * i);
            let naturals =
                [natural[along_u][i], natural[along_v][j]].map(EndInvariants::settled_torsion);
            let torsions = split_torsion(&corners[i][j], naturals)?;
            wanted[along_u][i].torsion = torsions[0];
            wanted[along_v][j].torsion = torsions[1];
        }
    }
    let mut effort: f64 = 0.0;
    let mut curves = Vec::with_capacity(4);
    for (control, wanted) in points.iter().zip(wanted) {
        let weights = quintic_weights(control, wanted)?;
        effort = weights.iter().fold(effort, |m, w| m.max(w.ln().abs()));
        if let Some(&value) = weights.iter().find(|w| w.ln().abs() > EXTREME_WEIGHT.ln()) {
            let range = [1.0 / EXTREME_WEIGHT, EXTREME_WEIGHT];
            return Err(Error::OutOfRange {
                what: "weight",
                value,
                range,
            });
        }
        let control = control
            .iter()
            .zip(weights)
            .map(|(p, w)| MassPoint::point(*p, w))
            .collect();
        curves.push(BezierCurve::new(control)?);
    }
    Ok((effort, four(curves)?))
}

/// Weights beyond this, or below its reciprocal, pull a curve into its control points and cost the digits that the
/// conditions need.
const EXTREME_WEIGHT: f64 = 1e3;
/// How far along the end tangents an inner control point may be slid, in parts of the chord.
const SLIDE: f64 = 0.8;

/// `p1` on the tangent, `p2` in the osculating plane on the side of the principal normal at the height that gives
/// the curvature with unit weights, `k = (4/5) h / a²`; the same at the other end. With `slide` the inner points move
/// along the tangents to where unit weights give the torsions as well, `tau = (3/5) c / (a h)`: the torsion at one end
/// depends on how far the inner point of the other lies from its osculating plane.
fn quintic_control(
    ends: &[CurveEnd; 2],
    chord: f64,
    [leg, next]: [f64; 2],
    slide: bool,
) -> [DVec3; 6] {
    let a = leg * chord;
    let forward = [1.0, -1.0];
    let height = |end: &CurveEnd| end.normal * (1.25 * end.curvature * a * a);
    let outer: [DVec3; 2] = from_fn(|k| ends[k].point + ends[k].tangent * (forward[k] * a));
    let inner: [DVec3; 2] = from_fn(|k| {
        let (mine, other) = (&ends[k], &ends[1 - k]);
        let base = outer[k] + height(mine);
        // The binormal of the other end as seen along its own way into the curve.
        let principal = other.normal * other.curvature.signum();
        let binormal = (other.tangent * forward[1 - k]).cross(principal);
        let wanted = other.torsion * a * height(other).length() / 0.6;
        let needed = (wanted - (base - other.point).dot(binormal)) / mine.tangent.dot(binormal);
        let slid = slide && needed.abs() <= SLIDE * chord;
        base + mine.tangent
            * if slid {
                needed
            } else {
                forward[k] * next * chord
            }
    });
    [
        ends[0].point,
        outer[0],
        inner[0],
        inner[1],
        outer[1],
        ends[1].point,
    ]
}

/// The torsions that the corner asks for, or else some with the wanted sum, each of the sign that its control points give.
fn split_torsion(corner: &CornerData, natural: [f64; 2]) -> Result<[f64; 2], Error> {
    let (sum, [a, b]) = (corner.torsion_sum(), natural);
    let split = if corner.torsion_difference() != 0.0 {
        corner.torsions()
    } else if a == 0.0 {
        [0.0, sum]
    } else if b == 0.0 {
        [sum, 0.0]
    } else if a * b > 0.0 {
        [sum * a / (a + b), sum * b / (a + b)]
    } else if (sum - a - b) * a >= 0.0 {
        // More of the sign of the first is needed: enlarge it.
        [sum - b, b]
    } else {
        [a, sum - a]
    };
    for (end, (wanted, natural)) in split.into_iter().zip(natural).enumerate() {
        if wanted * natural < 0.0 || (wanted == 0.0) != (natural == 0.0) {
            return Err(Error::TorsionSign {
                end,
                wanted,
                natural,
            });
        }
    }
    Ok(split)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invariants_scale_with_the_points() {
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [2.0, 0.5, 0.0],
            [3.0, 1.0, 0.4],
            [4.0, 1.2, 1.0],
            [5.0, 1.0, 1.5],
        ]
        .map(DVec3::from_array);
        let plain = quintic_end_invariants(&points, &[1.0; 6]).unwrap();
        for scale in [1e-170, 1e170] {
            let scaled = quintic_end_invariants(&points.map(|p| p * scale), &[1.0; 6]).unwrap();
            for (a, b) in scaled.iter().zip(&plain) {
                assert!((a.curvature * scale / b.curvature - 1.0).abs() < 1e-14);
                assert!((a.torsion * scale / b.torsion - 1.0).abs() < 1e-14);
            }
        }
        let uneven = quintic_end_invariants(&points, &[1e300, 1e-300, 1e300, 1.0, 1.0, 1.0]);
        assert!(matches!(uneven, Err(Error::NonFinite { index: 0, .. })));
    }
}
