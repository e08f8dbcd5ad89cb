//! A closed curve through points with a family of offsets, printed as an SVG picture.
//!
//! `cargo run -p ph-curves --features kurbo --example offset_family > family.svg`
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example talks to the user"
)]

use ph_curves::glam::dvec2;
use ph_curves::{Approximation, CubicPath, Error, approximate};

fn main() -> Result<(), Error> {
    let points = [
        dvec2(0.0, 0.0),
        dvec2(50.0, 12.0),
        dvec2(95.0, -5.0),
        dvec2(100.0, 45.0),
        dvec2(60.0, 35.0),
        dvec2(10.0, 60.0),
    ];
    let outline = CubicPath::through(&points, true)?;
    let result = approximate(&outline, &Approximation::within(1e-4))?;
    println!(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-40 -45 180 150' fill='none' stroke='#0072b2'>"
    );
    for step in -6..=6 {
        for chain in result.spline.trimmed_offset(f64::from(step) * 4.0)? {
            println!(
                "<path d='{}' stroke-width='0.5'/>",
                chain.to_kurbo(1e-3)?.to_svg()
            );
        }
    }
    println!("</svg>");
    eprintln!(
        "{} arcs, error {:.1e}, {} joints G1 only",
        result.spline.pieces().len(),
        result.error,
        result.g1_joints
    );
    Ok(())
}
