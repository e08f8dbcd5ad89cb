//! Pieces put together: joints, and corners as fans of normals.

use glam::DVec2;

use crate::course::{End, Interval, Turning};
use crate::fit::Fit;
use crate::piece::Segment;
use crate::{Approximated, ArcSpline, Error, Joint, Piece, PlacedArc, TQuartic};

/// Largest turning of a fan of normals at a corner, which must stay below pi.
const FAN: f64 = 1.6;

/// A spline under construction.
#[derive(Debug, Default)]
pub(crate) struct Assembly {
    /// Rounding of the largest coordinate: shorter segments are none.
    rounding: f64,
    pieces: Vec<Piece>,
    joints: Vec<Joint>,
    sources: Vec<[f64; 2]>,
    error: f64,
    corners: usize,
    /// The end of what was built so far, and whether the last piece has its curvature.
    last: Option<(End, bool)>,
    /// The start of the first piece, likewise.
    first: Option<(End, bool)>,
    /// The curve's own tangent where the construction stands; a bridge arrives there with another one.
    tangent_at_end: Option<End>,
}

impl Assembly {
    /// No pieces yet, with room for `room` of them.
    pub(crate) fn new(room: usize, rounding: f64) -> Self {
        Self {
            rounding,
            pieces: Vec::with_capacity(room),
            joints: Vec::with_capacity(room),
            sources: Vec::with_capacity(room),
            ..Self::default()
        }
    }

    /// Number of pieces so far.
    pub(crate) fn len(&self) -> usize {
        self.pieces.len()
    }

    /// Adds the segment between two ends.
    pub(crate) fn straight(&mut self, start: End, end: End) -> Result<(), Error> {
        if start.point == end.point {
            return Ok(());
        }
        let segment = Segment::new(start.point, end.point)?;
        let at = |end: End| End {
            normal: segment.normal,
            curvature: 0.0,
            ..end
        };
        let joint = self.join(&at(start), true)?;
        let source = [start, end].map(|end| end.parameter());
        self.push(Piece::Segment(segment), source, joint);
        self.last = Some((at(end), true));
        self.tangent_at_end = Some(at(end));
        Ok(())
    }

    /// Adds the pieces of an accepted fit with its error.
    #[inline]
    pub(crate) fn accept(
        &mut self,
        interval: &Interval,
        fit: &Fit,
        error: f64,
    ) -> Result<(), Error> {
        let Interval { start, end } = interval;
        let at = start.point;
        match *fit {
            Fit::Pair([first, second]) => {
                let source = [start, end].map(End::parameter);
                self.curved(interval, Piece::Arc(PlacedArc::new(at, first)), true)?;
                self.push(Piece::Arc(PlacedArc::new(at, second)), source, Joint::G2);
            }
            Fit::Single { arc, matched } => {
                self.curved(interval, Piece::Arc(PlacedArc::new(at, arc)), matched)?;
            }
            Fit::Wide(arc) => self.curved(interval, Piece::Wide(PlacedArc::new(at, arc)), true)?,
            Fit::Wider(arc) => {
                self.curved(interval, Piece::Wider(PlacedArc::new(at, arc)), true)?
            }
            Fit::Inflected(arc) => self.curved(interval, Piece::Inflected(arc), true)?,
            Fit::Bridge if (end.point - at).length() > 4.0 * self.rounding => {
                self.straight(*start, *end)?;
            }
            Fit::Bridge => {
                if self.last.is_none() {
                    self.join(start, false)?;
                    self.last = Some((*start, false));
                }
            }
        }
        self.error = self.error.max(error);
        self.tangent_at_end = Some(*end);
        Ok(())
    }

    /// Adds a piece with the tangents of an interval's ends, and with their curvatures if it is `matched`.
    #[inline]
    fn curved(&mut self, interval: &Interval, piece: Piece, matched: bool) -> Result<(), Error> {
        let Interval { start, end } = interval;
        let joint = self.join(start, matched)?;
        self.push(piece, [start, end].map(End::parameter), joint);
        self.last = Some((*end, matched));
        Ok(())
    }

    /// Adds a piece and the joint before it.
    #[inline]
    fn push(&mut self, piece: Piece, source: [f64; 2], joint: Joint) {
        if !self.pieces.is_empty() {
            self.joints.push(joint);
        }
        self.pieces.push(piece);
        self.sources.push(source);
    }

    /// Turns the normal to that of a piece that starts at `start`, by a corner if it differs, and returns the kind of
    /// the joint before that piece.
    #[inline]
    fn join(&mut self, start: &End, matched: bool) -> Result<Joint, Error> {
        match self.last {
            Some((last, last_matched)) => {
                self.turn(&last, start, start.parameter(), matched && last_matched)
            }
            None => {
                self.first = Some((*start, matched));
                Ok(Joint::G1)
            }
        }
    }

    /// Adds the fan of normals of a corner, if there is one, and returns the kind of the joint after it.
    #[inline]
    fn turn(
        &mut self,
        last: &End,
        start: &End,
        parameter: f64,
        matched: bool,
    ) -> Result<Joint, Error> {
        if !last.is_tangent_to(start) {
            self.corner(last, start, parameter)?;
            return Ok(Joint::G1);
        }
        Ok(if matched && last.has_curvature_of(start) {
            Joint::G2
        } else {
            Joint::G1
        })
    }

    /// Adds the fan of normals of a corner.
    fn corner(&mut self, last: &End, start: &End, parameter: f64) -> Result<(), Error> {
        let Turning { cosine, sine } = last.turning_to(start);
        let mut angle = sine.atan2(cosine);
        if cosine < 0.0 && sine.abs() <= 1e-6 {
            // A reversal: the cap lies outside of the tip, against the sense in which the curve turns.
            angle = std::f64::consts::PI.copysign(-last.curvature);
        }
        let parts = (angle.abs() / FAN).ceil();
        let mut normal = last.normal;
        for k in 1..=parts as usize {
            let next = if k as f64 == parts {
                start.normal
            } else {
                DVec2::from_angle(angle * k as f64 / parts).rotate(last.normal)
            };
            let fan = TQuartic::point_fan(DVec2::ZERO, normal, next)?;
            let joint = if k == 1 { Joint::G1 } else { Joint::G2 };
            self.push(
                Piece::Arc(PlacedArc::new(start.point, fan)),
                [parameter; 2],
                joint,
            );
            normal = next;
        }
        self.corners += 1;
        Ok(())
    }

    /// The spline of what was added, closed by a last joint if the curve is closed; `parameter` is that of its end.
    pub(crate) fn finish(mut self, closed: bool, parameter: f64) -> Result<Approximated, Error> {
        let (Some((first, first_matched)), Some((last, last_matched))) = (self.first, self.last)
        else {
            return Err(Error::SinglePoint);
        };
        if closed {
            let joint = self.turn(&last, &first, parameter, first_matched && last_matched)?;
            self.joints.push(joint);
        } else if let Some(end) = self.tangent_at_end {
            self.turn(&last, &end, parameter, false)?;
        }
        if self.pieces.is_empty() {
            return Err(Error::SinglePoint);
        }
        let g1_joints = self
            .joints
            .iter()
            .filter(|joint| **joint == Joint::G1)
            .count();
        Ok(Approximated {
            spline: ArcSpline {
                pieces: self.pieces,
                joints: self.joints,
                closed,
            },
            error: self.error,
            sources: self.sources,
            g1_joints,
            corners: self.corners,
        })
    }
}
