//! The whole way once: sensors on ribbons laid on a surface, a network of them, what it says at its crossings, boundary
//! curves, Bézier patches, and how far they are from the surface measured. And geodesics computed on a mesh.

use geodesic::{Straightest, shapes};
use glam::{DMat3, DVec2, DVec3};
use reconstruct::{
    BezierStrip, CornerData, Crossing, Degree7Shape, Error, GeodesicStrip, Rectangle, RibbonLayout,
    RibbonNetwork, SampledCurve, Sensor, SensorKind, SpatialRibbon, Strip, Surface,
    TwoCurveSurface, WorldFields, boundary_geodesic_curvature, degree7_boundaries,
};

/// A small deterministic generator (SplitMix64) of normal deviates.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn gaussian(&mut self) -> f64 {
        (-2.0 * (1.0 - self.uniform()).ln()).sqrt()
            * (core::f64::consts::TAU * self.uniform()).cos()
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.gaussian(), self.gaussian(), self.gaussian())
    }
}

/// The model: a dome `z = 1 - 0.3 x² - 0.22 y² + 0.03 x y`, convex everywhere.
fn height(p: DVec2) -> f64 {
    1.0 - 0.3 * p.x * p.x - 0.22 * p.y * p.y + 0.03 * p.x * p.y
}

fn gradient(p: DVec2) -> DVec2 {
    DVec2::new(-0.6 * p.x + 0.03 * p.y, -0.44 * p.y + 0.03 * p.x)
}

fn normal(p: DVec2) -> DVec3 {
    let slope = gradient(p);
    DVec3::new(-slope.x, -slope.y, 1.0).normalize()
}

/// Distance to the model, by its linearisation: second order in the distance.
fn distance(p: DVec3) -> f64 {
    let foot = p.truncate();
    (p.z - height(foot)).abs() / (1.0 + gradient(foot).length_squared()).sqrt()
}

/// A geodesic from `start` at unit speed: positions in the plane at steps of `STEP` of arc length, by Runge and Kutta.
const STEP: f64 = 1.0 / 512.0;

fn lay(start: DVec2, heading: DVec2, length: f64) -> Vec<(DVec2, DVec2)> {
    let acceleration = |p: DVec2, d: DVec2| {
        let slope = gradient(p);
        let w = -0.6 * d.x * d.x + 0.06 * d.x * d.y - 0.44 * d.y * d.y;
        -slope * (w / (1.0 + slope.length_squared()))
    };
    let speed = (heading.length_squared() + gradient(start).dot(heading).powi(2)).sqrt();
    let mut state = (start, heading / speed);
    let mut path = vec![state];
    for _ in 0..(length / STEP).round() as usize {
        let (p, d) = state;
        let (k1, l1) = (d, acceleration(p, d));
        let (k2, l2) = (
            d + l1 * (STEP / 2.0),
            acceleration(p + k1 * (STEP / 2.0), d + l1 * (STEP / 2.0)),
        );
        let (k3, l3) = (
            d + l2 * (STEP / 2.0),
            acceleration(p + k2 * (STEP / 2.0), d + l2 * (STEP / 2.0)),
        );
        let (k4, l4) = (d + l3 * STEP, acceleration(p + k3 * STEP, d + l3 * STEP));
        state = (
            p + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (STEP / 6.0),
            d + (l1 + l2 * 2.0 + l3 * 2.0 + l4) * (STEP / 6.0),
        );
        path.push(state);
    }
    path
}

/// Arc lengths at which two laid ribbons cross.
fn crossing(a: &[(DVec2, DVec2)], b: &[(DVec2, DVec2)]) -> [f64; 2] {
    for (i, pair) in a.windows(2).enumerate() {
        for (j, other) in b.windows(2).enumerate().step_by(1) {
            let (p, d) = (pair[0].0, pair[1].0 - pair[0].0);
            let (q, e) = (other[0].0, other[1].0 - other[0].0);
            let cross = d.perp_dot(e);
            let (s, t) = ((q - p).perp_dot(e) / cross, (q - p).perp_dot(d) / cross);
            if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
                return [(i as f64 + s) * STEP, (j as f64 + t) * STEP];
            }
        }
    }
    panic!("the ribbons do not cross");
}

const SENSORS: usize = 33;
const LENGTH: f64 = 2.0;

/// What the sensors of a laid ribbon read, and the ribbon reconstructed from that.
fn measured(path: &[(DVec2, DVec2)], sigma: f64, noise: &mut Noise) -> SpatialRibbon {
    let world = WorldFields::with_dip(1.08).unwrap();
    let spacing = (path.len() - 1) / (SENSORS - 1);
    let kind = |i: usize| {
        if i.is_multiple_of(2) {
            SensorKind::Accelerometer
        } else {
            SensorKind::Magnetometer
        }
    };
    let sensors = (0..SENSORS).map(|i| Sensor::new((i * spacing) as f64 * STEP, kind(i)));
    let layout = RibbonLayout::new(sensors, world).unwrap();
    let readings: Vec<DVec3> = (0..SENSORS)
        .map(|i| {
            let (p, d) = path[i * spacing];
            let (x, z) = (d.extend(gradient(p).dot(d)).normalize(), normal(p));
            let body = DMat3::from_cols(x, z.cross(x), z).transpose();
            let field = if i.is_multiple_of(2) {
                world.up()
            } else {
                world.magnetic()
            };
            body * field + noise.vector() * sigma
        })
        .collect();
    layout.tangents(&readings).unwrap().ribbon().unwrap()
}

/// Three ribbons along x (first) and three along y, noisy, and the four patches between them. Returns the gap of the
/// crossings before the correction and the largest distance of the patches from the model.
fn reconstruct_dome(sigma: f64) -> (f64, f64) {
    let mut noise = Noise(17);
    let along_x = (0..3).map(|k| {
        lay(
            DVec2::new(-0.95, -0.6 + 0.6 * k as f64),
            DVec2::new(1.0, 0.02),
            LENGTH,
        )
    });
    let along_y = (0..3).map(|k| {
        lay(
            DVec2::new(-0.6 + 0.6 * k as f64, -0.95),
            DVec2::new(-0.03, 1.0),
            LENGTH,
        )
    });
    let paths: Vec<_> = along_x.chain(along_y).collect();
    let ribbons: Vec<SpatialRibbon> = paths
        .iter()
        .map(|path| measured(path, sigma, &mut noise))
        .collect();
    let crossings: Vec<Crossing> = (0..3)
        .flat_map(|a| (3..6).map(move |b| [a, b]))
        .map(|[a, b]| Crossing {
            ribbons: [a, b],
            s: crossing(&paths[a], &paths[b]),
        })
        .collect();
    let network = RibbonNetwork::new(ribbons, crossings).unwrap();
    assert!(network.gap() < 1e-10);
    let origin = paths[0][0].0;
    let origin = origin.extend(height(origin));

    let corner = |i: usize, j: usize| network.corner(3 * j + i).unwrap().0;
    let mut worst: f64 = 0.0;
    for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
        let corners: [[CornerData; 2]; 2] = [
            [corner(i, j), corner(i, j + 1)],
            [corner(i + 1, j), corner(i + 1, j + 1)],
        ];
        let [r1, r2, r3, r4] = degree7_boundaries(&corners, &Degree7Shape::default())
            .unwrap()
            .map(BezierStrip::new);
        let rectangle =
            Rectangle::new([r1.unwrap(), r2.unwrap(), r3.unwrap(), r4.unwrap()]).unwrap();
        let patch = rectangle
            .patch(rectangle.regular_twists())
            .unwrap()
            .to_bezier()
            .unwrap();
        assert!(boundary_geodesic_curvature(&patch, 20) < 1e-8);
        for a in 0..=10 {
            for b in 0..=10 {
                let p = Surface::point(&patch, f64::from(a) / 10.0, f64::from(b) / 10.0) + origin;
                worst = worst.max(distance(p));
            }
        }
    }
    (network.gap_before(), worst)
}

#[test]
fn from_sensors_to_bezier_patches() {
    let (exact_gap, exact) = reconstruct_dome(0.0);
    let (gap, noisy) = reconstruct_dome(0.002);
    println!(
        "without noise: gap {exact_gap:e}, error {exact:e}; with 0.002: gap {gap:e}, error {noisy:e}"
    );
    // Ribbons of length 2 on a dome 1.2 wide: what is left without noise is the interpolation between the sensors.
    assert!(exact_gap < 1e-4 && exact < 2e-3);
    // An error of 0.002 in every reading is 0.1 degrees of direction for each sensor.
    assert!(gap > 1e-4 && noisy < 2e-2);
}

/// Two geodesics traced on a mesh, known by points only: the curves of the surface through them are geodesics of it,
/// exactly so by their own normals, and within a stated bound by smoothed binormals.
#[test]
fn geodesics_from_a_mesh() {
    let cells = 80;
    let scale = 2.4 / f64::from(cells);
    let place = |p: DVec2| p * scale - DVec2::splat(1.2);
    let mesh = shapes::sheet(cells, cells, |p| place(p).extend(height(place(p)))).unwrap();
    let normals: Vec<DVec3> = mesh
        .positions()
        .iter()
        .map(|p| normal(p.truncate()))
        .collect();
    let tracer = Straightest::new(&mesh).with_normals(&normals).unwrap();
    let trace = |row: u32| {
        let start = mesh.vertex_point(row * (cells + 1) + 4).unwrap();
        let face = tracer
            .face_towards(start, DVec3::new(1.0, 0.03, 0.5))
            .unwrap();
        let trace = tracer
            .trace(start, face, DVec3::new(1.0, 0.03, 0.5), 2.0)
            .unwrap();
        let mut points: Vec<DVec3> = Vec::new();
        for p in trace.positions {
            if points.last().is_none_or(|last| last.distance(p) > 1e-3) {
                points.push(p);
            }
        }
        SampledCurve::fit(&points, 4).unwrap()
    };
    let curves = [trace(24), trace(56)];
    let strips = curves
        .clone()
        .map(|curve| GeodesicStrip::new(curve).unwrap());
    let surface = TwoCurveSurface::new(strips).unwrap();
    for u in [0.1, 0.5, 0.9] {
        for v in [0.0, 1.0] {
            let at = surface.partials(u, v);
            assert!(
                reconstruct::geodesic_curvature(at.du, at.duu, at.du.cross(at.dv)).abs() < 1e-12
            );
            let tilt = at
                .du
                .cross(at.dv)
                .normalize()
                .cross(normal(at.position.truncate()))
                .length();
            assert!(tilt < 0.05, "the normal is off by {tilt}");
        }
    }
    let smooth = curves[0].strip(3).unwrap();
    let bound = (0..=40)
        .map(|i| smooth.geodesic_curvature(f64::from(i) / 40.0).abs())
        .fold(0.0, f64::max);
    assert!(bound < 0.05, "{bound}");
    assert!(smooth.sample(0.3).normal().is_finite());
}

/// A network that says nothing sensible is refused on the way, not at the end.
#[test]
fn a_corner_without_a_plane_is_refused() {
    let refused = CornerData::new(DVec3::ZERO, DVec3::Z, [DVec3::X, DVec3::X], [1.0, 1.0]);
    assert!(matches!(refused, Err(Error::CornerData { .. })));
}
