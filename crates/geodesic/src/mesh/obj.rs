//! OBJ files, by tobj.

use std::path::Path;

use glam::DVec3;

use super::{Mesh, TriangleSoup};
use crate::Error;

impl Mesh {
    /// Reads an OBJ file; see [`TriangleSoup::read_obj`] for what is taken from it.
    ///
    /// # Errors
    ///
    /// Those of [`TriangleSoup::read_obj`] and [`Mesh::new`].
    pub fn read_obj(path: impl AsRef<Path>) -> Result<Self, Error> {
        TriangleSoup::read_obj(path)?.try_into()
    }
}

impl TriangleSoup {
    /// Reads an OBJ file: vertices in file order, faces with more than three corners cut into a fan from their first
    /// corner. Groups, materials, normals, texture coordinates and vertex colours are skipped.
    ///
    /// # Errors
    ///
    /// [`Error::Obj`] if the file cannot be opened or parsed, or a face names a vertex that does not exist.
    pub fn read_obj(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = std::fs::read(path).map_err(|e| Error::Obj {
            reason: format!("{}: {e}", path.display()),
        })?;
        Self::parse_obj(&text)
    }

    /// As [`TriangleSoup::read_obj`], from the text of the file.
    ///
    /// # Errors
    ///
    /// Those of [`TriangleSoup::read_obj`].
    pub fn parse_obj(text: &[u8]) -> Result<Self, Error> {
        let (text, vertices) = prepare(text);
        // The default options keep faces as they are and number positions alone.
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_slice(), &tobj::LoadOptions::default(), |_| {
                Err(tobj::LoadError::OpenFileFailed)
            })
            .map_err(|e| Error::Obj {
                reason: e.to_string(),
            })?;
        let Some(tobj::Model { mesh, .. }) = models.into_iter().next() else {
            return Ok(Self::default());
        };
        let positions = mesh
            .positions
            .chunks_exact(3)
            .map(DVec3::from_slice)
            .collect();
        Ok(Self {
            positions,
            faces: fans(&mesh.indices, &mesh.face_arities, vertices)?,
        })
    }
}

/// The lines that matter, after a face that names every vertex, and the number of vertices.
///
/// tobj begins a new model at every group and numbers its vertices in the order in which faces use them. Without the
/// groups and with a first face that names all vertices in turn, the numbers are those of the file, and vertices without
/// faces are kept.
fn prepare(text: &[u8]) -> (Vec<u8>, usize) {
    let mut geometry = Vec::with_capacity(text.len());
    let mut vertices = 0;
    for line in text.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii) {
        match line {
            [b'v', b' ' | b'\t', ..] => {
                vertices += 1;
                geometry.extend_from_slice(without_colour(line));
                geometry.push(b'\n');
            }
            [b'f', b' ' | b'\t', ..] => {
                geometry.extend_from_slice(line);
                geometry.push(b'\n');
            }
            _ => {}
        }
    }
    let mut prepared = Vec::with_capacity(geometry.len() + 8 * vertices + 2);
    prepared.push(b'f');
    for v in 1..=vertices {
        prepared.extend_from_slice(format!(" {v}").as_bytes());
    }
    prepared.push(b'\n');
    prepared.append(&mut geometry);
    (prepared, vertices)
}

/// `v x y z r g b` without the colour, which tobj insists on for all vertices or none.
fn without_colour(line: &[u8]) -> &[u8] {
    let gap = |i: usize| line[i].is_ascii_whitespace() && !line[i - 1].is_ascii_whitespace();
    let mut ends = (1..line.len()).filter(|&i| gap(i));
    match (ends.nth(3), ends.next()) {
        (Some(coordinates), Some(_)) => &line[..coordinates],
        _ => line,
    }
}

/// The faces after the first, cut into fans.
fn fans(indices: &[u32], arities: &[u32], vertices: usize) -> Result<Vec<[u32; 3]>, Error> {
    let corners = indices.get(vertices..).unwrap_or_default();
    if arities.is_empty() {
        return Ok(corners.as_chunks().0.to_vec());
    }
    let mut triangles = Vec::with_capacity(corners.len() / 2);
    let mut rest = corners;
    for (face, &arity) in arities.iter().skip(1).enumerate() {
        let Some((polygon, others)) = rest.split_at_checked(arity as usize) else {
            break;
        };
        rest = others;
        let [first, chain @ ..] = polygon else {
            continue;
        };
        if chain.len() < 2 {
            return Err(Error::NotATriangle {
                face: face as u32,
                corners: polygon.len(),
            });
        }
        triangles.extend(chain.windows(2).map(|side| [*first, side[0], side[1]]));
    }
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_file_order_and_unused_vertices_and_cuts_polygons() {
        let text = b"# a comment\nmtllib nowhere.mtl\no thing\nv 9 9 9\nv 0 0 0 0.5 0.5 0.5\n\tv 1 0 0\r\nv 1 1 0\nv 0 1 0\n\
            vt 0 0\nvn 0 0 1\ng a\nusemtl m\nf 5/1/1 2/1/1 3/1/1 4/1/1\ng b\nv 2 0 0\nf -1 -3 -4\n";
        let soup = TriangleSoup::parse_obj(text).unwrap();
        assert_eq!(soup.positions[0], DVec3::splat(9.0));
        assert_eq!(soup.positions[2], DVec3::X);
        assert_eq!(soup.positions.len(), 6);
        assert_eq!(soup.faces, [[4, 1, 2], [4, 2, 3], [5, 3, 2]]);
    }

    #[test]
    fn hostile_files_are_refused() {
        for text in [
            "v 0 0\n",
            "v 0 0 0\nf 1 2 3\n",
            "v a b c\n",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n",
            "f\n",
            "f 0 0 0\n",
            "v 1 2 3\nf 1",
        ] {
            let result = TriangleSoup::parse_obj(text.as_bytes()).and_then(Mesh::try_from);
            assert!(result.is_err(), "{text:?}");
        }
        assert_eq!(
            TriangleSoup::parse_obj(b"").and_then(Mesh::try_from),
            Err(Error::EmptyMesh)
        );
        assert!(Mesh::read_obj("/nowhere/at/all.obj").is_err());
    }
}
