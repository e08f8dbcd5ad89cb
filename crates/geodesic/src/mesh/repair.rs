//! Mending a list of triangles, and saying what was done.

use std::collections::HashMap;

use glam::DVec3;

use super::{Mesh, NONE, check, face_of, next, previous};
use crate::Error;

/// Vertex positions and triangles that need not form a mesh: what a file holds, before any check.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TriangleSoup {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Triangles as vertex numbers.
    pub faces: Vec<[u32; 3]>,
}

/// A mesh made from a soup, and what had to be done.
#[derive(Clone, Debug)]
pub struct Repaired {
    /// The mesh.
    pub mesh: Mesh,
    /// What was done to get it.
    pub report: RepairReport,
}

/// What [`TriangleSoup::repair`] did. Numbers are those of the soup unless said otherwise.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RepairReport {
    /// Faces dropped because a corner is not finite or does not exist.
    pub invalid_faces: Vec<u32>,
    /// Vertices `[v, kept]` replaced by another vertex at the same place.
    pub welded: Vec<[u32; 2]>,
    /// Faces dropped because they have no area, or name a vertex twice (after welding).
    pub degenerate_faces: Vec<u32>,
    /// Faces dropped because the same triangle came before, in either orientation.
    pub repeated_faces: Vec<u32>,
    /// Faces turned over to agree with their neighbours.
    pub flipped_faces: Vec<u32>,
    /// Edges with more than two faces, or that cannot be oriented consistently, along which the surface was cut.
    pub split_edges: Vec<[u32; 2]>,
    /// Vertices of which copies were made, one for each further fan of faces.
    pub split_vertices: Vec<u32>,
    /// For each vertex of the mesh, the vertex of the soup that it came from. Vertices without faces are left out.
    pub vertex_origin: Vec<u32>,
    /// For each face of the mesh, the face of the soup that it came from.
    pub face_origin: Vec<u32>,
}

impl RepairReport {
    /// Whether the soup was a mesh already.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.invalid_faces.is_empty()
            && self.welded.is_empty()
            && self.degenerate_faces.is_empty()
            && self.repeated_faces.is_empty()
            && self.flipped_faces.is_empty()
            && self.split_edges.is_empty()
            && self.split_vertices.is_empty()
    }
}

impl TriangleSoup {
    /// The mesh that these triangles were meant to be.
    ///
    /// In this order: faces with missing or non-finite corners are dropped; vertices at exactly the same place are
    /// welded; degenerate and repeated faces are dropped; neighbouring faces are given the same orientation (each
    /// component keeps that of its first face); the surface is cut along edges with more than two faces and where no
    /// consistent orientation exists; a vertex is copied for each fan of faces beyond the first. Vertices without
    /// faces are left out. Numbering is otherwise kept, and what is a mesh already comes back as it was.
    ///
    /// # Errors
    ///
    /// [`Error::EmptyMesh`] if no face is left, [`Error::TooManyFaces`], [`Error::MeshSize`].
    pub fn repair(&self) -> Result<Repaired, Error> {
        if self.faces.len() >= (u32::MAX / 3) as usize {
            return Err(Error::TooManyFaces {
                faces: self.faces.len(),
            });
        }
        let mut report = RepairReport::default();
        let mut faces = self.sound_faces(&mut report);
        if faces.is_empty() {
            return Err(Error::EmptyMesh);
        }
        let twins = orient(&mut faces, &mut report);
        let (positions, faces) = self.split_fans(faces, twins, &mut report);
        Ok(Repaired {
            mesh: Mesh::from_triangles(positions, faces)?,
            report,
        })
    }

    /// Faces worth keeping, by welded vertices; `report.face_origin` says where they came from.
    fn sound_faces(&self, report: &mut RepairReport) -> Vec<[u32; 3]> {
        let mut first_at = HashMap::new();
        let mut weld: Vec<u32> = (0..self.positions.len() as u32).collect();
        for (v, p) in self.positions.iter().enumerate() {
            // Adding 0 makes the two zeros one.
            let key = (*p + DVec3::ZERO).to_array().map(f64::to_bits);
            let kept = *first_at.entry(key).or_insert(v as u32);
            if p.is_finite() && kept != v as u32 {
                weld[v] = kept;
                report.welded.push([v as u32, kept]);
            }
        }
        let mut seen = std::collections::HashSet::new();
        let mut kept = Vec::with_capacity(self.faces.len());
        for (f, face) in self.faces.iter().enumerate() {
            let f = f as u32;
            let corners = face.map(|v| {
                self.positions
                    .get(v as usize)
                    .copied()
                    .filter(|p| p.is_finite())
            });
            let [Some(a), Some(b), Some(c)] = corners else {
                report.invalid_faces.push(f);
                continue;
            };
            if check::degenerate_ratio([a, b, c]).is_some() {
                report.degenerate_faces.push(f);
                continue;
            }
            let face = face.map(|v| weld[v as usize]);
            let mut sorted = face;
            sorted.sort_unstable();
            if seen.insert(sorted) {
                kept.push(face);
                report.face_origin.push(f);
            } else {
                report.repeated_faces.push(f);
            }
        }
        kept
    }

    /// Gives every fan of faces its own vertex, and numbers what is in use.
    fn split_fans(
        &self,
        mut faces: Vec<[u32; 3]>,
        mut twins: Vec<u32>,
        report: &mut RepairReport,
    ) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        // Copy `origin[v]` belongs to soup vertex `v`; the first fan keeps the vertex itself.
        let mut origin: Vec<u32> = (0..self.positions.len() as u32).collect();
        loop {
            name_fans(&mut faces, &twins, &mut origin, report);
            // Two cut sheets may still share both ends of an edge. Faces that stand in the way come loose entirely,
            // which happens at most once to each.
            let mut seen = HashMap::new();
            let mut loose = Vec::new();
            for h in 0..3 * faces.len() as u32 {
                let edge = (
                    faces.as_flattened()[h as usize],
                    faces.as_flattened()[next(h) as usize],
                );
                if seen.insert(edge, h).is_some() && loose.last() != Some(&face_of(h)) {
                    loose.push(face_of(h));
                }
            }
            if loose.is_empty() {
                break;
            }
            for f in loose {
                for h in 3 * f..3 * f + 3 {
                    let twin = std::mem::replace(&mut twins[h as usize], NONE);
                    if twin != NONE {
                        twins[twin as usize] = NONE;
                    }
                    let v = faces[f as usize][(h % 3) as usize];
                    origin.push(origin[v as usize]);
                    faces[f as usize][(h % 3) as usize] = origin.len() as u32 - 1;
                }
            }
        }
        report.split_vertices.sort_unstable();
        report.split_vertices.dedup();
        let mut number = vec![NONE; origin.len()];
        for &v in faces.as_flattened() {
            number[v as usize] = 0;
        }
        let mut positions = Vec::new();
        for (v, slot) in number
            .iter_mut()
            .enumerate()
            .filter(|(_, slot)| **slot == 0)
        {
            *slot = positions.len() as u32;
            positions.push(self.positions[origin[v] as usize]);
            report.vertex_origin.push(origin[v]);
        }
        let faces = faces
            .into_iter()
            .map(|face| face.map(|v| number[v as usize]))
            .collect();
        (positions, faces)
    }
}

/// Turns faces over until neighbours agree, and says who is joined to whom.
fn orient(faces: &mut [[u32; 3]], report: &mut RepairReport) -> Vec<u32> {
    let mut at_edge: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    let edge = |face: &[u32; 3], k: usize| {
        let (a, b) = (face[k], face[(k + 1) % 3]);
        [a.min(b), a.max(b)]
    };
    for (f, face) in faces.iter().enumerate() {
        for k in 0..3 {
            at_edge.entry(edge(face, k)).or_default().push(f as u32);
        }
    }
    let mut oriented = vec![false; faces.len()];
    let mut stack = Vec::new();
    for first in 0..faces.len() {
        if std::mem::replace(&mut oriented[first], true) {
            continue;
        }
        stack.push(first);
        while let Some(f) = stack.pop() {
            for k in 0..3 {
                let Some(&[x, y]) = at_edge.get(&edge(&faces[f], k)).map(Vec::as_slice) else {
                    continue;
                };
                let other = (x + y) as usize - f;
                if !std::mem::replace(&mut oriented[other], true) {
                    if directs(&faces[other], faces[f][k], faces[f][(k + 1) % 3]).is_some() {
                        faces[other].swap(1, 2);
                        report.flipped_faces.push(report.face_origin[other]);
                    }
                    stack.push(other);
                }
            }
        }
    }
    report.flipped_faces.sort_unstable();
    let mut twins = vec![NONE; 3 * faces.len()];
    for (&[a, b], at) in &at_edge {
        match at[..] {
            [_] => {}
            [f, g] => {
                let here = directs(&faces[f as usize], a, b).zip(directs(&faces[g as usize], b, a));
                let there =
                    directs(&faces[f as usize], b, a).zip(directs(&faces[g as usize], a, b));
                match here.or(there) {
                    Some((i, j)) => {
                        twins[3 * f as usize + i] = 3 * g + j as u32;
                        twins[3 * g as usize + j] = 3 * f + i as u32;
                    }
                    None => report.split_edges.push([a, b]),
                }
            }
            _ => report.split_edges.push([a, b]),
        }
    }
    report.split_edges.sort_unstable();
    twins
}

/// The position in `face` of its edge from `a` to `b`.
fn directs(face: &[u32; 3], a: u32, b: u32) -> Option<usize> {
    (0..3).find(|&k| face[k] == a && face[(k + 1) % 3] == b)
}

/// Walks each fan of faces once; every fan after the first at a vertex gets a copy of it.
fn name_fans(
    faces: &mut [[u32; 3]],
    twins: &[u32],
    origin: &mut Vec<u32>,
    report: &mut RepairReport,
) {
    let mut named = vec![false; 3 * faces.len()];
    let mut used = vec![false; origin.len()];
    for first in 0..3 * faces.len() as u32 {
        if named[first as usize] {
            continue;
        }
        let v = faces.as_flattened()[first as usize];
        let name = if std::mem::replace(&mut used[v as usize], true) {
            report.split_vertices.push(origin[v as usize]);
            origin.push(origin[v as usize]);
            used.push(true);
            origin.len() as u32 - 1
        } else {
            v
        };
        // Counter-clockwise as far as it goes, then clockwise from the start.
        for clockwise in [false, true] {
            let mut h = first;
            loop {
                named[h as usize] = true;
                faces.as_flattened_mut()[h as usize] = name;
                let across = if clockwise { h } else { previous(h) };
                let twin = twins[across as usize];
                if twin == NONE {
                    break;
                }
                h = if clockwise { next(twin) } else { twin };
                if h == first {
                    break;
                }
            }
        }
    }
}
