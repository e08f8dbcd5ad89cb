//! Integration of tangents into positions.

use crate::{Error, quadrature::SIX};
use bezier_mass::VectorSpace;

/// One six-point Gauss step over `[start, end]`.
pub(crate) fn gauss_step<V: VectorSpace>(tangent: &impl Fn(f64) -> V, start: f64, end: f64) -> V {
    let length = end - start;
    SIX.iter().fold(V::ZERO, |sum, (node, weight)| {
        sum.plus(tangent(start + node * length).times(weight * length))
    })
}

/// Bisections after which an integrand is given up: an interval of 2^-24 of a sensor spacing.
const MAX_DEPTH: u32 = 24;

/// The integral over `[start, end]` and an estimate of its error, bisecting until two half steps agree with
/// the whole to `accuracy`. The finer value is returned with the difference of the coarser one, so the
/// estimate is an over-estimate by about `2^12` for a smooth integrand.
pub(crate) fn integrate<V: VectorSpace>(
    tangent: &impl Fn(f64) -> V,
    start: f64,
    end: f64,
    accuracy: f64,
) -> Result<(V, f64), Error> {
    bisect(
        tangent,
        [start, end],
        gauss_step(tangent, start, end),
        accuracy,
        0,
    )
}

fn bisect<V: VectorSpace>(
    tangent: &impl Fn(f64) -> V,
    [start, end]: [f64; 2],
    whole: V,
    accuracy: f64,
    depth: u32,
) -> Result<(V, f64), Error> {
    let middle = 0.5 * (start + end);
    let (left, right) = (
        gauss_step(tangent, start, middle),
        gauss_step(tangent, middle, end),
    );
    let fine = left.plus(right);
    let error = fine.minus(whole).magnitude();
    if error <= accuracy {
        return Ok((fine, error));
    }
    if depth == MAX_DEPTH || !fine.is_finite() {
        return Err(Error::NotIntegrable { start, end, error });
    }
    let (left, e0) = bisect(tangent, [start, middle], left, 0.5 * accuracy, depth + 1)?;
    let (right, e1) = bisect(tangent, [middle, end], right, 0.5 * accuracy, depth + 1)?;
    Ok((left.plus(right), e0 + e1))
}

/// Relative accuracy of positions unless another is asked for: the rounding of a sum of some hundred terms.
pub(crate) const ACCURACY: f64 = 1e-13;

/// Positions at all knots, starting at the origin, to `accuracy` (absolute) in all, and the error estimate.
pub(crate) fn positions<V: VectorSpace>(
    knots: &[f64],
    tangent: &impl Fn(f64) -> V,
    accuracy: f64,
) -> Result<(Vec<V>, f64), Error> {
    let mut points = vec![V::ZERO];
    let (mut point, mut error) = (V::ZERO, 0.0);
    let share = accuracy / knots.len() as f64;
    for pair in knots.windows(2) {
        let (step, local) = integrate(tangent, pair[0], pair[1], share)?;
        point = point.plus(step);
        error += local;
        points.push(point);
    }
    Ok((points, error))
}
