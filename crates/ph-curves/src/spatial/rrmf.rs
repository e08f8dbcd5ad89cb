//! Quintics with a rational rotation-minimising frame.

use std::f64::consts::LN_2;

use bezier_mass::{VectorSpace, bernstein};
use glam::{DMat2, DVec2, DVec3};

use super::frame::{direction, length};
use super::hermite::{grid, some_number};
use super::{Frame, Quaternion, SpatialPh};
use crate::Error;

/// A spatial PH quintic whose rotation-minimising frame is rational (an RRMF quintic).
///
/// The condition is `A0 i A2* + A2 i A0* = 2 A1 i A1*` (Farouki 2010). Then a complex polynomial `W` with
/// `|W|² = |A|²` turns the Euler-Rodrigues frame into the rotation-minimising one: with `B = A conj(W)`, the frame is
/// `(B i B*, B j B*, B k B*) / |B|²`, of degree 8.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RationalFrameQuintic {
    curve: SpatialPh,
    multiplier: [DVec2; 3],
}

/// The condition holds on rounded data if its residual is below this share of the speed's largest coefficient.
const CONDITION_TOLERANCE: f64 = 1e-9;
/// Newton's method is quadratic but for its difference quotients; it is given up after this many steps.
const NEWTON_STEPS: usize = 40;
/// Logarithms of the ratios of the end speeds from which it starts, and the largest one that it may reach.
const STARTING_LOG_RATIOS: [f64; 3] = [0.0, -LN_2, LN_2];
const LARGEST_LOG_RATIO: f64 = 6.0;

impl RationalFrameQuintic {
    /// The vector `A0 i A2* + A2 i A0* - 2 A1 i A1*` that vanishes for an RRMF quintic, in the unit of the speed.
    #[must_use]
    pub fn residual([first, middle, last]: [Quaternion; 3]) -> DVec3 {
        2.0 * (first.polar_image(last) - middle.image(DVec3::X))
    }

    /// Recognises an RRMF quintic.
    ///
    /// # Errors
    ///
    /// [`Error::NotRationalFrame`] with the relative residual if the curve is not one (every other degree included);
    /// [`Error::ZeroDirection`] if the speed vanishes at the start, where no frame starts.
    pub fn try_new(curve: SpatialPh) -> Result<Self, Error> {
        let &[first, middle, last] = curve.preimage() else {
            return Err(Error::NotRationalFrame {
                relative_residual: f64::INFINITY,
            });
        };
        let scale = first
            .norm_squared()
            .max(middle.norm_squared())
            .max(last.norm_squared());
        let relative_residual = Self::residual([first, middle, last]).length() / scale;
        if relative_residual.is_nan() || relative_residual > CONDITION_TOLERANCE {
            return Err(Error::NotRationalFrame { relative_residual });
        }
        let norm = first.norm_squared().sqrt();
        if norm == 0.0 {
            return Err(Error::ZeroDirection {
                what: "tangent at the start of an RRMF quintic",
            });
        }
        let w1 = first.complex_product(middle) / norm;
        let square = DVec2::new(2.0 * (middle.norm_squared() - w1.length_squared()), 0.0);
        let w2 = (first.complex_product(last) + square) / norm;
        Ok(Self {
            curve,
            multiplier: [DVec2::new(norm, 0.0), w1, w2],
        })
    }

    /// The RRMF quintic with given end coefficients of the preimage; the middle one is a square root of
    /// `(A0 i A2* + A2 i A0*) / 2` and `angle` says which.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] for a zero coefficient.
    pub fn from_ends(
        start: DVec3,
        first: Quaternion,
        last: Quaternion,
        angle: f64,
    ) -> Result<Self, Error> {
        let middle = Quaternion::square_root(first.polar_image(last), angle)?;
        Self::try_new(SpatialPh::try_new(start, [first, middle, last])?)
    }

    /// An RRMF quintic through two points with given tangent directions there (G1 Hermite data).
    ///
    /// The lengths of the end derivatives are not given, and cannot be: RRMF quintics have one degree of freedom too few
    /// for general C1 data. Two angles and the ratio of the two lengths are solved for by Newton's method from a grid of
    /// starts; of all curves found the one of least bending energy is returned. It meets the end point to about 1e-12 of
    /// the distance.
    ///
    /// Not all data have an interpolant. Of random ones with tangents in all directions 28 % are refused, of those with
    /// both tangents within 60 degrees of the chord 7 %; starts seven times as dense solve no more of them.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if the points coincide or a tangent is zero;
    /// [`Error::NoInterpolant`] if no start converged.
    pub fn interpolate(
        start: DVec3,
        start_tangent: DVec3,
        end: DVec3,
        end_tangent: DVec3,
    ) -> Result<Self, Error> {
        if !(start.is_finite() && end.is_finite()) {
            return Err(Error::NonFinite {
                what: "end point of Hermite data",
            });
        }
        let root = |tangent: DVec3| {
            let unit = direction(tangent).ok_or(Error::ZeroDirection {
                what: "end tangent of Hermite data",
            })?;
            Quaternion::square_root(unit, 0.0)
        };
        let (first, last) = (root(start_tangent)?, root(end_tangent)?);
        let chord = end - start;
        let towards = direction(chord).ok_or(Error::ZeroDirection {
            what: "chord of Hermite data",
        })?;
        let (side, up) = towards.any_orthonormal_pair();
        let directed = Directed {
            first,
            last,
            towards,
            side,
            up,
        };
        // Curves with a chord of length one are compared: energies of huge and tiny curves overflow.
        let mut best: Option<(f64, [Quaternion; 3])> = None;
        for log_ratio in STARTING_LOG_RATIOS {
            for angles in grid().step_by(3) {
                let Some(preimage) = directed.solve(angles.extend(log_ratio)) else {
                    continue;
                };
                let scale = displacement(&preimage).length().sqrt().recip();
                let preimage = preimage.map(|a| a.times(scale));
                let energy =
                    some_number(SpatialPh::try_new(DVec3::ZERO, preimage)?.bending_energy());
                if best.is_none_or(|(least, _)| energy < least) {
                    best = Some((energy, preimage));
                }
            }
        }
        let (_, unit) = best.ok_or(Error::NoInterpolant {
            what: "RRMF quintic",
        })?;
        let scale = length(chord).sqrt();
        let found = Self::try_new(SpatialPh::try_new(DVec3::ZERO, unit)?)?;
        Ok(Self {
            curve: SpatialPh::try_new(start, unit.map(|a| a.times(scale)))?,
            multiplier: found.multiplier.map(|w| scale * w),
        })
    }

    /// The curve.
    #[must_use]
    pub fn curve(&self) -> &SpatialPh {
        &self.curve
    }

    /// The Bernstein coefficients of the complex polynomial `W`, `|W|² = |A|²`.
    #[must_use]
    pub fn multiplier(&self) -> [DVec2; 3] {
        self.multiplier
    }

    /// The Bernstein coefficients (degree 4) of `B = A conj(W)`, whose images of `i, j, k` are the frame times `|A|⁴`.
    #[must_use]
    pub fn frame_preimage(&self) -> Vec<Quaternion> {
        bernstein::product_with(self.curve.preimage(), &self.multiplier, |a, w| {
            a.times_complex(DVec2::new(w.x, -w.y))
        })
    }

    /// The rotation-minimising frame at `t`, exactly (no integration); it agrees with the Euler-Rodrigues frame at 0.
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] where the speed vanishes.
    pub fn frame(&self, t: f64) -> Result<Frame, Error> {
        let w: DVec2 = bernstein::evaluate(&self.multiplier, t);
        Frame::of_quaternion(
            self.curve
                .preimage_at(t)
                .times_complex(DVec2::new(w.x, -w.y)),
        )
    }
}

/// The chord of the RRMF quintic with this preimage: the mean of the hodograph's coefficients, the middle one simplified by the condition.
fn displacement([first, middle, last]: &[Quaternion; 3]) -> DVec3 {
    let square = |a: &Quaternion| a.image(DVec3::X);
    (square(first)
        + first.polar_image(*middle)
        + square(middle)
        + middle.polar_image(*last)
        + square(last))
        / 5.0
}

/// The quintics with given end tangents whose chord points in a given direction: a curve in the space of three unknowns,
/// the angle of the last coefficient, the angle of the middle one, and the logarithm of the ratio of the end speeds.
struct Directed {
    first: Quaternion,
    last: Quaternion,
    towards: DVec3,
    side: DVec3,
    up: DVec3,
}

/// Step of the difference quotients: their error, of order 2, balances rounding.
const DIFFERENCE: f64 = 1e-6;
/// The defect at which Newton's iteration ends, and that to which a few units of rounding may keep it.
const FOUND: f64 = 4.0 * f64::EPSILON;
const ALMOST_FOUND: f64 = 1e-13;
/// Halvings of a step that does not lower the defect.
const STEP_HALVINGS: usize = 8;

impl Directed {
    fn preimage(&self, unknowns: DVec3) -> Option<[Quaternion; 3]> {
        let last = self
            .last
            .product(Quaternion::turn_about_i(unknowns.x))
            .times((0.5 * unknowns.z).exp());
        let middle = Quaternion::square_root(self.first.polar_image(last), unknowns.y).ok()?;
        Some([self.first, middle, last])
    }

    /// The rotation from the wanted direction to the chord's, as an angle along each of two axes; none for the opposite one.
    fn defect(&self, unknowns: DVec3) -> Option<DVec2> {
        let chord = direction(displacement(&self.preimage(unknowns)?))?;
        let across = DVec2::new(chord.dot(self.side), chord.dot(self.up));
        let (sine, cosine) = (across.length(), chord.dot(self.towards));
        if sine > 0.0 {
            Some(across * (sine.atan2(cosine) / sine))
        } else {
            (cosine > 0.0).then_some(DVec2::ZERO)
        }
    }

    /// Newton's method with the shortest solution of the linear equations, two for three unknowns.
    fn solve(&self, start: DVec3) -> Option<[Quaternion; 3]> {
        let mut unknowns = start;
        let mut value = self.defect(unknowns)?;
        for _ in 0..NEWTON_STEPS {
            if value.length() <= FOUND {
                break;
            }
            let slope = |axis: DVec3| {
                let step = DIFFERENCE * axis;
                let (after, before) =
                    (self.defect(unknowns + step)?, self.defect(unknowns - step)?);
                Some((after - before) / (2.0 * DIFFERENCE))
            };
            let columns = [slope(DVec3::X)?, slope(DVec3::Y)?, slope(DVec3::Z)?];
            // J Jᵀ y = value, step = Jᵀ y.
            let normal = columns.iter().fold(DMat2::ZERO, |sum, c| {
                sum + DMat2::from_cols(c.x * *c, c.y * *c)
            });
            if normal.determinant().abs() < 1e-14 {
                return None;
            }
            let multiplier = normal.inverse() * value;
            let newton =
                DVec3::from_array(columns.map(|c| c.dot(multiplier))).clamp_length_max(0.5);
            let better = (0..STEP_HALVINGS).find_map(|halvings| {
                let next = unknowns - newton * 0.5_f64.powi(halvings as i32);
                let found = self.defect(next)?;
                (found.length() < value.length()).then_some((next, found))
            });
            match better {
                Some((next, _)) if next.z.abs() > LARGEST_LOG_RATIO => return None,
                Some(better) => (unknowns, value) = better,
                None => break,
            }
        }
        if value.length() <= ALMOST_FOUND {
            self.preimage(unknowns)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::rotation_minimising_frames;
    use super::*;

    fn example() -> RationalFrameQuintic {
        let (first, last) = (
            Quaternion::new(1.0, 0.2, -0.3, 0.1),
            Quaternion::new(0.7, 0.5, 0.4, -0.2),
        );
        RationalFrameQuintic::from_ends(DVec3::ZERO, first, last, 0.3).unwrap()
    }

    #[test]
    fn the_rational_frame_is_the_one_that_double_reflection_finds() {
        let quintic = example();
        let steps = 400;
        let samples = (0..=steps).map(|i| {
            quintic
                .curve()
                .point_and_tangent(f64::from(i) / f64::from(steps))
                .unwrap()
        });
        let start = quintic.curve().euler_rodrigues_frame(0.0).unwrap();
        let carried = rotation_minimising_frames(start, samples).unwrap();
        for (i, frame) in carried.iter().enumerate().step_by(40) {
            let exact = quintic.frame(i as f64 / f64::from(steps)).unwrap();
            // Double reflection has order 4: 2e-11 at 400 steps on this curve.
            assert!(exact.angle_to(frame).abs() < 1e-10);
        }
    }

    #[test]
    fn the_multiplier_has_the_modulus_of_the_speed() {
        let quintic = example();
        let squared =
            bernstein::product_with(&quintic.multiplier, &quintic.multiplier, |a, b| a.dot(*b));
        for (found, speed) in squared
            .iter()
            .zip(quintic.curve().arc_length().speed_coefficients())
        {
            assert!((found - speed).abs() < 1e-14);
        }
    }

    #[test]
    fn g1_data_are_interpolated() {
        let cases = [
            (
                DVec3::new(1.0, 0.4, 0.2),
                DVec3::new(1.0, 1.0, 0.6),
                DVec3::new(0.3, 1.2, -0.2),
            ),
            (DVec3::X, DVec3::new(2.0, 0.5, 0.3), DVec3::Y),
            (
                DVec3::new(0.0, 1.0, 0.5),
                DVec3::new(3.0, 0.0, 0.0),
                DVec3::new(0.0, -1.0, 0.5),
            ),
            (DVec3::X, DVec3::X, DVec3::X),
        ];
        for (start_tangent, end, end_tangent) in cases {
            let quintic =
                RationalFrameQuintic::interpolate(DVec3::ZERO, start_tangent, end, end_tangent)
                    .unwrap();
            let curve = quintic.curve();
            assert!((curve.point(1.0) - end).length() < 1e-12 * end.length());
            assert!(curve.velocity(0.0).angle_between(start_tangent) < 1e-7);
            assert!(curve.velocity(1.0).angle_between(end_tangent) < 1e-7);
            assert!(curve.bending_energy().is_finite());
        }
    }

    /// Data that have an interpolant only at a ratio of the end speeds that has to be found, at any size.
    #[test]
    fn the_ratio_of_the_end_speeds_is_found() {
        let (start_tangent, end, end_tangent) = (
            DVec3::new(-0.96668, -0.20691, -0.15070),
            DVec3::new(-0.13388, -0.28800, 0.36844),
            DVec3::new(-0.07906, -0.01934, -0.99668),
        );
        let plain = RationalFrameQuintic::interpolate(DVec3::ZERO, start_tangent, end, end_tangent)
            .unwrap();
        for size in [2.0_f64.powi(-400), 1.0, 2.0_f64.powi(400)] {
            let quintic = RationalFrameQuintic::interpolate(
                DVec3::ZERO,
                size * start_tangent,
                size * end,
                size * end_tangent,
            )
            .unwrap();
            let curve = quintic.curve();
            assert!((curve.point(1.0) / size - end).length() < 1e-12 * end.length());
            let tangent = |t: f64| direction(curve.velocity(t)).unwrap();
            assert!((tangent(0.0) - start_tangent.normalize()).length() < 1e-12);
            assert!((tangent(1.0) - end_tangent.normalize()).length() < 1e-12);
            let growth = curve.arc_length().total() / size / plain.curve().arc_length().total();
            assert!((growth - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn other_curves_are_refused() {
        let plain = SpatialPh::try_new(
            DVec3::ZERO,
            [
                Quaternion::new(1.0, 0.0, 0.0, 0.0),
                Quaternion::new(0.0, 0.0, 1.0, 0.0),
                Quaternion::new(1.0, 1.0, 0.0, 1.0),
            ],
        )
        .unwrap();
        assert!(matches!(
            RationalFrameQuintic::try_new(plain),
            Err(Error::NotRationalFrame { .. })
        ));
        let nowhere =
            RationalFrameQuintic::interpolate(DVec3::ZERO, DVec3::X, DVec3::ZERO, DVec3::X);
        assert!(matches!(nowhere, Err(Error::ZeroDirection { .. })));
    }
}
