//! Isolines of the distance: inside a face they are arcs of circles about the unfolded sources.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::face::{apex, local_coordinates};
use super::field::DistanceField;
use crate::mesh::Mesh;
use crate::{Error, SurfacePoint};

/// Ends of arcs this close, relative to the mesh, are the same point. They are intersections of circles with edges and with
/// each other, known to half the digits where these touch.
const JOINED: f64 = 1e-7;

/// Ends that have found no partner there look so many times farther: where circles touch at a small angle, half the digits are fewer.
const FARTHER: f64 = 30.0;

/// Distances that differ by less than this share are equal when arcs are sorted out.
const EQUAL: f64 = 1e-10;

/// The least tolerance, relative to the mesh: a circle around it then has some hundred thousand points.
const FINEST: f64 = 1e-10;

/// A line on which the distance has one value.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Isoline {
    /// Its points; those of a closed line end with the first one.
    pub points: Vec<SurfacePoint>,
    /// The same points in space.
    pub positions: Vec<DVec3>,
    /// Whether it closes. If not, it ends at the boundary.
    pub is_closed: bool,
}

/// Ways from one unfolded source into a face, in the plane of the face.
struct Fan {
    centre: DVec2,
    base: f64,
    /// The directions that it holds: from `low`, over `width`, counter-clockwise.
    low: f64,
    width: f64,
}

/// An arc of an isoline in a face.
struct Arc {
    face: u32,
    points: Vec<DVec2>,
}

impl DistanceField<'_, '_> {
    /// The lines on which the distance has a value, as polylines whose points lie on them exactly.
    ///
    /// Between its points a polyline strays from the arcs of circles that the isoline consists of by no more than
    /// `tolerance`, a length.
    ///
    /// ```
    /// use geodesic::{Sweep, shapes};
    /// let torus = shapes::torus(2.0, 0.7, 24, 12)?;
    /// let mut sweep = Sweep::new(&torus);
    /// let field = sweep.from_points(&[0.into()])?;
    /// let lines = field.isolines(1.0, 1e-3)?;
    /// assert!(lines.len() == 1 && lines[0].is_closed); // a ring about the source
    /// # Ok::<(), geodesic::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::InvalidLength`] unless the level and the tolerance are positive and finite; [`Error::InvalidTolerance`] for
    /// a tolerance below 1e-10 of the mesh's diameter, which takes more points than rounding lets differ.
    pub fn isolines(&self, level: f64, tolerance: f64) -> Result<Vec<Isoline>, Error> {
        for length in [level, tolerance] {
            if !length.is_finite() || length <= 0.0 {
                return Err(Error::InvalidLength { length });
            }
        }
        if tolerance < FINEST * self.sweep.mesh().diameter() {
            return Err(Error::InvalidTolerance { tolerance });
        }
        if level > self.sweep.limit() {
            return Ok(Vec::new());
        }
        let mesh = self.sweep.mesh();
        let mut arcs = Vec::new();
        for face in 0..mesh.face_count() as u32 {
            if self.may_reach(face, level) {
                arcs_in_face(
                    mesh,
                    face,
                    &self.fans(face, level),
                    level,
                    tolerance,
                    &mut arcs,
                );
            }
        }
        Ok(join(mesh, &arcs))
    }

    /// Whether a level may be met in a face: the distance changes by no more than one goes.
    fn may_reach(&self, face: u32, level: f64) -> bool {
        let mesh = self.sweep.mesh();
        let longest = (3 * face..3 * face + 3)
            .map(|h| mesh.length(h))
            .fold(0.0, f64::max);
        let corners = mesh.faces()[face as usize].map(|v| self.vertex_distance(v));
        let (low, high) = corners
            .into_iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), d| {
                (low.min(d), if d.is_finite() { high.max(d) } else { high })
            });
        high - longest <= level && level <= low + longest
    }

    /// All ways into a face that may be as long as the level in it.
    fn fans(&self, face: u32, level: f64) -> Vec<Fan> {
        let sweep = self.sweep;
        let mesh = sweep.mesh();
        let corners = corners(mesh, face);
        let mut fans = Vec::new();
        for &source in sweep.sources() {
            if mesh.face_contains(face, source) && !matches!(source, SurfacePoint::Vertex(_)) {
                fans.push(Fan {
                    centre: local_coordinates(mesh, 3 * face, source),
                    base: 0.0,
                    low: 0.0,
                    width: TAU,
                });
            }
        }
        for k in 0..3 {
            let h = 3 * face + k as u32;
            let (origin, tip) = (corners[k], corners[(k + 1) % 3]);
            let third = corners[(k + 2) % 3];
            let distance = self.vertex_distance(mesh.origin(h));
            if distance.is_finite() && sweep.radiates(mesh.origin(h)) {
                fans.push(Fan {
                    centre: origin,
                    base: distance,
                    low: (tip - origin).to_angle(),
                    width: counter_clockwise(tip - origin, third - origin),
                });
            }
            let along = (tip - origin).normalize();
            let place = |p: DVec2| origin + along.rotate(p);
            for window in sweep.windows_of(h) {
                let centre = place(window.source);
                let [start, end] =
                    [window.start, window.end].map(|x| place(DVec2::new(x, 0.0)) - centre);
                fans.push(Fan {
                    centre,
                    base: window.base,
                    low: end.to_angle(),
                    width: counter_clockwise(end, start),
                });
            }
        }
        fans.retain(|fan| fan.base < level && fan.width > 0.0);
        fans
    }
}

/// The corners of a face in the coordinates of its first half-edge.
fn corners(mesh: &Mesh, face: u32) -> [DVec2; 3] {
    let h = 3 * face;
    [DVec2::ZERO, DVec2::new(mesh.length(h), 0.0), apex(mesh, h)]
}

/// The angle from one direction to another, in `[0, 2π)`.
fn counter_clockwise(from: DVec2, to: DVec2) -> f64 {
    from.perp_dot(to).atan2(from.dot(to)).rem_euclid(TAU)
}

impl Fan {
    /// The length of the way to a point, if the fan holds its direction.
    fn distance(&self, p: DVec2) -> Option<f64> {
        let turn = ((p - self.centre).to_angle() - self.low).rem_euclid(TAU);
        (turn <= self.width).then(|| self.base + p.distance(self.centre))
    }
}

/// Finds the arcs of an isoline in a face: of the circle of each fan, what lies in the face and is not nearer by another.
fn arcs_in_face(
    mesh: &Mesh,
    face: u32,
    fans: &[Fan],
    level: f64,
    tolerance: f64,
    arcs: &mut Vec<Arc>,
) {
    let corners = corners(mesh, face);
    let is_inside = |p: DVec2| {
        (0..3).all(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            (b - a).perp_dot(p - a) >= 0.0
        })
    };
    let mut cuts = Vec::new();
    for (i, fan) in fans.iter().enumerate() {
        let radius = level - fan.base;
        if corners.iter().all(|c| c.distance(fan.centre) < radius) {
            continue;
        }
        let at = |turn: f64| fan.centre + radius * DVec2::from_angle(fan.low + turn);
        cuts.clear();
        cuts.extend([0.0, fan.width]);
        let mut cut = |p: DVec2| {
            let turn = ((p - fan.centre).to_angle() - fan.low).rem_euclid(TAU);
            if turn < fan.width {
                cuts.push(turn);
            }
        };
        for k in 0..3 {
            circle_and_line(
                fan.centre,
                radius,
                corners[k],
                corners[(k + 1) % 3],
                &mut cut,
            );
        }
        for other in fans.iter().filter(|other| !std::ptr::eq(*other, fan)) {
            circles(
                fan.centre,
                radius,
                other.centre,
                level - other.base,
                &mut cut,
            );
            // Where the other fan ends its circle may touch this one: that of a vertex and that of the way past it do.
            for angle in [other.low, other.low + other.width] {
                let end = other.centre + DVec2::from_angle(angle);
                circle_and_line(fan.centre, radius, other.centre, end, &mut cut);
            }
        }
        cuts.sort_by(f64::total_cmp);
        // Where another fan is as near, the first one has the arc.
        let is_nearest = |p: DVec2| {
            fans.iter().enumerate().all(|(j, other)| {
                let share = match j.cmp(&i) {
                    std::cmp::Ordering::Less => 1.0 + EQUAL,
                    std::cmp::Ordering::Equal => return true,
                    std::cmp::Ordering::Greater => 1.0 - EQUAL,
                };
                other.distance(p).is_none_or(|d| d > level * share)
            })
        };
        let mut begin = None;
        for (k, pair) in cuts.windows(2).enumerate() {
            let middle = at(0.5 * (pair[0] + pair[1]));
            let shown = pair[0] < pair[1] && is_inside(middle) && is_nearest(middle);
            if shown && begin.is_none() {
                begin = Some(pair[0]);
            }
            let last = k + 2 == cuts.len();
            // Cuts that coincide neither end an arc nor begin one.
            let ends = if shown {
                last
            } else {
                pair[0] < pair[1] || last
            };
            if ends && let Some(start) = begin.take() {
                let end = if shown { pair[1] } else { pair[0] };
                // What is no longer than the join of its neighbours is left to it.
                if (end - start) * radius < 0.5 * JOINED * mesh.diameter() {
                    continue;
                }
                // An arc of angle 2 a strays from its chord by r (1 - cos a) = 2 r sin² (a / 2).
                let half = 2.0 * (0.5 * tolerance / radius).min(0.5).sqrt().asin();
                let steps = ((end - start) / (2.0 * half)).ceil().max(1.0);
                arcs.push(Arc {
                    face,
                    points: (0..=steps as u32)
                        .map(|s| at(start + (end - start) * (f64::from(s) / steps)))
                        .collect(),
                });
            }
        }
    }
}

/// The points of a circle on the line through two points.
fn circle_and_line(centre: DVec2, radius: f64, a: DVec2, b: DVec2, found: &mut impl FnMut(DVec2)) {
    let along = (b - a).normalize();
    let foot = a + along * along.dot(centre - a);
    let half = (radius - foot.distance(centre)) * (radius + foot.distance(centre));
    if half >= 0.0 {
        found(foot + half.sqrt() * along);
        found(foot - half.sqrt() * along);
    }
}

/// The points common to two circles.
fn circles(a: DVec2, radius_a: f64, b: DVec2, radius_b: f64, found: &mut impl FnMut(DVec2)) {
    let apart = a.distance(b);
    if apart == 0.0 {
        return;
    }
    let along = (b - a) / apart;
    let x = 0.5 * (apart + (radius_a - radius_b) * (radius_a + radius_b) / apart);
    let half = (radius_a - x) * (radius_a + x);
    if half >= 0.0 {
        found(a + x * along + half.sqrt() * along.perp());
        found(a + x * along - half.sqrt() * along.perp());
    }
}

/// Joins arcs end to end.
fn join(mesh: &Mesh, arcs: &[Arc]) -> Vec<Isoline> {
    let lines: Vec<Vec<(SurfacePoint, DVec3)>> =
        arcs.iter().map(|arc| on_mesh(mesh, arc)).collect();
    // End 2 i is the first point of line i, end 2 i + 1 its last one.
    let position = |end: u32| {
        let line = &lines[(end / 2) as usize];
        line[if end.is_multiple_of(2) {
            0
        } else {
            line.len() - 1
        }]
        .1
    };
    let ends: Vec<DVec3> = (0..2 * lines.len() as u32).map(position).collect();
    let may_close = |end: u32| lines[(end / 2) as usize].len() > 2;
    let partners = partners(&ends, JOINED * mesh.diameter(), may_close);
    let mut done = vec![false; lines.len()];
    let mut isolines = Vec::new();
    // Open lines first, from their ends; what is left is closed.
    let open = (0..2 * lines.len() as u32).filter(|&end| partners[end as usize].is_none());
    for first in open.chain((0..lines.len() as u32).map(|i| 2 * i)) {
        let mut chain: Vec<(SurfacePoint, DVec3)> = Vec::new();
        let mut next = Some(first);
        while let Some(end) = next.filter(|&end| !done[(end / 2) as usize]) {
            done[(end / 2) as usize] = true;
            let line = &lines[(end / 2) as usize];
            let skip = usize::from(!chain.is_empty());
            if end.is_multiple_of(2) {
                chain.extend(line.iter().skip(skip));
            } else {
                chain.extend(line.iter().rev().skip(skip));
            }
            next = partners[(end ^ 1) as usize];
        }
        if chain.len() < 2 {
            continue;
        }
        let is_closed = partners[first as usize].is_some();
        let (start, count) = (chain[0], chain.len());
        if is_closed {
            chain[count - 1] = start;
        }
        let (points, positions) = chain.into_iter().unzip();
        isolines.push(Isoline {
            points,
            positions,
            is_closed,
        });
    }
    isolines
}

/// The points of an arc on the mesh and in space.
fn on_mesh(mesh: &Mesh, arc: &Arc) -> Vec<(SurfacePoint, DVec3)> {
    let [_, b, c] = corners(mesh, arc.face);
    arc.points
        .iter()
        .map(|p| {
            let third = (p.y / c.y).clamp(0.0, 1.0);
            let second = ((p.x - third * c.x) / b.x).clamp(0.0, 1.0 - third);
            let point = SurfacePoint::Face {
                face: arc.face,
                barycentric: [1.0 - second - third, second, third],
            };
            let point = mesh.canonical(point).unwrap_or(point);
            (point, mesh.locate(point))
        })
        .collect()
}

/// Pairs ends of lines that are the same point, the nearest first: for each one its partner. All arcs run counter-clockwise about
/// their centres, so that an end meets a beginning. The two of one line may be partners if it is long enough to close.
fn partners(points: &[DVec3], tolerance: f64, may_close: impl Fn(u32) -> bool) -> Vec<Option<u32>> {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_by(|&a, &b| points[a as usize].x.total_cmp(&points[b as usize].x));
    let mut partners = vec![None; points.len()];
    for reach in [tolerance, FARTHER * tolerance] {
        let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
        for (i, &a) in order.iter().enumerate() {
            let here = points[a as usize];
            let is_alone = |end: u32| partners[end as usize].is_none();
            if !is_alone(a) {
                continue;
            }
            let candidates = order[i + 1..]
                .iter()
                .take_while(|&&b| points[b as usize].x - here.x <= reach)
                .filter(|&&b| is_alone(b) && a % 2 != b % 2 && (b != a ^ 1 || may_close(a)))
                .map(|&b| (points[b as usize].distance(here), a, b))
                .filter(|(distance, ..)| *distance <= reach);
            pairs.extend(candidates);
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, a, b) in pairs {
            if partners[a as usize].is_none() && partners[b as usize].is_none() {
                (partners[a as usize], partners[b as usize]) = (Some(b), Some(a));
            }
        }
    }
    partners
}

#[cfg(test)]
mod tests;
