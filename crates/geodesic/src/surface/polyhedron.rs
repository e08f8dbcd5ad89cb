//! Polyhedra with polygonal faces, and one step of Loop's and of Catmull and Clark's subdivision.
//!
//! The rules: C. Loop, *Smooth subdivision surfaces based on triangles*, 1987; E. Catmull, J. Clark, *Recursively generated
//! B-spline surfaces on arbitrary topological meshes*, CAD 10, 1978. Limit positions of Catmull and Clark's scheme: M.
//! Halstead, M. Kass, T. DeRose, *Efficient, fair interpolation using Catmull-Clark surfaces*, SIGGRAPH 1993. Boundaries
//! are cubic B-spline curves in both.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::Error;

/// Positions and polygons, with their edges numbered.
#[derive(Clone, Debug)]
pub(super) struct Polyhedron {
    pub(super) positions: Vec<DVec3>,
    /// The corners of all polygons, one polygon after the other.
    pub(super) corners: Vec<u32>,
    /// Where the corners of each polygon begin, and where those of the last one end.
    starts: Vec<u32>,
    /// The edge from each corner to the next one of its polygon.
    edge_of_corner: Vec<u32>,
    edges: Vec<Edge>,
}

#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [u32; 2],
    faces: u32,
}

/// What lies around a vertex, summed.
#[derive(Clone, Copy, Debug, Default)]
struct Ring {
    /// Neighbours along edges, and those along boundary edges.
    neighbours: DVec3,
    count: f64,
    boundary: DVec3,
    boundary_count: u32,
}

impl Polyhedron {
    pub(super) fn new<F: AsRef<[u32]>>(positions: &[DVec3], faces: &[F]) -> Result<Self, Error> {
        let (mut corners, mut starts) = (Vec::new(), vec![0]);
        for (face, polygon) in faces.iter().enumerate() {
            let (face, polygon) = (face as u32, polygon.as_ref());
            if polygon.len() < 3 {
                return Err(Error::NotATriangle {
                    face,
                    corners: polygon.len(),
                });
            }
            for (i, &vertex) in polygon.iter().enumerate() {
                if vertex as usize >= positions.len() {
                    return Err(Error::IndexOutOfRange {
                        face,
                        vertex,
                        vertices: positions.len(),
                    });
                }
                if polygon[..i].contains(&vertex) {
                    return Err(Error::RepeatedVertex { face, vertex });
                }
            }
            corners.extend_from_slice(polygon);
            starts.push(corners.len() as u32);
        }
        Ok(Self::connected(positions.to_vec(), corners, starts))
    }

    fn connected(positions: Vec<DVec3>, corners: Vec<u32>, starts: Vec<u32>) -> Self {
        let mut edges: Vec<Edge> = Vec::with_capacity(corners.len() / 2 + 1);
        let mut numbers: HashMap<[u32; 2], u32> = HashMap::with_capacity(corners.len() / 2 + 1);
        let mut edge_of_corner = Vec::with_capacity(corners.len());
        for range in starts.windows(2) {
            let polygon = &corners[range[0] as usize..range[1] as usize];
            for (i, &a) in polygon.iter().enumerate() {
                let b = polygon[(i + 1) % polygon.len()];
                let ends = [a.min(b), a.max(b)];
                let number = *numbers.entry(ends).or_insert_with(|| {
                    edges.push(Edge { ends, faces: 0 });
                    edges.len() as u32 - 1
                });
                edges[number as usize].faces += 1;
                edge_of_corner.push(number);
            }
        }
        Self {
            positions,
            corners,
            starts,
            edge_of_corner,
            edges,
        }
    }

    /// The corners of each polygon, as a range of all corners.
    pub(super) fn polygons(&self) -> impl ExactSizeIterator<Item = std::ops::Range<usize>> + '_ {
        self.starts.windows(2).map(|s| s[0] as usize..s[1] as usize)
    }

    pub(super) fn is_of_quadrilaterals(&self) -> bool {
        self.polygons().all(|polygon| polygon.len() == 4)
    }

    /// The corner before one, in a polygon.
    fn before(corner: usize, polygon: &std::ops::Range<usize>) -> usize {
        if corner == polygon.start {
            polygon.end - 1
        } else {
            corner - 1
        }
    }

    /// The mean of the corners of each polygon.
    pub(super) fn centres(&self) -> Vec<DVec3> {
        self.polygons()
            .map(|polygon| {
                let count = polygon.len() as f64;
                let corners = &self.corners[polygon];
                corners
                    .iter()
                    .map(|&v| self.positions[v as usize])
                    .sum::<DVec3>()
                    / count
            })
            .collect()
    }

    fn rings(&self) -> Vec<Ring> {
        let mut rings = vec![Ring::default(); self.positions.len()];
        for edge in &self.edges {
            let [a, b] = edge.ends;
            for (here, there) in [(a, b), (b, a)] {
                let (ring, there) = (&mut rings[here as usize], self.positions[there as usize]);
                ring.neighbours += there;
                ring.count += 1.0;
                if edge.faces < 2 {
                    ring.boundary += there;
                    ring.boundary_count += 1;
                }
            }
        }
        rings
    }

    /// Every vertex by one rule inside and, on the boundary, by that of cubic B-splines with the given share of the two
    /// neighbours on the boundary.
    fn moved(&self, share: f64, inside: impl Fn(usize, DVec3, &Ring) -> DVec3) -> Vec<DVec3> {
        let rings = self.rings();
        let vertices = self.positions.iter().zip(&rings).enumerate();
        vertices
            .map(|(v, (&here, ring))| match ring.boundary_count {
                0 if ring.count > 0.0 => inside(v, here, ring),
                2 => (1.0 - share) * here + share / 2.0 * ring.boundary,
                _ => here,
            })
            .collect()
    }

    /// One step of Loop's scheme on triangles: the vertices in their order, then the edges in theirs. Triangle `f` becomes
    /// `4 f` to `4 f + 3`: at its corners, then in its middle.
    pub(super) fn refined_by_loop(&self) -> Self {
        let mut positions = self.moved(1.0 / 4.0, |_, here, ring| {
            let weight = loop_weight(ring.count);
            (1.0 - ring.count * weight) * here + weight * ring.neighbours
        });
        let mut opposite = vec![DVec3::ZERO; self.edges.len()];
        for polygon in self.polygons() {
            for corner in polygon.clone() {
                let third = self.corners[Self::before(corner, &polygon)];
                opposite[self.edge_of_corner[corner] as usize] += self.positions[third as usize];
            }
        }
        positions.extend(self.edges.iter().zip(opposite).map(|(edge, opposite)| {
            let sum: DVec3 = edge.ends.iter().map(|&v| self.positions[v as usize]).sum();
            if edge.faces < 2 {
                sum / 2.0
            } else {
                (3.0 * sum + opposite) / 8.0
            }
        }));
        let count = self.positions.len() as u32;
        let mut corners = Vec::with_capacity(4 * self.corners.len());
        for polygon in self.polygons() {
            let [ab, bc, ca] = [0, 1, 2].map(|k| count + self.edge_of_corner[polygon.start + k]);
            let [a, b, c] = [0, 1, 2].map(|k| self.corners[polygon.start + k]);
            corners.extend([a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca]);
        }
        let starts = (0..=corners.len() as u32 / 3).map(|f| 3 * f).collect();
        Self::connected(positions, corners, starts)
    }

    /// One step of Catmull and Clark's scheme: the vertices in their order, then the edges, then the polygons. Corner `c`
    /// becomes quadrilateral `c`: the vertex, the next edge, the polygon, the edge before.
    pub(super) fn refined_by_catmull_clark(&self) -> Self {
        let centres = self.centres();
        let mut faces_at = vec![DVec3::ZERO; self.positions.len()];
        let mut edge_points: Vec<DVec3> = self
            .edges
            .iter()
            .map(|edge| edge.ends.iter().map(|&v| self.positions[v as usize]).sum())
            .collect();
        for (polygon, &centre) in self.polygons().zip(&centres) {
            for corner in polygon {
                faces_at[self.corners[corner] as usize] += centre;
                let edge = self.edge_of_corner[corner] as usize;
                if self.edges[edge].faces > 1 {
                    edge_points[edge] += centre;
                }
            }
        }
        for (point, edge) in edge_points.iter_mut().zip(&self.edges) {
            *point /= if edge.faces > 1 { 4.0 } else { 2.0 };
        }
        // (Q + 2 R + (n - 3) S) / n, with the means Q of the faces and R of the edges' middles.
        let mut positions = self.moved(1.0 / 4.0, |v, here, ring| {
            let n = ring.count;
            let middles = (here + ring.neighbours / n) / 2.0;
            (faces_at[v] / n + 2.0 * middles + (n - 3.0) * here) / n
        });
        positions.extend(edge_points);
        positions.extend(centres);
        let edge_start = self.positions.len() as u32;
        let face_start = edge_start + self.edges.len() as u32;
        let mut corners = Vec::with_capacity(4 * self.corners.len());
        for (f, polygon) in self.polygons().enumerate() {
            for corner in polygon.clone() {
                let before = Self::before(corner, &polygon);
                corners.extend([
                    self.corners[corner],
                    edge_start + self.edge_of_corner[corner],
                    face_start + f as u32,
                    edge_start + self.edge_of_corner[before],
                ]);
            }
        }
        let starts = (0..=corners.len() as u32 / 4).map(|f| 4 * f).collect();
        Self::connected(positions, corners, starts)
    }

    /// Where Loop's scheme takes each vertex in the end.
    pub(super) fn limit_by_loop(&self) -> Vec<DVec3> {
        self.moved(1.0 / 3.0, |_, here, ring| {
            let share = 1.0 / (ring.count + 3.0 / (8.0 * loop_weight(ring.count)));
            (1.0 - ring.count * share) * here + share * ring.neighbours
        })
    }

    /// Where Catmull and Clark's scheme takes each vertex, and then each polygon's centre.
    pub(super) fn limit_by_catmull_clark(&self) -> Vec<DVec3> {
        let finer = self.refined_by_catmull_clark();
        let limit = finer.limit_of_quadrilaterals();
        let (vertices, edges) = (self.positions.len(), self.edges.len());
        [&limit[..vertices], &limit[vertices + edges..]].concat()
    }

    fn limit_of_quadrilaterals(&self) -> Vec<DVec3> {
        let mut diagonal = vec![DVec3::ZERO; self.positions.len()];
        for polygon in self.polygons() {
            for k in 0..4 {
                let [here, across] = [k, (k + 2) % 4].map(|k| self.corners[polygon.start + k]);
                diagonal[here as usize] += self.positions[across as usize];
            }
        }
        self.moved(1.0 / 3.0, |v, here, ring| {
            let n = ring.count;
            (n * n * here + 4.0 * ring.neighbours + diagonal[v]) / (n * (n + 5.0))
        })
    }
}

/// The weight of each of `n` neighbours in Loop's rule for a vertex.
fn loop_weight(n: f64) -> f64 {
    (5.0 / 8.0 - (3.0 / 8.0 + (TAU / n).cos() / 4.0).powi(2)) / n
}
