//! Joining two given contact circles: with one cyclide if possible, with two and a cone between them otherwise.
//!
//! Two given circles are one condition too many for one cyclide (Shene, Remark 15). With two cyclides it is the biarc problem in R^{3,1}: the contact spheres
//! are two points, the lines of spheres of the cones their tangents, and the cone in the middle is the common tangent of the two conics. Nothing
//! in it asks for coplanar axes, so skew cones are joined as well.

use crate::frame::finite;
use crate::{Blend, Cone, CurvatureCircle, Error, SphereLine, Tube, classify, tolerance};
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
/// cone.
///
/// # Errors
///
/// [`Error::NotACircleOfTheCone`]; [`Error::NoMiddleCone`].
pub fn join(cones: [&Cone; 2], circles: [&CurvatureCircle; 2]) -> Result<Joined, Error> {
    match blend_through(cones, circles) {
        Ok(blend) => Ok(Joined::Once(Box::new(blend))),
        Err(error @ Error::NotACircleOfTheCone { .. }) => Err(error),
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
/// [`Error::NotACircleOfTheCone`]; [`Error::NotBlendable`]; [`Error::NotJoined`] with the mismatch of the nearest member of the families.
pub fn blend_through(cones: [&Cone; 2], circles: [&CurvatureCircle; 2]) -> Result<Blend, Error> {
    let heights = heights(cones, circles)?;
    let found = classify(cones[0], cones[1]);
    let mut mismatch = f64::INFINITY;
    for blend in found.blends_at_height(heights[0])? {
        let [_, contact] = blend.contacts();
        let size = circles[1]
            .radius
            .max(circles[0].radius)
            .max(circles[0].centre.distance(circles[1].centre));
        let miss = contact
            .circle
            .centre
            .distance(circles[1].centre)
            .max((contact.circle.radius - circles[1].radius).abs())
            / size;
        if miss <= tolerance::BLEND {
            return Ok(blend);
        }
        mismatch = mismatch.min(miss);
    }
    Err(Error::NotJoined { mismatch })
}

/// All joins of two circles by two cyclides with equal Lorentz lengths on both sides (the balanced biarcs), for every choice of orientations, that can
/// be used: no singular point on a contact circle, and no fold at the middle.
///
/// # Errors
///
/// [`Error::NotACircleOfTheCone`]; [`Error::NoMiddleCone`] if there is none.
pub fn double_blends(
    cones: [&Cone; 2],
    circles: [&CurvatureCircle; 2],
) -> Result<Vec<DoubleBlend>, Error> {
    let heights = heights(cones, circles)?;
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
            for length in balanced_lengths(start, first.direction(), end, second.direction() * sign)
            {
                found.extend(through_middle(
                    cones,
                    [start, end],
                    [&first, &second],
                    [length, -sign * length],
                ));
            }
        }
    }
    if found.is_empty() {
        Err(Error::NoMiddleCone)
    } else {
        Ok(found)
    }
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

/// The lengths `l` with `<D, D> = 2 l <D, u + v> + 2 l² (1 - <u, v>)` for `D` from start to end: the corners `start + l u` and `end - l v` of the
/// biarc's polygon are then `2 l` apart.
fn balanced_lengths(start: Cycle, u: Cycle, end: Cycle, v: Cycle) -> Vec<f64> {
    let step = end - start;
    // quadratic l² + 2 half l - constant = 0
    let (quadratic, half, constant) = (
        2.0 * (1.0 - u.product(v)),
        step.product(u + v),
        step.square(),
    );
    let scale = step.centre.length_squared() + step.radius * step.radius;
    if quadratic.abs() <= tolerance::CLASS {
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

/// The pair of blends with the given signed lengths along the two lines, if it can be used.
fn through_middle(
    cones: [&Cone; 2],
    [start, end]: [Cycle; 2],
    [first, second]: [&SphereLine; 2],
    lengths: [f64; 2],
) -> Option<DoubleBlend> {
    let corners = [
        start + first.direction() * lengths[0],
        end + second.direction() * lengths[1],
    ];
    let middle = Cone::through_spheres(corners[0], corners[1])?;
    let joint = (corners[0] + corners[1]) * 0.5;
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
