//! The cases on oriented spheres, curves of spheres and cyclides.

use integration_tests::Case;
use serde_json::Value;

/// Answers a case of this part of the file; `false` if its kind belongs elsewhere.
pub(crate) fn answer(_case: &Case<'_>) -> bool {
    false
}

/// The seahorse and the paper's printed numbers, as cases.
pub(crate) fn data_set_cases(_file: &Value) -> Vec<Case<'_>> {
    Vec::new()
}
