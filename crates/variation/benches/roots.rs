//! How the cost grows with the degree, set by set; and what the refined bound saves where only the number is asked.
//!
//! `cargo bench -p variation`

use divan::{Bencher, black_box};
use variation::Solver;
use variation::sets::Set;

fn main() {
    divan::main();
}

const DEGREES: [usize; 7] = [3, 4, 5, 8, 12, 20, 40];

fn items(set: Set, degree: usize) -> Vec<Vec<f64>> {
    (0..set.items())
        .map(|index| set.polynomial(degree, index))
        .collect()
}

/// All roots of the items of a set; divide by [`Set::items`].
fn solve(bencher: Bencher<'_, '_>, set: Set, degree: usize) {
    let items = items(set, degree);
    let mut solver = Solver::new();
    bencher.bench_local(|| {
        items
            .iter()
            .filter_map(|p| solver.roots(black_box(p)).ok().map(<[_]>::len))
            .sum::<usize>()
    });
}

/// Only their number.
fn count(bencher: Bencher<'_, '_>, set: Set, degree: usize) {
    let items = items(set, degree);
    let mut solver = Solver::new();
    bencher.bench_local(|| {
        items
            .iter()
            .filter(|p| solver.count(black_box(p)).is_ok())
            .count()
    });
}

#[divan::bench(args = DEGREES)]
fn roots_of_random(bencher: Bencher<'_, '_>, degree: usize) {
    solve(bencher, Set::Uniform, degree);
}

#[divan::bench(args = DEGREES)]
fn roots_of_known(bencher: Bencher<'_, '_>, degree: usize) {
    solve(bencher, Set::Known, degree);
}

#[divan::bench(args = DEGREES)]
fn roots_of_close_pairs(bencher: Bencher<'_, '_>, degree: usize) {
    solve(bencher, Set::ClosePairs, degree);
}

#[divan::bench(args = DEGREES)]
fn roots_of_root_free(bencher: Bencher<'_, '_>, degree: usize) {
    solve(bencher, Set::RootFree, degree);
}

#[divan::bench(args = DEGREES)]
fn count_of_random(bencher: Bencher<'_, '_>, degree: usize) {
    count(bencher, Set::Uniform, degree);
}

#[divan::bench(args = DEGREES)]
fn count_of_root_free(bencher: Bencher<'_, '_>, degree: usize) {
    count(bencher, Set::RootFree, degree);
}
