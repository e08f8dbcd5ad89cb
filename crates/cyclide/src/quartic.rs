//! The quartic cyclides: ring, horned, spindle, the three tori, and the sphere counted twice.

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

/// One point of the parametrisation: cosines, sines and the common denominator, all divided by `a`.
#[derive(Clone, Copy, Debug)]
struct Angles {
    cos_theta: f64,
    sin_theta: f64,
    cos_psi: f64,
    sin_psi: f64,
    /// `cos theta cos psi`
    product: f64,
    /// `1 - e cos theta cos psi`, positive for `c < a`
    denominator: f64,
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
        for (what, value) in [("a", a), ("b", b), ("c", c), ("mu", mu)] {
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
    pub(crate) fn scaled_in(self, factor: f64, frame: Frame) -> Self {
        Self {
            a: self.a * factor,
            b: self.b * factor,
            c: self.c * factor,
            mu: self.mu * factor,
            frame,
            ..self
        }
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

    fn angles(&self, theta: f64, psi: f64) -> Angles {
        let (sin_theta, cos_theta) = theta.sin_cos();
        let (sin_psi, cos_psi) = psi.sin_cos();
        let product = cos_theta * cos_psi;
        Angles {
            cos_theta,
            sin_theta,
            cos_psi,
            sin_psi,
            product,
            denominator: 1.0 - self.eccentricity * product,
        }
    }

    /// The point at `(theta, psi)`, both with period `2 pi`; world coordinates.
    #[must_use]
    pub fn point(&self, theta: f64, psi: f64) -> DVec3 {
        let at = self.angles(theta, psi);
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let local = DVec3::new(
            self.mu * (e - at.product) + self.b * q * at.cos_theta,
            q * at.sin_theta * (self.a - self.mu * at.cos_psi),
            q * at.sin_psi * (self.c * at.cos_theta - self.mu),
        );
        self.frame.point_to_world(local / at.denominator)
    }

    /// The unit normal at `(theta, psi)`, defined at singular points too (as the normal of the parametrisation).
    #[must_use]
    pub fn normal(&self, theta: f64, psi: f64) -> DVec3 {
        self.frame
            .vector_to_world(self.local_normal(&self.angles(theta, psi)))
    }

    fn local_normal(&self, at: &Angles) -> DVec3 {
        let (e, q) = (self.eccentricity, self.minor_ratio);
        DVec3::new(
            e - at.product,
            -q * at.sin_theta * at.cos_psi,
            -q * at.sin_psi,
        ) / at.denominator
    }

    /// Unit tangents of the two lines of curvature through `(theta, psi)`: first along growing `theta` (where
    /// `a > mu cos psi`), then along growing `psi` (where `mu > c cos theta`); both on a ring. They are defined at
    /// singular points too.
    #[must_use]
    pub fn principal_directions(&self, theta: f64, psi: f64) -> [DVec3; 2] {
        let at = self.angles(theta, psi);
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let numerator = self.local_normal(&at) * at.denominator;
        // N_theta / cos psi and N_psi, each of length q / denominator.
        let along_theta = DVec3::new(at.sin_theta, -q * at.cos_theta, 0.0) * at.denominator
            - e * at.sin_theta * numerator;
        let along_psi = DVec3::new(
            at.cos_theta * at.sin_psi,
            q * at.sin_theta * at.sin_psi,
            -q * at.cos_psi,
        ) * at.denominator
            - e * at.cos_theta * at.sin_psi * numerator;
        let scale = 1.0 / (q * at.denominator);
        [
            -scale * self.frame.vector_to_world(along_theta),
            scale * self.frame.vector_to_world(along_psi),
        ]
    }

    /// The derivatives of [`Quartic::point`] by `theta` and `psi`.
    #[must_use]
    pub fn partials(&self, theta: f64, psi: f64) -> [DVec3; 2] {
        let [along_theta, along_psi] = self.principal_directions(theta, psi);
        let at = self.angles(theta, psi);
        let scale = self.minor_ratio / at.denominator;
        [
            scale * (self.a - self.mu * at.cos_psi) * along_theta,
            scale * (self.mu - self.c * at.cos_theta) * along_psi,
        ]
    }

    /// Principal curvatures along `theta` and along `psi`, with `dN = kappa dP`: positive where the surface bends away
    /// from the normal. Infinite where the tangent sphere is a point.
    #[must_use]
    pub fn principal_curvatures(&self, theta: f64, psi: f64) -> [f64; 2] {
        [
            psi.cos() / (self.mu * psi.cos() - self.a),
            1.0 / (self.mu - self.c * theta.cos()),
        ]
    }

    /// Both printed forms of the implicit polynomial at a world point: (3) and (4) of the biquadratic paper. They are the
    /// same polynomial, so the two values differ by rounding alone.
    #[must_use]
    pub fn implicit_forms(&self, point: DVec3) -> [f64; 2] {
        let p = self.frame.point_to_local(point);
        let (a, b, c, mu) = (self.a, self.b, self.c, self.mu);
        let square = p.length_squared() - mu * mu;
        let (first, second) = (square + b * b, square - b * b);
        let (along_a, along_c) = (a * p.x - c * mu, c * p.x - a * mu);
        [
            first * first - 4.0 * (along_a * along_a + b * b * p.y * p.y),
            second * second - 4.0 * (along_c * along_c - b * b * p.z * p.z),
        ]
    }

    /// The implicit polynomial at a world point; zero on the surface. Its degree is 4 and its unit (length)⁴.
    #[must_use]
    pub fn implicit(&self, point: DVec3) -> f64 {
        self.implicit_forms(point)[0]
    }

    /// Gradient of [`Quartic::implicit`], world coordinates. It vanishes at singular points, and on the double sphere.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        self.frame
            .vector_to_world(self.local_gradient(self.frame.point_to_local(point), self.mu))
    }

    /// Gradient of the polynomial of the parallel surface with mean radius `mu`.
    pub(crate) fn local_gradient(&self, p: DVec3, mu: f64) -> DVec3 {
        let square = p.length_squared() - mu * mu + self.b * self.b;
        4.0 * square * p
            - DVec3::new(
                8.0 * self.a * (self.a * p.x - self.c * mu),
                8.0 * self.b * self.b * p.y,
                0.0,
            )
    }

    /// The parameters `[theta, psi]`, each in `(-pi, pi]`, of a point of the surface. For a point beside the surface the
    /// result belongs to some point near it; project with [`crate::Dupin::closest`] first where that matters.
    ///
    /// Closed form from `S = 2 b² (a - mu cos psi) / D` and `T = 2 b² cos psi (c cos theta - mu) / D`, the two squares
    /// inside the printed equations; nothing is iterated.
    #[must_use]
    pub fn parameters_at(&self, point: DVec3) -> [f64; 2] {
        let p = self.frame.point_to_local(point);
        if self.a == 0.0 {
            return self.parameters_of_normal(p / p.length());
        }
        let (a, b, c, mu) = (self.a, self.b, self.c, self.mu);
        let square = p.length_squared() - mu * mu;
        let theta_sign = (square + b * b).signum();
        let theta = (theta_sign * b * p.y).atan2(theta_sign * (a * p.x - c * mu));
        let lever = c * p.x - a * mu;
        let psi_sign = lever.signum();
        let psi = (psi_sign * 2.0 * b * p.z).atan2(psi_sign * (square - b * b));
        [theta, psi]
    }

    /// One of the two parameter pairs with the given local unit normal, that with `cos psi >= 0`; the other is
    /// `(theta + pi, pi - psi)`. The inverse of the Gauss map.
    pub(crate) fn parameters_of_normal(&self, normal: DVec3) -> [f64; 2] {
        let (e, q) = (self.eccentricity, self.minor_ratio);
        let denominator = 1.0 - e * normal.x;
        let product = (e - normal.x) / denominator;
        let cos_psi_sin_theta = -q * normal.y / denominator;
        let sin_psi = -q * normal.z / denominator;
        [
            cos_psi_sin_theta.atan2(product),
            sin_psi.atan2(product.hypot(cos_psi_sin_theta)),
        ]
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
