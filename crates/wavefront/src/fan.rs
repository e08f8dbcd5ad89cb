//! All rays of one source through one code: sampled so that the rays to any receiver can be found.

use glam::DVec2;

use crate::sample::sample;
use crate::strip::{Knot, Reach, Strip};
use crate::trace::{Failure, Landing};
use crate::{Code, Cut, Error, Front, FrontTolerance, Medium, Model, Ray, Source, Trace};

/// The exact rays of a source with one history, as a table over the source's parameter from which rays to given points
/// are found and refined, and fronts are fitted.
///
/// ```text
///   source  *            the parameter runs over the source; a run is a stretch of it without a gap:
///          /|\           rays that miss an interface, are blocked or totally reflected end a run, at
///    -----+-+-+-----     a boundary ray that is found by bisection
///        /  |  \
/// ```
#[derive(Clone, Debug)]
pub struct Fan<'m> {
    model: &'m Model,
    source: Source,
    code: Code,
    layers: Vec<usize>,
    runs: Vec<Run>,
    unsearched: Vec<[f64; 2]>,
}

/// A stretch of neighbouring rays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Run {
    pub(crate) parameters: Vec<f64>,
    pub(crate) traces: Vec<Trace>,
    /// The front's normals at the source.
    pub(crate) normals: Vec<DVec2>,
    /// Between each two rays.
    pub(crate) strips: Vec<Strip>,
    /// Where the rays of a strip meet the interfaces, one after the other for each step of the code: the coefficients of
    /// the powers of the share of the strip.
    pub(crate) guides: Vec<[f64; 4]>,
    pub(crate) last: Option<Knot>,
    /// Why it starts and ends where it does; none at the ends of the source.
    pub(crate) cuts: [Option<Cut>; 2],
}

/// How densely a fan is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FanOptions {
    /// Rays to begin with, over the whole source.
    pub rays: usize,
    /// Rays are added until one in the middle of two is where their cubic interpolation expects it, to this share of the
    /// model's size. Two arrivals at a receiver are told apart if the caustic between them is farther away than this.
    pub accuracy: f64,
}

impl Default for FanOptions {
    fn default() -> Self {
        Self {
            rays: 64,
            accuracy: 1e-5,
        }
    }
}

/// A gap in a fan is bracketed to this share of the source's parameter.
pub(crate) const BOUNDARY: f64 = 1e-13;
/// Fronts keep this share of a run off a boundary: there, where rays graze, the very boundary ray has no neighbours.
const FRONT_INSET: f64 = 1e-9;

impl<'m> Fan<'m> {
    /// Traces the rays.
    ///
    /// # Errors
    /// [`Error::BadCode`]; the source's errors; [`Error::OutOfRange`] for options that are not positive. A fan without rays
    /// is no error: nothing arrives with this code.
    pub fn new(
        model: &'m Model,
        source: Source,
        code: Code,
        options: FanOptions,
    ) -> Result<Self, Error> {
        source.check()?;
        for (what, value) in [
            ("the number of rays", options.rays as f64),
            ("the accuracy of a fan", options.accuracy),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::OutOfRange { what, value });
            }
        }
        let first = model.media().first().ok_or(Error::LayerCount {
            media: 0,
            interfaces: 0,
        })?;
        let layer = match &source {
            Source::Front(front) => front.layer(),
            other => model.layer_at(other.place(first)?),
        };
        let layers = model.layers_along(layer, &code)?;
        let mut fan = Self {
            model,
            source,
            code,
            layers,
            runs: Vec::new(),
            unsearched: Vec::new(),
        };
        (fan.runs, fan.unsearched) = sample(&fan, options);
        Ok(fan)
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &'m Model {
        self.model
    }

    /// The code.
    #[must_use]
    pub fn code(&self) -> &Code {
        &self.code
    }

    /// The medium of the last leg.
    #[must_use]
    pub fn last_layer(&self) -> usize {
        self.layers.last().copied().unwrap_or(0)
    }

    /// The stretches of the source's parameter that are illuminated with this code.
    pub fn illuminated(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.runs.iter().filter_map(Run::range)
    }

    /// Where the wave is cut, and why: at total reflection, at the edge of a shadow, at the model's box. In order of the
    /// source's parameter.
    pub fn cuts(&self) -> impl Iterator<Item = &Cut> {
        self.runs.iter().flat_map(|run| &run.cuts).flatten()
    }

    /// The stretches of the source's parameter without rays in which a window with rays may have been missed; elsewhere every
    /// window wider than 2^-20 of the source's parameter has been found.
    ///
    /// Between two rays that fail, enclosures of all rays in between tell that there is none; where they do not, they are
    /// halved, until that costs too much: those stretches are listed. Curved sources and rational indicatrices have no
    /// enclosures, and are searched at some places only.
    #[must_use]
    pub fn unsearched(&self) -> &[[f64; 2]] {
        &self.unsearched
    }

    /// The number of rays in the table.
    #[must_use]
    pub fn ray_count(&self) -> usize {
        self.runs.iter().map(|run| run.parameters.len()).sum()
    }

    /// All sampled rays with their histories.
    pub fn traces(&self) -> impl Iterator<Item = &Trace> {
        self.runs.iter().flat_map(|run| &run.traces)
    }

    /// The ray at a parameter of the source with all its legs.
    ///
    /// # Errors
    /// As [`Model::trace`].
    pub fn trace(&self, parameter: f64) -> Result<Trace, Error> {
        self.attempt(parameter).map_err(|failure| failure.error)
    }

    pub(crate) fn attempt(&self, parameter: f64) -> Result<Trace, Failure> {
        let start = self
            .start(parameter)
            .map_err(|error| Failure { step: 0, error })?;
        self.model.trace_along(start, &self.layers, &self.code)
    }

    fn start(&self, parameter: f64) -> Result<Ray, Error> {
        self.source.ray(parameter, self.first_medium())
    }

    pub(crate) fn source(&self) -> &Source {
        &self.source
    }

    /// The media of the legs.
    pub(crate) fn layers(&self) -> &[usize] {
        &self.layers
    }

    pub(crate) fn first_medium(&self) -> &'m Medium {
        &self.model.media()[self.layers.first().copied().unwrap_or(0)]
    }

    /// The fronts of the last leg as splines of class-3 arcs, one or more for each illuminated stretch: a sliver of rays
    /// that no arc can follow, next to a grazing ray, is left out and is a [`Cut`] of the two fronts at its sides.
    ///
    /// # Errors
    /// [`Error::BadSpeed`] if the last medium's indicatrix is no ellipse; [`Error::OutOfRange`] for the tolerance;
    /// [`Error::NotConverged`] if it is too small for almost all of the front.
    pub fn fronts(&self, tolerance: FrontTolerance) -> Result<Vec<Front>, Error> {
        let medium = &self.model.media()[self.last_layer()];
        let mut fronts = Vec::new();
        for run in &self.runs {
            let Some([start, end]) = run.range() else {
                continue;
            };
            let inset = |cut: &Option<Cut>| {
                if cut.is_some() {
                    BOUNDARY.max(FRONT_INSET * (end - start))
                } else {
                    0.0
                }
            };
            let range = [start + inset(&run.cuts[0]), end - inset(&run.cuts[1])];
            if range[1] <= range[0] {
                continue;
            }
            let ray = |parameter: f64| {
                let index = run.strip_at(parameter);
                self.ray_near(run, index, parameter)
                    .map(|landing| landing.ray)
                    .ok_or_else(|| match self.start(parameter) {
                        Ok(ray) => Error::Miss { from: ray.point },
                        Err(error) => error,
                    })
            };
            fronts.extend(Front::fit_stretch(
                medium,
                self.last_layer(),
                &self.breaks(range),
                ray,
                tolerance,
                run.cuts.clone(),
            )?);
        }
        Ok(fronts)
    }

    /// The range and the joints of the source's pieces inside it.
    fn breaks(&self, [start, end]: [f64; 2]) -> Vec<f64> {
        let inner = self
            .source
            .breaks()
            .into_iter()
            .filter(|t| *t > start && *t < end);
        [start].into_iter().chain(inner).chain([end]).collect()
    }

    /// The parameters of the impacts between two rays at a distance of `width`, as cubics through both with their slopes.
    pub(crate) fn guides<'a>(
        &'a self,
        one: &'a Trace,
        two: &'a Trace,
        width: f64,
    ) -> impl Iterator<Item = [f64; 4]> + 'a {
        let rate = move |trace: &Trace, step: usize| {
            let impact = trace.impacts[step];
            let interface = &self.model.interfaces()[self.code.steps[step].interface];
            let along = trace.legs[step + 1].point_change.dot(impact.tangent);
            interface
                .speed(impact.parameter)
                .map(|speed| width * along / speed)
        };
        (0..self.code.steps.len()).map(move |step| {
            let start = one.impacts[step].parameter;
            let rise = two.impacts[step].parameter - start;
            match (rate(one, step), rate(two, step)) {
                (Some(p), Some(q)) if p.is_finite() && q.is_finite() => {
                    [start, p, 3.0 * rise - 2.0 * p - q, p + q - 2.0 * rise]
                }
                _ => [start, rise, 0.0, 0.0],
            }
        })
    }

    /// Whether the interfaces turn between the impacts of two rays as they do there: no notch or bump lies in between.
    pub(crate) fn is_plain_between(&self, one: &Trace, two: &Trace) -> bool {
        let steps = self.code.steps.iter().zip(&one.impacts).zip(&two.impacts);
        steps.into_iter().all(|((step, from), to)| {
            self.model.interfaces()[step.interface].is_plain_between(from, to)
        })
    }

    /// Whether the rays of a strip surely meet nothing on their last leg.
    pub(crate) fn is_clear(&self, run: &Run, index: usize) -> bool {
        let left = self.code.steps.last().map(|step| step.interface);
        let strip = &run.strips[index];
        let starts = [index, index + 1].map(|ray| run.traces[ray].last().map(|ray| ray.point));
        let [Some(one), Some(two)] = starts else {
            return false;
        };
        let reach = Reach::new(strip, [one, two], self.slack());
        self.model.is_clear(strip, &reach, self.last_layer(), left)
    }

    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The ray on its last leg at a parameter in a strip, guided by the impacts of the strip's ends.
    #[inline(always)]
    pub(crate) fn ray_near(&self, run: &Run, index: usize, parameter: f64) -> Option<Landing> {
        let (low, high) = (*run.parameters.get(index)?, *run.parameters.get(index + 1)?);
        let known = (low, *run.normals.get(index)?);
        let start = self
            .source
            .ray_near(parameter, known, self.first_medium())
            .ok()?;
        let share = (parameter - low) / (high - low);
        let count = self.code.steps.len();
        let guides = run.guides.get(index * count..(index + 1) * count)?;
        let expected = |step: usize| {
            let [a, b, c, d] = guides[step];
            a + share * (b + share * (c + share * d))
        };
        let guided = self
            .model
            .trace_near(start, &self.layers, &self.code, expected);
        guided.or_else(|| {
            let trace = self
                .model
                .trace_along(start, &self.layers, &self.code)
                .ok()?;
            let impacts = trace.impacts.iter().map(|impact| impact.parameter);
            let impacts: Vec<f64> = impacts.collect();
            // Once more along its own impacts, for what is counted on the way.
            self.model
                .trace_near(start, &self.layers, &self.code, |step| impacts[step])
        })
    }
}

impl Run {
    fn range(&self) -> Option<[f64; 2]> {
        Some([*self.parameters.first()?, *self.parameters.last()?])
    }

    fn strip_at(&self, parameter: f64) -> usize {
        let above = self.parameters.partition_point(|known| *known <= parameter);
        above
            .saturating_sub(1)
            .min(self.strips.len().saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Interface, Medium, Mode, Step};

    #[test]
    fn a_ray_that_grazes_a_hill_tears_the_fan() {
        // Behind the hill at 0 stands a higher one at 4: rays just above the first top hit the second.
        let hills = |x: f64| {
            let near = (-x * x).exp();
            let far = 2.0 * (-(x - 4.0) * (x - 4.0)).exp();
            let slope = -2.0 * x * near - 2.0 * (x - 4.0) * far;
            let bend = (4.0 * x * x - 2.0) * near + (4.0 * (x - 4.0) * (x - 4.0) - 2.0) * far;
            [near + far, slope, bend]
        };
        let model = Model::try_new(
            DVec2::new(-6.0, -2.0),
            DVec2::new(8.0, 4.0),
            vec![
                Medium::isotropic(1.0).unwrap(),
                Medium::isotropic(2.0).unwrap(),
            ],
            vec![Interface::graph(-8.0, 10.0, 180, hills).unwrap()],
        )
        .unwrap();
        let step = Step {
            interface: 0,
            mode: Mode::Reflect,
        };
        let source = Source::point(DVec2::new(-4.0, 0.8));
        let code = Code { steps: vec![step] };
        let fan = Fan::new(&model, source, code, FanOptions::default()).unwrap();
        let ends: Vec<[f64; 2]> = fan.illuminated().collect();
        assert!(ends.len() >= 2, "{ends:?}");
        for pair in ends.windows(2) {
            let [left, right] = [pair[0][1], pair[1][0]].map(|t| fan.trace(t).unwrap());
            assert!(left.impacts[0].point.distance(right.impacts[0].point) > 0.5);
        }
        assert!(fan.fronts(FrontTolerance::time(1e-6)).is_ok());
    }
}
