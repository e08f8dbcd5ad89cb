//! Where two Bézier curves cross, and where one crosses itself.
//!
//! Subdivision with fat lines (Sederberg and Nishita 1990) discards, tangent cones (Sederberg and Meyers 1988) prove: arcs
//! whose tangent directions lie in disjoint cones cross at most once, and they do if the ends of each lie on opposite sides
//! of the other's fat line. A tangency or an end on the other curve has no such proof and is reported as undecided.

use glam::DVec2;

use crate::Error;
use crate::arc::Arc;
use crate::curve::Curve;
use crate::fat_line::{FatLine, Side};
use crate::rounding::U;

/// Two arcs narrower than this in the parameter are not subdivided further.
const NARROWEST: f64 = 1.0 / (1_u64 << 32) as f64;

/// Pairs of arcs that are looked at before the curves are said to coincide: a hundred crossings need a tenth of it.
const MAX_PAIRS: usize = 1 << 16;

/// Half widths tried for the enclosure of a crossing.
const REACHES: [f64; 4] = [1e-13, 1e-12, 1e-11, 1e-9];

/// A place where two curves meet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Meeting {
    /// Lower and upper end of the parameter on the first curve.
    pub first: [f64; 2],
    /// Lower and upper end of the parameter on the second curve.
    pub second: [f64; 2],
    /// The point of the first curve in the middle of its enclosure.
    pub point: DVec2,
    /// Whether it is proven that the curves cross exactly once here, at an angle. Otherwise they come closer than rounding:
    /// they touch, nearly touch, coincide for a while, or one ends on the other.
    pub crossing: bool,
}

impl Curve<'_> {
    /// All places where two curves meet, ascending along the first.
    ///
    /// # Errors
    /// [`Error::LiesOn`] if the curves cannot be separated: they share an arc, or nearly.
    ///
    /// # Examples
    /// ```
    /// use glam::DVec2;
    /// use variation::Curve;
    /// let a = [(0.0, 0.0), (1.0, 3.0), (2.0, -3.0), (3.0, 0.0)].map(DVec2::from);
    /// let b = [(0.1, 1.0), (1.5, -3.0), (2.9, 2.0)].map(DVec2::from);
    /// let meetings = Curve::polynomial(&a)?.meet_curve(Curve::polynomial(&b)?)?;
    /// assert!(meetings.iter().all(|m| m.crossing));
    /// # Ok::<(), variation::Error>(())
    /// ```
    pub fn meet_curve(self, other: Curve<'_>) -> Result<Vec<Meeting>, Error> {
        let mut search = Search::new(self, other);
        search.run(vec![(Arc::whole(self), Arc::whole(other))])?;
        Ok(search.finish())
    }

    /// All places where the curve crosses or touches itself; `first` is the smaller parameter. A cusp is reported as undecided.
    ///
    /// Arcs whose tangents turn by less than 180 degrees have no double point.
    ///
    /// # Errors
    /// [`Error::LiesOn`] if the curve covers an arc of itself twice.
    pub fn self_meetings(self) -> Result<Vec<Meeting>, Error> {
        let mut search = Search::new(self, self);
        let mut apart = Vec::new();
        let mut single = vec![Arc::whole(self)];
        let mut adjacent = Vec::new();
        while let Some(arc) = single.pop() {
            if arc.cone().is_none() && arc.width() > NARROWEST {
                let (left, right) = arc.halves();
                adjacent.push((left.clone(), right.clone()));
                single.extend([left, right]);
            }
        }
        while let Some((left, right)) = adjacent.pop() {
            if Arc::cone_of(left.edges().chain(right.edges())).is_some() {
                continue;
            }
            if left.width().max(right.width()) <= NARROWEST {
                search.undecided(&left, &right);
                continue;
            }
            let ((far_left, near_left), (near_right, far_right)) = (left.halves(), right.halves());
            apart.extend([
                (far_left.clone(), near_right.clone()),
                (near_left.clone(), far_right.clone()),
                (far_left, far_right),
            ]);
            adjacent.push((near_left, near_right));
        }
        search.run(apart)?;
        Ok(search.finish())
    }
}

/// What is known about two arcs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Relation {
    Apart,
    CrossOnce,
    Unknown,
}

struct Search {
    whole: (Arc, Arc),
    /// Bound on the rounding of control points, with a margin.
    slack: f64,
    found: Vec<Meeting>,
}

impl Search {
    fn new(first: Curve<'_>, second: Curve<'_>) -> Self {
        let points = first.points().iter().chain(second.points());
        let size = points.fold(0.0_f64, |m, p| m.max(p.abs().max_element()));
        let degree = first.degree().max(second.degree());
        // At most 40 subdivisions of `degree` rows, a few roundings each, and one division by the weight.
        let slack = 256.0 * (degree + 1) as f64 * U * size;
        Self {
            whole: (Arc::whole(first), Arc::whole(second)),
            slack,
            found: Vec::new(),
        }
    }

    fn relation(&self, a: &Arc, b: &Arc) -> Relation {
        let (strip_a, strip_b) = (FatLine::of(a, self.slack), FatLine::of(b, self.slack));
        if strip_a.common_side(b.points()) != Side::Within
            || strip_b.common_side(a.points()) != Side::Within
            || !self.boxes_overlap(a, b)
        {
            return Relation::Apart;
        }
        let (Some(cone_a), Some(cone_b)) = (a.cone(), b.cone()) else {
            return Relation::Unknown;
        };
        if !cone_a.is_apart_from(cone_b) {
            return Relation::Unknown;
        }
        let sides_a = a.ends().map(|p| strip_b.side(p));
        let sides_b = b.ends().map(|p| strip_a.side(p));
        let opposite = |sides: [Side; 2]| !sides.contains(&Side::Within) && sides[0] != sides[1];
        let equal = |sides: [Side; 2]| !sides.contains(&Side::Within) && sides[0] == sides[1];
        if equal(sides_a) || equal(sides_b) {
            Relation::Apart
        } else if opposite(sides_a) && opposite(sides_b) {
            Relation::CrossOnce
        } else {
            Relation::Unknown
        }
    }

    fn boxes_overlap(&self, a: &Arc, b: &Arc) -> bool {
        let bounds = |arc: &Arc| {
            arc.points()
                .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), p| {
                    (lo.min(p), hi.max(p))
                })
        };
        let ((a_lo, a_hi), (b_lo, b_hi)) = (bounds(a), bounds(b));
        (a_lo - self.slack).cmple(b_hi).all() && (b_lo - self.slack).cmple(a_hi).all()
    }

    fn run(&mut self, mut waiting: Vec<(Arc, Arc)>) -> Result<(), Error> {
        let mut pairs = 0;
        while let Some((a, b)) = waiting.pop() {
            pairs += 1;
            if pairs > MAX_PAIRS {
                return Err(Error::LiesOn);
            }
            match self.relation(&a, &b) {
                Relation::Apart => continue,
                Relation::CrossOnce => {
                    self.crossing(&a, &b);
                    continue;
                }
                Relation::Unknown => {}
            }
            if self.common_end(&a, &b) {
                continue;
            }
            let (split_a, split_b) = (a.width() > NARROWEST, b.width() > NARROWEST);
            let halves = |arc: Arc, split: bool| {
                if split {
                    let (left, right) = arc.halves();
                    vec![left, right]
                } else {
                    vec![arc]
                }
            };
            if !split_a && !split_b {
                self.undecided(&a, &b);
                continue;
            }
            let parts_b = halves(b, split_b);
            for part_a in halves(a, split_a) {
                waiting.extend(
                    parts_b
                        .iter()
                        .map(|part_b| (part_a.clone(), part_b.clone())),
                );
            }
        }
        Ok(())
    }

    /// Curves that share an end, at an angle: with disjoint cones that is their only meeting.
    fn common_end(&mut self, a: &Arc, b: &Arc) -> bool {
        let apart = matches!((a.cone(), b.cone()), (Some(x), Some(y)) if x.is_apart_from(y));
        let given = |arc: &Arc, point: usize| [arc.lo == 0.0, arc.hi == 1.0][point];
        for (i, p) in a.ends().into_iter().enumerate() {
            for (j, q) in b.ends().into_iter().enumerate() {
                if apart && p == q && given(a, i) && given(b, j) {
                    let (s, t) = (i as f64, j as f64);
                    self.found.push(Meeting {
                        first: [s, s],
                        second: [t, t],
                        point: p,
                        crossing: true,
                    });
                    return true;
                }
            }
        }
        false
    }

    /// Encloses a proven crossing as tightly as the same proof allows.
    fn crossing(&mut self, a: &Arc, b: &Arc) {
        let (mut s, mut t) = (0.5, 0.5);
        for _ in 0..20 {
            let ((p, dp), (q, dq)) = (a.local(s), b.local(t));
            let gap = q - p;
            let determinant = dp.perp_dot(dq);
            let step = DVec2::new(gap.perp_dot(dq), gap.perp_dot(dp)) / determinant;
            if !step.is_finite() {
                break;
            }
            (s, t) = ((s + step.x).clamp(0.0, 1.0), (t + step.y).clamp(0.0, 1.0));
            if step.abs().max_element() < 4.0 * f64::EPSILON {
                break;
            }
        }
        let (s, t) = (a.lo + a.width() * s, b.lo + b.width() * t);
        let (mut first, mut second) = ([a.lo, a.hi], [b.lo, b.hi]);
        for reach in REACHES {
            let near = |x: f64, arc: &Arc| [(x - reach).max(arc.lo), (x + reach).min(arc.hi)];
            let (near_a, near_b) = (near(s, a), near(t, b));
            let part_a = self.whole.0.between(near_a[0], near_a[1]);
            let part_b = self.whole.1.between(near_b[0], near_b[1]);
            if self.relation(&part_a, &part_b) == Relation::CrossOnce {
                (first, second) = (near_a, near_b);
                break;
            }
        }
        let point = self.whole.0.local(0.5 * (first[0] + first[1])).0;
        self.found.push(Meeting {
            first,
            second,
            point,
            crossing: true,
        });
    }

    fn undecided(&mut self, a: &Arc, b: &Arc) {
        let point = a.local(0.5).0;
        self.found.push(Meeting {
            first: [a.lo, a.hi],
            second: [b.lo, b.hi],
            point,
            crossing: false,
        });
    }

    /// Joins neighbouring undecided places, and those at a proven crossing, and sorts.
    fn finish(mut self) -> Vec<Meeting> {
        self.found.sort_by(|a, b| {
            a.first[0]
                .total_cmp(&b.first[0])
                .then(a.second[0].total_cmp(&b.second[0]))
        });
        let touch = |x: [f64; 2], y: [f64; 2]| {
            x[0] <= y[1] + 2.0 * NARROWEST && y[0] <= x[1] + 2.0 * NARROWEST
        };
        let mut joined: Vec<Meeting> = Vec::new();
        for meeting in self.found {
            let near = joined.iter_mut().rev().find(|other| {
                !(other.crossing && meeting.crossing)
                    && touch(other.first, meeting.first)
                    && touch(other.second, meeting.second)
            });
            match near {
                None => joined.push(meeting),
                Some(other) if other.crossing => {}
                Some(other) if meeting.crossing => *other = meeting,
                Some(other) => {
                    for (span, more) in [
                        (&mut other.first, meeting.first),
                        (&mut other.second, meeting.second),
                    ] {
                        *span = [span[0].min(more[0]), span[1].max(more[1])];
                    }
                    other.point = self
                        .whole
                        .0
                        .local(0.5 * (other.first[0] + other.first[1]))
                        .0;
                }
            }
        }
        joined
    }
}
