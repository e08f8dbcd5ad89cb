//! Twenty generated meshes, of the kinds that break path algorithms, and random points on them.

use std::f64::consts::TAU;

use geodesic::glam::DVec3;
use geodesic::{Mesh, SurfacePoint, TriangleSoup, shapes};

/// A small generator of random numbers: the same on every machine.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A whole number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }

    /// A number in `[0, 1)`.
    pub(crate) fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A point of any kind.
    pub(crate) fn point(&mut self, mesh: &Mesh) -> SurfacePoint {
        let face = self.below(mesh.face_count()) as u32;
        match self.below(4) {
            0 => SurfacePoint::Edge {
                halfedge: 3 * face + self.below(3) as u32,
                t: self.unit(),
            },
            1 => {
                let (a, b) = (self.unit(), self.unit());
                let (a, b) = if a + b > 1.0 {
                    (1.0 - a, 1.0 - b)
                } else {
                    (a, b)
                };
                SurfacePoint::Face {
                    face,
                    barycentric: [a, b, 1.0 - a - b],
                }
            }
            _ => SurfacePoint::Vertex(mesh.faces()[face as usize][self.below(3)]),
        }
    }
}

fn moved(mesh: &Mesh, mut by: impl FnMut(u32, DVec3) -> DVec3) -> Mesh {
    let mut soup = TriangleSoup::from(mesh.clone());
    for (v, p) in soup.positions.iter_mut().enumerate() {
        *p = by(v as u32, *p);
    }
    soup.try_into().unwrap()
}

fn without_faces(mesh: &Mesh, mut drop: impl FnMut(u32) -> bool) -> Mesh {
    let soup = TriangleSoup::from(mesh.clone());
    let faces = soup
        .faces
        .iter()
        .enumerate()
        .filter(|(f, _)| !drop(*f as u32))
        .map(|(_, face)| *face)
        .collect();
    TriangleSoup {
        positions: soup.positions,
        faces,
    }
    .repair()
    .unwrap()
    .mesh
}

/// The meshes, with names.
pub(crate) fn all() -> Vec<(String, Mesh)> {
    let mut random = Random(3);
    let mut list: Vec<(String, Mesh)> = Vec::new();
    let mut add = |name: &str, mesh: Mesh| list.push((name.to_owned(), mesh));
    add("cube", shapes::cube().unwrap());
    add("sphere", shapes::sphere(3).unwrap());
    for holes in 1..=5 {
        add(&format!("genus {holes}"), shapes::plate(holes, 1).unwrap());
    }
    add("torus", shapes::torus(2.0, 0.7, 40, 20).unwrap());
    add("flat", shapes::sheet(18, 18, |p| p.extend(0.0)).unwrap());
    add(
        "gentle terrain",
        shapes::sheet(24, 24, |p| p.extend((p.x / 3.0).sin() * (p.y / 4.0).cos())).unwrap(),
    );
    add(
        "rough terrain",
        shapes::sheet(24, 24, |p| p.extend(3.0 * random.unit())).unwrap(),
    );
    let thin = shapes::sheet(24, 24, |p| {
        DVec3::new(p.x, 1e-3 * p.y, 0.3 * (p.x + p.y).sin())
    });
    add("thin triangles", thin.unwrap());
    let needles = shapes::sheet(24, 24, |p| DVec3::new(p.x, 1e-6 * p.y, 0.0));
    add("needles", needles.unwrap());
    let sphere = shapes::sphere(3).unwrap();
    add(
        "noisy sphere",
        moved(&sphere, |_, p| p * (0.8 + 0.4 * random.unit())),
    );
    add(
        "spikes",
        moved(&sphere, |v, p| if v % 7 == 0 { 4.0 * p } else { p }),
    );
    add(
        "pits",
        moved(&sphere, |v, p| if v % 5 == 0 { 0.05 * p } else { p }),
    );
    add(
        "flattened",
        moved(&sphere, |_, p| DVec3::new(p.x, p.y, 1e-4 * p.z)),
    );
    let sieve = shapes::sheet(30, 30, |p| p.extend((0.4 * p.x).sin())).unwrap();
    add(
        "sieve",
        without_faces(&sieve, |f| (f / 2) % 30 % 4 == 1 && (f / 60) % 4 == 1),
    );
    let torn = shapes::torus(3.0, 1.0, 30, 16).unwrap();
    add("torn torus", without_faces(&torn, |_| random.unit() < 0.1));
    let saddle = |p: geodesic::glam::DVec2| {
        let (rho, phi) = (p.x + 1.0, TAU * p.y / 60.0);
        DVec3::new(rho * phi.cos(), rho * phi.sin(), rho * (5.0 * phi).sin())
    };
    add("hyperbolic fan", shapes::sheet(10, 59, saddle).unwrap());
    list
}
