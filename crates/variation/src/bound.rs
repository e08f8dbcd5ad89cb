//! Upper bounds for the number of roots in `[0, 1]` without solving: (4.2), its corollary, and chains of poles.
//!
//! Every bound counts roots of the *closed* interval with multiplicity and comes with its evidence: the sequence in which the
//! signs were counted.

use crate::Error;
use crate::finite::finite_degree;
use crate::polar::{Affine, check_pole_count, polar_derivative};
use crate::sign_changes::{
    Signed, sign_changes, sign_changes_by_parity, sign_changes_left, sign_changes_right,
};

/// A bound of the form `left + Z[middle] + right`, where `Z[middle]` is the number of roots of a polynomial of lower degree.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SplitBound<P> {
    /// Sign changes left of the middle.
    pub left: usize,
    /// The Bernstein coefficients, on the same interval, of the polynomial whose roots are to be counted.
    pub middle: Vec<P>,
    /// Sign changes right of the middle.
    pub right: usize,
}

impl<P: Signed> SplitBound<P> {
    /// The bound, given the number of roots of the middle polynomial (its degree plus one if that is zero).
    #[must_use]
    pub fn total(&self, roots_of_middle: usize) -> usize {
        self.left + roots_of_middle + self.right
    }

    /// The bound with the roots of the middle bounded by its own sign changes.
    #[must_use]
    pub fn total_by_polygon(&self) -> usize {
        self.total(sign_changes(&self.middle))
    }
}

/// Inequality (4.2) for a pole in `[0, 1]`: `Z[F] <= S_L(p_0, q_0) + Z[F_z] + S_R(q_(n-1), p_n)`.
///
/// # Errors
/// As [`polar_derivative`]; [`Error::PoleOutside`].
pub fn pole_bound<P>(coefficients: &[P], pole: &P::Parameter) -> Result<SplitBound<P>, Error>
where
    P: Affine + Signed,
    P::Parameter: UnitParameter,
{
    if !pole.in_unit() {
        return Err(Error::PoleOutside { index: 0 });
    }
    let middle = polar_derivative(coefficients, pole)?;
    let (Some(first), Some(last)) = (coefficients.first(), coefficients.last()) else {
        return Err(Error::NoCoefficients);
    };
    let left = middle
        .first()
        .map_or(0, |q| sign_changes_left(&[first.clone(), q.clone()]));
    let right = middle
        .last()
        .map_or(0, |q| sign_changes_right(&[q.clone(), last.clone()]));
    Ok(SplitBound {
        left,
        middle,
        right,
    })
}

/// The corollary: `Z[F] <= S_L(p_0, .., p_k) + Z[p_k, .., p_l] + S_R(p_l, .., p_n)` for any `k <= l`; the middle coefficients
/// are taken on the same interval. `k = l` is the classical variation diminishing property.
///
/// # Errors
/// [`Error::NoCoefficients`]; [`Error::IndexOrder`] unless `k <= l <= n`; [`Error::NotFinite`].
pub fn corollary_bound<P: Clone + Signed>(
    coefficients: &[P],
    k: usize,
    l: usize,
) -> Result<SplitBound<P>, Error> {
    let degree = finite_degree(coefficients)?;
    if k > l || l > degree {
        return Err(Error::IndexOrder { k, l, degree });
    }
    Ok(SplitBound {
        left: sign_changes_left(&coefficients[..=k]),
        middle: coefficients[k..=l].to_vec(),
        right: sign_changes_right(&coefficients[l..]),
    })
}

/// The bound of a chain of poles, with the polygon in which the signs were counted.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ChainBound<P> {
    /// `(R_n, .., R_(n-m+1), row m, S_(n-m+1), .., S_n)`: a corner cutting of the control polygon.
    pub polygon: Vec<P>,
    /// `S` of the polygon, the bound as printed.
    pub printed: usize,
    /// The least sound bound that the polygons give: runs of zeros counted by parity, never more than the control polygon
    /// itself, and lowered by one where the parity of the end signs differs.
    pub best: usize,
}

/// The bound by any poles in `[0, 1]`, at most as many as the degree: each replaces the inner row by its polar derivative and
/// leaves its two end values behind. Cost O(n) a pole.
///
/// # Errors
/// [`Error::NoCoefficients`], [`Error::TooManyPoles`], [`Error::PoleOutside`], [`Error::NotFinite`].
///
/// # Examples
/// ```
/// // The control polygon changes sign three times; one pole shows that there is one root.
/// let p = [-11.0, 7.0, -9.0, -5.0, -12.0, 12.0];
/// assert_eq!(variation::sign_changes(&p), 3);
/// let bound = variation::chain_bound(&p, &[0.5])?;
/// assert_eq!(bound.polygon, [-11.0, -2.0, -1.0, -7.0, -8.5, 0.0, 12.0]);
/// assert_eq!(bound.best, 1);
/// # Ok::<(), variation::Error>(())
/// ```
pub fn chain_bound<P>(coefficients: &[P], poles: &[P::Parameter]) -> Result<ChainBound<P>, Error>
where
    P: Affine + Signed,
    P::Parameter: UnitParameter,
{
    check_pole_count(coefficients, poles.len())?;
    if let Some(index) = poles.iter().position(|pole| !pole.in_unit()) {
        return Err(Error::PoleOutside { index });
    }
    let mut chain = Chain::new(coefficients);
    for pole in poles {
        chain.step(pole)?;
    }
    Ok(chain.bound(coefficients))
}

/// How the poles of a chain are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PoleStrategy {
    /// All at 1/2: the rows of de Casteljau.
    Halving,
    /// Where an end value of the next row vanishes, as in the example of Fig. 4.5; 1/2 if neither can.
    Vanishing,
    /// Each time the one of 1/8, .., 7/8 and the vanishing poles that leaves the smallest bound.
    Greedy,
}

/// The bound by `count` poles chosen in turn; stops early when the bound can no longer fall.
///
/// # Errors
/// As [`chain_bound`].
pub fn chain_bound_by(
    coefficients: &[f64],
    count: usize,
    strategy: PoleStrategy,
) -> Result<ChainBound<f64>, Error> {
    check_pole_count(coefficients, count)?;
    let mut chain = Chain::new(coefficients);
    let mut best = chain.bound(coefficients);
    for _ in 0..count {
        if best.best <= 1 {
            break;
        }
        let vanishing = chain.vanishing_poles();
        let pole = match strategy {
            PoleStrategy::Halving => 0.5,
            PoleStrategy::Vanishing => vanishing.into_iter().flatten().next().unwrap_or(0.5),
            PoleStrategy::Greedy => {
                let candidates = (1..8)
                    .map(|k| f64::from(k) / 8.0)
                    .chain(vanishing.into_iter().flatten());
                let mut least = (usize::MAX, 0.5);
                for pole in candidates {
                    let mut trial = chain.clone();
                    trial.step(&pole)?;
                    let bound = trial.bound(coefficients).best;
                    if bound < least.0 {
                        least = (bound, pole);
                    }
                }
                least.1
            }
        };
        chain.step(&pole)?;
        let bound = chain.bound(coefficients);
        if bound.best <= best.best {
            best = bound;
        }
    }
    Ok(best)
}

/// A parameter that can be compared with the unit interval.
pub trait UnitParameter {
    /// Whether it lies in `[0, 1]`.
    fn in_unit(&self) -> bool;
}

impl UnitParameter for f64 {
    fn in_unit(&self) -> bool {
        (0.0..=1.0).contains(self)
    }
}

#[cfg(feature = "exact")]
impl UnitParameter for num_rational::BigRational {
    fn in_unit(&self) -> bool {
        self.signum() >= 0 && self.numer() <= self.denom()
    }
}

/// The rows of a chain: the inner row, and the end values that the earlier rows left behind.
#[derive(Clone, Debug)]
struct Chain<P> {
    left: Vec<P>,
    row: Vec<P>,
    /// From the right end inward.
    right: Vec<P>,
}

impl<P: Affine + Signed> Chain<P> {
    fn new(coefficients: &[P]) -> Self {
        Self {
            left: Vec::new(),
            row: coefficients.to_vec(),
            right: Vec::new(),
        }
    }

    fn step(&mut self, pole: &P::Parameter) -> Result<(), Error> {
        let next = polar_derivative(&self.row, pole)?;
        if let (Some(first), Some(last)) = (self.row.first(), self.row.last()) {
            self.left.push(first.clone());
            self.right.push(last.clone());
        }
        self.row = next;
        Ok(())
    }

    fn bound(&self, coefficients: &[P]) -> ChainBound<P> {
        let polygon: Vec<P> = self
            .left
            .iter()
            .chain(&self.row)
            .chain(self.right.iter().rev())
            .cloned()
            .collect();
        let least = sign_changes_by_parity(&polygon).min(sign_changes_by_parity(coefficients));
        let ends = match (coefficients.first(), coefficients.last()) {
            (Some(first), Some(last)) => first.signum() * last.signum(),
            _ => 0,
        };
        // Between ends of equal sign the number of roots is even, between opposite ones odd; with a zero at an end nothing
        // is known.
        let parity = usize::from(ends < 0);
        let best = if ends != 0 && least % 2 != parity {
            least.saturating_sub(1)
        } else {
            least
        };
        ChainBound {
            printed: sign_changes(&polygon),
            polygon,
            best,
        }
    }
}

impl Chain<f64> {
    /// The poles in `(0, 1)` that make the first or the last value of the next row zero.
    fn vanishing_poles(&self) -> [Option<f64>; 2] {
        let crossing = |pair: Option<&[f64]>| {
            let &[p, q] = pair? else { return None };
            (p * q < 0.0).then(|| p / (p - q))
        };
        [
            crossing(self.row.get(..2)),
            crossing(
                self.row
                    .len()
                    .checked_sub(2)
                    .and_then(|i| self.row.get(i..)),
            ),
        ]
    }
}
