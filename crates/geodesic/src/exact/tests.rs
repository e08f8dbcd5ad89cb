//! Laws of exact distances.

use crate::{Mesh, SurfacePoint, Sweep};
use crate::{PathFinder, shapes};

/// A sphere with bumps and hollows: vertices of both signs of curvature.
pub(super) fn bumpy(level: u32) -> Mesh {
    let sphere = shapes::sphere(level).unwrap();
    let bump = |p: &glam::DVec3| {
        *p * (1.0 + 0.25 * (5.0 * p.x).sin() * (4.0 * p.y + 1.0).sin() * (6.0 * p.z).cos())
    };
    let positions: Vec<_> = sphere.positions().iter().map(bump).collect();
    Mesh::new(&positions, sphere.faces()).unwrap()
}

fn meshes() -> Vec<Mesh> {
    vec![
        shapes::cube().unwrap(),
        shapes::sphere(3).unwrap(),
        bumpy(3),
        shapes::torus(2.0, 0.7, 30, 14).unwrap(),
    ]
}

/// The exact distance is symmetric, not above any locally shortest path, and met by the traced path.
#[test]
fn distances_are_symmetric_and_traced_paths_have_them() {
    for mesh in meshes() {
        let mut sweep = Sweep::new(&mesh);
        let mut finder = PathFinder::new(&mesh);
        let count = mesh.vertex_count() as u32;
        for i in 0..12 {
            let (a, b) = ((i * 7919) % count, (i * 104_729 + 31) % count);
            let (a, b) = (SurfacePoint::Vertex(a), SurfacePoint::Vertex(b));
            let (there, back) = (sweep.distance(a, b).unwrap(), sweep.distance(b, a).unwrap());
            assert!(
                (there - back).abs() <= 1e-12 * there,
                "{a} {b}: {there} {back}"
            );
            let local = finder.shortest(a, b).unwrap().length();
            assert!(
                local >= there * (1.0 - 1e-12),
                "{a} {b}: local {local} exact {there}"
            );
            let path = sweep.shortest_path(a, b).unwrap();
            assert!(
                (path.length() - there).abs() <= 1e-12 * there,
                "{a} {b}: traced {} exact {there}",
                path.length()
            );
            assert!(path.certify(&mesh).unwrap().is_geodesic());
        }
    }
}

/// Points inside faces obey the triangle inequality with their corners, and match a sweep from the other end.
#[test]
fn points_anywhere_are_sources_and_targets() {
    for mesh in meshes() {
        let mut sweep = Sweep::new(&mesh);
        let faces = mesh.face_count() as u32;
        for i in 0..8 {
            let a = mesh
                .face_point((i * 7919) % faces, [0.2, 0.3, 0.5])
                .unwrap();
            let b = SurfacePoint::Edge {
                halfedge: (i * 104_729 + 7) % (3 * faces),
                t: 0.3,
            };
            let (there, back) = (sweep.distance(a, b).unwrap(), sweep.distance(b, a).unwrap());
            assert!(
                (there - back).abs() <= 1e-12 * there.max(1e-3),
                "{a} {b}: {there} {back}"
            );
            let path = sweep.shortest_path(a, b).unwrap();
            assert!((path.length() - there).abs() <= 1e-12 * there.max(1e-3));
        }
    }
}

#[test]
fn a_bounded_sweep_knows_what_it_reached() {
    let mesh = shapes::sphere(4).unwrap();
    let mut sweep = Sweep::new(&mesh);
    let all = sweep
        .from_points(&[SurfacePoint::Vertex(0)])
        .unwrap()
        .vertex_distances()
        .to_vec();
    let near = sweep.within(&[SurfacePoint::Vertex(0)], 0.5).unwrap();
    for (v, distance) in all.iter().enumerate() {
        if *distance < 0.49 {
            assert!((near.vertex_distance(v as u32) - distance).abs() < 1e-14);
        }
    }
    assert!(sweep.from_points(&[]).is_err());
    assert!(
        sweep
            .from_points(&[SurfacePoint::Vertex(1_000_000)])
            .is_err()
    );
}
