//! Why an operation had no answer.

/// Why an operation of this crate had no answer. Every variant carries the numbers that explain it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate, weight, knot or parameter is NaN or infinite.
    #[error("a {what} is not finite")]
    NonFinite {
        /// What the number was for.
        what: &'static str,
    },
    /// A list has the wrong number of entries.
    #[error("{what}: got {found}, need {needed}")]
    WrongCount {
        /// What is counted.
        what: &'static str,
        /// How many were given.
        found: usize,
        /// How many are needed (the smallest number where more are allowed).
        needed: usize,
    },
    /// The weight vanishes at this parameter: the curve or surface is at infinity there and has no position.
    #[error("the weight vanishes at parameter {t}: the value is a vector, not a point")]
    AtInfinity {
        /// The parameter (the first one, for a surface).
        t: f64,
    },
    /// A homography maps everything to one parameter, or the ends of a sub-arc coincide.
    #[error("singular homography: its determinant {determinant} is zero to rounding")]
    SingularHomography {
        /// The determinant `ad - bc`, with the pairs `(a, c)` and `(b, d)` scaled to size one.
        determinant: f64,
    },
    /// A projective parameter was given as `0 : 0`.
    #[error("0 : 0 is not a parameter")]
    ZeroParameter,
    /// The two end points of an arc are the same point.
    #[error("coincident end points: they are {distance} apart")]
    CoincidentEnds {
        /// Their distance.
        distance: f64,
    },
    /// The end points of a circular arc have different distances from the centre.
    #[error(
        "end points not on a common circle about the centre: their radii are {start} and {end}"
    )]
    NotOnCommonCircle {
        /// Distance of the start point from the centre.
        start: f64,
        /// Distance of the end point from the centre.
        end: f64,
    },
    /// An end weight that must be positive is not.
    #[error("end weights must be positive: got {start} and {end}")]
    NonPositiveEndWeight {
        /// Weight of the start point.
        start: f64,
        /// Weight of the end point.
        end: f64,
    },
    /// A hyperbola in standard form needs a middle weight above one.
    #[error("middle weight must exceed one: got {weight}")]
    MiddleWeightNotAboveOne {
        /// The middle weight that was given.
        weight: f64,
    },
    /// The conic is a parabola, which has no centre.
    #[error(
        "the conic is a parabola and has no centre: its discriminant {discriminant} is zero to rounding"
    )]
    NoCentre {
        /// The discriminant `w1^2 - w0 w2`.
        discriminant: f64,
    },
    /// A spline of this degree is not supported.
    #[error("degree {degree} is above {largest}, the largest for splines")]
    DegreeTooHigh {
        /// The degree that was given.
        degree: usize,
        /// The largest one that is accepted.
        largest: usize,
    },
    /// The knots do not increase.
    #[error("knot {index} is {knot}, below the one before it, {before}")]
    KnotsDecrease {
        /// Index of the smaller knot.
        index: usize,
        /// The knot before it.
        before: f64,
        /// The knot.
        knot: f64,
    },
    /// A knot is repeated so often that the spline falls apart there, or has no first or last span.
    #[error("the knot {knot} occurs {multiplicity} times, too often for degree {degree}")]
    KnotMultiplicity {
        /// The knot.
        knot: f64,
        /// How often it occurs.
        multiplicity: usize,
        /// The degree of the spline.
        degree: usize,
    },
    /// A knot to insert lies outside the domain of the spline.
    #[error("{t} is outside the domain [{start}, {end}] of the spline")]
    OutsideDomain {
        /// The parameter that was given.
        t: f64,
        /// Start of the domain.
        start: f64,
        /// End of the domain.
        end: f64,
    },
    /// An approximation did not become as accurate as asked.
    #[error("an accuracy of {accuracy} was asked for and {error} was reached")]
    AccuracyNotReached {
        /// The accuracy that was asked for.
        accuracy: f64,
        /// The certified error that was reached.
        error: f64,
    },
}
