//! Discrete geodesic curvature of a polyline on a mesh.

use std::f64::consts::PI;

use glam::DVec2;

use crate::mesh::{Mesh, face_of};
use crate::path::{direction_in_face, step_in_face};
use crate::pivot::{ray_in_face, side_angles};
use crate::{Error, SurfacePoint};

impl Mesh {
    /// Discrete geodesic curvature of a polyline at each of its points but the ends, in radians, positive where it turns left:
    /// `(2π/θ)(θ/2 − β)`, with the total angle `θ` at the point and the angle `β` to the left of the polyline (Polthier and
    /// Schmies). On an edge and inside a face, where `θ = 2π`, it is the angle of turning in the unfolding; on the boundary it is
    /// what the angle on the side of the surface differs from π by.
    ///
    /// It vanishes on straightest geodesics, and on shortest paths except at hyperbolic vertices.
    ///
    /// ```
    /// use geodesic::{SurfacePoint, shapes};
    /// let sheet = shapes::sheet(2, 2, |p| p.extend(0.0))?;
    /// let corner: Vec<SurfacePoint> = [1, 4, 5].map(SurfacePoint::Vertex).to_vec();
    /// let turns = sheet.polyline_curvature(&corner)?; // a right angle
    /// assert!((turns[0].abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    /// # Ok::<(), geodesic::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// An error about a point that is not on the mesh; [`Error::SegmentLeavesFace`] if a point and the next one are the same
    /// or lie in no common face.
    pub fn polyline_curvature(&self, points: &[SurfacePoint]) -> Result<Vec<f64>, Error> {
        let points = points
            .iter()
            .map(|&point| self.canonical(point))
            .collect::<Result<Vec<_>, _>>()?;
        let faces = points
            .windows(2)
            .enumerate()
            .map(|(position, ends)| {
                self.faces_of(ends[0])
                    .find(|&f| self.face_contains(f, ends[1]) && ends[0] != ends[1])
                    .ok_or(Error::SegmentLeavesFace { position })
            })
            .collect::<Result<Vec<_>, _>>()?;
        points
            .windows(3)
            .zip(faces.windows(2))
            .map(|(points, faces)| {
                let [before, at, after] = [points[0], points[1], points[2]];
                let [first, second] = [faces[0], faces[1]];
                if let SurfacePoint::Vertex(v) = at {
                    return Ok(at_vertex(self, v, [first, second], [before, after]));
                }
                let mut incoming = step_in_face(self, first, before, at)?;
                let outgoing = step_in_face(self, second, at, after)?;
                if first != second
                    && let SurfacePoint::Edge { halfedge, .. } = at
                    && let Some(twin) = self.twin(halfedge)
                {
                    let (out, back) = match face_of(halfedge) == first {
                        true => (halfedge, twin),
                        false => (twin, halfedge),
                    };
                    // The edge runs the other way in the next face: from the frame of the first into that of the second.
                    let [out, back] = [out, back].map(|h| direction_in_face(self, h));
                    incoming = -incoming.rotate(DVec2::new(out.x, -out.y)).rotate(back);
                }
                Ok(incoming.perp_dot(outgoing).atan2(incoming.dot(outgoing)))
            })
            .collect()
    }
}

fn at_vertex(mesh: &Mesh, v: u32, faces: [u32; 2], ends: [SurfacePoint; 2]) -> f64 {
    let at = SurfacePoint::Vertex(v);
    let incoming = ray_in_face(mesh, faces[0], at, ends[0]);
    let outgoing = ray_in_face(mesh, faces[1], at, ends[1]);
    match side_angles(mesh, v, incoming, outgoing) {
        (Some(left), Some(_)) => 2.0 * PI / mesh.angle(v) * (0.5 * mesh.angle(v) - left),
        (Some(left), None) => PI - left,
        (None, Some(right)) => right - PI,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PathFinder, Straightest, shapes};
    use glam::DVec3;

    /// Straightest geodesics have none; a closed polyline has what Gauss and Bonnet say.
    #[test]
    fn straightest_geodesics_have_none() {
        let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
        let start = torus.face_point(7, [0.5, 0.3, 0.2]).unwrap();
        let trace = Straightest::new(&torus)
            .trace(start, 7, DVec3::new(0.3, -0.8, 0.51), 12.0)
            .unwrap();
        assert!(trace.points.len() > 30);
        for turn in torus.polyline_curvature(&trace.points).unwrap() {
            assert!(turn.abs() < 1e-9, "{turn}");
        }
        let path = PathFinder::new(&torus)
            .shortest(0.into(), 100.into())
            .unwrap()
            .clone();
        let turns = torus.polyline_curvature(path.points()).unwrap();
        for (i, turn) in turns.iter().enumerate() {
            let is_pivot = path.pivots().iter().any(|pivot| pivot.index == i + 1);
            assert!(is_pivot || turn.abs() < 1e-9, "{turn}");
        }
    }

    /// On a cube the polyline around a corner, through the middles of three edges, turns by 2π − π/2 in all.
    #[test]
    fn gauss_and_bonnet_around_the_corner_of_a_cube() {
        let cube = shapes::cube().unwrap();
        let around: Vec<SurfacePoint> = cube
            .star(0)
            .map(|h| SurfacePoint::Edge {
                halfedge: h,
                t: 0.5,
            })
            .collect();
        let closed: Vec<SurfacePoint> = around.iter().chain(&around[..2]).copied().collect();
        let total: f64 = cube.polyline_curvature(&closed).unwrap().iter().sum();
        assert!((total - 1.5 * PI).abs() < 1e-12, "{total}");
        assert!(matches!(
            cube.polyline_curvature(&[0.into(), 7.into()]),
            Err(Error::SegmentLeavesFace { position: 0 })
        ));
    }
}
