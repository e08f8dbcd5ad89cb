//! Meshes of parametric surfaces, fine enough for a picture and no finer.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::Mesh;

/// No surface gets more steps than this in one direction.
const MOST_STEPS: usize = 4096;
/// Steps in each direction at which the bending of a surface is first looked at.
const FIRST_STEPS: usize = 16;
/// A triangle whose doubled area is below this part of its longest edge squared is a collapsed one: at
/// a pole the sine of pi leaves 1e-16 instead of zero.
const COLLAPSED: f64 = 1e-12;

impl Mesh {
    /// The surface `f` (position and unit normal at parameters in `[0, 1]`) on a regular grid of
    /// `u_steps` by `v_steps` cells.
    ///
    /// The normals point to the side of `f_u x f_v`, or the triangles are turned to their side.
    #[must_use]
    pub fn grid(u_steps: usize, v_steps: usize, f: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Self {
        let (u_steps, v_steps) = (u_steps.max(1), v_steps.max(1));
        let row = |j: usize| (0..=u_steps).map(move |i| (i, j));
        let (positions, normals) = (0..=v_steps)
            .flat_map(row)
            .map(|(i, j)| f(i as f64 / u_steps as f64, j as f64 / v_steps as f64))
            .unzip();
        Self::from_rows(u_steps + 1, positions, normals)
    }

    /// Vertices that were computed row by row, `row` of them in each, joined to cells. Each cell is cut
    /// along its shorter diagonal, and triangles without area (at a pole) are left out.
    #[must_use]
    pub fn from_rows(row: usize, positions: Vec<DVec3>, normals: Vec<DVec3>) -> Self {
        let rows = positions.len().checked_div(row).unwrap_or(0);
        let mut triangles = Vec::with_capacity(2 * row * rows);
        for j in 1..rows {
            for i in 1..row {
                let (a, b) = ((j - 1) * row + i - 1, (j - 1) * row + i);
                let (c, d) = (j * row + i, j * row + i - 1);
                let distance = |p: usize, q: usize| positions[p].distance_squared(positions[q]);
                let halves = if distance(a, c) <= distance(b, d) {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                for half in halves {
                    let [p, q, r] = half.map(|i| positions[i]);
                    let area = (q - p).cross(r - p);
                    let longest = (q - p).length_squared().max((r - p).length_squared());
                    if area.length() > COLLAPSED * longest {
                        let side = half
                            .iter()
                            .filter_map(|&i| normals.get(i))
                            .sum::<DVec3>()
                            .dot(area);
                        let [p, q, r] = half.map(|i| i as u32);
                        triangles.push(if side < 0.0 { [p, r, q] } else { [p, q, r] });
                    }
                }
            }
        }
        Self::new(positions, normals, triangles)
    }

    /// The surface `f` (position and unit normal at parameters in `[0, 1]`) on a grid so fine that
    /// edges and diagonals stay within `tolerance` (at a point, in world units) of the surface.
    ///
    /// With [`Camera::tolerance`](crate::render::Camera::tolerance) as the tolerance, facets cannot
    /// be seen: `Mesh::surface(|u, v| patch(u, v), |p| camera.tolerance(p, height))`.
    #[must_use]
    pub fn surface(
        f: impl Fn(f64, f64) -> (DVec3, DVec3),
        tolerance: impl Fn(DVec3) -> f64,
    ) -> Self {
        let [u_steps, v_steps] = steps(&|u, v| f(u, v).0, &tolerance);
        Self::grid(u_steps, v_steps, f)
    }

    /// A sphere, its chord error within `tolerance`.
    #[must_use]
    pub fn sphere(centre: DVec3, radius: f64, tolerance: f64) -> Self {
        let meridian = chord_steps(radius, PI * radius, tolerance).max(8);
        Self::grid(2 * meridian, meridian, |u, v| {
            let (azimuth, polar) = (TAU * u, PI * v);
            let (sin, cos) = polar.sin_cos();
            let normal = DVec3::new(sin * azimuth.cos(), sin * azimuth.sin(), cos);
            (centre + radius * normal, normal)
        })
    }
}

/// Steps into which an arc of `length` and radius of curvature `radius` is cut so that no chord is
/// further than `tolerance` from it: the height of a chord `c` is `c² / 8r`.
#[must_use]
pub fn chord_steps(radius: f64, length: f64, tolerance: f64) -> usize {
    let steps = (length / (8.0 * radius.abs() * tolerance).sqrt()).ceil();
    if steps.is_finite() {
        steps.clamp(1.0, MOST_STEPS as f64) as usize
    } else {
        1
    }
}

/// Steps in both directions: the heights of the chords on a first grid, which fall by the square of
/// the number of steps, and a look at the finer grids that follow.
fn steps(f: &impl Fn(f64, f64) -> DVec3, tolerance: &impl Fn(DVec3) -> f64) -> [usize; 2] {
    let mut steps = [FIRST_STEPS; 2];
    let mut least = [1; 2];
    for _ in 0..5 {
        let excess = excess(f, tolerance, steps);
        for axis in 0..2 {
            let wanted = (steps[axis] as f64 * excess[axis].sqrt() * 1.02).ceil();
            let wanted = wanted.clamp(least[axis] as f64, MOST_STEPS as f64) as usize;
            // A coarse grid may miss a bend: only the first look may make the grid coarser.
            least[axis] = wanted;
        }
        if steps == least {
            break;
        }
        steps = least;
    }
    steps
}

/// Largest height of a chord over half the tolerance (a diagonal adds up both directions).
fn excess(
    f: &impl Fn(f64, f64) -> DVec3,
    tolerance: &impl Fn(DVec3) -> f64,
    [u_steps, v_steps]: [usize; 2],
) -> [f64; 2] {
    // Lines across are sampled, lines along are followed in full.
    let lines = |steps: usize| (0..=steps.min(24)).map(move |k| k as f64 / steps.min(24) as f64);
    let mut worst = [0.0_f64; 2];
    let mut look = |axis: usize, a: DVec3, middle: DVec3, b: DVec3| {
        let height = middle.distance(0.5 * (a + b)) / (0.5 * tolerance(middle));
        if height.is_finite() {
            worst[axis] = worst[axis].max(height);
        }
    };
    let half = |i: usize, steps: usize| 0.5 * i as f64 / steps as f64;
    for v in lines(v_steps) {
        for i in 0..u_steps {
            let [a, m, b] = [0, 1, 2].map(|k| f(half(2 * i + k, u_steps), v));
            look(0, a, m, b);
        }
    }
    for u in lines(u_steps) {
        for j in 0..v_steps {
            let [a, m, b] = [0, 1, 2].map(|k| f(u, half(2 * j + k, v_steps)));
            look(1, a, m, b);
        }
    }
    worst
}
