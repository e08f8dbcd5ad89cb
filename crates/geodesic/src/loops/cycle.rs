//! The strip of faces along a closed polyline.

use crate::SurfacePoint;
use crate::mesh::{Mesh, face_of};
use crate::pivot::{push_fan, ray_in_face};
use crate::strip::{Side, Strip};

/// Cancels steps straight back, across the seam as well.
pub(super) fn reduce(mesh: &Mesh, cycle: &mut Vec<u32>) {
    let mut strip = Strip::default();
    cycle.drain(..).for_each(|portal| strip.push(mesh, portal));
    let portals = &strip.portals;
    let back = (0..portals.len() / 2)
        .take_while(|&i| mesh.twin(portals[i]) == Some(portals[portals.len() - 1 - i]))
        .count();
    cycle.extend_from_slice(&portals[back..portals.len() - back]);
}

/// The portals that a closed polyline crosses, its last point being its first.
pub(super) fn cycle_of(mesh: &Mesh, points: &[SurfacePoint], faces: &[u32]) -> Vec<u32> {
    let mut strip = Strip::default();
    strip_along(mesh, points, faces, &mut strip);
    if let (Some(&first), Some(&last)) = (faces.first(), faces.last()) {
        cross_at(mesh, &mut strip, points[0], last, first);
    }
    strip.portals
}

/// The strip of faces along a polyline: over each edge that it crosses, and about each vertex on the side of fewer faces.
pub(crate) fn strip_along(mesh: &Mesh, points: &[SurfacePoint], faces: &[u32], strip: &mut Strip) {
    strip.restart(faces[0]);
    for (i, pair) in faces.windows(2).enumerate() {
        cross_at(mesh, strip, points[i + 1], pair[0], pair[1]);
    }
}

/// From one face of a point to another.
fn cross_at(mesh: &Mesh, strip: &mut Strip, point: SurfacePoint, from: u32, to: u32) {
    if from == to {
        return;
    }
    match point {
        SurfacePoint::Edge { halfedge, .. } => {
            let portal = if face_of(halfedge) == from {
                Some(halfedge)
            } else {
                mesh.twin(halfedge)
            };
            portal
                .into_iter()
                .for_each(|portal| strip.push(mesh, portal));
        }
        SurfacePoint::Vertex(_) => {
            let middle = |face: u32| SurfacePoint::Face {
                face,
                barycentric: [1.0 / 3.0; 3],
            };
            let (incoming, outgoing) = (
                ray_in_face(mesh, from, point, middle(from)),
                ray_in_face(mesh, to, point, middle(to)),
            );
            let count = |side| {
                let mut fan = Strip::default();
                push_fan(mesh, &mut fan, incoming, outgoing, side);
                let arrives = fan
                    .portals
                    .last()
                    .and_then(|&p| mesh.twin(p))
                    .is_some_and(|t| face_of(t) == to);
                if arrives {
                    fan.portals.len()
                } else {
                    usize::MAX
                }
            };
            let side = if count(Side::Left) <= count(Side::Right) {
                Side::Left
            } else {
                Side::Right
            };
            push_fan(mesh, strip, incoming, outgoing, side);
        }
        SurfacePoint::Face { .. } => {}
    }
}
