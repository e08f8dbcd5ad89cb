//! Exact distances: continuous Dijkstra with windows.
//!
//! A *window* is an interval of an edge whose shortest paths to the source all pass the same faces: unfolded, they are
//! straight rays from one point. Windows are propagated in the order of their distance; where two meet on an edge, each
//! keeps the part on which it is nearer. A vertex where the surface bends back on itself (more than a full turn, or on the
//! boundary) becomes a *pseudo-source*.
//!
//! Sources: Mitchell, Mount, Papadimitriou 1987 (windows, their intersection); Xin, Wang 2009 (windows that a known vertex
//! distance makes useless are dropped when they are born).

mod face;
mod field;
mod radiate;
mod sweep;
#[cfg(test)]
mod tests;
mod trace;
mod window;

pub use field::DistanceField;
pub use sweep::Sweep;
pub(crate) use trace::join_around_vertices;
