//! What is measured on the computed surfaces.

use std::f64::consts::TAU;

use anyhow::{Context as _, Result};
use glam::{DVec2, DVec3};
use lorentz::{CanalChain, CanalCurve, Course, TubeGrid};

/// The joints of the chain.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Joints {
    /// Largest angle between the unit normals of the two surfaces, over all points of all joint circles.
    pub(super) angle: f64,
    /// Largest distance between corresponding points.
    pub(super) gap: f64,
    pub(super) fold_backs: u32,
}

/// Points looked at on each joint's circle.
const POINTS_PER_CIRCLE: u32 = 64;

pub(super) fn joints(chain: &CanalChain) -> Result<Joints> {
    let mut found = Joints::default();
    for (arc, next) in chain.arcs().iter().zip(chain.arcs().iter().skip(1)) {
        let (end, start) = (arc.at(1.0), next.at(0.0));
        for k in 0..POINTS_PER_CIRCLE {
            let theta = TAU * f64::from(k) / f64::from(POINTS_PER_CIRCLE);
            let (p, q) = (
                end.surface_point(theta, DVec3::Y)?,
                start.surface_point(theta, DVec3::Y)?,
            );
            let angle = p
                .normal
                .cross(q.normal)
                .length()
                .atan2(p.normal.dot(q.normal));
            found.angle = found.angle.max(angle);
            found.gap = found.gap.max(p.position.distance(q.position));
        }
        found.fold_backs += u32::from(arc.joint_with(next)?.course == Course::FoldsBack);
    }
    Ok(found)
}

/// Largest deviation from the unit quadric along all curves, `X . X - w^2` in homogeneous form: divided by w^2 it would
/// only show how the sphere's vector grows where the tail ends in a point. The weights are of the order of one.
pub(super) fn off_unit_quadric<'a>(curves: impl IntoIterator<Item = &'a CanalCurve>) -> f64 {
    let along = |curve: &'a CanalCurve| (0..=256).map(|i| curve.at(f64::from(i) / 256.0).value());
    let members = curves.into_iter().flat_map(along);
    members
        .map(|b| (b.weighted.square() - b.weight * b.weight).abs())
        .fold(0.0, f64::max)
}

/// The outline of the body in the plane of symmetry y = 0, as a closed polygon in x and z: up one side from the tip of
/// the tail and down the other.
pub(super) fn silhouette(chain: &CanalChain, steps: usize) -> Result<Vec<DVec2>> {
    let (mut belly, mut back) = (Vec::new(), Vec::new());
    for arc in chain.arcs() {
        // Angles count from the y axis: of four points on a ring the second and the last are in the plane y = 0.
        let tube = arc.tessellate(&TubeGrid::new(steps, 4).with_reference(DVec3::Y))?;
        for ring in tube.positions().chunks_exact(4) {
            let &[_, one, _, other] = ring else {
                continue;
            };
            belly.push(DVec2::new(one.x, one.z));
            back.push(DVec2::new(other.x, other.z));
        }
    }
    back.reverse();
    belly.extend(back);
    belly.dedup_by(|a, b| a.distance(*b) < 1e-9);
    belly.first().context("an empty silhouette")?;
    Ok(belly)
}

/// Pairs of edges of a closed polygon that cross, neighbours apart.
pub(super) fn self_intersections(polygon: &[DVec2]) -> u32 {
    let count = polygon.len();
    let edges: Vec<[DVec2; 2]> = (0..count)
        .map(|i| [polygon[i], polygon[(i + 1) % count]])
        .collect();
    let mut crossings = 0;
    for (i, &[a, b]) in edges.iter().enumerate() {
        let (low, high) = (a.min(b), a.max(b));
        for (j, &[c, d]) in edges.iter().enumerate().skip(i + 2) {
            let neighbours = i == 0 && j + 1 == count;
            let apart = c.max(d).cmplt(low).any() || c.min(d).cmpgt(high).any();
            if !neighbours && !apart && separates(a, b, c, d) && separates(c, d, a, b) {
                crossings += 1;
            }
        }
    }
    crossings
}

/// Whether the line through `a` and `b` has `c` and `d` on different sides.
fn separates(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2| (b - a).perp_dot(p - a);
    side(c) * side(d) < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossings_of_a_bow_tie_and_of_a_square() {
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert_eq!(self_intersections(&square), 0);
        let bow_tie = [DVec2::ZERO, DVec2::ONE, DVec2::X, DVec2::Y];
        assert_eq!(self_intersections(&bow_tie), 1);
    }
}
