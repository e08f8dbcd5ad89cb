//! Nets on spheres, and on cyclides next to a sphere.

use super::reading::on_sheet;
use super::tangent_sphere::HomogeneousSphere;
use super::{Conversion, POLE, READING_LINES, Scaled};
use crate::{Dupin, Error, Frame, Quartic, tolerance};
use bezier_mass::Biquadratic;
use glam::DVec3;
use lorentz::Cycle;

/// Tangent spheres as close as this leave too few digits for the axes of their conic.
pub(super) const NEARLY_ONE_SPHERE: f64 = 1e-5;

pub(super) fn spheres_agree(spheres: &[Cycle; 3], tolerance: f64) -> bool {
    let [start, ..] = spheres;
    let scale = start.centre.length().max(start.radius.abs()).max(1.0);
    spheres.iter().all(|sphere| {
        let step = *sphere - *start;
        step.centre.length().hypot(step.radius) <= tolerance * scale
    })
}

impl Scaled {
    /// A patch of a sphere: the eccentricity and the frame of its orthogonal net of circles come from the planes of its iso-curves.
    pub(super) fn sphere(&self, sphere: Cycle) -> Result<Conversion, Error> {
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
    pub(super) fn nearly_sphere(
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
