//! The cubic Hermite functions `H0 = 1 - 3t² + 2t³`, `H1 = t(1-t)²`, `H2 = -t²(1-t)`, `H3 = 3t² - 2t³`.

/// Values, first and second derivatives of `[H0, H1, H2, H3]` at `t`.
pub(crate) fn hermite(t: f64) -> [[f64; 4]; 3] {
    let s = 1.0 - t;
    [
        [
            s * s * (1.0 + 2.0 * t),
            t * s * s,
            -t * t * s,
            t * t * (3.0 - 2.0 * t),
        ],
        [
            -6.0 * t * s,
            s * (1.0 - 3.0 * t),
            t * (3.0 * t - 2.0),
            6.0 * t * s,
        ],
        [12.0 * t - 6.0, 6.0 * t - 4.0, 6.0 * t - 2.0, 6.0 - 12.0 * t],
    ]
}

/// A cubic by value and slope at both ends, in the order of the Hermite functions: value at 0, slope at 0,
/// slope at 1, value at 1.
pub(crate) type HermiteCubic = [f64; 4];

/// Value and two derivatives of a cubic, given the Hermite functions at the place.
pub(crate) fn combine(cubic: &HermiteCubic, functions: &[[f64; 4]; 3]) -> [f64; 3] {
    functions.map(|row| row.iter().zip(cubic).map(|(h, c)| h * c).sum())
}

/// The Bernstein coefficients of a Hermite cubic.
pub(crate) fn to_bernstein([value0, slope0, slope1, value1]: HermiteCubic) -> [f64; 4] {
    [value0, value0 + slope0 / 3.0, value1 - slope1 / 3.0, value1]
}

/// The least of `sign * cubic` on `[0, 1]` and where, `sign` that of the start value.
pub(crate) fn least_same_sign(cubic: HermiteCubic) -> (f64, f64) {
    // Scaled to one, so that nothing overflows.
    let scale = cubic.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    if scale == 0.0 || !scale.is_finite() {
        return (if scale == 0.0 { 0.0 } else { f64::NAN }, 0.0);
    }
    let sign = if cubic[0] < 0.0 { -1.0 } else { 1.0 };
    let cubic = cubic.map(|c| c / scale);
    let value = |t: f64| sign * combine(&cubic, &hermite(t))[0];
    // The derivative is the quadratic a t² + b t + c.
    let [v0, s0, s1, v1] = cubic;
    let (a, b, c) = (
        3.0 * (2.0 * (v0 - v1) + s0 + s1),
        2.0 * (3.0 * (v1 - v0) - 2.0 * s0 - s1),
        s0,
    );
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + root.copysign(b));
    let stationary = [q / a, c / q];
    [0.0, 1.0]
        .into_iter()
        .chain(stationary.into_iter().filter(|t| *t > 0.0 && *t < 1.0))
        .map(|t| (scale * value(t), t))
        .min_by(|x, y| x.0.total_cmp(&y.0))
        .unwrap_or((scale * value(0.0), 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn end_data_and_derivatives() {
        let cubic = [1.5, -2.0, 0.7, 3.0];
        let (a, b) = (
            combine(&cubic, &hermite(0.0)),
            combine(&cubic, &hermite(1.0)),
        );
        assert_eq!([a[0], a[1], b[1], b[0]], cubic);
        let h = 1e-5;
        let [before, at, after] = [0.4 - h, 0.4, 0.4 + h].map(|t| combine(&cubic, &hermite(t)));
        assert!(((after[0] - before[0]) / (2.0 * h) - at[1]).abs() < 1e-9);
        assert!(((after[1] - before[1]) / (2.0 * h) - at[2]).abs() < 1e-9);
        assert!(
            (bezier_mass::bernstein::evaluate(&to_bernstein(cubic), 0.4) - at[0]).abs() < 1e-15
        );
    }

    #[test]
    fn the_least_value_is_found_inside() {
        let (least, at) = least_same_sign([1.0, -5.0, 5.0, 1.0]);
        assert!((at - 0.5).abs() < 1e-15 && (least + 0.25).abs() < 1e-15);
        assert_eq!(least_same_sign([-2.0, 0.0, 0.0, -1.0]), (1.0, 1.0));
    }
}
