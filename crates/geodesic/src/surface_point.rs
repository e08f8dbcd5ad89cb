//! Points on a mesh: at a vertex, on an edge, or inside a face.

use std::fmt;

use glam::DVec3;

use crate::Error;
use crate::mesh::{Mesh, NONE, face_of, next, previous};

/// Barycentric coordinates and edge parameters this close to 0 or 1 are taken to be there.
///
/// A point given in coordinates of size 1 is placed on its face to about 1e-15; a thousand times that still moves it by
/// less than the rounding of a path that begins there.
pub const SNAP: f64 = 1e-12;

/// How far barycentric coordinates may lie outside the face, or their sum from 1, before the point is refused.
///
/// Coordinates read from files have six to ten digits; what lies outside by less is rounding, not a mistake.
pub const OUTSIDE: f64 = 1e-9;

/// A point on a mesh.
///
/// Made by [`Mesh::vertex_point`], [`Mesh::edge_point`] and [`Mesh::face_point`], which check it and choose the
/// simplest form: a point at a corner of a face becomes a vertex. Functions that take points do the same again, so a
/// point written out by hand is safe too.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SurfacePoint {
    /// A vertex.
    Vertex(u32),
    /// The point `(1 - t) origin + t tip` of a half-edge, `0 < t < 1`.
    Edge {
        /// The half-edge; either one of an inner edge.
        halfedge: u32,
        /// The parameter.
        t: f64,
    },
    /// The point of a face with the given barycentric coordinates, all positive and of sum 1.
    Face {
        /// The face.
        face: u32,
        /// Weights of its three corners.
        barycentric: [f64; 3],
    },
}

impl From<u32> for SurfacePoint {
    fn from(vertex: u32) -> Self {
        Self::Vertex(vertex)
    }
}

impl fmt::Display for SurfacePoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vertex(v) => write!(f, "vertex {v}"),
            Self::Edge { halfedge, t } => write!(f, "the point at {t} of half-edge {halfedge}"),
            Self::Face {
                face,
                barycentric: [a, b, c],
            } => write!(f, "the point ({a}, {b}, {c}) of face {face}"),
        }
    }
}

impl Mesh {
    /// Vertex `v` as a point.
    ///
    /// # Errors
    ///
    /// [`Error::NoSuchVertex`], or [`Error::UnreferencedVertex`] if it belongs to no face.
    pub fn vertex_point(&self, v: u32) -> Result<SurfacePoint, Error> {
        self.canonical(SurfacePoint::Vertex(v))
    }

    /// The point `(1 - t) a + t b` of the edge between vertices `a` and `b`.
    ///
    /// # Errors
    ///
    /// [`Error::NoSuchVertex`], [`Error::NotAnEdge`], or [`Error::OutsideEdge`] unless `0 <= t <= 1`.
    pub fn edge_point(&self, a: u32, b: u32, t: f64) -> Result<SurfacePoint, Error> {
        for vertex in [a, b] {
            if vertex as usize >= self.vertex_count() {
                return Err(Error::NoSuchVertex {
                    vertex,
                    vertices: self.vertex_count(),
                });
            }
        }
        if let Some(halfedge) = self.halfedge(a, b) {
            return self.canonical(SurfacePoint::Edge { halfedge, t });
        }
        match self.halfedge(b, a) {
            // Snapped before it is reversed: 1 - t would lose a small t.
            Some(halfedge) => match self.canonical(SurfacePoint::Edge { halfedge, t })? {
                SurfacePoint::Edge { .. } => Ok(SurfacePoint::Edge {
                    halfedge,
                    t: 1.0 - t,
                }),
                _ => Ok(SurfacePoint::Vertex(if t < 0.5 { a } else { b })),
            },
            None => Err(Error::NotAnEdge { vertices: [a, b] }),
        }
    }

    /// The point of a face with the given barycentric coordinates, one for each corner in the order of the face.
    ///
    /// # Errors
    ///
    /// [`Error::NoSuchFace`], or [`Error::OutsideFace`] unless the coordinates are non-negative and sum to 1, to
    /// [`OUTSIDE`].
    pub fn face_point(&self, face: u32, barycentric: [f64; 3]) -> Result<SurfacePoint, Error> {
        self.canonical(SurfacePoint::Face { face, barycentric })
    }

    /// The same point in its simplest form: a face point with a coordinate below [`SNAP`] lies on an edge, an edge point
    /// within [`SNAP`] of an end is that vertex.
    ///
    /// # Errors
    ///
    /// As for [`Mesh::vertex_point`], [`Mesh::edge_point`], [`Mesh::face_point`], and [`Error::NoSuchHalfedge`].
    pub fn canonical(&self, point: SurfacePoint) -> Result<SurfacePoint, Error> {
        match point {
            SurfacePoint::Vertex(vertex) => {
                if vertex as usize >= self.vertex_count() {
                    return Err(Error::NoSuchVertex {
                        vertex,
                        vertices: self.vertex_count(),
                    });
                }
                match self.outgoing(vertex) {
                    Some(_) => Ok(point),
                    None => Err(Error::UnreferencedVertex { vertex }),
                }
            }
            SurfacePoint::Edge { halfedge, t } => {
                if halfedge as usize >= self.halfedge_count() {
                    return Err(Error::NoSuchHalfedge {
                        halfedge,
                        halfedges: self.halfedge_count(),
                    });
                }
                if !(-OUTSIDE..=1.0 + OUTSIDE).contains(&t) {
                    return Err(Error::OutsideEdge { t });
                }
                if t < SNAP {
                    Ok(SurfacePoint::Vertex(self.origin(halfedge)))
                } else if t > 1.0 - SNAP {
                    Ok(SurfacePoint::Vertex(self.tip(halfedge)))
                } else {
                    Ok(point)
                }
            }
            SurfacePoint::Face { face, barycentric } => {
                if face as usize >= self.face_count() {
                    return Err(Error::NoSuchFace {
                        face,
                        faces: self.face_count(),
                    });
                }
                let sum: f64 = barycentric.iter().sum();
                let inside = barycentric.iter().all(|&l| l >= -OUTSIDE);
                if !inside || sum.is_nan() || (sum - 1.0).abs() > OUTSIDE {
                    return Err(Error::OutsideFace { barycentric });
                }
                let weights = barycentric.map(|l| l / sum);
                match weights.iter().position(|&l| l < SNAP) {
                    None => Ok(SurfacePoint::Face {
                        face,
                        barycentric: weights,
                    }),
                    // Corner k has no weight: the point lies on the edge from corner k + 1 to corner k + 2.
                    Some(k) => {
                        let (from, to) = ((k + 1) % 3, (k + 2) % 3);
                        let [from_weight, to_weight] =
                            [weights[from].max(0.0), weights[to].max(0.0)];
                        let halfedge = 3 * face + from as u32;
                        self.canonical(SurfacePoint::Edge {
                            halfedge,
                            t: to_weight / (from_weight + to_weight),
                        })
                    }
                }
            }
        }
    }

    /// Where a point lies in space.
    ///
    /// # Errors
    ///
    /// As for [`Mesh::canonical`].
    pub fn point_position(&self, point: SurfacePoint) -> Result<DVec3, Error> {
        Ok(self.locate(self.canonical(point)?))
    }

    /// The faces that contain a point: one inside a face, one or two on an edge, the star at a vertex
    /// (counter-clockwise). None for a point that is not on the mesh.
    pub fn faces_of(&self, point: SurfacePoint) -> impl Iterator<Item = u32> + '_ {
        let point = self.canonical(point).unwrap_or(SurfacePoint::Vertex(NONE));
        let (star, pair) = match point {
            SurfacePoint::Vertex(v) => (self.star(v), [None, None]),
            SurfacePoint::Edge { halfedge, .. } => (
                self.star(NONE),
                [Some(face_of(halfedge)), self.twin(halfedge).map(face_of)],
            ),
            SurfacePoint::Face { face, .. } => (self.star(NONE), [Some(face), None]),
        };
        star.map(face_of).chain(pair.into_iter().flatten())
    }

    /// Position of a point known to be valid.
    pub(crate) fn locate(&self, point: SurfacePoint) -> DVec3 {
        match point {
            SurfacePoint::Vertex(v) => self.position(v),
            SurfacePoint::Edge { halfedge, t } => self
                .position(self.origin(halfedge))
                .lerp(self.position(self.tip(halfedge)), t),
            SurfacePoint::Face {
                face,
                barycentric: [a, b, c],
            } => {
                let corners = self.faces()[face as usize].map(|v| self.position(v));
                a * corners[0] + b * corners[1] + c * corners[2]
            }
        }
    }

    /// Whether face `f` contains a valid point in simplest form.
    pub(crate) fn face_contains(&self, f: u32, point: SurfacePoint) -> bool {
        match point {
            SurfacePoint::Vertex(v) => self.faces()[f as usize].contains(&v),
            SurfacePoint::Edge { halfedge, .. } => {
                face_of(halfedge) == f || self.twin(halfedge).is_some_and(|twin| face_of(twin) == f)
            }
            SurfacePoint::Face { face, .. } => face == f,
        }
    }

    /// Barycentric coordinates in face `f` of a valid point that the face contains.
    pub(crate) fn barycentric_in(&self, f: u32, point: SurfacePoint) -> Option<[f64; 3]> {
        let mut weights = [0.0; 3];
        match point {
            SurfacePoint::Vertex(v) => {
                let corner = self.faces()[f as usize].iter().position(|&c| c == v)?;
                weights[corner] = 1.0;
            }
            SurfacePoint::Edge { halfedge, t } => {
                let (h, t) = if face_of(halfedge) == f {
                    (halfedge, t)
                } else {
                    (
                        self.twin(halfedge).filter(|&twin| face_of(twin) == f)?,
                        1.0 - t,
                    )
                };
                weights[(h % 3) as usize] = 1.0 - t;
                weights[(next(h) % 3) as usize] = t;
                weights[(previous(h) % 3) as usize] = 0.0;
            }
            SurfacePoint::Face { face, barycentric } => {
                if face != f {
                    return None;
                }
                weights = barycentric;
            }
        }
        Some(weights)
    }
}
