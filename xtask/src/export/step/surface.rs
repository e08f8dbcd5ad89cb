//! Surfaces and boundary curves as STEP stores them: points, positive weights, knots.

use bezier_mass::{BSplineSurface, BezierPatch, Knots, MassPoint};
use glam::DVec3;

/// Points are the same if they differ by less than this part of the surface's size.
const SAME: f64 = 1e-10;

/// A control point and its weight.
pub(super) type Weighted = (DVec3, f64);

/// Distinct knots with their multiplicities.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct KnotVector {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    pub(super) multiplicities: Vec<usize>,
}

impl KnotVector {
    fn bezier(degree: usize) -> Self {
        Self {
            degree,
            knots: vec![0.0, 1.0],
            multiplicities: vec![degree + 1; 2],
        }
    }

    /// The knots of a spline whose first and last control points lie on it; `None` for another one.
    fn clamped(knots: &Knots) -> Option<Self> {
        let degree = knots.degree();
        let mut vector = Self {
            degree,
            knots: Vec::new(),
            multiplicities: Vec::new(),
        };
        for &knot in knots.as_slice() {
            if vector.knots.last() == Some(&knot) {
                *vector.multiplicities.last_mut()? += 1;
            } else {
                vector.knots.push(knot);
                vector.multiplicities.push(1);
            }
        }
        let ends = [vector.multiplicities.first(), vector.multiplicities.last()];
        let clamped = !knots.is_periodic() && ends.iter().all(|end| *end == Some(&(degree + 1)));
        clamped.then_some(vector)
    }
}

/// A rational tensor-product surface; row `i` of the control net runs along `v`.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub(super) knots: [KnotVector; 2],
    pub(super) rows: Vec<Vec<Weighted>>,
}

/// A rational curve.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) knots: KnotVector,
    pub(super) control: Vec<Weighted>,
}

/// Points and positive weights, if all weights have one sign and none (nearly) vanishes.
fn positive(control: &[MassPoint<DVec3>]) -> Option<Vec<Weighted>> {
    let sign = control.first()?.weight.signum();
    let largest = control.iter().map(|m| m.weight.abs()).fold(0.0, f64::max);
    let point = |m: &MassPoint<DVec3>| {
        let weight = m.weight * sign;
        // A tiny weight drives its point far away, where digits are lost.
        (weight > 1e-3 * largest).then(|| (m.weighted / m.weight, weight / largest))
    };
    control.iter().map(point).collect()
}

impl Surface {
    pub(super) fn from_patch(patch: &BezierPatch<DVec3>) -> Option<Self> {
        let [m, n] = patch.degrees();
        Self::from_control(
            [KnotVector::bezier(m), KnotVector::bezier(n)],
            patch.control(),
            n + 1,
        )
    }

    pub(super) fn from_spline(surface: &BSplineSurface<DVec3>) -> Option<Self> {
        let [u, v] = surface.knots();
        let knots = [KnotVector::clamped(u)?, KnotVector::clamped(v)?];
        Self::from_control(knots, surface.control(), v.control_count())
    }

    fn from_control(
        knots: [KnotVector; 2],
        control: &[MassPoint<DVec3>],
        row: usize,
    ) -> Option<Self> {
        let rows = positive(control)?
            .chunks(row)
            .map(<[Weighted]>::to_vec)
            .collect();
        Some(Self { knots, rows })
    }

    /// Diagonal of the box around the control points.
    pub(super) fn size(&self) -> f64 {
        let points = || self.rows.iter().flatten().map(|(point, _)| *point);
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        (high - low).length()
    }

    /// The boundary curves in the order in which they surround the surface, counter-clockwise seen from
    /// the side of its normal, each with whether it is followed forwards.
    pub(super) fn boundary(&self) -> [(Curve, bool); 4] {
        let [u, v] = &self.knots;
        let column = |pick: fn(&Vec<Weighted>) -> Option<&Weighted>| Curve {
            knots: u.clone(),
            control: self.rows.iter().filter_map(pick).copied().collect(),
        };
        let row = |row: Option<&Vec<Weighted>>| Curve {
            knots: v.clone(),
            control: row.cloned().unwrap_or_default(),
        };
        [
            (column(|row| row.first()), true),
            (row(self.rows.last()), true),
            (column(|row| row.last()), false),
            (row(self.rows.first()), false),
        ]
    }

    /// Whether the sides at the two ends of `u`, and those of `v`, coincide without being points.
    pub(super) fn closed(&self) -> [bool; 2] {
        let [bottom, right, top, left] = self.boundary().map(|(curve, _)| curve);
        let tolerance = SAME * self.size();
        let same =
            |a: &Curve, b: &Curve| !a.is_point(tolerance) && a.matches(b, tolerance) == Some(true);
        [same(&left, &right), same(&bottom, &top)]
    }
}

impl Curve {
    /// The tolerance below which two points of a model of this size are one.
    pub(super) fn tolerance(size: f64) -> f64 {
        SAME * size
    }

    /// The first and the last point.
    pub(super) fn ends(&self) -> [DVec3; 2] {
        let end = |end: Option<&Weighted>| end.map_or(DVec3::ZERO, |(point, _)| *point);
        [end(self.control.first()), end(self.control.last())]
    }

    /// Whether the whole curve is one point: the side of a patch at a pole.
    pub(super) fn is_point(&self, tolerance: f64) -> bool {
        let [start, _] = self.ends();
        self.control
            .iter()
            .all(|(point, _)| point.distance(start) <= tolerance)
    }

    /// Whether the two are one curve: `Some(true)` in the same direction, `Some(false)` in the other.
    ///
    /// Weights are compared after the reparametrisation that makes the end weights equal, since
    /// neighbouring patches may run along their common side at different paces.
    pub(super) fn matches(&self, other: &Self, tolerance: f64) -> Option<bool> {
        if self.control.len() != other.control.len() || self.knots.degree != other.knots.degree {
            return None;
        }
        let same = |ours: &[Weighted], theirs: &[Weighted]| {
            ours.iter().zip(theirs).all(|((p, w), (q, x))| {
                p.distance(*q) <= tolerance && (w - x).abs() <= 1e-9 * w.max(*x)
            })
        };
        let (ours, theirs) = (self.standard(), other.standard());
        let reversed: Vec<Weighted> = theirs.iter().rev().copied().collect();
        let forwards = self.knots.same_spacing(&other.knots, false) && same(&ours, &theirs);
        let backwards = self.knots.same_spacing(&other.knots, true) && same(&ours, &reversed);
        if forwards {
            Some(true)
        } else {
            backwards.then_some(false)
        }
    }

    /// The control points with weights scaled to end in one; of a Bézier curve at both ends.
    fn standard(&self) -> Vec<Weighted> {
        let weight = |end: Option<&Weighted>| end.map_or(1.0, |(_, weight)| *weight);
        let (first, last) = (weight(self.control.first()), weight(self.control.last()));
        let is_bezier = self.knots.knots.len() == 2;
        let pace = if is_bezier {
            (first / last).powf(1.0 / self.knots.degree.max(1) as f64)
        } else {
            1.0
        };
        let scaled = |(i, &(point, weight)): (usize, &Weighted)| {
            (point, weight / first * pace.powi(i as i32))
        };
        self.control.iter().enumerate().map(scaled).collect()
    }
}

impl KnotVector {
    /// Whether the knots divide their intervals alike, read in one or the other direction.
    fn same_spacing(&self, other: &Self, reversed: bool) -> bool {
        let unit = |vector: &Self| -> Vec<f64> {
            let (first, last) = (vector.knots[0], vector.knots[vector.knots.len() - 1]);
            vector
                .knots
                .iter()
                .map(|knot| (knot - first) / (last - first))
                .collect()
        };
        let (ours, mut theirs) = (unit(self), unit(other));
        let mut multiplicities = other.multiplicities.clone();
        if reversed {
            theirs = theirs.iter().rev().map(|knot| 1.0 - knot).collect();
            multiplicities.reverse();
        }
        self.multiplicities == multiplicities
            && ours.iter().zip(&theirs).all(|(a, b)| (a - b).abs() < 1e-12)
    }
}
