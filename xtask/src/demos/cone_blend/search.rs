//! All blends with a given contact circle on the first cone, found in the axial plane without the construction.
//!
//! A cyclide touches the cones along circles with the diameters AB and CD exactly if the great circles of the two contact spheres, which touch the
//! skeletal lines at A, B and at C, D, are joined by two principal circles (or a line) with one orientation: `A - C` along `N_A - N_C` and
//! `B - D` along `N_B - N_D`, where N are the normals at these points (Shene, Lemmas 11 and 13). For each of the four choices of sides and
//! orientation this is two equations for the place of CD, each linear. Solutions whose two spheres touch each other are left out: the only surface
//! that touches both along circles is then the pair of these spheres (it occurs where the cones touch along a line).

use cyclide::Cone;
use cyclide::glam::DVec3;

/// One solution: the height of the contact circle on the second cone, from its reference point along its axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    pub(super) height: f64,
}

/// A skeletal line with what is needed of the sphere that touches it: point at the contact circle and unit normal.
#[derive(Clone, Copy)]
struct Touch {
    /// Contact point of the sphere that touches at height `h`: `at + h * along`.
    at: DVec3,
    along: DVec3,
    normal: DVec3,
}

/// The two skeletal lines of a cone in the plane with the given normal, with the normals of one orientation.
fn skeletal(cone: &Cone, plane_normal: DVec3, orientation: f64) -> [Touch; 2] {
    let (sin, cos) = cone.half_angle().sin_cos();
    let across = plane_normal.cross(cone.axis());
    [1.0, -1.0].map(|side| Touch {
        at: cone.point() + side * cone.radius() * across,
        along: cone.axis() + side * (sin / cos) * across,
        normal: orientation * (side * cos * across - sin * cone.axis()),
    })
}

/// All solutions for the contact circle at `height` on the first cone.
pub(super) fn search(cones: [&Cone; 2], plane_normal: DVec3, height: f64, size: f64) -> Vec<Found> {
    let mut found = Vec::new();
    let first = skeletal(cones[0], plane_normal, 1.0);
    for orientation in [1.0, -1.0] {
        let second = skeletal(cones[1], plane_normal, orientation);
        for pairing in [[0, 1], [1, 0]] {
            let pairs = [
                (first[0], second[pairing[0]]),
                (first[1], second[pairing[1]]),
            ];
            let equations = pairs.map(|(one, other)| equation(one, other, plane_normal, height));
            // The better conditioned equation is solved, the other one checked.
            let steepness = |(rate, _): &(f64, f64)| rate.abs();
            let (solve, check) = if steepness(&equations[0]) >= steepness(&equations[1]) {
                (equations[0], equations[1])
            } else {
                (equations[1], equations[0])
            };
            if solve.0.abs() < 1e-9 {
                continue;
            }
            let other = -solve.1 / solve.0;
            let near = 1e-7 * (size + other.abs() + height.abs());
            let spheres = [
                sphere(cones[0], 1.0, height),
                sphere(cones[1], orientation, other),
            ];
            let [(centre, radius), (other_centre, other_radius)] = spheres;
            let apart = centre.distance(other_centre);
            let touch = (apart - (radius - other_radius).abs()).abs() <= near;
            if (check.0 * other + check.1).abs() <= near && !touch {
                found.push(Found { height: other });
            }
        }
    }
    found
}

/// Centre and signed radius of the sphere that touches a cone in the plane at a height.
fn sphere(cone: &Cone, orientation: f64, height: f64) -> (DVec3, f64) {
    let (sin, cos) = cone.half_angle().sin_cos();
    let along = (height + cone.radius() * sin) / (cos * cos);
    (
        cone.point() + along * cone.axis(),
        orientation * (cone.radius() + along * sin),
    )
}

/// The linear equation `rate * h + constant = 0` for the height `h` on the second cone.
fn equation(one: Touch, other: Touch, plane_normal: DVec3, height: f64) -> (f64, f64) {
    let point = one.at + height * one.along;
    let difference = one.normal - other.normal;
    // Equal normals: both points are on one line, whatever the height, or never.
    let direction = if difference.length() < 1e-7 {
        plane_normal.cross(one.normal)
    } else {
        difference.normalize()
    };
    let across = |v: DVec3| v.cross(direction).dot(plane_normal);
    (across(-other.along), across(point - other.at))
}
