//! Tubes along polygons: space curves as things that cast shadows.

use std::f64::consts::TAU;

use glam::DVec3;

use super::Mesh;

/// Corners of a tube's cross section.
const SIDES: usize = 16;

impl Mesh {
    /// A round tube along `points`, closed to a loop or with round-off ends. Points that repeat or are
    /// not finite are left out; fewer than two points give an empty mesh.
    #[must_use]
    pub fn tube(points: &[DVec3], radius: f64, closed: bool) -> Self {
        let mut points: Vec<DVec3> = points.iter().copied().filter(|p| p.is_finite()).collect();
        points.dedup();
        if closed && points.len() > 2 && points.first() == points.last() {
            points.pop();
        }
        let count = points.len();
        if count < 2 || (closed && count < 3) {
            return Self::default();
        }
        let tangents = tangents(&points, closed);
        let frames = frames(&points, &tangents, closed);
        let mut mesh = Self::default();
        let mut ring = |centre: DVec3, axial: DVec3, radial: f64, [u, v]: [DVec3; 2]| {
            for side in 0..=SIDES {
                let (sin, cos) = (TAU * side as f64 / SIDES as f64).sin_cos();
                let around = u * cos + v * sin;
                mesh.positions
                    .push(centre + radius * (radial * around + axial));
                mesh.normals
                    .push((radial * around + axial).normalize_or(around));
            }
        };
        // An end is a half sphere of a few rings.
        let cap = [0.0_f64, 0.35, 0.7, 1.0, 1.3];
        let (first, last) = (0, count - 1);
        if !closed {
            for angle in cap {
                ring(
                    points[first],
                    -tangents[first] * angle.cos(),
                    angle.sin(),
                    frames[first],
                );
            }
        }
        for i in 0..count {
            ring(points[i], DVec3::ZERO, 1.0, frames[i]);
        }
        if closed {
            // The last frame closes up with the first one: the twist was spread along the loop.
            ring(points[0], DVec3::ZERO, 1.0, frames[0]);
        } else {
            for angle in cap.into_iter().rev() {
                ring(
                    points[last],
                    tangents[last] * angle.cos(),
                    angle.sin(),
                    frames[last],
                );
            }
        }
        Self::from_rows(SIDES + 1, mesh.positions, mesh.normals)
    }
}

fn tangents(points: &[DVec3], closed: bool) -> Vec<DVec3> {
    let count = points.len();
    let tangent = |i: usize| {
        let before = if i > 0 {
            i - 1
        } else if closed {
            count - 1
        } else {
            0
        };
        let after = if i + 1 < count {
            i + 1
        } else if closed {
            0
        } else {
            i
        };
        let incoming = (points[i] - points[before]).normalize_or_zero();
        let outgoing = (points[after] - points[i]).normalize_or_zero();
        (incoming + outgoing).normalize_or(if incoming == DVec3::ZERO {
            outgoing
        } else {
            incoming
        })
    };
    (0..count).map(tangent).collect()
}

/// Frames that turn as little as possible (double reflection), across the tangents.
fn frames(points: &[DVec3], tangents: &[DVec3], closed: bool) -> Vec<[DVec3; 2]> {
    let mut u = tangents[0].any_orthonormal_vector();
    let mut frames = vec![[u, tangents[0].cross(u)]];
    let carry = |from: usize, to: usize, u: DVec3| {
        let reflect = |v: DVec3, normal: DVec3| match normal.length_squared() {
            0.0 => v,
            square => v - normal * (2.0 * v.dot(normal) / square),
        };
        let chord = points[to] - points[from];
        let (left_u, left_t) = (reflect(u, chord), reflect(tangents[from], chord));
        reflect(left_u, tangents[to] - left_t)
            .reject_from_normalized(tangents[to])
            .normalize_or(u)
    };
    for (i, tangent) in tangents.iter().enumerate().skip(1) {
        u = carry(i - 1, i, u);
        frames.push([u, tangent.cross(u)]);
    }
    if closed {
        // What the frame has turned after one round is taken back evenly.
        let back = carry(points.len() - 1, 0, u);
        let [first_u, first_v] = frames[0];
        let turned = back.dot(first_v).atan2(back.dot(first_u));
        let count = points.len() as f64;
        for (i, frame) in frames.iter_mut().enumerate() {
            let (sin, cos) = (-turned * i as f64 / count).sin_cos();
            let [u, v] = *frame;
            *frame = [u * cos + v * sin, v * cos - u * sin];
        }
    }
    frames
}
