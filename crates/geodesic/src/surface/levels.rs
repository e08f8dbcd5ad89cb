//! A parametric surface as a sequence of polyhedra, and a path that is carried from each to the next (Section 2.2 of the
//! thesis, Figs. 2.6 and 2.7).

use bezier_mass::{BSplineSurface, BezierPatch, MassPoint};
use glam::{DVec2, DVec3};

use super::carry::{sequence, tighten_through};
use super::convergence::{Convergence, check_tolerance};
use super::grid::Grid;
use super::net::{Axis, BezierNet};
use crate::mesh::Mesh;
use crate::{Error, PathFinder, SurfacePoint};

/// The control nets of a Bézier patch, or of the Bézier patches of a spline surface, after 0, 1, 2, ... midpoint
/// subdivisions, as meshes: they converge to the surface with the square of their step.
///
/// Each line of the net belongs to a parameter, at equal steps on each patch; each cell is cut by the diagonal from
/// `(i, j)` to `(i + 1, j + 1)`. In the direction of periodic knots the net is closed: paths cross the seam, and parameters
/// beyond the period choose how often a path goes round. A seam of clamped knots is a boundary, as it is in the data.
///
/// ```
/// use geodesic::{PatchLevels, bezier_mass::BezierPatch, glam::{DVec2, DVec3}};
/// let heights = [[0.0, 0.3, 0.0], [0.3, 1.5, 0.3], [0.0, 0.3, 0.0]];
/// let net: Vec<DVec3> = (0..9)
///     .map(|k| DVec3::new((k / 3) as f64, (k % 3) as f64, heights[k / 3][k % 3]))
///     .collect();
/// let patch = BezierPatch::polynomial([2, 2], &net)?;
/// let (from, to) = (DVec2::new(0.1, 0.1), DVec2::new(0.9, 0.7));
/// let (path, convergence) = PatchLevels::new(&patch).path_within(from, to, 1e-4)?;
/// assert!(convergence.error() <= 1e-4 && (path.length - convergence.lengths[0]).abs() < 0.3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PatchLevels {
    net: BezierNet,
}

/// The shortest path on the net of one level, within the faces that the path of the level before suggested.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LevelPath {
    /// Its length.
    pub length: f64,
    /// The number of faces of the net.
    pub faces: usize,
    /// Its points in space.
    pub positions: Vec<DVec3>,
    /// Its points in the parameter plane.
    pub parameters: Vec<DVec2>,
}

impl PatchLevels {
    /// The patch's own net, level 0, over the unit square.
    #[must_use]
    pub fn new(patch: &BezierPatch<DVec3>) -> Self {
        Self {
            net: BezierNet::of_patch(patch),
        }
    }

    /// The net of an array of Bézier patches of the same degrees that share their boundaries: `a m + 1` rows of
    /// `b n + 1` mass points for `a x b` patches of degrees `[m, n]`, over the unit square in equal parts.
    ///
    /// # Errors
    ///
    /// [`Error::NetSize`] for a net of another size.
    pub fn of_patches(degrees: [usize; 2], rows: &[Vec<MassPoint<DVec3>>]) -> Result<Self, Error> {
        Ok(Self {
            net: BezierNet::of_rows(degrees, rows)?,
        })
    }

    /// The net of one Bézier patch for each pair of knot spans of a spline surface, over the surface's own parameters.
    #[must_use]
    pub fn of_spline(surface: &BSplineSurface<DVec3>) -> Self {
        Self {
            net: BezierNet::of_spline(surface),
        }
    }

    /// The net of this level as a mesh.
    ///
    /// # Errors
    ///
    /// Those of [`Mesh::new`], for a net with a collapsed edge or a control vector.
    pub fn mesh(&self) -> Result<Mesh, Error> {
        Mesh::new(
            &self.net.positions()?,
            &Grid::new(&self.net.axes).triangles(),
        )
    }

    /// The point of this level's mesh that belongs to a parameter point.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideDomain`].
    pub fn point(&self, uv: DVec2) -> Result<SurfacePoint, Error> {
        let axes = &self.net.axes;
        check(axes, uv)?;
        Ok(Grid::new(axes).point(place(axes, uv)))
    }

    /// Goes on to the next level: one midpoint subdivision in both directions.
    ///
    /// # Errors
    ///
    /// [`Error::TooLarge`] for a net beyond 4 million faces.
    pub fn subdivide(&mut self) -> Result<(), Error> {
        self.net.subdivide()
    }

    /// Shortest paths between two parameter points on the nets of level 0 to `levels`, the first one found from the straight
    /// segment between the parameters.
    ///
    /// The error falls with the square of the step, by a factor 4 a level, once the path's way is found.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideDomain`] for an end outside the domain; those of [`PatchLevels::mesh`]; [`Error::TooLarge`].
    pub fn paths(self, from: DVec2, to: DVec2, levels: usize) -> Result<Vec<LevelPath>, Error> {
        self.paths_along(&[from, to], levels)
    }

    /// The same with the first path found from a curve in the parameter plane, which chooses on which side of a bump it
    /// passes.
    ///
    /// # Errors
    ///
    /// As for [`PatchLevels::paths`]; [`Error::ShortLoop`] for fewer than two points.
    pub fn paths_along(mut self, way: &[DVec2], levels: usize) -> Result<Vec<LevelPath>, Error> {
        let mut paths = vec![self.path_along(way)?];
        for level in 0..levels {
            self.subdivide()?;
            let path = self.path_along(&paths[level].parameters)?;
            paths.push(path);
        }
        Ok(paths)
    }

    /// The path on the first level whose estimated error, [`Convergence::error`], is below the tolerance.
    ///
    /// # Errors
    ///
    /// As for [`PatchLevels::paths`]; [`Error::InvalidTolerance`]; [`Error::TooLarge`] if the
    /// tolerance asks for more faces than there may be.
    pub fn path_within(
        mut self,
        from: DVec2,
        to: DVec2,
        tolerance: f64,
    ) -> Result<(LevelPath, Convergence), Error> {
        check_tolerance(tolerance)?;
        let mut path = self.path_along(&[from, to])?;
        let mut convergence = Convergence {
            lengths: vec![path.length],
        };
        while convergence.error() > tolerance {
            self.subdivide()?;
            path = self.path_along(&path.parameters)?;
            convergence.lengths.push(path.length);
        }
        Ok((path, convergence))
    }

    /// The path on this level from the first to the last point of a way in the parameter plane.
    fn path_along(&self, way: &[DVec2]) -> Result<LevelPath, Error> {
        let axes = &self.net.axes;
        way.iter().try_for_each(|&uv| check(axes, uv))?;
        let places = places(axes, way);
        let [from, .., to] = places[..] else {
            return Err(Error::ShortLoop { points: way.len() });
        };
        let grid = Grid::new(axes);
        let mesh = self.mesh()?;
        let [start, end] = [from, to].map(|place| mesh.canonical(grid.point(place)));
        let (start, end) = (start?, end?);
        let faces = sequence(&mesh, grid.faces_met(&places), start, end);
        let mut finder = PathFinder::new(&mesh).with_neighbouring_classes(false);
        let path = if axes.iter().any(|axis| axis.closed) {
            &tighten_through(&mesh, &faces, start, end)?
        } else {
            finder.along(&faces, start, end)?
        };
        let mut near = from;
        let parameters = path.points().iter().map(|point| {
            near = grid.place(&mesh, *point, near);
            DVec2::new(axes[0].to_parameter(near.x), axes[1].to_parameter(near.y))
        });
        Ok(LevelPath {
            length: path.length(),
            faces: mesh.face_count(),
            positions: path.positions().to_vec(),
            parameters: parameters.collect(),
        })
    }
}

fn check(axes: &[Axis; 2], uv: DVec2) -> Result<(), Error> {
    if axes[0].contains(uv.x) && axes[1].contains(uv.y) {
        Ok(())
    } else {
        Err(Error::OutsideDomain { u: uv.x, v: uv.y })
    }
}

/// A parameter point in units of cells.
fn place(axes: &[Axis; 2], uv: DVec2) -> DVec2 {
    DVec2::new(axes[0].to_cells(uv.x), axes[1].to_cells(uv.y))
}

/// A way in units of cells. A segment that is straight in the parameters has a corner where it passes from a span to one of
/// another width.
fn places(axes: &[Axis; 2], way: &[DVec2]) -> Vec<DVec2> {
    let mut places: Vec<DVec2> = way.first().map(|&uv| place(axes, uv)).into_iter().collect();
    for ends in way.windows(2) {
        let along = ends[1] - ends[0];
        let mut cuts: Vec<f64> = Vec::new();
        for (axis, (from, step)) in axes
            .iter()
            .zip([(ends[0].x, along.x), (ends[0].y, along.y)])
        {
            let breakpoints = axis.breakpoints_between(from, from + step);
            cuts.extend(breakpoints.iter().map(|b| (b - from) / step));
        }
        cuts.sort_by(f64::total_cmp);
        places.extend(cuts.iter().map(|&t| place(axes, ends[0] + t * along)));
        places.push(place(axes, ends[1]));
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SmoothSurface, TorusSurface, geodesic_between};
    use bezier_mass::Knots;
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};

    /// The torus of radii 2 and 0.7 as a rational biquadratic spline, closed in both directions: four arcs of a quarter
    /// turn each way.
    fn torus() -> BSplineSurface<DVec3> {
        let breakpoints: Vec<f64> = (0..=8).map(|k| f64::from((k + 1) / 2)).collect();
        let knots = Knots::periodic(2, &breakpoints).unwrap();
        // Around the unit circle: a point, then the corner of the square with weight cos 45°.
        let circle = |k: usize| {
            let angle = TAU * k as f64 / 8.0;
            let (radius, weight) = [(1.0, 1.0), (2f64.sqrt(), FRAC_1_SQRT_2)][k % 2];
            (radius * DVec2::from_angle(angle), weight)
        };
        let control: Vec<MassPoint<DVec3>> = (0..64)
            .map(|k| {
                let ((a, wa), (b, wb)) = (circle(k / 8), circle(k % 8));
                let rho = 2.0 + 0.7 * b.x;
                MassPoint::point(DVec3::new(rho * a.x, rho * a.y, 0.7 * b.y), wa * wb)
            })
            .collect();
        BSplineSurface::new([knots.clone(), knots], control).unwrap()
    }

    /// The angles of a point of the torus.
    fn angles(point: DVec3) -> DVec2 {
        let rho = point.truncate().length() - 2.0;
        DVec2::new(point.y.atan2(point.x), point.z.atan2(rho))
    }

    #[test]
    fn the_spline_is_a_torus() {
        let surface = torus();
        for k in 0..40 {
            let uv = DVec2::new(0.17 * f64::from(k) - 1.0, 0.31 * f64::from(k));
            let point = SmoothSurface::jet(&surface, uv).point;
            let distance = (point.truncate().length() - 2.0).hypot(point.z);
            assert!((distance - 0.7).abs() < 1e-13, "{uv} {point}");
        }
    }

    /// Across both seams, with unequal steps, against the geodesic of the torus in angles.
    #[test]
    fn paths_on_a_closed_spline_converge_with_order_two() {
        let surface = torus();
        let (from, to) = (DVec2::new(3.5, 0.25), DVec2::new(4.25, -0.5));
        let paths = PatchLevels::of_spline(&surface).paths(from, to, 5).unwrap();
        let last = &paths[5];
        let smooth = geodesic_between(&surface, &last.parameters, 1e-11).unwrap();
        assert!(smooth.inside && smooth.conjugate_points == 0);
        // The same in angles: the ends lie on either side of both seams.
        let ends = [from, to].map(|uv| angles(SmoothSurface::jet(&surface, uv).point));
        let torus = TorusSurface {
            major: 2.0,
            minor: 0.7,
        };
        let reference = geodesic_between(&torus, &ends, 1e-11).unwrap();
        assert!((smooth.length - reference.length).abs() < 1e-9);
        let errors: Vec<f64> = paths
            .iter()
            .map(|path| path.length - reference.length)
            .collect();
        let order = (errors[4] / errors[5]).log2();
        assert!((order - 2.0).abs() < 0.2, "{errors:?}");
        let convergence = Convergence {
            lengths: paths.iter().map(|path| path.length).collect(),
        };
        let factor = convergence.error() / errors[5].abs();
        assert!((2.0..4.5).contains(&factor), "{factor}");
        assert!((last.parameters[0] - from).length() < 1e-9);
        assert!((last.parameters[last.parameters.len() - 1] - to).length() < 1e-9);
    }

    /// A cubic spline with spans of unequal width, clamped.
    #[test]
    fn paths_on_a_clamped_spline_converge_with_order_two() {
        let knots = [
            Knots::clamped(3, &[0.0, 0.2, 0.7, 1.0]).unwrap(),
            Knots::clamped(2, &[-1.0, 0.5, 1.0]).unwrap(),
        ];
        let control: Vec<MassPoint<DVec3>> = (0..24)
            .map(|k| {
                let (i, j) = ((k / 4) as f64, (k % 4) as f64);
                let height = (1.3 * i).sin() * (0.9 * j + 0.4).cos();
                MassPoint::point(DVec3::new(i, j, height), 1.0 + 0.3 * (i * j).sin())
            })
            .collect();
        let surface = BSplineSurface::new(knots, control).unwrap();
        let (from, to) = (DVec2::new(0.1, -0.25), DVec2::new(0.85, 0.75));
        let (path, convergence) = PatchLevels::of_spline(&surface)
            .path_within(from, to, 1e-4)
            .unwrap();
        let smooth = geodesic_between(&surface, &path.parameters, 1e-10).unwrap();
        assert!(smooth.inside);
        let error = (path.length - smooth.length).abs();
        assert!(
            error <= 1e-4 && convergence.error() <= 1e-4,
            "{error} {convergence:?}"
        );
        let limit = convergence.limit().unwrap();
        assert!((limit - smooth.length).abs() < 0.3 * error);
        assert!(
            (convergence.order().unwrap() - 2.0).abs() < 0.2,
            "{convergence:?}"
        );
    }

    /// The way round a closed surface is the caller's choice.
    #[test]
    fn parameters_beyond_the_period_go_round() {
        let from = DVec2::new(0.5, 2.0);
        for turns in [-1.0, 1.0, 2.0] {
            let to = from + DVec2::new(4.0 * turns, 0.0);
            let paths = PatchLevels::of_spline(&torus()).paths(from, to, 3).unwrap();
            // Around the inner equator, of radius 1.3.
            assert!((paths[3].length / (turns.abs() * TAU * 1.3) - 1.0).abs() < 0.01);
        }
    }

    #[test]
    fn hostile_ends_are_refused() {
        let patch = BezierPatch::polynomial([1, 1], &[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE])
            .unwrap();
        let inside = DVec2::new(0.2, 0.3);
        for to in [DVec2::new(1.1, 0.0), DVec2::NAN, DVec2::new(0.0, -1e-3)] {
            let answer = PatchLevels::new(&patch).paths(inside, to, 1);
            assert!(matches!(answer, Err(Error::OutsideDomain { .. })));
        }
        for tolerance in [0.0, -1.0, f64::NAN] {
            let answer = PatchLevels::new(&patch).path_within(inside, DVec2::ONE, tolerance);
            assert!(matches!(answer, Err(Error::InvalidTolerance { .. })));
        }
        let answer = PatchLevels::new(&patch).paths_along(&[inside], 1);
        assert_eq!(answer, Err(Error::ShortLoop { points: 1 }));
        let same = PatchLevels::new(&patch).paths(inside, inside, 2).unwrap();
        assert_eq!(same[2].length, 0.0);
        let flat = vec![MassPoint::point(DVec3::ZERO, 1.0); 4];
        let answer = PatchLevels::of_patches([2, 2], &vec![flat.clone(); 3]);
        assert!(matches!(answer, Err(Error::NetSize { .. })));
        let collapsed = PatchLevels::of_patches([1, 3], &vec![flat; 2]).unwrap();
        assert!(collapsed.paths(inside, DVec2::ONE, 1).is_err());
    }
}
