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
            let weights = |point: SurfacePoint| {
                let known = (face as usize) < self.pieces.len();
                known
                    .then(|| self.mesh.barycentric_in(face, point))
                    .flatten()
                    .ok_or(Error::SequenceMissesPoint { point })
            };
            for tile in self.pieces[face as usize].tiles_met(weights(ends[0])?, weights(ends[1])?) {
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
mod tests {
    use super::*;
    use crate::{PatchLevels, geodesic_between, shapes};
    use bezier_mass::{BSplineSurface, Knots};
    use glam::DVec2;
    use std::f64::consts::TAU;

    const AROUND: usize = 8;
    const TUBE: usize = 6;

    fn control(i: usize, j: usize) -> DVec3 {
        let (u, v) = (TAU * i as f64 / AROUND as f64, TAU * j as f64 / TUBE as f64);
        let rho = 2.0 + (0.8 + 0.2 * u.cos()) * v.cos();
        DVec3::new(rho * u.cos(), rho * u.sin(), 0.9 * v.sin())
    }

    /// A net of quadrilaterals that closes in both directions, without extraordinary vertices.
    fn ring() -> SubdivisionSurface {
        let positions: Vec<DVec3> = (0..AROUND * TUBE)
            .map(|k| control(k / TUBE, k % TUBE))
            .collect();
        let vertex = |i: usize, j: usize| (i % AROUND * TUBE + j % TUBE) as u32;
        let quads: Vec<[u32; 4]> = (0..AROUND * TUBE)
            .map(|k| (k / TUBE, k % TUBE))
            .map(|(i, j)| {
                [
                    vertex(i, j),
                    vertex(i + 1, j),
                    vertex(i + 1, j + 1),
                    vertex(i, j + 1),
                ]
            })
            .collect();
        SubdivisionSurface::catmull_clark(&positions, &quads).unwrap()
    }

    /// The same surface as a bicubic spline: control point `k` belongs to the parameter `k - 1`.
    fn spline() -> BSplineSurface<DVec3> {
        let knots = |n: usize| {
            let breakpoints: Vec<f64> = (0..=n).map(|k| k as f64).collect();
            Knots::periodic(3, &breakpoints).unwrap()
        };
        let points: Vec<DVec3> = (0..AROUND * TUBE)
            .map(|k| control(k / TUBE, k % TUBE))
            .collect();
        BSplineSurface::polynomial([knots(AROUND), knots(TUBE)], &points).unwrap()
    }

    fn parameters(i: usize, j: usize) -> DVec2 {
        DVec2::new(i as f64 - 1.0, j as f64 - 1.0)
    }

    #[test]
    fn catmull_and_clark_generalise_bicubic_splines() {
        let (surface, spline) = (ring().with_vertices_on_limit(true).unwrap(), spline());
        for i in 0..AROUND {
            for j in 0..TUBE {
                let vertex = surface.mesh().positions()[i * TUBE + j];
                let uv = parameters(i, j);
                assert!(vertex.distance(spline.point(uv.x, uv.y).unwrap()) < 1e-14);
            }
        }
        // A level up, the first vertices stay on the limit.
        let finer = surface.refined().unwrap();
        for (a, b) in surface
            .mesh()
            .positions()
            .iter()
            .zip(finer.mesh().positions())
        {
            assert!(a.distance(*b) < 1e-14);
        }
    }

    /// Paths on both kinds of polyhedra tend to the geodesic of the spline, with order 2.
    #[test]
    fn paths_on_catmull_clark_surfaces_converge_to_the_smooth_geodesic() {
        let spline = spline();
        let ([i, j], [k, l]) = ([1, 2], [3, 4]);
        let (from, to) = ((i * TUBE + j) as u32, (k * TUBE + l) as u32);
        let levels = PatchLevels::of_spline(&spline);
        let guide = levels.paths(parameters(i, j), parameters(k, l), 4).unwrap();
        let smooth = geodesic_between(&spline, &guide[4].parameters, 1e-10).unwrap();
        assert_eq!(smooth.conjugate_points, 0);
        for on_limit in [false, true] {
            let surface = ring().with_vertices_on_limit(on_limit).unwrap();
            let paths = surface.paths(from.into(), to.into(), 5).unwrap();
            let errors: Vec<f64> = paths
                .iter()
                .map(|p| (p.length() - smooth.length).abs())
                .collect();
            let order = (errors[3] / errors[5]).log2() / 2.0;
            assert!((order - 2.0).abs() < 0.2, "{on_limit} {errors:?}");
            assert!(errors[5] < 2e-3 * smooth.length, "{errors:?}");
        }
    }

    /// Loop's surface of a stretched icosahedron, with its twelve vertices of valence 5.
    #[test]
    fn paths_on_loop_surfaces_converge() {
        let mut positions = shapes::sphere(0).unwrap().positions().to_vec();
        positions
            .iter_mut()
            .for_each(|p| *p *= DVec3::new(1.0, 0.8, 1.4));
        let mesh = Mesh::new(&positions, shapes::sphere(0).unwrap().faces()).unwrap();
        let from = SurfacePoint::Face {
            face: 0,
            barycentric: [0.5, 0.3, 0.2],
        };
        let to = SurfacePoint::Face {
            face: 13,
            barycentric: [0.2, 0.45, 0.35],
        };
        let mut limits = Vec::new();
        for on_limit in [false, true] {
            let surface = SubdivisionSurface::loop_scheme(&mesh).unwrap();
            let surface = surface.with_vertices_on_limit(on_limit).unwrap();
            let paths = surface.paths(from, to, 6).unwrap();
            let lengths: Vec<f64> = paths.iter().map(GeodesicPath::length).collect();
            let convergence = Convergence { lengths };
            let order = convergence.order().unwrap();
            assert!((1.6..2.4).contains(&order), "{order} {convergence:?}");
            limits.push(convergence.limit().unwrap());
            assert!(convergence.error() < 1e-3);
        }
        assert!((limits[0] - limits[1]).abs() < 2e-4, "{limits:?}");
    }

    /// The limit position is where refining again and again takes a vertex.
    #[test]
    fn limit_positions_are_limits() {
        let pyramid = [
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(1.0, 1.0, 0.3),
            DVec3::Y,
            DVec3::new(0.4, 0.5, 1.0),
        ];
        let polygons: [&[u32]; 5] = [
            &[3, 2, 1, 0],
            &[0, 1, 4],
            &[1, 2, 4],
            &[2, 3, 4],
            &[3, 0, 4],
        ];
        let open = &polygons[1..];
        let sheet = Mesh::new(&pyramid, open).unwrap();
        for surface in [
            SubdivisionSurface::catmull_clark(&pyramid, &polygons).unwrap(),
            SubdivisionSurface::catmull_clark(&pyramid, open).unwrap(),
            SubdivisionSurface::loop_scheme(&shapes::cube().unwrap()).unwrap(),
            SubdivisionSurface::loop_scheme(&sheet).unwrap(),
        ] {
            let limit = surface.clone().with_vertices_on_limit(true).unwrap();
            let mut fine = surface;
            for _ in 0..6 {
                fine = fine.refined().unwrap();
            }
            // The distance falls by four a level at the least.
            for (a, b) in limit
                .mesh()
                .positions()
                .iter()
                .zip(fine.mesh().positions())
                .take(5)
            {
                assert!(a.distance(*b) < 5e-4, "{:?}: {a} {b}", fine.scheme());
            }
        }
    }

    /// The map from a polyhedron to the next is continuous: neighbours agree on their common edge.
    #[test]
    fn carried_points_agree_across_edges() {
        let polygons: [&[u32]; 4] = [&[0, 1, 2, 3, 4], &[1, 0, 5, 6], &[2, 1, 6], &[4, 3, 7, 8]];
        let positions: Vec<DVec3> = (0..9)
            .map(|k| TAU * f64::from(k) / 9.0)
            .map(|t| DVec3::new(t.cos(), 1.3 * t.sin(), (2.0 * t).sin()))
            .collect();
        let general = SubdivisionSurface::catmull_clark(&positions, &polygons).unwrap();
        let general_finer = general.refined().unwrap();
        let triangles = SubdivisionSurface::loop_scheme(&shapes::cube().unwrap()).unwrap();
        for surface in [general, general_finer, ring(), triangles] {
            let finer = surface.refined().unwrap();
            let mesh = surface.mesh();
            for h in 0..mesh.halfedge_count() as u32 {
                let Some(twin) = mesh.twin(h) else { continue };
                for t in [0.0, 0.2, 0.5, 0.83] {
                    let place = |h: u32, t: f64| {
                        let mut barycentric = [0.0; 3];
                        barycentric[(h % 3) as usize] = 1.0 - t;
                        barycentric[((h + 1) % 3) as usize] = t;
                        let (face, barycentric) =
                            surface.pieces[(h / 3) as usize].tile_at(barycentric);
                        let point = SurfacePoint::Face { face, barycentric };
                        finer.mesh().point_position(point).unwrap()
                    };
                    // Half-edge 3 f + k begins at corner k; the coordinates are those of its face.
                    assert!(place(h, t).distance(place(twin, 1.0 - t)) < 1e-14);
                }
            }
        }
    }

    #[test]
    fn hostile_polygons_are_refused() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let cc = |polygons: &[&[u32]]| SubdivisionSurface::catmull_clark(&corners, polygons).err();
        assert!(matches!(cc(&[]), Some(Error::EmptyMesh)));
        assert!(matches!(
            cc(&[&[0, 1]]),
            Some(Error::NotATriangle { corners: 2, .. })
        ));
        assert!(matches!(
            cc(&[&[0, 1, 9]]),
            Some(Error::IndexOutOfRange { vertex: 9, .. })
        ));
        assert!(matches!(
            cc(&[&[0, 1, 0, 2]]),
            Some(Error::RepeatedVertex { vertex: 0, .. })
        ));
        let same_way = cc(&[&[0, 1, 2], &[0, 1, 3]]);
        assert!(matches!(
            same_way,
            Some(Error::InconsistentOrientation { .. })
        ));
        let ball = SubdivisionSurface::loop_scheme(&shapes::sphere(0).unwrap()).unwrap();
        assert!(ball.paths(0.into(), 99.into(), 1).is_err());
    }
}
