//! Polynomials of fixed degree, mostly by Bernstein coefficients on `[0, 1]`.

/// How often a polynomial is halved at most to show that it is positive.
const HALVINGS: usize = 3;

/// Whether a polynomial is positive on `[0, 1]` by the signs of its Bernstein coefficients, there or on repeatedly halved parts.
pub(crate) fn is_positive<const N: usize>(coefficients: &[f64; N]) -> bool {
    is_positive_on_parts(coefficients, HALVINGS)
}

fn is_positive_on_parts<const N: usize>(coefficients: &[f64; N], halvings: usize) -> bool {
    if coefficients.iter().all(|c| *c > 0.0) {
        return true;
    }
    if halvings == 0 || !(coefficients[0] > 0.0 && coefficients[N - 1] > 0.0) {
        return false;
    }
    let (mut left, mut right) = (*coefficients, *coefficients);
    for (level, first) in left.iter_mut().enumerate() {
        *first = right[0];
        for k in 1..N - level {
            right[k - 1] = 0.5 * (right[k - 1] + right[k]);
        }
    }
    is_positive_on_parts(&left, halvings - 1) && is_positive_on_parts(&right, halvings - 1)
}

/// The least and the greatest of some coefficients: bounds of the values.
pub(crate) fn range(coefficients: &[f64]) -> [f64; 2] {
    coefficients
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], c| {
            [least.min(*c), most.max(*c)]
        })
}

/// The certified roots in `[0, 1]`, in increasing order; none of zero.
pub(crate) fn roots(coefficients: &[f64]) -> Vec<f64> {
    let mut solver = variation::Solver::new().without_exact();
    solver.roots(coefficients).map_or_else(
        |_| Vec::new(),
        |roots| roots.iter().map(|root| root.value()).collect(),
    )
}

/// Product of Bernstein polynomials with `A` and `B` coefficients; `C = A + B - 1`.
pub(crate) fn product<const A: usize, const B: usize, const C: usize>(
    a: &[f64; A],
    b: &[f64; B],
) -> [f64; C] {
    let mut sum = [0.0; C];
    for (i, a) in a.iter().enumerate() {
        let a = a * const { binomials::<A>(A - 1) }[i];
        for (j, b) in b.iter().enumerate() {
            sum[i + j] += a * b * const { binomials::<B>(B - 1) }[j];
        }
    }
    for (sum, binomial) in sum.iter_mut().zip(const { binomials::<C>(C - 1) }) {
        *sum /= binomial;
    }
    sum
}

/// The binomial coefficients of a degree below `N`.
pub(crate) const fn binomials<const N: usize>(degree: usize) -> [f64; N] {
    let mut row = [0.0; N];
    row[0] = 1.0;
    let mut k = 1;
    while k <= degree {
        row[k] = row[k - 1] * (degree + 1 - k) as f64 / k as f64;
        k += 1;
    }
    row
}

/// Bernstein coefficients of the quintic with these values and first two derivatives at both ends, counted from each end.
pub(crate) fn quintic(first: [f64; 3], last: [f64; 3]) -> [f64; 6] {
    let ends = |[value, slope, bend]: [f64; 3]| {
        let next = value + slope / 5.0;
        [value, next, bend / 20.0 + 2.0 * next - value]
    };
    let ([a, b, c], [f, e, d]) = (ends(first), ends(last));
    [a, b, c, d, e, f]
}

/// Value of a Bernstein polynomial of degree 5 at `t = 1 - s`.
#[inline]
pub(crate) fn bernstein_5(g: &[f64; 6], s: f64, t: f64) -> f64 {
    let (s2, t2) = (s * s, t * t);
    let low = s2 * g[0] + 5.0 * s * t * g[1] + 10.0 * t2 * g[2];
    let high = 10.0 * s2 * g[3] + 5.0 * s * t * g[4] + t2 * g[5];
    s2 * s * low + t2 * t * high
}

/// A polynomial through values at nodes: Newton's divided differences.
pub(crate) struct Newton<const K: usize> {
    nodes: [f64; K],
    coefficients: [f64; K],
}

impl<const K: usize> Newton<K> {
    pub(crate) fn through(nodes: [f64; K], mut coefficients: [f64; K]) -> Self {
        for level in 1..K {
            for k in (level..K).rev() {
                coefficients[k] =
                    (coefficients[k] - coefficients[k - 1]) / (nodes[k] - nodes[k - level]);
            }
        }
        Self {
            nodes,
            coefficients,
        }
    }

    #[inline]
    pub(crate) fn value(&self, t: f64) -> f64 {
        let mut value = 0.0;
        for k in (0..K).rev() {
            value = value * (t - self.nodes[k]) + self.coefficients[k];
        }
        value
    }

    /// Its coefficients of `s^(K-1-k) t^k`, `s = 1 - t`: Horner's scheme with factors `t - node = (1 - node) t - node s`.
    pub(crate) fn homogeneous(&self) -> [f64; K] {
        let mut c = [0.0; K];
        c[0] = self.coefficients[K - 1];
        for degree in 1..K {
            let (node, constant) = (
                self.nodes[K - 1 - degree],
                self.coefficients[K - 1 - degree],
            );
            let row = binomials::<K>(degree);
            let mut below = 0.0;
            for k in 0..=degree {
                let here = c[k];
                c[k] = (1.0 - node) * below - node * here + constant * row[k];
                below = here;
            }
        }
        c
    }
}
