use bezier_mass::{Quadratic, VectorSpace};
use glam::DVec3;

use crate::{
    CanalCurve, CharacteristicCircle, Error, LorentzVector, Point, SphereCurve, SphereMassPoint,
    lie_product,
};

/// The second family of spheres of a Dupin cyclide: all spheres that touch every sphere of a canal curve.
///
/// In the space of 6-vectors with the Lie form they span the orthogonal complement of the curve's controls, so the two
/// conics lie in two orthogonal planes of the space of spheres. A circle of the surface and its opposite give a member:
/// [`member`](Self::member). The second family of a cone or a cylinder around spheres is its tangent planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondFamily {
    own: CanalCurve,
}

impl CanalCurve {
    /// The spheres that touch all spheres of this family.
    #[must_use]
    pub const fn second_family(&self) -> SecondFamily {
        SecondFamily { own: *self }
    }
}

impl SecondFamily {
    /// The Lie-orthogonal projection of a 6-vector on the span of the second family.
    #[must_use]
    pub fn project(&self, h: SphereMassPoint) -> SphereMassPoint {
        let [b0, b1, b2] = *self.own.control();
        let k = self.own.curve().envelope_invariant();
        let (h0, h1, h2) = (lie_product(b0, h), lie_product(b1, h), lie_product(b2, h));
        h - b1 * (h1 / k) + b0 * (0.5 * h2 / k) + b2 * (0.5 * h0 / k)
    }

    /// The matrix of [`project`](Self::project), row by row, acting on columns `[w, xo, x1, x2, x3, xinf]`.
    #[must_use]
    pub fn projector(&self) -> [[f64; 6]; 6] {
        let mut matrix = [[0.0; 6]; 6];
        for column in 0..6 {
            let mut unit = [0.0; 6];
            if let Some(entry) = unit.get_mut(column) {
                *entry = 1.0;
            }
            for (row, value) in matrix
                .iter_mut()
                .zip(coordinates(self.project(from_coordinates(unit))))
            {
                if let Some(entry) = row.get_mut(column) {
                    *entry = value;
                }
            }
        }
        matrix
    }

    /// The member that touches the first family's sphere at `t` in the point `x` of its characteristic circle.
    ///
    /// A 6-vector of any scale; its weight is zero if the member is a point (where all spheres of the first family pass).
    #[must_use]
    pub fn member(&self, t: f64, x: Point) -> SphereMassPoint {
        // The members that touch at x with the same normal are [0, p] + lambda b(t). Orthogonality to b(s) gives
        // lambda, as <b(t), b(s)> = -2 K (t - s)^2; the farther end s is the safer one.
        let (s, far) = if t < 0.5 {
            (1.0, self.own.control()[2])
        } else {
            (0.0, self.own.control()[0])
        };
        let p = x.vector();
        let k = self.own.curve().envelope_invariant();
        let lambda = p.product(far.weighted) / (2.0 * k * (t - s) * (t - s));
        SphereMassPoint::vector(p) + self.own.curve().quadratic().at(t) * lambda
    }

    /// The arc of the second conic from member `start` to member `end` through member `between` (of any scales).
    ///
    /// # Errors
    /// [`Error::DegenerateControls`] if two of the three are the same; [`Error::NonFinite`].
    pub fn arc(
        &self,
        start: SphereMassPoint,
        between: SphereMassPoint,
        end: SphereMassPoint,
    ) -> Result<CanalCurve, Error> {
        let unit = |h: SphereMassPoint| h * (1.0 / h.magnitude().max(f64::MIN_POSITIVE));
        let (e0, h, mut e2) = (unit(start), unit(between), unit(end));
        let mut ends = lie_product(e0, e2);
        if ends > 0.0 {
            (e2, ends) = (-e2, -ends);
        }
        // h = a e0 + b e2 + (the part along the middle control), with a b > 0 on the quadric.
        let (a, b) = (lie_product(h, e2) / ends, lie_product(h, e0) / ends);
        let middle = h - e0 * a - e2 * b;
        let scale = 0.5 / (a * b).abs().sqrt();
        let middle = middle * scale.copysign(a);
        if !(middle.is_finite() && scale.is_finite()) {
            return Err(Error::DegenerateControls);
        }
        SphereCurve::from_quadratic(Quadratic::new([e0, middle, e2])?)?.canal()
    }

    /// Half of the second conic; [`CanalCurve::complement`] gives the other half.
    ///
    /// It runs over the half turn of angles 0 to pi of the best circle of the first family, from the reference direction
    /// [`CanalCurve::reference`].
    ///
    /// # Errors
    /// [`Error::DegenerateControls`] if rounding leaves no second conic.
    pub fn conic(&self) -> Result<CanalCurve, Error> {
        let (t, [start, between, end]) = self.best_circle()?;
        self.arc(
            self.member(t, start),
            self.member(t, between),
            self.member(t, end),
        )
    }

    /// A parameter whose circle is neither a point nor close to one, with three of its points.
    fn best_circle(&self) -> Result<(f64, [Point; 3]), Error> {
        const CANDIDATES: [f64; 5] = [0.0, 0.5, 1.0, 0.25, 0.75];
        let quality = |t: f64| {
            let member = self.own.at(t);
            member.weight().abs() / (member.value().magnitude() + f64::MIN_POSITIVE)
        };
        let t = CANDIDATES.into_iter().fold(
            0.0,
            |best, t| if quality(t) > quality(best) { t } else { best },
        );
        Ok((t, self.three_points(t)?))
    }

    fn three_points(&self, t: f64) -> Result<[Point; 3], Error> {
        let points = match self.own.at(t).circle()? {
            CharacteristicCircle::Circle(circle) => {
                let (u, v) = circle.frame(self.own.reference())?;
                [u, v, -u].map(|direction| circle.centre() + circle.radius() * direction)
            }
            CharacteristicCircle::Line(line) => {
                let step = line.nearest_to_origin().length().max(1.0) * line.direction();
                [-step, DVec3::ZERO, step].map(|step| line.nearest_to_origin() + step)
            }
        };
        let [start, between, end] = points.map(Point::new);
        Ok([start?, between?, end?])
    }
}

/// The coordinates `[w, xo, x1, x2, x3, xinf]` of a 6-vector.
const fn coordinates(h: SphereMassPoint) -> [f64; 6] {
    let x = h.weighted;
    [h.weight, x.o, x.v.x, x.v.y, x.v.z, x.inf]
}

const fn from_coordinates([w, o, x, y, z, inf]: [f64; 6]) -> SphereMassPoint {
    SphereMassPoint::from_homogeneous(w, LorentzVector::from_null([o, x, y, z, inf]))
}
