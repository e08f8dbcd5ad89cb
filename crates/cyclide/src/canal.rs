//! The two conics of a cyclide on the space of spheres, as curves of the crate `lorentz`, and back.

use crate::patch::{Row, arc_rows, line_rows};
use crate::{Determined, Dupin, Error, Frame, Parabolic, Quartic};
use bezier_mass::MassPoint;
use glam::DVec3;
use lorentz::{CanalCurve, Cycle, LorentzVector, SphereMassPoint};

impl Dupin {
    /// The canal curve of the spheres that touch along the circles of the first family (constant `theta` or `u`) over a span of it.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::Span`]; [`Error::Lorentz`] where the curve degenerates (a double sphere).
    pub fn first_canal(&self, span: [f64; 2]) -> Result<CanalCurve, Error> {
        let controls = match self {
            Self::Quartic(surface) => arc_rows(span)?.map(|row| surface.first_control(row)),
            Self::Parabolic(surface) => line_rows(span)?.map(|row| surface.first_control(row)),
        };
        self.canal(controls)
    }

    /// The canal curve of the spheres that touch along the circles of the second family (constant `psi` or `v`) over a span of it. Where a
    /// sphere is a plane the curve goes on.
    ///
    /// # Errors
    ///
    /// As [`Dupin::first_canal`].
    ///
    /// # Examples
    ///
    /// ```
    /// use cyclide::{Dupin, Frame};
    /// let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
    /// let canal = ring.second_canal([0.5, 2.5])?; // through a plane
    /// assert!(lorentz::Classification::of(*canal.control()).is_ok());
    /// let found = Dupin::from_canal(&canal)?;
    /// assert!((found.surface.as_quartic().expect("a quartic").mu() - 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn second_canal(&self, span: [f64; 2]) -> Result<CanalCurve, Error> {
        let controls = match self {
            Self::Quartic(surface) => arc_rows(span)?.map(|row| surface.second_control(row)),
            Self::Parabolic(surface) => line_rows(span)?.map(|row| surface.second_control(row)),
        };
        self.canal(controls)
    }

    fn canal(&self, local: [SphereMassPoint; 3]) -> Result<CanalCurve, Error> {
        Ok(CanalCurve::new(
            local.map(|control| in_world(self.frame(), control)),
        )?)
    }

    /// The cyclide of which the envelope of a canal curve is a piece.
    ///
    /// # Errors
    ///
    /// As [`Dupin::from_tangent_spheres`]; a cone or a cylinder is [`Error::ConeOrCylinder`].
    pub fn from_canal(canal: &CanalCurve) -> Result<Determined, Error> {
        // Of nine members the three best that are spheres: the ends and the middle of those that are far from planes.
        let quadratic = canal.curve().quadratic();
        let all: Vec<SphereMassPoint> = (0..=8)
            .map(|step| quadratic.at(f64::from(step) / 8.0))
            .collect();
        let members: Vec<Cycle> = far_from_planes(&all)
            .map(|member| {
                Cycle::new(
                    member.weighted.v / member.weighted.o,
                    member.weight / member.weighted.o,
                )
            })
            .collect();
        match members.as_slice() {
            [first, .., last] if members.len() > 2 => {
                let middle = members.get(members.len() / 2).copied().unwrap_or(*first);
                Self::from_tangent_spheres([*first, middle, *last])
            }
            _ => Err(Error::NotDetermined {
                reason: "nearly all members of the canal curve are planes",
            }),
        }
    }
}

/// The members that are clearly spheres, seen from the one with the largest weight and in units of the curve: neither where the curve stands
/// nor its unit of length plays a part.
fn far_from_planes(members: &[SphereMassPoint]) -> impl Iterator<Item = SphereMassPoint> {
    let largest =
        |value: &dyn Fn(&SphereMassPoint) -> f64| members.iter().map(value).fold(0.0, f64::max);
    let weight = largest(&|member| member.weighted.o.abs());
    let centre = members
        .iter()
        .find(|member| member.weighted.o.abs() == weight)
        .map_or(DVec3::ZERO, |member| member.weighted.v / member.weighted.o);
    let reach = move |member: &SphereMassPoint| {
        let offset = member.weighted.v - member.weighted.o * centre;
        offset.length().max(member.weight.abs())
    };
    let size = largest(&reach) / weight;
    members
        .iter()
        .copied()
        .filter(move |member| member.weighted.o.abs() * size > 1e-3 * reach(member))
}

/// A mass point of the space of spheres from the weight that multiplies everything, the weighted centre, the weighted radius, and the weighted
/// `|centre|² - radius²`.
fn control(weight: f64, centre: DVec3, radius: f64, power: f64) -> SphereMassPoint {
    MassPoint::from_homogeneous(radius, LorentzVector::new(weight, centre, 0.5 * power))
}

fn in_world(frame: &Frame, local: SphereMassPoint) -> SphereMassPoint {
    let LorentzVector { o, v, inf } = local.weighted;
    let (origin, turned) = (frame.origin(), frame.vector_to_world(v));
    let moved = LorentzVector::new(
        o,
        turned + o * origin,
        inf + origin.dot(turned) + 0.5 * o * origin.length_squared(),
    );
    MassPoint::from_homogeneous(local.weight, moved)
}

impl Quartic {
    fn first_control(&self, [one, cos, sin]: Row) -> SphereMassPoint {
        let (a, b, c, mu) = (self.a(), self.b(), self.c(), self.mu());
        control(
            one,
            DVec3::new(a * cos, b * sin, 0.0),
            mu * one - c * cos,
            (b - mu) * (b + mu) * one + 2.0 * mu * c * cos,
        )
    }

    fn second_control(&self, [one, cos, sin]: Row) -> SphereMassPoint {
        let (a, b, c, mu) = (self.a(), self.b(), self.c(), self.mu());
        control(
            cos,
            DVec3::new(c * one, 0.0, -b * sin),
            mu * cos - a * one,
            -(b * b + mu * mu) * cos + 2.0 * mu * a * one,
        )
    }
}

impl Parabolic {
    fn first_control(&self, [one, u, uu]: Row) -> SphereMassPoint {
        let (f, k) = (self.f(), self.k());
        let radius = f * (uu + 0.5 * one) + k * one;
        let power = 2.0 * f * f * uu - 2.0 * k * f * (uu + 0.5 * one) - k * k * one;
        control(
            one,
            DVec3::new(f * (uu - 0.5 * one), 2.0 * f * u, 0.0),
            radius,
            power,
        )
    }

    fn second_control(&self, [one, v, vv]: Row) -> SphereMassPoint {
        let (f, k) = (self.f(), self.k());
        let radius = k * one - f * (vv + 0.5 * one);
        let power = 2.0 * f * f * vv + 2.0 * k * f * (vv + 0.5 * one) - k * k * one;
        control(
            one,
            DVec3::new(f * (0.5 * one - vv), 0.0, 2.0 * f * v),
            radius,
            power,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_of_a_canal_curve_depends_on_neither_unit_nor_place() {
        let far = Frame::WORLD.at(DVec3::new(100.0, 0.0, 0.0));
        for (scale, frame) in [
            (1.0, Frame::WORLD),
            (1e-12, Frame::WORLD),
            (100.0, Frame::WORLD),
            (1e3, Frame::WORLD),
            (1e9, Frame::WORLD),
            (1.0, far),
        ] {
            let ring = Dupin::quartic(3.0 * scale, scale, 2.0 * scale, frame).expect("a ring");
            for canal in [
                ring.first_canal([0.2, 2.0]).expect("spheres"),
                ring.second_canal([0.5, 2.5]).expect("spheres and a plane"),
            ] {
                let found = Dupin::from_canal(&canal).expect("the ring");
                let same = found.surface.as_quartic().expect("a quartic");
                for (one, other) in [(same.a(), 3.0), (same.c(), 1.0), (same.mu(), 2.0)] {
                    assert!((one / scale - other).abs() < 1e-9, "{scale}: {same:?}");
                }
            }
        }
    }
}
