//! Isolines on the torus of the real meshes, when `MESH_DIR` names the folder that holds it: it is closed, and so are its lines.

use geodesic::{Mesh, Sweep};
use integration_tests::mesh_folder;

#[test]
fn lines_of_a_closed_mesh_are_closed() {
    let Some(folder) = mesh_folder() else {
        println!("isolines_of_a_real_mesh: MESH_DIR is not set, the real mesh is not looked at");
        return;
    };
    let mesh = Mesh::read_obj(folder.join("torus.obj")).expect("the mesh");
    let tolerance = 1e-3 * mesh.diameter();
    let mut sweep = Sweep::new(&mesh);
    let mut open = Vec::new();
    let mut count = 0;
    for k in 0..40_u32 {
        let source = (1372 + 1013 * k) % mesh.vertex_count() as u32;
        let field = sweep.from_points(&[source.into()]).expect("distances");
        let farthest = field.vertex_distances().iter().copied().fold(0.0, f64::max);
        let level = if k == 0 {
            1.020_355_469_325_002_8
        } else {
            farthest * (0.1 + 0.8 * f64::from(k) / 40.0)
        };
        for line in field.isolines(level, tolerance).expect("lines") {
            count += 1;
            if !line.is_closed {
                let ends = [line.positions[0], line.positions[line.positions.len() - 1]];
                open.push((source, level, line.points.len(), ends[0].distance(ends[1])));
            }
        }
    }
    assert!(
        count >= 40 && open.is_empty(),
        "{} of {count} are open: {open:?}",
        open.len()
    );
}
