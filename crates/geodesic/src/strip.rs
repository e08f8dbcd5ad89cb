//! Flattening: a sequence of adjacent faces laid out in the plane (Section 2.1 of the thesis, Fig. 2.3).

use glam::DVec2;

use crate::mesh::{Mesh, face_of, next};
use crate::{Error, SurfacePoint};

/// The side of a strip, looking along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

/// A sequence of adjacent faces, given by the half-edges (*portals*) through which it leaves one face for the next, and
/// its image in the plane.
///
/// A portal belongs to the face that it leaves. Looking out of that face, the tip of the portal is on the left and its
/// origin on the right. The image may overlap itself; only neighbouring points are ever compared.
#[derive(Clone, Debug, Default)]
pub(crate) struct Strip {
    /// The face in which the strip begins.
    pub(crate) first_face: u32,
    pub(crate) portals: Vec<u32>,
    /// Images of the left and right ends of each portal.
    pub(crate) left: Vec<DVec2>,
    pub(crate) right: Vec<DVec2>,
    /// The first of the consecutive portals that share the left (right) end of this one: it names the copy of that
    /// vertex. A vertex that the strip meets again after leaving it has another copy.
    pub(crate) left_since: Vec<u32>,
    pub(crate) right_since: Vec<u32>,
    /// Images of the two end points.
    pub(crate) from: DVec2,
    pub(crate) to: DVec2,
}

impl Strip {
    /// An empty strip that begins in `face`.
    pub(crate) fn restart(&mut self, face: u32) {
        self.first_face = face;
        self.portals.clear();
    }

    /// Leaves the last face through `portal`; going straight back undoes the last step instead.
    #[inline]
    pub(crate) fn push(&mut self, mesh: &Mesh, portal: u32) {
        if self
            .portals
            .last()
            .is_some_and(|&last| mesh.twin(last) == Some(portal))
        {
            self.portals.pop();
        } else {
            self.portals.push(portal);
        }
    }

    /// Drops leading faces in which the strip still turns about `from`, and trailing ones in which it turns about `to`.
    pub(crate) fn trim(&mut self, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
        let trailing = self
            .portals
            .iter()
            .rev()
            .take_while(|&&portal| portal_meets(mesh, portal, to))
            .count();
        self.portals.truncate(self.portals.len() - trailing);
        let leading = self
            .portals
            .iter()
            .take_while(|&&portal| portal_meets(mesh, portal, from))
            .count();
        self.drop_leading(mesh, leading);
    }

    /// Shortens a sequence between two points: begins at the last face that contains `from`, ends at the first one
    /// after it that contains `to`, and goes round nothing in between: when a face comes again, the faces since its
    /// first visit are dropped (a shortest path meets no face twice).
    ///
    /// `visits` is scratch: one entry a face, equal to `u32::MAX` before and after.
    pub(crate) fn cut_detours(
        &mut self,
        mesh: &Mesh,
        from: SurfacePoint,
        to: SurfacePoint,
        visits: &mut [u32],
    ) {
        let entered = |portal: u32| mesh.twin(portal).map_or(face_of(portal), face_of);
        let leading = self
            .portals
            .iter()
            .rposition(|&p| mesh.face_contains(entered(p), from))
            .map_or(0, |i| i + 1);
        self.drop_leading(mesh, leading);
        let mut kept = 0;
        visits[self.first_face as usize] = 0;
        for i in 0..self.portals.len() {
            let portal = self.portals[i];
            let current = if kept == 0 {
                self.first_face
            } else {
                entered(self.portals[kept - 1])
            };
            if mesh.face_contains(current, to) {
                break;
            }
            let face = entered(portal);
            let visited = visits[face as usize];
            if visited == u32::MAX {
                self.portals[kept] = portal;
                kept += 1;
                visits[face as usize] = kept as u32;
            } else {
                for &dropped in &self.portals[visited as usize..kept] {
                    visits[entered(dropped) as usize] = u32::MAX;
                }
                kept = visited as usize;
                visits[face as usize] = visited;
            }
        }
        visits[self.first_face as usize] = u32::MAX;
        for &portal in &self.portals[..kept] {
            visits[entered(portal) as usize] = u32::MAX;
        }
        self.portals.truncate(kept);
    }

    fn drop_leading(&mut self, mesh: &Mesh, count: usize) {
        if let Some(&last) = self.portals[..count].last() {
            self.first_face = mesh.twin(last).map_or(self.first_face, face_of);
            self.portals.drain(..count);
        }
    }

    /// The strip through a caller's faces.
    ///
    /// Where two neighbours share several edges the first is taken.
    pub(crate) fn through_faces(&mut self, mesh: &Mesh, faces: &[u32]) -> Result<(), Error> {
        if let Some(&face) = faces.iter().find(|&&f| f as usize >= mesh.face_count()) {
            return Err(Error::NoSuchFace {
                face,
                faces: mesh.face_count(),
            });
        }
        let Some(&first) = faces.first() else {
            return Err(Error::BrokenSequence {
                position: 0,
                faces: [0, 0],
            });
        };
        self.restart(first);
        for (position, pair) in faces.windows(2).enumerate() {
            let portal = (3 * pair[0]..3 * pair[0] + 3)
                .find(|&h| mesh.twin(h).is_some_and(|twin| face_of(twin) == pair[1]))
                .ok_or(Error::BrokenSequence {
                    position: position + 1,
                    faces: [pair[0], pair[1]],
                })?;
            self.portals.push(portal);
        }
        Ok(())
    }

    /// The faces, in order.
    pub(crate) fn faces<'a>(&'a self, mesh: &'a Mesh) -> impl Iterator<Item = u32> + 'a {
        let entered = |&portal: &u32| mesh.twin(portal).map_or(face_of(portal), face_of);
        std::iter::once(self.first_face).chain(self.portals.iter().map(entered))
    }

    /// Lays the faces out in the plane: the first portal along the x axis, its face above.
    pub(crate) fn flatten(&mut self, mesh: &Mesh, from: SurfacePoint, to: SurfacePoint) {
        self.left.clear();
        self.right.clear();
        self.left_since.clear();
        self.right_since.clear();
        let (Some(&first), Some(&last)) = (self.portals.first(), self.portals.last()) else {
            return;
        };
        // Positions in space of the ends of the current portal go along with their images.
        let (mut right_end, mut left_end) = (
            mesh.position(mesh.origin(first)),
            mesh.position(mesh.tip(first)),
        );
        let (mut right, mut left) = (DVec2::ZERO, DVec2::new(mesh.length(first), 0.0));
        let (mut right_since, mut left_since) = (0, 0);
        let place = |right_end: glam::DVec3,
                     left_end: glam::DVec3,
                     right: DVec2,
                     left: DVec2,
                     third: glam::DVec3| {
            let edge = left_end - right_end;
            let length = edge.length();
            let along = (third - right_end).dot(edge) / length;
            let away = edge.cross(third - right_end).length() / length;
            let unit = (left - right) / length;
            // Looking out of the face along the strip, the third corner lies to the right of `right -> left`.
            right + along * unit + away * DVec2::new(unit.y, -unit.x)
        };
        // The apex of the first face lies behind the portal: seen from `left -> right` it is on the far side.
        let apex = place(
            left_end,
            right_end,
            left,
            right,
            mesh.position(mesh.apex(first)),
        );
        self.from = image(mesh, first, from, [right, left, apex]);
        for k in 0..self.portals.len() {
            let portal = self.portals[k];
            self.right.push(right);
            self.left.push(left);
            self.right_since.push(right_since);
            self.left_since.push(left_since);
            let Some(twin) = mesh.twin(portal) else { break };
            let third_end = mesh.position(mesh.apex(twin));
            let third = place(right_end, left_end, right, left, third_end);
            match self.portals.get(k + 1) {
                Some(&onward) if onward == next(twin) => {
                    (left_end, left, left_since) = (third_end, third, k as u32 + 1);
                }
                Some(_) => (right_end, right, right_since) = (third_end, third, k as u32 + 1),
                None => self.to = image(mesh, twin, to, [left, right, third]),
            }
        }
        debug_assert_eq!(self.portals.last(), Some(&last));
    }

    /// The last portal whose end on this side is the same copy as that of portal `k`.
    pub(crate) fn copy_until(&self, k: u32, side: Side) -> u32 {
        let since = match side {
            Side::Left => &self.left_since,
            Side::Right => &self.right_since,
        };
        let copy = since[k as usize];
        let further = since[k as usize + 1..]
            .iter()
            .take_while(|&&other| other == copy)
            .count();
        k + further as u32
    }

    /// Image of the end of portal `k` on the given side.
    #[inline]
    pub(crate) fn end(&self, k: u32, side: Side) -> DVec2 {
        match side {
            Side::Left => self.left[k as usize],
            Side::Right => self.right[k as usize],
        }
    }
}

/// Whether the edge of a portal contains the point.
#[inline]
fn portal_meets(mesh: &Mesh, portal: u32, point: SurfacePoint) -> bool {
    match point {
        SurfacePoint::Vertex(v) => mesh.origin(portal) == v || mesh.tip(portal) == v,
        SurfacePoint::Edge { halfedge, .. } => {
            halfedge == portal || mesh.twin(halfedge) == Some(portal)
        }
        SurfacePoint::Face { .. } => false,
    }
}

/// Image of a point of the face of `h`, from the images of origin, tip and apex.
fn image(mesh: &Mesh, h: u32, point: SurfacePoint, corners: [DVec2; 3]) -> DVec2 {
    // A strip that does not reach its point is refused before it is flattened.
    let weights = mesh.barycentric_in(face_of(h), point).unwrap_or_default();
    let first = (h % 3) as usize;
    (0..3).map(|k| weights[(first + k) % 3] * corners[k]).sum()
}
