use glam::{DMat3, DVec2, DVec3};

use super::*;
use crate::Error;

fn directions() -> impl Iterator<Item = DVec3> {
    (0..50).map(|i| {
        let (angle, height) = (2.4 * f64::from(i), (f64::from(i) + 0.5) / 25.0 - 1.0);
        let radius = (1.0 - height * height).sqrt();
        DVec3::new(radius * angle.cos(), radius * angle.sin(), height)
    })
}

fn ellipsoid() -> DualSurface {
    let axes = [
        DVec3::new(2.0, 0.3, 0.0),
        DVec3::new(-0.1, 1.0, 0.2),
        DVec3::new(0.0, -0.3, 0.7),
    ];
    DualSurface::ellipsoid(DVec3::new(0.5, -1.0, 2.0), axes).unwrap()
}

#[test]
fn a_point_lies_on_its_tangent_plane_and_is_the_gradient_of_the_support() {
    for surface in [
        ellipsoid(),
        ellipsoid().offset(-0.4),
        DualSurface::sphere(DVec3::ONE, 0.3).unwrap(),
    ] {
        for normal in directions() {
            let point = surface.point(normal);
            assert!((point.dot(normal) - surface.support(normal)).abs() < 1e-14);
            let step = 1e-6 * normal.any_orthonormal_vector();
            let (before, after) = ((normal - step).normalize(), (normal + step).normalize());
            let slope = (surface.support(after) - surface.support(before)) / 2e-6;
            assert!((slope - point.dot(step * 1e6)).abs() < 1e-8);
        }
    }
}

#[test]
fn the_plane_mirror_is_exact_and_agrees_with_rays() {
    let (normal, height) = (DVec3::new(1.0, 2.0, -0.5), 3.0);
    let mirrored = ellipsoid().reflect(normal, height).unwrap();
    let mirror = Mirror::plane(normal, height).unwrap();
    let unit = normal.normalize();
    for direction in directions() {
        let ray = SpacePoint {
            point: ellipsoid().point(direction),
            normal: direction,
        };
        let Some((distance, _)) = mirror.hit(ray) else {
            continue;
        };
        let turned = direction - 2.0 * direction.dot(unit) * unit;
        let expected = ray.point + distance * direction - distance * turned;
        assert!((mirrored.point(turned) - expected).length() < 1e-13);
    }
}

#[test]
fn all_rays_from_one_focus_of_an_ellipsoid_meet_in_the_other() {
    let (a, b) = (2.0_f64, 1.2_f64);
    let focus = DVec3::X * (a * a - b * b).sqrt();
    let form = DMat3::from_diagonal(DVec3::new(1.0 / (a * a), 1.0 / (b * b), 1.0 / (b * b)));
    let mirror = Mirror::quadric(form, DVec3::ZERO, -1.0).unwrap();
    let source = DualSurface::sphere(-focus, 0.0).unwrap();
    let cap = |u: f64, v: f64| DVec3::new(0.3, u - 0.5, v - 0.5);
    let front = source
        .sample(20, 20, cap)
        .unwrap()
        .reflect(&mirror)
        .unwrap();
    for ray in front.offset(2.0 * a).rays() {
        assert!((ray.point - focus).length() < 1e-13);
    }
}

#[test]
fn reflected_rays_stay_normal_to_a_front() {
    let form = DMat3::from_diagonal(DVec3::new(0.1, 0.2, 0.0));
    let mirror = Mirror::quadric(form, DVec3::Z * 0.5, 2.0).unwrap();
    let cap = |u: f64, v: f64| DVec3::new(0.6 * (u - 0.5), 0.6 * (v - 0.5), -1.0);
    let defect = |count: usize| {
        let front = ellipsoid()
            .sample(count, count, cap)
            .unwrap()
            .reflect(&mirror)
            .unwrap();
        front.offset(8.0).normality_defect()
    };
    // The asymptotic order is 2.
    let order = (defect(60) / defect(120)).log2();
    assert!((order - 2.0).abs() < 0.2, "order {order}");
}

#[test]
fn hostile_input_is_refused() {
    assert!(DualSurface::sphere(DVec3::NAN, 1.0).is_err());
    assert!(DualSurface::ellipsoid(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::X]).is_err());
    assert!(ellipsoid().reflect(DVec3::ZERO, 1.0).is_err());
    assert!(Mirror::plane(DVec3::ZERO, 1.0).is_err());
    let mirror = Mirror::plane(DVec3::Z, -100.0).unwrap();
    let up = ellipsoid().sample(3, 3, |_, _| DVec3::Z).unwrap();
    assert!(matches!(up.reflect(&mirror), Err(Error::Miss { .. })));
    assert!(ellipsoid().sample(1, 3, |_, _| DVec3::Z).is_err());
    assert!(ellipsoid().sample(3, 3, |_, _| DVec3::ZERO).is_err());
}

/// A bowl and an ellipsoid over it, with the normal of a ray down into it.
fn bowl_and_aim() -> (DualSurface, Mirror, DVec3) {
    let axes = [0.5 * DVec3::X, 0.42 * DVec3::Y, 0.34 * DVec3::Z];
    let front = DualSurface::ellipsoid(DVec3::new(-2.3, 0.2, 2.6), axes).unwrap();
    let form = DMat3::from_diagonal(DVec3::new(0.2, 0.25, 0.0));
    let bowl = Mirror::quadric(form, DVec3::new(0.0, 0.0, -0.5), 0.0).unwrap();
    (front, bowl, DVec3::new(2.3, -0.1, -2.6).normalize())
}

fn patches(tolerance: f64) -> FrontPatches {
    let (front, bowl, aim) = bowl_and_aim();
    let options = PatchOptions {
        tolerance,
        ..PatchOptions::default()
    };
    FrontPatches::reflected(&front, &bowl, aim, 0.12, options).unwrap()
}

/// Where a ray of the front with an outgoing normal is, found without derivatives: the point of stationary support.
#[test]
fn patches_are_where_independent_rays_are() {
    let (front, bowl, aim) = bowl_and_aim();
    let patches = patches(1e-6);
    assert!(patches.omissions().is_empty() && patches.error() <= 1e-6);
    // Rays traced from their own incoming normals; patches by the outgoing normal that they turn out to have.
    let side = aim.any_orthonormal_vector();
    let mut compared = 0;
    for i in 0..400 {
        let angle = 2.4 * f64::from(i);
        let away = 0.1 * (f64::from(i) / 400.0).sqrt();
        let turned = side * angle.cos() + aim.cross(side) * angle.sin();
        let normal = (aim + away * turned).normalize();
        let ray = SpacePoint {
            point: front.point(normal),
            normal,
        };
        let (way, facing) = bowl.hit(ray).unwrap();
        let out = normal - 2.0 * normal.dot(facing) * facing;
        let hit = ray.point + way * normal;
        let Some((cell, share)) = patches.cell_of(out) else {
            continue;
        };
        for run in [0.0, 5.0, 9.0] {
            let point = patches.offset(run).point(cell, share).unwrap();
            let exact = hit + (run - way) * out;
            assert!(point.distance(exact) < 2e-6, "{}", point.distance(exact));
        }
        compared += 1;
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn patches_join_smoothly_at_all_times_and_converge_with_their_order() {
    let (rough, fine) = (patches(1e-4), patches(1e-7));
    for run in [0.0, 4.0, 9.0] {
        let (angle, gap) = fine.offset(run).joint_errors(3);
        // Derivatives are differences of the control planes over the step, 2e-3: a few hundred roundings.
        assert!(angle < 1e-9 && gap < 1e-11, "{run}: {angle:e} {gap:e}");
        for cell in fine.cells().step_by(7) {
            let share = DVec2::new(0.3, 0.6);
            let (_, [u, v]) = fine.offset(run).tangents(cell, share).unwrap();
            let normal = fine.normal(fine.coordinates(cell, share));
            assert!(u.cross(v).normalize().cross(normal).length() < 1e-9);
        }
    }
    // Points depend on the derivatives of a bicubic interpolant: order 3.
    let doublings = (fine.columns() as f64 / rough.columns() as f64).log2();
    let order = (rough.error() / fine.error()).log2() / doublings;
    assert!(order > 2.7, "order {order}");
}

#[test]
fn a_control_plane_is_tangent_and_moves_with_the_front() {
    let front = patches(1e-6).offset(3.0);
    let cell = [1, 2];
    let planes = front.control_planes(cell).unwrap();
    for (corner, plane) in [(DVec2::ZERO, planes[0][0]), (DVec2::ONE, planes[3][3])] {
        let point = front.point(cell, corner).unwrap();
        assert!((plane.truncate().dot(point) - plane.w).abs() < 1e-12);
    }
}

#[test]
fn folds_and_normals_without_rays_are_left_out_with_a_reason() {
    let (front, _, aim) = bowl_and_aim();
    // A small ball reflects to all sides, but a wide square of normals has some that no ray of the lit half has.
    let ball = Mirror::quadric(DMat3::IDENTITY, DVec3::ZERO, -0.25).unwrap();
    let options = PatchOptions {
        tolerance: 1e-2,
        most_columns: 64,
    };
    let wide = FrontPatches::reflected(&front, &ball, aim, 3.0, options);
    let patches = wide.unwrap();
    assert!(patches.cells().next().is_some() && patches.error() <= 1e-2);
    // Some normals have no ray; next to them patches are too rough.
    assert!(
        patches
            .omissions()
            .iter()
            .any(|left_out| left_out.excess.is_none())
    );
    for left_out in patches.omissions() {
        assert!(left_out.excess.is_none_or(|excess| excess > 1.0));
        assert!(patches.point(left_out.cell, DVec2::splat(0.5)).is_none());
    }
    let up = FrontPatches::reflected(&front, &ball, -aim, 0.1, options);
    assert!(matches!(up, Err(Error::Miss { .. })));
    for half_width in [0.0, f64::NAN] {
        let none = FrontPatches::reflected(&front, &ball, aim, half_width, options);
        assert!(matches!(none, Err(Error::OutOfRange { .. })));
    }
    let impossible = PatchOptions {
        tolerance: 1e-30,
        most_columns: 8,
    };
    let rough = FrontPatches::reflected(&front, &ball, aim, 0.1, impossible);
    assert!(matches!(rough, Err(Error::NotConverged { .. })));
    let aimless = FrontPatches::reflected(&front, &ball, DVec3::ZERO, 0.1, options);
    assert!(matches!(aimless, Err(Error::ZeroDirection { .. })));
}
