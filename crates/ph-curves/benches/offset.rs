//! How conversion and further offsets grow with the tolerance and the number of spans.

use divan::{Bencher, black_box};
use ph_curves::glam::DVec2;
use ph_curves::{Approximation, CubicPath, approximate};

fn main() {
    divan::main();
}

/// A spiral-like B-spline of size 100.
fn spiral(spans: u32) -> CubicPath {
    let step = 9.0 / f64::from(spans);
    let control: Vec<DVec2> = (0..spans + 3)
        .map(|k| {
            DVec2::from_angle(step * f64::from(k)) * (12.0 + 35.0 * f64::from(k) / f64::from(spans))
        })
        .collect();
    CubicPath::uniform_bspline(&control, false).expect("a spiral")
}

#[divan::bench(args = [1e-2, 1e-4, 1e-7])]
fn convert_class_3(bencher: Bencher<'_, '_>, tolerance: f64) {
    let curve = spiral(20);
    bencher.bench(|| approximate(black_box(&curve), &Approximation::quartics(tolerance)));
}

#[divan::bench(args = [1e-2, 1e-4, 1e-7])]
fn convert_class_9(bencher: Bencher<'_, '_>, tolerance: f64) {
    let curve = spiral(20);
    bencher.bench(|| approximate(black_box(&curve), &Approximation::within(tolerance)));
}

#[divan::bench(args = [5, 20, 80])]
fn further_offset(bencher: Bencher<'_, '_>, spans: u32) {
    let spline = approximate(&spiral(spans), &Approximation::within(1e-7))
        .expect("a spline")
        .spline;
    bencher.bench(|| black_box(&spline).offset(5.0));
}

#[divan::bench(args = [5, 20, 80])]
fn trimmed_offset(bencher: Bencher<'_, '_>, spans: u32) {
    let spline = approximate(&spiral(spans), &Approximation::within(1e-7))
        .expect("a spline")
        .spline;
    bencher.bench(|| black_box(&spline).trimmed_offset(5.0));
}
