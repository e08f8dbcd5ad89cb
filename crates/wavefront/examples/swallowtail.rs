//! Parallel light in a circular mirror: the front folds at the caustic and runs on; printed as an SVG picture.
//!
//! `cargo run -p wavefront --example swallowtail > swallowtail.svg`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use wavefront::glam::{DVec2, dvec2};
use wavefront::{
    Code, Error, Fan, FanOptions, FrontTolerance, Interface, Medium, Mode, Model, Source, Step,
};

fn main() -> Result<(), Error> {
    let medium = Medium::isotropic(1.0)?;
    let mirror = Interface::circle(DVec2::ZERO, 1.0)?;
    let corner = DVec2::splat(1.5);
    let model = Model::try_new(-corner, corner, vec![medium.clone(), medium], vec![mirror])?;
    let beam = Source::Plane {
        ends: [dvec2(0.0, -0.98), dvec2(0.0, 0.98)],
        towards: DVec2::X,
    };
    let code = Code {
        steps: vec![Step {
            interface: 0,
            mode: Mode::Reflect,
        }],
    };
    let fan = Fan::new(&model, beam, code, FanOptions::default())?;

    println!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.05 -1.05 2.1 2.1" fill="none">"#
    );
    println!(r#"<circle r="1" stroke="black" stroke-width="0.012"/>"#);
    for front in fan.fronts(FrontTolerance::time(1e-7))? {
        // The caustic is a chain of Bézier cubics, the evolutes of the front's arcs.
        for ([a, b, c, d], _) in front.caustic() {
            println!(
                r#"<path d="M {} {} C {} {} {} {} {} {}" stroke="orangered" stroke-width="0.015"/>"#,
                a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y
            );
        }
        for step in 1..=8 {
            let time = 0.25 * f64::from(step);
            for stretch in front.snapshot_inside(&model, time, 24) {
                let points: Vec<String> =
                    stretch.iter().map(|p| format!("{},{}", p.x, p.y)).collect();
                let points = points.join(" ");
                println!(
                    r#"<polyline points="{points}" stroke="royalblue" stroke-width="0.008"/>"#
                );
            }
            for cusp in front.cusps(time) {
                println!(
                    r#"<circle cx="{}" cy="{}" r="0.014" fill="black"/>"#,
                    cusp.point.x, cusp.point.y
                );
            }
        }
    }
    println!("</svg>");
    Ok(())
}
