//! Geodesics of smooth surfaces from a point in a direction, by their differential equation.

use glam::{DMat2, DVec2};

use super::convergence::check_tolerance;
use super::smooth::{SmoothSurface, SurfaceJet};
use crate::Error;

/// A point of a geodesic: parameters and their derivative with respect to the arc length.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceRay {
    /// The parameters.
    pub uv: DVec2,
    /// Their derivative; of unit speed on the surface.
    pub direction: DVec2,
}

/// Steps that the integration may take.
const MOST_STEPS: usize = 1_000_000;

/// Follows the geodesic from `start` for an arc length (its direction is scaled to unit speed; a negative length goes back),
/// by Dormand and Prince's method of order 5 with the given error a step, relative to the parameters' size.
///
/// ```
/// use geodesic::{SurfaceRay, TorusSurface, glam::DVec2, trace_smooth};
/// let torus = TorusSurface { major: 2.0, minor: 0.7 };
/// let start = SurfaceRay { uv: DVec2::new(0.3, 0.2), direction: DVec2::new(1.0, 0.8) };
/// let end = trace_smooth(&torus, start, 4.0, 1e-12)?;
/// let constant = torus.clairaut(start.uv, start.direction);
/// assert!((torus.clairaut(end.uv, end.direction) - constant).abs() < 1e-9);
/// # Ok::<(), geodesic::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::NoTangentPlane`] for a direction that vanishes on the surface, and where the surface has no tangent plane or
/// is not finite; [`Error::InvalidLength`] for a length that is not finite; [`Error::InvalidTolerance`];
/// [`Error::NotConverged`] after a million steps.
pub fn trace_smooth(
    surface: &impl SmoothSurface,
    start: SurfaceRay,
    length: f64,
    tolerance: f64,
) -> Result<SurfaceRay, Error> {
    Ok(flow(surface, start, length, tolerance)?.ray)
}

/// Points of the geodesic of [`trace_smooth`], `steps` of them after the start, at equal distances along it.
///
/// # Errors
///
/// As for [`trace_smooth`].
pub fn trace_smooth_points(
    surface: &impl SmoothSurface,
    start: SurfaceRay,
    length: f64,
    steps: usize,
    tolerance: f64,
) -> Result<Vec<SurfaceRay>, Error> {
    let mut ray = trace_smooth(surface, start, 0.0, tolerance)?;
    let mut rays = vec![ray];
    for _ in 0..steps {
        ray = trace_smooth(surface, ray, length / steps as f64, tolerance)?;
        rays.push(ray);
    }
    Ok(rays)
}

/// The end of a stretch of geodesic, and how the geodesics beside it arrive there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    pub(super) ray: SurfaceRay,
    /// Maps the offset to the left and the turn to the left at the start to those at the end, to first order: solutions
    /// of Jacobi's equation `b'' + K b = 0`. Its determinant is 1.
    pub(super) neighbours: DMat2,
}

/// Follows a geodesic and its neighbours.
pub(super) fn flow(
    surface: &impl SmoothSurface,
    start: SurfaceRay,
    length: f64,
    tolerance: f64,
) -> Result<Arrival, Error> {
    check_tolerance(tolerance)?;
    if !length.is_finite() {
        return Err(Error::InvalidLength { length });
    }
    let lost = |uv: DVec2| Error::NoTangentPlane { u: uv.x, v: uv.y };
    let direction = surface.jet(start.uv).unit(start.direction);
    if !(start.uv.is_finite() && direction.is_finite()) {
        return Err(lost(start.uv));
    }
    let backwards = length.signum();
    let mut state = State {
        uv: start.uv,
        rate: direction * backwards,
        neighbours: DMat2::IDENTITY,
    };
    let (mut travelled, mut step) = (0.0, 0.01 * length.abs());
    let total = length.abs();
    for _ in 0..MOST_STEPS {
        if travelled >= total {
            return Ok(Arrival {
                ray: SurfaceRay {
                    uv: state.uv,
                    direction: state.rate * backwards,
                },
                neighbours: state.neighbours,
            });
        }
        step = f64::min(step, total - travelled);
        let (next, error) = dormand_prince(surface, state, step);
        if error <= tolerance {
            state = next;
            travelled = if step >= total - travelled {
                total
            } else {
                travelled + step
            };
        } else if !(error.is_finite() || step > 1e-12 * total) {
            return Err(lost(state.uv));
        }
        let growth = 0.9 * (tolerance / error.max(f64::MIN_POSITIVE)).powf(0.2);
        // A step into what is not finite is tried again much shorter.
        step *= if error.is_finite() {
            growth.clamp(0.2, 4.0)
        } else {
            0.1
        };
    }
    Err(Error::NotConverged {
        updates: MOST_STEPS,
    })
}

#[derive(Clone, Copy)]
struct State {
    uv: DVec2,
    rate: DVec2,
    /// Columns: the Jacobi fields, each with its derivative, that begin as (1, 0) and (0, 1).
    neighbours: DMat2,
}

impl State {
    fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            uv: self.uv + factor * other.uv,
            rate: self.rate + factor * other.rate,
            neighbours: self.neighbours + factor * other.neighbours,
        }
    }
}

/// The geodesic equation, by which the second derivative of the curve has no tangential part, and Jacobi's.
fn slope(surface: &impl SmoothSurface, state: State) -> State {
    let jet: SurfaceJet = surface.jet(state.uv);
    let curvature = jet.gaussian_curvature();
    let field = |column: DVec2| DVec2::new(column.y, -curvature * column.x);
    State {
        uv: state.rate,
        rate: -jet.connection(state.rate, state.rate),
        neighbours: DMat2::from_cols(
            field(state.neighbours.x_axis),
            field(state.neighbours.y_axis),
        ),
    }
}

/// One step of Dormand and Prince, and its error estimate.
fn dormand_prince(surface: &impl SmoothSurface, state: State, step: f64) -> (State, f64) {
    const A: [&[f64]; 6] = [
        &[1.0 / 5.0],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
        ],
        &[
            35.0 / 384.0,
            0.0,
            500.0 / 1113.0,
            125.0 / 192.0,
            -2187.0 / 6784.0,
            11.0 / 84.0,
        ],
    ];
    const E: [f64; 7] = [
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ];
    let mut slopes = [slope(surface, state); 7];
    let mut at = state;
    for (stage, weights) in A.iter().enumerate() {
        at = weights
            .iter()
            .zip(&slopes)
            .fold(state, |sum, (weight, slope)| {
                sum.plus(*slope, step * weight)
            });
        slopes[stage + 1] = slope(surface, at);
    }
    let zero = State {
        uv: DVec2::ZERO,
        rate: DVec2::ZERO,
        neighbours: DMat2::ZERO,
    };
    let error = E
        .iter()
        .zip(&slopes)
        .fold(zero, |sum, (weight, slope)| sum.plus(*slope, step * weight));
    let size = 1.0 + at.uv.length().max(at.rate.length());
    (at, error.uv.length().max(error.rate.length()) / size)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TorusSurface;
    use std::f64::consts::PI;

    #[test]
    fn a_meridian_of_a_torus_closes_and_clairaut_is_kept() {
        let torus = TorusSurface {
            major: 2.0,
            minor: 0.7,
        };
        let start = SurfaceRay {
            uv: DVec2::new(0.3, 0.2),
            direction: DVec2::Y,
        };
        let end = trace_smooth(&torus, start, 2.0 * PI * 0.7, 1e-13).unwrap();
        assert!((end.uv - start.uv - DVec2::new(0.0, 2.0 * PI)).length() < 1e-10);
        let start = SurfaceRay {
            uv: DVec2::new(0.2, 0.4),
            direction: DVec2::new(1.0, 0.8),
        };
        let end = trace_smooth(&torus, start, 4.0, 1e-13).unwrap();
        let before = torus.clairaut(start.uv, start.direction);
        assert!((torus.clairaut(end.uv, end.direction) - before).abs() < 1e-10);
        let back = trace_smooth(&torus, end, -4.0, 1e-13).unwrap();
        assert!((back.uv - start.uv).length() < 1e-9);
    }

    #[test]
    fn hostile_starts_are_refused() {
        let torus = TorusSurface {
            major: 2.0,
            minor: 0.7,
        };
        let still = SurfaceRay {
            uv: DVec2::ZERO,
            direction: DVec2::ZERO,
        };
        assert!(trace_smooth(&torus, still, 1.0, 1e-10).is_err());
        let lost = SurfaceRay {
            uv: DVec2::NAN,
            direction: DVec2::X,
        };
        assert!(trace_smooth(&torus, lost, 1.0, 1e-10).is_err());
        assert!(
            trace_smooth(
                &torus,
                SurfaceRay {
                    uv: DVec2::ZERO,
                    direction: DVec2::X
                },
                f64::NAN,
                1e-10
            )
            .is_err()
        );
    }
}
