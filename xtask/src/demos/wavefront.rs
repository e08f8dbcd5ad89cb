//! Waves in a layered model with curved interfaces: rays, fronts at successive times, and what receivers hear.
//!
//! What one sees: three media, darker where the wave is faster, between two curved interfaces, a source (red) and a line of
//! receivers. In the left plot the rays that come back, a colour for each history: reflected at the first interface, at the
//! second, or back and forth between the two. In the right one all fronts at a few times; they are bent, cut and folded at the
//! interfaces. The second figure is the section, arrival time against receiver: bow ties where the caustic of a valley lies.
//! The animation shows the fronts running.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::path::PathBuf;

use anyhow::{Context as _, Result, ensure};
use bezier_mass::BezierCurve;
use glam::{DMat2, DVec2, dvec2};
use serde::Deserialize;
use wavefront::{
    Arrival, Code, Fan, FanOptions, Front, FrontTolerance, Interface, Medium, Mode, Model, Source,
    section,
};

use crate::color::{Color, GREY, INK, MIST, VERMILION};
use crate::demo::{Context, Demo, OrBadInput as _};
use crate::figure::{Corner, Figure, Marker, Plot, Side, Style};
use crate::report::Target;

#[derive(clap::Args, Debug)]
pub(super) struct Wavefront {
    /// A model: {"box": [[x, y], [x, y]], "media": [{"speed": v}, {"semi_axes": [a, b], "angle": radians}, ..] from above,
    /// "interfaces": [{"line": [[x, y], [x, y]]}, {"graph": [[x, y], ..]}, ..], "source": [x, y], "receivers": [[x, y], [x, y]]}
    #[arg(long, value_name = "FILE.json")]
    model: Option<PathBuf>,
    /// Longest history of a wave, in interfaces met
    #[arg(long, default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=8))]
    depth: u32,
}

/// Fronts fit this share of the time in which a wave crosses the model.
const FRONT_TOLERANCE: f64 = 1e-7;

impl Demo for Wavefront {
    const NAME: &'static str = "wavefront";
    const PAPER: &'static str = "ph-geodesic-variation-wavefront, Figs 5.3 to 5.7";
    const ABOUT: &'static str =
        "Rays, fronts and arrivals in a layered model with curved interfaces";

    fn run(&self, context: &mut Context) -> Result<()> {
        let description = match &self.model {
            Some(path) => {
                let text = std::fs::read_to_string(path).or_bad_input("--model")?;
                serde_json::from_str(&text).or_bad_input("--model")?
            }
            None => Description::valleys(),
        };
        let survey = Survey::new(&description).or_bad_input("--model")?;
        let depth = self.depth as usize;
        let codes = survey.model.codes(survey.layer, depth);
        let returning = survey.fans(codes.iter().filter(|code| survey.returns(code)))?;
        // The fronts of long histories would only cover the picture.
        let short = codes.iter().filter(|code| code.steps.len() <= 3);
        let all = survey.fans(short)?;
        let fronts = survey.fronts(&all)?;

        survey.draw(context, &returning, &all, &fronts)?;
        survey.draw_section(context, &returning)?;
        survey.animate(context, &all, &fronts)?;

        let check =
            survey.check_arrivals(&returning, context.pick(41, 7), context.pick(4000, 1200));
        context.number("arrival_max_error", check.largest, Target::AtMost(1e-9));
        context.number("missed_arrivals", check.missed, Target::exactly(0));
        context.number("arrivals_compared", check.compared, Target::AtLeast(1.0));
        let distance = survey.front_distance(&all, &fronts, context.pick(60, 12))?;
        context.number("front_max_distance", distance, Target::AtMost(1e-6));
        let pieces: usize = fronts.iter().map(|(_, front)| front.pieces().len()).sum();
        context.number("arcs", pieces, Target::AtLeast(1.0));
        let angle = fronts
            .iter()
            .map(|(_, front)| front.joint_errors().0)
            .fold(0.0, f64::max);
        context.number("g1_max_angle_rad", angle, Target::AtMost(1e-9));
        Ok(())
    }
}

/// What the model's file holds.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Description {
    #[serde(rename = "box")]
    corners: [[f64; 2]; 2],
    media: Vec<MediumDescription>,
    interfaces: Vec<InterfaceDescription>,
    source: [f64; 2],
    receivers: [[f64; 2]; 2],
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum MediumDescription {
    Isotropic {
        speed: f64,
    },
    Elliptical {
        semi_axes: [f64; 2],
        #[serde(default)]
        angle: f64,
    },
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum InterfaceDescription {
    Line([[f64; 2]; 2]),
    Graph(Vec<[f64; 2]>),
}

impl Description {
    /// Three media in metres and seconds, a valley in the first interface and waves in the second.
    fn valleys() -> Self {
        let samples = |f: fn(f64) -> f64| {
            let place = |i: i32| {
                let x = 125.0 * f64::from(i);
                [x, f(x)]
            };
            InterfaceDescription::Graph((-16..=16).map(place).collect())
        };
        Self {
            corners: [[-2000.0, -2000.0], [2000.0, 60.0]],
            media: [1500.0, 2200.0, 3100.0]
                .map(|speed| MediumDescription::Isotropic { speed })
                .into(),
            interfaces: vec![
                samples(|x| -650.0 - 260.0 * (-((x - 250.0) / 520.0).powi(2)).exp() + 0.05 * x),
                samples(|x| -1420.0 + 110.0 * (x / 420.0).sin()),
            ],
            source: [-200.0, 0.0],
            receivers: [[-1600.0, 0.0], [1600.0, 0.0]],
        }
    }
}

/// A natural cubic spline through samples, straight beyond them.
#[derive(Debug)]
struct Graph {
    samples: Vec<DVec2>,
    /// Second derivatives at the samples.
    bends: Vec<f64>,
}

impl Graph {
    fn new(samples: Vec<DVec2>) -> Result<Self> {
        let count = samples.len();
        ensure!(count >= 2, "an interface has at least two samples");
        ensure!(
            samples.iter().all(|p| p.is_finite()),
            "a sample of an interface is not finite"
        );
        ensure!(
            samples.windows(2).all(|pair| pair[0].x < pair[1].x),
            "the samples of an interface have increasing x"
        );
        let width = |i: usize| samples[i + 1].x - samples[i].x;
        let slope = |i: usize| (samples[i + 1].y - samples[i].y) / width(i);
        // Elimination in the tridiagonal system of the second derivatives.
        let (mut upper, mut right) = (vec![0.0; count], vec![0.0; count]);
        for i in 1..count - 1 {
            let pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * upper[i - 1];
            upper[i] = width(i) / pivot;
            right[i] = (6.0 * (slope(i) - slope(i - 1)) - width(i - 1) * right[i - 1]) / pivot;
        }
        let mut bends = vec![0.0; count];
        for i in (1..count - 1).rev() {
            bends[i] = right[i] - upper[i] * bends[i + 1];
        }
        Ok(Self { samples, bends })
    }

    /// Height and slope.
    fn at(&self, x: f64) -> (f64, f64) {
        let i = self
            .samples
            .partition_point(|p| p.x <= x)
            .clamp(1, self.samples.len() - 1)
            - 1;
        let (a, b) = (self.samples[i], self.samples[i + 1]);
        let inside = x.clamp(a.x, b.x);
        let width = b.x - a.x;
        let (p, q) = ((b.x - inside) / width, (inside - a.x) / width);
        let (m, n) = (self.bends[i], self.bends[i + 1]);
        let height =
            p * a.y + q * b.y + ((p * p * p - p) * m + (q * q * q - q) * n) * width * width / 6.0;
        let slope =
            (b.y - a.y) / width + ((3.0 * q * q - 1.0) * n - (3.0 * p * p - 1.0) * m) * width / 6.0;
        (height + slope * (x - inside), slope)
    }

    /// The same curve in Bézier pieces, over the whole box.
    fn interface(&self, [low, high]: [DVec2; 2]) -> Result<Interface, wavefront::Error> {
        let margin = high.x - low.x;
        let (first, last) = (self.samples[0].x, self.samples[self.samples.len() - 1].x);
        let mut knots = vec![first.min(low.x) - margin];
        knots.extend(self.samples.iter().map(|p| p.x));
        knots.push(last.max(high.x) + margin);
        let piece = |ends: &[f64]| {
            let third = (ends[1] - ends[0]) / 3.0;
            let ((y0, s0), (y1, s1)) = (self.at(ends[0]), self.at(ends[1]));
            BezierCurve::polynomial(&[
                dvec2(ends[0], y0),
                dvec2(ends[0] + third, y0 + third * s0),
                dvec2(ends[1] - third, y1 - third * s1),
                dvec2(ends[1], y1),
            ])
        };
        let pieces: Vec<_> = knots.windows(2).map(piece).collect::<Result<_, _>>()?;
        Interface::curve(pieces)
    }
}

/// A model with its source and receivers, and the same once more as plain functions for the independent solver.
struct Survey {
    model: Model,
    source: DVec2,
    /// The medium of the source and of the receivers.
    layer: usize,
    receivers: [DVec2; 2],
    graphs: Vec<Graph>,
    /// The maps from the unit circle to the indicatrices.
    indicatrices: Vec<DMat2>,
}

/// How the arrivals compare with those found by shooting.
struct Comparison {
    largest: f64,
    missed: usize,
    compared: usize,
}

impl Survey {
    fn new(description: &Description) -> Result<Self> {
        let corners = description.corners.map(DVec2::from_array);
        let mut media = Vec::new();
        let mut indicatrices = Vec::new();
        for medium in &description.media {
            let (axes, angle) = match *medium {
                MediumDescription::Isotropic { speed } => ([speed, speed], 0.0),
                MediumDescription::Elliptical { semi_axes, angle } => (semi_axes, angle),
            };
            media.push(match *medium {
                MediumDescription::Isotropic { speed } => Medium::isotropic(speed)?,
                MediumDescription::Elliptical { .. } => {
                    Medium::elliptical(axes[0], axes[1], angle)?
                }
            });
            indicatrices.push(DMat2::from_angle(angle) * DMat2::from_diagonal(axes.into()));
        }
        let mut graphs = Vec::new();
        let mut interfaces = Vec::new();
        for (number, interface) in description.interfaces.iter().enumerate() {
            let (points, straight) = match interface {
                InterfaceDescription::Line(points) => (points.as_slice(), true),
                InterfaceDescription::Graph(points) => (points.as_slice(), false),
            };
            let mut points: Vec<DVec2> = points.iter().copied().map(DVec2::from_array).collect();
            if straight {
                points.sort_by(|a, b| a.x.total_cmp(&b.x));
            }
            let graph = Graph::new(points).with_context(|| format!("interface {number}"))?;
            let shape = if straight {
                Interface::line(graph.samples[0], graph.samples[1] - graph.samples[0])
            } else {
                graph.interface(corners)
            };
            interfaces.push(shape.map_err(|error| error.at_interface(number))?);
            graphs.push(graph);
        }
        let model = Model::try_new(corners[0], corners[1], media, interfaces)?;
        let (source, receivers) = (
            DVec2::from_array(description.source),
            description.receivers.map(DVec2::from_array),
        );
        ensure!(
            source.is_finite() && receivers.iter().all(|p| p.is_finite()),
            "source and receivers are finite"
        );
        ensure!(
            receivers[0].y == receivers[1].y && receivers[0].x != receivers[1].x,
            "receivers lie on a horizontal line"
        );
        let layer = model.layer_at(source);
        for receiver in receivers {
            ensure!(
                model.layer_at(receiver) == layer,
                "source and receivers lie in the same medium"
            );
        }
        Ok(Self {
            model,
            source,
            layer,
            receivers,
            graphs,
            indicatrices,
        })
    }

    fn fans<'a>(&'a self, codes: impl Iterator<Item = &'a Code>) -> Result<Vec<Fan<'a>>> {
        let mut fans = Vec::new();
        for code in codes {
            let fan = Fan::new(
                &self.model,
                Source::point(self.source),
                code.clone(),
                FanOptions::default(),
            )?;
            if fan.ray_count() > 0 {
                fans.push(fan);
            }
        }
        Ok(fans)
    }

    /// Whether a history ends in the medium of the receivers, not at once.
    fn returns(&self, code: &Code) -> bool {
        let layers = self.model.layers_along(self.layer, code);
        !code.steps.is_empty() && layers.is_ok_and(|layers| layers.last() == Some(&self.layer))
    }

    fn receiver(&self, share: f64) -> DVec2 {
        self.receivers[0].lerp(self.receivers[1], share)
    }

    /// The slowest crossing of the model, a time.
    fn crossing_time(&self) -> f64 {
        let slowest = self
            .model
            .media()
            .iter()
            .map(|m| m.front_speed(DVec2::Y))
            .fold(f64::INFINITY, f64::min);
        self.model.size() / slowest
    }

    /// All fronts with the numbers of their fans.
    fn fronts(&self, fans: &[Fan<'_>]) -> Result<Vec<(usize, Front)>> {
        let tolerance = FrontTolerance::time(FRONT_TOLERANCE * self.crossing_time());
        let mut fronts = Vec::new();
        for (index, fan) in fans.iter().enumerate() {
            fronts.extend(
                fan.fronts(tolerance)?
                    .into_iter()
                    .map(|front| (index, front)),
            );
        }
        Ok(fronts)
    }

    /// The largest distance between the fitted fronts and exact rays, relative to the model's size: at the place of a ray
    /// at some time the front that passes closest to that time, times the speed.
    fn front_distance(
        &self,
        fans: &[Fan<'_>],
        fronts: &[(usize, Front)],
        count: usize,
    ) -> Result<f64> {
        let later = 0.1 * self.crossing_time();
        let mut largest = 0.0_f64;
        for (index, fan) in fans.iter().enumerate() {
            for [start, end] in fan.illuminated() {
                for i in 0..count {
                    let share = (i as f64 + 0.5) / count as f64;
                    let trace = fan.trace(start + share * (end - start))?;
                    let ray = trace.last().context("a ray has legs")?;
                    let medium = &self.model.media()[fan.last_layer()];
                    let there = ray.after(later, medium);
                    let mut error = f64::INFINITY;
                    for (_, front) in fronts.iter().filter(|(fan, _)| *fan == index) {
                        for (time, _) in front.arrivals(there.point)? {
                            error = error.min((time - there.time).abs());
                        }
                    }
                    largest =
                        largest.max(error * medium.front_speed(ray.normal()) / self.model.size());
                }
            }
        }
        Ok(largest)
    }

    // What follows knows nothing of the crate's rays: it is there to check them.

    /// The first place where a ray leaves a layer: the interface and the travel along `direction`, scanned and bisected.
    fn exit(
        &self,
        from: DVec2,
        direction: DVec2,
        layer: usize,
        reach: f64,
    ) -> Option<(usize, f64)> {
        const STEPS: u32 = 160;
        let bounds = [
            layer.checked_sub(1),
            (layer < self.graphs.len()).then_some(layer),
        ];
        let sides = bounds.into_iter().flatten().map(|interface| {
            // Below the upper boundary, above the lower one: positive inside.
            let sign = if interface == layer { 1.0 } else { -1.0 };
            let inside = move |s: f64| {
                let p = from + s * direction;
                sign * (p.y - self.graphs[interface].at(p.x).0)
            };
            let place = |i: u32| reach * (f64::from(i) + 1e-6) / f64::from(STEPS);
            let i = (0..STEPS).find(|&i| inside(place(i)) > 0.0 && inside(place(i + 1)) <= 0.0)?;
            let (mut low, mut high) = (place(i), place(i + 1));
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if inside(middle) > 0.0 {
                    low = middle
                } else {
                    high = middle
                }
            }
            Some((interface, 0.5 * (low + high)))
        });
        sides.flatten().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The slowness of the wave with a front normal, and the direction of its ray.
    fn wave(&self, layer: usize, slowness: DVec2) -> (DVec2, DVec2) {
        let map = self.indicatrices[layer];
        (slowness, map * (map.transpose() * slowness))
    }

    /// Shoots a ray through a code to the receivers' line: where it lands, and when.
    fn shoot(&self, code: &Code, angle: f64) -> Option<(f64, f64)> {
        let reach = 2.0 * self.model.size();
        let normal = DVec2::from_angle(angle);
        let start = normal / (self.indicatrices[self.layer].transpose() * normal).length();
        let (mut point, mut layer, mut time) = (self.source, self.layer, 0.0);
        let (mut slowness, mut velocity) = self.wave(layer, start);
        for step in &code.steps {
            let direction = velocity.normalize();
            let (interface, along) = self.exit(point, direction, layer, reach)?;
            if interface != step.interface {
                return None;
            }
            point += along * direction;
            time += along / velocity.length();
            let tangent = dvec2(1.0, self.graphs[interface].at(point.x).1).normalize();
            let below = if layer == interface {
                interface + 1
            } else {
                interface
            };
            if step.mode == Mode::Transmit {
                layer = below;
            }
            // |map^T (tau t + nu n)| = 1 for the component nu, on the side where the wave continues.
            let map = self.indicatrices[layer].transpose();
            let (u, v) = (
                slowness.dot(tangent) * (map * tangent),
                map * tangent.perp(),
            );
            let (a, b, c) = (v.length_squared(), u.dot(v), u.length_squared() - 1.0);
            let root = (b * b - a * c).sqrt();
            // The ray's component along n is a nu + b; upwards in the layer above the interface, downwards below it.
            let side = if layer == interface { 1.0 } else { -1.0 };
            let nu = (side * root - b) / a;
            if nu.is_nan() {
                return None;
            }
            (slowness, velocity) =
                self.wave(layer, slowness.dot(tangent) * tangent + nu * tangent.perp());
        }
        let travel = (self.receivers[0].y - point.y) / velocity.y;
        let reaches = travel > 0.0
            && self
                .exit(point, velocity.normalize(), layer, reach)
                .is_none_or(|(_, along)| along > travel * velocity.length());
        reaches.then_some((point.x + travel * velocity.x, time + travel))
    }

    /// Arrivals by shooting: `angles` rays, and bisection wherever two neighbours land on different sides of the receiver.
    fn check_arrivals(&self, fans: &[Fan<'_>], receivers: usize, angles: u32) -> Comparison {
        let mut comparison = Comparison {
            largest: 0.0,
            missed: 0,
            compared: 0,
        };
        let angle = |i: u32| TAU * (f64::from(i) + 0.37) / f64::from(angles);
        for fan in fans {
            let landings: Vec<_> = (0..angles)
                .map(|i| self.shoot(fan.code(), angle(i)))
                .collect();
            for index in 0..receivers {
                let receiver = self.receiver((index as f64 + 0.5) / receivers as f64);
                let found: Vec<f64> = fan
                    .arrivals(receiver)
                    .iter()
                    .map(|arrival| arrival.time)
                    .collect();
                for i in 0..angles - 1 {
                    let (Some((left, _)), Some((right, _))) =
                        (landings[i as usize], landings[i as usize + 1])
                    else {
                        continue;
                    };
                    if (left < receiver.x) == (right < receiver.x) {
                        continue;
                    }
                    let Some(time) = self.bisect(fan.code(), [angle(i), angle(i + 1)], receiver.x)
                    else {
                        continue;
                    };
                    let error = found
                        .iter()
                        .map(|other| (other / time - 1.0).abs())
                        .fold(f64::INFINITY, f64::min);
                    comparison.compared += 1;
                    if error < 1e-6 {
                        comparison.largest = comparison.largest.max(error);
                    } else {
                        comparison.missed += 1;
                    }
                }
            }
        }
        comparison
    }

    /// The time of the ray between two angles that lands at `x`; none if the rays in between are torn apart.
    fn bisect(&self, code: &Code, [mut low, mut high]: [f64; 2], x: f64) -> Option<f64> {
        let before = self.shoot(code, low)?.0 < x;
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if (self.shoot(code, middle)?.0 < x) == before {
                low = middle
            } else {
                high = middle
            }
        }
        let (place, time) = self.shoot(code, 0.5 * (low + high))?;
        ((place - x).abs() < 1e-8 * self.model.size()).then_some(time)
    }

    // Pictures.

    fn background(&self, title: &str) -> Plot {
        let [low, high] = self.model.corners();
        let mut plot = Plot::geometry(title);
        plot.view(low, high);
        let line = |graph: &Graph| -> Vec<DVec2> {
            let place = |i: u32| low.x + (high.x - low.x) * f64::from(i) / 300.0;
            (0..=300)
                .map(|i| dvec2(place(i), graph.at(place(i)).0))
                .collect()
        };
        for (index, graph) in self.graphs.iter().enumerate() {
            let mut region = line(graph);
            region.extend([dvec2(high.x, low.y), dvec2(low.x, low.y)]);
            let shade = MIST.mix(GREY, 0.45 * index as f32 / self.graphs.len() as f32);
            plot.polygon(&region, shade.fill());
        }
        for graph in &self.graphs {
            plot.polyline(&line(graph), INK.line().width(1.4));
        }
        plot
    }

    fn marks(&self, plot: &mut Plot) {
        let places: Vec<DVec2> = (0..=16)
            .map(|i| self.receiver(f64::from(i) / 16.0))
            .collect();
        plot.points(&places, Marker::Square, INK.fill());
        plot.point(self.source, "", Side::Above, VERMILION.fill());
    }

    /// A colour for the number of interfaces that a wave has met, and what is said of it.
    fn style(code: &Code) -> Style {
        let met = code.steps.len();
        Color::cycle(met).line().label(match met {
            0 => "direct".into(),
            1 => "one interface met".into(),
            count => format!("{count} interfaces met"),
        })
    }

    fn draw(
        &self,
        context: &mut Context,
        returning: &[Fan<'_>],
        all: &[Fan<'_>],
        fronts: &[(usize, Front)],
    ) -> Result<()> {
        let mut rays = self.background("rays that come back");
        for fan in returning {
            let color = Color::cycle(fan.code().steps.len());
            let style = color.line().width(0.9).label(name(fan.code()));
            for receiver in (0..=8).map(|i| self.receiver(f64::from(i) / 8.0)) {
                for arrival in fan.arrivals(receiver) {
                    let trace = fan.trace(arrival.parameter)?;
                    let mut path: Vec<DVec2> = vec![self.source];
                    path.extend(trace.impacts.iter().map(|impact| impact.point));
                    path.push(receiver);
                    rays.polyline(&path, style.clone());
                }
            }
        }
        self.marks(&mut rays);
        let mut snapshots = self.background("fronts at equal steps of time");
        for step in 1..=7 {
            let time = self.last_time() * f64::from(step) / 7.0;
            self.draw_fronts(&mut snapshots, all, fronts, time, 1.3);
        }
        self.marks(&mut snapshots);
        context.figure(
            "figure",
            &Figure::grid(1, vec![rays, snapshots]).aspect(1.9),
            "Rays to nine receivers with their histories, and all fronts at seven times; a colour tells how many interfaces a wave has met.",
            "Two sections through three layers with curved boundaries: coloured broken rays from one point, and curved fronts.",
        )
    }

    fn draw_fronts(
        &self,
        plot: &mut Plot,
        fans: &[Fan<'_>],
        fronts: &[(usize, Front)],
        time: f64,
        width: f64,
    ) {
        for (fan, front) in fronts {
            for stretch in front.snapshot_inside(&self.model, time, 24) {
                plot.polyline(&stretch, Self::style(fans[*fan].code()).width(width));
            }
        }
    }

    /// When the first interface's echo has long come back.
    fn last_time(&self) -> f64 {
        0.6 * self.crossing_time()
    }

    /// The arrival times as curves, and what receivers would record: the section and a seismogram.
    fn draw_section(&self, context: &mut Context, returning: &[Fan<'_>]) -> Result<()> {
        let line = |count: u32| -> Vec<DVec2> {
            let share = |i: u32| f64::from(i) / f64::from(count - 1);
            (0..count).map(|i| self.receiver(share(i))).collect()
        };
        let receivers = line(context.pick(801, 101));
        let mut chart = Plot::chart("arrivals", "receiver", "time");
        let answers = section(returning, &receivers);
        for (index, fan) in returning.iter().enumerate() {
            let color = Color::cycle(fan.code().steps.len());
            let mut points = Vec::new();
            for (receiver, found) in receivers.iter().zip(&answers) {
                let its = found.iter().filter(|(fan, _)| *fan == index);
                points.extend(its.map(|(_, arrival)| dvec2(receiver.x, arrival.time)));
            }
            let dots = points
                .iter()
                .map(|at| [*at, *at + dvec2(1e-3 * self.model.size(), 0.0)]);
            for dash in dots {
                let style = color.line().width(2.0).label(name(fan.code()));
                chart.polyline(&dash, style);
            }
        }
        let traces = line(context.pick(65, 17));
        let spacing = traces[0].distance(traces[1]);
        let times: Vec<f64> = answers
            .iter()
            .flatten()
            .map(|(_, arrival)| arrival.time)
            .collect();
        let (first, last) = times.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), time| {
            (a.min(*time), b.max(*time))
        });
        let pulse = Pulse {
            period: 0.035 * (last - first),
        };
        let mut seismogram = Plot::chart("seismogram", "receiver", "time");
        for (receiver, found) in traces.iter().zip(section(returning, &traces)) {
            let at = |i: u32| {
                let time = first + (last - first) * (f64::from(i) / 600.0 * 1.1 - 0.05);
                let motion: f64 = found
                    .iter()
                    .map(|(_, arrival)| pulse.of(arrival, time, self.model.size()))
                    .sum();
                (time, motion)
            };
            let place = |time: f64, motion: f64| dvec2(receiver.x + 0.9 * spacing * motion, time);
            let wiggle: Vec<(f64, f64)> = (0..=600).map(at).collect();
            let mut filled: Vec<DVec2> = wiggle
                .iter()
                .map(|(time, motion)| place(*time, motion.max(0.0)))
                .collect();
            filled.extend([place(wiggle[600].0, 0.0), place(wiggle[0].0, 0.0)]);
            seismogram.polygon(&filled, INK.fill());
            let line: Vec<DVec2> = wiggle
                .iter()
                .map(|(time, motion)| place(*time, *motion))
                .collect();
            seismogram.polyline(&line, INK.line().width(0.6));
        }
        context.figure(
            "figure-section",
            &Figure::grid(2, vec![chart, seismogram]).aspect(0.8),
            "All arrivals against the receiver, where caustics show as bow ties; and what is recorded: pulses as strong as the ray \
             tubes are narrow, their phase turned by a quarter at each caustic.",
            "Curves of arrival times in several colours, some of them crossing themselves; and wiggle traces with pulses there.",
        )
    }

    fn animate(
        &self,
        context: &mut Context,
        fans: &[Fan<'_>],
        fronts: &[(usize, Front)],
    ) -> Result<()> {
        let frames = context.pick(60, 4);
        let width = context.width().min(800);
        let images: Vec<_> = (1..=frames)
            .map(|frame| {
                let time = self.last_time() * f64::from(frame) / f64::from(frames);
                let mut plot = self.background("");
                self.draw_fronts(&mut plot, fans, fronts, time, 1.8);
                self.marks(&mut plot);
                plot.legend(Corner::BottomRight);
                Figure::new(plot).aspect(1.9).image(width)
            })
            .collect();
        context.animation(
            "figure-running",
            &images,
            12,
            "The fronts of all histories run through the model.",
            "Animated coloured fronts that start at a point, pass and bounce off two curved interfaces.",
        )
    }
}

/// What a source sends out.
struct Pulse {
    /// Of its main oscillation.
    period: f64,
}

impl Pulse {
    /// An arrival's share of the motion at a time: an oscillation under a bell, its phase turned by a quarter for each
    /// caustic that the ray has touched. Relative to the direct wave at a fifth of the model's size; reflection and
    /// transmission are taken as complete, and the infinite amplitude on a caustic is cut off.
    fn of(&self, arrival: &Arrival, time: f64, size: f64) -> f64 {
        let phase = (time - arrival.time) / self.period;
        let strength = (arrival.amplitude(TAU) * (0.2 * size).sqrt()).min(1.5);
        let turned = TAU * phase + f64::from(arrival.caustics) * FRAC_PI_2;
        strength * (-2.5 * phase * phase).exp() * turned.cos()
    }
}

/// A history in words of two signs a step: which interface, and reflected or transmitted.
fn name(code: &Code) -> String {
    let sign = |step: &wavefront::Step| match step.mode {
        Mode::Reflect => format!("R{}", step.interface + 1),
        Mode::Transmit => format!("T{}", step.interface + 1),
    };
    code.steps.iter().map(sign).collect::<Vec<_>>().join(" ")
}
