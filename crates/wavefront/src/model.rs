//! Layered models: media, the interfaces between them, and whether they fit together.

use glam::DVec2;

use crate::{Error, Interface, Medium};

/// Media one below the other with an interface between each two, inside a box; or one medium inside a closed interface
/// in another. Medium `k` lies between the interfaces `k - 1` and `k`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredModel",
        into = "crate::stored::StoredModel"
    )
)]
pub struct Model {
    low: DVec2,
    high: DVec2,
    size: f64,
    media: Vec<Medium>,
    interfaces: Vec<Interface>,
}

/// Points along an interface at which crossings with its neighbour are looked for.
const CROSSING_SAMPLES: usize = 400;

impl Model {
    /// The model in the box between two corners.
    ///
    /// # Errors
    /// [`Error::LayerCount`] unless there is one interface less than media; [`Error::NonFinite`] for the box;
    /// [`Error::OutOfRange`] for an empty one; [`Error::BadInterface`] with its number for an interface that the box does not
    /// contain a part of; [`Error::InterfacesCross`] with the place, if neighbouring interfaces meet
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
        for (number, interface) in model.interfaces.iter().enumerate() {
            if !interface.may_enter(low, high) {
                return Err(Error::BadInterface {
                    interface: number,
                    reason: "it does not pass through the model's box",
                });
            }
        }
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Code, Mode, Ray, Step};

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
