//! Exact input: polynomials and curves given in rational numbers, answered without any rounding.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::Error;
use crate::arithmetic::{Number, binomial, compose};
use crate::dyadic::Exact;
use crate::exact::Decomposition;
use crate::finite::finite_degree;

impl Number for BigRational {
    fn exactly(x: f64) -> Self {
        Exact::exactly(x).to_rational()
    }

    fn sum(&self, other: &Self) -> Self {
        self + other
    }

    fn difference(&self, other: &Self) -> Self {
        self - other
    }

    fn product(&self, other: &Self) -> Self {
        self * other
    }

    fn times(&self, factor: u128) -> Self {
        self * BigInt::from(factor)
    }
}

/// A polynomial with rational Bernstein coefficients on `[0, 1]`.
///
/// # Examples
/// ```
/// use variation::{BigInt, BigRational, ExactPolynomial};
/// // (3 t - 1)^2 / 9: the double root 1/3 has no binary fraction.
/// let ninth = |k: i64| BigRational::new(BigInt::from(k), BigInt::from(9));
/// let polynomial = ExactPolynomial::try_new(vec![ninth(1), ninth(-2), ninth(4)])?;
/// let roots = polynomial.roots(1e-12)?;
/// assert_eq!((roots.len(), roots[0].multiplicity), (1, 2));
/// # Ok::<(), variation::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ExactPolynomial {
    coefficients: Vec<BigRational>,
}

/// One distinct root of an [`ExactPolynomial`], enclosed.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactRoot {
    /// Lower end of the enclosure.
    pub lo: BigRational,
    /// Upper end of the enclosure.
    pub hi: BigRational,
    /// Multiplicity.
    pub multiplicity: u32,
}

impl ExactPolynomial {
    /// The polynomial with these Bernstein coefficients.
    ///
    /// # Errors
    /// [`Error::NoCoefficients`].
    pub fn try_new(coefficients: Vec<BigRational>) -> Result<Self, Error> {
        if coefficients.is_empty() {
            Err(Error::NoCoefficients)
        } else {
            Ok(Self { coefficients })
        }
    }

    /// The Bernstein coefficients.
    #[must_use]
    pub fn coefficients(&self) -> &[BigRational] {
        &self.coefficients
    }

    /// The distinct roots in `[0, 1]`, ascending, each enclosed to `tolerance` (at least a few units in the last place of `f64`).
    ///
    /// # Errors
    /// [`Error::IdenticallyZero`].
    pub fn roots(&self, tolerance: f64) -> Result<Vec<ExactRoot>, Error> {
        let degree = self.coefficients.len() - 1;
        let denominator = self.coefficients.iter().fold(BigInt::from(1), |m, c| {
            let rest = BigRational::new(c.denom().clone(), m.clone());
            m * rest.numer()
        });
        let integers = self
            .coefficients
            .iter()
            .enumerate()
            .map(|(i, c)| c.numer() * (&denominator / c.denom()) * binomial(degree, i))
            .collect();
        let decomposition =
            Decomposition::of_homogeneous(integers).ok_or(Error::IdenticallyZero)?;
        Ok(decomposition.exact_roots(tolerance))
    }

    /// `Z`: the number of roots in the closed interval with multiplicity, and the degree plus one for the zero polynomial.
    #[must_use]
    pub fn root_count(&self) -> usize {
        // Any tolerance will do: the multiplicities are exact.
        match self.roots(1.0) {
            Ok(roots) => roots.iter().map(|root| root.multiplicity as usize).sum(),
            Err(_) => self.coefficients.len(),
        }
    }
}

/// A plane curve with rational control points and positive rational weights.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactCurve {
    points: Vec<[BigRational; 2]>,
    weights: Vec<BigRational>,
}

impl ExactCurve {
    /// The curve with these control points (not multiplied by the weights).
    ///
    /// # Errors
    /// [`Error::NoControlPoints`], [`Error::WeightCount`], [`Error::WeightNotPositive`].
    pub fn try_new(
        points: Vec<[BigRational; 2]>,
        weights: Vec<BigRational>,
    ) -> Result<Self, Error> {
        if points.is_empty() {
            return Err(Error::NoControlPoints);
        }
        if weights.len() != points.len() {
            return Err(Error::WeightCount {
                points: points.len(),
                weights: weights.len(),
            });
        }
        let zero = BigRational::from(BigInt::ZERO);
        if let Some(index) = weights.iter().position(|w| *w <= zero) {
            return Err(Error::WeightNotPositive { index, weight: 0.0 });
        }
        Ok(Self { points, weights })
    }

    /// The polynomial `w_i (a x_i + b y_i + c)` whose roots are the hits with the line `a x + b y + c = 0`.
    ///
    /// # Errors
    /// [`Error::ZeroNormal`].
    pub fn line_polynomial(&self, line: &[BigRational; 3]) -> Result<ExactPolynomial, Error> {
        let [a, b, c] = line;
        let zero = BigRational::from(BigInt::ZERO);
        if *a == zero && *b == zero {
            return Err(Error::ZeroNormal);
        }
        let value = |([x, y], w): (&[BigRational; 2], &BigRational)| (a * x + b * y + c) * w;
        ExactPolynomial::try_new(self.points.iter().zip(&self.weights).map(value).collect())
    }

    /// The polynomial of degree `n m` whose roots are the hits with the curve `sum c x^i y^j = 0` of degree `m`, from terms
    /// `(i, j, c)`.
    ///
    /// # Errors
    /// [`Error::NoCoefficients`] without terms.
    pub fn implicit_polynomial(
        &self,
        terms: &[(usize, usize, BigRational)],
    ) -> Result<ExactPolynomial, Error> {
        let n = self.points.len() - 1;
        let scaled = |coordinate: &dyn Fn(&[BigRational; 2]) -> BigRational| -> Vec<BigRational> {
            let weighted = self
                .points
                .iter()
                .zip(&self.weights)
                .map(|(p, w)| coordinate(p) * w);
            weighted
                .enumerate()
                .map(|(i, c)| c.times(binomial(n, i)))
                .collect()
        };
        let [x, y] = [scaled(&|p| p[0].clone()), scaled(&|p| p[1].clone())];
        let w = scaled(&|_| BigRational::from(BigInt::from(1)));
        let sum = compose(&x, &y, &w, terms);
        let degree = sum.len().saturating_sub(1);
        ExactPolynomial::try_new(
            sum.into_iter()
                .enumerate()
                .map(|(i, c)| c / BigInt::from(binomial(degree, i)))
                .collect(),
        )
    }

    /// The point at `t`.
    #[must_use]
    pub fn point(&self, t: &BigRational) -> [BigRational; 2] {
        let mut row: Vec<[BigRational; 3]> = self
            .points
            .iter()
            .zip(&self.weights)
            .map(|([x, y], w)| [x * w, y * w, w.clone()])
            .collect();
        while row.len() > 1 {
            row = row
                .windows(2)
                .map(|p| [0, 1, 2].map(|k| &p[0][k] + (&p[1][k] - &p[0][k]) * t))
                .collect();
        }
        row.pop()
            .map_or_else(|| self.points[0].clone(), |[x, y, w]| [x / &w, y / &w])
    }
}

/// The power coefficients on `[0, 1]` of a polynomial in Bernstein form, formed exactly and rounded once each.
///
/// The rounding moves roots, and ill-conditioned ones by much: this is for comparison with solvers in the power basis.
///
/// # Errors
/// [`Error::NoCoefficients`], [`Error::NotFinite`].
pub fn to_power_form(coefficients: &[f64]) -> Result<Vec<f64>, Error> {
    let degree = finite_degree(coefficients)?;
    let mut row: Vec<Exact> = coefficients.iter().map(|p| Exact::exactly(*p)).collect();
    let mut power = Vec::with_capacity(degree + 1);
    for k in 0..=degree {
        // The k-th difference at 0, times C(n, k).
        if let Some(first) = row.first() {
            power.push(first.times(binomial(degree, k)).nearest());
        }
        row = row.windows(2).map(|p| p[1].difference(&p[0])).collect();
    }
    Ok(power)
}
