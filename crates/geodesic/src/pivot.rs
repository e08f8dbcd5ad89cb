//! Pivot updates: shortening a path, one vertex at a time, until only critical vertices remain
//! (Section 2.1 of the thesis, Figs. 2.4 and 2.5).

use std::f64::consts::PI;

use glam::DVec2;

use crate::SurfacePoint;
use crate::funnel::{Corner, Funnel, TOUCH_ANGLE};
use crate::hop::Hop;
use crate::mesh::{Mesh, angle_between, face_of, next, previous};
use crate::strip::{Side, Strip};

/// A side angle below π by more than this makes a path improvable at the vertex, in radians.
pub(crate) const SIDE_ANGLE: f64 = TOUCH_ANGLE;

/// An update should shorten the path by more than this, relatively: where lengths decrease strictly no sequence of faces
/// comes again, and the process ends whatever rounding does.
pub(crate) const STRICTLY: f64 = 1e-14;

/// A bend of 1e-7 at a vertex lengthens a path by 1e-14 of itself, which rounding hides, while the angle says clearly
/// that the path should pass on the other side. So many updates that change the length by rounding only are made at one
/// vertex, ...
const SIDEWAYS_AT_VERTEX: usize = 2;

/// ... and so many in one query: a path through needles of 1e-6 needs a few of them.
const SIDEWAYS: usize = 1000;

/// A direction at a vertex: the outgoing half-edge of the face in which it lies, and the angle from that half-edge.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Ray {
    pub(crate) halfedge: u32,
    pub(crate) angle: f64,
}

/// The straight part of a path between two nodes: a slice of the portal store.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Leg {
    start: u32,
    pub(crate) count: u32,
    /// Whether its neighbouring classes were looked at.
    pub(crate) explored: bool,
    /// The face in which it begins.
    pub(crate) first_face: u32,
    pub(crate) length: f64,
}

/// An end of the path, or a vertex that it passes; and the leg to the next node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    pub(crate) point: SurfacePoint,
    pub(crate) incoming: Ray,
    pub(crate) outgoing: Ray,
    /// Angles on either side of the path, `None` where the boundary lies in between or at the ends of the path.
    pub(crate) left: Option<f64>,
    pub(crate) right: Option<f64>,
    pub(crate) leg: Leg,
    /// No update here improves the path until a neighbour changes.
    settled: bool,
}

impl Node {
    fn new(point: SurfacePoint) -> Self {
        Self {
            point,
            incoming: Ray::default(),
            outgoing: Ray::default(),
            left: None,
            right: None,
            leg: Leg::default(),
            settled: false,
        }
    }

    /// The smaller side angle, and its side.
    fn smaller_side(&self) -> Option<(f64, Side)> {
        match (self.left, self.right) {
            (Some(left), Some(right)) if right < left => Some((right, Side::Right)),
            (Some(left), _) => Some((left, Side::Left)),
            (None, Some(right)) => Some((right, Side::Right)),
            (None, None) => None,
        }
    }
}

/// What one update did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Update {
    /// The pivot vertex about which the sequence of faces was turned over.
    pub vertex: u32,
    /// Its side angle before the update, in radians: below π.
    pub angle: f64,
    /// Length of the path after the update.
    pub length: f64,
}

/// A path as nodes and legs, and the scratch to shorten it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shortener {
    pub(crate) nodes: Vec<Node>,
    /// Portals of all legs, present and past.
    store: Vec<u32>,
    pub(crate) strip: Strip,
    funnel: Funnel,
    /// The nodes of the last taut path, without its end, and the direction in which it arrives there.
    fresh: Vec<Node>,
    arrival: Ray,
    pub(crate) updates: usize,
    /// The vertices of the updates that changed the length by rounding only.
    sideways: Vec<u32>,
    pub(crate) hops: Vec<Hop>,
}

impl Shortener {
    /// The taut path in the strip that was put into `self.strip`.
    pub(crate) fn begin(&mut self, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
        self.store.clear();
        self.updates = 0;
        self.sideways.clear();
        self.solve_strip(mesh, from, to);
        self.nodes.clear();
        self.nodes.append(&mut self.fresh);
        self.nodes.push(Node {
            incoming: self.arrival,
            ..Node::new(to)
        });
        for i in 1..self.nodes.len() - 1 {
            self.measure_sides(mesh, i);
        }
    }

    /// Length of the path.
    pub(crate) fn length(&self) -> f64 {
        self.nodes.iter().map(|node| node.leg.length).sum()
    }

    /// Portals of a leg.
    pub(crate) fn portals(&self, leg: Leg) -> &[u32] {
        &self.store[leg.start as usize..(leg.start + leg.count) as usize]
    }

    /// Updates at the sharpest vertex, over and over, until every side angle is at least π or `limit` updates that shorten
    /// the path were made. Returns whether it got there.
    pub(crate) fn shorten(
        &mut self,
        mesh: &Mesh,
        limit: usize,
        mut observe: impl FnMut(&Self, Update),
    ) -> bool {
        while let Some((i, angle, side)) = self.sharpest() {
            // Those that do not are few on their own account, and may be more than a small mesh has faces.
            if self.updates >= limit + self.sideways.len() {
                return false;
            }
            let SurfacePoint::Vertex(vertex) = self.nodes[i].point else {
                return false;
            };
            if self.update(mesh, i, vertex, side) {
                self.updates += 1;
                observe(
                    self,
                    Update {
                        vertex,
                        angle,
                        length: self.length(),
                    },
                );
            }
        }
        true
    }

    /// The node with the smallest side angle below π.
    fn sharpest(&self) -> Option<(usize, f64, Side)> {
        let mut best: Option<(usize, f64, Side)> = None;
        for (i, node) in self.nodes.iter().enumerate() {
            if let Some((angle, side)) = node.smaller_side()
                && angle < best.map_or(PI - SIDE_ANGLE, |b| b.1)
                && !node.settled
            {
                best = Some((i, angle, side));
            }
        }
        best
    }

    /// Replaces the faces about node `i`, a vertex, by those on the given side and makes the path taut again between its
    /// neighbours. Returns whether that was kept.
    fn update(&mut self, mesh: &Mesh, i: usize, vertex: u32, side: Side) -> bool {
        let (before, node, after) = (self.nodes[i - 1], self.nodes[i], self.nodes[i + 1].point);
        self.load(before.leg);
        push_fan(mesh, &mut self.strip, node.incoming, node.outgoing, side);
        for k in 0..node.leg.count {
            self.strip.push(mesh, self.portal(node.leg, k));
        }
        self.strip.trim(mesh, before.point, after);
        let old = before.leg.length + node.leg.length;
        let may_go_sideways = self.sideways.len() < SIDEWAYS
            && self.sideways.iter().filter(|&&v| v == vertex).count() < SIDEWAYS_AT_VERTEX;
        let mut shortens = false;
        let accept = |new: f64| {
            shortens = new < old * (1.0 - STRICTLY);
            shortens || (may_go_sideways && new <= old * (1.0 + STRICTLY))
        };
        let kept = self.replace(mesh, i - 1, i + 1, accept);
        if !kept {
            self.nodes[i].settled = true;
        } else if !shortens {
            self.sideways.push(vertex);
        }
        kept
    }

    /// Puts a leg into the strip.
    pub(crate) fn load(&mut self, leg: Leg) {
        let portals = leg.start as usize..(leg.start + leg.count) as usize;
        self.strip.restart(leg.first_face);
        self.strip.portals.extend_from_slice(&self.store[portals]);
    }

    /// Portal `k` of a leg.
    pub(crate) fn portal(&self, leg: Leg, k: u32) -> u32 {
        self.store[(leg.start + k) as usize]
    }

    /// Replaces what lies between nodes `i` and `j` by the taut path in the strip, if its length is accepted.
    pub(crate) fn replace(
        &mut self,
        mesh: &Mesh,
        i: usize,
        j: usize,
        accept: impl FnOnce(f64) -> bool,
    ) -> bool {
        let stored = self.store.len();
        self.solve_strip(mesh, self.nodes[i].point, self.nodes[j].point);
        if !accept(self.fresh.iter().map(|node| node.leg.length).sum()) {
            self.store.truncate(stored);
            return false;
        }
        let added = self.fresh.len() - 1;
        self.nodes[i].outgoing = self.fresh[0].outgoing;
        self.nodes[i].leg = self.fresh[0].leg;
        self.nodes[j].incoming = self.arrival;
        self.nodes.splice(i + 1..j, self.fresh.drain(1..));
        for changed in i..=i + added + 1 {
            if changed > 0 && changed + 1 < self.nodes.len() {
                self.measure_sides(mesh, changed);
            }
        }
        true
    }

    /// The taut path in `self.strip`, into `self.fresh` and `self.arrival`; its portals go into the store.
    fn solve_strip(&mut self, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
        let Self {
            strip,
            funnel,
            fresh,
            store,
            ..
        } = self;
        fresh.clear();
        let mut departure = Node::new(from);
        let (Some(&first), Some(&last)) = (strip.portals.first(), strip.portals.last()) else {
            let face = strip.first_face;
            departure.outgoing = ray_in_face(mesh, face, from, to);
            departure.leg.first_face = face;
            departure.leg.length = mesh.locate(from).distance(mesh.locate(to));
            fresh.push(departure);
            self.arrival = ray_in_face(mesh, face, to, from);
            return;
        };
        strip.flatten(mesh, from, to);
        funnel.solve(strip);
        let corners = &funnel.corners;
        let count = strip.portals.len();
        let last_face = mesh.twin(last).map_or(face_of(last), face_of);
        for i in 0..=corners.len() {
            let (at, begin) = match i.checked_sub(1) {
                Some(previous) => (corners[previous].at, corners[previous].last as usize + 1),
                None => (strip.from, 0),
            };
            let (onward, end) = corners
                .get(i)
                .map_or((strip.to, count), |c| (c.at, c.first as usize));
            let mut node = match i.checked_sub(1).map(|j| corners[j]) {
                None => {
                    departure.outgoing = Ray {
                        halfedge: previous(first),
                        angle: angle_2d(onward - at, strip.right[0] - at),
                    };
                    departure
                }
                Some(corner) => {
                    let behind = if i >= 2 {
                        corners[i - 2].at
                    } else {
                        strip.from
                    };
                    pivot_node(mesh, strip, corner, behind, onward)
                }
            };
            // Where the path runs along a portal, the parts on either side of it overlap: the leg crosses nothing.
            let entry = begin.min(end);
            node.leg = Leg {
                start: store.len() as u32,
                count: end.saturating_sub(begin) as u32,
                first_face: strip
                    .portals
                    .get(entry)
                    .map_or(last_face, |&portal| face_of(portal)),
                length: at.distance(onward),
                explored: begin >= end,
            };
            if begin < end {
                store.extend_from_slice(&strip.portals[begin..end]);
            }
            fresh.push(node);
        }
        let behind = corners.last().map_or(strip.from, |c| c.at);
        self.arrival = Ray {
            halfedge: mesh.twin(last).map_or(last, previous),
            angle: angle_2d(behind - strip.to, strip.left[count - 1] - strip.to),
        };
    }

    fn measure_sides(&mut self, mesh: &Mesh, i: usize) {
        let node = &mut self.nodes[i];
        let SurfacePoint::Vertex(v) = node.point else {
            return;
        };
        (node.left, node.right) = side_angles(mesh, v, node.incoming, node.outgoing);
        node.settled = false;
    }
}

/// The node at a corner of a taut path that comes from `behind` and goes on to `ahead`.
pub(crate) fn pivot_node(
    mesh: &Mesh,
    strip: &Strip,
    corner: Corner,
    behind: DVec2,
    ahead: DVec2,
) -> Node {
    let Corner {
        side,
        first,
        last,
        at,
    } = corner;
    let entry = strip.portals[first as usize];
    let other = |k: u32| match side {
        Side::Left => strip.right[k as usize] - at,
        Side::Right => strip.left[k as usize] - at,
    };
    let incoming_turn = angle_2d(behind - at, other(first));
    let outgoing_turn = angle_2d(ahead - at, other(last));
    // A portal whose origin is the vertex begins the corner in front of it; one whose tip is the vertex ends it.
    let exit = mesh.twin(strip.portals[last as usize]).unwrap_or(entry);
    let (vertex, incoming, outgoing) = match side {
        Side::Right => (
            mesh.origin(entry),
            from_start(entry, incoming_turn),
            from_end(mesh, next(exit), outgoing_turn),
        ),
        Side::Left => (
            mesh.tip(entry),
            from_end(mesh, next(entry), incoming_turn),
            from_start(exit, outgoing_turn),
        ),
    };
    Node {
        incoming,
        outgoing,
        ..Node::new(SurfacePoint::Vertex(vertex))
    }
}

fn from_start(halfedge: u32, angle: f64) -> Ray {
    Ray { halfedge, angle }
}

fn from_end(mesh: &Mesh, halfedge: u32, turn: f64) -> Ray {
    Ray {
        halfedge,
        angle: (mesh.corner_angle(halfedge) - turn).max(0.0),
    }
}

/// The direction at `at`, if it is a vertex, to another point of the same face.
pub(crate) fn ray_in_face(mesh: &Mesh, face: u32, at: SurfacePoint, to: SurfacePoint) -> Ray {
    let SurfacePoint::Vertex(v) = at else {
        return Ray::default();
    };
    let halfedge = (3 * face..3 * face + 3)
        .find(|&h| mesh.origin(h) == v)
        .unwrap_or(3 * face);
    let corner = mesh.position(v);
    let angle = angle_between(
        mesh.position(mesh.tip(halfedge)) - corner,
        mesh.locate(to) - corner,
    );
    Ray { halfedge, angle }
}

/// Angles to the left and to the right of a path through vertex `v`; `None` where the boundary lies in between.
pub(crate) fn side_angles(
    mesh: &Mesh,
    v: u32,
    incoming: Ray,
    outgoing: Ray,
) -> (Option<f64>, Option<f64>) {
    let left = sweep(mesh, outgoing, incoming);
    let right = if mesh.is_boundary_vertex(v) {
        sweep(mesh, incoming, outgoing)
    } else {
        left.map(|left| mesh.angle(v) - left)
    };
    (left, right)
}

/// Angle counter-clockwise from one direction to another at the same vertex; `None` if the boundary lies in between.
pub(crate) fn sweep(mesh: &Mesh, from: Ray, to: Ray) -> Option<f64> {
    if from.halfedge == to.halfedge && to.angle >= from.angle {
        return Some(to.angle - from.angle);
    }
    let mut total = mesh.corner_angle(from.halfedge) - from.angle;
    let mut h = mesh.counter_clockwise(from.halfedge)?;
    while h != to.halfedge {
        // Both lie in one star; were they not, this ends the walk.
        if h == from.halfedge {
            return None;
        }
        total += mesh.corner_angle(h);
        h = mesh.counter_clockwise(h)?;
    }
    Some(total + to.angle)
}

/// Walks about a vertex from the face in which a path comes in to the one in which it goes out, on the given side.
pub(crate) fn push_fan(mesh: &Mesh, strip: &mut Strip, incoming: Ray, outgoing: Ray, side: Side) {
    let (start, end) = (incoming.halfedge, outgoing.halfedge);
    let same_corner = match side {
        Side::Left => incoming.angle >= outgoing.angle,
        Side::Right => outgoing.angle >= incoming.angle,
    };
    if start == end && same_corner {
        return;
    }
    let mut h = start;
    loop {
        // On the left of the path the walk is clockwise about the vertex, on its right counter-clockwise.
        let (portal, onward) = match side {
            Side::Left => (h, mesh.clockwise(h)),
            Side::Right => (previous(h), mesh.counter_clockwise(h)),
        };
        let Some(onward) = onward else { return };
        strip.push(mesh, portal);
        h = onward;
        if h == end || h == start {
            return;
        }
    }
}

/// Angle between two plane vectors, in `[0, π]`.
fn angle_2d(a: DVec2, b: DVec2) -> f64 {
    a.perp_dot(b).abs().atan2(a.dot(b))
}
