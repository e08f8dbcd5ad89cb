//! Where a curve bends the other way, where its curvature is extremal, where it turns back.

use crate::course::End;
use crate::plane_curve::merge;
use crate::{BreakKind, Error, PlaneCurve, Side};

/// Inflections and vertices of a curve by their global parameters: span number plus local parameter.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Breakpoints {
    /// Parameters at which the curvature changes sign.
    pub inflections: Vec<f64>,
    /// Parameters at which the derivative of the curvature changes sign, knots included.
    pub vertices: Vec<f64>,
    /// Parameters at which the tangent reverses.
    pub cusps: Vec<f64>,
}

/// The inflections, vertices and cusps of a curve, including those at its knots: a vertex there is a change of sign of
/// the one-sided derivatives of the curvature.
///
/// # Errors
/// [`Error::NonFinite`] if the curve has points at infinity.
pub fn breakpoints<C: PlaneCurve + ?Sized>(curve: &C) -> Result<Breakpoints, Error> {
    let mut found = Breakpoints::default();
    let mut cuts = Vec::new();
    // Sign of the curvature and of its change over the part before.
    let mut before: Option<(f64, f64)> = None;
    for span in 0..curve.spans() {
        cuts.clear();
        curve.inflections(span, &mut cuts);
        curve.vertices(span, &mut cuts);
        merge(&mut cuts);
        if curve.is_straight(span) {
            found
                .cusps
                .extend(cuts.iter().map(|cut| span as f64 + cut.t));
            before = None;
            continue;
        }
        let mut kind = None;
        let mut start = End::at(curve, span, 0.0, Side::After)?;
        for cut in cuts.iter().map(Some).chain([None]) {
            let end = match cut {
                Some(cut) => End::at_break(curve, span, *cut, Side::Before)?,
                None => End::at(curve, span, 1.0, Side::Before)?,
            };
            let middle = End::at(curve, span, 0.5 * (start.t + end.t), Side::After)?.curvature;
            let signs = (middle.signum(), (end.curvature - start.curvature).signum());
            let at = start.parameter();
            match (kind, before) {
                (Some(BreakKind::Cusp), _) => found.cusps.push(at),
                (_, Some((sign, _))) if sign != signs.0 => found.inflections.push(at),
                (_, Some((_, change))) if change != signs.1 => found.vertices.push(at),
                _ => {}
            }
            before = Some(signs);
            kind = cut.map(|cut| cut.kind);
            if let Some(cut) = cut {
                start = End::at_break(curve, span, *cut, Side::After)?;
            }
        }
    }
    Ok(found)
}
