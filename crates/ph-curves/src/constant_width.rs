//! Rosettes of constant width: as involutes of a chain of Tschirnhausen cubics around a polygon, and by their dual control.

use std::f64::consts::PI;

use glam::DVec2;

use crate::{Error, PhArc, Rosette, TCubic, TQuartic};

/// A chain of Tschirnhausen cubics tangent to the sides of a polygon with an odd number `n` of vertices: the common evolute
/// of rosettes of constant width made of `2n` T-quartics.
///
/// A triangle gives ovals, a convex polygon rosettes of index `n - 2`, a star its own. Consecutive cubics meet in cusps.
#[derive(Clone, Debug, PartialEq)]
pub struct EvolutePolygon {
    cubics: Vec<TCubic>,
    half_turnings: Vec<f64>,
    alternating_lengths: Vec<f64>,
    covering: usize,
}

impl EvolutePolygon {
    /// The one chain of T-cubics `(P_j, A_j, A_{j+1}, P_{j+1})` around the polygon `A_0, A_1, ...`.
    ///
    /// With interior angles `α` and side lengths `l`, half the turning of cubic `j` is
    /// `τ_j = ½ Σ (-1)^i α_{j+1+i}` over all `i`, which must be positive (condition 1.8), and the legs outside the sides are
    /// `x_0 = l_0 l_1⁻¹ l_2 ... l_{n-1}`, `x_{j+1} = l_j² / x_j`.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] for less than 3 vertices; [`Error::EvenPolygon`]; [`Error::NonFinite`]; [`Error::ZeroDirection`] for a
    /// repeated vertex; [`Error::NotLocallyConvex`] if the turns change sign; [`Error::NotCovered`] if a `τ_j` is not
    /// positive (an obtuse triangle).
    pub fn try_new(vertices: &[DVec2]) -> Result<Self, Error> {
        let count = vertices.len();
        if count < 3 {
            return Err(Error::TooFew {
                what: "vertices of a polygon",
                given: count,
                needed: 3,
            });
        }
        if count.is_multiple_of(2) {
            return Err(Error::EvenPolygon { vertices: count });
        }
        if vertices.iter().any(|vertex| !vertex.is_finite()) {
            return Err(Error::NonFinite {
                what: "vertex of a polygon",
            });
        }
        let sides: Vec<DVec2> = (0..count)
            .map(|j| vertices[(j + 1) % count] - vertices[j])
            .collect();
        if sides.contains(&DVec2::ZERO) {
            return Err(Error::ZeroDirection {
                what: "side of a polygon",
            });
        }
        let turns: Vec<f64> = (0..count)
            .map(|j| sides[(j + count - 1) % count].angle_to(sides[j]))
            .collect();
        let sign = turns[0].signum();
        if let Some(vertex) = turns.iter().position(|turn| sign * turn <= 0.0) {
            return Err(Error::NotLocallyConvex {
                vertex,
                turn: turns[vertex],
            });
        }
        let interior = |j: usize| PI - turns[j % count].abs();
        let alternating = |j: usize, value: &dyn Fn(usize) -> f64| -> f64 {
            (0..count)
                .map(|i| {
                    if i % 2 == 0 {
                        value(j + i)
                    } else {
                        -value(j + i)
                    }
                })
                .sum()
        };
        let half_turnings: Vec<f64> = (0..count)
            .map(|j| 0.5 * alternating(j + 1, &interior))
            .collect();
        if let Some(edge) = half_turnings.iter().position(|tau| *tau <= 0.0) {
            return Err(Error::NotCovered {
                edge,
                half_turning: half_turnings[edge],
            });
        }
        let lengths: Vec<f64> = sides.iter().map(|side| side.length()).collect();
        let legs = exterior_legs(&lengths);
        let exterior = |j: usize| {
            let back = sides[j].rotate(DVec2::from_angle(sign * half_turnings[j])) / lengths[j];
            vertices[j] - legs[j] * back
        };
        let cubics = (0..count).map(|j| {
            let next = (j + 1) % count;
            let points = [exterior(j), vertices[j], vertices[next], exterior(next)];
            if points.iter().all(|point| point.is_finite()) {
                Ok(TCubic::from_parts(points))
            } else {
                Err(Error::NonFinite {
                    what: "exterior point of a polygon",
                })
            }
        });
        let cubics = cubics.collect::<Result<Vec<_>, _>>()?;
        let cubic_length = |j: usize| cubics[j % count].length();
        let alternating_lengths = (0..count)
            .map(|j| parity(j) * alternating(j, &cubic_length))
            .collect();
        let covering = (half_turnings.iter().sum::<f64>() * 2.0 / PI).round() as usize;
        Ok(Self {
            cubics,
            half_turnings,
            alternating_lengths,
            covering,
        })
    }

    /// The cubics, one a side; each starts at its exterior point.
    #[must_use]
    pub fn cubics(&self) -> &[TCubic] {
        &self.cubics
    }

    /// Half the turning `τ_j` of each cubic, radians.
    #[must_use]
    pub fn half_turnings(&self) -> &[f64] {
        &self.half_turnings
    }

    /// The number `k` of tangent lines through a point far outside (the family is `k`-simple), the index of the rosettes.
    #[must_use]
    pub fn line_covering(&self) -> usize {
        self.covering
    }

    /// The width that a regular rosette must exceed.
    #[must_use]
    pub fn minimum_width(&self) -> f64 {
        self.alternating_lengths
            .iter()
            .fold(0.0, |most: f64, c| most.max(c.abs()))
    }

    /// The width from which on the largest radius of curvature is at most three times the smallest one.
    ///
    /// The radii at the joints lie between `(width ± minimum_width) / 2`, and the radius is monotone in between.
    #[must_use]
    pub fn rounded_width(&self) -> f64 {
        2.0 * self.minimum_width()
    }

    /// The rosette of the given constant width, one of the involutes, counter-clockwise.
    ///
    /// # Errors
    ///
    /// [`Error::WidthTooSmall`] unless the width exceeds [`EvolutePolygon::minimum_width`];
    /// [`Error::UncertainRadius`] for a polygon so thin that the radii of its arcs are lost in rounding (a triangle whose
    /// sides differ by a factor of about 300); [`Error::NonFinite`].
    pub fn rosette(&self, width: f64) -> Result<Rosette<4>, Error> {
        let arcs = self.arcs(width)?;
        let noise = arcs.iter().map(PhArc::radius_noise).enumerate();
        let worst = noise.max_by(|a, b| a.1.total_cmp(&b.1));
        let clockwise = arcs.first().is_some_and(|arc| arc.turning() < 0.0);
        let rosette = Rosette::try_new(if clockwise {
            arcs.iter().rev().map(PhArc::reverse).collect()
        } else {
            arcs
        });
        // An arc that turns little while its parameter changes scale has coefficients whose rounding moves its radii.
        match (rosette, worst) {
            (Err(_), Some((arc, uncertainty))) if uncertainty > RADIUS_TOLERANCE * width => {
                Err(Error::UncertainRadius {
                    edge: arc % self.cubics.len(),
                    uncertainty,
                    width,
                })
            }
            (rosette, _) => rosette,
        }
    }

    /// The `2n` T-quartics of the rosette in the order and sense of the cubics, with the start radii `(width ± c_j) / 2`,
    /// `c_j` the alternating sum of the lengths of the cubics from `j` on. The normal of the first one starts along the
    /// travel of the first cubic.
    ///
    /// # Errors
    ///
    /// As for [`EvolutePolygon::rosette`].
    pub fn arcs(&self, width: f64) -> Result<Vec<TQuartic>, Error> {
        if !width.is_finite() {
            return Err(Error::NonFinite { what: "width" });
        }
        let minimum = self.minimum_width();
        if width <= minimum {
            return Err(Error::WidthTooSmall { width, minimum });
        }
        let count = self.cubics.len();
        let differences = self.alternating_lengths.iter().copied();
        let both_rounds = differences.clone().chain(differences.map(|c| -c));
        both_rounds
            .enumerate()
            .map(|(j, difference)| {
                involute_outwards(
                    &self.cubics[j % count],
                    0.5 * (width + difference),
                    j % 2 == 0,
                )
            })
            .collect()
    }
}

/// Radii that are less certain than this share of the width, where a rosette does not close, are the reason.
const RADIUS_TOLERANCE: f64 = 1e-8;

/// `x_0 = l_0 l_1⁻¹ l_2 ...`, then `x_{j+1} = l_j² / x_j`; in logarithms, since products of many lengths may overflow.
fn exterior_legs(lengths: &[f64]) -> Vec<f64> {
    let first: f64 = lengths
        .iter()
        .enumerate()
        .map(|(j, length)| parity(j) * length.ln())
        .sum();
    let legs = lengths.iter().scan(first.exp(), |leg, length| {
        let here = *leg;
        *leg = length * length / here;
        Some(here)
    });
    legs.collect()
}

fn parity(j: usize) -> f64 {
    if j.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// The involute with the start radius `radius`, its normal along the travel of the cubic or against it.
fn involute_outwards(cubic: &TCubic, radius: f64, along: bool) -> Result<TQuartic, Error> {
    if along {
        cubic.involute(radius)
    } else {
        Ok(cubic.involute(-radius)?.flip())
    }
}

/// Support and its first two derivatives with respect to the normal angle: what a G2 joint shares.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SupportJet {
    /// `p = <N, C>`.
    pub support: f64,
    /// `p' = <T, C>`.
    pub slope: f64,
    /// `p'' = R - p`.
    pub bend: f64,
}

impl SupportJet {
    /// The jet of a curvature element: a point, its unit normal and the signed radius of curvature.
    #[must_use]
    #[inline]
    pub fn of_element(point: DVec2, normal: DVec2, radius: f64) -> Self {
        let support = normal.dot(point);
        Self {
            support,
            slope: normal.perp().dot(point),
            bend: radius - support,
        }
    }

    /// The radius of curvature `p + p''`.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.support + self.bend
    }

    /// The jet half a turn on, on a curve of constant width.
    #[must_use]
    pub fn antipode(&self, width: f64) -> Self {
        Self {
            support: width - self.support,
            slope: -self.slope,
            bend: -self.bend,
        }
    }

    /// The first three support coefficients of an arc of class `class` that starts with this jet; see
    /// [`SupportJet::numerator`].
    pub(crate) fn coefficients(&self, half_turning: (f64, f64), class: usize) -> [f64; 3] {
        let [value, first, second] = self.numerator(half_turning);
        let m = class as f64;
        let next = value + first / m;
        [value, next, second / (m * (m - 1.0)) + 2.0 * next - value]
    }

    /// The numerator `g = p |w|^2` of the support and its first two derivatives by the parameter of an arc that starts
    /// with this jet, where unit spinors h apart carry the normals; `half_turning` is the sine and cosine of h, which may
    /// be negative.
    pub(crate) fn numerator(&self, half_turning: (f64, f64)) -> [f64; 3] {
        let (sine, cosine) = half_turning;
        let slope = 2.0 * sine * self.slope;
        let bend = 4.0 * sine * sine * self.bend - 4.0 * sine * (cosine - 1.0) * self.slope;
        let (q1, q2) = (2.0 * (cosine - 1.0), 4.0 * (1.0 - cosine));
        [
            self.support,
            slope + self.support * q1,
            bend + 2.0 * slope * q1 + self.support * q2,
        ]
    }
}

/// The arc of class `N - 1 >= 5` between two normal angles with given jets at its ends, which each fix three coefficients;
/// `inner` are the free ones in between: support coefficients `g_k` in the scale of unit end normals, not moves. Adding `m` to one moves
/// its Bézier line by `m` over the length of that line's normal.
///
/// Without free coefficients (`N = 6`) this is the linear G2 Hermite interpolation by PH arcs of class 5.
///
/// # Errors
///
/// [`Error::Pencil`] below class 5; [`Error::TooFew`] unless `inner` has `N - 6` entries; [`Error::TurningTooLarge`] unless
/// `0 < end_angle - start_angle < π`; [`Error::NonFinite`].
pub fn hermite_arc<const N: usize>(
    (start_angle, start): (f64, SupportJet),
    (end_angle, end): (f64, SupportJet),
    inner: &[f64],
) -> Result<PhArc<N>, Error> {
    if N < 6 {
        return Err(Error::Pencil {
            class: N.saturating_sub(1),
        });
    }
    if inner.len() + 6 != N {
        return Err(Error::TooFew {
            what: "free coefficients",
            given: inner.len(),
            needed: N - 6,
        });
    }
    let turning = end_angle - start_angle;
    if !(turning > 0.0 && turning < PI) {
        return Err(Error::TurningTooLarge { turning });
    }
    let half = (0.5 * turning).sin_cos();
    let reversed_end = SupportJet {
        slope: -end.slope,
        ..end
    };
    let (first, last) = (
        start.coefficients(half, N - 1),
        reversed_end.coefficients(half, N - 1),
    );
    let mut g = [0.0; N];
    g[..3].copy_from_slice(&first);
    g[3..N - 3].copy_from_slice(inner);
    for (slot, value) in g.iter_mut().rev().zip(last) {
        *slot = value;
    }
    PhArc::new(
        DVec2::from_angle(0.5 * start_angle),
        DVec2::from_angle(0.5 * end_angle),
        g,
    )
}

/// The oval of constant width with given jets at increasing normal angles within half a turn, by arcs of class 5: each arc
/// joins two neighbours, the last one leads to the antipode of the first, and the other half is the inner offset at
/// the width of this one.
///
/// # Errors
///
/// [`Error::TooFew`] for less than 2 jets; [`Error::BadRadius`] unless all radii lie between 0 and the width;
/// [`Error::TurningTooLarge`] for an angle that does not exceed its predecessor, [`Error::OutsideDomain`] if the last one is half
/// a turn or more beyond the first; [`Error::NotRegular`] if a radius of curvature is not positive
/// between the jets; [`Error::NonFinite`].
pub fn interpolate_constant_width(
    width: f64,
    jets: &[(f64, SupportJet)],
) -> Result<Rosette<6>, Error> {
    let [first, .., last] = jets else {
        return Err(Error::TooFew {
            what: "curvature elements of an oval",
            given: jets.len(),
            needed: 2,
        });
    };
    let finite =
        |jet: &SupportJet| jet.support.is_finite() && jet.slope.is_finite() && jet.bend.is_finite();
    if !width.is_finite()
        || jets
            .iter()
            .any(|(angle, jet)| !angle.is_finite() || !finite(jet))
    {
        return Err(Error::NonFinite {
            what: "width or curvature element of an oval",
        });
    }
    if let Some((_, jet)) = jets
        .iter()
        .find(|(_, jet)| !(jet.radius() > 0.0 && jet.radius() < width))
    {
        return Err(Error::BadRadius {
            radius: jet.radius(),
            width,
        });
    }
    let half_turn = first.0 + PI;
    if last.0 >= half_turn {
        return Err(Error::OutsideDomain {
            value: last.0,
            start: first.0,
            end: half_turn,
        });
    }
    let closing = [(half_turn, first.1.antipode(width))];
    let ends = jets.iter().skip(1).chain(&closing);
    let half: Vec<PhArc<6>> = jets
        .iter()
        .zip(ends)
        .map(|(a, b)| hermite_arc(*a, *b, &[]))
        .collect::<Result<_, _>>()?;
    let antipodes = half
        .iter()
        .map(|arc| antipodal_arc(arc, width))
        .collect::<Result<Vec<_>, _>>()?;
    Rosette::try_new(half.into_iter().chain(antipodes).collect())
}

/// The arc with opposite normals such that both together have the given width: its own inner offset, `(i w, width q - g)`.
///
/// # Errors
///
/// [`Error::NonFinite`] for the width.
pub fn antipodal_arc<const N: usize>(arc: &PhArc<N>, width: f64) -> Result<PhArc<N>, Error> {
    let (w0, w1) = arc.spinors();
    let (circle, g) = (arc.circle_coefficients(), arc.coefficients());
    PhArc::new(
        w0.perp(),
        w1.perp(),
        std::array::from_fn(|k| width * circle[k] - g[k]),
    )
}
