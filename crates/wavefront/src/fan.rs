//! All rays of one source through one code: sampled so that the rays to any receiver can be found.

use glam::DVec2;

use crate::{Code, Error, Front, FrontTolerance, Model, Ray, Source, Trace};

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
}

/// A stretch of neighbouring rays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Run {
    pub(crate) parameters: Vec<f64>,
    pub(crate) traces: Vec<Trace>,
    /// For each ray the linear function of a point whose zeros lie on the ray, `<side, X> - offset`, with its derivative
    /// along the fan: four lists, so that the scan of a receiver over all rays is one straight loop.
    pub(crate) sides: Vec<SideForm>,
}

/// `f(X) = <side, X> - offset` is the signed distance of X from a ray, `slope` its derivative along the fan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SideForm {
    pub(crate) side: DVec2,
    pub(crate) offset: f64,
    pub(crate) side_slope: DVec2,
    pub(crate) offset_slope: f64,
}

impl SideForm {
    pub(crate) fn value(&self, point: DVec2) -> f64 {
        self.side.dot(point) - self.offset
    }

    pub(crate) fn slope(&self, point: DVec2) -> f64 {
        self.side_slope.dot(point) - self.offset_slope
    }
}

/// How densely a fan is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FanOptions {
    /// Rays to begin with, over the whole source.
    pub rays: usize,
    /// Neighbours on the last leg may differ in direction by this angle (radians) before rays are added between them.
    pub turning: f64,
    /// Neighbours may leave the last interface at places this share of the model's size apart.
    pub spacing: f64,
}

impl Default for FanOptions {
    fn default() -> Self {
        Self {
            rays: 128,
            turning: 0.1,
            spacing: 0.05,
        }
    }
}

/// A gap in a fan is bracketed to this share of the source's parameter.
const BOUNDARY: f64 = 1e-13;
/// Rays are added between neighbours up to this many times: 2^-20 of the first spacing.
const REFINEMENTS: u32 = 20;
/// A fan never holds more rays than this.
const MOST_RAYS: usize = 1 << 16;

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
            ("turning", options.turning),
            ("spacing", options.spacing),
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
        };
        fan.sample(options);
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
        self.runs
            .iter()
            .filter_map(|run| Some([*run.parameters.first()?, *run.parameters.last()?]))
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
        let layer = self.layers.first().copied().unwrap_or(0);
        let start = self.source.ray(parameter, &self.model.media()[layer])?;
        self.model.trace(start, layer, &self.code)
    }

    /// The fronts of the last leg as splines of class-3 arcs, one for each illuminated stretch.
    ///
    /// # Errors
    /// As [`Front::fit`].
    pub fn fronts(&self, tolerance: FrontTolerance) -> Result<Vec<Front>, Error> {
        let medium = &self.model.media()[self.last_layer()];
        let last = |parameter: f64| -> Result<Ray, Error> {
            self.trace(parameter)?
                .last()
                .copied()
                .ok_or(Error::Miss { from: DVec2::NAN })
        };
        let ends = |run: &Run| Some([*run.parameters.first()?, *run.parameters.last()?]);
        let mut fronts = Vec::new();
        for [start, end] in self.runs.iter().filter_map(ends) {
            // Total reflection starts where rays graze: the very boundary ray has no neighbours that could be fitted.
            let inset = BOUNDARY.max(1e-9 * (end - start));
            let range = if self.runs.len() == 1 && start == 0.0 && end == 1.0 {
                [0.0, 1.0]
            } else {
                [start + inset, end - inset]
            };
            if range[1] > range[0] {
                fronts.push(Front::fit(
                    medium,
                    self.last_layer(),
                    &self.breaks(range),
                    last,
                    tolerance,
                )?);
            }
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

    pub(crate) fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The ray on its last leg at a parameter next to a traced neighbour.
    pub(crate) fn ray_near(&self, parameter: f64, neighbour: &Trace) -> Option<Ray> {
        let layer = self.layers.first().copied().unwrap_or(0);
        let start = self
            .source
            .ray(parameter, &self.model.media()[layer])
            .ok()?;
        let guided = self
            .model
            .trace_near(start, &self.layers, &self.code, &neighbour.impacts);
        guided.or_else(|| {
            self.model
                .trace(start, layer, &self.code)
                .ok()?
                .last()
                .copied()
        })
    }

    pub(crate) fn side_form(&self, ray: &Ray) -> SideForm {
        let medium = &self.model.media()[self.last_layer()];
        let velocity = medium.group_velocity(ray.slowness);
        let change = medium.group_velocity_change(ray.slowness, ray.slowness_change);
        let speed = velocity.length();
        let direction = velocity / speed;
        let turn = (change - direction * direction.dot(change)) / speed;
        SideForm {
            side: direction.perp(),
            offset: direction.perp_dot(ray.point),
            side_slope: turn.perp(),
            offset_slope: turn.perp_dot(ray.point) + direction.perp_dot(ray.point_change),
        }
    }

    fn sample(&mut self, options: FanOptions) {
        let mut run = Run::default();
        let mut parameters: Vec<f64> = (0..=options.rays)
            .map(|i| i as f64 / options.rays as f64)
            .collect();
        parameters.extend(self.source.breaks());
        parameters.sort_by(f64::total_cmp);
        parameters.dedup();
        let mut previous: Option<(f64, Option<Trace>)> = None;
        for parameter in parameters {
            let trace = self.trace(parameter).ok();
            if let Some((before, known)) = previous.take() {
                match (known, &trace) {
                    (Some(known), Some(next)) => {
                        self.join(&mut run, (before, &known), (parameter, next), options, 0)
                    }
                    (Some(known), None) => {
                        let (end, last) = self.boundary((before, known), parameter);
                        self.push(&mut run, end, last);
                        self.finish(&mut run);
                    }
                    (None, Some(next)) => {
                        let (start, first) = self.boundary((parameter, next.clone()), before);
                        self.push(&mut run, start, first);
                    }
                    (None, None) => {}
                }
            }
            if let Some(trace) = &trace {
                self.push(&mut run, parameter, trace.clone());
            }
            previous = Some((parameter, trace));
        }
        self.finish(&mut run);
    }

    fn push(&self, run: &mut Run, parameter: f64, trace: Trace) {
        if run.parameters.last().is_some_and(|last| *last >= parameter) {
            return;
        }
        if let Some(ray) = trace.last() {
            run.sides.push(self.side_form(ray));
            run.parameters.push(parameter);
            run.traces.push(trace);
        }
    }

    fn finish(&mut self, run: &mut Run) {
        let run = std::mem::take(run);
        if run.parameters.len() > 1 {
            self.runs.push(run);
        }
    }

    /// Adds rays between two neighbours until they are close; where none exists in between the run is cut.
    fn join(
        &mut self,
        run: &mut Run,
        one: (f64, &Trace),
        two: (f64, &Trace),
        options: FanOptions,
        depth: u32,
    ) {
        if self.ray_count() + run.parameters.len() >= MOST_RAYS || self.close(one.1, two.1, options)
        {
            return;
        }
        if depth >= REFINEMENTS {
            self.tear(run, one, two, options);
            return;
        }
        let middle = 0.5 * (one.0 + two.0);
        match self.trace(middle) {
            Ok(trace) => {
                self.join(run, one, (middle, &trace), options, depth + 1);
                self.push(run, middle, trace.clone());
                self.join(run, (middle, &trace), two, options, depth + 1);
            }
            Err(_) => {
                let (end, last) = self.boundary((one.0, one.1.clone()), middle);
                self.push(run, end, last);
                self.finish(run);
                let (start, first) = self.boundary((two.0, two.1.clone()), middle);
                self.push(run, start, first);
            }
        }
    }

    /// Cuts the run where neighbours that all exist are torn apart: one grazes an interface, the next meets it farther on.
    fn tear(&mut self, run: &mut Run, one: (f64, &Trace), two: (f64, &Trace), options: FanOptions) {
        let (mut low, mut high) = ((one.0, one.1.clone()), (two.0, two.1.clone()));
        while high.0 - low.0 > BOUNDARY {
            let middle = 0.5 * (low.0 + high.0);
            let Ok(trace) = self.trace(middle) else { break };
            if self.close(&low.1, &trace, options) {
                low = (middle, trace);
            } else {
                high = (middle, trace);
            }
        }
        self.push(run, low.0, low.1);
        self.finish(run);
        self.push(run, high.0, high.1);
    }

    fn close(&self, one: &Trace, two: &Trace, options: FanOptions) -> bool {
        let (Some(a), Some(b)) = (one.last(), two.last()) else {
            return true;
        };
        let medium = &self.model.media()[self.last_layer()];
        let (u, v) = (
            medium.group_velocity(a.slowness),
            medium.group_velocity(b.slowness),
        );
        u.angle_to(v).abs() <= options.turning
            && a.point.distance(b.point) <= options.spacing * self.model.size()
    }

    /// The last ray that exists between one that does and a parameter where none does.
    fn boundary(&self, (mut good, mut trace): (f64, Trace), mut bad: f64) -> (f64, Trace) {
        while (bad - good).abs() > BOUNDARY {
            let middle = 0.5 * (good + bad);
            match self.trace(middle) {
                Ok(found) => (good, trace) = (middle, found),
                Err(_) => bad = middle,
            }
        }
        (good, trace)
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
