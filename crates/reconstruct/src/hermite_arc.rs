//! One interpolating curve between two curves, and the local criteria by which its end vectors are chosen.

use crate::hermite::hermite;
use crate::quadrature::SIX;
use glam::DVec3;
use nalgebra::{DMatrix, DVector};

/// One interpolating curve: from `P0` with velocity `l0 T0` to `P1` with velocity `l1 T1`, both directions given.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HermiteArc {
    points: [DVec3; 2],
    directions: [DVec3; 2],
}

/// The local criteria by which an interpolating curve is smooth; the thesis names none, these are the usual ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LocalCriterion {
    /// Criterion 1: `int |F_vv|² dv`.
    Bending,
    /// Criterion 2: `int |F_v|² dv`.
    Stretching,
    /// Criterion 3: `int (d|F_v|/dv)² dv`.
    SpeedVariation,
}

/// Which numbers a criterion may choose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Freedom {
    /// The lengths of the end vectors, their angles being given.
    #[default]
    Lengths,
    /// The end vectors altogether.
    Vectors,
}

/// The magnitudes that minimise a criterion, and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LeastMagnitudes {
    /// The lengths of the end velocities; negative where the free minimum turns one around.
    pub magnitudes: [f64; 2],
    /// The integral, without a factor 1/2.
    pub energy: f64,
}

impl HermiteArc {
    /// The arc between two points with unit end directions.
    #[must_use]
    pub fn new(points: [DVec3; 2], directions: [DVec3; 2]) -> Self {
        Self { points, directions }
    }

    /// The free minimum of `int |F''|²`: `[[8, 4c], [4c, 8]] l = 12 (D.T0, D.T1)`, `D = P1 - P0`, `c = T0.T1`.
    #[must_use]
    pub fn least_bending(&self) -> LeastMagnitudes {
        self.least(LocalCriterion::Bending)
    }

    /// The free minimum of a criterion over the two magnitudes.
    #[must_use]
    pub fn least(&self, criterion: LocalCriterion) -> LeastMagnitudes {
        let problem = EndVectorProblem {
            chord: self.points[1] - self.points[0],
            basis: vec![(0, self.directions[0]), (1, self.directions[1])],
        };
        let (values, energy) = problem.minimum(criterion);
        LeastMagnitudes {
            magnitudes: [values[0], values[1]],
            energy,
        }
    }
}

/// Minimise a criterion over end vectors `X_i = sum c_k b_k` (each basis vector belongs to one end).
pub(crate) struct EndVectorProblem {
    pub(crate) chord: DVec3,
    pub(crate) basis: Vec<(usize, DVec3)>,
}

/// Newton steps for the speed variation at one place.
const LOCAL_STEPS: usize = 40;

impl EndVectorProblem {
    pub(crate) fn minimum(&self, criterion: LocalCriterion) -> (Vec<f64>, f64) {
        match criterion {
            LocalCriterion::Bending => self.quadratic([12.0, 12.0, 4.0, 4.0]),
            LocalCriterion::Stretching => self.quadratic([1.2, 0.2, 2.0 / 15.0, -1.0 / 15.0]),
            LocalCriterion::SpeedVariation => self.least_speed_variation(),
        }
    }

    /// `E = a |D|² - b D.(X0 + X1) + c (|X0|² + |X1|²) + d X0.X1`.
    fn quadratic(&self, [a, b, c, d]: [f64; 4]) -> (Vec<f64>, f64) {
        let n = self.basis.len();
        let matrix = DMatrix::from_fn(n, n, |k, l| {
            let ((i, x), (j, y)) = (self.basis[k], self.basis[l]);
            x.dot(y) * if i == j { 2.0 * c } else { d }
        });
        let right = DVector::from_fn(n, |k, _| b * self.chord.dot(self.basis[k].1));
        let values = matrix
            .lu()
            .solve(&right)
            .unwrap_or_else(|| DVector::zeros(n));
        let energy = a * self.chord.length_squared() - 0.5 * right.dot(&values);
        (values.iter().copied().collect(), energy)
    }

    /// Damped Gauss-Newton on the residuals `F_v . F_vv / |F_v|` at Gauss points, from the stretching minimum.
    fn least_speed_variation(&self) -> (Vec<f64>, f64) {
        let n = self.basis.len();
        let (start, _) = self.minimum(LocalCriterion::Stretching);
        let mut values = DVector::from_vec(start);
        let model = |values: &DVector<f64>| {
            let (mut energy, mut gradient, mut matrix) =
                (0.0, DVector::zeros(n), DMatrix::zeros(n, n));
            // Four panels: the integrand is a quotient and peaks where the speed is small.
            let panels =
                (0..4).flat_map(|k| SIX.map(|(x, w)| (0.25 * (f64::from(k) + x), 0.25 * w)));
            for (node, weight) in panels {
                let h = hermite(node);
                let coefficient = |order: usize, end: usize| h[order][1 + end];
                let derivative = |order: usize| {
                    (0..n).fold(self.chord * h[order][3], |sum, k| {
                        let (end, vector) = self.basis[k];
                        sum + vector * (coefficient(order, end) * values[k])
                    })
                };
                let (first, second) = (derivative(1), derivative(2));
                let length = first.length().max(f64::MIN_POSITIVE);
                let unit = first / length;
                let residual = unit.dot(second);
                let slope = DVector::from_fn(n, |k, _| {
                    let (end, vector) = self.basis[k];
                    let (b1, b2) = (vector * coefficient(1, end), vector * coefficient(2, end));
                    unit.dot(b2) + (b1.dot(second) - unit.dot(b1) * residual) / length
                });
                energy += weight * residual * residual;
                matrix += &slope * slope.transpose() * weight;
                gradient += slope * (weight * residual);
            }
            (energy, gradient, matrix)
        };
        let (mut energy, mut gradient, mut matrix) = model(&values);
        let mut damping = 1e-3;
        for _ in 0..LOCAL_STEPS {
            let damped = &matrix + DMatrix::identity(n, n) * (damping * matrix.trace() / n as f64);
            let Some(step) = damped.lu().solve(&-&gradient) else {
                break;
            };
            let trial = &values + &step;
            let (e, g, m) = model(&trial);
            if e <= energy {
                let done = step.norm() <= 1e-12 * (1e-300 + values.norm());
                (values, energy, gradient, matrix) = (trial, e, g, m);
                damping *= 0.1;
                if done {
                    break;
                }
            } else {
                damping *= 10.0;
            }
        }
        (values.iter().copied().collect(), energy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Minima against steps away from them, and the closed forms of the specification.
    #[test]
    fn local_criteria() {
        let arc = HermiteArc::new(
            [DVec3::ZERO, DVec3::new(1.5, 0.4, -0.2)],
            [
                DVec3::new(0.9, 0.3, 0.1).normalize(),
                DVec3::new(0.8, -0.4, 0.2).normalize(),
            ],
        );
        let energy = |criterion: LocalCriterion, [l0, l1]: [f64; 2]| {
            let rule = crate::quadrature::gauss(40);
            let density = |t: f64| {
                let h = hermite(t);
                let f = |o: usize| {
                    arc.points[1] * h[o][3]
                        + arc.directions[0] * (l0 * h[o][1])
                        + arc.directions[1] * (l1 * h[o][2])
                };
                match criterion {
                    LocalCriterion::Bending => f(2).length_squared(),
                    LocalCriterion::Stretching => f(1).length_squared(),
                    LocalCriterion::SpeedVariation => (f(1).dot(f(2)) / f(1).length()).powi(2),
                }
            };
            rule.iter().map(|(t, w)| w * density(*t)).sum::<f64>()
        };
        for criterion in [
            LocalCriterion::Bending,
            LocalCriterion::Stretching,
            LocalCriterion::SpeedVariation,
        ] {
            let LeastMagnitudes {
                magnitudes: [l0, l1],
                energy: least,
            } = arc.least(criterion);
            assert!(
                (energy(criterion, [l0, l1]) - least).abs() < 1e-6 * (1.0 + least),
                "{criterion:?}"
            );
            for (d0, d1) in [(1e-2, 0.0), (-1e-2, 0.0), (0.0, 1e-2), (0.0, -1e-2)] {
                assert!(
                    energy(criterion, [l0 + d0, l1 + d1]) > energy(criterion, [l0, l1]),
                    "{criterion:?}"
                );
            }
        }
    }
}
