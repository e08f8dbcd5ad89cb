//! The sweep: windows go from face to face in the order of their distance.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::face::{FlatFace, mirrored};
use super::field::{BEND_SNAP, DistanceField};
use super::window::{Window, trim};
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::{Error, SurfacePoint};

/// Computes exact geodesic distances on a mesh, sweep after sweep, in buffers that are kept.
///
/// ```
/// use geodesic::{Sweep, shapes};
/// let cube = shapes::cube()?;
/// let mut sweep = Sweep::new(&cube);
/// let field = sweep.from_points(&[cube.vertex_point(0)?])?;
/// assert!((field.vertex_distance(7) - 5.0f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sweep<'m> {
    pub(super) mesh: &'m Mesh,
    pub(super) sources: Vec<SurfacePoint>,
    pub(super) distances: Vec<f64>,
    arrivals: Vec<Arrival>,
    entrances: Vec<Entrance>,
    windows: Vec<Window>,
    /// Windows cut down to nothing, linked like those of a half-edge.
    free: u32,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    /// Vertices and half-edges that the sweep has written to.
    touched_vertices: Vec<u32>,
    touched_halfedges: Vec<u32>,
    batch: Vec<Window>,
    slots: Vec<u32>,
}

/// How a vertex got its distance.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Arrival {
    None,
    /// Straight inside a face from a source, by its number.
    Source(u32),
    /// Along an edge from a vertex.
    Edge(u32),
    /// Through a window: the half-edge, the unfolded source in its coordinates, and the source's vertex or number.
    Window {
        halfedge: u32,
        source: DVec2,
        origin: u32,
    },
}

/// What has come in through a half-edge.
#[derive(Clone, Copy, Debug)]
struct Entrance {
    /// The latest window; the older ones are linked to it.
    newest: u32,
    /// How many of them wait to go on.
    waiting: u32,
    /// The least distance of those that wait: the key in the queue.
    key: f64,
    /// The shortest way through this half-edge to the apex so far, and where it crosses.
    apex_distance: f64,
    apex_crossing: f64,
}

impl Entrance {
    const UNTOUCHED: Self = Self {
        newest: NONE,
        waiting: 0,
        key: f64::INFINITY,
        apex_distance: f64::INFINITY,
        apex_crossing: f64::NAN,
    };
}

/// In the queue, numbers of vertices carry this bit and numbers of half-edges do not.
const VERTEX: u32 = 1 << 31;
/// Numbers of sources that are no vertices carry this bit.
pub(crate) const POINT_SOURCE: u32 = 1 << 31;
/// A vertex distance makes a window useless if it is shorter by more than this share: equal ones stay.
const FILTER_SLACK: f64 = 1e-12;

impl<'m> Sweep<'m> {
    /// A sweep over a mesh, with empty buffers.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            sources: Vec::new(),
            distances: vec![f64::INFINITY; mesh.vertex_count()],
            arrivals: vec![Arrival::None; mesh.vertex_count()],
            entrances: vec![Entrance::UNTOUCHED; mesh.halfedge_count()],
            windows: Vec::new(),
            free: NONE,
            queue: BinaryHeap::new(),
            touched_vertices: Vec::new(),
            touched_halfedges: Vec::new(),
            batch: Vec::new(),
            slots: Vec::new(),
        }
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &'m Mesh {
        self.mesh
    }

    /// Exact distances from the nearest of the given points to everything.
    ///
    /// # Errors
    ///
    /// [`Error::EmptyMesh`] without sources; an error about a point that is not on the mesh.
    pub fn from_points(
        &mut self,
        sources: &[SurfacePoint],
    ) -> Result<DistanceField<'_, 'm>, Error> {
        self.within(sources, f64::INFINITY)
    }

    /// As [`Sweep::from_points`], stopping at a distance: farther points have none.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::from_points`].
    pub fn within(
        &mut self,
        sources: &[SurfacePoint],
        limit: f64,
    ) -> Result<DistanceField<'_, 'm>, Error> {
        self.start(sources)?;
        self.run(limit, None);
        Ok(DistanceField { sweep: self })
    }

    /// The exact distance between two points; the sweep stops when it reaches the second one, so that the time grows with
    /// the distance and not with the mesh.
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh; [`Error::NoPath`] between components.
    pub fn distance(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<f64, Error> {
        let to = self.mesh.canonical(to)?;
        self.start(&[from])?;
        self.run(f64::INFINITY, Some(to));
        let distance = DistanceField { sweep: self }.distance(to)?;
        if distance.is_finite() {
            Ok(distance)
        } else {
            Err(Error::NoPath { from, to })
        }
    }

    /// Number of windows of the last sweep: what its time and memory (48 bytes each) grow with.
    #[must_use]
    pub fn window_count(&self) -> usize {
        self.windows.len()
    }

    /// Bytes held by the buffers.
    #[must_use]
    pub fn bytes(&self) -> usize {
        fn held<T>(buffer: &Vec<T>) -> usize {
            buffer.capacity() * size_of::<T>()
        }
        held(&self.sources)
            + held(&self.distances)
            + held(&self.arrivals)
            + held(&self.entrances)
            + held(&self.windows)
            + self.queue.capacity() * size_of::<Reverse<(u64, u32)>>()
            + held(&self.touched_vertices)
            + held(&self.touched_halfedges)
            + held(&self.batch)
            + held(&self.slots)
    }

    /// The windows that came in through a half-edge.
    pub(super) fn windows_of(&self, halfedge: u32) -> impl Iterator<Item = &Window> {
        let mut at = self.entrances[halfedge as usize].newest;
        std::iter::from_fn(move || {
            let window = self.windows.get(at as usize)?;
            at = window.older;
            Some(window)
        })
    }

    pub(crate) fn arrival(&self, vertex: u32) -> Arrival {
        self.arrivals[vertex as usize]
    }

    pub(crate) fn sources(&self) -> &[SurfacePoint] {
        &self.sources
    }

    /// Empties what the last sweep touched, and puts the sources in.
    fn start(&mut self, sources: &[SurfacePoint]) -> Result<(), Error> {
        let canonical = sources
            .iter()
            .map(|&point| self.mesh.canonical(point))
            .collect::<Result<Vec<_>, _>>()?;
        if canonical.is_empty() {
            return Err(Error::EmptyMesh);
        }
        self.sources = canonical;
        for h in self.touched_halfedges.drain(..) {
            self.entrances[h as usize] = Entrance::UNTOUCHED;
        }
        for v in self.touched_vertices.drain(..) {
            self.distances[v as usize] = f64::INFINITY;
            self.arrivals[v as usize] = Arrival::None;
        }
        self.windows.clear();
        self.free = NONE;
        self.queue.clear();
        for number in 0..self.sources.len() as u32 {
            match self.sources[number as usize] {
                SurfacePoint::Vertex(v) => self.reach(v, 0.0, Arrival::Source(number)),
                point => self.radiate_inside(point, number),
            }
        }
        Ok(())
    }

    /// A distance for a vertex, if it is the shortest so far.
    #[inline]
    pub(super) fn reach(&mut self, v: u32, distance: f64, arrival: Arrival) {
        let known = &mut self.distances[v as usize];
        if distance < *known {
            if known.is_infinite() {
                self.touched_vertices.push(v);
            }
            *known = distance;
            self.arrivals[v as usize] = arrival;
            if self.radiates(v) {
                self.queue.push(Reverse((distance.to_bits(), v | VERTEX)));
            }
        }
    }

    #[inline]
    pub(super) fn vertex_distance(&self, v: u32) -> f64 {
        self.distances[v as usize]
    }

    /// Puts a window on its half-edge, to wait there, and the half-edge into the queue.
    pub(super) fn insert(&mut self, h: u32, window: Window) {
        self.hold(h, window);
        self.enqueue(h, window.least());
    }

    /// Puts a half-edge into the queue, at the least distance of its windows.
    #[inline]
    fn enqueue(&mut self, h: u32, least: f64) {
        let entrance = &mut self.entrances[h as usize];
        if least < entrance.key {
            entrance.key = least;
            self.queue.push(Reverse((least.to_bits(), h)));
        }
    }

    /// Puts a window on its half-edge.
    #[inline]
    fn hold(&mut self, h: u32, mut window: Window) {
        let entrance = &mut self.entrances[h as usize];
        if entrance.newest == NONE && entrance.apex_distance.is_infinite() {
            self.touched_halfedges.push(h);
        }
        window.older = entrance.newest;
        if self.free == NONE {
            entrance.newest = self.windows.len() as u32;
            self.windows.push(window);
        } else {
            entrance.newest = self.free;
            let slot = &mut self.windows[self.free as usize];
            self.free = slot.older;
            *slot = window;
        }
        entrance.waiting += 1;
    }

    /// Works off the queue, up to a distance or until nothing in it can bring the target nearer.
    fn run(&mut self, limit: f64, target: Option<SurfacePoint>) {
        let to_target = |sweep: &Self| match target {
            Some(point) => DistanceField { sweep }.nearest(point).map(|(d, _)| d),
            None => None,
        };
        let mut limit = to_target(self).unwrap_or(f64::INFINITY).min(limit);
        while let Some(Reverse((bits, item))) = self.queue.pop() {
            let key = f64::from_bits(bits);
            if key > limit {
                break;
            }
            let (v, h) = (item & !VERTEX, item);
            let is_vertex = item & VERTEX != 0;
            if is_vertex && self.distances[v as usize] == key {
                self.radiate(v);
            } else if !is_vertex && self.entrances[h as usize].key == key {
                self.enter(h);
            } else {
                continue;
            }
            // The last stretch of a shortest way to the target begins at a vertex or enters by a half-edge of its face.
            if let Some(point) = target
                && self.mesh.faces_of(point).any(|f| match is_vertex {
                    true => self.mesh.faces()[f as usize].contains(&v),
                    false => face_of(h) == f,
                })
                && let Some(distance) = to_target(self)
            {
                limit = limit.min(distance);
            }
        }
    }

    /// The windows that wait at a half-edge go on through its face and leave by its other edges.
    fn enter(&mut self, h: u32) {
        let mesh = self.mesh;
        let face = FlatFace::new(mesh, h);
        let (origin, tip, top) = (mesh.origin(h), mesh.tip(h), mesh.apex(h));
        let mut batch = self.take_waiting(h, &face);
        self.arrive_at_apex(h, &face, &batch);
        let split = self.entrances[h as usize].apex_crossing;
        let distances = [origin, tip, top].map(|v| self.vertex_distance(v));
        let left = mesh.twins()[previous(h) as usize];
        if left != NONE {
            let corners = Corners {
                shared: distances[0],
                apex: distances[2],
                behind: distances[1],
            };
            let mut least = f64::INFINITY;
            for window in &batch {
                let to = window.end.min(split);
                if let Some(child) = leave_left(&face, window, window.start, to, &corners) {
                    least = least.min(child.least());
                    self.hold(left, child);
                }
            }
            self.enqueue(left, least);
        }
        let right = mesh.twins()[next(h) as usize];
        if right != NONE {
            let face = face.mirrored();
            let corners = Corners {
                shared: distances[1],
                apex: distances[2],
                behind: distances[0],
            };
            let mut least = f64::INFINITY;
            for window in &batch {
                let window = mirrored(window, face.length);
                let to = window.end.min(face.length - split);
                if let Some(child) = leave_left(&face, &window, window.start, to, &corners) {
                    least = least.min(child.least());
                    self.hold(right, mirrored(&child, face.left));
                }
            }
            self.enqueue(right, least);
        }
        batch.clear();
        self.batch = batch;
    }

    /// Takes copies of the windows that wait, trimmed, and puts what is left of them back among those that have passed.
    fn take_waiting(&mut self, h: u32, face: &FlatFace) -> Vec<Window> {
        let mesh = self.mesh;
        let mut batch = std::mem::take(&mut self.batch);
        let entrance = &mut self.entrances[h as usize];
        entrance.key = f64::INFINITY;
        let mut at = entrance.newest;
        self.slots.clear();
        for _ in 0..entrance.waiting {
            self.slots.push(at);
            let window = self.windows[at as usize];
            batch.push(window);
            at = window.older;
        }
        entrance.waiting = 0;
        let (from_origin, from_tip) = (
            self.distances[mesh.origin(h) as usize],
            self.distances[mesh.tip(h) as usize],
        );
        if batch.len() > 1 {
            trim(&mut batch);
        }
        batch.retain(|window| {
            !(is_shorter(from_origin + window.end, window.distance(window.end))
                || is_shorter(
                    from_tip + face.length - window.start,
                    window.distance(window.start),
                ))
        });
        for (i, &slot) in self.slots.iter().enumerate() {
            if let Some(window) = batch.get(i) {
                self.windows[slot as usize] = Window {
                    older: at,
                    ..*window
                };
                at = slot;
            } else {
                self.windows[slot as usize].older = self.free;
                self.free = slot;
            }
        }
        entrance.newest = at;
        batch
    }

    /// Finds the shortest way of a batch to the apex of the face. Where it crosses the half-edge, the face is divided: no
    /// shortest way crosses that way, so that windows on its left leave by the left side and windows on its right by the
    /// right side (Chen and Han's one angle, one split).
    fn arrive_at_apex(&mut self, h: u32, face: &FlatFace, batch: &[Window]) {
        let entrance = &mut self.entrances[h as usize];
        let mut best = None;
        for window in batch {
            let (distance, crossing, is_straight) = face.way_to_apex(window);
            if distance < entrance.apex_distance {
                entrance.apex_distance = distance;
                entrance.apex_crossing = crossing;
                best = Some((window, is_straight));
            }
        }
        let Some((window, is_straight)) = best else {
            return;
        };
        let (distance, crossing) = (entrance.apex_distance, entrance.apex_crossing);
        let mesh = self.mesh;
        let top = mesh.apex(h);
        let near = BEND_SNAP * face.length;
        if !is_straight && crossing < near {
            let v = mesh.origin(h);
            self.reach(top, self.vertex_distance(v) + face.left, Arrival::Edge(v));
        } else if !is_straight && crossing > face.length - near {
            let v = mesh.tip(h);
            self.reach(top, self.vertex_distance(v) + face.right, Arrival::Edge(v));
        } else {
            let arrival = Arrival::Window {
                halfedge: h,
                source: window.source,
                origin: window.origin,
            };
            self.reach(top, distance, arrival);
        }
    }

    /// A source on an edge or inside a face: straight to the corners of its faces and through their edges.
    fn radiate_inside(&mut self, point: SurfacePoint, number: u32) {
        let mesh = self.mesh;
        for f in mesh.faces_of(point) {
            let position = mesh.locate(point);
            for h in 3 * f..3 * f + 3 {
                let (a, b) = (mesh.position(mesh.origin(h)), mesh.position(mesh.tip(h)));
                self.reach(
                    mesh.origin(h),
                    (position - a).length(),
                    Arrival::Source(number),
                );
                // An edge that the source lies on is not crossed but shared: its other face is one of the source's faces.
                let on_edge = matches!(point, SurfacePoint::Edge { halfedge, .. }
                    if halfedge == h || mesh.twins()[halfedge as usize] == h);
                let twin = mesh.twins()[h as usize];
                if on_edge || twin == NONE {
                    continue;
                }
                let length = mesh.length(h);
                let along = (b - a) / length;
                let x = (position - a).dot(along);
                let height = (position - a).cross(along).length();
                self.insert(
                    twin,
                    Window {
                        start: 0.0,
                        end: length,
                        source: DVec2::new(length - x, -height),
                        base: 0.0,
                        origin: POINT_SOURCE | number,
                        older: NONE,
                    },
                );
            }
        }
    }
}

/// Distances of the corners of a face, seen from a window that leaves by the side between the shared corner and the apex.
struct Corners {
    shared: f64,
    apex: f64,
    behind: f64,
}

/// The part `[from, to]` of a window on the left side of its face, in the coordinates of the half-edge that leads away there;
/// `None` where nothing is left of it, or where a corner of the face is the nearer source for all of it (Xin and Wang's
/// filter).
#[inline]
fn leave_left(
    face: &FlatFace,
    window: &Window,
    from: f64,
    to: f64,
    corners: &Corners,
) -> Option<Window> {
    let crossing = face.apex_crossing(window.source);
    let start = face.meet_left(window.source, from);
    let end = if to >= crossing {
        face.left
    } else {
        face.meet_left(window.source, to)
    };
    let leaves = from < to && from < crossing && start < end;
    if !leaves {
        return None;
    }
    let child = Window {
        start,
        end,
        source: face.over_left(window.source),
        ..*window
    };
    let (near, far) = (child.distance(start), child.distance(end));
    let corner = DVec2::new(face.length, 0.0);
    let foot = face.apex * (start / face.left);
    let useless = is_shorter(corners.shared + end, far)
        || is_shorter(corners.apex + face.left - start, near)
        || is_shorter(corners.behind + corner.distance(foot), near);
    (!useless).then_some(child)
}

#[inline]
fn is_shorter(by_vertex: f64, by_window: f64) -> bool {
    by_vertex < by_window * (1.0 - FILTER_SLACK)
}
