//! Cases in which a formula of the paper has no value, each of them part of the theory here.

use lorentz::bezier_mass::Parameter;
use lorentz::construct::{
    CircleToPointMiddle, CircleToSphereMiddle, between_points, circle_to_point, circle_to_sphere,
    cone,
};
use lorentz::glam::{DVec3, dvec3};
use lorentz::{
    CanalCurve, CharacteristicCircle, ConicType, Course, CyclideKind, Error, LorentzMap,
    LorentzVector, Object, Pencil, PencilKind, Plane, Point, Relation, Sphere, SphereCurve,
    SphereMassPoint, SphereVector, TubeGrid,
};

fn sphere(x: f64, y: f64, z: f64, radius: f64) -> SphereVector {
    Sphere::new(dvec3(x, y, z), radius).unwrap().into()
}

fn plane(normal: DVec3, point: DVec3) -> SphereVector {
    Plane::new(normal, point).unwrap().into()
}

fn curve(rows: [[f64; 6]; 3]) -> SphereCurve {
    let control = rows.map(|[w, o, x, y, z, inf]| {
        SphereMassPoint::from_homogeneous(w, LorentzVector::from_null([o, x, y, z, inf]))
    });
    SphereCurve::new(control).unwrap()
}

/// Two unit vectors with a light-like difference have product 1 without being equal: the product of the derivative
/// spheres does not tell a G1 joint.
#[test]
fn light_like_difference_is_not_a_joint() {
    // Two circles that touch on one sphere: on the unit sphere the great circle z = 0 and a small circle through (1, 0, 0).
    let shared = sphere(0.0, 0.0, 0.0, 1.0);
    let flat = plane(DVec3::Z, DVec3::ZERO);
    // d' = d + n with n along the point of contact (1, 0, 0) and so orthogonal to the shared sphere.
    let light = Point::new(DVec3::X).unwrap().vector();
    let tilted = SphereVector::along(flat.vector() + light).unwrap();
    assert!((flat.product(tilted) - 1.0).abs() < 1e-14);
    let first = circle_to_sphere(shared, -flat, sphere(0.0, 0.0, -3.0, 1.5))
        .unwrap()
        .curve
        .reversed();
    let second = circle_to_sphere(shared, tilted, sphere(0.5, 0.0, 3.0, 1.5))
        .unwrap()
        .curve;
    let joint = first.joint_with(&second).unwrap();
    assert_eq!(joint.same_sphere, Some(1.0));
    assert!((joint.derivative_product.abs() - 1.0).abs() < 1e-12);
    assert_eq!(joint.course, Course::Breaks);
    assert!(joint.gap > 0.1);
}

#[test]
fn point_on_the_derivative_sphere_gives_a_parabola() {
    // A horn torus: from the equator of a sphere to a point of the equator's plane.
    let found = circle_to_point(
        sphere(2.0, 0.0, 0.0, 1.0),
        plane(DVec3::Y, DVec3::ZERO),
        Point::ORIGIN,
    )
    .unwrap();
    assert!(matches!(found.middle, CircleToPointMiddle::Parabola { .. }));
    // To infinity: a cylinder.
    let found = circle_to_point(
        sphere(0.0, 0.0, 0.0, 1.0),
        plane(DVec3::Z, DVec3::ZERO),
        Point::INFINITY,
    )
    .unwrap();
    assert!(matches!(found.middle, CircleToPointMiddle::Parabola { .. }));
    assert_eq!(
        found.curve.curve().classify().kind,
        CyclideKind::CircularCylinder
    );
    let Object::Sphere(half_way) = found.curve.curve().member(0.5).unwrap() else {
        panic!("not a sphere")
    };
    assert!((half_way.radius() - 1.0).abs() < 1e-15);
}

#[test]
fn point_inside_the_sphere_is_reached_through_a_plane() {
    let found = circle_to_point(
        sphere(0.0, 0.0, 0.0, 2.0),
        plane(DVec3::Z, dvec3(0.0, 0.0, 0.0)),
        Point::new(dvec3(0.3, 0.0, 0.5)).unwrap(),
    )
    .unwrap();
    assert_eq!(found.light_sign, -1.0);
    let planes = found.curve.curve().parameters_of_radius(f64::INFINITY);
    assert!(
        planes
            .iter()
            .any(|p| p.value().is_some_and(|t| (0.0..1.0).contains(&t)))
    );
    assert!(found.curve.at(1.0).vertex().is_some());
}

#[test]
fn two_points_inside_the_sphere_are_valid() {
    let point = |x: f64| Point::new(dvec3(x, 0.0, 0.0)).unwrap();
    let found = between_points(point(-0.5), point(0.5), sphere(0.0, 0.0, 0.0, 1.0)).unwrap();
    let given = found.curve.at(found.parameter_of_sphere).sphere().unwrap();
    assert_eq!(
        given.same_up_to_orientation(sphere(0.0, 0.0, 0.0, 1.0)),
        Some(1.0)
    );
}

#[test]
fn ends_of_a_diameter_take_a_vector() {
    let (s, d) = (sphere(3.0, 0.0, 0.0, 1.0), plane(DVec3::Y, DVec3::ZERO));
    let found = circle_to_sphere(s, d, sphere(-3.0, 0.0, 0.0, 1.0)).unwrap();
    assert!(matches!(
        found.middle,
        CircleToSphereMiddle::Diameter { .. }
    ));
    assert_eq!(found.curve.curve().classify().kind, CyclideKind::RingTorus);
    // Half the torus is x -> y: at t = 1/2 the sphere about (0, 3, 0).
    let Object::Sphere(half_way) = found.curve.curve().member(0.5).unwrap() else {
        panic!("not a sphere")
    };
    assert!(half_way.centre().distance(dvec3(0.0, 3.0, 0.0)) < 1e-14);
}

#[test]
fn nested_spheres_of_one_orientation_pass_a_vertex() {
    let found = circle_to_sphere(
        sphere(0.0, 0.0, 0.0, 3.0),
        plane(dvec3(0.0, 0.3, 1.0), DVec3::ZERO),
        sphere(0.0, 0.0, 0.5, 1.0),
    )
    .unwrap();
    assert_eq!(found.end_weight, -1.0);
    assert!(!found.is_good_joint());
    let vertices = found.curve.vertices();
    assert_eq!(vertices.len(), 1);
    assert_eq!(found.curve.curve().quadratic().control()[2].weight, -1.0);
}

#[test]
fn planes_are_members_and_lines_are_circles() {
    // Tangent planes of a cylinder of radius 2 about the z axis.
    let planes = curve([
        [1.0, 0.0, 1.0, 0.0, 0.0, 2.0],
        [0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        [1.0, 0.0, -1.0, 0.0, 0.0, 2.0],
    ]);
    let canal = planes.canal().unwrap();
    let CharacteristicCircle::Line(line) = canal.at(0.25).circle().unwrap() else {
        panic!("not a line")
    };
    assert!(line.direction().cross(DVec3::Z).length() < 1e-15);
    assert!((line.nearest_to_origin().length() - 2.0).abs() < 1e-15);
    assert!(matches!(
        canal.surface_point(0.25, 0.0, DVec3::X),
        Err(Error::CharacteristicLine { .. })
    ));
    assert!(matches!(
        canal.tessellate(&TubeGrid::new(4, 8)),
        Err(Error::CharacteristicLine { .. })
    ));
    let (first, second) = canal.subdivide(0.5).unwrap();
    assert_eq!(first.joint_with(&second).unwrap().course, Course::Continues);
    assert_eq!(
        first.joint_with(&first.reversed()).unwrap().course,
        Course::FoldsBack
    );
    // The second family of the planes: spheres of radius 2 along the axis.
    let spheres = canal.second_family().conic().unwrap();
    let Object::Sphere(sphere) = spheres.curve().member(0.3).unwrap() else {
        panic!("not a sphere")
    };
    assert!(
        (sphere.radius().abs() - 2.0).abs() < 1e-13 && sphere.centre().truncate().length() < 1e-13
    );
}

#[test]
fn tips_have_normals_of_the_tangent_cone() {
    let whole = cone(DVec3::ZERO, Sphere::new(dvec3(0.0, 0.0, 5.0), 3.0).unwrap())
        .unwrap()
        .curve;
    let tube = whole
        .tessellate(&TubeGrid::new(8, 12).with_interval(0.0, 0.7))
        .unwrap();
    // A cone has the same normals along each of its lines, also in the vertex.
    for j in 0..12 {
        assert!(tube.positions()[j].length() < 1e-15);
        assert!(tube.normals()[j].distance(tube.normals()[8 * 12 + j]) < 1e-14);
        assert!((tube.normals()[j].z + 0.6).abs() < 1e-14);
    }
    // Its triangles turn to the normals' side, and there are none of the collapsed kind.
    assert_eq!(tube.triangles().len(), 12 * (2 * 8 - 1));
    for [a, b, c] in tube.triangles() {
        let [p, q, r] = [a, b, c].map(|i| tube.positions()[i as usize]);
        assert!((q - p).cross(r - p).dot(tube.normals()[c as usize]) > 0.0);
    }
    assert!(
        matches!(whole.tessellate(&TubeGrid::new(8, 12)), Err(Error::SingularPoint { t }) if t == 1.0)
    );
}

#[test]
fn reversed_curves_and_tips_at_the_end() {
    let horn = circle_to_point(
        sphere(0.0, 0.0, 0.0, 1.0),
        plane(DVec3::Z, DVec3::ZERO),
        Point::new(dvec3(0.5, 0.0, 3.0)).unwrap(),
    )
    .unwrap()
    .curve;
    let (there, back) = (
        horn.tessellate(&TubeGrid::new(16, 12)).unwrap(),
        horn.reversed().tessellate(&TubeGrid::new(16, 12)).unwrap(),
    );
    for tube in [there, back] {
        for [a, b, c] in tube.triangles() {
            let [p, q, r] = [a, b, c].map(|i| tube.positions()[i as usize]);
            let normal: DVec3 = [a, b, c].map(|i| tube.normals()[i as usize]).iter().sum();
            assert!((q - p).cross(r - p).dot(normal) > 0.0);
        }
    }
}

#[test]
fn touching_and_equal_spheres_are_told_apart() {
    let unit = sphere(0.0, 0.0, 0.0, 1.0);
    assert_eq!(unit.position_of(unit).relation, Relation::Identical);
    assert_eq!(unit.position_of(-unit).relation, Relation::Opposite);
    let touching = sphere(0.5, 0.0, 0.0, 0.5);
    assert!(matches!(
        unit.position_of(touching).relation,
        Relation::Tangent {
            same_orientation: true,
            ..
        }
    ));
    // Parallel planes touch at infinity.
    let (low, high) = (plane(DVec3::Z, DVec3::ZERO), plane(DVec3::Z, DVec3::Z));
    assert!(matches!(
        low.position_of(high).relation,
        Relation::Tangent {
            contact: Object::Infinity { .. },
            ..
        }
    ));
    // Far from the origin nothing changes.
    let shift = LorentzMap::translation(dvec3(1e5, 2e5, -1e5)).unwrap();
    assert!(matches!(
        shift
            .map_sphere(unit)
            .position_of(shift.map_sphere(-unit))
            .relation,
        Relation::Opposite
    ));
    let far = |x: f64, radius: f64| sphere(1e6 + x, -1e6, 1e6, radius);
    assert!(matches!(
        far(0.0, 1.0).position_of(far(0.5, 0.5)).relation,
        Relation::Tangent { .. }
    ));
    assert!(matches!(
        far(0.0, 1.0).position_of(far(0.5, 0.49)).relation,
        Relation::Disjoint { .. }
    ));
    assert!(matches!(
        far(0.0, 3.0).position_of(far(5.0, 4.0)).relation,
        Relation::Orthogonal
    ));
}

#[test]
fn concentric_spheres_have_infinity_as_a_limit_point() {
    let pencil = Pencil::new(sphere(1.0, 2.0, 3.0, 1.0), sphere(1.0, 2.0, 3.0, 2.0)).unwrap();
    let PencilKind::Poncelet { limit_points } = pencil.kind() else {
        panic!("not a Poncelet pencil")
    };
    let infinite = limit_points
        .iter()
        .filter(|p| matches!(p, Object::Infinity { .. }))
        .count();
    assert_eq!(infinite, 1);
    assert!(limit_points.iter().any(|p| {
        p.point()
            .and_then(Point::position)
            .is_some_and(|p| p.distance(dvec3(1.0, 2.0, 3.0)) < 1e-14)
    }));
}

#[test]
fn sub_arcs_reach_beyond_the_ends_and_through_infinity() {
    let half = circle_to_sphere(
        sphere(3.0, 0.0, 0.0, 1.0),
        plane(DVec3::Y, DVec3::ZERO),
        sphere(-3.0, 0.0, 0.0, 1.0),
    )
    .unwrap()
    .curve;
    // The whole conic: half of it, and the rest from the end through the parameter infinity back to the start.
    let rest = half
        .sub_arc(1.0, Parameter::new(0.0, -1.0).unwrap())
        .unwrap();
    let joint = half.joint_with(&rest).unwrap();
    assert_eq!(joint.course, Course::Continues);
    let Object::Sphere(opposite) = rest.curve().member(0.5).unwrap() else {
        panic!("not a sphere")
    };
    assert!(opposite.centre().distance(dvec3(0.0, -3.0, 0.0)) < 1e-14);
    assert_eq!(rest.joint_with(&half).unwrap().course, Course::Continues);
    assert_eq!(
        half.complement()
            .unwrap()
            .at(0.5)
            .sphere()
            .unwrap()
            .same_up_to_orientation(opposite.into()),
        Some(1.0)
    );
}

#[test]
fn iterated_subdivision_finds_the_circles() {
    let arc: CanalCurve = circle_to_sphere(
        sphere(0.0, 0.0, 0.0, 1.0),
        plane(DVec3::Z, DVec3::ZERO),
        sphere(4.0, 0.0, 1.0, 1.5),
    )
    .unwrap()
    .curve;
    let circles = arc.circles_by_subdivision(4).unwrap();
    assert_eq!(circles.len(), 17);
    for (i, circle) in circles.iter().enumerate() {
        let direct = arc.at(i as f64 / 16.0).circle().unwrap().circle().unwrap();
        let circle = circle.circle().unwrap();
        assert!(circle.centre().distance(direct.centre()) < 1e-13);
        assert!(
            (circle.radius() - direct.radius()).abs() < 1e-13
                && circle.axis().distance(direct.axis()) < 1e-13
        );
    }
}

#[test]
fn sections_of_a_cone_have_their_foci_by_elementary_geometry() {
    let ball = Sphere::new(dvec3(0.0, 0.0, 5.0), 3.0).unwrap();
    for tilt in [0.0, 0.3, 0.6, 0.9272952180016122, 1.2, 1.5] {
        let normal = dvec3(0.0, f64::sin(tilt), f64::cos(tilt));
        let section = lorentz::dandelin::plane_section(
            DVec3::ZERO,
            ball,
            Plane::new(normal, dvec3(0.0, 0.0, 4.0)).unwrap(),
        )
        .unwrap();
        // Points of the section: on the cone x^2 + y^2 = (9/16) z^2 and in the plane.
        for k in 0..40 {
            let phi = 0.157 * f64::from(k);
            let line = dvec3(3.0 * phi.cos(), 3.0 * phi.sin(), 4.0);
            let scale = normal.dot(dvec3(0.0, 0.0, 4.0)) / normal.dot(line);
            if scale.abs() > 20.0 {
                continue;
            }
            let p = scale * line;
            for found in &section.spheres {
                if let Some(directrix) = found.directrix {
                    let offset = p - directrix.nearest_to_origin();
                    let distance = offset.cross(directrix.direction()).length();
                    assert!(
                        (p.distance(found.focus) - section.eccentricity * distance).abs() < 1e-10,
                        "tilt {tilt}"
                    );
                } else {
                    assert_eq!(section.eccentricity, 0.0);
                }
            }
        }
        if let [a, b] = section.spheres.as_slice()
            && section.conic != ConicType::Parabola
        {
            assert!((a.focus - b.focus).dot(normal).abs() < 1e-12);
        }
    }
}

/// Concentric spheres have one limit point at infinity, whatever the unit of length; far apart ones have none there.
#[test]
fn limit_points_at_infinity_do_not_depend_on_the_unit() {
    for unit in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for place in [DVec3::ZERO, dvec3(0.3, -1.1, 2.3) * unit] {
            let (small, large) = (
                sphere(place.x, place.y, place.z, 0.7 * unit),
                sphere(place.x, place.y, place.z, -1.9 * unit),
            );
            let PencilKind::Poncelet { limit_points } = Pencil::new(small, large).unwrap().kind()
            else {
                panic!("another pencil")
            };
            let infinite = limit_points
                .iter()
                .filter(|point| matches!(point, Object::Infinity { .. }));
            assert_eq!(infinite.count(), 1, "{limit_points:?}");
        }
        let apart = sphere(7.0 * unit, 0.0, 0.0, 2.0 * unit);
        let PencilKind::Poncelet { limit_points } = Pencil::new(apart, sphere(0.0, 0.0, 0.0, unit))
            .unwrap()
            .kind()
        else {
            panic!("another pencil")
        };
        assert!(
            limit_points
                .iter()
                .all(|point| matches!(point, Object::Point { .. }))
        );
    }
}
