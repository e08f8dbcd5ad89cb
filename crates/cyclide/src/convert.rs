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
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "ConversionData")
)]
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

/// Iso-curves at which the parameters are read off: interior ones, so that no edge through a singular point spoils them. The second is for
/// a double sphere of which the first runs through a pole.
const READING_LINES: [f64; 2] = [0.37, 0.61];

/// Places along an iso-curve of which the one best between its ends tells the direction of the parameter.
const SAMPLES: u32 = 16;

/// Where an iso-curve is taken for one that has shrunk to a singular point: further inside, at the start, in the middle and at the end.
pub(crate) const INSTEAD: [[f64; 3]; 3] = [[0.0, 0.14, 0.23], [0.5, 0.43, 0.61], [1.0, 0.87, 0.79]];

/// Converts a biquadratic net into the cyclide of which it is a patch: quartic, parabolic or double sphere.
///
/// The conversion always ends with a proof: the net is rebuilt from the result and compared with the given one, so PG1 to PG4 and all
/// weights are checked at once.
///
/// # Errors
///
/// [`Error::CornerWeights`]; [`Error::Planar`]; [`Error::ConeOrCylinder`] (limits of cyclides, not quartic ones);
/// [`Error::LengthOutOfRange`] if the surface is larger or smaller than a constructor allows;
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
    let mut is_cone = false;
    // Where the patch crosses a circle that has shrunk to a singular point the normal changes side, and with it the sign of the
    // radii beyond; ordinary patches pass with the first pattern.
    for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]] {
        match scaled.convert(signs) {
            Ok(found) if found.residual <= tolerance::REBUILT_NET => {
                return scaled.in_world(found);
            }
            Ok(found) if nearest.is_none_or(|nearest| found.residual < nearest.residual) => {
                nearest = Some(found)
            }
            Ok(_) => {}
            Err(Error::Planar) if signs == [1.0, 1.0] => return Err(Error::Planar),
            Err(Error::ConeOrCylinder) if signs == [1.0, 1.0] => is_cone = true,
            Err(_) => {}
        }
    }
    if is_cone {
        return Err(Error::ConeOrCylinder);
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

    pub(crate) fn in_world(&self, found: Conversion) -> Result<Conversion, Error> {
        Ok(Conversion {
            surface: found.surface.placed(self.size, self.centre)?,
            ..found
        })
    }

    fn convert(&self, signs: [f64; 2]) -> Result<Conversion, Error> {
        let families = [
            self.tangent_spheres(&self.net)?,
            self.tangent_spheres(&self.net.transposed())?,
        ];
        if families.iter().flatten().all(|sphere| sphere.is_plane()) {
            return Err(Error::Planar);
        }
        // Beyond a pole the normals of a sphere's net are reversed: the sign of a radius says nothing here.
        for family in &families {
            if family.iter().any(HomogeneousSphere::is_plane) {
                continue;
            }
            let spheres = family.map(|sphere| {
                let Cycle { centre, radius } = sphere.cycle();
                Cycle::new(centre, radius.abs())
            });
            if !spheres_agree(&spheres, NEARLY_ONE_SPHERE) {
                continue;
            }
            let agree = spheres_agree(&spheres, 10.0 * tolerance::TANGENT_SPHERES);
            let sphere = match self.sphere(spheres[0]) {
                Ok(sphere) => sphere,
                Err(error) if agree => return Err(error),
                Err(_) => continue,
            };
            if sphere.residual <= tolerance::RECOVERED_KIND {
                return Ok(sphere);
            }
            // The digits of the difference from a sphere are few: the circles, not the spheres, must give the frame. Each round sees them
            // from a better centre.
            let mut better = sphere;
            let mut net_of_circles = sphere;
            for _ in 0..3 {
                let Ok(found) = self.nearly_sphere(&net_of_circles, &families) else {
                    break;
                };
                if found.residual < better.residual {
                    better = found;
                }
                let Dupin::Quartic(quartic) = found.surface else {
                    break;
                };
                match self.sphere(Cycle::new(quartic.frame().origin(), quartic.mu())) {
                    Ok(seen) => net_of_circles = seen,
                    Err(_) => break,
                }
            }
            if agree || better.residual <= tolerance::REBUILT_NET {
                return Ok(better);
            }
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
        let at = |places: [f64; 3]| {
            places
                .into_iter()
                .find_map(|u| HomogeneousSphere::along(net, u, flipped))
                .ok_or(Error::NoNormal {
                    u: places[0],
                    v: 0.0,
                })
        };
        let [start, middle, end] = INSTEAD;
        Ok([at(start)?, at(middle)?, at(end)?])
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
        // On a double sphere either line may run near a pole, where its angle has few digits.
        let lines: &[f64] = match &surface {
            Dupin::Quartic(quartic) if quartic.a() == 0.0 => &READING_LINES,
            _ => &READING_LINES[..1],
        };
        let mut best: Result<Conversion, Error> = Err(Error::Planar);
        for &line in lines {
            let [first, second] = spans(&net, &surface, line)?;
            let residual = self.residual(&surface, rows_follow_first, first, second)?;
            let found = Conversion {
                surface,
                rows_follow_first,
                first,
                second,
                residual,
            };
            if best.is_ok_and(|best| best.residual <= residual) {
                continue;
            }
            best = Ok(found);
        }
        best
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

    /// A cyclide next to a sphere: its frame and eccentricity are those of the net of circles on the sphere, and `a`, `mu` and the centre
    /// follow from the tangent spheres of the first family, `(a cos theta, b sin theta, 0 ; mu - c cos theta)`, as a linear problem.
    fn nearly_sphere(
        &self,
        sphere: &Conversion,
        families: &[[HomogeneousSphere; 3]; 2],
    ) -> Result<Conversion, Error> {
        let Dupin::Quartic(net_of_circles) = sphere.surface else {
            return Ok(*sphere);
        };
        let [rows, columns] = families;
        let (net, first_family) = if sphere.rows_follow_first {
            (self.net, rows)
        } else {
            (self.net.transposed(), columns)
        };
        let line = READING_LINES[0];
        let crossing = net_of_circles.parameters_at(net.point(line, line)?);
        let (e, q) = (net_of_circles.eccentricity(), net_of_circles.minor_ratio());
        let frame = *net_of_circles.frame();
        // Where the unit ellipse of centres is, and minus how the radius changes.
        let mut expected = [Cycle::default(); 3];
        for (expected, u) in expected.iter_mut().zip([0.0, 0.5, 1.0]) {
            let angles = net_of_circles.parameters_at(net.point(u, line)?);
            let [theta, _] = on_sheet(angles, crossing, 1);
            let (sin, cos) = theta.sin_cos();
            *expected = Cycle::new(
                frame.vector_to_world(DVec3::new(cos, q * sin, 0.0)),
                -e * cos,
            );
        }
        let given = first_family.map(|sphere| {
            let Cycle { centre, radius } = sphere.cycle();
            Cycle::new(centre, radius.abs())
        });
        let mean = |cycles: &[Cycle; 3]| (cycles[0] + cycles[1] + cycles[2]) * (1.0 / 3.0);
        let (mean_expected, mean_given) = (mean(&expected), mean(&given));
        let (mut product, mut square) = (0.0, 0.0);
        for (expected, given) in expected.iter().zip(&given) {
            let (step, found) = (*expected - mean_expected, *given - mean_given);
            product += step.centre.dot(found.centre) + step.radius * found.radius;
            square += step.centre.length_squared() + step.radius * step.radius;
        }
        let signed = product / square;
        let centre = mean_given - mean_expected * signed;
        let a = signed.abs();
        let surface =
            Quartic::with_half_axes([a, a * q, a * e], centre.radius, frame.at(centre.centre))?;
        self.read_off(surface.into(), sphere.rows_follow_first)
    }

    /// The line common to the planes of the iso-curves `u = const`, about the centre of a sphere.
    fn pencil_axis(
        &self,
        net: &Biquadratic<DVec3>,
        centre: DVec3,
        radius: f64,
    ) -> Option<PencilAxis> {
        let chords = |u: f64| -> Option<(DVec3, [DVec3; 2])> {
            let [p, q, r] = [0.0, 0.5, 1.0].map(|v| net.point(u, v).ok());
            let p = p?;
            Some((p - centre, [q? - p, r? - p]))
        };
        let curves = [0.0, 0.25, 0.5, 0.75, 1.0].map(chords);
        let longest = |[q, r]: [DVec3; 2]| q.length().max(r.length());
        let reach = curves
            .iter()
            .flatten()
            .map(|&(_, chords)| longest(chords))
            .fold(0.0, f64::max);
        // A curve that has shrunk to a pole has no plane.
        let planes: Vec<(DVec3, f64)> = curves
            .into_iter()
            .flatten()
            .filter(|&(_, chords)| longest(chords) > POLE * reach)
            .filter_map(|(p, [q, r])| {
                let normal = q.cross(r).try_normalize()?;
                Some((normal, normal.dot(p)))
            })
            .collect();
        // The two planes that meet at the largest angle.
        let mut widest: Option<PencilAxis> = None;
        let mut sine = tolerance::TANGENT_SPHERES;
        for (index, first) in planes.iter().enumerate() {
            for second in planes.iter().skip(index + 1) {
                let cross = first.0.cross(second.0);
                if cross.length() > sine {
                    sine = cross.length();
                    let foot = (first.1 * second.0.cross(cross) - second.1 * first.0.cross(cross))
                        / cross.length_squared();
                    widest = Some(PencilAxis {
                        foot,
                        direction: cross.normalize(),
                    });
                }
            }
        }
        widest.filter(|axis| axis.foot.length() < radius)
    }
}

/// The axis of a pencil of planes, seen from the centre of a sphere: its foot and its direction.
#[derive(Clone, Copy)]
struct PencilAxis {
    foot: DVec3,
    direction: DVec3,
}

/// An iso-curve shorter than this share of the net is a singular point: its tangents have half their digits left.
pub(crate) const POLE: f64 = 1e-8;

/// Tangent spheres as close as this leave too few digits for the axes of their conic.
const NEARLY_ONE_SPHERE: f64 = 1e-5;

fn spheres_agree(spheres: &[Cycle; 3], tolerance: f64) -> bool {
    let [start, ..] = spheres;
    let scale = start.centre.length().max(start.radius.abs()).max(1.0);
    spheres.iter().all(|sphere| {
        let step = *sphere - *start;
        step.centre.length().hypot(step.radius) <= tolerance * scale
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
    /// `None` where the iso-curve has shrunk to a point or has no normal.
    fn along(net: &Biquadratic<DVec3>, u: f64, flipped: bool) -> Option<Self> {
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
            let lengths = [along_u.length(), along_v.length()];
            if lengths[0].min(lengths[1]) <= POLE
                || cross.length() <= tolerance::TANGENT_SPHERES * lengths[0] * lengths[1]
            {
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
            // The net has size one.
            if square <= POLE * POLE {
                return None;
            }
            let weight = normal.dot(chord);
            return Some(Self {
                weight,
                centre: weight * point + 0.5 * square * normal,
                radius: -0.5 * square,
            });
        }
        None
    }

    fn is_plane(&self) -> bool {
        // The weight is the sine of the angle between chord and tangent plane, times the chord.
        self.weight.abs() <= tolerance::TANGENT_SPHERES * (2.0 * self.radius.abs()).sqrt()
    }

    fn cycle(&self) -> Cycle {
        Cycle::new(self.centre / self.weight, self.radius / self.weight)
    }
}

/// The spans of both parameters of a net whose rows follow the first one, read off along the iso-curves at `line`.
fn spans(
    net: &Biquadratic<DVec3>,
    surface: &Dupin,
    line: f64,
) -> Result<[[f64; 2]; 2], bezier_mass::Error> {
    let at = |u: f64, v: f64| net.point(u, v).map(|point| surface.parameters_at(point));
    let Dupin::Quartic(quartic) = surface else {
        return Ok([
            [at(0.0, line)?[0], at(1.0, line)?[0]],
            [at(line, 0.0)?[1], at(line, 1.0)?[1]],
        ]);
    };
    let crossing = at(line, line)?;
    let constant = |angles: [f64; 2], which: usize| {
        if quartic.a() == 0.0 {
            on_sheet(angles, crossing, which)
        } else {
            angles
        }
    };
    let first = span(|t| Ok(constant(at(t, line)?, 1)[0]))?;
    let second = span(|t| Ok(constant(at(line, t)?, 0)[1]))?;
    Ok([reduced(first), reduced(second)])
}

/// On the double sphere `(theta, psi)` and `(theta + pi, pi - psi)` are one point: the pair that keeps the parameter that is constant along
/// an iso-curve through the crossing.
fn on_sheet([theta, psi]: [f64; 2], crossing: [f64; 2], constant: usize) -> [f64; 2] {
    let pair = [theta, psi];
    let other = [theta + PI, PI - psi];
    let off = |pair: [f64; 2]| nearest_turn(pair[constant] - crossing[constant], 0.0).abs();
    if off(other) < off(pair) { other } else { pair }
}

/// An angle at the start and at the end of an iso-curve. On a patch it grows or falls all the way, by less than a full turn, so that one
/// place between the ends decides which: the one furthest from both.
fn span(
    angle: impl Fn(f64) -> Result<f64, bezier_mass::Error>,
) -> Result<[f64; 2], bezier_mass::Error> {
    let (start, end) = (angle(0.0)?, angle(1.0)?);
    let ahead = |angle: f64| (angle - start).rem_euclid(TAU);
    let whole = ahead(end);
    let (mut widest, mut grows) = (-1.0, true);
    for step in 1..SAMPLES {
        let between = angle(f64::from(step) / f64::from(SAMPLES))?;
        let gap = [start, end]
            .map(|end| nearest_turn(between - end, 0.0).abs())
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if gap > widest {
            (widest, grows) = (gap, ahead(between) <= whole);
        }
    }
    Ok([start, start + if grows { whole } else { whole - TAU }])
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

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct ConversionData {
    surface: Dupin,
    rows_follow_first: bool,
    first: [f64; 2],
    second: [f64; 2],
    residual: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<ConversionData> for Conversion {
    type Error = Error;

    fn try_from(data: ConversionData) -> Result<Self, Error> {
        let ConversionData {
            surface,
            rows_follow_first,
            first,
            second,
            residual,
        } = data;
        surface.patch(first, second)?;
        if !(0.0..=tolerance::REBUILT_NET).contains(&residual) {
            return Err(Error::NetResidual {
                residual,
                allowed: tolerance::REBUILT_NET,
            });
        }
        Ok(Self {
            surface,
            rows_follow_first,
            first,
            second,
            residual,
        })
    }
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
