//! Construction and smoothing of patches.

use divan::{Bencher, black_box};
use glam::DVec3;
use reconstruct::{
    AnalyticCurve, BezierStrip, CornerData, Criterion, Degree7Shape, GeodesicStrip, Rectangle,
    Surface, degree7_boundaries,
};

fn main() {
    divan::main();
}

fn helices() -> [GeodesicStrip; 4] {
    let corners = [[0.0, 0.0], [1.0, 0.2], [0.3, 0.9], [1.25, 1.15]];
    [(0, 1), (0, 2), (2, 3), (1, 3)].map(|(a, b): (usize, usize)| {
        GeodesicStrip::new(AnalyticCurve::new(move |t| {
            let [angle, height] =
                [0, 1].map(|k| t * (corners[b][k] - corners[a][k]) + corners[a][k]);
            let (sin, cos) = angle.sin_cos();
            [cos, sin, height]
        }))
        .unwrap()
    })
}

fn degree7() -> [BezierStrip; 4] {
    let corner = |x: f64, y: f64| {
        let (u, v) = (DVec3::new(1.0, 0.0, 0.5 * x), DVec3::new(0.0, 1.0, 0.5 * y));
        let normal = u.cross(v);
        let curvature = |t: DVec3| 0.5 / (normal.length() * t.length_squared());
        let point = DVec3::new(x, y, 0.25 * (x * x + y * y));
        CornerData::new(point, normal, [u, v], [curvature(u), curvature(v)]).unwrap()
    };
    let corners = [
        [corner(0.1, -0.2), corner(0.0, 1.1)],
        [corner(1.2, 0.0), corner(1.0, 1.0)],
    ];
    degree7_boundaries(&corners, &Degree7Shape::default())
        .unwrap()
        .map(|curve| BezierStrip::new(curve).unwrap())
}

#[divan::bench]
fn conditions_and_patch_of_helices(bencher: Bencher<'_, '_>) {
    let strips = helices();
    bencher.bench_local(|| {
        Rectangle::new(black_box(&strips).clone())
            .unwrap()
            .patch([[0.0; 2]; 4])
            .unwrap()
    });
}

#[divan::bench]
fn conditions_and_patch_of_degree_7(bencher: Bencher<'_, '_>) {
    let strips = degree7();
    bencher.bench_local(|| {
        Rectangle::new(black_box(&strips).clone())
            .unwrap()
            .patch([[0.0; 2]; 4])
            .unwrap()
    });
}

#[divan::bench]
fn control_net_of_bidegree_13(bencher: Bencher<'_, '_>) {
    let patch = Rectangle::new(degree7())
        .unwrap()
        .patch([[0.0; 2]; 4])
        .unwrap();
    bencher.bench_local(|| black_box(&patch).to_bezier().unwrap());
}

#[divan::bench(args = [Criterion::Dirichlet, Criterion::ThinPlate, Criterion::SpeedVariation])]
fn smoothing(bencher: Bencher<'_, '_>, criterion: Criterion) {
    let rectangle = Rectangle::new(helices()).unwrap();
    bencher.bench_local(|| black_box(&rectangle).smoothest(criterion).unwrap());
}

#[divan::bench]
fn point_with_derivatives(bencher: Bencher<'_, '_>) {
    let patch = Rectangle::new(helices())
        .unwrap()
        .patch([[0.0; 2]; 4])
        .unwrap();
    bencher.bench_local(|| black_box(&patch).partials(black_box(0.3), black_box(0.6)));
}
