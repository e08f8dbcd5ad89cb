//! Dupin cyclides of every type, their exact rational patches, and the complete theory of blending two cones.
//!
//! A Dupin cyclide is a surface all of whose lines of curvature are circles: tori, and everything an inversion makes of them. It is the
//! envelope of two families of spheres, and this crate rests on one picture: write a sphere as centre and signed radius, `(p ; r)`, with
//! the product `p . q - r s`. Then
//!
//! ```text
//!      an oriented cone  =  a line of spheres            a cyclide  =  two conics of spheres
//!
//!            cone 1                                           T1 ___ T2      the tangents at T1 and T2 are
//!              \        S = common inscribed sphere            /     \       the two cones that the cyclide
//!               \      .                                  S  .       |      touches: so it blends them
//!                T1   .                                       \___ /
//!                  \_.__________ T2 ____ cone 2
//!                   S
//! ```
//!
//! Two cones can be blended exactly if their lines lie in a plane: they meet in a common inscribed sphere or are parallel. The blends are the conics
//! that touch both lines, at equal distances from where they meet, one for every point of a diagonal. Nothing else is needed, for any class.
//!
//! # Surfaces
//!
//! ```
//! use cyclide::{Dupin, Frame, Kind, glam::dvec3};
//!
//! let ring = Dupin::quartic(3.0, 1.0, 2.0, Frame::WORLD)?;
//! assert_eq!(ring.kind(), Kind::Ring);
//! let closest = ring.closest(dvec3(4.3, -1.2, 0.9))?;
//! assert!((closest.distance - 0.685_731_420_359_7).abs() < 1e-12);
//! let hits = ring.intersect(dvec3(-9.0, 0.4, 0.35), dvec3(1.0, 0.03, -0.05))?;
//! assert_eq!(hits.len(), 4);
//! # Ok::<(), cyclide::Error>(())
//! ```
//!
//! # Patches
//!
//! ```
//! use cyclide::{Dupin, Frame, convert};
//!
//! let horned = Dupin::quartic(3.0, 2.0, 1.0, Frame::WORLD)?;
//! let patch = horned.patch([2.0, 3.4], [1.5, 3.0])?; // rational biquadratic, exact
//! let found = convert(patch.net())?; // and back from nine control points
//! assert!(found.residual < 1e-12);
//! assert!((found.first[1] - 3.4).abs() < 1e-11);
//! # Ok::<(), cyclide::Error>(())
//! ```
//!
//! # Blends
//!
//! ```
//! use cyclide::{Class, Cone, RingPreference, classify, glam::DVec3};
//!
//! let pipe = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0)?;
//! let axis = DVec3::new(0.9, 0.0, 0.436);
//! let funnel = Cone::new(-axis.normalize() / 0.3_f64.sin(), axis, 0.3)?; // around the same unit sphere
//! let found = classify(&pipe, &funnel);
//! assert_eq!(found.class(), Class::GeneralIntersecting);
//! let blend = found.families()[0].ring_blend(RingPreference::Widest)?;
//! assert!(blend.residual() < 1e-13); // tangent planes agree along both circles
//! let [tube, _] = blend.tubes().expect("a ring has two tubes");
//! let patches = tube.positive_patches(cyclide::tolerance::POSITIVE_WEIGHT)?;
//! assert!(patches.iter().all(|patch| patch.has_weights_above(0.05)));
//! # Ok::<(), cyclide::Error>(())
//! ```
//!
//! # Types
//!
//! | type | what it is |
//! |---|---|
//! | [`Dupin`], [`Quartic`], [`Parabolic`] | a surface in its [`Frame`]: points, normals, curvatures, implicit form, offsets, measures |
//! | [`Kind`] | its type: ring, horned, spindle, torus, double sphere, parabolic |
//! | [`Closest`], [`RayCaster`], [`RayHits`] | distance and closest point, all intersections with a line |
//! | [`Axis`], [`CurvatureCircle`] | axes, lines of curvature; [`Quartic::villarceau_circle`] |
//! | [`Determined`] | a surface from three tangent spheres, principal circles, or a canal curve of the crate `lorentz` |
//! | [`CyclidePatch`] | an exact biquadratic patch; [`Dupin::patch`], [`Dupin::positive_patches`], [`Dupin::atlas`] |
//! | [`NetReport`], [`Condition`] | PG1 to PG4 and the weights of a net; [`inspect`], [`solve_weights`], [`patch_from_corners`] |
//! | [`Conversion`] | a net recognised by [`convert`] or [`convert_torus`] |
//! | [`Cone`], [`SphereLine`] | a cone or cylinder, and its line of oriented spheres |
//! | [`Classification`], [`Class`], [`Obstacle`] | the position of two cones by [`classify`], with what proves it |
//! | [`Family`], [`Conic`], [`Diagonal`], [`TypeInterval`], [`Section`] | a one-parameter family of blends |
//! | [`Blend`], [`Contact`], [`Tube`], [`RingPreference`] | one blend, its contact circles and its two tubes |
//! | [`Joined`], [`DoubleBlend`] | two given contact circles joined by one cyclide or two: [`join`] |
//!
//! # Conventions
//!
//! Lengths have no unit, angles are radians, frames are right-handed. A unit normal `N` belongs to every surface, with `P = centre + r N` at
//! the contact points of all its tangent spheres; principal curvatures have `dN = kappa dP`. Tolerances stand in [`tolerance`], each with its reason.
//!
//! # Left open
//!
//! Canal surfaces and surfaces of revolution can be blended through their tangent cones, but then the contact circles lie in special places and no
//! family exists: an ellipsoid of revolution and a cylinder with a common inscribed sphere have no blend at all (a test shows it). Projective
//! cyclides and supercyclides are not here.
//!
//! # References
//!
//! - \[Shene\] C.-K. Shene, *Blending two cones with Dupin cyclides*, Computer Aided Geometric Design 15 (1998) 643-673.
//! - \[Biquadratic\] the paper on the conversion of rational biquadratic Bezier surfaces into patches of toruses and double spheres
//!   (conditions PG1 to PG4, Theorem 1, Algorithm 1).
//! - \[Pratt\] M. J. Pratt, *Cyclides in computer aided geometric design II*, Computer Aided Geometric Design 12 (1995) 131-152.
//!
//! Where the code departs from them: a surface with `mu = a` is singular and counts as a spindle, not as a ring; a double sphere is `a = c = 0`;
//! Algorithm 1 asks for coaxial circles, not only parallel planes, and reads `a` and `mu` off directly; `w11` comes from the affine coordinates of
//! `P11` in a corner plane, because the printed bisector condition is empty for every torus; opposite edges may have opposite signs on patches of nearly
//! half a turn; and a family need not contain a ring if the cones share their vertex or are cylinders with parallel axes.
//!
//! # Features
//!
//! - `serde`: `Serialize` and `Deserialize` for all value types. Values with private parts are checked when they are read: what a constructor
//!   would refuse is refused, and so are parts of a blend, a family or a tube that do not belong together. Values that are public numbers
//!   (a circle, a hit, a report) are read as they are.
//! - `rayon`: [`Dupin::intersect_all`] on all cores.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod axes;
mod blend;
mod canal;
mod circle;
mod classify;
mod cone;
mod convert;
mod corners;
mod determine;
mod distance;
mod dupin;
mod error;
mod family;
mod frame;
mod join;
mod kind;
mod measure;
mod parabolic;
mod patch;
mod quartic;
mod ray;
mod recognise;
mod ring;
mod section;
mod spheres;
#[cfg(feature = "serde")]
mod stored;
pub mod tolerance;
mod torus_patch;
mod tube;
mod villarceau;

pub use axes::{Axis, common_sphere};
pub use blend::{Blend, Contact, ContactFamily, contact_residual};
pub use circle::CurvatureCircle;
pub use classify::{Class, Classification, DoubleLine, Obstacle, classify};
pub use cone::{Cone, SphereLine};
pub use convert::{Conversion, convert};
pub use corners::patch_from_corners;
pub use determine::Determined;
pub use distance::Closest;
pub use dupin::Dupin;
pub use error::Error;
pub use family::{Conic, Diagonal, Family, TypeInterval};
pub use frame::Frame;
pub use join::{DoubleBlend, Joined, blend_through, double_blends, join};
pub use kind::Kind;
pub use parabolic::Parabolic;
pub use patch::{CyclidePatch, normalise};
pub use quartic::Quartic;
pub use ray::{RayCaster, RayHit, RayHits};
pub use recognise::{Condition, NetReport, inspect, solve_weights};
pub use ring::RingPreference;
pub use section::Section;
pub use torus_patch::convert_torus;
pub use tube::Tube;

pub use glam; // its types appear in our signatures
