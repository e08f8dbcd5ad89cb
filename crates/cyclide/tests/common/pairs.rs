//! Random pairs of cones, each class by its own construction, under random motions and scales.

use cyclide::glam::{DQuat, DVec3};
use cyclide::{Class, Cone};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A small seeded generator (SplitMix64), the same everywhere.
#[derive(Clone, Debug)]
pub struct Random(pub u64);

impl Random {
    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two bounds.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// 1 or -1.
    pub fn sign(&mut self) -> f64 {
        if self.unit() < 0.5 { 1.0 } else { -1.0 }
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> DVec3 {
        let (z, angle) = (self.between(-1.0, 1.0), self.between(0.0, TAU));
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    }

    /// A random rotation.
    pub fn rotation(&mut self) -> DQuat {
        DQuat::from_axis_angle(self.direction(), self.between(0.0, TAU))
    }
}

/// The constructions, by the class that they give.
pub const CONSTRUCTIONS: [&str; 15] = [
    "general",
    "double line",
    "common vertex",
    "common vertex, one double line",
    "common vertex, two double lines",
    "parallel axes",
    "parallel axes, double line",
    "identical axes, different angles",
    "identical axes, equal angles",
    "cone and cylinder",
    "crossing cylinders",
    "parallel cylinders",
    "skew axes",
    "no common sphere",
    "parallel axes, different angles",
];

/// A cone that still moves: vertex, axis, half angle; or a cylinder's point, axis and radius.
#[derive(Clone, Copy, Debug)]
pub struct RawCone {
    /// Vertex or point of the axis.
    pub point: DVec3,
    /// Axis direction.
    pub axis: DVec3,
    /// Half angle; zero for a cylinder.
    pub half_angle: f64,
    /// Radius of a cylinder.
    pub radius: f64,
}

impl RawCone {
    /// The cone of half angle `alpha` about `axis` whose inscribed sphere about `centre` has the radius `radius`, of either sign.
    fn around(centre: DVec3, radius: f64, axis: DVec3, half_angle: f64) -> Self {
        Self {
            point: centre - radius / half_angle.sin() * axis,
            axis,
            half_angle,
            radius: 0.0,
        }
    }

    fn cylinder(point: DVec3, axis: DVec3, radius: f64) -> Self {
        Self {
            point,
            axis,
            half_angle: 0.0,
            radius,
        }
    }

    fn moved(self, motion: &Motion) -> Self {
        Self {
            point: motion.translation + motion.scale * (motion.rotation * self.point),
            axis: motion.rotation * self.axis,
            half_angle: self.half_angle,
            radius: motion.scale * self.radius,
        }
    }

    /// The value of the crate.
    pub fn cone(&self) -> Cone {
        if self.half_angle == 0.0 {
            Cone::cylinder(self.point, self.axis, self.radius).expect("a cylinder")
        } else {
            Cone::new(self.point, self.axis, self.half_angle).expect("a cone")
        }
    }
}

struct Motion {
    rotation: DQuat,
    translation: DVec3,
    scale: f64,
}

/// A random pair of the construction, and its scale.
pub fn pair(construction: &str, random: &mut Random) -> ([RawCone; 2], f64) {
    let cones = canonical(construction, random);
    let scale = 10_f64.powf(random.between(-3.0, 3.0));
    let motion = Motion {
        rotation: random.rotation(),
        translation: 3.0 * scale * random.unit() * random.direction(),
        scale,
    };
    (cones.map(|cone| cone.moved(&motion)), scale)
}

/// Unit axes in the plane `z = 0` at an angle.
fn axes(angle: f64) -> [DVec3; 2] {
    [DVec3::X, DVec3::new(angle.cos(), angle.sin(), 0.0)]
}

/// The product of the unit directions of two oriented cones, for both orientations of the second.
pub fn products(axes: [DVec3; 2], half_angles: [f64; 2]) -> [f64; 2] {
    let [(sin1, cos1), (sin2, cos2)] = half_angles.map(f64::sin_cos);
    [1.0, -1.0].map(|o| (axes[0].dot(axes[1]) - o * sin1 * sin2) / (cos1 * cos2))
}

fn canonical(construction: &str, random: &mut Random) -> [RawCone; 2] {
    let half_angle = |random: &mut Random| random.between(0.15, 1.25);
    let radius = random.between(0.3, 2.0);
    let signs = [random.sign(), random.sign()];
    match construction {
        "general" | "cone and cylinder" | "crossing cylinders" => loop {
            let cylinders = ["general", "cone and cylinder", "crossing cylinders"]
                .iter()
                .position(|&name| name == construction);
            let angles = match cylinders {
                Some(0) => [half_angle(random), half_angle(random)],
                Some(1) => [half_angle(random), 0.0],
                _ => [0.0, 0.0],
            };
            let axes = axes(random.between(0.3, PI - 0.3));
            if products(axes, angles)
                .iter()
                .all(|product| (product.abs() - 1.0).abs() > 0.02)
            {
                return [0, 1].map(|i| {
                    if angles[i] == 0.0 {
                        RawCone::cylinder(axes[i] * random.between(-1.0, 1.0), axes[i], radius)
                    } else {
                        RawCone::around(DVec3::ZERO, signs[i] * radius, axes[i], angles[i])
                    }
                });
            }
        },
        "double line" | "common vertex, one double line" => loop {
            let angles = [half_angle(random), half_angle(random)];
            // The cones touch along a line of the same or of opposite nappes.
            let inside = random.unit() < 0.5;
            let angle = if inside {
                (angles[0] - angles[1]).abs()
            } else {
                angles[0] + angles[1]
            };
            let other = if inside { 1 } else { 0 };
            let axes = axes(angle);
            if !(0.15..=PI - 0.15).contains(&angle)
                || (products(axes, angles)[other].abs() - 1.0).abs() < 0.02
            {
                continue;
            }
            if construction == "common vertex, one double line" {
                return [0, 1]
                    .map(|i| RawCone::around(DVec3::ZERO, 0.0, axes[i] * signs[i], angles[i]));
            }
            // One orientation touches, so that the sphere has to be on matching nappes.
            let flip = if inside { 1.0 } else { -1.0 };
            return [
                RawCone::around(DVec3::ZERO, radius, axes[0], angles[0]),
                RawCone::around(DVec3::ZERO, flip * radius, axes[1], angles[1]),
            ];
        },
        "common vertex" => loop {
            let angles = [half_angle(random), half_angle(random)];
            let axes = axes(random.between(0.3, PI - 0.3));
            if products(axes, angles)
                .iter()
                .all(|product| (product.abs() - 1.0).abs() > 0.02)
            {
                return [0, 1].map(|i| RawCone::around(DVec3::ZERO, 0.0, axes[i], angles[i]));
            }
        },
        "common vertex, two double lines" => {
            let angle = random.between(0.3, FRAC_PI_2 - 0.3);
            let axes = axes(FRAC_PI_2);
            [
                RawCone::around(DVec3::ZERO, 0.0, axes[0], angle),
                RawCone::around(DVec3::ZERO, 0.0, axes[1], FRAC_PI_2 - angle),
            ]
        }
        "parallel axes" | "parallel axes, double line" => loop {
            let angle = half_angle(random);
            let ahead = random.between(-2.0, 2.0);
            let apart = if construction == "parallel axes" {
                random.between(0.2, 3.0)
            } else {
                ahead.abs() * angle.tan()
            };
            let null = (apart - ahead.abs() * angle.tan()).abs();
            if construction == "parallel axes" && null < 0.05 || apart < 0.1 {
                continue;
            }
            let second = DVec3::new(ahead, apart, 0.0);
            return [
                RawCone::around(DVec3::ZERO, 0.0, DVec3::X, angle),
                RawCone::around(second, 0.0, DVec3::X * signs[1], angle),
            ];
        },
        "identical axes, different angles" | "identical axes, equal angles" => loop {
            let first = half_angle(random);
            let second = if construction == "identical axes, equal angles" {
                first
            } else {
                half_angle(random)
            };
            let ahead = random.between(0.3, 3.0) * signs[0];
            if construction == "identical axes, different angles" && (first - second).abs() < 0.05 {
                continue;
            }
            return [
                RawCone::around(DVec3::ZERO, 0.0, DVec3::X, first),
                RawCone::around(DVec3::X * ahead, 0.0, DVec3::X * signs[1], second),
            ];
        },
        "parallel cylinders" => loop {
            let other = random.between(0.3, 2.0);
            let apart = random.between(0.2, 5.0);
            if (apart - (radius - other).abs()).abs() > 0.05
                && (apart - radius - other).abs() > 0.05
            {
                let second = DVec3::new(random.between(-1.0, 1.0), apart, 0.0);
                return [
                    RawCone::cylinder(DVec3::ZERO, DVec3::X, radius),
                    RawCone::cylinder(second, DVec3::X * signs[1], other),
                ];
            }
        },
        "skew axes" => {
            let axes = axes(random.between(0.3, PI - 0.3));
            let apart = DVec3::Z * random.between(0.1, 2.0);
            [
                RawCone::around(DVec3::ZERO, radius, axes[0], half_angle(random)),
                RawCone::around(apart, radius, axes[1], half_angle(random)),
            ]
        }
        "no common sphere" => {
            let axes = axes(random.between(0.3, PI - 0.3));
            let other = radius * random.between(1.2, 3.0);
            [
                RawCone::around(DVec3::ZERO, radius, axes[0], half_angle(random)),
                RawCone::around(DVec3::ZERO, other, axes[1], half_angle(random)),
            ]
        }
        "parallel axes, different angles" => {
            let angle = random.between(0.15, 0.6);
            let second = DVec3::new(random.between(-2.0, 2.0), random.between(0.2, 3.0), 0.0);
            [
                RawCone::around(DVec3::ZERO, 0.0, DVec3::X, angle),
                RawCone::around(
                    second,
                    0.0,
                    DVec3::X * signs[1],
                    angle + random.between(0.05, 0.6),
                ),
            ]
        }
        _ => unreachable!("{construction}"),
    }
}

/// The class and the number of families that the construction must give.
pub fn expected(construction: &str) -> (fn(Class) -> bool, usize) {
    match construction {
        "general" | "cone and cylinder" | "crossing cylinders" => {
            (|class| class == Class::GeneralIntersecting, 2)
        }
        "double line" => (|class| class == Class::DoubleLine, 1),
        "common vertex" => (|class| class == Class::CommonVertex { double_lines: 0 }, 4),
        "common vertex, one double line" => {
            (|class| class == Class::CommonVertex { double_lines: 1 }, 3)
        }
        "common vertex, two double lines" => {
            (|class| class == Class::CommonVertex { double_lines: 2 }, 2)
        }
        "parallel axes" => (|class| class == Class::GeneralParallel, 1),
        "parallel cylinders" => (|class| class == Class::GeneralParallel, 2),
        "identical axes, different angles" => (|class| class == Class::IdenticalAxes, 4),
        "identical axes, equal angles" => (|class| class == Class::IdenticalAxes, 3),
        _ => (|class| matches!(class, Class::NotBlendable(_)), 0),
    }
}
