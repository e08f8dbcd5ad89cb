//! Queries for locally shortest paths.

use crate::loops::strip_along;
use crate::mesh::Mesh;
use crate::path::GeodesicPath;
use crate::pivot::Shortener;
use crate::search::Search;
use crate::strip::Strip;
use crate::{Error, SurfacePoint};

/// Where shortening starts. The start chooses the class of paths, relative to the vertices, in which the shortest one is
/// found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Start {
    /// The shortest path over vertices, along edges and straight across edges.
    #[default]
    Vertices,
    /// The shortest path along edges.
    Edges,
    /// The shortest path over faces, from centroid to centroid.
    Faces,
}

/// Finds locally shortest paths on a mesh, query after query, without allocating once its buffers have grown.
///
/// ```
/// use geodesic::{PathFinder, shapes};
/// let cube = shapes::cube()?;
/// let mut finder = PathFinder::new(&cube);
/// let path = finder.shortest(cube.vertex_point(0)?, cube.vertex_point(7)?)?;
/// assert!((path.length() - 5.0f64.sqrt()).abs() < 1e-14); // across two faces laid flat
/// assert!(path.certify(&cube)?.is_geodesic());
/// # Ok::<(), geodesic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PathFinder<'m> {
    mesh: &'m Mesh,
    start: Start,
    neighbours: bool,
    search: Search,
    shortener: Shortener,
    strip: Strip,
    path: GeodesicPath,
    visits: Vec<u32>,
}

impl<'m> PathFinder<'m> {
    /// A finder on a mesh, with empty buffers.
    #[must_use]
    pub fn new(mesh: &'m Mesh) -> Self {
        Self {
            mesh,
            start: Start::default(),
            neighbours: true,
            search: Search::default(),
            shortener: Shortener::default(),
            strip: Strip::default(),
            path: GeodesicPath::default(),
            visits: Vec::new(),
        }
    }

    /// The same finder with another kind of start.
    #[must_use]
    pub fn with_start(mut self, start: Start) -> Self {
        self.start = start;
        self
    }

    /// Whether a path that is locally shortest is given up for a shorter one that passes a vertex close to it on the
    /// other side, over and over; on unless switched off. Without it the result is the shortest path in the class, relative
    /// to the vertices, that pivot updates alone reach from the start.
    #[must_use]
    pub fn with_neighbouring_classes(mut self, explore: bool) -> Self {
        self.neighbours = explore;
        self
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> &'m Mesh {
        self.mesh
    }

    /// A locally shortest path between two points anywhere on the mesh.
    ///
    /// The path stays in the finder; clone it to keep it beyond the next query.
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh (see [`Mesh::canonical`]); [`Error::NoPath`] between components;
    /// [`Error::NotConverged`] if shortening was stopped, which no known mesh brings about.
    pub fn shortest(
        &mut self,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<&GeodesicPath, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.search(from, to)?;
        self.shorten(from, to)
    }

    /// The stages of [`PathFinder::shortest`]: the taut path in the initial sequence of faces, and the path after each
    /// update, the last one being the answer.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::shortest`].
    pub fn stages(
        &mut self,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<Vec<GeodesicPath>, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.search(from, to)?;
        let mesh = self.mesh;
        let mut stages: Vec<GeodesicPath> = Vec::new();
        self.shorten_observed(from, to, |shortener, strip| {
            let mut path = GeodesicPath::default();
            path.set(mesh, shortener, strip);
            stages.push(path);
        })?;
        for (k, stage) in stages.iter_mut().enumerate() {
            stage.updates.extend_from_slice(&self.path.updates[..k]);
        }
        Ok(stages)
    }

    /// The locally shortest path that shortening reaches from a caller's polyline on the mesh: a guide that says on
    /// which side of the vertices the path should pass. It begins at the first point and ends at the last; points that do
    /// not share a face with the next one are joined to it by a locally shortest path.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::shortest`]; [`Error::ShortLoop`] for fewer than two points.
    pub fn guided(&mut self, points: &[SurfacePoint]) -> Result<&GeodesicPath, Error> {
        let corners: Vec<SurfacePoint> = points
            .iter()
            .map(|&p| self.mesh.canonical(p))
            .collect::<Result<_, _>>()?;
        let [from, .., to] = corners[..] else {
            return Err(Error::ShortLoop {
                points: corners.len(),
            });
        };
        let (mut joined, mut faces) = (vec![from], Vec::new());
        for ends in corners.windows(2).filter(|ends| ends[0] != ends[1]) {
            let path = self.shortest(ends[0], ends[1])?;
            joined.extend_from_slice(&path.points[1..]);
            faces.extend_from_slice(&path.faces);
        }
        if faces.is_empty() {
            return self.shortest(from, to);
        }
        strip_along(self.mesh, &joined, &faces, &mut self.shortener.strip);
        self.shorten_in_class(from, to)
    }

    /// The locally shortest path that shortening reaches from a caller's sequence of neighbouring faces.
    ///
    /// Faces before the last one that contains `from`, after the first one that contains `to`, and between two visits to
    /// the same face are dropped.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::shortest`]; [`Error::BrokenSequence`], [`Error::NoSuchFace`];
    /// [`Error::SequenceMissesPoint`] if the first or last face does not contain its point.
    pub fn along(
        &mut self,
        faces: &[u32],
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<&GeodesicPath, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.enter(faces, from, to)?;
        self.shorten(from, to)
    }

    /// As [`PathFinder::along`], never giving up the class of paths for a neighbouring one.
    pub(crate) fn along_in_class(
        &mut self,
        faces: &[u32],
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<&GeodesicPath, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.enter(faces, from, to)?;
        self.shorten_in_class(from, to)
    }

    /// The shortest path within a caller's sequence of faces, without any update: taut, but not in general a geodesic.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::along`].
    pub fn taut(
        &mut self,
        faces: &[u32],
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<&GeodesicPath, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.enter(faces, from, to)?;
        self.shortener.begin(self.mesh, from, to);
        self.path.updates.clear();
        self.path.set(self.mesh, &self.shortener, &mut self.strip);
        Ok(&self.path)
    }

    /// What is left of a caller's sequence of faces for a path between two points: faces before the last one that
    /// contains `from`, after the first one that contains `to`, and between two visits to the same face are dropped.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::along`].
    pub fn trimmed(
        &mut self,
        faces: &[u32],
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<Vec<u32>, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.enter(faces, from, to)?;
        Ok(self.shortener.strip.faces(self.mesh).collect())
    }

    /// Finds the initial path alone, before any shortening, and returns the number of faces on it.
    ///
    /// # Errors
    ///
    /// As for [`PathFinder::shortest`].
    pub fn search_only(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<usize, Error> {
        let (from, to) = (self.mesh.canonical(from)?, self.mesh.canonical(to)?);
        self.search(from, to)?;
        Ok(self.shortener.strip.portals.len() + 1)
    }

    /// Nodes settled by the search of the last query: what its time grows with.
    #[must_use]
    pub fn settled(&self) -> usize {
        self.search.settled
    }

    fn enter(&mut self, faces: &[u32], from: SurfacePoint, to: SurfacePoint) -> Result<(), Error> {
        let strip = &mut self.shortener.strip;
        strip.through_faces(self.mesh, faces)?;
        for (end, point) in [(faces.first(), from), (faces.last(), to)] {
            if !end.is_some_and(|&f| self.mesh.face_contains(f, point)) {
                return Err(Error::SequenceMissesPoint { point });
            }
        }
        self.visits.resize(self.mesh.face_count(), u32::MAX);
        strip.cut_detours(self.mesh, from, to, &mut self.visits);
        Ok(())
    }

    /// Puts the initial sequence of faces into the strip: none but the common face, where there is one.
    fn search(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<(), Error> {
        let strip = &mut self.shortener.strip;
        if let Some(face) = self
            .mesh
            .faces_of(from)
            .find(|&f| self.mesh.face_contains(f, to))
        {
            strip.restart(face);
            return Ok(());
        }
        match self.start {
            Start::Vertices => self.search.over_vertices(self.mesh, from, to, true, strip),
            Start::Edges => self.search.over_vertices(self.mesh, from, to, false, strip),
            Start::Faces => self.search.over_faces(self.mesh, from, to, strip),
        }
    }

    /// Shortens what lies in the strip.
    fn shorten(&mut self, from: SurfacePoint, to: SurfacePoint) -> Result<&GeodesicPath, Error> {
        self.shorten_observed(from, to, |_, _| {})?;
        self.path.set(self.mesh, &self.shortener, &mut self.strip);
        Ok(&self.path)
    }

    /// As [`PathFinder::shorten`], within the class of paths that the strip begins in.
    fn shorten_in_class(
        &mut self,
        from: SurfacePoint,
        to: SurfacePoint,
    ) -> Result<&GeodesicPath, Error> {
        let neighbours = std::mem::replace(&mut self.neighbours, false);
        let done = self.shorten(from, to).map(drop);
        self.neighbours = neighbours;
        done?;
        Ok(&self.path)
    }

    /// Shortens what lies in the strip; `observe` sees the taut path at the start and every update.
    fn shorten_observed(
        &mut self,
        from: SurfacePoint,
        to: SurfacePoint,
        mut observe: impl FnMut(&Shortener, &mut Strip),
    ) -> Result<(), Error> {
        let Self {
            mesh,
            shortener,
            strip,
            path,
            neighbours,
            ..
        } = self;
        shortener.strip.trim(mesh, from, to);
        shortener.begin(mesh, from, to);
        path.updates.clear();
        observe(shortener, strip);
        // A path has a few updates for each vertex on it; a mesh is crossed by about the root of its number of faces.
        let limit = 20 * mesh.face_count() + 100;
        loop {
            let finished = shortener.shorten(mesh, limit, |shortener, update| {
                path.updates.push(update);
                observe(shortener, strip);
            });
            if !finished {
                return Err(Error::NotConverged {
                    updates: shortener.updates,
                });
            }
            let Some(update) = neighbours.then(|| shortener.hop(mesh)).flatten() else {
                return Ok(());
            };
            path.updates.push(update);
            observe(shortener, strip);
        }
    }
}
