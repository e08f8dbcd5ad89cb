//! Steps from vertex to vertex: along edges, and straight over one.

use glam::DVec2;

use crate::SurfacePoint;
use crate::mesh::{Mesh, NONE, face_of, next, previous};
use crate::pivot::{Ray, ray_in_face};
use crate::strip::{Side, Strip};

/// One step of a path over vertices.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// Along a half-edge.
    Along { halfedge: u32 },
    /// Against a half-edge on the boundary.
    Against { halfedge: u32 },
    /// From the vertex opposite to a portal, straight over it.
    Across { portal: u32 },
    /// Between a vertex and a point inside a face that it belongs to.
    Inside { face: u32, point: SurfacePoint },
}

impl Step {
    /// The step that led to `v` by a half-edge.
    pub(super) fn new(mesh: &Mesh, v: u32, via: u32) -> Self {
        if mesh.tip(via) == v {
            Self::Along { halfedge: via }
        } else if mesh.origin(via) == v {
            Self::Against { halfedge: via }
        } else {
            Self::Across { portal: via }
        }
    }

    pub(super) fn origin(self, mesh: &Mesh) -> u32 {
        match self {
            Self::Along { halfedge } => mesh.origin(halfedge),
            Self::Against { halfedge } => mesh.tip(halfedge),
            Self::Across { portal } => mesh.apex(portal),
            Self::Inside { .. } => NONE,
        }
    }

    /// The direction in which the step leaves `v`, in the face on the given side of it.
    pub(super) fn departure(self, mesh: &Mesh, v: u32, side: Side) -> Option<Ray> {
        let end_of = |halfedge| Ray {
            halfedge,
            angle: mesh.corner_angle(halfedge),
        };
        match (self, side) {
            (Self::Along { halfedge }, Side::Left) => Some(Ray {
                halfedge,
                angle: 0.0,
            }),
            (Self::Along { halfedge }, Side::Right) => {
                mesh.twin(halfedge).map(|twin| end_of(next(twin)))
            }
            (Self::Against { .. }, Side::Left) => None,
            (Self::Against { halfedge }, Side::Right) => Some(end_of(next(halfedge))),
            (Self::Across { portal }, _) => {
                let halfedge = previous(portal);
                Some(Ray {
                    halfedge,
                    angle: angle_across(mesh, halfedge),
                })
            }
            (Self::Inside { face, point }, _) => {
                Some(ray_in_face(mesh, face, SurfacePoint::Vertex(v), point))
            }
        }
    }

    /// The direction from `v`, where the step ends, back along it.
    pub(super) fn arrival(self, mesh: &Mesh, v: u32, side: Side) -> Option<Ray> {
        match (self, side) {
            (Self::Along { halfedge }, Side::Left) => Some(Ray {
                halfedge: next(halfedge),
                angle: mesh.corner_angle(next(halfedge)),
            }),
            (Self::Along { halfedge }, Side::Right) => mesh.twin(halfedge).map(|halfedge| Ray {
                halfedge,
                angle: 0.0,
            }),
            (Self::Against { .. }, Side::Left) => None,
            (Self::Against { halfedge }, Side::Right) => Some(Ray {
                halfedge,
                angle: 0.0,
            }),
            (Self::Across { portal }, _) => {
                let halfedge = previous(mesh.twin(portal)?);
                Some(Ray {
                    halfedge,
                    angle: angle_across(mesh, halfedge),
                })
            }
            (Self::Inside { face, point }, _) => {
                Some(ray_in_face(mesh, face, SurfacePoint::Vertex(v), point))
            }
        }
    }

    /// Appends the step to a strip that passes its first vertex on one side and its last vertex on another. A strip
    /// that has not passed a vertex yet begins here.
    pub(super) fn take(
        self,
        mesh: &Mesh,
        before: Option<Side>,
        after: Option<Side>,
        strip: &mut Strip,
    ) {
        match self {
            Self::Inside { face, .. } => {
                if before.is_none() {
                    strip.restart(face);
                }
            }
            Self::Across { portal } => {
                if before.is_none() {
                    strip.restart(face_of(portal));
                }
                strip.push(mesh, portal);
            }
            Self::Along { halfedge } => {
                let twin = mesh.twin(halfedge).unwrap_or(halfedge);
                match (before, after) {
                    (None, Some(Side::Right)) => strip.restart(face_of(twin)),
                    (None, _) => strip.restart(face_of(halfedge)),
                    (Some(Side::Left), Some(Side::Right)) => strip.push(mesh, halfedge),
                    (Some(Side::Right), Some(Side::Left)) => strip.push(mesh, twin),
                    _ => {}
                }
            }
            Self::Against { halfedge } => {
                if before.is_none() {
                    strip.restart(face_of(halfedge));
                }
            }
        }
    }
}

/// Height and foot of the corner opposite to a side, from the lengths of the sides: the foot from the side's origin.
#[inline]
fn foot_and_height(base: f64, from_origin: f64, from_tip: f64) -> (f64, f64) {
    let foot = (base * base + from_origin * from_origin - from_tip * from_tip) / (2.0 * base);
    (
        foot,
        (from_origin * from_origin - foot * foot).max(0.0).sqrt(),
    )
}

/// Length of the straight way from the origin of `h` over the edge opposite to it, whose twin is `twin`, to the vertex
/// behind; `None` if the straight line misses the edge.
#[inline]
pub(super) fn straight_across(mesh: &Mesh, h: u32, twin: u32) -> Option<f64> {
    let base = mesh.length(twin);
    let (near, near_height) = foot_and_height(base, mesh.length(h), mesh.length(previous(h)));
    let (far, far_height) =
        foot_and_height(base, mesh.length(next(twin)), mesh.length(previous(twin)));
    let height = near_height + far_height;
    // Where the straight line meets the edge, times the height.
    let crossing = near * far_height + far * near_height;
    (crossing > 0.0 && crossing < base * height)
        .then(|| ((near - far) * (near - far) + height * height).sqrt())
}

/// Angle at the origin of `h` from `h` to the vertex behind the opposite edge.
fn angle_across(mesh: &Mesh, h: u32) -> f64 {
    let Some(twin) = mesh.twin(next(h)) else {
        return 0.0;
    };
    let (near, near_height) =
        foot_and_height(mesh.length(twin), mesh.length(h), mesh.length(previous(h)));
    let (far, far_height) = foot_and_height(
        mesh.length(twin),
        mesh.length(next(twin)),
        mesh.length(previous(twin)),
    );
    // In the frame of the opposite edge: the tip of `h` is at the origin, our vertex above, the other one below.
    let to_tip = DVec2::new(-near, -near_height);
    let to_far = DVec2::new(far - near, -far_height - near_height);
    to_tip.perp_dot(to_far).abs().atan2(to_tip.dot(to_far))
}
