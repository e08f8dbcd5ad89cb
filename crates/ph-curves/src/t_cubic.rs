//! Tschirnhausen cubics: the polynomial Pythagorean-hodograph cubics.

use bezier_mass::bernstein;
use glam::DVec2;

use crate::complex::{conj, divide, sqrt, square};
use crate::{Error, TQuartic};

/// Largest relative defect of `D1^2 = D0 D2` at which four points count as a Tschirnhausen cubic:
/// far above the rounding of control points that were computed as one, far below any other cubic.
const RECOGNITION: f64 = 1e-9;

/// A polynomial cubic whose hodograph is a complex square: control legs with `D1^2 = D0 D2`.
///
/// Equal signed turning at the inner control points and `L1^2 = L0 L2` (Theorem 1). It has no
/// inflection, its arc length is a polynomial, and its involutes are the arcs of class 3 ([`TQuartic`]).
///
/// ```text
///        E-------F            E on AB and F on BC with |BE| = |BF|:
///       / `.   .' \           the one Tschirnhausen cubic A E F C
///      A    `B'    C          in the triangle A B C (Proposition 2)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[DVec2; 4]", into = "[DVec2; 4]"))]
pub struct TCubic {
    points: [DVec2; 4],
}

impl TCubic {
    /// The cubic with these control points, if it is a Tschirnhausen cubic (Theorem 1).
    ///
    /// Four equal points are one, the evolute of a circle.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::NotTschirnhausen`] with the relative defect of `D1^2 = D0 D2`.
    pub fn new(points: [DVec2; 4]) -> Result<Self, Error> {
        if !points.iter().all(|p| p.is_finite()) {
            return Err(Error::NonFinite {
                what: "a control point",
            });
        }
        let cubic = Self { points };
        let relative_defect = cubic.relative_defect();
        if relative_defect > RECOGNITION {
            return Err(Error::NotTschirnhausen { relative_defect });
        }
        Ok(cubic)
    }

    pub(crate) const fn from_parts(points: [DVec2; 4]) -> Self {
        Self { points }
    }

    /// `|D1^2 - D0 D2|` over the larger modulus, computed on legs of size one so that no square is lost.
    fn relative_defect(&self) -> f64 {
        let legs = self.legs();
        let size = legs
            .iter()
            .map(|d| d.abs().max_element())
            .fold(0.0, f64::max);
        if size == 0.0 {
            return 0.0;
        }
        let [d0, d1, d2] = legs.map(|d| d / size);
        let (left, right) = (square(d1), d0.rotate(d2));
        let scale = left.length().max(right.length());
        if scale == 0.0 {
            1.0
        } else {
            (left - right).length() / scale
        }
    }

    /// The one Tschirnhausen cubic from `a` to `c` with end tangents along `ab` and `bc` (Proposition 2).
    ///
    /// Its inner control points lie on the two sides at the same distance from `b`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::DegenerateTriangle`] for points on a line.
    pub fn in_triangle(a: DVec2, b: DVec2, c: DVec2) -> Result<Self, Error> {
        if !(a.is_finite() && b.is_finite() && c.is_finite()) {
            return Err(Error::NonFinite {
                what: "a corner of the triangle",
            });
        }
        let (to_a, to_c) = (a - b, c - b);
        let (first, second) = (to_a.length(), to_c.length());
        let area = 0.5 * to_a.perp_dot(to_c);
        if area.abs() <= f64::EPSILON * first * second {
            return Err(Error::DegenerateTriangle { area });
        }
        let (to_a, to_c) = (to_a / first, to_c / second);
        // sin^2 and cos^2 of half the angle at b, both without cancellation.
        let (sine, cosine) = (
            0.25 * (to_a - to_c).length_squared(),
            0.25 * (to_a + to_c).length_squared(),
        );
        let reach = corner_reach(first, second, sine / (sine + cosine));
        Ok(Self {
            points: [a, b + to_a * reach, b + to_c * reach, c],
        })
    }

    /// The caustic of parallel light that travels along `direction` and is reflected by the parabola
    /// `y = x^2 / (4 focal_length)`, for the rays that hit it at abscissas from `x0` to `x1`.
    ///
    /// The parameter is proportional to the abscissa. Light along the axis is focused in a point.
    ///
    /// # Errors
    /// [`Error::NonFinite`], also for rays so far out that the caustic overflows; [`Error::ZeroDirection`] for a zero
    /// direction or focal length.
    pub fn parabola_caustic(
        focal_length: f64,
        direction: DVec2,
        x0: f64,
        x1: f64,
    ) -> Result<Self, Error> {
        if !(direction.is_finite() && focal_length.is_finite() && x0.is_finite() && x1.is_finite())
        {
            return Err(Error::NonFinite {
                what: "a parabola or its light",
            });
        }
        let light = direction
            .try_normalize()
            .ok_or(Error::ZeroDirection { what: "the light" })?;
        if focal_length == 0.0 {
            return Err(Error::ZeroDirection {
                what: "the axis of a parabola of focal length 0",
            });
        }
        let size = 4.0 * focal_length;
        let (x0, x1) = (x0 / size, x1 / size);
        // On y = x^2 the tangent is 1 + 2ix, the reflected ray tangent^2 conj(d), and the caustic lies on
        // it at Im(tangent conj(d)) / 4.
        let tangent = [x0, x1].map(|x| DVec2::new(1.0, 2.0 * x));
        let ray =
            bernstein::product_with(&tangent, &tangent, |a, b| a.rotate(*b).rotate(conj(light)));
        let reach = tangent.map(|tangent| 0.25 * light.perp_dot(tangent));
        let along = bernstein::product(&reach, &ray);
        let abscissa = [x0, x1].map(|x| DVec2::new(x, 0.0));
        let height = bernstein::product_with(&[x0, x1], &[x0, x1], |a, b| DVec2::new(0.0, a * b));
        let mirror = bernstein::elevate_to(&abscissa, 3);
        let height = bernstein::elevate_to(&height, 3);
        let points: [DVec2; 4] = std::array::from_fn(|k| (mirror[k] + height[k] + along[k]) * size);
        if !points.iter().all(|p| p.is_finite()) {
            return Err(Error::NonFinite {
                what: "a control point of the caustic",
            });
        }
        Ok(Self { points })
    }

    /// The four control points.
    #[must_use]
    pub const fn points(&self) -> &[DVec2; 4] {
        &self.points
    }

    fn legs(&self) -> [DVec2; 3] {
        let p = &self.points;
        [p[1] - p[0], p[2] - p[1], p[3] - p[2]]
    }

    /// The point at `t`.
    #[must_use]
    pub fn point(&self, t: f64) -> DVec2 {
        bernstein::evaluate(&self.points, t)
    }

    /// The derivative with respect to `t`; its length is the polynomial speed.
    #[must_use]
    pub fn derivative(&self, t: f64) -> DVec2 {
        bernstein::evaluate(&self.legs(), t) * 3.0
    }

    /// Bernstein coefficients of the speed, a quadratic: `3 L0, 3 <D0, D1>/L0, 3 L2`.
    #[must_use]
    pub fn speed(&self) -> [f64; 3] {
        let [d0, d1, d2] = self.legs();
        let (l0, l2) = (d0.length(), d2.length());
        let middle = if l0 >= l2 {
            d0.dot(d1) / l0
        } else {
            d1.dot(d2) / l2
        };
        [
            3.0 * l0,
            if middle.is_nan() { 0.0 } else { 3.0 * middle },
            3.0 * l2,
        ]
    }

    /// Arc length `L0 + L2 + L1 cos tau`, tau the signed turning of one leg to the next (Proposition 1).
    #[must_use]
    pub fn length(&self) -> f64 {
        self.speed().iter().sum::<f64>() / 3.0
    }

    /// Arc length from the start to `t`, a cubic polynomial.
    #[must_use]
    pub fn length_to(&self, t: f64) -> f64 {
        bernstein::evaluate(&bernstein::integral(&self.speed(), 0.0), t)
    }

    /// The involute with signed radius `radius` at the start and normal along the direction of travel:
    /// the class-3 arc whose evolute this is. Its radius decreases by the arc length.
    ///
    /// With the preimage w of the hodograph and `kappa = det(w0, w1)` its support numerator is
    /// `<w^2, P0> + radius |w|^2 - 2/3 kappa^2 t^3`, the first two terms being the circle around the start; from the end
    /// it is `<w^2, P3> + (radius - length) |w|^2 + 2/3 kappa^2 (1 - t)^3`.
    ///
    /// # Errors
    /// [`Error::NoTurning`] or [`Error::ZeroDirection`] if the cubic is a point or a straight line, which
    /// have no class-3 involutes; [`Error::TurningTooLarge`] if it turns by pi or more; [`Error::NonFinite`].
    pub fn involute(&self, radius: f64) -> Result<TQuartic, Error> {
        if !radius.is_finite() {
            return Err(Error::NonFinite {
                what: "the radius of an involute",
            });
        }
        // From the end with the longer leg, which has lost fewer digits.
        let [d0, d1, d2] = self.legs();
        let backwards = d0.length() < d2.length();
        let (w0, w1) = if backwards {
            let w1 = sqrt(3.0 * d2);
            (divide(3.0 * d1, w1), w1)
        } else {
            self.preimage()?
        };
        // Spinors of size one: the numerator has the size of the square of theirs.
        let size = (w0.length() * w1.length()).sqrt();
        let (z0, z1) = (w0 / size, w1 / size);
        let circle = TQuartic::new(z0, z1, [0.0; 4])?;
        let (normals, lengths) = (circle.control_normals(), circle.circle_coefficients());
        let (centre, radius) = if backwards {
            (self.points[3], radius - self.length())
        } else {
            (self.points[0], radius)
        };
        let mut support: [f64; 4] =
            std::array::from_fn(|k| normals[k].dot(centre) + radius * lengths[k]);
        let kappa = size * z0.perp_dot(z1);
        if backwards {
            support[0] += kappa * kappa / 1.5;
        } else {
            support[3] -= kappa * kappa / 1.5;
        }
        TQuartic::new(z0, z1, support)
    }

    /// The complex numbers `(w0, w1)` whose linear interpolant squares to the hodograph.
    ///
    /// # Errors
    /// [`Error::ZeroDirection`] if the first leg is zero.
    pub fn preimage(&self) -> Result<(DVec2, DVec2), Error> {
        let [d0, d1, _] = self.legs();
        let w0 = sqrt(3.0 * d0);
        if w0 == DVec2::ZERO {
            return Err(Error::ZeroDirection {
                what: "the first leg of the cubic",
            });
        }
        Ok((w0, divide(3.0 * d1, w0)))
    }
}

impl TryFrom<[DVec2; 4]> for TCubic {
    type Error = Error;

    fn try_from(points: [DVec2; 4]) -> Result<Self, Error> {
        Self::new(points)
    }
}

impl From<TCubic> for [DVec2; 4] {
    fn from(cubic: TCubic) -> Self {
        cubic.points
    }
}

/// Distance of the inner control points from the corner of a triangle with sides `a`, `c` there and
/// `sine_squared` of half the angle between them (Proposition 2).
pub(crate) fn corner_reach(a: f64, c: f64, sine_squared: f64) -> f64 {
    2.0 * a * c / (a + c + ((a - c) * (a - c) + 16.0 * a * c * sine_squared).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_any_size_are_recognised_or_refused() {
        let zigzag = [(0.0, 0.0), (1.0, 0.0), (1.5, 0.7), (2.5, 0.7)];
        let cubic = TCubic::in_triangle(DVec2::ZERO, DVec2::new(2.0, 0.3), DVec2::new(2.5, 2.0));
        let cubic = *cubic.unwrap().points();
        for size in [1e-200, 1.0, 1e200] {
            let plain = zigzag.map(|(x, y)| size * DVec2::new(x, y));
            assert!(matches!(
                TCubic::new(plain),
                Err(Error::NotTschirnhausen { .. })
            ));
            assert!(TCubic::new(cubic.map(|p| size * p)).is_ok());
        }
    }

    #[test]
    fn a_caustic_that_overflows_is_refused() {
        let caustic = TCubic::parabola_caustic(1.0, DVec2::new(0.6, 0.8), -1e200, 1e200);
        assert!(matches!(caustic, Err(Error::NonFinite { .. })));
    }
}
