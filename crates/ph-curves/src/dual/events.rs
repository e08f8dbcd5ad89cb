//! Inflections and cusps of dual curves, and what is measured between them.

use bezier_mass::bernstein;
use glam::DVec3;

use super::common_factor::{divide_by_double_root, divide_by_root};
use super::{DualCurve, normalised};
use crate::Error;
use crate::quadrature::integrate;

/// The point curve and the polynomial of the cusps without the common factors of inflections.
struct Reduced {
    points: Vec<DVec3>,
    cusps: Vec<f64>,
    removed: Vec<f64>,
}

impl DualCurve {
    /// Bernstein coefficients of the weight `x0` of the point form, whose roots are the inflections.
    #[must_use]
    pub fn turn_polynomial(&self) -> Vec<f64> {
        self.point_control().iter().map(|x| x.x).collect()
    }

    /// Bernstein coefficients of `det(U, U', U'') / (m^2 (m-1))`, of degree 3m - 6: its roots are the cusps.
    ///
    /// The determinant is that of the last three lines of de Casteljau's scheme.
    #[must_use]
    pub fn cusp_polynomial(&self) -> Vec<f64> {
        cusp_polynomial(&self.vectors)
    }

    /// Parameters in `[0, 1]` where the normal is stationary, in increasing order, isolated and certified.
    ///
    /// None where it is stationary everywhere (all tangents parallel).
    #[must_use]
    pub fn inflections(&self) -> Vec<f64> {
        roots(&turn_polynomial(&normalised(&self.vectors).0)).unwrap_or_default()
    }

    /// Parameters in `[0, 1]` where the radius of curvature vanishes, in increasing order, isolated and
    /// certified. None where it vanishes everywhere (a point).
    ///
    /// The determinant of [`DualCurve::cusp_polynomial`] has a double root at every inflection with a finite
    /// point too, where the radius is infinite: these are divided out.
    #[must_use]
    pub fn cusps(&self) -> Vec<f64> {
        self.reduced(&normalised(&self.vectors).0)
            .and_then(|reduced| roots(&reduced.cusps))
            .unwrap_or_default()
    }

    /// The point curve divided by the common factors that inflections leave in it: `U'` is parallel to
    /// `U` there, so every inflection in `[0, 1]` lowers the degree by one.
    ///
    /// Returns the reduced homogeneous control vectors and the parameters of the factors.
    #[must_use]
    pub fn reduced_points(&self) -> (Vec<DVec3>, Vec<f64>) {
        let (vectors, unit) = normalised(&self.vectors);
        match self.reduced(&vectors) {
            Ok(Reduced {
                points, removed, ..
            }) if !removed.is_empty() => {
                // Any scale will do, but that of the plane.
                let plane = DVec3::new(1.0, unit, unit);
                (points.iter().map(|x| *x * plane).collect(), removed)
            }
            _ => (self.point_control(), Vec::new()),
        }
    }

    /// Divides the factors `f` of inflections out of `U x U'`, and `f^2` out of `det(U, U', U'')`:
    /// `det(U, U', U'') U = (U x U') x (U x U')'`, which has them twice.
    fn reduced(&self, vectors: &[DVec3]) -> Result<Reduced, Error> {
        let mut reduced = Reduced {
            points: point_control(vectors),
            cusps: cusp_polynomial(vectors),
            removed: Vec::new(),
        };
        for t in roots(&turn_polynomial(vectors))? {
            while let (Some(points), Some(cusps)) = (
                divide_by_root(&reduced.points, t),
                divide_by_double_root(&reduced.cusps, t),
            ) {
                (reduced.points, reduced.cusps) = (points, cusps);
                reduced.removed.push(t);
            }
        }
        Ok(reduced)
    }

    /// Arc length of the segment: all parts between its cusps count positively.
    ///
    /// Gauss's rule on halves until two refinements agree to 1e-13 of the length; exact closed forms exist for
    /// PH arcs ([`PhArc::signed_length`](crate::PhArc::signed_length)).
    ///
    /// # Errors
    /// [`Error::AtInfinity`] if the segment passes through infinity: an inflection of the dual form that does
    /// not divide out, or a tangent at infinity; [`Error::NonFinite`] if the length overflows.
    pub fn length(&self) -> Result<f64, Error> {
        // ds = |R dpsi| = |det(U, U', U'')| |n| / s^2 dt, with the factor m^2 (m - 1) / m^2.
        let (vectors, unit) = normalised(&self.vectors);
        let Reduced { points, cusps, .. } = self.reduced(&vectors)?;
        let weights: Vec<f64> = points.iter().map(|x| x.x).collect();
        if weights.iter().all(|x| *x == 0.0) {
            return Err(Error::AtInfinity { t: 0.0 });
        }
        if let Some(&t) = roots(&weights)?.first() {
            return Err(Error::AtInfinity { t });
        }
        let factor = (self.class() - 1) as f64;
        let speed = |t: f64| {
            let normal = bernstein::evaluate(&vectors, t);
            let weight = bernstein::evaluate(&weights, t);
            factor * bernstein::evaluate(&cusps, t) * normal.y.hypot(normal.z) / (weight * weight)
        };
        let mut ends = vec![0.0];
        ends.extend(roots(&cusps)?.into_iter().filter(|t| *t > 0.0 && *t < 1.0));
        ends.push(1.0);
        let length = ends
            .windows(2)
            .map(|part| converged(part[0], part[1], speed).abs())
            .sum::<f64>()
            * unit;
        if length.is_finite() {
            Ok(length)
        } else {
            Err(Error::NonFinite {
                what: "an arc length",
            })
        }
    }
}

/// Bernstein coefficients of the point curve `U x U' / m`.
pub(super) fn point_control(vectors: &[DVec3]) -> Vec<DVec3> {
    let head = &vectors[..vectors.len() - 1];
    bernstein::product_with(head, &vectors[1..], |a, b| a.cross(*b))
}

fn turn_polynomial(vectors: &[DVec3]) -> Vec<f64> {
    point_control(vectors).iter().map(|x| x.x).collect()
}

fn cusp_polynomial(vectors: &[DVec3]) -> Vec<f64> {
    let count = vectors.len() - 2;
    let level = |k: usize| &vectors[k..k + count];
    let cross = bernstein::product_with(level(1), level(2), |a, b| a.cross(*b));
    bernstein::product_with(level(0), &cross, |a, b| a.dot(*b))
}

/// Relative agreement of two refinements at which an arc length is final.
const LENGTH_AGREEMENT: f64 = 1e-13;
/// Most pieces of sixteen nodes that a length is given.
const MOST_PIECES: usize = 256;

fn converged(from: f64, to: f64, speed: impl Fn(f64) -> f64) -> f64 {
    let mut length = integrate(from, to, 1, &speed);
    let mut pieces = 2;
    while pieces <= MOST_PIECES {
        let finer = integrate(from, to, pieces, &speed);
        let agree = (finer - length).abs() <= LENGTH_AGREEMENT * finer.abs();
        length = finer;
        if agree {
            break;
        }
        pieces *= 2;
    }
    length
}

/// Certified real roots in `[0, 1]`, in increasing order; none of the zero polynomial.
fn roots(coefficients: &[f64]) -> Result<Vec<f64>, Error> {
    match variation::roots(coefficients) {
        Ok(roots) => Ok(roots.iter().map(|root| root.value()).collect()),
        Err(variation::Error::IdenticallyZero) => Ok(Vec::new()),
        Err(_) => Err(Error::NonFinite {
            what: "a line coordinate",
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    fn polynomial(points: &[(f64, f64)]) -> DualCurve {
        let control: Vec<DVec3> = points.iter().map(|p| DVec3::new(1.0, p.0, p.1)).collect();
        DualCurve::from_points(&control).unwrap()
    }

    /// Length of a polynomial curve by its hodograph.
    fn true_length(points: &[(f64, f64)]) -> f64 {
        let points: Vec<DVec2> = points.iter().map(|p| DVec2::from(*p)).collect();
        let velocity = bernstein::derivative(&points);
        integrate(0.0, 1.0, 64, |t| bernstein::evaluate(&velocity, t).length())
    }

    #[test]
    fn an_inflection_is_no_cusp_and_has_a_length() {
        let curves: [&[(f64, f64)]; 3] = [
            &[(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 0.0)],
            &[(0.0, 0.0), (1.0, 2.0), (2.5, -1.3), (3.0, 0.4)],
            &[(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 2.0), (4.2, 0.0)],
        ];
        for points in curves {
            let curve = polynomial(points);
            assert_eq!(curve.inflections().len(), points.len() - 3);
            assert_eq!(curve.reduced_points().1, curve.inflections());
            assert_eq!(curve.cusps(), Vec::<f64>::new());
            let (length, expected) = (curve.length().unwrap(), true_length(points));
            assert!(
                (length / expected - 1.0).abs() < 1e-9,
                "{length} {expected}"
            );
        }
    }

    #[test]
    fn events_do_not_depend_on_the_scale() {
        let curve = polynomial(&[(0.0, 0.0), (1.0, 2.0), (2.0, -2.0), (3.0, 0.0)]);
        let cusped = DualCurve::from_vectors(&[
            DVec3::new(0.3, 1.0, 0.0),
            DVec3::new(-0.5, 1.0, 0.6),
            DVec3::new(0.7, 0.6, 1.0),
            DVec3::new(-0.2, 0.0, 1.0),
        ])
        .unwrap();
        assert!(!cusped.cusps().is_empty());
        for curve in [curve, cusped] {
            for scale in [1e160, 1e-160] {
                let vectors: Vec<DVec3> = curve.vectors().iter().map(|u| *u * scale).collect();
                let scaled = DualCurve::from_vectors(&vectors).unwrap();
                let close = |a: Vec<f64>, b: Vec<f64>| {
                    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
                };
                assert!(close(scaled.inflections(), curve.inflections()));
                assert!(close(scaled.cusps(), curve.cusps()));
                let lengths = (scaled.length().unwrap(), curve.length().unwrap());
                assert!((lengths.0 / lengths.1 - 1.0).abs() < 1e-9);
                let (a, b) = (scaled.contact(0.3).unwrap(), curve.contact(0.3).unwrap());
                assert!(
                    (a.point - b.point).length() < 1e-12
                        && (a.radius / b.radius - 1.0).abs() < 1e-9
                );
            }
        }
    }

    #[test]
    fn a_tangent_at_infinity_has_no_length() {
        let pole = DualCurve::from_vectors(&[
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(1.0, 0.0, 0.0),
            DVec3::new(-1.0, -1.0, 0.5),
        ])
        .unwrap();
        assert!(matches!(pole.length(), Err(Error::AtInfinity { .. })));
        let overflown = crate::PhArc::new(DVec2::X, DVec2::ONE, [1.0; 4])
            .unwrap()
            .offset(f64::NAN);
        let curve = DualCurve::from(&overflown);
        assert!(matches!(curve.length(), Err(Error::NonFinite { .. })));
        assert!(matches!(curve.contact(0.5), Err(Error::NonFinite { .. })));
    }
}
