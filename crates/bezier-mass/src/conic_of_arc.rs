//! Which conic a plane quadratic is an arc of.

use crate::conic::{CentralConic, Circle, Conic, Degenerate, Line, Parabola};
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
    // The determinant of the quadric is known in closed form: the eigenvalue that would cancel follows from the other.
    let product = -(determinant / discriminant).powi(2) / (4.0 * discriminant);
    let [largest, smallest] = if mean >= 0.0 {
        let largest = mean + half.hypot(across);
        [largest, product / largest]
    } else {
        let smallest = mean - half.hypot(across);
        [product / smallest, smallest]
    };
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

    /// The axis through the vertices is 1e4 times the shorter one: its square comes from the determinant.
    #[test]
    fn a_wide_hyperbola_keeps_its_digits() -> Result<(), Error> {
        // x^2 / a^2 - y^2 = 1 by vectors along the asymptotes at the ends.
        for a in [1e-4, 1e4] {
            let (sin, cos) = 0.7_f64.sin_cos();
            let turn = |v: DVec2| dvec2(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
            let net = [
                (0.0, turn(dvec2(a, 1.0))),
                (1.0, dvec2(0.2, -0.1)),
                (0.0, turn(dvec2(a, -1.0))),
            ];
            let Conic::Hyperbola(found) = quadratic([net[0], net[1], net[2]])?.conic() else {
                panic!("no hyperbola")
            };
            // The weights (0, 1, 0) give the quadric (X0 X2^T + X2 X0^T)/2, half the axes' squares.
            let ratio = found.semi_axes()[1] / found.semi_axes()[0];
            assert!((ratio * a - 1.0).abs() < 1e-12, "{ratio}");
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
