//! Blends a cone and a cylinder, walks through the family, and prints where its type changes.
//!
//! `cargo run -p cyclide --example blend_two_cones`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use cyclide::glam::DVec3;
use cyclide::{Cone, Error, RingPreference, classify};

fn main() -> Result<(), Error> {
    // Both touch the unit sphere about the origin; the axes make an angle of 64 degrees.
    let cylinder = Cone::cylinder(DVec3::ZERO, DVec3::Z, 1.0)?;
    let axis = DVec3::new(0.9, 0.0, 0.436).normalize();
    let cone = Cone::new(-axis / 0.3_f64.sin(), axis, 0.3)?;

    let found = classify(&cylinder, &cone);
    println!("class: {}", found.class());
    for sphere in found.common_spheres() {
        println!(
            "common inscribed sphere: radius {:.3} about {:.3}",
            sphere.radius, sphere.centre
        );
    }
    for (index, family) in found.families().iter().enumerate() {
        println!(
            "family {index}, touching along circles of the {:?}:",
            family.conic()
        );
        for interval in family.intervals() {
            println!(
                "  1/t from {:8.3} to {:8.3}: {}",
                interval.from, interval.to, interval.kind
            );
        }
        let blend = family.ring_blend(RingPreference::Widest)?;
        println!(
            "  widest ring at t = {:.3}, G1 residual {:.1e}",
            blend.parameter(),
            blend.residual()
        );
        for tube in blend.tubes().into_iter().flatten() {
            println!(
                "  tube continuing the sides {:?} of the cones: {} patches",
                tube.sides(),
                tube.patches()?.len()
            );
        }
    }
    Ok(())
}
