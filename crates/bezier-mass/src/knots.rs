//! Knot vectors, and de Boor's algorithm on coefficients in any vector space.

use crate::mass_point::CLEAR_WEIGHT;
use crate::{Error, MassPoint, VectorSpace};

/// A knot vector with its degree: the spline space that control points are given in.
///
/// With `n` control points of degree `p` there are `n + p + 1` non-decreasing knots `k_0 ..`, and the spline lives on the
/// domain `[k_p, k_n]`. At a knot of multiplicity `m` it is `C^(p-m)`; a multiplicity above `p` inside is refused, since
/// the spline would fall apart there. A periodic knot vector repeats itself, and its `n` control points are used in a
/// cycle.
///
/// Source: C. de Boor, *A Practical Guide to Splines*, Springer 2001, chapters 9 to 11.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "KnotData", into = "KnotData"))]
pub struct Knots {
    degree: usize,
    /// All knots; of a periodic vector one period with `degree` more knots on either side.
    knots: Vec<f64>,
    periodic: bool,
}

impl Knots {
    /// The largest degree that is accepted: beyond it de Boor's recursion has no correct digits left in general, and a
    /// degree read from a damaged file does not ask for all memory.
    pub const MAX_DEGREE: usize = 64;

    /// The knot vector as it is written in most books and files, clamped or not.
    ///
    /// # Errors
    /// [`Error::WrongCount`] for degree zero or fewer than `2 (degree + 1)` knots; [`Error::NonFinite`];
    /// [`Error::KnotsDecrease`]; [`Error::KnotMultiplicity`] for an interior knot of multiplicity above the degree or an
    /// end span of the domain that is empty.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, Error> {
        Self::checked(degree, knots, false)
    }

    fn checked(degree: usize, knots: Vec<f64>, periodic: bool) -> Result<Self, Error> {
        check_order(degree, &knots)?;
        let needed = degree.saturating_add(1).saturating_mul(2);
        if knots.len() < needed {
            return Err(Error::WrongCount {
                what: "knots",
                found: knots.len(),
                needed,
            });
        }
        let controls = knots.len() - degree - 1;
        let crowded = (1..controls).find(|&i| knots[i] >= knots[i + degree]);
        // The domain's ends are at its first and last span, unless it has no ends.
        let empty_end = [degree, controls - 1]
            .into_iter()
            .find(|&i| !periodic && knots[i] >= knots[i + 1]);
        if let Some(i) = crowded.or(empty_end) {
            let multiplicity = knots.iter().filter(|&&k| k == knots[i]).count();
            return Err(Error::KnotMultiplicity {
                knot: knots[i],
                multiplicity,
                degree,
            });
        }
        Ok(Self {
            degree,
            knots,
            periodic,
        })
    }

    /// The clamped knot vector with these increasing breakpoints: the spline starts and ends in its first and last
    /// control point, and is as smooth as its degree allows.
    ///
    /// # Errors
    /// As [`Knots::new`].
    pub fn clamped(degree: usize, breakpoints: &[f64]) -> Result<Self, Error> {
        let (Some(&first), Some(&last)) = (breakpoints.first(), breakpoints.last()) else {
            return Err(Error::WrongCount {
                what: "breakpoints",
                found: 0,
                needed: 2,
            });
        };
        check_order(degree, breakpoints)?;
        let repeated = |knot| core::iter::repeat_n(knot, degree);
        Self::new(
            degree,
            repeated(first)
                .chain(breakpoints.iter().copied())
                .chain(repeated(last))
                .collect(),
        )
    }

    /// The clamped knot vector on `[0, 1]` with equal spans for `controls` control points.
    ///
    /// # Errors
    /// [`Error::WrongCount`] unless there are more control points than the degree, and the degree is not zero.
    pub fn clamped_uniform(degree: usize, controls: usize) -> Result<Self, Error> {
        if controls <= degree {
            let needed = degree.saturating_add(1);
            return Err(Error::WrongCount {
                what: "control mass points",
                found: controls,
                needed,
            });
        }
        let spans = controls - degree;
        let breakpoints: Vec<f64> = (0..=spans).map(|i| i as f64 / spans as f64).collect();
        Self::clamped(degree, &breakpoints)
    }

    /// The periodic knot vector whose period is from the first to the last of these `n + 1` non-decreasing
    /// breakpoints, for `n` control points. The last breakpoint is the first one of the next period.
    ///
    /// # Errors
    /// As [`Knots::new`]; [`Error::WrongCount`] if `n` is less than the degree.
    pub fn periodic(degree: usize, breakpoints: &[f64]) -> Result<Self, Error> {
        check_order(degree, breakpoints)?;
        let needed = degree.max(1).saturating_add(1);
        let (n, [first, .., last]) = (breakpoints.len().saturating_sub(1), breakpoints) else {
            return Err(Error::WrongCount {
                what: "breakpoints",
                found: breakpoints.len(),
                needed,
            });
        };
        if n < degree {
            return Err(Error::WrongCount {
                what: "breakpoints",
                found: n + 1,
                needed,
            });
        }
        let period = last - first;
        let before = breakpoints[n - degree..n].iter().map(|k| k - period);
        let after = breakpoints[1..=degree].iter().map(|k| k + period);
        let knots = before
            .chain(breakpoints.iter().copied())
            .chain(after)
            .collect();
        Self::checked(degree, knots, true)
    }

    /// The periodic knot vector on `[0, 1]` with equal spans for `controls` control points.
    ///
    /// # Errors
    /// [`Error::WrongCount`] for fewer control points than the degree, or degree zero.
    pub fn periodic_uniform(degree: usize, controls: usize) -> Result<Self, Error> {
        if controls < degree {
            return Err(Error::WrongCount {
                what: "control mass points",
                found: controls,
                needed: degree,
            });
        }
        let breakpoints: Vec<f64> = (0..=controls)
            .map(|i| i as f64 / controls.max(1) as f64)
            .collect();
        Self::periodic(degree, &breakpoints)
    }

    /// The degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots; of a periodic vector one period, with `degree` more knots on either side.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.knots
    }

    /// Whether the knots and the control points repeat.
    #[must_use]
    pub fn is_periodic(&self) -> bool {
        self.periodic
    }

    /// The number of control points.
    #[must_use]
    pub fn control_count(&self) -> usize {
        self.windows() - if self.periodic { self.degree } else { 0 }
    }

    /// The number of control points counted along the knots, those of a cycle repeatedly.
    fn windows(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// The start and end of the domain.
    #[must_use]
    pub fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.windows()]]
    }

    /// The different knots of the domain in increasing order: where the polynomial pieces meet.
    #[must_use]
    pub fn breakpoints(&self) -> Vec<f64> {
        let mut breakpoints = self.knots[self.degree..=self.windows()].to_vec();
        breakpoints.dedup();
        breakpoints
    }

    /// The parameter in the domain: reduced by periods if periodic, else as it is.
    fn reduced(&self, t: f64) -> f64 {
        let [start, end] = self.domain();
        if !self.periodic || (start..end).contains(&t) {
            return t;
        }
        let reduced = start + (t - start).rem_euclid(end - start);
        if reduced >= end { start } else { reduced }
    }

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

/// Refuses degree zero, non-finite and decreasing knots.
fn check_order(degree: usize, knots: &[f64]) -> Result<(), Error> {
    if degree > Knots::MAX_DEGREE {
        return Err(Error::DegreeTooHigh {
            degree,
            largest: Knots::MAX_DEGREE,
        });
    }
    if degree == 0 {
        return Err(Error::WrongCount {
            what: "degree of the spline",
            found: 0,
            needed: 1,
        });
    }
    let length = knots
        .last()
        .zip(knots.first())
        .map_or(0.0, |(last, first)| last - first);
    if !(knots.iter().all(|k| k.is_finite()) && length.is_finite()) {
        return Err(Error::NonFinite { what: "knot" });
    }
    match knots.windows(2).position(|pair| pair[0] > pair[1]) {
        Some(i) => Err(Error::KnotsDecrease {
            index: i + 1,
            before: knots[i],
            knot: knots[i + 1],
        }),
        None => Ok(()),
    }
}

/// What a knot vector is written as.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct KnotData {
    degree: usize,
    knots: Vec<f64>,
    periodic: bool,
}

#[cfg(feature = "serde")]
impl From<Knots> for KnotData {
    fn from(
        Knots {
            degree,
            knots,
            periodic,
        }: Knots,
    ) -> Self {
        Self {
            degree,
            knots,
            periodic,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<KnotData> for Knots {
    type Error = Error;

    fn try_from(
        KnotData {
            degree,
            knots,
            periodic,
        }: KnotData,
    ) -> Result<Self, Error> {
        if !periodic {
            return Self::new(degree, knots);
        }
        let inside = degree..knots.len().saturating_sub(degree);
        let breakpoints = knots.get(inside).unwrap_or_default();
        Self::periodic(degree, breakpoints)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn malformed_knots_are_refused_with_their_numbers() {
        let new = |degree, knots: &[f64]| Knots::new(degree, knots.to_vec());
        assert!(matches!(new(0, &[0.0, 1.0]), Err(Error::WrongCount { .. })));
        assert!(matches!(
            new(2, &[0.0, 0.0, 0.0, 1.0, 1.0]),
            Err(Error::WrongCount { needed: 6, .. })
        ));
        assert!(matches!(
            new(usize::MAX, &[0.0, 1.0]),
            Err(Error::DegreeTooHigh { .. })
        ));
        assert!(matches!(
            Knots::clamped(usize::MAX, &[0.0, 1.0]),
            Err(Error::DegreeTooHigh { .. })
        ));
        assert!(matches!(
            new(1, &[0.0, 0.0, f64::NAN, 1.0]),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            new(1, &[-f64::MAX, -f64::MAX, f64::MAX, f64::MAX]),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            new(1, &[0.0, 0.0, 2.0, 1.0]),
            Err(Error::KnotsDecrease { index: 3, .. })
        ));
        assert!(matches!(
            new(1, &[0.0; 4]),
            Err(Error::KnotMultiplicity { .. })
        ));
        let torn = [0.0, 0.0, 0.5, 0.5, 1.0, 1.0];
        assert!(matches!(
            new(1, &torn),
            Err(Error::KnotMultiplicity {
                knot: 0.5,
                multiplicity: 2,
                degree: 1
            })
        ));
        assert!(matches!(
            Knots::clamped(3, &[]),
            Err(Error::WrongCount { .. })
        ));
        assert!(matches!(
            Knots::clamped_uniform(3, 3),
            Err(Error::WrongCount { needed: 4, .. })
        ));
        assert!(matches!(
            Knots::periodic_uniform(3, 0),
            Err(Error::WrongCount { .. })
        ));
        assert!(matches!(
            Knots::periodic_uniform(3, 2),
            Err(Error::WrongCount { .. })
        ));
        assert!(matches!(
            Knots::periodic(2, &[0.0; 5]),
            Err(Error::KnotMultiplicity { .. })
        ));
    }

    #[test]
    fn domains_and_breakpoints() -> Result<(), Error> {
        let clamped = Knots::clamped(3, &[0.0, 1.0, 4.0])?;
        assert_eq!((clamped.control_count(), clamped.domain()), (5, [0.0, 4.0]));
        assert_eq!(clamped.breakpoints(), [0.0, 1.0, 4.0]);
        let periodic = Knots::periodic(2, &[0.0, 1.0, 4.0, 4.5])?;
        assert_eq!(
            (periodic.control_count(), periodic.domain()),
            (3, [0.0, 4.5])
        );
        assert_eq!(
            periodic.as_slice(),
            [-3.5, -0.5, 0.0, 1.0, 4.0, 4.5, 5.5, 8.5]
        );
        Ok(())
    }

    /// The circle of four rational arcs: every knot of the cycle is double, wherever it is cut open.
    #[test]
    fn every_knot_of_a_cycle_may_be_double() -> Result<(), Error> {
        for start in 0..2 {
            let breakpoints: Vec<f64> = (start..=start + 8).map(|k| f64::from(k / 2)).collect();
            let knots = Knots::periodic(2, &breakpoints)?;
            assert_eq!((knots.control_count(), knots.domain()), (8, [0.0, 4.0]));
            // Parabolas, all alike, from 1 by way of a control value 2 to 1.
            let coefficients: Vec<f64> = (start..start + 8).map(|k| f64::from(2 - k % 2)).collect();
            for t in [0.0, 0.25, 1.0, 1.5, 3.75, 4.0, -0.25] {
                let local = f64::rem_euclid(t, 1.0);
                let expected = 1.0 + 2.0 * local * (1.0 - local);
                assert!(
                    (knots.evaluate(&coefficients, t) - expected).abs() < 1e-15,
                    "at {t}"
                );
            }
            assert_eq!(knots.bezier_pieces(&coefficients).len(), 4);
        }
        Ok(())
    }

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
