//! Homogeneous media: how fast a wave runs in each direction.

use glam::{DMat2, DVec2, DVec3};
use ph_curves::DualIndicatrix;
use ph_curves::Support;
use variation::Solver;

use crate::Error;

/// A homogeneous medium, given by its indicatrix: the front of a point source after a unit of time.
///
/// | | isotropic | elliptical | rational |
/// |---|---|---|---|
/// | indicatrix | circle of radius v | ellipse | any symmetric convex curve in dual Bézier form |
/// | rays | exact | exact | exact, the normal behind an interface by certified roots |
/// | fronts of class-3 arcs | yes | yes, in the affine image where the ellipse is the unit circle | no, see [`Medium::unit_plane`] |
///
/// A ray carries its *slowness* `s = N / P(N)`: the normal of its front over the speed `P` at which the front moves
/// in that direction, the support of the indicatrix. It travels with the *group velocity*, the point of the indicatrix
/// with the outward normal N, and `<s, V> = 1`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredMedium",
        into = "crate::stored::StoredMedium"
    )
)]
pub struct Medium {
    kind: Kind,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Isotropic {
        speed: f64,
    },
    /// The map that takes velocities to unit vectors, and its inverse.
    Elliptical {
        semi_axes: [f64; 2],
        angle: f64,
        to_unit: DMat2,
        from_unit: DMat2,
    },
    Rational(DualIndicatrix),
}

impl Medium {
    /// A medium with the same speed in all directions.
    ///
    /// # Errors
    /// [`Error::BadSpeed`] unless the speed is positive and finite.
    pub fn isotropic(speed: f64) -> Result<Self, Error> {
        Self::check_speed(speed)?;
        Ok(Self {
            kind: Kind::Isotropic { speed },
        })
    }

    /// A speed whose square and inverse square are numbers, too.
    fn check_speed(speed: f64) -> Result<(), Error> {
        let square = speed * speed;
        if speed > 0.0 && square.is_finite() && square.recip().is_finite() {
            Ok(())
        } else {
            Err(Error::BadSpeed { speed })
        }
    }

    /// A medium whose indicatrix is an ellipse with semi-axes `a` at `angle` (radians) to the x axis, and `b` across.
    ///
    /// # Errors
    /// [`Error::BadSpeed`] unless both are positive and finite; [`Error::NonFinite`] for the angle.
    pub fn elliptical(a: f64, b: f64, angle: f64) -> Result<Self, Error> {
        Self::check_speed(a)?;
        Self::check_speed(b)?;
        if !angle.is_finite() {
            return Err(Error::NonFinite {
                what: "the angle of an indicatrix",
            });
        }
        if a == b {
            return Self::isotropic(a);
        }
        let turn = DMat2::from_angle(angle);
        let stretch = |x, y| turn * DMat2::from_diagonal(DVec2::new(x, y)) * turn.transpose();
        Ok(Self {
            kind: Kind::Elliptical {
                semi_axes: [a, b],
                angle,
                to_unit: stretch(a.recip(), b.recip()),
                from_unit: stretch(a, b),
            },
        })
    }

    /// A medium with any rational indicatrix (see [`DualIndicatrix`] for what it must satisfy).
    #[must_use]
    pub fn rational(indicatrix: DualIndicatrix) -> Self {
        Self {
            kind: Kind::Rational(indicatrix),
        }
    }

    /// The linear map to the plane in which the indicatrix is the unit circle: there every distance is a travel time.
    /// None for a rational indicatrix that is no ellipse.
    #[must_use]
    pub fn unit_plane(&self) -> Option<DMat2> {
        match self.kind {
            Kind::Isotropic { speed } => Some(DMat2::from_diagonal(DVec2::splat(speed.recip()))),
            Kind::Elliptical { to_unit, .. } => Some(to_unit),
            Kind::Rational(_) => None,
        }
    }

    /// The way back from [`Medium::unit_plane`].
    #[must_use]
    pub fn from_unit_plane(&self) -> Option<DMat2> {
        match self.kind {
            Kind::Isotropic { speed } => Some(DMat2::from_diagonal(DVec2::splat(speed))),
            Kind::Elliptical { from_unit, .. } => Some(from_unit),
            Kind::Rational(_) => None,
        }
    }

    /// The speed of a front in the direction of its unit normal: the support of the indicatrix.
    #[inline(always)]
    #[must_use]
    pub fn front_speed(&self, normal: DVec2) -> f64 {
        match &self.kind {
            Kind::Isotropic { speed } => *speed,
            Kind::Elliptical { from_unit, .. } => (*from_unit * normal).length(),
            Kind::Rational(indicatrix) => indicatrix.jet(normal.to_angle()).support,
        }
    }

    /// The slowness of a front with this unit normal.
    #[inline(always)]
    #[must_use]
    pub fn slowness(&self, normal: DVec2) -> DVec2 {
        normal / self.front_speed(normal)
    }

    /// The velocity of a ray with this slowness.
    #[inline(always)]
    #[must_use]
    pub fn group_velocity(&self, slowness: DVec2) -> DVec2 {
        match &self.kind {
            Kind::Isotropic { speed } => speed * speed * slowness,
            // V = M² s: the gradient of |M s|²/2. The maps are symmetric.
            Kind::Elliptical { from_unit, .. } => *from_unit * (*from_unit * slowness),
            Kind::Rational(indicatrix) => indicatrix.contact(slowness.to_angle()).point,
        }
    }

    /// The derivative of the group velocity in the direction `change` of the slowness, which is tangent to the slowness curve.
    #[inline(always)]
    #[must_use]
    pub fn group_velocity_change(&self, slowness: DVec2, change: DVec2) -> DVec2 {
        match &self.kind {
            Kind::Isotropic { .. } | Kind::Elliptical { .. } => self.group_velocity(change),
            Kind::Rational(indicatrix) => {
                let turning = slowness.perp_dot(change) / slowness.length_squared();
                let contact = indicatrix.contact(slowness.to_angle());
                turning * contact.radius * contact.normal.perp()
            }
        }
    }

    /// The slowness of the ray that travels in the given direction.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`]; [`Error::NonFinite`].
    pub fn slowness_along(&self, direction: DVec2) -> Result<DVec2, Error> {
        if !direction.is_finite() {
            return Err(Error::NonFinite {
                what: "the direction of a ray",
            });
        }
        if direction == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "the direction of a ray",
            });
        }
        match &self.kind {
            Kind::Isotropic { speed } => Ok(direction.normalize() / *speed),
            Kind::Elliptical { to_unit, .. } => Ok(*to_unit * (*to_unit * direction).normalize()),
            Kind::Rational(indicatrix) => {
                let plane = ph_curves::MinkowskiPlane::new(ph_curves::Indicatrix::try_new(
                    indicatrix.clone(),
                )?);
                Ok(self.slowness(DVec2::from_angle(plane.normal_angle_of(direction))))
            }
        }
    }

    /// The largest length of a slowness, and of its derivative by the angle of the normal; none for a rational indicatrix.
    pub(crate) fn slowness_bounds(&self) -> Option<[f64; 2]> {
        let [longer, shorter] = self.sorted_axes()?;
        // s = N / P with P² = a² cos² + b² sin² in the axes: |P'| is at most (a² - b²) / (2 P).
        let change = (longer - shorter) * (longer + shorter) / (2.0 * shorter * shorter * shorter);
        Some([shorter.recip(), shorter.recip() + change])
    }

    /// By how much more the normal of a ray can turn than its direction.
    pub(crate) fn stretch(&self) -> f64 {
        self.sorted_axes()
            .map_or(f64::INFINITY, |[longer, shorter]| {
                (longer / shorter).powi(2)
            })
    }

    /// The semi-axes of the indicatrix, the longer one first.
    fn sorted_axes(&self) -> Option<[f64; 2]> {
        match self.kind {
            Kind::Isotropic { speed } => Some([speed, speed]),
            Kind::Elliptical {
                semi_axes: [a, b], ..
            } => Some([a.max(b), a.min(b)]),
            Kind::Rational(_) => None,
        }
    }

    /// The travel time along a vector: its norm.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn travel_time(&self, vector: DVec2) -> Result<f64, Error> {
        if !vector.is_finite() {
            return Err(Error::NonFinite {
                what: "the vector of a travel time",
            });
        }
        match &self.kind {
            Kind::Isotropic { speed } => Ok(vector.length() / speed),
            Kind::Elliptical { to_unit, .. } => Ok((*to_unit * vector).length()),
            Kind::Rational(_) if vector == DVec2::ZERO => Ok(0.0),
            Kind::Rational(_) => Ok(self.slowness_along(vector)?.dot(vector)),
        }
    }

    /// The slowness with the given component along the unit vector `tangent` whose ray leaves to the side of `normal`, if
    /// there is one: Snell's law in its general form.
    ///
    /// # Errors
    /// [`Error::TotalReflection`] (with the place `at`) if the component is too large.
    #[inline(always)]
    pub fn slowness_behind(
        &self,
        tangential: f64,
        tangent: DVec2,
        normal: DVec2,
        at: DVec2,
    ) -> Result<DVec2, Error> {
        let none = Error::TotalReflection {
            at,
            tangential_slowness: tangential,
        };
        match &self.kind {
            Kind::Isotropic { speed } => {
                let slowness = speed.recip();
                let square = (slowness - tangential) * (slowness + tangential);
                if square < 0.0 || square.is_nan() {
                    return Err(none);
                }
                Ok(tangential * tangent + square.sqrt() * normal)
            }
            Kind::Elliptical { from_unit, .. } => {
                // |M (c τ + q ν)| = 1, and the root with <V, ν> > 0 is the larger one.
                let (along, across) = (*from_unit * tangent, *from_unit * normal);
                let (a, b) = (across.length_squared(), tangential * along.dot(across));
                // b² - a (c² |Mτ|² - 1), with the large squares cancelled: |Mν|² |Mτ|² - <Mτ, Mν>² = det².
                let determinant = along.perp_dot(across);
                let discriminant = a - (tangential * determinant).powi(2);
                if discriminant < 0.0 || discriminant.is_nan() {
                    return Err(none);
                }
                Ok(tangential * tangent + ((discriminant.sqrt() - b) / a) * normal)
            }
            Kind::Rational(indicatrix) => {
                let mut solver = Solver::default();
                for sign in [1.0, -1.0] {
                    for arc in indicatrix.arcs() {
                        // <n, τ> = c P on the arc (-P, n), and on its image (-P, -n) in the origin.
                        let condition: Vec<f64> = arc
                            .vectors()
                            .iter()
                            .map(|u: &DVec3| {
                                sign * (u.y * tangent.x + u.z * tangent.y) + tangential * u.x
                            })
                            .collect();
                        for root in solver.roots(&condition)? {
                            let contact = arc.contact(root.value())?;
                            if sign * contact.point.dot(normal) > 0.0 {
                                return Ok(sign * contact.normal / contact.support);
                            }
                        }
                    }
                }
                Err(none)
            }
        }
    }
}

#[cfg(feature = "serde")]
impl From<Medium> for crate::stored::StoredMedium {
    fn from(medium: Medium) -> Self {
        match medium.kind {
            Kind::Isotropic { speed } => Self::Isotropic { speed },
            Kind::Elliptical {
                semi_axes, angle, ..
            } => Self::Elliptical { semi_axes, angle },
            Kind::Rational(indicatrix) => Self::Rational {
                arcs: indicatrix.arcs().to_vec(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ph_curves::{Bumped, Ellipse};

    fn media() -> [Medium; 4] {
        [
            Medium::isotropic(1.7).unwrap(),
            Medium::elliptical(1.3, 0.8, 0.4).unwrap(),
            Medium::rational(Ellipse { a: 1.3, b: 0.8 }.dual().unwrap()),
            Medium::rational(Bumped { height: 0.04 }.dual().unwrap()),
        ]
    }

    #[test]
    fn slowness_and_velocity_are_dual() {
        for medium in media() {
            for i in 0..24 {
                let normal = DVec2::from_angle(0.3 * f64::from(i));
                let slowness = medium.slowness(normal);
                let velocity = medium.group_velocity(slowness);
                assert!((slowness.dot(velocity) - 1.0).abs() < 1e-13);
                assert!((medium.slowness_along(velocity).unwrap() - slowness).length() < 1e-12);
                assert!((medium.travel_time(2.5 * velocity).unwrap() - 2.5).abs() < 1e-12);
                let step = 1e-5;
                let turned =
                    |angle: f64| medium.slowness(DVec2::from_angle(0.3 * f64::from(i) + angle));
                let change = (turned(step) - turned(-step)) / (2.0 * step);
                let moved = (medium.group_velocity(turned(step))
                    - medium.group_velocity(turned(-step)))
                    / (2.0 * step);
                assert!((medium.group_velocity_change(slowness, change) - moved).length() < 1e-8);
            }
        }
    }

    #[test]
    fn the_tangential_slowness_is_kept_and_the_ray_leaves() {
        let (tangent, normal) = (DVec2::from_angle(0.2), DVec2::from_angle(0.2).perp());
        for medium in media() {
            for i in 0..24 {
                let given = medium.slowness(DVec2::from_angle(0.3 * f64::from(i) + 0.01));
                let found = medium
                    .slowness_behind(given.dot(tangent), tangent, normal, DVec2::ZERO)
                    .unwrap();
                assert!((found.dot(tangent) - given.dot(tangent)).abs() < 1e-13);
                assert!(medium.group_velocity(found).dot(normal) > 0.0);
                assert!((medium.slowness(found.normalize()) - found).length() < 1e-12);
            }
            let refused = medium.slowness_behind(10.0, tangent, normal, DVec2::ONE);
            assert!(matches!(
                refused,
                Err(Error::TotalReflection { at: DVec2::ONE, .. })
            ));
        }
    }

    #[test]
    fn impossible_media_are_refused() {
        for speed in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
            assert!(matches!(
                Medium::isotropic(speed),
                Err(Error::BadSpeed { .. })
            ));
        }
        assert!(matches!(
            Medium::elliptical(1.0, 2.0, f64::NAN),
            Err(Error::NonFinite { .. })
        ));
        let medium = Medium::isotropic(1.0).unwrap();
        assert!(matches!(
            medium.slowness_along(DVec2::ZERO),
            Err(Error::ZeroDirection { .. })
        ));
    }
}
