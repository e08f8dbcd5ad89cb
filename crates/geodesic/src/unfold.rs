//! A path's faces laid flat, for drawing and for checking by eye (Figs. 2.1 and 2.4 of the thesis).

use glam::DVec2;

use crate::loops::strip_along;
use crate::mesh::{Mesh, face_of};
use crate::path::GeodesicPath;
use crate::strip::Strip;
use crate::{Error, SurfacePoint};

/// The faces along a path in the plane, each isometric to the one on the mesh and joined to the last along their common
/// edge, and the path in them: a straight line but for its pivots.
///
/// Around a pivot the faces of one side are shown, those of fewer faces. The image may overlap itself.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Unfolding {
    /// The faces, in order.
    pub faces: Vec<u32>,
    /// Their corners in the plane, in the order of the mesh.
    pub corners: Vec<[DVec2; 3]>,
    /// The points of the path in the plane.
    pub points: Vec<DVec2>,
}

impl GeodesicPath {
    /// Lays the faces along the path flat.
    ///
    /// # Errors
    ///
    /// Those of [`GeodesicPath::certify`], if the path does not belong to this mesh.
    pub fn unfold(&self, mesh: &Mesh) -> Result<Unfolding, Error> {
        self.certify(mesh)?;
        let mut strip = Strip::default();
        let (Some(&first), Some(&start), Some(&end)) =
            (self.faces.first(), self.points.first(), self.points.last())
        else {
            return Ok(Unfolding::default());
        };
        strip_along(mesh, &self.points, &self.faces, &mut strip);
        strip.flatten(mesh, start, end);
        let faces: Vec<u32> = strip.faces(mesh).collect();
        let mut corners: Vec<[DVec2; 3]> = Vec::with_capacity(faces.len());
        if strip.portals.is_empty() {
            corners.push(crate::path::frame(mesh, first));
        }
        for k in 0..strip.portals.len() {
            if k == 0 {
                corners.push(corners_at(
                    mesh,
                    strip.portals[0],
                    strip.right[0],
                    strip.left[0],
                ));
            }
            if let Some(twin) = mesh.twin(strip.portals[k]) {
                corners.push(corners_at(mesh, twin, strip.left[k], strip.right[k]));
            }
        }
        let image = |place: usize, point: SurfacePoint| {
            let weights = mesh.barycentric_in(faces[place], point).unwrap_or_default();
            (0..3)
                .map(|k| weights[k] * corners[place][k])
                .sum::<DVec2>()
        };
        let mut place = 0;
        let mut points = Vec::with_capacity(self.points.len());
        for (&face, &point) in self.faces.iter().zip(&self.points) {
            // The faces of the path come in the strip in the same order.
            place += faces[place..].iter().position(|&f| f == face).unwrap_or(0);
            points.push(image(place, point));
        }
        points.push(image(place, end));
        Ok(Unfolding {
            faces,
            corners,
            points,
        })
    }
}

/// The corners of the face of `h` in the plane, from the images of the ends of `h`; the face lies on its left.
fn corners_at(mesh: &Mesh, h: u32, origin: DVec2, tip: DVec2) -> [DVec2; 3] {
    let local = crate::path::frame(mesh, face_of(h));
    let first = (h % 3) as usize;
    let at = |k: usize| local[(first + k) % 3] - local[first];
    let turn = (tip - origin).rotate(DVec2::new(at(1).x, -at(1).y)) / at(1).length_squared();
    let mut corners = [DVec2::ZERO; 3];
    for k in 0..3 {
        corners[(first + k) % 3] = origin + turn.rotate(at(k));
    }
    corners
}

#[cfg(test)]
mod tests {
    use crate::{PathFinder, shapes};

    #[test]
    fn an_unfolding_is_isometric_and_straightens_the_path() {
        let mesh = shapes::sphere(2).unwrap();
        let mut finder = PathFinder::new(&mesh);
        for to in [5, 40, 99, 161] {
            let path = finder.shortest(0.into(), to.into()).unwrap().clone();
            let flat = path.unfold(&mesh).unwrap();
            for (face, corners) in flat.faces.iter().zip(&flat.corners) {
                let h = 3 * face;
                for k in 0..3u32 {
                    let side = corners[k as usize].distance(corners[(k as usize + 1) % 3]);
                    assert!((side - mesh.length(h + k)).abs() < 1e-13);
                }
            }
            assert_eq!(flat.points.len(), path.points().len());
            let length: f64 = flat
                .points
                .windows(2)
                .map(|ends| ends[0].distance(ends[1]))
                .sum();
            assert!((length - path.length()).abs() < 1e-12);
            if path.pivots().is_empty() {
                let chord = flat.points[0].distance(flat.points[flat.points.len() - 1]);
                assert!((chord - length).abs() < 1e-12);
            }
        }
    }
}
