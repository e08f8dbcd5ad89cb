//! The cases on mass points, quadratic curves and conics of the plane.

use bezier_mass::glam::DVec2;
use bezier_mass::{
    CentralConic, Conic, Error, Half, Homography, Line, MassPoint, MassPointKind, Parameter,
    Quadratic,
};
use integration_tests::{Case, numbers};
use serde_json::{Value, json};

/// Answers a case of this part of the file; `false` if its kind belongs elsewhere.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let answered = match case.kind() {
        "mass_point_ops" => Ok(mass_point_ops(case)),
        "curve_eval" => curve_eval(case),
        "subdivide" => subdivide(case),
        "homography" => homography(case),
        "sub_arc" => sub_arc(case),
        "theorem1" => theorem1(case),
        "theorem2" => theorem2(case),
        "conic_features" => conic_features(case),
        _ => return false,
    };
    if let Err(error) = answered {
        let words = error.to_string();
        case.refuse(&words, |wanted| words.starts_with(wanted));
    }
    true
}

fn mass_point_ops(case: &Case<'_>) {
    let a = mass_point(&case.input()["a"]);
    let result = match case.get("scale") {
        Some(_) => a * case.number("scale"),
        None => a + mass_point(&case.input()["b"]),
    };
    compare_all(case, &mass_point_json(result));
}

fn curve_eval(case: &Case<'_>) -> Result<(), Error> {
    compare_all(case, &mass_point_json(control(case)?.at(case.number("t"))));
    Ok(())
}

fn subdivide(case: &Case<'_>) -> Result<(), Error> {
    let (left, right) = control(case)?.subdivide(case.number("t"));
    case.compare("left", control_json(&left));
    case.compare("right", control_json(&right));
    Ok(())
}

fn homography(case: &Case<'_>) -> Result<(), Error> {
    let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| case.number(key));
    let result = control(case)?.reparametrised(Homography::new(a, b, c, d)?);
    case.compare("control", control_json(&result));
    Ok(())
}

fn sub_arc(case: &Case<'_>) -> Result<(), Error> {
    let ends = case.rows("ends");
    let end = |i: usize| Parameter::new(ends[i][0], ends[i][1]);
    let result = control(case)?.sub_arc(end(0)?, end(1)?)?;
    case.compare("control", control_json(&result));
    Ok(())
}

fn theorem1(case: &Case<'_>) -> Result<(), Error> {
    let [centre, start, end] = ["centre", "P0", "P2"].map(|key| vector(&case.input()[key]));
    let weights = ["w0", "w2"].map(|key| case.number(key));
    let arc = Quadratic::circular_arc(centre, [start, end], weights)?;
    let middle = arc.control()[1];
    case.compare("w1", middle.weight);
    match middle.kind() {
        MassPointKind::Point { position, .. } => {
            case.compare("case", "arc");
            case.compare("P1", json!(position.to_array()));
        }
        MassPointKind::Vector(vector) => {
            case.compare("case", "semi-circle");
            case.compare("vector", json!(vector.to_array()));
        }
    }
    Ok(())
}

fn theorem2(case: &Case<'_>) -> Result<(), Error> {
    let points = ["P0", "P1", "P2"].map(|key| vector(&case.input()[key]));
    let half = if case.number("eps") > 0.0 {
        Half::Along
    } else {
        Half::Against
    };
    let result = Quadratic::hyperbola_as_semicircle(points, case.number("w1"), half)?;
    for (key, &mass_point) in ["Q0", "Q1", "Q2"].into_iter().zip(result.control()) {
        case.compare(key, mass_point_json(mass_point));
    }
    let centre = result
        .centre()
        .position()
        .expect("a hyperbola has a centre");
    case.compare("centre", json!(centre.to_array()));
    Ok(())
}

fn conic_features(case: &Case<'_>) -> Result<(), Error> {
    let conic = control(case)?.conic();
    if let Some(eccentricity) = conic.eccentricity() {
        case.compare("eccentricity", eccentricity);
    }
    match conic {
        Conic::Circle(circle) => {
            case.compare("kind", "circle");
            case.compare("centre", json!(circle.centre.to_array()));
            case.compare("radius", circle.radius);
        }
        Conic::Ellipse(ellipse) => {
            case.compare("kind", "ellipse");
            central_features(case, &ellipse);
        }
        Conic::Hyperbola(hyperbola) => {
            case.compare("kind", "hyperbola");
            central_features(case, &hyperbola);
            let [along, across] = hyperbola.semi_axes();
            case.compare("asymptote_slopes_pm", across / along);
        }
        Conic::Parabola(parabola) => {
            case.compare("kind", "parabola");
            case.compare("focus", json!(parabola.focus.to_array()));
            case.compare("directrix", line_json(&parabola.directrix));
            case.compare("vertex", json!(parabola.vertex().to_array()));
            case.compare("focal_parameter", parabola.focal_parameter());
            case.compare("axis", json!(parabola.axis().to_array()));
        }
        Conic::Degenerate(_) => case.compare("kind", "degenerate"),
    }
    Ok(())
}

fn central_features(case: &Case<'_>, conic: &CentralConic) {
    let [along, across] = conic.semi_axes();
    case.compare("centre", json!(conic.centre.to_array()));
    case.compare("semi_axis_a", along);
    case.compare("semi_axis_b", across);
    case.compare("major_direction", json!(conic.major_direction.to_array()));
    case.compare("foci", json!(conic.foci().map(|p| p.to_array())));
    case.compare("vertices", json!(conic.vertices().map(|p| p.to_array())));
    case.compare(
        "directrices",
        json!(conic.directrices().map(|line| line_json(&line))),
    );
}

fn line_json(line: &Line) -> Value {
    json!({"normal": line.normal.to_array(), "offset": line.offset})
}

/// Compares every entry of `answer` under its own key.
fn compare_all(case: &Case<'_>, answer: &Value) {
    for (key, value) in answer.as_object().expect("an object") {
        case.compare(key, value.clone());
    }
}

fn vector(value: &Value) -> DVec2 {
    match numbers(value).as_deref() {
        Some(&[x, y]) => DVec2::new(x, y),
        _ => panic!("{value} is not a vector of the plane"),
    }
}

/// `{w, x}`: `x` is the position where `w` is not zero, else the vector.
fn mass_point(value: &Value) -> MassPoint<DVec2> {
    let (weight, x) = (value["w"].as_f64().expect("a weight"), vector(&value["x"]));
    if weight == 0.0 {
        MassPoint::vector(x)
    } else {
        MassPoint::point(x, weight)
    }
}

fn mass_point_json(mass_point: MassPoint<DVec2>) -> Value {
    match mass_point.kind() {
        MassPointKind::Point { position, weight } => json!({"w": weight, "x": position.to_array()}),
        MassPointKind::Vector(vector) => json!({"w": 0.0, "x": vector.to_array()}),
    }
}

fn control(case: &Case<'_>) -> Result<Quadratic<DVec2>, Error> {
    match case.input()["control"].as_array().map(Vec::as_slice) {
        Some([start, middle, end]) => Quadratic::new([start, middle, end].map(mass_point)),
        _ => panic!("three control mass points"),
    }
}

fn control_json(curve: &Quadratic<DVec2>) -> Value {
    curve
        .control()
        .iter()
        .map(|&h| mass_point_json(h))
        .collect()
}
