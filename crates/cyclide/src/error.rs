//! Why an operation had no answer.

use crate::recognise::Condition;
use glam::DVec3;

/// Why an operation had no answer.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A number of the input is NaN or infinite.
    #[error("{what} must be finite, but a value of {value} was given")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// A length or coordinate whose fourth power a double cannot hold.
    #[error(
        "{what} of {value:e} is out of range: lengths must lie between 1e-70 and 1e70, or be zero"
    )]
    LengthOutOfRange {
        /// Which number.
        what: &'static str,
        /// The given value.
        value: f64,
    },
    /// The axes of a frame are not orthonormal and right-handed.
    #[error("the axes are no right-handed orthonormal frame: off by {deviation:e}")]
    NotAFrame {
        /// Largest deviation of their products from those of a frame.
        deviation: f64,
    },
    /// The parameters of a quartic violate `a >= c >= 0`.
    #[error("a quartic cyclide needs a >= c >= 0, but a = {a} and c = {c}")]
    QuarticParameters {
        /// The given `a`.
        a: f64,
        /// The given `c`.
        c: f64,
    },
    /// `a = c > 0`: two spheres that touch, no cyclide.
    #[error("a = c = {a} gives two spheres that touch, which are no cyclide")]
    TwoSpheres {
        /// The common value of `a` and `c`.
        a: f64,
    },
    /// `a = c = mu = 0`.
    #[error("a double sphere of radius zero is a point")]
    VanishingSphere,
    /// The net of a double sphere has an eccentricity outside `[0, 1)`.
    #[error("the eccentricity of the net on a double sphere must lie in [0, 1), not be {e}")]
    NetEccentricity {
        /// The given eccentricity.
        e: f64,
    },
    /// The focal parameter of a parabolic cyclide is not positive.
    #[error("the focal parameter of a parabolic cyclide must be positive, not {f}")]
    FocalParameter {
        /// The given parameter.
        f: f64,
    },
    /// Villarceau circles of a surface that has none.
    #[error(
        "Villarceau circles are real only on a ring cyclide (c < mu < a): c = {c}, mu = {mu}, a = {a}"
    )]
    NotARing {
        /// Parameter `a`.
        a: f64,
        /// Parameter `c`.
        c: f64,
        /// Parameter `mu`.
        mu: f64,
    },
    /// A ray or line without a direction, or with one so short that its parameters overflow.
    #[error("a ray needs a nonzero finite direction, long enough for finite parameters")]
    Direction,
    /// A parameter span that one biquadratic patch cannot cover.
    #[error("a patch spans more than 0 and less than 2 pi, not from {from} to {to}")]
    Span {
        /// Start of the span.
        from: f64,
        /// End of the span.
        to: f64,
    },
    /// A quantity that only a bounded surface without singular points has.
    #[error("the volume is defined for ring cyclides and ring tori, not for a {kind}")]
    NoVolume {
        /// The kind of the surface.
        kind: crate::Kind,
    },

    /// A net violates one of the conditions on the patches of a cyclide.
    #[error("{condition} violated: residual {residual:e}, allowed {allowed:e}")]
    NotAPatch {
        /// The first condition that fails, in the order PG1 to PG4, w22, edges, w11.
        condition: Condition,
        /// By how much.
        residual: f64,
        /// What would pass.
        allowed: f64,
    },
    /// The corner weights are zero or have different signs.
    #[error("corner weights of mixed sign or zero: {weights:?}")]
    CornerWeights {
        /// The weights of the corners 00, 02, 20, 22.
        weights: [f64; 4],
    },
    /// A control of a net is a vector, a point at infinity, where points are needed.
    #[error("the control in row {row} and column {column} is at infinity, where a point is needed")]
    ControlAtInfinity {
        /// Row of the control, from 0.
        row: usize,
        /// Column of the control, from 0.
        column: usize,
    },
    /// All tangent spheres are planes: the patch is plane.
    #[error("planar patch")]
    Planar,
    /// The tangent spheres are collinear: the patch is one of a cone or a cylinder of revolution.
    #[error("patch of a cylinder or cone of revolution (tangent spheres collinear)")]
    ConeOrCylinder,
    /// No normal could be found at the places where the conversion needs one.
    #[error("the patch has no normal at (u, v) = ({u}, {v})")]
    NoNormal {
        /// First parameter.
        u: f64,
        /// Second parameter.
        v: f64,
    },
    /// The net rebuilt from the best surface differs from the given one.
    #[error("not a Dupin cyclide patch (net residual {residual:e} above tolerance {allowed:e})")]
    NetResidual {
        /// Largest relative difference of the normalised nets.
        residual: f64,
        /// What would pass.
        allowed: f64,
    },
    /// Algorithm 1 asked about a net that is no torus or double sphere.
    #[error(
        "no pair of opposite edges lies in parallel planes: not a torus or double-sphere patch (use the general conversion); \
         the better pair is off by {deviation:e}"
    )]
    NoParallelEdges {
        /// Deviation of the better pair of opposite edges from coaxial circles.
        deviation: f64,
    },
    /// Four corner points and a frame that no cyclide patch has.
    #[error("no cyclide patch has these corners and this corner frame: {reason}")]
    Corners {
        /// What is wrong with them.
        reason: &'static str,
    },
    /// Circles or spheres that do not determine a cyclide.
    #[error("no cyclide is determined: {reason}")]
    NotDetermined {
        /// What is wrong with them.
        reason: &'static str,
    },

    /// The axis of a cone is zero or not finite.
    #[error("axis must be a nonzero finite vector, not {axis}")]
    Axis {
        /// The given vector.
        axis: DVec3,
    },
    /// The half angle of a cone is not in `(0, pi/2)`.
    #[error("half angle must lie strictly between 0 and pi/2, not be {half_angle}")]
    HalfAngle {
        /// The given angle, radians.
        half_angle: f64,
    },
    /// The radius of a cylinder is not positive.
    #[error("a cylinder needs a positive radius, not {radius}")]
    CylinderRadius {
        /// The given radius.
        radius: f64,
    },
    /// A point that should select a blend is not on the diagonal.
    #[error("X does not lie on a diagonal: it is {distance:e} away, allowed {allowed:e}")]
    NotOnDiagonal {
        /// Distance from the nearest diagonal, in space; infinite for cones on one axis, which have none.
        distance: f64,
        /// What would pass.
        allowed: f64,
    },
    /// The member of a family that is no cyclide.
    #[error(
        "degenerate member: the cyclide collapses to the common inscribed sphere at t = {parameter:e}"
    )]
    CommonSphere {
        /// The parameter in the family.
        parameter: f64,
    },
    /// Rounding left no frame or no size for a member of a family.
    #[error("the blend at {parameter:e} collapses numerically")]
    Collapsed {
        /// The parameter in the family.
        parameter: f64,
    },
    /// A blend was built whose G1 residual is too large to hand out.
    #[error("the blend does not touch both cones: residual {residual:e}, allowed {allowed:e}")]
    NotTangent {
        /// The algebraic G1 residual.
        residual: f64,
        /// What would pass.
        allowed: f64,
    },
    /// A circle that should lie on a cone does not.
    #[error("the circle does not lie on the cone: off by {deviation:e} of its size")]
    NotACircleOfTheCone {
        /// Relative deviation.
        deviation: f64,
    },
    /// The cones cannot be blended with one cyclide.
    #[error("{0}")]
    NotBlendable(crate::Class),
    /// A family without ring cyclides, or none with the wanted property.
    #[error("the family has no such ring cyclide: its members are {kind}")]
    NoRing {
        /// The kind of the members where a ring was wanted.
        kind: crate::Kind,
    },
    /// No single cyclide joins the two circles.
    #[error(
        "no cyclide touches the cones along both circles: the nearest misses by {mismatch:e} of their size"
    )]
    NotJoined {
        /// Relative mismatch of the second circle.
        mismatch: f64,
    },
    /// No cone between two cones was found that allows a blend of two cyclides; [`crate::double_blends`] says which are tried.
    #[error(
        "no cone was found between the two that allows a blend of two cyclides along these circles"
    )]
    NoMiddleCone,
    /// An operation on the space of spheres failed.
    #[error(transparent)]
    Lorentz(#[from] lorentz::Error),
    /// An operation on mass points failed.
    #[error(transparent)]
    Mass(#[from] bezier_mass::Error),
    /// A root could not be certified.
    #[error(transparent)]
    Root(#[from] variation::Error),
}
