//! The cases on mass points, quadratic curves and conics of the plane.

use bezier_mass::glam::DVec2;
use bezier_mass::{Error, Homography, MassPoint, MassPointKind, Parameter, Quadratic};
use integration_tests::{Case, numbers};
use serde_json::{Value, json};

/// Answers a case of this part of the file; `false` if its kind belongs elsewhere.
pub fn answer(case: &Case<'_>) -> bool {
    let answered = match case.kind() {
        "mass_point_ops" => Ok(mass_point_ops(case)),
        "curve_eval" => curve_eval(case),
        "subdivide" => subdivide(case),
        "homography" => homography(case),
        "sub_arc" => sub_arc(case),
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
