use bezier_mass::{Parameter, Quadratic, bernstein};
use glam::DVec3;

use crate::circle::frame_about;
use crate::plane::unit_direction;
use crate::tolerance::ROUNDING;
use crate::{
    CharacteristicCircle, Circle, Error, LorentzMap, LorentzVector, Object, SphereCurve,
    SphereMassPoint, SphereVector,
};

/// A curve of spheres with a real envelope: a canal surface, a piece of a Dupin cyclide.
///
/// Every sphere touches the surface along its characteristic circle, where it meets its derivative sphere. Nothing is
/// divided before the end, so that planes, vertices and points at infinity need no case of their own.
///
/// ```
/// use lorentz::{CanalCurve, Sphere, construct, glam::{DVec3, dvec3}};
/// // The cone with this vertex around this sphere (Algorithm 1).
/// let sphere = Sphere::new(dvec3(0.0, 0.0, 0.0), 1.0)?;
/// let cone: CanalCurve = construct::cone(dvec3(1.0, 1.0, 1.0), sphere)?.curve;
/// let x = cone.surface_point(0.5, 0.0, DVec3::Y)?;
/// assert!((x.normal.length() - 1.0).abs() < 1e-15);
/// assert!((x.position - x.normal).length() < 1e-15); // on the unit sphere, at t = 1/2
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "SphereCurve", into = "SphereCurve")
)]
pub struct CanalCurve {
    curve: SphereCurve,
    /// `kappa = sqrt(K)`.
    root_of_invariant: f64,
    /// Bernstein coefficients of the homogeneous derivative sphere `T = (w X' - w' X) / (2 kappa)`.
    tangent: [LorentzVector; 3],
    /// Bernstein coefficients of `A = (Xo Xv' - Xo' Xv) / (2 kappa)`, along the axis of the characteristic circle,
    /// of squared length `Xo^2 + To^2`.
    axis: [DVec3; 3],
    spine: Quadratic<DVec3>,
}

/// The member of a canal curve at one parameter, with all that belongs to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanalMember {
    t: f64,
    root_of_invariant: f64,
    /// The value `[w, X]` of the curve; `X . X = w^2`.
    value: SphereMassPoint,
    /// The homogeneous derivative sphere: `T . T = w^2`, `T . X = 0`.
    tangent: LorentzVector,
    /// Along the axis of the circle.
    axis: DVec3,
}

/// A point of a surface with its unit normal.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SurfacePoint {
    /// Position in space.
    pub position: DVec3,
    /// Unit normal; outward where the radius of the sphere is positive.
    pub normal: DVec3,
}

impl CanalCurve {
    /// The envelope of the curve with the given controls.
    ///
    /// # Errors
    /// [`Error::OffTheQuadric`], [`Error::NotSpaceLike`], [`Error::NonFinite`].
    pub fn new(control: [SphereMassPoint; 3]) -> Result<Self, Error> {
        Self::from_curve(SphereCurve::new(control)?)
    }

    /// The envelope of a curve of spheres.
    ///
    /// # Errors
    /// [`Error::NotSpaceLike`].
    pub fn from_curve(curve: SphereCurve) -> Result<Self, Error> {
        let k = curve.envelope_invariant();
        if k <= 0.0 {
            return Err(Error::NotSpaceLike { k });
        }
        let root_of_invariant = k.sqrt();
        let spine = curve.spine()?;
        Ok(Self {
            curve,
            root_of_invariant,
            tangent: curve
                .quadratic()
                .tangent_moments()
                .map(|moment| moment / root_of_invariant),
            axis: spine
                .tangent_moments()
                .map(|moment| moment / root_of_invariant),
            spine,
        })
    }

    /// The curve on the space of spheres.
    #[must_use]
    pub const fn curve(&self) -> &SphereCurve {
        &self.curve
    }

    /// The three controls.
    #[must_use]
    pub const fn control(&self) -> &[SphereMassPoint; 3] {
        self.curve.control()
    }

    /// The member at `t` (any number; NaN gives a member without circle).
    #[must_use]
    pub fn at(&self, t: f64) -> CanalMember {
        let value = self.curve.quadratic().at(t);
        let spine = self.spine.at(t);
        let mut tangent = bernstein::evaluate(&self.tangent, t);
        // A curvature that vanishes to rounding is a plane's: zero, as the Bézier arithmetic has it for weights.
        let [t0, t1, t2] = self.tangent.map(|tangent| tangent.o.abs());
        let [b0, b1, b2] = bernstein::quadratic_basis(t).map(f64::abs);
        if tangent.o.abs() <= ROUNDING * (b0 * t0 + b1 * t1 + b2 * t2) {
            tangent.o = 0.0;
        }
        CanalMember {
            t,
            root_of_invariant: self.root_of_invariant,
            value: SphereMassPoint::from_homogeneous(
                value.weight,
                LorentzVector {
                    o: spine.weight,
                    ..value.weighted
                },
            ),
            tangent,
            axis: bernstein::evaluate(&self.axis, t),
        }
    }

    /// Point and unit normal of the surface at `(t, theta)`, the angle counted as in [`Circle::frame`].
    ///
    /// # Errors
    /// [`Error::SingularPoint`], [`Error::CharacteristicLine`], [`Error::ReferenceParallelToAxis`], [`Error::NonFinite`].
    pub fn surface_point(
        &self,
        t: f64,
        theta: f64,
        reference: DVec3,
    ) -> Result<SurfacePoint, Error> {
        self.at(t).surface_point(theta, reference)
    }

    /// A direction orthogonal to every axis of the characteristic circles: the normal of the plane in which the
    /// centres lie, the best reference for angles.
    ///
    /// Where the centres lie on a line (cones, cylinders) it is one of the directions orthogonal to it.
    #[must_use]
    pub fn reference(&self) -> DVec3 {
        let [a, b, c] = self.axis;
        let normals = [a.cross(b), b.cross(c), a.cross(c)];
        let scale = a
            .length_squared()
            .max(b.length_squared())
            .max(c.length_squared());
        let normal = longest(normals);
        if normal.length() > 1e-9 * scale {
            // Of the two signs the one with its largest coordinate positive.
            let normal = normal.normalize();
            let largest = longest([
                normal.x * DVec3::X,
                normal.y * DVec3::Y,
                normal.z * DVec3::Z,
            ]);
            return normal * largest.element_sum().signum();
        }
        unit_direction(longest([a, b, c])).map_or(DVec3::Y, |axis| axis.any_orthonormal_vector())
    }

    /// Whether no characteristic circle passes a singular point of the surface, the vertices `w(t) = 0` apart.
    ///
    /// By the sign of `det(Xi . Xj) = -4 K^2 (K + w1^2 - w0 w2)`: negative means regular; zero, one singular point on
    /// each circle; positive, two (a pinched, spindle-like piece).
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.curve.weight_discriminant() / self.curve.envelope_invariant()
            > -1.0 + crate::tolerance::DECISION
    }

    /// The parameters in `[0, 1]` at which the surface has a vertex: the zeros of the weight.
    #[must_use]
    pub fn vertices(&self) -> Vec<f64> {
        let inside = |t: f64| {
            (-ROUNDING..=1.0 + ROUNDING)
                .contains(&t)
                .then(|| t.clamp(0.0, 1.0))
        };
        self.curve
            .singular_parameters()
            .into_iter()
            .filter_map(|p| p.value().and_then(inside))
            .collect()
    }

    /// de Casteljau's subdivision at `t` into two canal curves.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if `t` is not finite; [`Error::Bezier`] at the ends.
    pub fn subdivide(&self, t: f64) -> Result<(Self, Self), Error> {
        Ok((self.sub_arc(0.0, t)?, self.sub_arc(t, 1.0)?))
    }

    /// The characteristic circles found by halving the curve `depth` times (at most 16): `2^depth + 1` circles, ends
    /// included (the iterative construction of Section 5).
    ///
    /// # Errors
    /// [`Error::SingularPoint`] where the curve passes a vertex, with its parameter in the whole curve.
    pub fn circles_by_subdivision(&self, depth: u32) -> Result<Vec<CharacteristicCircle>, Error> {
        let depth = depth.min(16);
        let mut pieces = vec![*self.curve.quadratic()];
        for _ in 0..depth {
            pieces = pieces
                .iter()
                .map(|piece| piece.subdivide(0.5))
                .flat_map(|(left, right)| [left, right])
                .collect();
        }
        let count = pieces.len() as f64;
        let mut circles = Vec::with_capacity(pieces.len() + 1);
        for (i, piece) in pieces.iter().enumerate() {
            let piece = Self::from_curve(SphereCurve::on_quadric(*piece))?;
            let locate = |_| Error::SingularPoint {
                t: i as f64 / count,
            };
            circles.push(piece.at(0.0).circle().map_err(locate)?);
        }
        circles.push(self.at(1.0).circle()?);
        Ok(circles)
    }

    /// The part from one parameter to another; see [`SphereCurve::sub_arc`].
    ///
    /// # Errors
    /// [`Error::Bezier`] if the parameters coincide or are not finite.
    pub fn sub_arc(
        &self,
        start: impl Into<Parameter>,
        end: impl Into<Parameter>,
    ) -> Result<Self, Error> {
        Self::from_curve(self.curve.sub_arc(start, end)?)
    }

    /// The surface run through backwards.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let [t0, t1, t2] = self.tangent;
        let [a0, a1, a2] = self.axis;
        Self {
            curve: self.curve.reversed(),
            tangent: [-t2, -t1, -t0],
            axis: [-a2, -a1, -a0],
            spine: self.spine.reversed(),
            ..*self
        }
    }

    /// The other part of the same surface between the same ends.
    ///
    /// # Errors
    /// None on a curve that exists.
    pub fn complement(&self) -> Result<Self, Error> {
        Self::from_curve(self.curve.complement())
    }

    /// The image under a Lorentz map, the envelope of the images of the spheres.
    ///
    /// # Errors
    /// [`Error::Bezier`] if a number overflows, [`Error::NotSpaceLike`] if its invariant is lost in rounding.
    pub fn mapped(&self, map: &LorentzMap) -> Result<Self, Error> {
        Self::from_curve(self.curve.mapped(map)?)
    }
}

/// The longest of some vectors.
fn longest<const N: usize>(vectors: [DVec3; N]) -> DVec3 {
    vectors.into_iter().fold(DVec3::ZERO, |a, b| {
        if b.length_squared() > a.length_squared() {
            b
        } else {
            a
        }
    })
}

impl CanalMember {
    /// The parameter.
    #[must_use]
    pub const fn t(&self) -> f64 {
        self.t
    }

    /// The weight w(t) of the curve; zero exactly at a vertex.
    #[must_use]
    pub const fn weight(&self) -> f64 {
        self.value.weight
    }

    /// The homogeneous value `[w, X]` of the curve.
    #[must_use]
    pub const fn value(&self) -> SphereMassPoint {
        self.value
    }

    /// The sphere or plane; `None` at a vertex.
    #[must_use]
    pub fn sphere(&self) -> Option<SphereVector> {
        let weight = self.value.weight;
        (weight != 0.0).then(|| SphereVector::from_unit(self.value.weighted / weight))
    }

    /// The derivative sphere, along increasing t; `None` at a vertex.
    #[must_use]
    pub fn derivative_sphere(&self) -> Option<SphereVector> {
        let weight = self.value.weight.abs();
        (weight != 0.0).then(|| SphereVector::from_unit(self.tangent / weight))
    }

    /// The speed `2 kappa / |w|` on the space of spheres; `None` at a vertex.
    #[must_use]
    pub fn speed(&self) -> Option<f64> {
        let weight = self.value.weight.abs();
        (weight != 0.0).then(|| 2.0 * self.root_of_invariant / weight)
    }

    /// The vertex of the surface with the scale of its light-like vector, if this member is one; it may be infinity.
    #[must_use]
    pub fn vertex(&self) -> Option<Object> {
        if self.value.is_vector() {
            self.value.weighted.recover_point().ok()
        } else {
            None
        }
    }

    /// The circle along which sphere and surface touch; its axis points to where the centres of the spheres move.
    ///
    /// # Errors
    /// [`Error::SingularPoint`] at a vertex, where the circle has shrunk to a point.
    pub fn circle(&self) -> Result<CharacteristicCircle, Error> {
        let (Some(sphere), Some(derivative)) = (self.sphere(), self.derivative_sphere()) else {
            return Err(Error::SingularPoint { t: self.t });
        };
        Ok(match self.ring() {
            Some(ring) => Circle::from_parts(ring.centre, ring.radius, ring.axis).into(),
            None => CharacteristicCircle::of_orthogonal(sphere.vector(), derivative.vector()),
        })
    }

    /// Point and unit normal at the angle `theta` (radians), counted as in [`Circle::frame`].
    ///
    /// # Errors
    /// [`Error::SingularPoint`], [`Error::CharacteristicLine`], [`Error::ReferenceParallelToAxis`], [`Error::NonFinite`].
    pub fn surface_point(&self, theta: f64, reference: DVec3) -> Result<SurfacePoint, Error> {
        if !(theta.is_finite() && self.t.is_finite()) {
            return Err(Error::NonFinite {
                what: "a parameter of the surface",
            });
        }
        if self.value.is_vector() {
            return Err(Error::SingularPoint { t: self.t });
        }
        let ring = self.ring().ok_or(Error::CharacteristicLine { t: self.t })?;
        let (u, v) = frame_about(ring.axis, reference)?;
        let outward = theta.cos() * u + theta.sin() * v;
        Ok(SurfacePoint {
            position: ring.centre + ring.radius * outward,
            normal: ring.normal_along_axis * ring.axis + ring.normal_outward * outward,
        })
    }

    /// The circle with its band of normals; `None` where it is a line or a point.
    pub(crate) fn ring(&self) -> Option<Ring> {
        let weight = self.value.weight;
        if weight == 0.0 {
            None
        } else {
            self.ring_with_sign(weight.signum())
        }
    }

    /// [`ring`](Self::ring), also at a finite vertex: there the radius is zero and the normals are their limit from the
    /// side on which the weight has the given sign.
    pub(crate) fn ring_with_sign(&self, sign: f64) -> Option<Ring> {
        let (x, tangent) = (self.value.weighted, self.tangent);
        let curvature = x.o.hypot(tangent.o);
        if curvature == 0.0 || !curvature.is_finite() {
            return None;
        }
        let (a, b) = (x.o / curvature, tangent.o / curvature);
        let centre = (a * x.v + b * tangent.v) / curvature;
        centre.is_finite().then_some(Ring {
            centre,
            radius: self.value.weight.abs() / curvature,
            axis: self.axis.try_normalize()?,
            normal_along_axis: b,
            normal_outward: sign * a,
        })
    }
}

/// A characteristic circle and the normals of the surface along it.
///
/// With `e` the unit vector from the centre, the normal is `(T_o/sqrt(q)) A/sqrt(q) + sign(w) (X_o/sqrt(q)) e`: a cone
/// of normals about the axis, free of any division by w.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ring {
    pub(crate) centre: DVec3,
    pub(crate) radius: f64,
    pub(crate) axis: DVec3,
    /// Component of the unit normal along the axis.
    pub(crate) normal_along_axis: f64,
    /// Component of the unit normal away from the centre.
    pub(crate) normal_outward: f64,
}

impl TryFrom<SphereCurve> for CanalCurve {
    type Error = Error;
    fn try_from(curve: SphereCurve) -> Result<Self, Error> {
        Self::from_curve(curve)
    }
}

impl From<CanalCurve> for SphereCurve {
    fn from(canal: CanalCurve) -> Self {
        canal.curve
    }
}
