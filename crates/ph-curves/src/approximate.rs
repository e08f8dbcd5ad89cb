//! G2 approximation of plane curves by PH arcs: cut at inflections, interpolate curvature elements, measure, go on.

use crate::course::Course;
use crate::cover::Cover;
use crate::{ArcSpline, Error, Joint, PlaneCurve};

/// How a curve is approximated: [`Approximation::within`] a tolerance, unless the arcs have to be of lowest degree.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approximation {
    /// Largest distance allowed between the curve and the spline, measured between tangents with the same normal; it
    /// is then the same for all offsets. In plane units.
    pub tolerance: f64,
    /// The class of the arcs.
    pub arcs: Arcs,
    /// For class 3, the tension of the pairs of arcs, in (0, 1); 1/2 gives order 5, any other value order 3.
    pub beta: f64,
    /// For class 3, curvature continuity wherever its arcs allow it (everywhere but at inflections, cusps and corners);
    /// [`Joint::G1`] needs about half the arcs for a continuous tangent alone.
    pub continuity: Joint,
}

/// The class of the arcs of an approximation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Arcs {
    /// Single PH arcs of class 9, rational of degree 10, which take point, tangent and curvature at both ends and up to
    /// four supports in between; of degree 11 about an inflection. Order 10, G2 through inflections and over knots: few
    /// pieces, and the least time.
    #[default]
    Class9,
    /// The same, with up to nine supports in between where that makes an arc longer: class 14, rational of degree 15. The fewest
    /// arcs, also over knots where the third derivative of a spline jumps.
    Class14,
    /// Pairs of Tschirnhausen quartics: lowest degree, monotone curvature on every arc, the curve's vertices kept.
    /// Order 5, G1 at inflections, in pieces that shrink towards them.
    Class3,
}

impl Approximation {
    /// G2 within `tolerance`, by arcs of class 9.
    #[must_use]
    pub const fn within(tolerance: f64) -> Self {
        Self {
            tolerance,
            arcs: Arcs::Class9,
            beta: 0.5,
            continuity: Joint::G2,
        }
    }

    /// The same by the fewest arcs, of class up to 14.
    #[must_use]
    pub const fn fewest(tolerance: f64) -> Self {
        Self {
            arcs: Arcs::Class14,
            ..Self::within(tolerance)
        }
    }

    /// G2 within `tolerance` but for inflections, by Tschirnhausen quartics of monotone curvature with tension 1/2.
    #[must_use]
    pub const fn quartics(tolerance: f64) -> Self {
        Self {
            arcs: Arcs::Class3,
            ..Self::within(tolerance)
        }
    }
}

/// The spline that approximates a curve, with what was measured on the way.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approximated {
    /// The spline.
    pub spline: ArcSpline,
    /// The largest difference of supports found at inner samples of every piece, times a factor for the peaks between
    /// them: what the tolerance was held against. See the crate's limits.
    pub error: f64,
    /// For every piece of the spline the parameter interval of the curve that it was made from (span number plus local
    /// parameter); the arcs of a pair share theirs. Corners have an empty interval.
    pub sources: Vec<[f64; 2]>,
    /// Number of joints without continuous curvature.
    pub g1_joints: usize,
    /// Number of corners (points where the normal turns), cusps included.
    pub corners: usize,
}

/// Smallest tolerance in units of the last place of the largest coordinate.
const LEAST_TOLERANCE_ULPS: f64 = 64.0;

/// Approximates `curve` by a spline of PH arcs and segments.
///
/// The curve is cut at corners, cusps and straight spans, which stay segments. What lies between is covered from start to end by
/// arcs of class 9 or 14, each as long as the tolerance allows, which interpolate the curve's elements at their ends with G2 contact and
/// tangents in between. They run over knots with continuous curvature and through inflections, one each; near an inflection the
/// arc is about it ([`InflectedArc`](crate::InflectedArc)). Circular arcs stay exact. Corners and cusps become fans of normals.
///
/// [`Arcs::Class3`] cuts at knots, inflections and vertices too, and gives every part of monotone curvature two arcs
/// ([`G2Pair`](crate::G2Pair)); it has no curvature to match at inflections, where the policy is one G1 arc on the adjacent part, in
/// parts that shrink towards the point. So do all classes at cusps.
///
/// # Errors
/// [`Error::BadTolerance`], [`Error::TensionOutOfRange`]; [`Error::ToleranceTooSmall`] with the resolution at this size;
/// [`Error::NonFinite`] if the curve has points at infinity; [`Error::SinglePoint`]; [`Error::NotConverged`].
pub fn approximate<C: PlaneCurve + ?Sized>(
    curve: &C,
    how: &Approximation,
) -> Result<Approximated, Error> {
    if !(how.tolerance > 0.0 && how.tolerance.is_finite()) {
        return Err(Error::BadTolerance {
            tolerance: how.tolerance,
        });
    }
    if !(how.beta > 0.0 && how.beta < 1.0) {
        return Err(Error::TensionOutOfRange { beta: how.beta });
    }
    // Arcs of class 3 cannot have a curvature of zero.
    let flattened = match how.arcs {
        Arcs::Class9 | Arcs::Class14 => how.tolerance,
        Arcs::Class3 => 0.0,
    };
    let course = Course::new(curve, flattened)?;
    let resolution = LEAST_TOLERANCE_ULPS * course.rounding;
    if how.tolerance < resolution {
        return Err(Error::ToleranceTooSmall {
            tolerance: how.tolerance,
            resolution,
        });
    }
    let mut cover = Cover::new(course, how);
    cover.curve()?;
    cover.finish()
}
