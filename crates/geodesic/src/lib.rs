//! Shortest and straightest paths on triangle meshes: locally shortest in well under a millisecond, certified, and closed
//! geodesics.
//!
//! ```text
//!            X1                A path is a sequence of faces. Laid flat in the plane,
//!     ______/____              the faces make a strip, and the shortest path in a strip is
//!    \  |\ /  |\ /             a string pulled taut: straight but for a few vertices, its
//!     \ | /   | /              pivots (•). Where the faces on the other side of a pivot take
//!      \|/ \  |/    •          less than half a turn, the string passes there: those faces
//!       /___\/_____/ \         replace the others. When no pivot is left that could be
//!     X0                       passed better, the path is a geodesic.
//! ```
//!
//! # Example
//!
//! ```
//! use geodesic::{PathFinder, shapes};
//!
//! let mesh = shapes::torus(2.0, 0.7, 48, 24)?; // or Mesh::read_obj("bunny.obj")?
//! let from = mesh.vertex_point(0)?;
//! let to = mesh.face_point(700, [0.2, 0.3, 0.5])?;
//!
//! let mut finder = PathFinder::new(&mesh); // keeps its buffers from query to query
//! let path = finder.shortest(from, to)?;
//!
//! println!("length {}, through faces {:?}", path.length(), path.faces());
//! assert!(path.certify(&mesh)?.is_geodesic());
//! # Ok::<(), geodesic::Error>(())
//! ```
//!
//! # Types
//!
//! | what | type |
//! |---|---|
//! | a mesh that passed every check; from slices, OBJ, scattered heights | [`Mesh`] |
//! | triangles that may not be a mesh, and their repair with a report | [`TriangleSoup`], [`Repaired`], [`RepairReport`] |
//! | a point at a vertex, on an edge or in a face | [`SurfacePoint`] |
//! | the mesh point closest to a point in space | [`ClosestPoint`] |
//! | locally shortest paths, query after query | [`PathFinder`], [`Start`] |
//! | exact distances from points to everything, isolines, globally shortest paths | [`Sweep`], [`DistanceField`], [`Isoline`], [`Globally`] |
//! | many queries on all cores | [`shortest_paths`], [`exact_distances`], [`exact_distances_to_all`] |
//! | a path: polyline, faces, pivots with side angles, certificate | [`GeodesicPath`], [`Pivot`], [`Certificate`] |
//! | its faces laid flat | [`Unfolding`] |
//! | from a point in a direction | [`Straightest`], [`Trace`] |
//! | closed geodesics; through a point; of every class on a torus | [`LoopFinder`], [`GeodesicLoop`], [`TorusClasses`] |
//! | a Bézier or NURBS surface as a sequence of polyhedra, and paths carried over them | [`PatchLevels`], [`Convergence`] |
//! | Loop's and Catmull and Clark's surfaces likewise | [`SubdivisionSurface`] |
//! | any smooth surface; geodesics from a point and between two | [`SmoothSurface`], [`trace_smooth`], [`geodesic_between`] |
//! | simple meshes to begin with | [`shapes`] |
//!
//! # What is guaranteed
//!
//! A path from [`PathFinder`] is a *locally* shortest one: no small change makes it shorter. [`GeodesicPath::certify`]
//! examines it anew from its points alone. That it is the shortest of all is not promised: on closed meshes it often is,
//! and otherwise it is longer by a few parts in a thousand on average. [`Sweep::shorten_globally`] proves it or finds the
//! shortest one. Distances from a [`Sweep`] are exact to rounding.
//!
//! # Conventions
//!
//! Indices of vertices and faces are the caller's, from 0; half-edge `3 f + k` runs along face `f` from its corner `k` to
//! the next one. Faces are counter-clockwise seen from outside. Angles are in radians. Every tolerance is a named
//! constant, relative to the size of the data.
//!
//! # Features
//!
//! On by default: `obj` (OBJ files, by tobj), `triangulate` (terrains and parametric meshes, by spade), `closest-point`
//! (by obvhs). Off by default: `serde`; `rayon`, which answers
//! [`shortest_paths`], [`exact_distances`] and [`exact_distances_to_all`] on all cores.
//!
//! # References
//!
//! - The method: Chapter 2 of L. Biard's habilitation thesis ("the thesis" in these pages), after V. Pham-Trong,
//!   N. Szafran, L. Biard, *Pseudo-geodesics on three-dimensional surfaces and pseudo-geodesic meshes*, Numerical
//!   Algorithms 26, 2001. Departures: one pivot is updated at a time, the
//!   sharpest first, and only when that shortens the path, so that the process ends; a vertex that is touched without a
//!   bend counts as a pivot; both side angles of a critical vertex must reach π.
//! - The funnel: D. T. Lee, F. P. Preparata, *Euclidean shortest paths in the presence of rectilinear barriers*, Networks
//!   14, 1984; B. Chazelle, *A theorem on polygon cutting*, FOCS 1982.
//! - Straightest geodesics: K. Polthier, M. Schmies, *Straightest geodesics on polyhedral surfaces*, 1998.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod batch;
#[cfg(feature = "closest-point")]
mod closest;
mod curvature;
mod error;
mod exact;
mod finder;
mod funnel;
mod hop;
mod loops;
mod mesh;
mod path;
mod pivot;
mod search;
mod sequence;
pub mod shapes;
mod straightest;
mod strip;
mod surface;
mod surface_point;
mod torus;
mod unfold;

pub use batch::{exact_distances, exact_distances_to_all, shortest_paths};
#[cfg(feature = "closest-point")]
pub use closest::{Closest, ClosestPoint};
pub use error::Error;
pub use exact::{DistanceField, Globally, Isoline, Sweep};
pub use finder::{PathFinder, Start};
pub use loops::{DirectedLoop, GeodesicLoop, LoopFinder};
#[cfg(feature = "triangulate")]
pub use mesh::triangulate_domain;
pub use mesh::{
    FLAT_ANGLE, Mesh, NONE, RepairReport, Repaired, Star, TriangleSoup, VertexKind, face_of, next,
    previous,
};
pub use path::{CERTIFIED_ANGLE, CERTIFIED_STRAIGHTNESS, Certificate, GeodesicPath, Pivot};
pub use pivot::Update;
pub use straightest::{AtBoundary, Stop, Straightest, Trace};
pub use strip::Side;
pub use surface::{
    ClosedTorusGeodesic, Convergence, LevelPath, PatchLevels, Scheme, SmoothGeodesic,
    SmoothSurface, SubdivisionSurface, SurfaceJet, SurfaceOfRevolution, SurfaceRay, TorusSurface,
    closed_torus_geodesic, geodesic_between, trace_smooth, trace_smooth_points,
};
pub use surface_point::{OUTSIDE, SNAP, SurfacePoint};
pub use torus::TorusClasses;
pub use unfold::Unfolding;
pub use {bezier_mass, glam};
