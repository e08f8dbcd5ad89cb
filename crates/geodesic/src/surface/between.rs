//! The geodesic between two points of a smooth surface, by multiple shooting from a path that is nearly one.
//!
//! The path is cut into stretches. Each is replaced by the geodesic from its beginning in its direction, which misses the
//! beginning of the next stretch by a little, along it, across it and in direction. What is missed along is a matter of
//! length. The rest is mended by moving the nodes across by `b` and turning them: to first order the geodesics beside a
//! stretch arrive as Jacobi's equation says, so that eliminating the turns leaves a tridiagonal system for `b`. Its matrix
//! is the second variation of the length, on broken geodesics; the number of its negative pivots is the index of the
//! geodesic, that is the number of conjugate points on it (M. P. do Carmo, *Riemannian Geometry*, 1992, Chapter 11).

use glam::{DMat2, DVec2, DVec3};

use super::convergence::check_tolerance;
use super::smooth::SmoothSurface;
use super::trace::{Arrival, SurfaceRay, flow, trace_smooth_points};
use crate::Error;

/// Stretches tried, in turn: more make the iteration safer and slower.
const STRETCHES: [usize; 3] = [12, 48, 192];

/// Rounds of Newton's method; from the path of a fine polyhedron it takes five or six.
const MOST_ROUNDS: usize = 60;

/// Error allowed to each step of the integration in the end.
const STEP_ERROR: f64 = 1e-13;

/// Error allowed to each step while the residual is above the other number: where nodes are far from where they belong, exact
/// stretches between them, of ten times as many steps, are a waste.
const FIRST_STEP_ERROR: f64 = 1e-8;
const FAR_OFF: f64 = 1e-3;

/// A node is not turned, nor moved across by more than this part of a stretch, in one round.
const TRUST: f64 = 0.4;

/// Residual below which a round that brings no improvement has come to the rounding of the integration.
const FLOOR: f64 = 1e-9;

/// Points looked at on each stretch to see whether it leaves the domain.
const LOOKS: usize = 8;

/// A geodesic between two points of a smooth surface.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SmoothGeodesic {
    /// Its length.
    pub length: f64,
    /// The ends, and nodes between them, with unit directions.
    pub nodes: Vec<SurfaceRay>,
    /// The length of each stretch from a node to the next.
    pub stretches: Vec<f64>,
    /// How far it is from one: the largest gap between the end of a stretch and the next node, as a part of the length, or
    /// the largest corner there in radians.
    pub residual: f64,
    /// Conjugate points between the ends, with multiplicity: 0 if the curve is shorter than all its neighbours.
    pub conjugate_points: usize,
    /// Whether it stays in the surface's domain. If not it is a geodesic of the extended surface, and the shortest path on the
    /// surface itself touches the boundary.
    pub inside: bool,
}

impl SmoothGeodesic {
    /// Points of the curve in space, `steps` for each stretch, both ends included.
    ///
    /// # Errors
    ///
    /// As for [`trace_smooth`](crate::trace_smooth).
    pub fn positions(
        &self,
        surface: &impl SmoothSurface,
        steps: usize,
    ) -> Result<Vec<DVec3>, Error> {
        let rays = self.rays(surface, steps)?;
        Ok(rays.iter().map(|ray| surface.jet(ray.uv).point).collect())
    }

    /// The same points as parameters and directions.
    ///
    /// # Errors
    ///
    /// As for [`trace_smooth`](crate::trace_smooth).
    pub fn rays(
        &self,
        surface: &impl SmoothSurface,
        steps: usize,
    ) -> Result<Vec<SurfaceRay>, Error> {
        let mut rays = Vec::new();
        for (node, &length) in self.nodes.iter().zip(&self.stretches) {
            rays.extend(trace_smooth_points(
                surface, *node, length, steps, STEP_ERROR,
            )?);
            rays.pop();
        }
        rays.extend(self.nodes.last());
        Ok(rays)
    }
}

/// The geodesic near a path between two points of a smooth surface.
///
/// `way` is the path in the parameter plane, from one end to the other: two points suffice where the surface is nearly flat
/// in its parameters; in general take the [`parameters`](crate::LevelPath::parameters) of a path on a polyhedron, which
/// also chooses among several geodesics. The residual of the answer is at most `tolerance`, unless the rounding of the
/// integration, about 1e-12, forbids.
///
/// ```
/// use geodesic::{TorusSurface, geodesic_between, glam::DVec2};
/// let torus = TorusSurface { major: 2.0, minor: 0.7 };
/// let way = [DVec2::new(0.1, 0.3), DVec2::new(0.9, 1.4)];
/// let geodesic = geodesic_between(&torus, &way, 1e-11)?;
/// assert!(geodesic.residual <= 1e-11 && geodesic.conjugate_points == 0);
/// let constant = |k: usize| torus.clairaut(geodesic.nodes[k].uv, geodesic.nodes[k].direction);
/// assert!((constant(0) - constant(7)).abs() < 1e-10);
/// # Ok::<(), geodesic::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::NotConverged`] if no geodesic is found, or if the second end is conjugate to the first;
/// [`Error::NoTangentPlane`] where the surface has none; [`Error::InvalidTolerance`]; [`Error::SamePoint`] for a way without length.
pub fn geodesic_between(
    surface: &impl SmoothSurface,
    way: &[DVec2],
    tolerance: f64,
) -> Result<SmoothGeodesic, Error> {
    check_tolerance(tolerance)?;
    let mut answer = Err(Error::NotConverged { updates: 0 });
    for count in STRETCHES {
        answer = Shooting::begin(surface, way, count)
            .and_then(|shooting| shooting.solve(surface, tolerance));
        if answer.is_ok() {
            break;
        }
    }
    answer
}

/// Nodes and stretches on the way to a geodesic.
#[derive(Clone)]
struct Shooting {
    nodes: Vec<SurfaceRay>,
    stretches: Vec<f64>,
}

/// How a stretch misses the node at its end.
struct Miss {
    along: f64,
    /// From the stretch to the node, to the left.
    across: f64,
    /// From the direction of the stretch to that of the node, to the left.
    turn: f64,
    neighbours: DMat2,
}

/// What mends the misses, to first order.
struct Correction {
    across: Vec<f64>,
    turns: Vec<f64>,
    negative_pivots: usize,
}

impl Shooting {
    /// Nodes at equal distances along a way.
    fn begin(surface: &impl SmoothSurface, way: &[DVec2], count: usize) -> Result<Self, Error> {
        let at = |uv: DVec2| surface.jet(uv).point;
        // Long segments of the way are curves in space: each is measured by a few chords.
        let mut fine: Vec<DVec2> = way.first().copied().into_iter().collect();
        for ends in way.windows(2) {
            fine.extend((1..=LOOKS).map(|k| ends[0].lerp(ends[1], k as f64 / LOOKS as f64)));
        }
        let mut travelled = vec![0.0];
        for ends in fine.windows(2) {
            travelled.push(travelled[travelled.len() - 1] + at(ends[0]).distance(at(ends[1])));
        }
        let length = travelled[travelled.len() - 1];
        if let Some(lost) = fine.iter().find(|uv| !at(**uv).is_finite()) {
            return Err(Error::NoTangentPlane {
                u: lost.x,
                v: lost.y,
            });
        }
        if length <= 0.0 {
            return Err(Error::SamePoint);
        }
        let place = |distance: f64| {
            let k = travelled
                .partition_point(|&t| t < distance)
                .clamp(1, fine.len() - 1);
            let step = travelled[k] - travelled[k - 1];
            let part = if step > 0.0 {
                (distance - travelled[k - 1]) / step
            } else {
                0.0
            };
            fine[k - 1].lerp(fine[k], part.clamp(0.0, 1.0))
        };
        let mut points: Vec<DVec2> = (0..=count)
            .map(|k| place(length * k as f64 / count as f64))
            .collect();
        points[0] = fine[0];
        points[count] = fine[fine.len() - 1];
        let nodes = (0..=count).map(|k| {
            let (before, after) = (points[k.saturating_sub(1)], points[(k + 1).min(count)]);
            SurfaceRay {
                uv: points[k],
                direction: surface.jet(points[k]).unit(after - before),
            }
        });
        Ok(Self {
            nodes: nodes.collect(),
            stretches: points
                .windows(2)
                .map(|ends| at(ends[0]).distance(at(ends[1])))
                .collect(),
        })
    }

    /// Newton's method.
    fn solve(
        mut self,
        surface: &impl SmoothSurface,
        tolerance: f64,
    ) -> Result<SmoothGeodesic, Error> {
        let (mut last, mut was_fine) = (f64::INFINITY, false);
        for _ in 0..MOST_ROUNDS {
            let fine = last <= FAR_OFF;
            let step_error = if fine { STEP_ERROR } else { FIRST_STEP_ERROR };
            let misses = self.misses(surface, step_error)?;
            let residual = self.residual(&misses);
            let correction = correct(&misses).ok_or(Error::NotConverged { updates: 0 })?;
            let stuck = was_fine && residual < FLOOR && residual > 0.5 * last;
            if fine && (residual <= tolerance || stuck) {
                return self.finish(surface, residual, correction.negative_pivots);
            }
            was_fine = fine;
            last = residual;
            self.apply(surface, &misses, &correction);
        }
        Err(Error::NotConverged {
            updates: MOST_ROUNDS,
        })
    }

    fn misses(&self, surface: &impl SmoothSurface, step_error: f64) -> Result<Vec<Miss>, Error> {
        let stretches = self.nodes.windows(2).zip(&self.stretches);
        stretches
            .map(|(ends, &length)| {
                let Arrival { ray, neighbours } = flow(surface, ends[0], length, step_error)?;
                let jet = surface.jet(ray.uv);
                let gap = ends[1].uv - ray.uv;
                let left = jet.left_of(ray.direction);
                let [tangent, left] = [ray.direction, left].map(|d| jet.tangent(d));
                let missing = jet.tangent(gap);
                // The direction of arrival carried over to the node without turning.
                let there = surface.jet(ends[1].uv);
                let arriving = there.unit(ray.direction - jet.connection(gap, ray.direction));
                let [ahead, aside] = [arriving, there.left_of(arriving)].map(|d| there.tangent(d));
                let leaving = there.tangent(ends[1].direction);
                Ok(Miss {
                    along: missing.dot(tangent),
                    across: missing.dot(left),
                    turn: leaving.dot(aside).atan2(leaving.dot(ahead)),
                    neighbours,
                })
            })
            .collect()
    }

    fn residual(&self, misses: &[Miss]) -> f64 {
        let length: f64 = self.stretches.iter().sum();
        // The direction of the last node is free.
        let corners = misses.iter().rev().skip(1).map(|miss| miss.turn.abs());
        let gaps = misses
            .iter()
            .map(|miss| miss.along.hypot(miss.across) / length);
        corners.chain(gaps).fold(0.0, f64::max)
    }

    /// Moves and turns the nodes, by a part of the correction where it is too large for first order.
    fn apply(&mut self, surface: &impl SmoothSurface, misses: &[Miss], correction: &Correction) {
        let shortest = self.stretches.iter().copied().fold(f64::INFINITY, f64::min);
        let moves = correction.across.iter().map(|b| b.abs() / shortest);
        let stretching = misses
            .iter()
            .zip(&self.stretches)
            .map(|(miss, l)| miss.along.abs() / l);
        let turns = correction.turns.iter().map(|c| c.abs());
        let largest = moves.chain(stretching).chain(turns).fold(0.0, f64::max);
        let part = (TRUST / largest).min(1.0);
        for (k, node) in self.nodes.iter_mut().enumerate() {
            let jet = surface.jet(node.uv);
            let left = jet.left_of(node.direction);
            let step = part * correction.across[k] * left;
            let (sine, cosine) = (part * correction.turns[k]).sin_cos();
            let turned = cosine * node.direction + sine * left;
            let direction = turned - jet.connection(step, turned);
            node.uv += step;
            node.direction = surface.jet(node.uv).unit(direction);
        }
        for (stretch, miss) in self.stretches.iter_mut().zip(misses) {
            *stretch += part * miss.along;
        }
    }

    fn finish(
        self,
        surface: &impl SmoothSurface,
        residual: f64,
        conjugate_points: usize,
    ) -> Result<SmoothGeodesic, Error> {
        let mut geodesic = SmoothGeodesic {
            length: self.stretches.iter().sum(),
            nodes: self.nodes,
            stretches: self.stretches,
            residual,
            conjugate_points,
            inside: true,
        };
        let rays = geodesic.rays(surface, LOOKS)?;
        // The ends are the caller's.
        let between = &rays[1..rays.len() - 1];
        geodesic.inside = between.iter().all(|ray| surface.contains(ray.uv));
        Ok(geodesic)
    }
}

/// Offsets and turns of the nodes, from the condition that stretches meet: at node `k + 1`
///
/// `across + b(k+1) = Y b(k) + y c(k)` and `turn + c(k+1) = Y' b(k) + y' c(k)`, where `Y, y` are the Jacobi fields. With
/// `c(k)` from the first and `Y y' - Y' y = 1`, the second is a symmetric tridiagonal system for the `b`, of which the first
/// and last vanish. `None` where a stretch is so long that `y` is not positive, or the system is singular.
fn correct(misses: &[Miss]) -> Option<Correction> {
    let count = misses.len();
    let fields = |k: usize| {
        let DMat2 {
            x_axis: from_offset,
            y_axis: from_turn,
        } = misses[k].neighbours;
        (from_offset.x, from_turn.x, from_turn.y)
    };
    let before_conjugate = (0..count).all(|k| fields(k).1 > 0.0);
    if !before_conjugate {
        return None;
    }
    // Elimination downwards, without exchanges: the pivots tell the index.
    let (mut pivots, mut sums): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut negative_pivots = 0;
    for j in 1..count {
        let (offset, turn, _) = fields(j);
        let (_, turn_before, slope_before) = fields(j - 1);
        let mut pivot = slope_before / turn_before + offset / turn;
        let mut sum = misses[j - 1].turn - slope_before / turn_before * misses[j - 1].across
            + misses[j].across / turn;
        if let (Some(above), Some(carried)) = (pivots.last(), sums.last()) {
            let factor = 1.0 / (turn_before * above);
            pivot -= factor / turn_before;
            sum += factor * carried;
        }
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        negative_pivots += usize::from(pivot < 0.0);
        pivots.push(pivot);
        sums.push(sum);
    }
    let mut across = vec![0.0; count + 1];
    for j in (1..count).rev() {
        across[j] = (sums[j - 1] + across[j + 1] / fields(j).1) / pivots[j - 1];
    }
    let mut turns: Vec<f64> = (0..count)
        .map(|k| {
            let (offset, turn, _) = fields(k);
            (across[k + 1] + misses[k].across - offset * across[k]) / turn
        })
        .collect();
    let (_, turn, slope) = fields(count - 1);
    let last = &misses[count - 1];
    turns.push(slope / turn * last.across - across[count - 1] / turn - last.turn);
    turns.iter().all(|c| c.is_finite()).then_some(Correction {
        across,
        turns,
        negative_pivots,
    })
}

#[cfg(test)]
mod tests;
