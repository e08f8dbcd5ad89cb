//! The cases on oriented spheres, curves of spheres and cyclides.

use integration_tests::{Case, Tolerance, numbers, rows};
use lorentz::construct::{
    self, CircleToPointMiddle, CircleToSphereMiddle, between_points, circle_to_point,
    circle_to_sphere,
};
use lorentz::glam::DVec3;
use lorentz::{
    CanalCurve, CharacteristicCircle, Classification, ContactPatch, Error, LorentzMap,
    LorentzVector, Object, OwnParameter, Pencil, PencilKind, Plane, Point, Relation, Side, Sphere,
    SphereCurve, SphereMassPoint, SphereVector, dandelin,
};
use serde_json::{Value, json};

type Answer = Result<(), Error>;

/// Answers a case of this part of the file; `false` if its kind belongs elsewhere.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let answer: fn(&Case<'_>) -> Answer = match case.kind() {
        "basis_conversion" => basis_conversion,
        "lorentz_product" => lorentz_product,
        "embed" => embed,
        "recover" => recover,
        "point_object" => point_object,
        "sphere_sphere" => sphere_sphere,
        "pencil" => pencil,
        "characteristic_circle" => characteristic_circle,
        "sphere_curve_state" => sphere_curve_state,
        "surface_point" => surface_point,
        "algorithm1" => algorithm1,
        "algorithm2" => algorithm2,
        "circle_and_sphere" => circle_and_sphere,
        "lemma2" => lemma2,
        "classification" => classification,
        "inversion" => inversion,
        "send_to_infinity" => send_to_infinity,
        "dandelin" => dandelin_spheres,
        "g1_joint" => g1_joint,
        "second_conic" => second_conic,
        "implicit" => implicit,
        "biquadratic" => biquadratic,
        "cone_patch" => cone_patch,
        "seahorse" => seahorse,
        "paper_numbers" => paper_numbers,
        _ => return false,
    };
    if let Err(error) = answer(case) {
        let words = category(&error);
        case.refuse(words, |wanted| words == wanted);
    }
    true
}

/// The seahorse and the paper's printed numbers, as cases; a file may lack them.
pub(crate) fn data_set_cases(file: &Value) -> Vec<Case<'_>> {
    let data = [
        ("seahorse", Tolerance::RelativeToLargest(1e-9)),
        ("paper_numbers", Tolerance::RelativeToLargest(1e-12)),
    ];
    let present = data
        .into_iter()
        .filter_map(|(key, tolerance)| Some((key, tolerance, file.get(key)?)));
    present
        .map(|(key, tolerance, value)| {
            let expected = if key == "seahorse" {
                &value["expected"]
            } else {
                value
            };
            Case::new(key, key, value).expecting(expected, tolerance)
        })
        .collect()
}

/// The words of the reference for a refusal.
fn category(error: &Error) -> &'static str {
    match error {
        Error::ZeroRadius { .. } => "zero radius",
        Error::ZeroNormal => "zero normal",
        Error::ZeroVector => "zero vector",
        Error::TimeLike { .. } => "time-like vector",
        Error::SameSphere { .. } => "same sphere up to orientation",
        Error::NotOrthogonal { .. } => "spheres are not orthogonal",
        Error::NotSpaceLike { .. } => "tangent is not space-like",
        Error::SingularPoint { .. } => "singular point",
        Error::CharacteristicLine { .. } => "characteristic line",
        Error::ReferenceParallelToAxis { .. } => "reference parallel to axis",
        Error::CoincidentPoints => "the two points coincide",
        Error::PointOnSphere { .. } => "a point lies on the sphere",
        Error::SphereSeparatesPoints { .. } => "the sphere separates the two points",
        Error::PointOnFirstSphere { .. } => "the point lies on the first sphere",
        Error::SecondEqualsFirst { .. } => "second sphere equals the first up to orientation",
        Error::TangentSameOrientation => "the two spheres are tangent with the same orientation",
        Error::WrongSign { .. } => "radius must have the sign of the weight",
        Error::SingularJoint => "joint at a singular point",
        Error::PlaneThroughVertex { .. } => "the plane passes through the vertex",
        Error::Bezier(bezier_mass::Error::SingularHomography { .. }) => "singular homography",
        _ => "a refusal without a category",
    }
}

fn basis_conversion(case: &Case<'_>) -> Answer {
    if case.get("null").is_some() {
        case.compare(
            "diag",
            json!(LorentzVector::from_null(five(&case.numbers("null"))).to_diagonal()),
        );
    } else {
        case.compare(
            "null",
            json!(LorentzVector::from_diagonal(five(&case.numbers("diag"))).to_null()),
        );
    }
    Ok(())
}

fn lorentz_product(case: &Case<'_>) -> Answer {
    let [x, y] = ["x", "y"].map(|key| LorentzVector::from_null(five(&case.numbers(key))));
    case.compare("product", x.product(y));
    Ok(())
}

fn embed(case: &Case<'_>) -> Answer {
    case.compare("vector", vector_json(object_vector(case.input())?));
    Ok(())
}

fn recover(case: &Case<'_>) -> Answer {
    let object = LorentzVector::from_null(five(&case.numbers("vector"))).recover()?;
    compare_all(case, &object_json(object));
    Ok(())
}

fn point_object(case: &Case<'_>) -> Answer {
    let object = &case.input()["object"];
    let (point, surface) = (point(&case.input()["point"])?, sphere_or_plane(object)?);
    let position = surface.position_of_point(point);
    case.compare("product", position.product);
    case.compare("on", position.side == Side::On);
    let place = point.position().unwrap_or(DVec3::NAN);
    match surface.object()? {
        Object::Sphere(sphere) => {
            case.compare("power", sphere.power(place));
            case.compare(
                "side",
                match position.side {
                    Side::On => "on",
                    Side::Inside => "inside",
                    _ => "outside",
                },
            );
        }
        Object::Plane(plane) => case.compare("signed_distance", plane.signed_distance(place)),
        _ => case.fail("neither a sphere nor a plane".to_owned()),
    }
    Ok(())
}

fn sphere_sphere(case: &Case<'_>) -> Answer {
    let (a, b) = (input_sphere(case, "a")?, input_sphere(case, "b")?);
    let position = a.position_of(b);
    case.compare("product", position.product);
    case.compare("difference_squared", 2.0 - 2.0 * position.product);
    case.compare("relation", position.relation.name());
    if let Relation::Tangent { contact, .. } = position.relation {
        case.compare("contact", object_json(contact));
    }
    Ok(())
}

fn pencil(case: &Case<'_>) -> Answer {
    let pencil = Pencil::new(input_sphere(case, "a")?, input_sphere(case, "b")?)?;
    case.compare(
        "kind",
        match pencil.kind() {
            PencilKind::BaseCircle(_) => "base circle",
            PencilKind::Tangent { .. } => "tangent",
            PencilKind::Poncelet { .. } => "poncelet",
        },
    );
    match pencil.kind() {
        PencilKind::BaseCircle(circle) => case.compare("circle", circle_json(circle)),
        PencilKind::Tangent { contact } => case.compare("contact", object_json(contact)),
        PencilKind::Poncelet { limit_points } => {
            case.compare("limit_points", json!(limit_points.map(object_json)));
        }
    }
    Ok(())
}

fn characteristic_circle(case: &Case<'_>) -> Answer {
    let circle = CharacteristicCircle::of(input_sphere(case, "a")?, input_sphere(case, "b")?)?;
    compare_all(case, &circle_json(circle));
    Ok(())
}

fn sphere_curve_state(case: &Case<'_>) -> Answer {
    let member = CanalCurve::from_curve(input_curve(case, "control")?)?.at(case.number("t"));
    if let Some(vertex) = member.vertex() {
        case.compare("kind", "singular point");
        case.compare("point", object_json(vertex));
        return Ok(());
    }
    let (Some(sphere), Some(derivative), Some(speed)) =
        (member.sphere(), member.derivative_sphere(), member.speed())
    else {
        case.fail("no sphere and no vertex".to_owned());
        return Ok(());
    };
    case.compare("kind", "sphere");
    case.compare("weight", member.weight());
    case.compare("sigma", vector_json(sphere.vector()));
    case.compare("derivative_sphere", vector_json(derivative.vector()));
    case.compare("speed", speed);
    case.compare("sphere", object_json(sphere.object()?));
    case.compare("circle", circle_json(member.circle()?));
    Ok(())
}

fn surface_point(case: &Case<'_>) -> Answer {
    let canal = CanalCurve::from_curve(input_curve(case, "control")?)?;
    let x = canal.surface_point(
        case.number("t"),
        case.number("theta"),
        space(&case.input()["reference"]),
    )?;
    case.compare("position", json!(x.position.to_array()));
    case.compare("normal", json!(x.normal.to_array()));
    Ok(())
}

fn algorithm1(case: &Case<'_>) -> Answer {
    let second = case.get("second").map_or(Ok(Point::INFINITY), point)?;
    let found = between_points(
        point(&case.input()["point"])?,
        second,
        input_sphere(case, "sphere")?,
    )?;
    case.compare("Omega", vector_json(found.centre));
    case.compare("w1", found.weight);
    case.compare("control_homogeneous", control_json(found.curve.curve()));
    let given = found.curve.at(found.parameter_of_sphere).sphere();
    let sphere = input_sphere(case, "sphere")?;
    case.require(
        given.is_some_and(|given| given.same_up_to_orientation(sphere) == Some(1.0)),
        "the given sphere is not where it should be on the curve",
    );
    Ok(())
}

fn algorithm2(case: &Case<'_>) -> Answer {
    let found = circle_to_point(
        input_sphere(case, "s1")?,
        input_sphere(case, "derivative")?,
        point(&case.input()["point"])?,
    )?;
    match found.middle {
        CircleToPointMiddle::Hyperbola {
            centre,
            point,
            weight,
        } => {
            case.compare("case", "hyperbola");
            case.compare("centre", vector_json(centre));
            case.compare("P1", vector_json(point));
            case.compare("w1", weight);
        }
        CircleToPointMiddle::Parabola { .. } => case.compare("case", "parabola"),
    }
    case.compare("light_sign", found.light_sign);
    case.compare("control", control_json(found.curve.curve()));
    Ok(())
}

fn circle_and_sphere(case: &Case<'_>) -> Answer {
    let found = circle_to_sphere(
        input_sphere(case, "s1")?,
        input_sphere(case, "derivative")?,
        input_sphere(case, "s2")?,
    )?;
    match found.middle {
        CircleToSphereMiddle::General { point, weight } => {
            case.compare("case", "general");
            case.compare("P1", vector_json(point));
            case.compare("w1", weight);
        }
        CircleToSphereMiddle::Diameter { .. } => case.compare("case", "diameter"),
    }
    case.compare("w2", found.end_weight);
    case.compare("plane", found.conic.name());
    case.compare("regular", found.is_regular);
    if let Some(centre) = found.centre {
        case.compare("centre", vector_json(centre));
    }
    case.compare("control", control_json(found.curve.curve()));
    Ok(())
}

fn lemma2(case: &Case<'_>) -> Answer {
    case.compare(
        "t",
        construct::cone_parameter(case.number("radius"), case.number("w"))?,
    );
    Ok(())
}

fn classification(case: &Case<'_>) -> Answer {
    compare_all(
        case,
        &classification_json(&Classification::of(input_control(case, "control"))?),
    );
    Ok(())
}

fn inversion(case: &Case<'_>) -> Answer {
    let map = LorentzMap::inversion(input_sphere(case, "mirror")?);
    let image = map.map_vector(object_vector(&case.input()["object"])?);
    case.compare("vector", vector_json(image));
    case.compare("recovered", object_json(image.recover()?));
    Ok(())
}

fn send_to_infinity(case: &Case<'_>) -> Answer {
    let (place, radius) = (space(&case.input()["to_infinity"]), case.number("radius"));
    let mirror = SphereVector::from(Sphere::new(place, radius)?);
    case.compare("mirror", vector_json(mirror.vector()));
    let map = LorentzMap::sending_to_infinity(Point::new(place)?, radius)?;
    let image = input_curve(case, "control")?.mapped(&map)?;
    case.compare("control", control_json(&image));
    case.compare("classification", image.classify().kind.name());
    Ok(())
}

fn dandelin_spheres(case: &Case<'_>) -> Answer {
    let sphere = Sphere::new(space(&case.input()["centre"]), case.number("radius"))?;
    let plane = Plane::new(
        space(&case.input()["normal"]),
        space(&case.input()["point"]),
    )?;
    let section = dandelin::plane_section(space(&case.input()["vertex"]), sphere, plane)?;
    case.compare("g", section.centre_product);
    case.compare("h", section.vertex_distance);
    case.compare("eccentricity", section.eccentricity);
    case.compare("kind", section.name());
    let spheres: Vec<Value> = section
        .spheres
        .iter()
        .zip(case.expected()["spheres"].as_array().into_iter().flatten())
        .map(|(found, wanted)| {
            let mut value = dandelin_sphere_json(found, wanted);
            // Of a cone with negative radii the axis points with growing radius here; along the curve of Algorithm 1
            // the spheres move the other way, and the file may mean either.
            let wanted_axis = &wanted["cone_circle"]["axis"];
            if sphere.radius() < 0.0
                && numbers(wanted_axis)
                    .is_some_and(|axis| DVec3::from_slice(&axis).dot(found.circle.axis()) < 0.0)
            {
                value["cone_circle"]["axis"] = json!((-found.circle.axis()).to_array());
            }
            value
        })
        .collect();
    case.require(
        section.spheres.len() == spheres.len(),
        "another number of spheres",
    );
    case.compare("spheres", spheres);
    Ok(())
}

/// A line may be given by any of its points and either direction: brought to the wanted ones if it is the same line.
fn dandelin_sphere_json(found: &dandelin::DandelinSphere, wanted: &Value) -> Value {
    let mut value = json!({
        "contact_sign": found.contact_sign,
        "radius": found.sphere.radius(),
        "centre": found.sphere.centre().to_array(),
        "focus": found.focus.to_array(),
        "cone_circle": circle_json(found.circle.into()),
        "t": found.t,
    });
    if let Some(line) = found.directrix {
        let sign = space(&wanted["directrix"]["direction"])
            .dot(line.direction())
            .signum();
        let offset = space(&wanted["directrix"]["point"]) - line.nearest_to_origin();
        let point = line.nearest_to_origin() + offset.dot(line.direction()) * line.direction();
        value["directrix"] =
            json!({"direction": (sign * line.direction()).to_array(), "point": point.to_array()});
    }
    value
}

fn g1_joint(case: &Case<'_>) -> Answer {
    let [first, second] = ["first", "second"].map(|key| input_curve(case, key)?.canal());
    let joint = first?.joint_with(&second?)?;
    case.compare("same_sphere", joint.same_sphere.is_some());
    case.compare("g1", joint.is_g1());
    if let Some(orientation) = joint.same_sphere {
        case.compare("orientation", orientation);
        case.compare("direction", joint.direction());
        case.compare("d1_dot_d2", joint.derivative_product);
    }
    Ok(())
}

fn second_conic(case: &Case<'_>) -> Answer {
    let curve = input_curve(case, "control")?;
    let family = curve.canal()?.second_family();
    case.compare("projector", json!(family.projector()));
    let classified = curve.classify();
    case.compare("kind", classified.kind.name());
    if let Some(invariants) = classified.invariants {
        case.compare("second_conic", invariants.second_conic.name());
    }
    // The conic found lies in the span: the projector leaves its controls alone.
    for e in family.conic()?.control() {
        let left = family.project(*e) - *e;
        let magnitude = |b: SphereMassPoint| b.weighted.max_abs().max(b.weight.abs());
        // The entries of the projector multiply the control's: rounding of 36 products.
        let scale = family
            .projector()
            .as_flattened()
            .iter()
            .fold(1.0_f64, |most, p| most.max(p.abs()));
        case.require(
            magnitude(left) <= 1e-13 * scale * magnitude(*e),
            "a control of the second conic is not Lie-orthogonal to the first",
        );
    }
    Ok(())
}

fn implicit(case: &Case<'_>) -> Answer {
    let equation = input_curve(case, "control")?.implicit();
    let x = space(&case.input()["point"]);
    case.compare("v", json!(equation.products(x)));
    case.compare("F", equation.value(x));
    case.compare("on", equation.contains(x));
    if equation.contains(x)
        && let OwnParameter::At(parameter) = equation.parameter(x)
    {
        case.compare(
            "t",
            parameter.value().map_or(json!("infinity"), |t| json!(t)),
        );
    }
    Ok(())
}

fn biquadratic(case: &Case<'_>) -> Answer {
    let patch = ContactPatch::new(
        &input_curve(case, "control")?,
        &input_curve(case, "second")?,
    )?;
    let [first_row, ..] = patch.net();
    case.compare(
        "net_first_row",
        json!(first_row.map(LorentzVector::to_null)),
    );
    let (s, t) = (case.number("s"), case.number("t"));
    case.compare("point", object_json(patch.contact(s, t).recover()?));
    let surface = patch.surface()?.at(s, t);
    let agree = (surface.weight - patch.contact(s, t).o).abs() < 1e-12;
    case.require(agree, "the biquadratic patch is not the contact map");
    Ok(())
}

fn cone_patch(case: &Case<'_>) -> Answer {
    let sphere = Sphere::new(space(&case.input()["centre"]), case.number("radius"))?;
    let radii = case.numbers("radii");
    let patch = construct::cone_between_radii(
        space(&case.input()["vertex"]),
        sphere,
        [radii[0], radii[1]],
    )?;
    case.compare("centre_Omega", vector_json(patch.cone.centre));
    case.compare("w", patch.cone.weight);
    case.compare("t", json!(patch.parameters));
    case.compare("P", vector_json(patch.middle));
    case.compare("w_mid", patch.weight);
    let [start, _, end] = patch.curve.control();
    let ends =
        [start, end].map(|b| json!({"w": b.weight, "x": vector_json(b.weighted / b.weight)}));
    case.compare("ends", json!(ends));
    Ok(())
}

/// The chain of Section 4.2, each arc from the end of the previous one.
fn seahorse(case: &Case<'_>) -> Answer {
    let input = &case.input()["input"];
    let (ring, angle) = (&input["C0"], |key: &str| {
        input["C0"][key].as_f64().expect("an angle")
    });
    let (phi, turn) = (angle("axis_angle"), angle("pencil_angle"));
    let great = Sphere::new(space(&ring["centre"]), angle("radius"))?;
    let plane = Plane::new(DVec3::new(phi.cos(), 0.0, phi.sin()), great.centre())?;
    let pencil = Pencil::new(great.into(), plane.into())?;
    let (s0, d0) = (
        pencil.member(turn),
        SphereVector::along(pencil.derivative(turn))?,
    );
    case.compare("sigma0", vector_json(s0.vector()));
    case.compare("derivative_sphere0", vector_json(d0.vector()));
    case.compare("S0", object_json(s0.object()?));
    case.compare("derivative_S0", object_json(d0.object()?));

    let tail = circle_to_point(s0, d0, point(&input["M0"])?)?;
    let mut answers = Vec::new();
    if let CircleToPointMiddle::Hyperbola { point, weight, .. } = tail.middle {
        answers.push(arc_json(
            &tail.curve,
            &case.expected()["arcs"][0],
            &json!({
                "w1": weight, "P1": vector_json(point),
            }),
        ));
    }
    let (mut sphere, mut derivative) = (s0, d0);
    for (index, next) in input["spheres"]
        .as_array()
        .expect("spheres")
        .iter()
        .enumerate()
    {
        let target = sphere_or_plane(next)?;
        let arc = circle_to_sphere(sphere, derivative, target)?;
        if let CircleToSphereMiddle::General { point, weight } = arc.middle {
            answers.push(arc_json(&arc.curve, &case.expected()["arcs"][index + 1], &json!({
                "w1": weight, "P1": vector_json(point), "plane": arc.conic.name(), "regular": arc.is_regular,
                "sigma_dot_sigma": sphere.product(target), "derivative_dot_sigma2": derivative.product(target),
            })));
        }
        let end = arc.curve.at(1.0);
        (sphere, derivative) = (target, end.derivative_sphere().ok_or(Error::SingularJoint)?);
    }
    case.compare("arcs", answers);
    Ok(())
}

/// What the reference lists of an arc; its name is a label.
fn arc_json(curve: &CanalCurve, wanted: &Value, known: &Value) -> Value {
    let mut value = known.clone();
    value["name"] = wanted["name"].clone();
    value["control_homogeneous"] = control_json(curve.curve());
    value["kappa2"] = json!(curve.curve().envelope_invariant());
    value["classification"] = json!(curve.curve().classify().kind.name());
    let circles = wanted["circles"]
        .as_array()
        .expect("circles")
        .iter()
        .map(|circle| {
            let t = circle["t"].as_f64().expect("a parameter");
            let mut found = curve.at(t).circle().map_or(Value::Null, circle_json);
            found["t"] = json!(t);
            found
        });
    value["circles"] = circles.collect();
    value
}

/// The dorsal fin, to the digits that the paper prints and to those of the reference.
fn paper_numbers(case: &Case<'_>) -> Answer {
    let sphere = Sphere::new(DVec3::new(2.0, 0.0, 16.0), 2.0)?;
    let fin = construct::cone_between_radii(
        DVec3::new(-25.0 / 3.0, 0.0, 43.0 / 3.0),
        sphere,
        [2.0, 3.0],
    )?;
    let [t_d, t_e] = fin.parameters;
    // Half a unit of the last printed digit.
    case.compare_within("t_d", t_d, Tolerance::Absolute(5e-4));
    case.compare_within("t_e", t_e, Tolerance::Absolute(5e-4));
    case.compare_within("w_e", fin.weight, Tolerance::Absolute(5e-4));
    case.compare_within("P_e", vector_json(fin.middle), Tolerance::Absolute(5e-5));
    case.compare("computed", json!({
        "w_d": fin.cone.weight, "t_d": t_d, "t_e": t_e, "P_e": vector_json(fin.middle), "w_e": fin.weight,
        "omega": vector_json(fin.cone.centre),
    }));
    Ok(())
}

/// Compares every entry of `answer` under its own key.
fn compare_all(case: &Case<'_>, answer: &Value) {
    for (key, value) in answer.as_object().expect("an object") {
        case.compare(key, value.clone());
    }
}

fn five(list: &[f64]) -> [f64; 5] {
    list.try_into().expect("five coordinates")
}

fn space(value: &Value) -> DVec3 {
    let list: [f64; 3] = numbers(value)
        .and_then(|list| list.try_into().ok())
        .expect("three coordinates");
    list.into()
}

/// A finite point, or the word for the point at infinity.
fn point(value: &Value) -> Result<Point, Error> {
    if value.as_str() == Some("infinity") {
        Ok(Point::INFINITY)
    } else {
        Point::new(space(value))
    }
}

/// An object by its keys, or a raw 5-vector, or infinity.
fn object_vector(value: &Value) -> Result<LorentzVector, Error> {
    if value.is_array() {
        return Ok(LorentzVector::from_null(five(
            &numbers(value).expect("numbers"),
        )));
    }
    if value.is_string() {
        return Ok(point(value)?.vector());
    }
    if let Some(position) = value.get("position") {
        return Ok(point(position)?.vector());
    }
    Ok(sphere_or_plane(value)?.vector())
}

fn sphere_or_plane(value: &Value) -> Result<SphereVector, Error> {
    if let Some(coordinates) = numbers(value) {
        return SphereVector::along(LorentzVector::from_null(five(&coordinates)));
    }
    if let Some(normal) = value.get("normal") {
        return Ok(Plane::new(space(normal), space(&value["point"]))?.into());
    }
    let radius = value["radius"].as_f64().expect("a radius");
    Ok(Sphere::new(space(&value["centre"]), radius)?.into())
}

fn input_sphere(case: &Case<'_>, key: &str) -> Result<SphereVector, Error> {
    sphere_or_plane(&case.input()[key])
}

fn input_curve(case: &Case<'_>, key: &str) -> Result<SphereCurve, Error> {
    SphereCurve::new(input_control(case, key))
}

fn input_control(case: &Case<'_>, key: &str) -> [SphereMassPoint; 3] {
    let list = rows(&case.input()[key]).expect("a list of 6-vectors");
    let control = |row: &Vec<f64>| {
        SphereMassPoint::from_homogeneous(row[0], LorentzVector::from_null(five(&row[1..])))
    };
    list.iter()
        .map(control)
        .collect::<Vec<_>>()
        .try_into()
        .expect("three controls")
}

fn vector_json(vector: LorentzVector) -> Value {
    json!(vector.to_null())
}

fn control_json(curve: &SphereCurve) -> Value {
    let row = |b: &SphereMassPoint| [&[b.weight], b.weighted.to_null().as_slice()].concat();
    json!(curve.control().iter().map(row).collect::<Vec<_>>())
}

fn object_json(object: Object) -> Value {
    match object {
        Object::Point { point, scale } => {
            json!({"kind": "point", "position": point.position().map(|p| p.to_array()), "scale": scale})
        }
        Object::Infinity { .. } => json!({"kind": "infinity"}),
        Object::Sphere(sphere) => {
            json!({"kind": "sphere", "centre": sphere.centre().to_array(), "radius": sphere.radius()})
        }
        Object::Plane(plane) => {
            json!({"kind": "plane", "normal": plane.normal().to_array(), "offset": plane.offset()})
        }
    }
}

fn circle_json(circle: CharacteristicCircle) -> Value {
    match circle {
        CharacteristicCircle::Circle(circle) => json!({
            "kind": "circle", "centre": circle.centre().to_array(), "radius": circle.radius(),
            "axis": circle.axis().to_array(),
        }),
        CharacteristicCircle::Line(line) => json!({
            "kind": "line", "direction": line.direction().to_array(),
            "nearest_to_origin": line.nearest_to_origin().to_array(),
        }),
    }
}

fn classification_json(found: &Classification) -> Value {
    let mut value = json!({"kind": found.kind.name()});
    if let Some(conic) = found.conic {
        value["conic"] = json!(conic.name());
    }
    if let Some(invariants) = found.invariants {
        value["second_conic"] = json!(invariants.second_conic.name());
        value["singular_points"] = json!(invariants.singular_points);
        value["planes_own"] = json!(invariants.planes_own);
        value["disc_weight_over_k"] = json!(invariants.weight_discriminant_over_k);
        value["disc_plane_over_k"] = json!(invariants.plane_discriminant_over_k);
        value["gram3"] = json!(invariants.gram_determinant);
        value["regular_arc"] = json!(invariants.regular_arc);
    }
    value
}
