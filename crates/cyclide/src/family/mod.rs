//! One-parameter families of blends: two lines of spheres that meet or are parallel.

mod kinds;

pub(crate) use kinds::Shape;
pub use kinds::TypeInterval;

use crate::blend::{self, Blend};
use crate::frame::{length, place};
use crate::{CurvatureCircle, Error, SphereLine, tolerance};
use bezier_mass::MassPoint;
use glam::DVec3;
use lorentz::Cycle;

/// The conic of sphere centres that both lines touch, hence the kind of circles that touch the cones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Conic {
    /// Contact along circles `theta = const`.
    Ellipse,
    /// Contact along circles `psi = const`.
    Hyperbola,
    /// The members are parabolic (cubic) cyclides.
    Parabola,
}

/// How the two lines of spheres lie in their plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Structure {
    /// They meet in a common sphere; the member at `t` touches at Lorentz distance `t` on the first line and
    /// `pairing * t` on the second. `product` is that of the two unit directions.
    Meet {
        sphere: Cycle,
        pairing: i8,
        product: f64,
    },
    /// They are parallel; `step` leads from the first to the second, orthogonal to both; `square` is its product with itself.
    Parallel { step: Cycle, square: f64 },
}

/// A one-parameter family of cyclides that touch two cones along circles, as a curve of [`Blend`]s.
///
/// The parameter is a length. If the cones have a common inscribed sphere it is `t`: the distance along the rulings from the circle
/// where that sphere touches a cone to the contact circle, the same on both cones up to the sign [`Family::pairing`].
/// For parallel axes and equal angles it is `s`: the distance along the first axis from the reference point (vertex) to the
/// centre of the contact sphere.
///
/// Shene's parameter, a point `X` on a diagonal, is reached by [`Family::blend_at`] and [`Family::diagonal_point_of`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(remote = "Self")
)]
pub struct Family {
    pub(crate) lines: [SphereLine; 2],
    pub(crate) orientation: i8,
    /// Whether the axis of the second line is opposite to that of the cone as given, so that parallel axes have one direction.
    pub(crate) second_turned: bool,
    pub(crate) conic: Conic,
    pub(crate) structure: Structure,
    pub(crate) plane_normal: DVec3,
    pub(crate) size: f64,
    pub(crate) one_axis: bool,
}

/// The line in the axial plane that carries one of the conics (or lines) in which two cones meet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Diagonal {
    /// A point of the line: the one whose member is the common sphere, or for parallel axes the one at `s = 0`.
    pub point: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// Shene's diagonal points R and S, where skeletal lines of the two cones meet; vectors where they are parallel.
    pub diagonal_points: [MassPoint<DVec3>; 2],
}

impl Family {
    /// The oriented cones as lines of spheres; the second has the orientation of this family.
    #[must_use]
    pub const fn lines(&self) -> &[SphereLine; 2] {
        &self.lines
    }

    /// Orientation of the second cone relative to how it was given: 1 or -1.
    #[must_use]
    pub const fn orientation(&self) -> i8 {
        self.orientation
    }

    /// The sign that ties the two contact circles: `t` on the first cone, `pairing * t` on the second. Zero for parallel lines of
    /// spheres.
    #[must_use]
    pub const fn pairing(&self) -> i8 {
        match self.structure {
            Structure::Meet { pairing, .. } => pairing,
            Structure::Parallel { .. } => 0,
        }
    }

    /// The conic that both lines touch.
    #[must_use]
    pub const fn conic(&self) -> Conic {
        self.conic
    }

    /// The common inscribed sphere; `None` if it is at infinity (parallel lines of spheres).
    #[must_use]
    pub const fn common_sphere(&self) -> Option<Cycle> {
        match self.structure {
            Structure::Meet { sphere, .. } => Some(sphere),
            Structure::Parallel { .. } => None,
        }
    }

    /// Unit normal of the plane of both axes: first axis cross second axis; for parallel axes, axis cross the step from the first to
    /// the second; arbitrary for one axis.
    #[must_use]
    pub const fn axial_plane_normal(&self) -> DVec3 {
        self.plane_normal
    }

    /// Whether both cones have one axis, so that the members are tori.
    #[must_use]
    pub const fn is_coaxial(&self) -> bool {
        self.one_axis
    }

    /// The contact spheres of the member at a parameter.
    #[must_use]
    pub fn contact_spheres(&self, parameter: f64) -> [Cycle; 2] {
        let [first, second] = &self.lines;
        match self.structure {
            Structure::Meet {
                sphere, pairing, ..
            } => [
                sphere + first.direction() * parameter,
                sphere + second.direction() * (f64::from(pairing) * parameter),
            ],
            Structure::Parallel { step, .. } => {
                let sphere = first.at(parameter);
                [sphere, sphere + step]
            }
        }
    }

    /// The member at a parameter.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::CommonSphere`] at `t = 0`, where the cyclide shrinks to the common inscribed sphere;
    /// [`Error::NotTangent`] if rounding leaves a residual above [`tolerance::BLEND`].
    pub fn blend(&self, parameter: f64) -> Result<Blend, Error> {
        length("family parameter", parameter)?;
        if matches!(self.structure, Structure::Meet { .. })
            && parameter.abs() <= tolerance::CLASS * self.size
        {
            return Err(Error::CommonSphere { parameter });
        }
        blend::member(self, parameter)
    }

    /// The member of the point `X` on the diagonal (Shene, Section 4.2).
    ///
    /// # Errors
    ///
    /// As [`Family::parameter_at`] and [`Family::blend`].
    pub fn blend_at(&self, x: DVec3) -> Result<Blend, Error> {
        self.blend(self.parameter_at(x)?)
    }

    /// The member that touches the first cone in the plane perpendicular to its axis at `height` from the reference point.
    ///
    /// # Errors
    ///
    /// As [`Family::blend`].
    pub fn blend_at_height(&self, height: f64) -> Result<Blend, Error> {
        self.blend(self.parameter_at_height(length("height", height)?))
    }

    pub(crate) fn parameter_at_height(&self, height: f64) -> f64 {
        let first = &self.lines[0];
        let s = first.sphere_touching_at(height);
        match self.structure {
            Structure::Meet { sphere, .. } => (s - first.foot(sphere.centre)) * first.cos,
            Structure::Parallel { .. } => s,
        }
    }

    /// The parameter of a point on the diagonal.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::NotOnDiagonal`] for a point off the diagonal or off the axial plane, further than
    /// [`tolerance::CLASS`] of the data's size; also for cones on one axis, whose members are not told apart by points.
    pub fn parameter_at(&self, x: DVec3) -> Result<f64, Error> {
        place("point on the diagonal", x)?;
        let [first, second] = &self.lines;
        let (distance, size, parameter) = match self.structure {
            Structure::Meet {
                sphere, pairing, ..
            } => {
                let offset = x - sphere.centre;
                let ordinates = self
                    .lines
                    .map(|line| offset.dot(line.axis) / line.cos + sphere.radius * line.tan());
                let pairing = f64::from(pairing);
                let steepness =
                    (first.axis / first.cos - pairing * second.axis / second.cos).length();
                let off_line = (ordinates[0] - pairing * ordinates[1]) / steepness;
                (
                    off_line.hypot(offset.dot(self.plane_normal)),
                    offset.length(),
                    ordinates[0],
                )
            }
            Structure::Parallel { .. } => {
                let offset = x - first.point;
                let s = first.sphere_touching_at(first.foot(x));
                let distance = self
                    .diagonal_point_of(s)
                    .position()
                    .map_or(f64::INFINITY, |on_line| on_line.distance(x));
                (distance, offset.length(), s)
            }
        };
        let allowed = tolerance::CLASS * self.size.max(size);
        if self.one_axis || distance > allowed {
            return Err(Error::NotOnDiagonal { distance, allowed });
        }
        Ok(parameter)
    }

    /// Shene's point `X` of the member at a parameter: a vector where the diagonal runs to infinity.
    #[must_use]
    pub fn diagonal_point_of(&self, parameter: f64) -> MassPoint<DVec3> {
        let [first, second] = &self.lines;
        match self.structure {
            Structure::Meet {
                sphere, pairing, ..
            } => {
                let cross = first.axis.cross(second.axis);
                let weight = cross.length_squared();
                let reach = [
                    first.cos * parameter - sphere.radius * first.sin,
                    second.cos * f64::from(pairing) * parameter - sphere.radius * second.sin,
                ];
                let offset =
                    reach[0] * second.axis.cross(cross) - reach[1] * first.axis.cross(cross);
                MassPoint::from_homogeneous(weight, weight * sphere.centre + offset)
            }
            Structure::Parallel { .. } => {
                // The centre of similitude of the two contact circles, which lie in one plane.
                let spheres = self.contact_spheres(parameter);
                let [foot, other_foot] = spheres.map(|sphere| first.contact_circle(sphere).centre);
                let [radius, other_radius] = spheres.map(|sphere| sphere.radius);
                MassPoint::from_homogeneous(
                    radius + other_radius,
                    other_radius * foot + radius * other_foot,
                )
            }
        }
    }

    /// The diagonal that parametrises the family; `None` for cones on one axis.
    #[must_use]
    pub fn diagonal(&self) -> Option<Diagonal> {
        if self.one_axis {
            return None;
        }
        let [first, second] = &self.lines;
        let (point, direction) = match self.structure {
            Structure::Meet { pairing, .. } => {
                let steep = first.axis / first.cos - f64::from(pairing) * second.axis / second.cos;
                (
                    self.diagonal_point_of(0.0).position()?,
                    self.plane_normal.cross(steep).try_normalize()?,
                )
            }
            Structure::Parallel { .. } => {
                let [from, to] = [0.0, self.size].map(|s| self.diagonal_point_of(s));
                let direction = from.moment(to).try_normalize()?;
                (from.position().or(to.position())?, direction)
            }
        };
        Some(Diagonal {
            point,
            direction,
            diagonal_points: self.diagonal_points(),
        })
    }

    /// Where the paired skeletal lines `(x - q) . n = rho` of the two cones meet.
    fn diagonal_points(&self) -> [MassPoint<DVec3>; 2] {
        let [first, second] = &self.lines;
        let across = self.plane_normal;
        let normal = |line: &SphereLine, side: f64| {
            -line.sin * line.axis + side * line.cos * across.cross(line.axis)
        };
        let other_side = if self.pairing() < 0 { 1.0 } else { -1.0 };
        [1.0, -1.0].map(|side| {
            let (n, m) = (normal(first, side), normal(second, other_side * side));
            // In the plane: x = (h m' - k n') / (n x m), with n', m' turned by a quarter.
            let weight = n.cross(m).dot(across);
            let height = first.radius;
            let other_height = second.radius + (second.point - first.point).dot(m);
            let offset = height * m.cross(across) - other_height * n.cross(across);
            MassPoint::from_homogeneous(weight, weight * first.point + offset)
        })
    }

    /// The member that touches the first cone along the given circle.
    ///
    /// # Errors
    ///
    /// [`Error::NotACircleOfTheCone`]; as [`Family::blend`].
    pub fn blend_through_circle(&self, circle: &CurvatureCircle) -> Result<Blend, Error> {
        let line = &self.lines[0];
        let height = line.foot(circle.centre);
        let parameter = self.parameter_at_height(height);
        let [sphere, _] = self.contact_spheres(parameter);
        let expected = line.contact_circle(sphere);
        let size = circle.radius.max(self.size);
        let deviation = (expected.centre.distance(circle.centre)
            + (expected.radius - circle.radius).abs())
            / size
            + expected.axis.cross(circle.axis).length();
        if deviation.is_nan() || deviation > tolerance::CLASS {
            return Err(Error::NotACircleOfTheCone { deviation });
        }
        self.blend(parameter)
    }
}
