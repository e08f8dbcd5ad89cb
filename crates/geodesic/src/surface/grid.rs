//! The triangles of a net, and where a curve in the parameter plane meets them.
//!
//! Places are given in units of cells: vertex `(i, j)` lies at `(i, j)`. In a closed direction places go on and on.

use glam::DVec2;

use super::net::Axis;
use crate::SurfacePoint;
use crate::mesh::{Mesh, next};

/// Places this close to a line of the grid, in cells, lie on it: the carried points are good to rounding.
const ON_LINE: f64 = 1e-9;

/// The cells of a net and their two triangles, cut by the diagonal from `(i, j)` to `(i + 1, j + 1)`.
pub(super) struct Grid {
    columns: usize,
    rows: usize,
    closed: [bool; 2],
}

impl Grid {
    pub(super) fn new(axes: &[Axis; 2]) -> Self {
        Self {
            columns: axes[0].cells(),
            rows: axes[1].cells(),
            closed: [axes[0].closed, axes[1].closed],
        }
    }

    /// Vertices along v.
    fn stride(&self) -> usize {
        self.rows + usize::from(!self.closed[1])
    }

    fn vertex(&self, i: usize, j: usize) -> u32 {
        let i = if self.closed[0] { i % self.columns } else { i };
        let j = if self.closed[1] { j % self.rows } else { j };
        (i * self.stride() + j) as u32
    }

    /// Cell by cell the triangle below the diagonal (of larger u), then the one above.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        let cells = (0..self.columns).flat_map(|i| (0..self.rows).map(move |j| (i, j)));
        cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    .map(|(i, j)| self.vertex(i, j));
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    /// The face at a place, of larger index on a grid line, of larger u on a diagonal; with the corner of its cell.
    fn locate(&self, place: DVec2) -> (u32, DVec2) {
        let cell = |x: f64, cells: usize, closed: bool| {
            let snapped = if (x - x.round()).abs() < ON_LINE {
                x.round()
            } else {
                x
            };
            if closed {
                let corner = snapped.floor();
                let wrapped = corner.rem_euclid(cells as f64) as usize;
                (wrapped.min(cells - 1), corner, snapped - corner)
            } else {
                let index = (snapped.max(0.0) as usize).min(cells - 1);
                (index, index as f64, snapped - index as f64)
            }
        };
        let (i, x, s) = cell(place.x, self.columns, self.closed[0]);
        let (j, y, t) = cell(place.y, self.rows, self.closed[1]);
        let above = t - s > ON_LINE;
        let face = 2 * (i * self.rows + j) + usize::from(above);
        (face as u32, DVec2::new(x, y))
    }

    /// The point of the mesh at a place.
    pub(super) fn point(&self, place: DVec2) -> SurfacePoint {
        let (face, corner) = self.locate(place);
        let local = (place - corner).clamp(DVec2::ZERO, DVec2::ONE);
        let barycentric = if face % 2 == 0 {
            let t = local.y.min(local.x);
            [1.0 - local.x, local.x - t, t]
        } else {
            let s = local.x.min(local.y);
            [1.0 - local.y, s, local.y - s]
        };
        SurfacePoint::Face { face, barycentric }
    }

    /// The place of a point of the mesh; of those that a closed direction gives it, the one nearest to `near`.
    pub(super) fn place(&self, mesh: &Mesh, point: SurfacePoint, near: DVec2) -> DVec2 {
        let of = |v: u32, near: DVec2| {
            let v = v as usize;
            let place = DVec2::new((v / self.stride()) as f64, (v % self.stride()) as f64);
            self.shifted(place, near)
        };
        let place = match point {
            SurfacePoint::Vertex(v) => of(v, near),
            SurfacePoint::Edge { halfedge, t } => {
                let origin = of(mesh.origin(halfedge), near);
                origin.lerp(of(mesh.origin(next(halfedge)), origin), t)
            }
            SurfacePoint::Face { face, barycentric } => {
                let [a, b, c] = mesh.faces()[face as usize];
                let first = of(a, near);
                barycentric[0] * first
                    + barycentric[1] * of(b, first)
                    + barycentric[2] * of(c, first)
            }
        };
        self.shifted(place, near)
    }

    /// A place moved by whole turns of the closed directions to be near to another one.
    fn shifted(&self, place: DVec2, near: DVec2) -> DVec2 {
        let turn = |x: f64, near: f64, cells: usize, closed: bool| {
            if closed {
                x + ((near - x) / cells as f64).round() * cells as f64
            } else {
                x
            }
        };
        DVec2::new(
            turn(place.x, near.x, self.columns, self.closed[0]),
            turn(place.y, near.y, self.rows, self.closed[1]),
        )
    }

    /// The faces that a polyline passes, in order: a face for each stretch between two crossings of grid lines or diagonals.
    pub(super) fn faces_met(&self, way: &[DVec2]) -> Vec<u32> {
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
            faces.extend(way.first().map(|&place| self.locate(place).0));
        }
        faces
    }
}
