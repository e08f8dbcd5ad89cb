//! `index.html`: one file that opens from the file system, without scripts or anything from elsewhere.

use std::fmt::Write;

use super::Outcome;
use crate::figure::escape;
use crate::report::{Measured, Report, Target, plain};

const STYLE: &str = include_str!("page.css");

/// The page over all demos.
pub(super) fn html(outcomes: &[Outcome], quick: bool) -> String {
    let papers = papers(outcomes);
    let good = outcomes.iter().filter(|o| o.is_good()).count();
    let reports = || outcomes.iter().filter_map(|o| o.result.as_ref().ok());
    let numbers = || {
        reports()
            .flat_map(|r| &r.numbers)
            .filter(|n| n.target != Target::Free)
    };
    let met = numbers().filter(|n| n.is_met()).count();
    let seconds: f64 = reports().map(|r| r.seconds).sum();
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Envelope geometry: gallery</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <header>\n<h1>Envelope geometry</h1>\n\
         <p class=\"lead\">Canal surfaces, dual curves, wavefronts, geodesics, root bounds: figures of four papers, \
         recomputed. Beside each picture stand the numbers measured on the computed geometry and what they should be.</p>\n\
         <p class=\"sum\"><span class=\"{}\">{good} of {} demos</span> <span class=\"{}\">{met} of {} targets</span> \
         <span>{seconds:.1} s{}</span></p>\n",
        verdict(good == outcomes.len()),
        outcomes.len(),
        verdict(met == numbers().count()),
        numbers().count(),
        if quick {
            ", small version (<code>--quick</code>)"
        } else {
            ""
        },
    );
    out.push_str(&contents(&papers));
    out.push_str("</header>\n<main>\n");
    for (paper, outcomes) in &papers {
        // Writing to a String cannot fail.
        let _ = writeln!(out, "<h2 class=\"paper\">{}</h2>", escape(&title(paper)));
        for outcome in outcomes {
            out.push_str(&section(outcome));
        }
    }
    out.push_str("</main>\n<footer><p>Written by <code>cargo xtask gallery</code>. Every demo also runs alone: <code>cargo xtask demo NAME</code>.</p></footer>\n</body>\n</html>\n");
    out
}

const fn verdict(good: bool) -> &'static str {
    if good { "good" } else { "bad" }
}

/// The outcomes by paper (what stands before the comma), papers in the order in which they appear.
fn papers(outcomes: &[Outcome]) -> Vec<(&str, Vec<&Outcome>)> {
    let mut papers: Vec<(&str, Vec<&Outcome>)> = Vec::new();
    for outcome in outcomes {
        let paper = outcome
            .entry
            .paper
            .split(',')
            .next()
            .unwrap_or_default()
            .trim();
        match papers.iter_mut().find(|(known, _)| *known == paper) {
            Some((_, members)) => members.push(outcome),
            None => papers.push((paper, vec![outcome])),
        }
    }
    papers
}

/// `mass-points-and-spheres` as words.
fn title(paper: &str) -> String {
    let words = paper.replace('-', " ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn contents(papers: &[(&str, Vec<&Outcome>)]) -> String {
    let mut out = String::from("<nav aria-label=\"Demos\">\n");
    for (_, outcomes) in papers {
        out.push_str("<p>");
        for outcome in outcomes {
            let name = outcome.entry.name;
            let _ = write!(
                out,
                "<a class=\"{}\" href=\"#{name}\">{name}</a> ",
                verdict(outcome.is_good())
            );
        }
        out.push_str("</p>\n");
    }
    out.push_str("</nav>\n");
    out
}

fn section(outcome: &Outcome) -> String {
    let entry = &outcome.entry;
    let name = entry.name;
    let mut out = format!(
        "<section id=\"{name}\">\n<h3><a href=\"#{name}\">{name}</a></h3>\n\
         <p class=\"about\">{} <span class=\"answers\">{}</span></p>\n",
        escape(entry.about),
        escape(entry.paper)
    );
    match &outcome.result {
        Err(error) => {
            let _ = writeln!(
                out,
                "<p class=\"failure\">Failed: {}</p>",
                escape(&format!("{error:#}"))
            );
        }
        Ok(report) => {
            out.push_str(&pictures(report));
            out.push_str(&numbers(&report.numbers));
            out.push_str(&files(report));
        }
    }
    out.push_str("</section>\n");
    out
}

fn pictures(report: &Report) -> String {
    let count = if report.pictures.len() == 1 {
        "one"
    } else {
        "many"
    };
    let mut out = format!("<div class=\"pictures {count}\">\n");
    for picture in &report.pictures {
        let file = format!("{}/{}", report.demo, picture.file);
        let _ = writeln!(
            out,
            "<figure><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=\"lazy\"></a><figcaption>{2}</figcaption></figure>",
            escape(&file),
            escape(&picture.alt),
            escape(&picture.caption)
        );
    }
    out.push_str("</div>\n");
    out
}

fn numbers(numbers: &[Measured]) -> String {
    if numbers.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "<table>\n<thead><tr><th>number</th><th>measured</th><th>target</th><th></th></tr></thead>\n<tbody>\n",
    );
    for number in numbers {
        let (class, mark) = match (&number.target, number.is_met()) {
            (Target::Free, _) => ("free", ""),
            (_, true) => ("good", "✓ met"),
            (_, false) => ("bad", "✗ missed"),
        };
        let _ = writeln!(
            out,
            "<tr class=\"{class}\"><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{mark}</td></tr>",
            escape(&number.key),
            escape(&shortened(&plain(&number.value))),
            escape(&shortened(&number.target.to_string()))
        );
    }
    out.push_str("</tbody>\n</table>\n");
    out
}

/// Long arrays stand in full in report.json only.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 120;
    if text.chars().count() <= LONGEST {
        return text.into();
    }
    text.chars().take(LONGEST).chain(" …".chars()).collect()
}

fn files(report: &Report) -> String {
    let names = report
        .files
        .iter()
        .map(String::as_str)
        .chain(["report.json"]);
    let links = names.map(|file| {
        format!(
            "<a href=\"{0}/{1}\">{1}</a>",
            escape(&report.demo),
            escape(file)
        )
    });
    format!(
        "<p class=\"files\">{} <span>{:.2} s</span></p>\n",
        links.collect::<Vec<_>>().join(" "),
        report.seconds
    )
}
