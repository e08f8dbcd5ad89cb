//! Exported meshes read back.

use glam::{DVec3, dvec3};
use serde_json::Value;

use super::*;
use crate::color::{BLUE, ORANGE};

fn meshes() -> [Mesh; 2] {
    let ball = Mesh::sphere(dvec3(10.0, 20.0, 30.0), 2.0, 0.01);
    [
        ball.clone().with_scalar_at(|p| p.z),
        ball.transformed(glam::DAffine3::from_translation(dvec3(5.0, 0.0, 0.0))),
    ]
}

#[test]
fn obj_reads_back() {
    let [one, two] = meshes();
    let text = obj(&[
        Part::new("first ball", &one, BLUE),
        Part::new("second", &two, ORANGE),
    ])
    .unwrap();
    let options = tobj::LoadOptions {
        single_index: true,
        ..tobj::LoadOptions::default()
    };
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
        Err(tobj::LoadError::OpenFileFailed)
    })
    .unwrap();
    assert_eq!(
        models.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(),
        ["first_ball", "second"]
    );
    for (model, mesh) in models.iter().zip([&one, &two]) {
        assert_eq!(model.mesh.indices.len(), 3 * mesh.triangles.len());
        // tobj numbers vertices in the order of their use: compare corner by corner.
        let corners = mesh.triangles.iter().flatten().map(|&i| i as usize);
        for (read, written) in model.mesh.indices.iter().map(|&i| i as usize).zip(corners) {
            let at = |values: &[f64]| DVec3::from_slice(&values[3 * read..]);
            assert_eq!(at(&model.mesh.positions), mesh.positions[written]);
            assert!(at(&model.mesh.normals).distance(mesh.normals[written]) < 1e-5);
        }
    }
}

fn decode(text: &str) -> Vec<u8> {
    let digit = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let digits: Vec<u8> = text.bytes().filter(|&c| c != b'=').map(digit).collect();
    digits
        .chunks(4)
        .flat_map(|c| {
            let bits = c
                .iter()
                .enumerate()
                .fold(0_u32, |bits, (i, &d)| bits | u32::from(d) << (18 - 6 * i));
            bits.to_be_bytes()[1..c.len()].to_vec()
        })
        .collect()
}

#[test]
fn gltf_reads_back() {
    let [one, two] = meshes();
    let text = gltf(&[Part::new("one", &one, BLUE), Part::new("two", &two, ORANGE)]).unwrap();
    let document: Value = serde_json::from_str(&text).unwrap();
    let uri = document["buffers"][0]["uri"].as_str().unwrap();
    let bytes = decode(uri.split_once("base64,").unwrap().1);
    assert_eq!(
        bytes.len() as u64,
        document["buffers"][0]["byteLength"].as_u64().unwrap()
    );
    let root = document["nodes"].as_array().unwrap().last().unwrap();
    let moved: Vec<f64> = root["translation"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect();
    for (number, mesh) in [&one, &two].into_iter().enumerate() {
        let primitive = &document["meshes"][number]["primitives"][0];
        let view = |accessor: &Value| {
            let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
            let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
            let [offset, length] =
                ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
            bytes[offset..offset + length]
                .chunks(4)
                .map(|c| <[u8; 4]>::try_from(c).unwrap())
                .collect::<Vec<_>>()
        };
        let positions: Vec<f32> = view(&primitive["attributes"]["POSITION"])
            .into_iter()
            .map(f32::from_le_bytes)
            .collect();
        let indices: Vec<u32> = view(&primitive["indices"])
            .into_iter()
            .map(u32::from_le_bytes)
            .collect();
        assert_eq!(indices, mesh.triangles.concat());
        for (read, written) in positions.chunks(3).zip(&mesh.positions) {
            // The root node turns (x, y, z) to (x, z, -y) and adds its translation.
            let read = dvec3(read[0].into(), read[2].into(), -f64::from(read[1]))
                + dvec3(moved[0], moved[1], moved[2]);
            assert!(read.distance(dvec3(written.x, written.z, -written.y)) < 1e-5);
        }
        assert_eq!(
            primitive["attributes"]["_SCALAR"].is_null(),
            mesh.scalar.is_none()
        );
    }
}

#[test]
fn nothing_and_nonsense_are_handled() {
    let empty = Mesh::default();
    let document: Value =
        serde_json::from_str(&gltf(&[Part::new("empty", &empty, BLUE)]).unwrap()).unwrap();
    assert!(document.get("meshes").is_none());
    assert!(obj(&[]).is_ok());
    let broken = Mesh::new(vec![DVec3::NAN], vec![DVec3::Z], vec![[0, 0, 0]]);
    assert!(gltf(&[Part::new("broken", &broken, BLUE)]).is_err());
    assert!(obj(&[Part::new("broken", &broken, BLUE)]).is_err());
}
