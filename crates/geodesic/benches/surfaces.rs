//! Geodesics of smooth surfaces: how the cost grows with the level, and what the geodesic equation adds.

use bezier_mass::{BSplineSurface, Knots, MassPoint};
use divan::{Bencher, black_box};
use geodesic::{PatchLevels, SubdivisionSurface, geodesic_between, shapes};
use glam::{DVec2, DVec3};

fn main() {
    divan::main();
}

const ENDS: [DVec2; 2] = [DVec2::new(0.25, 0.25), DVec2::new(1.75, 1.5)];

/// A bump, of degrees 3 and 2 with two spans each way.
fn bump() -> BSplineSurface<DVec3> {
    let knots = [
        Knots::clamped(3, &[0.0, 1.0, 2.0]).unwrap(),
        Knots::clamped(2, &[0.0, 1.0, 2.0]).unwrap(),
    ];
    let control = (0..20).map(|k| {
        let (x, y) = (f64::from(k / 4), f64::from(k % 4));
        let height = 2.5 * (-(x - 2.0).powi(2) - (y - 1.5).powi(2)).exp();
        MassPoint::point(DVec3::new(x, y, height), 1.0)
    });
    BSplineSurface::new(knots, control.collect()).unwrap()
}

/// All levels up to one: 48 faces times 4 to the level.
#[divan::bench(args = [2, 3, 4, 5, 6])]
fn levels(bencher: Bencher<'_, '_>, level: usize) {
    let surface = bump();
    bencher.bench(|| PatchLevels::of_spline(&surface).paths(black_box(ENDS[0]), ENDS[1], level));
}

/// Newton's method from the path of level 3 to a residual of 1e-11.
#[divan::bench]
fn geodesic_equation(bencher: Bencher<'_, '_>) {
    let surface = bump();
    let paths = PatchLevels::of_spline(&surface)
        .paths(ENDS[0], ENDS[1], 3)
        .unwrap();
    bencher.bench(|| geodesic_between(&surface, black_box(&paths[3].parameters), 1e-11));
}

/// From 20 faces by Loop's scheme: refining, and the path of every level.
#[divan::bench(args = [2, 4, 6])]
fn subdivision(bencher: Bencher<'_, '_>, level: usize) {
    let surface = SubdivisionSurface::loop_scheme(&shapes::sphere(0).unwrap()).unwrap();
    bencher.bench(|| surface.paths(black_box(0.into()), 7.into(), level));
}
