//! Vertices as sources: which of them shortest ways may pass, and where they go from there.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::face::{apex, local_coordinates};
use super::sweep::{Arrival, POINT_SOURCE, Sweep};
use super::window::Window;
use crate::mesh::{NONE, face_of, next, previous};
use crate::{FLAT_ANGLE, SurfacePoint};

/// The directions in which ways go on from a vertex are widened by this, in radians, against the rounding of their angles.
const WEDGE_SLACK: f64 = 1e-9;

/// Vertices within so many times the distance at which a source coincides with a vertex have the ways behind them
/// radiated anew: from a source 1e-6 of the diameter away, the windows on either side know their edge to 1e-10.
const NEAR: f64 = 1e8;

impl Sweep<'_> {
    /// Whether shortest ways may pass a vertex (only where the surface has more than a full turn, or more than half a turn
    /// at the boundary) or begin there, or so near that rounding could lose the directions behind it.
    pub(super) fn radiates(&self, v: u32) -> bool {
        let mesh = self.mesh;
        let straight = if mesh.is_boundary_vertex(v) {
            PI - WEDGE_SLACK
        } else {
            TAU + FLAT_ANGLE
        };
        mesh.angle(v) > straight || self.vertex_distance(v) <= NEAR * self.coincident
    }

    /// A vertex whose distance is known: along its edges, and across its faces where a shortest way may go on.
    ///
    /// A way that passes a vertex is a shortest one only if it leaves an angle of at least π on either side where there is
    /// surface: it goes on within the wedge of directions that do, seen from the direction it came from.
    pub(super) fn radiate(&mut self, v: u32) {
        let mesh = self.mesh;
        let distance = self.vertex_distance(v);
        for h in mesh.star(v) {
            self.reach(mesh.tip(h), distance + mesh.length(h), Arrival::Edge(v));
            let back = previous(h);
            if mesh.twins()[back as usize] == NONE {
                self.reach(
                    mesh.origin(back),
                    distance + mesh.length(back),
                    Arrival::Edge(v),
                );
            }
        }
        let Some((arrival, into, blur)) = self.arrival_direction(v) else {
            for h in mesh.star(v) {
                self.radiate_across(h, 0.0, TAU);
            }
            return;
        };
        let low = (PI - WEDGE_SLACK - blur).max(0.0);
        let is_boundary = mesh.is_boundary_vertex(v);
        let high = if is_boundary {
            f64::INFINITY
        } else {
            mesh.angle(v) - low
        };
        // Counter-clockwise from the direction of arrival, face by face.
        let (mut at, mut begin) = (Some(arrival), -into);
        while let Some(h) = at.filter(|_| begin < high) {
            let end = begin + mesh.corner_angle(h);
            if end > low {
                self.radiate_across(h, low - begin, high - begin);
            }
            (at, begin) = (mesh.counter_clockwise(h), end);
        }
        if !is_boundary {
            return;
        }
        let (mut at, mut begin) = (mesh.clockwise(arrival), into);
        while let Some(h) = at {
            let end = begin + mesh.corner_angle(h);
            if end > low {
                self.radiate_across(h, 0.0, end - low);
            }
            (at, begin) = (mesh.clockwise(h), end);
        }
    }

    /// The direction from which the shortest way reaches a vertex: an outgoing half-edge, the angle from it into its face, and
    /// what rounding may do to that angle. `None` at a source, and at a vertex that a source on an edge or in a face cannot be told from.
    fn arrival_direction(&self, v: u32) -> Option<(u32, f64, f64)> {
        let mesh = self.mesh;
        let angle = |from: DVec2, to: DVec2| from.perp_dot(to).atan2(from.dot(to)).max(0.0);
        match self.arrival(v) {
            Arrival::None => None,
            Arrival::Source(_) if self.vertex_distance(v) <= self.coincident => None,
            Arrival::Source(number) => {
                let source = self.sources[number as usize];
                let h = mesh
                    .star(v)
                    .find(|&h| mesh.face_contains(face_of(h), source))?;
                let to = local_coordinates(mesh, h, source);
                Some((h, angle(DVec2::X, to), self.coincident / to.length()))
            }
            Arrival::Edge(u) => mesh.star(v).find_map(|h| {
                if mesh.tip(h) == u {
                    Some((h, 0.0, 0.0))
                } else if mesh.apex(h) == u {
                    Some((h, mesh.corner_angle(h), 0.0))
                } else {
                    None
                }
            }),
            Arrival::Window {
                halfedge, source, ..
            } => {
                let top = apex(mesh, halfedge);
                let back = source - top;
                let blur = self.coincident / back.length();
                Some((previous(halfedge), angle(-top, back), blur))
            }
        }
    }

    /// Puts a window on the edge opposite to the origin of `h`, for directions at angles `from` to `to` from `h`.
    fn radiate_across(&mut self, h: u32, from: f64, to: f64) {
        let mesh = self.mesh;
        let (v, opposite) = (mesh.origin(h), next(h));
        let twin = mesh.twins()[opposite as usize];
        if twin == NONE {
            return;
        }
        let (length, top) = (mesh.length(opposite), apex(mesh, opposite));
        let corner = mesh.corner_angle(h);
        let foot = |angle: f64| {
            let direction = DVec2::from_angle(angle).rotate(-top);
            (top.x - direction.x * top.y / direction.y).clamp(0.0, length)
        };
        let low = if from > 0.0 { foot(from) } else { 0.0 };
        let high = if to < corner { foot(to) } else { length };
        if low < high {
            self.admit(
                twin,
                Window {
                    start: length - high,
                    end: length - low,
                    source: DVec2::new(length - top.x, -top.y),
                    base: self.vertex_distance(v),
                    origin: v,
                    older: NONE,
                },
            );
        }
    }

    /// A source on an edge or inside a face: straight to the corners of its faces and through their edges.
    pub(super) fn radiate_inside(&mut self, point: SurfacePoint, number: u32) {
        let mesh = self.mesh;
        for f in mesh.faces_of(point) {
            for h in 3 * f..3 * f + 3 {
                // From its weights and not from its position, which loses how far it is from an edge near by.
                let local = local_coordinates(mesh, h, point);
                self.reach(mesh.origin(h), local.length(), Arrival::Source(number));
                // An edge that the source lies on is not crossed but shared: its other face is one of the source's faces.
                let on_edge = matches!(point, SurfacePoint::Edge { halfedge, .. }
                    if halfedge == h || mesh.twins()[halfedge as usize] == h);
                let twin = mesh.twins()[h as usize];
                if on_edge || twin == NONE {
                    continue;
                }
                let length = mesh.length(h);
                self.admit(
                    twin,
                    Window {
                        start: 0.0,
                        end: length,
                        source: DVec2::new(length - local.x, -local.y),
                        base: 0.0,
                        origin: POINT_SOURCE | number,
                        older: NONE,
                    },
                );
            }
        }
    }
}
