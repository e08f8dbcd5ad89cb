//! Tightening a closed curve: shorten one period of it, go on from another of its vertices, until all are straight.

use std::f64::consts::PI;

use super::GeodesicLoop;
use super::cycle::{cycle_of, reduce};
use crate::finder::PathFinder;
use crate::mesh::{Mesh, face_of};
use crate::path::GeodesicPath;
use crate::pivot::{SIDE_ANGLE, Shortener, side_angles};
use crate::strip::Strip;
use crate::{Error, SurfacePoint};

/// A loop shorter than this part of the mesh's diameter has shrunk to a point.
pub(super) const VANISHED: f64 = 1e-9;

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
    pub(super) finder: PathFinder<'m>,
    pub(super) shortener: Shortener,
    pub(super) strip: Strip,
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

    /// The closed geodesic that a closed polyline tightens to: locally shortest, in the polyline's class on the surface.
    ///
    /// No small change makes it shorter, and where passing a vertex on its other side does, it passes there. That it is the
    /// shortest of its class is not proved: a longer valley may lie between.
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

    /// The polyline with its gaps joined, closed, and the face of each of its segments.
    pub(super) fn join(
        &mut self,
        points: &[SurfacePoint],
    ) -> Result<(Vec<SurfacePoint>, Vec<u32>), Error> {
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

    /// Shortens the strip between two points, which may be the same one after a turn round the loop; vertices are passed on
    /// their other side where that is shorter.
    pub(super) fn solve(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<(), Error> {
        let mesh = self.finder.mesh();
        self.shortener.strip.trim(mesh, from, to);
        self.shortener.begin(mesh, from, to);
        let limit = 20 * mesh.face_count() + 100;
        while self.shortener.shorten(mesh, limit, |_, _| {}) {
            if self.shortener.hop(mesh).is_none() {
                return Ok(());
            }
        }
        Err(Error::NotConverged {
            updates: self.shortener.updates,
        })
    }

    pub(super) fn write(&mut self, base: SurfacePoint) -> GeodesicLoop {
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

    pub(super) fn null_loop(&self, near: SurfacePoint) -> Error {
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
