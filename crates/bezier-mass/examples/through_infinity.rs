//! A hyperbola as a semicircle of its own quadratic form: one curve that runs to infinity along an asymptote and comes back
//! on the other branch.
//!
//! `cargo run -p bezier-mass --example through_infinity`

use bezier_mass::glam::dvec2;
use bezier_mass::{Conic, Error, Half, MassPointKind, Quadratic};

fn main() -> Result<(), Error> {
    let half = Quadratic::hyperbola_as_semicircle(
        [dvec2(0.0, 0.0), dvec2(1.0, 2.0), dvec2(3.0, 0.0)],
        2.0,
        Half::Along,
    )?;
    for i in 0..=8 {
        let t = f64::from(i) / 8.0;
        match half.at(t).kind() {
            MassPointKind::Point { position, weight } => {
                println!("t = {t:5.3}: point {position:8.4}, weight {weight:7.4}")
            }
            MassPointKind::Vector(direction) => {
                println!("t = {t:5.3}: vector {direction:8.4}, at infinity")
            }
        }
    }
    if let Conic::Hyperbola(hyperbola) = half.conic() {
        println!(
            "centre {:.4}, foci {:.4?}",
            hyperbola.centre,
            hyperbola.foci()
        );
        println!(
            "eccentricity {:.6}, asymptotes {:.4?}",
            hyperbola.eccentricity(),
            hyperbola.asymptotes()
        );
    }
    Ok(())
}
