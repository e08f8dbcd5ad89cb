//! To and from kurbo's paths (feature `kurbo`).

use glam::DVec2;
use kurbo::{BezPath, PathEl, Point};

use crate::cubic_path::line_cubic;
use crate::{ArcSpline, CubicPath, Error, Piece};

/// Halvings of one piece before its cubics are taken as they are; the error falls by 16 with each.
const MOST_DEPTH: u32 = 20;

fn vector(point: Point) -> DVec2 {
    DVec2::new(point.x, point.y)
}

fn point(vector: DVec2) -> Point {
    Point::new(vector.x, vector.y)
}

impl CubicPath {
    /// The subpaths of a kurbo path, each a connected chain of cubics; subpaths that are a single point are left out.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::TooFew`] if nothing is drawn.
    pub fn from_kurbo(path: &BezPath) -> Result<Vec<Self>, Error> {
        let mut paths = Vec::new();
        let mut cubics: Vec<[DVec2; 4]> = Vec::new();
        let mut current = DVec2::ZERO;
        let mut start = DVec2::ZERO;
        let mut finish = |cubics: &mut Vec<[DVec2; 4]>, closed: bool| -> Result<(), Error> {
            if cubics.is_empty() {
                return Ok(());
            }
            match Self::new(std::mem::take(cubics), closed) {
                Err(Error::SinglePoint) => Ok(()),
                other => other.map(|path| paths.push(path)),
            }
        };
        for element in path.elements() {
            let cubic = match *element {
                PathEl::MoveTo(to) => {
                    finish(&mut cubics, false)?;
                    (current, start) = (vector(to), vector(to));
                    continue;
                }
                PathEl::ClosePath => {
                    finish(&mut cubics, true)?;
                    current = start;
                    continue;
                }
                PathEl::LineTo(to) => line_cubic(current, vector(to)),
                PathEl::QuadTo(control, to) => {
                    let (control, to) = (vector(control), vector(to));
                    [
                        current,
                        current.lerp(control, 2.0 / 3.0),
                        to.lerp(control, 2.0 / 3.0),
                        to,
                    ]
                }
                PathEl::CurveTo(a, b, to) => [current, vector(a), vector(b), vector(to)],
            };
            current = cubic[3];
            cubics.push(cubic);
        }
        finish(&mut cubics, false)?;
        if paths.is_empty() {
            return Err(Error::TooFew {
                what: "drawn segments",
                given: 0,
                needed: 1,
            });
        }
        Ok(paths)
    }
}

impl ArcSpline {
    /// The spline as a kurbo path of lines and cubics within `tolerance`: kurbo has no rational curves.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless `tolerance` is positive and finite.
    pub fn to_kurbo(&self, tolerance: f64) -> Result<BezPath, Error> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(Error::BadTolerance { tolerance });
        }
        let mut path = BezPath::new();
        let mut pen: Option<DVec2> = None;
        for piece in &self.pieces {
            if pen.is_none() {
                path.move_to(point(piece.point(0.0)));
            }
            pen = Some(piece.point(1.0));
            match piece {
                Piece::Segment(segment) => path.line_to(point(segment.end())),
                _ => push_cubics(&mut path, piece, tolerance),
            }
        }
        if self.closed && pen.is_some() {
            path.close_path();
        }
        Ok(path)
    }
}

/// Cubics with the derivatives of the piece at their ends, halved until three inner points agree.
fn push_cubics(path: &mut BezPath, piece: &Piece, tolerance: f64) {
    let mut waiting = vec![(0.0, 1.0, 0)];
    while let Some((from, to, depth)) = waiting.pop() {
        let third = (to - from) / 3.0;
        let (a, d) = (piece.point(from), piece.point(to));
        let (b, c) = (
            a + piece.velocity(from) * third,
            d - piece.velocity(to) * third,
        );
        let cubic = [a, b, c, d];
        let agrees = [0.25, 0.5, 0.75].iter().all(|share| {
            let on_cubic = bezier_mass::bernstein::evaluate(&cubic, *share);
            (on_cubic - piece.point(from + (to - from) * share)).length() <= tolerance
        });
        if agrees || depth >= MOST_DEPTH {
            path.curve_to(point(b), point(c), point(d));
        } else {
            let middle = 0.5 * (from + to);
            waiting.push((middle, to, depth + 1));
            waiting.push((from, middle, depth + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Approximation, approximate};
    use kurbo::{ParamCurve, Shape};

    #[test]
    fn a_path_survives_the_way_there_and_back() {
        let path = BezPath::from_svg("M0 0 L10 0 Q14 3 10 6 C6 9 3 8 0 6 Z M20 20 L30 20").unwrap();
        let cubics = CubicPath::from_kurbo(&path).unwrap();
        assert_eq!(cubics.len(), 2);
        let spline = approximate(&cubics[0], &Approximation::within(1e-7))
            .unwrap()
            .spline;
        let back = spline.to_kurbo(1e-7).unwrap();
        let first = BezPath::from_svg("M0 0 L10 0 Q14 3 10 6 C6 9 3 8 0 6 Z").unwrap();
        assert!((back.area() - first.area()).abs() < 1e-4);
        for segment in back.segments() {
            let nearest = first
                .segments()
                .map(|s| kurbo::ParamCurveNearest::nearest(&s, segment.eval(0.4), 1e-9).distance_sq)
                .fold(f64::INFINITY, f64::min);
            assert!(nearest.sqrt() < 1e-6);
        }
    }

    #[test]
    fn empty_and_broken_paths_are_refused() {
        assert!(CubicPath::from_kurbo(&BezPath::new()).is_err());
        assert!(CubicPath::from_kurbo(&BezPath::from_svg("M1 1 L1 1").unwrap()).is_err());
        let mut broken = BezPath::new();
        broken.move_to((0.0, 0.0));
        broken.line_to((f64::NAN, 1.0));
        assert!(matches!(
            CubicPath::from_kurbo(&broken),
            Err(Error::NonFinite { .. })
        ));
    }
}
