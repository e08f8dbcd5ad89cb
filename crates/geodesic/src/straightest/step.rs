//! One step of a straightest geodesic: through a face, and over an edge or a vertex into the next one.

use glam::DVec3;

use super::tracer::Straightest;
use super::{AtBoundary, Stop, Trace};
use crate::SurfacePoint;
use crate::mesh::{face_of, next, previous};
use crate::pivot::ray_in_face;

/// A trace this close to a vertex, in barycentric coordinates, passes through it. Neighbouring rays of a curved vertex
/// part for good there, so it is no larger than rounding asks for.
const AT_VERTEX: f64 = 1e-10;

/// A barycentric rate below this part of the largest one does not lead out of the face.
pub(super) const PARALLEL: f64 = 1e-14;

/// Cosine between face and interpolated normal below which the data is folded, and the classical rule is used instead.
const FOLDED: f64 = 0.1;

/// A point on the move: a face, barycentric coordinates in it, and a unit direction in its plane.
#[derive(Clone, Copy)]
pub(super) struct State {
    pub(super) face: u32,
    pub(super) weights: [f64; 3],
    pub(super) direction: DVec3,
    /// Corners whose coordinate has just become 0 and grows again: no exit there.
    pub(super) entered: [bool; 3],
}

impl Straightest<'_> {
    /// How fast each barycentric coordinate grows along a direction.
    pub(super) fn rates(&self, face: u32, direction: DVec3) -> [f64; 3] {
        let corners = self.mesh.faces()[face as usize].map(|v| self.mesh.position(v));
        let doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let gradient = |k: usize| {
            doubled.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3]) / doubled.length_squared()
        };
        [0, 1, 2].map(|k| gradient(k).dot(direction))
    }

    /// The coordinate that becomes 0 first, and how far that is.
    pub(super) fn way_out(&self, state: &State) -> (usize, f64) {
        let rates = self.rates(state.face, state.direction);
        let threshold = PARALLEL * rates.map(f64::abs).into_iter().fold(0.0, f64::max);
        let mut best = (0, f64::INFINITY);
        for (k, &rate) in rates.iter().enumerate() {
            if rate < -threshold && !state.entered[k] {
                let distance = (-state.weights[k] / rate).max(0.0);
                if distance < best.1 {
                    best = (k, distance);
                }
            }
        }
        best
    }

    pub(super) fn advance(&self, state: &State, distance: f64) -> [f64; 3] {
        let rates = self.rates(state.face, state.direction);
        [0, 1, 2].map(|k| (state.weights[k] + distance * rates[k]).max(0.0))
    }

    pub(super) fn finish(&self, trace: &mut Trace, face: u32, weights: [f64; 3]) {
        // The weights were clamped to the face, so this point exists.
        let sum: f64 = weights.iter().sum();
        let point = SurfacePoint::Face {
            face,
            barycentric: weights.map(|l| l / sum),
        };
        let point = self.mesh.canonical(point).unwrap_or(point);
        trace.positions.push(self.mesh.locate(point));
        trace.points.push(point);
    }

    /// Goes on over the edge opposite to corner `exit`, or through the vertex there.
    pub(super) fn cross(
        &self,
        state: &State,
        weights: [f64; 3],
        exit: usize,
        trace: &mut Trace,
    ) -> Result<State, Stop> {
        let mesh = self.mesh;
        let halfedge = next(3 * state.face + exit as u32);
        let (origin, tip) = ((exit + 1) % 3, (exit + 2) % 3);
        let t = weights[tip] / (weights[origin] + weights[tip]);
        for (corner, near) in [(halfedge, t), (next(halfedge), 1.0 - t)] {
            if near < AT_VERTEX {
                let v = mesh.origin(corner);
                trace.points.push(SurfacePoint::Vertex(v));
                trace.positions.push(mesh.position(v));
                return self.through_vertex(state, corner);
            }
        }
        let point = SurfacePoint::Edge { halfedge, t };
        trace.points.push(point);
        trace.positions.push(mesh.locate(point));
        match mesh.twin(halfedge) {
            Some(twin) => Ok(self.over_edge(state, halfedge, twin, t)),
            None if self.at_boundary == AtBoundary::Stop => Err(Stop::BoundaryEdge),
            None => {
                let edge = (mesh.position(mesh.tip(halfedge))
                    - mesh.position(mesh.origin(halfedge)))
                .normalize();
                let along = state.direction.dot(edge) * edge;
                let mut entered = [false; 3];
                entered[exit] = true;
                Ok(State {
                    weights,
                    direction: 2.0 * along - state.direction,
                    entered,
                    ..*state
                })
            }
        }
    }

    fn over_edge(&self, state: &State, halfedge: u32, twin: u32, t: f64) -> State {
        let mesh = self.mesh;
        let face = face_of(twin);
        let mut weights = [0.0; 3];
        weights[(twin % 3) as usize] = t;
        weights[(next(twin) % 3) as usize] = 1.0 - t;
        let opposite = (previous(twin) % 3) as usize;
        let mut entered = [false; 3];
        entered[opposite] = true;
        let plane_normal = mesh.face_normal(face);
        let edge =
            (mesh.position(mesh.tip(halfedge)) - mesh.position(mesh.origin(halfedge))).normalize();
        let unfolded = || {
            let (n, m) = (mesh.face_normal(state.face), plane_normal);
            state.direction.dot(edge) * edge + state.direction.dot(n.cross(edge)) * m.cross(edge)
        };
        let direction = self
            .normal_at(face, weights)
            .and_then(|normal| push_into(state.direction, normal, plane_normal))
            // A direction that does not lead into the face says that the data is folded here.
            .filter(|d| self.rates(face, *d)[opposite] > 0.0)
            .unwrap_or_else(unfolded)
            .normalize();
        State {
            face,
            weights,
            direction,
            entered,
        }
    }

    /// Goes on from the vertex at the origin of `corner`, a half-edge of the current face.
    fn through_vertex(&self, state: &State, corner: u32) -> Result<State, Stop> {
        let mesh = self.mesh;
        let v = mesh.origin(corner);
        if mesh.is_boundary_vertex(v) {
            return Err(Stop::BoundaryVertex);
        }
        let arrive = |h: u32, direction: DVec3| {
            let mut weights = [0.0; 3];
            weights[(h % 3) as usize] = 1.0;
            State {
                face: face_of(h),
                weights,
                direction,
                entered: weights.map(|l| l == 0.0),
            }
        };
        if let Some(normals) = &self.normals {
            let pushed = mesh.star(v).filter_map(|h| {
                let d = push_into(
                    state.direction,
                    normals[v as usize],
                    mesh.face_normal(face_of(h)),
                )?
                .normalize();
                let rates = self.rates(face_of(h), d);
                let inside = rates[(next(h) % 3) as usize].min(rates[(previous(h) % 3) as usize]);
                (d.dot(state.direction) > 0.0).then_some((inside, h, d))
            });
            let best = pushed.max_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((_, h, d)) = best.filter(|b| b.0 > -PARALLEL) {
                return Ok(arrive(h, d));
            }
        }
        // Half of the total angle counter-clockwise from where the trace came from.
        let behind = SurfacePoint::Face {
            face: state.face,
            barycentric: state.weights,
        };
        let back = ray_in_face(mesh, state.face, SurfacePoint::Vertex(v), behind);
        let (mut h, mut angle) = (back.halfedge, back.angle + mesh.angle(v) / 2.0);
        for _ in 0..=mesh.star(v).count() {
            let width = mesh.corner_angle(h);
            if angle <= width {
                break;
            }
            angle -= width;
            h = mesh.counter_clockwise(h).ok_or(Stop::BoundaryVertex)?;
        }
        let along = (mesh.position(mesh.tip(h)) - mesh.position(v)).normalize();
        let across = mesh.face_normal(face_of(h)).cross(along);
        Ok(arrive(h, angle.cos() * along + angle.sin() * across))
    }

    /// The interpolated normal, if normals were given.
    pub(super) fn normal_at(&self, face: u32, weights: [f64; 3]) -> Option<DVec3> {
        let normals = self.normals.as_ref()?;
        let corners = self.mesh.faces()[face as usize];
        let sum: DVec3 = (0..3)
            .map(|k| weights[k] * normals[corners[k] as usize])
            .sum();
        sum.try_normalize()
    }
}

/// A direction moved into a plane along a normal of the surface; `None` if the two planes are nearly perpendicular.
pub(super) fn push_into(direction: DVec3, normal: DVec3, plane_normal: DVec3) -> Option<DVec3> {
    let cosine = normal.dot(plane_normal);
    (cosine > FOLDED).then(|| direction - direction.dot(plane_normal) / cosine * normal)
}
