//! Windows and the windows on one edge.

use glam::DVec2;

/// An interval of a half-edge through which rays from one source enter the half-edge's face.
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
    /// The half-edge.
    pub(crate) halfedge: u32,
    /// Whether it has been propagated.
    pub(crate) done: bool,
}

impl Window {
    /// The distance of the point `x` of the edge through this window.
    pub(crate) fn distance(&self, x: f64) -> f64 {
        self.base + (self.source - DVec2::new(x, 0.0)).length()
    }

    /// The smallest distance on the interval.
    pub(crate) fn least(&self) -> f64 {
        self.distance(self.source.x.clamp(self.start, self.end))
    }
}

/// The points in `(low, high)` at which two windows are equally far: at most two.
pub(crate) fn equal_points(a: &Window, b: &Window, low: f64, high: f64) -> [Option<f64>; 2] {
    // base_a + |x - s_a| = base_b + |x - s_b|, squared once: |x - s_b| = D with the difference linear in x.
    let base = a.base - b.base;
    let shift = a.source.x - b.source.x;
    let constant = b.source.length_squared() - a.source.length_squared() - base * base;
    // |s_b - x|² - |s_a - x|² = base² + 2 base |s_a - x|  =>  2 shift x + constant = 2 base |s_a - x|
    let (p, q) = (2.0 * shift, constant);
    let four = 4.0 * base * base;
    let (qa, qb, qc) = (
        p * p - four,
        p * q + four * a.source.x,
        q * q - four * a.source.length_squared(),
    );
    let mut roots = [None, None];
    let mut keep = |x: f64| {
        // The squared equation has roots with the wrong sign.
        let right = (p * x + q) * base >= 0.0;
        if right && x > low && x < high {
            if roots[0].is_none() {
                roots[0] = Some(x);
            } else {
                roots[1] = Some(x);
            }
        }
    };
    let discriminant = qb * qb - qa * qc;
    if discriminant >= 0.0 {
        let larger = -(qb + discriminant.sqrt().copysign(qb));
        if larger != 0.0 {
            keep(qc / larger);
        }
        if qa != 0.0 {
            keep(larger / qa);
        }
    }
    if let [Some(x), Some(y)] = roots
        && x > y
    {
        roots.swap(0, 1);
    }
    roots
}

/// Shorter intervals carry nothing: relative to the edge, a few roundings.
pub(crate) const SLIVER: f64 = 1e-14;
