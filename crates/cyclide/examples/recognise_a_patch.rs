//! Recovers a surface from the nine control points of one of its patches, and says what is wrong with a net that is none.
//!
//! `cargo run -p cyclide --example recognise_a_patch`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use cyclide::glam::{DVec3, dvec3};
use cyclide::{Dupin, Error, Frame, convert, inspect};

fn main() -> Result<(), Error> {
    let frame = Frame::from_directions(dvec3(1.0, 2.0, -1.0), dvec3(1.0, 1.0, 0.0), DVec3::Z)
        .unwrap_or_default();
    let horned = Dupin::quartic(3.0, 2.0, 1.0, frame)?;
    let net = *horned.patch([2.0, 3.4], [1.5, 3.0])?.net();

    let found = convert(&net)?;
    println!(
        "{} at {:.3}, rebuilt to {:.1e}",
        found.kind(),
        found.surface.frame().origin(),
        found.residual
    );
    println!(
        "theta from {:.3} to {:.3}, psi from {:.3} to {:.3}",
        found.first[0], found.first[1], found.second[0], found.second[1]
    );

    let mut control = *net.control();
    control[1][1] = control[1][1] * 1.02;
    let spoilt = bezier_mass::Biquadratic::new(control)?;
    if let Err(error) = convert(&spoilt) {
        println!("two percent off: {error}");
    }
    for (condition, residual) in inspect(&spoilt)?.residuals() {
        println!("  {condition}: {residual:.1e}");
    }
    Ok(())
}
