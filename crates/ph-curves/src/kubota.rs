//! Kubota's theorem backwards: the real factor and the square in a Pythagorean hodograph.
//!
//! Polynomials are written by powers of `x = t / (1 - t)` here: Bernstein coefficients times their binomials, whose
//! products are plain convolutions.

use bezier_mass::bernstein;
use glam::DVec2;

use crate::Error;
use crate::complex::{divide, sqrt};

/// A hodograph counts as Pythagorean if `h w²` differs from it by this share of its largest coefficient: far above the
/// rounding of control points given to double precision, far below any curve that is not meant to be one. The same share
/// tells a common factor of `x'` and `y'` from none.
const TOLERANCE: f64 = 1e-9;

/// The real common factor `h` and the preimage `w` with `h w²` equal to the hodograph, all by Bernstein coefficients on
/// `[0, 1]`. If `h` has one sign it is positive, with mean 1.
///
/// With `p = w²` the cofactors `a = Re p` and `b = Im p` of least degree solve the linear equation `x' b = y' a`; then
/// `h = (x' a + y' b) / (a² + b²)`, and the hodograph is Pythagorean if `p` is the square of a polynomial.
///
/// # Errors
/// [`Error::ZeroDirection`] if the hodograph vanishes; [`Error::NotPythagorean`].
pub(crate) fn factorise(hodograph: &[DVec2]) -> Result<(Vec<f64>, Vec<DVec2>), Error> {
    let size = largest(hodograph.iter().map(|z| z.length()));
    if size == 0.0 {
        return Err(Error::ZeroDirection {
            what: "hodograph of the curve",
        });
    }
    let degree = hodograph.len() - 1;
    let scaled: Vec<DVec2> = hodograph
        .iter()
        .enumerate()
        .map(|(k, z)| *z * (bernstein::binomial(degree, k) / size))
        .collect();
    let mut relative_residual = 1.0;
    for half in 0..=degree / 2 {
        let Some(cofactors) = cofactors(&scaled, 2 * half) else {
            continue;
        };
        let Some((mut factor, mut square)) = real_quotient(&scaled, cofactors) else {
            continue;
        };
        if mean(&factor) < 0.0 {
            // p = -(i w)²
            factor.iter_mut().for_each(|h| *h = -*h);
            square.iter_mut().for_each(|p| *p = -*p);
        }
        let Some(root) = square_root(&square) else {
            continue;
        };
        let back = convolve(
            &convolve(&root, &root, |a, b| a.rotate(*b)),
            &factor,
            |a, h| *a * *h,
        );
        let misses = back.iter().zip(&scaled).map(|(a, b)| (*a - *b).length());
        let residual = largest(misses);
        relative_residual = residual.min(relative_residual);
        if residual <= TOLERANCE * largest(scaled.iter().map(|z| z.length())) {
            let mean = mean(&factor);
            let mut factor: Vec<f64> = factor
                .iter()
                .enumerate()
                .map(|(k, h)| h / bernstein::binomial(factor.len() - 1, k))
                .collect();
            // The mean of the factor is 1, so that no factor is exactly that.
            let scale = if mean > 0.0 { mean } else { 1.0 };
            factor.iter_mut().for_each(|h| *h /= scale);
            let stretch = (size * scale).sqrt();
            let preimage = root
                .iter()
                .enumerate()
                .map(|(k, w)| *w * (stretch / bernstein::binomial(half, k)))
                .collect();
            return Ok((factor, preimage));
        }
    }
    Err(Error::NotPythagorean { relative_residual })
}

/// The integral over `[0, 1]`: the mean of the Bernstein coefficients.
fn mean(scaled: &[f64]) -> f64 {
    let degree = scaled.len() - 1;
    let coefficients = scaled.iter().enumerate();
    let sum: f64 = coefficients
        .map(|(k, h)| h / bernstein::binomial(degree, k))
        .sum();
    sum / scaled.len() as f64
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

fn convolve<A, B>(a: &[A], b: &[B], times: impl Fn(&A, &B) -> DVec2) -> Vec<DVec2> {
    let mut product = vec![DVec2::ZERO; a.len() + b.len() - 1];
    for (i, a) in a.iter().enumerate() {
        for (j, b) in b.iter().enumerate() {
            product[i + j] += times(a, b);
        }
    }
    product
}

/// A polynomial `a + i b` of this degree with `x' b = y' a`, if there is one: the kernel of the system's matrix.
fn cofactors(z: &[DVec2], degree: usize) -> Option<Vec<DVec2>> {
    let count = degree + 1;
    if count == z.len() {
        // No common factor: the cofactors are x' and y' themselves, however close to one another their roots are.
        return Some(z.to_vec());
    }
    let rows = z.len() + degree;
    let mut matrix = vec![vec![0.0; 2 * count]; rows];
    for (i, z) in z.iter().enumerate() {
        for j in 0..count {
            matrix[i + j][j] = -z.y;
            matrix[i + j][count + j] = z.x;
        }
    }
    let kernel = kernel(matrix, TOLERANCE)?;
    Some(
        (0..count)
            .map(|j| DVec2::new(kernel[j], kernel[count + j]))
            .collect(),
    )
}

/// A vector that the matrix maps to zero, by elimination with complete pivoting; pivots below `tolerance` of the first are
/// zeros.
fn kernel(mut matrix: Vec<Vec<f64>>, tolerance: f64) -> Option<Vec<f64>> {
    let (rows, columns) = (matrix.len(), matrix.first()?.len());
    let mut order: Vec<usize> = (0..columns).collect();
    let mut first_pivot = 0.0;
    let mut rank = 0;
    while rank < rows.min(columns) {
        let places = (rank..rows).flat_map(|i| (rank..columns).map(move |j| (i, j)));
        let (i, j) =
            places.max_by(|a, b| matrix[a.0][a.1].abs().total_cmp(&matrix[b.0][b.1].abs()))?;
        let pivot = matrix[i][j];
        if rank == 0 {
            first_pivot = pivot.abs();
        }
        if pivot.abs() <= tolerance * first_pivot {
            break;
        }
        matrix.swap(rank, i);
        order.swap(rank, j);
        for row in &mut matrix {
            row.swap(rank, j);
        }
        let (done, rest) = matrix.split_at_mut(rank + 1);
        for row in rest {
            let share = row[rank] / pivot;
            for (x, p) in row.iter_mut().zip(&done[rank]).skip(rank) {
                *x -= share * p;
            }
        }
        rank += 1;
    }
    if rank == columns {
        return None;
    }
    // One free unknown is 1, the others 0.
    let mut permuted = vec![0.0; columns];
    permuted[rank] = 1.0;
    for i in (0..rank).rev() {
        let known: f64 = (i + 1..columns).map(|j| matrix[i][j] * permuted[j]).sum();
        permuted[i] = -known / matrix[i][i];
    }
    let mut kernel = vec![0.0; columns];
    for (value, place) in permuted.iter().zip(order) {
        kernel[place] = *value;
    }
    Some(kernel)
}

/// The real polynomial `z / p`, and p again.
fn real_quotient(z: &[DVec2], p: Vec<DVec2>) -> Option<(Vec<f64>, Vec<DVec2>)> {
    let size = largest(p.iter().map(|c| c.length()));
    let first = *p.first()?;
    if first.length() <= TOLERANCE * size {
        return None;
    }
    let mut quotient: Vec<f64> = Vec::with_capacity(z.len() + 1 - p.len());
    for k in 0..=z.len() - p.len() {
        let known =
            (1..p.len().min(k + 1)).fold(DVec2::ZERO, |sum, i| sum + p[i] * quotient[k - i]);
        quotient.push(divide(z[k] - known, first).x);
    }
    Some((quotient, p))
}

/// The polynomial whose square this is, if there is one: solved for from the start, coefficient by coefficient, so that
/// only the first half of the equations is met by construction.
fn square_root(square: &[DVec2]) -> Option<Vec<DVec2>> {
    let half = square.len().checked_sub(1)? / 2;
    let first = sqrt(*square.first()?);
    if first == DVec2::ZERO {
        return None;
    }
    let mut root = vec![first];
    for k in 1..=half {
        let known = (1..k).fold(DVec2::ZERO, |sum, i| sum + root[i].rotate(root[k - i]));
        root.push(divide(square[k] - known, 2.0 * first));
    }
    Some(root)
}
