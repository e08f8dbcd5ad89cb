//! Arcs of class 3 (Tschirnhausen quartics) between two tangents, with their one shape parameter.

use bezier_mass::bernstein;
use glam::{DVec2, DVec3};

#[cfg(feature = "serde")]
use crate::complex::is_unit;
use crate::complex::{conj, sqrt, square};
use crate::{Error, TCubic, TQuartic};

/// Influence of alpha on the support, relative to the chord, that is mere rounding: fitting to it would
/// divide noise by noise, while any alpha serves.
const NEGLIGIBLE_INFLUENCE: f64 = 1e-14;
/// Relative distance kept from the ends of the interval of regular shapes, where an end radius vanishes.
const REGULAR_MARGIN: f64 = 1e-6;
/// Smallest shape parameter that clamping chooses; its inverse is the largest.
const LEAST_ALPHA: f64 = 1e-6;

/// A point with the unit normal of the curve there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "StoredElement", into = "StoredElement")
)]
pub struct LineElement {
    point: DVec2,
    normal: DVec2,
}

impl LineElement {
    /// The element at `point` with the direction of `normal`.
    ///
    /// # Errors
    /// [`Error::NonFinite`], or [`Error::ZeroDirection`] for a zero normal.
    pub fn new(point: DVec2, normal: DVec2) -> Result<Self, Error> {
        if !(point.is_finite() && normal.is_finite()) {
            return Err(Error::NonFinite {
                what: "a line element",
            });
        }
        let normal = normal
            .try_normalize()
            .ok_or(Error::ZeroDirection { what: "a normal" })?;
        Ok(Self { point, normal })
    }

    /// The element without checks; `normal` has unit length.
    pub(crate) const fn from_unit(point: DVec2, normal: DVec2) -> Self {
        Self { point, normal }
    }

    /// The point.
    #[must_use]
    pub const fn point(&self) -> DVec2 {
        self.point
    }

    /// The unit normal.
    #[must_use]
    pub const fn normal(&self) -> DVec2 {
        self.normal
    }
}

/// The form in which a line element is serialized.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct StoredElement {
    point: DVec2,
    normal: DVec2,
}

#[cfg(feature = "serde")]
impl From<LineElement> for StoredElement {
    fn from(LineElement { point, normal }: LineElement) -> Self {
        Self { point, normal }
    }
}

#[cfg(feature = "serde")]
impl TryFrom<StoredElement> for LineElement {
    type Error = Error;

    fn try_from(stored: StoredElement) -> Result<Self, Error> {
        let element = Self::new(stored.point, stored.normal)?;
        // A unit normal comes back as it was.
        Ok(if is_unit(stored.normal) {
            Self::from_unit(stored.point, stored.normal)
        } else {
            element
        })
    }
}

/// Two line elements to be joined by an arc of class 3: the data of the G1 problem.
///
/// Every positive `alpha` gives one arc. Its first two Bézier lines pass through the start point and its
/// last two through the end point, so only the weights are free.
///
/// ```
/// use ph_curves::{G1Ends, LineElement, glam::DVec2};
/// let start = LineElement::new(DVec2::new(2.0, 0.0), DVec2::X)?;
/// let end = LineElement::new(DVec2::new(0.0, 1.0), DVec2::Y)?;
/// let ends = G1Ends::new(start, end)?;
/// let arc = ends.arc(ends.clamp_alpha(1.0)?)?;
/// assert!((arc.point(1.0) - DVec2::Y).length() < 1e-15);
/// assert!(arc.end_radii().iter().all(|r| *r > 0.0));
/// # Ok::<(), ph_curves::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "[LineElement; 2]", into = "[LineElement; 2]")
)]
pub struct G1Ends {
    start: LineElement,
    end: LineElement,
    /// Unit spinors `z0`, `z1 = z0 e^{ih}`.
    spinors: (DVec2, DVec2),
    cos_h: f64,
    sin_h: f64,
    legs: (f64, f64),
}

impl TryFrom<[LineElement; 2]> for G1Ends {
    type Error = Error;

    fn try_from([start, end]: [LineElement; 2]) -> Result<Self, Error> {
        Self::new(start, end)
    }
}

impl From<G1Ends> for [LineElement; 2] {
    fn from(ends: G1Ends) -> Self {
        [ends.start, ends.end]
    }
}

impl G1Ends {
    /// The G1 problem between two line elements; the normal turns by the angle in (-pi, pi).
    ///
    /// # Errors
    /// [`Error::NoTurning`] for equal normals, [`Error::TurningTooLarge`] for opposite ones.
    pub fn new(start: LineElement, end: LineElement) -> Result<Self, Error> {
        // The unit spinor of the turning, cos h + i sin h, halves the angle between the normals; the
        // longer of the two forms of the bisector keeps its digits.
        let turn = conj(start.normal).rotate(end.normal);
        if turn.y == 0.0 {
            return Err(if turn.x > 0.0 {
                Error::NoTurning { turning: 0.0 }
            } else {
                Error::TurningTooLarge {
                    turning: std::f64::consts::PI,
                }
            });
        }
        let ends = Self::between(start, end);
        if !(ends.legs.0.is_finite() && ends.legs.1.is_finite()) {
            return Err(Error::NoTurning { turning: turn.y });
        }
        Ok(ends)
    }

    /// The G1 problem between elements known to turn by an angle in (-pi, pi) other than 0.
    pub(crate) fn between(start: LineElement, end: LineElement) -> Self {
        let turn = conj(start.normal).rotate(end.normal);
        let half = sqrt(turn).normalize();
        let z0 = sqrt(start.normal);
        let chord = end.point - start.point;
        // chord = leg0 T0 + leg1 T1 with the tangents T = i N, and <T0, N1> = sin 2h = -<T1, N0>.
        let legs = (
            chord.dot(end.normal) / turn.y,
            -chord.dot(start.normal) / turn.y,
        );
        Self {
            start,
            end,
            spinors: (z0, z0.rotate(half)),
            cos_h: half.x,
            sin_h: half.y,
            legs,
        }
    }

    /// Cosine and sine of half the turning.
    pub(crate) const fn half_turning(&self) -> (f64, f64) {
        (self.cos_h, self.sin_h)
    }

    /// Signed legs `(l0, l1)` of the tangent triangle: `P1 - P0 = l0 T0 + l1 T1`, `T = i N`.
    #[must_use]
    pub const fn legs(&self) -> (f64, f64) {
        self.legs
    }

    /// Signed turning angle `2h` of the normal.
    #[must_use]
    pub fn turning(&self) -> f64 {
        2.0 * self.sin_h.atan2(self.cos_h)
    }

    /// The arc with shape `alpha = |w0| / |w1|`.
    ///
    /// # Errors
    /// [`Error::NonPositiveAlpha`] unless `alpha` is positive and finite.
    pub fn arc(&self, alpha: f64) -> Result<TQuartic, Error> {
        if !(alpha > 0.0 && alpha.is_finite()) {
            return Err(Error::NonPositiveAlpha { alpha });
        }
        Ok(self.arc_of_positive(alpha))
    }

    pub(crate) fn arc_of_positive(&self, alpha: f64) -> TQuartic {
        let root = alpha.sqrt();
        let (w0, w1) = (self.spinors.0 * root, self.spinors.1 / root);
        let (p0, p1) = (self.start.point, self.end.point);
        let n = TQuartic::from_parts(w0, w1, [0.0; 4]).control_normals();
        TQuartic::from_parts(
            w0,
            w1,
            [n[0].dot(p0), n[1].dot(p0), n[2].dot(p1), n[3].dot(p1)],
        )
    }

    /// Signed radii at both ends of the arc with shape `alpha`.
    #[must_use]
    pub fn end_radii(&self, alpha: f64) -> [f64; 2] {
        let (l0, l1) = self.legs;
        [
            (l0 * self.cos_h + alpha * (l0 - l1)) / self.sin_h,
            (l1 * self.cos_h + (l1 - l0) / alpha) / self.sin_h,
        ]
    }

    /// The open interval of all `alpha` for which the arc is regular: both end radii, and with them all
    /// radii, have one sign. `f64::INFINITY` stands for no upper bound.
    ///
    /// # Errors
    /// [`Error::NoRegularArc`] if the legs are not both positive or both negative: every arc between
    /// these elements has a cusp.
    pub fn regular_alphas(&self) -> Result<(f64, f64), Error> {
        let (l0, l1) = self.legs;
        if !(l0 * l1 > 0.0 || (l0.signum() == l1.signum() && l0 != 0.0 && l1 != 0.0)) {
            return Err(Error::NoRegularArc { leg0: l0, leg1: l1 });
        }
        Ok(if l0.abs() > l1.abs() {
            ((l0 - l1) / (l1 * self.cos_h), f64::INFINITY)
        } else if l0.abs() < l1.abs() {
            (0.0, l0 * self.cos_h / (l1 - l0))
        } else {
            (0.0, f64::INFINITY)
        })
    }

    /// The `alpha` whose arc has the signed radius `radius` at the start; none if no positive one has
    /// (for equal legs every arc is the circular one, and none is returned).
    #[must_use]
    pub fn alpha_for_start_radius(&self, radius: f64) -> Option<f64> {
        let (l0, l1) = self.legs;
        let alpha = (radius * self.sin_h - l0 * self.cos_h) / (l0 - l1);
        (alpha > 0.0 && alpha.is_finite()).then_some(alpha)
    }

    /// The `alpha` that fits given supports best: the linear least-squares solution over samples of
    /// a unit normal between the ends and the distance of the tangent with that normal from the origin.
    ///
    /// The fit need not be regular, nor positive; see [`G1Ends::clamp_alpha`]. Equal legs, where
    /// `alpha` has no influence, and no samples give 1.
    pub fn fit_alpha(&self, samples: impl IntoIterator<Item = (DVec2, f64)>) -> f64 {
        let (z0, z1) = self.spinors;
        // Supports are taken about the start point: the terms of P0 vanish, and no digits with them.
        let chord = self.end.point - self.start.point;
        let (middle, end) = (2.0 * z0.rotate(z1).dot(chord), self.end.normal.dot(chord));
        let circle = TQuartic::from_parts(z0, z1, [0.0; 4]);
        let negligible = NEGLIGIBLE_INFLUENCE * chord.length();
        let (mut count, mut numerator, mut denominator) = (0.0, 0.0, 0.0);
        for (normal, support) in samples {
            let t = circle.parameter_beyond(normal);
            let u = 1.0 - t;
            let target =
                (support - normal.dot(self.start.point)) * (z0 * u + z1 * t).length_squared();
            // p = (G0 + alpha G1) / ((u + alpha t) q)
            let g0 = end * t * t * u;
            let g1 = (middle * u + end * t) * t * t;
            let (influence, residual) = (g1 - target * t, target * u - g0);
            numerator += influence * residual;
            denominator += influence * influence;
            count += 1.0;
        }
        if denominator > count * negligible * negligible {
            numerator / denominator
        } else {
            1.0
        }
    }

    /// `alpha` moved into the interval of [`G1Ends::regular_alphas`], a little inside of it.
    ///
    /// # Errors
    /// As [`G1Ends::regular_alphas`].
    pub fn clamp_alpha(&self, alpha: f64) -> Result<f64, Error> {
        let (low, high) = self.regular_alphas()?;
        let least = low * (1.0 + REGULAR_MARGIN)
            + if low > 0.0 {
                0.0
            } else {
                high.min(1.0) * LEAST_ALPHA
            };
        let most = if high.is_finite() {
            high * (1.0 - REGULAR_MARGIN)
        } else {
            low.max(1.0) / LEAST_ALPHA
        };
        Ok(if alpha.is_nan() { 1.0_f64 } else { alpha }
            .max(least)
            .min(most))
    }

    /// The single `alpha` whose arc has the given signed radii at both ends, if there is one: the
    /// elements are *T-connected*. The criterion `(R0 s - l0 c)(l1 c - R1 s) = (l0 - l1)^2`, with s and c
    /// the sine and cosine of half the turning, is tested to `tolerance` relative to its terms.
    ///
    /// Equal legs with radii of the circular arc give 1 (every `alpha` serves).
    #[must_use]
    pub fn t_connected(&self, radii: [f64; 2], tolerance: f64) -> Option<f64> {
        let (l0, l1) = self.legs;
        let at_start = radii[0] * self.sin_h - l0 * self.cos_h;
        let at_end = l1 * self.cos_h - radii[1] * self.sin_h;
        let difference = l0 - l1;
        let size = l0.abs().max(l1.abs());
        if difference.abs() <= tolerance * size {
            let circular = at_start.abs().max(at_end.abs()) <= tolerance * size;
            return circular.then_some(1.0);
        }
        let (product, square) = (at_start * at_end, difference * difference);
        let agree = (product - square).abs() <= tolerance * product.abs().max(square);
        let alpha = at_start / difference;
        (agree && alpha > 0.0 && alpha.is_finite()).then_some(alpha)
    }
}

impl TQuartic {
    /// The parameter of the cusp: the radius of a class-3 arc is monotone, so there is at most one.
    ///
    /// None if the end radii have one sign, or if the radius vanishes identically (a point).
    #[must_use]
    pub fn cusp(&self) -> Option<f64> {
        let radius = self.radius_polynomial();
        let (r0, r1) = (radius[0], radius[3]);
        if (r0 > 0.0) == (r1 > 0.0) && r0 != 0.0 && r1 != 0.0
            || r0.abs().max(r1.abs()) <= self.radius_noise()
        {
            return None;
        }
        if r0 == 0.0 || r1 == 0.0 {
            return Some(if r0 == 0.0 { 0.0 } else { 1.0 });
        }
        let (mut low, mut high) = (0.0, 1.0);
        let mut t = r0 / (r0 - r1);
        // Newton on a monotone function, kept inside the bracket.
        for _ in 0..64 {
            let value = bernstein::evaluate(&radius, t);
            if (value > 0.0) == (r0 > 0.0) {
                low = t
            } else {
                high = t
            }
            let newton = t - value / self.radius_slope(t);
            let next = if newton > low && newton < high {
                newton
            } else {
                0.5 * (low + high)
            };
            let step = (next - t).abs();
            t = next;
            if value == 0.0 || step <= f64::EPSILON {
                break;
            }
        }
        Some(t)
    }

    /// `dR/dt = q g''' / (4 kappa^2)`, of constant sign.
    fn radius_slope(&self, t: f64) -> f64 {
        let (w0, w1) = self.spinors();
        (w0 * (1.0 - t) + w1 * t).length_squared() * self.evolute_rate()
    }

    /// `g''' / (4 kappa^2)`: the evolute has the derivative `-w^2` times this.
    fn evolute_rate(&self) -> f64 {
        let g = self.coefficients();
        let (w0, w1) = self.spinors();
        let kappa = w0.perp_dot(w1);
        6.0 * (g[3] - 3.0 * (g[2] - g[1]) - g[0]) / (4.0 * kappa * kappa)
    }

    /// The evolute, the Tschirnhausen cubic of the centres of curvature; a single point for a circular arc.
    ///
    /// For a front of class 3 this is its caustic, exactly.
    #[must_use]
    pub fn evolute(&self) -> TCubic {
        let (w0, w1) = self.spinors();
        let third = -self.evolute_rate() / 3.0;
        let legs = [square(w0) * third, w0.rotate(w1) * third];
        let (start, end) = (self.contact(0.0).centre(), self.contact(1.0).centre());
        TCubic::from_parts([start, start + legs[0], start + legs[0] + legs[1], end])
    }

    /// The point `point` with the normals from `start` to `end`, an arc of radius zero: the corner whose
    /// offset at distance d is a circular arc of radius d.
    ///
    /// # Errors
    /// As [`LineElement::new`] and [`G1Ends::new`].
    pub fn point_fan(point: DVec2, start: DVec2, end: DVec2) -> Result<Self, Error> {
        let ends = G1Ends::new(
            LineElement::new(point, start)?,
            LineElement::new(point, end)?,
        )?;
        Ok(ends.arc_of_positive(1.0))
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point form, a rational quartic; the
    /// curve is `(x1, x2) / x0`. The weights are the coefficients of `2 |kappa| q`, all positive.
    #[must_use]
    pub fn quartic(&self) -> [DVec3; 5] {
        let b = self.control_vectors();
        let side = if self.turning() < 0.0 { -1.0 } else { 1.0 };
        let meet = |i: usize, j: usize| b[i].cross(b[j]) * side;
        // X_k = sum_{i+j=k} C(2,i) C(2,j) / C(4,k) B_i x B_{j+1}
        [
            meet(0, 1),
            0.5 * meet(0, 2),
            meet(0, 3) / 6.0 + 0.5 * meet(1, 2),
            0.5 * meet(1, 3),
            meet(2, 3),
        ]
    }
}

#[cfg(test)]
mod tests;
