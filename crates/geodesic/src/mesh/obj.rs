//! OBJ files, by tobj.

use std::borrow::Cow;
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
    /// corner. Groups, materials, normals, texture coordinates, vertex colours and comments are skipped. A face of one or two
    /// corners becomes a triangle that repeats its last one, which [`Mesh::new`] refuses and [`TriangleSoup::repair`] drops.
    ///
    /// Lines may end as on any system, and go on after a backslash.
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
            faces: fans(&mesh.indices, &mesh.face_arities, vertices),
        })
    }
}

/// The lines that matter, after a face that names every vertex, and the number of vertices.
///
/// tobj begins a new model at every group and numbers its vertices in the order in which faces use them. Without the
/// groups and with a first face that names all vertices in turn, the numbers are those of the file, and vertices without
/// faces are kept.
fn prepare(text: &[u8]) -> (Vec<u8>, usize) {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let text = continued(text);
    let mut geometry = Vec::with_capacity(text.len());
    let mut vertices = 0;
    // Old files end their lines with a carriage return alone; one before a line feed is trimmed.
    let end = if text.contains(&b'\n') { b'\n' } else { b'\r' };
    let has_comments = text.contains(&b'#');
    for line in text.split(|&byte| byte == end).map(<[u8]>::trim_ascii) {
        let line = match line {
            [b'v' | b'f', ..] if has_comments => without_comment(line),
            _ => line,
        };
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

/// The text with lines joined that a backslash at the end of the first continues.
fn continued(text: &[u8]) -> Cow<'_, [u8]> {
    // Hardly any file has one.
    if !text.contains(&b'\\') {
        return Cow::Borrowed(text);
    }
    let mut joined = Vec::with_capacity(text.len());
    let mut rest = text;
    while let Some((&byte, after)) = rest.split_first() {
        let line_end = match after {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => 0,
        };
        if byte == b'\\' && line_end > 0 {
            joined.push(b' ');
            rest = &after[line_end..];
        } else {
            joined.push(byte);
            rest = after;
        }
    }
    Cow::Owned(joined)
}

/// A line up to a `#`.
fn without_comment(line: &[u8]) -> &[u8] {
    match line.iter().position(|&byte| byte == b'#') {
        Some(end) => line[..end].trim_ascii_end(),
        None => line,
    }
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
fn fans(indices: &[u32], arities: &[u32], vertices: usize) -> Vec<[u32; 3]> {
    let corners = indices.get(vertices..).unwrap_or_default();
    if arities.is_empty() {
        return corners.as_chunks().0.to_vec();
    }
    let mut triangles = Vec::with_capacity(corners.len() / 2);
    let mut rest = corners;
    for &arity in arities.iter().skip(1) {
        let Some((polygon, others)) = rest.split_at_checked(arity as usize) else {
            break;
        };
        rest = others;
        match *polygon {
            [] => {}
            [only] => triangles.push([only; 3]),
            [a, b] => triangles.push([a, b, b]),
            [first, ref chain @ ..] => {
                triangles.extend(chain.windows(2).map(|side| [first, side[0], side[1]]));
            }
        }
    }
    triangles
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
    fn comments_and_line_ends_of_all_kinds_are_understood() {
        let plain = TriangleSoup::parse_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
        for text in [
            "v 0 0 0 # origin\nv 1 0 0\nv 0 1 0#\nf 1 2 3 # face\n",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n",
            "v 0 0 0\r\nv 1 \\\r\n 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
            "\u{feff}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
            "mtllib a\\b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        ] {
            assert_eq!(
                TriangleSoup::parse_obj(text.as_bytes()),
                Ok(plain.clone()),
                "{text:?}"
            );
        }
    }

    #[test]
    fn faces_of_fewer_corners_are_left_to_the_repair() {
        let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2\nf 4\nf 1 3 4\n";
        let soup = TriangleSoup::parse_obj(text).unwrap();
        assert_eq!(soup.faces, [[0, 1, 2], [0, 1, 1], [3, 3, 3], [0, 2, 3]]);
        let repaired = soup.repair().unwrap();
        assert_eq!(repaired.report.degenerate_faces, [1, 2]);
        assert_eq!(repaired.mesh.face_count(), 2);
        let refused = Mesh::try_from(soup);
        assert_eq!(refused, Err(Error::RepeatedVertex { face: 1, vertex: 1 }));
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
