//! A rational curve as a path of cubics, with a certified accuracy (feature `kurbo`).
//!
//! `cargo run -p bezier-mass --features kurbo --example kurbo_path`

use bezier_mass::glam::dvec2;
use bezier_mass::{Error, Quadratic, path};

fn main() -> Result<(), Error> {
    let ends = [dvec2(1.0, 0.0), dvec2(-1.0, 0.0)];
    let arc = Quadratic::circular_arc(dvec2(0.0, 0.0), ends, [1.0, 1.0])?;
    for accuracy in [1e-2, 1e-4, 1e-6, 1e-8] {
        let path = path::path_of(&[arc.into()], accuracy)?;
        println!("within {accuracy:e}: {} cubics", path.segments().count());
    }
    println!("{}", path::path_of(&[arc.into()], 1e-2)?.to_svg());
    Ok(())
}
