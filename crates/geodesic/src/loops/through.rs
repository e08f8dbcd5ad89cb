//! Loops held at a point, and loops through a point in a direction.

use glam::DVec3;

use super::GeodesicLoop;
use super::cycle::strip_along;
use super::tighten::{LoopFinder, VANISHED};
use crate::mesh::{Mesh, angle_between, face_of};
use crate::straightest::Straightest;
use crate::{Error, SurfacePoint};

/// A geodesic loop held at a point, as an answer to "through this point, in this direction".
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DirectedLoop {
    /// The loop; its first point is the given one.
    pub geodesic: GeodesicLoop,
    /// Angle between the given direction and the one in which the loop leaves the point, both projected to the tangent
    /// plane there, in radians.
    pub direction_residual: f64,
    /// The corner of the loop at the point, [`GeodesicLoop::turn`]: 0 when it is a closed geodesic.
    pub closing_residual: f64,
}

impl DirectedLoop {
    /// Measures a loop that begins at a point.
    pub(crate) fn new(
        mesh: &Mesh,
        point: SurfacePoint,
        direction: DVec3,
        geodesic: GeodesicLoop,
    ) -> Self {
        // In the tangent plane: how the faces at the point are tilted does not matter.
        let normal = normal_at(mesh, point);
        let tangential = |d: DVec3| d - d.project_onto(normal);
        let positions = geodesic.path.positions();
        let long_enough = VANISHED * mesh.diameter();
        let leaving = positions
            .windows(2)
            .map(|ends| ends[1] - ends[0])
            .find(|step| step.length() > long_enough)
            .unwrap_or(direction);
        Self {
            direction_residual: angle_between(tangential(leaving), tangential(direction)),
            closing_residual: geodesic.turn(),
            geodesic,
        }
    }

    /// The sum of both residuals.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.direction_residual + self.closing_residual
    }
}

impl LoopFinder<'_> {
    /// The shortest loop in the class of a closed polyline that passes through its first point: a geodesic except for a
    /// corner there.
    ///
    /// # Errors
    ///
    /// As for [`LoopFinder::tighten`].
    pub fn held_at_first(&mut self, points: &[SurfacePoint]) -> Result<GeodesicLoop, Error> {
        let (points, faces) = self.join(points)?;
        let mesh = self.finder.mesh();
        let base = points[0];
        strip_along(mesh, &points, &faces, &mut self.shortener.strip);
        self.solve(base, base)?;
        let geodesic = self.write(base);
        if geodesic.length() < VANISHED * mesh.diameter() {
            return Err(self.null_loop(base));
        }
        Ok(geodesic)
    }

    /// Loops through a point in a direction: a search, with residuals.
    ///
    /// The straightest geodesic from the point is followed for `reach`. Each time that it comes back to within
    /// `tolerance` of the point, the loop so closed is tightened with the point held. The answers are sorted by the sum
    /// of their residuals: where both are 0, the closed geodesic asked for exists; otherwise they say how far the
    /// nearest loops of these classes are from it.
    ///
    /// # Errors
    ///
    /// As for [`Straightest::trace`]; [`Error::DirectionLeavesSurface`] if no face lies in that direction;
    /// [`Error::InvalidTolerance`].
    pub fn through(
        &mut self,
        point: SurfacePoint,
        direction: DVec3,
        reach: f64,
        tolerance: f64,
    ) -> Result<Vec<DirectedLoop>, Error> {
        let mesh = self.finder.mesh();
        let point = mesh.canonical(point)?;
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(Error::InvalidTolerance { tolerance });
        }
        let tracer = Straightest::new(mesh);
        let face = tracer.find_face_towards(point, direction)?;
        let trace = tracer.trace(point, face, direction, reach)?;
        let start = trace.positions[0];
        let mut answers: Vec<DirectedLoop> = Vec::new();
        for i in returns(&trace.positions, start, tolerance) {
            let Ok(geodesic) = self.held_at_first(&trace.points[..=i]) else {
                continue;
            };
            if answers.iter().any(|a| {
                (a.geodesic.length() - geodesic.length()).abs() <= 1e-9 * geodesic.length()
            }) {
                continue;
            }
            answers.push(DirectedLoop::new(mesh, point, direction, geodesic));
        }
        answers.sort_by(|a, b| a.residual().total_cmp(&b.residual()));
        Ok(answers)
    }
}

/// Places along a polyline where it comes back to its start, within a tolerance, after having left it.
fn returns(positions: &[DVec3], start: DVec3, tolerance: f64) -> Vec<usize> {
    let mut found = Vec::new();
    let mut nearest: Option<(f64, usize)> = None;
    let mut left = false;
    for (i, p) in positions.iter().enumerate() {
        let distance = p.distance(start);
        if distance > tolerance {
            found.extend(nearest.take().map(|(_, i)| i));
            left = true;
        } else if left && nearest.is_none_or(|(smallest, _)| distance < smallest) {
            nearest = Some((distance, i));
        }
    }
    found.extend(nearest.map(|(_, i)| i));
    found
}

/// The normal of the surface at a point: of a face, or the mean of the faces there by their angles.
fn normal_at(mesh: &Mesh, point: SurfacePoint) -> DVec3 {
    match point {
        SurfacePoint::Vertex(v) => {
            let turns = mesh
                .star(v)
                .map(|h| mesh.corner_angle(h) * mesh.face_normal(face_of(h)));
            turns.sum()
        }
        _ => mesh.faces_of(point).map(|f| mesh.face_normal(f)).sum(),
    }
}
