//! B-splines of random control points.

use ph_curves::CubicPath;
use ph_curves::glam::{DVec2, dvec2};

/// A walk of size 10 with inflections and near-cusps that crosses itself often.
pub(crate) fn walk(seed: u64, points: usize, closed: bool) -> CubicPath {
    let mut state = seed;
    let mut unit = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let control: Vec<DVec2> = (0..points)
        .map(|_| dvec2(10.0 * unit(), 10.0 * unit()))
        .collect();
    CubicPath::uniform_bspline(&control, closed).unwrap()
}
