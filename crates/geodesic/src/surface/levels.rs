//! A Bézier patch as a sequence of polyhedra, and a path that is carried from each to the next.

use bezier_mass::{BezierPatch, MassPoint, bernstein};
use glam::{DVec2, DVec3};

use crate::exact::join_around_vertices;
use crate::mesh::{Mesh, face_of, next};
use crate::{Error, PathFinder, SurfacePoint};

/// The control nets of a polynomial or rational Bézier patch after 0, 1, 2, ... midpoint subdivisions, as meshes: they
/// converge to the surface with the square of their step.
///
/// Vertex `(i, j)` of a net belongs to the parameters `(i / columns, j / rows)`; each cell is cut by the diagonal from
/// `(i, j)` to `(i + 1, j + 1)`.
#[derive(Clone, Debug)]
pub struct PatchLevels {
    degrees: [usize; 2],
    /// Rows along v of the current net, for each index along u.
    net: Vec<Vec<MassPoint<DVec3>>>,
}

/// The shortest path on the net of one level, within the faces that the path of the level before suggested.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LevelPath {
    /// Its length.
    pub length: f64,
    /// The number of faces of the net.
    pub faces: usize,
    /// The path in space, and in the parameter plane.
    pub positions: Vec<DVec3>,
    /// Its points in the parameter plane.
    pub parameters: Vec<DVec2>,
}

/// Parameters this close to a grid line, in cells, lie on it: the carried points are good to rounding.
const ON_LINE: f64 = 1e-9;
/// A net never has more faces than this.
const MOST_FACES: usize = 1 << 24;

impl PatchLevels {
    /// The patch's own net, level 0.
    #[must_use]
    pub fn new(patch: &BezierPatch<DVec3>) -> Self {
        Self {
            degrees: patch.degrees(),
            net: patch.rows().map(<[_]>::to_vec).collect(),
        }
    }

    /// Shortest paths between two parameter points on the nets of level 0 to `levels`.
    ///
    /// The error falls with the square of the step, by a factor 4 a level, once the path's way is found; a third of the last
    /// change estimates it.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideDomain`] for an end outside `[0, 1]²`; the errors of [`Mesh::new`] for a net with a collapsed edge;
    /// [`Error::TooLarge`] for a net beyond 16 million faces.
    pub fn paths(mut self, from: DVec2, to: DVec2, levels: usize) -> Result<Vec<LevelPath>, Error> {
        for point in [from, to] {
            let inside = point.cmpge(DVec2::ZERO).all() && point.cmple(DVec2::ONE).all();
            if !inside {
                return Err(Error::OutsideDomain {
                    u: point.x,
                    v: point.y,
                });
            }
        }
        let mut way = vec![from, to];
        let mut paths = Vec::with_capacity(levels + 1);
        for level in 0..=levels {
            if level > 0 {
                self.subdivide()?;
            }
            let path = self.path_along(&way, from, to)?;
            way.clone_from(&path.parameters);
            paths.push(path);
        }
        Ok(paths)
    }

    /// The path on the first level whose estimated error is below the tolerance, with that estimate.
    ///
    /// # Errors
    ///
    /// As for [`PatchLevels::paths`]; [`Error::TooLarge`] if the tolerance asks for more faces than there may be.
    pub fn path_within(
        mut self,
        from: DVec2,
        to: DVec2,
        tolerance: f64,
    ) -> Result<(LevelPath, f64), Error> {
        let mut last = self.clone().paths(from, to, 0)?.remove(0);
        loop {
            self.subdivide()?;
            let way = last.parameters.clone();
            let path = self.path_along(&way, from, to)?;
            let estimate = (path.length - last.length).abs() / 3.0;
            if estimate <= tolerance {
                return Ok((path, estimate));
            }
            last = path;
        }
    }

    /// One midpoint subdivision in both directions.
    fn subdivide(&mut self) -> Result<(), Error> {
        let faces = 8 * (self.net.len() - 1) * (self.net.first().map_or(1, Vec::len) - 1);
        if faces > MOST_FACES {
            return Err(Error::TooLarge { faces });
        }
        let [along_u, along_v] = self.degrees;
        let rows: Vec<Vec<MassPoint<DVec3>>> =
            self.net.iter().map(|row| halved(row, along_v)).collect();
        let columns: Vec<Vec<MassPoint<DVec3>>> = transposed(&rows)
            .iter()
            .map(|column| halved(column, along_u))
            .collect();
        self.net = transposed(&columns);
        Ok(())
    }

    fn path_along(&self, way: &[DVec2], from: DVec2, to: DVec2) -> Result<LevelPath, Error> {
        let (columns, rows) = (self.net.len() - 1, self.net.first().map_or(1, Vec::len) - 1);
        let grid = Grid { columns, rows };
        let mesh = self.mesh(&grid)?;
        let scale = DVec2::new(columns as f64, rows as f64);
        let scaled: Vec<DVec2> = way.iter().map(|point| *point * scale).collect();
        let faces = grid.faces_met(&scaled);
        let ends = [from * scale, to * scale].map(|point| grid.point(point));
        let [start, end] = ends;
        let mut finder = PathFinder::new(&mesh).with_neighbouring_classes(false);
        let joined = join_around_vertices(&mesh, &faces);
        let path = finder.along(&joined, mesh.canonical(start)?, mesh.canonical(end)?)?;
        Ok(LevelPath {
            length: path.length(),
            faces: mesh.face_count(),
            positions: path.positions().to_vec(),
            parameters: path
                .points()
                .iter()
                .map(|point| grid.parameter(&mesh, *point) / scale)
                .collect(),
        })
    }

    fn mesh(&self, grid: &Grid) -> Result<Mesh, Error> {
        let mut positions = Vec::with_capacity((grid.columns + 1) * (grid.rows + 1));
        for (i, row) in self.net.iter().enumerate() {
            for (j, mass) in row.iter().enumerate() {
                let vertex = (i * (grid.rows + 1) + j) as u32;
                positions.push(mass.position().ok_or(Error::NonFiniteVertex { vertex })?);
            }
        }
        Mesh::new(&positions, &grid.triangles())
    }
}

/// The cells of a net and their two triangles.
struct Grid {
    columns: usize,
    rows: usize,
}

impl Grid {
    fn vertex(&self, i: usize, j: usize) -> u32 {
        (i * (self.rows + 1) + j) as u32
    }

    /// Cell by cell the triangle below the diagonal (of larger u), then the one above.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let cells = (0..self.columns).flat_map(|i| (0..self.rows).map(move |j| (i, j)));
        cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    .map(|(i, j)| self.vertex(i, j));
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    /// The face at a point in cells: of larger index on a grid line, of larger u on a diagonal. With the corner of its cell.
    fn locate(&self, point: DVec2) -> (u32, DVec2) {
        let snapped = |x: f64| {
            if (x - x.round()).abs() < ON_LINE {
                x.round()
            } else {
                x
            }
        };
        let (x, y) = (snapped(point.x), snapped(point.y));
        let i = (x.max(0.0) as usize).min(self.columns - 1);
        let j = (y.max(0.0) as usize).min(self.rows - 1);
        let (s, t) = (x - i as f64, y - j as f64);
        let above = t - s > ON_LINE;
        (
            (2 * (i * self.rows + j) + usize::from(above)) as u32,
            DVec2::new(i as f64, j as f64),
        )
    }

    fn point(&self, point: DVec2) -> SurfacePoint {
        let (face, corner) = self.locate(point);
        let local = (point - corner).clamp(DVec2::ZERO, DVec2::ONE);
        let barycentric = if face % 2 == 0 {
            let t = local.y.min(local.x);
            [1.0 - local.x, local.x - t, t]
        } else {
            let s = local.x.min(local.y);
            [1.0 - local.y, s, local.y - s]
        };
        SurfacePoint::Face { face, barycentric }
    }

    /// The parameter point, in cells, of a point of the mesh.
    fn parameter(&self, mesh: &Mesh, point: SurfacePoint) -> DVec2 {
        let of = |v: u32| {
            DVec2::new(
                (v as usize / (self.rows + 1)) as f64,
                (v as usize % (self.rows + 1)) as f64,
            )
        };
        match point {
            SurfacePoint::Vertex(v) => of(v),
            SurfacePoint::Edge { halfedge, t } => {
                of(mesh.origin(halfedge)).lerp(of(mesh.origin(next(halfedge))), t)
            }
            SurfacePoint::Face { face, barycentric } => {
                let corners = mesh.faces()[face as usize].map(of);
                debug_assert_eq!(face_of(3 * face), face);
                (0..3).map(|k| barycentric[k] * corners[k]).sum()
            }
        }
    }

    /// The faces that a polyline passes, in order: a face for each stretch between two crossings of grid lines or diagonals.
    fn faces_met(&self, way: &[DVec2]) -> Vec<u32> {
        let mut faces: Vec<u32> = Vec::new();
        for ends in way.windows(2) {
            let (a, b) = (ends[0], ends[1]);
            let mut cuts = vec![0.0, 1.0];
            // Families of lines: x = k, y = k, x - y = k.
            for (from, to) in [(a.x, b.x), (a.y, b.y), (a.x - a.y, b.x - b.y)] {
                let (low, high) = (from.min(to), from.max(to));
                if high - low < ON_LINE {
                    continue;
                }
                let mut line = low.ceil();
                while line <= high {
                    cuts.push((line - from) / (to - from));
                    line += 1.0;
                }
            }
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.windows(2) {
                if pair[1] - pair[0] > ON_LINE {
                    let (face, _) = self.locate(a.lerp(b, 0.5 * (pair[0] + pair[1])));
                    if faces.last() != Some(&face) {
                        faces.push(face);
                    }
                }
            }
        }
        if faces.is_empty() {
            faces.extend(way.first().map(|&point| self.locate(point).0));
        }
        faces
    }
}

/// Every segment of a chain of Bézier segments cut at its middle.
fn halved(chain: &[MassPoint<DVec3>], degree: usize) -> Vec<MassPoint<DVec3>> {
    let mut finer: Vec<MassPoint<DVec3>> = Vec::with_capacity(2 * chain.len());
    for start in (0..chain.len() - 1).step_by(degree) {
        let (left, right) = bernstein::subdivide(&chain[start..=start + degree], 0.5);
        finer.pop();
        finer.extend(left);
        finer.pop();
        finer.extend(right);
    }
    finer
}

fn transposed(rows: &[Vec<MassPoint<DVec3>>]) -> Vec<Vec<MassPoint<DVec3>>> {
    let width = rows.first().map_or(0, Vec::len);
    (0..width)
        .map(|j| rows.iter().map(|row| row[j]).collect())
        .collect()
}
