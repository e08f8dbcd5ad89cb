//! Neighbouring classes: passing a vertex on its other side where that is shorter.
//!
//! A geodesic is shortest among the paths that pass each vertex on the same side. A vertex with an angle θ below 2π
//! that lies close to the path on one side may be passed on the other: if A and B are the ends of the straight part, and
//! φ is the angle at the vertex between them on the side of the path, the other way round is shorter as soon as
//! θ - φ < φ. On meshes of smooth surfaces this leads over the barriers that the mesh has and the surface has not.

use crate::SurfacePoint;
use crate::funnel::Corner;
use crate::mesh::Mesh;
use crate::pivot::{STRICTLY, Shortener, Update, pivot_node, push_fan};
use crate::strip::Side;

/// Vertices tried for each straight part, those with the largest gain first.
const TRIED: usize = 4;

/// A vertex that might be passed on its other side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hop {
    /// How much shorter the other side is, if nothing else lies in the way.
    gain: f64,
    /// The angle there.
    angle: f64,
    corner: Corner,
}

impl Shortener {
    /// Passes one vertex on its other side, if that shortens the path. Straight parts that were looked at in vain are
    /// not looked at again.
    pub(crate) fn hop(&mut self, mesh: &Mesh) -> Option<Update> {
        for i in 0..self.nodes.len() - 1 {
            if self.nodes[i].leg.explored {
                continue;
            }
            self.nodes[i].leg.explored = true;
            if let Some(update) = self.hop_leg(mesh, i) {
                return Some(update);
            }
        }
        None
    }

    fn hop_leg(&mut self, mesh: &Mesh, i: usize) -> Option<Update> {
        let (node, after) = (self.nodes[i], self.nodes[i + 1].point);
        self.load(node.leg);
        self.strip.flatten(mesh, node.point, after);
        self.find_hops(mesh);
        let mut hops = std::mem::take(&mut self.hops);
        hops.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain));
        let taken = hops
            .iter()
            .take(TRIED)
            .find_map(|hop| self.try_hop(mesh, i, *hop));
        hops.clear();
        self.hops = hops;
        taken
    }

    /// The vertices along the strip that are nearer round the other side.
    fn find_hops(&mut self, mesh: &Mesh) {
        let Self { strip, hops, .. } = self;
        hops.clear();
        let length = strip.from.distance(strip.to);
        for k in 0..strip.portals.len() {
            for side in [Side::Left, Side::Right] {
                let (since, at) = match side {
                    Side::Left => (strip.left_since[k], strip.left[k]),
                    Side::Right => (strip.right_since[k], strip.right[k]),
                };
                if since as usize != k {
                    continue;
                }
                let portal = strip.portals[k];
                let vertex = if side == Side::Left {
                    mesh.tip(portal)
                } else {
                    mesh.origin(portal)
                };
                let total = mesh.angle(vertex);
                let (back, ahead) = (strip.from - at, strip.to - at);
                // The angle on the side of the path is below π, so that of the other side must be, too.
                if total >= std::f64::consts::TAU || mesh.is_boundary_vertex(vertex) {
                    continue;
                }
                let near = back.perp_dot(ahead).abs().atan2(back.dot(ahead));
                let angle = total - near;
                if angle < near {
                    let squared = back.length_squared() + ahead.length_squared()
                        - 2.0 * back.length() * ahead.length() * angle.cos();
                    let gain = length - squared.max(0.0).sqrt();
                    let last = strip.copy_until(k as u32, side);
                    hops.push(Hop {
                        gain,
                        angle,
                        corner: Corner {
                            side,
                            first: k as u32,
                            last,
                            at,
                        },
                    });
                }
            }
        }
    }

    fn try_hop(&mut self, mesh: &Mesh, i: usize, hop: Hop) -> Option<Update> {
        let Corner {
            side, first, last, ..
        } = hop.corner;
        let (node, after) = (self.nodes[i], self.nodes[i + 1].point);
        self.load(node.leg);
        self.strip.flatten(mesh, node.point, after);
        let pivot = pivot_node(
            mesh,
            &self.strip,
            hop.corner,
            self.strip.from,
            self.strip.to,
        );
        self.strip.restart(node.leg.first_face);
        for k in 0..first {
            self.strip.push(mesh, self.portal(node.leg, k));
        }
        push_fan(mesh, &mut self.strip, pivot.incoming, pivot.outgoing, side);
        for k in last + 1..node.leg.count {
            self.strip.push(mesh, self.portal(node.leg, k));
        }
        self.strip.trim(mesh, node.point, after);
        let accept = |new: f64| new < node.leg.length * (1.0 - STRICTLY);
        let SurfacePoint::Vertex(vertex) = pivot.point else {
            return None;
        };
        self.replace(mesh, i, i + 1, accept).then(|| Update {
            vertex,
            angle: hop.angle,
            length: self.length(),
        })
    }
}
