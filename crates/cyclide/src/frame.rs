//! Rigid frames: where a surface stands in the world.

use crate::{Error, tolerance};
use glam::DVec3;

/// An origin and a right-handed orthonormal triple of axes, in world coordinates.
///
/// Every surface of this crate is written in the local coordinates of its frame: the symmetry planes are `y = 0` and
/// `z = 0`, and `x` is their common line.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "[DVec3; 4]", into = "[DVec3; 4]")
)]
pub struct Frame {
    origin: DVec3,
    x: DVec3,
    y: DVec3,
    z: DVec3,
}

impl Frame {
    /// The world's own frame.
    pub const WORLD: Self = Self {
        origin: DVec3::ZERO,
        x: DVec3::X,
        y: DVec3::Y,
        z: DVec3::Z,
    };

    /// A frame from its origin and three axes.
    ///
    /// The axes may be off by rounding, up to [`tolerance::FRAME`]; they are made orthonormal to the last bit by
    /// keeping the direction of `x` and the plane of `x` and `y`.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`] for NaN and infinities, [`Error::LengthOutOfRange`] for the origin, [`Error::NotAFrame`] for axes that are not a right-handed
    /// orthonormal triple.
    pub fn new(origin: DVec3, x: DVec3, y: DVec3, z: DVec3) -> Result<Self, Error> {
        place("frame origin", origin)?;
        for (what, vector) in [
            ("frame axis x", x),
            ("frame axis y", y),
            ("frame axis z", z),
        ] {
            finite_vector(what, vector)?;
        }
        let skew = [x.dot(y), y.dot(z), z.dot(x)];
        let stretch = [
            x.length_squared() - 1.0,
            y.length_squared() - 1.0,
            z.length_squared() - 1.0,
        ];
        let deviation = skew
            .iter()
            .chain(&stretch)
            .fold((x.cross(y) - z).length(), |worst, value| {
                worst.max(value.abs())
            });
        if deviation > tolerance::FRAME {
            return Err(Error::NotAFrame { deviation });
        }
        Self::from_directions(origin, x, y).ok_or(Error::NotAFrame { deviation })
    }

    /// The frame with the given `x` and with `y` as near as possible to the given direction, which need not be
    /// perpendicular; `None` if the two are parallel, zero or not finite, or the origin is out of range.
    #[must_use]
    pub fn from_directions(origin: DVec3, x: DVec3, y_hint: DVec3) -> Option<Self> {
        let (x, _) = direction(x)?;
        let (y_hint, _) = direction(y_hint)?;
        let y = (y_hint - y_hint.dot(x) * x).try_normalize()?;
        // A second pass removes what the first one rounded.
        let y = (y - y.dot(x) * x).try_normalize()?;
        place("frame origin", origin).is_ok().then_some(Self {
            origin,
            x,
            y,
            z: x.cross(y),
        })
    }

    /// Some frame with the given `z`; its `x` is an arbitrary perpendicular. `None` for a zero or infinite direction.
    #[must_use]
    pub fn around(origin: DVec3, z: DVec3) -> Option<Self> {
        let (z, _) = direction(z)?;
        let x = z.any_orthonormal_vector();
        Self::from_directions(origin, x, z.cross(x))
    }

    /// The origin, world coordinates.
    #[must_use]
    pub const fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The unit axis along which both symmetry planes meet.
    #[must_use]
    pub const fn x(&self) -> DVec3 {
        self.x
    }

    /// The second unit axis.
    #[must_use]
    pub const fn y(&self) -> DVec3 {
        self.y
    }

    /// The third unit axis, `x` cross `y`.
    #[must_use]
    pub const fn z(&self) -> DVec3 {
        self.z
    }

    /// World coordinates of a local point.
    #[inline]
    #[must_use]
    pub fn point_to_world(&self, local: DVec3) -> DVec3 {
        self.origin + self.vector_to_world(local)
    }

    /// Local coordinates of a world point.
    #[inline]
    #[must_use]
    pub fn point_to_local(&self, world: DVec3) -> DVec3 {
        self.vector_to_local(world - self.origin)
    }

    /// World coordinates of a local direction.
    #[inline]
    #[must_use]
    pub fn vector_to_world(&self, local: DVec3) -> DVec3 {
        local.x * self.x + local.y * self.y + local.z * self.z
    }

    /// Local coordinates of a world direction.
    #[inline]
    #[must_use]
    pub fn vector_to_local(&self, world: DVec3) -> DVec3 {
        DVec3::new(world.dot(self.x), world.dot(self.y), world.dot(self.z))
    }

    /// The same frame at another origin.
    #[must_use]
    pub(crate) const fn at(self, origin: DVec3) -> Self {
        Self { origin, ..self }
    }

    /// Turned by half a turn about its `y` axis: `x` and `z` change sign.
    #[must_use]
    pub(crate) fn turned_about_y(self) -> Self {
        Self {
            x: -self.x,
            z: -self.z,
            ..self
        }
    }

    /// Turned by half a turn about its `x` axis: `y` and `z` change sign.
    #[must_use]
    pub(crate) fn turned_about_x(self) -> Self {
        Self {
            y: -self.y,
            z: -self.z,
            ..self
        }
    }
}

impl Default for Frame {
    fn default() -> Self {
        Self::WORLD
    }
}

impl TryFrom<[DVec3; 4]> for Frame {
    type Error = Error;

    fn try_from([origin, x, y, z]: [DVec3; 4]) -> Result<Self, Error> {
        Self::new(origin, x, y, z)
    }
}

impl From<Frame> for [DVec3; 4] {
    fn from(frame: Frame) -> Self {
        [frame.origin, frame.x, frame.y, frame.z]
    }
}

/// The unit vector of a direction of any length, and the two factors of this length, each of which a double holds; `None` for a direction
/// that is zero or not finite.
pub(crate) fn direction(vector: DVec3) -> Option<(DVec3, [f64; 2])> {
    // The sum of squares of the largest component alone may overflow or vanish.
    let largest = vector.abs().max_element();
    if !(vector.is_finite() && largest > 0.0) {
        return None;
    }
    let within = vector / largest;
    let length = within.length();
    Some((within / length, [largest, length]))
}

/// Refuses NaN and infinities at the door.
pub(crate) fn finite(what: &'static str, value: f64) -> Result<f64, Error> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(Error::NotFinite { what, value })
    }
}

/// Refuses vectors with NaN or infinite coordinates at the door.
pub(crate) fn finite_vector(what: &'static str, vector: DVec3) -> Result<DVec3, Error> {
    for value in vector.to_array() {
        finite(what, value)?;
    }
    Ok(vector)
}

/// Refuses lengths whose fourth powers a double cannot hold, of either sign.
pub(crate) fn length(what: &'static str, value: f64) -> Result<f64, Error> {
    if finite(what, value)?.abs() <= tolerance::LARGEST_LENGTH {
        Ok(value)
    } else {
        Err(Error::LengthOutOfRange { what, value })
    }
}

/// As [`length`], for one that gives a surface its size: it must not be too small either, unless it is zero.
pub(crate) fn size(what: &'static str, value: f64) -> Result<f64, Error> {
    if value != 0.0 && value.abs() < 1.0 / tolerance::LARGEST_LENGTH {
        return Err(Error::LengthOutOfRange { what, value });
    }
    length(what, value)
}

/// Refuses places with a coordinate that is no [`length`].
pub(crate) fn place(what: &'static str, point: DVec3) -> Result<DVec3, Error> {
    for value in point.to_array() {
        length(what, value)?;
    }
    Ok(point)
}
