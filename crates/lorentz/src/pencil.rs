use crate::relation::Relation;
use crate::tolerance::DECISION;
use crate::{CharacteristicCircle, Error, LorentzVector, Object, SphereVector};

/// The linear pencil spanned by two spheres or planes: all spheres `a s + b t` (Section 3.3).
///
/// Three kinds exist, told apart by the product of the two: spheres through a common circle, spheres that touch
/// in a common point, and spheres that separate two limit points (Poncelet).
///
/// ```
/// use lorentz::{Pencil, PencilKind, Sphere, SphereVector, glam::dvec3};
/// let a = SphereVector::from(Sphere::new(dvec3(0.0, 0.0, 0.0), 5.0)?);
/// let b = SphereVector::from(Sphere::new(dvec3(6.0, 0.0, 0.0), 5.0)?);
/// let pencil = Pencil::new(a, b)?;
/// let PencilKind::BaseCircle(circle) = pencil.kind() else { panic!() };
/// assert!((circle.circle().expect("a circle").radius() - 4.0).abs() < 1e-14);
/// assert!(pencil.contains(pencil.member(0.3)));
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pencil {
    first: SphereVector,
    second: SphereVector,
    /// Product of the two.
    product: f64,
    kind: PencilKind,
}

/// The three kinds of pencils, with what all their members have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PencilKind {
    /// All members pass through this circle; the pencil is a circle on the space of spheres.
    BaseCircle(CharacteristicCircle),
    /// All members touch in this point; the pencil is a pair of parallel lines on the space of spheres.
    Tangent {
        /// Point of contact, with the scale of the light-like vector `s - sign(s . t) t`.
        contact: Object,
    },
    /// All members separate these two points; the pencil is a hyperbola, whose asymptotes are the points.
    Poncelet {
        /// The limit points `s + mu t` for `mu = -s.t - root`, then `mu = -s.t + root`, with their scales.
        limit_points: [Object; 2],
    },
}

impl Pencil {
    /// The pencil of two different spheres or planes.
    ///
    /// # Errors
    /// [`Error::SameSphere`] if they are the same up to orientation; [`Error::NonFinite`] on overflow.
    pub fn new(first: SphereVector, second: SphereVector) -> Result<Self, Error> {
        let position = first.position_of(second);
        let product = position.product;
        let (s, t) = (first.vector(), second.vector());
        let kind = match position.relation {
            Relation::Identical | Relation::Opposite => return Err(Error::SameSphere { product }),
            Relation::Tangent { contact, .. } => PencilKind::Tangent { contact },
            Relation::Orthogonal | Relation::Secant { .. } => PencilKind::BaseCircle(
                CharacteristicCircle::of_orthogonal(s, orthogonal_partner(s, t, product)),
            ),
            Relation::Disjoint { .. } => {
                let root = ((product - 1.0) * (product + 1.0)).sqrt();
                // The product of the two solutions is 1: the larger one is safe from cancellation.
                let large = -product - root.copysign(product);
                let [minus, plus] = if product > 0.0 {
                    [large, 1.0 / large]
                } else {
                    [1.0 / large, large]
                };
                PencilKind::Poncelet {
                    limit_points: [
                        LorentzVector::recover_point_between(s, minus, t)?,
                        LorentzVector::recover_point_between(s, plus, t)?,
                    ],
                }
            }
        };
        Ok(Self {
            first,
            second,
            product,
            kind,
        })
    }

    /// The pencil of all spheres through a circle (or all planes through a line).
    ///
    /// `member(angle)` is then `cos(angle) G + sin(angle) P` with the great sphere G of the circle and its plane P,
    /// and `derivative(angle)` belongs to a circle with the same axis (formulas (19) and (20)).
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the great sphere overflows.
    pub fn through(circle: impl Into<CharacteristicCircle>) -> Result<Self, Error> {
        let circle = circle.into();
        let (first, second) = circle.orthogonal_pair()?;
        Ok(Self {
            first,
            second,
            product: 0.0,
            kind: PencilKind::BaseCircle(circle),
        })
    }

    /// The kind of pencil and what its members share.
    #[must_use]
    pub const fn kind(&self) -> PencilKind {
        self.kind
    }

    /// The two spheres that span it.
    #[must_use]
    pub const fn generators(&self) -> (SphereVector, SphereVector) {
        (self.first, self.second)
    }

    /// A member: the first generator at 0, and every other one once.
    ///
    /// With a base circle the parameter is the angle from the first generator, and the whole pencil (both
    /// orientations) is run through from 0 to 2 pi. In a tangent pencil it is the step along the line
    /// `s + parameter * contact`, in a Poncelet pencil the inversive distance from the first generator along its
    /// branch; `-member` is the other line or branch.
    #[must_use]
    pub fn member(&self, parameter: f64) -> SphereVector {
        let (s, partner) = (self.first.vector(), self.partner());
        SphereVector::from_unit(match self.kind {
            PencilKind::BaseCircle(_) => parameter.cos() * s + parameter.sin() * partner,
            PencilKind::Tangent { .. } => s + parameter * partner,
            PencilKind::Poncelet { .. } => parameter.cosh() * s + parameter.sinh() * partner,
        })
    }

    /// The derivative of [`member`](Self::member): a unit space-like vector in a pencil with base circle (the
    /// derivative sphere), light-like in a tangent pencil, of square -1 in a Poncelet pencil (it has no envelope).
    #[must_use]
    pub fn derivative(&self, parameter: f64) -> LorentzVector {
        let (s, partner) = (self.first.vector(), self.partner());
        match self.kind {
            PencilKind::BaseCircle(_) => parameter.cos() * partner - parameter.sin() * s,
            PencilKind::Tangent { .. } => partner,
            PencilKind::Poncelet { .. } => parameter.sinh() * s + parameter.cosh() * partner,
        }
    }

    /// Whether a sphere belongs to the pencil.
    #[must_use]
    pub fn contains(&self, sphere: SphereVector) -> bool {
        self.residual(sphere) <= DECISION
    }

    /// How far a sphere is from the pencil: the largest coordinate of what the best member leaves, relative to the
    /// largest coordinate of the sphere and of the pencil's generators.
    #[must_use]
    pub fn residual(&self, sphere: SphereVector) -> f64 {
        let (s, t, x) = (self.first.vector(), self.second.vector(), sphere.vector());
        let scale = s.max_abs().max(t.max_abs()).max(x.max_abs());
        // Least squares in the coordinates, where the product may be degenerate on the pencil (a tangent one).
        let dot = |a: LorentzVector, b: LorentzVector| a.o * b.o + a.v.dot(b.v) + a.inf * b.inf;
        let e = s / dot(s, s).sqrt();
        let t = t - dot(t, e) * e;
        let f = t / dot(t, t).sqrt().max(f64::MIN_POSITIVE);
        let left = x - dot(x, e) * e;
        (left - dot(left, f) * f).max_abs() / scale
    }

    /// The vector that spans the pencil together with the first generator, orthogonal to it (a pencil with base
    /// circle or a Poncelet pencil, of square 1 or -1) or light-like (a tangent pencil).
    fn partner(&self) -> LorentzVector {
        let (s, t) = (self.first.vector(), self.second.vector());
        match self.kind {
            PencilKind::BaseCircle(_) | PencilKind::Poncelet { .. } => {
                orthogonal_partner(s, t, self.product)
            }
            PencilKind::Tangent { .. } => s - self.product.signum() * t,
        }
    }
}

/// The unit vector (of square 1 or -1) orthogonal to `s` in the plane of `s` and `t`.
fn orthogonal_partner(s: LorentzVector, t: LorentzVector, product: f64) -> LorentzVector {
    (t - product * s) / ((1.0 - product) * (1.0 + product)).abs().sqrt()
}
