//! Distance and closest point, exact: a point lies on four (three) surfaces parallel to a given one.

use crate::frame::place;
use crate::{Dupin, Error, Parabolic, Quartic};
use glam::DVec3;

/// The closest point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Closest {
    /// The point on the surface, world coordinates.
    pub point: DVec3,
    /// The surface's unit normal there.
    pub normal: DVec3,
    /// Signed distance: the query is `point + distance * normal`. On a ring it is negative inside the tube.
    pub distance: f64,
}

/// Below this share of its natural size the gradient of a parallel surface is that of a singular point: its direction would keep
/// fewer than eight digits, and the point itself is nearer than that to the conic of centres.
const SINGULAR_GRADIENT: f64 = 1e-8;

impl Quartic {
    /// The mean radii, ascending, of the four surfaces parallel to this one that pass through a point.
    ///
    /// All four are real. They are separated by `-s`, `c x / a` and `s` with `s² = |q|² + b²` (local coordinates), so each is found by
    /// a Newton iteration that cannot leave its bracket.
    #[must_use]
    pub fn offset_roots(&self, point: DVec3) -> [f64; 4] {
        self.local_offset_roots(self.frame().point_to_local(point))
    }

    fn local_offset_roots(&self, q: DVec3) -> [f64; 4] {
        if self.a() == 0.0 {
            let radius = q.length();
            return [-radius, -radius, radius, radius];
        }
        let (a, b, c) = (self.a(), self.b(), self.c());
        let square = q.length_squared() + b * b;
        // F(q; M) as a difference of two squares, and its derivative by M.
        let parallel = |radius: f64| {
            let sum = square - radius * radius;
            let lever = a * q.x - c * radius;
            let span = 2.0 * lever.hypot(b * q.y);
            (
                (sum - span) * (sum + span),
                8.0 * c * lever - 4.0 * radius * sum,
            )
        };
        let inner = square.sqrt();
        let middle = (self.eccentricity() * q.x).clamp(-inner, inner);
        let outer = (q.length() + a + c).max(inner);
        [
            root_between(parallel, -outer, -inner, false),
            root_between(parallel, -inner, middle, true),
            root_between(parallel, middle, inner, false),
            root_between(parallel, inner, outer, true),
        ]
    }

    fn local_closest(&self, q: DVec3) -> Closest {
        let mu = self.mu();
        if self.a() == 0.0 {
            let normal = q.try_normalize().unwrap_or(DVec3::X);
            return Closest {
                point: mu * normal,
                normal,
                distance: q.length() - mu,
            };
        }
        let roots = self.local_offset_roots(q);
        let mut index = 0;
        for (candidate, root) in roots.iter().enumerate() {
            if (root - mu).abs() < (roots[index] - mu).abs() {
                index = candidate;
            }
        }
        let root = roots[index];
        let gradient = self.local_gradient(q, root);
        let size = q.length() + self.a() + root.abs();
        let normal = if gradient.length() > SINGULAR_GRADIENT * size.powi(3) {
            // The gradient of the product of (mu - M_i) points along N for the first and third root only.
            gradient.normalize() * if index % 2 == 0 { 1.0 } else { -1.0 }
        } else if root.abs() < self.c() {
            // q is a centre on the ellipse: any normal of the tangent cone of that singular point.
            let theta = (q.y / self.b()).atan2(q.x / self.a());
            self.frame().vector_to_local(self.normal(theta, 0.0))
        } else {
            let psi = (-q.z / self.b() * root.signum()).atan2(root.signum());
            self.frame().vector_to_local(self.normal(0.0, psi))
        };
        Closest {
            point: q - (root - mu) * normal,
            normal,
            distance: root - mu,
        }
    }
}

impl Parabolic {
    /// The offsets `k`, ascending, of the three surfaces parallel to this one that pass through a point. All are real, separated by
    /// `-f - x` and `f - x` (local coordinates).
    #[must_use]
    pub fn offset_roots(&self, point: DVec3) -> [f64; 3] {
        self.local_offset_roots(self.frame().point_to_local(point))
    }

    fn local_offset_roots(&self, q: DVec3) -> [f64; 3] {
        let f = self.f();
        let (y, z) = (q.y * q.y, q.z * q.z);
        let parallel = |k: f64| {
            let (near, far) = (q.x + k - f, q.x + k + f);
            (
                (q.x - k) * near * far + y * far + z * near,
                (q.x - k) * (near + far) - near * far + y + z,
            )
        };
        // Fujiwara's bound for k³ + x k² - (x² + f² + y² + z²) k - ...
        let linear = q.length_squared() + f * f;
        let constant = (q.x * (q.x - f) * (q.x + f) + y * (q.x + f) + z * (q.x - f)).abs();
        let outer = 2.0 * q.x.abs().max(linear.sqrt()).max(constant.cbrt()) + f;
        [
            root_between(parallel, -outer.max(f + q.x), -f - q.x, false),
            root_between(parallel, -f - q.x, f - q.x, true),
            root_between(parallel, f - q.x, outer.max(f - q.x), false),
        ]
    }

    fn local_closest(&self, q: DVec3) -> Closest {
        let roots = self.local_offset_roots(q);
        let mut index = 0;
        for (candidate, root) in roots.iter().enumerate() {
            if (root - self.k()).abs() < (roots[index] - self.k()).abs() {
                index = candidate;
            }
        }
        let root = roots[index];
        let gradient = self.local_gradient(q, root);
        let size = q.length() + self.f() + root.abs();
        let normal = if gradient.length() > SINGULAR_GRADIENT * size.powi(2) {
            gradient.normalize() * if index == 1 { -1.0 } else { 1.0 }
        } else if root < 0.0 {
            self.frame()
                .vector_to_local(self.normal(q.y / (2.0 * self.f()), 0.0))
        } else {
            self.frame()
                .vector_to_local(self.normal(0.0, q.z / (2.0 * self.f())))
        };
        Closest {
            point: q - (root - self.k()) * normal,
            normal,
            distance: root - self.k(),
        }
    }
}

impl Dupin {
    /// The closest point of the whole surface, with its normal and the signed distance. Where several are equally near, one of
    /// them.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`].
    ///
    /// # Examples
    ///
    /// ```
    /// use cyclide::{Dupin, Frame, glam::dvec3};
    /// let torus = Dupin::torus(3.0, 1.0, Frame::WORLD)?;
    /// let closest = torus.closest(dvec3(5.0, 0.0, 0.0))?;
    /// assert!((closest.distance - 1.0).abs() < 1e-14);
    /// assert!(closest.point.distance(dvec3(4.0, 0.0, 0.0)) < 1e-14);
    /// # Ok::<(), cyclide::Error>(())
    /// ```
    pub fn closest(&self, point: DVec3) -> Result<Closest, Error> {
        place("query point", point)?;
        let q = self.frame().point_to_local(point);
        let local = match self {
            Self::Quartic(surface) => surface.local_closest(q),
            Self::Parabolic(surface) => surface.local_closest(q),
        };
        Ok(Closest {
            point: self.frame().point_to_world(local.point),
            normal: self.frame().vector_to_world(local.normal),
            distance: local.distance,
        })
    }

    /// Signed distance of a point from the whole surface, along the nearest normal; see [`Dupin::closest`].
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`], [`Error::LengthOutOfRange`].
    pub fn signed_distance(&self, point: DVec3) -> Result<f64, Error> {
        Ok(self.closest(point)?.distance)
    }
}

/// Newton's method on a root whose bracket and sign pattern are known by a theorem: `rising` says that the function goes from
/// negative to positive. A double root at an end of the bracket is approached like any other. Nothing is isolated here;
/// polynomials with unknown roots go to the crate `variation`.
fn root_between(
    function: impl Fn(f64) -> (f64, f64),
    mut low: f64,
    mut high: f64,
    rising: bool,
) -> f64 {
    let mut x = 0.5 * (low + high);
    // Bisection alone needs 64 steps from any bracket of doubles that matters here; Newton takes about six.
    for _ in 0..96 {
        let (value, slope) = function(x);
        if value == 0.0 {
            return x;
        }
        if (value < 0.0) == rising {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        let next = if newton > low && newton < high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - x).abs() <= 2.0 * f64::EPSILON * x.abs()
            || high - low <= 2.0 * f64::EPSILON * high.abs().max(low.abs())
        {
            return next;
        }
        x = next;
    }
    x
}
