//! A rational curve met by a pencil of parallel lines: the bound without solving beside the hits.
//!
//! `cargo run -p variation --example line_hits`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use glam::DVec2;
use variation::{Curve, Error, Line, sign_changes};

fn main() -> Result<(), Error> {
    let points = [(0.0, 0.0), (1.0, 3.0), (2.0, -2.0), (3.0, 3.0), (4.0, 0.0)].map(DVec2::from);
    let curve = Curve::rational(&points, &[1.0, 2.0, 1.5, 2.0, 1.0])?;
    println!(
        "{:>6} {:>8} {:>9} {:>5}  hits",
        "height", "polygon", "one pole", "hits"
    );
    for k in -4..=12 {
        let height = 0.25 * f64::from(k);
        let line = Line::try_new(0.0, 1.0, -height)?;
        let polygon = sign_changes(&curve.line_coefficients(line));
        let refined = curve.line_bound(line, &[0.5])?.best;
        let hits = curve.meet_line(line)?;
        let at: Vec<String> = hits
            .iter()
            .map(|hit| format!("({:.6}, {:.6})", hit.point.x, hit.point.y))
            .collect();
        println!(
            "{height:>6.2} {polygon:>8} {refined:>9} {:>5}  {}",
            hits.len(),
            at.join(" ")
        );
    }
    Ok(())
}
