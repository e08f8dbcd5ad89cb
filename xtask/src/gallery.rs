//! Every demo in turn, and one page over them all.

mod page;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use anyhow::{Context as _, Result, anyhow, bail};

use crate::demo::{Entry, progress_bar, write_atomically};
use crate::demos;
use crate::report::Report;

/// The flags of the gallery.
#[derive(clap::Args, Clone, Debug)]
pub struct Gallery {
    /// Folder of the page; every demo has its own folder in it
    #[arg(long, value_name = "DIR", default_value = "target/gallery")]
    pub out: PathBuf,
    /// Small pictures and few trials: minutes become seconds
    #[arg(long)]
    pub quick: bool,
}

/// How one demo ended.
#[derive(Debug)]
struct Outcome {
    entry: Entry,
    /// The report, or the reason why there is none.
    result: Result<Report>,
}

impl Gallery {
    /// Runs every demo, goes on past a failing one, and writes `index.html`.
    ///
    /// # Errors
    /// After the page is written: if a demo failed or a number missed its target.
    pub fn run(&self) -> Result<()> {
        self.run_entries(&demos::all())
    }

    fn run_entries(&self, entries: &[Entry]) -> Result<()> {
        std::fs::create_dir_all(&self.out)
            .with_context(|| format!("cannot make the folder {}", self.out.display()))?;
        let bar = progress_bar("gallery", entries.len() as u64);
        let mut outcomes = Vec::new();
        for entry in entries {
            bar.set_message(entry.name);
            bar.tick();
            let result = self.run_one(entry);
            bar.suspend(|| say(entry, &result));
            outcomes.push(Outcome {
                entry: *entry,
                result,
            });
            bar.inc(1);
        }
        bar.finish_and_clear();
        let html = page::html(&outcomes, self.quick);
        write_atomically(&self.out.join("index.html"), |file| {
            std::io::Write::write_all(file, html.as_bytes())
        })?;
        let bad: Vec<&str> = outcomes
            .iter()
            .filter(|o| !o.is_good())
            .map(|o| o.entry.name)
            .collect();
        if !bad.is_empty() {
            bail!("failed or off target: {}", bad.join(", "));
        }
        Ok(())
    }

    /// One demo; a panic in it is a failure like another.
    fn run_one(&self, entry: &Entry) -> Result<Report> {
        let mut flags = vec!["--out".to_owned(), self.out.display().to_string()];
        if self.quick {
            flags.push("--quick".into());
        }
        catch_unwind(AssertUnwindSafe(|| entry.run_with(flags))).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&text| text.to_owned()));
            Err(anyhow!("panicked: {}", text.unwrap_or_default()))
        })
    }
}

impl Outcome {
    /// Whether the demo ran and every number met its target.
    fn is_good(&self) -> bool {
        self.result
            .as_ref()
            .is_ok_and(|report| report.missed().next().is_none())
    }
}

/// A line a demo for the log.
fn say(entry: &Entry, result: &Result<Report>) {
    use std::io::Write;
    let line = match result {
        Err(error) => format!("{:<18} FAILED: {error:#}", entry.name),
        Ok(report) => {
            let missed: Vec<&str> = report.missed().map(|n| n.key.as_str()).collect();
            let verdict = if missed.is_empty() {
                "ok".into()
            } else {
                format!("off target: {}", missed.join(", "))
            };
            format!("{:<18} {:>7.2} s  {verdict}", entry.name, report.seconds)
        }
    };
    // A closed pipe is no reason to stop.
    let _ = writeln!(std::io::stdout(), "{line}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::BLUE;
    use crate::demo::{Context, Demo, entry};
    use crate::figure::{Figure, Plot};
    use crate::report::Target;
    use std::fs;

    #[derive(clap::Args)]
    struct Good {}

    impl Demo for Good {
        const NAME: &'static str = "good";
        const PAPER: &'static str = "paper, Fig. 1";
        const ABOUT: &'static str = "works";
        fn run(&self, context: &mut Context) -> Result<()> {
            let mut plot = Plot::geometry("a < b");
            plot.graph(|x| x, 0.0, 1.0, BLUE.line());
            context.figure(
                "figure",
                &Figure::new(plot),
                "a caption with <b>",
                "a \"line\"",
            )?;
            context.number("error", 1e-12, Target::AtMost(1e-9));
            Ok(())
        }
    }

    #[derive(clap::Args)]
    struct Panics {}

    impl Demo for Panics {
        const NAME: &'static str = "panics";
        const PAPER: &'static str = "paper, Fig. 2";
        const ABOUT: &'static str = "does not work";
        fn run(&self, _: &mut Context) -> Result<()> {
            panic!("out of luck")
        }
    }

    #[derive(clap::Args)]
    struct Misses {}

    impl Demo for Misses {
        const NAME: &'static str = "misses";
        const PAPER: &'static str = "paper, Fig. 3";
        const ABOUT: &'static str = "is not good enough";
        fn run(&self, context: &mut Context) -> Result<()> {
            context.number("gap", 0.5, Target::AtMost(0.1));
            Ok(())
        }
    }

    #[test]
    fn the_gallery_goes_on_past_failures_and_reports_them() {
        let out = std::env::temp_dir().join(format!("xtask-gallery-{}", std::process::id()));
        let gallery = Gallery {
            out: out.clone(),
            quick: true,
        };
        let entries = [entry::<Panics>(), entry::<Misses>(), entry::<Good>()];
        let error = gallery.run_entries(&entries).unwrap_err();
        assert_eq!(error.to_string(), "failed or off target: panics, misses");
        let html = fs::read_to_string(out.join("index.html")).unwrap();
        for text in [
            "panicked: out of luck",
            "src=\"good/figure.png\"",
            "alt=\"a &quot;line&quot;\"",
            "a caption with &lt;b&gt;",
            "href=\"good/figure.svg\"",
            "≤ 0.1",
            "paper, Fig. 1",
        ] {
            assert!(html.contains(text), "{text}");
        }
        assert!(!out.join("panics/report.json").exists());
        assert!(out.join("misses/report.json").exists());
        gallery.run_entries(&entries[2..]).unwrap();
        fs::remove_dir_all(out).unwrap();
    }
}
