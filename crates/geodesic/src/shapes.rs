//! Meshes of simple shapes, for examples, tests and first steps.
//!
//! All are closed unless said otherwise, of one component, and oriented outward.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::mesh::TriangleSoup;
use crate::{Error, Mesh};

/// The unit cube `[0, 1]^3`: 8 vertices, 12 faces; vertex `x + 2 y + 4 z` lies at `(x, y, z)`.
///
/// # Errors
///
/// None in practice; the type says that every mesh passes the same checks.
pub fn cube() -> Result<Mesh, Error> {
    let corners: Vec<DVec3> = (0..8u32)
        .map(|v| DVec3::new(f64::from(v & 1), f64::from(v >> 1 & 1), f64::from(v >> 2)))
        .collect();
    let faces = [
        [0, 2, 3],
        [0, 3, 1],
        [4, 5, 7],
        [4, 7, 6],
        [0, 1, 5],
        [0, 5, 4],
        [2, 6, 7],
        [2, 7, 3],
        [0, 4, 6],
        [0, 6, 2],
        [1, 3, 7],
        [1, 7, 5],
    ];
    Mesh::new(&corners, &faces)
}

/// The unit sphere: an icosahedron whose faces are cut in four `level` times, vertices pushed out to the sphere.
///
/// `10 * 4^level + 2` vertices.
///
/// # Errors
///
/// [`Error::TooManyFaces`] above level 13.
pub fn sphere(level: u32) -> Result<Mesh, Error> {
    refuse_too_many(20u128.saturating_mul(4u128.saturating_pow(level)))?;
    let g = (1.0 + 5.0f64.sqrt()) / 2.0;
    let mut soup = TriangleSoup::default();
    for (a, b) in [(-1.0, -g), (1.0, -g), (-1.0, g), (1.0, g)] {
        soup.positions.extend([
            DVec3::new(0.0, a, b),
            DVec3::new(a, b, 0.0),
            DVec3::new(b, 0.0, a),
        ]);
    }
    for p in &mut soup.positions {
        *p = p.normalize();
    }
    // The twenty triples of vertices one edge apart, turned outward.
    let edge = 2.0 / (1.0 + g * g).sqrt();
    let near = |a: DVec3, b: DVec3| (a.distance(b) - edge).abs() < 1e-9;
    for i in 0..12u32 {
        for j in i + 1..12 {
            for k in j + 1..12 {
                let [a, b, c] = [i, j, k].map(|v| soup.positions[v as usize]);
                if near(a, b) && near(b, c) && near(c, a) {
                    soup.faces.push(if (b - a).cross(c - a).dot(a) > 0.0 {
                        [i, j, k]
                    } else {
                        [i, k, j]
                    });
                }
            }
        }
    }
    for _ in 0..level {
        soup = subdivide(&soup)?;
        for p in &mut soup.positions {
            *p = p.normalize();
        }
    }
    soup.try_into()
}

/// The torus around the z axis with radii `major > minor > 0`, as a grid of `around` by `tube` vertices.
///
/// Vertex `j * around + i` lies at angle `2π i / around` about the axis and `2π j / tube` around the tube, where 0 is
/// outermost; every cell is cut by the diagonal from `(i, j)` to `(i + 1, j + 1)`.
///
/// # Errors
///
/// Those of [`Mesh::new`], for fewer than 3 vertices around or radii that are not finite. [`Error::TooManyFaces`] comes before any memory is taken.
pub fn torus(major: f64, minor: f64, around: u32, tube: u32) -> Result<Mesh, Error> {
    let point = |i: u32, j: u32| {
        let (u, v) = (
            TAU * f64::from(i) / f64::from(around),
            TAU * f64::from(j) / f64::from(tube),
        );
        let rho = major + minor * v.cos();
        DVec3::new(rho * u.cos(), rho * u.sin(), minor * v.sin())
    };
    refuse_too_many(2 * u128::from(around) * u128::from(tube))?;
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for j in 0..tube {
        for i in 0..around {
            positions.push(point(i, j));
            let (right, up) = ((i + 1) % around, (j + 1) % tube);
            let [a, b, c, d] =
                [(i, j), (right, j), (right, up), (i, up)].map(|(i, j)| j * around + i);
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(&positions, &faces)
}

/// A sheet over the rectangle `[0, columns] x [0, rows]` with unit cells cut by the diagonal from `(i, j)` to
/// `(i + 1, j + 1)`: an open mesh. Vertex `j * (columns + 1) + i` lies at `surface((i, j))`.
///
/// # Errors
///
/// Those of [`Mesh::new`].
pub fn sheet(
    columns: u32,
    rows: u32,
    mut surface: impl FnMut(DVec2) -> DVec3,
) -> Result<Mesh, Error> {
    refuse_too_many(2 * u128::from(columns) * u128::from(rows))?;
    // A row without cells is no mesh, however long it is.
    if columns == 0 || rows == 0 {
        return Err(Error::EmptyMesh);
    }
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            positions.push(surface(DVec2::new(f64::from(i), f64::from(j))));
            if i < columns && j < rows {
                let a = j * (columns + 1) + i;
                let d = a + columns + 1;
                faces.extend([[a, a + 1, d + 1], [a, d + 1, d]]);
            }
        }
    }
    Mesh::new(&positions, &faces)
}

/// A rounded plate with `holes` holes in a row: a closed surface of that genus, each face of the unit cubes that it is
/// made of cut into `2 * 4^level` triangles.
///
/// # Errors
///
/// Those of [`Mesh::new`].
pub fn plate(holes: u32, level: u32) -> Result<Mesh, Error> {
    // 18 h + 14 sides of cubes are not shared.
    let triangles = 36 * u128::from(holes) + 28;
    refuse_too_many(triangles.saturating_mul(4u128.saturating_pow(level)))?;
    let solid = |x: i64, y: i64, z: i64| {
        let inside = (0..=2 * i64::from(holes)).contains(&x) && (0..3).contains(&y) && z == 0;
        inside && !(y == 1 && x % 2 == 1)
    };
    let mut soup = TriangleSoup::default();
    let mut numbers = HashMap::new();
    let mut number = |soup: &mut TriangleSoup, [x, y, z]: [i64; 3]| {
        *numbers.entry([x, y, z]).or_insert_with(|| {
            soup.positions
                .push(DVec3::new(x as f64, y as f64, z as f64));
            soup.positions.len() as u32 - 1
        })
    };
    for x in 0..=2 * i64::from(holes) {
        for y in (0..3).filter(|&y| solid(x, y, 0)) {
            for axis in 0..3 {
                for side in 0..2 {
                    let mut beyond = [x, y, 0];
                    beyond[axis] += 2 * side - 1;
                    if solid(beyond[0], beyond[1], beyond[2]) {
                        continue;
                    }
                    let (second, third) = ((axis + 1) % 3, (axis + 2) % 3);
                    let mut quad = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(s, t)| {
                        let mut corner = [x, y, 0];
                        corner[axis] += side;
                        corner[second] += s;
                        corner[third] += t;
                        number(&mut soup, corner)
                    });
                    if side == 0 {
                        quad.reverse();
                    }
                    let [a, b, c, d] = quad;
                    soup.faces.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    for _ in 0..level {
        soup = smooth(subdivide(&soup)?);
    }
    soup.try_into()
}

/// Every triangle cut in four at the midpoints of its edges. The first vertices are those of the given triangles.
///
/// # Errors
///
/// [`Error::IndexOutOfRange`]; [`Error::TooManyFaces`] if there would be.
pub fn subdivide(soup: &TriangleSoup) -> Result<TriangleSoup, Error> {
    refuse_too_many(4 * soup.faces.len() as u128)?;
    let vertices = soup.positions.len();
    for (face, corners) in soup.faces.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(Error::IndexOutOfRange {
                face: face as u32,
                vertex,
                vertices,
            });
        }
    }
    let mut fine = TriangleSoup {
        positions: soup.positions.clone(),
        faces: Vec::with_capacity(4 * soup.faces.len()),
    };
    let mut midpoints = HashMap::new();
    for &[a, b, c] in &soup.faces {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(u, v)| {
            *midpoints.entry((u.min(v), u.max(v))).or_insert_with(|| {
                fine.positions
                    .push(soup.positions[u as usize].midpoint(soup.positions[v as usize]));
                fine.positions.len() as u32 - 1
            })
        });
        fine.faces
            .extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    Ok(fine)
}

/// Refuses a number of faces that no mesh can have, before memory is taken for them.
fn refuse_too_many(faces: u128) -> Result<(), Error> {
    if faces >= u128::from(u32::MAX / 3) {
        let faces = usize::try_from(faces).unwrap_or(usize::MAX);
        return Err(Error::TooManyFaces { faces });
    }
    Ok(())
}

/// Every vertex moved half-way to the mean of its neighbours.
fn smooth(mut soup: TriangleSoup) -> TriangleSoup {
    let mut sums = vec![(DVec3::ZERO, 0.0); soup.positions.len()];
    for &[a, b, c] in &soup.faces {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sums[to as usize].0 += soup.positions[from as usize];
            sums[to as usize].1 += 1.0;
        }
    }
    for (p, (sum, count)) in soup.positions.iter_mut().zip(sums) {
        *p = p.midpoint(sum / f64::max(count, 1.0));
    }
    soup
}
