//! A face laid flat on the half-edge through which windows enter it.

use glam::DVec2;

use super::window::Window;
use crate::SurfacePoint;
use crate::mesh::{Mesh, face_of, next, previous};

/// The triangle over `(0, 0)` and `(length, 0)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlatFace {
    pub(crate) length: f64,
    pub(crate) apex: DVec2,
    /// Lengths of the other two sides, from the origin of the half-edge and from its tip to the apex.
    pub(crate) left: f64,
    pub(crate) right: f64,
    /// The direction of the left side.
    pub(crate) along_left: DVec2,
}

impl FlatFace {
    #[inline]
    pub(crate) fn new(mesh: &Mesh, h: u32) -> Self {
        let (apex, left) = (apex(mesh, h), mesh.length(previous(h)));
        Self {
            length: mesh.length(h),
            apex,
            left,
            right: mesh.length(next(h)),
            along_left: apex / left,
        }
    }

    /// The same face in a mirror that exchanges the ends of the half-edge.
    #[inline]
    pub(crate) fn mirrored(&self) -> Self {
        let apex = DVec2::new(self.length - self.apex.x, self.apex.y);
        Self {
            length: self.length,
            apex,
            left: self.right,
            right: self.left,
            along_left: apex / self.right,
        }
    }

    /// Where the straight line from a source to the apex crosses the line of the half-edge.
    #[inline]
    pub(crate) fn apex_crossing(&self, source: DVec2) -> f64 {
        source.x - (self.apex.x - source.x) * source.y / (self.apex.y - source.y)
    }

    /// The shortest way of a window to the apex: its length, where it crosses the half-edge, and whether it is straight
    /// there. A way that bends is never a shortest one on the surface, but bounds those that are.
    #[inline]
    pub(crate) fn way_to_apex(&self, window: &Window) -> (f64, f64, bool) {
        let straight = self.apex_crossing(window.source);
        let crossing = straight.max(window.start).min(window.end);
        let is_straight = crossing == straight;
        let stretch = if is_straight {
            window.source.distance(self.apex)
        } else {
            let bend = DVec2::new(crossing, 0.0);
            window.source.distance(bend) + bend.distance(self.apex)
        };
        (window.base + stretch, crossing, is_straight)
    }

    /// A source in the coordinates of the left side, which run from the origin of the half-edge to the apex.
    #[inline]
    pub(crate) fn over_left(&self, source: DVec2) -> DVec2 {
        DVec2::new(
            self.along_left.dot(source),
            self.along_left.perp_dot(source),
        )
    }

    /// How far from the origin of the half-edge the ray from a source through `(x, 0)` meets the left side.
    #[inline]
    pub(crate) fn meet_left(&self, source: DVec2, x: f64) -> f64 {
        let along = self.along_left;
        let descent = along.y * (source.x - x) - along.x * source.y;
        if descent > 0.0 {
            (-source.y * x / descent).min(self.left)
        } else {
            self.left
        }
    }
}

/// The apex of a half-edge's face in the half-edge's coordinates, above it.
#[inline]
pub(crate) fn apex(mesh: &Mesh, h: u32) -> DVec2 {
    let (base, right, left) = (
        mesh.length(h),
        mesh.length(next(h)),
        mesh.length(previous(h)),
    );
    let x = 0.5 * (base + (left - right) * (left + right) / base);
    // The height by Heron's formula loses half the digits on needles; from the corner it does not.
    let side = mesh.position(mesh.apex(h)) - mesh.position(mesh.origin(h));
    let along = mesh.position(mesh.tip(h)) - mesh.position(mesh.origin(h));
    DVec2::new(x, side.cross(along).length() / base)
}

/// A point of the face of `h` in the coordinates of `h`.
pub(crate) fn local_coordinates(mesh: &Mesh, h: u32, point: SurfacePoint) -> DVec2 {
    let weights = mesh
        .barycentric_in(face_of(h), point)
        .unwrap_or([f64::NAN; 3]);
    let corner = (h % 3) as usize;
    let (tip, top) = (weights[(corner + 1) % 3], weights[(corner + 2) % 3]);
    tip * DVec2::new(mesh.length(h), 0.0) + top * apex(mesh, h)
}
