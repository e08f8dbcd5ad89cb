//! Why an operation had no answer.

/// Every reason for which this crate refuses.
///
/// The numbers inside are the ones that explain the refusal.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate, parameter or distance is NaN or infinite.
    #[error("{what} is not finite")]
    NonFinite {
        /// The quantity that was given.
        what: &'static str,
    },
    /// A line coordinate vector is zero, so it stands for no line.
    #[error("control vector {index} is zero: no line")]
    ZeroLine {
        /// Position of the vector in the control polygon.
        index: usize,
    },
    /// Class 1 is a pencil of lines through one point and has no curve.
    #[error("class {class} is a pencil of lines through one point: not a curve")]
    Pencil {
        /// The class that was given.
        class: usize,
    },
    /// The number of Farin lines is not the number of Bézier lines less one.
    #[error("{lines} Bézier lines need {} Farin lines, not {farin}", lines.saturating_sub(1))]
    FarinCount {
        /// Number of Bézier lines.
        lines: usize,
        /// Number of Farin lines.
        farin: usize,
    },
    /// The number of joints of a spline is not that of its pieces less one, or that of its pieces if it is closed.
    #[error("{joints} joints do not fit {pieces} pieces of a spline that is {}", if *closed { "closed" } else { "open" })]
    JointCount {
        /// Number of pieces.
        pieces: usize,
        /// Number of joints.
        joints: usize,
        /// Whether the spline is closed.
        closed: bool,
    },
    /// Two consecutive Bézier lines coincide, or a Farin line coincides with one of them.
    #[error("Bézier lines {index} and {} coincide with each other or with their Farin line: the weights are undefined", index + 1)]
    CoincidentLines {
        /// Position of the first of the two lines.
        index: usize,
    },
    /// The point at this parameter is not finite.
    #[error(
        "the point at parameter {t} is not finite: its tangent is the line at infinity, or stationary"
    )]
    AtInfinity {
        /// Parameter of the point.
        t: f64,
    },
    /// The two normals coincide, so there is no arc of tangents between them.
    #[error(
        "the normals turn by {turning} rad: no turning, hence no dual arc (keep a straight segment)"
    )]
    NoTurning {
        /// Turning angle in radians.
        turning: f64,
    },
    /// The turning of one arc must stay below a half turn.
    #[error("the normals turn by {turning} rad: an arc turns by less than pi, split it first")]
    TurningTooLarge {
        /// Turning angle in radians.
        turning: f64,
    },
    /// The shape parameter of a class-3 arc is positive.
    #[error("the shape parameter alpha is {alpha}; it must be positive")]
    NonPositiveAlpha {
        /// The value that was given.
        alpha: f64,
    },
    /// The denominator f vanishes between the two parameters, so the curve runs to infinity.
    #[error(
        "the denominator f is {f0} and {f1} at the ends of the interval: the curve passes through infinity between them"
    )]
    Pole {
        /// Value of f at the start.
        f0: f64,
        /// Value of f at the end.
        f1: f64,
    },
    /// Three points on a line, or coincident points, where a triangle is needed.
    #[error("the triangle is degenerate: its area is {area}")]
    DegenerateTriangle {
        /// Signed area of the triangle.
        area: f64,
    },
    /// The four control points do not satisfy Theorem 1.
    #[error(
        "the cubic is not a Tschirnhausen cubic: D1^2 and D0 D2 differ by {relative_defect} of their size"
    )]
    NotTschirnhausen {
        /// `|D1^2 - D0 D2|` over the larger of the two moduli.
        relative_defect: f64,
    },
    /// A normal or direction has no length.
    #[error("{what} has length zero: no direction")]
    ZeroDirection {
        /// The quantity that was given.
        what: &'static str,
    },
    /// The curvature at an end is zero or infinite; a class-3 arc has neither.
    #[error(
        "the end radii are {r0} and {r1}: a class-3 arc has no inflection and no infinite curvature at its ends"
    )]
    NoCurvatureElement {
        /// Signed radius of curvature at the start.
        r0: f64,
        /// Signed radius of curvature at the end.
        r1: f64,
    },
    /// Equal radii are met by a circular arc only, and these elements are not on one circle.
    #[error(
        "both radii are {radius}: only a circular arc has monotone curvature between them, and the elements are not on one circle"
    )]
    EqualRadii {
        /// The common signed radius.
        radius: f64,
    },
    /// No convex arc of monotone curvature joins the two curvature elements.
    #[error(
        "not admissible: |Q0 Q1| = {centre_distance}, |R0 - R1| = {evolute_length}, legs {lambda0} and {lambda1}; needed: positive legs and |Q0 Q1| < |R0 - R1| < sum of legs"
    )]
    NotAdmissible {
        /// Distance of the two centres of curvature.
        centre_distance: f64,
        /// Difference of the two radii.
        evolute_length: f64,
        /// Leg of the evolute triangle at the larger radius.
        lambda0: f64,
        /// Leg of the evolute triangle at the smaller radius.
        lambda1: f64,
    },
    /// The tension beta lies strictly between 0 and 1.
    #[error("the tension beta is {beta}; it must lie strictly between 0 and 1")]
    TensionOutOfRange {
        /// The value that was given.
        beta: f64,
    },
    /// No class-3 arc of one-signed radius meets these ends.
    #[error("no regular class-3 arc: the tangent legs are {leg0} and {leg1}")]
    NoRegularArc {
        /// Signed leg at the start.
        leg0: f64,
        /// Signed leg at the end.
        leg1: f64,
    },
    /// A tolerance is not a positive finite number.
    #[error("the tolerance is {tolerance}; it must be positive and finite")]
    BadTolerance {
        /// The value that was given.
        tolerance: f64,
    },
    /// The tolerance is below what double precision resolves at this size.
    #[error(
        "the tolerance {tolerance} is below the resolution {resolution} of coordinates of this size"
    )]
    ToleranceTooSmall {
        /// The value that was given.
        tolerance: f64,
        /// The smallest tolerance that can be kept.
        resolution: f64,
    },
    /// The curve is a single point, so it has no direction to offset along.
    #[error("the curve is a single point: it has no tangent")]
    SinglePoint,
    /// Too few control points, knots or samples.
    #[error("{given} {what} given, at least {needed} needed")]
    TooFew {
        /// What there is too little of.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are needed.
        needed: usize,
    },
    /// More of something than can be handled.
    #[error("{given} {what} given, at most {most} are possible")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many were given.
        given: usize,
        /// How many are possible.
        most: usize,
    },
    /// The parameter lies outside the domain.
    #[error("parameter {value} lies outside [{start}, {end}]")]
    OutsideDomain {
        /// The parameter that was given.
        value: f64,
        /// Start of the domain.
        start: f64,
        /// End of the domain.
        end: f64,
    },
    /// The proof that an approximation is within a tolerance did not succeed on a part of the curve.
    #[error(
        "between {start} and {end} of the parameter the curve is not certain to be within the tolerance: the bound is {bound}"
    )]
    NotCertified {
        /// Start of the part in the curve's parameter.
        start: f64,
        /// End of the part; equal to the start where the spline lacks the normal there.
        end: f64,
        /// The bound of the distance on this part.
        bound: f64,
    },
    /// The curve does not tell bounds of its derivatives.
    #[error("span {span} of the curve has no enclosure: implement PlaneCurve::enclosure")]
    NoEnclosure {
        /// The span.
        span: usize,
    },
    /// A subdivision reached its limit before the tolerance was met.
    #[error(
        "the piece [{start}, {end}] still misses the tolerance by a factor {excess} after {attempts} attempts"
    )]
    NotConverged {
        /// Start of the piece in the curve's parameter.
        start: f64,
        /// End of the piece.
        end: f64,
        /// Error of the piece over the tolerance.
        excess: f64,
        /// Number of attempts at shorter and shorter pieces.
        attempts: u32,
    },
    /// The preimage does not satisfy the condition of quintics with a rational rotation-minimising frame.
    #[error(
        "no rational rotation-minimising frame: the condition is missed by {relative_residual} of the speed"
    )]
    NotRationalFrame {
        /// Length of the residual over the largest squared norm of the preimage.
        relative_residual: f64,
    },
    /// The equations of an interpolant were solved from every start without success.
    #[error("no {what} was found for these data")]
    NoInterpolant {
        /// The kind of curve.
        what: &'static str,
    },
    /// A hodograph whose speed is not a polynomial.
    #[error(
        "not a Pythagorean hodograph: its square root misses by {relative_residual} of its size"
    )]
    NotPythagorean {
        /// Largest difference of coefficients over the largest coefficient.
        relative_residual: f64,
    },
    /// A Bernstein coefficient of the common factor of a hodograph is negative.
    #[error(
        "the common factor of the hodograph has the coefficient {coefficient}: the speed may be negative"
    )]
    NegativeSpeed {
        /// The coefficient.
        coefficient: f64,
    },
    /// A speed that is negative somewhere.
    #[error("the speed at parameter {t} is {speed}: a length cannot decrease")]
    RunsBackwards {
        /// Parameter of the point.
        t: f64,
        /// The speed there.
        speed: f64,
    },
    /// A span does not start where its predecessor ends.
    #[error("span {} starts {distance} away from the end of span {index}", index + 1)]
    Gap {
        /// The span before the gap.
        index: usize,
        /// Distance of the two points.
        distance: f64,
    },
    /// A feed rate or a period that is not positive.
    #[error("the feed rate {feed:?} with period {period} does not move forward")]
    BadFeed {
        /// The feed rate.
        feed: crate::FeedRate,
        /// The time between two points.
        period: f64,
    },
    /// An operation on control points was refused.
    #[error(transparent)]
    Bezier(#[from] bezier_mass::Error),
    /// A polygon with an even number of vertices has no rosette of constant width.
    #[error("the polygon has {vertices} vertices: constant width needs an odd number")]
    EvenPolygon {
        /// Number of vertices.
        vertices: usize,
    },
    /// A polygon that turns both ways.
    #[error(
        "the polygon turns by {turn} rad at vertex {vertex}, against its turn at vertex 0, or not at all"
    )]
    NotLocallyConvex {
        /// The vertex.
        vertex: usize,
        /// Signed turning angle there.
        turn: f64,
    },
    /// Condition (1.8): a side of the polygon that no Tschirnhausen cubic of the chain can touch.
    #[error(
        "half the turning of the cubic along side {edge} would be {half_turning}: it must be positive (for a triangle: all angles acute)"
    )]
    NotCovered {
        /// The side.
        edge: usize,
        /// The alternating sum of interior angles.
        half_turning: f64,
    },
    /// An involute of constant width that is not convex.
    #[error("the width is {width}; a regular rosette needs more than {minimum}")]
    WidthTooSmall {
        /// The width that was given.
        width: f64,
        /// The bound.
        minimum: f64,
    },
    /// A polygon so thin that the radii of its involutes are lost in rounding.
    #[error(
        "the polygon is too thin: along side {edge} rounding leaves the radii of a rosette of width {width} uncertain by {uncertainty}"
    )]
    UncertainRadius {
        /// The side.
        edge: usize,
        /// A bound of the rounding error of the radii.
        uncertainty: f64,
        /// The width.
        width: f64,
    },
    /// An arc of a closed curve turns right, or its radius of curvature is not positive throughout.
    #[error("arc {index} is not convex and regular: its end radii are {} and {}", radii[0], radii[1])]
    NotRegular {
        /// The arc.
        index: usize,
        /// Signed radii of curvature at its ends (a zero may lie between positive ones).
        radii: [f64; 2],
    },
    /// A radius of curvature that an oval of this constant width cannot have.
    #[error(
        "the radius of curvature is {radius}; on an oval of constant width {width} it lies between 0 and the width"
    )]
    BadRadius {
        /// The radius that was given.
        radius: f64,
        /// The width.
        width: f64,
    },
    /// The lift of a cam and its half turn do not add up to the width of its frame.
    #[error(
        "the lift at {angle} rad and half a turn on add up to the width but for {defect}: no cam of constant width moves so"
    )]
    NotAntisymmetric {
        /// The angle with the largest defect found.
        angle: f64,
        /// Sum of the two lifts minus the width.
        defect: f64,
    },
    /// A lift that no convex cam produces.
    #[error(
        "at {angle} rad the lift plus its second derivative is {radius}: the cam would need that radius of curvature, which must be positive"
    )]
    NotConvex {
        /// The angle with the smallest radius found.
        angle: f64,
        /// The radius of curvature there.
        radius: f64,
    },
    /// An indicatrix that is not centrally symmetric.
    #[error(
        "the indicatrix is not centrally symmetric: supports in opposite directions differ by {defect}"
    )]
    NotSymmetric {
        /// The largest difference found.
        defect: f64,
    },
    /// A control line that is not parallel to that of the indicatrix.
    #[error(
        "line {index} is not parallel to that of the indicatrix: the normals differ by {defect} of their size"
    )]
    NotParallel {
        /// The line.
        index: usize,
        /// Difference of the two normals over the largest normal.
        defect: f64,
    },
    /// A tube whose radius reaches a radius of curvature of its spine, or is not positive.
    #[error(
        "a tube of radius {radius} around a curve whose radius of curvature falls to {least_radius} is not regular"
    )]
    TubeTooThick {
        /// The radius of the tube.
        radius: f64,
        /// The smallest radius of curvature found.
        least_radius: f64,
    },
}
