//! Smooth surfaces: paths on polyhedra against the geodesic equation, on random patches.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use geodesic::bezier_mass::{BezierPatch, MassPoint};
use geodesic::glam::{DVec2, DVec3};
use geodesic::{PatchLevels, geodesic_between, trace_smooth};

/// Numbers in [0, 1), the same ones every time.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A bumpy rational patch over the unit square.
fn patch(random: &mut Random) -> BezierPatch<DVec3> {
    let degrees = [
        2 + (2.0 * random.unit()) as usize,
        2 + (2.0 * random.unit()) as usize,
    ];
    let rows: Vec<Vec<MassPoint<DVec3>>> = (0..=degrees[0])
        .map(|i| {
            (0..=degrees[1])
                .map(|j| {
                    let [x, y] = [i as f64 / degrees[0] as f64, j as f64 / degrees[1] as f64];
                    let jitter = DVec3::new(
                        random.between(-0.05, 0.05),
                        random.between(-0.05, 0.05),
                        random.between(-0.6, 0.6),
                    );
                    MassPoint::point(DVec3::new(x, y, 0.0) + jitter, random.between(0.6, 1.8))
                })
                .collect()
        })
        .collect();
    BezierPatch::from_rows(&rows).unwrap()
}

/// The stop by the estimated error keeps its promise, and both problems of the equation agree.
#[test]
fn paths_on_random_patches_tend_to_geodesics() {
    let mut random = Random(7);
    let mut inside = 0;
    for case in 0..30 {
        let patch = patch(&mut random);
        let mut point = || DVec2::new(random.between(0.05, 0.95), random.between(0.05, 0.95));
        let (from, to) = (point(), point());
        let (path, convergence) = PatchLevels::new(&patch)
            .path_within(from, to, 2e-4)
            .unwrap();
        let smooth = geodesic_between(&patch, &path.parameters, 1e-10).unwrap();
        assert!(smooth.residual < 1e-9);
        if !smooth.inside {
            continue;
        }
        inside += 1;
        // The initial value problem arrives where it should.
        let end = trace_smooth(&patch, smooth.nodes[0], smooth.length, 1e-12).unwrap();
        assert!(end.uv.distance(to) < 1e-6, "case {case}");
        let error = (path.length - smooth.length).abs();
        assert!(
            error <= 2e-4 && error <= 1.5 * convergence.error(),
            "case {case}: {error:e} {convergence:?}"
        );
    }
    assert!(inside >= 25, "{inside}");
}

/// From corner to corner along the top of a quarter torus the geodesic leaves the patch, and is shorter than any path on it.
#[test]
fn a_geodesic_that_leaves_the_patch_says_so() {
    let arc = [
        (DVec2::X, 1.0),
        (DVec2::ONE, FRAC_1_SQRT_2),
        (DVec2::Y, 1.0),
    ];
    let rows: Vec<Vec<MassPoint<DVec3>>> = arc
        .iter()
        .map(|(u, wu)| {
            let mass = |(v, wv): &(DVec2, f64)| {
                let rho = 2.0 + v.x;
                MassPoint::point(DVec3::new(rho * u.x, rho * u.y, v.y), wu * wv)
            };
            arc.iter().map(mass).collect()
        })
        .collect();
    let patch = BezierPatch::from_rows(&rows).unwrap();
    let (from, to) = (DVec2::new(0.0, 1.0), DVec2::new(1.0, 1.0));
    let paths = PatchLevels::new(&patch).paths(from, to, 5).unwrap();
    let smooth = geodesic_between(&patch, &paths[5].parameters, 1e-10).unwrap();
    assert!(!smooth.inside);
    assert!(smooth.nodes[smooth.nodes.len() / 2].uv.y > 1.0);
    // The boundary is a quarter of the circle of radius 2.
    assert!((paths[5].length - PI).abs() < 2e-3);
    assert!(smooth.length < PI - 0.01);
}
