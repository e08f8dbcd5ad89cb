//! Wavefronts in dual Bézier form: propagation, reflection, transmission, caustics and anisotropy.
//!
//! A front in a homogeneous medium is the envelope of its tangent lines. Stored by those lines, as a spline of class-3
//! Pythagorean-hodograph arcs, it propagates by translating them, exactly and at any time, and it stays regular where the
//! curve itself has cusps:
//!
//! ```text
//!      source *                 support p(N), the eikonal: the wave with normal N
//!           / | \               passes X at the time <N, X> - p(N)
//!     -----/--+--\-----  interface
//!         /   |   \             front at time T:   p + T
//!        (    |    )            caustic: the evolute, piecewise cubic
//! ```
//!
//! # First program
//!
//! The reflected wave in a layer over a curved interface: its arrivals, and its front.
//!
//! ```
//! use wavefront::{Code, Fan, FanOptions, FrontTolerance, Interface, Medium, Mode, Model, Source, Step};
//! use wavefront::glam::DVec2;
//!
//! let media = vec![Medium::isotropic(1500.0)?, Medium::isotropic(2200.0)?];
//! let valley = Interface::graph(-3000.0, 3000.0, 60, |x: f64| {
//!     let (sine, cosine) = (x / 600.0).sin_cos();
//!     [-800.0 + 120.0 * cosine, -0.2 * sine, -0.2 / 600.0 * cosine]
//! })?;
//! let model = Model::try_new(DVec2::new(-2500.0, -2000.0), DVec2::new(2500.0, 100.0), media, vec![valley])?;
//!
//! let code = Code { steps: vec![Step { interface: 0, mode: Mode::Reflect }] };
//! let fan = Fan::new(&model, Source::point(DVec2::ZERO), code, FanOptions::default())?;
//! let arrivals = fan.arrivals(DVec2::new(400.0, 0.0));
//! assert!(!arrivals.is_empty() && arrivals[0].time > 0.9);
//!
//! for front in fan.fronts(FrontTolerance::time(1e-6))? {
//!     assert!(front.error() <= 1e-6);
//!     let caustic_pieces = front.caustic().count();
//!     assert!(caustic_pieces > 0);
//! }
//! # Ok::<(), wavefront::Error>(())
//! ```
//!
//! # The types
//!
//! | type | what it is |
//! |---|---|
//! | [`Medium`] | a speed, an elliptical indicatrix, or any rational one |
//! | [`Interface`] | a line, conic, Bézier or B-spline curve, a graph, conics fitted to samples |
//! | [`Model`] | media one below the other, checked; [`Code`] says which interfaces a wave meets and how |
//! | [`Source`] | a point, a plane wave, an exploding reflector, or a front |
//! | [`Ray`] | point, slowness, time and their derivatives along the wave: Snell's law and the ray tube |
//! | [`Fan`] | all rays of a source with one code: [`Arrival`]s at receivers, boundaries of illumination |
//! | [`Cut`] | where an illuminated stretch or a front ends, and why |
//! | [`Front`] | a G1 spline of class-3 arcs: snapshots, cusps, caustics, arrivals |
//! | [`DualSurface`] | fronts in space by their support function |
//! | [`FrontPatches`] | a front reflected in a quadric, as dual patches that join smoothly |
//!
//! # Accuracy
//!
//! Rays are exact to rounding: impacts on conics in closed form, on Bézier curves by certified roots, Snell's law by the
//! conservation of the slowness along the interface. A fan keeps its rays as strips, dual cubic Bézier curves of lines; a
//! receiver's distances from their control lines tell how many rays pass it, and one exact ray, with its own derivatives, the
//! time of each. Fronts are fitted to a tolerance that is measured on other exact rays than those that were fitted; a sliver
//! that no arc can follow is left out and is a [`Cut`].
//!
//! Between rays that fail, enclosures of whole intervals of rays ([`Fan::unsearched`]) tell that none gets through, or the
//! interval is halved: a window of rays wider than 2^-20 of the source's parameter is found, or the stretch that may hide it is
//! listed. What is not certified: sources that are curves and rational indicatrices have no enclosures; a run of rays is
//! checked at its rays, in the middles between them and for the tangents of an interface's pieces in between, not for obstacles
//! smaller than that in the way to a later interface; two arrivals closer to their caustic than [`FanOptions::accuracy`].
//!
//! In space [`DualSurface`] propagates and is reflected in planes exactly. Behind a quadric mirror a [`SampledSurface`] is a
//! grid of exact rays, and [`FrontPatches`] are dual bicubic patches over the outgoing normal, fitted to a tolerance that is
//! measured on other rays: G1 by construction, with exact offsets at all times.
//!
//! # Left open
//!
//! Finding a reflector from its front; fronts of class-3 arcs in media whose indicatrix is no ellipse (their rays, arrivals
//! and exact propagation by `ph_curves::IsoperimetricArc` work); refraction in space, and patches beyond a fold of the
//! reflected normals.
//!
//! # References
//!
//! - L. Biard, habilitation thesis, Chapter 5 (the method) and Section 1.4 (the Minkowski plane).
//! - V. Červený, *Seismic Ray Theory*, Cambridge 2001 (ray tubes, anisotropic reflection and transmission).

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;

mod arrival;
mod beam;
mod chain;
mod code;
mod conic;
mod cut;
mod departure;
mod error;
mod fan;
mod fit;
mod front;
mod interface;
mod interpolate;
mod medium;
mod model;
mod piece;
mod ray;
mod receivers;
mod sample;
mod scatter;
mod snapshot;
mod source;
mod space;
#[cfg(feature = "serde")]
mod stored;
mod strip;
mod trace;

pub use arrival::Arrival;
pub use code::{Code, Step};
pub use cut::Cut;
pub use error::Error;
pub use fan::{Fan, FanOptions};
pub use fit::FrontTolerance;
pub use front::{Cusp, Front, FrontPiece, PieceShape};
pub use glam;
pub use interface::{Impact, Interface};
pub use medium::Medium;
pub use model::Model;
pub use ray::{Mode, Ray};
pub use receivers::{first_arrival, section, travel_time_table};
pub use source::Source;
pub use space::{
    DualSurface, FrontPatches, Mirror, Omission, PatchOptions, SampledSurface, SpacePoint,
};
pub use trace::Trace;
