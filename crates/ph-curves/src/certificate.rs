//! Proof that a curve and its approximation are close, by enclosures of their radii of curvature.
//!
//! The difference `e` of the supports of two curves at the angle `psi` of their common normal satisfies `e'' + e = R_1 - R_2`,
//! whatever joins their parameters. Between two normals an angle `h` apart at which `|e| <= a`, with `|R_1 - R_2| <= r` in
//! between, therefore
//!
//! ```text
//!     |e| <= (a + r h²/8) / (1 - h²/8).
//! ```
//!
//! Next to cusps, where the radii have no bounds, the lengths of both parts and their turning bound `e`; next to inflections, where
//! normals turn back, chords and the heights above them bound the distance of the points.

use bezier_mass::bernstein;
use glam::DVec2;

use crate::course::End;
use crate::polynomial::range;
use crate::{Approximated, Error, Piece, PlacedArc, PlaneCurve, Side};

/// Bounds on a part of a curve, by which its approximation is certified. Derivatives are by the local parameter of the span.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Enclosure {
    /// Least and greatest square of the speed, `|r'|²`.
    pub speed_squared: [f64; 2],
    /// Least and greatest `det(r', r'')`, whose sign is that of the curvature.
    pub bend: [f64; 2],
    /// The greatest length of `r''`.
    pub acceleration: f64,
}

/// No smaller part of a span is looked at.
const LEAST_WIDTH: f64 = 1.0 / (1_u64 << 40) as f64;
/// A bend below this share of the largest one of its span is the rounding of zero.
const BEND_ROUNDING: f64 = 1e-12;
/// The sine of the angle between two normals that are the same but for rounding.
const SAME_NORMAL: f64 = 1e-7;

impl Approximated {
    /// Proves that the spline is within `tolerance` of the curve that it was made from: at every normal the supports of both
    /// differ by no more, and where normals turn back (next to inflections) or a segment stands for a part of the curve, all of that
    /// is as near to the spline. Returns the bound that was reached, at most `tolerance`.
    ///
    /// The parts of the curve are halved until enclosures of both curves tell, which takes the longer the nearer the tolerance
    /// is to the true error; at [`Approximated::error`] it takes some ten to three hundred times as long as the approximation. The
    /// proof is one in exact arithmetic: rounding, some ulps of the largest coordinate, is not bounded.
    ///
    /// # Errors
    /// [`Error::NotCertified`] where the curve is farther away, or the enclosures do not tell; [`Error::NoEnclosure`] if the
    /// curve has none; [`Error::BadTolerance`].
    pub fn certify<C: PlaneCurve + ?Sized>(&self, curve: &C, tolerance: f64) -> Result<f64, Error> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(Error::BadTolerance { tolerance });
        }
        let end = curve.spans() as f64;
        let (mut most, mut covered, mut first) = (0.0_f64, 0.0, 0);
        for (index, source) in self.sources.iter().enumerate() {
            // The arcs of a pair share their source; corners have none.
            let follows = self.sources.get(index + 1) == Some(source);
            if follows && source[0] < source[1] {
                continue;
            }
            let pieces = self.spline.pieces().get(first..=index);
            first = index + 1;
            if source[0] == source[1] {
                continue;
            }
            let pieces = pieces
                .filter(|_| 0.0 <= source[0] && source[0] < source[1] && source[1] <= end)
                .ok_or(Error::NotCertified {
                    start: source[0],
                    end: source[1],
                    bound: f64::INFINITY,
                })?;
            let part = Part::new(curve, pieces, tolerance);
            most = most.max(part.skipped([covered, source[0]])?);
            most = most.max(part.covered(*source)?);
            covered = source[1].max(covered);
        }
        let part = Part::new(curve, &[], tolerance);
        Ok(most.max(part.skipped([covered, end])?))
    }
}

/// A part of the curve and the pieces that stand for it: a segment, an arc, or the two arcs of a pair.
struct Part<'a, C: ?Sized> {
    curve: &'a C,
    pieces: &'a [Piece],
    radii: Vec<Radii>,
    tolerance: f64,
}

/// A point of the curve and what stands for it.
#[derive(Clone, Copy)]
struct Witness {
    /// The curve's point.
    end: End,
    /// The number and the parameter of the piece's point with the same normal.
    place: (usize, f64),
    /// From the curve's point to the piece's.
    apart: DVec2,
    /// Whether they have the same normal, but for rounding.
    comparable: bool,
    /// The difference of the supports if they are comparable, or the distance.
    error: f64,
}

impl<'a, C: PlaneCurve + ?Sized> Part<'a, C> {
    fn new(curve: &'a C, pieces: &'a [Piece], tolerance: f64) -> Self {
        Self {
            curve,
            pieces,
            radii: pieces.iter().map(Radii::of).collect(),
            tolerance,
        }
    }

    /// A bound for a stretch of the parameter without pieces: it has to be as short as that.
    fn skipped(&self, range: [f64; 2]) -> Result<f64, Error> {
        let mut length = 0.0;
        for (span, [from, to]) in spans(range) {
            let [_, fast] = self.enclosure(span, [from, to])?.speed_squared;
            length += (to - from) * fast.sqrt();
        }
        if length <= self.tolerance {
            return Ok(length);
        }
        Err(Error::NotCertified {
            start: range[0],
            end: range[1],
            bound: length,
        })
    }

    /// A bound for a stretch that the pieces stand for.
    fn covered(&self, range: [f64; 2]) -> Result<f64, Error> {
        let mut most = 0.0_f64;
        for (span, [from, to]) in spans(range) {
            let ends = [
                self.witness(span, from, Side::After)?,
                self.witness(span, to, Side::Before)?,
            ];
            let whole = self.enclosure(span, [0.0, 1.0])?.bend;
            let noise = BEND_ROUNDING * whole[0].abs().max(whole[1].abs());
            let mut waiting = vec![ends];
            while let Some([a, b]) = waiting.pop() {
                let bound = self.bound(&a, &b, noise)?;
                if bound <= self.tolerance {
                    most = most.max(bound);
                    continue;
                }
                let undecided = a.error.max(b.error) <= self.tolerance;
                if !undecided || b.end.t - a.end.t <= LEAST_WIDTH {
                    return Err(Error::NotCertified {
                        start: a.end.parameter(),
                        end: b.end.parameter(),
                        bound,
                    });
                }
                let middle = self.witness(span, 0.5 * (a.end.t + b.end.t), Side::Before)?;
                waiting.extend([[middle, b], [a, middle]]);
            }
        }
        Ok(most)
    }

    fn enclosure(&self, span: usize, range: [f64; 2]) -> Result<Enclosure, Error> {
        self.curve
            .enclosure(span, range)
            .ok_or(Error::NoEnclosure { span })
    }

    fn witness(&self, span: usize, t: f64, side: Side) -> Result<Witness, Error> {
        let end = End::at(self.curve, span, t, side)?;
        let witness = |place: (usize, f64), apart: DVec2, error: f64| Witness {
            end,
            place,
            apart,
            comparable: true,
            error,
        };
        if let [Piece::Segment(segment)] = self.pieces {
            let along = segment.end - segment.start;
            let share = (end.point - segment.start).dot(along) / along.length_squared();
            let apart = segment.start + along * share.clamp(0.0, 1.0) - end.point;
            return Ok(witness((0, share), apart, apart.length()));
        }
        let place = self.place(&end);
        let piece = &self.pieces[place.0];
        let apart = piece.point(place.1) - end.point;
        let turned = piece.normal(place.1).perp_dot(end.normal).abs();
        if turned <= SAME_NORMAL {
            return Ok(witness(place, apart, apart.dot(end.normal).abs()));
        }
        // A normal that the arcs lack, next to an inflection that was moved.
        let (t, distance) = piece.nearest(end.point);
        Ok(Witness {
            comparable: false,
            ..witness((place.0, t), piece.point(t) - end.point, distance)
        })
    }

    /// The arc with the normal of a point of the curve, and the parameter there.
    fn place(&self, end: &End) -> (usize, f64) {
        let last = self.pieces.len() - 1;
        let beyond = |piece: &&Piece| {
            let turned = piece.normal(1.0).perp_dot(end.normal);
            turned * piece.turning() > 0.0
        };
        let index = self.pieces[..last].iter().take_while(beyond).count();
        let t = self.pieces[index].parameter_like(end);
        (index, t.clamp(0.0, 1.0))
    }

    /// A bound of the error between two points of one span; a bend below `noise` is rounding.
    fn bound(&self, a: &Witness, b: &Witness, noise: f64) -> Result<f64, Error> {
        let enclosure = self.enclosure(a.end.span, [a.end.t, b.end.t])?;
        let width = b.end.t - a.end.t;
        let ends = a.error.max(b.error);
        if let [Piece::Segment(_)] = self.pieces {
            return Ok(ends + 0.125 * width * width * enclosure.acceleration);
        }
        let [low, high] = enclosure.bend;
        let monotone = low >= -noise || high <= noise;
        if !(monotone && a.comparable && b.comparable) {
            return Ok(self.by_chords(a, b) + 0.125 * width * width * enclosure.acceleration);
        }
        let by_radii = enclosure.radii().map_or(f64::INFINITY, |of_curve| {
            let [least, greatest] = self.radii_between(a.place, b.place);
            let apart = (greatest - of_curve[0]).max(of_curve[1] - least);
            let turning = a.end.turning_to(&b.end);
            let h = turning.sine.atan2(turning.cosine);
            let share = 0.125 * h * h;
            if share < 0.5 {
                (ends + apart * share) / (1.0 - share)
            } else {
                f64::INFINITY
            }
        });
        let [slow, fast] = enclosure.speed_squared;
        let turning = (width * low.abs().max(high.abs()) / slow.max(0.0)).min(1.0);
        let lengths = width * fast.sqrt() + self.length_between(a.place, b.place);
        let by_lengths = a.error + turning * a.apart.length() + (2.0 * turning).min(1.0) * lengths;
        Ok(by_radii.min(by_lengths))
    }

    /// The parts of the pieces between two places.
    fn between(
        &self,
        (first, from): (usize, f64),
        (last, to): (usize, f64),
    ) -> impl Iterator<Item = (&Radii, [f64; 2])> {
        let [from, to] = if first == last {
            [from.min(to), from.max(to)]
        } else {
            [from, to]
        };
        (first..=last).map(move |k| {
            let start = if k == first { from } else { 0.0 };
            (&self.radii[k], [start, if k == last { to } else { 1.0 }])
        })
    }

    /// A bound of the distance of the pieces between the points nearest to two of the curve from the chord of these.
    fn by_chords(&self, a: &Witness, b: &Witness) -> f64 {
        let nearest = |w: &Witness| {
            let (t, distance) = self.pieces[w.place.0].nearest(w.end.point);
            ((w.place.0, t), distance)
        };
        let ((one, from_one), (two, from_two)) = (nearest(a), nearest(b));
        let turning: f64 = self
            .between(one, two)
            .map(|(radii, range)| radii.turning(range))
            .sum();
        from_one.max(from_two) + self.length_between(one, two) * turning.min(1.0)
    }

    /// The range of the pieces' radii between two places.
    fn radii_between(&self, a: (usize, f64), b: (usize, f64)) -> [f64; 2] {
        let hull = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.min(c), b.max(d)];
        self.between(a, b)
            .map(|(radii, range)| radii.radii(range))
            .fold([f64::INFINITY, f64::NEG_INFINITY], hull)
    }

    /// A bound of the pieces' length between two places.
    fn length_between(&self, a: (usize, f64), b: (usize, f64)) -> f64 {
        self.between(a, b)
            .map(|(radii, [from, to])| {
                let [least, greatest] = radii.numerator([from, to]);
                (to - from) * least.abs().max(greatest.abs()) * radii.rate
            })
            .sum()
    }
}

/// The radius of curvature of an arc: a polynomial on `[0, 1]`, divided by the own parameter for an arc about an inflection.
struct Radii {
    coefficients: Vec<f64>,
    /// The own parameter at both ends, for an arc about an inflection.
    inflected: Option<[f64; 2]>,
    /// Bound of the turning by the parameter, divided by the own parameter for an arc about an inflection: the speed is at most the
    /// polynomial times this.
    rate: f64,
}

impl Radii {
    fn of(piece: &Piece) -> Self {
        match piece {
            Piece::Segment(_) => Self {
                coefficients: Vec::new(),
                inflected: None,
                rate: 0.0,
            },
            Piece::Arc(arc) => Self::of_arc(arc),
            Piece::Wide(arc) => Self::of_arc(arc),
            Piece::Wider(arc) => Self::of_arc(arc),
            Piece::Inflected(arc) => {
                let (radius, range, rate) = arc.radius_times_own();
                Self {
                    coefficients: radius.to_vec(),
                    inflected: Some(range),
                    rate,
                }
            }
        }
    }

    fn of_arc<const N: usize>(arc: &PlacedArc<N>) -> Self {
        Self {
            coefficients: arc.radius_coefficients(),
            inflected: None,
            rate: arc.local.most_turning_rate(),
        }
    }

    /// A bound of the turning over a range of the parameter.
    fn turning(&self, [from, to]: [f64; 2]) -> f64 {
        let own = self.inflected.map_or(1.0, |[start, end]| {
            let own = |t: f64| (start + (end - start) * t).abs();
            own(from).max(own(to))
        });
        (to - from) * self.rate * own
    }

    /// The range of the polynomial over a range of the parameter.
    fn numerator(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        range(&bernstein::restrict(&self.coefficients, from, to))
    }

    /// The range of the radius over a range of the parameter; infinite where it has no bounds.
    fn radii(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        let [least, greatest] = self.numerator([from, to]);
        let Some([start, end]) = self.inflected else {
            return [least, greatest];
        };
        let own = [from, to].map(|t| start + (end - start) * t);
        if own[0] * own[1] <= 0.0 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        range(&[
            least / own[0],
            least / own[1],
            greatest / own[0],
            greatest / own[1],
        ])
    }
}

impl Enclosure {
    /// The range of the signed radius of curvature; none where the curvature may vanish.
    fn radii(&self) -> Option<[f64; 2]> {
        let [low, high] = self.bend;
        let cube = |square: f64| square.max(0.0) * square.max(0.0).sqrt();
        let [slow, fast] = self.speed_squared.map(cube);
        if low > 0.0 {
            Some([slow / high, fast / low])
        } else if high < 0.0 {
            Some([fast / high, slow / low])
        } else {
            None
        }
    }
}

/// The spans of a range of the curve's parameter, with the local parameters.
fn spans([from, to]: [f64; 2]) -> impl Iterator<Item = (usize, [f64; 2])> {
    let first = from.floor();
    (0..)
        .map(move |k| first + f64::from(k))
        .take_while(move |span| *span < to)
        .map(move |span| {
            (
                span as usize,
                [(from - span).max(0.0), (to - span).min(1.0)],
            )
        })
        .filter(|(_, [from, to])| from < to)
}
