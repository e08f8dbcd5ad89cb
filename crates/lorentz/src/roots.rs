use bezier_mass::Parameter;

use crate::tolerance::{DECISION, ROUNDING};

/// The zeros of `(1-t)^2 c0 + 2t(1-t) c1 + t^2 c2` on the projective line, in the order of the formula.
///
/// With `y = t/(1-t)` this is `c2 y^2 + 2 c1 y + c0`. A discriminant of zero to rounding gives one (double) zero;
/// coefficients that all vanish give none.
pub(crate) fn quadratic_roots([c0, c1, c2]: [f64; 3]) -> Vec<Parameter> {
    let scale = c0.abs().max(c1.abs()).max(c2.abs());
    if !(scale > 0.0 && scale.is_finite()) {
        return Vec::new();
    }
    let [c0, c1, c2] = [c0 / scale, c1 / scale, c2 / scale];
    let discriminant = c1 * c1 - c0 * c2;
    let terms = c1 * c1 + (c0 * c2).abs();
    // t/(1-t) = numerator/denominator, that is t = numerator / (numerator + denominator).
    let ratio =
        |numerator: f64, denominator: f64| Parameter::new(numerator, numerator + denominator).ok();
    if discriminant.abs() <= DECISION * terms.max(ROUNDING) {
        // Double zero: y = -c1/c2 = -c0/c1, whichever has the larger terms.
        let root = if c2.abs() >= c0.abs() {
            ratio(-c1, c2)
        } else {
            ratio(-c0, c1)
        };
        return root.into_iter().collect();
    }
    if discriminant < 0.0 {
        return Vec::new();
    }
    let sum = -c1 - discriminant.sqrt().copysign(c1);
    [ratio(sum, c2), ratio(c0, sum)]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(coefficients: [f64; 3]) -> Vec<Option<f64>> {
        quadratic_roots(coefficients)
            .into_iter()
            .map(Parameter::value)
            .collect()
    }

    #[test]
    fn simple_double_infinite_and_missing_zeros() {
        // (t - 1/4)(t - 1/2) has Bernstein coefficients 1/8, -1/4, 3/8.
        let mut roots: Vec<f64> = values([0.125, -0.25, 0.375])
            .into_iter()
            .flatten()
            .collect();
        roots.sort_by(f64::total_cmp);
        assert!((roots[0] - 0.25).abs() < 1e-15 && (roots[1] - 0.5).abs() < 1e-15);
        assert_eq!(values([1.0, 0.0, 1.0]), []);
        assert_eq!(values([0.0, 0.0, 0.0]), []);
        assert_eq!(values([1.0, 0.0, 0.0]), [Some(1.0)]);
        assert_eq!(values([0.0, 0.0, 1.0]), [Some(0.0)]);
        // t - 1/4 is a quadratic with one zero at infinity.
        let roots = values([-0.25, 0.25, 0.75]);
        assert!(roots.contains(&None) && roots.contains(&Some(0.25)));
    }
}
