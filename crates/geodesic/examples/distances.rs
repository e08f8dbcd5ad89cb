//! Exact distances from one vertex of an OBJ file to all others, and the time that the sweep took.
//!
//! `cargo run --release -p geodesic --example distances -- mesh.obj 0`

use std::time::Instant;

use geodesic::{Mesh, SurfacePoint, Sweep, shapes};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mesh = match arguments.next() {
        Some(file) => Mesh::read_obj(file)?,
        None => shapes::sphere(5)?,
    };
    let vertex: u32 = arguments.next().map_or(Ok(0), |text| text.parse())?;
    let mut sweep = Sweep::new(&mesh);
    let started = Instant::now();
    let field = sweep.from_points(&[SurfacePoint::Vertex(vertex)])?;
    let farthest = field
        .vertex_distances()
        .iter()
        .copied()
        .filter(|d| d.is_finite())
        .fold(0.0, f64::max);
    println!(
        "{} triangles, farthest vertex at {farthest}",
        mesh.face_count()
    );
    println!(
        "{:.3} s, {} windows, {} MB",
        started.elapsed().as_secs_f64(),
        sweep.window_count(),
        sweep.bytes() >> 20
    );
    Ok(())
}
