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
    for key in file.as_object().expect("an object").keys() {
        let known = ["meta", "groups", "seahorse", "paper_numbers"].contains(&key.as_str());
        let holds_cases = file[key].get("cases").is_some() || file[key].get("expected").is_some();
        assert!(known || !holds_cases, "unknown data set {key}");
    }
    let cases = group_cases(&file).chain(spheres::data_set_cases(&file));
    judge("mass-points-and-spheres", cases, |case| {
        if !plane::answer(case) && !spheres::answer(case) {
            case.unknown_kind();
        }
    });
}

/// The cases of all groups, the group's name as their kind.
fn group_cases(file: &Value) -> impl Iterator<Item = Case<'_>> {
    // The specification has the same two numbers, for a file without them.
    let tolerance = |key: &str, usual: f64| file["meta"][key].as_f64().unwrap_or(usual);
    let (plain, curve) = (
        tolerance("relative_tolerance", 1e-12),
        tolerance("curve_relative_tolerance", 1e-10),
    );
    let groups = file
        .get("groups")
        .map(|groups| groups.as_object().expect("named groups"));
    groups.into_iter().flatten().flat_map(move |(kind, group)| {
        let within = if CURVE_DERIVED.contains(&kind.as_str()) {
            curve
        } else {
            plain
        };
        let cases = group["cases"].as_array().expect("cases of a group");
        cases.iter().map(move |value| {
            let name = value["name"].as_str().expect("a name");
            let case = Case::new(name, kind, &value["input"])
                .expecting(&value["expected"], Tolerance::RelativeToLargest(within));
            match value["error"].as_str() {
                Some(words) => case.expecting_error(words),
                None => case,
            }
        })
    })
}
