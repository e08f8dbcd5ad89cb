//! A horn of three cyclide pieces with common tangent planes, printed as a Wavefront OBJ mesh.
//!
//! `cargo run -p lorentz --example horn > horn.obj`
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example talks to the user"
)]

use lorentz::glam::{DVec3, dvec3};
use lorentz::{CanalChain, CanalCurve, Plane, Point, Sphere, SphereVector, TubeGrid, construct};

fn main() -> Result<(), lorentz::Error> {
    let mut sphere = SphereVector::from(Sphere::new(DVec3::ZERO, 1.0)?);
    let mut derivative = SphereVector::from(Plane::new(DVec3::Z, DVec3::ZERO)?);
    let mut pieces: Vec<CanalCurve> = Vec::new();
    for (centre, radius) in [(dvec3(0.4, 0.0, 2.0), 0.9), (dvec3(2.4, 0.0, 3.4), 0.7)] {
        let next = SphereVector::from(Sphere::new(centre, radius)?);
        let piece = construct::circle_to_sphere(sphere, derivative, next)?.curve;
        derivative = piece
            .at(1.0)
            .derivative_sphere()
            .ok_or(lorentz::Error::SingularJoint)?;
        sphere = next;
        pieces.push(piece);
    }
    // The tip must lie on the far side of the last circle: the arc leaves towards it.
    let tip = Point::new(dvec3(4.2, 0.0, 2.2))?;
    pieces.push(construct::circle_to_point(sphere, derivative, tip)?.curve);
    let chain = CanalChain::new(pieces)?;
    for (i, joint) in chain.joints()?.iter().enumerate() {
        eprintln!(
            "joint {}: {:?}, gap {:.1e}, angle {:.1e} rad",
            i + 1,
            joint.course,
            joint.gap,
            joint.angle
        );
    }
    let mut first = 1;
    for arc in chain.arcs() {
        let tube = arc.tessellate(&TubeGrid::new(48, 48).with_reference(DVec3::Y))?;
        for (p, n) in tube.positions().iter().zip(tube.normals()) {
            println!("v {} {} {}\nvn {} {} {}", p.x, p.y, p.z, n.x, n.y, n.z);
        }
        for triangle in tube.triangles() {
            let [a, b, c] = triangle.map(|i| i + first);
            println!("f {a}//{a} {b}//{b} {c}//{c}");
        }
        first += tube.positions().len() as u32;
    }
    Ok(())
}
