//! The curves in which two cones meet, in the planes of the diagonals.

use crate::{Error, Family, SphereLine};
use bezier_mass::{MassPoint, Quadratic};
use glam::DVec3;

/// The intersection of two cones in one diagonal plane.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Section {
    /// A conic, in two halves: rational quadratic curves with mass control points. Where it is no ellipse the curve passes through infinity.
    Conic([Quadratic<DVec3>; 2]),
    /// Lines through the common vertex: none, one (a double line) or two, each by its unit direction.
    Lines {
        /// The common vertex.
        vertex: DVec3,
        /// Unit directions.
        directions: Vec<DVec3>,
    },
}

impl Family {
    /// The curve in which the two cones meet in the plane of this family's diagonal, perpendicular to the axial plane. `None` for cones on one
    /// axis and for a diagonal at infinity.
    ///
    /// # Errors
    ///
    /// [`Error::Mass`] only where a control point overflows.
    pub fn section(&self) -> Result<Option<Section>, Error> {
        let Some(diagonal) = self.diagonal() else {
            return Ok(None);
        };
        let normal = diagonal.direction.cross(self.plane_normal);
        let line = &self.lines[0];
        // The plane as a linear form on mass points about the diagonal's point.
        let form =
            |h: MassPoint<DVec3>| normal.dot(h.weighted) - normal.dot(diagonal.point) * h.weight;
        let apex = apex(line);
        let height = form(apex);
        let reach = apex.weighted.length().max(apex.weight.abs());
        if apex.weight != 0.0
            && height.abs() <= crate::tolerance::CLASS * self.size.max(f64::EPSILON * reach)
        {
            return Ok(Some(self.rulings_in(normal, apex.weighted / apex.weight)));
        }
        let across = self.plane_normal.cross(line.axis);
        let base = line.at(line.foot(diagonal.point) + self.size);
        let circle = line.contact_circle(base);
        // Half circles as quadratics with a vector in the middle; each ruling meets the plane in form(base) apex - form(apex) base.
        let half = |side: f64| -> Result<Quadratic<DVec3>, Error> {
            let controls =
                [(1.0, side, 0.0), (0.0, 0.0, side), (1.0, -side, 0.0)].map(|(one, cos, sin)| {
                    let offset = circle.radius * (cos * across + sin * self.plane_normal);
                    let on_base = MassPoint::from_homogeneous(one, one * circle.centre + offset);
                    apex * form(on_base) - on_base * height
                });
            Ok(Quadratic::new(controls)?)
        };
        Ok(Some(Section::Conic([half(1.0)?, half(-1.0)?])))
    }

    /// The rulings of the first cone in a plane through its vertex.
    fn rulings_in(&self, normal: DVec3, vertex: DVec3) -> Section {
        let line = &self.lines[0];
        let across = self.plane_normal.cross(line.axis);
        let (sin, cos) = (line.sin.abs(), line.cos);
        let cosine = -normal.dot(line.axis) * cos / (sin * normal.dot(across));
        let ruling = |cosine: f64, sine: f64| {
            cos * line.axis + sin * (cosine * across + sine * self.plane_normal)
        };
        let directions = if (cosine.abs() - 1.0).abs() <= crate::tolerance::CLASS {
            vec![ruling(cosine.signum(), 0.0)]
        } else if cosine.abs() < 1.0 {
            let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
            vec![ruling(cosine, sine), ruling(cosine, -sine)]
        } else {
            Vec::new()
        };
        Section::Lines { vertex, directions }
    }
}

/// The vertex of a cone, or the direction of a cylinder's axis as a vector.
fn apex(line: &SphereLine) -> MassPoint<DVec3> {
    if line.sin == 0.0 {
        return MassPoint::vector(line.axis);
    }
    MassPoint::point(line.point - line.radius / line.sin * line.axis, 1.0)
}
