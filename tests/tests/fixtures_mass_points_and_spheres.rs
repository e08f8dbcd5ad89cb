//! The reference numbers of mass points, conics and oriented spheres, every case of the file.
//!
//! Each group of the file is a kind of case; [`plane`] answers those on mass points and plane conics, [`spheres`] all
//! others and the two data sets at the top of the file.

use integration_tests::{Case, Tolerance, judge, read};
use serde_json::Value;

mod mass_points_and_spheres {
    pub(crate) mod plane;
    pub(crate) mod spheres;
}
use mass_points_and_spheres::{plane, spheres};

/// Groups whose values are derived from a curve of spheres; the file has a wider tolerance for them.
const CURVE_DERIVED: [&str; 5] = [
    "sphere_curve_state",
    "surface_point",
    "second_conic",
    "dandelin",
    "cone_patch",
];

#[test]
fn fixtures_mass_points_and_spheres() {
    let file = read("mass-points-and-spheres");
    let cases = group_cases(&file).chain(spheres::data_set_cases(&file));
    judge("mass-points-and-spheres", cases, |case| {
        if !plane::answer(case) && !spheres::answer(case) {
            case.unknown_kind();
        }
    });
}

/// The cases of all groups, the group's name as their kind.
fn group_cases(file: &Value) -> impl Iterator<Item = Case<'_>> {
    let tolerance = |key: &str| file["meta"][key].as_f64().expect("a tolerance in meta");
    let (plain, curve) = (
        tolerance("relative_tolerance"),
        tolerance("curve_relative_tolerance"),
    );
    let groups = file["groups"].as_object().expect("groups");
    groups.iter().flat_map(move |(kind, group)| {
        let within = if CURVE_DERIVED.contains(&kind.as_str()) {
            curve
        } else {
            plain
        };
        let cases = group["cases"].as_array().expect("cases of a group");
        cases.iter().map(move |value| {
            let name = value["name"].as_str().expect("a name");
            let case = Case::new(name, kind, &value["input"]);
            match value["error"].as_str() {
                Some(words) => case.expecting_error(words),
                None => case.expecting(&value["expected"], Tolerance::RelativeToLargest(within)),
            }
        })
    })
}
