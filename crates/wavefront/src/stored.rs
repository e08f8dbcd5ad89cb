//! The forms in which checked values are written, with the feature `serde`: what is read goes through the constructors.

use bezier_mass::BezierCurve;
use glam::{DMat2, DMat3, DVec2, DVec3};
use ph_curves::{DualCurve, DualIndicatrix, TQuartic};
use serde::{Deserialize, Serialize};

use crate::departure::Departures;
use crate::{
    Cut, DualSurface, Error, FrontPiece, Interface, Medium, Mirror, Model, PieceShape,
    SampledSurface, Source, SpacePoint,
};

/// A medium.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoredMedium {
    Isotropic { speed: f64 },
    Elliptical { semi_axes: [f64; 2], angle: f64 },
    Rational { arcs: Vec<DualCurve> },
}

impl TryFrom<StoredMedium> for Medium {
    type Error = Error;

    fn try_from(stored: StoredMedium) -> Result<Self, Error> {
        match stored {
            StoredMedium::Isotropic { speed } => Self::isotropic(speed),
            StoredMedium::Elliptical {
                semi_axes: [a, b],
                angle,
            } => Self::elliptical(a, b, angle),
            StoredMedium::Rational { arcs } => Ok(Self::rational(DualIndicatrix::try_new(arcs)?)),
        }
    }
}

/// An interface.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoredInterface {
    Line {
        point: DVec2,
        direction: DVec2,
    },
    /// `(x - centre)ᵀ form (x - centre) + 2 linear (x - centre) + constant = 0`.
    Conic {
        centre: DVec2,
        form: DMat2,
        linear: DVec2,
        constant: f64,
    },
    Curve {
        pieces: Vec<BezierCurve<DVec2>>,
    },
}

impl TryFrom<StoredInterface> for Interface {
    type Error = Error;

    fn try_from(stored: StoredInterface) -> Result<Self, Error> {
        match stored {
            StoredInterface::Line { point, direction } => Self::line(point, direction),
            StoredInterface::Conic {
                centre,
                form,
                linear,
                constant,
            } => Self::conic_about(centre, form, linear, constant),
            StoredInterface::Curve { pieces } => Self::curve(pieces),
        }
    }
}

/// A model.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredModel {
    low: DVec2,
    high: DVec2,
    media: Vec<Medium>,
    interfaces: Vec<Interface>,
}

impl From<Model> for StoredModel {
    fn from(model: Model) -> Self {
        let [low, high] = model.corners();
        Self {
            low,
            high,
            media: model.media().to_vec(),
            interfaces: model.interfaces().to_vec(),
        }
    }
}

impl TryFrom<StoredModel> for Model {
    type Error = Error;

    fn try_from(stored: StoredModel) -> Result<Self, Error> {
        Self::try_new(stored.low, stored.high, stored.media, stored.interfaces)
    }
}

/// A source.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoredSource {
    Point {
        position: DVec2,
        angles: [f64; 2],
    },
    Plane {
        ends: [DVec2; 2],
        towards: DVec2,
    },
    Reflector {
        curve: BezierCurve<DVec2>,
        left: bool,
    },
    Front(crate::Front),
}

impl From<Source> for StoredSource {
    fn from(source: Source) -> Self {
        match source {
            Source::Point { position, angles } => Self::Point { position, angles },
            Source::Plane { ends, towards } => Self::Plane { ends, towards },
            Source::Reflector { curve, left } => Self::Reflector { curve, left },
            Source::Front(front) => Self::Front(front),
        }
    }
}

impl TryFrom<StoredSource> for Source {
    type Error = Error;

    fn try_from(stored: StoredSource) -> Result<Self, Error> {
        let source = match stored {
            StoredSource::Point { position, angles } => Self::Point { position, angles },
            StoredSource::Plane { ends, towards } => Self::Plane { ends, towards },
            StoredSource::Reflector { curve, left } => Self::Reflector { curve, left },
            StoredSource::Front(front) => Self::Front(front),
        };
        source.check()?;
        Ok(source)
    }
}

/// The shape of a piece of a front.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum StoredShape {
    Arc(TQuartic),
    Straight { ends: [DVec2; 2], normal: DVec2 },
}

impl From<PieceShape> for StoredShape {
    fn from(shape: PieceShape) -> Self {
        match shape {
            PieceShape::Arc(arc) => Self::Arc(arc),
            PieceShape::Straight { ends, normal } => Self::Straight { ends, normal },
        }
    }
}

/// A normal that is read has the length one to this.
const UNIT: f64 = 1e-12;

impl TryFrom<StoredShape> for PieceShape {
    type Error = Error;

    fn try_from(stored: StoredShape) -> Result<Self, Error> {
        match stored {
            StoredShape::Arc(arc) => Ok(Self::Arc(arc)),
            StoredShape::Straight { ends, normal } => {
                if !ends.iter().all(|end| end.is_finite()) {
                    return Err(Error::NonFinite {
                        what: "an end of a straight piece of a front",
                    });
                }
                check_unit(normal.length())?;
                Ok(Self::Straight { ends, normal })
            }
        }
    }
}

fn check_unit(length: f64) -> Result<(), Error> {
    let excess = (length - 1.0).abs();
    if excess <= UNIT {
        return Ok(());
    }
    Err(Error::OutOfRange {
        what: "the length of a unit normal",
        value: length,
    })
}

/// Departure times: the nodes of their quartic and its divided differences.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredDepartures {
    pub(crate) nodes: [f64; 5],
    pub(crate) differences: [f64; 5],
}

impl TryFrom<StoredDepartures> for Departures {
    type Error = Error;

    fn try_from(stored: StoredDepartures) -> Result<Self, Error> {
        let mut values = stored.nodes.iter().chain(&stored.differences);
        if values.all(|value| value.is_finite()) {
            Ok(Self::from_stored(stored.nodes, stored.differences))
        } else {
            Err(Error::NonFinite {
                what: "a departure time of a front",
            })
        }
    }
}

/// A front.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredFront {
    medium: Medium,
    layer: usize,
    pieces: Vec<FrontPiece>,
    error: f64,
    cuts: [Option<Cut>; 2],
}

impl From<crate::Front> for StoredFront {
    fn from(front: crate::Front) -> Self {
        Self {
            medium: front.medium().clone(),
            layer: front.layer(),
            cuts: front.cuts().map(Option::<&Cut>::cloned),
            error: front.error(),
            pieces: front.pieces,
        }
    }
}

impl TryFrom<StoredFront> for crate::Front {
    type Error = Error;

    fn try_from(stored: StoredFront) -> Result<Self, Error> {
        if !(stored.error >= 0.0 && stored.error.is_finite()) {
            return Err(Error::OutOfRange {
                what: "the error of a front",
                value: stored.error,
            });
        }
        let mut front = Self::empty(&stored.medium, stored.layer)?;
        front.pieces = stored.pieces;
        front.error = stored.error;
        front.cuts = stored.cuts.map(|cut| cut.map(Box::new));
        Ok(front)
    }
}

/// A cut.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredCut {
    parameter: f64,
    /// None where no ray is left to have a place.
    place: Option<DVec2>,
    reason: StoredReason,
}

/// The reasons for which rays end; others are written in words.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum StoredReason {
    Miss {
        from: DVec2,
    },
    Blocked {
        from: DVec2,
        interface: usize,
    },
    Torn {
        parameter: f64,
    },
    TotalReflection {
        at: DVec2,
        tangential_slowness: f64,
    },
    NotConverged {
        start: f64,
        end: f64,
        depth: u32,
        /// None if it is infinite.
        excess: Option<f64>,
    },
    Other {
        message: String,
    },
}

impl From<Cut> for StoredCut {
    fn from(cut: Cut) -> Self {
        let reason = match cut.reason {
            Error::Miss { from } if from.is_finite() => StoredReason::Miss { from },
            Error::Blocked { from, interface } => StoredReason::Blocked { from, interface },
            Error::Torn { parameter } => StoredReason::Torn { parameter },
            Error::TotalReflection {
                at,
                tangential_slowness,
            } => StoredReason::TotalReflection {
                at,
                tangential_slowness,
            },
            Error::NotConverged {
                start,
                end,
                excess,
                depth,
            } => StoredReason::NotConverged {
                start,
                end,
                depth,
                excess: excess.is_finite().then_some(excess),
            },
            other => StoredReason::Other {
                message: other.to_string(),
            },
        };
        Self {
            parameter: cut.parameter,
            place: cut.place.is_finite().then_some(cut.place),
            reason,
        }
    }
}

impl From<StoredCut> for Cut {
    fn from(stored: StoredCut) -> Self {
        let reason = match stored.reason {
            StoredReason::Miss { from } => Error::Miss { from },
            StoredReason::Blocked { from, interface } => Error::Blocked { from, interface },
            StoredReason::Torn { parameter } => Error::Torn { parameter },
            StoredReason::TotalReflection {
                at,
                tangential_slowness,
            } => Error::TotalReflection {
                at,
                tangential_slowness,
            },
            StoredReason::NotConverged {
                start,
                end,
                depth,
                excess,
            } => Error::NotConverged {
                start,
                end,
                depth,
                excess: excess.unwrap_or(f64::INFINITY),
            },
            StoredReason::Other { message } => Error::Recorded { message },
        };
        Self {
            parameter: stored.parameter,
            place: stored.place.unwrap_or(DVec2::NAN),
            reason,
        }
    }
}

/// A dual surface.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredSurface {
    pub(crate) centre: DVec3,
    pub(crate) half_axes: DMat3,
    pub(crate) distance: f64,
}

impl TryFrom<StoredSurface> for DualSurface {
    type Error = Error;

    fn try_from(stored: StoredSurface) -> Result<Self, Error> {
        let axes = stored.half_axes;
        if axes == DMat3::ZERO {
            return Self::sphere(stored.centre, stored.distance);
        }
        if !stored.distance.is_finite() {
            return Err(Error::NonFinite {
                what: "the distance of an offset",
            });
        }
        let surface = Self::ellipsoid(stored.centre, [axes.x_axis, axes.y_axis, axes.z_axis])?;
        Ok(surface.offset(stored.distance))
    }
}

/// A mirror in space.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredMirror {
    pub(crate) form: DMat3,
    pub(crate) linear: DVec3,
    pub(crate) constant: f64,
}

impl TryFrom<StoredMirror> for Mirror {
    type Error = Error;

    fn try_from(stored: StoredMirror) -> Result<Self, Error> {
        Self::quadric(stored.form, stored.linear, stored.constant)
    }
}

/// A grid of rays.
#[derive(Serialize, Deserialize)]
pub(crate) struct StoredGrid {
    columns: usize,
    rays: Vec<SpacePoint>,
}

impl From<SampledSurface> for StoredGrid {
    fn from(surface: SampledSurface) -> Self {
        Self {
            columns: surface.columns(),
            rays: surface.rays().to_vec(),
        }
    }
}

impl TryFrom<StoredGrid> for SampledSurface {
    type Error = Error;

    fn try_from(stored: StoredGrid) -> Result<Self, Error> {
        for ray in &stored.rays {
            if !ray.point.is_finite() {
                return Err(Error::NonFinite {
                    what: "a point of a front",
                });
            }
            check_unit(ray.normal.length())?;
        }
        Self::from_rays(stored.columns, stored.rays)
    }
}
