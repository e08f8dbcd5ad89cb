//! Scattered points, sorted into the cells of a grid whose cells lie in larger cells.

use std::ops::Range;

use glam::DVec2;

/// Finite points with their numbers, in the order of the cells.
pub(crate) struct Scatter {
    places: Vec<(DVec2, u32)>,
    /// Where the places of each smallest cell start, and the end of all.
    starts: Vec<u32>,
    level: u32,
    low: DVec2,
    size: DVec2,
}

/// A square of cells: the number of its first smallest cell, and how often it can be divided. Cells are numbered so that
/// the four parts of a square follow each other: the bits of the column and of the row alternate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    first: u32,
    level: u32,
}

/// The grid has at most 4 to this power cells.
const MOST_LEVELS: u32 = 9;

impl Cell {
    /// Where the parts of a cell start, in halves of its size.
    pub(crate) const CORNERS: [DVec2; 4] = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE];

    /// Its four parts; none for a smallest cell.
    pub(crate) fn parts(self) -> Option<[Self; 4]> {
        let level = self.level.checked_sub(1)?;
        let part = |k: u32| Self {
            first: self.first + (k << (2 * level)),
            level,
        };
        Some([part(0), part(1), part(2), part(3)])
    }
}

impl Scatter {
    /// Points that are not finite are left out; the smallest cells hold no more than `few` points on average.
    pub(crate) fn new(points: &[DVec2], few: usize) -> Self {
        let finite = || {
            let numbered = points.iter().zip(0_u32..);
            numbered.filter(|(point, _)| point.is_finite())
        };
        let (low, high) = finite().fold(
            (DVec2::INFINITY, DVec2::NEG_INFINITY),
            |(low, high), (point, _)| (low.min(*point), high.max(*point)),
        );
        let mut level = 0;
        while level < MOST_LEVELS && (few << (2 * level)) < points.len() {
            level += 1;
        }
        let side = f64::from(1_u32 << level);
        let size = high - low;
        // A vanishing or overflowing extent is no extent: everything is in the first row or column.
        let scale = (side / size).map(|scale| if scale.is_finite() { scale } else { 0.0 });
        let cell = |point: DVec2| {
            let last = (1_u32 << level) - 1;
            let place = scale * (point - low);
            let (column, row) = ((place.x as u32).min(last), (place.y as u32).min(last));
            interleave(column) | interleave(row) << 1
        };
        let cells: Vec<u32> = finite().map(|(point, _)| cell(*point)).collect();
        let mut starts = vec![0_u32; (1 << (2 * level)) + 1];
        for &cell in &cells {
            starts[cell as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut places = vec![(DVec2::ZERO, 0); cells.len()];
        for ((point, number), cell) in finite().zip(cells) {
            let slot = &mut next[cell as usize];
            places[*slot as usize] = (*point, number);
            *slot += 1;
        }
        Self {
            places,
            starts,
            level,
            low,
            size,
        }
    }

    /// The cell of all points, its corner and its size.
    pub(crate) fn root(&self) -> (Cell, DVec2, DVec2) {
        let cell = Cell {
            first: 0,
            level: self.level,
        };
        (cell, self.low, self.size)
    }

    /// Where the points of a cell are.
    pub(crate) fn places(&self, cell: Cell) -> Range<usize> {
        let end = cell.first + (1 << (2 * cell.level));
        self.starts[cell.first as usize] as usize..self.starts[end as usize] as usize
    }

    /// The points in a range of places, with their numbers.
    pub(crate) fn slice(&self, places: Range<usize>) -> &[(DVec2, u32)] {
        &self.places[places]
    }

    /// The box around the points in a range of places, which is not empty.
    pub(crate) fn bounds(&self, places: Range<usize>) -> (DVec2, DVec2) {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.places[places]
            .iter()
            .fold(start, |(low, high), (point, _)| {
                (low.min(*point), high.max(*point))
            })
    }

    /// Moves the points in the lower half of the longer side of a box to the front; where the others start.
    pub(crate) fn divide(&mut self, places: Range<usize>, low: DVec2, high: DVec2) -> usize {
        let centre = 0.5 * low + 0.5 * high;
        let by_column = high.x - low.x > high.y - low.y;
        let mut middle = places.start;
        for i in places {
            let point = self.places[i].0;
            let is_low = if by_column {
                point.x < centre.x
            } else {
                point.y < centre.y
            };
            if is_low {
                self.places.swap(i, middle);
                middle += 1;
            }
        }
        middle
    }
}

/// The bits of a number below 2^16 at the even places.
const fn interleave(number: u32) -> u32 {
    let mut bits = number & 0xffff;
    bits = (bits | bits << 8) & 0x00ff_00ff;
    bits = (bits | bits << 4) & 0x0f0f_0f0f;
    bits = (bits | bits << 2) & 0x3333_3333;
    (bits | bits << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    #[test]
    fn each_point_is_in_its_cell_and_cells_are_in_cells() {
        let share = |i: u32, step: f64| (step * f64::from(i)).fract();
        let mut points: Vec<DVec2> = (0..1000)
            .map(|i| dvec2(3.0 * share(i, 0.754_877), share(i, 0.569_84) - 7.0))
            .collect();
        points.push(DVec2::NAN);
        let scatter = Scatter::new(&points, 16);
        let (root, low, size) = scatter.root();
        let mut waiting = vec![(root, low, size)];
        let (mut seen, mut smallest) = (0, 0);
        while let Some((cell, low, size)) = waiting.pop() {
            let slack = 1e-12;
            for &(point, number) in scatter.slice(scatter.places(cell)) {
                assert_eq!(points[number as usize], point);
                assert!(point.cmpge(low - slack).all() && point.cmple(low + size + slack).all());
            }
            match cell.parts() {
                Some(parts) => {
                    let inside: usize = parts.map(|part| scatter.places(part).len()).iter().sum();
                    assert_eq!(inside, scatter.places(cell).len());
                    for (part, corner) in parts.into_iter().zip(Cell::CORNERS) {
                        waiting.push((part, low + 0.5 * size * corner, 0.5 * size));
                    }
                }
                None => {
                    seen += scatter.places(cell).len();
                    smallest += 1;
                }
            }
        }
        assert_eq!((seen, smallest), (1000, 64));
    }

    #[test]
    fn points_without_extent_or_with_too_much_are_kept() {
        for point in [DVec2::ONE, DVec2::splat(1e308)] {
            let points = [vec![point; 100], vec![-point; 3]].concat();
            let scatter = Scatter::new(&points, 4);
            assert_eq!(scatter.places(scatter.root().0).len(), 103);
        }
        let scatter = Scatter::new(&[DVec2::NAN], 4);
        assert!(scatter.places(scatter.root().0).is_empty());
    }
}
