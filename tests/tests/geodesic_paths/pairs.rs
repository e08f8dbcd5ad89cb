//! Exact distances between vertices of real meshes.

use geodesic::{Mesh, SurfacePoint, Sweep};
use integration_tests::Case;

/// The exact lengths of a mesh of `geodesic-pairs.json`: the distance, and the path that is traced back from it.
pub(crate) fn exact(case: &Case<'_>, mesh: &Mesh) {
    let mut sweep = Sweep::new(mesh);
    for pair in case.expected()["pairs"]
        .as_array()
        .expect("a list of pairs")
    {
        let number = |key: &str| pair[key].as_f64().expect("a number");
        let [from, to] = ["source", "target"].map(|key| SurfacePoint::Vertex(number(key) as u32));
        let what = format!("{} to {}", pair["source"], pair["target"]);
        match sweep.shortest_path(from, to) {
            Err(error) => case.fail(format!("{what}: {error}")),
            Ok(path) => {
                // The path is laid through the faces that the windows passed; its length is that of the unfolded strip.
                let (length, exact) = (path.length(), number("exact"));
                let close = (length - exact).abs() <= 1e-9 * exact;
                case.require(close, &format!("{what}: {length}, exact {exact}"));
            }
        }
    }
}
