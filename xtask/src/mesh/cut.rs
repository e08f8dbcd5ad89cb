//! The part of a mesh on one side of a surface.

use std::collections::HashMap;

use glam::DVec3;

use super::Mesh;

impl Mesh {
    /// The part where `side` is not negative. Triangles across are cut, where `side` would vanish if it were linear along
    /// their edges, so that the rim is as smooth as the mesh is fine.
    #[must_use]
    pub fn cut(mut self, side: impl Fn(DVec3) -> f64) -> Self {
        let values: Vec<f64> = self.positions.iter().map(|&p| side(p)).collect();
        let is_kept = |vertex: u32| values[vertex as usize] >= 0.0;
        let mut rim = HashMap::new();
        let mut kept = Vec::with_capacity(self.triangles.len());
        for triangle in std::mem::take(&mut self.triangles) {
            let mut corners = Vec::with_capacity(4);
            for k in 0..3 {
                let (from, to) = (triangle[k], triangle[(k + 1) % 3]);
                if is_kept(from) {
                    corners.push(from);
                }
                if is_kept(from) != is_kept(to) {
                    let edge = [from.min(to), from.max(to)];
                    let vertex = *rim.entry(edge).or_insert_with(|| {
                        let [a, b] = edge.map(|end| values[end as usize]);
                        self.between(edge, a / (a - b))
                    });
                    corners.push(vertex);
                }
            }
            for k in 2..corners.len() {
                kept.push([corners[0], corners[k - 1], corners[k]]);
            }
        }
        self.triangles = kept;
        self
    }

    /// A new vertex on an edge, at the part `t` of the way.
    fn between(&mut self, edge: [u32; 2], t: f64) -> u32 {
        let [a, b] = edge.map(|end| end as usize);
        self.positions
            .push(self.positions[a].lerp(self.positions[b], t));
        let normal = self.normals[a].lerp(self.normals[b], t);
        self.normals.push(normal.normalize_or(self.normals[a]));
        if let Some(scalar) = &mut self.scalar {
            scalar.push(scalar[a] + (scalar[b] - scalar[a]) * t);
        }
        (self.positions.len() - 1) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_sphere_ends_on_the_equator() {
        let ball = Mesh::sphere(DVec3::ZERO, 1.0, 1e-3).with_scalar_at(|p| p.z);
        let half = ball.cut(|p| p.z - 0.01);
        half.check().unwrap();
        let area = |mesh: &Mesh| -> f64 {
            let corner = |i: u32| mesh.positions[i as usize];
            let twice = |t: &[u32; 3]| {
                let [a, b, c] = t.map(corner);
                (b - a).cross(c - a).length()
            };
            mesh.triangles.iter().map(twice).sum::<f64>() / 2.0
        };
        assert!((area(&half) / (std::f64::consts::TAU * 0.99) - 1.0).abs() < 2e-3);
        let lowest = half
            .triangles
            .iter()
            .flatten()
            .map(|&i| half.positions[i as usize].z)
            .fold(f64::INFINITY, f64::min);
        assert!((lowest - 0.01).abs() < 1e-12);
        for triangle in &half.triangles {
            let [a, b, c] = triangle.map(|i| half.positions[i as usize]);
            assert!((b - a).cross(c - a).dot(a + b + c) >= 0.0);
        }
    }

    #[test]
    fn a_mesh_on_one_side_stays_or_goes() {
        let ball = Mesh::sphere(DVec3::ZERO, 1.0, 1e-2);
        assert_eq!(ball.clone().cut(|_| 1.0), ball);
        assert!(ball.cut(|_| -1.0).triangles.is_empty());
    }
}
