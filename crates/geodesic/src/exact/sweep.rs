//! The sweep: windows in order of distance, trimmed against each other on every half-edge.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec2;

use super::window::{SLIVER, Window, equal_points};
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::{Error, FLAT_ANGLE, SurfacePoint};

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
    mesh: &'m Mesh,
    windows: Vec<Window>,
    /// Windows on each half-edge, sorted and disjoint.
    lists: Vec<Vec<u32>>,
    touched: Vec<u32>,
    distances: Vec<f64>,
    arrivals: Vec<Arrival>,
    reached: Vec<u32>,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    sources: Vec<SurfacePoint>,
    scratch: Vec<u32>,
    born: Vec<Window>,
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

/// In the queue, numbers of vertices carry this bit and numbers of windows do not.
const VERTEX: u32 = 1 << 31;
/// Numbers of sources that are no vertices carry this bit.
pub(crate) const POINT_SOURCE: u32 = 1 << 31;
/// A vertex with more than this angle is a pseudo-source: beyond a full turn by more than the rounding of the angle's sum.
const SADDLE_ANGLE: f64 = std::f64::consts::TAU + FLAT_ANGLE;
/// Rays that miss an interval by this share of the edge still reach the vertex ahead: ends of neighbouring windows agree to
/// rounding only.
const RAY_SLACK: f64 = 1e-13;
/// A vertex distance makes a window useless if it is shorter by more than this share: equal ones stay.
const FILTER_SLACK: f64 = 1e-12;

/// Distances from the sources of a sweep, valid until the next one.
#[derive(Clone, Copy, Debug)]
pub struct DistanceField<'s, 'm> {
    pub(crate) sweep: &'s Sweep<'m>,
}

impl<'m> Sweep<'m> {
    /// A sweep over a mesh, with empty buffers.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            windows: Vec::new(),
            lists: vec![Vec::new(); mesh.halfedge_count()],
            touched: Vec::new(),
            distances: vec![f64::INFINITY; mesh.vertex_count()],
            arrivals: vec![Arrival::None; mesh.vertex_count()],
            reached: Vec::new(),
            queue: BinaryHeap::new(),
            sources: Vec::new(),
            scratch: Vec::new(),
            born: Vec::new(),
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
        self.start(sources)?;
        self.run(f64::INFINITY, None);
        Ok(DistanceField { sweep: self })
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

    /// Number of windows of the last sweep: what its time and memory (56 bytes each) grow with.
    #[must_use]
    pub fn window_count(&self) -> usize {
        self.windows.len()
    }

    /// Bytes held by the buffers.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.windows.capacity() * size_of::<Window>()
            + self
                .lists
                .iter()
                .map(|list| 4 * list.capacity())
                .sum::<usize>()
            + self.lists.capacity() * size_of::<Vec<u32>>()
            + self.distances.capacity() * 8
            + self.arrivals.capacity() * size_of::<Arrival>()
            + self.queue.capacity() * 16
    }

    pub(crate) fn windows_of(&self, halfedge: u32) -> impl Iterator<Item = &Window> {
        self.lists[halfedge as usize]
            .iter()
            .map(|&id| &self.windows[id as usize])
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
        for &h in &self.touched {
            self.lists[h as usize].clear();
        }
        for &v in &self.reached {
            self.distances[v as usize] = f64::INFINITY;
            self.arrivals[v as usize] = Arrival::None;
        }
        self.touched.clear();
        self.reached.clear();
        self.windows.clear();
        self.queue.clear();
        for number in 0..self.sources.len() as u32 {
            match self.sources[number as usize] {
                SurfacePoint::Vertex(v) => self.reach(v, 0.0, Arrival::Source(number)),
                point => self.radiate_inside(point, number),
            }
        }
        Ok(())
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
                if on_edge || mesh.twins()[h as usize] == NONE {
                    continue;
                }
                let length = mesh.length(h);
                let along = (b - a) / length;
                let x = (position - a).dot(along);
                let height = (position - a).cross(along).length();
                let twin = mesh.twins()[h as usize];
                self.insert(Window {
                    start: 0.0,
                    end: length,
                    source: DVec2::new(length - x, -height),
                    base: 0.0,
                    origin: POINT_SOURCE | number,
                    halfedge: twin,
                    done: false,
                });
            }
        }
    }

    /// A distance for a vertex, if it is the shortest so far.
    fn reach(&mut self, v: u32, distance: f64, arrival: Arrival) {
        let known = &mut self.distances[v as usize];
        if distance < *known {
            if known.is_infinite() {
                self.reached.push(v);
            }
            *known = distance;
            self.arrivals[v as usize] = arrival;
            self.queue.push(Reverse((distance.to_bits(), v | VERTEX)));
        }
    }

    fn run(&mut self, limit: f64, target: Option<SurfacePoint>) {
        while let Some(Reverse((bits, item))) = self.queue.pop() {
            let key = f64::from_bits(bits);
            if key > limit || target.is_some_and(|target| self.settled(target, key)) {
                break;
            }
            if item & VERTEX == 0 {
                let window = self.windows[item as usize];
                // Trimmed since it was queued: its own least distance may have grown, so that others come first.
                if !window.done && window.start < window.end {
                    if window.least() > key {
                        self.queue.push(Reverse((window.least().to_bits(), item)));
                        continue;
                    }
                    self.windows[item as usize].done = true;
                    self.propagate(window);
                }
            } else if self.distances[(item & !VERTEX) as usize] == key {
                self.radiate(item & !VERTEX);
            }
        }
    }

    /// Whether nothing at this distance or beyond can bring the target nearer.
    fn settled(&self, target: SurfacePoint, key: f64) -> bool {
        DistanceField { sweep: self }
            .distance(target)
            .is_ok_and(|distance| distance <= key)
    }

    /// A vertex whose distance is final: along its edges, and, where shortest paths may pass it, across its star.
    fn radiate(&mut self, v: u32) {
        let mesh = self.mesh;
        let distance = self.distances[v as usize];
        let is_source = matches!(self.arrivals[v as usize], Arrival::Source(_)) && distance == 0.0;
        let passes = is_source || mesh.is_boundary_vertex(v) || mesh.angle(v) > SADDLE_ANGLE;
        if !passes {
            return;
        }
        let Some(first) = mesh.outgoing(v) else {
            return;
        };
        let mut h = first;
        loop {
            // The face of h: both its other corners, and the edge opposite to v.
            let (tip, opposite) = (mesh.tip(h), next(h));
            self.reach(tip, distance + mesh.length(h), Arrival::Edge(v));
            let third = mesh.tip(opposite);
            self.reach(third, distance + mesh.length(previous(h)), Arrival::Edge(v));
            let twin = mesh.twins()[opposite as usize];
            if twin != NONE {
                let apex = apex(mesh, opposite);
                let length = mesh.length(opposite);
                self.insert(Window {
                    start: 0.0,
                    end: length,
                    source: DVec2::new(length - apex.x, -apex.y),
                    base: distance,
                    origin: v,
                    halfedge: twin,
                    done: false,
                });
            }
            match mesh.counter_clockwise(h) {
                Some(following) if following != first => h = following,
                _ => break,
            }
        }
    }

    /// The rays of a window go on through the face and leave by one or both of its other edges.
    fn propagate(&mut self, window: Window) {
        let mesh = self.mesh;
        let h = window.halfedge;
        let length = mesh.length(h);
        let c = apex(mesh, h);
        let s = window.source;
        // Where the ray to the apex crosses the edge.
        let crossing = s.x + (c.x - s.x) * (-s.y / (c.y - s.y));
        let slack = RAY_SLACK * length;
        if crossing >= window.start - slack && crossing <= window.end + slack {
            let arrival = Arrival::Window {
                halfedge: h,
                source: s,
                origin: window.origin,
            };
            self.reach(mesh.apex(h), window.base + s.distance(c), arrival);
        }
        let corner = DVec2::new(length, 0.0);
        if window.start < crossing {
            // Through the left edge, from the apex down to the origin: the half-edge `previous(h)`.
            let far = if window.end >= crossing {
                0.0
            } else {
                meet(s, window.end, c, DVec2::ZERO)
            };
            let near = meet(s, window.start, c, DVec2::ZERO);
            self.cross(&window, previous(h), c, -c, far, near);
        }
        if window.end > crossing {
            // Through the right edge, from the tip up to the apex: the half-edge `next(h)`.
            let near = meet(s, window.end, corner, c);
            let far = if window.start <= crossing {
                1.0
            } else {
                meet(s, window.start, corner, c)
            };
            self.cross(&window, next(h), corner, c - corner, near, far);
        }
    }

    /// Puts the part `[from, to]` (shares of the edge) of a window onto an edge of its face, seen from the other side.
    fn cross(
        &mut self,
        parent: &Window,
        edge: u32,
        start: DVec2,
        along: DVec2,
        from: f64,
        to: f64,
    ) {
        let mesh = self.mesh;
        let twin = mesh.twins()[edge as usize];
        if twin == NONE || to.is_nan() || to <= from {
            return;
        }
        let length = mesh.length(edge);
        let along = along / length;
        let relative = parent.source - start;
        // The twin runs the other way: its origin is the edge's tip.
        let source = DVec2::new(
            length - relative.dot(along),
            -along.perp_dot(relative).abs(),
        );
        let window = Window {
            start: length * (1.0 - to),
            end: length * (1.0 - from),
            source,
            base: parent.base,
            origin: parent.origin,
            halfedge: twin,
            done: false,
        };
        if !self.is_useless(&window, edge, parent.halfedge) {
            self.insert(window);
        }
    }

    /// Xin and Wang's filter: a window whose far end is nearer to the source by way of a vertex of its face.
    fn is_useless(&self, window: &Window, edge: u32, parent: u32) -> bool {
        let mesh = self.mesh;
        // In the twin's coordinates: origin = tip of the edge at 0, and the edge's origin at its length.
        let length = mesh.length(edge);
        let (at_start, at_end) = (mesh.tip(edge), mesh.origin(edge));
        let (near_start, near_end) = (window.distance(window.start), window.distance(window.end));
        let shorter = |by_vertex: f64, by_window: f64| by_vertex < by_window * (1.0 - FILTER_SLACK);
        if shorter(self.distances[at_start as usize] + window.end, near_end)
            || shorter(
                self.distances[at_end as usize] + (length - window.start),
                near_start,
            )
        {
            return true;
        }
        // The corner of the parent's edge that is not on this edge, and the end of the interval next to the shared corner.
        let (parent_origin, parent_tip) = (mesh.origin(parent), mesh.tip(parent));
        let left = edge == previous(parent);
        let (third, shared_at_start) = if left {
            (parent_tip, at_start == parent_origin)
        } else {
            (parent_origin, at_start == parent_tip)
        };
        let (x, by_window) = if shared_at_start {
            (window.start, near_start)
        } else {
            (window.end, near_end)
        };
        // The corner `third` lies behind the edge: below it, in the twin's coordinates.
        let apex = apex(mesh, edge);
        let behind = DVec2::new(length - apex.x, -apex.y);
        shorter(
            self.distances[third as usize] + behind.distance(DVec2::new(x, 0.0)),
            by_window,
        )
    }

    /// Puts a window among those of its half-edge: of each overlap the nearer one keeps it.
    fn insert(&mut self, window: Window) {
        let h = window.halfedge as usize;
        let sliver = SLIVER * self.mesh.length(window.halfedge);
        let mut list = std::mem::take(&mut self.lists[h]);
        if list.is_empty() {
            self.touched.push(window.halfedge);
        }
        let mut born = std::mem::take(&mut self.born);
        born.clear();
        let mut merged = std::mem::take(&mut self.scratch);
        merged.clear();
        // `rest` walks from the left: what of the new window is not placed yet.
        let mut rest = window.start;
        for &id in &list {
            let old = self.windows[id as usize];
            if old.end <= window.start || old.start >= window.end || rest >= window.end {
                merged.push(id);
                continue;
            }
            if rest < old.start {
                born.push(Window {
                    start: rest,
                    end: old.start.min(window.end),
                    ..window
                });
            }
            let (low, high) = (old.start.max(window.start), old.end.min(window.end));
            self.share(id, &window, low, high, &mut born, &mut merged);
            rest = high;
        }
        if rest < window.end {
            born.push(Window {
                start: rest,
                ..window
            });
        }
        // Neighbouring parts of the new window are one again.
        born.sort_by(|a, b| a.start.total_cmp(&b.start));
        let mut pending: Option<Window> = None;
        for part in born.drain(..).chain([Window {
            start: f64::INFINITY,
            ..window
        }]) {
            match &mut pending {
                Some(known)
                    if known.origin == part.origin
                        && known.end == part.start
                        && known.source == part.source =>
                {
                    known.end = part.end
                }
                _ => {
                    if let Some(known) = pending.replace(part)
                        && known.end - known.start > sliver
                    {
                        merged.push(self.add(known));
                    }
                }
            }
        }
        list.clear();
        list.extend_from_slice(&merged);
        let windows = &self.windows;
        list.sort_by(|&a, &b| {
            windows[a as usize]
                .start
                .total_cmp(&windows[b as usize].start)
        });
        self.lists[h] = list;
        self.born = born;
        self.scratch = merged;
    }

    fn add(&mut self, window: Window) -> u32 {
        let id = self.windows.len() as u32;
        if !window.done {
            self.queue.push(Reverse((window.least().to_bits(), id)));
        }
        self.windows.push(window);
        id
    }

    /// Divides `[low, high]` between an old window and a new one. What the new one wins goes to `born`; what is left of the
    /// old one stays in the list.
    fn share(
        &mut self,
        id: u32,
        new: &Window,
        low: f64,
        high: f64,
        born: &mut Vec<Window>,
        merged: &mut Vec<u32>,
    ) {
        let old = self.windows[id as usize];
        let cuts = equal_points(&old, new, low, high);
        let bounds = [Some(low), cuts[0], cuts[1], Some(high)];
        let mut kept: [Option<(f64, f64)>; 5] = [None; 5];
        let mut count = 0;
        let mut keep = |start: f64, end: f64| {
            if start < end {
                if let Some(slot) = count_last(&mut kept, count)
                    && slot.1 == start
                {
                    slot.1 = end;
                    return;
                }
                kept[count] = Some((start, end));
                count += 1;
            }
        };
        keep(old.start, low);
        let mut start = low;
        for bound in bounds.into_iter().skip(1).flatten() {
            let middle = 0.5 * (start + bound);
            // The old one keeps what is equal: a window twice over would be propagated twice.
            if new.distance(middle) < old.distance(middle) * (1.0 - f64::EPSILON) {
                if start < bound {
                    born.push(Window {
                        start,
                        end: bound,
                        ..*new
                    });
                }
            } else {
                keep(start, bound);
            }
            start = bound;
        }
        keep(high, old.end);
        let sliver = SLIVER * self.mesh.length(old.halfedge);
        let mut first = true;
        for (start, end) in kept
            .into_iter()
            .flatten()
            .filter(|(start, end)| end - start > sliver)
        {
            if first {
                let window = &mut self.windows[id as usize];
                (window.start, window.end) = (start, end);
                merged.push(id);
                first = false;
            } else {
                merged.push(self.add(Window { start, end, ..old }));
            }
        }
        if first {
            // Nothing is left: an empty interval is never propagated.
            let window = &mut self.windows[id as usize];
            (window.start, window.end, window.done) = (0.0, 0.0, true);
        }
    }
}

fn count_last(kept: &mut [Option<(f64, f64)>; 5], count: usize) -> Option<&mut (f64, f64)> {
    kept.get_mut(count.checked_sub(1)?)?.as_mut()
}

/// The apex of a half-edge's face in the half-edge's coordinates, above it.
pub(crate) fn apex(mesh: &Mesh, h: u32) -> DVec2 {
    let (base, right, left) = (
        mesh.length(h),
        mesh.length(next(h)),
        mesh.length(previous(h)),
    );
    let x = 0.5 * (base + (left - right) * (left + right) / base);
    // The height by Heron's formula loses half the digits on needles; from the corner it does not.
    let angle_side = mesh.position(mesh.apex(h)) - mesh.position(mesh.origin(h));
    let along = mesh.position(mesh.tip(h)) - mesh.position(mesh.origin(h));
    DVec2::new(x, angle_side.cross(along).length() / base)
}

/// The share of the segment from `a` to `b` at which the ray from `s` through `(x, 0)` crosses it, within `[0, 1]`.
fn meet(s: DVec2, x: f64, a: DVec2, b: DVec2) -> f64 {
    let direction = DVec2::new(x, 0.0) - s;
    let (start, end) = (direction.perp_dot(a - s), direction.perp_dot(b - s));
    let share = start / (start - end);
    if share.is_nan() {
        0.5
    } else {
        share.clamp(0.0, 1.0)
    }
}

impl<'m> DistanceField<'_, 'm> {
    /// The distance of a vertex; infinite if it was not reached.
    #[must_use]
    pub fn vertex_distance(&self, v: u32) -> f64 {
        self.sweep
            .distances
            .get(v as usize)
            .copied()
            .unwrap_or(f64::INFINITY)
    }

    /// The distances of all vertices in order; infinite where a vertex was not reached.
    #[must_use]
    pub fn vertex_distances(&self) -> &[f64] {
        &self.sweep.distances
    }

    /// The exact distance of any point; infinite if it was not reached.
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh.
    pub fn distance(&self, point: SurfacePoint) -> Result<f64, Error> {
        let point = self.sweep.mesh.canonical(point)?;
        Ok(self
            .nearest(point)
            .map_or(f64::INFINITY, |(distance, _)| distance))
    }

    /// The distance of a canonical point, and the way by which it comes.
    pub(crate) fn nearest(&self, point: SurfacePoint) -> Option<(f64, Way)> {
        let sweep = self.sweep;
        let mesh = sweep.mesh;
        let mut best: Option<(f64, Way)> = None;
        let mut consider = |distance: f64, way: Way| {
            if distance.is_finite() && best.as_ref().is_none_or(|(known, _)| distance < *known) {
                best = Some((distance, way));
            }
        };
        if let SurfacePoint::Vertex(v) = point {
            consider(self.vertex_distance(v), Way::Corner(v));
            return best;
        }
        let position = mesh.locate(point);
        for f in mesh.faces_of(point) {
            for (number, &source) in sweep.sources.iter().enumerate() {
                if mesh.face_contains(f, source) {
                    consider(
                        mesh.locate(source).distance(position),
                        Way::Straight(f, number as u32),
                    );
                }
            }
            for h in 3 * f..3 * f + 3 {
                let v = mesh.origin(h);
                consider(
                    self.vertex_distance(v) + mesh.position(v).distance(position),
                    Way::Face(f, v),
                );
                let local = local_coordinates(mesh, h, point);
                for window in sweep.windows_of(h) {
                    let s = window.source;
                    let crossing = s.x + (local.x - s.x) * (-s.y / (local.y - s.y));
                    let slack = RAY_SLACK * mesh.length(h);
                    let x = if local.y > 0.0 { crossing } else { local.x };
                    if x >= window.start - slack && x <= window.end + slack {
                        consider(window.base + s.distance(local), Way::Window(*window));
                    }
                }
            }
        }
        best
    }
}

/// How the shortest path to a point ends.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Way {
    /// The point is this vertex.
    Corner(u32),
    /// Straight through a face from a source.
    Straight(u32, u32),
    /// Straight through a face from one of its corners.
    Face(u32, u32),
    /// Through a window of the point's face.
    Window(Window),
}

/// A point of the face of `h` in the coordinates of `h`.
pub(crate) fn local_coordinates(mesh: &Mesh, h: u32, point: SurfacePoint) -> DVec2 {
    let weights = mesh
        .barycentric_in(face_of(h), point)
        .unwrap_or([f64::NAN; 3]);
    let corner = (h % 3) as usize;
    let (tip, top) = (weights[(corner + 1) % 3], weights[(corner + 2) % 3]);
    tip * DVec2::new(mesh.length(h), 0.0) + top * apex(mesh, h)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PathFinder, shapes};

    /// A sphere with bumps and hollows: vertices of both signs of curvature.
    fn bumpy(level: u32) -> Mesh {
        let sphere = shapes::sphere(level).unwrap();
        let bump = |p: &glam::DVec3| {
            *p * (1.0 + 0.25 * (5.0 * p.x).sin() * (4.0 * p.y + 1.0).sin() * (6.0 * p.z).cos())
        };
        let positions: Vec<_> = sphere.positions().iter().map(bump).collect();
        Mesh::new(&positions, sphere.faces()).unwrap()
    }

    fn meshes() -> Vec<Mesh> {
        vec![
            shapes::cube().unwrap(),
            shapes::sphere(3).unwrap(),
            bumpy(3),
            shapes::torus(2.0, 0.7, 30, 14).unwrap(),
        ]
    }

    /// The exact distance is symmetric, not above any locally shortest path, and met by the traced path.
    #[test]
    fn distances_are_symmetric_and_traced_paths_have_them() {
        for mesh in meshes() {
            let mut sweep = Sweep::new(&mesh);
            let mut finder = PathFinder::new(&mesh);
            let count = mesh.vertex_count() as u32;
            for i in 0..12 {
                let (a, b) = ((i * 7919) % count, (i * 104_729 + 31) % count);
                let (a, b) = (SurfacePoint::Vertex(a), SurfacePoint::Vertex(b));
                let (there, back) = (sweep.distance(a, b).unwrap(), sweep.distance(b, a).unwrap());
                assert!(
                    (there - back).abs() <= 1e-12 * there,
                    "{a} {b}: {there} {back}"
                );
                let local = finder.shortest(a, b).unwrap().length();
                assert!(
                    local >= there * (1.0 - 1e-12),
                    "{a} {b}: local {local} exact {there}"
                );
                let path = sweep.shortest_path(a, b).unwrap();
                assert!(
                    (path.length() - there).abs() <= 1e-12 * there,
                    "{a} {b}: traced {} exact {there}",
                    path.length()
                );
                assert!(path.certify(&mesh).unwrap().is_geodesic());
            }
        }
    }

    /// Points inside faces obey the triangle inequality with their corners, and match a sweep from the other end.
    #[test]
    fn points_anywhere_are_sources_and_targets() {
        for mesh in meshes() {
            let mut sweep = Sweep::new(&mesh);
            let faces = mesh.face_count() as u32;
            for i in 0..8 {
                let a = mesh
                    .face_point((i * 7919) % faces, [0.2, 0.3, 0.5])
                    .unwrap();
                let b = SurfacePoint::Edge {
                    halfedge: (i * 104_729 + 7) % (3 * faces),
                    t: 0.3,
                };
                let (there, back) = (sweep.distance(a, b).unwrap(), sweep.distance(b, a).unwrap());
                assert!(
                    (there - back).abs() <= 1e-12 * there.max(1e-3),
                    "{a} {b}: {there} {back}"
                );
                let path = sweep.shortest_path(a, b).unwrap();
                assert!((path.length() - there).abs() <= 1e-12 * there.max(1e-3));
            }
        }
    }

    #[test]
    fn a_bounded_sweep_knows_what_it_reached() {
        let mesh = shapes::sphere(4).unwrap();
        let mut sweep = Sweep::new(&mesh);
        let all = sweep
            .from_points(&[SurfacePoint::Vertex(0)])
            .unwrap()
            .vertex_distances()
            .to_vec();
        let near = sweep.within(&[SurfacePoint::Vertex(0)], 0.5).unwrap();
        for (v, distance) in all.iter().enumerate() {
            if *distance < 0.49 {
                assert!((near.vertex_distance(v as u32) - distance).abs() < 1e-14);
            }
        }
        assert!(sweep.from_points(&[]).is_err());
        assert!(
            sweep
                .from_points(&[SurfacePoint::Vertex(1_000_000)])
                .is_err()
        );
    }
}
