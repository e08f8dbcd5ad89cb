//! How the rays of a fan are chosen: where its wave is smooth so many that cubics between them suffice, the ends of its
//! windows to the last digits, and none where enclosures tell that there are none.

use std::collections::VecDeque;

use glam::DVec2;

use crate::fan::{BOUNDARY, Run};
use crate::strip::{Knot, Strip};
use crate::trace::Failure;
use crate::{Cut, Error, Fan, FanOptions, Ray, Trace};

/// Windows with rays that are wider than this share of the source's parameter are looked for.
const WINDOW: f64 = 1.0 / (1 << 20) as f64;
/// Where enclosures do not tell, so many rays are tried between two that fail in different ways.
const WINDOW_SEARCH: usize = 256;
/// And between two that fail alike.
const WINDOW_GUESS: usize = 32;
/// Rays next to each other that are this much farther apart than the spreading of their tubes tells belong to no one wave.
const MOST_SPREAD: f64 = 4.0;
/// A fan never holds more rays than this.
const MOST_RAYS: usize = 1 << 16;
/// A ray of the source that was tried: its knot, or what stopped it.
type Trial = (f64, Result<Knot, Failure>);

/// The runs of a fan, and the stretches without rays that were not searched to the end.
pub(crate) fn sample(fan: &Fan<'_>, options: FanOptions) -> (Vec<Run>, Vec<[f64; 2]>) {
    Sampler::new(fan, options).sample(options.rays)
}

/// Fills the runs of a fan, ray by ray.
struct Sampler<'f, 'm> {
    fan: &'f Fan<'m>,
    /// Lines are compared inside the circle around the model's box.
    centre: DVec2,
    radius: f64,
    tolerance: f64,
    run: Run,
    done: Vec<Run>,
    unsearched: Vec<[f64; 2]>,
    count: usize,
}

impl<'f, 'm> Sampler<'f, 'm> {
    fn new(fan: &'f Fan<'m>, options: FanOptions) -> Self {
        let [low, high] = fan.model().corners();
        Self {
            fan,
            centre: 0.5 * (low + high),
            radius: 0.5 * fan.model().size(),
            tolerance: options.accuracy * fan.model().size(),
            run: Run::default(),
            done: Vec::new(),
            unsearched: Vec::new(),
            count: 0,
        }
    }

    fn sample(mut self, rays: usize) -> (Vec<Run>, Vec<[f64; 2]>) {
        let mut parameters: Vec<f64> = (0..=rays).map(|i| i as f64 / rays as f64).collect();
        // A joint of the source is met from both sides.
        for joint in self.fan.source().breaks() {
            parameters.extend([joint - BOUNDARY, joint]);
        }
        parameters.retain(|parameter| *parameter >= 0.0);
        parameters.sort_by(f64::total_cmp);
        parameters.dedup();
        let mut previous: Option<Trial> = None;
        for parameter in parameters {
            let (trial, trace) = self.attempt(parameter);
            if let Some(previous) = previous {
                self.fill(&previous, &trial);
            }
            self.push(&trial, trace);
            previous = Some(trial);
        }
        self.finish(None);
        (self.done, self.unsearched)
    }

    fn attempt(&self, parameter: f64) -> (Trial, Trace) {
        match self.fan.attempt(parameter) {
            Ok(trace) => {
                let medium = &self.fan.model().media()[self.fan.last_layer()];
                let ray = trace.legs[trace.legs.len() - 1];
                let knot = Knot::new(parameter, &ray, medium);
                ((parameter, Ok(knot)), trace)
            }
            Err(failure) => ((parameter, Err(failure)), Trace::default()),
        }
    }

    fn push(&mut self, trial: &Trial, trace: Trace) {
        let (parameter, Ok(knot)) = trial else { return };
        if let (Some(last), Some(before)) = (self.run.last, self.run.traces.last())
            && parameter - last.parameter > WINDOW
            && self.count < MOST_RAYS
            && !self.fan.is_plain_between(before, &trace)
        {
            let middle = 0.5 * (last.parameter + parameter);
            let (middle, its) = self.attempt(middle);
            self.fill(&(last.parameter, Ok(last)), &middle);
            self.push(&middle, its);
            self.fill(&middle, trial);
            // Half as wide as before.
            return self.push(trial, trace);
        }
        if let Some(last) = &self.run.last {
            if last.parameter >= *parameter {
                return;
            }
            self.run.strips.push(Strip::between(last, knot));
            let width = parameter - last.parameter;
            if let Some(before) = self.run.traces.last() {
                let guides = self.fan.guides(before, &trace, width);
                self.run.guides.extend(guides);
            }
        }
        self.run.parameters.push(*parameter);
        self.run.normals.extend(trace.legs.first().map(Ray::normal));
        self.run.traces.push(trace);
        self.run.last = Some(*knot);
        self.count += 1;
    }

    /// Ends the run, at the end of the source or with a reason.
    fn finish(&mut self, reason: Option<Error>) {
        let mut run = std::mem::take(&mut self.run);
        run.cuts[1] = reason.and_then(|reason| Cut::new(&run, reason, true));
        if run.parameters.len() > 1 {
            self.done.push(run);
        }
    }

    /// Adds what is between two rays that were tried.
    fn fill(&mut self, one: &Trial, two: &Trial) {
        match (&one.1, &two.1) {
            (Ok(a), Ok(b)) => self.join(a, b),
            (Ok(a), Err(failure)) => {
                let (last, trace, bad) = self.boundary(a, two.0, failure);
                if let (_, Ok(b)) = &last {
                    self.join(a, b);
                }
                self.push(&last, trace);
                self.finish(Some(bad.1.error.clone()));
                self.gap(&(bad.0, Err(bad.1)), two);
            }
            (Err(failure), Ok(b)) => {
                let (first, trace, bad) = self.boundary(b, one.0, failure);
                let error = bad.1.error.clone();
                self.gap(one, &(bad.0, Err(bad.1)));
                self.push(&first, trace);
                self.run.cuts[0] = Cut::new(&self.run, error, false);
                if let (_, Ok(a)) = &first {
                    self.join(a, b);
                }
            }
            (Err(_), Err(_)) => self.gap(one, two),
        }
    }

    /// Adds the windows with rays between two that fail.
    fn gap(&mut self, one: &Trial, two: &Trial) {
        let mut previous = one.clone();
        for (trial, trace) in self.search(one, two) {
            if previous.1.is_ok() || trial.1.is_ok() {
                self.fill(&previous, &trial);
            }
            self.push(&trial, trace);
            previous = trial;
        }
        if previous.1.is_ok() {
            self.fill(&previous, two);
        }
    }

    /// Rays between two that fail, in order: none where it is certain that all fail. The widest ranges are halved first.
    fn search(&mut self, one: &Trial, two: &Trial) -> Vec<(Trial, Trace)> {
        let (Err(first), Err(last)) = (&one.1, &two.1) else {
            return Vec::new();
        };
        let alike = first.step == last.step
            && std::mem::discriminant(&first.error) == std::mem::discriminant(&last.error);
        let most = if alike { WINDOW_GUESS } else { WINDOW_SEARCH };
        let mut tried = Vec::new();
        let mut waiting = VecDeque::from([[one.0, two.0]]);
        while let Some([start, end]) = waiting.pop_front() {
            if end - start <= WINDOW || self.fan.excludes([start, end]) {
                continue;
            }
            if tried.len() >= most {
                self.unsearched.push([start, end]);
                continue;
            }
            let middle = 0.5 * (start + end);
            tried.push(self.attempt(middle));
            waiting.extend([[start, middle], [middle, end]]);
        }
        tried.sort_by(|a: &(Trial, Trace), b| a.0.0.total_cmp(&b.0.0));
        tried
    }

    /// Adds rays between two until their strip is where the rays are; cuts the run where it never is: a ray grazes an
    /// interface, and the next one meets it farther on.
    fn join(&mut self, a: &Knot, b: &Knot) {
        if self.count >= MOST_RAYS {
            return;
        }
        if b.parameter - a.parameter <= 2.0 * BOUNDARY {
            let (centre, radius) = (self.centre, self.radius);
            let width = b.parameter - a.parameter;
            let spread = width * a.rate(centre, radius).max(b.rate(centre, radius));
            if a.distance(b, centre, radius) > self.tolerance.max(MOST_SPREAD * spread) {
                let torn = || Error::Torn {
                    parameter: a.parameter,
                };
                self.finish(Some(torn()));
                let (again, trace) = self.attempt(b.parameter);
                self.push(&again, trace);
                self.run.cuts[0] = Cut::new(&self.run, torn(), false);
            }
            return;
        }
        let (middle, trace) = self.attempt(0.5 * (a.parameter + b.parameter));
        match &middle.1 {
            Ok(knot)
                if knot.misfit(&Strip::between(a, b), self.centre, self.radius)
                    <= self.tolerance =>
            {
                self.push(&middle, trace);
            }
            Ok(knot) => {
                self.join(a, knot);
                self.push(&middle, trace);
                self.join(knot, b);
            }
            Err(_) => {
                self.fill(&(a.parameter, Ok(*a)), &middle);
                self.fill(&middle, &(b.parameter, Ok(*b)));
            }
        }
    }

    /// The last ray that exists between one that does and a parameter where none does, and the next one with what stopped it.
    fn boundary(
        &self,
        known: &Knot,
        bad: f64,
        failure: &Failure,
    ) -> (Trial, Trace, (f64, Failure)) {
        let (mut good, mut trace) = self.attempt(known.parameter);
        let mut bad = (bad, failure.clone());
        while (bad.0 - good.0).abs() > BOUNDARY {
            let middle = 0.5 * (good.0 + bad.0);
            match self.attempt(middle) {
                (found, its) if found.1.is_ok() => (good, trace) = (found, its),
                ((_, Err(failure)), _) => bad = (middle, failure),
                _ => break,
            }
        }
        (good, trace, bad)
    }
}
