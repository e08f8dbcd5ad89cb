//! Interpolation of sampled points by a cubic spline with continuous second derivative.

use glam::DVec2;

/// The cubic spline through `points` with chord-length knots as Bézier cubics: natural at the ends or periodic.
///
/// The points are finite, consecutive ones differ, and there are at least two (three if closed).
pub(crate) fn interpolate(points: &[DVec2], closed: bool) -> Vec<[DVec2; 4]> {
    let n = points.len();
    let spans = if closed { n } else { n - 1 };
    let step: Vec<f64> = (0..spans)
        .map(|i| (points[(i + 1) % n] - points[i]).length())
        .collect();
    let slope: Vec<DVec2> = (0..spans)
        .map(|i| (points[(i + 1) % n] - points[i]) / step[i])
        .collect();
    let velocities = if closed {
        periodic(&step, &slope)
    } else {
        natural(&step, &slope)
    };
    (0..spans)
        .map(|i| {
            let (a, b) = (points[i], points[(i + 1) % n]);
            let third = step[i] / 3.0;
            [
                a,
                a + velocities[i] * third,
                b - velocities[(i + 1) % n] * third,
                b,
            ]
        })
        .collect()
}

/// Velocities at the knots of the natural spline: `v_{i-1}/h_{i-1} + 2 (1/h_{i-1} + 1/h_i) v_i + v_{i+1}/h_i`
/// `= 3 (s_{i-1}/h_{i-1} + s_i/h_i)`, with zero second derivative at the ends.
fn natural(step: &[f64], slope: &[DVec2]) -> Vec<DVec2> {
    let n = step.len() + 1;
    let weight = |i: usize| if i < step.len() { 1.0 / step[i] } else { 0.0 };
    let before = |i: usize| if i > 0 { 1.0 / step[i - 1] } else { 0.0 };
    let pull = |i: usize| {
        if i < slope.len() {
            slope[i] * weight(i)
        } else {
            DVec2::ZERO
        }
    };
    let diagonal: Vec<f64> = (0..n).map(|i| 2.0 * (before(i) + weight(i))).collect();
    let right: Vec<DVec2> = (0..n)
        .map(|i| 3.0 * (if i > 0 { pull(i - 1) } else { DVec2::ZERO } + pull(i)))
        .collect();
    solve_tridiagonal(
        &diagonal,
        &step.iter().map(|h| 1.0 / h).collect::<Vec<_>>(),
        &right,
    )
}

/// The same with indices modulo n: the corner entries are moved into a rank-one correction (Sherman-Morrison).
fn periodic(step: &[f64], slope: &[DVec2]) -> Vec<DVec2> {
    let n = step.len();
    let weight: Vec<f64> = step.iter().map(|h| 1.0 / h).collect();
    let before = |i: usize| (i + n - 1) % n;
    let mut diagonal: Vec<f64> = (0..n)
        .map(|i| 2.0 * (weight[before(i)] + weight[i]))
        .collect();
    let right: Vec<DVec2> = (0..n)
        .map(|i| 3.0 * (slope[before(i)] * weight[before(i)] + slope[i] * weight[i]))
        .collect();
    let corner = weight[n - 1];
    let gamma = -diagonal[0];
    diagonal[0] -= gamma;
    diagonal[n - 1] -= corner * corner / gamma;
    let plain = solve_tridiagonal(&diagonal, &weight[..n - 1], &right);
    let mut unit = vec![DVec2::ZERO; n];
    unit[0] = DVec2::splat(gamma);
    unit[n - 1] = DVec2::splat(corner);
    let correction = solve_tridiagonal(&diagonal, &weight[..n - 1], &unit);
    let share = corner / gamma;
    let factor =
        (plain[0] + plain[n - 1] * share) / (1.0 + correction[0].x + correction[n - 1].x * share);
    plain
        .iter()
        .zip(&correction)
        .map(|(p, c)| *p - factor * c.x)
        .collect()
}

/// Solves a symmetric, diagonally dominant tridiagonal system (Thomas).
fn solve_tridiagonal(diagonal: &[f64], off_diagonal: &[f64], right: &[DVec2]) -> Vec<DVec2> {
    let mut pivot = diagonal.to_vec();
    let mut solution = right.to_vec();
    for i in 1..pivot.len() {
        let factor = off_diagonal[i - 1] / pivot[i - 1];
        pivot[i] -= factor * off_diagonal[i - 1];
        solution[i] = solution[i] - solution[i - 1] * factor;
    }
    for i in (0..pivot.len()).rev() {
        let known = if i + 1 < pivot.len() {
            solution[i + 1] * off_diagonal[i]
        } else {
            DVec2::ZERO
        };
        solution[i] = (solution[i] - known) / pivot[i];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Second derivative by chord length at the end of one cubic and the start of the next.
    fn second_derivatives(cubics: &[[DVec2; 4]], i: usize) -> (DVec2, DVec2) {
        let step = |c: &[DVec2; 4]| (c[3] - c[0]).length();
        let (a, b) = (cubics[i], cubics[(i + 1) % cubics.len()]);
        (
            6.0 * (a[3] - 2.0 * a[2] + a[1]) / (step(&a) * step(&a)),
            6.0 * (b[2] - 2.0 * b[1] + b[0]) / (step(&b) * step(&b)),
        )
    }

    #[test]
    fn the_second_derivative_is_continuous() {
        let points =
            [(0.0, 0.0), (1.0, 0.3), (1.4, 2.0), (-0.2, 2.5), (-1.0, 1.0)].map(DVec2::from);
        for closed in [false, true] {
            let cubics = interpolate(&points, closed);
            assert_eq!(cubics.len(), if closed { 5 } else { 4 });
            for i in 0..if closed { 5 } else { 3 } {
                let (before, after) = second_derivatives(&cubics, i);
                assert!((before - after).length() < 1e-12, "{closed} {i}");
                assert_eq!(cubics[i][3], cubics[(i + 1) % cubics.len()][0]);
            }
        }
        let natural = interpolate(&points, false);
        assert!((natural[0][2] - 2.0 * natural[0][1] + natural[0][0]).length() < 1e-14);
    }
}
