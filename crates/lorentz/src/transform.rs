use std::ops::Mul;

use glam::{DMat3, DQuat, DVec3};

use crate::tolerance::ON_QUADRIC;
use crate::{Error, LorentzVector, Object, Point, SphereVector};

/// A linear map of the Minkowski-Lorentz space that preserves the product: a Möbius transformation of space.
///
/// Inversions, motions and similarities are of this kind and compose (`second * first`) and invert exactly. Angles,
/// orthogonality, oriented contact and pencils survive; so do canal curves, whose controls are mapped one by one.
///
/// ```
/// use lorentz::{LorentzMap, Point, Sphere, SphereVector, glam::dvec3};
/// let mirror = SphereVector::from(Sphere::new(dvec3(0.0, 0.0, 0.0), 2.0)?);
/// let inversion = LorentzMap::inversion(mirror);
/// let image = inversion.map_point(Point::new(dvec3(4.0, 0.0, 0.0))?)?;
/// assert_eq!(image.position(), Some(dvec3(1.0, 0.0, 0.0)));
/// assert_eq!(inversion.map_point(Point::ORIGIN)?, Point::INFINITY);
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "[LorentzVector; 5]", into = "[LorentzVector; 5]")
)]
pub struct LorentzMap {
    /// Images of `e_o, e_1, e_2, e_3, e_inf`.
    columns: [LorentzVector; 5],
}

/// The basis `e_o, e_1, e_2, e_3, e_inf`.
const BASIS: [LorentzVector; 5] = [
    LorentzVector::ORIGIN,
    LorentzVector::new(0.0, DVec3::X, 0.0),
    LorentzVector::new(0.0, DVec3::Y, 0.0),
    LorentzVector::new(0.0, DVec3::Z, 0.0),
    LorentzVector::INFINITY,
];

impl LorentzMap {
    /// The identity.
    pub const IDENTITY: Self = Self { columns: BASIS };

    /// The map with the given images of `e_o, e_1, e_2, e_3, e_inf`.
    ///
    /// # Errors
    /// [`Error::NotALorentzMap`] if they do not have the products of the basis, to 1e-9 of the terms;
    /// [`Error::NonFinite`].
    pub fn from_columns(columns: [LorentzVector; 5]) -> Result<Self, Error> {
        if !columns
            .iter()
            .all(|column| column.coordinate_square().is_finite())
        {
            return Err(Error::NonFinite {
                what: "a column of a Lorentz map",
            });
        }
        let mut residual = 0.0_f64;
        for (column, unit) in columns.iter().zip(BASIS) {
            for (other, other_unit) in columns.iter().zip(BASIS) {
                let terms = column.coordinate_square().sqrt() * other.coordinate_square().sqrt();
                let error = column.product(*other) - unit.product(other_unit);
                residual = residual.max(error.abs() / terms.max(1.0));
            }
        }
        if residual > ON_QUADRIC {
            Err(Error::NotALorentzMap { residual })
        } else {
            Ok(Self { columns })
        }
    }

    /// The map given by what it does to vectors, which must be linear and preserve the product.
    fn of(image: impl Fn(LorentzVector) -> LorentzVector) -> Self {
        Self {
            columns: BASIS.map(image),
        }
    }

    /// The reflection `x - 2 (x . s) s`: the inversion in a sphere, or the mirror image in a plane.
    #[must_use]
    pub fn inversion(mirror: SphereVector) -> Self {
        let s = mirror.vector();
        Self::of(|x| x - 2.0 * x.product(s) * s)
    }

    /// The translation by `shift`.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn translation(shift: DVec3) -> Result<Self, Error> {
        if !shift.length_squared().is_finite() {
            return Err(Error::NonFinite {
                what: "a translation",
            });
        }
        Ok(Self::of(|x| x.translated(shift)))
    }

    /// The scaling about the origin by a positive `factor`.
    ///
    /// # Errors
    /// [`Error::ScaleNotPositive`], [`Error::NonFinite`] if the factor or its inverse is not finite.
    pub fn scaling(factor: f64) -> Result<Self, Error> {
        if !(factor.is_finite() && factor.recip().is_finite()) && factor != 0.0 {
            return Err(Error::NonFinite {
                what: "a scale factor",
            });
        }
        if factor <= 0.0 {
            return Err(Error::ScaleNotPositive { factor });
        }
        Ok(Self::of(|x| x.scaled(factor)))
    }

    /// The rotation about the origin by a quaternion of any length but zero.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::ZeroNormal`].
    pub fn rotation(rotation: DQuat) -> Result<Self, Error> {
        let largest = rotation
            .x
            .abs()
            .max(rotation.y.abs())
            .max(rotation.z.abs())
            .max(rotation.w.abs());
        if !rotation.is_finite() {
            return Err(Error::NonFinite { what: "a rotation" });
        }
        if largest == 0.0 {
            return Err(Error::ZeroNormal);
        }
        let matrix = DMat3::from_quat((rotation / largest).normalize());
        Ok(Self::of(|x| LorentzVector::new(x.o, matrix * x.v, x.inf)))
    }

    /// The similarity `x -> factor * rotation(x) + shift`.
    ///
    /// # Errors
    /// Those of [`scaling`](Self::scaling), [`rotation`](Self::rotation) and [`translation`](Self::translation).
    pub fn similarity(factor: f64, rotation: DQuat, shift: DVec3) -> Result<Self, Error> {
        Ok(Self::translation(shift)? * Self::rotation(rotation)? * Self::scaling(factor)?)
    }

    /// The inversion that sends `point` to infinity: in the sphere of the given `radius` about it (Section 12).
    ///
    /// A cyclide with a singular point there becomes a cone or a cylinder, a regular one becomes parabolic. For the
    /// point at infinity this is the identity.
    ///
    /// # Errors
    /// [`Error::ZeroRadius`], [`Error::NonFinite`].
    pub fn sending_to_infinity(point: Point, radius: f64) -> Result<Self, Error> {
        match point.position() {
            None => Ok(Self::IDENTITY),
            Some(centre) => Ok(Self::inversion(crate::Sphere::new(centre, radius)?.into())),
        }
    }

    /// The image of a vector.
    #[must_use]
    pub fn map_vector(&self, x: LorentzVector) -> LorentzVector {
        let [o, e1, e2, e3, inf] = self.columns;
        x.o * o + x.v.x * e1 + x.v.y * e2 + x.v.z * e3 + x.inf * inf
    }

    /// The image of a sphere or a plane; orientation included.
    #[must_use]
    pub fn map_sphere(&self, sphere: SphereVector) -> SphereVector {
        SphereVector::from_unit(self.map_vector(sphere.vector()))
    }

    /// The image of a point, possibly infinity.
    ///
    /// # Errors
    /// [`Error::NonFinite`] on overflow.
    pub fn map_point(&self, point: Point) -> Result<Point, Error> {
        match self.map_vector(point.vector()).recover_point()? {
            Object::Point { point, .. } => Ok(point),
            _ => Ok(Point::INFINITY),
        }
    }

    /// The inverse map: the transposed matrix with respect to the product.
    #[must_use]
    pub fn inverse(&self) -> Self {
        // Coordinates are products with the dual basis: xo = -(x . e_inf), xi = x . e_i, xinf = -(x . e_o).
        let [o, e1, e2, e3, inf] = self.columns;
        Self::of(|x| {
            let v = DVec3::new(x.product(e1), x.product(e2), x.product(e3));
            LorentzVector::new(-x.product(inf), v, -x.product(o))
        })
    }

    /// Images of `e_o, e_1, e_2, e_3, e_inf`: the columns of the matrix.
    #[must_use]
    pub const fn columns(&self) -> [LorentzVector; 5] {
        self.columns
    }
}

/// Composition: `(second * first)` applies `first` first.
impl Mul for LorentzMap {
    type Output = Self;
    fn mul(self, first: Self) -> Self {
        Self {
            columns: first.columns.map(|column| self.map_vector(column)),
        }
    }
}

impl Default for LorentzMap {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl TryFrom<[LorentzVector; 5]> for LorentzMap {
    type Error = Error;
    fn try_from(columns: [LorentzVector; 5]) -> Result<Self, Error> {
        Self::from_columns(columns)
    }
}

impl From<LorentzMap> for [LorentzVector; 5] {
    fn from(map: LorentzMap) -> Self {
        map.columns
    }
}
