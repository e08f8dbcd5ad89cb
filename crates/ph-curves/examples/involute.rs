//! The Tschirnhausen cubic in a triangle, its involutes, and the caustic of a parabola.
//!
//! `cargo run -p ph-curves --example involute`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use ph_curves::glam::dvec2;
use ph_curves::{Error, TCubic};

fn main() -> Result<(), Error> {
    let cubic = TCubic::in_triangle(dvec2(0.0, 0.0), dvec2(2.0, 0.0), dvec2(1.4, 1.3))?;
    println!("control points {:?}", cubic.points());
    println!("arc length     {}", cubic.length());
    for radius in [3.0, 4.0] {
        let arc = cubic.involute(radius)?;
        let [start, end] = arc.end_radii();
        println!(
            "involute: radius {start:.6} to {end:.6}, length {:.6}, point form of degree 4",
            arc.length()
        );
    }
    let caustic = TCubic::parabola_caustic(0.25, dvec2(0.6, -0.8), 0.0, 1.0)?;
    println!(
        "caustic of y = x^2 under light along (0.6, -0.8): {:?}",
        caustic.points()
    );
    Ok(())
}
