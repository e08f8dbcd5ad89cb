//! One value for every Dupin cyclide.

use crate::{CurvatureCircle, Error, Frame, Kind, Parabolic, Quartic, tolerance};
use glam::DVec3;
use lorentz::Cycle;

/// A Dupin cyclide of any type: a quartic one (ring, horned, spindle, torus, double sphere) or a parabolic one.
///
/// All coordinates are in the world. The two parameters are `theta` and `psi` (radians, period `2 pi`) on a quartic, and `u` and
/// `v` (any real numbers) on a parabolic cyclide; circles of the *first family* have a constant first parameter.
///
/// ```
/// use cyclide::{Dupin, Frame, Kind};
/// let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
/// assert_eq!(ring.kind(), Kind::Ring);
/// let point = ring.point(0.7, 1.9);
/// assert!(ring.implicit(point).abs() < 1e-12);
/// let [theta, psi] = ring.parameters_at(point);
/// assert!((theta - 0.7).abs() < 1e-14 && (psi - 1.9).abs() < 1e-14);
/// # Ok::<(), cyclide::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Dupin {
    /// A surface of degree four.
    Quartic(Quartic),
    /// A surface of degree three.
    Parabolic(Parabolic),
}

/// Calls the method of the same meaning on either surface.
macro_rules! on_either {
    ($self:ident, $surface:ident => $call:expr) => {
        match $self {
            Dupin::Quartic($surface) => $call,
            Dupin::Parabolic($surface) => $call,
        }
    };
}

impl Dupin {
    /// The quartic cyclide with parameters `a > c >= 0` and `mu`; see [`Quartic::new`].
    ///
    /// # Errors
    ///
    /// As [`Quartic::new`].
    pub fn quartic(a: f64, c: f64, mu: f64, frame: Frame) -> Result<Self, Error> {
        Quartic::new(a, c, mu, frame).map(Self::Quartic)
    }

    /// The torus with radii `a` (of the circle of centres) and `mu` (of the tube) about the frame's `z` axis.
    ///
    /// # Errors
    ///
    /// As [`Quartic::new`].
    pub fn torus(a: f64, mu: f64, frame: Frame) -> Result<Self, Error> {
        Quartic::torus(a, mu, frame).map(Self::Quartic)
    }

    /// The parabolic cyclide with focal parameter `f > 0` and offset `k`; see [`Parabolic::new`].
    ///
    /// # Errors
    ///
    /// As [`Parabolic::new`].
    pub fn parabolic(f: f64, k: f64, frame: Frame) -> Result<Self, Error> {
        Parabolic::new(f, k, frame).map(Self::Parabolic)
    }

    /// The quartic, if it is one.
    #[must_use]
    pub const fn as_quartic(&self) -> Option<&Quartic> {
        match self {
            Self::Quartic(surface) => Some(surface),
            Self::Parabolic(_) => None,
        }
    }

    /// The parabolic cyclide, if it is one.
    #[must_use]
    pub const fn as_parabolic(&self) -> Option<&Parabolic> {
        match self {
            Self::Quartic(_) => None,
            Self::Parabolic(surface) => Some(surface),
        }
    }

    /// Where the surface stands.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        on_either!(self, surface => surface.frame())
    }

    /// The same shape in another frame.
    #[must_use]
    pub const fn in_frame(self, frame: Frame) -> Self {
        match self {
            Self::Quartic(surface) => Self::Quartic(surface.in_frame(frame)),
            Self::Parabolic(surface) => Self::Parabolic(surface.in_frame(frame)),
        }
    }

    /// The type of the surface as designed, lengths compared up to rounding.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind_within(tolerance::EXACT_KIND)
    }

    /// The type, with lengths within `tolerance` (relative) taken as equal.
    #[must_use]
    pub fn kind_within(&self, tolerance: f64) -> Kind {
        on_either!(self, surface => surface.kind_within(tolerance))
    }

    /// The point with the given parameters.
    #[must_use]
    pub fn point(&self, first: f64, second: f64) -> DVec3 {
        on_either!(self, surface => surface.point(first, second))
    }

    /// The unit normal at the given parameters: `point = centre + radius * normal` for both tangent spheres.
    #[must_use]
    pub fn normal(&self, first: f64, second: f64) -> DVec3 {
        on_either!(self, surface => surface.normal(first, second))
    }

    /// The derivatives of [`Dupin::point`] by the first and the second parameter; they are orthogonal.
    #[must_use]
    pub fn partials(&self, first: f64, second: f64) -> [DVec3; 2] {
        on_either!(self, surface => surface.partials(first, second))
    }

    /// Unit tangents of the lines of curvature, along the first and the second parameter.
    #[must_use]
    pub fn principal_directions(&self, first: f64, second: f64) -> [DVec3; 2] {
        on_either!(self, surface => surface.principal_directions(first, second))
    }

    /// Principal curvatures along the first and the second parameter, with `dN = kappa dP`.
    #[must_use]
    pub fn principal_curvatures(&self, first: f64, second: f64) -> [f64; 2] {
        on_either!(self, surface => surface.principal_curvatures(first, second))
    }

    /// Area of the surface per unit of both parameters, `|P_1 x P_2| >= 0`.
    #[must_use]
    pub fn area_density(&self, first: f64, second: f64) -> f64 {
        let [along_first, along_second] = self.partials(first, second);
        along_first.cross(along_second).length()
    }

    /// The implicit polynomial at a point, of degree 4 or 3.
    #[must_use]
    pub fn implicit(&self, point: DVec3) -> f64 {
        on_either!(self, surface => surface.implicit(point))
    }

    /// The gradient of the implicit polynomial; zero at singular points.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        on_either!(self, surface => surface.gradient(point))
    }

    /// The parameters of a point of the surface, in closed form.
    #[must_use]
    pub fn parameters_at(&self, point: DVec3) -> [f64; 2] {
        on_either!(self, surface => surface.parameters_at(point))
    }

    /// The real singular points: none, one or two.
    #[must_use]
    pub fn singular_points(&self) -> Vec<DVec3> {
        on_either!(self, surface => surface.singular_points())
    }

    /// The parallel surface at a signed distance along the normal: a cyclide again.
    ///
    /// # Errors
    ///
    /// As [`Quartic::offset`] and [`Parabolic::offset`].
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        Ok(match self {
            Self::Quartic(surface) => Self::Quartic(surface.offset(distance)?),
            Self::Parabolic(surface) => Self::Parabolic(surface.offset(distance)?),
        })
    }

    /// The line of curvature with a constant first parameter.
    #[must_use]
    pub fn first_circle(&self, first: f64) -> CurvatureCircle {
        match self {
            Self::Quartic(surface) => surface.theta_circle(first),
            Self::Parabolic(surface) => surface.u_circle(first),
        }
    }

    /// The line of curvature with a constant second parameter.
    #[must_use]
    pub fn second_circle(&self, second: f64) -> CurvatureCircle {
        match self {
            Self::Quartic(surface) => surface.psi_circle(second),
            Self::Parabolic(surface) => surface.v_circle(second),
        }
    }

    /// The sphere (centre and signed radius) that touches along [`Dupin::first_circle`].
    #[must_use]
    pub fn first_sphere(&self, first: f64) -> Cycle {
        match self {
            Self::Quartic(surface) => surface.theta_sphere(first),
            Self::Parabolic(surface) => surface.u_sphere(first),
        }
    }

    /// The sphere that touches along [`Dupin::second_circle`]; on a quartic it is a plane, with infinite radius, where
    /// `cos psi = 0`.
    #[must_use]
    pub fn second_sphere(&self, second: f64) -> Cycle {
        match self {
            Self::Quartic(surface) => surface.psi_sphere(second),
            Self::Parabolic(surface) => surface.v_sphere(second),
        }
    }
}

impl From<Quartic> for Dupin {
    fn from(surface: Quartic) -> Self {
        Self::Quartic(surface)
    }
}

impl From<Parabolic> for Dupin {
    fn from(surface: Parabolic) -> Self {
        Self::Parabolic(surface)
    }
}
