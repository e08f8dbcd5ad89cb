//! How the triangles of a subdivided polyhedron tile those of the one before.
//!
//! With the corners of the tiles given in barycentric coordinates of the triangle, a point or a path is carried over by
//! keeping its place; the map is continuous across edges, since neighbours agree on the middles of their edges.

use glam::{DMat2, DVec2};

/// Parts of a segment shorter than this, of 1, do not lead through a triangle: the carried points are good to rounding.
const SHORTEST_PART: f64 = 1e-9;

/// A triangle of the mesh among the corners of the polyhedron.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    /// A triangle in Loop's scheme.
    Triangle(u32),
    /// From corner to corner to the centre of their polygon.
    Fan([u32; 2]),
    /// Half of a quadrilateral, from corner to corner to corner, the centre between the first and the last.
    FirstHalf([u32; 3]),
    /// The other half, the centre between the first and the second.
    SecondHalf([u32; 3]),
}

/// A triangle of the next mesh, and where its corners lie in the triangle that it is a part of.
type Tile = (u32, [[f64; 3]; 3]);

impl Piece {
    /// The tiles of the triangle.
    fn tiles(self) -> Vec<Tile> {
        const A: [f64; 3] = [1.0, 0.0, 0.0];
        const B: [f64; 3] = [0.0, 1.0, 0.0];
        const C: [f64; 3] = [0.0, 0.0, 1.0];
        const AB: [f64; 3] = [0.5, 0.5, 0.0];
        const BC: [f64; 3] = [0.0, 0.5, 0.5];
        const CA: [f64; 3] = [0.5, 0.0, 0.5];
        // Corner c of a polygon becomes the triangles 2 c and 2 c + 1: (vertex, next edge, centre) and (vertex, centre,
        // edge before).
        match self {
            Piece::Triangle(f) => vec![
                (4 * f, [A, AB, CA]),
                (4 * f + 1, [B, BC, AB]),
                (4 * f + 2, [C, CA, BC]),
                (4 * f + 3, [AB, BC, CA]),
            ],
            Piece::Fan([a, b]) => vec![(2 * a, [A, AB, C]), (2 * b + 1, [B, C, AB])],
            Piece::FirstHalf([a, b, c]) => vec![
                (2 * a, [A, AB, CA]),
                (2 * b + 1, [B, CA, AB]),
                (2 * b, [B, BC, CA]),
                (2 * c + 1, [C, CA, BC]),
            ],
            Piece::SecondHalf([a, b, c]) => vec![
                (2 * b, [B, BC, AB]),
                (2 * c + 1, [C, AB, BC]),
                (2 * c, [C, CA, AB]),
                (2 * a + 1, [A, AB, CA]),
            ],
        }
    }

    /// The tile that contains a point of a triangle, and the point's coordinates in it.
    pub(super) fn tile_at(self, weights: [f64; 3]) -> (u32, [f64; 3]) {
        let smallest = |local: &[f64; 3]| local.iter().copied().fold(f64::INFINITY, f64::min);
        let tiles = self.tiles();
        let located = tiles
            .iter()
            .map(|(tile, corners)| (*tile, within(corners, weights)));
        let best = located.max_by(|a, b| smallest(&a.1).total_cmp(&smallest(&b.1)));
        let (tile, local) = best.unwrap_or((0, weights));
        (tile, local.map(|l| l.max(0.0)))
    }

    /// The tiles that a segment in a triangle passes, in order.
    pub(super) fn tiles_met(self, from: [f64; 3], to: [f64; 3]) -> Vec<u32> {
        let mut parts: Vec<(f64, f64, u32)> = Vec::new();
        for (tile, corners) in self.tiles() {
            let (a, b) = (within(&corners, from), within(&corners, to));
            // Where all coordinates are positive, to rounding.
            let (mut begin, mut end) = (0.0_f64, 1.0_f64);
            for k in 0..3 {
                let (a, b) = (a[k] + SHORTEST_PART / 8.0, b[k] + SHORTEST_PART / 8.0);
                if a < 0.0 && b < 0.0 {
                    end = -1.0;
                } else if a < 0.0 {
                    begin = begin.max(a / (a - b));
                } else if b < 0.0 {
                    end = end.min(a / (a - b));
                }
            }
            if end - begin > SHORTEST_PART {
                parts.push((begin, end, tile));
            }
        }
        parts.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
        let mut reached = 0.0;
        let mut met = Vec::new();
        for (_, end, tile) in parts {
            // A segment along the edge of two tiles goes through one of them.
            if end > reached + SHORTEST_PART {
                met.push(tile);
                reached = end;
            }
        }
        if met.is_empty() {
            met.push(self.tile_at(from).0);
        }
        met
    }
}

/// Barycentric coordinates in a tile of a point given in those of the triangle that the tile is a part of.
fn within(corners: &[[f64; 3]; 3], weights: [f64; 3]) -> [f64; 3] {
    let plane = |w: [f64; 3]| DVec2::new(w[1], w[2]);
    let [a, b, c] = corners.map(plane);
    let local = DMat2::from_cols(b - a, c - a).inverse() * (plane(weights) - a);
    [1.0 - local.x - local.y, local.x, local.y]
}
