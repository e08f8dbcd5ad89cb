//! Knot vectors: which there are, their domain and breakpoints.

mod de_boor;

use crate::Error;

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
}
