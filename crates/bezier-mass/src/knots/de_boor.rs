//! De Boor's algorithm on coefficients in any vector space: values, derivatives, Bézier pieces and knot insertion.

use super::Knots;
use crate::mass_point::CLEAR_WEIGHT;
use crate::{Error, MassPoint, VectorSpace};

impl Knots {
    /// The index `s` of the non-empty span `k_s <= t < k_(s+1)` of the domain, the first or last one for a `t` outside
    /// and at the end.
    fn span(&self, t: f64) -> usize {
        let windows = self.windows();
        let inside = &self.knots[self.degree + 1..windows];
        self.degree + inside.partition_point(|&knot| knot <= t)
    }

    /// The `degree + 1` coefficients that act on span `s`.
    fn local<V: VectorSpace>(&self, coefficients: &[V], s: usize) -> Vec<V> {
        let count = self.control_count();
        (s - self.degree..=s)
            .map(|i| coefficients[i % count])
            .collect()
    }

    /// The blossom of the piece on span `s` by de Boor's triangle, one argument per degree of the local coefficients;
    /// `mix(a, b, share)` is the affine combination.
    fn blossom<T: Copy>(
        &self,
        s: usize,
        mut local: Vec<T>,
        arguments: impl IntoIterator<Item = f64>,
        mix: impl Fn(T, T, f64) -> T,
    ) -> Option<T> {
        for argument in arguments {
            let degree = local.len().saturating_sub(1);
            for j in 0..degree {
                let (low, high) = (self.knots[s + 1 + j - degree], self.knots[s + 1 + j]);
                local[j] = mix(local[j], local[j + 1], (argument - low) / (high - low));
            }
            local.truncate(degree.max(1));
        }
        local.first().copied()
    }

    /// The value at `t`. The number of coefficients is [`Knots::control_count`], checked by the caller.
    pub(crate) fn evaluate<V: VectorSpace>(&self, coefficients: &[V], t: f64) -> V {
        let t = self.reduced(t);
        let s = self.span(t);
        self.evaluate_on(s, self.local(coefficients, s), t)
    }

    fn evaluate_on<V: VectorSpace>(&self, s: usize, local: Vec<V>, t: f64) -> V {
        let at_t = core::iter::repeat_n(t, self.degree);
        self.blossom(s, local, at_t, V::lerp).unwrap_or(V::ZERO)
    }

    /// The value of mass points at `t`, with a weight that is rounding error set to zero.
    pub(crate) fn mass_point<V: VectorSpace>(
        &self,
        control: &[MassPoint<V>],
        t: f64,
    ) -> MassPoint<V> {
        let t = self.reduced(t);
        let s = self.span(t);
        let local = self.local(control, s);
        let weights: Vec<f64> = local.iter().map(|h| h.weight.abs()).collect();
        let clear = CLEAR_WEIGHT * weights.iter().copied().fold(0.0, f64::max);
        let value = self.evaluate_on(s, local, t);
        let [start, end] = self.domain();
        if value.weight.abs() > clear && (start..=end).contains(&t) {
            return value;
        }
        let mix = |a: f64, b: f64, share: f64| a * (1.0 - share).abs() + b * share.abs();
        let terms = self.blossom(s, weights, core::iter::repeat_n(t, self.degree), mix);
        value.settled(terms.unwrap_or(0.0))
    }

    /// The value, first and second derivative at `t`.
    pub(crate) fn jet<V: VectorSpace>(&self, coefficients: &[V], t: f64) -> [V; 3] {
        let t = self.reduced(t);
        let s = self.span(t);
        let mut local = self.local(coefficients, s);
        [0, 1, 2].map(|_| {
            let value = self.evaluate_on(s, local.clone(), t);
            local = self.local_derivative(s, &local);
            value
        })
    }

    /// The local coefficients of the derivative on span `s`.
    fn local_derivative<V: VectorSpace>(&self, s: usize, local: &[V]) -> Vec<V> {
        let degree = local.len().saturating_sub(1);
        let difference = |(j, pair): (usize, &[V])| {
            let i = s - degree + 1 + j;
            pair[1]
                .minus(pair[0])
                .times(degree as f64 / (self.knots[i + degree] - self.knots[i]))
        };
        local.windows(2).enumerate().map(difference).collect()
    }

    /// The non-empty spans of the domain with the Bernstein coefficients on each.
    pub(crate) fn bezier_pieces<V: VectorSpace>(
        &self,
        coefficients: &[V],
    ) -> Vec<([f64; 2], Vec<V>)> {
        let spans = (self.degree..self.windows()).filter(|&s| self.knots[s] < self.knots[s + 1]);
        spans
            .map(|s| {
                let (start, end) = (self.knots[s], self.knots[s + 1]);
                let local = self.local(coefficients, s);
                // Coefficient j is the blossom at `degree - j` times the start and j times the end.
                let coefficient = |j: usize| {
                    let ends = core::iter::repeat_n(end, j)
                        .chain(core::iter::repeat_n(start, self.degree - j));
                    self.blossom(s, local.clone(), ends, V::lerp)
                        .unwrap_or(V::ZERO)
                };
                ([start, end], (0..=self.degree).map(coefficient).collect())
            })
            .collect()
    }

    /// The spline space with one more knot at `t`, and the same spline in it.
    ///
    /// Source: W. Boehm, *Inserting new knots into B-spline curves*, CAD 12, 1980.
    pub(crate) fn insert<V: VectorSpace>(
        &self,
        coefficients: &[V],
        t: f64,
    ) -> Result<(Self, Vec<V>), Error> {
        let t = self.reduced(t);
        let [start, end] = self.domain();
        if !t.is_finite() {
            return Err(Error::NonFinite { what: "knot" });
        }
        if !(start..=end).contains(&t) {
            return Err(Error::OutsideDomain { t, start, end });
        }
        let (p, s, count) = (self.degree, self.span(t), self.control_count());
        let refined = if self.periodic {
            let mut breakpoints = self.knots[p..=self.windows()].to_vec();
            breakpoints.insert(s + 1 - p, t);
            Self::periodic(p, &breakpoints)?
        } else {
            let mut knots = self.knots.clone();
            knots.insert(s + 1, t);
            Self::new(p, knots)?
        };
        let at = |i: usize| coefficients[i % count];
        // Along the knots: the p coefficients from `first` on are new, those before and after are the old ones.
        let first = s + 1 - p;
        let coefficient = |i: usize| {
            if i < first {
                at(i)
            } else if i > s {
                at(i - 1)
            } else {
                let (low, high) = (self.knots[i], self.knots[i + p]);
                at(i - 1).lerp(at(i), (t - low) / (high - low))
            }
        };
        let refined_coefficients = (0..refined.control_count())
            .map(|i| {
                if self.periodic && i < first {
                    coefficient(i + count + 1)
                } else {
                    coefficient(i)
                }
            })
            .collect();
        Ok((refined, refined_coefficients))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_with_knot_averages_as_coefficients_is_the_identity() -> Result<(), Error> {
        // Schoenberg: the coefficients of the function t are the averages of p consecutive knots.
        let knots = Knots::new(3, vec![-1.0, -0.5, 0.0, 1.0, 1.5, 1.5, 4.0, 4.0, 5.0, 6.0])?;
        let average = |i: usize| knots.as_slice()[i + 1..i + 4].iter().sum::<f64>() / 3.0;
        let coefficients: Vec<f64> = (0..knots.control_count()).map(average).collect();
        for t in [-0.7, 0.0, 0.3, 1.0, 1.5, 2.9, 4.0, 4.5] {
            let [value, first, second] = knots.jet(&coefficients, t);
            assert!(
                (value - t).abs() < 1e-14 && (first - 1.0).abs() < 1e-13 && second.abs() < 1e-12,
                "at {t}"
            );
            assert!((knots.evaluate(&coefficients, t) - t).abs() < 1e-14);
        }
        Ok(())
    }

    #[test]
    fn insertion_keeps_the_spline_clamped_loose_and_periodic() -> Result<(), Error> {
        let coefficients = [3.0, -1.0, 4.0, 1.0, -5.0, 9.0];
        for knots in [
            Knots::clamped_uniform(3, 6)?,
            Knots::new(2, vec![0.0, 0.5, 1.0, 1.5, 3.0, 3.0, 4.0, 4.5, 5.0])?,
            Knots::periodic_uniform(3, 6)?,
            Knots::periodic(2, &[0.0, 1.0, 1.5, 1.5, 3.0, 3.5, 4.0])?,
        ] {
            let [start, end] = knots.domain();
            for i in 0..=12 {
                let t = start + (end - start) * f64::from(i) / 12.0;
                let (refined, new) = match knots.insert(&coefficients, t) {
                    Ok(result) => result,
                    Err(Error::KnotMultiplicity { .. }) => continue,
                    Err(error) => return Err(error),
                };
                assert_eq!(new.len(), 7);
                for j in 0..=30 {
                    let at = start + (end - start) * f64::from(j) / 30.0;
                    let (before, after) = (
                        knots.evaluate(&coefficients, at),
                        refined.evaluate(&new, at),
                    );
                    assert!(
                        (before - after).abs() < 1e-13,
                        "{knots:?}: knot {t}, {before} against {after} at {at}"
                    );
                }
            }
            assert!(matches!(
                knots.insert(&coefficients, f64::NAN),
                Err(Error::NonFinite { .. })
            ));
        }
        let clamped = Knots::clamped_uniform(3, 6)?;
        assert!(matches!(
            clamped.insert(&coefficients, 1.5),
            Err(Error::OutsideDomain { .. })
        ));
        Ok(())
    }
}
