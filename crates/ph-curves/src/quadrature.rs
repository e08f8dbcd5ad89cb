//! Gauss-Legendre quadrature with sixteen points, for criteria that have no closed form.

/// Positive nodes and weights of the 16-point rule on `[-1, 1]` (Abramowitz and Stegun, table 25.4).
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_5),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_7),
    (0.755_404_408_355_003, 0.124_628_971_255_533_9),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_8),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_9),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_1),
];

/// The integral of `f` from `from` to `to`, 16 points on each of `pieces` equal parts: exact for polynomials of degree 31.
pub(crate) fn integrate(from: f64, to: f64, pieces: usize, f: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * (to - from) / pieces.max(1) as f64;
    (0..pieces.max(1))
        .map(|piece| {
            let centre = from + half * (2 * piece + 1) as f64;
            half * NODES
                .iter()
                .map(|(x, w)| w * (f(centre - half * x) + f(centre + half * x)))
                .sum::<f64>()
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::integrate;

    #[test]
    fn monomials_up_to_degree_31_are_exact() {
        for degree in 0..32 {
            let exact = (2.0_f64.powi(degree + 1) - 1.0) / f64::from(degree + 1);
            let found = integrate(1.0, 2.0, 1, |x| x.powi(degree));
            // The nodes are given to 16 digits and enter with the power `degree`.
            assert!(
                (found - exact).abs() <= 4e-15 * f64::from(degree + 1) * exact,
                "degree {degree}: {found} {exact}"
            );
        }
    }
}
