//! A model with its source and receivers, its waves and their fronts.

use anyhow::{Context as _, Result, ensure};
use glam::{DMat2, DVec2};
use wavefront::{Code, Fan, FanOptions, Front, FrontTolerance, Interface, Medium, Model, Source};

use super::model::{Description, Graph, InterfaceDescription, MediumDescription};

/// Fronts fit this share of the time in which a wave crosses the model.
const FRONT_TOLERANCE: f64 = 1e-7;

/// A model with its source and receivers, and the same once more as plain functions for the independent solver.
pub(super) struct Survey {
    pub(super) model: Model,
    pub(super) source: DVec2,
    /// The medium of the source and of the receivers.
    pub(super) layer: usize,
    pub(super) receivers: [DVec2; 2],
    pub(super) graphs: Vec<Graph>,
    /// The maps from the unit circle to the indicatrices.
    pub(super) indicatrices: Vec<DMat2>,
}

impl Survey {
    pub(super) fn new(description: &Description) -> Result<Self> {
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

    pub(super) fn fans<'a>(
        &'a self,
        codes: impl Iterator<Item = &'a Code>,
    ) -> Result<Vec<Fan<'a>>> {
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
    pub(super) fn returns(&self, code: &Code) -> bool {
        let layers = self.model.layers_along(self.layer, code);
        !code.steps.is_empty() && layers.is_ok_and(|layers| layers.last() == Some(&self.layer))
    }

    pub(super) fn receiver(&self, share: f64) -> DVec2 {
        self.receivers[0].lerp(self.receivers[1], share)
    }

    /// The slowest crossing of the model, a time.
    pub(super) fn crossing_time(&self) -> f64 {
        let slowest = self
            .model
            .media()
            .iter()
            .map(|m| m.front_speed(DVec2::Y))
            .fold(f64::INFINITY, f64::min);
        self.model.size() / slowest
    }

    /// All fronts with the numbers of their fans.
    pub(super) fn fronts(&self, fans: &[Fan<'_>]) -> Result<Vec<(usize, Front)>> {
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
    pub(super) fn front_distance(
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
}
