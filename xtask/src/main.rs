//! `cargo xtask`: demos, the gallery and benchmarks. See `cargo xtask help`.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Result, bail};
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, value_parser};
use xtask::bench::{self, Timer};
use xtask::demo::exit_status;
use xtask::{demos, gallery, report};

fn main() -> ExitCode {
    let matches = command().get_matches();
    match run(&matches) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing better can be done where even the error cannot be written.
            let _ = writeln!(std::io::stderr(), "xtask: {error:#}");
            ExitCode::from(exit_status(&error))
        }
    }
}

fn command() -> Command {
    let json = Arg::new("json")
        .long("json")
        .value_name("FILE")
        .global(true)
        .help("Write the result as JSON")
        .value_parser(value_parser!(PathBuf));
    let milliseconds = Arg::new("milliseconds")
        .long("milliseconds")
        .value_name("N")
        .global(true)
        .default_value("300")
        .help("Time to spend on each piece of work")
        .value_parser(value_parser!(u64).range(1..=600_000));
    Command::new("xtask")
        .about("Demos, the gallery and benchmarks of the workspace")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(Command::new("list").about("The demos, with the figures that they answer"))
        .subcommand(
            Command::new("demo")
                .about("Run one demo: pictures, geometry files and report.json in DIR/NAME")
                .subcommand_required(true)
                .arg_required_else_help(true)
                .subcommand_value_name("NAME")
                .subcommands(demos::all().iter().map(xtask::demo::Entry::command)),
        )
        .subcommand(gallery::Gallery::augment_args(
            Command::new("gallery").about("Run every demo and write index.html over them all"),
        ))
        .subcommand(
            Command::new("bench")
                .about("Time the work of the crates, all of it or one bench")
                .subcommand_value_name("NAME")
                .args([json, milliseconds])
                .subcommands(bench::all().iter().map(bench::Entry::command)),
        )
}

fn run(matches: &ArgMatches) -> Result<()> {
    match matches.subcommand() {
        Some(("list", _)) => list(),
        Some(("demo", matches)) => demo(matches),
        Some(("gallery", matches)) => gallery::Gallery::from_arg_matches(matches)?.run(),
        Some(("bench", matches)) => benches(matches),
        _ => bail!("no such command"),
    }
}

fn list() -> Result<()> {
    let mut out = std::io::stdout().lock();
    for entry in demos::all() {
        writeln!(out, "{:<18} {}  [{}]", entry.name, entry.about, entry.paper)?;
    }
    Ok(())
}

/// Runs one demo, prints its numbers, and fails if one of them misses its target.
fn demo(matches: &ArgMatches) -> Result<()> {
    let entries = demos::all();
    let chosen = matches
        .subcommand()
        .and_then(|(name, flags)| Some((entries.iter().find(|entry| entry.name == name)?, flags)));
    let Some((entry, flags)) = chosen else {
        bail!("no such demo");
    };
    let result = entry.run(flags)?;
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{} ({}), {:.2} s",
        result.demo, result.paper, result.seconds
    )?;
    for number in &result.numbers {
        let verdict = if number.is_met() { ' ' } else { '!' };
        let value = report::plain(&number.value);
        writeln!(
            out,
            "{verdict} {:<38} {value:<24} {}",
            number.key, number.target
        )?;
    }
    writeln!(out, "  {}", result.files.join(" "))?;
    let missed: Vec<_> = result.missed().map(|number| number.key.as_str()).collect();
    if !missed.is_empty() {
        bail!(
            "{}: these numbers miss their targets: {}",
            result.demo,
            missed.join(", ")
        );
    }
    Ok(())
}

fn benches(matches: &ArgMatches) -> Result<()> {
    let milliseconds = matches
        .get_one::<u64>("milliseconds")
        .copied()
        .unwrap_or(300);
    let timer = Timer::new(Duration::from_millis(milliseconds));
    let entries = bench::all();
    let chosen = matches
        .subcommand()
        .and_then(|(name, flags)| Some((entries.iter().find(|entry| entry.name == name)?, flags)));
    let result = match chosen {
        Some((entry, flags)) => entry.run(flags, &timer)?,
        None => bench::run_all(&timer)?,
    };
    if let Some(path) = matches.get_one::<PathBuf>("json") {
        bench::write_json(path, &result)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cli_is_consistent() {
        command().debug_assert();
    }

    #[test]
    fn the_help_of_a_demo_says_what_one_sees() {
        for entry in demos::all() {
            let help = entry.command().render_help().to_string();
            assert!(help.starts_with(entry.about), "{help}");
        }
    }

    #[test]
    fn unknown_demos_and_sizes_out_of_range_are_refused() {
        assert!(
            command()
                .try_get_matches_from(["xtask", "demo", "no-such-demo"])
                .is_err()
        );
        for entry in demos::all() {
            let words = ["xtask", "demo", entry.name, "--width", "0"];
            assert!(command().try_get_matches_from(words).is_err());
        }
    }
}
