//! Norms, frames, curvatures and offsets with respect to an indicatrix.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec2;

use super::{Indicatrix, Support};
use crate::{Error, quadrature};

/// The plane measured by an indicatrix `U`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MinkowskiPlane<S> {
    indicatrix: Indicatrix<S>,
}

/// The Frenet frame of a curve at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MinkowskiFrame {
    /// The tangent of `U`-length 1: a point of the indicatrix.
    pub tangent: DVec2,
    /// The vector with `det(tangent, normal) = 1` that is `U0`-normal to the tangent: a point of the isoperimetrix.
    pub normal: DVec2,
    /// The vector of `U`-length 1 along which the `U`-offset moves, to the left: the point of the indicatrix at which
    /// its own tangent is parallel to the curve's, `n_U0`.
    pub offset_direction: DVec2,
}

impl<S: Support> MinkowskiPlane<S> {
    /// The plane with this indicatrix.
    #[must_use]
    pub fn new(indicatrix: Indicatrix<S>) -> Self {
        Self { indicatrix }
    }

    /// The indicatrix.
    #[must_use]
    pub fn indicatrix(&self) -> &Indicatrix<S> {
        &self.indicatrix
    }

    /// The point of the indicatrix with outward normal angle `psi`.
    #[must_use]
    pub fn indicatrix_point(&self, psi: f64) -> DVec2 {
        self.indicatrix.contact(psi).point
    }

    /// The point `u0 = -T / p` of the isoperimetrix that belongs to the point `u` at `psi`: `det(u0, u) = 1`, and the
    /// tangent of `U0` there is parallel to `u`.
    #[must_use]
    pub fn isoperimetrix_point(&self, psi: f64) -> DVec2 {
        let contact = self.indicatrix.contact(psi);
        -contact.normal.perp() / contact.support
    }

    /// The normal angle at the point of the indicatrix in the direction of `vector`.
    ///
    /// The direction of the point grows with the normal's angle and stays within a right angle of it: bisection and
    /// Newton's method between those bounds.
    #[must_use]
    pub fn normal_angle_of(&self, vector: DVec2) -> f64 {
        let direction = vector.to_angle();
        let unit = DVec2::from_angle(direction);
        let (mut low, mut high, mut psi) =
            (direction - FRAC_PI_2, direction + FRAC_PI_2, direction);
        for _ in 0..80 {
            let contact = self.indicatrix.contact(psi);
            let ahead = unit.perp_dot(contact.point);
            if ahead > 0.0 {
                high = psi;
            } else {
                low = psi;
            }
            let newton = psi - ahead / (contact.radius * unit.perp_dot(contact.normal.perp()));
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            if (next - psi).abs() <= f64::EPSILON * PI {
                return next;
            }
            psi = next;
        }
        psi
    }

    /// The norm `||v||_U`: the factor by which the indicatrix must grow to reach `vector`.
    #[must_use]
    pub fn norm(&self, vector: DVec2) -> f64 {
        if vector == DVec2::ZERO {
            return 0.0;
        }
        // At the point u in the direction of v, v = ||v|| u and <u, N> is the support.
        let contact = self.indicatrix.contact(self.normal_angle_of(vector));
        vector.dot(contact.normal) / contact.support
    }

    /// The norm `||v||_U0` of the dual plane: the support of the indicatrix in the direction of `v` turned by `-π/2`,
    /// times the length of `v`.
    #[must_use]
    pub fn dual_norm(&self, vector: DVec2) -> f64 {
        if vector == DVec2::ZERO {
            return 0.0;
        }
        // The square of the length may overflow.
        vector.x.hypot(vector.y) * self.indicatrix.jet((-vector.perp()).to_angle()).support
    }

    /// Whether `other` is `U`-normal to `vector`: a homothetic copy of the indicatrix centred on a line along
    /// `other` can touch the line along `vector` where they meet. The answer is the sine of the angle that is missing.
    #[must_use]
    pub fn normality_defect(&self, other: DVec2, vector: DVec2) -> f64 {
        let touching = self.indicatrix_point((-vector.perp()).to_angle());
        touching
            .normalize_or_zero()
            .perp_dot(other.normalize_or_zero())
    }

    /// The frame of a curve with this derivative.
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] for a zero derivative; [`Error::NonFinite`].
    pub fn frame(&self, derivative: DVec2) -> Result<MinkowskiFrame, Error> {
        if !derivative.is_finite() {
            return Err(Error::NonFinite {
                what: "derivative of a curve",
            });
        }
        if derivative == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "derivative of a curve",
            });
        }
        let psi = self.normal_angle_of(derivative);
        Ok(MinkowskiFrame {
            tangent: self.indicatrix_point(psi),
            normal: -self.isoperimetrix_point(psi),
            offset_direction: self.indicatrix_point(derivative.perp().to_angle()),
        })
    }

    /// The `U`-length of a curve with the given derivative over `[from, to]`, by Gauss-Legendre quadrature with 16 points
    /// on each of `pieces` parts.
    pub fn arc_length(
        &self,
        from: f64,
        to: f64,
        pieces: usize,
        derivative: impl Fn(f64) -> DVec2,
    ) -> f64 {
        quadrature::integrate(from, to, pieces, |t| self.norm(derivative(t)))
    }

    /// The Minkowski curvature `κ` of `dt_U / ds = κ n_U`, `s` the `U`-length.
    ///
    /// # Errors
    ///
    /// As for [`MinkowskiPlane::frame`].
    pub fn curvature(&self, derivative: DVec2, second: DVec2) -> Result<f64, Error> {
        self.frame(derivative)?;
        let contact = self.indicatrix.contact(self.normal_angle_of(derivative));
        // The tangent point u(psi) runs with the direction of F': its own direction turns by R sin(angle(u, T)) / |u|² dpsi.
        let turning = turning(derivative, second)?;
        let rate = contact.radius * contact.point.perp_dot(contact.normal.perp())
            / contact.point.length_squared();
        Ok(contact.radius * contact.support * (turning / rate) / self.norm(derivative))
    }

    /// The circular curvature: that of the curve over that of the indicatrix at the point with the parallel tangent, so
    /// that copies of the indicatrix of size `r` have `1/r`. Positive where the curve turns left.
    ///
    /// # Errors
    ///
    /// As for [`MinkowskiPlane::frame`].
    pub fn circular_curvature(&self, derivative: DVec2, second: DVec2) -> Result<f64, Error> {
        self.frame(derivative)?;
        let curvature = turning(derivative, second)? / derivative.x.hypot(derivative.y);
        Ok(curvature
            * self
                .indicatrix
                .jet((-derivative.perp()).to_angle())
                .radius())
    }

    /// The point of the general offset at signed distance `distance` to the left: `F + d n_U0`.
    ///
    /// # Errors
    ///
    /// As for [`MinkowskiPlane::frame`].
    pub fn offset_point(
        &self,
        point: DVec2,
        derivative: DVec2,
        distance: f64,
    ) -> Result<DVec2, Error> {
        finite(
            point + distance * self.frame(derivative)?.offset_direction,
            "point or distance of an offset",
        )
    }

    /// The point of the evolute: the centre of the osculating copy of the indicatrix.
    ///
    /// # Errors
    ///
    /// As for [`MinkowskiPlane::frame`], and [`Error::ZeroDirection`] where the curvature vanishes.
    pub fn evolute_point(
        &self,
        point: DVec2,
        derivative: DVec2,
        second: DVec2,
    ) -> Result<DVec2, Error> {
        let curvature = self.circular_curvature(derivative, second)?;
        if curvature == 0.0 {
            return Err(Error::ZeroDirection {
                what: "evolute where the curvature vanishes",
            });
        }
        self.offset_point(point, derivative, 1.0 / curvature)
    }

    /// The point of the involute at distance `length` back along the tangent: `F - length t_U`. Where `length` is a constant
    /// plus the `U`-length of the curve up to here, these points make an involute, and the curve is the evolute of it.
    ///
    /// # Errors
    ///
    /// As for [`MinkowskiPlane::frame`].
    pub fn involute_point(
        &self,
        point: DVec2,
        derivative: DVec2,
        length: f64,
    ) -> Result<DVec2, Error> {
        finite(
            point - length * self.frame(derivative)?.tangent,
            "point or length of an involute",
        )
    }
}

/// The point, if it is one.
fn finite(point: DVec2, what: &'static str) -> Result<DVec2, Error> {
    if point.is_finite() {
        Ok(point)
    } else {
        Err(Error::NonFinite { what })
    }
}

/// The rate `det(F', F'') / |F'|²` at which the tangent turns, without squares that overflow.
fn turning(derivative: DVec2, second: DVec2) -> Result<f64, Error> {
    if !second.is_finite() {
        return Err(Error::NonFinite {
            what: "second derivative of a curve",
        });
    }
    let speed = derivative.x.hypot(derivative.y);
    Ok((derivative / speed).perp_dot(second / speed))
}

/// The general outward offset of a curve given by its support: supports add, `p + distance P`, so that the offset is the
/// boundary of the Minkowski sum with the indicatrix scaled by the distance.
pub(super) fn sum_of_supports(
    curve: &impl Support,
    indicatrix: &impl Support,
    distance: f64,
    psi: f64,
) -> crate::SupportJet {
    let (p, unit) = (curve.jet(psi), indicatrix.jet(psi));
    crate::SupportJet {
        support: p.support + distance * unit.support,
        slope: p.slope + distance * unit.slope,
        bend: p.bend + distance * unit.bend,
    }
}

impl<S: Support> MinkowskiPlane<S> {
    /// The support function of the general outward offset of a convex curve.
    pub fn offset_support<'a>(
        &'a self,
        curve: &'a impl Support,
        distance: f64,
    ) -> impl Support + 'a {
        move |psi: f64| sum_of_supports(curve, &self.indicatrix, distance, psi)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Bumped, Ellipse};
    use super::*;

    const ELLIPSE: Ellipse = Ellipse { a: 2.0, b: 1.0 };

    fn bumped() -> MinkowskiPlane<Bumped> {
        MinkowskiPlane::new(Indicatrix::try_new(Bumped { height: 0.05 }).unwrap())
    }

    /// A test curve with its two derivatives.
    fn curve(t: f64) -> [DVec2; 3] {
        [
            DVec2::new(t, t * t - 0.3 * t * t * t),
            DVec2::new(1.0, 2.0 * t - 0.9 * t * t),
            DVec2::new(0.0, 2.0 - 1.8 * t),
        ]
    }

    #[test]
    fn the_norms_of_an_ellipse_are_known() {
        let plane = MinkowskiPlane::new(Indicatrix::try_new(ELLIPSE).unwrap());
        let v = DVec2::new(0.7, 0.4);
        assert!((plane.norm(v) - (0.7_f64 / 2.0).hypot(0.4)).abs() < 1e-15);
        assert!((plane.dual_norm(v) - 0.7_f64.hypot(2.0 * 0.4)).abs() < 1e-15);
    }

    #[test]
    fn the_planes_are_dual_to_each_other() {
        let plane = bumped();
        for i in 0..40 {
            let psi = 0.17 * f64::from(i);
            let (u, u0) = (plane.indicatrix_point(psi), plane.isoperimetrix_point(psi));
            assert!((u0.perp_dot(u) - 1.0).abs() < 1e-14);
            assert!(
                (plane.norm(u) - 1.0).abs() < 1e-13 && (plane.dual_norm(u0) - 1.0).abs() < 1e-13
            );
            // Twice the polar reciprocal turned by -π/2 is the opposite point: d(u0) is parallel to u.
            let step = 1e-5;
            let along =
                plane.isoperimetrix_point(psi + step) - plane.isoperimetrix_point(psi - step);
            assert!(along.normalize().perp_dot(u.normalize()).abs() < 1e-8);
            // u is U-normal to the tangent at u, and the tangent U0-normal to u.
            assert!(
                plane
                    .normality_defect(u, DVec2::from_angle(psi).perp())
                    .abs()
                    < 1e-14
            );
        }
    }

    #[test]
    fn frenets_equations_hold() {
        let plane = bumped();
        for t in [-0.4, 0.1, 0.5, 0.9] {
            let [point, derivative, second] = curve(t);
            let frame = plane.frame(derivative).unwrap();
            assert!((frame.tangent.perp_dot(frame.normal) - 1.0).abs() < 1e-14);
            let step = 1e-5;
            let at = |t: f64| plane.frame(curve(t)[1]).unwrap();
            let speed = plane.norm(derivative);
            let change = (at(t + step).tangent - at(t - step).tangent) / (2.0 * step * speed);
            let curvature = plane.curvature(derivative, second).unwrap();
            assert!((change - curvature * frame.normal).length() < 1e-8);
            // d n_U0 = -circular curvature dF, and the evolute moves along n_U0.
            let circular = plane.circular_curvature(derivative, second).unwrap();
            let turned =
                (at(t + step).offset_direction - at(t - step).offset_direction) / (2.0 * step);
            assert!((turned + circular * derivative).length() < 1e-8);
            let evolute = |t: f64| {
                let [point, derivative, second] = curve(t);
                plane.evolute_point(point, derivative, second).unwrap()
            };
            let moved = evolute(t + step) - evolute(t - step);
            assert!(
                moved
                    .normalize_or_zero()
                    .perp_dot(frame.offset_direction.normalize())
                    .abs()
                    < 1e-6
            );
            assert!((evolute(t) - point).length() > 0.0);
        }
    }

    #[test]
    fn an_involute_has_the_curve_as_its_evolute() {
        let plane = bumped();
        let length = |t: f64| 0.5 + plane.arc_length(0.0, t, 4, |t| curve(t)[1]);
        let involute = |t: f64| {
            plane
                .involute_point(curve(t)[0], curve(t)[1], length(t))
                .unwrap()
        };
        // The involute moves so that its own offset direction is the tangent of the curve.
        let step = 1e-5;
        for t in [0.2, 0.5, 0.8] {
            let derivative = (involute(t + step) - involute(t - step)) / (2.0 * step);
            let frame = plane.frame(derivative).unwrap();
            let tangent = plane.frame(curve(t)[1]).unwrap().tangent;
            assert!(frame.offset_direction.perp_dot(tangent).abs() < 1e-7);
        }
    }

    #[test]
    fn hostile_derivatives_are_refused() {
        let plane = bumped();
        assert!(matches!(
            plane.frame(DVec2::ZERO),
            Err(Error::ZeroDirection { .. })
        ));
        assert!(matches!(
            plane.frame(DVec2::NAN),
            Err(Error::NonFinite { .. })
        ));
        assert_eq!(plane.norm(DVec2::ZERO), 0.0);
        assert!(plane.curvature(DVec2::X, DVec2::NAN).is_err());
        assert!(plane.circular_curvature(DVec2::X, DVec2::NAN).is_err());
        for bad in [f64::NAN, f64::INFINITY] {
            assert!(plane.offset_point(DVec2::ZERO, DVec2::X, bad).is_err());
            assert!(plane.involute_point(DVec2::ZERO, DVec2::X, bad).is_err());
        }
    }

    #[test]
    fn huge_and_tiny_vectors_have_norms_and_curvatures() {
        let plane = bumped();
        let (v, second) = (DVec2::new(0.7, 0.4), DVec2::new(-0.2, 0.5));
        let curvatures = |v: DVec2, second: DVec2| {
            let circular = plane.circular_curvature(v, second).unwrap();
            [plane.curvature(v, second).unwrap(), circular]
        };
        for size in [1e-200, 1e200] {
            let ratio = plane.dual_norm(size * v) / size / plane.dual_norm(v);
            assert!((ratio - 1.0).abs() < 1e-14);
            let (here, there) = (curvatures(v, second), curvatures(size * v, size * second));
            for (here, there) in here.iter().zip(there) {
                assert!((there * size / here - 1.0).abs() < 1e-13);
            }
        }
    }
}
