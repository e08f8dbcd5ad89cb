//! The free parameters of a rectangle chosen by minimal energy.
//!
//! Section 3.6 of the thesis chapter, criteria 1 to 3. The patch is affine in its eight twist components,
//! `R = R_0 + sum w_k B_k`, so the Dirichlet and the thin-plate energy are quadratic and their minimum is one
//! linear system; the speed variation is a nonlinear least-squares problem.

use crate::Error;
use crate::coons::{CORNERS, CoonsPatch, Line, Rectangle, components};
use crate::quadrature::gauss;
use crate::strip::Strip;
use core::array::from_fn;
use glam::DVec3;
use nalgebra::{SMatrix, SVector};

/// What a smooth rectangle should have little of. Integrals over the unit square, without a factor 1/2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Criterion {
    /// Criterion 1: `(d|R_u|/du)² + (d|R_v|/dv)²`, the variation of the speed along the parameter lines.
    SpeedVariation,
    /// Criterion 2: the Dirichlet energy `|R_u|² + |R_v|²`.
    Dirichlet,
    /// Criterion 3: the thin-plate energy `|R_uu|² + 2 |R_uv|² + |R_vv|²`.
    ThinPlate,
}

/// The patch of least energy.
#[derive(Clone, Debug)]
pub struct Smoothed<S> {
    /// The patch.
    pub patch: CoonsPatch<S>,
    /// Its energy.
    pub energy: f64,
    /// The energy with all tangential twists zero.
    pub energy_at_zero: f64,
    /// Eigenvalues of the matrix of the quadratic form, ascending. For the speed variation, those of its
    /// Gauss-Newton matrix at the minimum.
    pub eigenvalues: [f64; 8],
}

/// Gauss points in either direction: the integrands of smooth boundaries are resolved to rounding.
const NODES: usize = 20;
/// Least-squares steps for the speed variation.
const STEPS: usize = 60;
/// A step that lowers the speed variation by less than this part ends the iteration.
const CONVERGED: f64 = 1e-13;
/// Condition number beyond which a quadratic energy counts as degenerate.
const CONDITION: f64 = 1e13;

type Matrix8 = SMatrix<f64, 8, 8>;
type Vector8 = SVector<f64, 8>;

/// Derivatives of a patch at a node: `R_u, R_v, R_uu, R_uv, R_vv`.
type Derivatives = [DVec3; 5];
const ORDERS: [[usize; 2]; 5] = [[1, 0], [0, 1], [2, 0], [1, 1], [0, 2]];

/// A node of the quadrature over the unit square: derivatives of `R_0` and of the basis surfaces, and its weight.
struct Node {
    patch: Derivatives,
    basis: [Derivatives; 8],
    weight: f64,
}

/// The nodes for a patch `R_0`; everything that an energy asks of the boundary curves is sampled here, once.
fn nodes<S: Strip>(patch: &CoonsPatch<S>) -> Vec<Node> {
    let rectangle = patch.rectangle();
    let lines = lines(patch);
    let directions: [DVec3; 8] = from_fn(|k| rectangle.free_direction(k).1);
    // For every line and free parameter, the part of the basis surface along `u` and along `v`.
    let movers: Vec<[[[DVec3; 3]; 8]; 2]> = lines
        .iter()
        .map(|(pair, _)| {
            [0, 1].map(|axis: usize| from_fn(|k| mover(rectangle, &pair[axis], axis, k)))
        })
        .collect();
    let mut nodes = Vec::with_capacity(lines.len() * lines.len());
    for ((u, wu), along_u) in lines.iter().zip(&movers) {
        for ((v, wv), along_v) in lines.iter().zip(&movers) {
            let (u, v) = (&u[0], &v[1]);
            let basis = from_fn(|k| {
                let [i, j] = CORNERS[k / 2];
                ORDERS.map(|[a, b]| {
                    let (hu, hv) = (u.functions[a][1 + i], v.functions[b][1 + j]);
                    along_u[0][k][a] * hv + along_v[1][k][b] * hu - directions[k] * (hu * hv)
                })
            });
            nodes.push(Node {
                patch: ORDERS.map(|[a, b]| patch.derivative(u, v, a, b)),
                basis,
                weight: wu * wv,
            });
        }
    }
    nodes
}

/// The parameter lines through the Gauss points, along `u` and along `v`, with their weights.
fn lines<S: Strip>(patch: &CoonsPatch<S>) -> Vec<([Line; 2], f64)> {
    gauss(NODES)
        .iter()
        .map(|(t, w)| ([patch.line(false, *t), patch.line(true, *t)], *w))
        .collect()
}

/// The change of the transverse field along the boundary of a corner, at a line, when a free parameter of that
/// corner grows by one: its slope at the corner's end moves by the direction of the parameter.
fn mover<S: Strip>(
    rectangle: &Rectangle<S>,
    line: &Line,
    axis: usize,
    parameter: usize,
) -> [DVec3; 3] {
    let (corner, direction) = rectangle.free_direction(parameter);
    let [i, j] = CORNERS[corner];
    // Along u the boundary is v = j and the end u = i; along v the other way round.
    let (which, end) = if axis == 0 { (j, i) } else { (i, j) };
    let side = 2 * which + axis;
    let [p, q] = components(&rectangle.strips()[side].sample(end as f64), direction);
    let sample = &line.samples[which];
    let slope = line.functions.map(|row| row[1 + end]);
    let at = |k: usize| sample.along[k] * p + sample.across[k] * q;
    [
        at(0) * slope[0],
        at(0) * slope[1] + at(1) * slope[0],
        at(0) * slope[2] + at(1) * (2.0 * slope[1]) + at(2) * slope[0],
    ]
}

impl Criterion {
    /// The vectors whose squares are integrated (quadratic criteria).
    fn integrand(self, d: &Derivatives) -> [DVec3; 3] {
        match self {
            Self::ThinPlate => [d[2], d[3] * core::f64::consts::SQRT_2, d[4]],
            _ => [d[0], d[1], DVec3::ZERO],
        }
    }
}

impl<S: Strip> Rectangle<S> {
    /// The patch that minimises a criterion.
    ///
    /// # Errors
    /// [`Error::DegenerateEnergy`]; [`Error::IrregularBoundary`] when the minimum folds at a boundary.
    pub fn smoothest(&self, criterion: Criterion) -> Result<Smoothed<S>, Error> {
        let smoothed = self.least_energy(criterion)?;
        smoothed.patch.check_boundary()?;
        Ok(smoothed)
    }

    /// The minimum of a criterion wherever it lies, also where the patch folds at a boundary; ask
    /// [`CoonsPatch::check_boundary`].
    ///
    /// # Errors
    /// [`Error::DegenerateEnergy`].
    pub fn least_energy(&self, criterion: Criterion) -> Result<Smoothed<S>, Error> {
        let nodes = nodes(&self.patch_unchecked([[0.0; 2]; 4])?);
        let (w, energy, energy_at_zero, matrix) = match criterion {
            Criterion::SpeedVariation => least_speed_variation(&nodes)?,
            _ => quadratic_minimum(&nodes, criterion)?,
        };
        let mut eigenvalues: [f64; 8] = matrix.symmetric_eigenvalues().into();
        eigenvalues.sort_by(f64::total_cmp);
        let patch = self.patch_unchecked(from_fn(|c| [w[2 * c], w[2 * c + 1]]))?;
        Ok(Smoothed {
            patch,
            energy,
            energy_at_zero,
            eigenvalues,
        })
    }
}

impl<S: Strip> CoonsPatch<S> {
    /// The energy of this patch under a criterion.
    #[must_use]
    pub fn energy(&self, criterion: Criterion) -> f64 {
        let lines = lines(self);
        let mut sum = 0.0;
        for ([u, _], wu) in &lines {
            for ([_, v], wv) in &lines {
                let d = ORDERS.map(|[a, b]| self.derivative(u, v, a, b));
                let density = match criterion {
                    Criterion::SpeedVariation => {
                        speed_residuals(&d).map(|r| r * r).iter().sum::<f64>()
                    }
                    _ => criterion
                        .integrand(&d)
                        .map(|x| x.length_squared())
                        .iter()
                        .sum(),
                };
                sum += wu * wv * density;
            }
        }
        sum
    }
}

/// `G_kl = int <D B_k, D B_l>`, `g_k = int <D R_0, D B_k>`, `w = -G^-1 g`, `E = E_0 + g . w`.
fn quadratic_minimum(
    nodes: &[Node],
    criterion: Criterion,
) -> Result<(Vector8, f64, f64, Matrix8), Error> {
    let (mut matrix, mut gradient, mut at_zero) = (Matrix8::zeros(), Vector8::zeros(), 0.0);
    for node in nodes {
        let weight = node.weight;
        let d0 = criterion.integrand(&node.patch);
        let d: [[DVec3; 3]; 8] = from_fn(|k| criterion.integrand(&node.basis[k]));
        let dot = |a: &[DVec3; 3], b: &[DVec3; 3]| a[0].dot(b[0]) + a[1].dot(b[1]) + a[2].dot(b[2]);
        at_zero += weight * dot(&d0, &d0);
        for k in 0..8 {
            gradient[k] += weight * dot(&d0, &d[k]);
            for l in 0..=k {
                matrix[(k, l)] += weight * dot(&d[k], &d[l]);
            }
        }
    }
    matrix.fill_upper_triangle_with_lower_triangle();
    let w = solve(&matrix, &-gradient)?;
    Ok((w, at_zero + gradient.dot(&w), at_zero, matrix))
}

fn solve(matrix: &Matrix8, right: &Vector8) -> Result<Vector8, Error> {
    let factors = matrix.cholesky().ok_or(Error::DegenerateEnergy)?;
    let diagonal = factors.l_dirty().diagonal();
    let (least, largest) = (diagonal.min(), diagonal.max());
    if !(largest * largest <= CONDITION * least * least) {
        return Err(Error::DegenerateEnergy);
    }
    Ok(factors.solve(right))
}

/// `d|R_u|/du` and `d|R_v|/dv`.
fn speed_residuals(d: &Derivatives) -> [f64; 2] {
    [
        d[0].dot(d[2]) / d[0].length(),
        d[1].dot(d[4]) / d[1].length(),
    ]
}

/// Gauss-Newton with Levenberg's damping, from the Dirichlet minimum.
fn least_speed_variation(nodes: &[Node]) -> Result<(Vector8, f64, f64, Matrix8), Error> {
    let (start, ..) = quadratic_minimum(nodes, Criterion::Dirichlet)?;
    let (at_zero, ..) = speed_model(nodes, &Vector8::zeros());
    let mut w = start;
    let (mut energy, mut gradient, mut matrix) = speed_model(nodes, &w);
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let scale = matrix.trace() / 8.0;
        let step = solve(
            &(matrix + Matrix8::identity() * (damping * scale)),
            &-gradient,
        )?;
        let (trial, g, m) = speed_model(nodes, &(w + step));
        if trial <= energy {
            let gain = energy - trial;
            w += step;
            (energy, gradient, matrix) = (trial, g, m);
            damping = (0.1 * damping).max(1e-15);
            if gain <= CONVERGED * at_zero.max(f64::MIN_POSITIVE) {
                break;
            }
        } else {
            damping *= 10.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    Ok((w, energy, at_zero, matrix))
}

/// The speed variation at `w`, half its gradient, and the Gauss-Newton matrix.
fn speed_model(nodes: &[Node], w: &Vector8) -> (f64, Vector8, Matrix8) {
    let (mut energy, mut gradient, mut matrix) = (0.0, Vector8::zeros(), Matrix8::zeros());
    for Node {
        patch,
        basis,
        weight,
    } in nodes
    {
        for [first, second] in [[0, 2], [1, 4]] {
            let [velocity, acceleration] = [first, second]
                .map(|order| (0..8).fold(patch[order], |sum, k| sum + basis[k][order] * w[k]));
            let length = velocity.length();
            let unit = velocity / length;
            let residual = unit.dot(acceleration);
            let turning = (acceleration - unit * residual) / length;
            let slopes: [f64; 8] =
                from_fn(|k| unit.dot(basis[k][second]) + turning.dot(basis[k][first]));
            energy += weight * residual * residual;
            for k in 0..8 {
                let weighted = weight * slopes[k];
                gradient[k] += weighted * residual;
                for l in 0..=k {
                    matrix[(k, l)] += weighted * slopes[l];
                }
            }
        }
    }
    matrix.fill_upper_triangle_with_lower_triangle();
    (energy, gradient, matrix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AnalyticCurve, GeodesicStrip, Series, Surface, boundary_geodesic_curvature};

    /// Helices over an affine quadrangle of the unit cylinder's `(theta, z)`.
    fn cylinder() -> Rectangle {
        let corner = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.2, 1.3]];
        let helix = move |a: usize, b: usize| {
            GeodesicStrip::new(AnalyticCurve::new(move |t: Series| {
                let [theta, z] = [0, 1].map(|k| t * (corner[b][k] - corner[a][k]) + corner[a][k]);
                [theta.cos(), theta.sin(), z]
            }))
            .unwrap()
        };
        Rectangle::new([helix(0, 1), helix(0, 2), helix(2, 3), helix(1, 3)]).unwrap()
    }

    #[test]
    fn each_minimum_is_the_least_of_its_column_and_stationary() {
        let rectangle = cylinder();
        let criteria = [
            Criterion::SpeedVariation,
            Criterion::Dirichlet,
            Criterion::ThinPlate,
        ];
        let smoothed = criteria.map(|c| rectangle.smoothest(c).unwrap());
        for (c, criterion) in criteria.into_iter().enumerate() {
            let own = smoothed[c].patch.energy(criterion);
            assert!((own - smoothed[c].energy).abs() <= 1e-12 * smoothed[c].energy_at_zero);
            for other in &smoothed {
                assert!(own <= other.patch.energy(criterion) * (1.0 + 1e-9) + 1e-14);
            }
            for k in 0..8 {
                for step in [1e-3, -1e-3] {
                    let mut twists = *smoothed[c].patch.twists();
                    twists[k / 2][k % 2] += step;
                    assert!(
                        rectangle.patch(twists).unwrap().energy(criterion) > own,
                        "{criterion:?} {k}"
                    );
                }
            }
            assert!(boundary_geodesic_curvature(&smoothed[c].patch, 16) < 1e-12);
        }
        // The thin plate through four helices is very nearly the cylinder, and its speed hardly varies.
        let plate = &smoothed[2].patch;
        let radius = |u: f64, v: f64| plate.point(u, v).truncate().length();
        assert!(
            (radius(0.4, 0.6) - 1.0).abs() < 2e-5,
            "{}",
            radius(0.4, 0.6)
        );
        assert!(smoothed[0].energy < 1e-8);
    }
}
