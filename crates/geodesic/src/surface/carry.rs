//! The path on a finer polyhedron that a path on a coarser one suggests.

use crate::exact::join_around_vertices;
use crate::mesh::Mesh;
use crate::path::GeodesicPath;
use crate::pivot::Shortener;
use crate::strip::Strip;
use crate::{Error, SurfacePoint};

/// The faces that a carried path met, as a sequence of neighbours from one end to the other: where the path passes a vertex
/// the faces around it are added, and an end's own face where the path left it at once.
pub(super) fn sequence(
    mesh: &Mesh,
    mut faces: Vec<u32>,
    from: SurfacePoint,
    to: SurfacePoint,
) -> Vec<u32> {
    let missing = |face: Option<&u32>, end: SurfacePoint| {
        let contained = face.is_some_and(|&f| mesh.face_contains(f, end));
        if contained {
            None
        } else {
            mesh.faces_of(end).next()
        }
    };
    if let Some(first) = missing(faces.first(), from) {
        faces.insert(0, first);
    }
    faces.extend(missing(faces.last(), to));
    join_around_vertices(mesh, &faces)
}

/// The locally shortest path that pivot updates reach from a sequence of neighbouring faces, which may come to the same
/// face again: a path that goes round more than once is not cut short, as it is by
/// [`PathFinder::along`](crate::PathFinder::along).
pub(super) fn tighten_through(
    mesh: &Mesh,
    faces: &[u32],
    from: SurfacePoint,
    to: SurfacePoint,
) -> Result<GeodesicPath, Error> {
    let mut shortener = Shortener::default();
    shortener.strip.through_faces(mesh, faces)?;
    for (end, point) in [(faces.first(), from), (faces.last(), to)] {
        if !end.is_some_and(|&f| mesh.face_contains(f, point)) {
            return Err(Error::SequenceMissesPoint { point });
        }
    }
    // Straight back is not round.
    let portals = std::mem::take(&mut shortener.strip.portals);
    portals
        .into_iter()
        .for_each(|portal| shortener.strip.push(mesh, portal));
    shortener.strip.trim(mesh, from, to);
    shortener.begin(mesh, from, to);
    let limit = 20 * mesh.face_count() + 100;
    if !shortener.shorten(mesh, limit, |_, _| {}) {
        return Err(Error::NotConverged {
            updates: shortener.updates,
        });
    }
    let mut path = GeodesicPath::default();
    path.set(mesh, &shortener, &mut Strip::default());
    Ok(path)
}
