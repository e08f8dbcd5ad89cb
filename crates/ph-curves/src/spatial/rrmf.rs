//! Quintics with a rational rotation-minimising frame.

use bezier_mass::{VectorSpace, bernstein};
use glam::{DMat2, DVec2, DVec3};

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
/// Newton's method on the two angles is quadratic but for its difference quotients; it is given up after this many steps.
const NEWTON_STEPS: usize = 40;

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
    /// for general C1 data. For each ratio of the two lengths out of a fixed list the two angles left are solved
    /// for by Newton's method from a grid of starts; of all curves found the one of least bending energy is
    /// returned. It meets the end point to about 1e-12 of the distance.
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
            let unit = tangent.try_normalize().ok_or(Error::ZeroDirection {
                what: "end tangent of Hermite data",
            })?;
            Quaternion::square_root(unit, 0.0)
        };
        let (first, last) = (root(start_tangent)?, root(end_tangent)?);
        let chord = end - start;
        let towards = chord.try_normalize().ok_or(Error::ZeroDirection {
            what: "chord of Hermite data",
        })?;
        let mut best: Option<(f64, Self)> = None;
        for ratio in [1.0, 0.5, 2.0, 0.25, 4.0] {
            let ends = (first, last.times(f64::sqrt(ratio)));
            for angles in grid().step_by(3) {
                let Some(preimage) = solve_direction(ends, towards, angles) else {
                    continue;
                };
                let scale = (chord.length() / displacement(&preimage).length()).sqrt();
                let curve = SpatialPh::try_new(start, preimage.map(|a| a.times(scale)))?;
                let energy = some_number(curve.bending_energy());
                if best.as_ref().is_none_or(|(least, _)| energy < *least)
                    && let Ok(found) = Self::try_new(curve)
                {
                    best = Some((energy, found));
                }
            }
        }
        best.map(|(_, found)| found).ok_or(Error::NoInterpolant {
            what: "RRMF quintic",
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

/// Newton's method for the angle of the last coefficient and the angle of the middle one such that the chord points `towards`.
fn solve_direction(
    (first, last): (Quaternion, Quaternion),
    towards: DVec3,
    start: DVec2,
) -> Option<[Quaternion; 3]> {
    let preimage_at = |angles: DVec2| {
        let last = last.product(Quaternion::turn_about_i(angles.x));
        Some([
            first,
            Quaternion::square_root(first.polar_image(last), angles.y).ok()?,
            last,
        ])
    };
    let (side, up) = towards.any_orthonormal_pair();
    let defect = |angles: DVec2| {
        let chord = displacement(&preimage_at(angles)?).try_normalize()?;
        Some((
            DVec2::new(chord.dot(side), chord.dot(up)),
            chord.dot(towards),
        ))
    };
    const DIFFERENCE: f64 = 1e-6;
    let mut angles = start;
    for _ in 0..NEWTON_STEPS {
        let (value, along) = defect(angles)?;
        if value.length() <= 4.0 * f64::EPSILON {
            return if along > 0.0 {
                preimage_at(angles)
            } else {
                None
            };
        }
        let slope = |step: DVec2| {
            Some((defect(angles + step)?.0 - defect(angles - step)?.0) / (2.0 * DIFFERENCE))
        };
        let jacobian =
            DMat2::from_cols(slope(DVec2::X * DIFFERENCE)?, slope(DVec2::Y * DIFFERENCE)?);
        if jacobian.determinant().abs() < 1e-12 {
            return None;
        }
        angles -= (jacobian.inverse() * value).clamp_length_max(0.5);
    }
    // Rounding of the last few units may keep the defect above its threshold.
    let (value, along) = defect(angles)?;
    if value.length() <= 1e-13 && along > 0.0 {
        preimage_at(angles)
    } else {
        None
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
