//! Geodesics of smooth surfaces: on a NURBS patch from polyhedron to polyhedron and by the differential equation, and on a
//! Catmull-Clark surface.
//!
//! `cargo run --release -p geodesic --example smooth_surfaces`

use std::error::Error;

use geodesic::bezier_mass::{BSplineSurface, Knots, MassPoint};
use geodesic::glam::{DVec2, DVec3};
use geodesic::{PatchLevels, SubdivisionSurface, geodesic_between, shapes, trace_smooth};

fn main() -> Result<(), Box<dyn Error>> {
    // A bump, of degrees 3 and 2 with two spans each way.
    let knots = [
        Knots::clamped(3, &[0.0, 1.0, 2.0])?,
        Knots::clamped(2, &[0.0, 1.0, 2.0])?,
    ];
    let control = (0..20)
        .map(|k| {
            let (x, y) = (f64::from(k / 4), f64::from(k % 4));
            let height = 2.5 * (-(x - 2.0).powi(2) - (y - 1.5).powi(2)).exp();
            MassPoint::point(DVec3::new(x, y, height), 1.0)
        })
        .collect();
    let surface = BSplineSurface::new(knots, control)?;
    let (from, to) = (DVec2::new(0.25, 0.25), DVec2::new(1.75, 1.5));

    println!("control polyhedra of a NURBS patch:");
    let paths = PatchLevels::of_spline(&surface).paths(from, to, 6)?;
    let smooth = geodesic_between(&surface, &paths[6].parameters, 1e-11)?;
    for (level, path) in paths.iter().enumerate() {
        let error = path.length - smooth.length;
        println!(
            "  level {level}: {:6} faces, length {:.8}, error {error:+.1e}",
            path.faces, path.length
        );
    }
    println!(
        "  by the equation: length {:.8}, residual {:.0e}, conjugate points: {}",
        smooth.length, smooth.residual, smooth.conjugate_points
    );
    // Traced from its beginning alone it arrives at the other end.
    let end = trace_smooth(&surface, smooth.nodes[0], smooth.length, 1e-13)?;
    println!(
        "  traced from one end it misses the other by {:.0e}",
        end.uv.distance(to)
    );

    println!("a cube subdivided by Catmull and Clark's scheme, from corner to opposite corner:");
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let ball = SubdivisionSurface::catmull_clark(shapes::cube()?.positions(), &quads)?
        .with_vertices_on_limit(true)?;
    let (path, convergence) = ball.path_within(0.into(), 7.into(), 1e-4)?;
    for (level, length) in convergence.lengths.iter().enumerate() {
        println!("  level {level}: length {length:.6}");
    }
    println!(
        "  {} points, estimated error {:.0e}, order {:.2}",
        path.positions().len(),
        convergence.error(),
        convergence.order().unwrap_or(f64::NAN)
    );
    Ok(())
}
