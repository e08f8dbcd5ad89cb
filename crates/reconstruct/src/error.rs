//! Why something could not be reconstructed.

use crate::conditions::Violation;
use crate::sensor::ReadingFault;

/// Why a curve or a surface could not be reconstructed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Too few data.
    #[error("{got} {what} are too few, at least {needed} are needed")]
    TooFew {
        /// What is missing.
        what: &'static str,
        /// How many are needed.
        needed: usize,
        /// How many there are.
        got: usize,
    },
    /// Two lists that belong together differ in length.
    #[error("{got} {what} do not match the {expected} expected")]
    LengthMismatch {
        /// What was counted.
        what: &'static str,
        /// How many there should be.
        expected: usize,
        /// How many there are.
        got: usize,
    },
    /// A number is NaN or infinite.
    #[error("{what} {index} is not a finite number")]
    NonFinite {
        /// What it is.
        what: &'static str,
        /// Its place in the list.
        index: usize,
    },
    /// Arc lengths (or parameters) do not increase strictly.
    #[error("arc lengths must increase strictly, but number {index} is {next} after {previous}")]
    NotIncreasing {
        /// The place of the offending value.
        index: usize,
        /// The value before.
        previous: f64,
        /// The value.
        next: f64,
    },
    /// A periodic function does not return to its first value.
    #[error("the periodic data do not close, the gap is {gap:e}")]
    NotPeriodic {
        /// The largest coordinate of the gap.
        gap: f64,
    },
    /// A value outside its range.
    #[error("{what} {value} is outside [{}, {}]", range[0], range[1])]
    OutOfRange {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The range allowed.
        range: [f64; 2],
    },
    /// A sensor's reading cannot be true.
    #[error("sensor {sensor}: {fault}")]
    Reading {
        /// The sensor's place in the layout.
        sensor: usize,
        /// What is wrong with it.
        fault: ReadingFault,
    },
    /// Gravity and the magnetic field are parallel at a sensor, so the direction about them is unknown.
    #[error("gravity and magnetic field are parallel at arc length {s} (sine {sine:e})")]
    ParallelFields {
        /// Where on the ribbon.
        s: f64,
        /// The sine of the angle between the two.
        sine: f64,
    },
    /// Neighbouring angles differ by half a turn, which could be either way round.
    #[error(
        "angle {index} differs by half a turn ({jump}) from the one before, which is ambiguous"
    )]
    AmbiguousTurn {
        /// The second of the two.
        index: usize,
        /// The difference, radians.
        jump: f64,
    },
    /// Neighbouring tangents are antipodal.
    #[error(
        "antipodal neighbouring tangents at {index} (cosine {cosine}): the interpolation is undefined"
    )]
    AntipodalTangents {
        /// The second of the two.
        index: usize,
        /// Their scalar product.
        cosine: f64,
    },
    /// A vector that must have a direction is zero.
    #[error("{what} {index} is the zero vector")]
    ZeroVector {
        /// What it is.
        what: &'static str,
        /// Its place in the list.
        index: usize,
    },
    /// The spline of unit tangents passes near zero, where it has no direction: too few sensors for the turns.
    #[error(
        "the spline of the tangents has length {length} at arc length {s}: the data turn too fast"
    )]
    TangentLost {
        /// Where on the ribbon.
        s: f64,
        /// The length of the spline there; it should be near one.
        length: f64,
    },
    /// Sensors are not equally spaced, as the spline on the sphere needs.
    #[error("the spacing {spacing} after sensor {index} differs from the mean {expected}")]
    NotUniform {
        /// The sensor before the interval.
        index: usize,
        /// The spacing found.
        spacing: f64,
        /// The mean spacing.
        expected: f64,
    },
    /// The accuracy asked for was not reached between two arc lengths.
    #[error(
        "the integral over [{start}, {end}] was not reached to the accuracy asked for, error {error:e}"
    )]
    NotIntegrable {
        /// Start of the interval.
        start: f64,
        /// End of the interval.
        end: f64,
        /// The error estimate reached.
        error: f64,
    },
    /// An iteration did not converge.
    #[error("{what} did not converge in {steps} steps")]
    NoConvergence {
        /// What was iterated.
        what: &'static str,
        /// How many steps were made.
        steps: usize,
    },
    /// Numbers read back from storage contradict each other.
    #[error("the stored {what} do not belong to the rest of the data")]
    Stored {
        /// What does not fit.
        what: &'static str,
    },
    /// Something this crate does not do.
    #[error("{what} are not available")]
    Unsupported {
        /// What was asked for.
        what: &'static str,
    },
    /// A ribbon of a network is not tied to the first one by crossings.
    #[error("ribbon {ribbon} is not connected to the first one by crossings")]
    Disconnected {
        /// The ribbon's place in the network.
        ribbon: usize,
    },
    /// The boundary curves cannot bound a surface as geodesics.
    #[error("the boundary curves violate {} of the conditions, the first: {}", .0.len(), first(.0))]
    Conditions(
        /// Everything that was found wrong.
        Vec<Violation>,
    ),
    /// A curve has no principal normal and no normal was given.
    #[error(
        "curve {side} has an inflection at parameter {t}, where its osculating plane is undefined"
    )]
    Inflection {
        /// The curve's place among the boundaries.
        side: usize,
        /// Its parameter.
        t: f64,
    },
    /// The surface has no tangent plane at a boundary point: the derivative across the boundary becomes
    /// tangent to it.
    #[error(
        "irregular boundary: across curve {side} the surface folds at parameter {t} (component {across:e})"
    )]
    IrregularBoundary {
        /// The curve's place among the boundaries.
        side: usize,
        /// Its parameter.
        t: f64,
        /// The component of the derivative across the boundary, relative to its largest on that side.
        across: f64,
    },
    /// A quadratic energy has no unique minimum.
    #[error("the energy is degenerate: its matrix is not positive definite")]
    DegenerateEnergy,
    /// Data at a corner contradict each other.
    #[error("corner {}{}: {what} ({value:e})", corner[0], corner[1])]
    CornerData {
        /// The corner, as `[i, j]` for the point at `u = i`, `v = j`.
        corner: [usize; 2],
        /// What contradicts.
        what: &'static str,
        /// By how much.
        value: f64,
    },
    /// The torsion wanted at an end has not the sign that the control points allow.
    #[error(
        "torsion sign incompatible with the control points at end {end}: {wanted} wanted, {natural} with unit weights"
    )]
    TorsionSign {
        /// 0 for the start of the curve, 1 for its end.
        end: usize,
        /// The torsion wanted.
        wanted: f64,
        /// The torsion with unit weights; positive weights do not change its sign.
        natural: f64,
    },
    /// Control points of a curve or patch were refused.
    #[error(transparent)]
    Bezier(#[from] bezier_mass::Error),
}

fn first(violations: &[Violation]) -> String {
    violations
        .first()
        .map(ToString::to_string)
        .unwrap_or_default()
}
