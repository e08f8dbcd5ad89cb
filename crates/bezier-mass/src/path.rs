//! Conversion to and from kurbo paths (feature `kurbo`).
//!
//! A kurbo path holds lines and polynomial quadratics and cubics. Those become Bézier curves of this crate exactly, and
//! come back exactly; a rational curve, or one of higher degree, becomes cubics within an accuracy that is proven, not
//! sampled.

use crate::{BezierCurve, Error, MassPoint, VectorSpace, bernstein};
use ::kurbo::{BezPath, CubicBez, Line, PathEl, PathSeg, Point, QuadBez};
use glam::{DVec2, dvec2};

/// Halvings of a curve before its approximation by cubics is given up: at this depth a piece of `[0, 1]` is as long as
/// the spacing of parameters near one, and the error of a smooth piece has long been below rounding.
const MAX_DEPTH: i32 = 40;

fn from_kurbo(point: Point) -> DVec2 {
    dvec2(point.x, point.y)
}

fn to_kurbo(point: DVec2) -> Point {
    Point::new(point.x, point.y)
}

/// A segment of a path as a polynomial Bézier curve of degree one to three.
impl TryFrom<PathSeg> for BezierCurve<DVec2> {
    type Error = Error;

    fn try_from(segment: PathSeg) -> Result<Self, Error> {
        match segment {
            PathSeg::Line(Line { p0, p1 }) => Self::polynomial(&[p0, p1].map(from_kurbo)),
            PathSeg::Quad(QuadBez { p0, p1, p2 }) => {
                Self::polynomial(&[p0, p1, p2].map(from_kurbo))
            }
            PathSeg::Cubic(CubicBez { p0, p1, p2, p3 }) => {
                Self::polynomial(&[p0, p1, p2, p3].map(from_kurbo))
            }
        }
    }
}

/// The segments of a path as Bézier curves, in order; closing lines included.
///
/// # Errors
/// [`Error::NonFinite`].
pub fn curves_of(path: &BezPath) -> Result<Vec<BezierCurve<DVec2>>, Error> {
    path.segments().map(BezierCurve::try_from).collect()
}

/// A path through all `curves`, within `accuracy` (a length) of them.
///
/// A polynomial curve of degree at most three is taken over exactly. Any other is halved until, on each part, the cubic
/// with its end points and end velocities is certified to be within the accuracy at equal parameters. A new subpath
/// begins where a curve does not start at the end of the one before.
///
/// # Errors
/// [`Error::AtInfinity`] if a curve passes through infinity in `[0, 1]`; [`Error::AccuracyNotReached`] if 40 halvings do
/// not suffice (an accuracy below rounding, or not positive).
pub fn path_of(curves: &[BezierCurve<DVec2>], accuracy: f64) -> Result<BezPath, Error> {
    let mut path = BezPath::new();
    let mut end = None;
    for curve in curves {
        let start = curve.point(0.0)?;
        if end != Some(start) {
            path.move_to(to_kurbo(start));
        }
        match exact_element(curve) {
            Some(element) => path.push(element),
            None => push_cubics(curve, accuracy, &mut path)?,
        }
        end = Some(curve.point(1.0)?);
    }
    Ok(path)
}

/// The path element of a polynomial curve of degree one to three.
fn exact_element(curve: &BezierCurve<DVec2>) -> Option<PathEl> {
    let weight = curve.control().first()?.weight;
    if curve.control().iter().any(|h| h.weight != weight) {
        return None;
    }
    let points: Vec<Point> = curve
        .control()
        .iter()
        .map(|h| h.position().map(to_kurbo))
        .collect::<Option<_>>()?;
    match points[..] {
        [p] | [_, p] => Some(PathEl::LineTo(p)),
        [_, p1, p2] => Some(PathEl::QuadTo(p1, p2)),
        [_, p1, p2, p3] => Some(PathEl::CurveTo(p1, p2, p3)),
        _ => None,
    }
}

/// Appends cubics that are certified to follow the curve.
fn push_cubics(curve: &BezierCurve<DVec2>, accuracy: f64, path: &mut BezPath) -> Result<(), Error> {
    if let Some(t) = vanishing_weight(curve.control().iter().map(|h| h.weight).collect()) {
        return Err(Error::AtInfinity { t });
    }
    // Parts still to do, the next one last.
    let mut parts = vec![(curve.clone(), 0)];
    while let Some((part, depth)) = parts.pop() {
        let error = match hermite_cubic(&balanced(&part)) {
            Some((cubic, error)) if error <= accuracy => {
                let [_, p1, p2, p3] = cubic.map(to_kurbo);
                path.curve_to(p1, p2, p3);
                continue;
            }
            Some((_, error)) => error,
            None => f64::INFINITY,
        };
        if depth == MAX_DEPTH {
            return Err(Error::AccuracyNotReached { accuracy, error });
        }
        let (first, second) = part.subdivide(0.5);
        parts.extend([(second, depth + 1), (first, depth + 1)]);
    }
    Ok(())
}

/// The same curve with end weights of equal size, by a homography: its parameter then runs as evenly as it can, and a
/// cubic follows it better.
fn balanced(curve: &BezierCurve<DVec2>) -> BezierCurve<DVec2> {
    let [start, end] = [0.0, 1.0].map(|t| curve.at(t).weight.abs());
    let ratio = (start / end).powf(1.0 / curve.degree().max(1) as f64);
    let mut factor = 1.0 / ratio;
    let control = curve.control().iter().map(|&h| {
        factor *= ratio;
        h * factor
    });
    // Finite because both end weights are, or the curve as it is.
    BezierCurve::new(control.collect()).unwrap_or_else(|_| curve.clone())
}

/// The first parameter in `[0, 1]` near which the weight is not proven to keep its sign, to the resolution of 40 halvings.
fn vanishing_weight(weights: Vec<f64>) -> Option<f64> {
    let mut parts = vec![(weights, 0.0, 1.0)];
    while let Some((weights, start, length)) = parts.pop() {
        if weights.iter().all(|&w| w > 0.0) || weights.iter().all(|&w| w < 0.0) {
            continue;
        }
        if length <= f64::powi(0.5, MAX_DEPTH) {
            return Some(start);
        }
        let (first, second) = bernstein::subdivide(&weights, 0.5);
        parts.extend([
            (second, start + 0.5 * length, 0.5 * length),
            (first, start, 0.5 * length),
        ]);
    }
    None
}

/// The cubic with the end points and end velocities of the curve, and a bound on its distance from the curve at equal
/// parameters. `None` unless the weights prove that the curve stays finite.
///
/// With `P = X / w` and the cubic `B`, `P - B = (X - w B) / w`: the numerator is a polynomial whose Bernstein
/// coefficients bound it, and the smallest weight bounds the denominator.
fn hermite_cubic(curve: &BezierCurve<DVec2>) -> Option<([DVec2; 4], f64)> {
    let control = curve.control();
    let sign = control.first()?.weight.signum();
    let weights: Vec<f64> = control.iter().map(|h| h.weight * sign).collect();
    let smallest = weights.iter().copied().fold(f64::INFINITY, f64::min);
    if smallest <= 0.0 {
        return None;
    }
    let [start, end] = [0.0, 1.0].map(|t| curve.jet(t));
    let (p0, p3) = (start.position()?, end.position()?);
    let cubic = [
        p0,
        p0 + start.velocity()? / 3.0,
        p3 - end.velocity()? / 3.0,
        p3,
    ];
    // About p0, so that the two polynomials of the difference are no larger than the curve.
    let weighted: Vec<DVec2> = control
        .iter()
        .map(|h: &MassPoint<DVec2>| h.translated(-p0).weighted * sign)
        .collect();
    let difference = bernstein::elevate_to(&weighted, control.len() + 2).into_iter();
    let product = bernstein::product(&weights, &cubic.map(|p| p - p0));
    let largest = difference
        .zip(product)
        .map(|(x, y)| (x - y).length())
        .fold(0.0, f64::max);
    let bound = largest / smallest;
    (bound.is_finite() && cubic.iter().all(|p| VectorSpace::is_finite(*p)))
        .then_some((cubic, bound))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Parameter, Quadratic};
    use ::kurbo::{ParamCurve, ParamCurveNearest, Shape};

    #[test]
    fn polynomial_paths_come_back_unchanged() -> Result<(), Error> {
        let mut path = BezPath::new();
        path.move_to((0.0, 0.0));
        path.line_to((1.0, 0.5));
        path.quad_to((2.0, 2.0), (3.0, 0.0));
        path.curve_to((4.0, -1.0), (5.0, 1.0), (6.0, 0.25));
        path.move_to((9.0, 9.0));
        path.line_to((8.0, 8.0));
        let curves = curves_of(&path)?;
        assert_eq!(
            curves.iter().map(BezierCurve::degree).collect::<Vec<_>>(),
            [1, 2, 3, 1]
        );
        assert_eq!(path_of(&curves, 1e-9)?, path);
        for (curve, segment) in curves.iter().zip(path.segments()) {
            assert!((curve.point(0.3)? - from_kurbo(segment.eval(0.3))).length() < 1e-15);
        }
        Ok(())
    }

    #[test]
    fn a_rational_curve_becomes_cubics_within_the_accuracy() -> Result<(), Error> {
        let half = Quadratic::circular_arc(DVec2::ZERO, [DVec2::X, -DVec2::X], [1.0, 1.0])?;
        let mut before = 0;
        for accuracy in [1e-2, 1e-4, 1e-6, 1e-9] {
            let path = path_of(&[half.into()], accuracy)?;
            let cubics = path.segments().count();
            assert!(
                cubics > before || accuracy > 1e-3,
                "{cubics} cubics for {accuracy}"
            );
            before = cubics;
            for segment in path.segments() {
                for i in 0..=32 {
                    let off = segment.eval(f64::from(i) / 32.0).to_vec2().hypot() - 1.0;
                    assert!(off.abs() <= accuracy, "{off} for {accuracy}");
                }
            }
            for i in 0..=64 {
                let point = to_kurbo(half.point(f64::from(i) / 64.0)?);
                let nearest = path
                    .segments()
                    .map(|s| s.nearest(point, 1e-12).distance_sq)
                    .fold(f64::INFINITY, f64::min);
                assert!(nearest.sqrt() <= accuracy + 1e-12);
            }
        }
        Ok(())
    }

    #[test]
    fn kurbo_agrees_on_the_length_of_a_circle() -> Result<(), Error> {
        let half = Quadratic::circular_arc(DVec2::ZERO, [DVec2::X, -DVec2::X], [1.0, 1.0])?;
        let path = path_of(&[half.into(), half.complement().reversed().into()], 1e-10)?;
        assert!((path.perimeter(1e-10) - core::f64::consts::TAU).abs() < 1e-8);
        assert_eq!(
            path.elements()
                .iter()
                .filter(|e| matches!(e, PathEl::MoveTo(_)))
                .count(),
            1
        );
        Ok(())
    }

    #[test]
    fn what_no_path_can_hold_is_refused() -> Result<(), Error> {
        let branch = Quadratic::hyperbola_as_semicircle(
            [DVec2::ZERO, DVec2::X, DVec2::ONE],
            2.0,
            crate::Half::Along,
        )?;
        assert!(matches!(
            path_of(&[branch.into()], 1e-3),
            Err(Error::AtInfinity { .. })
        ));
        let vectors = branch.sub_arc(0.5, Parameter::from(1.0))?;
        assert!(matches!(
            path_of(&[vectors.into()], 1e-3),
            Err(Error::AtInfinity { t: 0.0 })
        ));
        let half = Quadratic::circular_arc(DVec2::ZERO, [DVec2::X, -DVec2::X], [1.0, 1.0])?;
        for accuracy in [0.0, -1.0, f64::NAN] {
            assert!(
                matches!(
                    path_of(&[half.into()], accuracy),
                    Err(Error::AccuracyNotReached { .. })
                ),
                "{accuracy}"
            );
        }
        let wild = PathSeg::Line(Line::new((0.0, 0.0), (f64::NAN, 1.0)));
        assert!(matches!(
            BezierCurve::try_from(wild),
            Err(Error::NonFinite { .. })
        ));
        Ok(())
    }
}
