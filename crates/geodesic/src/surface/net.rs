//! Nets of Bézier patches: an array of patches that share their boundaries, refined by de Casteljau's algorithm.

use bezier_mass::{BSplineSurface, BezierPatch, MassPoint, bernstein};
use glam::DVec3;

use crate::Error;

/// One direction of the parameter plane, and how a net divides it.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// Where the patches meet, ends included: increasing.
    breakpoints: Vec<f64>,
    /// Whether the last breakpoint is the first again.
    pub(super) closed: bool,
    /// Cells of the net on each patch.
    cells_per_patch: usize,
}

impl Axis {
    fn patches(&self) -> usize {
        self.breakpoints.len() - 1
    }

    /// Number of cells of the net.
    pub(super) fn cells(&self) -> usize {
        self.patches() * self.cells_per_patch
    }

    /// Number of different lines of the net across this direction.
    pub(super) fn lines(&self) -> usize {
        self.cells() + usize::from(!self.closed)
    }

    /// Whether a parameter belongs to the surface: any one does in a closed direction.
    pub(super) fn contains(&self, t: f64) -> bool {
        let (first, last) = (self.breakpoints[0], self.breakpoints[self.patches()]);
        t.is_finite() && (self.closed || (first..=last).contains(&t))
    }

    fn period(&self) -> f64 {
        self.breakpoints[self.patches()] - self.breakpoints[0]
    }

    /// A parameter in units of cells.
    pub(super) fn to_cells(&self, t: f64) -> f64 {
        let turns = if self.closed {
            ((t - self.breakpoints[0]) / self.period()).floor()
        } else {
            0.0
        };
        let t = t - turns * self.period();
        let patch = self
            .breakpoints
            .partition_point(|&b| b <= t)
            .clamp(1, self.patches())
            - 1;
        let (start, end) = (self.breakpoints[patch], self.breakpoints[patch + 1]);
        turns * self.cells() as f64
            + (patch as f64 + (t - start) / (end - start)) * self.cells_per_patch as f64
    }

    /// The parameter of a place in units of cells.
    pub(super) fn to_parameter(&self, x: f64) -> f64 {
        let cells = self.cells() as f64;
        let turns = if self.closed {
            (x / cells).floor()
        } else {
            0.0
        };
        let x = (x - turns * cells) / self.cells_per_patch as f64;
        let patch = (x.max(0.0) as usize).min(self.patches() - 1);
        let (start, end) = (self.breakpoints[patch], self.breakpoints[patch + 1]);
        start + (end - start) * (x - patch as f64) + turns * self.period()
    }

    /// The breakpoints strictly between two parameters.
    pub(super) fn breakpoints_between(&self, a: f64, b: f64) -> Vec<f64> {
        let (low, high) = (a.min(b), a.max(b));
        let turns = |t: f64| ((t - self.breakpoints[0]) / self.period()).floor();
        let (first, last) = if self.closed {
            (turns(low), turns(high))
        } else {
            (0.0, 0.0)
        };
        let mut found = Vec::new();
        let mut turn = first;
        while turn <= last {
            let shifted = self.breakpoints.iter().map(|b| b + turn * self.period());
            found.extend(shifted.filter(|&b| low < b && b < high));
            turn += 1.0;
        }
        found.dedup();
        found
    }
}

/// The control net of an array of Bézier patches, and the parameters that its lines belong to.
#[derive(Clone, Debug)]
pub(super) struct BezierNet {
    degrees: [usize; 2],
    /// For each line across u, the mass points along v.
    rows: Vec<Vec<MassPoint<DVec3>>>,
    pub(super) axes: [Axis; 2],
}

/// A net never has more faces than this: about a gigabyte with the buffers of a query.
const MOST_FACES: usize = 1 << 22;

impl BezierNet {
    pub(super) fn of_patch(patch: &BezierPatch<DVec3>) -> Self {
        let axis = |degree| Axis {
            breakpoints: vec![0.0, 1.0],
            closed: false,
            cells_per_patch: degree,
        };
        Self {
            degrees: patch.degrees(),
            rows: patch.rows().map(<[_]>::to_vec).collect(),
            axes: patch.degrees().map(axis),
        }
    }

    /// The Bézier form of a spline surface.
    pub(super) fn of_spline(surface: &BSplineSurface<DVec3>) -> Self {
        let degrees = surface.knots().each_ref().map(|knots| knots.degree());
        let axes = surface.knots().each_ref().map(|knots| Axis {
            breakpoints: knots.breakpoints(),
            closed: knots.is_periodic(),
            cells_per_patch: knots.degree(),
        });
        let across = axes[1].patches();
        let width = axes[1].cells() + 1;
        let mut rows = vec![vec![MassPoint::point(DVec3::ZERO, 1.0); width]; axes[0].cells() + 1];
        for (k, piece) in surface.pieces().iter().enumerate() {
            let (first, column) = (k / across * degrees[0], k % across * degrees[1]);
            for (i, row) in piece.patch.rows().enumerate() {
                rows[first + i][column..column + row.len()].copy_from_slice(row);
            }
        }
        Self {
            degrees,
            rows,
            axes,
        }
    }

    /// An array of patches that share boundaries, over the unit square in equal parts.
    pub(super) fn of_rows(
        degrees: [usize; 2],
        rows: &[Vec<MassPoint<DVec3>>],
    ) -> Result<Self, Error> {
        let size = [rows.len(), rows.first().map_or(0, Vec::len)];
        let fits = |k: usize| {
            degrees[k] > 0 && size[k] > degrees[k] && (size[k] - 1).is_multiple_of(degrees[k])
        };
        if !(fits(0) && fits(1) && rows.iter().all(|row| row.len() == size[1])) {
            return Err(Error::NetSize { degrees, size });
        }
        let axis = |k: usize| {
            let patches = (size[k] - 1) / degrees[k];
            Axis {
                breakpoints: (0..=patches).map(|i| i as f64 / patches as f64).collect(),
                closed: false,
                cells_per_patch: degrees[k],
            }
        };
        Ok(Self {
            degrees,
            rows: rows.to_vec(),
            axes: [axis(0), axis(1)],
        })
    }

    /// One midpoint subdivision in both directions.
    pub(super) fn subdivide(&mut self) -> Result<(), Error> {
        let faces = 8 * self.axes[0].cells() * self.axes[1].cells();
        if faces > MOST_FACES {
            return Err(Error::TooLarge { faces });
        }
        let [along_u, along_v] = self.degrees;
        let rows: Vec<_> = self.rows.iter().map(|row| halved(row, along_v)).collect();
        let columns: Vec<_> = transposed(&rows)
            .iter()
            .map(|column| halved(column, along_u))
            .collect();
        self.rows = transposed(&columns);
        self.axes
            .iter_mut()
            .for_each(|axis| axis.cells_per_patch *= 2);
        Ok(())
    }

    /// The positions of the net, a closed direction's last line left out: those along v for each line across u.
    pub(super) fn positions(&self) -> Result<Vec<DVec3>, Error> {
        let [rows, columns] = self.axes.each_ref().map(Axis::lines);
        let points = self.rows.iter().take(rows).flat_map(|row| &row[..columns]);
        points
            .enumerate()
            .map(|(vertex, mass)| {
                let vertex = vertex as u32;
                mass.position().ok_or(Error::NonFiniteVertex { vertex })
            })
            .collect()
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
