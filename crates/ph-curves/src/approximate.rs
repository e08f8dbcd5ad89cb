//! G2 approximation of plane curves by PH arcs: cut at inflections, interpolate curvature elements, measure, cut again.

use glam::DVec2;

use crate::fit::{Attempt, End, Fit, Fitter, Interval, regular, tagged};
use crate::piece::Segment;
use crate::plane_curve::merge;
use crate::{
    ArcSpline, Break, BreakKind, Error, Joint, Piece, PlacedArc, PlaneCurve, Side, TQuartic,
};

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
    /// four supports in between; of degree 11 where one end is an inflection. Order 10, G2 across inflections: the fewest
    /// pieces, and the least time.
    #[default]
    Class9,
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

/// Angle between tangents that makes a corner, far above the rounding of computed tangents.
const CORNER: f64 = 1e-9;
/// Largest turning of a fan of normals at a corner, which must stay below pi.
const FAN: f64 = 1.6;
/// Order of the pairs of class 3, which tells into how many parts a failed attempt is cut.
const PAIR_ORDER: f64 = 5.0;
/// Order of the arcs of class 9.
const WIDE_ORDER: f64 = 10.0;
/// Share of a part next to an inflection or cusp: the error there falls with its third power.
const GRADING: f64 = 0.3;
/// Most parts of one cut.
const MOST_PARTS: f64 = 16.0;
/// Cuts of cuts after which a piece is given up.
const MOST_DEPTH: u32 = 48;
/// Smallest tolerance in units of the last place of the largest coordinate.
const LEAST_TOLERANCE_ULPS: f64 = 64.0;

/// Approximates `curve` by a spline of PH arcs and segments.
///
/// The curve is cut at its knots, inflections and cusps. Every part gets one arc of class 9 that interpolates the elements
/// at its ends with G2 contact, and begins in the inflection where one of them is; where the measured error exceeds the
/// tolerance, the part is cut further. Straight spans stay segments, circular arcs stay exact. Corners and cusps become fans
/// of normals.
///
/// [`Arcs::Class3`] cuts at vertices too, and gives every part of monotone curvature two arcs ([`G2Pair`](crate::G2Pair)); it has no
/// curvature to match at inflections, where the policy is one G1 arc on the adjacent part, in parts that shrink towards the
/// point. So do both classes at cusps.
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
    let mut builder = Builder::new(curve, how)?;
    let mut cuts = Vec::new();
    for span in 0..curve.spans() {
        cuts.clear();
        curve.inflections(span, &mut cuts);
        if how.arcs == Arcs::Class3 {
            curve.vertices(span, &mut cuts);
        }
        merge(&mut cuts);
        builder.span(span, &cuts)?;
    }
    builder.finish()
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
            let end = End::at(curve, span, cut.map_or(1.0, |cut| cut.t), Side::Before)?;
            let end_curvature = cut.map_or(end.curvature, |cut| tagged(end.curvature, cut.kind));
            let middle = End::at(curve, span, 0.5 * (start.t + end.t), Side::After)?.curvature;
            let signs = (middle.signum(), (end_curvature - start.curvature).signum());
            let at = span as f64 + start.t;
            match (kind, before) {
                (Some(BreakKind::Cusp), _) => found.cusps.push(at),
                (_, Some((sign, _))) if sign != signs.0 => found.inflections.push(at),
                (_, Some((_, change))) if change != signs.1 => found.vertices.push(at),
                _ => {}
            }
            before = Some(signs);
            kind = cut.map(|cut| cut.kind);
            start = End::at(curve, span, end.t, Side::After)?;
            start.curvature = kind.map_or(start.curvature, |kind| tagged(start.curvature, kind));
        }
    }
    Ok(found)
}

struct Builder<'a, C: ?Sized> {
    fitter: Fitter<'a, C>,
    curve: &'a C,
    how: &'a Approximation,
    /// Greatest extent of coordinates, for thresholds that are mere rounding.
    rounding: f64,
    pieces: Vec<Piece>,
    joints: Vec<Joint>,
    sources: Vec<[f64; 2]>,
    error: f64,
    corners: usize,
    stack: Vec<Interval>,
    /// The end of what was built so far, and whether the last piece has its curvature.
    last: Option<(End, bool)>,
    /// The start of the first piece, likewise.
    first: Option<(End, bool)>,
    /// The curve's own tangent where the construction stands; a bridge arrives there with another one.
    tangent_at_end: Option<End>,
}

impl<'a, C: PlaneCurve + ?Sized> Builder<'a, C> {
    fn new(curve: &'a C, how: &'a Approximation) -> Result<Self, Error> {
        let mut largest = 0.0_f64;
        for span in 0..curve.spans() {
            for t in [0.0, 0.5, 1.0] {
                let [point, ..] = curve.jet(span, t);
                if !point.is_finite() {
                    return Err(Error::NonFinite {
                        what: "a point of the curve",
                    });
                }
                largest = largest.max(point.abs().max_element());
            }
        }
        let rounding = f64::EPSILON * largest;
        if how.tolerance < LEAST_TOLERANCE_ULPS * rounding {
            return Err(Error::ToleranceTooSmall {
                tolerance: how.tolerance,
                resolution: LEAST_TOLERANCE_ULPS * rounding,
            });
        }
        let room = 2 * curve.spans() + 8;
        Ok(Self {
            fitter: Fitter { curve, how },
            curve,
            how,
            rounding,
            pieces: Vec::with_capacity(room),
            joints: Vec::with_capacity(room),
            sources: Vec::with_capacity(room),
            error: 0.0,
            corners: 0,
            stack: Vec::with_capacity(16),
            last: None,
            first: None,
            tangent_at_end: None,
        })
    }

    /// Adds one span, cut at the given places.
    fn span(&mut self, span: usize, cuts: &[Break]) -> Result<(), Error> {
        let straight = self.curve.is_straight(span);
        let mut start = End::at(self.curve, span, 0.0, Side::After)?;
        for cut in cuts.iter().map(Some).chain([None]) {
            let t = cut.map_or(1.0, |cut| cut.t);
            let mut end = End::at(self.curve, span, t, Side::Before)?;
            if let Some(cut) = cut {
                end.curvature = tagged(end.curvature, cut.kind);
            }
            if straight {
                self.straight(span, start, end)?;
            } else {
                self.monotone(Interval {
                    span,
                    start,
                    end,
                    depth: 0,
                })?;
            }
            start = match cut.map(|cut| cut.kind) {
                Some(BreakKind::Cusp) => {
                    let mut next = End::at(self.curve, span, t, Side::After)?;
                    next.curvature = f64::INFINITY.copysign(next.curvature);
                    next
                }
                _ => end,
            };
        }
        Ok(())
    }

    fn straight(&mut self, span: usize, start: End, end: End) -> Result<(), Error> {
        if start.point == end.point {
            return Ok(());
        }
        let segment = Segment::new(start.point, end.point)?;
        let at = |end: End| End {
            normal: segment.normal,
            curvature: 0.0,
            ..end
        };
        let joint = self.join(span, &at(start), true)?;
        let source = [start.t, end.t].map(|t| span as f64 + t);
        self.push(Piece::Segment(segment), source, joint);
        self.last = Some((at(end), true));
        self.tangent_at_end = Some(at(end));
        Ok(())
    }

    /// Adds a part without inflection, cut until each part is within the tolerance.
    fn monotone(&mut self, whole: Interval) -> Result<(), Error> {
        self.stack.push(whole);
        while let Some(interval) = self.stack.pop() {
            let attempt = self.fitter.attempt(&interval);
            let excess = attempt
                .as_ref()
                .map_or(f64::INFINITY, |a| a.error / self.how.tolerance);
            match attempt {
                Some(attempt) if excess <= 1.0 => {
                    self.error = self.error.max(attempt.error);
                    self.accept(&interval, &attempt)?;
                }
                _ if interval.depth >= MOST_DEPTH => {
                    return Err(Error::NotConverged {
                        start: interval.span as f64 + interval.start.t,
                        end: interval.span as f64 + interval.end.t,
                        excess,
                        depth: interval.depth,
                    });
                }
                _ => self.cut(&interval, excess)?,
            }
        }
        Ok(())
    }

    /// Pushes the parts of an interval, the first one on top: as many as the order of the arcs promises to need, or two
    /// that shrink towards an end without curvature.
    fn cut(&mut self, interval: &Interval, excess: f64) -> Result<(), Error> {
        let order = if self.how.arcs == Arcs::Class3 {
            PAIR_ORDER
        } else {
            WIDE_ORDER
        };
        let count = if excess.is_finite() {
            (1.1 * excess)
                .powf(1.0 / order)
                .ceil()
                .clamp(2.0, MOST_PARTS)
        } else {
            2.0
        };
        // Arcs of class 9 may end in one inflection.
        let graded = |end: &End| match self.how.arcs {
            Arcs::Class3 => !regular(end.curvature),
            Arcs::Class9 => end.curvature.is_infinite(),
        };
        let (at_start, at_end) = (graded(&interval.start), graded(&interval.end));
        let shares: &[f64] = match (at_start, at_end) {
            (true, true) => &[GRADING, 1.0 - GRADING],
            (true, false) => &[GRADING],
            (false, true) => &[1.0 - GRADING],
            (false, false) => &[],
        };
        let parts = if shares.is_empty() {
            count as usize
        } else {
            shares.len() + 1
        };
        let share = |k: usize| {
            shares
                .get(k.wrapping_sub(1))
                .copied()
                .unwrap_or(k as f64 / parts as f64)
        };
        let (t0, t1) = (interval.start.t, interval.end.t);
        let mut end = interval.end;
        for k in (0..parts).rev() {
            let start = if k == 0 {
                interval.start
            } else {
                End::at(
                    self.curve,
                    interval.span,
                    t0 + (t1 - t0) * share(k),
                    Side::After,
                )?
            };
            self.stack.push(Interval {
                span: interval.span,
                start,
                end,
                depth: interval.depth + 1,
            });
            end = start;
        }
        Ok(())
    }

    /// Adds the pieces of an accepted attempt.
    fn accept(&mut self, interval: &Interval, attempt: &Attempt) -> Result<(), Error> {
        let Interval {
            span, start, end, ..
        } = *interval;
        let source = [start.t, end.t].map(|t| span as f64 + t);
        match attempt.fit {
            Fit::Pair([first, second]) => {
                let joint = self.join(span, &start, true)?;
                self.push(
                    Piece::Arc(PlacedArc::new(start.point, first)),
                    source,
                    joint,
                );
                self.push(
                    Piece::Arc(PlacedArc::new(start.point, second)),
                    source,
                    Joint::G2,
                );
                self.last = Some((end, true));
            }
            Fit::Wide(local) => {
                let joint = self.join(span, &start, true)?;
                self.push(
                    Piece::Wide(PlacedArc::new(start.point, local)),
                    source,
                    joint,
                );
                self.last = Some((end, true));
            }
            Fit::Inflected(arc) => {
                let joint = self.join(span, &start, true)?;
                self.push(Piece::Inflected(arc), source, joint);
                self.last = Some((end, true));
            }
            Fit::Single(arc) => {
                let joint = self.join(span, &start, attempt.matched)?;
                self.push(Piece::Arc(PlacedArc::new(start.point, arc)), source, joint);
                self.last = Some((end, attempt.matched));
            }
            Fit::Bridge if (end.point - start.point).length() > 4.0 * self.rounding => {
                self.straight(span, start, end)?;
            }
            Fit::Bridge => {
                if self.last.is_none() {
                    self.join(span, &start, false)?;
                    self.last = Some((start, false));
                }
            }
        }
        self.tangent_at_end = Some(end);
        Ok(())
    }

    /// Adds a piece and the joint before it.
    fn push(&mut self, piece: Piece, source: [f64; 2], joint: Joint) {
        if !self.pieces.is_empty() {
            self.joints.push(joint);
        }
        self.pieces.push(piece);
        self.sources.push(source);
    }

    /// Turns the normal to that of a piece that starts at `start`, by a corner if it differs, and returns the kind of
    /// the joint before that piece.
    fn join(&mut self, span: usize, start: &End, matched: bool) -> Result<Joint, Error> {
        match self.last {
            Some((last, last_matched)) => {
                self.turn(&last, start, span as f64 + start.t, matched && last_matched)
            }
            None => {
                self.first = Some((*start, matched));
                Ok(Joint::G1)
            }
        }
    }

    /// Adds the fan of normals of a corner, if there is one, and returns the kind of the joint after it.
    fn turn(
        &mut self,
        last: &End,
        start: &End,
        parameter: f64,
        matched: bool,
    ) -> Result<Joint, Error> {
        let (cosine, sine) = (
            last.normal.dot(start.normal),
            last.normal.perp_dot(start.normal),
        );
        if cosine > 0.0 && sine.abs() <= CORNER {
            let same = last.curvature == start.curvature
                || (last.curvature - start.curvature).abs()
                    <= 1e-8 * last.curvature.abs().max(start.curvature.abs());
            return Ok(if matched && same {
                Joint::G2
            } else {
                Joint::G1
            });
        }
        let mut angle = sine.atan2(cosine);
        if cosine < 0.0 && sine.abs() <= 1e-6 {
            // A reversal: the cap lies outside of the tip, against the sense in which the curve turns.
            angle = std::f64::consts::PI.copysign(-last.curvature);
        }
        let parts = (angle.abs() / FAN).ceil();
        let mut normal = last.normal;
        for k in 1..=parts as usize {
            let next = if k as f64 == parts {
                start.normal
            } else {
                DVec2::from_angle(angle * k as f64 / parts).rotate(last.normal)
            };
            let fan = TQuartic::point_fan(DVec2::ZERO, normal, next)?;
            let joint = if k == 1 { Joint::G1 } else { Joint::G2 };
            self.push(
                Piece::Arc(PlacedArc::new(start.point, fan)),
                [parameter; 2],
                joint,
            );
            normal = next;
        }
        self.corners += 1;
        Ok(Joint::G1)
    }

    fn finish(mut self) -> Result<Approximated, Error> {
        let (Some((first, first_matched)), Some((last, last_matched))) = (self.first, self.last)
        else {
            return Err(Error::SinglePoint);
        };
        let closed = self.curve.is_closed();
        if closed {
            let joint = self.turn(
                &last,
                &first,
                self.curve.spans() as f64,
                first_matched && last_matched,
            )?;
            self.joints.push(joint);
        } else if let Some(end) = self.tangent_at_end {
            self.turn(&last, &end, self.curve.spans() as f64, false)?;
        }
        if self.pieces.is_empty() {
            return Err(Error::SinglePoint);
        }
        let g1_joints = self
            .joints
            .iter()
            .filter(|joint| **joint == Joint::G1)
            .count();
        Ok(Approximated {
            spline: ArcSpline {
                pieces: self.pieces,
                joints: self.joints,
                closed,
            },
            error: self.error,
            sources: self.sources,
            g1_joints,
            corners: self.corners,
        })
    }
}
