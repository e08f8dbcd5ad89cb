//! Where a loop begins is arbitrary: rolling it on to begin at another vertex or edge.

use super::cycle::reduce;
use super::tighten::LoopFinder;
use crate::SurfacePoint;
use crate::mesh::{Mesh, face_of};
use crate::path::GeodesicPath;
use crate::pivot::{Shortener, push_fan, side_angles};
use crate::strip::{Side, Strip};

impl LoopFinder<'_> {
    /// Rolls the loop on so that it begins at node `k`: the strip from there round to there.
    pub(super) fn rebase_at_node(&mut self, base: SurfacePoint, k: usize) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let shortener = &mut self.shortener;
        let count = shortener.nodes.len() - 1;
        let mut strip = std::mem::take(&mut shortener.strip);
        strip.restart(shortener.nodes[k].leg.first_face);
        for step in 0..count {
            let i = (k + step) % count;
            let node = shortener.nodes[i];
            if step > 0 {
                join_at(mesh, &mut strip, shortener, i, base);
            }
            for &portal in shortener.portals(node.leg) {
                strip.push(mesh, portal);
            }
        }
        let point = shortener.nodes[k].point;
        shortener.strip = strip;
        Some(point)
    }

    /// Rolls a loop of one leg on so that it begins where it crosses the middle one of its edges.
    pub(super) fn rebase_at_crossing(&mut self, base: SurfacePoint) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let mut path = GeodesicPath::default();
        path.set(mesh, &self.shortener, &mut self.strip);
        let shortener = &mut self.shortener;
        let portals = shortener.portals(shortener.nodes[0].leg).to_vec();
        let middle = portals.len() / 2;
        let point = *path
            .points
            .get(middle + 1)
            .filter(|_| !portals.is_empty())?;
        let mut strip = std::mem::take(&mut shortener.strip);
        strip.restart(face_of(mesh.twin(portals[middle])?));
        for &portal in &portals[middle + 1..] {
            strip.push(mesh, portal);
        }
        join_at(mesh, &mut strip, shortener, 0, base);
        for &portal in &portals[..middle] {
            strip.push(mesh, portal);
        }
        shortener.strip = strip;
        Some(point)
    }

    /// Goes on from the vertex that a straight loop with a corner must catch on.
    ///
    /// Going once round turns the unfolded strip about a centre. All vertices of the side of the centre lie nearer to it
    /// than the loop does; the loop shrinks until it meets the farthest of them. Around a centre at infinity the loop
    /// would be straight.
    pub(super) fn rebase_inside(&mut self, base: SurfacePoint) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let shortener = &mut self.shortener;
        let node = *shortener.nodes.first()?;
        let mut cycle = shortener.portals(node.leg).to_vec();
        // The edge of the base is crossed between the end and the beginning, unless the loop only touches it.
        if let SurfacePoint::Edge { halfedge, .. } = base {
            let last_face = cycle.last().and_then(|&p| mesh.twin(p)).map(face_of)?;
            if last_face != node.leg.first_face {
                let crossing = if face_of(halfedge) == last_face {
                    halfedge
                } else {
                    mesh.twin(halfedge)?
                };
                cycle.insert(0, crossing);
            }
        }
        reduce(mesh, &mut cycle);
        let &first = cycle.first()?;
        // One period and the first portal again, which shows where going round takes it.
        shortener.strip.restart(face_of(first));
        shortener.strip.portals.extend_from_slice(&cycle);
        shortener.strip.portals.push(first);
        shortener
            .strip
            .flatten(mesh, SurfacePoint::Vertex(mesh.apex(first)), base);
        let strip = &shortener.strip;
        let n = cycle.len();
        let (before, after) = (
            strip.left[0] - strip.right[0],
            strip.left[n] - strip.right[n],
        );
        let turn = before.perp_dot(after).atan2(before.dot(after));
        let side = if turn > 0.0 { Side::Left } else { Side::Right };
        // The fixed point of x -> right[n] + R (x - right[0]).
        let shift = strip.right[n] - strip.right[0];
        let half = shift.perp() / (2.0 * (turn / 2.0).tan());
        let centre = strip.right[0] + shift / 2.0 + half;
        let distance = |k: usize| strip.end(k as u32, side).distance_squared(centre);
        let k = (0..n).max_by(|&i, &j| distance(i).total_cmp(&distance(j)))?;
        let end = |portal: u32| {
            if side == Side::Left {
                mesh.tip(portal)
            } else {
                mesh.origin(portal)
            }
        };
        let vertex = end(cycle[k]);
        // On round from the last portal that ends there to the first.
        cycle.rotate_left(k);
        let fan = cycle.iter().take_while(|&&p| end(p) == vertex).count();
        if fan == n {
            return None;
        }
        let lead = cycle
            .iter()
            .rev()
            .take_while(|&&p| end(p) == vertex)
            .count();
        let strip = &mut shortener.strip;
        strip.restart(mesh.twin(cycle[fan - 1]).map(face_of)?);
        strip.portals.extend_from_slice(&cycle[fan..n - lead]);
        Some(SurfacePoint::Vertex(vertex))
    }

    /// The strip from portal `k` of a cycle round to it again.
    pub(super) fn enter_at_portal(&mut self, cycle: &[u32], k: usize) {
        let mesh = self.finder.mesh();
        let strip = &mut self.shortener.strip;
        strip.restart(mesh.twin(cycle[k]).map_or(0, face_of));
        strip.portals.extend_from_slice(&cycle[k + 1..]);
        strip.portals.extend_from_slice(&cycle[..k]);
    }
}

/// Connects the leg that arrives at node `i` of a loop with the one that leaves it.
fn join_at(mesh: &Mesh, strip: &mut Strip, shortener: &Shortener, i: usize, base: SurfacePoint) {
    let node = shortener.nodes[i];
    let incoming = if i == 0 {
        shortener.nodes[shortener.nodes.len() - 1].incoming
    } else {
        node.incoming
    };
    match node.point {
        SurfacePoint::Vertex(v) => {
            let (left, right) = side_angles(mesh, v, incoming, node.outgoing);
            let side = match (left, right) {
                (Some(l), Some(r)) if r < l => Side::Right,
                (None, Some(_)) => Side::Right,
                _ => Side::Left,
            };
            push_fan(mesh, strip, incoming, node.outgoing, side);
        }
        SurfacePoint::Edge { halfedge, .. } => {
            let last_face = strip.faces(mesh).last();
            debug_assert_eq!(base, node.point);
            if last_face != Some(node.leg.first_face) {
                let crossing = if last_face == Some(face_of(halfedge)) {
                    Some(halfedge)
                } else {
                    mesh.twin(halfedge)
                };
                crossing
                    .into_iter()
                    .for_each(|portal| strip.push(mesh, portal));
            }
        }
        SurfacePoint::Face { .. } => {}
    }
}
