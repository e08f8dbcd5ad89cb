//! Through a face: what waits at its edge is trimmed, reaches its apex, and leaves by its other edges.

use glam::DVec2;

use super::face::FlatFace;
use super::field::BEND_SNAP;
use super::sweep::{Arrival, Sweep};
use super::window::{Window, trim};
use crate::mesh::{NONE, next, previous};

/// A vertex distance makes a window useless if it is shorter by more than this share: equal ones stay.
const FILTER_SLACK: f64 = 1e-12;

impl Sweep<'_> {
    /// The windows that wait at a half-edge go on through its face and leave by its other edges.
    pub(super) fn enter(&mut self, h: u32) {
        let mesh = self.mesh;
        let face = FlatFace::new(mesh, h);
        let mut batch = self.take_waiting(h, &face);
        self.arrive_at_apex(h, &face, &batch);
        let split = self.entrances[h as usize].apex_crossing;
        let [origin, tip, top] =
            [mesh.origin(h), mesh.tip(h), mesh.apex(h)].map(|v| self.vertex_distance(v));
        let left = Exit {
            halfedge: mesh.twins()[previous(h) as usize],
            face,
            split,
            shared: origin,
            apex: top,
            behind: tip,
        };
        let right = Exit {
            halfedge: mesh.twins()[next(h) as usize],
            face: face.mirrored(),
            split: face.length - split,
            shared: tip,
            apex: top,
            behind: origin,
        };
        for (exit, in_mirror) in [(left, false), (right, true)] {
            if exit.halfedge == NONE {
                continue;
            }
            let mut least = f64::INFINITY;
            for window in &batch {
                let window = if in_mirror {
                    window.mirrored(face.length)
                } else {
                    *window
                };
                if let Some(child) = exit.child(&window) {
                    least = least.min(child.least());
                    let child = if in_mirror {
                        child.mirrored(face.right)
                    } else {
                        child
                    };
                    self.hold(exit.halfedge, child);
                }
            }
            self.enqueue(exit.halfedge, least);
        }
        batch.clear();
        self.batch = batch;
    }

    /// Takes copies of the windows that wait, trimmed, and puts what is left of them back among those that have passed.
    fn take_waiting(&mut self, h: u32, face: &FlatFace) -> Vec<Window> {
        let mesh = self.mesh;
        let keeps = self.keeps(h);
        let mut batch = std::mem::take(&mut self.batch);
        let entrance = &mut self.entrances[h as usize];
        entrance.key = f64::INFINITY;
        let mut at = entrance.newest;
        self.slots.clear();
        for _ in 0..entrance.waiting {
            self.slots.push(at);
            let window = self.windows[at as usize];
            batch.push(window);
            at = window.older;
        }
        entrance.waiting = 0;
        let (from_origin, from_tip) = (
            self.distances[mesh.origin(h) as usize],
            self.distances[mesh.tip(h) as usize],
        );
        if batch.len() > 1 {
            trim(&mut batch);
        }
        batch.retain(|window| {
            !(is_shorter(from_origin + window.end, window.distance(window.end))
                || is_shorter(
                    from_tip + face.length - window.start,
                    window.distance(window.start),
                ))
        });
        let kept = if keeps { batch.len() } else { 0 };
        for (i, &slot) in self.slots.iter().enumerate() {
            let next = if i < kept {
                self.windows[slot as usize] = batch[i];
                &mut at
            } else {
                &mut self.free
            };
            self.windows[slot as usize].older = *next;
            *next = slot;
        }
        entrance.newest = at;
        batch
    }

    /// Finds the shortest way of a batch to the apex of the face. Where it crosses the half-edge, the face is divided: no
    /// shortest way crosses that way, so that windows on its left leave by the left side and windows on its right by the
    /// right side (Chen and Han's one angle, one split).
    fn arrive_at_apex(&mut self, h: u32, face: &FlatFace, batch: &[Window]) {
        let entrance = &mut self.entrances[h as usize];
        let mut best = None;
        for window in batch {
            let (distance, crossing, is_straight) = face.way_to_apex(window);
            if distance < entrance.apex_distance {
                entrance.apex_distance = distance;
                entrance.apex_crossing = crossing;
                best = Some((window, is_straight));
            }
        }
        let Some((window, is_straight)) = best else {
            return;
        };
        let (distance, crossing) = (entrance.apex_distance, entrance.apex_crossing);
        let mesh = self.mesh;
        let top = mesh.apex(h);
        let near = BEND_SNAP * face.length;
        if !is_straight && crossing < near {
            let v = mesh.origin(h);
            self.reach(top, self.vertex_distance(v) + face.left, Arrival::Edge(v));
        } else if !is_straight && crossing > face.length - near {
            let v = mesh.tip(h);
            self.reach(top, self.vertex_distance(v) + face.right, Arrival::Edge(v));
        } else {
            let arrival = Arrival::Window {
                halfedge: h,
                source: window.source,
                origin: window.origin,
            };
            self.reach(top, distance, arrival);
        }
    }
}

/// The left side of a face as an exit, or the right side in a mirror.
struct Exit {
    /// The half-edge of the next face.
    halfedge: u32,
    face: FlatFace,
    /// Where the shortest way to the apex crosses.
    split: f64,
    /// Distances of the corner that the side shares with the half-edge of entry, of the apex, and of the third corner.
    shared: f64,
    apex: f64,
    behind: f64,
}

impl Exit {
    /// The part of a window that leaves here, in coordinates that run along the side to the apex; `None` where nothing is left
    /// of it, or where a corner of the face is the nearer source for all of it (Xin and Wang's filter).
    #[inline(always)]
    fn child(&self, window: &Window) -> Option<Window> {
        let face = &self.face;
        let crossing = face.apex_crossing(window.source);
        let to = window.end.min(self.split);
        let start = face.meet_left(window.source, window.start);
        let end = if to >= crossing {
            face.left
        } else {
            face.meet_left(window.source, to)
        };
        let leaves = window.start < to && window.start < crossing && start < end;
        if !leaves {
            return None;
        }
        let child = Window {
            start,
            end,
            source: face.over_left(window.source),
            ..*window
        };
        let (near, far) = (child.distance(start), child.distance(end));
        let third = DVec2::new(face.length, 0.0);
        let foot = face.along_left * start;
        let useless = is_shorter(self.shared + end, far)
            || is_shorter(self.apex + face.left - start, near)
            || is_shorter(self.behind + third.distance(foot), near);
        (!useless).then_some(child)
    }
}

#[inline]
fn is_shorter(by_vertex: f64, by_window: f64) -> bool {
    by_vertex < by_window * (1.0 - FILTER_SLACK)
}
