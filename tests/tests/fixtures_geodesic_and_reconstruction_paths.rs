//! The reference file on geodesics: meshes, locally shortest and straightest paths, loops, smooth surfaces
//! (items a to d of `geodesic-and-reconstruction.json`).

use integration_tests::{Case, Tolerance, judge, list_at, read};

#[path = "geodesic_paths/exact.rs"]
mod exact;
#[path = "geodesic_paths/loops.rs"]
mod loops;
#[path = "geodesic_paths/mesh.rs"]
mod mesh;

#[test]
fn fixtures_geodesic_and_reconstruction_paths() {
    let file = read("geodesic-and-reconstruction");
    let text =
        |case: &serde_json::Value, key: &str| case[key].as_str().unwrap_or_default().to_owned();
    // Items e to j are reconstruction, judged by a test of their own; any other unknown one fails here.
    let reconstruction = ["e", "f", "g", "h", "i", "j"];
    let all = list_at(&file, "cases");
    let mine: Vec<_> = all
        .iter()
        .filter(|case| !reconstruction.contains(&text(case, "item").as_str()))
        .collect();
    if mine.is_empty() && !all.is_empty() {
        println!("geodesic paths: the file holds reconstruction only");
        return;
    }
    let cases = mine.into_iter().map(|case| {
        let tolerance = Tolerance::ComponentwiseMax(case["tol"].as_f64().unwrap_or(0.0));
        Case::new(&text(case, "name"), &text(case, "kind"), &case["input"])
            .expecting(&case["expected"], tolerance)
    });
    judge("geodesic paths", cases, |case| {
        if !(mesh::answer(case) || loops::answer(case) || exact::answer(case)) {
            case.unknown_kind();
        }
    });
}
