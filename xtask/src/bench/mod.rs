//! Timed work: `cargo xtask bench [NAME] [--json FILE]`.
//!
//! A bench is a file here with a struct of clap arguments and a function that returns JSON: an
//! object whose `rows` (an array of flat objects) are printed as a table and whose other members
//! are printed a line each. `--json FILE` writes the object as it is.
//!
//! ```ignore
//! #[derive(clap::Args, Debug)]
//! pub(super) struct Patches {}
//!
//! impl Bench for Patches {
//!     const NAME: &'static str = "patches";
//!     const ABOUT: &'static str = "Evaluation of rational patches";
//!
//!     fn run(&self, timer: &Timer) -> Result<Value> {
//!         let ns = timer.nanoseconds(|| black_box(patch.evaluate(0.3, 0.4)));
//!         Ok(json!({ "rows": [{ "work": "biquadratic", "ns": ns }] }))
//!     }
//! }
//! ```
//!
//! Register it below: one `mod` line, one `entry` line, in alphabetical order.

mod table;
mod timer;

pub use timer::Timer;

use std::io::Write;
use std::path::Path;

use anyhow::{Context as _, Result};
use clap::{ArgMatches, Args, Command};
use serde_json::Value;

use crate::demo::write_atomically;

// Modules: replace your comment by your line, keep the empty lines, so that merges do not collide.

mod bezier_mass;

mod cyclide;

mod geodesic;

mod lorentz;

mod ph_curves;

mod reconstruct;

mod render;

mod variation;

mod wavefront;

/// Every bench, in alphabetical order.
#[must_use]
pub fn all() -> Vec<Entry> {
    vec![
        entry::<bezier_mass::BezierMass>(),
        entry::<cyclide::Cyclide>(),
        entry::<geodesic::Geodesic>(),
        entry::<lorentz::Lorentz>(),
        entry::<ph_curves::PhCurves>(),
        entry::<reconstruct::Reconstruct>(),
        entry::<render::Render>(),
        entry::<variation::Variation>(),
        entry::<wavefront::Wavefront>(),
    ]
}

/// One bench: its own flags are the fields of the struct.
pub trait Bench: Args {
    /// The name on the command line.
    const NAME: &'static str;
    /// What is timed, in a line.
    const ABOUT: &'static str;

    /// Does the timed work.
    ///
    /// # Errors
    /// [`BadInput`](crate::demo::BadInput) where the user's flags or files are at fault.
    fn run(&self, timer: &Timer) -> Result<Value>;
}

/// A bench in the list of benches, its argument type forgotten.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name on the command line.
    pub name: &'static str,
    /// What is timed, in a line.
    pub about: &'static str,
    flags: fn(Command) -> Command,
    run: fn(&ArgMatches, &Timer) -> Result<Value>,
}

/// The list entry of bench `B`.
#[must_use]
pub const fn entry<B: Bench>() -> Entry {
    Entry {
        name: B::NAME,
        about: B::ABOUT,
        flags: B::augment_args,
        run: |matches, timer| B::from_arg_matches(matches)?.run(timer),
    }
}

impl Entry {
    /// The bench as a subcommand.
    #[must_use]
    pub fn command(&self) -> Command {
        (self.flags)(Command::new(self.name))
            .about(self.about)
            .long_about(None)
    }

    /// Does the timed work with parsed flags, and prints what came out.
    ///
    /// # Errors
    /// Whatever the bench reports.
    pub fn run(&self, matches: &ArgMatches, timer: &Timer) -> Result<Value> {
        let result = (self.run)(matches, timer)?;
        let mut out = std::io::stdout().lock();
        writeln!(out, "{}: {}", self.name, self.about)?;
        writeln!(out, "{}", table::text(&result))?;
        Ok(result)
    }
}

/// Runs every bench with its default flags; the result has a member for each.
///
/// # Errors
/// The first failure.
pub fn run_all(timer: &Timer) -> Result<Value> {
    let mut results = serde_json::Map::new();
    for entry in all() {
        let matches = entry.command().try_get_matches_from([entry.name])?;
        results.insert(entry.name.into(), entry.run(&matches, timer)?);
    }
    Ok(Value::Object(results))
}

/// Writes a result for other programs.
///
/// # Errors
/// Whatever writing reports.
pub fn write_json(path: &Path, result: &Value) -> Result<()> {
    let text = serde_json::to_string_pretty(result)?;
    write_atomically(path, |file| writeln!(file, "{text}"))
        .with_context(|| format!("cannot write {}", path.display()))
}
