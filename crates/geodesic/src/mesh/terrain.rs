//! Meshes over a plane domain: scattered heights with breaklines, and parametric patches, by spade's Delaunay.

use std::collections::HashMap;

use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::{Mesh, check};
use crate::Error;

/// A point of the domain that remembers its number.
#[derive(Clone, Copy)]
struct Site {
    position: Point2<f64>,
    number: u32,
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

impl Mesh {
    /// The terrain over scattered points `(x, y, height)`: Delaunay in the plane, with the given breaklines (ridges,
    /// shores, roads; pairs of point numbers) among the edges.
    ///
    /// Vertices are the points, in their order. A point with the same `(x, y)` as an earlier one stays without faces.
    ///
    /// # Errors
    ///
    /// [`Error::NonFiniteVertex`], those of [`triangulate_domain`], then those of [`Mesh::new`].
    pub fn terrain(points: &[DVec3], breaklines: &[[u32; 2]]) -> Result<Self, Error> {
        check::finite(points)?;
        let domain: Vec<DVec2> = points.iter().map(|p| p.truncate()).collect();
        Self::new(points, &triangulate_domain(&domain, breaklines)?)
    }

    /// The mesh of a parametric surface over points of its domain: Delaunay in the domain, carried by `surface`.
    ///
    /// # Errors
    ///
    /// Those of [`triangulate_domain`], then those of [`Mesh::new`]: a collapsed edge of the surface gives
    /// [`Error::DegenerateFace`].
    pub fn parametric(
        domain: &[DVec2],
        breaklines: &[[u32; 2]],
        surface: impl FnMut(DVec2) -> DVec3,
    ) -> Result<Self, Error> {
        let faces = triangulate_domain(domain, breaklines)?;
        let points: Vec<DVec3> = domain.iter().copied().map(surface).collect();
        Self::new(&points, &faces)
    }
}

/// The Delaunay triangulation of points of the plane that keeps the given segments as edges, as counter-clockwise
/// triples of point numbers.
///
/// A point that repeats an earlier one is not used, and slivers without area along the hull are left out.
///
/// # Errors
///
/// [`Error::NonFiniteVertex`]; [`Error::NoSuchVertex`] for a breakline with a wrong number;
/// [`Error::CrossingBreaklines`]; [`Error::Untriangulable`] for a coordinate beyond 2^201 in size;
/// [`Error::EmptyMesh`] if all points lie on a line.
pub fn triangulate_domain(
    points: &[DVec2],
    breaklines: &[[u32; 2]],
) -> Result<Vec<[u32; 3]>, Error> {
    if let Some(vertex) = points.iter().position(|p| !p.is_finite()) {
        return Err(Error::NonFiniteVertex {
            vertex: vertex as u32,
        });
    }
    if let Some(&vertex) = breaklines
        .iter()
        .flatten()
        .find(|&&v| v as usize >= points.len())
    {
        return Err(Error::NoSuchVertex {
            vertex,
            vertices: points.len(),
        });
    }
    let (sites, site_of) = distinct_sites(points)?;
    let segments: Vec<[usize; 2]> = breaklines
        .iter()
        .map(|ends| ends.map(|v| site_of[v as usize]))
        .collect();
    if let Some(breakline) = segments.iter().position(|[a, b]| a == b) {
        return Err(Error::CrossingBreaklines { breakline });
    }
    let mut crossing = None;
    let triangulation: ConstrainedDelaunayTriangulation<Site> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(sites, segments.clone(), |ends| {
            crossing = segments
                .iter()
                .position(|s| *s == ends || *s == [ends[1], ends[0]])
                .or(Some(0));
        })
        .map_err(|_| Error::Untriangulable { point: 0 })?;
    if let Some(breakline) = crossing {
        return Err(Error::CrossingBreaklines { breakline });
    }
    let faces: Vec<[u32; 3]> = triangulation
        .inner_faces()
        .map(|face| face.vertices().map(|v| v.data().number))
        .filter(|face| {
            check::degenerate_ratio(face.map(|v| points[v as usize].extend(0.0))).is_none()
        })
        .collect();
    if faces.is_empty() {
        Err(Error::EmptyMesh)
    } else {
        Ok(faces)
    }
}

/// The points without repetition, and the site of each point.
fn distinct_sites(points: &[DVec2]) -> Result<(Vec<Site>, Vec<usize>), Error> {
    let mut sites: Vec<Site> = Vec::with_capacity(points.len());
    let mut first_at = HashMap::new();
    let mut site_of = Vec::with_capacity(points.len());
    for (number, p) in points.iter().enumerate() {
        let position = spade::mitigate_underflow(Point2::new(p.x, p.y));
        if [position.x, position.y]
            .iter()
            .any(|&x| spade::validate_coordinate(x).is_err())
        {
            return Err(Error::Untriangulable { point: number });
        }
        // Adding 0 makes the two zeros one.
        let key = [position.x + 0.0, position.y + 0.0].map(f64::to_bits);
        let site = *first_at.entry(key).or_insert(sites.len());
        if site == sites.len() {
            sites.push(Site {
                position,
                number: number as u32,
            });
        }
        site_of.push(site);
    }
    Ok((sites, site_of))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of points with a breakline along a diagonal that Delaunay leaves open.
    #[test]
    fn breaklines_are_edges() {
        let points: Vec<DVec3> = (0..25)
            .map(|i| DVec3::new(f64::from(i % 5), f64::from(i / 5), f64::from(i * 7 % 5)))
            .collect();
        let mesh = Mesh::terrain(&points, &[[0, 8], [8, 22]]).unwrap();
        assert_eq!(mesh.face_count(), 32);
        assert!(mesh.halfedge(0, 8).or(mesh.halfedge(8, 0)).is_some());
        assert!(mesh.halfedge(22, 8).or(mesh.halfedge(8, 22)).is_some());
        assert_eq!(mesh.euler_characteristic(), 1);
    }

    #[test]
    fn hostile_points_are_refused() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let crossing = triangulate_domain(&square, &[[0, 2], [1, 3]]);
        assert!(
            matches!(crossing, Err(Error::CrossingBreaklines { .. })),
            "{crossing:?}"
        );
        assert_eq!(
            triangulate_domain(&square, &[[1, 1]]),
            Err(Error::CrossingBreaklines { breakline: 0 })
        );
        assert_eq!(
            triangulate_domain(&square, &[[0, 4]]),
            Err(Error::NoSuchVertex {
                vertex: 4,
                vertices: 4
            })
        );
        assert_eq!(
            triangulate_domain(&[DVec2::NAN], &[]),
            Err(Error::NonFiniteVertex { vertex: 0 })
        );
        assert_eq!(
            triangulate_domain(&[DVec2::ZERO; 5], &[]),
            Err(Error::EmptyMesh)
        );
        assert_eq!(triangulate_domain(&[], &[]), Err(Error::EmptyMesh));
        let line: Vec<DVec2> = (0..9).map(|i| DVec2::splat(f64::from(i))).collect();
        assert_eq!(triangulate_domain(&line, &[]), Err(Error::EmptyMesh));
        let huge = triangulate_domain(&[DVec2::ZERO, DVec2::X, DVec2::new(0.0, 1e300)], &[]);
        assert_eq!(huge, Err(Error::Untriangulable { point: 2 }));
    }

    #[test]
    fn a_repeated_point_stays_without_faces() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::Y];
        let mesh = Mesh::terrain(&points, &[]).unwrap();
        assert_eq!(mesh.face_count(), 1);
        assert_eq!(mesh.outgoing(2), None);
    }
}
