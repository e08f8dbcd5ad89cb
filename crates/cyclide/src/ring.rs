//! Smooth blends of a family: ring cyclides, found without search.

use crate::family::{Conic, Shape, Structure};
use crate::frame::length;
use crate::{Blend, Error, Family, Kind};

/// Which ring cyclide of a family is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum RingPreference {
    /// The one that touches the first cone at this height along its axis from the reference point, if it is a ring.
    ContactAtHeight(f64),
    /// The one whose narrowest passage, of the tube (`mu - c`) or of the hole (`a - mu`), is widest in proportion to its size.
    Widest,
    /// The one whose largest principal curvature is smallest, among those whose contact circles are at most this far along the rulings
    /// from the circles where the common sphere touches the cones. (Without a limit there may be none: on some diagonals the rings grow
    /// without end.) For parallel axes the limit is not used.
    SmallestCurvature {
        /// Largest `|t|`.
        reach: f64,
    },
}

impl Family {
    /// A ring cyclide of the family: a blend whose surface has no singular point, so that either tube is smooth.
    ///
    /// A candidate that uses a single nappe of each cone goes before one that does not. With a common vertex all members are similar and of one type; `Widest` then means the one at `t = 1`.
    ///
    /// # Errors
    ///
    /// [`Error::NoRing`] with the type of the members where a ring was wanted; [`Error::NotFinite`], [`Error::LengthOutOfRange`]; as [`Family::blend`].
    pub fn ring_blend(&self, preference: RingPreference) -> Result<Blend, Error> {
        let shape = self.shape();
        let candidates = match preference {
            RingPreference::ContactAtHeight(height) => {
                vec![self.parameter_at_height(length("height", height)?)]
            }
            RingPreference::Widest => self.widest(&shape),
            RingPreference::SmallestCurvature { reach } => {
                let reach = length("reach", reach)?.abs();
                match self.structure {
                    // Piecewise linear in t, so the best is at a middle or at the limit.
                    Structure::Meet { .. } => {
                        let within = self.widest(&shape).into_iter().filter(|t| t.abs() <= reach);
                        within.chain([reach, -reach]).collect()
                    }
                    Structure::Parallel { .. } => self.widest(&shape),
                }
            }
        };
        let mut best: Option<((bool, f64), Blend)> = None;
        let mut failure = Error::NoRing {
            kind: self.kind_at(candidates.first().copied().unwrap_or(1.0)),
        };
        for parameter in candidates
            .into_iter()
            .filter(|&parameter| self.kind_at(parameter).is_ring())
        {
            match self.blend(parameter) {
                // Where `a` and `c` nearly agree, rounding decides.
                Ok(blend) if !blend.kind().is_ring() => {
                    failure = Error::NoRing { kind: blend.kind() };
                }
                Ok(blend) => {
                    let clearance = self.clearance(&shape, parameter);
                    let merit = match preference {
                        RingPreference::SmallestCurvature { .. } => clearance * parameter.abs(),
                        _ => clearance,
                    };
                    // One nappe counts more than any clearance.
                    let merit = (blend.is_single_nappe(), merit);
                    if best.is_none_or(|(other, _)| merit > other) {
                        best = Some((merit, blend));
                    }
                }
                Err(error) => failure = error,
            }
        }
        best.map(|(_, blend)| blend).ok_or(failure)
    }

    /// The parameters in the middle of the intervals of rings.
    fn widest(&self, shape: &Shape) -> Vec<f64> {
        if shape.slope == 0.0 {
            // One type throughout: a common vertex, or parallel cylinders.
            return match self.structure {
                Structure::Meet { .. } => vec![1.0, -1.0],
                Structure::Parallel { .. } => vec![0.0],
            };
        }
        let [middle, opposite] = self.ring_parameters();
        middle
            .into_iter()
            .chain(opposite)
            .chain(self.beside_infinity(shape))
            .collect()
    }

    /// A stand-in for a middle that lies at infinity on the diagonal: half way to the end of its interval.
    fn beside_infinity(&self, shape: &Shape) -> Vec<f64> {
        if self.ring_parameters().iter().all(Option::is_some)
            || !matches!(self.structure, Structure::Meet { .. })
        {
            return Vec::new();
        }
        let width = if self.conic == Conic::Parabola {
            0.5
        } else {
            0.5 * (shape.outer - shape.inner)
        };
        [0.5, -0.5]
            .map(|share| shape.slope / (share * width))
            .into_iter()
            .filter(|t| t.is_finite())
            .collect()
    }

    /// The smaller of `mu - c` and `a - mu` (of `f/2 - |k|` for a cubic), per `|t|`: negative off the rings.
    fn clearance(&self, shape: &Shape, parameter: f64) -> f64 {
        let coordinate = match self.structure {
            Structure::Meet { .. } => 1.0 / parameter,
            Structure::Parallel { .. } => parameter,
        };
        let mean = (shape.slope * coordinate + shape.offset).abs();
        if self.conic == Conic::Parabola {
            shape.outer - mean
        } else {
            (mean - shape.inner).min(shape.outer - mean)
        }
    }

    /// Whether the family contains ring cyclides. It does, unless the cones share their vertex or are cylinders with parallel
    /// axes (or one axis): then all members are of one type, which depends on the angles, or on radii and distance.
    #[must_use]
    pub fn has_rings(&self) -> bool {
        self.intervals()
            .iter()
            .any(|interval| interval.kind.is_ring())
    }

    /// The only type in the family, if there is but one (a common vertex, parallel cylinders).
    #[must_use]
    pub fn only_kind(&self) -> Option<Kind> {
        match self.intervals().as_slice() {
            [interval] => Some(interval.kind),
            _ => None,
        }
    }
}
