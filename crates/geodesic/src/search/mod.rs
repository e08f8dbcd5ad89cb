//! The initial path: A* towards the target, over vertices or over faces, with buffers that are reset in the time of
//! what was touched.

mod step;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;

use self::step::{Step, straight_across};
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::pivot::{push_fan, sweep};
use crate::strip::{Side, Strip};
use crate::{Error, SurfacePoint};

/// What is known about a vertex or a face in the search of number `round`; older entries count as absent, so that a
/// search begins in no time.
#[derive(Clone, Copy, Debug, Default)]
struct Visit {
    distance: f64,
    /// The half-edge that led here; [`NONE`] from the start.
    via: u32,
    /// `2 n` while open in search `n`, `2 n + 1` once settled.
    round: u32,
}

/// A heap entry. Keys are distances, never negative, so their bits order as the numbers do; ties go to the lower index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Entry {
    key: u64,
    index: u32,
}

/// Buffers of a search; kept between queries.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    visits: Vec<Visit>,
    round: u32,
    heap: BinaryHeap<Reverse<Entry>>,
    /// Vertices or faces settled by the last search.
    pub(crate) settled: usize,
    /// The vertices of the last path with the half-edge that led to each, from the end to the start.
    chain: Vec<(u32, u32)>,
}

impl Search {
    fn begin(&mut self, nodes: usize) {
        if self.visits.len() < nodes || self.round >= u32::MAX - 3 {
            self.visits.clear();
            self.visits.resize(nodes, Visit::default());
            self.round = 0;
        }
        self.round += 2;
        self.heap.clear();
        self.settled = 0;
    }

    #[inline]
    fn offer(&mut self, index: u32, distance: f64, via: u32, estimate: impl FnOnce() -> f64) {
        let visit = &mut self.visits[index as usize];
        if visit.round < self.round || (visit.round == self.round && distance < visit.distance) {
            *visit = Visit {
                distance,
                via,
                round: self.round,
            };
            self.heap.push(Reverse(Entry {
                key: (distance + estimate()).to_bits(),
                index,
            }));
        }
    }

    /// The next node in the order of its estimate, with its distance.
    fn settle(&mut self) -> Option<(u32, f64)> {
        while let Some(Reverse(Entry { index, .. })) = self.heap.pop() {
            let visit = &mut self.visits[index as usize];
            if visit.round == self.round {
                visit.round += 1;
                self.settled += 1;
                return Some((index, visit.distance));
            }
        }
        None
    }

    /// The shortest path over vertices, which may go along edges and, where `across`, straight over an edge to the
    /// vertex behind it; and the strip of faces that passes each of its vertices on the side of the smaller angle.
    ///
    /// The straight distance in space never exceeds what is left to go, and falls by no more than each step's length:
    /// the search settles only what might lie on a shorter path.
    pub(crate) fn over_vertices(
        &mut self,
        mesh: &Mesh,
        from: SurfacePoint,
        to: SurfacePoint,
        across: bool,
        strip: &mut Strip,
    ) -> Result<(), Error> {
        self.begin(mesh.vertex_count());
        let target = mesh.locate(to);
        let start = mesh.locate(from);
        for_corners(mesh, from, |v| {
            let position = mesh.position(v);
            self.offer(v, start.distance(position), NONE, || {
                position.distance(target)
            });
        });
        let mut best: Option<(f64, u32)> = None;
        while let Some((v, distance)) = self.settle() {
            if best.is_some_and(|(length, _)| distance >= length) {
                break;
            }
            if neighbours(mesh, v, to) {
                let length = distance + mesh.position(v).distance(target);
                if best.is_none_or(|(shortest, _)| length < shortest) {
                    best = Some((length, v));
                }
                if to == SurfacePoint::Vertex(v) {
                    break;
                }
            }
            self.expand(mesh, v, distance, target, across);
        }
        let (_, last) = best.ok_or(Error::NoPath { from, to })?;
        self.trace(mesh, last);
        self.strip_along_chain(mesh, from, to, strip);
        Ok(())
    }

    #[inline]
    fn expand(&mut self, mesh: &Mesh, v: u32, distance: f64, target: DVec3, across: bool) {
        let estimate = |w: u32| mesh.position(w).distance(target);
        for h in mesh.star(v) {
            let tip = mesh.tip(h);
            self.offer(tip, distance + mesh.length(h), h, || estimate(tip));
            let back = previous(h);
            if mesh.twin(back).is_none() {
                let origin = mesh.origin(back);
                self.offer(origin, distance + mesh.length(back), back, || {
                    estimate(origin)
                });
            }
            if across
                && let Some(twin) = mesh.twin(next(h))
                && let Some(length) = straight_across(mesh, h, twin)
            {
                let apex = mesh.apex(twin);
                self.offer(apex, distance + length, next(h), || estimate(apex));
            }
        }
    }

    /// The path to `last`, from its end to its start.
    fn trace(&mut self, mesh: &Mesh, last: u32) {
        self.chain.clear();
        let mut v = last;
        loop {
            let via = self.visits[v as usize].via;
            self.chain.push((v, via));
            if via == NONE {
                return;
            }
            v = Step::new(mesh, v, via).origin(mesh);
        }
    }

    /// The strip along the traced path.
    fn strip_along_chain(
        &self,
        mesh: &Mesh,
        from: SurfacePoint,
        to: SurfacePoint,
        strip: &mut Strip,
    ) {
        let start = self.chain.last().map_or(NONE, |&(v, _)| v);
        // A start at a vertex is the first vertex of the chain; any other start has a step to it inside a face.
        let departure = match from {
            SurfacePoint::Vertex(_) => None,
            _ => Some(Step::Inside {
                face: common_face(mesh, from, start),
                point: from,
            }),
        };
        let arrival = match to {
            SurfacePoint::Vertex(_) => None,
            _ => self.chain.first().map(|&(v, _)| Step::Inside {
                face: common_face(mesh, to, v),
                point: to,
            }),
        };
        let steps = self
            .chain
            .iter()
            .rev()
            .skip(1)
            .map(|&(v, via)| Step::new(mesh, v, via));
        let mut steps = departure.into_iter().chain(steps).chain(arrival);
        let Some(mut incoming) = steps.next() else {
            return;
        };
        let mut vertices = self
            .chain
            .iter()
            .rev()
            .map(|&(v, _)| v)
            .skip(usize::from(departure.is_none()));
        let mut side = None;
        for (outgoing, v) in steps.zip(&mut vertices) {
            let ends = |side| {
                Some((
                    incoming.arrival(mesh, v, side)?,
                    outgoing.departure(mesh, v, side)?,
                ))
            };
            let (left, right) = (ends(Side::Left), ends(Side::Right));
            let left_angle = left.and_then(|(i, o)| sweep(mesh, o, i));
            let right_angle = right.and_then(|(i, o)| sweep(mesh, i, o));
            let chosen = match (left_angle, right_angle) {
                (Some(l), Some(r)) if r < l => Side::Right,
                (None, Some(_)) => Side::Right,
                _ => Side::Left,
            };
            if let Some((i, o)) = if chosen == Side::Left { left } else { right } {
                incoming.take(mesh, side, Some(chosen), strip);
                push_fan(mesh, strip, i, o, chosen);
            }
            side = Some(chosen);
            incoming = outgoing;
        }
        incoming.take(mesh, side, side, strip);
    }

    /// The shortest path over faces, from centroid to centroid, beginning at the start point and ending with the first
    /// face of the end point.
    pub(crate) fn over_faces(
        &mut self,
        mesh: &Mesh,
        from: SurfacePoint,
        to: SurfacePoint,
        strip: &mut Strip,
    ) -> Result<(), Error> {
        self.begin(mesh.face_count());
        let (start, target) = (mesh.locate(from), mesh.locate(to));
        // Nothing is left to go in any face of the end point.
        let reach = mesh
            .faces_of(to)
            .map(|f| centroid(mesh, f).distance(target))
            .fold(0.0, f64::max);
        let estimate = |c: DVec3| (c.distance(target) - reach).max(0.0);
        for f in mesh.faces_of(from) {
            let c = centroid(mesh, f);
            self.offer(f, start.distance(c), NONE, || estimate(c));
        }
        while let Some((f, distance)) = self.settle() {
            if mesh.face_contains(f, to) {
                strip.restart(f);
                let via = |f: u32| Some(self.visits[f as usize].via).filter(|&via| via != NONE);
                strip
                    .portals
                    .extend(std::iter::successors(via(f), |&portal| {
                        via(face_of(portal))
                    }));
                strip.first_face = strip.portals.last().map_or(f, |&portal| face_of(portal));
                strip.portals.reverse();
                return Ok(());
            }
            let here = centroid(mesh, f);
            for h in 3 * f..3 * f + 3 {
                if let Some(twin) = mesh.twin(h) {
                    let c = centroid(mesh, face_of(twin));
                    self.offer(face_of(twin), distance + here.distance(c), h, || {
                        estimate(c)
                    });
                }
            }
        }
        Err(Error::NoPath { from, to })
    }
}

/// Calls `visit` for the vertices of the faces of a point; for a vertex that is itself.
fn for_corners(mesh: &Mesh, point: SurfacePoint, mut visit: impl FnMut(u32)) {
    match point {
        SurfacePoint::Vertex(v) => visit(v),
        SurfacePoint::Edge { halfedge, .. } => {
            visit(mesh.origin(halfedge));
            visit(mesh.tip(halfedge));
            visit(mesh.apex(halfedge));
            if let Some(twin) = mesh.twin(halfedge) {
                visit(mesh.apex(twin));
            }
        }
        SurfacePoint::Face { face, .. } => {
            mesh.faces()[face as usize].iter().copied().for_each(visit)
        }
    }
}

/// Whether `v` is one of the vertices that [`for_corners`] visits.
#[inline]
fn neighbours(mesh: &Mesh, v: u32, point: SurfacePoint) -> bool {
    match point {
        SurfacePoint::Vertex(w) => v == w,
        SurfacePoint::Face { face, .. } => mesh.faces()[face as usize].contains(&v),
        SurfacePoint::Edge { halfedge, .. } => {
            mesh.faces()[face_of(halfedge) as usize].contains(&v)
                || mesh.twin(halfedge).is_some_and(|twin| mesh.apex(twin) == v)
        }
    }
}

/// The first face of a point that contains vertex `v`.
fn common_face(mesh: &Mesh, point: SurfacePoint, v: u32) -> u32 {
    mesh.faces_of(point)
        .find(|&f| mesh.faces()[f as usize].contains(&v))
        .unwrap_or(0)
}

fn centroid(mesh: &Mesh, f: u32) -> DVec3 {
    let [a, b, c] = mesh.faces()[f as usize].map(|v| mesh.position(v));
    (a + b + c) / 3.0
}
