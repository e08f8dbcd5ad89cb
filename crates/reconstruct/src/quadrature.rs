//! Gauss-Legendre quadrature.

/// Nodes and weights on `[0, 1]`, six points, exact for degree 11.
pub(crate) const SIX: [(f64, f64); 6] = [
    (0.033_765_242_898_423_98, 0.085_662_246_189_585_18),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_56, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_4, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_18),
];

/// Nodes and weights of the `n`-point rule on `[0, 1]`, exact for degree `2 n - 1`, by Newton's iteration on
/// the Legendre polynomial.
pub(crate) fn gauss(n: usize) -> Vec<(f64, f64)> {
    let mut rule = Vec::with_capacity(n);
    for i in 0..n {
        let mut x = -(core::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        // Quadratic convergence from Tricomi's guess: four steps reach rounding, one more is harmless.
        for _ in 0..6 {
            let (mut before, mut value) = (1.0, x);
            for k in 2..=n {
                let k = k as f64;
                (before, value) = (
                    value,
                    ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
                );
            }
            slope = n as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        rule.push((0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)));
    }
    rule
}

/// A rule on the triangle `l0 + l1 + l2 = 1` from the collapsed square: barycentric coordinates and weights
/// that add up to 1/2, exact for degree `2 n - 2`.
pub(crate) fn triangle(n: usize) -> Vec<([f64; 3], f64)> {
    let rule = gauss(n);
    let mut nodes = Vec::with_capacity(n * n);
    for &(x, wx) in &rule {
        for &(y, wy) in &rule {
            nodes.push(([1.0 - x, x * (1.0 - y), x * y], wx * wy * x));
        }
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monomials() {
        for n in 1..=24 {
            let rule = gauss(n);
            for degree in 0..2 * n {
                let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(degree as i32)).sum();
                assert!(
                    (sum - 1.0 / (degree as f64 + 1.0)).abs() < 4e-15,
                    "{n} {degree} {sum}"
                );
            }
        }
        for ((x, w), (y, z)) in SIX.into_iter().zip(gauss(6)) {
            assert!(
                (x - y).abs() < 4e-16 && (w - z).abs() < 4e-16,
                "{x} {y} {w} {z}"
            );
        }
    }

    #[test]
    fn triangle_monomials() {
        // The integral of l1^i l2^j over the unit triangle is i! j! / (i + j + 2)!.
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let rule = triangle(7);
        for i in 0..=6 {
            for j in 0..=6 {
                let sum: f64 = rule
                    .iter()
                    .map(|(l, w)| w * l[1].powi(i) * l[2].powi(j))
                    .sum();
                let exact = factorial(i) * factorial(j) / factorial(i + j + 2);
                assert!((sum - exact).abs() < 1e-15, "{i} {j}");
            }
        }
    }
}
