//! From JSON to the values of the crate and back.

use cyclide::glam::DVec3;
use cyclide::{Condition, Cone, Dupin, Error, Frame, Quartic};
use integration_tests::Case;
use serde_json::{Value, json};

pub(crate) fn number(value: &Value, key: &str) -> f64 {
    integration_tests::number(&value[key]).unwrap_or_else(|| panic!("no number {key} in {value}"))
}

pub(crate) fn vector(value: &Value) -> DVec3 {
    let numbers = integration_tests::numbers(value).unwrap_or_else(|| panic!("no vector: {value}"));
    DVec3::from_slice(&numbers)
}

pub(crate) fn array(vector: DVec3) -> Value {
    json!(vector.to_array())
}

pub(crate) fn frame(value: &Value) -> Result<Frame, Error> {
    if value.is_null() {
        return Ok(Frame::WORLD);
    }
    let axis = |key: &str| vector(&value[key]);
    Frame::new(axis("origin"), axis("x"), axis("y"), axis("z"))
}

/// The surface at `surface`, or one whose parameters stand beside the other input.
pub(crate) fn surface(case: &Case<'_>) -> Result<Dupin, Error> {
    let value = case.get("surface").unwrap_or(case.input());
    let frame = frame(&value["frame"])?;
    if value.get("f").is_some() {
        return Dupin::parabolic(number(value, "f"), number(value, "k"), frame);
    }
    let [a, c, mu] = ["a", "c", "mu"].map(|key| number(value, key));
    Dupin::quartic(a, c, mu, frame)
}

pub(crate) fn quartic(case: &Case<'_>) -> Result<Quartic, Error> {
    Ok(*surface(case)?.as_quartic().expect("a quartic"))
}

/// Words by which the file names a refusal.
pub(crate) fn phrases(error: &Error) -> &'static [&'static str] {
    match error {
        Error::NotFinite { .. } => &["finite"],
        Error::NotAFrame { .. } => &["frame"],
        Error::QuarticParameters { .. } => &["a >= c", "parameter"],
        Error::TwoSpheres { .. } => &["two spheres", "two-spheres", "a = c"],
        Error::VanishingSphere => &["zero"],
        Error::FocalParameter { .. } => &["f > 0", "focal", "positive"],
        Error::NotARing { .. } => &["ring cyclide"],
        Error::Direction => &["direction"],
        Error::Span { .. } => &["span", "2 pi", "2pi"],
        Error::NotAPatch { condition, .. } => match condition {
            Condition::ConcyclicCorners => &["PG1", "residual"],
            Condition::EqualEdges => &["PG2", "residual"],
            Condition::RightAngles => &["PG3", "residual"],
            Condition::CornerPlanes => &["PG4", "residual"],
            Condition::FourthCornerWeight => &["w22", "residual"],
            Condition::EdgeWeights => &["edge", "residual"],
            Condition::CentralWeight => &["w11", "residual"],
            _ => &[],
        },
        Error::NetResidual { .. } => &["residual"],
        Error::CornerWeights { .. } => &["corner weights"],
        Error::Planar => &["planar"],
        Error::ConeOrCylinder => &["cylinder or cone", "cone or cylinder"],
        Error::NoNormal { .. } => &["normal", "singular"],
        Error::NoParallelEdges { .. } => &["parallel planes"],
        Error::HalfAngle { .. } => &["half angle"],
        Error::Axis { .. } => &["axis"],
        Error::CylinderRadius { .. } => &["radius"],
        Error::CommonSphere { .. } => &["degenerate member"],
        Error::NotOnDiagonal { .. } => &["does not lie on a diagonal"],
        _ => &[],
    }
}

pub(crate) fn span(case: &Case<'_>, name: &str) -> [f64; 2] {
    ["0", "1"].map(|end| case.number(&format!("{name}{end}")))
}

pub(crate) fn cones(case: &Case<'_>) -> Result<[Cone; 2], Error> {
    Ok([cone(&case.input()["cone1"])?, cone(&case.input()["cone2"])?])
}

fn cone(value: &Value) -> Result<Cone, Error> {
    let axis = vector(&value["axis"]);
    if value.get("cylinder_point").is_some() {
        return Cone::cylinder(
            vector(&value["cylinder_point"]),
            axis,
            number(value, "radius"),
        );
    }
    Cone::new(vector(&value["vertex"]), axis, number(value, "half_angle"))
}

/// Refuses with the error's category; the file's words mean it if they contain one of its phrases.
pub(crate) fn refuse(case: &Case<'_>, error: &Error) {
    case.refuse(&error.to_string(), |words| {
        phrases(error).iter().any(|phrase| words.contains(phrase))
    });
}

/// The direction among `direction` and `-direction` that the file has.
pub(crate) fn up_to_sign(case: &Case<'_>, key: &str, direction: DVec3) -> Value {
    let want = case.expected().get(key).map_or(DVec3::ZERO, vector);
    array(if direction.dot(want) < 0.0 {
        -direction
    } else {
        direction
    })
}
