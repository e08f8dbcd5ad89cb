//! Fronts as they are at a time: the part of them that has set out and has not met the next interface.

use glam::DVec2;

use crate::Model;
use crate::front::{Front, FrontPiece};

/// The ends of a stretch are found by this many halvings of a step on its piece.
const END_HALVINGS: u32 = 30;

impl Front {
    /// The front at a time as polylines, one for each stretch that exists then: pieces whose rays have set out.
    #[must_use]
    pub fn snapshot(&self, time: f64, steps: usize) -> Vec<Vec<DVec2>> {
        self.stretches(time, steps, |_, _| true)
    }

    /// The front at a time inside a model: rays that have left their interface by then, and neither met the next one nor
    /// left the box.
    #[must_use]
    pub fn snapshot_inside(&self, model: &Model, time: f64, steps: usize) -> Vec<Vec<DVec2>> {
        self.stretches(time, steps, |from, to| {
            model.is_free(self.layer(), from, to)
        })
    }

    /// Stretches with `steps` steps a piece of what has set out and come to its place on a way that is free; their ends are
    /// found to the precision of the departures.
    fn stretches(
        &self,
        time: f64,
        steps: usize,
        is_free: impl Fn(DVec2, DVec2) -> bool,
    ) -> Vec<Vec<DVec2>> {
        let exists = |index: usize, piece: &FrontPiece, t: f64| {
            let departure = piece.departure(t);
            departure <= time
                && is_free(self.point(index, t, departure), self.point(index, t, time))
        };
        let mut stretches = Vec::new();
        let mut stretch = Vec::new();
        for (index, piece) in self.pieces().iter().enumerate() {
            let mut before: Option<(f64, bool)> = None;
            for i in 0..=steps.max(1) {
                let t = i as f64 / steps.max(1) as f64;
                let now = exists(index, piece, t);
                if let Some((start, existed)) = before
                    && existed != now
                {
                    let (mut low, mut high) = (start, t);
                    for _ in 0..END_HALVINGS {
                        let middle = 0.5 * (low + high);
                        if exists(index, piece, middle) == existed {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    stretch.push(self.point(index, if existed { low } else { high }, time));
                }
                if now {
                    stretch.push(self.point(index, t, time));
                } else if !stretch.is_empty() {
                    stretches.push(std::mem::take(&mut stretch));
                }
                before = Some((t, now));
            }
        }
        stretches.push(stretch);
        stretches.retain(|stretch: &Vec<DVec2>| stretch.len() > 1);
        stretches
    }
}
