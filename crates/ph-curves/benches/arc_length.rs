//! Arc length and its inverse, steps of the feed interpolator, frames along a space curve.

use divan::{Bencher, black_box};
use ph_curves::glam::{DVec2, DVec3, dvec2, dvec3};
use ph_curves::{
    FeedInterpolator, FeedRate, Hermite, PhSpline, PolynomialPh, SpatialHermite, SplineEnds,
};

fn main() {
    divan::main();
}

fn quintic() -> PolynomialPh {
    let data = Hermite {
        start: DVec2::ZERO,
        start_derivative: dvec2(0.6, 1.6),
        end: dvec2(1.0, 0.1),
        end_derivative: dvec2(0.6, -1.4),
    };
    data.least_bending().expect("a quintic")
}

#[divan::bench]
fn length_up_to(bencher: Bencher<'_, '_>) {
    let curve = quintic();
    bencher.bench(|| curve.arc_length().up_to(black_box(0.37)));
}

#[divan::bench]
fn parameter_at_length(bencher: Bencher<'_, '_>) {
    let curve = quintic();
    let length = 0.37 * curve.arc_length().total();
    bencher.bench(|| curve.arc_length().parameter_at(black_box(length)));
}

#[divan::bench]
fn quintic_of_least_bending(bencher: Bencher<'_, '_>) {
    bencher.bench(quintic);
}

/// Time of a whole path with so many steps: the cost of a step does not depend on the feed.
#[divan::bench(args = [100, 1_000, 10_000])]
fn feed_steps(bencher: Bencher<'_, '_>, steps: u32) {
    let points = [
        (0.0, 0.0),
        (30.0, 20.0),
        (60.0, 10.0),
        (90.0, 40.0),
        (60.0, 70.0),
    ];
    let ends = SplineEnds::Clamped {
        start_derivative: dvec2(30.0, 10.0),
        end_derivative: dvec2(-30.0, 20.0),
    };
    let path = PhSpline::interpolate(&points.map(DVec2::from), ends).expect("a path");
    let feed = FeedRate::Constant(path.length());
    let period = 1.0 / f64::from(steps);
    bencher.bench(|| {
        FeedInterpolator::try_new(black_box(&path), feed, period).map(|points| {
            points
                .map(|point| point.length_error.abs())
                .fold(0.0, f64::max)
        })
    });
}

#[divan::bench]
fn euler_rodrigues_frame(bencher: Bencher<'_, '_>) {
    let data = SpatialHermite {
        start: DVec3::ZERO,
        start_derivative: dvec3(1.0, 0.2, 0.5),
        end: dvec3(1.0, 1.0, 0.3),
        end_derivative: dvec3(0.3, 1.0, -0.4),
    };
    let curve = data.least_bending().expect("a quintic");
    bencher.bench(|| curve.euler_rodrigues_frame(black_box(0.37)));
}
