//! What the peers are given: each the input and the call that suits it best.

use cavalier_contours::polyline::{PlineSource as _, PlineSourceMut as _, Polyline, seg_midpoint};
use glam::DVec2;
use kurbo::{BezPath, CubicBez, CurveFitSample, ParamCurveFit, PathEl, PathSeg, Point, Vec2};
use ph_curves::{CubicPath, PlaneCurve as _};

fn point(p: DVec2) -> Point {
    Point::new(p.x, p.y)
}

fn vector(v: DVec2) -> Vec2 {
    Vec2::new(v.x, v.y)
}

/// The spans of a curve as kurbo's cubics.
pub(super) fn cubics(curve: &CubicPath) -> Vec<CubicBez> {
    let cubic = |c: &[DVec2; 4]| CubicBez::new(point(c[0]), point(c[1]), point(c[2]), point(c[3]));
    curve.cubics().iter().map(cubic).collect()
}

/// kurbo's offset of every span to the right of travel, one after the other with one scratch path.
pub(super) fn offset_cubics(cubics: &[CubicBez], distance: f64, tolerance: f64) -> Vec<PathEl> {
    let mut elements = Vec::new();
    let mut scratch = BezPath::new();
    for cubic in cubics {
        kurbo::offset::offset_cubic(*cubic, -distance, tolerance, &mut scratch);
        elements.extend_from_slice(scratch.elements());
    }
    elements
}

/// The segments drawn by these elements.
pub(super) fn segments(elements: &[PathEl]) -> Vec<PathSeg> {
    kurbo::segments(elements.iter().copied()).collect()
}

/// The exact offset of a whole curve, as kurbo's curve fitter wants it.
pub(super) struct Offset<'a> {
    pub(super) curve: &'a CubicPath,
    pub(super) distance: f64,
}

impl Offset<'_> {
    /// Point and derivative at `t` of the whole in [0, 1].
    fn jet(&self, t: f64) -> (DVec2, DVec2) {
        let spans = self.curve.spans();
        let global = t * spans as f64;
        let span = (global as usize).min(spans - 1);
        let [point, first, second] = self.curve.jet(span, global - span as f64);
        let speed = first.length();
        let curvature = first.perp_dot(second) / (speed * speed * speed);
        (
            point - first.perp() * (self.distance / speed),
            first * ((1.0 + self.distance * curvature) * spans as f64),
        )
    }
}

impl ParamCurveFit for Offset<'_> {
    fn sample_pt_tangent(&self, t: f64, _sign: f64) -> CurveFitSample {
        let (p, tangent) = self.jet(t);
        CurveFitSample {
            p: point(p),
            tangent: vector(tangent),
        }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        let (p, derivative) = self.jet(t);
        (point(p), vector(derivative))
    }

    fn break_cusp(&self, _range: std::ops::Range<f64>) -> Option<f64> {
        None
    }
}

/// An arc through three points of the curve per part, halved until the points between lie on it: cavalier's best input.
pub(super) fn arcs(curve: &CubicPath, tolerance: f64) -> Polyline<f64> {
    let mut polyline = Polyline::new();
    let mut end = DVec2::ZERO;
    let mut waiting = Vec::new();
    for span in 0..curve.spans() {
        waiting.push((0.0, 1.0));
        while let Some((from, to)) = waiting.pop() {
            let at = |share: f64| curve.jet(span, from + (to - from) * share)[0];
            let (a, m, b) = (at(0.0), at(0.5), at(1.0));
            let turn = (m - a).perp_dot(b - m).atan2((m - a).dot(b - m));
            // The bulge is the tangent of a quarter of the sweep, and the sweep is twice the turn of the chords.
            let bulge = (0.5 * turn).tan();
            let along = (b - a).normalize();
            let radius = 0.5 * (b - a).length() / turn.sin();
            let centre = 0.5 * (a + b) + along.perp() * (radius * turn.cos());
            let off = [0.25, 0.75].iter().any(|share| {
                let p = at(*share);
                let distance = if turn.abs() < 1e-9 {
                    (p - a).perp_dot(along).abs()
                } else {
                    ((p - centre).length() - radius.abs()).abs()
                };
                distance > tolerance
            });
            if off && to - from > 1e-9 {
                let middle = 0.5 * (from + to);
                waiting.push((middle, to));
                waiting.push((from, middle));
            } else {
                polyline.add(a.x, a.y, bulge);
                end = b;
            }
        }
    }
    if curve.is_closed() {
        polyline.set_is_closed(true);
    } else {
        polyline.add(end.x, end.y, 0.0);
    }
    polyline
}

/// cavalier's trimmed offset to the right of travel.
pub(super) fn parallel_offset(input: &Polyline<f64>, distance: f64) -> Vec<Polyline<f64>> {
    input.parallel_offset(-distance)
}

/// The vertices of polylines, and the middles of their arcs.
pub(super) fn points(outlines: &[Polyline<f64>]) -> Vec<DVec2> {
    outlines
        .iter()
        .flat_map(|outline| outline.iter_segments())
        .flat_map(|(from, to)| {
            let middle = seg_midpoint(from, to);
            [from.pos(), middle, to.pos()].map(|p| DVec2::new(p.x, p.y))
        })
        .collect()
}

/// The number of segments of polylines.
pub(super) fn segment_count(outlines: &[Polyline<f64>]) -> usize {
    outlines
        .iter()
        .map(|outline| outline.iter_segments().count())
        .sum()
}
