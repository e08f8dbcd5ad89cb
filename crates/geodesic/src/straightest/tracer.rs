//! Following a straightest geodesic from face to face.

use glam::DVec3;

use super::step::{PARALLEL, State, push_into};
use super::{AtBoundary, Stop, Trace};
use crate::mesh::{Mesh, face_of};
use crate::{Error, SurfacePoint};

/// The part of a direction that must lie in the tangent plane.
const TANGENTIAL: f64 = 1e-12;

/// A trace ends after this many faces, a second's work, however long it was to be.
const STEP_LIMIT: usize = 10_000_000;

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
    pub(super) mesh: &'m Mesh,
    pub(super) normals: Option<Vec<DVec3>>,
    pub(super) at_boundary: AtBoundary,
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
        let mut state = match self.start(face, weights, direction) {
            // The direction may point into the gap between the planes of two faces.
            Err(Error::DirectionLeavesFace { face }) => self
                .start_on_ridge(from, direction)
                .filter(|state| state.face == face)
                .ok_or(Error::DirectionLeavesFace { face })?,
            state => state?,
        };
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
    /// those that it does not leave at once. At a convex vertex a direction of the tangent plane may leave them all, for it
    /// points into the gap between the planes of two faces: then one of these two, along whose common edge a trace sets out.
    /// `None` for an invalid point or direction, or if it leads off the surface.
    #[must_use]
    pub fn face_towards(&self, from: SurfacePoint, direction: DVec3) -> Option<u32> {
        self.find_face_towards(from, direction).ok()
    }

    /// As [`Straightest::face_towards`], with the reason why there is none.
    pub(crate) fn find_face_towards(
        &self,
        from: SurfacePoint,
        direction: DVec3,
    ) -> Result<u32, Error> {
        let mesh = self.mesh;
        let from = mesh.canonical(from)?;
        if !direction.is_finite() {
            return Err(Error::NonFinite {
                what: "the direction",
            });
        }
        if direction.try_normalize().is_none() {
            return Err(Error::NoTangentialPart {
                direction: direction.to_array(),
                face: mesh.faces_of(from).next().unwrap_or_default(),
            });
        }
        let tilt = |f: u32| direction.dot(mesh.face_normal(f)).abs();
        let best = mesh
            .faces_of(from)
            .filter(|&f| {
                let weights = mesh.barycentric_in(f, from);
                weights.is_some_and(|weights| self.start(f, weights, direction).is_ok())
            })
            .min_by(|&f, &g| tilt(f).total_cmp(&tilt(g)));
        let on_ridge = || Some(self.start_on_ridge(from, direction)?.face);
        best.or_else(on_ridge).ok_or(Error::DirectionLeavesSurface {
            direction: direction.to_array(),
            point: from,
        })
    }

    /// The start along the edge, between two faces at a vertex, into the gap between whose planes a direction points; of
    /// several such edges the nearest one.
    fn start_on_ridge(&self, from: SurfacePoint, direction: DVec3) -> Option<State> {
        let mesh = self.mesh;
        let SurfacePoint::Vertex(v) = from else {
            return None;
        };
        let unit = direction.try_normalize()?;
        let ridges = mesh.star(v).filter_map(|h| {
            let other = face_of(mesh.twin(h)?);
            let along = (mesh.position(mesh.tip(h)) - mesh.position(v)).normalize();
            // Into either face, perpendicular to the edge.
            let left = mesh.face_normal(face_of(h)).cross(along);
            let right = along.cross(mesh.face_normal(other));
            let ahead = unit.dot(along);
            let is_gap = ahead > 0.0 && unit.dot(left) <= 0.0 && unit.dot(right) <= 0.0;
            is_gap.then_some((ahead, h, along))
        });
        let (_, h, along) = ridges.max_by(|a, b| a.0.total_cmp(&b.0))?;
        let weights = mesh.barycentric_in(face_of(h), from)?;
        Some(State {
            face: face_of(h),
            weights,
            direction: along,
            entered: weights.map(|l| l <= 0.0),
        })
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
}
