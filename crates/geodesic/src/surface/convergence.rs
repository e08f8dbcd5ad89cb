//! How far a sequence of lengths is from its limit.

use crate::Error;

/// The lengths of a path on polyhedra that converge to a surface, each with edges half as long as the one before.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Convergence {
    /// The length on each level, from the coarsest on.
    pub lengths: Vec<f64>,
}

/// What the change of length falls by from level to level where the order is 2.
const SECOND_ORDER: f64 = 4.0;

impl Convergence {
    /// The last two changes of the length, the earlier one first.
    fn changes(&self) -> Option<[f64; 2]> {
        match self.lengths[..] {
            [.., a, b, c] => Some([b - a, c - b]),
            _ => None,
        }
    }

    /// The order that the last two changes show: near 2 once the path has found its way, where the surface is smooth. `None`
    /// for fewer than three levels, or where the changes differ in sign or vanish.
    #[must_use]
    pub fn order(&self) -> Option<f64> {
        let [before, last] = self.changes()?;
        let order = (before / last).log2();
        order.is_finite().then_some(order)
    }

    /// An estimate of the last length's error: infinite for fewer than three levels.
    ///
    /// The last change, or a quarter of the change before it if that is larger. At order 2 both are three times the error, at
    /// order 1 the last change is the error. The room is needed: an end at a parameter that no level's lines meet lies now
    /// farther, now nearer to the surface, so that a level may happen to change nothing. On 30 random rational patches with
    /// random ends the estimate was once below the error, by a fifth, and no error above the tolerance asked for.
    #[must_use]
    pub fn error(&self) -> f64 {
        let Some([before, last]) = self.changes().map(|c| c.map(f64::abs)) else {
            return f64::INFINITY;
        };
        last.max(before / SECOND_ORDER)
    }

    /// The limit by Richardson's extrapolation of order 2, `None` for fewer than two levels: closer than the last length,
    /// where [`Convergence::order`] is near 2.
    #[must_use]
    pub fn limit(&self) -> Option<f64> {
        match self.lengths[..] {
            [.., before, last] => Some(last + (last - before) / (SECOND_ORDER - 1.0)),
            _ => None,
        }
    }
}

pub(super) fn check_tolerance(tolerance: f64) -> Result<(), Error> {
    if tolerance > 0.0 {
        Ok(())
    } else {
        Err(Error::InvalidTolerance { tolerance })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_of_order_two() {
        let lengths = |count: i32| (0..count).map(|k| 3.0 + 0.7 * 4f64.powi(-k)).collect();
        let convergence = Convergence {
            lengths: lengths(6),
        };
        assert!((convergence.order().unwrap() - 2.0).abs() < 1e-9);
        assert!((convergence.error() / (3.0 * 0.7 / 1024.0) - 1.0).abs() < 1e-9);
        assert!((convergence.limit().unwrap() - 3.0).abs() < 1e-12);
        assert_eq!(
            Convergence {
                lengths: lengths(2)
            }
            .error(),
            f64::INFINITY
        );
        assert_eq!(Convergence::default().limit(), None);
    }

    #[test]
    fn a_change_that_happens_to_vanish_is_not_the_limit() {
        let lengths = vec![3.0, 3.6, 3.6];
        assert!(Convergence { lengths }.error() > 0.1);
    }
}
