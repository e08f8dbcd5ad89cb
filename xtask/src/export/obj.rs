//! Wavefront OBJ.

use std::fmt::Write;

use anyhow::Result;

use super::Part;

/// The parts as OBJ: positions with all their digits, normals, triangles, an object per part.
///
/// # Errors
/// As [`Mesh::check`](crate::mesh::Mesh::check).
pub fn obj(parts: &[Part<'_>]) -> Result<String> {
    let mut out = String::from("# z is up, right-handed\n");
    let mut first = 1;
    for part in parts {
        part.mesh.check()?;
        // A blank would end the name.
        writeln!(out, "o {}", part.name.replace(char::is_whitespace, "_"))?;
        for p in &part.mesh.positions {
            writeln!(out, "v {} {} {}", p.x, p.y, p.z)?;
        }
        for n in &part.mesh.normals {
            writeln!(out, "vn {:.6} {:.6} {:.6}", n.x, n.y, n.z)?;
        }
        for triangle in &part.mesh.triangles {
            let [a, b, c] = triangle.map(|i| i as usize + first);
            writeln!(out, "f {a}//{a} {b}//{b} {c}//{c}")?;
        }
        first += part.mesh.positions.len();
    }
    Ok(out)
}
