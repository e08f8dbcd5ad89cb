//! Distances between curves, measured densely and the same way for everybody.

use glam::DVec2;
use kurbo::{ParamCurve as _, ParamCurveDeriv as _, PathSeg};
use ph_curves::{ArcSpline, CubicPath, Piece, PlaneCurve as _};

/// A smooth piece of a curve over [0, 1]: its point and derivative.
pub(super) type Traced<'a> = Box<dyn Fn(f64) -> (DVec2, DVec2) + 'a>;

/// Steps per piece from whose ends the nearest point is looked for.
const SEEDS: usize = 16;
/// Steps of the golden section, down to 1e-6 of a piece ...
const SECTIONS: usize = 22;
/// ... and of Gauss and Newton, to rounding.
const STEPS: usize = 4;

/// A curve prepared for finding nearest points.
pub(super) struct Outline<'a> {
    pieces: Vec<Traced<'a>>,
    /// Points at equal steps on every piece, and the longest of these steps.
    seeds: Vec<([DVec2; SEEDS + 1], f64)>,
}

impl<'a> Outline<'a> {
    pub(super) fn new(pieces: Vec<Traced<'a>>) -> Self {
        let seeds = pieces
            .iter()
            .map(|piece| {
                let points: [DVec2; SEEDS + 1] =
                    std::array::from_fn(|k| piece(k as f64 / SEEDS as f64).0);
                let steps = points.windows(2).map(|pair| (pair[1] - pair[0]).length());
                (points, steps.fold(0.0, f64::max))
            })
            .collect();
        Self { pieces, seeds }
    }

    /// Distance of a point: from the best seed of every piece that can be the nearest.
    pub(super) fn distance(&self, point: DVec2) -> f64 {
        let best: Vec<(usize, f64)> = self
            .seeds
            .iter()
            .map(|(points, _)| {
                let away = points.iter().map(|p| (*p - point).length());
                away.enumerate()
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .unwrap_or((0, f64::INFINITY))
            })
            .collect();
        let mut least = best
            .iter()
            .map(|(_, away)| *away)
            .fold(f64::INFINITY, f64::min);
        for ((piece, (_, step)), (seed, away)) in self.pieces.iter().zip(&self.seeds).zip(best) {
            if away - step <= least {
                least = least.min(refined(piece, seed, point));
            }
        }
        least
    }

    /// Points at equal steps on every piece.
    pub(super) fn points(&self, per_piece: usize) -> impl Iterator<Item = DVec2> + '_ {
        self.pieces.iter().flat_map(move |piece| {
            (0..=per_piece).map(move |k| piece(k as f64 / per_piece as f64).0)
        })
    }

    /// Largest distance from finite points of this curve to the other; infinite if there is no other.
    pub(super) fn farthest_from(&self, other: &Self, per_piece: usize) -> f64 {
        self.points(per_piece)
            .filter(|point| point.is_finite())
            .map(|point| other.distance(point))
            .fold(0.0, f64::max)
    }

    /// The greater of the distances both ways.
    pub(super) fn apart(&self, other: &Self, samples: [usize; 2]) -> f64 {
        let there = self.farthest_from(other, samples[0]);
        there.max(other.farthest_from(self, samples[1]))
    }
}

/// Distance to a piece near one of its seeds.
fn refined(piece: &Traced<'_>, seed: usize, point: DVec2) -> f64 {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    let away = |t: f64| (piece(t).0 - point).length();
    let at = |k: usize| k as f64 / SEEDS as f64;
    let (mut low, mut high) = (at(seed.saturating_sub(1)), at((seed + 1).min(SEEDS)));
    for _ in 0..SECTIONS {
        let (a, b) = (low + GOLDEN * (high - low), high - GOLDEN * (high - low));
        if away(a) < away(b) {
            high = b;
        } else {
            low = a;
        }
    }
    let mut t = 0.5 * (low + high);
    let mut least = away(t).min(away(at(seed)));
    for _ in 0..STEPS {
        let (foot, velocity) = piece(t);
        let step = (point - foot).dot(velocity) / velocity.length_squared();
        if !step.is_finite() {
            break;
        }
        t = (t + step).clamp(0.0, 1.0);
        least = least.min(away(t));
    }
    least
}

/// The exact curve.
pub(super) fn exact(curve: &CubicPath) -> Outline<'_> {
    exact_offset(curve, 0.0)
}

/// The exact offset to the right of travel, from the curve itself.
pub(super) fn exact_offset(curve: &CubicPath, distance: f64) -> Outline<'_> {
    let span = |span: usize| -> Traced<'_> {
        Box::new(move |t| {
            let [point, first, second] = curve.jet(span, t);
            let speed = first.length();
            let curvature = first.perp_dot(second) / (speed * speed * speed);
            if distance == 0.0 {
                return (point, first);
            }
            (
                point - first.perp() * (distance / speed),
                first * (1.0 + distance * curvature),
            )
        })
    };
    Outline::new((0..curve.spans()).map(span).collect())
}

/// Our splines.
pub(super) fn of_splines(splines: &[ArcSpline]) -> Outline<'_> {
    let trace = |piece: &'_ Piece| -> Traced<'static> {
        let piece = *piece;
        Box::new(move |t| (piece.point(t), piece.velocity(t)))
    };
    Outline::new(
        splines
            .iter()
            .flat_map(ArcSpline::pieces)
            .map(trace)
            .collect(),
    )
}

/// Segments of kurbo.
pub(super) fn of_segments(segments: impl Iterator<Item = PathSeg>) -> Outline<'static> {
    let trace = |segment: PathSeg| -> Traced<'static> {
        let cubic = segment.to_cubic();
        let velocity = cubic.deriv();
        Box::new(move |t| {
            let (p, v) = (cubic.eval(t), velocity.eval(t));
            (DVec2::new(p.x, p.y), DVec2::new(v.x, v.y))
        })
    };
    Outline::new(segments.map(trace).collect())
}
