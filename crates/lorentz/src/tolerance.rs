//! Every tolerance of the crate, with its reason.

/// Decisions about the product of two unit vectors: orthogonal, tangent, identical, a parabola.
///
/// Such products are cosines, unchanged by every Lorentz map (so by motions and changes of scale), hence a plain
/// number serves for data of any size. What is decided is either exact in the data (1e-16 to 1e-12 after rounding)
/// or a modelling accident above 1e-3; 1e-10 stands between with room on both sides.
pub(crate) const DECISION: f64 = 1e-10;

/// Rounding of a sum of products, relative to the sum of the magnitudes of its terms: about a dozen operations on
/// coordinates which carry a few roundings themselves.
pub(crate) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A vector of unknown origin counts as light-like when its square is below this, relative to the sum of the
/// squares of its coordinates (Section 2: a unit sphere 1000 units away has ratio 4e-12, so not larger).
pub(crate) const LIGHT_LIKE: f64 = 1e-12;

/// A weight or a light-like coordinate counts as zero below this, relative to the largest coordinate of its vector.
/// Values of a Bézier curve carry a dozen roundings; 1e-12 leaves room for data that were computed themselves.
pub(crate) const ZERO_COORDINATE: f64 = 1e-12;

/// Controls lie on the Lie quadric when every condition holds to this, relative to the sum of the magnitudes of its
/// terms. Data with nine digits pass; a curve off the quadric by more has radii that are wrong visibly.
pub(crate) const ON_QUADRIC: f64 = 1e-9;

/// Two arcs are G1 when spheres and derivative spheres agree to this in the frame of the joint's circle (centre at
/// the origin, radius one), where every coordinate is of the order of one.
pub(crate) const JOINT: f64 = 1e-9;

/// A direction counts as parallel to the axis when its sine is below this: the frame would lose eight digits.
pub(crate) const PARALLEL: f64 = 1e-8;

/// Equalities between the invariants of a curve that tell one kind of cyclide from another, in a frame in which one
/// characteristic circle is the unit circle. The tail of the paper's seahorse is a hyperbola by 1e-4 only.
pub(crate) const CLASSIFICATION: f64 = 1e-10;
