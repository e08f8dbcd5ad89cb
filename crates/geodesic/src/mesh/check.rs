//! The rules that make a list of triangles a mesh, and the diagnosis of those that do not.

use glam::DVec3;

use crate::Error;

/// A face is degenerate when twice its area is at most this times its longest side squared.
///
/// Coordinates carry rounding of 1e-16 of their size, so a height that is 1e-12 of the base is still a few thousand
/// times larger than the noise in it, and anything thinner has angles that no longer mean anything.
pub(super) const DEGENERATE: f64 = 1e-12;

/// Sizes of meshes that are accepted: areas are squared on the way to a normal, and beyond these bounds the squares of
/// thin faces leave the range of numbers.
const SIZES: std::ops::RangeInclusive<f64> = 1e-62..=1e62;

/// A face whose longest side is below this has no area that could be squared.
const SHORTEST: f64 = 1e-70;

/// The rules on single vertices and faces, and the faces as triples.
pub(super) fn triangles<F: AsRef<[u32]>>(
    positions: &[DVec3],
    faces: &[F],
) -> Result<Vec<[u32; 3]>, Error> {
    if faces.is_empty() {
        return Err(Error::EmptyMesh);
    }
    // The last number is kept for "none".
    if faces.len() >= (u32::MAX / 3) as usize {
        return Err(Error::TooManyFaces { faces: faces.len() });
    }
    finite(positions)?;
    let mut triples = Vec::with_capacity(faces.len());
    for (face, corners) in faces.iter().enumerate() {
        let corners = corners.as_ref();
        let triple: [u32; 3] = corners.try_into().map_err(|_| Error::NotATriangle {
            face: face as u32,
            corners: corners.len(),
        })?;
        triples.push(triple);
    }
    for (face, triple) in triples.iter().enumerate() {
        if let Some(&vertex) = triple.iter().find(|&&v| v as usize >= positions.len()) {
            return Err(Error::IndexOutOfRange {
                face: face as u32,
                vertex,
                vertices: positions.len(),
            });
        }
    }
    for (face, &[a, b, c]) in triples.iter().enumerate() {
        if a == b || b == c || c == a {
            return Err(Error::RepeatedVertex {
                face: face as u32,
                vertex: if a == b { a } else { c },
            });
        }
    }
    Ok(triples)
}

pub(super) fn finite(positions: &[DVec3]) -> Result<(), Error> {
    match positions.iter().position(|p| !p.is_finite()) {
        Some(vertex) => Err(Error::NonFiniteVertex {
            vertex: vertex as u32,
        }),
        None => Ok(()),
    }
}

/// The diagonal of the bounding box of the vertices of faces, if it is in range.
pub(super) fn size(vertices: impl Iterator<Item = DVec3>) -> Result<f64, Error> {
    let (low, high) = vertices.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let size = (high - low).length();
    if SIZES.contains(&size) {
        Ok(size)
    } else {
        Err(Error::MeshSize { size })
    }
}

/// The length of every half-edge; refuses faces without area.
pub(super) fn edge_lengths(positions: &[DVec3], faces: &[[u32; 3]]) -> Result<Vec<f64>, Error> {
    let mut lengths = Vec::with_capacity(3 * faces.len());
    for (face, &vertices) in faces.iter().enumerate() {
        let corners = vertices.map(|v| positions[v as usize]);
        if let Some(ratio) = degenerate_ratio(corners) {
            // Areas that cannot be squared look like none.
            let used = faces.as_flattened().iter().map(|&v| positions[v as usize]);
            if let Err(Error::MeshSize { size }) = size(used)
                && size > 0.0
            {
                return Err(Error::MeshSize { size });
            }
            return Err(Error::DegenerateFace {
                face: face as u32,
                vertices,
                ratio,
            });
        }
        let [a, b, c] = corners;
        lengths.extend([a.distance(b), b.distance(c), c.distance(a)]);
    }
    Ok(lengths)
}

/// Twice the area over the longest side squared, if that is too small for a face.
pub(super) fn degenerate_ratio([a, b, c]: [DVec3; 3]) -> Option<f64> {
    let longest = a
        .distance_squared(b)
        .max(b.distance_squared(c))
        .max(c.distance_squared(a));
    let ratio = (b - a).cross(c - a).length() / longest;
    // A quotient that overflows or is 0/0 (coincident or huge corners) is degenerate as well.
    let is_tiny = longest < SHORTEST * SHORTEST;
    (ratio <= DEGENERATE || !ratio.is_finite() || is_tiny).then_some(ratio)
}

/// The rule that these faces break, given that some directed edge occurs twice.
pub(super) fn diagnose_edges(faces: &[[u32; 3]]) -> Error {
    let flat = faces.as_flattened();
    let tip = |h: u32| flat[super::next(h) as usize];
    let mut edges: Vec<([u32; 2], u32)> = (0..flat.len() as u32)
        .map(|h| {
            let (a, b) = (flat[h as usize], tip(h));
            ([a.min(b), a.max(b)], h)
        })
        .collect();
    edges.sort_unstable();
    let groups = || edges.chunk_by(|x, y| x.0 == y.0);
    for group in groups() {
        if let [(vertices, h0), (_, h1), (_, h2), ..] = *group {
            let faces = [h0, h1, h2].map(super::face_of);
            return Error::NonManifoldEdge {
                vertices,
                faces,
                count: group.len(),
            };
        }
    }
    for group in groups() {
        if let [(_, h0), (_, h1)] = *group
            && flat[h0 as usize] == flat[h1 as usize]
        {
            let pair = [h0, h1].map(super::face_of);
            let opposite = [h0, h1].map(|h| flat[super::previous(h) as usize]);
            if opposite[0] == opposite[1] {
                return Error::RepeatedFace { faces: pair };
            }
            return Error::InconsistentOrientation {
                vertices: [flat[h0 as usize], tip(h0)],
                faces: pair,
            };
        }
    }
    // Not reached: a directed edge that occurs twice is one of the two cases.
    Error::EmptyMesh
}
