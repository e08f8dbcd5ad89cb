//! A Bézier patch on boundaries that are geodesics of it, from what is known at its corners.
//!
//! `cargo run -p reconstruct --example patch`
#![expect(clippy::print_stdout, reason = "an example talks to the user")]

use glam::DVec3;
use reconstruct::{
    BezierStrip, CornerData, Criterion, Degree7Shape, Error, Rectangle,
    boundary_geodesic_curvature, degree7_boundaries,
};

/// Point, tangent plane and normal curvatures of the paraboloid `z = (x² + y²) / 4`.
fn corner(x: f64, y: f64) -> Result<CornerData, Error> {
    let (u, v) = (DVec3::new(1.0, 0.0, 0.5 * x), DVec3::new(0.0, 1.0, 0.5 * y));
    let normal = u.cross(v);
    let curvature = |t: DVec3| 0.5 / (normal.length() * t.length_squared());
    let point = DVec3::new(x, y, 0.25 * (x * x + y * y));
    CornerData::new(point, normal, [u, v], [curvature(u), curvature(v)])
}

fn main() -> Result<(), Error> {
    let corners = [
        [corner(0.1, -0.2)?, corner(0.0, 1.1)?],
        [corner(1.2, 0.0)?, corner(1.0, 1.0)?],
    ];
    let [r1, r2, r3, r4] =
        degree7_boundaries(&corners, &Degree7Shape::default())?.map(BezierStrip::new);
    let rectangle = Rectangle::new([r1?, r2?, r3?, r4?])?;
    println!(
        "C1, C2, C3 hold: residual of C3 {:.1e}, {} reversals",
        rectangle.report().c3_residual,
        rectangle.report().reversals
    );
    for criterion in [Criterion::Dirichlet, Criterion::ThinPlate] {
        let smoothed = rectangle.smoothest(criterion)?;
        let patch = smoothed.patch.to_bezier()?;
        println!(
            "{criterion:?}: energy {:.6} (from {:.6}), bidegree {:?}, boundary geodesic curvature {:.1e}",
            smoothed.energy,
            smoothed.energy_at_zero,
            patch.degrees(),
            boundary_geodesic_curvature(&patch, 50)
        );
    }

    // Turn the bend of one curve around at one corner: the normal cannot be carried around any more.
    let [k, l] = corners[1][1].curvatures();
    let old = corners[1][1];
    let mut bad = corners;
    bad[1][1] = CornerData::new(old.point(), old.normal(), old.tangents(), [-k, l])?;
    let [r1, r2, r3, r4] =
        degree7_boundaries(&bad, &Degree7Shape::default())?.map(BezierStrip::new);
    if let Err(error) = Rectangle::new([r1?, r2?, r3?, r4?]) {
        println!("refused: {error}");
    }
    Ok(())
}
