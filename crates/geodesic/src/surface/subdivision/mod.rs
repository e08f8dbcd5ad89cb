//! Subdivision surfaces of any topology, and paths on them: carried from polyhedron to polyhedron by the local scheme
//! (Section 2.4 of the thesis, which left it to be done).
//!
//! Each triangle of a polyhedron is tiled by triangles of the next one; a point or a path is carried over by keeping its
//! place.

use glam::DVec3;

use super::carry::sequence;
use super::convergence::{Convergence, check_tolerance};
use super::polyhedron::Polyhedron;
use super::tiles::Piece;
use crate::mesh::Mesh;
use crate::{Error, GeodesicPath, PathFinder, SurfacePoint};

/// A polyhedron never has more triangles than this: about a gigabyte with the buffers of a query.
const MOST_FACES: usize = 1 << 22;

/// How a surface is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Scheme {
    /// Loop's scheme, on triangles: every triangle is cut in four.
    Loop,
    /// Catmull and Clark's scheme, on polygons: every polygon is cut in quadrilaterals, one at each corner.
    CatmullClark,
}

/// A subdivision surface, at one level of refinement: a polyhedron that the scheme refines to a smooth surface.
///
/// The surface has continuous curvature but at extraordinary vertices, where it has a tangent plane. Boundaries become
/// cubic B-spline curves, with their corners rounded off. Quadrilaterals are cut by a diagonal, polygons with another number
/// of corners by triangles about their centre.
///
/// ```
/// use geodesic::{SubdivisionSurface, shapes};
/// // A cube becomes a rounded ball.
/// let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
/// let ball = SubdivisionSurface::catmull_clark(shapes::cube()?.positions(), &quads)?
///     .with_vertices_on_limit(true)?;
/// let (path, convergence) = ball.path_within(0.into(), 7.into(), 1e-3)?;
/// assert!(convergence.error() <= 1e-3 && (path.length() - 1.3458).abs() < 2e-3);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SubdivisionSurface {
    scheme: Scheme,
    on_limit: bool,
    polyhedron: Polyhedron,
    mesh: Mesh,
    /// How the next polyhedron tiles each triangle of the mesh.
    pieces: Vec<Piece>,
}

impl SubdivisionSurface {
    /// Loop's surface of a triangle mesh.
    ///
    /// # Errors
    ///
    /// None for a valid mesh but [`Error::TooLarge`].
    pub fn loop_scheme(mesh: &Mesh) -> Result<Self, Error> {
        let polyhedron = Polyhedron::new(mesh.positions(), mesh.faces())?;
        Self::at_level(Scheme::Loop, polyhedron, false)
    }

    /// Catmull and Clark's surface of polygons.
    ///
    /// # Errors
    ///
    /// [`Error::NotATriangle`] for fewer than three corners; [`Error::IndexOutOfRange`]; [`Error::RepeatedVertex`]; those of
    /// [`Mesh::new`] for the triangles that the polygons are cut into.
    pub fn catmull_clark<F: AsRef<[u32]>>(
        positions: &[DVec3],
        polygons: &[F],
    ) -> Result<Self, Error> {
        Self::at_level(
            Scheme::CatmullClark,
            Polyhedron::new(positions, polygons)?,
            false,
        )
    }

    /// Whether the vertices of the meshes lie at their limit positions, on the surface, rather than where the scheme has them
    /// so far (as Section 2.2 of the thesis has it, and the default).
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::new`], if limit positions coincide.
    pub fn with_vertices_on_limit(self, on_limit: bool) -> Result<Self, Error> {
        Self::at_level(self.scheme, self.polyhedron, on_limit)
    }

    fn at_level(scheme: Scheme, polyhedron: Polyhedron, on_limit: bool) -> Result<Self, Error> {
        let mut pieces = Vec::new();
        let (mut faces, mut centres) = (Vec::new(), Vec::new());
        let quadrilaterals = scheme == Scheme::Loop || polyhedron.is_of_quadrilaterals();
        if !(on_limit || quadrilaterals) {
            centres = polyhedron.centres();
        }
        for (f, polygon) in polyhedron.polygons().enumerate() {
            let corner = |k: usize| (polygon.start + k % polygon.len()) as u32;
            let centre = (polyhedron.positions.len() + f) as u32;
            match (scheme, polygon.len()) {
                (Scheme::Loop, _) => pieces.push(Piece::Triangle(f as u32)),
                (Scheme::CatmullClark, 4) => pieces.extend([
                    Piece::FirstHalf([corner(0), corner(1), corner(2)]),
                    Piece::SecondHalf([corner(0), corner(2), corner(3)]),
                ]),
                (Scheme::CatmullClark, count) => {
                    pieces.extend((0..count).map(|k| Piece::Fan([corner(k), corner(k + 1)])));
                }
            }
            let vertex = |corner: u32| polyhedron.corners[corner as usize];
            faces.extend(pieces[faces.len()..].iter().map(|piece| match *piece {
                Piece::Triangle(f) => [0, 1, 2].map(|k| vertex(3 * f + k)),
                Piece::Fan([a, b]) => [vertex(a), vertex(b), centre],
                Piece::FirstHalf(corners) | Piece::SecondHalf(corners) => corners.map(vertex),
            }));
        }
        let mut positions = match (on_limit, scheme) {
            (false, _) => polyhedron.positions.clone(),
            (true, Scheme::Loop) => polyhedron.limit_by_loop(),
            (true, Scheme::CatmullClark) => polyhedron.limit_by_catmull_clark(),
        };
        positions.extend(centres);
        if quadrilaterals {
            positions.truncate(polyhedron.positions.len());
        }
        let mesh = Mesh::new(&positions, &faces)?;
        Ok(Self {
            scheme,
            on_limit,
            polyhedron,
            mesh,
            pieces,
        })
    }

    /// The scheme.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// The polyhedron as a triangle mesh. Its first vertices are those of the polyhedron of the level before, in their order.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The next level.
    ///
    /// # Errors
    ///
    /// [`Error::TooLarge`] beyond 4 million triangles; those of [`Mesh::new`] if vertices come to coincide.
    pub fn refined(&self) -> Result<Self, Error> {
        let (faces, polyhedron) = match self.scheme {
            Scheme::Loop => (
                4 * self.mesh.face_count(),
                Polyhedron::refined_by_loop as fn(&_) -> _,
            ),
            Scheme::CatmullClark => (
                2 * self.polyhedron.corners.len(),
                Polyhedron::refined_by_catmull_clark as fn(&_) -> _,
            ),
        };
        if faces > MOST_FACES {
            return Err(Error::TooLarge { faces });
        }
        Self::at_level(self.scheme, polyhedron(&self.polyhedron), self.on_limit)
    }

    /// The point of the next level's mesh that belongs to a point of this one's.
    ///
    /// # Errors
    ///
    /// An error about the point, see [`Mesh::canonical`].
    pub fn carry(&self, point: SurfacePoint) -> Result<SurfacePoint, Error> {
        let point = self.mesh.canonical(point)?;
        let face = self.mesh.faces_of(point).next();
        let found = face.and_then(|f| Some((f, self.mesh.barycentric_in(f, point)?)));
        let (face, weights) = found.ok_or(Error::SequenceMissesPoint { point })?;
        let (tile, local) = self.pieces[face as usize].tile_at(weights);
        // Without the bound that the next mesh would give: snapped to its corners by whoever uses it.
        Ok(SurfacePoint::Face {
            face: tile,
            barycentric: local,
        })
    }

    /// The faces of the next level's mesh that a path on this one's passes.
    ///
    /// # Errors
    ///
    /// [`Error::SequenceMissesPoint`] if the path is not one of this level's.
    pub fn carry_path(&self, path: &GeodesicPath) -> Result<Vec<u32>, Error> {
        let mut carried: Vec<u32> = Vec::new();
        for (ends, &face) in path.points().windows(2).zip(path.faces()) {
            let piece = self.pieces.get(face as usize);
            let weights = |point: SurfacePoint| {
                piece
                    .and_then(|_| self.mesh.barycentric_in(face, point))
                    .ok_or(Error::SequenceMissesPoint { point })
            };
            let (from, to) = (weights(ends[0])?, weights(ends[1])?);
            for tile in piece
                .into_iter()
                .flat_map(|piece| piece.tiles_met(from, to))
            {
                if carried.last() != Some(&tile) {
                    carried.push(tile);
                }
            }
        }
        Ok(carried)
    }

    /// Locally shortest paths between two points of this level's mesh on it and on the next `levels` ones.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::shortest`] and [`SubdivisionSurface::refined`].
    pub fn paths(
        &self,
        from: SurfacePoint,
        to: SurfacePoint,
        levels: usize,
    ) -> Result<Vec<GeodesicPath>, Error> {
        let mut carried = Carried::start(self, from, to)?;
        let mut paths = vec![carried.path.clone()];
        for _ in 0..levels {
            carried = carried.next()?;
            paths.push(carried.path.clone());
        }
        Ok(paths)
    }

    /// The path between two points of this level's mesh on the first level where its estimated error,
    /// [`Convergence::error`], is below the tolerance.
    ///
    /// # Errors
    ///
    /// As for [`SubdivisionSurface::paths`]; [`Error::InvalidTolerance`]; [`Error::TooLarge`] if the
    /// tolerance asks for more faces than there may be.
    pub fn path_within(
        &self,
        from: SurfacePoint,
        to: SurfacePoint,
        tolerance: f64,
    ) -> Result<(GeodesicPath, Convergence), Error> {
        check_tolerance(tolerance)?;
        let mut carried = Carried::start(self, from, to)?;
        let mut convergence = Convergence {
            lengths: vec![carried.path.length()],
        };
        while convergence.error() > tolerance {
            carried = carried.next()?;
            convergence.lengths.push(carried.path.length());
        }
        Ok((carried.path, convergence))
    }
}

/// A path on one level, with its ends.
struct Carried {
    surface: SubdivisionSurface,
    ends: [SurfacePoint; 2],
    path: GeodesicPath,
}

impl Carried {
    fn start(
        surface: &SubdivisionSurface,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<Self, Error> {
        Ok(Self {
            ends: [from, to],
            path: PathFinder::new(&surface.mesh).shortest(from, to)?.clone(),
            surface: surface.clone(),
        })
    }

    /// The path of the next level, in the class that this one suggests.
    fn next(self) -> Result<Self, Error> {
        let finer = self.surface.refined()?;
        let carried = |end| finer.mesh.canonical(self.surface.carry(end)?);
        let [from, to] = [carried(self.ends[0])?, carried(self.ends[1])?];
        let faces = sequence(&finer.mesh, self.surface.carry_path(&self.path)?, from, to);
        let path = PathFinder::new(&finer.mesh)
            .along(&faces, from, to)?
            .clone();
        Ok(Self {
            ends: [from, to],
            surface: finer,
            path,
        })
    }
}

#[cfg(test)]
mod tests;
