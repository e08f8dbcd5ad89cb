//! Fat lines (Sederberg and Nishita 1990): on which side of an arc points certainly lie.

use glam::DVec2;

use crate::arc::Arc;

/// Where points lie relative to a fat line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    Left,
    Right,
    Within,
}

/// The strip along the chord of an arc that holds its control points. Extended by its chord direction at both ends, the arc
/// divides the plane inside this strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FatLine {
    origin: DVec2,
    normal: DVec2,
    least: f64,
    most: f64,
}

impl FatLine {
    pub(crate) fn of(arc: &Arc, slack: f64) -> Self {
        let [from, to] = arc.ends();
        let chord = to - from;
        let normal = if chord == DVec2::ZERO {
            DVec2::X
        } else {
            chord.perp()
        };
        let (mut least, mut most) = (0.0_f64, 0.0_f64);
        for p in arc.points() {
            let height = (p - from).dot(normal);
            (least, most) = (least.min(height), most.max(height));
        }
        let slack = slack * normal.length();
        Self {
            origin: from,
            normal,
            least: least - slack,
            most: most + slack,
        }
    }

    pub(crate) fn side(&self, p: DVec2) -> Side {
        let height = (p - self.origin).dot(self.normal);
        if height > self.most {
            Side::Left
        } else if height < self.least {
            Side::Right
        } else {
            Side::Within
        }
    }

    /// The side on which all points lie, or `Within`.
    pub(crate) fn common_side(&self, mut points: impl Iterator<Item = DVec2>) -> Side {
        let first = points.next().map_or(Side::Within, |p| self.side(p));
        if points.all(|p| self.side(p) == first) {
            first
        } else {
            Side::Within
        }
    }
}
