//! The demos, one file each.
//!
//! To add one, write `demos/spiral.rs`:
//!
//! ```ignore
//! //! What one sees in the picture, in two sentences.
//! use std::f64::consts::TAU;
//!
//! use anyhow::Result;
//! use glam::DVec2;
//!
//! use crate::color::BLUE;
//! use crate::demo::{Context, Demo};
//! use crate::figure::{Figure, Plot};
//! use crate::report::Target;
//!
//! #[derive(clap::Args, Debug)]
//! pub(super) struct Spiral {
//!     /// Number of turns (the demo's own flag, with its default)
//!     #[arg(long, default_value_t = 3.0)]
//!     turns: f64,
//! }
//!
//! impl Demo for Spiral {
//!     const NAME: &'static str = "spiral";
//!     const PAPER: &'static str = "the-paper, Fig. 1.6";
//!     const ABOUT: &'static str = "A logarithmic spiral";
//!
//!     fn run(&self, context: &mut Context) -> Result<()> {
//!         let spiral = |t: f64| DVec2::from_angle(t) * (0.1 * t).exp();
//!         let mut plot = Plot::geometry("a log spiral");
//!         plot.trace(spiral, 0.0, self.turns * TAU, BLUE.line().label("ρ = exp φ/10"));
//!         context.figure("figure", &Figure::new(plot), "caption", "alt text")?;
//!         context.number("order", 5.02, Target::within(5.0, 0.3));
//!         Ok(())
//!     }
//! }
//! ```
//!
//! and register it below: one `mod` line and one `entry` line, in alphabetical order, each with an
//! empty line after it. The gallery shows it, and `cargo test -p xtask` runs it small
//! (`--quick --width 160 --samples 1`) and holds every number against its target: with `--quick`
//! a demo should take about a second. The user's mistakes are
//! [`BadInput`](crate::demo::BadInput) (`result.or_bad_input("--mesh FILE")?`).
//!
//! What a demo can use: [`Context`](crate::demo::Context) (sizes, `pick(full, quick)`, files,
//! numbers), [`figure`](crate::figure), [`mesh`](crate::mesh), [`render`](crate::render),
//! [`export`](crate::export).

// Modules: replace your comment by your line, keep the empty lines, so that merges do not collide.

mod anisotropic;

mod biquadratic;

mod caustics;

mod cone;

mod cone_blend;

mod cyclide_to_cone;

mod cyclide_zoo;

mod dual_control;

mod geodesic;

mod geodesic_loop;

mod geodesic_patch;

mod geodesic_surface;

mod mass_points;

mod minkowski;

mod ovals;

mod pencils;

mod ribbon;

mod ribbon_surface;

mod rrmf_tube;

mod seahorse;

mod straightest;

mod t_quartic;

mod variation;

mod wavefront;

mod wavefront_3d;

use crate::demo::{Entry, entry};

pub(crate) use ribbon::alternating;

/// Every demo, in alphabetical order.
#[must_use]
pub fn all() -> Vec<Entry> {
    vec![
        entry::<anisotropic::Anisotropic>(),
        entry::<biquadratic::BiquadraticDemo>(),
        entry::<caustics::Caustics>(),
        entry::<cone::Cone>(),
        entry::<cone_blend::ConeBlend>(),
        entry::<cyclide_to_cone::CyclideToCone>(),
        entry::<cyclide_zoo::CyclideZoo>(),
        entry::<dual_control::DualControl>(),
        entry::<geodesic::Geodesic>(),
        entry::<geodesic_loop::GeodesicLoop>(),
        entry::<geodesic_patch::GeodesicPatch>(),
        entry::<geodesic_surface::GeodesicSurface>(),
        entry::<mass_points::MassPoints>(),
        entry::<minkowski::Minkowski>(),
        entry::<ovals::Ovals>(),
        entry::<pencils::Pencils>(),
        entry::<ribbon::Ribbon>(),
        entry::<ribbon_surface::RibbonSurface>(),
        entry::<rrmf_tube::RrmfTube>(),
        entry::<seahorse::Seahorse>(),
        entry::<straightest::Straightest>(),
        entry::<t_quartic::TQuartic>(),
        entry::<variation::Variation>(),
        entry::<wavefront::Wavefront>(),
        entry::<wavefront_3d::Wavefront3d>(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::fs;

    #[test]
    fn names_are_in_order_and_differ() {
        let names: Vec<_> = all().iter().map(|entry| entry.name).collect();
        let sorted: Vec<_> = BTreeSet::from_iter(&names).into_iter().copied().collect();
        assert_eq!(names, sorted);
    }

    /// Every demo runs, small, and measures what it should: the cheapest test of the whole workspace.
    #[test]
    fn every_demo_meets_its_targets() {
        let out = std::env::temp_dir().join(format!("xtask-demos-{}", std::process::id()));
        let mut failures = Vec::new();
        for entry in all() {
            let flags = ["--quick", "--width", "160", "--samples", "1", "--out"];
            let flags = flags
                .into_iter()
                .map(String::from)
                .chain([out.display().to_string()]);
            match entry.run_with(flags) {
                Err(error) => failures.push(format!("{}: {error:#}", entry.name)),
                Ok(report) => {
                    let folder = out.join(entry.name);
                    for missed in report.missed() {
                        let (key, value, target) = (&missed.key, &missed.value, &missed.target);
                        failures.push(format!(
                            "{}: {key} = {value}, should be {target}",
                            entry.name
                        ));
                    }
                    if report.numbers.is_empty() || report.pictures.is_empty() {
                        failures.push(format!("{}: shows or measures nothing", entry.name));
                    }
                    for file in &report.files {
                        if !fs::metadata(folder.join(file)).is_ok_and(|meta| meta.len() > 0) {
                            failures.push(format!("{}: {file} is missing or empty", entry.name));
                        }
                    }
                    for picture in &report.pictures {
                        if picture.caption.is_empty() || picture.alt.is_empty() {
                            failures.push(format!(
                                "{}: {} has no caption or alt text",
                                entry.name, picture.file
                            ));
                        }
                    }
                }
            }
        }
        let _ = fs::remove_dir_all(&out);
        assert!(failures.is_empty(), "{}", failures.join("\n"));
    }
}
