//! Why an operation had no answer.

use glam::DVec2;

/// Every reason for which this crate refuses, with the numbers that explain it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate, speed, time or angle is NaN or infinite.
    #[error("{what} is not finite")]
    NonFinite {
        /// The quantity that was given.
        what: &'static str,
    },
    /// A speed or semi-axis that is not positive.
    #[error("the speed of a medium is {speed}; it must be positive")]
    BadSpeed {
        /// The value that was given.
        speed: f64,
    },
    /// A direction without length.
    #[error("{what} has length zero: no direction")]
    ZeroDirection {
        /// The quantity that was given.
        what: &'static str,
    },
    /// A shape that is no interface: a circle without radius, a conic without points, a curve without extent.
    #[error("interface {interface} is degenerate: {reason}")]
    BadInterface {
        /// Its number in the model (0 for an interface on its own).
        interface: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Two interfaces of a model cross.
    #[error("interfaces {first} and {second} cross at ({}, {})", place.x, place.y)]
    InterfacesCross {
        /// The upper one.
        first: usize,
        /// The lower one.
        second: usize,
        /// A common point.
        place: DVec2,
    },
    /// The layers and interfaces of a model do not match.
    #[error("{media} media need {} interfaces between them, not {interfaces}", media.saturating_sub(1))]
    LayerCount {
        /// Number of media.
        media: usize,
        /// Number of interfaces.
        interfaces: usize,
    },
    /// A ray that does not meet the interface that it was sent to inside the model's box.
    #[error("the ray from ({}, {}) does not meet the interface in the model", from.x, from.y)]
    Miss {
        /// Where the ray started.
        from: DVec2,
    },
    /// A ray that meets another interface before the one that it was sent to.
    #[error("the ray from ({}, {}) meets interface {interface} first", from.x, from.y)]
    Blocked {
        /// Where the ray started.
        from: DVec2,
        /// The interface in its way.
        interface: usize,
    },
    /// Rays next to each other that are far apart behind an interface: the one grazes it, the other meets it farther on.
    #[error("the fan is torn at parameter {parameter}: a ray grazes an interface")]
    Torn {
        /// The source's parameter.
        parameter: f64,
    },
    /// No transmitted ray: the tangential slowness is larger than any slowness of the medium behind.
    #[error("total internal reflection at ({}, {}): the tangential slowness is {tangential_slowness}", at.x, at.y)]
    TotalReflection {
        /// Where the ray hits.
        at: DVec2,
        /// The conserved component of the slowness along the interface.
        tangential_slowness: f64,
    },
    /// A ray code that asks for what the model cannot do.
    #[error("step {step} of the code: {reason}")]
    BadCode {
        /// Position in the code.
        step: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// The part of a front between two rays could not be approximated: the tolerance is too small, or the front is not smooth.
    #[error(
        "the front between parameters {start} and {end} misses the tolerance by a factor {excess} after {depth} halvings"
    )]
    NotConverged {
        /// Launch parameter at the start.
        start: f64,
        /// Launch parameter at the end.
        end: f64,
        /// Error over tolerance.
        excess: f64,
        /// Number of halvings.
        depth: u32,
    },
    /// A tolerance, count or depth outside its range.
    #[error("{what} is {value}; it must be positive and finite")]
    OutOfRange {
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// Samples of a front that do not turn one way, or do not turn at all.
    #[error("the normals do not turn monotonically at sample {index}: split the front there")]
    NotMonotone {
        /// The first sample that turns back or repeats its normal.
        index: usize,
    },
    /// A reason that has been written and read again: its words.
    #[error("{message}")]
    Recorded {
        /// The words.
        message: String,
    },
    /// An operation on curves was refused.
    #[error(transparent)]
    Curve(#[from] ph_curves::Error),
    /// An operation on control points was refused.
    #[error(transparent)]
    Bezier(#[from] bezier_mass::Error),
    /// Root finding was refused.
    #[error(transparent)]
    Roots(#[from] variation::Error),
}

impl Error {
    /// The same error with the number of the interface that is at fault in a model, for the shapes that were built on their
    /// own.
    #[must_use]
    pub fn at_interface(self, number: usize) -> Self {
        match self {
            Self::BadInterface { reason, .. } => Self::BadInterface {
                interface: number,
                reason,
            },
            Self::NonFinite { .. } => Self::BadInterface {
                interface: number,
                reason: "a coordinate is not finite",
            },
            Self::ZeroDirection { .. } => Self::BadInterface {
                interface: number,
                reason: "its direction has length zero",
            },
            Self::OutOfRange { .. } => Self::BadInterface {
                interface: number,
                reason: "its pieces have no width",
            },
            other => other,
        }
    }
}
