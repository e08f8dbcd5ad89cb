//! Cyclides from what determines them: three tangent spheres of one family, principal circles, a curve on the space of spheres.

use crate::frame::{length, place};
use crate::{CurvatureCircle, Dupin, Error, Frame, Parabolic, Quartic, tolerance};
use glam::DVec3;
use lorentz::Cycle;

/// A surface, and the family to which the spheres that determined it belong.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Determined {
    /// The surface, in its normal form (`mu >= 0`, `k >= 0`).
    pub surface: Dupin,
    /// Whether the spheres touch along circles of the first family (`theta` or `u` constant).
    pub is_first_family: bool,
    /// Whether the surface's normals are opposite to those of the given oriented spheres.
    pub is_reversed: bool,
}

impl Dupin {
    /// The cyclide that three oriented spheres of one family touch along circles: their conic is the section of the hyperboloid
    /// (paraboloid) of all its tangent spheres by their plane in R^{3,1}.
    ///
    /// # Errors
    ///
    /// [`Error::NotFinite`]; [`Error::LengthOutOfRange`] for the spheres or the surface; [`Error::NotDetermined`] if two of the spheres are equal
    /// or one touches another from inside; [`Error::ConeOrCylinder`] if the three are inscribed in one cone.
    ///
    /// # Examples
    ///
    /// ```
    /// use cyclide::{Dupin, Frame};
    /// let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
    /// let found = Dupin::from_tangent_spheres([0.1, 1.0, 3.0].map(|psi| ring.second_sphere(psi)))?;
    /// let same = found.surface.as_quartic().expect("no parabola here");
    /// assert!((same.a() - 3.0).abs() < 1e-12 && (same.c() - 1.0).abs() < 1e-12 && (same.mu() - 2.0).abs() < 1e-12);
    /// assert!(!found.is_first_family);
    /// # Ok::<(), cyclide::Error>(())
    /// ```
    pub fn from_tangent_spheres(spheres: [Cycle; 3]) -> Result<Determined, Error> {
        for sphere in spheres {
            place("sphere centre", sphere.centre)?;
            length("sphere radius", sphere.radius)?;
        }
        let [origin, ..] = spheres;
        // About the first centre, in units of the largest distance: all tolerances are then plain numbers.
        let size = spheres.iter().fold(0.0_f64, |size, sphere| {
            size.max(sphere.centre.distance(origin.centre))
                .max(sphere.radius.abs())
        });
        if size <= 0.0 {
            return Err(Error::NotDetermined {
                reason: "the spheres are one point",
            });
        }
        let found = through(
            spheres.map(|sphere| (sphere - Cycle::new(origin.centre, 0.0)) * (1.0 / size)),
        )?;
        Ok(Determined {
            surface: found.surface.placed(size, origin.centre)?,
            ..found
        })
    }

    /// The cyclide with two principal circles in one plane, chosen among the two possible ones by two circles of this plane
    /// that touch both (Shene, Lemma 11). The tangent circles are great circles of tangent spheres.
    ///
    /// # Errors
    ///
    /// [`Error::NotDetermined`] if the circles are not in one plane, a tangent circle does not touch, or the two belong to different cyclides.
    pub fn from_principal_circles(
        principal: [CurvatureCircle; 2],
        tangent: [CurvatureCircle; 2],
    ) -> Result<Self, Error> {
        let [first, second] = principal;
        let size = first
            .radius
            .max(second.radius)
            .max(first.centre.distance(second.centre));
        for circle in [second, tangent[0], tangent[1]] {
            let height = (circle.centre - first.centre).dot(first.axis).abs();
            if !(height <= tolerance::NET * size
                && circle.axis.cross(first.axis).length() <= tolerance::NET)
            {
                return Err(Error::NotDetermined {
                    reason: "the circles are not in one plane",
                });
            }
        }
        // The radius of a principal circle with the sign that makes centre + radius * normal a common point with the tangent sphere.
        let radii_for = |tangent: &CurvatureCircle| {
            principal.map(|circle| {
                let distance = circle.centre.distance(tangent.centre);
                [1.0, -1.0]
                    .map(|sign| sign * circle.radius)
                    .into_iter()
                    .find(|radius| {
                        ((radius - tangent.radius).abs() - distance).abs()
                            <= tolerance::NET * size.max(tangent.radius)
                    })
            })
        };
        let ([Some(one), Some(other)], [Some(one_again), Some(other_again)]) =
            (radii_for(&tangent[0]), radii_for(&tangent[1]))
        else {
            return Err(Error::NotDetermined {
                reason: "a tangent circle does not touch both principal circles",
            });
        };
        if one * other * one_again * other_again < 0.0 {
            return Err(Error::NotDetermined {
                reason: "the tangent circles belong to different cyclides",
            });
        }
        let step = second.centre - first.centre;
        // Concentric circles belong to a torus, whose x is free.
        let step = if step.length() <= tolerance::EXACT_KIND * size {
            DVec3::ZERO
        } else {
            step
        };
        let (half_step, half_difference, mean) = (
            0.5 * step.length(),
            0.5 * (other - one),
            0.5 * (one + other),
        );
        let centre = 0.5 * (first.centre + second.centre);
        let across = first.axis;
        // x points to the centre of the smaller signed radius; the plane is z = 0 for the circles psi = const, y = 0 for theta = const.
        let towards = if half_difference >= 0.0 { -step } else { step };
        let towards = towards
            .try_normalize()
            .unwrap_or_else(|| across.any_orthonormal_vector());
        let in_plane = across.cross(towards);
        let frame = |y: DVec3| {
            Frame::from_directions(centre, towards, y).ok_or(Error::NotDetermined {
                reason: "the principal circles collapse",
            })
        };
        let half_difference = half_difference.abs();
        let b = ((half_step - half_difference) * (half_step + half_difference))
            .abs()
            .sqrt();
        if b <= tolerance::NET * size {
            return Err(Error::NotDetermined {
                reason: "the principal circles touch each other: two spheres or a parabola",
            });
        }
        Ok(Self::Quartic(if half_difference > half_step {
            Quartic::with_half_axes([half_difference, b, half_step], mean, frame(in_plane)?)?
        } else {
            Quartic::with_half_axes([half_step, b, half_difference], mean, frame(across)?)?
        }))
    }

    /// The parabolic cyclide with a principal line (through `point` with `direction`) and a principal circle in one plane with it, chosen by
    /// a circle of this plane that touches both (Shene, Lemma 13).
    ///
    /// # Errors
    ///
    /// [`Error::NotDetermined`] as in [`Dupin::from_principal_circles`].
    pub fn from_principal_line_and_circle(
        point: DVec3,
        direction: DVec3,
        principal: CurvatureCircle,
        tangent: CurvatureCircle,
    ) -> Result<Self, Error> {
        place("point of the principal line", point)?;
        let (direction, _) = crate::frame::direction(direction).ok_or(Error::Direction)?;
        let size = principal
            .radius
            .max(tangent.radius)
            .max(principal.centre.distance(point));
        let off = |v: DVec3| v.dot(principal.axis).abs() > tolerance::NET * size;
        if off(point - principal.centre)
            || off(direction * size)
            || off(tangent.centre - principal.centre)
        {
            return Err(Error::NotDetermined {
                reason: "line and circles are not in one plane",
            });
        }
        let mut normal = principal.axis.cross(direction);
        // The line lies at tangent.centre + radius * normal.
        if (point - tangent.centre).dot(normal) < 0.0 {
            normal = -normal;
        }
        let touches_line =
            ((point - tangent.centre).dot(normal) - tangent.radius).abs() <= tolerance::NET * size;
        let distance = principal.centre.distance(tangent.centre);
        let radius = [1.0, -1.0]
            .map(|sign| sign * principal.radius)
            .into_iter()
            .find(|radius| {
                touches_line
                    && ((radius - tangent.radius).abs() - distance).abs() <= tolerance::NET * size
            });
        let Some(radius) = radius else {
            return Err(Error::NotDetermined {
                reason: "the tangent circle does not touch both the principal line and the principal circle",
            });
        };
        // The centre (f/2, 0, 0) of the principal circle v = 0, its radius k - f/2, the line x = -(f + k) with normal -x.
        let double = (point - principal.centre).dot(normal) - radius;
        let (f, radius, normal) = if double < 0.0 {
            (-double / 2.0, -radius, -normal)
        } else {
            (double / 2.0, radius, normal)
        };
        let k = radius + f / 2.0;
        let x = -normal;
        let frame =
            Frame::from_directions(principal.centre - x * (f / 2.0), x, principal.axis.cross(x))
                .ok_or(Error::NotDetermined {
                    reason: "the principal line has no direction",
                })?;
        Ok(Self::Parabolic(Parabolic::new(f, k, frame)?.canonical()))
    }

    /// The same shape, larger by a positive factor about the world's origin and then moved by a vector; refused where a constructor would
    /// refuse its lengths.
    pub(crate) fn placed(self, factor: f64, by: DVec3) -> Result<Self, Error> {
        let origin = place("frame origin", self.frame().origin() * factor + by)?;
        let frame = self.frame().at(origin);
        Ok(match self {
            Self::Quartic(surface) => Self::Quartic(surface.scaled_in(factor, frame)?),
            Self::Parabolic(surface) => Self::Parabolic(surface.scaled_in(factor, frame)?),
        })
    }
}

/// The surface of three spheres with centres and radii of the order of one.
pub(crate) fn through(spheres: [Cycle; 3]) -> Result<Determined, Error> {
    let [start, ..] = spheres;
    let steps = [spheres[1] - start, spheres[2] - start];
    let euclid = |v: Cycle, w: Cycle| v.centre.dot(w.centre) + v.radius * w.radius;
    let lengths = steps.map(|step| euclid(step, step).sqrt());
    let scale = spheres.iter().fold(1.0_f64, |scale, sphere| {
        scale.max(sphere.centre.length()).max(sphere.radius.abs())
    });
    if lengths
        .iter()
        .any(|&length| length <= tolerance::TANGENT_SPHERES * scale)
    {
        return Err(Error::NotDetermined {
            reason: "two of the tangent spheres are equal",
        });
    }
    // The part of one step across the other: a difference of squares would lose all digits of a small sine.
    let across = steps[1] - steps[0] * (euclid(steps[0], steps[1]) / euclid(steps[0], steps[0]));
    let rejection = euclid(across, across) * euclid(steps[0], steps[0]);
    if rejection.sqrt() <= tolerance::TANGENT_SPHERES * lengths[0] * lengths[1] {
        return Err(Error::ConeOrCylinder);
    }
    let (g11, g22, g12) = (
        steps[0].square(),
        steps[1].square(),
        steps[0].product(steps[1]),
    );
    let determinant = g11 * g22 - g12 * g12;
    if determinant.abs() <= tolerance::TANGENT_SPHERES * rejection {
        return parabolic(start, steps);
    }
    // The Lorentz circumcentre is (O; mu).
    let (along, other) = (
        g22 * (g11 - g12) / (2.0 * determinant),
        g11 * (g22 - g12) / (2.0 * determinant),
    );
    let to_mean = steps[0] * along + steps[1] * other;
    let mean = start + to_mean;
    let is_first_family = determinant > 0.0;
    let square = to_mean.square() * if is_first_family { 1.0 } else { -1.0 };
    if square.is_nan() || square <= 0.0 {
        return Err(Error::NotDetermined {
            reason: "the spheres have no common tangent circles",
        });
    }
    let b = square.sqrt();
    let is_reversed = mean.radius < 0.0;
    let constant_radius = steps
        .iter()
        .zip(lengths)
        .all(|(step, length)| step.radius.abs() <= tolerance::EXACT_KIND * length);
    // The direction without change of radius, and the unit vector orthogonal to it: (a x; -c)/b or (c x; -a)/b.
    let level = if constant_radius {
        None
    } else {
        (steps[1].centre * steps[0].radius - steps[0].centre * steps[1].radius).try_normalize()
    };
    let frame = |x: DVec3, y: DVec3| {
        Frame::from_directions(mean.centre, x, y).ok_or(Error::NotDetermined {
            reason: "the spheres collapse",
        })
    };
    let Some(level) = level else {
        // A torus, x towards the first sphere, also after the half turn that makes mu positive.
        let x = (start.centre - mean.centre) * if is_reversed { -1.0 } else { 1.0 };
        let z = steps[0].centre.cross(steps[1].centre);
        let surface = Quartic::with_half_axes([b, b, 0.0], mean.radius, frame(x, z.cross(x))?)?;
        return Ok(Determined {
            surface: surface.into(),
            is_first_family,
            is_reversed,
        });
    };
    let flat =
        steps.map(|step| Cycle::new(step.centre - step.centre.dot(level) * level, step.radius));
    let orthogonal = if euclid(flat[0], flat[0]) >= euclid(flat[1], flat[1]) {
        flat[0]
    } else {
        flat[1]
    };
    let unit = orthogonal
        * (if orthogonal.radius > 0.0 { -1.0 } else { 1.0 } / orthogonal.square().abs().sqrt());
    let surface = if is_first_family {
        let c = -b * unit.radius;
        let c = if c <= tolerance::EXACT_KIND * b {
            0.0
        } else {
            c
        };
        Quartic::with_half_axes([c.hypot(b), b, c], mean.radius, frame(unit.centre, level)?)?
    } else {
        let c = b * unit.centre.length();
        let (c, x) = if c <= tolerance::EXACT_KIND * b {
            (0.0, level.any_orthonormal_vector())
        } else {
            (c, unit.centre)
        };
        Quartic::with_half_axes([c.hypot(b), b, c], mean.radius, frame(x, level.cross(x))?)?
    };
    Ok(Determined {
        surface: surface.into(),
        is_first_family,
        is_reversed,
    })
}

/// Spheres whose plane contains one light-like direction: the centres lie on a parabola.
fn parabolic(start: Cycle, steps: [Cycle; 2]) -> Result<Determined, Error> {
    let collapsed = Error::NotDetermined {
        reason: "the spheres collapse",
    };
    let level = (steps[1].centre * steps[0].radius - steps[0].centre * steps[1].radius)
        .try_normalize()
        .ok_or(collapsed)?;
    let flat =
        steps.map(|step| Cycle::new(step.centre - step.centre.dot(level) * level, step.radius));
    let light_like = if flat[0].radius.abs() >= flat[1].radius.abs() {
        flat[0]
    } else {
        flat[1]
    };
    let x = (light_like.centre / light_like.radius)
        .try_normalize()
        .ok_or(collapsed)?;
    // Ordinates along the level direction, abscissas along x: a parabola through the origin.
    let [(y1, x1), (y2, x2)] = steps.map(|step| (step.centre.dot(level), step.centre.dot(x)));
    let curvature = (x2 / y2 - x1 / y1) / (y2 - y1);
    let slope = x1 / y1 - curvature * y1;
    let f = 1.0 / (4.0 * curvature);
    let ordinate = -slope * 2.0 * f;
    let abscissa = ordinate * (slope + curvature * ordinate);
    let vertex = start + Cycle::new(level * ordinate, 0.0) + Cycle::new(x, 1.0) * abscissa;
    if !(f.is_finite() && vertex.is_finite()) {
        return Err(collapsed);
    }
    parabolic_from_vertex(vertex, f, x, level).map(|(surface, is_first_family, is_reversed)| {
        Determined {
            surface: surface.into(),
            is_first_family,
            is_reversed,
        }
    })
}

/// The parabolic cyclide whose tangent spheres of one family have the given vertex sphere, focal parameter (negative if they open
/// against the growth of the radius), axis `x`, and ordinates along `level`. With it, whether this is the family of `u`, and whether the
/// surface's normals are opposite.
pub(crate) fn parabolic_from_vertex(
    vertex: Cycle,
    f: f64,
    x: DVec3,
    level: DVec3,
) -> Result<(Parabolic, bool, bool), Error> {
    // From the vertex sphere (-f/2; f/2 + k) of one parabola or (|f|/2; k - |f|/2) of the other.
    let (origin, k) = (vertex.centre + x * (f / 2.0), vertex.radius - f / 2.0);
    let is_reversed = k < 0.0;
    // Reversing x exchanges the two parabolas.
    let x = if is_reversed { -x } else { x };
    let is_first_family = (f > 0.0) != is_reversed;
    let y = if is_first_family {
        level
    } else {
        level.cross(x)
    };
    let frame = Frame::from_directions(origin, x, y).ok_or(Error::NotDetermined {
        reason: "the spheres collapse",
    })?;
    Ok((
        Parabolic::new(f.abs(), k.abs(), frame)?,
        is_first_family,
        is_reversed,
    ))
}
