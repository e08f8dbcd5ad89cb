//! Demos, gallery and benchmarks.

fn main() {}
