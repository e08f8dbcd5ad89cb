//! Windows, and what becomes of two that overlap.

use glam::DVec2;

/// An interval of a half-edge through which straight ways from one source enter the half-edge's face.
///
/// Coordinates are those of the half-edge: its origin at zero, its tip at `(length, 0)`, the face above. The unfolded source
/// lies below.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Ends of the interval along the half-edge.
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// The unfolded source.
    pub(crate) source: DVec2,
    /// Distance of the (pseudo-)source from the true source.
    pub(crate) base: f64,
    /// Vertex of the (pseudo-)source, or a number of a source that is no vertex, above all vertices.
    pub(crate) origin: u32,
    /// The window that came to the same half-edge before; [`NONE`](crate::NONE) for the first.
    pub(crate) older: u32,
}

impl Window {
    /// The distance of the point `x` of the edge through this window.
    #[inline]
    pub(crate) fn distance(&self, x: f64) -> f64 {
        self.base + (self.source - DVec2::new(x, 0.0)).length()
    }

    /// The smallest distance on the interval.
    #[inline]
    pub(crate) fn least(&self) -> f64 {
        self.distance(self.source.x.clamp(self.start, self.end))
    }

    /// The window in a mirror that exchanges the ends of the edge.
    #[inline]
    pub(crate) fn mirrored(&self, length: f64) -> Self {
        Self {
            start: length - self.end,
            end: length - self.start,
            source: DVec2::new(length - self.source.x, self.source.y),
            ..*self
        }
    }

    /// Whether anything is left of it.
    #[inline]
    fn spans(&self) -> bool {
        self.start < self.end
    }
}

/// Sorts windows of one half-edge and cuts each back to where its neighbours in the order are not nearer.
///
/// Only what is dominated goes, and never both of two equals. Not all that is dominated goes: a window is not cut in two, and
/// windows that are not neighbours are not compared. What stays too long is found out further on.
pub(crate) fn trim(windows: &mut Vec<Window>) {
    windows.sort_unstable_by(|a, b| a.start.total_cmp(&b.start));
    let mut kept = 0;
    for i in 0..windows.len() {
        let mut window = windows[i];
        while kept > 0 && window.spans() {
            contend(&mut windows[kept - 1], &mut window);
            if windows[kept - 1].spans() {
                break;
            }
            kept -= 1;
        }
        if window.spans() {
            windows[kept] = window;
            kept += 1;
        }
    }
    windows.truncate(kept);
}

/// Of the overlap of two windows, the first of which starts first, each keeps the part on which it is nearer, if what it
/// keeps is one interval.
fn contend(a: &mut Window, b: &mut Window) {
    let (low, high) = (b.start, a.end.min(b.end));
    if low >= high {
        return;
    }
    let first_wins_low = a.distance(low) <= b.distance(low);
    let first_wins_high = a.distance(high) <= b.distance(high);
    match (first_wins_low, first_wins_high) {
        (true, true) => {
            if wins_between(a, b, low, high) {
                b.start = high;
            }
        }
        (false, false) => {
            if wins_between(b, a, low, high) {
                if high == a.end {
                    a.end = low;
                } else if low == a.start {
                    a.start = high;
                }
            }
        }
        (true, false) => {
            if let Some(x) = equal_point(a, b, low, high) {
                if high == a.end {
                    a.end = x;
                }
                b.start = x;
            }
        }
        (false, true) => {
            if let Some(x) = equal_point(a, b, low, high) {
                if low == a.start {
                    a.start = x;
                }
                if high == b.end {
                    b.end = x;
                }
            }
        }
    }
}

/// Whether a window that is nearer at both ends of an interval is nearer all along it.
///
/// The points nearer to a source that starts later (with the larger base) are a convex region, the inside of a branch of a
/// hyperbola.
fn wins_between(winner: &Window, loser: &Window, low: f64, high: f64) -> bool {
    winner.base >= loser.base || equal_point(winner, loser, low, high).is_none()
}

/// A point in `(low, high)` at which two windows are equally far.
fn equal_point(a: &Window, b: &Window, low: f64, high: f64) -> Option<f64> {
    // base_a + |x - s_a| = base_b + |x - s_b|, squared once: |x - s_b| = D with the difference linear in x.
    let base = a.base - b.base;
    let shift = a.source.x - b.source.x;
    let constant = b.source.length_squared() - a.source.length_squared() - base * base;
    // |s_b - x|² - |s_a - x|² = base² + 2 base |s_a - x|  =>  2 shift x + constant = 2 base |s_a - x|
    let (p, q) = (2.0 * shift, constant);
    let inside = |x: f64| (x > low && x < high).then_some(x);
    if base == 0.0 {
        return inside(-q / p);
    }
    let four = 4.0 * base * base;
    let (qa, qb, qc) = (
        p * p - four,
        p * q + four * a.source.x,
        q * q - four * a.source.length_squared(),
    );
    // The squared equation has roots with the wrong sign.
    let right = |x: f64| inside(x).filter(|x| (p * x + q) * base >= 0.0);
    let discriminant = qb * qb - qa * qc;
    if discriminant < 0.0 {
        return None;
    }
    let larger = -(qb + discriminant.sqrt().copysign(qb));
    right(qc / larger).or_else(|| right(larger / qa))
}
