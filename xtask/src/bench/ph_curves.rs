//! Offsets against kurbo and cavalier_contours on four curves, arc length against kurbo, interpolator steps.
//!
//! Curves have size 100, the distance is 5, tolerances and errors are relative to the size. Errors of both sides are
//! measured: the distance from dense points of the exact offset to the result.

use std::hint::black_box;

use anyhow::Result;
use cavalier_contours::polyline::{PlineSource as _, PlineSourceMut as _, Polyline};
use glam::{DVec2, dvec2};
use kurbo::{
    BezPath, CubicBez, ParamCurve as _, ParamCurveArclen as _, ParamCurveNearest as _, Point,
};
use ph_curves::{
    Approximation, ArcSpline, CubicPath, FeedInterpolator, FeedRate, Hermite, PhSpline, PlaneCurve,
    SplineEnds, approximate,
};
use serde_json::{Value, json};

use super::{Bench, Timer};

#[derive(clap::Args, Debug)]
pub(super) struct PhCurves {}

const SIZE: f64 = 100.0;
const DISTANCE: f64 = 5.0;
/// Points per span at which the exact offset is compared.
const SAMPLES: usize = 10;

impl Bench for PhCurves {
    const NAME: &'static str = "ph-curves";
    const ABOUT: &'static str =
        "Offsets, arc length and interpolation, against kurbo and cavalier_contours";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let mut rows = Vec::new();
        for (name, curve) in curves()? {
            for tolerance in [1e-6, 1e-9] {
                offset_rows(timer, name, &curve, tolerance, &mut rows)?;
            }
            for tolerance in [1e-6, 1e-9] {
                rows.push(trimmed_row(timer, name, &curve, tolerance)?);
            }
        }
        for (name, curve) in degenerate()? {
            rows.push(degenerate_row(timer, name, &curve)?);
        }
        rows.extend(length_rows(timer)?);
        rows.push(interpolator_row(timer)?);
        Ok(json!({ "rows": rows }))
    }
}

/// The four curves: a cubic of moderate curvature, one with an inflection, a spiral of 20 spans, a closed loop of 40.
fn curves() -> Result<Vec<(&'static str, CubicPath)>> {
    let cubic = |p: [(f64, f64); 4]| CubicPath::new(vec![p.map(DVec2::from)], false);
    let spiral: Vec<DVec2> = (0..23)
        .map(|k| DVec2::from_angle(0.45 * f64::from(k)) * (12.0 + 1.75 * f64::from(k)))
        .collect();
    let wavy: Vec<DVec2> = (0..40)
        .map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 40.0;
            DVec2::from_angle(angle)
                * (42.0 + 5.0 * (3.0 * angle).sin() + 3.0 * (7.0 * angle + 1.0).cos())
        })
        .collect();
    Ok(vec![
        (
            "a",
            cubic([(0.0, 0.0), (20.0, 70.0), (80.0, 70.0), (100.0, 0.0)])?,
        ),
        (
            "b",
            cubic([(0.0, 0.0), (40.0, 60.0), (60.0, -60.0), (100.0, 0.0)])?,
        ),
        ("c", CubicPath::uniform_bspline(&spiral, false)?),
        ("d", CubicPath::uniform_bspline(&wavy, true)?),
    ])
}

/// Inputs on which offset code goes astray, size 100.
fn degenerate() -> Result<Vec<(&'static str, CubicPath)>> {
    let cubic = |p: [(f64, f64); 4]| CubicPath::new(vec![p.map(DVec2::from)], false);
    Ok(vec![
        (
            "cusp in the offset",
            cubic([(0.0, 0.0), (50.0, 2.0), (50.0, 2.0), (100.0, 0.0)])?,
        ),
        (
            "zero derivative at the start",
            cubic([(0.0, 0.0), (0.0, 0.0), (60.0, 80.0), (100.0, 0.0)])?,
        ),
        (
            "near-cusp",
            cubic([(0.0, 0.0), (100.0, 100.0001), (0.0, 100.0), (100.0, 0.0)])?,
        ),
        (
            "interior cusp",
            cubic([(0.0, 0.0), (100.0, 100.0), (0.0, 100.0), (100.0, 0.0)])?,
        ),
        (
            "collinear with turn-back",
            cubic([(0.0, 0.0), (150.0, 0.0), (-50.0, 0.0), (100.0, 0.0)])?,
        ),
    ])
}

fn cubics(curve: &CubicPath) -> Vec<CubicBez> {
    let point = |p: DVec2| Point::new(p.x, p.y);
    curve
        .cubics()
        .iter()
        .map(|c| CubicBez::new(point(c[0]), point(c[1]), point(c[2]), point(c[3])))
        .collect()
}

/// Points of the exact offset, to the right.
fn exact_offset(curve: &CubicPath) -> Vec<DVec2> {
    let mut points = Vec::new();
    for span in 0..curve.spans() {
        for k in 0..=SAMPLES {
            let [point, first, _] = curve.jet(span, (k as f64 + 1e-3) / (SAMPLES as f64 + 2e-3));
            points.push(point - first.normalize().perp() * DISTANCE);
        }
    }
    points
}

fn error_of(points: &[DVec2], distance: impl Fn(DVec2) -> f64) -> f64 {
    points.iter().map(|p| distance(*p)).fold(0.0, f64::max) / SIZE
}

fn spline_error(points: &[DVec2], chains: &[ArcSpline]) -> f64 {
    let pieces: Vec<_> = chains.iter().flat_map(ArcSpline::pieces).collect();
    error_of(points, |p| {
        pieces
            .iter()
            .map(|piece| piece.distance(p))
            .fold(f64::INFINITY, f64::min)
    })
}

fn path_error(points: &[DVec2], paths: &[BezPath]) -> f64 {
    let segments: Vec<_> = paths.iter().flat_map(BezPath::segments).collect();
    error_of(points, |p| {
        segments
            .iter()
            .map(|s| s.nearest(Point::new(p.x, p.y), 1e-9).distance_sq.sqrt())
            .fold(f64::INFINITY, f64::min)
    })
}

/// kurbo's offset of every span, to the same side.
fn kurbo_offset(cubics: &[CubicBez], tolerance: f64) -> Vec<BezPath> {
    cubics
        .iter()
        .map(|cubic| {
            let mut path = BezPath::new();
            kurbo::offset::offset_cubic(*cubic, -DISTANCE, tolerance, &mut path);
            path
        })
        .collect()
}

fn offset_rows(
    timer: &Timer,
    name: &str,
    curve: &CubicPath,
    tolerance: f64,
    rows: &mut Vec<Value>,
) -> Result<()> {
    let absolute = tolerance * SIZE;
    let peer = cubics(curve);
    let points = exact_offset(curve);
    let paths = kurbo_offset(&peer, absolute);
    let peer_ns = timer.nanoseconds(|| kurbo_offset(black_box(&peer), absolute));
    let peer_pieces: usize = paths.iter().map(|path| path.elements().len() - 1).sum();
    let peer_error = path_error(&points, &paths);
    let mut row = |work: &str, ns: f64, pieces: usize, error: f64| {
        rows.push(json!({
            "work": work, "curve": name, "tolerance": tolerance, "ns": ns, "pieces": pieces, "error": error,
            "peer": "kurbo offset_cubic", "peer_ns": peer_ns, "peer_pieces": peer_pieces, "peer_error": peer_error,
            "ratio": ns / peer_ns,
        }));
    };
    for (class, how) in [
        ("class 3", Approximation::within(absolute)),
        ("class 9", Approximation::fewest(absolute)),
    ] {
        let convert = || -> Result<ArcSpline, ph_curves::Error> {
            approximate(black_box(curve), &how)?.spline.offset(DISTANCE)
        };
        let offset = convert()?;
        let error = spline_error(&points, std::slice::from_ref(&offset));
        row(
            &format!("convert and offset, {class}"),
            timer.nanoseconds(convert),
            offset.pieces().len(),
            error,
        );
        let spline = approximate(curve, &how)?.spline;
        let further = timer.nanoseconds(|| black_box(&spline).offset(DISTANCE));
        row(
            &format!("further offset, {class}"),
            further,
            offset.pieces().len(),
            own_error(&spline, &offset),
        );
    }
    Ok(())
}

/// Error of the offset against the spline's own normals.
fn own_error(spline: &ArcSpline, offset: &ArcSpline) -> f64 {
    let mut worst = 0.0_f64;
    for (piece, moved) in spline.pieces().iter().zip(offset.pieces()) {
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            worst =
                worst.max((moved.point(t) - piece.point(t) - piece.normal(t) * DISTANCE).length());
        }
    }
    worst / SIZE
}

/// An arc through three points of the curve per part, halved until the points between lie on it: cavalier's best input.
fn arcs(curve: &CubicPath, tolerance: f64) -> Polyline<f64> {
    let mut polyline = Polyline::new();
    let mut end = DVec2::ZERO;
    for span in 0..curve.spans() {
        let mut waiting = vec![(0.0, 1.0)];
        while let Some((from, to)) = waiting.pop() {
            let at = |share: f64| curve.jet(span, from + (to - from) * share)[0];
            let (a, m, b) = (at(0.0), at(0.5), at(1.0));
            let turn = (m - a).perp_dot(b - m).atan2((m - a).dot(b - m));
            // The bulge is the tangent of a quarter of the sweep, and the sweep is twice the turn of the chords.
            let bulge = (0.5 * turn).tan();
            let (cosine, sine) = ((b - a).normalize(), (b - a).normalize().perp());
            let radius = 0.5 * (b - a).length() / turn.sin();
            let centre = 0.5 * (a + b) + sine * (radius * turn.cos());
            let off = [0.25, 0.75].iter().any(|s| {
                let p = at(*s);
                let distance = if turn.abs() < 1e-9 {
                    (p - a).perp_dot(cosine).abs()
                } else {
                    ((p - centre).length() - radius.abs()).abs()
                };
                distance > tolerance
            });
            if off && to - from > 1e-9 {
                waiting.push((0.5 * (from + to), to));
                waiting.push((from, 0.5 * (from + to)));
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

fn trimmed_row(timer: &Timer, name: &str, curve: &CubicPath, tolerance: f64) -> Result<Value> {
    let absolute = tolerance * SIZE;
    // Counter-clockwise loops are offset inwards.
    let distance = if curve.is_closed() {
        -DISTANCE
    } else {
        DISTANCE
    };
    let how = Approximation::fewest(absolute);
    let ours = || -> Result<Vec<ArcSpline>, ph_curves::Error> {
        approximate(black_box(curve), &how)?
            .spline
            .trimmed_offset(distance)
    };
    let chains = ours()?;
    let theirs = || arcs(black_box(curve), absolute).parallel_offset(-distance);
    let outlines = theirs();
    let ns = timer.nanoseconds(ours);
    let peer_ns = timer.nanoseconds(theirs);
    // Points of the result that are not at the distance, on both sides.
    let on_curve: Vec<DVec2> = (0..curve.spans())
        .flat_map(|span| (0..=60).map(move |k| (span, f64::from(k) / 60.0)))
        .map(|(span, t)| curve.jet(span, t)[0])
        .collect();
    let spline = approximate(curve, &Approximation::fewest(1e-10 * SIZE))?.spline;
    let away = |p: DVec2| {
        let nearest = on_curve
            .iter()
            .map(|q| (*q - p).length())
            .fold(f64::INFINITY, f64::min);
        if (nearest - DISTANCE).abs() > 0.5 {
            return (nearest - DISTANCE).abs();
        }
        let exact = spline
            .pieces()
            .iter()
            .map(|piece| piece.distance(p))
            .fold(f64::INFINITY, f64::min);
        (exact - DISTANCE).abs()
    };
    let mut error = 0.0_f64;
    for piece in chains.iter().flat_map(ArcSpline::pieces) {
        for k in 0..=4 {
            error = error.max(away(piece.point(f64::from(k) / 4.0)));
        }
    }
    let mut peer_error = 0.0_f64;
    for (a, b) in outlines
        .iter()
        .flat_map(|outline| outline.iter_segments().collect::<Vec<_>>())
    {
        for vertex in [a, b] {
            peer_error = peer_error.max(away(dvec2(vertex.x, vertex.y)));
        }
    }
    Ok(json!({
        "work": "trimmed, class 9", "curve": name, "tolerance": tolerance, "ns": ns,
        "pieces": chains.iter().map(|chain| chain.pieces().len()).sum::<usize>(), "error": error / SIZE,
        "peer": "cavalier_contours, arcs", "peer_ns": peer_ns,
        "peer_pieces": outlines.iter().map(|outline| outline.iter_segments().count()).sum::<usize>(),
        "peer_error": peer_error / SIZE, "ratio": ns / peer_ns,
    }))
}

fn degenerate_row(timer: &Timer, name: &str, curve: &CubicPath) -> Result<Value> {
    let absolute = 1e-6 * SIZE;
    let how = Approximation::fewest(absolute);
    let ours = || -> Result<ArcSpline, ph_curves::Error> {
        approximate(black_box(curve), &how)?.spline.offset(DISTANCE)
    };
    let offset = ours()?;
    let peer = cubics(curve);
    let paths = kurbo_offset(&peer, absolute);
    let points: Vec<DVec2> = exact_offset(curve)
        .into_iter()
        .filter(|p| p.is_finite())
        .collect();
    let peer_error = path_error(&points, &paths);
    let (ns, peer_ns) = (
        timer.nanoseconds(ours),
        timer.nanoseconds(|| kurbo_offset(black_box(&peer), absolute)),
    );
    Ok(json!({
        "work": "convert and offset, class 9", "curve": name, "tolerance": 1e-6, "ns": ns,
        "pieces": offset.pieces().len(), "error": spline_error(&points, &[offset]),
        "peer": "kurbo offset_cubic", "peer_ns": peer_ns,
        "peer_pieces": paths.iter().map(|path| path.elements().len() - 1).sum::<usize>(),
        "peer_error": if peer_error.is_finite() { json!(peer_error) } else { Value::Null }, "ratio": ns / peer_ns,
    }))
}

fn length_rows(timer: &Timer) -> Result<Vec<Value>> {
    let quintic = Hermite {
        start: dvec2(0.0, 0.0),
        start_derivative: dvec2(0.6, 1.6),
        end: dvec2(1.0, 0.1),
        end_derivative: dvec2(0.6, -1.4),
    }
    .least_bending()?;
    let length = quintic.arc_length();
    let cubic = CubicBez::new((0.0, 0.0), (0.2, 0.7), (0.8, 0.7), (1.0, 0.0));
    let peer_length = cubic.arclen(1e-15);
    let row = |work: &str, ns: f64, error: f64, peer: &str, peer_ns: f64, peer_error: f64| {
        json!({
            "work": work, "curve": "a", "tolerance": 1e-12, "ns": ns, "pieces": 1, "error": error,
            "peer": peer, "peer_ns": peer_ns, "peer_pieces": 1, "peer_error": peer_error, "ratio": ns / peer_ns,
        })
    };
    let mut t = 0.3;
    let mut next = move || {
        t = if t > 0.9 { 0.1 } else { t + 0.0137 };
        t
    };
    let exact = |t: f64| -> f64 {
        // Length as the integral of the speed, by many steps of Gauss's two-point rule.
        let steps = 20_000;
        let h = t / f64::from(steps);
        (0..steps)
            .map(|k| {
                let middle = h * (f64::from(k) + 0.5);
                let off = h * 0.5 / 3.0_f64.sqrt();
                0.5 * h
                    * (quintic.velocity(middle - off).length()
                        + quintic.velocity(middle + off).length())
            })
            .sum()
    };
    let total = length.total();
    let up_to = timer.nanoseconds(|| length.up_to(black_box(next())));
    let mut s = 0.3;
    let mut next_cubic = move || {
        s = if s > 0.9 { 0.1 } else { s + 0.0137 };
        s
    };
    let arclen = timer.nanoseconds(|| cubic.subsegment(0.0..black_box(next_cubic())).arclen(1e-12));
    let inverse = timer.nanoseconds(|| length.parameter_at(black_box(next()) * total));
    let inv_arclen =
        timer.nanoseconds(|| cubic.inv_arclen(black_box(next_cubic()) * peer_length, 1e-12));
    let back = length.up_to(length.parameter_at(0.37 * total)?) - 0.37 * total;
    let peer_back = cubic
        .subsegment(0.0..cubic.inv_arclen(0.37 * peer_length, 1e-12))
        .arclen(1e-15)
        - 0.37 * peer_length;
    Ok(vec![
        row(
            "arc length",
            up_to,
            (length.up_to(0.6) - exact(0.6)).abs(),
            "kurbo arclen",
            arclen,
            1e-16,
        ),
        row(
            "inverse arc length",
            inverse,
            back.abs(),
            "kurbo inv_arclen",
            inv_arclen,
            peer_back.abs(),
        ),
    ])
}

/// Steps of the real-time interpolator along a C2 PH spline at constant feed.
fn interpolator_row(timer: &Timer) -> Result<Value> {
    let points = [
        dvec2(0.0, 0.0),
        dvec2(30.0, 20.0),
        dvec2(60.0, 10.0),
        dvec2(90.0, 40.0),
        dvec2(60.0, 70.0),
    ];
    let path = PhSpline::interpolate(
        &points,
        SplineEnds::Clamped {
            start_derivative: dvec2(30.0, 10.0),
            end_derivative: dvec2(-30.0, 20.0),
        },
    )?;
    let feed = FeedRate::Constant(25.0);
    let period = 1e-3;
    let mut steps = 0_usize;
    let mut worst = 0.0_f64;
    let ns = timer.nanoseconds(|| -> Result<(), ph_curves::Error> {
        let interpolator = FeedInterpolator::try_new(black_box(&path), feed, period)?;
        let mut count = 0;
        for point in interpolator {
            worst = worst.max(point.length_error.abs());
            count += 1;
        }
        steps = count;
        Ok(())
    });
    Ok(json!({
        "work": "interpolator step", "curve": "C2 PH spline", "tolerance": Value::Null, "ns": ns / steps.max(1) as f64,
        "pieces": steps, "error": worst, "steps_per_second": 1e9 * steps as f64 / ns,
    }))
}
