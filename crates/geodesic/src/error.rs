use crate::SurfacePoint;

/// Why a mesh was refused, or why a question about it has no answer.
///
/// Indices are those of the caller's slices; every variant carries the numbers that explain it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// There is no face.
    #[error("the mesh has no faces")]
    EmptyMesh,
    /// No source was given.
    #[error("there is no point to measure distances from")]
    NoSource,
    /// More half-edges than a `u32` can number.
    #[error("{faces} faces are too many: their half-edges must be numbered by 32 bits")]
    TooManyFaces {
        /// Number of faces given.
        faces: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("vertex {vertex} has a coordinate that is not finite")]
    NonFiniteVertex {
        /// The vertex.
        vertex: u32,
    },
    /// A face does not have three corners.
    #[error("face {face} has {corners} corners, not 3")]
    NotATriangle {
        /// The face.
        face: u32,
        /// Its number of corners.
        corners: usize,
    },
    /// A face names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}, but there are {vertices} vertices")]
    IndexOutOfRange {
        /// The face.
        face: u32,
        /// The index that it names.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A face names the same vertex twice.
    #[error("face {face} names vertex {vertex} twice")]
    RepeatedVertex {
        /// The face.
        face: u32,
        /// The repeated vertex.
        vertex: u32,
    },
    /// A face has no area, to rounding, or no side of 1e-70 or more.
    #[error("face {face} {vertices:?} has no area (area over squared longest side: {ratio:e})")]
    DegenerateFace {
        /// The face.
        face: u32,
        /// Its corners.
        vertices: [u32; 3],
        /// Twice its area over the square of its longest side.
        ratio: f64,
    },
    /// The mesh is too small or too large to compute with: the bounding box of its faces has a diagonal outside 1e-62..1e62.
    #[error("the mesh is {size:e} across, not between 1e-62 and 1e62; scale it")]
    MeshSize {
        /// Length of the diagonal.
        size: f64,
    },
    /// The same triangle occurs twice, with the same orientation.
    #[error("faces {} and {} are the same triangle", .faces[0], .faces[1])]
    RepeatedFace {
        /// The two faces.
        faces: [u32; 2],
    },
    /// More than two faces meet at an edge.
    #[error("edge {vertices:?} belongs to {count} faces, among them {faces:?}")]
    NonManifoldEdge {
        /// The ends of the edge.
        vertices: [u32; 2],
        /// The first three of its faces.
        faces: [u32; 3],
        /// How many faces it has.
        count: usize,
    },
    /// Two neighbouring faces run along their common edge in the same direction.
    #[error("faces {faces:?} run along their common edge {vertices:?} in the same direction")]
    InconsistentOrientation {
        /// The edge, in the direction that both faces give it.
        vertices: [u32; 2],
        /// The two faces.
        faces: [u32; 2],
    },
    /// The faces at a vertex do not form one fan.
    #[error(
        "the faces at vertex {vertex} form several fans, of which two begin with faces {faces:?}"
    )]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
        /// A face of one fan and a face of another.
        faces: [u32; 2],
    },
    /// A vertex belongs to no face (refused by [`Mesh::new_strict`](crate::Mesh::new_strict), and as an end of a path).
    #[error("vertex {vertex} belongs to no face")]
    UnreferencedVertex {
        /// The vertex.
        vertex: u32,
    },
    /// There is no such vertex.
    #[error("there is no vertex {vertex}: the mesh has {vertices}")]
    NoSuchVertex {
        /// The vertex asked for.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There is no such face.
    #[error("there is no face {face}: the mesh has {faces}")]
    NoSuchFace {
        /// The face asked for.
        face: u32,
        /// How many faces there are.
        faces: usize,
    },
    /// There is no such half-edge.
    #[error("there is no half-edge {halfedge}: the mesh has {halfedges}")]
    NoSuchHalfedge {
        /// The half-edge asked for.
        halfedge: u32,
        /// How many half-edges there are.
        halfedges: usize,
    },
    /// Two vertices are not joined by an edge.
    #[error("vertices {} and {} are not joined by an edge", .vertices[0], .vertices[1])]
    NotAnEdge {
        /// The two vertices.
        vertices: [u32; 2],
    },
    /// The parameter of a point on an edge lies outside `[0, 1]`, or is not finite.
    #[error("the edge parameter {t} lies outside [0, 1]")]
    OutsideEdge {
        /// The parameter.
        t: f64,
    },
    /// Barycentric coordinates are negative, do not sum to 1, or are not finite.
    #[error("the barycentric coordinates {barycentric:?} lie outside the face")]
    OutsideFace {
        /// The coordinates.
        barycentric: [f64; 3],
    },
    /// A number given by the caller is NaN or infinite.
    #[error("{what} is not finite")]
    NonFinite {
        /// Which number.
        what: &'static str,
    },
    /// The two points lie in different components of the mesh.
    #[error("no path: {from} and {to} lie in different components")]
    NoPath {
        /// Start of the path.
        from: SurfacePoint,
        /// End of the path.
        to: SurfacePoint,
    },
    /// Consecutive faces of a sequence do not share an edge.
    #[error("faces {} and {} of the sequence do not share an edge (position {position})", .faces[0], .faces[1])]
    BrokenSequence {
        /// Position in the sequence of the second of them.
        position: usize,
        /// The two faces.
        faces: [u32; 2],
    },
    /// A face sequence does not begin or end at the given point.
    #[error("the face sequence does not reach {point}")]
    SequenceMissesPoint {
        /// The end of the path that the sequence misses.
        point: SurfacePoint,
    },
    /// A segment of a polyline has no length or does not lie in a face.
    #[error(
        "point {position} of the polyline and the next one are the same or lie in no common face"
    )]
    SegmentLeavesFace {
        /// Position of the first of them.
        position: usize,
    },
    /// Two things that are used together belong to different meshes, or a path was changed by hand.
    #[error("the {what} belongs to another mesh")]
    OtherMesh {
        /// Which of them.
        what: &'static str,
    },
    /// Shortening was stopped before the path was locally shortest.
    #[error("the path was not locally shortest after {updates} updates")]
    NotConverged {
        /// Updates made.
        updates: usize,
    },
    /// A closed geodesic that follows the inner equator of a torus more closely than numbers can tell.
    #[error(
        "on the torus of radii {major} and {minor} the geodesic of {} turns about the axis and {} around the tube \
         cannot be told from the inner equator", turns[0], turns[1]
    )]
    ThinTorus {
        /// The radius of the middle circle.
        major: f64,
        /// The radius of the tube.
        minor: f64,
        /// The turns about the axis and around the tube.
        turns: [u32; 2],
    },
    /// A direction has no part in the tangent plane.
    #[error("the direction {direction:?} has no part in the plane of face {face}")]
    NoTangentialPart {
        /// The direction.
        direction: [f64; 3],
        /// The face.
        face: u32,
    },
    /// From a point on an edge or at a vertex, the direction leads out of the given face.
    #[error("the direction leads out of face {face} at once; start in another face of the point")]
    DirectionLeavesFace {
        /// The face.
        face: u32,
    },
    /// From a point, the direction leads off the surface: over the boundary, or away from all faces.
    #[error("at {point} the direction {direction:?} leads into no face")]
    DirectionLeavesSurface {
        /// The direction.
        direction: [f64; 3],
        /// The point.
        point: SurfacePoint,
    },
    /// A length is negative or not finite.
    #[error("the length {length} is negative or not finite")]
    InvalidLength {
        /// The length.
        length: f64,
    },
    /// A vertex normal is missing, zero or not finite.
    #[error("the normal of vertex {vertex} is missing, zero or not finite")]
    InvalidNormal {
        /// The vertex.
        vertex: u32,
    },
    /// A loop shrank to a point: it is contractible, and no closed geodesic lies in its class.
    #[error("the loop is contractible: it shrank to length {length} near vertex {vertex}")]
    NullLoop {
        /// Length at which shortening stopped.
        length: f64,
        /// A vertex near the place where it vanished.
        vertex: u32,
    },
    /// A closed polyline needs at least three points, or two on different edges.
    #[error("a loop of {points} points does not go round anything")]
    ShortLoop {
        /// How many points were given.
        points: usize,
    },
    /// A search for a loop did not find one.
    #[error("no loop of class ({p}, {q}) was found within {budget} settled states")]
    LoopNotFound {
        /// Turns along the first direction.
        p: i32,
        /// Turns along the second direction.
        q: i32,
        /// Search states settled before giving up.
        budget: usize,
    },
    /// The mesh is not a torus, so loops have no class (p, q).
    #[error(
        "the mesh has {boundaries} boundary edges and Euler characteristic {euler}: not a torus"
    )]
    NotATorus {
        /// Vertices minus edges plus faces.
        euler: i64,
        /// Number of boundary edges.
        boundaries: usize,
    },
    /// More classes of loops asked for than one search may look for.
    #[error("turns up to {largest} were asked for; at most {limit} can be")]
    TooManyClasses {
        /// The largest number of turns asked for.
        largest: u32,
        /// The largest number that may be asked for.
        limit: u32,
    },
    /// Two loops do not generate all classes of loops.
    #[error(
        "the two loops do not generate all classes: their crossings have determinant {determinant}, not 1 or -1"
    )]
    NotABasis {
        /// Determinant of their crossings with two dual curves.
        determinant: i32,
    },
    /// Breaklines cross, or use a repeated point.
    #[error(
        "breakline {breakline} cannot be kept: it crosses another one or joins a point to itself"
    )]
    CrossingBreaklines {
        /// Position of the breakline in the list.
        breakline: usize,
    },
    /// The triangulation library refused a point.
    #[error("point {point} cannot be triangulated: a coordinate is too small or too large")]
    Untriangulable {
        /// Position of the point.
        point: usize,
    },
    /// An OBJ file could not be read.
    #[error("the OBJ file cannot be read: {reason}")]
    Obj {
        /// What the reader says.
        reason: String,
    },
    /// A parameter, or a pair of them, outside the domain.
    #[error("({u}, {v}) lies outside the domain")]
    OutsideDomain {
        /// First parameter.
        u: f64,
        /// Second parameter.
        v: f64,
    },
    /// A tolerance that is not a positive number, or smaller than can be worked to.
    #[error("the tolerance {tolerance} is not a positive number, or too small")]
    InvalidTolerance {
        /// The tolerance.
        tolerance: f64,
    },
    /// A smooth surface has no tangent plane at these parameters, or a direction vanishes there.
    #[error("the surface has no tangent plane at ({u}, {v}), or the direction vanishes there")]
    NoTangentPlane {
        /// First parameter.
        u: f64,
        /// Second parameter.
        v: f64,
    },
    /// The two ends of a path on a smooth surface are the same point, and the way between them has no length.
    #[error("the way has no length")]
    SamePoint,
    /// A control net that is not that of an array of Bézier patches.
    #[error("{size:?} mass points are not a net of patches of degrees {degrees:?}")]
    NetSize {
        /// The degrees of a patch.
        degrees: [usize; 2],
        /// Numbers of rows and columns.
        size: [usize; 2],
    },
    /// A refinement that would need too much memory.
    #[error("the next refinement has {faces} faces")]
    TooLarge {
        /// Number of faces.
        faces: usize,
    },
}
