//! Indicatrices: curves given by their support function, checked to be symmetric and strictly convex.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::{Contact, DualCurve, Error, PhArc, SupportJet};

/// A convex curve around the origin, given by its support function and two derivatives in the outward normal's angle.
pub trait Support {
    /// The jet of the support function at the normal angle `psi`.
    fn jet(&self, psi: f64) -> SupportJet;

    /// The point with the outward normal at `psi`, that normal, the support and the radius of curvature.
    fn contact(&self, psi: f64) -> Contact {
        let (jet, normal) = (self.jet(psi), DVec2::from_angle(psi));
        Contact {
            point: jet.support * normal + jet.slope * normal.perp(),
            normal,
            support: jet.support,
            radius: jet.radius(),
        }
    }
}

impl<F: Fn(f64) -> SupportJet> Support for F {
    fn jet(&self, psi: f64) -> SupportJet {
        self(psi)
    }
}

/// The ellipse with semi-axes `a` along x and `b` along y; its support is NaN unless both are positive.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ellipse {
    /// Semi-axis along x.
    pub a: f64,
    /// Semi-axis along y.
    pub b: f64,
}

impl Support for Ellipse {
    fn jet(&self, psi: f64) -> SupportJet {
        let (sine, cosine) = psi.sin_cos();
        let support = match self.check() {
            Ok(()) => (self.a * cosine).hypot(self.b * sine),
            Err(_) => f64::NAN,
        };
        let slope = (self.b - self.a) * (self.b + self.a) * sine * cosine / support;
        // The radius of curvature is a² b² / p³.
        let radius = self.a * self.b / support * (self.a * self.b / support) / support;
        SupportJet {
            support,
            slope,
            bend: radius - support,
        }
    }
}

/// The curve with the support function `1 + height cos 4ψ`, a rational curve of class 8 that is no conic; convex for
/// `|height| < 1/15`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bumped {
    /// The height of the four bumps.
    pub height: f64,
}

impl Support for Bumped {
    fn jet(&self, psi: f64) -> SupportJet {
        let (sine, cosine) = (4.0 * psi).sin_cos();
        SupportJet {
            support: 1.0 + self.height * cosine,
            slope: -4.0 * self.height * sine,
            bend: -16.0 * self.height * cosine,
        }
    }
}

/// A closed rational curve made of dual Bézier arcs over half a turn and their images in the origin.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "Vec<DualCurve>", into = "Vec<DualCurve>")
)]
pub struct DualIndicatrix {
    arcs: Vec<DualCurve>,
    /// Normal angle at the start of each arc, and half a turn after the first.
    angles: Vec<f64>,
}

impl TryFrom<Vec<DualCurve>> for DualIndicatrix {
    type Error = Error;

    fn try_from(arcs: Vec<DualCurve>) -> Result<Self, Error> {
        Self::try_new(arcs)
    }
}

impl From<DualIndicatrix> for Vec<DualCurve> {
    fn from(indicatrix: DualIndicatrix) -> Self {
        indicatrix.arcs
    }
}

/// Consecutive arcs must agree in normal and support to this share of the size.
const JOINT_TOLERANCE: f64 = 1e-9;
/// Steps to find a normal on an arc: Newton's method inside a bracket, halved where it leaves.
const INVERSION_STEPS: usize = 60;

impl DualIndicatrix {
    /// Closes arcs that follow each other counter-clockwise and together turn by `π`, so that they and their images in
    /// the origin make a closed curve.
    ///
    /// # Errors
    ///
    /// [`Error::TooFew`] without arcs; [`Error::Gap`] where two arcs do not share their tangent line, the image of the first
    /// one after the last included; [`Error::NotRegular`] for an arc that does not turn left throughout;
    /// [`Error::TurningTooLarge`] if they turn by `3π` or more; [`Error::AtInfinity`] for an arc without finite ends.
    pub fn try_new(arcs: Vec<DualCurve>) -> Result<Self, Error> {
        let (Some(first), Some(_)) = (arcs.first(), arcs.last()) else {
            return Err(Error::TooFew {
                what: "arcs of an indicatrix",
                given: 0,
                needed: 1,
            });
        };
        let start = first.contact(0.0)?;
        let mut angles = vec![start.normal.to_angle()];
        let mut angle = angles[0];
        for (index, arc) in arcs.iter().enumerate() {
            let (from, to) = (arc.contact(0.0)?, arc.contact(1.0)?);
            if !crate::rosette::keeps_positive(&arc.turn_polynomial(), 0) {
                return Err(Error::NotRegular {
                    index,
                    radii: [from.radius, to.radius],
                });
            }
            angle += from.normal.angle_to(to.normal).rem_euclid(TAU);
            angles.push(angle);
            let (normal, support) = match arcs.get(index + 1) {
                Some(next) => (next.contact(0.0)?.normal, next.contact(0.0)?.support),
                None => (-start.normal, start.support),
            };
            let distance = to
                .normal
                .distance(normal)
                .max((to.support - support).abs() / start.support.abs());
            if distance.is_nan() || distance > JOINT_TOLERANCE {
                return Err(Error::Gap { index, distance });
            }
        }
        // The joints close, so that this is an odd multiple of π up to rounding.
        let turning = angle - angles[0];
        if turning > TAU {
            return Err(Error::TurningTooLarge { turning });
        }
        Ok(Self { arcs, angles })
    }

    /// The rational arcs over half a turn.
    #[must_use]
    pub fn arcs(&self) -> &[DualCurve] {
        &self.arcs
    }

    /// The parameter on `arc` at which the normal has this direction: the zero of `det(n(t), N)`.
    fn parameter(arc: &DualCurve, normal: DVec2) -> f64 {
        let side = |t: f64| {
            let coordinates: DVec3 = bezier_mass::bernstein::evaluate(arc.vectors(), t);
            DVec2::new(coordinates.y, coordinates.z)
                .normalize_or_zero()
                .perp_dot(normal)
        };
        let (mut low, mut high) = (0.0, 1.0);
        let (mut below, mut above) = (side(0.0), side(1.0));
        if below <= 0.0 || above >= 0.0 {
            return if below <= 0.0 { 0.0 } else { 1.0 };
        }
        for step in 0..INVERSION_STEPS {
            // Regula falsi by turns with halving: never outside the bracket, and quick for a smooth angle.
            let secant: f64 = low + (high - low) * below / (below - above);
            let t = if step % 3 == 2 {
                0.5 * (low + high)
            } else {
                secant
            };
            let value = side(t);
            if value > 0.0 {
                (low, below) = (t, value);
            } else {
                (high, above) = (t, value);
            }
            if value.abs() <= f64::EPSILON || high - low <= f64::EPSILON {
                return t;
            }
        }
        0.5 * (low + high)
    }
}

impl Support for DualIndicatrix {
    fn jet(&self, psi: f64) -> SupportJet {
        let turned = (psi - self.angles[0]).rem_euclid(TAU);
        let (within, mirrored) = if turned < PI {
            (turned, false)
        } else {
            (turned - PI, true)
        };
        let angle = within + self.angles[0];
        let index = self
            .angles
            .partition_point(|&start| start <= angle)
            .saturating_sub(1)
            .min(self.arcs.len() - 1);
        let arc = &self.arcs[index];
        let contact = arc.contact(Self::parameter(arc, DVec2::from_angle(angle)));
        let nothing = SupportJet {
            support: f64::NAN,
            slope: f64::NAN,
            bend: f64::NAN,
        };
        contact.map_or(nothing, |contact| {
            // The image in the origin has the opposite point and normal: the same support and slope.
            let normal = DVec2::from_angle(if mirrored { psi } else { angle });
            let point = if mirrored {
                -contact.point
            } else {
                contact.point
            };
            SupportJet::of_element(point, normal, contact.radius)
        })
    }
}

/// A support function that is known to be positive, centrally symmetric and strictly convex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Indicatrix<S> {
    support: S,
}

/// The conditions are checked at this many angles over a turn, and at 16 more between two neighbours where the radius is
/// smallest; a rational indicatrix of class 8 has far fewer extrema.
const CHECKED_ANGLES: usize = 720;
/// Supports in opposite directions must agree to this share.
const SYMMETRY_TOLERANCE: f64 = 1e-9;

impl<S: Support> Indicatrix<S> {
    /// Checks the support function at a fixed number of angles.
    ///
    /// # Errors
    ///
    /// [`Error::NonFinite`]; [`Error::NotSymmetric`]; [`Error::NotConvex`] where the support or the radius of curvature
    /// is not positive.
    pub fn try_new(support: S) -> Result<Self, Error> {
        let angle = |i: usize| TAU * i as f64 / CHECKED_ANGLES as f64;
        let jets: Vec<SupportJet> = (0..CHECKED_ANGLES).map(|i| support.jet(angle(i))).collect();
        if jets
            .iter()
            .any(|jet| !(jet.support.is_finite() && jet.slope.is_finite() && jet.bend.is_finite()))
        {
            return Err(Error::NonFinite {
                what: "support of an indicatrix",
            });
        }
        let (first, second) = jets.split_at(CHECKED_ANGLES / 2);
        let defect = first
            .iter()
            .zip(second)
            .map(|(a, b)| (a.support - b.support).abs())
            .fold(0.0, f64::max);
        let size = jets.iter().map(|jet| jet.support.abs()).fold(0.0, f64::max);
        if defect > SYMMETRY_TOLERANCE * size {
            return Err(Error::NotSymmetric { defect });
        }
        let worst = |angles: &mut dyn Iterator<Item = f64>| {
            let radii = angles.map(|psi| (psi, support.jet(psi)));
            radii
                .map(|(psi, jet)| (psi, jet.radius().min(jet.support)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let coarse = worst(&mut (0..CHECKED_ANGLES).map(angle)).unwrap_or((0.0, f64::NAN));
        let step = TAU / CHECKED_ANGLES as f64;
        let fine =
            worst(&mut (-16..=16).map(|i| coarse.0 + step * f64::from(i) / 16.0)).unwrap_or(coarse);
        if fine.1.is_nan() || fine.1 <= 0.0 {
            return Err(Error::NotConvex {
                angle: fine.0,
                radius: fine.1,
            });
        }
        Ok(Self { support })
    }

    /// The support function.
    #[must_use]
    pub fn support(&self) -> &S {
        &self.support
    }
}

impl<S: Support> Support for Indicatrix<S> {
    fn jet(&self, psi: f64) -> SupportJet {
        self.support.jet(psi)
    }
}

/// Whether there is an arc between two normal angles.
fn check_turning(start: f64, end: f64) -> Result<(), Error> {
    let turning = end - start;
    if !turning.is_finite() {
        Err(Error::NonFinite {
            what: "normal angle of an arc",
        })
    } else if turning == 0.0 {
        Err(Error::NoTurning { turning })
    } else if turning.abs() >= PI {
        Err(Error::TurningTooLarge { turning })
    } else {
        Ok(())
    }
}

impl Ellipse {
    /// Whether both semi-axes are positive and finite.
    pub(super) fn check(&self) -> Result<(), Error> {
        if self.a > 0.0 && self.b > 0.0 && self.a.is_finite() && self.b.is_finite() {
            return Ok(());
        }
        Err(Error::BadRadius {
            radius: self.a.min(self.b),
            width: f64::INFINITY,
        })
    }

    /// The exact dual form over half a turn from the normal angle 0: the affine image of two quarter circles of class 2.
    ///
    /// # Errors
    ///
    /// [`Error::BadRadius`] unless both semi-axes are positive and finite.
    pub fn dual(&self) -> Result<DualIndicatrix, Error> {
        let quarters = (0..2).map(|quarter| {
            let start = 0.25 * TAU * f64::from(quarter);
            self.arc(start, start + 0.25 * TAU)
        });
        DualIndicatrix::try_new(quarters.collect::<Result<_, _>>()?)
    }

    /// The dual arc of class 2 whose normals are images of those of the unit circle from angle `start` to `end`.
    ///
    /// # Errors
    ///
    /// [`Error::BadRadius`] unless both semi-axes are positive and finite; [`Error::NoTurning`] for equal angles,
    /// [`Error::TurningTooLarge`] unless `|end - start| < π`; [`Error::NonFinite`].
    pub fn arc(&self, start: f64, end: f64) -> Result<DualCurve, Error> {
        self.check()?;
        check_turning(start, end)?;
        let circle = PhArc::<3>::new(
            DVec2::from_angle(0.5 * start),
            DVec2::from_angle(0.5 * end),
            [1.0; 3],
        )?;
        let circle = PhArc::<3>::new(
            circle.spinors().0,
            circle.spinors().1,
            circle.circle_coefficients(),
        )?;
        let image = circle
            .control_vectors()
            .map(|u| DVec3::new(u.x, u.y / self.a, u.z / self.b));
        DualCurve::from_vectors(&image)
    }
}

impl Bumped {
    /// Whether the curve is convex.
    pub(super) fn check(&self) -> Result<(), Error> {
        if self.height.abs() < 1.0 / 15.0 {
            return Ok(());
        }
        Err(Error::NotConvex {
            angle: if self.height > 0.0 { 0.0 } else { 0.125 * TAU },
            radius: 1.0 - 15.0 * self.height.abs(),
        })
    }

    /// The exact dual form over half a turn from the normal angle 0, two arcs of class 8:
    /// `u0 = -(q⁴ + height Re w⁸)`, `n = q³ w²` with `w` between unit complex numbers an eighth of a turn apart.
    ///
    /// # Errors
    ///
    /// [`Error::NotConvex`] unless `|height| < 1/15`.
    pub fn dual(&self) -> Result<DualIndicatrix, Error> {
        let arcs = (0..2).map(|quarter| {
            self.arc(
                0.25 * TAU * f64::from(quarter),
                0.25 * TAU * f64::from(quarter + 1),
            )
        });
        DualIndicatrix::try_new(arcs.collect::<Result<_, _>>()?)
    }

    /// The dual arc of class 8 between two normal angles less than half a turn apart.
    ///
    /// # Errors
    ///
    /// [`Error::NotConvex`] unless `|height| < 1/15`; [`Error::NoTurning`] for equal angles, [`Error::TurningTooLarge`]
    /// unless `|end - start| < π`; [`Error::NonFinite`].
    pub fn arc(&self, start: f64, end: f64) -> Result<DualCurve, Error> {
        use bezier_mass::bernstein::{product, product_with};
        self.check()?;
        check_turning(start, end)?;
        let w = [DVec2::from_angle(0.5 * start), DVec2::from_angle(0.5 * end)];
        let square = product_with(&w, &w, |a, b| a.rotate(*b));
        let fourth = product_with(&square, &square, |a: &DVec2, b| a.rotate(*b));
        let eighth = product_with(&fourth, &fourth, |a: &DVec2, b| a.rotate(*b));
        let norm = product_with(&w, &w, |a, b| a.dot(*b));
        let norm_squared = product(&norm, &norm);
        let norm_fourth = product(&norm_squared, &norm_squared);
        let normals = product(&product(&norm_squared, &norm), &square);
        let vectors: Vec<DVec3> = norm_fourth
            .iter()
            .zip(&eighth)
            .zip(&normals)
            .map(|((q, wave), n)| DVec3::new(-(q + self.height * wave.x), n.x, n.y))
            .collect();
        DualCurve::from_vectors(&vectors)
    }
}

#[cfg(test)]
mod tests;
