//! A curve covered by pieces from its start to its end, each as long as the tolerance allows.

use crate::assembly::Assembly;
use crate::course::{Course, End, Interval};
use crate::fit::{Attempt, Fitter, NEAR};
use crate::plane_curve::merge;
use crate::{Approximated, Approximation, Arcs, Break, BreakKind, Error, PlaneCurve, Side};

/// The share of the tolerance that the length of a next attempt aims at.
const AIM: f64 = 0.8;
/// Bounds of the factor from one attempt to a shorter one: errors do not follow the order of the arcs from far off.
const SHORTENING: (f64, f64) = (0.15, 0.9);
/// Shortening where there is no arc at all.
const HALF: f64 = 0.5;
/// A longer attempt is made if it promises to be longer by this factor, and at most by the other one.
const LENGTHENING: (f64, f64) = (1.25, 2.0);
/// A knot that lies beyond the length that is aimed at, but by less than this factor, is aimed at.
const KNOT: f64 = 1.3;
/// How much longer than the last a piece may be while attempts over more knots are held back.
const STEADY: f64 = 1.1;
/// An inflection this near to the tangent of a flat end, by the tolerance, lies in it.
const FLAT: f64 = 0.01;
/// An end nearer to an inflection than this share of the interval is moved into it.
const INTO_INFLECTION: f64 = 0.02;
/// A rest shorter than this share of a piece takes a part of that piece.
const SLIVER: f64 = 0.3;
/// Pieces that end at the next knot at the latest after an attempt over knots has failed, the first time and at most.
const FIRST_HOLD: u32 = 4;
const MOST_HOLD: u32 = 32;
/// Attempts for one piece.
const MOST_ATTEMPTS: u32 = 64;
/// Pieces per span of the curve, beyond which its derivatives cannot belong to its points.
const MOST_PIECES: usize = 10_000;

/// The construction of an approximation.
pub(crate) struct Cover<'a, C: ?Sized> {
    fitter: Fitter<'a, C>,
    assembly: Assembly,
    /// The inflections of the run in work, in the order of travel, and how many of them lie behind.
    inflections: Vec<End>,
    passed: usize,
    /// How long the next piece may become, to judge by the last ones; at first as long as a span.
    reach: Option<f64>,
    /// The length of the last piece.
    covered: f64,
    /// For how many pieces no more knots are run over than by the last, and for how many after the next vain attempt.
    hold: [u32; 2],
}

impl<'a, C: PlaneCurve + ?Sized> Cover<'a, C> {
    pub(crate) fn new(course: Course<'a, C>, how: &'a Approximation) -> Self {
        let room = 2 * course.curve.spans() + 8;
        Self {
            assembly: Assembly::new(room, course.rounding),
            fitter: Fitter { course, how },
            inflections: Vec::new(),
            passed: 0,
            reach: None,
            covered: 0.0,
            hold: [0, FIRST_HOLD],
        }
    }

    /// Covers the whole curve: straight spans at once, the others in runs without cusp or corner.
    pub(crate) fn curve(&mut self) -> Result<(), Error> {
        let curve = self.fitter.course.curve;
        let mut cuts = Vec::new();
        let mut run: Option<Interval> = None;
        for span in 0..curve.spans() {
            self.cuts(span, &mut cuts);
            let [mut start, last] = self.fitter.course.ends(span);
            let straight = curve.is_straight(span);
            for cut in cuts.iter().map(Some).chain([None]) {
                let end = match cut {
                    Some(cut) => End::at_break(curve, span, *cut, Side::Before)?,
                    None => last,
                };
                match run {
                    Some(before) if !straight && self.goes_on(&before.end, &start) => {
                        if before.end.curvature == 0.0 && before.end.t == 1.0 {
                            self.inflections.push(before.end);
                        }
                        start = before.start;
                    }
                    Some(before) => self.run(before)?,
                    None => {}
                }
                if straight {
                    self.assembly.straight(start, end)?;
                    run = None;
                } else {
                    run = Some(Interval { start, end });
                }
                if let Some(cut) = cut {
                    if cut.kind == BreakKind::Inflection && self.fitter.how.arcs == Arcs::Class9 {
                        self.inflections.push(end);
                    }
                    start = End::at_break(curve, span, *cut, Side::After)?;
                }
            }
        }
        run.map_or(Ok(()), |run| self.run(run))
    }

    pub(crate) fn finish(self) -> Result<Approximated, Error> {
        let curve = self.fitter.course.curve;
        self.assembly
            .finish(curve.is_closed(), curve.spans() as f64)
    }

    fn cuts(&self, span: usize, cuts: &mut Vec<Break>) {
        let curve = self.fitter.course.curve;
        cuts.clear();
        curve.inflections(span, cuts);
        if self.fitter.how.arcs == Arcs::Class3 {
            curve.vertices(span, cuts);
        } else {
            cuts.retain(|cut| !self.is_at_a_flat_end(span, cut));
        }
        merge(cuts);
    }

    /// Whether an inflection is the one for which an end of the span was made flat.
    fn is_at_a_flat_end(&self, span: usize, cut: &Break) -> bool {
        let [point, ..] = self.fitter.course.curve.jet(span, cut.t);
        cut.kind == BreakKind::Inflection
            && self.fitter.course.ends(span).iter().any(|end| {
                let away = end.normal.dot(point - end.point).abs();
                end.curvature == 0.0 && away <= FLAT * self.fitter.how.tolerance
            })
    }

    /// Whether an arc may run over the joint of two intervals: an inflection, or a knot with continuous curvature. Arcs of class
    /// 3 have no inflection, and vertices can lie in knots.
    fn goes_on(&self, end: &End, start: &End) -> bool {
        self.fitter.how.arcs == Arcs::Class9
            && end.curvature.is_finite()
            && end.is_tangent_to(start)
            && end.has_curvature_of(start)
    }

    /// Covers a run, piece by piece.
    fn run(&mut self, run: Interval) -> Result<(), Error> {
        let mut rest = run;
        loop {
            let (part, attempt) = self.longest(&rest)?;
            self.assembly.accept(&part, &attempt)?;
            if part.end.parameter() >= rest.end.parameter() {
                break;
            }
            rest = self.fitter.course.rest(&rest, part.end);
            let here = rest.start.parameter();
            let ahead = &self.inflections[self.passed..];
            self.passed += ahead.iter().take_while(|i| i.parameter() < here).count();
        }
        self.inflections.clear();
        self.passed = 0;
        Ok(())
    }

    /// The longest first part of an interval that one attempt covers, found by the order of the arcs.
    fn longest(&mut self, rest: &Interval) -> Result<(Interval, Attempt), Error> {
        let course = &self.fitter.course;
        let (span, whole) = (
            course.length(&course.to_first_knot(rest)),
            course.length(rest),
        );
        let mut search = Search {
            length: self.reach.unwrap_or(span),
            most: if self.hold[0] > 0 {
                whole.min(span.max(STEADY * self.covered))
            } else {
                whole
            },
            covered: 0.0,
            missed: f64::INFINITY,
        };
        let mut over_knots = false;
        let mut longest: Option<(Interval, Attempt)> = None;
        let mut excess = f64::INFINITY;
        for _ in 0..MOST_ATTEMPTS {
            let (part, inflection) = self.first_part(rest, &search)?;
            let tried = self.fitter.course.length(&part);
            if longest.is_some() && !(tried > search.covered && tried < search.missed) {
                break;
            }
            let attempt = self.fitter.attempt(&part, inflection.as_ref());
            excess = attempt
                .as_ref()
                .map_or(f64::INFINITY, |a| a.error / self.fitter.how.tolerance);
            match attempt {
                Some(attempt) if excess <= 1.0 => {
                    let full = tried >= search.most;
                    let promise = if full {
                        LENGTHENING.1
                    } else {
                        attempt.promise(excess)
                    };
                    search.covered = tried;
                    search.length = tried * promise.clamp(1.0, LENGTHENING.1);
                    longest = Some((part, attempt));
                    if full || promise < LENGTHENING.0 || search.missed.is_finite() {
                        break;
                    }
                }
                attempt => {
                    search.missed = tried;
                    over_knots |= part.end.span > part.start.span;
                    if longest.is_some() {
                        break;
                    }
                    let factor = match attempt {
                        Some(attempt) if !over_knots => attempt.promise(excess),
                        _ => HALF,
                    };
                    search.length = tried * factor.clamp(SHORTENING.0, SHORTENING.1);
                }
            }
        }
        self.reach = Some(search.length);
        self.covered = search.covered;
        self.pace(over_knots);
        let room = MOST_PIECES.saturating_mul(self.fitter.course.curve.spans());
        longest
            .filter(|_| self.assembly.len() < room)
            .ok_or(Error::NotConverged {
                start: rest.start.parameter(),
                end: rest.end.parameter(),
                excess,
                attempts: MOST_ATTEMPTS,
            })
    }

    /// Waits with attempts over more knots the longer, the more often they were in vain.
    fn pace(&mut self, in_vain: bool) {
        let [left, next] = self.hold;
        self.hold = match (in_vain, left) {
            (true, _) => [next, (4 * next).min(MOST_HOLD)],
            (false, 0) => [0, FIRST_HOLD],
            (false, _) => [left - 1, next],
        };
    }

    /// A first part of an interval, of about the length looked for. It runs through one inflection at most, and ends in it rather
    /// than near it. The inflection is given too, or else one nearby.
    fn first_part(
        &self,
        rest: &Interval,
        search: &Search,
    ) -> Result<(Interval, Option<End>), Error> {
        let start = rest.start;
        let course = &self.fitter.course;
        let place = |end: &End| course.length_to(end) - course.length_to(&start);
        let mut ahead = self.inflections[self.passed..].iter();
        let (first, second) = (ahead.next(), ahead.next());
        // Half way to a second inflection the curvature is far from zero.
        let half_way = match (first, second) {
            (Some(first), Some(second)) => 0.5 * (place(first) + place(second)),
            _ => f64::INFINITY,
        };
        let end = self.aim(rest, search, half_way.min(search.most))?;
        if let Some(inflection) = first.filter(|first| place(first) <= place(&end)) {
            let (before, after) = (place(inflection), place(&end) - place(inflection));
            let near = before.min(after) < INTO_INFLECTION * place(&end);
            let inside = inflection.parameter() > start.parameter();
            let end = if inside && near { *inflection } else { end };
            return Ok((Interval { start, end }, Some(*inflection)));
        }
        let behind = self.inflections[..self.passed].last();
        let before = behind.map(|behind| (-place(behind), behind));
        let after = first.map(|first| (place(first) - place(&end), first));
        let beside = before
            .into_iter()
            .chain(after)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(away, _)| *away <= NEAR * place(&end))
            .map(|(_, inflection)| *inflection);
        Ok((Interval { start, end }, beside))
    }

    /// An end at about the length looked for, not beyond `limit`: that of the interval, or a knot, or a place inside a span.
    fn aim(&self, rest: &Interval, search: &Search, limit: f64) -> Result<End, Error> {
        let course = &self.fitter.course;
        let length = search.length.min(limit);
        if length >= course.length(rest) {
            return Ok(rest.end);
        }
        let within = limit.min(KNOT * length);
        let within = if within < search.missed {
            within
        } else {
            SHORTENING.1 * search.missed
        };
        if let Some(knot) = course.last_knot(rest, within) {
            return Ok(knot);
        }
        let span = course.to_first_knot(rest);
        let share = length / course.length(&span);
        let sliver = 1.0 - share < SLIVER * share;
        let even = 1.0 / (1.0 + 2.0 * SLIVER);
        course.end_at(&span, if sliver { even } else { share })
    }
}

/// The state of the search for the longest part.
struct Search {
    /// The length to be tried.
    length: f64,
    /// The length not to be exceeded.
    most: f64,
    /// The longest that was covered, and the shortest that was not.
    covered: f64,
    missed: f64,
}

impl Attempt {
    /// The factor by which the length may change to make this excess over the tolerance the one that is aimed at.
    fn promise(&self, excess: f64) -> f64 {
        (AIM / excess).powf(self.order.recip())
    }
}
