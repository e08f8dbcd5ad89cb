//! A horned cyclide and the cone that it becomes when an inversion sends one of its singular points to infinity.
//!
//! `cargo run -p lorentz --example inversion`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use lorentz::glam::dvec3;
use lorentz::{LorentzMap, Point, Sphere, construct};

fn main() -> Result<(), lorentz::Error> {
    let (here, there) = (
        Point::new(dvec3(-1.0, 0.0, 0.0))?,
        Point::new(dvec3(1.0, 0.0, 0.0))?,
    );
    let sphere = Sphere::new(dvec3(0.0, 0.0, 1.2), 0.5)?;
    let horn = construct::between_points(here, there, sphere.into())?.curve;
    println!("between two points: {}", horn.curve().classify().kind);

    let map = LorentzMap::sending_to_infinity(there, 2.0)?;
    let image = horn.mapped(&map)?;
    println!(
        "one of them sent to infinity: {}",
        image.curve().classify().kind
    );
    println!("vertex of the cone: {:?}", map.map_point(here)?.position());
    println!(
        "both singular points: {:?} and {:?}",
        image.at(0.0).vertex(),
        image.at(1.0).vertex()
    );

    let back = image.mapped(&map.inverse())?;
    println!("and back: {}", back.curve().classify().kind);
    Ok(())
}
