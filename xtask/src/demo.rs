//! How a demo is declared, run and reported.
//!
//! A [`Demo`] is a struct of clap arguments with one function. It gets a [`Context`], which knows
//! the sizes asked for and takes pictures, files and numbers. Every file is written under a
//! temporary name and renamed when it is complete, `report.json` last.

mod context;
mod failure;

pub use context::{Context, Settings};
pub(crate) use context::{progress_bar, write_atomically};
pub use failure::{BadInput, OrBadInput, exit_status};

use anyhow::Result;
use clap::{ArgMatches, Args, Command, FromArgMatches};

use crate::report::Report;

/// One demo: its own flags are the fields of the struct.
pub trait Demo: Args {
    /// The name on the command line and of the folder.
    const NAME: &'static str;
    /// The paper and the figures that the demo answers, `mass-points-and-spheres, Fig. 9`.
    const PAPER: &'static str;
    /// What one sees, in a line.
    const ABOUT: &'static str;

    /// Computes, draws and measures.
    ///
    /// # Errors
    /// [`BadInput`] where the user's flags or files are at fault, anything else where the demo is.
    fn run(&self, context: &mut Context) -> Result<()>;
}

/// A demo in the list of demos, its argument type forgotten.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The name on the command line and of the folder.
    pub name: &'static str,
    /// The paper and the figures that the demo answers.
    pub paper: &'static str,
    /// What one sees, in a line.
    pub about: &'static str,
    flags: fn(Command) -> Command,
    run: fn(&ArgMatches, &mut Context) -> Result<()>,
}

/// The list entry of demo `D`.
#[must_use]
pub const fn entry<D: Demo>() -> Entry {
    Entry {
        name: D::NAME,
        paper: D::PAPER,
        about: D::ABOUT,
        flags: D::augment_args,
        run: |matches, context| D::from_arg_matches(matches)?.run(context),
    }
}

impl Entry {
    /// The demo as a subcommand, with the flags that all demos share and its own.
    #[must_use]
    pub fn command(&self) -> Command {
        let command = (self.flags)(Settings::augment_args(Command::new(self.name)));
        // After the flags, whose structs would set their own documentation here.
        command
            .about(self.about)
            .long_about(None)
            .after_help(format!("Answers {}.", self.paper))
    }

    /// Runs the demo with parsed flags and writes its report.
    ///
    /// Numbers that miss their targets do not make an error here: the report says so.
    ///
    /// # Errors
    /// Whatever the demo reports. `report.json` does not exist then.
    pub fn run(&self, matches: &ArgMatches) -> Result<Report> {
        let settings = Settings::from_arg_matches(matches)?;
        let mut context = Context::open(self.name, self.paper, settings)?;
        (self.run)(matches, &mut context)?;
        context.close()
    }

    /// Runs the demo with flags given as texts, as the gallery and the tests do.
    ///
    /// # Errors
    /// Flags that do not parse, and whatever the demo reports.
    pub fn run_with<S: Into<String>>(&self, flags: impl IntoIterator<Item = S>) -> Result<Report> {
        let words = std::iter::once(self.name.to_owned()).chain(flags.into_iter().map(Into::into));
        self.run(&self.command().try_get_matches_from(words)?)
    }
}
