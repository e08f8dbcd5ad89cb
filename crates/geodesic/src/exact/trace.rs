//! Exact shortest paths, traced back through the windows of a sweep.

use glam::DVec2;

use super::face::{apex, local_coordinates};
use super::field::{DistanceField, Way};
use super::sweep::{Arrival, POINT_SOURCE, Sweep};
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::{Error, GeodesicPath, PathFinder, SurfacePoint};

impl<'m> Sweep<'m> {
    /// The globally shortest path between two points, with its exact length.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::distance`]; [`Error::NotConverged`] if the path could not be traced back, which no known mesh brings
    /// about.
    pub fn shortest_path(
        &mut self,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<GeodesicPath, Error> {
        let (from, to) = (self.mesh().canonical(from)?, self.mesh().canonical(to)?);
        self.distance(from, to)?;
        let mut finder = PathFinder::new(self.mesh());
        DistanceField { sweep: self }.path_to(to, &mut finder)
    }

    /// The shortest path between the ends of a path: that path itself with the proof that none is shorter, or a shorter one.
    ///
    /// ```
    /// use geodesic::{PathFinder, Sweep, shapes};
    /// let torus = shapes::torus(2.0, 0.7, 30, 14)?;
    /// let local = PathFinder::new(&torus).shortest(0.into(), 200.into())?.clone();
    /// let global = Sweep::new(&torus).shorten_globally(&local)?;
    /// assert!(global.path.length() <= local.length());
    /// println!("{} by {}", global.was_shortest, local.length() / global.distance - 1.0);
    /// # Ok::<(), geodesic::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`Sweep::shortest_path`]; [`Error::SegmentLeavesFace`] for a path without points; [`Error::OtherMesh`] or
    /// another error about the path if it does not lie on this mesh.
    pub fn shorten_globally(&mut self, path: &GeodesicPath) -> Result<Globally, Error> {
        let (Some(&from), Some(&to)) = (path.points().first(), path.points().last()) else {
            return Err(Error::SegmentLeavesFace { position: 0 });
        };
        let length = path.measure(self.mesh())?.length;
        let distance = self.distance(from, to)?;
        let was_shortest = length <= distance * (1.0 + EQUAL_LENGTHS);
        let path = if was_shortest {
            path.clone()
        } else {
            let mut finder = PathFinder::new(self.mesh());
            DistanceField { sweep: self }.path_to(to, &mut finder)?
        };
        Ok(Globally {
            path,
            distance,
            was_shortest,
        })
    }
}

/// A path is a shortest one if it is longer than the exact distance by no more than this share: the rounding of both.
const EQUAL_LENGTHS: f64 = 1e-12;

/// What [`Sweep::shorten_globally`] found.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Globally {
    /// A globally shortest path.
    pub path: GeodesicPath,
    /// The exact distance of its ends.
    pub distance: f64,
    /// Whether it is the path that was given, proved shortest.
    pub was_shortest: bool,
}

impl DistanceField<'_, '_> {
    /// The exact shortest path from the nearest source to a point.
    ///
    /// # Errors
    ///
    /// [`Error::OtherMesh`] for a finder on another mesh than the field; an error about a point that is not on the mesh;
    /// [`Error::NoPath`] to a point that was not reached; [`Error::NotConverged`] if the trace was lost.
    pub fn path_to(
        &self,
        to: SurfacePoint,
        finder: &mut PathFinder<'_>,
    ) -> Result<GeodesicPath, Error> {
        let mesh = self.sweep.mesh();
        if !std::ptr::eq(mesh, finder.mesh()) {
            return Err(Error::OtherMesh { what: "finder" });
        }
        let to = mesh.canonical(to)?;
        let mut faces: Vec<u32> = Vec::new();
        let mut at = to;
        let limit = 4 * mesh.face_count() + 100;
        let source = loop {
            if faces.len() > limit {
                return Err(Error::NotConverged {
                    updates: faces.len(),
                });
            }
            match self.step_back(at, &mut faces)? {
                Back::Source(source) => break source,
                Back::Vertex(v) => at = SurfacePoint::Vertex(v),
            }
        };
        faces.dedup();
        faces.reverse();
        let joined = join_around_vertices(mesh, &faces);
        finder.along_in_class(&joined, source, to).cloned()
    }

    /// Goes back from a point to the vertex or source from which its last straight stretch comes.
    fn step_back(&self, at: SurfacePoint, faces: &mut Vec<u32>) -> Result<Back, Error> {
        let sweep = self.sweep;
        let mesh = sweep.mesh();
        let source = |number: u32| Back::Source(sweep.sources()[number as usize]);
        let nowhere = Error::NoPath {
            from: sweep.sources()[0],
            to: at,
        };
        let (halfedge, unfolded, origin, point) = match self.nearest(at).ok_or(nowhere.clone())?.1 {
            Way::Straight(f, number) => {
                faces.push(f);
                return Ok(source(number));
            }
            Way::Face(f, v) => {
                faces.push(f);
                return Ok(Back::Vertex(v));
            }
            Way::Window(h, window) => {
                let local = local_coordinates(mesh, h, at);
                (h, window.source, window.origin, local)
            }
            Way::Corner(v) => match sweep.arrival(v) {
                Arrival::Source(number) => {
                    let from = sweep.sources()[number as usize];
                    if let Some(f) = mesh
                        .faces_of(SurfacePoint::Vertex(v))
                        .find(|&f| mesh.face_contains(f, from))
                    {
                        faces.push(f);
                    }
                    return Ok(source(number));
                }
                Arrival::Edge(u) => {
                    if let Some(f) = mesh
                        .faces_of(SurfacePoint::Vertex(v))
                        .find(|&f| mesh.face_contains(f, SurfacePoint::Vertex(u)))
                    {
                        faces.push(f);
                    }
                    return Ok(Back::Vertex(u));
                }
                Arrival::Window {
                    halfedge,
                    source,
                    origin,
                } => (halfedge, source, origin, apex(mesh, halfedge)),
                Arrival::None => return Err(nowhere),
            },
        };
        self.unfold_back(halfedge, unfolded, origin, point, faces)
    }

    /// Walks straight from a point of the face of `h` through `h` towards an unfolded source, until the source's face or a
    /// vertex on the way.
    fn unfold_back(
        &self,
        mut h: u32,
        mut source: DVec2,
        origin: u32,
        mut point: DVec2,
        faces: &mut Vec<u32>,
    ) -> Result<Back, Error> {
        let mesh = self.sweep.mesh();
        faces.push(face_of(h));
        let ends = [
            (mesh.origin(h), DVec2::ZERO),
            (mesh.tip(h), DVec2::new(mesh.length(h), 0.0)),
        ];
        for (v, end) in ends {
            if is_on_the_way(point, source, end) {
                return Ok(Back::Vertex(v));
            }
        }
        let limit = faces.len() + 2 * mesh.face_count() + 10;
        loop {
            let twin = mesh.twins()[h as usize];
            if faces.len() > limit {
                return Err(Error::NotConverged {
                    updates: faces.len(),
                });
            }
            if twin == NONE {
                // The way touches the boundary at a vertex, and rounding (on needles, much more than `PASSING`) takes it
                // across.
                let x = point.x - (source.x - point.x) * point.y / (source.y - point.y);
                return Ok(Back::Vertex(if 2.0 * x < mesh.length(h) {
                    mesh.origin(h)
                } else {
                    mesh.tip(h)
                }));
            }
            let f = face_of(twin);
            faces.push(f);
            let there = match origin & POINT_SOURCE {
                0 => mesh.faces()[f as usize].contains(&origin),
                _ => mesh.face_contains(f, self.sweep.sources()[(origin & !POINT_SOURCE) as usize]),
            };
            // The twin's coordinates: turned by half a turn about the middle of the edge, the face now above.
            let length = mesh.length(h);
            let turned = |p: DVec2| DVec2::new(length - p.x, -p.y);
            let (s, p) = (turned(source), turned(point));
            let c = apex(mesh, twin);
            // The source is in this face if it is not beyond both other edges.
            if there && is_inside(s, c, length) {
                return Ok(match origin & POINT_SOURCE {
                    0 => Back::Vertex(origin),
                    _ => Back::Source(self.sweep.sources()[(origin & !POINT_SOURCE) as usize]),
                });
            }
            if is_on_the_way(p, s, c) {
                return Ok(Back::Vertex(mesh.apex(twin)));
            }
            // The segment from p (below) to s (above, beyond the face) leaves to the left or the right of the apex.
            let side = (s - p).perp_dot(c - p);
            let (edge, start, along) = if side > 0.0 {
                (
                    next(twin),
                    DVec2::new(length, 0.0),
                    c - DVec2::new(length, 0.0),
                )
            } else {
                (previous(twin), c, -c)
            };
            let along = along.normalize();
            let to_edge = |q: DVec2| DVec2::new((q - start).dot(along), along.perp_dot(q - start));
            (source, point, h) = (to_edge(s), to_edge(p), edge);
        }
    }
}

/// A vertex that the straight way from `p` to `s` passes within this angle, in radians, is on it.
///
/// Rounding could otherwise lead the trace to the wrong side, over a boundary even. The way by the vertex is longer by the
/// square of the angle only.
const PASSING: f64 = 1e-12;

/// Whether a vertex at `c` lies on the straight way from `p` to `s`.
fn is_on_the_way(p: DVec2, s: DVec2, c: DVec2) -> bool {
    let (way, aside) = (s - p, c - p);
    way.perp_dot(aside).abs() <= PASSING * way.length() * aside.length()
        && way.dot(aside) > 0.0
        && aside.length() <= way.length()
}

enum Back {
    Source(SurfacePoint),
    Vertex(u32),
}

/// Whether a point lies in the triangle over `[0, length]` with this apex, up to rounding.
fn is_inside(s: DVec2, apex: DVec2, length: f64) -> bool {
    let slack = -1e-9 * length * length;
    let corner = DVec2::new(length, 0.0);
    (apex - corner).perp_dot(s - corner) >= slack
        && (-apex).perp_dot(s - apex) >= slack
        && s.y >= -1e-9 * length
}

/// Fills the turns around vertices in a list of faces, so that consecutive faces share an edge.
pub(crate) fn join_around_vertices(mesh: &Mesh, faces: &[u32]) -> Vec<u32> {
    let mut joined: Vec<u32> = Vec::with_capacity(faces.len());
    for &f in faces {
        if let Some(&last) = joined.last() {
            let neighbours = (3 * last..3 * last + 3).any(|h| {
                mesh.twins()[h as usize] != NONE && face_of(mesh.twins()[h as usize]) == f
            });
            if !neighbours && last != f {
                joined.extend(around(mesh, last, f));
            }
        }
        if joined.last() != Some(&f) {
            joined.push(f);
        }
    }
    joined
}

/// The faces between two faces around a vertex that they share, the shorter way; nothing if they share none.
fn around(mesh: &Mesh, from: u32, to: u32) -> Vec<u32> {
    let shared = mesh.faces()[from as usize]
        .into_iter()
        .find(|v| mesh.faces()[to as usize].contains(v));
    let Some(v) = shared else { return Vec::new() };
    let Some(start) = (3 * from..3 * from + 3).find(|&h| mesh.origin(h) == v) else {
        return Vec::new();
    };
    let walk = |step: &dyn Fn(u32) -> Option<u32>| -> Option<Vec<u32>> {
        let mut faces = Vec::new();
        let mut h = step(start)?;
        while h != start {
            if face_of(h) == to {
                return Some(faces);
            }
            faces.push(face_of(h));
            h = step(h)?;
        }
        None
    };
    let (left, right) = (
        walk(&|h| mesh.counter_clockwise(h)),
        walk(&|h| mesh.clockwise(h)),
    );
    match (left, right) {
        (Some(a), Some(b)) => {
            if a.len() <= b.len() {
                a
            } else {
                b
            }
        }
        (Some(a), None) | (None, Some(a)) => a,
        (None, None) => Vec::new(),
    }
}
