//! Algorithm 1 of the paper on biquadratic patches: torus and double sphere from the circles of the edges, with repairs.
//!
//! Parallel planes alone (the paper's condition) also hold for two meridians in one plane; here the circles must be coaxial. And `a` and `mu` are
//! read off directly, as the distance of the meridian's centre from the axis and the meridian's radius, instead of by counting the
//! intersections of the meridian circles, which is unstable at the horn torus.

use crate::convert::{INSTEAD, POLE, Scaled};
use crate::{Conversion, Error, Frame, Quartic, tolerance};
use bezier_mass::{Biquadratic, MassPoint};
use glam::DVec3;

/// Converts a biquadratic net whose rows (or columns) are circles about one axis into a patch of a torus or of a double sphere.
///
/// `theta` runs along these parallel circles. The frame of a torus is free about its axis: `hint` gives the directions wanted for `x` and for
/// `z`; without it `x` points to the centre of the first meridian (so `theta` starts at 0), and `theta` grows.
///
/// # Errors
///
/// [`Error::NoParallelEdges`] if no pair of opposite edges lies on coaxial circles in parallel planes; [`Error::CornerWeights`];
/// [`Error::NetResidual`] if the net rebuilt from the result differs.
pub fn convert_torus(
    net: &Biquadratic<DVec3>,
    hint: Option<[DVec3; 2]>,
) -> Result<Conversion, Error> {
    let scaled = Scaled::new(net)?;
    let attempts = [edges(scaled.net()), edges(&scaled.net().transposed())];
    let deviation = |edges: &Option<Edges>| edges.map_or(f64::INFINITY, |edges| edges.deviation);
    // The rows are the parallel circles if they can be, so theta follows the columns.
    let (edges, rows_follow_first) = match attempts {
        [Some(edges), _] if edges.deviation <= tolerance::NET => (edges, false),
        [_, Some(edges)] if edges.deviation <= tolerance::NET => (edges, true),
        _ => {
            return Err(Error::NoParallelEdges {
                deviation: deviation(&attempts[0]).min(deviation(&attempts[1])),
            });
        }
    };
    let offset = edges.meridian.centre - edges.parallel.centre;
    let centre = edges.parallel.centre + offset.dot(edges.parallel.axis) * edges.parallel.axis;
    let outward = edges.meridian.centre - centre;
    // All lengths are relative to the net here.
    let is_sphere = outward.length() <= tolerance::NET;
    let a = if is_sphere { 0.0 } else { outward.length() };

    let z = match hint {
        Some([_, z]) if z.dot(edges.parallel.axis) < 0.0 => -edges.parallel.axis,
        _ => edges.parallel.axis,
    };
    let towards_net = edges.start - edges.parallel.centre;
    let x = match hint {
        Some([x, _]) => x,
        None if is_sphere => -towards_net,
        None => outward,
    };
    let frame = Frame::from_directions(centre, x - x.dot(z) * z, z.cross(x)).ok_or(
        Error::NotDetermined {
            reason: "the hint for x is parallel to the axis",
        },
    )?;
    let surface = Quartic::new(a, 0.0, edges.meridian.radius, frame)?;
    let found = match hint {
        // The caller's frame stays as it is, even if theta falls.
        Some(_) => scaled.read_off_in(surface.into(), rows_follow_first)?,
        None => scaled.read_off(surface.into(), rows_follow_first)?,
    };
    if found.residual > tolerance::REBUILT_NET {
        return Err(Error::NetResidual {
            residual: found.residual,
            allowed: tolerance::REBUILT_NET,
        });
    }
    scaled.in_world(found)
}

/// What the algorithm reads from the edges of a net whose rows 0 and 2 may be parallel circles.
#[derive(Clone, Copy)]
struct Edges {
    /// The circle of row 0, or of an inner iso-curve where this row is a singular point.
    parallel: EdgeCircle,
    /// The circle of column 0.
    meridian: EdgeCircle,
    /// Where this circle starts.
    start: DVec3,
    /// How far the circles at both ends are from being coaxial.
    deviation: f64,
}

#[derive(Clone, Copy)]
struct EdgeCircle {
    centre: DVec3,
    radius: f64,
    axis: DVec3,
}

fn edges(net: &Biquadratic<DVec3>) -> Option<Edges> {
    let [first, _, last] = INSTEAD;
    let (parallel, start) = row_circle(net, first)?;
    let (opposite, _) = row_circle(net, last)?;
    let control = net.control();
    let meridian = edge_circle([control[0][0], control[1][0], control[2][0]])?;
    let tilt = parallel.axis.cross(opposite.axis).length();
    let shift = (opposite.centre - parallel.centre)
        .cross(parallel.axis)
        .length();
    Some(Edges {
        parallel,
        meridian,
        start,
        deviation: tilt.max(shift),
    })
}

/// The circle of the first of some iso-curves that has not shrunk to a point, and where it starts.
fn row_circle(net: &Biquadratic<DVec3>, places: [f64; 3]) -> Option<(EdgeCircle, DVec3)> {
    let [first, second, third] = net.control();
    places.into_iter().find_map(|u| {
        let other = 1.0 - u;
        let row = [0, 1, 2].map(|j| {
            first[j] * (other * other) + second[j] * (2.0 * u * other) + third[j] * (u * u)
        });
        let start = row[0].position()?;
        let middle = (row[0] * 0.25 + row[1] * 0.5 + row[2] * 0.25).position()?;
        // The net has size one.
        (start.distance(middle) > POLE)
            .then(|| edge_circle(row))
            .flatten()
            .map(|circle| (circle, start))
    })
}

/// The circle of a rational quadratic arc: its centre is on the bisector of the chord, where the radius is orthogonal to the tangent.
fn edge_circle([first, middle, last]: [MassPoint<DVec3>; 3]) -> Option<EdgeCircle> {
    let (start, end) = (first.position()?, last.position()?);
    let chord = end - start;
    // Weighted tangent at the start, defined for a middle control at infinity too.
    let tangent = (middle.weighted - middle.weight * start).try_normalize()?;
    let axis = tangent.cross(chord).try_normalize()?;
    let inward = axis.cross(tangent);
    let radius = chord.length_squared() / (2.0 * chord.dot(inward));
    radius.is_finite().then_some(EdgeCircle {
        centre: start + radius * inward,
        radius: radius.abs(),
        axis,
    })
}
