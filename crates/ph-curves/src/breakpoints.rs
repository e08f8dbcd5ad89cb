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

/// The inflections, vertices and cusps of a curve, including those at its knots and at the seam of a closed curve: a
/// vertex there is a change of sign of the one-sided derivatives of the curvature. What changes across straight spans or
/// circular arcs is listed where they end.
///
/// # Errors
/// [`Error::NonFinite`] if the curve has points at infinity.
pub fn breakpoints<C: PlaneCurve + ?Sized>(curve: &C) -> Result<Breakpoints, Error> {
    let mut found = Breakpoints::default();
    let mut cuts = Vec::new();
    // Of the part before and of the first one: the sign of the curvature, and that of its change.
    let (mut bend, mut change) = (Signs::default(), Signs::default());
    for span in 0..curve.spans() {
        cuts.clear();
        curve.inflections(span, &mut cuts);
        curve.vertices(span, &mut cuts);
        merge(&mut cuts);
        if curve.is_straight(span) {
            found
                .cusps
                .extend(cuts.iter().map(|cut| span as f64 + cut.t));
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
            let at = start.parameter();
            let bends = bend.go_on(middle.signum(), at);
            let changes = !end.has_curvature_of(&start)
                && change.go_on((end.curvature - start.curvature).signum(), at);
            if kind == Some(BreakKind::Cusp) {
                found.cusps.push(at);
            } else if bends {
                found.inflections.push(at);
            } else if changes {
                found.vertices.push(at);
            }
            kind = cut.map(|cut| cut.kind);
            if let Some(cut) = cut {
                start = End::at_break(curve, span, *cut, Side::After)?;
            }
        }
    }
    if curve.is_closed() {
        if let Some(at) = bend.at_seam() {
            found.inflections.insert(0, at);
        } else if let Some(at) = change.at_seam() {
            found.vertices.insert(0, at);
        }
    }
    Ok(found)
}

/// A sign along a curve: that of the first part with the parameter of its start, and that of the last part so far.
#[derive(Clone, Copy, Debug, Default)]
struct Signs {
    first: Option<(f64, f64)>,
    last: Option<f64>,
}

impl Signs {
    /// Takes the sign of the next part, which starts at this parameter; whether it is another one.
    fn go_on(&mut self, sign: f64, parameter: f64) -> bool {
        self.first.get_or_insert((sign, parameter));
        self.last.replace(sign).is_some_and(|last| last != sign)
    }

    /// The start of the first part, if the last part has another sign.
    fn at_seam(&self) -> Option<f64> {
        let ((first, parameter), last) = (self.first?, self.last?);
        (first != last).then_some(parameter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::CubicPath;
    use glam::{DVec2, dvec2};

    #[test]
    fn the_seam_is_a_knot_like_others() {
        // An ellipse of four cubics: the knots are its vertices.
        let handle = 0.552_284_749_8;
        let half_axes = dvec2(3.0, 1.0);
        let quarter = [DVec2::X, dvec2(1.0, handle), dvec2(handle, 1.0), DVec2::Y];
        let cubics: Vec<[DVec2; 4]> = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y]
            .iter()
            .map(|turn| quarter.map(|p| half_axes * turn.rotate(p)))
            .collect();
        for start in 0..4 {
            let mut cubics = cubics.clone();
            cubics.rotate_left(start);
            let found = breakpoints(&CubicPath::new(cubics, true).unwrap()).unwrap();
            for knot in [0.0, 1.0, 2.0, 3.0] {
                assert!(found.vertices.contains(&knot), "{start}: {found:?}");
            }
            assert!(found.inflections.is_empty() && found.cusps.is_empty());
        }
    }

    #[test]
    fn an_inflection_may_lie_at_the_seam_or_on_a_straight_span() {
        // An eight of two loops that cross, smooth, in the middle: 0 and 1.
        let lobe = [
            dvec2(0.0, 0.0),
            dvec2(4.0, 3.0),
            dvec2(4.0, -3.0),
            dvec2(0.0, 0.0),
        ];
        let eight = CubicPath::new(vec![lobe, lobe.map(|p| dvec2(-p.x, p.y))], true).unwrap();
        assert_eq!(breakpoints(&eight).unwrap().inflections, [0.0, 1.0]);
        let left = [
            dvec2(-3.0, 2.0),
            dvec2(-2.0, 0.5),
            dvec2(-1.5, 0.0),
            dvec2(-1.0, 0.0),
        ];
        let straight = [-1.0, -0.5, 0.5, 1.0].map(|x| dvec2(x, 0.0));
        let right = left.map(|p| -p);
        let right = [right[3], right[2], right[1], right[0]];
        let path = CubicPath::new(vec![left, straight, right], false).unwrap();
        assert_eq!(breakpoints(&path).unwrap().inflections, [2.0]);
    }
}
