//! From a biquadratic net back to the cyclide of which it is a patch.
//!
//! The tangent spheres along three iso-curves of one parameter are three points of a conic in R^{3,1}, and three points determine it. This stays
//! stable where the classical way (axes as intersections of circle planes) runs to infinity, on surfaces near a torus.

use crate::determine;
use crate::patch::normalise;
use crate::{CyclidePatch, Dupin, Error, Frame, Kind, Quartic, tolerance};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;
use lorentz::Cycle;
use std::f64::consts::{PI, TAU};

/// A recognised patch: the surface, the parameters of the net's edges, and how well they reproduce it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Conversion {
    /// The surface in canonical form: `mu >= 0` or `k >= 0`, and the frame turned about `x` so that `first` grows.
    pub surface: Dupin,
    /// Whether the rows of the net (`i`) follow the first parameter. If not, the columns do.
    pub rows_follow_first: bool,
    /// First parameter at the start and the end of its direction in the net; growing, and starting in `[0, 2 pi)` on a quartic.
    pub first: [f64; 2],
    /// Second parameter at start and end; it may fall. It starts in `[0, 2 pi)` on a quartic.
    pub second: [f64; 2],
    /// Largest relative difference between the given net and the one rebuilt from these numbers.
    pub residual: f64,
}

impl Conversion {
    /// The type of the surface, decided for recovered numbers.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.surface.kind_within(tolerance::RECOVERED_KIND)
    }

    /// The exact patch with these parameters; its rows follow the first parameter.
    ///
    /// # Errors
    ///
    /// As [`Dupin::patch`].
    pub fn patch(&self) -> Result<CyclidePatch, Error> {
        self.surface.patch(self.first, self.second)
    }
}

/// Iso-curve at which a parameter is read off, and from which it is followed: an interior one, so that no edge through a singular
/// point spoils it.
const READING_LINE: f64 = 0.37;

/// Samples along an iso-curve. Between two neighbours of a patch of nearly a full turn the angle changes by less than half a turn.
const SAMPLES: u32 = 16;

/// Converts a biquadratic net into the cyclide of which it is a patch: quartic, parabolic or double sphere.
///
/// The conversion always ends with a proof: the net is rebuilt from the result and compared with the given one, so PG1 to PG4 and all
/// weights are checked at once.
///
/// # Errors
///
/// [`Error::CornerWeights`]; [`Error::Planar`]; [`Error::ConeOrCylinder`] (limits of cyclides, not quartic ones); [`Error::NoNormal`];
/// [`Error::NotAPatch`] with the condition that fails, if one of PG1 to PG4 or of the weights does; [`Error::NetResidual`] otherwise.
///
/// # Examples
///
/// ```
/// use cyclide::{Dupin, Frame, convert};
/// let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
/// let patch = ring.patch([0.3, 1.7], [0.4, 1.9])?;
/// let found = convert(patch.net())?;
/// assert!(found.residual < 1e-13);
/// assert!((found.first[0] - 0.3).abs() < 1e-12 && (found.second[1] - 1.9).abs() < 1e-12);
/// # Ok::<(), cyclide::Error>(())
/// ```
pub fn convert(net: &Biquadratic<DVec3>) -> Result<Conversion, Error> {
    let scaled = Scaled::new(net)?;
    let mut nearest: Option<Conversion> = None;
    // Where the patch crosses a circle that has shrunk to a singular point the normal changes side, and with it the sign of the
    // radii beyond; ordinary patches pass with the first pattern.
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]] {
        match scaled.convert(signs) {
            Ok(found) if found.residual <= tolerance::REBUILT_NET => {
                return Ok(scaled.in_world(found));
            }
            Ok(found) if nearest.is_none_or(|nearest| found.residual < nearest.residual) => {
                nearest = Some(found)
            }
            Ok(_) => {}
            Err(error @ (Error::Planar | Error::ConeOrCylinder)) if signs == [1.0, 1.0] => {
                return Err(error);
            }
            Err(_) => {}
        }
    }
    // Name the broken condition if there is one.
    if let Ok(report) = crate::inspect(net) {
        report.check()?;
    }
    let residual = nearest.map_or(f64::INFINITY, |nearest| nearest.residual);
    Err(Error::NetResidual {
        residual,
        allowed: tolerance::REBUILT_NET,
    })
}

/// A net about its centre and of size one, corner weights positive.
pub(crate) struct Scaled {
    /// Normalised to `w00 = w02 = w20 = 1`.
    net: Biquadratic<DVec3>,
    centre: DVec3,
    size: f64,
}

impl Scaled {
    pub(crate) fn new(net: &Biquadratic<DVec3>) -> Result<Self, Error> {
        let normalised = normalise(net)?;
        let control = normalised.control();
        let corner = |i: usize, j: usize| control[i][j].weighted / control[i][j].weight;
        let corners = [corner(0, 0), corner(0, 2), corner(2, 0), corner(2, 2)];
        let centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
        // A weighted offset stands in for the distance of a control at infinity.
        let size = control
            .as_flattened()
            .iter()
            .map(|control| (control.weighted - control.weight * centre).length())
            .fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return Err(Error::Planar);
        }
        let local = |control: MassPoint<DVec3>| {
            MassPoint::from_homogeneous(
                control.weight,
                (control.weighted - control.weight * centre) / size,
            )
        };
        Ok(Self {
            net: Biquadratic::new(control.map(|row| row.map(local)))?,
            centre,
            size,
        })
    }

    pub(crate) fn in_world(&self, found: Conversion) -> Conversion {
        Conversion {
            surface: found.surface.scaled(self.size).translated(self.centre),
            ..found
        }
    }

    fn convert(&self, signs: [f64; 2]) -> Result<Conversion, Error> {
        let families = [
            self.tangent_spheres(&self.net)?,
            self.tangent_spheres(&self.net.transposed())?,
        ];
        if families.iter().flatten().all(|sphere| sphere.is_plane()) {
            return Err(Error::Planar);
        }
        let mut outcome = Err(Error::Planar);
        for (index, family) in families.iter().enumerate() {
            if family.iter().any(HomogeneousSphere::is_plane) {
                continue;
            }
            let [start, middle, end] = family.map(|sphere| sphere.cycle());
            let spheres = [
                start,
                Cycle::new(middle.centre, middle.radius * signs[0]),
                Cycle::new(end.centre, end.radius * signs[1]),
            ];
            match determine::through(spheres) {
                Ok(found) => {
                    // Rows are iso-curves u = const, so their spheres touch along circles of the family that the rows follow.
                    outcome = Ok((found.surface, found.is_first_family == (index == 0)));
                    // The family of the ellipse keeps its digits always, that of the hyperbola not near a plane.
                    if found.is_first_family {
                        break;
                    }
                }
                Err(Error::NotDetermined { .. }) if spheres_agree(&spheres) => {
                    return self.sphere(start);
                }
                Err(Error::ConeOrCylinder) => return Err(Error::ConeOrCylinder),
                Err(error) => outcome = outcome.or(Err(error)),
            }
        }
        let (surface, rows_follow_first) = outcome?;
        self.read_off(surface, rows_follow_first)
    }

    /// The spheres that touch along the iso-curves `u = 0, 1/2, 1`.
    fn tangent_spheres(&self, net: &Biquadratic<DVec3>) -> Result<[HomogeneousSphere; 3], Error> {
        let flipped = !std::ptr::eq(net, &self.net);
        let at = |u: f64| HomogeneousSphere::along(net, u, flipped);
        Ok([at(0.0)?, at(0.5)?, at(1.0)?])
    }

    pub(crate) const fn net(&self) -> &Biquadratic<DVec3> {
        &self.net
    }

    /// Parameters of the edges on a surface that is known, its frame turned about `x` if the first parameter falls, and the residual of
    /// the rebuilt net.
    pub(crate) fn read_off(
        &self,
        surface: Dupin,
        rows_follow_first: bool,
    ) -> Result<Conversion, Error> {
        let found = self.read_off_in(surface, rows_follow_first)?;
        if found.first[0] < found.first[1] {
            return Ok(found);
        }
        // Half a turn about x changes the sign of both parameters.
        self.read_off_in(
            surface.in_frame(surface.frame().turned_about_x()),
            rows_follow_first,
        )
    }

    /// The same in the frame that the surface has.
    pub(crate) fn read_off_in(
        &self,
        surface: Dupin,
        rows_follow_first: bool,
    ) -> Result<Conversion, Error> {
        let net = if rows_follow_first {
            self.net
        } else {
            self.net.transposed()
        };
        let along_first = |t: f64| {
            net.point(t, READING_LINE)
                .map(|point| surface.parameters_at(point))
        };
        let along_second = |t: f64| {
            net.point(READING_LINE, t)
                .map(|point| surface.parameters_at(point))
        };
        let (first, second) = match &surface {
            Dupin::Parabolic(_) => (
                [along_first(0.0)?[0], along_first(1.0)?[0]],
                [along_second(0.0)?[1], along_second(1.0)?[1]],
            ),
            Dupin::Quartic(quartic) => (
                follow(quartic, along_first, 0)?,
                follow(quartic, along_second, 1)?,
            ),
        };
        let (first, second) = match surface {
            Dupin::Quartic(_) => (reduced(first), reduced(second)),
            Dupin::Parabolic(_) => (first, second),
        };
        let residual = self.residual(&surface, rows_follow_first, first, second)?;
        Ok(Conversion {
            surface,
            rows_follow_first,
            first,
            second,
            residual,
        })
    }

    /// Largest difference between the normalised nets, relative to their largest entry.
    fn residual(
        &self,
        surface: &Dupin,
        rows_follow_first: bool,
        first: [f64; 2],
        second: [f64; 2],
    ) -> Result<f64, Error> {
        let patch = surface.patch(first, second)?;
        let net = if rows_follow_first {
            *patch.net()
        } else {
            patch.net().transposed()
        };
        let rebuilt = normalise(&net)?;
        let given = self.net.control().as_flattened();
        let mut largest = 1.0_f64;
        let mut difference = 0.0_f64;
        for (given, rebuilt) in given.iter().zip(rebuilt.control().as_flattened()) {
            largest = largest
                .max(given.weight.abs())
                .max(given.weighted.abs().max_element());
            difference = difference
                .max((given.weight - rebuilt.weight).abs())
                .max((given.weighted - rebuilt.weighted).abs().max_element());
        }
        Ok(difference / largest)
    }

    /// A patch of a sphere: the eccentricity and the frame of its orthogonal net of circles come from the planes of its iso-curves.
    fn sphere(&self, sphere: Cycle) -> Result<Conversion, Error> {
        let radius = sphere.radius.abs();
        let rows = self.pencil_axis(&self.net, sphere.centre, radius);
        let columns = self.pencil_axis(&self.net.transposed(), sphere.centre, radius);
        // The planes of theta = const meet in a line that cuts the sphere; those of psi = const outside, or are parallel.
        let (axis, rows_follow_first) = match (rows, columns) {
            (Some(rows), Some(columns)) if columns.foot.length() < rows.foot.length() => {
                (columns, false)
            }
            (Some(rows), _) => (rows, true),
            (None, Some(columns)) => (columns, false),
            (None, None) => {
                return Err(Error::NotDetermined {
                    reason: "the iso-curves lie in parallel planes",
                });
            }
        };
        let e = axis.foot.length() / radius;
        let z = axis.direction;
        let x = if e <= tolerance::TANGENT_SPHERES {
            z.any_orthonormal_vector()
        } else {
            axis.foot
        };
        let e = if e <= tolerance::TANGENT_SPHERES {
            0.0
        } else {
            e
        };
        let frame =
            Frame::from_directions(sphere.centre, x, z.cross(x)).ok_or(Error::NotDetermined {
                reason: "the net collapses",
            })?;
        self.read_off(
            Quartic::double_sphere(radius, e, frame)?.into(),
            rows_follow_first,
        )
    }

    /// The line common to the planes of the iso-curves `u = 0` and `u = 1`, about the centre of a sphere.
    fn pencil_axis(
        &self,
        net: &Biquadratic<DVec3>,
        centre: DVec3,
        radius: f64,
    ) -> Option<PencilAxis> {
        let plane = |u: f64| -> Option<(DVec3, f64)> {
            let [p, q, r] = [0.0, 0.5, 1.0].map(|v| net.point(u, v).ok());
            let (p, q, r) = (p? - centre, q? - centre, r? - centre);
            let normal = (q - p).cross(r - p).try_normalize()?;
            Some((normal, normal.dot(p)))
        };
        let (first, second) = (plane(0.0)?, plane(1.0)?);
        let cross = first.0.cross(second.0);
        if cross.length() <= tolerance::TANGENT_SPHERES {
            return None;
        }
        let foot = (first.1 * second.0.cross(cross) - second.1 * first.0.cross(cross))
            / cross.length_squared();
        (foot.length() < radius).then_some(PencilAxis {
            foot,
            direction: cross.normalize(),
        })
    }
}

/// The axis of a pencil of planes, seen from the centre of a sphere: its foot and its direction.
#[derive(Clone, Copy)]
struct PencilAxis {
    foot: DVec3,
    direction: DVec3,
}

fn spheres_agree(spheres: &[Cycle; 3]) -> bool {
    let [start, ..] = spheres;
    let scale = start.centre.length().max(start.radius.abs()).max(1.0);
    spheres.iter().all(|sphere| {
        let step = *sphere - *start;
        step.centre.length().hypot(step.radius) <= 10.0 * tolerance::TANGENT_SPHERES * scale
    })
}

/// A sphere or plane that touches the patch along an iso-curve: weight, weighted centre and weighted radius.
#[derive(Clone, Copy)]
struct HomogeneousSphere {
    weight: f64,
    centre: DVec3,
    radius: f64,
}

impl HomogeneousSphere {
    /// From one point of the iso-curve with its normal, and the chord to another.
    fn along(net: &Biquadratic<DVec3>, u: f64, flipped: bool) -> Result<Self, Error> {
        // The next start is tried where the patch has no normal, at a singular corner.
        for start in [0.0, 0.5, 1.0] {
            let jet = net.jet(u, start);
            let Some(point) = jet.value.position() else {
                continue;
            };
            let along = |partial: MassPoint<DVec3>| {
                (partial.weighted - partial.weight * point) / jet.value.weight
            };
            let (along_u, along_v) = (along(jet.du), along(jet.dv));
            let cross = if flipped {
                along_v.cross(along_u)
            } else {
                along_u.cross(along_v)
            };
            if cross.length() <= tolerance::TANGENT_SPHERES * along_u.length() * along_v.length() {
                continue;
            }
            let Some(normal) = cross.try_normalize() else {
                continue;
            };
            let chord = [0.0, 0.5, 1.0]
                .into_iter()
                .filter_map(|v| net.point(u, v).ok())
                .map(|other| other - point)
                .max_by(|one, other| one.length_squared().total_cmp(&other.length_squared()))
                .unwrap_or_default();
            let square = chord.length_squared();
            let weight = normal.dot(chord);
            return Ok(Self {
                weight,
                centre: weight * point + 0.5 * square * normal,
                radius: -0.5 * square,
            });
        }
        Err(Error::NoNormal { u, v: 0.0 })
    }

    fn is_plane(&self) -> bool {
        // The weight is the sine of the angle between chord and tangent plane, times the chord.
        self.weight.abs() <= tolerance::TANGENT_SPHERES * (2.0 * self.radius.abs()).sqrt()
    }

    fn cycle(&self) -> Cycle {
        Cycle::new(self.centre / self.weight, self.radius / self.weight)
    }
}

/// A parameter along an iso-curve, from its start to its end, followed by continuity.
fn follow(
    surface: &Quartic,
    parameters: impl Fn(f64) -> Result<[f64; 2], bezier_mass::Error>,
    which: usize,
) -> Result<[f64; 2], Error> {
    let doubled = surface.a() == 0.0;
    let mut at = parameters(0.0)?;
    let start = at[which];
    for step in 1..=SAMPLES {
        let next = parameters(f64::from(step) / f64::from(SAMPLES))?;
        // On the double sphere (theta, psi) and (theta + pi, pi - psi) are one point.
        let other = [next[0] + PI, PI - next[1]];
        let [near, far] = [next, other].map(|candidate| {
            [
                nearest_turn(candidate[0], at[0]),
                nearest_turn(candidate[1], at[1]),
            ]
        });
        let distance =
            |candidate: [f64; 2]| (candidate[0] - at[0]).abs() + (candidate[1] - at[1]).abs();
        at = if doubled && distance(far) < distance(near) {
            far
        } else {
            near
        };
    }
    Ok([start, at[which]])
}

/// The angle equal to `angle` up to full turns that is nearest to `reference`.
fn nearest_turn(angle: f64, reference: f64) -> f64 {
    angle - TAU * ((angle - reference) / TAU).round()
}

/// Both ends shifted by full turns so that the first lies in `[0, 2 pi)`; one that the recovery left below zero is zero.
fn reduced([from, to]: [f64; 2]) -> [f64; 2] {
    let turns = ((from + tolerance::RECOVERED_KIND) / TAU).floor();
    [(from - turns * TAU).max(0.0), to - turns * TAU]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_just_below_a_full_turn_is_zero() {
        assert_eq!(reduced([-1e-15, 2.0]), [0.0, 2.0]);
        assert_eq!(reduced([TAU - 1e-12, TAU + 2.0]), [0.0, 2.0]);
        assert_eq!(reduced([TAU, 1.0]), [0.0, 1.0 - TAU]);
        assert_eq!(reduced([-1.0, -2.0]), [TAU - 1.0, TAU - 2.0]);
        assert_eq!(reduced([1e-15, -2.0]), [1e-15, -2.0]);
    }
}
