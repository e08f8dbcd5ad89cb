//! What the receivers hear: all arrivals, and a seismogram.

use std::f64::consts::{FRAC_PI_2, TAU};

use anyhow::Result;
use glam::{DVec2, dvec2};
use wavefront::{Arrival, Fan, section};

use crate::color::{Color, INK};
use crate::demo::Context;
use crate::figure::{Figure, Plot};

use super::pictures::name;
use super::survey::Survey;

impl Survey {
    /// The arrival times as curves, and what receivers would record: the section and a seismogram.
    pub(super) fn draw_section(&self, context: &mut Context, returning: &[Fan<'_>]) -> Result<()> {
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
