use glam::DVec3;

use crate::{Error, LorentzVector};

/// A point of space, or the point at infinity which closes it (Section 3: an Alexandroff compactification).
///
/// The point `P` is the light-like vector `e_o + P + |P|^2/2 e_inf`; infinity is `e_inf` (formula (11)).
///
/// ```
/// use lorentz::{Point, glam::dvec3};
/// let p = Point::new(dvec3(1.0, -2.0, 3.0))?;
/// assert_eq!(p.vector().to_null(), [1.0, 1.0, -2.0, 3.0, 7.0]);
/// assert_eq!(p.vector().square(), 0.0);
/// # Ok::<(), lorentz::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Option<DVec3>", into = "Option<DVec3>")
)]
pub struct Point {
    position: Option<DVec3>,
}

impl Point {
    /// The point at infinity.
    pub const INFINITY: Self = Self { position: None };
    /// The origin of space.
    pub const ORIGIN: Self = Self {
        position: Some(DVec3::ZERO),
    };

    /// The point at `position`.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn new(position: DVec3) -> Result<Self, Error> {
        if position.length_squared().is_finite() {
            Ok(Self {
                position: Some(position),
            })
        } else {
            Err(Error::NonFinite {
                what: "the position of a point",
            })
        }
    }

    /// Position in space; `None` for the point at infinity.
    #[must_use]
    pub const fn position(self) -> Option<DVec3> {
        self.position
    }

    /// The light-like vector of the point.
    #[must_use]
    pub fn vector(self) -> LorentzVector {
        match self.position {
            Some(p) => LorentzVector::new(1.0, p, 0.5 * p.length_squared()),
            None => LorentzVector::INFINITY,
        }
    }
}

impl TryFrom<DVec3> for Point {
    type Error = Error;
    fn try_from(position: DVec3) -> Result<Self, Error> {
        Self::new(position)
    }
}

impl TryFrom<Option<DVec3>> for Point {
    type Error = Error;
    fn try_from(position: Option<DVec3>) -> Result<Self, Error> {
        position.map_or(Ok(Self::INFINITY), Self::new)
    }
}

impl From<Point> for Option<DVec3> {
    fn from(point: Point) -> Self {
        point.position
    }
}

impl From<Point> for LorentzVector {
    fn from(point: Point) -> Self {
        point.vector()
    }
}
