//! The two tubes between the contact circles of a blend.

use crate::{Blend, ContactFamily, CyclidePatch, Dupin, Error, Kind, tolerance};
use glam::DVec3;
use std::f64::consts::TAU;

/// One of the two parts into which the contact circles cut the surface of a blend.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(remote = "Self")
)]
pub struct Tube {
    surface: Dupin,
    contact_family: ContactFamily,
    ends: [f64; 2],
    growing: bool,
    sides: [i8; 2],
}

impl Blend {
    /// The two tubes between the contact circles, the one with growing parameter first; `None` if a singular point lies on
    /// the contact circles, so that neither joins the cones smoothly.
    ///
    /// Which part of each cone a tube continues is decided by the velocity of the surface across the contact circle, not by the motion of
    /// the sphere's centre, which may be opposite.
    #[must_use]
    pub fn tubes(&self) -> Option<[Tube; 2]> {
        if !self.is_usable() {
            return None;
        }
        let [from, to] = self.contacts().map(|contact| contact.parameter);
        let forward: [i8; 2] = [(from, -1.0), (to, 1.0)].map(|(parameter, sign)| {
            let [first, second] = self.family().lines();
            let axis = if sign < 0.0 { first.axis } else { second.axis };
            if sign * self.velocity(parameter).dot(axis) > 0.0 {
                1
            } else {
                -1
            }
        });
        let backward = forward.map(|side| -side);
        let tube = |growing: bool, sides| Tube {
            surface: *self.surface(),
            contact_family: self.contact_family(),
            ends: [from, to],
            growing,
            sides,
        };
        Some([tube(true, forward), tube(false, backward)])
    }

    /// The tube that continues the given sides of the two cones (1 towards the axis vector, -1 away from it), if there is one: a pair of
    /// sides that neither tube continues cannot be blended without a fold.
    #[must_use]
    pub fn tube_keeping(&self, sides: [i8; 2]) -> Option<Tube> {
        self.tubes()?.into_iter().find(|tube| tube.sides == sides)
    }

    /// A positive multiple of the velocity of the surface as the parameter of the contact circles grows.
    fn velocity(&self, parameter: f64) -> DVec3 {
        let (sin, cos) = parameter.sin_cos();
        let frame = self.surface().frame();
        let local = match (self.surface(), self.contact_family()) {
            (Dupin::Quartic(surface), ContactFamily::Theta) => {
                DVec3::new(-surface.b() * sin, surface.a() * cos + surface.c(), 0.0)
            }
            (Dupin::Quartic(surface), _) => {
                DVec3::new(-surface.b() * sin, 0.0, -(surface.a() * cos + surface.c()))
            }
            (Dupin::Parabolic(_), ContactFamily::U) => DVec3::Y,
            (Dupin::Parabolic(_), _) => DVec3::Z,
        };
        frame.vector_to_world(local)
    }
}

impl Tube {
    /// The surface of which this is a part.
    #[must_use]
    pub const fn surface(&self) -> &Dupin {
        &self.surface
    }

    /// Which parameter runs from one contact circle to the other.
    #[must_use]
    pub const fn contact_family(&self) -> ContactFamily {
        self.contact_family
    }

    /// The sides of the two cones that the tube continues: 1 for the part of the cone towards its axis vector (for parallel axes the second
    /// vector turned along the first), -1 for the part away from it.
    #[must_use]
    pub const fn sides(&self) -> [i8; 2] {
        self.sides
    }

    /// The spans of the parameter from the first contact circle to the second, one after the other. One span on a quartic, shorter than
    /// a full turn and perhaps falling; two where the tube of a parabolic cyclide passes through infinity.
    #[must_use]
    pub fn spans(&self) -> Vec<[f64; 2]> {
        let [from, to] = self.ends;
        match self.surface {
            Dupin::Quartic(_) => {
                let step = (to - from).rem_euclid(TAU);
                vec![[from, from + if self.growing { step } else { step - TAU }]]
            }
            Dupin::Parabolic(_) if (from < to) == self.growing => vec![[from, to]],
            Dupin::Parabolic(_) => {
                let far = if self.growing {
                    f64::INFINITY
                } else {
                    f64::NEG_INFINITY
                };
                vec![[from, far], [-far, to]]
            }
        }
    }

    /// Whether the tube passes through infinity.
    #[must_use]
    pub fn is_unbounded(&self) -> bool {
        self.surface.as_parabolic().is_some() && (self.ends[0] < self.ends[1]) != self.growing
    }

    /// Whether no singular point lies inside. Always so on a ring; tubes of other surfaces can be smooth as well. The type is decided for
    /// numbers that were computed, as by [`Blend::kind`].
    #[must_use]
    pub fn is_smooth(&self) -> bool {
        let kind = self.surface.kind_within(tolerance::RECOVERED_KIND);
        // Where the two singular points are one, rounding may leave the cosine above 1.
        let collapsed = match (&self.surface, self.contact_family) {
            (Dupin::Quartic(surface), ContactFamily::Theta)
                if matches!(kind, Kind::SinglyHorned | Kind::DoublyHorned) =>
            {
                Some((surface.mu() / surface.c()).min(1.0).acos())
            }
            (Dupin::Quartic(surface), ContactFamily::Psi)
                if matches!(
                    kind,
                    Kind::OneSingularitySpindle
                        | Kind::TwoSingularitySpindle
                        | Kind::HornTorus
                        | Kind::SpindleTorus
                ) =>
            {
                Some((surface.a() / surface.mu()).min(1.0).acos())
            }
            (Dupin::Parabolic(surface), ContactFamily::V) if kind != Kind::ParabolicRing => {
                Some((surface.k() / surface.f() - 0.5).max(0.0).sqrt())
            }
            _ => None,
        };
        let collapsed: Vec<f64> = collapsed
            .into_iter()
            .flat_map(|parameter| [parameter, -parameter])
            .collect();
        let turning = self.surface.as_quartic().is_some();
        let inside = |[from, to]: [f64; 2], parameter: f64| {
            let (low, high) = (from.min(to), from.max(to));
            let parameter = if turning {
                low + (parameter - low).rem_euclid(TAU)
            } else {
                parameter
            };
            low <= parameter && parameter <= high
        };
        self.spans()
            .into_iter()
            .all(|span| collapsed.iter().all(|&parameter| !inside(span, parameter)))
    }

    /// Patches that cover the tube: three around each of two or more steps along it. Their controls are mass points; see
    /// [`Tube::positive_patches`] for ordinary weights.
    ///
    /// # Errors
    ///
    /// As [`Dupin::patch`].
    pub fn patches(&self) -> Result<Vec<CyclidePatch>, Error> {
        let around = self.around();
        let mut patches = Vec::new();
        for [from, to] in self.spans() {
            let middle = match self.surface {
                Dupin::Quartic(_) => 0.5 * (from + to),
                Dupin::Parabolic(_) => (0.5 * (from.atan() + to.atan())).tan(),
            };
            for along in [[from, middle], [middle, to]] {
                for &[start, end] in &around {
                    patches.push(self.patch(along, [start, end])?);
                }
            }
        }
        Ok(patches)
    }

    /// Patches that cover the tube and have ordinary weights, all at least `margin` times the largest of their patch; see
    /// [`Dupin::positive_patches`].
    ///
    /// # Errors
    ///
    /// As [`Dupin::positive_patches`]; a tube through infinity has no such patches.
    pub fn positive_patches(&self, margin: f64) -> Result<Vec<CyclidePatch>, Error> {
        let mut patches = Vec::new();
        for along in self.spans() {
            for around in self.around() {
                let (first, second) = self.in_order(along, around);
                patches.extend(self.surface.positive_patches(first, second, margin)?);
            }
        }
        Ok(patches)
    }

    /// The full circle of the other parameter, in three spans.
    fn around(&self) -> [[f64; 2]; 3] {
        let bounds = match self.surface {
            Dupin::Quartic(_) => [0.0, TAU / 3.0, 2.0 * TAU / 3.0, TAU],
            Dupin::Parabolic(_) => [f64::NEG_INFINITY, -1.0, 1.0, f64::INFINITY],
        };
        [
            [bounds[0], bounds[1]],
            [bounds[1], bounds[2]],
            [bounds[2], bounds[3]],
        ]
    }

    fn in_order<T>(&self, along: T, around: T) -> (T, T) {
        match self.contact_family {
            ContactFamily::Theta | ContactFamily::U => (along, around),
            ContactFamily::Psi | ContactFamily::V => (around, along),
        }
    }

    fn patch(&self, along: [f64; 2], around: [f64; 2]) -> Result<CyclidePatch, Error> {
        let (first, second) = self.in_order(along, around);
        self.surface.patch(first, second)
    }
}
