//! Circular arcs, and hyperbolas seen as circles (Theorems 1 and 2 of the mass-point paper).

use crate::conic_of_arc::PARABOLA;
use crate::{Error, MassPoint, Quadratic, VectorSpace};
use glam::{DVec2, DVec3};

/// End points whose distances from the centre agree to this fraction of the radius are on one circle: looser than
/// rounding, since centres come from measurements and earlier constructions, and far below what a drawing shows.
/// The arc itself always passes through both end points exactly.
const ON_CIRCLE: f64 = 1e-9;

/// End points closer than this fraction of the radius coincide: their chord has no direction to trust.
const COINCIDENT: f64 = 1e-14;

/// A distance from chord to centre below this fraction of the radius is rounding: the chord is a diameter.
const DIAMETER: f64 = 16.0 * f64::EPSILON;

impl Quadratic<DVec2> {
    /// The minor circular arc about `centre` between two end points with positive end weights (Theorem 1).
    ///
    /// For a diameter the middle control mass point is a vector, the +90 degree turn of `end - start`
    /// (`(x, y)` to `(-y, x)`) times half the mean weight; there is no special case otherwise, since the middle control
    /// is `sqrt(w0 w2) (cos a; ...)` with half the opening angle `a` in either case. The major arc, or the other
    /// semicircle, is the [`complement`](Quadratic::complement).
    ///
    /// # Errors
    /// [`Error::NonPositiveEndWeight`], [`Error::CoincidentEnds`], [`Error::NotOnCommonCircle`] (by more than 1e-9 of
    /// the radius), [`Error::NonFinite`].
    ///
    /// ```
    /// use bezier_mass::{MassPoint, Quadratic, glam::dvec2};
    /// let upper = Quadratic::circular_arc(dvec2(0.0, 0.0), [dvec2(-1.0, 0.0), dvec2(1.0, 0.0)], [1.0, 1.0])?;
    /// assert_eq!(upper.control()[1], MassPoint::vector(dvec2(0.0, 1.0)));
    /// assert!((upper.point(0.3)?.length() - 1.0).abs() < 1e-15);
    /// # Ok::<(), bezier_mass::Error>(())
    /// ```
    pub fn circular_arc(
        centre: DVec2,
        ends: [DVec2; 2],
        end_weights: [f64; 2],
    ) -> Result<Self, Error> {
        arc(
            centre,
            ends,
            end_weights,
            DVec2::length,
            DVec2::dot,
            DVec2::perp,
        )
    }

    /// The circular arc from angle `start` to angle `end` (radians, less than a full turn apart, either way round), end
    /// weights one. The middle weight is the cosine of half the span: positive below half a turn, zero (a vector in the
    /// middle) at half a turn, negative above.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::CoincidentEnds`] for a zero radius, no span, or a full turn and more.
    pub fn circular_arc_by_angles(
        centre: DVec2,
        radius: f64,
        start: f64,
        end: f64,
    ) -> Result<Self, Error> {
        if ![centre.x, centre.y, radius, start, end]
            .iter()
            .all(|x| x.is_finite())
        {
            return Err(Error::NonFinite {
                what: "centre, radius or angle",
            });
        }
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let spread = radius.abs() * half.sin().abs();
        if spread <= COINCIDENT * radius.abs() || half.abs() >= core::f64::consts::PI {
            return Err(Error::CoincidentEnds {
                distance: 2.0 * spread,
            });
        }
        let cosine = if half.cos().abs() <= DIAMETER {
            0.0
        } else {
            half.cos()
        };
        let on_circle = |angle: f64| centre + DVec2::from_angle(angle) * radius;
        Self::new([
            MassPoint::point(on_circle(start), 1.0),
            MassPoint::from_homogeneous(
                cosine,
                centre * cosine + DVec2::from_angle(middle) * radius,
            ),
            MassPoint::point(on_circle(end), 1.0),
        ])
    }
}

impl Quadratic<DVec3> {
    /// The minor circular arc in space about `centre`, in the plane orthogonal to `axis` (of any length). For a
    /// diameter the middle vector is along `axis x (end - start)`, the +90 degree turn seen from the tip of the axis;
    /// everything else is as for [`Quadratic::circular_arc`].
    ///
    /// # Errors
    /// As [`Quadratic::circular_arc`]; [`Error::NonFinite`] also for an axis that is zero or along the chord.
    pub fn circular_arc_about_axis(
        centre: DVec3,
        axis: DVec3,
        ends: [DVec3; 2],
        end_weights: [f64; 2],
    ) -> Result<Self, Error> {
        arc(
            centre,
            ends,
            end_weights,
            DVec3::length,
            DVec3::dot,
            |chord| axis.cross(chord),
        )
    }
}

/// Theorem 1 in the plane or in space; `turn` is the +90 degree turn up to a positive factor.
fn arc<V: VectorSpace>(
    centre: V,
    [start, end]: [V; 2],
    [w0, w2]: [f64; 2],
    length: impl Fn(V) -> f64,
    dot: impl Fn(V, V) -> f64,
    turn: impl Fn(V) -> V,
) -> Result<Quadratic<V>, Error> {
    if ![centre, start, end].iter().all(|v| v.is_finite()) || !w0.is_finite() || !w2.is_finite() {
        return Err(Error::NonFinite {
            what: "centre, end point or end weight",
        });
    }
    if !(w0 > 0.0 && w2 > 0.0) {
        return Err(Error::NonPositiveEndWeight { start: w0, end: w2 });
    }
    let radii = [length(start.minus(centre)), length(end.minus(centre))];
    let chord = end.minus(start);
    if length(chord) <= COINCIDENT * radii[0].max(radii[1]) {
        return Err(Error::CoincidentEnds {
            distance: length(chord),
        });
    }
    if (radii[0] - radii[1]).abs() > ON_CIRCLE * radii[0].max(radii[1]) {
        return Err(Error::NotOnCommonCircle {
            start: radii[0],
            end: radii[1],
        });
    }
    let midpoint = start.lerp(end, 0.5);
    let turned = turn(chord);
    let mut away = turned.times(1.0 / length(turned));
    // The height of the chord over the centre and half its length give the radius of the circle through both ends.
    let mut height = dot(midpoint.minus(centre), away);
    let half_chord = 0.5 * length(chord);
    let radius = height.hypot(half_chord);
    if height.abs() <= DIAMETER * radius {
        height = 0.0;
    } else if height < 0.0 {
        (height, away) = (-height, away.times(-1.0));
    }
    let (cosine, reach) = (height / radius, half_chord * half_chord / radius);
    let middle =
        MassPoint::from_homogeneous(cosine, midpoint.times(cosine).plus(away.times(reach)));
    Quadratic::new([
        MassPoint::point(start, w0),
        middle.times((w0 * w2).sqrt()),
        MassPoint::point(end, w2),
    ])
}

/// Which of the two halves of a conic between diametrically opposite points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Half {
    /// The half that starts in the direction of the arc it is made from.
    #[default]
    Along,
    /// The half that starts the other way.
    Against,
}

impl Half {
    fn sign(self) -> f64 {
        match self {
            Self::Along => 1.0,
            Self::Against => -1.0,
        }
    }
}

impl<V: VectorSpace> Quadratic<V> {
    /// The half of the conic from the start of this arc to the point opposite to it through the centre, with a vector
    /// as middle control: the conic as a semicircle of its own quadratic form.
    ///
    /// On an ellipse the end weight has the sign of the start weight. On a hyperbola it has the other sign and the half
    /// runs to the other branch through infinity, which it meets at `t = 1/2` in the direction of an asymptote
    /// (Theorem 2, there with unit weights: the parameter change with `b = 1 / sqrt(w1^2 - 1)`).
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if the start is a vector; [`Error::NoCentre`] for a parabola.
    pub fn half_conic(&self, half: Half) -> Result<Self, Error> {
        let [h0, h1, h2] = *self.control();
        if h0.is_vector() {
            return Err(Error::AtInfinity { t: 0.0 });
        }
        let (w0, w1, w2) = (h0.weight, h1.weight, h2.weight);
        let discriminant = w1 * w1 - w0 * w2;
        if discriminant.abs() <= PARABOLA * (w1 * w1 + (w0 * w2).abs()) {
            return Err(Error::NoCentre { discriminant });
        }
        // Blossom values at the parameters (0 : 1) and (b : b + B), the latter chosen to cancel the middle weight.
        let b = half.sign() * w0.abs() / discriminant.abs().sqrt();
        let big_b = -b * w1 / w0;
        let middle = MassPoint::vector(h0.weighted.times(big_b).plus(h1.weighted.times(b)));
        let end = h0 * (big_b * big_b) + h1 * (2.0 * b * big_b) + h2 * (b * b);
        // The sum's weight is this up to rounding, and the ends' weights should cancel exactly where they do.
        let end = MassPoint::from_homogeneous(-w0 * discriminant.signum(), end.weighted);
        Self::new([h0, middle, end])
    }

    /// Theorem 2: the hyperbola of the arc `(P0; 1), (P1; w1), (P2; 1)` with `w1 > 1` as a semicircle `(Q0; 1)`,
    /// `(Q1; 0)`, `(Q2; -1)` of its quadratic form.
    ///
    /// `Q0 = P0`, `Q1 = +-w1 k (P1 - P0)` (plus for [`Half::Along`]) with `k = 1 / sqrt(w1^2 - 1)`, and `Q2` is `P0`
    /// reflected in the centre. This is the same conic but another arc: it passes through infinity at `t = 1/2`.
    ///
    /// # Errors
    /// [`Error::MiddleWeightNotAboveOne`]; [`Error::NonFinite`]; [`Error::NoCentre`] if the weight exceeds one by
    /// rounding only.
    pub fn hyperbola_as_semicircle(
        points: [V; 3],
        middle_weight: f64,
        half: Half,
    ) -> Result<Self, Error> {
        let [p0, p1, p2] = points;
        let weight = middle_weight;
        let arc = Self::new([
            MassPoint::point(p0, 1.0),
            MassPoint::point(p1, weight),
            MassPoint::point(p2, 1.0),
        ])?;
        if weight <= 1.0 {
            return Err(Error::MiddleWeightNotAboveOne { weight });
        }
        arc.half_conic(half)
    }

    /// The centre of the conic as a mass point `(D; a)` with `D = w1^2 - w0 w2`: a point for an ellipse (`D < 0`) and a
    /// hyperbola (`D > 0`), the vector along the axis for a parabola. It is the pole of the line at infinity.
    #[must_use]
    pub fn centre(&self) -> MassPoint<V> {
        let [h0, h1, h2] = *self.control();
        let (w0, w1, w2) = (h0.weight, h1.weight, h2.weight);
        let ends = h0.weighted.times(w2).plus(h2.weighted.times(w0)).times(0.5);
        let centre =
            MassPoint::from_homogeneous(w1 * w1 - w0 * w2, h1.weighted.times(w1).minus(ends));
        centre.settled(w1 * w1 + (w0 * w2).abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec2, dvec3};

    const O: DVec2 = DVec2::ZERO;

    #[test]
    fn arcs_of_every_opening_are_on_the_circle() -> Result<(), Error> {
        let centre = dvec2(3.0, -2.0);
        for degrees in [1.0_f64, 60.0, 120.0, 179.0, 179.999_999, 180.0, 180.000_001] {
            let ends =
                [0.0, degrees.to_radians()].map(|angle| centre + 5.0 * DVec2::from_angle(angle));
            let arc = Quadratic::circular_arc(centre, ends, [2.0, 0.5])?;
            for curve in [arc, arc.complement()] {
                for i in 0..=20 {
                    let distance = curve.point(f64::from(i) / 20.0)?.distance(centre);
                    assert!(
                        (distance - 5.0).abs() < 1e-13,
                        "{degrees} degrees at {i}/20: {distance}"
                    );
                }
            }
        }
        Ok(())
    }

    #[test]
    fn arcs_by_angles_reach_almost_a_full_turn_either_way() -> Result<(), Error> {
        for degrees in [-359.0_f64, -180.0, -10.0, 90.0, 180.0, 270.0, 359.0] {
            let arc = Quadratic::circular_arc_by_angles(O, 2.0, 0.5, 0.5 + degrees.to_radians())?;
            let half = 0.5 * degrees.to_radians();
            let middle = DVec2::from_angle(0.5 + half) * 2.0;
            // The weight in the middle is (1 + cos)/2, a difference of nearly equal numbers for almost a full turn.
            let tolerance = 4e-15 / (1.0 + half.cos());
            assert!(
                (arc.point(0.5)? - middle).length() < tolerance,
                "{degrees} degrees"
            );
        }
        assert!(Quadratic::circular_arc_by_angles(O, 1.0, 0.0, core::f64::consts::TAU).is_err());
        assert!(Quadratic::circular_arc_by_angles(O, 0.0, 0.0, 1.0).is_err());
        assert!(Quadratic::circular_arc_by_angles(O, 1.0, 0.0, f64::NAN).is_err());
        Ok(())
    }

    #[test]
    fn semicircles_in_space_turn_about_the_axis() -> Result<(), Error> {
        let ends = [dvec3(1.0, 0.0, 0.0), dvec3(-1.0, 0.0, 0.0)];
        let arc = Quadratic::circular_arc_about_axis(DVec3::ZERO, DVec3::Z, ends, [1.0, 1.0])?;
        assert_eq!(arc.control()[1], MassPoint::vector(-DVec3::Y));
        assert!((arc.point(0.5)? + DVec3::Y).length() < 1e-15);
        assert!(
            Quadratic::circular_arc_about_axis(DVec3::ZERO, DVec3::X, ends, [1.0, 1.0]).is_err()
        );
        Ok(())
    }

    #[test]
    fn wrong_arcs_are_refused_with_their_numbers() {
        let (x, y) = (DVec2::X, DVec2::Y);
        let arc = Quadratic::circular_arc;
        assert!(matches!(
            arc(O, [x, 2.0 * y], [1.0, 1.0]),
            Err(Error::NotOnCommonCircle {
                start: 1.0,
                end: 2.0
            })
        ));
        assert!(matches!(
            arc(O, [x, y], [1.0, -1.0]),
            Err(Error::NonPositiveEndWeight { .. })
        ));
        assert!(matches!(
            arc(O, [x, x], [1.0, 1.0]),
            Err(Error::CoincidentEnds { .. })
        ));
        assert!(matches!(
            arc(O, [O, O], [1.0, 1.0]),
            Err(Error::CoincidentEnds { .. })
        ));
        assert!(matches!(
            arc(O, [x, DVec2::NAN], [1.0, 1.0]),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            arc(O, [x, y], [1.0, f64::NAN]),
            Err(Error::NonFinite { .. })
        ));
    }

    #[test]
    fn a_hyperbola_as_a_semicircle_reaches_the_other_branch_through_an_asymptote()
    -> Result<(), Error> {
        let points = [dvec2(0.0, 0.0), dvec2(1.0, 2.0), dvec2(3.0, 0.0)];
        let half = Quadratic::hyperbola_as_semicircle(points, 2.0, Half::Along)?;
        let [q0, q1, q2] = *half.control();
        let centre = half.centre().position().unwrap_or(DVec2::NAN);
        assert_eq!((q0.weight, q1.weight), (1.0, 0.0));
        assert!((q2.weight + 1.0).abs() < 1e-15);
        assert!((q2.position().unwrap_or(DVec2::NAN) + points[0] - 2.0 * centre).length() < 1e-14);
        let at_infinity = half.at(0.5);
        assert!(at_infinity.is_vector());
        assert!((at_infinity.weighted - 0.5 * (points[0] - centre + q1.weighted)).length() < 1e-14);
        assert!(matches!(
            Quadratic::hyperbola_as_semicircle(points, 1.0, Half::Along),
            Err(Error::MiddleWeightNotAboveOne { .. })
        ));
        Ok(())
    }

    #[test]
    fn half_an_ellipse_and_no_half_of_a_parabola() -> Result<(), Error> {
        let (x, y) = (DVec2::X, DVec2::Y);
        let quarter = Quadratic::circular_arc(O, [x, y], [1.0, 1.0])?;
        let half = quarter.half_conic(Half::Along)?;
        assert!((half.point(1.0)? + x).length() < 1e-15);
        assert!((half.point(0.5)? - y).length() < 1e-15);
        assert!((quarter.half_conic(Half::Against)?.point(0.5)? + y).length() < 1e-15);
        let parabola = Quadratic::new([O, x, y].map(|p| MassPoint::point(p, 1.0)))?;
        assert!(matches!(
            parabola.half_conic(Half::Along),
            Err(Error::NoCentre { .. })
        ));
        assert!(parabola.centre().is_vector());
        let branch = Quadratic::new([
            MassPoint::vector(x),
            MassPoint::point(O, 1.0),
            MassPoint::vector(y),
        ])?;
        assert!(matches!(
            branch.half_conic(Half::Along),
            Err(Error::AtInfinity { .. })
        ));
        assert_eq!(branch.centre().position(), Some(O));
        Ok(())
    }
}
