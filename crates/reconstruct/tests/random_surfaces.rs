//! Rectangles and triangles cut by geodesics from random analytic surfaces: valid ones reconstruct, damaged ones are
//! refused with the right condition named.

use core::array::from_fn;
use glam::{DVec2, DVec3};
use reconstruct::{
    Corner, Criterion, Curve, Error, GeodesicStrip, Rectangle, Series, Strip, Surface, Triangle,
    VectorSeries, Violation, boundary_geodesic_curvature,
};
use std::sync::Arc;

/// A small deterministic generator (SplitMix64), uniform in an interval.
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Terms of the Taylor expansions of geodesics.
const TERMS: usize = 10;
type Long = Series<TERMS>;

/// The graph of `f(x, y) = a x² + b x y + c y² + d sin(p x + q y + r)`.
#[derive(Clone, Copy, Debug)]
struct Graph {
    quadratic: [f64; 3],
    wave: [f64; 4],
}

impl Graph {
    /// Bent clearly along both axes, so that sides near the axes have no inflections; elliptic or hyperbolic.
    fn random(random: &mut Random) -> Self {
        let sign = if random.between(0.0, 1.0) < 0.5 {
            1.0
        } else {
            -1.0
        };
        let quadratic = [
            random.between(0.3, 0.6),
            random.between(-0.1, 0.1),
            sign * random.between(0.3, 0.6),
        ];
        let wave = [
            random.between(-0.06, 0.06),
            random.between(-1.5, 1.5),
            random.between(-1.5, 1.5),
            random.between(0.0, 6.0),
        ];
        Self { quadratic, wave }
    }

    /// `f, f_x, f_y, f_xx, f_xy, f_yy`.
    fn derivatives(&self, x: Long, y: Long) -> [Long; 6] {
        let ([a, b, c], [d, p, q, r]) = (self.quadratic, self.wave);
        let (sin, cos) = (x * p + y * q + r).sin_cos();
        [
            x * x * a + x * y * b + y * y * c + sin * d,
            x * (2.0 * a) + y * b + cos * (d * p),
            x * b + y * (2.0 * c) + cos * (d * q),
            -(sin * (d * p * p)) + 2.0 * a,
            -(sin * (d * p * q)) + b,
            -(sin * (d * q * q)) + 2.0 * c,
        ]
    }

    /// The geodesic with this start and velocity as Taylor series: `(x, y)'' = -(f_x, f_y) w / (1 + f_x² + f_y²)`,
    /// `w = f_xx x'² + 2 f_xy x' y' + f_yy y'²`, coefficient by coefficient.
    fn expand(&self, start: DVec2, velocity: DVec2) -> [Long; 3] {
        let (mut x, mut y) = (Long::constant(start.x), Long::constant(start.y));
        (x.0[1], y.0[1]) = (velocity.x, velocity.y);
        for k in 0..TERMS - 2 {
            let [_, fx, fy, fxx, fxy, fyy] = self.derivatives(x, y);
            let (dx, dy) = (x.derivative(), y.derivative());
            let w = fxx * dx * dx + fxy * dx * dy * 2.0 + fyy * dy * dy;
            let factor = w / (fx * fx + fy * fy + 1.0);
            let divisor = ((k + 1) * (k + 2)) as f64;
            x.0[k + 2] = -(fx * factor).0[k] / divisor;
            y.0[k + 2] = -(fy * factor).0[k] / divisor;
        }
        [x, y, self.derivatives(x, y)[0]]
    }

    /// The geodesic over `[0, 1]` with this start and velocity.
    fn shoot(&self, start: DVec2, velocity: DVec2) -> TaylorCurve {
        let mut pieces = Vec::new();
        let (mut at, mut position, mut direction) = (0.0, start, velocity);
        while at < 1.0 {
            let expansion = self.expand(position, direction);
            let last = expansion
                .iter()
                .map(|c| c.0[TERMS - 1].abs() + c.0[TERMS - 2].abs())
                .fold(1e-300, f64::max);
            let step = (1e-17 / last).powf(1.0 / (TERMS - 1) as f64).min(1.0 - at);
            pieces.push((at, VectorSeries::from_coordinates(expansion)));
            let moved = |c: &Long| c.0.iter().rev().fold(0.0, |sum, k| sum * step + k);
            position = DVec2::new(moved(&expansion[0]), moved(&expansion[1]));
            direction = DVec2::new(
                moved(&expansion[0].derivative()),
                moved(&expansion[1].derivative()),
            );
            at += step;
        }
        TaylorCurve {
            pieces: pieces.into(),
            end: position,
        }
    }

    /// The geodesic between two points, by Newton's iteration on its start velocity.
    fn between(&self, start: DVec2, end: DVec2) -> Option<TaylorCurve> {
        let mut velocity = end - start;
        let mut inverse = None;
        for _ in 0..40 {
            let curve = self.shoot(start, velocity);
            let miss = end - curve.end;
            if miss.length() < 1e-14 {
                return Some(curve);
            }
            // The slopes of the first step serve for all: nearby geodesics bend alike.
            let inverse = *inverse.get_or_insert_with(|| {
                let slope = |axis: DVec2| {
                    (self.shoot(start, velocity + axis * 1e-6).end - curve.end) / 1e-6
                };
                glam::DMat2::from_cols(slope(DVec2::X), slope(DVec2::Y)).inverse()
            });
            velocity += inverse * miss;
        }
        None
    }
}

/// A curve by consecutive Taylor expansions.
#[derive(Clone, Debug)]
struct TaylorCurve {
    pieces: Arc<[(f64, VectorSeries<TERMS>)]>,
    end: DVec2,
}

impl Curve for TaylorCurve {
    fn series(&self, t: f64) -> VectorSeries {
        let index = self
            .pieces
            .partition_point(|(start, _)| *start <= t)
            .saturating_sub(1);
        let (start, piece) = &self.pieces[index];
        let mut derivative = *piece;
        let mut factorial = 1.0;
        VectorSeries(from_fn(|order| {
            if order > 0 {
                derivative = derivative.derivative();
                factorial *= order as f64;
            }
            derivative
                .0
                .iter()
                .rev()
                .fold(DVec3::ZERO, |sum, c| sum * (t - start) + *c)
                / factorial
        }))
    }
}

/// A curve pushed aside by a polynomial times a vector.
#[derive(Clone, Debug)]
struct Damaged {
    curve: TaylorCurve,
    push: DVec3,
    power: i32,
}

impl Curve for Damaged {
    fn series(&self, t: f64) -> VectorSeries {
        // t^power (1 - t)^4: the other end keeps its three derivatives.
        let t: Series = Series::parameter(t);
        let rest = -t + 1.0;
        let bump = (0..self.power).fold(rest * rest * rest * rest, |product, _| product * t);
        self.curve.series(t.value()) + VectorSeries::constant(self.push).scaled(&bump)
    }
}

fn corners(random: &mut Random) -> [DVec2; 4] {
    [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| {
        DVec2::new(
            x - 0.5 + random.between(-0.12, 0.12),
            y - 0.5 + random.between(-0.12, 0.12),
        )
    })
}

const SIDES: [[usize; 2]; 4] = [[0, 1], [0, 2], [2, 3], [1, 3]];

fn random_rectangle(random: &mut Random) -> (Graph, [TaylorCurve; 4]) {
    loop {
        let (graph, corners) = (Graph::random(random), corners(random));
        let curves: Option<Vec<TaylorCurve>> = SIDES
            .iter()
            .map(|[a, b]| graph.between(corners[*a], corners[*b]))
            .collect();
        if let Some(curves) = curves {
            return (graph, curves.try_into().unwrap());
        }
    }
}

fn strips<const N: usize>(curves: &[TaylorCurve; N]) -> [GeodesicStrip; N] {
    from_fn(|k| GeodesicStrip::new(curves[k].clone()).unwrap())
}

#[test]
fn a_thousand_random_rectangles_reconstruct() {
    let mut random = Random(1);
    let (mut worst_boundary, mut worst_corner, mut smooth): (f64, f64, usize) = (0.0, 0.0, 0);
    for _ in 0..1000 {
        let (_, curves) = random_rectangle(&mut random);
        let rectangle = Rectangle::new(strips(&curves)).unwrap();
        assert_eq!(rectangle.report().reversals % 2, 0);
        let patch = match rectangle.smoothest(Criterion::ThinPlate) {
            Ok(smoothed) => {
                smooth += 1;
                smoothed.patch
            }
            Err(Error::IrregularBoundary { .. }) => rectangle.patch([[0.0; 2]; 4]).unwrap(),
            Err(error) => panic!("{error}"),
        };
        worst_boundary = worst_boundary.max(boundary_geodesic_curvature(&patch, 12));
        for ([a, _], curve) in SIDES.iter().zip(&curves) {
            let [u, v] = [(*a % 2) as f64, (*a / 2) as f64];
            worst_corner = worst_corner.max(patch.point(u, v).distance(curve.point(0.0)));
        }
        assert!(patch.regularity(6).0 > 0.0);
    }
    println!("boundary {worst_boundary:e}, corners {worst_corner:e}, {smooth} of 1000 smooth");
    assert!(worst_boundary < 1e-8, "{worst_boundary:e}");
    assert!(worst_corner < 1e-10, "{worst_corner:e}");
    assert!(smooth > 990, "{smooth}");
}

#[test]
fn a_thousand_random_triangles_reconstruct() {
    let mut random = Random(2);
    let (mut worst_boundary, mut worst_corner, mut count): (f64, f64, usize) = (0.0, 0.0, 0);
    while count < 1000 {
        let (graph, corners) = (Graph::random(&mut random), corners(&mut random));
        let sides: Option<Vec<TaylorCurve>> = [[1, 2], [2, 0], [0, 1]]
            .iter()
            .map(|[a, b]| graph.between(corners[*a], corners[*b]))
            .collect();
        let Some(sides) = sides else { continue };
        let sides: [TaylorCurve; 3] = sides.try_into().unwrap();
        // On a hyperbolic surface the third side may run along an asymptotic direction: no normal, not valid.
        let triangle = match Triangle::new(strips(&sides)) {
            Ok(triangle) => triangle,
            Err(Error::Inflection { .. }) if graph.quadratic[2] < 0.0 => continue,
            Err(Error::Conditions(violations)) => panic!("{violations:?}"),
            Err(error) => panic!("{error}"),
        };
        count += 1;
        let patch = triangle.patch([[0.0; 2]; 3]).unwrap();
        worst_boundary = worst_boundary.max(patch.boundary_geodesic_curvature(12));
        for i in 0..3 {
            let corner: [f64; 3] = from_fn(|k| if k == i { 1.0 } else { 0.0 });
            worst_corner =
                worst_corner.max(patch.at(corner).distance(sides[(i + 2) % 3].point(0.0)));
        }
        // Gauss and Bonnet: an elliptic surface has a positive excess of angles, whatever fills the triangle.
        if graph.quadratic[2] > 0.0 {
            assert!(triangle.total_curvature() > 0.0);
        }
        if count.is_multiple_of(50) {
            let residual = patch.integrated_curvature(20) - triangle.total_curvature();
            assert!(residual.abs() < 1e-8, "{residual:e}");
        }
    }
    println!("boundary {worst_boundary:e}, corners {worst_corner:e}");
    assert!(worst_boundary < 1e-8, "{worst_boundary:e}");
    assert!(worst_corner < 1e-10, "{worst_corner:e}");
}

/// Damages at the start of `r1` (corner 00): the bump's power says which derivative is wrong.
#[test]
fn damaged_rectangles_are_refused_with_the_condition_named() {
    let mut random = Random(3);
    for _ in 0..60 {
        let (_, curves) = random_rectangle(&mut random);
        let good = strips(&curves);
        let across = good[0].sample(0.0).across[0];
        for (power, name) in [(0, "corner mismatch"), (2, "C1"), (3, "C3")] {
            let push = across * random.between(0.1, 0.3);
            let mut strips = good.clone();
            strips[0] = GeodesicStrip::new(Damaged {
                curve: curves[0].clone(),
                push,
                power,
            })
            .unwrap();
            let Err(Error::Conditions(violations)) = Rectangle::new(strips) else {
                panic!("{name} was not seen")
            };
            let found: Vec<&str> = violations
                .iter()
                .filter(|v| v.corner().is_some())
                .map(Violation::name)
                .collect();
            assert_eq!(found, [name]);
            assert_eq!(violations[0].corner(), Some(Corner::Rectangle(0, 0)));
        }
        // The same curve twice meets itself with parallel tangents.
        let twice = [
            good[0].clone(),
            good[0].clone(),
            good[2].clone(),
            good[3].clone(),
        ];
        let Err(Error::Conditions(violations)) = Rectangle::new(twice) else {
            panic!("parallel curves were not seen")
        };
        assert_eq!(violations[0].name(), "parallel tangents");
    }
}

#[test]
fn damaged_triangles_are_refused_with_the_condition_named() {
    let mut random = Random(4);
    let mut count = 0;
    while count < 60 {
        let (graph, corners) = (Graph::random(&mut random), corners(&mut random));
        if graph.quadratic[2] < 0.0 {
            continue;
        }
        let sides: Vec<TaylorCurve> = [[1, 2], [2, 0], [0, 1]]
            .iter()
            .map(|[a, b]| graph.between(corners[*a], corners[*b]).unwrap())
            .collect();
        let sides: [TaylorCurve; 3] = sides.try_into().unwrap();
        count += 1;
        let good = strips(&sides);
        let across = good[0].sample(0.0).across[0];
        for (power, name) in [(0, "corner mismatch"), (2, "C1"), (3, "C3")] {
            let mut strips = good.clone();
            let push = across * random.between(0.1, 0.3);
            strips[0] = GeodesicStrip::new(Damaged {
                curve: sides[0].clone(),
                push,
                power,
            })
            .unwrap();
            let Err(Error::Conditions(violations)) = Triangle::new(strips) else {
                panic!("{name} was not seen")
            };
            let found: Vec<&str> = violations
                .iter()
                .filter(|v| v.corner().is_some())
                .map(Violation::name)
                .collect();
            assert_eq!(found, [name]);
            // Side 0 starts at vertex 1.
            assert_eq!(violations[0].corner(), Some(Corner::Triangle(1)));
        }
    }
}
