//! Where waves end.

use glam::DVec2;

use crate::Error;
use crate::fan::Run;

/// An end of an illuminated stretch or of a front that is none of the source: at total reflection, at the edge of a shadow,
/// at the box of the model, at a sliver that no arc can follow.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(from = "crate::stored::StoredCut", into = "crate::stored::StoredCut")
)]
pub struct Cut {
    /// The source's parameter of the boundary ray.
    pub parameter: f64,
    /// Where the boundary ray starts its last leg.
    pub place: DVec2,
    /// What stops the next ray.
    pub reason: Error,
}

impl Cut {
    /// The cut at the last ray of a run, or at the first.
    pub(crate) fn new(run: &Run, reason: Error, at_end: bool) -> Option<Self> {
        let index = if at_end {
            run.parameters.len().checked_sub(1)?
        } else {
            0
        };
        Some(Self {
            parameter: *run.parameters.get(index)?,
            place: run.traces.get(index)?.last()?.point,
            reason,
        })
    }
}
