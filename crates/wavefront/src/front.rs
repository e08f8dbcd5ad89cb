//! Fronts: G1 splines of class-3 arcs that stay exact at all times and through every caustic.

use bezier_mass::bernstein;
use glam::{DMat2, DVec2};
use ph_curves::{TCubic, TQuartic};

use crate::departure::Departures;
use crate::fit::MOST_TURNING;
use crate::{Cut, Error, Medium, Ray};

/// A front in a homogeneous medium, stored as what it would have been at time zero, in the plane in which the medium's
/// indicatrix is the unit circle.
///
/// The support function there is the eikonal: the wave with normal N passes X at the time `<N, X> - p(N)`. Propagation adds
/// the time to the support, a translation of the Bézier lines; a focus is no singularity of it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredFront",
        into = "crate::stored::StoredFront"
    )
)]
pub struct Front {
    medium: Medium,
    layer: usize,
    pub(crate) to_unit: DMat2,
    pub(crate) from_unit: DMat2,
    pub(crate) pieces: Vec<FrontPiece>,
    pub(crate) error: f64,
    pub(crate) cuts: [Option<Box<Cut>>; 2],
}

/// A piece of a front, at time zero in the unit plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FrontPiece {
    /// Its shape.
    pub shape: PieceShape,
    pub(crate) departures: Departures,
}

/// The shape of a piece of a front.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "crate::stored::StoredShape",
        into = "crate::stored::StoredShape"
    )
)]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cusp {
    /// The piece on which it lies.
    pub piece: usize,
    /// The parameter on the piece.
    pub parameter: f64,
    /// The place.
    pub point: DVec2,
}

impl Front {
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
                departures: Departures::at(0.0),
            });
        }
        Ok(front)
    }

    pub(crate) fn empty(medium: &Medium, layer: usize) -> Result<Self, Error> {
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
            cuts: [None, None],
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

    /// Why the front starts and ends where it does; none where its source does.
    #[must_use]
    pub fn cuts(&self) -> [Option<&Cut>; 2] {
        self.cuts.each_ref().map(Option::as_deref)
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
                (
                    angle.max(n.perp_dot(m).atan2(n.dot(m)).abs()),
                    gap.max(p.distance(q)),
                )
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
        let (time, departure_rate) = piece.departures.jet(t);
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
    /// The time at which the ray at `t` sets out from its interface: it does not exist before. Interpolated between rays of
    /// the piece.
    #[must_use]
    pub fn departure(&self, t: f64) -> f64 {
        self.departures.jet(t).0
    }
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
