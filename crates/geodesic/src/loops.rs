//! Closed geodesics: tightening a loop (Section 2.3 of the thesis, Figs. 2.10 to 2.12).

use std::f64::consts::PI;

use glam::DVec3;

use crate::finder::PathFinder;
use crate::mesh::{Mesh, face_of};
use crate::path::{Certificate, GeodesicPath, certify};
use crate::pivot::{SIDE_ANGLE, Shortener, push_fan, ray_in_face, side_angles};
use crate::straightest::Straightest;
use crate::strip::{Side, Strip};
use crate::{Error, SurfacePoint};

/// A loop shorter than this part of the mesh's diameter has shrunk to a point.
const VANISHED: f64 = 1e-9;

/// A closed curve on a mesh, made by [`LoopFinder`]: a path that ends where it begins.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeodesicLoop {
    path: GeodesicPath,
    turn: f64,
}

impl GeodesicLoop {
    /// The loop as a path from its first point round to the same point.
    #[must_use]
    pub fn path(&self) -> &GeodesicPath {
        &self.path
    }

    /// Length of the loop.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.path.length
    }

    /// How far the smaller side angle at the first point falls short of π, in radians: 0 for a closed geodesic, the
    /// closing corner for a loop held at a point.
    #[must_use]
    pub fn turn(&self) -> f64 {
        self.turn
    }

    /// All vertices that the loop passes, the first point included if it is one.
    #[must_use]
    pub fn vertices(&self) -> Vec<u32> {
        let first = match self.path.points.first() {
            Some(&SurfacePoint::Vertex(v)) => Some(v),
            _ => None,
        };
        first
            .into_iter()
            .chain(self.path.pivots.iter().map(|pivot| pivot.vertex))
            .collect()
    }

    /// Examines the loop anew, from its points alone: as [`GeodesicPath::certify`], through the first point as well.
    ///
    /// # Errors
    ///
    /// As for [`GeodesicPath::certify`].
    pub fn certify(&self, mesh: &Mesh) -> Result<Certificate, Error> {
        // Twice round: every point is then passed once between two others.
        let mut points = self.path.points.clone();
        points.extend(self.path.points.iter().skip(1));
        let faces = [self.path.faces(), self.path.faces()].concat();
        let certificate = certify(mesh, &points, &faces)?;
        Ok(Certificate {
            length: certificate.length / 2.0,
            ..certificate
        })
    }
}

/// A geodesic loop held at a point, as an answer to "through this point, in this direction".
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DirectedLoop {
    /// The loop; its first point is the given one.
    pub geodesic: GeodesicLoop,
    /// Angle between the given direction and the one in which the loop leaves the point, in radians.
    pub direction_residual: f64,
    /// The corner of the loop at the point, [`GeodesicLoop::turn`]: 0 when it is a closed geodesic.
    pub closing_residual: f64,
}

/// Tightens closed curves on a mesh.
///
/// ```
/// use geodesic::{LoopFinder, SurfacePoint, shapes};
/// let (around, tube) = (24, 12);
/// let torus = shapes::torus(2.0, 0.7, around, tube)?;
/// // The top circle of the torus slides down to the inner equator.
/// let top: Vec<SurfacePoint> = (0..around).map(|i| SurfacePoint::Vertex(tube / 4 * around + i)).collect();
/// let equator = LoopFinder::new(&torus).tighten(&top)?;
/// assert!(equator.certify(&torus)?.is_geodesic());
/// assert!((equator.length() - 24.0 * 2.6 * (std::f64::consts::PI / 24.0).sin()).abs() < 1e-12);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct LoopFinder<'m> {
    finder: PathFinder<'m>,
    shortener: Shortener,
    strip: Strip,
}

impl<'m> LoopFinder<'m> {
    /// A finder on a mesh.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            finder: PathFinder::new(mesh),
            shortener: Shortener::default(),
            strip: Strip::default(),
        }
    }

    /// The closed geodesic that a closed polyline tightens to without crossing a vertex the longer way.
    ///
    /// The last point is joined to the first. Points that do not share a face with the next one are joined to it by a
    /// locally shortest path, so a few points suffice to say which way a loop goes round.
    ///
    /// # Errors
    ///
    /// An error about a point; [`Error::NoPath`]; [`Error::ShortLoop`] for fewer than two points; [`Error::NullLoop`]
    /// if the loop shrinks to a point, as it does where it is contractible; [`Error::NotConverged`].
    pub fn tighten(&mut self, points: &[SurfacePoint]) -> Result<GeodesicLoop, Error> {
        let cycle = self.cycle(points)?;
        self.tighten_cycle(cycle)
    }

    /// The portals that a closed polyline crosses.
    pub(crate) fn cycle(&mut self, points: &[SurfacePoint]) -> Result<Vec<u32>, Error> {
        let (points, faces) = self.join(points)?;
        let mut cycle = cycle_of(self.finder.mesh(), &points, &faces);
        reduce(self.finder.mesh(), &mut cycle);
        Ok(cycle)
    }

    /// The shortest loop in the class of a closed polyline that passes through its first point: a geodesic except for a
    /// corner there.
    ///
    /// # Errors
    ///
    /// As for [`LoopFinder::tighten`].
    pub fn held_at_first(&mut self, points: &[SurfacePoint]) -> Result<GeodesicLoop, Error> {
        let (points, faces) = self.join(points)?;
        let mesh = self.finder.mesh();
        let base = points[0];
        strip_along(mesh, &points, &faces, &mut self.shortener.strip);
        self.solve(base, base)?;
        let geodesic = self.write(base);
        if geodesic.length() < VANISHED * mesh.diameter() {
            return Err(self.null_loop(base));
        }
        Ok(geodesic)
    }

    /// Loops through a point in a direction: a search, with residuals.
    ///
    /// The straightest geodesic from the point is followed for `reach`. Each time that it comes back to within
    /// `tolerance` of the point, the loop so closed is tightened with the point held. The answers are sorted by the sum
    /// of their residuals: where both are 0, the closed geodesic asked for exists; otherwise they say how far the
    /// nearest loops of these classes are from it.
    ///
    /// # Errors
    ///
    /// As for [`Straightest::trace`]; [`Error::DirectionLeavesFace`] if no face lies in that direction.
    pub fn through(
        &mut self,
        point: SurfacePoint,
        direction: DVec3,
        reach: f64,
        tolerance: f64,
    ) -> Result<Vec<DirectedLoop>, Error> {
        let mesh = self.finder.mesh();
        let point = mesh.canonical(point)?;
        let tracer = Straightest::new(mesh);
        let face = tracer
            .face_towards(point, direction)
            .ok_or(Error::DirectionLeavesFace { face: 0 })?;
        let trace = tracer.trace(point, face, direction, reach)?;
        let start = trace.positions[0];
        let mut answers: Vec<DirectedLoop> = Vec::new();
        for i in returns(&trace.positions, start, tolerance) {
            let Ok(geodesic) = self.held_at_first(&trace.points[..=i]) else {
                continue;
            };
            if answers.iter().any(|a| {
                (a.geodesic.length() - geodesic.length()).abs() <= 1e-9 * geodesic.length()
            }) {
                continue;
            }
            let leaving = departure(geodesic.path.positions());
            let wanted = departure(&trace.positions);
            answers.push(DirectedLoop {
                direction_residual: leaving.angle_between(wanted),
                closing_residual: geodesic.turn(),
                geodesic,
            });
        }
        let residual = |a: &DirectedLoop| a.direction_residual + a.closing_residual;
        answers.sort_by(|a, b| residual(a).total_cmp(&residual(b)));
        Ok(answers)
    }

    /// The polyline with its gaps joined, closed, and the face of each of its segments.
    fn join(&mut self, points: &[SurfacePoint]) -> Result<(Vec<SurfacePoint>, Vec<u32>), Error> {
        let mesh = self.finder.mesh();
        let corners: Vec<SurfacePoint> = points
            .iter()
            .map(|&p| mesh.canonical(p))
            .collect::<Result<_, _>>()?;
        if corners.len() < 2 {
            return Err(Error::ShortLoop {
                points: corners.len(),
            });
        }
        let (mut joined, mut faces) = (vec![corners[0]], Vec::new());
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % corners.len()];
            if from == to {
                continue;
            }
            let path = self.finder.shortest(from, to)?;
            joined.extend_from_slice(&path.points()[1..]);
            faces.extend_from_slice(path.faces());
        }
        if faces.is_empty() {
            return Err(Error::ShortLoop {
                points: corners.len(),
            });
        }
        Ok((joined, faces))
    }

    /// Tightens the loop that crosses these portals in turn, the last one leading to the first.
    fn tighten_cycle(&mut self, cycle: Vec<u32>) -> Result<GeodesicLoop, Error> {
        let mesh = self.finder.mesh();
        // Every round ends the job or shortens the loop; a loop has a few rounds for each vertex that it passes.
        let limit = 20 * mesh.face_count() + 100;
        let mut updates = 0;
        let Some(&first) = cycle.first() else {
            return Err(self.null_loop_at(mesh.origin(0), 0.0));
        };
        let mut base = SurfacePoint::Edge {
            halfedge: first,
            t: 0.5,
        };
        self.enter_at_portal(&cycle, 0);
        while updates < limit {
            self.solve(base, base)?;
            updates += self.shortener.updates + 1;
            if self.shortener.length() < VANISHED * mesh.diameter() {
                return Err(self.null_loop(base));
            }
            let (left, right) = self.base_sides(base);
            let smaller = left
                .unwrap_or(f64::INFINITY)
                .min(right.unwrap_or(f64::INFINITY));
            let nodes = self.shortener.nodes.len();
            let straight = match base {
                SurfacePoint::Vertex(_) => smaller >= PI - SIDE_ANGLE,
                _ => nodes == 2 && (smaller - PI).abs() <= SIDE_ANGLE,
            };
            if straight {
                return Ok(self.write(base));
            }
            // Go on from another vertex of the loop, or from where it crosses an edge half-way round.
            let rebased = if nodes > 2 {
                self.rebase_at_node(base, nodes / 2)
            } else if matches!(base, SurfacePoint::Vertex(_)) {
                self.rebase_at_crossing(base)
            } else {
                self.rebase_inside(base)
            };
            base = rebased.ok_or_else(|| self.null_loop(base))?;
        }
        Err(Error::NotConverged { updates })
    }

    /// Shortens the strip between two points, which may be the same one after a turn round the loop.
    fn solve(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<(), Error> {
        let mesh = self.finder.mesh();
        self.shortener.strip.trim(mesh, from, to);
        self.shortener.begin(mesh, from, to);
        if self
            .shortener
            .shorten(mesh, 20 * mesh.face_count() + 100, |_, _| {})
        {
            Ok(())
        } else {
            Err(Error::NotConverged {
                updates: self.shortener.updates,
            })
        }
    }

    fn write(&mut self, base: SurfacePoint) -> GeodesicLoop {
        let mesh = self.finder.mesh();
        let (left, right) = self.base_sides(base);
        let smaller = left
            .unwrap_or(f64::INFINITY)
            .min(right.unwrap_or(f64::INFINITY));
        let mut path = GeodesicPath::default();
        path.set(mesh, &self.shortener, &mut self.strip);
        GeodesicLoop {
            path,
            turn: if smaller.is_finite() {
                (PI - smaller).max(0.0)
            } else {
                0.0
            },
        }
    }

    /// Side angles of the loop at its base.
    fn base_sides(&mut self, base: SurfacePoint) -> (Option<f64>, Option<f64>) {
        let mesh = self.finder.mesh();
        let (Some(first), Some(last)) = (self.shortener.nodes.first(), self.shortener.nodes.last())
        else {
            return (None, None);
        };
        if let SurfacePoint::Vertex(v) = base {
            return side_angles(mesh, v, last.incoming, first.outgoing);
        }
        // On an edge or in a face both sides together are 2π.
        let mut path = GeodesicPath::default();
        path.set(mesh, &self.shortener, &mut self.strip);
        let here = mesh.locate(base);
        let (Some(&ahead), Some(&behind)) =
            (path.positions.get(1), path.positions.iter().rev().nth(1))
        else {
            return (None, None);
        };
        let left = match base {
            SurfacePoint::Edge { halfedge, .. } if path.faces.first() != path.faces.last() => {
                let edge = mesh.position(mesh.tip(halfedge)) - mesh.position(mesh.origin(halfedge));
                let angle =
                    (ahead - here).angle_between(edge) + (behind - here).angle_between(edge);
                // The tip lies to the left when the loop arrives through the face of the half-edge.
                if path.faces.last() == Some(&face_of(halfedge)) {
                    angle
                } else {
                    2.0 * PI - angle
                }
            }
            _ => (ahead - here).angle_between(behind - here),
        };
        (Some(left), Some(2.0 * PI - left))
    }

    /// Rolls the loop on so that it begins at node `k`: the strip from there round to there.
    fn rebase_at_node(&mut self, base: SurfacePoint, k: usize) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let shortener = &mut self.shortener;
        let count = shortener.nodes.len() - 1;
        let mut strip = std::mem::take(&mut shortener.strip);
        strip.restart(shortener.nodes[k].leg.first_face);
        for step in 0..count {
            let i = (k + step) % count;
            let node = shortener.nodes[i];
            if step > 0 {
                join_at(mesh, &mut strip, shortener, i, base);
            }
            for &portal in shortener.portals(node.leg) {
                strip.push(mesh, portal);
            }
        }
        let point = shortener.nodes[k].point;
        shortener.strip = strip;
        Some(point)
    }

    /// Rolls a loop of one leg on so that it begins where it crosses the middle one of its edges.
    fn rebase_at_crossing(&mut self, base: SurfacePoint) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let mut path = GeodesicPath::default();
        path.set(mesh, &self.shortener, &mut self.strip);
        let shortener = &mut self.shortener;
        let portals = shortener.portals(shortener.nodes[0].leg).to_vec();
        let middle = portals.len() / 2;
        let point = *path
            .points
            .get(middle + 1)
            .filter(|_| !portals.is_empty())?;
        let mut strip = std::mem::take(&mut shortener.strip);
        strip.restart(face_of(mesh.twin(portals[middle])?));
        for &portal in &portals[middle + 1..] {
            strip.push(mesh, portal);
        }
        join_at(mesh, &mut strip, shortener, 0, base);
        for &portal in &portals[..middle] {
            strip.push(mesh, portal);
        }
        shortener.strip = strip;
        Some(point)
    }

    /// Goes on from the vertex that a straight loop with a corner must catch on.
    ///
    /// Going once round turns the unfolded strip about a centre. All vertices of the side of the centre lie nearer to it
    /// than the loop does; the loop shrinks until it meets the farthest of them. Around a centre at infinity the loop
    /// would be straight.
    fn rebase_inside(&mut self, base: SurfacePoint) -> Option<SurfacePoint> {
        let mesh = self.finder.mesh();
        let shortener = &mut self.shortener;
        let node = *shortener.nodes.first()?;
        let mut cycle = shortener.portals(node.leg).to_vec();
        // The edge of the base is crossed between the end and the beginning, unless the loop only touches it.
        if let SurfacePoint::Edge { halfedge, .. } = base {
            let last_face = cycle.last().and_then(|&p| mesh.twin(p)).map(face_of)?;
            if last_face != node.leg.first_face {
                let crossing = if face_of(halfedge) == last_face {
                    halfedge
                } else {
                    mesh.twin(halfedge)?
                };
                cycle.insert(0, crossing);
            }
        }
        reduce(mesh, &mut cycle);
        let &first = cycle.first()?;
        // One period and the first portal again, which shows where going round takes it.
        shortener.strip.restart(face_of(first));
        shortener.strip.portals.extend_from_slice(&cycle);
        shortener.strip.portals.push(first);
        shortener
            .strip
            .flatten(mesh, SurfacePoint::Vertex(mesh.apex(first)), base);
        let strip = &shortener.strip;
        let n = cycle.len();
        let (before, after) = (
            strip.left[0] - strip.right[0],
            strip.left[n] - strip.right[n],
        );
        let turn = before.perp_dot(after).atan2(before.dot(after));
        let side = if turn > 0.0 { Side::Left } else { Side::Right };
        // The fixed point of x -> right[n] + R (x - right[0]).
        let shift = strip.right[n] - strip.right[0];
        let half = shift.perp() / (2.0 * (turn / 2.0).tan());
        let centre = strip.right[0] + shift / 2.0 + half;
        let distance = |k: usize| strip.end(k as u32, side).distance_squared(centre);
        let k = (0..n).max_by(|&i, &j| distance(i).total_cmp(&distance(j)))?;
        let end = |portal: u32| {
            if side == Side::Left {
                mesh.tip(portal)
            } else {
                mesh.origin(portal)
            }
        };
        let vertex = end(cycle[k]);
        // On round from the last portal that ends there to the first.
        cycle.rotate_left(k);
        let fan = cycle.iter().take_while(|&&p| end(p) == vertex).count();
        if fan == n {
            return None;
        }
        let lead = cycle
            .iter()
            .rev()
            .take_while(|&&p| end(p) == vertex)
            .count();
        let strip = &mut shortener.strip;
        strip.restart(mesh.twin(cycle[fan - 1]).map(face_of)?);
        strip.portals.extend_from_slice(&cycle[fan..n - lead]);
        Some(SurfacePoint::Vertex(vertex))
    }

    /// The strip from portal `k` of a cycle round to it again.
    fn enter_at_portal(&mut self, cycle: &[u32], k: usize) {
        let mesh = self.finder.mesh();
        let strip = &mut self.shortener.strip;
        strip.restart(mesh.twin(cycle[k]).map_or(0, face_of));
        strip.portals.extend_from_slice(&cycle[k + 1..]);
        strip.portals.extend_from_slice(&cycle[..k]);
    }

    fn null_loop(&self, near: SurfacePoint) -> Error {
        let mesh = self.finder.mesh();
        let vertex = mesh
            .faces_of(near)
            .next()
            .map_or(0, |f| mesh.faces()[f as usize][0]);
        let vertex = if let SurfacePoint::Vertex(v) = near {
            v
        } else {
            vertex
        };
        self.null_loop_at(vertex, self.shortener.length())
    }

    fn null_loop_at(&self, vertex: u32, length: f64) -> Error {
        Error::NullLoop { length, vertex }
    }
}

/// Connects the leg that arrives at node `i` of a loop with the one that leaves it.
fn join_at(mesh: &Mesh, strip: &mut Strip, shortener: &Shortener, i: usize, base: SurfacePoint) {
    let node = shortener.nodes[i];
    let incoming = if i == 0 {
        shortener.nodes[shortener.nodes.len() - 1].incoming
    } else {
        node.incoming
    };
    match node.point {
        SurfacePoint::Vertex(v) => {
            let (left, right) = side_angles(mesh, v, incoming, node.outgoing);
            let side = match (left, right) {
                (Some(l), Some(r)) if r < l => Side::Right,
                (None, Some(_)) => Side::Right,
                _ => Side::Left,
            };
            push_fan(mesh, strip, incoming, node.outgoing, side);
        }
        SurfacePoint::Edge { halfedge, .. } => {
            let last_face = strip.faces(mesh).last();
            debug_assert_eq!(base, node.point);
            if last_face != Some(node.leg.first_face) {
                let crossing = if last_face == Some(face_of(halfedge)) {
                    Some(halfedge)
                } else {
                    mesh.twin(halfedge)
                };
                crossing
                    .into_iter()
                    .for_each(|portal| strip.push(mesh, portal));
            }
        }
        SurfacePoint::Face { .. } => {}
    }
}

/// Cancels steps straight back, across the seam as well.
fn reduce(mesh: &Mesh, cycle: &mut Vec<u32>) {
    let mut strip = Strip::default();
    cycle.drain(..).for_each(|portal| strip.push(mesh, portal));
    let portals = &strip.portals;
    let back = (0..portals.len() / 2)
        .take_while(|&i| mesh.twin(portals[i]) == Some(portals[portals.len() - 1 - i]))
        .count();
    cycle.extend_from_slice(&portals[back..portals.len() - back]);
}

/// The portals that a closed polyline crosses, its last point being its first.
fn cycle_of(mesh: &Mesh, points: &[SurfacePoint], faces: &[u32]) -> Vec<u32> {
    let mut strip = Strip::default();
    strip_along(mesh, points, faces, &mut strip);
    if let (Some(&first), Some(&last)) = (faces.first(), faces.last()) {
        cross_at(mesh, &mut strip, points[0], last, first);
    }
    strip.portals
}

/// The strip of faces along a polyline: over each edge that it crosses, and about each vertex on the side of fewer faces.
pub(crate) fn strip_along(mesh: &Mesh, points: &[SurfacePoint], faces: &[u32], strip: &mut Strip) {
    strip.restart(faces[0]);
    for (i, pair) in faces.windows(2).enumerate() {
        cross_at(mesh, strip, points[i + 1], pair[0], pair[1]);
    }
}

/// From one face of a point to another.
fn cross_at(mesh: &Mesh, strip: &mut Strip, point: SurfacePoint, from: u32, to: u32) {
    if from == to {
        return;
    }
    match point {
        SurfacePoint::Edge { halfedge, .. } => {
            let portal = if face_of(halfedge) == from {
                Some(halfedge)
            } else {
                mesh.twin(halfedge)
            };
            portal
                .into_iter()
                .for_each(|portal| strip.push(mesh, portal));
        }
        SurfacePoint::Vertex(_) => {
            let middle = |face: u32| SurfacePoint::Face {
                face,
                barycentric: [1.0 / 3.0; 3],
            };
            let (incoming, outgoing) = (
                ray_in_face(mesh, from, point, middle(from)),
                ray_in_face(mesh, to, point, middle(to)),
            );
            let count = |side| {
                let mut fan = Strip::default();
                push_fan(mesh, &mut fan, incoming, outgoing, side);
                let arrives = fan
                    .portals
                    .last()
                    .and_then(|&p| mesh.twin(p))
                    .is_some_and(|t| face_of(t) == to);
                if arrives {
                    fan.portals.len()
                } else {
                    usize::MAX
                }
            };
            let side = if count(Side::Left) <= count(Side::Right) {
                Side::Left
            } else {
                Side::Right
            };
            push_fan(mesh, strip, incoming, outgoing, side);
        }
        SurfacePoint::Face { .. } => {}
    }
}

/// Places along a polyline where it comes back to its start, within a tolerance, after having left it.
fn returns(positions: &[DVec3], start: DVec3, tolerance: f64) -> Vec<usize> {
    let mut found = Vec::new();
    let mut nearest: Option<(f64, usize)> = None;
    let mut left = false;
    for (i, p) in positions.iter().enumerate() {
        let distance = p.distance(start);
        if distance > tolerance {
            found.extend(nearest.take().map(|(_, i)| i));
            left = true;
        } else if left && nearest.is_none_or(|(smallest, _)| distance < smallest) {
            nearest = Some((distance, i));
        }
    }
    found.extend(nearest.map(|(_, i)| i));
    found
}

/// Direction of the first segment that is long enough to have one.
fn departure(positions: &[DVec3]) -> DVec3 {
    positions
        .windows(2)
        .find_map(|ends| (ends[1] - ends[0]).try_normalize())
        .unwrap_or(DVec3::X)
}
