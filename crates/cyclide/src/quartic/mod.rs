//! The quartic cyclides: ring, horned, spindle, the three tori, and the sphere counted twice.

mod implicit;
mod parametrisation;

use crate::CurvatureCircle;
use crate::frame::{finite, length, size};
use crate::{Error, Frame, Kind, tolerance};
use glam::DVec3;

/// A quartic Dupin cyclide in normal form: `a >= c >= 0`, `mu >= 0` and a rigid frame.
///
/// Its tangent spheres of one family have their centres on the ellipse with half axes `a` and `b` in the plane `z = 0`
/// (radius `mu - c cos theta`), those of the other on the confocal hyperbola in `y = 0` (radius `mu - a / cos psi`).
/// `mu` is the radius of the mean sphere: adding to it moves to the parallel surface.
///
/// The unit normal is the one with `P = centre + radius N` for all these (signed) spheres. On a ring it points out of
/// the tube.
///
/// Source: the two implicit equations are (3) and (4) of the paper on biquadratic patches, after Forsyth and Darboux.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "QuarticData", into = "QuarticData")
)]
pub struct Quartic {
    a: f64,
    c: f64,
    mu: f64,
    /// `sqrt(a² - c²)`, computed without cancellation.
    b: f64,
    /// `c / a`; free for the double sphere, whose orthogonal nets it tells apart.
    eccentricity: f64,
    /// `b / a`, the complement of the eccentricity.
    minor_ratio: f64,
    frame: Frame,
}

impl Quartic {
    /// The cyclide with parameters `a > c >= 0` and `mu` in the given frame; `a = c = 0` gives the double sphere with the
    /// net of longitudes and latitudes.
    ///
    /// A negative `mu` names the same surface as `-mu` with `x` reversed and the other normal; it is accepted and
    /// normalised by turning the frame about its `y` axis.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::LengthOutOfRange`]; [`Error::QuarticParameters`] unless `a >= c >= 0`; [`Error::TwoSpheres`] for `a = c > 0`;
    /// [`Error::VanishingSphere`] for `a = c = mu = 0`.
    pub fn new(a: f64, c: f64, mu: f64, frame: Frame) -> Result<Self, Error> {
        size("a", a)?;
        length("c", c)?;
        size("mu", mu)?;
        if c < 0.0 || a < c {
            return Err(Error::QuarticParameters { a, c });
        }
        if a == 0.0 {
            return Self::double_sphere(mu, 0.0, frame);
        }
        if a - c <= tolerance::EXACT_KIND * a {
            return Err(Error::TwoSpheres { a });
        }
        let b = ((a - c) * (a + c)).sqrt();
        let shape = Self {
            a,
            c,
            mu: mu.abs(),
            b,
            eccentricity: c / a,
            minor_ratio: b / a,
            frame,
        };
        Ok(if mu < 0.0 {
            Self {
                frame: frame.turned_about_y(),
                ..shape
            }
        } else {
            shape
        })
    }

    /// From both half axes and `c`, all computed: `b` is not recovered from `a` and `c`, which would lose digits near
    /// `c = a`. A negative `mu` is normalised as in [`Quartic::new`].
    pub(crate) fn with_half_axes(
        [a, b, c]: [f64; 3],
        mu: f64,
        frame: Frame,
    ) -> Result<Self, Error> {
        for (what, value) in [("a", a), ("mu", mu)] {
            size(what, value)?;
        }
        for (what, value) in [("b", b), ("c", c)] {
            length(what, value)?;
        }
        if !(b > 0.0 && a >= b) {
            return Err(Error::QuarticParameters { a, c });
        }
        let frame = if mu < 0.0 {
            frame.turned_about_y()
        } else {
            frame
        };
        Ok(Self {
            a,
            c,
            mu: mu.abs(),
            b,
            eccentricity: c / a,
            minor_ratio: b / a,
            frame,
        })
    }

    /// The torus whose tube of radius `mu` follows a circle of radius `a` about the frame's `z` axis.
    ///
    /// # Errors
    ///
    /// As [`Quartic::new`].
    pub fn torus(a: f64, mu: f64, frame: Frame) -> Result<Self, Error> {
        Self::new(a, 0.0, mu, frame)
    }

    /// The sphere of radius `|mu|` counted twice, with the orthogonal net of circles of eccentricity `e` in `[0, 1)`:
    /// the planes of `theta = const` meet in a line at distance `e mu` from the centre. `e = 0` is longitude and
    /// latitude.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::VanishingSphere`] for `mu = 0`; [`Error::NetEccentricity`] outside `[0, 1)`.
    pub fn double_sphere(mu: f64, e: f64, frame: Frame) -> Result<Self, Error> {
        size("mu", mu)?;
        finite("e", e)?;
        if mu == 0.0 {
            return Err(Error::VanishingSphere);
        }
        if !(0.0..1.0 - tolerance::EXACT_KIND).contains(&e) {
            return Err(Error::NetEccentricity { e });
        }
        let frame = if mu < 0.0 {
            frame.turned_about_y()
        } else {
            frame
        };
        let minor_ratio = ((1.0 - e) * (1.0 + e)).sqrt();
        Ok(Self {
            a: 0.0,
            c: 0.0,
            mu: mu.abs(),
            b: 0.0,
            eccentricity: e,
            minor_ratio,
            frame,
        })
    }

    /// Half the long axis of the ellipse of centres; the larger radius of a torus.
    #[must_use]
    pub const fn a(&self) -> f64 {
        self.a
    }

    /// Half the short axis of the ellipse of centres, `sqrt(a² - c²)`.
    #[must_use]
    pub const fn b(&self) -> f64 {
        self.b
    }

    /// Half the distance of the foci of the ellipse of centres.
    #[must_use]
    pub const fn c(&self) -> f64 {
        self.c
    }

    /// Mean radius of the tangent spheres, not negative.
    #[must_use]
    pub const fn mu(&self) -> f64 {
        self.mu
    }

    /// `c / a`, in `[0, 1)`. All that the normals depend on; on the double sphere it names the net.
    #[must_use]
    pub const fn eccentricity(&self) -> f64 {
        self.eccentricity
    }

    /// `b / a`, in `(0, 1]`; defined for the double sphere too.
    pub(crate) const fn minor_ratio(&self) -> f64 {
        self.minor_ratio
    }

    /// Where the surface stands.
    #[must_use]
    pub const fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The type, with lengths that differ by no more than rounding taken as equal.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind_within(tolerance::EXACT_KIND)
    }

    /// The type, with lengths within `tolerance` (relative) taken as equal.
    #[must_use]
    pub fn kind_within(&self, tolerance: f64) -> Kind {
        Kind::of_quartic(self.a, self.c, self.mu, tolerance)
    }

    /// The same shape in another frame.
    #[must_use]
    pub const fn in_frame(self, frame: Frame) -> Self {
        Self { frame, ..self }
    }

    /// All lengths multiplied by a positive factor, in the given frame.
    pub(crate) fn scaled_in(self, factor: f64, frame: Frame) -> Result<Self, Error> {
        let (a, mu) = (self.a * factor, self.mu * factor);
        // A product that rounds to zero would be another kind of surface.
        for (what, before, after) in [("a", self.a, a), ("mu", self.mu, mu)] {
            if before != 0.0 && after == 0.0 {
                return Err(Error::LengthOutOfRange { what, value: after });
            }
        }
        Ok(Self {
            a: size("a", a)?,
            b: self.b * factor,
            c: self.c * factor,
            mu: size("mu", mu)?,
            frame,
            ..self
        })
    }

    /// The parallel surface at signed distance `distance` along the normal: again a cyclide with the same frame, `a` and
    /// `c`, and the same parameters for corresponding points. Where `mu + distance` is negative the result is
    /// normalised as in [`Quartic::new`].
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`]; [`Error::VanishingSphere`] if a double sphere shrinks to its centre.
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        let mu = length("offset distance", self.mu + distance)?;
        if self.a == 0.0 {
            return Self::double_sphere(mu, self.eccentricity, self.frame);
        }
        let frame = if mu < 0.0 {
            self.frame.turned_about_y()
        } else {
            self.frame
        };
        Ok(Self {
            mu: mu.abs(),
            frame,
            ..*self
        })
    }

    /// The real singular points, world coordinates: none, one or two.
    #[must_use]
    pub fn singular_points(&self) -> Vec<DVec3> {
        let (a, b, c, mu) = (self.a, self.b, self.c, self.mu);
        let pair = |point: DVec3, axis: DVec3| vec![point + axis, point - axis];
        let local = match self.kind() {
            Kind::DoublyHorned => pair(
                DVec3::X * (a * mu / c),
                DVec3::Y * (b * ((1.0 - mu / c) * (1.0 + mu / c)).sqrt()),
            ),
            Kind::SinglyHorned => vec![DVec3::X * a],
            Kind::OneSingularitySpindle | Kind::HornTorus => vec![DVec3::X * c],
            Kind::TwoSingularitySpindle | Kind::SpindleTorus => pair(
                DVec3::X * (c * mu / a),
                DVec3::Z * (b * ((mu / a - 1.0) * (mu / a + 1.0)).sqrt()),
            ),
            _ => Vec::new(),
        };
        local
            .into_iter()
            .map(|point| self.frame.point_to_world(point))
            .collect()
    }

    /// The line of curvature `theta = const`: a circle about a tangent of the ellipse of centres.
    #[must_use]
    pub fn theta_circle(&self, theta: f64) -> CurvatureCircle {
        let (sin, cos) = theta.sin_cos();
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let speed_squared = q * q + e * e * sin * sin;
        let radius = self.mu - self.c * cos;
        let slide = radius * e * sin / speed_squared;
        let centre = DVec3::new(
            self.a * cos + slide * sin,
            self.b * sin - slide * q * cos,
            0.0,
        );
        let axis = DVec3::new(-sin, q * cos, 0.0) / speed_squared.sqrt();
        self.circle(centre, radius.abs() * q / speed_squared.sqrt(), axis)
    }

    /// The line of curvature `psi = const`: a circle about a tangent of the hyperbola of centres. No division by
    /// `cos psi`: the sphere may be a plane.
    #[must_use]
    pub fn psi_circle(&self, psi: f64) -> CurvatureCircle {
        let (sin, cos) = psi.sin_cos();
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let speed_squared = q * q + e * e * sin * sin;
        let centre = DVec3::new(
            e * (self.a * q * q * cos + self.mu * sin * sin),
            0.0,
            q * sin * (self.c * e * cos - self.mu),
        ) / speed_squared;
        let axis = DVec3::new(e * sin, 0.0, -q) / speed_squared.sqrt();
        self.circle(
            centre,
            (self.mu * cos - self.a).abs() * q / speed_squared.sqrt(),
            axis,
        )
    }

    fn circle(&self, centre: DVec3, radius: f64, axis: DVec3) -> CurvatureCircle {
        CurvatureCircle {
            centre: self.frame.point_to_world(centre),
            radius,
            axis: self.frame.vector_to_world(axis),
        }
    }
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct QuarticData {
    a: f64,
    c: f64,
    mu: f64,
    eccentricity: f64,
    frame: Frame,
}

#[cfg(feature = "serde")]
impl TryFrom<QuarticData> for Quartic {
    type Error = Error;

    fn try_from(data: QuarticData) -> Result<Self, Error> {
        if data.a == 0.0 && data.c == 0.0 {
            return Self::double_sphere(data.mu, data.eccentricity, data.frame);
        }
        Self::new(data.a, data.c, data.mu, data.frame)
    }
}

#[cfg(feature = "serde")]
impl From<Quartic> for QuarticData {
    fn from(surface: Quartic) -> Self {
        let Quartic {
            a,
            c,
            mu,
            eccentricity,
            frame,
            ..
        } = surface;
        Self {
            a,
            c,
            mu,
            eccentricity,
            frame,
        }
    }
}
