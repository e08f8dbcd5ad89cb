//! Closed geodesics of a torus of revolution, by Clairaut's theorem.

use std::f64::consts::{PI, TAU};

use crate::Error;

/// A closed geodesic of a torus.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClosedTorusGeodesic {
    /// Clairaut's constant `ρ cos ψ`: the distance from the axis times the cosine of the angle to the parallel.
    pub clairaut: f64,
    /// The length of the whole curve.
    pub length: f64,
}

/// Points of the trapezoid rule, which converges geometrically for these periodic integrands.
const MOST_POINTS: usize = 1 << 20;

/// The geodesic of a torus with radii `major > minor > 0` that winds `p` times about the axis and `q >= 1` times around the
/// tube before it closes.
///
/// It turns about the axis by `2 ∫ c r / (ρ √(ρ² - c²))` a turn around the tube, which grows with Clairaut's constant `c`
/// from 0 to infinity, so that there is exactly one.
///
/// # Errors
///
/// [`Error::OutsideDomain`] with the radii unless `major > minor > 0`, or with `(p, q)` for `q = 0` (the equators);
/// [`Error::ThinTorus`] where Clairaut's constant cannot be told from the inner radius.
pub fn closed_torus_geodesic(
    major: f64,
    minor: f64,
    p: u32,
    q: u32,
) -> Result<ClosedTorusGeodesic, Error> {
    if !(minor > 0.0 && major > minor && major.is_finite()) {
        return Err(Error::OutsideDomain { u: major, v: minor });
    }
    if q == 0 {
        return Err(Error::OutsideDomain {
            u: f64::from(p),
            v: 0.0,
        });
    }
    let turns = f64::from(q);
    // In units of the larger radius, so that no product leaves the range of numbers.
    let tube = minor / major;
    let turning = |c: f64| {
        around(|t| {
            let distance = 1.0 + tube * t.cos();
            c * tube / (distance * ((distance - c) * (distance + c)).sqrt())
        })
    };
    let length = |c: f64| {
        around(|t| {
            let distance = 1.0 + tube * t.cos();
            tube * distance / ((distance - c) * (distance + c)).sqrt()
        })
    };
    let wanted = TAU * f64::from(p) / turns;
    let most = (1.0 - tube) * (1.0 - 1e-13);
    let (mut low, mut high) = (0.0, most);
    // On a thin tube the constant comes closer to the inner radius than numbers can tell.
    let too_thin = Error::ThinTorus {
        major,
        minor,
        turns: [p, q],
    };
    // The integrand is largest on the inside; where even that does not suffice, no quadrature is needed.
    let inner = 1.0 - tube;
    let largest = most * tube / (inner * ((inner - most) * (inner + most)).sqrt());
    if TAU * largest < wanted {
        return Err(too_thin);
    }
    while p > 0 && high - low > 2.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if turning(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
        if middle <= low.min(high) && middle >= low.max(high) {
            break;
        }
    }
    if p > 0 && high == most {
        return Err(too_thin);
    }
    let clairaut = if p == 0 { 0.0 } else { 0.5 * (low + high) };
    Ok(ClosedTorusGeodesic {
        clairaut: clairaut * major,
        length: turns * length(clairaut) * major,
    })
}

/// The integral of a smooth even function of period 2π over a full turn: trapezoids, doubled until two sums agree.
fn around(f: impl Fn(f64) -> f64) -> f64 {
    // Over half a turn, by symmetry.
    let sum = |points: usize| {
        let inner: f64 = (1..points).map(|i| f(PI * i as f64 / points as f64)).sum();
        TAU / points as f64 * (0.5 * (f(0.0) + f(PI)) + inner)
    };
    let (mut points, mut value) = (16, sum(16));
    while points < MOST_POINTS {
        points *= 2;
        let next = sum(points);
        if (next - value).abs() <= 1e-15 * next.abs() {
            return next;
        }
        value = next;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_lengths_are_met() {
        let closed = |p, q| closed_torus_geodesic(2.0, 0.7, p, q).unwrap();
        assert!((closed(0, 1).length - TAU * 0.7).abs() < 1e-13);
        assert!((closed(1, 1).length - 11.032_491_953_662_182).abs() < 1e-9);
        assert!((closed(3, 2).length - 30.231_843_27).abs() < 1e-7);
        assert!(closed_torus_geodesic(1.0, 1.0, 1, 1).is_err());
        assert!(closed_torus_geodesic(2.0, 0.7, 1, 0).is_err());
    }
}
