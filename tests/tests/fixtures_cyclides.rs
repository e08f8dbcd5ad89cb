//! The reference numbers of Dupin cyclides, their patches and the blends of two cones, every case of the file.
//!
//! Items `a` are surfaces, `b` to `d` patches and their conversion, `e` cones and blends.

use integration_tests::{Case, Tolerance, judge, list_at, read};

mod cyclides {
    pub(crate) mod blends;
    pub(crate) mod input;
    pub(crate) mod patches;
    pub(crate) mod surfaces;
}
use cyclides::{blends, input, patches, surfaces};

#[test]
fn fixtures_cyclides() {
    let file = read("cyclides");
    let cases = list_at(&file, "cases").iter().map(|case| {
        let text = |key: &str| case[key].as_str().unwrap_or_default();
        let tolerance = Tolerance::ComponentwiseMax(case["tol"].as_f64().expect("a tolerance"));
        Case::new(text("name"), text("item"), &case["input"])
            .expecting(&case["expected"], tolerance)
    });
    judge("cyclides", cases, |case| {
        let answered = match case.kind() {
            "a.evaluate" => surfaces::evaluate(case),
            "a.implicit" => surfaces::implicit(case),
            "a.type" => surfaces::kind(case),
            "a.axes" => surfaces::axes(case),
            "a.distance" => surfaces::distance(case),
            "a.ray" => surfaces::ray(case),
            "a.villarceau" => surfaces::villarceau(case),
            "a.area" => surfaces::area(case),
            "a.parabolic" => surfaces::parabolic(case),
            "b.bezier" => patches::bezier(case),
            "c.weights" => patches::weights(case),
            "c.invalid" => patches::invalid(case),
            "d.algorithm1" => patches::algorithm1(case),
            "d.convert" => patches::convert_net(case),
            "e.classify" => blends::classify_pair(case),
            "e.type" => blends::types(case),
            "e.blend" => blends::blend(case),
            "e.error" => blends::error(case),
            _ => {
                case.unknown_kind();
                Ok(())
            }
        };
        if let Err(error) = answered {
            input::refuse(case, &error);
        }
    });
}
