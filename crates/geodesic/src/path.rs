//! The result: a path on the mesh, and the certificate that it is a geodesic.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, face_of, next};
use crate::pivot::{Shortener, Update, ray_in_face, side_angles};
use crate::strip::Strip;
use crate::{Error, SurfacePoint};

/// Side angles may fall short of π by this much in a certified path, in radians.
///
/// Side angles are sums of a few arc tangents of differences of coordinates: rounding reaches 1e-12 on meshes whose
/// edges are 1e-4 of their size.
pub const CERTIFIED_ANGLE: f64 = 1e-9;

/// Points of a certified path may lie this far off the straight line of their unfolded stretch, relative to its length.
pub const CERTIFIED_STRAIGHTNESS: f64 = 1e-9;

/// Points of a path are placed to so many times the rounding of the mesh's coordinates.
const BLUR: f64 = 4.0;

/// Points of a path lie on its mesh where the path says to this part of the mesh's diameter: some decimals may have been
/// lost on the way through a file.
const SAME_PLACE: f64 = 1e-9;

/// A vertex that a path passes through between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pivot {
    /// The vertex.
    pub vertex: u32,
    /// Position of the vertex in the points of the path.
    pub index: usize,
    /// Angle of the surface to the left of the path, in radians; `None` where the boundary lies on that side.
    pub left: Option<f64>,
    /// Angle of the surface to the right of the path.
    pub right: Option<f64>,
}

/// A path on a mesh: straight in every face, and, when it is a geodesic, straight in the unfolding between its pivots.
///
/// Made by [`PathFinder`](crate::PathFinder).
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeodesicPath {
    pub(crate) points: Vec<SurfacePoint>,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) faces: Vec<u32>,
    pub(crate) pivots: Vec<Pivot>,
    pub(crate) updates: Vec<Update>,
    pub(crate) length: f64,
}

impl GeodesicPath {
    /// The points of the path: its start, every crossing of an edge and every vertex passed, its end.
    #[must_use]
    pub fn points(&self) -> &[SurfacePoint] {
        &self.points
    }

    /// The same points in space.
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The faces passed: segment `i`, from point `i` to point `i + 1`, lies in face `i`.
    #[must_use]
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// The vertices that the path passes through between its ends, in order, with the angles on either side.
    #[must_use]
    pub fn pivots(&self) -> &[Pivot] {
        &self.pivots
    }

    /// The pivot updates that led from the initial path to this one.
    #[must_use]
    pub fn updates(&self) -> &[Update] {
        &self.updates
    }

    /// Length of the path.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Examines the path anew, from its points alone.
    ///
    /// A path is locally shortest when it is straight in the unfolding between the vertices that it passes, and no side
    /// angle at these is below π (Section 2.1 of the thesis, remark (b), with the condition on both sides).
    ///
    /// # Errors
    ///
    /// [`Error::BrokenSequence`], [`Error::SegmentLeavesFace`] or an error about a point or a face, if the path does not
    /// belong to this mesh.
    pub fn certify(&self, mesh: &Mesh) -> Result<Certificate, Error> {
        certify(mesh, &self.points, &self.faces)
    }

    /// As [`GeodesicPath::certify`], for a path whose points must lie in space where it says.
    ///
    /// A path keeps no reference to its mesh, so that it can be stored: its positions tell the mesh.
    pub(crate) fn measure(&self, mesh: &Mesh) -> Result<Certificate, Error> {
        let certificate = self.certify(mesh)?;
        let is_here = |(point, position): (&SurfacePoint, &DVec3)| {
            mesh.locate(*point).distance(*position) <= SAME_PLACE * mesh.diameter()
        };
        let fits = self.positions.len() == self.points.len()
            && self.points.iter().zip(&self.positions).all(is_here);
        if fits {
            Ok(certificate)
        } else {
            Err(Error::OtherMesh { what: "path" })
        }
    }

    fn push(&mut self, mesh: &Mesh, point: SurfacePoint) {
        self.points.push(point);
        self.positions.push(mesh.locate(point));
    }

    /// Writes out a shortened path.
    pub(crate) fn set(&mut self, mesh: &Mesh, shortener: &Shortener, strip: &mut Strip) {
        self.points.clear();
        self.positions.clear();
        self.faces.clear();
        self.pivots.clear();
        self.length = shortener.length();
        for (i, node) in shortener.nodes.iter().enumerate() {
            if let SurfacePoint::Vertex(vertex) = node.point
                && i > 0
                && i + 1 < shortener.nodes.len()
            {
                self.pivots.push(Pivot {
                    vertex,
                    index: self.points.len(),
                    left: node.left,
                    right: node.right,
                });
            }
            self.push(mesh, node.point);
            let Some(onward) = shortener.nodes.get(i + 1) else {
                break;
            };
            self.faces.push(node.leg.first_face);
            let portals = shortener.portals(node.leg);
            strip.restart(node.leg.first_face);
            strip.portals.extend_from_slice(portals);
            strip.flatten(mesh, node.point, onward.point);
            let direction = strip.to - strip.from;
            for (k, &portal) in portals.iter().enumerate() {
                let right = direction.perp_dot(strip.from - strip.right[k]);
                let left = direction.perp_dot(strip.left[k] - strip.from);
                let t = if right + left > 0.0 {
                    (right / (right + left)).clamp(0.0, 1.0)
                } else {
                    0.5
                };
                self.push(
                    mesh,
                    SurfacePoint::Edge {
                        halfedge: portal,
                        t,
                    },
                );
                self.faces
                    .push(mesh.twin(portal).map_or(face_of(portal), face_of));
            }
        }
    }
}

/// How straight a path is, measured on its points alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Certificate {
    /// Largest distance of a point from the straight line of its unfolded stretch, less what the rounding of coordinates
    /// explains, over the length of the stretch.
    pub straightness: f64,
    /// Smallest side angle at a vertex between the ends, in radians; infinite if there is none.
    pub smallest_side_angle: f64,
    /// Largest amount by which a side angle falls short of π, less what rounding explains of it: the rounding of the
    /// coordinates over the distance to the nearer of the two points next to the vertex. Where a path begins 1e-9 beside
    /// a vertex, its direction there is known to 1e-7 only. In radians; 0 if no angle falls short.
    pub shortfall: f64,
    /// Length of the path, added up in space.
    pub length: f64,
    /// What the rounding of the coordinates can do to these angles, in radians: for each face involved, an ulp of its
    /// corners over its height. Only needles make it count.
    pub rounding: f64,
}

impl Certificate {
    /// Whether the path is a geodesic: straight to [`CERTIFIED_STRAIGHTNESS`], with a [`shortfall`](Self::shortfall) of
    /// side angles of at most [`CERTIFIED_ANGLE`], both widened by [`rounding`](Self::rounding).
    #[must_use]
    pub fn is_geodesic(&self) -> bool {
        self.straightness <= CERTIFIED_STRAIGHTNESS + self.rounding
            && self.shortfall <= CERTIFIED_ANGLE + self.rounding
    }
}

/// Examines a polyline on a mesh; segment `i` lies in `faces[i]`.
///
/// The faces are unfolded by turning each onto the last about their common edge, a complex rotation each, unlike the
/// shortening, which places corners.
pub(crate) fn certify(
    mesh: &Mesh,
    points: &[SurfacePoint],
    faces: &[u32],
) -> Result<Certificate, Error> {
    let mut certificate = Certificate {
        straightness: 0.0,
        smallest_side_angle: f64::INFINITY,
        shortfall: 0.0,
        length: 0.0,
        rounding: 0.0,
    };
    // One face for each segment: a list that is too short would leave the rest of the path unexamined.
    if faces.len() != points.len().saturating_sub(1) {
        return Err(Error::SegmentLeavesFace {
            position: faces.len().min(points.len()),
        });
    }
    for &point in points.iter().take(1) {
        mesh.canonical(point)?;
    }
    let mut stretch = vec![DVec2::ZERO];
    let mut rotation = DVec2::X;
    for (i, (ends, &face)) in points.windows(2).zip(faces).enumerate() {
        let step = step_in_face(mesh, face, ends[0], ends[1])?;
        certificate.length += step.length();
        certificate.rounding += angle_rounding(mesh, face);
        let blur = BLUR * f64::EPSILON * (mesh.diameter() + largest_coordinate(mesh, face));
        let here = stretch.last().copied().unwrap_or_default();
        stretch.push(here + rotation.rotate(step));
        let onward = faces.get(i + 1).zip(points.get(i + 2));
        match (ends[1], onward) {
            (SurfacePoint::Edge { halfedge, .. }, Some((&next_face, _))) => {
                if next_face != face {
                    let leaving = if face_of(halfedge) == face {
                        Some(halfedge)
                    } else {
                        mesh.twin(halfedge)
                    };
                    let entering = leaving
                        .and_then(|h| mesh.twin(h))
                        .filter(|&h| face_of(h) == next_face);
                    let (Some(leaving), Some(entering)) = (leaving, entering) else {
                        return Err(Error::BrokenSequence {
                            position: i + 1,
                            faces: [face, next_face],
                        });
                    };
                    let [out, back] = [leaving, entering].map(|h| direction_in_face(mesh, h));
                    // The edge runs the other way in the next face.
                    rotation = -rotation.rotate(out).rotate(DVec2::new(back.x, -back.y));
                }
            }
            (point, onward) => {
                certificate.straightness = certificate.straightness.max(bow(&stretch, blur));
                stretch.truncate(1);
                if let (SurfacePoint::Vertex(v), Some((&next_face, &after))) = (point, onward) {
                    // Before it is used: whether the next face exists and contains the vertex.
                    let onward_step = step_in_face(mesh, next_face, point, after)?;
                    let incoming = ray_in_face(mesh, face, point, ends[0]);
                    let outgoing = ray_in_face(mesh, next_face, point, after);
                    let (left, right) = side_angles(mesh, v, incoming, outgoing);
                    certificate.rounding += mesh
                        .star(v)
                        .map(|h| angle_rounding(mesh, face_of(h)))
                        .sum::<f64>();
                    let explained = blur / step.length().min(onward_step.length());
                    for side in [left, right].into_iter().flatten() {
                        certificate.smallest_side_angle = certificate.smallest_side_angle.min(side);
                        // Of 0/0, where the points coincide, all is explained.
                        certificate.shortfall = certificate.shortfall.max(PI - side - explained);
                    }
                }
            }
        }
    }
    Ok(certificate)
}

/// An ulp of the corners of a face over its height: the angle that rounding moves it by.
fn angle_rounding(mesh: &Mesh, face: u32) -> f64 {
    let [a, b, c] = mesh.faces()[face as usize].map(|v| mesh.position(v));
    let size = largest_coordinate(mesh, face);
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    f64::EPSILON * size * longest / (b - a).cross(c - a).length()
}

/// The largest coordinate of the corners of a face.
fn largest_coordinate(mesh: &Mesh, face: u32) -> f64 {
    mesh.faces()[face as usize]
        .map(|v| mesh.position(v).abs().max_element())
        .into_iter()
        .fold(0.0, f64::max)
}

/// The corners of a face in a plane frame of its own.
pub(crate) fn frame(mesh: &Mesh, face: u32) -> [DVec2; 3] {
    let [a, b, c] = mesh.faces()[face as usize].map(|v| mesh.position(v));
    let base = (b - a).length();
    let (along, away) = (
        (c - a).dot(b - a) / base,
        (b - a).cross(c - a).length() / base,
    );
    [DVec2::ZERO, DVec2::new(base, 0.0), DVec2::new(along, away)]
}

/// The direction of a half-edge in the frame of its face.
pub(crate) fn direction_in_face(mesh: &Mesh, h: u32) -> DVec2 {
    let corners = frame(mesh, face_of(h));
    (corners[(next(h) % 3) as usize] - corners[(h % 3) as usize]).normalize()
}

/// The vector from one point of a face to another, in its frame.
pub(crate) fn step_in_face(
    mesh: &Mesh,
    face: u32,
    from: SurfacePoint,
    to: SurfacePoint,
) -> Result<DVec2, Error> {
    if face as usize >= mesh.face_count() {
        return Err(Error::NoSuchFace {
            face,
            faces: mesh.face_count(),
        });
    }
    let weights = |point: SurfacePoint| {
        let known = mesh.canonical(point).map(|_| point)?;
        mesh.barycentric_in(face, known)
            .ok_or(Error::SequenceMissesPoint { point })
    };
    let (from, to) = (weights(from)?, weights(to)?);
    let corners = frame(mesh, face);
    Ok((0..3).map(|k| (to[k] - from[k]) * corners[k]).sum())
}

/// Largest distance of the points from the line through the first and the last, or how much longer their polyline is
/// than that chord, less what rounding explains, over the chord.
fn bow(stretch: &[DVec2], blur: f64) -> f64 {
    let (Some(&first), Some(&last)) = (stretch.first(), stretch.last()) else {
        return 0.0;
    };
    let chord = last - first;
    let length = chord.length();
    if length == 0.0 {
        return 0.0;
    }
    let aside = stretch
        .iter()
        .map(|&p| (chord.perp_dot(p - first) / length).abs())
        .fold(0.0, f64::max);
    let walked: f64 = stretch
        .windows(2)
        .map(|ends| ends[0].distance(ends[1]))
        .sum();
    (aside.max(walked - length) - blur).max(0.0) / length
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PathFinder, shapes};

    /// As it may come out of a file.
    #[test]
    fn paths_that_do_not_fit_the_mesh_are_refused() {
        let cube = shapes::cube().unwrap();
        let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
        let around: Vec<SurfacePoint> = [0, 1, 5, 7].map(SurfacePoint::Vertex).to_vec();
        for faces in [
            vec![999_999],
            vec![0, 5, 900],
            vec![4, 900, 900],
            vec![4, 5],
            vec![],
        ] {
            for count in 0..=4 {
                let path = GeodesicPath {
                    points: around[..count].to_vec(),
                    faces: faces.clone(),
                    ..GeodesicPath::default()
                };
                let refused = path.certify(&cube).is_err() && path.unfold(&cube).is_err();
                // No points and one point are paths without a segment.
                assert!(refused || (faces.is_empty() && count < 2), "{path:?}");
            }
        }
        let mut finder = PathFinder::new(&torus);
        let path = finder.shortest(0.into(), 150.into()).unwrap();
        assert!(path.certify(&cube).is_err() && path.unfold(&cube).is_err());
        assert!(path.measure(&torus).is_ok());
        let larger = shapes::torus(20.0, 7.0, 24, 12).unwrap();
        assert_eq!(
            path.measure(&larger),
            Err(Error::OtherMesh { what: "path" })
        );
    }
}
