//! Adapted frames along space curves, and the double reflection method.

use glam::DVec3;

use super::Quaternion;
use crate::Error;

/// A right-handed orthonormal frame whose first vector is the tangent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Frame {
    /// The unit tangent.
    pub tangent: DVec3,
    /// The first transversal vector `f2`.
    pub second: DVec3,
    /// The second transversal vector `f3 = tangent x f2`.
    pub third: DVec3,
}

impl Frame {
    /// The frame with this tangent whose `second` is nearest to `reference`.
    ///
    /// # Errors
    ///
    /// [`Error::ZeroDirection`] if the tangent vanishes or the reference is parallel to it.
    pub fn try_new(tangent: DVec3, reference: DVec3) -> Result<Self, Error> {
        let tangent = tangent.try_normalize().ok_or(Error::ZeroDirection {
            what: "tangent of a frame",
        })?;
        let second = reference.reject_from_normalized(tangent);
        let second = second.try_normalize().ok_or(Error::ZeroDirection {
            what: "reference of a frame across the tangent",
        })?;
        Ok(Self {
            tangent,
            second,
            third: tangent.cross(second),
        })
    }

    /// The images of `i`, `j`, `k` under `A . A*`, normalised.
    pub(super) fn of_quaternion(a: Quaternion) -> Result<Self, Error> {
        let norm = a.norm_squared();
        if norm.is_nan() || norm <= 0.0 {
            return Err(Error::ZeroDirection {
                what: "tangent where the speed vanishes",
            });
        }
        let image = |axis| a.image(axis) / norm;
        Ok(Self {
            tangent: image(DVec3::X),
            second: image(DVec3::Y),
            third: image(DVec3::Z),
        })
    }

    /// The frame turned about its tangent by `angle`, from `second` towards `third`.
    #[must_use]
    pub fn turned(self, angle: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        Self {
            tangent: self.tangent,
            second: cosine * self.second + sine * self.third,
            third: cosine * self.third - sine * self.second,
        }
    }

    /// The angle about the tangent from this frame's `second` to the other's, in `(-π, π]`.
    #[must_use]
    pub fn angle_to(&self, other: &Self) -> f64 {
        other
            .second
            .dot(self.third)
            .atan2(other.second.dot(self.second))
    }
}

/// Carries `first` along a curve without turning about the tangent: the double reflection method of Wang, Jüttler,
/// Zheng and Liu (2008). `samples` are points and unit tangents; the first one belongs to `first`, and the result has
/// one frame a sample.
///
/// The error of the end frame is of order 4 in the step.
///
/// # Errors
///
/// [`Error::NonFinite`]; [`Error::ZeroDirection`] for a zero tangent, and where no transport is defined: if a tangent is
/// opposite to its predecessor at the same point, or is its mirror image in the bisecting plane of the two points (as on
/// a step straight ahead after which the curve turns back).
pub fn rotation_minimising_frames(
    first: Frame,
    samples: impl IntoIterator<Item = (DVec3, DVec3)>,
) -> Result<Vec<Frame>, Error> {
    let mut frames: Vec<Frame> = Vec::new();
    let mut previous: Option<(DVec3, Frame)> = None;
    for (point, tangent) in samples {
        if !point.is_finite() || !tangent.is_finite() {
            return Err(Error::NonFinite {
                what: "sample of a curve",
            });
        }
        let frame = match previous {
            None => Frame::try_new(tangent, first.second)?,
            Some((before, frame)) => carried(before, frame, point, tangent)?,
        };
        frames.push(frame);
        previous = Some((point, frame));
    }
    Ok(frames)
}

/// A reflected tangent this near to the new one does not tell the plane of the second reflection: its normal would have
/// lost half its digits.
const TURNING_BACK: f64 = 1e-8;

/// One step: a reflection in the bisecting plane of the two points, then one that takes the reflected tangent to the new
/// one. At a repeated point the first plane is that across the sum of the tangents, and both together are the smallest
/// rotation of one tangent to the other.
fn carried(before: DVec3, frame: Frame, point: DVec3, tangent: DVec3) -> Result<Frame, Error> {
    let tangent = direction(tangent).ok_or(Error::ZeroDirection {
        what: "tangent of a curve",
    })?;
    let sum = frame.tangent + tangent;
    let turning_back = Error::ZeroDirection {
        what: "turn of a tangent that turns back on itself",
    };
    let first = match direction(point - before) {
        Some(chord) => chord,
        None if sum.length() > TURNING_BACK => sum.normalize(),
        None => return Err(turning_back),
    };
    let turn = tangent - reflected(frame.tangent, first);
    if turn.length() <= TURNING_BACK {
        return Err(turning_back);
    }
    let second = reflected(frame.second, first);
    Frame::try_new(tangent, reflected(second, turn.normalize()))
}

/// The unit vector of this direction, of any size that is a number; none for zero.
pub(super) fn direction(vector: DVec3) -> Option<DVec3> {
    (vector / vector.abs().max_element()).try_normalize()
}

/// The length of a vector of any size, whose square may overflow.
pub(super) fn length(vector: DVec3) -> f64 {
    vector.x.hypot(vector.y).hypot(vector.z)
}

/// The reflection of `vector` in the plane orthogonal to a unit vector.
fn reflected(vector: DVec3, normal: DVec3) -> DVec3 {
    vector - 2.0 * vector.dot(normal) * normal
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn helix(t: f64) -> (DVec3, DVec3) {
        let (sine, cosine) = (TAU * t).sin_cos();
        let tangent = DVec3::new(-TAU * sine, TAU * cosine, 1.0).normalize();
        (DVec3::new(cosine, sine, t), tangent)
    }

    /// On a helix of curvature κ and torsion τ a rotation-minimising frame falls back behind Frenet's by τ times the length.
    #[test]
    fn the_angle_on_a_helix_is_the_total_torsion_with_order_four() {
        let speed = TAU.hypot(1.0);
        let exact = -(TAU / (speed * speed)) * speed;
        let error = |steps: u32| {
            let normal = |t: f64| -DVec3::new((TAU * t).cos(), (TAU * t).sin(), 0.0);
            let start = Frame::try_new(helix(0.0).1, normal(0.0)).unwrap();
            let samples = (0..=steps).map(|i| helix(f64::from(i) / f64::from(steps)));
            let frames = rotation_minimising_frames(start, samples).unwrap();
            let frenet = Frame::try_new(helix(1.0).1, normal(1.0)).unwrap();
            (frenet.angle_to(frames.last().unwrap()) - exact).abs()
        };
        assert!(error(200) < 1e-8);
        let order = (error(50) / error(100)).log2();
        assert!((order - 4.0).abs() < 0.1, "order {order}");
    }

    /// A repeated point is the limit of a short chord along the sum of the tangents.
    #[test]
    fn at_a_repeated_point_the_frame_turns_with_the_tangent() {
        let start = Frame::try_new(DVec3::X, DVec3::Y).unwrap();
        let frames =
            rotation_minimising_frames(start, [(DVec3::ZERO, DVec3::X), (DVec3::ZERO, DVec3::Y)])
                .unwrap();
        assert!((frames[1].second - DVec3::NEG_X).length() < 1e-15);
        assert!((frames[1].third - DVec3::Z).length() < 1e-15);
        // So it is at a chord too long or too short to be squared.
        for size in [1e-300, 1.0, 1e300] {
            let chord = size * DVec3::new(1.0, 1.0, 0.0);
            let samples = [(DVec3::ZERO, DVec3::X), (chord, DVec3::Y)];
            let frames = rotation_minimising_frames(start, samples).unwrap();
            assert!((frames[1].second - DVec3::NEG_X).length() < 1e-15);
        }
    }

    #[test]
    fn a_tangent_that_turns_back_is_refused_where_no_frame_is_determined() {
        let start = Frame::try_new(DVec3::X, DVec3::Y).unwrap();
        for point in [DVec3::ZERO, DVec3::X] {
            let samples = [(DVec3::ZERO, DVec3::X), (point, DVec3::NEG_X)];
            assert!(matches!(
                rotation_minimising_frames(start, samples),
                Err(Error::ZeroDirection { .. })
            ));
        }
        // Half a turn around a circle.
        let samples = [(DVec3::ZERO, DVec3::X), (DVec3::Y, DVec3::NEG_X)];
        let frames = rotation_minimising_frames(start, samples).unwrap();
        assert!((frames[1].second - DVec3::NEG_Y).length() < 1e-15);
    }

    #[test]
    fn hostile_samples_are_refused() {
        let start = Frame::try_new(DVec3::X, DVec3::Y).unwrap();
        assert!(Frame::try_new(DVec3::X, DVec3::X).is_err());
        assert!(Frame::try_new(DVec3::ZERO, DVec3::X).is_err());
        assert!(rotation_minimising_frames(start, [(DVec3::NAN, DVec3::X)]).is_err());
        assert!(rotation_minimising_frames(start, []).unwrap().is_empty());
    }
}
