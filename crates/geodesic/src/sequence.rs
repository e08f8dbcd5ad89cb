//! Initial face sequences other than those of the search: along the chord, and along a straight line of a parameter domain.
//!
//! Both follow the line on the mesh on which a function, linear in every face, vanishes. [`PathFinder::along`] shortens a
//! path in them.
//!
//! [`PathFinder::along`]: crate::PathFinder::along

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::{Error, SurfacePoint};

impl Mesh {
    /// The faces that the chord between two points is projected on: those cut, on the way from the first point to the second,
    /// by the plane through both that holds the mean of the surface normals there.
    ///
    /// ```
    /// use geodesic::{PathFinder, shapes};
    /// let sphere = shapes::sphere(3)?;
    /// let (from, to) = (sphere.vertex_point(0)?, sphere.vertex_point(100)?);
    /// let faces = sphere.faces_along_chord(from, to)?;
    /// let mut finder = PathFinder::new(&sphere);
    /// let path = finder.along(&faces, from, to)?;
    /// assert!(path.certify(&sphere)?.is_geodesic());
    /// # Ok::<(), geodesic::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh; [`Error::SequenceMissesPoint`] if the cut leads to the boundary, or back
    /// to the first point, without meeting the second.
    pub fn faces_along_chord(
        &self,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<Vec<u32>, Error> {
        let (from, to) = (self.canonical(from)?, self.canonical(to)?);
        let (start, end) = (self.locate(from), self.locate(to));
        let chord = end - start;
        let normal: DVec3 = [from, to]
            .into_iter()
            .map(|point| {
                let faces = self.faces_of(point);
                faces
                    .map(|f| self.face_normal(f))
                    .sum::<DVec3>()
                    .normalize_or_zero()
            })
            .sum();
        let across = chord
            .cross(normal)
            .normalize_or(chord.any_orthogonal_vector());
        follow(self, from, to, |v| {
            let offset = self.position(v) - start;
            DVec2::new(offset.dot(chord), offset.dot(across))
        })
    }

    /// The faces that a straight line between two points crosses in a parameter domain: `domain` says where a vertex lies in
    /// it.
    ///
    /// # Errors
    ///
    /// As for [`Mesh::faces_along_chord`].
    pub fn faces_along_line(
        &self,
        domain: impl Fn(u32) -> DVec2,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<Vec<u32>, Error> {
        let (from, to) = (self.canonical(from)?, self.canonical(to)?);
        let place = |point: SurfacePoint| {
            let f = self.faces_of(point).next().unwrap_or(0);
            let weights = self.barycentric_in(f, point).unwrap_or_default();
            (0..3)
                .map(|k| weights[k] * domain(self.faces()[f as usize][k]))
                .sum::<DVec2>()
        };
        let (start, end) = (place(from), place(to));
        let line = end - start;
        follow(self, from, to, |v| {
            let offset = domain(v) - start;
            DVec2::new(line.dot(offset), line.perp_dot(offset))
        })
    }
}

/// Follows the line `y = 0` from a point to another one, in coordinates of the vertices in which it begins at the origin and
/// goes towards `x > 0`.
fn follow(
    mesh: &Mesh,
    from: SurfacePoint,
    to: SurfacePoint,
    place: impl Fn(u32) -> DVec2,
) -> Result<Vec<u32>, Error> {
    if let Some(face) = mesh.faces_of(from).find(|&f| mesh.face_contains(f, to)) {
        return Ok(vec![face]);
    }
    // A line through vertices passes them all on the same side: on the one, or, along a boundary perhaps, on the other.
    let above = |v: u32| place(v).y >= 0.0;
    let below = |v: u32| place(v).y <= 0.0;
    follow_between(mesh, from, to, &place, above)
        .or_else(|_| follow_between(mesh, from, to, &place, below))
}

/// Follows the line between the vertices on one side and the others.
fn follow_between(
    mesh: &Mesh,
    from: SurfacePoint,
    to: SurfacePoint,
    place: impl Fn(u32) -> DVec2,
    side: impl Fn(u32) -> bool,
) -> Result<Vec<u32>, Error> {
    let is_crossed = |h: u32| side(mesh.origin(h)) != side(mesh.tip(h));
    let crossing = |h: u32| {
        let (a, b) = (place(mesh.origin(h)), place(mesh.tip(h)));
        a.x + (b.x - a.x) * a.y / (a.y - b.y)
    };
    // The ways out of the faces of the point, the most forward one first.
    let mut exits: Vec<u32> = mesh
        .faces_of(from)
        .flat_map(|f| 3 * f..3 * f + 3)
        .filter(|&h| is_crossed(h) && !touches(mesh, h, from))
        .collect();
    exits.sort_by(|&a, &b| crossing(b).total_cmp(&crossing(a)));
    for mut h in exits {
        let mut faces = vec![face_of(h)];
        while faces.len() <= mesh.face_count() {
            let twin = mesh.twins()[h as usize];
            if twin == NONE {
                break;
            }
            let f = face_of(twin);
            faces.push(f);
            if mesh.face_contains(f, to) {
                return Ok(faces);
            }
            h = if is_crossed(next(twin)) {
                next(twin)
            } else {
                previous(twin)
            };
        }
    }
    Err(Error::SequenceMissesPoint { point: to })
}

/// Whether a point lies on an edge or at one of its ends.
fn touches(mesh: &Mesh, h: u32, point: SurfacePoint) -> bool {
    match point {
        SurfacePoint::Vertex(v) => mesh.origin(h) == v || mesh.tip(h) == v,
        SurfacePoint::Edge { halfedge, .. } => {
            halfedge == h || mesh.twins()[halfedge as usize] == h
        }
        SurfacePoint::Face { .. } => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PathFinder, shapes};

    #[test]
    fn on_a_plane_both_lines_are_the_path() {
        let sheet = shapes::sheet(9, 7, |p| p.extend(0.0)).unwrap();
        let mut finder = PathFinder::new(&sheet);
        let count = sheet.vertex_count() as u32;
        for i in 0..40 {
            let (a, b) = ((i * 31) % count, (i * 17 + 5) % count);
            let chord = sheet.positions()[a as usize].distance(sheet.positions()[b as usize]);
            let by_chord = sheet.faces_along_chord(a.into(), b.into()).unwrap();
            let domain = |v: u32| sheet.positions()[v as usize].truncate();
            let by_line = sheet.faces_along_line(domain, a.into(), b.into()).unwrap();
            for faces in [by_chord, by_line] {
                let path = finder.taut(&faces, a.into(), b.into()).unwrap();
                assert!((path.length() - chord).abs() <= 1e-12, "{a} {b}");
            }
        }
    }

    #[test]
    fn on_closed_and_cut_meshes_there_is_a_sequence_or_a_named_answer() {
        let torus = shapes::torus(2.0, 0.7, 30, 14).unwrap();
        let mut finder = PathFinder::new(&torus);
        let mut found = 0;
        for i in 0..60 {
            let from = torus.face_point(i * 7, [0.2, 0.3, 0.5]).unwrap();
            let to = SurfacePoint::Edge {
                halfedge: (i * 97 + 400) % 2000,
                t: 0.3,
            };
            match torus.faces_along_chord(from, to) {
                Ok(faces) => {
                    found += 1;
                    let path = finder.along(&faces, from, to).unwrap();
                    assert!(path.certify(&torus).unwrap().is_geodesic());
                }
                Err(Error::SequenceMissesPoint { .. }) => {}
                Err(error) => panic!("{error}"),
            }
        }
        assert!(found > 30, "{found}");
    }
}
