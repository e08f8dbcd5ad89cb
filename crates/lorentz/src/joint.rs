use glam::DVec3;

use crate::canal::Ring;
use crate::relation::same_within;
use crate::tolerance::JOINT;
use crate::{CanalCurve, CanalMember, CharacteristicCircle, Error};

/// How the end of one canal curve meets the start of the next one.
///
/// Two canal surfaces join with a common tangent plane (G1) exactly if they share the sphere at the joint and the
/// circle on it: `sigma' = o sigma` and `d' = e d` with signs `o`, `e`. The product of the two derivative spheres
/// cannot decide this: it is also 1 if their difference is light-like, for two circles that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Joint {
    /// Whether both curves have the same sphere there: `Some(1.0)`, or `Some(-1.0)` with opposite orientations.
    pub same_sphere: Option<f64>,
    /// How the second surface goes on, if the joint is G1.
    pub course: Course,
    /// Greatest distance between corresponding points of the two characteristic circles, an upper bound; infinite
    /// between a circle and a line, and between different lines.
    pub gap: f64,
    /// Angle between the unit normals of the two surfaces along the common circle, in radians, orientation disregarded.
    /// It means something if `gap` is small.
    pub angle: f64,
    /// The product of the two derivative spheres: 1 or -1 at a G1 joint, but not only there.
    pub derivative_product: f64,
}

/// How a chain goes on across a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Course {
    /// G1, and the second surface continues on the other side of the circle.
    Continues,
    /// The tangent planes agree, but the second surface doubles back on the same side of the circle.
    FoldsBack,
    /// Not G1.
    Breaks,
}

impl Joint {
    /// Whether the tangent planes agree along the common circle: continuing or folding back.
    #[must_use]
    pub fn is_g1(&self) -> bool {
        self.course != Course::Breaks
    }

    /// 1 if the second surface continues, -1 if it folds back, 0 if the joint is not G1.
    #[must_use]
    pub const fn direction(&self) -> i8 {
        match self.course {
            Course::Continues => 1,
            Course::FoldsBack => -1,
            Course::Breaks => 0,
        }
    }
}

impl CanalCurve {
    /// How the end of this curve (t = 1) meets the start of the `next` one (t = 0).
    ///
    /// Spheres and circles are compared as such, in units of the circle's radius, so that the answer does not depend on
    /// the place of the joint in space.
    ///
    /// # Errors
    /// [`Error::SingularJoint`] if one of the curves has a vertex there.
    pub fn joint_with(&self, next: &Self) -> Result<Joint, Error> {
        let (end, start) = (self.at(1.0), next.at(0.0));
        let (Some(s), Some(d)) = (end.sphere(), end.derivative_sphere()) else {
            return Err(Error::SingularJoint);
        };
        let (Some(s2), Some(d2)) = (start.sphere(), start.derivative_sphere()) else {
            return Err(Error::SingularJoint);
        };
        let same_sphere = same_within(s, s2, JOINT);
        let derivative_product = d.product(d2);
        let Some(comparison) = compare(&end, &start) else {
            let gap = f64::INFINITY;
            return Ok(Joint {
                same_sphere,
                course: Course::Breaks,
                gap,
                angle: f64::NAN,
                derivative_product,
            });
        };
        let Comparison {
            gap,
            relative_gap,
            angle,
            direction,
        } = comparison;
        let g1 = same_sphere.is_some() && relative_gap <= JOINT && angle <= JOINT;
        let course = match (g1, direction > 0.0) {
            (false, _) => Course::Breaks,
            (true, true) => Course::Continues,
            (true, false) => Course::FoldsBack,
        };
        Ok(Joint {
            same_sphere,
            course,
            gap,
            angle,
            derivative_product,
        })
    }
}

struct Comparison {
    gap: f64,
    relative_gap: f64,
    angle: f64,
    direction: f64,
}

/// The two circles and the bands of normals along them.
fn compare(end: &CanalMember, start: &CanalMember) -> Option<Comparison> {
    match (end.ring(), start.ring()) {
        (Some(a), Some(b)) => Some(compare_rings(&a, &b)),
        (None, None) => compare_lines(end, start),
        _ => None,
    }
}

fn compare_rings(a: &Ring, b: &Ring) -> Comparison {
    let direction = a.axis.dot(b.axis).signum();
    let tilt = a.axis.distance(direction * b.axis);
    let gap =
        a.centre.distance(b.centre) + (a.radius - b.radius).abs() + a.radius.min(b.radius) * tilt;
    // Normals as (along the axis of a, outward), the second up to orientation.
    let (along, outward) = (direction * b.normal_along_axis, b.normal_outward);
    let cross = a.normal_along_axis * outward - a.normal_outward * along;
    let dot = a.normal_along_axis * along + a.normal_outward * outward;
    let angle = cross.abs().atan2(dot.abs());
    // The centres cannot be known better than their rounding.
    let rounding = 8.0 * f64::EPSILON * (a.centre.length() + b.centre.length());
    Comparison {
        gap,
        relative_gap: (gap - rounding).max(0.0) / a.radius,
        angle,
        direction,
    }
}

/// Lines of contact with two planes: same line, and the planes' normals.
fn compare_lines(end: &CanalMember, start: &CanalMember) -> Option<Comparison> {
    let (Ok(CharacteristicCircle::Line(a)), Ok(CharacteristicCircle::Line(b))) =
        (end.circle(), start.circle())
    else {
        return None;
    };
    let direction = a.direction().dot(b.direction()).signum();
    let tilt = a.direction().cross(b.direction()).length();
    let offset = a.nearest_to_origin().distance(b.nearest_to_origin());
    let size = a.nearest_to_origin().length().max(1.0);
    let normal = |member: &CanalMember| member.sphere().map(|s| s.vector().v);
    let (n, m) = (normal(end)?, normal(start)?);
    let same = tilt <= JOINT && offset <= JOINT * size;
    Some(Comparison {
        gap: if same { offset } else { f64::INFINITY },
        relative_gap: tilt.max(offset / size),
        angle: n.cross(m).length().atan2(n.dot(m).abs()),
        direction: direction * orientation(n, m),
    })
}

/// 1 or -1: the direction of a characteristic line is `s x d`, which reverses with the orientation of the plane.
fn orientation(n: DVec3, m: DVec3) -> f64 {
    n.dot(m).signum()
}
