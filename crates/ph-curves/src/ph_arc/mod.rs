//! The complex form of a rational Pythagorean-hodograph arc: two spinors and a support polynomial.

mod measure;
mod motion;
mod radius;

use bezier_mass::{BezierCurve, bernstein};
use glam::{DVec2, DVec3};

use crate::Error;
use crate::complex::{conj, square};
use crate::dual::rational_curve;

/// How far outside `[0, 1]` the parameter of an end normal may fall by rounding.
const PARAMETER_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A rational PH arc of class `N - 1`: unit normal `w^2/|w|^2` with `w = (1-t) w0 + t w1`, and
/// support `p = g/|w|^2` with a real Bernstein polynomial `g` of degree `N - 1`.
///
/// The plane is read as complex numbers. Every quantity of the curve is rational in `t`:
///
/// | quantity | formula, with `q = abs(w)^2`, `kappa = det(w0, w1)` |
/// |---|---|
/// | tangent line | `(-g, Re w^2, Im w^2)` |
/// | point | `i (g' w - 2 g w') / (2 kappa conj(w))` |
/// | radius of curvature | `(q g'' - q' g' + q'' g) / (4 kappa^2)`, a polynomial |
/// | offset by d | `g + d q` |
///
/// The normal is the right-hand one of the tangent `i N`; it turns by `2h`, `h = arg(w1/w0)` in
/// (-pi/2, pi/2). Where the turning and the radius have the same sign the curve travels along
/// `i N`, otherwise against it. `(w0, w1)` and `(-w0, -w1)` are the same arc.
///
/// The arc is a *front*, not only a curve: `g` is meaningful where the radius vanishes (cusps), and
/// the arc whose radius is zero everywhere is a point with a fan of normals.
///
/// Source: Pottmann's dual form `U = (-e(a^2+b^2), 2abf, (a^2-b^2)f)` with f = 1, `w = e^{i pi/4}(a - ib)`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "StoredArc", into = "StoredArc"))]
pub struct PhArc<const N: usize> {
    w0: DVec2,
    w1: DVec2,
    g: [f64; N],
}

/// A rational PH arc of class 3, Tschirnhausen's quartic: strictly monotone curvature, offsets of the
/// same kind, the involute of a Tschirnhausen cubic.
pub type TQuartic = PhArc<4>;

/// One point of an arc or dual curve with its line of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact {
    /// The point of the curve.
    pub point: DVec2,
    /// Unit normal; the tangent is this turned by +90 degrees.
    pub normal: DVec2,
    /// Distance of the tangent line from the origin, along the normal.
    pub support: f64,
    /// Signed radius of curvature `p + p''`: the centre of curvature is `point - radius * normal`.
    pub radius: f64,
}

impl Contact {
    /// Centre of curvature, a point of the evolute.
    #[must_use]
    pub fn centre(&self) -> DVec2 {
        self.point - self.radius * self.normal
    }
}

impl<const N: usize> PhArc<N> {
    /// The class, `N - 1`.
    pub const CLASS: usize = N.saturating_sub(1);

    /// The arc with spinors `w0`, `w1` and support coefficients `g`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::Pencil`] below class 2; [`Error::ZeroDirection`] if a spinor is
    /// zero; [`Error::NoTurning`] if they are parallel; [`Error::TurningTooLarge`] if the angle
    /// between them is a right angle or more (the normal then turns by pi or more).
    pub fn new(w0: DVec2, w1: DVec2, g: [f64; N]) -> Result<Self, Error> {
        if !(w0.is_finite() && w1.is_finite() && g.iter().all(|c| c.is_finite())) {
            return Err(Error::NonFinite {
                what: "a coefficient of an arc",
            });
        }
        if N < 3 {
            return Err(Error::Pencil { class: Self::CLASS });
        }
        if w0 == DVec2::ZERO || w1 == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "an end spinor of an arc",
            });
        }
        let turning = 2.0 * w0.perp_dot(w1).atan2(w0.dot(w1));
        if w0.dot(w1) <= 0.0 {
            return Err(Error::TurningTooLarge { turning });
        }
        if w0.perp_dot(w1) == 0.0 {
            return Err(Error::NoTurning { turning });
        }
        Ok(Self { w0, w1, g })
    }

    /// The arc without the checks of [`PhArc::new`], for values known to satisfy them.
    pub(crate) const fn from_parts(w0: DVec2, w1: DVec2, g: [f64; N]) -> Self {
        Self { w0, w1, g }
    }

    /// The spinors `(w0, w1)`.
    #[must_use]
    pub const fn spinors(&self) -> (DVec2, DVec2) {
        (self.w0, self.w1)
    }

    /// Bernstein coefficients of the support numerator `g`.
    #[must_use]
    pub const fn coefficients(&self) -> &[f64; N] {
        &self.g
    }

    /// `|w0| / |w1|`, the shape parameter of the parametrisation.
    #[must_use]
    pub fn alpha(&self) -> f64 {
        self.w0.length() / self.w1.length()
    }

    /// Signed turning angle `2h` of the normal from start to end, in (-pi, pi).
    #[must_use]
    pub fn turning(&self) -> f64 {
        2.0 * self.kappa().atan2(self.w0.dot(self.w1))
    }

    /// `det(w0, w1)`: its sign is the sense of turning.
    fn kappa(&self) -> f64 {
        self.w0.perp_dot(self.w1)
    }

    /// Bernstein coefficients of `q = |w|^2`, the length of the polynomial normal.
    fn normal_length(&self) -> [f64; 3] {
        [
            self.w0.length_squared(),
            self.w0.dot(self.w1),
            self.w1.length_squared(),
        ]
    }

    /// Bernstein coefficients of the polynomial normal `w^2`.
    fn normal_polynomial(&self) -> [DVec2; 3] {
        [square(self.w0), self.w0.rotate(self.w1), square(self.w1)]
    }

    fn spinor(&self, t: f64) -> DVec2 {
        self.w0 * (1.0 - t) + self.w1 * t
    }

    /// `g`, `g'` and `g''` at `t`, from the last three values of de Casteljau's scheme.
    fn support_jet(&self, t: f64) -> [f64; 3] {
        let last = N.saturating_sub(3);
        // The ends are asked for most often.
        let [a, b, c] = if t == 0.0 {
            [self.g[0], self.g[1], self.g[2]]
        } else if t == 1.0 {
            [self.g[last], self.g[last + 1], self.g[last + 2]]
        } else {
            let mut row = self.g;
            for level in 0..last {
                for k in 0..N - 1 - level {
                    row[k] += t * (row[k + 1] - row[k]);
                }
            }
            [row[0], row[1], row[2]]
        };
        let m = Self::CLASS as f64;
        let (d0, d1) = (b - a, c - b);
        let (a, b) = (a + t * d0, b + t * d1);
        [a + t * (b - a), m * (b - a), m * (m - 1.0) * (d1 - d0)]
    }

    /// Unit normal at `t`.
    #[must_use]
    pub fn normal(&self, t: f64) -> DVec2 {
        let w = self.spinor(t);
        square(w) / w.length_squared()
    }

    /// Support `p`: distance of the tangent line from the origin along the normal.
    #[must_use]
    pub fn support(&self, t: f64) -> f64 {
        self.support_jet(t)[0] / self.spinor(t).length_squared()
    }

    /// Point of contact of the tangent line at `t`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        let w = self.spinor(t);
        let [g, dg, _] = self.support_jet(t);
        let numerator = dg * w - 2.0 * g * (self.w1 - self.w0);
        // i z / conj(w) = i z w / |w|^2
        w.rotate(numerator).perp() / (2.0 * self.kappa() * w.length_squared())
    }

    /// Derivative of the point by `t`: `R (d psi/dt) i N`.
    #[must_use]
    pub fn velocity(&self, t: f64) -> DVec2 {
        self.normal(t).perp() * (self.radius(t) * self.turning_rate(t))
    }

    /// Derivative of the normal's angle by `t`: `2 kappa / |w|^2`.
    #[must_use]
    pub fn turning_rate(&self, t: f64) -> f64 {
        2.0 * self.kappa() / self.spinor(t).length_squared()
    }

    /// An upper bound of the absolute turning rate: `|w|` is at least the distance of the line through both spinors from zero.
    pub(crate) fn most_turning_rate(&self) -> f64 {
        2.0 * (self.w1 - self.w0).length_squared() / self.kappa().abs()
    }

    /// Point, normal, support and radius at `t`.
    #[must_use]
    pub fn contact(&self, t: f64) -> Contact {
        Contact {
            point: self.point(t),
            normal: self.normal(t),
            support: self.support(t),
            radius: self.radius(t),
        }
    }

    /// The parameter at which the unit normal is `normal`, in `[0, 1]`, or none if that normal does
    /// not occur on the arc.
    #[must_use]
    pub fn parameter_of_normal(&self, normal: DVec2) -> Option<f64> {
        let t = self.parameter_beyond(normal);
        let inside = (-PARAMETER_ROUNDING..=1.0 + PARAMETER_ROUNDING).contains(&t);
        inside.then_some(t.clamp(0.0, 1.0))
    }

    /// The parameter of a normal that lies within a half turn of the start normal, also outside `[0, 1]`.
    pub(crate) fn parameter_beyond(&self, normal: DVec2) -> f64 {
        // The spinor of the normal bisects it and the real axis; in the frame of the start normal it
        // is never close to zero.
        let start = square(self.w0) / self.w0.length_squared();
        let spinor = self.w0.rotate(DVec2::X + conj(start).rotate(normal));
        let (past_start, before_end) = (self.w0.perp_dot(spinor), spinor.perp_dot(self.w1));
        past_start / (past_start + before_end)
    }

    /// The parallel arc at signed distance `distance` along the normal; exact. A distance that is not finite, or an
    /// overflow, gives supports that are not finite.
    #[must_use]
    pub fn offset(&self, distance: f64) -> Self {
        let circle = self.circle_coefficients();
        let mut g = self.g;
        for (g, c) in g.iter_mut().zip(circle) {
            *g += distance * c;
        }
        Self { g, ..*self }
    }

    /// Coefficients of the concentric unit circle with the same normals: `q` raised to degree `N - 1`.
    #[must_use]
    pub fn circle_coefficients(&self) -> [f64; N] {
        let [q0, q1, q2] = self.normal_length();
        Self::raise_quadratic(|a, b, c| a * q0 + b * q1 + c * q2)
    }

    /// Degree elevation of a quadratic; `sum` adds its three coefficients with the given weights.
    fn raise_quadratic<T>(sum: impl Fn(f64, f64, f64) -> T) -> [T; N] {
        let m = Self::CLASS as f64;
        let total = m * (m - 1.0);
        std::array::from_fn(|k| {
            let (a, b) = (m - k as f64, k as f64);
            sum(
                a * (a - 1.0) / total,
                2.0 * a * b / total,
                b * (b - 1.0) / total,
            )
        })
    }

    /// Bernstein coefficients of the polynomial normal `w^2`, raised to degree `N - 1`: the normals of
    /// the Bézier lines.
    #[must_use]
    pub fn control_normals(&self) -> [DVec2; N] {
        let [n0, n1, n2] = self.normal_polynomial();
        Self::raise_quadratic(|a, b, c| a * n0 + b * n1 + c * n2)
    }

    /// The Bézier lines `(-g_i, n_i)` of the dual form. They lie on finite or infinite lines; a zero
    /// vector cannot occur at the ends.
    #[must_use]
    pub fn control_vectors(&self) -> [DVec3; N] {
        let normals = self.control_normals();
        std::array::from_fn(|k| DVec3::new(-self.g[k], normals[k].x, normals[k].y))
    }

    /// How far each Bézier line moves along its normal in the offset at distance 1: the signed distance of
    /// the unit circle's line from its centre, `c_i / |n_i|` (infinite for a control line at infinity).
    #[must_use]
    pub fn control_distances(&self) -> [f64; N] {
        let (circle, normals) = (self.circle_coefficients(), self.control_normals());
        std::array::from_fn(|k| circle[k] / normals[k].length())
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point form, of degree `N`: weights are those
    /// of `2 kappa q`, so they are all negative for negative turning. [`TQuartic::quartic`] is the same
    /// for class 3, without allocation.
    #[must_use]
    pub fn point_control(&self) -> Vec<DVec3> {
        let w = [self.w0, self.w1];
        let dw = self.w1 - self.w0;
        // 2 kappa conj(w) C = i (g' w - 2 g w'), and times w to make the denominator real.
        let inner: Vec<DVec2> =
            bernstein::product_with(&bernstein::derivative(&self.g), &w, |g, w| *w * *g)
                .iter()
                .zip(&self.g)
                .map(|(a, g)| *a - 2.0 * *g * dw)
                .collect();
        let numerator = bernstein::product_with(&w, &inner, |w, z| w.rotate(*z).perp());
        let weights = bernstein::elevate_to(&self.normal_length(), N);
        let scale = 2.0 * self.kappa();
        numerator
            .iter()
            .zip(weights)
            .map(|(x, q)| DVec3::new(scale * q, x.x, x.y))
            .collect()
    }

    /// The exact rational point curve of degree `N`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the coefficients overflow.
    pub fn to_points(&self) -> Result<BezierCurve<DVec2>, Error> {
        rational_curve(&self.point_control())
    }
}

/// The form in which an arc is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredArc {
    w0: DVec2,
    w1: DVec2,
    g: Vec<f64>,
}

#[cfg(feature = "serde")]
impl<const N: usize> From<PhArc<N>> for StoredArc {
    fn from(arc: PhArc<N>) -> Self {
        Self {
            w0: arc.w0,
            w1: arc.w1,
            g: arc.g.to_vec(),
        }
    }
}

#[cfg(feature = "serde")]
impl<const N: usize> TryFrom<StoredArc> for PhArc<N> {
    type Error = Error;

    fn try_from(stored: StoredArc) -> Result<Self, Error> {
        let given = stored.g.len();
        let g = stored.g.try_into().map_err(|_| Error::TooFew {
            what: "support coefficients",
            given,
            needed: N,
        })?;
        Self::new(stored.w0, stored.w1, g)
    }
}

#[cfg(test)]
mod tests;
