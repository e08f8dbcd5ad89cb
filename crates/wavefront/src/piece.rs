//! A Bézier curve of a chain, and boxes around such curves.

use bezier_mass::BezierCurve;
use glam::DVec2;

use crate::Impact;
use crate::beam::{Part, Wedge};

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) curve: BezierCurve<DVec2>,
    /// The coefficients of the powers of the parameter of a polynomial piece and their number, for quick values; none for a
    /// rational one.
    powers: ([DVec2; MOST_POWERS], usize),
    /// The angle of the tangents, to a spread, where they turn by less than a right angle.
    pub(crate) tangents: Option<(f64, f64)>,
}

/// A box around pieces; infinite if a weight is not positive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
}

/// A piece of a higher degree is not put in powers, where digits would be lost.
pub(crate) const MOST_POWERS: usize = 8;
/// A small part of a chain: this share of the model's size, with tangents that turn by so much (radians) to either side.
pub(crate) const SMALL_PART: f64 = 0.03;
const SMALL_TURN: f64 = 0.05;
/// A piece is halved so often for that.
const MOST_SPLITS: u32 = 6;
/// Boxes are widened by this share of their size, against rounding.
const MARGIN: f64 = 1e-12;

impl Piece {
    pub(crate) fn new(curve: BezierCurve<DVec2>) -> Self {
        let control = curve.control();
        let polynomial = control.len() <= MOST_POWERS && control.iter().all(|h| h.weight == 1.0);
        let mut powers = ([DVec2::ZERO; MOST_POWERS], 0);
        if polynomial {
            // The k-th power has the coefficient C(n, k) times the k-th difference at the start.
            let mut differences: Vec<DVec2> = control.iter().map(|h| h.weighted).collect();
            for (k, power) in powers.0.iter_mut().enumerate().take(control.len()) {
                *power = bezier_mass::bernstein::binomial(control.len() - 1, k) * differences[0];
                differences = differences
                    .windows(2)
                    .map(|pair| pair[1] - pair[0])
                    .collect();
            }
        }
        if polynomial {
            powers.1 = control.len();
        }
        let tangents = tangents(&curve);
        Self {
            curve,
            powers,
            tangents,
        }
    }

    pub(crate) fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for mass in self.curve.control() {
            match mass.position() {
                Some(point) if mass.weight > 0.0 => {
                    bounds = bounds.union(Bounds {
                        low: point,
                        high: point,
                    })
                }
                _ => return Bounds::EVERYTHING,
            }
        }
        let margin = MARGIN * (bounds.high - bounds.low).max_element();
        Bounds {
            low: bounds.low - margin,
            high: bounds.high + margin,
        }
    }

    /// As [`Chain::visit_parts`], divided until the tangents turn little and the part is small.
    pub(crate) fn visit_parts(
        &self,
        bounds: Bounds,
        wedge: &Wedge,
        corners: [DVec2; 2],
        size: f64,
        depth: u32,
        found: &mut dyn FnMut(Option<Part>),
    ) {
        if !(bounds.overlaps(corners[0], corners[1]) && wedge.may_meet(bounds.low, bounds.high)) {
            return;
        }
        let tangents = self.tangents;
        let is_small = (bounds.high - bounds.low).length() <= size
            && tangents.is_some_and(|(_, spread)| spread <= SMALL_TURN);
        if is_small || depth >= MOST_SPLITS {
            found(tangents.map(|(tangent, spread)| Part {
                low: bounds.low,
                high: bounds.high,
                tangent,
                spread,
            }));
            return;
        }
        let (first, second) = self.curve.subdivide(0.5);
        for half in [first, second] {
            let half = Self::new(half);
            half.visit_parts(half.bounds(), wedge, corners, size, depth + 1, found);
        }
    }

    /// Position, first and second derivative.
    #[inline]
    pub(crate) fn jet(&self, t: f64) -> Option<[DVec2; 3]> {
        let (powers, count) = &self.powers;
        if *count == 0 {
            let jet = self.curve.jet(t);
            return Some([jet.position()?, jet.velocity()?, jet.acceleration()?]);
        }
        let (mut value, mut slope, mut half_bend) = (DVec2::ZERO, DVec2::ZERO, DVec2::ZERO);
        for &power in powers.get(..*count)?.iter().rev() {
            half_bend = half_bend * t + slope;
            slope = slope * t + value;
            value = value * t + power;
        }
        Some([value, slope, 2.0 * half_bend])
    }

    /// The sides of a line on which the control points lie, `<J V, h - w X>`: a polynomial in Bernstein form whose roots are
    /// the crossings.
    #[inline]
    pub(crate) fn sides<'a>(
        &self,
        origin: DVec2,
        velocity: DVec2,
        room: &'a mut [f64; MOST_POWERS],
        more: &'a mut Vec<f64>,
    ) -> &'a [f64] {
        let control = self.curve.control();
        let values = control
            .iter()
            .map(|mass| velocity.perp_dot(mass.weighted - mass.weight * origin));
        if control.len() <= MOST_POWERS {
            for (slot, value) in room.iter_mut().zip(values) {
                *slot = value;
            }
            &room[..control.len()]
        } else {
            more.extend(values);
            more
        }
    }

    pub(crate) fn impact(
        &self,
        t: f64,
        index: usize,
        origin: DVec2,
        velocity: DVec2,
    ) -> Option<Impact> {
        impact(self.jet(t)?, index as f64 + t, origin, velocity)
    }
}

/// The angle of the tangents, to a spread: they lie between the edges of the control polygon, which for positive weights
/// span all differences of control points. None if it turns by a right angle or has no edge.
fn tangents(curve: &BezierCurve<DVec2>) -> Option<(f64, f64)> {
    let control = curve.control();
    let chord = control.last()?.position()? - control.first()?.position()?;
    let (mut least, mut most) = (0.0_f64, 0.0_f64);
    for pair in control.windows(2) {
        let edge = pair[1].position()? - pair[0].position()?;
        if pair[0].weight <= 0.0 || pair[1].weight <= 0.0 || chord.dot(edge) < 0.0 {
            return None;
        }
        let angle = chord.perp_dot(edge).atan2(chord.dot(edge));
        (least, most) = (least.min(angle), most.max(angle));
    }
    (chord != DVec2::ZERO).then(|| {
        (
            chord.to_angle() + 0.5 * (least + most),
            0.5 * (most - least),
        )
    })
}

pub(crate) fn impact(
    [point, slope, bend]: [DVec2; 3],
    parameter: f64,
    origin: DVec2,
    velocity: DVec2,
) -> Option<Impact> {
    let speed = slope.length();
    if speed == 0.0 {
        return None;
    }
    let inverse = speed.recip();
    Some(Impact {
        time: velocity.dot(point - origin) / velocity.length_squared(),
        point,
        tangent: slope * inverse,
        curvature: slope.perp_dot(bend) * inverse * inverse * inverse,
        parameter,
    })
}

/// The number of sign changes; none if a zero makes it unclear.
#[inline]
pub(crate) fn sign_changes(values: &[f64]) -> Option<usize> {
    let mut changes = 0;
    for pair in values.windows(2) {
        if pair[0] == 0.0 || pair[1] == 0.0 {
            return None;
        }
        changes += usize::from((pair[0] > 0.0) != (pair[1] > 0.0));
    }
    Some(changes)
}

impl Bounds {
    pub(crate) const EMPTY: Self = Self {
        low: DVec2::INFINITY,
        high: DVec2::NEG_INFINITY,
    };
    pub(crate) const EVERYTHING: Self = Self {
        low: DVec2::NEG_INFINITY,
        high: DVec2::INFINITY,
    };

    pub(crate) fn is_empty(&self) -> bool {
        self.low.x > self.high.x
    }

    /// The circle around a box; none for an empty or an infinite one.
    pub(crate) fn circle(&self) -> Option<(DVec2, f64)> {
        let half = 0.5 * (self.high - self.low);
        (!self.is_empty() && half.is_finite()).then(|| (self.low + half, half.length()))
    }

    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Whether a ray may meet the box before `latest`. Written so that infinite boxes, whose centre is no number, pass.
    #[inline]
    pub(crate) fn may_meet(&self, origin: DVec2, velocity: DVec2, latest: f64) -> bool {
        if self.is_empty() {
            return false;
        }
        let centre = 0.5 * (self.low + self.high) - origin;
        let half = 0.5 * (self.high - self.low);
        let aside = velocity.perp_dot(centre).abs();
        if aside > velocity.x.abs() * half.y + velocity.y.abs() * half.x {
            return false;
        }
        let (along, reach) = (velocity.dot(centre), velocity.abs().dot(half));
        if along + reach < 0.0 {
            return false;
        }
        let too_late = along - reach > latest * velocity.length_squared();
        !too_late
    }

    #[inline]
    pub(crate) fn overlaps(&self, from: DVec2, to: DVec2) -> bool {
        self.low.cmple(from.max(to)).all() && self.high.cmpge(from.min(to)).all()
    }
}
