//! Subarcs of rational Bézier curves, and the directions that their tangents take.
//!
//! The tangents of an arc with positive weights lie in the cone of the edges of its control polygon (Sederberg and Meyers 1988).

use glam::{DVec2, DVec3};

use crate::curve::Curve;

/// Cones closer than this angle are not called disjoint; angles are computed to a few `f64::EPSILON`.
const CONE_MARGIN: f64 = 1e-12;

/// A subarc with its own control points, homogeneous.
#[derive(Clone, Debug)]
pub(crate) struct Arc {
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    pub(crate) net: Vec<DVec3>,
}

/// A range of directions: angles `from..=to` about a base angle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    base: f64,
    from: f64,
    to: f64,
}

impl Cone {
    /// Whether no direction of one is a direction, or the opposite of a direction, of the other.
    pub(crate) fn is_apart_from(self, other: Self) -> bool {
        use std::f64::consts::PI;
        let turn = (other.base - self.base).rem_euclid(PI);
        [turn - PI, turn, turn + PI].iter().all(|turn| {
            turn + other.from > self.to + CONE_MARGIN || turn + other.to < self.from - CONE_MARGIN
        })
    }
}

impl Arc {
    pub(crate) fn whole(curve: Curve<'_>) -> Self {
        Self {
            lo: 0.0,
            hi: 1.0,
            net: curve
                .weighted_points()
                .map(|(p, w)| (p * w).extend(w))
                .collect(),
        }
    }

    pub(crate) fn width(&self) -> f64 {
        self.hi - self.lo
    }

    pub(crate) fn points(&self) -> impl DoubleEndedIterator<Item = DVec2> + Clone {
        self.net.iter().map(|p| p.truncate() / p.z)
    }

    pub(crate) fn edges(&self) -> impl Iterator<Item = DVec2> + Clone {
        self.points().zip(self.points().skip(1)).map(|(p, q)| q - p)
    }

    pub(crate) fn ends(&self) -> [DVec2; 2] {
        let point = |p: Option<&DVec3>| p.map_or(DVec2::NAN, |p| p.truncate() / p.z);
        [point(self.net.first()), point(self.net.last())]
    }

    /// The cone of the edges, if it is narrower than a half plane.
    pub(crate) fn cone(&self) -> Option<Cone> {
        Self::cone_of(self.edges())
    }

    pub(crate) fn cone_of(edges: impl Iterator<Item = DVec2> + Clone) -> Option<Cone> {
        let axis: DVec2 = edges.clone().sum();
        if axis == DVec2::ZERO {
            return None;
        }
        let (mut from, mut to) = (0.0_f64, 0.0_f64);
        for edge in edges.filter(|edge| *edge != DVec2::ZERO) {
            if axis.dot(edge) <= 0.0 {
                return None;
            }
            let angle = axis.angle_to(edge);
            (from, to) = (from.min(angle), to.max(angle));
        }
        Some(Cone {
            base: axis.to_angle(),
            from,
            to,
        })
    }

    /// The parts before and after the share `z`.
    pub(crate) fn cut(&self, z: f64) -> (Self, Self) {
        let mut row = self.net.clone();
        let mut left = Vec::with_capacity(row.len());
        let degree = row.len() - 1;
        left.push(row[0]);
        for j in 1..=degree {
            for i in 0..=degree - j {
                row[i] = row[i] * (1.0 - z) + row[i + 1] * z;
            }
            left.push(row[0]);
        }
        let middle = self.lo + self.width() * z;
        (
            Self {
                lo: self.lo,
                hi: middle,
                net: left,
            },
            Self {
                lo: middle,
                hi: self.hi,
                net: row,
            },
        )
    }

    pub(crate) fn halves(&self) -> (Self, Self) {
        self.cut(0.5)
    }

    /// The part between two parameters.
    pub(crate) fn between(&self, lo: f64, hi: f64) -> Self {
        let (left, _) = self.cut(((hi - self.lo) / self.width()).min(1.0));
        let (_, part) = left.cut(((lo - self.lo) / (hi - self.lo)).max(0.0));
        Self { lo, hi, ..part }
    }

    /// Point and derivative at a share of the arc.
    pub(crate) fn local(&self, z: f64) -> (DVec2, DVec2) {
        let mut row = self.net.clone();
        let degree = row.len() - 1;
        while row.len() > 2 {
            for i in 0..row.len() - 1 {
                row[i] = row[i] * (1.0 - z) + row[i + 1] * z;
            }
            row.pop();
        }
        let (p, q) = (row[0], row[row.len() - 1]);
        let at = p * (1.0 - z) + q * z;
        let slope = (q - p) * degree as f64;
        let point = at.truncate() / at.z;
        (point, (slope.truncate() - point * slope.z) / at.z)
    }
}
