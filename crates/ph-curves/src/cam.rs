//! The inverse problem of cams: from the motion that is wanted to the oval of constant width that produces it.

use std::f64::consts::{PI, TAU};

use crate::{Error, Rosette, SupportJet, interpolate_constant_width};

/// A periodic motion of a flat follower, as a function of the cam's angle in radians: the lift and its first two derivatives.
///
/// Under uniform rotation a flat follower is pushed by the support function of the cam, so that the lift *is* the support.
/// Closures `Fn(f64) -> [f64; 3]` are lifts; [`HarmonicLift`] makes one of samples.
pub trait Lift {
    /// Lift, first and second derivative at `angle`.
    fn jet(&self, angle: f64) -> [f64; 3];
}

impl<F: Fn(f64) -> [f64; 3]> Lift for F {
    fn jet(&self, angle: f64) -> [f64; 3] {
        self(angle)
    }
}

/// A trigonometric polynomial: `mean + Σ cosines[k-1] cos kψ + sines[k-1] sin kψ`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HarmonicLift {
    /// The mean lift.
    pub mean: f64,
    /// Coefficients of `(cos kψ, sin kψ)` for `k = 1, 2, ...`
    pub harmonics: Vec<(f64, f64)>,
}

impl HarmonicLift {
    /// The least-squares fit to samples at equal steps over one turn, with the given number of harmonics.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] unless there are more than two samples a harmonic; [`Error::NonFinite`], also for samples so
    /// large that a coefficient overflows.
    pub fn fit(samples: &[f64], harmonics: usize) -> Result<Self, Error> {
        let needed = harmonics.saturating_mul(2).saturating_add(1);
        if samples.len() < needed {
            return Err(Error::TooFew {
                what: "samples of a lift",
                given: samples.len(),
                needed,
            });
        }
        if samples.iter().any(|sample| !sample.is_finite()) {
            return Err(Error::NonFinite {
                what: "sample of a lift",
            });
        }
        let count = samples.len() as f64;
        let coefficient = |k: usize| {
            let waves = samples.iter().enumerate().map(|(i, sample)| {
                // Angles reduced modulo a turn in integers, so that high harmonics keep their digits.
                let (sine, cosine) = (TAU * ((k * i) % samples.len()) as f64 / count).sin_cos();
                (sample / count * cosine, sample / count * sine)
            });
            let (cosine, sine) =
                waves.fold((0.0, 0.0), |sum, wave| (sum.0 + wave.0, sum.1 + wave.1));
            (2.0 * cosine, 2.0 * sine)
        };
        let lift = Self {
            mean: samples.iter().map(|sample| sample / count).sum(),
            harmonics: (1..=harmonics).map(coefficient).collect(),
        };
        let finite = |(cosine, sine): &(f64, f64)| cosine.is_finite() && sine.is_finite();
        if !(lift.mean.is_finite() && lift.harmonics.iter().all(finite)) {
            return Err(Error::NonFinite {
                what: "coefficient of a lift",
            });
        }
        Ok(lift)
    }
}

impl HarmonicLift {
    /// The lift without its even harmonics: the nearest motion that a cam of constant width can follow, whose width is
    /// twice the mean. It changes the motion, and so has to be asked for.
    #[must_use]
    pub fn antisymmetric(mut self) -> Self {
        for even in self.harmonics.iter_mut().skip(1).step_by(2) {
            *even = (0.0, 0.0);
        }
        self
    }
}

impl Lift for HarmonicLift {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let mut jet = [self.mean, 0.0, 0.0];
        for ((cosine, sine), k) in self.harmonics.iter().zip(1..) {
            let frequency = f64::from(k);
            let (s, c) = (frequency * angle).sin_cos();
            jet[0] += cosine * c + sine * s;
            jet[1] += frequency * (sine * c - cosine * s);
            jet[2] -= frequency * frequency * (cosine * c + sine * s);
        }
        jet
    }
}

/// The part of a lift that a cam of constant width can follow: `(X(ψ) - X(ψ + π)) / 2 + width / 2`.
///
/// Projecting changes the motion; it has to be asked for.
#[derive(Clone, Copy, Debug)]
pub struct Antisymmetric<L> {
    /// The lift as wanted.
    pub lift: L,
    /// The width of the cam.
    pub width: f64,
}

impl<L: Lift> Lift for Antisymmetric<L> {
    fn jet(&self, angle: f64) -> [f64; 3] {
        let (here, there) = (self.lift.jet(angle), self.lift.jet(angle + PI));
        let half = |i: usize| 0.5 * (here[i] - there[i]);
        [half(0) + 0.5 * self.width, half(1), half(2)]
    }
}

/// A cam in a frame with two parallel flat sides: an oval of constant width whose rotation moves the frame as given.
///
/// ```
/// use ph_curves::{Cam, Error, HarmonicLift};
///
/// // The motion as measured: 48 samples over one turn, in millimetres, with some noise.
/// let samples: Vec<f64> = (0..48)
///     .map(|i| {
///         let angle = std::f64::consts::TAU * f64::from(i) / 48.0;
///         20.0 + 1.2 * (3.0 * angle).cos() + 0.01 * (7.3 * f64::from(i)).sin()
///     })
///     .collect();
/// let lift = HarmonicLift::fit(&samples, 5)?;
///
/// // No cam follows it exactly: the lift and its half turn do not add up everywhere ...
/// assert!(matches!(Cam::try_new(&lift, 12), Err(Error::NotAntisymmetric { .. })));
/// // ... but one follows the part that can be followed, and says how well.
/// let cam = Cam::try_new(&lift.antisymmetric(), 12)?;
/// assert!((cam.width - 40.0).abs() < 0.01 && cam.least_radius > 0.0);
/// assert!(cam.error_at_samples(&samples) < 0.02);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    /// The profile, rational PH arcs of class 5, G2, with its centre of rotation at the origin.
    pub profile: Rosette<6>,
    /// The distance of the two sides of the frame.
    pub width: f64,
    /// The largest difference between the lift that the profile produces and the given one, measured densely.
    pub lift_error: f64,
    /// The smallest radius of curvature that the lift asks for.
    pub least_radius: f64,
}

/// Checks are made at this many angles an arc.
const SAMPLES_AN_ARC: usize = 64;
/// The lift error, of order 6, is at rounding with far fewer arcs; the samples of these still fit into memory.
const MOST_ARCS: usize = 1 << 16;
/// A lift and its half turn must add up to the width within this share of it.
const SYMMETRY_TOLERANCE: f64 = 1e-9;

impl Cam {
    /// The cam for a lift, with `arcs_per_half_turn` arcs on each half; the lift error falls with the sixth power of it.
    ///
    /// # Errors
    ///
    /// The reason why there is no such cam: [`Error::NotAntisymmetric`] where `X(ψ) + X(ψ + π)` is not constant (see
    /// [`Antisymmetric`]), [`Error::NotConvex`] where `X + X''` is not positive, [`Error::NotRegular`] if there are too few
    /// arcs for the profile to follow; [`Error::TooFew`] for less than 2 arcs, [`Error::TooMany`] for more than 65536;
    /// [`Error::NonFinite`].
    pub fn try_new(lift: &impl Lift, arcs_per_half_turn: usize) -> Result<Self, Error> {
        if arcs_per_half_turn < 2 {
            return Err(Error::TooFew {
                what: "arcs of a half turn",
                given: arcs_per_half_turn,
                needed: 2,
            });
        }
        if arcs_per_half_turn > MOST_ARCS {
            return Err(Error::TooMany {
                what: "arcs of a half turn",
                given: arcs_per_half_turn,
                most: MOST_ARCS,
            });
        }
        let count = SAMPLES_AN_ARC * arcs_per_half_turn;
        let angle = |i: usize| PI * i as f64 / count as f64;
        let jets: Vec<[f64; 3]> = (0..2 * count).map(|i| lift.jet(angle(i))).collect();
        if jets.iter().flatten().any(|value| !value.is_finite()) {
            return Err(Error::NonFinite {
                what: "lift of a cam",
            });
        }
        let width = jets.iter().map(|jet| jet[0]).sum::<f64>() / count as f64;
        check_symmetry(&jets, width, angle)?;
        let least_radius = check_convexity(&jets, angle)?;
        let nodes: Vec<(f64, SupportJet)> = (0..arcs_per_half_turn)
            .map(|j| {
                let [support, slope, bend] = jets[SAMPLES_AN_ARC * j];
                (
                    angle(SAMPLES_AN_ARC * j),
                    SupportJet {
                        support,
                        slope,
                        bend,
                    },
                )
            })
            .collect();
        let profile = interpolate_constant_width(width, &nodes)?;
        let miss =
            |(i, jet): (usize, &[f64; 3])| (profile.contact(angle(i)).support - jet[0]).abs();
        let lift_error = jets.iter().enumerate().map(miss).fold(0.0, f64::max);
        Ok(Self {
            profile,
            width,
            lift_error,
            least_radius,
        })
    }
}

impl Cam {
    /// The largest difference between the lift that the profile produces and samples at equal steps over one turn;
    /// NaN if a sample is.
    #[must_use]
    pub fn error_at_samples(&self, samples: &[f64]) -> f64 {
        let step = TAU / samples.len() as f64;
        samples
            .iter()
            .enumerate()
            .map(|(i, lift)| (self.profile.contact(step * i as f64).support - lift).abs())
            // Unlike `max`, this keeps a NaN.
            .fold(0.0, |largest: f64, error| {
                if largest.is_nan() || error <= largest {
                    largest
                } else {
                    error
                }
            })
    }
}

fn check_symmetry(
    jets: &[[f64; 3]],
    width: f64,
    angle: impl Fn(usize) -> f64,
) -> Result<(), Error> {
    let (first, second) = jets.split_at(jets.len() / 2);
    let defects = first
        .iter()
        .zip(second)
        .map(|(here, there)| here[0] + there[0] - width);
    let worst = defects
        .enumerate()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    match worst {
        Some((i, defect)) if defect.abs() > SYMMETRY_TOLERANCE * width.abs() => {
            Err(Error::NotAntisymmetric {
                angle: angle(i),
                defect,
            })
        }
        _ => Ok(()),
    }
}

fn check_convexity(jets: &[[f64; 3]], angle: impl Fn(usize) -> f64) -> Result<f64, Error> {
    let radii = jets.iter().map(|jet| jet[0] + jet[2]).enumerate();
    match radii.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((_, radius)) if radius > 0.0 => Ok(radius),
        Some((i, radius)) => Err(Error::NotConvex {
            angle: angle(i),
            radius,
        }),
        None => Err(Error::TooFew {
            what: "samples of a lift",
            given: 0,
            needed: 1,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lift(angle: f64) -> [f64; 3] {
        HarmonicLift {
            mean: 5.0,
            harmonics: vec![(0.0, 0.0), (0.0, 0.0), (0.3, 0.0), (0.0, 0.0), (0.0, 0.05)],
        }
        .jet(angle)
    }

    #[test]
    fn the_cam_moves_its_frame_as_asked_with_order_six() {
        let errors: Vec<f64> = [6, 12, 24]
            .map(|arcs| Cam::try_new(&lift, arcs).unwrap().lift_error)
            .to_vec();
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 6.0).abs() < 0.3, "order {order}");
        }
        let cam = Cam::try_new(&lift, 6).unwrap();
        let (least, most) = cam.profile.width_range(1000);
        assert!(most - least < 1e-12 && (most - 10.0).abs() < 1e-12);
        assert!((cam.profile.perimeter() - PI * 10.0).abs() < 1e-11);
    }

    #[test]
    fn impossible_motions_are_refused_with_their_reason() {
        let even = |angle: f64| {
            let (s, c) = (2.0 * angle).sin_cos();
            [5.0 + 0.2 * c, -0.4 * s, -0.8 * c]
        };
        assert!(matches!(
            Cam::try_new(&even, 6),
            Err(Error::NotAntisymmetric { .. })
        ));
        let round = Cam::try_new(
            &Antisymmetric {
                lift: even,
                width: 10.0,
            },
            6,
        )
        .unwrap();
        assert!(round.lift_error < 1e-12 && (round.least_radius - 5.0).abs() < 1e-12);
        let sharp = HarmonicLift {
            mean: 5.0,
            harmonics: vec![(0.0, 0.0), (0.0, 0.0), (0.7, 0.0)],
        };
        assert!(matches!(
            Cam::try_new(&sharp, 6),
            Err(Error::NotConvex { .. })
        ));
        assert!(matches!(
            Cam::try_new(&|_| [f64::NAN; 3], 6),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(Cam::try_new(&lift, 1), Err(Error::TooFew { .. })));
        for arcs in [usize::MAX, 1 << 63, 1 << 40] {
            assert!(matches!(
                Cam::try_new(&lift, arcs),
                Err(Error::TooMany { .. })
            ));
        }
    }

    #[test]
    fn hostile_samples_are_refused_or_remembered() {
        for harmonics in [usize::MAX, 1 << 63] {
            assert!(matches!(
                HarmonicLift::fit(&[1.0, 2.0, 3.0], harmonics),
                Err(Error::TooFew { .. })
            ));
        }
        let large = HarmonicLift::fit(&[1e308; 3], 1).unwrap();
        assert!((large.mean / 1e308 - 1.0).abs() < 1e-15);
        let wave = [
            f64::MAX,
            -f64::MAX,
            -f64::MAX,
            f64::MAX,
            f64::MAX,
            -f64::MAX,
        ];
        // The first harmonic of this square wave is a third higher.
        assert!(matches!(
            HarmonicLift::fit(&wave, 2),
            Err(Error::NonFinite { .. })
        ));
        let cam = Cam::try_new(&lift, 6).unwrap();
        assert!(cam.error_at_samples(&[f64::NAN]).is_nan());
        assert!(cam.error_at_samples(&[f64::NAN, 5.0, 5.0]).is_nan());
        assert_eq!(cam.error_at_samples(&[f64::INFINITY]), f64::INFINITY);
    }

    #[test]
    fn noisy_samples_are_refused_with_their_reason_and_followed_on_request() {
        let noisy = |height: f64| -> Vec<f64> {
            (0..64)
                .map(|i| {
                    let angle = TAU * f64::from(i) / 64.0;
                    5.0 + height * (3.0 * angle).cos() + 1e-3 * (7.3 * f64::from(i)).sin()
                })
                .collect()
        };
        let samples = noisy(0.3);
        let lift = HarmonicLift::fit(&samples, 5).unwrap();
        match Cam::try_new(&lift, 12) {
            Err(Error::NotAntisymmetric { defect, .. }) => assert!(defect.abs() < 2e-3),
            other => panic!("{other:?}"),
        }
        let cam = Cam::try_new(&lift.antisymmetric(), 12).unwrap();
        assert!(
            cam.error_at_samples(&samples) < 2e-3,
            "{}",
            cam.error_at_samples(&samples)
        );
        // Radius 5 - 8 * 0.7 < 0.
        let sharp = HarmonicLift::fit(&noisy(0.7), 5).unwrap().antisymmetric();
        assert!(matches!(
            Cam::try_new(&sharp, 12),
            Err(Error::NotConvex { radius, .. }) if radius < -0.4
        ));
    }

    #[test]
    fn samples_give_their_harmonics_back() {
        let samples: Vec<f64> = (0..32)
            .map(|i| lift(TAU * f64::from(i) / 32.0)[0])
            .collect();
        let fitted = HarmonicLift::fit(&samples, 7).unwrap();
        assert!((fitted.mean - 5.0).abs() < 1e-14);
        assert!(
            (fitted.harmonics[2].0 - 0.3).abs() < 1e-14
                && (fitted.harmonics[4].1 - 0.05).abs() < 1e-14
        );
        assert!(Cam::try_new(&fitted, 12).is_ok());
        assert!(matches!(
            HarmonicLift::fit(&samples[..14], 7),
            Err(Error::TooFew { .. })
        ));
    }
}
