//! From a biquadratic net back to the cyclide of which it is a patch.
//!
//! The tangent spheres along three iso-curves of one parameter are three points of a conic in R^{3,1}, and three points determine it. This stays
//! stable where the classical way (axes as intersections of circle planes) runs to infinity, on surfaces near a torus.

mod reading;
mod spheres;
mod tangent_sphere;

use self::reading::spans;
use self::spheres::{NEARLY_ONE_SPHERE, spheres_agree};
use self::tangent_sphere::HomogeneousSphere;
use crate::determine;
use crate::patch::normalise;
use crate::{CyclidePatch, Dupin, Error, Kind, tolerance};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;
use lorentz::Cycle;

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

/// Where an iso-curve is taken for one that has shrunk to a singular point: further inside, at the start, in the middle and at the end.
pub(crate) const INSTEAD: [[f64; 3]; 3] = [[0.0, 0.14, 0.23], [0.5, 0.43, 0.61], [1.0, 0.87, 0.79]];

/// An iso-curve shorter than this share of the net is a singular point: its tangents have half their digits left.
pub(crate) const POLE: f64 = 1e-8;

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
