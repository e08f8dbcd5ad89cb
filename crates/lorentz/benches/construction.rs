//! What the constructions cost: a curve from a circle and a sphere, a cone, a joint, a classification, a second family.
//!
//! `cargo bench -p lorentz --bench construction`

use divan::{Bencher, black_box};
use lorentz::glam::{DVec3, dvec3};
use lorentz::{CanalCurve, Plane, Sphere, SphereVector, construct};

fn main() {
    divan::main();
}

fn data() -> (SphereVector, SphereVector, SphereVector) {
    let start = Sphere::new(DVec3::ZERO, 1.0).unwrap();
    let plane = Plane::new(DVec3::Z, DVec3::ZERO).unwrap();
    let end = Sphere::new(dvec3(4.0, 0.0, 1.0), 1.5).unwrap();
    (start.into(), plane.into(), end.into())
}

fn arc() -> CanalCurve {
    let (start, plane, end) = data();
    construct::circle_to_sphere(start, plane, end)
        .unwrap()
        .curve
}

#[divan::bench]
fn circle_to_sphere(bencher: Bencher<'_, '_>) {
    let (start, plane, end) = data();
    bencher.bench_local(|| construct::circle_to_sphere(black_box(start), plane, end).unwrap());
}

#[divan::bench]
fn cone(bencher: Bencher<'_, '_>) {
    let sphere = Sphere::new(dvec3(2.0, 0.0, 16.0), 2.0).unwrap();
    bencher.bench_local(|| construct::cone(black_box(dvec3(-8.0, 0.0, 14.0)), sphere).unwrap());
}

#[divan::bench]
fn joint(bencher: Bencher<'_, '_>) {
    let (first, second) = arc().subdivide(0.4).unwrap();
    bencher.bench_local(|| black_box(&first).joint_with(&second).unwrap());
}

#[divan::bench]
fn classify(bencher: Bencher<'_, '_>) {
    let curve = *arc().curve();
    bencher.bench_local(|| black_box(&curve).classify());
}

#[divan::bench]
fn second_family(bencher: Bencher<'_, '_>) {
    let curve = arc();
    bencher.bench_local(|| black_box(&curve).second_family().conic().unwrap());
}
