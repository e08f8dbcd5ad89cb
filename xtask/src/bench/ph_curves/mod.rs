//! Offsets against kurbo and cavalier_contours on four curves and on degenerate ones, arc length against kurbo,
//! interpolator steps.
//!
//! Curves have size 100, the distance is 5, tolerances and errors are relative to the size. Errors of both sides are
//! measured the same way: the greatest distance between the exact offset and the result, from dense points of each to
//! the other.

mod inputs;
mod measure;
mod peers;

use std::hint::black_box;

use anyhow::Result;
use glam::{DVec2, dvec2};
use kurbo::{CubicBez, ParamCurve as _, ParamCurveArclen as _};
use ph_curves::{
    Approximation, ArcSpline, CubicPath, FeedInterpolator, FeedRate, Hermite, PhSpline, SplineEnds,
    approximate,
};
use serde_json::{Value, json};

use self::inputs::{DEGENERATE, DISTANCE, Degenerate, SIZE, curves};
use self::measure::{exact, exact_offset, of_segments, of_splines};
use super::{Bench, Timer};

#[derive(clap::Args, Debug)]
pub(super) struct PhCurves {}

/// The tolerances of the offsets, relative to the size.
const TOLERANCES: [f64; 2] = [1e-6, 1e-9];
/// Points per span of the exact offset at which errors are measured, and per piece of a result.
const SAMPLES: [usize; 2] = [23, 5];
/// The sizes at which degenerate input is tried.
const SIZES: [f64; 3] = [SIZE, 1e-7, 1e9];

impl Bench for PhCurves {
    const NAME: &'static str = "ph-curves";
    const ABOUT: &'static str =
        "Offsets, arc length and interpolation, against kurbo and cavalier_contours";

    fn run(&self, timer: &Timer) -> Result<Value> {
        let mut rows = Vec::new();
        for (name, curve) in curves()? {
            for tolerance in TOLERANCES {
                let case = Case {
                    timer,
                    name,
                    curve: &curve,
                    tolerance,
                };
                case.offsets(&mut rows)?;
                rows.push(
                    case.trimmed("trimmed, class 9", &Approximation::within(tolerance * SIZE))?,
                );
                rows.push(case.trimmed(
                    "trimmed, class 14",
                    &Approximation::fewest(tolerance * SIZE),
                )?);
            }
        }
        for input in &DEGENERATE {
            for size in SIZES {
                rows.push(degenerate_row(timer, input, size));
            }
        }
        rows.extend(length_rows(timer)?);
        rows.push(interpolator_row(timer)?);
        Ok(json!({ "rows": rows }))
    }
}

/// What one side of a comparison came to.
struct Outcome {
    ns: f64,
    pieces: usize,
    error: f64,
}

fn row(
    work: &str,
    curve: &str,
    tolerance: f64,
    ours: &Outcome,
    peer: &str,
    theirs: &Outcome,
) -> Value {
    json!({
        "work": work, "curve": curve, "tolerance": tolerance,
        "ns": ours.ns, "pieces": ours.pieces, "error": ours.error,
        "peer": peer, "peer_ns": theirs.ns, "peer_pieces": theirs.pieces, "peer_error": theirs.error,
        "ratio": ours.ns / theirs.ns, "pieces_ratio": ours.pieces as f64 / theirs.pieces as f64,
    })
}

/// One curve at one tolerance.
struct Case<'a> {
    timer: &'a Timer,
    name: &'static str,
    curve: &'a CubicPath,
    tolerance: f64,
}

impl Case<'_> {
    /// First and further offsets, by both classes of arcs, against kurbo's two ways.
    fn offsets(&self, rows: &mut Vec<Value>) -> Result<()> {
        let Self {
            timer,
            name,
            curve,
            tolerance,
        } = *self;
        let absolute = tolerance * SIZE;
        let truth = exact_offset(curve, DISTANCE);
        let cubics = peers::cubics(curve);
        let cubic_offset = || peers::offset_cubics(black_box(&cubics), DISTANCE, absolute);
        let segments = peers::segments(&cubic_offset());
        let cubic = |ns: f64| Outcome {
            ns,
            pieces: segments.len(),
            error: truth.apart(&of_segments(segments.iter().copied()), SAMPLES) / SIZE,
        };
        for (class, how) in [
            ("class 9", Approximation::within(absolute)),
            ("class 14", Approximation::fewest(absolute)),
            ("class 3", Approximation::quartics(absolute)),
        ] {
            let convert = || -> Result<ArcSpline, ph_curves::Error> {
                approximate(black_box(curve), &how)?.spline.offset(DISTANCE)
            };
            let offset = [convert()?];
            let outcome = |ns: f64, error: f64| Outcome {
                ns,
                pieces: offset[0].pieces().len(),
                error,
            };
            let error = truth.apart(&of_splines(&offset), SAMPLES) / SIZE;
            let (ns, peer_ns, _) = timer.against(convert, cubic_offset);
            rows.push(row(
                &format!("convert and offset, {class}"),
                name,
                tolerance,
                &outcome(ns, error),
                "kurbo offset_cubic",
                &cubic(peer_ns),
            ));
            let spline = approximate(curve, &how)?.spline;
            let error = own_error(&spline, &offset[0]);
            let further = || black_box(&spline).offset(DISTANCE);
            let (ns, peer_ns, _) = timer.against(further, cubic_offset);
            rows.push(row(
                &format!("further offset, {class}"),
                name,
                tolerance,
                &outcome(ns, error),
                "kurbo offset_cubic",
                &cubic(peer_ns),
            ));
        }
        rows.push(self.fitted(rows.len() - 6, rows));
        Ok(())
    }

    /// The offset by class 9 (the row `ours`, measured just now) against kurbo's optimal fit, which takes too long to be
    /// repeated.
    fn fitted(&self, ours: usize, rows: &[Value]) -> Value {
        let source = peers::Offset {
            curve: self.curve,
            distance: DISTANCE,
        };
        let fit = || kurbo::fit_to_bezpath_opt(black_box(&source), self.tolerance * SIZE);
        let path = fit();
        let truth = exact_offset(self.curve, DISTANCE);
        let theirs = Outcome {
            ns: Timer::new(std::time::Duration::from_millis(1)).nanoseconds(fit),
            pieces: path.segments().count(),
            error: truth.apart(&of_segments(path.segments()), SAMPLES) / SIZE,
        };
        let number = |key: &str| rows[ours][key].as_f64().unwrap_or(f64::NAN);
        let ours = Outcome {
            ns: number("ns"),
            pieces: number("pieces") as usize,
            error: number("error"),
        };
        row(
            "convert and offset, class 9",
            self.name,
            self.tolerance,
            &ours,
            "kurbo fit_to_bezpath_opt",
            &theirs,
        )
    }

    /// The offset without loops against cavalier's, which gets arcs; the conversions are included.
    fn trimmed(&self, work: &str, how: &Approximation) -> Result<Value> {
        let absolute = self.tolerance * SIZE;
        // Counter-clockwise loops are offset inwards.
        let distance = if ph_curves::PlaneCurve::is_closed(self.curve) {
            -DISTANCE
        } else {
            DISTANCE
        };
        let ours = || -> Result<Vec<ArcSpline>, ph_curves::Error> {
            approximate(black_box(self.curve), how)?
                .spline
                .trimmed_offset(distance)
        };
        let theirs =
            || peers::parallel_offset(&peers::arcs(black_box(self.curve), absolute), distance);
        let (chains, outlines) = (ours()?, theirs());
        // Error: how far points of a result are from being at the distance.
        let original = exact(self.curve);
        let error = |points: &mut dyn Iterator<Item = DVec2>| {
            points
                .map(|p| (original.distance(p) - DISTANCE).abs())
                .fold(0.0, f64::max)
                / SIZE
        };
        let (ns, peer_ns, _) = self.timer.against(ours, theirs);
        Ok(row(
            work,
            self.name,
            self.tolerance,
            &Outcome {
                ns,
                pieces: chains.iter().map(|chain| chain.pieces().len()).sum(),
                error: error(&mut of_splines(&chains).points(SAMPLES[1])),
            },
            "cavalier_contours, arcs",
            &Outcome {
                ns: peer_ns,
                pieces: peers::segment_count(&outlines),
                error: error(&mut peers::points(&outlines).into_iter()),
            },
        ))
    }
}

/// Error of the offset against the spline's own normals.
fn own_error(spline: &ArcSpline, offset: &ArcSpline) -> f64 {
    let mut worst = 0.0_f64;
    for (piece, moved) in spline.pieces().iter().zip(offset.pieces()) {
        for k in 0..=10 {
            let t = f64::from(k) / 10.0;
            let exact = piece.point(t) + piece.normal(t) * DISTANCE;
            worst = worst.max((moved.point(t) - exact).length());
        }
    }
    worst / SIZE
}

/// A degenerate cubic at one size: an answer or the name of the reason why there is none.
fn degenerate_row(timer: &Timer, input: &Degenerate, size: f64) -> Value {
    let tolerance = 1e-6;
    let scale = size / SIZE;
    let distance = input.distance * scale;
    let how = Approximation::within(tolerance * size);
    let control = input.control(scale);
    let ours = || -> Result<ArcSpline, ph_curves::Error> {
        let curve = CubicPath::new(vec![black_box(control)], false)?;
        approximate(&curve, &how)?.spline.offset(distance)
    };
    let [a, b, c, d] = control.map(|p| kurbo::Point::new(p.x, p.y));
    let peer = [CubicBez::new(a, b, c, d)];
    let theirs = || peers::offset_cubics(black_box(&peer), distance, tolerance * size);
    let segments = peers::segments(&theirs());
    let (ns, peer_ns, ratio) = timer.against(ours, theirs);
    // Corners get round joins, and single points of infinite curvature have no derivative: one way, at regular points.
    let curve = CubicPath::new(vec![control], false).ok();
    let error = |result: &measure::Outline<'_>| {
        let truth = exact_offset(curve.as_ref()?, distance);
        let error = truth.farthest_from(result, SAMPLES[0]) / size;
        error.is_finite().then_some(error)
    };
    let finite = segments.iter().all(|segment| segment.is_finite());
    let mut row = json!({
        "work": "degenerate, class 9", "curve": input.name, "size": size, "tolerance": tolerance, "ns": ns,
        "peer": "kurbo offset_cubic", "peer_ns": peer_ns, "peer_pieces": segments.len(),
        "peer_error": if finite { json!(error(&of_segments(segments.iter().copied()))) } else { json!("NaN in the result") },
        "ratio": ratio,
    });
    match ours() {
        Ok(offset) => {
            row["pieces"] = json!(offset.pieces().len());
            row["error"] = json!(error(&of_splines(&[offset])));
        }
        Err(reason) => row["refused"] = json!(reason.to_string()),
    }
    row
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
    let outcome = |ns: f64, error: f64| Outcome {
        ns,
        pieces: 1,
        error,
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
    let mut s = 0.3;
    let mut next_cubic = move || {
        s = if s > 0.9 { 0.1 } else { s + 0.0137 };
        s
    };
    let (up_to, arclen, _) = timer.against(
        || length.up_to(black_box(next())),
        || cubic.subsegment(0.0..black_box(next_cubic())).arclen(1e-12),
    );
    let (inverse, inv_arclen, _) = timer.against(
        || length.parameter_at(black_box(next()) * total),
        || cubic.inv_arclen(black_box(next_cubic()) * peer_length, 1e-12),
    );
    let back = length.up_to(length.parameter_at(0.37 * total)?) - 0.37 * total;
    let peer_back = cubic
        .subsegment(0.0..cubic.inv_arclen(0.37 * peer_length, 1e-12))
        .arclen(1e-15)
        - 0.37 * peer_length;
    Ok(vec![
        row(
            "arc length",
            "a",
            1e-12,
            &outcome(up_to, (length.up_to(0.6) - exact(0.6)).abs()),
            "kurbo arclen",
            &outcome(arclen, (cubic.arclen(1e-12) - peer_length).abs()),
        ),
        row(
            "inverse arc length",
            "a",
            1e-12,
            &outcome(inverse, back.abs()),
            "kurbo inv_arclen",
            &outcome(inv_arclen, peer_back.abs()),
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
