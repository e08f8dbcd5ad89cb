//! Outlines of lines and cubic Bézier curves, in world units or in page points.

use std::f64::consts::TAU;

use glam::DVec2;

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verb {
    Move(DVec2),
    Line(DVec2),
    Cubic(DVec2, DVec2, DVec2),
    Close,
}

/// Sub-paths of lines and cubic Bézier curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    pub(super) verbs: Vec<Verb>,
}

impl Path {
    /// The empty path.
    #[must_use]
    pub const fn new() -> Self {
        Self { verbs: Vec::new() }
    }

    /// Starts a sub-path.
    pub fn move_to(&mut self, point: DVec2) {
        self.verbs.push(Verb::Move(point));
    }

    /// A straight line to `point`.
    pub fn line_to(&mut self, point: DVec2) {
        self.verbs.push(Verb::Line(point));
    }

    /// A quadratic Bézier curve to `end`.
    pub fn quadratic_to(&mut self, control: DVec2, end: DVec2) {
        let start = self.last().unwrap_or(control);
        let third = |p: DVec2| p + (control - p) * (2.0 / 3.0);
        self.cubic_to(third(start), third(end), end);
    }

    /// A cubic Bézier curve to `end`.
    pub fn cubic_to(&mut self, first: DVec2, second: DVec2, end: DVec2) {
        self.verbs.push(Verb::Cubic(first, second, end));
    }

    /// Closes the sub-path with a straight line.
    pub fn close(&mut self) {
        self.verbs.push(Verb::Close);
    }

    /// The polygon through `points`; a point that is not finite interrupts it.
    #[must_use]
    pub fn polyline(points: &[DVec2], closed: bool) -> Self {
        let mut path = Self::new();
        let mut drawing = false;
        for &point in points {
            if !point.is_finite() {
                drawing = false;
            } else if drawing {
                path.line_to(point);
            } else {
                path.move_to(point);
                drawing = true;
            }
        }
        if closed && drawing {
            path.close();
        }
        path
    }

    /// The arc from angle `start` to angle `end` (radians, either direction), by cubics of at most
    /// an eighth of a turn: off the circle by 4e-6 of the radius.
    #[must_use]
    pub fn arc(centre: DVec2, radius: f64, start: f64, end: f64) -> Self {
        let mut path = Self::new();
        let sweep = (end - start).clamp(-TAU, TAU);
        let pieces = (sweep.abs() / (TAU / 8.0)).ceil().max(1.0) as usize;
        let step = sweep / pieces as f64;
        let handle = 4.0 / 3.0 * (0.25 * step).tan() * radius;
        let at = |angle: f64| centre + DVec2::from_angle(angle) * radius;
        path.move_to(at(start));
        for piece in 0..pieces {
            let (a, b) = (
                start + piece as f64 * step,
                start + (piece + 1) as f64 * step,
            );
            let tangent = |angle: f64| DVec2::from_angle(angle).perp() * handle;
            path.cubic_to(at(a) + tangent(a), at(b) - tangent(b), at(b));
        }
        path
    }

    /// The whole circle.
    #[must_use]
    pub fn circle(centre: DVec2, radius: f64) -> Self {
        let mut path = Self::arc(centre, radius, 0.0, TAU);
        path.close();
        path
    }

    fn last(&self) -> Option<DVec2> {
        match self.verbs.last()? {
            Verb::Move(p) | Verb::Line(p) | Verb::Cubic(_, _, p) => Some(*p),
            Verb::Close => None,
        }
    }

    /// The path with every point mapped.
    pub(super) fn map(&self, mut f: impl FnMut(DVec2) -> DVec2) -> Self {
        let verbs = self.verbs.iter().map(|verb| match *verb {
            Verb::Move(p) => Verb::Move(f(p)),
            Verb::Line(p) => Verb::Line(f(p)),
            Verb::Cubic(a, b, c) => Verb::Cubic(f(a), f(b), f(c)),
            Verb::Close => Verb::Close,
        });
        Self {
            verbs: verbs.collect(),
        }
    }

    /// Every point on the path that a curve or line ends in, curves sampled between, not further
    /// apart than `spacing`.
    pub(super) fn samples(&self, spacing: f64) -> Vec<DVec2> {
        let mut out = Vec::new();
        let (mut at, mut start) = (DVec2::ZERO, DVec2::ZERO);
        for verb in &self.verbs {
            let (first, second, end) = match *verb {
                Verb::Move(p) => {
                    (at, start) = (p, p);
                    out.push(p);
                    continue;
                }
                Verb::Line(p) => (at.lerp(p, 1.0 / 3.0), at.lerp(p, 2.0 / 3.0), p),
                Verb::Close => (at.lerp(start, 1.0 / 3.0), at.lerp(start, 2.0 / 3.0), start),
                Verb::Cubic(a, b, c) => (a, b, c),
            };
            let length = at.distance(first) + first.distance(second) + second.distance(end);
            let steps = if spacing > 0.0 {
                (length / spacing).ceil().clamp(1.0, 512.0)
            } else {
                8.0
            };
            for step in 1..=steps as usize {
                let (t, s) = (step as f64 / steps, 1.0 - step as f64 / steps);
                out.push(
                    at * (s * s * s)
                        + first * (3.0 * s * s * t)
                        + second * (3.0 * s * t * t)
                        + end * (t * t * t),
                );
            }
            at = end;
        }
        out
    }

    /// The path with straight lines cut off where they leave the box between `low` and `high`.
    ///
    /// Rasterisers reckon in `f32`: a line to a point far outside the page would lose its direction.
    pub(super) fn cut_lines(&self, low: DVec2, high: DVec2) -> Self {
        let inside = |p: DVec2| p.cmpge(low).all() && p.cmple(high).all();
        if self.verbs.iter().all(|verb| match *verb {
            Verb::Move(p) | Verb::Line(p) => inside(p),
            Verb::Cubic(a, b, c) => inside(a) && inside(b) && inside(c),
            Verb::Close => true,
        }) {
            return self.clone();
        }
        let mut path = Self::new();
        let (mut previous, mut start) = (None, DVec2::ZERO);
        for verb in &self.verbs {
            if let Verb::Move(p) = *verb {
                (previous, start) = (Some(p), p);
                continue;
            }
            let piece = Self {
                verbs: vec![
                    Verb::Move(previous.unwrap_or(start)),
                    if *verb == Verb::Close {
                        Verb::Line(start)
                    } else {
                        *verb
                    },
                ],
            };
            for pair in piece.samples(0.0).windows(2) {
                let (Some(&a), Some(&b)) = (pair.first(), pair.last()) else {
                    continue;
                };
                if let Some((enter, leave)) = clip(a, b, low, high) {
                    if path.last() != Some(enter) {
                        path.move_to(enter);
                    }
                    path.line_to(leave);
                }
            }
            previous = piece.samples(0.0).last().copied();
        }
        path
    }
}

/// The part of the segment `ab` in a box (Liang and Barsky).
fn clip(a: DVec2, b: DVec2, low: DVec2, high: DVec2) -> Option<(DVec2, DVec2)> {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        let (from, direction) = (a[axis], b[axis] - a[axis]);
        if direction == 0.0 {
            if from < low[axis] || from > high[axis] {
                return None;
            }
        } else {
            let (s, t) = (
                (low[axis] - from) / direction,
                (high[axis] - from) / direction,
            );
            enter = enter.max(s.min(t));
            leave = leave.min(s.max(t));
        }
    }
    // The ends themselves where they are inside, so that joined segments stay joined.
    let at = |t: f64| {
        if t == 0.0 {
            a
        } else if t == 1.0 {
            b
        } else {
            a.lerp(b, t)
        }
    };
    (enter < leave).then(|| (at(enter), at(leave)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_round() {
        let circle = Path::circle(DVec2::new(3.0, 4.0), 2.0);
        for point in circle.samples(0.05) {
            assert!((point.distance(DVec2::new(3.0, 4.0)) - 2.0).abs() < 2.0 * 4.3e-6);
        }
    }

    #[test]
    fn a_point_that_is_not_finite_interrupts() {
        let points = [DVec2::ZERO, DVec2::X, DVec2::NAN, DVec2::Y, DVec2::ONE];
        let moves = Path::polyline(&points, false)
            .verbs
            .iter()
            .filter(|v| matches!(v, Verb::Move(_)))
            .count();
        assert_eq!(moves, 2);
    }

    #[test]
    fn lines_to_far_points_keep_their_direction() {
        let path = Path::polyline(&[DVec2::ZERO, DVec2::new(1e12, 2e12)], false);
        let cut = path.cut_lines(DVec2::splat(-10.0), DVec2::splat(10.0));
        let Verb::Line(end) = cut.verbs[1] else {
            panic!("a line is left")
        };
        assert!(end.distance(DVec2::new(5.0, 10.0)) < 1e-9);
    }
}
