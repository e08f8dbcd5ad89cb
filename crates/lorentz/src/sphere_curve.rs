use bezier_mass::{MassPoint, Parameter, Quadratic};
use glam::DVec3;

use crate::roots::quadratic_roots;
use crate::tolerance::{ON_QUADRIC, ROUNDING};
use crate::{CanalCurve, Cycle, Error, LorentzMap, LorentzVector, Object, SphereVector};

/// A control mass point of a curve of spheres: a weighted sphere `(sigma; w)`, or a light-like or other vector `(x; 0)`.
///
/// As a 6-vector `[w, X]` it carries the Lie form [`lie_product`].
pub type SphereMassPoint = MassPoint<LorentzVector>;

/// The Lie form `X . Y - w v` of two 6-vectors `[w, X]` and `[v, Y]`, of signature (4, 2).
///
/// Two spheres touch with the same orientation, and a point lies on a sphere, exactly where it vanishes.
#[must_use]
pub fn lie_product(a: SphereMassPoint, b: SphereMassPoint) -> f64 {
    a.weighted.product(b.weighted) - a.weight * b.weight
}

/// A rational quadratic Bézier curve on the space of spheres: one family of spheres of a Dupin cyclide, a cone, a
/// torus, or a pencil (Section 4 of the mass-point paper).
///
/// The controls `[w, X]` may be weighted spheres, points (light-like vectors of weight 0) and other vectors. The curve
/// lies on the space of spheres exactly if `<b0,b0> = <b2,b2> = <b0,b1> = <b1,b2> = 0` and `2 <b1,b1> + <b0,b2> = 0`
/// in the Lie form, which the constructor checks. Where the family has an envelope, [`canal`](Self::canal) gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "Quadratic<LorentzVector>",
        into = "Quadratic<LorentzVector>"
    )
)]
pub struct SphereCurve {
    quadratic: Quadratic<LorentzVector>,
    envelope_invariant: f64,
}

impl SphereCurve {
    /// The curve with the given controls.
    ///
    /// # Errors
    /// [`Error::OffTheQuadric`] if the curve leaves the space of spheres, [`Error::NonFinite`].
    pub fn new(control: [SphereMassPoint; 3]) -> Result<Self, Error> {
        Self::from_quadratic(Quadratic::new(control)?)
    }

    /// The curve of spheres that this Bézier curve is.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn from_quadratic(quadratic: Quadratic<LorentzVector>) -> Result<Self, Error> {
        let [b0, b1, b2] = *quadratic.control();
        let conditions = [(b0, b0), (b2, b2), (b0, b1), (b1, b2)]
            .map(|(a, b)| (lie_product(a, b), lie_terms(a, b)));
        let balance = (
            2.0 * lie_product(b1, b1) + lie_product(b0, b2),
            2.0 * lie_terms(b1, b1) + lie_terms(b0, b2),
        );
        let mut residual = 0.0_f64;
        for (value, terms) in conditions.into_iter().chain([balance]) {
            if !terms.is_finite() {
                return Err(Error::NonFinite {
                    what: "the product of two controls",
                });
            }
            if terms > 0.0 {
                residual = residual.max(value.abs() / terms);
            }
        }
        if residual > ON_QUADRIC {
            Err(Error::OffTheQuadric { residual })
        } else {
            Ok(Self::on_quadric(quadratic))
        }
    }

    /// A curve that is on the quadric by its construction.
    pub(crate) fn on_quadric(quadratic: Quadratic<LorentzVector>) -> Self {
        let [b0, b1, b2] = *quadratic.control();
        // K = <b1,b1> = -<b0,b2>/2, by whichever sum has the smaller terms.
        let middle = (lie_product(b1, b1), lie_terms(b1, b1));
        let ends = lie_product_of_members(b0, b2);
        let (k, terms) = if ends.1 <= 2.0 * middle.1 {
            (-0.5 * ends.0, 0.5 * ends.1)
        } else {
            middle
        };
        Self {
            quadratic,
            envelope_invariant: if k.abs() <= ROUNDING * terms { 0.0 } else { k },
        }
    }

    /// The three controls.
    #[must_use]
    pub const fn control(&self) -> &[SphereMassPoint; 3] {
        self.quadratic.control()
    }

    /// The Bézier curve itself.
    #[must_use]
    pub const fn quadratic(&self) -> &Quadratic<LorentzVector> {
        &self.quadratic
    }

    /// The invariant `K = <b1,b1>`: the square of the velocity on the space of spheres is `4 K / w(t)^2`.
    ///
    /// Positive: the tangents are space-like and the whole curve has an envelope. Negative: the spheres are nested.
    /// Zero: the controls are linearly dependent. The sign belongs to the curve and cannot change along it.
    #[must_use]
    pub const fn envelope_invariant(&self) -> f64 {
        self.envelope_invariant
    }

    /// The discriminant `w1^2 - w0 w2` of the weight: negative on an ellipse, zero on a parabola, positive on a hyperbola.
    #[must_use]
    pub fn weight_discriminant(&self) -> f64 {
        let [w0, w1, w2] = self.control().map(|b| b.weight);
        w1 * w1 - w0 * w2
    }

    /// The centre of the conic, `None` for a parabola: the projection of the origin of L(4,1) on the conic's plane.
    #[must_use]
    pub fn centre(&self) -> Option<LorentzVector> {
        let [b0, b1, b2] = *self.control();
        let discriminant = self.weight_discriminant();
        let terms = b1.weight * b1.weight + (b0.weight * b2.weight).abs();
        let numerator =
            b1.weight * b1.weighted - 0.5 * (b2.weight * b0.weighted + b0.weight * b2.weighted);
        (discriminant.abs() > crate::tolerance::DECISION * terms).then(|| numerator / discriminant)
    }

    /// The envelope of the family.
    ///
    /// # Errors
    /// [`Error::NotSpaceLike`] if there is none.
    pub fn canal(&self) -> Result<CanalCurve, Error> {
        CanalCurve::from_curve(*self)
    }

    /// The member at `t`: a sphere, a plane, or a singular point where the weight vanishes.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::ZeroVector`] on a degenerate curve.
    pub fn member(&self, t: f64) -> Result<Object, Error> {
        let value = self.quadratic.at(t);
        if value.is_vector() {
            value.weighted.recover_point()
        } else {
            SphereVector::from_unit(value.weighted / value.weight).object()
        }
    }

    /// The conic of the centres, as a curve with mass points (weight: the coordinate along `e_o`).
    ///
    /// # Errors
    /// [`Error::Bezier`] never on a curve that exists.
    pub fn spine(&self) -> Result<Quadratic<DVec3>, Error> {
        Ok(self
            .quadratic
            .map(|b| MassPoint::from_homogeneous(b.weighted.o, b.weighted.v))?)
    }

    /// The parameters at which the product of the member with `other` is `value`: 1 and -1 for contact with equal and
    /// opposite orientations, 0 for a right angle.
    ///
    /// Up to two, possibly infinite or outside of `[0, 1]`; none also if every member qualifies.
    #[must_use]
    pub fn parameters_of_product(&self, other: SphereVector, value: f64) -> Vec<Parameter> {
        quadratic_roots(
            self.control()
                .map(|b| b.weighted.product(other.vector()) - value * b.weight),
        )
    }

    /// The parameters at which the member has this signed radius; an infinite radius asks for the planes.
    #[must_use]
    pub fn parameters_of_radius(&self, radius: f64) -> Vec<Parameter> {
        if radius.is_infinite() {
            quadratic_roots(self.control().map(|b| b.weighted.o))
        } else {
            quadratic_roots(self.control().map(|b| radius * b.weighted.o - b.weight))
        }
    }

    /// The parameters of the singular points: the zeros of the weight.
    #[must_use]
    pub fn singular_parameters(&self) -> Vec<Parameter> {
        quadratic_roots(self.control().map(|b| b.weight))
    }

    /// The part from one parameter to another, also beyond `[0, 1]` and through infinity; see
    /// [`Quadratic::sub_arc`].
    ///
    /// # Errors
    /// [`Error::Bezier`] if the parameters coincide or are not finite.
    pub fn sub_arc(
        &self,
        start: impl Into<Parameter>,
        end: impl Into<Parameter>,
    ) -> Result<Self, Error> {
        Ok(Self::on_quadric(self.quadratic.sub_arc(start, end)?))
    }

    /// The other arc of the conic between the same ends.
    #[must_use]
    pub fn complement(&self) -> Self {
        Self {
            quadratic: self.quadratic.complement(),
            ..*self
        }
    }

    /// The curve run backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        Self {
            quadratic: self.quadratic.reversed(),
            ..*self
        }
    }

    /// The image under a Lorentz map: controls are mapped, weights kept.
    ///
    /// # Errors
    /// [`Error::Bezier`] if a number overflows.
    pub fn mapped(&self, map: &LorentzMap) -> Result<Self, Error> {
        let quadratic = self
            .quadratic
            .map(|b| b.map_linear(|x| map.map_vector(x)))?;
        Ok(Self { quadratic, ..*self })
    }
}

impl TryFrom<Quadratic<LorentzVector>> for SphereCurve {
    type Error = Error;
    fn try_from(quadratic: Quadratic<LorentzVector>) -> Result<Self, Error> {
        Self::from_quadratic(quadratic)
    }
}

impl From<SphereCurve> for Quadratic<LorentzVector> {
    fn from(curve: SphereCurve) -> Self {
        curve.quadratic
    }
}

/// The magnitude of the terms of a Lie product.
pub(crate) fn lie_terms(a: SphereMassPoint, b: SphereMassPoint) -> f64 {
    let (x, y) = (a.weighted, b.weighted);
    x.v.length() * y.v.length()
        + (x.o * y.inf).abs()
        + (x.inf * y.o).abs()
        + (a.weight * b.weight).abs()
}

/// The Lie product of two 6-vectors on the quadric with the magnitude of its terms.
///
/// With `X = o (1, C, ..)` and `r = w/o` it is `-(o o'/2) (|C - C'|^2 - (r - r')^2)`: the square of the difference
/// of the two cycles, which forgets the distance from the origin. Taken where it has the smaller terms.
fn lie_product_of_members(a: SphereMassPoint, b: SphereMassPoint) -> (f64, f64) {
    let direct = (lie_product(a, b), lie_terms(a, b));
    let cycle = |b: SphereMassPoint| Cycle::new(b.weighted.v, b.weight) * (1.0 / b.weighted.o);
    let difference = cycle(a) - cycle(b);
    let factor = 0.5 * a.weighted.o * b.weighted.o;
    let terms =
        factor.abs() * (difference.centre.length_squared() + difference.radius * difference.radius);
    if terms <= direct.1 {
        (-factor * difference.square(), terms)
    } else {
        direct
    }
}
