//! Interfaces from data: graphs of functions, and conics fitted to samples.

use bezier_mass::BezierCurve;
use glam::DVec2;

use crate::{Error, Interface};

impl Interface {
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
