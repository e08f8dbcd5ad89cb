//! The position of two cones: which of Shene's classes it is, why, and the families of blends that follow.

use crate::family::{Conic, Structure};
use crate::{Blend, Cone, Error, Family, SphereLine, tolerance};
use glam::DVec3;
use lorentz::Cycle;
use std::fmt;

/// Why no cyclide blends two cones.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Obstacle {
    /// The axes are skew, at this distance (Lemma 4).
    SkewAxes {
        /// Distance of the two axes.
        distance: f64,
    },
    /// The axes meet, but the spheres inscribed there have different radii.
    NoCommonSphere {
        /// The two radii.
        radii: [f64; 2],
    },
    /// The axes are parallel and the half angles differ (radians).
    ParallelDifferentAngles {
        /// The two half angles.
        half_angles: [f64; 2],
    },
    /// The axes are parallel, the angles equal, and the cones touch along a line (Lemma 19).
    ParallelDoubleLine,
}

/// The class of two cones: the rows of Table 1, and what is outside it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Class {
    /// Intersecting axes and a common inscribed sphere: two families.
    GeneralIntersecting,
    /// Parallel axes and equal angles: one family; two for cylinders.
    GeneralParallel,
    /// Intersecting axes, a common inscribed sphere, and a common tangent plane along a line: one family, cubic.
    DoubleLine,
    /// One vertex: four, three or two families with no, one or two double lines.
    CommonVertex {
        /// Number of lines along which the cones touch.
        double_lines: u8,
    },
    /// One axis: four families of tori; three for cones of equal angles, two for two cylinders.
    IdenticalAxes,
    /// No cyclide blends these cones.
    NotBlendable(Obstacle),
    /// The two cones are one.
    Coincident,
}

impl fmt::Display for Class {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::GeneralIntersecting => "general, intersecting axes",
            Self::GeneralParallel => "general, parallel axes",
            Self::DoubleLine => "double-line, intersecting axes",
            Self::CommonVertex { double_lines: 0 } => "common-vertex",
            Self::CommonVertex { double_lines: 1 } => "common-vertex, 1 double line",
            Self::CommonVertex { .. } => "common-vertex, 2 double lines",
            Self::IdenticalAxes => "identical axes",
            Self::NotBlendable(obstacle) => return write!(formatter, "not-blendable: {obstacle}"),
            Self::Coincident => "invalid: the two cones coincide",
        })
    }
}

impl fmt::Display for Obstacle {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::SkewAxes { .. } => "skew axes",
            Self::NoCommonSphere { .. } => "intersecting axes without a common inscribed sphere",
            Self::ParallelDifferentAngles { .. } => "parallel axes, different angles",
            Self::ParallelDoubleLine => "double line, parallel axes",
        })
    }
}

/// A line along which two cones touch, and their common normal there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DoubleLine {
    /// A point of the line: where the common inscribed sphere touches it, or the common vertex.
    pub point: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// Unit normal of the common tangent plane.
    pub normal: DVec3,
}

/// What [`classify`] finds: the class, the geometry that proves it, and the families of blends.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(remote = "Self")
)]
pub struct Classification {
    class: Class,
    common_spheres: Vec<Cycle>,
    double_lines: Vec<DoubleLine>,
    families: Vec<Family>,
}

impl Classification {
    /// The class.
    #[must_use]
    pub const fn class(&self) -> Class {
        self.class
    }

    /// The common inscribed spheres, oriented as on the first cone (radius zero: the common vertex). Empty for parallel
    /// axes with equal angles, whose common sphere is at infinity.
    #[must_use]
    pub fn common_spheres(&self) -> &[Cycle] {
        &self.common_spheres
    }

    /// The lines along which the cones touch.
    #[must_use]
    pub fn double_lines(&self) -> &[DoubleLine] {
        &self.double_lines
    }

    /// The one-parameter families of blends; empty if the cones cannot be blended.
    #[must_use]
    pub fn families(&self) -> &[Family] {
        &self.families
    }

    /// Why there is no blend, if there is none for this reason.
    #[must_use]
    pub const fn obstacle(&self) -> Option<Obstacle> {
        match self.class {
            Class::NotBlendable(obstacle) => Some(obstacle),
            _ => None,
        }
    }

    /// All members of the point `X` on a diagonal: one of each family whose diagonal passes through it (two for a common vertex, where
    /// each diagonal serves two families).
    ///
    /// # Errors
    ///
    /// [`Error::NotBlendable`] if there is no family; [`Error::NotOnDiagonal`] if `X` is on no diagonal; [`Error::CommonSphere`] where the
    /// diagonals cross; as [`Family::blend`].
    pub fn blends_at(&self, x: DVec3) -> Result<Vec<Blend>, Error> {
        let mut blends = Vec::new();
        let mut nearest = Error::NotBlendable(self.class);
        for family in &self.families {
            match family.blend_at(x) {
                Ok(blend) => blends.push(blend),
                Err(error @ Error::NotOnDiagonal { distance, .. }) => {
                    if !matches!(nearest, Error::NotOnDiagonal { distance: other, .. } if other <= distance)
                    {
                        nearest = error;
                    }
                }
                Err(error) => return Err(error),
            }
        }
        if blends.is_empty() {
            Err(nearest)
        } else {
            Ok(blends)
        }
    }

    /// The members that touch the first cone in the plane perpendicular to its axis at `height` from its vertex (its reference point, if it is a
    /// cylinder): one of each family, so for cones on one axis the four or three tori of Shene's Theorem 16.
    ///
    /// # Errors
    ///
    /// [`Error::NotBlendable`] if there is no family; [`Error::NotFinite`], [`Error::LengthOutOfRange`]. Families that have no cyclide there are left
    /// out; if none has, the error of the first, as [`Family::blend`]: [`Error::CommonSphere`] at the height of the only common sphere.
    pub fn blends_at_height(&self, height: f64) -> Result<Vec<Blend>, Error> {
        crate::frame::length("height", height)?;
        if self.families.is_empty() {
            return Err(Error::NotBlendable(self.class));
        }
        let mut blends = Vec::new();
        let mut failure = None;
        for family in &self.families {
            match family.blend_at_height(height) {
                Ok(blend) => blends.push(blend),
                Err(error) => failure = failure.or(Some(error)),
            }
        }
        match failure {
            Some(error) if blends.is_empty() => Err(error),
            _ => Ok(blends),
        }
    }

    const fn without_families(class: Class) -> Self {
        Self {
            class,
            common_spheres: Vec::new(),
            double_lines: Vec::new(),
            families: Vec::new(),
        }
    }
}

/// The position of two cones or cylinders.
///
/// An oriented cone is a line in the space R^{3,1} of oriented spheres, and a cyclide touches two cones along circles of one
/// family exactly if one of its two conics touches both lines. So the lines must lie in a plane: they meet (in the common
/// inscribed sphere) or they are parallel (equal angles). Each choice of orientation of the second cone is tried.
///
/// Lengths are compared relative to the cones where they are near each other: to the radii of the spheres inscribed at the feet of the common
/// perpendicular of the axes (for parallel axes, to the distance of the two lines of spheres), never to how far away a vertex or the point given on
/// an axis is. Only rounding is allowed for in proportion to that distance.
#[must_use]
pub fn classify(first: &Cone, second: &Cone) -> Classification {
    let pair = Pair::new(first, second);
    if pair.first.axis.cross(pair.second.axis).length() <= tolerance::CLASS {
        pair.parallel_axes(first, second)
    } else {
        pair.crossing_axes()
    }
}

/// Two lines of spheres.
struct Pair {
    first: SphereLine,
    second: SphereLine,
    /// From the first reference point to the second; zero if the two are one point up to rounding.
    offset: DVec3,
    /// What the coordinates of the reference points may be off by.
    rounding: f64,
}

impl Pair {
    fn new(first: &Cone, second: &Cone) -> Self {
        let (first, second) = (first.spheres(), second.spheres());
        let offset = second.point - first.point;
        let farthest = first.point.length().max(second.point.length());
        let offset = if offset.length() <= tolerance::SAME_POINT * farthest {
            DVec3::ZERO
        } else {
            offset
        };
        Self {
            first,
            second,
            offset,
            rounding: tolerance::ROUNDING * (farthest + offset.length()),
        }
    }

    fn crossing_axes(&self) -> Classification {
        let (first, second) = (self.first, self.second);
        let cross = first.axis.cross(second.axis);
        let plane_normal = cross.normalize();
        let along = |axis: DVec3| self.offset.cross(axis).dot(cross) / cross.length_squared();
        let (on_first, on_second) = (first.at(along(second.axis)), second.at(along(first.axis)));
        let radii = [on_first.radius, on_second.radius];
        let larger = radii[0].abs().max(radii[1].abs());
        let reach = along(first.axis).abs().max(along(second.axis).abs());
        let rounding = self.rounding + tolerance::ROUNDING * reach;
        // The vertices of two cones can be nearer than a common sphere, never the point that was given on the axis of a cylinder.
        let local = if first.sin == 0.0 || second.sin == 0.0 {
            larger
        } else {
            larger.min(self.offset.length())
        };
        let distance = self.offset.dot(plane_normal).abs();
        if distance > tolerance::CLASS * local + rounding {
            return Classification::without_families(Class::NotBlendable(Obstacle::SkewAxes {
                distance,
            }));
        }
        let size = or_one(local);
        let near = tolerance::CLASS * larger + rounding;
        let orientations = [1_i8, -1]
            .into_iter()
            .filter(|&o| (radii[0] - f64::from(o) * radii[1]).abs() <= near);
        let common_vertex = orientations.clone().count() == 2;

        let mut common_spheres = Vec::new();
        let mut double_lines = Vec::new();
        let mut families = Vec::new();
        for orientation in orientations {
            let second = if orientation > 0 {
                second
            } else {
                second.reversed()
            };
            let centre = 0.5 * (on_first.centre + second.point + along(first.axis) * second.axis);
            let sphere = if common_vertex {
                Cycle::new(first.point, 0.0)
            } else {
                Cycle::new(centre, 0.5 * (radii[0] + f64::from(orientation) * radii[1]))
            };
            if !common_spheres.contains(&sphere) {
                common_spheres.push(sphere);
            }
            let lines = [first, second];
            let product = first.direction().product(second.direction());
            let family = |pairing: i8, conic| Family {
                lines,
                orientation,
                second_turned: false,
                conic,
                structure: Structure::Meet {
                    sphere,
                    pairing,
                    product,
                },
                plane_normal,
                size,
                one_axis: false,
            };
            if (product.abs() - 1.0).abs() <= tolerance::CLASS {
                let pairing = if product > 0.0 { -1 } else { 1 };
                double_lines.extend(double_line(&lines, sphere, pairing));
                families.push(family(pairing, Conic::Parabola));
            } else {
                let conic = if product.abs() < 1.0 {
                    Conic::Ellipse
                } else {
                    Conic::Hyperbola
                };
                families.extend([family(1, conic), family(-1, conic)]);
            }
        }
        let class = if families.is_empty() {
            Class::NotBlendable(Obstacle::NoCommonSphere {
                radii: radii.map(f64::abs),
            })
        } else if common_vertex {
            Class::CommonVertex {
                double_lines: if double_lines.len() > 1 {
                    2
                } else {
                    double_lines.len() as u8
                },
            }
        } else if double_lines.is_empty() {
            Class::GeneralIntersecting
        } else {
            Class::DoubleLine
        };
        Classification {
            class,
            common_spheres,
            double_lines,
            families,
        }
    }

    fn parallel_axes(&self, first_cone: &Cone, second_cone: &Cone) -> Classification {
        let first = self.first;
        let axis = first.axis;
        let second_turned = axis.dot(self.second.axis) < 0.0;
        let mut second = if second_turned {
            self.second.with_opposite_axis()
        } else {
            self.second
        };
        let mut offset = self.offset;
        if second.sin == 0.0 {
            // Any point of the axis of a cylinder will do: the one beside the first reference point.
            let foot = second.foot(first.point);
            second.point += foot * second.axis;
            offset = second.point - first.point;
        }
        let ahead = offset.dot(axis);
        let sideways = offset - ahead * axis;
        let size = parallel_size(&first, &second, ahead, sideways.length());
        let near = tolerance::CLASS * size + self.rounding;
        let one_axis = sideways.length() <= near;
        let plane_normal = if one_axis {
            axis.any_orthonormal_vector()
        } else {
            axis.cross(sideways).normalize()
        };

        let mut common_spheres = Vec::new();
        let mut families = Vec::new();
        let mut touching = false;
        for orientation in [1_i8, -1] {
            let second = if orientation > 0 {
                second
            } else {
                second.reversed()
            };
            let lines = [first, second];
            let family = |structure| Family {
                lines,
                orientation,
                second_turned,
                conic: Conic::Hyperbola,
                structure,
                plane_normal,
                size,
                one_axis,
            };
            let radius_step = second.radius - first.radius;
            // The sines of nearly flat cones say little of their angles.
            let is_equal_angle = (first.sin - second.sin).abs() <= tolerance::CLASS
                && (first.cos - second.cos).abs() <= tolerance::CLASS;
            if is_equal_angle {
                // The part of the step between the lines that is orthogonal to both: sideways, and along the time-like
                // unit vector (sin alpha d ; 1) / cos alpha.
                let apart = sideways.length();
                let delay = (radius_step - ahead * first.sin) / first.cos;
                if apart <= near && delay.abs() <= near {
                    return Classification::without_families(Class::Coincident);
                }
                if (apart - delay.abs()).abs() <= near {
                    touching = true;
                    continue;
                }
                let sideways = if one_axis { DVec3::ZERO } else { sideways };
                let step = Cycle::new(sideways, 0.0)
                    + Cycle::new(first.sin * axis, 1.0) * (delay / first.cos);
                let conic = if apart > delay.abs() {
                    Conic::Ellipse
                } else {
                    Conic::Hyperbola
                };
                families.push(Family {
                    conic,
                    ..family(Structure::Parallel {
                        step,
                        square: (apart - delay) * (apart + delay),
                    })
                });
            } else if one_axis {
                let s = (radius_step - ahead * second.sin) / (first.sin - second.sin);
                let sphere = first.at(s);
                let product = first
                    .direction()
                    .product(Cycle::new(axis / second.cos, second.sin / second.cos));
                common_spheres.push(sphere);
                for pairing in [1, -1] {
                    families.push(family(Structure::Meet {
                        sphere,
                        pairing,
                        product,
                    }));
                }
            }
        }
        let class = match (families.is_empty(), one_axis) {
            (false, true) => Class::IdenticalAxes,
            (false, false) => Class::GeneralParallel,
            (true, _) if touching => Class::NotBlendable(Obstacle::ParallelDoubleLine),
            (true, _) => Class::NotBlendable(Obstacle::ParallelDifferentAngles {
                half_angles: [first_cone.half_angle(), second_cone.half_angle()],
            }),
        };
        Classification {
            class,
            common_spheres,
            double_lines: Vec::new(),
            families,
        }
    }
}

/// The yardstick for two lines of spheres with parallel axes: their distance if they are parallel, sideways and along the time-like unit vector;
/// the radius of the smaller sphere where they would meet if they had one axis.
fn parallel_size(first: &SphereLine, second: &SphereLine, ahead: f64, sideways: f64) -> f64 {
    let meeting = [1.0, -1.0].map(|sign| {
        let (sin, radius) = (sign * second.sin, sign * second.radius);
        let numerator = first.sin * radius - sin * first.radius - ahead * first.sin * sin;
        (numerator / (first.sin - sin)).abs()
    });
    let smaller = meeting
        .into_iter()
        .filter(|radius| radius.is_finite())
        .fold(f64::INFINITY, f64::min);
    let radius = if smaller.is_finite() {
        smaller
    } else {
        first.radius.max(second.radius)
    };
    or_one(radius.max(sideways))
}

/// A length to compare with, or 1 where the cones share their vertex and no length is given.
fn or_one(size: f64) -> f64 {
    if size > 0.0 { size } else { 1.0 }
}

/// The line of tangency of two oriented cones whose directions have product `-pairing`: the sum of the directions is then
/// light-like and names the common tangent plane.
fn double_line(lines: &[SphereLine; 2], sphere: Cycle, pairing: i8) -> Option<DoubleLine> {
    let light_like = lines[0].direction() + lines[1].direction() * f64::from(pairing);
    let normal = (-light_like.centre / light_like.radius).try_normalize()?;
    let direction = (lines[0].axis + lines[0].sin * normal).try_normalize()?;
    Some(DoubleLine {
        point: sphere.point_with_normal(normal),
        direction,
        normal,
    })
}
