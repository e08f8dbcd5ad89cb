//! How the cost of a query grows: with the distance of the two points, not with the mesh.
//!
//! `cargo bench -p geodesic --bench paths`

use divan::{Bencher, black_box};
use geodesic::glam::DVec3;
use geodesic::{GeodesicPath, Mesh, PathFinder, Start, Straightest, TriangleSoup, shapes};

fn main() {
    divan::main();
}

fn bumpy(level: u32) -> Mesh {
    let mut soup = TriangleSoup::from(shapes::sphere(level).expect("a sphere"));
    for p in &mut soup.positions {
        *p *= 1.0 + 0.1 * (9.0 * p.x).sin() * (8.0 * p.y).cos() + 0.05 * (15.0 * p.z).sin();
    }
    soup.try_into().expect("a bumpy sphere")
}

/// Checks and connectivity, by subdivision level: 320 triangles at level 2, four times more at each.
#[divan::bench(args = [2, 4, 6])]
fn build(bencher: Bencher<'_, '_>, level: u32) {
    let soup = TriangleSoup::from(bumpy(level));
    bencher.bench(|| Mesh::new(black_box(&soup.positions), &soup.faces));
}

/// Halfway round, by subdivision level.
#[divan::bench(args = [2, 4, 6])]
fn far(bencher: Bencher<'_, '_>, level: u32) {
    let mesh = bumpy(level);
    let mut finder = PathFinder::new(&mesh);
    bencher.bench_local(|| {
        finder
            .shortest(0.into(), 3.into())
            .map(GeodesicPath::length)
    });
}

/// About a tenth of that, on the same meshes.
#[divan::bench(args = [2, 4, 6])]
fn near(bencher: Bencher<'_, '_>, level: u32) {
    let mesh = bumpy(level);
    let start = mesh.positions()[0];
    let off = |v: &u32| (mesh.positions()[*v as usize].distance(start) - 0.25).abs();
    let to = (0..mesh.vertex_count() as u32).min_by(|a, b| off(a).total_cmp(&off(b)));
    let to = to.expect("a vertex");
    let mut finder = PathFinder::new(&mesh);
    bencher.bench_local(|| {
        finder
            .shortest(0.into(), to.into())
            .map(GeodesicPath::length)
    });
}

/// The three kinds of start, halfway round at level 5.
#[divan::bench(args = [Start::Vertices, Start::Edges, Start::Faces])]
fn start(bencher: Bencher<'_, '_>, start: Start) {
    let mesh = bumpy(5);
    let mut finder = PathFinder::new(&mesh).with_start(start);
    bencher.bench_local(|| {
        finder
            .shortest(0.into(), 3.into())
            .map(GeodesicPath::length)
    });
}

/// Once round by unfolding, by level.
#[divan::bench(args = [2, 4, 6])]
fn straightest(bencher: Bencher<'_, '_>, level: u32) {
    let mesh = bumpy(level);
    let tracer = Straightest::new(&mesh);
    let start = mesh.face_point(7, [0.5, 0.3, 0.2]).expect("a point");
    bencher.bench(|| tracer.trace(start, 7, DVec3::new(0.3, -0.8, 0.51), 6.0));
}
