//! Layered models and the rays through them.

use glam::DVec2;

use crate::{Error, Impact, Interface, Medium, Mode, Ray};

/// Media one below the other with an interface between each two, inside a box; or one medium inside a closed interface
/// in another. Medium `k` lies between the interfaces `k - 1` and `k`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Model {
    low: DVec2,
    high: DVec2,
    size: f64,
    media: Vec<Medium>,
    interfaces: Vec<Interface>,
}

/// One step of a ray code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Step {
    /// The interface that is met.
    pub interface: usize,
    /// What happens there.
    pub mode: Mode,
}

/// The history of a wave: the interfaces that it meets in order, and what happens there.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Code {
    /// The steps in order; none for the direct wave.
    pub steps: Vec<Step>,
}

/// A ray at its source and after each step of a code, with the impacts in between.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// The ray as it starts each leg; one more than the steps.
    pub legs: Vec<Ray>,
    /// The impact that ends each leg but the last.
    pub impacts: Vec<Impact>,
}

impl Trace {
    /// The ray on its last leg.
    #[must_use]
    pub fn last(&self) -> Option<&Ray> {
        self.legs.last()
    }
}

/// Where and why a ray ended.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Failure {
    /// The step of the code that could not be done.
    pub(crate) step: usize,
    pub(crate) error: Error,
}

/// A ray on its last leg.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Landing {
    pub(crate) ray: Ray,
    /// The interface that it left last, and the parameter there.
    pub(crate) left: Option<(usize, f64)>,
    /// How often it has touched a caustic before.
    pub(crate) caustics: u32,
}

/// A ray that starts on an interface must not meet it again before this share of the model's size.
const SELF_IMPACT: f64 = 1e-9;
/// The start of a front's ray is known to this share of the model's size.
const CLEARANCE: f64 = 2e-3;
/// Points along an interface at which crossings with its neighbour are looked for.
const CROSSING_SAMPLES: usize = 400;

impl Model {
    /// The model in the box between two corners.
    ///
    /// # Errors
    /// [`Error::LayerCount`] unless there is one interface less than media; [`Error::NonFinite`] for the box;
    /// [`Error::OutOfRange`] for an empty one; [`Error::InterfacesCross`] with the place, if neighbouring interfaces meet
    /// inside the box (looked for along a polyline of 400 points).
    pub fn try_new(
        low: DVec2,
        high: DVec2,
        media: Vec<Medium>,
        interfaces: Vec<Interface>,
    ) -> Result<Self, Error> {
        if media.len() != interfaces.len() + 1 {
            return Err(Error::LayerCount {
                media: media.len(),
                interfaces: interfaces.len(),
            });
        }
        if !(low.is_finite() && high.is_finite()) {
            return Err(Error::NonFinite {
                what: "the box of a model",
            });
        }
        let extent = (high - low).min_element();
        if extent <= 0.0 {
            return Err(Error::OutOfRange {
                what: "the extent of a model",
                value: extent,
            });
        }
        let model = Self {
            low,
            high,
            size: (high - low).length(),
            media,
            interfaces,
        };
        for first in 0..model.interfaces.len() {
            for second in first + 1..model.interfaces.len() {
                if let Some(place) = model.crossing(first, second) {
                    return Err(Error::InterfacesCross {
                        first,
                        second,
                        place,
                    });
                }
            }
        }
        Ok(model)
    }

    fn crossing(&self, first: usize, second: usize) -> Option<DVec2> {
        let points = self.interfaces[first].polyline(self.low, self.high, CROSSING_SAMPLES);
        points.windows(2).find_map(|ends| {
            let impact =
                self.interfaces[second].first_impact(ends[0], ends[1] - ends[0], -f64::EPSILON)?;
            let inside = impact.point.cmpge(self.low).all() && impact.point.cmple(self.high).all();
            (impact.time <= 1.0 && inside).then_some(impact.point)
        })
    }

    /// The two corners of the box.
    #[must_use]
    pub fn corners(&self) -> [DVec2; 2] {
        [self.low, self.high]
    }

    /// The diameter of the box, the length that tolerances refer to.
    #[inline]
    #[must_use]
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The media, from above.
    #[must_use]
    pub fn media(&self) -> &[Medium] {
        &self.media
    }

    /// The interfaces, from above.
    #[must_use]
    pub fn interfaces(&self) -> &[Interface] {
        &self.interfaces
    }

    /// The medium at a point: the number of interfaces that lie above it (a closed one: around it).
    #[must_use]
    pub fn layer_at(&self, point: DVec2) -> usize {
        self.interfaces
            .iter()
            .filter(|interface| interface.count_impacts(point, DVec2::Y) % 2 == 1)
            .count()
    }

    /// The medium in which a wave from `layer` runs after each step of a code.
    ///
    /// # Errors
    /// [`Error::BadCode`] for an interface that does not bound the wave's medium.
    pub fn layers_along(&self, layer: usize, code: &Code) -> Result<Vec<usize>, Error> {
        let mut layers = vec![layer];
        let mut layer = layer;
        for (step, &Step { interface, mode }) in code.steps.iter().enumerate() {
            if interface >= self.interfaces.len() {
                return Err(Error::BadCode {
                    step,
                    reason: "there is no such interface",
                });
            }
            layer = match (mode, layer) {
                (Mode::Transmit, layer) if layer == interface => interface + 1,
                (Mode::Transmit, layer) if layer == interface + 1 => interface,
                (Mode::Reflect, layer) if layer == interface || layer == interface + 1 => layer,
                _ => {
                    return Err(Error::BadCode {
                        step,
                        reason: "the interface does not bound the medium of the wave",
                    });
                }
            };
            layers.push(layer);
        }
        Ok(layers)
    }

    /// All codes of a wave from `layer`, up to `depth` steps: the direct wave, reflections, transmissions and multiples.
    #[must_use]
    pub fn codes(&self, layer: usize, depth: usize) -> Vec<Code> {
        let mut codes = vec![Code::default()];
        let mut ends = vec![(Code::default(), layer)];
        for _ in 0..depth {
            let mut longer = Vec::new();
            for (code, layer) in &ends {
                let met_last = code.steps.last().map(|step| step.interface);
                for interface in [layer.checked_sub(1), Some(*layer)].into_iter().flatten() {
                    // Straight lines do not meet a boundary of their layer twice in a row, but curves do: from inside.
                    if interface >= self.interfaces.len() || met_last == Some(interface) {
                        continue;
                    }
                    for mode in [Mode::Reflect, Mode::Transmit] {
                        let mut code = code.clone();
                        code.steps.push(Step { interface, mode });
                        if let Ok(layers) = self.layers_along(
                            *layer,
                            &Code {
                                steps: vec![Step { interface, mode }],
                            },
                        ) {
                            longer.push((code.clone(), layers[1]));
                            codes.push(code);
                        }
                    }
                }
            }
            ends = longer;
        }
        codes
    }

    /// Sends a ray through a code.
    ///
    /// # Errors
    /// [`Error::Miss`] if it leaves the model's box without meeting the interface; [`Error::Blocked`] if it meets another one
    /// first; [`Error::TotalReflection`]; [`Error::BadCode`].
    pub fn trace(&self, start: Ray, layer: usize, code: &Code) -> Result<Trace, Error> {
        let layers = self.layers_along(layer, code)?;
        self.trace_along(start, &layers, code)
            .map_err(|failure| failure.error)
    }

    /// Sends a ray through a code whose media are known.
    pub(crate) fn trace_along(
        &self,
        start: Ray,
        layers: &[usize],
        code: &Code,
    ) -> Result<Trace, Failure> {
        let mut trace = Trace {
            legs: Vec::with_capacity(code.steps.len() + 1),
            impacts: Vec::with_capacity(code.steps.len()),
        };
        let mut ray = start;
        trace.legs.push(ray);
        let mut left = None;
        for (index, (step, window)) in code.steps.iter().zip(layers.windows(2)).enumerate() {
            let failure = |error| Failure { step: index, error };
            let medium = &self.media[window[0]];
            let impact = self
                .impact_on(step.interface, window[0], left, &ray)
                .map_err(failure)?;
            ray = ray
                .arrive(&impact, medium)
                .scatter(&impact, step.mode, medium, &self.media[window[1]])
                .map_err(failure)?;
            trace.impacts.push(impact);
            trace.legs.push(ray);
            left = Some((step.interface, impact.parameter));
        }
        Ok(trace)
    }

    /// The impact on `interface`, if it is in the box and no other boundary of the layer is met before it.
    fn impact_on(
        &self,
        interface: usize,
        layer: usize,
        left: Option<(usize, f64)>,
        ray: &Ray,
    ) -> Result<Impact, Error> {
        let miss = Error::Miss { from: ray.point };
        let velocity = self.media[layer].group_velocity(ray.slowness);
        let margin = SELF_IMPACT * self.size() / velocity.length();
        let impact = self.interfaces[interface]
            .first_impact(ray.point, velocity, margin)
            .filter(|impact| self.contains(impact.point))
            .ok_or(miss)?;
        let other = self
            .boundaries(layer)
            .find(|&boundary| boundary != interface);
        if let Some(other) = other
            && self.blocks(other, ray.point, impact.point, left)
        {
            return Err(Error::Blocked {
                from: ray.point,
                interface: other,
            });
        }
        Ok(impact)
    }

    /// Whether a point lies in the box, to the margin within which a ray does not meet the interface that it left.
    fn contains(&self, point: DVec2) -> bool {
        let margin = SELF_IMPACT * self.size();
        point.cmpge(self.low - margin).all() && point.cmple(self.high + margin).all()
    }

    /// The interfaces above and below a layer, as far as there are any.
    fn boundaries(&self, layer: usize) -> impl Iterator<Item = usize> + use<> {
        let count = self.interfaces.len();
        [layer.checked_sub(1), Some(layer)]
            .into_iter()
            .flatten()
            .filter(move |&boundary| boundary < count)
    }

    #[inline]
    fn blocks(&self, interface: usize, from: DVec2, to: DVec2, left: Option<(usize, f64)>) -> bool {
        let parameter = left.and_then(|(at, parameter)| (at == interface).then_some(parameter));
        let margin = SELF_IMPACT * self.size() / from.distance(to);
        self.interfaces[interface].blocks(from, to, parameter, margin)
    }

    /// Whether a ray of `layer` that starts at `from`, on a boundary to a small part of the model's size, comes to `to` inside
    /// the box without meeting a boundary.
    pub(crate) fn is_free(&self, layer: usize, from: DVec2, to: DVec2) -> bool {
        let way = to - from;
        let clearance = CLEARANCE * self.size / way.length();
        let inner = from + clearance * way;
        if clearance >= 1.0 {
            return self.contains(to);
        }
        // A ray that sets out along its interface may be on the wrong side of it already.
        self.contains(to)
            && self.layer_at(inner) == layer
            && !self
                .boundaries(layer)
                .any(|boundary| self.blocks(boundary, inner, to, None))
    }

    /// A ray near traced ones, by Newton's method on each interface from the expected parameters of the impacts: quick, and
    /// none where the neighbours are no guide (a grazing ray, total reflection).
    #[inline]
    pub(crate) fn trace_near(
        &self,
        start: Ray,
        layers: &[usize],
        code: &Code,
        expected: impl Fn(usize) -> f64,
    ) -> Option<Landing> {
        let mut landing = Landing {
            ray: start,
            left: None,
            caustics: 0,
        };
        for (index, (step, window)) in code.steps.iter().zip(layers.windows(2)).enumerate() {
            let medium = &self.media[window[0]];
            let ray = &landing.ray;
            let velocity = medium.group_velocity(ray.slowness);
            let after = SELF_IMPACT * self.size() / velocity.length();
            let impact = self.interfaces[step.interface].impact_near(
                ray.point,
                velocity,
                after,
                expected(index),
            )?;
            let there = ray.arrive(&impact, medium);
            landing.caustics += u32::from(ray.is_beyond_caustic_at(&there, velocity));
            landing.ray = there
                .scatter(&impact, step.mode, medium, &self.media[window[1]])
                .ok()?;
            landing.left = Some((step.interface, impact.parameter));
        }
        Some(landing)
    }

    /// Whether a wave on its last leg reaches `point` without meeting a boundary of its layer before.
    #[inline]
    pub(crate) fn reaches(&self, landing: &Landing, layer: usize, point: DVec2) -> bool {
        let from = landing.ray.point;
        let velocity = self.media[layer].group_velocity(landing.ray.slowness);
        velocity.dot(point - from) > 0.0
            && !self
                .boundaries(layer)
                .any(|boundary| self.blocks(boundary, from, point, landing.left))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_layers() -> Model {
        let media = vec![
            Medium::isotropic(1.0).unwrap(),
            Medium::isotropic(1.5).unwrap(),
        ];
        Model::try_new(
            DVec2::splat(-5.0),
            DVec2::splat(5.0),
            media,
            vec![Interface::horizontal(0.0).unwrap()],
        )
        .unwrap()
    }

    #[test]
    fn codes_know_their_media() {
        let model = two_layers();
        let (down, back) = (
            Step {
                interface: 0,
                mode: Mode::Transmit,
            },
            Step {
                interface: 0,
                mode: Mode::Reflect,
            },
        );
        assert_eq!(
            model.layers_along(0, &Code { steps: vec![down] }).unwrap(),
            [0, 1]
        );
        assert_eq!(
            model.layers_along(1, &Code { steps: vec![back] }).unwrap(),
            [1, 1]
        );
        let bad = Code {
            steps: vec![Step {
                interface: 1,
                mode: Mode::Reflect,
            }],
        };
        assert!(matches!(
            model.layers_along(0, &bad),
            Err(Error::BadCode { step: 0, .. })
        ));
        assert_eq!(model.layer_at(DVec2::new(0.0, 1.0)), 0);
        assert_eq!(model.layer_at(DVec2::new(0.0, -1.0)), 1);
        assert_eq!(model.codes(0, 3).len(), 3);
    }

    #[test]
    fn models_whose_interfaces_cross_are_refused_with_the_place() {
        let medium = || Medium::isotropic(1.0).unwrap();
        let interfaces = vec![
            Interface::horizontal(0.0).unwrap(),
            Interface::line(DVec2::new(2.0, 0.0), DVec2::ONE).unwrap(),
        ];
        let model = Model::try_new(
            DVec2::splat(-5.0),
            DVec2::splat(5.0),
            vec![medium(), medium(), medium()],
            interfaces,
        );
        match model {
            Err(Error::InterfacesCross {
                first: 0,
                second: 1,
                place,
            }) => assert!(place.distance(DVec2::new(2.0, 0.0)) < 1e-9),
            other => panic!("{other:?}"),
        }
        let missing = Model::try_new(
            DVec2::ZERO,
            DVec2::ONE,
            vec![medium()],
            vec![Interface::horizontal(0.5).unwrap()],
        );
        assert!(matches!(
            missing,
            Err(Error::LayerCount {
                media: 1,
                interfaces: 1
            })
        ));
        assert!(matches!(
            Model::try_new(DVec2::ONE, DVec2::ZERO, vec![medium()], vec![]),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            Model::try_new(DVec2::NAN, DVec2::ONE, vec![medium()], vec![]),
            Err(Error::NonFinite { .. })
        ));
    }

    #[test]
    fn the_tubes_derivatives_are_those_of_the_neighbours() {
        let media = vec![
            Medium::elliptical(1.3, 0.8, 0.3).unwrap(),
            Medium::isotropic(1.1).unwrap(),
            Medium::elliptical(0.9, 1.4, -0.2).unwrap(),
        ];
        let wave = |height: f64| {
            Interface::graph(-6.0, 6.0, 60, move |x: f64| {
                [height + 0.2 * x.sin(), 0.2 * x.cos(), -0.2 * x.sin()]
            })
            .unwrap()
        };
        let model = Model::try_new(
            DVec2::splat(-5.0),
            DVec2::splat(5.0),
            media,
            vec![wave(0.0), wave(-1.5)],
        )
        .unwrap();
        let steps = [(0, Mode::Transmit), (1, Mode::Reflect), (0, Mode::Transmit)];
        let code = Code {
            steps: steps
                .map(|(interface, mode)| Step { interface, mode })
                .to_vec(),
        };
        let at = |angle: f64| {
            let slowness = model.media()[0].slowness(DVec2::from_angle(angle));
            let ray = Ray::from_point(DVec2::new(0.2, 1.0), slowness, &model.media()[0]);
            *model.trace(ray, 0, &code).unwrap().last().unwrap()
        };
        let (angle, step) = (-1.5, 1e-5);
        let (before, here, after) = (at(angle - step), at(angle), at(angle + step));
        let difference = |f: &dyn Fn(&Ray) -> DVec2| (f(&after) - f(&before)) / (2.0 * step);
        assert!((difference(&|ray| ray.point) - here.point_change).length() < 1e-7);
        assert!((difference(&|ray| ray.slowness) - here.slowness_change).length() < 1e-7);
        assert!(((after.time - before.time) / (2.0 * step) - here.time_change).abs() < 1e-7);
        // Fermat: the arrival time at a point of the ray is stationary in the family.
        let point = here.after(0.7, &model.media()[0]).point;
        // Central differences leave the third derivative times the step squared.
        assert!((after.time_at(point) - before.time_at(point)).abs() / (2.0 * step) < 1e-7);
    }
}
