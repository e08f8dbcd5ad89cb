//! Fronts fitted to exact rays: G1 splines of class-3 arcs, halved until other rays agree.

use glam::DVec2;
use ph_curves::{G1Ends, LineElement, TQuartic};

use crate::departure::Departures;
use crate::front::{Front, FrontPiece, PieceShape};
use crate::{Cut, Error, Medium, Ray};

/// How closely a front is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrontTolerance {
    /// Largest error of the eikonal, a time: the distance of the fronts, over the speed.
    pub time: f64,
    /// Rays inside each arc to which its free parameter is fitted; the error is measured on as many others.
    pub samples: usize,
}

impl FrontTolerance {
    /// This tolerance, with three rays fitted in each arc.
    #[must_use]
    pub const fn time(time: f64) -> Self {
        Self { time, samples: 3 }
    }
}

/// An arc turns by less than this (radians); half a turn is the limit of the form.
pub(crate) const MOST_TURNING: f64 = 2.5;
/// A piece whose normal turns less than this (radians) is straight: the bulge is below rounding.
const STRAIGHT: f64 = 1e-12;
/// Halvings of the source's parameter before a sliver is given up: less than a millionth of a millionth of the stretch.
const MOST_DEPTH: u32 = 40;
/// A front with more slivers than this does not converge at all: its tolerance is below rounding.
const MOST_SLIVERS: usize = 32;
/// A stretch with more arcs than this is given up where it is not fitted yet.
const MOST_ARCS: usize = 1 << 12;
/// Departures are known to this share of their range on a piece, or the tolerance over this.
const DEPARTURE: f64 = 1e-3;
/// An inflection of the front is bracketed to this share of the source's parameter.
const INFLECTION: f64 = 1e-13;

/// A ray's data for the fit: unit normal, point and support at time zero in the unit plane, and the departure.
#[derive(Clone, Copy, Debug)]
struct Element {
    normal: DVec2,
    point: DVec2,
    support: f64,
    departure: f64,
    /// The derivative of the normal's angle by the source's parameter.
    turning: f64,
    place: DVec2,
}

/// What a stretch of parameters is replaced by.
struct Fitter<'f, R> {
    ray: &'f R,
    shape: &'f Front,
    tolerance: FrontTolerance,
    fronts: Vec<Front>,
    current: Front,
    slivers: usize,
    arcs: usize,
}

impl<R> Fitter<'_, R> {
    /// Whether a range may be halved once more.
    const fn may_halve(&self, depth: u32) -> bool {
        depth < MOST_DEPTH && self.arcs < MOST_ARCS
    }
}

impl Front {
    /// Fits a front to rays given as a function of a parameter, between consecutive `breaks`: one arc between two rays, its
    /// free parameter by linear least squares over inner rays, halved until other inner rays agree.
    ///
    /// # Errors
    /// [`Error::BadSpeed`] in a medium without a unit plane (a rational indicatrix that is no ellipse);
    /// [`Error::OutOfRange`] for a tolerance that is not positive; [`Error::NotConverged`] if some part cannot be fitted;
    /// the errors of the rays.
    pub fn fit(
        medium: &Medium,
        layer: usize,
        breaks: &[f64],
        ray: impl Fn(f64) -> Result<Ray, Error>,
        tolerance: FrontTolerance,
    ) -> Result<Self, Error> {
        let whole = Self::fit_stretch(medium, layer, breaks, ray, tolerance, [None, None])?;
        let mut fronts = whole.into_iter();
        let Some(front) = fronts.next() else {
            return Self::empty(medium, layer);
        };
        match front.cuts {
            [None, None] => Ok(front),
            [Some(cut), _] | [None, Some(cut)] => Err(cut.reason),
        }
    }

    /// As [`Front::fit`], but slivers that cannot be fitted are left out and cut the front in several; `ends` are the cuts at
    /// the two ends of all.
    pub(crate) fn fit_stretch(
        medium: &Medium,
        layer: usize,
        breaks: &[f64],
        ray: impl Fn(f64) -> Result<Ray, Error>,
        tolerance: FrontTolerance,
        [start, end]: [Option<Cut>; 2],
    ) -> Result<Vec<Self>, Error> {
        if !(tolerance.time > 0.0 && tolerance.time.is_finite()) {
            return Err(Error::OutOfRange {
                what: "the tolerance of a front",
                value: tolerance.time,
            });
        }
        let empty = Self::empty(medium, layer)?;
        let mut fitter = Fitter {
            ray: &ray,
            shape: &empty,
            tolerance,
            fronts: Vec::new(),
            current: empty.clone(),
            slivers: 0,
            arcs: 0,
        };
        fitter.current.cuts[0] = start.map(Box::new);
        for range in breaks.windows(2) {
            fitter.range(range[0], range[1], 0)?;
        }
        fitter.flush(end);
        Ok(fitter.fronts)
    }

    /// A front from samples of points and unit normals at time zero, one arc between each two `stride` apart whose free
    /// parameter is fitted to those in between.
    ///
    /// # Errors
    /// [`Error::NotMonotone`] where the normals stop turning or turn back; [`Error::BadSpeed`]; [`Error::NonFinite`].
    pub fn from_samples(
        medium: &Medium,
        layer: usize,
        samples: &[(DVec2, DVec2)],
        stride: usize,
    ) -> Result<Self, Error> {
        let mut front = Self::empty(medium, layer)?;
        if samples
            .iter()
            .any(|(point, normal)| !(point.is_finite() && normal.is_finite()))
        {
            return Err(Error::NonFinite {
                what: "a sample of a front",
            });
        }
        if samples.len() < 2 || stride == 0 {
            return Err(Error::OutOfRange {
                what: "the number of samples of a front",
                value: samples.len() as f64,
            });
        }
        let elements: Vec<Element> = samples
            .iter()
            .map(|&(point, normal)| {
                let normal = (front.from_unit * normal).normalize();
                let point = front.to_unit * point;
                Element {
                    normal,
                    point,
                    support: normal.dot(point),
                    departure: 0.0,
                    turning: 0.0,
                    place: point,
                }
            })
            .collect();
        let turn = |i: usize| elements[i].normal.perp_dot(elements[i + 1].normal);
        let sense = turn(0).signum();
        if let Some(index) =
            (0..elements.len() - 1).find(|&i| (sense * turn(i)).is_nan() || sense * turn(i) <= 0.0)
        {
            return Err(Error::NotMonotone { index: index + 1 });
        }
        for start in (0..elements.len() - 1).step_by(stride) {
            let end = (start + stride).min(elements.len() - 1);
            let inner = &elements[start + 1..end];
            let arc = fit_arc(&elements[start], &elements[end], inner.iter())?;
            front.error = inner
                .iter()
                .map(|e| miss(&arc, e))
                .fold(front.error, f64::max);
            front.pieces.push(FrontPiece {
                shape: PieceShape::Arc(arc),
                departures: Departures::at(0.0),
            });
        }
        Ok(front)
    }

    fn element(&self, ray: &Ray) -> Element {
        // In the unit plane the slowness is the unit normal.
        let normal = (self.from_unit * ray.slowness).normalize();
        let point = self.to_unit * ray.point;
        Element {
            normal,
            point: point - ray.time * normal,
            support: normal.dot(point) - ray.time,
            departure: ray.time,
            turning: normal.perp_dot(self.from_unit * ray.slowness_change),
            place: ray.point,
        }
    }
}

impl<R: Fn(f64) -> Result<Ray, Error>> Fitter<'_, R> {
    fn element(&self, parameter: f64) -> Result<Element, Error> {
        Ok(self.shape.element(&(self.ray)(parameter)?))
    }

    /// Elements at equal steps of a range, its ends included.
    fn elements(&self, start: f64, end: f64) -> Result<Vec<Element>, Error> {
        let steps = 2 * self.tolerance.samples.max(1) + 2;
        (0..=steps)
            .map(|i| self.element(start + (end - start) * i as f64 / steps as f64))
            .collect()
    }

    /// Fits a range with one piece, or its parts: at an inflection of the front, or halves.
    fn range(&mut self, start: f64, end: f64, depth: u32) -> Result<(), Error> {
        match self.elements(start, end) {
            Ok(elements) => self.fit([start, end], &elements, depth),
            Err(error) => self.give_up_or_halve([start, end], depth, f64::INFINITY, Some(error)),
        }
    }

    fn fit(
        &mut self,
        [start, end]: [f64; 2],
        elements: &[Element],
        depth: u32,
    ) -> Result<(), Error> {
        let (shape, error) = fit_shape(elements);
        if error <= self.tolerance.time
            && let Some(departures) = departures(&shape, elements, self.tolerance.time)
        {
            self.current.pieces.push(FrontPiece { shape, departures });
            self.current.error = self.current.error.max(error);
            self.arcs += 1;
            return Ok(());
        }
        let ends = [elements[0], elements[elements.len() - 1]];
        if self.may_halve(depth)
            && ends[0].turning * ends[1].turning < 0.0
            && let Some(inflection) = self.inflection([start, end], ends[0].turning)
        {
            self.range(start, inflection, depth + 1)?;
            return self.range(inflection, end, depth + 1);
        }
        if !self.may_halve(depth) {
            return self.give_up_or_halve([start, end], depth, error, None);
        }
        // The halves have every second element already.
        let middle = elements.len() / 2;
        let center = 0.5 * (start + end);
        for (part, range) in [
            (&elements[..=middle], [start, center]),
            (&elements[middle..], [center, end]),
        ] {
            match self.refined(part, range) {
                Ok(finer) => self.fit(range, &finer, depth + 1)?,
                Err(error) => {
                    self.give_up_or_halve(range, depth + 1, f64::INFINITY, Some(error))?;
                }
            }
        }
        Ok(())
    }

    /// The elements of a range with one more between each two.
    fn refined(&self, coarse: &[Element], [start, end]: [f64; 2]) -> Result<Vec<Element>, Error> {
        let steps = 2 * (coarse.len() - 1);
        let mut fine = Vec::with_capacity(steps + 1);
        for (i, element) in coarse.iter().enumerate() {
            if i > 0 {
                let share = (2 * i - 1) as f64 / steps as f64;
                fine.push(self.element(start + (end - start) * share)?);
            }
            fine.push(*element);
        }
        Ok(fine)
    }

    /// Where the normal turns back, by halving; none if it jumps.
    fn inflection(&self, [mut low, mut high]: [f64; 2], turning_at_low: f64) -> Option<f64> {
        let (start, end) = (low, high);
        while high - low > INFLECTION.max(f64::EPSILON * high.abs()) {
            let middle = 0.5 * (low + high);
            if self.element(middle).ok()?.turning * turning_at_low > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        (low > start && low < end).then_some(low)
    }

    /// Halves a range without rays, or leaves it out and cuts the front, if it is a sliver.
    fn give_up_or_halve(
        &mut self,
        [start, end]: [f64; 2],
        depth: u32,
        error: f64,
        reason: Option<Error>,
    ) -> Result<(), Error> {
        if self.may_halve(depth) {
            let middle = 0.5 * (start + end);
            self.range(start, middle, depth + 1)?;
            return self.range(middle, end, depth + 1);
        }
        let reason = reason.unwrap_or(Error::NotConverged {
            start,
            end,
            excess: error / self.tolerance.time,
            depth,
        });
        self.slivers += 1;
        if self.slivers > MOST_SLIVERS {
            return Err(reason);
        }
        let cut = |parameter: f64| Cut {
            parameter,
            place: self.element(parameter).map_or(DVec2::NAN, |e| e.place),
            reason: reason.clone(),
        };
        let (before, behind) = (cut(start), cut(end));
        self.flush(Some(before));
        self.current.cuts[0] = Some(Box::new(behind));
        Ok(())
    }

    /// Ends the current front.
    fn flush(&mut self, cut: Option<Cut>) {
        let mut front = std::mem::replace(&mut self.current, self.shape.clone());
        if !front.pieces.is_empty() {
            front.cuts[1] = cut.map(Box::new);
            self.fronts.push(front);
        }
    }
}

/// The departures along a piece, through five of the elements; none if they miss the others. They tell what exists of a
/// front at a time, not where it is: a thousandth of their range is enough.
fn departures(shape: &PieceShape, elements: &[Element], tolerance: f64) -> Option<Departures> {
    let last = elements.len() - 1;
    let parameter = |index: usize| match shape {
        _ if index == 0 => 0.0,
        _ if index == last => 1.0,
        PieceShape::Arc(arc) => arc
            .parameter_of_normal(elements[index].normal)
            .unwrap_or(f64::NAN),
        PieceShape::Straight { ends, .. } => {
            let along = ends[1] - ends[0];
            along.dot(elements[index].point - ends[0]) / along.length_squared()
        }
    };
    let times = elements.iter().map(|element| element.departure);
    let earliest = times.clone().fold(f64::INFINITY, f64::min);
    let latest = times.fold(f64::NEG_INFINITY, f64::max);
    let allowed = (DEPARTURE * (latest - earliest)).max(DEPARTURE.recip() * tolerance);
    if latest - earliest <= allowed {
        return Some(Departures::at(earliest));
    }
    let ray = |i: usize| {
        let index = i * last / 4;
        (parameter(index), elements[index].departure)
    };
    let departures = Departures::through([ray(0), ray(1), ray(2), ray(3), ray(4)]);
    let others = (0..=last).filter(|index| (index * 4) % last != 0);
    let error = others
        .map(|index| (departures.jet(parameter(index)).0 - elements[index].departure).abs())
        .fold(0.0, f64::max);
    (error <= allowed).then_some(departures)
}

/// The best single piece through elements and its largest error on the inner ones; infinite if there is none.
fn fit_shape(elements: &[Element]) -> (PieceShape, f64) {
    let (first, last) = (&elements[0], &elements[elements.len() - 1]);
    let inner = &elements[1..elements.len() - 1];
    let straight = PieceShape::Straight {
        ends: [first.point, last.point],
        normal: first.normal,
    };
    // The sines of the turns between neighbours; a turn of more than a right angle is none that could be fitted.
    let turns = || {
        elements.windows(2).map(|pair| {
            (
                pair[0].normal.perp_dot(pair[1].normal),
                pair[0].normal.dot(pair[1].normal),
            )
        })
    };
    if turns().all(|(sine, cosine)| sine.abs() <= STRAIGHT && cosine > 0.0) {
        let error = inner
            .iter()
            .chain([last])
            .map(|e| (e.support - first.support).abs())
            .fold(0.0, f64::max);
        return (straight, error);
    }
    let sense = turns().next().map_or(0.0, |(sine, _)| sine);
    let monotone = turns().all(|(sine, cosine)| sine * sense > 0.0 && cosine > 0.0);
    let turning: f64 = turns().map(|(sine, _)| sine).sum();
    if !monotone || turning.abs() > MOST_TURNING {
        return (straight, f64::INFINITY);
    }
    // Every second inner ray is fitted, the others judge.
    match fit_arc(first, last, inner.iter().skip(1).step_by(2)) {
        Ok(arc) => (
            PieceShape::Arc(arc),
            inner.iter().map(|e| miss(&arc, e)).fold(0.0, f64::max),
        ),
        Err(_) => (straight, f64::INFINITY),
    }
}

/// The G1 arc between two elements whose free parameter fits the inner ones.
fn fit_arc<'e>(
    start: &Element,
    end: &Element,
    inner: impl Iterator<Item = &'e Element>,
) -> Result<TQuartic, Error> {
    let ends = G1Ends::new(
        LineElement::new(start.point, start.normal)?,
        LineElement::new(end.point, end.normal)?,
    )?;
    let fitted = ends.fit_alpha(inner.map(|element| (element.normal, element.support)));
    // Behind a plane mirror all is one point, and the parameter has no influence but that of rounding.
    let alpha = if fitted > 0.0 && fitted.is_finite() {
        fitted
    } else {
        1.0
    };
    Ok(ends.arc(alpha)?)
}

/// The distance between the tangents of an arc and of the front with one normal.
fn miss(arc: &TQuartic, element: &Element) -> f64 {
    arc.parameter_of_normal(element.normal)
        .map_or(f64::INFINITY, |t| (arc.support(t) - element.support).abs())
}
