//! How long one point takes, and how the time grows with their number.
//!
//! `cargo bench -p bezier-mass --bench evaluate`

use bezier_mass::glam::{DVec3, dvec3};
use bezier_mass::{
    BSplineCurve, BezierCurve, BezierPatch, Biquadratic, Knots, MassPoint, Quadratic,
};
use divan::{Bencher, black_box};

fn main() {
    divan::main();
}

/// A quarter of a torus with radii 3 and 1, rational biquadratic.
fn torus_patch() -> Biquadratic<DVec3> {
    let h = 0.5_f64.sqrt();
    let circle = [(1.0, 0.0, 1.0), (1.0, 1.0, h), (0.0, 1.0, 1.0)];
    let control = circle.map(|(c, s, w)| {
        circle.map(|(x, y, omega)| {
            let radius = 3.0 + x;
            MassPoint::point(dvec3(radius * c, radius * s, y), w * omega)
        })
    });
    Biquadratic::new(control).expect("finite control mass points")
}

fn quadratic() -> Quadratic<DVec3> {
    torus_patch().curve_at_u(0.3)
}

#[divan::bench]
fn quadratic_point(bencher: Bencher<'_, '_>) {
    let curve = quadratic();
    bencher.bench(|| black_box(&curve).point(black_box(0.37)));
}

#[divan::bench(args = [2, 4, 8, 16])]
fn curve_point_by_degree(bencher: Bencher<'_, '_>, degree: usize) {
    let curve = BezierCurve::from(quadratic()).elevated_to(degree);
    bencher.bench(|| black_box(&curve).point(black_box(0.37)));
}

#[divan::bench]
fn biquadratic_point(bencher: Bencher<'_, '_>) {
    let patch = torus_patch();
    bencher.bench(|| black_box(&patch).point(black_box(0.37), black_box(0.61)));
}

#[divan::bench]
fn biquadratic_point_and_normal(bencher: Bencher<'_, '_>) {
    let patch = torus_patch();
    bencher.bench(|| black_box(&patch).point_and_normal(black_box(0.37), black_box(0.61)));
}

#[divan::bench(args = [2, 3, 5])]
fn patch_point_by_degree(bencher: Bencher<'_, '_>, degree: usize) {
    let patch = BezierPatch::from(torus_patch()).elevated_to([degree, degree]);
    bencher.bench(|| black_box(&patch).point(black_box(0.37), black_box(0.61)));
}

/// Positions and normals on a square grid: the time for a point stays the same.
#[divan::bench(args = [10, 30, 100, 300])]
fn biquadratic_grid(bencher: Bencher<'_, '_>, side: usize) {
    let (patch, steps) = (torus_patch(), parameters(side));
    bencher
        .counter(side * side)
        .bench(|| black_box(&patch).grid(&steps, &steps));
}

/// Mass points alone on a square grid.
#[divan::bench(args = [10, 30, 100, 300])]
fn biquadratic_grid_values(bencher: Bencher<'_, '_>, side: usize) {
    let (patch, steps) = (torus_patch(), parameters(side));
    bencher
        .counter(side * side)
        .bench(|| black_box(&patch).grid_values(&steps, &steps));
}

#[divan::bench(args = [10, 100, 1000])]
fn spline_point_by_spans(bencher: Bencher<'_, '_>, spans: usize) {
    let knots = Knots::clamped_uniform(3, spans + 3).expect("uniform knots");
    let points: Vec<DVec3> = (0..spans + 3)
        .map(|i| dvec3(i as f64, (i as f64).sin(), 0.0))
        .collect();
    let spline =
        BSplineCurve::polynomial(knots, &points).expect("as many points as the knots ask for");
    bencher.bench(|| black_box(&spline).point(black_box(0.37)));
}

fn parameters(count: usize) -> Vec<f64> {
    (0..count).map(|i| i as f64 / (count - 1) as f64).collect()
}
