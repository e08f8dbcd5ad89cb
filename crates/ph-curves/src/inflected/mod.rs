//! PH arcs about an inflection: the normal stands still there, and the curvature runs through zero.

mod polynomials;

use bezier_mass::bernstein;
use glam::DVec2;

use crate::Error;
use crate::complex::square;
use crate::quadrature::integrate;

/// A rational PH arc of class 9 about an inflection: the arc `w = (1 - τ) w0 + τ w1` of [`PhArc`](crate::PhArc) run through by
/// `t = ±√τ`, about the inflection as origin.
///
/// At an inflection the normal turns by `ψ ~ s²` and the support is `p ~ s³`, which is no polynomial in the normal's
/// parameter `τ ~ s²`: arcs of the plain form have no inflection. In `t` both are polynomials, `p = g/|w|²` with
/// `g = t³ r(t)`; that `g` has no linear and no quadratic term puts the point of `t = 0` into the origin and makes it regular.
///
/// | quantity | formula, with `q = abs(w)^2`, `kappa = det(w0, w1)`, dots for derivatives by `τ` |
/// |---|---|
/// | point | `i (ġ w - 2 g ẇ) / (2 kappa conj(w))`, with `ġ = t (3 r + t r') / 2` |
/// | radius of curvature | `(q g̈ - q̇ ġ + q̈ g) / (4 kappa^2)`, `1/t` times a polynomial of degree 10 |
/// | offset by d | `g + d q` |
///
/// The piece is the part of this arc over a range of `t`, which may begin or end in the inflection, contain it, or stop short of
/// it. It is run through in either sense.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "StoredArc", into = "StoredArc"))]
pub struct InflectedArc {
    origin: DVec2,
    w0: DVec2,
    w1: DVec2,
    /// The arc's own parameter `t` at the start and at the end of the piece.
    range: [f64; 2],
    /// Bernstein coefficients of r over the range.
    r: [f64; 7],
    distance: f64,
}

impl InflectedArc {
    /// The piece over `range`, in `[-1, 1]`, of the arc with these spinors about the inflection at `origin`; `r` are the Bernstein
    /// coefficients over this range of the polynomial in the support `t³ r(t)`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if a spinor is zero; [`Error::NoTurning`] if they are parallel;
    /// [`Error::TurningTooLarge`] if the angle between them is a right angle or more; [`Error::OutsideDomain`] for an empty range
    /// or one outside of `[-1, 1]`.
    pub fn new(
        origin: DVec2,
        [w0, w1]: [DVec2; 2],
        range: [f64; 2],
        r: [f64; 7],
    ) -> Result<Self, Error> {
        // The checks are those of a plain arc with these spinors.
        crate::PhArc::new(w0, w1, r)?;
        if !origin.is_finite() {
            return Err(Error::NonFinite {
                what: "an inflection",
            });
        }
        let [from, to] = range;
        for value in range {
            if !(-1.0..=1.0).contains(&value) || from == to {
                return Err(Error::OutsideDomain {
                    value,
                    start: -1.0,
                    end: 1.0,
                });
            }
        }
        Ok(Self::from_parts(origin, [w0, w1], range, r))
    }

    /// The arc without the checks, for values known to satisfy them.
    pub(crate) const fn from_parts(
        origin: DVec2,
        [w0, w1]: [DVec2; 2],
        range: [f64; 2],
        r: [f64; 7],
    ) -> Self {
        Self {
            origin,
            w0,
            w1,
            range,
            r,
            distance: 0.0,
        }
    }

    /// The parameter inside `(0, 1)` of the inflection, if the piece runs through it.
    #[must_use]
    pub fn inflection(&self) -> Option<f64> {
        let [from, to] = self.range;
        (from * to < 0.0).then(|| from / (from - to))
    }

    /// The arc's own parameter, 0 at the inflection.
    fn own(&self, t: f64) -> f64 {
        let [from, to] = self.range;
        if t == 1.0 { to } else { from + (to - from) * t }
    }

    /// Signed length of the range.
    fn span(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// `r` and its first two derivatives by the own parameter, at a parameter of the piece.
    fn factor_jet(&self, t: f64) -> [f64; 3] {
        let [r, slope, bend] = bernstein::jet(&self.r, t);
        let span = self.span();
        [r, slope / span, bend / (span * span)]
    }

    fn kappa(&self) -> f64 {
        self.w0.perp_dot(self.w1)
    }

    fn spinor(&self, own: f64) -> DVec2 {
        self.w0 + (self.w1 - self.w0) * (own * own)
    }

    /// The parameter at which the normal is `normal` and the curvature has the sign of `curvature`, also outside of `[0, 1]`: every
    /// normal occurs on both sides of the inflection.
    pub(crate) fn parameter_like(&self, normal: DVec2, curvature: f64) -> f64 {
        let plain = crate::PhArc::from_parts(self.w0, self.w1, self.r);
        let own = plain.parameter_beyond(normal).max(0.0).sqrt();
        let [from, to] = self.range;
        let through = from * to < 0.0;
        // The radius at t = 1/2 of the range, or that times a negative parameter.
        let positive = if through {
            self.radius_times_parameter(0.5) * curvature >= 0.0
        } else {
            from + to > 0.0
        };
        let own = if positive { own } else { -own };
        (own - from) / (to - from)
    }

    /// Unit normal at `t`.
    #[must_use]
    pub fn normal(&self, t: f64) -> DVec2 {
        let w = self.spinor(self.own(t));
        square(w) / w.length_squared()
    }

    /// The point at `t` in `[0, 1]`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        let [r, slope, _] = self.factor_jet(t);
        let t = self.own(t);
        let w = self.spinor(t);
        let (g, dg) = (t * t * t * r, 0.5 * t * (3.0 * r + t * slope));
        let numerator = dg * w - 2.0 * g * (self.w1 - self.w0);
        let length = w.length_squared();
        let local = w.rotate(numerator).perp() / (2.0 * self.kappa() * length);
        self.origin + local + square(w) * (self.distance / length)
    }

    /// `t` times the radius of curvature, at a parameter of the piece.
    fn radius_times_parameter(&self, t: f64) -> f64 {
        let [r, slope, bend] = self.factor_jet(t);
        let own = self.own(t);
        let (w, dw) = (self.spinor(own), self.w1 - self.w0);
        let square = own * own;
        // t g, t ġ and t g̈.
        let g = square * square * r;
        let dg = 0.5 * square * (3.0 * r + own * slope);
        let ddg = 0.25 * (3.0 * r + own * (5.0 * slope + own * bend));
        let (q, dq, ddq) = (
            w.length_squared(),
            2.0 * w.dot(dw),
            2.0 * dw.length_squared(),
        );
        let kappa = self.kappa();
        (q * ddg - dq * dg + ddq * g) / (4.0 * kappa * kappa) + self.distance * own
    }

    /// The numerator `g = t³ r` of the support about the inflection, at an own parameter.
    pub(crate) fn support_numerator(&self, own: f64) -> f64 {
        let t = (own - self.range[0]) / self.span();
        own * own * own * bernstein::evaluate(&self.r, t)
    }

    /// Signed radius of curvature, infinite at the inflection.
    #[must_use]
    pub fn radius(&self, t: f64) -> f64 {
        self.radius_times_parameter(t) / self.own(t)
    }

    /// Derivative of the point by `t`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        let own = self.own(t);
        let w = self.spinor(own);
        let length = w.length_squared();
        // R dψ/dτ dτ/dt with dψ/dτ = 2 kappa / q.
        let speed = self.radius_times_parameter(t) * 4.0 * self.kappa() / length;
        square(w).perp() * (speed * self.span() / length)
    }

    /// Signed turning angle of the normal in the sense of travel.
    #[must_use]
    pub fn turning(&self) -> f64 {
        let [a, b] = self.range.map(|own| self.spinor(own));
        2.0 * a.perp_dot(b).atan2(a.dot(b))
    }

    /// The parallel arc at signed distance `distance` along the normal; exact. Its start is the inflection's.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        let mut moved = *self;
        moved.shift(distance);
        moved
    }

    /// Moves the arc along its normals.
    #[inline]
    pub(crate) fn shift(&mut self, distance: f64) {
        self.distance += distance;
    }

    /// The part between two parameters `0 <= from < to <= 1`.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] otherwise.
    pub fn part(&self, from: f64, to: f64) -> Result<Self, Error> {
        if !(from >= 0.0 && from < to && to <= 1.0) {
            return Err(Error::OutsideDomain {
                value: from,
                start: 0.0,
                end: to.min(1.0),
            });
        }
        let mut part = Self {
            range: [self.own(from), self.own(to)],
            ..*self
        };
        part.r
            .copy_from_slice(&bernstein::restrict(&self.r, from, to));
        Ok(part)
    }

    /// The same arc run backwards; the normals keep their directions.
    #[must_use]
    pub fn reverse(&self) -> Self {
        let (mut range, mut r) = (self.range, self.r);
        range.reverse();
        r.reverse();
        Self { range, r, ..*self }
    }

    /// The same points with opposite normals: supports and radii change sign.
    #[must_use]
    pub fn flip(&self) -> Self {
        Self {
            w0: self.w0.perp(),
            w1: self.w1.perp(),
            r: self.r.map(|c| -c),
            distance: -self.distance,
            ..*self
        }
    }

    /// Arc length; parts on both sides of a cusp count positively. By Gauss's rule, to rounding.
    #[must_use]
    pub fn length(&self) -> f64 {
        let rate = |t: f64| {
            4.0 * self.kappa() * self.span() * self.radius_times_parameter(t)
                / self.spinor(self.own(t)).length_squared()
        };
        let mut begin = 0.0;
        self.cusps()
            .into_iter()
            .chain([1.0])
            .map(|end| {
                let part = integrate(begin, end, GAUSS_PIECES, rate).abs();
                begin = end;
                part
            })
            .sum()
    }
}

/// The form in which an arc is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredArc {
    origin: DVec2,
    spinors: [DVec2; 2],
    r: [f64; 7],
    distance: f64,
    range: [f64; 2],
}

#[cfg(feature = "serde")]
impl From<InflectedArc> for StoredArc {
    fn from(arc: InflectedArc) -> Self {
        Self {
            origin: arc.origin,
            spinors: [arc.w0, arc.w1],
            r: arc.r,
            distance: arc.distance,
            range: arc.range,
        }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredArc> for InflectedArc {
    type Error = Error;

    fn try_from(stored: StoredArc) -> Result<Self, Error> {
        if !stored.distance.is_finite() {
            return Err(Error::NonFinite {
                what: "an offset distance",
            });
        }
        let arc = Self::new(stored.origin, stored.spinors, stored.range, stored.r)?;
        Ok(arc.offset(stored.distance))
    }
}

/// Parts of Gauss's rule for the length: the poles of the integrand are at least 0.3 away, which makes it exact to rounding.
const GAUSS_PIECES: usize = 4;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dual::rational_curve;

    fn arcs() -> Vec<InflectedArc> {
        let spinors = |turning: f64| {
            [
                DVec2::from_angle(0.3),
                DVec2::from_angle(0.3 + 0.5 * turning),
            ]
        };
        let origin = DVec2::new(3.0, -2.0);
        let mut arcs = Vec::new();
        for turning in [0.8_f64, -0.5] {
            let r = [0.3, 0.32, 0.3, 0.35, 0.33, 0.4, 0.38].map(|c: f64| c * turning.signum());
            let arc = InflectedArc::new(origin, spinors(turning), [0.0, 1.0], r).unwrap();
            arcs.extend([
                arc,
                arc.offset(0.2),
                arc.part(0.2, 0.9).unwrap().reverse(),
                arc.flip(),
            ]);
            arcs.push(arc.reverse().offset(-0.1));
            // Through the inflection, and beside it.
            for range in [[-0.6, 1.0], [0.3, 0.8]] {
                let arc = InflectedArc::new(origin, spinors(turning), range, r).unwrap();
                arcs.extend([
                    arc.offset(0.05),
                    arc.part(0.1, 0.9).unwrap(),
                    arc.reverse().flip(),
                ]);
            }
        }
        arcs
    }

    #[test]
    fn points_move_along_tangents_with_the_speed_that_is_said() {
        for arc in arcs() {
            for t in [0.05, 0.3, 0.8] {
                let step = 1e-6;
                let chord = (arc.point(t + step) - arc.point(t - step)) / (2.0 * step);
                assert!((chord - arc.velocity(t)).length() < 1e-8, "{arc:?} {t}");
                assert!(arc.normal(t).dot(chord).abs() < 1e-8 * chord.length());
                let turn = (arc.normal(t + step) - arc.normal(t - step)) / (2.0 * step);
                // dN/dt = T dψ/dt and dC/dt = R T dψ/dt
                assert!((turn * arc.radius(t) - chord).length() < 1e-6 * chord.length());
            }
        }
    }

    #[test]
    fn the_start_is_an_inflection_and_a_regular_point() {
        for arc in arcs().into_iter().filter(|arc| arc.range[0] == 0.0) {
            assert!(arc.velocity(0.0).length() > 0.1);
            assert!(arc.radius(1e-9).abs() > 1e6);
            let inflection = arc.origin + arc.distance * arc.normal(0.0);
            assert!((arc.point(0.0) - inflection).length() < 1e-15);
        }
    }

    #[test]
    fn the_rational_form_is_the_arc() {
        for arc in arcs() {
            let curve = rational_curve(&arc.homogeneous()).unwrap();
            assert!(arc.homogeneous().iter().all(|x| x.x > 0.0));
            for t in [0.0, 0.2, 0.7, 1.0] {
                assert!((curve.point(t).unwrap() - arc.point(t)).length() < 1e-13);
            }
        }
    }

    #[test]
    fn lengths_feet_and_cusps_are_those_of_the_points() {
        for arc in arcs() {
            let count = 20_000;
            let at = |k: usize| arc.point(k as f64 / count as f64);
            let polyline: f64 = (0..count).map(|k| (at(k + 1) - at(k)).length()).sum();
            assert!((arc.length() - polyline).abs() < 1e-7 * polyline);
            let foot = arc.point(0.6);
            let beside = foot + 0.01 * arc.normal(0.6);
            assert!(
                arc.feet(beside)
                    .iter()
                    .any(|t| (arc.point(*t) - foot).length() < 1e-9)
            );
            assert!(arc.cusps().iter().all(|t| arc.radius(*t).abs() < 1e-9));
            // Beyond the centre of curvature of its end the offset has a cusp where the radius is the distance.
            let cusped = arc.offset(-arc.radius(0.7));
            assert!(cusped.cusps().iter().any(|t| (t - 0.7).abs() < 1e-9));
            let d = arc.offset(0.37);
            assert!((d.point(0.4) - arc.point(0.4) - 0.37 * arc.normal(0.4)).length() < 1e-15);
        }
    }

    #[test]
    fn impossible_arcs_are_refused() {
        let (x, y, all) = (DVec2::X, DVec2::Y, [-1.0, 1.0]);
        for range in [[0.5, 0.5], [0.0, 1.1], [f64::NAN, 1.0]] {
            assert!(InflectedArc::new(x, [x, x + y], range, [1.0; 7]).is_err());
        }
        assert!(InflectedArc::new(DVec2::NAN, [x, x + y], all, [1.0; 7]).is_err());
        assert!(InflectedArc::new(x, [x, x + y], all, [f64::NAN; 7]).is_err());
        assert!(InflectedArc::new(x, [x, x], all, [1.0; 7]).is_err());
        assert!(InflectedArc::new(x, [x, y], all, [1.0; 7]).is_err());
        let arc = InflectedArc::new(x, [x, x + y], all, [1.0; 7]).unwrap();
        assert!(arc.part(0.5, 0.5).is_err() && arc.part(f64::NAN, 1.0).is_err());
    }
}
