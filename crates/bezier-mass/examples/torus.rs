//! A quarter of a torus as one exact rational biquadratic patch, tessellated and printed as a Wavefront OBJ file.
//!
//! `cargo run -p bezier-mass --example torus > torus.obj`

use bezier_mass::glam::{DVec2, DVec3, dvec3};
use bezier_mass::{Biquadratic, Error, MassPoint, Quadratic};
use core::f64::consts::{FRAC_PI_2, PI};

const SIDE: usize = 33;

fn main() -> Result<(), Error> {
    // Half the tube (a vector in the middle of each row), a quarter of the way round.
    let tube = Quadratic::circular_arc_by_angles(DVec2::ZERO, 1.0, 0.0, PI)?;
    let way = Quadratic::circular_arc_by_angles(DVec2::ZERO, 1.0, 0.0, FRAC_PI_2)?;
    let net = way.control().map(|round: MassPoint<DVec2>| {
        tube.control().map(|across| {
            let radius = 3.0 * across.weight + across.weighted.x;
            let position = dvec3(
                radius * round.weighted.x,
                radius * round.weighted.y,
                across.weighted.y * round.weight,
            );
            MassPoint::from_homogeneous(round.weight * across.weight, position)
        })
    });
    let steps: Vec<f64> = (0..SIDE).map(|i| i as f64 / (SIDE - 1) as f64).collect();
    let grid = Biquadratic::new(net)?.grid(&steps, &steps)?;
    for point in &grid {
        let (p, n) = (point.position, point.normal.unwrap_or(DVec3::Z));
        println!("v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, n.x, n.y, n.z);
    }
    for corner in (0..SIDE * (SIDE - 1)).filter(|i| i % SIDE != SIDE - 1) {
        let [a, b, c, d] = [corner + 1, corner + SIDE + 1, corner + SIDE + 2, corner + 2];
        println!("f {a}//{a} {b}//{b} {c}//{c}\nf {a}//{a} {c}//{c} {d}//{d}");
    }
    Ok(())
}
