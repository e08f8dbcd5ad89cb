//! Dual Bézier curves: the envelope of a line whose coordinates are Bernstein polynomials.

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
        self.vectors.iter().filter_map(|&u| Line::try_from(u).ok())
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

    /// The tangent line vector and its first two derivatives at `t`.
    fn jet(&self, t: f64) -> [DVec3; 3] {
        let first = bernstein::derivative(&self.vectors);
        let second = bernstein::derivative(&first);
        [&self.vectors, &first, &second].map(|coefficients| bernstein::evaluate(coefficients, t))
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
    /// the line at infinity or the normal is stationary (an inflection).
    pub fn contact(&self, t: f64) -> Result<Contact, Error> {
        if !t.is_finite() {
            return Err(Error::NonFinite {
                what: "a parameter",
            });
        }
        let [u, du, ddu] = self.jet(t);
        let normal = DVec2::new(u.y, u.z);
        let length = normal.length();
        let point = u.cross(du);
        if length == 0.0 || point.x == 0.0 {
            return Err(Error::AtInfinity { t });
        }
        // R = -det(U, U', U'') |n|^3 / s^3, with s the weight of the point.
        let ratio = length / point.x;
        Ok(Contact {
            point: DVec2::new(point.y, point.z) / point.x,
            normal: normal / length,
            support: -u.x / length,
            radius: -point.dot(ddu) * ratio * ratio * ratio,
        })
    }

    /// `u1 u2' - u2 u1'` at `t`: the angular speed of the normal times its squared length. Its roots are
    /// the inflections.
    #[must_use]
    pub fn turn(&self, t: f64) -> f64 {
        let [u, du, _] = self.jet(t);
        u.y * du.z - u.z * du.y
    }

    /// Homogeneous Bernstein coefficients `(x0, x1, x2)` of the point curve, of degree 2m - 2: the
    /// cross product `U x U' / m`, whose nominal degree 2m - 1 always drops by one.
    #[must_use]
    pub fn point_control(&self) -> Vec<DVec3> {
        let (head, tail) = (&self.vectors[..self.class()], &self.vectors[1..]);
        bernstein::product_with(head, tail, |a, b| a.cross(*b))
    }

    /// The exact rational point curve, with mass points `(x0; x1, x2)` as control points.
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if the control points are not those of a curve (all of them vanish).
    pub fn to_points(&self) -> Result<BezierCurve<DVec2>, Error> {
        rational_curve(&self.point_control())
    }

    /// The dual form of a rational point curve, by the same formula: the line through the point and its
    /// derivative. `control` are homogeneous vectors `(x0, x1, x2)`.
    ///
    /// The class is 2n - 2 for degree n, less where the curve has inflections or cusps whose factors divide out.
    ///
    /// # Errors
    /// [`Error::TooFew`] below degree 2, [`Error::NonFinite`], [`Error::ZeroLine`] where a control line is
    /// undefined even after division by common factors (a straight or degenerate curve).
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
        let n = control.len() - 1;
        Self::from_vectors(&bernstein::product_with(
            &control[..n],
            &control[1..],
            |a, b| a.cross(*b),
        ))
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
    /// [`Error::TooFew`] unless there is a distance for every line.
    pub fn translate_lines(&self, distances: &[f64]) -> Result<Self, Error> {
        if distances.len() != self.vectors.len() {
            let needed = self.vectors.len();
            return Err(Error::TooFew {
                what: "distances",
                given: distances.len(),
                needed,
            });
        }
        let moved: Result<Vec<Line>, Error> = self
            .vectors
            .iter()
            .zip(distances)
            .map(|(&u, &distance)| Ok(Line::try_from(u)?.offset(distance)))
            .collect();
        Self::new(&moved?)
    }

    /// The curve moved by `vector`.
    #[must_use]
    pub fn translate(&self, vector: DVec2) -> Self {
        self.map(|line| line.translate(vector))
    }

    /// The curve turned about the origin by the argument of the unit complex number `turn`.
    #[must_use]
    pub fn rotate(&self, turn: DVec2) -> Self {
        self.map(|line| line.rotate(turn))
    }

    fn map(&self, motion: impl Fn(Line) -> Line) -> Self {
        Self {
            vectors: self
                .lines()
                .map(|line| motion(line).coordinates())
                .collect(),
        }
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
