//! Straightest geodesics: from a point in a direction (Polthier and Schmies), and the variant that follows given vertex
//! normals (Section 2.4 of the thesis, Fig. 2.13).

mod step;
mod tracer;

pub use tracer::Straightest;

use glam::DVec3;

use crate::SurfacePoint;

/// What a trace does at the boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum AtBoundary {
    /// It ends.
    #[default]
    Stop,
    /// It is reflected at an edge, and ends at a vertex.
    Reflect,
}

/// Why a trace ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Stop {
    /// Its length was used up.
    Length,
    /// It came to a boundary edge.
    BoundaryEdge,
    /// It came to a boundary vertex.
    BoundaryVertex,
    /// It passed ten million faces.
    StepLimit,
}

/// A straightest geodesic.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Trace {
    /// The start, every crossing of an edge and every vertex passed, the end.
    pub points: Vec<SurfacePoint>,
    /// The same points in space.
    pub positions: Vec<DVec3>,
    /// The face of each segment.
    pub faces: Vec<u32>,
    /// Length travelled.
    pub length: f64,
    /// Why it ended.
    pub stop: Stop,
    /// Unit direction at the end, in the plane of the last face.
    pub end_direction: DVec3,
}

impl Trace {
    /// Number of edges and vertices passed between the ends.
    #[must_use]
    pub fn crossings(&self) -> usize {
        self.points.len().saturating_sub(2)
    }

    /// The place nearest to the start among those at least `after` along the trace: its arc length and its distance.
    /// `None` if the trace is not that long.
    #[must_use]
    pub fn nearest_return(&self, after: f64) -> Option<(f64, f64)> {
        let start = *self.positions.first()?;
        let mut travelled = 0.0;
        let mut best: Option<(f64, f64)> = None;
        for ends in self.positions.windows(2) {
            let step = ends[0].distance(ends[1]);
            let begin = if step > 0.0 {
                ((after - travelled) / step).max(0.0)
            } else {
                0.0
            };
            if begin <= 1.0 {
                let along = ends[1] - ends[0];
                let t = if step > 0.0 {
                    (start - ends[0]).dot(along) / (step * step)
                } else {
                    0.0
                };
                let t = t.clamp(begin, 1.0);
                let gap = (ends[0] + t * along).distance(start);
                if best.is_none_or(|(_, smallest)| gap < smallest) {
                    best = Some((travelled + t * step, gap));
                }
            }
            travelled += step;
        }
        best
    }
}
