//! Interfaces between media: lines, circles, conics and rational curves.

use bezier_mass::BezierCurve;
use glam::{DMat2, DVec2};

use crate::Error;

/// Where a ray meets an interface.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact {
    /// The travel time from the start of the ray.
    pub time: f64,
    /// The place.
    pub point: DVec2,
    /// The unit tangent of the interface.
    pub tangent: DVec2,
    /// The curvature of the interface, positive if it turns to the left of the tangent.
    pub curvature: f64,
    /// The place on the interface: piece number plus parameter for a curve, 0 for the other shapes.
    pub parameter: f64,
}

/// A curve at which a wave is reflected and transmitted.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Interface {
    shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
enum Shape {
    Line {
        point: DVec2,
        tangent: DVec2,
    },
    /// `(x - centre)ᵀ form (x - centre) + 2 linear (x - centre) + constant = 0`.
    Conic {
        centre: DVec2,
        form: DMat2,
        linear: DVec2,
        constant: f64,
    },
    Curve(Vec<Piece>),
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
struct Piece {
    curve: BezierCurve<DVec2>,
    /// Corners of a box around the piece; infinite if a weight is not positive.
    low: DVec2,
    high: DVec2,
}

/// A parameter this far outside `[0, 1]` still belongs to a piece: joints must not leak rays.
const JOINT_SLACK: f64 = 1e-12;
/// Newton's method from a neighbouring ray's place; it doubles its digits, and is given up for the certified search.
const GUIDED_STEPS: usize = 8;

impl Interface {
    /// The line through a point.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::ZeroDirection`].
    pub fn line(point: DVec2, direction: DVec2) -> Result<Self, Error> {
        if !(point.is_finite() && direction.is_finite()) {
            return Err(Error::NonFinite { what: "a line" });
        }
        let tangent = direction.try_normalize().ok_or(Error::ZeroDirection {
            what: "the direction of a line",
        })?;
        Ok(Self {
            shape: Shape::Line { point, tangent },
        })
    }

    /// A horizontal line.
    ///
    /// # Errors
    /// [`Error::NonFinite`].
    pub fn horizontal(height: f64) -> Result<Self, Error> {
        Self::line(DVec2::new(0.0, height), DVec2::X)
    }

    /// A circle.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] unless the radius is positive.
    pub fn circle(centre: DVec2, radius: f64) -> Result<Self, Error> {
        Self::ellipse(centre, DVec2::X * radius, DVec2::Y * radius)
    }

    /// An ellipse with two conjugate half axes.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] if the half axes are parallel.
    pub fn ellipse(centre: DVec2, first: DVec2, second: DVec2) -> Result<Self, Error> {
        let axes = DMat2::from_cols(first, second);
        if !(centre.is_finite() && axes.is_finite()) {
            return Err(Error::NonFinite { what: "an ellipse" });
        }
        if axes.determinant() == 0.0 {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "the half axes of an ellipse are parallel",
            });
        }
        let inverse = axes.inverse();
        Self::conic_about(centre, inverse.transpose() * inverse, DVec2::ZERO, -1.0)
    }

    /// The conic `a x² + b xy + c y² + d x + e y + f = 0`.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] if the quadratic part vanishes (use a line).
    pub fn conic([a, b, c, d, e, f]: [f64; 6]) -> Result<Self, Error> {
        let form = DMat2::from_cols(DVec2::new(a, 0.5 * b), DVec2::new(0.5 * b, c));
        Self::conic_about(DVec2::ZERO, form, 0.5 * DVec2::new(d, e), f)
    }

    fn conic_about(
        centre: DVec2,
        form: DMat2,
        linear: DVec2,
        constant: f64,
    ) -> Result<Self, Error> {
        if !(form.is_finite() && linear.is_finite() && constant.is_finite()) {
            return Err(Error::NonFinite {
                what: "a coefficient of a conic",
            });
        }
        if form == DMat2::ZERO {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "the quadratic part of a conic vanishes",
            });
        }
        Ok(Self {
            shape: Shape::Conic {
                centre,
                form,
                linear,
                constant,
            },
        })
    }

    /// A chain of polynomial or rational Bézier curves: a B-spline's pieces, a piecewise conic.
    ///
    /// # Errors
    /// [`Error::BadInterface`] for no pieces or a piece that is a single point.
    pub fn curve(pieces: impl IntoIterator<Item = BezierCurve<DVec2>>) -> Result<Self, Error> {
        let pieces: Vec<Piece> = pieces
            .into_iter()
            .map(Piece::new)
            .collect::<Result<_, _>>()?;
        if pieces.is_empty() {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "a curve without pieces",
            });
        }
        Ok(Self {
            shape: Shape::Curve(pieces),
        })
    }

    /// The smooth curve through the graph of a function, given with its first two derivatives, as C2 quintic pieces: the
    /// error falls with the sixth power of their number.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::OutOfRange`] for no pieces or an empty interval.
    pub fn graph(
        from: f64,
        to: f64,
        pieces: usize,
        jet: impl Fn(f64) -> [f64; 3],
    ) -> Result<Self, Error> {
        let width = (to - from) / pieces as f64;
        if !(width > 0.0 && width.is_finite()) {
            return Err(Error::OutOfRange {
                what: "the width of a piece of a graph",
                value: width,
            });
        }
        let piece = |i: usize| {
            let (x0, x1) = (from + width * i as f64, from + width * (i + 1) as f64);
            let (start, end) = (jet(x0), jet(x1));
            if !start.iter().chain(&end).all(|value| value.is_finite()) {
                return Err(Error::NonFinite {
                    what: "a value of a graph",
                });
            }
            let (h1, h2) = (width / 5.0, width * width / 20.0);
            let heights = [
                start[0],
                start[0] + h1 * start[1],
                start[0] + 2.0 * h1 * start[1] + h2 * start[2],
                end[0] - 2.0 * h1 * end[1] + h2 * end[2],
                end[0] - h1 * end[1],
                end[0],
            ];
            let points: Vec<DVec2> = heights
                .iter()
                .zip(0..6)
                .map(|(&y, k)| DVec2::new(x0 + h1 * f64::from(k), y))
                .collect();
            Ok(BezierCurve::polynomial(&points)?)
        };
        Self::curve((0..pieces).map(piece).collect::<Result<Vec<_>, Error>>()?)
    }

    /// A G1 chain of conic arcs through samples with tangent directions: each arc is the rational quadratic in the triangle
    /// of two neighbours whose shoulder passes closest to the samples in between. `stride` samples make one arc.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::BadInterface`] for less than two samples or where neighbouring tangents do not make a
    /// triangle (an inflection between two samples: choose another stride).
    pub fn fit_conics(samples: &[(DVec2, DVec2)], stride: usize) -> Result<Self, Error> {
        let bad = |reason| Error::BadInterface {
            interface: 0,
            reason,
        };
        if samples
            .iter()
            .any(|(point, tangent)| !(point.is_finite() && tangent.is_finite()))
        {
            return Err(Error::NonFinite {
                what: "a sample of an interface",
            });
        }
        if samples.len() < 2 || stride == 0 {
            return Err(bad("too few samples, or a stride of zero"));
        }
        let last = samples.len() - 1;
        let ends = (0..last)
            .step_by(stride)
            .map(|start| (start, (start + stride).min(last)));
        let arcs = ends.map(|(start, end)| {
            let ((p, tangent), (q, towards)) = (samples[start], samples[end]);
            let chord = q - p;
            let turn = tangent.perp_dot(towards);
            let straight = tangent.perp_dot(chord).abs()
                <= 1e-12 * tangent.length() * chord.length()
                && towards.perp_dot(chord).abs() <= 1e-12 * towards.length() * chord.length();
            if straight {
                return Ok(BezierCurve::polynomial(&[p, q])?);
            }
            let (before, after) = (
                chord.perp_dot(towards) / turn,
                tangent.perp_dot(chord) / turn,
            );
            if !(before > 0.0 && after > 0.0) {
                return Err(bad("the tangents of two neighbours do not make a triangle"));
            }
            let apex = p + before * tangent;
            let weight = conic_weight(
                [p, apex, q],
                samples[start + 1..end].iter().map(|sample| sample.0),
            );
            let control = [(p, 1.0), (apex, weight), (q, 1.0)]
                .map(|(point, w)| bezier_mass::MassPoint::point(point, w));
            Ok(BezierCurve::new(control.to_vec())?)
        });
        Self::curve(arcs.collect::<Result<Vec<_>, Error>>()?)
    }

    /// The first impact of a ray later than `after`, if there is one.
    #[must_use]
    pub fn first_impact(&self, origin: DVec2, velocity: DVec2, after: f64) -> Option<Impact> {
        let mut first: Option<Impact> = None;
        self.visit_impacts(origin, velocity, after, |impact| {
            if first.is_none_or(|known| impact.time < known.time) {
                first = Some(impact);
            }
        });
        first
    }

    /// The number of impacts of a ray; odd from a point inside a closed curve or below a layer boundary (for a ray upwards).
    #[must_use]
    pub fn count_impacts(&self, origin: DVec2, velocity: DVec2) -> usize {
        let mut count = 0;
        self.visit_impacts(origin, velocity, 0.0, |_| count += 1);
        count
    }

    /// The impact near a known place, by Newton's method from there; exact for the shapes that are solved in closed form.
    #[must_use]
    pub fn impact_near(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        guess: f64,
    ) -> Option<Impact> {
        let Shape::Curve(pieces) = &self.shape else {
            return self.first_impact(origin, velocity, after);
        };
        let mut parameter = guess;
        for _ in 0..GUIDED_STEPS {
            let index = (parameter.max(0.0) as usize).min(pieces.len() - 1);
            let t = parameter - index as f64;
            let (position, tangent) = pieces[index].position_and_velocity(t)?;
            let step = velocity.perp_dot(position - origin) / velocity.perp_dot(tangent);
            parameter -= step;
            if !(parameter > -JOINT_SLACK && parameter < pieces.len() as f64 + JOINT_SLACK) {
                return None;
            }
            if step.abs() <= 4.0 * f64::EPSILON * (1.0 + parameter.abs()) {
                let index = (parameter.max(0.0) as usize).min(pieces.len() - 1);
                let impact =
                    pieces[index].impact(parameter - index as f64, index, origin, velocity)?;
                return (impact.time > after).then_some(impact);
            }
        }
        None
    }

    /// Calls `found` for every impact later than `after`, in no order.
    fn visit_impacts(
        &self,
        origin: DVec2,
        velocity: DVec2,
        after: f64,
        mut found: impl FnMut(Impact),
    ) {
        match &self.shape {
            Shape::Line { point, tangent } => {
                let approach = velocity.perp_dot(*tangent);
                let time = (*point - origin).perp_dot(*tangent) / approach;
                if approach != 0.0 && time > after {
                    let point = origin + time * velocity;
                    found(Impact {
                        time,
                        point,
                        tangent: *tangent,
                        curvature: 0.0,
                        parameter: 0.0,
                    });
                }
            }
            Shape::Conic {
                centre,
                form,
                linear,
                constant,
            } => {
                let start = origin - *centre;
                let gradient = *form * start + *linear;
                let a = velocity.dot(*form * velocity);
                let b = velocity.dot(gradient);
                let c = start.dot(gradient + *linear) + constant;
                for time in quadratic_roots(a, b, c)
                    .into_iter()
                    .flatten()
                    .filter(|time| *time > after)
                {
                    let point = origin + time * velocity;
                    let gradient = *form * (point - *centre) + *linear;
                    let Some(tangent) = gradient.perp().try_normalize() else {
                        continue;
                    };
                    let curvature = tangent.dot(*form * tangent) / gradient.length();
                    found(Impact {
                        time,
                        point,
                        tangent,
                        curvature,
                        parameter: 0.0,
                    });
                }
            }
            Shape::Curve(pieces) => {
                for (index, piece) in pieces.iter().enumerate() {
                    if piece.may_meet(origin, velocity) {
                        piece.visit(index, origin, velocity, |impact| {
                            if impact.time > after {
                                found(impact);
                            }
                        });
                    }
                }
            }
        }
    }

    /// Points along the interface inside a box, in order, for drawing and for the checks of a model.
    #[must_use]
    pub fn polyline(&self, low: DVec2, high: DVec2, count: usize) -> Vec<DVec2> {
        let share = |i: usize| i as f64 / count.max(1) as f64;
        match &self.shape {
            Shape::Line { point, tangent } => {
                let reach = (high - low).length() + (0.5 * (low + high) - *point).length();
                let along = |i: usize| *point + (2.0 * share(i) - 1.0) * reach * *tangent;
                (0..=count)
                    .map(along)
                    .filter(|p| p.cmpge(low).all() && p.cmple(high).all())
                    .collect()
            }
            Shape::Conic {
                centre,
                form,
                linear,
                ..
            } => {
                // Rays from the centre (or the focus side of a parabola) meet the conic once on each side.
                let heart = if form.determinant().abs()
                    > 1e-12 * (form.x_axis.length() * form.y_axis.length())
                {
                    *centre - form.inverse() * *linear
                } else {
                    0.5 * (low + high)
                };
                let around = |i: usize| {
                    let direction = DVec2::from_angle(std::f64::consts::TAU * share(i));
                    Some(self.first_impact(heart, direction, 0.0)?.point)
                };
                (0..=count).filter_map(around).collect()
            }
            Shape::Curve(pieces) => {
                let total = pieces.len() as f64;
                let at = |i: usize| {
                    let parameter = total * share(i);
                    let index = (parameter as usize).min(pieces.len() - 1);
                    Some(
                        pieces[index]
                            .position_and_velocity(parameter - index as f64)?
                            .0,
                    )
                };
                (0..=count).filter_map(at).collect()
            }
        }
    }
}

impl Piece {
    fn new(curve: BezierCurve<DVec2>) -> Result<Self, Error> {
        let positions: Option<Vec<DVec2>> = curve
            .control()
            .iter()
            .map(|mass| {
                if mass.weight > 0.0 {
                    mass.position()
                } else {
                    None
                }
            })
            .collect();
        let Some(points) = positions else {
            return Ok(Self {
                curve,
                low: DVec2::NEG_INFINITY,
                high: DVec2::INFINITY,
            });
        };
        let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        if low == high {
            return Err(Error::BadInterface {
                interface: 0,
                reason: "a piece of a curve is a single point",
            });
        }
        let margin = 1e-9 * (high - low).max_element();
        Ok(Self {
            curve,
            low: low - margin,
            high: high + margin,
        })
    }

    fn may_meet(&self, origin: DVec2, velocity: DVec2) -> bool {
        let side = |corner: DVec2| velocity.perp_dot(corner - origin);
        let corners = [
            self.low,
            self.high,
            DVec2::new(self.low.x, self.high.y),
            DVec2::new(self.high.x, self.low.y),
        ];
        if corners.iter().any(|corner| !corner.is_finite()) {
            return true;
        }
        let ahead = corners
            .iter()
            .any(|corner| velocity.dot(*corner - origin) > 0.0);
        let sides = corners.map(side);
        ahead && sides.iter().any(|side| *side >= 0.0) && sides.iter().any(|side| *side <= 0.0)
    }

    fn position_and_velocity(&self, t: f64) -> Option<(DVec2, DVec2)> {
        let jet = self.curve.jet(t);
        Some((jet.position()?, jet.velocity()?))
    }

    fn visit(&self, index: usize, origin: DVec2, velocity: DVec2, mut found: impl FnMut(Impact)) {
        // The sides of the ray's line: <J V, h - w X>, a polynomial in Bernstein form.
        let sides: Vec<f64> = self
            .curve
            .control()
            .iter()
            .map(|mass| velocity.perp_dot(mass.weighted - mass.weight * origin))
            .collect();
        let Ok(roots) = variation::roots(&sides) else {
            return;
        };
        for root in roots.iter() {
            if let Some(impact) = self.impact(root.value(), index, origin, velocity) {
                found(impact);
            }
        }
    }

    fn impact(&self, t: f64, index: usize, origin: DVec2, velocity: DVec2) -> Option<Impact> {
        let jet = self.curve.jet(t);
        let (point, slope, bend) = (jet.position()?, jet.velocity()?, jet.acceleration()?);
        let speed = slope.length();
        if speed == 0.0 {
            return None;
        }
        Some(Impact {
            time: velocity.dot(point - origin) / velocity.length_squared(),
            point,
            tangent: slope / speed,
            curvature: slope.perp_dot(bend) / speed.powi(3),
            parameter: index as f64 + t,
        })
    }
}

/// The real roots of `a x² + 2 b x + c`, without cancellation; a double root once.
fn quadratic_roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    if a == 0.0 {
        return [(b != 0.0).then(|| -c / (2.0 * b)), None];
    }
    let discriminant = b * b - a * c;
    if discriminant < 0.0 || discriminant.is_nan() {
        return [None, None];
    }
    let larger = -(b + discriminant.sqrt().copysign(b));
    if larger == 0.0 {
        return [Some(0.0), None];
    }
    [Some(larger / a), (discriminant > 0.0).then(|| c / larger)]
}

/// The middle weight of the conic in a triangle that passes closest to the inner samples: with barycentric coordinates
/// `(a, b, c)` of a point on it, `w² = b² / (4 a c)`; the mean over the samples, in logarithms, or a parabola without.
fn conic_weight(triangle: [DVec2; 3], inner: impl Iterator<Item = DVec2>) -> f64 {
    let [p, apex, q] = triangle;
    let area = (apex - p).perp_dot(q - p);
    let logarithms = inner.filter_map(|point| {
        let a = (apex - point).perp_dot(q - point) / area;
        let c = (p - point).perp_dot(apex - point) / area;
        let b = 1.0 - a - c;
        (a > 0.0 && b > 0.0 && c > 0.0).then(|| 0.5 * (b * b / (4.0 * a * c)).ln())
    });
    let (sum, count) = logarithms.fold((0.0, 0), |(sum, count), logarithm| {
        (sum + logarithm, count + 1)
    });
    if count == 0 {
        1.0
    } else {
        (sum / f64::from(count)).exp()
    }
}

/// Evaluates the pieces of a graph densely: the largest distance in y between an interface and a function.
#[cfg(test)]
fn graph_error(interface: &Interface, f: impl Fn(f64) -> f64) -> f64 {
    let Shape::Curve(pieces) = &interface.shape else {
        return f64::NAN;
    };
    let points = pieces.iter().flat_map(|piece| {
        (0..=10).filter_map(|i| piece.position_and_velocity(f64::from(i) / 10.0))
    });
    points
        .map(|(p, _)| (p.y - f(p.x)).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn wave(x: f64) -> [f64; 3] {
        let (sine, cosine) = (TAU * x).sin_cos();
        [
            0.5 + 0.06 * sine,
            0.06 * TAU * cosine,
            -0.06 * TAU * TAU * sine,
        ]
    }

    #[test]
    fn shapes_are_hit_where_they_are() {
        let (origin, velocity) = (DVec2::new(-3.0, 0.4), DVec2::new(2.0, 0.1));
        let circle = Interface::circle(DVec2::new(0.2, 0.1), 1.0).unwrap();
        let hit = circle.first_impact(origin, velocity, 0.0).unwrap();
        assert!((hit.point.distance(DVec2::new(0.2, 0.1)) - 1.0).abs() < 1e-14);
        assert!((hit.curvature.abs() - 1.0).abs() < 1e-13 && hit.point.x < 0.0);
        assert_eq!(circle.count_impacts(origin, velocity), 2);
        assert_eq!(circle.count_impacts(DVec2::ZERO, velocity), 1);
        let parabola = Interface::conic([1.0, 0.0, 0.0, 0.0, -4.0, 0.0]).unwrap();
        let hit = parabola
            .first_impact(DVec2::new(1.0, 5.0), DVec2::NEG_Y, 0.0)
            .unwrap();
        assert!((hit.point - DVec2::new(1.0, 0.25)).length() < 1e-15);
        let flat = Interface::horizontal(0.5).unwrap();
        assert!(flat.first_impact(DVec2::ZERO, DVec2::X, 0.0).is_none());
        assert!(
            (flat
                .first_impact(DVec2::ZERO, DVec2::Y * 0.25, 0.0)
                .unwrap()
                .time
                - 2.0)
                .abs()
                < 1e-15
        );
    }

    #[test]
    fn a_graph_is_met_to_its_order_and_found_again_from_nearby() {
        let coarse = Interface::graph(-1.0, 2.0, 60, wave).unwrap();
        let fine = Interface::graph(-1.0, 2.0, 120, wave).unwrap();
        let (first, second) = (
            graph_error(&coarse, |x| wave(x)[0]),
            graph_error(&fine, |x| wave(x)[0]),
        );
        assert!(
            ((first / second).log2() - 6.0).abs() < 0.5,
            "{first:e} {second:e}"
        );
        assert!(second < 1e-10);
        let (origin, velocity) = (DVec2::new(0.3, 1.0), DVec2::new(0.2, -1.0));
        let hit = fine.first_impact(origin, velocity, 0.0).unwrap();
        assert!((hit.point.y - wave(hit.point.x)[0]).abs() < 1e-10);
        let again = fine
            .impact_near(origin, velocity, 0.0, hit.parameter + 0.3)
            .unwrap();
        assert!((again.time - hit.time).abs() < 1e-14);
        let [_, slope, bend] = wave(hit.point.x);
        assert!((hit.curvature - bend / (1.0 + slope * slope).powf(1.5)).abs() < 1e-5);
    }

    #[test]
    fn conics_are_fitted_to_samples_of_a_conic_exactly() {
        let sample = |i: u32| {
            let angle = 0.1 * f64::from(i);
            (
                DVec2::new(2.0 * angle.cos(), angle.sin()),
                DVec2::new(-2.0 * angle.sin(), angle.cos()),
            )
        };
        let samples: Vec<_> = (0..=20).map(sample).collect();
        let interface = Interface::fit_conics(&samples, 5).unwrap();
        for point in interface.polyline(DVec2::splat(-9.0), DVec2::splat(9.0), 100) {
            assert!(((point.x / 2.0).powi(2) + point.y.powi(2) - 1.0).abs() < 1e-13);
        }
        let inflected = [(DVec2::ZERO, DVec2::ONE), (DVec2::X, DVec2::ONE)];
        assert!(matches!(
            Interface::fit_conics(&inflected, 1),
            Err(Error::BadInterface { .. })
        ));
    }

    #[test]
    fn shapes_that_are_none_are_refused() {
        assert!(matches!(
            Interface::circle(DVec2::ZERO, 0.0),
            Err(Error::BadInterface { .. })
        ));
        assert!(matches!(
            Interface::circle(DVec2::NAN, 1.0),
            Err(Error::NonFinite { .. })
        ));
        assert!(matches!(
            Interface::line(DVec2::ZERO, DVec2::ZERO),
            Err(Error::ZeroDirection { .. })
        ));
        assert!(matches!(
            Interface::conic([0.0; 6]),
            Err(Error::BadInterface { .. })
        ));
        assert!(matches!(
            Interface::curve([]),
            Err(Error::BadInterface { .. })
        ));
        assert!(matches!(
            Interface::graph(0.0, 0.0, 5, wave),
            Err(Error::OutOfRange { .. })
        ));
    }
}
