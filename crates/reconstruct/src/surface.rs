//! Surfaces: points, derivatives, curvature, geodesic boundaries, triangles.

use bezier_mass::{BezierPatch, Partials};
use glam::DVec3;

/// A parametric surface with exact derivatives to second order.
pub trait Surface {
    /// Position and partial derivatives at `(u, v)`.
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3>;

    /// The point at `(u, v)`.
    fn point(&self, u: f64, v: f64) -> DVec3 {
        self.partials(u, v).position
    }

    /// The unit normal along `R_u x R_v`; zero where the surface is singular.
    fn normal(&self, u: f64, v: f64) -> DVec3 {
        let at = self.partials(u, v);
        at.du.cross(at.dv).normalize_or_zero()
    }

    /// Gaussian and mean curvature at `(u, v)`; not finite where the surface is singular.
    fn curvatures(&self, u: f64, v: f64) -> Curvatures {
        Curvatures::of(&self.partials(u, v))
    }
}

/// The curvatures of a surface at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Curvatures {
    /// Gaussian curvature, one over length squared.
    pub gaussian: f64,
    /// Mean curvature with respect to the normal along `R_u x R_v`, one over length.
    pub mean: f64,
}

impl Curvatures {
    /// From the first and second fundamental forms.
    #[must_use]
    pub fn of(at: &Partials<DVec3>) -> Self {
        let cross = at.du.cross(at.dv);
        let area = cross.length_squared();
        let normal = cross / area.sqrt();
        let [e, f, g] = [at.du.dot(at.du), at.du.dot(at.dv), at.dv.dot(at.dv)];
        let [l, m, n] = [at.duu, at.duv, at.dvv].map(|second| second.dot(normal));
        Self {
            gaussian: (l * n - m * m) / area,
            mean: 0.5 * (e * n - 2.0 * f * m + g * l) / area,
        }
    }
}

impl Surface for BezierPatch<DVec3> {
    /// Not finite where the weight vanishes.
    fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
        let nowhere = DVec3::NAN;
        self.jet(u, v).partials().unwrap_or(Partials {
            position: nowhere,
            du: nowhere,
            dv: nowhere,
            duu: nowhere,
            duv: nowhere,
            dvv: nowhere,
        })
    }
}

/// The geodesic curvature of a curve with these derivatives on a surface with this normal (of any length):
/// `(r' x r'') . N / |r'|^3`, one over length. Equations (3.5) of the thesis chapter.
#[must_use]
pub fn geodesic_curvature(velocity: DVec3, acceleration: DVec3, normal: DVec3) -> f64 {
    velocity.cross(acceleration).dot(normal.normalize_or_zero()) / velocity.length().powi(3)
}

/// The largest geodesic curvature of the four boundaries of a surface over the unit square, relative to
/// `1/length + curvature` of the boundary, `length` its mean speed; each is sampled at `samples + 1`
/// parameters. Zero for a boundary that is a geodesic; of order one for one that is not.
pub fn boundary_geodesic_curvature(surface: &impl Surface, samples: usize) -> f64 {
    let n = samples.max(1);
    let mut worst: f64 = 0.0;
    for side in 0..4 {
        let along: Vec<_> = (0..=n)
            .map(|i| {
                let t = i as f64 / n as f64;
                let [u, v] = [[t, 0.0], [0.0, t], [t, 1.0], [1.0, t]][side];
                let at = surface.partials(u, v);
                let (first, second) = if side % 2 == 0 {
                    (at.du, at.duu)
                } else {
                    (at.dv, at.dvv)
                };
                (first, second, at.du.cross(at.dv))
            })
            .collect();
        let length = along
            .iter()
            .map(|(velocity, ..)| velocity.length())
            .sum::<f64>()
            / along.len() as f64;
        for (velocity, acceleration, normal) in along {
            let curvature = velocity.cross(acceleration).length() / velocity.length().powi(3);
            let relative = geodesic_curvature(velocity, acceleration, normal).abs()
                / (1.0 / length + curvature);
            // A boundary that is not even finite is as far from a geodesic as can be.
            worst = worst.max(if relative.is_finite() {
                relative
            } else {
                f64::INFINITY
            });
        }
    }
    worst
}

/// A triangle mesh of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tessellation {
    /// Points of the surface.
    pub points: Vec<DVec3>,
    /// Its unit normals at them.
    pub normals: Vec<DVec3>,
    /// Parameters `(u, v)` of the points.
    pub parameters: Vec<[f64; 2]>,
    /// Triangles as indices, counter-clockwise about the normals.
    pub triangles: Vec<[usize; 3]>,
}

/// A surface over the unit square cut into `2 rows columns` triangles.
pub fn tessellate(surface: &impl Surface, rows: usize, columns: usize) -> Tessellation {
    let (rows, columns) = (rows.max(1), columns.max(1));
    let mut mesh = Tessellation::default();
    for i in 0..=rows {
        for j in 0..=columns {
            push_vertex(
                &mut mesh,
                surface,
                [i as f64 / rows as f64, j as f64 / columns as f64],
            );
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            let a = i * (columns + 1) + j;
            let b = a + columns + 1;
            mesh.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }
    mesh
}

/// A surface over the triangle `u, v >= 0, u + v <= 1` cut into `n²` triangles.
pub fn tessellate_triangle(surface: &impl Surface, n: usize) -> Tessellation {
    let n = n.max(1);
    let mut mesh = Tessellation::default();
    let mut row = 0;
    for i in 0..=n {
        for j in 0..=n - i {
            push_vertex(
                &mut mesh,
                surface,
                [i as f64 / n as f64, j as f64 / n as f64],
            );
        }
        let next = row + n - i + 1;
        for j in 0..n - i {
            mesh.triangles.push([row + j, next + j, row + j + 1]);
            if j + 1 < n - i {
                mesh.triangles.push([next + j, next + j + 1, row + j + 1]);
            }
        }
        row = next;
    }
    mesh
}

fn push_vertex(mesh: &mut Tessellation, surface: &impl Surface, [u, v]: [f64; 2]) {
    let at = surface.partials(u, v);
    mesh.points.push(at.position);
    mesh.normals.push(at.du.cross(at.dv).normalize_or_zero());
    mesh.parameters.push([u, v]);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A paraboloid `z = (x² + 3 y²) / 2` over the unit square.
    struct Paraboloid;
    impl Surface for Paraboloid {
        fn partials(&self, u: f64, v: f64) -> Partials<DVec3> {
            Partials {
                position: DVec3::new(u, v, 0.5 * (u * u + 3.0 * v * v)),
                du: DVec3::new(1.0, 0.0, u),
                dv: DVec3::new(0.0, 1.0, 3.0 * v),
                duu: DVec3::Z,
                duv: DVec3::ZERO,
                dvv: DVec3::Z * 3.0,
            }
        }
    }

    #[test]
    fn curvatures_at_a_vertex() {
        let curvatures = Paraboloid.curvatures(0.0, 0.0);
        assert_eq!(
            curvatures,
            Curvatures {
                gaussian: 3.0,
                mean: 2.0
            }
        );
        // The meridians through the vertex are geodesics, the other two boundaries are not.
        assert!(boundary_geodesic_curvature(&Paraboloid, 8) > 0.1);
    }

    #[test]
    fn meshes_cover_their_domains_counter_clockwise() {
        for (mesh, area) in [
            (tessellate(&Paraboloid, 3, 5), 1.0),
            (tessellate_triangle(&Paraboloid, 4), 0.5),
        ] {
            let mut sum = 0.0;
            for [a, b, c] in &mesh.triangles {
                let [a, b, c] = [a, b, c].map(|i| glam::DVec2::from_array(mesh.parameters[*i]));
                let twice = (b - a).perp_dot(c - a);
                assert!(twice > 0.0);
                sum += 0.5 * twice;
            }
            assert!((sum - area).abs() < 1e-14);
        }
        assert_eq!(tessellate_triangle(&Paraboloid, 4).triangles.len(), 16);
    }
}
