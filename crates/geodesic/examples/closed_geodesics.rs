//! Closed geodesics of a torus by class, and loops through a point in a direction.
//!
//! `cargo run --release -p geodesic --example closed_geodesics`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use geodesic::glam::DVec3;
use geodesic::{Error, LoopFinder, SurfacePoint, TorusClasses, shapes};

fn main() -> Result<(), Error> {
    let (around, tube) = (64, 32);
    let torus = shapes::torus(2.0, 0.7, around, tube)?;
    let parallel: Vec<SurfacePoint> = (0..around).map(SurfacePoint::Vertex).collect();
    let meridian: Vec<SurfacePoint> = (0..tube)
        .map(|j| SurfacePoint::Vertex(j * around))
        .collect();
    let mut classes = TorusClasses::new(&torus, &parallel, &meridian)?;
    println!("closed geodesics that turn p times around the axis and q times around the tube:");
    for (p, q) in [(1, 0), (0, 1), (1, 1), (1, 2), (2, 1)] {
        let geodesic = classes.shortest(p, q)?;
        let straight = geodesic.certify(&torus)?.is_geodesic();
        println!(
            "  ({p}, {q}): length {:.5}, a geodesic: {straight}",
            geodesic.length()
        );
    }

    let start = torus.edge_point(0, 1, 0.5)?;
    let direction = DVec3::new(0.0, 1.0, 1.0);
    println!("loops through a point of the outer equator, nearest to a slope of one:");
    for answer in LoopFinder::new(&torus)
        .through(start, direction, 80.0, 0.2)?
        .iter()
        .take(4)
    {
        println!(
            "  length {:.4}, off the direction by {:.4} rad, closing with a corner of {:.4} rad",
            answer.geodesic.length(),
            answer.direction_residual,
            answer.closing_residual
        );
    }
    Ok(())
}
