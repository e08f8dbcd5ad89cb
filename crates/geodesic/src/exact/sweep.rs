//! The sweep: windows go from face to face in the order of their distance.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec2, DVec3};

use super::field::DistanceField;
use super::window::Window;
use crate::mesh::{Mesh, NONE, face_of};
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
    pub(super) entrances: Vec<Entrance>,
    pub(super) windows: Vec<Window>,
    /// Windows cut down to nothing, linked like those of a half-edge.
    pub(super) free: u32,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    /// Vertices and half-edges that the sweep has written to.
    touched_vertices: Vec<u32>,
    touched_halfedges: Vec<u32>,
    pub(super) batch: Vec<Window>,
    pub(super) slots: Vec<u32>,
    purpose: Purpose,
    /// Where the target lies.
    ahead: Option<DVec3>,
    /// A vertex this near to a source is at the same place, to rounding: no direction leads from one to the other.
    pub(super) coincident: f64,
}

/// What a sweep is for: when it stops, and which windows it keeps.
#[derive(Clone, Copy, Debug)]
enum Purpose {
    /// Distances of the vertices: no window is kept.
    Vertices,
    /// Distances of all points up to a limit.
    Field { limit: f64 },
    /// The distance of one point.
    Target(SurfacePoint),
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
pub(super) struct Entrance {
    /// The latest window; the older ones are linked to it.
    pub(super) newest: u32,
    /// How many of them wait to go on.
    pub(super) waiting: u32,
    /// The least distance of those that wait: the key in the queue.
    pub(super) key: f64,
    /// The shortest way through this half-edge to the apex so far, and where it crosses.
    pub(super) apex_distance: f64,
    pub(super) apex_crossing: f64,
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

/// A vertex is where a source is if it is nearer than this part of the mesh's diameter, or of the source's coordinates:
/// some ten roundings.
const COINCIDENT: f64 = 1e-14;

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
            purpose: Purpose::Vertices,
            ahead: None,
            coincident: 0.0,
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
    /// [`Error::NoSource`] without sources; an error about a point that is not on the mesh.
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
    /// As for [`Sweep::from_points`]; [`Error::InvalidLength`] for a limit that is negative or not a number.
    pub fn within(
        &mut self,
        sources: &[SurfacePoint],
        limit: f64,
    ) -> Result<DistanceField<'_, 'm>, Error> {
        if limit.is_nan() || limit < 0.0 {
            return Err(Error::InvalidLength { length: limit });
        }
        self.start(sources, Purpose::Field { limit })?;
        // What lies beyond is known from above only.
        for &v in &self.touched_vertices {
            let distance = &mut self.distances[v as usize];
            if *distance > limit {
                *distance = f64::INFINITY;
            }
        }
        Ok(DistanceField { sweep: self })
    }

    /// Exact distances of all vertices in order, infinite where there is no way from a source: as [`Sweep::from_points`],
    /// with memory for the front of the sweep only.
    ///
    /// # Errors
    ///
    /// As for [`Sweep::from_points`].
    pub fn vertex_distances(&mut self, sources: &[SurfacePoint]) -> Result<&[f64], Error> {
        self.start(sources, Purpose::Vertices)?;
        Ok(&self.distances)
    }

    /// The exact distance between two points.
    ///
    /// Only what may lie on a shortest path is swept, by the straight distance in space that is left to go, and the sweep
    /// stops when it has reached the second point: its time grows with the distance and not with the mesh.
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh; [`Error::NoPath`] between components.
    pub fn distance(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<f64, Error> {
        let to = self.mesh.canonical(to)?;
        self.start(&[from], Purpose::Target(to))?;
        match (DistanceField { sweep: self }).nearest(to) {
            Some((distance, _)) => Ok(distance),
            None => Err(Error::NoPath { from, to }),
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

    /// Empties what the last sweep touched, puts the sources in, and sweeps.
    fn start(&mut self, sources: &[SurfacePoint], purpose: Purpose) -> Result<(), Error> {
        self.sources.clear();
        for &point in sources {
            self.sources.push(self.mesh.canonical(point)?);
        }
        if self.sources.is_empty() {
            return Err(Error::NoSource);
        }
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
        self.purpose = purpose;
        self.ahead = match purpose {
            Purpose::Target(point) => Some(self.mesh.locate(point)),
            _ => None,
        };
        let farthest = |p: DVec3| p.abs().max_element();
        let coordinate = self.sources.iter().map(|&p| farthest(self.mesh.locate(p)));
        self.coincident = COINCIDENT * coordinate.fold(self.mesh.diameter(), f64::max);
        for number in 0..self.sources.len() as u32 {
            match self.sources[number as usize] {
                SurfacePoint::Vertex(v) => self.reach(v, 0.0, Arrival::Source(number)),
                point => self.radiate_inside(point, number),
            }
        }
        self.run();
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
                let key = self.vertex_key(v);
                self.queue.push(Reverse((key.to_bits(), v | VERTEX)));
            }
        }
    }

    #[inline]
    pub(super) fn vertex_distance(&self, v: u32) -> f64 {
        self.distances[v as usize]
    }

    /// Puts a window on its half-edge, to wait there, and the half-edge into the queue.
    pub(super) fn admit(&mut self, h: u32, window: Window) {
        self.hold(h, window);
        self.enqueue(h, window.least());
    }

    /// Puts a half-edge into the queue, by the least distance of its windows.
    #[inline]
    pub(super) fn enqueue(&mut self, h: u32, least: f64) {
        let key = least + self.ahead_of_edge(h);
        let entrance = &mut self.entrances[h as usize];
        if key < entrance.key {
            entrance.key = key;
            self.queue.push(Reverse((key.to_bits(), h)));
        }
    }

    /// The key of a vertex in the queue: the least length of a way by it to the target.
    #[inline]
    fn vertex_key(&self, v: u32) -> f64 {
        let left = self
            .ahead
            .map_or(0.0, |target| self.mesh.position(v).distance(target));
        self.distances[v as usize] + left
    }

    /// What is left to go from an edge to the target, at least.
    #[inline]
    fn ahead_of_edge(&self, h: u32) -> f64 {
        let mesh = self.mesh;
        self.ahead.map_or(0.0, |target| {
            let middle = 0.5 * (mesh.position(mesh.origin(h)) + mesh.position(mesh.tip(h)));
            (middle.distance(target) - 0.5 * mesh.length(h)).max(0.0)
        })
    }

    /// Whether windows of a half-edge are kept when they have gone on.
    #[inline]
    pub(super) fn keeps(&self, h: u32) -> bool {
        match self.purpose {
            Purpose::Vertices => false,
            Purpose::Field { .. } => true,
            Purpose::Target(point) => self.mesh.face_contains(face_of(h), point),
        }
    }

    /// Puts a window on its half-edge.
    #[inline]
    pub(super) fn hold(&mut self, h: u32, mut window: Window) {
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

    /// Distances up to here are known.
    pub(super) fn limit(&self) -> f64 {
        match self.purpose {
            Purpose::Field { limit } => limit,
            Purpose::Vertices | Purpose::Target(_) => f64::INFINITY,
        }
    }

    /// Works off the queue, up to a distance or until nothing in it can bring the target nearer.
    fn run(&mut self) {
        let mut limit = match self.purpose {
            Purpose::Target(point) => self.known_distance(point),
            _ => self.limit(),
        };
        while let Some(Reverse((bits, item))) = self.queue.pop() {
            let key = f64::from_bits(bits);
            if key > limit {
                break;
            }
            let (v, h) = (item & !VERTEX, item);
            let is_vertex = item & VERTEX != 0;
            if is_vertex && self.vertex_key(v) == key {
                self.radiate(v);
            } else if !is_vertex && self.entrances[h as usize].key == key {
                self.enter(h);
            } else {
                continue;
            }
            // The last stretch of a shortest way to the target begins at a vertex or enters by a half-edge of its face.
            if let Purpose::Target(point) = self.purpose
                && self.mesh.faces_of(point).any(|f| match is_vertex {
                    true => self.mesh.faces()[f as usize].contains(&v),
                    false => face_of(h) == f,
                })
            {
                limit = limit.min(self.known_distance(point));
            }
        }
    }

    /// The distance of a canonical point, as far as it is known.
    fn known_distance(&self, point: SurfacePoint) -> f64 {
        DistanceField { sweep: self }
            .nearest(point)
            .map_or(f64::INFINITY, |(distance, _)| distance)
    }
}
