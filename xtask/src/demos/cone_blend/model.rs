//! A blend as triangles and as exact patches: the kept parts of both cones and the tube between them.

use std::f64::consts::TAU;

use anyhow::{Result, anyhow};
use cyclide::{Blend, Cone, ContactFamily, SphereLine, Tube};
use glam::DVec3;

use crate::export::Step;
use crate::mesh::Mesh;

/// The parts of a blend.
pub(super) struct Model {
    pub(super) blend: Blend,
    pub(super) tube: Tube,
    cones: [Cone; 2],
    /// Length of the kept parts of the cones along their axes.
    length: f64,
}

impl Model {
    /// The shorter of the usable tubes of a blend, with cones that go on beyond it.
    pub(super) fn new(blend: Blend, cones: [Cone; 2]) -> Result<Self> {
        let tubes = blend
            .tubes()
            .ok_or_else(|| anyhow!("a singular point lies on a contact circle"))?;
        let tube = tubes
            .into_iter()
            .filter(|tube| !tube.is_unbounded())
            // A smooth tube goes before one with a singular point, a short one before a long one.
            .min_by(|one, other| {
                (!one.is_smooth(), span(one))
                    .partial_cmp(&(!other.is_smooth(), span(other)))
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .ok_or_else(|| anyhow!("both tubes pass through infinity"))?;
        let contacts = blend.contacts();
        let radius = contacts
            .iter()
            .map(|contact| contact.circle.radius)
            .fold(0.0, f64::max);
        let apart = contacts[0]
            .circle
            .centre
            .distance(contacts[1].circle.centre);
        Ok(Self {
            blend,
            tube,
            cones,
            length: (1.3 * radius).max(0.6 * apart),
        })
    }

    /// The tube.
    pub(super) fn tube_mesh(&self, tolerance: &impl Fn(DVec3) -> f64) -> Mesh {
        let surface = *self.tube.surface();
        let meshes = self.tube.spans().into_iter().map(|[from, to]| {
            Mesh::surface(
                |u, v| {
                    let along = from + (to - from) * u;
                    // The full circle: an angle, or a line through infinity.
                    let around = if surface.as_quartic().is_some() {
                        TAU * v
                    } else {
                        (0.5 * TAU * (v - 0.5)).tan()
                    };
                    let (first, second) = match self.tube.contact_family() {
                        ContactFamily::Theta | ContactFamily::U => (along, around),
                        ContactFamily::Psi | ContactFamily::V => (around, along),
                    };
                    (surface.point(first, second), surface.normal(first, second))
                },
                tolerance,
            )
        });
        Mesh::merged(meshes)
    }

    /// The kept part of each cone.
    pub(super) fn cone_meshes(&self, tolerance: &impl Fn(DVec3) -> f64) -> [Mesh; 2] {
        [0, 1].map(|index| {
            let (cone, contact) = (&self.cones[index], &self.blend.contacts()[index]);
            let line: &SphereLine = &self.blend.family().lines()[index];
            let side = f64::from(self.tube.sides()[index]) * line.axis().dot(cone.axis()).signum();
            let start = (contact.circle.centre - cone.point()).dot(cone.axis());
            let mut end = start + side * self.length;
            // A cone that narrows ends in its tip.
            if !cone.is_cylinder() && start * end < 0.0 {
                end = 0.0;
            }
            let (sin, cos) = cone.half_angle().sin_cos();
            let across = cone.axis().any_orthonormal_vector();
            let other = cone.axis().cross(across);
            let nappe = f64::from(cone.nappe_at(start));
            Mesh::surface(
                |u, v| {
                    let height = start + (end - start) * u;
                    let radius = cone.radius() + height * cone.half_angle().tan();
                    let (s, c) = (TAU * v).sin_cos();
                    let radial = c * across + s * other;
                    // On the far nappe the radius is negative, and so the normal changes side.
                    (
                        cone.point() + height * cone.axis() + radius * radial,
                        nappe * (cos * radial - sin * cone.axis()),
                    )
                },
                tolerance,
            )
        })
    }

    /// The contact circles as thin rings.
    pub(super) fn rings(&self, thickness: f64) -> Mesh {
        Mesh::merged(self.blend.contacts().iter().map(|contact| {
            let points: Vec<DVec3> = (0..160)
                .map(|i| contact.circle.point(TAU * f64::from(i) / 160.0))
                .collect();
            Mesh::tube(&points, thickness, true)
        }))
    }

    /// The tube as exact rational biquadratic patches.
    pub(super) fn step(&self, name: &str) -> Result<Step> {
        let mut step = Step::new(name);
        for patch in self
            .tube
            .positive_patches(cyclide::tolerance::POSITIVE_WEIGHT)?
        {
            step.patch(&(*patch.net()).into())?;
        }
        Ok(step)
    }

    /// A length of the order of the model.
    pub(super) fn size(&self) -> f64 {
        self.length
    }
}

fn span(tube: &Tube) -> f64 {
    tube.spans()
        .iter()
        .map(|[from, to]| (to - from).abs())
        .sum()
}
