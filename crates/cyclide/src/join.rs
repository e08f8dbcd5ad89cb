//! Joining two given contact circles: with one cyclide if possible, with two and a cone between them otherwise.
//!
//! Two given circles are one condition too many for one cyclide (Shene, Remark 15). With two cyclides it is the biarc problem in R^{3,1}: the contact spheres
//! are two points, the lines of spheres of the cones their tangents, and the cone in the middle is the common tangent of the two conics. Nothing
//! in it asks for coplanar axes, so skew cones are joined as well.

use crate::frame::finite;
use crate::{Blend, Cone, CurvatureCircle, Error, Tube, classify, tolerance};
use lorentz::Cycle;

/// What joins two circles on two cones.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Joined {
    /// One cyclide touches both cones along the given circles.
    Once(Box<Blend>),
    /// Two cyclides, with a cone between them that touches both.
    Twice(Box<DoubleBlend>),
}

/// Two cyclides in a row, touching each other along a circle on a cone between the given cones.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DoubleBlend {
    /// From the first cone to the middle cone.
    pub first: Blend,
    /// The cone that touches both surfaces along their common circle; it shares an inscribed sphere with each given cone.
    pub middle: Cone,
    /// From the middle cone to the second cone.
    pub second: Blend,
    /// The tube of each surface that leads from circle to circle without a fold.
    pub tubes: [Tube; 2],
}

impl DoubleBlend {
    /// The larger of the two G1 residuals.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.first.residual().max(self.second.residual())
    }

    /// The sides of the given cones that the blend continues, as [`Tube::sides`].
    #[must_use]
    pub fn sides(&self) -> [i8; 2] {
        let [first, second] = &self.tubes;
        [first.sides()[0], second.sides()[1]]
    }
}

/// The blend that touches both cones along the given circles: one cyclide where one exists, otherwise the smoothest pair of cyclides with a middle
/// cone among the [`double_blends`]: two rings before others, then the shortest tubes in the parameters of their surfaces.
///
/// # Errors
///
/// [`Error::NotACircleOfTheCone`]; [`Error::CommonSphere`] if one inscribed sphere touches the cones along both circles;
/// [`Error::NoMiddleCone`].
pub fn join(cones: [&Cone; 2], circles: [&CurvatureCircle; 2]) -> Result<Joined, Error> {
    match blend_through(cones, circles) {
        Ok(blend) => Ok(Joined::Once(Box::new(blend))),
        Err(error @ (Error::NotACircleOfTheCone { .. } | Error::CommonSphere { .. })) => Err(error),
        Err(_) => {
            let blends = double_blends(cones, circles)?;
            let best = blends
                .into_iter()
                .min_by(|one, other| roughness(one).total_cmp(&roughness(other)));
            best.map(|blend| Joined::Twice(Box::new(blend)))
                .ok_or(Error::NoMiddleCone)
        }
    }
}

/// The one cyclide that touches the first cone along the first circle and the second cone along the second.
///
/// # Errors
///
/// [`Error::NotACircleOfTheCone`]; [`Error::NotBlendable`]; [`Error::CommonSphere`] if one inscribed sphere touches the cones along both
/// circles; [`Error::NotJoined`] with the mismatch of the nearest member of the families; as [`crate::Family::blend`] for the member that
/// would join them.
pub fn blend_through(cones: [&Cone; 2], circles: [&CurvatureCircle; 2]) -> Result<Blend, Error> {
    let heights = heights(cones, circles)?;
    let found = classify(cones[0], cones[1]);
    if found.families().is_empty() {
        return Err(Error::NotBlendable(found.class()));
    }
    let size = circles[1]
        .radius
        .max(circles[0].radius)
        .max(circles[0].centre.distance(circles[1].centre));
    let mut mismatch = f64::INFINITY;
    let mut failure = None;
    for family in found.families() {
        let parameter = family.parameter_at_height(heights[0]);
        let [_, sphere] = family.contact_spheres(parameter);
        let touched = family.lines()[1].contact_circle(sphere);
        let miss = touched
            .centre
            .distance(circles[1].centre)
            .max((touched.radius - circles[1].radius).abs())
            / size;
        mismatch = mismatch.min(miss);
        if miss <= tolerance::BLEND {
            match family.blend(parameter) {
                Ok(blend) => return Ok(blend),
                Err(error) => failure = failure.or(Some(error)),
            }
        }
    }
    Err(failure.unwrap_or(Error::NotJoined { mismatch }))
}

/// Joins of two circles by two cyclides, for every choice of orientations, that can be used: no singular point on a contact circle or inside a tube,
/// no passage through infinity, and no fold at the middle.
///
/// The joins form a one-parameter set, the biarcs of R^{3,1}, told apart by the ratio of the signed Lorentz lengths from the contact
/// spheres to the corners of the biarc's polygon. All with equal lengths (the balanced biarcs) are returned; if none of those can be
/// used, all with the first of the ratios `2^(k/8)`, `k = 1` to 80, for which one can, each together with its inverse and both signs: so
/// exchanging the cones gives the same joins. A join that exists for none of these ratios is not found.
///
/// # Errors
///
/// [`Error::NotACircleOfTheCone`]; [`Error::NoMiddleCone`] if none was found.
pub fn double_blends(
    cones: [&Cone; 2],
    circles: [&CurvatureCircle; 2],
) -> Result<Vec<DoubleBlend>, Error> {
    let heights = heights(cones, circles)?;
    for step in 0..=LARGEST_STEP {
        let ratio = (0.125 * f64::from(step)).exp2();
        let ratios: &[f64] = if step == 0 {
            // Minus one would leave no distance between the corners.
            &[1.0]
        } else {
            &[ratio, 1.0 / ratio, -ratio, -1.0 / ratio]
        };
        let found: Vec<DoubleBlend> = ratios
            .iter()
            .flat_map(|&ratio| joins_of_ratio(cones, heights, ratio))
            .collect();
        if !found.is_empty() {
            return Ok(found);
        }
    }
    Err(Error::NoMiddleCone)
}

/// The ratio of the two lengths of a join goes up to `2^(k/8)` with this `k`, a thousand: beyond, one of the cyclides hardly bends.
const LARGEST_STEP: u32 = 80;

/// The joins whose second length is `ratio` times the first.
fn joins_of_ratio(cones: [&Cone; 2], heights: [f64; 2], ratio: f64) -> Vec<DoubleBlend> {
    let first = cones[0].spheres();
    let start = first.at(first.sphere_touching_at(heights[0]));
    let mut found = Vec::new();
    for reversed in [false, true] {
        let second = if reversed {
            cones[1].spheres().reversed()
        } else {
            cones[1].spheres()
        };
        let end = second.at(second.sphere_touching_at(heights[1]));
        for sign in [1.0, -1.0] {
            let (u, v) = (first.direction(), second.direction() * sign);
            for length in lengths_of_ratio(start, u, end, v, ratio) {
                let corners = [start + u * length, end - v * (ratio * length)];
                found.extend(through_middle(cones, [start, end], corners, ratio));
            }
        }
    }
    found
}

/// Heights of the circles on their cones.
fn heights(cones: [&Cone; 2], circles: [&CurvatureCircle; 2]) -> Result<[f64; 2], Error> {
    let height = |cone: &Cone, circle: &CurvatureCircle| {
        let height = finite(
            "circle centre",
            (circle.centre - cone.point()).dot(cone.axis()),
        )?;
        let expected = cone.circle_at(height);
        let size = circle.radius.max(height.abs());
        let deviation = (expected.centre.distance(circle.centre)
            + (expected.radius - circle.radius).abs())
            / size
            + expected.axis.cross(circle.axis).length();
        if deviation <= tolerance::CLASS {
            Ok(height)
        } else {
            Err(Error::NotACircleOfTheCone { deviation })
        }
    };
    Ok([height(cones[0], circles[0])?, height(cones[1], circles[1])?])
}

/// The lengths `l` with `<D, D> = 2 l <D, u + q v> + 2 q l² (1 - <u, v>)` for `D` from start to end and the ratio `q`: the corners `start + l u`
/// and `end - q l v` of the biarc's polygon are then `l + q l` apart.
fn lengths_of_ratio(start: Cycle, u: Cycle, end: Cycle, v: Cycle, ratio: f64) -> Vec<f64> {
    let step = end - start;
    // quadratic l² + 2 half l - constant = 0
    let (quadratic, half, constant) = (
        2.0 * ratio * (1.0 - u.product(v)),
        step.product(u + v * ratio),
        step.square(),
    );
    let scale = step.centre.length_squared() + step.radius * step.radius;
    if quadratic.abs() <= tolerance::CLASS * ratio.abs() {
        let length = constant / (2.0 * half);
        return if length.is_finite() && length.abs() <= scale.sqrt() / tolerance::CLASS {
            vec![length]
        } else {
            Vec::new()
        };
    }
    let discriminant = half * half + quadratic * constant;
    if discriminant < 0.0 {
        return Vec::new();
    }
    // Without cancellation.
    let sum = half + half.signum() * discriminant.sqrt();
    [-sum / quadratic, constant / sum]
        .into_iter()
        .filter(|length| length.is_finite() && *length != 0.0)
        .collect()
}

/// The pair of blends through the given corners on the two lines, if it can be used. Their joint divides the line from corner to corner
/// as 1 to `ratio`.
fn through_middle(
    cones: [&Cone; 2],
    [start, end]: [Cycle; 2],
    corners: [Cycle; 2],
    ratio: f64,
) -> Option<DoubleBlend> {
    let middle = Cone::through_spheres(corners[0], corners[1])?;
    let joint = corners[0] + (corners[1] - corners[0]) * (1.0 / (1.0 + ratio));
    let touching =
        |cone: &Cone, sphere: Cycle, other: &Cone, other_sphere: Cycle| -> Option<Blend> {
            let circle = |cone: &Cone, sphere: Cycle| {
                cone.spheres().contact_circle(oriented_like(cone, sphere))
            };
            blend_through(
                [cone, other],
                [&circle(cone, sphere), &circle(other, other_sphere)],
            )
            .ok()
        };
    let one = touching(cones[0], start, &middle, joint)?;
    let other = touching(&middle, joint, cones[1], end)?;
    // The tubes must leave the middle cone to different sides.
    let (one_tubes, other_tubes) = (one.tubes()?, other.tubes()?);
    let flip = if middle.axis().dot(other.family().lines()[0].axis()) < 0.0 {
        -1
    } else {
        1
    };
    let flip = if middle.axis().dot(one.family().lines()[1].axis()) < 0.0 {
        -flip
    } else {
        flip
    };
    one_tubes
        .into_iter()
        .flat_map(|tube| other_tubes.into_iter().map(move |next| [tube, next]))
        .filter(|[tube, next]| tube.sides()[1] == -flip * next.sides()[0])
        .filter(|tubes| {
            tubes
                .iter()
                .all(|tube| tube.is_smooth() && !tube.is_unbounded())
        })
        .min_by(|one, other| tubes_span(one).total_cmp(&tubes_span(other)))
        .map(|tubes| DoubleBlend {
            first: one,
            middle,
            second: other,
            tubes,
        })
}

/// A sphere inscribed in a cone, with the sign of the radius that the cone gives it.
fn oriented_like(cone: &Cone, sphere: Cycle) -> Cycle {
    let line = cone.spheres();
    line.at((sphere.centre - cone.point()).dot(cone.axis()))
}

fn tubes_span(tubes: &[Tube; 2]) -> f64 {
    tubes
        .iter()
        .flat_map(Tube::spans)
        .map(|[from, to]| (to - from).abs())
        .sum()
}

fn roughness(blend: &DoubleBlend) -> f64 {
    let rings = [&blend.first, &blend.second]
        .into_iter()
        .filter(|blend| blend.kind().is_ring())
        .count();
    tubes_span(&blend.tubes) + if rings == 2 { 0.0 } else { 100.0 }
}
