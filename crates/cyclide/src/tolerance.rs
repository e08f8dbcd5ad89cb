//! Every tolerance of the crate, each with its reason.
//!
//! All are relative: to the size of the data where lengths are compared, to 1 where directions or weights are.

/// Lengths and coordinates may be this large, and sizes as small as its inverse: the implicit equation is of degree four,
/// and 1e280 leaves room for its factors.
pub const LARGEST_LENGTH: f64 = 1e70;

/// Axes given for a frame may be off by this much; they are then made orthonormal. Wide enough for numbers printed
/// with ten digits.
pub const FRAME: f64 = 1e-9;

/// Lengths `a`, `c`, `mu` as a designer types them count as equal within this share of the larger: a few thousand
/// roundings.
pub const EXACT_KIND: f64 = 1e-12;

/// Lengths recovered from a net or a construction count as equal within this share: recovery loses up to three digits
/// to cancellation.
pub const RECOVERED_KIND: f64 = 1e-9;

/// A control net satisfies PG1 to PG4 and the weight conditions if no residual exceeds this. Generated nets stay below
/// 5e-14; nets printed with ten digits pass.
pub const NET: f64 = 1e-9;

/// The net rebuilt from a recovered surface may differ by this from the given one. It bounds all conditions at once.
pub const REBUILT_NET: f64 = 1e-8;

/// Below this share tangent spheres are equal, their centres collinear, or their Gram determinant zero (parabolic).
pub const TANGENT_SPHERES: f64 = 1e-9;

/// Structure of two cones: coplanar axes, equal radii, parallel directions, null directions.
pub const CLASS: f64 = 1e-9;

/// Vertices nearer than this share of their distance from the origin are one vertex: the rounding of a moved model.
pub const SAME_POINT: f64 = 1e-12;

/// What a coordinate may be off by, as a share of the distance from the origin and of the lengths that were added to it: four roundings.
pub const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// No blend is returned whose algebraic G1 residual exceeds this.
pub const BLEND: f64 = 1e-8;

/// A weight below this share of the largest is unfit for software that wants ordinary positive weights.
pub const POSITIVE_WEIGHT: f64 = 0.05;
