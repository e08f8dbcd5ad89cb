//! The least turns of all ribbons that close their crossings.

use super::{Crossing, RibbonNetwork};
use crate::Error;
use crate::spatial::outer;
use glam::{DMat3, DVec3};
use nalgebra::{DMatrix, DVector};

impl RibbonNetwork {
    /// Puts the ribbons together with least squared gaps, their shapes being kept.
    pub(super) fn place(&mut self) -> Result<(), Error> {
        let free = self.ribbons.len() - 1;
        let (mut matrix, mut right) = (
            DMatrix::<f64>::zeros(free, free),
            DMatrix::<f64>::zeros(free, 3),
        );
        for (crossing, gap) in self.distinct()? {
            let sides = [(crossing.ribbons[0], 1.0), (crossing.ribbons[1], -1.0)];
            for (i, sign) in sides.into_iter().filter(|(i, _)| *i > 0) {
                for (j, other) in sides.into_iter().filter(|(j, _)| *j > 0) {
                    matrix[(i - 1, j - 1)] += sign * other;
                }
                for axis in 0..3 {
                    right[(i - 1, axis)] -= sign * gap[axis];
                }
            }
        }
        if free > 0 {
            // The graph's Laplacian without the first ribbon: positive definite, as the network is connected.
            let factors = matrix.cholesky().ok_or(Error::DegenerateEnergy)?;
            let moves = factors.solve(&right);
            for i in 0..free {
                self.origins[i + 1] += DVec3::new(moves[(i, 0)], moves[(i, 1)], moves[(i, 2)]);
            }
        }
        Ok(())
    }

    /// First minus second position at every crossing.
    pub(super) fn gaps(&self) -> Result<Vec<DVec3>, Error> {
        self.crossings
            .iter()
            .map(|crossing| {
                let [a, b] = [0, 1].map(|k| self.point(crossing.ribbons[k], crossing.s[k]));
                Ok(a? - b?)
            })
            .collect()
    }

    /// The crossings that do not only repeat an earlier one, with their gaps.
    fn distinct(&self) -> Result<Vec<(Crossing, DVec3)>, Error> {
        let mut distinct: Vec<(Crossing, DVec3)> = Vec::with_capacity(self.crossings.len());
        for (crossing, gap) in self.crossings.iter().zip(self.gaps()?) {
            let ([a, b], [s, t]) = (crossing.ribbons, crossing.s);
            let turned = Crossing {
                ribbons: [b, a],
                s: [t, s],
            };
            if distinct
                .iter()
                .all(|(before, _)| before != crossing && *before != turned)
            {
                distinct.push((*crossing, gap));
            }
        }
        Ok(distinct)
    }

    /// One Newton step: the least change `d` of the tangents from the measured ones and moves `p` of the origins with
    /// `gap + J d + P p = 0`. With the multipliers `m`: `[J J^T, P; P^T, 0] [m; p] = [-(gap - J (now - measured)); 0]`
    /// and the new deviation is `J^T m`.
    pub(super) fn step(&mut self, measured: &[Vec<DVec3>]) -> Result<(), Error> {
        let offsets: Vec<usize> = self
            .ribbons
            .iter()
            .scan(0, |sum, ribbon| {
                let start = *sum;
                *sum += 3 * ribbon.tangents().len();
                Some(start)
            })
            .collect();
        let unknowns: usize = self
            .ribbons
            .iter()
            .map(|ribbon| 3 * ribbon.tangents().len())
            .sum();
        let crossings = self.distinct()?;
        let (rows, moves) = (3 * crossings.len(), 3 * (self.ribbons.len() - 1));
        let mut jacobian = DMatrix::<f64>::zeros(rows, unknowns);
        let mut placing = DMatrix::<f64>::zeros(rows, moves);
        let mut right = DVector::<f64>::zeros(rows + moves);
        for (c, (crossing, gap)) in crossings.iter().enumerate() {
            for axis in 0..3 {
                right[3 * c + axis] = -gap[axis];
            }
            for (k, sign) in [(0, 1.0), (1, -1.0)] {
                let ribbon = crossing.ribbons[k];
                let blocks = self.ribbons[ribbon].sensitivity(crossing.s[k]);
                for (j, (block, tangent)) in blocks
                    .iter()
                    .zip(self.ribbons[ribbon].tangents())
                    .enumerate()
                {
                    // Only turns count: tangents stay unit vectors.
                    let block = *block * (DMat3::IDENTITY - outer(*tangent, *tangent));
                    for (row, column) in (0..9).map(|n| (n % 3, n / 3)) {
                        jacobian[(3 * c + row, offsets[ribbon] + 3 * j + column)] +=
                            sign * block.col(column)[row];
                    }
                }
                if ribbon > 0 {
                    for axis in 0..3 {
                        placing[(3 * c + axis, 3 * (ribbon - 1) + axis)] += sign;
                    }
                }
            }
        }
        let mut deviation = DVector::<f64>::zeros(unknowns);
        for (ribbon, (offset, measured)) in self.ribbons.iter().zip(offsets.iter().zip(measured)) {
            for (j, (now, then)) in ribbon.tangents().iter().zip(measured).enumerate() {
                for axis in 0..3 {
                    deviation[offset + 3 * j + axis] = now[axis] - then[axis];
                }
            }
        }
        let carried = &jacobian * &deviation;
        for row in 0..rows {
            right[row] += carried[row];
        }
        let mut system = DMatrix::<f64>::zeros(rows + moves, rows + moves);
        system
            .view_mut((0, 0), (rows, rows))
            .copy_from(&(&jacobian * jacobian.transpose()));
        system
            .view_mut((0, rows), (rows, moves))
            .copy_from(&placing);
        system
            .view_mut((rows, 0), (moves, rows))
            .copy_from(&placing.transpose());
        // Singular when crossings repeat each other or leave nothing to turn.
        let no_way = Error::NoConvergence {
            what: "closing the crossings (they repeat or contradict each other)",
            steps: 0,
        };
        let solution = system.lu().solve(&right).ok_or(no_way)?;
        let wanted = jacobian.transpose() * solution.rows(0, rows);
        for (i, ribbon) in self.ribbons.iter_mut().enumerate() {
            let tangents: Vec<DVec3> = (0..measured[i].len())
                .map(|j| {
                    measured[i][j]
                        + DVec3::from_array(core::array::from_fn(|axis| {
                            wanted[offsets[i] + 3 * j + axis]
                        }))
                })
                .collect();
            *ribbon = ribbon.with_tangents(&tangents)?;
            if i > 0 {
                let at = rows + 3 * (i - 1);
                self.origins[i] += DVec3::new(solution[at], solution[at + 1], solution[at + 2]);
            }
        }
        Ok(())
    }
}
