//! Rigid motions, reversal and parts of PH arcs.

use glam::DVec2;

use super::PhArc;
use crate::complex::{conj, sqrt, unit};
use crate::{Error, Line};

impl<const N: usize> PhArc<N> {
    /// The arc moved by `vector`. A vector that is not finite, or an overflow, gives supports that are not finite.
    #[must_use]
    pub fn translate(&self, vector: DVec2) -> Self {
        let normals = self.control_normals();
        Self {
            g: std::array::from_fn(|k| self.g[k] + normals[k].dot(vector)),
            ..*self
        }
    }

    /// The arc turned about the origin by the argument of the complex number `turn`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if `turn` is zero.
    pub fn rotate(&self, turn: DVec2) -> Result<Self, Error> {
        let half = sqrt(unit(turn)?);
        Ok(Self {
            w0: half.rotate(self.w0),
            w1: half.rotate(self.w1),
            g: self.g,
        })
    }

    /// The arc scaled about the origin by `factor` (a negative factor keeps the normals and turns the
    /// arc inside out). A factor that is not finite, or an overflow, gives supports that are not finite.
    #[must_use]
    pub fn scale(&self, factor: f64) -> Self {
        Self {
            g: self.g.map(|c| c * factor),
            ..*self
        }
    }

    /// The mirror image in a finite line: `w -> i nu conj(w)`, `g -> g - 2ck`. The turning changes sign.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] if the mirror is the line at infinity.
    pub fn reflect(&self, mirror: Line) -> Result<Self, Error> {
        let c = mirror.support()?;
        let nu = mirror.normal().normalize();
        let normals = self.control_normals();
        // The factor i nu conj(w) squares to -nu^2 conj(w^2) = n - 2<n, nu> nu.
        let image = |w: DVec2| nu.perp().rotate(conj(w));
        Ok(Self {
            w0: image(self.w0),
            w1: image(self.w1),
            g: std::array::from_fn(|k| self.g[k] - 2.0 * c * normals[k].dot(nu)),
        })
    }

    /// The same arc run backwards; the normals keep their directions.
    #[must_use]
    pub fn reverse(&self) -> Self {
        let mut g = self.g;
        g.reverse();
        Self {
            w0: self.w1,
            w1: self.w0,
            g,
        }
    }

    /// The same points with opposite normals: supports and radii change sign.
    #[must_use]
    pub fn flip(&self) -> Self {
        Self {
            w0: self.w0.perp(),
            w1: self.w1.perp(),
            g: self.g.map(|c| -c),
        }
    }

    /// The two parts at `t`, by de Casteljau's construction on `w` and `g`; both keep the scale.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] unless `0 < t < 1`.
    pub fn split(&self, t: f64) -> Result<(Self, Self), Error> {
        if !(t > 0.0 && t < 1.0) {
            return Err(Error::OutsideDomain {
                value: t,
                start: 0.0,
                end: 1.0,
            });
        }
        Ok(self.split_inside(t))
    }

    pub(crate) fn split_inside(&self, t: f64) -> (Self, Self) {
        let mut right = self.g;
        let left = std::array::from_fn(|level| {
            if level > 0 {
                for k in 0..N - level {
                    right[k] += t * (right[k + 1] - right[k]);
                }
            }
            right[0]
        });
        let w = self.spinor(t);
        (
            Self {
                w0: self.w0,
                w1: w,
                g: left,
            },
            Self {
                w0: w,
                w1: self.w1,
                g: right,
            },
        )
    }

    /// The part between two parameters `0 <= start < end <= 1`.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] otherwise.
    pub fn part(&self, start: f64, end: f64) -> Result<Self, Error> {
        if !(start >= 0.0 && start < end) {
            return Err(Error::OutsideDomain {
                value: start,
                start: 0.0,
                end,
            });
        }
        if end > 1.0 || end.is_nan() {
            return Err(Error::OutsideDomain {
                value: end,
                start,
                end: 1.0,
            });
        }
        let tail = if start > 0.0 {
            self.split_inside(start).1
        } else {
            *self
        };
        let end = (end - start) / (1.0 - start);
        Ok(if end < 1.0 {
            tail.split_inside(end).0
        } else {
            tail
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::arc;
    use super::*;

    #[test]
    fn motions_act_on_points() {
        let arc = arc(1.4);
        let turn = DVec2::from_angle(2.6);
        let vector = DVec2::new(-3.0, 0.5);
        let mirror = Line::new(-0.7, 0.28, 0.96).unwrap();
        let image = |p: DVec2| p - 2.0 * mirror.signed_distance(p).unwrap() * mirror.normal();
        for t in [0.0, 0.6, 1.0] {
            let p = arc.point(t);
            assert!((arc.translate(vector).point(t) - p - vector).length() < 1e-14);
            assert!((arc.rotate(turn).unwrap().point(t) - turn.rotate(p)).length() < 1e-14);
            assert!((arc.scale(-2.0).point(t) + 2.0 * p).length() < 1e-14);
            assert!((arc.reflect(mirror).unwrap().point(t) - image(p)).length() < 1e-14);
            assert!((arc.reverse().point(1.0 - t) - p).length() < 1e-14);
            assert!((arc.flip().point(t) - p).length() < 1e-14);
            assert!((arc.flip().normal(t) + arc.normal(t)).length() < 1e-14);
        }
        assert!((arc.reflect(mirror).unwrap().turning() + arc.turning()).abs() < 1e-15);
    }

    #[test]
    fn only_the_argument_of_a_turn_counts() {
        let arc = arc(1.4);
        let turn = DVec2::from_angle(2.6);
        let (a, b) = (arc.rotate(turn).unwrap(), arc.rotate(3.0 * turn).unwrap());
        assert!((a.point(0.3) - b.point(0.3)).length() < 1e-14);
        for bad in [DVec2::ZERO, DVec2::NAN, DVec2::INFINITY] {
            assert!(arc.rotate(bad).is_err());
        }
    }

    #[test]
    fn parts_keep_points_and_lengths_add_up() {
        for turning in [0.05, 0.8, 2.9, -2.9] {
            let arc = arc(turning);
            let (left, right) = arc.split(0.3).unwrap();
            assert!((left.point(0.5) - arc.point(0.15)).length() < 1e-11);
            assert!((arc.part(0.2, 0.9).unwrap().point(0.5) - arc.point(0.55)).length() < 1e-11);
            let sum = left.signed_length() + right.signed_length();
            assert!(
                (sum - arc.signed_length()).abs() < 1e-11 * sum.abs().max(1.0),
                "{turning}"
            );
        }
    }
}
