//! Networks of ribbons that cross.
//!
//! Section 3.2 of the thesis chapter: reconstructed ribbons "do not always cross as expected, so that corrections
//! are necessary", and their lengths are fixed. Here the tangents are turned as little as possible (least squares)
//! such that every crossing closes exactly; the arc lengths of sensors and crossings stay what they are.

mod correction;

use crate::CornerData;
use crate::spatial::SpatialRibbon;
use crate::{Error, RibbonCurve};
use glam::DVec3;

/// A place where two ribbons meet: their indices and the arc lengths of the place on each.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// The two ribbons.
    pub ribbons: [usize; 2],
    /// Arc lengths on them.
    pub s: [f64; 2],
}

/// Ribbons in space that meet in their crossings.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "StoredNetwork")
)]
pub struct RibbonNetwork {
    ribbons: Vec<SpatialRibbon>,
    origins: Vec<DVec3>,
    crossings: Vec<Crossing>,
    gap_before: f64,
    gap: f64,
    largest_turn: f64,
}

/// Gap at a crossing accepted, relative to the longest ribbon: rounding of the integration.
const CLOSED: f64 = 1e-11;
/// Newton steps; quadratic convergence needs about five.
const STEPS: usize = 30;

impl RibbonNetwork {
    /// The network of these ribbons. The first one's start is the origin; the others are placed by their crossings.
    ///
    /// Minimises the sum of squared turns of all tangents under the constraints that all crossings close, by Newton's
    /// iteration on the linearised constraints (each step a least-norm problem of the size of the crossings).
    ///
    /// # Errors
    /// [`Error::TooFew`] without ribbons or crossings; [`Error::OutOfRange`] for a crossing off its ribbon, of a
    /// ribbon that is not there, or of a ribbon with itself; [`Error::Disconnected`] for a ribbon that no chain of
    /// crossings ties to the first; [`Error::NoConvergence`] when the crossings contradict the lengths, those of
    /// [`SpatialRibbon::new`] for ribbons turned out of shape.
    pub fn new(ribbons: Vec<SpatialRibbon>, crossings: Vec<Crossing>) -> Result<Self, Error> {
        check(&ribbons, &crossings)?;
        let size = ribbons.iter().map(length).fold(0.0, f64::max);
        let measured: Vec<Vec<DVec3>> = ribbons
            .iter()
            .map(|ribbon| ribbon.tangents().to_vec())
            .collect();
        let origins = vec![DVec3::ZERO; ribbons.len()];
        let mut network = Self {
            ribbons,
            origins,
            crossings,
            gap_before: f64::NAN,
            gap: f64::INFINITY,
            largest_turn: 0.0,
        };
        network.place()?;
        for _ in 0..STEPS {
            network.gap = network
                .gaps()?
                .iter()
                .map(|gap| gap.length())
                .fold(0.0, f64::max);
            if network.gap_before.is_nan() {
                network.gap_before = network.gap;
            }
            if network.gap <= CLOSED * size {
                let turns = network
                    .ribbons
                    .iter()
                    .zip(&measured)
                    .flat_map(|(r, m)| r.tangents().iter().zip(m));
                network.largest_turn = turns.map(|(a, b)| a.angle_between(*b)).fold(0.0, f64::max);
                return Ok(network);
            }
            network.step(&measured)?;
        }
        Err(Error::NoConvergence {
            what: "closing the crossings",
            steps: STEPS,
        })
    }

    /// The ribbons after the correction, each from its own origin.
    #[must_use]
    pub fn ribbons(&self) -> &[SpatialRibbon] {
        &self.ribbons
    }

    /// Where the ribbons start.
    #[must_use]
    pub fn origins(&self) -> &[DVec3] {
        &self.origins
    }

    /// The crossings.
    #[must_use]
    pub fn crossings(&self) -> &[Crossing] {
        &self.crossings
    }

    /// The largest gap at a crossing with the ribbons as measured, put together as well as they can be.
    #[must_use]
    pub fn gap_before(&self) -> f64 {
        self.gap_before
    }

    /// The largest gap at a crossing after the correction.
    #[must_use]
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// The largest angle by which a tangent was turned, radians.
    #[must_use]
    pub fn largest_turn(&self) -> f64 {
        self.largest_turn
    }

    /// The position on a ribbon.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a ribbon that is not there; [`Error::NotIntegrable`] for an absurd arc length.
    pub fn point(&self, ribbon: usize, s: f64) -> Result<DVec3, Error> {
        let (Some(found), Some(origin)) = (self.ribbons.get(ribbon), self.origins.get(ribbon))
        else {
            return Err(Error::OutOfRange {
                what: "ribbon",
                value: ribbon as f64,
                range: [0.0, self.ribbons.len() as f64 - 1.0],
            });
        };
        Ok(*origin + found.point(s)?)
    }

    /// A stretch of a ribbon, in place, as a curve over `[0, 1]`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a ribbon that is not there or a stretch off it.
    pub fn curve(&self, ribbon: usize, start: f64, end: f64) -> Result<RibbonCurve, Error> {
        let origin = self.point(
            ribbon,
            self.ribbons.get(ribbon).map_or(0.0, |r| r.arc_lengths()[0]),
        )?;
        RibbonCurve::new(self.ribbons[ribbon].clone(), start, end, origin)
    }

    /// What the network says about the surface at a crossing: point, tangent plane of the two ribbons, and the normal
    /// components of their curvature. The parts of the curvature vectors along the surface are measuring errors, as
    /// ribbons lie along geodesics; their size is returned too, one over length.
    ///
    /// The first ribbon of the crossing is the one along `u`, both in the direction of increasing arc length.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a crossing that is not there; those of [`CornerData::new`].
    pub fn corner(&self, crossing: usize) -> Result<(CornerData, f64), Error> {
        let Some(&Crossing {
            ribbons: [a, b],
            s: [sa, sb],
        }) = self.crossings.get(crossing)
        else {
            let range = [0.0, self.crossings.len() as f64 - 1.0];
            return Err(Error::OutOfRange {
                what: "crossing",
                value: crossing as f64,
                range,
            });
        };
        let (first, second) = (&self.ribbons[a], &self.ribbons[b]);
        let tangents = [first.tangent(sa), second.tangent(sb)];
        let normal = tangents[0].cross(tangents[1]);
        let point = 0.5 * (self.point(a, sa)? + self.point(b, sb)?);
        let bends = [first.curvature_vector(sa), second.curvature_vector(sb)];
        let unit = normal.normalize_or_zero();
        let sideways = bends
            .iter()
            .map(|bend| (*bend - unit * bend.dot(unit)).length())
            .fold(0.0, f64::max);
        let data = CornerData::new(point, normal, tangents, bends.map(|bend| bend.dot(unit)))?;
        Ok((data, sideways))
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "RibbonNetwork")]
struct StoredNetwork {
    ribbons: Vec<SpatialRibbon>,
    origins: Vec<DVec3>,
    crossings: Vec<Crossing>,
    gap_before: f64,
    gap: f64,
    largest_turn: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<StoredNetwork> for RibbonNetwork {
    type Error = Error;

    fn try_from(stored: StoredNetwork) -> Result<Self, Error> {
        /// Gap accepted, in parts of the one that was: the numbers may have lost their last digit.
        const STORED: f64 = 10.0;
        let StoredNetwork {
            ribbons,
            origins,
            crossings,
            gap_before,
            gap,
            largest_turn,
        } = stored;
        check(&ribbons, &crossings)?;
        let finite = [gap_before, gap, largest_turn]
            .iter()
            .all(|x| x.is_finite());
        if origins.len() != ribbons.len() || !finite {
            return Err(Error::Stored {
                what: "origins of a network",
            });
        }
        let size = ribbons.iter().map(length).fold(0.0, f64::max);
        let network = Self {
            ribbons,
            origins,
            crossings,
            gap_before,
            gap,
            largest_turn,
        };
        let mut gaps = network.gaps()?.into_iter().map(DVec3::length);
        if gaps.all(|gap| gap <= STORED * CLOSED * size) {
            Ok(network)
        } else {
            Err(Error::Stored {
                what: "crossings of a network",
            })
        }
    }
}

fn length(ribbon: &SpatialRibbon) -> f64 {
    let s = ribbon.arc_lengths();
    s[s.len() - 1] - s[0]
}

fn check(ribbons: &[SpatialRibbon], crossings: &[Crossing]) -> Result<(), Error> {
    if ribbons.is_empty() || (crossings.is_empty() && ribbons.len() > 1) {
        let what = if ribbons.is_empty() {
            "ribbons"
        } else {
            "crossings"
        };
        return Err(Error::TooFew {
            what,
            needed: 1,
            got: 0,
        });
    }
    for crossing in crossings {
        let [a, b] = crossing.ribbons;
        for (ribbon, s) in crossing.ribbons.into_iter().zip(crossing.s) {
            let Some(found) = ribbons.get(ribbon).filter(|_| a != b) else {
                return Err(Error::OutOfRange {
                    what: "ribbon of a crossing",
                    value: ribbon as f64,
                    range: [0.0, ribbons.len() as f64 - 1.0],
                });
            };
            let knots = found.arc_lengths();
            let range = [knots[0], knots[knots.len() - 1]];
            if !(range[0] <= s && s <= range[1]) {
                return Err(Error::OutOfRange {
                    what: "arc length of a crossing",
                    value: s,
                    range,
                });
            }
        }
    }
    let mut reached = vec![false; ribbons.len()];
    reached[0] = true;
    for _ in 0..ribbons.len() {
        for crossing in crossings {
            let [a, b] = crossing.ribbons;
            let either = reached[a] || reached[b];
            (reached[a], reached[b]) = (either, either);
        }
    }
    match reached.iter().position(|r| !r) {
        Some(ribbon) => Err(Error::Disconnected { ribbon }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Noise;
    use crate::{EndCondition, TangentMethod};

    /// Great circles of the unit sphere through given points: ribbons laid on a ball.
    fn arc(
        from: DVec3,
        towards: DVec3,
        length: f64,
        noise: &mut Noise,
        sigma: f64,
    ) -> SpatialRibbon {
        let across = (towards - from * from.dot(towards)).normalize();
        let s: Vec<f64> = (0..24).map(|i| length * f64::from(i) / 23.0).collect();
        let tangents: Vec<DVec3> = s
            .iter()
            .map(|s| across * s.cos() - from * s.sin() + noise.gaussian_vector() * sigma)
            .collect();
        SpatialRibbon::new(&s, &tangents).unwrap()
    }

    /// Three meridians and three lines across, all great circles, with their crossings by arc length.
    fn ball(sigma: f64) -> Result<RibbonNetwork, Error> {
        let mut noise = Noise::new(9);
        let start = |k: usize| {
            let (sin, cos) = (0.4 * k as f64 - 0.4).sin_cos();
            (
                DVec3::new(cos, sin, -0.6).normalize(),
                DVec3::new(cos, sin, 0.6).normalize(),
            )
        };
        let low = |k: usize| {
            let h = 0.35 * k as f64 - 0.35;
            (
                DVec3::new(1.0, -0.7, h).normalize(),
                DVec3::new(1.0, 0.7, h).normalize(),
            )
        };
        let lines: Vec<(DVec3, DVec3)> = (0..3).map(start).chain((0..3).map(low)).collect();
        let ribbons = lines
            .iter()
            .map(|(a, b)| arc(*a, *b, a.angle_between(*b), &mut noise, sigma))
            .collect();
        let mut crossings = Vec::new();
        for i in 0..3 {
            for j in 3..6 {
                let normal = |k: usize| lines[k].0.cross(lines[k].1);
                let meet = normal(i).cross(normal(j)).normalize();
                let meet = if meet.x < 0.0 { -meet } else { meet };
                crossings.push(Crossing {
                    ribbons: [i, j],
                    s: [i, j].map(|k| lines[k].0.angle_between(meet)),
                });
            }
        }
        RibbonNetwork::new(ribbons, crossings)
    }

    #[test]
    fn noisy_ribbons_cross_where_they_should_and_keep_their_lengths() {
        let network = ball(0.01).unwrap();
        assert!(network.gap_before() > 1e-3, "{}", network.gap_before());
        assert!(network.gap() < 1e-10);
        assert!(network.largest_turn() < 0.05, "{}", network.largest_turn());
        let exact = ball(0.0).unwrap();
        assert!(exact.gap_before() < 1e-5 && exact.largest_turn() < 1e-4);
        let (corner, sideways) = exact.corner(4).unwrap();
        // The middle crossing lies on the ball of radius one: both ribbons bend towards its centre.
        assert!(
            corner
                .curvatures()
                .iter()
                .all(|k| (k.abs() - 1.0).abs() < 1e-3),
            "{corner:?}"
        );
        assert!(sideways < 1e-3);
    }

    /// Every small turn that respects the crossings enlarges the deviation: the correction is the least one.
    #[test]
    fn the_correction_is_stationary() {
        let network = ball(0.01).unwrap();
        let again =
            RibbonNetwork::new(network.ribbons().to_vec(), network.crossings().to_vec()).unwrap();
        assert!(again.largest_turn() < 1e-9);
    }

    /// The corrected ribbons are what their tangents give by the method and with the ends that they came with.
    #[test]
    fn ribbons_keep_their_method_and_ends() {
        let bent = |h: f64, method, end| {
            let s: Vec<f64> = (0..12).map(|i| 0.09 * f64::from(i)).collect();
            let from = DVec3::new(1.0, -0.5, h).normalize();
            let across = (DVec3::Y - from * from.y).normalize();
            let tangent = |(i, s): (usize, &f64)| {
                across * s.cos() - from * s.sin() + DVec3::Z * (0.02 * ((i * 7 % 5) as f64 - 2.0))
            };
            let tangents: Vec<DVec3> = s.iter().enumerate().map(tangent).collect();
            SpatialRibbon::with_method(&s, &tangents, method, end).unwrap()
        };
        let crossings = [[0.1, 0.12], [0.8, 0.85]].map(|s| Crossing { ribbons: [0, 1], s });
        for (method, end) in [
            (TangentMethod::Projected, EndCondition::Natural),
            (TangentMethod::SphericalSpline, EndCondition::NotAKnot),
        ] {
            let ribbons = vec![bent(0.0, method, end), bent(0.1, method, end)];
            let network = RibbonNetwork::new(ribbons.clone(), crossings.to_vec()).unwrap();
            assert!(network.gap_before() > 1e-4, "{}", network.gap_before());
            // A crossing listed twice, also the other way round, says nothing new.
            let mut twice = crossings.to_vec();
            let [s, t] = crossings[0].s;
            twice.extend([
                crossings[1],
                Crossing {
                    ribbons: [1, 0],
                    s: [t, s],
                },
            ]);
            let again = RibbonNetwork::new(ribbons, twice).unwrap();
            assert_eq!(again.ribbons(), network.ribbons());
            for ribbon in network.ribbons() {
                assert_eq!(ribbon.method(), method);
                let again = SpatialRibbon::with_method(
                    ribbon.arc_lengths(),
                    ribbon.tangents(),
                    method,
                    end,
                );
                let (a, b) = (ribbon.points()[11], again.unwrap().points()[11]);
                assert!(a.distance(b) < 1e-12, "{}", a.distance(b));
            }
        }
    }

    #[test]
    fn bad_networks_are_refused() {
        let mut noise = Noise::new(1);
        let ribbon = || arc(DVec3::X, DVec3::Y, 1.0, &mut Noise::new(1), 0.0);
        let crossing = |a, b, s| Crossing {
            ribbons: [a, b],
            s: [s, s],
        };
        let new =
            |n: usize, crossings| RibbonNetwork::new((0..n).map(|_| ribbon()).collect(), crossings);
        assert!(matches!(new(2, vec![]), Err(Error::TooFew { .. })));
        assert!(matches!(
            new(3, vec![crossing(0, 1, 0.5)]),
            Err(Error::Disconnected { ribbon: 2 })
        ));
        assert!(matches!(
            new(2, vec![crossing(0, 5, 0.5)]),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            new(2, vec![crossing(1, 1, 0.5)]),
            Err(Error::OutOfRange { .. })
        ));
        assert!(matches!(
            new(2, vec![crossing(0, 1, f64::NAN)]),
            Err(Error::OutOfRange { .. })
        ));
        let _ = noise.uniform();
        // Two ribbons of length 1 cannot meet at starts and ends if one is told to be half as long between them.
        let contradiction = vec![
            crossing(0, 1, 0.0),
            Crossing {
                ribbons: [0, 1],
                s: [1.0, 0.2],
            },
        ];
        assert!(new(2, contradiction).is_err());
    }
}
