//! What a sweep has found.

use super::face::{FlatFace, local_coordinates};
use super::sweep::Sweep;
use super::window::Window;
use crate::{Error, SurfacePoint};

/// Ways that bend within this share of an edge from its end are those past the vertex.
pub(super) const BEND_SNAP: f64 = 1e-9;

/// Distances from the sources of a sweep, valid until the next one.
#[derive(Clone, Copy, Debug)]
pub struct DistanceField<'s, 'm> {
    pub(super) sweep: &'s Sweep<'m>,
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
    /// Through a window of this half-edge of the point's face.
    Window(u32, Window),
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
            .map(|(distance, _)| distance)
            .filter(|&distance| distance <= self.sweep.limit())
            .unwrap_or(f64::INFINITY))
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
            }
            for h in 3 * f..3 * f + 3 {
                // The face with the point for its apex.
                let face = FlatFace {
                    apex: local_coordinates(mesh, h, point),
                    ..FlatFace::new(mesh, h)
                };
                for window in sweep.windows_of(h) {
                    let (distance, crossing, is_straight) = face.way_to_apex(window);
                    let near = BEND_SNAP * face.length;
                    if is_straight || (crossing > near && crossing < face.length - near) {
                        consider(distance, Way::Window(h, *window));
                    }
                }
            }
        }
        best
    }
}
