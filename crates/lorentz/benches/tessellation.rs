//! How fast a canal surface is laid out in vertices with normals, and how the cost grows with their number.
//!
//! `cargo bench -p lorentz --bench tessellation`; the counter is in vertices.

use divan::{Bencher, counter::ItemsCount};
use lorentz::glam::dvec3;
use lorentz::{CanalCurve, Plane, Spacing, Sphere, Tube, TubeGrid, construct};

fn main() {
    divan::main();
}

/// A ring cyclide's piece, from a circle to a sphere.
fn arc() -> CanalCurve {
    let start = Sphere::new(dvec3(0.0, 0.0, 0.0), 1.0).unwrap();
    let plane = Plane::new(dvec3(0.0, 0.0, 1.0), dvec3(0.0, 0.0, 0.0)).unwrap();
    let end = Sphere::new(dvec3(4.0, 0.0, 1.0), 1.5).unwrap();
    construct::circle_to_sphere(start.into(), plane.into(), end.into())
        .unwrap()
        .curve
}

/// Refilling a tube: nothing is allocated.
#[divan::bench(args = [16, 128, 1024], consts = [16, 64])]
fn refilled_by_parameter<const SECTORS: usize>(bencher: Bencher<'_, '_>, steps: usize) {
    run(
        bencher,
        TubeGrid::new(steps, SECTORS).with_spacing(Spacing::Parameter),
    );
}

/// Rings at equal distances cost four more passes over the rings.
#[divan::bench(args = [16, 128, 1024], consts = [16, 64])]
fn refilled_by_arc_length<const SECTORS: usize>(bencher: Bencher<'_, '_>, steps: usize) {
    run(bencher, TubeGrid::new(steps, SECTORS));
}

fn run(bencher: Bencher<'_, '_>, grid: TubeGrid) {
    let (curve, mut tube) = (arc(), Tube::default());
    bencher
        .counter(ItemsCount::new((grid.steps + 1) * grid.sectors))
        .bench_local(move || {
            curve.tessellate_into(&grid, &mut tube).unwrap();
            divan::black_box(tube.positions().len())
        });
}

/// A new tube each time: the price of fresh memory.
#[divan::bench(args = [16, 128, 1024])]
fn allocated(bencher: Bencher<'_, '_>, steps: usize) {
    let (curve, grid) = (
        arc(),
        TubeGrid::new(steps, 64).with_spacing(Spacing::Parameter),
    );
    bencher
        .counter(ItemsCount::new((steps + 1) * 64))
        .bench_local(|| curve.tessellate(&grid).unwrap());
}

/// One point at a time, frame and angle anew.
#[divan::bench]
fn surface_point(bencher: Bencher<'_, '_>) {
    let (curve, reference) = (arc(), arc().reference());
    bencher.counter(1_usize).bench_local(|| {
        curve
            .surface_point(divan::black_box(0.3), 1.0, reference)
            .unwrap()
    });
}
