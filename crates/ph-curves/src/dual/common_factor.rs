//! Common factors of the coordinates of a homogeneous curve, and the curve without them.

use bezier_mass::bernstein;
use glam::DVec3;

use super::COINCIDENT;

/// Coefficients of a remainder below this, relative to the largest coefficient, are taken for zero: a
/// common factor at a certified root leaves some ulps, grown by the division.
const REMAINDER: f64 = 1e-9;
/// Pivots below this share of the first one are rounding: some ulps, grown by the elimination.
const PIVOT: f64 = 1e-12;

/// The quotient by the factor that vanishes at `root` alone, if all coordinates have it.
///
/// In Bernstein form `(t - r)` is `(-r, 1 - r)`. The division runs from both ends towards the middle, each
/// half in the direction in which it does not amplify errors.
pub(super) fn divide_by_root(coefficients: &[DVec3], root: f64) -> Option<Vec<DVec3>> {
    let n = coefficients.len().checked_sub(1)?;
    let size = largest(coefficients);
    // n c_k = (n - k) (-r) d_k + k (1 - r) d_{k-1}, for the quotient d of degree n - 1.
    let mut quotient = vec![DVec3::ZERO; n];
    let split = ((n as f64) * root).round() as usize;
    for k in 0..split.min(n) {
        let carried = if k > 0 {
            quotient[k - 1] * (k as f64 * (1.0 - root))
        } else {
            DVec3::ZERO
        };
        quotient[k] = (coefficients[k] * n as f64 - carried) / (-(root * (n - k) as f64));
    }
    for k in (split..n).rev() {
        let carried = if k + 1 < n {
            quotient[k + 1] * (-(root * (n - k - 1) as f64))
        } else {
            DVec3::ZERO
        };
        quotient[k] = (coefficients[k + 1] * n as f64 - carried) / ((k + 1) as f64 * (1.0 - root));
    }
    let product = bernstein::product(&[-root, 1.0 - root], &quotient);
    let defect = product
        .iter()
        .zip(coefficients)
        .map(|(a, b)| (*a - *b).abs().max_element())
        .fold(0.0, f64::max);
    (n > 0 && defect <= REMAINDER * size && quotient.iter().all(|x| x.is_finite()))
        .then_some(quotient)
}

/// The quotient of a polynomial by the square of the factor that vanishes at `root` alone, if it has it.
pub(super) fn divide_by_double_root(coefficients: &[f64], root: f64) -> Option<Vec<f64>> {
    if coefficients.iter().all(|c| *c == 0.0) {
        return Some(coefficients.to_vec());
    }
    let vectors: Vec<DVec3> = coefficients.iter().map(|c| DVec3::X * *c).collect();
    let quotient = divide_by_root(&divide_by_root(&vectors, root)?, root)?;
    Some(quotient.iter().map(|x| x.x).collect())
}

/// The lines of least class, two or more, that are parallel vectors to these at every parameter, if they are
/// fewer: the same curve without the common factor of its coordinates.
///
/// The sign is that of the given lines behind the start.
pub(super) fn without_common_factor(lines: &[DVec3]) -> Option<Vec<DVec3>> {
    let size = largest(lines);
    let first = lines
        .iter()
        .find(|u| u.abs().max_element() > PIVOT * size)?;
    for class in 2..lines.len().saturating_sub(1) {
        if let Some(reduced) = parallel(lines, class).filter(|reduced| divides(reduced, lines)) {
            let start = *reduced.first()?;
            let scale = (size / largest(&reduced)).copysign(start.dot(*first));
            return Some(reduced.iter().map(|u| *u * scale).collect());
        }
    }
    None
}

/// Whether all of these vectors are parallel: one line only.
pub(super) fn is_one_line(lines: &[DVec3]) -> bool {
    let longest = lines.iter().fold(DVec3::ZERO, |long, &u| {
        if u.length_squared() > long.length_squared() {
            u
        } else {
            long
        }
    });
    let size = longest.length_squared();
    lines
        .iter()
        .all(|u| u.cross(longest).length() <= COINCIDENT * size)
}

/// The only solution `V` of degree `class` of the linear equations `U(t) x V(t) = 0`.
fn parallel(lines: &[DVec3], class: usize) -> Option<Vec<DVec3>> {
    let columns = (0..=class)
        .flat_map(|k| DVec3::AXES.map(|axis| (k, axis)))
        .map(|(k, axis)| {
            let mut basis = vec![DVec3::ZERO; class + 1];
            basis[k] = axis;
            flat(&bernstein::product_with(lines, &basis, |a, b| a.cross(*b)))
        })
        .collect();
    let solution = kernel(columns)?;
    Some(solution.chunks_exact(3).map(DVec3::from_slice).collect())
}

/// Whether these lines are the reduced ones times a polynomial, to rounding.
fn divides(reduced: &[DVec3], lines: &[DVec3]) -> bool {
    let degree = lines.len() - reduced.len();
    let mut columns: Vec<Vec<f64>> = (0..=degree)
        .map(|k| {
            let mut basis = vec![0.0; degree + 1];
            basis[k] = 1.0;
            flat(&bernstein::product(&basis, reduced))
        })
        .collect();
    columns.push(flat(lines));
    let Some(factors) = kernel(columns.clone()) else {
        return false;
    };
    let remainder = (0..3 * lines.len())
        .map(|i| columns.iter().zip(&factors).map(|(c, f)| c[i] * f).sum())
        .fold(0.0, |most: f64, entry: f64| most.max(entry.abs()));
    remainder <= PIVOT * largest(lines) * factors[degree + 1].abs()
}

fn flat(vectors: &[DVec3]) -> Vec<f64> {
    vectors.iter().flat_map(DVec3::to_array).collect()
}

/// The factors with which these columns add up to zero, if there is one choice but for scale: elimination
/// with full pivoting.
fn kernel(mut columns: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let (count, height) = (columns.len(), columns.first()?.len());
    let mut order: Vec<usize> = (0..count).collect();
    let mut greatest = 0.0_f64;
    for step in 0..count {
        let (mut pivot, mut at) = (0.0, (step, step));
        for (j, column) in columns.iter().enumerate().skip(step) {
            for (i, entry) in column.iter().enumerate().skip(step) {
                if entry.abs() > pivot {
                    (pivot, at) = (entry.abs(), (i, j));
                }
            }
        }
        greatest = greatest.max(pivot);
        if pivot <= PIVOT * greatest || step + 1 == height {
            if step + 1 < count || pivot > PIVOT * greatest {
                return None;
            }
            break;
        }
        if step + 1 == count {
            return None;
        }
        columns.swap(step, at.1);
        order.swap(step, at.1);
        for column in &mut columns {
            column.swap(step, at.0);
        }
        let (done, rest) = columns.split_at_mut(step + 1);
        let lead = &done[step];
        for column in rest {
            let factor = column[step] / lead[step];
            for (entry, lead) in column.iter_mut().zip(lead).skip(step + 1) {
                *entry -= factor * lead;
            }
        }
    }
    // Row i of the triangle: the pivots of the columns i, i + 1, ... add up to zero.
    let mut solution = vec![0.0; count];
    solution[order[count - 1]] = 1.0;
    for i in (0..count - 1).rev() {
        let sum: f64 = (i + 1..count)
            .map(|j| columns[j][i] * solution[order[j]])
            .sum();
        solution[order[i]] = -sum / columns[i][i];
    }
    Some(solution)
}

fn largest(vectors: &[DVec3]) -> f64 {
    vectors
        .iter()
        .map(|x| x.abs().max_element())
        .fold(0.0, f64::max)
}
