//! Meshes against the surfaces that they stand for.

use std::f64::consts::{PI, TAU};

use super::*;

fn torus(u: f64, v: f64) -> (DVec3, DVec3) {
    let ((su, cu), (sv, cv)) = ((TAU * u).sin_cos(), (TAU * v).sin_cos());
    let normal = DVec3::new(cu * cv, su * cv, sv);
    (DVec3::new(2.0 * cu, 2.0 * su, 0.0) + 0.5 * normal, normal)
}

/// Distance of a point from the torus of radii 2 and 1/2.
fn off_torus(p: DVec3) -> f64 {
    ((p.truncate().length() - 2.0).hypot(p.z) - 0.5).abs()
}

#[test]
fn a_surface_keeps_its_chord_error() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        let mesh = Mesh::surface(torus, |_| tolerance);
        mesh.check().unwrap();
        let at = |i: u32| mesh.positions[i as usize];
        let middles = mesh.triangles.iter().flat_map(|&[a, b, c]| {
            let [a, b, c] = [at(a), at(b), at(c)];
            [
                0.5 * (a + b),
                0.5 * (b + c),
                0.5 * (c + a),
                (a + b + c) / 3.0,
            ]
        });
        let worst = middles.map(off_torus).fold(0.0, f64::max);
        assert!(worst <= tolerance, "{worst} > {tolerance}");
        assert!(
            worst >= 0.2 * tolerance,
            "much finer than asked: {worst} for {tolerance}"
        );
    }
}

#[test]
fn triangles_turn_to_the_side_of_their_normals() {
    let meshes = [
        Mesh::surface(torus, |_| 0.01),
        Mesh::sphere(DVec3::ONE, 2.0, 0.01),
        Mesh::tube(
            &[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.3)],
            0.1,
            false,
        ),
        Mesh::sphere(DVec3::ZERO, 1.0, 0.01)
            .transformed(DAffine3::from_scale(DVec3::new(-1.0, 2.0, 1.0))),
    ];
    for mesh in meshes {
        mesh.check().unwrap();
        for &[a, b, c] in &mesh.triangles {
            let [p, q, r] = [a, b, c].map(|i| mesh.positions[i as usize]);
            let normal: DVec3 = [a, b, c].map(|i| mesh.normals[i as usize]).iter().sum();
            assert!((q - p).cross(r - p).dot(normal) > 0.0);
        }
    }
}

#[test]
fn areas_converge() {
    let sphere = Mesh::sphere(DVec3::ZERO, 1.0, 1e-5);
    assert!((sphere.area() / (4.0 * PI) - 1.0).abs() < 1e-4);
    let circle: Vec<DVec3> = (0..200)
        .map(|i| torus(f64::from(i) / 200.0, 0.0).0)
        .collect();
    let ring = Mesh::tube(&circle, 0.05, true);
    assert!((ring.area() / (TAU * 0.05 * TAU * 2.5) - 1.0).abs() < 0.01);
    // A closed tube has no free edge: every vertex of the last ring lies on the first one.
    let (first, last) = (
        &ring.positions[..17],
        &ring.positions[ring.positions.len() - 17..],
    );
    assert!(first.iter().zip(last).all(|(a, b)| a.distance(*b) < 1e-12));
}

#[test]
fn smooth_normals_of_a_cube_point_along_the_diagonals() {
    let corners: Vec<DVec3> = (0..8)
        .map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)))
        .collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let triangles: Vec<[u32; 3]> = quads
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect();
    let mesh = Mesh::smooth(corners.clone(), triangles.clone());
    for (corner, normal) in corners.iter().zip(&mesh.normals) {
        assert!(normal.distance((*corner - 0.5).normalize()) < 1e-12);
    }
    assert_eq!(Mesh::faceted(&corners, &triangles).positions.len(), 36);
    assert!((Mesh::faceted(&corners, &triangles).area() - 6.0).abs() < 1e-12);
}

#[test]
fn merging_keeps_numbers_and_check_refuses_nonsense() {
    let one = Mesh::sphere(DVec3::ZERO, 1.0, 0.1).with_scalar_at(|p| p.z);
    let count = one.positions.len();
    let both = Mesh::merged([one.clone(), Mesh::sphere(DVec3::X, 1.0, 0.1)]);
    both.check().unwrap();
    let scalar = both.scalar.as_ref().unwrap();
    assert!(scalar[0] == 1.0 && scalar[count].is_nan());
    let mut broken = one.clone();
    broken.triangles[0][1] = 1_000_000;
    assert!(broken.check().is_err());
    let mut broken = one.clone();
    broken.positions[3].y = f64::NAN;
    assert!(broken.check().is_err());
    let mut broken = one;
    broken.normals.pop();
    assert!(broken.check().is_err());
}

#[test]
fn tubes_of_nothing_are_empty() {
    assert_eq!(Mesh::tube(&[], 1.0, false), Mesh::default());
    assert_eq!(
        Mesh::tube(&[DVec3::X, DVec3::X], 1.0, false),
        Mesh::default()
    );
    assert_eq!(
        Mesh::tube(&[DVec3::X, DVec3::Y], 1.0, true),
        Mesh::default()
    );
    assert_eq!(Mesh::default().bounds(), None);
}
