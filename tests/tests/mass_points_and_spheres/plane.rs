//! The cases on mass points, curves and conics of the plane. Mass points and curves are answered in any dimension.

use bezier_mass::glam::DVec2;
use bezier_mass::{
    BezierCurve, CentralConic, Conic, Error, Half, Homography, Line, MassPoint, MassPointKind,
    Parameter, Quadratic,
};
use integration_tests::{Case, numbers};
use serde_json::{Value, json};

/// Answers a case of this part of the file; `false` if its kind belongs elsewhere.
pub(crate) fn answer(case: &Case<'_>) -> bool {
    let answered = match case.kind() {
        "mass_point_ops" | "curve_eval" | "subdivide" | "homography" | "sub_arc" => {
            let input = case.input();
            let first = input.get("control").map_or(&input["a"], |list| &list[0]);
            match numbers(&first["x"]).map_or(0, |x| x.len()) {
                1 => linear::<1>(case),
                2 => linear::<2>(case),
                3 => linear::<3>(case),
                4 => linear::<4>(case),
                dimension => panic!("mass points of dimension {dimension}"),
            }
        }
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

/// The kinds that need no more than a vector space.
fn linear<const N: usize>(case: &Case<'_>) -> Result<(), Error> {
    match case.kind() {
        "mass_point_ops" => {
            let a = mass_point::<N>(&case.input()["a"]);
            let result = match case.get("scale") {
                Some(_) => a * case.number("scale"),
                None => a + mass_point(&case.input()["b"]),
            };
            compare_all(case, &mass_point_json(result));
        }
        "curve_eval" => {
            let (curve, t) = (curve::<N>(case)?, case.number("t"));
            compare_all(case, &mass_point_json(curve.at(t)));
            if let Some(quadratic) = as_quadratic(&curve) {
                compare_all(case, &mass_point_json(quadratic.at(t)));
            }
        }
        "subdivide" => {
            let (curve, t) = (curve::<N>(case)?, case.number("t"));
            let (left, right) = curve.subdivide(t);
            case.compare("left", control_json(left.control()));
            case.compare("right", control_json(right.control()));
            if let Some(quadratic) = as_quadratic(&curve) {
                let (left, right) = quadratic.subdivide(t);
                case.compare("left", control_json(left.control()));
                case.compare("right", control_json(right.control()));
            }
        }
        "homography" => {
            let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| case.number(key));
            reparametrised(case, &curve::<N>(case)?, Homography::new(a, b, c, d)?);
        }
        _ => {
            let ends = case.rows("ends");
            let end = |i: usize| Parameter::new(ends[i][0], ends[i][1]);
            let homography = Homography::between(end(0)?, end(1)?)?;
            reparametrised(case, &curve::<N>(case)?, homography);
        }
    }
    Ok(())
}

fn reparametrised<const N: usize>(
    case: &Case<'_>,
    curve: &BezierCurve<[f64; N]>,
    homography: Homography,
) {
    let result = curve.reparametrised(homography);
    case.compare("control", control_json(result.control()));
    if let Some(quadratic) = as_quadratic(curve) {
        let result = quadratic.reparametrised(homography);
        case.compare("control", control_json(result.control()));
    }
}

/// The curve by value, if its degree is two.
fn as_quadratic<const N: usize>(curve: &BezierCurve<[f64; N]>) -> Option<Quadratic<[f64; N]>> {
    Quadratic::try_from(curve)
        .ok()
        .filter(|_| curve.degree() == 2)
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
        case.compare(key, mass_point_json(mass_point.map_linear(DVec2::into)));
    }
    let centre = result
        .centre()
        .position()
        .expect("a hyperbola has a centre");
    case.compare("centre", json!(centre.to_array()));
    Ok(())
}

fn conic_features(case: &Case<'_>) -> Result<(), Error> {
    let curve = curve::<2>(case)?;
    let curve = curve.map(|h| h.map_linear(DVec2::from_array))?;
    let conic = Quadratic::try_from(&curve)?.conic();
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
    DVec2::from_array(coordinates(value))
}

fn coordinates<const N: usize>(value: &Value) -> [f64; N] {
    let list = numbers(value).unwrap_or_else(|| panic!("{value} is not a vector"));
    <[f64; N]>::try_from(list).unwrap_or_else(|list| panic!("{list:?} has not {N} coordinates"))
}

/// `{w, x}`: `x` is the position where `w` is not zero, else the vector.
fn mass_point<const N: usize>(value: &Value) -> MassPoint<[f64; N]> {
    let weight = value["w"].as_f64().expect("a weight");
    let x = coordinates(&value["x"]);
    if weight == 0.0 {
        MassPoint::vector(x)
    } else {
        MassPoint::point(x, weight)
    }
}

fn mass_point_json<const N: usize>(mass_point: MassPoint<[f64; N]>) -> Value {
    let (w, x) = match mass_point.kind() {
        MassPointKind::Point { position, weight } => (weight, position),
        MassPointKind::Vector(vector) => (0.0, vector),
    };
    json!({"w": w, "x": x.to_vec()})
}

fn curve<const N: usize>(case: &Case<'_>) -> Result<BezierCurve<[f64; N]>, Error> {
    let control = case.input()["control"]
        .as_array()
        .expect("a list of control mass points");
    BezierCurve::new(control.iter().map(mass_point).collect())
}

fn control_json<const N: usize>(control: &[MassPoint<[f64; N]>]) -> Value {
    control.iter().map(|&h| mass_point_json(h)).collect()
}
