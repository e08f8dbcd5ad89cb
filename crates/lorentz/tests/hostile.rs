//! NaN, infinities, zeros, huge and tiny numbers: an error or a finite answer, never a panic and never an endless loop.

use lorentz::construct::{
    between_points, circle_to_point, circle_to_sphere, cone, cone_between_radii, cone_parameter,
};
use lorentz::glam::{DQuat, DVec3};
use lorentz::{
    CanalChain, CanalCurve, CharacteristicCircle, Circle, Classification, ContactPatch, Error,
    Line, LorentzMap, LorentzVector, Pencil, Plane, Point, Spacing, Sphere, SphereMassPoint,
    SphereVector, Tube, TubeGrid, dandelin,
};

const NASTY: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    1e300,
    -1e160,
    1e-300,
    5e-324,
    f64::EPSILON,
];

/// A small generator of repeatable numbers, nasty ones among them.
struct Source(u64);

impl Source {
    fn next(&mut self) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    fn number(&mut self) -> f64 {
        let pick = self.next();
        match pick % 3 {
            0 => NASTY[(self.next() % 12) as usize],
            1 => (self.next() % 7) as f64 - 3.0,
            _ => {
                (self.next() as f64 / f64::from(1_u32 << 30) - 1.0)
                    * 10_f64.powi((self.next() % 40) as i32 - 20)
            }
        }
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    fn five(&mut self) -> LorentzVector {
        LorentzVector::new(self.number(), self.vector(), self.number())
    }

    fn sphere(&mut self) -> Result<SphereVector, Error> {
        match self.next() % 3 {
            0 => Ok(Plane::new(self.vector(), self.vector())?.into()),
            1 => SphereVector::along(self.five()),
            _ => Ok(Sphere::new(self.vector(), self.number())?.into()),
        }
    }

    fn point(&mut self) -> Result<Point, Error> {
        if self.next().is_multiple_of(5) {
            Ok(Point::INFINITY)
        } else {
            Point::new(self.vector())
        }
    }
}

/// Everything that can be asked of a canal curve.
fn exercise(curve: &CanalCurve, source: &mut Source) {
    let t = source.number();
    let member = curve.at(t);
    let _ = (
        member.sphere(),
        member.derivative_sphere(),
        member.speed(),
        member.vertex(),
        member.circle(),
    );
    let _ = curve.surface_point(t, source.number(), source.vector());
    let _ = (
        curve.reference(),
        curve.is_regular(),
        curve.vertices(),
        curve.reversed(),
        curve.complement(),
    );
    let _ = (
        curve.subdivide(source.number()),
        curve.sub_arc(source.number(), source.number()),
    );
    let _ = curve.circles_by_subdivision(2);
    let _ = curve.joint_with(&curve.reversed());
    let classification = curve.curve().classify();
    assert!(!classification.kind.name().is_empty());
    if let Ok(second) = curve.second_family().conic() {
        let _ = ContactPatch::new(curve.curve(), second.curve()).and_then(|patch| patch.surface());
    }
    let implicit = curve.curve().implicit();
    let x = source.vector();
    let _ = (
        implicit.value(x),
        implicit.gradient(x),
        implicit.contains(x),
        implicit.parameter(x),
    );
    let _ = (
        curve.curve().parameters_of_radius(source.number()),
        curve.curve().singular_parameters(),
        curve.curve().centre(),
    );
    let mut tube = Tube::default();
    for spacing in [Spacing::Parameter, Spacing::ArcLength] {
        let grid = TubeGrid::new(5, 4)
            .with_spacing(spacing)
            .with_interval(source.number(), source.number());
        match curve.tessellate_into(&grid, &mut tube) {
            Ok(()) => assert_eq!(tube.positions().len(), 24),
            Err(_) => assert!(tube.positions().is_empty()),
        }
        let _ = tube.triangles();
    }
}

#[test]
fn no_input_panics() {
    let mut source = Source(7);
    let (mut built, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let curve = match source.next() % 6 {
            0 => source
                .sphere()
                .and_then(|s| Ok(between_points(source.point()?, source.point()?, s)?.curve)),
            1 => cone(
                source.vector(),
                Sphere::new(source.vector(), source.number())
                    .unwrap_or(Sphere::new(DVec3::ONE, 1.0).unwrap()),
            )
            .map(|found| found.curve),
            2 => source
                .sphere()
                .and_then(|s| Ok(circle_to_point(s, source.sphere()?, source.point()?)?.curve)),
            3 => source
                .sphere()
                .and_then(|s| Ok(circle_to_sphere(s, source.sphere()?, source.sphere()?)?.curve)),
            4 => Sphere::new(source.vector(), source.number()).and_then(|s| {
                Ok(
                    cone_between_radii(source.vector(), s, [source.number(), source.number()])?
                        .curve,
                )
            }),
            _ => {
                let control = [0, 1, 2]
                    .map(|_| SphereMassPoint::from_homogeneous(source.number(), source.five()));
                let _ = Classification::of(control);
                CanalCurve::new(control)
            }
        };
        // A circle makes orthogonal pairs, which random spheres are not.
        let through =
            Circle::new(source.vector(), source.number(), source.vector()).and_then(|circle| {
                let (s, d) = CharacteristicCircle::from(circle).orthogonal_pair()?;
                Ok(circle_to_sphere(s, d, source.sphere()?)?.curve)
            });
        for curve in [curve, through] {
            match curve {
                Ok(curve) => {
                    built += 1;
                    exercise(&curve, &mut source);
                }
                Err(error) => {
                    refused += 1;
                    assert!(!error.to_string().is_empty());
                }
            }
        }
    }
    assert!(
        built > 300 && refused > 300,
        "{built} built, {refused} refused"
    );
}

#[test]
fn no_vector_or_map_panics() {
    let mut source = Source(11);
    for _ in 0..20_000 {
        let vector = source.five();
        let _ = (vector.recover(), vector.causal_type());
        let _ = (
            cone_parameter(source.number(), source.number()),
            Line::new(source.vector(), source.vector()),
        );
        let map = match source.next() % 5 {
            0 => LorentzMap::translation(source.vector()),
            1 => LorentzMap::scaling(source.number()),
            2 => LorentzMap::rotation(DQuat::from_xyzw(
                source.number(),
                source.number(),
                source.number(),
                source.number(),
            )),
            3 => LorentzMap::sending_to_infinity(
                source.point().unwrap_or(Point::ORIGIN),
                source.number(),
            ),
            _ => LorentzMap::from_columns([0, 1, 2, 3, 4].map(|_| source.five())),
        };
        let (Ok(a), Ok(b)) = (source.sphere(), source.sphere()) else {
            continue;
        };
        if let Ok(map) = map {
            let _ = (map.map_sphere(a).object(), map.inverse(), map * map);
            let _ = source.point().and_then(|p| map.map_point(p));
        }
        let _ = (a.position_of(b), a.object(), CharacteristicCircle::of(a, b));
        if let Ok(p) = source.point() {
            let _ = a.position_of_point(p);
        }
        if let Ok(pencil) = Pencil::new(a, b) {
            let _ = (
                pencil.member(source.number()),
                pencil.derivative(source.number()),
                pencil.residual(a),
            );
        }
        let _ = Sphere::new(source.vector(), source.number()).and_then(|s| {
            dandelin::plane_section(
                source.vector(),
                s,
                Plane::new(source.vector(), source.vector())?,
            )
        });
    }
}

#[test]
fn refusals_are_of_the_right_kind() {
    let sphere = |x: f64, r: f64| Sphere::new(DVec3::new(x, 0.0, 0.0), r).unwrap();
    assert!(matches!(
        Sphere::new(DVec3::ZERO, 0.0),
        Err(Error::ZeroRadius { .. })
    ));
    assert!(matches!(
        Sphere::new(DVec3::NAN, 1.0),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        Sphere::new(DVec3::splat(1e200), 1.0),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        Plane::new(DVec3::ZERO, DVec3::ONE),
        Err(Error::ZeroNormal)
    ));
    assert!(Plane::new(DVec3::splat(1e-320), DVec3::ONE).is_ok());
    assert!(matches!(
        Point::new(DVec3::INFINITY),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        cone(DVec3::new(0.2, 0.0, 0.0), sphere(0.0, 1.0)),
        Err(Error::SphereSeparatesPoints { .. })
    ));
    assert!(matches!(
        circle_to_point(
            sphere(0.0, 1.0).into(),
            sphere(1.0, 1.0).into(),
            Point::INFINITY
        ),
        Err(Error::NotOrthogonal { .. })
    ));
    assert!(matches!(
        Pencil::new(sphere(1.0, 2.0).into(), sphere(1.0, -2.0).into()),
        Err(Error::SameSphere { .. })
    ));
    assert!(matches!(
        CanalChain::new(Vec::new()),
        Err(Error::EmptyChain)
    ));
    assert!(matches!(
        cone_parameter(-1.0, 0.5),
        Err(Error::WrongSign { .. })
    ));
    assert!(matches!(
        LorentzMap::scaling(-2.0),
        Err(Error::ScaleNotPositive { .. })
    ));
    let arc = cone_between_radii(DVec3::ZERO, sphere(5.0, 3.0), [1.0, 2.0])
        .unwrap()
        .curve;
    for (steps, sectors) in [(0, 8), (8, 2), (usize::MAX, 8), (1 << 20, 1 << 20)] {
        assert!(matches!(
            arc.tessellate(&TubeGrid::new(steps, sectors)),
            Err(Error::GridSize { .. })
        ));
    }
    assert!(matches!(
        arc.surface_point(0.5, f64::NAN, DVec3::Y),
        Err(Error::NonFinite { .. })
    ));
    assert!(matches!(
        arc.surface_point(0.5, 0.0, DVec3::X),
        Err(Error::ReferenceParallelToAxis { .. })
    ));
    assert!(matches!(
        arc.surface_point(0.5, 0.0, DVec3::ZERO),
        Err(Error::ZeroNormal)
    ));
}

#[test]
fn everything_is_send_and_sync() {
    fn check<T: Send + Sync + Clone + std::fmt::Debug>() {}
    check::<CanalCurve>();
    check::<CanalChain>();
    check::<Tube>();
    check::<Pencil>();
    check::<LorentzMap>();
    check::<Error>();
}
