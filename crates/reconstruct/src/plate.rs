//! The thin plate between two geodesics: end vectors of least energy as one linear system.

use crate::Error;
use crate::hermite::hermite;
use crate::quadrature::SIX;
use crate::strip::{GeodesicStrip, Strip};
use crate::two_curves::LEAST_ACROSS;
use core::array::from_fn;
use glam::DVec3;
use nalgebra::{DMatrix, DVector};

/// The normal equations of criterion 4: unknowns are the spline coefficients of the components along and across the
/// first curve, then of those of the second.
pub(crate) struct PlateSystem {
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    count: usize,
    least_across: f64,
}

impl PlateSystem {
    pub(crate) fn assemble(strips: &[GeodesicStrip; 2], spans: usize) -> Self {
        let count = spans + 3;
        let unknowns = 4 * count;
        let (mut matrix, mut right) =
            (DMatrix::zeros(unknowns, unknowns), DVector::zeros(unknowns));
        let mut least_chord = f64::INFINITY;
        for span in 0..spans {
            for (x, wx) in SIX {
                let u = (span as f64 + x) / spans as f64;
                let samples = [strips[0].sample(u), strips[1].sample(u)];
                least_chord = least_chord.min(samples[0].point[0].distance(samples[1].point[0]));
                let basis = uniform_cubic(x, spans as f64);
                // The vectors b(u) e and b(u) h of each unknown of this span, with two derivatives.
                let local: Vec<(usize, usize, [DVec3; 3])> = (0..4)
                    .flat_map(|component| (0..4).map(move |k| (component, k)))
                    .map(|(component, k)| {
                        let sample = &samples[component / 2];
                        let v = if component % 2 == 0 {
                            &sample.along
                        } else {
                            &sample.across
                        };
                        let c = basis[k];
                        let vector = [
                            v[0] * c[0],
                            v[0] * c[1] + v[1] * c[0],
                            v[0] * c[2] + v[1] * (2.0 * c[1]) + v[2] * c[0],
                        ];
                        (component * count + span + k, component / 2, vector)
                    })
                    .collect();
                for (v, wv) in SIX {
                    let h = hermite(v);
                    let weight = wx * wv / spans as f64;
                    let fixed = |a: usize, b: usize| {
                        samples[0].point[a] * h[b][0] + samples[1].point[a] * h[b][3]
                    };
                    let orders = [([2, 0], 1.0), ([1, 1], 2.0), ([0, 2], 1.0)];
                    for ([a, b], factor) in orders {
                        for (row, end, x) in &local {
                            let left = x[a] * h[b][1 + end] * (factor * weight);
                            right[*row] -= left.dot(fixed(a, b));
                            for (column, other, y) in &local {
                                matrix[(*row, *column)] += left.dot(y[a] * h[b][1 + other]);
                            }
                        }
                    }
                }
            }
        }
        Self {
            matrix,
            right,
            count,
            least_across: LEAST_ACROSS * least_chord,
        }
    }

    /// Solves, fixing coefficients across a curve that fall below the least value until none does.
    pub(crate) fn solve(&self) -> Result<DVector<f64>, Error> {
        let n = self.right.len();
        let across = |k: usize| (k / self.count) % 2 == 1;
        let mut fixed = vec![false; n];
        loop {
            let (mut matrix, mut right) = (self.matrix.clone(), self.right.clone());
            for k in (0..n).filter(|k| fixed[*k]) {
                for row in 0..n {
                    right[row] -= matrix[(row, k)] * self.least_across;
                    (matrix[(row, k)], matrix[(k, row)]) = (0.0, 0.0);
                }
                (matrix[(k, k)], right[k]) = (1.0, self.least_across);
            }
            let solution = matrix
                .cholesky()
                .ok_or(Error::DegenerateEnergy)?
                .solve(&right);
            let violated: Vec<usize> = (0..n)
                .filter(|k| across(*k) && !fixed[*k] && solution[*k] < self.least_across)
                .collect();
            if violated.is_empty() {
                return Ok(solution);
            }
            for k in violated {
                fixed[k] = true;
            }
        }
    }
}

/// The four uniform cubic B-splines on a span at its local parameter, with derivatives by the global one.
fn uniform_cubic(x: f64, spans: f64) -> [[f64; 3]; 4] {
    let s = 1.0 - x;
    let values = [
        s * s * s,
        3.0 * x * x * x - 6.0 * x * x + 4.0,
        3.0 * s * s * s - 6.0 * s * s + 4.0,
        x * x * x,
    ];
    let firsts = [
        -3.0 * s * s,
        9.0 * x * x - 12.0 * x,
        -(9.0 * s * s - 12.0 * s),
        3.0 * x * x,
    ];
    let seconds = [6.0 * s, 18.0 * x - 12.0, 18.0 * s - 12.0, 6.0 * x];
    from_fn(|k| {
        [
            values[k] / 6.0,
            firsts[k] * spans / 6.0,
            seconds[k] * spans * spans / 6.0,
        ]
    })
}
