//! The plane of a conic in space.

use crate::conic_of_arc::heaviest;
use crate::{Conic, Error, MassPoint, Quadratic};
use glam::{DVec2, DVec3};

/// A curve that leaves a line by less than this fraction of its length is straight.
const STRAIGHT: f64 = 16.0 * f64::EPSILON;

/// Right-handed coordinates in a plane of space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlaneFrame {
    /// The origin of the plane coordinates.
    pub origin: DVec3,
    /// The unit vector of the first coordinate.
    pub x_axis: DVec3,
    /// The unit vector of the second coordinate, orthogonal to the first.
    pub y_axis: DVec3,
}

impl PlaneFrame {
    /// The unit normal of the plane.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.x_axis.cross(self.y_axis)
    }

    /// The plane coordinates of the foot of the perpendicular from a point.
    #[must_use]
    pub fn to_plane(&self, point: DVec3) -> DVec2 {
        self.direction_to_plane(point - self.origin)
    }

    /// The plane coordinates of a vector's part in the plane.
    #[must_use]
    pub fn direction_to_plane(&self, direction: DVec3) -> DVec2 {
        DVec2::new(self.x_axis.dot(direction), self.y_axis.dot(direction))
    }

    /// The point of space with these plane coordinates.
    #[must_use]
    pub fn to_space(&self, point: DVec2) -> DVec3 {
        self.origin + self.direction_to_space(point)
    }

    /// The vector of space with these plane coordinates.
    #[must_use]
    pub fn direction_to_space(&self, direction: DVec2) -> DVec3 {
        self.x_axis * direction.x + self.y_axis * direction.y
    }

    /// The mass point in plane coordinates.
    fn mass_point(&self, h: MassPoint<DVec3>) -> MassPoint<DVec2> {
        h.translated(-self.origin)
            .map_linear(|x| self.direction_to_plane(x))
    }
}

impl Quadratic<DVec3> {
    /// The plane of the curve: its origin is the control point of largest weight, its first axis leads to the control
    /// mass point farthest from there, and its normal is that of the control triangle. If the curve is straight it is
    /// one of the planes through it.
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if all control mass points are vectors.
    pub fn plane_frame(&self) -> Result<PlaneFrame, Error> {
        let origin = heaviest(self.control())
            .and_then(MassPoint::position)
            .ok_or(Error::AtInfinity { t: 0.0 })?;
        let offsets = self.control().map(|h| h.translated(-origin).weighted);
        let longest = |vectors: [DVec3; 3]| {
            vectors.into_iter().fold(
                DVec3::ZERO,
                |a, b| if b.length() > a.length() { b } else { a },
            )
        };
        let reach = longest(offsets);
        let x_axis = reach.try_normalize().unwrap_or(DVec3::X);
        // What is across the axis, unless it is rounding error: then the curve is straight and any plane will do.
        let across = longest(offsets.map(|offset| offset - x_axis * x_axis.dot(offset)));
        let across = if across.length() > STRAIGHT * reach.length() {
            across
        } else {
            x_axis.any_orthonormal_vector()
        };
        let y_axis = (across - x_axis * x_axis.dot(across)).normalize_or_zero();
        // The side that the triangle turns to, from the first to the last control mass point.
        let turn: DVec3 = [[0, 1], [1, 2], [2, 0]]
            .iter()
            .map(|&[i, j]| offsets[i].cross(offsets[j]))
            .sum();
        let y_axis = if turn.dot(x_axis.cross(y_axis)) < 0.0 {
            -y_axis
        } else {
            y_axis
        };
        Ok(PlaneFrame {
            origin,
            x_axis,
            y_axis,
        })
    }

    /// The conic that this curve is an arc of, in coordinates of its plane.
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if all control mass points are vectors.
    ///
    /// ```
    /// use bezier_mass::{Conic, Quadratic, glam::DVec3};
    /// let ends = [DVec3::new(3.0, 0.0, 1.0), DVec3::new(0.0, 3.0, 1.0)];
    /// let arc = Quadratic::circular_arc_about_axis(DVec3::Z, DVec3::Z, ends, [1.0, 1.0])?;
    /// let (frame, conic) = arc.conic_in_space()?;
    /// assert!(matches!(conic, Conic::Circle(circle) if (frame.to_space(circle.centre) - DVec3::Z).length() < 1e-14));
    /// # Ok::<(), bezier_mass::Error>(())
    /// ```
    pub fn conic_in_space(&self) -> Result<(PlaneFrame, Conic), Error> {
        let frame = self.plane_frame()?;
        Ok((frame, self.map(|h| frame.mass_point(h))?.conic()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Degenerate;
    use glam::{DQuat, dvec2, dvec3};

    #[test]
    fn a_conic_keeps_its_features_wherever_it_is_put_in_space() -> Result<(), Error> {
        let flat = Quadratic::new([
            MassPoint::point(dvec2(0.3, 0.1), 1.0),
            MassPoint::point(dvec2(1.0, 2.0), 0.5),
            MassPoint::point(dvec2(3.0, -0.5), 2.0),
        ])?;
        let (rotation, shift) = (
            DQuat::from_axis_angle(dvec3(1.0, 2.0, -0.5).normalize(), 1.1),
            dvec3(7.0, -3.0, 2.0),
        );
        let place = |p: DVec2| rotation * p.extend(0.0) + shift;
        let curve = flat.map(|h| h.map_linear(|x| rotation * x.extend(0.0)).translated(shift))?;
        let (frame, conic) = curve.conic_in_space()?;
        let (Conic::Ellipse(here), Conic::Ellipse(there)) = (flat.conic(), conic) else {
            panic!("{conic:?}")
        };
        assert!((frame.to_space(there.centre) - place(here.centre)).length() < 1e-14);
        for (a, b) in here.semi_axes().into_iter().zip(there.semi_axes()) {
            assert!((a - b).abs() < 1e-14);
        }
        let cosine = frame
            .direction_to_space(there.major_direction)
            .dot(rotation * here.major_direction.extend(0.0));
        assert!((cosine.abs() - 1.0).abs() < 1e-14);
        // The control triangle turns clockwise in its own plane, so the frame's normal is below.
        assert!((frame.normal() + rotation * DVec3::Z).length() < 1e-14);
        Ok(())
    }

    #[test]
    fn straight_and_infinite_curves() -> Result<(), Error> {
        let line = Quadratic::new([0.0, 1.0, 5.0].map(|x| MassPoint::point(DVec3::splat(x), 1.0)))?;
        let (frame, conic) = line.conic_in_space()?;
        assert!(frame.x_axis.dot(frame.y_axis).abs() < 1e-15);
        assert!(
            matches!(conic, Conic::Degenerate(Degenerate::Line { .. })),
            "{conic:?}"
        );
        let point = Quadratic::new([MassPoint::point(DVec3::ONE, 1.0); 3])?;
        assert_eq!(
            point.conic_in_space()?.1,
            Conic::Degenerate(Degenerate::Point(DVec2::ZERO))
        );
        let infinite = Quadratic::new([DVec3::X, DVec3::Y, DVec3::Z].map(MassPoint::vector))?;
        assert!(matches!(
            infinite.conic_in_space(),
            Err(Error::AtInfinity { .. })
        ));
        Ok(())
    }
}
