//! G2 approximation of plane curves by class-3 arcs: cut at inflections and vertices, interpolate curvature elements,
//! measure, halve.

use glam::DVec2;

use crate::arc_spline::Segment;
use crate::curvature_element::EQUAL_RADII;
use crate::plane_curve::curvature;
use crate::{
    ArcSpline, Break, BreakKind, CurvatureElement, Error, G1Ends, G2Pair, Joint, LineElement,
    Piece, PlacedArc, PlaneCurve, Side, TQuartic,
};

/// How a curve is approximated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approximation {
    /// Largest distance allowed between the curve and the spline, measured between tangents with the same normal; it
    /// is then the same for all offsets. In plane units.
    pub tolerance: f64,
    /// Tension of the pairs of arcs, in (0, 1); 1/2 gives order 5, any other value order 3.
    pub beta: f64,
    /// Curvature continuity wherever arcs of class 3 allow it (everywhere but at inflections, cusps and corners);
    /// [`Joint::G1`] spends about a third fewer arcs on continuity of the tangent alone.
    pub continuity: Joint,
}

impl Approximation {
    /// G2 within `tolerance`, with tension 1/2.
    #[must_use]
    pub const fn within(tolerance: f64) -> Self {
        Self {
            tolerance,
            beta: 0.5,
            continuity: Joint::G2,
        }
    }
}

/// The spline that approximates a curve, with what was measured on the way.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approximated {
    /// The spline.
    pub spline: ArcSpline,
    /// Largest distance found between the curve and the spline.
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

/// Largest turning of one pair of arcs, in radians: somewhat below the half turn at which arcs end to exist.
const MOST_TURNING_COSINE: f64 = -0.94;
/// Turning below which the radii at a joint lose their digits (relative error some eps / h): G1 arcs.
const LEAST_G2_TURNING: f64 = 1e-7;
/// Turning below which there are no arcs, but corners and segments.
const LEAST_TURNING: f64 = 1e-12;
/// A radius of more than so many chords counts as that of an inflection.
const FLAT: f64 = 1e7;
/// A radius of less than this share of the chord counts as that of a cusp: its digits are lost in those of the arc.
const SHARP: f64 = 1e-6;
/// Angle between tangents that makes a corner, far above the rounding of computed tangents.
const CORNER: f64 = 1e-9;
/// Largest turning of a fan of normals at a corner, which must stay below pi.
const FAN: f64 = 1.6;
/// Interior samples of the error per attempt, over both arcs of a pair.
const SAMPLES: usize = 6;
/// The true error exceeds the sampled one by a little; measured up to 1.15 on a thousand random splines.
const PEAK: f64 = 1.16;
/// Order of the pairs, which tells into how many parts a failed attempt is cut.
const ORDER: f64 = 5.0;
/// Most parts of one cut.
const MOST_PARTS: f64 = 16.0;
/// Cuts of cuts after which a piece is given up.
const MOST_DEPTH: u32 = 48;
/// Smallest tolerance in units of the last place of the largest coordinate.
const LEAST_TOLERANCE_ULPS: f64 = 64.0;

/// One end of an interval: the curve's point, right-hand unit normal and signed curvature there, 0 at inflections and
/// infinite at cusps.
#[derive(Clone, Copy, Debug)]
struct End {
    t: f64,
    point: DVec2,
    normal: DVec2,
    curvature: f64,
}

/// A part of a span of monotone curvature.
#[derive(Clone, Copy, Debug)]
struct Interval {
    span: usize,
    start: End,
    end: End,
    depth: u32,
}

/// What replaces an interval of the curve.
#[derive(Clone, Copy, Debug)]
enum Fit {
    Pair([TQuartic; 2]),
    Single(TQuartic),
    Bridge,
}

/// An attempt: the fit, its measured error, and whether its end curvatures are those of the curve.
struct Attempt {
    fit: Fit,
    error: f64,
    matched: bool,
}

/// Approximates `curve` by a spline of class-3 arcs and segments.
///
/// The curve is cut at its inflections, vertices and knots; on every part of monotone curvature the end elements are
/// admissible, and two class-3 arcs interpolate them with G2 contact ([`G2Pair`]); where the measured error exceeds the
/// tolerance, the part is cut further. Straight spans stay segments, circular arcs stay exact. The policy where class 3
/// has no curvature to match, at inflections and cusps, is one G1 arc on the adjacent part, in parts that shrink towards
/// the point. Corners and cusps become fans of normals.
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
        curve.breaks(span, &mut cuts);
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
        curve.breaks(span, &mut cuts);
        if curve.is_straight(span) {
            found
                .cusps
                .extend(cuts.iter().map(|cut| span as f64 + cut.t));
            before = None;
            continue;
        }
        let mut kind = None;
        let mut start = end_at(curve, span, 0.0, Side::After)?;
        for cut in cuts.iter().map(Some).chain([None]) {
            let end = end_at(curve, span, cut.map_or(1.0, |cut| cut.t), Side::Before)?;
            let end_curvature = cut.map_or(end.curvature, |cut| tagged(end.curvature, cut.kind));
            let middle = end_at(curve, span, 0.5 * (start.t + end.t), Side::After)?.curvature;
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
            start = end_at(curve, span, end.t, Side::After)?;
            start.curvature = kind.map_or(start.curvature, |kind| tagged(start.curvature, kind));
        }
    }
    Ok(found)
}

/// The curvature that is meant at a break: computed values there are rounding.
fn tagged(curvature: f64, kind: BreakKind) -> f64 {
    match kind {
        BreakKind::Inflection => 0.0,
        BreakKind::Cusp => f64::INFINITY.copysign(curvature),
        BreakKind::Vertex => curvature,
    }
}

fn end_at<C: PlaneCurve + ?Sized>(
    curve: &C,
    span: usize,
    t: f64,
    side: Side,
) -> Result<End, Error> {
    let [point, first, second] = curve.jet(span, t);
    if !(point.is_finite() && first.is_finite() && second.is_finite()) {
        return Err(Error::NonFinite {
            what: "a point or derivative of the curve",
        });
    }
    let direction = curve.direction(span, t, side);
    let normal = -direction.try_normalize().unwrap_or(DVec2::ZERO).perp();
    let vanished = direction != first;
    let curvature = if vanished {
        f64::INFINITY
    } else {
        curvature(first, second)
    };
    Ok(End {
        t,
        point,
        normal,
        curvature,
    })
}

struct Builder<'a, C: ?Sized> {
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
        let mut start = end_at(self.curve, span, 0.0, Side::After)?;
        for cut in cuts.iter().map(Some).chain([None]) {
            let t = cut.map_or(1.0, |cut| cut.t);
            let mut end = end_at(self.curve, span, t, Side::Before)?;
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
                    let mut next = end_at(self.curve, span, t, Side::After)?;
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

    /// Adds a part of monotone curvature, cut until each part is within the tolerance.
    fn monotone(&mut self, whole: Interval) -> Result<(), Error> {
        self.stack.push(whole);
        while let Some(interval) = self.stack.pop() {
            let attempt = self.attempt(&interval);
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

    /// Pushes the parts of an interval, the first one on top.
    fn cut(&mut self, interval: &Interval, excess: f64) -> Result<(), Error> {
        let graded = !(regular(interval.start.curvature) && regular(interval.end.curvature));
        let parts = if graded || !excess.is_finite() {
            2.0
        } else {
            (1.1 * excess)
                .powf(1.0 / ORDER)
                .ceil()
                .clamp(2.0, MOST_PARTS)
        };
        let (t0, t1) = (interval.start.t, interval.end.t);
        let mut end = interval.end;
        let count = parts as usize;
        for k in (0..count).rev() {
            let start = if k == 0 {
                interval.start
            } else {
                end_at(
                    self.curve,
                    interval.span,
                    t0 + (t1 - t0) * (k as f64 / parts),
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

    /// The best fit of one interval with its measured error; none if there is no arc.
    fn attempt(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end, .. } = interval;
        let chord = (end.point - start.point).length();
        let cosine = start.normal.dot(end.normal);
        let sine = start.normal.perp_dot(end.normal);
        if sine.abs() > LEAST_TURNING && cosine > MOST_TURNING_COSINE {
            let resolved = (FLAT.recip() / chord)..(SHARP.recip() / chord);
            let g2 = self.how.continuity == Joint::G2
                && sine.abs() > LEAST_G2_TURNING
                && [start, end]
                    .iter()
                    .all(|e| resolved.contains(&e.curvature.abs()))
                && start.curvature * end.curvature > 0.0;
            let difference = (start.curvature - end.curvature).abs();
            let unequal = difference > EQUAL_RADII * start.curvature.abs().max(end.curvature.abs());
            let pair = if g2 && unequal {
                self.pair(interval)
            } else {
                None
            };
            if let Some(attempt) = pair.or_else(|| self.single(interval, chord)) {
                return Some(attempt);
            }
        }
        self.bridge(interval, chord)
    }

    /// Two arcs of class 3 with the curvatures of the ends.
    fn pair(&self, interval: &Interval) -> Option<Attempt> {
        let Interval { start, end, .. } = interval;
        let element = |e: &End| {
            CurvatureElement::from_unit(e.point - start.point, e.normal, e.curvature.recip())
        };
        let pair = G2Pair::new(&element(start), &element(end), self.how.beta).ok()?;
        let error = self.pair_error(interval, &pair)?;
        Some(Attempt {
            fit: Fit::Pair(pair.arcs),
            error,
            matched: true,
        })
    }

    /// One arc of class 3 with G1 contact, its shape fitted to inner tangents.
    fn single(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let element = |e: &End| LineElement::from_unit(e.point - interval.start.point, e.normal);
        let ends = G1Ends::between(element(&interval.start), element(&interval.end));
        let samples = [0.25, 0.5, 0.75].map(|share| self.tangent(interval, share));
        let alpha = ends.clamp_alpha(ends.fit_alpha(samples)).ok()?;
        let arc = ends.arc_of_positive(alpha);
        let error = self.single_error(interval, &arc)?;
        let [r0, r1] = ends.end_radii(alpha);
        let agrees = |r: f64, curvature: f64| {
            (r * curvature - 1.0).abs() <= EQUAL_RADII.max(f64::EPSILON * r.abs() / chord)
        };
        let matched = agrees(r0, interval.start.curvature) && agrees(r1, interval.end.curvature);
        Some(Attempt {
            fit: Fit::Single(arc),
            error,
            matched,
        })
    }

    /// A corner, a segment and a corner: right where all of the interval is closer to its chord than the tolerance.
    fn bridge(&self, interval: &Interval, chord: f64) -> Option<Attempt> {
        let Interval {
            span, start, end, ..
        } = *interval;
        let along = (end.point - start.point).try_normalize();
        let mut error = 0.0_f64;
        for k in 1..=SAMPLES {
            let t = start.t + (end.t - start.t) * (k as f64 / (SAMPLES + 1) as f64);
            let [point, ..] = self.curve.jet(span, t);
            let from = point - start.point;
            let distance = along.map_or(from.length(), |along| {
                let nearest = along * from.dot(along).clamp(0.0, chord);
                (from - nearest).length()
            });
            error = error.max(distance);
        }
        // A segment replaces a turning curve only where nothing of it can be seen; the factor leaves room for what the
        // samples miss on a piece that may loop.
        let error = 2.0 * error;
        (error <= self.how.tolerance).then_some(Attempt {
            fit: Fit::Bridge,
            error,
            matched: false,
        })
    }

    /// Unit normal and support about the start point of the interval, at a share of its parameters.
    #[inline]
    fn tangent(&self, interval: &Interval, share: f64) -> (DVec2, f64) {
        let (t0, t1) = (interval.start.t, interval.end.t);
        let [point, first, _] = self.curve.jet(interval.span, t0 + (t1 - t0) * share);
        let normal = -first.normalize_or_zero().perp();
        (normal, normal.dot(point - interval.start.point))
    }

    /// Largest difference of supports at inner samples; none if a normal of the curve does not occur on the arcs.
    fn pair_error(&self, interval: &Interval, pair: &G2Pair) -> Option<f64> {
        let probes = pair.arcs.map(|arc| Probe::new(&arc));
        let joint = pair.joint.normal();
        let sense = interval.start.normal.perp_dot(joint);
        let mut error = 0.0_f64;
        for k in 1..=SAMPLES {
            let (normal, support) = self.tangent(interval, k as f64 / (SAMPLES + 1) as f64);
            let beyond = joint.perp_dot(normal) * sense > 0.0;
            let probe = if beyond { &probes[1] } else { &probes[0] };
            error = error.max((probe.support(normal)? - support).abs());
        }
        Some(PEAK * error)
    }

    fn single_error(&self, interval: &Interval, arc: &TQuartic) -> Option<f64> {
        let probe = Probe::new(arc);
        let mut error = 0.0_f64;
        for k in 1..=SAMPLES {
            let (normal, support) = self.tangent(interval, k as f64 / (SAMPLES + 1) as f64);
            error = error.max((probe.support(normal)? - support).abs());
        }
        Some(PEAK * error)
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
                    Piece::Arc(PlacedArc {
                        origin: start.point,
                        local: first,
                    }),
                    source,
                    joint,
                );
                self.push(
                    Piece::Arc(PlacedArc {
                        origin: start.point,
                        local: second,
                    }),
                    source,
                    Joint::G2,
                );
                self.last = Some((end, true));
            }
            Fit::Single(arc) => {
                let joint = self.join(span, &start, attempt.matched)?;
                self.push(
                    Piece::Arc(PlacedArc {
                        origin: start.point,
                        local: arc,
                    }),
                    source,
                    joint,
                );
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
                Piece::Arc(PlacedArc {
                    origin: start.point,
                    local: fan,
                }),
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

/// Whether a curvature is neither zero nor infinite.
fn regular(curvature: f64) -> bool {
    curvature != 0.0 && curvature.is_finite()
}

/// An arc prepared for many evaluations of its support by the normal.
struct Probe {
    w0: DVec2,
    w1: DVec2,
    start: DVec2,
    g: [f64; 4],
}

impl Probe {
    fn new(arc: &TQuartic) -> Self {
        let (w0, w1) = arc.spinors();
        Self {
            w0,
            w1,
            start: arc.normal(0.0),
            g: *arc.coefficients(),
        }
    }

    /// The support at a unit normal; none (but for a slack of rounding) outside of the arc.
    #[inline]
    fn support(&self, normal: DVec2) -> Option<f64> {
        let (cosine, sine) = (self.start.dot(normal), self.start.perp_dot(normal));
        let spinor = self.w0.rotate(DVec2::new(1.0 + cosine, sine));
        let (a, b) = (self.w0.perp_dot(spinor), spinor.perp_dot(self.w1));
        let sum = a + b;
        let (t, s) = (a / sum, b / sum);
        if !(t >= -1e-9 && s >= -1e-9) {
            return None;
        }
        let [g0, g1, g2, g3] = self.g;
        let value = s * s * (s * g0 + 3.0 * t * g1) + t * t * (3.0 * s * g2 + t * g3);
        Some(value / (self.w0 * s + self.w1 * t).length_squared())
    }
}
