//! The reference file on dual, PH and Tschirnhausen curves, ovals, Minkowski offsets and spatial frames
//! (items a to g of `ph-and-wavefront.json`).

use integration_tests::{Case, Tolerance, judge, read};

#[path = "ph_curves/more.rs"]
mod more;
#[path = "ph_curves/planar.rs"]
mod planar;

#[test]
fn fixtures_ph_and_wavefront_curves() {
    let file = read("ph-and-wavefront");
    let text =
        |case: &serde_json::Value, key: &str| case[key].as_str().unwrap_or_default().to_owned();
    let cases = file["cases"]
        .as_array()
        .expect("a list of cases")
        .iter()
        // Item h is fronts, judged by a test of its own.
        .filter(|case| text(case, "item") != "h")
        .map(|case| {
            let tolerance = Tolerance::Componentwise(case["tol"].as_f64().unwrap_or(0.0));
            Case::new(&text(case, "name"), &text(case, "op"), &case["input"])
                .expecting(&case["expect"], tolerance)
        });
    judge("ph curves", cases, |case| {
        if !(planar::answer(case) || more::answer(case)) {
            case.unknown_kind();
        }
    });
}
