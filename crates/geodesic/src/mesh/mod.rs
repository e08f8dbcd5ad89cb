//! The triangle mesh: flat arrays of half-edges.

mod build;
mod check;
#[cfg(feature = "obj")]
mod obj;
mod repair;
mod star;
#[cfg(feature = "triangulate")]
mod terrain;

pub use repair::{RepairReport, Repaired, TriangleSoup};
pub(crate) use star::angle_between;
pub use star::{FLAT_ANGLE, Star, VertexKind};
#[cfg(feature = "triangulate")]
pub use terrain::triangulate_domain;

use glam::DVec3;

use crate::Error;

/// No half-edge: the twin of a boundary half-edge in [`Mesh::twins`].
pub const NONE: u32 = u32::MAX;

/// A manifold, consistently oriented triangle mesh, with or without boundary, of one or several components.
///
/// Half-edge `3 f + k` runs along face `f` from its corner `k` to the next one, counter-clockwise, with the face on its
/// left. Everything is kept in flat arrays indexed by half-edge, face or vertex, 132 bytes for each vertex of a closed
/// mesh, so that a sweep over the mesh touches memory in few places. A mesh that exists has passed every check of
/// [`Mesh::new`], and is never changed.
///
/// ```
/// use geodesic::{Mesh, glam::DVec3};
/// // A square cut along a diagonal.
/// let corners = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
/// let mesh = Mesh::new(&corners, &[[0, 1, 2], [0, 2, 3]])?;
/// assert_eq!(mesh.halfedge_count(), 6);
/// assert_eq!(mesh.twin(2), Some(3)); // the diagonal, from either side
/// assert!(mesh.is_boundary_vertex(0));
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "TriangleSoup", into = "TriangleSoup")
)]
pub struct Mesh {
    positions: Vec<DVec3>,
    faces: Vec<[u32; 3]>,
    twins: Vec<u32>,
    lengths: Vec<f64>,
    outgoing: Vec<u32>,
    angles: Vec<f64>,
    diameter: f64,
}

impl Mesh {
    /// A mesh from vertex positions and faces, each a list of three vertex numbers, counter-clockwise.
    ///
    /// Faces may be `[u32; 3]`, `Vec<u32>` or anything that lends a slice. A vertex without faces is allowed here; only a
    /// path that ends at it is refused.
    ///
    /// Cost: linear in the number of faces.
    ///
    /// # Errors
    ///
    /// The first of these rules that is broken anywhere: at least one face ([`Error::EmptyMesh`]), finite coordinates
    /// ([`Error::NonFiniteVertex`]), three corners ([`Error::NotATriangle`]), indices in range
    /// ([`Error::IndexOutOfRange`]), distinct corners ([`Error::RepeatedVertex`]), positive area
    /// ([`Error::DegenerateFace`], or [`Error::MeshSize`] where the mesh is not of a size between 1e-62 and 1e62), at most
    /// two faces at an edge ([`Error::NonManifoldEdge`]), each directed edge once ([`Error::RepeatedFace`],
    /// [`Error::InconsistentOrientation`]), one fan of faces at each vertex ([`Error::NonManifoldVertex`]). A soup that breaks them can be mended by [`TriangleSoup::repair`].
    pub fn new<F: AsRef<[u32]>>(positions: &[DVec3], faces: &[F]) -> Result<Self, Error> {
        let faces = check::triangles(positions, faces)?;
        Self::from_triangles(positions.to_vec(), faces)
    }

    /// As [`Mesh::new`], and every vertex must belong to a face.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::new`], then [`Error::UnreferencedVertex`].
    pub fn new_strict<F: AsRef<[u32]>>(positions: &[DVec3], faces: &[F]) -> Result<Self, Error> {
        let mesh = Self::new(positions, faces)?;
        match mesh.outgoing.iter().position(|&h| h == NONE) {
            Some(vertex) => Err(Error::UnreferencedVertex {
                vertex: vertex as u32,
            }),
            None => Ok(mesh),
        }
    }

    /// The rules about triples of valid indices, then the connectivity.
    fn from_triangles(positions: Vec<DVec3>, faces: Vec<[u32; 3]>) -> Result<Self, Error> {
        let lengths = check::edge_lengths(&positions, &faces)?;
        let (twins, outgoing) = build::connect(positions.len(), &faces)?;
        let angles = star::total_angles(&positions, &faces);
        let used = positions.iter().zip(&outgoing).filter(|p| *p.1 != NONE);
        let diameter = check::size(used.map(|p| *p.0))?;
        Ok(Self {
            positions,
            faces,
            twins,
            lengths,
            outgoing,
            angles,
            diameter,
        })
    }

    /// Number of vertices, those without faces included.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// Number of faces.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// Number of half-edges: three for each face.
    #[must_use]
    pub fn halfedge_count(&self) -> usize {
        3 * self.faces.len()
    }

    /// Number of edges: a boundary edge has one half-edge, an inner edge two.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        (self.halfedge_count() + self.boundary_edge_count()) / 2
    }

    /// Number of boundary edges.
    #[must_use]
    pub fn boundary_edge_count(&self) -> usize {
        self.twins.iter().filter(|&&t| t == NONE).count()
    }

    /// Vertex positions, in the caller's order.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Faces as vertex triples, in the caller's order. Entry `h` of `as_flattened()` is the origin of half-edge `h`.
    #[must_use]
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The twin of every half-edge, [`NONE`] on the boundary.
    #[must_use]
    pub fn twins(&self) -> &[u32] {
        &self.twins
    }

    /// The length of every half-edge.
    #[must_use]
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// The total angle at every vertex, in radians; 0 at a vertex without faces.
    #[must_use]
    pub fn angles(&self) -> &[f64] {
        &self.angles
    }

    /// Length of the diagonal of the bounding box of the faces: the size that tolerances are relative to.
    #[must_use]
    pub fn diameter(&self) -> f64 {
        self.diameter
    }

    /// Position of vertex `v`.
    #[inline]
    pub(crate) fn position(&self, v: u32) -> DVec3 {
        self.positions[v as usize]
    }

    /// The vertex where half-edge `h` begins.
    #[inline]
    pub(crate) fn origin(&self, h: u32) -> u32 {
        self.faces.as_flattened()[h as usize]
    }

    /// The vertex where half-edge `h` ends.
    #[inline]
    pub(crate) fn tip(&self, h: u32) -> u32 {
        self.origin(next(h))
    }

    /// The corner of the face of `h` opposite to `h`.
    #[inline]
    pub(crate) fn apex(&self, h: u32) -> u32 {
        self.origin(previous(h))
    }

    /// The half-edge on the other side of the edge of `h`; `None` on the boundary, or if there is no half-edge `h`.
    #[must_use]
    #[inline]
    pub fn twin(&self, h: u32) -> Option<u32> {
        self.twins
            .get(h as usize)
            .copied()
            .filter(|&twin| twin != NONE)
    }

    /// Length of half-edge `h`.
    #[inline]
    pub(crate) fn length(&self, h: u32) -> f64 {
        self.lengths[h as usize]
    }

    /// A half-edge that begins at `v`: on the boundary the one from which the whole star follows counter-clockwise.
    /// `None` for a vertex without faces, or if there is no vertex `v`.
    #[must_use]
    #[inline]
    pub fn outgoing(&self, v: u32) -> Option<u32> {
        self.outgoing
            .get(v as usize)
            .copied()
            .filter(|&h| h != NONE)
    }

    /// The half-edge from `a` to `b`, if a face has it.
    #[must_use]
    pub fn halfedge(&self, a: u32, b: u32) -> Option<u32> {
        self.star(a).find(|&h| self.tip(h) == b)
    }

    /// Vertices minus edges plus faces, vertices without faces left out.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let vertices = self.outgoing.iter().filter(|&&h| h != NONE).count();
        vertices as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// The component of every face, numbered from 0 in the order of their first faces.
    #[must_use]
    pub fn components(&self) -> Vec<u32> {
        let mut component = vec![NONE; self.face_count()];
        let mut stack = Vec::new();
        let mut count = 0;
        for first in 0..self.face_count() {
            if component[first] != NONE {
                continue;
            }
            component[first] = count;
            stack.push(first as u32);
            while let Some(f) = stack.pop() {
                for h in 3 * f..3 * f + 3 {
                    if let Some(twin) = self.twin(h)
                        && component[face_of(twin) as usize] == NONE
                    {
                        component[face_of(twin) as usize] = count;
                        stack.push(face_of(twin));
                    }
                }
            }
            count += 1;
        }
        component
    }

    /// Bytes held by the arrays of the mesh.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.positions[..])
            + size_of_val(&self.faces[..])
            + size_of_val(&self.twins[..])
            + size_of_val(&self.lengths[..])
            + size_of_val(&self.outgoing[..])
            + size_of_val(&self.angles[..])
    }
}

/// The half-edge after `h` in its face, counter-clockwise.
#[must_use]
#[inline]
pub const fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its face.
#[must_use]
#[inline]
pub const fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// The face of half-edge `h`.
#[must_use]
#[inline]
pub const fn face_of(h: u32) -> u32 {
    h / 3
}

impl TryFrom<TriangleSoup> for Mesh {
    type Error = Error;

    fn try_from(soup: TriangleSoup) -> Result<Self, Error> {
        let faces = check::triangles(&soup.positions, &soup.faces)?;
        Self::from_triangles(soup.positions, faces)
    }
}

impl From<Mesh> for TriangleSoup {
    fn from(mesh: Mesh) -> Self {
        Self {
            positions: mesh.positions,
            faces: mesh.faces,
        }
    }
}
