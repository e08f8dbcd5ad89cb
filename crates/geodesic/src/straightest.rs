//! Straightest geodesics: from a point in a direction (Polthier and Schmies), and the variant that follows given vertex
//! normals (Section 2.4 of the thesis, Fig. 2.13).

use glam::DVec3;

use crate::mesh::{Mesh, face_of, next, previous};
use crate::pivot::ray_in_face;
use crate::{Error, SurfacePoint};

/// A trace this close to a vertex, in barycentric coordinates, passes through it. Neighbouring rays of a curved vertex
/// part for good there, so it is no larger than rounding asks for.
const AT_VERTEX: f64 = 1e-10;

/// A barycentric rate below this part of the largest one does not lead out of the face.
const PARALLEL: f64 = 1e-14;

/// The part of a direction that must lie in the tangent plane.
const TANGENTIAL: f64 = 1e-12;

/// Cosine between face and interpolated normal below which the data is folded, and the classical rule is used instead.
const FOLDED: f64 = 0.1;

/// A trace ends after this many faces, a second's work, however long it was to be.
const STEP_LIMIT: usize = 10_000_000;

/// What a trace does at the boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AtBoundary {
    /// It ends.
    #[default]
    Stop,
    /// It is reflected at an edge, and ends at a vertex.
    Reflect,
}

/// Why a trace ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Stop {
    /// Its length was used up.
    Length,
    /// It came to a boundary edge.
    BoundaryEdge,
    /// It came to a boundary vertex.
    BoundaryVertex,
    /// It passed ten million faces.
    StepLimit,
}

/// A straightest geodesic.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Trace {
    /// The start, every crossing of an edge and every vertex passed, the end.
    pub points: Vec<SurfacePoint>,
    /// The same points in space.
    pub positions: Vec<DVec3>,
    /// The face of each segment.
    pub faces: Vec<u32>,
    /// Length travelled.
    pub length: f64,
    /// Why it ended.
    pub stop: Stop,
    /// Unit direction at the end, in the plane of the last face.
    pub end_direction: DVec3,
}

impl Trace {
    /// Number of edges and vertices passed between the ends.
    #[must_use]
    pub fn crossings(&self) -> usize {
        self.points.len().saturating_sub(2)
    }

    /// The place nearest to the start among those at least `after` along the trace: its arc length and its distance.
    /// `None` if the trace is not that long.
    #[must_use]
    pub fn nearest_return(&self, after: f64) -> Option<(f64, f64)> {
        let start = *self.positions.first()?;
        let mut travelled = 0.0;
        let mut best: Option<(f64, f64)> = None;
        for ends in self.positions.windows(2) {
            let step = ends[0].distance(ends[1]);
            let begin = if step > 0.0 {
                ((after - travelled) / step).max(0.0)
            } else {
                0.0
            };
            if begin <= 1.0 {
                let along = ends[1] - ends[0];
                let t = if step > 0.0 {
                    (start - ends[0]).dot(along) / (step * step)
                } else {
                    0.0
                };
                let t = t.clamp(begin, 1.0);
                let gap = (ends[0] + t * along).distance(start);
                if best.is_none_or(|(_, smallest)| gap < smallest) {
                    best = Some((travelled + t * step, gap));
                }
            }
            travelled += step;
        }
        best
    }
}

/// A way to continue straight on a mesh.
///
/// The classical rule unfolds edges and halves the angle at vertices. With vertex normals the curve instead keeps to
/// planes that contain the interpolated normal at each crossing, as the osculating planes of a smooth geodesic do: on a
/// coarse sphere with radial normals it closes great circles.
///
/// ```
/// use geodesic::{Stop, Straightest, glam::DVec3, shapes};
/// let cube = shapes::cube()?;
/// // Round the four sides of the cube and back.
/// let start = cube.face_point(4, [0.5, 0.25, 0.25])?;
/// let trace = Straightest::new(&cube).trace(start, 4, DVec3::X, 4.0)?;
/// assert_eq!(trace.stop, Stop::Length);
/// assert!(trace.positions[0].distance(*trace.positions.last().unwrap()) < 1e-14);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Straightest<'m> {
    mesh: &'m Mesh,
    normals: Option<Vec<DVec3>>,
    at_boundary: AtBoundary,
}

/// A point on the move: a face, barycentric coordinates in it, and a unit direction in its plane.
#[derive(Clone, Copy)]
struct State {
    face: u32,
    weights: [f64; 3],
    direction: DVec3,
    /// Corners whose coordinate has just become 0 and grows again: no exit there.
    entered: [bool; 3],
}

impl<'m> Straightest<'m> {
    /// The classical rule, ending at the boundary.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            normals: None,
            at_boundary: AtBoundary::default(),
        }
    }

    /// Follows these vertex normals, of any positive length: exact ones where they are known, otherwise
    /// [`Mesh::vertex_normals`].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidNormal`] if one is missing, zero or not finite at a vertex with faces.
    pub fn with_normals(mut self, normals: &[DVec3]) -> Result<Self, Error> {
        let mut unit = Vec::with_capacity(normals.len());
        for v in 0..self.mesh.vertex_count() {
            let normal = normals.get(v).and_then(|n| n.try_normalize());
            if normal.is_none() && self.mesh.outgoing(v as u32).is_some() {
                return Err(Error::InvalidNormal { vertex: v as u32 });
            }
            unit.push(normal.unwrap_or_default());
        }
        self.normals = Some(unit);
        Ok(self)
    }

    /// What to do at the boundary.
    #[must_use]
    pub fn at_boundary(mut self, policy: AtBoundary) -> Self {
        self.at_boundary = policy;
        self
    }

    /// Traces from a point of a face, in a direction of any length that is projected to the face, for the given arc
    /// length.
    ///
    /// At a vertex or on an edge, `face` says into which of the faces there the trace goes; [`Straightest::face_towards`]
    /// finds it.
    ///
    /// # Errors
    ///
    /// An error about the point, [`Error::NoSuchFace`], [`Error::SequenceMissesPoint`] if the face does not contain it,
    /// [`Error::InvalidLength`], [`Error::NonFinite`], [`Error::NoTangentialPart`], [`Error::DirectionLeavesFace`].
    pub fn trace(
        &self,
        from: SurfacePoint,
        face: u32,
        direction: DVec3,
        length: f64,
    ) -> Result<Trace, Error> {
        let mesh = self.mesh;
        if face as usize >= mesh.face_count() {
            return Err(Error::NoSuchFace {
                face,
                faces: mesh.face_count(),
            });
        }
        let from = mesh.canonical(from)?;
        let weights = mesh
            .barycentric_in(face, from)
            .ok_or(Error::SequenceMissesPoint { point: from })?;
        if !(length >= 0.0 && length.is_finite()) {
            return Err(Error::InvalidLength { length });
        }
        let mut state = self.start(face, weights, direction)?;
        let mut trace = Trace {
            points: vec![from],
            positions: vec![mesh.locate(from)],
            faces: Vec::new(),
            length: 0.0,
            stop: Stop::StepLimit,
            end_direction: state.direction,
        };
        for _ in 0..STEP_LIMIT {
            let (exit, distance) = self.way_out(&state);
            let left = length - trace.length;
            trace.faces.push(state.face);
            trace.end_direction = state.direction;
            if distance >= left {
                let end = self.advance(&state, left);
                trace.length = length;
                trace.stop = Stop::Length;
                self.finish(&mut trace, state.face, end);
                return Ok(trace);
            }
            trace.length += distance;
            let mut weights = self.advance(&state, distance);
            weights[exit] = 0.0;
            match self.cross(&state, weights, exit, &mut trace) {
                Ok(onward) => state = onward,
                Err(stop) => {
                    trace.stop = stop;
                    return Ok(trace);
                }
            }
        }
        Ok(trace)
    }

    /// The face of a point into which a direction leads: of the faces there, the one whose plane it fits best among
    /// those that it does not leave at once. `None` for an invalid point, or if it leaves them all.
    #[must_use]
    pub fn face_towards(&self, from: SurfacePoint, direction: DVec3) -> Option<u32> {
        let mesh = self.mesh;
        let from = mesh.canonical(from).ok()?;
        let tilt = |f: u32| direction.dot(mesh.face_normal(f)).abs();
        mesh.faces_of(from)
            .filter(|&f| {
                let weights = mesh.barycentric_in(f, from);
                weights.is_some_and(|weights| self.start(f, weights, direction).is_ok())
            })
            .min_by(|&f, &g| tilt(f).total_cmp(&tilt(g)))
    }

    fn start(&self, face: u32, weights: [f64; 3], direction: DVec3) -> Result<State, Error> {
        if !direction.is_finite() {
            return Err(Error::NonFinite {
                what: "the direction",
            });
        }
        let none = Error::NoTangentialPart {
            direction: direction.to_array(),
            face,
        };
        let unit = direction.try_normalize().ok_or(none.clone())?;
        let plane_normal = self.mesh.face_normal(face);
        let pushed = self
            .normal_at(face, weights)
            .and_then(|normal| push_into(unit, normal, plane_normal));
        let flat = pushed.unwrap_or(unit - unit.dot(plane_normal) * plane_normal);
        if flat.length() <= TANGENTIAL {
            return Err(none);
        }
        let direction = flat.normalize();
        let rates = self.rates(face, direction);
        let threshold = PARALLEL * rates.map(f64::abs).into_iter().fold(0.0, f64::max);
        let entered = weights.map(|l| l <= 0.0);
        if (0..3).any(|k| entered[k] && rates[k] < -threshold) {
            return Err(Error::DirectionLeavesFace { face });
        }
        Ok(State {
            face,
            weights,
            direction,
            entered,
        })
    }

    /// How fast each barycentric coordinate grows along a direction.
    fn rates(&self, face: u32, direction: DVec3) -> [f64; 3] {
        let corners = self.mesh.faces()[face as usize].map(|v| self.mesh.position(v));
        let doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let gradient = |k: usize| {
            doubled.cross(corners[(k + 2) % 3] - corners[(k + 1) % 3]) / doubled.length_squared()
        };
        [0, 1, 2].map(|k| gradient(k).dot(direction))
    }

    /// The coordinate that becomes 0 first, and how far that is.
    fn way_out(&self, state: &State) -> (usize, f64) {
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

    fn advance(&self, state: &State, distance: f64) -> [f64; 3] {
        let rates = self.rates(state.face, state.direction);
        [0, 1, 2].map(|k| (state.weights[k] + distance * rates[k]).max(0.0))
    }

    fn finish(&self, trace: &mut Trace, face: u32, weights: [f64; 3]) {
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
    fn cross(
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
    fn normal_at(&self, face: u32, weights: [f64; 3]) -> Option<DVec3> {
        let normals = self.normals.as_ref()?;
        let corners = self.mesh.faces()[face as usize];
        let sum: DVec3 = (0..3)
            .map(|k| weights[k] * normals[corners[k] as usize])
            .sum();
        sum.try_normalize()
    }
}

/// A direction moved into a plane along a normal of the surface; `None` if the two planes are nearly perpendicular.
fn push_into(direction: DVec3, normal: DVec3, plane_normal: DVec3) -> Option<DVec3> {
    let cosine = normal.dot(plane_normal);
    (cosine > FOLDED).then(|| direction - direction.dot(plane_normal) / cosine * normal)
}
