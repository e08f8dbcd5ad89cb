//! Ovals of constant Minkowski width.

use std::f64::consts::PI;

use super::{DualIndicatrix, IsoperimetricArc, Support};
use crate::{DualCurve, Error, SupportJet};

/// The support function `width/2 P + o`, `o` the odd part `(p(ψ) - p(ψ + π)) / 2` of any curve: the supports in opposite
/// directions add up to the width times the support of the indicatrix.
#[derive(Clone, Copy, Debug)]
pub struct ConstantMinkowskiWidth<S, C> {
    /// The indicatrix.
    pub indicatrix: S,
    /// The curve whose odd part is taken.
    pub shape: C,
    /// The width, in the norm of the indicatrix.
    pub width: f64,
}

impl<S: Support, C: Support> Support for ConstantMinkowskiWidth<S, C> {
    fn jet(&self, psi: f64) -> SupportJet {
        let (unit, here, there) = (
            self.indicatrix.jet(psi),
            self.shape.jet(psi),
            self.shape.jet(psi + PI),
        );
        let combine = |unit: f64, here: f64, there: f64| 0.5 * (self.width * unit + here - there);
        SupportJet {
            support: combine(unit.support, here.support, there.support),
            slope: combine(unit.slope, here.slope, there.slope),
            bend: combine(unit.bend, here.bend, there.bend),
        }
    }
}

/// A rational oval of constant Minkowski width, exactly: over the arcs of half an indicatrix, the lines of the homothetic
/// copy of diameter `width` are translated by `moves` (distances in the scale of the arc's normals), and the other
/// half is the general inner offset of this one at the width.
///
/// Where the first and last three moves of an arc are zero it keeps its G2 contact with the copy at its ends, so that the
/// oval is G2.
///
/// # Errors
///
/// [`Error::TooFew`] unless there is a list of moves for each arc with one move a line; the errors of
/// [`DualIndicatrix::try_new`] if the arcs are not half an indicatrix; [`Error::NotRegular`] with the first arc whose
/// curvature is not proved positive; [`Error::Gap`] where the moves tear the oval.
pub fn constant_width_arcs(
    half: &[DualCurve],
    width: f64,
    moves: &[Vec<f64>],
) -> Result<Vec<IsoperimetricArc>, Error> {
    if half.is_empty() || half.len() != moves.len() {
        return Err(Error::TooFew {
            what: "lists of moves",
            given: moves.len(),
            needed: half.len().max(1),
        });
    }
    DualIndicatrix::try_new(half.to_vec())?;
    let moved = half.iter().zip(moves).map(|(arc, moves)| {
        let (given, needed) = (moves.len(), arc.vectors().len());
        if given != needed {
            return Err(Error::TooFew {
                what: "moves of an arc",
                given,
                needed,
            });
        }
        let supports: Vec<f64> = arc
            .vectors()
            .iter()
            .zip(moves)
            .map(|(line, m)| -0.5 * width * line.x + m)
            .collect();
        IsoperimetricArc::from_supports(arc.clone(), &supports)
    });
    let mut arcs = moved.collect::<Result<Vec<_>, _>>()?;
    let antipodes = arcs
        .iter()
        .map(|arc| arc.antipode(width))
        .collect::<Result<Vec<_>, _>>()?;
    arcs.extend(antipodes);
    for (index, arc) in arcs.iter().enumerate() {
        let (next, curve) = (&arcs[(index + 1) % arcs.len()], arc.curve());
        let (start, end) = (curve.contact(0.0)?, curve.contact(1.0)?);
        if !arc.is_regular() {
            return Err(Error::NotRegular {
                index,
                radii: [start.radius, end.radius],
            });
        }
        let distance = end.point.distance(next.curve().contact(0.0)?.point);
        if distance.is_nan() || distance > JOINT_TOLERANCE * end.point.distance(start.point) {
            return Err(Error::Gap { index, distance });
        }
    }
    Ok(arcs)
}

/// Consecutive arcs must meet to this share of their chord: far above rounding, far below anything that shows.
const JOINT_TOLERANCE: f64 = 1e-8;

#[cfg(test)]
mod tests {
    use super::super::{Bumped, DualIndicatrix};
    use super::*;

    fn moves(height: f64) -> Vec<Vec<f64>> {
        let arc = |sign: f64| {
            let mut moves = vec![0.0; 9];
            moves[3..6].copy_from_slice(&[sign * height, 0.5 * height, -sign * height]);
            moves
        };
        vec![arc(1.0), arc(-1.0)]
    }

    #[test]
    fn a_rational_oval_has_constant_minkowski_width_and_is_g2() {
        let bumped = Bumped { height: 0.03 };
        let half: DualIndicatrix = bumped.dual().unwrap();
        let arcs = constant_width_arcs(half.arcs(), 4.0, &moves(0.02)).unwrap();
        assert_eq!(arcs.len(), 4);
        for i in 0..4 {
            let end = arcs[i].curve().contact(1.0).unwrap();
            let start = arcs[(i + 1) % 4].curve().contact(0.0).unwrap();
            assert!((end.point - start.point).length() < 1e-12);
            assert!((end.radius - start.radius).abs() < 1e-10);
        }
        for (arc, opposite) in [(0, 2), (1, 3)] {
            for i in 0..=10 {
                let t = f64::from(i) / 10.0;
                let contact = arcs[arc].curve().contact(t).unwrap();
                let other = arcs[opposite].curve().contact(t).unwrap();
                assert!((contact.normal + other.normal).length() < 1e-13);
                let width = (contact.support + other.support)
                    / bumped.jet(contact.normal.to_angle()).support;
                assert!((width - 4.0).abs() < 1e-12);
            }
        }
        assert!(matches!(
            constant_width_arcs(half.arcs(), 4.0, &moves(1.0)),
            Err(Error::NotRegular { .. })
        ));
        assert!(matches!(
            constant_width_arcs(half.arcs(), 4.0, &[]),
            Err(Error::TooFew { .. })
        ));
        let quarter = bumped.arc(0.0, 1.0).unwrap();
        assert!(matches!(
            constant_width_arcs(&[quarter], 4.0, &[vec![0.0; 9]]),
            Err(Error::Gap { .. })
        ));
        let mut torn = moves(0.0);
        torn[0][8] = 0.01;
        assert!(matches!(
            constant_width_arcs(half.arcs(), 4.0, &torn),
            Err(Error::Gap { index: 0, .. })
        ));
    }

    #[test]
    fn the_odd_part_of_any_curve_makes_one() {
        let shape = |psi: f64| SupportJet {
            support: 0.1 * (3.0 * psi).cos() + psi.sin(),
            slope: 0.0,
            bend: 0.0,
        };
        let oval = ConstantMinkowskiWidth {
            indicatrix: Bumped { height: 0.03 },
            shape,
            width: 3.0,
        };
        for i in 0..20 {
            let psi = 0.3 * f64::from(i);
            let sum = oval.jet(psi).support + oval.jet(psi + PI).support;
            assert!((sum - 3.0 * oval.indicatrix.jet(psi).support).abs() < 1e-14);
        }
    }
}
