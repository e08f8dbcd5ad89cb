//! The parabolic cyclides: cubic surfaces that pass through infinity and contain two straight lines.

use crate::CurvatureCircle;
use crate::frame::{length, size};
use crate::{Error, Frame, Kind, tolerance};
use glam::DVec3;

/// A parabolic (cubic) Dupin cyclide: focal parameter `f > 0`, offset `k`, and a rigid frame.
///
/// Its tangent spheres have their centres on two confocal parabolas: `(f (u² - 1/2), 2 f u, 0)` with signed radius
/// `f (u² + 1/2) + k`, and `(f (1/2 - v²), 0, 2 f v)` with `k - f (v² + 1/2)`. The lines `u = infinity` and
/// `v = infinity` are its two axes. As on the quartics `P = centre + radius N`.
///
/// The implicit polynomial is `(x - k) ((x + k)² - f²) + y² (x + k + f) + z² (x + k - f)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "ParabolicData", into = "ParabolicData")
)]
pub struct Parabolic {
    f: f64,
    k: f64,
    frame: Frame,
}

impl Parabolic {
    /// The parabolic cyclide with focal parameter `f > 0` and offset `k` of either sign.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::LengthOutOfRange`]; [`Error::FocalParameter`] unless `f > 0`.
    pub fn new(f: f64, k: f64, frame: Frame) -> Result<Self, Error> {
        size("f", f)?;
        length("k", k)?;
        if f <= 0.0 {
            return Err(Error::FocalParameter { f });
        }
        Ok(Self { f, k, frame })
    }

    /// Focal parameter: half the distance of the two straight lines on the surface.
    #[must_use]
    pub const fn f(&self) -> f64 {
        self.f
    }

    /// Offset from the symmetric surface `k = 0`.
    #[must_use]
    pub const fn k(&self) -> f64 {
        self.k
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
        Kind::of_parabolic(self.f, self.k, tolerance)
    }

    /// The same shape in another frame.
    #[must_use]
    pub const fn in_frame(self, frame: Frame) -> Self {
        Self { frame, ..self }
    }

    /// All lengths multiplied by a positive factor, in the given frame.
    pub(crate) fn scaled_in(self, factor: f64, frame: Frame) -> Result<Self, Error> {
        Self::new(self.f * factor, self.k * factor, frame)
    }

    /// The same point set with `k >= 0`. For `k < 0` the symmetry `(x, y, z, k) -> (-x, z, y, -k)` turns the frame,
    /// exchanges the parameters `u` and `v`, and reverses the normal.
    #[must_use]
    pub fn canonical(&self) -> Self {
        if self.k >= 0.0 {
            return *self;
        }
        let turned = Frame::from_directions(self.frame.origin(), -self.frame.x(), self.frame.z());
        Self {
            f: self.f,
            k: -self.k,
            frame: turned.unwrap_or(self.frame),
        }
    }

    /// The parallel surface at signed distance `distance` along the normal: `k` grows by it, parameters stay.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`].
    pub fn offset(&self, distance: f64) -> Result<Self, Error> {
        Self::new(self.f, self.k + distance, self.frame)
    }

    /// Signed radius of the tangent sphere along `u = const`.
    pub(crate) fn u_radius(&self, u: f64) -> f64 {
        self.f * (u * u + 0.5) + self.k
    }

    /// Signed radius of the tangent sphere along `v = const`.
    pub(crate) fn v_radius(&self, v: f64) -> f64 {
        self.k - self.f * (v * v + 0.5)
    }

    /// The point at `(u, v)`, world coordinates.
    #[must_use]
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        let (f, k) = (self.f, self.k);
        let local = DVec3::new(
            f * (u * u - v * v) + k * (1.0 - u * u - v * v),
            2.0 * u * (f * (v * v + 0.5) - k),
            2.0 * v * (f * (u * u + 0.5) + k),
        );
        self.frame.point_to_world(local / (1.0 + u * u + v * v))
    }

    /// The unit normal at `(u, v)`, world coordinates; defined at singular points too.
    #[must_use]
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        self.frame.vector_to_world(Self::local_normal(u, v))
    }

    fn local_normal(u: f64, v: f64) -> DVec3 {
        DVec3::new(1.0 - u * u - v * v, -2.0 * u, 2.0 * v) / (1.0 + u * u + v * v)
    }

    /// Unit tangents of the two lines of curvature through `(u, v)`: along growing `u` (where `f (v² + 1/2) > k`) and
    /// along growing `v` (where `f (u² + 1/2) > -k`); both on a ring.
    #[must_use]
    pub fn principal_directions(&self, u: f64, v: f64) -> [DVec3; 2] {
        let normal = Self::local_normal(u, v);
        let along_u = DVec3::new(u, 1.0, 0.0) + u * normal;
        let along_v = DVec3::new(-v, 0.0, 1.0) - v * normal;
        [
            self.frame.vector_to_world(along_u),
            self.frame.vector_to_world(along_v),
        ]
    }

    /// The derivatives of [`Parabolic::point`] by `u` and `v`.
    #[must_use]
    pub fn partials(&self, u: f64, v: f64) -> [DVec3; 2] {
        let [along_u, along_v] = self.principal_directions(u, v);
        let scale = 2.0 / (1.0 + u * u + v * v);
        [
            -scale * self.v_radius(v) * along_u,
            scale * self.u_radius(u) * along_v,
        ]
    }

    /// Principal curvatures along `u` and along `v`, with `dN = kappa dP`. Infinite where the tangent sphere is a point.
    #[must_use]
    pub fn principal_curvatures(&self, u: f64, v: f64) -> [f64; 2] {
        [1.0 / self.v_radius(v), 1.0 / self.u_radius(u)]
    }

    /// The cubic polynomial at a world point; zero on the surface. Its unit is (length)³.
    #[must_use]
    pub fn implicit(&self, point: DVec3) -> f64 {
        let p = self.frame.point_to_local(point);
        let (f, k) = (self.f, self.k);
        (p.x - k) * (p.x + k - f) * (p.x + k + f)
            + p.y * p.y * (p.x + k + f)
            + p.z * p.z * (p.x + k - f)
    }

    /// Gradient of [`Parabolic::implicit`], world coordinates.
    #[must_use]
    pub fn gradient(&self, point: DVec3) -> DVec3 {
        self.frame
            .vector_to_world(self.local_gradient(self.frame.point_to_local(point), self.k))
    }

    /// Gradient of the polynomial of the parallel surface with offset `k`.
    pub(crate) fn local_gradient(&self, p: DVec3, k: f64) -> DVec3 {
        let (near, far) = (p.x + k - self.f, p.x + k + self.f);
        let along_x = near * far + 2.0 * (p.x - k) * (p.x + k) + p.y * p.y + p.z * p.z;
        DVec3::new(along_x, 2.0 * p.y * far, 2.0 * p.z * near)
    }

    /// The parameters `[u, v]` of a point of the surface, from the two pencils of planes. Infinite on the axes.
    #[must_use]
    pub fn parameters_at(&self, point: DVec3) -> [f64; 2] {
        let p = self.frame.point_to_local(point);
        // All planes of a pencil pass through its axis, which is the line of the infinite parameter.
        let parameter = |side: f64, height: f64| {
            if side == 0.0 && height == 0.0 {
                f64::INFINITY
            } else {
                side / height
            }
        };
        [
            parameter(-p.y, p.x - self.f + self.k),
            parameter(p.z, p.x + self.f + self.k),
        ]
    }

    /// The real singular points, world coordinates: none, one or two.
    #[must_use]
    pub fn singular_points(&self) -> Vec<DVec3> {
        let (f, k) = (self.f, self.k);
        let local = match self.kind() {
            Kind::ParabolicOneSingularity if k > 0.0 => vec![DVec3::X * (f - k)],
            Kind::ParabolicOneSingularity => vec![DVec3::X * (-f - k)],
            Kind::ParabolicTwoSingularities if k > 0.0 => {
                let height = DVec3::Z * (2.0 * (f * (k - f / 2.0)).sqrt());
                vec![DVec3::X * (f - k) + height, DVec3::X * (f - k) - height]
            }
            Kind::ParabolicTwoSingularities => {
                let height = DVec3::Y * (2.0 * (f * (-k - f / 2.0)).sqrt());
                vec![DVec3::X * (-f - k) + height, DVec3::X * (-f - k) - height]
            }
            _ => Vec::new(),
        };
        local
            .into_iter()
            .map(|point| self.frame.point_to_world(point))
            .collect()
    }

    /// The line of curvature `u = const`, a circle for finite `u`.
    #[must_use]
    pub fn u_circle(&self, u: f64) -> CurvatureCircle {
        let (radius, stretch) = (self.u_radius(u), 1.0 + u * u);
        let sphere_centre = DVec3::new(self.f * (u * u - 0.5), 2.0 * self.f * u, 0.0);
        let centre = sphere_centre - radius * u / stretch * DVec3::new(u, 1.0, 0.0);
        self.circle(
            centre,
            radius.abs() / stretch.sqrt(),
            DVec3::new(u, 1.0, 0.0) / stretch.sqrt(),
        )
    }

    /// The line of curvature `v = const`, a circle for finite `v`.
    #[must_use]
    pub fn v_circle(&self, v: f64) -> CurvatureCircle {
        let (radius, stretch) = (self.v_radius(v), 1.0 + v * v);
        let sphere_centre = DVec3::new(self.f * (0.5 - v * v), 0.0, 2.0 * self.f * v);
        let centre = sphere_centre + radius * v / stretch * DVec3::new(-v, 0.0, 1.0);
        self.circle(
            centre,
            radius.abs() / stretch.sqrt(),
            DVec3::new(-v, 0.0, 1.0) / stretch.sqrt(),
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
struct ParabolicData {
    f: f64,
    k: f64,
    frame: Frame,
}

#[cfg(feature = "serde")]
impl TryFrom<ParabolicData> for Parabolic {
    type Error = Error;

    fn try_from(data: ParabolicData) -> Result<Self, Error> {
        Self::new(data.f, data.k, data.frame)
    }
}

#[cfg(feature = "serde")]
impl From<Parabolic> for ParabolicData {
    fn from(surface: Parabolic) -> Self {
        let Parabolic { f, k, frame } = surface;
        Self { f, k, frame }
    }
}
