//! Fronts: propagation, reflection with re-approximation, and the arrivals that they tell.
//!
//! `cargo bench -p wavefront --bench fronts`

use divan::{Bencher, black_box, counter::ItemsCount};
use glam::{DVec2, dvec2};
use wavefront::{
    Code, Fan, FanOptions, Front, FrontTolerance, Interface, Medium, Mode, Model, Source, Step,
    glam,
};

fn main() {
    divan::main();
}

fn mirror() -> Model {
    let medium = || Medium::isotropic(1.0).unwrap();
    let (low, high) = (DVec2::splat(-1.5), DVec2::splat(1.5));
    let circle = Interface::circle(DVec2::ZERO, 1.0).unwrap();
    Model::try_new(low, high, vec![medium(), medium()], vec![circle]).unwrap()
}

fn reflected(model: &Model) -> Fan<'_> {
    let source = Source::Point {
        position: dvec2(0.1, -0.5),
        angles: [0.3, 2.8],
    };
    let step = Step {
        interface: 0,
        mode: Mode::Reflect,
    };
    let code = Code { steps: vec![step] };
    Fan::new(model, source, code, FanOptions::default()).unwrap()
}

/// Tolerances relative to the model's size.
const TOLERANCES: [f64; 4] = [1e-4, 1e-6, 1e-8, 1e-10];

fn fronts(model: &Model, fan: &Fan<'_>, tolerance: f64) -> Vec<Front> {
    fan.fronts(FrontTolerance::time(tolerance * model.size()))
        .unwrap()
}

fn arcs(fronts: &[Front]) -> usize {
    fronts.iter().map(|front| front.pieces().len()).sum()
}

/// One reflection in a circle with re-approximation by class-3 arcs, counted by arcs.
#[divan::bench(args = TOLERANCES)]
fn reflection(bencher: Bencher<'_, '_>, tolerance: f64) {
    let model = mirror();
    let fan = reflected(&model);
    let count = arcs(&fronts(&model, &fan, tolerance));
    bencher
        .counter(ItemsCount::new(count))
        .bench(|| black_box(fronts(&model, &fan, tolerance)).len());
}

/// A front moved on by a time: its arcs as they are then, counted by fronts.
#[divan::bench(args = TOLERANCES)]
fn propagation(bencher: Bencher<'_, '_>, tolerance: f64) {
    let model = mirror();
    let fronts = fronts(&model, &reflected(&model), tolerance);
    bencher.counter(ItemsCount::new(fronts.len())).bench(|| {
        let moved = fronts
            .iter()
            .flat_map(|front| front.propagated(black_box(0.7)));
        moved.map(|arc| arc.coefficients()[0]).sum::<f64>()
    });
}

/// All arrivals at a receiver behind the caustic, as roots of a quartic for each arc.
#[divan::bench(args = TOLERANCES)]
fn arrivals_of_a_front(bencher: Bencher<'_, '_>, tolerance: f64) {
    let model = mirror();
    let fronts = fronts(&model, &reflected(&model), tolerance);
    let receiver = dvec2(0.05, 0.1);
    bencher.bench(|| {
        let found = fronts
            .iter()
            .map(|front| front.arrivals(black_box(receiver)));
        found.map(|found| found.unwrap().len()).sum::<usize>()
    });
}
