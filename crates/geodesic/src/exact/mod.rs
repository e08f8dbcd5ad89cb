//! Exact distances: windows that go from face to face.
//!
//! A *window* is an interval of an edge whose shortest paths to the source all pass the same faces: unfolded, they are
//! straight rays from one point. All windows that wait at an edge enter its face together; the edge whose nearest window is
//! nearest to the source goes first. On the way windows are cut and dropped, always because a path that is no longer is
//! known:
//!
//! - of two that overlap on an edge, each keeps the part on which it is nearer (`window`);
//! - one that a corner of its face makes useless is dropped (`enter`, Xin and Wang's filter);
//! - the shortest way to the far corner of a face divides it: what comes in on the left goes out on the left (`enter`).
//!
//! A vertex where the surface has more than a full turn (more than half a turn on the boundary) becomes a *pseudo-source*,
//! for the wedge of directions only that leaves an angle of π on either side (`radiate`).
//!
//! Everything is a bound from above at any time, so that the order matters to the speed alone; when the queue is empty or
//! holds nothing nearer than a target, the bounds are exact.
//!
//! Sources: J. Mitchell, D. Mount, C. Papadimitriou, *The discrete geodesic problem*, 1987 (windows); J. Chen, Y. Han,
//! *Shortest paths on a polyhedron*, 1990 (one angle, one split); S. Xin, G. Wang, *Improving Chen and Han's algorithm*, 2009
//! (the filter); Y. Qin, X. Han, H. Yu, Y. Yu, J. Zhang, *Fast and exact discrete geodesic computation based on
//! triangle-oriented wavefront propagation*, 2016 (all windows of an edge together). Departures from the last: edges wait in the
//! queue, not vertices, so that a sweep can stop at a distance; the way that divides a face is remembered from one visit to
//! the next; vertices radiate into their wedge, not all round.

mod enter;
mod face;
mod field;
mod isoline;
mod radiate;
mod sweep;
#[cfg(test)]
mod tests;
mod trace;
mod window;

pub use field::DistanceField;
pub use isoline::Isoline;
pub use sweep::Sweep;
pub use trace::Globally;
pub(crate) use trace::join_around_vertices;
