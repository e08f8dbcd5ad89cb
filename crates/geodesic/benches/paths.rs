//! How the cost of a query grows: with the distance of the two points, not with the mesh.
//!
//! The allocations beside the times show that a query makes none (a result that is kept aside) once the buffers have grown.
//!
//! `cargo bench -p geodesic --bench paths`

use divan::{Bencher, black_box};
use geodesic::glam::{DVec2, DVec3};
use geodesic::{GeodesicPath, Mesh, PathFinder, Start, Straightest, Sweep, TriangleSoup, shapes};

#[global_allocator]
static ALLOCATIONS: divan::AllocProfiler = divan::AllocProfiler::system();

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

/// Exact distances from one vertex to all, by level.
#[divan::bench(args = [2, 4, 6])]
fn exact_to_all(bencher: Bencher<'_, '_>, level: u32) {
    let mesh = bumpy(level);
    let mut sweep = Sweep::new(&mesh);
    bencher.bench_local(|| sweep.vertex_distances(&[0.into()]).map(<[f64]>::len));
}

/// The same, keeping what answers for any point of a face.
#[divan::bench(args = [2, 4, 6])]
fn exact_field(bencher: Bencher<'_, '_>, level: u32) {
    let mesh = bumpy(level);
    let mut sweep = Sweep::new(&mesh);
    bencher.bench_local(|| sweep.from_points(&[0.into()]).map(drop));
}

/// A terrain of `cells` by `cells` squares, all alike.
fn terrain(cells: u32) -> Mesh {
    let height =
        |x: f64, y: f64| (0.7 * x).sin() * (0.6 * y).cos() + 0.3 * (1.9 * x + 1.3 * y).sin();
    shapes::sheet(cells, cells, |p| p.extend(height(p.x, p.y))).expect("a terrain")
}

/// The vertex closest to a place seen from above.
fn vertex_at(mesh: &Mesh, x: f64, y: f64) -> u32 {
    let off = |v: &u32| {
        mesh.positions()[*v as usize]
            .truncate()
            .distance(DVec2::new(x, y))
    };
    (0..mesh.vertex_count() as u32)
        .min_by(|a, b| off(a).total_cmp(&off(b)))
        .expect("a vertex")
}

/// The exact distance of two points 20 cells apart in the middle of larger and larger meshes.
#[divan::bench(args = [50, 100, 200, 400])]
fn exact_pair_by_cells(bencher: Bencher<'_, '_>, cells: u32) {
    let mesh = terrain(cells);
    let middle = 0.5 * f64::from(cells);
    let from = vertex_at(&mesh, middle - 8.0, middle - 6.0);
    let to = vertex_at(&mesh, middle + 8.0, middle + 6.0);
    let mut sweep = Sweep::new(&mesh);
    bencher.bench_local(|| sweep.distance(from.into(), to.into()));
}

/// The exact distance of two points more and more cells apart on one mesh.
#[divan::bench(args = [5, 10, 20, 40, 80])]
fn exact_pair_by_distance(bencher: Bencher<'_, '_>, apart: u32) {
    let mesh = terrain(200);
    let from = vertex_at(&mesh, 60.0, 70.0);
    let to = vertex_at(
        &mesh,
        60.0 + 0.8 * f64::from(apart),
        70.0 + 0.6 * f64::from(apart),
    );
    let mut sweep = Sweep::new(&mesh);
    bencher.bench_local(|| sweep.distance(from.into(), to.into()));
}
