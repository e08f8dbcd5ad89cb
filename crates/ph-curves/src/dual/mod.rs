//! Dual Bézier curves: the envelope of a line whose coordinates are Bernstein polynomials.

mod common_factor;
mod events;

use bezier_mass::{BezierCurve, MassPoint, bernstein};
use glam::{DVec2, DVec3};

use crate::{Contact, Error, Line, PhArc};

/// Size of a cross product of two control lines, relative to the product of their sizes, below which
/// the lines count as one and the same: some ulps of the cross product.
const COINCIDENT: f64 = 1e-14;

/// The envelope of the line `U(t) = sum B_i b_i^m(t)`, a curve of class m given by its m + 1 Bézier lines.
///
/// A Bézier line is a [`Line`] with its weight; together they are the *lateral*, its consecutive lines
/// meet in the Bézier vertices, and the Farin line `B_i + B_{i+1}` through each vertex fixes the weights
/// without reference to an origin.
///
/// ```text
///            B1   F1   B2
///              \   |   /
///      B0 ______\__|__/_______  the curve touches B0 where it meets B1,
///                \ | /   ,-'    and the last line where it meets the one before
///                 \|/ ,-'
/// ```
///
/// Sources: Hoschek's dual Bézier curves; Pottmann's Farin lines; equations (1.1) to (1.3) of the thesis chapter.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<Line>", into = "Vec<Line>"))]
pub struct DualCurve {
    vectors: Vec<DVec3>,
}

impl DualCurve {
    /// The curve with these Bézier lines.
    ///
    /// # Errors
    /// [`Error::Pencil`] for fewer than three lines.
    pub fn new(lines: &[Line]) -> Result<Self, Error> {
        if lines.len() < 3 {
            return Err(Error::Pencil {
                class: lines.len().saturating_sub(1),
            });
        }
        Ok(Self {
            vectors: lines.iter().map(|line| line.coordinates()).collect(),
        })
    }

    /// The curve with these line coordinate vectors.
    ///
    /// # Errors
    /// [`Error::NonFinite`], [`Error::ZeroLine`] with the position of a zero vector, [`Error::Pencil`].
    pub fn from_vectors(vectors: &[DVec3]) -> Result<Self, Error> {
        let lines: Result<Vec<Line>, Error> = vectors
            .iter()
            .enumerate()
            .map(|(index, &u)| {
                Line::try_from(u).map_err(|error| match error {
                    Error::ZeroLine { .. } => Error::ZeroLine { index },
                    other => other,
                })
            })
            .collect();
        Self::new(&lines?)
    }

    /// The curve with the given Bézier lines and Farin lines, each in any scale; the first line keeps its scale.
    ///
    /// # Errors
    /// [`Error::FarinCount`]; [`Error::CoincidentLines`] if two consecutive lines, or a Farin line and one
    /// of its Bézier lines, are the same line; [`Error::Pencil`].
    pub fn from_farin(lines: &[Line], farin: &[Line]) -> Result<Self, Error> {
        if farin.len() + 1 != lines.len() {
            return Err(Error::FarinCount {
                lines: lines.len(),
                farin: farin.len(),
            });
        }
        let mut weight = 1.0;
        let mut vectors: Vec<DVec3> = lines
            .iter()
            .take(1)
            .map(|line| line.coordinates())
            .collect();
        for (index, (pair, farin)) in lines.windows(2).zip(farin).enumerate() {
            let [b0, b1, f] = [
                pair[0].coordinates(),
                pair[1].coordinates(),
                farin.coordinates(),
            ];
            let (c0, c1) = (b0.cross(f), b1.cross(f));
            let degenerate =
                |c: DVec3, a: DVec3, b: DVec3| c.length() <= COINCIDENT * a.length() * b.length();
            if degenerate(c0, b0, f) || degenerate(c1, b1, f) || degenerate(b0.cross(b1), b0, b1) {
                return Err(Error::CoincidentLines { index });
            }
            weight *= -c0.dot(c1) / c1.dot(c1);
            vectors.push(b1 * weight);
        }
        Self::from_vectors(&vectors)
    }

    /// The class m: number of Bézier lines less one.
    #[must_use]
    pub fn class(&self) -> usize {
        self.vectors.len() - 1
    }

    /// The line coordinate vectors of the Bézier lines.
    #[must_use]
    pub fn vectors(&self) -> &[DVec3] {
        &self.vectors
    }

    /// The Bézier lines.
    pub fn lines(&self) -> impl Iterator<Item = Line> + '_ {
        self.vectors.iter().map(|&u| Line::unchecked(u))
    }

    /// The m Farin lines `B_i + B_{i+1}`, as coordinate vectors (zero where the two lines cancel).
    #[must_use]
    pub fn farin(&self) -> Vec<DVec3> {
        self.vectors
            .windows(2)
            .map(|pair| pair[0] + pair[1])
            .collect()
    }

    /// The m Bézier vertices `B_i x B_{i+1}` in homogeneous coordinates `(x0, x1, x2)`.
    #[must_use]
    pub fn vertices(&self) -> Vec<DVec3> {
        self.vectors
            .windows(2)
            .map(|pair| pair[0].cross(pair[1]))
            .collect()
    }

    /// The tangent line at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroLine`] where the coordinates vanish together.
    pub fn tangent(&self, t: f64) -> Result<Line, Error> {
        Line::try_from(bernstein::evaluate(&self.vectors, t))
    }

    /// Point of contact, unit normal, support and signed radius at `t`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] for a parameter that is not finite; [`Error::AtInfinity`] where the tangent is
    /// the line at infinity or the normal is stationary (an inflection), or so nearly that the numbers overflow.
    pub fn contact(&self, t: f64) -> Result<Contact, Error> {
        if !t.is_finite() {
            return Err(Error::NonFinite {
                what: "a parameter",
            });
        }
        let (vectors, unit) = normalised(&self.vectors);
        let [u, du, ddu] = jet(&vectors, t);
        let normal = DVec2::new(u.y, u.z);
        let length = normal.length();
        let point = u.cross(du);
        if length == 0.0 || point.x == 0.0 {
            return Err(Error::AtInfinity { t });
        }
        // R = -det(U, U', U'') |n|^3 / s^3, with s the weight of the point.
        let ratio = length / point.x;
        let contact = Contact {
            point: DVec2::new(point.y, point.z) / point.x * unit,
            normal: normal / length,
            support: -u.x / length * unit,
            radius: -point.dot(ddu) * ratio * ratio * ratio * unit,
        };
        if contact.point.is_finite() && contact.radius.is_finite() {
            Ok(contact)
        } else if u.is_finite() {
            Err(Error::AtInfinity { t })
        } else {
            Err(Error::NonFinite {
                what: "a line coordinate",
            })
        }
    }

    /// `u1 u2' - u2 u1'` at `t`: the angular speed of the normal times its squared length. Its roots are
    /// the inflections.
    #[must_use]
    pub fn turn(&self, t: f64) -> f64 {
        let [u, du, _] = jet(&self.vectors, t);
        u.y * du.z - u.z * du.y
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point curve, of degree 2m - 2: the
    /// cross product `U x U' / m`, whose nominal degree 2m - 1 always drops by one.
    #[must_use]
    pub fn point_control(&self) -> Vec<DVec3> {
        events::point_control(&self.vectors)
    }

    /// The exact rational point curve, with mass points `(x0; x1, x2)` as control points.
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if the control points are not those of a curve: all of them vanish where all lines are
    /// one and the same. [`Error::NonFinite`] if they overflow.
    pub fn to_points(&self) -> Result<BezierCurve<DVec2>, Error> {
        if common_factor::is_one_line(&normalised(&self.vectors).0) {
            return Err(Error::AtInfinity { t: 0.0 });
        }
        rational_curve(&self.point_control())
    }

    /// The dual form of a rational point curve, by the same formula: the line through the point and its
    /// derivative. `control` are homogeneous vectors `(x0, x1, x2)`.
    ///
    /// The class is 2n - 2 for degree n, less the degree of the factor that the three line coordinates have in common
    /// (to rounding): at cusps and other stationary points, inside of `[0, 1]` or not (the graph of a cubic function has
    /// one at infinity), and for a curve whose degree is elevated. Inflections leave none.
    ///
    /// # Errors
    /// [`Error::TooFew`] below degree 2; [`Error::NonFinite`], also if line coordinates overflow; [`Error::NoTurning`] for a
    /// straight curve; [`Error::ZeroLine`] where a control line is undefined even after division by the common factor
    /// (all of them for a point).
    pub fn from_points(control: &[DVec3]) -> Result<Self, Error> {
        if control.len() < 3 {
            return Err(Error::TooFew {
                what: "control points",
                given: control.len(),
                needed: 3,
            });
        }
        if !control.iter().all(|x| x.is_finite()) {
            return Err(Error::NonFinite {
                what: "a control point",
            });
        }
        let lines = events::point_control(control);
        let straight = common_factor::is_one_line(&normalised(&lines).0);
        if straight && lines.iter().any(|u| *u != DVec3::ZERO) {
            return Err(Error::NoTurning { turning: 0.0 });
        }
        // About an origin near to the curve the factor keeps its digits.
        let sum: DVec3 = control.iter().copied().sum();
        let centre = DVec2::new(sum.y, sum.z) / sum.x;
        let centre = if centre.is_finite() {
            centre
        } else {
            DVec2::ZERO
        };
        let local: Vec<DVec3> = control
            .iter()
            .map(|x| *x - DVec3::new(0.0, x.x * centre.x, x.x * centre.y))
            .collect();
        let (scaled, unit) = normalised(&events::point_control(&local));
        match common_factor::without_common_factor(&scaled) {
            Some(reduced) => {
                let plane = DVec3::new(unit, 1.0, 1.0);
                let reduced: Vec<DVec3> = reduced.iter().map(|u| *u * plane).collect();
                Self::from_vectors(&reduced)?.translate(centre)
            }
            None => Self::from_vectors(&lines),
        }
    }

    /// The same curve with one Bézier line more.
    #[must_use]
    pub fn elevate(&self) -> Self {
        Self {
            vectors: bernstein::elevate(&self.vectors),
        }
    }

    /// The two parts at `t`; both keep the scale of the coordinates.
    ///
    /// # Errors
    /// [`Error::OutsideDomain`] unless `0 < t < 1`; [`Error::ZeroLine`] if a new control vector vanishes.
    pub fn split(&self, t: f64) -> Result<(Self, Self), Error> {
        if !(t > 0.0 && t < 1.0) {
            return Err(Error::OutsideDomain {
                value: t,
                start: 0.0,
                end: 1.0,
            });
        }
        let (left, right) = bernstein::subdivide(&self.vectors, t);
        Ok((Self::from_vectors(&left)?, Self::from_vectors(&right)?))
    }

    /// The curve with Bézier line `i` moved by `distances[i]` along its normal. The offset of a PH curve is
    /// such a translation, by the distances of [`PhArc::control_distances`].
    ///
    /// # Errors
    /// [`Error::TooFew`] unless there is a distance for every line; [`Error::NonFinite`] if one is not finite or a line
    /// coordinate overflows.
    pub fn translate_lines(&self, distances: &[f64]) -> Result<Self, Error> {
        if distances.len() != self.vectors.len() {
            let needed = self.vectors.len();
            return Err(Error::TooFew {
                what: "distances",
                given: distances.len(),
                needed,
            });
        }
        let moved = self.lines().zip(distances);
        Self::from_lines(moved.map(|(line, &distance)| line.offset(distance)))
    }

    /// The curve moved by `vector`.
    ///
    /// # Errors
    /// [`Error::NonFinite`] if the vector is not finite or a line coordinate overflows.
    pub fn translate(&self, vector: DVec2) -> Result<Self, Error> {
        Self::from_lines(self.lines().map(|line| line.translate(vector)))
    }

    /// The curve turned about the origin by the argument of the complex number `turn`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`] if `turn` is zero.
    pub fn rotate(&self, turn: DVec2) -> Result<Self, Error> {
        Self::from_lines(self.lines().map(|line| line.rotate(turn)))
    }

    fn from_lines(lines: impl Iterator<Item = Result<Line, Error>>) -> Result<Self, Error> {
        Self::new(&lines.collect::<Result<Vec<_>, _>>()?)
    }
}

/// The tangent line vector and its first two derivatives at `t`.
fn jet(vectors: &[DVec3], t: f64) -> [DVec3; 3] {
    let first = bernstein::derivative(vectors);
    let second = bernstein::derivative(&first);
    [vectors, &first, &second].map(|coefficients| bernstein::evaluate(coefficients, t))
}

/// The line vectors with constant terms and normals of size 1, so that products of them neither overflow nor vanish, and
/// the length that is 1 in the plane of these. All factors are powers of two.
fn normalised(vectors: &[DVec3]) -> (Vec<DVec3>, f64) {
    let size = vectors
        .iter()
        .map(|u| u.abs())
        .fold(DVec3::ZERO, DVec3::max);
    let (constant, normal) = (power_of_two(size.x), power_of_two(size.y.max(size.z)));
    let units = DVec3::new(constant, normal, normal);
    let scaled = vectors.iter().map(|&u| u / units).collect();
    (scaled, constant / normal)
}

/// The largest power of two up to a positive number; 1 for others.
fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    if x > 0.0 && x.is_finite() {
        f64::from_bits(x.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
    } else {
        1.0
    }
}

/// The rational curve with homogeneous control vectors `(x0, x1, x2)`.
pub(crate) fn rational_curve(control: &[DVec3]) -> Result<BezierCurve<DVec2>, Error> {
    let points = control
        .iter()
        .map(|x| MassPoint::from_homogeneous(x.x, DVec2::new(x.y, x.z)))
        .collect();
    BezierCurve::new(points).map_err(|_| Error::NonFinite {
        what: "a control point",
    })
}

impl TryFrom<Vec<Line>> for DualCurve {
    type Error = Error;

    fn try_from(lines: Vec<Line>) -> Result<Self, Error> {
        Self::new(&lines)
    }
}

impl From<DualCurve> for Vec<Line> {
    fn from(curve: DualCurve) -> Self {
        curve.lines().collect()
    }
}

impl<const N: usize> From<&PhArc<N>> for DualCurve {
    fn from(arc: &PhArc<N>) -> Self {
        Self {
            vectors: arc.control_vectors().to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc() -> crate::TQuartic {
        PhArc::new(
            DVec2::new(1.0, 0.1),
            DVec2::new(0.7, 0.9),
            [0.4, 0.9, 1.3, 0.8],
        )
        .unwrap()
    }

    fn straight_or_curved(points: &[(f64, f64)]) -> Result<DualCurve, Error> {
        let control: Vec<DVec3> = points.iter().map(|p| DVec3::new(1.0, p.0, p.1)).collect();
        DualCurve::from_points(&control)
    }

    #[test]
    fn hostile_motions_are_refused() {
        let curve = DualCurve::from(&arc());
        let far = DVec2::splat(1e308);
        for bad in [DVec2::NAN, DVec2::INFINITY] {
            assert!(curve.translate(bad).is_err() && curve.rotate(bad).is_err());
        }
        assert!(curve.rotate(DVec2::ZERO).is_err());
        assert!(curve.translate_lines(&[f64::NAN, 0.0, 0.0, 0.0]).is_err());
        assert!(curve.translate(far).and_then(|c| c.translate(far)).is_err());
        let moved = curve
            .translate(DVec2::ONE)
            .and_then(|c| c.rotate(DVec2::Y))
            .unwrap();
        let expected = DVec2::Y.rotate(arc().point(0.4) + DVec2::ONE);
        assert!((moved.contact(0.4).unwrap().point - expected).length() < 1e-14);
        // An arc may overflow; its dual form keeps its class.
        let overflown = DualCurve::from(&arc().translate(DVec2::NAN));
        assert_eq!((overflown.class(), overflown.lines().count()), (3, 4));
        assert!(overflown.translate(DVec2::ONE).is_err());
    }

    #[test]
    fn the_round_trip_of_a_quartic_has_its_class() {
        for scale in [1.0, 1e-7, 1e9] {
            let curve = DualCurve::from(&arc().scale(scale));
            let back = DualCurve::from_points(&curve.point_control()).unwrap();
            assert_eq!(back.class(), 3);
            for t in [0.0, 0.2, 0.7, 1.0] {
                let (a, b) = (curve.contact(t).unwrap(), back.contact(t).unwrap());
                assert!((a.point - b.point).length() < 1e-12 * scale);
                // The normals may be the opposite ones.
                assert!(a.normal.perp_dot(b.normal).abs() < 1e-12);
                assert!((a.centre() - b.centre()).length() < 1e-10 * scale);
            }
        }
    }

    #[test]
    fn stationary_points_divide_out() {
        // A zero end handle, and an inner cusp.
        for points in [
            [(0.0, 0.0), (0.0, 0.0), (1.0, 2.0), (3.0, 0.0)],
            [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)],
        ] {
            let curve = straight_or_curved(&points).unwrap();
            assert_eq!(curve.class(), 3);
            let control = points.map(DVec2::from);
            for t in [0.1, 0.9] {
                let tangent = bernstein::evaluate(&bernstein::derivative(&control), t);
                let contact = curve.contact(t).unwrap();
                assert!((contact.point - bernstein::evaluate(&control, t)).length() < 1e-12);
                assert!(contact.normal.dot(tangent).abs() < 1e-12);
            }
        }
        // Elevation divides out too.
        let parabola = [(0.0, 0.0), (1.0, 2.0), (3.0, 0.0)].map(DVec2::from);
        let elevated: Vec<(f64, f64)> = bernstein::elevate_to(&parabola, 5)
            .iter()
            .map(|p| (p.x, p.y))
            .collect();
        assert_eq!(straight_or_curved(&elevated).unwrap().class(), 2);
        // The graph of a cubic function has its cusp at infinity, other cubics have none.
        let graph = [(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 0.0)];
        assert_eq!(straight_or_curved(&graph).unwrap().class(), 3);
        let plain = [(0.0, 0.0), (1.0, 2.0), (2.5, -2.0), (3.0, 0.0)];
        assert_eq!(straight_or_curved(&plain).unwrap().class(), 4);
    }

    #[test]
    fn lines_and_points_have_no_dual_form() {
        let straight = [(0.0, 0.0), (1.0, 2.0), (2.0, 4.0), (5.0, 10.0)];
        assert!(matches!(
            straight_or_curved(&straight),
            Err(Error::NoTurning { .. })
        ));
        assert!(matches!(
            straight_or_curved(&[(1.0, 2.0); 4]),
            Err(Error::ZeroLine { index: 0 })
        ));
        let same = DualCurve::from_vectors(&[DVec3::ONE; 3]).unwrap();
        assert!(matches!(same.to_points(), Err(Error::AtInfinity { .. })));
    }
}
