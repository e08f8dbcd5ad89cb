//! Classification and blending of two cones.
#![expect(
    clippy::unwrap_used,
    reason = "the data of a bench are known to be good"
)]

use cyclide::glam::DVec3;
use cyclide::{Cone, RingPreference, classify};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

/// A cone and a cylinder around one sphere, their axes at 72 degrees.
fn pair() -> [Cone; 2] {
    let axis = DVec3::new(0.3, 0.95, 0.0).normalize();
    let vertex = -axis / 0.4_f64.sin();
    [
        Cone::cylinder(DVec3::ZERO, DVec3::X, 1.0).unwrap(),
        Cone::new(vertex, axis, 0.4).unwrap(),
    ]
}

#[divan::bench]
fn classification(bencher: Bencher<'_, '_>) {
    let [first, second] = pair();
    bencher.bench(|| classify(black_box(&first), black_box(&second)));
}

#[divan::bench]
fn one_blend(bencher: Bencher<'_, '_>) {
    let [first, second] = pair();
    let family = classify(&first, &second).families()[0];
    bencher.bench(|| family.blend(black_box(1.3)));
}

#[divan::bench]
fn ring_blend_from_the_cones(bencher: Bencher<'_, '_>) {
    let [first, second] = pair();
    bencher.bench(|| {
        classify(black_box(&first), black_box(&second)).families()[0]
            .ring_blend(RingPreference::Widest)
    });
}

#[divan::bench]
fn patches_of_a_tube(bencher: Bencher<'_, '_>) {
    let [first, second] = pair();
    let blend = classify(&first, &second).families()[0]
        .ring_blend(RingPreference::Widest)
        .unwrap();
    let tube = blend.tubes().unwrap()[0];
    bencher.bench(|| tube.patches());
}
