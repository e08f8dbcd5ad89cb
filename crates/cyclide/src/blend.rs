//! One blend: the cyclide that touches two cones at a given member of a family.

use crate::determine::parabolic_from_vertex;
use crate::family::{Conic, Structure};
use crate::spheres::MovingSphere;
use crate::{
    Cone, CurvatureCircle, Dupin, Error, Family, Frame, Kind, Quartic, SphereLine, tolerance,
};
use glam::DVec3;
use lorentz::Cycle;
use std::f64::consts::{PI, TAU};

/// Which lines of curvature of the surface touch the cones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactFamily {
    /// Circles `theta = const` of a quartic.
    Theta,
    /// Circles `psi = const` of a quartic.
    Psi,
    /// Circles `u = const` of a parabolic cyclide.
    U,
    /// Circles `v = const` of a parabolic cyclide.
    V,
}

/// The circle along which the surface touches one of the cones.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact {
    /// The circle, world coordinates; its axis is that of the cone as given.
    pub circle: CurvatureCircle,
    /// The sphere that touches cone and surface along it, oriented like the line of spheres of the family.
    pub sphere: Cycle,
    /// The parameter of the circle on the surface: `theta`, `psi`, `u` or `v`.
    pub parameter: f64,
}

/// A cyclide that touches two cones along one circle each: tangent planes agree all along (G1).
///
/// Made by [`Family::blend`]; how far it is from touching, by rounding, is [`Blend::residual`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(remote = "Self")
)]
pub struct Blend {
    surface: Dupin,
    family: Family,
    parameter: f64,
    contacts: [Contact; 2],
    contact_family: ContactFamily,
    residual: f64,
}

impl Blend {
    /// The surface.
    #[must_use]
    pub const fn surface(&self) -> &Dupin {
        &self.surface
    }

    /// The family it belongs to.
    #[must_use]
    pub const fn family(&self) -> &Family {
        &self.family
    }

    /// Its parameter in the family.
    #[must_use]
    pub const fn parameter(&self) -> f64 {
        self.parameter
    }

    /// The type, decided for numbers that were computed.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.surface.kind_within(tolerance::RECOVERED_KIND)
    }

    /// The circles of contact with the first and the second cone.
    #[must_use]
    pub const fn contacts(&self) -> &[Contact; 2] {
        &self.contacts
    }

    /// Which lines of curvature these are.
    #[must_use]
    pub const fn contact_family(&self) -> ContactFamily {
        self.contact_family
    }

    /// Shene's point `X` on the diagonal; `None` at infinity and for cones on one axis.
    #[must_use]
    pub fn diagonal_point(&self) -> Option<DVec3> {
        if self.family.one_axis {
            None
        } else {
            self.family.diagonal_point_of(self.parameter).position()
        }
    }

    /// The larger of the two G1 residuals against the cones as given: how far, relative to the contact circle, the tangent sphere of the surface is
    /// from those inscribed in the cone, and by what angle (radians) the tangent planes differ. Zero exactly if they agree along both circles.
    /// A contact circle that has shrunk to a singular point has no size; the radii of its surface then stand in, and
    /// [`Blend::is_usable`] is false.
    #[must_use]
    pub const fn residual(&self) -> f64 {
        self.residual
    }

    /// Whether a tube between the two circles can be used: no singular point of the surface lies on a contact circle, and neither circle is one.
    #[must_use]
    pub fn is_usable(&self) -> bool {
        let collapsed = self
            .contacts
            .iter()
            .any(|contact| is_collapsed(&self.surface, self.contact_family, contact.parameter));
        !collapsed
            && match (self.contact_family, self.kind()) {
                (ContactFamily::Theta, kind) => !matches!(
                    kind,
                    Kind::OneSingularitySpindle
                        | Kind::TwoSingularitySpindle
                        | Kind::HornTorus
                        | Kind::SpindleTorus
                ),
                (ContactFamily::Psi, kind) => {
                    !matches!(kind, Kind::SinglyHorned | Kind::DoublyHorned)
                }
                (ContactFamily::U, kind) => kind == Kind::ParabolicRing,
                (ContactFamily::V, _) => true,
            }
    }

    /// Whether both contact circles lie on the same nappes as the common inscribed sphere, so that only one nappe of each cone
    /// is used. For parallel axes: whether both contact spheres have radii of the orientation's sign.
    #[must_use]
    pub fn is_single_nappe(&self) -> bool {
        let [first, second] = self.contacts.map(|contact| contact.sphere.radius);
        match self.family.structure {
            Structure::Meet { sphere, .. } if sphere.radius != 0.0 => {
                first * sphere.radius > 0.0 && second * sphere.radius > 0.0
            }
            // A common vertex or parallel axes: no sphere to compare with, so the nappes of positive radius.
            _ => first > 0.0 && second * f64::from(self.family.orientation) > 0.0,
        }
    }

    /// The principal circles in the axial plane: those that pass through the ends of both contact circles. The second is a line, and
    /// so not given, if the surface is cubic.
    #[must_use]
    pub fn principal_circles(&self) -> [Option<CurvatureCircle>; 2] {
        match (&self.surface, self.contact_family) {
            (Dupin::Quartic(surface), ContactFamily::Theta) => {
                [Some(surface.psi_circle(0.0)), Some(surface.psi_circle(PI))]
            }
            (Dupin::Quartic(surface), _) => [
                Some(surface.theta_circle(0.0)),
                Some(surface.theta_circle(PI)),
            ],
            (Dupin::Parabolic(surface), ContactFamily::U) => [Some(surface.v_circle(0.0)), None],
            (Dupin::Parabolic(surface), _) => [Some(surface.u_circle(0.0)), None],
        }
    }

    /// Measures the blend without the construction: at `samples` points of the surface along each contact circle, the largest distance from
    /// the cone (relative to the contact sphere) and the largest angle between the normals of surface and cone (radians).
    #[must_use]
    pub fn sampled_error(&self, samples: u32) -> (f64, f64) {
        let mut worst = (0.0_f64, 0.0_f64);
        for (contact, line) in self.contacts.iter().zip(&self.family.lines) {
            let radius = contact.sphere.radius;
            for index in 0..samples {
                let turn = (f64::from(index) + 0.5) / f64::from(samples);
                let (first, second) = match self.contact_family {
                    ContactFamily::Theta => (contact.parameter, TAU * turn),
                    ContactFamily::Psi => (TAU * turn, contact.parameter),
                    ContactFamily::U => (contact.parameter, (PI * (turn - 0.5)).tan()),
                    ContactFamily::V => ((PI * (turn - 0.5)).tan(), contact.parameter),
                };
                let (point, normal) = (
                    self.surface.point(first, second),
                    self.surface.normal(first, second),
                );
                // From the foot of the contact sphere: the vertex can be far away.
                let inscribed = line.at(line.foot(contact.sphere.centre));
                let offset = point - inscribed.centre;
                let height = offset.dot(line.axis);
                let across = offset - height * line.axis;
                let cone_normal =
                    line.cos * radius.signum() * across.normalize_or_zero() - line.sin * line.axis;
                let reach = radius.signum() * across.length() * line.cos - height * line.sin;
                let distance = (reach - inscribed.radius).abs() / radius.abs();
                let angle = cone_normal
                    .cross(normal)
                    .length()
                    .atan2(cone_normal.dot(normal).abs());
                worst = (worst.0.max(distance), worst.1.max(angle));
            }
        }
        worst
    }
}

/// The member of a family at a parameter, for finite parameters other than that of the common sphere.
pub(crate) fn member(family: &Family, parameter: f64) -> Result<Blend, Error> {
    let spheres = family.contact_spheres(parameter);
    let (surface, contact_family) = match (family.structure, family.conic) {
        (
            Structure::Meet {
                sphere, pairing, ..
            },
            Conic::Parabola,
        ) => cubic(family, sphere, f64::from(pairing), parameter)?,
        (
            Structure::Meet {
                sphere,
                pairing,
                product,
            },
            conic,
        ) => {
            let pairing = f64::from(pairing);
            let directions = family.lines.map(|line| line.direction());
            let mean = sphere
                + (directions[0] + directions[1] * pairing)
                    * (parameter / (1.0 + pairing * product));
            let b = parameter.abs()
                * ((1.0 - pairing * product) / (1.0 + pairing * product))
                    .abs()
                    .sqrt();
            quartic(family, conic, mean, b, directions)?
        }
        (Structure::Parallel { step, square }, conic) => {
            let mean = (spheres[0] + spheres[1]) * 0.5;
            quartic(
                family,
                conic,
                mean,
                square.abs().sqrt() / 2.0,
                [family.lines[0].direction(), step],
            )?
        }
    };
    let contact = |sphere: Cycle, line: &SphereLine| {
        let parameter = contact_parameter(&surface.dupin, contact_family, sphere, surface.reversed);
        let residual = line_residual(&surface.dupin, contact_family, parameter, line);
        let contact = Contact {
            circle: line.contact_circle(sphere),
            sphere,
            parameter,
        };
        (contact, residual)
    };
    let [first, second] = &family.lines;
    let (first, first_residual) = contact(spheres[0], first);
    let (mut second, second_residual) = contact(spheres[1], second);
    if family.second_turned {
        second.circle.axis = -second.circle.axis;
    }
    let contacts = [first, second];
    let residual = if first_residual.is_nan() || second_residual.is_nan() {
        f64::INFINITY
    } else {
        first_residual.max(second_residual)
    };
    if residual > tolerance::BLEND {
        return Err(Error::NotTangent {
            residual,
            allowed: tolerance::BLEND,
        });
    }
    Ok(Blend {
        surface: surface.dupin,
        family: *family,
        parameter,
        contacts,
        contact_family,
        residual,
    })
}

/// A surface and whether its normals are opposite to the orientation of the family's lines.
struct Oriented {
    dupin: Dupin,
    reversed: bool,
}

/// A quartic from its mean sphere `(O; mu)`, the half axis `b`, and two vectors that span the plane of its conic.
fn quartic(
    family: &Family,
    conic: Conic,
    mean: Cycle,
    b: f64,
    [first, second]: [Cycle; 2],
) -> Result<(Oriented, ContactFamily), Error> {
    let contact_family = if conic == Conic::Ellipse {
        ContactFamily::Theta
    } else {
        ContactFamily::Psi
    };
    let reversed = mean.radius < 0.0;
    let frame_of = |x: DVec3, y: DVec3| {
        Frame::from_directions(mean.centre, x, y).ok_or(Error::Collapsed { parameter: b })
    };
    let done = |surface: Quartic| {
        Ok((
            Oriented {
                dupin: Dupin::Quartic(surface),
                reversed,
            },
            contact_family,
        ))
    };

    if family.one_axis {
        // A torus about the common axis.
        let axis = family.lines[0].axis;
        let x = family.plane_normal.cross(axis);
        return done(Quartic::with_half_axes(
            [b, b, 0.0],
            mean.radius,
            frame_of(x, axis.cross(x))?,
        )?);
    }
    // The direction of the plane without change of radius lies along y (ellipse) or z (hyperbola); the unit vector orthogonal to it
    // is (a x; -c)/b or (c x; -a)/b.
    let level = second.radius * first.centre - first.radius * second.centre;
    let Some(level) = level.try_normalize() else {
        // Two cylinders: all spheres of the conic have one radius, a torus about the normal of the axial plane.
        let x = first.centre;
        return done(Quartic::with_half_axes(
            [b, b, 0.0],
            mean.radius,
            frame_of(x, family.plane_normal.cross(x))?,
        )?);
    };
    let orthogonal = [first, second]
        .map(|vector| {
            Cycle::new(
                vector.centre - vector.centre.dot(level) * level,
                vector.radius,
            )
        })
        .into_iter()
        .max_by(|v, w| norm(*v).total_cmp(&norm(*w)))
        .unwrap_or_default();
    let length = orthogonal.square().abs().sqrt();
    let unit = orthogonal * (if orthogonal.radius > 0.0 { -1.0 } else { 1.0 } / length);
    let along_x = unit.centre.length();
    let surface = match conic {
        Conic::Ellipse => {
            let c = -b * unit.radius;
            Quartic::with_half_axes(
                [c.hypot(b), b, c],
                mean.radius,
                frame_of(unit.centre, level)?,
            )?
        }
        _ => {
            let c = b * along_x;
            // Where c vanishes x is free in the plane orthogonal to the axis z.
            let x = if along_x > tolerance::EXACT_KIND {
                unit.centre
            } else {
                family.plane_normal.cross(level)
            };
            Quartic::with_half_axes(
                [c.hypot(b), b, c],
                mean.radius,
                frame_of(x, level.cross(x))?,
            )?
        }
    };
    done(surface)
}

fn norm(vector: Cycle) -> f64 {
    vector.centre.length_squared() + vector.radius * vector.radius
}

/// The parabolic cyclide of two lines whose directions span a plane with the light-like direction `u1 + pairing u2`.
fn cubic(
    family: &Family,
    sphere: Cycle,
    pairing: f64,
    t: f64,
) -> Result<(Oriented, ContactFamily), Error> {
    let [first, second] = family.lines.map(|line| line.direction());
    let (across, light_like) = (first - second * pairing, first + second * pairing);
    let collapsed = Error::Collapsed { parameter: t };
    let x = (light_like.centre / light_like.radius)
        .try_normalize()
        .ok_or(collapsed)?;
    let slant = across.radius / light_like.radius;
    let ordinate_axis = (across.centre - slant * light_like.centre)
        .try_normalize()
        .ok_or(collapsed)?;
    let vertex = sphere - Cycle::new(ordinate_axis, 0.0) * (t * slant)
        + Cycle::new(x, 1.0) * (t / 4.0 * light_like.radius * (1.0 - slant * slant));
    let (surface, is_first_family, reversed) =
        parabolic_from_vertex(vertex, t / light_like.radius, x, ordinate_axis)?;
    let contact_family = if is_first_family {
        ContactFamily::U
    } else {
        ContactFamily::V
    };
    Ok((
        Oriented {
            dupin: Dupin::Parabolic(surface),
            reversed,
        },
        contact_family,
    ))
}

/// The parameter at which a contact sphere sits on the conic of the surface.
fn contact_parameter(
    surface: &Dupin,
    contact_family: ContactFamily,
    sphere: Cycle,
    reversed: bool,
) -> f64 {
    let local = surface.frame().point_to_local(sphere.centre);
    match surface {
        Dupin::Quartic(surface) if contact_family == ContactFamily::Theta => {
            (local.y / surface.b()).atan2(local.x / surface.a())
        }
        Dupin::Quartic(surface) => {
            let radius = if reversed {
                -sphere.radius
            } else {
                sphere.radius
            };
            let branch = (surface.mu() - radius).signum();
            (-local.z / surface.b() * branch).atan2(branch)
        }
        Dupin::Parabolic(surface) => {
            let ordinate = if contact_family == ContactFamily::U {
                local.y
            } else {
                local.z
            };
            ordinate / (2.0 * surface.f())
        }
    }
}

fn moving_sphere(surface: &Dupin, contact_family: ContactFamily, parameter: f64) -> MovingSphere {
    match (surface, contact_family) {
        (Dupin::Quartic(surface), ContactFamily::Theta) => surface.moving_theta_sphere(parameter),
        (Dupin::Quartic(surface), _) => surface.moving_psi_sphere(parameter),
        (Dupin::Parabolic(surface), ContactFamily::U) => surface.moving_u_sphere(parameter),
        (Dupin::Parabolic(surface), _) => surface.moving_v_sphere(parameter),
    }
}

/// G1 along a contact circle is the same as two conditions in R^{3,1}: the tangent sphere of the surface is on the line of spheres of
/// the cone, and it moves along that line. Up to one global orientation.
fn line_residual(
    surface: &Dupin,
    contact_family: ContactFamily,
    parameter: f64,
    line: &SphereLine,
) -> f64 {
    let MovingSphere { sphere, velocity } = moving_sphere(surface, contact_family, parameter);
    let inscribed = line.at(line.foot(sphere.centre));
    let size = if is_collapsed(surface, contact_family, parameter) {
        surface_size(surface)
    } else {
        inscribed.radius.abs() * line.cos
    };
    let position = sphere.centre.distance(inscribed.centre) / size;
    let speed = velocity.centre.length();
    let direction = velocity.centre.cross(line.axis).length() / speed;
    let slope = velocity.centre.dot(line.axis) * line.sin;
    [1.0, -1.0]
        .map(|sign: f64| {
            let radius = (sphere.radius - sign * inscribed.radius).abs() / size;
            // The sine of the half angle changes by its cosine times the angle.
            let angle = (velocity.radius - sign * slope).abs() / (speed * line.cos);
            let parts = [position, radius, direction, angle];
            if parts.iter().any(|part| part.is_nan()) {
                f64::INFINITY
            } else {
                parts.into_iter().fold(0.0, f64::max)
            }
        })
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// The larger of the radii from which the type of a surface is decided.
fn surface_size(surface: &Dupin) -> f64 {
    match surface {
        Dupin::Quartic(surface) => surface.a().max(surface.mu()),
        Dupin::Parabolic(surface) => surface.f().max(surface.k().abs()),
    }
}

/// Whether the circle with this parameter is one of the singular points that the type of the surface, decided for numbers that were computed, has.
fn is_collapsed(surface: &Dupin, contact_family: ContactFamily, parameter: f64) -> bool {
    // The radius of the tangent sphere; for psi times cos psi, for which it is finite.
    let radius = match (surface, contact_family) {
        (Dupin::Quartic(surface), ContactFamily::Theta) => {
            surface.mu() - surface.c() * parameter.cos()
        }
        (Dupin::Quartic(surface), _) => surface.mu() * parameter.cos() - surface.a(),
        (Dupin::Parabolic(surface), ContactFamily::U) => surface.u_radius(parameter),
        (Dupin::Parabolic(surface), _) => surface.v_radius(parameter),
    };
    let kind = surface.kind_within(tolerance::RECOVERED_KIND);
    let can_collapse = match contact_family {
        ContactFamily::Theta => matches!(kind, Kind::SinglyHorned | Kind::DoublyHorned),
        ContactFamily::Psi => matches!(
            kind,
            Kind::OneSingularitySpindle
                | Kind::TwoSingularitySpindle
                | Kind::HornTorus
                | Kind::SpindleTorus
        ),
        ContactFamily::U | ContactFamily::V => kind != Kind::ParabolicRing,
    };
    can_collapse && radius.abs() <= tolerance::RECOVERED_KIND * surface_size(surface)
}

/// The G1 residual of a surface along a circle `parameter` of one of its families against a given cone, as [`Blend::residual`].
/// For checking blends that were made elsewhere. Infinite where it is not defined.
#[must_use]
pub fn contact_residual(
    surface: &Dupin,
    contact_family: ContactFamily,
    parameter: f64,
    cone: &Cone,
) -> f64 {
    line_residual(surface, contact_family, parameter, &cone.spheres())
}
