//! The schemes against splines, limits and smooth geodesics.

use super::*;
use crate::{PatchLevels, geodesic_between, shapes};
use bezier_mass::{BSplineSurface, Knots};
use glam::DVec2;
use std::f64::consts::TAU;

const AROUND: usize = 8;
const TUBE: usize = 6;

fn control(i: usize, j: usize) -> DVec3 {
    let (u, v) = (TAU * i as f64 / AROUND as f64, TAU * j as f64 / TUBE as f64);
    let rho = 2.0 + (0.8 + 0.2 * u.cos()) * v.cos();
    DVec3::new(rho * u.cos(), rho * u.sin(), 0.9 * v.sin())
}

/// A net of quadrilaterals that closes in both directions, without extraordinary vertices.
fn ring() -> SubdivisionSurface {
    let positions: Vec<DVec3> = (0..AROUND * TUBE)
        .map(|k| control(k / TUBE, k % TUBE))
        .collect();
    let vertex = |i: usize, j: usize| (i % AROUND * TUBE + j % TUBE) as u32;
    let quads: Vec<[u32; 4]> = (0..AROUND * TUBE)
        .map(|k| (k / TUBE, k % TUBE))
        .map(|(i, j)| {
            [
                vertex(i, j),
                vertex(i + 1, j),
                vertex(i + 1, j + 1),
                vertex(i, j + 1),
            ]
        })
        .collect();
    SubdivisionSurface::catmull_clark(&positions, &quads).unwrap()
}

/// The same surface as a bicubic spline: control point `k` belongs to the parameter `k - 1`.
fn spline() -> BSplineSurface<DVec3> {
    let knots = |n: usize| {
        let breakpoints: Vec<f64> = (0..=n).map(|k| k as f64).collect();
        Knots::periodic(3, &breakpoints).unwrap()
    };
    let points: Vec<DVec3> = (0..AROUND * TUBE)
        .map(|k| control(k / TUBE, k % TUBE))
        .collect();
    BSplineSurface::polynomial([knots(AROUND), knots(TUBE)], &points).unwrap()
}

fn parameters(i: usize, j: usize) -> DVec2 {
    DVec2::new(i as f64 - 1.0, j as f64 - 1.0)
}

#[test]
fn catmull_and_clark_generalise_bicubic_splines() {
    let (surface, spline) = (ring().with_vertices_on_limit(true).unwrap(), spline());
    for i in 0..AROUND {
        for j in 0..TUBE {
            let vertex = surface.mesh().positions()[i * TUBE + j];
            let uv = parameters(i, j);
            assert!(vertex.distance(spline.point(uv.x, uv.y).unwrap()) < 1e-14);
        }
    }
    // A level up, the first vertices stay on the limit.
    let finer = surface.refined().unwrap();
    for (a, b) in surface
        .mesh()
        .positions()
        .iter()
        .zip(finer.mesh().positions())
    {
        assert!(a.distance(*b) < 1e-14);
    }
}

/// Paths on both kinds of polyhedra tend to the geodesic of the spline, with order 2.
#[test]
fn paths_on_catmull_clark_surfaces_converge_to_the_smooth_geodesic() {
    let spline = spline();
    let ([i, j], [k, l]) = ([1, 2], [3, 4]);
    let (from, to) = ((i * TUBE + j) as u32, (k * TUBE + l) as u32);
    let levels = PatchLevels::of_spline(&spline);
    let guide = levels.paths(parameters(i, j), parameters(k, l), 4).unwrap();
    let smooth = geodesic_between(&spline, &guide[4].parameters, 1e-10).unwrap();
    assert_eq!(smooth.conjugate_points, 0);
    for on_limit in [false, true] {
        let surface = ring().with_vertices_on_limit(on_limit).unwrap();
        let paths = surface.paths(from.into(), to.into(), 5).unwrap();
        let errors: Vec<f64> = paths
            .iter()
            .map(|p| (p.length() - smooth.length).abs())
            .collect();
        let order = (errors[3] / errors[5]).log2() / 2.0;
        assert!((order - 2.0).abs() < 0.2, "{on_limit} {errors:?}");
        assert!(errors[5] < 2e-3 * smooth.length, "{errors:?}");
    }
}

/// Loop's surface of a stretched icosahedron, with its twelve vertices of valence 5.
#[test]
fn paths_on_loop_surfaces_converge() {
    let mut positions = shapes::sphere(0).unwrap().positions().to_vec();
    positions
        .iter_mut()
        .for_each(|p| *p *= DVec3::new(1.0, 0.8, 1.4));
    let mesh = Mesh::new(&positions, shapes::sphere(0).unwrap().faces()).unwrap();
    let from = SurfacePoint::Face {
        face: 0,
        barycentric: [0.5, 0.3, 0.2],
    };
    let to = SurfacePoint::Face {
        face: 13,
        barycentric: [0.2, 0.45, 0.35],
    };
    let mut limits = Vec::new();
    for on_limit in [false, true] {
        let surface = SubdivisionSurface::loop_scheme(&mesh).unwrap();
        let surface = surface.with_vertices_on_limit(on_limit).unwrap();
        let paths = surface.paths(from, to, 6).unwrap();
        let lengths: Vec<f64> = paths.iter().map(GeodesicPath::length).collect();
        let convergence = Convergence { lengths };
        let order = convergence.order().unwrap();
        assert!((1.6..2.4).contains(&order), "{order} {convergence:?}");
        limits.push(convergence.limit().unwrap());
        assert!(convergence.error() < 1e-3);
    }
    assert!((limits[0] - limits[1]).abs() < 2e-4, "{limits:?}");
}

/// The limit position is where refining again and again takes a vertex.
#[test]
fn limit_positions_are_limits() {
    let pyramid = [
        DVec3::ZERO,
        DVec3::X,
        DVec3::new(1.0, 1.0, 0.3),
        DVec3::Y,
        DVec3::new(0.4, 0.5, 1.0),
    ];
    let polygons: [&[u32]; 5] = [
        &[3, 2, 1, 0],
        &[0, 1, 4],
        &[1, 2, 4],
        &[2, 3, 4],
        &[3, 0, 4],
    ];
    let open = &polygons[1..];
    let sheet = Mesh::new(&pyramid, open).unwrap();
    for surface in [
        SubdivisionSurface::catmull_clark(&pyramid, &polygons).unwrap(),
        SubdivisionSurface::catmull_clark(&pyramid, open).unwrap(),
        SubdivisionSurface::loop_scheme(&shapes::cube().unwrap()).unwrap(),
        SubdivisionSurface::loop_scheme(&sheet).unwrap(),
    ] {
        let limit = surface.clone().with_vertices_on_limit(true).unwrap();
        let mut fine = surface;
        for _ in 0..6 {
            fine = fine.refined().unwrap();
        }
        // The distance falls by four a level at the least.
        for (a, b) in limit
            .mesh()
            .positions()
            .iter()
            .zip(fine.mesh().positions())
            .take(5)
        {
            assert!(a.distance(*b) < 5e-4, "{:?}: {a} {b}", fine.scheme());
        }
    }
}

/// The map from a polyhedron to the next is continuous: neighbours agree on their common edge.
#[test]
fn carried_points_agree_across_edges() {
    let polygons: [&[u32]; 4] = [&[0, 1, 2, 3, 4], &[1, 0, 5, 6], &[2, 1, 6], &[4, 3, 7, 8]];
    let positions: Vec<DVec3> = (0..9)
        .map(|k| TAU * f64::from(k) / 9.0)
        .map(|t| DVec3::new(t.cos(), 1.3 * t.sin(), (2.0 * t).sin()))
        .collect();
    let general = SubdivisionSurface::catmull_clark(&positions, &polygons).unwrap();
    let general_finer = general.refined().unwrap();
    let triangles = SubdivisionSurface::loop_scheme(&shapes::cube().unwrap()).unwrap();
    for surface in [general, general_finer, ring(), triangles] {
        let finer = surface.refined().unwrap();
        let mesh = surface.mesh();
        for h in 0..mesh.halfedge_count() as u32 {
            let Some(twin) = mesh.twin(h) else { continue };
            for t in [0.0, 0.2, 0.5, 0.83] {
                let place = |h: u32, t: f64| {
                    let mut barycentric = [0.0; 3];
                    barycentric[(h % 3) as usize] = 1.0 - t;
                    barycentric[((h + 1) % 3) as usize] = t;
                    let (face, barycentric) = surface.pieces[(h / 3) as usize].tile_at(barycentric);
                    let point = SurfacePoint::Face { face, barycentric };
                    finer.mesh().point_position(point).unwrap()
                };
                // Half-edge 3 f + k begins at corner k; the coordinates are those of its face.
                assert!(place(h, t).distance(place(twin, 1.0 - t)) < 1e-14);
            }
        }
    }
}

#[test]
fn hostile_polygons_are_refused() {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let cc = |polygons: &[&[u32]]| SubdivisionSurface::catmull_clark(&corners, polygons).err();
    assert!(matches!(cc(&[]), Some(Error::EmptyMesh)));
    assert!(matches!(
        cc(&[&[0, 1]]),
        Some(Error::NotATriangle { corners: 2, .. })
    ));
    assert!(matches!(
        cc(&[&[0, 1, 9]]),
        Some(Error::IndexOutOfRange { vertex: 9, .. })
    ));
    assert!(matches!(
        cc(&[&[0, 1, 0, 2]]),
        Some(Error::RepeatedVertex { vertex: 0, .. })
    ));
    let same_way = cc(&[&[0, 1, 2], &[0, 1, 3]]);
    assert!(matches!(
        same_way,
        Some(Error::InconsistentOrientation { .. })
    ));
    let ball = SubdivisionSurface::loop_scheme(&shapes::sphere(0).unwrap()).unwrap();
    assert!(ball.paths(0.into(), 99.into(), 1).is_err());
}
