//! Why a question had no answer.

/// Why a polynomial, a curve or a bound was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The list of coefficients is empty.
    #[error("a polynomial needs at least one coefficient")]
    NoCoefficients,
    /// A number of the input, or one that overflowed, is NaN or infinite.
    #[error("number {index} is not finite: {value}")]
    NotFinite {
        /// Its place in the list that was given or computed.
        index: usize,
        /// The offending number.
        value: f64,
    },
    /// The interval is empty, reversed, or wider than `f64` can measure.
    #[error("an interval needs a < b with b - a finite, not [{a}, {b}]")]
    EmptyInterval {
        /// Left end.
        a: f64,
        /// Right end.
        b: f64,
    },
    /// Every coefficient is zero, so every parameter is a root.
    #[error("the polynomial is identically zero: every parameter is a root")]
    IdenticallyZero,
    /// A constant has no polar derivative.
    #[error("a polar derivative needs degree at least 1")]
    PolarOfConstant,
    /// A bound holds only for poles in the closed interval.
    #[error("pole {index} lies outside the interval, where the bound does not hold")]
    PoleOutside {
        /// Which of the poles.
        index: usize,
    },
    /// A chain uses up one degree per pole.
    #[error("{poles} poles are more than the degree {degree}")]
    TooManyPoles {
        /// Number of poles given.
        poles: usize,
        /// Formal degree of the polynomial.
        degree: usize,
    },
    /// The corollary needs `k <= l <= n`.
    #[error("need k <= l <= degree, not k = {k}, l = {l}, degree {degree}")]
    IndexOrder {
        /// First index of the middle part.
        k: usize,
        /// Last index of the middle part.
        l: usize,
        /// Formal degree of the polynomial.
        degree: usize,
    },
    /// A blossom of degree `n` has exactly `n` arguments.
    #[error("the blossom has {degree} arguments, not {arguments}")]
    BlossomArity {
        /// Formal degree of the polynomial.
        degree: usize,
        /// Number of arguments given.
        arguments: usize,
    },
    /// The list of control points is empty.
    #[error("a curve needs at least one control point")]
    NoControlPoints,
    /// Every control point needs one weight.
    #[error("{weights} weights for {points} control points")]
    WeightCount {
        /// Number of control points.
        points: usize,
        /// Number of weights.
        weights: usize,
    },
    /// The polygon of a rational curve bounds it only if all weights are positive.
    #[error("weight {index} is {weight}; weights must be positive")]
    WeightNotPositive {
        /// Its place in the list.
        index: usize,
        /// The offending weight.
        weight: f64,
    },
    /// `0 x + 0 y + c = 0` is not a line (and `0 x + 0 y + 0 z + d = 0` not a plane).
    #[error("the normal of the line or plane is zero")]
    ZeroNormal,
    /// A circle needs a positive radius.
    #[error("a circle needs a positive radius, not {radius}")]
    Radius {
        /// The offending radius.
        radius: f64,
    },
    /// Infinitely many meetings: the curve lies on the other one.
    #[error("the curve lies on the line or curve it was to meet")]
    LiesOn,
    /// Derived polynomials are formed up to degree 120.
    #[error("the derived polynomial has degree {degree}, more than {limit}")]
    DegreeTooHigh {
        /// Degree of the derived polynomial.
        degree: usize,
        /// The largest that is formed.
        limit: usize,
    },
}
