//! Rays through a model, leg by leg.

use glam::DVec2;

use crate::strip::{Reach, Strip};
use crate::{Code, Error, Impact, Model, Ray};

/// A ray at its source and after each step of a code, with the impacts in between.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
impl Model {
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
            let medium = &self.media()[window[0]];
            let impact = self
                .impact_on(step.interface, window[0], left, &ray)
                .map_err(failure)?;
            ray = ray
                .arrive(&impact, medium)
                .scatter(&impact, step.mode, medium, &self.media()[window[1]])
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
        let velocity = self.media()[layer].group_velocity(ray.slowness);
        let margin = SELF_IMPACT * self.size() / velocity.length();
        let impact = self.interfaces()[interface]
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
        let [low, high] = self.corners();
        point.cmpge(low - margin).all() && point.cmple(high + margin).all()
    }

    /// The interfaces above and below a layer, as far as there are any.
    fn boundaries(&self, layer: usize) -> impl Iterator<Item = usize> + use<> {
        let count = self.interfaces().len();
        [layer.checked_sub(1), Some(layer)]
            .into_iter()
            .flatten()
            .filter(move |&boundary| boundary < count)
    }

    #[inline]
    fn blocks(&self, interface: usize, from: DVec2, to: DVec2, left: Option<(usize, f64)>) -> bool {
        let parameter = left.and_then(|(at, parameter)| (at == interface).then_some(parameter));
        let margin = SELF_IMPACT * self.size() / from.distance(to);
        self.interfaces()[interface].blocks(from, to, parameter, margin)
    }

    /// Whether a ray of `layer` that starts at `from`, on a boundary to a small part of the model's size, comes to `to` inside
    /// the box without meeting a boundary.
    pub(crate) fn is_free(&self, layer: usize, from: DVec2, to: DVec2) -> bool {
        let way = to - from;
        let clearance = CLEARANCE * self.size() / way.length();
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
    #[inline(always)]
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
            let medium = &self.media()[window[0]];
            let ray = &landing.ray;
            let velocity = medium.group_velocity(ray.slowness);
            let after = SELF_IMPACT * self.size() / velocity.length();
            let impact = self.interfaces()[step.interface].impact_near(
                ray.point,
                velocity,
                after,
                expected(index),
            )?;
            let there = ray.arrive(&impact, medium);
            landing.caustics += u32::from(ray.is_beyond_caustic_at(&there, velocity));
            landing.ray = there
                .scatter(&impact, step.mode, medium, &self.media()[window[1]])
                .ok()?;
            landing.left = Some((step.interface, impact.parameter));
        }
        Some(landing)
    }

    /// Whether a wave on its last leg comes to `point`, which lies before it, without meeting a boundary of its layer.
    #[inline]
    pub(crate) fn is_unblocked(&self, landing: &Landing, layer: usize, point: DVec2) -> bool {
        !self
            .boundaries(layer)
            .any(|boundary| self.blocks(boundary, landing.ray.point, point, landing.left))
    }

    /// Whether all rays of a strip in `layer`, which have left the interface `left`, surely meet no boundary of the layer.
    pub(crate) fn is_clear(
        &self,
        strip: &Strip,
        reach: &Reach,
        layer: usize,
        left: Option<usize>,
    ) -> bool {
        self.boundaries(layer).all(|boundary| {
            self.interfaces()[boundary].is_clear_of(strip, reach, left == Some(boundary))
        })
    }
}
