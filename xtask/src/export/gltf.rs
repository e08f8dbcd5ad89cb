//! glTF 2.0 with its buffer embedded: one file, which viewers and browsers open.

use anyhow::Result;
use glam::DVec3;
use serde_json::{Value, json};

use super::Part;

/// Numbers of the format: component types, buffer targets.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const VERTEX_BUFFER: u32 = 34962;
const INDEX_BUFFER: u32 = 34963;

/// The parts as glTF: positions (about the middle of all, so that `f32` suffices), normals, the
/// vertices' numbers as the attribute `_SCALAR`, triangles, a two-sided material per part. The root
/// node turns z up into the format's y up and moves everything back to its place.
///
/// # Errors
/// As [`Mesh::check`](crate::mesh::Mesh::check).
pub fn gltf(parts: &[Part<'_>]) -> Result<String> {
    let drawn: Vec<&Part<'_>> = parts
        .iter()
        .filter(|part| !part.mesh.triangles.is_empty())
        .collect();
    let bounds = drawn.iter().filter_map(|part| part.mesh.bounds());
    let [low, high] = bounds
        .reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
        .unwrap_or_default();
    let middle = 0.5 * (low + high);
    let mut file = File::default();
    let (mut meshes, mut materials, mut nodes) = (Vec::new(), Vec::new(), Vec::new());
    for (number, part) in drawn.iter().enumerate() {
        part.mesh.check()?;
        let positions: Vec<[f32; 3]> = part
            .mesh
            .positions
            .iter()
            .map(|&p| (p - middle).as_vec3().to_array())
            .collect();
        let normals: Vec<[f32; 3]> = part
            .mesh
            .normals
            .iter()
            .map(|n| n.as_vec3().to_array())
            .collect();
        let mut attributes = json!({
            "POSITION": file.vectors(&positions, true),
            "NORMAL": file.vectors(&normals, false),
        });
        if let Some(scalar) = &part.mesh.scalar {
            // The format has no NaN.
            let scalar = scalar
                .iter()
                .map(|&x| if x.is_finite() { x as f32 } else { 0.0 });
            attributes["_SCALAR"] = json!(file.scalars(scalar));
        }
        let indices = file.indices(&part.mesh.triangles);
        meshes.push(json!({
            "name": part.name,
            "primitives": [{"attributes": attributes, "indices": indices, "material": number}],
        }));
        let [r, g, b] = part.color.linear();
        materials.push(json!({
            "name": part.name,
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.45,
            },
        }));
        nodes.push(json!({"name": part.name, "mesh": number}));
    }
    let children: Vec<usize> = (0..nodes.len()).collect();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    // The turn takes (x, y, z) to (x, z, -y).
    let moved = DVec3::new(middle.x, middle.z, -middle.y).to_array();
    let mut root =
        json!({"name": "z up", "rotation": [-half, 0.0, 0.0, half], "translation": moved});
    if !children.is_empty() {
        root["children"] = json!(children);
    }
    nodes.push(root);
    let mut document = json!({
        "asset": {"version": "2.0", "generator": "cargo xtask"},
        "scene": 0,
        "scenes": [{"nodes": [nodes.len() - 1]}],
        "nodes": nodes,
    });
    if !meshes.is_empty() {
        // Empty arrays are not allowed.
        document["meshes"] = Value::Array(meshes);
        document["materials"] = Value::Array(materials);
        document["accessors"] = Value::Array(file.accessors);
        document["bufferViews"] = Value::Array(file.views);
        let uri = format!(
            "data:application/octet-stream;base64,{}",
            base64(&file.bytes)
        );
        document["buffers"] = json!([{"byteLength": file.bytes.len(), "uri": uri}]);
    }
    Ok(document.to_string())
}

/// The buffer and what lies where in it; every item is four bytes, so all is aligned.
#[derive(Debug, Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl File {
    fn vectors(&mut self, items: &[[f32; 3]], with_bounds: bool) -> usize {
        let start = self.bytes.len();
        self.bytes
            .extend(items.iter().flatten().flat_map(|x| x.to_le_bytes()));
        let mut accessor = json!({"componentType": FLOAT, "count": items.len(), "type": "VEC3"});
        if with_bounds {
            let fold = |f: fn(f32, f32) -> f32, from: f32| {
                items.iter().fold([from; 3], |m, p| {
                    [f(m[0], p[0]), f(m[1], p[1]), f(m[2], p[2])]
                })
            };
            accessor["min"] = json!(fold(f32::min, f32::INFINITY));
            accessor["max"] = json!(fold(f32::max, f32::NEG_INFINITY));
        }
        self.add(start, VERTEX_BUFFER, accessor)
    }

    fn scalars(&mut self, items: impl Iterator<Item = f32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(items.flat_map(f32::to_le_bytes));
        let count = (self.bytes.len() - start) / 4;
        self.add(
            start,
            VERTEX_BUFFER,
            json!({"componentType": FLOAT, "count": count, "type": "SCALAR"}),
        )
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let start = self.bytes.len();
        self.bytes
            .extend(triangles.iter().flatten().flat_map(|i| i.to_le_bytes()));
        let accessor =
            json!({"componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR"});
        self.add(start, INDEX_BUFFER, accessor)
    }

    fn add(&mut self, start: usize, target: u32, mut accessor: Value) -> usize {
        let length = self.bytes.len() - start;
        self.views.push(
            json!({"buffer": 0, "byteOffset": start, "byteLength": length, "target": target}),
        );
        accessor["bufferView"] = json!(self.views.len() - 1);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// Bytes in the alphabet of RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let byte = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for digit in 0..4 {
            let index = (bits >> (18 - 6 * digit) & 63) as usize;
            out.push(if digit <= chunk.len() {
                char::from(ALPHABET[index])
            } else {
                '='
            });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base64_of_the_rfc() {
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }
}
