//! Points, parameters, distances, rays and patches of one surface.
#![expect(
    clippy::unwrap_used,
    reason = "the data of a bench are known to be good"
)]

use cyclide::glam::DVec3;
use cyclide::{Dupin, Frame, RayCaster, convert, convert_torus, inspect};
use divan::{Bencher, black_box, counter::ItemsCount};

fn main() {
    divan::main();
}

fn ring() -> Dupin {
    Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD).unwrap()
}

#[divan::bench]
fn point(bencher: Bencher<'_, '_>) {
    let ring = ring();
    bencher.bench(|| ring.point(black_box(0.7), black_box(1.9)));
}

#[divan::bench]
fn patch_point(bencher: Bencher<'_, '_>) {
    let patch = ring().patch([0.3, 1.7], [0.4, 1.9]).unwrap();
    bencher.bench(|| patch.net().point(black_box(0.3), black_box(0.6)));
}

#[divan::bench]
fn parameters_of_a_point(bencher: Bencher<'_, '_>) {
    let ring = ring();
    let point = ring.point(0.7, 1.9);
    bencher.bench(|| ring.parameters_at(black_box(point)));
}

#[divan::bench]
fn closest_point(bencher: Bencher<'_, '_>) {
    let ring = ring();
    bencher.bench(|| ring.closest(black_box(DVec3::new(4.3, -1.2, 0.9))));
}

/// Rays through random points of the bounding sphere: about half of them meet the ring.
#[divan::bench(args = [1024])]
fn rays(bencher: Bencher<'_, '_>, count: usize) {
    let ring = ring();
    let mut state = 1_u64;
    let mut unit = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let rays: Vec<(DVec3, DVec3)> = (0..count)
        .map(|_| {
            let from = DVec3::new(unit(), unit(), unit()).normalize() * 9.0;
            let to = DVec3::new(unit(), unit(), unit()) * 4.0;
            (from, (to - from).normalize())
        })
        .collect();
    bencher.counter(ItemsCount::new(count)).bench(|| {
        let mut caster = RayCaster::new(ring);
        rays.iter()
            .filter_map(|&(origin, direction)| caster.intersect(origin, direction).ok())
            .map(|hits| hits.len())
            .sum::<usize>()
    });
}

#[divan::bench]
fn net_of_a_patch(bencher: Bencher<'_, '_>) {
    let ring = ring();
    bencher.bench(|| ring.patch(black_box([0.3, 1.7]), black_box([0.4, 1.9])));
}

#[divan::bench]
fn conditions_on_a_net(bencher: Bencher<'_, '_>) {
    let net = *ring().patch([0.3, 1.7], [0.4, 1.9]).unwrap().net();
    bencher.bench(|| inspect(black_box(&net)));
}

#[divan::bench]
fn conversion(bencher: Bencher<'_, '_>) {
    let net = *ring().patch([0.3, 1.7], [0.4, 1.9]).unwrap().net();
    bencher.bench(|| convert(black_box(&net)));
}

#[divan::bench]
fn conversion_of_a_torus_by_algorithm_1(bencher: Bencher<'_, '_>) {
    let torus = Dupin::torus(3.0, 1.0, Frame::WORLD).unwrap();
    let net = torus
        .patch([0.3, 1.7], [0.4, 1.9])
        .unwrap()
        .net()
        .transposed();
    bencher.bench(|| convert_torus(black_box(&net), None));
}
