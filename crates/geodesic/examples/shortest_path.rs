//! A shortest path between two vertices of an OBJ file, written as an OBJ polyline.
//!
//! `cargo run --release -p geodesic --example shortest_path -- bunny.obj 12 3400 > path.obj`
//!
//! Without arguments, a path on a torus. A file that is not a clean mesh is repaired, and what was done is said.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "an example talks to the user"
)]

use std::error::Error;

use geodesic::{Mesh, PathFinder, TriangleSoup, shapes};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (mesh, from, to) = match &arguments[..] {
        [file, from, to] => (load(file)?, from.parse()?, to.parse()?),
        [] => (shapes::torus(2.0, 0.7, 48, 24)?, 0, 600),
        _ => return Err("give a file and two vertex numbers, or nothing".into()),
    };
    let mut finder = PathFinder::new(&mesh);
    let path = finder.shortest(mesh.vertex_point(from)?, mesh.vertex_point(to)?)?;
    let certificate = path.certify(&mesh)?;
    eprintln!(
        "length {}, {} faces, {} pivots",
        path.length(),
        path.faces().len(),
        path.pivots().len()
    );
    eprintln!(
        "a geodesic: {} ({certificate:?})",
        certificate.is_geodesic()
    );
    for p in path.positions() {
        println!("v {} {} {}", p.x, p.y, p.z);
    }
    let line: Vec<String> = (1..=path.positions().len())
        .map(|i| i.to_string())
        .collect();
    println!("l {}", line.join(" "));
    Ok(())
}

fn load(file: &str) -> Result<Mesh, geodesic::Error> {
    let soup = TriangleSoup::read_obj(file)?;
    if let Ok(mesh) = Mesh::new(&soup.positions, &soup.faces) {
        return Ok(mesh);
    }
    let repaired = soup.repair()?;
    eprintln!(
        "{file} is not a mesh and was repaired: {:?}",
        repaired.report
    );
    Ok(repaired.mesh)
}
