//! Pictures of things whose picture is known.

use std::io::Cursor;

use glam::DVec3;

use super::*;
use crate::color::{BLUE, ColorMap, GREEN, VERMILION};
use crate::mesh::Mesh;

fn small(samples: u32) -> Options {
    Options {
        width: 48,
        height: 36,
        samples,
        seed: 3,
    }
}

fn example() -> (Scene, Camera) {
    let mut scene = Scene::new();
    let ball = |x: f64| Mesh::sphere(DVec3::new(x, 0.0, 0.0), 1.0, 1e-3);
    scene.add(ball(0.0), Material::glossy(BLUE)).unwrap();
    scene
        .add(
            ball(2.1).with_scalar_at(|p| p.z),
            Material::scalar(ColorMap::Diverging, -1.0, 1.0).isolines(0.25),
        )
        .unwrap();
    scene.add(ball(-2.1), Material::glass(GREEN)).unwrap();
    scene
        .add(
            Mesh::sphere(DVec3::new(0.0, 0.0, 1.6), 0.6, 1e-3),
            Material::zebra(),
        )
        .unwrap();
    scene.ground_below().layer("curvature.K");
    let camera = scene.camera(DVec3::new(0.2, -2.0, 0.5), 4.0 / 3.0);
    (scene, camera)
}

#[test]
fn every_triangle_is_found_where_it_is() {
    let mut scene = Scene::new();
    let mesh = Mesh::sphere(DVec3::new(1e5, 0.0, 0.0), 3.0, 0.01);
    scene.add(mesh.clone(), Material::matte(BLUE)).unwrap();
    let accel = scene.accel();
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let corners = triangle.map(|i| mesh.positions[i as usize]);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let outside =
            accel.local(DVec3::new(1e5, 0.0, 0.0) + (middle - DVec3::new(1e5, 0.0, 0.0)) * 2.0);
        let direction = (accel.local(middle) - outside).normalize();
        let hit = accel.trace(outside, direction, 0.0).unwrap();
        assert_eq!(hit.triangle, number as u32);
        assert!(
            hit.weights.iter().all(|w| (w - 1.0 / 3.0).abs() < 0.01),
            "{:?}",
            hit.weights
        );
        assert!(hit.plane.dot(direction) < 0.0);
        assert!(!accel.is_free(outside, direction, f32::INFINITY));
        assert!(accel.is_free(outside, -direction, f32::INFINITY));
    }
}

#[test]
fn a_closed_mesh_has_no_pinholes() {
    let mut scene = Scene::new();
    scene
        .add(Mesh::sphere(DVec3::ZERO, 1.0, 1e-4), Material::matte(BLUE))
        .unwrap();
    let accel = scene.accel();
    for i in 0..200_000_u32 {
        let mut sampler = Sampler::new(1, u64::from(i), 0);
        let ([u, v], [x, y]) = (sampler.pair(), sampler.pair());
        let (angle, z) = (std::f32::consts::TAU * u, 2.0 * v - 1.0);
        let out = Vec3A::new(
            angle.cos() * (1.0 - z * z).sqrt(),
            angle.sin() * (1.0 - z * z).sqrt(),
            z,
        );
        let start = Vec3A::new(0.1 * x, 0.1 * y, 0.05);
        assert!(accel.trace(start, out, 0.0).is_some(), "ray {i}");
    }
}

#[test]
fn layers_hold_what_the_scene_holds() {
    let mut scene = Scene::new();
    scene
        .add(
            Mesh::sphere(DVec3::ZERO, 1.0, 1e-4).with_scalar_at(|p| p.x),
            Material::matte(VERMILION),
        )
        .unwrap();
    scene.layer("geodesic.D");
    let camera = Camera::look_at(DVec3::new(0.0, -6.0, 0.0), DVec3::ZERO, 4.0 / 3.0);
    let options = Options {
        width: 49,
        height: 37,
        samples: 1,
        seed: 1,
    };
    let picture = render(&scene, &camera, options, |_| ());
    let middle = 18 * 49 + 24;
    assert_eq!(picture.ids().nth(middle), Some(1));
    assert!((picture.depths().nth(middle).unwrap() - 5.0).abs() < 1e-3);
    let normal = picture.normals().nth(middle).unwrap();
    assert!((normal[1] + 1.0).abs() < 1e-3, "{normal:?}");
    assert!(picture.scalars().nth(middle).unwrap().abs() < 1e-3);
    assert_eq!(
        (picture.ids().next(), picture.depths().next()),
        (Some(0), Some(1e10))
    );
    // To the right x grows.
    assert!(picture.scalars().nth(middle + 8).unwrap() > 0.3);
}

#[test]
fn exr_reads_back_and_its_bytes_are_reproducible() {
    use ::exr::prelude::*;
    let (scene, camera) = example();
    let picture = super::render(&scene, &camera, small(2), |_| ());
    let bytes = || {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_exr(&mut bytes).unwrap();
        bytes.into_inner()
    };
    assert_eq!(bytes(), bytes());
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes();
    let image = image.from_buffered(Cursor::new(bytes())).unwrap();
    let channels = &image.layer_data.channel_data.list;
    let names: Vec<String> = channels
        .iter()
        .map(|channel| channel.name.to_string())
        .collect();
    let expected = [
        "A",
        "B",
        "G",
        "R",
        "curvature.K",
        "depth.Z",
        "id.I",
        "normal.X",
        "normal.Y",
        "normal.Z",
    ];
    assert_eq!(names, expected);
    let red: Vec<f32> = channels[3].sample_data.values_as_f32().collect();
    assert!(red.iter().copied().eq(picture.colors().map(|c| c[0])));
    let ids: Vec<f32> = channels[6].sample_data.values_as_f32().collect();
    assert!(ids.iter().copied().eq(picture.ids().map(|id| id as f32)));
    assert!(
        (0..=4).all(|id| ids.contains(&(id as f32))),
        "all four objects and the ground are seen"
    );
}

#[test]
fn pictures_depend_on_the_seed_and_not_on_the_threads() {
    let (scene, camera) = example();
    let picture = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| render(&scene, &camera, Options { seed, ..small(4) }, |_| ()))
            .image()
    };
    assert_eq!(picture(1, 3), picture(3, 3));
    assert_ne!(picture(1, 3), picture(1, 4));
}

#[test]
fn more_rays_do_not_change_what_one_sees() {
    let (scene, camera) = example();
    let [few, many] = [16, 256].map(|n| render(&scene, &camera, small(n), |_| ()).image());
    let (_, rms) = few.difference(&many).unwrap();
    assert!(rms < 6.0, "{rms}");
    assert!(
        render(&scene, &camera, small(16), |_| ())
            .colors()
            .flatten()
            .all(f32::is_finite)
    );
}

#[test]
fn shadows_fall_on_the_ground_and_the_empty_scene_is_the_backdrop() {
    let mut scene = Scene::new();
    scene
        .add(Mesh::sphere(DVec3::ZERO, 1.0, 1e-3), Material::matte(BLUE))
        .unwrap();
    scene.ground(-1.0).light_from(DVec3::new(-1.0, 0.0, 1.0));
    let camera = Camera::look_at(DVec3::new(0.0, -12.0, 6.0), DVec3::ZERO, 4.0 / 3.0);
    let picture = render(
        &scene,
        &camera,
        Options {
            width: 80,
            height: 60,
            samples: 32,
            seed: 1,
        },
        |_| (),
    );
    let light = |p: DVec3| {
        let at = camera.project(p, 80, 60);
        picture
            .colors()
            .nth(at.y as usize * 80 + at.x as usize)
            .unwrap()[1]
    };
    let (shaded, open) = (
        light(DVec3::new(1.2, 0.0, -1.0)),
        light(DVec3::new(-2.2, 0.0, -1.0)),
    );
    assert!(shaded < 0.6 * open, "{shaded} {open}");
    let empty = render(&Scene::new(), &camera, small(1), |_| ());
    assert!(empty.ids().all(|id| id == 0));
    let mut broken = Mesh::sphere(DVec3::ZERO, 1.0, 0.1);
    broken.positions[0].x = f64::NAN;
    assert!(Scene::new().add(broken, Material::matte(BLUE)).is_err());
}
