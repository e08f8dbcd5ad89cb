//! A semicircle from two points and one vector, printed as an SVG document, with the major arc and the features of its
//! conic in comments.
//!
//! `cargo run -p bezier-mass --example semicircle > semicircle.svg`

use bezier_mass::glam::dvec2;
use bezier_mass::{Conic, Error, MassPoint, Quadratic};

fn main() -> Result<(), Error> {
    // The vector (0, 1) in the middle: no weight, no trigonometry.
    let upper = Quadratic::new([
        MassPoint::point(dvec2(1.0, 0.0), 1.0),
        MassPoint::vector(dvec2(0.0, 1.0)),
        MassPoint::point(dvec2(-1.0, 0.0), 1.0),
    ])?;
    println!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.2 -1.2 2.4 2.4">"#);
    if let Conic::Circle(circle) = upper.conic() {
        println!(
            "<!-- an arc of the circle about {} with radius {} -->",
            circle.centre, circle.radius
        );
    }
    for (arc, colour) in [(upper, "#0072b2"), (upper.complement(), "#d55e00")] {
        let points = (0..=60)
            .map(|i| arc.point(f64::from(i) / 60.0))
            .collect::<Result<Vec<_>, _>>()?;
        let points: Vec<String> = points
            .iter()
            .map(|p| format!("{:.4},{:.4}", p.x, -p.y))
            .collect();
        println!(
            r#"<polyline fill="none" stroke="{colour}" stroke-width="0.03" points="{}"/>"#,
            points.join(" ")
        );
    }
    println!("</svg>");
    Ok(())
}
