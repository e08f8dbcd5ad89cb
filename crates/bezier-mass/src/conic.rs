//! The features of a plane conic: type, centre, axes, foci, vertices, directrices, asymptotes.

use crate::{MassPoint, Quadratic, VectorSpace};
use glam::{DMat2, DVec2};

/// The conic is a parabola if `D = w1^2 - w0 w2` is below this fraction of its terms: weights carry a few units in the
/// last place, those of repeatedly subdivided arcs a decade or two more.
pub(crate) const PARABOLA: f64 = 1e-12;

/// The control triple is degenerate if the determinant of its homogeneous vectors is below this fraction of the product
/// of their lengths, measured from one of them in units of the net's size.
const DEGENERATE: f64 = 1e-12;

/// Control points that differ by less than this fraction of their coordinates are one point.
const COINCIDENT: f64 = 8.0 * f64::EPSILON;

/// An ellipse whose squared semi-axes differ by less than this fraction is a circle (eccentricity below 1e-6). On a short
/// arc the weights determine the axes only to `epsilon / |D|`, and that widens it.
const CIRCLE: f64 = 1e-12;

/// The conic that a plane quadratic is an arc of.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Conic {
    /// A circle.
    Circle(Circle),
    /// An ellipse that is not a circle.
    Ellipse(CentralConic),
    /// A parabola.
    Parabola(Parabola),
    /// A hyperbola.
    Hyperbola(CentralConic),
    /// Not a proper conic: the control mass points are linearly dependent.
    Degenerate(Degenerate),
}

/// A straight line of the plane, `normal . x = offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Line {
    /// A unit normal.
    pub normal: DVec2,
    /// The signed distance of the line from the origin along the normal.
    pub offset: f64,
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Circle {
    /// The centre.
    pub centre: DVec2,
    /// The radius, positive.
    pub radius: f64,
}

/// A conic with a centre that is not a circle: an ellipse or a hyperbola.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CentralConic {
    /// The centre.
    pub centre: DVec2,
    /// The unit direction of the axis through the foci, its first non-zero coordinate positive.
    pub major_direction: DVec2,
    /// The squares of the semi-axes along the major direction and across; the second is negative for a hyperbola.
    pub squared_semi_axes: [f64; 2],
}

/// A parabola.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Parabola {
    /// The focus.
    pub focus: DVec2,
    /// The directrix; its normal points to the focus, along the axis and into the parabola.
    pub directrix: Line,
}

/// What remains of a conic whose control mass points are linearly dependent.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Degenerate {
    /// All points of the curve are on one line.
    Line {
        /// A point of the line.
        point: DVec2,
        /// The unit direction of the line.
        direction: DVec2,
    },
    /// The curve is a single point.
    Point(DVec2),
    /// All control mass points are vectors: the curve is in the line at infinity.
    AtInfinity,
}

impl Quadratic<DVec2> {
    /// The conic that this curve is an arc of, with all its features. Weights may have any sign, and control mass points
    /// may be vectors: the formulas have no case for them.
    ///
    /// ```
    /// use bezier_mass::{Conic, MassPoint, Quadratic, glam::dvec2};
    /// // Half an ellipse: the control vector in the middle is a conjugate semi-diameter.
    /// let half = Quadratic::new([
    ///     MassPoint::point(dvec2(2.0, 0.0), 1.0),
    ///     MassPoint::vector(dvec2(0.0, 3.0)),
    ///     MassPoint::point(dvec2(-2.0, 0.0), 1.0),
    /// ])?;
    /// assert!(matches!(half.conic(), Conic::Ellipse(ellipse) if ellipse.semi_axes() == [3.0, 2.0]));
    /// # Ok::<(), bezier_mass::Error>(())
    /// ```
    #[must_use]
    pub fn conic(&self) -> Conic {
        let control = *self.control();
        let Some(origin) = heaviest(&control).and_then(MassPoint::position) else {
            return Conic::Degenerate(Degenerate::AtInfinity);
        };
        let about_origin = control.map(|h| h.translated(-origin));
        let size = largest(about_origin.map(|h| h.weighted.length()));
        if size <= COINCIDENT * largest(control.map(|h| h.weighted.length())) {
            return Conic::Degenerate(Degenerate::Point(origin));
        }
        // Local coordinates in which the largest weight and the largest weighted position are one.
        let weight = largest(control.map(|h| h.weight.abs()));
        let local =
            about_origin.map(|h| MassPoint::from_homogeneous(h.weight / weight, h.weighted / size));
        let determinant = determinant(local);
        let lengths: f64 = local
            .iter()
            .map(|h| h.weight.hypot(h.weighted.length()))
            .product();
        let conic = if determinant.abs() > DEGENERATE * lengths {
            proper(local, determinant)
        } else {
            None
        };
        conic
            .unwrap_or_else(|| Conic::Degenerate(line_of(local)))
            .placed(origin, size / weight)
    }
}

fn largest(numbers: [f64; 3]) -> f64 {
    numbers.into_iter().fold(0.0, f64::max)
}

/// The control mass point with the largest absolute weight.
pub(crate) fn heaviest<V: VectorSpace>(control: &[MassPoint<V>; 3]) -> Option<MassPoint<V>> {
    control
        .iter()
        .copied()
        .max_by(|a, b| a.weight.abs().total_cmp(&b.weight.abs()))
}

/// The determinant of three homogeneous vectors: twice the weighted area of their triangle.
fn determinant([h0, h1, h2]: [MassPoint<DVec2>; 3]) -> f64 {
    h0.weight * h1.weighted.perp_dot(h2.weighted)
        + h1.weight * h2.weighted.perp_dot(h0.weighted)
        + h2.weight * h0.weighted.perp_dot(h1.weighted)
}

/// The conic of linearly independent control mass points.
fn proper(control: [MassPoint<DVec2>; 3], determinant: f64) -> Option<Conic> {
    let [h0, h1, h2] = control;
    let terms = h1.weight * h1.weight + (h0.weight * h2.weight).abs();
    let discriminant = h1.weight * h1.weight - h0.weight * h2.weight;
    let pole = h1.weighted * h1.weight - 0.5 * (h0.weighted * h2.weight + h2.weighted * h0.weight);
    if discriminant.abs() <= PARABOLA * terms {
        return parabola(control, pole);
    }
    let centre = pole / discriminant;
    let [y0, y1, y2] = control.map(|h| h.weighted - centre * h.weight);
    let quadric = (outer(y0, y2) - outer(y1, y1)) * (1.0 / discriminant);
    let (mean, half) = (
        0.5 * (quadric.x_axis.x + quadric.y_axis.y),
        0.5 * (quadric.x_axis.x - quadric.y_axis.y),
    );
    let across = quadric.x_axis.y;
    let largest = mean + half.hypot(across);
    // The determinant of the quadric is known in closed form; its smaller eigenvalue then has no cancellation.
    let smallest = -(determinant / discriminant).powi(2) / (4.0 * discriminant * largest);
    let major_direction = first_positive(if half >= 0.0 {
        DVec2::new(half + half.hypot(across), across)
    } else {
        DVec2::new(across, half.hypot(across) - half)
    });
    let round = CIRCLE.max(64.0 * f64::EPSILON * terms / discriminant.abs());
    if discriminant < 0.0 && largest - smallest <= round * largest {
        return Some(Conic::Circle(Circle {
            centre,
            radius: (largest * smallest).sqrt().sqrt(),
        }));
    }
    let conic = CentralConic {
        centre,
        major_direction: major_direction?,
        squared_semi_axes: [largest, smallest],
    };
    Some(if discriminant < 0.0 {
        Conic::Ellipse(conic)
    } else {
        Conic::Hyperbola(conic)
    })
}

/// The symmetric part of `a b^T`.
fn outer(a: DVec2, b: DVec2) -> DMat2 {
    let mixed = 0.5 * (a.x * b.y + a.y * b.x);
    DMat2::from_cols_array(&[a.x * b.x, mixed, mixed, a.y * b.y])
}

/// The unit vector along `direction` or against it, its first non-zero coordinate positive. A coordinate below 1e-12
/// of the other counts as zero here: it only decides the sign.
fn first_positive(direction: DVec2) -> Option<DVec2> {
    let unit = direction.try_normalize()?;
    let leading = if unit.x.abs() > 1e-12 { unit.x } else { unit.y };
    Some(if leading < 0.0 { -unit } else { unit })
}

/// The parabola with these control mass points and the axis direction `axis`.
fn parabola([h0, h1, h2]: [MassPoint<DVec2>; 3], axis: DVec2) -> Option<Conic> {
    let a = outer(h1.weighted, h1.weighted) - outer(h0.weighted, h2.weighted);
    // F = (A11 - A22 + 2 i A12) / (2 (a1 + i a2)) as complex numbers.
    let numerator = DVec2::new(a.x_axis.x - a.y_axis.y, 2.0 * a.x_axis.y);
    let focus =
        DVec2::new(numerator.dot(axis), axis.perp_dot(numerator)) / (2.0 * axis.length_squared());
    let normal = axis.try_normalize()?;
    let offset = (a.x_axis.x + a.y_axis.y) / (2.0 * axis.length());
    let side = if normal.dot(focus) >= offset {
        1.0
    } else {
        -1.0
    };
    Some(Conic::Parabola(Parabola {
        focus,
        directrix: Line {
            normal: normal * side,
            offset: offset * side,
        },
    }))
}

/// The line through linearly dependent local control mass points, of which one is at the origin.
fn line_of(control: [MassPoint<DVec2>; 3]) -> Degenerate {
    let longest = control
        .map(|h| h.weighted)
        .into_iter()
        .max_by(|a, b| a.length().total_cmp(&b.length()));
    match longest.and_then(first_positive) {
        Some(direction) => Degenerate::Line {
            point: DVec2::ZERO,
            direction,
        },
        None => Degenerate::Point(DVec2::ZERO),
    }
}

impl Line {
    /// The signed distance of a point, positive on the side of the normal.
    #[must_use]
    pub fn signed_distance(&self, point: DVec2) -> f64 {
        self.normal.dot(point) - self.offset
    }
}

impl CentralConic {
    /// The semi-axes: along the major direction and across. The slopes of a hyperbola's asymptotes in these axes are plus
    /// and minus the second over the first.
    #[must_use]
    pub fn semi_axes(&self) -> [f64; 2] {
        self.squared_semi_axes.map(|square| square.abs().sqrt())
    }

    /// The distance of a focus from the centre.
    #[must_use]
    pub fn focal_distance(&self) -> f64 {
        let [along, across] = self.squared_semi_axes;
        (along - across).max(0.0).sqrt()
    }

    /// The eccentricity: below one for an ellipse, above for a hyperbola.
    #[must_use]
    pub fn eccentricity(&self) -> f64 {
        self.focal_distance() / self.semi_axes()[0]
    }

    /// The two points on the major axis at the signed distances `-distance`, `distance` from the centre.
    fn on_major_axis(&self, distance: f64) -> [DVec2; 2] {
        [-distance, distance].map(|x| self.centre + self.major_direction * x)
    }

    /// The foci, the one against the major direction first.
    #[must_use]
    pub fn foci(&self) -> [DVec2; 2] {
        self.on_major_axis(self.focal_distance())
    }

    /// The vertices on the axis through the foci, the one against the major direction first.
    #[must_use]
    pub fn vertices(&self) -> [DVec2; 2] {
        self.on_major_axis(self.semi_axes()[0])
    }

    /// The ends of an ellipse's minor axis; `None` for a hyperbola, which does not meet that axis.
    #[must_use]
    pub fn co_vertices(&self) -> Option<[DVec2; 2]> {
        let across = self.major_direction.perp() * self.semi_axes()[1];
        (self.squared_semi_axes[1] > 0.0).then(|| [self.centre - across, self.centre + across])
    }

    /// The directrices, in the order of the foci that they belong to.
    #[must_use]
    pub fn directrices(&self) -> [Line; 2] {
        let distance = self.squared_semi_axes[0] / self.focal_distance();
        let middle = self.major_direction.dot(self.centre);
        [-distance, distance].map(|x| Line {
            normal: self.major_direction,
            offset: middle + x,
        })
    }

    /// The unit directions of a hyperbola's asymptotes, which pass through the centre; `None` for an ellipse.
    #[must_use]
    pub fn asymptotes(&self) -> Option<[DVec2; 2]> {
        let [along, across] = self.semi_axes();
        let (along, across) = (
            self.major_direction * along,
            self.major_direction.perp() * across,
        );
        (self.squared_semi_axes[1] < 0.0)
            .then(|| [(along - across).normalize(), (along + across).normalize()])
    }
}

impl Parabola {
    /// The unit direction of the axis, from the directrix to the focus.
    #[must_use]
    pub fn axis(&self) -> DVec2 {
        self.directrix.normal
    }

    /// The distance of the focus from the directrix.
    #[must_use]
    pub fn focal_parameter(&self) -> f64 {
        self.directrix.signed_distance(self.focus)
    }

    /// The vertex.
    #[must_use]
    pub fn vertex(&self) -> DVec2 {
        self.focus - self.axis() * (0.5 * self.focal_parameter())
    }
}

impl Conic {
    /// The eccentricity: 0 for a circle, 1 for a parabola; `None` if degenerate.
    #[must_use]
    pub fn eccentricity(&self) -> Option<f64> {
        match self {
            Self::Circle(_) => Some(0.0),
            Self::Parabola(_) => Some(1.0),
            Self::Ellipse(conic) | Self::Hyperbola(conic) => Some(conic.eccentricity()),
            Self::Degenerate(_) => None,
        }
    }

    /// The left side of the conic's equation in units of its own size: zero on the conic, negative on the side of the
    /// foci. `None` if degenerate.
    #[must_use]
    pub fn implicit(&self, point: DVec2) -> Option<f64> {
        match self {
            Self::Circle(Circle { centre, radius }) => {
                Some((point - *centre).length_squared() / (radius * radius) - 1.0)
            }
            Self::Ellipse(conic) | Self::Hyperbola(conic) => {
                let from_centre = point - conic.centre;
                let [x, y] = [
                    conic.major_direction.dot(from_centre),
                    conic.major_direction.perp_dot(from_centre),
                ];
                let [along, across] = conic.squared_semi_axes;
                let side = across.signum();
                Some(side * (x * x / along + y * y / across - 1.0))
            }
            Self::Parabola(parabola) => {
                let distance = parabola.directrix.signed_distance(point);
                let square = (point - parabola.focus).length_squared() - distance * distance;
                Some(square / parabola.focal_parameter().powi(2))
            }
            Self::Degenerate(_) => None,
        }
    }

    /// The conic scaled about the origin and then moved from there to `origin`.
    fn placed(self, origin: DVec2, scale: f64) -> Self {
        let place = |point: DVec2| origin + point * scale;
        match self {
            Self::Circle(Circle { centre, radius }) => Self::Circle(Circle {
                centre: place(centre),
                radius: radius * scale,
            }),
            Self::Ellipse(conic) => Self::Ellipse(conic.placed(origin, scale)),
            Self::Hyperbola(conic) => Self::Hyperbola(conic.placed(origin, scale)),
            Self::Parabola(Parabola {
                focus,
                directrix: Line { normal, offset },
            }) => Self::Parabola(Parabola {
                focus: place(focus),
                directrix: Line {
                    normal,
                    offset: offset * scale + normal.dot(origin),
                },
            }),
            Self::Degenerate(Degenerate::Line { point, direction }) => {
                Self::Degenerate(Degenerate::Line {
                    point: place(point),
                    direction,
                })
            }
            Self::Degenerate(Degenerate::Point(point)) => {
                Self::Degenerate(Degenerate::Point(place(point)))
            }
            Self::Degenerate(Degenerate::AtInfinity) => self,
        }
    }
}

impl CentralConic {
    fn placed(self, origin: DVec2, scale: f64) -> Self {
        Self {
            centre: origin + self.centre * scale,
            squared_semi_axes: self.squared_semi_axes.map(|square| square * scale * scale),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Error;
    use glam::dvec2;

    type Net = [(f64, DVec2); 3];

    fn quadratic(net: Net) -> Result<Quadratic<DVec2>, Error> {
        Quadratic::new(net.map(|(w, x)| {
            if w == 0.0 {
                MassPoint::vector(x)
            } else {
                MassPoint::point(x, w)
            }
        }))
    }

    const POINTS: [DVec2; 3] = [dvec2(0.3, 0.1), dvec2(1.0, 2.0), dvec2(3.0, -0.5)];

    /// Every kind of weights, zero and negative ones included.
    fn nets() -> Vec<Net> {
        let weights = [
            [1.0, 0.5, 2.0],
            [1.0, 2.0, 1.0],
            [1.0, 1.0, 1.0],
            [1.0, 0.0, 1.0],
            [0.0, 2.0, 0.0],
            [1.0, 0.0, -1.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 1.0],
            [1.0, -0.5, 1.0],
            [-1.0, 3.0, 2.0],
            [4.0, 2.0, 1.0],
            [1.0, -1.0, 1.0],
        ];
        weights
            .iter()
            .map(|w| [0, 1, 2].map(|i| (w[i], POINTS[i])))
            .collect()
    }

    #[test]
    fn the_curve_satisfies_the_equation_of_its_conic_and_the_focal_property() -> Result<(), Error> {
        for net in nets() {
            let (curve, conic) = (quadratic(net)?, quadratic(net)?.conic());
            let directed = match conic {
                Conic::Ellipse(c) | Conic::Hyperbola(c) => {
                    c.foci().into_iter().zip(c.directrices()).collect()
                }
                Conic::Parabola(p) => vec![(p.focus, p.directrix)],
                _ => Vec::new(),
            };
            assert!(!directed.is_empty(), "{conic:?}");
            for i in -8..=16 {
                let Ok(point) = curve.point(f64::from(i) / 8.0 + 0.01) else {
                    continue;
                };
                let size = 1.0 + point.length_squared();
                let residual = conic.implicit(point).unwrap_or(f64::NAN);
                assert!(
                    residual.abs() < 1e-11 * size,
                    "{net:?}: residual {residual} at {point}"
                );
                for (focus, directrix) in &directed {
                    let ratio = conic.eccentricity().unwrap_or(f64::NAN)
                        * directrix.signed_distance(point).abs();
                    assert!(
                        (ratio - focus.distance(point)).abs() < 1e-11 * size,
                        "{net:?}: {focus} at {point}"
                    );
                }
            }
        }
        Ok(())
    }

    #[test]
    fn the_features_do_not_depend_on_the_arc_nor_on_the_place() -> Result<(), Error> {
        let offset = dvec2(1e5, -2e5);
        for net in nets() {
            let curve = quadratic(net)?;
            let conic = curve.conic();
            let moved = curve.map(|h| h.translated(offset))?.conic();
            let part = curve.sub_arc(0.21, 0.83)?.conic();
            let complement = curve.complement().conic();
            for point in [dvec2(0.0, 0.0), dvec2(1.0, -2.0)] {
                let value = conic.implicit(point).unwrap_or(f64::NAN);
                for (other, shift, tolerance) in [
                    (moved, offset, 1e-7),
                    (part, DVec2::ZERO, 1e-10),
                    (complement, DVec2::ZERO, 1e-12),
                ] {
                    let same = other.implicit(point + shift).unwrap_or(f64::NAN);
                    assert!(
                        (value - same).abs() < tolerance * (1.0 + value.abs()),
                        "{net:?}: {value} against {same}"
                    );
                }
            }
        }
        Ok(())
    }

    #[test]
    fn circles_are_recognised_down_to_short_arcs() -> Result<(), Error> {
        let centre = dvec2(3.0, -2.0);
        for span in [3.0, 1.0, 1e-1, 1e-2, 1e-3] {
            let conic = Quadratic::circular_arc_by_angles(centre, 5.0, 0.3, 0.3 + span)?.conic();
            let Conic::Circle(circle) = conic else {
                panic!("{span}: {conic:?}")
            };
            let tolerance = 1e-13 / (span * span);
            assert!(
                (circle.radius - 5.0).abs() < tolerance
                    && circle.centre.distance(centre) < tolerance
            );
        }
        Ok(())
    }

    #[test]
    fn what_is_not_a_conic_says_what_it_is() -> Result<(), Error> {
        let line = quadratic([
            (1.0, DVec2::ZERO),
            (3.0, DVec2::ONE),
            (2.0, dvec2(5.0, 5.0)),
        ])?
        .conic();
        let Conic::Degenerate(Degenerate::Line { point, direction }) = line else {
            panic!("{line:?}")
        };
        assert!(
            point.perp_dot(DVec2::ONE).abs() < 1e-15
                && (direction - DVec2::ONE.normalize()).length() < 1e-15
        );
        let same = dvec2(0.1, 0.7);
        let point = quadratic([(1.0, same), (0.3, same), (-0.7, same)])?.conic();
        assert_eq!(point, Conic::Degenerate(Degenerate::Point(same)));
        let ray = quadratic([(1.0, same), (0.0, DVec2::X), (0.0, DVec2::ZERO)])?.conic();
        assert!(
            matches!(ray, Conic::Degenerate(Degenerate::Line { .. })),
            "{ray:?}"
        );
        let infinite = quadratic([(0.0, same), (0.0, DVec2::X), (0.0, DVec2::Y)])?.conic();
        assert_eq!(infinite, Conic::Degenerate(Degenerate::AtInfinity));
        assert_eq!(
            (infinite.eccentricity(), infinite.implicit(same)),
            (None, None)
        );
        Ok(())
    }
}
