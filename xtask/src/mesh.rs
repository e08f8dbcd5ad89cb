//! Tessellations: what the renderer draws and the exporters write.

mod build;
mod canal;
mod cut;
mod tube;

pub use build::chord_steps;

use anyhow::{Result, ensure};
use glam::{DAffine3, DVec3};

/// Triangles with a unit normal at every vertex, and perhaps a number at every vertex.
///
/// `f64` as everywhere; the renderer rounds at its own door. The number is what a colour map shows
/// and what the EXR layer of the scene holds: a geodesic distance, a curvature.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Unit normals, one per vertex.
    pub normals: Vec<DVec3>,
    /// Vertex numbers, counter-clockwise seen from the side to which the normals point.
    pub triangles: Vec<[u32; 3]>,
    /// One number per vertex, NaN where there is none.
    pub scalar: Option<Vec<f64>>,
}

impl Mesh {
    /// Triangles whose normals are known.
    #[must_use]
    pub const fn new(positions: Vec<DVec3>, normals: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        Self {
            positions,
            normals,
            triangles,
            scalar: None,
        }
    }

    /// Triangles whose normals are not known: each vertex takes the mean of its triangles' normals,
    /// weighted by their angles there. Corners that should stay sharp need vertices of their own.
    #[must_use]
    pub fn smooth(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut normals = vec![DVec3::ZERO; positions.len()];
        let at = |i: u32| positions.get(i as usize).copied().unwrap_or(DVec3::ZERO);
        for triangle in &triangles {
            let [a, b, c] = triangle.map(at);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let corners = [(b - a, c - a), (c - b, a - b), (a - c, b - c)];
            for (&vertex, (u, v)) in triangle.iter().zip(corners) {
                if let Some(sum) = normals.get_mut(vertex as usize) {
                    let angle = u.cross(v).length().atan2(u.dot(v));
                    *sum += normal * angle;
                }
            }
        }
        for normal in &mut normals {
            *normal = normal.normalize_or(DVec3::Z);
        }
        Self::new(positions, normals, triangles)
    }

    /// Triangles with flat faces: three vertices of its own for each.
    #[must_use]
    pub fn faceted(positions: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let mut mesh = Self::default();
        for triangle in triangles {
            let corners =
                triangle.map(|i| positions.get(i as usize).copied().unwrap_or(DVec3::NAN));
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(corners);
            mesh.normals.extend([normal; 3]);
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        mesh
    }

    /// The same with a number at every vertex.
    #[must_use]
    pub fn with_scalar(self, scalar: Vec<f64>) -> Self {
        Self {
            scalar: Some(scalar),
            ..self
        }
    }

    /// The same with a number computed from every vertex's position.
    #[must_use]
    pub fn with_scalar_at(self, f: impl FnMut(DVec3) -> f64) -> Self {
        let scalar = self.positions.iter().copied().map(f).collect();
        self.with_scalar(scalar)
    }

    /// Adds the triangles of `other`. Where only one of the two has numbers, the rest gets NaN.
    pub fn append(&mut self, other: Self) {
        let first = self.positions.len() as u32;
        if self.scalar.is_some() || other.scalar.is_some() {
            let mut scalar = self
                .scalar
                .take()
                .unwrap_or_else(|| vec![f64::NAN; self.positions.len()]);
            scalar.extend(
                other
                    .scalar
                    .unwrap_or_else(|| vec![f64::NAN; other.positions.len()]),
            );
            self.scalar = Some(scalar);
        }
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.triangles
            .extend(other.triangles.into_iter().map(|t| t.map(|i| i + first)));
    }

    /// All meshes as one.
    #[must_use]
    pub fn merged(meshes: impl IntoIterator<Item = Self>) -> Self {
        let mut all = Self::default();
        meshes.into_iter().for_each(|mesh| all.append(mesh));
        all
    }

    /// The mesh moved by an affine map; normals by its inverse transpose.
    #[must_use]
    pub fn transformed(mut self, map: DAffine3) -> Self {
        let normal_map = map.matrix3.inverse().transpose();
        for position in &mut self.positions {
            *position = map.transform_point3(*position);
        }
        for normal in &mut self.normals {
            *normal = (normal_map * *normal).normalize_or(DVec3::Z);
        }
        if map.matrix3.determinant() < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        self
    }

    /// The same with the other side in front.
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.normals.iter_mut().for_each(|n| *n = -*n);
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        self
    }

    /// The corners of the box around all vertices; `None` if there is none.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let low = self.positions.iter().copied().reduce(DVec3::min)?;
        let high = self.positions.iter().copied().reduce(DVec3::max)?;
        Some([low, high])
    }

    /// Area of all triangles.
    #[must_use]
    pub fn area(&self) -> f64 {
        let at = |i: u32| {
            self.positions
                .get(i as usize)
                .copied()
                .unwrap_or(DVec3::ZERO)
        };
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(at);
            0.5 * (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(area).sum()
    }

    /// Refuses what cannot be drawn or written.
    ///
    /// # Errors
    /// Counts that differ, vertex numbers out of range, positions or normals that are not finite.
    pub fn check(&self) -> Result<()> {
        let count = self.positions.len();
        ensure!(
            self.normals.len() == count,
            "{count} positions, {} normals",
            self.normals.len()
        );
        if let Some(scalar) = &self.scalar {
            ensure!(
                scalar.len() == count,
                "{count} positions, {} numbers",
                scalar.len()
            );
        }
        for (number, triangle) in self.triangles.iter().enumerate() {
            let inside = triangle.iter().all(|&i| (i as usize) < count);
            ensure!(
                inside,
                "triangle {number} {triangle:?} leaves the {count} vertices"
            );
        }
        for (number, (position, normal)) in self.positions.iter().zip(&self.normals).enumerate() {
            let finite = position.is_finite() && normal.is_finite();
            ensure!(
                finite,
                "vertex {number} at {position}, normal {normal}, is not finite"
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
