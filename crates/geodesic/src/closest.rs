//! The point of a mesh closest to a point in space, by obvhs.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{Boundable, BvhBuildParams};

use crate::mesh::Mesh;
use crate::{Error, SurfacePoint};

/// Boxes are kept in `f32`, of the mesh moved to the origin and scaled to unit size, and widened by this: eight ulps of
/// the largest coordinate, so that no face sticks out of its box.
const PADDING: f32 = 8.0 * f32::EPSILON;

/// Answers closest-point queries on a mesh.
///
/// ```
/// use geodesic::{ClosestPoint, glam::DVec3, shapes};
/// let cube = shapes::cube()?;
/// let closest = ClosestPoint::new(&cube).find(DVec3::new(0.3, 0.6, 5.0))?;
/// assert!(closest.position.distance(DVec3::new(0.3, 0.6, 1.0)) < 1e-15);
/// assert!((closest.distance - 4.0).abs() < 1e-15);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone)]
pub struct ClosestPoint<'m> {
    mesh: &'m Mesh,
    bvh: Bvh2,
    centre: DVec3,
    scale: f64,
}

impl std::fmt::Debug for ClosestPoint<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ClosestPoint")
            .field("nodes", &self.bvh.nodes.len())
            .finish_non_exhaustive()
    }
}

/// The answer to a closest-point query.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Closest {
    /// The point on the mesh.
    pub point: SurfacePoint,
    /// A face that contains it.
    pub face: u32,
    /// Its position.
    pub position: DVec3,
    /// Its distance from the given point.
    pub distance: f64,
}

/// The box of a face.
struct FaceBox(Aabb);

impl Boundable for FaceBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl<'m> ClosestPoint<'m> {
    /// Builds the hierarchy of boxes, in time proportional to the number of faces and its logarithm.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        // A vertex of a face: others may lie anywhere.
        let centre = mesh.position(mesh.origin(0));
        let scale = 1.0 / mesh.diameter();
        let boxes: Vec<FaceBox> = mesh
            .faces()
            .iter()
            .map(|face| {
                let corners = face.map(|v| ((mesh.position(v) - centre) * scale).as_vec3a());
                let mut bounds = Aabb::from_points(&corners);
                bounds.min -= Vec3A::splat(PADDING);
                bounds.max += Vec3A::splat(PADDING);
                FaceBox(bounds)
            })
            .collect();
        let mut time = Duration::ZERO;
        let bvh = build_bvh2(&boxes, BvhBuildParams::fast_build(), &mut time);
        Self {
            mesh,
            bvh,
            centre,
            scale,
        }
    }

    /// The point of the mesh closest to `p`; of several, any one.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`] unless `p` is finite and its distance can be squared.
    pub fn find(&self, p: DVec3) -> Result<Closest, Error> {
        if !p.is_finite() {
            return Err(Error::NonFinite { what: "the point" });
        }
        let local = (p - self.centre) * self.scale;
        let mut best = (f64::INFINITY, 0, [0.0; 3]);
        let mut stack = vec![(0.0, 0)];
        while let Some((bound, node)) = stack.pop() {
            if bound > best.0 {
                continue;
            }
            let node = &self.bvh.nodes[node as usize];
            if node.is_leaf() {
                for slot in node.first_index..node.first_index + node.prim_count {
                    let face = self.bvh.primitive_indices[slot as usize];
                    let corners = self.mesh.faces()[face as usize].map(|v| self.mesh.position(v));
                    let barycentric = closest_in_triangle(p, corners);
                    let at: DVec3 = (0..3).map(|k| barycentric[k] * corners[k]).sum();
                    let distance = (at - p).length_squared() * self.scale * self.scale;
                    if distance < best.0 {
                        best = (distance, face, barycentric);
                    }
                }
            } else {
                let mut children = [node.first_index, node.first_index + 1].map(|child| {
                    let bounds = self.bvh.nodes[child as usize].aabb();
                    (
                        box_distance_squared(local, bounds.min.as_dvec3(), bounds.max.as_dvec3()),
                        child,
                    )
                });
                // The nearer child is looked at first.
                children.sort_by(|a, b| b.0.total_cmp(&a.0));
                stack.extend(children.into_iter().filter(|child| child.0 <= best.0));
            }
        }
        let (squared, face, barycentric) = best;
        if !squared.is_finite() {
            return Err(Error::NonFinite {
                what: "the distance of the point",
            });
        }
        let point = self.mesh.face_point(face, barycentric)?;
        let position = self.mesh.locate(point);
        Ok(Closest {
            point,
            face,
            position,
            distance: position.distance(p),
        })
    }
}

fn box_distance_squared(p: DVec3, low: DVec3, high: DVec3) -> f64 {
    (low - p).max(p - high).max(DVec3::ZERO).length_squared()
}

/// Barycentric coordinates of the point of a triangle closest to `p`: by the regions of its corners, sides and inside
/// (Ericson, *Real-Time Collision Detection*, Section 5.1.5).
fn closest_in_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, bc) = (b - a, c - a, c - b);
    let (along_ab, along_ac) = (ab.dot(p - a), ac.dot(p - a));
    if along_ab <= 0.0 && along_ac <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let (beyond_ab, b_along_ac) = (ab.dot(p - b), ac.dot(p - b));
    if beyond_ab >= 0.0 && b_along_ac <= beyond_ab {
        return [0.0, 1.0, 0.0];
    }
    let (c_along_ab, beyond_ac) = (ab.dot(p - c), ac.dot(p - c));
    if beyond_ac >= 0.0 && c_along_ab <= beyond_ac {
        return [0.0, 0.0, 1.0];
    }
    let weight_c = along_ab * b_along_ac - beyond_ab * along_ac;
    if weight_c <= 0.0 && along_ab >= 0.0 && beyond_ab <= 0.0 {
        let t = along_ab / (along_ab - beyond_ab);
        return [1.0 - t, t, 0.0];
    }
    let weight_b = c_along_ab * along_ac - along_ab * beyond_ac;
    if weight_b <= 0.0 && along_ac >= 0.0 && beyond_ac <= 0.0 {
        let t = along_ac / (along_ac - beyond_ac);
        return [1.0 - t, 0.0, t];
    }
    let weight_a = beyond_ab * beyond_ac - c_along_ab * b_along_ac;
    let (towards_c, towards_b) = (bc.dot(p - b), -bc.dot(p - c));
    if weight_a <= 0.0 && towards_c >= 0.0 && towards_b >= 0.0 {
        let t = towards_c / (towards_c + towards_b);
        return [0.0, 1.0 - t, t];
    }
    let sum = weight_a + weight_b + weight_c;
    [weight_a / sum, weight_b / sum, weight_c / sum]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn agrees_with_every_face_in_turn() {
        let mesh = shapes::plate(2, 1).unwrap();
        let closest = ClosestPoint::new(&mesh);
        let mut state = 5u64;
        let mut random = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for _ in 0..500 {
            let p = DVec3::new(
                8.0 * random() - 1.0,
                5.0 * random() - 1.0,
                4.0 * random() - 1.5,
            );
            let found = closest.find(p).unwrap();
            let best = (0..mesh.face_count())
                .map(|f| {
                    let corners = mesh.faces()[f].map(|v| mesh.position(v));
                    let weights = closest_in_triangle(p, corners);
                    (0..3)
                        .map(|k| weights[k] * corners[k])
                        .sum::<DVec3>()
                        .distance(p)
                })
                .fold(f64::INFINITY, f64::min);
            assert!((found.distance - best).abs() < 1e-12, "{found:?} {best}");
        }
    }

    #[test]
    fn far_and_broken_points() {
        let mesh = shapes::cube().unwrap();
        let closest = ClosestPoint::new(&mesh);
        assert_eq!(
            closest.find(DVec3::splat(1e6)).unwrap().position,
            DVec3::ONE
        );
        assert!(matches!(
            closest.find(DVec3::splat(1e300)),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            closest.find(DVec3::NAN),
            Err(Error::NonFinite { .. })
        ));
    }
}
