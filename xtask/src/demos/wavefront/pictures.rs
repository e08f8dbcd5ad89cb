//! The pictures of rays and fronts, still and running.

use anyhow::Result;
use glam::{DVec2, dvec2};
use wavefront::{Code, Fan, Front, Mode};

use crate::color::{Color, GREY, INK, MIST, VERMILION};
use crate::demo::Context;
use crate::figure::{Corner, Figure, Marker, Plot, Style};

use super::model::Graph;
use super::survey::Survey;

impl Survey {
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
        plot.points(&places, Marker::Square, INK.fill().label("receivers"));
        let source = VERMILION.fill().label("source");
        plot.points(&[self.source], Marker::Disc, source);
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

    pub(super) fn draw(
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

    pub(super) fn animate(
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

/// A history in words of two signs a step: which interface, and reflected or transmitted.
pub(super) fn name(code: &Code) -> String {
    let sign = |step: &wavefront::Step| match step.mode {
        Mode::Reflect => format!("R{}", step.interface + 1),
        Mode::Transmit => format!("T{}", step.interface + 1),
    };
    code.steps.iter().map(sign).collect::<Vec<_>>().join(" ")
}
