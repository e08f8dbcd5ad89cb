//! Laws that hold for all spheres, circles and maps: products under Lorentz maps, round trips, contact with the
//! envelope, joints. Seeded, so that every run tries the same cases.

use lorentz::bezier_mass::MassPoint;
use lorentz::glam::{DQuat, DVec3};
use lorentz::{
    CanalCurve, Circle, ContactPatch, Course, LorentzMap, LorentzVector, Object, OwnParameter,
    Pencil, Plane, Point, Relation, Spacing, Sphere, SphereVector, TubeGrid, construct,
    lie_product,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 200,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(41),
        ..ProptestConfig::default()
    }
}

fn vector() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-4.0..4.0_f64).prop_map(DVec3::from)
}

fn direction() -> impl Strategy<Value = DVec3> {
    vector()
        .prop_filter("too short for a direction", |v| v.length() > 0.1)
        .prop_map(DVec3::normalize)
}

fn radius() -> impl Strategy<Value = f64> {
    (0.2..3.0_f64, any::<bool>()).prop_map(|(r, positive)| if positive { r } else { -r })
}

fn sphere() -> impl Strategy<Value = Sphere> {
    (vector(), radius()).prop_map(|(centre, radius)| Sphere::new(centre, radius).unwrap())
}

/// A sphere, or sometimes a plane.
fn member() -> impl Strategy<Value = SphereVector> {
    prop_oneof![
        4 => sphere().prop_map(SphereVector::from),
        1 => (direction(), vector()).prop_map(|(n, p)| Plane::new(n, p).unwrap().into()),
    ]
}

fn map() -> impl Strategy<Value = LorentzMap> {
    let similarity = (0.3..3.0_f64, direction(), -3.0..3.0_f64, vector()).prop_map(
        |(factor, axis, angle, shift)| {
            LorentzMap::similarity(factor, DQuat::from_axis_angle(axis, angle), shift).unwrap()
        },
    );
    (similarity, member())
        .prop_map(|(similarity, mirror)| similarity * LorentzMap::inversion(mirror))
}

/// A circle with its sphere and derivative sphere at some angle of the pencil, and a sphere to reach.
fn arc() -> impl Strategy<Value = CanalCurve> {
    (vector(), 0.3..2.0_f64, direction(), -1.0..1.0_f64, sphere()).prop_filter_map(
        "no arc from this circle to this sphere",
        |(centre, radius, axis, turn, end)| {
            let pencil = Pencil::through(Circle::new(centre, radius, axis).ok()?).ok()?;
            let derivative = SphereVector::along(pencil.derivative(turn)).ok()?;
            let arc =
                construct::circle_to_sphere(pencil.member(turn), derivative, end.into()).ok()?;
            // Far spheres of strongly uneven arcs are met by the degenerate tests.
            let [_, middle, _] = arc.curve.control();
            (arc.is_good_joint() && middle.weight < 50.0).then_some(arc.curve)
        },
    )
}

/// Largest coordinate: what rounding is relative to.
fn size(vectors: &[LorentzVector]) -> f64 {
    vectors.iter().fold(1.0, |most, v| most.max(v.max_abs()))
}

proptest! {
    #![proptest_config(config())]

    /// Both bases are the same space.
    #[test]
    fn bases_agree(x in prop::array::uniform5(-9.0..9.0_f64), y in prop::array::uniform5(-9.0..9.0_f64)) {
        let (a, b) = (LorentzVector::from_null(x), LorentzVector::from_null(y));
        let (p, q) = (a.to_diagonal(), b.to_diagonal());
        let diagonal = p[1] * q[1] + p[2] * q[2] + p[3] * q[3] + p[4] * q[4] - p[0] * q[0];
        prop_assert!((a.product(b) - diagonal).abs() < 1e-12);
        let back = LorentzVector::from_diagonal(p) - a;
        prop_assert!(back.max_abs() < 1e-14);
    }

    /// What is embedded is found again.
    #[test]
    fn recovery_inverts_embedding(s in sphere(), n in direction(), p in vector(), scale in radius()) {
        let Ok(Object::Sphere(found)) = (scale.abs() * s.vector()).recover() else { panic!("no sphere") };
        prop_assert!(found.centre().distance(s.centre()) < 1e-12 && (found.radius() - s.radius()).abs() < 1e-12);
        let plane = Plane::new(n, p).unwrap();
        let Ok(Object::Plane(found)) = plane.vector().recover() else { panic!("no plane") };
        prop_assert!(found.normal().distance(plane.normal()) < 1e-14);
        prop_assert!((found.offset() - plane.offset()).abs() < 1e-13);
        let Ok(Object::Point { point, scale: found }) = (scale * Point::new(p).unwrap().vector()).recover() else {
            panic!("no point")
        };
        prop_assert!(point.position().unwrap().distance(p) < 1e-14 && found == scale);
    }

    /// Lorentz maps preserve products; composition and inverse are those of matrices.
    #[test]
    fn maps_preserve_products(f in map(), g in map(), a in member(), b in member()) {
        let (fa, fb) = (f.map_sphere(a), f.map_sphere(b));
        let tolerance = 1e-14 * size(&[fa.vector()]) * size(&[fb.vector()]);
        prop_assert!((fa.vector().product(fb.vector()) - a.vector().product(b.vector())).abs() < tolerance.max(1e-12));
        let composed = (g * f).map_vector(a.vector()) - g.map_vector(fa.vector());
        prop_assert!(composed.max_abs() < 1e-12 * size(&g.columns()) * size(&f.columns()));
        let back = f.inverse().map_vector(fa.vector()) - a.vector();
        prop_assert!(back.max_abs() < 1e-12 * size(&f.columns()) * size(&f.inverse().columns()));
        prop_assert!(LorentzMap::from_columns((g * f).columns()).is_ok());
    }

    /// The product of two spheres is what elementary geometry says, and so is the relation.
    #[test]
    fn products_are_elementary(s in sphere(), t in sphere()) {
        let (a, b) = (SphereVector::from(s), SphereVector::from(t));
        let distance = s.centre().distance(t.centre());
        let cosine = (s.radius().powi(2) + t.radius().powi(2) - distance * distance) / (2.0 * s.radius() * t.radius());
        prop_assert!((a.product(b) - cosine).abs() < 1e-11 * cosine.abs().max(1.0));
        let (r, q) = (s.radius().abs(), t.radius().abs());
        let meet = distance < r + q && distance > (r - q).abs();
        match a.position_of(b).relation {
            Relation::Secant { .. } | Relation::Orthogonal => prop_assert!(meet),
            Relation::Disjoint { .. } => prop_assert!(!meet),
            other => prop_assert!(false, "random spheres are not {}", other.name()),
        }
    }

    /// Members of a pencil are unit vectors of it, and its derivative is the derivative.
    #[test]
    fn pencils_hold_their_members(a in member(), b in member(), parameter in -2.0..2.0_f64) {
        let pencil = Pencil::new(a, b).unwrap();
        let (x, d) = (pencil.member(parameter), pencil.derivative(parameter));
        let scale = size(&[x.vector(), d]).powi(2);
        prop_assert!((x.vector().square() - 1.0).abs() < 1e-11 * scale);
        prop_assert!(x.vector().product(d).abs() < 1e-11 * scale);
        prop_assert!(pencil.contains(x) && pencil.contains(b));
        let h = 1e-5;
        let difference = (pencil.member(parameter + h).vector() - pencil.member(parameter - h).vector()) / (2.0 * h);
        prop_assert!((difference - d).max_abs() < 1e-6 * scale);
    }

    /// Every vertex of a tessellation lies on its sphere, on the envelope, with the sphere's unit normal there.
    #[test]
    fn vertices_lie_on_the_envelope(arc in arc()) {
        let grid = TubeGrid::new(12, 16).with_spacing(Spacing::ArcLength);
        let tube = arc.tessellate(&grid).unwrap();
        let implicit = arc.curve().implicit();
        for (i, &t) in tube.parameters().iter().enumerate() {
            let member = arc.at(t);
            let (Some(sphere), Some(derivative)) = (member.sphere(), member.derivative_sphere()) else {
                panic!("a vertex inside a good arc")
            };
            let radius = 1.0 / sphere.curvature().abs();
            for j in 0..16 {
                let (p, n) = (tube.positions()[16 * i + j], tube.normals()[16 * i + j]);
                let at = Point::new(p).unwrap();
                // Coordinates of up to about 30: 1e-12 of the radius, and their own rounding.
                let tolerance = 1e-12 * radius.min(1e3) + 1e-14 * p.length();
                prop_assert!(sphere.product_with_point(at).abs() < tolerance);
                prop_assert!(derivative.vector().product(at.vector()).abs() < 1e-11 * size(&[derivative.vector(), at.vector()]));
                prop_assert!((n.length() - 1.0).abs() < 1e-14);
                prop_assert!(n.distance(sphere.normal_at(p)) < 1e-11 * size(&[sphere.vector()]));
                prop_assert!(implicit.residual(p).abs() < 1e-12);
                if let OwnParameter::At(found) = implicit.parameter(p) {
                    // The square root of rounding: the zero is double.
                    prop_assert!(found.value().is_none_or(|found| (found - t).abs() < 1e-5));
                }
            }
        }
    }

    /// The normal is orthogonal to the surface as the differences of neighbouring points see it.
    #[test]
    fn normals_are_normal(arc in arc(), t in 0.05..0.95_f64, theta in 0.0..6.2_f64) {
        let (h, reference) = (1e-5, arc.reference());
        let at = |t, theta| arc.surface_point(t, theta, reference).unwrap();
        let x = at(t, theta);
        for step in [at(t + h, theta).position - at(t - h, theta).position, at(t, theta + h).position - at(t, theta - h).position] {
            prop_assert!(x.normal.dot(step).abs() <= 1e-8 * step.length() + 1e-13 * (1.0 + x.position.length()));
        }
    }

    /// Cutting a curve anywhere leaves a joint that continues; running the second part backwards folds back.
    #[test]
    fn cut_curves_join(arc in arc(), t in 0.1..0.9_f64, f in map()) {
        let (first, second) = arc.subdivide(t).unwrap();
        let joint = first.joint_with(&second).unwrap();
        prop_assert_eq!(joint.course, Course::Continues);
        prop_assert!(joint.angle < 1e-10);
        prop_assert_eq!(joint.same_sphere, Some(1.0));
        let fold = first.joint_with(&first.reversed()).unwrap();
        prop_assert_eq!(fold.course, Course::FoldsBack);
        // G1 survives every Lorentz map that keeps the joint in sight.
        if let (Ok(a), Ok(b)) = (first.mapped(&f), second.mapped(&f))
            && a.at(1.0).circle().is_ok_and(|c| c.circle().is_some_and(|c| c.centre().length() < 50.0 && c.radius() > 0.02)) {
            prop_assert!(a.joint_with(&b).unwrap().angle < 1e-8);
        }
    }

    /// All spheres of the second family touch all of the first; the contact patch is the surface.
    #[test]
    fn the_second_family_touches_the_first(arc in arc(), s in 0.0..1.0_f64, u in 0.0..1.0_f64) {
        let second = arc.second_family().conic().unwrap();
        let (b, e) = (arc.curve().quadratic().at(s), second.curve().quadratic().at(u));
        let terms = size(&[b.weighted]) * size(&[e.weighted]);
        prop_assert!(lie_product(b, e).abs() < 1e-11 * terms);
        let patch = ContactPatch::new(arc.curve(), second.curve()).unwrap();
        let contact = patch.contact(s, u);
        prop_assert!(contact.square().abs() < 1e-10 * contact.coordinate_square());
        if contact.o.abs() > 1e-6 * contact.max_abs() {
            prop_assert!(arc.curve().implicit().residual(contact.v / contact.o).abs() < 1e-10);
            let point = patch.surface().unwrap().point(s, u).unwrap();
            prop_assert!(point.distance(contact.v / contact.o) < 1e-9 * (1.0 + point.length()));
        }
        // And the other way round: the second family of the second is the first.
        let again = second.second_family();
        for b in arc.control() {
            let left = again.project(*b) - *b;
            prop_assert!(left.weighted.max_abs() < 1e-8 * size(&[b.weighted]));
        }
    }

    /// The kind of a cyclide does not change under similarities, nor by cutting, reversing or taking the other family.
    #[test]
    fn kinds_are_invariant(arc in arc(), factor in 0.1..10.0_f64, axis in direction(), shift in vector()) {
        let kind = arc.curve().classify().kind;
        let similarity = LorentzMap::similarity(factor, DQuat::from_axis_angle(axis, 1.0), shift).unwrap();
        prop_assert_eq!(arc.curve().mapped(&similarity).unwrap().classify().kind, kind);
        prop_assert_eq!(arc.sub_arc(0.2, 0.7).unwrap().curve().classify().kind, kind);
        prop_assert_eq!(arc.reversed().curve().classify().kind, kind);
        prop_assert_eq!(arc.second_family().conic().unwrap().curve().classify().kind, kind);
    }

    /// Parameters of a given radius, of given contact: what is asked for is there.
    #[test]
    fn members_are_found(arc in arc(), t in 0.0..1.0_f64, other in member()) {
        let Some(sphere) = arc.at(t).sphere() else { return Ok(()) };
        let radius = 1.0 / sphere.curvature();
        if radius.abs() < 1e3 {
            let found = arc.curve().parameters_of_radius(radius);
            prop_assert!(found.iter().any(|p| p.value().is_some_and(|p| (p - t).abs() < 1e-4)));
        }
        for value in [0.0, 1.0, -1.0] {
            for p in arc.curve().parameters_of_product(other, value).iter().filter_map(|p| p.value()) {
                if let Some(found) = arc.at(p).sphere().filter(|_| (-2.0..3.0).contains(&p)) {
                    let scale = size(&[found.vector()]) * size(&[other.vector()]);
                    prop_assert!((found.vector().product(other.vector()) - value).abs() < 1e-8 * scale);
                }
            }
        }
    }

    /// Controls that were moved off the quadric are refused.
    #[test]
    fn curves_off_the_quadric_are_refused(arc in arc(), error in 1e-6..1e-2_f64, which in 0..3_usize) {
        let mut control = *arc.control();
        control[which] += MassPoint::vector(LorentzVector::new(error, DVec3::splat(error), error));
        prop_assert!(CanalCurve::new(control).is_err());
    }
}
