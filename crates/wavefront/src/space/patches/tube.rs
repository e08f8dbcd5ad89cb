//! A ray reflected in a mirror with its neighbours.

use glam::{DVec2, DVec3};

use crate::space::{DualSurface, Mirror, SpacePoint};

/// A reflected ray with its derivatives along two tangents of the incoming normal.
pub(super) struct Tube {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
    pub(super) tangents: [DVec3; 2],
    pub(super) point_changes: [DVec3; 2],
    normal_changes: [DVec3; 2],
}

impl Tube {
    /// The reflection of the ray with an incoming normal, set back behind the mirror by the way to it.
    pub(super) fn new(surface: &DualSurface, mirror: &Mirror, incoming: DVec3) -> Option<Self> {
        let across = incoming.any_orthonormal_vector();
        let tangents = [across, incoming.cross(across)];
        let start = SpacePoint {
            point: surface.point(incoming),
            normal: incoming,
        };
        let (way, facing) = mirror.hit(start)?;
        let hit = start.point + way * incoming;
        let inverse = mirror.gradient(hit).length().recip();
        let across = incoming.dot(facing);
        let normal = incoming - 2.0 * across * facing;
        let changes = tangents.map(|turn| {
            let drift = surface.point_change(incoming, turn) + way * turn;
            let delay = -facing.dot(drift) / across;
            let place = drift + delay * incoming;
            let bend = mirror.gradient_change(place) * inverse;
            let bend = bend - bend.dot(facing) * facing;
            let change = turn.dot(facing) + incoming.dot(bend);
            let normal_change = turn - 2.0 * (change * facing + across * bend);
            (place - delay * normal - way * normal_change, normal_change)
        });
        let tube = Self {
            point: hit - way * normal,
            normal,
            tangents,
            point_changes: changes.map(|(point, _)| point),
            normal_changes: changes.map(|(_, normal)| normal),
        };
        (tube.point.is_finite() && tube.normal.is_finite()).then_some(tube)
    }

    /// How the sphere of incoming normals is mapped to that of the outgoing ones: the factor of small areas, with its sign.
    pub(super) fn determinant(&self) -> f64 {
        let [one, two] = self.normal_changes;
        one.cross(two).dot(self.normal)
    }

    /// The change of the incoming normal, as shares of the two tangents, that changes the outgoing one by a tangent vector.
    pub(super) fn shares(&self, change: DVec3) -> DVec2 {
        let [one, two] = self.normal_changes;
        DVec2::new(
            change.cross(two).dot(self.normal),
            one.cross(change).dot(self.normal),
        ) / self.determinant()
    }
}
