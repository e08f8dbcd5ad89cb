//! Geodesics of smooth surfaces by their differential equation.

use bezier_mass::BezierPatch;
use glam::{DMat2, DVec2, DVec3};

use crate::Error;

/// A point of a surface with its derivatives to second order.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfaceJet {
    /// The point.
    pub point: DVec3,
    /// First derivatives, in u and v.
    pub first: [DVec3; 2],
    /// Second derivatives: uu, uv, vv.
    pub second: [DVec3; 3],
}

/// A parametric surface that can be differentiated twice.
pub trait SmoothSurface {
    /// The jet at `(u, v)`.
    fn jet(&self, uv: DVec2) -> SurfaceJet;
}

impl<F: Fn(DVec2) -> SurfaceJet> SmoothSurface for F {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        self(uv)
    }
}

impl SmoothSurface for BezierPatch<DVec3> {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        let jet = Self::jet(self, uv.x, uv.y);
        let none = SurfaceJet {
            point: DVec3::NAN,
            first: [DVec3::NAN; 2],
            second: [DVec3::NAN; 3],
        };
        match (jet.position(), jet.partials()) {
            (Some(point), Some(partials)) => SurfaceJet {
                point,
                first: [partials.du, partials.dv],
                second: [partials.duu, partials.duv, partials.dvv],
            },
            _ => none,
        }
    }
}

/// The torus with `u` about the axis and `v` around the tube, 0 outermost.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TorusSurface {
    /// Radius of the circle of the tube's centres.
    pub major: f64,
    /// Radius of the tube.
    pub minor: f64,
}

impl TorusSurface {
    /// Clairaut's constant `ρ cos ψ` of a direction: the distance from the axis times the cosine of the angle to the
    /// parallel. It does not change along a geodesic.
    #[must_use]
    pub fn clairaut(&self, uv: DVec2, direction: DVec2) -> f64 {
        let distance = self.major + self.minor * uv.y.cos();
        let along = DVec2::new(distance * direction.x, self.minor * direction.y);
        distance * along.x / along.length()
    }
}

impl SmoothSurface for TorusSurface {
    fn jet(&self, uv: DVec2) -> SurfaceJet {
        let ((su, cu), (sv, cv)) = (uv.x.sin_cos(), uv.y.sin_cos());
        let distance = self.major + self.minor * cv;
        let (out, along) = (DVec3::new(cu, su, 0.0), DVec3::new(-su, cu, 0.0));
        let turn = self.minor * DVec3::new(-sv * cu, -sv * su, cv);
        SurfaceJet {
            point: distance * out + self.minor * sv * DVec3::Z,
            first: [distance * along, turn],
            second: [
                -distance * out,
                -self.minor * sv * along,
                -self.minor * DVec3::new(cv * cu, cv * su, sv),
            ],
        }
    }
}

/// A geodesic's state: parameters and their derivative with respect to the arc length.
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
/// # Errors
///
/// [`Error::OutsideDomain`] for a direction that vanishes on the surface, and where the surface has no
/// tangent plane or is not finite; [`Error::NotConverged`] after a million steps.
pub fn trace_smooth(
    surface: &impl SmoothSurface,
    start: SurfaceRay,
    length: f64,
    tolerance: f64,
) -> Result<SurfaceRay, Error> {
    let jet = surface.jet(start.uv);
    let speed = (start.direction.x * jet.first[0] + start.direction.y * jet.first[1]).length();
    if !(speed > 0.0 && speed.is_finite() && length.is_finite() && tolerance > 0.0) {
        return Err(Error::OutsideDomain {
            u: start.uv.x,
            v: start.uv.y,
        });
    }
    let mut state = State {
        uv: start.uv,
        rate: start.direction / speed * length.signum(),
    };
    let (mut travelled, mut step) = (0.0, 0.01 * length.abs());
    let total = length.abs();
    for _ in 0..MOST_STEPS {
        if travelled >= total {
            return Ok(SurfaceRay {
                uv: state.uv,
                direction: state.rate * length.signum(),
            });
        }
        step = f64::min(step, total - travelled);
        let (next, error) = dormand_prince(surface, state, step);
        if !(next.uv.is_finite() && next.rate.is_finite()) {
            return Err(Error::OutsideDomain {
                u: state.uv.x,
                v: state.uv.y,
            });
        }
        if error <= tolerance {
            state = next;
            travelled = if step >= total - travelled {
                total
            } else {
                travelled + step
            };
        }
        let growth = 0.9 * (tolerance / error.max(f64::MIN_POSITIVE)).powf(0.2);
        step *= growth.clamp(0.2, 4.0);
    }
    Err(Error::NotConverged {
        updates: MOST_STEPS,
    })
}

#[derive(Clone, Copy)]
struct State {
    uv: DVec2,
    rate: DVec2,
}

impl State {
    fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            uv: self.uv + factor * other.uv,
            rate: self.rate + factor * other.rate,
        }
    }
}

/// The geodesic equation: the second derivative of the curve has no tangential part.
fn slope(surface: &impl SmoothSurface, state: State) -> State {
    let jet = surface.jet(state.uv);
    let [u, v] = jet.first;
    let DVec2 { x, y } = state.rate;
    let bend = x * x * jet.second[0] + 2.0 * x * y * jet.second[1] + y * y * jet.second[2];
    let form = DMat2::from_cols(
        DVec2::new(u.dot(u), u.dot(v)),
        DVec2::new(u.dot(v), v.dot(v)),
    );
    State {
        uv: state.rate,
        rate: -(form.inverse() * DVec2::new(bend.dot(u), bend.dot(v))),
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
