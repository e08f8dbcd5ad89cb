//! A curve covered by pieces from its start to its end, each as long as the tolerance allows.

use crate::assembly::Assembly;
use crate::course::{Course, End, Interval};
use crate::fit::{Attempt, Fit, Fitter, NEAR};
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
/// An inflection this near to the tangent of a flat end, by the tolerance, lies in it.
const FLAT: f64 = 0.01;
/// An end less than this share of the interval before an inflection is moved into it.
const UP_TO_INFLECTION: f64 = 0.1;
/// An inflection nearer to an end than this share of the interval is taken as the end.
const INTO_INFLECTION: f64 = 0.02;
/// A rest shorter than this share of a piece takes a part of that piece.
const SLIVER: f64 = 0.3;
/// For so many pieces no more knots are tried after an attempt over knots has failed.
const HOLD: u32 = 32;
/// An error below this share of the tolerance ends the wait.
const MUCH_ROOM: f64 = 1e-3;
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
    /// How many knots the last piece runs over.
    knots: usize,
    /// For how many pieces no more knots are run over than by the last.
    hold: u32,
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
            knots: 0,
            hold: 0,
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
                let goes_on = |run: &Interval| !straight && self.goes_on(&run.end, &start);
                match &mut run {
                    Some(run) if goes_on(run) => {
                        if run.end.curvature == 0.0 && run.end.t == 1.0 {
                            self.inflections.push(run.end);
                        }
                        run.end = end;
                    }
                    _ => {
                        if let Some(run) = run.take() {
                            self.run(run)?;
                        }
                        if straight {
                            self.assembly.straight(start, end)?;
                        } else {
                            run = Some(Interval { start, end });
                        }
                    }
                }
                if let Some(cut) = cut {
                    if cut.kind == BreakKind::Inflection && self.fitter.how.arcs != Arcs::Class3 {
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
        if self.fitter.how.arcs != Arcs::Class3 && cuts.is_empty() {
            return;
        }
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
        self.fitter.how.arcs != Arcs::Class3
            && end.curvature.is_finite()
            && end.is_tangent_to(start)
            && end.has_curvature_of(start)
    }

    /// Covers a run, piece by piece.
    fn run(&mut self, run: Interval) -> Result<(), Error> {
        let mut rest = run;
        loop {
            let end = self.longest(&rest)?;
            if !end.is_before(&rest.end) {
                break;
            }
            rest = self.fitter.course.rest(&rest, end);
            let here = rest.start.parameter();
            let ahead = &self.inflections[self.passed..];
            self.passed += ahead.iter().take_while(|i| i.parameter() < here).count();
        }
        self.inflections.clear();
        self.passed = 0;
        Ok(())
    }

    /// Covers the longest first part of an interval that one attempt covers, found by the order of the arcs; returns its end.
    fn longest(&mut self, rest: &Interval) -> Result<End, Error> {
        let start = rest.start;
        let mut search = self.search(rest);
        let mut longest: Option<(Interval, Fit, f64)> = None;
        let mut excess = f64::INFINITY;
        for _ in 0..MOST_ATTEMPTS {
            let (end, inflection) = self.first_part(rest, &search)?;
            let part = Interval { start, end };
            let tried = self.fitter.course.length(&part);
            if longest.is_some() && !(tried > search.covered && tried < search.missed) {
                break;
            }
            let attempt = self.fitter.attempt(&part, inflection.as_ref());
            excess = attempt.error / self.fitter.how.tolerance;
            if let Some(fit) = attempt.fit.as_ref().filter(|_| excess <= 1.0) {
                let full = !end.is_before(&search.limit);
                let promise = if full {
                    LENGTHENING.1
                } else {
                    attempt.promise(excess)
                };
                search.covered = tried;
                search.length = tried * promise.clamp(1.0, LENGTHENING.1);
                if full || promise < LENGTHENING.0 || search.missed.is_finite() {
                    return self.take(&part, fit, attempt.error, &search);
                }
                longest = Some((part, *fit, attempt.error));
            } else {
                search.in_vain |= end.span > start.span;
                search.missed = tried;
                if longest.is_some() {
                    break;
                }
                let factor = if search.in_vain || excess.is_infinite() {
                    HALF
                } else {
                    attempt.promise(excess)
                };
                search.length = tried * factor.clamp(SHORTENING.0, SHORTENING.1);
            }
        }
        let (part, fit, error) = longest.ok_or(Error::NotConverged {
            start: start.parameter(),
            end: rest.end.parameter(),
            excess,
            attempts: MOST_ATTEMPTS,
        })?;
        self.take(&part, &fit, error, &search)
    }

    /// Takes the longest part that was found, and remembers what the next one may learn from it; returns its end.
    fn take(
        &mut self,
        part: &Interval,
        fit: &Fit,
        error: f64,
        search: &Search,
    ) -> Result<End, Error> {
        let Interval { start, end } = part;
        let excess = error / self.fitter.how.tolerance;
        let room = MOST_PIECES.saturating_mul(self.fitter.course.curve.spans());
        if self.assembly.len() >= room {
            return Err(Error::NotConverged {
                start: start.parameter(),
                end: end.parameter(),
                excess,
                attempts: MOST_ATTEMPTS,
            });
        }
        self.reach = Some(search.length);
        self.knots = end.span - start.span;
        self.hold = match self.hold {
            _ if search.in_vain => HOLD,
            _ if excess < MUCH_ROOM => 0,
            hold => hold.saturating_sub(1),
        };
        self.assembly.accept(part, fit, error)?;
        Ok(*end)
    }

    /// What to try first for an interval.
    fn search(&self, rest: &Interval) -> Search {
        let course = &self.fitter.course;
        let steady = rest.start.span + self.knots;
        let limit = if self.hold > 0 && steady < rest.end.span {
            course.ends(steady)[1]
        } else {
            rest.end
        };
        let length_to = |end: End| course.length_to(&end) - course.length_to(&rest.start);
        Search {
            length: self
                .reach
                .unwrap_or_else(|| length_to(course.to_first_knot(rest).end)),
            limit,
            most: length_to(limit),
            covered: 0.0,
            missed: f64::INFINITY,
            in_vain: false,
        }
    }

    /// The end of a first part of an interval, at about the length looked for. The part runs through one inflection at most, and
    /// ends in it rather than near it. The inflection is given too, or else one nearby.
    fn first_part(&self, rest: &Interval, search: &Search) -> Result<(End, Option<End>), Error> {
        if self.inflections.is_empty() {
            return Ok((self.aim(rest, search, search.most)?, None));
        }
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
        let just_beyond = |first: &&End| {
            let beyond = place(first) - place(&end);
            beyond > 0.0 && beyond < UP_TO_INFLECTION * place(&end) && place(first) < search.missed
        };
        if let Some(inflection) = first.filter(just_beyond) {
            return Ok((*inflection, Some(*inflection)));
        }
        if let Some(inflection) = first.filter(|first| place(first) <= place(&end)) {
            let (before, after) = (place(inflection), place(&end) - place(inflection));
            let near = before.min(after) < INTO_INFLECTION * place(&end);
            let inside = inflection.parameter() > start.parameter();
            let end = if inside && near { *inflection } else { end };
            return Ok((end, Some(*inflection)));
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
        Ok((end, beside))
    }

    /// An end at about the length looked for, not beyond `most`: that of the search, or a knot, or a place inside a span.
    fn aim(&self, rest: &Interval, search: &Search, most: f64) -> Result<End, Error> {
        let course = &self.fitter.course;
        let length = search.length.min(most);
        if length >= search.most {
            return Ok(search.limit);
        }
        let within = most.min(KNOT * length);
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
    /// The end not to be run over, and its length.
    limit: End,
    most: f64,
    /// The longest that was covered, and the shortest that was not.
    covered: f64,
    missed: f64,
    /// Whether an attempt over knots failed.
    in_vain: bool,
}

impl Attempt {
    /// The factor by which the length may change to make this excess over the tolerance the one that is aimed at.
    fn promise(&self, excess: f64) -> f64 {
        (AIM / excess).powf(self.order.recip())
    }
}
