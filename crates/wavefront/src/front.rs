//! Fronts: G1 splines of class-3 arcs that stay exact at all times and through every caustic.

use bezier_mass::bernstein;
use glam::{DMat2, DVec2};
use ph_curves::{G1Ends, LineElement, TCubic, TQuartic};

use crate::{Error, Medium, Ray};

/// A front in a homogeneous medium, stored as what it would have been at time zero, in the plane in which the medium's
/// indicatrix is the unit circle.
///
/// The support function there is the eikonal: the wave with normal N passes X at the time `<N, X> - p(N)`. Propagation adds
/// the time to the support, a translation of the Bézier lines; a focus is no singularity of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    medium: Medium,
    layer: usize,
    to_unit: DMat2,
    from_unit: DMat2,
    pieces: Vec<FrontPiece>,
    error: f64,
}

/// A piece of a front, at time zero in the unit plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontPiece {
    /// Its shape.
    pub shape: PieceShape,
    /// The times at which the rays at its start, middle and end set out: nothing of it exists before.
    pub departures: [f64; 3],
}

/// The shape of a piece of a front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PieceShape {
    /// An arc of class 3.
    Arc(TQuartic),
    /// A straight piece between two points, with its normal.
    Straight {
        /// The ends.
        ends: [DVec2; 2],
        /// The unit normal.
        normal: DVec2,
    },
}

/// A cusp of a front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cusp {
    /// The piece on which it lies.
    pub piece: usize,
    /// The parameter on the piece.
    pub parameter: f64,
    /// The place.
    pub point: DVec2,
}

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
const MOST_TURNING: f64 = 2.5;
/// A piece whose normal turns less than this (radians) is straight: the bulge is below rounding.
const STRAIGHT: f64 = 1e-12;
/// Halvings of the source's parameter before a piece is given up.
const MOST_DEPTH: u32 = 40;

/// A ray's data for the fit: unit normal, point and support at time zero in the unit plane, and the departure.
#[derive(Clone, Copy, Debug)]
struct Element {
    normal: DVec2,
    point: DVec2,
    support: f64,
    departure: f64,
}

impl Front {
    /// Fits a front to rays given as a function of a parameter, between consecutive `breaks`: one arc between two rays, its
    /// free parameter by linear least squares over inner rays, halved until other inner rays agree.
    ///
    /// # Errors
    /// [`Error::BadSpeed`] in a medium without a unit plane (a rational indicatrix that is no ellipse);
    /// [`Error::OutOfRange`] for a tolerance that is not positive; [`Error::NotConverged`]; the errors of the rays.
    pub fn fit(
        medium: &Medium,
        layer: usize,
        breaks: &[f64],
        ray: impl Fn(f64) -> Result<Ray, Error>,
        tolerance: FrontTolerance,
    ) -> Result<Self, Error> {
        if !(tolerance.time > 0.0 && tolerance.time.is_finite()) {
            return Err(Error::OutOfRange {
                what: "the tolerance of a front",
                value: tolerance.time,
            });
        }
        let mut front = Self::empty(medium, layer)?;
        let element = |t: f64| front.element(&ray(t)?);
        let mut pieces = Vec::new();
        let mut error: f64 = 0.0;
        for range in breaks.windows(2) {
            fit_range(
                [range[0], range[1]],
                &element,
                tolerance,
                0,
                &mut pieces,
                &mut error,
            )?;
        }
        front.pieces = pieces;
        front.error = error;
        Ok(front)
    }

    /// The front of a point source at `position` that radiates between two normal angles (of the unit plane, radians).
    ///
    /// # Errors
    /// [`Error::BadSpeed`] in a medium without a unit plane; [`Error::Curve`] for an empty range.
    pub fn from_point(
        medium: &Medium,
        layer: usize,
        position: DVec2,
        angles: [f64; 2],
    ) -> Result<Self, Error> {
        let mut front = Self::empty(medium, layer)?;
        let count = ((angles[1] - angles[0]).abs() / (0.5 * MOST_TURNING))
            .ceil()
            .max(1.0);
        let angle = |i: f64| angles[0] + (angles[1] - angles[0]) * i / count;
        for i in 0..count as usize {
            let (start, end) = (
                DVec2::from_angle(angle(i as f64)),
                DVec2::from_angle(angle(i as f64 + 1.0)),
            );
            let arc = TQuartic::point_fan(front.to_unit * position, start, end)?;
            front.pieces.push(FrontPiece {
                shape: PieceShape::Arc(arc),
                departures: [0.0; 3],
            });
        }
        Ok(front)
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
            let (arc, inner) =
                fit_arc(&elements[start], &elements[end], &elements[start + 1..end])?;
            front.error = elements[start + 1..end]
                .iter()
                .map(|e| miss(&arc, e))
                .fold(front.error, f64::max);
            debug_assert!(inner <= end);
            front.pieces.push(FrontPiece {
                shape: PieceShape::Arc(arc),
                departures: [0.0; 3],
            });
        }
        Ok(front)
    }

    fn empty(medium: &Medium, layer: usize) -> Result<Self, Error> {
        let (Some(to_unit), Some(from_unit)) = (medium.unit_plane(), medium.from_unit_plane())
        else {
            return Err(Error::BadSpeed { speed: f64::NAN });
        };
        Ok(Self {
            medium: medium.clone(),
            layer,
            to_unit,
            from_unit,
            pieces: Vec::new(),
            error: 0.0,
        })
    }

    fn element(&self, ray: &Ray) -> Result<Element, Error> {
        let normal = (self.from_unit * ray.slowness).normalize();
        let point = self.to_unit * ray.point;
        let support = normal.dot(point) - ray.time;
        Ok(Element {
            normal,
            point: point - ray.time * normal,
            support,
            departure: ray.time,
        })
    }

    /// The medium.
    #[must_use]
    pub fn medium(&self) -> &Medium {
        &self.medium
    }

    /// The number of the medium in its model.
    #[must_use]
    pub fn layer(&self) -> usize {
        self.layer
    }

    /// The pieces, in the unit plane at time zero.
    #[must_use]
    pub fn pieces(&self) -> &[FrontPiece] {
        &self.pieces
    }

    /// The largest error found when the front was fitted, a time.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The point at `t` of a piece at the given time.
    #[must_use]
    pub fn point(&self, piece: usize, t: f64, time: f64) -> DVec2 {
        let unit = match &self.pieces[piece].shape {
            PieceShape::Arc(arc) => arc.point(t) + time * arc.normal(t),
            PieceShape::Straight { ends, normal } => ends[0].lerp(ends[1], t) + time * *normal,
        };
        self.from_unit * unit
    }

    /// The front at a time as polylines, one for each stretch that exists then: pieces whose rays have set out.
    #[must_use]
    pub fn snapshot(&self, time: f64, steps: usize) -> Vec<Vec<DVec2>> {
        let mut stretches = vec![Vec::new()];
        for (index, piece) in self.pieces.iter().enumerate() {
            for i in 0..=steps.max(1) {
                let t = i as f64 / steps.max(1) as f64;
                if piece.departure(t) <= time {
                    if let Some(stretch) = stretches.last_mut() {
                        stretch.push(self.point(index, t, time));
                    }
                } else if stretches.last().is_some_and(|stretch| !stretch.is_empty()) {
                    stretches.push(Vec::new());
                }
            }
        }
        stretches.retain(|stretch| stretch.len() > 1);
        stretches
    }

    /// The front at a time as class-3 arcs in the unit plane: the Bézier lines translated by the time.
    pub fn propagated(&self, time: f64) -> impl Iterator<Item = TQuartic> + '_ {
        self.pieces
            .iter()
            .filter_map(move |piece| match piece.shape {
                PieceShape::Arc(arc) => Some(arc.offset(time)),
                PieceShape::Straight { .. } => None,
            })
    }

    /// The cusps of the front at a time, at most one a piece since the radius of a class-3 arc is monotone.
    #[must_use]
    pub fn cusps(&self, time: f64) -> Vec<Cusp> {
        let cusp = |(piece, shape): (usize, &FrontPiece)| match shape.shape {
            PieceShape::Arc(arc) => {
                let parameter = arc.offset(time).cusp()?;
                Some(Cusp {
                    piece,
                    parameter,
                    point: self.point(piece, parameter, time),
                })
            }
            PieceShape::Straight { .. } => None,
        };
        self.pieces.iter().enumerate().filter_map(cusp).collect()
    }

    /// The caustic: the evolutes of the arcs, Tschirnhausen cubics in the unit plane, as control points in the plane itself
    /// (affine images of such cubics). Each comes with the times at its two ends.
    pub fn caustic(&self) -> impl Iterator<Item = ([DVec2; 4], [f64; 2])> + '_ {
        self.pieces.iter().filter_map(|piece| match piece.shape {
            PieceShape::Arc(arc) => {
                let cubic: TCubic = arc.evolute();
                Some((
                    cubic.points().map(|p| self.from_unit * p),
                    arc.end_radii().map(|radius| -radius),
                ))
            }
            PieceShape::Straight { .. } => None,
        })
    }

    /// The arrival times at a point with the unit normals (in the unit plane) that bring them, by increasing time; those of
    /// rays that have not set out by then are left out.
    ///
    /// On an arc the times `(<n, X> - g) / q` are stationary at the zeros of a quartic, found with certainty.
    ///
    /// # Errors
    /// [`Error::NonFinite`]; [`Error::Roots`] if the point lies on all lines of an arc (a focus).
    pub fn arrivals(&self, point: DVec2) -> Result<Vec<(f64, DVec2)>, Error> {
        if !point.is_finite() {
            return Err(Error::NonFinite { what: "a receiver" });
        }
        let unit = self.to_unit * point;
        let mut found: Vec<(f64, DVec2)> = Vec::new();
        for piece in &self.pieces {
            match piece.shape {
                PieceShape::Arc(arc) => {
                    for t in stationary_parameters(&arc, unit)? {
                        let time = arc.normal(t).dot(unit) - arc.support(t);
                        if time >= piece.departure(t) {
                            found.push((time, arc.normal(t)));
                        }
                    }
                }
                PieceShape::Straight { ends, normal } => {
                    let along = ends[1] - ends[0];
                    let t = along.dot(unit - ends[0]) / along.length_squared();
                    let time = normal.dot(unit - ends[0]);
                    if (0.0..=1.0).contains(&t) && time >= piece.departure(t) {
                        found.push((time, normal));
                    }
                }
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        // A ray through a joint belongs to both arcs.
        found.dedup_by(|a, b| (a.0 - b.0).abs() <= 1e-12 * a.0.abs() && a.1.distance(b.1) <= 1e-6);
        Ok(found)
    }

    /// The largest angle between the normals of neighbouring pieces, and the largest gap between them at time zero: the G1
    /// contact, measured.
    #[must_use]
    pub fn joint_errors(&self) -> (f64, f64) {
        let end = |piece: &FrontPiece, t: f64| match piece.shape {
            PieceShape::Arc(arc) => (arc.point(t), arc.normal(t)),
            PieceShape::Straight { ends, normal } => (ends[0].lerp(ends[1], t), normal),
        };
        self.pieces
            .windows(2)
            .fold((0.0, 0.0), |(angle, gap): (f64, f64), pair| {
                let ((p, n), (q, m)) = (end(&pair[0], 1.0), end(&pair[1], 0.0));
                (angle.max(n.angle_to(m).abs()), gap.max(p.distance(q)))
            })
    }

    /// The ray at a parameter in `[0, 1]` over all pieces, as it sets out.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a front without pieces.
    pub fn ray(&self, parameter: f64) -> Result<Ray, Error> {
        let count = self.pieces.len();
        let scaled = parameter * count as f64;
        let index = (scaled.max(0.0) as usize).min(count.saturating_sub(1));
        let piece = self.pieces.get(index).ok_or(Error::OutOfRange {
            what: "the number of pieces of a front",
            value: 0.0,
        })?;
        let (t, rate) = (scaled - index as f64, count as f64);
        let time = piece.departure(t);
        let (point, normal, point_rate, turning) = match piece.shape {
            PieceShape::Arc(arc) => {
                let contact = arc.contact(t);
                let (w0, w1) = arc.spinors();
                let turning = 2.0 * w0.perp_dot(w1) / (w0 * (1.0 - t) + w1 * t).length_squared();
                (
                    contact.point,
                    contact.normal,
                    contact.radius * turning * contact.normal.perp(),
                    turning,
                )
            }
            PieceShape::Straight { ends, normal } => {
                (ends[0].lerp(ends[1], t), normal, ends[1] - ends[0], 0.0)
            }
        };
        let normal_rate = turning * normal.perp();
        let departure_rate = piece.departure_rate(t);
        Ok(Ray {
            point: self.from_unit * (point + time * normal),
            slowness: self.to_unit * normal,
            time,
            point_change: rate
                * (self.from_unit * (point_rate + time * normal_rate + departure_rate * normal)),
            slowness_change: rate * (self.to_unit * normal_rate),
            time_change: rate * departure_rate,
        })
    }
}

impl FrontPiece {
    /// The departure at `t`: the parabola through the three known ones.
    fn departure(&self, t: f64) -> f64 {
        let [start, middle, end] = self.departures;
        bernstein::evaluate(&[start, 2.0 * middle - 0.5 * (start + end), end], t)
    }

    fn departure_rate(&self, t: f64) -> f64 {
        let [start, middle, end] = self.departures;
        bernstein::evaluate(
            &bernstein::derivative(&[start, 2.0 * middle - 0.5 * (start + end), end]),
            t,
        )
    }
}

/// Fits `[start, end]` with one piece, or its halves.
fn fit_range(
    [start, end]: [f64; 2],
    element: &impl Fn(f64) -> Result<Element, Error>,
    tolerance: FrontTolerance,
    depth: u32,
    pieces: &mut Vec<FrontPiece>,
    error: &mut f64,
) -> Result<(), Error> {
    let count = 2 * tolerance.samples.max(1) + 1;
    let inner: Vec<Element> = (1..=count)
        .map(|i| element(start + (end - start) * i as f64 / (count + 1) as f64))
        .collect::<Result<_, _>>()?;
    let ends = [element(start)?, element(end)?];
    let departures = [
        ends[0].departure,
        inner[count / 2].departure,
        ends[1].departure,
    ];
    let (shape, found) = fit_shape(&ends, &inner);
    if found <= tolerance.time {
        pieces.push(FrontPiece { shape, departures });
        *error = error.max(found);
        return Ok(());
    }
    if depth >= MOST_DEPTH {
        return Err(Error::NotConverged {
            start,
            end,
            excess: found / tolerance.time,
            depth,
        });
    }
    let middle = 0.5 * (start + end);
    fit_range(
        [start, middle],
        element,
        tolerance,
        depth + 1,
        pieces,
        error,
    )?;
    fit_range([middle, end], element, tolerance, depth + 1, pieces, error)
}

/// The best single piece and its largest error on the inner rays; infinite if there is none.
fn fit_shape(ends: &[Element; 2], inner: &[Element]) -> (PieceShape, f64) {
    let straight = PieceShape::Straight {
        ends: ends.map(|end| end.point),
        normal: ends[0].normal,
    };
    let normals = || {
        [&ends[0]]
            .into_iter()
            .chain(inner)
            .chain([&ends[1]])
            .map(|element| element.normal)
    };
    let turns: Vec<f64> = normals()
        .zip(normals().skip(1))
        .map(|(n, m)| n.angle_to(m))
        .collect();
    let turning: f64 = turns.iter().sum();
    if turns.iter().all(|turn| turn.abs() <= STRAIGHT) {
        let support = ends[0].support;
        let error = inner
            .iter()
            .map(|e| (e.support - support).abs())
            .fold((ends[1].support - support).abs(), f64::max);
        return (straight, error);
    }
    let monotone = turns.iter().all(|turn| turn * turning > 0.0);
    if !monotone || turning.abs() > MOST_TURNING {
        return (straight, f64::INFINITY);
    }
    // Every second inner ray is fitted, the others judge.
    let fitted: Vec<Element> = inner.iter().skip(1).step_by(2).copied().collect();
    match fit_arc(&ends[0], &ends[1], &fitted) {
        Ok((arc, _)) => (
            PieceShape::Arc(arc),
            inner.iter().map(|e| miss(&arc, e)).fold(0.0, f64::max),
        ),
        Err(_) => (straight, f64::INFINITY),
    }
}

/// The G1 arc between two elements whose free parameter fits the inner ones; also how many they were.
fn fit_arc(start: &Element, end: &Element, inner: &[Element]) -> Result<(TQuartic, usize), Error> {
    let ends = G1Ends::new(
        LineElement::new(start.point, start.normal)?,
        LineElement::new(end.point, end.normal)?,
    )?;
    let alpha = ends.fit_alpha(
        inner
            .iter()
            .map(|element| (element.normal, element.support)),
    );
    Ok((ends.arc(alpha)?, inner.len()))
}

/// The distance between the tangents of an arc and of the front with one normal.
fn miss(arc: &TQuartic, element: &Element) -> f64 {
    arc.parameter_of_normal(element.normal)
        .map_or(f64::INFINITY, |t| (arc.support(t) - element.support).abs())
}

/// The parameters at which the eikonal of an arc is stationary at a point: zeros of `h' q - h q'`, `h = <n, X> - g`.
fn stationary_parameters(arc: &TQuartic, point: DVec2) -> Result<Vec<f64>, Error> {
    let heights: Vec<f64> = arc
        .control_normals()
        .iter()
        .zip(arc.coefficients())
        .map(|(n, g)| n.dot(point) - g)
        .collect();
    let (w0, w1) = arc.spinors();
    let length = [w0.length_squared(), w0.dot(w1), w1.length_squared()];
    let rising = bernstein::product(&bernstein::derivative(&heights), &length);
    let falling = bernstein::product(&heights, &bernstein::derivative(&length));
    let condition: Vec<f64> = rising.iter().zip(&falling).map(|(a, b)| a - b).collect();
    if condition
        .iter()
        .all(|c| c.abs() <= 1e-14 * length[0].max(length[2]))
    {
        // All rays of a focus pass: any of them tells the time.
        return Ok(vec![0.5]);
    }
    Ok(variation::roots(&condition)?
        .iter()
        .map(variation::Root::value)
        .collect())
}
