//! The star of a vertex: its faces in order, its angles, and what they say about its curvature.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{Mesh, NONE, next, previous};

/// Angles this close to 2π count as flat, in radians.
///
/// The angle at a vertex is a sum of a few arc tangents, each good to an ulp, of differences of coordinates that may
/// have lost a few digits.
pub const FLAT_ANGLE: f64 = 1e-10;

/// The curvature at a vertex, by its total angle θ (Section 2.1 of the thesis, after Polthier and Schmies).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum VertexKind {
    /// θ < 2π: no shortest path passes through it.
    Elliptic,
    /// θ = 2π: flat, also called Euclidean.
    Parabolic,
    /// θ > 2π: shortest paths may bend at it.
    Hyperbolic,
    /// On the boundary.
    Boundary,
    /// Without faces, or not in the mesh.
    Isolated,
}

impl Mesh {
    /// The half-edges that begin at `v`, counter-clockwise; none for a vertex without faces, or if there is no vertex `v`.
    pub fn star(&self, v: u32) -> Star<'_> {
        let first = self.outgoing(v).unwrap_or(NONE);
        Star {
            mesh: self,
            first,
            upcoming: first,
        }
    }

    /// Whether `v` lies on the boundary.
    #[must_use]
    #[inline]
    pub fn is_boundary_vertex(&self, v: u32) -> bool {
        self.outgoing(v)
            .is_some_and(|h| self.twins[h as usize] == NONE)
    }

    /// Total angle of the faces at `v`, in radians.
    #[inline]
    pub(crate) fn angle(&self, v: u32) -> f64 {
        self.angles[v as usize]
    }

    /// The kind of vertex `v`.
    #[must_use]
    pub fn vertex_kind(&self, v: u32) -> VertexKind {
        if self.outgoing(v).is_none() {
            return VertexKind::Isolated;
        }
        if self.is_boundary_vertex(v) {
            return VertexKind::Boundary;
        }
        match self.angle(v) - TAU {
            excess if excess.abs() <= FLAT_ANGLE => VertexKind::Parabolic,
            excess if excess < 0.0 => VertexKind::Elliptic,
            _ => VertexKind::Hyperbolic,
        }
    }

    /// Angle of the face of `h` at the origin of `h`, in radians.
    pub(crate) fn corner_angle(&self, h: u32) -> f64 {
        let corner = self.position(self.origin(h));
        angle_between(
            self.position(self.tip(h)) - corner,
            self.position(self.apex(h)) - corner,
        )
    }

    /// Unit normal of face `f`, on the side from which its corners run counter-clockwise.
    pub(crate) fn face_normal(&self, f: u32) -> DVec3 {
        let [a, b, c] = self.faces[f as usize].map(|v| self.position(v));
        (b - a).cross(c - a).normalize_or_zero()
    }

    /// Unit normals of the vertices: face normals weighted by the angle at the vertex.
    ///
    /// Zero at a vertex without faces, or where the weighted normals cancel.
    #[must_use]
    pub fn vertex_normals(&self) -> Vec<DVec3> {
        let mut normals = vec![DVec3::ZERO; self.vertex_count()];
        for h in 0..self.halfedge_count() as u32 {
            normals[self.origin(h) as usize] +=
                self.corner_angle(h) * self.face_normal(super::face_of(h));
        }
        for normal in &mut normals {
            *normal = normal.normalize_or_zero();
        }
        normals
    }

    /// The outgoing half-edge counter-clockwise from outgoing half-edge `h`.
    #[inline]
    pub(crate) fn counter_clockwise(&self, h: u32) -> Option<u32> {
        self.twin(previous(h))
    }

    /// The outgoing half-edge clockwise from outgoing half-edge `h`.
    #[inline]
    pub(crate) fn clockwise(&self, h: u32) -> Option<u32> {
        self.twin(h).map(next)
    }
}

/// Iterator over the half-edges that begin at a vertex; see [`Mesh::star`].
#[derive(Clone, Debug)]
pub struct Star<'m> {
    mesh: &'m Mesh,
    first: u32,
    upcoming: u32,
}

impl Iterator for Star<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        if self.upcoming == NONE {
            return None;
        }
        let current = self.upcoming;
        let onward = self.mesh.twins[previous(current) as usize];
        self.upcoming = if onward == self.first { NONE } else { onward };
        Some(current)
    }
}

/// Angle between two vectors, in `[0, π]`; accurate where the arc cosine is not.
pub(crate) fn angle_between(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Total angle at each vertex.
pub(super) fn total_angles(positions: &[DVec3], faces: &[[u32; 3]]) -> Vec<f64> {
    let mut angles = vec![0.0; positions.len()];
    for face in faces {
        let [a, b, c] = face.map(|v| positions[v as usize]);
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let doubled_area = ab.cross(bc).length();
        for (v, cosine) in face.iter().zip([-ca.dot(ab), -ab.dot(bc), -bc.dot(ca)]) {
            angles[*v as usize] += doubled_area.atan2(cosine);
        }
    }
    angles
}
